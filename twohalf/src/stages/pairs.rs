//! Pair filter: decides which pairs touch along which axis. The broad phase of the core calls it.
//!
//! The core finds pairs whose AABBs overlap in X and Y. Each pair is rejected, left to the core, or adopted by `twohalf`.
//! Adopted are pairs with a ball, and outlines that touch along Z.

use farseer_core::math::scalar::nearest_finite;
use farseer_core::{ArbiterRef, GeomId, PhysicsSimulator};
use farseer_precise::storage::order::{packed_key, sort_numbered};

use super::convex_cache::ConvexCache;
use super::depth_intervals::{DepthInterval, DepthIntervals};
use crate::depth::{ContactKey, DepthScheme, PersistedFeature, World};
use crate::shapes::{EntryAxis, MAX_ENTRY_AGE, RESTING_SLOP_FACTOR, entry_of_pieces, is_depth_last};

/// A pair of geoms whose contact `twohalf` finds, and not the core; the older geom is the first.
#[derive(Debug, Clone, Copy)]
pub(super) struct DepthPair {
    pub(super) key: ContactKey,
    pub(super) geom_a: GeomId,
    pub(super) geom_b: GeomId,
}

/// Pairs that touched in the core in the last update, with the bits of their normal impulse (f32, mass · px/s).
#[derive(Debug, Clone, Default)]
pub(super) struct PairCache {
    sorted: Vec<(u128, u32)>,
}

impl PairCache {
    pub(super) fn prepare(&mut self, core: &PhysicsSimulator) {
        self.sorted.clear();
        for arbiter in core.arbiters() {
            let (Some(a), Some(b)) = (core.geom(arbiter.geom_a()), core.geom(arbiter.geom_b())) else {
                continue;
            };
            let impulse = impulse_of(arbiter);
            self.sorted.push((packed_key([a.id(), b.id()]), impulse.to_bits()));
        }
        sort_numbered(&mut self.sorted);
    }

    /// Returns whether two geoms touched in the core in the last update.
    pub(super) fn touched_in_core(&self, core: &PhysicsSimulator, this: GeomId, other: GeomId) -> bool {
        key_of(core, this, other).is_some_and(|pair| self.impulse(pair.key).is_some())
    }

    /// Returns the normal impulse of a pair in the last update, mass · px/s; `None` if the pair did not touch in the core.
    pub(super) fn impulse(&self, key: ContactKey) -> Option<f32> {
        let ContactKey::Pair(a, b) = key else { return None };
        let index = self.sorted.binary_search_by_key(&packed_key([a, b]), |(numbers, _)| *numbers).ok()?;
        Some(f32::from_bits(self.sorted[index].1))
    }
}

/// Normal impulse of two geoms that touch in the core, mass · px/s.
pub(super) fn impulse_of(arbiter: ArbiterRef<'_>) -> f32 {
    nearest_finite(arbiter.contacts().map(|contact| contact.normal_impulse()).sum())
}

/// Engine that finds and solves the contact of a pair whose AABBs overlap in all three axes.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum ContactOwner {
    /// The core finds and solves the contact, in X and Y.
    Plane,
    /// `twohalf` finds and solves the contact, in three axes.
    Space,
}

/// Returns whether two intervals along Z overlap. Intervals that only touch do not overlap. Intervals with equal middles always
/// overlap, even those of length 0.
pub(super) fn extents_overlap(a: DepthInterval, b: DepthInterval) -> bool {
    a.z == b.z || (f64::from(a.z) - f64::from(b.z)).abs() < f64::from(a.half) + f64::from(b.half)
}

/// Returns the side of `a` along Z on which `b` was before the last step: 1 behind, -1 in front; dimensionless.
pub(super) fn side_of(a: DepthInterval, b: DepthInterval) -> f32 {
    let motion = b.motion_z - a.motion_z;
    let before = b.z - a.z - motion;
    let is_behind = before > 0.0 || (before == 0.0 && motion < 0.0);
    if is_behind { 1.0 } else { -1.0 }
}

