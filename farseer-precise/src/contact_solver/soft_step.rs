//! Iterative contact solver: soft contact constraints in substeps, four constraints per SIMD block.
//!
//! | function | once per | method |
//! |---|---|---|
//! | `accumulate_warm_start` | step | warm start: accumulated impulses act again in each substep; load adaptation |
//! | `solve_with_bias` | substep | normal rows as soft constraints with a bias velocity |
//! | `relax` | substep, after positions | relaxation: rigid normal rows without bias, then friction |
//! | `apply_restitution` | step | restitution |
//!
//! The scheme is that of E. Catto, "Solver2D" (2024; the solver `Soft Step` of Box2D 3) and "Soft Constraints" (GDC 2011), on
//! the substeps of M. Macklin et al., "Small Steps in Physics Simulation" (2019).
//!
//! **Load adaptation** is our addition. A soft constraint that carries a load sags: its penetration is proportional to the
//! load, and no number of iterations removes it. Here each contact point has a rest impulse l0, which it carries without
//! penetration: the spring releases `impulse_scale * (l - l0)` of the accumulated impulse l, in place of `impulse_scale * l`.
//! Once per step l0 follows the load slowly, and only while the contact hardly moves (`adapt_load`). It acts like the
//! integral term of a controller. l0 rises to 40 % of the load, and falls only when it exceeds the load. That removes 40 % of the sag and adds
//! no stiffness. The other 60 % of the load stay on the spring, so that contacts deep in a pile stay closed. A contact that
//! comes from the direct solver may begin with its whole load as l0, and hardly sags then.
//!
//! Let n be the normal from A to B, t = (n.y, -n.x) the tangent and r the arm of a point, the vector from the centre of mass to
//! it. The Jacobian of a normal row gives the relative velocity `(vB - vA) . n + wB (rB x n) - wA (rA x n)`. The friction row
//! has t in place of n, and the mean arm of the points.
//!
//! `FIXED` means that A is static: its velocity is neither read nor written. `P` is the number of points per constraint.

use crate::index::{BodyIndex, DenseIndex, PairIndex};
use crate::parameters::contacts::BLOCK_MIN_RELATIVE_DETERMINANT;
use wide::f32x4;

use crate::bodies::MotionState;
use crate::constraint_graph::{
    ColorSet, ContactConstraint, ContactConstraintSimd, ContactPointSimd, SimdContacts, SimdSlot,
};
use crate::math::lanes::{gather, greater, positive, select, smaller};
use crate::scaled_parameters::{LoadAdaptation, Softness};

const ZERO: f32x4 = f32x4::ZERO;

/// Parameters of the contact constraints that all substeps of a step share.
#[derive(Debug, Clone, Copy)]
pub(crate) struct ContactSubstep {
    /// Reciprocal of the substep length, 1/s, > 0.
    pub(crate) inverse_h: f32,
    /// Greatest bias velocity that resolves penetration, length units/s, > 0.
    pub(crate) max_bias_speed: f32,
    /// Whether each solve sets [`was_active`](ContactConstraintSimd::was_active) of the points that have a normal impulse then:
    /// after the step the impulse of a point that has separated the bodies may be 0 again. [`apply_restitution`] reads it.
    pub(crate) records_active_points: bool,
}

/// Velocities, or displacements, of the bodies A and B of four constraints: x, y, rotation and z, one lane per constraint.
/// Velocities: length units/s and radians/s. Displacements: length units and radians.
pub(crate) struct PairVelocities {
    pub(crate) a: [f32x4; 4],
    pub(crate) b: [f32x4; 4],
}

/// Returns the velocities of both bodies of each lane from `states`: x, y (length units/s), angular velocity (radians/s), z
/// (length units/s).
#[inline(always)]
pub(crate) fn load_velocities<const FIXED: bool, const P: usize>(
    constraint: &ContactConstraintSimd<P>,
    states: &[MotionState],
) -> PairVelocities {
    gather_pair::<FIXED, P>(constraint, |body| states[body.position()].velocity)
}

/// Returns the displacements of both bodies of each lane in the last substep from `states`: x, y (length units), rotation
/// (radians), z (length units).
#[inline(always)]
pub(crate) fn load_displacements<const FIXED: bool, const P: usize>(
    constraint: &ContactConstraintSimd<P>,
    states: &[MotionState],
) -> PairVelocities {
    gather_pair::<FIXED, P>(constraint, |body| states[body.position()].displacement)
}

/// Returns the four components that `of` gives for each body index, transposed to one lane per constraint; 0 for A if `FIXED`.
#[inline(always)]
fn gather_pair<const FIXED: bool, const P: usize>(
    constraint: &ContactConstraintSimd<P>,
    of: impl Fn(BodyIndex) -> [f32; 4],
) -> PairVelocities {
    let columns = |bodies: &[BodyIndex; 4]| f32x4::transpose(bodies.map(|body| f32x4::new(of(body))));
    PairVelocities { a: if FIXED { [ZERO; 4] } else { columns(&constraint.a) }, b: columns(&constraint.b) }
}

