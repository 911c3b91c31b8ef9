//! Random games of the 2.5D engine with what stands upright, and platforms that are turned or rise along Z, amid the others' play.

mod calls;

use crate::around::Around;
use crate::depth::Depth;
use crate::game::Call;
use crate::random::Random;
pub(crate) use calls::swing;

/// A game of the engine with depth, in which things become upright.
#[derive(Debug)]
pub struct Upright {
    depth: Depth,
}

impl Around for Upright {
    type Inner = Depth;

    fn begin(random: Random) -> Depth {
        // No other scheme knows what is upright.
        Depth::precise(random)
    }
    fn around(depth: Depth) -> Self {
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
