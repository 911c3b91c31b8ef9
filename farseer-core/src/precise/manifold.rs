//! Where two convex outlines touch: at most two points, by closed forms for circles and by clipping for polygons (E. Catto,
//! "Contact Manifolds", GDC 2007).

use super::meeting::Meeting;
use super::outline::{Family, Outline};
use super::{round, seams};
use crate::math::plane::{
    Pose, Turn, Vector, difference, dot, place, rotation, scaled, sum, turn, turn_back,
};
use crate::precise::parameters::broad_phase::COLLISION_RANGE;
use crate::precise::parameters::narrow_phase::REFERENCE_EDGE_HYSTERESIS;

/// Where two outlines touch or nearly do.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct Manifold {
    /// Unit normal from A to B.
    pub(super) normal: Vector,
    /// Number of points; 0 if they are further apart than contacts reach.
    pub(super) count: usize,
    /// Midway between the outlines, relative to the origin of A's body.
    pub(super) points: [Vector; 2],
    /// Distance along the normal, negative for an overlap.
    pub(super) separations: [f32; 2],
    /// Which corners meet: names a point from one step to the next.
    pub(super) features: [u32; 2],
    /// Whether the normal is that of an edge of B.
    pub(super) is_of_b: bool,
    /// In three axes: part of the normal along the depth axis, and how far from its point a face that presses along that has its
    /// pressure.
    pub(super) normal_z: f32,
    pub(super) spread: f32,
    /// And where the points are along that, relative to A: where it matters.
    pub(super) depths: [f32; 2],
    /// If there are no points: the outlines are at least this far apart, or this is 0.
    pub(super) gap: f32,
}

impl Manifold {
    pub(super) fn apart(gap: f32) -> Self {
        Manifold { gap, ..Manifold::default() }
    }

    pub(super) fn of_point(normal: Vector, point: Vector, separation: f32, feature: u32, reach: f32) -> Self {
        Manifold {
            normal,
            count: usize::from(separation < reach),
            points: [point, [0.0; 2]],
            separations: [separation, 0.0],
            features: [feature, 0],
            gap: separation,
            ..Manifold::default()
        }
    }

    /// What was found in the frame of A, in that of the world.
    #[inline(always)]
    pub(super) fn turned(mut self, qa: Turn) -> Self {
        self.normal = turn(qa, self.normal);
        self.points = self.points.map(|point| turn(qa, point));
        self
    }

    /// What was found in the frame of B as that of B against A, in that of the world; B's origin is so far from A's.
    #[inline(always)]
    pub(super) fn turned_from_b(mut self, qb: Turn, apart: Vector) -> Self {
        self.normal = turn(qb, scaled(self.normal, -1.0));
        self.points = self.points.map(|point| sum(turn(qb, point), apart));
        self.features = self.features.map(|feature| feature.rotate_left(16));
        self.is_of_b = true;
        self
    }

    /// B against A, of what was found as A against B.
    pub(super) fn flipped(mut self, pose_a: Pose, pose_b: Pose) -> Self {
        let apart = difference(place(pose_a), place(pose_b));
        self.normal = scaled(self.normal, -1.0);
        self.points = self.points.map(|point| sum(point, apart));
        self
    }
}

impl Manifold {
    /// Whether there are points, and all of them where squares of distances end not yet.
    #[inline(always)]
    pub(super) fn is_within_reach(&self) -> bool {
        let points = self.points[..self.count].iter().flatten();
        self.count > 0
            && points.chain(&self.separations[..self.count]).all(|number| number.abs() < COLLISION_RANGE)
    }

    /// Leaves so many points at most, the deepest.
    #[inline(always)]
    pub(super) fn keep_deepest(&mut self, most: usize) {
        if self.count > most {
            if self.separations[1] < self.separations[0] {
                self.points.swap(0, 1);
                self.separations.swap(0, 1);
                self.features.swap(0, 1);
                self.depths.swap(0, 1);
            }
            self.count = most;
            self.gap = 0.0;
        }
    }
}

