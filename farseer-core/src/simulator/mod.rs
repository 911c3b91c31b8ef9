//! The simulator: owns everything and steps it (behaviour chapter 04).

mod controllers;
mod editing;
mod engine;
mod joints;
mod queries;
mod queues;
mod save;
mod springs;
mod stages;
mod step_times;
mod world_queries;

use serde::{Deserialize, Serialize};

use crate::arbiter::{ArbiterList, ArbiterRef};
use crate::arena::Arena;
use crate::body::{Body, BodyId};
use crate::body_entry::BodyEntry;
use crate::broad_phase::BroadPhase;
use crate::collection::Collection;
use crate::contact::Contact;
use crate::controllers::{Controller, ControllerId};
use crate::error::{finite, finite_vector};
use crate::events::{Event, Notice};
use crate::geom::{Geom, GeomId};
use crate::geom_entry::GeomEntry;
use crate::geom_ref::GeomRef;
use crate::joints::{Joint, JointId};
use crate::limits::Limits;
use crate::math::Vector2;
use crate::methods::{BroadPhaseCollider, FrictionType, NarrowPhaseCollider};
use crate::narrow_phase::grid_cache::GridCache;
use crate::object_id::ObjectId;
use crate::solver::ContactSolver;
use crate::springs::{Spring, SpringId};
use crate::{Error, Result};
use joints::JointPasses;
use queues::Queues;

pub use editing::GeomPlacement;
pub use queries::GeomPointPair;
pub use save::SavedSimulator;
pub use step_times::StepTimes;
pub use world_queries::RayCastHit;

/// The settings of a simulator.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
struct Settings {
    gravity: Vector2,
    enabled: bool,
    iterations: i32,
    bias_factor: f32,
    allowed_penetration: f32,
    max_contacts_to_detect: i32,
    max_contacts_to_resolve: i32,
    friction_type: FrictionType,
    narrow_phase: NarrowPhaseCollider,
}

/// What a step did: how much work there was.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct StepCounters {
    /// Pairs whose shapes were tested against each other.
    pub pairs_tested: usize,
    /// Pairs that touch.
    pub pairs_touching: usize,
    /// Contacts the solver worked on in every iteration.
    pub contacts_solved: usize,
    /// Passes that the solver made.
    pub passes: u32,
    /// Bodies that changed their pose.
    pub bodies_moved: usize,
}

/// Owns bodies and geoms and moves them in steps.
///
/// Objects live in the simulator and are named by ids. Their life is that of the original: *created* (exists but
/// takes no part), *added* (takes part from the next update), *removed* (no longer takes part, may be added
/// again), *disposed* (the id goes stale with the next update).
///
/// ```
/// use farseer_core::{BodyFactory, GeomFactory, GeomPlacement, PhysicsSimulator, math::Vector2};
///
/// let mut simulator = PhysicsSimulator::new(Vector2::new(0.0, 100.0))?;
/// let floor = BodyFactory::create_rectangle_body_in(&mut simulator, 400.0, 20.0, 1.0)?;
/// simulator[floor].set_is_static(true);
/// simulator[floor].set_position(Vector2::new(0.0, 110.0));
/// GeomFactory::create_rectangle_geom_in(&mut simulator, floor, 400.0, 20.0, GeomPlacement::default())?;
///
/// let ball = BodyFactory::create_circle_body_in(&mut simulator, 10.0, 1.0)?;
/// GeomFactory::create_circle_geom_in(&mut simulator, ball, 10.0, 16, GeomPlacement::default())?;
/// for _ in 0..300 {
///     simulator.update(0.01);
/// }
/// assert!((simulator[ball].position().y - 90.0).abs() < 1.0);
/// # Ok::<(), farseer_core::Error>(())
/// ```
#[derive(Debug, Clone, Serialize, Deserialize)]
#[serde(remote = "Self")]
pub struct PhysicsSimulator {
    settings: Settings,
    bodies: Arena<BodyEntry>,
    geoms: Arena<GeomEntry>,
    body_list: Vec<BodyId>,
    geom_list: Vec<GeomId>,
    controllers: Collection<Controller, ControllerId>,
    joints: Collection<Joint, JointId>,
    springs: Collection<Spring, SpringId>,
    queues: Queues,
    broad_phase: BroadPhase,
    arbiters: ArbiterList,
    next_geom_number: u32,
    /// Bodies and geoms that were lent out for editing since the simulator last looked.
    touched_bodies: Vec<BodyId>,
    touched_geoms: Vec<GeomId>,
    /// Not saved: a save cannot raise them.
    #[serde(skip)]
    limits: Limits,
    #[serde(skip)]
    grids: GridCache,
    #[serde(skip)]
    solver: ContactSolver,
    #[serde(skip)]
    joint_passes: JointPasses,
    #[serde(skip)]
    new_contacts: Vec<Contact>,
    #[serde(skip)]
    separated: Vec<(GeomId, GeomId)>,
    #[serde(skip)]
    events: Vec<Event>,
    /// What happened since the last update, or needs to be told when no callback is running.
    pending: Vec<Notice>,
    /// Empty: the other buffer of what is pending.
    #[serde(skip)]
    delivered: Vec<Notice>,
    #[serde(skip)]
    counters: StepCounters,
    #[serde(skip)]
    step_times: StepTimes,
}