impl PairVelocities {
    /// Returns the linear velocity of B relative to A along the normal, without the angular part, length units/s.
    #[inline(always)]
    fn relative_normal_velocity<const FIXED: bool, const P: usize, R: SimdContacts<P>>(
        &self,
        contacts: &R,
    ) -> f32x4 {
        let ([x, y, z], constraint) = (self.relative_linear_velocity::<FIXED>(), contacts.constraint());
        let in_plane = x * constraint.normal_x + y * constraint.normal_y;
        if R::IS_3D { in_plane + z * contacts.normal_z() } else { in_plane }
    }

    /// Returns the linear velocity of B relative to A along the tangent (n.y, -n.x), without the angular part, length units/s.
    #[inline(always)]
    fn relative_tangent_velocity<const FIXED: bool, const P: usize>(
        &self,
        constraint: &ContactConstraintSimd<P>,
    ) -> f32x4 {
        let [x, y, _] = self.relative_linear_velocity::<FIXED>();
        x * constraint.normal_y - y * constraint.normal_x
    }

    /// Returns the linear velocity of B relative to A: x, y, z in length units/s.
    #[inline(always)]
    pub(crate) fn relative_linear_velocity<const FIXED: bool>(&self) -> [f32x4; 3] {
        let ([ax, ay, _, az], [bx, by, _, bz]) = (self.a, self.b);
        if FIXED { [bx, by, bz] } else { [bx - ax, by - ay, bz - az] }
    }

    /// Returns the contribution wB * arm_b - wA * arm_a of both angular velocities to the velocity of B relative to A, length
    /// units/s. `arm_a`, `arm_b`: cross products of the arm with the direction of a row, length units.
    #[inline(always)]
    pub(crate) fn relative_angular_velocity<const FIXED: bool>(&self, arm_a: f32x4, arm_b: f32x4) -> f32x4 {
        if FIXED { self.b[2] * arm_b } else { self.b[2] * arm_b - self.a[2] * arm_a }
    }

    /// Changes the angular velocities of both bodies: adds the angular impulse `of_b` to B and subtracts `of_a` from A, mass
    /// units * length units^2/s.
    #[inline(always)]
    pub(crate) fn apply_angular_impulses<const FIXED: bool, const P: usize>(
        &mut self,
        constraint: &ContactConstraintSimd<P>,
        [of_a, of_b]: [f32x4; 2],
    ) {
        if !FIXED {
            self.a[2] -= constraint.inverse_inertia_a * of_a;
        }
        self.b[2] += constraint.inverse_inertia_b * of_b;
    }

    /// Writes the velocities to `states`, changed by the impulse `along` in the direction of the normal on B and the opposite
    /// impulse on A, mass units * length units/s.
    #[inline(always)]
    fn store_with_normal_impulse<const FIXED: bool, const P: usize, R: SimdContacts<P>>(
        &self,
        contacts: &R,
        states: &mut [MotionState],
        along: f32x4,
    ) {
        let constraint = contacts.constraint();
        let z = if R::IS_3D { along * contacts.normal_z() } else { ZERO };
        self.store_with_impulse::<FIXED, P>(
            constraint,
            states,
            R::IS_3D,
            [along * constraint.normal_x, along * constraint.normal_y, z],
        );
    }

    /// Writes the velocities to `states`, changed by the impulse (x, y, z) on B and the opposite impulse on A, mass units *
    /// length units/s.
    #[inline(always)]
    pub(crate) fn store_with_impulse<const FIXED: bool, const P: usize>(
        &self,
        constraint: &ContactConstraintSimd<P>,
        states: &mut [MotionState],
        is_in_space: bool,
        [x, y, z]: [f32x4; 3],
    ) {
        let mut put = |bodies: &[BodyIndex; 4], [vx, vy, turn, vz]: [f32x4; 4]| {
            let rows = f32x4::transpose([vx, vy, turn, if is_in_space { vz } else { ZERO }]);
            for (&body, velocity) in bodies.iter().zip(rows) {
                states[body.position()].velocity = velocity.to_array();
            }
        };
        let ([ax, ay, turn_a, az], [bx, by, turn_b, bz]) = (self.a, self.b);
        if !FIXED {
            let mass = constraint.inverse_mass_a;
            put(&constraint.a, [ax - mass * x, ay - mass * y, turn_a, az - mass * z]);
        }
        let mass = constraint.inverse_mass_b;
        put(&constraint.b, [bx + mass * x, by + mass * y, turn_b, bz + mass * z]);
    }
}

/// Returns the sum of the inverse masses of A and B, 1/mass units; that of B alone if `FIXED`.
#[inline(always)]
pub(crate) fn inverse_mass_sum<const FIXED: bool, const P: usize>(
    constraint: &ContactConstraintSimd<P>,
) -> f32x4 {
    if FIXED { constraint.inverse_mass_b } else { constraint.inverse_mass_a + constraint.inverse_mass_b }
}

/// Returns the angular part of J M^-1 J^T for two rows, 1/mass units: the velocity change of the second row by a unit impulse
/// of the first. By it the solver updates the velocity of the second row without a write to the bodies. The arguments are the
/// rows' arms about A and B, length units.
#[inline(always)]
pub(crate) fn angular_coupling<const FIXED: bool, const P: usize>(
    constraint: &ContactConstraintSimd<P>,
    [arm_a, arm_b]: [f32x4; 2],
    [other_a, other_b]: [f32x4; 2],
) -> f32x4 {
    let of_b = constraint.inverse_inertia_b * (arm_b * other_b);
    if FIXED { of_b } else { of_b + constraint.inverse_inertia_a * (arm_a * other_a) }
}

