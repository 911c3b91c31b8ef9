//! One move: what carries and pushes the mover, and what its player wants.

use super::super::convex::{Point, dot, minus, plus, point, scaled, vector};
use super::super::filter::QueryFilter;
use super::obstacles::{Kind, MoverHit, Obstacles, Passable, SKIN_SLACK, first_touch};
use super::shape::MoverShape;
use super::{CharacterMover, Ground, MoverInput, MoverOptions, MoverReport, MoverState, MoverTouch};
use crate::body::BodyId;
use crate::geom::GeomId;
use crate::math::Vector2;
use crate::math::scalar::{nearest_finite, sin_cos_of_any};
use crate::simulator::PhysicsSimulator;

/// Maximum number of pushes out of obstacles in a move, a count. Between two walls two are needed.
const MAX_PUSHES: usize = 8;
/// Time added to coyote time and jump buffer, as a fraction of the step: rounding of sums of steps.
const TIME_SLACK: f32 = 1e-3;

/// A move of a mover.
pub(super) struct Step<'a> {
    pub(super) options: MoverOptions,
    pub(super) state: MoverState,
    pub(super) input: MoverInput,
    /// Time step in s.
    pub(super) dt: f64,
    pub(super) simulator: &'a mut PhysicsSimulator,
    pub(super) shape: &'a mut MoverShape,
    pub(super) obstacles: &'a mut Obstacles,
    body: Option<BodyId>,
    /// Position in length units.
    pub(super) at: Point,
    /// Velocity relative to `carried`, in length units/s.
    pub(super) velocity: Point,
    /// Mean of the velocity along X in this move, in length units/s.
    pub(super) mean_speed: f64,
    /// Velocity of the ground, or of the last one, in length units/s.
    pub(super) carried: Point,
    /// The ground that the mover stands on now.
    pub(super) ground: Option<MoverTouch>,
    /// Whether the mover stood before this move.
    pub(super) stood: bool,
    /// Gap to obstacles, in length units.
    pub(super) skin: f64,
    /// Least upward component of a ground's normal, dimensionless.
    pub(super) min_up: f64,
    /// Gravity along Y, in length units/s².
    pub(super) gravity: f64,
    /// Impulse with which dynamic bodies may be pushed in this move, in mass units · length units/s.
    pub(super) push_left: f64,
    pub(super) report: MoverReport,
}

impl<'a> Step<'a> {
    pub(super) fn new(
        mover: &'a mut CharacterMover,
        simulator: &'a mut PhysicsSimulator,
        input: MoverInput,
        dt: f32,
    ) -> Self {
        let CharacterMover { options, state, body, ref mut shape, ref mut obstacles } = *mover;
        obstacles.clear();
        let dt = f64::from(dt);
        Step {
            options,
            state,
            input,
            dt,
            skin: shape.skin(state.position),
            min_up: options.min_up(),
            gravity: f64::from(simulator.gravity().y) * f64::from(options.gravity_scale),
            push_left: f64::from(options.push_force) * dt,
            simulator,
            shape,
            obstacles,
            body,
            at: point(state.position),
            velocity: point(state.velocity),
            mean_speed: 0.0,
            carried: point(state.carried),
            ground: None,
            stood: false,
            report: MoverReport::default(),
        }
    }

    /// Moves the mover with its ground, as that has moved in the last update.
    pub(super) fn ride(&mut self) {
        let Some(ground) = self.state.ground else { return };
        let lies = self.simulator.geom(ground.geom).is_some();
        let Some(body) = self.simulator.body(ground.body).filter(|body| lies && body.enabled()) else {
            return;
        };
        let turn = body.total_rotation() - ground.rotation;
        let (sine, cosine) = sin_cos_of_any(turn);
        let turned = |v: Vector2| {
            let ([x, y], [s, c]) = (point(v), [sine, cosine].map(f64::from));
            [c * x - s * y, s * x + c * y]
        };
        let (is_fixed, position) = (body.is_static(), body.position());
        let contact = plus(point(position), turned(ground.point - ground.position));
        let normal = turned(ground.normal);
        let belt = self.belt_velocity(ground.geom, normal);
        self.carried = plus(self.velocity_of(ground.body, contact), belt);
        let way = match is_fixed {
            // A belt.
            true => scaled(self.carried, self.dt),
            false => plus(minus(contact, point(ground.point)), scaled(belt, self.dt)),
        };
        let normal = vector(normal);
        let geom = ground.geom;
        self.ground = Some(MoverTouch { geom, body: ground.body, point: vector(contact), normal });
        self.stood = true;
        self.glide(way, (!is_fixed).then_some(ground.body));
    }