/// The contacts of A and B, as far as `reach` apart.
pub(super) fn collide(a: Outline<'_>, b: Outline<'_>, pose_a: Pose, pose_b: Pose, reach: f32) -> Manifold {
    use Family::{Capsule, Circle, Polygon, Seamed};
    match (a.shape.family, b.shape.family) {
        (Circle, Circle) => circles(a, b, pose_a, pose_b, reach),
        (Circle, Polygon) => polygon_and_circle(b, a, pose_b, pose_a, reach).flipped(pose_b, pose_a),
        (Polygon, Circle) => polygon_and_circle(a, b, pose_a, pose_b, reach),
        (Polygon, Polygon) => polygons(a, b, pose_a, pose_b, reach),
        (Circle, Capsule) => round::capsule_and_circle(b, a, pose_b, pose_a, reach).flipped(pose_b, pose_a),
        (Capsule, Circle) => round::capsule_and_circle(a, b, pose_a, pose_b, reach),
        (Circle, Seamed) => seams::circle(b, a, pose_b, pose_a, reach).flipped(pose_b, pose_a),
        (Seamed, Circle) => seams::circle(a, b, pose_a, pose_b, reach),
        (Seamed, Capsule) | (Capsule, Seamed) => seams::capsule(&Meeting::new(a, b, pose_a, pose_b), reach),
        (Seamed, _) | (_, Seamed) => seams::polygons(&Meeting::new(a, b, pose_a, pose_b), reach),
        (Capsule, _) | (_, Capsule) => round::capsule(&Meeting::new(a, b, pose_a, pose_b), reach),
    }
}

fn circles(a: Outline<'_>, b: Outline<'_>, pose_a: Pose, pose_b: Pose, reach: f32) -> Manifold {
    let arm = turn(rotation(pose_a), a.shape.centre);
    let centre_b = sum(place(pose_b), turn(rotation(pose_b), b.shape.centre));
    let d = difference(difference(centre_b, place(pose_a)), arm);
    let squared = dot(d, d);
    let distance = squared.sqrt();
    // Centres in one place are pushed apart along y.
    let normal = if squared > f32::MIN_POSITIVE { scaled(d, 1.0 / distance) } else { [0.0, 1.0] };
    let separation = distance - a.shape.radius - b.shape.radius;
    let point = sum(arm, scaled(normal, a.shape.radius + 0.5 * separation));
    Manifold::of_point(normal, point, separation, 0, reach)
}

/// The contact of circles that come together, B moving so far against A in this step: its normal is that of the moment when
/// they touch, |apart + t way| = the sum of the radii, or when they are nearest if they pass each other, from one step ago to
/// the end of the next one: the last pass of a step looks a substep beyond it. Its separation is what the way along this normal
/// uses up until then. `None` if they do not come together.
pub(super) fn circles_meet(apart: Vector, way: Vector, [radius_a, radius_b]: [f32; 2]) -> Option<Manifold> {
    let radii = radius_a + radius_b;
    let (closing, squared) = (-dot(apart, way), dot(way, way));
    if !(closing > 0.0 && squared > f32::MIN_POSITIVE) {
        return None;
    }
    let under_root = closing * closing - squared * (dot(apart, apart) - radii * radii);
    let nearest = closing - if under_root > 0.0 { under_root.sqrt() } else { 0.0 };
    let part = (nearest / squared).clamp(-1.0, 2.0);
    let then = sum(apart, scaled(way, part));
    let distance = dot(then, then).sqrt();
    let normal = scaled(then, 1.0 / distance);
    let separation = distance - radii - part * dot(way, normal);
    let point = scaled(normal, radius_a + 0.5 * separation);
    (distance > 0.0).then(|| Manifold::of_point(normal, point, separation, 0, f32::MAX))
}

fn polygon_and_circle(a: Outline<'_>, b: Outline<'_>, pose_a: Pose, pose_b: Pose, reach: f32) -> Manifold {
    let q = rotation(pose_a);
    let centre_b = sum(difference(place(pose_b), place(pose_a)), turn(rotation(pose_b), b.shape.centre));
    let centre = turn_back(q, centre_b);
    let (mut best, mut edge) = (f32::MIN, 0);
    for (i, (&point, &normal)) in a.points.iter().zip(a.normals).enumerate() {
        let separation = dot(normal, difference(centre, point));
        if separation > best {
            (best, edge) = (separation, i);
        }
    }
    let ends = [a.points[edge], a.points[(edge + 1) % a.points.len()]];
    let along = difference(ends[1], ends[0]);
    let [from_first, from_second] = ends.map(|end| difference(centre, end));
    // Beyond an end of the edge the corner is nearest, unless the centre is inside or on the edge itself.
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
    Manifold::of_point(turn(q, normal), turn(q, point), separation, edge as u32, reach)
}

/// Greatest separation of an edge of `a` from `b`, whose place and turn relative to `a` are given.
#[inline(always)]
pub(super) fn greatest_separation(a: Outline<'_>, b: Outline<'_>, at: Vector, q: Turn) -> (f32, usize) {
    if a.shape.is_box && b.shape.is_box {
        return separation_of_boxes(a, b, at, q);
    }
    let (mut best, mut edge) = (f32::MIN, 0);
    for (i, (&point, &normal)) in a.points.iter().zip(a.normals).enumerate() {
        let normal_in_b = turn_back(q, normal);
        let nearest =
            b.points.iter().map(|&v| dot(normal_in_b, v)).fold(f32::MAX, |a, b| if b < a { b } else { a });
        let separation = nearest + dot(normal, difference(at, point));
        if separation > best {
            (best, edge) = (separation, i);
        }
    }
    (best, edge)
}

