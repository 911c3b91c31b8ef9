//! Random games of the 2.5D engine with joints, springs, ropes and fields, which come and go amid the others' play.

mod calls;
mod links;

use farseer_core::{JointId, SpringId};
use twohalf::{DepthScheme, FieldId, TwoHalfPhysicsSimulator};

use crate::depth::Depth;
use crate::game::{Call, Game};
use crate::random::Random;
use crate::scenes;

/// A game of the engine with depth, and what ties its things and pushes them.
#[derive(Debug)]
pub struct Tied {
    depth: Depth,
    joints: Vec<JointId>,
    springs: Vec<SpringId>,
    fields: Vec<FieldId>,
}

impl Game for Tied {
    type Simulator = TwoHalfPhysicsSimulator;
    const SCENES: usize = scenes::KINDS;

    fn new(random: Random) -> Self {
        let mut depth = Depth::new(random);
        // Where joints act in depth; there are no geoms yet that it could be refused for.
        depth.simulator_mut().set_depth_scheme(DepthScheme::Precise).expect("it is empty");
        Tied { depth, joints: vec![], springs: vec![], fields: vec![] }
    }
    fn of(simulator: TwoHalfPhysicsSimulator, random: Random) -> Self {
        let joints = simulator.core().joint_list().to_vec();
        let springs = simulator.core().spring_list().to_vec();
        let fields = simulator.fields().map(|(id, _)| id).collect();
        Tied { depth: Depth::of(simulator, random), joints, springs, fields }
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