/// Returns the velocity of B relative to A along the normal at each point, length units/s; negative while they approach. For
/// displacements in place of velocities the unit is length units.
#[inline(always)]
pub(crate) fn normal_velocities<const FIXED: bool, const P: usize, R: SimdContacts<P>>(
    contacts: &R,
    pair_velocities: &PairVelocities,
) -> [f32x4; P] {
    let along = pair_velocities.relative_normal_velocity::<FIXED, P, R>(contacts);
    contacts.constraint().points.map(|point| {
        along + pair_velocities.relative_angular_velocity::<FIXED>(point.normal_arm_a, point.normal_arm_b)
    })
}

/// Returns the off-diagonal entry k12 of J M^-1 J^T for the normal rows of both points, 1/mass units.
#[inline(always)]
pub(crate) fn off_diagonal<const FIXED: bool, const P: usize>(
    constraint: &ContactConstraintSimd<P>,
) -> f32x4 {
    let [first, last] = [constraint.points[0].normal_arms(), constraint.points[P - 1].normal_arms()];
    inverse_mass_sum::<FIXED, P>(constraint) + angular_coupling::<FIXED, P>(constraint, first, last)
}

/// Returns the angular impulses about the centres of mass of A and B by the normal `impulses`: sums of impulse times arm over
/// the points, mass units * length units^2/s.
#[inline(always)]
pub(crate) fn angular_impulses<const P: usize>(
    constraint: &ContactConstraintSimd<P>,
    impulses: &[f32x4; P],
) -> [f32x4; 2] {
    let sum = |arm: fn(&ContactPointSimd) -> f32x4| {
        let rest = constraint.points[1..].iter().zip(&impulses[1..]);
        rest.fold(impulses[0] * arm(&constraint.points[0]), |sum, (point, &impulse)| {
            sum + impulse * arm(point)
        })
    };
    [sum(|point| point.normal_arm_a), sum(|point| point.normal_arm_b)]
}

/// Returns the absolute value of each lane.
#[inline(always)]
pub(crate) fn magnitude(number: f32x4) -> f32x4 {
    greater(number, ZERO - number)
}

/// Load adaptation: moves the rest impulses of the points towards their normal impulses. `speed`: tangential speed, length
/// units/s.
///
/// Rest impulses rise while the points penetrate and the sum of the rest impulses is below the adapted fraction of the load,
/// the sum of the normal impulses. The rate of rise decreases with the speed at the contact and is 0 from
/// `load_adaptation_speed` on. The sum of both points decides, since rocking only shifts load between the points. If a point
/// penetrates deeply, rest impulses do not rise, since they would press the bodies apart ever harder.
#[inline(always)]
pub(crate) fn adapt_load<const FIXED: bool, const P: usize, R: SimdContacts<P>>(
    contacts: &mut R,
    pair_velocities: &PairVelocities,
    mut speed: f32x4,
    adaptation: &LoadAdaptation,
) {
    for velocity in normal_velocities::<FIXED, P, R>(contacts, pair_velocities) {
        speed = greater(speed, magnitude(velocity));
    }
    let constraint = contacts.constraint_mut();
    let stillness = positive(f32x4::splat(1.0) - speed * f32x4::splat(adaptation.inverse_speed_limit));
    let up = f32x4::splat(adaptation.rise_rate) * stillness;
    let (adapted, down) = (f32x4::splat(adaptation.adapted_fraction), f32x4::splat(adaptation.fall_rate));
    let sum = |of: fn(&ContactPointSimd) -> f32x4| {
        constraint.points[1..].iter().fold(of(&constraint.points[0]), |sum, point| sum + of(point))
    };
    let (load, rest_impulse) = (sum(|point| point.normal_impulse), sum(|point| point.rest_impulse));
    let deepest = constraint.points[1..]
        .iter()
        .fold(constraint.points[0].separation, |least, p| smaller(least, p.separation));
    let is_sag = deepest.simd_lt(ZERO) & deepest.simd_gt(f32x4::splat(adaptation.min_separation));
    let rises = (adapted * load).simd_gt(rest_impulse) & is_sag & up;
    for point in &mut constraint.points {
        let missing = point.normal_impulse - point.rest_impulse;
        let excess = missing & missing.simd_lt(ZERO);
        point.rest_impulse = point.rest_impulse + rises * positive(missing) + down * excess;
    }
}

/// Returns a bit mask per lane: the union of the masks of both bodies. `masks`: mask of each body, by body index.
#[inline(always)]
fn body_mask<const FIXED: bool, const P: usize>(
    constraint: &ContactConstraintSimd<P>,
    masks: &[u32],
) -> f32x4 {
    let of = |body: BodyIndex| masks[body.position()];
    f32x4::new(std::array::from_fn(|lane| {
        f32::from_bits(of(constraint.b[lane]) | if FIXED { 0 } else { of(constraint.a[lane]) })
    }))
}

