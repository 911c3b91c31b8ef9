//! The direct solver of the precise set, and solver selection: which islands it takes.
//!
//! The direct solver solves all contacts and joints of an island at once as rigid constraints, by an [augmented Lagrangian
//! method with semismooth Newton steps](island_newton) on a [sparse LDL^T factorisation](block_ldlt). Columns, houses and walls
//! stand without sag or drift with it. The iterative solver takes all other islands. This file holds solver selection. The
//! conditions for each island are:
//!
//! | island | goes to the direct solver |
//! |---|---|
//! | over 400 bodies with more contacts than joints, much fill-in, restitution in action, unsupported joints | never |
//! | 2D, with joints or springs | always; after a pause not while a joint has a gap |
//! | 2D, [large mass ratio](mass_ratio) | always |
//! | 2D, no contact cycles | if its bodies were calm when they came together, or from 16 bodies on |
//! | 2D, contact cycles, from 40 bodies on | if its bodies were calm when they came together |
//! | 2D, contact cycles, up to 39 bodies | if calm as above: in the first update, then if friction [slips](IslandStats::slips) |
//! | 2.5D | if a heavy body lies on a light one, all contacts are [planar](lateral_friction), and up to 24 bodies have cycles |
//!
//! An island that costs too much goes to the iterative solver for a pause: islands with joints or contact cycles by a
//! [budget](cost_model), others by their number of Newton steps. A contact constraint is either in a graph colour or in the
//! direct solver; it keeps its impulses when it moves.

mod block_ldlt;
mod bounded_articulation;
pub(in crate::precise) mod constraint;
mod constraint_list;
mod contact;
mod cost_model;
mod fallback;
pub(in crate::precise) mod island_io;
mod island_members;
mod island_newton;
pub(in crate::precise) mod joint;
pub(in crate::precise) mod joint_island;
mod lateral_friction;
mod mass_ratio;
pub(in crate::precise) mod mat3;
pub(in crate::precise) mod selection;

use serde::{Deserialize, Serialize};

use crate::methods::SolverChoice;
use crate::precise::island::report::SolverReason;
use crate::precise::parameters::direct::{
    ACYCLIC_MOVING_ISLAND_BODIES, CYCLIC_DEPTH_ISLAND_BODIES, CYCLIC_ISLAND_BODIES, DIRECT_ISLAND_BODIES,
    FRICTION_CHECK_MAX_DOUBLINGS, RESELECTION_PERIOD,
};
use crate::storage::reusing_clone::reusing_clone;
use island_io::DirectIsland;
pub(super) use lateral_friction::{is_heavy_on_light, is_support_normal};
use selection::IslandCensus;

/// Island history of one body: solver, costs, pauses and friction checks of its island in past updates. Solver selection and
/// the budget read it. All members of an island in the direct solver have equal histories; snapshots save them.
#[derive(Debug, Clone, Copy, Default, PartialEq, Serialize, Deserialize)]
pub(super) struct IslandHistory {
    /// Whether the island of the body is in the direct solver.
    pub(super) is_direct: bool,
    /// Running average of the Newton steps per update of the island. Unit: dimensionless, a count.
    #[serde(rename = "effort")]
    pub(super) average_newton_steps: f32,
    /// Whether the last update of the island needed Newton steps.
    #[serde(rename = "is_hot")]
    pub(super) was_iterated: bool,
    /// Number of further updates for which the iterative solver keeps the island; 0 without a pause.
    #[serde(rename = "rest")]
    pub(super) pause: u8,
    /// Whether a body of the island was not calm (faster than
    /// [`CALM_ISLAND_MAX_SPEED`](crate::precise::parameters::direct::CALM_ISLAND_MAX_SPEED)) at an earlier solver selection. If
    /// not, the island is built in place.
    #[serde(rename = "is_loose")]
    pub(super) formed_by_motion: bool,
    /// Whether the direct solver had an accepted solution since it took the island. Set for islands with joints only.
    #[serde(rename = "was_solved")]
    pub(super) has_accepted_solution: bool,
    /// Budget of an island with joints or contact cycles, dimensionless, -1..=0. At 0 no cost is overdrawn; below -1 the
    /// greatest overdraft is exceeded and the island gets a pause.
    pub(super) budget: f32,
    /// Length of the last pause of an island with a budget, in updates, less one for each update without Newton steps since
    /// then. The next pause is twice as long.
    pub(super) back_off: u8,
    /// Number of updates until the next friction check of the body in the iterative solver: whether its contacts
    /// [slip](IslandStats::slips).
    #[serde(rename = "look_in")]
    pub(super) friction_check_in: u8,
    /// Number of friction checks of the body so far plus one; 0 for a body that is not checked. In the direct solver the bodies
    /// in their [cold start](IslandStats::is_cold_start) are checked, and no others.
    #[serde(rename = "watch")]
    pub(super) friction_checks: u8,
}

