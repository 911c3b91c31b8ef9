//! The parts of the solver, and views of several parts that stages share.

use crate::bodies::BodySet;
use crate::broad_phase::fat_aabbs::FatAabbs;
use crate::broad_phase::hash_grid::HashGrid;
use crate::broad_phase::pairs::Pairs;
use crate::broad_phase::proxies::Proxies;
use crate::constraint_graph::{ColorUsage, ConstraintGraph};
use crate::contact_solver::rolling::RollingContact;
use crate::contact_solver::rolling_resistance::RollingRow;
use crate::continuous_collision::fast_body::FastBody;
use crate::continuous_collision::swept_motion::SweptMotion;
use crate::depth::feature_gate::FeatureGate;
use crate::depth::state::DepthState;
use crate::direct_solver::DirectSolver;
use crate::direct_solver::selection::SolverSelection;
use crate::index::{BodyIndex, IndexedVec, PairIndex, ProxyIndex};
use crate::island::sleep::SleepState;
use crate::joints::JointSystem;
use crate::joints::springs::SpringRows;
use crate::narrow_phase::contact_reader::ContactReader;
use crate::narrow_phase::{NarrowPhase, NarrowPhaseStats, TouchEvent};
use crate::parameters::direct::IMMEDIATE_RESELECTION_BODIES;
use crate::reusing_clone;
use crate::scaled_parameters::{Parameters, StepContext};
use crate::solver_choice::SolverChoice;
use crate::surface::FrictionType;

/// The solver: bodies, pairs, constraints and their solvers, by dense indices, between steps.
#[derive(Debug)]
pub struct Solver {
    /// Parameters in the user's units: speculative distance, margins, thresholds.
    pub parameters: Parameters,
    /// Length of the substep in which the accumulated contact impulses last acted, seconds, >= 0. A step with another substep
    /// length scales the impulses.
    pub(crate) impulse_substep: f32,
    /// Length of the last step, seconds, >= 0; 0 before the first step. Fat AABBs reach ahead by the motion of a few steps of this length.
    pub dt: f32,
    /// Parameters of the last step, which the next one keeps if it has the same length and number of substeps; `None` before
    /// the first step.
    pub step_context: Option<StepContext>,
    /// Velocity change by gravity in the current step: x, y in length units/s.
    pub gravity_delta: crate::math::plane::Vector,
    /// Whether any geom has, or any handler has set, a restitution coefficient above 0; else the solver skips restitution.
    pub has_restitution: bool,
    /// How the friction coefficients of two geoms combine to that of their contact.
    pub friction: FrictionType,
    /// Greatest number of contact points of a pair of convex pieces, 0..=2.
    pub max_contacts: u32,
    /// Poses, velocities, masses and extents of all bodies, by body index.
    pub bodies: BodySet,
    /// Convex pieces of geoms with their fat AABBs, by proxy index.
    pub proxies: Proxies,
    /// Broad phase: hash grid of the fat AABBs.
    pub grid: HashGrid,
    /// Pairs of proxies whose fat AABBs overlap.
    pub pairs: Pairs,
    /// Contact constraints of all pairs, in graph colours or parked.
    pub constraints: ConstraintGraph,
    /// Graph colours that the contact constraints of each body use.
    pub color_usage: ColorUsage,
    /// Joints with their constraints and solvers.
    pub joints: JointSystem,
    /// Springs that the solvers treat as constraint rows in this update.
    pub springs: SpringRows,
    /// Sleep state of bodies and islands: rest times, rings of sleeping bodies, requests to wake.
    pub sleep: SleepState,
    /// The direct solver and the solver selection.
    pub direct_solver: DirectSolver,
    /// State of the depth axis; `None` in plain 2D.
    pub depth: Option<FeatureGate<Box<DepthState>>>,
    /// Touch events that the game has not received yet: pairs of convex pieces that began or ceased to touch.
    pub touch_events: Vec<TouchEvent>,
    /// Contacts with static bodies that ended in this narrow phase: index of the dynamic body, and penetration in length
    /// units. Empty between stages.
    pub ended_static_contacts: Vec<(BodyIndex, f32)>,
    /// Numbers of computed and of recycled manifolds in the narrow phase of this step.
    pub narrow_phase_stats: NarrowPhaseStats,
    /// Scratch: indices of the pairs that the narrow phase updates in this step.
    pub dirty_pairs: Vec<PairIndex>,
    /// Contacts of polygons that roll over a static face in this step. Filled by the narrow phase, read by the iterative
    /// solver.
    pub rolling_contacts: Vec<RollingContact>,
    /// Rows of rolling resistance. Valid within the iterative solver only.
    pub(crate) rolling_rows: Vec<RollingRow>,
    /// Whether a collision handler has vetoed a pair, removed contact points or set surface properties for this step.
    pub has_handler_changes: bool,
    /// Candidates of continuous collision: bodies whose displacement in this step exceeds their least extent. Valid within a
    /// step only.
    pub fast_bodies: Vec<FastBody>,
    /// Proxies of a sensor and of a fast body that crosses it within the step, the one with the smaller creation number first.
    /// A pair of geoms occurs once. Valid within a step only.
    pub sensor_passthroughs: Vec<[ProxyIndex; 2]>,
    /// Scratch: proxies whose fat AABBs continuous collision has enlarged to contain the sweep of a fast body.
    pub enlarged_proxies: Vec<ProxyIndex>,
    /// Proxies of static and kinematic bodies whose pairs the broad phase searched in this step.
    pub searched_static_proxies: Vec<ProxyIndex>,
    /// Scratch: indices of pairs or proxies. Empty between stages.
    pub pair_scratch: Vec<u32>,
    /// Pairs of proxy indices that the broad phase has newly found. Valid within the broad phase only.
    pub new_pairs: Vec<[ProxyIndex; 2]>,
    /// Scratch: a flag per proxy, such as "is already a partner of the proxy whose pairs are searched". All false between uses.
    pub proxy_flags: IndexedVec<ProxyIndex, bool>,
    /// Scratch: for each touching pair the sort key made of its creation numbers, and the pair index.
    pub touching_scratch: Vec<(u128, u32)>,
}