/// Runs [`adapt_load`] in a step in which some bodies have joints in the iterative solver (all bits of their `masks` are set).
/// Rest impulses at these bodies decay to 0: joints have no load adaptation, and a contact without sag would prevail over
/// joints.
///
/// Points of these bodies that separate after an impact lose their accumulated impulses. The impact acted on the whole
/// articulation, but a row knows only one body of it and would reduce its impulse by too little.
#[inline(never)]
pub(crate) fn adapt_load_with_joints<const FIXED: bool, const P: usize, R: SimdContacts<P>>(
    contacts: &mut R,
    pair_velocities: &PairVelocities,
    speed: f32x4,
    adaptation: &LoadAdaptation,
    masks: &[u32],
) {
    let mask = body_mask::<FIXED, P>(contacts.constraint(), masks);
    let kept = f32x4::splat(1.0 - adaptation.fall_rate);
    let decayed = contacts.constraint().points.map(|point| kept * point.rest_impulse);
    adapt_load::<FIXED, P, R>(contacts, pair_velocities, speed, adaptation);
    for (point, forgotten) in contacts.constraint_mut().points.iter_mut().zip(decayed) {
        point.rest_impulse = select(mask, forgotten, point.rest_impulse);
    }
    let constraint = contacts.constraint();
    if constraint.restitution.simd_gt(ZERO).to_bitmask() == 0 {
        return;
    }
    let may_leave = mask & constraint.restitution.simd_gt(ZERO);
    let velocities = normal_velocities::<FIXED, P, R>(contacts, pair_velocities);
    let constraint = contacts.constraint_mut();
    let mut leaves = may_leave;
    for (point, velocity) in constraint.points.iter_mut().zip(velocities) {
        let point_leaves = may_leave & velocity.simd_gt(f32x4::splat(adaptation.separation_speed));
        point.normal_impulse = select(point_leaves, ZERO, point.normal_impulse);
        leaves &= point_leaves;
    }
    constraint.tangent_impulse = select(leaves, ZERO, constraint.tangent_impulse);
}

/// Warm start: adds to `warm_start` of each body the velocity change per substep by the accumulated impulses of its contacts:
/// x, y (length units/s), angular velocity (radians/s), 0. Runs load adaptation before it. `masks`: for each body all bits set
/// if it has joints in the iterative solver, else 0; `None` if no body has.
///
/// With a `restitution_threshold` (length units/s) the constraints with restitution also store their approach velocities and
/// separations. Returns whether a point of them approaches faster than the threshold.
#[inline(always)]
pub(crate) fn accumulate_warm_start<const FIXED: bool, const P: usize>(
    constraints: &mut ColorSet<ContactConstraintSimd<P>>,
    warm_start: &mut [[f32; 4]],
    states: &[MotionState],
    (adaptation, masks): (&LoadAdaptation, Option<&[u32]>),
    restitution_threshold: Option<f32>,
) -> bool {
    let mut may_bounce = false;
    constraints.for_each(|constraint| {
        let pair_velocities = load_velocities::<FIXED, P>(constraint, states);
        if let Some(threshold) = restitution_threshold {
            may_bounce |= record_approach_velocity::<FIXED, P, _>(constraint, &pair_velocities, threshold);
        }
        let slip = pair_velocities.relative_tangent_velocity::<FIXED, P>(constraint)
            + pair_velocities
                .relative_angular_velocity::<FIXED>(constraint.tangent_arm_a, constraint.tangent_arm_b);
        let speed = magnitude(slip - constraint.tangent_speed);
        match masks {
            None => adapt_load::<FIXED, P, _>(constraint, &pair_velocities, speed, adaptation),
            Some(masks) => {
                adapt_load_with_joints::<FIXED, P, _>(constraint, &pair_velocities, speed, adaptation, masks)
            }
        }
        add_impulses::<FIXED, P>(constraint, warm_start);
    });
    may_bounce
}

/// Adds to `warm_start` of both bodies of each lane the velocity changes by the impulses of a block of constraints in the plane:
/// x, y (length units/s), angular velocity (radians/s), 0.
#[inline(always)]
fn add_impulses<const FIXED: bool, const P: usize>(
    constraint: &ContactConstraintSimd<P>,
    warm_start: &mut [[f32; 4]],
) {
    let sum = |of: fn(&ContactPointSimd) -> f32x4| {
        constraint.points[1..].iter().fold(of(&constraint.points[0]), |sum, point| sum + of(point))
    };
    let along = sum(|point| point.normal_impulse);
    let turn_a = sum(|point| point.normal_impulse * point.normal_arm_a)
        + constraint.tangent_impulse * constraint.tangent_arm_a;
    let turn_b = sum(|point| point.normal_impulse * point.normal_arm_b)
        + constraint.tangent_impulse * constraint.tangent_arm_b;
    let x = along * constraint.normal_x + constraint.tangent_impulse * constraint.normal_y;
    let y = along * constraint.normal_y - constraint.tangent_impulse * constraint.normal_x;
    if !FIXED {
        let (mass, inertia) = (ZERO - constraint.inverse_mass_a, ZERO - constraint.inverse_inertia_a);
        add_columns(warm_start, &constraint.a, [mass * x, mass * y, inertia * turn_a, ZERO]);
    }
    let (mass, inertia) = (constraint.inverse_mass_b, constraint.inverse_inertia_b);
    add_columns(warm_start, &constraint.b, [mass * x, mass * y, inertia * turn_b, ZERO]);
}

