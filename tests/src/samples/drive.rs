//! The input of the recorded runs (behaviour chapter 16, part E): applied after every step.

use farseer_core::math::Vector2;
use farseer_core::{BodyId, PhysicsSimulator, Result};

use super::Actor;

/// Applies a force and a torque to a body.
#[derive(Debug, Clone, Copy)]
pub struct Drive {
    /// The body.
    pub body: BodyId,
    /// Force on it.
    pub force: Vector2,
    /// Torque on it in kg px²/s².
    pub torque: f32,
}

impl Drive {
    /// Applies a force along x to a body.
    pub fn along_x(body: BodyId, force: f32) -> Self {
        Drive { body, force: Vector2::new(force, 0.0), torque: 0.0 }
    }
}

impl Actor for Drive {
    fn after_step(&mut self, simulator: &mut PhysicsSimulator) -> Result<()> {
        simulator[self.body].apply_force(self.force);
        simulator[self.body].apply_torque(self.torque);
        Ok(())
    }
}

/// Spins wheels.
#[derive(Debug, Clone, Copy)]
pub struct AngularDrive {
    /// The wheels.
    pub wheels: [BodyId; 2],
    /// Angular impulse on each wheel in kg px²/s.
    pub impulse: f32,
}

impl Actor for AngularDrive {
    fn after_step(&mut self, simulator: &mut PhysicsSimulator) -> Result<()> {
        for wheel in self.wheels {
            simulator[wheel].apply_angular_impulse(self.impulse);
        }
        Ok(())
    }
}
