//! A small beat-'em-up: a street with a hole, a belt, a pond, a lift, a door, thugs who chase, crates and balls to throw.
//!
//! The game is all here and knows no screen; [`Brawler::step`] takes what keys are down, whoever holds them.

use crate::Result;
use farseer_core::math::scalar::cos;
use twohalf::{
    BodyId, GeomId, Platform, PlatformId, TwoHalfPhysicsSimulator, Vector2, Vector3, Walk, Walker, Wish,
};
use twohalf_factories::{Ball, Figure, Prism, Thing, spawn, spawn_lane};

/// Updates per second.
pub const RATE: u32 = 120;
const DT: f32 = 1.0 / RATE as f32;
const GRAVITY: f32 = 900.0;
/// Direction of the Z axis on the screen, degrees.
pub(super) const ANGLE: i32 = 70;
pub(super) const HEIGHT: i32 = 400;

/// Front and back of the street.
pub(super) const LANE: [f32; 2] = [10.0, 150.0];
/// Height of the street, and of the terrace behind the lift.
pub(super) const STREET: f32 = 40.0;
pub(super) const TERRACE: f32 = 130.0;
/// From where to where along X: a hole, a belt that runs to the left, a pond, and the lift.
pub(super) const HOLE: [f32; 2] = [560.0, 640.0];
const BELT: [f32; 2] = [980.0, 1120.0];
pub(super) const POND: [f32; 2] = [1200.0, 1340.0];
pub(super) const LIFT: [f32; 2] = [1340.0, 1430.0];
pub(super) const WATER: f32 = 30.0;
const END: f32 = 2100.0;
const DOOR: f32 = 1640.0;

const FIGURE: [f32; 3] = [26.0, 56.0, 18.0];
const REACH: f32 = 30.0;
const THUGS: [[f32; 3]; 5] = [
    [420.0, STREET, 60.0],
    [800.0, STREET, 110.0],
    [880.0, STREET, 50.0],
    [1560.0, TERRACE, 60.0],
    [1600.0, TERRACE, 110.0],
];
const CRATES: [[f32; 3]; 6] = [
    [200.0, STREET, 90.0],
    [770.0, STREET, 110.0],
    [770.0, STREET + 30.0, 110.0],
    [900.0, STREET, 40.0],
    [1270.0, 40.0, 90.0],
    [1500.0, TERRACE, 90.0],
];
const BALLS: [[f32; 3]; 3] = [[320.0, STREET, 40.0], [1240.0, 60.0, 60.0], [1800.0, TERRACE, 80.0]];

/// What is held down, and what was pressed just now.
#[derive(Debug, Clone, Copy, Default)]
pub struct Keys {
    /// From -1, to the left, to 1.
    pub x: f32,
    /// From -1, to the front, to 1.
    pub z: f32,
    /// Jumps.
    pub jump: bool,
    /// Strikes.
    pub punch: bool,
    /// Lifts what is near, or throws what is held; only in the step in which it was pressed.
    pub grab: bool,
}

/// Somebody who walks and strikes. The first one is the player's.
#[derive(Debug, Clone)]
pub(super) struct Fighter {
    pub(super) body: BodyId,
    geom: GeomId,
    walker: Walker,
    pub(super) health: u32,
    pub(super) looks_left: bool,
    /// How far it has walked, in steps.
    pub(super) stride: f32,
    /// Seconds until it may strike again.
    pub(super) rests: f32,
    /// Seconds until it feels the last blow no more.
    pub(super) reels: f32,
}

/// Something to throw.
#[derive(Debug, Clone, Copy)]
pub(super) struct Load {
    pub(super) body: BodyId,
    geom: GeomId,
    pub(super) is_ball: bool,
    /// Seconds since it was thrown; it does not meet who threw it for a moment.
    thrown: f32,
}

