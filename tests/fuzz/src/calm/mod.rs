//! Games with few calls and many updates, so that bodies come to rest, sleep, and wake.

mod depth;
mod plane;

pub use depth::CalmDepth;
pub use plane::CalmPlane;

use crate::game::{Game, Outcome, draw};
use crate::random::Random;

/// Greatest number of updates in a row, without another call between them.
const MOST_UPDATES: usize = 12;
/// Least and greatest mass, mass units. Every order of magnitude between them is equally likely.
const MASSES: (f32, f32) = (1e-3, 1e4);

/// Makes one of the calls of another game.
fn any_call<G: Game>(game: &mut G) -> Outcome {
    let call = draw::<G>(game.random());
    (call.make)(game)
}

/// Makes a random number of updates of 1/60 s, each by `update`.
fn rest<G: Game>(game: &mut G, mut update: impl FnMut(&mut G::Simulator, f32)) -> Outcome {
    for _ in 0..1 + game.random().below(MOST_UPDATES) {
        update(game.simulator_mut(), 1.0 / 60.0);
    }
    Outcome::Updated
}

fn mass(random: &mut Random) -> f32 {
    let (low, high) = MASSES;
    low * (high / low).powf(random.between(0.0, 1.0))
}
