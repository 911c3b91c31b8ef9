//! A character mover: a figure that walks, jumps and falls over the shapes of a simulator, by casts and without forces. Ours.
//!
//! The order of a move follows M. Thorson, "Celeste & TowerFall Physics" (2018): what moves carries and pushes the figure
//! first, then the figure moves by its own velocity. Slopes, steps and snapping follow the character controllers of rapier and
//! PhysX: casts with a skin.

mod obstacles;
mod options;
mod shape;
mod step;
mod travel;

use serde::{Deserialize, Serialize};

use self::obstacles::Obstacles;
use self::shape::MoverShape;
use self::step::Step;
use super::finite;
use crate::body::BodyId;
use crate::builders::GeomBuilder;
use crate::geom::GeomId;
use crate::math::Vector2;
use crate::math::finite::positive;
use crate::simulator::PhysicsSimulator;
use crate::{Error, Result};

pub use options::{MoverInput, MoverOptions};

/// A contact of a mover.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct MoverTouch {
    /// The touched geom.
    pub geom: GeomId,
    /// Its body.
    pub body: BodyId,
    /// Point on the geom, in the world, in length units.
    pub point: Vector2,
    /// Unit vector from the geom to the mover. On the edge of a step it is that of the step's top.
    pub normal: Vector2,
}

/// The outcome of a move: contacts and events.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct MoverReport {
    /// The ground that the mover stands on; `None` in the air.
    pub ground: Option<MoverTouch>,
    /// A wall on the left that stopped it, or a slope that is too steep.
    pub left: Option<MoverTouch>,
    /// A wall on the right that stopped it, or a slope that is too steep.
    pub right: Option<MoverTouch>,
    /// A ceiling that stopped it.
    pub ceiling: Option<MoverTouch>,
    /// A body that is in the mover and cannot push it out of itself. The mover is left where no static body overlaps it.
    pub crushed_by: Option<BodyId>,
    /// Whether a jump began.
    pub jumped: bool,
    /// Whether the mover came from the air to the ground.
    pub landed: bool,
    /// Speed downward at which it landed, in length units/s, 0 or more.
    pub landing_speed: f32,
}

/// The ground of a mover at the end of a move.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
struct Ground {
    geom: GeomId,
    body: BodyId,
    /// Contact in the world, in length units.
    point: Vector2,
    /// Unit normal of the surface, from the ground to the mover.
    normal: Vector2,
    /// Pose of the body: position in length units, and rotation in radians with full turns.
    position: Vector2,
    rotation: f32,
}

/// State of a mover between two moves: plain data that a game saves, or keeps for rollback.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct MoverState {
    /// Position of the shape's origin, in length units.
    position: Vector2,
    /// Velocity relative to `carried`, in length units/s.
    velocity: Vector2,
    /// Velocity of the ground, or the horizontal one of the last ground in the air, in length units/s.
    carried: Vector2,
    ground: Option<Ground>,
    /// Time since the mover last stood, in s. It is huge after a jump.
    aloft: f32,
    /// Time since the jump key was pressed, in s. It is huge after a jump.
    since_press: f32,
    /// Whether the jump key was held in the last move.
    is_held: bool,
    /// Whether the mover rises by a jump that releasing the key may cut.
    is_rising: bool,
    /// Height of the soles at which it dropped through one-way geoms that it has not left yet, in length units, y down.
    drop_level: Option<f32>,
}

