//! Narrow phase: ghost filter between geoms. Flush geoms that are static, or move alike, count as one surface.
//!
//! The manifold of a body with one tile ignores the neighbours of the tile, so a box that slides over a floor of tiles would
//! stop at the side face of the next tile. That face is inside of the floor, and no body can touch it. Let p be a contact point
//! on a piece A and w the contact normal there, outward from A. A neighbour C *hides* the point if
//!
//! 1. p lies in C, or within `FLUSH_FACE_MAX_STEP` of it;
//! 2. w is not in the normal cone of C at p. The union of A and C has only those normals at p that both have. This is a
//!    theorem: the regular normal cone of a union is the intersection of the regular normal cones (R. T. Rockafellar, R. J.-B.
//!    Wets, "Variational Analysis", 1998, 6.42);
//! 3. the face of A with normal w rises above the face of C toward the body B by at most `FLUSH_FACE_MAX_STEP` of its length.
//!    Walls, steps and slopes rise farther, and keep their contacts at the foot, where 1 and 2 hold as well.
//!
//! A hidden manifold is replaced by that of the face of A with the largest separation among those that no neighbour hides.
//! Without such a face the manifold is dropped, and C has the contact. The filter reads poses, velocities, one-way states,
//! vetoes and the list of pairs, which are all in snapshots; it does not read manifolds of other pairs.

use crate::bodies::BodySet;
use crate::broad_phase::pairs::OneWayState;
use crate::broad_phase::pairs::Pairs;
use crate::broad_phase::proxies::{BodyType, Proxies, Proxy};
use crate::continuous_collision::time_of_impact::{SweptPair, SweptShape};
use crate::index::{PairIndex, ProxyIndex};
use crate::math::plane::{
    Pose, Vector, cross, difference, dot, length, rotate, rotate_inverse, rotation, scaled, sum, translation,
};
use crate::narrow_phase::ghost_filter::admits_normal;
use crate::narrow_phase::manifold::Manifold;
use crate::narrow_phase::shape_dispatch::collide;
use crate::narrow_phase::shape_pair::ShapePair;
use crate::parameters::narrow_phase::{
    FACE_NORMAL_MAX_SIN, FLUSH_FACE_MAX_STEP, GHOST_MAX_PENETRATION, NORMAL_CONE_TOLERANCE_SIN,
};
use crate::scaled_parameters::Parameters;
use crate::shape::ShapeRef;

/// References to the state of the simulator that the ghost filter between flush geoms reads.
pub(crate) struct FlushFilter<'a> {
    pub(crate) bodies: &'a BodySet,
    pub(crate) proxies: &'a Proxies,
    pub(crate) pairs: &'a Pairs,
    pub(crate) parameters: &'a Parameters,
    /// Length of the step, in seconds.
    pub(crate) dt: f32,
    /// Time at which the filter evaluates poses, as a fraction of the step, 0..=1.
    pub(crate) time: f32,
}

/// A pair whose manifold the filter examines: A is a static or kinematic piece, B a piece of a dynamic body.
#[derive(Clone, Copy)]
struct FilteredPair<'a> {
    proxies: [ProxyIndex; 2],
    a: &'a Proxy,
    b: &'a Proxy,
    poses: [Pose; 2],
}

impl<'a> FlushFilter<'a> {
    /// Returns the manifold of a pair without contacts that flush neighbours of A hide: `manifold` itself, or that of another
    /// face of A, or one without points. Manifolds deeper than [`GHOST_MAX_PENETRATION`] are returned unchanged. `margin`:
    /// contact margin in length units.
    pub(crate) fn filter_manifold(&self, pair: PairIndex, manifold: Manifold, margin: f32) -> Manifold {
        let Some(filtered) = self.filter_pair(pair).filter(|_| manifold.count > 0) else { return manifold };
        let deepest =
            manifold.separations[..manifold.count].iter().fold(0.0, |a: f32, &b| if b < a { b } else { a });
        if deepest < -GHOST_MAX_PENETRATION * self.parameters.length_unit
            || !self.is_hidden(&filtered, &manifold)
        {
            return manifold;
        }
        self.replacement_manifold(&filtered, margin)
    }

