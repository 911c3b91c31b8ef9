//! Narrow phase: the manifold of two convex shapes, at most two contact points with one normal (E. Catto, "Contact
//! Manifolds", GDC 2007).
//!
//! Circles have closed forms. Polygons use the separating axis test over edge normals: the edge of largest separation is the
//! reference edge, and the incident edge of the other polygon is clipped to it.

use crate::math::lanes::smaller;
use crate::math::plane::{
    Pose, Rot, Vector, difference, dot, rotate, rotate_inverse, rotation, scaled, sum, translation,
};
use crate::parameters::broad_phase::COLLISION_MAX_COORDINATE;
use crate::parameters::narrow_phase::REFERENCE_EDGE_HYSTERESIS;
use crate::shape::ShapeRef;
use wide::f32x4;

/// Contact manifold of two shapes A and B that touch or nearly touch: at most two points with one normal.
#[derive(Debug, Clone, Copy, Default)]
pub struct Manifold {
    /// Unit contact normal from A to B, in world axes.
    pub normal: Vector,
    /// Number of contact points, 0..=2; 0 if the shapes are farther apart than the contact margin.
    pub count: usize,
    /// Points midway between the two surfaces, relative to the origin of A's body, in world axes, length units.
    pub points: [Vector; 2],
    /// Separation along the normal at each point, in length units, negative for penetration.
    pub separations: [f32; 2],
    /// Feature id of each point: the vertices or edges that touch. It identifies a point from step to step for the warm
    /// start.
    pub(crate) features: [u32; 2],
    /// Whether the reference edge, whose normal is the contact normal, belongs to B.
    pub(crate) is_reference_on_b: bool,
    /// Component of the unit normal along the depth axis, -1 to 1; 0 in 2D.
    pub(crate) normal_z: f32,
    /// Root mean square distance of the points of the contact patch from its middle, in length units, >= 0, if the normal is
    /// along z; else 0.
    pub(crate) patch_radius: f32,
    /// Z of each point minus z of A's body, in length units. Set only for contacts whose lever arms depend on z.
    pub(crate) points_z: [f32; 2],
    /// Lower bound of the distance of the two shapes in length units, for a manifold without points; 0 if no bound is known.
    pub(crate) gap: f32,
}

impl Manifold {
    /// Returns a manifold without points, of shapes whose distance is at least `gap`, in length units.
    pub(crate) fn separated(gap: f32) -> Self {
        Manifold { gap, ..Manifold::default() }
    }

    /// Returns a manifold of one point, or without points if `separation` is not below `margin` (both in length units).
    pub(crate) fn single_point(
        normal: Vector,
        point: Vector,
        separation: f32,
        feature: u32,
        margin: f32,
    ) -> Self {
        Manifold {
            normal,
            count: usize::from(separation < margin),
            points: [point, [0.0; 2]],
            separations: [separation, 0.0],
            features: [feature, 0],
            gap: separation,
            ..Manifold::default()
        }
    }

    /// Converts a manifold from the frame of A's body to world axes. `qa` is the rotation of A: cosine and sine.
    #[inline(always)]
    pub(crate) fn to_world(mut self, qa: Rot) -> Self {
        self.normal = rotate(qa, self.normal);
        self.points = self.points.map(|point| rotate(qa, point));
        self
    }

    /// Converts a manifold of B against A, in the frame of B's body, to one of A against B in world axes. `qb` is the rotation
    /// of B (cosine, sine), and `offset` the world vector from the origin of A's body to that of B, in length units.
    #[inline(always)]
    pub(crate) fn to_world_flipped(mut self, qb: Rot, offset: Vector) -> Self {
        self.normal = rotate(qb, scaled(self.normal, -1.0));
        self.points = self.points.map(|point| sum(rotate(qb, point), offset));
        self.features = self.features.map(|feature| feature.rotate_left(16));
        self.is_reference_on_b = true;
        self
    }

    /// Exchanges A and B in a manifold in world axes: reverses the normal and makes the points relative to the body of B.
    pub(crate) fn flip(mut self, pose_a: Pose, pose_b: Pose) -> Self {
        let offset = difference(translation(pose_a), translation(pose_b));
        self.normal = scaled(self.normal, -1.0);
        self.points = self.points.map(|point| sum(point, offset));
        self
    }
}

