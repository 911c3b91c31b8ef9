//! A pinball table: how a game uses handlers of single geoms, side tables, typed ids, sensors and collision categories.

mod picture;

pub use picture::{FELT, draw, play};

use farseer_core::math::Vector2;
use farseer_core::{
    BodyFactory, BodyId, CollisionCategory, Contact, Context, Dispatch, FixedAngleSpring, GeomFactory,
    GeomId, GeomPlacement, JointFactory, Methods, Objects, PhysicsSimulator, SecondaryMap, SpringFactory,
    TypedSpringId,
};

use crate::Result;

/// Width and height of the table in px.
pub const TABLE: [f32; 2] = [420.0, 700.0];
/// Radius of the ball in px.
pub const BALL: f32 = 9.0;
/// Length and thickness of a flipper in px.
pub const FLIPPER: [f32; 2] = [74.0, 14.0];
/// Updates per second.
pub const RATE: u32 = 240;

/// Collision categories of objects on the table, and of those on the ramp above it.
const BELOW: CollisionCategory = CollisionCategory::CAT2;
const ABOVE: CollisionCategory = CollisionCategory::CAT3;
const BALLS: CollisionCategory = CollisionCategory::CAT1;
/// Collision group number of walls and flippers, which would collide by the categories of either: a flipper passes the wall at
/// its hinge.
const FRAME: i32 = 1;

const SLOPE: f32 = 420.0;
const START: [f32; 2] = [403.0, 640.0];
const LAUNCH: f32 = 900.0;
/// Angles in rad of the left flipper at rest and raised, and its spring.
const ANGLES: [f32; 2] = [0.45, -0.5];
const SPRING: [f32; 2] = [1.2e7, 2.0e4];
/// How fast a bumper sends the ball away, in px/s.
const KICK: f32 = 420.0;
const BALLS_OF_A_GAME: u32 = 3;

/// A target that scores, and its look.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Thing {
    /// Sends the ball away.
    Bumper {
        /// Radius in px.
        radius: f32,
    },
    /// Three of them lit are worth more.
    Light {
        /// It was rolled over.
        is_on: bool,
    },
    /// A wall of the table, or of the ramp above it.
    Wall {
        /// Width and height in px.
        size: [f32; 2],
        /// It belongs to the ramp.
        is_above: bool,
    },
}

/// The score, and all else that handlers know.
#[derive(Debug, Clone, Default)]
pub struct Game {
    /// Number of points so far.
    pub score: u32,
    /// Number of remaining balls, with the one that rolls.
    pub balls: u32,
    /// Number of times that the ball has run over the ramp.
    pub ramps: u32,
    /// The ball is on the ramp.
    pub is_above: bool,
    /// The targets on the table.
    pub things: SecondaryMap<GeomId, Thing>,
    ball: Option<(BodyId, GeomId)>,
}

/// A side of the two flippers.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Side {
    /// The left one.
    Left,
    /// The right one.
    Right,
}

/// A flipper.
#[derive(Debug, Clone)]
struct Flipper {
    body: BodyId,
    spring: TypedSpringId<FixedAngleSpring>,
    /// Factor 1 for the left one, -1 for the right one.
    sign: f32,
}

/// The table, the game on it and the handlers between them.
#[derive(Debug, Clone)]
pub struct Pinball {
    simulator: PhysicsSimulator,
    dispatch: Dispatch<Game>,
    game: Game,
    ball: BodyId,
    flippers: [Flipper; 2],
}

impl Pinball {
    /// A table with the ball before the plunger.
    ///
    /// # Errors
    /// None with these sizes.
    pub fn new() -> Result<Self> {
        let mut simulator = PhysicsSimulator::new(Vector2::new(0.0, SLOPE))?;
        simulator.set_methods(Methods::PRECISE)?;
        let ball = BodyFactory::create_circle_body_in(&mut simulator, BALL, 1.0)?;
        let round =
            GeomFactory::create_circle_geom_in(&mut simulator, ball, BALL, 16, GeomPlacement::default())?;
        simulator[ball].set_is_bullet(true);
        simulator[ball].set_linear_drag_coefficient(0.0);
        simulator[round].set_restitution_coefficient(0.4);
        simulator[round].set_collision_categories(BALLS);
        let game = Game { balls: BALLS_OF_A_GAME, ball: Some((ball, round)), ..Game::default() };
        let flippers = [add_flipper(&mut simulator, 1.0)?, add_flipper(&mut simulator, -1.0)?];
        let mut table = Pinball { simulator, dispatch: Dispatch::new(), game, ball, flippers };
        table.add_walls()?;
        table.add_things()?;
        table.add_ramp()?;
        set_up(&mut table.simulator, &mut table.game);
        Ok(table)
    }

