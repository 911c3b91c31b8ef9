//! The precise engine: bodies, pairs, constraints and solvers of its own, behind the same API as the faithful set. It shares
//! the objects with the faithful set, but no arithmetic.
//!
//! A step has these stages:
//!
//! | stage | what it does | where |
//! |---|---|---|
//! | 1 | imports edited objects | [`import`], [`add_remove`], [`geom_import`] |
//! | 2 | broad phase: removes pairs whose fat AABBs separated, finds new ones | [`broad_phase`](farseer_precise::broad_phase) |
//! | 3 | narrow phase: manifolds and contact constraints of pairs that moved | [`narrow_phase`](farseer_precise::narrow_phase), [`constraint_graph`](farseer_precise::constraint_graph) |
//! | 4 | reads bodies, forces and joints; selects the solver of each island | [`bodies`](farseer_precise::bodies), [`joints`](farseer_precise::joints), [`island`](farseer_precise::island) |
//! | 5 | solver: direct, articulations, iterative in substeps; then continuous collision | [`step`](farseer_precise::step), [`continuous_collision`](farseer_precise::continuous_collision) |
//! | 6 | writes bodies, refits AABBs | [`step`](farseer_precise::step), [`integration`](farseer_precise::integration) |
//! | 7 | puts islands at rest to sleep | [`sleep_stages`], [`island`](farseer_precise::island) |
//!
//! Files whose first line begins with "Adapter" name ids and objects of the game; [`ids`] translates them to indices.
//!
//! For `twohalf`, an engine on top of this one, all stages work in three axes ([`depth`](farseer_precise::depth)). Lengths are in the user's unit.
//! Parameters are multiples of one length unit ([`scaled_parameters`](farseer_precise::scaled_parameters)).

mod add_remove;
mod axis_locks;
mod body_import;
mod body_io;
pub(crate) mod candidate_pairs;
mod changed_kinds;
pub(crate) mod contact_events;
mod contact_points;
#[cfg(feature = "space")]
pub(crate) mod depth_contact;
#[cfg(feature = "space")]
mod depth_events;
#[cfg(feature = "space")]
mod depth_import;
mod geom_import;
mod hits;
mod ids;
mod import;
mod island_report;
mod joint_import;
mod joint_stages;
mod listed;
mod pending_edits;
mod query_candidates;
mod saved;
pub(crate) mod separated_bodies;
pub(crate) mod skip_step;
mod sleep_events;
mod sleep_options;
mod sleep_stages;
mod sleeping_joints;
mod spring_import;
mod stages;
mod vacancies;
mod wake_import;
mod world_boxes;

use serde::Deserialize;

use crate::body::BodyId;
use crate::contacts::arbiter::ArbiterRef;
use crate::geom::GeomId;
use crate::methods::Methods;
use crate::objects::Objects;
use crate::report::{Event, Hit};
use axis_locks::AxisLocks;
use changed_kinds::ChangedKinds;
use farseer_precise::Solver;
use farseer_precise::bodies::BodySet;
pub(crate) use farseer_precise::depth::state::DepthState;
use farseer_precise::index::{BodyIndex, DenseIndex};
use farseer_precise::narrow_phase::hits::PieceHit;
use farseer_precise::reusing_clone;
pub(crate) use farseer_precise::scaled_parameters::StepContext;
use hits::list_hits;
use ids::{AlwaysTested, IdTable};
use joint_import::JointTable;
use pending_edits::PendingEdits;
use saved::Saved;
use sleep_events::SleepEvents;
use sleep_options::SleepOptions;
use sleeping_joints::SleepingJoint;

/// State of the precise engine between steps: the solver, and the tables that translate the objects of the game to its indices.
#[derive(Debug, Deserialize)]
#[serde(from = "Saved")]
pub(crate) struct Precise {
    /// The solver, which knows bodies, proxies, pairs and joints by dense indices.
    pub(crate) solver: Solver,
    /// State of a loaded snapshot until the next rebuild restores it; else `None`.
    loaded: Option<Saved>,
    /// Edits of the game since the last import.
    pub(crate) edits: PendingEdits,
    /// Ids of the joints in `joints`, and the springs that became constraint rows in this update.
    joint_table: JointTable,
    /// Joints of sleeping bodies as they were when the bodies fell asleep, in the order of the simulator's list.
    sleeping_joints: Vec<SleepingJoint>,
    /// Ids of the game's bodies and geoms behind the indices into `bodies` and `proxies`.
    ids: IdTable,
    /// Geoms that every AABB query tests without the hash grid, in the order of the simulator's list of geoms.
    always_tested: Vec<AlwaysTested>,
    /// Touching pairs whose typed event has another kind since an edit.
    pub(crate) changed_kinds: ChangedKinds,
    /// Sleeping bodies with events.
    sleep_events: SleepEvents,
    /// Bodies that may not sleep or are to sleep.
    sleep_options: SleepOptions,
    /// Bodies with locked axes.
    axis_locks: AxisLocks,
    /// Workspace: the hits of the convex pieces in this step.
    piece_hits: Vec<PieceHit>,
    /// Whether a step runs: poses of the solver may then differ from those of the game's bodies.
    pub(crate) is_stepping: bool,
}

reusing_clone! {
    Precise {
        solver, loaded, edits, joint_table, sleeping_joints, ids, always_tested, changed_kinds, sleep_events, sleep_options, axis_locks, piece_hits, is_stepping
    }
}

