//! What can be wrong with an argument.

use crate::math::Vector2;

/// Why a call was refused. A refused call has changed nothing.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum Error {
    /// An argument has a value that cannot be accepted.
    #[error("{argument} is {value}, but must be {requirement}")]
    InvalidArgument {
        /// Name of the argument, as in the function's signature.
        argument: &'static str,
        /// The value that was given.
        value: String,
        /// What would have been accepted.
        requirement: &'static str,
    },
}

/// Result of a call that checks its arguments.
pub type Result<T, E = Error> = std::result::Result<T, E>;

impl Error {
    /// An [`Error::InvalidArgument`].
    pub fn invalid(argument: &'static str, value: impl std::fmt::Debug, requirement: &'static str) -> Self {
        Error::InvalidArgument { argument, value: format!("{value:?}"), requirement }
    }
}

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

/// Refuses what is not finite or not greater than zero.
pub(crate) fn positive(argument: &'static str, value: f32) -> Result<f32> {
    if value.is_finite() && value > 0.0 {
        Ok(value)
    } else {
        Err(Error::invalid(argument, value, "finite and greater than 0"))
    }
}
