//! Hits: contact points that close at speed.

use crate::geom::GeomId;
use crate::math::Vector2;

/// Two geoms hit each other, for example for a sound: see [`PhysicsSimulator::hits`](crate::PhysicsSimulator::hits).
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Hit {
    /// The geom with the smaller [creation number](crate::GeomRef::id).
    pub geom1: GeomId,
    /// The other geom.
    pub geom2: GeomId,
    /// The contact point that closes fastest, in the world, in length units.
    pub point: Vector2,
    /// Unit normal from the first geom to the second.
    pub normal: Vector2,
    /// Speed along the normal at which the two approach at the point, before the impact, in length units/s.
    pub speed: f32,
}
