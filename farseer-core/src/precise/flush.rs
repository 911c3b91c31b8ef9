//! The ghost filter between geoms: flush neighbours that stand still, or move alike, are one surface.
//!
//! A manifold with a tile is found without its neighbours, so that a box which slides over a floor of tiles is told to stop at
//! the side face of the next tile. The side face is inside of the floor: no body can reach it. A contact at a point p of a
//! piece A, with the normal w outward from A, is *hidden* by a neighbour C if
//!
//! 1. p lies in C, or within `FLUSH_FACE_STEP` of it;
//! 2. w is not in the normal cone of C at p. At a point of both pieces the union of the two has no normals but those that both
//!    have (R. T. Rockafellar, R. J.-B. Wets, "Variational Analysis", 1998, 6.42: the regular normal cone of a union is the
//!    intersection of the regular normal cones);
//! 3. the face of A with the normal w does not rise above the face of C that the body lies before, by more than `FLUSH_FACE_STEP` of its
//!    length. So walls, steps and slopes stay what they are at their foot, where (1) and (2) hold as well.
//!
//! A hidden manifold is replaced by that of the best face of A that is not hidden, or dropped: then C has the contact. The
//! manifolds of other pairs are not read: poses, velocities, one-way states, vetoes and the list of pairs decide, which are all
//! saved.

use super::bodies::Bodies;
use super::flight::{Flyer, Two};
use super::manifold::{Manifold, collide};
use super::meeting::Meeting;
use super::one_way::Passage;
use super::outline::{Family, Outline};
use super::pairs::Pairs;
use super::proxies::{Mobility, Proxies, Proxy};
use super::seams::admits;
use super::tuning::Tuning;
use crate::math::plane::{
    Pose, Vector, cross, difference, dot, length, place, rotation, scaled, sum, turn, turn_back,
};
use crate::precise::parameters::narrow_phase::{
    FACE_NORMAL_SINE, FLUSH_FACE_STEP, GHOST_PENETRATION, NORMAL_CONE_SLACK,
};

/// The parts of the step that tell which pieces are flush.
pub(super) struct Flush<'a> {
    pub(super) bodies: &'a Bodies,
    pub(super) proxies: &'a Proxies,
    pub(super) pairs: &'a Pairs,
    pub(super) tuning: &'a Tuning,
    /// Seconds of the step.
    pub(super) dt: f32,
    /// Fraction of their paths that bodies have gone, 0..=1.
    pub(super) part: f32,
}

/// A pair while its contacts are judged: A is the piece that is touched, and B the body's.
#[derive(Clone, Copy)]
struct Judged<'a> {
    proxies: [u32; 2],
    a: &'a Proxy,
    b: &'a Proxy,
    poses: [Pose; 2],
}

impl<'a> Flush<'a> {
    /// The manifold of a pair without what flush neighbours hide.
    pub(super) fn filtered(&self, pair: usize, found: Manifold, reach: f32) -> Manifold {
        let Some(judged) = self.judged(pair).filter(|_| found.count > 0) else { return found };
        let deepest =
            found.separations[..found.count].iter().fold(0.0, |a: f32, &b| if b < a { b } else { a });
        if deepest < -GHOST_PENETRATION * self.tuning.unit || !self.is_hidden(&judged, &found) {
            return found;
        }
        self.instead(&judged, reach)
    }

    /// As [`Two::coming`]: a separation in length units, and how much less it can become in the step. Where only a hidden face is
    /// near, they are those of the best face that is not.
    pub(super) fn coming(&self, pair: usize, two: &Two<'_>) -> (f32, f32) {
        let (apart, closing) = two.coming(self.part);
        let reach = self.tuning.speculative;
        let is_far = apart > reach || apart < -GHOST_PENETRATION * self.tuning.unit;
        let Some(judged) = (!is_far).then(|| self.judged(pair)).flatten() else { return (apart, closing) };
        let [a, b] = [judged.a, judged.b].map(|proxy| self.outline(proxy));
        let found = collide(a, b, judged.poses[0], judged.poses[1], reach);
        if found.count == 0 || !self.is_hidden(&judged, &found) {
            return (apart, closing);
        }
        let point = on_touched(&found, 0);
        match self.best_plane(&judged, point) {
            Some((apart, normal)) => (apart, two.closing(normal)),
            None => (f32::MAX, 0.0),
        }
    }

