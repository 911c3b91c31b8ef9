//! The simulator: owns all objects and steps them (behaviour chapter 04).

mod apply_edits;
mod body_contacts;
mod callbacks;
pub(crate) mod candidates;
mod collide;
mod contacts;
mod context;
mod controllers;
#[cfg(feature = "space")]
pub mod depth;
mod facade;
mod game_settings;
mod handler;
#[cfg_attr(not(feature = "precise"), path = "no_precise.rs")]
mod precise;
mod queries;
mod save;
mod sleep;
mod solve;
mod springs;
#[cfg(feature = "precise")]
mod typed_events;
mod update;
mod user_controller;

use std::ops::{Deref, DerefMut};

use serde::{Deserialize, Serialize};

use crate::body::BodyId;
use crate::broad_phase::BroadPhase;
use crate::contacts::arbiter::ArbiterList;
use crate::joints::JointId;
use crate::math::Vector2;
use crate::math::finite::{finite, finite_vector};
use crate::methods::{BroadPhaseCollider, Methods, NarrowPhaseCollider, SolverChoice};
use crate::objects::{Objects, SavedObjects};
use crate::pipeline::Pipeline;
use crate::precise::Precise;
use crate::report::{Event, Hit, Report, StepCounters, StepTimes};
use crate::{Error, Result};
use farseer_precise::reusing_clone;
use farseer_precise::surface::FrictionType;

use game_settings::GameSettings;

pub use body_contacts::BodyContact;
pub use context::Context;
pub use handler::EventHandler;
pub(crate) use save::LoadedMovingSimulator;
pub use save::SavedSimulator;
pub use solve::{ExternalConstraints, SolverBodiesView};
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
    island_choice: SolverChoice,
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
            island_choice: SolverChoice::Auto,
        }
    }
}

/// Owns bodies and geoms and moves them in steps.
///
/// Operations on its objects are those of [`Objects`], to which a simulator derefs.
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
/// A clone continues with the same bits. To return to an earlier state again and again, keep a simulator and use
/// `clone_from`: it overwrites the state, and allocates only where objects have been added.
#[derive(Debug, Serialize)]
pub struct PhysicsSimulator {
    settings: Settings,
    #[serde(with = "SavedObjects")]
    objects: Objects,
    contacts: ArbiterList,
    pub(crate) pipeline: Pipeline,
    #[serde(skip)]
    report: Report,
    /// Not saved: they stay those of the simulator, as its limits do.
    #[serde(skip)]
    game_settings: GameSettings,
}

reusing_clone! { PhysicsSimulator { settings, objects, contacts, pipeline, report, game_settings } }

