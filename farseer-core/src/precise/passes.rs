//! What the rows of contacts do to velocities, four at a time.
//!
//! Every substep: the impulses so far act again ([`gather_warm`], once per step); every row becomes a soft spring with a
//! damper ([`solve_soft`]); bodies move; and every row is solved again, hard, so that what the springs pushed out does not
//! stay as velocity ([`relax`]). That is the scheme of E. Catto, "Solver2D" (2024; the solver `Soft Step` of Box2D 3) and
//! "Soft Constraints" (GDC 2011), on the substeps of M. Macklin et al., "Small Steps in Physics Simulation" (2019).
//!
//! **What is different: a spring learns its load.** A spring that carries a load rests where it is compressed by it: that is
//! the sag of all soft methods, and no number of passes takes it away. Here the spring of a contact rests at an impulse of
//! its own, `held`, at which its length is zero: in the spring's leak, l' = l - mass (u + bias s) k - leak (l - held). Once
//! per step held follows the load, slowly, and only while nothing moves much ([`learn`]), as the integral term of a
//! controller: it takes the sag away and adds no stiffness. A part of the load stays on the spring, so that contacts deep in
//! a pile stay pressed; between that part and the whole load held stands still.
//!
//! With n the normal from A to B, t = (n.y, -n.x) and r the arm of a point: the relative velocity along n is
//! (vB - vA) n + wB (rB x n) - wA (rA x n), and the same along t, where the arm is that of the middle of both points.

use crate::precise::parameters::contacts::BLOCK_CONDITION;
use wide::f32x4;

use super::bodies::Hot;
use super::rows::{Block, Colours, Contacts, Lane, Point, Row};
use super::tuning::{Learning, Softness};
use crate::math::lanes::{gather, greater, positive, select, smaller};

const ZERO: f32x4 = f32x4::ZERO;

/// Velocity, or step, of the two sides of four rows: along x and y, turning, and along z.
pub(super) struct Sides {
    pub(super) a: [f32x4; 4],
    pub(super) b: [f32x4; 4],
}

#[inline(always)]
pub(super) fn velocities<const FIXED: bool, const P: usize>(row: &Row<P>, hot: &[Hot]) -> Sides {
    sides::<FIXED, P>(row, |body| hot[body as usize].velocity)
}

#[inline(always)]
pub(super) fn steps<const FIXED: bool, const P: usize>(row: &Row<P>, hot: &[Hot]) -> Sides {
    sides::<FIXED, P>(row, |body| hot[body as usize].step)
}

#[inline(always)]
fn sides<const FIXED: bool, const P: usize>(row: &Row<P>, of: impl Fn(u32) -> [f32; 4]) -> Sides {
    let columns = |bodies: &[u32; 4]| f32x4::transpose(bodies.map(|body| f32x4::new(of(body))));
    Sides { a: if FIXED { [ZERO; 4] } else { columns(&row.a) }, b: columns(&row.b) }
}

impl Sides {
    #[inline(always)]
    fn along_normal<const FIXED: bool, const P: usize, R: Contacts<P>>(&self, contacts: &R) -> f32x4 {
        let ([x, y, z], row) = (self.apart::<FIXED>(), contacts.row());
        let in_plane = x * row.normal_x + y * row.normal_y;
        if R::IN_SPACE { in_plane + z * contacts.normal_z() } else { in_plane }
    }

    #[inline(always)]
    fn along_tangent<const FIXED: bool, const P: usize>(&self, row: &Row<P>) -> f32x4 {
        let [x, y, _] = self.apart::<FIXED>();
        x * row.normal_y - y * row.normal_x
    }

    #[inline(always)]
    pub(super) fn apart<const FIXED: bool>(&self) -> [f32x4; 3] {
        let ([ax, ay, _, az], [bx, by, _, bz]) = (self.a, self.b);
        if FIXED { [bx, by, bz] } else { [bx - ax, by - ay, bz - az] }
    }

