//! The game. It has no screen; [`Brawler::step`] takes the keys that are down, of any source.

use std::f32::consts::FRAC_PI_2;

use farseer_core::math::scalar::cos;
use twohalf::*;
use twohalf_factories::*;

use crate::Result;

/// Updates per second.
pub const RATE: u32 = 120;
const DT: f32 = 1.0 / RATE as f32;
/// Direction of the Z axis on the screen, degrees, and where the screen's y of the ground is.
pub(super) const ANGLE: i32 = 70;
pub(super) const HEIGHT: i32 = 480;

/// Front and back of the street in px of Z; heights of the street and of the terrace behind the lift.
pub(super) const LANE: [f32; 2] = [10.0, 150.0];
pub(super) const STREET: f32 = 40.0;
pub(super) const TERRACE: f32 = 130.0;
/// Ranges along X in px: a hole, a belt that runs to the left, a pond, the lift, a press.
pub(super) const HOLE: [f32; 2] = [560.0, 640.0];
const BELT: [f32; 2] = [980.0, 1120.0];
pub(super) const POND: [f32; 2] = [1200.0, 1340.0];
pub(super) const LIFT: [f32; 2] = [1340.0, 1430.0];
pub(super) const PRESS: [f32; 2] = [1800.0, 1870.0];
const DOOR: f32 = 1640.0;
const END: f32 = 2100.0;

/// X and Z of thugs and balls in px; X, height over the floor and Z of crates.
const THUGS: [[f32; 2]; 6] =
    [[420.0, 60.0], [800.0, 110.0], [880.0, 50.0], [1560.0, 60.0], [1600.0, 110.0], [1980.0, 80.0]];
const BALLS: [[f32; 2]; 3] = [[320.0, 40.0], [1240.0, 60.0], [1740.0, 110.0]];
const CRATES: [[f32; 3]; 5] =
    [[200.0, 0.0, 90.0], [780.0, 0.0, 110.0], [780.0, 30.0, 110.0], [930.0, 0.0, 65.0], [1500.0, 0.0, 90.0]];

/// Keys that are held down, and keys that were pressed just now.
#[derive(Debug, Clone, Copy, Default)]
pub struct Keys {
    /// Direction along X as a fraction of the full speed: from -1, to the left, to 1.
    pub x: f32,
    /// Direction along Z as a fraction of the full speed: from -1, to the front, to 1.
    pub z: f32,
    /// Jumps.
    pub jump: bool,
    /// Strikes.
    pub punch: bool,
    /// Lifts a near object, or throws the held one; only in the step in which it was pressed.
    pub grab: bool,
}

/// The player or a thug.
#[derive(Debug, Clone)]
pub(super) struct Fighter {
    pub(super) actor: Actor,
    pub(super) health: u32,
}

/// The game.
#[derive(Debug, Clone)]
pub struct Brawler {
    /// All that moves.
    pub simulator: TwoHalfPhysicsSimulator,
    /// The first one is the player's.
    pub(super) fighters: Vec<Fighter>,
    /// To throw and to strike. The first one hangs on the rope.
    pub(super) loads: Vec<Spawned>,
    pub(super) rope: SpawnedRope,
    pub(super) lift: PlatformId,
    pub(super) press: PlatformId,
    pub(super) door: Door,
    /// Walls around the lane; they are invisible.
    pub(super) walls: [PlatformId; 4],
    /// Present state.
    pub state: State,
}

/// State of a game besides the positions.
#[derive(Debug, Clone, Default)]
pub struct State {
    /// Number of points so far.
    pub score: u32,
    /// The player's hands, with the object they hold.
    pub(super) hands: Hands,
    /// Where and when blows have landed.
    pub(super) blows: Vec<(Vector3, f32)>,
    /// Seconds since it began.
    pub(super) time: f32,
}

fn floor_at(x: f32) -> f32 {
    if x > LIFT[1] { TERRACE } else { STREET }
}

