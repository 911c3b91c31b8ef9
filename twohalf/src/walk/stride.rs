//! A step of a figure that walks.

use std::cell::RefCell;

use farseer_core::math::scalar::nearest_finite;
use farseer_core::{Body, SpaceTouch};

use super::feet::Feet;
use super::floor::{Floor, Reach, partner_of};
use super::ledge::GRASP;
use super::walls::pushes;
use super::{Near, Walker, Wish};
use crate::depth::Footing;
use crate::{BodyId, GeomId, Partner, TwoHalfPhysicsSimulator, Vector2, Vector3};

/// A floor is stood on from this distance on, px: what falls is caught by it within the step.
pub(super) const STANDS: f32 = 0.05;

/// How far the soles are kept above the floor, px, so that the next one is no obstacle; near enough to touch.
const CLEARS: f32 = 0.008;
/// How far they are lifted over the edge of another floor, px: farther than contacts are kept apart.
pub(super) const OVER: f32 = 0.15;
/// Who lands is no deeper in the floor than this, px.
const SUNK: f32 = 1.0;
/// How fast it comes down from there, px/s: what comes down faster is braked by what it comes down on.
const SETTLES: f32 = 5.0;
/// How far the feet are past an edge when they begin to come down from it, px: contacts that are known are looked at anew after
/// less than that.
pub(super) const PASSED: f32 = 1.7;
/// How far it is looked ahead for curbs beyond two steps, px: farther than what only touches is apart.
const AHEAD: f32 = 0.3;
/// Part of a velocity by which rounding changes it where nothing holds it back.
const UNCHANGED: f32 = 1e-5;
/// Steps within which a curb is come to that the figure is lifted over, and one about which a handler is asked: one more, so that
/// the answer is known before the figure is lifted.
const STEPS_AHEAD: f32 = 2.0;
const STEPS_ASKED: f32 = 3.0;
/// How far places on the way of a round end are apart at which it is looked for edges, as a fraction of its radius: between two of
/// them no edge is missed that would stop it, since one is met from a radius before it to a radius past it.
const EDGES_SEEN: f32 = 0.5;
/// Most of these places, as each of them costs a query: enough for a way of 8 radii.
const MOST_PLACES: f32 = 16.0;
/// How near to a stair a round end is on it, px: nearer than that a wall holds the feet off.
const NEAR_STAIR: f32 = 0.5;
/// What pushes up by more than this part of its normal holds.
const HOLDS: f32 = 0.5;

/// What a step begins with.
#[derive(Clone, Copy)]
pub(super) struct Stride<'a> {
    pub(super) body: BodyId,
    pub(super) near: &'a Near,
    /// Its supports in this step.
    held_by: &'a RefCell<Vec<Footing>>,
    pub(super) geom: GeomId,
    pub(super) feet: Feet,
    /// Heights of the soles, of what can be stepped up, and of the top.
    pub(super) soles: f32,
    pub(super) knees: f32,
    pub(super) head: f32,
    pub(super) place: Vector3,
    pub(super) velocity: Vector3,
    /// Least upward part of the normal of a floor.
    pub(super) least_up: f32,
    /// An edge no higher than this holds a round end, however far that is past it.
    edges: f32,
    /// A stair that it can step on lies under its round end.
    pub(super) is_on_stairs: bool,
    /// Of the figure's own time.
    pub(super) dt: f32,
    /// How fast that passes. What others do in a second of theirs takes longer in its own.
    pub(super) pace: f32,
}

impl<'a> Stride<'a> {
    /// The same for what is between other heights.
    pub(super) fn between(&self, knees: f32, head: f32) -> Self {
        Stride { knees, head, ..*self }
    }

