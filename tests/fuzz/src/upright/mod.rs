//! Random games of the 2.5D engine with what stands upright, and platforms that are turned or rise along Z, amid the others' play.

mod calls;

use twohalf::{DepthScheme, TwoHalfPhysicsSimulator};

use crate::depth::Depth;
use crate::game::{Call, Game};
use crate::random::Random;
use crate::scenes;

/// A game of the engine with depth, in which things become upright.
#[derive(Debug)]
pub struct Upright {
    depth: Depth,
}

impl Game for Upright {
    type Simulator = TwoHalfPhysicsSimulator;
    const SCENES: usize = scenes::KINDS;

    fn new(random: Random) -> Self {
        let mut depth = Depth::new(random);
        // No other one knows them; there are no geoms yet that it could be refused for.
        depth.simulator_mut().set_depth_scheme(DepthScheme::Precise).expect("it is empty");
        Upright { depth }
    }
    fn of(simulator: TwoHalfPhysicsSimulator, random: Random) -> Self {
        Upright { depth: Depth::of(simulator, random) }
    }
    fn scene(kind: usize) -> TwoHalfPhysicsSimulator {
        Depth::scene(kind)
    }
    fn calls() -> &'static [Call<Self>] {
        calls::CALLS
    }
    fn random(&mut self) -> &mut Random {
        self.depth.random()
    }
    fn simulator(&self) -> &TwoHalfPhysicsSimulator {
        self.depth.simulator()
    }
    fn simulator_mut(&mut self) -> &mut TwoHalfPhysicsSimulator {
        self.depth.simulator_mut()
    }
}