    /// Returns the separation of a pair at the time of the filter (length units, negative for penetration), and the largest
    /// decrease of the separation per step (length units). If a neighbour hides the closest face of A, both values are those of
    /// the face with the largest separation that no neighbour hides.
    ///
    /// Used for the time of impact, in place of [`SweptPair::separation_and_closing_speed`]. Without such a face the pair has
    /// no impact: the result is (`f32::MAX`, 0).
    pub(crate) fn separation_and_closing(&self, pair: PairIndex, two: &SweptPair<'_>) -> (f32, f32) {
        let (separation, closing) = two.separation_and_closing_speed(self.time);
        let margin = self.parameters.speculative_distance;
        let is_far = separation > margin || separation < -GHOST_MAX_PENETRATION * self.parameters.length_unit;
        let Some(filtered) = (!is_far).then(|| self.filter_pair(pair)).flatten() else {
            return (separation, closing);
        };
        let [a, b] = [filtered.a, filtered.b].map(|proxy| self.shape_ref(proxy));
        let manifold = collide(a, b, filtered.poses[0], filtered.poses[1], margin);
        if manifold.count == 0 || !self.is_hidden(&filtered, &manifold) {
            return (separation, closing);
        }
        let point = point_on_a(&manifold, 0);
        match self.best_exposed_face(&filtered, point) {
            Some((separation, normal)) => (separation, two.closing_speed(normal)),
            None => (f32::MAX, 0.0),
        }
    }

