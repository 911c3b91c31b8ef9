//! The simulator: owns everything and steps it (behaviour chapter 04).

mod collide;
mod contacts;
mod context;
mod controllers;
mod handler;
mod precise;
mod queries;
mod save;
mod settle;
mod sleep;
mod solve;
mod space;
mod springs;
mod tell;
mod update;
mod user_controller;
mod verbs;

use std::ops::{Deref, DerefMut};

use serde::{Deserialize, Serialize};

use crate::body::BodyId;
use crate::contacts::arbiter::ArbiterList;
use crate::geom::surface::FrictionType;
use crate::joints::JointId;
use crate::math::Vector2;
use crate::math::finite::{finite, finite_vector};
use crate::methods::{BroadPhaseCollider, IslandChoice, Methods, NarrowPhaseCollider};
use crate::objects::{Objects, SavedObjects};
use crate::pairs::BroadPhase;
use crate::pipeline::Pipeline;
use crate::precise::Precise;
use crate::report::{Event, Report, StepCounters, StepTimes};
use crate::storage::reusing_clone::reusing_clone;
use crate::{Error, Result};

pub use context::Context;
pub use handler::EventHandler;
pub use save::SavedSimulator;
pub use solve::{Constraints, SolvedBodies};
pub use user_controller::UserController;

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
    is_sleep_enabled: bool,
    island_choice: IslandChoice,
}

impl Default for Settings {
    fn default() -> Self {
        Settings {
            gravity: Vector2::zeros(),
            enabled: true,
            iterations: 5,
            bias_factor: 0.8,
            allowed_penetration: 0.05,
            max_contacts_to_detect: 10,
            max_contacts_to_resolve: 4,
            friction_type: FrictionType::Average,
            is_sleep_enabled: true,
            island_choice: IslandChoice::ByItself,
        }
    }
}

/// Owns bodies and geoms and moves them in steps.
///
/// Everything that can be done to its objects is what [`Objects`] offers: a simulator is used as if it were them.
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
///
/// A clone goes on with the same bits. To go back again and again, keep a simulator and use `clone_from`: it overwrites what
/// is there, and allocates nothing where nothing new has come.
#[derive(Debug, Serialize)]
pub struct PhysicsSimulator {
    settings: Settings,
    #[serde(with = "SavedObjects")]
    objects: Objects,
    contacts: ArbiterList,
    pipeline: Pipeline,
    #[serde(skip)]
    report: Report,
}

reusing_clone! { PhysicsSimulator { settings, objects, contacts, pipeline, report } }

impl Default for PhysicsSimulator {
    fn default() -> Self {
        PhysicsSimulator {
            settings: Settings::default(),
            objects: Objects::none(),
            contacts: ArbiterList::default(),
            pipeline: Pipeline::default(),
            report: Report::default(),
        }
    }
}

impl Deref for PhysicsSimulator {
    type Target = Objects;
    #[inline]
    fn deref(&self) -> &Objects {
        &self.objects
    }
}

impl DerefMut for PhysicsSimulator {
    #[inline]
    fn deref_mut(&mut self) -> &mut Objects {
        &mut self.objects
    }
}

