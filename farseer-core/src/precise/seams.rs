//! Where outlines touch that are only a part of something: edges of a chain, and the convex parts of a concave outline. Nothing
//! catches on where they meet, on no *ghost*.
//!
//! Between a piece and what it touches the normal w, outward from the piece, must be one that the *whole* outline can have at
//! that point (its Gauss map; E. Catto, "Ghost Collisions", box2d.org, 2020, and `b2ClassifyNormal` in Box2D's `manifold.c`):
//!
//! - on an edge of the outline its own normal n; on an edge inside of it none;
//! - at a corner between edges of normals n and n', if it juts out: all from n to n'. With cross(n, n') > 0 for a corner that
//!   juts out, w lies between them if cross(n, w) >= 0 and cross(w, n') >= 0;
//! - at a corner where the outline goes straight on or inward: no others than n and n'.
//!
//! So for every candidate of least overlap, an edge of either one, a piece is asked at the corner that lies furthest along w.
//! There both edges may be the outline's: then w, which lies between their normals, is *admitted*. If one of them is inside,
//! the neighbour of the other along the outline takes its place. What lies beyond the neighbour's normal at a corner that juts
//! out is *skipped*, since the piece that the neighbour belongs to has it. What is not n where the outline does not jut out is
//! *snapped*: the contacts are those of the piece's own edge.
//!
//! A row of edges on a line so has the normal of that line, whatever meets them where. Two points at one corner from two
//! pieces share the load.
//!
//! Snapped to an edge, nothing may count as behind the edge that is apart from the piece, or not nearly as deep in it along w:
//! what is, is another piece's affair.

use super::manifold::Manifold;
use super::meeting::{Meeting, Nearest, Side, Which};
use super::outline::{Family, Outline};
use super::round::{along_normal, are_apart};
use crate::math::plane::{
    Pose, Vector, cross, difference, dot, place, rotation, scaled, sum, turn, turn_back,
};
use crate::precise::parameters::narrow_phase::{
    EDGE_NORMAL_SLACK, REFERENCE_EDGE_HYSTERESIS, SNAPPED_PENETRATION_RATIO, STRAIGHT_CORNER_SINE,
};

/// Classification of a contact normal against the outline. The cases and their names are Box2D's: `b2_normalAdmit`,
/// `b2_normalSkip` and `b2_normalSnap` of `enum b2NormalType` in `manifold.c` (E. Catto).
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Verdict {
    /// The outline has this normal at the point: the contact counts.
    Admitted,
    /// The normal belongs to a neighbouring piece, which has the contact.
    Skipped,
    /// The outline has no such normal at the point: the contact takes the normal of the piece's own edge.
    Snapped,
}

/// Separations of the edges of one from the other, without radii.
#[derive(Clone, Copy)]
struct Axes {
    greatest: f32,
    /// That of an edge of the whole outline.
    outer: Option<(f32, usize)>,
}

/// The contacts of two of which one at least is a piece, and none has a radius.
pub(super) fn polygons(meeting: &Meeting<'_>, reach: f32) -> Manifold {
    match axes_if_near(meeting, reach) {
        Ok(axes) => by_axes(meeting, axes, reach),
        Err(gap) => Manifold::apart(gap),
    }
}

/// The contacts of a piece and a capsule.
pub(super) fn capsule(meeting: &Meeting<'_>, reach: f32) -> Manifold {
    let axes = match axes_if_near(meeting, reach) {
        Ok(axes) => axes,
        Err(gap) => return Manifold::apart(gap),
    };
    let greatest = larger(axes[0].greatest, axes[1].greatest);
    match meeting.nearest(reach).filter(|&(distance, _)| are_apart(meeting, greatest, distance)) {
        Some((distance, Nearest::Edge(which, edge))) => {
            on_edge(meeting, axes, (which, edge), distance, reach)
        }
        Some((distance, Nearest::Corners { corner_a, corner_b, way })) => {
            let w = scaled(way, 1.0 / distance);
            let (verdict, which) =
                strictest(verdict(&meeting.a, w), verdict(&meeting.b, meeting.a.for_other(scaled(w, -1.0))));
            match verdict {
                Verdict::Admitted => on_corners(meeting, axes, (corner_a, corner_b, way), reach),
                Verdict::Skipped => Manifold::apart(0.0),
                Verdict::Snapped => snapped(meeting, axes, which, distance, reach),
            }
        }
        None => by_axes(meeting, axes, reach),
    }
}