impl Manifold {
    /// Returns whether the manifold has points, and all coordinates and separations are below [`COLLISION_MAX_COORDINATE`] in
    /// magnitude.
    #[inline(always)]
    pub(crate) fn has_finite_contact(&self) -> bool {
        let points = self.points[..self.count].iter().flatten();
        self.count > 0
            && points
                .chain(&self.separations[..self.count])
                .all(|number| number.abs() < COLLISION_MAX_COORDINATE)
    }

    /// Reduces the manifold to at most `max_count` points (1 or 2), the ones of deepest penetration.
    #[inline(always)]
    pub(crate) fn keep_deepest(&mut self, max_count: usize) {
        if self.count > max_count {
            if self.separations[1] < self.separations[0] {
                self.points.swap(0, 1);
                self.separations.swap(0, 1);
                self.features.swap(0, 1);
                self.points_z.swap(0, 1);
            }
            self.count = max_count;
            self.gap = 0.0;
        }
    }
}

/// Returns the manifold of two circles: at most one point, on the line of centres. `margin`: contact margin in length units.
pub(super) fn circles(a: ShapeRef<'_>, b: ShapeRef<'_>, pose_a: Pose, pose_b: Pose, margin: f32) -> Manifold {
    let arm = rotate(rotation(pose_a), a.shape.centre);
    let centre_b = sum(translation(pose_b), rotate(rotation(pose_b), b.shape.centre));
    let d = difference(difference(centre_b, translation(pose_a)), arm);
    let squared = dot(d, d);
    let distance = squared.sqrt();
    // Coincident centres have no direction; the normal is along y.
    let normal = if squared > f32::MIN_POSITIVE { scaled(d, 1.0 / distance) } else { [0.0, 1.0] };
    let separation = distance - a.shape.radius - b.shape.radius;
    let point = sum(arm, scaled(normal, a.shape.radius + 0.5 * separation));
    Manifold::single_point(normal, point, separation, 0, margin)
}

/// Returns the manifold of two approaching circles at their time of impact; `None` if the circles do not approach each other.
///
/// `offset` (length units) leads from centre A to centre B, and d = `displacement` is the motion of B relative to A in this
/// step (length units). The time t, a fraction of the step, solves |offset + t d| = rA + rB. If the circles miss each other, t
/// is the time of their smallest distance. It is clamped to -1..=2, since the last relaxation of a step looks one substep
/// beyond it.
///
/// The separation is the distance that the motion along the normal covers until t.
pub(crate) fn circles_at_toi(
    offset: Vector,
    displacement: Vector,
    [radius_a, radius_b]: [f32; 2],
) -> Option<Manifold> {
    let radii = radius_a + radius_b;
    let (approach, squared) = (-dot(offset, displacement), dot(displacement, displacement));
    if !(approach > 0.0 && squared > f32::MIN_POSITIVE) {
        return None;
    }
    let under_root = approach * approach - squared * (dot(offset, offset) - radii * radii);
    let nearest = approach - if under_root > 0.0 { under_root.sqrt() } else { 0.0 };
    let fraction = (nearest / squared).clamp(-1.0, 2.0);
    let offset_at_toi = sum(offset, scaled(displacement, fraction));
    let distance = dot(offset_at_toi, offset_at_toi).sqrt();
    let normal = scaled(offset_at_toi, 1.0 / distance);
    let separation = distance - radii - fraction * dot(displacement, normal);
    let point = scaled(normal, radius_a + 0.5 * separation);
    (distance > 0.0).then(|| Manifold::single_point(normal, point, separation, 0, f32::MAX))
}