    /// A pair of which neighbours may hide something: between what stands still, or is moved, and has faces, and a dynamic body
    /// that has another contact partner of that kind.
    fn judged(&self, pair: usize) -> Option<Judged<'a>> {
        let state = &self.pairs.all[pair];
        let proxies = self.pairs.watched[pair].proxies;
        let [a, b] = proxies.map(|proxy| &self.proxies.all[proxy as usize]);
        let is_asked = state.responds && has_faces(a) && b.mobility == Mobility::Dynamic;
        if !is_asked || self.neighbours(proxies, a).next().is_none() {
            return None;
        }
        Some(Judged { proxies, a, b, poses: [a, b].map(|proxy| self.pose(proxy)) })
    }

    /// The other pieces that B collides with, and that may hide a part of A.
    fn neighbours(&self, [at_a, at_b]: [u32; 2], a: &'a Proxy) -> impl Iterator<Item = &'a Proxy> + '_ {
        self.pairs.of(at_b).filter_map(move |pair| {
            let [other, _] = self.pairs.watched[pair].proxies;
            let (state, c) = (&self.pairs.all[pair], &self.proxies.all[other as usize]);
            let is_closed = matches!(state.passage, Passage::Closed | Passage::Landed);
            let is_one = other != at_a && other != at_b && c.geom != a.geom && has_faces(c);
            // The narrow phase comes before the answer of this update.
            let is_vetoed = state.is_vetoed || state.was_vetoed;
            (is_one && state.responds && !is_vetoed && is_closed).then_some(c)
        })
    }

    fn outline(&self, proxy: &Proxy) -> Outline<'a> {
        self.proxies.corners.outline(proxy.shape)
    }

    fn pose(&self, proxy: &Proxy) -> Pose {
        let pose = self.bodies.poses[proxy.body as usize];
        match self.bodies.path.get(proxy.body as usize) {
            Some(&path) if self.part > 0.0 => {
                Flyer { outline: self.outline(proxy), pose, path }.at(self.part)
            }
            _ => pose,
        }
    }

    /// Whether each point of a manifold is hidden by some neighbour.
    fn is_hidden(&self, judged: &Judged<'a>, found: &Manifold) -> bool {
        (0..found.count).all(|at| self.is_point_hidden(judged, on_touched(found, at), found.normal))
    }

    /// Whether a neighbour hides a point of A, relative to the origin of A's body, with a normal outward from A.
    fn is_point_hidden(&self, judged: &Judged<'a>, point: Vector, normal: Vector) -> bool {
        self.neighbours(judged.proxies, judged.a).any(|c| self.hides(c, judged, point, normal))
    }

    fn hides(&self, c: &Proxy, judged: &Judged<'_>, point: Vector, normal: Vector) -> bool {
        let (pose, outline, step) = (self.pose(c), self.outline(c), FLUSH_FACE_STEP * self.tuning.unit);
        let to_c = |point: Vector| {
            let from_c = sum(difference(place(judged.poses[0]), place(pose)), point);
            turn_back(rotation(pose), from_c)
        };
        let (p, w) = (to_c(point), turn_back(rotation(pose), normal));
        if !is_near(outline, p, step)
            || is_in_normal_cone(outline, p, w, step)
            || !self.move_alike(judged, c, point)
        {
            return false;
        }
        let middle = to_c(difference(self.middle_of(judged.b, judged.poses[1]), place(judged.poses[0])));
        let Some(face) = self.facing(judged, outline, pose, middle) else { return false };
        let touched = self.outline(judged.a);
        let in_a = turn_back(rotation(judged.poses[0]), normal);
        let Some(edge) = edge_along(touched, in_a) else { return true };
        let ends = [edge, (edge + 1) % touched.points.len()]
            .map(|corner| to_c(turn(rotation(judged.poses[0]), touched.points[corner])));
        let above = ends.map(|end| dot(outline.normals[face], difference(end, outline.points[face])));
        length_above(above, length(difference(ends[1], ends[0]))) <= step
    }

    fn middle_of(&self, proxy: &Proxy, pose: Pose) -> Vector {
        sum(place(pose), turn(rotation(pose), proxy.shape.centre))
    }

    /// The face of a neighbour that B lies before; none if that is an edge of a chain, and B is behind it.
    fn facing(&self, judged: &Judged<'_>, c: Outline<'_>, pose: Pose, middle: Vector) -> Option<usize> {
        if c.points.len() == 2 {
            return (dot(c.normals[0], difference(middle, c.points[0])) >= 0.0).then_some(0);
        }
        let b = self.outline(judged.b);
        let at = difference(place(judged.poses[1]), place(pose));
        let in_c = |point: Vector| turn_back(rotation(pose), sum(at, turn(rotation(judged.poses[1]), point)));
        let apart = |edge: usize| {
            nearest_of(b, |point| dot(c.normals[edge], difference(in_c(point), c.points[edge])))
        };
        (0..c.points.len()).reduce(|best, edge| if apart(edge) > apart(best) { edge } else { best })
    }

    /// Whether two pieces stand still against each other at a point, relative to the origin of A's body.
    fn move_alike(&self, judged: &Judged<'_>, c: &Proxy, point: Vector) -> bool {
        let at = sum(place(judged.poses[0]), point);
        let velocity = |proxy: &Proxy| {
            let Some(hot) = self.bodies.hot.get(proxy.body as usize) else { return [0.0; 2] };
            let ([x, y, spin, _], arm) = (hot.velocity, difference(at, place(self.pose(proxy))));
            [x - spin * arm[1], y + spin * arm[0]]
        };
        let is_fixed = |proxy: &Proxy| proxy.mobility == Mobility::Fixed;
        (is_fixed(judged.a) && is_fixed(c)) || judged.a.body == c.body || {
            let apart = difference(velocity(judged.a), velocity(c));
            length(apart) * self.dt <= self.tuning.checked
        }
    }

    /// The contacts of the best face of A that is not hidden.
    fn instead(&self, judged: &Judged<'a>, reach: f32) -> Manifold {
        let [a, b] = [judged.a, judged.b].map(|proxy| self.outline(proxy));
        let meeting = Meeting::new(a, b, judged.poses[0], judged.poses[1]);
        let mut best = (f32::MIN, Manifold::apart(0.0));
        for edge in outer_edges(a) {
            let apart = |point| dot(a.normals[edge], difference(meeting.a.seen(point), a.points[edge]));
            let apart = nearest_of(b, apart) - b.shape.radius;
            if apart <= best.0 || apart < -GHOST_PENETRATION * self.tuning.unit {
                continue;
            }
            let w = meeting.a.for_other(scaled(a.normals[edge], -1.0));
            let found = if !admits(&meeting.b, w) {
                Manifold::apart(0.0)
            } else if b.points.is_empty() {
                self.round_on_face(judged, &meeting, edge, reach)
            } else {
                let found = meeting.on_edge(super::meeting::Which::A, edge, reach);
                let is_round = found.count == 0 && b.shape.radius > 0.0;
                if is_round { self.round_on_face(judged, &meeting, edge, reach) } else { found }
            };
            if found.count > 0 && !self.is_hidden(judged, &found) {
                best = (apart, found);
            }
        }
        best.1
    }

    /// The contact of a circle, or of the end of a capsule, with a face: over the face, or over the gap between it and a
    /// neighbour. Over the neighbour that has the contact.
    fn round_on_face(&self, judged: &Judged<'a>, meeting: &Meeting<'_>, edge: usize, reach: f32) -> Manifold {
        let (a, b) = (meeting.a.outline, meeting.b.outline);
        let (normal, start) = (a.normals[edge], a.points[edge]);
        let height = |point: Vector| dot(normal, difference(meeting.a.seen(point), start));
        let lower = |one: Vector, other: Vector| if height(other) < height(one) { other } else { one };
        let core = b.points.iter().copied().reduce(lower).unwrap_or(b.shape.centre);
        let along = difference(a.points[(edge + 1) % a.points.len()], start);
        let span = length(along);
        let at = dot(difference(meeting.a.seen(core), start), along) / span;
        let step = FLUSH_FACE_STEP * self.tuning.unit;
        if at < -step || at > span + step {
            return Manifold::apart(0.0);
        }
        let foot = difference(meeting.a.seen(core), scaled(normal, height(core)));
        let foot_in_world = sum(place(judged.poses[0]), turn(rotation(judged.poses[0]), foot));
        let is_beyond = at < 0.0 || at > span;
        let mut neighbours = self.neighbours(judged.proxies, judged.a);
        if is_beyond && neighbours.any(|c| is_over_face(self.outline(c), self.pose(c), foot_in_world, step)) {
            return Manifold::apart(0.0);
        }
        let separation = height(core) - b.shape.radius;
        let point = sum(foot, scaled(normal, 0.5 * separation));
        Manifold::of_point(normal, point, separation, edge as u32, reach).turned(rotation(judged.poses[0]))
    }

    /// The face of A that is not hidden along which B is farthest from it: the separation in length units, and the normal.
    fn best_plane(&self, judged: &Judged<'a>, point: Vector) -> Option<(f32, Vector)> {
        let [a, b] = [judged.a, judged.b].map(|proxy| self.outline(proxy));
        let q = rotation(judged.poses[0]);
        let at = difference(place(judged.poses[1]), place(judged.poses[0]));
        let in_a = |point: Vector| turn_back(q, sum(at, turn(rotation(judged.poses[1]), point)));
        let mut best: Option<(f32, Vector)> = None;
        for edge in outer_edges(a) {
            let apart = |point| dot(a.normals[edge], difference(in_a(point), a.points[edge]));
            let apart = nearest_of(b, apart) - b.shape.radius;
            let is_shallow = apart >= -GHOST_PENETRATION * self.tuning.unit;
            if !is_shallow || best.is_some_and(|(best, _)| apart <= best) {
                continue;
            }
            let normal = turn(q, a.normals[edge]);
            let foot = turn(q, nearest_on_edge(a, edge, turn_back(q, point)));
            if !self.is_point_hidden(judged, foot, normal) {
                best = Some((apart, normal));
            }
        }
        best
    }
}

