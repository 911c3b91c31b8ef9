//! The direct solver of the precise set, and solver selection: which islands it takes.
//!
//! The direct solver solves all contacts and joints of an island at once as rigid constraints, by an [augmented Lagrangian
//! method with semismooth Newton steps](island_newton) on a [sparse LDL^T factorisation](block_ldlt). Columns, houses and walls
//! stand without sag or drift with it. The iterative solver takes all other islands. [Solver selection](selection) finds the
//! facts about the islands, and these conditions decide ([`island_stats`]):
//!
//! | island | goes to the direct solver |
//! |---|---|
//! | over 400 bodies with more contacts than joints, much fill-in, restitution in action, unsupported joints | never |
//! | 2D, with joints or springs | always, except moving piles from 40 bodies on; after a pause not while a joint has a gap |
//! | 2D, [large mass ratio](mass_ratio) | without contact cycles always, with them while few bodies are awake |
//! | 2D, no contact cycles | if its bodies were calm when they came together, or from 16 bodies on |
//! | 2D, contact cycles, from 40 bodies on | if its bodies were calm when they came together |
//! | 2D, contact cycles, up to 39 bodies | if calm as above and standing by friction, or if friction slips |
//! | 2.5D | if a heavy body lies on a light one, all contacts are [planar](lateral_friction), and up to 24 bodies have cycles |
//!
//! An island that costs too much goes to the iterative solver for a pause: islands with joints or contact cycles by a
//! [budget](cost_model), others by their number of Newton steps. A contact constraint is either in a graph colour or in the
//! direct solver; it keeps its impulses when it moves ([`fallback`]).
//!
//! The stages of an update, in their order: [`selection`] and [`island_members`] list the islands, [`island_solver`] solves
//! them, and [`fallback`] hands islands over that could not be solved.

pub mod block_ldlt;
pub mod bounded_articulation;
pub mod constraint;
pub mod constraint_list;
pub mod contact;
pub mod cost_model;
pub mod fallback;
pub mod island_body;
pub mod island_history;
pub mod island_io;
pub mod island_members;
pub mod island_newton;
pub mod island_solver;
pub mod island_stats;
pub mod joint;
pub mod joint_island;
pub mod lateral_friction;
pub mod lateral_solver;
pub mod load;
pub mod mass_ratio;
pub mod mat3;
pub mod selection;

use crate::index::{BodyIndex, DenseIndex, IndexedVec, PairIndex};
use crate::island::sleep::SleepState;
use crate::parameters::direct::RESELECTION_PERIOD;
use crate::reusing_clone;
use crate::solver_choice::SolverChoice;
use island_body::MemberIndex;
pub use island_history::{Histories, IslandHistory, ReselectionTimer};
use island_io::DirectIsland;
use island_newton::SolutionScratch;
use island_stats::{IslandCensus, IslandIndex};

/// The direct solver of a simulator: its islands, the histories of all islands, and the scratch space of solver selection.
#[derive(Debug, Default)]
pub struct DirectSolver {
    /// Island history of each body, by body index: solver, costs, pauses and friction checks of its island in past updates.
    pub history: Histories,
    /// Whether no entry of `history` has a friction check, so that none is counted.
    has_no_friction_checks: bool,
    /// Timer of solver selection: decides in which update solvers are selected anew for all islands.
    pub timer: ReselectionTimer,
    /// Whether `islands` lists the present contacts and joints. If not, they are listed before the next solve.
    is_listed: bool,
    /// Islands of the direct solver. The first `count` are in use; the others keep their memory.
    islands: IndexedVec<IslandIndex, DirectIsland>,
    /// Memory of the rows and blocks of the island that is being solved.
    scratch: SolutionScratch,
    /// Number of islands in use, a count of the first elements of `islands`.
    count: usize,
    /// Lengths of the last step and of one of its substeps, in seconds. A change makes the stored sums of impulses invalid.
    step_lengths: [f32; 2],
    /// Islands of the last solver selection or listing, with the facts about each.
    pub(crate) census: IslandCensus,
    /// Scratch: the union-find root of an island and a member of it, sorted by root.
    keyed_bodies: Vec<(BodyIndex, BodyIndex)>,
    /// Scratch: islands and their touching pairs, sorted by island.
    keyed_pairs: Vec<(IslandIndex, PairIndex)>,
    /// Scratch: edges of the graph of one island, as indices into its members, smaller index first.
    edges: Vec<[MemberIndex; 2]>,
    /// Scratch: for each joint and spring between two dynamic bodies, the union-find root of its island and the two body
    /// indices.
    jointed_bodies: Vec<(BodyIndex, [BodyIndex; 2])>,
    /// Scratch of sorting: packed key and index of each item.
    sort_keys: Vec<(u128, u32)>,
}

reusing_clone! {
    DirectSolver { history, has_no_friction_checks, timer, is_listed, islands, scratch, count, step_lengths, census, keyed_bodies, keyed_pairs, edges, jointed_bodies, sort_keys }
}

impl DirectSolver {
    /// Removes all islands, and clears the island histories of `bodies` bodies.
    pub fn reset(&mut self, bodies: usize) {
        self.history.clear();
        self.history.resize(bodies, IslandHistory::default());
        self.is_listed = false;
        self.count = 0;
    }

    /// Clears the island history of a removed body. Makes solver selection due if its island was in the direct solver.
    pub fn forget_body(&mut self, body: BodyIndex) {
        self.timer.is_due |= self.history[body].is_direct;
        self.history[body] = IslandHistory::default();
    }

