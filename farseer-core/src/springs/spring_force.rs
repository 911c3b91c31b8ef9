//! The force of a spring on a body, before it is applied.

use crate::body::entry::Bodies;
use crate::body::{Body, BodyId};
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

    /// The body.
    pub(crate) fn body(self) -> BodyId {
        match self {
            SpringForce::Force { body, .. } | SpringForce::Torque { body, .. } => body,
        }
    }

    /// Accelerations of the body, in length units/s² and rad/s².
    pub(crate) fn accelerations(self, body: &Body) -> [f32; 3] {
        let (force, torque) = match self {
            SpringForce::Force { force, point, .. } => {
                let arm = point - body.position();
                (force, arm.x * force.y - arm.y * force.x)
            }
            SpringForce::Torque { torque, .. } => (Vector2::zeros(), torque),
        };
        let inverse = body.inverse_mass();
        [force.x * inverse, force.y * inverse, torque * body.inverse_moment_of_inertia()]
    }
}
