//! Where two things with depth touch: outlines extruded along the depth axis, balls, and the ground.
//!
//! Two outlines meet in the plane or along the depth axis, never obliquely: along the axis that they entered last. While they
//! touch they keep it. Faces that are flush are what something rests on or slides along, and no walls: without that rule every
//! seam between two floors would stop what slides over it.

use super::balls::{self, Ball};
use super::overlap::{Covered, covered};
use super::passing::{passes_corner, passes_over};
use super::upright::Upright;
use super::{slant, standing};
use crate::math::plane::{
    Pose, Vector, difference, dot, length, place, rotation, scaled, sum, turn, turn_back,
};
use crate::precise::manifold::{Manifold, clip, collide, greatest_separation};
use crate::precise::outline::{Family, Outline};
use crate::precise::parameters::depth::{
    GRAZED_RIM_OVERLAP, LOADED_FLUSH_OVERLAP, MOVING_FLUSH_OVERLAP, PRISM_ENTRY_MEMORY, PRISM_FACE_COSINE,
    RESTING_FLUSH_OVERLAP, RIM_SECANT_STEPS,
};
use crate::shape::SlantedBox;

/// Something with depth.
#[derive(Clone, Copy)]
pub(in crate::precise) struct Solid<'a> {
    pub(super) outline: Outline<'a>,
    pub(super) pose: Pose,
    pub(super) kind: Kind,
    /// Where it is along the depth axis.
    pub(super) z: f32,
    /// Way of the last step along x, y and z.
    pub(super) motion: [f32; 3],
    /// Way of the coming step, if nothing changes its velocity.
    pub(super) ahead: [f32; 3],
    /// Where it is sheared.
    pub(super) slant: Option<SlantedBox>,
    /// What it is if it stands upright.
    pub(super) upright: Option<&'a Upright>,
}

/// What an outline is in three axes.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(in crate::precise) enum Kind {
    /// Extruded by so much to both sides.
    Prism(f32),
    /// A ball of its radius.
    Ball,
    /// Everything below y = 0, which is down.
    Ground,
    /// What stands upright, whatever its outline.
    Upright,
}

/// Along which axis two outlines touched in the step before.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(in crate::precise) enum Before {
    Nothing,
    Plane,
    /// With this sign of the normal.
    Depth(f32),
    /// One of the two is upright, and was above or below the other one.
    Over,
}

impl Before {
    pub(super) fn flipped(self) -> Self {
        if let Before::Depth(side) = self { Before::Depth(-side) } else { self }
    }
}

/// How contacts are found.
#[derive(Debug, Clone, Copy)]
pub(in crate::precise) struct Limits {
    /// How far contacts reach.
    pub(super) reach: f32,
    /// How far they do where nothing sweeps through what is in its way.
    pub(super) usual: f32,
    /// Faces that overlap by less are flush.
    pub(super) flush: f32,
}

impl Limits {
    /// A body that is pressed against a face penetrates it, and the next flush face as deep: `sunk` is its penetration, in length
    /// units, or was when it parted. A static body is where it was built, others are near that.
    pub(in crate::precise) fn new([reach, usual]: [f32; 2], is_static: bool, sunk: f32) -> Self {
        let unpressed = if is_static { RESTING_FLUSH_OVERLAP } else { MOVING_FLUSH_OVERLAP };
        let flush = (unpressed * usual + sunk).min(LOADED_FLUSH_OVERLAP * usual);
        Limits { reach, usual, flush }
    }

    /// How much one of two flush faces may be higher than the other, in length units, if none is pressed; more if one of them can be
    /// pushed down.
    pub(in crate::precise) fn flush(usual: f32, gives_way: bool) -> f32 {
        usual * if gives_way { LOADED_FLUSH_OVERLAP } else { MOVING_FLUSH_OVERLAP }
    }
}

