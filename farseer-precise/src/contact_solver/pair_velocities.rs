//! Velocities of the pairs of bodies of four contact constraints, one per SIMD lane: gathered from the list of bodies, changed by
//! impulses, scattered back; and the relative velocities and effective masses of rows.

use crate::bodies::MotionState;
use crate::constraint_graph::{ContactConstraintSimd, ContactPointSimd, SimdContacts};
use crate::index::{BodyIndex, DenseIndex};
use crate::math::lanes::greater;
use wide::f32x4;

const ZERO: f32x4 = f32x4::ZERO;

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
    pub(super) fn relative_normal_velocity<const FIXED: bool, const P: usize, R: SimdContacts<P>>(
        &self,
        contacts: &R,
    ) -> f32x4 {
        let ([x, y, z], constraint) = (self.relative_linear_velocity::<FIXED>(), contacts.constraint());
        let in_plane = x * constraint.normal_x + y * constraint.normal_y;
        if R::IS_3D { in_plane + z * contacts.normal_z() } else { in_plane }
    }

    /// Returns the linear velocity of B relative to A along the tangent (n.y, -n.x), without the angular part, length units/s.
    #[inline(always)]
    pub(super) fn relative_tangent_velocity<const FIXED: bool, const P: usize>(
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
    pub(super) fn store_with_normal_impulse<const FIXED: bool, const P: usize, R: SimdContacts<P>>(
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