/// The game.
#[derive(Debug, Clone)]
pub struct Brawler {
    pub(super) simulator: TwoHalfPhysicsSimulator,
    /// Who fights; the first is the player's.
    pub(super) fighters: Vec<Fighter>,
    pub(super) loads: Vec<Load>,
    /// Which of them the player holds.
    pub(super) held: Option<usize>,
    pub(super) lift: PlatformId,
    pub(super) door: PlatformId,
    /// The walls of the lane, which are not seen.
    pub(super) walls: [PlatformId; 4],
    /// Points so far.
    pub score: u32,
    /// Where blows have landed, and for how long that is still to be seen, s.
    pub(super) blows: Vec<(Vector3, f32)>,
    /// Steps for which the world stands still after a blow.
    hit_stop: u32,
    time: f32,
}

impl Brawler {
    /// The start of the street.
    ///
    /// # Errors
    /// None with these sizes.
    pub fn new() -> Result<Self> {
        let mut simulator =
            TwoHalfPhysicsSimulator::with_angle_and_gravity(HEIGHT, ANGLE, Vector2::new(0.0, GRAVITY))?;
        let mut slab = |[left, right]: [f32; 2], [front, back]: [f32; 2], [low, high]: [f32; 2]| {
            let place = Vector3::new(0.5 * (left + right), low, 0.5 * (front + back));
            Platform::new(&mut simulator, right - left, high - low, back - front, place, None)
        };
        slab([-300.0, HOLE[0]], LANE, [0.0, STREET])?;
        slab([HOLE[1], BELT[0]], LANE, [0.0, STREET])?;
        let belt = slab(BELT, LANE, [0.0, STREET])?;
        slab([BELT[1], POND[0]], LANE, [0.0, STREET])?;
        slab([LIFT[1], END], LANE, [0.0, TERRACE])?;
        let lift = slab(LIFT, LANE, [5.0 - TERRACE, 5.0])?;
        let door = slab([DOOR, DOOR + 20.0], LANE, [TERRACE, TERRACE + 90.0])?;
        slab([-300.0, LIFT[1]], [LANE[1], LANE[1] + 8.0], [0.0, STREET + 34.0])?;
        slab([LIFT[1], END], [LANE[1], LANE[1] + 8.0], [0.0, TERRACE + 34.0])?;
        let walls = spawn_lane(&mut simulator, [0.0, END], LANE, 900.0)?;
        if let Some(mut belt) = simulator.platform_mut(belt) {
            belt.set_surface_speed(-60.0, 0.0)?;
        }
        let mut game = Brawler {
            simulator,
            fighters: Vec::new(),
            loads: Vec::new(),
            held: None,
            lift,
            door,
            walls,
            score: 0,
            blows: Vec::new(),
            hit_stop: 0,
            time: 0.0,
        };
        game.add_fighter([60.0, STREET, 80.0], 8)?;
        THUGS.iter().try_for_each(|&place| game.add_fighter(place, 3))?;
        CRATES
            .iter()
            .try_for_each(|&place| game.add_load(Prism::new([30.0; 3]).mass(6.0).at(place), false))?;
        let ball = Ball::new(13.0).mass(2.0).restitution(0.6);
        BALLS.iter().try_for_each(|&place| game.add_load(ball.at(place), true))?;
        Ok(game)
    }

    fn add_fighter(&mut self, place: [f32; 3], health: u32) -> Result<()> {
        let made = spawn(&mut self.simulator, Figure::new(FIGURE).at(place))?;
        self.fighters.push(Fighter {
            body: made.body,
            geom: made.geom,
            walker: Walker::new(Walk::default()),
            health,
            looks_left: !self.fighters.is_empty(),
            stride: 0.0,
            rests: 0.0,
            reels: 0.0,
        });
        Ok(())
    }

    fn add_load(&mut self, thing: Thing, is_ball: bool) -> Result<()> {
        let made = spawn(&mut self.simulator, thing)?;
        self.loads.push(Load { body: made.body, geom: made.geom, is_ball, thrown: f32::MAX });
        Ok(())
    }