/// Adds four columns, one lane for each of four bodies, to the rows of these bodies.
#[inline(always)]
pub(crate) fn add_columns(rows: &mut [[f32; 4]], bodies: &[BodyIndex; 4], columns: [f32x4; 4]) {
    for (&body, change) in bodies.iter().zip(f32x4::transpose(columns)) {
        let sum = &mut rows[body.position()];
        *sum = (f32x4::new(*sum) + change).to_array();
    }
}

/// Solves all normal rows as soft constraints. Points with positive separation s are rigid rows u >= -s / h instead: they may
/// close the gap in this substep, and no more (speculative contacts).
#[inline(always)]
pub(crate) fn solve_with_bias<const FIXED: bool, const P: usize, R: SimdContacts<P>>(
    constraints: &mut ColorSet<R>,
    states: &mut [MotionState],
    substep: ContactSubstep,
    softness: Softness,
) {
    let softness = softness.splat();
    solve_soft_constraints::<FIXED, P, R>(constraints, states, substep, |_| softness);
}

/// Runs [`solve_with_bias`] with the second entry of `softness` for contacts of bodies with joints in the iterative solver,
/// whose entries of `masks` are set. All other contacts get the first entry.
#[inline(never)]
pub(crate) fn solve_with_joint_softness<const FIXED: bool, const P: usize, R: SimdContacts<P>>(
    constraints: &mut ColorSet<R>,
    states: &mut [MotionState],
    substep: ContactSubstep,
    softness: [Softness; 2],
    masks: &[u32],
) {
    let [other, jointed] = softness.map(|softness| softness.splat());
    solve_soft_constraints::<FIXED, P, R>(constraints, states, substep, |constraint| {
        let mask = body_mask::<FIXED, P>(constraint, masks);
        std::array::from_fn(|at| select(mask, jointed[at], other[at]))
    });
}

/// Solves the normal rows of all blocks as soft constraints. `softness` returns the coefficients for a block, in the form of
/// [`Softness::splat`].
#[inline(always)]
fn solve_soft_constraints<const FIXED: bool, const P: usize, R: SimdContacts<P>>(
    constraints: &mut ColorSet<R>,
    states: &mut [MotionState],
    substep: ContactSubstep,
    softness: impl Fn(&ContactConstraintSimd<P>) -> [f32x4; 3],
) {
    if constraints.used_colors == 0 {
        return;
    }
    constraints.for_each(|contacts| {
        let softness = softness(contacts.constraint());
        let mut pair_velocities = load_velocities::<FIXED, P>(contacts.constraint(), states);
        let mut velocity = normal_velocities::<FIXED, P, R>(contacts, &pair_velocities);
        let constraint = contacts.constraint_mut();
        let coupling = off_diagonal::<FIXED, P>(constraint);
        let (mut sum, mut changes) = (ZERO, [ZERO; P]);
        let (bias_losses, weights) = bias_and_weights(constraint, substep, softness);
        let losses = std::array::from_fn(|at| bias_losses[at] + weights[at] * velocity[at]);
        // In the plane only the relaxation uses the block solver.
        let (is_block, both) = if R::IS_3D {
            solve_two_point_block::<P, R>(constraint, coupling, &weights, &losses)
        } else {
            (ZERO, [ZERO; P])
        };
        for at in 0..P {
            let point = constraint.points[at];
            let alone = positive(point.normal_impulse - bias_losses[at] - weights[at] * velocity[at]);
            let impulse = select(is_block, both[at], alone);
            changes[at] = impulse - point.normal_impulse;
            constraint.points[at].normal_impulse = impulse;
            sum += changes[at];
            velocity[P - 1] += coupling * changes[at];
        }
        if substep.records_active_points {
            constraint.record_active_points();
        }
        pair_velocities
            .apply_angular_impulses::<FIXED, P>(constraint, angular_impulses(constraint, &changes));
        pair_velocities.store_with_normal_impulse::<FIXED, P, R>(contacts, states, sum);
    });
}

/// Returns for each normal row of a block of soft constraints the impulse that it loses, and its softened effective mass (mass
/// units). The loss (mass units * length units/s) is by the bias and by the leak towards the rest impulse.
#[inline(always)]
fn bias_and_weights<const P: usize>(
    constraint: &ContactConstraintSimd<P>,
    substep: ContactSubstep,
    [rate, mass, leak_fraction]: [f32x4; 3],
) -> ([f32x4; P], [f32x4; P]) {
    let one = f32x4::splat(1.0);
    let (inverse_h, fastest) = (f32x4::splat(substep.inverse_h), f32x4::splat(-substep.max_bias_speed));
    let (mut bias_losses, mut weights) = ([ZERO; P], [ZERO; P]);
    for at in 0..P {
        let point = constraint.points[at];
        let is_apart = point.separation.simd_gt(ZERO);
        let bias = select(is_apart, point.separation * inverse_h, greater(point.separation * rate, fastest));
        let leak = (leak_fraction * (point.normal_impulse - point.rest_impulse)) & !is_apart;
        bias_losses[at] = point.normal_mass * bias + leak;
        weights[at] = point.normal_mass * select(is_apart, one, mass);
    }
    (bias_losses, weights)
}