    pub(super) fn reach(&self, above: f32) -> Reach<'a> {
        let Stride { geom, least_up, edges, .. } = *self;
        let (tops, refused) = (&self.near.tops, &self.near.refused);
        Reach { tops, geom, highest: self.soles + above, least_up, but: None, refused, edges }
    }

    /// Whether a handler has refused to let it touch something.
    pub(super) fn refuses(&self, partner: Partner) -> bool {
        self.near.refused.contains(&partner)
    }

    /// Notes that something holds it in a direction, at a height: the handler is asked about that.
    pub(super) fn note_held_by(&self, partner: Partner, normal: Vector3, height: f32) {
        let position = Vector3::new(self.place.x, height, self.place.z);
        let footing = Footing { this: self.geom, partner, normal, position };
        if normal.iter().chain(position.iter()).all(|number| number.is_finite()) {
            self.held_by.borrow_mut().push(footing);
        }
    }

    /// The velocity after something has held it back, or the free one if a handler has refused that.
    pub(super) fn held_back(&self, partner: Partner, free: Vector3, held: Vector3) -> Vector3 {
        let change = held - free;
        let size = change.norm();
        if size > UNCHANGED * free.norm() {
            self.note_held_by(partner, change / size, self.place.y);
        }
        if self.refuses(partner) { free } else { held }
    }

    /// The same on other feet.
    pub(super) fn on(&self, feet: Feet) -> Self {
        Stride { feet, ..*self }
    }

    /// The same for a figure with soles.
    pub(super) fn flat(&self) -> Self {
        self.on(self.feet.flat())
    }

    /// How high a floor is that a round end comes to. One that was lifted over an edge stays so, unless it goes down from there.
    fn height_at(&self, next: &Floor, floor: &Floor) -> f32 {
        let is_lifted = |edge: &f32| *edge <= self.soles && next.height >= floor.height;
        next.edge.filter(|edge| is_lifted(edge) || next.up < self.least_up).unwrap_or(next.height)
    }

    /// Whether something pushes up more than sideways.
    fn is_held_up(&self) -> bool {
        self.near.touches.iter().any(|touch| {
            let [.., up, _] = pushes(touch, self.geom);
            let presses = touch.points[..touch.count].iter().any(|point| point.impulse > 0.0);
            touch.responds && presses && up >= HOLDS
        })
    }

    /// How high a floor is that is stood on: a round end that was lifted over an edge stands as high as that.
    fn height_on(&self, floor: &Floor) -> f32 {
        floor.edge.filter(|&edge| edge <= self.edges).unwrap_or(floor.height)
    }
}

impl TwoHalfPhysicsSimulator {
    pub(super) fn stride(&mut self, body: BodyId, geom: GeomId, walker: &mut Walker, wish: Wish, dt: f32) {
        let (Some(view), Some(outline)) = (self.body(body), self.geom(geom)) else { return };
        let whole = outline.virtual_geom();
        let (feet, head) = (Feet::of(&whole, outline.depth_profile()), whole.top);
        let (place, velocity) = (view.origin3d(), view.velocity3d());
        let pace = self.time_scale(body);
        let dt = dt * pace;
        let (soles, least_up) = (view.position3d().y, walker.walk.least_up());
        let knees = soles + if walker.floor.is_some() { walker.walk.step_up.max(STANDS) } else { STANDS };
        let mut near = std::mem::take(&mut self.near);
        let around = feet.widened(farthest(walker, velocity, dt));
        let below = soles - snap_reach(walker).max(lift_of(walker));
        let heights = [below, soles + lift_of(walker)].map(nearest_finite);
        self.gather_near((body, geom), &around, heights, &mut near);
        // Who falls past an edge is not caught by it.
        let may_hold = walker.floor.is_some() || walker.ledge.is_some();
        let edges = if may_hold { soles + STANDS } else { f32::MIN };
        let held_by = RefCell::new(std::mem::take(&mut near.held_by));
        let stride = Stride {
            body,
            near: &near,
            held_by: &held_by,
            geom,
            feet,
            soles,
            knees,
            head,
            place,
            velocity,
            least_up,
            edges,
            is_on_stairs: false,
            dt,
            pace,
        };
        let velocity = self.next_velocity(&stride, walker, wish);
        near.held_by = held_by.into_inner();
        near.held_by.drain(..).for_each(|footing| self.world.footings.ask(footing));
        self.near = near;
        walker.told = nearest_finite(velocity.y);
        if let Some(mut view) = self.body_mut(body) {
            view.set_velocity3d(velocity);
        }
    }

