//! What contacts in three axes do to velocities: friction, and what acts again at the beginning of a step. What they do along
//! their normals is what those of the plane do.
//!
//! Friction is Coulomb's: an impulse in a disc across the normal, whose radius follows the load. Where things stick both
//! tangents are solved as a block. Where that is too much they slide: then the impulse is against the slip. To cut the answer
//! of the block to size would turn it aside where things turn more easily one way than the other.

use wide::f32x4;

use super::rows::SpaceRow;
use crate::math::lanes::{greater, select, smaller};
use crate::precise::bodies::Hot;
use crate::precise::passes::{
    Relaxed, Sides, learn, learn_beside_joints, relax_normals, torques, turning_of, velocities,
};
use crate::precise::rows::{Colours, Point, Row};
use crate::precise::tuning::Learning;

const ZERO: f32x4 = f32x4::ZERO;

/// A ball's turning about x and y, and what contacts do to it in a substep.
#[derive(Debug, Clone, Copy, Default)]
pub(in crate::precise) struct Spin {
    pub(super) velocity: [f32; 4],
    pub(super) warm: [f32; 4],
    pub(super) begun: [f32; 4],
}

/// Turning about x and y of both sides of four rows.
struct Spins {
    a: [f32x4; 2],
    b: [f32x4; 2],
}

fn spins_of<const FIXED: bool, const P: usize>(row: &Row<P>, spins: &[Spin]) -> Spins {
    let columns = |bodies: &[u32; 4]| {
        let [x, y, ..] = f32x4::transpose(bodies.map(|body| f32x4::new(spins[body as usize].velocity)));
        [x, y]
    };
    Spins { a: if FIXED { [ZERO; 2] } else { columns(&row.a) }, b: columns(&row.b) }
}

impl Spins {
    /// What they add to the velocities along both tangents.
    #[inline(always)]
    fn slip<const FIXED: bool, const P: usize>(&self, contacts: &SpaceRow<P>) -> [f32x4; 2] {
        let SpaceRow { tangent: [tx, ty], across: [ux, uy, _], radius_a, radius_b, .. } = contacts;
        let one = |[x, y]: [f32x4; 2], radius: f32x4| {
            [ZERO - radius * (x * *ux + y * *uy), radius * (x * *tx + y * *ty)]
        };
        let [along, across] = one(self.b, *radius_b);
        if FIXED {
            return [along, across];
        }
        let of_a = one(self.a, *radius_a);
        [along + of_a[0], across + of_a[1]]
    }
}

/// How impulses along the tangents turn a ball about x and y.
#[inline(always)]
fn spun<const P: usize>(
    contacts: &SpaceRow<P>,
    radius: f32x4,
    inertia: f32x4,
    [along, across]: [f32x4; 2],
) -> [f32x4; 2] {
    let weight = inertia * radius;
    let SpaceRow { tangent, across: second, .. } = contacts;
    [0, 1].map(|axis| weight * (across * tangent[axis] - along * second[axis]))
}

/// The velocities along both tangents.
#[inline(always)]
fn slips<const FIXED: bool, const P: usize>(
    contacts: &SpaceRow<P>,
    sides: &Sides,
    spins: &[Spin],
) -> [f32x4; 2] {
    let ([x, y, z], row) = (sides.apart::<FIXED>(), &contacts.row);
    let ([tx, ty], [ux, uy, uz]) = (contacts.tangent, contacts.across);
    let along = x * tx + y * ty + sides.turning::<FIXED>(row.tangent_arm_a, row.tangent_arm_b);
    let across =
        x * ux + y * uy + z * uz + sides.turning::<FIXED>(contacts.across_arm_a, contacts.across_arm_b);
    if P == 2 {
        return [along, across];
    }
    let of_spins = spins_of::<FIXED, P>(row, spins).slip::<FIXED, P>(contacts);
    [along + of_spins[0], across + of_spins[1]]
}

