//! The choice of the solver for islands.

use serde::{Deserialize, Serialize};

/// Which solver the precise set uses for islands, the sets of bodies that contacts and joints connect.
#[doc(alias = "IslandChoice")]
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Default, Serialize, Deserialize)]
pub enum SolverChoice {
    /// Each island by the cheapest solver that is exact enough: the direct solver where it pays. The default.
    #[default]
    #[serde(rename = "ByItself")]
    Auto,
    /// Every island with contacts by the iterative solver: soft constraints in substeps.
    #[serde(rename = "Passes")]
    Iterative,
    /// The direct solver wherever it can be used: islands of 2 to 400 bodies, without soft joints, in updates without restitution, and
    /// narrow enough for a sparse factorisation. In 2D it also takes closed loops of joints with any number of bodies. Moving islands with contact
    /// cycles take far longer so than by the iterative solver.
    #[serde(rename = "Whole")]
    Direct,
}
