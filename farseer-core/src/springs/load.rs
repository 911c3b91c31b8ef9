//! What springs ask of bodies.

use crate::body::Body;
use crate::math::Vector2;

/// The force and torque a body would have accumulated.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Load {
    force: Vector2,
    torque: f32,
}

impl Load {
    pub(crate) fn of(body: &Body) -> Self {
        Load { force: body.force(), torque: body.torque() }
    }

    pub(crate) fn with_force(self, force: Vector2, offset: Vector2) -> Self {
        let torque = offset.x * force.y - offset.y * force.x;
        Load { force: self.force + force, torque: self.torque + torque }
    }

    pub(crate) fn with_torque(self, torque: f32) -> Self {
        Load { torque: self.torque + torque, ..self }
    }

    pub(crate) fn is_finite(self) -> bool {
        self.force.x.is_finite() && self.force.y.is_finite() && self.torque.is_finite()
    }
}

/// Whether a spring between two bodies has something to do.
pub(crate) fn may_act(body1: &Body, body2: &Body) -> bool {
    !(body1.is_immovable() && body2.is_immovable()) && (body1.enabled() || body2.enabled())
}