    /// What the turning of both adds at these arms.
    #[inline(always)]
    pub(super) fn turning<const FIXED: bool>(&self, arm_a: f32x4, arm_b: f32x4) -> f32x4 {
        if FIXED { self.b[2] * arm_b } else { self.b[2] * arm_b - self.a[2] * arm_a }
    }

    /// Impulses turn both, given the sums of what they are times their arms.
    #[inline(always)]
    pub(super) fn turn<const FIXED: bool, const P: usize>(&mut self, row: &Row<P>, [of_a, of_b]: [f32x4; 2]) {
        if !FIXED {
            self.a[2] -= row.inverse_inertia_a * of_a;
        }
        self.b[2] += row.inverse_inertia_b * of_b;
    }

    /// Writes the velocities back, after impulses along the normal.
    #[inline(always)]
    fn store_normal<const FIXED: bool, const P: usize, R: Contacts<P>>(
        &self,
        contacts: &R,
        hot: &mut [Hot],
        along: f32x4,
    ) {
        let row = contacts.row();
        let z = if R::IN_SPACE { along * contacts.normal_z() } else { ZERO };
        self.store::<FIXED, P>(row, hot, R::IN_SPACE, [along * row.normal_x, along * row.normal_y, z]);
    }

    /// Writes the velocities back, after this impulse on B and its opposite on A.
    #[inline(always)]
    pub(super) fn store<const FIXED: bool, const P: usize>(
        &self,
        row: &Row<P>,
        hot: &mut [Hot],
        is_in_space: bool,
        [x, y, z]: [f32x4; 3],
    ) {
        let mut put = |bodies: &[u32; 4], [vx, vy, turn, vz]: [f32x4; 4]| {
            let rows = f32x4::transpose([vx, vy, turn, if is_in_space { vz } else { ZERO }]);
            for (&body, velocity) in bodies.iter().zip(rows) {
                hot[body as usize].velocity = velocity.to_array();
            }
        };
        let ([ax, ay, turn_a, az], [bx, by, turn_b, bz]) = (self.a, self.b);
        if !FIXED {
            let mass = row.inverse_mass_a;
            put(&row.a, [ax - mass * x, ay - mass * y, turn_a, az - mass * z]);
        }
        let mass = row.inverse_mass_b;
        put(&row.b, [bx + mass * x, by + mass * y, turn_b, bz + mass * z]);
    }
}

#[inline(always)]
pub(super) fn masses<const FIXED: bool, const P: usize>(row: &Row<P>) -> f32x4 {
    if FIXED { row.inverse_mass_b } else { row.inverse_mass_a + row.inverse_mass_b }
}

/// What a unit of impulse with some arms does by turning to the velocity with other arms: known before the impulses are, so
/// that one point need not wait until another has changed velocities.
#[inline(always)]
pub(super) fn turning_of<const FIXED: bool, const P: usize>(
    row: &Row<P>,
    [arm_a, arm_b]: [f32x4; 2],
    [other_a, other_b]: [f32x4; 2],
) -> f32x4 {
    let of_b = row.inverse_inertia_b * (arm_b * other_b);
    if FIXED { of_b } else { of_b + row.inverse_inertia_a * (arm_a * other_a) }
}

/// The velocities of the points along the normal.
#[inline(always)]
pub(super) fn at_points<const FIXED: bool, const P: usize, R: Contacts<P>>(
    contacts: &R,
    sides: &Sides,
) -> [f32x4; P] {
    let along = sides.along_normal::<FIXED, P, R>(contacts);
    contacts.row().points.map(|point| along + sides.turning::<FIXED>(point.arm_a, point.arm_b))
}

/// What a unit of impulse at one point does to the velocity at the other.
#[inline(always)]
pub(super) fn coupling<const FIXED: bool, const P: usize>(row: &Row<P>) -> f32x4 {
    let [first, last] = [row.points[0].arms(), row.points[P - 1].arms()];
    masses::<FIXED, P>(row) + turning_of::<FIXED, P>(row, first, last)
}