/// Static and kinematic pieces with straight faces.
fn has_faces(proxy: &Proxy) -> bool {
    let is_flat = matches!(proxy.shape.family, Family::Polygon | Family::Seamed) && proxy.shape.count >= 2;
    is_flat && matches!(proxy.mobility, Mobility::Fixed | Mobility::Kinematic)
}

/// A point of a manifold on the surface of A, relative to the origin of A's body.
fn on_touched(found: &Manifold, at: usize) -> Vector {
    difference(found.points[at], scaled(found.normal, 0.5 * found.separations[at]))
}

/// The edges of an outline that are a part of its geom's surface.
fn outer_edges<'a>(outline: Outline<'a>) -> impl Iterator<Item = usize> + use<'a> {
    let seams = outline.seams();
    (0..outline.points.len()).filter(move |&edge| !seams.get(edge).is_some_and(|seam| seam.is_inner))
}

/// The least of a height over the corners of an outline, or over the centre of a circle.
fn nearest_of(outline: Outline<'_>, height: impl Fn(Vector) -> f32) -> f32 {
    let points =
        if outline.points.is_empty() { std::slice::from_ref(&outline.shape.centre) } else { outline.points };
    points.iter().map(|&point| height(point)).fold(f32::MAX, |a, b| if b < a { b } else { a })
}

