//! The convex pieces of a geom in the world.

use super::convex::{Closest, Convex, Point, closest};
use crate::geom::GeomId;
use crate::geom::view::GeomRef;
use crate::math::Matrix;
use crate::objects::Objects;
use crate::shape::Aabb;
use farseer_precise::pieces::Piece;

/// Part of the size of a geom's box by which its true shape may reach beyond its polygon: a circle of eight corners by 8 % of its
/// radius. A fraction.
const BEYOND_POLYGON: f32 = 0.05;

/// The convex pieces of a geom at its present place.
pub(super) fn pieces_of(objects: &Objects, geom: GeomId) -> impl Iterator<Item = Convex> + '_ {
    objects.geom(geom).into_iter().flat_map(|geom| {
        let to_world = to_world(&geom.matrix());
        geom.entry.pieces().iter().map(move |piece| Convex::of_piece(piece, &to_world))
    })
}

/// The round shape of a geom in the world, in length units.
pub(super) enum RoundPiece {
    Circle { centre: Point, radius: f64 },
    Capsule { ends: [Point; 2], radius: f64 },
    Polygon(Convex),
}

/// The circle, capsule or rounded polygon of a geom at its present place; `None` for another shape.
pub(super) fn round_piece(objects: &Objects, geom: GeomId) -> Option<RoundPiece> {
    let geom = objects.geom(geom)?;
    let to_world = to_world(&geom.matrix());
    let at = |[x, y]: [f32; 2]| to_world([f64::from(x), f64::from(y)]);
    match geom.entry.pieces().first()? {
        Piece::Circle { centre, radius } if *radius > 0.0 => {
            Some(RoundPiece::Circle { centre: at(*centre), radius: f64::from(*radius) })
        }
        Piece::Capsule { ends, radius } if *radius > 0.0 => {
            Some(RoundPiece::Capsule { ends: ends.map(at), radius: f64::from(*radius) })
        }
        piece @ Piece::Rounded { .. } => Some(RoundPiece::Polygon(Convex::of_piece(piece, &to_world))),
        _ => None,
    }
}

/// Returns the function that brings points of a geom to the world, by the matrix of the geom.
pub(super) fn to_world(matrix: &Matrix) -> impl Fn(Point) -> Point + use<> {
    let [m11, m12, m21, m22, x, y] =
        [matrix.m11, matrix.m12, matrix.m21, matrix.m22, matrix.m41, matrix.m42].map(f64::from);
    move |[px, py]: Point| [px * m11 + py * m21 + x, px * m12 + py * m22 + y]
}

/// Whether a geom touches one of these shapes.
pub(super) fn touches(objects: &Objects, geom: GeomId, shapes: &[Convex]) -> bool {
    pieces_of(objects, geom).any(|piece| shapes.iter().any(|shape| closest(shape, &piece).distance <= 0.0))
}

/// The closest points of a shape and a geom.
pub(super) fn nearest(objects: &Objects, geom: GeomId, shape: &Convex) -> Option<Closest> {
    let all = pieces_of(objects, geom).map(|piece| closest(shape, &piece));
    all.reduce(|best, other| if other.distance < best.distance { other } else { best })
}

/// Whether the true shape of a geom may reach into a box.
pub(super) fn may_reach(objects: &Objects, geom: GeomId, aabb: &Aabb) -> bool {
    objects.geom(geom).is_some_and(|geom: GeomRef<'_>| {
        let own = geom.aabb();
        let more = BEYOND_POLYGON * (own.width() + own.height());
        own.min.x - more <= aabb.max.x
            && own.max.x + more >= aabb.min.x
            && own.min.y - more <= aabb.max.y
            && own.max.y + more >= aabb.min.y
    })
}