impl Solid<'_> {
    /// Whether it is a ball, or ends in two.
    pub(in crate::precise) fn is_round(&self) -> bool {
        self.kind == Kind::Ball || self.upright.is_some_and(|upright| upright.rounding > 0.0)
    }

    /// Whether it is a prism along the depth axis that is not sheared.
    pub(in crate::precise) fn is_upright_prism(&self) -> bool {
        matches!(self.kind, Kind::Prism(_)) && self.slant.is_none() && !self.outline.points.is_empty()
    }

    /// Whether it has a face across this normal of the plane.
    pub(in crate::precise) fn has_face(&self, normal: Vector) -> bool {
        let is_it = |&face: &Vector| dot(turn(rotation(self.pose), face), normal) > PRISM_FACE_COSINE;
        self.kind == Kind::Ground || (self.is_upright_prism() && self.outline.normals.iter().any(is_it))
    }

    /// How far it reaches along a normal of the plane, as a coordinate in length units; the ground to y = 0.
    pub(in crate::precise) fn height_along(&self, normal: Vector) -> f32 {
        if self.kind == Kind::Ground {
            return 0.0;
        }
        let direction = turn_back(rotation(self.pose), normal);
        dot(place(self.pose), normal) + self.outline.shape.radius + self.outline.farthest_along(direction)
    }
}

/// The contacts of A and B, of which A gives way less.
pub(super) fn touch(a: Solid<'_>, b: Solid<'_>, before: Before, limits: Limits) -> Manifold {
    match (a.kind, b.kind) {
        (Kind::Upright, _) | (_, Kind::Upright) => standing::touch(a, b, before, limits),
        (Kind::Ground, Kind::Ball) => ball_on_ground(a, b, limits.reach),
        (Kind::Ground, _) => prism_on_ground(a, b, limits.reach),
        (Kind::Ball, Kind::Ball) => {
            balls::touch(Ball::of(a), Ball::of(b), before == Before::Nothing, limits.reach)
        }
        (Kind::Ball, Kind::Prism(half)) => {
            flipped(prism_and_ball(b, half, a, before.flipped(), limits.reach), b, a)
        }
        (Kind::Prism(half), Kind::Ball) => match &a.slant {
            Some(shape) => slant::ball(shape, a, b, limits.reach),
            None => prism_and_ball(a, half, b, before, limits.reach),
        },
        (Kind::Prism(half_a), Kind::Prism(half_b)) => prisms(a, b, half_a + half_b, before, limits),
        // Nothing is below the ground but the ground.
        (_, Kind::Ground) => Manifold::apart(0.0),
    }
}

/// B against A, of what was found as A against B.
pub(super) fn flipped(mut found: Manifold, a: Solid<'_>, b: Solid<'_>) -> Manifold {
    found = found.flipped(a.pose, b.pose);
    found.normal_z = -found.normal_z;
    found.depths = found.depths.map(|depth| depth + (b.z - a.z));
    found
}

impl Solid<'_> {
    /// Where it is after a part of its way through the step, which began apart from what it meets.
    pub(in crate::precise) fn move_along(&mut self, pose: Pose, path: [f32; 4], part: f32) {
        self.pose = pose;
        self.z += part * path[3];
        let way = [path[0], path[1], path[3]];
        (self.motion, self.ahead) = (way.map(|way| part * way), way);
    }

    /// The middle of a ball.
    pub(super) fn centre(&self) -> Vector {
        sum(place(self.pose), turn(rotation(self.pose), self.outline.shape.centre))
    }
}

/// Along the depth axis B is on this side of A: as it was before the last step.
fn side_of(a: Solid<'_>, b: Solid<'_>) -> f32 {
    let motion = b.motion[2] - a.motion[2];
    let was = b.z - a.z - motion;
    if was > 0.0 || (was == 0.0 && motion < 0.0) { 1.0 } else { -1.0 }
}

fn prisms(a: Solid<'_>, b: Solid<'_>, halves: f32, before: Before, limits: Limits) -> Manifold {
    let side = if let Before::Depth(side) = before { side } else { side_of(a, b) };
    // Who has come out on the other side is apart, too.
    let apart = (b.z - a.z).abs() - halves;
    if apart > limits.reach {
        return Manifold::apart(apart);
    }
    let gap = side * (b.z - a.z) - halves;
    let plane = in_plane(a, b, halves, limits);
    if plane.count == 0 {
        return plane;
    }
    let apart = deepest(&plane);
    let is_in_plane = match before {
        Before::Plane if gap <= 0.0 => true,
        Before::Depth(_) if apart <= 0.0 => false,
        _ if gap > 0.0 || apart > 0.0 => {
            // Not in each other yet: they meet along the axis along which they are apart, once they are beside each other.
            let is_beside = (gap <= 0.0 && gap < -limits.flush) || (apart <= 0.0 && apart < -limits.flush);
            if !is_beside || passes_corner(a, b, side, (apart, gap), &plane) {
                return Manifold::apart(0.0);
            }
            apart > 0.0
        }
        // Hardly in each other along either axis: the next step tells.
        _ if gap >= -limits.flush && apart >= -limits.flush => return Manifold::apart(0.0),
        _ => entered_in_plane(a, b, side, gap, &plane, limits),
    };
    if is_in_plane { plane } else { along_depth(a, b, side, gap) }
}

