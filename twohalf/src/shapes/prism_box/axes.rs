//! Axes of a piece of a prism and a box: penetration, time of entry, and choice of the contact axis.
//!
//! Frame: the plane's, x right, y **down**, z into the picture.
//!
//! Source: the separating axis theorem (Gottschalk 1996). The axes of a prism and a sheared box are the
//! normals of both outlines' edges, with or without the slope of the box in depth. The pairs are a side
//! against an end, and an edge against an edge. The y axis of a sheared box and the z axis are axes as well.

use farseer_core::math::{Vector2, Vector3, scalar};

use super::points::PointSet;
use super::{Edge, EntryAxis, MIN_EDGE_COS, PersistedAxis, PrismBoxPair, RESTING_SLOP_FACTOR};

/// An axis of the plane along which a piece and the box overlap.
#[derive(Clone, Copy)]
pub(super) struct AxisCandidate {
    pub(super) edge: Edge,
    /// Unit normal in the plane, from the box to the prism.
    pub(super) normal: Vector2,
    pub(super) normal3d: Vector3,
    /// Penetration along `normal3d`, px.
    pub(super) penetration: f32,
    /// A penetration of `d` px in the plane is a penetration of `(d + sink) / stretch` px along `normal3d`. `sink` is in px,
    /// `stretch` is dimensionless.
    pub(super) sink: f32,
    pub(super) stretch: f32,
    /// Time since the shapes began to overlap along the axis, steps; infinite if they do not close in, or if it is too long
    /// ago.
    pub(super) time: f32,
}

/// Least penetration, px, and least time since entry, steps, of the axes of a piece.
pub(super) struct AxisSurvey {
    least_penetration: f32,
    least_time: f32,
}

