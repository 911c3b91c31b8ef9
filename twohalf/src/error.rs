//! Errors of calls.

/// Reason why a call was refused. A refused call changes nothing.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum Error {
    /// Refused by the core, or for a reason that it has as well: an argument out of range, a stale id, a
    /// damaged save.
    #[error(transparent)]
    Core(#[from] farseer_core::Error),
    /// The object geom of a body's ground must be one of the body's own geoms.
    #[error("{argument} belongs to another body")]
    GeomOfAnotherBody {
        /// Name of the argument.
        argument: &'static str,
    },
}

/// Result of a call that checks its arguments.
pub type Result<T, E = Error> = std::result::Result<T, E>;

/// Error for an argument out of range.
pub(crate) fn invalid(
    argument: &'static str,
    value: impl std::fmt::Debug,
    requirement: &'static str,
) -> Error {
    farseer_core::Error::invalid(argument, value, requirement).into()
}

/// Error for a feature that only [`DepthScheme::Precise`](crate::DepthScheme::Precise) has.
pub(crate) fn only_precise(what: &'static str) -> Error {
    farseer_core::Error::NotSupported { what, methods: "faithful and thesis" }.into()
}

/// Error for an id of a disposed object.
pub(crate) fn stale(argument: &'static str) -> Error {
    farseer_core::Error::StaleId { argument }.into()
}

/// Error for a save that contradicts itself.
pub(crate) fn damaged(reason: &'static str) -> Error {
    farseer_core::Error::DamagedSave { reason }.into()
}