/// Changes what a ball turns about x and y.
#[inline(always)]
fn add_spins<const FIXED: bool, const P: usize>(
    contacts: &SpaceRow<P>,
    spins: &mut [Spin],
    impulses: [f32x4; 2],
    field: impl Fn(&mut Spin) -> &mut [f32; 4],
) {
    let row = &contacts.row;
    let mut add = |bodies: &[u32; 4], [x, y]: [f32x4; 2]| {
        for (&body, change) in bodies.iter().zip(f32x4::transpose([x, y, ZERO, ZERO])) {
            let spin = field(&mut spins[body as usize]);
            *spin = (f32x4::new(*spin) + change).to_array();
        }
    };
    if !FIXED {
        add(&row.a, spun(contacts, contacts.radius_a, row.inverse_inertia_a, impulses));
    }
    add(&row.b, spun(contacts, contacts.radius_b, row.inverse_inertia_b, impulses));
}

/// An impulse along normal and tangents, as x, y and z.
#[inline(always)]
fn pushed<const P: usize>(contacts: &SpaceRow<P>, load: f32x4, [along, across]: [f32x4; 2]) -> [f32x4; 3] {
    let row = &contacts.row;
    let ([tx, ty], [ux, uy, uz]) = (contacts.tangent, contacts.across);
    [
        load * row.normal_x + along * tx + across * ux,
        load * row.normal_y + along * ty + across * uy,
        load * contacts.normal_z + across * uz,
    ]
}

/// One pass over normals and friction as hard rows: see [`relax`](crate::precise::passes::relax).
#[inline(always)]
pub(in crate::precise) fn relax_in_space<const FIXED: bool, const P: usize>(
    rows: &mut Colours<SpaceRow<P>>,
    hot: &mut [Hot],
    spins: &mut [Spin],
    inverse_h: f32,
) {
    let inverse_h = f32x4::splat(inverse_h);
    rows.for_each(|contacts| {
        let Relaxed { mut sides, sum, changes, load } =
            relax_normals::<FIXED, P, _>(contacts, hot, inverse_h);
        let [mut along, mut across] = slips::<FIXED, P>(contacts, &sides, spins);
        let row = &contacts.row;
        let arms = [row.tangent_arm_a, row.tangent_arm_b];
        let across_arms = [contacts.across_arm_a, contacts.across_arm_b];
        for (point, change) in row.points.iter().zip(changes) {
            along += turning_of::<FIXED, P>(row, point.arms(), arms) * change;
            across += turning_of::<FIXED, P>(row, point.arms(), across_arms) * change;
        }
        let slip = [along - row.tangent_speed, across - contacts.across_speed];
        let most = row.friction * load;
        let [change, change_across] = rub(contacts, slip, most);
        let [of_a, of_b] = torques(&contacts.row, &changes);
        sides.turn::<FIXED, P>(
            &contacts.row,
            [
                of_a + arms[0] * change + across_arms[0] * change_across,
                of_b + arms[1] * change + across_arms[1] * change_across,
            ],
        );
        if P == 2 {
            twist::<FIXED, P>(contacts, &mut sides, most);
        } else {
            add_spins::<FIXED, P>(contacts, spins, [change, change_across], |spin| &mut spin.velocity);
        }
        contacts.count(|total, impulse| total + impulse);
        let impulse = pushed(contacts, sum, [change, change_across]);
        sides.store::<FIXED, P>(&contacts.row, hot, true, impulse);
    });
}

/// Friction of at most so much against this slip. Answers what was added to the impulses along the tangents.
#[inline(always)]
fn rub<const P: usize>(contacts: &mut SpaceRow<P>, [along, across]: [f32x4; 2], most: f32x4) -> [f32x4; 2] {
    let [k11, k12, k22] = contacts.block;
    let (old, old_across) = (contacts.row.tangent_impulse, contacts.across_impulse);
    let stuck = [old - (k11 * along + k12 * across), old_across - (k12 * along + k22 * across)];
    let slid = [old - contacts.slide_mass * along, old_across - contacts.slide_mass * across];
    let squared = |[x, y]: [f32x4; 2]| x * x + y * y;
    let sticks = squared(stuck).simd_le(most * most);
    let size = squared(slid).sqrt();
    let has_size = size.simd_gt(most);
    let cut = select(has_size, most / select(has_size, size, f32x4::splat(1.0)), f32x4::splat(1.0));
    let new = [0, 1].map(|tangent| select(sticks, stuck[tangent], slid[tangent] * cut));
    (contacts.row.tangent_impulse, contacts.across_impulse) = (new[0], new[1]);
    [new[0] - old, new[1] - old_across]
}

