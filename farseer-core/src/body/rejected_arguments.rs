//! Setter arguments of bodies that were rejected because they are not finite.

use super::Body;
use crate::math::Vector2;
use crate::storage::rejected_arguments::ArgumentNames;

/// The names of the arguments that setters of bodies reject.
#[derive(Debug)]
pub(crate) struct BodyArguments;

impl ArgumentNames for BodyArguments {
    const NAMES: &'static [&'static str] = &[
        "position",
        "rotation",
        "linear_velocity",
        "angular_velocity",
        "linear_drag_coefficient",
        "quadratic_drag_coefficient",
        "rotational_drag_coefficient",
        "idle_time",
        "minimum_velocity",
        "gravity_scale",
        "amount",
        "point",
        "torque",
    ];
}

impl Body {
    /// Records the argument if the value is not finite, and returns whether the value may be used.
    #[inline]
    pub(super) fn accepts(&mut self, argument: &'static str, value: f32) -> bool {
        let accepted = value.is_finite();
        if !accepted {
            self.rejected.note(argument);
        }
        accepted
    }

    #[inline]
    pub(super) fn accepts_vector(&mut self, argument: &'static str, value: Vector2) -> bool {
        let accepted = value.x.is_finite() && value.y.is_finite();
        if !accepted {
            self.rejected.note(argument);
        }
        accepted
    }
}
