//! The precise engine: bodies, pairs, constraints and solvers of its own, behind the same API as the faithful set. It shares
//! the objects with the faithful set, but no arithmetic.
//!
//! A step has these stages:
//!
//! | stage | what it does | where |
//! |---|---|---|
//! | 1 | imports edited objects | [`import`], [`add_remove`], [`geom_import`] |
//! | 2 | broad phase: removes pairs whose fat AABBs separated, finds new ones | [`broad_phase`](solver::broad_phase) |
//! | 3 | narrow phase: manifolds and contact constraints of pairs that moved | [`narrow_phase`](solver::narrow_phase), [`constraint_graph`](solver::constraint_graph) |
//! | 4 | reads bodies, forces and joints; selects the solver of each island | [`bodies`](solver::bodies), [`joints`](solver::joints), [`island`](solver::island) |
//! | 5 | solver: direct, articulations, iterative in substeps; then continuous collision | [`step`], [`continuous_collision`](solver::continuous_collision) |
//! | 6 | writes bodies, refits AABBs | [`step`], [`integration`](solver::integration) |
//! | 7 | puts islands at rest to sleep | [`sleep_stages`], [`island`](solver::island) |
//!
//! Files whose first line begins with "Adapter" name ids and objects of the game; [`ids`] translates them to indices.
//!
//! For `twohalf`, an engine on top of this one, all stages work in three axes ([`depth`](solver::depth)). Lengths are in the user's unit.
//! Parameters are multiples of one length unit ([`scaled_parameters`](solver::scaled_parameters)).

mod add_remove;
mod body_import;
mod body_io;
mod candidate_pairs;
mod contact_events;
mod contact_points;
pub(crate) mod depth_contact;
mod depth_events;
mod depth_import;
mod geom_import;
mod ids;
mod import;
mod island_report;
mod island_types;
mod joint_import;
mod joint_stages;
mod listed;
mod pending_edits;
mod query_candidates;
mod saved;
pub(crate) mod skip_step;
mod sleep_stages;
mod sleeping_joints;
pub(crate) mod solver;
mod spring_import;
mod step;
mod wake_import;

use serde::Deserialize;

pub use crate::precise::solver::island::report::IslandCost;
pub use crate::precise::solver::island::report::IslandResidual;
pub use crate::precise::solver::island::report::IslandSolver;
pub use crate::precise::solver::island::report::SolverReason;
use crate::storage::reusing_clone::reusing_clone;
use crate::surface::FrictionType;
pub use island_types::{AwakeReason, Island};
use saved::Saved;
pub(crate) use solver::scaled_parameters::StepContext;

use crate::precise::solver::broad_phase::fat_aabbs::FatAabbs;
use crate::precise::solver::broad_phase::hash_grid::HashGrid;
use crate::precise::solver::broad_phase::pairs::Pairs;
use crate::precise::solver::broad_phase::proxies::Proxies;
use crate::precise::solver::contact_solver::rolling::RollingContact;
use crate::precise::solver::island::sleep::SleepState;
use crate::precise::solver::parameters::direct::IMMEDIATE_RESELECTION_BODIES;
use ids::{AlwaysTested, IdTable};
use joint_import::JointTable;
use pending_edits::PendingEdits;
use sleeping_joints::SleepingJoint;
use solver::bodies::BodySet;
use solver::constraint_graph::{ColorUsage, ConstraintGraph};
use solver::continuous_collision::fast_body::FastBody;
use solver::continuous_collision::swept_motion::SweptMotion;
use solver::depth::feature_gate::FeatureGate;
use solver::depth::state::DepthState;
use solver::direct_solver::DirectSolver;
use solver::direct_solver::selection::SolverSelection;
use solver::joints::JointSystem;
use solver::joints::springs::SpringRows;
use solver::narrow_phase::contact_reader::ContactReader;
use solver::narrow_phase::{NarrowPhase, NarrowPhaseStats, TouchEvent};
use solver::scaled_parameters::Parameters;