    /// Returns the proxies and poses of a pair for the filter; `None` if no neighbour can hide the contacts of the pair. The
    /// filter applies if A is a static or kinematic polygon and B belongs to a dynamic body that also has a pair with another
    /// such polygon.
    fn filter_pair(&self, pair: PairIndex) -> Option<FilteredPair<'a>> {
        let state = self.pairs.state(pair);
        let proxies = self.pairs.proxies_of(pair);
        let [a, b] = proxies.map(|proxy| self.proxies.proxy(proxy));
        let may_be_hidden = state.responds && has_faces(a) && b.body_type == BodyType::Dynamic;
        if !may_be_hidden || self.neighbours(proxies, a).next().is_none() {
            return None;
        }
        Some(FilteredPair { proxies, a, b, poses: [a, b].map(|proxy| self.pose(proxy)) })
    }

    /// Returns the static or kinematic polygons of other geoms that B has a colliding pair with. `at_a` and `at_b` are the
    /// proxies A and B.
    fn neighbours(
        &self,
        [at_a, at_b]: [ProxyIndex; 2],
        a: &'a Proxy,
    ) -> impl Iterator<Item = &'a Proxy> + '_ {
        self.pairs.pairs_of(at_b).filter_map(move |pair| {
            let [other, _] = self.pairs.linked_proxies_of(pair);
            // Most partners are dynamic, and end here before more of the pair is read.
            if other == at_a || self.proxies.body_type_of(other).takes_impulses() {
                return None;
            }
            let (state, c) = (self.pairs.state(pair), self.proxies.proxy(other));
            let is_closed = matches!(state.one_way_state, OneWayState::Closed | OneWayState::Landed);
            let is_other_piece = other != at_b && c.owner != a.owner && has_faces(c);
            // The narrow phase runs before the handlers of this update decide.
            let is_vetoed = state.is_vetoed || state.was_vetoed;
            (is_other_piece && state.responds && !is_vetoed && is_closed).then_some(c)
        })
    }

    /// Returns the shape of a proxy with slices of its vertices and normals.
    fn shape_ref(&self, proxy: &Proxy) -> ShapeRef<'a> {
        self.proxies.vertices.shape_ref(proxy.shape)
    }

    /// Returns the world pose of a proxy's body at the time of the filter, `self.time`.
    fn pose(&self, proxy: &Proxy) -> Pose {
        let pose = self.bodies.poses[proxy.body];
        match self.bodies.delta_pose.at(proxy.body) {
            Some(&displacement) if self.time > 0.0 => {
                SweptShape { shape: self.shape_ref(proxy), pose, displacement }.pose_at(self.time)
            }
            _ => pose,
        }
    }

    /// Returns whether neighbours of A hide all points of a manifold.
    fn is_hidden(&self, filtered: &FilteredPair<'a>, manifold: &Manifold) -> bool {
        (0..manifold.count)
            .all(|index| self.is_point_hidden(filtered, point_on_a(manifold, index), manifold.normal))
    }

    /// Returns whether a neighbour hides a point of A. `point` is relative to the origin of A's body, in world axes, length
    /// units; `normal` is the unit contact normal, outward from A.
    fn is_point_hidden(&self, filtered: &FilteredPair<'a>, point: Vector, normal: Vector) -> bool {
        self.neighbours(filtered.proxies, filtered.a).any(|c| self.hides(c, filtered, point, normal))
    }

    /// Returns whether the piece `c` hides a point of piece A of the pair. It does if the point lies in `c` or near it,
    /// `normal` is no normal of `c` there, and the face of A hardly rises above that of `c`. Also, A and `c` must not move
    /// relative to each other at the point. `point` (world axes, length units) is relative to the origin of A's body.
    fn hides(&self, c: &Proxy, filtered: &FilteredPair<'_>, point: Vector, normal: Vector) -> bool {
        let (pose, shape, max_step) =
            (self.pose(c), self.shape_ref(c), FLUSH_FACE_MAX_STEP * self.parameters.length_unit);
        let to_c = |point: Vector| {
            let from_c = sum(difference(translation(filtered.poses[0]), translation(pose)), point);
            rotate_inverse(rotation(pose), from_c)
        };
        let (p, w) = (to_c(point), rotate_inverse(rotation(pose), normal));
        if !is_near(shape, p, max_step)
            || is_in_normal_cone(shape, p, w, max_step)
            || !self.move_together(filtered, c, point)
        {
            return false;
        }
        let middle = to_c(difference(
            self.shape_centre(filtered.b, filtered.poses[1]),
            translation(filtered.poses[0]),
        ));
        let Some(face) = self.face_toward_b(filtered, shape, pose, middle) else { return false };
        let touched = self.shape_ref(filtered.a);
        let in_a = rotate_inverse(rotation(filtered.poses[0]), normal);
        let Some(edge) = edge_with_normal(touched, in_a) else { return true };
        let ends = [edge, (edge + 1) % touched.vertices.len()]
            .map(|corner| to_c(rotate(rotation(filtered.poses[0]), touched.vertices[corner])));
        let above = ends.map(|end| dot(shape.normals[face], difference(end, shape.vertices[face])));
        length_above(above, length(difference(ends[1], ends[0]))) <= max_step
    }

    /// Returns the centre of a proxy's AABB in world coordinates, length units, for a pose of its body.
    fn shape_centre(&self, proxy: &Proxy, pose: Pose) -> Vector {
        sum(translation(pose), rotate(rotation(pose), proxy.shape.centre))
    }

    /// Returns the index of the face of the neighbour `c` with the largest separation from B. `None` if `c` is an edge of a
    /// chain and B is behind it. `middle` is the centre of B in the frame of `c`, length units.
    fn face_toward_b(
        &self,
        filtered: &FilteredPair<'_>,
        c: ShapeRef<'_>,
        pose: Pose,
        middle: Vector,
    ) -> Option<usize> {
        if c.vertices.len() == 2 {
            return (dot(c.normals[0], difference(middle, c.vertices[0])) >= 0.0).then_some(0);
        }
        let b = self.shape_ref(filtered.b);
        let position = difference(translation(filtered.poses[1]), translation(pose));
        let in_c = |point: Vector| {
            rotate_inverse(rotation(pose), sum(position, rotate(rotation(filtered.poses[1]), point)))
        };
        let separation = |edge: usize| {
            min_height(b, |point| dot(c.normals[edge], difference(in_c(point), c.vertices[edge])))
        };
        (0..c.vertices.len())
            .reduce(|best, edge| if separation(edge) > separation(best) { edge } else { best })
    }

    /// Returns whether A and the piece `c` do not move relative to each other at a point. `point` is relative to the origin of
    /// A's body, in world axes, length units.
    fn move_together(&self, filtered: &FilteredPair<'_>, c: &Proxy, point: Vector) -> bool {
        let position = sum(translation(filtered.poses[0]), point);
        let velocity = |proxy: &Proxy| {
            let Some(state) = self.bodies.states.at(proxy.body) else { return [0.0; 2] };
            let ([x, y, spin, _], arm) =
                (state.velocity, difference(position, translation(self.pose(proxy))));
            [x - spin * arm[1], y + spin * arm[0]]
        };
        let is_fixed = |proxy: &Proxy| proxy.body_type == BodyType::Fixed;
        (is_fixed(filtered.a) && is_fixed(c)) || filtered.a.body == c.body || {
            let relative_velocity = difference(velocity(filtered.a), velocity(c));
            length(relative_velocity) * self.dt <= self.parameters.separation_refresh_distance
        }
    }

    /// Returns the manifold of B with the face of A that has the largest separation among those that no neighbour hides;
    /// without points if there is none. `margin`: contact margin in length units.
    fn replacement_manifold(&self, filtered: &FilteredPair<'a>, margin: f32) -> Manifold {
        let [a, b] = [filtered.a, filtered.b].map(|proxy| self.shape_ref(proxy));
        let shapes = ShapePair::new(a, b, filtered.poses[0], filtered.poses[1]);
        let mut best = (f32::MIN, Manifold::separated(0.0));
        for edge in outer_edges(a) {
            let separation =
                |point| dot(a.normals[edge], difference(shapes.a.to_local(point), a.vertices[edge]));
            let separation = min_height(b, separation) - b.shape.radius;
            if separation <= best.0 || separation < -GHOST_MAX_PENETRATION * self.parameters.length_unit {
                continue;
            }
            let w = shapes.a.to_other(scaled(a.normals[edge], -1.0));
            let manifold = if !admits_normal(&shapes.b, w) {
                Manifold::separated(0.0)
            } else if b.vertices.is_empty() {
                self.round_shape_on_face(filtered, &shapes, edge, margin)
            } else {
                let manifold = shapes.clip_edge(crate::narrow_phase::shape_pair::WhichShape::A, edge, margin);
                let is_round = manifold.count == 0 && b.shape.radius > 0.0;
                if is_round { self.round_shape_on_face(filtered, &shapes, edge, margin) } else { manifold }
            };
            if manifold.count > 0 && !self.is_hidden(filtered, &manifold) {
                best = (separation, manifold);
            }
        }
        best.1
    }

    /// Returns the manifold of a circle B, or of an end of a capsule B, with a face (`edge`) of the piece A in world axes. It
    /// has a point if the round shape is over the face, or over the gap between the face and a neighbour. Over a neighbour of A
    /// there is none, since the pair of B and the neighbour has that contact.
    fn round_shape_on_face(
        &self,
        filtered: &FilteredPair<'a>,
        shapes: &ShapePair<'_>,
        edge: usize,
        margin: f32,
    ) -> Manifold {
        let (a, b) = (shapes.a.shape_ref, shapes.b.shape_ref);
        let (normal, start) = (a.normals[edge], a.vertices[edge]);
        let height = |point: Vector| dot(normal, difference(shapes.a.to_local(point), start));
        let lower = |one: Vector, other: Vector| if height(other) < height(one) { other } else { one };
        let core = b.vertices.iter().copied().reduce(lower).unwrap_or(b.shape.centre);
        let along = difference(a.vertices[(edge + 1) % a.vertices.len()], start);
        let span = length(along);
        let position = dot(difference(shapes.a.to_local(core), start), along) / span;
        let max_step = FLUSH_FACE_MAX_STEP * self.parameters.length_unit;
        if position < -max_step || position > span + max_step {
            return Manifold::separated(0.0);
        }
        let projected = difference(shapes.a.to_local(core), scaled(normal, height(core)));
        let projected_world =
            sum(translation(filtered.poses[0]), rotate(rotation(filtered.poses[0]), projected));
        let is_beyond = position < 0.0 || position > span;
        let mut neighbours = self.neighbours(filtered.proxies, filtered.a);
        if is_beyond
            && neighbours.any(|c| is_over_face(self.shape_ref(c), self.pose(c), projected_world, max_step))
        {
            return Manifold::separated(0.0);
        }
        let separation = height(core) - b.shape.radius;
        let point = sum(projected, scaled(normal, 0.5 * separation));
        Manifold::single_point(normal, point, separation, edge as u32, margin)
            .to_world(rotation(filtered.poses[0]))
    }

    /// Returns the face of A with the largest separation among those that no neighbour hides: its separation from B (length
    /// units, negative for penetration) and its unit normal in world axes. `None` if there is no such face. `point` is the
    /// contact point relative to the origin of A's body, in world axes, length units.
    fn best_exposed_face(&self, filtered: &FilteredPair<'a>, point: Vector) -> Option<(f32, Vector)> {
        let [a, b] = [filtered.a, filtered.b].map(|proxy| self.shape_ref(proxy));
        let q = rotation(filtered.poses[0]);
        let position = difference(translation(filtered.poses[1]), translation(filtered.poses[0]));
        let in_a =
            |point: Vector| rotate_inverse(q, sum(position, rotate(rotation(filtered.poses[1]), point)));
        let mut best: Option<(f32, Vector)> = None;
        for edge in outer_edges(a) {
            let separation = |point| dot(a.normals[edge], difference(in_a(point), a.vertices[edge]));
            let separation = min_height(b, separation) - b.shape.radius;
            let is_shallow = separation >= -GHOST_MAX_PENETRATION * self.parameters.length_unit;
            if !is_shallow || best.is_some_and(|(best, _)| separation <= best) {
                continue;
            }
            let normal = rotate(q, a.normals[edge]);
            let projected = rotate(q, nearest_on_edge(a, edge, rotate_inverse(q, point)));
            if !self.is_point_hidden(filtered, projected, normal) {
                best = Some((separation, normal));
            }
        }
        best
    }
}

