//! One move of the character controller: ground test, walking, jumping, falling, and stepping over curbs.

use std::cell::RefCell;

use farseer_core::Body;
use farseer_core::depth::DepthContact;
use farseer_core::math::scalar::nearest_finite;

use super::character_footprint::CharacterFootprint;
use super::ground_probe::{GroundHit, ProbeLimits, partner_of};
use super::ledge::GRAB_DISTANCE;
use super::wall_avoidance::normal_towards;
use super::{CharacterController, MoveInput, Neighbours};
use crate::depth::Footing;
use crate::{BodyId, ContactTarget, GeomId, TwoHalfPhysicsSimulator, Vector2, Vector3};

/// Greatest gap between sole and floor for a falling character to land, px.
pub(super) const STAND_DISTANCE: f32 = 0.05;

/// Gap kept between sole and floor, px. With it the edge of the next flush floor is no obstacle, and the narrow phase still
/// reports contacts.
const SOLE_CLEARANCE: f32 = 0.008;
/// Gap between sole and the edge of a curb while the character passes over it, px; more than the contact
/// margin.
pub(super) const EDGE_CLEARANCE: f32 = 0.15;
/// Greatest penetration of the sole in a floor on which the character may land, px.
const MAX_LANDING_DEPTH: f32 = 1.0;
/// Speed at which a character comes down from an edge that it was lifted over, px/s. A higher speed makes the
/// contact solver brake it.
const SETTLE_SPEED: f32 = 5.0;
/// Distance past an edge at which the soles begin to come down, px. The narrow phase refreshes a persistent
/// contact after a shorter motion.
pub(super) const EDGE_PASS_DISTANCE: f32 = 1.7;
/// Distance ahead of the swept footprint in which curbs are searched, px; more than the gap of touching
/// shapes.
const LOOK_AHEAD_DISTANCE: f32 = 0.3;
/// Greatest change of a velocity by rounding, as a fraction of the norm of the velocity; dimensionless.
const VELOCITY_ROUNDING: f32 = 1e-5;
/// `LIFT_STEPS`: number of steps ahead in which a curb lifts the character. `FILTER_STEPS`: number of steps
/// ahead in which the event handler is asked about a curb, so that its answer precedes the lift.
const LIFT_STEPS: f32 = 2.0;
const FILTER_STEPS: f32 = 3.0;
/// Spacing of the probes along the path of a hemisphere, as a fraction of its radius. An edge supports it
/// from one radius before to one radius past, so no probe interval misses an edge.
const PROBE_SPACING: f32 = 0.5;
/// Greatest number of probes along the path of a hemisphere, since each probe costs a query; enough for a path of 8 radii.
const MAX_PROBES: f32 = 16.0;
/// Distance from a stair within which a hemisphere counts as on it, px. Nearer walls are kept off by the wall
/// clearance.
const STAIR_MARGIN: f32 = 0.5;
/// Least upward component of a contact normal that supports; dimensionless.
const MIN_SUPPORT_UP: f32 = 0.5;

/// State of a character at the start of one step of its controller: footprint, heights and settings.
#[derive(Clone, Copy)]
pub(super) struct StepContext<'a> {
    pub(super) body: BodyId,
    pub(super) near: &'a Neighbours,
    /// Supports of the character in this step, about which the next update asks the event handler.
    held_by: &'a RefCell<Vec<Footing>>,
    pub(super) geom: GeomId,
    pub(super) footprint: CharacterFootprint,
    /// Heights in px, Y up: `soles` is the lowest point, `knees` the highest curb that is stepped up, `head`
    /// the top.
    pub(super) soles: f32,
    pub(super) knees: f32,
    pub(super) head: f32,
    pub(super) place: Vector3,
    pub(super) velocity: Vector3,
    /// Least upward component of a floor's normal; dimensionless.
    pub(super) min_up: f32,
    /// Height in px up to which an edge supports a hemisphere, also one whose centre is past it.
    edges: f32,
    /// Whether a stair within step height lies under the hemisphere.
    pub(super) is_on_stairs: bool,
    /// Step in s of the character's own time.
    pub(super) dt: f32,
    /// Time scale of the body, 0 < scale <= 1; dimensionless. Velocities of other bodies are divided by it.
    pub(super) pace: f32,
}

