//! Friction in three axes, and the warm start of contact constraints in three axes. Normal impulses are solved by the functions
//! of the plane in `contact_solver::soft_step`.
//!
//! Coulomb friction with a friction cone: the impulse along both tangents lies in a disc of radius mu * normal impulse. If the
//! contact sticks, both tangents are solved as one 2x2 block. If the block solution lies outside of the disc, the contact
//! slides, and the impulse opposes the slip velocity. Scaling the block solution down instead would deflect bodies that rotate
//! more easily about one axis.
//!
//! Reads and writes velocities, ball spins and accumulated impulses.

use wide::f32x4;

use crate::bodies::MotionState;
use crate::constraint_graph::{ColorSet, ContactConstraint3Simd, ContactConstraintSimd, ContactPointSimd};
use crate::contact_solver::load_adaptation::{adapt_load, adapt_load_with_joints};
use crate::contact_solver::pair_velocities::{
    PairVelocities, angular_coupling, angular_impulses, load_velocities,
};
use crate::contact_solver::restitution::record_approach_velocity;
use crate::contact_solver::soft_step::{ContactSubstep, RelaxResult, relax_normals};
use crate::contact_solver::warm_start::add_columns;
use crate::index::{BodyIndex, DenseIndex};
use crate::math::lanes::{greater, select, smaller};
use crate::scaled_parameters::LoadAdaptation;

/// Four SIMD lanes of 0.
const ZERO: f32x4 = f32x4::ZERO;

/// Angular velocity of a sphere about x and y, and its warm start.
#[derive(Debug, Clone, Copy, Default)]
pub(crate) struct BallSpin {
    /// Angular velocity about the world axes x and y in rad/s; components 2 and 3 are 0.
    pub(super) velocity: [f32; 4],
    /// Change of the angular velocity about x and y, in rad/s, that the warm start applies at the start of each substep.
    pub(super) warm_start: [f32; 4],
    /// Angular velocity about x and y after the warm start of the current substep, in rad/s. The next substep derives the
    /// effect of later impulses from it.
    pub(super) warm_started_velocity: [f32; 4],
}

/// Angular velocities about x and y, in rad/s, of bodies A and B of four constraints.
struct BallSpinsSimd {
    a: [f32x4; 2],
    b: [f32x4; 2],
}

/// Returns the angular velocities about x and y, in rad/s, of both bodies of four constraints; 0 for bodies A if these are
/// static (`FIXED`).
fn gather_spins<const FIXED: bool, const P: usize>(
    row: &ContactConstraintSimd<P>,
    spins: &[BallSpin],
) -> BallSpinsSimd {
    let columns = |bodies: &[BodyIndex; 4]| {
        let [x, y, ..] = f32x4::transpose(bodies.map(|body| f32x4::new(spins[body.position()].velocity)));
        [x, y]
    };
    BallSpinsSimd { a: if FIXED { [ZERO; 2] } else { columns(&row.a) }, b: columns(&row.b) }
}