/// Whether a point lies in a piece, or within `step` of it along each of its normals.
fn is_near(outline: Outline<'_>, point: Vector, step: f32) -> bool {
    let is_before = outline
        .points
        .iter()
        .zip(outline.normals)
        .any(|(&on_edge, &normal)| dot(normal, difference(point, on_edge)) > step);
    !is_before && (outline.points.len() > 2 || is_between_ends(outline, point, step))
}

/// Whether a point lies between the ends of the first edge, or beyond them by no more than `step`.
fn is_between_ends(outline: Outline<'_>, point: Vector, step: f32) -> bool {
    let [x, y] = outline.normals[0];
    let along = [-y, x];
    let [start, end] = [0, 1].map(|end| dot(along, difference(point, outline.points[end])));
    // The corners may follow each other either way.
    let (least, most) = if start < end { (start, end) } else { (end, start) };
    most >= -step && least <= step
}

/// Whether a point lies over a face of a piece: level with it to within `step`, and between its ends.
fn is_over_face(outline: Outline<'_>, pose: Pose, point: Vector, step: f32) -> bool {
    let p = turn_back(rotation(pose), difference(point, place(pose)));
    let height = |edge: usize| dot(outline.normals[edge], difference(p, outline.points[edge]));
    let beyond = (0..outline.points.len()).filter(|&edge| height(edge) > 0.0).count();
    let is_level = is_near(outline, p, step) && beyond <= 1;
    is_level && (outline.points.len() > 2 || is_between_ends(outline, p, 0.0))
}