/// Block solver: solves both normal rows of a manifold at once. Returns the mask of the lanes to which the solution applies,
/// and the new accumulated normal impulse of each row, mass units * length units/s. `losses`: impulse that each row would lose
/// if it were solved alone, mass units * length units/s. `weights`: effective mass of each row, mass units. `coupling`: entry
/// k12 of J M^-1 J^T, 1/mass units.
///
/// Gauss-Seidel, one row after the other, leaves a relative error of (k12 * effective mass)^2 per sweep. Faces that meet flat
/// would rotate, and boxes at rest would rock.
///
/// The four cases of the linear complementarity problem (both rows active, one of them, none) are enumerated: the block solver
/// of Box2D 2 (`b2ContactSolver.cpp`, E. Catto and D. Gregorius). In the plane only the first case is solved: the other cases
/// are not worth their time.
#[inline(always)]
fn solve_two_point_block<const P: usize, R: SimdContacts<P>>(
    constraint: &ContactConstraintSimd<P>,
    coupling: f32x4,
    weights: &[f32x4; P],
    losses: &[f32x4; P],
) -> (f32x4, [f32x4; P]) {
    if P == 1 {
        return (ZERO, [ZERO; P]);
    }
    let (first, last) = (constraint.points[0].normal_impulse, constraint.points[P - 1].normal_impulse);
    let coupled_weights = [weights[0] * coupling, weights[P - 1] * coupling];
    let one = f32x4::splat(1.0);
    let determinant = one - coupled_weights[0] * coupled_weights[1];
    let is_well_conditioned = determinant.simd_gt(f32x4::splat(BLOCK_MIN_RELATIVE_DETERMINANT));
    let change =
        (coupled_weights[1] * losses[0] - losses[P - 1]) / select(is_well_conditioned, determinant, one);
    let both = [first - losses[0] - coupled_weights[0] * change, last + change];
    let both_active = both[0].simd_ge(ZERO) & both[1].simd_ge(ZERO);
    let mut solved = [both[1]; P];
    solved[0] = both[0];
    if !R::IS_3D {
        return (is_well_conditioned & both_active, solved);
    }
    let first_alone = positive(first - losses[0] + coupled_weights[0] * last);
    let last_alone = positive(last - losses[P - 1] + coupled_weights[1] * first);
    let is_enough = (losses[P - 1] + coupled_weights[1] * (first_alone - first) - last).simd_ge(ZERO);
    solved[P - 1] = select(both_active, both[1], select(is_enough, ZERO, last_alone));
    solved[0] = select(both_active, both[0], select(is_enough, first_alone, ZERO));
    (is_well_conditioned, solved)
}

/// Result of a relaxation of the normal rows of four constraints.
pub(crate) struct RelaxResult<const P: usize> {
    /// Velocities of both bodies before the relaxation: x, y (length units/s), angular velocity (radians/s), z (length
    /// units/s).
    pub(crate) velocities: PairVelocities,
    /// Sum of the changes of the normal impulses of all points, mass units * length units/s.
    pub(crate) impulse_change: f32x4,
    /// Change of the normal impulse of each point, mass units * length units/s.
    pub(crate) point_changes: [f32x4; P],
    /// Sum of the new normal impulses of all points, mass units * length units/s, >= 0.
    pub(crate) normal_impulse: f32x4,
}

/// Relaxation of the normal rows of four constraints: solves them as rigid rows, after updating the separations by the
/// displacements in the substep. The function does not write velocities to `states`; its callers do so after friction.
#[inline(always)]
pub(crate) fn relax_normals<const FIXED: bool, const P: usize, R: SimdContacts<P>>(
    contacts: &mut R,
    states: &[MotionState],
    substep: ContactSubstep,
) -> RelaxResult<P> {
    let inverse_h = f32x4::splat(substep.inverse_h);
    let moved = normal_velocities::<FIXED, P, R>(
        contacts,
        &load_displacements::<FIXED, P>(contacts.constraint(), states),
    );
    let pair_velocities = load_velocities::<FIXED, P>(contacts.constraint(), states);
    let mut velocity = normal_velocities::<FIXED, P, R>(contacts, &pair_velocities);
    let constraint = contacts.constraint_mut();
    let coupling = off_diagonal::<FIXED, P>(constraint);
    let mut separations = [ZERO; P];
    let mut due = velocity;
    for at in 0..P {
        separations[at] = constraint.points[at].separation + moved[at];
        due[at] = positive(separations[at]) * inverse_h + velocity[at];
    }
    let weights = std::array::from_fn(|at| constraint.points[at].normal_mass);
    let losses = std::array::from_fn(|at| weights[at] * due[at]);
    let (is_block, both) = solve_two_point_block::<P, R>(constraint, coupling, &weights, &losses);
    let mut impulses = both;
    if P == 1 || is_block.to_bitmask() != 0b1111 {
        for at in 0..P {
            let point = constraint.points[at];
            let kept = point.normal_impulse - point.normal_mass * (positive(separations[at]) * inverse_h);
            let alone = positive(kept - point.normal_mass * velocity[at]);
            impulses[at] = select(is_block, both[at], alone);
            velocity[P - 1] += coupling * (impulses[at] - point.normal_impulse);
        }
    }
    let result = store_relaxed(constraint, pair_velocities, separations, impulses);
    if substep.records_active_points {
        constraint.record_active_points();
    }
    result
}

