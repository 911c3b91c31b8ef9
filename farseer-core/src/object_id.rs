//! Ids of everything that can be added.

use serde::{Deserialize, Serialize};

use crate::body::BodyId;
use crate::geom::GeomId;

/// Names anything that can be added to a simulator.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize, Deserialize)]
#[non_exhaustive]
pub enum ObjectId {
    /// A body.
    Body(BodyId),
    /// A geom.
    Geom(GeomId),
}

impl From<BodyId> for ObjectId {
    fn from(body: BodyId) -> Self {
        ObjectId::Body(body)
    }
}

impl From<GeomId> for ObjectId {
    fn from(geom: GeomId) -> Self {
        ObjectId::Geom(geom)
    }
}
