//! Narrow phase: one-way geoms. They stop bodies that move against their open direction, the direction of free passage, and let
//! all others pass.
//!
//! A pair with a one-way geom is decided once, at its first touch. The test uses the poses at the time of impact of the step's
//! motion. If the other shape then lies entirely above a face whose normal is within 60 degrees of the open direction, the pair
//! collides until the shapes separate. Else the pair is ignored until then. A body that was placed inside of the geom has no
//! such motion, and passes.
//!
//! All pieces of the geom and of the other body share the decision: their pairs are a *group* with one [`OneWayState`]. So a
//! body that landed on one piece also rests on the next, and a body that passes one piece passes the next. The decision reads
//! the motion of the step, not the velocities at its end. So it depends neither on the length of the step nor on its impulses.

use crate::index::{PairIndex, ProxyIndex};
use crate::parameters::narrow_phase::{ONE_WAY_MIN_COS, TOI_TOLERANCE_RATIO};

use crate::bodies::BodySet;
use crate::broad_phase::pairs::{OneWayState, Pairs};
use crate::broad_phase::proxies::{Proxies, Proxy};
use crate::continuous_collision::time_of_impact::{SweptPair, SweptShape, conservative_advancement};
use crate::depth::one_way::will_land;
use crate::math::plane::{Pose, Vector, difference, dot, rotate, rotate_inverse, rotation, scaled};
use crate::math::scalar;
use crate::narrow_phase;
use crate::narrow_phase::NarrowPhase;
use crate::narrow_phase::manifold::Manifold;

/// Motion of the bodies of pairs in one step, by which one-way geoms decide.
pub(crate) struct PairMotion<'a> {
    pub(crate) bodies: &'a BodySet,
    pub(crate) proxies: &'a Proxies,
    pub(crate) pairs: &'a Pairs,
    /// Speculative distance of contacts, in length units.
    pub(crate) speculative_distance: f32,
    /// Whether the poses in `bodies` are those at the end of the motion; false if they are those at its beginning.
    pub(crate) is_after_step: bool,
}