impl<'a> StepContext<'a> {
    /// Returns a copy of this step state with the heights `knees` and `head` replaced, in px.
    pub(super) fn between(&self, knees: f32, head: f32) -> Self {
        StepContext { knees, head, ..*self }
    }

    pub(super) fn reach(&self, above: f32) -> ProbeLimits<'a> {
        let StepContext { geom, min_up, edges, .. } = *self;
        let (tops, refused) = (&self.near.tops, &self.near.refused);
        ProbeLimits { tops, geom, highest: self.soles + above, min_up, but: None, refused, edges }
    }

    /// Returns whether the event handler has refused contact of the character with the target.
    pub(super) fn refuses(&self, partner: ContactTarget) -> bool {
        self.near.refused.contains(&partner)
    }

    /// Appends a support to `held_by`, with its normal and its height in px, so that the next update asks the event handler
    /// about this support.
    pub(super) fn record_support(&self, partner: ContactTarget, normal: Vector3, height: f32) {
        let position = Vector3::new(self.place.x, height, self.place.z);
        let footing = Footing { this: self.geom, partner, normal, position };
        if normal.iter().chain(position.iter()).all(|number| number.is_finite()) {
            self.held_by.borrow_mut().push(footing);
        }
    }

    /// Returns the constrained velocity `held`, or the velocity `free` if the event handler has refused the target.
    pub(super) fn constrain_velocity(&self, partner: ContactTarget, free: Vector3, held: Vector3) -> Vector3 {
        let change = held - free;
        let size = change.norm();
        if size > VELOCITY_ROUNDING * free.norm() {
            self.record_support(partner, change / size, self.place.y);
        }
        if self.refuses(partner) { free } else { held }
    }

    /// Returns a copy of this step state with another footprint.
    pub(super) fn on(&self, footprint: CharacterFootprint) -> Self {
        StepContext { footprint, ..*self }
    }

    /// Returns a copy of this step state whose footprint has a flat sole.
    pub(super) fn flat(&self) -> Self {
        self.on(self.footprint.flat())
    }

    /// Height of the floor ahead of a hemisphere, px. A hemisphere that was lifted over an edge keeps the height of the edge,
    /// unless the path descends behind the edge.
    fn height_at(&self, next: &GroundHit, floor: &GroundHit) -> f32 {
        let is_lifted = |edge: &f32| *edge <= self.soles && next.height >= floor.height;
        next.edge.filter(|edge| is_lifted(edge) || next.up < self.min_up).unwrap_or(next.height)
    }

    /// Returns whether a contact with a normal impulse supports the character.
    fn is_held_up(&self) -> bool {
        self.near.touches.iter().any(|touch| {
            let [.., up, _] = normal_towards(touch, self.geom);
            let presses = touch.points[..touch.count].iter().any(|point| point.impulse > 0.0);
            touch.responds && presses && up >= MIN_SUPPORT_UP
        })
    }

    /// Height of the floor that the character stands on, px: the edge for a hemisphere that was lifted over
    /// it.
    fn height_on(&self, floor: &GroundHit) -> f32 {
        floor.edge.filter(|&edge| edge <= self.edges).unwrap_or(floor.height)
    }
}

