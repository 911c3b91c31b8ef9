//! The force of a spring on a body, before it is applied.

use crate::body::BodyId;
use crate::body::entry::Bodies;
use crate::math::Vector2;

/// A force at a point of the world, or a torque, on a body.
#[derive(Debug, Clone, Copy)]
pub(crate) enum SpringForce {
    Force { body: BodyId, force: Vector2, point: Vector2 },
    Torque { body: BodyId, torque: f32 },
}

impl SpringForce {
    /// Adds it to the force accumulated for this update.
    pub(crate) fn apply(self, bodies: &mut Bodies) {
        match self {
            SpringForce::Force { body, force, point } => {
                bodies[body].body.apply_force_at_world_point(force, point)
            }
            SpringForce::Torque { body, torque } => bodies[body].body.apply_torque(torque),
        }
    }
}
