//! Collision filters: which pairs may collide at all (behaviour chapters 03, section 4, and 08, section 1.2).

use serde::{Deserialize, Serialize};

use crate::body::entry::Bodies;
use crate::body::{Body, BodyId};
use crate::geom::GeomId;
use crate::geom::entry::{GeomEntry, Geoms};
use crate::methods::CollisionCategory;

/// Filter settings of a [`Geom`](crate::Geom) in one value: which others it may collide with, and whether its contacts
/// exert impulses. Engines on top use it also for objects that are not geoms of the core.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
pub struct CollisionFilter {
    /// Categories of the object, as bit flags. Default all.
    pub categories: CollisionCategory,
    /// Categories it collides with. Two objects collide if **either** one's mask contains a category of the other, or
    /// [both](Self::both_agree). Default all.
    pub collides_with: CollisionCategory,
    /// Group number: objects of the same group do not collide; 0 is no group. Default 0.
    pub group: i32,
    /// Whether it collides at all. Default true.
    pub is_enabled: bool,
    /// Whether its contacts exert impulses; they are reported either way. Default true.
    pub responds: bool,
    /// Whether **both** masks must contain a category of the other, if one of two objects has this setting. Default
    /// false: one of both masks is enough. Not serialised: a geom saves it with its other options.
    #[serde(skip)]
    pub both_agree: bool,
}

impl Default for CollisionFilter {
    fn default() -> Self {
        let all = CollisionCategory::ALL;
        CollisionFilter {
            categories: all,
            collides_with: all,
            group: 0,
            is_enabled: true,
            responds: true,
            both_agree: false,
        }
    }
}

impl CollisionFilter {
    /// Whether two objects may collide: both are enabled, they are not of one group, and their categories match.
    #[inline]
    pub fn may_meet(&self, other: &CollisionFilter) -> bool {
        self.is_enabled
            && other.is_enabled
            && !self.shares_group_with(other)
            && self.meets_categories_of(other)
    }

    #[inline]
    pub(crate) fn shares_group_with(&self, other: &CollisionFilter) -> bool {
        self.group == other.group && self.group != 0
    }

    /// Whether the categories match. Agreement in one direction is enough, as in the original, unless one of the two asks
    /// for both.
    #[inline]
    pub(crate) fn meets_categories_of(&self, other: &CollisionFilter) -> bool {
        let is_met = self.categories.intersects(other.collides_with);
        let meets = other.categories.intersects(self.collides_with);
        if self.both_agree || other.both_agree { is_met && meets } else { is_met || meets }
    }
}

/// Geoms and bodies, for the tests of pairs.
#[derive(Clone, Copy)]
pub(crate) struct Filter<'a> {
    pub(crate) geoms: &'a Geoms,
    pub(crate) bodies: &'a Bodies,
    /// Pairs of bodies that joints keep from colliding, sorted, with the smaller id first.
    pub(crate) separated_bodies: &'a [BodyPair],
}

impl Filter<'_> {
    /// Whether two geoms may form a pair: the test of every broad phase (behaviour chapter 08, section 1.2).
    pub(crate) fn may_collide(&self, a: &GeomEntry, b: &GeomEntry) -> bool {
        self.may_be_pair(a, b, |_, _| false)
    }

    /// Whether two geoms may form a pair; `meets_immovable` tells whether they may if both bodies are immovable.
    pub(super) fn may_be_pair(
        &self,
        a: &GeomEntry,
        b: &GeomEntry,
        meets_immovable: fn(&GeomEntry, &GeomEntry) -> bool,
    ) -> bool {
        if a.body == b.body || !a.geom.may_collide_with(&b.geom) {
            return false;
        }
        let (Some(body_a), Some(body_b)) = (self.bodies.get(a.body), self.bodies.get(b.body)) else {
            return false;
        };
        body_a.body.enabled()
            && body_b.body.enabled()
            && !(body_a.body.is_immovable() && body_b.body.is_immovable() && !meets_immovable(a, b))
            && !a.ignores(b.number)
            && !b.ignores(a.number)
            && !are_separated(self.separated_bodies, a.body, b.body)
    }
}

/// Two bodies that a joint keeps from colliding, the smaller id first.
pub(crate) type BodyPair = (BodyId, BodyId);

/// Whether a joint keeps two bodies from colliding; `separated` are all such pairs, sorted.
pub(crate) fn are_separated(separated: &[BodyPair], a: BodyId, b: BodyId) -> bool {
    !separated.is_empty() && separated.binary_search(&(a.min(b), a.max(b))).is_ok()
}

/// Whether an arbiter may stay (behaviour chapter 03, section 4). Collision switched off, ignored geoms and the
/// broad-phase callback matter only when a pair is created.
pub(crate) fn is_valid_pair(pair: (GeomId, GeomId), geoms: &Geoms, bodies: &Bodies) -> bool {
    may_keep_arbiter(pair, geoms, bodies, |_, _| false)
}

/// Whether an arbiter may stay; `meets_immovable` tells whether it may if both bodies are immovable.
pub(super) fn may_keep_arbiter(
    (id_a, id_b): (GeomId, GeomId),
    geoms: &Geoms,
    bodies: &Bodies,
    meets_immovable: fn(&GeomEntry, &GeomEntry) -> bool,
) -> bool {
    let (a, b) = (&geoms[id_a], &geoms[id_b]);
    let (Some(body_a), Some(body_b)) = (bodies.get(a.body), bodies.get(b.body)) else { return false };
    let (body_a, body_b): (&Body, &Body) = (&body_a.body, &body_b.body);
    let (filter_a, filter_b) = (a.geom.filter(), b.geom.filter());
    !(geoms.is_disposed(id_a)
        || geoms.is_disposed(id_b)
        || (body_a.is_immovable() && body_b.is_immovable() && !meets_immovable(a, b))
        || !body_a.enabled()
        || !body_b.enabled()
        || filter_a.shares_group_with(&filter_b)
        || !filter_a.meets_categories_of(&filter_b))
}
