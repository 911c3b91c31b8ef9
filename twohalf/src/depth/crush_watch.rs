//! Of whom it is told when they are crushed.

use farseer_core::BodyId;
use serde::{Deserialize, Serialize};

/// A body whose game wants to be told.
#[derive(Debug, Clone, Copy, Serialize, Deserialize)]
pub(crate) struct CrushWatch {
    pub(crate) body: BodyId,
    pub(crate) tolerance: f32,
    pub(crate) is_crushed: bool,
}

impl CrushWatch {
    /// What was loaded may hold anything.
    pub(crate) fn is_valid(&self) -> bool {
        self.tolerance.is_finite() && self.tolerance >= 0.0
    }
}