/// A character that walks, jumps and falls: in a game that is no port, the figure of the player, or of whoever walks.
///
/// Call [`update`](Self::update) once after each update of the simulator, with the same time step.
///
/// - On the ground its speed along X approaches that of the input, as seen from above, on level ground and on slopes up to
///   [`max_slope`](MoverOptions::max_slope). It stands on these without sliding. Steeper ones are walls, down which it slides.
/// - It steps up edges up to [`step_up`](MoverOptions::step_up), and follows the ground down by [`snap`](MoverOptions::snap).
/// - Moving, turning and dynamic bodies, and belts, carry it exactly. Kinematic bodies push it; one that has no room to push it
///   to is [reported](MoverReport::crushed_by).
/// - [One-way](GeomBuilder::one_way) geoms let it through from behind, and down with [`MoverInput::drop`].
/// - It pushes dynamic bodies with at most [`push_force`](MoverOptions::push_force), and its weight acts on those it stands on.
/// - Jumps have the set height at every time step, the [coyote time](MoverOptions::coyote_time), the
///   [buffer](MoverOptions::jump_buffer), and the [cut](MoverOptions::jump_cut) of a key that is released.
///
/// Up is -Y: of gravity its Y component acts. The mover does not rotate. It keeps a small gap to all things, of a thousandth of
/// its size and at least eight steps of rounding of its position.
///
/// It has no body of its own: casts and rays do not see it, and things fall through it. [`set_body`](Self::set_body) gives it a
/// kinematic one, which follows it.
///
/// ```
/// use farseer_core::{BodyBuilder, CharacterMover, GeomBuilder, MoverInput, MoverOptions, PhysicsSimulator};
/// let mut simulator = PhysicsSimulator::precise([0.0, 900.0])?;
/// simulator.add_body(BodyBuilder::fixed().position([0.0, 10.0]), [GeomBuilder::rectangle(1000.0, 20.0)])?;
/// let mut hero = CharacterMover::new(&GeomBuilder::capsule(60.0, 12.0), [0.0, -40.0], MoverOptions::default())?;
/// for _ in 0..60 {
///     simulator.update(1.0 / 60.0);
///     let input = MoverInput { x: 150.0, ..MoverInput::default() };
///     let report = hero.update(&mut simulator, input, 1.0 / 60.0)?;
///     if report.landed { /* dust */ }
/// }
/// assert!(hero.is_grounded() && (hero.velocity().x - 150.0).abs() < 0.01);
/// # Ok::<(), farseer_core::Error>(())
/// ```
#[derive(Debug, Clone)]
#[doc(alias("KinematicCharacterController", "CharacterController", "b2World_CastMover"))]
pub struct CharacterMover {
    /// Options; they may change at any time.
    pub options: MoverOptions,
    state: MoverState,
    body: Option<BodyId>,
    shape: MoverShape,
    obstacles: Obstacles,
}

impl CharacterMover {
    /// A mover with a convex shape, in the air at a position, without a body. `shape` is that of a [`GeomBuilder`], with its
    /// offset and rotation offset; other properties have no effect. `position` is in length units.
    ///
    /// # Errors
    /// A shape that is not possible or not convex; a position that is not finite; options out of their ranges.
    pub fn new(shape: &GeomBuilder, position: impl Into<Vector2>, options: MoverOptions) -> Result<Self> {
        let position = finite("position", position.into())?;
        options.check()?;
        let state = MoverState {
            position,
            velocity: Vector2::zeros(),
            carried: Vector2::zeros(),
            ground: None,
            aloft: f32::MAX,
            since_press: f32::MAX,
            is_held: false,
            is_rising: false,
            drop_level: None,
        };
        let shape = MoverShape::new(shape)?;
        Ok(CharacterMover { options, state, body: None, shape, obstacles: Obstacles::default() })
    }

    /// Gives the mover a kinematic body, which follows it and which it does not collide with, so that queries, sensors and
    /// dynamic bodies meet it. The body is the game's: a mover that is dropped leaves it.
    ///
    /// ```
    /// use farseer_core::{BodyBuilder, CharacterMover, GeomBuilder, MoverInput, MoverOptions, PhysicsSimulator};
    /// let mut simulator = PhysicsSimulator::precise([0.0, 900.0])?;
    /// let shape = GeomBuilder::capsule(60.0, 12.0);
    /// let mut hero = CharacterMover::new(&shape, [0.0, 0.0], MoverOptions::default())?;
    /// let (body, _) = simulator.add_body(BodyBuilder::kinematic(), [shape])?;
    /// hero.set_body(Some(body));
    /// hero.update(&mut simulator, MoverInput::default(), 1.0 / 60.0)?;
    /// assert_eq!(simulator[body].position(), hero.position());
    /// # Ok::<(), farseer_core::Error>(())
    /// ```
    pub fn set_body(&mut self, body: Option<BodyId>) {
        self.body = body;
    }