/// Whether w is a normal of a piece at a point, to which faces belong that are within `step` of it. All in the piece's frame.
fn is_in_normal_cone(outline: Outline<'_>, point: Vector, w: Vector, step: f32) -> bool {
    let count = outline.points.len();
    let is_active =
        |edge: usize| dot(outline.normals[edge], difference(point, outline.points[edge])) >= -step;
    if count == 2 {
        return is_normal_of_chain(outline, point, w, step);
    }
    (0..count).filter(|&edge| is_active(edge)).any(|edge| {
        let (normal, next) = (outline.normals[edge], (edge + 1) % count);
        is_between(normal, normal, w) || (is_active(next) && is_between(normal, outline.normals[next], w))
    })
}

/// The same for an edge of a chain, which has a normal on its free side alone, and at its ends those up to its neighbours'.
fn is_normal_of_chain(outline: Outline<'_>, point: Vector, w: Vector, step: f32) -> bool {
    let normal = outline.normals[0];
    let Some([before, after]) = outline.seams().first().map(|seam| seam.neighbours) else { return true };
    let is_at = |end: usize| length(difference(point, outline.points[end])) <= 2.0 * step;
    is_between(normal, normal, w)
        || (is_at(0) && cross(before, normal) > 0.0 && is_between(before, normal, w))
        || (is_at(1) && cross(normal, after) > 0.0 && is_between(normal, after, w))
}

/// Whether w lies between two normals that follow each other around a convex outline.
fn is_between(first: Vector, second: Vector, w: Vector) -> bool {
    cross(first, w) >= -NORMAL_CONE_SLACK
        && cross(w, second) >= -NORMAL_CONE_SLACK
        && dot(sum(first, second), w) > 0.0
}

/// The outer edge whose normal a direction is.
fn edge_along(outline: Outline<'_>, w: Vector) -> Option<usize> {
    outer_edges(outline).find(|&edge| {
        let normal = outline.normals[edge];
        cross(normal, w).abs() <= FACE_NORMAL_SINE && dot(normal, w) > 0.0
    })
}

/// How much of a segment lies above a plane, from the heights of its ends.
fn length_above([one, other]: [f32; 2], length: f32) -> f32 {
    let (low, high) = if one < other { (one, other) } else { (other, one) };
    if high <= 0.0 {
        0.0
    } else if low >= 0.0 {
        length
    } else {
        length * high / (high - low)
    }
}

/// The point of an edge that is nearest to a point.
fn nearest_on_edge(outline: Outline<'_>, edge: usize, point: Vector) -> Vector {
    let (start, end) = (outline.points[edge], outline.points[(edge + 1) % outline.points.len()]);
    let along = difference(end, start);
    let part = (dot(difference(point, start), along) / dot(along, along)).clamp(0.0, 1.0);
    sum(start, scaled(along, part))
}
