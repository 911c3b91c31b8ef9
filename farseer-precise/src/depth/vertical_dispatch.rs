//! Narrow phase of pairs with a vertical shape: this file selects the function by the kinds of both solids.
//!
//! | pair | function |
//! |---|---|
//! | ground | `vertical_ground` |
//! | vertical shape or sphere | `vertical_shapes` |
//! | capsule against prism or sheared box | `capsule_prism`: its nearest spheres |
//! | other vertical shape against prism | `vertical_prism` |
//! | other vertical shape against sheared box | `vertical_sheared_box` |

use super::posed_solid::{ContactMargins, PosedSolid, PreviousAxis, SolidKind};
use super::prism_collision::{prism_sphere, prism_sphere_distance};
use super::vertical_prism::PosedPrism;
use super::vertical_shapes::{PosedVertical, dot3};
use super::vertical_solid::VerticalSolid;
use super::{sheared_box, vertical_prism, vertical_shapes, vertical_sheared_box};
use crate::math::Vector3;
use crate::math::plane::{difference, translation};
use crate::narrow_phase::manifold::Manifold;
use crate::parameters::depth::{FLAT_SIDE_MAX_LEAN, FLAT_SIDE_MIN_COSINE};
use crate::shape::{Shape, ShapeKind};

/// Returns the contact manifold of A and B, at least one of which is vertical, with points relative to the position of body A.
/// A is the less movable body.
pub(super) fn collide_with_vertical(
    a: PosedSolid<'_>,
    b: PosedSolid<'_>,
    previous: PreviousAxis,
    margins: ContactMargins,
) -> Manifold {
    let round = |solid: &PosedSolid<'_>| VerticalSolid::sphere(solid.outline.shape.radius);
    match ((a.kind, a.vertical), (b.kind, b.vertical)) {
        ((SolidKind::Ground, _), (_, Some(vertical))) => {
            vertical_ground(a, b, vertical, margins.contact_margin)
        }
        ((_, Some(one)), (_, Some(other))) => {
            vertical_shapes::collide_verticals(a, b, [one, other], previous, margins)
        }
        ((SolidKind::Sphere, _), (_, Some(other))) => {
            vertical_shapes::collide_verticals(a, b, [&round(&a), other], previous, margins)
        }
        ((_, Some(one)), (SolidKind::Sphere, _)) => {
            vertical_shapes::collide_verticals(a, b, [one, &round(&b)], previous, margins)
        }
        ((SolidKind::Prism(half), _), (_, Some(vertical))) if vertical.rounding > 0.0 => {
            capsule_prism(a, half, (b, vertical), previous, margins)
        }
        ((_, Some(vertical)), (SolidKind::Prism(half), _)) if vertical.rounding > 0.0 => {
            let found = capsule_prism(b, half, (a, vertical), previous.flipped(), margins);
            super::posed_solid::flip_manifold(found, b, a)
        }
        ((SolidKind::Prism(half), _), (_, Some(vertical))) => match &a.sheared_box {
            Some(shape) => {
                vertical_sheared_box::collide_vertical_sheared_box(a, b, (vertical, shape), previous, margins)
            }
            None => vertical_prism::collide_vertical_prism(a, b, (vertical, half, false), previous, margins),
        },
        ((_, Some(vertical)), (SolidKind::Prism(half), _)) => {
            vertical_prism::collide_vertical_prism(a, b, (vertical, half, true), previous, margins)
        }
        _ => Manifold::separated(0.0),
    }
}

/// Returns the separation of A and B, at least one of which is vertical (length units), and the unit axis x, y, z from A to B
/// along which it is measured. Displacement along this axis bounds the closing speed, as conservative advancement needs.
pub(super) fn separation(a: PosedSolid<'_>, b: PosedSolid<'_>) -> (f32, [f32; 3]) {
    let against = |(apart, axis): (f32, [f32; 3])| (apart, axis.map(|component| -component));
    let round = |solid: &PosedSolid<'_>| VerticalSolid::sphere(solid.outline.shape.radius);
    match ((a.kind, a.vertical), (b.kind, b.vertical)) {
        ((SolidKind::Ground, _), (_, Some(vertical))) => {
            let [_, y, _] = PosedVertical::new(&b, vertical).position;
            (-(y + vertical.half_height + vertical.rounding), [0.0, -1.0, 0.0])
        }
        ((_, Some(one)), (_, Some(other))) => separation_of_verticals([&a, &b], [one, other]),
        ((SolidKind::Sphere, _), (_, Some(other))) => separation_of_verticals([&a, &b], [&round(&a), other]),
        ((_, Some(one)), (SolidKind::Sphere, _)) => separation_of_verticals([&a, &b], [one, &round(&b)]),
        ((_, Some(vertical)), (SolidKind::Prism(half), _)) => separation_from_prism(&a, vertical, &b, half),
        ((SolidKind::Prism(half), _), (_, Some(vertical))) => {
            against(separation_from_prism(&b, vertical, &a, half))
        }
        _ => (f32::MAX, [0.0, 1.0, 0.0]),
    }
}