    /// The simulator, to look at.
    pub fn simulator(&self) -> &PhysicsSimulator {
        &self.simulator
    }

    /// The simulator, to meddle with it.
    pub fn simulator_mut(&mut self) -> &mut PhysicsSimulator {
        &mut self.simulator
    }

    /// The game.
    pub fn game(&self) -> &Game {
        &self.game
    }

    /// The ball.
    pub fn ball(&self) -> BodyId {
        self.ball
    }

    /// The bodies of both flippers.
    pub fn flippers(&self) -> [BodyId; 2] {
        [self.flippers[0].body, self.flippers[1].body]
    }

    /// Whether the ball waits for [`launch`](Self::launch).
    pub fn is_waiting(&self) -> bool {
        let ball = &self.simulator[self.ball];
        self.game.balls > 0
            && ball.position().x > 385.0
            && ball.position().y > 600.0
            && ball.linear_velocity().norm() < 5.0
    }

    /// Shoots the ball onto the table.
    pub fn launch(&mut self) {
        self.simulator[self.ball].set_linear_velocity_y(-LAUNCH);
    }

    /// Raises or lowers a flipper: its spring seeks another angle.
    ///
    /// # Errors
    /// None.
    pub fn flip(&mut self, side: Side, is_raised: bool) -> Result<()> {
        let Flipper { spring, sign, .. } = self.flippers[side as usize];
        self.simulator[spring].set_target_angle(sign * ANGLES[usize::from(is_raised)])?;
        Ok(())
    }

    /// An update.
    pub fn step(&mut self) {
        self.simulator.update_with(1.0 / RATE as f32, &mut self.dispatch.with(&mut self.game));
    }

    /// A wall about a point, turned clockwise.
    fn add_wall(
        &mut self,
        size: [f32; 2],
        [x, y]: [f32; 2],
        rotation: f32,
        level: CollisionCategory,
    ) -> Result<GeomId> {
        let simulator = &mut self.simulator;
        let body = BodyFactory::create_rectangle_body_in(simulator, size[0], size[1], 1.0)?;
        simulator[body].set_is_static(true);
        simulator[body].set_position(Vector2::new(x, y));
        simulator[body].set_rotation(rotation);
        let placement = GeomPlacement::with_grid_size(5.0);
        let geom = GeomFactory::create_rectangle_geom_in(simulator, body, size[0], size[1], placement)?;
        simulator[geom].set_collision_categories(level);
        simulator[geom].set_collision_group(FRAME);
        simulator[geom].set_restitution_coefficient(0.4);
        self.game.things.insert(geom, Thing::Wall { size, is_above: level == ABOVE });
        Ok(geom)
    }

    fn add_walls(&mut self) -> Result<()> {
        let [width, height] = TABLE;
        for (size, middle, rotation) in [
            ([20.0, height], [0.0, height / 2.0], 0.0),
            ([20.0, height], [width + 5.0, height / 2.0], 0.0),
            ([width, 20.0], [width / 2.0, 0.0], 0.0),
            // The lane of the plunger, the corner that leads out of it, and its bottom.
            ([8.0, 480.0], [386.0, 460.0], 0.0),
            ([130.0, 10.0], [385.0, 45.0], 0.8),
            ([90.0, 10.0], [30.0, 35.0], -0.8),
            ([30.0, 10.0], [403.0, 660.0], 0.0),
            // To the flippers.
            ([120.0, 10.0], [58.0, 560.0], 0.55),
            ([120.0, 10.0], [334.0, 560.0], -0.55),
        ] {
            self.add_wall(size, middle, rotation, BELOW)?;
        }
        let drain = self.add_wall([width, 10.0], [width / 2.0, height + 20.0], 0.0, BELOW)?;
        self.simulator.set_is_sensor(drain, true)?;
        self.game.things.remove(drain);
        self.dispatch.on_collision(drain, lose_ball);
        Ok(())
    }