impl Brawler {
    /// The start of the street. The engine refuses none of it.
    pub fn new() -> Result<Self> {
        let gravity = Vector2::new(0.0, 900.0);
        let mut simulator = TwoHalfPhysicsSimulator::with_angle_and_gravity(HEIGHT, ANGLE, gravity)?;
        let mut block = |x, z, y| spawn_block(&mut simulator, x, y, z);
        for x in [[-300.0, HOLE[0]], [HOLE[1], BELT[0]], [BELT[1], POND[0]]] {
            block(x, LANE, [0.0, STREET])?;
        }
        block([LIFT[1], END], LANE, [0.0, TERRACE])?;
        block([-300.0, LIFT[1]], [LANE[1], LANE[1] + 8.0], [0.0, STREET + 44.0])?;
        block([LIFT[1], END], [LANE[1], LANE[1] + 8.0], [0.0, TERRACE + 44.0])?;
        let belt = block(BELT, LANE, [0.0, STREET])?;
        let lift = block(LIFT, LANE, [5.0 - TERRACE, 5.0])?;
        let press = block(PRESS, LANE, [TERRACE + 90.0, TERRACE + 150.0])?;
        simulator.platform_mut(belt).ok_or("the belt is new")?.set_surface_speed(-60.0, 0.0)?;
        let pond = Region::new([POND[0], 0.0, LANE[0]], [POND[1], 30.0, LANE[1]])?;
        simulator.add_field(Fluid::water(pond, 4.5e-4))?;
        let hinge = [DOOR, TERRACE, LANE[1] - 5.0];
        let door = spawn_door(&mut simulator, hinge, [130.0, 90.0, 10.0], -FRAC_PI_2)?;
        let walls = spawn_lane(&mut simulator, [0.0, END], LANE, 900.0)?;
        let mut fighters = Vec::new();
        for [x, z] in [[60.0, 80.0]].into_iter().chain(THUGS) {
            let figure = Figure::new([26.0, 56.0, 18.0]).at([x, floor_at(x), z]);
            let actor = Actor::spawn(&mut simulator, figure)?;
            simulator.set_crush_tolerance(actor.thing.body, Some(12.0))?;
            fighters.push(Fighter { actor, health: if fighters.is_empty() { 8 } else { 3 } });
        }
        let wrecker = Ball::new(17.0).mass(12.0).at([720.0, STREET + 22.0, 80.0]);
        let crates = CRATES.map(|[x, y, z]| Prism::new([30.0; 3]).mass(6.0).at([x, floor_at(x) + y, z]));
        let ball = Ball::new(13.0).mass(2.0).restitution(0.6);
        let balls = BALLS.map(|[x, z]| ball.at([x, floor_at(x), z]));
        let things = [wrecker].into_iter().chain(crates).chain(balls);
        let loads: Vec<Spawned> =
            things.map(|thing| spawn(&mut simulator, thing)).collect::<twohalf::Result<_>>()?;
        let rope = Rope::new(RopeEnd::Fixed([720.0, 330.0, 80.0]), RopeEnd::Body(loads[0].body));
        let rope = spawn_rope(&mut simulator, rope.mass(0.4))?;
        let state = State::default();
        Ok(Brawler { simulator, fighters, loads, rope, lift, press, door, walls, state })
    }

    /// Position of the player's fighter.
    pub(super) fn player(&self) -> Vector3 {
        self.fighters[0].actor.place(&self.simulator)
    }

    /// Height of the underside of a platform.
    pub(super) fn height_of(&self, platform: PlatformId) -> f32 {
        self.simulator.platform(platform).map_or(0.0, |platform| platform.position3d().y)
    }

    /// One step of 1 / [`RATE`] s. Fails if the engine refuses a call, which no keys can cause.
    pub fn step(&mut self, keys: Keys) -> Result<()> {
        self.state.time += DT;
        self.move_platforms()?;
        for at in 0..self.fighters.len() {
            let keys = if at == 0 { keys } else { self.chase(at) };
            self.steer(at, keys)?;
        }
        self.state.hands.carry(&mut self.simulator, Vector3::new(0.0, 62.0, 0.0), 960.0, DT)?;
        self.simulator.update(DT);
        self.look_at_events()?;
        self.count_out()
    }

    fn move_platforms(&mut self) -> Result<()> {
        let part = |speed: f32| (0.5 - 0.8 * cos(speed * self.state.time)).clamp(0.0, 1.0);
        let lifted = 5.0 - TERRACE + part(0.8) * (TERRACE - 5.0);
        let pressed = TERRACE + 90.0 - part(1.6) * 82.0;
        for (platform, height) in [(self.lift, lifted), (self.press, pressed)] {
            let mut platform = self.simulator.platform_mut(platform).ok_or("it stays")?;
            let place = platform.position3d();
            platform.move_to(Vector3::new(place.x, height, place.z))?;
        }
        // The door opens to the back, once it is unguarded.
        let guards = self.fighters[1..].iter().any(|thug| thug.actor.place(&self.simulator).x < DOOR);
        self.door.turn_towards(&mut self.simulator, if guards { -FRAC_PI_2 } else { 0.0 }, DT)?;
        Ok(())
    }

    /// The keys of a thug.
    fn chase(&self, at: usize) -> Keys {
        let place = self.fighters[at].actor.place(&self.simulator);
        let way = self.player() - place;
        if way.norm() > 260.0 || way.y.abs() > 60.0 {
            return Keys::default();
        }
        let ahead = place + Vector3::new(80.0 * way.x.signum(), 5.0, 0.0);
        let ahead = self.simulator.surface_beneath(ahead).map_or(0.0, |surface| surface.height);
        let stops = way.x.abs() < 34.0 || ahead < place.y - 30.0;
        let x = if stops { 0.01 } else { 1.0 } * way.x.signum();
        Keys { x, z: (way.z / 20.0).clamp(-1.0, 1.0), punch: way.norm() < 44.0, ..Keys::default() }
    }

