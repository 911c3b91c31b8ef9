//! Placeholder for the missing body of a joint or spring that was made without one.

use crate::body::BodyId;
use crate::storage::arena::Id;
use crate::{Error, Result};

/// The id that stands for no body: no simulator has that many bodies.
pub(crate) fn missing_body_id() -> BodyId {
    BodyId::new(u32::MAX, u32::MAX)
}

/// Returns an error for a joint or spring that lacks one of its bodies. A single body is called `body` in the error,
/// two are called `body1` and `body2`.
pub(crate) fn check_bodies(argument: &'static str, body1: BodyId, body2: Option<BodyId>) -> Result<()> {
    let missing = match body2 {
        None if body1 == missing_body_id() => "body",
        Some(_) if body1 == missing_body_id() => "body1",
        Some(body2) if body2 == missing_body_id() => "body2",
        _ => return Ok(()),
    };
    Err(Error::MissingBody { argument, missing })
}