/// Returns the manifold of a polygon A and a circle B: at most one point, at the closest edge or vertex of A.
pub(super) fn polygon_and_circle(
    a: ShapeRef<'_>,
    b: ShapeRef<'_>,
    pose_a: Pose,
    pose_b: Pose,
    margin: f32,
) -> Manifold {
    let rotation_a = rotation(pose_a);
    let centre_b =
        sum(difference(translation(pose_b), translation(pose_a)), rotate(rotation(pose_b), b.shape.centre));
    let centre = rotate_inverse(rotation_a, centre_b);
    let (mut best, mut edge) = (f32::MIN, 0);
    for (i, (&point, &normal)) in a.vertices.iter().zip(a.normals).enumerate() {
        let separation = dot(normal, difference(centre, point));
        if separation > best {
            (best, edge) = (separation, i);
        }
    }
    let ends = [a.vertices[edge], a.vertices[next_index(edge, a.vertices.len())]];
    let along = difference(ends[1], ends[0]);
    let [from_first, from_second] = ends.map(|end| difference(centre, end));
    // In the Voronoi region of a vertex the vertex is closest, unless the centre is inside of the polygon or on its edge.
    let corner = if dot(from_first, along) < 0.0 {
        Some(from_first)
    } else if dot(from_second, along) > 0.0 {
        Some(from_second)
    } else {
        None
    };
    let (normal, distance) = match corner.map(|d| (d, dot(d, d).sqrt())) {
        Some((d, distance)) if best > 0.0 && distance > 0.0 => (scaled(d, 1.0 / distance), distance),
        _ => (a.normals[edge], best),
    };
    let separation = distance - b.shape.radius;
    let point = difference(centre, scaled(normal, b.shape.radius + 0.5 * separation));
    Manifold::single_point(
        rotate(rotation_a, normal),
        rotate(rotation_a, point),
        separation,
        edge as u32,
        margin,
    )
}

/// Returns the largest separation of B along the edge normals of A, and the index of that edge of A. Separations are in length
/// units, negative for penetration. `position` (length units) and `rotation_of_b` (cosine, sine) are the pose of B in the frame
/// of A.
#[inline(always)]
pub(crate) fn find_max_separation(
    a: ShapeRef<'_>,
    b: ShapeRef<'_>,
    position: Vector,
    rotation_of_b: Rot,
) -> (f32, usize) {
    if a.shape.is_box && b.shape.is_box {
        return find_max_box_separation(a, b, position, rotation_of_b);
    }
    let ([x, y], [c, s]) = (position.map(f32x4::splat), rotation_of_b.map(f32x4::splat));
    let (mut best, mut edge) = (f32::MIN, 0);
    // Four edges of A at a time.
    for (four, edges) in a.edge_lanes().iter().enumerate() {
        let ([start_x, start_y], [normal_x, normal_y]) = (edges.starts, edges.normals);
        let (x_in_b, y_in_b) = (c * normal_x + s * normal_y, c * normal_y - s * normal_x);
        let nearest = b.vertices.iter().fold(f32x4::splat(f32::MAX), |nearest, v| {
            smaller(x_in_b * f32x4::splat(v[0]) + y_in_b * f32x4::splat(v[1]), nearest)
        });
        let separations = nearest + (normal_x * (x - start_x) + normal_y * (y - start_y));
        if separations.simd_gt(f32x4::splat(best)).none() {
            continue;
        }
        for (lane, separation) in separations.to_array().into_iter().enumerate() {
            if separation > best {
                (best, edge) = (separation, 4 * four + lane);
            }
        }
    }
    (best, edge)
}

/// Returns the index of the edge or vertex after `index` in a closed outline of `count` edges.
#[inline(always)]
pub(crate) fn next_index(index: usize, count: usize) -> usize {
    if index + 1 < count { index + 1 } else { 0 }
}

/// Returns the largest separation of box B along the face normals of box A, and the index of that edge of A. Separations are in
/// length units, negative for penetration. Both boxes are centred at the origins of their bodies, so half extents suffice.
/// `position` (length units) and `rotation_of_b` (cosine, sine) are the pose of B in the frame of A.
#[inline(always)]
fn find_max_box_separation(
    a: ShapeRef<'_>,
    b: ShapeRef<'_>,
    position: Vector,
    rotation_of_b: Rot,
) -> (f32, usize) {
    let (c, s) = (rotation_of_b[0].abs(), rotation_of_b[1].abs());
    let [hx, hy] = b.shape.half_extents;
    let x = position[0].abs() - a.shape.half_extents[0] - (hx * c + hy * s);
    let y = position[1].abs() - a.shape.half_extents[1] - (hx * s + hy * c);
    let (best, outward) = if x > y {
        (x, [if position[0] > 0.0 { 1.0 } else { -1.0 }, 0.0])
    } else {
        (y, [0.0, if position[1] > 0.0 { 1.0 } else { -1.0 }])
    };
    let edge = (0..4).find(|&i| dot(a.normals[i], outward) > 0.5).unwrap_or(0);
    (best, edge)
}

