//! Contact manifold of a prism with a sheared box.
//!
//! Frame: the plane's, x right, y **down**, z into the picture. Normals point from the box to the prism.
//!
//! Within the common depths the prism is a column over its outline. The two overlap exactly when the outline
//! overlaps the swept outline of the box between those depths. Outlines are tested by the separating axis
//! theorem (Gottschalk 1996). Manifold points come from clipping the incident edge against the reference
//! edge. The contact axis is chosen once, when the pair begins to touch: the axis entered last. Least
//! penetration alone would push an object sideways that lands deep in a platform near its edge.

mod axes;
mod points;
mod swept_outline;

use farseer_core::math::{Vector2, Vector3, scalar};
use serde::{Deserialize, Serialize};

use super::{EntryAxis, RESTING_SLOP_FACTOR, SlantedBox, is_depth_last, overlap_points, span_of};
use axes::AxisCandidate;
use points::PointSet;
use swept_outline::{BoxEdge, SweptOutline};

/// Least cosine between an edge and its direction when it was chosen, dimensionless: about 18 degrees. An
/// edge that has turned farther is chosen anew.
const MIN_EDGE_COS: f32 = 0.95;
/// Least cosine between the normals of pieces that share a manifold, dimensionless: about 25 degrees.
const MIN_PIECE_COS: f32 = 0.9;

/// Contact axis of a prism and a box that persists between steps.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub(crate) enum PersistedAxis {
    /// The axis is Z: the prism touches the front or the back of the box.
    Depth { is_front: bool },
    /// The axis lies in the plane: the normal of an edge, with its value when it was chosen.
    Plane { edge: Edge, normal: Vector2 },
}

/// An edge of the prism's outline or of the box's swept outline.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
pub(crate) enum Edge {
    Box(BoxEdge),
    Prism { piece: u32, edge: u32 },
}

/// Contact manifold of a prism and a box.
#[derive(Debug, Clone, Copy)]
pub(crate) struct BoxManifold {
    /// Unit contact normal from the box to the prism, y down.
    pub(crate) normal: Vector3,
    pub(crate) points: [BoxPoint; 2],
    pub(crate) count: usize,
    pub(crate) kept: PersistedAxis,
    pub(crate) is_depth: bool,
}

/// A contact point of the manifold.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct BoxPoint {
    pub(crate) position: Vector3,
    /// Separation in px; negative is penetration.
    pub(crate) separation: f32,
    /// Feature id of the vertex, of the prism or of the box.
    pub(crate) feature: u32,
}

const NO_POINT: BoxPoint = BoxPoint { position: Vector3::new(0.0, 0.0, 0.0), separation: 0.0, feature: 0 };

/// Returns the manifold of a prism and a box, and the contact axis to store for the next step (see last-entered axis). `pieces` are the convex pieces of the outline. `motion` is
/// the displacement of the prism relative to the box in the last step, px; `slop` is the allowed penetration, px. `None` if the
/// shapes do not overlap.
#[expect(clippy::too_many_arguments, reason = "two shapes, how they move, and what is remembered of them")]
pub(crate) fn prism_box<'a>(
    shape: &SlantedBox,
    pieces: impl Iterator<Item = &'a [Vector2]> + Clone,
    prism_z: f32,
    prism_half_depth: f32,
    motion: Vector3,
    slop: f32,
    kept: Option<PersistedAxis>,
    scratch: &mut Vec<Vector2>,
) -> Option<BoxManifold> {
    let offset = prism_z - shape.centre.z;
    let reach = prism_half_depth + shape.half[2];
    // Two shapes without depth at the same z overlap.
    if !(offset.abs() < reach || (offset == 0.0 && reach == 0.0)) {
        return None;
    }
    let (front, back) = (prism_z - prism_half_depth, prism_z + prism_half_depth);
    let near = scalar::max(front, shape.centre.z - shape.half[2]);
    let far = scalar::min(back, shape.centre.z + shape.half[2]);
    let overhang = [near - front, back - far];
    let outline = SweptOutline::new(shape, near, far);
    let are_several = pieces.clone().nth(1).is_some();
    let pair = PrismBoxPair { shape, pieces, are_several, outline, overhang, motion, slop };
    let plane = pair.in_plane(kept)?;
    let front = Depth { is_front: true, penetration: reach + offset };
    let back = Depth { is_front: false, penetration: reach - offset };
    let depth = match kept {
        Some(PersistedAxis::Depth { is_front }) => Some(if is_front { front } else { back }),
        Some(PersistedAxis::Plane { .. }) => None,
        None => {
            // The side is the one on which the prism was before this step.
            let came_from = offset - motion.z;
            let entered = if came_from < 0.0 || (came_from == 0.0 && motion.z > 0.0) { front } else { back };
            Some(entered).filter(|depth| pair.leaves(depth, &plane))
        }
    };
    let manifold = match depth {
        Some(depth) => pair.depth_manifold(depth, &plane, scratch),
        None => pair.plane_manifold(kept, &plane),
    };
    manifold.is_finite().then_some(manifold)
}

impl BoxManifold {
    fn is_finite(&self) -> bool {
        let finite = |v: Vector3| v.iter().all(|number| number.is_finite());
        let points = &self.points[..self.count];
        finite(self.normal)
            && points.iter().all(|point| finite(point.position) && point.separation.is_finite())
    }
}

/// A prism and a box that overlap in depth.
struct PrismBoxPair<'a, I> {
    shape: &'a SlantedBox,
    pieces: I,
    are_several: bool,
    outline: SweptOutline,
    /// Extent of the prism beyond the common depths, in front and behind, px.
    overhang: [f32; 2],
    motion: Vector3,
    slop: f32,
}