impl PairMotion<'_> {
    /// Returns the proxies A and B of a pair.
    fn proxies_of_pair(&self, pair: PairIndex) -> [&Proxy; 2] {
        self.pairs.proxies_of(pair).map(|proxy| self.proxies.proxy(proxy))
    }

    /// Returns the shapes of a pair with their poses before the motion and their displacements.
    fn swept_pair(&self, pair: PairIndex) -> SweptPair<'_> {
        let swept_shape = |proxy: &Proxy| {
            let displacement = self.bodies.delta_pose.at(proxy.body).copied().unwrap_or_default();
            let pose = self.bodies.poses[proxy.body];
            let pose = if self.is_after_step { pose_before(pose, displacement) } else { pose };
            SweptShape { shape: self.proxies.vertices.shape_ref(proxy.shape), pose, displacement }
        };
        let [a, b] = self.proxies_of_pair(pair).map(swept_shape);
        SweptPair { a, b }
    }

    /// Returns the shapes of a pair in their present poses, with displacement 0.
    fn current_pair(&self, pair: PairIndex) -> SweptPair<'_> {
        let swept_shape = |proxy: &Proxy| SweptShape {
            shape: self.proxies.vertices.shape_ref(proxy.shape),
            pose: self.bodies.poses[proxy.body],
            displacement: [0.0; 4],
        };
        let [a, b] = self.proxies_of_pair(pair).map(swept_shape);
        SweptPair { a, b }
    }

    /// Returns the pairs that share one [`OneWayState`] with the pair `pair`, this pair included. They are the pairs between
    /// the one-way geom and all geoms of the other body that are not one-way themselves.
    fn group(&self, pair: PairIndex) -> impl Iterator<Item = PairIndex> + '_ {
        let group_proxies = self.pairs.proxies_of(pair);
        let body = self.proxies.body_of(group_proxies[1]);
        let pairs = self.pairs.pairs_of_body(self.proxies, body);
        pairs.filter(move |&other| is_of_group(self.proxies, group_proxies, self.pairs.proxies_of(other)))
    }

    /// Returns the state that a new pair takes over from the other pairs of its group: pairs of the same one-way geom and the
    /// same other body. `Apart` if it is the first pair.
    pub(crate) fn state_of_group(&self, pair: PairIndex) -> OneWayState {
        let others = self.group(pair).filter(|&other| other != pair);
        let mut known = others.map(|other| self.pairs.state(other).one_way_state);
        known.find(|&state| state != OneWayState::Closed).unwrap_or(OneWayState::Apart)
    }

    /// Returns whether a pair of this pair's group (same one-way geom, same other body) has a contact constraint.
    pub(crate) fn has_group_constraint(&self, pair: PairIndex) -> bool {
        self.group(pair).any(|other| self.pairs.has_constraint(other))
    }

    /// Returns the pairs of this pair's group (same one-way geom, same other body) whose shapes overlap in the present poses.
    fn overlapping_in_group(&self, pair: PairIndex) -> impl Iterator<Item = PairIndex> + '_ {
        self.group(pair).filter(|&pair| self.current_pair(pair).separation(0.0).0 < 0.0)
    }

    /// Returns whether the shapes of a pair of this pair's group (same one-way geom, same other body) overlap in the present
    /// poses.
    pub(crate) fn group_overlaps(&self, pair: PairIndex) -> bool {
        self.overlapping_in_group(pair).next().is_some()
    }

    /// Returns the state of a pair's group (same one-way geom, same other body) after the motion of the step. The group must
    /// not have landed yet.
    pub(crate) fn resolve_state(&self, pair: PairIndex) -> OneWayState {
        if self.pairs.state(pair).one_way_state == OneWayState::Passes {
            return if self.group_overlaps(pair) { OneWayState::Passes } else { OneWayState::Apart };
        }
        // Shapes that overlap now have touched at the end of the motion at the latest.
        let landings = self
            .overlapping_in_group(pair)
            .map(|pair| self.landing_at(pair, self.first_toi(pair).unwrap_or(1.0)));
        match landings.reduce(earlier_toi) {
            None => OneWayState::Apart,
            Some((_, true)) => OneWayState::Landed,
            Some((_, false)) => OneWayState::Passes,
        }
    }

    /// Returns whether the other body will land on the one-way geom of a pair with the motion of this step. The two must be
    /// apart.
    pub(crate) fn will_land(&self, pair: PairIndex) -> bool {
        let landings = self.group(pair).filter_map(|pair| Some(self.landing_at(pair, self.first_toi(pair)?)));
        landings.reduce(earlier_toi).is_some_and(|(_, lands)| lands)
    }

    /// Returns whether one shape of the pair lies above a stopping face of the other one, which is one-way, in the present
    /// poses.
    pub(crate) fn is_above(&self, pair: PairIndex) -> bool {
        self.is_above_at(pair, &self.current_pair(pair), 0.0)
    }

    /// Returns the time of impact of a pair as a fraction of the step, 0 if its shapes overlap at the beginning. `None` without
    /// an impact.
    fn first_toi(&self, pair: PairIndex) -> Option<f32> {
        let two = self.swept_pair(pair);
        conservative_advancement(0.0, TOI_TOLERANCE_RATIO * self.speculative_distance, |time| {
            two.separation_and_closing_speed(time)
        })
    }

    /// Returns the tuple (`time`, whether the pair lands at that time); `time` is a fraction of the step. The smallest tuple of
    /// a group decides for the group.
    fn landing_at(&self, pair: PairIndex, time: f32) -> (f32, bool) {
        (time, self.is_above_at(pair, &self.swept_pair(pair), time))
    }

    /// Returns whether, at a fraction of the step, each one-way shape of the pair has the other shape above one of its stopping
    /// faces.
    fn is_above_at(&self, pair: PairIndex, two: &SweptPair<'_>, time: f32) -> bool {
        let [a, b] = self.proxies_of_pair(pair).map(|proxy| proxy.one_way);
        a.is_none_or(|direction| is_above(&two.a, &two.b, time, direction, self.speculative_distance))
            && b.is_none_or(|direction| is_above(&two.b, &two.a, time, direction, self.speculative_distance))
    }
}

