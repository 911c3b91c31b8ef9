//! Force and torque of a joint in a step of the precise set, and its breaking by them.

use super::Joint;
use crate::math::Vector2;
use crate::math::scalar::nearest_finite;
use crate::math::vector2::length;

/// Greatest component of a force, in mass units · length units/s², whose size is certainly a finite `f32`: below half the
/// square root of [`f32::MAX`].
const MAX_SQUARABLE: f64 = 9e18;

impl Joint {
    /// Force and torque at the end of the last update.
    pub(crate) fn force_and_torque(&self) -> [f64; 3] {
        self.force
    }

    /// Stores force and torque at the end of an update. If their mean over the update exceeds a maximum the joint is
    /// disabled, and the result is true.
    ///
    /// `servo` is the mean force and torque of the joint's servo, which `force` does not contain.
    #[inline]
    pub(crate) fn store_load(
        &mut self,
        force: &mut [f64; 3],
        mean: Option<[f64; 3]>,
        (along_depth, servo): (&mut f32, [f64; 3]),
    ) -> bool {
        if mean.is_none() && *along_depth == 0.0 && servo == [0.0; 3] && self.cannot_break_under(*force) {
            (self.force, self.servo_force, self.force_along_depth) = (*force, [0.0; 3], *along_depth);
            return false;
        }
        self.servo_force = servo.map(|number| nearest_finite(number as f32));
        let finite = |number: f64| if number.abs() <= f64::from(f32::MAX) { number } else { 0.0 };
        let stored = force.map(finite);
        let mean = mean.map_or(stored, |mean| mean.map(finite));
        let [x, y, torque] = std::array::from_fn(|axis| mean[axis] as f32 + self.servo_force[axis]);
        let along = if along_depth.abs() <= f32::MAX { *along_depth } else { 0.0 };
        let in_plane = length(Vector2::new(x, y));
        let size = if along == 0.0 { in_plane } else { length(Vector2::new(in_plane, along)) };
        let breaks = self.enabled && self.is_overloaded([size, torque]);
        if breaks {
            self.enabled = false;
        }
        let stored = if breaks { mean } else { stored };
        (self.force, self.force_along_depth) = (stored, along);
        (*force, *along_depth) = (stored, along);
        breaks
    }

    /// Whether the joint has no maxima, and the size of a force in the plane is finite: neither a square nor a sum overflows.
    #[inline]
    fn cannot_break_under(&self, force: [f64; 3]) -> bool {
        self.greatest_force == f32::MAX
            && self.greatest_torque == f32::MAX
            && force.iter().all(|number| number.abs() <= MAX_SQUARABLE)
    }

    /// Whether force or torque exceeds the joint's maximum.
    fn is_overloaded(&self, [force, torque]: [f32; 2]) -> bool {
        !(force <= self.greatest_force && torque.abs() <= self.greatest_torque)
    }

    /// Whether force and torque of the last update are within the joint's maxima.
    pub(crate) fn is_within_load_limits(&self) -> bool {
        let [x, y, torque] = std::array::from_fn(|axis| self.force[axis] as f32 + self.servo_force[axis]);
        let force = length(Vector2::new(length(Vector2::new(x, y)), self.force_along_depth));
        !self.is_overloaded([force, torque])
    }
}