/// Sums of impulses times arms.
#[inline(always)]
pub(super) fn torques<const P: usize>(row: &Row<P>, impulses: &[f32x4; P]) -> [f32x4; 2] {
    let sum = |arm: fn(&Point) -> f32x4| {
        let rest = row.points[1..].iter().zip(&impulses[1..]);
        rest.fold(impulses[0] * arm(&row.points[0]), |sum, (point, &impulse)| sum + impulse * arm(point))
    };
    [sum(|point| point.arm_a), sum(|point| point.arm_b)]
}

#[inline(always)]
pub(super) fn magnitude(number: f32x4) -> f32x4 {
    greater(number, ZERO - number)
}

/// Lets the springs of four rows learn their load.
///
/// How fast depends on how little the two move at the contact: not at all from a velocity of the gate on. One point rises
/// while it is pressed in and what it carries is well above what it rests at. Of two points the sums are asked: rocking only
/// shifts load from one to the other, and must not pump their springs. What is deep in something has no room, and would push
/// ever harder. The speed that is handed in is that across the normal.
#[inline(always)]
pub(super) fn learn<const FIXED: bool, const P: usize, R: Contacts<P>>(
    contacts: &mut R,
    sides: &Sides,
    mut speed: f32x4,
    learning: &Learning,
) {
    for velocity in at_points::<FIXED, P, R>(contacts, sides) {
        speed = greater(speed, magnitude(velocity));
    }
    let row = contacts.row_mut();
    let stillness = positive(f32x4::splat(1.0) - speed * f32x4::splat(learning.inverse_gate));
    let up = f32x4::splat(learning.up) * stillness;
    let (learnt, down) = (f32x4::splat(learning.learnt), f32x4::splat(learning.down));
    let sum = |of: fn(&Point) -> f32x4| {
        row.points[1..].iter().fold(of(&row.points[0]), |sum, point| sum + of(point))
    };
    let (load, held) = (sum(|point| point.impulse), sum(|point| point.held));
    let deepest =
        row.points[1..].iter().fold(row.points[0].separation, |least, p| smaller(least, p.separation));
    let is_sag = deepest.simd_lt(ZERO) & deepest.simd_gt(f32x4::splat(learning.deepest));
    let rises = (learnt * load).simd_gt(held) & is_sag & up;
    for point in &mut row.points {
        let missing = point.impulse - point.held;
        let excess = missing & missing.simd_lt(ZERO);
        point.held = point.held + rises * positive(missing) + down * excess;
    }
}

/// A mask of four contacts, from masks by body number: all bits where either body has one.
#[inline(always)]
fn mask_of<const FIXED: bool, const P: usize>(row: &Row<P>, masks: &[u32]) -> f32x4 {
    let of = |body: u32| masks[body as usize];
    f32x4::new(std::array::from_fn(|lane| {
        f32::from_bits(of(row.b[lane]) | if FIXED { 0 } else { of(row.a[lane]) })
    }))
}