/// Axes.
impl<'a, I: Iterator<Item = &'a [Vector2]> + Clone> PrismBoxPair<'_, I> {
    /// Returns a vertex relative to the box's centre, px.
    pub(super) fn relative(&self, vertex: Vector2) -> Vector2 {
        Vector2::new(vertex.x - self.shape.centre.x, vertex.y - self.shape.centre.y)
    }

    /// The axis in space that belongs to an axis in the plane with this `overlap`, px. The sides of a sheared
    /// box are inclined in depth. Where an end of the prism meets such a side, the contact normal is that of
    /// the side. A prism that reaches beyond the end of the box meets the edge of the end, and its normal
    /// lies in the plane.
    fn candidate(&self, edge: Edge, normal: Vector2, overlap: f32) -> AxisCandidate {
        let lean = self.shape.shear * normal.x;
        let sink = lean.abs() * if lean > 0.0 { self.overhang[1] } else { self.overhang[0] };
        let stretch = self.shape.stretch(normal);
        let along = (overlap + sink) / stretch;
        let (normal3d, penetration, sink, stretch) = if lean != 0.0 && along <= overlap {
            (Vector3::new(normal.x, normal.y, -lean) / stretch, along, sink, stretch)
        } else {
            (Vector3::new(normal.x, normal.y, 0.0), overlap, 0.0, 1.0)
        };
        let time = self.along(penetration, normal3d).time();
        AxisCandidate { edge, normal, normal3d, penetration, sink, stretch, time }
    }

    fn box_candidate(&self, position: usize, vertices: &[Vector2]) -> AxisCandidate {
        let edge = self.outline.edge(position);
        let normal = edge.normal(self.shape);
        let support = normal.dot(&self.outline.vertices()[position]);
        let distances = vertices.iter().map(|&vertex| normal.dot(&self.relative(vertex)));
        let nearest = distances.fold(f32::INFINITY, scalar::min);
        self.candidate(Edge::Box(edge), normal, support - nearest)
    }

    /// Returns the candidate axis of an edge of a piece of the prism; `None` for an edge without length.
    fn prism_candidate(&self, piece: u32, edge: usize, vertices: &[Vector2]) -> Option<AxisCandidate> {
        let outward = outward_normal(vertices, edge)?;
        let support = outward.dot(&self.relative(vertices[edge]));
        let nearest =
            self.outline.vertices().iter().map(|vertex| outward.dot(vertex)).fold(f32::INFINITY, scalar::min);
        Some(self.candidate(Edge::Prism { piece, edge: edge as u32 }, -outward, support - nearest))
    }

    fn candidates(&self, piece: u32, vertices: &[Vector2]) -> impl Iterator<Item = AxisCandidate> {
        let of_box = (0..self.outline.len()).map(move |position| self.box_candidate(position, vertices));
        let of_prism =
            (0..vertices.len()).filter_map(move |edge| self.prism_candidate(piece, edge, vertices));
        of_box.chain(of_prism)
    }

    /// Iterates over the candidate axes of a piece without the cuts between pieces of the prism.
    fn exits(&self, piece: u32, vertices: &[Vector2]) -> impl Iterator<Item = AxisCandidate> {
        self.candidates(piece, vertices).filter(move |candidate| !self.is_cut(candidate.edge, vertices))
    }

    /// Returns whether an edge is a cut: another piece of the prism has it in the opposite direction.
    fn is_cut(&self, edge: Edge, vertices: &[Vector2]) -> bool {
        let Edge::Prism { edge, .. } = edge else { return false };
        if !self.are_several {
            return false;
        }
        let ends = (vertices[edge as usize], vertices[next(edge as usize, vertices)]);
        let has_it = |other: &[Vector2]| {
            (0..other.len()).any(|start| (other[next(start, other)], other[start]) == ends)
        };
        self.pieces.clone().any(has_it)
    }

    /// Returns the least penetration and the least time since entry among the axes of a piece; `None` if an axis separates
    /// piece and box.
    fn survey(&self, piece: u32, vertices: &[Vector2]) -> Option<AxisSurvey> {
        if !self.candidates(piece, vertices).all(|candidate| candidate.penetration > 0.0) {
            return None;
        }
        let none = AxisSurvey { least_penetration: f32::INFINITY, least_time: f32::INFINITY };
        let survey = self.exits(piece, vertices).fold(none, |survey, candidate| AxisSurvey {
            least_penetration: scalar::min(survey.least_penetration, candidate.penetration),
            least_time: scalar::min(survey.least_time, candidate.time),
        });
        survey.least_penetration.is_finite().then_some(survey)
    }

    fn kept_candidate(
        &self,
        piece: u32,
        vertices: &[Vector2],
        kept: Option<PersistedAxis>,
    ) -> Option<AxisCandidate> {
        let Some(PersistedAxis::Plane { edge, normal }) = kept else { return None };
        let candidate = match edge {
            Edge::Box(edge) => self.box_candidate(self.outline.position_of(edge)?, vertices),
            Edge::Prism { piece: of, edge } if of == piece && (edge as usize) < vertices.len() => {
                self.prism_candidate(piece, edge as usize, vertices)?
            }
            Edge::Prism { .. } => return None,
        };
        (candidate.normal.dot(&normal) > MIN_EDGE_COS).then_some(candidate)
    }

    /// Returns the penetration along a normal (px) together with the closing motion of the last step along it.
    pub(super) fn along(&self, penetration: f32, normal: Vector3) -> EntryAxis {
        EntryAxis { penetration, closing: -self.motion.dot(&normal) }
    }

    /// Returns the axis that the piece entered last. Of several axes that are entered at the same time it is the one along which
    /// piece and box approached least in the last step. `None` if no axis is flush and none was entered within the last step.
    fn entered_last(&self, piece: u32, vertices: &[Vector2], survey: &AxisSurvey) -> Option<AxisCandidate> {
        let along = |candidate: &AxisCandidate| self.along(candidate.penetration, candidate.normal3d);
        let tied =
            self.exits(piece, vertices).filter(|it| along(it).is_entered_at(survey.least_time, self.slop));
        tied.reduce(|best, it| if along(&it).is_better(&along(&best)) { it } else { best })
    }

    /// Returns the contact axis and the points of one piece, and the time since the piece met the box, steps; `None` if they do
    /// not overlap.
    pub(super) fn choose(
        &self,
        piece: u32,
        vertices: &[Vector2],
        kept: Option<PersistedAxis>,
    ) -> Option<(PointSet, f32)> {
        let survey = self.survey(piece, vertices)?;
        let with_points = |candidate| self.clipped(candidate, piece, vertices);
        let with_one = |choice: PointSet| {
            if choice.count > 0 { choice } else { self.at_support(choice, piece, vertices) }
        };
        let chosen = match kept {
            // Just after the first touch, the overlap may be too narrow for clipped points.
            None => self.entered_last(piece, vertices, &survey).map(with_points).map(with_one),
            Some(_) => {
                let kept = self.kept_candidate(piece, vertices, kept).map(with_points);
                let is_near = |choice: &PointSet| {
                    choice.depth() > RESTING_SLOP_FACTOR * self.slop
                        || choice.candidate.penetration < survey.least_penetration + self.slop
                };
                kept.filter(|choice| choice.count > 0 && is_near(choice))
            }
        };
        let choice = match chosen.filter(|choice| choice.count > 0) {
            Some(choice) => choice,
            None => with_points(least(self.exits(piece, vertices))?),
        };
        Some((with_one(choice), survey.least_time))
    }
}

/// Index of the vertex after another one.
pub(super) fn next(index: usize, vertices: &[Vector2]) -> usize {
    if index + 1 == vertices.len() { 0 } else { index + 1 }
}

/// Outward unit normal of an edge of an outline; `None` for an edge without length.
pub(super) fn outward_normal(vertices: &[Vector2], edge: usize) -> Option<Vector2> {
    let along = vertices[next(edge, vertices)] - vertices[edge];
    let length = along.norm();
    (length > 0.0 && length.is_finite()).then(|| Vector2::new(-along.y / length, along.x / length))
}

/// Returns the first candidate axis with the least penetration; `None` without candidates.
fn least(candidates: impl Iterator<Item = AxisCandidate>) -> Option<AxisCandidate> {
    candidates
        .reduce(|best, candidate| if candidate.penetration < best.penetration { candidate } else { best })
}
