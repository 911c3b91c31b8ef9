//! Broad phase: the pairs of proxies whose fat AABBs overlap, with the contact data that the narrow phase caches.
//!
//! A pair exists from the step in which its fat AABBs begin to overlap until they separate. Awake pairs come first in the
//! lists, pairs of sleeping bodies and static sensor pairs follow. Each proxy has a doubly linked list of its pairs.

use serde::{Deserialize, Serialize};

use crate::broad_phase::proxies::{BodyType, Proxies};
use crate::constraint_graph::{ConstraintHandle, ConstraintKind};
use crate::index::{BodyIndex, DenseIndex, IndexedVec, PairIndex, ProxyIndex};
use crate::math::plane::Vector;
use crate::reusing_clone;

/// Index in place of that of a pair that has left a list.
pub(crate) const REMOVED_PAIR: PairIndex = PairIndex(u32::MAX);

/// Data by which the narrow phase decides in each step whether to update a pair. It does so when the summed path lengths
/// (`travel`) of the pair's proxies have grown by `motion_tolerance` since `motion_at_check`.
#[derive(Debug, Clone, Copy)]
pub struct RecheckTrigger {
    /// Indices of the proxies A and B of the pair.
    pub proxies: [ProxyIndex; 2],
    /// Sum of the `travel` counters of both proxies at the last update of the pair, in 2^-26 length units,
    /// wrapping.
    pub motion_at_check: u32,
    /// Growth of the summed `travel` counters of both proxies that triggers an update of the pair, in 2^-26
    /// length units; or [`UPDATED_BY_SOLVER`].
    pub motion_tolerance: u32,
}

/// Value of [`RecheckTrigger::motion_tolerance`] for two circles that touch, a flag. The solver computes their contact from the
/// poses in every substep, so the narrow phase does not update the pair.
pub const UPDATED_BY_SOLVER: u32 = u32::MAX;

/// Manifold of a pair as the narrow phase computed it last, with the poses for which it was computed. Contact recycling reuses
/// it.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct CachedManifold {
    /// Cosine and sine of the world angle of A, then of B, when the manifold was computed.
    pub rotations: [f32; 4],
    /// Pose of B in the frame of A when the manifold was computed: x and y in length units, cosine and sine.
    pub relative_pose: [f32; 4],
    /// Unit contact normal from A to B, in world axes, when the manifold was computed.
    pub normal: Vector,
    /// Number of contact points of the manifold, 0..=2; 0 without a contact.
    pub count: u32,
    /// Vectors from the origins of A and B to each contact point: [ax, ay, bx, by] in length units. They are in world axes and
    /// belong to the poses for which the manifold was computed.
    pub anchors: [[f32; 4]; 2],
    /// Separation at each point when the manifold was computed, in length units, negative for penetration.
    pub separations: [f32; 2],
    /// Feature id of each point. A new point with the same id inherits the impulses of the point (warm start).
    pub features: [u32; 2],
    /// Angle, in radians, by which the vectors from B to the contact points are rotated ahead to the middle of the step. With
    /// the vectors of the beginning of the step, a body that rolls over its vertices on a static body would lose energy in
    /// every step.
    pub arm_lead_angle: f32,
    /// Manifold data of the depth axis, for contacts in three axes.
    pub depth: CachedManifoldZ,
}

impl CachedManifold {
    /// Returns the number of contact points, 0..=2.
    #[inline(always)]
    pub fn point_count(&self) -> usize {
        self.count as usize
    }

    /// Returns the anchors of the contact points: see [`anchors`](Self::anchors).
    #[inline(always)]
    pub(crate) fn point_anchors(&self) -> &[[f32; 4]] {
        &self.anchors[..self.point_count()]
    }
}

/// Depth-axis data of a [`CachedManifold`]: normal, offset and points along z.
#[derive(Debug, Clone, Copy, Default, PartialEq, Serialize, Deserialize)]
pub struct CachedManifoldZ {
    /// Component of the unit contact normal along the depth axis z, -1 to 1.
    pub normal_z: f32,
    /// Z of body B minus z of body A when the manifold was computed, in length units.
    #[serde(rename = "apart")]
    pub z_offset: f32,
    /// Root mean square distance of the points of the contact patch from its middle, in length units, >= 0. It is the lever arm
    /// of twist friction about the normal, and 0 for contacts whose normal is not along z.
    #[serde(rename = "spread")]
    pub patch_radius: f32,
    /// Z of each contact point minus z of body A, in length units.
    #[serde(rename = "depths")]
    pub points_z: [f32; 2],
}

