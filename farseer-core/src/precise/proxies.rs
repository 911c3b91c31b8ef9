//! What pairs are of: the convex pieces of geoms, each with a box that is larger than it has to be, so that it need not be
//! renewed in every step.

use crate::precise::parameters::broad_phase::COLLISION_RANGE;
use serde::{Deserialize, Serialize};

use super::bodies::{Bodies, room_for};
use super::grid::Box2;
use super::outline::{Corners, Shape};
use super::space::parts::is_geom;
use super::tuning::{Tuning, Widening};
use crate::geom::GeomId;
use crate::geom::entry::GeomEntry;
use crate::geom::filter::CollisionFilter;
use crate::math::plane::{Vector, rotation, turn};
use crate::math::scalar::nearest_finite;
use crate::storage::arena::Id;
use crate::storage::order::joined;
use crate::storage::reusing_clone::reusing_clone;

/// Beyond this coordinate squares of distances end, and nothing meets anything.
const NONE: u32 = u32::MAX;
/// Nothing leaves it.
const EVERYWHERE: Box2 = [f32::MIN, f32::MIN, f32::MAX, f32::MAX];
/// Overlaps nothing.
const NOWHERE: Box2 = [f32::MAX, f32::MAX, f32::MIN, f32::MIN];

/// What moves a body. Of two that meet the lesser one is first; one at least is dynamic.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
pub(super) enum Mobility {
    Fixed,
    Kinematic,
    /// About an upright hinge alone.
    Hinged,
    Dynamic,
}

impl Mobility {
    /// Whether something can push it.
    pub(super) fn gives_way(self) -> bool {
        self >= Mobility::Hinged
    }
}

/// A convex piece of a geom.
#[derive(Debug, Clone, Copy)]
pub(super) struct Proxy {
    pub(super) geom: GeomId,
    /// Which piece of the geom it is.
    pub(super) piece: u32,
    /// The geom's place in the list of geoms.
    pub(super) place: u32,
    /// The geom's creation number.
    pub(super) number: u32,
    /// Number of its body.
    pub(super) body: u32,
    pub(super) mobility: Mobility,
    pub(super) shape: Shape,
    /// [Fingerprint](super::fingerprint) of its shape in all axes.
    pub(super) fingerprint: u64,
    pub(super) friction: f32,
    pub(super) restitution: f32,
    /// Whether contacts push.
    pub(super) responds: bool,
    /// Whether a handler is told of what the geom touches.
    pub(super) is_heard: bool,
    /// What decides whom it may meet.
    pub(super) filter: [i32; 5],
    /// Speed of its surface along itself, if it stands still: a belt. Along x and y, turning, and along the depth axis.
    pub(super) surface_velocity: [f32; 4],
    /// The direction against which it holds, in the frame of its body, if it is open from all others.
    pub(super) one_way: Option<Vector>,
}

impl Proxy {
    /// In place of one: it has no body and meets nobody.
    pub(super) fn nothing() -> Self {
        Proxy {
            geom: GeomId::new(u32::MAX, 0),
            piece: 0,
            place: 0,
            number: 0,
            body: 0,
            mobility: Mobility::Fixed,
            shape: Shape::default(),
            fingerprint: 0,
            friction: 0.0,
            restitution: 0.0,
            responds: false,
            is_heard: false,
            filter: [0; 5],
            surface_velocity: [0.0; 4],
            one_way: None,
        }
    }

    /// Whether the filters of two geoms let them meet. What else may forbid it is asked when a pair is made.
    pub(super) fn may_meet(&self, other: &Proxy) -> bool {
        if !(is_geom(self.geom) && is_geom(other.geom)) {
            return true;
        }
        let [is, with, group, is_enabled, _] = self.filter;
        let [other_is, other_with, other_group, other_is_enabled, _] = other.filter;
        is_enabled != 0
            && other_is_enabled != 0
            && (group != other_group || group == 0)
            && (is & other_with != 0 || other_is & with != 0)
    }

    fn body_of_box(&self) -> Option<u32> {
        self.shape.is_box.then_some(self.body)
    }