/// The least distance of points.
pub(super) fn deepest(found: &Manifold) -> f32 {
    let [one, other] = found.separations;
    if found.count > 1 && other < one { other } else { one }
}

/// Contacts of two outlines in the plane. Flush faces win.
fn in_plane(a: Solid<'_>, b: Solid<'_>, halves: f32, limits: Limits) -> Manifold {
    if let Some(shape) = a.slant {
        let half = halves - shape.half[2];
        let within = |z: f32| (z - shape.centre.z).clamp(-shape.half[2], shape.half[2]) + shape.centre.z;
        let (corners, outline) = slant::swept(&shape, within(b.z - half), within(b.z + half));
        let swept = Solid {
            outline: corners.outline(outline),
            pose: [a.pose[0], a.pose[1], 1.0, 0.0],
            slant: None,
            ..a
        };
        return slant::in_space(in_plane(swept, b, halves, limits), &shape);
    }
    match flush_edge(a, b, limits) {
        Some((edge, at, q)) => clip(a.outline, b.outline, at, q, edge, limits.reach).turned(rotation(a.pose)),
        None => {
            let found = collide(a.outline, b.outline, a.pose, b.pose, limits.reach);
            if passes_over(a, b, &found) { Manifold::apart(0.0) } else { found }
        }
    }
}

/// The edge of A that B lies flush on and slides along, once they are as near as they can be, while another one of A or of B is
/// what keeps them apart: a seam is no wall, and the foot of a slope is none.
fn flush_edge(a: Solid<'_>, b: Solid<'_>, limits: Limits) -> Option<(usize, Vector, [f32; 2])> {
    if a.outline.shape.family != Family::Polygon || b.outline.shape.family != Family::Polygon {
        return None;
    }
    let (qa, qb) = (rotation(a.pose), rotation(b.pose));
    let apart = difference(place(b.pose), place(a.pose));
    let (at, q) = (turn_back(qa, apart), turn_back(qa, qb));
    let (of_a, edge) = greatest_separation(a.outline, b.outline, at, q);
    let (of_b, other) =
        greatest_separation(b.outline, a.outline, turn_back(qb, scaled(apart, -1.0)), turn_back(qb, qa));
    let (best, normal, edge) = if of_b > of_a {
        (of_b, scaled(turn(q, b.outline.normals[other]), -1.0), None)
    } else {
        (of_a, a.outline.normals[edge], Some(edge))
    };
    if best > limits.reach || best < -limits.flush {
        return None;
    }
    let way = turn_back(qa, [b.ahead[0] - a.ahead[0], b.ahead[1] - a.ahead[1]]);
    let closing = -dot(way, normal);
    let arrival = if best > 0.0 && closing > 0.0 { scaled(way, best / closing) } else { [0.0; 2] };
    let is_flush = |&one: &usize| {
        let (point, normal) = (a.outline.points[one], a.outline.normals[one]);
        let along = turn_back(q, normal);
        let nearest = b.outline.points.iter().map(|&corner| dot(along, corner));
        let nearest = nearest.fold(f32::MAX, |least, one| if one < least { one } else { least });
        let apart = nearest + dot(normal, sum(difference(at, point), arrival));
        Some(one) != edge && apart.abs() <= limits.flush
    };
    let across = |edge: usize| dot(way, a.outline.normals[edge]).abs();
    let flush = (0..a.outline.points.len()).filter(is_flush);
    let slid_along = flush.min_by(|&one, &other| across(one).total_cmp(&across(other)))?;
    let keeps = edge.is_some_and(|edge| across(edge) <= across(slid_along));
    (!keeps).then_some((slid_along, at, q))
}

