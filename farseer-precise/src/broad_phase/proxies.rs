//! Broad phase: the proxies. A proxy is a convex piece of a geom with a fat AABB.
//!
//! A fat AABB is the tight AABB with a margin, and reaches ahead along the predicted motion of its body, so that it does not
//! change in every step (margin: E. Catto, Box2D 3). `Proxies` stores the proxies of non-static bodies first, then spare
//! positions, then the proxies of static bodies.

mod escape;
mod query;

use crate::index::{BodyIndex, DenseIndex, IndexRange, IndexedVec, ProxyIndex};
use crate::parameters::broad_phase::COLLISION_MAX_COORDINATE;
use serde::{Deserialize, Serialize};
use wide::f32x4;

use crate::bodies::{BodySet, spare_capacity};
use crate::broad_phase::hash_grid::PackedAabb;
use crate::math::lanes::gather;
use crate::math::plane::{Vector, rotate, rotation};
use crate::math::scalar::nearest_finite;
use crate::narrow_phase::touch_event::WantedEvent;
use crate::reusing_clone;
use crate::scaled_parameters::{AabbMargin, Parameters};
use crate::shape::{Shape, ShapeRef, VertexPool};
use crate::storage::order::packed_key;
use crate::surface::SurfaceOptions;

/// Value in place of the index of a proxy: the list of a body's proxies ends.
const NO_PROXY: ProxyIndex = ProxyIndex(u32::MAX);
/// AABB that contains every other one, in length units. It is the fat AABB of a proxy whose fat AABB has not been computed yet.
const UNBOUNDED_AABB: PackedAabb = [f32::MIN, f32::MIN, f32::MAX, f32::MAX];
/// AABB that overlaps none, in length units. Proxies beyond the largest coordinate have it.
const EMPTY_AABB: PackedAabb = [f32::MAX, f32::MAX, f32::MIN, f32::MIN];

/// Body type. Of the two proxies of a pair, A is the one with the lesser type. A pair with collision response has a dynamic
/// body.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
pub enum BodyType {
    /// Static: the body never moves.
    Fixed,
    /// Kinematic: the game moves the body, which has infinite mass.
    Kinematic,
    /// A platform of a world with a depth axis that rotates about a vertical hinge.
    Hinged,
    /// Dynamic: forces and impulses move the body.
    Dynamic,
}

impl BodyType {
    /// Returns whether impulses can change the motion of such a body: true for `Hinged` and `Dynamic`.
    pub(crate) fn takes_impulses(self) -> bool {
        self >= BodyType::Hinged
    }
}

/// Convex piece of a geom, with the properties that the broad phase and the contacts read.
#[derive(Debug, Clone, Copy)]
pub struct Proxy {
    /// Number of the geom, world box or ground that the piece belongs to, as the adapter has chosen it. All pieces of a geom
    /// have the same number, and the solver compares it only.
    pub owner: u64,
    /// Whether the piece is a world box or the ground of `twohalf`, and no geom. True for a free position, too.
    pub is_world: bool,
    /// Index of the piece among the convex pieces of its geom.
    pub piece: u32,
    /// Number by which geoms are sorted as in the simulator's list; for a world box its index in the list of world boxes.
    pub list_key: u32,
    /// Creation number of the geom. It determines the order of pairs.
    pub creation_number: u32,
    /// Index of the body in [`BodySet`]; 0 for a free position.
    pub body: BodyIndex,
    /// Type of the body.
    pub body_type: BodyType,
    /// Shape of the piece; its vertices are in [`Proxies::vertices`].
    pub shape: Shape,
    /// [Hash](crate::fingerprint) of the shape, with its depth profile in three axes.
    pub fingerprint: u64,
    /// Friction coefficient of the geom, dimensionless.
    pub friction: f32,
    /// Coefficient of restitution of the geom, dimensionless.
    pub restitution: f32,
    /// Combination rules, surface speed and rolling resistance of the geom.
    pub surface: SurfaceOptions,
    /// Whether contacts of the geom exert impulses (collision response); false for a sensor.
    pub responds: bool,
    /// Whether a handler of the game is called for contacts of the geom.
    pub is_reported: bool,
    /// Collision filter as five numbers: bit mask of the geom's categories, bit mask of the categories that it collides with,
    /// group, flags, and a counter of changes of the ignored geoms. Flags are 1: collisions are enabled, and 2: the masks of both
    /// geoms must agree.
    pub filter: [i32; 5],
    /// Whether the geom ignores collisions with some other geom. The adapter knows which ones.
    pub ignores_some: bool,
    /// Events that the game wants of the geom, as bit flags: see [`WantedEvent`].
    pub events: u8,
    /// Surface velocity of a static body, such as a conveyor belt: x and y in length units/s, rotation in radians/s, z in
    /// length units/s.
    pub surface_velocity: [f32; 4],
    /// Direction of free passage of a one-way geom, a unit vector in the frame of its body. The geom stops bodies that move
    /// against this direction. `None` for other geoms.
    pub one_way: Option<Vector>,
}