/// Decision whether a pair with a one-way geom collides. All pairs between the geom and one other body share it.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize)]
pub enum OneWayState {
    /// The pair has no one-way geom, or no collision response: it collides like any other pair.
    #[default]
    Closed,
    /// The shapes do not overlap, and neither has landed on the other. The first touch decides.
    Apart,
    /// The shapes overlap without a landing: the other shape passes, and the contact is ignored.
    Passes,
    /// One shape has landed on the other, and the pair collides.
    Landed,
}

/// State of a pair that is not needed to decide whether the pair has moved: contact constraint, touch, handlers and one-way
/// state. It is stored apart from the [`RecheckTrigger`], which every step reads.
#[derive(Debug, Clone, Copy)]
pub struct Pair {
    /// Kind of the contact constraint: number of points, whether A is static, and whether there is a depth axis.
    pub kind: ConstraintKind,
    /// Handle of the pair's contact constraint in the constraint graph; `None` if the pair has no constraint.
    pub constraint: Option<ConstraintHandle>,
    /// Whether the pair touches: the state that the last touch event of the pair has reported.
    pub is_touching: bool,
    /// Whether contacts of the pair exert impulses (collision response).
    pub responds: bool,
    /// Whether a contact handler of the game is set for at least one of the two geoms.
    pub is_reported: bool,
    /// Whether a handler of the game has disabled the contact in this update.
    pub is_vetoed: bool,
    /// Whether a handler of the game disabled the contact in the previous update.
    pub was_vetoed: bool,
    /// Whether a handler of the game has set friction, restitution or tangent speed of the contact in this update.
    pub has_surface_override: bool,
    /// Whether a handler of the game has removed each of the two points from the contact constraint. Such a point has effective
    /// mass 0 until the constraint is built anew.
    pub are_points_removed: [bool; 2],
    /// Whether A is the ground of a world with a depth axis.
    pub(crate) is_on_ground: bool,
    /// Whether the pair is one of a sensor and a static or kinematic body, so that no impulse can move either side. See
    /// [`static_sensor_pairs`](crate::narrow_phase::static_sensor_pairs).
    pub is_static_sensor: bool,
    /// Whether a one-way geom stops the other body of the pair or lets it pass.
    pub one_way_state: OneWayState,
    /// Accumulated angular impulse of rolling resistance in one substep, mass units * length units^2/s.
    pub rolling_impulse: f32,
}

impl Pair {
    /// Returns whether contacts of the pair exert impulses: neither geom is a sensor, and no handler has disabled the contact.
    pub fn has_response(&self) -> bool {
        self.responds && !self.is_vetoed
    }

    /// Multiplies the angular impulse of rolling resistance by `factor`, dimensionless: the ratio of two substep lengths. A result
    /// that is not finite becomes 0.
    pub(crate) fn scale_rolling_impulse(&mut self, factor: f32) {
        let impulse = self.rolling_impulse * factor;
        self.rolling_impulse = if impulse.is_finite() { impulse } else { 0.0 };
    }
}

/// Link of the list of pairs of a proxy: a pair, and the side on which it has the proxy. The number is twice the index of the
/// pair, plus 0 (side A) or 1 (side B).
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
struct PairLink(u32);

impl PairLink {
    /// Value in place of a link: the list ends.
    const NONE: PairLink = PairLink(u32::MAX);

    /// Returns the link of a pair on a side, 0 (proxy A) or 1 (proxy B).
    #[inline(always)]
    fn new(pair: PairIndex, side: usize) -> Self {
        PairLink(pair.0 * 2 + u32::from(side == 1))
    }

    /// Returns the pair of the link.
    #[inline(always)]
    fn pair(self) -> PairIndex {
        PairIndex(self.0 >> 1)
    }

    /// Returns the side on which the pair has the proxy: 0 (proxy A) or 1 (proxy B).
    #[inline(always)]
    fn side(self) -> usize {
        usize::from(self.0 & 1 == 1)
    }
}