/// Two outlines that are in each other, and were not in touch: whether it was in the plane that they came in last.
fn entered_in_plane(
    a: Solid<'_>,
    b: Solid<'_>,
    side: f32,
    gap: f32,
    plane: &Manifold,
    limits: Limits,
) -> bool {
    let apart = deepest(plane);
    if apart >= -limits.flush || gap >= -limits.flush {
        return apart >= -limits.flush;
    }
    let motion: [f32; 3] = std::array::from_fn(|axis| b.motion[axis] - a.motion[axis]);
    if motion[2] == 0.0 {
        return true;
    }
    let since = |overlap: f32, closing: f32| {
        let steps = if closing > 0.0 { overlap / closing } else { f32::INFINITY };
        if steps <= PRISM_ENTRY_MEMORY { steps } else { f32::INFINITY }
    };
    let in_plane = since(-apart, -dot([motion[0], motion[1]], plane.normal));
    let along_depth = since(-gap, -side * motion[2]);
    if in_plane == along_depth { apart > gap } else { in_plane < along_depth }
}

/// Front against back: one point, in the middle of what the outlines have in common.
fn along_depth(a: Solid<'_>, b: Solid<'_>, side: f32, gap: f32) -> Manifold {
    let shift = a.slant.map_or([0.0; 2], |shape| {
        let shift = shape.shift(side * shape.half[2]);
        [shift.x, shift.y]
    });
    let pose = [a.pose[0] + shift[0], a.pose[1] + shift[1], a.pose[2], a.pose[3]];
    let Some(Covered { middle, spread }) = covered(a.outline, pose, b.outline, b.pose) else {
        return Manifold::apart(0.0);
    };
    let mut found = Manifold::of_point([0.0; 2], difference(middle, place(a.pose)), gap, 0, f32::MAX);
    (found.normal_z, found.spread) = (side, spread);
    found
}

/// Distance of a ball's middle from an extruded outline: in the plane from the outline, along the depth axis from its ends,
/// and obliquely from its rims.
pub(super) fn prism_and_ball(
    prism: Solid<'_>,
    half: f32,
    ball: Solid<'_>,
    before: Before,
    reach: f32,
) -> Manifold {
    let radius = ball.outline.shape.radius;
    let [x, y] = ball.centre();
    let mut point = ball.outline;
    (point.shape.radius, point.shape.centre) = (0.0, [0.0; 2]);
    let plane = collide(prism.outline, point, prism.pose, [x, y, 1.0, 0.0], reach + radius);
    if plane.count == 0 {
        return Manifold::apart(difference_of(plane.gap, radius));
    }
    let apart = plane.separations[0];
    let side = match before {
        Before::Depth(side) if side * (ball.z - prism.z) + half + radius > 0.0 => side,
        _ => side_of(prism, ball),
    };
    let gap = side * (ball.z - prism.z) - half;
    let (mut normal, mut normal_z, distance) = if apart > 0.0 && gap > 0.0 {
        let distance = length([apart, gap]);
        (scaled(plane.normal, apart / distance), side * gap / distance, distance)
    } else if stays_in_plane(apart, gap, before) {
        (plane.normal, 0.0, apart)
    } else {
        ([0.0; 2], side, gap)
    };
    let mut separation = distance - radius;
    if separation > reach {
        return Manifold::apart(separation);
    }
    let is_on_rim = apart > 0.0 && (gap > 0.0 || is_corner(prism, &plane));
    if separation > 0.0 && is_on_rim {
        let Some(meeting) = meets_rim(prism, half, ball, separation, reach) else {
            return Manifold::apart(0.0);
        };
        (separation, normal, normal_z) = meeting;
    }
    let arm = difference([x, y], place(prism.pose));
    let point = difference(arm, scaled(normal, radius + 0.5 * separation));
    let mut found = Manifold::of_point(normal, point, separation, 0, f32::MAX);
    found.normal_z = normal_z;
    found
}

/// Whether a normal is that of a corner of an outline, and not of an edge.
fn is_corner(prism: Solid<'_>, plane: &Manifold) -> bool {
    let edge = prism.outline.normals.get(plane.features[0] as usize);
    edge.is_none_or(|&edge| dot(turn(rotation(prism.pose), edge), plane.normal) < 0.9999)
}