    fn next_velocity(&mut self, stride: &Stride<'_>, walker: &mut Walker, wish: Wish) -> Vector3 {
        let Stride { place, dt, .. } = *stride;
        self.arrive(stride, walker);
        let floor = self.floor_stood_on(stride, walker, wish);
        walker.aloft = if floor.is_some() { 0.0 } else { nearest_finite(walker.aloft + dt) };
        walker.has_jumped &= floor.is_none();
        if let Some(floor) = &floor {
            let place = Vector3::new(place.x, floor.height, place.z);
            walker.carried = self.velocity_of(floor.partner, place) / stride.pace;
            walker.carried = walker.carried.map(nearest_finite);
            stride.note_held_by(floor.partner, Vector3::y(), floor.height);
        }
        walker.ledge = walker.ledge.filter(|_| floor.is_none());
        let may_jump = walker.aloft <= walker.walk.coyote_time && !walker.has_jumped;
        match floor {
            _ if wish.jump && may_jump => self.jumping(stride, walker, wish),
            Some(floor) => self.walking(stride, walker, wish, floor),
            None => match self.hanging(stride, walker, wish) {
                Some(velocity) => {
                    walker.floor = None;
                    velocity
                }
                None => self.flying(stride, walker, wish),
            },
        }
    }

    /// What the figure stands on before this step: near its soles; or farther below if it stood in the last step, too, and has
    /// not been thrown up since.
    fn floor_stood_on(&self, stride: &Stride<'_>, walker: &Walker, wish: Wish) -> Option<Floor> {
        let floor = self.floor_below(&stride.feet, &stride.reach(SUNK))?;
        let gap = stride.soles - stride.height_on(&floor);
        let below = self.velocity_of(floor.partner, stride.place).y / stride.pace;
        let kick = (2.0 * self.pull(stride.body, walker).norm() * walker.walk.snap).sqrt();
        let is_thrown = stride.velocity.y > walker.told.max(below) + kick;
        let stood = walker.floor.is_some();
        let stands = if stood {
            let is_lifted = || gap <= lift_of(walker) && self.is_over_curb(stride, walker, wish, &floor);
            !is_thrown && (gap <= snap_reach(walker) || is_lifted())
        } else {
            gap <= STANDS && stride.velocity.y <= below + kick.min(1.0)
        };
        stands.then_some(floor)
    }

    /// Whether the figure has been lifted over the edge of another floor that it comes to in the next two steps. It stands then,
    /// however far below its soles the floor is that it leaves.
    fn is_over_curb(&self, stride: &Stride<'_>, walker: &Walker, wish: Wish, floor: &Floor) -> bool {
        let swept =
            stride.feet.flat().swept(way_to_curb(stride, walker, (stride.velocity, STEPS_AHEAD), wish));
        let reach = Reach { but: Some(floor.partner), ..stride.reach(STANDS) };
        let curb = self.floor_below(&swept, &reach);
        curb.is_some_and(|curb| stride.soles - curb.height <= OVER + STANDS)
    }

    /// Whether a stair that can be stepped on lies under the feet, or within a skin of them, as if they were soles.
    fn is_over_stair(&self, stride: &Stride<'_>, walker: &Walker, floor: &Floor) -> bool {
        let from = stride.height_on(floor);
        let reach = Reach { highest: from + CLEARS + walker.walk.step_up, ..stride.reach(0.0) };
        let feet = stride.feet.flat().widened(NEAR_STAIR);
        self.floor_below(&feet, &reach).is_some_and(|stair| stair.height > floor.height + CLEARS)
    }

    /// Acceleration by gravity in the air, px/s², along X and down.
    fn pull(&self, body: BodyId, walker: &Walker) -> Vector2 {
        let is_pulled = |body: &&Body| walker.is_held || !body.ignore_gravity();
        self.gravity() * self.core.body(body).filter(is_pulled).map_or(0.0, Body::gravity_scale)
    }

    /// While a figure stands, velocities alone put it from one place on the floor to the next, and gravity is kept from it:
    /// contacts that hold it up would rub. A body that ignores gravity by itself goes on doing so.
    pub(super) fn hold(&mut self, body: BodyId, walker: &mut Walker, holds: bool) {
        let Some(mut view) = self.body_mut(body) else { return };
        if holds && !view.ignore_gravity() {
            view.set_ignore_gravity(true);
            walker.is_held = true;
        } else if !holds && std::mem::take(&mut walker.is_held) {
            view.set_ignore_gravity(false);
        }
    }

