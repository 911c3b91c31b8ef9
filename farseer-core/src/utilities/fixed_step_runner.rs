//! Updates of a fixed length for frames of any length, with poses between two updates.

use std::time::Duration;

use super::{BodyInterpolation, FixedStepClock, InterpolatedPose};
use crate::Result;
use crate::body::BodyId;
use crate::simulator::PhysicsSimulator;

/// A [`FixedStepClock`] with a [`BodyInterpolation`]: the loop of a game in one call per frame.
///
/// ```
/// use farseer_core::{BodyBuilder, FixedStepRunner, GeomBuilder, PhysicsSimulator};
/// use std::time::Duration;
///
/// let mut simulator = PhysicsSimulator::precise([0.0, 0.0])?;
/// let ball = BodyBuilder::dynamic().linear_velocity([60.0, 0.0]);
/// let (ball, _) = simulator.add_body(ball, [GeomBuilder::circle(10.0)])?;
/// let mut runner = FixedStepRunner::new(60)?;
/// // Once per frame, here of 40 ms: two updates are due, and 40 % of the next one's time has passed.
/// let updates = runner.advance(&mut simulator, Duration::from_millis(40), |simulator, dt| {
///     // Input comes here, and events after the update.
///     simulator.update(dt);
/// });
/// assert_eq!(updates, 2);
/// let x = runner.pose(ball).unwrap().position.x;
/// assert!((x - 1.4).abs() < 0.01, "between 1 and 2");
/// # Ok::<(), farseer_core::Error>(())
/// ```
#[derive(Debug, Clone)]
pub struct FixedStepRunner {
    clock: FixedStepClock,
    interpolation: BodyInterpolation,
}

impl FixedStepRunner {
    /// A runner with this number of updates per second.
    ///
    /// # Errors
    /// No updates per second.
    pub fn new(updates_per_second: u32) -> Result<Self> {
        if updates_per_second == 0 {
            return Err(crate::Error::invalid("updates_per_second", updates_per_second, "greater than 0"));
        }
        let clock = FixedStepClock::new(Duration::from_secs(1) / updates_per_second)?;
        Ok(FixedStepRunner::with_clock(clock))
    }

    /// A runner with a clock of the game's own.
    pub fn with_clock(clock: FixedStepClock) -> Self {
        FixedStepRunner { clock, interpolation: BodyInterpolation::new() }
    }

    /// Adds the time since the last frame and calls `update` for each update that is due, with the length of an update in
    /// seconds: it has to update the simulator once. Returns the number of these updates, at most the
    /// [maximum](FixedStepClock::max_updates) of the clock.
    pub fn advance(
        &mut self,
        simulator: &mut PhysicsSimulator,
        elapsed: Duration,
        mut update: impl FnMut(&mut PhysicsSimulator, f32),
    ) -> u32 {
        let due = self.clock.advance(elapsed);
        for _ in 0..due {
            update(simulator, self.clock.dt());
            self.interpolation.remember(simulator);
        }
        due
    }

    /// The pose at which a body is drawn now, between those of the last two updates. `None` before the first update, and for bodies
    /// that did not take part in the last one.
    pub fn pose(&self, body: BodyId) -> Option<InterpolatedPose> {
        self.interpolation.pose(body, self.clock.interpolation())
    }

    /// Marks a [teleport](BodyInterpolation::mark_teleport) of a body.
    pub fn mark_teleport(&mut self, body: BodyId) {
        self.interpolation.mark_teleport(body);
    }

    /// The clock.
    pub fn clock(&self) -> &FixedStepClock {
        &self.clock
    }

    /// The clock, to change its settings.
    pub fn clock_mut(&mut self) -> &mut FixedStepClock {
        &mut self.clock
    }

    /// Discards the time that has accumulated and all poses: after a pause, or when a snapshot is restored.
    pub fn reset(&mut self) {
        self.clock.reset();
        self.interpolation.clear();
    }
}
