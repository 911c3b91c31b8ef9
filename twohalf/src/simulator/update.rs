//! Updates and their reports.

use farseer_core::BodyId;

use super::TwoHalfPhysicsSimulator;
use crate::events::{Event, EventHandler};
use crate::stages::{self, Parts, StepCounters};
use crate::views::{TwoHalfContact, contacts};

/// Updates.
impl TwoHalfPhysicsSimulator {
    /// Advances the simulation by `dt` seconds. Games call this with a fixed step.
    ///
    /// A negative step runs backwards; with 0 objects only enter and leave. A step that is not finite, or
    /// whose reciprocal is not, changes nothing and is reported as [`Event::RejectedInput`].
    #[doc(alias = "Update")]
    pub fn update(&mut self, dt: f32) {
        self.run(dt, None);
    }

    /// [`update`](Self::update) with callbacks. Objects at different depths do not touch, so the handler gets
    /// no callback for them.
    pub fn update_with(&mut self, dt: f32, handler: &mut dyn EventHandler) {
        self.run(dt, Some(handler));
    }

    /// [`update`](Self::update) with a measurement of its [duration](Self::update_time): `now` is the game's
    /// clock, in seconds. The engine has no clock of its own, so that nothing depends on one.
    pub fn update_timed(&mut self, dt: f32, mut now: impl FnMut() -> f64) {
        let start = now();
        self.run(dt, None);
        self.report.update_time = (now() - start) as f32;
    }

    fn run(&mut self, dt: f32, handler: Option<&mut dyn EventHandler>) {
        let TwoHalfPhysicsSimulator { core, world, pipeline, report, .. } = self;
        stages::update(Parts { core, world, pipeline, report }, dt, handler);
    }

    /// Duration of the last update, s: 0 unless it was measured by [`update_timed`](Self::update_timed).
    #[doc(alias = "UpdateTime")]
    pub fn update_time(&self) -> f32 {
        self.report.update_time
    }

    /// Events of the last update, in order; the next update clears them. Pairs at different depths have none.
    pub fn events(&self) -> &[Event] {
        &self.report.events
    }

    /// Queues an [`Event::GripBroke`] for the next update, for grips that are no joints, such as the hands of
    /// `twohalf-factories`.
    pub fn report_grip_broken(&mut self, holder: BodyId, load: BodyId) {
        self.world.broken_grips.push((holder, load));
    }

    /// Counters of the work of the last update.
    pub fn counters(&self) -> StepCounters {
        self.report.counters
    }

    /// Contact points of the last update: those of pairs in X and Y, then all others.
    #[doc(alias = "ContactList")]
    pub fn contacts(&self) -> impl Iterator<Item = TwoHalfContact> + '_ {
        contacts(&self.core, &self.world)
    }
}
