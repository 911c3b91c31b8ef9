//! Convex outlines in the frame of their body: circles, capsules, and polygons with the normals of their edges.

use crate::geom::entry::GeomEntry;
use crate::geom::pieces::{Piece, simplified};
use crate::geom::seams::{self, Seam};
use crate::math::plane::{Vector, difference, dot, length, sum, turn};
use crate::math::scalar;
use crate::storage::reusing_clone::reusing_clone;

/// By what arithmetic an outline touches others.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub(super) enum Family {
    #[default]
    Circle,
    Polygon,
    /// A polygon of two corners with a radius.
    Capsule,
    /// A polygon that others go on from; with two corners it is an edge of a chain, of which the first side is free.
    Seamed,
}

/// A convex outline in the frame of its body.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct Shape {
    pub(super) family: Family,
    /// Where its corners are in the pool; none for a circle.
    start: u32,
    /// Where the seams of its edges are, if it has any.
    seams: u32,
    pub(super) count: u32,
    /// A box about the body's origin, along its axes.
    pub(super) is_box: bool,
    /// The radius of a circle or capsule, else 0.
    pub(super) radius: f32,
    /// The box about it in the body's frame, without the radius: centre, and half of its sides.
    pub(super) centre: Vector,
    pub(super) half: Vector,
    /// Greatest distance from the body's origin.
    pub(super) reach: f32,
}

impl Shape {
    /// The same with a box and a reach that are so much longer on all sides.
    pub(super) fn leaning(self, lean: f32) -> Self {
        let [x, y] = self.half;
        Shape {
            half: [x + lean, y + lean],
            reach: self.reach + lean,
            is_box: self.is_box && lean == 0.0,
            ..self
        }
    }
}

/// Corners and outward normals of all polygons.
#[derive(Debug, Default)]
pub(super) struct Corners {
    points: Vec<Vector>,
    normals: Vec<Vector>,
    /// Of the edges of those outlines that have them.
    seams: Vec<Seam>,
}

reusing_clone! { Corners { points, normals, seams } }

/// A shape with its corners and the normals of the edges that begin there.
#[derive(Clone, Copy)]
pub(super) struct Outline<'a> {
    pub(super) shape: Shape,
    pub(super) points: &'a [Vector],
    pub(super) normals: &'a [Vector],
    /// Of all outlines.
    all_seams: &'a [Seam],
}

impl<'a> Outline<'a> {
    /// How far its corners, or the centre of a circle, reach along a direction of its own frame, in length units; without its radius.
    pub(super) fn farthest_along(&self, direction: Vector) -> f32 {
        let points =
            if self.points.is_empty() { std::slice::from_ref(&self.shape.centre) } else { self.points };
        points.iter().map(|&point| dot(point, direction)).fold(f32::MIN, scalar::max)
    }

    /// What each edge is of the whole outline that this is a part of; empty if it is all of it.
    pub(super) fn seams(&self) -> &'a [Seam] {
        if self.shape.family == Family::Seamed {
            &self.all_seams[self.shape.seams as usize..][..self.shape.count as usize]
        } else {
            &[]
        }
    }
}

impl Corners {
    pub(super) fn clear(&mut self) {
        self.points.clear();
        self.normals.clear();
        self.seams.clear();
    }