/// [`learn`] where some bodies have joints in the iterative solver: springs of their contacts forget what they have learnt. Joints
/// cannot be stiffer than they are, and a contact that rests at its load would win against them. Impulses of a blow on all that joints
/// hold together are forgotten where bodies leave: the one body that a row would take them back from is only a part of that.
#[inline(never)]
pub(super) fn learn_beside_joints<const FIXED: bool, const P: usize, R: Contacts<P>>(
    contacts: &mut R,
    sides: &Sides,
    speed: f32x4,
    learning: &Learning,
    masks: &[u32],
) {
    let mask = mask_of::<FIXED, P>(contacts.row(), masks);
    let kept = f32x4::splat(1.0 - learning.down);
    let forgotten = contacts.row().points.map(|point| kept * point.held);
    learn::<FIXED, P, R>(contacts, sides, speed, learning);
    for (point, forgotten) in contacts.row_mut().points.iter_mut().zip(forgotten) {
        point.held = select(mask, forgotten, point.held);
    }
    let row = contacts.row();
    if row.restitution.simd_gt(ZERO).to_bitmask() == 0 {
        return;
    }
    let may_leave = mask & row.restitution.simd_gt(ZERO);
    let velocities = at_points::<FIXED, P, R>(contacts, sides);
    let row = contacts.row_mut();
    let mut leaves = may_leave;
    for (point, velocity) in row.points.iter_mut().zip(velocities) {
        let point_leaves = may_leave & velocity.simd_gt(f32x4::splat(learning.leaving));
        point.impulse = select(point_leaves, ZERO, point.impulse);
        leaves &= point_leaves;
    }
    row.tangent_impulse = select(leaves, ZERO, row.tangent_impulse);
}

/// Sums what the impulses of all rows do to the velocity of each body in a substep; on the way springs learn. `masks` are those of
/// bodies with joints in the iterative solver, if there are any.
#[inline(always)]
pub(super) fn gather_warm<const FIXED: bool, const P: usize>(
    rows: &mut Colours<Row<P>>,
    warm: &mut [[f32; 4]],
    hot: &[Hot],
    learning: &Learning,
    masks: Option<&[u32]>,
) {
    rows.for_each(|row| {
        let sides = velocities::<FIXED, P>(row, hot);
        let slip = sides.along_tangent::<FIXED, P>(row)
            + sides.turning::<FIXED>(row.tangent_arm_a, row.tangent_arm_b);
        let speed = magnitude(slip - row.tangent_speed);
        match masks {
            None => learn::<FIXED, P, _>(row, &sides, speed, learning),
            Some(masks) => learn_beside_joints::<FIXED, P, _>(row, &sides, speed, learning, masks),
        }
        let sum = |of: fn(&Point) -> f32x4| {
            row.points[1..].iter().fold(of(&row.points[0]), |sum, point| sum + of(point))
        };
        let along = sum(|point| point.impulse);
        let turn_a = sum(|point| point.impulse * point.arm_a) + row.tangent_impulse * row.tangent_arm_a;
        let turn_b = sum(|point| point.impulse * point.arm_b) + row.tangent_impulse * row.tangent_arm_b;
        let x = along * row.normal_x + row.tangent_impulse * row.normal_y;
        let y = along * row.normal_y - row.tangent_impulse * row.normal_x;
        let mut add = |bodies: &[u32; 4], columns: [f32x4; 3]| {
            let rows = f32x4::transpose([columns[0], columns[1], columns[2], ZERO]);
            for (&body, change) in bodies.iter().zip(rows) {
                let sum = &mut warm[body as usize];
                *sum = (f32x4::new(*sum) + change).to_array();
            }
        };
        if !FIXED {
            let (mass, inertia) = (ZERO - row.inverse_mass_a, ZERO - row.inverse_inertia_a);
            add(&row.a, [mass * x, mass * y, inertia * turn_a]);
        }
        add(&row.b, [row.inverse_mass_b * x, row.inverse_mass_b * y, row.inverse_inertia_b * turn_b]);
    });
}

/// One pass over normals as soft springs. What is apart may come together by its distance and no further: a hard row with
/// u >= -s / h.
#[inline(always)]
pub(super) fn solve_soft<const FIXED: bool, const P: usize, R: Contacts<P>>(
    rows: &mut Colours<R>,
    hot: &mut [Hot],
    inverse_h: f32,
    softness: Softness,
    push: f32,
) {
    let softness = softness.lanes();
    solve_softly::<FIXED, P, R>(rows, hot, inverse_h, push, |_| softness);
}