/// Faces that press along the depth axis keep each other from turning.
#[inline(always)]
fn twist<const FIXED: bool, const P: usize>(contacts: &mut SpaceRow<P>, sides: &mut Sides, most: f32x4) {
    let most = most * contacts.spread;
    let turning = if FIXED { sides.b[2] } else { sides.b[2] - sides.a[2] };
    let old = contacts.twist_impulse;
    let new = greater(smaller(old - contacts.twist_mass * turning, most), ZERO - most);
    contacts.twist_impulse = new;
    sides.turn::<FIXED, P>(&contacts.row, [new - old; 2]);
}

/// Sums what the impulses of all rows do in a substep; on the way springs learn: see
/// [`gather_warm`](crate::precise::passes::gather_warm).
#[inline(always)]
pub(in crate::precise) fn gather_warm_in_space<const FIXED: bool, const P: usize>(
    rows: &mut Colours<SpaceRow<P>>,
    warm: &mut [[f32; 4]],
    hot: &[Hot],
    spins: &mut [Spin],
    (learning, masks): (&Learning, Option<&[u32]>),
) {
    rows.for_each(|contacts| {
        let sides = velocities::<FIXED, P>(&contacts.row, hot);
        let [along, across] = slips::<FIXED, P>(contacts, &sides, spins);
        let slip = [along - contacts.row.tangent_speed, across - contacts.across_speed];
        let speed = (slip[0] * slip[0] + slip[1] * slip[1]).sqrt();
        match masks {
            None => learn::<FIXED, P, _>(contacts, &sides, speed, learning),
            Some(masks) => learn_beside_joints::<FIXED, P, _>(contacts, &sides, speed, learning, masks),
        }
        contacts.totals = [ZERO; 4];
        let row = &contacts.row;
        let sum = |of: fn(&Point) -> f32x4| {
            row.points[1..].iter().fold(of(&row.points[0]), |sum, point| sum + of(point))
        };
        let tangential = [row.tangent_impulse, contacts.across_impulse];
        let turn = |of_points: f32x4, arm: f32x4, across_arm: f32x4| {
            of_points + tangential[0] * arm + tangential[1] * across_arm + contacts.twist_impulse
        };
        let turn_a = turn(sum(|p| p.impulse * p.arm_a), row.tangent_arm_a, contacts.across_arm_a);
        let turn_b = turn(sum(|p| p.impulse * p.arm_b), row.tangent_arm_b, contacts.across_arm_b);
        let [x, y, z] = pushed(contacts, sum(|point| point.impulse), tangential);
        let mut add = |bodies: &[u32; 4], columns: [f32x4; 4]| {
            for (&body, change) in bodies.iter().zip(f32x4::transpose(columns)) {
                let sum = &mut warm[body as usize];
                *sum = (f32x4::new(*sum) + change).to_array();
            }
        };
        if !FIXED {
            let (mass, inertia) = (ZERO - row.inverse_mass_a, ZERO - row.inverse_inertia_a);
            add(&row.a, [mass * x, mass * y, inertia * turn_a, mass * z]);
        }
        let mass = row.inverse_mass_b;
        add(&row.b, [mass * x, mass * y, row.inverse_inertia_b * turn_b, mass * z]);
        if P == 1 {
            add_spins::<FIXED, P>(contacts, spins, tangential, |spin| &mut spin.warm);
        }
    });
}

/// A substep begins: what contacts do to the turning of balls acts again.
pub(in crate::precise) fn begin_spins(spins: &mut [Spin], is_first: bool) {
    for spin in spins {
        let velocity = f32x4::new(spin.velocity);
        if !is_first {
            spin.warm = (f32x4::new(spin.warm) + (velocity - f32x4::new(spin.begun))).to_array();
        }
        spin.begun = (velocity + f32x4::new(spin.warm)).to_array();
        spin.velocity = spin.begun;
    }
}