    fn add_things(&mut self) -> Result<()> {
        for (middle, radius) in [([140.0, 210.0], 26.0), ([250.0, 190.0], 26.0), ([195.0, 290.0], 30.0)] {
            let geom = self.add_round(radius, middle)?;
            self.game.things.insert(geom, Thing::Bumper { radius });
            self.dispatch.on_collision(geom, bump);
        }
        for x in [110.0, 195.0, 280.0] {
            let geom = self.add_round(12.0, [x, 105.0])?;
            self.simulator.set_is_sensor(geom, true)?;
            self.game.things.insert(geom, Thing::Light { is_on: false });
            self.dispatch.on_collision(geom, light);
        }
        Ok(())
    }

    fn add_round(&mut self, radius: f32, [x, y]: [f32; 2]) -> Result<GeomId> {
        let body = BodyFactory::create_circle_body_in(&mut self.simulator, radius, 1.0)?;
        self.simulator[body].set_is_static(true);
        self.simulator[body].set_position(Vector2::new(x, y));
        let placement = GeomPlacement::default();
        let geom = GeomFactory::create_circle_geom_in(&mut self.simulator, body, radius, 24, placement)?;
        self.simulator[geom].set_collision_categories(BELOW);
        Ok(geom)
    }

    /// A ramp over the table: a ball that comes up into its mouth collides with its rails alone until the way out.
    fn add_ramp(&mut self) -> Result<()> {
        self.add_wall([8.0, 220.0], [274.0, 330.0], 0.0, ABOVE)?;
        self.add_wall([8.0, 220.0], [326.0, 330.0], 0.0, ABOVE)?;
        for (y, handler) in [(420.0, enter_ramp as Touches), (215.0, leave_ramp as Touches)] {
            let mouth = self.add_wall([44.0, 8.0], [300.0, y], 0.0, BELOW | ABOVE)?;
            self.simulator.set_is_sensor(mouth, true)?;
            self.game.things.remove(mouth);
            self.dispatch.on_collision(mouth, handler);
        }
        Ok(())
    }
}

