//! The convex pieces of an outline, with which the solver collides: circles, capsules, convex polygons and edges of chains.
//!
//! A concave outline is cut into convex pieces. Corners that do not turn are removed.

use std::sync::Arc;

use super::convex_parts::convex_parts;
use super::edge_adjacency::{Seam, normal, seams_of_part};
use crate::math::Vector2;
use crate::math::plane::{Vector, cross, difference, dot, length};
use crate::storage::order::{packed_key, sort_by_number, total_order_key};

/// Sine of the angle below which a corner counts as straight and is removed, dimensionless.
const MIN_TURN_SINE: f32 = 1e-4;

/// A convex piece of an outline, in coordinates relative to the geom's origin.
#[derive(Debug, Clone, PartialEq)]
pub enum Piece {
    /// A disc about a point.
    Circle {
        /// Centre, in length units.
        centre: Vector,
        /// Radius, in length units, >= 0.
        radius: f32,
    },
    /// All points within a distance of a segment.
    Capsule {
        /// Ends of the segment, in length units.
        ends: [Vector; 2],
        /// Distance from the segment, in length units, >= 0.
        radius: f32,
    },
    /// A polygon; corners in the order with a positive shoelace area.
    Polygon(Vec<Vector>),
    /// A convex part of a concave outline, with the adjacency of each edge.
    Part {
        /// Corners, in length units, in the order with a positive shoelace area.
        corners: Vec<Vector>,
        /// Adjacency of the edge that begins at each corner.
        seams: Vec<Seam>,
    },
    /// All points within a distance of a convex polygon: a rounded polygon.
    Rounded {
        /// Corners of the polygon, in length units, in the order with a positive shoelace area.
        corners: Vec<Vector>,
        /// Distance from the polygon, in length units, > 0.
        radius: f32,
    },
    /// An edge of a chain, with the normal on its free side and its adjacency.
    Edge {
        /// Ends of the edge, in length units, in the order of the chain.
        ends: [Vector; 2],
        /// Unit normal on the free side, dimensionless.
        normal: Vector,
        /// Adjacency of the edge.
        seam: Seam,
        /// Adjacency of the edge in the opposite direction, for a chain that is solid on both sides; else `None`.
        back: Option<Seam>,
    },
}

/// Returns a rounded polygon, given by the corners of its core and the distance `radius` from it, both in length units. The core is
/// the convex hull of the corners if rounding has left them not quite convex.
pub fn rounded_piece(corners: Vec<Vector>, radius: f32) -> Piece {
    let corners = simplified(corners);
    let corners = if is_convex(&corners) { corners } else { hull(corners) };
    match corners[..] {
        [centre] => Piece::Circle { centre, radius },
        [one, other] => Piece::Capsule { ends: [one, other], radius },
        _ => Piece::Rounded { corners: without_spare_capacity(corners), radius },
    }
}

/// Returns the convex pieces of a closed outline, given by its corners in length units.
pub fn pieces_of_outline(corners: Vec<Vector>) -> Arc<[Piece]> {
    let corners = simplified(corners);
    if is_convex(&corners) {
        return Arc::new([polygon_or_point(corners)]);
    }
    match convex_parts(&corners) {
        Some(parts) => parts.iter().map(|part| part_with_adjacency(part, &corners)).collect(),
        // The outline crosses itself, or has too many corners to be cut.
        None => Arc::new([polygon_or_point(hull(corners))]),
    }
}

