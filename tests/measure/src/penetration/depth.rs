//! Computes the penetration depth of two convex shapes.

use crate::world::turned;

pub(crate) type Point = [f64; 2];

/// A convex shape in px: a disc or a polygon.
#[derive(Debug, Clone, PartialEq)]
pub(crate) enum Form {
    Disc {
        centre: Point,
        radius: f64,
    },
    /// Corners of a convex polygon in px, in order: edges turn right on a screen with y down.
    Polygon(Vec<Point>),
}

impl Form {
    /// Returns the polygon with the vertices of a convex outline, px.
    ///
    /// # Panics
    ///
    /// The outline is not convex.
    pub(crate) fn polygon(outline: &[Point]) -> Self {
        let corners = hull(outline);
        let (whole, given) = (area(&corners), area(outline).abs());
        assert!(whole - given <= 1e-3 * whole, "an outline is not convex: {outline:?}");
        Form::Polygon(corners)
    }

    /// Returns the shape rotated by `angle` radians about the origin and then moved by `position` px.
    pub(crate) fn placed(&self, position: Point, angle: f64) -> Self {
        let place = |point: Point| {
            let turned = turned(point, angle);
            [turned[0] + position[0], turned[1] + position[1]]
        };
        match self {
            Form::Disc { centre, radius } => Form::Disc { centre: place(*centre), radius: *radius },
            Form::Polygon(corners) => Form::Polygon(corners.iter().map(|&corner| place(corner)).collect()),
        }
    }

    /// Returns the least and the greatest coordinate of the shape along the unit vector `axis`, px.
    pub(crate) fn extent(&self, axis: Point) -> (f64, f64) {
        match self {
            Form::Disc { centre, radius } => (dot(*centre, axis) - radius, dot(*centre, axis) + radius),
            Form::Polygon(corners) => corners
                .iter()
                .map(|&corner| dot(corner, axis))
                .fold((f64::INFINITY, f64::NEG_INFINITY), |(least, most), value| {
                    (least.min(value), most.max(value))
                }),
        }
    }
}

/// Returns the penetration depth in px: the length of the least displacement that separates two shapes. It is 0 or negative if
/// they do not overlap.
pub(crate) fn depth(one: &Form, other: &Form) -> f64 {
    match (one, other) {
        (Form::Disc { centre: a, radius: ra }, Form::Disc { centre: b, radius: rb }) => {
            ra + rb - (a[0] - b[0]).hypot(a[1] - b[1])
        }
        (Form::Disc { centre, radius }, Form::Polygon(corners))
        | (Form::Polygon(corners), Form::Disc { centre, radius }) => radius - distance(corners, *centre),
        (Form::Polygon(a), Form::Polygon(b)) => parting(a, other).min(parting(b, one)),
    }
}

/// Returns the length in px of the least displacement, along the outward normal of one of the polygon's edges, that separates
/// the polygon from `other`.
fn parting(corners: &[Point], other: &Form) -> f64 {
    let ways = edges(corners).map(|(from, to)| {
        let normal = outward(from, to);
        dot(from, normal) - other.extent(normal).0
    });
    ways.fold(f64::INFINITY, f64::min)
}

/// Returns the distance in px of a point from a polygon; negative inside.
fn distance(corners: &[Point], point: Point) -> f64 {
    let inside = edges(corners)
        .map(|(from, to)| dot(minus(point, from), outward(from, to)))
        .fold(f64::NEG_INFINITY, f64::max);
    if inside <= 0.0 {
        return inside;
    }
    edges(corners).map(|edge| distance_from_edge(edge, point)).fold(f64::INFINITY, f64::min)
}

fn distance_from_edge((from, to): (Point, Point), point: Point) -> f64 {
    let along = minus(to, from);
    let share = (dot(minus(point, from), along) / dot(along, along)).clamp(0.0, 1.0);
    let nearest = [from[0] + share * along[0], from[1] + share * along[1]];
    (point[0] - nearest[0]).hypot(point[1] - nearest[1])
}

fn edges(corners: &[Point]) -> impl Iterator<Item = (Point, Point)> {
    (0..corners.len()).map(|index| (corners[index], corners[(index + 1) % corners.len()]))
}

/// Returns the unit normal of an edge of a polygon, pointing outwards.
fn outward(from: Point, to: Point) -> Point {
    let along = minus(to, from);
    let length = along[0].hypot(along[1]);
    [along[1] / length, -along[0] / length]
}

/// Returns the corners of the convex hull of `points` in px, without points on its edges. Algorithm: points sorted by x, then
/// the lower and the upper chain.
pub(crate) fn hull(points: &[Point]) -> Vec<Point> {
    let mut sorted = points.to_vec();
    sorted.sort_by(|a, b| a[0].total_cmp(&b[0]).then(a[1].total_cmp(&b[1])));
    let size = sorted.iter().fold(0.0_f64, |size, p| size.max(p[0].abs()).max(p[1].abs()));
    let mut corners = chain(sorted.iter().copied(), size);
    corners.extend(chain(sorted.iter().rev().copied(), size));
    corners
}

/// Returns half of a convex hull, without its last point, px. `size` is the magnitude of the coordinates, px: a corner that
/// sticks out less than the rounding error of `size` is omitted.
fn chain(points: impl Iterator<Item = Point>, size: f64) -> Vec<Point> {
    let mut chain: Vec<Point> = Vec::new();
    for point in points {
        while let [.., before, last] = chain[..] {
            let along = minus(point, before);
            let sticks_out = cross(minus(last, before), along) / along[0].hypot(along[1]);
            // If two points are equal, the value is NaN, and the point does not count as a corner either.
            if sticks_out > size * f64::from(f32::EPSILON) {
                break;
            }
            chain.pop();
        }
        chain.push(point);
    }
    chain.pop();
    chain
}

fn area(corners: &[Point]) -> f64 {
    edges(corners).map(|(from, to)| cross(from, to)).sum::<f64>() / 2.0
}

fn minus(a: Point, b: Point) -> Point {
    [a[0] - b[0], a[1] - b[1]]
}

fn dot(a: Point, b: Point) -> f64 {
    a[0] * b[0] + a[1] * b[1]
}

fn cross(a: Point, b: Point) -> f64 {
    a[0] * b[1] - a[1] * b[0]
}