/// Returns the separation of two vertical shapes, or of a vertical shape and a sphere (length units), and the unit axis x, y, z
/// from A to B.
fn separation_of_verticals(
    [a, b]: [&PosedSolid<'_>; 2],
    [one, other]: [&VerticalSolid; 2],
) -> (f32, [f32; 3]) {
    let (a, b) = (PosedVertical::new(a, one), PosedVertical::new(b, other));
    if one.rounding + other.rounding > 0.0 {
        let found = vertical_shapes::rounded_contact(a, b);
        return (found.separation, found.normal);
    }
    let candidates = vertical_shapes::axis_candidates(a, b);
    (candidates.max_separation().separation, candidates.max_separation().normal)
}

/// Returns the separation of the vertical shape A from a prism or a sheared box (length units), and the unit axis x, y, z from
/// A to the prism. `half` is half of the prism's extent along z, in length units.
fn separation_from_prism(
    a: &PosedSolid<'_>,
    shape: &VerticalSolid,
    prism: &PosedSolid<'_>,
    half: f32,
) -> (f32, [f32; 3]) {
    let standing = PosedVertical::new(a, shape);
    if shape.rounding == 0.0 {
        return match &prism.sheared_box {
            Some(slanted) => vertical_sheared_box::best_separating_axis(standing, slanted),
            None => vertical_prism::best_separating_axis(standing, &PosedPrism::new(prism, half)),
        };
    }
    let [ball, _] = nearest_spheres(prism, a, shape, 0.0);
    let [x, y] = ball.shape_centre();
    let found = match &prism.sheared_box {
        Some(slanted) => slanted
            .nearest(Vector3::new(x, y, ball.z))
            .map(|(distance, normal)| (distance - shape.rounding, [normal.x, normal.y], normal.z)),
        None => prism_sphere_distance(*prism, half, ball, [0.0; 3], 0.0, f32::MAX),
    };
    found.map_or((f32::MAX, [0.0, 1.0, 0.0]), |(apart, [x, y], z)| (apart, [-x, -y, -z]))
}

/// Returns the contact manifold of the ground (A) and a vertical shape (B), with one point below the centre of the shape.
fn vertical_ground(
    ground: PosedSolid<'_>,
    b: PosedSolid<'_>,
    shape: &VerticalSolid,
    contact_margin: f32,
) -> Manifold {
    let [x, y, z] = PosedVertical::new(&b, shape).position;
    let separation = -(y + shape.half_height + shape.rounding);
    let point = difference([x, -0.5 * separation], translation(ground.pose));
    let mut found = Manifold::single_point([0.0, -1.0], point, separation, 0, contact_margin);
    found.points_z[0] = z - ground.z;
    found
}

/// Returns the contact manifold of a prism or a sheared box (A) and a capsule (B). One or two spheres on the capsule's axis
/// stand for the capsule; two spheres give a flat side two contact points. `half` is half of the prism's extent along z, in
/// length units.
fn capsule_prism(
    prism: PosedSolid<'_>,
    half: f32,
    (capsule, shape): (PosedSolid<'_>, &VerticalSolid),
    previous: PreviousAxis,
    margins: ContactMargins,
) -> Manifold {
    let before = if previous == PreviousAxis::NoContact { previous } else { PreviousAxis::Plane };
    let touch = |ball: PosedSolid<'_>| {
        let mut found = match &prism.sheared_box {
            Some(slanted) => sheared_box::collide_sphere(slanted, prism, ball, margins.contact_margin),
            None => prism_sphere(prism, half, ball, before, margins.contact_margin),
        };
        found.points_z[0] = ball.z - found.normal_z * shape.rounding - prism.z;
        found
    };
    let [upper, lower] =
        nearest_spheres(&prism, &capsule, shape, FLAT_SIDE_MAX_LEAN * margins.contact_margin);
    let mut found = touch(upper);
    if upper.outline.shape.centre == lower.outline.shape.centre {
        return found;
    }
    let other = touch(lower);
    if found.count == 0 {
        return other;
    }
    let normal = |of: &Manifold| [of.normal[0], of.normal[1], of.normal_z];
    if other.count > 0 && dot3(normal(&found), normal(&other)) > FLAT_SIDE_MIN_COSINE {
        found.count = 2;
        found.points[1] = other.points[0];
        found.points_z[1] = other.points_z[0];
        found.separations[1] = other.separations[0];
        found.features[1] = found.features[0] + 1;
    }
    found
}

/// Returns the two spheres on a capsule's axis that are nearest to a prism or a sheared box. Both are at the ends of a side
/// that lies flat, or they are equal. `flush` is the tolerance for flat sides in length units.
fn nearest_spheres<'a>(
    prism: &PosedSolid<'_>,
    capsule: &PosedSolid<'a>,
    shape: &VerticalSolid,
    flush: f32,
) -> [PosedSolid<'a>; 2] {
    let at = PosedVertical::new(capsule, shape).position;
    let heights = match &prism.sheared_box {
        Some(slanted) => {
            let distance = |y: f32| {
                let nearest = slanted.nearest(Vector3::new(at[0], y, at[2]));
                nearest.map_or(f32::MAX, |(distance, _)| distance)
            };
            vertical_prism::minimize_convex(
                at[1] - shape.half_height,
                at[1] + shape.half_height,
                flush,
                distance,
            )
        }
        None => vertical_prism::nearest_heights(prism, at, shape.half_height, flush),
    };
    heights.map(|height| capsule_sphere(*capsule, shape.rounding, height - at[1]))
}

/// Returns the sphere on a capsule's axis at the signed distance `below` under the capsule's centre. Distance and radius are in
/// length units.
fn capsule_sphere(capsule: PosedSolid<'_>, radius: f32, below: f32) -> PosedSolid<'_> {
    let mut ball = capsule;
    let [x, y] = capsule.outline.shape.centre;
    let mut shape = Shape::default();
    (shape.kind, shape.radius, shape.centre) = (ShapeKind::Circle, radius, [x, y + below]);
    ball.outline.shape = shape;
    (ball.outline.vertices, ball.outline.normals) = (&[], &[]);
    (ball.kind, ball.vertical) = (SolidKind::Sphere, None);
    ball
}
