//! One-way world boxes: solid for bodies that land on the top, passable from below and from the sides.
//!
//! A pair without contact is tested with the penetration of the body below the top and its displacement in the last step. A
//! falling body collides if it was above the top at the start of that step, within the contact margin. A rising body collides
//! only when all of it is above the top. A pair with a contact keeps the contact.

use super::posed_solid::{PosedSolid, SolidKind};
use super::state::DepthState;
use crate::bodies::BodySet;
use crate::broad_phase::proxies::{Proxies, Proxy};
use crate::index::ProxyIndex;
use crate::math::plane::{Vector, difference, dot, rotate, rotation, translation};

impl DepthState {
    /// Returns whether a proxy is a one-way world box.
    #[inline(always)]
    pub(crate) fn is_one_way(&self, proxy: &Proxy) -> bool {
        self.has_one_way && self.world_box_of(proxy).is_some_and(|world_box| world_box.is_one_way)
    }

    /// Returns whether continuous collision ignores a pair: A is a one-way box and B does not land on its top in this step.
    /// `contact_margin` is in length units.
    pub(crate) fn passes_one_way_box(
        &self,
        [a, b]: [ProxyIndex; 2],
        proxies: &Proxies,
        bodies: &BodySet,
        contact_margin: f32,
    ) -> bool {
        let proxy = |at: ProxyIndex| proxies.proxy(at);
        if !self.is_one_way(proxy(a)) {
            return false;
        }
        let solid = |at: ProxyIndex| {
            let outline = proxies.vertices.shape_ref(proxy(at).shape);
            PosedSolid {
                last_displacement: [0.0; 3],
                ..self.posed_solid(at, proxy(at), outline, (bodies, 0.0))
            }
        };
        let path =
            |at: ProxyIndex| bodies.delta_pose.at(proxy(at).body).map_or([0.0; 2], |path| [path[0], path[1]]);
        let falls = dot(difference(path(b), path(a)), top_normal(solid(a))) < 0.0;
        !(falls && will_land(solid(a), solid(b), contact_margin))
    }
}

/// Returns the outward unit normal of the top of a world box, in world axes x and y (down). Dimensionless.
fn top_normal(solid: PosedSolid<'_>) -> Vector {
    rotate(rotation(solid.pose), [0.0, -1.0])
}

/// Returns whether B, which has no contact with the one-way box A, lands on its top. B is above the top now, or B moved down
/// and was above the top at the start of the last step. `contact_margin` is in length units.
pub(crate) fn will_land(a: PosedSolid<'_>, b: PosedSolid<'_>, contact_margin: f32) -> bool {
    let up = top_normal(a);
    let displacement = difference(
        [b.last_displacement[0], b.last_displacement[1]],
        [a.last_displacement[0], a.last_displacement[1]],
    );
    let (deep, risen) = (penetration_below_top(a, b, up), dot(displacement, up));
    deep <= 0.0 || (risen <= 0.0 && deep <= contact_margin - risen)
}

/// Returns the penetration of B's lowest point below the top of A in length units, negative above the top. Heights are measured
/// along `up`, the outward unit normal of the top.
fn penetration_below_top(a: PosedSolid<'_>, b: PosedSolid<'_>, up: Vector) -> f32 {
    let heights = |solid: PosedSolid<'_>| {
        let q = rotation(solid.pose);
        let centre = std::slice::from_ref(&solid.outline.shape.centre);
        let points = if solid.outline.vertices.is_empty() { centre } else { solid.outline.vertices };
        let height = move |&point: &Vector| dot(rotate(q, point), up);
        let (low, high) = points.iter().map(height).fold((f32::MAX, f32::MIN), |(low, high), height| {
            (if height < low { height } else { low }, if height > high { height } else { high })
        });
        (low - solid.outline.shape.radius, high + solid.outline.shape.radius)
    };
    let apart = dot(difference(translation(b.pose), translation(a.pose)), up);
    heights(a).1 + top_rise(a, b, up) - heights(b).0 - apart
}

/// Returns how far the top of the sheared box A lies above its height at the box's centre, at the highest place within B's
/// range of z, in length units. Heights are measured along `up`, the outward unit normal of the top. 0 for a box that is not
/// sheared.
fn top_rise(a: PosedSolid<'_>, b: PosedSolid<'_>, up: Vector) -> f32 {
    let Some(shape) = a.sheared_box else { return 0.0 };
    let half = match b.kind {
        SolidKind::Prism(half) => half,
        // Half width as a bound of the extent along z.
        SolidKind::Vertical => b.outline.shape.half_extents[0].max(b.outline.shape.radius),
        SolidKind::Sphere | SolidKind::Ground => b.outline.shape.radius,
    };
    let ends = [b.z - half, b.z + half].map(|z| (z - shape.centre.z).clamp(-shape.half[2], shape.half[2]));
    let [front, back] = ends.map(|z| {
        let shift = shape.shift(z);
        dot([shift.x, shift.y], up)
    });
    if front > back { front } else { back }
}
