//! Errors: reasons why a call was refused.

/// Why a call was refused. A refused call has changed no state.
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
        /// The condition that the argument must meet.
        requirement: &'static str,
    },
    /// An id names an object that was disposed. (An id is valid only in the simulator that made it and in its clones
    /// and saves; in another one it may be stale, or name another object.)
    #[error("{argument} is stale: what it named was disposed")]
    StaleId {
        /// Name of the argument.
        argument: &'static str,
    },
    /// An id names an object of another kind.
    #[error("{argument} is no {expected}")]
    WrongKind {
        /// Name of the argument.
        argument: &'static str,
        /// The expected kind.
        expected: &'static str,
    },
    /// A joint or spring that was made without its bodies has not been given all of them yet.
    #[error("{argument} has no {missing} yet: set it first")]
    MissingBody {
        /// Name of the argument.
        argument: &'static str,
        /// The body that is missing.
        missing: &'static str,
    },
    /// The broad phase can be chosen only while no geom is in the simulation.
    #[error("the geom list must be empty when the broad phase collider is set")]
    GeomListNotEmpty,
    /// The chosen [`Methods`](crate::Methods) do not support it.
    #[error("the {methods} methods have no {what}")]
    NotSupported {
        /// The feature that was asked for.
        what: &'static str,
        /// The methods that were chosen.
        methods: &'static str,
    },
    /// A callback for something else than a collision has tried to change a collision.
    #[error("there is no collision here: that can be set in `on_collision` alone")]
    NoCollision,
    /// A geom made under separating axes has no distance grid to share with a clone.
    #[error("{argument} has no distance grid to share: it was disposed, or made while SAT was selected")]
    MissingDistanceGrid {
        /// Name of the argument.
        argument: &'static str,
    },
    /// The call would cost more than the simulator's [`Limits`](crate::Limits) allow.
    #[error("{limit} would be {needed}, but at most {allowed} is allowed: see `Limits`, which can be raised")]
    LimitExceeded {
        /// Name of the limit: a field of [`Limits`](crate::Limits).
        limit: &'static str,
        /// The amount that the call needs, in the unit of the limit.
        needed: u64,
        /// The amount that the limit allows: a number in the same unit.
        allowed: u64,
    },
    /// A snapshot was made by another version of its format.
    #[error("the snapshot has version {found} of its format, but version {known} is needed")]
    UnknownSaveVersion {
        /// The version of the snapshot.
        found: u32,
        /// The version that can be read.
        known: u32,
    },
    /// A saved simulator contradicts itself.
    #[error("the saved simulator is damaged: {reason}")]
    DamagedSave {
        /// Description of the contradiction.
        reason: &'static str,
    },
}

/// Result of a call that checks its arguments.
pub type Result<T, E = Error> = std::result::Result<T, E>;

impl Error {
    /// An [`Error::InvalidArgument`].
    pub fn invalid(argument: &'static str, value: impl std::fmt::Debug, requirement: &'static str) -> Self {
        Error::InvalidArgument { argument, value: format!("{value:?}"), requirement }
    }

    /// An [`Error::LimitExceeded`] if more is needed than is allowed.
    pub(crate) fn check_limit(limit: &'static str, needed: u64, allowed: u64) -> Result<()> {
        if needed > allowed { Err(Error::LimitExceeded { limit, needed, allowed }) } else { Ok(()) }
    }
}
