//! Loads: whether the bodies of a contact have a large mass ratio, and whether a heavy body lies on a light one.

use crate::math::plane::{Vector, dot};
use crate::parameters::direct::{HEAVY_MASS_RATIO, SUPPORT_NORMAL_SQUARED};

/// Returns whether a contact normal is within 60 degrees of the direction of gravity, so that one body lies on the other.
/// `gravity` is the velocity change by gravity in a step, length units/s.
#[inline(always)]
pub(crate) fn is_support_normal(normal: Vector, gravity: Vector) -> bool {
    let along = dot(normal, gravity);
    along * along > SUPPORT_NORMAL_SQUARED * dot(gravity, gravity)
}

/// Returns whether a heavy body lies on a light one: its mass is over [`HEAVY_MASS_RATIO`] times as large. `a` and `b` are the
/// inverse masses of A and B in 1/mass units, `normal` points from A to B. `gravity` is the velocity change by gravity in a
/// step, length units/s.
#[inline(never)]
pub(crate) fn is_heavy_on_light([a, b]: [f32; 2], normal: Vector, gravity: Vector) -> bool {
    let (above, below) = if dot(normal, gravity) > 0.0 { (a, b) } else { (b, a) };
    above > 0.0 && below > HEAVY_MASS_RATIO * above && is_support_normal(normal, gravity)
}

/// Returns whether two dynamic bodies with these inverse masses have a mass ratio above `ratio`.
#[inline(always)]
pub(super) fn exceeds_mass_ratio([a, b]: [f32; 2], ratio: f32) -> bool {
    let (heavy, light) = if a < b { (a, b) } else { (b, a) };
    heavy > 0.0 && light > ratio * heavy
}