impl TwoHalfPhysicsSimulator {
    pub(super) fn move_character(
        &mut self,
        body: BodyId,
        geom: GeomId,
        walker: &mut CharacterController,
        wish: MoveInput,
        dt: f32,
    ) {
        let (Some(view), Some(outline)) = (self.body(body), self.geom(geom)) else { return };
        let whole = outline.virtual_geom();
        let (footprint, head) = (CharacterFootprint::of(&whole, outline.depth_profile()), whole.top);
        let (place, velocity) = (view.origin3d(), view.velocity3d());
        let pace = self.time_scale(body);
        let dt = dt * pace;
        let (soles, min_up) = (view.position3d().y, walker.walk.min_up());
        let knees = soles
            + if walker.floor.is_some() { walker.walk.step_up.max(STAND_DISTANCE) } else { STAND_DISTANCE };
        let mut near = std::mem::take(&mut self.near);
        let around = footprint.widened(probe_distance(walker, velocity, dt));
        let below = soles - snap_distance(walker).max(max_lift(walker));
        let heights = [below, soles + max_lift(walker)].map(nearest_finite);
        self.gather_near((body, geom), &around, heights, &mut near);
        // An edge does not catch a falling hemisphere.
        let may_hold = walker.floor.is_some() || walker.ledge.is_some();
        let edges = if may_hold { soles + STAND_DISTANCE } else { f32::MIN };
        let held_by = RefCell::new(std::mem::take(&mut near.held_by));
        let step = StepContext {
            body,
            near: &near,
            held_by: &held_by,
            geom,
            footprint,
            soles,
            knees,
            head,
            place,
            velocity,
            min_up,
            edges,
            is_on_stairs: false,
            dt,
            pace,
        };
        let velocity = self.next_velocity(&step, walker, wish);
        near.held_by = held_by.into_inner();
        near.held_by.drain(..).for_each(|footing| self.world.footings.queue(footing));
        self.near = near;
        walker.told = nearest_finite(velocity.y);
        if let Some(mut view) = self.body_mut(body) {
            view.set_velocity3d(velocity);
        }
    }

    fn next_velocity(
        &mut self,
        step: &StepContext<'_>,
        walker: &mut CharacterController,
        wish: MoveInput,
    ) -> Vector3 {
        let StepContext { place, dt, .. } = *step;
        self.ledge_climb_end(step, walker);
        let floor = self.current_floor(step, walker, wish);
        walker.aloft = if floor.is_some() { 0.0 } else { nearest_finite(walker.aloft + dt) };
        walker.has_jumped &= floor.is_none();
        if let Some(floor) = &floor {
            let place = Vector3::new(place.x, floor.height, place.z);
            walker.carried = self.velocity_of(floor.partner, place) / step.pace;
            walker.carried = walker.carried.map(nearest_finite);
            step.record_support(floor.partner, Vector3::y(), floor.height);
        }
        walker.ledge = walker.ledge.filter(|_| floor.is_none());
        let may_jump = walker.aloft <= walker.walk.coyote_time && !walker.has_jumped;
        match floor {
            _ if wish.jump && may_jump => self.jump_velocity(step, walker, wish),
            Some(floor) => self.ground_velocity(step, walker, wish, floor),
            None => match self.ledge_hang(step, walker, wish) {
                Some(velocity) => {
                    walker.floor = None;
                    velocity
                }
                None => self.air_velocity(step, walker, wish),
            },
        }
    }

    /// Returns the floor that supports the character before this step; `None` in the air. If the character stood in the last
    /// step and was not thrown up since, the gap to the floor may be as long as the snap distance.
    fn current_floor(
        &self,
        step: &StepContext<'_>,
        walker: &CharacterController,
        wish: MoveInput,
    ) -> Option<GroundHit> {
        let floor = self.probe_ground(&step.footprint, &step.reach(MAX_LANDING_DEPTH))?;
        let gap = step.soles - step.height_on(&floor);
        let below = self.velocity_of(floor.partner, step.place).y / step.pace;
        let kick = (2.0 * self.gravity_on(step.body, walker).norm() * walker.walk.snap).sqrt();
        let is_thrown = step.velocity.y > walker.told.max(below) + kick;
        let stood = walker.floor.is_some();
        let stands = if stood {
            let is_lifted = || gap <= max_lift(walker) && self.is_over_curb(step, walker, wish, &floor);
            !is_thrown && (gap <= snap_distance(walker) || is_lifted())
        } else {
            gap <= STAND_DISTANCE && step.velocity.y <= below + kick.min(1.0)
        };
        stands.then_some(floor)
    }

