//! A small beat-'em-up: a street with a hole, a belt, a pond, a lift, a door, a press, a ball on a rope, thugs who chase, crates and
//! balls to throw.
//!
//! The game is all here and knows no screen; [`Brawler::step`] takes what keys are down, whoever holds them.

use std::f32::consts::FRAC_PI_2;

use crate::Result;
use farseer_core::math::scalar::cos;
use twohalf::*;
use twohalf_factories::*;

/// Updates per second.
pub const RATE: u32 = 120;
const DT: f32 = 1.0 / RATE as f32;
/// Direction of the Z axis on the screen, degrees, and where the screen's y of the ground is.
pub(super) const ANGLE: i32 = 70;
pub(super) const HEIGHT: i32 = 480;

/// Front and back of the street; how high it is, and the terrace behind the lift.
pub(super) const LANE: [f32; 2] = [10.0, 150.0];
pub(super) const STREET: f32 = 40.0;
pub(super) const TERRACE: f32 = 130.0;
/// From where to where along X: a hole, a belt that runs to the left, a pond, the lift, a press.
pub(super) const HOLE: [f32; 2] = [560.0, 640.0];
const BELT: [f32; 2] = [980.0, 1120.0];
pub(super) const POND: [f32; 2] = [1200.0, 1340.0];
pub(super) const LIFT: [f32; 2] = [1340.0, 1430.0];
pub(super) const PRESS: [f32; 2] = [1800.0, 1870.0];
const DOOR: f32 = 1640.0;
const END: f32 = 2100.0;

const FIGURE: [f32; 3] = [26.0, 56.0, 18.0];
const THUGS: [[f32; 3]; 6] = [
    [420.0, STREET, 60.0],
    [800.0, STREET, 110.0],
    [880.0, STREET, 50.0],
    [1560.0, TERRACE, 60.0],
    [1600.0, TERRACE, 110.0],
    [1980.0, TERRACE, 80.0],
];
const CRATES: [[f32; 3]; 6] = [
    [200.0, STREET, 90.0],
    [780.0, STREET, 110.0],
    [780.0, STREET + 30.0, 110.0],
    [900.0, STREET, 40.0],
    [1270.0, 40.0, 90.0],
    [1500.0, TERRACE, 90.0],
];
const BALLS: [[f32; 3]; 3] = [[320.0, STREET, 40.0], [1240.0, 60.0, 60.0], [1740.0, TERRACE, 110.0]];

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
    pub(super) thing: Spawned,
    pub(super) walker: Walker,
    pub(super) health: u32,
    pub(super) looks_left: bool,
    /// How far it has walked, in steps.
    pub(super) stride: f32,
    /// Seconds until it may strike again, and until it feels the last blow no more.
    pub(super) rests: f32,
    pub(super) reels: f32,
}

/// Something to throw, or to strike.
#[derive(Debug, Clone, Copy)]
pub(super) struct Load {
    pub(super) thing: Spawned,
    pub(super) is_ball: bool,
    /// For so many seconds it still fells whom it hits.
    flies: f32,
}

/// The game.
#[derive(Debug, Clone)]
pub struct Brawler {
    pub(super) simulator: TwoHalfPhysicsSimulator,
    pub(super) fighters: Vec<Fighter>,
    /// The first one hangs on the rope.
    pub(super) loads: Vec<Load>,
    pub(super) rope: SpawnedRope,
    /// What the player holds, and what is not apart from them yet.
    pub(super) held: Option<Grip>,
    thrown: Vec<Grip>,
    pub(super) lift: PlatformId,
    pub(super) press: PlatformId,
    pub(super) door: Door,
    /// The walls of the lane, which are not seen.
    pub(super) walls: [PlatformId; 4],
    pub(super) water: Region,
    /// Points so far.
    pub score: u32,
    /// Where blows have landed, and for how long that is still to be seen, s.
    pub(super) blows: Vec<(Vector3, f32)>,
    /// The height of the floor that the camera looks at.
    pub(super) floor: f32,
    time: f32,
}

