//! Facts about the islands of an update, and the reasons why the direct solver does not take an island.

use std::ops::Range;

use crate::index::{BodyIndex, IndexedVec, index_type};
use crate::island::union_find::UnionFind;
use crate::island_report::SolverReason;
use crate::parameters::direct::{
    ACYCLIC_MOVING_ISLAND_BODIES, CYCLIC_DEPTH_ISLAND_BODIES, CYCLIC_ISLAND_BODIES, DIRECT_ISLAND_BODIES,
};
use crate::reusing_clone;
use crate::solver_choice::SolverChoice;

index_type! {
    /// Index of an island of the direct solver.
    pub(super) struct IslandIndex;
}

/// The islands of awake bodies, with the facts about each.
#[derive(Debug, Default)]
pub struct IslandCensus {
    /// Union-find of body indices: one set per island.
    pub(super) union_find: UnionFind<BodyIndex>,
    /// Facts about each island, by the body index that is its union-find root.
    pub(super) stats: IndexedVec<BodyIndex, IslandStats>,
    /// Ranges of body indices with awake bodies in the last census. Outside of them each body is an island without facts, but
    /// for contacts of sleeping bodies with kinematic ones.
    awake_body_runs: Vec<Range<usize>>,
}

reusing_clone! { IslandCensus { union_find, stats, awake_body_runs } }

impl IslandCensus {
    /// Makes each body an island without facts. `bodies`: number of body indices; `awake_body_runs`: ranges of the indices of
    /// awake bodies, which contain all that the census is going to change.
    pub(super) fn reset(&mut self, bodies: usize, awake_body_runs: &[Range<usize>]) {
        if self.stats.len() == bodies {
            for run in self.awake_body_runs.iter().chain(awake_body_runs) {
                self.union_find.separate(run.clone());
                self.stats.slice_mut(run.clone()).fill(IslandStats::default());
            }
        } else {
            self.union_find.reset(bodies);
            self.stats.clear();
            self.stats.resize(bodies, IslandStats::default());
        }
        self.awake_body_runs.clear();
        self.awake_body_runs.extend_from_slice(awake_body_runs);
    }

    /// Returns whether an island has a joint or a spring.
    pub(super) fn has_joints(&self) -> bool {
        self.awake_body_runs.iter().any(|run| self.stats.slice(run.clone()).iter().any(|of| of.joints > 0))
    }

    /// Returns the facts about the island of the body with index `body`.
    #[inline(always)]
    pub fn stats_of(&mut self, body: BodyIndex) -> &mut IslandStats {
        let root = self.root_of(body);
        &mut self.stats[root]
    }

    /// Returns the body that is the union-find root of the island of a body.
    #[inline(always)]
    pub(super) fn root_of(&mut self, body: BodyIndex) -> BodyIndex {
        BodyIndex(self.union_find.find(body).0)
    }
}

/// Facts about one island in the present update, on which solver selection depends.
#[derive(Debug, Clone, Copy, Default)]
pub struct IslandStats {
    /// Number of dynamic bodies of the island.
    pub(super) bodies: u32,
    /// Number of contact constraints of the island.
    pub(super) contacts: u32,
    /// Number of bodies of the island whose last solver is the direct solver.
    pub(super) direct_bodies: u32,
    /// Number of further updates for which the iterative solver keeps the island; 0 without a pause.
    pub(super) pause: u8,
    /// Number of joints and springs of the island; 0 in 2.5D.
    pub(super) joints: u32,
    /// Whether the island has a joint or a hinged body that the direct solver cannot take.
    pub(super) has_unsupported_joint: bool,
    /// Whether a contact of the island is about to apply restitution.
    pub(super) bounces: bool,
    /// Whether a contact of the island has rolling resistance.
    pub(super) resists_rolling: bool,
    /// Whether a body of the island is not calm: faster than
    /// [`CALM_ISLAND_MAX_SPEED`](crate::parameters::direct::CALM_ISLAND_MAX_SPEED).
    pub(super) moves: bool,
    /// Whether a body of the island was not calm at an earlier solver selection. If not, the island is built in place.
    pub(super) formed_by_motion: bool,
    /// In 2D: whether a contact of the island slides although its friction is within the limit. Such a contact shows that the
    /// iterative solver has not converged. A structure that stands by friction alone, such as a card house, then creeps until
    /// it topples.
    pub(super) slips: bool,
    /// In 2D: whether a contact of the island has a normal impulse, from which the solver can start warm.
    pub(super) has_load: bool,
    /// For islands with joints: whether the island had a pause lately, so that its [`back_off`](super::island_history::IslandHistory::back_off) is not
    /// 0.
    pub(super) was_paused: bool,
    /// For islands with joints: whether a joint has a position error above
    /// [`ACCEPTED_JOINT_ERROR`](crate::parameters::direct::ACCEPTED_JOINT_ERROR).
    pub(super) has_joint_gap: bool,
    /// Whether the simulator has a depth axis (2.5D) and the island has contacts.
    pub(super) has_depth: bool,
    /// Whether a contact of the island [excludes a solution in the plane](super::lateral_friction::blocks_planar_solution).
    pub(super) has_nonplanar_contact: bool,
    /// Whether a heavy body of the island lies on a light one: see [`classify_load`](super::selection::SolverSelection::classify_load).
    pub(super) has_heavy_on_light: bool,
    /// Whether a much heavier body may jam a light one in the island: see [`classify_load`](super::selection::SolverSelection::classify_load).
    pub(super) may_jam: bool,
    /// Whether at most [`IMMEDIATE_RESELECTION_BODIES`](crate::parameters::direct::IMMEDIATE_RESELECTION_BODIES) bodies are awake.
    pub(super) has_few_awake_bodies: bool,
    /// Index of the island in the list of the direct solver; `None` if the iterative solver has it.
    pub(super) island_index: Option<IslandIndex>,
}