/// Scales velocity and forces of a body if it would be faster than `largest` after the forces of this step, length units/s.
fn limit_speed(bodies: &mut BodySet, body: BodyIndex, largest: f32, substeps: f32) {
    let ([x, y, ..], [dx, dy, ..]) = (bodies.states[body].velocity, bodies.force_delta[body]);
    let [x, y] = [x + dx * substeps, y + dy * substeps].map(f64::from);
    let speed = (x * x + y * y).sqrt();
    if speed > f64::from(largest) {
        let share = (f64::from(largest) / speed) as f32;
        let lists = [&mut bodies.initial_velocity, &mut bodies.force_delta, &mut bodies.force_position_delta];
        lists.into_iter().for_each(|list| (0..2).for_each(|axis| list[body][axis] *= share));
        (0..2).for_each(|axis| bodies.states[body].velocity[axis] *= share);
    }
}

impl Precise {
    /// Returns an empty engine state. `length_unit`: length unit of [`Methods::Precise`](crate::Methods), in the user's unit of
    /// length, > 0.
    fn new(length_unit: f32) -> Self {
        Precise {
            solver: Solver::new(length_unit),
            loaded: None,
            edits: PendingEdits::new(),
            joint_table: JointTable::default(),
            sleeping_joints: Vec::new(),
            ids: IdTable::default(),
            always_tested: Vec::new(),
            changed_kinds: ChangedKinds::default(),
            sleep_events: SleepEvents::default(),
            sleep_options: SleepOptions::default(),
            axis_locks: AxisLocks::default(),
            piece_hits: Vec::new(),
            is_stepping: false,
        }
    }
    /// Returns an empty engine state for these methods; `None` for the faithful set.
    pub(crate) fn of_methods(methods: Methods) -> Option<Box<Self>> {
        methods.length_unit().map(|unit| Box::new(Precise::new(unit)))
    }

    /// Adds the events of bodies that have woken or fallen asleep since the last step.
    pub(crate) fn report_sleep_events(&mut self, objects: &Objects, events: &mut Vec<Event>) {
        let Precise { sleep_events, ids, solver, .. } = self;
        let is_asleep = |body| ids.body_index(body).is_some_and(|index| solver.sleep.is_asleep(index));
        sleep_events.report(is_asleep, objects, events);
    }

    /// Stops the bodies that are to sleep after this step.
    pub(crate) fn stop_requested(&mut self, objects: &Objects) {
        self.sleep_options.stop_requested(&mut self.solver, &self.ids, objects);
    }

    /// Returns the arbiters of the pairs of a body that touch. None for a body that is not listed.
    pub(crate) fn arbiters_of(&self, body: BodyId) -> Vec<ArbiterRef<'static>> {
        let Some(index) = self.ids.body_index(body) else { return Vec::new() };
        let pairs = self.solver.pairs.pairs_of_body(&self.solver.proxies, index);
        pairs.filter_map(|pair| self.arbiter_of_pair(pair.position())).collect()
    }

    /// Scales the velocities and forces of the awake dynamic bodies that would be faster than `largest` in this step, length
    /// units/s.
    pub(crate) fn limit_speeds(&mut self, largest: f32, step: &StepContext) {
        let Solver { bodies, sleep, .. } = &mut self.solver;
        for body in sleep.awake_bodies(bodies.last_movable) {
            if bodies.is_dynamic(body) {
                limit_speed(bodies, body, largest, step.substeps as f32);
            }
        }
    }

    /// Appends the hits of this step that are faster than `min_speed` (length units/s): see [`list_hits`].
    pub(crate) fn list_hits(&mut self, min_speed: f32, hits: &mut Vec<Hit>) {
        if self.solver.proxies.hit_count > 0 {
            list_hits(&mut self.solver, &mut self.piece_hits, min_speed, hits);
        }
    }

    /// Returns whether the engine has a depth axis.
    pub(crate) fn has_depth(&self) -> bool {
        self.solver.depth.is_some()
    }

    /// Returns the body index of a dynamic or kinematic body; `None` for static and absent ones.
    fn movable_index_of(&self, id: BodyId) -> Option<BodyIndex> {
        self.body_index(id).filter(|&number| number < self.solver.bodies.first_static())
    }

    /// Returns, for each of two bodies, its id and its acceleration along z by forces (length units/s^2) if updates do not move
    /// it. The entry of a dynamic or kinematic body of the simulation is `None`.
    pub(crate) fn inactive_depth_accelerations(
        &self,
        ids: [Option<BodyId>; 2],
    ) -> [Option<(BodyId, f32)>; 2] {
        ids.map(|id| {
            let (id, space) = (id?, self.solver.depth.as_ref()?);
            self.movable_index_of(id).is_none().then(|| (id, space.acceleration(id.slot())))
        })
    }

    /// Returns whether a body is at rest along z and, if it is a sphere, does not rotate about x or y. A force along z counts as
    /// motion if `has_force_of_game` returns true.
    pub(super) fn rests_along_z(&self, id: BodyId, has_force_of_game: impl Fn() -> bool) -> bool {
        self.solver.depth.as_ref().is_none_or(|space| {
            space.is_at_rest(self.body_index(id), id.slot())
                && (space.acceleration(id.slot()) == 0.0 || !has_force_of_game())
        })
    }

    /// Returns the state of the depth axis; `None` in plain 2D.
    pub(crate) fn depth_mut(&mut self) -> Option<&mut DepthState> {
        self.solver.depth_mut()
    }

    /// Notes a body whose properties the next import copies.
    pub(crate) fn mark_body_edited(&mut self, body: BodyId) {
        self.edits.mark_body_edited(body);
    }

    /// Notes a geom whose properties the next import copies.
    pub(crate) fn mark_geom_edited(&mut self, geom: GeomId) {
        self.edits.mark_geom_edited(geom);
    }
}
