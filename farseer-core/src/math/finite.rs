//! Checks of arguments: finite numbers, and numbers greater than zero.

use super::Vector2;
use crate::error::{Error, Result};

/// Refuses NaN and infinities.
pub(crate) fn finite(argument: &'static str, value: f32) -> Result<f32> {
    if value.is_finite() { Ok(value) } else { Err(Error::invalid(argument, value, "finite")) }
}

/// Refuses vectors with a component that is NaN or infinite.
pub(crate) fn finite_vector(argument: &'static str, value: Vector2) -> Result<Vector2> {
    if value.x.is_finite() && value.y.is_finite() {
        Ok(value)
    } else {
        Err(Error::invalid(argument, (value.x, value.y), "finite"))
    }
}

/// Refuses points with a component that is NaN or infinite.
pub(crate) fn finite_vertices(argument: &'static str, vertices: &[Vector2]) -> Result<()> {
    match vertices.iter().find(|v| !(v.x.is_finite() && v.y.is_finite())) {
        Some(v) => Err(Error::invalid(argument, (v.x, v.y), "a list of finite vertices")),
        None => Ok(()),
    }
}

/// Refuses a number that is not finite or less than zero.
pub(crate) fn zero_or_more(argument: &'static str, value: f32) -> Result<f32> {
    if value.is_finite() && value >= 0.0 {
        Ok(value)
    } else {
        Err(Error::invalid(argument, value, "finite and 0 or more"))
    }
}

/// Refuses a number that is not finite or not greater than zero.
pub(crate) fn positive(argument: &'static str, value: f32) -> Result<f32> {
    if value.is_finite() && value > 0.0 {
        Ok(value)
    } else {
        Err(Error::invalid(argument, value, "finite and greater than 0"))
    }
}
