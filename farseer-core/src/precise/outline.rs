//! Convex outlines as the precise set collides them: circles, and polygons without corners that turn by nothing.
//!
//! What the circle factory made with eight corners or more is a circle; with fewer it is the polygon that it looks like. A
//! concave outline is cut into convex pieces once, which its geom and its clones share.

use std::sync::Arc;

use super::vector::{Vector, cross, difference, dot, length, sum, turn};
use crate::geom::entry::GeomEntry;
use crate::math::{Vector2, scalar};
use crate::shape::Vertices;

/// From this number of corners on, what the circle factory made is a circle.
const CIRCLE_CORNERS: usize = 8;
/// Sine of the angle below which a corner does not turn.
const STRAIGHT: f32 = 1e-4;

/// A convex part of an outline, relative to the geom's origin.
#[derive(Debug, Clone, PartialEq)]
pub(crate) enum Piece {
    /// A disc about a point.
    Circle { centre: Vector, radius: f32 },
    /// Corners in the order in which the shoelace area is positive.
    Polygon(Vec<Vector>),
}

/// The convex parts of a geom.
pub(crate) fn pieces(geom: &GeomEntry) -> Arc<[Piece]> {
    match geom.outline {
        crate::Outline::Circle { radius } if geom.local_vertices.len() >= CIRCLE_CORNERS => {
            Arc::new([Piece::Circle { centre: [0.0, 0.0], radius }])
        }
        _ => pieces_of(&geom.local_vertices),
    }
}

fn pieces_of(outline: &Vertices) -> Arc<[Piece]> {
    let corners = simplified(outline.iter().map(|v| [v.x, v.y]).collect());
    if is_convex(&corners) {
        return Arc::new([polygon_or_point(corners)]);
    }
    let simple: Vertices = corners.iter().map(|&[x, y]| Vector2::new(x, y)).collect();
    let parts = simple.decompose(i32::MAX).ok().filter(|parts| !parts.is_empty());
    match parts {
        Some(parts) => parts
            .iter()
            .map(|part| polygon_or_point(simplified(part.iter().map(|v| [v.x, v.y]).collect())))
            .collect(),
        // It crosses itself, or is longer than what can be cut.
        None => Arc::new([polygon_or_point(hull(corners))]),
    }
}

/// A polygon that has shrunk to a point is a disc of no size.
fn polygon_or_point(corners: Vec<Vector>) -> Piece {
    match corners[..] {
        [centre] => Piece::Circle { centre, radius: 0.0 },
        _ => Piece::Polygon(corners),
    }
}

/// The corners in the order of positive area, without those that repeat their neighbour or do not turn.
fn simplified(mut corners: Vec<Vector>) -> Vec<Vector> {
    if area(&corners) < 0.0 {
        corners.reverse();
    }
    let mut at = 0;
    while at < corners.len() && corners.len() > 1 {
        let count = corners.len();
        let (before, after) = (corners[(at + count - 1) % count], corners[(at + 1) % count]);
        let (a, b) = (difference(corners[at], before), difference(after, corners[at]));
        let goes_straight_on = dot(a, b) >= 0.0 && cross(a, b).abs() <= STRAIGHT * length(a) * length(b);
        if goes_straight_on {
            corners.remove(at);
            at = at.saturating_sub(1);
        } else {
            at += 1;
        }
    }
    corners
}

fn area(corners: &[Vector]) -> f32 {
    (0..corners.len()).map(|i| cross(corners[i], corners[(i + 1) % corners.len()])).sum()
}

/// Whether every corner turns the same way, and all of them once around.
fn is_convex(corners: &[Vector]) -> bool {
    let count = corners.len();
    let edge = |i: usize| difference(corners[(i + 1) % count], corners[i % count]);
    let turns_left = |i: usize| cross(edge(i), edge(i + 1)) >= 0.0;
    let is_ahead = |i: usize| edge(i)[1] > 0.0 || (edge(i)[1] == 0.0 && edge(i)[0] > 0.0);
    count <= 3
        || ((0..count).all(turns_left)
            && (0..count).filter(|&i| is_ahead(i) && !is_ahead(i + 1)).count() <= 1)
}

