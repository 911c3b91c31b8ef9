//! A touch, as a game is told of it.

use farseer_core::GeomId;

use crate::Vector3;
use crate::depth::{Axis, Partner};

/// A geom touches something: what a game is told of it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Collision {
    /// The geom that is told.
    pub this: GeomId,
    /// What it touches.
    pub partner: Partner,
    /// Along which axes it is pushed.
    pub axis: Axis,
    /// Unit vector in the world, Y up, that points from the partner to `this`: the direction in which it is pushed.
    pub normal: Vector3,
    /// The deepest point of the contact in the world, px, Y up.
    pub position: Vector3,
    /// Number of contact points: 0 for what a figure that [walks](crate::TwoHalfPhysicsSimulator::walk) stands on, is held off from
    /// or is about to step on, and does not touch.
    pub contacts: u32,
    /// Impulse along the normal, mass times velocity, 0 or more: in a callback that of the last update (0 at first
    /// touch), in the list of events that of the update that reports it.
    pub normal_impulse: f32,
    /// Whether a handler refused the contact. In a callback always false.
    pub vetoed: bool,
}
