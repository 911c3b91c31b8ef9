//! The ids of bodies and geoms, which name each other.

use super::arena::define_id;

define_id! {
    /// Names a [`Body`](crate::Body) of a simulator: the one that made it, its clones and what is loaded from its saves.
    BodyId
}

define_id! {
    /// Names a geom of a simulator: the one that made it, its clones and what is loaded from its saves.
    GeomId
}
