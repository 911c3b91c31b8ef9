//! Fixtures that are open from below and from their sides: what is above their top lands on it, and stays on it; all else passes
//! through.
//!
//! Who is not held yet is asked for two things: how deep it is below the top, and how it has come. One that came down was
//! above when its last step began, but for the reach of contacts. One that rises is not held before all of it is above.

use super::Space;
use super::solid::{Kind, Solid};
use crate::math::plane::{Vector, difference, dot, place, rotation, turn};
use crate::precise::bodies::Bodies;
use crate::precise::proxies::{Proxies, Proxy};

impl Space {
    /// Whether a proxy is that of a fixture that is open from below.
    #[inline(always)]
    pub(in crate::precise) fn is_one_way(&self, proxy: &Proxy) -> bool {
        self.has_one_way && self.fixture_of(proxy).is_some_and(|fixture| fixture.is_one_way)
    }

    /// Whether the second of two flies through the first one in this step.
    pub(in crate::precise) fn flies_through(
        &self,
        [a, b]: [u32; 2],
        proxies: &Proxies,
        bodies: &Bodies,
        reach: f32,
    ) -> bool {
        let proxy = |at: u32| &proxies.all[at as usize];
        if !self.is_one_way(proxy(a)) {
            return false;
        }
        let solid = |at: u32| {
            let outline = proxies.corners.outline(proxy(at).shape);
            Solid { motion: [0.0; 3], ..self.solid(at, proxy(at), outline, (bodies, 0.0)) }
        };
        let path =
            |at: u32| bodies.path.get(proxy(at).body as usize).map_or([0.0; 2], |path| [path[0], path[1]]);
        let falls = dot(difference(path(b), path(a)), up_of(solid(a))) < 0.0;
        !(falls && lands_on(solid(a), solid(b), reach))
    }
}

/// The direction in which its top looks.
fn up_of(solid: Solid<'_>) -> Vector {
    turn(rotation(solid.pose), [0.0, -1.0])
}

/// Whether B, which A does not hold yet, is above the top of A, or was when its last step began.
pub(in crate::precise) fn lands_on(a: Solid<'_>, b: Solid<'_>, reach: f32) -> bool {
    let up = up_of(a);
    let way = difference([b.motion[0], b.motion[1]], [a.motion[0], a.motion[1]]);
    let (deep, risen) = (depth_below(a, b, up), dot(way, up));
    deep <= 0.0 || (risen <= 0.0 && deep <= reach - risen)
}

/// How deep the lowest point of B is below the top of A; negative above it.
fn depth_below(a: Solid<'_>, b: Solid<'_>, up: Vector) -> f32 {
    let heights = |solid: Solid<'_>| {
        let q = rotation(solid.pose);
        let centre = std::slice::from_ref(&solid.outline.shape.centre);
        let points = if solid.outline.points.is_empty() { centre } else { solid.outline.points };
        let height = move |&point: &Vector| dot(turn(q, point), up);
        let (low, high) = points.iter().map(height).fold((f32::MAX, f32::MIN), |(low, high), height| {
            (if height < low { height } else { low }, if height > high { height } else { high })
        });
        (low - solid.outline.shape.radius, high + solid.outline.shape.radius)
    };
    let apart = dot(difference(place(b.pose), place(a.pose)), up);
    heights(a).1 + lean(a, b, up) - heights(b).0 - apart
}

/// How much higher than in its middle the top of a sheared box is, at most, where B is.
fn lean(a: Solid<'_>, b: Solid<'_>, up: Vector) -> f32 {
    let Some(shape) = a.slant else { return 0.0 };
    let half = match b.kind {
        Kind::Prism(half) => half,
        // Its bounds: what is above them is above it.
        Kind::Upright => b.outline.shape.half[0].max(b.outline.shape.radius),
        Kind::Ball | Kind::Ground => b.outline.shape.radius,
    };
    let ends = [b.z - half, b.z + half].map(|z| (z - shape.centre.z).clamp(-shape.half[2], shape.half[2]));
    let [front, back] = ends.map(|z| {
        let shift = shape.shift(z);
        dot([shift.x, shift.y], up)
    });
    if front > back { front } else { back }
}
