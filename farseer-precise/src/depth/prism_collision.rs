//! Narrow phase in three axes: prisms along z, spheres and the ground. Vertical shapes are in `vertical_dispatch`.
//!
//! Two prisms touch in the plane or along z, never obliquely. The axis is the last-entered axis: the one along which they began
//! to overlap last, by the displacements of the last step. It persists while they touch.
//!
//! Flush faces win over this rule: a body rests on a flush face or slides along it, and the face of a neighbouring solid at the
//! end of that flush face is no wall. Otherwise every seam of a floor would stop bodies that slide over the floor (ghost
//! collision). Spheres use the closest point, also at rims.
//!
//! Reads poses, shapes and displacements; returns a manifold with points relative to the position of body A.

use super::contact_patch::{ContactPatch, intersect_outlines};
use super::posed_solid::{
    ContactMargins, PosedSolid, PreviousAxis, SolidKind, flip_manifold, min_separation,
};
use super::predicted_miss::{will_miss_corner, will_miss_face};
use super::sphere_sphere::{self, Sphere};
use super::{sheared_box, vertical_dispatch};
use crate::math::plane::{
    Vector, difference, dot, length, rotate, rotate_inverse, rotation, scaled, sum, translation,
};
use crate::narrow_phase::manifold::{Manifold, clip_to_edge, find_max_separation};
use crate::narrow_phase::shape_dispatch::collide;
use crate::parameters::depth::{GRAZED_RIM_OVERLAP, PRISM_ENTRY_MAX_AGE, RIM_SECANT_STEPS};
use crate::shape::ShapeRef;

/// Returns the contact manifold of A and B, with points relative to the position of body A. A is the less movable body.
pub(super) fn collide_solids(
    a: PosedSolid<'_>,
    b: PosedSolid<'_>,
    previous: PreviousAxis,
    margins: ContactMargins,
) -> Manifold {
    match (a.kind, b.kind) {
        (SolidKind::Vertical, _) | (_, SolidKind::Vertical) => {
            vertical_dispatch::collide_with_vertical(a, b, previous, margins)
        }
        (SolidKind::Ground, SolidKind::Sphere) => sphere_ground(a, b, margins.contact_margin),
        (SolidKind::Ground, _) => prism_ground(a, b, margins.contact_margin),
        (SolidKind::Sphere, SolidKind::Sphere) => sphere_sphere::collide_spheres(
            Sphere::of(a),
            Sphere::of(b),
            previous == PreviousAxis::NoContact,
            margins.contact_margin,
        ),
        (SolidKind::Sphere, SolidKind::Prism(half)) => {
            flip_manifold(prism_sphere(b, half, a, previous.flipped(), margins.contact_margin), b, a)
        }
        (SolidKind::Prism(half), SolidKind::Sphere) => match &a.sheared_box {
            Some(shape) => sheared_box::collide_sphere(shape, a, b, margins.contact_margin),
            None => prism_sphere(a, half, b, previous, margins.contact_margin),
        },
        (SolidKind::Prism(half_a), SolidKind::Prism(half_b)) => {
            prism_prism(a, b, half_a + half_b, previous, margins)
        }
        // A body below the ground has no contact.
        (_, SolidKind::Ground) => Manifold::separated(0.0),
    }
}
/// Returns the sign of z of B relative to A before the last step: 1 or -1.
fn depth_side(a: PosedSolid<'_>, b: PosedSolid<'_>) -> f32 {
    let motion = b.last_displacement[2] - a.last_displacement[2];
    let was = b.z - a.z - motion;
    if was > 0.0 || (was == 0.0 && motion < 0.0) { 1.0 } else { -1.0 }
}