/// Links of a pair in the lists of pairs of both proxies: proxy A first, then the other proxy. The proxies are stored in
/// [`RecheckTrigger`], too; the copy serves loops over a list, which read nothing else.
#[derive(Debug, Clone, Copy)]
struct PairLinks {
    proxies: [ProxyIndex; 2],
    next: [PairLink; 2],
    previous: [PairLink; 2],
}

/// All pairs: first the awake ones, then those of sleeping bodies. The index of a pair changes when another pair is removed,
/// falls asleep or wakes.
#[derive(Debug, Default)]
pub struct Pairs {
    /// When the contacts of each pair are next updated, by pair index.
    triggers: IndexedVec<PairIndex, RecheckTrigger>,
    /// The pairs, by pair index.
    all: IndexedVec<PairIndex, Pair>,
    /// The manifold of each pair, by pair index.
    manifolds: IndexedVec<PairIndex, CachedManifold>,
    links: IndexedVec<PairIndex, PairLinks>,
    /// Number of awake pairs. They have the indices below it.
    awake_count: usize,
    /// Number of pairs that touch, awake and asleep.
    pub touching_count: usize,
    /// Number of pairs that touch the ground of a world with a depth axis.
    pub touching_ground_count: usize,
    /// Number of touching pairs for which a handler of the game is called.
    pub reported_count: usize,
    /// Number of pairs of a sensor and a static or kinematic body.
    pub(crate) static_sensor_count: usize,
    /// Number of pairs without collision response: at least one of their geoms is a sensor.
    sensor_count: usize,
    /// First link  of each proxy's list of pairs, or [`PairLink::NONE`].
    heads: IndexedVec<ProxyIndex, PairLink>,
}

reusing_clone! { Pairs { triggers, all, manifolds, links, awake_count, touching_count, touching_ground_count, reported_count, static_sensor_count, sensor_count, heads } }

impl Pairs {
    /// Removes all pairs and makes an empty list of pairs for each of `proxies` proxies.
    pub(crate) fn reset(&mut self, proxies: usize) {
        self.triggers.clear();
        self.all.clear();
        self.manifolds.clear();
        self.links.clear();
        (self.awake_count, self.sensor_count) = (0, 0);
        (self.touching_count, self.touching_ground_count, self.reported_count, self.static_sensor_count) =
            (0, 0, 0, 0);
        self.heads.clear();
        self.heads.resize(proxies, PairLink::NONE);
    }

    /// Enlarges the heads of the lists to `proxies` proxies, which have no pairs at first. The present pairs stay.
    pub fn grow(&mut self, proxies: usize) {
        self.heads.resize(proxies, PairLink::NONE);
    }

    /// Returns the state of a pair.
    #[inline(always)]
    pub fn state(&self, pair: PairIndex) -> &Pair {
        &self.all[pair]
    }

    /// Returns the state of a pair, to change. The fields that are counted have verbs of their own:
    /// [`set_touching`](Self::set_touching), [`set_reported`](Self::set_reported).
    #[inline(always)]
    pub fn state_mut(&mut self, pair: PairIndex) -> &mut Pair {
        &mut self.all[pair]
    }

    /// Returns the state of a pair; `None` if no pair has this index.
    #[inline]
    pub fn get(&self, pair: PairIndex) -> Option<&Pair> {
        self.all.at(pair)
    }

    /// Returns whether a pair touches.
    #[inline(always)]
    pub fn is_touching(&self, pair: PairIndex) -> bool {
        self.all[pair].is_touching
    }

    /// Returns the indices of the proxies A and B of a pair.
    #[inline(always)]
    pub fn proxies_of(&self, pair: PairIndex) -> [ProxyIndex; 2] {
        self.triggers[pair].proxies
    }

    /// Returns the indices of the proxies A and B of a pair from the links that a loop over the list of a proxy has read.
    #[inline(always)]
    pub(crate) fn linked_proxies_of(&self, pair: PairIndex) -> [ProxyIndex; 2] {
        self.links[pair].proxies
    }

    /// Returns the data that decide whether a pair is due for an update.
    #[inline(always)]
    pub fn trigger(&self, pair: PairIndex) -> &RecheckTrigger {
        &self.triggers[pair]
    }

