//! Two outlines as each lies in the frame of the other: what the less frequent kinds of contacts are found from.

use super::manifold::{Manifold, clip, greatest_separation};
use super::outline::Outline;
use crate::math::plane::{
    Pose, Turn, Vector, difference, dot, place, rotation, scaled, sum, turn, turn_back,
};
use crate::precise::parameters::narrow_phase::REFERENCE_EDGE_HYSTERESIS;

/// Two outlines with corners, which may have radii, as each lies in the frame of the other.
pub(super) struct Meeting<'a> {
    pub(super) a: Side<'a>,
    pub(super) b: Side<'a>,
    qa: Turn,
    qb: Turn,
    /// From A's origin to B's.
    apart: Vector,
}

/// One of the two, and where the other one lies as seen from it.
#[derive(Clone, Copy)]
pub(super) struct Side<'a> {
    pub(super) outline: Outline<'a>,
    at: Vector,
    q: Turn,
}

/// Which of the two.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Which {
    A,
    B,
}

impl Which {
    pub(super) fn other(self) -> Self {
        match self {
            Which::A => Which::B,
            Which::B => Which::A,
        }
    }
}

/// What of the cores of two outlines is nearest, if they do not overlap.
#[derive(Debug, Clone, Copy)]
pub(super) enum Nearest {
    /// An edge of one, between its ends, and a corner of the other.
    Edge(Which, usize),
    /// A corner of each, with the way from that of A to that of B, in the frame of A.
    Corners { corner_a: usize, corner_b: usize, way: Vector },
}

impl<'a> Side<'a> {
    /// A point of the other one in the frame of this one.
    pub(super) fn seen(self, point: Vector) -> Vector {
        sum(turn(self.q, point), self.at)
    }

    /// A direction of this one in the frame of the other one.
    pub(super) fn for_other(self, direction: Vector) -> Vector {
        turn_back(self.q, direction)
    }

    /// Greatest separation of an edge of this one from the other, without radii.
    pub(super) fn greatest_separation(&self, other: &Side<'_>) -> (f32, usize) {
        greatest_separation(self.outline, other.outline, self.at, self.q)
    }
}

impl<'a> Meeting<'a> {
    pub(super) fn new(a: Outline<'a>, b: Outline<'a>, pose_a: Pose, pose_b: Pose) -> Self {
        let (qa, qb) = (rotation(pose_a), rotation(pose_b));
        let apart = difference(place(pose_b), place(pose_a));
        let (at, q) = (turn_back(qa, apart), turn_back(qa, qb));
        let (at_back, q_back) = (turn_back(q, scaled(at, -1.0)), [q[0], -q[1]]);
        Meeting {
            a: Side { outline: a, at, q },
            b: Side { outline: b, at: at_back, q: q_back },
            qa,
            qb,
            apart,
        }
    }

    pub(super) fn side(&self, which: Which) -> &Side<'a> {
        match which {
            Which::A => &self.a,
            Which::B => &self.b,
        }
    }

    /// Sum of the radii.
    pub(super) fn radius(&self) -> f32 {
        self.a.outline.shape.radius + self.b.outline.shape.radius
    }

    /// The contacts of an edge of one with the edge of the other that faces it.
    ///
    /// With radii a and b and cores s apart along the normal n, the outlines are s - a - b apart, and the middle between them
    /// is (b - a) / 2 from that between the cores, against n.
    pub(super) fn on_edge(&self, which: Which, edge: usize, reach: f32) -> Manifold {
        let (this, other) = (self.side(which), self.side(which.other()));
        let (a, b) = (this.outline.shape.radius, other.outline.shape.radius);
        let mut found = clip(this.outline, other.outline, this.at, this.q, edge, reach + a + b);
        let towards_this = scaled(found.normal, 0.5 * (b - a));
        found.points = found.points.map(|point| difference(point, towards_this));
        found.separations = found.separations.map(|separation| separation - a - b);
        match which {
            Which::A => found.turned(self.qa),
            Which::B => found.turned_from_b(self.qb, self.apart),
        }
    }

    /// The contact of a corner of each, as [`Nearest::Corners`] has them.
    pub(super) fn on_corners(&self, corner_a: usize, corner_b: usize, way: Vector, reach: f32) -> Manifold {
        let distance = dot(way, way).sqrt();
        let normal = scaled(way, 1.0 / distance);
        let separation = distance - self.radius();
        let from_corner = self.a.outline.shape.radius + 0.5 * separation;
        let point = sum(self.a.outline.points[corner_a], scaled(normal, from_corner));
        let feature = ((corner_a as u32) << 16) | corner_b as u32;
        Manifold::of_point(normal, point, separation, feature, reach).turned(self.qa)
    }

    /// What of the two cores is nearest, and how far apart: of two convex outlines that do not overlap always a corner of one
    /// and an edge of the other that faces it, or a corner of each.
    pub(super) fn nearest(&self, reach: f32) -> Option<(f32, Nearest)> {
        let of_a = nearest_edge(&self.a, &self.b);
        let of_b = nearest_edge(&self.b, &self.a);
        // The edge of A is kept where both are about as good, so that it does not change with every step.
        let is_b = match (&of_a, &of_b) {
            (Some(a), Some(b)) => b.distance < a.distance - REFERENCE_EDGE_HYSTERESIS * reach,
            (None, Some(_)) => true,
            _ => false,
        };
        let near = if is_b { of_b } else { of_a }?;
        let nearest = match near.end {
            None => Nearest::Edge(if is_b { Which::B } else { Which::A }, near.edge),
            Some(end) if is_b => {
                let way = scaled(self.b.for_other(near.way), -1.0);
                Nearest::Corners { corner_a: near.corner, corner_b: end, way }
            }
            Some(end) => Nearest::Corners { corner_a: end, corner_b: near.corner, way: near.way },
        };
        Some((near.distance, nearest))
    }
}

/// An edge of one and a corner of the other, with the way from the edge to the corner in the frame of the one.
struct Near {
    distance: f32,
    edge: usize,
    /// The end of the edge that is nearest, unless what is between them is.
    end: Option<usize>,
    corner: usize,
    way: Vector,
}

/// The edge of one that is nearest to a corner of the other, of those that face it.
fn nearest_edge(one: &Side<'_>, other: &Side<'_>) -> Option<Near> {
    let mut nearest: Option<Near> = None;
    for (corner, &point) in other.outline.points.iter().enumerate() {
        let point = one.seen(point);
        for edge in 0..one.outline.points.len() {
            let near = edge_and_point(one.outline, edge, point).map(|near| Near { corner, ..near });
            if let Some(near) =
                near.filter(|near| nearest.as_ref().is_none_or(|best| near.distance < best.distance))
            {
                nearest = Some(near);
            }
        }
    }
    nearest
}

fn edge_and_point(outline: Outline<'_>, edge: usize, point: Vector) -> Option<Near> {
    let next = (edge + 1) % outline.points.len();
    let (start, end) = (outline.points[edge], outline.points[next]);
    let (from_start, from_end) = (difference(point, start), difference(point, end));
    let along = difference(end, start);
    let height = dot(outline.normals[edge], from_start);
    let near = |end: Option<usize>, way: Vector| {
        let distance = if end.is_some() { dot(way, way).sqrt() } else { height };
        Near { distance, edge, end, corner: 0, way }
    };
    if height < 0.0 {
        None
    } else if dot(from_start, along) <= 0.0 {
        Some(near(Some(edge), from_start))
    } else if dot(from_end, along) >= 0.0 {
        Some(near(Some(next), from_end))
    } else {
        Some(near(None, scaled(outline.normals[edge], height)))
    }
}