/// Returns the contact manifold of two prisms. `half_depths` is the sum of their half extents along z, in length units.
fn prism_prism(
    a: PosedSolid<'_>,
    b: PosedSolid<'_>,
    half_depths: f32,
    previous: PreviousAxis,
    margins: ContactMargins,
) -> Manifold {
    let side = if let PreviousAxis::Depth(side) = previous { side } else { depth_side(a, b) };
    // Solids that have passed through each other are separated, too.
    let apart = (b.z - a.z).abs() - half_depths;
    if apart > margins.contact_margin {
        return Manifold::separated(apart);
    }
    let gap = side * (b.z - a.z) - half_depths;
    let plane = collide_in_plane(a, b, half_depths, margins);
    if plane.count == 0 {
        return plane;
    }
    let apart = min_separation(&plane);
    let is_in_plane = match previous {
        PreviousAxis::Plane if gap <= 0.0 => true,
        PreviousAxis::Depth(_) if apart <= 0.0 => false,
        _ if gap > 0.0 || apart > 0.0 => {
            // Not overlapping yet: they collide along the axis of separation, once the other axis overlaps.
            let is_beside = (gap <= 0.0 && gap < -margins.flush_overlap)
                || (apart <= 0.0 && apart < -margins.flush_overlap);
            if !is_beside || will_miss_corner(a, b, side, (apart, gap), &plane) {
                return Manifold::separated(0.0);
            }
            apart > 0.0
        }
        // Flush along both axes: undecided until the next step.
        _ if gap >= -margins.flush_overlap && apart >= -margins.flush_overlap => {
            return Manifold::separated(0.0);
        }
        _ => last_entered_in_plane(a, b, side, gap, &plane, margins),
    };
    if is_in_plane { plane } else { face_face_z(a, b, side, gap) }
}

/// Returns the contact manifold of two outlines in the plane. A flush face takes precedence over the edge of least penetration.
/// `half_depths` is the sum of the half extents along z, in length units.
fn collide_in_plane(
    a: PosedSolid<'_>,
    b: PosedSolid<'_>,
    half_depths: f32,
    margins: ContactMargins,
) -> Manifold {
    if let Some(shape) = a.sheared_box {
        let half = half_depths - shape.half[2];
        let within = |z: f32| (z - shape.centre.z).clamp(-shape.half[2], shape.half[2]) + shape.centre.z;
        let (corners, outline) = sheared_box::outline_between(&shape, within(b.z - half), within(b.z + half));
        let swept = PosedSolid {
            outline: corners.shape_ref(outline),
            pose: [a.pose[0], a.pose[1], 1.0, 0.0],
            sheared_box: None,
            ..a
        };
        return sheared_box::to_sheared_normal(collide_in_plane(swept, b, half_depths, margins), &shape);
    }
    match flush_face(a, b, margins) {
        Some((edge, at, q)) => {
            clip_to_edge(a.outline, b.outline, at, q, edge, margins.contact_margin).to_world(rotation(a.pose))
        }
        None => {
            let found = collide(a.outline, b.outline, a.pose, b.pose, margins.contact_margin);
            if will_miss_face(a, b, &found) { Manifold::separated(0.0) } else { found }
        }
    }
}