/// [`solve_soft`] where bodies with these masks have joints in the iterative solver: their contacts have the second softness.
#[inline(never)]
pub(super) fn solve_soft_beside_joints<const FIXED: bool, const P: usize, R: Contacts<P>>(
    rows: &mut Colours<R>,
    hot: &mut [Hot],
    inverse_h: f32,
    softness: [Softness; 2],
    push: f32,
    masks: &[u32],
) {
    let [other, jointed] = softness.map(|softness| softness.lanes());
    solve_softly::<FIXED, P, R>(rows, hot, inverse_h, push, |row| {
        let mask = mask_of::<FIXED, P>(row, masks);
        std::array::from_fn(|at| select(mask, jointed[at], other[at]))
    });
}

#[inline(always)]
fn solve_softly<const FIXED: bool, const P: usize, R: Contacts<P>>(
    rows: &mut Colours<R>,
    hot: &mut [Hot],
    inverse_h: f32,
    push: f32,
    softness: impl Fn(&Row<P>) -> [f32x4; 3],
) {
    let one = f32x4::splat(1.0);
    let (inverse_h, fastest) = (f32x4::splat(inverse_h), f32x4::splat(-push));
    rows.for_each(|contacts| {
        let [rate, mass, leak] = softness(contacts.row());
        let mut sides = velocities::<FIXED, P>(contacts.row(), hot);
        let mut velocity = at_points::<FIXED, P, R>(contacts, &sides);
        let row = contacts.row_mut();
        let coupling = coupling::<FIXED, P>(row);
        let (mut sum, mut changes) = (ZERO, [ZERO; P]);
        let (mut given, mut weights) = ([ZERO; P], [ZERO; P]);
        for at in 0..P {
            let point = row.points[at];
            let is_apart = point.separation.simd_gt(ZERO);
            let bias =
                select(is_apart, point.separation * inverse_h, greater(point.separation * rate, fastest));
            let leaked = (leak * (point.impulse - point.held)) & !is_apart;
            given[at] = point.mass * bias + leaked;
            weights[at] = point.mass * select(is_apart, one, mass);
        }
        let lost = std::array::from_fn(|at| given[at] + weights[at] * velocity[at]);
        // In the plane the hard pass alone makes good for it.
        let (hold, both) = if R::IN_SPACE {
            both_at_once::<P, R>(row, coupling, &weights, &lost)
        } else {
            (ZERO, [ZERO; P])
        };
        for at in 0..P {
            let point = row.points[at];
            let alone = positive(point.impulse - given[at] - weights[at] * velocity[at]);
            let impulse = select(hold, both[at], alone);
            changes[at] = impulse - point.impulse;
            row.points[at].impulse = impulse;
            sum += changes[at];
            velocity[P - 1] += coupling * changes[at];
        }
        sides.turn::<FIXED, P>(row, torques(row, &changes));
        sides.store_normal::<FIXED, P, R>(contacts, hot, sum);
    });
}

/// Impulses of two points solved together, and for which rows that can be done: given what a unit of velocity takes from each,
/// and what each of them alone would lose. One after the other they would leave a part of what they do to each other,
/// (coupling x weight)^2: what meets face to face would turn, and what lies would rock.
///
/// Either both push, or one of them, or none: a linear complementarity problem of two rows, solved by enumerating its cases
/// (the block solver of Box2D 2, `b2ContactSolver.cpp`, by E. Catto and D. Gregorius). In the plane only the first case is
/// worth its time.
#[inline(always)]
fn both_at_once<const P: usize, R: Contacts<P>>(
    row: &Row<P>,
    coupling: f32x4,
    weights: &[f32x4; P],
    lost: &[f32x4; P],
) -> (f32x4, [f32x4; P]) {
    if P == 1 {
        return (ZERO, [ZERO; P]);
    }
    let (first, last) = (row.points[0].impulse, row.points[P - 1].impulse);
    let across = [weights[0] * coupling, weights[P - 1] * coupling];
    let one = f32x4::splat(1.0);
    let apart = one - across[0] * across[1];
    let is_apart = apart.simd_gt(f32x4::splat(BLOCK_CONDITION));
    let change = (across[1] * lost[0] - lost[P - 1]) / select(is_apart, apart, one);
    let both = [first - lost[0] - across[0] * change, last + change];
    let push = both[0].simd_ge(ZERO) & both[1].simd_ge(ZERO);
    let mut solved = [both[1]; P];
    solved[0] = both[0];
    if !R::IN_SPACE {
        return (is_apart & push, solved);
    }
    let first_alone = positive(first - lost[0] + across[0] * last);
    let last_alone = positive(last - lost[P - 1] + across[1] * first);
    let is_enough = (lost[P - 1] + across[1] * (first_alone - first) - last).simd_ge(ZERO);
    solved[P - 1] = select(push, both[1], select(is_enough, ZERO, last_alone));
    solved[0] = select(push, both[0], select(is_enough, first_alone, ZERO));
    (is_apart, solved)
}