impl Proxy {
    /// Returns the content of a free position: a proxy of no body that collides with no other proxy.
    pub(crate) fn empty() -> Self {
        Proxy {
            owner: u64::MAX,
            is_world: true,
            piece: 0,
            list_key: 0,
            creation_number: 0,
            body: BodyIndex::PLACEHOLDER,
            body_type: BodyType::Fixed,
            shape: Shape::default(),
            fingerprint: 0,
            friction: 0.0,
            restitution: 0.0,
            surface: SurfaceOptions::default(),
            responds: false,
            is_reported: false,
            filter: [0; 5],
            ignores_some: false,
            events: 0,
            surface_velocity: [0.0; 4],
            one_way: None,
        }
    }

    /// Returns whether the collision filters of two geoms let them collide. Other conditions for a pair are tested by
    /// [`order_pair`](crate::broad_phase::pair_finder::order_pair).
    pub(crate) fn may_meet(&self, other: &Proxy) -> bool {
        if self.is_world || other.is_world {
            return true;
        }
        let [categories, collides_with, group, flags, _] = self.filter;
        let [other_categories, other_collides_with, other_group, other_flags, _] = other.filter;
        let (is_met, meets) = (categories & other_collides_with != 0, other_categories & collides_with != 0);
        let both_agree = (flags | other_flags) & 2 != 0;
        flags & other_flags & 1 != 0
            && (group != other_group || group == 0)
            && if both_agree { is_met && meets } else { is_met || meets }
    }

    /// Returns whether the proxy may stop a fast body, or is a sensor that reports it, though its body is awake and no bullet.
    pub(crate) fn may_stop(&self) -> bool {
        self.body_type != BodyType::Dynamic || !self.responds
    }

    /// Returns whether the game wants hits of the geom as events.
    fn wants_hits(&self) -> bool {
        self.events & WantedEvent::HIT != 0
    }

    /// Sets the wanted events, and keeps the number of proxies that want hits.
    fn set_events(&mut self, events: u8, hit_count: &mut usize) {
        *hit_count -= usize::from(self.wants_hits());
        self.events = events;
        *hit_count += usize::from(self.wants_hits());
    }

    /// Returns whether the position has no proxy.
    pub fn is_empty(&self) -> bool {
        self.body == BodyIndex::PLACEHOLDER
    }
}

/// Fields of a proxy that loops over proxies and pairs read, apart from the others: 24 bytes, where a [`Proxy`] takes several
/// cache lines.
#[derive(Debug, Clone, Copy)]
struct ProxySummary {
    body: BodyIndex,
    creation_number: u32,
    piece: u32,
    /// Radius of the shape, length units, >= 0.
    radius: f32,
    /// Largest distance of the shape's surface from the origin of its body, length units, >= 0.
    max_extent: f32,
    body_type: BodyType,
}

impl ProxySummary {
    /// Returns the summary of a proxy.
    fn of(proxy: &Proxy) -> Self {
        let Proxy {
            body, creation_number, piece, body_type, shape: Shape { radius, max_extent, .. }, ..
        } = *proxy;
        ProxySummary { body, creation_number, piece, radius, max_extent, body_type }
    }
}