impl IslandHistory {
    /// Starts the friction checks of the body; the first one is in the next update. Called for a new contact, and when solver
    /// selection leaves a small island with contact cycles to the iterative solver.
    fn begin_friction_checks(&mut self) {
        (self.friction_check_in, self.friction_checks) = (1, 1);
    }

    /// Returns whether the friction checks of the body have begun in this update.
    fn is_first_friction_check(&self) -> bool {
        self.friction_checks == 1
    }

    /// Counts one update of the friction checks. Returns whether friction at the body is checked in this update. The time
    /// between two checks doubles from check to check, up to 2^[`FRICTION_CHECK_MAX_DOUBLINGS`] updates.
    fn is_friction_check_due(&mut self) -> bool {
        self.friction_check_in = self.friction_check_in.saturating_sub(1);
        let is_due = self.friction_checks > 0 && self.friction_check_in == 0;
        if is_due {
            self.friction_check_in = 1 << self.friction_checks.min(FRICTION_CHECK_MAX_DOUBLINGS);
            self.friction_checks = self.friction_checks.saturating_add(1);
        }
        is_due
    }
}

/// The direct solver of a simulator: its islands, the histories of all islands, and the scratch space of solver selection.
#[derive(Debug, Default)]
pub(super) struct DirectSolver {
    /// Island history of each body, by body index: solver, costs, pauses and friction checks of its island in past updates.
    pub(super) history: Vec<IslandHistory>,
    /// Timer of solver selection: decides in which update solvers are selected anew for all islands.
    pub(super) timer: ReselectionTimer,
    /// Whether `islands` lists the present contacts and joints. If not, `select_solvers` lists them before the next solve.
    is_listed: bool,
    /// Islands of the direct solver. The first `count` are in use; the others keep their memory.
    islands: Vec<DirectIsland>,
    /// Number of islands in use, a count of the first elements of `islands`.
    count: usize,
    /// Lengths of the last step and of one of its substeps, in seconds. A change makes the stored sums of impulses invalid.
    step_lengths: [f32; 2],
    /// Islands of the last solver selection or listing, with the facts about each.
    pub(super) census: IslandCensus,
    /// Scratch: pairs of an island and its body or pair, sorted by island. The first number is a union-find root or an index
    /// into `islands`, the second a body index or pair index.
    keyed_items: Vec<(u32, u32)>,
    /// Scratch: edges of the graph of one island, as indices into its members, smaller index first.
    edges: Vec<[u32; 2]>,
    /// Scratch: for each joint and spring between two dynamic bodies, the union-find root of its island and the two body
    /// indices.
    jointed_bodies: Vec<(u32, [u32; 2])>,
    /// Scratch of sorting: packed key and index of each item.
    sort_keys: Vec<(u128, u32)>,
}

reusing_clone! {
    DirectSolver { history, timer, is_listed, islands, count, step_lengths, census, keyed_items, edges, jointed_bodies, sort_keys }
}

