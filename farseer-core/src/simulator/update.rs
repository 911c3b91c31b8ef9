//! The update: in which order the stages come (behaviour chapter 04, section 3).

use super::tell::Handler;
use super::{EventHandler, PhysicsSimulator};
use crate::pipeline::forces::integrate_velocities;
use crate::pipeline::positions::move_body;
use crate::report::{Clock, Event, Stopwatch};

impl PhysicsSimulator {
    /// Moves everything by `dt` seconds. Games call this with a fixed step.
    ///
    /// A negative step runs backwards, but with the [precise set](crate::Methods::Precise), which refuses it; 0 only lets things enter and leave. A step that is not finite, or so small
    /// that its reciprocal is not, changes nothing and is reported as [`Event::RejectedInput`].
    #[doc(alias = "Update")]
    pub fn update(&mut self, dt: f32) {
        self.update_with_real_time(dt, 0.0, None);
    }

    /// [`update`](Self::update) with callbacks.
    pub fn update_with(&mut self, dt: f32, handler: &mut dyn EventHandler) {
        self.update_with_real_time(dt, 0.0, Some(handler));
    }

    /// [`update`](Self::update) that tells controllers how much time has really passed, in seconds; nothing else
    /// reads it. A time that is not finite is refused as `dt` is.
    #[doc(alias = "Update(float, float)")]
    pub fn update_with_real_time(&mut self, dt: f32, dt_real: f32, handler: Option<&mut dyn EventHandler>) {
        self.run(dt, dt_real, &mut Handler::new(handler), None);
    }

    /// [`update_with_real_time`](Self::update_with_real_time) that measures its [stages](Self::step_times). `now` is the
    /// caller's clock, in milliseconds since any moment: the engine has none, so that nothing depends on one.
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
            self.run_precise(dt, dt_real, handler, &mut stopwatch);
        } else if goes_on {
            self.look_for_pairs(handler);
            stopwatch.lap(|times| &mut times.broad_phase_collision_time);
            self.look_for_contacts(handler);
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

/// The stages of the faithful set one by one: for engines that are built on them, and for games that do something in between.
/// With the [precise set](crate::Methods::Precise) all but the first do nothing, which is reported as
/// [`Event::RejectedInput`].
impl PhysicsSimulator {
    /// First stage: things enter and leave, edited bodies take their geoms along, and pairs that have an arbiter
    /// are noted. Answers whether the update goes on: not if the simulator is disabled, or `dt` is 0 or refused.
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
    /// A handler that [filters pairs](EventHandler::filters_pairs) is asked first about those that have one.
    #[doc(alias(
        "IBroadPhaseCollider.Update",
        "ArbiterList.PrepareForBroadphaseCollision",
        "ArbiterList.AddArbiterForGeomPair"
    ))]
    pub fn find_pairs(&mut self, handler: Option<&mut dyn EventHandler>) {
        if self.has_stages() {
            self.look_for_pairs(&mut Handler::new(handler));
        }
    }

    /// Third stage: the narrow phase finds the contacts of every pair, deepest first, and takes over the impulses
    /// of those that were there before. Pairs without contacts leave.
    #[doc(alias("INarrowPhaseCollider.Collide", "ArbiterList.RemoveContactCountEqualsZero"))]
    pub fn collide_pairs(&mut self, handler: Option<&mut dyn EventHandler>) {
        if self.has_stages() {
            self.look_for_contacts(&mut Handler::new(handler));
        }
    }

    /// Fourth stage: controllers and springs act; impulses, gravity and drag become velocity. A body whose velocity
    /// would not be finite keeps what it had, and is disabled and reported.
    ///
    /// `dt_real` is what controllers are told about the time that has really passed. A step or time that is not
    /// finite changes nothing and is reported.
    #[doc(alias("Spring.Update", "Controller.Update"))]
    pub fn apply_forces(&mut self, dt: f32, dt_real: f32, handler: Option<&mut dyn EventHandler>) {
        if self.has_stages() {
            self.collect_and_integrate_forces(dt, dt_real, &mut Handler::new(handler));
        }
    }

    /// Last stage: velocities become positions, and geoms follow. A body whose state would not be finite is put
    /// back to its last finite one and reported; a dynamic one is disabled. With a step that is not finite nothing
    /// moves, which is reported.
    pub fn integrate(&mut self, dt: f32, handler: Option<&mut dyn EventHandler>) {
        if self.has_stages() {
            self.move_bodies(dt, &mut Handler::new(handler));
        }
    }
}

impl PhysicsSimulator {
    pub(super) fn begin(&mut self, dt: f32, handler: &mut Handler<'_>) -> bool {
        self.report.clear();
        self.contacts.forget_answers();
        if !self.accepts_step("dt", dt) || (dt != 0.0 && !self.accepts_step("dt", 1.0 / dt)) {
            return false;
        }
        if dt < 0.0 && self.pipeline.precise.is_some() {
            // What springs have learnt cannot be unlearnt.
            self.report.push(Event::RejectedInput { object: None, argument: "dt" });
            return false;
        }
        self.process_all_queues(handler);
        self.sync_precise();
        if self.pipeline.precise.is_none() {
            self.contacts.prepare_for_broad_phase_collision(&mut self.objects.geoms);
        }
        dt != 0.0 && self.settings.enabled
    }

    /// Whether a step, or its reciprocal, is finite; if not, the refusal is reported.
    pub(super) fn accepts_step(&mut self, argument: &'static str, step: f32) -> bool {
        if !step.is_finite() {
            self.report.push(Event::RejectedInput { object: None, argument });
        }
        step.is_finite()
    }

    /// Whether stages can be called one by one; if not, the call is reported as refused.
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
                self.tell(handler, |handler, context| handler.on_body_updated(context, body));
            }
        }
    }
}
