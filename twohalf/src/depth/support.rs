//! Supports: contacts that carry a body.

use serde::{Deserialize, Serialize};

use crate::{ContactTarget, Vector3};

/// Least upward component of the normal of a surface to stand on, dimensionless: slopes up to 60 degrees.
const MIN_GROUND_UP: f32 = 0.5;

/// Contact target that carries a body.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct Support {
    /// The target that supports the body.
    pub partner: ContactTarget,
    /// Unit normal towards the body in the world, Y up; its y is greater than 0.
    pub normal: Vector3,
}

impl Support {
    /// Returns whether the body can stand on the support: its surface is no steeper than 60 degrees.
    pub fn carries(&self) -> bool {
        self.normal.y >= MIN_GROUND_UP
    }
}