    pub(super) fn jumping(&mut self, stride: &Stride<'_>, walker: &mut Walker, wish: Wish) -> Vector3 {
        (walker.floor, walker.has_jumped) = (None, true);
        self.hold(stride.body, walker, false);
        let level = self.level_velocity(stride, walker, wish, walker.walk.air_acceleration);
        let start = (2.0 * self.pull(stride.body, walker).y.max(0.0) * walker.walk.jump_height).sqrt();
        let velocity = Vector3::new(level.x, start + walker.carried.y, level.z);
        self.held_off(stride, velocity, |_| true)
    }

    fn flying(&mut self, stride: &Stride<'_>, walker: &mut Walker, wish: Wish) -> Vector3 {
        let has_left = walker.floor.take().is_some();
        self.hold(stride.body, walker, false);
        // What slides down a slope is not held up by wishes.
        let acceleration = if stride.is_held_up() { 0.0 } else { walker.walk.air_acceleration };
        let mut velocity = self.level_velocity(stride, walker, wish, acceleration);
        if has_left && stride.velocity.y <= walker.told {
            // It goes over an edge, and does not leap off by the slope that led there.
            velocity.y = velocity.y.min(walker.carried.y.max(0.0));
        }
        self.held_off(stride, velocity, |_| true)
    }

    /// The velocity towards what is wished, no faster than an acceleration allows; Y as it was.
    fn level_velocity(&self, stride: &Stride<'_>, walker: &Walker, wish: Wish, acceleration: f32) -> Vector3 {
        let aim = Vector2::new(walker.carried.x + wish.x, walker.carried.z + wish.z);
        let now = Vector2::new(stride.velocity.x, stride.velocity.z);
        let (missing, most) = (aim - now, acceleration * stride.dt);
        let size = missing.norm();
        let next = if size > most { now + missing * (most / size) } else { aim };
        Vector3::new(nearest_finite(next.x), stride.velocity.y, nearest_finite(next.y))
    }

    fn walking(&mut self, stride: &Stride<'_>, walker: &mut Walker, wish: Wish, floor: Floor) -> Vector3 {
        walker.floor = Some(floor.partner);
        // Measured from the floor: the soles may be lifted over an edge already.
        let knees = stride.height_on(&floor) + CLEARS + walker.walk.step_up.max(STANDS);
        let stride = &Stride { knees, ..*stride };
        let level = self.level_velocity(stride, walker, wish, walker.walk.acceleration);
        let is_wall = |touch: &SpaceTouch| self.is_fixed(partner_of(touch, stride.geom));
        let curb =
            self.curb_ahead(stride, (walker, STEPS_AHEAD), level, wish, (&floor, &stride.near.refused));
        let asked = self.curb_ahead(stride, (walker, STEPS_ASKED), level, wish, (&floor, &[]));
        asked.into_iter().for_each(|curb| stride.note_held_by(curb.partner, Vector3::y(), curb.height));
        // A curb is a wall until the soles are over it, which they are before it is reached.
        let knees = match stride.feet.ball() {
            Some(ball) => {
                let knees = stride.knees + floor.lower_than_soles(ball.radius);
                // The stair after the one that it comes on to is higher than that.
                curb.as_ref().map_or(knees, |curb| knees.max(curb.height))
            }
            None if curb.is_some() => stride.soles + STANDS,
            None => stride.knees,
        };
        let is_on_stairs = stride.feet.ball().is_some() && self.is_over_stair(stride, walker, &floor);
        let mut velocity = self.held_off(&Stride { knees, is_on_stairs, ..*stride }, level, is_wall);
        let height = match curb {
            Some(curb) => curb.height,
            None => self.height_ahead(stride, walker, velocity, &floor) + clearance(stride, &floor),
        };
        velocity.y = walker.carried.y + (height - stride.soles) / stride.dt;
        self.weigh_on(stride, walker, floor.partner);
        self.hold(stride.body, walker, true);
        velocity
    }

