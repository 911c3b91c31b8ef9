//! Random games of the 2.5D engine with joints, springs, ropes and fields, which come and go amid the others' play.

mod calls;
pub(crate) mod links;

use farseer_core::{JointId, SpringId};
use twohalf::FieldId;

use crate::around::Around;
use crate::depth::Depth;
use crate::game::{Call, Game};
use crate::random::Random;

/// A game of the engine with depth, and what ties its things and pushes them.
#[derive(Debug)]
pub struct Tied {
    depth: Depth,
    joints: Vec<JointId>,
    springs: Vec<SpringId>,
    fields: Vec<FieldId>,
}

impl Around for Tied {
    type Inner = Depth;

    fn begin(random: Random) -> Depth {
        // Where joints act in depth.
        Depth::precise(random)
    }
    fn around(depth: Depth) -> Self {
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