/// Contact along Z: the prism leaves through the front or the back of the box.
#[derive(Clone, Copy)]
struct Depth {
    is_front: bool,
    penetration: f32,
}

impl Depth {
    fn normal(&self) -> Vector3 {
        Vector3::new(0.0, 0.0, if self.is_front { -1.0 } else { 1.0 })
    }
}

/// Contact in the plane, with the axis and the points of the deepest piece.
struct Plane {
    deepest: PointSet,
    /// Time since the first piece met the box, steps.
    time: f32,
    overlapping: usize,
}

/// Contacts of the prism, composed of those of its convex pieces.
impl<'a, I: Iterator<Item = &'a [Vector2]> + Clone> PrismBoxPair<'_, I> {
    fn in_plane(&self, kept: Option<PersistedAxis>) -> Option<Plane> {
        let mut plane: Option<Plane> = None;
        for (vertices, piece) in self.pieces.clone().zip(0..) {
            let Some((choice, time)) = self.choose(piece, vertices, kept) else { continue };
            match &mut plane {
                None => plane = Some(Plane { deepest: choice, time, overlapping: 1 }),
                Some(plane) => {
                    plane.overlapping += 1;
                    plane.time = scalar::max(plane.time, time);
                    if choice.depth() > plane.deepest.depth() {
                        plane.deepest = choice;
                    }
                }
            }
        }
        plane
    }

    /// Returns whether the contact axis of a new pair is the depth axis.
    fn leaves(&self, depth: &Depth, plane: &Plane) -> bool {
        let AxisCandidate { penetration, normal3d, .. } = plane.deepest.candidate;
        let in_plane = self.along(penetration, normal3d);
        let in_depth = self.along(depth.penetration, depth.normal());
        is_depth_last(in_plane, plane.time, in_depth, self.motion.z != 0.0, self.slop)
    }

    fn plane_manifold(&self, kept: Option<PersistedAxis>, plane: &Plane) -> BoxManifold {
        let PointSet { candidate, mut points, mut count } = plane.deepest;
        if plane.overlapping > 1 {
            (points, count) = self.points_of_pieces(kept, plane);
        }
        if count == 2 && points[1].separation < points[0].separation {
            points.swap(0, 1);
        }
        // The same edge keeps the direction that it had when it was chosen.
        let kept = match kept {
            Some(PersistedAxis::Plane { edge, normal })
                if edge == candidate.edge && candidate.normal.dot(&normal) > MIN_EDGE_COS =>
            {
                PersistedAxis::Plane { edge, normal }
            }
            _ => PersistedAxis::Plane { edge: candidate.edge, normal: candidate.normal },
        };
        BoxManifold { normal: candidate.normal3d, points, count, kept, is_depth: false }
    }

    /// The two outermost points of the pieces with about the normal of the deepest piece. If the deepest
    /// point is not among them, it replaces the nearer one.
    fn points_of_pieces(&self, kept: Option<PersistedAxis>, plane: &Plane) -> ([BoxPoint; 2], usize) {
        let normal = plane.deepest.candidate.normal;
        let place = |point: &BoxPoint| normal.x * point.position.y - normal.y * point.position.x;
        let first = plane.deepest.points[0];
        let (mut low, mut high, mut deepest) = (first, first, first);
        for (vertices, piece) in self.pieces.clone().zip(0..) {
            let Some((choice, _)) = self.choose(piece, vertices, kept) else { continue };
            let count = if choice.candidate.normal.dot(&normal) > MIN_PIECE_COS { choice.count } else { 0 };
            for point in &choice.points[..count] {
                if place(point) < place(&low) {
                    low = *point;
                }
                if place(point) > place(&high) {
                    high = *point;
                }
                if point.separation < deepest.separation {
                    deepest = *point;
                }
            }
        }
        if deepest.separation < scalar::min(low.separation, high.separation) - self.slop {
            let is_nearer = place(&deepest) - place(&low) < place(&high) - place(&deepest);
            (low, high) = (deepest, if is_nearer { high } else { low });
        }
        ([low, high], if low.feature == high.feature { 1 } else { 2 })
    }

    fn depth_manifold(&self, depth: Depth, plane: &Plane, scratch: &mut Vec<Vector2>) -> BoxManifold {
        let normal = depth.normal();
        let z = self.shape.centre.z + normal.z * self.shape.half[2];
        let corners = self.outline.in_plane(self.shape);
        scratch.clear();
        for piece in self.pieces.clone() {
            overlap_points(&corners[..self.outline.len()], piece, scratch);
        }
        // An overlap too thin for points of its own has those of the contact in the plane.
        let mut ends = span_of(scratch).unwrap_or(plane.deepest.points.map(|point| point.position.xy()));
        if (ends[1].x, ends[1].y) < (ends[0].x, ends[0].y) {
            ends.swap(0, 1);
        }
        let is_one = ends[0] == ends[1] || (scratch.is_empty() && plane.deepest.count == 1);
        let point = |index: usize| BoxPoint {
            position: Vector3::new(ends[index].x, ends[index].y, z),
            separation: -depth.penetration,
            feature: index as u32,
        };
        BoxManifold {
            normal,
            points: [point(0), point(1)],
            count: if is_one { 1 } else { 2 },
            kept: PersistedAxis::Depth { is_front: depth.is_front },
            is_depth: true,
        }
    }
}

#[cfg(test)]
mod tests;