    /// The simulator, to look at.
    pub fn simulator(&self) -> &TwoHalfPhysicsSimulator {
        &self.simulator
    }

    /// The simulator, to meddle with it.
    pub fn simulator_mut(&mut self) -> &mut TwoHalfPhysicsSimulator {
        &mut self.simulator
    }

    /// Where a body stands.
    pub(super) fn place(&self, body: BodyId) -> Vector3 {
        self.simulator.body(body).map_or(Vector3::zeros(), |body| body.position3d())
    }

    /// Where the player's fighter stands.
    pub(super) fn player(&self) -> Vector3 {
        self.place(self.fighters[0].body)
    }

    /// Height of the lift.
    pub(super) fn lift_height(&self) -> f32 {
        self.simulator.platform(self.lift).map_or(0.0, |lift| lift.position3d().y + TERRACE)
    }

    /// One step of 1 / [`RATE`] s.
    ///
    /// # Errors
    /// What the engine refuses: nothing, with what keys say.
    pub fn step(&mut self, keys: Keys) -> Result<()> {
        self.blows.retain_mut(|(_, left)| {
            *left -= DT;
            *left > 0.0
        });
        if self.hit_stop > 0 {
            self.hit_stop -= 1;
            return Ok(());
        }
        self.time += DT;
        self.move_platforms()?;
        self.steer(0, keys)?;
        for at in 1..self.fighters.len() {
            let keys = self.chase(at);
            self.steer(at, keys)?;
        }
        self.carry();
        self.swim();
        self.simulator.update(DT);
        self.strike_with_thrown();
        self.count_out()
    }

    fn move_platforms(&mut self) -> Result<()> {
        let part = (0.5 - 0.8 * cos(0.8 * self.time)).clamp(0.0, 1.0);
        let opens = self.fighters[1..].iter().all(|thug| self.place(thug.body).x > DOOR);
        let (door, lift) = (self.door, self.lift);
        if let Some(mut lift) = self.simulator.platform_mut(lift) {
            let place = lift.position3d();
            lift.move_to(Vector3::new(place.x, 5.0 - TERRACE + part * (TERRACE - 5.0), place.z))?;
        }
        if let Some(mut door) = self.simulator.platform_mut(door) {
            let place = door.position3d();
            // Upwards, where it is clear of the tallest: what sinks into a platform would be drawn in front of it.
            let target = if opens { TERRACE + 75.0 } else { TERRACE };
            door.move_to(Vector3::new(place.x, place.y + (target - place.y).clamp(-0.5, 0.5), place.z))?;
        }
        Ok(())
    }

    /// A fighter does what its keys say, unless it reels from a blow.
    fn steer(&mut self, at: usize, keys: Keys) -> Result<()> {
        let fighter = &mut self.fighters[at];
        (fighter.rests, fighter.reels) = (fighter.rests - DT, fighter.reels - DT);
        if fighter.reels > 0.0 || fighter.health == 0 {
            return Ok(self.simulator.let_go(fighter.body, &mut fighter.walker)?);
        }
        if keys.x != 0.0 {
            fighter.looks_left = keys.x < 0.0;
        }
        let speed = if at == 0 { 150.0 } else { 90.0 };
        let wish = Wish { x: speed * keys.x, z: 0.7 * speed * keys.z, jump: keys.jump };
        self.simulator.walk(fighter.body, &mut fighter.walker, wish, DT)?;
        fighter.stride += DT * (wish.x.abs() + wish.z.abs()) / 40.0;
        if keys.punch && fighter.rests <= 0.0 {
            fighter.rests = if at == 0 { 0.3 } else { 0.9 };
            self.punch(at);
        }
        if at == 0 && keys.grab {
            self.grab();
        }
        Ok(())
    }