    /// A fighter does what its keys say, unless it reels from a blow. Thugs strike the player alone.
    fn steer(&mut self, at: usize, keys: Keys) -> Result<()> {
        let Brawler { simulator, fighters, loads, state: State { hands, .. }, .. } = self;
        let player = fighters[0].actor.thing.geom;
        let actor = &mut fighters[at].actor;
        let speed = if at == 0 { 150.0 } else { 90.0 };
        let wish = MoveInput { x: speed * keys.x, z: 0.7 * speed * keys.z, jump: keys.jump };
        if !actor.act(simulator, wish, DT)? {
            return Ok(());
        }
        if keys.grab && hands.held().is_some() {
            let forwards = if actor.looks_left { -500.0 } else { 500.0 };
            hands.throw(simulator, Vector3::new(forwards, 120.0, 0.0))?;
        } else if keys.grab {
            let reach = Blow { heights: [0.0, 50.0], half_depth: 22.0, ..Blow::default() };
            let near = in_reach(simulator, actor.thing, actor.looks_left, &reach)?;
            if let Some(load) = loads[1..].iter().find(|load| near.contains(&load.geom)) {
                hands.take(simulator, actor.thing, *load)?;
            }
        }
        if keys.punch && actor.rests == 0.0 {
            actor.rests = if at == 0 { 0.3 } else { 0.9 };
            let is_target = |geom| at == 0 || geom == player;
            let struck = actor.strike(simulator, &Blow::default(), is_target)?;
            struck.into_iter().try_for_each(|geom| self.hurt(geom, 1))?;
        }
        Ok(())
    }

    /// A blow lands on a fighter.
    fn hurt(&mut self, geom: GeomId, damage: u32) -> Result<()> {
        let is_up = |fighter: &Fighter| fighter.actor.thing.geom == geom && fighter.health > 0;
        let found = self.fighters.iter().position(is_up);
        let Some(at) = found else { return Ok(()) };
        let Fighter { actor, health, .. } = &mut self.fighters[at];
        *health = health.saturating_sub(damage);
        actor.stunned = if *health > 0 { 0.35 } else { 1.2 };
        if let Some(mut body) = self.simulator.body_mut(actor.thing.body).filter(|_| *health == 0) {
            let side = body.velocity3d().x.signum();
            body.set_velocity3d(Vector3::new(300.0 * side, 320.0, 0.0));
        }
        self.simulator.stop_time(actor.thing.body, 8)?;
        let place = actor.place(&self.simulator) + Vector3::new(0.0, 44.0, 0.0);
        self.state.blows.push((place, self.state.time));
        self.state.score += if at == 0 { 0 } else { 50 * damage };
        Ok(())
    }

    /// Flying objects fell the fighters that they hit, and the press those that it crushes.
    fn look_at_events(&mut self) -> Result<()> {
        let player = self.fighters[0].actor.thing.geom;
        let hurt = |event: &Event| match *event {
            Event::Collision(Collision {
                this, partner: ContactTarget::Geom(load), normal_impulse, ..
            }) => {
                let is_hit = normal_impulse > 950.0 && self.loads.iter().any(|it| it.geom == load);
                (is_hit && this != player).then_some(this)
            }
            Event::Crushed { body, .. } => self.simulator.body(body)?.ground().object_geom(),
            _ => None,
        };
        let all: Vec<GeomId> = self.simulator.events().iter().filter_map(hurt).collect();
        all.into_iter().try_for_each(|geom| self.hurt(geom, 3))
    }

    /// A fighter that is knocked out, or fell into the hole, is removed; the player begins again beside it.
    fn count_out(&mut self) -> Result<()> {
        let Brawler { simulator, fighters, .. } = self;
        for at in (0..fighters.len()).rev() {
            let Fighter { actor, health, .. } = &mut fighters[at];
            let place = actor.place(simulator);
            let fell = (HOLE[0]..HOLE[1]).contains(&place.x) && place.y < 15.0;
            if !fell && (*health > 0 || actor.stunned > 0.0) {
                continue;
            }
            if at > 0 {
                simulator.dispose(fighters.remove(at).actor.thing.body)?;
                self.state.score += 200;
            } else if let Some(mut body) = simulator.body_mut(actor.thing.body) {
                let x = if fell { HOLE[0] - 60.0 } else { place.x };
                *health = if *health == 0 { 8 } else { *health };
                body.set_velocity3d(Vector3::zeros());
                body.set_position3d(Vector3::new(x, floor_at(x) + 80.0, 80.0));
            }
        }
        Ok(())
    }
}
