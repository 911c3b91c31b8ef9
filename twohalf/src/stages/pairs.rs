//! Which objects meet, and along which axis: what the 2D engine is told about depth while it looks for pairs.
//!
//! The 2D engine finds pairs whose boxes overlap in X and Y. Each of them is let pass, left to the 2D engine, or
//! taken over by this one: balls, and outlines that met along Z.

use farseer_core::math::scalar::nearest_finite;
use farseer_core::order::{joined, sort_numbered};
use farseer_core::{ArbiterRef, GeomId, PhysicsSimulator};

use super::outlines::Outlines;
use super::reach::{Reach, Reaches};
use crate::depth::{DepthScheme, Kept, TouchKey, World};
use crate::shapes::{Along, RECENT, SHALLOW, entry_of_pieces, is_depth_last};

/// A pair whose contact this engine looks for: the older geom first.
#[derive(Debug, Clone, Copy)]
pub(super) struct SpacePair {
    pub(super) key: TouchKey,
    pub(super) geom_a: GeomId,
    pub(super) geom_b: GeomId,
}

/// The pairs that touched in the 2D engine in the last update, with the bits of the impulse between them.
#[derive(Debug, Clone, Default)]
pub(super) struct KnownPairs {
    sorted: Vec<(u128, u32)>,
}

impl KnownPairs {
    pub(super) fn prepare(&mut self, core: &PhysicsSimulator) {
        self.sorted.clear();
        for arbiter in core.arbiters() {
            let (Some(a), Some(b)) = (core.geom(arbiter.geom_a()), core.geom(arbiter.geom_b())) else {
                continue;
            };
            let impulse = impulse_of(arbiter);
            self.sorted.push((joined([a.id(), b.id()]), impulse.to_bits()));
        }
        sort_numbered(&mut self.sorted);
    }

    /// Whether two geoms touched in the 2D engine in the last update.
    pub(super) fn have_touched(&self, core: &PhysicsSimulator, this: GeomId, other: GeomId) -> bool {
        key_of(core, this, other).is_some_and(|pair| self.impulse(pair.key).is_some())
    }

    /// The impulse between a pair, if it touched.
    pub(super) fn impulse(&self, key: TouchKey) -> Option<f32> {
        let TouchKey::Pair(a, b) = key else { return None };
        let index = self.sorted.binary_search_by_key(&joined([a, b]), |(numbers, _)| *numbers).ok()?;
        Some(f32::from_bits(self.sorted[index].1))
    }
}

/// The impulse between two geoms that touch in the 2D engine.
pub(super) fn impulse_of(arbiter: ArbiterRef<'_>) -> f32 {
    nearest_finite(arbiter.contacts().map(|contact| contact.normal_impulse()).sum())
}

/// What becomes of a pair whose boxes overlap in all three axes.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Way {
    /// The 2D engine's.
    Plane,
    /// This engine's.
    Space,
}

/// Whether two extents along Z overlap. Faces that only touch do not; two extents about the same Z always do,
/// however thin.
pub(super) fn extents_overlap(a: Reach, b: Reach) -> bool {
    a.z == b.z || (f64::from(a.z) - f64::from(b.z)).abs() < f64::from(a.half) + f64::from(b.half)
}

/// The side of `a` along Z on which `b` was before the last step: 1 behind it, -1 in front.
pub(super) fn side_of(a: Reach, b: Reach) -> f32 {
    let motion = b.motion_z - a.motion_z;
    let before = b.z - a.z - motion;
    let is_behind = before > 0.0 || (before == 0.0 && motion < 0.0);
    if is_behind { 1.0 } else { -1.0 }
}

/// How two extents overlap along Z, from the side on which they met.
fn along_z(a: Reach, b: Reach) -> Along {
    let side = side_of(a, b);
    Along { penetration: a.half + b.half - side * (b.z - a.z), closing: -side * (b.motion_z - a.motion_z) }
}

/// Names a pair of geoms; the older one becomes the first.
pub(super) fn key_of(core: &PhysicsSimulator, geom1: GeomId, geom2: GeomId) -> Option<SpacePair> {
    let (number1, number2) = (core.geom(geom1)?.id(), core.geom(geom2)?.id());
    Some(if number1 < number2 {
        SpacePair { key: TouchKey::Pair(number1, number2), geom_a: geom1, geom_b: geom2 }
    } else {
        SpacePair { key: TouchKey::Pair(number2, number1), geom_a: geom2, geom_b: geom1 }
    })
}

/// What decides about a pair.
pub(super) struct Chooser<'a> {
    pub(super) core: &'a PhysicsSimulator,
    pub(super) world: &'a World,
    pub(super) reaches: &'a Reaches,
    pub(super) known: &'a KnownPairs,
    pub(super) outlines: &'a mut Outlines,
}

impl Chooser<'_> {
    pub(super) fn way_of(&mut self, pair: SpacePair) -> Way {
        let (a, b) = (self.reaches.of(pair.geom_a), self.reaches.of(pair.geom_b));
        if self.world.scheme == DepthScheme::Thesis {
            let is_near = a.z == b.z || (a.z - b.z).abs() < a.half.min(b.half);
            return if is_near { Way::Plane } else { Way::Space };
        }
        if a.is_round || b.is_round {
            return Way::Space;
        }
        let last = self.world.touches.find(pair.key);
        if last.is_some_and(|touch| matches!(touch.kept, Kept::Depth { .. })) {
            return Way::Space;
        }
        let depth = along_z(a, b);
        let stands_against = a.z != b.z && depth.penetration <= SHALLOW * self.core.allowed_penetration();
        let may_meet_along_z = a.motion_z != b.motion_z || stands_against;
        if !may_meet_along_z || self.known.impulse(pair.key).is_some() {
            return Way::Plane;
        }
        self.way_of_new(pair, depth).unwrap_or(Way::Plane)
    }

    /// Two outlines that did not touch before meet along the axis that they entered last, as their last step says.
    /// `None` if they do not touch.
    fn way_of_new(&mut self, pair: SpacePair, depth: Along) -> Option<Way> {
        let Chooser { core, world: World { depths, .. }, reaches, outlines, .. } = self;
        let (body_a, body_b) = (core.geom(pair.geom_a)?.body(), core.geom(pair.geom_b)?.body());
        let motion = reaches.motion_of(core, depths, body_b) - reaches.motion_of(core, depths, body_a);
        let [(pieces_a, corners_a), (pieces_b, corners_b)] =
            outlines.lay_out_both(core, [pair.geom_a, pair.geom_b])?;
        let plane = entry_of_pieces(pieces_a.pieces(corners_a), || pieces_b.pieces(corners_b), motion.xy())?;
        let in_plane = Along { penetration: plane.penetration, closing: -motion.xy().dot(&plane.normal) };
        let plane_time = if plane.time <= RECENT { plane.time } else { f32::INFINITY };
        let is_depth =
            is_depth_last(in_plane, plane_time, depth, motion.z != 0.0, core.allowed_penetration());
        Some(if is_depth { Way::Space } else { Way::Plane })
    }
}
