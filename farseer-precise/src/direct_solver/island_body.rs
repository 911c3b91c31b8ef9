//! Bodies of an island during a solution, and arithmetic of its vectors (x, y, angle).

use super::mat3::Vec3;
use crate::index::{BodyIndex, IndexedVec};
use crate::mass::INFINITE_MASS;
use crate::parameters::direct::STABLE_STIFFNESS;

/// Index of a body in the list of members of its island: the row of the body in the matrix of the island.
pub(crate) use crate::minimum_degree::RowIndex as MemberIndex;

/// The members of an island.
pub(super) type Members = IndexedVec<MemberIndex, IslandBody>;

/// A vector (x, y, angle) of each member of an island.
pub(crate) type MemberVectors = IndexedVec<MemberIndex, Vec3>;

/// State of one dynamic body of the island during a solution.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct IslandBody {
    /// Index of the body in the simulator's list of bodies.
    pub(super) body: BodyIndex,
    /// Mass, mass units; very large if the body cannot move.
    pub(super) mass: f64,
    /// Moment of inertia, mass units * length units^2; very large if the body cannot rotate.
    pub(super) inertia: f64,
    /// Velocity of the body with the initial impulses: length units/s, length units/s, radians/s. When the solution ends, the
    /// velocity change is added.
    pub(super) velocity: Vec3,
    /// Change of the velocity of the body since the initial impulses were applied: length units/s, length units/s, radians/s.
    pub(super) velocity_change: Vec3,
    /// Velocity change of the body in the round with the smallest residual so far: length units/s, length units/s, radians/s.
    pub(super) best_velocity_change: Vec3,
    /// Velocity of the body along the depth axis, length units/s; 0 in 2D.
    pub(super) depth_velocity: f64,
}

impl IslandBody {
    /// Returns the velocity change by an impulse (mass units * length units/s for x and y, mass units * length units^2/s for
    /// the angle): M^-1 times the impulse. Unit: length units/s, length units/s, radians/s.
    #[inline(always)]
    pub(super) fn velocity_from_impulse(&self, [x, y, angular]: Vec3) -> Vec3 {
        [x / self.mass, y / self.mass, angular / self.inertia]
    }

    /// Adds `added` to the moment of inertia of the body (mass units * length units^2). Of `added`, the part `rotating` rotates
    /// with the body, and the other part starts at rest. The angular velocity is scaled so that the angular momentum stays.
    pub(super) fn add_inertia(&mut self, added: f64, rotating: f64) {
        self.velocity[2] *= (self.inertia + rotating) / (self.inertia + added);
        self.inertia += added;
    }

    /// Returns the stable limit of the body: the greatest geometric stiffness, times dt^2, that an explicit step integrates.
    /// Unit: mass units * length units^2. `squared_arm` is the square of the longest vector from the centre of mass to a joint,
    /// length units^2.
    pub(super) fn stable_stiffness(&self, squared_arm: f64) -> f64 {
        STABLE_STIFFNESS * (self.inertia + self.mass * squared_arm)
    }

    /// Returns the inverse mass (1/mass units) and the inverse moment of inertia (1/(mass units * length units^2)). Each is 0
    /// for a body that cannot move or rotate.
    pub(super) fn inverse_mass_and_inertia(&self) -> [f64; 2] {
        [self.mass, self.inertia].map(|weight| if weight < INFINITE_MASS { weight.recip() } else { 0.0 })
    }

    /// Returns twice the kinetic energy of the body at a velocity (length units/s, length units/s, radians/s), divided by its mass:
    /// the square of a speed, length units^2/s^2.
    pub(super) fn squared_speed(&self, velocity: Vec3) -> f64 {
        dot(self.momentum(velocity), velocity) / self.mass
    }

    /// Returns the momentum of the body at a velocity (length units/s, length units/s, radians/s): M times the velocity. Unit:
    /// mass units * length units/s for x and y, mass units * length units^2/s for the angle.
    #[inline(always)]
    pub(super) fn momentum(&self, [x, y, angular]: Vec3) -> Vec3 {
        [self.mass * x, self.mass * y, self.inertia * angular]
    }
}

/// Returns the scalar product of two vectors (x, y, angle), in the product of the units of both.
#[inline(always)]
pub(super) fn dot(a: Vec3, b: Vec3) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

/// Adds the vector `added` to the vector `to`.
#[inline(always)]
pub(super) fn add(to: &mut Vec3, added: Vec3) {
    to.iter_mut().zip(added).for_each(|(to, added)| *to += added);
}

/// Returns the greater of two numbers, or NaN if one of them is NaN.
#[inline(always)]
pub(super) fn max_or_nan(one: f64, other: f64) -> f64 {
    if one <= other || other.is_nan() { other } else { one }
}

/// Returns the greater of two magnitudes, numbers whose sign bit is clear, or NaN if one of them is NaN. The result is that of
/// [`max_or_nan`]: the bits of such numbers have the order of the numbers, and NaN comes after infinity.
#[inline(always)]
pub(super) fn max_magnitude(one: f64, other: f64) -> f64 {
    f64::from_bits(one.to_bits().max(other.to_bits()))
}

/// Returns a number if it is positive, else 0. `f64::max` leaves the sign of a zero to the processor, and snapshots store it.
#[inline(always)]
pub(super) fn positive_part(number: f64) -> f64 {
    if number > 0.0 { number } else { 0.0 }
}

/// Returns `value`, or 0 if it is not finite as `f32`.
#[inline(always)]
pub(super) fn finite_or_zero(value: f64) -> f64 {
    if value.abs() <= f64::from(f32::MAX) { value } else { 0.0 }
}
