//! A time step that grows when the machine is slow (behaviour chapter 12, section 9).

use serde::{Deserialize, Serialize};

use crate::error::Result;
use crate::math::finite::finite;

/// Computes the length of the next step. It changes no state of the simulator: the game calls
/// [`get_update_interval`](Self::get_update_interval) once per frame and steps the simulator by the result, unless it
/// is 0.
///
/// The interval is the preferred one plus a penalty. A scaling controller that is added to a simulator raises the
/// penalty after updates that took longer than the interval and lowers it after others. The real time comes from
/// [`update_with_real_time`](crate::PhysicsSimulator::update_with_real_time). It then accumulates time itself: if the
/// game calls the same controller too, time counts twice, as in the original.
///
/// ```
/// use farseer_core::ScalingController;
/// let mut scaling = ScalingController::new(0.02, 0.05)?;
/// assert_eq!(scaling.get_update_interval(0.015), 0.0);
/// assert_eq!(scaling.get_update_interval(0.015), 0.03);
/// # Ok::<(), farseer_core::Error>(())
/// ```
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct ScalingController {
    is_enabled: bool,
    preferred: f32,
    maximum: f32,
    penalty: f32,
    elapsed: f32,
}

impl ScalingController {
    /// A preferred interval and a maximum, in seconds. With a preferred interval of 0 or less it does not accumulate
    /// time. Like the original it does not check that the maximum is greater.
    ///
    /// # Errors
    /// A value that is not finite.
    #[doc(alias = "ScalingController(float, float)")]
    pub fn new(preferred_update_interval: f32, maximum_update_interval: f32) -> Result<Self> {
        Ok(ScalingController {
            is_enabled: true,
            preferred: finite("preferred_update_interval", preferred_update_interval)?,
            maximum: finite("maximum_update_interval", maximum_update_interval)?,
            penalty: 0.0,
            elapsed: 0.0,
        })
    }

    /// Whether time is accumulated. Default true. The same as [`Controller::enabled`](super::Controller::enabled).
    #[doc(alias = "Enabled")]
    pub fn enabled(&self) -> bool {
        self.is_enabled
    }

    /// Sets whether time is accumulated or returned unchanged.
    pub fn set_enabled(&mut self, enabled: bool) {
        self.is_enabled = enabled;
    }

    /// The interval in seconds: the preferred one plus the penalty.
    #[doc(alias = "UpdateInterval")]
    pub fn update_interval(&self) -> f32 {
        self.preferred + self.penalty
    }

    /// Sets the preferred interval in seconds, and the maximum if it is smaller than the new value. The penalty stays,
    /// so that [`update_interval`](Self::update_interval) may return more.
    ///
    /// # Errors
    /// A value that is not finite.
    pub fn set_update_interval(&mut self, value: f32) -> Result<()> {
        self.preferred = finite("update_interval", value)?;
        if self.preferred > self.maximum {
            self.maximum = self.preferred;
        }
        Ok(())
    }

    /// Maximum of the penalty, in seconds. It does **not** limit the interval, which may exceed it by the preferred
    /// interval, as in the original.
    #[doc(alias = "MaximumUpdateInterval")]
    pub fn maximum_update_interval(&self) -> f32 {
        self.maximum
    }

    /// Sets the maximum in seconds. A value that is not greater than the preferred interval is silently ignored, as in
    /// the original.
    ///
    /// # Errors
    /// A value that is not finite.
    pub fn set_maximum_update_interval(&mut self, value: f32) -> Result<()> {
        let value = finite("maximum_update_interval", value)?;
        if value > self.preferred {
            self.maximum = value;
        }
        Ok(())
    }

    /// Accumulates `dt` seconds and returns the length of the step to make now, in seconds: 0 until an interval is
    /// full, then the accumulated time. While [disabled](Self::enabled) it returns `dt`.
    ///
    /// If `dt` is not finite it changes no state and returns 0.
    #[doc(alias = "GetUpdateInterval")]
    pub fn get_update_interval(&mut self, dt: f32) -> f32 {
        let elapsed = self.elapsed + dt;
        if !dt.is_finite() || !elapsed.is_finite() {
            return 0.0;
        }
        if !(self.preferred > 0.0 && self.is_enabled) {
            return dt;
        }
        self.elapsed = elapsed;
        if elapsed < self.update_interval() {
            return 0.0;
        }
        std::mem::replace(&mut self.elapsed, 0.0)
    }

    /// Raises the penalty by a quarter of the preferred interval, unless it would exceed the maximum.
    #[doc(alias = "IncreaseUpdateInterval")]
    pub fn increase_update_interval(&mut self) {
        let penalty = self.penalty + self.preferred / 4.0;
        if penalty <= self.maximum && penalty.is_finite() {
            self.penalty = penalty;
        }
    }

    /// Lowers the penalty by an eighth of the preferred interval, but not below 0.
    #[doc(alias = "DecreaseUpdateInterval")]
    pub fn decrease_update_interval(&mut self) {
        let penalty = self.penalty - self.preferred / 8.0;
        if penalty < 0.0 {
            self.penalty = 0.0;
        } else if penalty.is_finite() {
            self.penalty = penalty;
        }
    }

    /// Accumulates `dt` seconds. When an interval is full, the penalty is raised if `dt_real` is longer than the
    /// interval, and lowered if not. The simulator does this in its updates.
    #[doc(alias = "Update")]
    pub fn update(&mut self, dt: f32, dt_real: f32) {
        if self.get_update_interval(dt) == 0.0 {
            return;
        }
        if self.update_interval() < dt_real {
            self.increase_update_interval();
        } else {
            self.decrease_update_interval();
        }
    }

    pub(super) fn is_valid(&self) -> bool {
        [self.preferred, self.maximum, self.penalty, self.elapsed].iter().all(|number| number.is_finite())
    }
}