    /// Another floor that is as high or higher, and that the figure would come to in so many steps; with what it is lifted over its
    /// edge. The stair after one that it comes on to within this step is measured from that one: who walks farther in a step than
    /// half of a tread would stop at every other edge.
    fn curb_ahead(
        &self,
        stride: &Stride<'_>,
        (walker, steps): (&Walker, f32),
        velocity: Vector3,
        wish: Wish,
        (floor, refused): (&Floor, &[Partner]),
    ) -> Option<Floor> {
        let way = way_to_curb(stride, walker, (velocity, steps), wish);
        let next = (velocity - walker.carried) * stride.dt;
        let highest = |from: f32| from + CLEARS + walker.walk.step_up;
        let from = stride.height_on(floor);
        let reach = Reach { highest: highest(from), refused, edges: highest(from), ..stride.reach(0.0) };
        let first = self.curb_within(stride, &reach, floor, [next, way]);
        let stair = self.floor_below(&stride.feet.flat().swept(next), &reach);
        let stair = stair.filter(|stair| stair.height > from + CLEARS && stair.height <= stride.soles);
        let second = stair.and_then(|stair| {
            let highest = highest(stair.height);
            self.curb_within(stride, &Reach { highest, edges: highest, ..reach }, floor, [next, way])
        });
        second.or(first)
    }

    /// A floor in reach that is higher than that which is stood on and lies within a way; with what the figure is lifted over its
    /// edge.
    fn curb_within(
        &self,
        stride: &Stride<'_>,
        reach: &Reach<'_>,
        floor: &Floor,
        ways: [Vector3; 2],
    ) -> Option<Floor> {
        if let Some(ball) = stride.feet.ball() {
            return self.rise_within(stride, reach, ways, ball.radius);
        }
        let reach = Reach { but: Some(floor.partner), ..*reach };
        let curb = self.floor_below(&stride.feet.swept(ways[1]), &reach)?;
        let over = Floor { height: curb.height + OVER, ..curb };
        let here = self.height_of(curb.partner, &stride.feet, &reach);
        let is_ahead = here.is_none_or(|here| here < curb.height - CLEARS);
        (is_ahead && over.height > floor.height + CLEARS).then_some(over)
    }

    /// The same for a round end: an edge or a slope that it would come to, higher than what it touches now leads. Over an edge it is
    /// lifted as soles are, since the way round that is steep at first; over the foot of a slope by as little as it can be.
    fn rise_within(
        &self,
        stride: &Stride<'_>,
        reach: &Reach<'_>,
        ways: [Vector3; 2],
        radius: f32,
    ) -> Option<Floor> {
        let here = self.floor_below(&stride.feet, reach)?;
        let ahead_of = |way: Vector3| {
            let ahead = self.floor_below(&stride.feet.moved(way), reach);
            // Over an edge it comes no higher than that.
            (ahead, here.height_along(way).min(here.edge.unwrap_or(f32::MAX)))
        };
        let [next, then] = ways.map(ahead_of);
        let foot = next.0.map_or(next.1, |floor| floor.height.max(next.1));
        let rise = |(ahead, along): (Option<Floor>, f32), foot: Option<f32>| {
            let ahead = ahead.filter(|ahead| ahead.height > along + CLEARS)?;
            let height = ahead.edge.or(foot)?;
            (height <= reach.edges).then_some(Floor { height: height + OVER, ..ahead })
        };
        let ends = [next, then].into_iter().filter_map(|found| rise(found, Some(foot)));
        // An edge may lie between these places, farther from both than the radius.
        let parts = (ways[1].norm() / (EDGES_SEEN * radius)).ceil().min(MOST_PLACES) as usize;
        let between = (1..parts).filter_map(|at| rise(ahead_of(ways[1] * (at as f32 / parts as f32)), None));
        ends.chain(between).reduce(|highest, rise| if rise.height > highest.height { rise } else { highest })
    }