/// The contact of a piece and a circle: at the edge that is nearest to the centre, or at one of its ends if the centre is
/// beyond that, and beyond the neighbour as well (its Voronoi region).
pub(super) fn circle(a: Outline<'_>, b: Outline<'_>, pose_a: Pose, pose_b: Pose, reach: f32) -> Manifold {
    let q = rotation(pose_a);
    let centre_b = sum(difference(place(pose_b), place(pose_a)), turn(rotation(pose_b), b.shape.centre));
    let centre = turn_back(q, centre_b);
    let radius = b.shape.radius;
    let axes = axes_of(a, |normal, point| dot(normal, difference(centre, point)));
    if axes.greatest > reach + radius {
        return Manifold::apart(axes.greatest - radius);
    }
    let Some((height, edge)) = axes.outer.filter(|_| is_in_front(a, centre)) else {
        return Manifold::apart(0.0);
    };
    let is_outside = axes.greatest > 0.0;
    if is_outside && axes.greatest > height {
        // Nearer to an edge inside of the outline: the centre is over another piece.
        return Manifold::apart(0.0);
    }
    let (normal, distance) = match end_of_edge(a, edge, centre) {
        Some((way, is_own)) if is_outside => {
            if !is_own {
                return Manifold::apart(0.0);
            }
            let distance = dot(way, way).sqrt();
            if distance > 0.0 { (scaled(way, 1.0 / distance), distance) } else { (a.normals[edge], height) }
        }
        _ => (a.normals[edge], height),
    };
    let separation = distance - radius;
    let point = difference(centre, scaled(normal, radius + 0.5 * separation));
    Manifold::of_point(normal, point, separation, edge as u32, reach).turned(q)
}

/// The way from the end of an edge to a point that is beyond it, and whether the point is not over the neighbour there.
fn end_of_edge(a: Outline<'_>, edge: usize, point: Vector) -> Option<(Vector, bool)> {
    let [start, end] = [edge, (edge + 1) % a.points.len()].map(|corner| a.points[corner]);
    let [before, after] = a.seams()[edge].neighbours.map(|[x, y]| [-y, x]);
    let along = difference(end, start);
    let (from_start, from_end) = (difference(point, start), difference(point, end));
    if dot(from_start, along) < 0.0 {
        Some((from_start, dot(from_start, before) >= 0.0))
    } else if dot(from_end, along) > 0.0 {
        Some((from_end, dot(from_end, after) <= 0.0))
    } else {
        None
    }
}

/// The separations of all edges, if the two are near enough and on the free side of each other; else how far apart they are.
fn axes_if_near(meeting: &Meeting<'_>, reach: f32) -> Result<[Axes; 2], f32> {
    let (a, b) = (&meeting.a, &meeting.b);
    let radius = meeting.radius();
    let axes = [(a, b), (b, a)].map(|(this, other)| axes_of_side(this, other));
    let greatest = larger(axes[0].greatest, axes[1].greatest);
    if greatest > reach + radius {
        return Err(greatest - radius);
    }
    let in_front =
        |this: &Side<'_>, other: &Side<'_>| is_in_front(this.outline, this.seen(other.outline.shape.centre));
    if are_both_edges(meeting) || !in_front(a, b) || !in_front(b, a) {
        return Err(0.0);
    }
    Ok(axes)
}

fn larger(a: f32, b: f32) -> f32 {
    if b > a { b } else { a }
}

/// Edges of chains have no inside that could meet another one's.
fn are_both_edges(meeting: &Meeting<'_>) -> bool {
    [meeting.a, meeting.b].iter().all(|side| is_edge(side.outline))
}

fn is_edge(outline: Outline<'_>) -> bool {
    outline.shape.family == Family::Seamed && outline.shape.count == 2
}

/// Whether the middle of something is on the free side, if this is an edge of a chain.
fn is_in_front(outline: Outline<'_>, middle: Vector) -> bool {
    !is_edge(outline) || dot(outline.normals[0], difference(middle, outline.points[0])) >= 0.0
}

fn axes_of_side(this: &Side<'_>, other: &Side<'_>) -> Axes {
    let origin = this.seen([0.0; 2]);
    axes_of(this.outline, |normal, point| {
        let along = this.for_other(normal);
        let reaches = other.outline.points.iter().map(|&point| dot(along, point));
        let nearest = reaches.fold(f32::MAX, |a, b| if b < a { b } else { a });
        nearest + dot(normal, difference(origin, point))
    })
}

/// The separations of edges, each of which is known by its normal and a point.
fn axes_of(outline: Outline<'_>, separation: impl Fn(Vector, Vector) -> f32) -> Axes {
    let seams = outline.seams();
    let mut axes = Axes { greatest: f32::MIN, outer: None };
    for (edge, (&point, &normal)) in outline.points.iter().zip(outline.normals).enumerate() {
        let separation = separation(normal, point);
        if separation > axes.greatest {
            axes.greatest = separation;
        }
        let is_inner = seams.get(edge).is_some_and(|seam| seam.is_inner);
        if !is_inner && axes.outer.is_none_or(|(best, _)| separation > best) {
            axes.outer = Some((separation, edge));
        }
    }
    axes
}