    /// Pushes the mover out of what has moved into it, and pushes dynamic bodies out of the mover.
    pub(super) fn push_out(&mut self) {
        let at = self.at;
        self.cover(at, [0.0; 2]);
        for index in 0..self.obstacles.all().len() {
            self.yield_to(index);
        }
        for _ in 0..MAX_PUSHES {
            let Some((index, depth, normal)) = self.deepest(SKIN_SLACK * self.skin) else { return };
            let (body, kind) = (self.obstacles.all()[index].body, self.obstacles.all()[index].kind);
            let from = self.at;
            self.glide(scaled(normal, depth), Some(body));
            if kind == Kind::Dynamic {
                self.push_body(body, vector(from), normal.map(|part| -part), depth / self.dt);
            }
        }
        let left = self.deepest(self.skin).map(|(index, ..)| &self.obstacles.all()[index]);
        self.report.crushed_by = left.filter(|obstacle| obstacle.kind != Kind::Dynamic).map(|o| o.body);
    }

    /// Moves out of the way of a body that has moved in the last update, by as much as it has moved along the normal of its
    /// touch.
    fn yield_to(&mut self, index: usize) {
        let obstacle = &self.obstacles.all()[index];
        if obstacle.kind == Kind::Fixed {
            return;
        }
        let at = vector(self.at);
        let velocity = self.simulator.body(obstacle.body).map(|body| body.get_velocity_at_world_point(at));
        let way = scaled(point(velocity.unwrap_or_default()), self.dt);
        let body = obstacle.body;
        let is_ground = self.ground.is_some_and(|ground| ground.body == body);
        if is_ground || way == [0.0; 2] {
            return;
        }
        let from = plus(self.at, way);
        let back = way.map(|part| -part);
        let passable = self.passable(None);
        let Some(hit) = first_touch(self.shape, from, back, self.skin, obstacle, passable) else { return };
        let amount = dot(way, hit.normal) * (1.0 - hit.fraction);
        if amount > 0.0 {
            self.glide(scaled(hit.normal, amount), Some(body));
            self.touch(&hit);
        }
    }

    /// The obstacle that the mover with its skin is deepest in, deeper than `least` length units: index, depth, and normal to
    /// the mover.
    fn deepest(&mut self, least: f64) -> Option<(usize, f64, Point)> {
        let at = self.at;
        self.cover(at, [0.0; 2]);
        let mut deepest: Option<(usize, f64, Point)> = None;
        for (index, obstacle) in self.obstacles.all().iter().enumerate() {
            if !obstacle.is_solid_for(self.shape, at) {
                continue;
            }
            let gap = self.shape.gap(at, &obstacle.shape);
            let depth = self.skin - gap.distance;
            if depth > deepest.map_or(least, |(_, depth, _)| depth) {
                deepest = Some((index, depth, gap.normal.map(|part| -part)));
            }
        }
        deepest
    }

    /// Turns input into velocity: walking, and jumping.
    pub(super) fn steer(&mut self) {
        let (dt, slack) = (self.dt as f32, TIME_SLACK * self.dt as f32);
        self.state.since_press = nearest_finite(self.state.since_press + dt);
        if self.input.jump && !self.state.is_held {
            self.state.since_press = 0.0;
        }
        self.state.is_held = self.input.jump;
        self.state.aloft = if self.stood { 0.0 } else { nearest_finite(self.state.aloft + dt) };
        let acceleration = if self.stood { self.options.acceleration } else { self.options.air_acceleration };
        let largest = f64::from(acceleration) * self.dt;
        let lack = f64::from(self.input.x) - self.velocity[0];
        let gain = lack.clamp(-largest, largest);
        self.velocity[0] += gain;
        self.mean_speed = self.velocity[0] - 0.5 * gain;
        let may_jump = self.state.aloft <= self.options.coyote_time + slack;
        if may_jump && self.state.since_press <= self.options.jump_buffer + slack {
            let height = f64::from(self.options.jump_height);
            self.velocity[1] = -(2.0 * self.gravity.max(0.0) * height).sqrt();
            (self.state.aloft, self.state.since_press, self.state.is_rising) = (f32::MAX, f32::MAX, true);
            (self.ground, self.report.jumped) = (None, true);
        } else if self.input.drop && self.ground.is_some_and(|ground| self.is_one_way(&ground)) {
            let soles = self.soles() as f32;
            (self.state.aloft, self.state.drop_level) = (f32::MAX, Some(soles));
            self.ground = None;
        }
        if self.state.is_rising && self.velocity[1] >= 0.0 {
            self.state.is_rising = false;
        }
        if self.state.is_rising && !self.input.jump {
            self.velocity[1] *= f64::from(self.options.jump_cut);
            self.state.is_rising = false;
        }
    }