/// Settings.
impl PhysicsSimulator {
    /// An empty simulator with this gravity: acceleration in the user's length unit per square second, y down.
    ///
    /// # Errors
    /// Gravity that is not finite.
    #[doc(alias = "PhysicsSimulator()")]
    pub fn new(gravity: Vector2) -> Result<Self> {
        let mut simulator = PhysicsSimulator::default();
        simulator.set_gravity(gravity)?;
        simulator.report.step_times = StepTimes::NEVER_MEASURED;
        Ok(simulator)
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
    /// What is not finite; another number than it has with the precise set, which undoes overlaps in its own way.
    pub fn set_bias_factor(&mut self, bias_factor: f32) -> Result<()> {
        let bias_factor = finite("bias_factor", bias_factor)?;
        self.check_faithful("bias factor", bias_factor != self.settings.bias_factor)?;
        self.settings.bias_factor = bias_factor;
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
    /// What is not finite; another number than it has with the precise set, which leaves none alone.
    pub fn set_allowed_penetration(&mut self, allowed_penetration: f32) -> Result<()> {
        let allowed_penetration = finite("allowed_penetration", allowed_penetration)?;
        let is_other = allowed_penetration != self.settings.allowed_penetration;
        self.check_faithful("allowed penetration", is_other)?;
        self.settings.allowed_penetration = allowed_penetration;
        Ok(())
    }

    /// With the precise set a setting that it does not have cannot become another one.
    fn check_faithful(&self, what: &'static str, is_other: bool) -> Result<()> {
        if is_other && self.objects.methods.is_precise() {
            return Err(Error::NotSupported { what, methods: "precise" });
        }
        Ok(())
    }

    /// Contacts the narrow phase looks for per pair. Default 10.
    #[doc(alias = "MaxContactsToDetect")]
    pub fn max_contacts_to_detect(&self) -> i32 {
        self.settings.max_contacts_to_detect
    }

    /// Sets the number of contacts to look for. A negative number is no limit for the distance grid and for the precise set,
    /// and leaves one contact for SAT.
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

    /// Whether bodies that have come to rest sleep. Default true; only with the [precise set](Methods::Precise), which says
    /// when they do. What sleeps costs nothing and does not move; it wakes by itself as soon as something could move it.
    pub fn is_sleep_enabled(&self) -> bool {
        self.settings.is_sleep_enabled
    }

    /// Sets whether bodies that have come to rest sleep. If not, all are awake from the next update on.
    pub fn set_sleep_enabled(&mut self, value: bool) {
        self.settings.is_sleep_enabled = value;
    }

    /// How islands of contacts are solved. Default [`IslandChoice::ByItself`]; only with the
    /// [precise set](Methods::Precise).
    pub fn island_choice(&self) -> IslandChoice {
        self.settings.island_choice
    }

    /// Sets how islands of contacts are solved, from the next update on: to compare methods, or to have the same one whatever
    /// the game builds. It is for all of a scene: islands come, part and join in every update, so there is nothing that lasts
    /// for which one could be set. What flies, swings or sleeps is not touched by it.
    ///
    /// ```
    /// use farseer_core::{BodyFactory, GeomFactory, GeomPlacement, IslandChoice, IslandMethod, WhyMethod};
    /// use farseer_core::{Methods, PhysicsSimulator, math::Vector2};
    ///
    /// let mut simulator = PhysicsSimulator::new(Vector2::new(0.0, 300.0))?;
    /// simulator.set_methods(Methods::PRECISE)?;
    /// for (row, height) in [20.0, 32.0, 32.0].into_iter().enumerate() {
    ///     let body = BodyFactory::create_rectangle_body_in(&mut simulator, 32.0, height, 1.0)?;
    ///     simulator[body].set_position(Vector2::new(0.0, if row == 0 { 10.0 } else { 16.0 - 32.0 * row as f32 }));
    ///     simulator[body].set_is_static(row == 0);
    ///     GeomFactory::create_rectangle_geom_in(&mut simulator, body, 32.0, height, GeomPlacement::default())?;
    /// }
    /// simulator.update(1.0 / 60.0);
    /// let column = &simulator.islands()[0];
    /// assert_eq!((column.method, column.why), (IslandMethod::Whole, WhyMethod::Pays));
    ///
    /// simulator.set_island_choice(IslandChoice::Passes);
    /// simulator.update(1.0 / 60.0);
    /// let column = &simulator.islands()[0];
    /// assert_eq!((column.method, column.why), (IslandMethod::Passes, WhyMethod::Chosen));
    /// # Ok::<(), farseer_core::Error>(())
    /// ```
    pub fn set_island_choice(&mut self, choice: IslandChoice) {
        self.settings.island_choice = choice;
    }

    /// The methods, with the present cell size if the broad phase has one. Default [`Methods::default`].
    pub fn methods(&self) -> Methods {
        self.objects.methods
    }

    /// Chooses the methods. Geoms that are there already are not made ready for another narrow phase; see
    /// [`set_narrow_phase_collider`](Self::set_narrow_phase_collider). From the faithful set to the precise one and back,
    /// between updates, everything stays but what the solver knows of contacts and joints: what rests begins to rest anew.
    /// Settings that the precise set does not have stay what they are, for the way back.
    ///
    /// # Errors
    /// A broad phase of the faithful set in place of another one if a geom is in the simulator already
    /// ([`Error::GeomListNotEmpty`]; geoms still waiting to be added do not count); a cell size or length that is not finite,
    /// or a length that is not greater than 0; the faithful set while there are chains, one-way geoms, prismatic joints, or joints with a
    /// motor or limits that it does not have ([`Error::NotSupported`]).
    pub fn set_methods(&mut self, methods: Methods) -> Result<()> {
        let methods = methods.check()?;
        self.objects.geoms.listed_or_queued().try_for_each(|geom| methods.check_geom(geom))?;
        self.objects.joints.listed_or_queued().try_for_each(|joint| methods.check_joint(joint))?;
        match methods {
            Methods::Faithful { broad, .. } => self.set_faithful_pairs(broad)?,
            Methods::Precise { .. } if methods == self.objects.methods => {}
            Methods::Precise { length_unit } => {
                self.contacts = Default::default();
                self.list_pairs_anew(methods.broad());
                self.pipeline.precise = Some(Box::new(Precise::new(length_unit)));
            }
        }
        if methods.is_precise() != self.objects.methods.is_precise() {
            let joints: Vec<JointId> = self.objects.joints.iter().map(|(id, _)| id).collect();
            joints.into_iter().for_each(|joint| self.objects.joints[joint].forget_impulse());
        }
        self.objects.methods = methods;
        Ok(())
    }

    fn set_faithful_pairs(&mut self, broad: BroadPhaseCollider) -> Result<()> {
        if self.pipeline.precise.is_none() && !self.geom_list().is_empty() {
            return Err(Error::GeomListNotEmpty);
        }
        if self.pipeline.precise.take().is_some() {
            let bodies: Vec<BodyId> = self.objects.bodies().collect();
            bodies.into_iter().for_each(|body| self.objects.settle_body(body));
        }
        self.list_pairs_anew(broad);
        Ok(())
    }

    fn list_pairs_anew(&mut self, broad: BroadPhaseCollider) {
        self.pipeline.broad_phase = BroadPhase::new(broad);
        for &geom in self.objects.geoms.list() {
            self.pipeline.broad_phase.add(geom, &self.objects.geoms);
        }
    }

    /// The narrow phase. Default [`NarrowPhaseCollider::DistanceGrid`].
    #[doc(alias = "NarrowPhaseCollider")]
    pub fn narrow_phase_collider(&self) -> NarrowPhaseCollider {
        self.objects.methods.narrow()
    }

    /// Sets the narrow phase. Geoms made under SAT have no distance grid and touch nothing under the other. The precise set
    /// has contacts of its own: nothing changes, which is reported as [`Event::RejectedInput`].
    pub fn set_narrow_phase_collider(&mut self, narrow_phase: NarrowPhaseCollider) {
        if self.objects.methods.is_precise() {
            self.report.push(Event::RejectedInput { object: None, argument: "narrow_phase" });
        }
        self.objects.methods = self.objects.methods.with_narrow(narrow_phase);
    }

    /// The broad phase, with its present cell size if it has one.
    #[doc(alias = "BroadPhaseCollider")]
    pub fn broad_phase_collider(&self) -> BroadPhaseCollider {
        self.objects.methods.broad()
    }

    /// Sets the broad phase.
    ///
    /// # Errors
    /// As [`set_methods`](Self::set_methods); [`Error::NotSupported`] with the precise set, which has pairs of its own.
    pub fn set_broad_phase_collider(&mut self, method: BroadPhaseCollider) -> Result<()> {
        if self.objects.methods.is_precise() {
            return Err(Error::NotSupported { what: "choice of a broad phase", methods: "precise" });
        }
        self.set_methods(self.objects.methods.with_broad(method))
    }
}

/// What the last update did.
impl PhysicsSimulator {
    /// What happened in the last update, in order; cleared by the next.
    pub fn events(&self) -> &[Event] {
        &self.report.events
    }

    /// How much work the last update was.
    pub fn counters(&self) -> StepCounters {
        self.report.counters
    }

    /// How long the stages of the last [timed update](Self::update_timed) took.
    pub fn step_times(&self) -> StepTimes {
        self.report.step_times
    }
}