/// Stores new separations (length units) and normal impulses (mass units * length units/s) in the points of a block. Returns the
/// result of the relaxation of its normal rows.
#[inline(always)]
fn store_relaxed<const P: usize>(
    constraint: &mut ContactConstraintSimd<P>,
    velocities: PairVelocities,
    separations: [f32x4; P],
    impulses: [f32x4; P],
) -> RelaxResult<P> {
    let (mut sum, mut load, mut changes) = (ZERO, ZERO, [ZERO; P]);
    for at in 0..P {
        let point = &mut constraint.points[at];
        changes[at] = impulses[at] - point.normal_impulse;
        point.separation = separations[at];
        point.normal_impulse = impulses[at];
        sum += changes[at];
        load += impulses[at];
    }
    RelaxResult { velocities, impulse_change: sum, point_changes: changes, normal_impulse: load }
}

/// Relaxation, after positions are integrated: solves normal rows and friction as rigid rows without bias, so that no velocity
/// that resolved penetration remains. The friction impulse is clamped to the friction limit, friction coefficient times normal
/// impulse.
#[inline(always)]
pub(crate) fn relax<const FIXED: bool, const P: usize>(
    constraints: &mut ColorSet<ContactConstraintSimd<P>>,
    states: &mut [MotionState],
    substep: ContactSubstep,
) {
    constraints.for_each(|constraint| {
        let RelaxResult {
            velocities: mut pair_velocities,
            impulse_change: sum,
            point_changes: changes,
            normal_impulse: load,
        } = relax_normals::<FIXED, P, _>(constraint, states, substep);
        let tangent_arms = [constraint.tangent_arm_a, constraint.tangent_arm_b];
        let mut slip = pair_velocities.relative_tangent_velocity::<FIXED, P>(constraint)
            + pair_velocities.relative_angular_velocity::<FIXED>(tangent_arms[0], tangent_arms[1]);
        for (point, change) in constraint.points.iter().zip(changes) {
            slip += angular_coupling::<FIXED, P>(constraint, point.normal_arms(), tangent_arms) * change;
        }
        let most = constraint.friction * load;
        let wanted = constraint.tangent_impulse - constraint.tangent_mass * (slip - constraint.tangent_speed);
        let friction = greater(smaller(wanted, most), ZERO - most);
        let change = friction - constraint.tangent_impulse;
        constraint.tangent_impulse = friction;
        let [of_a, of_b] = angular_impulses(constraint, &changes);
        pair_velocities.apply_angular_impulses::<FIXED, P>(
            constraint,
            [of_a + tangent_arms[0] * change, of_b + tangent_arms[1] * change],
        );
        let x = sum * constraint.normal_x + change * constraint.normal_y;
        let y = sum * constraint.normal_y - change * constraint.normal_x;
        pair_velocities.store_with_impulse::<FIXED, P>(constraint, states, false, [x, y, ZERO]);
    });
}

/// Stores the normal velocities and separations at the beginning of the step in a block of constraints with restitution, for
/// [`apply_restitution`]. Returns whether a point approaches faster than the restitution `threshold`, length units/s.
#[inline(always)]
pub(crate) fn record_approach_velocity<const FIXED: bool, const P: usize, R: SimdContacts<P>>(
    contacts: &mut R,
    pair_velocities: &PairVelocities,
    threshold: f32,
) -> bool {
    let bounces = contacts.constraint().restitution.simd_gt(ZERO);
    if bounces.to_bitmask() == 0 {
        return false;
    }
    let approach = normal_velocities::<FIXED, P, R>(contacts, pair_velocities);
    let constraint = contacts.constraint_mut();
    constraint.approach_velocity = approach;
    (constraint.initial_separation, constraint.was_active) =
        (constraint.points.map(|point| point.separation), [ZERO; P]);
    let threshold = f32x4::splat(-threshold);
    let may_bounce =
        approach.into_iter().fold(ZERO, |any, approach| any | (threshold.simd_gt(approach) & bounces));
    may_bounce.to_bitmask() != 0
}