    fn is_one_way(&self, ground: &MoverTouch) -> bool {
        self.simulator.geom(ground.geom).is_some_and(|geom| geom.one_way().is_some())
    }

    /// State and report after the move.
    pub(super) fn finish(mut self) -> (MoverState, MoverReport) {
        if self.ground.is_none() {
            // In the air the ground's motion along X stays, and that along Y is the mover's own.
            self.velocity[1] += self.carried[1];
            self.carried[1] = 0.0;
        }
        if self.state.drop_level.is_some_and(|level| self.soles() > f64::from(level) + 4.0 * self.skin)
            || self.ground.is_some()
        {
            self.state.drop_level = None;
        }
        let of = |v: Point| vector(v).map(nearest_finite);
        let state = &mut self.state;
        (state.position, state.velocity, state.carried) = (of(self.at), of(self.velocity), of(self.carried));
        let simulator = &*self.simulator;
        state.ground = self.ground.and_then(|MoverTouch { geom, body, point, normal }| {
            let owner = simulator.body(body)?;
            let (position, rotation) = (owner.position(), owner.total_rotation());
            Some(Ground { geom, body, point, normal, position, rotation })
        });
        self.report.ground = self.ground;
        self.report.landed = !self.stood && self.ground.is_some();
        self.press_ground();
        (self.state, self.report)
    }

    /// Height of the lowest point, in length units, y down.
    pub(super) fn soles(&self) -> f64 {
        self.shape.bounds(self.at)[3]
    }

    pub(super) fn passable(&self, body: Option<BodyId>) -> Passable {
        let one_way_above = self.state.drop_level.map(|level| f64::from(level) + 2.0 * self.skin);
        Passable { body, one_way_above }
    }

    /// Gathers the obstacles on a straight way.
    pub(super) fn cover(&mut self, from: Point, way: Point) {
        let (start, end) = (self.shape.bounds(from), self.shape.bounds(plus(from, way)));
        let reach = 2.0 * self.skin + f64::from(self.options.step_up).max(f64::from(self.options.snap));
        let bounds = [
            start[0].min(end[0]) - reach,
            start[1].min(end[1]) - reach,
            start[2].max(end[2]) + reach,
            start[3].max(end[3]) + reach,
        ];
        let filter = QueryFilter {
            categories: self.options.categories,
            as_categories: self.options.as_categories,
            exclude_body: self.body,
            ..QueryFilter::default()
        };
        self.obstacles.cover(self.simulator, bounds, &filter);
    }

    /// The first obstacle on a straight way from the present place.
    pub(super) fn cast(&mut self, way: Point, but: Option<BodyId>) -> Option<MoverHit> {
        let from = self.at;
        self.cover(from, way);
        let passable = self.passable(but);
        self.obstacles.cast(self.shape, from, way, self.skin, passable)
    }

    /// The velocity of the surface of a geom relative to its body, where it has the outward unit `normal`, in length units/s.
    fn belt_velocity(&self, geom: GeomId, [x, y]: Point) -> Point {
        let speed = self.simulator.geom(geom).map_or(0.0, |_| self.simulator[geom].surface().speed);
        scaled([-y, x], f64::from(speed))
    }

    /// The velocity of the ground at a hit, in length units/s.
    pub(super) fn ground_velocity(&self, hit: &MoverHit) -> Point {
        plus(self.velocity_of(hit.body, hit.point), self.belt_velocity(hit.geom, hit.normal))
    }

    /// Velocity of a body at a point, in length units/s.
    pub(super) fn velocity_of(&self, body: BodyId, at: Point) -> Point {
        let body = self.simulator.body(body);
        point(body.map(|body| body.get_velocity_at_world_point(vector(at))).unwrap_or_default())
    }
}