    /// Returns whether the character was lifted over a curb that it reaches in the next two steps. Such a character stands,
    /// however far its old floor is below its soles.
    fn is_over_curb(
        &self,
        step: &StepContext<'_>,
        walker: &CharacterController,
        wish: MoveInput,
        floor: &GroundHit,
    ) -> bool {
        let swept = step.footprint.flat().swept(look_ahead(step, walker, (step.velocity, LIFT_STEPS), wish));
        let reach = ProbeLimits { but: Some(floor.partner), ..step.reach(STAND_DISTANCE) };
        let curb = self.probe_ground(&swept, &reach);
        curb.is_some_and(|curb| step.soles - curb.height <= EDGE_CLEARANCE + STAND_DISTANCE)
    }

    /// Returns whether a stair within step height lies under the footprint or within `STAIR_MARGIN` of it.
    fn is_over_stair(&self, step: &StepContext<'_>, walker: &CharacterController, floor: &GroundHit) -> bool {
        let from = step.height_on(floor);
        let reach = ProbeLimits { highest: from + SOLE_CLEARANCE + walker.walk.step_up, ..step.reach(0.0) };
        let footprint = step.footprint.flat().widened(STAIR_MARGIN);
        self.probe_ground(&footprint, &reach)
            .is_some_and(|stair| stair.height > floor.height + SOLE_CLEARANCE)
    }

    /// Gravity on the body in the air, px/s², (along X, down).
    fn gravity_on(&self, body: BodyId, walker: &CharacterController) -> Vector2 {
        let is_pulled = |body: &&Body| walker.is_held || !body.ignore_gravity();
        self.gravity() * self.core.body(body).filter(is_pulled).map_or(0.0, Body::gravity_scale)
    }

    /// Switches gravity off for a standing character, which velocities alone move along the floor: normal impulses would cause
    /// friction. A body that ignored gravity before keeps this setting.
    pub(super) fn suspend_gravity(&mut self, body: BodyId, walker: &mut CharacterController, holds: bool) {
        let Some(mut view) = self.body_mut(body) else { return };
        if holds && !view.ignore_gravity() {
            view.set_ignore_gravity(true);
            walker.is_held = true;
        } else if !holds && std::mem::take(&mut walker.is_held) {
            view.set_ignore_gravity(false);
        }
    }

    pub(super) fn jump_velocity(
        &mut self,
        step: &StepContext<'_>,
        walker: &mut CharacterController,
        wish: MoveInput,
    ) -> Vector3 {
        (walker.floor, walker.has_jumped) = (None, true);
        self.suspend_gravity(step.body, walker, false);
        let level = self.level_velocity(step, walker, wish, walker.walk.air_acceleration);
        let start = (2.0 * self.gravity_on(step.body, walker).y.max(0.0) * walker.walk.jump_height).sqrt();
        let velocity = Vector3::new(level.x, start + walker.carried.y, level.z);
        self.stop_at_walls(step, velocity, |_| true)
    }

    fn air_velocity(
        &mut self,
        step: &StepContext<'_>,
        walker: &mut CharacterController,
        wish: MoveInput,
    ) -> Vector3 {
        let has_left = walker.floor.take().is_some();
        self.suspend_gravity(step.body, walker, false);
        // A character that slides down a steep slope gets no acceleration by input.
        let acceleration = if step.is_held_up() { 0.0 } else { walker.walk.air_acceleration };
        let mut velocity = self.level_velocity(step, walker, wish, acceleration);
        if has_left && step.velocity.y <= walker.told {
            // The character leaves an edge without the upward velocity of the slope that led to it.
            velocity.y = velocity.y.min(walker.carried.y.max(0.0));
        }
        self.stop_at_walls(step, velocity, |_| true)
    }