    /// Whether nothing is there.
    pub(super) fn is_empty(&self) -> bool {
        self.body == 0
    }
}

/// What of a geom's settings decides whom it may meet.
pub(super) fn filter_of(entry: &GeomEntry) -> [i32; 5] {
    let geom = &entry.geom;
    let (is, with) = (geom.collision_categories().bits(), geom.collides_with().bits());
    [is, with, geom.collision_group(), i32::from(geom.collision_enabled()), entry.ignore_changes]
}

/// The same of a fixture.
pub(super) fn filter_of_fixture(filter: &CollisionFilter) -> [i32; 5] {
    let CollisionFilter { categories, collides_with, group, is_enabled, .. } = filter;
    [categories.bits(), collides_with.bits(), *group, i32::from(*is_enabled), 0]
}

/// Those of bodies that can be pushed come first, in the order of the list of geoms; then room for more, up to a multiple of
/// four; then those of what stands still. What has gone leaves its place empty until all are listed anew.
#[derive(Debug, Default)]
pub(super) struct Proxies {
    pub(super) all: Vec<Proxy>,
    /// Those before this place are of bodies that can be pushed, or gone; there is room up to the second one, where those of
    /// what stands still begin; and how many there are of both.
    pub(super) movable: usize,
    pub(super) first_fixed: usize,
    pub(super) live: usize,
    /// How many are one-way.
    pub(super) one_way: usize,
    pub(super) corners: Corners,
    /// Centre and half sides of each shape's box in the body's frame.
    pub(super) boxes: Vec<[f32; 4]>,
    /// Numbers of the bodies of those that are boxes about their origins.
    pub(super) box_bodies: Vec<Option<u32>>,
    pub(super) bounds: Vec<Box2>,
    /// Length of the way of every point of a proxy so far, at least: in parts of the unit, and wrapping.
    pub(super) motion: Vec<u32>,
    /// Those whose bounds are new: pairs are to be looked for.
    pub(super) escaped: Vec<u32>,
    /// The first proxy of each body, and the next one of the same body.
    heads: Vec<u32>,
    next: Vec<u32>,
}

reusing_clone! {
    Proxies {
        all, movable, first_fixed, live, one_way, corners, boxes, box_bodies, bounds, motion, escaped, heads, next
    }
}

impl Proxies {
    /// The creation numbers of two, as a number to [sort](sort_by_number) by.
    pub(super) fn creation_numbers(&self, proxies: [u32; 2]) -> u128 {
        let [a, b] = proxies.map(|proxy| &self.all[proxy as usize]);
        joined([a.number, a.piece, b.number, b.piece])
    }

    pub(super) fn clear(&mut self) {
        self.all.clear();
        (self.live, self.one_way) = (0, 0);
        self.corners.clear();
        self.boxes.clear();
        self.box_bodies.clear();
        self.bounds.clear();
        self.motion.clear();
        self.escaped.clear();
    }

    /// Those of bodies that can be pushed are listed: there is room behind them.
    pub(super) fn leave_room(&mut self) {
        self.movable = self.all.len();
        self.first_fixed = (self.movable + room_for(self.movable)).next_multiple_of(4);
        while self.all.len() < self.first_fixed {
            self.push(Proxy::nothing());
        }
    }

    pub(super) fn push(&mut self, proxy: Proxy) {
        let Shape { centre: [x, y], half: [hx, hy], .. } = proxy.shape;
        self.all.push(proxy);
        self.boxes.push([x, y, hx, hy]);
        self.box_bodies.push(proxy.body_of_box());
        self.bounds.push(EVERYWHERE);
        self.motion.push(0);
        self.live += usize::from(!proxy.is_empty());
        self.one_way += usize::from(proxy.one_way.is_some());
    }

