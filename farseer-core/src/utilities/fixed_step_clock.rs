//! Updates of a fixed length for frames of any length.

use std::time::Duration;

use crate::{Error, Result};

/// Computes the number of updates of a fixed length that are due, as XNA's game loop does.
///
/// It reads no clock itself: in every frame it gets the time since the last one, and the same times give the same
/// updates. Times are whole nanoseconds, so that no time is lost however long a game runs.
///
/// ```
/// use farseer_core::{FixedStepClock, PhysicsSimulator};
/// use std::time::Duration;
///
/// let mut simulator = PhysicsSimulator::default();
/// let mut clock = FixedStepClock::new(Duration::from_millis(16))?;
/// // Once per frame:
/// for _ in 0..clock.advance(Duration::from_millis(40)) {
///     simulator.update(clock.milliseconds_dt());
/// }
/// // Two updates are done, and half of the next one has passed.
/// assert_eq!(clock.interpolation(), 0.5);
/// # Ok::<(), farseer_core::Error>(())
/// ```
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct FixedStepClock {
    target: Duration,
    max_updates: u32,
    waiting: Duration,
    is_running_slowly: bool,
}

impl Default for FixedStepClock {
    /// 60 updates per second, XNA's default: 16.6667 ms, in its units of 100 ns.
    fn default() -> Self {
        FixedStepClock {
            target: Duration::from_nanos(16_666_700),
            max_updates: 5,
            waiting: Duration::ZERO,
            is_running_slowly: false,
        }
    }
}

impl FixedStepClock {
    /// A clock for updates of this length.
    ///
    /// # Errors
    /// A length of zero.
    pub fn new(target_elapsed_time: Duration) -> Result<Self> {
        let mut clock = FixedStepClock::default();
        clock.set_target_elapsed_time(target_elapsed_time)?;
        Ok(clock)
    }

    /// Length of an update.
    #[doc(alias = "TargetElapsedTime")]
    pub fn target_elapsed_time(&self) -> Duration {
        self.target
    }

    /// Sets the length of an update.
    ///
    /// # Errors
    /// A length of zero.
    pub fn set_target_elapsed_time(&mut self, target_elapsed_time: Duration) -> Result<()> {
        if target_elapsed_time.is_zero() {
            return Err(Error::invalid("target_elapsed_time", target_elapsed_time, "greater than 0"));
        }
        self.target = target_elapsed_time;
        Ok(())
    }

    /// Maximum number of updates in one frame. Default 5, which is the choice of this crate, not XNA's.
    pub fn max_updates(&self) -> u32 {
        self.max_updates
    }

    /// Sets the maximum number of updates in one frame.
    ///
    /// # Errors
    /// Zero: no update would ever be due.
    pub fn set_max_updates(&mut self, max_updates: u32) -> Result<()> {
        if max_updates == 0 {
            return Err(Error::invalid("max_updates", max_updates, "greater than 0"));
        }
        self.max_updates = max_updates;
        Ok(())
    }

    /// Adds the time since the last frame, and returns the number of updates that are due now.
    ///
    /// Updates beyond [`max_updates`](Self::max_updates) are lost: the game then runs slower, instead of falling behind
    /// more and more.
    pub fn advance(&mut self, elapsed: Duration) -> u32 {
        let total = self.waiting.saturating_add(elapsed).as_nanos();
        let target = self.target.as_nanos();
        let due = total / target;
        // Less than the target, which is a duration.
        let left = total % target;
        let second = Duration::from_secs(1).as_nanos();
        self.waiting = Duration::new((left / second) as u64, (left % second) as u32);
        self.is_running_slowly = due > 1;
        due.min(u128::from(self.max_updates)) as u32
    }

    /// Whether more than one update was due in the last frame. One such frame is enough, so it is always true with 30
    /// pictures and 60 updates per second.
    #[doc(alias = "IsRunningSlowly")]
    pub fn is_running_slowly(&self) -> bool {
        self.is_running_slowly
    }

    /// Fraction of the next update's time that has passed already, from 0 to 1, for
    /// [`BodyInterpolation::pose`](crate::BodyInterpolation::pose).
    pub fn interpolation(&self) -> f32 {
        (self.waiting.as_secs_f64() / self.target.as_secs_f64()) as f32
    }

    /// Length of an update in seconds.
    pub fn dt(&self) -> f32 {
        self.target.as_secs_f32()
    }

    /// Length of an update, in seconds, as most games of the XNA years computed it: its whole milliseconds times 0.001.
    /// For 60 updates per second that is 0.016, and the simulation runs 4 % slower than the clock.
    ///
    /// For updates of 1 ms up to 1 s. Below 1 ms it is 0, which every update refuses: use [`dt`](Self::dt). From 1 s on
    /// the original's `Milliseconds` is only the fraction of a second; this is the whole length.
    #[doc(alias("ElapsedGameTime.Milliseconds", "dt"))]
    pub fn milliseconds_dt(&self) -> f32 {
        Self::dt_of_milliseconds(u32::try_from(self.target.as_millis()).unwrap_or(u32::MAX))
    }

    /// Whole milliseconds in seconds, as XNA games computed it. Not always the nearest float: 10 ms are 0.010000001.
    pub fn dt_of_milliseconds(milliseconds: u32) -> f32 {
        milliseconds as f32 * 0.001
    }

    /// Discards the accumulated time; for games that return from a pause or a loading screen.
    #[doc(alias = "ResetElapsedTime")]
    pub fn reset(&mut self) {
        self.waiting = Duration::ZERO;
        self.is_running_slowly = false;
    }
}
