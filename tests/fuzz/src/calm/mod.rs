//! Games in which little is called and much time passes, so that things come to rest, sleep, and wake.

mod depth;
mod plane;

pub use depth::CalmDepth;
pub use plane::CalmPlane;

use crate::game::{Game, Outcome, draw};
use crate::random::Random;

/// Most updates that follow each other without anything else.
const MOST_UPDATES: usize = 12;
/// Masses from a thousandth to ten thousand, of any order of magnitude.
const MASSES: (f32, f32) = (1e-3, 1e4);

/// One of the calls of another game.
fn any_call<G: Game>(game: &mut G) -> Outcome {
    let call = draw::<G>(game.random());
    (call.make)(game)
}

/// Makes updates of 1/60 s with `update`.
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
