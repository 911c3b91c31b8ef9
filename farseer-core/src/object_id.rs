//! Ids of all objects that can be added to a simulator.

use serde::{Deserialize, Serialize};

use crate::body::BodyId;
use crate::controllers::ControllerId;
use crate::geom::GeomId;
use crate::joints::JointId;
use crate::springs::SpringId;

/// Id of an object that can be added to a simulator.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize, Deserialize)]
#[non_exhaustive]
pub enum ObjectId {
    /// A body.
    Body(BodyId),
    /// A geom.
    Geom(GeomId),
    /// A controller.
    Controller(ControllerId),
    /// A joint.
    Joint(JointId),
    /// A spring.
    Spring(SpringId),
}

macro_rules! from_ids {
    ($($variant:ident($id:ty);)*) => {$(
        impl From<$id> for ObjectId {
            fn from(id: $id) -> Self {
                ObjectId::$variant(id)
            }
        }
    )*};
}

from_ids! {
    Body(BodyId);
    Geom(GeomId);
    Controller(ControllerId);
    Joint(JointId);
    Spring(SpringId);
}