/// The contacts at the edge of least overlap.
fn by_axes(meeting: &Meeting<'_>, axes: [Axes; 2], reach: f32) -> Manifold {
    let (which, (separation, edge)) = match (axes[0].outer, axes[1].outer) {
        (Some(a), Some(b)) if b.0 > a.0 + REFERENCE_EDGE_HYSTERESIS * reach => (Which::B, b),
        (Some(a), _) => (Which::A, a),
        (None, Some(b)) => (Which::B, b),
        (None, None) => return Manifold::apart(0.0),
    };
    on_edge(meeting, axes, (which, edge), separation, reach)
}

/// The contacts at an edge, if what it meets can have its normal.
fn on_edge(
    meeting: &Meeting<'_>,
    axes: [Axes; 2],
    (which, edge): (Which, usize),
    separation: f32,
    reach: f32,
) -> Manifold {
    let this = meeting.side(which);
    if this.outline.seams().get(edge).is_some_and(|seam| seam.is_inner) {
        return Manifold::apart(0.0);
    }
    let w = this.for_other(scaled(this.outline.normals[edge], -1.0));
    match verdict(meeting.side(which.other()), w) {
        Verdict::Admitted => meeting.on_edge(which, edge, reach),
        Verdict::Skipped => Manifold::apart(0.0),
        Verdict::Snapped => snapped(meeting, axes, which.other(), separation, reach),
    }
}

/// The contact of two corners, or of the edge that they lie on.
fn on_corners(
    meeting: &Meeting<'_>,
    axes: [Axes; 2],
    (corner_a, corner_b, way): (usize, usize, Vector),
    reach: f32,
) -> Manifold {
    for (which, axes) in [Which::A, Which::B].into_iter().zip(axes) {
        if let Some((_, edge)) = axes.outer.filter(|&(_, edge)| along_normal(meeting, which, edge, way)) {
            let found = meeting.on_edge(which, edge, reach);
            if found.count > 0 {
                return found;
            }
        }
    }
    meeting.on_corners(corner_a, corner_b, way, reach)
}

/// The contacts at the best edge of a piece instead. `separation` is how far the cores are apart along another direction.
fn snapped(meeting: &Meeting<'_>, axes: [Axes; 2], which: Which, separation: f32, reach: f32) -> Manifold {
    let Some((_, edge)) = axes[which as usize].outer else { return Manifold::apart(0.0) };
    let found = meeting.on_edge(which, edge, reach);
    let overlap = if separation < 0.0 { -separation } else { 0.0 };
    let deepest = -SNAPPED_PENETRATION_RATIO * overlap - REFERENCE_EDGE_HYSTERESIS * reach - meeting.radius();
    let is_behind = found.separations[..found.count].iter().any(|&separation| separation < deepest);
    if is_behind { Manifold::apart(0.0) } else { found }
}

/// Of two verdicts that which leaves less, and whose it is.
fn strictest(a: Verdict, b: Verdict) -> (Verdict, Which) {
    match (a, b) {
        (Verdict::Skipped, _) | (Verdict::Snapped, Verdict::Admitted) => (a, Which::A),
        _ => (b, Which::B),
    }
}

/// Whether a piece, or what is none, can push along w in its own frame.
pub(super) fn admits(side: &Side<'_>, w: Vector) -> bool {
    verdict(side, w) == Verdict::Admitted
}

/// Whether a piece can push along w. What is no piece can.
fn verdict(side: &Side<'_>, w: Vector) -> Verdict {
    let (outline, seams) = (side.outline, side.outline.seams());
    if seams.is_empty() {
        return Verdict::Admitted;
    }
    let corner = furthest(outline, w);
    let before = (corner + seams.len() - 1) % seams.len();
    match (seams[before].is_inner, seams[corner].is_inner) {
        (false, false) => Verdict::Admitted,
        (false, true) => {
            let after = seams[before].neighbours[1];
            at_corner(outline.normals[before], after, cross(after, w))
        }
        (true, false) => {
            let earlier = seams[corner].neighbours[0];
            at_corner(earlier, outline.normals[corner], cross(w, earlier))
        }
        (true, true) => Verdict::Skipped,
    }
}

/// The corner that lies furthest along a direction.
fn furthest(outline: Outline<'_>, w: Vector) -> usize {
    let (mut best, mut corner) = (f32::MIN, 0);
    for (at, &point) in outline.points.iter().enumerate() {
        let reach = dot(w, point);
        if reach > best {
            (best, corner) = (reach, at);
        }
    }
    corner
}

/// At the corner between two edges of the outline, of which one is the piece's own; `beyond` is the sine of the angle by which
/// the normal in question is beyond that of the other one.
fn at_corner(first: Vector, second: Vector, beyond: f32) -> Verdict {
    let sine = cross(first, second);
    // Two edges that go the same way back and forth jut out as well.
    let juts_out = sine > STRAIGHT_CORNER_SINE || (sine >= -STRAIGHT_CORNER_SINE && dot(first, second) < 0.0);
    if !juts_out {
        Verdict::Snapped
    } else if beyond > EDGE_NORMAL_SLACK {
        Verdict::Skipped
    } else {
        Verdict::Admitted
    }
}