/// Returns whether a proxy is a polygon or an edge of a chain, of a static or kinematic body.
fn has_faces(proxy: &Proxy) -> bool {
    let is_flat =
        (proxy.shape.is_plain_polygon() || proxy.shape.is_linked()) && proxy.shape.vertex_count >= 2;
    is_flat && matches!(proxy.body_type, BodyType::Fixed | BodyType::Kinematic)
}

/// Returns point `index` of a manifold, moved to the surface of A: relative to the origin of A's body, in world axes, length
/// units.
fn point_on_a(manifold: &Manifold, index: usize) -> Vector {
    difference(manifold.points[index], scaled(manifold.normal, 0.5 * manifold.separations[index]))
}

/// Returns the indices of the edges of a shape that belong to the outline of its geom, that is not to an inner seam.
fn outer_edges<'a>(shape: ShapeRef<'a>) -> impl Iterator<Item = usize> + use<'a> {
    let adjacency = shape.adjacency();
    (0..shape.vertices.len())
        .filter(move |&edge| !adjacency.get(edge).is_some_and(|edge_adjacency| edge_adjacency.is_internal))
}

/// Returns the smallest value of the function `height` over the vertices of a shape; for a circle its value at the centre. The
/// values are heights above a face, in length units.
fn min_height(shape: ShapeRef<'_>, height: impl Fn(Vector) -> f32) -> f32 {
    let points =
        if shape.vertices.is_empty() { std::slice::from_ref(&shape.shape.centre) } else { shape.vertices };
    points.iter().map(|&point| height(point)).fold(f32::MAX, |a, b| if b < a { b } else { a })
}