    /// Velocity after accelerating towards the input for this step, px/s; Y is unchanged.
    fn level_velocity(
        &self,
        step: &StepContext<'_>,
        walker: &CharacterController,
        wish: MoveInput,
        acceleration: f32,
    ) -> Vector3 {
        let aim = Vector2::new(walker.carried.x + wish.x, walker.carried.z + wish.z);
        let now = Vector2::new(step.velocity.x, step.velocity.z);
        let (missing, most) = (aim - now, acceleration * step.dt);
        let size = missing.norm();
        let next = if size > most { now + missing * (most / size) } else { aim };
        Vector3::new(nearest_finite(next.x), step.velocity.y, nearest_finite(next.y))
    }

    fn ground_velocity(
        &mut self,
        step: &StepContext<'_>,
        walker: &mut CharacterController,
        wish: MoveInput,
        floor: GroundHit,
    ) -> Vector3 {
        walker.floor = Some(floor.partner);
        // Heights are measured from the floor, since the soles may be above an edge already.
        let knees = step.height_on(&floor) + SOLE_CLEARANCE + walker.walk.step_up.max(STAND_DISTANCE);
        let step = &StepContext { knees, ..*step };
        let level = self.level_velocity(step, walker, wish, walker.walk.acceleration);
        let is_wall = |touch: &DepthContact| self.is_fixed(partner_of(touch, step.geom));
        let curb = self.curb_ahead(step, (walker, LIFT_STEPS), level, wish, (&floor, &step.near.refused));
        let asked = self.curb_ahead(step, (walker, FILTER_STEPS), level, wish, (&floor, &[]));
        asked.into_iter().for_each(|curb| step.record_support(curb.partner, Vector3::y(), curb.height));
        // A curb counts as a wall until the soles are above it. The lift is complete before the character
        // reaches it.
        let knees = match step.footprint.ball() {
            Some(ball) => {
                let knees = step.knees + floor.sole_offset(ball.radius);
                // The next stair is higher than this one.
                curb.as_ref().map_or(knees, |curb| knees.max(curb.height))
            }
            None if curb.is_some() => step.soles + STAND_DISTANCE,
            None => step.knees,
        };
        let is_on_stairs = step.footprint.ball().is_some() && self.is_over_stair(step, walker, &floor);
        let mut velocity = self.stop_at_walls(&StepContext { knees, is_on_stairs, ..*step }, level, is_wall);
        let height = match curb {
            Some(curb) => curb.height,
            None => self.height_ahead(step, walker, velocity, &floor) + clearance(step, &floor),
        };
        velocity.y = walker.carried.y + (height - step.soles) / step.dt;
        self.apply_weight(step, walker, floor.partner);
        self.suspend_gravity(step.body, walker, true);
        velocity
    }

    /// Returns the curb that the character reaches within `steps` steps, with the height in px of the lift over the edge of the
    /// curb; `None` if it reaches no curb. If the character reaches a stair within this step, the next stair is measured from
    /// the reached one. Otherwise a character that moves half a tread per step would stop at every other edge.
    fn curb_ahead(
        &self,
        step: &StepContext<'_>,
        (walker, steps): (&CharacterController, f32),
        velocity: Vector3,
        wish: MoveInput,
        (floor, refused): (&GroundHit, &[ContactTarget]),
    ) -> Option<GroundHit> {
        let way = look_ahead(step, walker, (velocity, steps), wish);
        let next = (velocity - walker.carried) * step.dt;
        let highest = |from: f32| from + SOLE_CLEARANCE + walker.walk.step_up;
        let from = step.height_on(floor);
        let reach = ProbeLimits { highest: highest(from), refused, edges: highest(from), ..step.reach(0.0) };
        let first = self.curb_within(step, &reach, floor, [next, way]);
        let stair = self.probe_ground(&step.footprint.flat().swept(next), &reach);
        let stair = stair.filter(|stair| stair.height > from + SOLE_CLEARANCE && stair.height <= step.soles);
        let second = stair.and_then(|stair| {
            let highest = highest(stair.height);
            self.curb_within(step, &ProbeLimits { highest, edges: highest, ..reach }, floor, [next, way])
        });
        second.or(first)
    }