    /// Returns whether the direct solver has the island of this body.
    #[inline(always)]
    pub fn is_direct(&self, body: BodyIndex) -> bool {
        self.history.at(body).is_some_and(|history| history.is_direct)
    }

    /// Makes solver selection due after a contact constraint between `bodies` was added or removed: in this update if one of
    /// them is in the direct solver. Otherwise selection follows within the period, in 2D only (`has_depth` is false).
    #[inline(always)]
    pub(crate) fn note_constraint_change(&mut self, bodies: [BodyIndex; 2], has_depth: bool) {
        self.timer.is_due |= bodies.iter().any(|&body| self.is_direct(body));
        self.timer.may_be_due |= !has_depth;
    }

    /// Starts friction checks for `body`, the dynamic body B of a new contact. Has no effect in 2.5D (`has_depth`), nor if the
    /// island of the body is in the direct solver or was formed by motion.
    pub(crate) fn watch_friction(&mut self, body: BodyIndex, has_depth: bool) {
        let history = &mut self.history[body];
        if !(has_depth || history.is_direct || history.formed_by_motion) {
            history.begin_friction_checks();
            self.has_no_friction_checks = false;
        }
    }

    /// Sets the island history of a body, as a snapshot has it.
    pub fn set_history(&mut self, body: BodyIndex, history: IslandHistory) {
        self.history[body] = history;
        self.has_no_friction_checks = false;
    }

    /// Stores `signature`, the hash of all joints and springs in this update. A changed hash makes solver selection due at
    /// once. `is_order_new` makes the islands list their joints again.
    ///
    /// Reason for the haste: a soft chain stretches while it waits in the iterative solver, and hardly any direct solution
    /// leads back from there.
    pub fn note_joints(&mut self, signature: u64, is_order_new: bool) {
        self.is_listed &= !is_order_new;
        let ReselectionTimer { joint_signature, is_due, .. } = &mut self.timer;
        if std::mem::replace(joint_signature, signature) != signature {
            self.is_listed = false;
            *is_due = true;
        }
    }

    /// Sets the user's choice of solvers, from this update on.
    pub(crate) fn set_choice(&mut self, choice: SolverChoice) {
        self.timer.is_due |= std::mem::replace(&mut self.timer.choice, choice) != choice;
    }

    /// Returns the user's choice of solvers for all islands.
    pub fn choice(&self) -> SolverChoice {
        self.timer.choice
    }

    /// Returns, for each island of the direct solver, the index of its first body and its number of Newton steps in the last
    /// update.
    pub fn newton_steps_of_islands(&self) -> impl Iterator<Item = (BodyIndex, usize)> + '_ {
        let first = |island: &DirectIsland| Some((island.system.members.first()?.body, island.newton_steps));
        self.islands.slice(..self.count).iter().filter_map(first)
    }

    /// Returns whether the direct solver has no island and solver selection is not due, so that both can be skipped.
    pub fn is_idle(&self) -> bool {
        let ReselectionTimer { is_due, may_be_due, waited_updates, has_paused, .. } = self.timer;
        self.is_listed && self.count == 0 && waited_updates == 0 && !(is_due || may_be_due || has_paused)
    }

    /// Returns whether the islands list the present contacts and joints.
    pub(crate) fn is_listed(&self) -> bool {
        self.is_listed
    }

    /// Marks the islands as listed: they list the present contacts and joints.
    pub(crate) fn mark_listed(&mut self) {
        self.is_listed = true;
    }

    /// Counts one update of the friction checks of all awake bodies. Returns whether one of them is due.
    pub(crate) fn count_friction_checks(&mut self, sleep: &SleepState) -> bool {
        if self.has_no_friction_checks {
            return false;
        }
        let (mut is_due, mut has_checks) = (false, sleep.count > 0);
        for run in sleep.awake_body_runs.iter().cloned() {
            for (body, history) in run.clone().zip(self.history.slice_mut(run)) {
                if history.has_friction_check() && sleep.is_awake(BodyIndex::new(body)) {
                    is_due |= history.is_friction_check_due();
                    has_checks = true;
                }
            }
        }
        self.has_no_friction_checks = !has_checks;
        is_due
    }

    /// Counts one update of the timer and of all pauses. Returns whether solvers are selected in this update; the timer then
    /// starts anew. With `is_quick`, changes in islands of the iterative solver do not wait for the
    /// [period](RESELECTION_PERIOD).
    pub(crate) fn begin_selection(&mut self, is_quick: bool) -> bool {
        let is_due = self.is_reselection_due(is_quick);
        if is_due {
            self.timer.restart();
        }
        is_due
    }

    /// Counts one update of the timer and of all pauses. Returns whether solver selection is due, with `is_quick` as in
    /// [`begin_selection`](Self::begin_selection).
    fn is_reselection_due(&mut self, is_quick: bool) -> bool {
        let ReselectionTimer { is_due, may_be_due, waited_updates, has_paused, .. } = &mut self.timer;
        if std::mem::take(has_paused) {
            for history in self.history.iter_mut().filter(|entry| entry.pause > 0) {
                history.pause -= 1;
                *may_be_due |= history.pause == 0;
                *has_paused |= history.pause > 0;
            }
        }
        *waited_updates = if *may_be_due { *waited_updates + 1 } else { 0 };
        *is_due || (*may_be_due && (*waited_updates >= RESELECTION_PERIOD || is_quick))
    }
}
