//! What is near a figure, in an order that does not depend on how it came there: the engine below tells of it in another one after
//! loading.

use farseer_core::order::{joined, sort_within};
use farseer_core::{SpacePartner, SpaceTouch};

use super::feet::Feet;
use crate::depth::Footing;
use crate::shapes::Top;
use crate::{BodyId, GeomId, Partner, TwoHalfPhysicsSimulator};

/// What is near the figure that is about to walk: room that is kept.
#[derive(Debug, Clone, Default)]
pub(crate) struct Near {
    geoms: Vec<GeomId>,
    /// Of the prisms among them.
    pub(super) tops: Vec<Top>,
    /// What touches it, or is about to.
    pub(super) touches: Vec<SpaceTouch>,
    /// Partners that a handler has refused.
    pub(super) refused: Vec<Partner>,
    /// Supports of this step, to be asked about.
    pub(super) held_by: Vec<Footing>,
    places: Vec<(u128, u32)>,
}

impl TwoHalfPhysicsSimulator {
    /// Geoms near a body, and those around its feet between two heights, Y up in px; of tops those within the depths of
    /// `around`.
    pub(super) fn gather_near(
        &self,
        (body, geom): (BodyId, GeomId),
        around: &Feet,
        [low, high]: [f32; 2],
        near: &mut Near,
    ) {
        let Near { geoms, tops, touches, refused, held_by, places } = near;
        held_by.clear();
        refused.clear();
        refused
            .extend(self.core.space_refused_of(body).map(|(_, partner)| crate::views::partner_of(partner)));
        refused.extend(self.world.footings.refused_to(geom));
        geoms.clear();
        geoms.extend(self.core.space_neighbours_of(body));
        let region = [[around.left, -high, around.front], [around.right, -low, around.back]];
        self.core.for_each_space_geom_in(region, body, |geom| {
            if self.core.geom(geom).is_some_and(|geom| geom.collision_response_enabled()) {
                geoms.push(geom);
            }
        });
        sort_within(places, geoms, |geom| geom.slot() as u128);
        geoms.dedup();
        self.gather_tops(geoms, around, tops);
        touches.clear();
        touches.extend(self.core.space_touches_of(body));
        sort_within(places, touches, |touch| joined(touch.pieces));
        sort_within(places, touches, |touch| {
            let (kind, partner) = match touch.partner {
                SpacePartner::Geom(geom) => (0, geom.slot() as u32),
                SpacePartner::Fixture(name) => (1, name),
                SpacePartner::Ground => (2, 0),
            };
            joined([touch.this.slot() as u32, kind, partner])
        });
    }
}
