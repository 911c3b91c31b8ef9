//! Actors: a character controller with facing direction, stun and rest times.

use serde::{Deserialize, Serialize};
use twohalf::{
    CharacterController, CharacterSettings, GeomId, MoveInput, Result, TwoHalfPhysicsSimulator, Vector3,
};

use crate::{Blow, Spawned, Thing, spawn, strike};

/// Length of a stride for walking animations, px.
const STRIDE_LENGTH: f32 = 40.0;

/// A character with the data that games keep beside it. It is plain data: the game keeps and saves it.
///
/// ```
/// use twohalf::{TwoHalfPhysicsSimulator, Vector2, MoveInput};
/// use twohalf_factories::{Actor, Blow, Figure};
///
/// const STEP: f32 = 1.0 / 60.0;
/// let mut simulator = TwoHalfPhysicsSimulator::with_gravity(480, Vector2::new(0.0, 900.0))?;
/// let figure = |x: f32| Figure::new([30.0, 60.0, 20.0]).at([x, 0.0, 50.0]);
/// let mut player = Actor::spawn(&mut simulator, figure(0.0))?;
/// let mut thug = Actor::spawn(&mut simulator, figure(160.0))?;
/// for step in 0..120 {
///     player.act(&mut simulator, MoveInput { x: 150.0, ..MoveInput::default() }, STEP)?;
///     // It comes nearer, until it is struck.
///     let could = thug.act(&mut simulator, MoveInput { x: -60.0, ..MoveInput::default() }, STEP)?;
///     assert!(could || step >= 40);
///     if step == 40 {
///         let struck = player.strike(&mut simulator, &Blow::default(), |_| true)?;
///         assert_eq!(struck, [thug.thing.geom]);
///         thug.stunned = 0.6;
///     }
///     simulator.update(STEP);
/// }
/// assert!(!player.looks_left && thug.looks_left);
/// assert!(thug.place(&simulator).x > 160.0);
/// # Ok::<(), twohalf::Error>(())
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct Actor {
    /// Body and geom of the character.
    pub thing: Spawned,
    /// Character controller. In the air it has the [acceleration](CharacterSettings::air_acceleration) of
    /// `air_acceleration`.
    pub walker: CharacterController,
    /// Acceleration in the air, px/s²; while it is stunned it has none.
    pub air_acceleration: f32,
    /// Whether it faces left: the direction of the last input.
    pub looks_left: bool,
    /// Distance that its input has led it, as a number of strides of 40 px; a character that pushes a wall
    /// walks as well.
    pub stride: f32,
    /// Rest of the stun, s of its own time, in which input has no effect.
    pub stunned: f32,
    /// Rest time before the next strike, s of its own time; the game decides its use.
    pub rests: f32,
}

impl Actor {
    /// Spawns a [figure](crate::Figure) with default [`CharacterSettings`].
    ///
    /// # Errors
    /// The errors of [`spawn`].
    pub fn spawn(simulator: &mut TwoHalfPhysicsSimulator, figure: Thing) -> Result<Self> {
        let thing = spawn(simulator, figure)?;
        let walk = CharacterSettings::default();
        Ok(Actor {
            thing,
            walker: CharacterController::new(walk),
            air_acceleration: walk.air_acceleration,
            looks_left: false,
            stride: 0.0,
            stunned: 0.0,
            rests: 0.0,
        })
    }

    /// Call before an update of `dt` s: it [walks](TwoHalfPhysicsSimulator::walk) by the input, unless it is
    /// stunned or its time is stopped. Returns whether the input had an effect. A stunned character keeps
    /// its flight and is braked where it lands.
    ///
    /// # Errors
    /// The errors of [`walk`](TwoHalfPhysicsSimulator::walk).
    pub fn act(&mut self, simulator: &mut TwoHalfPhysicsSimulator, wish: MoveInput, dt: f32) -> Result<bool> {
        let scale = simulator.time_scale(self.thing.body);
        if scale == 0.0 {
            return Ok(false);
        }
        let time = dt * scale;
        let is_stunned = self.stunned > 0.0;
        self.stunned = (self.stunned - time).max(0.0);
        self.rests = (self.rests - time).max(0.0);
        let wish = if is_stunned { MoveInput::default() } else { wish };
        self.walker.walk.air_acceleration = if is_stunned { 0.0 } else { self.air_acceleration };
        simulator.walk(self.thing.body, &mut self.walker, wish, dt)?;
        if wish.x != 0.0 {
            self.looks_left = wish.x < 0.0;
        }
        self.stride += time * Vector3::new(wish.x, 0.0, wish.z).norm() / STRIDE_LENGTH;
        Ok(!is_stunned)
    }

    /// [Strikes](strike) in its facing direction.
    ///
    /// # Errors
    /// The errors of [`strike`].
    pub fn strike(
        &self,
        simulator: &mut TwoHalfPhysicsSimulator,
        blow: &Blow,
        is_target: impl FnMut(GeomId) -> bool,
    ) -> Result<Vec<GeomId>> {
        strike(simulator, self.thing, self.looks_left, blow, is_target)
    }

    /// Position, px, Y up; (0, 0, 0) for a stale id.
    pub fn place(&self, simulator: &TwoHalfPhysicsSimulator) -> Vector3 {
        self.thing.place(simulator)
    }
}

impl Spawned {
    /// Its [`position3d`](twohalf::TwoHalfBody::position3d), px; (0, 0, 0) for a stale id.
    pub fn place(&self, simulator: &TwoHalfPhysicsSimulator) -> Vector3 {
        simulator.body(self.body).map_or(Vector3::zeros(), |body| body.position3d())
    }
}