/// Timer of solver selection: decides in which update islands are computed and solvers are selected again. Snapshots save it.
#[derive(Debug, Clone, Copy, Default, PartialEq, Serialize, Deserialize)]
pub(super) struct ReselectionTimer {
    /// Whether solvers are selected in this update, because an island of the direct solver has gained or lost constraints, or
    /// joints, springs or the choice have changed.
    pub(super) is_due: bool,
    /// Whether solvers are selected within [`RESELECTION_PERIOD`] updates, because an island of the iterative solver has gained
    /// or lost constraints or a pause has ended.
    pub(super) may_be_due: bool,
    /// Number of updates since `may_be_due` was set.
    #[serde(rename = "age")]
    waited_updates: u8,
    /// Whether some island is in a pause, so that pauses are counted down.
    #[serde(rename = "has_resting")]
    has_paused: bool,
    /// Hash of all joints and springs in the last update. A different hash makes the selection due.
    #[serde(rename = "joints")]
    joint_signature: u64,
    /// The user's choice of solvers for all islands: automatic, direct or iterative.
    choice: SolverChoice,
}

impl ReselectionTimer {
    /// Clears `is_due`, `may_be_due` and `waited_updates`, since solvers are selected in this update.
    fn restart(&mut self) {
        (self.is_due, self.may_be_due, self.waited_updates) = (false, false, 0);
    }
}

/// Facts about one island in the present update, on which solver selection depends.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct IslandStats {
    /// Number of dynamic bodies of the island.
    bodies: u32,
    /// Number of contact constraints of the island.
    contacts: u32,
    /// Number of bodies of the island whose last solver is the direct solver, other than for a [cold start](Self::is_cold_start).
    direct_bodies: u32,
    /// Number of further updates for which the iterative solver keeps the island; 0 without a pause.
    pause: u8,
    /// Number of joints and springs of the island; 0 in 2.5D.
    joints: u32,
    /// Whether the island has a joint or a hinged body that the direct solver cannot take.
    has_unsupported_joint: bool,
    /// Whether a contact of the island is about to apply restitution.
    bounces: bool,
    /// Whether a body of the island is not calm: faster than
    /// [`CALM_ISLAND_MAX_SPEED`](crate::precise::parameters::direct::CALM_ISLAND_MAX_SPEED).
    moves: bool,
    /// Whether a body of the island was not calm at an earlier solver selection. If not, the island is built in place.
    formed_by_motion: bool,
    /// In 2D: whether a contact of the island slides although its friction is within the limit. Such a contact shows that the
    /// iterative solver has not converged. A structure that stands by friction alone, such as a card house, then creeps until
    /// it topples.
    slips: bool,
    /// In 2D: whether a contact of the island has a normal impulse, from which the solver can start warm.
    has_load: bool,
    /// For islands with joints: whether the island had a pause lately, so that its [`back_off`](IslandHistory::back_off) is not
    /// 0.
    was_paused: bool,
    /// For islands with joints: whether a joint has a position error above
    /// [`ACCEPTED_JOINT_ERROR`](crate::precise::parameters::direct::ACCEPTED_JOINT_ERROR).
    has_joint_gap: bool,
    /// Whether the simulator has a depth axis (2.5D) and the island has contacts.
    has_depth: bool,
    /// Whether a contact of the island [excludes a solution in the plane](lateral_friction::blocks_planar_solution).
    has_nonplanar_contact: bool,
    /// Whether a heavy body of the island lies on a light one: see [`classify_load`](selection::SolverSelection::classify_load).
    has_heavy_on_light: bool,
    /// Whether a much heavier body may jam a light one in the island: see [`classify_load`](selection::SolverSelection::classify_load).
    may_jam: bool,
    /// Index of the island in the list of the direct solver; `None` if the iterative solver has it.
    island_index: Option<u32>,
}

impl IslandStats {
    /// Returns the reason why the direct solver does not take this island under the user's `choice`; `None` if it takes the
    /// island.
    pub(super) fn rejection_reason(&self, choice: SolverChoice) -> Option<SolverReason> {
        let refusals = [
            (self.bodies < 2 && self.joints == 0, SolverReason::OneBody),
            (self.has_unsupported_joint, SolverReason::Joints),
            (choice == SolverChoice::Iterative, SolverReason::Chosen),
            (self.bodies > DIRECT_ISLAND_BODIES && self.contacts > self.joints, SolverReason::TooLarge),
            (self.bounces, SolverReason::Bounces),
        ];
        first_reason(&refusals)
            .or_else(|| if choice == SolverChoice::Direct { None } else { self.cost_objection() })
    }