/// The convex hull, by Andrew's monotone chain.
fn hull(mut corners: Vec<Vector>) -> Vec<Vector> {
    corners.sort_by(|a, b| a[0].total_cmp(&b[0]).then(a[1].total_cmp(&b[1])));
    let half = |corners: &mut dyn Iterator<Item = &Vector>| {
        let mut chain: Vec<Vector> = Vec::new();
        for &corner in corners {
            while let [.., a, b] = chain[..]
                && cross(difference(b, a), difference(corner, b)) <= 0.0
            {
                chain.pop();
            }
            chain.push(corner);
        }
        chain.pop();
        chain
    };
    let mut all = half(&mut corners.iter());
    all.extend(half(&mut corners.iter().rev()));
    if all.is_empty() {
        corners.truncate(1);
        corners
    } else {
        simplified(all)
    }
}

/// A convex outline in the frame of its body.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct Shape {
    /// Where its corners are in the pool; none for a circle.
    start: u32,
    pub(super) count: u32,
    /// A box about the body's origin, along its axes.
    pub(super) is_box: bool,
    /// The radius of a circle, else 0.
    pub(super) radius: f32,
    /// The box about it in the body's frame, without the radius: centre, and half of its sides.
    pub(super) centre: Vector,
    pub(super) half: Vector,
    /// Greatest distance from the body's origin.
    pub(super) reach: f32,
}

/// Corners and outward normals of all polygons.
#[derive(Debug, Clone, Default)]
pub(super) struct Corners {
    points: Vec<Vector>,
    normals: Vec<Vector>,
}

/// A shape with its corners and the normals of the edges that begin there.
#[derive(Clone, Copy)]
pub(super) struct Outline<'a> {
    pub(super) shape: Shape,
    pub(super) points: &'a [Vector],
    pub(super) normals: &'a [Vector],
}

impl Corners {
    pub(super) fn clear(&mut self) {
        self.points.clear();
        self.normals.clear();
    }

    pub(super) fn outline(&self, shape: Shape) -> Outline<'_> {
        let range = shape.start as usize..(shape.start + shape.count) as usize;
        Outline { shape, points: &self.points[range.clone()], normals: &self.normals[range] }
    }

    /// Takes a piece of a geom into the frame of the geom's body.
    pub(super) fn add(&mut self, piece: &Piece, geom: &GeomEntry) -> Shape {
        let (sine, cosine) = scalar::sin_cos(geom.rotation_offset);
        let offset = [geom.offset.x, geom.offset.y];
        let to_body = |v: Vector| turn([cosine, sine], sum(offset, v));
        match piece {
            &Piece::Circle { centre, radius } => {
                let centre = to_body(centre);
                Shape { radius, centre, reach: length(centre) + radius, ..Shape::default() }
            }
            Piece::Polygon(corners) => self.add_polygon(corners.iter().map(|&corner| to_body(corner))),
        }
    }

    fn add_polygon(&mut self, corners: impl Iterator<Item = Vector>) -> Shape {
        let start = self.points.len();
        self.points.extend(corners);
        let points = &self.points[start..];
        let normal = |i: usize| {
            let edge = difference(points[(i + 1) % points.len()], points[i]);
            let length = length(edge);
            [edge[1] / length, -edge[0] / length]
        };
        self.normals.extend((0..points.len()).map(normal));
        let bound = |axis: usize, better: fn(f32, f32) -> bool| {
            points.iter().map(|p| p[axis]).reduce(|a, b| if better(a, b) { a } else { b }).unwrap_or(0.0)
        };
        let (low, high) =
            ([0, 1].map(|axis| bound(axis, |a, b| a < b)), [0, 1].map(|axis| bound(axis, |a, b| a > b)));
        let centre = [0, 1].map(|axis| 0.5 * (low[axis] + high[axis]));
        let half = [0, 1].map(|axis| 0.5 * (high[axis] - low[axis]));
        let reach = points.iter().map(|&p| length(p)).fold(0.0, |a, b| if b > a { b } else { a });
        let has_side = |edge: Vector| edge[0] == 0.0 || edge[1] == 0.0;
        let is_box = points.len() == 4
            && centre == [0.0, 0.0]
            && (0..4).all(|i| has_side(difference(points[(i + 1) % 4], points[i])));
        Shape { start: start as u32, count: points.len() as u32, is_box, radius: 0.0, centre, half, reach }
    }
}
