//! The update: the order of its stages (behaviour chapter 04, section 3).

use super::callbacks::Handler;
use super::{EventHandler, PhysicsSimulator};
use crate::pipeline::integrate_positions::move_body;
use crate::pipeline::integrate_velocities::integrate_velocities;
use crate::report::{Clock, Event, Stopwatch};

impl PhysicsSimulator {
    /// Advances the simulation by `dt` seconds. Games call this with a fixed step.
    ///
    /// A negative step runs backwards, except with the [precise set](crate::Methods::Precise), which refuses it. With 0
    /// objects only enter and leave. A step that is not finite, or whose reciprocal is not, has no effect and is
    /// reported as [`Event::RejectedInput`].
    #[doc(alias = "Update")]
    pub fn update(&mut self, dt: f32) {
        self.update_with_real_time(dt, 0.0, None);
    }

    /// [`update`](Self::update) with callbacks.
    pub fn update_with(&mut self, dt: f32, handler: &mut dyn EventHandler) {
        self.update_with_real_time(dt, 0.0, Some(handler));
    }

    /// [`update`](Self::update) with the real time that has passed, in seconds, for controllers; all other stages
    /// ignore it. A time that is not finite is refused as `dt` is.
    #[doc(alias = "Update(float, float)")]
    pub fn update_with_real_time(&mut self, dt: f32, dt_real: f32, handler: Option<&mut dyn EventHandler>) {
        self.run(dt, dt_real, &mut Handler::new(handler), None);
    }

    /// [`update_with_real_time`](Self::update_with_real_time) that measures its [stages](Self::step_times). `now` is
    /// the caller's clock, in milliseconds since any moment: the engine has none, so that no result depends on one.
    ///
    /// ```
    /// # use farseer_core::PhysicsSimulator;
    /// # let mut simulator = PhysicsSimulator::default();
    /// let start = std::time::Instant::now();
    /// simulator.update_timed(0.01, 0.0, None, &mut || start.elapsed().as_secs_f64() * 1000.0);
    /// assert!(simulator.step_times().update_time >= 0.0);
    /// ```
    #[doc(alias = "EnableDiagnostics")]
    pub fn update_timed(
        &mut self,
        dt: f32,
        dt_real: f32,
        handler: Option<&mut dyn EventHandler>,
        now: &mut dyn FnMut() -> f64,
    ) {
        self.run(dt, dt_real, &mut Handler::new(handler), Some(now));
    }

    fn run(&mut self, dt: f32, dt_real: f32, handler: &mut Handler<'_>, clock: Option<Clock<'_>>) {
        let mut stopwatch = Stopwatch::start(clock);
        let goes_on = self.begin(dt, handler);
        stopwatch.lap(|times| &mut times.clean_up_time);
        if goes_on && self.pipeline.precise.is_some() {
            self.step_precise(dt, dt_real, handler, &mut stopwatch);
        } else if goes_on {
            self.run_broad_phase(handler);
            stopwatch.lap(|times| &mut times.broad_phase_collision_time);
            self.run_narrow_phase(handler);
            stopwatch.lap(|times| &mut times.narrow_phase_collision_time);
            self.collect_and_integrate_forces(dt, dt_real, handler);
            stopwatch.lap(|times| &mut times.apply_forces_time);
            self.solve(1.0 / dt, None, handler);
            stopwatch.lap(|times| &mut times.apply_impulses_time);
            self.move_bodies(dt, handler);
            stopwatch.lap(|times| &mut times.update_positions_time);
        }
        self.report.step_times = stopwatch.times().unwrap_or(self.report.step_times);
    }
}