/// What a hard pass over the normals of four rows has done.
pub(super) struct Relaxed<const P: usize> {
    /// Velocities before.
    pub(super) sides: Sides,
    /// Sum of what was added to impulses, and what to each; and sum of the impulses.
    pub(super) sum: f32x4,
    pub(super) changes: [f32x4; P],
    pub(super) load: f32x4,
}

/// Solves the normals of four rows as hard rows; velocities are not written yet.
#[inline(always)]
pub(super) fn relax_normals<const FIXED: bool, const P: usize, R: Contacts<P>>(
    contacts: &mut R,
    hot: &[Hot],
    inverse_h: f32x4,
) -> Relaxed<P> {
    let moved = at_points::<FIXED, P, R>(contacts, &steps::<FIXED, P>(contacts.row(), hot));
    let sides = velocities::<FIXED, P>(contacts.row(), hot);
    let mut velocity = at_points::<FIXED, P, R>(contacts, &sides);
    let row = contacts.row_mut();
    let coupling = coupling::<FIXED, P>(row);
    let (mut sum, mut load, mut changes) = (ZERO, ZERO, [ZERO; P]);
    let mut separations = [ZERO; P];
    let mut due = velocity;
    for at in 0..P {
        separations[at] = row.points[at].separation + moved[at];
        due[at] = positive(separations[at]) * inverse_h + velocity[at];
    }
    let weights = std::array::from_fn(|at| row.points[at].mass);
    let lost = std::array::from_fn(|at| weights[at] * due[at]);
    let (hold, both) = both_at_once::<P, R>(row, coupling, &weights, &lost);
    let mut impulses = both;
    if P == 1 || hold.to_bitmask() != 0b1111 {
        for at in 0..P {
            let point = row.points[at];
            let kept = point.impulse - point.mass * (positive(separations[at]) * inverse_h);
            let alone = positive(kept - point.mass * velocity[at]);
            impulses[at] = select(hold, both[at], alone);
            velocity[P - 1] += coupling * (impulses[at] - point.impulse);
        }
    }
    for at in 0..P {
        let point = &mut row.points[at];
        changes[at] = impulses[at] - point.impulse;
        point.separation = separations[at];
        point.impulse = impulses[at];
        sum += changes[at];
        load += impulses[at];
    }
    Relaxed { sides, sum, changes, load }
}