/// All proxies: first those of non-static bodies, in the order of the list of geoms. Spare positions follow, up to a multiple
/// of four; then come the proxies of static bodies. A removed proxy leaves a free position until the lists are rebuilt.
#[derive(Debug, Default)]
pub struct Proxies {
    /// The proxies, and empty ones at free and spare positions.
    all: IndexedVec<ProxyIndex, Proxy>,
    /// Copies of some fields of `all`, by the same indices.
    summaries: IndexedVec<ProxyIndex, ProxySummary>,
    /// Index of the first spare position, which follows the proxies of non-static bodies. Spare positions end at `first_fixed`.
    pub movable_end: ProxyIndex,
    /// Index of the first proxy of a static body.
    pub first_fixed: ProxyIndex,
    /// Number of proxies, without free positions.
    pub live_count: usize,
    /// Number of proxies with a one-way geom.
    pub one_way_count: usize,
    /// Whether any proxy may have rolling resistance; else the solver skips it.
    pub resist_rolling: bool,
    /// Number of proxies whose geom wants hits as events.
    pub hit_count: usize,
    /// Vertices and edge normals of all shapes.
    pub vertices: VertexPool,
    /// AABB of each shape in the frame of its body, without its radius: centre x, y, then half extents x, y, in length units.
    local_aabbs: IndexedVec<ProxyIndex, [f32; 4]>,
    /// Fat AABB of each proxy: [min x, min y, max x, max y] in length units, world axes.
    fat_aabbs: IndexedVec<ProxyIndex, PackedAabb>,
    /// Path length of each proxy since it was added: a bound for all of its points, in 2^-26 length units. The counter wraps.
    travel: IndexedVec<ProxyIndex, u32>,
    /// Indices of the proxies with a new fat AABB. The next broad phase searches their pairs.
    refitted: Vec<ProxyIndex>,
    /// Index of the first proxy of each body, or [`NO_PROXY`].
    heads: IndexedVec<BodyIndex, ProxyIndex>,
    /// For each proxy, the index of the next proxy of the same body, or [`NO_PROXY`].
    next: IndexedVec<ProxyIndex, ProxyIndex>,
}

reusing_clone! {
    Proxies {
        all, summaries, movable_end, first_fixed, live_count, one_way_count, resist_rolling, hit_count, vertices, local_aabbs, fat_aabbs, travel, refitted, heads, next
    }
}

impl Proxies {
    /// Returns creation numbers and piece indices of the proxies [A, B] packed into one integer, by which pairs are
    /// sorted by number.
    pub(crate) fn creation_numbers(&self, proxies: [ProxyIndex; 2]) -> u128 {
        let [a, b] = proxies.map(|proxy| &self.summaries[proxy]);
        packed_key([a.creation_number, a.piece, b.creation_number, b.piece])
    }

    /// Returns the number of positions: proxies, spare and free positions.
    #[inline]
    pub fn position_count(&self) -> usize {
        self.all.len()
    }

    /// Iterates over the indices of all positions, ascending.
    #[inline]
    pub fn indices(&self) -> impl DoubleEndedIterator<Item = ProxyIndex> + ExactSizeIterator + use<> {
        self.all.indices()
    }

    /// Iterates over the positions of the proxies of non-static bodies, ascending. Free positions are among them.
    #[inline]
    pub fn movable(&self) -> IndexRange<ProxyIndex> {
        IndexRange { start: ProxyIndex(0), end: self.movable_end }
    }

    /// Returns the number of spare positions.
    #[inline]
    pub fn spare_count(&self) -> usize {
        self.first_fixed.position() - self.movable_end.position()
    }

    /// Returns the index of the position that [`push`](Self::push) appends.
    #[inline]
    pub fn next_index(&self) -> ProxyIndex {
        self.all.next_index()
    }

    /// Returns a proxy.
    #[inline(always)]
    pub fn proxy(&self, proxy: ProxyIndex) -> &Proxy {
        &self.all[proxy]
    }

    /// Returns the properties of a proxy, to change. Body, body type, numbers, shape and one-way direction stay.
    #[inline(always)]
    pub fn proxy_mut(&mut self, proxy: ProxyIndex) -> &mut Proxy {
        &mut self.all[proxy]
    }

    /// Returns whether the search of pairs has tested all filters of a candidate pair: both proxies belong to geoms that ignore no
    /// other geom.
    pub fn have_plain_filters(&self, pair: [ProxyIndex; 2]) -> bool {
        let is_plain = |proxy: &Proxy| !proxy.is_world && !proxy.ignores_some;
        pair.into_iter().all(|proxy| is_plain(&self.all[proxy]))
    }

    /// Returns a proxy; `None` if no position has this index.
    #[inline]
    pub fn get(&self, proxy: ProxyIndex) -> Option<&Proxy> {
        self.all.at(proxy)
    }

