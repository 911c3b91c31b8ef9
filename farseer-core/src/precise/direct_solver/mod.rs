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
//! | 2D, contact cycles, up to 39 bodies | if calm as above and friction [slips](IslandStats::slips) in the iterative solver |
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
mod island_io;
mod island_members;
mod island_newton;
pub(in crate::precise) mod joint;
pub(in crate::precise) mod joint_island;
mod lateral_friction;
mod mass_ratio;
pub(in crate::precise) mod mat3;

use crate::precise::parameters::direct::{
    ACCEPTED_JOINT_ERROR, ACYCLIC_MOVING_ISLAND_BODIES, BUSY_ISLAND_PAUSE, CALM_ISLAND_MAX_SPEED,
    CYCLIC_DEPTH_ISLAND_BODIES, CYCLIC_ISLAND_BODIES, DIRECT_ISLAND_BODIES, FACTOR_PRODUCTS_PER_BODY,
    FRICTION_CHECK_MAX_DOUBLINGS, IMMEDIATE_RESELECTION_BODIES, JOINTED_FACTOR_PRODUCTS_PER_BODY,
    RESELECTION_PERIOD, SLIP_SPEED, STICKING_FRICTION_FRACTION,
};
use serde::{Deserialize, Serialize};

use super::Precise;
use super::constraint_graph::{ContactConstraint, ContactPoint};
use super::scaled_parameters::LoadAdaptation;
use crate::methods::SolverChoice;
use crate::precise::broad_phase::proxies::BodyType;
use crate::precise::island::report::SolverReason;
use crate::precise::island::union_find::UnionFind;
use crate::storage::order::{packed_key, sort_by_number_in};
use crate::storage::reusing_clone::reusing_clone;
use constraint::Jacobian;
use island_io::DirectIsland;
use island_members::{add_joint_edges, list_contact_edges, list_jointed_bodies};
use island_newton::IslandBody;
use lateral_friction::is_planar;
pub(super) use lateral_friction::{is_heavy_on_light, is_support_normal};
use mass_ratio::exceeds_mass_ratio;

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
    /// Whether a body of the island was not calm (faster than [`CALM_ISLAND_MAX_SPEED`]) at an earlier solver selection. If
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
    /// Number of updates until the next [friction check](Precise::check_friction) of the body in the iterative solver.
    #[serde(rename = "look_in")]
    pub(super) friction_check_in: u8,
    /// Number of [friction checks](Precise::check_friction) of the body so far plus one; 0 for a body that is not checked.
    #[serde(rename = "watch")]
    pub(super) friction_checks: u8,
}