    /// How high the floor is after this step. From one floor to a lower one the way down begins when nothing is left of the higher
    /// one below the feet.
    fn height_ahead(&self, stride: &Stride<'_>, walker: &Walker, velocity: Vector3, floor: &Floor) -> f32 {
        let way = (velocity - walker.carried) * stride.dt;
        let reach = Reach { highest: stride.knees, ..stride.reach(0.0) };
        let next = self.floor_below(&stride.feet.moved(way), &reach);
        let next = next.filter(|next| stride.soles - stride.height_on(next) <= snap_reach(walker));
        if stride.feet.ball().is_some() {
            // A way that is no steeper than what it touches now does not press on that.
            let along = floor.height_along(way).min(floor.edge.unwrap_or(f32::MAX));
            return next.map_or(stride.height_on(floor), |next| stride.height_at(&next, floor).max(along));
        }
        let here = self.floor_below(&stride.feet.swept(way).widened(PASSED), &stride.reach(STANDS));
        match (next, here) {
            (Some(next), Some(here)) if next.partner != here.partner => next.height.max(here.height),
            (Some(next), _) => next.height,
            (None, _) => floor.height,
        }
    }

    pub(super) fn is_fixed(&self, partner: Option<Partner>) -> bool {
        match partner {
            Some(Partner::Geom(geom)) => {
                let body = self.core.geom(geom).and_then(|geom| self.core.body(geom.body()));
                body.is_some_and(|body| body.is_static() || body.is_kinematic())
            }
            _ => true,
        }
    }

    /// What the figure stands on bears its weight, which it does not feel itself.
    fn weigh_on(&mut self, stride: &Stride<'_>, walker: &Walker, floor: Partner) {
        let (Partner::Geom(geom), Some(body)) = (floor, self.core.body(stride.body)) else { return };
        let weight = self.pull(stride.body, walker) * (body.mass() * stride.pace);
        let Some(outline) = self.geom(geom) else { return };
        // In the middle of what both have in common, so that nothing tips which carries.
        let (whole, feet) = (outline.virtual_geom(), &stride.feet);
        let x = 0.5 * (whole.left.max(feet.left) + whole.right.min(feet.right));
        let below = Some(outline.body());
        let below = below.and_then(|below| self.body_mut(below)).filter(|view| !view.is_static());
        if let Some(mut view) = below.filter(|_| weight.iter().all(|part| part.is_finite())) {
            let soles = Vector2::new(x, -stride.soles);
            view.core_mut().apply_force_at_world_point(weight, soles);
        }
    }
}

/// How far below the soles a floor may be for a figure that stood to be put down on it, px: the soles are kept above a floor, and
/// lifted over the edge of another one.
fn snap_reach(walker: &Walker) -> f32 {
    walker.walk.snap + CLEARS + OVER
}

/// How far over the floor a figure is lifted at most, px, to come over the edge of a curb.
fn lift_of(walker: &Walker) -> f32 {
    walker.walk.step_up + CLEARS + OVER + STANDS
}

/// The way of some steps at a velocity, as seen from the floor, and a little more where it wishes to go, px.
fn way_to_curb(
    stride: &Stride<'_>,
    walker: &Walker,
    (velocity, steps): (Vector3, f32),
    wish: Wish,
) -> Vector3 {
    let wished = Vector3::new(wish.x, 0.0, wish.z);
    let ahead = wished * (AHEAD / wished.norm().max(f32::MIN_POSITIVE));
    (velocity - walker.carried) * (steps * stride.dt) + ahead
}

/// How far from the feet a floor can be that is looked at in a step.
fn farthest(walker: &Walker, velocity: Vector3, dt: f32) -> f32 {
    let Walker { walk, carried, .. } = walker;
    let fastest = velocity.norm() + carried.norm() + walk.acceleration.max(walk.air_acceleration) * dt;
    let reaches = if walk.ledge_reach > 0.0 { GRASP } else { 0.0 };
    nearest_finite(STEPS_ASKED * dt * fastest + AHEAD + 1.0 + reaches)
}

/// How far above its floor the soles are to be after this step.
fn clearance(stride: &Stride<'_>, floor: &Floor) -> f32 {
    let gap = stride.soles - floor.edge.unwrap_or(floor.height);
    let was_lifted = gap <= OVER + CLEARS;
    if was_lifted { CLEARS.max(gap - SETTLES * stride.dt) } else { CLEARS }
}
