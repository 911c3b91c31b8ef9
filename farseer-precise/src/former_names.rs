//! Names of version 0.1 that still compile; `docs/names-0.2.md` of the repository lists them all.

use crate::island_report::IslandSolver;
use crate::solver_choice::SolverChoice;

#[allow(non_upper_case_globals)]
impl SolverChoice {
    /// The former name of [`SolverChoice::Auto`].
    #[deprecated(since = "0.2.0", note = "renamed to Auto")]
    pub const ByItself: Self = Self::Auto;

    /// The former name of [`SolverChoice::Iterative`].
    #[deprecated(since = "0.2.0", note = "renamed to Iterative")]
    pub const Passes: Self = Self::Iterative;

    /// The former name of [`SolverChoice::Direct`].
    #[deprecated(since = "0.2.0", note = "renamed to Direct")]
    pub const Whole: Self = Self::Direct;
}

#[allow(non_upper_case_globals)]
impl IslandSolver {
    /// The former name of [`IslandSolver::Ballistic`].
    #[deprecated(since = "0.2.0", note = "renamed to Ballistic")]
    pub const Flight: Self = Self::Ballistic;

    /// The former name of [`IslandSolver::Iterative`].
    #[deprecated(since = "0.2.0", note = "renamed to Iterative")]
    pub const Passes: Self = Self::Iterative;

    /// The former name of [`IslandSolver::Articulated`].
    #[deprecated(since = "0.2.0", note = "renamed to Articulated")]
    pub const Swing: Self = Self::Articulated;

    /// The former name of [`IslandSolver::Direct`].
    #[deprecated(since = "0.2.0", note = "renamed to Direct")]
    pub const Whole: Self = Self::Direct;
}