/// Returns the flush face of A that B slides along: edge index of A, position of B in the frame of A (length units), and
/// rotation of B relative to A (cosine, sine). `None` if B slides along the edge of least penetration itself, or no other face
/// is flush. So a seam between floors or the foot of a slope is no wall. Flushness is tested at the predicted touch. The edge
/// most parallel to the relative displacement wins.
fn flush_face(
    a: PosedSolid<'_>,
    b: PosedSolid<'_>,
    margins: ContactMargins,
) -> Option<(usize, Vector, [f32; 2])> {
    if !(a.outline.shape.is_plain_polygon() && b.outline.shape.is_plain_polygon()) {
        return None;
    }
    let (qa, qb) = (rotation(a.pose), rotation(b.pose));
    let apart = difference(translation(b.pose), translation(a.pose));
    let (at, q) = (rotate_inverse(qa, apart), rotate_inverse(qa, qb));
    let (of_a, edge) = find_max_separation(a.outline, b.outline, at, q);
    let (of_b, other) = find_max_separation(
        b.outline,
        a.outline,
        rotate_inverse(qb, scaled(apart, -1.0)),
        rotate_inverse(qb, qa),
    );
    let (best, normal, edge) = if of_b > of_a {
        (of_b, scaled(rotate(q, b.outline.normals[other]), -1.0), None)
    } else {
        (of_a, a.outline.normals[edge], Some(edge))
    };
    if best > margins.contact_margin || best < -margins.flush_overlap {
        return None;
    }
    let displacement = rotate_inverse(
        qa,
        [
            b.predicted_displacement[0] - a.predicted_displacement[0],
            b.predicted_displacement[1] - a.predicted_displacement[1],
        ],
    );
    let closing = -dot(displacement, normal);
    let arrival = if best > 0.0 && closing > 0.0 { scaled(displacement, best / closing) } else { [0.0; 2] };
    let is_flush = |&one: &usize| {
        let (point, normal) = (a.outline.vertices[one], a.outline.normals[one]);
        let along = rotate_inverse(q, normal);
        let nearest = b.outline.vertices.iter().map(|&corner| dot(along, corner));
        let nearest = nearest.fold(f32::MAX, |least, one| if one < least { one } else { least });
        let apart = nearest + dot(normal, sum(difference(at, point), arrival));
        Some(one) != edge && apart.abs() <= margins.flush_overlap
    };
    let across = |edge: usize| dot(displacement, a.outline.normals[edge]).abs();
    let flush = (0..a.outline.vertices.len()).filter(is_flush);
    let slid_along = flush.min_by(|&one, &other| across(one).total_cmp(&across(other)))?;
    let keeps = edge.is_some_and(|edge| across(edge) <= across(slid_along));
    (!keeps).then_some((slid_along, at, q))
}

/// Returns whether two overlapping prisms, which did not touch before, began to overlap in the plane later than along z.
fn last_entered_in_plane(
    a: PosedSolid<'_>,
    b: PosedSolid<'_>,
    side: f32,
    gap: f32,
    plane: &Manifold,
    margins: ContactMargins,
) -> bool {
    let apart = min_separation(plane);
    if apart >= -margins.flush_overlap || gap >= -margins.flush_overlap {
        return apart >= -margins.flush_overlap;
    }
    let motion: [f32; 3] = std::array::from_fn(|axis| b.last_displacement[axis] - a.last_displacement[axis]);
    if motion[2] == 0.0 {
        return true;
    }
    let since = |overlap: f32, closing: f32| {
        let steps = if closing > 0.0 { overlap / closing } else { f32::INFINITY };
        if steps <= PRISM_ENTRY_MAX_AGE { steps } else { f32::INFINITY }
    };
    let in_plane = since(-apart, -dot([motion[0], motion[1]], plane.normal));
    let along_depth = since(-gap, -side * motion[2]);
    if in_plane == along_depth { apart > gap } else { in_plane < along_depth }
}

/// Returns the contact manifold of two faces perpendicular to z: one point at the centroid of the contact patch. `side` is the
/// sign of the normal along z, `separation` is in length units.
fn face_face_z(a: PosedSolid<'_>, b: PosedSolid<'_>, side: f32, separation: f32) -> Manifold {
    let shift = a.sheared_box.map_or([0.0; 2], |shape| {
        let shift = shape.shift(side * shape.half[2]);
        [shift.x, shift.y]
    });
    let pose = [a.pose[0] + shift[0], a.pose[1] + shift[1], a.pose[2], a.pose[3]];
    let Some(ContactPatch { centroid: middle, gyration_radius: spread }) =
        intersect_outlines(a.outline, pose, b.outline, b.pose)
    else {
        return Manifold::separated(0.0);
    };
    let mut found =
        Manifold::single_point([0.0; 2], difference(middle, translation(a.pose)), separation, 0, f32::MAX);
    (found.normal_z, found.patch_radius) = (side, spread);
    found
}

