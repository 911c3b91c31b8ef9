//! A game that calls its simulator at random, by a table of calls.

use crate::engine::Engine;
use crate::random::Random;

/// Calls at the beginning that make things, most of the time.
const OPENING: u64 = 25;
/// Most calls of a game, and fewest.
const CALLS: (usize, usize) = (30, 330);
/// Most geoms of a game, and most work of all its updates. A crowd in one place has hundreds of thousands of contacts in
/// every update; a game that has grown so large goes on with an empty simulator, and ids that are all stale.
const MOST: Size = Size { geoms: 400, work: 100_000 };
/// How many wild numbers in a hundred a game may use.
const WILDNESS: [u64; 4] = [0, 1, 5, 15];

/// How large a game is.
struct Size {
    geoms: usize,
    work: usize,
}

/// What a call says that it has done.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Outcome {
    /// It may have changed the simulator.
    Changed,
    /// It answered with an error: nothing may have changed.
    Failed,
    /// It only looked, or did nothing.
    Looked,
    /// It was an update.
    Updated,
}

impl Outcome {
    /// That of a call that answers with a result.
    pub fn of<T, E>(result: Result<T, E>) -> Self {
        if result.is_ok() { Outcome::Changed } else { Outcome::Failed }
    }
}

/// An entry of a table of calls.
#[derive(Debug)]
pub struct Call<G> {
    /// What to call it in reports.
    pub name: &'static str,
    /// How often it is made, relative to the others.
    pub weight: usize,
    /// Makes it.
    pub make: fn(&mut G) -> Outcome,
}

/// A simulator with a pool of ids to call it with: living, stale and foreign ones.
pub trait Game: Sized + 'static {
    /// The simulator that is called.
    type Simulator: Engine;
    /// Number of its [scenes](crate::scenes).
    const SCENES: usize;

    /// A game that begins with next to nothing.
    fn new(random: Random) -> Self;
    /// A game that goes on with a simulator.
    fn of(simulator: Self::Simulator, random: Random) -> Self;
    /// One of the [scenes](crate::scenes).
    fn scene(kind: usize) -> Self::Simulator;
    /// Everything it can do. The first makes a thing with body and geom.
    fn calls() -> &'static [Call<Self>];
    /// Where its numbers come from.
    fn random(&mut self) -> &mut Random;
    /// Its simulator.
    fn simulator(&self) -> &Self::Simulator;
    /// Its simulator, to be replaced.
    fn simulator_mut(&mut self) -> &mut Self::Simulator;
}

/// The game of a seed, as it is played by [`play`].
pub fn start<G: Game>(seed: u64) -> (G, usize) {
    let mut random = Random::new(seed.wrapping_mul(0x9876_5432_1fed_cbab));
    let wildness = random.pick(&WILDNESS);
    let calls = CALLS.0 + random.below(CALLS.1 - CALLS.0);
    (G::new(random.with_wildness(wildness)), calls)
}

/// Plays the game of a seed: before every call `before` may look at it, after it `after`.
///
/// # Errors
/// What `after` answers with, and the call after which it did.
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
        if work > MOST.work || game.simulator().geoms() > MOST.geoms {
            work = 0;
            *game.simulator_mut() = G::Simulator::empty();
        }
        after(&mut game, outcome).map_err(|what| format!("call {number}, {}: {what}", call.name))?;
    }
    Ok(())
}

/// The next call of a game that has made `number` of them.
fn next_call<G: Game>(game: &mut G, number: u64) -> &'static Call<G> {
    if number < OPENING && game.random().chance(60) { &G::calls()[0] } else { draw(game.random()) }
}

/// One of a game's calls, by weight.
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
