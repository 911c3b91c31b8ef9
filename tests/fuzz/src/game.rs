//! A game that makes random calls to its simulator, chosen from a table of calls.

use crate::engine::Engine;
use crate::random::Random;

/// Number of calls at the beginning of a game that mostly create objects.
const OPENING_CALLS: u64 = 25;
/// Least number of calls of a game, and the number that no game reaches.
const CALLS: (usize, usize) = (30, 330);
/// Greatest number of geoms of a game, and greatest work of all its updates. A game that exceeds it continues with an empty
/// simulator, and all its ids are stale then. A crowd in one place would have hundreds of thousands of contacts in every
/// update.
const MAX_SIZE: Size = Size { geoms: 400, work: 100_000 };
/// Percentages of wild numbers among the random numbers of a game; each game has one of these.
const WILDNESS: [u64; 4] = [0, 1, 5, 15];

/// Size of a game: number of geoms, and work ([`Engine::work`]) of all updates.
struct Size {
    geoms: usize,
    work: usize,
}

/// Effect of a call on the simulator.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Outcome {
    /// The call may have changed the simulator.
    Changed,
    /// The call returned an error, so the simulator must be unchanged.
    Failed,
    /// The call only queried, or had no effect.
    Queried,
    /// The call was an update.
    Updated,
}

impl Outcome {
    /// Returns the outcome of a call that returned `result`: `Changed` or `Failed`.
    pub fn of<T, E>(result: Result<T, E>) -> Self {
        if result.is_ok() { Outcome::Changed } else { Outcome::Failed }
    }
}

/// An entry in the table of calls.
#[derive(Debug)]
pub struct Call<G> {
    /// Name of the call in reports.
    pub name: &'static str,
    /// Weight of the call, dimensionless: its probability relative to that of other calls.
    pub weight: usize,
    /// Function that makes the call.
    pub make: fn(&mut G) -> Outcome,
}

/// A game with a simulator and a pool of ids to call it with: ids of living objects, stale ids and foreign ids.
pub trait Game: Sized + 'static {
    /// Type of the simulator that the game calls.
    type Simulator: Engine;
    /// Number of [scenes](crate::scenes) of the engine.
    const SCENES: usize;

    /// Returns a game with an almost empty simulator.
    fn new(random: Random) -> Self;
    /// Returns a game that continues with a given simulator.
    fn of(simulator: Self::Simulator, random: Random) -> Self;
    /// Returns the simulator with the [scene](crate::scenes) of index `kind`.
    fn scene(kind: usize) -> Self::Simulator;
    /// Returns all calls of the game. The first call must make an object with a body and a geom.
    fn calls() -> &'static [Call<Self>];
    /// Returns the source of the game's random numbers.
    fn random(&mut self) -> &mut Random;
    /// Returns the simulator of the game.
    fn simulator(&self) -> &Self::Simulator;
    /// Returns the simulator of the game, to be changed or replaced.
    fn simulator_mut(&mut self) -> &mut Self::Simulator;
}

/// Returns the game of a seed and the number of calls that [`play`] makes in it.
pub fn start<G: Game>(seed: u64) -> (G, usize) {
    let mut random = Random::new(seed.wrapping_mul(0x9876_5432_1fed_cbab));
    let wildness = random.pick(&WILDNESS);
    let calls = CALLS.0 + random.below(CALLS.1 - CALLS.0);
    (G::new(random.with_wildness(wildness)), calls)
}

/// Plays the game of a seed. Calls `before` before every call of the game, and `after` after it.
///
/// # Errors
/// The first error of `after`, and the call that came before it.
pub fn play<G: Game>(
    seed: u64,
    mut before: impl FnMut(&G),
    mut after: impl FnMut(&mut G, Outcome) -> Result<(), String>,
) -> Result<(), String> {
    let (mut game, calls) = start::<G>(seed);
    let mut work = 0;
    for number in 0..calls {
        let call = next_call(&mut game, number as u64);
        before(&game);
        let outcome = (call.make)(&mut game);
        if outcome == Outcome::Updated {
            work += game.simulator().work();
        }
        if work > MAX_SIZE.work || game.simulator().geoms() > MAX_SIZE.geoms {
            work = 0;
            *game.simulator_mut() = G::Simulator::empty();
        }
        after(&mut game, outcome).map_err(|what| format!("call {number}, {}: {what}", call.name))?;
    }
    Ok(())
}

/// Draws the next call of a game that has made `number` calls.
fn next_call<G: Game>(game: &mut G, number: u64) -> &'static Call<G> {
    if number < OPENING_CALLS && game.random().chance(60) { &G::calls()[0] } else { draw(game.random()) }
}

/// Draws a call of a game at random, by weight.
pub(crate) fn draw<G: Game>(random: &mut Random) -> &'static Call<G> {
    let calls = G::calls();
    let mut place = random.below(calls.iter().map(|call| call.weight).sum());
    let mut chosen = 0;
    while place >= calls[chosen].weight {
        place -= calls[chosen].weight;
        chosen += 1;
    }
    &calls[chosen]
}
