//! Neighbours of a character, sorted: the order in which the core reports them differs after loading.

use farseer_core::order::{joined, sort_within};
use farseer_core::{SpacePartner, SpaceTouch};

use super::character_footprint::CharacterFootprint;
use crate::depth::Footing;
use crate::shapes::WalkableTop;
use crate::{BodyId, ContactTarget, GeomId, TwoHalfPhysicsSimulator};

/// Neighbours of the character that moves next; reused buffers.
#[derive(Debug, Clone, Default)]
pub(crate) struct Neighbours {
    geoms: Vec<GeomId>,
    /// Walkable edges of the prisms among them.
    pub(super) tops: Vec<WalkableTop>,
    /// Contacts of the body, including speculative ones.
    pub(super) touches: Vec<SpaceTouch>,
    /// Targets that the event handler has refused.
    pub(super) refused: Vec<ContactTarget>,
    /// Supports of this step, about which the handler is asked.
    pub(super) held_by: Vec<Footing>,
    places: Vec<(u128, u32)>,
}

impl TwoHalfPhysicsSimulator {
    /// Collects the geoms near a body and those around its footprint between two heights, px, Y up. Walkable
    /// edges are collected within the depth range of `around`.
    pub(super) fn gather_near(
        &self,
        (body, geom): (BodyId, GeomId),
        around: &CharacterFootprint,
        [low, high]: [f32; 2],
        near: &mut Neighbours,
    ) {
        let Neighbours { geoms, tops, touches, refused, held_by, places } = near;
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
