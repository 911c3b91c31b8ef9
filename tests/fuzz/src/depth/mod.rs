//! Random games of the 2.5D engine.

mod calls;
mod create;
mod edits;
mod handler;
mod numbers;
mod pools;
mod queries;

use farseer_core::math::Vector2;
use farseer_core::{NarrowPhaseCollider, PhysicsSimulator};
use twohalf::{DepthScheme, Result, TwoHalfPhysicsSimulator, Vector3};

use create::create_thing;
pub(crate) use numbers::check_numbers;

use crate::game::{Call, Game};
use crate::plane;
use crate::random::Random;
use crate::scenes;
use pools::Pools;

/// A game of the 2.5D engine: its simulator, and ids with which to call it.
#[derive(Debug)]
pub struct Depth {
    random: Random,
    simulator: TwoHalfPhysicsSimulator,
    pools: Pools,
}

impl Game for Depth {
    type Simulator = TwoHalfPhysicsSimulator;
    const SCENES: usize = scenes::KINDS;

    fn new(random: Random) -> Self {
        Depth::try_new(random).expect("ordinary arguments are accepted")
    }
    fn of(simulator: TwoHalfPhysicsSimulator, random: Random) -> Self {
        Depth::with(simulator, random).expect("ordinary arguments are accepted")
    }
    fn scene(kind: usize) -> TwoHalfPhysicsSimulator {
        scenes::depth(kind).expect("ordinary arguments are accepted")
    }
    fn calls() -> &'static [Call<Self>] {
        calls::CALLS
    }
    fn random(&mut self) -> &mut Random {
        &mut self.random
    }
    fn simulator(&self) -> &TwoHalfPhysicsSimulator {
        &self.simulator
    }
    fn simulator_mut(&mut self) -> &mut TwoHalfPhysicsSimulator {
        &mut self.simulator
    }
}

impl Depth {
    fn try_new(mut random: Random) -> Result<Self> {
        let gravity = if random.chance(70) { 200.0 } else { 0.0 };
        let mut core = PhysicsSimulator::new(Vector2::new(0.0, gravity))?;
        core.set_broad_phase_collider(plane::broad_phase(&mut random)).ok();
        if random.toss() {
            core.set_narrow_phase_collider(NarrowPhaseCollider::Sat);
        }
        let angle = 1 + random.below(179) as i32;
        let mut simulator = TwoHalfPhysicsSimulator::from_core(600, angle, core)?;
        match random.below(10) {
            0 | 1 => simulator.set_depth_scheme(DepthScheme::Thesis)?,
            2..6 => simulator.set_depth_scheme(DepthScheme::Precise)?,
            _ => {}
        }
        Depth::with(simulator, random)
    }

    /// Returns a game of the precise scheme. The simulator has no geoms yet, so it cannot refuse the scheme.
    pub(crate) fn precise(random: Random) -> Self {
        let mut depth = Depth::new(random);
        depth.simulator.set_depth_scheme(DepthScheme::Precise).expect("it is empty");
        depth
    }

    /// Returns the simulator and the source of random numbers, both for changes.
    pub(crate) fn parts(&mut self) -> (&mut TwoHalfPhysicsSimulator, &mut Random) {
        (&mut self.simulator, &mut self.random)
    }

    fn with(mut simulator: TwoHalfPhysicsSimulator, random: Random) -> Result<Self> {
        simulator.set_limits(plane::LIMITS);
        let mut pools = Pools::foreign()?;
        pools.take_all(&simulator);
        Ok(Depth { random, simulator, pools })
    }
}

/// Returns a random position above the ground in px, or one with wild numbers.
fn place(random: &mut Random) -> Vector3 {
    Vector3::new(random.number(-120.0, 120.0), random.number(0.0, 200.0), random.number(0.0, 120.0))
}
