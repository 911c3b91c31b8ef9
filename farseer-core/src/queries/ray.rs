//! Rays against the true shapes of geoms.

use super::convex::{Convex, Point, closest, dot, minus, plus, point, scaled, vector};
use super::finite;
use super::world_shape::{self, RoundPiece};
use crate::Result;
use crate::geom::GeomId;
use crate::geom::outline::Outline;
use crate::math::Vector2;
use crate::objects::{Objects, Ray as PolygonRay, RayCastHit, ray_segment};
use crate::simulator::candidates::Segment;

/// A ray from a point to another.
pub(super) struct Ray {
    start: Vector2,
    end: Vector2,
    /// The ray against polygons; `None` for one without a direction.
    polygon_ray: Option<PolygonRay>,
}

impl Ray {
    pub(super) fn new(start: Vector2, end: Vector2) -> Result<Self> {
        let (start, end) = (finite("start", start)?, finite("end", end)?);
        Ok(Ray { start, end, polygon_ray: PolygonRay::new(start, end) })
    }

    /// The path of the ray.
    pub(super) fn segment(&self) -> Segment {
        ray_segment(self.start, self.end)
    }

    /// The first point at which the ray enters the polygon of a geom.
    fn hit_of_polygon(&self, objects: &Objects, id: GeomId) -> Option<(f64, RayCastHit)> {
        let ray = self.polygon_ray.as_ref()?;
        objects.first_entry(ray, id).map(|entry| (entry.fraction, ray.hit(&entry)))
    }

    /// The first point at which the ray enters a geom, with its fraction of the ray.
    pub(super) fn hit(&self, objects: &Objects, id: GeomId) -> Option<(f64, RayCastHit)> {
        let outline = objects.geom(id)?.outline();
        // The polygon of a concave outline has no edges between its convex pieces.
        if matches!(outline, Outline::Polygon | Outline::Chain { .. } | Outline::TwoSidedChain { .. }) {
            return self.hit_of_polygon(objects, id);
        }
        let Some(round) = world_shape::round_piece(objects, id) else {
            return self.hit_of_polygon(objects, id);
        };
        let (start, way) = (point(self.start), minus(point(self.end), point(self.start)));
        let (fraction, normal) = match round {
            RoundPiece::Circle { centre, radius } => enter_circle(start, way, centre, radius)?,
            RoundPiece::Capsule { ends, radius } => enter_capsule(start, way, ends, radius)?,
            RoundPiece::Polygon(polygon) => enter_rounded_polygon(start, way, &polygon)?,
        };
        let at = plus(start, scaled(way, fraction));
        let hit =
            RayCastHit { geom: id, point: vector(at), normal: vector(normal), fraction: fraction as f32 };
        Some((fraction, hit))
    }
}

/// Fraction of the way at which a ray enters a circle, and the outward normal there. `None` if it starts inside.
fn enter_circle(start: Point, way: Point, centre: Point, radius: f64) -> Option<(f64, Point)> {
    let from_centre = minus(start, centre);
    let (a, b) = (dot(way, way), dot(from_centre, way));
    let c = dot(from_centre, from_centre) - radius * radius;
    let discriminant = b * b - a * c;
    if c < 0.0 || b >= 0.0 || discriminant < 0.0 {
        return None;
    }
    // Without the difference of two nearly equal numbers.
    let fraction = c / (-b + discriminant.sqrt());
    let normal = scaled(plus(from_centre, scaled(way, fraction)), 1.0 / radius);
    (fraction <= 1.0).then_some((fraction, normal))
}

/// Fraction of the way at which a ray enters a rounded polygon, and the outward normal there. `None` if it starts inside. From
/// outside the ray first meets the capsule about one of the edges.
fn enter_rounded_polygon(start: Point, way: Point, polygon: &Convex) -> Option<(f64, Point)> {
    let from = Convex { core: vec![start], radius: 0.0, free_side: None };
    if closest(&from, polygon).distance < 0.0 {
        return None;
    }
    let hits = polygon.edges().filter_map(|edge| enter_capsule(start, way, edge, polygon.radius));
    hits.reduce(|first, hit| if hit.0 < first.0 { hit } else { first })
}

/// Fraction of the way at which a ray enters a capsule, and the outward normal there. `None` if it starts inside.
fn enter_capsule(start: Point, way: Point, [one, other]: [Point; 2], radius: f64) -> Option<(f64, Point)> {
    let axis = minus(other, one);
    let length = dot(axis, axis).sqrt();
    if length == 0.0 {
        return enter_circle(start, way, one, radius);
    }
    let along = scaled(axis, 1.0 / length);
    let side = [along[1], -along[0]];
    let (start_across, way_across) = (dot(minus(start, one), side), dot(way, side));
    let is_beside = |at: Point| (0.0..=length).contains(&dot(minus(at, one), along));
    let is_inside = |end: Point| {
        let from_end = minus(start, end);
        dot(from_end, from_end) < radius * radius
    };
    if is_inside(one) || is_inside(other) || (is_beside(start) && start_across.abs() < radius) {
        return None;
    }
    let sign = if start_across < 0.0 { -1.0 } else { 1.0 };
    let across = (way_across != 0.0).then(|| (sign * radius - start_across) / way_across);
    let flank = across.filter(|fraction| (0.0..=1.0).contains(fraction) && sign * way_across < 0.0);
    let flank = flank.filter(|&fraction| is_beside(plus(start, scaled(way, fraction))));
    let hits = [
        flank.map(|fraction| (fraction, scaled(side, sign))),
        enter_circle(start, way, one, radius),
        enter_circle(start, way, other, radius),
    ];
    hits.into_iter().flatten().reduce(|first, hit| if hit.0 < first.0 { hit } else { first })
}