    /// The body that follows the mover.
    pub fn body(&self) -> Option<BodyId> {
        self.body
    }

    /// Moves the mover for one step of `dt` s: after each update of the simulator, with its time step.
    ///
    /// # Errors
    /// Options out of their ranges; an input that is not finite; a `dt` that is not finite and greater than 0; a body that is
    /// stale or not kinematic. No state has changed then.
    pub fn update(
        &mut self,
        simulator: &mut PhysicsSimulator,
        input: MoverInput,
        dt: f32,
    ) -> Result<MoverReport> {
        self.options.check()?;
        crate::math::finite::finite("input.x", input.x)?;
        positive("dt", dt)?;
        if let Some(id) = self.body {
            let body = simulator.body(id).ok_or(Error::StaleId { argument: "body" })?;
            if !body.is_kinematic() {
                return Err(Error::invalid("body", id, "a kinematic one"));
            }
        }
        let mut step = Step::new(self, simulator, input, dt);
        step.ride();
        step.push_out();
        step.steer();
        step.travel();
        let (state, report) = step.finish();
        self.state = state;
        if let Some(body) = self.body {
            simulator[body].set_position(state.position);
            // A lift takes the body along, so that it does not squeeze what stands between.
            simulator[body].set_linear_velocity(state.carried);
        }
        Ok(report)
    }

    /// Position of the shape's origin, in length units.
    pub fn position(&self) -> Vector2 {
        self.state.position
    }

    /// Puts the mover to a place, in the air: its velocity stays. Walls between do not stop it.
    ///
    /// # Errors
    /// A position that is not finite.
    pub fn set_position(&mut self, position: impl Into<Vector2>) -> Result<()> {
        self.state.position = finite("position", position.into())?;
        self.leave_ground();
        Ok(())
    }

    /// Velocity in the world, in length units/s, y down. On the ground it has no component along Y but that of the ground.
    pub fn velocity(&self) -> Vector2 {
        self.state.velocity + self.state.carried
    }

    /// Throws the mover off the ground with a velocity in the world, in length units/s, y down: a blow, a spring, a dash.
    ///
    /// # Errors
    /// A velocity that is not finite.
    pub fn launch(&mut self, velocity: impl Into<Vector2>) -> Result<()> {
        let velocity = finite("velocity", velocity.into())?;
        self.leave_ground();
        self.state.velocity = velocity - self.state.carried;
        Ok(())
    }

    /// Whether it stands. Games choose the animation by it.
    pub fn is_grounded(&self) -> bool {
        self.state.ground.is_some()
    }

    /// State between two moves, for saves and rollback.
    pub fn state(&self) -> MoverState {
        self.state
    }

    /// Goes back to a state of this mover. With the simulator of that moment, it goes on with the same bits.
    ///
    /// # Errors
    /// A loaded state with numbers that are not finite.
    pub fn set_state(&mut self, state: MoverState) -> Result<()> {
        for vector in [state.position, state.velocity, state.carried] {
            finite("state", vector)?;
        }
        let ground = state.ground.iter();
        for vector in ground.flat_map(|ground| [ground.point, ground.normal, ground.position]) {
            finite("state", vector)?;
        }
        let rotation = state.ground.map_or(0.0, |ground| ground.rotation);
        for number in [rotation, state.aloft, state.since_press, state.drop_level.unwrap_or(0.0)] {
            crate::math::finite::finite("state", number)?;
        }
        self.state = state;
        Ok(())
    }

    fn leave_ground(&mut self) {
        let state = &mut self.state;
        state.velocity.y += state.carried.y;
        state.carried.y = 0.0;
        (state.ground, state.aloft, state.is_rising, state.drop_level) = (None, f32::MAX, false, None);
    }
}