/// One pass over normals and friction as hard rows, after the bodies have moved: separations follow them.
#[inline(always)]
pub(super) fn relax<const FIXED: bool, const P: usize>(
    rows: &mut Colours<Row<P>>,
    hot: &mut [Hot],
    inverse_h: f32,
) {
    let inverse_h = f32x4::splat(inverse_h);
    rows.for_each(|row| {
        let Relaxed { mut sides, sum, changes, load } = relax_normals::<FIXED, P, _>(row, hot, inverse_h);
        let tangent_arms = [row.tangent_arm_a, row.tangent_arm_b];
        let mut slip =
            sides.along_tangent::<FIXED, P>(row) + sides.turning::<FIXED>(tangent_arms[0], tangent_arms[1]);
        for (point, change) in row.points.iter().zip(changes) {
            slip += turning_of::<FIXED, P>(row, point.arms(), tangent_arms) * change;
        }
        let most = row.friction * load;
        let wanted = row.tangent_impulse - row.tangent_mass * (slip - row.tangent_speed);
        let friction = greater(smaller(wanted, most), ZERO - most);
        let change = friction - row.tangent_impulse;
        row.tangent_impulse = friction;
        let [of_a, of_b] = torques(row, &changes);
        sides.turn::<FIXED, P>(row, [of_a + tangent_arms[0] * change, of_b + tangent_arms[1] * change]);
        let x = sum * row.normal_x + change * row.normal_y;
        let y = sum * row.normal_y - change * row.normal_x;
        sides.store::<FIXED, P>(row, hot, false, [x, y, ZERO]);
    });
}

/// Notes how fast things that bounce approach each other, before the step. Answers whether some come faster than the threshold,
/// and may bounce in this step.
#[inline(always)]
pub(super) fn note_approach<const FIXED: bool, const P: usize, R: Contacts<P>>(
    rows: &mut Colours<R>,
    hot: &[Hot],
    threshold: f32,
) -> bool {
    let (threshold, mut may_bounce) = (f32x4::splat(-threshold), ZERO);
    rows.for_each(|contacts| {
        let bounces = contacts.row().restitution.simd_gt(ZERO);
        if bounces.to_bitmask() == 0 {
            return;
        }
        let sides = velocities::<FIXED, P>(contacts.row(), hot);
        let approach = at_points::<FIXED, P, R>(contacts, &sides);
        let row = contacts.row_mut();
        row.approach = approach;
        (row.gap, row.has_pushed) = (row.points.map(|point| point.separation), [ZERO; P]);
        approach.into_iter().for_each(|approach| may_bounce |= threshold.simd_gt(approach) & bounces);
    });
    may_bounce.to_bitmask() != 0
}

/// Notes which points push: at the end of the step one that has separated two may have no impulse any more.
#[inline(always)]
pub(super) fn note_push<const P: usize, R: Contacts<P>>(rows: &mut Colours<R>) {
    rows.for_each(|contacts| {
        let row = contacts.row_mut();
        for at in 0..P {
            row.has_pushed[at] |= row.points[at].impulse.simd_gt(ZERO);
        }
    });
}

/// After the step: what came fast enough and was pushed leaves as fast as its restitution says. Tells for each block that
/// did which of its lanes.
#[inline(always)]
pub(super) fn bounce<const FIXED: bool, const P: usize, R: Contacts<P>>(
    rows: &mut Colours<R>,
    hot: &mut [Hot],
    threshold: f32,
    mut bounced: impl FnMut(&R, u32, &mut [Hot]),
) {
    let threshold = f32x4::splat(-threshold);
    rows.for_each(|contacts| {
        let row = contacts.row();
        let restitution = std::array::from_fn::<f32x4, P, _>(|at| {
            let is_due = threshold.simd_gt(row.approach[at]) & row.has_pushed[at];
            row.restitution & is_due
        });
        let due = restitution.iter().fold(0, |due, e| due | e.simd_gt(ZERO).to_bitmask());
        if due == 0 {
            return;
        }
        let mut sides = velocities::<FIXED, P>(row, hot);
        let mut velocity = at_points::<FIXED, P, R>(contacts, &sides);
        let row = contacts.row_mut();
        let coupling = coupling::<FIXED, P>(row);
        let (mut sum, mut changes) = (ZERO, [ZERO; P]);
        let weights = std::array::from_fn(|at| row.points[at].mass);
        let excess = |at: usize| velocity[at] + restitution[at] * row.approach[at];
        let lost = std::array::from_fn(|at| weights[at] * excess(at));
        let (hold, both) = both_at_once::<P, R>(row, coupling, &weights, &lost);
        let hold = restitution.iter().fold(hold, |hold, e| hold & e.simd_gt(ZERO));
        for (at, restitution) in restitution.into_iter().enumerate() {
            let point = row.points[at];
            let wanted = velocity[at] + restitution * row.approach[at];
            let impulse = select(hold, both[at], positive(point.impulse - point.mass * wanted));
            changes[at] = (impulse - point.impulse) & restitution.simd_gt(ZERO);
            row.points[at].impulse = point.impulse + changes[at];
            sum += changes[at];
            velocity[P - 1] += coupling * changes[at];
        }
        sides.turn::<FIXED, P>(row, torques(row, &changes));
        sides.store_normal::<FIXED, P, R>(contacts, hot, sum);
        bounced(contacts, due, hot);
    });
}

