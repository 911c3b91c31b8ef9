//! Values of the caller: finite numbers, flags, values of enums.

use farseer_core::math::Vector2;

use crate::failure::{Failure, Outcome};

/// A point, vector, velocity or force in the plane: x right, y down.
#[repr(C)]
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct FarseerVector2 {
    /// Component to the right, in the unit of the quantity: length units for a point.
    pub x: f32,
    /// Component down, in the unit of the quantity: length units for a point.
    pub y: f32,
}

impl From<Vector2> for FarseerVector2 {
    fn from(vector: Vector2) -> Self {
        FarseerVector2 { x: vector.x, y: vector.y }
    }
}

/// A value of the caller that has to be finite.
pub(crate) trait Finite {
    /// The value in the engine's type.
    type Checked;

    /// Refuses NaN and infinity, with the name of the argument.
    fn finite(self, argument: &str) -> Outcome<Self::Checked>;
}

impl Finite for f32 {
    type Checked = f32;

    fn finite(self, argument: &str) -> Outcome<f32> {
        if self.is_finite() { Ok(self) } else { Err(Failure::invalid(argument, self, "finite")) }
    }
}

impl Finite for FarseerVector2 {
    type Checked = Vector2;

    fn finite(self, argument: &str) -> Outcome<Vector2> {
        if self.x.is_finite() && self.y.is_finite() {
            return Ok(Vector2::new(self.x, self.y));
        }
        Err(Failure::invalid(argument, format_args!("({}, {})", self.x, self.y), "finite"))
    }
}

/// Reads a flag: a number, since other bytes than 0 and 1 would be no `bool` of Rust.
pub(crate) fn flag(argument: &str, value: i32) -> Outcome<bool> {
    match value {
        0 => Ok(false),
        1 => Ok(true),
        _ => Err(Failure::invalid(argument, value, "0 or 1")),
    }
}

/// Reads a value of an enum that counts from 0: that of `choices` at this place.
pub(crate) fn choose<T: Copy>(argument: &str, value: i32, choices: &[T]) -> Outcome<T> {
    let choice = usize::try_from(value).ok().and_then(|place| choices.get(place));
    let most = choices.len() - 1;
    choice.copied().ok_or_else(|| Failure::invalid(argument, value, &format!("from 0 to {most}")))
}
