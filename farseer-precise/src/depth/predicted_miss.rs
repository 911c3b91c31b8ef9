//! Predicted misses: a filter for speculative contacts in three axes. Two separated shapes that will pass each other within the
//! step get no contact.
//!
//! Without the filter a speculative contact at an edge or vertex stops a body that would have passed. Reads poses and predicted
//! displacements of the step.

use super::posed_solid::{PosedSolid, min_separation};
use crate::math::plane::{Vector, difference, dot, rotate, rotate_inverse, rotation, scaled, translation};
use crate::narrow_phase::manifold::Manifold;
use crate::parameters::depth::PREDICTED_MISS_COSINE;

/// Returns whether two prisms that are separated along one axis (in the plane or along z) will be separated along the other
/// axis when the gap along the first one closes. `apart` is the separation in the plane, `gap` the separation along z, in
/// length units. `side` is the sign of z of B relative to A, 1 or -1; `plane` is the contact manifold in the plane.
pub(super) fn will_miss_corner(
    a: PosedSolid<'_>,
    b: PosedSolid<'_>,
    side: f32,
    (apart, gap): (f32, f32),
    plane: &Manifold,
) -> bool {
    let displacement: [f32; 3] =
        std::array::from_fn(|axis| b.predicted_displacement[axis] - a.predicted_displacement[axis]);
    let (parting, parting_along_depth) =
        (dot([displacement[0], displacement[1]], plane.normal), side * displacement[2]);
    let (gap_to_close, closing_speed, overlap, separating_speed) = if apart > 0.0 {
        (apart, -parting, gap, parting_along_depth)
    } else {
        (gap, -parting_along_depth, apart, parting)
    };
    separating_speed > 0.0
        && closing_speed > 0.0
        && overlap + separating_speed * (gap_to_close / closing_speed) >= 0.0
}

/// Returns whether two polygons will miss each other in the plane. They do if one polygon stays in front of a face of the other
/// one for the whole step. The face of the contact itself does not count. A body above an edge passes over it and does not hit
/// the face that ends there.
pub(super) fn will_miss_face(a: PosedSolid<'_>, b: PosedSolid<'_>, found: &Manifold) -> bool {
    let are_polygons = [a, b].iter().all(|solid| solid.outline.shape.is_plain_polygon());
    if found.count == 0 || min_separation(found) <= 0.0 || !are_polygons {
        return false;
    }
    let displacement = [
        b.predicted_displacement[0] - a.predicted_displacement[0],
        b.predicted_displacement[1] - a.predicted_displacement[1],
    ];
    let back = scaled(displacement, -1.0);
    dot(displacement, found.normal) < 0.0
        && (stays_in_front(a, b, displacement, found.normal) || stays_in_front(b, a, back, found.normal))
}

/// Returns whether all of B is in front of an edge of A both before and after B's `displacement` relative to A (x and y, length
/// units). Edges whose normal is the contact normal do not count.
fn stays_in_front(a: PosedSolid<'_>, b: PosedSolid<'_>, displacement: Vector, normal: Vector) -> bool {
    let (qa, qb) = (rotation(a.pose), rotation(b.pose));
    let apart = difference(translation(b.pose), translation(a.pose));
    a.outline.vertices.iter().zip(a.outline.normals).any(|(&point, &edge)| {
        let edge_normal = rotate(qa, edge);
        let in_b = rotate_inverse(qb, edge_normal);
        let nearest = b.outline.vertices.iter().map(|&corner| dot(in_b, corner));
        let nearest = nearest.fold(f32::MAX, |least, one| if one < least { one } else { least });
        let separation = nearest + dot(edge_normal, apart) - dot(edge, point);
        let is_other = dot(edge_normal, normal).abs() < PREDICTED_MISS_COSINE;
        is_other && separation > 0.0 && separation + dot(displacement, edge_normal) > 0.0
    })
}