impl BallSpinsSimd {
    /// Returns the velocity of B relative to A that rotation about x and y causes at the contact point, along the first and the
    /// second tangent, in length units/s.
    #[inline(always)]
    fn tangent_velocities<const FIXED: bool, const P: usize>(
        &self,
        contacts: &ContactConstraint3Simd<P>,
    ) -> [f32x4; 2] {
        let ContactConstraint3Simd {
            tangent: [tx, ty], second_tangent: [ux, uy, _], radius_a, radius_b, ..
        } = contacts;
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

/// Returns the change of a sphere's angular velocity about x and y, in rad/s, by impulses along both tangents. `inertia` is the
/// inverse moment of inertia, in 1/(mass units * length units^2).
#[inline(always)]
fn spin_change<const P: usize>(
    contacts: &ContactConstraint3Simd<P>,
    radius: f32x4,
    inertia: f32x4,
    [along, across]: [f32x4; 2],
) -> [f32x4; 2] {
    let weight = inertia * radius;
    let ContactConstraint3Simd { tangent, second_tangent: second, .. } = contacts;
    [0, 1].map(|axis| weight * (across * tangent[axis] - along * second[axis]))
}

/// Returns the velocity of B relative to A at the contact along the first and the second tangent, in length units/s.
#[inline(always)]
fn tangent_velocities<const FIXED: bool, const P: usize>(
    contacts: &ContactConstraint3Simd<P>,
    sides: &PairVelocities,
    spins: &[BallSpin],
) -> [f32x4; 2] {
    let ([x, y, z], row) = (sides.relative_linear_velocity::<FIXED>(), &contacts.planar);
    let ([tx, ty], [ux, uy, uz]) = (contacts.tangent, contacts.second_tangent);
    let along =
        x * tx + y * ty + sides.relative_angular_velocity::<FIXED>(row.tangent_arm_a, row.tangent_arm_b);
    let across = x * ux
        + y * uy
        + z * uz
        + sides
            .relative_angular_velocity::<FIXED>(contacts.second_tangent_arm_a, contacts.second_tangent_arm_b);
    if P == 2 {
        return [along, across];
    }
    let of_spins = gather_spins::<FIXED, P>(row, spins).tangent_velocities::<FIXED, P>(contacts);
    [along + of_spins[0], across + of_spins[1]]
}

/// Adds the change of angular velocity by tangent `impulses` (mass units * length units/s) to one vector of the `BallSpin` of
/// both bodies. `field` selects the vector: the velocity or the warm start.
#[inline(always)]
fn apply_spins<const FIXED: bool, const P: usize>(
    contacts: &ContactConstraint3Simd<P>,
    spins: &mut [BallSpin],
    impulses: [f32x4; 2],
    field: impl Fn(&mut BallSpin) -> &mut [f32; 4],
) {
    let row = &contacts.planar;
    let mut add = |bodies: &[BodyIndex; 4], [x, y]: [f32x4; 2]| {
        for (&body, change) in bodies.iter().zip(f32x4::transpose([x, y, ZERO, ZERO])) {
            let spin = field(&mut spins[body.position()]);
            *spin = (f32x4::new(*spin) + change).to_array();
        }
    };
    if !FIXED {
        add(&row.a, spin_change(contacts, contacts.radius_a, row.inverse_inertia_a, impulses));
    }
    add(&row.b, spin_change(contacts, contacts.radius_b, row.inverse_inertia_b, impulses));
}

/// Returns the impulse on body B along the world axes x, y and z, in mass units * length units/s. `load` is the impulse along
/// the normal, `along` and `across` are those along the first and the second tangent.
#[inline(always)]
fn impulse_vector<const P: usize>(
    contacts: &ContactConstraint3Simd<P>,
    load: f32x4,
    [along, across]: [f32x4; 2],
) -> [f32x4; 3] {
    let row = &contacts.planar;
    let ([tx, ty], [ux, uy, uz]) = (contacts.tangent, contacts.second_tangent);
    [
        load * row.normal_x + along * tx + across * ux,
        load * row.normal_y + along * ty + across * uy,
        load * contacts.normal_z + across * uz,
    ]
}

/// Relaxation in three axes: solves the normal rows and friction of all constraints without bias. `inverse_h` is 1 / substep,
/// in 1/s. See [`relax`](crate::contact_solver::soft_step::relax).
#[inline(always)]
pub(crate) fn relax_3d<const FIXED: bool, const P: usize>(
    rows: &mut ColorSet<ContactConstraint3Simd<P>>,
    states: &mut [MotionState],
    spins: &mut [BallSpin],
    substep: ContactSubstep,
) {
    rows.for_each(|contacts| {
        let RelaxResult {
            velocities: mut sides,
            impulse_change: sum,
            point_changes: changes,
            normal_impulse: load,
        } = relax_normals::<FIXED, P, _>(contacts, states, substep);
        let [mut along, mut across] = tangent_velocities::<FIXED, P>(contacts, &sides, spins);
        let row = &contacts.planar;
        let arms = [row.tangent_arm_a, row.tangent_arm_b];
        let across_arms = [contacts.second_tangent_arm_a, contacts.second_tangent_arm_b];
        for (point, change) in row.points.iter().zip(changes) {
            along += angular_coupling::<FIXED, P>(row, point.normal_arms(), arms) * change;
            across += angular_coupling::<FIXED, P>(row, point.normal_arms(), across_arms) * change;
        }
        let slip = [along - row.tangent_speed, across - contacts.second_surface_speed];
        let most = row.friction * load;
        let [change, change_across] = solve_friction(contacts, slip, most);
        let [of_a, of_b] = angular_impulses(&contacts.planar, &changes);
        sides.apply_angular_impulses::<FIXED, P>(
            &contacts.planar,
            [
                of_a + arms[0] * change + across_arms[0] * change_across,
                of_b + arms[1] * change + across_arms[1] * change_across,
            ],
        );
        if P == 2 {
            solve_twist_friction::<FIXED, P>(contacts, &mut sides, most);
        } else {
            apply_spins::<FIXED, P>(contacts, spins, [change, change_across], |spin| &mut spin.velocity);
        }
        contacts.accumulate_step_impulses(|total, impulse| total + impulse);
        let impulse = impulse_vector(contacts, sum, [change, change_across]);
        sides.store_with_impulse::<FIXED, P>(&contacts.planar, states, true, impulse);
    });
}

/// Solves friction at the slip velocity `[along, across]`, in length units/s, within the friction `limit`. Returns the changes
/// of the impulses along the first and the second tangent. Impulses are in mass units * length units/s.
#[inline(always)]
fn solve_friction<const P: usize>(
    contacts: &mut ContactConstraint3Simd<P>,
    [along, across]: [f32x4; 2],
    limit: f32x4,
) -> [f32x4; 2] {
    let [k11, k12, k22] = contacts.friction_mass;
    let (old, old_across) = (contacts.planar.tangent_impulse, contacts.second_tangent_impulse);
    let stuck = [old - (k11 * along + k12 * across), old_across - (k12 * along + k22 * across)];
    let slid = [old - contacts.sliding_mass * along, old_across - contacts.sliding_mass * across];
    let squared = |[x, y]: [f32x4; 2]| x * x + y * y;
    let sticks = squared(stuck).simd_le(limit * limit);
    let size = squared(slid).sqrt();
    let has_size = size.simd_gt(limit);
    let cut = select(has_size, limit / select(has_size, size, f32x4::splat(1.0)), f32x4::splat(1.0));
    let new = [0, 1].map(|tangent| select(sticks, stuck[tangent], slid[tangent] * cut));
    (contacts.planar.tangent_impulse, contacts.second_tangent_impulse) = (new[0], new[1]);
    [new[0] - old, new[1] - old_across]
}

/// Solves twist friction of two faces perpendicular to z: an angular impulse about z, at most the friction limit times the
/// radius of gyration of the contact patch.
#[inline(always)]
fn solve_twist_friction<const FIXED: bool, const P: usize>(
    contacts: &mut ContactConstraint3Simd<P>,
    sides: &mut PairVelocities,
    limit: f32x4,
) {
    let most = limit * contacts.pressure_radius;
    let turning = if FIXED { sides.b[2] } else { sides.b[2] - sides.a[2] };
    let old = contacts.twist_impulse;
    let new = greater(smaller(old - contacts.twist_mass * turning, most), ZERO - most);
    contacts.twist_impulse = new;
    sides.apply_angular_impulses::<FIXED, P>(&contacts.planar, [new - old; 2]);
}

/// Adds the velocity changes by the accumulated impulses of all constraints to `warm` (by body: x, y, rotation, z) and to
/// `BallSpin::warm_start`. Also performs load adaptation, stores approach velocities, and sets `step_impulses` to 0. See
/// [`accumulate_warm_start`](crate::contact_solver::warm_start::accumulate_warm_start).
#[inline(always)]
pub(crate) fn accumulate_warm_start_3d<const FIXED: bool, const P: usize>(
    rows: &mut ColorSet<ContactConstraint3Simd<P>>,
    warm: &mut [[f32; 4]],
    states: &[MotionState],
    spins: &mut [BallSpin],
    (adaptation, masks): (&LoadAdaptation, Option<&[u32]>),
    restitution_threshold: Option<f32>,
) -> bool {
    let mut may_bounce = false;
    rows.for_each(|contacts| {
        let sides = load_velocities::<FIXED, P>(&contacts.planar, states);
        if let Some(threshold) = restitution_threshold {
            may_bounce |= record_approach_velocity::<FIXED, P, _>(contacts, &sides, threshold);
        }
        let [along, across] = tangent_velocities::<FIXED, P>(contacts, &sides, spins);
        let slip = [along - contacts.planar.tangent_speed, across - contacts.second_surface_speed];
        let speed = (slip[0] * slip[0] + slip[1] * slip[1]).sqrt();
        match masks {
            None => adapt_load::<FIXED, P, _>(contacts, &sides, speed, adaptation),
            Some(masks) => adapt_load_with_joints::<FIXED, P, _>(contacts, &sides, speed, adaptation, masks),
        }
        contacts.step_impulses = [ZERO; 4];
        add_impulses_3d::<FIXED, P>(contacts, warm);
        if P == 1 {
            let tangential = [contacts.planar.tangent_impulse, contacts.second_tangent_impulse];
            apply_spins::<FIXED, P>(contacts, spins, tangential, |spin| &mut spin.warm_start);
        }
    });
    may_bounce
}

/// Adds to `warm` of both bodies of each lane the velocity changes by the impulses of a block of constraints in three axes: x, y
/// (length units/s), angular velocity (radians/s), z (length units/s).
#[inline(always)]
fn add_impulses_3d<const FIXED: bool, const P: usize>(
    contacts: &ContactConstraint3Simd<P>,
    warm: &mut [[f32; 4]],
) {
    let row = &contacts.planar;
    let sum = |of: fn(&ContactPointSimd) -> f32x4| {
        row.points[1..].iter().fold(of(&row.points[0]), |sum, point| sum + of(point))
    };
    let tangential = [row.tangent_impulse, contacts.second_tangent_impulse];
    let turn = |of_points: f32x4, arm: f32x4, across_arm: f32x4| {
        of_points + tangential[0] * arm + tangential[1] * across_arm + contacts.twist_impulse
    };
    let of_points = [sum(|p| p.normal_impulse * p.normal_arm_a), sum(|p| p.normal_impulse * p.normal_arm_b)];
    let turn_a = turn(of_points[0], row.tangent_arm_a, contacts.second_tangent_arm_a);
    let turn_b = turn(of_points[1], row.tangent_arm_b, contacts.second_tangent_arm_b);
    let [x, y, z] = impulse_vector(contacts, sum(|point| point.normal_impulse), tangential);
    if !FIXED {
        let (mass, inertia) = (ZERO - row.inverse_mass_a, ZERO - row.inverse_inertia_a);
        add_columns(warm, &row.a, [mass * x, mass * y, inertia * turn_a, mass * z]);
    }
    let mass = row.inverse_mass_b;
    add_columns(warm, &row.b, [mass * x, mass * y, row.inverse_inertia_b * turn_b, mass * z]);
}

/// Start of a substep: applies the warm start to ball spins. From the second substep on (`is_first` is false) the warm start
/// also includes the change of angular velocity that impulses caused in the preceding substep.
pub(crate) fn apply_spin_warm_start(spins: &mut [BallSpin], is_first: bool) {
    for spin in spins {
        let velocity = f32x4::new(spin.velocity);
        if !is_first {
            spin.warm_start = (f32x4::new(spin.warm_start)
                + (velocity - f32x4::new(spin.warm_started_velocity)))
            .to_array();
        }
        spin.warm_started_velocity = (velocity + f32x4::new(spin.warm_start)).to_array();
        spin.velocity = spin.warm_started_velocity;
    }
}