impl IslandHistory {
    /// Starts the friction checks of the body; the first one is in the next update. Called for a new contact, and when solver
    /// selection leaves a small island with contact cycles to the iterative solver.
    fn begin_friction_checks(&mut self) {
        (self.friction_check_in, self.friction_checks) = (1, 1);
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
    /// Union-find of body indices: the islands of the last solver selection or listing.
    union_find: UnionFind,
    /// Facts about each island of the last selection or listing, by the body index that is its union-find root.
    stats: Vec<IslandStats>,
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
    DirectSolver { history, timer, is_listed, islands, count, step_lengths, union_find, stats, keyed_items, edges, jointed_bodies, sort_keys }
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
    /// Number of bodies of the island whose last solver is the direct solver.
    direct_bodies: u32,
    /// Number of further updates for which the iterative solver keeps the island; 0 without a pause.
    pause: u8,
    /// Number of joints and springs of the island; 0 in 2.5D.
    joints: u32,
    /// Whether the island has a joint or a hinged body that the direct solver cannot take.
    has_unsupported_joint: bool,
    /// Whether a contact of the island is about to apply restitution.
    bounces: bool,
    /// Whether a body of the island is not calm: faster than [`CALM_ISLAND_MAX_SPEED`].
    moves: bool,
    /// Whether a body of the island was not calm at an earlier solver selection. If not, the island is built in place.
    formed_by_motion: bool,
    /// In 2D: whether a contact of the island slides although its friction is within the limit. Such a contact shows that the
    /// iterative solver has not converged. A structure that stands by friction alone, such as a card house, then creeps until
    /// it topples.
    slips: bool,
    /// For islands with joints: whether the island had a pause lately, so that its [`back_off`](IslandHistory::back_off) is not
    /// 0.
    was_paused: bool,
    /// For islands with joints: whether a joint has a position error above [`ACCEPTED_JOINT_ERROR`].
    has_joint_gap: bool,
    /// Whether the simulator has a depth axis (2.5D) and the island has contacts.
    has_depth: bool,
    /// Whether a contact of the island [excludes a solution in the plane](Precise::blocks_planar_solution).
    has_nonplanar_contact: bool,
    /// Whether a heavy body of the island lies on a light one: see [`classify_load`](Precise::classify_load).
    has_heavy_on_light: bool,
    /// Whether a much heavier body may jam a light one in the island: see [`classify_load`](Precise::classify_load).
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
                (self.is_small_cycle() && !(is_built && (self.slips || was_direct)), SolverReason::TooSmall),
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

    /// Counts one update of the timer and of all pauses. Returns whether solvers are selected in this update. With `is_quick`,
    /// changes in islands of the iterative solver do not wait for the [period](RESELECTION_PERIOD).
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

impl Precise {
    /// Solver selection: computes islands and selects a solver for each island, if the selection is due. Otherwise it lists the
    /// contacts and joints of the islands where these have changed. `learning` scales the rest impulses of constraints that
    /// return to the iterative solver.
    pub(super) fn select_solvers(&mut self, learning: &LoadAdaptation) {
        if self.has_restitution || self.depth.is_some() {
            let (states, min_speed) = (&self.bodies.states, self.parameters.restitution_threshold);
            let velocity = |body: u32| states[body as usize].velocity;
            let is_rejected = |contact: &ContactConstraint| {
                let velocities = [contact.a, contact.b].map(velocity);
                bounces(contact, velocities, min_speed) || self.blocks_planar_solution(contact, velocities)
            };
            self.direct_solver.timer.is_due |=
                self.constraints.direct_constraints().iter().any(|row| is_rejected(&row.constraint));
        }
        if self.depth.is_some() && self.direct_solver.is_listed && !self.direct_solver.timer.is_due {
            self.direct_solver.is_listed = self.are_contacts_listed();
        }
        self.check_friction();
        let moves = |body: usize| self.exceeds_calm_speed(self.bodies.states[body].velocity);
        let is_calm = || !self.sleep.awake_bodies(self.bodies.last_movable).any(moves);
        let is_always_direct = self.direct_solver.timer.choice == SolverChoice::Direct;
        let is_quick = self.direct_solver.timer.may_be_due
            && (is_always_direct
                || (self.has_few_awake_bodies()
                    && (!self.joints.is_empty()
                        || !self.springs.is_empty()
                        || is_calm()
                        || self.has_unsolved_load())));
        let selects = self.direct_solver.is_reselection_due(is_quick);
        if selects {
            self.direct_solver.timer.restart();
        }
        if selects || !self.direct_solver.is_listed {
            self.collect_island_stats();
            self.plan_islands(selects);
            if selects {
                self.move_constraints(learning);
            }
            self.list_contacts();
            self.list_joints();
        }
        self.direct_solver.is_listed = true;
    }

    /// Makes solver selection due if friction [slips](IslandStats::slips) at a calm body that is due for a friction check, in
    /// an island built in place. Only in 2D.
    fn check_friction(&mut self) {
        if self.depth.is_some() {
            return;
        }
        let mut is_due = false;
        for body in self.sleep.awake_bodies(self.bodies.last_movable) {
            is_due |= self.direct_solver.history[body].is_friction_check_due();
        }
        if is_due {
            self.direct_solver.timer.is_due |= (0..self.pairs.awake_count).any(|pair| self.is_slipping(pair));
        }
    }

    /// Returns whether the contact with index `pair` slips in the iterative solver. The result is false unless its body B is
    /// calm, was due for a friction check in this update, and belongs to an island built in place.
    fn is_slipping(&self, pair: usize) -> bool {
        let state = self.pairs.all[pair];
        let body = self.pairs.bodies_of(&self.proxies, pair)[1].0;
        let IslandHistory { friction_checks, friction_check_in, formed_by_motion, .. } =
            self.direct_solver.history[body];
        let was_checked = friction_checks > 1
            && friction_check_in == 1 << (friction_checks - 1).min(FRICTION_CHECK_MAX_DOUBLINGS);
        let velocity = |body: u32| self.bodies.states[body as usize].velocity;
        let is_calm = || !self.exceeds_calm_speed(velocity(body as u32));
        let handle = state
            .constraint
            .filter(|home| was_checked && !formed_by_motion && !home.is_in_direct_solver() && is_calm());
        let limit = SLIP_SPEED * self.parameters.length_unit;
        handle.is_some_and(|home| slips(&self.constraints.get(state.kind, home), &velocity, limit))
    }

    /// Returns whether the islands list all planar contacts of the direct solver and no other contacts. The normal of a contact
    /// may turn towards the depth axis or back while the contact persists.
    fn are_contacts_listed(&self) -> bool {
        let in_plane =
            self.constraints.direct_constraints().iter().filter(|row| is_planar(&row.constraint)).count();
        let islands = &self.direct_solver.islands[..self.direct_solver.count];
        let listed: usize = islands.iter().map(|island| island.contact_handles.len()).sum();
        let mut handles = islands.iter().flat_map(|island| &island.contact_handles);
        listed == in_plane
            && handles.all(|&handle| is_planar(&self.constraints.direct_constraint(handle).constraint))
    }

    /// Returns whether at most [`IMMEDIATE_RESELECTION_BODIES`] bodies are awake.
    fn has_few_awake_bodies(&self) -> bool {
        self.bodies.movable_count - self.asleep_count() <= IMMEDIATE_RESELECTION_BODIES
    }

    /// Sets the user's choice of solvers, from this update on.
    pub(crate) fn set_solver_choice(&mut self, choice: SolverChoice) {
        let timer = &mut self.direct_solver.timer;
        timer.is_due |= std::mem::replace(&mut timer.choice, choice) != choice;
    }

    /// Returns whether the linear velocity `x`, `y` (length units/s) of a body is faster than [`CALM_ISLAND_MAX_SPEED`].
    fn exceeds_calm_speed(&self, [x, y, ..]: [f32; 4]) -> bool {
        let calm = CALM_ISLAND_MAX_SPEED * self.parameters.length_unit;
        x * x + y * y > calm * calm
    }

    /// Computes the islands of awake bodies and the facts about each, into `union_find` and `stats` of the direct solver.
    fn collect_island_stats(&mut self) {
        let mut union_find = std::mem::take(&mut self.direct_solver.union_find);
        let mut stats = std::mem::take(&mut self.direct_solver.stats);
        self.count_islands(&mut union_find, &mut stats, &|body| self.bodies.states[body as usize].velocity);
        (self.direct_solver.union_find, self.direct_solver.stats) = (union_find, stats);
    }

    /// Computes the islands of awake bodies by union-find. `all_stats` gets the facts about each island, by the body index that
    /// is its root. `velocity` returns the velocity of a body: x and y (length units/s), angular (radians/s), depth axis
    /// (length units/s).
    pub(super) fn count_islands(
        &self,
        union_find: &mut UnionFind,
        all_stats: &mut Vec<IslandStats>,
        velocity: &dyn Fn(u32) -> [f32; 4],
    ) {
        self.unite_bodies(union_find);
        let heavy_ratio = self.heavy_mass_ratio();
        all_stats.clear();
        all_stats.resize(self.bodies.states.len(), IslandStats::default());
        for body in
            self.sleep.awake_bodies(self.bodies.last_movable).filter(|&body| !self.bodies.is_kinematic(body))
        {
            let stats = &mut all_stats[union_find.find(body as u32) as usize];
            stats.bodies += 1;
            let history = self.direct_solver.history[body];
            stats.direct_bodies += u32::from(history.is_direct);
            stats.has_unsupported_joint |= self.depth.is_some() && self.joints.has_joint(body);
            stats.was_paused |= history.back_off > 0;
            stats.pause = stats.pause.max(history.pause);
            stats.moves |= self.exceeds_calm_speed(velocity(body as u32));
            stats.formed_by_motion |= history.formed_by_motion;
        }
        self.count_joints(union_find, all_stats);
        for pair in 0..self.pairs.awake_count {
            let state = self.pairs.all[pair];
            let Some(handle) = state.constraint else { continue };
            let [(one, mobility), (body, _)] = self.pairs.bodies_of(&self.proxies, pair);
            let sides = [one, body];
            let stats = &mut all_stats[union_find.find(body as u32) as usize];
            stats.contacts += 1;
            stats.has_unsupported_joint |= mobility == BodyType::Hinged;
            stats.has_depth = self.depth.is_some();
            if !(stats.slips || stats.has_depth) {
                stats.slips = slips(
                    &self.constraints.get(state.kind, handle),
                    velocity,
                    SLIP_SPEED * self.parameters.length_unit,
                );
            }
            let inverse_masses = sides.map(|body| self.bodies.inverse_mass_inertia[body][0]);
            if self.has_restitution || stats.has_depth || exceeds_mass_ratio(inverse_masses, heavy_ratio) {
                let contact = self.constraints.get(state.kind, handle);
                let velocities = [contact.a, contact.b].map(velocity);
                stats.bounces |= bounces(&contact, velocities, self.parameters.restitution_threshold);
                stats.has_nonplanar_contact |= self.blocks_planar_solution(&contact, velocities);
                let [is_heavy_on_light, may_jam] = self.classify_load(&contact);
                stats.has_heavy_on_light |= is_heavy_on_light;
                stats.may_jam |= may_jam;
            }
        }
    }

    /// Adds the joints and springs in 2D to the facts about their islands in `all_stats`, which is indexed by union-find root.
    fn count_joints(&self, union_find: &mut UnionFind, all_stats: &mut [IslandStats]) {
        let max_error = ACCEPTED_JOINT_ERROR as f32 * self.parameters.length_unit;
        let all = self.joints.candidates().chain(self.springs.candidates());
        for joint in all.filter(|_| self.depth.is_none()) {
            let Some(body) = joint.first_dynamic_body() else { continue };
            let stats = &mut all_stats[union_find.find(body) as usize];
            stats.joints += 1;
            stats.has_unsupported_joint |= joint.is_free_articulation || !joint.has_rows;
            stats.has_joint_gap |= joint.error > max_error;
        }
    }

    /// Lists the members of each island of the direct solver, in ascending order, and analyses its matrix. With `selects`
    /// solvers are selected anew, otherwise each island keeps its solver. An island whose factorisation has too much fill-in
    /// goes to the iterative solver for a pause of [`BUSY_ISLAND_PAUSE`] updates.
    fn plan_islands(&mut self, selects: bool) {
        let Precise { direct_solver, bodies, pairs, proxies, sleep, joints, springs, .. } = self;
        let DirectSolver {
            islands,
            union_find,
            stats,
            keyed_items,
            edges,
            jointed_bodies,
            sort_keys,
            history,
            timer,
            ..
        } = direct_solver;
        keyed_items.clear();
        for body in sleep.awake_bodies(bodies.last_movable) {
            let root = union_find.find(body as u32);
            let island_stats = &stats[root as usize];
            let is_wanted = if selects {
                island_stats.rejection_reason(timer.choice).is_none()
            } else {
                history[body].is_direct
            };
            keyed_items.extend(is_wanted.then_some((root, body as u32)));
            history[body].formed_by_motion |= selects && island_stats.moves;
            let is_given_up = island_stats.joints > 0 && island_stats.was_paused && !is_wanted;
            if selects && (island_stats.must_back_off() || is_given_up) && history[body].pause == 0 {
                history[body].pause = RESELECTION_PERIOD;
                timer.has_paused = true;
            }
            let is_watched = !is_wanted
                && island_stats.is_small_cycle()
                && !(island_stats.moves || island_stats.formed_by_motion);
            if selects && !is_watched {
                history[body].friction_checks = 0;
            } else if selects && history[body].friction_checks == 0 {
                history[body].begin_friction_checks();
            }
        }
        sort_by_number_in(sort_keys, keyed_items, |&(root, body)| packed_key([root, body]));
        if selects {
            history.iter_mut().for_each(|entry| entry.is_direct = false);
        }
        jointed_bodies.clear();
        if stats.iter().any(|of| of.joints > 0) {
            list_jointed_bodies((&*joints, &*springs), union_find, jointed_bodies, sort_keys);
        }
        let mut count = 0;
        for members in keyed_items.chunk_by(|one, other| one.0 == other.0) {
            if islands.len() == count {
                islands.push(DirectIsland::default());
            }
            let island = &mut islands[count];
            island.springs.clear();
            island.spring_bodies.clear();
            let DirectIsland {
                system,
                contact_handles,
                contact_bodies,
                has_impulse_sum,
                resting_bodies,
                joints: of_island,
                joint_bodies,
                ..
            } = island;
            contact_handles.clear();
            contact_bodies.clear();
            of_island.clear();
            joint_bodies.clear();
            *has_impulse_sum = false;
            resting_bodies.clear();
            system.members.clear();
            system.members.extend(
                members.iter().map(|&(_, number)| IslandBody { body: number, ..IslandBody::default() }),
            );
            list_contact_edges(members, pairs, proxies, edges, sort_keys);
            let has_joints = stats[members[0].0 as usize].joints > 0;
            if has_joints {
                add_joint_edges(members, jointed_bodies, edges, sort_keys);
            }
            let max_products =
                if has_joints { JOINTED_FACTOR_PRODUCTS_PER_BODY } else { FACTOR_PRODUCTS_PER_BODY };
            let mut merged = merged_history(members, history);
            if system.factor.analyse(members.len(), edges, max_products * members.len()) {
                stats[members[0].0 as usize].island_index = Some(count as u32);
                count += 1;
            } else {
                (merged.is_direct, merged.pause) = (false, BUSY_ISLAND_PAUSE);
                timer.has_paused = true;
            }
            if selects {
                members.iter().for_each(|&(_, body)| history[body as usize] = merged);
            }
        }
        direct_solver.count = count;
    }

    /// Moves contact constraints between the graph colours and the direct solver, as selected. A constraint keeps its impulses
    /// when it moves.
    ///
    /// The rest impulse of a constraint that returns to the iterative solver is its whole last load. After an impact such rest
    /// impulses would press against each other for a second in contact cycles. Islands with joints are softer in the iterative
    /// solver. In both cases the rest impulse is multiplied by the `adapted_fraction` of `learning`.
    fn move_constraints(&mut self, learning: &LoadAdaptation) {
        for pair in 0..self.pairs.awake_count {
            let Some(handle) = self.pairs.all[pair].constraint else { continue };
            let body = self.pairs.bodies_of(&self.proxies, pair)[1].0;
            let (is_direct, was_direct) = (self.direct_solver.is_direct(body), handle.is_in_direct_solver());
            if is_direct != was_direct {
                let root = self.direct_solver.union_find.find(body as u32) as usize;
                let IslandHistory { formed_by_motion, has_accepted_solution, .. } =
                    self.direct_solver.history[body];
                let may_rock = has_accepted_solution
                    || (formed_by_motion && self.direct_solver.stats[root].has_contact_cycles());
                if was_direct && may_rock {
                    let points = &mut self.constraints.direct_constraint_mut(handle).constraint.points;
                    points.iter_mut().for_each(|point| point.rest_impulse *= learning.adapted_fraction);
                }
                let h = self.impulse_substep;
                self.narrow_phase().move_to_direct_solver(pair, is_direct, h);
            }
        }
        self.direct_solver
            .history
            .iter_mut()
            .for_each(|entry| entry.has_accepted_solution &= entry.is_direct);
    }

    /// Unites in `union_find` the dynamic bodies that contacts connect, and in 2D also those that joints and springs connect.
    fn unite_bodies(&self, union_find: &mut UnionFind) {
        union_find.reset(self.bodies.states.len());
        for pair in (0..self.pairs.awake_count).filter(|&pair| self.pairs.all[pair].constraint.is_some()) {
            if let [(a, BodyType::Dynamic), (b, BodyType::Dynamic)] =
                self.pairs.bodies_of(&self.proxies, pair)
            {
                union_find.unite(a as u32, b as u32);
            }
        }
        if self.depth.is_none() {
            let of_joints = self.joints.candidates().chain(self.springs.candidates());
            for [a, b] in of_joints.map(|joint| joint.bodies).filter(|[a, b]| *a != 0 && *b != 0) {
                union_find.unite(a, b);
            }
        }
    }
}

/// Returns whether a contact with restitution approaches faster than `min_speed` (length units/s). `a` and `b` are the
/// velocities of its bodies. The direct solver does not apply restitution.
fn bounces(contact: &ContactConstraint, [a, b]: [[f32; 4]; 2], min_speed: f32) -> bool {
    let along = contact.normal[0] * (b[0] - a[0]) + contact.normal[1] * (b[1] - a[1]);
    let is_fast = |point: &ContactPoint| {
        point.normal_mass > 0.0 && along + b[2] * point.normal_arm_b - a[2] * point.normal_arm_a < -min_speed
    };
    contact.restitution > 0.0 && contact.points.iter().any(is_fast)
}

/// Returns whether a contact slides faster than `limit` (length units/s) although its friction is within the limit. `velocity`
/// returns the velocity of a body.
fn slips(contact: &ContactConstraint, velocity: &dyn Fn(u32) -> [f32; 4], limit: f32) -> bool {
    let [a, b] = [contact.a, contact.b].map(|body| velocity(body).map(f64::from));
    let [.., along] =
        Jacobian::of_contact(contact).relative_velocities([a[0], a[1], a[2]], [b[0], b[1], b[2]]);
    let friction_limit =
        contact.friction * (contact.points[0].normal_impulse + contact.points[1].normal_impulse);
    contact.tangent_impulse.abs() < STICKING_FRICTION_FRACTION * friction_limit
        && (along - f64::from(contact.tangent_speed)).abs() > f64::from(limit)
}

/// Returns the common island history of `members` (pairs of union-find root and body index) that come from several islands: the
/// worse value of each field. `histories` are indexed by body.
fn merged_history(members: &[(u32, u32)], histories: &[IslandHistory]) -> IslandHistory {
    let first = IslandHistory { is_direct: true, has_accepted_solution: true, ..IslandHistory::default() };
    members.iter().map(|&(_, body)| histories[body as usize]).fold(first, |merged, other| IslandHistory {
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
        ..merged
    })
}