/// State of the precise engine between steps.
#[derive(Debug, Deserialize)]
#[serde(from = "Saved")]
pub(crate) struct Precise {
    /// Parameters in the user's units: speculative distance, margins, thresholds.
    parameters: Parameters,
    /// Length of the substep in which the accumulated contact impulses last acted, seconds, >= 0. A step with another substep
    /// length scales the impulses.
    impulse_substep: f32,
    /// Length of the last step, seconds, >= 0. Fat AABBs reach ahead by the motion of a few steps of this length.
    dt: f32,
    /// Parameters of the last step, which the next one keeps if it has the same length and number of substeps; `None` before
    /// the first step.
    step_context: Option<StepContext>,
    /// Velocity change by gravity in the current step: x, y in length units/s.
    gravity_delta: crate::math::plane::Vector,
    /// State of a loaded snapshot until the next rebuild restores it; else `None`.
    loaded: Option<Saved>,
    /// Edits of the game since the last import.
    pub(crate) edits: PendingEdits,
    /// Whether any geom has, or any handler has set, a restitution coefficient above 0; else the solver skips restitution.
    has_restitution: bool,
    /// How the friction coefficients of two geoms combine to that of their contact.
    friction: FrictionType,
    /// Greatest number of contact points of a pair of convex pieces, 0..=2.
    max_contacts: u32,
    /// Poses, velocities, masses and extents of all bodies, by body index.
    bodies: BodySet,
    /// Convex pieces of geoms with their fat AABBs, by proxy index.
    proxies: Proxies,
    /// Broad phase: hash grid of the fat AABBs.
    grid: HashGrid,
    /// Pairs of proxies whose fat AABBs overlap.
    pairs: Pairs,
    /// Contact constraints of all pairs, in graph colours or parked.
    constraints: ConstraintGraph,
    /// Graph colours that the contact constraints of each body use.
    color_usage: ColorUsage,
    /// Joints with their constraints and solvers.
    joints: JointSystem,
    /// Ids of the joints in `joints`, and the springs that became constraint rows in this update.
    joint_table: JointTable,
    /// Springs that the solvers treat as constraint rows in this update.
    springs: SpringRows,
    /// Sleep state of bodies and islands: rest times, rings of sleeping bodies, requests to wake.
    sleep: SleepState,
    /// Joints of sleeping bodies as they were when the bodies fell asleep, in the order of the simulator's list.
    sleeping_joints: Vec<SleepingJoint>,
    /// The direct solver and the solver selection.
    direct_solver: DirectSolver,
    /// State of the depth axis; `None` in plain 2D.
    depth: Option<FeatureGate<Box<DepthState>>>,
    /// Ids of the game's bodies and geoms behind the indices into `bodies` and `proxies`.
    ids: IdTable,
    /// Geoms that every AABB query tests without the hash grid, in the order of the simulator's list of geoms.
    always_tested: Vec<AlwaysTested>,
    /// Touch events that the game has not received yet: pairs of convex pieces that began or ceased to touch.
    touch_events: Vec<TouchEvent>,
    /// Contacts with static bodies that ended in this narrow phase: index of the dynamic body, and penetration in length
    /// units. Empty between stages.
    ended_static_contacts: Vec<(u32, f32)>,
    /// Numbers of computed and of recycled manifolds in the narrow phase of this step.
    narrow_phase_stats: NarrowPhaseStats,
    /// Scratch: indices of the pairs that the narrow phase updates in this step.
    dirty_pairs: Vec<u32>,
    /// Contacts of polygons that roll over a static face in this step. Filled by the narrow phase, read by the iterative
    /// solver.
    rolling_contacts: Vec<RollingContact>,
    /// Whether a collision handler has vetoed a pair, removed contact points or set surface properties for this step.
    has_handler_changes: bool,
    /// Candidates of continuous collision: bodies whose displacement in this step exceeds their least extent. Valid within a
    /// step only.
    fast_bodies: Vec<FastBody>,
    /// Proxies of a sensor and of a fast body that crosses it within the step, the one with the smaller creation number first.
    /// A pair of geoms occurs once. Valid within a step only.
    sensor_passthroughs: Vec<[u32; 2]>,
    /// Scratch: proxies whose fat AABBs continuous collision has enlarged to contain the sweep of a fast body.
    enlarged_proxies: Vec<u32>,
    /// Proxies of static and kinematic bodies whose pairs the broad phase searched in this step.
    searched_static_proxies: Vec<u32>,
    /// Scratch: indices of pairs or proxies. Empty between stages.
    pair_scratch: Vec<u32>,
    /// Pairs of proxy indices that the broad phase has newly found. Valid within the broad phase only.
    new_pairs: Vec<[u32; 2]>,
    /// Scratch: a flag per proxy, such as "is already a partner of the proxy whose pairs are searched". All false between uses.
    proxy_flags: Vec<bool>,
    /// Scratch: for each touching pair the sort key made of its creation numbers, and the pair index.
    touching_scratch: Vec<(u128, u32)>,
}

reusing_clone! {
    Precise {
        parameters, impulse_substep, dt, step_context, gravity_delta, loaded, edits, has_restitution, friction, max_contacts, bodies, proxies,
        grid, pairs, constraints, color_usage, joints, joint_table, springs, sleep, sleeping_joints, direct_solver, depth, ids, always_tested,
        touch_events, ended_static_contacts, narrow_phase_stats, dirty_pairs, rolling_contacts, has_handler_changes, fast_bodies, sensor_passthroughs, enlarged_proxies, searched_static_proxies,
        pair_scratch, new_pairs,
        proxy_flags, touching_scratch
    }
}

impl Precise {
    /// Returns the state of the depth axis; `None` in plain 2D.
    pub(crate) fn depth_mut(&mut self) -> Option<&mut DepthState> {
        self.depth.as_deref_mut()
    }