type Touches = fn(&mut Game, &mut Context<'_>, GeomId, GeomId, &mut Vec<Contact>) -> bool;

/// A bar on a hinge, which a spring holds at an angle.
fn add_flipper(simulator: &mut PhysicsSimulator, sign: f32) -> Result<Flipper> {
    let [length, thickness] = FLIPPER;
    let hinge = Vector2::new(196.0 - sign * 86.0, 596.0);
    let body = BodyFactory::create_rectangle_body_in(simulator, length, thickness, 4.0)?;
    simulator[body].set_position(hinge + Vector2::new(sign * 0.5 * length, 0.0));
    let placement = GeomPlacement::with_grid_size(3.0);
    let geom = GeomFactory::create_rectangle_geom_in(simulator, body, length, thickness, placement)?;
    simulator[geom].set_collision_categories(BELOW);
    simulator[geom].set_collides_with(BALLS);
    simulator[geom].set_collision_group(FRAME);
    JointFactory::create_fixed_revolute_joint_in(simulator, body, hinge)?;
    let [low, high] = if sign > 0.0 { [ANGLES[1], ANGLES[0]] } else { [-ANGLES[0], -ANGLES[1]] };
    JointFactory::create_fixed_angle_limit_joint_in(simulator, body, low, high)?;
    let spring = SpringFactory::create_fixed_angle_spring_in(simulator, body, SPRING[0], SPRING[1])?;
    let spring: TypedSpringId<FixedAngleSpring> = simulator.typed_spring(spring)?;
    simulator[spring].set_target_angle(sign * ANGLES[0])?;
    Ok(Flipper { body, spring, sign })
}

/// Puts the ball before the plunger: called by the game and by a handler alike.
fn set_up(objects: &mut Objects, game: &mut Game) {
    if let Some((ball, _)) = game.ball {
        objects[ball].set_position(Vector2::from(START));
        objects[ball].set_linear_velocity(Vector2::zeros());
        objects[ball].set_angular_velocity(0.0);
    }
    set_level(objects, game, false);
}

/// The ball is on the table or on the ramp.
fn set_level(objects: &mut Objects, game: &mut Game, is_above: bool) {
    game.is_above = is_above;
    if let Some((_, geom)) = game.ball {
        objects[geom].set_collides_with(if is_above { ABOVE } else { BELOW });
    }
}

fn lose_ball(game: &mut Game, context: &mut Context<'_>, _: GeomId, _: GeomId, _: &mut Vec<Contact>) -> bool {
    game.balls = game.balls.saturating_sub(1);
    set_up(context, game);
    true
}

fn bump(
    game: &mut Game,
    context: &mut Context<'_>,
    this: GeomId,
    other: GeomId,
    _: &mut Vec<Contact>,
) -> bool {
    let places = [this, other].map(|geom| context.body_of(geom).map(|body| context[body].position()));
    if let ([Some(here), Some(there)], Some(ball)) = (places, context.body_of(other)) {
        game.score += 100;
        context[ball].set_linear_velocity((there - here).normalize() * KICK);
    }
    true
}

fn light(game: &mut Game, _: &mut Context<'_>, this: GeomId, _: GeomId, _: &mut Vec<Contact>) -> bool {
    if game.things[this] == (Thing::Light { is_on: false }) {
        game.score += 50;
        game.things[this] = Thing::Light { is_on: true };
    }
    let mut lights: Vec<&mut Thing> = game
        .things
        .iter_mut()
        .map(|(_, thing)| thing)
        .filter(|thing| matches!(thing, Thing::Light { .. }))
        .collect();
    if lights.iter().all(|light| **light == Thing::Light { is_on: true }) {
        game.score += 1000;
        lights.iter_mut().for_each(|light| **light = Thing::Light { is_on: false });
    }
    true
}

fn enter_ramp(
    game: &mut Game,
    context: &mut Context<'_>,
    _: GeomId,
    ball: GeomId,
    _: &mut Vec<Contact>,
) -> bool {
    let rises = context.body_of(ball).is_some_and(|body| context[body].linear_velocity().y < 0.0);
    set_level(context, game, rises);
    true
}

fn leave_ramp(
    game: &mut Game,
    context: &mut Context<'_>,
    _: GeomId,
    _: GeomId,
    _: &mut Vec<Contact>,
) -> bool {
    if game.is_above {
        game.score += 500;
        game.ramps += 1;
        set_level(context, game, false);
    }
    true
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A table with the ball at a position.
    fn table_with_ball(position: [f32; 2], velocity: [f32; 2]) -> Pinball {
        let mut table = Pinball::new().unwrap();
        table.simulator[table.ball].set_position(Vector2::from(position));
        table.simulator[table.ball].set_linear_velocity(Vector2::from(velocity));
        table
    }

    fn play(table: &mut Pinball, seconds: f32) {
        (0..(seconds * RATE as f32) as u32).for_each(|_| table.step());
    }

    #[test]
    fn a_ball_that_is_lost_waits_before_the_plunger_as_the_next_one() {
        let mut table = table_with_ball([196.0, 620.0], [0.0, 100.0]);
        play(&mut table, 2.0);
        assert_eq!(table.game.balls, BALLS_OF_A_GAME - 1);
        assert!(table.is_waiting());
    }

    #[test]
    fn a_ball_that_comes_up_into_the_ramp_passes_over_the_table_and_one_that_comes_down_does_not_get_in() {
        let mut table = table_with_ball([300.0, 470.0], [0.0, -700.0]);
        play(&mut table, 0.2);
        assert!(table.game.is_above);
        play(&mut table, 0.4);
        assert!(!table.game.is_above && table.game.ramps == 1 && table.game.score >= 500);
        let mut table = table_with_ball([300.0, 400.0], [0.0, 50.0]);
        play(&mut table, 0.3);
        assert!(!table.game.is_above && table.game.ramps == 0);
    }

    #[test]
    fn a_raised_flipper_throws_the_ball_up_the_table() {
        let mut table = Pinball::new().unwrap();
        // Until the flippers hang.
        play(&mut table, 0.3);
        table.simulator[table.ball].set_position(Vector2::new(160.0, 600.0));
        play(&mut table, 0.1);
        table.flip(Side::Left, true).unwrap();
        let mut highest = f32::MAX;
        for _ in 0..RATE {
            table.step();
            highest = highest.min(table.simulator[table.ball].position().y);
        }
        assert!(highest < 400.0, "{highest}");
    }

    #[test]
    fn three_lights_are_worth_more_than_each_and_go_out() {
        let mut table = Pinball::new().unwrap();
        for x in [110.0, 195.0, 280.0] {
            table.simulator[table.ball].set_position(Vector2::new(x, 105.0));
            table.simulator[table.ball].set_linear_velocity(Vector2::zeros());
            table.step();
        }
        assert_eq!(table.game.score, 3 * 50 + 1000);
        let is_on = |thing: &Thing| *thing == Thing::Light { is_on: true };
        assert!(!table.game.things.iter().any(|(_, thing)| is_on(thing)));
    }
}
