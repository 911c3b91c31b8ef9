//! What holds a body up.

use serde::{Deserialize, Serialize};

use crate::{Partner, Vector3};

/// Least upward part of a normal that carries: slopes up to 60 degrees.
const CARRIES: f32 = 0.5;

/// Something below a body that touches it.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct Support {
    /// What it is.
    pub partner: Partner,
    /// Unit vector in the world, Y up, in which it pushes the body; its y is greater than 0.
    pub normal: Vector3,
}

impl Support {
    /// Whether one can stand on it: it pushes more upward than a slope of 60 degrees does.
    pub fn carries(&self) -> bool {
        self.normal.y >= CARRIES
    }
}