/// Returns whether a point lies in a piece, or at most `max_step` (length units) beyond each of its edges. `point` is in the
/// frame of the piece.
fn is_near(shape: ShapeRef<'_>, point: Vector, max_step: f32) -> bool {
    let is_before = shape
        .vertices
        .iter()
        .zip(shape.normals)
        .any(|(&on_edge, &normal)| dot(normal, difference(point, on_edge)) > max_step);
    !is_before && (shape.vertices.len() > 2 || is_between_ends(shape, point, max_step))
}

/// Returns whether a point, projected onto the first edge of a shape, lies between the ends of that edge or at most `max_step`
/// (length units) beyond them.
fn is_between_ends(shape: ShapeRef<'_>, point: Vector, max_step: f32) -> bool {
    let [x, y] = shape.normals[0];
    let along = [-y, x];
    let [start, end] = [0, 1].map(|end| dot(along, difference(point, shape.vertices[end])));
    // The vertices may be in either order along this direction.
    let (least, most) = if start < end { (start, end) } else { (end, start) };
    most >= -max_step && least <= max_step
}

/// Returns whether a world point lies over a face of a piece: at most `max_step` (length units) above or below the face, and
/// between its ends. `pose` is the pose of the piece's body.
fn is_over_face(shape: ShapeRef<'_>, pose: Pose, point: Vector, max_step: f32) -> bool {
    let p = rotate_inverse(rotation(pose), difference(point, translation(pose)));
    let height = |edge: usize| dot(shape.normals[edge], difference(p, shape.vertices[edge]));
    let beyond = (0..shape.vertices.len()).filter(|&edge| height(edge) > 0.0).count();
    let is_level = is_near(shape, p, max_step) && beyond <= 1;
    is_level && (shape.vertices.len() > 2 || is_between_ends(shape, p, 0.0))
}