    /// Returns an empty engine state. `length_unit`: length unit of [`Methods::Precise`](crate::Methods), in the user's unit of
    /// length, > 0.
    pub(crate) fn new(length_unit: f32) -> Self {
        Precise {
            parameters: Parameters::new(length_unit),
            impulse_substep: 0.0,
            dt: 0.0,
            step_context: None,
            gravity_delta: [0.0; 2],
            loaded: None,
            edits: PendingEdits::new(),
            has_restitution: false,
            friction: FrictionType::default(),
            max_contacts: 2,
            bodies: BodySet::default(),
            proxies: Proxies::default(),
            grid: HashGrid::default(),
            pairs: Pairs::default(),
            constraints: ConstraintGraph::default(),
            color_usage: ColorUsage::default(),
            joints: JointSystem::default(),
            joint_table: JointTable::default(),
            springs: SpringRows::default(),
            sleep: SleepState::default(),
            sleeping_joints: Vec::new(),
            direct_solver: DirectSolver::default(),
            depth: None,
            ids: IdTable::default(),
            always_tested: Vec::new(),
            touch_events: Vec::new(),
            ended_static_contacts: Vec::new(),
            narrow_phase_stats: NarrowPhaseStats::default(),
            dirty_pairs: Vec::new(),
            rolling_contacts: Vec::new(),
            has_handler_changes: false,
            fast_bodies: Vec::new(),
            sensor_passthroughs: Vec::new(),
            enlarged_proxies: Vec::new(),
            searched_static_proxies: Vec::new(),
            pair_scratch: Vec::new(),
            new_pairs: Vec::new(),
            proxy_flags: Vec::new(),
            touching_scratch: Vec::new(),
        }
    }

    /// Returns the parts that the fat AABBs of proxies depend on, and those that store them.
    fn fat_aabbs(&mut self) -> FatAabbs<'_> {
        FatAabbs {
            bodies: &self.bodies,
            proxies: &mut self.proxies,
            grid: &mut self.grid,
            depth: self.depth.as_mut().map(FeatureGate::by_mut),
            parameters: &self.parameters,
            dt: self.dt,
        }
    }

    /// Returns the parts that solver selection reads.
    fn solver_selection(&self) -> SolverSelection<'_> {
        SolverSelection {
            bodies: &self.bodies,
            proxies: &self.proxies,
            pairs: &self.pairs,
            constraints: &self.constraints,
            color_usage: &self.color_usage,
            joints: &self.joints,
            springs: &self.springs,
            sleep: &self.sleep,
            parameters: &self.parameters,
            history: &self.direct_solver.history,
            gravity_delta: self.gravity_delta,
            dt: self.dt,
            has_restitution: self.has_restitution,
            has_few_awake_bodies: self.bodies.movable_count.saturating_sub(self.asleep_count())
                <= IMMEDIATE_RESELECTION_BODIES,
            has_depth: self.depth.is_some(),
        }
    }

    /// Sets the user's choice of solvers, from this update on.
    pub(crate) fn set_solver_choice(&mut self, choice: crate::SolverChoice) {
        self.direct_solver.set_choice(choice);
    }

    /// Returns the parts from which contacts are read.
    fn contact_reader(&self) -> ContactReader<'_> {
        let Precise { bodies, proxies, pairs, constraints, depth, friction, .. } = self;
        let depth = depth.as_ref().map(FeatureGate::by_ref);
        ContactReader { bodies, proxies, pairs, constraints, depth, friction: *friction }
    }

    /// Returns the motion of all bodies in this step, between the solver and the write to the poses.
    fn swept_motion(&self) -> SweptMotion<'_> {
        let Precise { bodies, proxies, pairs, grid, sleep, depth, parameters, dt, .. } = self;
        let depth = depth.as_ref().map(FeatureGate::by_ref);
        SweptMotion { bodies, proxies, pairs, grid, sleep, depth, parameters, dt: *dt }
    }

    /// Returns the narrow phase, which borrows the bodies, proxies, pairs and constraints that it reads and writes.
    fn narrow_phase(&mut self) -> NarrowPhase<'_> {
        NarrowPhase {
            bodies: &self.bodies,
            proxies: &self.proxies,
            pairs: &mut self.pairs,
            constraints: &mut self.constraints,
            palette: &mut self.color_usage,
            sleep: &mut self.sleep,
            direct: &mut self.direct_solver,
            depth: self.depth.as_ref().map(FeatureGate::by_ref),
            parameters: &self.parameters,
            friction: self.friction,
            max_contacts: self.max_contacts as usize,
            dt: self.dt,
            gravity_delta: self.gravity_delta,
            touch_events: &mut self.touch_events,
            ended_static_contacts: &mut self.ended_static_contacts,
            stats: &mut self.narrow_phase_stats,
            dirty_pairs: &mut self.dirty_pairs,
            rolling_contacts: &mut self.rolling_contacts,
        }
    }
}