    /// Returns a curb within the path that is higher than the current floor, with the height in px of the lift over the edge of
    /// the curb; `None` if there is no curb.
    fn curb_within(
        &self,
        step: &StepContext<'_>,
        reach: &ProbeLimits<'_>,
        floor: &GroundHit,
        ways: [Vector3; 2],
    ) -> Option<GroundHit> {
        if let Some(ball) = step.footprint.ball() {
            return self.rise_within(step, reach, ways, ball.radius);
        }
        let reach = ProbeLimits { but: Some(floor.partner), ..*reach };
        let curb = self.probe_ground(&step.footprint.swept(ways[1]), &reach)?;
        let over = GroundHit { height: curb.height + EDGE_CLEARANCE, ..curb };
        let here = self.height_of(curb.partner, &step.footprint, &reach);
        let is_ahead = here.is_none_or(|here| here < curb.height - SOLE_CLEARANCE);
        (is_ahead && over.height > floor.height + SOLE_CLEARANCE).then_some(over)
    }

    /// Returns an edge or slope within the path that lifts a hemisphere higher than the current contact does, with the height
    /// in px of the lift; `None` if there is none. Edges lift a hemisphere as they lift flat soles, because the rolling path
    /// over an edge starts steep. At the foot of a slope the lift is the height of the ground at `ways[0]`, or the height to
    /// which the current contact leads there if that is greater.
    fn rise_within(
        &self,
        step: &StepContext<'_>,
        reach: &ProbeLimits<'_>,
        ways: [Vector3; 2],
        radius: f32,
    ) -> Option<GroundHit> {
        let here = self.probe_ground(&step.footprint, reach)?;
        let ahead_of = |way: Vector3| {
            let ahead = self.probe_ground(&step.footprint.moved(way), reach);
            // An edge limits the height that it leads to.
            (ahead, here.height_along(way).min(here.edge.unwrap_or(f32::MAX)))
        };
        let [next, then] = ways.map(ahead_of);
        let foot = next.0.map_or(next.1, |floor| floor.height.max(next.1));
        let rise = |(ahead, along): (Option<GroundHit>, f32), foot: Option<f32>| {
            let ahead = ahead.filter(|ahead| ahead.height > along + SOLE_CLEARANCE)?;
            let height = ahead.edge.or(foot)?;
            (height <= reach.edges).then_some(GroundHit { height: height + EDGE_CLEARANCE, ..ahead })
        };
        let ends = [next, then].into_iter().filter_map(|found| rise(found, Some(foot)));
        // An edge may lie between the two places, farther than a radius from both.
        let parts = (ways[1].norm() / (PROBE_SPACING * radius)).ceil().min(MAX_PROBES) as usize;
        let between = (1..parts).filter_map(|at| rise(ahead_of(ways[1] * (at as f32 / parts as f32)), None));
        ends.chain(between).reduce(|highest, rise| if rise.height > highest.height { rise } else { highest })
    }

    /// Height of the floor after this step, px. The descent to a lower floor starts when no part of the footprint is above the
    /// higher floor.
    fn height_ahead(
        &self,
        step: &StepContext<'_>,
        walker: &CharacterController,
        velocity: Vector3,
        floor: &GroundHit,
    ) -> f32 {
        let way = (velocity - walker.carried) * step.dt;
        let reach = ProbeLimits { highest: step.knees, ..step.reach(0.0) };
        let next = self.probe_ground(&step.footprint.moved(way), &reach);
        let next = next.filter(|next| step.soles - step.height_on(next) <= snap_distance(walker));
        if step.footprint.ball().is_some() {
            // A path no steeper than the current contact does not press on it.
            let along = floor.height_along(way).min(floor.edge.unwrap_or(f32::MAX));
            return next.map_or(step.height_on(floor), |next| step.height_at(&next, floor).max(along));
        }
        let here = self.probe_ground(
            &step.footprint.swept(way).widened(EDGE_PASS_DISTANCE),
            &step.reach(STAND_DISTANCE),
        );
        match (next, here) {
            (Some(next), Some(here)) if next.partner != here.partner => next.height.max(here.height),
            (Some(next), _) => next.height,
            (None, _) => floor.height,
        }
    }

