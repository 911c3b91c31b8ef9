//! Updates, and what they tell.

use farseer_core::BodyId;

use super::TwoHalfPhysicsSimulator;
use crate::events::{Event, EventHandler};
use crate::stages::{self, Parts, StepCounters};
use crate::views::{TwoHalfContact, contacts};

/// Updates.
impl TwoHalfPhysicsSimulator {
    /// Moves everything by `dt` seconds. Games call this with a fixed step.
    ///
    /// A negative step runs backwards; 0 only lets things enter and leave. A step that is not finite, or so small
    /// that its reciprocal is not, changes nothing and is reported as [`Event::RejectedInput`].
    #[doc(alias = "Update")]
    pub fn update(&mut self, dt: f32) {
        self.run(dt, None);
    }

    /// [`update`](Self::update) with callbacks. Objects at different depths do not meet, so the handler is not
    /// asked about them.
    pub fn update_with(&mut self, dt: f32, handler: &mut dyn EventHandler) {
        self.run(dt, Some(handler));
    }

    /// [`update`](Self::update) by a game that wants to know [how long it took](Self::update_time): `now` is its
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

    /// How long the last update took in seconds: 0 unless a time function was handed in with
    /// [`update_timed`](Self::update_timed).
    #[doc(alias = "UpdateTime")]
    pub fn update_time(&self) -> f32 {
        self.report.update_time
    }

    /// What happened in the last update, in order; cleared by the next. Pairs that are at different depths do not
    /// appear.
    pub fn events(&self) -> &[Event] {
        &self.report.events
    }

    /// Lets the next update report [`Event::GripBroke`]: for what holds things by other means than joints, such as the hands of
    /// `twohalf-factories`.
    pub fn report_grip_broken(&mut self, holder: BodyId, load: BodyId) {
        self.world.broken_grips.push((holder, load));
    }

    /// How much work the last update was.
    pub fn counters(&self) -> StepCounters {
        self.report.counters
    }

    /// The contact points of the last update: of pairs in X and Y, then all others.
    #[doc(alias = "ContactList")]
    pub fn contacts(&self) -> impl Iterator<Item = TwoHalfContact> + '_ {
        contacts(&self.core, &self.world)
    }
}