    /// One more comes, if there is room: answers its place. Its bounds are to be found.
    pub(super) fn add(&mut self, proxy: Proxy) -> Option<usize> {
        let at = if proxy.mobility == Mobility::Fixed { self.all.len() } else { self.movable };
        if at == self.all.len() {
            self.push(proxy);
            self.next.push(NONE);
        } else if at < self.first_fixed {
            let Shape { centre: [x, y], half: [hx, hy], .. } = proxy.shape;
            (self.all[at], self.boxes[at], self.motion[at]) = (proxy, [x, y, hx, hy], 0);
            self.box_bodies[at] = proxy.body_of_box();
            (self.movable, self.live) = (at + 1, self.live + 1);
            self.one_way += usize::from(proxy.one_way.is_some());
        } else {
            return None;
        }
        let body = proxy.body as usize;
        if self.heads.len() <= body {
            self.heads.resize(body + 1, NONE);
        }
        self.next[at] = std::mem::replace(&mut self.heads[body], at as u32);
        Some(at)
    }

    /// One has gone, which is in no pair any more.
    pub(super) fn forget(&mut self, proxy: u32) {
        let (at, body) = (proxy as usize, self.all[proxy as usize].body as usize);
        let next = std::mem::replace(&mut self.next[at], NONE);
        let before = self.of(body).find(|&before| self.next[before as usize] == proxy);
        match before {
            Some(before) => self.next[before as usize] = next,
            None => self.heads[body] = next,
        }
        self.one_way -= usize::from(self.all[at].one_way.is_some());
        (self.all[at], self.boxes[at], self.bounds[at]) = (Proxy::nothing(), [0.0; 4], EVERYWHERE);
        self.box_bodies[at] = None;
        self.live -= 1;
    }

    /// Finds the proxies of so many bodies.
    pub(super) fn link(&mut self, bodies: usize) {
        self.heads.clear();
        self.heads.resize(bodies, NONE);
        self.next.clear();
        for (at, proxy) in self.all.iter().enumerate() {
            let head = &mut self.heads[proxy.body as usize];
            self.next.push(if proxy.is_empty() { NONE } else { std::mem::replace(head, at as u32) });
        }
    }

    /// The proxies of a body.
    pub(super) fn of(&self, body: usize) -> impl Iterator<Item = u32> + '_ {
        std::iter::successors(self.first_of(body), move |&at| self.after(at))
    }

    pub(super) fn first_of(&self, body: usize) -> Option<u32> {
        Some(self.heads[body]).filter(|&at| at != NONE)
    }

    /// The next proxy of the same body.
    pub(super) fn after(&self, proxy: u32) -> Option<u32> {
        Some(self.next[proxy as usize]).filter(|&at| at != NONE)
    }

    /// The box around a proxy, as wide as contacts reach.
    #[inline]
    pub(super) fn tight(&self, proxy: usize, bodies: &Bodies, tuning: &Tuning) -> Box2 {
        let Proxy { body, shape, .. } = &self.all[proxy];
        let pose = bodies.poses[*body as usize];
        let q = rotation(pose);
        let centre = turn(q, shape.centre);
        let (c, s) = (q[0].abs(), q[1].abs());
        let [hx, hy] = shape.half;
        let around = shape.radius + tuning.speculative;
        let (x, y) = (pose[0] + centre[0], pose[1] + centre[1]);
        let (ex, ey) = (c * hx + s * hy + around, s * hx + c * hy + around);
        [x - ex, y - ey, x + ex, y + ey]
    }

    /// Bounds with a margin, longer the faster the body is.
    #[inline]
    pub(super) fn widened(
        &self,
        proxy: usize,
        bodies: &Bodies,
        tuning: &Tuning,
        widening: Widening,
        dt: f32,
    ) -> Box2 {
        let tight = self.tight(proxy, bodies, tuning);
        // Also if they are not numbers.
        if !tight.iter().all(|bound| bound.abs() < COLLISION_RANGE) {
            return NOWHERE;
        }
        let Some(hot) = bodies.hot.get(self.all[proxy].body as usize) else { return tight };
        let ahead = [0, 1].map(|axis| widening.ahead(hot.velocity[axis] * dt));
        let margin = widening.margin;
        let below = ahead.map(|way| if way < 0.0 { way - margin } else { -margin });
        let above = ahead.map(|way| if way > 0.0 { way + margin } else { margin });
        let bounds = [tight[0] + below[0], tight[1] + below[1], tight[2] + above[0], tight[3] + above[1]];
        bounds.map(nearest_finite)
    }
}
