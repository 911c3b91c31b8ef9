//! The ids of bodies and geoms, which refer to each other.

use super::arena::define_id;

define_id! {
    /// Id of a [`Body`](crate::Body), valid in the simulator that made it, in its clones and in simulators loaded from
    /// its saves.
    BodyId
}

define_id! {
    /// Id of a geom, valid in the simulator that made it, in its clones and in simulators loaded from its saves.
    GeomId
}