/// The edges of a chain that is solid on one side. An open end continues as if with an edge at a right angle, turned away from the
/// free side.
pub fn edges_of_chain(points: &[Vector2], is_closed: bool) -> impl Iterator<Item = Piece> {
    let points: Vec<Vector> = points.iter().map(|v| [v.x, v.y]).collect();
    let count = if is_closed { points.len() } else { points.len() - 1 };
    let ends = move |edge: usize| [points[edge], points[(edge + 1) % points.len()]];
    let normals: Vec<Vector> = (0..count).map(&ends).map(|[a, b]| normal(a, b)).collect();
    (0..count).map(move |edge| {
        let [x, y] = normals[edge];
        let (has_before, has_after) = (is_closed || edge > 0, is_closed || edge + 1 < count);
        let before = if has_before { normals[(edge + count - 1) % count] } else { [y, -x] };
        let after = if has_after { normals[(edge + 1) % count] } else { [-y, x] };
        let seam = Seam { is_internal: false, neighbours: [before, after] };
        Piece::Edge { ends: ends(edge), normal: [x, y], seam, back: None }
    })
}

/// The edges of a chain that is solid on both sides. At an open end the outline turns back to the other side.
pub fn edges_of_two_sided_chain(points: &[Vector2], is_closed: bool) -> impl Iterator<Item = Piece> {
    let edges: Vec<Piece> = edges_of_chain(points, is_closed).collect();
    let normal_of = |edge: &Piece| if let Piece::Edge { normal, .. } = edge { *normal } else { [0.0; 2] };
    let normals: Vec<Vector> = edges.iter().map(normal_of).collect();
    let count = edges.len();
    edges.into_iter().enumerate().map(move |(at, edge)| {
        let opposite = |[x, y]: Vector| [-x, -y];
        let neighbour = |exists: bool, index: usize| exists.then(|| normals[index % count]);
        let before = neighbour(is_closed || at > 0, at + count - 1);
        let after = neighbour(is_closed || at + 1 < count, at + 1);
        let own = normals[at];
        let seam = |neighbours: [Option<Vector>; 2], beyond: Vector| Seam {
            is_internal: false,
            neighbours: neighbours.map(|normal| normal.unwrap_or(beyond)),
        };
        let front = seam([before, after], opposite(own));
        let back = seam([after.map(opposite), before.map(opposite)], own);
        match edge {
            Piece::Edge { ends, normal, .. } => Piece::Edge { ends, normal, seam: front, back: Some(back) },
            other => other,
        }
    })
}

/// A polygon, or a disc of radius 0 if it has shrunk to a point.
fn polygon_or_point(corners: Vec<Vector>) -> Piece {
    match corners[..] {
        [centre] => Piece::Circle { centre, radius: 0.0 },
        _ => Piece::Polygon(without_spare_capacity(corners)),
    }
}

/// Returns `corners` without the memory of removed ones.
fn without_spare_capacity(mut corners: Vec<Vector>) -> Vec<Vector> {
    corners.shrink_to_fit();
    corners
}

fn part_with_adjacency(part: &[usize], outline: &[Vector]) -> Piece {
    let corners = part.iter().map(|&corner| outline[corner]).collect();
    Piece::Part { seams: seams_of_part(part, outline), corners }
}

/// The corners in the order of positive area, without repeated and straight ones.
pub fn simplified(mut corners: Vec<Vector>) -> Vec<Vector> {
    if area(&corners) < 0.0 {
        corners.reverse();
    }
    let mut at = 0;
    while at < corners.len() && corners.len() > 1 {
        let last = corners.len() - 1;
        let before = corners[if at == 0 { last } else { at - 1 }];
        let after = corners[if at == last { 0 } else { at + 1 }];
        let (a, b) = (difference(corners[at], before), difference(after, corners[at]));
        let goes_straight_on = dot(a, b) >= 0.0 && cross(a, b).abs() <= MIN_TURN_SINE * length(a) * length(b);
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
    let following = corners.iter().cycle().skip(1);
    corners.iter().zip(following).map(|(&corner, &next)| cross(corner, next)).sum()
}

/// Whether every corner turns to the same side, and all of them together one full turn.
pub fn is_convex(corners: &[Vector]) -> bool {
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
    sort_by_number(&mut corners, |corner| packed_key(corner.map(total_order_key)));
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