reusing_clone! {
    Solver {
        parameters, impulse_substep, dt, step_context, gravity_delta, has_restitution, friction, max_contacts, bodies, proxies, grid, pairs, constraints, color_usage, joints, springs, sleep, direct_solver, depth, touch_events, ended_static_contacts, narrow_phase_stats, dirty_pairs, rolling_contacts, rolling_rows, has_handler_changes, fast_bodies, sensor_passthroughs, enlarged_proxies, searched_static_proxies, pair_scratch, new_pairs, proxy_flags, touching_scratch
    }
}

impl Solver {
    /// Returns an empty solver. `length_unit`: length unit of the parameters, in the user's unit of length, > 0.
    pub fn new(length_unit: f32) -> Self {
        Solver {
            parameters: Parameters::new(length_unit),
            impulse_substep: 0.0,
            dt: 0.0,
            step_context: None,
            gravity_delta: [0.0; 2],
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
            springs: SpringRows::default(),
            sleep: SleepState::default(),
            direct_solver: DirectSolver::default(),
            depth: None,
            touch_events: Vec::new(),
            ended_static_contacts: Vec::new(),
            narrow_phase_stats: NarrowPhaseStats::default(),
            dirty_pairs: Vec::new(),
            rolling_contacts: Vec::new(),
            rolling_rows: Vec::new(),
            has_handler_changes: false,
            fast_bodies: Vec::new(),
            sensor_passthroughs: Vec::new(),
            enlarged_proxies: Vec::new(),
            searched_static_proxies: Vec::new(),
            pair_scratch: Vec::new(),
            new_pairs: Vec::new(),
            proxy_flags: IndexedVec::default(),
            touching_scratch: Vec::new(),
        }
    }

    /// Returns the state of the depth axis; `None` in plain 2D.
    pub fn depth_mut(&mut self) -> Option<&mut DepthState> {
        self.depth.as_deref_mut()
    }

    /// Returns the parts that the fat AABBs of proxies depend on, and those that store them.
    pub fn fat_aabbs(&mut self) -> FatAabbs<'_> {
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
    pub fn solver_selection(&self) -> SolverSelection<'_> {
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