    pub(super) fn is_fixed(&self, partner: Option<ContactTarget>) -> bool {
        match partner {
            Some(ContactTarget::Geom(geom)) => {
                let body = self.core.geom(geom).and_then(|geom| self.core.body(geom.body()));
                body.is_some_and(|body| body.is_static() || body.is_kinematic())
            }
            _ => true,
        }
    }

    /// Applies the weight of the character to the body that it stands on. The character itself ignores
    /// gravity.
    fn apply_weight(&mut self, step: &StepContext<'_>, walker: &CharacterController, floor: ContactTarget) {
        let (ContactTarget::Geom(geom), Some(body)) = (floor, self.core.body(step.body)) else { return };
        let weight = self.gravity_on(step.body, walker) * (body.mass() * step.pace);
        let Some(outline) = self.geom(geom) else { return };
        // The force acts in the middle of the common X extent, so that it does not tip the supporting body.
        let (whole, footprint) = (outline.virtual_geom(), &step.footprint);
        let x = 0.5 * (whole.left.max(footprint.left) + whole.right.min(footprint.right));
        let below = Some(outline.body());
        let below = below.and_then(|below| self.body_mut(below)).filter(|view| !view.is_static());
        if let Some(mut view) = below.filter(|_| weight.iter().all(|part| part.is_finite())) {
            let soles = Vector2::new(x, -step.soles);
            view.core_mut().apply_force_at_world_point(weight, soles);
        }
    }
}

/// Greatest gap between sole and floor for a standing character to be put down on the floor, px. It includes
/// the clearances above floor and edge.
fn snap_distance(walker: &CharacterController) -> f32 {
    walker.walk.snap + SOLE_CLEARANCE + EDGE_CLEARANCE
}

/// Greatest height in px that the character is lifted above the floor to pass over a curb.
fn max_lift(walker: &CharacterController) -> f32 {
    walker.walk.step_up + SOLE_CLEARANCE + EDGE_CLEARANCE + STAND_DISTANCE
}

/// Returns the displacement of the character relative to its floor in `steps` steps at a velocity, plus `LOOK_AHEAD_DISTANCE`
/// along the input, in px.
fn look_ahead(
    step: &StepContext<'_>,
    walker: &CharacterController,
    (velocity, steps): (Vector3, f32),
    wish: MoveInput,
) -> Vector3 {
    let wished = Vector3::new(wish.x, 0.0, wish.z);
    let ahead = wished * (LOOK_AHEAD_DISTANCE / wished.norm().max(f32::MIN_POSITIVE));
    (velocity - walker.carried) * (steps * step.dt) + ahead
}

/// Distance from the footprint up to which floors are probed in a step, px.
fn probe_distance(walker: &CharacterController, velocity: Vector3, dt: f32) -> f32 {
    let CharacterController { walk, carried, .. } = walker;
    let fastest = velocity.norm() + carried.norm() + walk.acceleration.max(walk.air_acceleration) * dt;
    let reaches = if walk.ledge_reach > 0.0 { GRAB_DISTANCE } else { 0.0 };
    nearest_finite(FILTER_STEPS * dt * fastest + LOOK_AHEAD_DISTANCE + 1.0 + reaches)
}

/// Gap between sole and floor after this step, px.
fn clearance(step: &StepContext<'_>, floor: &GroundHit) -> f32 {
    let gap = step.soles - floor.edge.unwrap_or(floor.height);
    let was_lifted = gap <= EDGE_CLEARANCE + SOLE_CLEARANCE;
    if was_lifted { SOLE_CLEARANCE.max(gap - SETTLE_SPEED * step.dt) } else { SOLE_CLEARANCE }
}
