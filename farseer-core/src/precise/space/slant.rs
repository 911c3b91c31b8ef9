//! Boxes whose edges along the depth axis do not run along it: sheared along x, or along y, which makes slopes along depth.
//!
//! What is beside one between two depths meets, in the plane, what the box covers there: the hull of its outlines at both. A side
//! of it with the normal (nx, ny) in the plane has the normal (nx, ny, climb ny - shear nx) in three axes, not yet of unit length.

use super::solid::Solid;
use crate::math::Vector3;
use crate::math::plane::{Vector, cross, difference, length, scaled};
use crate::precise::manifold::Manifold;
use crate::precise::outline::{Corners, Shape};
use crate::shape::SlantedBox;
use crate::storage::order::{joined, ordered, sort_by_number};

/// What a box covers of the plane between two depths, about its centre.
pub(super) fn swept(shape: &SlantedBox, near: f32, far: f32) -> (Corners, Shape) {
    let mut points: Vec<Vector> = Vec::with_capacity(8);
    for z in [near, far] {
        let shift = shape.shift(z - shape.centre.z);
        points.extend(shape.rectangle().map(|corner| [corner.x + shift.x, corner.y + shift.y]));
    }
    let mut corners = Corners::default();
    let shape = corners.add_hull(&hull(points));
    (corners, shape)
}

/// The convex hull, wound as the outlines of the precise set (A. Andrew, "Another efficient algorithm for convex hulls in two
/// dimensions", 1979).
pub(super) fn hull(mut points: Vec<Vector>) -> Vec<Vector> {
    sort_by_number(&mut points, |point| joined(point.map(ordered)));
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

/// Contacts in the plane with what a box covers, as they lie in three axes. Where an edge of it meets a face of the other one the
/// normal is that of the face.
pub(super) fn in_space(mut found: Manifold, shape: &SlantedBox) -> Manifold {
    let lean = -shape.lean(found.normal);
    if !found.is_of_b && lean != 0.0 {
        let stretch = length([1.0, lean]);
        found.normal = scaled(found.normal, 1.0 / stretch);
        found.normal_z = lean / stretch;
        found.separations = found.separations.map(|separation| separation / stretch);
    }
    found
}

/// A ball meets the nearest point of the box; a middle that is inside leaves through the face through which it came.
pub(super) fn ball(shape: &SlantedBox, a: Solid<'_>, ball: Solid<'_>, reach: f32) -> Manifold {
    let ([x, y], radius) = (ball.centre(), ball.outline.shape.radius);
    let centre = Vector3::new(x, y, ball.z);
    let nearest = if shape.contains(centre) {
        let before = centre - Vector3::from(ball.motion);
        let face = shape.entry_face(before, centre).unwrap_or_else(|| shape.nearest_face(centre));
        Some((shape.distance_to_face(face, centre), shape.face_normal(face)))
    } else {
        shape.nearest(centre)
    };
    let Some((distance, normal)) = nearest else { return Manifold::apart(0.0) };
    let separation = distance - radius;
    let in_plane = [normal.x, normal.y];
    let arm = difference([x, y], [a.pose[0], a.pose[1]]);
    let point = difference(arm, scaled(in_plane, radius + 0.5 * separation));
    let mut found = Manifold::of_point(in_plane, point, separation, 0, reach);
    found.normal_z = normal.z;
    found
}

#[cfg(test)]
mod tests {
    use super::{hull, swept};
    use crate::math::Vector3;
    use crate::shape::SlantedBox;

    #[test]
    fn a_hull_has_only_corners_and_turns_one_way() {
        let points = vec![[0.0, 0.0], [2.0, 0.0], [1.0, 0.0], [2.0, 2.0], [0.0, 2.0], [1.0, 1.0], [0.0, 0.0]];
        assert_eq!(hull(points), [[0.0, 0.0], [2.0, 0.0], [2.0, 2.0], [0.0, 2.0]]);
    }

    #[test]
    fn a_sheared_box_covers_more_of_the_plane_the_deeper_it_is_seen() {
        let shape = SlantedBox { half: [10.0, 5.0, 20.0], shear: 0.5, ..SlantedBox::default() };
        let width = |near, far| {
            let (_, shape) = swept(&shape, near, far);
            2.0 * shape.half[0]
        };
        assert_eq!(shape.centre, Vector3::zeros());
        assert_eq!([width(3.0, 3.0), width(-4.0, 8.0)], [20.0, 26.0]);
    }
}