impl Default for PhysicsSimulator {
    /// Without gravity.
    fn default() -> Self {
        PhysicsSimulator {
            settings: Settings {
                gravity: Vector2::zeros(),
                enabled: true,
                iterations: 5,
                bias_factor: 0.8,
                allowed_penetration: 0.05,
                max_contacts_to_detect: 10,
                max_contacts_to_resolve: 4,
                friction_type: FrictionType::Average,
                narrow_phase: NarrowPhaseCollider::DistanceGrid,
            },
            bodies: Arena::default(),
            geoms: Arena::default(),
            body_list: Vec::new(),
            geom_list: Vec::new(),
            controllers: Collection::default(),
            joints: Collection::default(),
            springs: Collection::default(),
            queues: Queues::default(),
            broad_phase: BroadPhase::new(BroadPhaseCollider::SelectiveSweep),
            arbiters: ArbiterList::default(),
            next_geom_number: 0,
            touched_bodies: Vec::new(),
            touched_geoms: Vec::new(),
            limits: Limits::default(),
            grids: GridCache::default(),
            solver: ContactSolver::default(),
            joint_passes: JointPasses::default(),
            new_contacts: Vec::new(),
            separated: Vec::new(),
            events: Vec::new(),
            pending: Vec::new(),
            delivered: Vec::new(),
            counters: StepCounters::default(),
            step_times: StepTimes::default(),
        }
    }
}

/// Settings.
impl PhysicsSimulator {
    /// An empty simulator with this gravity: acceleration in the user's length unit per square second, y down.
    ///
    /// # Errors
    /// Gravity that is not finite.
    pub fn new(gravity: Vector2) -> Result<Self> {
        let mut simulator = PhysicsSimulator::default();
        simulator.set_gravity(gravity)?;
        simulator.step_times = StepTimes::NEVER_MEASURED;
        Ok(simulator)
    }

    /// What this simulator may cost.
    pub fn limits(&self) -> Limits {
        self.limits
    }

    /// Sets what this simulator may cost. What is there already stays, whatever it costs. Clones have the same limits;
    /// [`clear`](Self::clear) and [`restore`](Self::restore) leave them alone, and apply them to what is restored.
    pub fn set_limits(&mut self, limits: Limits) {
        self.limits = limits;
    }

    /// Acceleration of every body that does not ignore it.
    #[doc(alias = "Gravity")]
    pub fn gravity(&self) -> Vector2 {
        self.settings.gravity
    }

    /// Sets the gravity.
    ///
    /// # Errors
    /// What is not finite.
    pub fn set_gravity(&mut self, gravity: Vector2) -> Result<()> {
        self.settings.gravity = finite_vector("gravity", gravity)?;
        Ok(())
    }

    /// Whether updates move anything; queues are processed either way. Default true.
    #[doc(alias = "Enabled")]
    pub fn enabled(&self) -> bool {
        self.settings.enabled
    }

    /// Lets updates move things or not.
    pub fn set_enabled(&mut self, enabled: bool) {
        self.settings.enabled = enabled;
    }

    /// Passes of the solver per update, as they were set. Default 5.
    #[doc(alias = "Iterations")]
    pub fn iterations(&self) -> i32 {
        self.settings.iterations
    }

    /// Sets the passes of the solver; with 0 or less only the impulses of the last update act again.
    ///
    /// No more are made than the [limits](Self::limits) allow, and none where there is neither a contact to solve nor a
    /// joint: [`StepCounters::passes`] says how many there were.
    pub fn set_iterations(&mut self, iterations: i32) {
        self.settings.iterations = iterations;
    }

    /// Part of an overlap that is undone per update. Default 0.8.
    #[doc(alias = "BiasFactor")]
    pub fn bias_factor(&self) -> f32 {
        self.settings.bias_factor
    }

    /// Sets the part of an overlap that is undone per update.
    ///
    /// # Errors
    /// What is not finite.
    pub fn set_bias_factor(&mut self, bias_factor: f32) -> Result<()> {
        self.settings.bias_factor = finite("bias_factor", bias_factor)?;
        Ok(())
    }

    /// Overlap that is left alone, in the user's length unit. Default 0.05.
    #[doc(alias = "AllowedPenetration")]
    pub fn allowed_penetration(&self) -> f32 {
        self.settings.allowed_penetration
    }

