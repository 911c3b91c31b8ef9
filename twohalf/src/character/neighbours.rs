//! Neighbours of a character, sorted: the order in which the core reports them differs after loading.

use farseer_core::depth::{DepthAxis, DepthContact, DepthContactTarget};
use farseer_precise::storage::order::{packed_key, sort_by_number_in};

use super::character_footprint::CharacterFootprint;
use crate::depth::Footing;
use crate::shapes::WalkableTop;
use crate::{BodyId, ContactTarget, GeomId, TwoHalfPhysicsSimulator};

/// Neighbours of the character that moves next; reused buffers.
#[derive(Debug, Clone, Default)]
pub(crate) struct Neighbours {
    geoms: Vec<GeomId>,
    /// Walkable edges of the neighbours that are prisms.
    pub(super) tops: Vec<WalkableTop>,
    /// Contacts of the character's body, including speculative ones.
    pub(super) touches: Vec<DepthContact>,
    /// Targets that the event handler has refused to the character.
    pub(super) refused: Vec<ContactTarget>,
    /// Supports of the character in this step, about which the next update asks the event handler.
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
        let core = DepthAxis::of(&self.core);
        let Neighbours { geoms, tops, touches, refused, held_by, places } = near;
        held_by.clear();
        refused.clear();
        refused.extend(core.vetoed_contacts_of(body).map(|(_, partner)| crate::views::partner_of(partner)));
        refused.extend(self.world.footings.refused_to(geom));
        geoms.clear();
        geoms.extend(core.neighbours_of(body));
        let region = [[around.left, -high, around.front], [around.right, -low, around.back]];
        core.for_each_geom_in(region, body, |geom| {
            if self.core.geom(geom).is_some_and(|geom| geom.collision_response_enabled()) {
                geoms.push(geom);
            }
        });
        sort_by_number_in(places, geoms, |geom| geom.slot() as u128);
        geoms.dedup();
        self.gather_tops(geoms, around, tops);
        touches.clear();
        touches.extend(core.contacts_of(body));
        sort_by_number_in(places, touches, |touch| packed_key(touch.pieces));
        sort_by_number_in(places, touches, |touch| {
            let (kind, partner) = match touch.target {
                DepthContactTarget::Geom(geom) => (0, geom.slot() as u32),
                DepthContactTarget::WorldBox(name) => (1, name),
                DepthContactTarget::Ground => (2, 0),
            };
            packed_key([touch.this.slot() as u32, kind, partner])
        });
    }
}