    /// Iterates over the awake pairs, ascending, with the data that decide whether a pair is due for an update.
    #[inline(always)]
    pub(crate) fn awake_triggers(&self) -> impl ExactSizeIterator<Item = (PairIndex, &RecheckTrigger)> {
        self.triggers.enumerated().take(self.awake_count)
    }

    /// Restores the saved motion of a pair: see [`RecheckTrigger`], 2^-26 length units.
    pub fn restore_motion(&mut self, pair: PairIndex, motion_at_check: u32, motion_tolerance: u32) {
        let proxies = self.proxies_of(pair);
        self.triggers[pair] = RecheckTrigger { proxies, motion_at_check, motion_tolerance };
    }

    /// Sets the motion of a pair at its update, which has taken place now: see [`RecheckTrigger::motion_at_check`].
    #[inline(always)]
    pub(crate) fn set_motion_at_check(&mut self, pair: PairIndex, motion_at_check: u32) {
        self.triggers[pair].motion_at_check = motion_at_check;
    }

    /// Sets the motion that makes a pair due for an update: see [`RecheckTrigger::motion_tolerance`].
    #[inline(always)]
    pub(crate) fn set_motion_tolerance(&mut self, pair: PairIndex, motion_tolerance: u32) {
        self.triggers[pair].motion_tolerance = motion_tolerance;
    }

    /// Lets the next narrow phase update a pair, whether it has moved or not.
    #[inline(always)]
    pub fn recheck(&mut self, pair: PairIndex) {
        self.triggers[pair].motion_tolerance = 0;
    }

    /// Returns the cached manifold of a pair.
    #[inline(always)]
    pub fn manifold(&self, pair: PairIndex) -> &CachedManifold {
        &self.manifolds[pair]
    }

    /// Returns the cached manifold of a pair, to change.
    #[inline(always)]
    pub fn manifold_mut(&mut self, pair: PairIndex) -> &mut CachedManifold {
        &mut self.manifolds[pair]
    }

    /// Iterates over all pairs, ascending: first the awake ones, then those of sleeping bodies.
    #[inline]
    pub fn indices(&self) -> impl DoubleEndedIterator<Item = PairIndex> + ExactSizeIterator + use<> {
        self.all.indices()
    }

    /// Iterates over the awake pairs, ascending.
    #[inline]
    pub fn awake(&self) -> impl DoubleEndedIterator<Item = PairIndex> + ExactSizeIterator + use<> {
        (0..self.awake_count).map(PairIndex::new)
    }

    /// Returns whether a pair is awake.
    #[inline(always)]
    pub fn is_awake(&self, pair: PairIndex) -> bool {
        pair.position() < self.awake_count
    }

    /// Returns the number of awake pairs. They have the indices below it.
    #[inline]
    pub fn awake_count(&self) -> usize {
        self.awake_count
    }

    /// Counts the first sleeping pair among the awake ones, and returns its index.
    #[inline]
    pub(crate) fn extend_awake(&mut self) -> PairIndex {
        self.awake_count += 1;
        PairIndex::new(self.awake_count - 1)
    }

    /// Counts the last awake pair among the sleeping ones, and returns its index.
    #[inline]
    pub(crate) fn shorten_awake(&mut self) -> PairIndex {
        self.awake_count -= 1;
        PairIndex::new(self.awake_count)
    }

    /// Returns the index of the last pair; there has to be one.
    #[inline]
    pub(crate) fn last(&self) -> PairIndex {
        PairIndex::new(self.all.len() - 1)
    }

    /// Returns the number of pairs, awake and asleep.
    pub fn count(&self) -> usize {
        self.all.len()
    }