/// The stages of the faithful set one by one: for engines that are built on them, and for games with work between them.
/// With the [precise set](crate::Methods::Precise) all but the first have no effect, which is reported as
/// [`Event::RejectedInput`].
impl PhysicsSimulator {
    /// First stage: objects enter and leave, geoms of edited bodies are updated, and pairs that have an arbiter are
    /// entered in the table. Returns whether the update continues: not if the simulator is disabled, or `dt` is 0 or
    /// refused.
    #[doc(alias(
        "IBroadPhaseCollider.ProcessRemovedGeoms",
        "IBroadPhaseCollider.ProcessDisposedGeoms",
        "ArbiterList.CleanArbiterList",
        "Joint.Validate",
        "Spring.Validate"
    ))]
    pub fn process_queues(&mut self, dt: f32, handler: Option<&mut dyn EventHandler>) -> bool {
        self.begin(dt, &mut Handler::new(handler))
    }

    /// Second stage: the broad phase appends arbiters for new pairs whose boxes overlap.
    ///
    /// A handler that [filters pairs](EventHandler::filters_pairs) is asked first about the pairs that have an arbiter.
    #[doc(alias(
        "IBroadPhaseCollider.Update",
        "ArbiterList.PrepareForBroadphaseCollision",
        "ArbiterList.AddArbiterForGeomPair"
    ))]
    pub fn find_pairs(&mut self, handler: Option<&mut dyn EventHandler>) {
        if self.has_stages() {
            self.run_broad_phase(&mut Handler::new(handler));
        }
    }

    /// Third stage: the narrow phase finds the contacts of every pair, deepest first, and keeps the impulses of known
    /// ones for the warm start. Arbiters without contacts are removed.
    #[doc(alias("INarrowPhaseCollider.Collide", "ArbiterList.RemoveContactCountEqualsZero"))]
    pub fn collide_pairs(&mut self, handler: Option<&mut dyn EventHandler>) {
        if self.has_stages() {
            self.run_narrow_phase(&mut Handler::new(handler));
        }
    }

    /// Fourth stage: controllers and springs act; impulses, gravity and drag change velocities. A body whose velocity
    /// would not be finite keeps its old one, and is disabled and reported.
    ///
    /// `dt_real` is the real time for controllers, in seconds. A step or time that is not finite has no effect and is
    /// reported.
    #[doc(alias("Spring.Update", "Controller.Update"))]
    pub fn apply_forces(&mut self, dt: f32, dt_real: f32, handler: Option<&mut dyn EventHandler>) {
        if self.has_stages() {
            self.collect_and_integrate_forces(dt, dt_real, &mut Handler::new(handler));
        }
    }

    /// Last stage: velocities are integrated into positions, and geoms are updated. A body whose state would not be
    /// finite is put back to its last finite one and reported; a dynamic one is disabled. A step that is not finite has
    /// no effect, and is reported.
    pub fn integrate(&mut self, dt: f32, handler: Option<&mut dyn EventHandler>) {
        if self.has_stages() {
            self.move_bodies(dt, &mut Handler::new(handler));
        }
    }
}

impl PhysicsSimulator {
    pub(super) fn begin(&mut self, dt: f32, handler: &mut Handler<'_>) -> bool {
        self.report.clear();
        self.contacts.clear_overrides();
        if !self.accepts_step("dt", dt) || (dt != 0.0 && !self.accepts_step("dt", 1.0 / dt)) {
            return false;
        }
        if dt < 0.0 && self.pipeline.precise.is_some() {
            // The state of springs cannot be integrated backwards.
            self.report.push(Event::RejectedInput { object: None, argument: "dt" });
            return false;
        }
        self.process_all_queues(handler);
        self.import_edits();
        if self.pipeline.precise.is_none() {
            self.contacts.prepare_for_broad_phase_collision(&mut self.objects.geoms);
        }
        dt != 0.0 && self.settings.enabled
    }

    /// Whether a step, or its reciprocal, is finite; if not, the rejection is reported.
    pub(super) fn accepts_step(&mut self, argument: &'static str, step: f32) -> bool {
        if !step.is_finite() {
            self.report.push(Event::RejectedInput { object: None, argument });
        }
        step.is_finite()
    }

    /// Whether stages can be called one by one; if not, the call is reported as rejected.
    pub(super) fn has_stages(&mut self) -> bool {
        let has_stages = self.pipeline.precise.is_none();
        if !has_stages {
            self.report.push(Event::RejectedInput { object: None, argument: "stage" });
        }
        has_stages
    }

    fn collect_and_integrate_forces(&mut self, dt: f32, dt_real: f32, handler: &mut Handler<'_>) {
        if !self.accepts_step("dt", dt) || !self.accepts_step("dt_real", dt_real) {
            return;
        }
        self.update_controllers(dt, dt_real, handler);
        self.update_springs(None, handler);
        integrate_velocities(&mut self.objects.bodies, self.settings.gravity, dt, &mut self.report);
    }

    fn move_bodies(&mut self, dt: f32, handler: &mut Handler<'_>) {
        self.finish_solving();
        if !self.accepts_step("dt", dt) {
            return;
        }
        for position in 0..self.body_list().len() {
            if let Some(body) = move_body(&mut self.objects, &mut self.report, position, dt) {
                self.call_handler(handler, |handler, context| handler.on_body_updated(context, body));
            }
        }
    }
}