/// Normals and separations of circles that touch each other, all at once: there is nothing to clip. Tells the pairs that are
/// further apart than contacts reach.
#[inline(always)]
pub(super) fn renew_circles(
    rows: &mut Colours<Row<1>>,
    poses: &[[f32; 4]],
    circles: &[[f32; 4]],
    reach: f32,
    mut apart: impl FnMut(u32),
) {
    rows.for_each(|row| {
        let gone = renew_row(row, poses, circles, reach);
        for lane in (0..4).filter(|lane| gone >> lane & 1 == 1 && row.b[*lane] != 0) {
            apart(row.pair[lane]);
        }
    });
}

/// The same for one that is solved with its island, if both are circles. Answers whether they are further apart than contacts reach.
pub(super) fn renew_circle(
    lane: &mut Lane,
    poses: &[[f32; 4]],
    circles: &[[f32; 4]],
    reach: f32,
) -> Option<bool> {
    let is_round = |body: u32| circles.get(body as usize).is_some_and(|circle| circle[3] > 0.0);
    if !(is_round(lane.a) && is_round(lane.b)) {
        return None;
    }
    let mut row = Row::<1>::default();
    row.set_lane(0, lane);
    let gone = renew_row(&mut row, poses, circles, reach);
    *lane = row.lane(0);
    Some(gone & 1 == 1)
}

/// Answers by bits which of four are further apart than contacts reach.
#[inline(always)]
fn renew_row(row: &mut Row<1>, poses: &[[f32; 4]], circles: &[[f32; 4]], reach: f32) -> u32 {
    let [_, _, radius_a, is_round_a] = gather(circles, &row.a);
    let [_, _, radius_b, is_round_b] = gather(circles, &row.b);
    let are_round = (is_round_a * is_round_b).simd_gt(ZERO);
    if are_round.to_bitmask() == 0 {
        return 0;
    }
    let [ax, ay, _, _] = gather(poses, &row.a);
    let [bx, by, _, _] = gather(poses, &row.b);
    let (dx, dy) = (bx - ax, by - ay);
    let squared = dx * dx + dy * dy;
    let is_far = squared.simd_gt(f32x4::splat(f32::MIN_POSITIVE));
    let distance = squared.sqrt();
    let inverse = f32x4::splat(1.0) / select(is_far, distance, f32x4::splat(1.0));
    let separation = distance - radius_a - radius_b;
    let half = f32x4::splat(0.5) * separation;
    row.normal_x = select(are_round, dx * inverse, row.normal_x);
    row.normal_y = select(are_round, select(is_far, dy * inverse, f32x4::splat(1.0)), row.normal_y);
    row.points[0].separation = select(are_round, separation, row.points[0].separation);
    row.tangent_arm_a = select(are_round, ZERO - (radius_a + half), row.tangent_arm_a);
    row.tangent_arm_b = select(are_round, radius_b + half, row.tangent_arm_b);
    (separation.simd_gt(f32x4::splat(reach)) & are_round).to_bitmask()
}