    /// Iterates over all positions from one on, ascending. Spare and free positions are empty proxies.
    #[inline]
    pub fn positions_from(&self, first: ProxyIndex) -> std::slice::Iter<'_, Proxy> {
        self.all.slice(first.position()..).iter()
    }

    /// Returns the index of the body of a proxy.
    #[inline(always)]
    pub fn body_of(&self, proxy: ProxyIndex) -> BodyIndex {
        self.summaries[proxy].body
    }

    /// Returns the largest distance of the surface of a proxy from the origin of its body, length units, >= 0.
    #[inline(always)]
    pub(crate) fn max_extent_of(&self, proxy: ProxyIndex) -> f32 {
        self.summaries[proxy].max_extent
    }

    /// Returns the type of the body of a proxy.
    #[inline(always)]
    pub(crate) fn body_type_of(&self, proxy: ProxyIndex) -> BodyType {
        self.summaries[proxy].body_type
    }

    /// Returns the fat AABB of a proxy: [min x, min y, max x, max y] in length units, world axes.
    #[inline(always)]
    pub fn fat_aabb_of(&self, proxy: ProxyIndex) -> &PackedAabb {
        &self.fat_aabbs[proxy]
    }

    /// Stores the fat AABB of a proxy: [min x, min y, max x, max y] in length units, world axes.
    #[inline(always)]
    pub(crate) fn set_fat_aabb(&mut self, proxy: ProxyIndex, bounds: PackedAabb) {
        self.fat_aabbs[proxy] = bounds;
    }

    /// Returns the path length of a proxy since it was added, in 2^-26 length units, wrapping.
    #[inline(always)]
    pub fn travel_of(&self, proxy: ProxyIndex) -> u32 {
        self.travel[proxy]
    }

    /// Sets the path length of a proxy, in 2^-26 length units.
    #[inline]
    pub fn set_travel(&mut self, proxy: ProxyIndex, travel: u32) {
        self.travel[proxy] = travel;
    }

    /// Returns the proxies whose pairs the next broad phase searches.
    #[inline]
    pub fn refitted(&self) -> &[ProxyIndex] {
        &self.refitted
    }

    /// Lets the next broad phase search the pairs of a proxy.
    #[inline]
    pub fn search_pairs_of(&mut self, proxy: ProxyIndex) {
        self.refitted.push(proxy);
    }

    /// Removes the proxies from the next search of pairs for which `is_kept` returns false.
    pub fn retain_refitted(&mut self, is_kept: impl FnMut(&ProxyIndex) -> bool) {
        self.refitted.retain(is_kept);
    }

    /// Sorts the proxies whose pairs the next broad phase searches by index, each once.
    pub(crate) fn sort_refitted(&mut self) {
        self.refitted.sort_unstable();
        self.refitted.dedup();
    }

    /// Takes the list of the proxies whose pairs are searched. [`return_refitted`](Self::return_refitted) gives its memory back.
    #[inline]
    pub(crate) fn take_refitted(&mut self) -> Vec<ProxyIndex> {
        std::mem::take(&mut self.refitted)
    }

    /// Empties the list of the proxies whose pairs have been searched, and keeps its memory.
    #[inline]
    pub(crate) fn return_refitted(&mut self, mut searched: Vec<ProxyIndex>) {
        searched.clear();
        self.refitted = searched;
    }

    /// Returns the bounding boxes of four shapes in the frames of their bodies, one shape in each lane: centre x, y and half
    /// extents x, y without the radius, then the radii. Length units.
    #[inline(always)]
    pub(crate) fn local_bounds_of(&self, proxies: &[ProxyIndex; 4]) -> ([f32x4; 4], f32x4) {
        let radii = proxies.map(|proxy| self.summaries[proxy].radius);
        (gather(&self.local_aabbs, proxies), f32x4::new(radii))
    }

    /// Sets the [surface](Proxy::surface) of a proxy.
    pub fn set_surface(&mut self, at: ProxyIndex, surface: SurfaceOptions) {
        self.all[at].surface = surface;
        self.resist_rolling |= surface.rolling_resistance > 0.0;
    }

    /// Sets the [wanted events](Proxy::events) of a proxy.
    pub fn set_events(&mut self, at: ProxyIndex, events: u8) {
        self.all[at].set_events(events, &mut self.hit_count);
    }

    /// Returns the shape of a proxy, in the frame of its body.
    #[inline]
    pub(crate) fn shape_of(&self, proxy: ProxyIndex) -> ShapeRef<'_> {
        self.vertices.shape_ref(self.all[proxy].shape)
    }

    /// Removes all proxies.
    pub fn clear(&mut self) {
        self.all.clear();
        self.summaries.clear();
        (self.live_count, self.one_way_count, self.hit_count) = (0, 0, 0);
        self.resist_rolling = false;
        self.vertices.clear();
        self.local_aabbs.clear();
        self.fat_aabbs.clear();
        self.travel.clear();
        self.refitted.clear();
    }

    /// Reserves memory for `count` proxies in lists without proxies.
    pub fn reserve_lists(&mut self, count: usize) {
        // Up to 3 further positions make the number of positions a multiple of 4.
        let capacity = count + spare_capacity(count) + 3;
        self.all.reserve(capacity);
        self.summaries.reserve(capacity);
        self.local_aabbs.reserve(capacity);
        self.fat_aabbs.reserve(capacity);
        self.travel.reserve(capacity);
    }

    /// Appends the spare positions. It is called after the proxies of all non-static bodies were pushed. `count`: number of geoms,
    /// those of static bodies included.
    pub fn add_spare_positions(&mut self, count: usize) {
        self.movable_end = self.all.next_index();
        let movable = self.all.len();
        let spare = spare_capacity(count.max(movable));
        self.first_fixed = ProxyIndex::new((movable + spare).next_multiple_of(4));
        while self.all.next_index() < self.first_fixed {
            self.push(Proxy::empty());
        }
    }

    /// Appends a proxy at the end of all lists except the lists of the bodies, which [`link_bodies`](Self::link_bodies) builds.
    pub fn push(&mut self, proxy: Proxy) {
        let Shape { centre: [x, y], half_extents: [hx, hy], .. } = proxy.shape;
        self.all.push(proxy);
        self.summaries.push(ProxySummary::of(&proxy));
        self.local_aabbs.push([x, y, hx, hy]);
        self.fat_aabbs.push(UNBOUNDED_AABB);
        self.travel.push(0);
        self.live_count += usize::from(!proxy.is_empty());
        self.one_way_count += usize::from(proxy.one_way.is_some());
        self.resist_rolling |= proxy.surface.rolling_resistance > 0.0;
        self.hit_count += usize::from(proxy.wants_hits());
    }

    /// Adds a proxy without a fat AABB at the free position `place`, or behind the others of its type if that is `None`. Returns its
    /// index; `None` if there is no spare position for it.
    pub fn add(&mut self, proxy: Proxy, place: Option<ProxyIndex>) -> Option<ProxyIndex> {
        let end = if proxy.body_type == BodyType::Fixed { self.all.next_index() } else { self.movable_end };
        let at = place.unwrap_or(end);
        if at == self.all.next_index() {
            self.push(proxy);
            self.next.push(NO_PROXY);
        } else if at < self.first_fixed {
            let Shape { centre: [x, y], half_extents: [hx, hy], .. } = proxy.shape;
            (self.all[at], self.local_aabbs[at], self.travel[at]) = (proxy, [x, y, hx, hy], 0);
            self.summaries[at] = ProxySummary::of(&proxy);
            (self.movable_end, self.live_count) = (self.movable_end.max(at.next()), self.live_count + 1);
            self.one_way_count += usize::from(proxy.one_way.is_some());
            self.resist_rolling |= proxy.surface.rolling_resistance > 0.0;
            self.hit_count += usize::from(proxy.wants_hits());
        } else {
            return None;
        }
        let body = proxy.body;
        if self.heads.next_index() <= body {
            self.heads.resize(body.position() + 1, NO_PROXY);
        }
        self.next[at] = std::mem::replace(&mut self.heads[body], at);
        Some(at)
    }

    /// Returns the number by which the geom of a proxy is sorted as in the simulator's list; `None` for a free position and for a
    /// world box.
    pub fn list_key_of_geom(&self, at: ProxyIndex) -> Option<u32> {
        self.all.at(at).filter(|proxy| !(proxy.is_empty() || proxy.is_world)).map(|proxy| proxy.list_key)
    }

    /// Removes a proxy, which must have no pairs. Its position becomes free.
    pub fn remove(&mut self, proxy: ProxyIndex) {
        let at = proxy;
        let body = self.all[at].body;
        let next = std::mem::replace(&mut self.next[at], NO_PROXY);
        let before = self.proxies_of(body).find(|&before| self.next[before] == proxy);
        match before {
            Some(before) => self.next[before] = next,
            None => self.heads[body] = next,
        }
        self.one_way_count -= usize::from(self.all[at].one_way.is_some());
        self.hit_count -= usize::from(self.all[at].wants_hits());
        (self.all[at], self.local_aabbs[at], self.fat_aabbs[at]) = (Proxy::empty(), [0.0; 4], UNBOUNDED_AABB);
        self.summaries[at] = ProxySummary::of(&self.all[at]);
        self.live_count -= 1;
    }

    /// Builds the linked list of proxies of each body. `bodies` is the number of bodies.
    pub fn link_bodies(&mut self, bodies: usize) {
        self.heads.clear();
        self.heads.resize(bodies, NO_PROXY);
        self.next.clear();
        self.next.reserve(self.all.len());
        for (at, proxy) in self.all.enumerated() {
            let head = &mut self.heads[proxy.body];
            self.next.push(if proxy.is_empty() { NO_PROXY } else { std::mem::replace(head, at) });
        }
    }

    /// Returns the indices of the proxies of a body.
    pub fn proxies_of(&self, body: BodyIndex) -> impl Iterator<Item = ProxyIndex> + '_ {
        std::iter::successors(self.first_of_body(body), move |&at| self.next_of_body(at))
    }

    /// Returns the index of the first proxy of a body; `None` if the body has no proxies.
    pub(crate) fn first_of_body(&self, body: BodyIndex) -> Option<ProxyIndex> {
        Some(self.heads[body]).filter(|&at| at != NO_PROXY)
    }

    /// Returns the index of the next proxy of the same body; `None` after the last one.
    pub(crate) fn next_of_body(&self, proxy: ProxyIndex) -> Option<ProxyIndex> {
        Some(self.next[proxy]).filter(|&at| at != NO_PROXY)
    }

    /// Returns the AABB of a proxy in the present pose of its body, enlarged by the speculative distance: [min x, min y, max x,
    /// max y] in length units, world axes.
    #[inline]
    pub(crate) fn tight_aabb(
        &self,
        proxy: ProxyIndex,
        bodies: &BodySet,
        parameters: &Parameters,
    ) -> PackedAabb {
        let (ProxySummary { body, radius, .. }, [cx, cy, hx, hy]) =
            (self.summaries[proxy], self.local_aabbs[proxy]);
        let pose = bodies.poses[body];
        let q = rotation(pose);
        let centre = rotate(q, [cx, cy]);
        let (c, s) = (q[0].abs(), q[1].abs());
        let enlargement = radius + parameters.speculative_distance;
        let (x, y) = (pose[0] + centre[0], pose[1] + centre[1]);
        let (ex, ey) = (c * hx + s * hy + enlargement, s * hx + c * hy + enlargement);
        [x - ex, y - ey, x + ex, y + ey]
    }

    /// Returns the fat AABB of a proxy: its tight AABB with the margin, enlarged along the predicted motion of its body. Length
    /// units, world axes. It is [`EMPTY_AABB`] if a coordinate exceeds [`COLLISION_MAX_COORDINATE`]. `dt` is the step in
    /// seconds.
    #[inline]
    pub(crate) fn fat_aabb(
        &self,
        proxy: ProxyIndex,
        bodies: &BodySet,
        parameters: &Parameters,
        aabb_margin: AabbMargin,
        dt: f32,
    ) -> PackedAabb {
        let tight = self.tight_aabb(proxy, bodies, parameters);
        // The comparison is false for NaN, too.
        if !tight.iter().all(|bound| bound.abs() < COLLISION_MAX_COORDINATE) {
            return EMPTY_AABB;
        }
        let Some(state) = bodies.states.at(self.body_of(proxy)) else { return tight };
        let prediction = [0, 1].map(|axis| aabb_margin.prediction(state.velocity[axis] * dt));
        let margin = aabb_margin.margin;
        let below =
            prediction.map(|displacement| if displacement < 0.0 { displacement - margin } else { -margin });
        let above =
            prediction.map(|displacement| if displacement > 0.0 { displacement + margin } else { margin });
        let bounds = [tight[0] + below[0], tight[1] + below[1], tight[2] + above[0], tight[3] + above[1]];
        bounds.map(nearest_finite)
    }
}