impl Brawler {
    /// The start of the street.
    ///
    /// # Errors
    /// None with these sizes.
    pub fn new() -> Result<Self> {
        let gravity = Vector2::new(0.0, 900.0);
        let mut simulator = TwoHalfPhysicsSimulator::with_angle_and_gravity(HEIGHT, ANGLE, gravity)?;
        let mut block = |x, z, y| spawn_block(&mut simulator, x, y, z);
        block([-300.0, HOLE[0]], LANE, [0.0, STREET])?;
        block([HOLE[1], BELT[0]], LANE, [0.0, STREET])?;
        block([BELT[1], POND[0]], LANE, [0.0, STREET])?;
        block([LIFT[1], END], LANE, [0.0, TERRACE])?;
        block([-300.0, LIFT[1]], [LANE[1], LANE[1] + 8.0], [0.0, STREET + 44.0])?;
        block([LIFT[1], END], [LANE[1], LANE[1] + 8.0], [0.0, TERRACE + 44.0])?;
        let belt = block(BELT, LANE, [0.0, STREET])?;
        let lift = block(LIFT, LANE, [5.0 - TERRACE, 5.0])?;
        let press = block(PRESS, LANE, [TERRACE + 90.0, TERRACE + 150.0])?;
        simulator.platform_mut(belt).ok_or("the belt is new")?.set_surface_speed(-60.0, 0.0)?;
        let water = Region::new([POND[0], 0.0, LANE[0]], [POND[1], 30.0, LANE[1]])?;
        simulator.add_field(Fluid::water(water, 4.5e-4))?;
        let door =
            spawn_door(&mut simulator, [DOOR, TERRACE, LANE[1] - 5.0], [130.0, 90.0, 10.0], -FRAC_PI_2)?;
        let walls = spawn_lane(&mut simulator, [0.0, END], LANE, 900.0)?;
        let ball = spawn(&mut simulator, Ball::new(17.0).mass(12.0).at([720.0, STREET + 22.0, 80.0]))?;
        let rope = Rope::new(RopeEnd::Fixed([720.0, 330.0, 80.0]), RopeEnd::Body(ball.body));
        let rope = spawn_rope(&mut simulator, rope.mass(0.4))?;
        let mut game = Brawler {
            simulator,
            fighters: Vec::new(),
            loads: vec![Load { thing: ball, is_ball: true, flies: 0.0 }],
            rope,
            held: None,
            thrown: Vec::new(),
            lift,
            press,
            door,
            walls,
            water,
            score: 0,
            blows: Vec::new(),
            floor: STREET,
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
        let thing = spawn(&mut self.simulator, Figure::new(FIGURE).at(place))?;
        self.simulator.set_crush_tolerance(thing.body, Some(12.0))?;
        let (walker, looks_left) = (Walker::new(Walk::default()), !self.fighters.is_empty());
        self.fighters.push(Fighter {
            thing,
            walker,
            health,
            looks_left,
            stride: 0.0,
            rests: 0.0,
            reels: 0.0,
        });
        Ok(())
    }

    fn add_load(&mut self, load: Thing, is_ball: bool) -> Result<()> {
        let thing = spawn(&mut self.simulator, load)?;
        self.loads.push(Load { thing, is_ball, flies: 0.0 });
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

    /// Where something stands.
    pub(super) fn place(&self, thing: Spawned) -> Vector3 {
        self.simulator.body(thing.body).map_or(Vector3::zeros(), |body| body.position3d())
    }

    /// Where the player's fighter stands.
    pub(super) fn player(&self) -> Vector3 {
        self.place(self.fighters[0].thing)
    }

    /// Height of the underside of a platform.
    pub(super) fn height_of(&self, platform: PlatformId) -> f32 {
        self.simulator.platform(platform).map_or(0.0, |platform| platform.position3d().y)
    }

    /// One step of 1 / [`RATE`] s.
    ///
    /// # Errors
    /// What the engine refuses: nothing, with what keys say.
    pub fn step(&mut self, keys: Keys) -> Result<()> {
        self.time += DT;
        self.blows.iter_mut().for_each(|(_, left)| *left -= DT);
        self.blows.retain(|(_, left)| *left > 0.0);
        self.loads.iter_mut().for_each(|load| load.flies -= DT);
        self.move_platforms()?;
        self.steer(0, keys)?;
        for at in 1..self.fighters.len() {
            self.steer(at, self.chase(at))?;
        }
        self.hold(keys.grab)?;
        self.simulator.update(DT);
        self.look_at_events()?;
        self.thrown.retain(|grip| !grip.is_over(&mut self.simulator));
        let floor = self.simulator.surface_beneath_body(self.fighters[0].thing.body);
        self.floor += 0.03 * (floor.map_or(0.0, |floor| floor.height).max(STREET) - self.floor);
        self.count_out()
    }

    fn move_platforms(&mut self) -> Result<()> {
        let part = |speed: f32, time: f32| (0.5 - 0.8 * cos(speed * time)).clamp(0.0, 1.0);
        let lifted = 5.0 - TERRACE + part(0.8, self.time) * (TERRACE - 5.0);
        let pressed = TERRACE + 90.0 - part(1.6, self.time) * 82.0;
        for (platform, height) in [(self.lift, lifted), (self.press, pressed)] {
            if let Some(mut platform) = self.simulator.platform_mut(platform) {
                let place = platform.position3d();
                platform.move_to(Vector3::new(place.x, height, place.z))?;
            }
        }
        // The door opens to the back, once nobody guards it.
        let is_guarded = self.fighters[1..].iter().any(|thug| self.place(thug.thing).x < DOOR);
        let angle = if is_guarded { -FRAC_PI_2 } else { 0.0 };
        self.door.turn_towards(&mut self.simulator, angle, DT)?;
        Ok(())
    }

    /// A fighter does what its keys say, unless it reels from a blow.
    fn steer(&mut self, at: usize, keys: Keys) -> Result<()> {
        let fighter = &mut self.fighters[at];
        if self.simulator.time_scale(fighter.thing.body) == 0.0 {
            return Ok(());
        }
        (fighter.rests, fighter.reels) = (fighter.rests - DT, fighter.reels - DT);
        let is_up = fighter.reels <= 0.0 && fighter.health > 0;
        let keys = if is_up { keys } else { Keys::default() };
        fighter.walker.walk.air_acceleration = if is_up { 600.0 } else { 0.0 };
        if keys.x != 0.0 {
            fighter.looks_left = keys.x < 0.0;
        }
        let speed = if at == 0 { 150.0 } else { 90.0 };
        let wish = Wish { x: speed * keys.x, z: 0.7 * speed * keys.z, jump: keys.jump };
        self.simulator.walk(fighter.thing.body, &mut fighter.walker, wish, DT)?;
        fighter.stride += DT * (wish.x.abs() + wish.z.abs()) / 40.0;
        if keys.punch && fighter.rests <= 0.0 {
            fighter.rests = if at == 0 { 0.3 } else { 0.9 };
            self.punch(at)?;
        }
        Ok(())
    }

    /// What a thug would press.
    fn chase(&self, at: usize) -> Keys {
        let place = self.place(self.fighters[at].thing);
        let way = self.player() - place;
        if way.norm() > 260.0 || way.y.abs() > 60.0 {
            return Keys::default();
        }
        let ahead = self.simulator.surface_beneath(place + Vector3::new(14.0 * way.x.signum(), 5.0, 0.0));
        let stops = way.x.abs() < 34.0 || ahead.is_none_or(|ahead| ahead.height < place.y - 30.0);
        let x = if stops { 0.01 } else { 1.0 } * way.x.signum();
        Keys { x, z: (way.z / 20.0).clamp(-1.0, 1.0), punch: way.norm() < 44.0, ..Keys::default() }
    }

    /// Strikes everything before a fighter; thugs do not strike each other.
    fn punch(&mut self, at: usize) -> Result<()> {
        let Brawler { simulator, fighters, loads, held, .. } = self;
        let held = held.map(|grip| grip.load().geom);
        let is_load = |geom| Some(geom) != held && loads.iter().any(|load| load.thing.geom == geom);
        let is_rival = |geom| fighters.iter().skip(1).any(|thug| thug.thing.geom == geom) || is_load(geom);
        let is_target = |geom| if at == 0 { is_rival(geom) } else { geom == fighters[0].thing.geom };
        let Fighter { thing, looks_left, .. } = fighters[at];
        for struck in strike(simulator, thing, looks_left, &Blow::default(), is_target)? {
            match self.loads.iter_mut().find(|load| load.thing.geom == struck) {
                Some(load) => load.flies = 1.2,
                None => self.hurt(struck, 1)?,
            }
        }
        Ok(())
    }

    /// A blow has landed on a fighter.
    fn hurt(&mut self, geom: GeomId, damage: u32) -> Result<()> {
        let Some(at) = self.fighters.iter().position(|fighter| fighter.thing.geom == geom) else {
            return Ok(());
        };
        let fighter = &mut self.fighters[at];
        fighter.health = fighter.health.saturating_sub(damage);
        fighter.reels = if fighter.health > 0 { 0.35 } else { 1.2 };
        if let Some(mut body) = self.simulator.body_mut(fighter.thing.body).filter(|_| fighter.health == 0) {
            let side = body.velocity3d().x.signum();
            body.set_velocity3d(Vector3::new(300.0 * side, 320.0, 0.0));
        }
        self.simulator.stop_time(fighter.thing.body, 8)?;
        self.blows.push((self.place(self.fighters[at].thing) + Vector3::new(0.0, 44.0, 0.0), 0.3));
        self.score += if at == 0 { 0 } else { 50 * damage };
        Ok(())
    }

    /// Lifts what lies before the player's fighter, carries it over the head, or throws it.
    fn hold(&mut self, grabs: bool) -> Result<()> {
        let Fighter { thing, looks_left, .. } = self.fighters[0];
        let (side, place) = (if looks_left { -1.0 } else { 1.0 }, self.place(thing));
        if let Some(grip) = &self.held {
            grip.carry(&mut self.simulator, Vector3::new(0.0, FIGURE[1] + 6.0, 0.0), 960.0, DT)?;
        }
        if !grabs {
            return Ok(());
        }
        if let Some(mut grip) = self.held.take() {
            let velocity = self.simulator.body(thing.body).map_or(0.0, |body| body.velocity3d().x);
            grip.throw(&mut self.simulator, Vector3::new(velocity + 420.0 * side, 120.0, 0.0))?;
            self.loads.iter_mut().filter(|load| load.thing == grip.load()).for_each(|load| load.flies = 1.2);
            self.thrown.push(grip);
            return Ok(());
        }
        let half = Vector3::new(22.0, 25.0, 22.0);
        let middle = place + Vector3::new(23.0 * side, 25.0, 0.0);
        let near = self.simulator.query_box(middle - half, middle + half, |_| true);
        if let Some(load) = self.loads[1..].iter().find(|load| near.contains(&load.thing.geom)) {
            self.held = Some(Grip::take(&mut self.simulator, thing, load.thing)?);
        }
        Ok(())
    }

    /// What flies fells whom it meets, and the press whom it crushes.
    fn look_at_events(&mut self) -> Result<()> {
        let flies = |geom| self.loads.iter().any(|load| load.thing.geom == geom && load.flies > 0.0);
        let player = self.fighters[0].thing.geom;
        let hurt = |event: &Event| match *event {
            Event::Collision(Collision { this, partner: Partner::Geom(load), normal_impulse, .. }) => {
                (flies(load) && this != player && normal_impulse > 300.0).then_some(this)
            }
            Event::Crushed { body, .. } => self.simulator.body(body)?.ground().object_geom(),
            _ => None,
        };
        let all: Vec<GeomId> = self.simulator.events().iter().filter_map(hurt).collect();
        all.into_iter().try_for_each(|geom| self.hurt(geom, 3))
    }

    /// Who is knocked out, or fell into the hole, is gone; the player begins again before it.
    fn count_out(&mut self) -> Result<()> {
        let fell = |place: Vector3| (HOLE[0]..HOLE[1]).contains(&place.x) && place.y < 15.0;
        let is_out = |game: &Self, fighter: &Fighter| {
            (fighter.health == 0 && fighter.reels <= 0.0) || fell(game.place(fighter.thing))
        };
        if is_out(self, &self.fighters[0]) {
            let x = if fell(self.player()) { HOLE[0] - 60.0 } else { self.player().x };
            let player = &mut self.fighters[0];
            player.health = if player.health == 0 { 8 } else { player.health };
            if let Some(mut body) = self.simulator.body_mut(player.thing.body) {
                let height = if x > LIFT[1] { TERRACE } else { STREET };
                body.set_velocity3d(Vector3::zeros());
                body.set_position3d(Vector3::new(x, height + 80.0, 80.0));
            }
        }
        while let Some(at) = self.loads.iter().position(|load| fell(self.place(load.thing))) {
            let lost = self.loads.remove(at).thing;
            self.held = self.held.filter(|grip| grip.load() != lost);
            self.simulator.dispose(lost.body)?;
        }
        while let Some(at) = (1..self.fighters.len()).find(|&at| is_out(self, &self.fighters[at])) {
            self.simulator.dispose(self.fighters.remove(at).thing.body)?;
            self.score += 200;
        }
        Ok(())
    }
}