/// Returns the incident edge: the index of the edge whose normal is most opposed to `direction`, a vector in the frame of the
/// shape.
pub(crate) fn find_incident_edge(shape: ShapeRef<'_>, direction: Vector) -> usize {
    let (mut best, mut edge) = (f32::MAX, 0);
    for (i, &normal) in shape.normals.iter().enumerate() {
        let d = dot(normal, direction);
        if d < best {
            (best, edge) = (d, i);
        }
    }
    edge
}

/// Returns the manifold of two polygons, by separating axis test and clipping. `margin`: contact margin in length units.
pub(super) fn polygons(
    a: ShapeRef<'_>,
    b: ShapeRef<'_>,
    pose_a: Pose,
    pose_b: Pose,
    margin: f32,
) -> Manifold {
    let (qa, qb) = (rotation(pose_a), rotation(pose_b));
    let offset = difference(translation(pose_b), translation(pose_a));
    let (position, rotation_of_b) = (rotate_inverse(qa, offset), rotate_inverse(qa, qb));
    let (separation_a, edge_a) = find_max_separation(a, b, position, rotation_of_b);
    if separation_a > margin {
        return Manifold::separated(separation_a);
    }
    let (position_back, rotation_back) =
        (rotate_inverse(rotation_of_b, scaled(position, -1.0)), [rotation_of_b[0], -rotation_of_b[1]]);
    let (separation_b, edge_b) = find_max_separation(b, a, position_back, rotation_back);
    if separation_b > margin {
        return Manifold::separated(separation_b);
    }
    // The hysteresis keeps the reference edge on A where both are about as good.
    if separation_b > separation_a + REFERENCE_EDGE_HYSTERESIS * margin {
        clip_to_edge(b, a, position_back, rotation_back, edge_b, margin).to_world_flipped(qb, offset)
    } else {
        clip_to_edge(a, b, position, rotation_of_b, edge_a, margin).to_world(qa)
    }
}

/// Clips the incident edge of B to the side planes of a reference edge of A. The returned manifold is in the frame of A's body.
/// `position` (length units) and `rotation_of_b` (cosine, sine) are the pose of B in that frame.
pub(crate) fn clip_to_edge(
    a: ShapeRef<'_>,
    b: ShapeRef<'_>,
    position: Vector,
    rotation_of_b: Rot,
    edge: usize,
    margin: f32,
) -> Manifold {
    let normal = a.normals[edge];
    let other = find_incident_edge(b, rotate_inverse(rotation_of_b, normal));
    let (next, other_next) = (next_index(edge, a.vertices.len()), next_index(other, b.vertices.len()));
    let (start, end) = (a.vertices[edge], a.vertices[next]);
    let in_a = |point: Vector| sum(rotate(rotation_of_b, point), position);
    let (upper, lower) = (in_a(b.vertices[other]), in_a(b.vertices[other_next]));
    let tangent = [-normal[1], normal[0]];
    let along = |point: Vector| dot(difference(point, start), tangent);
    let (length, upper_at, lower_at) = (along(end), along(upper), along(lower));
    if upper_at < 0.0 || length < lower_at {
        return Manifold::separated(0.0);
    }
    let span = upper_at - lower_at;
    let between = |fraction: f32| sum(lower, scaled(difference(upper, lower), fraction));
    let has_length = span > 1e-6 * length;
    let low = if lower_at < 0.0 && has_length { between(-lower_at / span) } else { lower };
    let high = if upper_at > length && has_length { between((length - lower_at) / span) } else { upper };
    let feature = |corner: usize, other_corner: usize| ((corner as u32) << 16) | other_corner as u32;
    let mut manifold = Manifold { normal, ..Manifold::default() };
    for (point, feature) in [(low, feature(edge, other_next)), (high, feature(next, other))] {
        let separation = dot(difference(point, start), normal);
        if separation < margin {
            manifold.points[manifold.count] = difference(point, scaled(normal, 0.5 * separation));
            manifold.separations[manifold.count] = separation;
            manifold.features[manifold.count] = feature;
            manifold.count += 1;
        }
    }
    manifold
}