    /// Sets the overlap that is left alone.
    ///
    /// # Errors
    /// What is not finite.
    pub fn set_allowed_penetration(&mut self, allowed_penetration: f32) -> Result<()> {
        self.settings.allowed_penetration = finite("allowed_penetration", allowed_penetration)?;
        Ok(())
    }

    /// Contacts the narrow phase looks for per pair. Default 10.
    #[doc(alias = "MaxContactsToDetect")]
    pub fn max_contacts_to_detect(&self) -> i32 {
        self.settings.max_contacts_to_detect
    }

    /// Sets the number of contacts to look for. A negative number is no limit for the distance grid, and leaves
    /// one contact for SAT.
    pub fn set_max_contacts_to_detect(&mut self, max_contacts_to_detect: i32) {
        self.settings.max_contacts_to_detect = max_contacts_to_detect;
    }

    /// Contacts solved per pair, the deepest first. Default 4.
    #[doc(alias = "MaxContactsToResolve")]
    pub fn max_contacts_to_resolve(&self) -> i32 {
        self.settings.max_contacts_to_resolve
    }

    /// Sets the number of contacts solved per pair.
    ///
    /// # Errors
    /// Negative numbers; the original throws in its next update.
    pub fn set_max_contacts_to_resolve(&mut self, max_contacts_to_resolve: i32) -> Result<()> {
        if max_contacts_to_resolve < 0 {
            return Err(Error::invalid("max_contacts_to_resolve", max_contacts_to_resolve, "0 or more"));
        }
        self.settings.max_contacts_to_resolve = max_contacts_to_resolve;
        Ok(())
    }

    /// How the friction of two geoms combines. Default [`FrictionType::Average`].
    #[doc(alias = "FrictionType")]
    pub fn friction_type(&self) -> FrictionType {
        self.settings.friction_type
    }

    /// Sets how friction combines, for pairs that begin to overlap later.
    pub fn set_friction_type(&mut self, friction_type: FrictionType) {
        self.settings.friction_type = friction_type;
    }

    /// The narrow phase. Default [`NarrowPhaseCollider::DistanceGrid`].
    #[doc(alias = "NarrowPhaseCollider")]
    pub fn narrow_phase_collider(&self) -> NarrowPhaseCollider {
        self.settings.narrow_phase
    }

    /// Sets the narrow phase. Geoms made under SAT have no distance grid and touch nothing under the other.
    pub fn set_narrow_phase_collider(&mut self, narrow_phase: NarrowPhaseCollider) {
        self.settings.narrow_phase = narrow_phase;
    }

    /// The broad phase, with its present cell size if it has one.
    #[doc(alias = "BroadPhaseCollider")]
    pub fn broad_phase_collider(&self) -> BroadPhaseCollider {
        self.broad_phase.method()
    }

    /// Sets the broad phase.
    ///
    /// # Errors
    /// If a geom is in the simulation already ([`Error::GeomListNotEmpty`]; geoms still waiting to be added do
    /// not count), or a cell size is not finite.
    pub fn set_broad_phase_collider(&mut self, method: BroadPhaseCollider) -> Result<()> {
        if !self.geom_list.is_empty() {
            return Err(Error::GeomListNotEmpty);
        }
        self.broad_phase = BroadPhase::new(method.check()?);
        Ok(())
    }
}

/// Access to what lives in the simulator.
impl PhysicsSimulator {
    /// A body, unless the id is stale.
    #[inline]
    pub fn body(&self, body: BodyId) -> Option<&Body> {
        self.bodies.get(body).map(|entry| &entry.body)
    }

    /// A body to edit, unless the id is stale. Its geoms follow when it is moved.
    #[inline]
    pub fn body_mut(&mut self, body: BodyId) -> Option<&mut Body> {
        let entry = self.bodies.get_mut(body)?;
        if !entry.is_touched {
            entry.is_touched = true;
            self.touched_bodies.push(body);
        }
        Some(&mut entry.body)
    }