impl IslandStats {
    /// Returns the reason why the direct solver does not take this island under the user's `choice`; `None` if it takes the
    /// island.
    pub(crate) fn rejection_reason(&self, choice: SolverChoice) -> Option<SolverReason> {
        let refusals = [
            (self.bodies < 2 && self.joints == 0, SolverReason::OneBody),
            (self.has_unsupported_joint, SolverReason::Joints),
            (choice == SolverChoice::Iterative, SolverReason::Chosen),
            (self.bodies > DIRECT_ISLAND_BODIES && self.contacts > self.joints, SolverReason::TooLarge),
            (self.bounces, SolverReason::Bounces),
            (self.resists_rolling, SolverReason::RollingResistance),
        ];
        first_reason(&refusals)
            .or_else(|| if choice == SolverChoice::Direct { None } else { self.cost_objection() })
    }

    /// Returns whether the island gets a pause of
    /// [`RESELECTION_PERIOD`](crate::parameters::direct::RESELECTION_PERIOD) updates: a contact bounces or is
    /// not planar. In 2.5D the pause is only for islands with a heavy body on a light one; the direct solver takes no others
    /// there.
    pub(super) fn must_back_off(&self) -> bool {
        (self.bounces || self.has_nonplanar_contact) && (self.has_heavy_on_light || !self.has_depth)
    }

    /// Returns whether the island has more contacts than bodies. Then the contact graph has cycles, or bodies are supported
    /// from two sides.
    pub(super) fn has_contact_cycles(&self) -> bool {
        self.contacts > self.bodies
    }

    /// Returns whether the island has contacts.
    pub fn has_contacts(&self) -> bool {
        self.contacts > 0
    }

    /// Returns whether the island is in 2D and has contact cycles, no joints and fewer than [`CYCLIC_ISLAND_BODIES`] bodies.
    /// The iterative solver suffices for such an island unless friction [slips](Self::slips).
    pub(super) fn is_small_cycle(&self) -> bool {
        self.has_contact_cycles() && self.bodies < CYCLIC_ISLAND_BODIES && self.joints == 0 && !self.has_depth
    }

    /// Returns whether the island has joints, but is mainly a pile that moves: at least [`CYCLIC_ISLAND_BODIES`] bodies, with contact
    /// cycles and more contacts than joints. The active set of so many contacts changes in each update, and no solution repays the cost.
    fn is_moving_pile(&self) -> bool {
        self.moves
            && self.bodies >= CYCLIC_ISLAND_BODIES
            && self.has_contact_cycles()
            && self.contacts > self.joints
    }

    /// Returns whether the direct solver gets this island on trial under the user's `choice`. It finds out whether the island
    /// stands [by friction](super::island_solver::IslandSolver::stands_by_friction). If not, the iterative solver has it in the
    /// same update.
    ///
    /// This holds for a [small island with contact cycles](Self::is_small_cycle) that is built in place, before its first
    /// solution. In the iterative solver friction would slip during the first updates, since the contacts have no impulses yet.
    /// In long steps a card house of 4 storeys creeps so far in a single one that it topples.
    pub(super) fn is_on_trial(&self, choice: SolverChoice) -> bool {
        choice == SolverChoice::Auto
            && self.is_small_cycle()
            && !(self.is_loaded() || self.moves || self.formed_by_motion)
            && !(self.has_load || self.slips || self.was_direct())
    }

    /// Returns whether the direct solver had most bodies of the island in the last update.
    fn was_direct(&self) -> bool {
        2 * self.direct_bodies > self.bodies
    }

    /// Returns the reason why the iterative solver has this island, for the island report.
    pub fn iterative_reason(&self, choice: SolverChoice) -> SolverReason {
        let pause = (self.pause > 0).then_some(SolverReason::Rests { updates: self.pause });
        let is_free = self.contacts == 0 && self.joints == 0;
        let joints = is_free.then_some(SolverReason::Joints);
        joints.or(self.rejection_reason(choice)).or(pause).unwrap_or(SolverReason::NotAskedYet)
    }

    /// Returns the reason why a direct solution of the island is not worth its cost; `None` if it is. Each condition is a row
    /// of the table at the head of the module.
    fn cost_objection(&self) -> Option<SolverReason> {
        let bodies = self.bodies;
        let (has_cycles, is_built) = (self.has_contact_cycles(), !(self.moves || self.formed_by_motion));
        let was_direct = self.was_direct();
        let pause = (self.pause > 0, SolverReason::Rests { updates: self.pause });
        first_reason(&if self.joints > 0 {
            let has_failed = self.was_paused && !was_direct && self.has_joint_gap;
            [pause, (has_failed, SolverReason::Moves), (self.is_moving_pile(), SolverReason::Moves), pause]
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
                    self.is_small_cycle() && !(is_built && (was_direct || self.slips || !self.has_load)),
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
