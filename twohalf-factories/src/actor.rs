//! Somebody who is steered: a figure that walks, what it faces, and how long it is stunned.

use serde::{Deserialize, Serialize};
use twohalf::{GeomId, Result, TwoHalfPhysicsSimulator, Vector3, Walk, Walker, Wish};

use crate::{Blow, Spawned, Thing, spawn, strike};

/// So long is a step, px, for the pictures of a walk.
const STEP: f32 = 40.0;

/// A figure that walks, with what games keep beside it: plain data, kept and saved where the game keeps its figures.
///
/// ```
/// use twohalf::{TwoHalfPhysicsSimulator, Vector2, Wish};
/// use twohalf_factories::{Actor, Blow, Figure};
///
/// const STEP: f32 = 1.0 / 60.0;
/// let mut simulator = TwoHalfPhysicsSimulator::with_gravity(480, Vector2::new(0.0, 900.0))?;
/// let figure = |x: f32| Figure::new([30.0, 60.0, 20.0]).at([x, 0.0, 50.0]);
/// let mut player = Actor::spawn(&mut simulator, figure(0.0))?;
/// let mut thug = Actor::spawn(&mut simulator, figure(160.0))?;
/// for step in 0..120 {
///     player.act(&mut simulator, Wish { x: 150.0, ..Wish::default() }, STEP)?;
///     // It comes nearer, until it is struck.
///     let could = thug.act(&mut simulator, Wish { x: -60.0, ..Wish::default() }, STEP)?;
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
    /// Its body and geom.
    pub thing: Spawned,
    /// How it walks, and what it stands on. In the air it has the [acceleration](Walk::air_acceleration) of `air_acceleration`.
    pub walker: Walker,
    /// What it can do in the air, px/s²: nothing while it is stunned.
    pub air_acceleration: f32,
    /// Whether it looks to the left: where it wished to go last.
    pub looks_left: bool,
    /// How far it has walked, in steps of 40 px, by what was wished: somebody who pushes at a wall walks.
    pub stride: f32,
    /// For so many seconds of its own time nothing that is wished happens.
    pub stunned: f32,
    /// For so many seconds of its own time it is not to strike again; what it does about that is for the game.
    pub rests: f32,
}

impl Actor {
    /// Makes a [figure](crate::Figure) that walks as [`Walk`] does by default, and adds it to the simulator.
    ///
    /// # Errors
    /// As [`spawn`].
    pub fn spawn(simulator: &mut TwoHalfPhysicsSimulator, figure: Thing) -> Result<Self> {
        let thing = spawn(simulator, figure)?;
        let walk = Walk::default();
        Ok(Actor {
            thing,
            walker: Walker::new(walk),
            air_acceleration: walk.air_acceleration,
            looks_left: false,
            stride: 0.0,
            stunned: 0.0,
            rests: 0.0,
        })
    }

    /// Before an update of `dt` s: it [walks](TwoHalfPhysicsSimulator::walk) as is wished, unless it is stunned or its time stands
    /// still, and answers whether it does. Stunned, it goes on flying as it was thrown, and is braked where it lands.
    ///
    /// # Errors
    /// As [`walk`](TwoHalfPhysicsSimulator::walk).
    pub fn act(&mut self, simulator: &mut TwoHalfPhysicsSimulator, wish: Wish, dt: f32) -> Result<bool> {
        let scale = simulator.time_scale(self.thing.body);
        if scale == 0.0 {
            return Ok(false);
        }
        let time = dt * scale;
        let is_stunned = self.stunned > 0.0;
        self.stunned = (self.stunned - time).max(0.0);
        self.rests = (self.rests - time).max(0.0);
        let wish = if is_stunned { Wish::default() } else { wish };
        self.walker.walk.air_acceleration = if is_stunned { 0.0 } else { self.air_acceleration };
        simulator.walk(self.thing.body, &mut self.walker, wish, dt)?;
        if wish.x != 0.0 {
            self.looks_left = wish.x < 0.0;
        }
        self.stride += time * Vector3::new(wish.x, 0.0, wish.z).norm() / STEP;
        Ok(!is_stunned)
    }

    /// [Strikes](strike) to where it looks.
    ///
    /// # Errors
    /// As [`strike`].
    pub fn strike(
        &self,
        simulator: &mut TwoHalfPhysicsSimulator,
        blow: &Blow,
        is_target: impl FnMut(GeomId) -> bool,
    ) -> Result<Vec<GeomId>> {
        strike(simulator, self.thing, self.looks_left, blow, is_target)
    }

    /// Where it stands, px, Y up; (0, 0, 0) if it is there no more.
    pub fn place(&self, simulator: &TwoHalfPhysicsSimulator) -> Vector3 {
        self.thing.place(simulator)
    }
}

impl Spawned {
    /// Its [`position3d`](twohalf::TwoHalfBody::position3d); (0, 0, 0) if it is there no more.
    pub fn place(&self, simulator: &TwoHalfPhysicsSimulator) -> Vector3 {
        simulator.body(self.body).map_or(Vector3::zeros(), |body| body.position3d())
    }
}
