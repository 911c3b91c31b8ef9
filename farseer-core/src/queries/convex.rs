//! Convex shapes in the world, in double precision, and the distance of two of them.
//!
//! The core of a shape is a point, a segment or a convex polygon; all points within its radius belong to the shape. The numbers of
//! corners are small, so that all pairs of a corner and an edge are compared (C. Ericson, *Real-Time Collision Detection*, 2005,
//! 5.1.2).

use crate::math::{Vector2, scalar};
use crate::shape::Aabb;
use farseer_precise::pieces::Piece;

/// A vector in length units.
pub(super) type Point = [f64; 2];

/// A convex shape.
#[derive(Debug, Clone)]
pub(super) struct Convex {
    /// Corners of the core, in length units: 1, 2, or a polygon in the order of positive shoelace area.
    pub(super) core: Vec<Point>,
    /// Radius about the core, in length units, >= 0.
    pub(super) radius: f64,
    /// For an edge of a chain that is solid on one side: unit normal on its free side.
    pub(super) free_side: Option<Point>,
}

/// Closest points of two convex shapes A and B.
#[derive(Debug, Clone, Copy)]
pub(super) struct Closest {
    /// Distance of the surfaces in length units; 0 or less if the shapes touch or overlap.
    pub(super) distance: f64,
    /// Unit vector from A to B.
    pub(super) normal: Point,
    /// Point on the surface of B, in length units.
    pub(super) point_b: Point,
}

/// A position and a rotation.
pub(super) struct Placement {
    position: Point,
    /// Cosine and sine of the rotation.
    turn: Point,
}

impl Placement {
    /// From a position in length units and a rotation in radians.
    pub(super) fn new((position, rotation): (Vector2, f32)) -> Self {
        let (sine, cosine) = scalar::sin_cos(rotation);
        Placement { position: point(position), turn: [f64::from(cosine), f64::from(sine)] }
    }

    pub(super) fn apply(&self, [x, y]: Point) -> Point {
        let ([c, s], [px, py]) = (self.turn, self.position);
        [px + c * x - s * y, py + s * x + c * y]
    }
}

impl Convex {
    /// A single point.
    pub(super) fn point(at: Vector2) -> Self {
        Convex { core: vec![point(at)], radius: 0.0, free_side: None }
    }

    /// A piece of a geom whose points `to_world` brings to the world. It must keep distances.
    pub(super) fn of_piece(piece: &Piece, to_world: impl Fn(Point) -> Point) -> Self {
        let mut convex = Convex { core: Vec::new(), radius: 0.0, free_side: None };
        convex.set_to_piece(piece, to_world);
        convex
    }

    /// Becomes [`of_piece`](Self::of_piece), in the memory of the former core.
    pub(super) fn set_to_piece(&mut self, piece: &Piece, to_world: impl Fn(Point) -> Point) {
        let at = |[x, y]: [f32; 2]| to_world([f64::from(x), f64::from(y)]);
        self.core.clear();
        let core = &mut self.core;
        let radius: f32 = match piece {
            Piece::Circle { centre, radius } => {
                core.push(at(*centre));
                *radius
            }
            Piece::Capsule { ends, radius } => {
                core.extend(ends.map(at));
                *radius
            }
            Piece::Polygon(corners) | Piece::Part { corners, .. } => {
                core.extend(corners.iter().map(|&c| at(c)));
                0.0
            }
            Piece::Rounded { corners, radius } => {
                core.extend(corners.iter().map(|&c| at(c)));
                *radius
            }
            Piece::Edge { ends, .. } => {
                core.extend(ends.map(at));
                0.0
            }
        };
        // A matrix of the game may mirror a geom.
        if doubled_area(core) < 0.0 {
            core.reverse();
        }
        self.radius = f64::from(radius);
        self.free_side = match piece {
            Piece::Edge { normal, back: None, .. } => {
                let origin = at([0.0; 2]);
                Some(minus(at(*normal), origin))
            }
            _ => None,
        };
    }

    /// Becomes `other` moved by `way`, in length units, in the memory of the former core.
    pub(super) fn set_to_moved(&mut self, other: &Convex, way: Point) {
        self.core.clear();
        self.core.extend(other.core.iter().map(|&corner| plus(corner, way)));
        (self.radius, self.free_side) = (other.radius, other.free_side);
    }

