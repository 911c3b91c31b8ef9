//! Manifold points in the plane: the incident edge clipped against the reference edge.
//!
//! Frame: the plane's, x right, y **down**, z into the picture; relative to the box's centre until the end.

use farseer_core::math::{Vector2, Vector3, scalar};

use super::axes::{AxisCandidate, next, outward_normal};
use super::{BoxPoint, Edge, NO_POINT, PrismBoxPair};

/// Contact axis of a piece with its manifold points.
#[derive(Clone, Copy)]
pub(super) struct PointSet {
    pub(super) candidate: AxisCandidate,
    pub(super) points: [BoxPoint; 2],
    /// Number of manifold points, 0..=2.
    pub(super) count: usize,
}
/// An edge in the plane, with z (px) and feature id of both end points.
struct Segment {
    ends: [Vector2; 2],
    depths: [f32; 2],
    features: [u32; 2],
}

impl Segment {
    /// Returns z at a fraction of the edge, px; z of the start if the fraction is not finite.
    fn depth_at(&self, share: f32) -> f32 {
        let share = if share.is_finite() { share } else { 0.0 };
        self.depths[0] + (self.depths[1] - self.depths[0]) * share
    }
}

impl PointSet {
    fn push(&mut self, point: BoxPoint) {
        self.points[self.count] = point;
        self.count += 1;
    }

    pub(super) fn depth(&self) -> f32 {
        self.points[..self.count].iter().fold(0.0, |depth, point| scalar::max(depth, -point.separation))
    }
}

/// Points.
impl<'a, I: Iterator<Item = &'a [Vector2]> + Clone> PrismBoxPair<'_, I> {
    fn box_segment(&self, start: usize) -> Segment {
        let outline = &self.outline;
        let both = [start, next(start, outline.vertices())];
        Segment {
            ends: both.map(|index| outline.vertices()[index]),
            depths: both.map(|index| outline.depth(index)),
            features: both.map(|index| 1 << 31 | outline.label(index)),
        }
    }

    fn prism_segment(&self, piece: u32, start: usize, vertices: &[Vector2]) -> Segment {
        let both = [start, next(start, vertices)];
        Segment {
            ends: both.map(|index| self.relative(vertices[index])),
            depths: [0.0; 2],
            features: both.map(|index| (piece << 16 | index as u32) & !(1 << 31)),
        }
    }

    /// Returns the index of the edge of a piece whose normal is most opposed to the given normal; `None` without edges.
    fn prism_edge_against(&self, normal: Vector2, vertices: &[Vector2]) -> Option<usize> {
        let facing = |edge| Some((edge, outward_normal(vertices, edge)?.dot(&normal)));
        let opposite = (0..vertices.len()).filter_map(facing).reduce(|a, b| if b.1 < a.1 { b } else { a })?;
        Some(opposite.0)
    }

    fn box_edge_along(&self, normal: Vector2) -> usize {
        let facing = |position| self.outline.edge(position).normal(self.shape).dot(&normal);
        (0..self.outline.len())
            .fold(0, |best, position| if facing(position) > facing(best) { position } else { best })
    }

    /// Clips the incident edge against the width of the reference edge and keeps the penetrating points.
    pub(super) fn clipped(&self, candidate: AxisCandidate, piece: u32, vertices: &[Vector2]) -> PointSet {
        let mut choice = PointSet { candidate, points: [NO_POINT; 2], count: 0 };
        let normal = candidate.normal;
        let (reference, incident) = match candidate.edge {
            Edge::Box(edge) => {
                let Some(start) = self.prism_edge_against(normal, vertices) else { return choice };
                let Some(position) = self.outline.position_of(edge) else { return choice };
                (self.box_segment(position), self.prism_segment(piece, start, vertices))
            }
            Edge::Prism { edge, .. } => (
                self.prism_segment(piece, edge as usize, vertices),
                self.box_segment(self.box_edge_along(normal)),
            ),
        };
        // The outlines have opposite directions: the end of one edge is at the start of the other.
        let along = Vector2::new(normal.y, -normal.x);
        let is_box = matches!(candidate.edge, Edge::Box(_));
        let sign = if is_box { 1.0 } else { -1.0 };
        let place = |point: Vector2| along.dot(&point) * sign;
        let [start, end] = reference.ends.map(place);
        let [from, to] = incident.ends.map(place);
        let surface = normal.dot(&reference.ends[0]);
        // (fraction of the incident edge, feature id) of its two points.
        let first = if from > end {
            ((end - from) / (to - from), reference.features[1])
        } else {
            (0.0, incident.features[0])
        };
        let last = if to < start {
            ((start - from) / (to - from), reference.features[0])
        } else {
            (1.0, incident.features[1])
        };
        let is_within = from >= start && to <= end && first.0 <= last.0;
        if !is_within {
            return choice;
        }
        for (share, feature) in [first, last] {
            let point = incident.ends[0] + (incident.ends[1] - incident.ends[0]) * share;
            let gap = (normal.dot(&point) - surface) * sign;
            let separation = (gap - candidate.sink) / candidate.stretch;
            let z = if is_box {
                reference.depth_at((place(point) - start) / (end - start))
            } else {
                incident.depth_at(share)
            };
            let position = self.position(point, z);
            if gap < 0.0 && (choice.count == 0 || position != choice.points[0].position) {
                choice.push(BoxPoint { position, separation, feature });
            }
        }
        choice
    }

    fn position(&self, point: Vector2, z: f32) -> Vector3 {
        Vector3::new(self.shape.centre.x + point.x, self.shape.centre.y + point.y, z)
    }

    /// Gives a candidate without clipped points the deepest vertex.
    pub(super) fn at_support(&self, mut choice: PointSet, piece: u32, vertices: &[Vector2]) -> PointSet {
        let AxisCandidate { edge, normal, penetration, .. } = choice.candidate;
        let (position, feature) = match edge {
            Edge::Box(edge) => {
                let distance = |index: usize| normal.dot(&self.relative(vertices[index]));
                let nearest = (0..vertices.len())
                    .fold(0, |best, i| if distance(i) < distance(best) { i } else { best });
                let segment = self.prism_segment(piece, nearest, vertices);
                let start = self.outline.position_of(edge).unwrap_or(0);
                (self.position(segment.ends[0], self.box_segment(start).depth_at(0.5)), segment.features[0])
            }
            Edge::Prism { .. } => {
                let corners = self.outline.vertices();
                let distance = |index: usize| normal.dot(&corners[index]);
                let farthest =
                    (0..corners.len()).fold(0, |best, i| if distance(i) > distance(best) { i } else { best });
                let segment = self.box_segment(farthest);
                (self.position(segment.ends[0], segment.depths[0]), segment.features[0])
            }
        };
        choice.push(BoxPoint { position, separation: -penetration, feature });
        choice
    }
}
