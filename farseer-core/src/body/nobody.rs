//! The body of a joint or spring that was made without one.

use crate::body::BodyId;
use crate::storage::arena::Id;
use crate::{Error, Result};

/// An id that never names anything: no simulator has that many bodies.
pub(crate) fn nobody() -> BodyId {
    BodyId::new(u32::MAX, u32::MAX)
}

/// Refuses a joint or spring that was not given all of its bodies. One body has the name `body`, two have numbers.
pub(crate) fn check_bodies(argument: &'static str, body1: BodyId, body2: Option<BodyId>) -> Result<()> {
    let missing = match body2 {
        None if body1 == nobody() => "body",
        Some(_) if body1 == nobody() => "body1",
        Some(body2) if body2 == nobody() => "body2",
        _ => return Ok(()),
    };
    Err(Error::MissingBody { argument, missing })
}
