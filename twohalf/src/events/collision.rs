//! Collisions as games see them.

use farseer_core::GeomId;

use crate::Vector3;
use crate::depth::{Axis, ContactTarget};

/// A contact of a geom, as reported to a game.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Collision {
    /// The geom that has the contact.
    pub this: GeomId,
    /// The contact target: the other geom, a platform or the ground.
    pub partner: ContactTarget,
    /// Axes along which the contact acts.
    pub axis: Axis,
    /// Unit normal in the world, Y up, from the target to `this`.
    pub normal: Vector3,
    /// Deepest contact point in the world, px, Y up.
    pub position: Vector3,
    /// Number of contact points. It is 0 for a support, ledge or wall of a
    /// [character](crate::TwoHalfPhysicsSimulator::walk) that it does not touch.
    pub contacts: u32,
    /// Normal impulse, mass · px/s, 0 or more. In a callback it is that of the last update (0 at first
    /// touch), in the list of events that of the reported update.
    pub normal_impulse: f32,
    /// Whether a handler refused the contact; always false in a callback.
    pub vetoed: bool,
}