/// Returns whether the unit vector w is in the normal cone of a piece at a point. Normals of faces within `max_step` (length
/// units) of the point belong to the cone. All vectors are in the frame of the piece's body.
fn is_in_normal_cone(shape: ShapeRef<'_>, point: Vector, w: Vector, max_step: f32) -> bool {
    let count = shape.vertices.len();
    let is_active =
        |edge: usize| dot(shape.normals[edge], difference(point, shape.vertices[edge])) >= -max_step;
    if count == 2 {
        return is_normal_of_chain(shape, point, w, max_step);
    }
    (0..count).filter(|&edge| is_active(edge)).any(|edge| {
        let (normal, next) = (shape.normals[edge], (edge + 1) % count);
        is_between(normal, normal, w) || (is_active(next) && is_between(normal, shape.normals[next], w))
    })
}

/// Returns whether the unit vector w is in the normal cone of an edge of a chain at a point. The cone contains the normal of
/// the colliding side only; at the ends of the edge it contains all normals up to those of the adjacent edges.
fn is_normal_of_chain(shape: ShapeRef<'_>, point: Vector, w: Vector, max_step: f32) -> bool {
    let normal = shape.normals[0];
    let Some([before, after]) = shape.adjacency().first().map(|edge_adjacency| edge_adjacency.neighbours)
    else {
        return true;
    };
    let is_at = |end: usize| length(difference(point, shape.vertices[end])) <= 2.0 * max_step;
    is_between(normal, normal, w)
        || (is_at(0) && cross(before, normal) > 0.0 && is_between(before, normal, w))
        || (is_at(1) && cross(normal, after) > 0.0 && is_between(normal, after, w))
}

/// Returns whether the unit vector w lies between two successive edge normals of a convex shape.
fn is_between(first: Vector, second: Vector, w: Vector) -> bool {
    cross(first, w) >= -NORMAL_CONE_TOLERANCE_SIN
        && cross(w, second) >= -NORMAL_CONE_TOLERANCE_SIN
        && dot(sum(first, second), w) > 0.0
}

/// Returns the index of the edge of the outline whose normal is nearly w, a unit vector in the frame of the shape; `None` if
/// there is no such edge.
fn edge_with_normal(shape: ShapeRef<'_>, w: Vector) -> Option<usize> {
    outer_edges(shape).find(|&edge| {
        let normal = shape.normals[edge];
        cross(normal, w).abs() <= FACE_NORMAL_MAX_SIN && dot(normal, w) > 0.0
    })
}

/// Returns the length of the section of a segment that lies above a plane, in length units, >= 0. The arguments are the heights
/// of both ends above the plane and the length of the segment, in length units.
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

/// Returns the point of an edge that is closest to `point`. Both points are in the frame of the shape's body, length units.
fn nearest_on_edge(shape: ShapeRef<'_>, edge: usize, point: Vector) -> Vector {
    let (start, end) = (shape.vertices[edge], shape.vertices[(edge + 1) % shape.vertices.len()]);
    let along = difference(end, start);
    let fraction = (dot(difference(point, start), along) / dot(along, along)).clamp(0.0, 1.0);
    sum(start, scaled(along, fraction))
}