    pub(super) fn outline(&self, shape: Shape) -> Outline<'_> {
        let range = shape.start as usize..(shape.start + shape.count) as usize;
        Outline {
            shape,
            points: &self.points[range.clone()],
            normals: &self.normals[range],
            all_seams: &self.seams,
        }
    }

    /// How far the surface is from the middle, at least.
    pub(super) fn core(&self, shape: Shape) -> f32 {
        let Outline { points, normals, .. } = self.outline(shape);
        let inside =
            points.iter().zip(normals).map(|(&point, &normal)| dot(normal, difference(point, shape.centre)));
        let least = inside.reduce(|a, b| if b < a { b } else { a }).unwrap_or(0.0);
        shape.radius + if least > 0.0 { least } else { 0.0 }
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
            &Piece::Capsule { ends, radius } => self.add_capsule(ends.map(to_body), radius),
            Piece::Part { corners, seams } => {
                let corners: Vec<Vector> = corners.iter().map(|&corner| to_body(corner)).collect();
                let turned = seams.iter().map(|seam| seam.turned([cosine, sine]));
                self.add_part(corners, turned)
            }
            Piece::Edge { ends, normal, seam } => {
                let normal = turn([cosine, sine], *normal);
                self.add_edge(ends.map(to_body), normal, seam.turned([cosine, sine]))
            }
            Piece::Polygon(corners) => {
                // Far from the body's origin small things lose corners.
                self.add_polygon(simplified(corners.iter().map(|&corner| to_body(corner)).collect()))
            }
        }
    }

    /// A box about the body's origin, with these halves of its sides. Half of the smallest `f32` number rounds to 0; every
    /// edge keeps a length, so that it has a normal.
    pub(super) fn add_box(&mut self, half: Vector) -> Shape {
        let [x, y] = half.map(|half| if half > 0.0 { half } else { f32::MIN_POSITIVE });
        self.add_polygon(vec![[-x, -y], [x, -y], [x, y], [-x, y]])
    }

    /// A disc about the body's origin.
    pub(super) fn add_ball(&mut self, radius: f32) -> Shape {
        Shape { radius, reach: radius, ..Shape::default() }
    }

    /// A box anywhere, with these halves of its sides. Far from the body's origin small ones lose corners.
    pub(super) fn add_box_at(&mut self, [x, y]: Vector, [half_x, half_y]: Vector) -> Shape {
        let corners = [[-half_x, -half_y], [half_x, -half_y], [half_x, half_y], [-half_x, half_y]];
        self.add_polygon(simplified(corners.map(|[dx, dy]| [x + dx, y + dy]).to_vec()))
    }

    /// A convex polygon about the body's origin.
    pub(super) fn add_hull(&mut self, corners: &[Vector]) -> Shape {
        self.add_polygon(corners.to_vec())
    }

    /// One that is so small, or so far from the body's origin, that its ends are one place is a circle.
    fn add_capsule(&mut self, ends: [Vector; 2], radius: f32) -> Shape {
        if length(difference(ends[0], ends[1])) == 0.0 {
            let centre = ends[0];
            return Shape { radius, centre, reach: length(centre) + radius, ..Shape::default() };
        }
        let core = self.add_polygon(ends.to_vec());
        Shape { family: Family::Capsule, radius, reach: core.reach + radius, ..core }
    }

    /// One that loses corners is a polygon like others.
    fn add_part(&mut self, corners: Vec<Vector>, seams: impl Iterator<Item = Seam>) -> Shape {
        let count = corners.len();
        let has_length = |at: usize| length(difference(corners[(at + 1) % count], corners[at])) > 0.0;
        if !(0..count).all(has_length) {
            return self.add_polygon(simplified(corners));
        }
        let polygon = self.add_polygon(corners);
        self.with_seams(polygon, seams)
    }

    /// Its normal is that of the points as they were given, before anything was rounded away.
    fn add_edge(&mut self, ends: [Vector; 2], normal: Vector, seam: Seam) -> Shape {
        let edge = self.add_polygon(ends.to_vec());
        let normals = &mut self.normals[edge.start as usize..];
        (normals[0], normals[1]) = (normal, [-normal[0], -normal[1]]);
        self.with_seams(edge, [seam, Seam::INNER].into_iter())
    }

    fn with_seams(&mut self, shape: Shape, seams: impl Iterator<Item = Seam>) -> Shape {
        let start = self.seams.len() as u32;
        self.seams.extend(seams);
        Shape { family: Family::Seamed, seams: start, ..shape }
    }

    fn add_polygon(&mut self, corners: Vec<Vector>) -> Shape {
        if let [centre] = corners[..] {
            return Shape { centre, reach: length(centre), ..Shape::default() };
        }
        let start = self.points.len();
        self.points.extend(corners);
        let points = &self.points[start..];
        let normal = |i: usize| normal(points[i], points[(i + 1) % points.len()]);
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
        let (family, count) = (Family::Polygon, points.len() as u32);
        Shape { family, start: start as u32, seams: 0, count, is_box, radius: 0.0, centre, half, reach }
    }
}

/// The outward unit normal of an edge. Edges of which the squared length leaves the range of normal `f32` numbers are
/// normalised in `f64`.
fn normal(start: Vector, end: Vector) -> Vector {
    let edge = difference(end, start);
    let squared = dot(edge, edge);
    let length = squared.sqrt();
    if squared.is_normal() { [edge[1] / length, -edge[0] / length] } else { seams::normal(start, end) }
}

#[cfg(test)]
mod tests {
    use super::{length, normal};

    #[test]
    fn edges_of_any_length_have_a_normal() {
        let long = [[-4e30, 12.0], [f32::MAX, 1e-6], [1e31, -12.0], [f32::MIN, 0.0], [3.0, 4.0]];
        let short = [[5e-31, -3.0], [-5e-31, -3.0], [1e-44, 1e-20], [1e-44, 0.0], [0.0, 1e-45]];
        let corners: Vec<_> = long.into_iter().chain(short).collect();
        for (at, &start) in corners.iter().enumerate() {
            let normal = normal(start, corners[(at + 1) % corners.len()]);
            assert!((length(normal) - 1.0).abs() < 1e-6, "{start:?}: {normal:?}");
        }
    }
}
