//! The push of a spring at a body, before it is applied.

use crate::body::entry::Bodies;
use crate::body::{Body, BodyId};
use crate::math::Vector2;

/// A force at a point of the world, or a torque, on a body.
#[derive(Debug, Clone, Copy)]
pub(crate) enum Push {
    Force { body: BodyId, force: Vector2, point: Vector2 },
    Torque { body: BodyId, torque: f32 },
}

impl Push {
    /// Adds it to what the body bears in this update.
    pub(crate) fn apply(self, bodies: &mut Bodies) {
        match self {
            Push::Force { body, force, point } => bodies[body].body.apply_force_at_world_point(force, point),
            Push::Torque { body, torque } => bodies[body].body.apply_torque(torque),
        }
    }

    /// The body.
    pub(crate) fn body(self) -> BodyId {
        match self {
            Push::Force { body, .. } | Push::Torque { body, .. } => body,
        }
    }

    /// Accelerations of the body: length units and radians per second squared.
    pub(crate) fn accelerations(self, body: &Body) -> [f32; 3] {
        let (force, torque) = match self {
            Push::Force { force, point, .. } => {
                let arm = point - body.position();
                (force, arm.x * force.y - arm.y * force.x)
            }
            Push::Torque { torque, .. } => (Vector2::zeros(), torque),
        };
        let inverse = body.inverse_mass();
        [force.x * inverse, force.y * inverse, torque * body.inverse_moment_of_inertia()]
    }
}