/// Where a ball that is this far from a rim will touch it in this step, as it moves: its distance along the normal that it will
/// have there, and that normal. `None` if it passes: what rolls over a seam between two floors is not stopped by the rim of the
/// second one, and what rolls from a floor on to a slope meets the slope.
fn meets_rim(
    prism: Solid<'_>,
    half: f32,
    ball: Solid<'_>,
    separation: f32,
    reach: f32,
) -> Option<(f32, Vector, f32)> {
    let way: [f32; 3] = std::array::from_fn(|axis| ball.ahead[axis] - prism.ahead[axis]);
    let (mut before, mut after) = ((0.0, separation), (1.0, nearness(prism, half, ball, way, 1.0, reach)?.0));
    if after.1 > -GRAZED_RIM_OVERLAP * reach {
        return None;
    }
    // The distance is convex where the outline is: the secant comes to its root from behind.
    let mut found = None;
    for _ in 0..RIM_SECANT_STEPS {
        let part = before.0 + (after.0 - before.0) * before.1 / (before.1 - after.1);
        let (distance, normal, normal_z) = nearness(prism, half, ball, way, part, reach)?;
        let along = way[0] * normal[0] + way[1] * normal[1] + way[2] * normal_z;
        found = Some((distance - part * along, normal, normal_z));
        if distance > 0.0 {
            before = (part, distance);
        } else {
            after = (part, distance);
        }
    }
    found
}

/// Distance of a ball from an extruded outline after a part of the step, and its normal.
pub(super) fn nearness(
    prism: Solid<'_>,
    half: f32,
    ball: Solid<'_>,
    way: [f32; 3],
    part: f32,
    reach: f32,
) -> Option<(f32, Vector, f32)> {
    let radius = ball.outline.shape.radius;
    let [x, y] = sum(ball.centre(), [part * way[0], part * way[1]]);
    let mut point = ball.outline;
    (point.shape.radius, point.shape.centre) = (0.0, [0.0; 2]);
    let plane = collide(prism.outline, point, prism.pose, [x, y, 1.0, 0.0], reach + radius);
    if plane.count == 0 {
        return None;
    }
    let apart = plane.separations[0];
    let behind = ball.z + part * way[2] - prism.z;
    let side = if behind < 0.0 { -1.0 } else { 1.0 };
    let gap = behind.abs() - half;
    Some(if apart > 0.0 && gap > 0.0 {
        let distance = length([apart, gap]);
        (distance - radius, scaled(plane.normal, apart / distance), side * gap / distance)
    } else if apart >= gap {
        (apart - radius, plane.normal, 0.0)
    } else {
        (gap - radius, [0.0; 2], side)
    })
}

fn difference_of(gap: f32, radius: f32) -> f32 {
    if gap > radius { gap - radius } else { 0.0 }
}

/// A ball's middle is outside of one at most: a middle that is inside leaves as it came.
fn stays_in_plane(apart: f32, gap: f32, before: Before) -> bool {
    match before {
        Before::Plane if apart <= 0.0 && gap <= 0.0 => true,
        Before::Depth(_) if apart <= 0.0 && gap <= 0.0 => false,
        _ => apart >= gap,
    }
}

/// Up, out of the ground.
const UP: Vector = [0.0, -1.0];

fn ball_on_ground(ground: Solid<'_>, ball: Solid<'_>, reach: f32) -> Manifold {
    let ([x, y], radius) = (ball.centre(), ball.outline.shape.radius);
    let separation = -(y + radius);
    let point = difference([x, 0.5 * (y + radius)], place(ground.pose));
    Manifold::of_point(UP, point, separation, 0, reach)
}

/// The lowest corner and the lower one of its neighbours; what is round adds its radius.
fn prism_on_ground(ground: Solid<'_>, b: Solid<'_>, reach: f32) -> Manifold {
    let Outline { shape, points, .. } = b.outline;
    let q = rotation(b.pose);
    let height = |corner: Vector| b.pose[1] + q[1] * corner[0] + q[0] * corner[1] + shape.radius;
    if points.is_empty() {
        return ball_on_ground(ground, b, reach);
    }
    let lower =
        |one: usize, other: usize| if height(points[other]) > height(points[one]) { other } else { one };
    let first = (1..points.len()).fold(0, lower);
    let count = points.len();
    let second = lower((first + count - 1) % count, (first + 1) % count);
    let mut found = Manifold { normal: UP, gap: -height(points[first]), ..Manifold::default() };
    for corner in [first, second] {
        let separation = -height(points[corner]);
        if separation < reach && (found.count == 0 || second != first) {
            let at = sum(place(b.pose), turn(q, points[corner]));
            found.points[found.count] = difference([at[0], -0.5 * separation], place(ground.pose));
            found.separations[found.count] = separation;
            found.features[found.count] = corner as u32;
            found.count += 1;
        }
    }
    found
}
