//! What pairs are of: the convex pieces of geoms, each with a box that is larger than it has to be, so that it need not be
//! renewed in every step.

use serde::{Deserialize, Serialize};

use super::bodies::Bodies;
use super::grid::Box2;
use super::outline::{Corners, Shape};
use super::tuning::Tuning;
use crate::geom::GeomId;
use crate::geom::entry::GeomEntry;
use crate::math::plane::{rotation, turn};
use crate::storage::arena::Id;
use crate::storage::reusing_clone::reusing_clone;

/// Boxes reach ahead of a body by what it moves in so many steps.
const STEPS_AHEAD: f32 = 4.0;
/// And around it by so much of its size at most.
const MARGIN_OF_SIZE: f32 = 0.25;

/// Beyond this coordinate squares of distances end, and nothing meets anything.
const FARTHEST: f32 = 1e18;
const NONE: u32 = u32::MAX;
/// Overlaps nothing.
const NOWHERE: Box2 = [f32::MAX, f32::MAX, f32::MIN, f32::MIN];

/// What moves a body. Of two that meet the lesser one is first; one at least is dynamic.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
pub(super) enum Mobility {
    Fixed,
    Kinematic,
    Dynamic,
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
    pub(super) friction: f32,
    pub(super) restitution: f32,
    /// Whether contacts push.
    pub(super) responds: bool,
    /// Whether a handler is told of what the geom touches.
    pub(super) is_heard: bool,
    /// What decides whom it may meet.
    pub(super) filter: [i32; 5],
    /// Speed of its surface along itself, if it stands still: a belt.
    pub(super) surface_velocity: [f32; 3],
}

/// What of a geom's settings decides whom it may meet.
pub(super) fn filter_of(entry: &GeomEntry) -> [i32; 5] {
    let geom = &entry.geom;
    let (is, with) = (geom.collision_categories().bits(), geom.collides_with().bits());
    [is, with, geom.collision_group(), i32::from(geom.collision_enabled()), entry.ignore_changes]
}

/// Those of bodies that can be pushed come first; lists of them are as long as a multiple of four.
#[derive(Debug, Default)]
pub(super) struct Proxies {
    pub(super) all: Vec<Proxy>,
    /// Number of proxies of bodies that can be pushed.
    pub(super) movable: usize,
    pub(super) corners: Corners,
    /// Centre and half sides of each shape's box in the body's frame.
    pub(super) boxes: Vec<[f32; 4]>,
    pub(super) bounds: Vec<Box2>,
    /// Length of the way of every point of a proxy so far, at least: in parts of the unit, and wrapping.
    pub(super) motion: Vec<u32>,
    /// Those whose bounds are new: pairs are to be looked for.
    pub(super) escaped: Vec<u32>,
    /// The first proxy of each body, and the next one of the same body.
    heads: Vec<u32>,
    next: Vec<u32>,
}

reusing_clone! { Proxies { all, movable, corners, boxes, bounds, motion, escaped, heads, next } }

impl Proxies {
    pub(super) fn clear(&mut self) {
        self.all.clear();
        self.corners.clear();
        self.boxes.clear();
        self.bounds.clear();
        self.motion.clear();
        self.escaped.clear();
    }

    /// Fills the list of those that can be pushed up to a multiple of four, with what has no body and meets nobody.
    pub(super) fn fill_up(&mut self) {
        while !self.all.len().is_multiple_of(4) {
            self.push(Proxy {
                geom: GeomId::new(u32::MAX, 0),
                piece: 0,
                place: 0,
                number: 0,
                body: 0,
                mobility: Mobility::Fixed,
                shape: Shape::default(),
                friction: 0.0,
                restitution: 0.0,
                responds: false,
                is_heard: false,
                filter: [0; 5],
                surface_velocity: [0.0; 3],
            });
        }
    }

    pub(super) fn push(&mut self, proxy: Proxy) {
        let Shape { centre: [x, y], half: [hx, hy], .. } = proxy.shape;
        self.all.push(proxy);
        self.boxes.push([x, y, hx, hy]);
        self.bounds.push([0.0; 4]);
        self.motion.push(0);
    }

    /// Finds the proxies of so many bodies.
    pub(super) fn link(&mut self, bodies: usize) {
        self.heads.clear();
        self.heads.resize(bodies, NONE);
        self.next.clear();
        for (at, proxy) in self.all.iter().enumerate() {
            self.next.push(std::mem::replace(&mut self.heads[proxy.body as usize], at as u32));
        }
    }

    /// The proxies of a body.
    pub(super) fn of(&self, body: usize) -> impl Iterator<Item = u32> + '_ {
        let listed = |at: u32| (at != NONE).then_some(at);
        std::iter::successors(listed(self.heads[body]), move |&at| listed(self.next[at as usize]))
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
    pub(super) fn widened(&self, proxy: usize, bodies: &Bodies, tuning: &Tuning, dt: f32) -> Box2 {
        let tight = self.tight(proxy, bodies, tuning);
        let Proxy { body, shape, .. } = &self.all[proxy];
        // Also if they are not numbers.
        if !tight.iter().all(|bound| bound.abs() < FARTHEST) {
            return NOWHERE;
        }
        let Some(hot) = bodies.hot.get(*body as usize) else { return tight };
        let by_size = MARGIN_OF_SIZE * shape.reach;
        let margin = if by_size < tuning.margin { by_size } else { tuning.margin };
        let ahead = [0, 1].map(|axis| (hot.velocity[axis] * (STEPS_AHEAD * dt)).clamp(-FARTHEST, FARTHEST));
        let below = ahead.map(|way| if way < 0.0 { way - margin } else { -margin });
        let above = ahead.map(|way| if way > 0.0 { way + margin } else { margin });
        [tight[0] + below[0], tight[1] + below[1], tight[2] + above[0], tight[3] + above[1]]
    }
}
