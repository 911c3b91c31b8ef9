//! Contact point in three axes, as the engine above (`twohalf`) reads it.

use crate::math::Vector2;

/// Contact point in three axes: position, separation and impulses.
#[derive(Debug, Clone, Copy, Default)]
pub struct DepthContactPoint {
    /// World position of the contact point in the plane of x and y, length units; y down.
    pub position: Vector2,
    /// Separation of both shapes at the contact point in length units, negative for penetration.
    pub separation: f32,
    /// Feature id: constant as long as the same vertices or edges touch.
    pub feature: u32,
    /// Normal impulse of the contact point in the last update, mass units * length units/s, >= 0.
    pub impulse: f32,
    /// Friction impulses of the contact point along the first and the second tangent, mass units * length units/s. The first
    /// tangent lies in the plane of x and y; the second tangent is the cross product of normal and first tangent.
    pub friction_impulse: [f32; 2],
}
