//! What is near a figure, in an order that does not depend on how it came there: the engine below tells of it in another one after
//! loading.

use farseer_core::SpaceTouch;

use super::feet::Feet;
use crate::shapes::Top;
use crate::{BodyId, GeomId, TwoHalfPhysicsSimulator};

/// What is near the figure that is about to walk: room that is kept.
#[derive(Debug, Clone, Default)]
pub(crate) struct Near {
    geoms: Vec<GeomId>,
    /// Of the prisms among them.
    pub(super) tops: Vec<Top>,
    /// What touches it, or is about to.
    pub(super) touches: Vec<SpaceTouch>,
}

impl TwoHalfPhysicsSimulator {
    /// What is near a body; of tops those within some depths.
    pub(super) fn gather_near(&self, body: BodyId, around: &Feet, near: &mut Near) {
        let Near { geoms, tops, touches } = near;
        geoms.clear();
        geoms.extend(self.core.space_neighbours_of(body));
        geoms.sort_unstable();
        geoms.dedup();
        self.gather_tops(geoms, around, tops);
        touches.clear();
        touches.extend(self.core.space_touches_of(body));
        touches.sort_unstable_by_key(|touch| (touch.this, touch.partner, touch.pieces));
    }
}
