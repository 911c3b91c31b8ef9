//! The motion of a mover by its own velocity: along the ground, over steps, and through the air.

use super::super::convex::{Point, dot, minus, plus, scaled, vector};
use super::MoverTouch;
use super::obstacles::{Kind, MoverHit};
use super::step::Step;
use crate::body::BodyId;
use crate::math::Vector2;

/// Maximum number of surfaces along which a mover slides in one move, a count. Corners need two; rows of short edges more.
const MAX_SLIDES: usize = 8;
/// Distance from a contact within which a face belongs to it, as a ratio to the skin: the contact and the face each have one.
const FACE_REACH_SKINS: f64 = 2.0;

impl Step<'_> {
    /// Moves by the velocity of the mover.
    pub(super) fn travel(&mut self) {
        match self.ground {
            Some(ground) => {
                self.velocity[1] = 0.0;
                let x = self.mean_speed * self.dt;
                self.walk(along([f64::from(ground.normal.x), f64::from(ground.normal.y)], x));
            }
            None => self.fly(),
        }
        if let Some(before) = self.ground.take() {
            self.settle(&before);
        }
    }

    /// Moves by a way and slides along what is in it.
    pub(super) fn glide(&mut self, way: Point, but: Option<BodyId>) {
        let mut rest = way;
        let mut last: Option<Point> = None;
        for _ in 0..MAX_SLIDES {
            let Some(hit) = self.advance(&mut rest, but) else { return };
            rest = slid(rest, hit.normal, &mut last);
        }
    }

    /// Moves to the first obstacle on the way, and shortens the way to its rest. Returns `None` at the end of the way.
    fn advance(&mut self, rest: &mut Point, but: Option<BodyId>) -> Option<MoverHit> {
        if *rest == [0.0; 2] {
            return None;
        }
        let Some(hit) = self.cast(*rest, but) else {
            self.at = plus(self.at, *rest);
            return None;
        };
        self.at = plus(self.at, scaled(*rest, hit.fraction));
        *rest = scaled(*rest, 1.0 - hit.fraction);
        Some(hit)
    }

    /// Moves along the ground. Slopes do not shorten the way along X.
    fn walk(&mut self, way: Point) {
        let mut rest = way;
        for _ in 0..MAX_SLIDES {
            let Some(hit) = self.advance(&mut rest, None) else { return };
            if -hit.normal[1] >= self.min_up {
                rest = along(hit.normal, rest[0]);
                continue;
            }
            match self.step_over(rest[0]) {
                Some(done) => rest = [rest[0] - done, 0.0],
                None => {
                    self.touch(&hit);
                    self.stop_at(&hit);
                    return;
                }
            }
        }
    }

    /// Steps up an edge: up, on along X by up to `x`, and down. Returns the way along X; `None`, without a motion, where there
    /// is no ground or no room.
    fn step_over(&mut self, x: f64) -> Option<f64> {
        let start = self.at;
        let height = f64::from(self.options.step_up);
        let done =
            self.try_step(height + self.skin, x).filter(|_| start[1] - self.at[1] <= height + self.skin);
        if done.is_none() {
            self.at = start;
        }
        done
    }

    fn try_step(&mut self, height: f64, x: f64) -> Option<f64> {
        let start = self.at;
        let fraction = |hit: Option<MoverHit>| hit.map_or(1.0, |hit| hit.fraction);
        let up = [0.0, -height];
        self.at = plus(start, scaled(up, fraction(self.cast(up, None))));
        let done = x * fraction(self.cast([x, 0.0], None));
        self.at[0] += done;
        let down = [0.0, start[1] - self.at[1] + self.skin];
        let hit = self.cast(down, None)?;
        self.at = plus(self.at, scaled(down, hit.fraction));
        self.support(&hit, self.shape.bounds(start)[3])?;
        (done != 0.0).then_some(done)
    }

    /// The normal of the ground that a contact is on; `None` if it is no ground. An edge within step height above `soles`, a
    /// height in length units, y down, is ground by the face beside it.
    fn support(&self, hit: &MoverHit, soles: f64) -> Option<Point> {
        if -hit.normal[1] >= self.min_up {
            return Some(hit.normal);
        }
        let lowest = soles - f64::from(self.options.step_up) - FACE_REACH_SKINS * self.skin;
        if hit.normal[1] >= 0.0 || hit.point[1] < lowest {
            return None;
        }
        let reach = FACE_REACH_SKINS * self.skin;
        let faces = self.obstacles.all().iter().flat_map(|near| near.shape.normals_at(hit.point, reach));
        faces
            .filter(|normal| -normal[1] >= self.min_up)
            .reduce(|best, n| if n[1] < best[1] { n } else { best })
    }

    /// Brings a mover that stands, or has just landed, down to the ground; without any, it begins to fall from `before`.
    fn settle(&mut self, before: &MoverTouch) {
        let down = [0.0, f64::from(self.options.snap) + 2.0 * self.skin];
        let hit = self.cast(down, None);
        let support = hit.and_then(|hit| {
            let soles = plus(self.at, scaled(down, hit.fraction));
            let former = std::mem::replace(&mut self.at, soles);
            let normal = self.support(&hit, self.soles());
            if normal.is_none() {
                self.at = former;
            }
            Some((hit, normal?))
        });
        let Some((hit, normal)) = support else {
            // It flies on along the slope.
            let normal = [f64::from(before.normal.x), f64::from(before.normal.y)];
            self.velocity[1] = along(normal, self.velocity[0])[1];
            return;
        };
        self.ground = Some(touch_of(&hit, normal));
        let velocity = self.ground_velocity(&hit);
        self.velocity[0] += self.carried[0] - velocity[0];
        self.carried = velocity;
    }

    /// Moves through the air, until it lands.
    fn fly(&mut self) {
        let fall = [0.0, 0.5 * self.gravity * self.dt * self.dt];
        let mut rest = plus(scaled([self.mean_speed, self.velocity[1]], self.dt), fall);
        if !self.stood {
            // The ground has carried a mover that stood.
            rest = plus(rest, scaled(self.carried, self.dt));
        }
        self.velocity[1] += self.gravity * self.dt;
        let mut last: Option<Point> = None;
        for _ in 0..MAX_SLIDES {
            let Some(hit) = self.advance(&mut rest, None) else { return };
            if -hit.normal[1] >= self.min_up && self.lands_on(&hit) {
                return self.walk(along(hit.normal, rest[0]));
            }
            self.touch(&hit);
            self.stop_at(&hit);
            rest = slid(rest, hit.normal, &mut last);
        }
    }

    /// Lands on a ground, unless the mover rises from it.
    fn lands_on(&mut self, hit: &MoverHit) -> bool {
        let ground = self.ground_velocity(hit);
        let speed = self.velocity[1] + self.carried[1] - ground[1];
        if speed < 0.0 {
            return false;
        }
        self.report.landing_speed = speed as f32;
        self.ground = Some(touch_of(hit, hit.normal));
        self.velocity = [self.velocity[0] + self.carried[0] - ground[0], 0.0];
        self.carried = ground;
        true
    }

    /// Takes from the velocity what goes into an obstacle, and pushes that if it is dynamic.
    fn stop_at(&mut self, hit: &MoverHit) {
        let other = self.velocity_of(hit.body, hit.point);
        let into = -dot(minus(plus(self.velocity, self.carried), other), hit.normal);
        if into <= 0.0 {
            return;
        }
        let gained = match hit.kind {
            Kind::Dynamic => self.push_body(hit.body, vector(hit.point), hit.normal.map(|part| -part), into),
            _ => 0.0,
        };
        let lost = into - gained;
        if self.ground.is_none() {
            self.velocity = plus(self.velocity, scaled(hit.normal, lost));
        } else if hit.normal[0] != 0.0 {
            // On the ground it moves along X alone.
            let most = self.velocity[0].abs() + (other[0] - self.carried[0]).abs();
            self.velocity[0] += (lost / hit.normal[0]).clamp(-most, most);
        }
    }

    /// Pushes a body at a point along a unit vector, so that it gains up to `speed` length units/s there, with what is left of
    /// the bounded impulse. Returns the gained speed.
    pub(super) fn push_body(&mut self, id: BodyId, at: Vector2, direction: Point, speed: f64) -> f64 {
        let Some(body) = self.simulator.body(id) else { return 0.0 };
        let arm = at - body.position();
        let lever = f64::from(arm.x) * direction[1] - f64::from(arm.y) * direction[0];
        let inverse =
            f64::from(body.inverse_mass()) + lever * lever * f64::from(body.inverse_moment_of_inertia());
        if inverse <= 0.0 {
            return 0.0;
        }
        let impulse = (speed / inverse).min(self.push_left);
        if impulse > 0.0 {
            self.push_left -= impulse;
            self.simulator[id].apply_impulse_at_world_point(vector(scaled(direction, impulse)), at);
        }
        impulse * inverse
    }

    /// Lets the weight of the mover act on a dynamic body that it stands on.
    pub(super) fn press_ground(&mut self) {
        let Some(ground) = self.ground else { return };
        let is_dynamic =
            self.simulator.body(ground.body).is_some_and(|body| !body.is_static() && !body.is_kinematic());
        let impulse = f64::from(self.options.mass) * self.gravity * self.dt;
        if is_dynamic && impulse > 0.0 {
            let amount = Vector2::new(0.0, impulse as f32);
            self.simulator[ground.body].apply_impulse_at_world_point(amount, ground.point);
        }
    }

    /// Reports a wall or a ceiling.
    pub(super) fn touch(&mut self, hit: &MoverHit) {
        let touch = Some(touch_of(hit, hit.normal));
        match hit.normal {
            [_, y] if y >= self.min_up => self.report.ceiling = touch,
            [_, y] if -y >= self.min_up => {}
            [x, _] if x > 0.0 => self.report.left = touch,
            _ => self.report.right = touch,
        }
    }
}

fn touch_of(hit: &MoverHit, normal: Point) -> MoverTouch {
    MoverTouch { geom: hit.geom, body: hit.body, point: vector(hit.point), normal: vector(normal) }
}

/// The way along a surface that goes by `x` along X. `normal` has an upward component.
fn along(normal: Point, x: f64) -> Point {
    [x, -x * normal[0] / normal[1]]
}

/// The rest of a way along a surface. In a corner, where it would go back into the surface before, it ends.
fn slid(rest: Point, normal: Point, last: &mut Option<Point>) -> Point {
    let slid = plus(rest, scaled(normal, -dot(rest, normal).min(0.0)));
    match last.replace(normal) {
        Some(before) if dot(slid, before) < 0.0 && dot(before, normal) < 0.0 => [0.0; 2],
        _ => slid,
    }
}