    /// Returns whether the island gets a pause of [`RESELECTION_PERIOD`] updates: a contact bounces or is not planar. In 2.5D
    /// the pause is only for islands with a heavy body on a light one; the direct solver takes no others there.
    fn must_back_off(&self) -> bool {
        (self.bounces || self.has_nonplanar_contact) && (self.has_heavy_on_light || !self.has_depth)
    }

    /// Returns whether the island has more contacts than bodies. Then the contact graph has cycles, or bodies are supported
    /// from two sides.
    fn has_contact_cycles(&self) -> bool {
        self.contacts > self.bodies
    }

    /// Returns whether the island has contacts.
    pub(super) fn has_contacts(&self) -> bool {
        self.contacts > 0
    }

    /// Returns whether the island is in 2D and has contact cycles, no joints and fewer than [`CYCLIC_ISLAND_BODIES`] bodies.
    /// The iterative solver suffices for such an island unless friction [slips](Self::slips).
    fn is_small_cycle(&self) -> bool {
        self.has_contact_cycles() && self.bodies < CYCLIC_ISLAND_BODIES && self.joints == 0 && !self.has_depth
    }

    /// Returns whether no contact of the island has an impulse yet, so that no solver can start warm.
    ///
    /// A [small island with contact cycles](Self::is_small_cycle) that is built in place then has one update in the direct
    /// solver, and hands its exact loads to the iterative solver. Without them friction slips in the iterative solver for some
    /// updates. In long steps a card house of 4 storeys creeps so far in one of them that it topples.
    fn is_cold_start(&self) -> bool {
        !self.has_load
    }

    /// Returns the reason why the iterative solver has this island, for the island report.
    pub(super) fn iterative_reason(&self, choice: SolverChoice) -> SolverReason {
        let pause = (self.pause > 0).then_some(SolverReason::Rests { updates: self.pause });
        let is_free = self.contacts == 0 && self.joints == 0;
        let joints = is_free.then_some(SolverReason::Joints);
        joints.or(self.rejection_reason(choice)).or(pause).unwrap_or(SolverReason::NotAskedYet)
    }

    /// Returns the reason why a direct solution of the island is not worth its cost; `None` if it is. Each condition is a row
    /// of the table at the head of the module.
    fn cost_objection(&self) -> Option<SolverReason> {
        let IslandStats { bodies, direct_bodies, .. } = *self;
        let (has_cycles, is_built) = (self.has_contact_cycles(), !(self.moves || self.formed_by_motion));
        let was_direct = 2 * direct_bodies > bodies;
        let pause = (self.pause > 0, SolverReason::Rests { updates: self.pause });
        first_reason(&if self.joints > 0 {
            let has_failed = self.was_paused && !was_direct && self.has_joint_gap;
            [pause, (has_failed, SolverReason::Moves), pause, pause]
        } else if self.has_depth {
            [
                pause,
                (self.has_nonplanar_contact, SolverReason::HasDepth),
                (!(self.has_heavy_on_light || was_direct), SolverReason::HasDepth),
                (has_cycles && bodies > CYCLIC_DEPTH_ISLAND_BODIES, SolverReason::TooLarge),
            ]
        } else if self.is_loaded() {
            [pause; 4]
        } else {
            [
                pause,
                (
                    self.is_small_cycle()
                        && !(is_built && (was_direct || self.slips || self.is_cold_start())),
                    SolverReason::TooSmall,
                ),
                (has_cycles && !is_built && !was_direct, SolverReason::Moves),
                (!has_cycles && !is_built && bodies < ACYCLIC_MOVING_ISLAND_BODIES, SolverReason::Moves),
            ]
        })
    }
}

/// Returns the reason of the first pair in `refusals` whose condition is true; `None` if all are false.
#[inline(never)]
fn first_reason(refusals: &[(bool, SolverReason)]) -> Option<SolverReason> {
    refusals.iter().find(|(applies, _)| *applies).map(|&(_, reason)| reason)
}

impl DirectSolver {
    /// Removes all islands, and clears the island histories of `bodies` bodies.
    pub(super) fn reset(&mut self, bodies: usize) {
        self.history.clear();
        self.history.resize(bodies, IslandHistory::default());
        self.is_listed = false;
        self.count = 0;
    }