    /// Returns the lengths of the last substep and of the last step, seconds, >= 0; 0 before the first step.
    pub fn step_lengths(&self) -> [f32; 2] {
        [self.impulse_substep, self.dt]
    }

    /// Sets the lengths of the last substep and of the last step, seconds, as a snapshot has them.
    pub fn set_step_lengths(&mut self, [substep, step]: [f32; 2]) {
        (self.impulse_substep, self.dt) = (substep, step);
    }

    /// Returns the number of substeps of the last step; 0 before the first.
    pub fn substep_count(&self) -> u32 {
        if self.impulse_substep > 0.0 { (self.dt / self.impulse_substep).round() as u32 } else { 0 }
    }

    /// Returns whether no stage of the solver has work: no awake pairs, new fat AABBs, one-way geoms, events, handler changes,
    /// joints or islands in the direct solver.
    pub fn is_idle(&self) -> bool {
        self.pairs.awake_count() == 0
            && self.proxies.refitted().is_empty()
            && self.proxies.one_way_count == 0
            && self.enlarged_proxies.is_empty()
            && self.touch_events.is_empty()
            && !self.has_handler_changes
            && self.joints.is_empty()
            && self.direct_solver.is_idle()
    }

    /// Sets the user's choice of solvers, from this update on.
    pub fn set_solver_choice(&mut self, choice: SolverChoice) {
        self.direct_solver.set_choice(choice);
    }

    /// Returns the parts from which contacts are read.
    pub fn contact_reader(&self) -> ContactReader<'_> {
        let Solver { bodies, proxies, pairs, constraints, depth, friction, .. } = self;
        let depth = depth.as_ref().map(FeatureGate::by_ref);
        ContactReader { bodies, proxies, pairs, constraints, depth, friction: *friction }
    }

    /// Returns the motion of all bodies in this step, between the solver and the write to the poses.
    pub(crate) fn swept_motion(&self) -> SweptMotion<'_> {
        let Solver { bodies, proxies, pairs, grid, sleep, depth, parameters, dt, .. } = self;
        let depth = depth.as_ref().map(FeatureGate::by_ref);
        SweptMotion { bodies, proxies, pairs, grid, sleep, depth, parameters, dt: *dt }
    }

    /// Returns the narrow phase, which borrows the bodies, proxies, pairs and constraints that it reads and writes.
    pub fn narrow_phase(&mut self) -> NarrowPhase<'_> {
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
            impulse_substep: self.impulse_substep,
            gravity_delta: self.gravity_delta,
            touch_events: &mut self.touch_events,
            ended_static_contacts: &mut self.ended_static_contacts,
            stats: &mut self.narrow_phase_stats,
            dirty_pairs: &mut self.dirty_pairs,
            rolling_contacts: &mut self.rolling_contacts,
        }
    }

    /// Removes all pairs and their constraints, and adapts their lists to the present numbers of proxies and bodies.
    pub fn clear_pairs(&mut self) {
        self.grid.reset(self.proxies.position_count());
        self.pairs.reset(self.proxies.position_count());
        self.constraints.clear();
        self.color_usage.reset(self.bodies.inverse_mass_inertia.slice(..self.bodies.states.len()));
        if let Some(space) = &self.depth {
            space.mark_hinged_boxes(&mut self.color_usage);
        }
    }

    /// Invalidates the pairs of a proxy: the next step updates their contacts in full, wakes sleeping partners and may select
    /// solvers anew.
    pub fn invalidate_pairs(&mut self, proxy: ProxyIndex) {
        self.direct_solver.timer.may_be_due = true;
        let Solver { pairs, proxies, sleep, .. } = self;
        pairs.for_each_index_of(proxy, |pairs, pair| {
            pairs.invalidate(pair);
            sleep.support_of_pair_removed(pairs.bodies_of(proxies, pair));
        });
    }

    /// Returns the number of sleeping bodies, without hinged platforms.
    pub fn asleep_count(&self) -> usize {
        self.sleep.count - self.depth.as_ref().map_or(0, |space| space.sleeping_hinged_boxes(&self.sleep))
    }
}