    /// Returns the indices of the pairs of a proxy.
    pub fn pairs_of(&self, proxy: ProxyIndex) -> impl Iterator<Item = PairIndex> + '_ {
        let mut link = self.heads[proxy];
        std::iter::from_fn(move || {
            let at = (link != PairLink::NONE).then_some(link.pair())?;
            link = self.links[at].next[link.side()];
            Some(at)
        })
    }

    /// Lets the next step update the contacts of those pairs of a proxy that have a constraint.
    pub(crate) fn recheck_constrained(&mut self, proxy: ProxyIndex) {
        let mut link = self.heads[proxy];
        while link != PairLink::NONE {
            let at = link.pair();
            link = self.links[at].next[link.side()];
            if self.all[at].constraint.is_some() {
                self.triggers[at].motion_tolerance = 0;
            }
        }
    }

    /// Calls `change` with the pairs and the index of each pair of a proxy. `change` adds, removes and moves no pair.
    pub fn for_each_index_of(&mut self, proxy: ProxyIndex, mut change: impl FnMut(&mut Pairs, PairIndex)) {
        let mut link = self.heads[proxy];
        while link != PairLink::NONE {
            let at = link.pair();
            change(self, at);
            link = self.links[at].next[link.side()];
        }
    }

    /// Returns body index and body type of A and of B of a pair.
    pub fn bodies_of(&self, proxies: &Proxies, pair: PairIndex) -> [(BodyIndex, BodyType); 2] {
        self.linked_proxies_of(pair).map(|proxy| (proxies.body_of(proxy), proxies.body_type_of(proxy)))
    }

    /// Returns kind and handle of the contact constraint of a pair; `None` if the pair has none.
    #[inline(always)]
    pub(crate) fn constraint(&self, pair: PairIndex) -> Option<(ConstraintKind, ConstraintHandle)> {
        let state = &self.all[pair];
        state.constraint.map(|handle| (state.kind, handle))
    }

    /// Returns whether a pair has a contact constraint.
    #[inline(always)]
    pub fn has_constraint(&self, pair: PairIndex) -> bool {
        self.all[pair].constraint.is_some()
    }

    /// Returns the creation numbers of the geoms of a pair, packed: the order of pairs in lists.
    pub(crate) fn creation_numbers(&self, proxies: &Proxies, pair: PairIndex) -> u128 {
        proxies.creation_numbers(self.triggers[pair].proxies)
    }

    /// Returns the indices of the pairs of all proxies of a body. A pair between two proxies of the body does not exist.
    pub fn pairs_of_body<'a>(
        &'a self,
        proxies: &'a Proxies,
        body: BodyIndex,
    ) -> impl Iterator<Item = PairIndex> + use<'a> {
        let (mut link, mut proxy) = (PairLink::NONE, proxies.first_of_body(body));
        std::iter::from_fn(move || self.next_pair_of_body(proxies, &mut link, &mut proxy))
    }

    /// Returns the indices of the pairs between the proxies of two bodies. The pairs of both bodies are visited in turn, so the
    /// cost is that of the body with fewer pairs.
    pub fn pairs_between(&self, proxies: &Proxies, bodies: [BodyIndex; 2]) -> Vec<PairIndex> {
        let [mut of_one, mut of_other] = bodies.map(|body| self.pairs_of_body(proxies, body));
        let is_between =
            |pair: &PairIndex| self.bodies_of(proxies, *pair).iter().all(|(body, _)| bodies.contains(body));
        let (mut from_one, mut from_other) = (Vec::new(), Vec::new());
        loop {
            let Some(pair) = of_one.next() else { return from_one };
            from_one.extend(Some(pair).filter(is_between));
            let Some(pair) = of_other.next() else { return from_other };
            from_other.extend(Some(pair).filter(is_between));
        }
    }

    /// Returns the one of two bodies that has fewer pairs. The cost is that of this body.
    pub fn body_with_fewer_pairs(&self, proxies: &Proxies, [one, other]: [BodyIndex; 2]) -> BodyIndex {
        let [mut of_one, mut of_other] = [one, other].map(|body| self.pairs_of_body(proxies, body));
        while of_one.next().is_some() {
            if of_other.next().is_none() {
                return other;
            }
        }
        one
    }

    /// Returns the next index for [`pairs_of_body`](Self::pairs_of_body), and advances `link` and `proxy`. Not inlined, so that
    /// all callers share the code.
    #[inline(never)]
    fn next_pair_of_body(
        &self,
        proxies: &Proxies,
        link: &mut PairLink,
        proxy: &mut Option<ProxyIndex>,
    ) -> Option<PairIndex> {
        while *link == PairLink::NONE {
            let next = (*proxy)?;
            (*link, *proxy) = (self.heads[next], proxies.next_of_body(next));
        }
        let at = link.pair();
        *link = self.links[at].next[link.side()];
        Some(at)
    }

    /// Calls `change` for each pair of a proxy, with the pair's proxies [A, B] and its state.
    pub(crate) fn for_each_pair_of(
        &mut self,
        proxy: ProxyIndex,
        mut change: impl FnMut([ProxyIndex; 2], &mut Pair),
    ) {
        let mut link = self.heads[proxy];
        while link != PairLink::NONE {
            let at = link.pair();
            change(self.links[at].proxies, &mut self.all[at]);
            link = self.links[at].next[link.side()];
        }
    }

    /// Returns whether the proxies A and B have a pair. The list of B is searched, since B is dynamic and has few pairs.
    pub fn contains(&self, [a, b]: [ProxyIndex; 2]) -> bool {
        self.pairs_of(b).any(|pair| self.links[pair].proxies == [a, b])
    }

    /// Returns the index of the pair of two proxies; `None` if they are no pair. The pairs of both proxies are visited in turn,
    /// so the cost is that of the proxy with fewer pairs.
    pub fn find(&self, [one, other]: [ProxyIndex; 2]) -> Option<PairIndex> {
        let is_between = |pair: &PairIndex| {
            let proxies = self.links[*pair].proxies;
            proxies == [one, other] || proxies == [other, one]
        };
        let both = self.pairs_of(one).zip(self.pairs_of(other));
        both.flat_map(|(a, b)| [a, b]).find(is_between)
    }

    /// Appends a pair without contacts at the end of all lists, and returns its index.
    pub(crate) fn push(
        &mut self,
        proxies: [ProxyIndex; 2],
        kind: ConstraintKind,
        responds: bool,
        is_reported: bool,
    ) -> PairIndex {
        let at = self.all.next_index();
        self.sensor_count += usize::from(!responds);
        self.triggers.push(RecheckTrigger { proxies, motion_at_check: 0, motion_tolerance: 0 });
        self.manifolds.push(CachedManifold::default());
        self.links.push(PairLinks { proxies, next: [PairLink::NONE; 2], previous: [PairLink::NONE; 2] });
        self.all.push(Pair {
            kind,
            constraint: None,
            is_touching: false,
            responds,
            is_reported,
            is_vetoed: false,
            was_vetoed: false,
            has_surface_override: false,
            are_points_removed: [false; 2],
            is_on_ground: false,
            is_static_sensor: false,
            one_way_state: OneWayState::Closed,
            rolling_impulse: 0.0,
        });
        for side in 0..2 {
            self.link(at, side);
        }
        at
    }

    /// Sets whether a pair touches, and updates the counts of touching pairs.
    pub fn set_touching(&mut self, pair: PairIndex, is_touching: bool) {
        let was_touching = std::mem::replace(&mut self.all[pair].is_touching, is_touching);
        self.touching_count = self.touching_count + usize::from(is_touching) - usize::from(was_touching);
        if self.all[pair].is_on_ground {
            self.touching_ground_count =
                self.touching_ground_count + usize::from(is_touching) - usize::from(was_touching);
        }
        if self.all[pair].is_reported {
            self.reported_count = self.reported_count + usize::from(is_touching) - usize::from(was_touching);
        }
    }

    /// Returns whether there is a pair without collision response: one of its geoms is a sensor.
    #[inline]
    pub(crate) fn has_sensors(&self) -> bool {
        self.sensor_count > 0
    }

    /// Sets whether a pair is one of a sensor and a static or kinematic body, and updates the count of such pairs.
    pub(crate) fn set_static_sensor(&mut self, pair: PairIndex, is_static_sensor: bool) {
        let was_static_sensor = std::mem::replace(&mut self.all[pair].is_static_sensor, is_static_sensor);
        self.static_sensor_count =
            self.static_sensor_count + usize::from(is_static_sensor) - usize::from(was_static_sensor);
    }

    /// Sets whether a handler of the game is called for a pair, and updates the count of such touching pairs.
    pub fn set_reported(&mut self, pair: PairIndex, is_reported: bool) {
        let was_reported = std::mem::replace(&mut self.all[pair].is_reported, is_reported);
        if self.all[pair].is_touching {
            self.reported_count = self.reported_count + usize::from(is_reported) - usize::from(was_reported);
        }
    }

    /// Returns the indices of the proxies with which a proxy has a pair.
    pub(crate) fn partners(&self, proxy: ProxyIndex) -> impl Iterator<Item = ProxyIndex> + '_ {
        self.pairs_and_partners(proxy).map(|(_, partner)| partner)
    }

    /// Returns the pairs of a proxy, each with the index of the other proxy.
    pub(crate) fn pairs_and_partners(
        &self,
        proxy: ProxyIndex,
    ) -> impl Iterator<Item = (PairIndex, ProxyIndex)> + '_ {
        self.pairs_of(proxy).map(move |pair| {
            let [a, b] = self.links[pair].proxies;
            (pair, if a == proxy { b } else { a })
        })
    }

    /// Invalidates the cached manifold of a pair, so that the next step computes the manifold again. Rolling resistance loses its
    /// accumulated impulse, since the geoms may have other surfaces.
    pub fn invalidate(&mut self, pair: PairIndex) {
        self.triggers[pair].motion_tolerance = 0;
        self.manifolds[pair].rotations = [0.0; 4];
        self.all[pair].rolling_impulse = 0.0;
    }

    /// Restores the angular impulse of rolling resistance of a pair, mass units * length units^2/s. Edits since the save
    /// [invalidate](Self::invalidate) the pair after that.
    pub(crate) fn restore_rolling_impulse(&mut self, pair: PairIndex, impulse: f32) {
        self.all[pair].rolling_impulse = impulse;
    }

    /// Inserts a pair at the head of the list of its proxy A (`side` 0) or B (`side` 1).
    fn link(&mut self, pair: PairIndex, side: usize) {
        let head = &mut self.heads[self.triggers[pair].proxies[side]];
        let link = PairLink::new(pair, side);
        let next = std::mem::replace(head, link);
        self.links[pair].next[side] = next;
        self.links[pair].previous[side] = PairLink::NONE;
        if next != PairLink::NONE {
            self.links[next.pair()].previous[next.side()] = link;
        }
    }

    /// Removes a pair, which must have no contact constraint and not touch. The last awake pair takes the place of an awake one,
    /// and the last pair takes the place of that or of a sleeping one. Returns the new indices of the pairs that have moved.
    pub(crate) fn remove(&mut self, pair: PairIndex) -> [Option<PairIndex>; 2] {
        self.set_static_sensor(pair, false);
        self.sensor_count -= usize::from(!self.all[pair].responds);
        self.unlink(pair);
        let (mut gap, mut moved) = (pair, [None; 2]);
        if self.is_awake(pair) {
            let last_awake = self.shorten_awake();
            moved[0] = self.fill(gap, last_awake);
            gap = last_awake;
        }
        moved[1] = self.fill(gap, self.last());
        self.triggers.pop();
        self.manifolds.pop();
        self.links.pop();
        self.all.pop();
        moved
    }

    /// Moves the pair at `from` to the free index `gap`, and to the heads of the lists of its proxies. Returns `gap`, or `None` if
    /// both indices are the same and nothing moves.
    fn fill(&mut self, gap: PairIndex, from: PairIndex) -> Option<PairIndex> {
        if gap == from {
            return None;
        }
        self.unlink(from);
        self.triggers[gap] = self.triggers[from];
        self.manifolds[gap] = self.manifolds[from];
        self.links[gap] = self.links[from];
        self.all[gap] = self.all[from];
        (0..2).for_each(|side| self.link(gap, side));
        Some(gap)
    }

    /// Exchanges the list positions of two pairs. Contact constraints that store the indices are not changed here.
    pub(crate) fn swap(&mut self, one: PairIndex, other: PairIndex) {
        self.unlink(one);
        self.unlink(other);
        self.triggers.swap(one, other);
        self.manifolds.swap(one, other);
        self.links.swap(one, other);
        self.all.swap(one, other);
        for pair in [one, other] {
            (0..2).for_each(|side| self.link(pair, side));
        }
    }

    /// Removes a pair from the lists of pairs of its two proxies.
    fn unlink(&mut self, pair: PairIndex) {
        for side in 0..2 {
            let PairLinks { proxies, next, previous } = self.links[pair];
            match previous[side] {
                PairLink::NONE => self.heads[proxies[side]] = next[side],
                link => self.links[link.pair()].next[link.side()] = next[side],
            }
            if next[side] != PairLink::NONE {
                let link = next[side];
                self.links[link.pair()].previous[link.side()] = previous[side];
            }
        }
    }
}