    /// The outward unit normals of the edges that pass within `reach` length units of a point; of an edge of a chain, that on
    /// its free side.
    pub(super) fn normals_at(&self, at: Point, reach: f64) -> impl Iterator<Item = Point> + '_ {
        let is_near = move |edge: &[Point; 2]| {
            let way = minus(nearest_on(*edge, at), at);
            dot(way, way) <= reach * reach
        };
        let normal = |edge| self.free_side.or_else(|| outward(edge));
        self.edges().filter(is_near).filter_map(normal)
    }

    /// The shape moved by `way`, in length units.
    pub(super) fn moved(&self, way: Point) -> Self {
        Convex { core: self.core.iter().map(|&corner| plus(corner, way)).collect(), ..self.clone() }
    }

    /// The middle of the core's corners, in length units.
    pub(super) fn middle(&self) -> Point {
        let sum = self.core.iter().fold([0.0; 2], |sum, &corner| plus(sum, corner));
        sum.map(|part| part / self.core.len() as f64)
    }

    /// The edges of the core; that of a segment in both directions.
    pub(super) fn edges(&self) -> impl Iterator<Item = [Point; 2]> + '_ {
        let count = if self.core.len() < 2 { 0 } else { self.core.len() };
        (0..count).map(|at| [self.core[at], self.core[(at + 1) % self.core.len()]])
    }

    /// The largest coordinate of the core along a direction.
    fn support(&self, direction: Point) -> f64 {
        self.core.iter().map(|&corner| dot(corner, direction)).fold(f64::NEG_INFINITY, f64::max)
    }

    /// The corner with the largest coordinate along a direction.
    fn support_point(&self, direction: Point) -> Point {
        let better = |best: Point, corner: Point| {
            if dot(corner, direction) > dot(best, direction) { corner } else { best }
        };
        self.core.iter().copied().reduce(better).unwrap_or_default()
    }
}

/// Returns the closest points of two shapes.
pub(super) fn closest(a: &Convex, b: &Convex) -> Closest {
    let radii = a.radius + b.radius;
    let (depth, axis) = largest_separation(a, b);
    let have_areas = a.core.len() > 2 || b.core.len() > 2 || !are_parallel(a, b);
    if have_areas && depth <= 0.0 {
        // The cores overlap: the direction of least penetration.
        let deepest = b.support_point(axis.map(|part| -part));
        return Closest {
            distance: depth - radii,
            normal: axis,
            point_b: minus(deepest, scaled(axis, b.radius)),
        };
    }
    let mut best = (f64::INFINITY, [0.0; 2], [0.0; 2]);
    let mut consider = |on_a: Point, on_b: Point| {
        let way = minus(on_b, on_a);
        let squared = dot(way, way);
        if squared < best.0 {
            best = (squared, on_a, on_b);
        }
    };
    for &corner in &b.core {
        match a.core.as_slice() {
            &[single] => consider(single, corner),
            _ => a.edges().for_each(|edge| consider(nearest_on(edge, corner), corner)),
        }
    }
    for &corner in &a.core {
        b.edges().for_each(|edge| consider(corner, nearest_on(edge, corner)));
    }
    let (squared, on_a, on_b) = best;
    let distance = squared.sqrt();
    let normal = match distance > 0.0 {
        true => scaled(minus(on_b, on_a), 1.0 / distance),
        false => unit(minus(b.middle(), a.middle())).unwrap_or(axis),
    };
    Closest { distance: distance - radii, normal, point_b: minus(on_b, scaled(normal, b.radius)) }
}

/// Returns the largest separation of the cores along the normals of their edges, in length units, and its axis from A to B.
/// Without edges it is negative infinity.
fn largest_separation(a: &Convex, b: &Convex) -> (f64, Point) {
    let mut best = (f64::NEG_INFINITY, [0.0, 1.0]);
    for normal in a.edges().filter_map(outward) {
        let apart = -b.support(normal.map(|part| -part)) - a.support(normal);
        if apart > best.0 {
            best = (apart, normal);
        }
    }
    for normal in b.edges().filter_map(outward).map(|normal| normal.map(|part| -part)) {
        let apart = -b.support(normal.map(|part| -part)) - a.support(normal);
        if apart > best.0 {
            best = (apart, normal);
        }
    }
    best
}

/// Whether two cores without areas have one direction: points have all.
fn are_parallel(a: &Convex, b: &Convex) -> bool {
    match (a.core.as_slice(), b.core.as_slice()) {
        (&[a1, a2], &[b1, b2]) => cross(minus(a2, a1), minus(b2, b1)) == 0.0,
        _ => true,
    }
}

/// Twice the shoelace area of a polygon, in length units².
fn doubled_area(corners: &[Point]) -> f64 {
    let Some(&first) = corners.first() else { return 0.0 };
    corners.windows(2).map(|edge| cross(minus(edge[0], first), minus(edge[1], first))).sum()
}

/// The outward unit normal of an edge of a polygon in the order of positive shoelace area; `None` without a length.
fn outward([from, to]: [Point; 2]) -> Option<Point> {
    let [x, y] = minus(to, from);
    unit([y, -x])
}

/// The point of a segment that is nearest to a point.
fn nearest_on([from, to]: [Point; 2], p: Point) -> Point {
    let edge = minus(to, from);
    let squared = dot(edge, edge);
    if squared == 0.0 {
        return from;
    }
    let fraction = (dot(minus(p, from), edge) / squared).clamp(0.0, 1.0);
    plus(from, scaled(edge, fraction))
}

