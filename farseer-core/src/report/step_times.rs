//! Times of the stages of an update (behaviour chapter 04, section 8), measured by a clock of the caller.

/// Times of the stages of the last timed update, in milliseconds.
///
/// Before the first [timed update](crate::PhysicsSimulator::update_timed) all are 0, or, as in the original, -1 if the
/// simulator was made with [a gravity](crate::PhysicsSimulator::new). They are not saved.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct StepTimes {
    /// Objects entering and leaving, in milliseconds.
    #[doc(alias = "CleanUpTime")]
    pub clean_up_time: f32,
    /// The broad phase, in milliseconds.
    #[doc(alias = "BroadPhaseCollisionTime")]
    pub broad_phase_collision_time: f32,
    /// The narrow phase, with the callbacks of collisions, in milliseconds.
    #[doc(alias = "NarrowPhaseCollisionTime")]
    pub narrow_phase_collision_time: f32,
    /// Controllers, springs and forces, in milliseconds.
    #[doc(alias = "ApplyForcesTime")]
    pub apply_forces_time: f32,
    /// Joints and contacts: pre-step and all iterations, in milliseconds.
    #[doc(alias = "ApplyImpulsesTime")]
    pub apply_impulses_time: f32,
    /// Integration of positions and update of geoms, in milliseconds.
    #[doc(alias = "UpdatePositionsTime")]
    pub update_positions_time: f32,
    /// The whole update, in milliseconds.
    #[doc(alias = "UpdateTime")]
    pub update_time: f32,
}

impl StepTimes {
    /// The original's values after a construction with gravity.
    pub(crate) const NEVER_MEASURED: StepTimes = StepTimes {
        clean_up_time: -1.0,
        broad_phase_collision_time: -1.0,
        narrow_phase_collision_time: -1.0,
        apply_forces_time: -1.0,
        apply_impulses_time: -1.0,
        update_positions_time: -1.0,
        update_time: -1.0,
    };
}

/// The caller's clock: returns the time in milliseconds, from any origin.
pub(crate) type Clock<'c> = &'c mut dyn FnMut() -> f64;

/// Measures the stages of one update, if there is a clock.
pub(crate) struct Stopwatch<'c> {
    clock: Option<Clock<'c>>,
    start: f64,
    now: f64,
    times: StepTimes,
}

impl<'c> Stopwatch<'c> {
    pub(crate) fn start(mut clock: Option<Clock<'c>>) -> Self {
        let now = clock.as_mut().map_or(0.0, |clock| clock());
        Stopwatch { clock, start: now, now, times: StepTimes::default() }
    }

    /// Stores the time of a stage that has ended.
    pub(crate) fn lap(&mut self, time: impl FnOnce(&mut StepTimes) -> &mut f32) {
        if let Some(clock) = &mut self.clock {
            let before = std::mem::replace(&mut self.now, clock());
            *time(&mut self.times) = (self.now - before) as f32;
        }
    }

    /// All times, if they were measured; those of stages that were not reached are 0.
    pub(crate) fn times(&self) -> Option<StepTimes> {
        let update_time = (self.now - self.start) as f32;
        self.clock.is_some().then_some(StepTimes { update_time, ..self.times })
    }
}
