//! Which pairs may collide at all (behaviour chapters 03, section 4, and 08, section 1.2).

use crate::body::Body;
use crate::body::entry::Bodies;
use crate::geom::GeomId;
use crate::geom::entry::{GeomEntry, Geoms};

/// Geoms and bodies.
#[derive(Clone, Copy)]
pub(crate) struct Filter<'a> {
    pub(crate) geoms: &'a Geoms,
    pub(crate) bodies: &'a Bodies,
}

impl Filter<'_> {
    /// The test that every method applies (behaviour chapter 08, section 1.2).
    pub(crate) fn may_collide(&self, a: &GeomEntry, b: &GeomEntry) -> bool {
        if a.body == b.body || !a.geom.may_collide_with(&b.geom) {
            return false;
        }
        let (Some(body_a), Some(body_b)) = (self.bodies.get(a.body), self.bodies.get(b.body)) else {
            return false;
        };
        body_a.body.enabled()
            && body_b.body.enabled()
            && !(body_a.body.is_immovable() && body_b.body.is_immovable())
            && !a.ignores(b.number)
            && !b.ignores(a.number)
    }
}

/// Whether an arbiter may stay (behaviour chapter 03, section 4). Collision switched off, ignored geoms and
/// the broad-phase callback matter only when a pair is created.
pub(crate) fn is_valid_pair((id_a, id_b): (GeomId, GeomId), geoms: &Geoms, bodies: &Bodies) -> bool {
    let (a, b) = (&geoms[id_a], &geoms[id_b]);
    let (Some(body_a), Some(body_b)) = (bodies.get(a.body), bodies.get(b.body)) else { return false };
    let (body_a, body_b): (&Body, &Body) = (&body_a.body, &body_b.body);
    !(geoms.is_disposed(id_a)
        || geoms.is_disposed(id_b)
        || (body_a.is_immovable() && body_b.is_immovable())
        || !body_a.enabled()
        || !body_b.enabled()
        || a.geom.shares_group_with(&b.geom)
        || !a.geom.meets_categories_of(&b.geom))
}
