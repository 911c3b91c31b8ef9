//! History of the islands, by which solver selection and the budget decide, and the timer of solver selection.

use crate::index::{BodyIndex, IndexedVec};
use crate::parameters::direct::FRICTION_CHECK_MAX_DOUBLINGS;
use crate::solver_choice::SolverChoice;
use serde::{Deserialize, Serialize};

/// Island history of one body: solver, costs, pauses and friction checks of its island in past updates. Solver selection and
/// the budget read it. All members of an island in the direct solver have equal histories; snapshots save them.
#[derive(Debug, Clone, Copy, Default, PartialEq, Serialize, Deserialize)]
pub struct IslandHistory {
    /// Whether the island of the body is in the direct solver.
    pub is_direct: bool,
    /// Running average of the Newton steps per update of the island. Unit: dimensionless, a count.
    #[serde(rename = "effort")]
    pub average_newton_steps: f32,
    /// Whether the last update of the island needed Newton steps.
    #[serde(rename = "is_hot")]
    pub(crate) was_iterated: bool,
    /// Number of further updates for which the iterative solver keeps the island; 0 without a pause.
    #[serde(rename = "rest")]
    pub(crate) pause: u8,
    /// Whether a body of the island was not calm (faster than
    /// [`CALM_ISLAND_MAX_SPEED`](crate::parameters::direct::CALM_ISLAND_MAX_SPEED)) at an earlier solver selection. If
    /// not, the island is built in place.
    #[serde(rename = "is_loose")]
    pub(crate) formed_by_motion: bool,
    /// Whether the direct solver had an accepted solution since it took the island. Set for islands with joints only.
    #[serde(rename = "was_solved")]
    pub(crate) has_accepted_solution: bool,
    /// Budget of an island with joints or contact cycles, dimensionless, -1..=0. At 0 no cost is overdrawn; below -1 the
    /// greatest overdraft is exceeded and the island gets a pause.
    pub budget: f32,
    /// Length of the last pause of an island with a budget, in updates, less one for each update without Newton steps since
    /// then. The next pause is twice as long.
    pub(crate) back_off: u8,
    /// Number of updates until the next friction check of the body in the iterative solver: whether its contacts
    /// [slip](super::island_stats::IslandStats::slips).
    #[serde(rename = "look_in")]
    pub(crate) friction_check_in: u8,
    /// Number of friction checks of the body so far plus one; 0 for a body that is not checked.
    #[serde(rename = "watch")]
    pub(crate) friction_checks: u8,
}

impl IslandHistory {
    /// Returns whether the island had a pause lately.
    pub(super) fn was_paused(&self) -> bool {
        self.back_off > 0
    }

    /// Starts the friction checks of the body; the first one is in the next update. Called for a new contact, and when solver
    /// selection leaves a small island with contact cycles to the iterative solver or puts it on trial.
    pub(super) fn begin_friction_checks(&mut self) {
        (self.friction_check_in, self.friction_checks) = (1, 1);
    }

    /// Returns whether updates until the next friction check are counted, or checks follow.
    #[inline(always)]
    pub(super) fn has_friction_check(&self) -> bool {
        (self.friction_check_in | self.friction_checks) != 0
    }

    /// Counts one update of the friction checks. Returns whether friction at the body is checked in this update. The time
    /// between two checks doubles from check to check, up to 2^[`FRICTION_CHECK_MAX_DOUBLINGS`] updates.
    pub(super) fn is_friction_check_due(&mut self) -> bool {
        self.friction_check_in = self.friction_check_in.saturating_sub(1);
        let is_due = self.friction_checks > 0 && self.friction_check_in == 0;
        if is_due {
            self.friction_check_in = 1 << self.friction_checks.min(FRICTION_CHECK_MAX_DOUBLINGS);
            self.friction_checks = self.friction_checks.saturating_add(1);
        }
        is_due
    }
}

/// Island history of each body.
pub type Histories = IndexedVec<BodyIndex, IslandHistory>;

/// Timer of solver selection: decides in which update islands are computed and solvers are selected again. Snapshots save it.
#[derive(Debug, Clone, Copy, Default, PartialEq, Serialize, Deserialize)]
pub struct ReselectionTimer {
    /// Whether solvers are selected in this update, because an island of the direct solver has gained or lost constraints, or
    /// joints, springs or the choice have changed.
    pub is_due: bool,
    /// Whether solvers are selected within `RESELECTION_PERIOD` updates, because an island of the iterative solver has gained
    /// or lost constraints or a pause has ended.
    pub may_be_due: bool,
    /// Number of updates since `may_be_due` was set.
    #[serde(rename = "age")]
    pub(super) waited_updates: u8,
    /// Whether some island is in a pause, so that pauses are counted down.
    #[serde(rename = "has_resting")]
    pub(super) has_paused: bool,
    /// Hash of all joints and springs in the last update. A different hash makes the selection due.
    #[serde(rename = "joints")]
    pub(super) joint_signature: u64,
    /// The user's choice of solvers for all islands: automatic, direct or iterative.
    pub(super) choice: SolverChoice,
}

impl ReselectionTimer {
    /// Clears `is_due`, `may_be_due` and `waited_updates`, since solvers are selected in this update.
    pub(super) fn restart(&mut self) {
        (self.is_due, self.may_be_due, self.waited_updates) = (false, false, 0);
    }
}

/// Returns the common island history of `members` (pairs of union-find root and body index) that come from several islands: the
/// worse value of each field. `histories` are indexed by body.
pub(super) fn merged_history(members: &[(BodyIndex, BodyIndex)], histories: &Histories) -> IslandHistory {
    let first = IslandHistory { is_direct: true, has_accepted_solution: true, ..IslandHistory::default() };
    members.iter().map(|&(_, body)| histories[body]).fold(first, |merged, other| IslandHistory {
        average_newton_steps: if other.average_newton_steps > merged.average_newton_steps {
            other.average_newton_steps
        } else {
            merged.average_newton_steps
        },
        was_iterated: merged.was_iterated || other.was_iterated,
        formed_by_motion: merged.formed_by_motion || other.formed_by_motion,
        has_accepted_solution: merged.has_accepted_solution && other.has_accepted_solution,
        budget: if other.budget < merged.budget { other.budget } else { merged.budget },
        back_off: merged.back_off.max(other.back_off),
        friction_checks: merged.friction_checks.max(other.friction_checks),
        friction_check_in: merged.friction_check_in.max(other.friction_check_in),
        ..merged
    })
}
