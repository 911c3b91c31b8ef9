//! Random games of the 2.5D engine with vertical shapes, and with platforms that rotate or rise along Z, between the calls of
//! another game.

mod calls;

use crate::around::GameWrapper;
use crate::depth::Depth;
use crate::game::Call;
use crate::random::Random;
pub(crate) use calls::swing;

/// A game of the engine with depth, in which bodies become upright.
#[derive(Debug)]
pub struct Upright {
    depth: Depth,
}

impl GameWrapper for Upright {
    type Inner = Depth;

    fn begin(random: Random) -> Depth {
        // The precise scheme is the only one that has vertical shapes.
        Depth::precise(random)
    }
    fn wrap(depth: Depth) -> Self {
        Upright { depth }
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