    /// A geom as it lies in the world, unless the id is stale.
    #[inline]
    pub fn geom(&self, geom: GeomId) -> Option<GeomRef<'_>> {
        let entry = self.geoms.get(geom)?;
        Some(GeomRef { entry, body: self.bodies.get(entry.body) })
    }

    /// The settings of a geom to edit, unless the id is stale.
    #[inline]
    pub fn geom_mut(&mut self, geom: GeomId) -> Option<&mut Geom> {
        let entry = self.geoms.get_mut(geom)?;
        if !entry.is_touched {
            entry.is_touched = true;
            self.touched_geoms.push(geom);
        }
        Some(&mut entry.geom)
    }

    /// The geoms of a body, in the order in which they were attached; none if the id is stale.
    pub fn geoms_of(&self, body: BodyId) -> &[GeomId] {
        self.bodies.get(body).map_or(&[], |entry| &entry.geoms)
    }

    /// The bodies that take part, in the order in which they were added.
    #[doc(alias = "BodyList")]
    pub fn body_list(&self) -> &[BodyId] {
        &self.body_list
    }

    /// The geoms that take part, in the order in which they were added.
    #[doc(alias = "GeomList")]
    pub fn geom_list(&self) -> &[GeomId] {
        &self.geom_list
    }

    /// All bodies that live, in their lists or not, in the order of their [slots](BodyId::slot).
    pub fn bodies(&self) -> impl Iterator<Item = BodyId> + '_ {
        self.bodies.iter().map(|(id, _)| id)
    }

    /// All geoms that live, in their lists or not, in the order of their [slots](GeomId::slot).
    pub fn geoms(&self) -> impl Iterator<Item = GeomId> + '_ {
        self.geoms.iter().map(|(id, _)| id)
    }

    /// Whether an object is in its list now; a stale id is in none. Objects enter and leave their lists with updates.
    pub fn is_listed(&self, object: impl Into<ObjectId>) -> bool {
        match object.into() {
            ObjectId::Body(body) => self.bodies.get(body).is_some_and(|entry| entry.is_listed),
            ObjectId::Geom(geom) => self.geoms.get(geom).is_some_and(|entry| entry.is_listed),
            ObjectId::Controller(controller) => self.controllers.is_listed(controller),
            ObjectId::Joint(joint) => self.joints.is_listed(joint),
            ObjectId::Spring(spring) => self.springs.is_listed(spring),
        }
    }

    /// Whether an object was disposed, and goes at the next update or is gone already: true for every stale id.
    #[doc(alias = "IsDisposed")]
    pub fn is_disposed(&self, object: impl Into<ObjectId>) -> bool {
        match object.into() {
            ObjectId::Body(body) => self.bodies.get(body).is_none_or(|entry| entry.is_disposed),
            ObjectId::Geom(geom) => self.geoms.get(geom).is_none_or(|entry| entry.is_disposed),
            ObjectId::Controller(controller) => self.controllers.is_disposed(controller),
            ObjectId::Joint(joint) => self.joints.is_disposed(joint),
            ObjectId::Spring(spring) => self.springs.is_disposed(spring),
        }
    }

    /// The pairs whose boxes overlapped in the last update and which touch, in the order in which they are solved.
    #[doc(alias = "ArbiterList")]
    pub fn arbiters(&self) -> impl Iterator<Item = ArbiterRef<'_>> {
        (0..self.arbiters.len()).filter_map(|position| self.arbiter(position))
    }

    /// The arbiter at a position of the list, from 0; `None` beyond its end.
    pub fn arbiter(&self, position: usize) -> Option<ArbiterRef<'_>> {
        let arbiter = (position < self.arbiters.len()).then(|| self.arbiters.at(position))?;
        Some(ArbiterRef { geoms: arbiter.geoms?, friction: arbiter.friction, contacts: &arbiter.contacts })
    }

    /// Number of [`arbiters`](Self::arbiters).
    pub fn arbiter_count(&self) -> usize {
        self.arbiters.len()
    }

    /// Number of contacts of all arbiters.
    pub fn contact_count(&self) -> usize {
        self.arbiters().map(|arbiter| arbiter.contacts.len()).sum()
    }

    /// What happened in the last update, in order; cleared by the next.
    pub fn events(&self) -> &[Event] {
        &self.events
    }

    /// How much work the last update was.
    pub fn counters(&self) -> StepCounters {
        self.counters
    }
}

impl std::ops::Index<BodyId> for PhysicsSimulator {
    type Output = Body;
    /// # Panics
    /// If the id is stale; see [`PhysicsSimulator::body`].
    #[inline]
    fn index(&self, body: BodyId) -> &Body {
        &self.bodies[body].body
    }
}

impl std::ops::IndexMut<BodyId> for PhysicsSimulator {
    /// # Panics
    /// If the id is stale; see [`PhysicsSimulator::body_mut`].
    #[inline]
    fn index_mut(&mut self, body: BodyId) -> &mut Body {
        self.body_mut(body).expect("the id is stale: the body was disposed")
    }
}

impl std::ops::Index<GeomId> for PhysicsSimulator {
    type Output = Geom;
    /// # Panics
    /// If the id is stale; see [`PhysicsSimulator::geom`].
    #[inline]
    fn index(&self, geom: GeomId) -> &Geom {
        &self.geoms[geom].geom
    }
}

impl std::ops::IndexMut<GeomId> for PhysicsSimulator {
    /// # Panics
    /// If the id is stale; see [`PhysicsSimulator::geom_mut`].
    #[inline]
    fn index_mut(&mut self, geom: GeomId) -> &mut Geom {
        self.geom_mut(geom).expect("the id is stale: the geom was disposed")
    }
}