/// The least and the largest coordinate of a shape along a unit vector, in length units.
pub(super) fn extent(shape: &Convex, direction: Point) -> (f64, f64) {
    let least = -shape.support(direction.map(|part| -part)) - shape.radius;
    (least, shape.support(direction) + shape.radius)
}

/// The box around all shapes, in length units.
pub(super) fn aabb_of(shapes: &[Convex]) -> Aabb {
    let mut bounds = [f64::INFINITY, f64::INFINITY, f64::NEG_INFINITY, f64::NEG_INFINITY];
    for shape in shapes {
        for &[x, y] in &shape.core {
            bounds[0] = bounds[0].min(x - shape.radius);
            bounds[1] = bounds[1].min(y - shape.radius);
            bounds[2] = bounds[2].max(x + shape.radius);
            bounds[3] = bounds[3].max(y + shape.radius);
        }
    }
    let [left, top, right, bottom] = bounds;
    Aabb::new(vector([left, top]), vector([right, bottom]))
}

pub(super) fn point(v: Vector2) -> Point {
    [f64::from(v.x), f64::from(v.y)]
}

pub(super) fn vector([x, y]: Point) -> Vector2 {
    Vector2::new(x as f32, y as f32)
}

pub(super) fn plus(a: Point, b: Point) -> Point {
    [a[0] + b[0], a[1] + b[1]]
}

pub(super) fn minus(a: Point, b: Point) -> Point {
    [a[0] - b[0], a[1] - b[1]]
}

pub(super) fn scaled(a: Point, factor: f64) -> Point {
    [a[0] * factor, a[1] * factor]
}

pub(super) fn dot(a: Point, b: Point) -> f64 {
    a[0] * b[0] + a[1] * b[1]
}

fn cross(a: Point, b: Point) -> f64 {
    a[0] * b[1] - a[1] * b[0]
}

/// The unit vector along `a`; `None` without a length.
fn unit(a: Point) -> Option<Point> {
    let length = dot(a, a).sqrt();
    (length > 0.0).then(|| scaled(a, 1.0 / length))
}

#[cfg(test)]
mod tests {
    use super::{Convex, Point, closest, dot};

    fn convex(core: &[Point], radius: f64) -> Convex {
        Convex { core: core.to_vec(), radius, free_side: None }
    }

    fn square(x: f64, y: f64) -> Convex {
        convex(&[[x - 1.0, y - 1.0], [x + 1.0, y - 1.0], [x + 1.0, y + 1.0], [x - 1.0, y + 1.0]], 0.0)
    }

    fn distance(a: &Convex, b: &Convex) -> f64 {
        let (there, back) = (closest(a, b), closest(b, a));
        assert!((there.distance - back.distance).abs() < 1e-12);
        assert!(dot(there.normal, back.normal) < 0.0 || there.distance <= 0.0);
        there.distance
    }

    #[test]
    fn distances_of_squares_are_those_of_edges_corners_and_depths() {
        assert_eq!(distance(&square(0.0, 0.0), &square(5.0, 0.5)), 3.0);
        assert!((distance(&square(0.0, 0.0), &square(5.0, 6.0)) - 5.0).abs() < 1e-12);
        assert_eq!(distance(&square(0.0, 0.0), &square(2.0, 0.0)), 0.0);
        assert_eq!(distance(&square(0.0, 0.0), &square(1.5, 0.2)), -0.5);
    }

    #[test]
    fn distances_of_round_shapes_are_those_of_their_cores_less_the_radii() {
        let (disc, capsule) = (convex(&[[0.0, 0.0]], 1.0), convex(&[[0.0, 3.0], [4.0, 3.0]], 0.5));
        assert_eq!(distance(&disc, &capsule), 1.5);
        assert_eq!(distance(&disc, &convex(&[[0.0, 0.5]], 1.0)), -1.5);
        assert_eq!(distance(&disc, &square(0.5, 0.0)), -1.5, "the centre is half a unit deep");
    }

    #[test]
    fn segments_cross_or_lie_apart_also_on_one_line() {
        let segment = |a: Point, b: Point| convex(&[a, b], 0.0);
        let level = segment([0.0, 0.0], [4.0, 0.0]);
        assert!(distance(&level, &segment([1.0, -1.0], [1.0, 1.0])) <= 0.0);
        assert_eq!(distance(&level, &segment([6.0, 0.0], [9.0, 0.0])), 2.0);
        assert_eq!(distance(&level, &segment([2.0, 1.0], [9.0, 1.0])), 1.0);
        assert_eq!(distance(&level, &segment([5.0, -1.0], [5.0, 1.0])), 1.0);
    }
}