    /// What a thug would press.
    fn chase(&self, at: usize) -> Keys {
        let way = self.player() - self.place(self.fighters[at].body);
        if way.norm() > 260.0 || way.y.abs() > 60.0 {
            return Keys::default();
        }
        let is_far = way.x.abs() > REACH;
        let x = if is_far || way.z.abs() < 12.0 { way.x.signum() * f32::from(u8::from(is_far)) } else { 0.0 };
        Keys { x, z: (way.z / 20.0).clamp(-1.0, 1.0), punch: way.norm() < REACH + 14.0, ..Keys::default() }
    }

    /// Strikes everything before a fighter.
    fn punch(&mut self, at: usize) {
        let Fighter { body, geom, looks_left, .. } = self.fighters[at];
        let (side, place) = (if looks_left { -1.0 } else { 1.0 }, self.place(body));
        let middle = place + Vector3::new(side * (13.0 + 0.5 * REACH), 34.0, 0.0);
        let half = Vector3::new(0.5 * REACH, 16.0, 16.0);
        for struck in self.simulator.query_box(middle - half, middle + half, |other| other != geom) {
            let fighter = self.fighters.iter().position(|fighter| fighter.geom == struck);
            let Some(load) = self.simulator.geom(struck).map(|geom| geom.body()) else { continue };
            match fighter {
                // Thugs do not strike each other.
                Some(other) if at == 0 || other == 0 => self.strike(other, side, middle),
                None if self.held.is_none_or(|held| self.loads[held].geom != struck) => {
                    if let Some(mut load) = self.simulator.body_mut(load) {
                        let mass = load.mass();
                        load.apply_impulse3d(Vector3::new(side * 180.0, 90.0, 0.0) * mass);
                    }
                }
                _ => (),
            }
        }
    }

    fn strike(&mut self, at: usize, side: f32, middle: Vector3) {
        let fighter = &mut self.fighters[at];
        fighter.health = fighter.health.saturating_sub(1);
        (fighter.reels, self.hit_stop) = (if fighter.health > 0 { 0.35 } else { 1.2 }, 6);
        let speed = if fighter.health > 0 { [160.0, 150.0] } else { [300.0, 320.0] };
        if let Some(mut body) = self.simulator.body_mut(fighter.body) {
            body.set_velocity3d(Vector3::new(side * speed[0], speed[1], 0.0));
        }
        self.blows.push((middle, 0.25));
        self.score += if at == 0 { 0 } else { 50 };
    }

    /// Lifts what lies before the player's fighter, or throws what it holds.
    fn grab(&mut self) {
        let Fighter { body, looks_left, .. } = self.fighters[0];
        let (side, place) = (if looks_left { -1.0 } else { 1.0 }, self.place(body));
        let velocity = self.simulator.body(body).map_or(Vector3::zeros(), |body| body.velocity3d());
        if let Some(held) = self.held.take() {
            let load = &mut self.loads[held];
            load.thrown = 0.0;
            if let Some(mut load) = self.simulator.body_mut(load.body) {
                load.set_ignore_gravity(false);
                load.set_velocity3d(Vector3::new(velocity.x + side * 420.0, 120.0, velocity.z));
            }
            return;
        }
        let low = place + Vector3::new((side * 45.0).min(0.0), 0.0, -22.0);
        let high = place + Vector3::new((side * 45.0).max(0.0), 50.0, 22.0);
        let near = self.simulator.query_box(low, high, |_| true);
        self.held = self.loads.iter().position(|load| near.contains(&load.geom));
        if let Some(held) = self.held {
            self.set_groups(held, 1);
        }
    }

    /// What has the group of the player's fighter does not meet it.
    fn set_groups(&mut self, load: usize, group: i32) {
        for geom in [self.loads[load].geom, self.fighters[0].geom] {
            if let Some(settings) = self.simulator.geom_mut(geom) {
                settings.set_collision_group(group);
            }
        }
    }

