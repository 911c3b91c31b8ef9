//! Errors of calls.

/// Reason why a call was refused. A refused call changes nothing.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum Error {
    /// The core refused the call, or `twohalf` for a reason that the core has as well: an argument out of range, a stale id, a
    /// damaged save.
    #[error(transparent)]
    Core(#[from] farseer_core::Error),
    /// The object geom of a body's ground must be one of the body's own geoms.
    #[error("{argument} belongs to another body")]
    GeomOfAnotherBody {
        /// Name of the refused argument.
        argument: &'static str,
    },
}

/// Result of a call that checks its arguments.
pub type Result<T, E = Error> = std::result::Result<T, E>;

/// Returns the error for an argument out of range, with its name, its value and the requirement that it fails.
pub(crate) fn invalid(
    argument: &'static str,
    value: impl std::fmt::Debug,
    requirement: &'static str,
) -> Error {
    farseer_core::Error::invalid(argument, value, requirement).into()
}

/// Returns the error for a feature, named by `what`, that only [`DepthScheme::Precise`](crate::DepthScheme::Precise) has.
pub(crate) fn only_precise(what: &'static str) -> Error {
    farseer_core::Error::NotSupported { what, methods: "faithful and thesis" }.into()
}

/// Returns the error for an argument that is the id of a disposed object.
pub(crate) fn stale(argument: &'static str) -> Error {
    farseer_core::Error::StaleId { argument }.into()
}

/// Returns the error for a save that contradicts itself, with the reason.
pub(crate) fn damaged(reason: &'static str) -> Error {
    farseer_core::Error::DamagedSave { reason }.into()
}