impl<'a> NarrowPhase<'a> {
    /// Sets `Landed` groups (pairs of one one-way geom and one other body) without contact constraint and overlap back to
    /// `Apart`. This precedes the update of pairs, because at the seam of two pieces the contact with one ends before that with
    /// the next begins.
    pub(crate) fn release_one_way(&mut self) {
        for pair in self.pairs.indices() {
            let state = self.pairs.state(pair);
            if state.one_way_state == OneWayState::Landed && state.constraint.is_none() {
                let motion = self.last_step_motion();
                if !motion.has_group_constraint(pair) && !motion.group_overlaps(pair) {
                    self.pairs.set_one_way_state(self.proxies, pair, OneWayState::Apart);
                }
            }
        }
    }

    /// Returns the motion of all bodies in the last step, for the decisions of one-way geoms.
    fn last_step_motion(&self) -> PairMotion<'_> {
        let NarrowPhase { bodies, proxies, pairs, parameters, .. } = self;
        PairMotion {
            bodies,
            proxies,
            pairs,
            speculative_distance: parameters.speculative_distance,
            is_after_step: true,
        }
    }

    /// Returns whether a pair with a one-way geom does not collide, and stores the state of its group: the pairs of the same
    /// geom and other body. A group lands with its first touch from above, or when a shape above a stopping face approaches the
    /// face.
    #[inline(never)]
    pub(crate) fn is_passable(
        &mut self,
        pair: PairIndex,
        two: narrow_phase::ProxyPair<'a>,
        manifold: &Manifold,
    ) -> bool {
        let known = self.pairs.state(pair).one_way_state;
        if matches!(known, OneWayState::Closed | OneWayState::Landed) {
            return false;
        }
        let mut state = self.last_step_motion().resolve_state(pair);
        if state == OneWayState::Apart
            && self.last_step_motion().is_above(pair)
            && self.is_approaching(two, manifold)
        {
            state = OneWayState::Landed;
        }
        if state != known {
            self.pairs.set_one_way_state(self.proxies, pair, state);
        }
        state != OneWayState::Landed
    }

    /// Returns whether B approaches A at a contact point of the manifold.
    fn is_approaching(&self, two: narrow_phase::ProxyPair<'_>, manifold: &Manifold) -> bool {
        manifold.points[..manifold.count].iter().any(|&point| {
            let [bx, by] = difference(point, two.offset());
            self.predicted_normal_velocity(two, manifold.normal, &[point[0], point[1], bx, by]) < 0.0
        })
    }

    /// Sets the group of a pair (same one-way geom, same other body) from `Landed` back to `Apart`, unless a pair of the group
    /// has a contact constraint. It is called after a handler of the game has disabled the contact.
    pub(crate) fn revoke_landing(&mut self, pair: PairIndex) {
        if self.pairs.state(pair).one_way_state == OneWayState::Landed
            && !self.last_step_motion().has_group_constraint(pair)
        {
            self.pairs.set_one_way_state(self.proxies, pair, OneWayState::Apart);
        }
    }

    /// Returns whether B passes through A, a one-way platform in three axes. B passes if it has no contact with A and does not
    /// land on A in this step.
    pub(crate) fn is_passable_3d(&self, pair: PairIndex, two: narrow_phase::ProxyPair<'a>) -> bool {
        let state = self.pairs.state(pair);
        let Some(space) = self.depth.filter(|space| state.responds && space.is_one_way(two.a)) else {
            return false;
        };
        let solid = |at: ProxyIndex, proxy: &'a Proxy| {
            space.posed_solid(at, proxy, self.proxies.vertices.shape_ref(proxy.shape), (self.bodies, self.dt))
        };
        let [at_a, at_b] = self.pairs.proxies_of(pair);
        state.constraint.is_none()
            && !will_land(solid(at_a, two.a), solid(at_b, two.b), self.parameters.speculative_distance)
    }
}