    /// What is held is moved to above the head by its velocity, so that it still bumps into things.
    fn carry(&mut self) {
        let above = self.player() + Vector3::new(0.0, FIGURE[1] + 4.0, 0.0);
        if let Some(mut load) = self.held.and_then(|held| self.simulator.body_mut(self.loads[held].body)) {
            let way = above - load.position3d();
            load.set_ignore_gravity(true);
            load.set_velocity3d(way * (way.norm().min(8.0) / (way.norm().max(1e-3) * DT)));
        }
    }

    /// Water carries what is in it, and slows it down; who wades is slow and light.
    fn swim(&mut self) {
        let is_in = |place: Vector3| (POND[0]..POND[1]).contains(&place.x) && place.y < WATER;
        for load in &self.loads {
            let Some(mut body) = self.simulator.body_mut(load.body) else { continue };
            let (place, velocity, mass) = (body.position3d(), body.velocity3d(), body.mass());
            if is_in(place) {
                let covered = ((WATER - place.y) / 26.0).min(1.0);
                body.apply_force3d(
                    (Vector3::new(0.0, 1.8 * GRAVITY, 0.0) - 4.0 * velocity) * (covered * mass),
                );
            }
        }
        for fighter in &mut self.fighters {
            let wades = self.simulator.body(fighter.body).is_some_and(|body| is_in(body.position3d()));
            fighter.walker.walk.acceleration = if wades { 400.0 } else { 1500.0 };
            if let Some(mut body) = self.simulator.body_mut(fighter.body) {
                body.set_gravity_scale(if wades { 0.4 } else { 1.0 });
            }
        }
    }

    /// What was thrown fells whom it meets.
    fn strike_with_thrown(&mut self) {
        for at in 0..self.loads.len() {
            let Load { body, geom, thrown, .. } = self.loads[at];
            let before = thrown;
            self.loads[at].thrown += DT;
            if before < 0.3 && self.loads[at].thrown >= 0.3 && self.held.is_none() {
                self.set_groups(at, 0);
            }
            let Some(view) = self.simulator.body(body) else { continue };
            let (speed, place) = (view.velocity3d(), view.origin3d());
            if thrown > 1.2 || Some(at) == self.held || speed.norm() < 100.0 {
                continue;
            }
            let half = Vector3::new(19.0, 19.0, 19.0);
            let near = self.simulator.query_box(place - half, place + half, |other| other != geom);
            let fits = |fighter: &Fighter| near.contains(&fighter.geom) && fighter.reels <= 0.0;
            if let Some(other) = self.fighters.iter().skip(1).position(fits) {
                self.fighters[other + 1].health = 1;
                self.strike(other + 1, speed.x.signum(), place);
                self.score += 100;
            }
        }
    }

    /// Who is knocked out, or fell into the hole, is gone; the player begins again before it.
    fn count_out(&mut self) -> Result<()> {
        let fell = |place: Vector3| (HOLE[0]..HOLE[1]).contains(&place.x) && place.y < 15.0;
        if fell(self.player()) || (self.fighters[0].health == 0 && self.fighters[0].reels <= 0.0) {
            let (back, player) = (self.player().x.min(HOLE[0] - 60.0), &mut self.fighters[0]);
            player.health = if player.health == 0 { 8 } else { player.health };
            if let Some(mut body) = self.simulator.body_mut(player.body) {
                body.set_velocity3d(Vector3::zeros());
                body.set_position3d(Vector3::new(back, STREET + 80.0, 80.0));
            }
        }
        while let Some(at) = self.loads.iter().position(|load| fell(self.place(load.body))) {
            self.simulator.dispose(self.loads.remove(at).body)?;
            self.held = self.held.filter(|held| *held != at).map(|held| held - usize::from(held > at));
        }
        let is_out = |game: &Self, thug: &Fighter| {
            (thug.health == 0 && thug.reels <= 0.0) || fell(game.place(thug.body))
        };
        while let Some(at) = (1..self.fighters.len()).find(|&at| is_out(self, &self.fighters[at])) {
            self.simulator.dispose(self.fighters.remove(at).body)?;
            self.score += 200;
        }
        Ok(())
    }
}