/// Returns penetration and closing motion of two intervals along Z, px, from the side on which `b` met `a`.
fn along_z(a: DepthInterval, b: DepthInterval) -> EntryAxis {
    let side = side_of(a, b);
    EntryAxis {
        penetration: a.half + b.half - side * (b.z - a.z),
        closing: -side * (b.motion_z - a.motion_z),
    }
}

/// Returns a pair of geoms with its contact key, the older geom first; `None` for a stale id.
pub(super) fn key_of(core: &PhysicsSimulator, geom1: GeomId, geom2: GeomId) -> Option<DepthPair> {
    let (number1, number2) = (core.geom(geom1)?.id(), core.geom(geom2)?.id());
    Some(if number1 < number2 {
        DepthPair { key: ContactKey::Pair(number1, number2), geom_a: geom1, geom_b: geom2 }
    } else {
        DepthPair { key: ContactKey::Pair(number2, number1), geom_a: geom2, geom_b: geom1 }
    })
}

/// Input for the decision whether the core or `twohalf` owns the contact of a pair.
pub(super) struct OwnerChoice<'a> {
    pub(super) core: &'a PhysicsSimulator,
    pub(super) world: &'a World,
    pub(super) intervals: &'a DepthIntervals,
    pub(super) pair_cache: &'a PairCache,
    pub(super) convex_cache: &'a mut ConvexCache,
}

impl OwnerChoice<'_> {
    pub(super) fn owner_of(&mut self, pair: DepthPair) -> ContactOwner {
        let (a, b) = (self.intervals.of(pair.geom_a), self.intervals.of(pair.geom_b));
        if self.world.scheme == DepthScheme::Thesis {
            let is_near = a.z == b.z || (a.z - b.z).abs() < a.half.min(b.half);
            return if is_near { ContactOwner::Plane } else { ContactOwner::Space };
        }
        if a.is_round || b.is_round {
            return ContactOwner::Space;
        }
        let last = self.world.touches.find(pair.key);
        if last.is_some_and(|touch| matches!(touch.kept, PersistedFeature::Depth { .. })) {
            return ContactOwner::Space;
        }
        let depth = along_z(a, b);
        let stands_against =
            a.z != b.z && depth.penetration <= RESTING_SLOP_FACTOR * self.core.allowed_penetration();
        let may_meet_along_z = a.motion_z != b.motion_z || stands_against;
        if !may_meet_along_z || self.pair_cache.impulse(pair.key).is_some() {
            return ContactOwner::Plane;
        }
        self.owner_of_new(pair, depth).unwrap_or(ContactOwner::Plane)
    }

    /// Returns the owner of a new pair, by the axis that its outlines entered last; `None` if the outlines do not touch.
    fn owner_of_new(&mut self, pair: DepthPair, depth: EntryAxis) -> Option<ContactOwner> {
        let OwnerChoice { core, world: World { depths, .. }, intervals, convex_cache, .. } = self;
        let (body_a, body_b) = (core.geom(pair.geom_a)?.body(), core.geom(pair.geom_b)?.body());
        let motion = intervals.motion_of(core, depths, body_b) - intervals.motion_of(core, depths, body_a);
        let [(pieces_a, corners_a), (pieces_b, corners_b)] =
            convex_cache.transform_both(core, [pair.geom_a, pair.geom_b])?;
        let plane = entry_of_pieces(pieces_a.pieces(corners_a), || pieces_b.pieces(corners_b), motion.xy())?;
        let in_plane = EntryAxis { penetration: plane.penetration, closing: -motion.xy().dot(&plane.normal) };
        let plane_time = if plane.time <= MAX_ENTRY_AGE { plane.time } else { f32::INFINITY };
        let is_depth =
            is_depth_last(in_plane, plane_time, depth, motion.z != 0.0, core.allowed_penetration());
        Some(if is_depth { ContactOwner::Space } else { ContactOwner::Plane })
    }
}