/// As [`greatest_separation`], of two boxes about their origins, which needs no corners; answers the edge whose normal it is.
#[inline(always)]
fn separation_of_boxes(a: Outline<'_>, b: Outline<'_>, at: Vector, q: Turn) -> (f32, usize) {
    let (c, s) = (q[0].abs(), q[1].abs());
    let [hx, hy] = b.shape.half;
    let x = at[0].abs() - a.shape.half[0] - (hx * c + hy * s);
    let y = at[1].abs() - a.shape.half[1] - (hx * s + hy * c);
    let (best, outward) = if x > y {
        (x, [if at[0] > 0.0 { 1.0 } else { -1.0 }, 0.0])
    } else {
        (y, [0.0, if at[1] > 0.0 { 1.0 } else { -1.0 }])
    };
    let edge = (0..4).find(|&i| dot(a.normals[i], outward) > 0.5).unwrap_or(0);
    (best, edge)
}

/// The edge of `outline` that faces a direction most.
fn facing_edge(outline: Outline<'_>, against: Vector) -> usize {
    let (mut best, mut edge) = (f32::MAX, 0);
    for (i, &normal) in outline.normals.iter().enumerate() {
        let d = dot(normal, against);
        if d < best {
            (best, edge) = (d, i);
        }
    }
    edge
}

fn polygons(a: Outline<'_>, b: Outline<'_>, pose_a: Pose, pose_b: Pose, reach: f32) -> Manifold {
    let (qa, qb) = (rotation(pose_a), rotation(pose_b));
    let apart = difference(place(pose_b), place(pose_a));
    let (at, q) = (turn_back(qa, apart), turn_back(qa, qb));
    let (separation_a, edge_a) = greatest_separation(a, b, at, q);
    if separation_a > reach {
        return Manifold::apart(separation_a);
    }
    let (at_back, q_back) = (turn_back(q, scaled(at, -1.0)), [q[0], -q[1]]);
    let (separation_b, edge_b) = greatest_separation(b, a, at_back, q_back);
    if separation_b > reach {
        return Manifold::apart(separation_b);
    }
    // The edge of A is kept where both are about as good, so that it does not change with every step.
    if separation_b > separation_a + REFERENCE_EDGE_HYSTERESIS * reach {
        clip(b, a, at_back, q_back, edge_b, reach).turned_from_b(qb, apart)
    } else {
        clip(a, b, at, q, edge_a, reach).turned(qa)
    }
}

/// The part of the edge of `b` that faces an edge of `a`, between the ends of that edge. In the frame of `a`.
pub(super) fn clip(a: Outline<'_>, b: Outline<'_>, at: Vector, q: Turn, edge: usize, reach: f32) -> Manifold {
    let normal = a.normals[edge];
    let other = facing_edge(b, turn_back(q, normal));
    let (next, other_next) = ((edge + 1) % a.points.len(), (other + 1) % b.points.len());
    let (start, end) = (a.points[edge], a.points[next]);
    let in_a = |point: Vector| sum(turn(q, point), at);
    let (upper, lower) = (in_a(b.points[other]), in_a(b.points[other_next]));
    let tangent = [-normal[1], normal[0]];
    let along = |point: Vector| dot(difference(point, start), tangent);
    let (length, upper_at, lower_at) = (along(end), along(upper), along(lower));
    if upper_at < 0.0 || length < lower_at {
        return Manifold::apart(0.0);
    }
    let span = upper_at - lower_at;
    let between = |part: f32| sum(lower, scaled(difference(upper, lower), part));
    let has_length = span > 1e-6 * length;
    let low = if lower_at < 0.0 && has_length { between(-lower_at / span) } else { lower };
    let high = if upper_at > length && has_length { between((length - lower_at) / span) } else { upper };
    let feature = |corner: usize, other_corner: usize| ((corner as u32) << 16) | other_corner as u32;
    let mut found = Manifold { normal, ..Manifold::default() };
    for (point, feature) in [(low, feature(edge, other_next)), (high, feature(next, other))] {
        let separation = dot(difference(point, start), normal);
        if separation < reach {
            found.points[found.count] = difference(point, scaled(normal, 0.5 * separation));
            found.separations[found.count] = separation;
            found.features[found.count] = feature;
            found.count += 1;
        }
    }
    found
}
