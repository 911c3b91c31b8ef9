//! Names of version 0.1 that still compile; `docs/names-0.2.md` lists them all.

use crate::{
    AwakeReason, IslandSolver, PhysicsSimulator, RejectedArguments, SecondaryMap, SolverBodiesView,
    SolverBodyIndex, SolverChoice, SolverReason,
};

// A trait has no deprecated alias.
#[doc(hidden)]
pub use crate::simulator::ExternalConstraints as Constraints;
#[doc(hidden)]
pub use crate::utilities::MapId as TableId;

/// The former name of [`SolverChoice`].
#[deprecated(since = "0.2.0", note = "renamed to SolverChoice")]
pub type IslandChoice = SolverChoice;

/// The former name of [`IslandSolver`].
#[deprecated(since = "0.2.0", note = "renamed to IslandSolver")]
pub type IslandMethod = IslandSolver;

/// The former name of [`RejectedArguments`].
#[deprecated(since = "0.2.0", note = "renamed to RejectedArguments")]
pub type Refusals<A> = RejectedArguments<A>;

/// The former name of [`SecondaryMap`].
#[deprecated(since = "0.2.0", note = "renamed to SecondaryMap")]
pub type SideTable<I, T> = SecondaryMap<I, T>;

/// The former name of [`SolverBodiesView`].
#[deprecated(since = "0.2.0", note = "renamed to SolverBodiesView")]
pub type SolvedBodies<'a> = SolverBodiesView<'a>;

/// The former name of [`SolverBodyIndex`].
#[deprecated(since = "0.2.0", note = "renamed to SolverBodyIndex")]
pub type SolverPlace = SolverBodyIndex;

/// The former name of [`AwakeReason`].
#[deprecated(since = "0.2.0", note = "renamed to AwakeReason")]
pub type WhyAwake = AwakeReason;

/// The former name of [`SolverReason`].
#[deprecated(since = "0.2.0", note = "renamed to SolverReason")]
pub type WhyMethod = SolverReason;

#[allow(non_upper_case_globals)]
impl AwakeReason {
    /// The former name of [`AwakeReason::SleepDisabled`].
    #[deprecated(since = "0.2.0", note = "renamed to SleepDisabled")]
    pub const NothingSleeps: Self = Self::SleepDisabled;
}

impl PhysicsSimulator {
    /// The former name of [`solver_choice`](Self::solver_choice).
    #[deprecated(since = "0.2.0", note = "renamed to solver_choice")]
    pub fn island_choice(&self) -> SolverChoice {
        self.solver_choice()
    }

    /// The former name of [`set_solver_choice`](Self::set_solver_choice).
    #[deprecated(since = "0.2.0", note = "renamed to set_solver_choice")]
    pub fn set_island_choice(&mut self, choice: SolverChoice) {
        self.set_solver_choice(choice);
    }
}