    /// Clears the island history of a removed body. Makes solver selection due if its island was in the direct solver.
    pub(super) fn forget_body(&mut self, body: usize) {
        self.timer.is_due |= self.history[body].is_direct;
        self.history[body] = IslandHistory::default();
    }

    /// Returns whether the direct solver has the island of this body.
    #[inline(always)]
    pub(super) fn is_direct(&self, body: usize) -> bool {
        self.history.get(body).is_some_and(|history| history.is_direct)
    }

    /// Makes solver selection due after a contact constraint between `bodies` was added or removed: in this update if one of
    /// them is in the direct solver. Otherwise selection follows within the period, in 2D only (`has_depth` is false).
    #[inline(always)]
    pub(super) fn note_constraint_change(&mut self, bodies: [u32; 2], has_depth: bool) {
        self.timer.is_due |= bodies.iter().any(|&body| self.is_direct(body as usize));
        self.timer.may_be_due |= !has_depth;
    }

    /// Starts friction checks for `body`, the dynamic body B of a new contact. Has no effect in 2.5D (`has_depth`), nor if the
    /// island of the body is in the direct solver or was formed by motion.
    pub(super) fn watch_friction(&mut self, body: u32, has_depth: bool) {
        let history = &mut self.history[body as usize];
        if !(has_depth || history.is_direct || history.formed_by_motion) {
            history.begin_friction_checks();
        }
    }

    /// Stores `signature`, the hash of all joints and springs in this update. A changed hash makes solver selection due at
    /// once. `is_order_new` makes the islands list their joints again.
    ///
    /// Reason for the haste: a soft chain stretches while it waits in the iterative solver, and hardly any direct solution
    /// leads back from there.
    pub(super) fn note_joints(&mut self, signature: u64, is_order_new: bool) {
        self.is_listed &= !is_order_new;
        let ReselectionTimer { joint_signature, is_due, .. } = &mut self.timer;
        if std::mem::replace(joint_signature, signature) != signature {
            self.is_listed = false;
            *is_due = true;
        }
    }

    /// Sets the user's choice of solvers, from this update on.
    pub(super) fn set_choice(&mut self, choice: SolverChoice) {
        self.timer.is_due |= std::mem::replace(&mut self.timer.choice, choice) != choice;
    }

    /// Returns the user's choice of solvers for all islands.
    pub(super) fn choice(&self) -> SolverChoice {
        self.timer.choice
    }

    /// Returns, for each island of the direct solver, the index of its first body and its number of Newton steps in the last
    /// update.
    pub(super) fn newton_steps_of_islands(&self) -> impl Iterator<Item = (usize, usize)> + '_ {
        let first =
            |island: &DirectIsland| Some((island.system.members.first()?.body as usize, island.newton_steps));
        self.islands[..self.count].iter().filter_map(first)
    }

    /// Returns whether the direct solver has no island and solver selection is not due, so that both can be skipped.
    pub(super) fn is_idle(&self) -> bool {
        let ReselectionTimer { is_due, may_be_due, waited_updates, has_paused, .. } = self.timer;
        self.is_listed && self.count == 0 && waited_updates == 0 && !(is_due || may_be_due || has_paused)
    }

    /// Returns whether the islands list the present contacts and joints.
    pub(super) fn is_listed(&self) -> bool {
        self.is_listed
    }

    /// Marks the islands as listed: they list the present contacts and joints.
    pub(super) fn mark_listed(&mut self) {
        self.is_listed = true;
    }

    /// Counts one update of the timer and of all pauses. Returns whether solvers are selected in this update; the timer then
    /// starts anew. With `is_quick`, changes in islands of the iterative solver do not wait for the
    /// [period](RESELECTION_PERIOD).
    pub(super) fn begin_selection(&mut self, is_quick: bool) -> bool {
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
            for history in self.history.iter_mut().filter(|wear| wear.pause > 0) {
                history.pause -= 1;
                *may_be_due |= history.pause == 0;
                *has_paused |= history.pause > 0;
            }
        }
        *waited_updates = if *may_be_due { *waited_updates + 1 } else { 0 };
        *is_due || (*may_be_due && (*waited_updates >= RESELECTION_PERIOD || is_quick))
    }
}
