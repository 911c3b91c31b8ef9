//! Narrow phase of sheared boxes, whose edges along depth deviate along x (shear) or y (climb). A climbing box is a slope along
//! z.
//!
//! A body beside the box between two depths collides with the convex hull of the box's outlines at both depths. A side with the
//! planar normal (nx, ny) has the normal (nx, ny, climb ny - shear nx) in three axes, before normalisation.

use super::posed_solid::PosedSolid;
use crate::math::Vector3;
use crate::math::plane::{Vector, cross, difference, length, scaled};
use crate::narrow_phase::manifold::Manifold;
use crate::shape::{Shape, VertexPool};
use crate::slanted_box::SlantedBox;
use crate::storage::order::{packed_key, sort_by_number, total_order_key};

/// Returns the outline of a sheared box between the world depths `near` and `far`: the convex hull of the cross sections at
/// both depths, in x and y relative to the box's centre, length units.
pub(super) fn outline_between(shape: &SlantedBox, near: f32, far: f32) -> (VertexPool, Shape) {
    let mut points: Vec<Vector> = Vec::with_capacity(8);
    for z in [near, far] {
        let shift = shape.shift(z - shape.centre.z);
        points.extend(shape.rectangle().map(|corner| [corner.x + shift.x, corner.y + shift.y]));
    }
    let mut corners = VertexPool::default();
    let shape = corners.add_hull(&convex_hull(points));
    (corners, shape)
}

/// Returns the vertices of the convex hull of `points`, in the order of outlines: with positive shoelace area in x right, y
/// down (A. Andrew, "Another efficient algorithm for convex hulls in two dimensions", 1979).
pub(super) fn convex_hull(mut points: Vec<Vector>) -> Vec<Vector> {
    sort_by_number(&mut points, |point| packed_key(point.map(total_order_key)));
    let mut chain: Vec<Vector> = Vec::with_capacity(points.len() + 1);
    let mut extend = |of: &mut dyn Iterator<Item = Vector>| {
        let first = chain.len();
        for point in of {
            while chain.len() >= first + 2 {
                let [a, b] = [chain[chain.len() - 2], chain[chain.len() - 1]];
                if cross(difference(b, a), difference(point, b)) > 0.0 {
                    break;
                }
                chain.pop();
            }
            chain.push(point);
        }
        chain.pop();
    };
    extend(&mut points.iter().copied());
    extend(&mut points.iter().rev().copied());
    chain
}

/// Returns a planar manifold with the outline of a sheared box, converted to three axes: its normal and separations become
/// those of the sheared side. A normal that belongs to a face of the other shape stays unchanged.
pub(super) fn to_sheared_normal(mut found: Manifold, shape: &SlantedBox) -> Manifold {
    let lean = -shape.lean(found.normal);
    if !found.is_reference_on_b && lean != 0.0 {
        let stretch = length([1.0, lean]);
        found.normal = scaled(found.normal, 1.0 / stretch);
        found.normal_z = lean / stretch;
        found.separations = found.separations.map(|separation| separation / stretch);
    }
    found
}

/// Collides a sphere with the closest point of a sheared box. A sphere whose centre is inside of the box leaves through the
/// face through which the centre entered.
pub(super) fn collide_sphere(
    shape: &SlantedBox,
    a: PosedSolid<'_>,
    ball: PosedSolid<'_>,
    contact_margin: f32,
) -> Manifold {
    let ([x, y], radius) = (ball.shape_centre(), ball.outline.shape.radius);
    let centre = Vector3::new(x, y, ball.z);
    let nearest = if shape.contains(centre) {
        let before = centre - Vector3::from(ball.last_displacement);
        let face = shape.entry_face(before, centre).unwrap_or_else(|| shape.nearest_face(centre));
        Some((shape.distance_to_face(face, centre), shape.face_normal(face)))
    } else {
        shape.nearest(centre)
    };
    let Some((distance, normal)) = nearest else { return Manifold::separated(0.0) };
    let separation = distance - radius;
    let in_plane = [normal.x, normal.y];
    let arm = difference([x, y], [a.pose[0], a.pose[1]]);
    let point = difference(arm, scaled(in_plane, radius + 0.5 * separation));
    let mut found = Manifold::single_point(in_plane, point, separation, 0, contact_margin);
    found.normal_z = normal.z;
    found
}

#[cfg(test)]
mod tests {
    use super::{convex_hull, outline_between};
    use crate::math::Vector3;
    use crate::slanted_box::SlantedBox;

    #[test]
    fn convex_hull_has_only_extreme_vertices_in_winding_order() {
        let points = vec![[0.0, 0.0], [2.0, 0.0], [1.0, 0.0], [2.0, 2.0], [0.0, 2.0], [1.0, 1.0], [0.0, 0.0]];
        assert_eq!(convex_hull(points), [[0.0, 0.0], [2.0, 0.0], [2.0, 2.0], [0.0, 2.0]]);
    }

    #[test]
    fn outline_of_a_sheared_box_widens_with_the_depth_range() {
        let shape = SlantedBox { half: [10.0, 5.0, 20.0], shear: 0.5, ..SlantedBox::default() };
        let width = |near, far| {
            let (_, shape) = outline_between(&shape, near, far);
            2.0 * shape.half_extents[0]
        };
        assert_eq!(shape.centre, Vector3::zeros());
        assert_eq!([width(3.0, 3.0), width(-4.0, 8.0)], [20.0, 26.0]);
    }
}