/// Returns the contact manifold of a prism (A) and a sphere (B). The sphere touches the outline in the plane, an end face along
/// z, or a rim obliquely. `half_depth` is half of the prism's extent along z, in length units.
pub(super) fn prism_sphere(
    prism: PosedSolid<'_>,
    half_depth: f32,
    ball: PosedSolid<'_>,
    previous: PreviousAxis,
    contact_margin: f32,
) -> Manifold {
    let radius = ball.outline.shape.radius;
    let [x, y] = ball.shape_centre();
    let mut point = ball.outline;
    (point.shape.radius, point.shape.centre) = (0.0, [0.0; 2]);
    let plane = collide(prism.outline, point, prism.pose, [x, y, 1.0, 0.0], contact_margin + radius);
    if plane.count == 0 {
        return Manifold::separated(gap_beyond_radius(plane.gap, radius));
    }
    let separation_in_plane = plane.separations[0];
    let side = match previous {
        PreviousAxis::Depth(side) if side * (ball.z - prism.z) + half_depth + radius > 0.0 => side,
        _ => depth_side(prism, ball),
    };
    let gap = side * (ball.z - prism.z) - half_depth;
    let (mut normal, mut normal_z, distance) = if separation_in_plane > 0.0 && gap > 0.0 {
        let distance = length([separation_in_plane, gap]);
        (scaled(plane.normal, separation_in_plane / distance), side * gap / distance, distance)
    } else if leaves_in_plane(separation_in_plane, gap, previous) {
        (plane.normal, 0.0, separation_in_plane)
    } else {
        ([0.0; 2], side, gap)
    };
    let mut separation = distance - radius;
    if separation > contact_margin {
        return Manifold::separated(separation);
    }
    let is_on_rim = separation_in_plane > 0.0 && (gap > 0.0 || is_vertex_normal(prism, &plane));
    if separation > 0.0 && is_on_rim {
        let Some(touch) = rim_time_of_impact(prism, half_depth, ball, separation, contact_margin) else {
            return Manifold::separated(0.0);
        };
        (separation, normal, normal_z) = touch;
    }
    let arm = difference([x, y], translation(prism.pose));
    let point = difference(arm, scaled(normal, radius + 0.5 * separation));
    let mut found = Manifold::single_point(normal, point, separation, 0, f32::MAX);
    found.normal_z = normal_z;
    found
}

/// Returns whether the normal of the planar manifold belongs to a vertex of the prism's outline, and not to an edge.
fn is_vertex_normal(prism: PosedSolid<'_>, plane: &Manifold) -> bool {
    let edge = prism.outline.normals.get(plane.features[0] as usize);
    edge.is_none_or(|&edge| dot(rotate(rotation(prism.pose), edge), plane.normal) < 0.9999)
}

/// Finds the touch of a sphere with the rim of a prism within this step, by the secant method. Returns the present distance
/// along the normal at the touch (length units), and this unit normal from prism to sphere: x and y, then z. `None` if the
/// sphere misses the rim; so the rim of the second floor does not stop a sphere that rolls over a seam.
fn rim_time_of_impact(
    prism: PosedSolid<'_>,
    half_depth: f32,
    ball: PosedSolid<'_>,
    separation: f32,
    contact_margin: f32,
) -> Option<(f32, Vector, f32)> {
    let displacement: [f32; 3] =
        std::array::from_fn(|axis| ball.predicted_displacement[axis] - prism.predicted_displacement[axis]);
    let (mut before, mut after) = (
        (0.0, separation),
        (1.0, prism_sphere_distance(prism, half_depth, ball, displacement, 1.0, contact_margin)?.0),
    );
    if after.1 > -GRAZED_RIM_OVERLAP * contact_margin {
        return None;
    }
    // The distance is convex where the outline is: the secant method converges from one side.
    let mut found = None;
    for _ in 0..RIM_SECANT_STEPS {
        let fraction = before.0 + (after.0 - before.0) * before.1 / (before.1 - after.1);
        let (distance, normal, normal_z) =
            prism_sphere_distance(prism, half_depth, ball, displacement, fraction, contact_margin)?;
        let along = displacement[0] * normal[0] + displacement[1] * normal[1] + displacement[2] * normal_z;
        found = Some((distance - fraction * along, normal, normal_z));
        if distance > 0.0 {
            before = (fraction, distance);
        } else {
            after = (fraction, distance);
        }
    }
    found
}