impl Default for PhysicsSimulator {
    fn default() -> Self {
        PhysicsSimulator {
            settings: Settings::default(),
            objects: Objects::empty(),
            contacts: ArbiterList::default(),
            pipeline: Pipeline::default(),
            report: Report::default(),
            game_settings: GameSettings::default(),
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
    /// An empty simulator with this gravity: acceleration in length units/s², y down.
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

    /// Acceleration, in length units/s², of every body that does not ignore it.
    #[doc(alias = "Gravity")]
    pub fn gravity(&self) -> Vector2 {
        self.settings.gravity
    }

    /// Sets the gravity.
    ///
    /// # Errors
    /// A value that is not finite.
    pub fn set_gravity(&mut self, gravity: Vector2) -> Result<()> {
        self.settings.gravity = finite_vector("gravity", gravity)?;
        Ok(())
    }

    /// Whether updates move bodies; queues are processed either way. Default true.
    #[doc(alias = "Enabled")]
    pub fn enabled(&self) -> bool {
        self.settings.enabled
    }

    /// Sets whether updates move bodies.
    pub fn set_enabled(&mut self, enabled: bool) {
        self.settings.enabled = enabled;
    }

    /// Number of solver iterations per update, as it was set. Default 5.
    #[doc(alias = "Iterations")]
    pub fn iterations(&self) -> i32 {
        self.settings.iterations
    }

    /// Sets the number of solver iterations; with 0 or less only the warm start is applied.
    ///
    /// There are at most as many as the [limits](Self::limits) allow, and none where there is neither a contact to
    /// solve nor a joint: [`StepCounters::passes`] is the number that was run.
    pub fn set_iterations(&mut self, iterations: i32) {
        self.settings.iterations = iterations;
    }

    /// Fraction of a penetration that is corrected per update, dimensionless. Default 0.8.
    #[doc(alias = "BiasFactor")]
    pub fn bias_factor(&self) -> f32 {
        self.settings.bias_factor
    }

    /// Sets the fraction of a penetration that is corrected per update.
    ///
    /// # Errors
    /// A value that is not finite; with the precise set, which has its own position correction, another value than the
    /// present one.
    pub fn set_bias_factor(&mut self, bias_factor: f32) -> Result<()> {
        let bias_factor = finite("bias_factor", bias_factor)?;
        self.check_faithful("bias factor", bias_factor != self.settings.bias_factor)?;
        self.settings.bias_factor = bias_factor;
        Ok(())
    }

    /// Penetration that is not corrected, in length units. Default 0.05.
    #[doc(alias = "AllowedPenetration")]
    pub fn allowed_penetration(&self) -> f32 {
        self.settings.allowed_penetration
    }

    /// Sets the penetration that is not corrected.
    ///
    /// # Errors
    /// A value that is not finite; with the precise set, which corrects all penetration, another value than the present
    /// one.
    pub fn set_allowed_penetration(&mut self, allowed_penetration: f32) -> Result<()> {
        let allowed_penetration = finite("allowed_penetration", allowed_penetration)?;
        let is_other = allowed_penetration != self.settings.allowed_penetration;
        self.check_faithful("allowed penetration", is_other)?;
        self.settings.allowed_penetration = allowed_penetration;
        Ok(())
    }

    /// Refuses another value of a setting that the precise set does not have.
    fn check_faithful(&self, what: &'static str, is_other: bool) -> Result<()> {
        if is_other && self.objects.methods.is_precise() {
            return Err(Error::NotSupported { what, methods: "precise" });
        }
        Ok(())
    }

    /// Maximum number of contacts that the narrow phase finds per pair. Default 10.
    #[doc(alias = "MaxContactsToDetect")]
    pub fn max_contacts_to_detect(&self) -> i32 {
        self.settings.max_contacts_to_detect
    }

    /// Sets the maximum number of contacts to find. A negative number is no limit for the distance grid and for the
    /// precise set, and leaves one contact for SAT.
    pub fn set_max_contacts_to_detect(&mut self, max_contacts_to_detect: i32) {
        self.settings.max_contacts_to_detect = max_contacts_to_detect;
    }

    /// Maximum number of contacts solved per pair, the deepest first. Default 4.
    #[doc(alias = "MaxContactsToResolve")]
    pub fn max_contacts_to_resolve(&self) -> i32 {
        self.settings.max_contacts_to_resolve
    }

    /// Sets the maximum number of contacts solved per pair.
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

    /// Rule for combining the friction of two geoms. Default [`FrictionType::Average`].
    #[doc(alias = "FrictionType")]
    pub fn friction_type(&self) -> FrictionType {
        self.settings.friction_type
    }

    /// Sets the rule for combining friction, for pairs that begin to overlap later.
    pub fn set_friction_type(&mut self, friction_type: FrictionType) {
        self.settings.friction_type = friction_type;
    }

    /// Whether bodies that have come to rest fall asleep. Default true; only with the [precise set](Methods::Precise),
    /// where the conditions are documented. Sleeping bodies cost no time and do not move; they wake by themselves as
    /// soon as something could move them.
    pub fn is_sleep_enabled(&self) -> bool {
        self.settings.is_sleep_enabled
    }

    /// Sets whether bodies that have come to rest fall asleep. If not, all are awake from the next update on.
    pub fn set_sleep_enabled(&mut self, value: bool) {
        self.settings.is_sleep_enabled = value;
    }

    /// Choice of the solver for islands of contacts. Default [`SolverChoice::Auto`]; only with the [precise
    /// set](Methods::Precise).
    pub fn solver_choice(&self) -> SolverChoice {
        self.settings.island_choice
    }

    /// Sets the solver of islands of contacts, from the next update on: to compare solvers, or to have the same one for
    /// all that the game builds. The choice is for all islands: they form, split and merge in every update, so there is
    /// no lasting island for which one could be set. It has no effect on ballistic, articulated and sleeping islands.
    ///
    /// ```
    /// use farseer_core::{BodyFactory, GeomFactory, GeomPlacement, SolverChoice, IslandSolver, SolverReason};
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
    /// assert_eq!((column.method, column.why), (IslandSolver::Direct, SolverReason::Pays));
    ///
    /// simulator.set_solver_choice(SolverChoice::Iterative);
    /// simulator.update(1.0 / 60.0);
    /// let column = &simulator.islands()[0];
    /// assert_eq!((column.method, column.why), (IslandSolver::Iterative, SolverReason::Chosen));
    /// # Ok::<(), farseer_core::Error>(())
    /// ```
    pub fn set_solver_choice(&mut self, choice: SolverChoice) {
        self.settings.island_choice = choice;
    }

    /// The methods, with the present cell size if the broad phase has one. Default [`Methods::default`].
    pub fn methods(&self) -> Methods {
        self.objects.methods
    }

    /// Sets the methods. Existing geoms are not prepared for another narrow phase; see
    /// [`set_narrow_phase_collider`](Self::set_narrow_phase_collider). A change between the faithful and the precise
    /// set, between updates, keeps all state but the solver's impulses of contacts and joints: resting bodies start
    /// without them. Settings that the precise set does not have keep their values, for a change back.
    ///
    /// # Errors
    /// Another broad phase of the faithful set if a geom is in the simulator already ([`Error::GeomListNotEmpty`];
    /// geoms still waiting to be added do not count). A cell size or length that is not finite, or a length that is not
    /// greater than 0. The faithful set while there are bodies with locked axes, chains, one-way geoms, or joints of a kind,
    /// or with a motor, servo, limits or flag, that it does not have ([`Error::NotSupported`]).
    pub fn set_methods(&mut self, methods: Methods) -> Result<()> {
        let methods = methods.check()?;
        self.objects.bodies.listed_or_queued().try_for_each(|entry| methods.check_body(&entry.body))?;
        self.objects.geoms.listed_or_queued().try_for_each(|geom| methods.check_geom(geom))?;
        self.objects.joints.listed_or_queued().try_for_each(|joint| methods.check_joint(joint))?;
        match methods.length_unit() {
            None => self.set_faithful_broad_phase(methods.broad())?,
            Some(_) if methods == self.objects.methods => {}
            Some(_) => {
                self.contacts = Default::default();
                // It stays empty: the precise set has a broad phase of its own.
                self.pipeline.broad_phase = BroadPhase::new(methods.broad());
                self.pipeline.precise = Precise::of_methods(methods);
            }
        }
        if methods.is_precise() != self.objects.methods.is_precise() {
            let joints: Vec<JointId> = self.objects.joints.iter().map(|(id, _)| id).collect();
            joints.into_iter().for_each(|joint| self.objects.joints[joint].forget_impulse());
            // The precise set lists them anew, and the faithful set has none.
            self.objects.separated_bodies.clear();
        }
        self.objects.methods = methods;
        Ok(())
    }

    fn set_faithful_broad_phase(&mut self, broad: BroadPhaseCollider) -> Result<()> {
        if self.pipeline.precise.is_none() && !self.geom_list().is_empty() {
            return Err(Error::GeomListNotEmpty);
        }
        if self.pipeline.precise.take().is_some() {
            let bodies: Vec<BodyId> = self.objects.bodies().collect();
            bodies.into_iter().for_each(|body| self.objects.update_edited_geom_transforms(body));
        }
        self.rebuild_broad_phase(broad);
        Ok(())
    }

    fn rebuild_broad_phase(&mut self, broad: BroadPhaseCollider) {
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

    /// Sets the narrow phase. Geoms made under SAT have no distance grid and make no contacts under the other method.
    /// With the precise set, which has its own narrow phase, the call has no effect and is reported as
    /// [`Event::RejectedInput`].
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
    /// As [`set_methods`](Self::set_methods); [`Error::NotSupported`] with the precise set, which has its own broad
    /// phase.
    pub fn set_broad_phase_collider(&mut self, method: BroadPhaseCollider) -> Result<()> {
        if self.objects.methods.is_precise() {
            return Err(Error::NotSupported { what: "choice of a broad phase", methods: "precise" });
        }
        self.set_methods(self.objects.methods.with_broad(method))
    }
}

/// Results of the last update.
impl PhysicsSimulator {
    /// The events of the last update, in order; the next update clears them.
    pub fn events(&self) -> &[Event] {
        &self.report.events
    }

    /// The hits of the last update: touches that began at more than the [hit speed](Self::hit_speed), once for each pair of
    /// geoms, in the order of their creation numbers. One of both geoms [wants](crate::Geom::set_wanted_events) hits. Points
    /// that close while others of the pair touch already, as when a box tips over, are hits, too. Contacts that a handler
    /// refused are none. Only with the [precise set](Methods::Precise).
    ///
    /// ```
    /// use farseer_core::{BodyBuilder, GeomBuilder, PhysicsSimulator, WantedEvents};
    /// let mut simulator = PhysicsSimulator::precise([0.0, 300.0])?;
    /// simulator.add_body(BodyBuilder::fixed().position([0.0, 10.0]), [GeomBuilder::rectangle(400.0, 20.0)])?;
    /// let ball = GeomBuilder::circle(10.0).events(WantedEvents::HIT);
    /// simulator.add_body(BodyBuilder::dynamic().position([0.0, -160.0]), [ball])?;
    /// let mut speeds = Vec::new();
    /// for _ in 0..120 {
    ///     simulator.update(1.0 / 60.0);
    ///     speeds.extend(simulator.hits().iter().map(|hit| hit.speed));
    /// }
    /// // A fall of 150 px, once: sqrt(2 * 300 * 150) = 300.
    /// assert_eq!(speeds.len(), 1);
    /// assert!((speeds[0] - 300.0).abs() < 10.0);
    /// # Ok::<(), farseer_core::Error>(())
    /// ```
    pub fn hits(&self) -> &[Hit] {
        &self.report.hits
    }

    /// Counters of the work of the last update.
    pub fn counters(&self) -> StepCounters {
        self.report.counters
    }

    /// Times of the stages of the last [timed update](Self::update_timed).
    pub fn step_times(&self) -> StepTimes {
        self.report.step_times
    }
}
