//! Random games of the 2.5D engine that make and remove joints, springs, ropes and fields, between the calls of another game.

mod calls;
pub(crate) mod links;

use farseer_core::{JointId, SpringId};
use twohalf::FieldId;

use crate::around::GameWrapper;
use crate::depth::Depth;
use crate::game::{Call, Game};
use crate::random::Random;

/// A game of the engine with depth, with joints, springs, ropes and force fields.
#[derive(Debug)]
pub struct Tied {
    depth: Depth,
    joints: Vec<JointId>,
    springs: Vec<SpringId>,
    fields: Vec<FieldId>,
}

impl GameWrapper for Tied {
    type Inner = Depth;

    fn begin(random: Random) -> Depth {
        // The precise scheme is the one in which joints act along the depth axis.
        Depth::precise(random)
    }
    fn wrap(depth: Depth) -> Self {
        let simulator = depth.simulator();
        let joints = simulator.core().joint_list().to_vec();
        let springs = simulator.core().spring_list().to_vec();
        let fields = simulator.fields().map(|(id, _)| id).collect();
        Tied { depth, joints, springs, fields }
    }
    fn calls() -> &'static [Call<Self>] {
        calls::CALLS
    }
    fn inner(&self) -> &Depth {
        &self.depth
    }
    fn inner_mut(&mut self) -> &mut Depth {
        &mut self.depth
    }
}