/// Applies restitution after the step: points that approached faster than `threshold` (length units/s) and have had an impulse
/// get the velocity -restitution * approach velocity. Calls `on_bounce` with each block that has such points, the mask of the
/// lanes with such points, and `states`.
#[inline(always)]
pub(crate) fn apply_restitution<const FIXED: bool, const P: usize, R: SimdContacts<P>>(
    constraints: &mut ColorSet<R>,
    states: &mut [MotionState],
    threshold: f32,
    mut on_bounce: impl FnMut(&R, u32, &mut [MotionState]),
) {
    let threshold = f32x4::splat(-threshold);
    constraints.for_each(|contacts| {
        let constraint = contacts.constraint();
        let restitution = std::array::from_fn::<f32x4, P, _>(|at| {
            let is_due = threshold.simd_gt(constraint.approach_velocity[at]) & constraint.was_active[at];
            constraint.restitution & is_due
        });
        let due = restitution.iter().fold(0, |due, e| due | e.simd_gt(ZERO).to_bitmask());
        if due == 0 {
            return;
        }
        let mut pair_velocities = load_velocities::<FIXED, P>(constraint, states);
        let mut velocity = normal_velocities::<FIXED, P, R>(contacts, &pair_velocities);
        let constraint = contacts.constraint_mut();
        let coupling = off_diagonal::<FIXED, P>(constraint);
        let (mut sum, mut changes) = (ZERO, [ZERO; P]);
        let weights = std::array::from_fn(|at| constraint.points[at].normal_mass);
        let excess = |at: usize| velocity[at] + restitution[at] * constraint.approach_velocity[at];
        let losses = std::array::from_fn(|at| weights[at] * excess(at));
        let (is_block, both) = solve_two_point_block::<P, R>(constraint, coupling, &weights, &losses);
        let takes_block = restitution.iter().fold(is_block, |takes, e| takes & e.simd_gt(ZERO));
        for (at, restitution) in restitution.into_iter().enumerate() {
            let point = constraint.points[at];
            let wanted = velocity[at] + restitution * constraint.approach_velocity[at];
            let impulse =
                select(takes_block, both[at], positive(point.normal_impulse - point.normal_mass * wanted));
            changes[at] = (impulse - point.normal_impulse) & restitution.simd_gt(ZERO);
            constraint.points[at].normal_impulse = point.normal_impulse + changes[at];
            sum += changes[at];
            velocity[P - 1] += coupling * changes[at];
        }
        pair_velocities
            .apply_angular_impulses::<FIXED, P>(constraint, angular_impulses(constraint, &changes));
        pair_velocities.store_with_normal_impulse::<FIXED, P, R>(contacts, states, sum);
        on_bounce(contacts, due, states);
    });
}

/// Updates normals, separations and friction arms of all contacts between two circles. Calls `on_separation` with the index of
/// each pair whose separation exceeds `reach`, the speculative distance in length units.
#[inline(always)]
pub(crate) fn update_circle_contacts(
    constraints: &mut ColorSet<ContactConstraintSimd<1>>,
    poses: &[[f32; 4]],
    circles: &[[f32; 4]],
    reach: f32,
    mut on_separation: impl FnMut(PairIndex),
) {
    constraints.for_each(|constraint| {
        let separated = update_circle_lanes(constraint, poses, circles, reach);
        for lane in
            (0..4).filter(|lane| separated >> lane & 1 == 1 && constraint.b[*lane] != BodyIndex::PLACEHOLDER)
        {
            on_separation(constraint.pair[lane]);
        }
    });
}

/// Runs [`update_circle_contacts`] for one constraint in the direct solver. Returns whether the separation exceeds `reach`
/// (length units); `None` if one of the bodies is no circle.
pub(crate) fn update_circle_contact(
    lane: &mut ContactConstraint,
    poses: &[[f32; 4]],
    circles: &[[f32; 4]],
    reach: f32,
) -> Option<bool> {
    let is_round = |body: BodyIndex| circles.get(body.position()).is_some_and(|circle| circle[3] > 0.0);
    if !(is_round(lane.a) && is_round(lane.b)) {
        return None;
    }
    let mut constraint = ContactConstraintSimd::<1>::default();
    constraint.insert(0, lane);
    let separated = update_circle_lanes(&mut constraint, poses, circles, reach);
    *lane = constraint.extract(0);
    Some(separated & 1 == 1)
}

/// Updates normals, separations and friction arms of the contacts between two circles in a block. Returns the mask of the lanes
/// whose separation exceeds `reach`, in length units.
#[inline(always)]
fn update_circle_lanes(
    constraint: &mut ContactConstraintSimd<1>,
    poses: &[[f32; 4]],
    circles: &[[f32; 4]],
    reach: f32,
) -> u32 {
    let [_, _, radius_a, is_round_a] = gather(circles, &constraint.a);
    let [_, _, radius_b, is_round_b] = gather(circles, &constraint.b);
    let are_round = (is_round_a * is_round_b).simd_gt(ZERO);
    if are_round.to_bitmask() == 0 {
        return 0;
    }
    let [ax, ay, _, _] = gather(poses, &constraint.a);
    let [bx, by, _, _] = gather(poses, &constraint.b);
    let (dx, dy) = (bx - ax, by - ay);
    let squared = dx * dx + dy * dy;
    let is_far = squared.simd_gt(f32x4::splat(f32::MIN_POSITIVE));
    let distance = squared.sqrt();
    let inverse = f32x4::splat(1.0) / select(is_far, distance, f32x4::splat(1.0));
    let separation = distance - radius_a - radius_b;
    let half = f32x4::splat(0.5) * separation;
    constraint.normal_x = select(are_round, dx * inverse, constraint.normal_x);
    constraint.normal_y =
        select(are_round, select(is_far, dy * inverse, f32x4::splat(1.0)), constraint.normal_y);
    constraint.points[0].separation = select(are_round, separation, constraint.points[0].separation);
    constraint.tangent_arm_a = select(are_round, ZERO - (radius_a + half), constraint.tangent_arm_a);
    constraint.tangent_arm_b = select(are_round, radius_b + half, constraint.tangent_arm_b);
    (separation.simd_gt(f32x4::splat(reach)) & are_round).to_bitmask()
}
