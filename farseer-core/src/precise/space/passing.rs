//! Two that are apart, and near, without coming to touch: they pass each other.

use super::solid::{Solid, deepest};
use crate::math::plane::{Vector, difference, dot, place, rotation, scaled, turn, turn_back};
use crate::precise::manifold::Manifold;
use crate::precise::outline::Family;
use crate::precise::parameters::depth::PREDICTED_MISS_COSINE;

/// Whether two that are apart along one axis will be apart along the other one by the time they are not along the first.
pub(super) fn passes_corner(
    a: Solid<'_>,
    b: Solid<'_>,
    side: f32,
    (apart, gap): (f32, f32),
    plane: &Manifold,
) -> bool {
    let way: [f32; 3] = std::array::from_fn(|axis| b.ahead[axis] - a.ahead[axis]);
    let (parting, parting_along_depth) = (dot([way[0], way[1]], plane.normal), side * way[2]);
    let (room, opening, inside, leaving) = if apart > 0.0 {
        (apart, -parting, gap, parting_along_depth)
    } else {
        (gap, -parting_along_depth, apart, parting)
    };
    leaving > 0.0 && opening > 0.0 && inside + leaving * (room / opening) >= 0.0
}

/// Whether two that are apart along a normal in the plane stay apart along another one for the whole step: what is above an
/// edge goes over it, and does not run into the face that ends there.
pub(super) fn passes_over(a: Solid<'_>, b: Solid<'_>, found: &Manifold) -> bool {
    let are_polygons = [a, b].iter().all(|solid| solid.outline.shape.family == Family::Polygon);
    if found.count == 0 || deepest(found) <= 0.0 || !are_polygons {
        return false;
    }
    let way = [b.ahead[0] - a.ahead[0], b.ahead[1] - a.ahead[1]];
    let back = scaled(way, -1.0);
    dot(way, found.normal) < 0.0
        && (stays_above(a, b, way, found.normal) || stays_above(b, a, back, found.normal))
}

/// Whether an edge of A, but for those that a normal is of, has all of B in front of it at both ends of B's way.
fn stays_above(a: Solid<'_>, b: Solid<'_>, way: Vector, normal: Vector) -> bool {
    let (qa, qb) = (rotation(a.pose), rotation(b.pose));
    let apart = difference(place(b.pose), place(a.pose));
    a.outline.points.iter().zip(a.outline.normals).any(|(&point, &edge)| {
        let edge_normal = turn(qa, edge);
        let in_b = turn_back(qb, edge_normal);
        let nearest = b.outline.points.iter().map(|&corner| dot(in_b, corner));
        let nearest = nearest.fold(f32::MAX, |least, one| if one < least { one } else { least });
        let separation = nearest + dot(edge_normal, apart) - dot(edge, point);
        let is_other = dot(edge_normal, normal).abs() < PREDICTED_MISS_COSINE;
        is_other && separation > 0.0 && separation + dot(way, edge_normal) > 0.0
    })
}