impl Pairs {
    /// Sets the state of all pairs of a pair's group: those between the same one-way geom and the same other body.
    pub(crate) fn set_one_way_state(&mut self, proxies: &Proxies, pair: PairIndex, state: OneWayState) {
        let group_proxies = self.proxies_of(pair);
        let body = proxies.body_of(group_proxies[1]);
        for proxy in proxies.proxies_of(body) {
            self.for_each_pair_of(proxy, |other_proxies, other| {
                if is_of_group(proxies, group_proxies, other_proxies)
                    && other.one_way_state != OneWayState::Closed
                {
                    other.one_way_state = state;
                }
            });
        }
    }
}

/// Returns whether the pair of the proxies `one` and `other` belongs to the group of the pair [a, b]. Both pairs then have the
/// same one-way geom and the same body on the other side.
fn is_of_group(proxies: &Proxies, [a, b]: [ProxyIndex; 2], [one, other]: [ProxyIndex; 2]) -> bool {
    let belongs = |proxy: ProxyIndex, to: ProxyIndex| {
        let (proxy, to) = (proxies.proxy(proxy), proxies.proxy(to));
        if to.one_way.is_some() {
            proxy.owner == to.owner
        } else {
            proxy.body == to.body && proxy.one_way.is_none()
        }
    };
    (belongs(one, a) && belongs(other, b)) || (belongs(one, b) && belongs(other, a))
}

/// Returns the earlier of two tuples (time as a fraction of the step, whether the pair lands). At equal times the tuple that
/// lands wins.
fn earlier_toi(one: (f32, bool), other: (f32, bool)) -> (f32, bool) {
    let is_other = other.0 < one.0 || (other.0 == one.0 && other.1);
    if is_other { other } else { one }
}

/// Returns the pose (x, y in length units, cosine, sine) of a body before a displacement (x, y in length units, angle in
/// radians, z).
fn pose_before([x, y, c, s]: Pose, [dx, dy, angle, _]: [f32; 4]) -> Pose {
    if angle == 0.0 {
        return [x - dx, y - dy, c, s];
    }
    let (sine, cosine) = scalar::sin_cos(angle);
    let [c, s] = rotate_inverse([cosine, sine], [c, s]);
    [x - dx, y - dy, c, s]
}

/// Returns whether `other` lies above a stopping face of the one-way shape `piece`, or below it by at most the speculative
/// distance. `time` is a fraction of the step, and `direction` the open direction in the frame of the body of `piece`.
fn is_above(
    piece: &SweptShape<'_>,
    other: &SweptShape<'_>,
    time: f32,
    direction: Vector,
    speculative_distance: f32,
) -> bool {
    let (pose, pose_of_other) = (piece.pose_at(time), other.pose_at(time));
    let direction = rotate(rotation(pose), direction);
    let height_over =
        |normal: Vector| -other.support(pose_of_other, scaled(normal, -1.0)) - piece.support(pose, normal);
    if piece.shape.shape.radius > 0.0 {
        let (separation, normal) = SweptPair { a: *piece, b: *other }.separation(time);
        return dot(normal, direction) > ONE_WAY_MIN_COS && separation >= -speculative_distance;
    }
    let adjacency = piece.shape.adjacency();
    piece.shape.normals.iter().enumerate().any(|(edge, &normal)| {
        let is_inner = adjacency.get(edge).is_some_and(|edge_adjacency| edge_adjacency.is_internal);
        let normal = rotate(rotation(pose), normal);
        !is_inner && dot(normal, direction) > ONE_WAY_MIN_COS && height_over(normal) >= -speculative_distance
    })
}
