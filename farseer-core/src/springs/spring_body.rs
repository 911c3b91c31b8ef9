//! State of a body as springs need it.

use crate::body::Body;
use crate::math::Vector2;

/// Force and torque that a body would have accumulated.
#[derive(Debug, Clone, Copy)]
pub(crate) struct SpringBody {
    force: Vector2,
    torque: f32,
}

impl SpringBody {
    pub(crate) fn of(body: &Body) -> Self {
        SpringBody { force: body.force(), torque: body.torque() }
    }

    pub(crate) fn with_force(self, force: Vector2, offset: Vector2) -> Self {
        let torque = offset.x * force.y - offset.y * force.x;
        SpringBody { force: self.force + force, torque: self.torque + torque }
    }

    pub(crate) fn with_torque(self, torque: f32) -> Self {
        SpringBody { torque: self.torque + torque, ..self }
    }

    pub(crate) fn is_finite(self) -> bool {
        self.force.x.is_finite() && self.force.y.is_finite() && self.torque.is_finite()
    }
}

/// Whether a spring between two bodies acts: one is movable, and one is enabled.
pub(crate) fn may_act(body1: &Body, body2: &Body) -> bool {
    !(body1.is_immovable() && body2.is_immovable()) && (body1.enabled() || body2.enabled())
}