/// Returns the separation of a sphere from a prism after a fraction of their relative displacement (length units), and the unit
/// normal from prism to sphere: x and y, then z. `None` beyond the contact margin.
pub(super) fn prism_sphere_distance(
    prism: PosedSolid<'_>,
    half_depth: f32,
    ball: PosedSolid<'_>,
    displacement: [f32; 3],
    fraction: f32,
    contact_margin: f32,
) -> Option<(f32, Vector, f32)> {
    let radius = ball.outline.shape.radius;
    let [x, y] = sum(ball.shape_centre(), [fraction * displacement[0], fraction * displacement[1]]);
    let mut point = ball.outline;
    (point.shape.radius, point.shape.centre) = (0.0, [0.0; 2]);
    let plane = collide(prism.outline, point, prism.pose, [x, y, 1.0, 0.0], contact_margin + radius);
    if plane.count == 0 {
        return None;
    }
    let apart = plane.separations[0];
    let behind = ball.z + fraction * displacement[2] - prism.z;
    let side = if behind < 0.0 { -1.0 } else { 1.0 };
    let gap = behind.abs() - half_depth;
    Some(if apart > 0.0 && gap > 0.0 {
        let distance = length([apart, gap]);
        (distance - radius, scaled(plane.normal, apart / distance), side * gap / distance)
    } else if apart >= gap {
        (apart - radius, plane.normal, 0.0)
    } else {
        (gap - radius, [0.0; 2], side)
    })
}

/// Returns the excess of a gap over a radius, in length units, >= 0.
fn gap_beyond_radius(gap: f32, radius: f32) -> f32 {
    if gap > radius { gap - radius } else { 0.0 }
}

/// Returns whether contact pushes a sphere out of a prism along a normal in the plane, and not along z. A sphere whose centre
/// is inside of the prism leaves along the axis of the last contact.
fn leaves_in_plane(separation: f32, gap: f32, previous: PreviousAxis) -> bool {
    match previous {
        PreviousAxis::Plane if separation <= 0.0 && gap <= 0.0 => true,
        PreviousAxis::Depth(_) if separation <= 0.0 && gap <= 0.0 => false,
        _ => separation >= gap,
    }
}

/// Upward unit normal of the ground in x and y (down). Dimensionless.
const UP: Vector = [0.0, -1.0];

/// Returns the contact manifold of the ground (A) and a sphere (B), with one point below the centre of the sphere.
fn sphere_ground(ground: PosedSolid<'_>, ball: PosedSolid<'_>, contact_margin: f32) -> Manifold {
    let ([x, y], radius) = (ball.shape_centre(), ball.outline.shape.radius);
    let separation = -(y + radius);
    let point = difference([x, 0.5 * (y + radius)], translation(ground.pose));
    Manifold::single_point(UP, point, separation, 0, contact_margin)
}

/// Returns the contact manifold of the ground (A) and a prism (B). The contact points lie below the lowest vertex and the lower
/// one of its two neighbours; a rounded outline adds its radius.
fn prism_ground(ground: PosedSolid<'_>, b: PosedSolid<'_>, contact_margin: f32) -> Manifold {
    let ShapeRef { shape, vertices: points, .. } = b.outline;
    let q = rotation(b.pose);
    let height = |corner: Vector| b.pose[1] + q[1] * corner[0] + q[0] * corner[1] + shape.radius;
    if points.is_empty() {
        return sphere_ground(ground, b, contact_margin);
    }
    let lower =
        |one: usize, other: usize| if height(points[other]) > height(points[one]) { other } else { one };
    let first = (1..points.len()).fold(0, lower);
    let count = points.len();
    let second = lower((first + count - 1) % count, (first + 1) % count);
    let mut found = Manifold { normal: UP, gap: -height(points[first]), ..Manifold::default() };
    for corner in [first, second] {
        let separation = -height(points[corner]);
        if separation < contact_margin && (found.count == 0 || second != first) {
            let at = sum(translation(b.pose), rotate(q, points[corner]));
            found.points[found.count] = difference([at[0], -0.5 * separation], translation(ground.pose));
            found.separations[found.count] = separation;
            found.features[found.count] = corner as u32;
            found.count += 1;
        }
    }
    found
}
