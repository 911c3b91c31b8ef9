//! Saves that were altered: they are refused, or what was loaded can be used like any other simulator.

mod bytes;
pub(crate) mod trees;

use crate::engine::Engine;
use crate::game::{Game, Outcome, draw};
use crate::random::Random;
use crate::twins::{restored, through_json};

/// Updates for which a simulator that was loaded is used.
const UPDATES: usize = 100;
/// Calls between them, at most.
const CALLS: usize = 1000;
/// Numbers are looked at after every so many updates.
const EVERY: usize = 10;
/// Passes per update are the game's own affair, and may be many.
const MOST_ITERATIONS: i32 = 50;

/// What became of an altered save.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Fate {
    /// It was refused.
    Refused,
    /// It was loaded and used.
    Used,
}

/// Alters the bytes of a snapshot and mends its checksum, most of the time.
///
/// # Errors
/// What goes wrong with what was loaded, or a refusal that changed something.
pub fn altered_snapshot<G: Game>(seed: u64) -> Result<Fate, String> {
    let mut random = Random::new(seed.wrapping_mul(7919));
    let (mut snapshot, other) = (base::<G>(&mut random).snapshot(), base::<G>(&mut random).snapshot());
    bytes::alter(&mut snapshot, &other, &mut random);
    if random.chance(98) {
        bytes::mend(&mut snapshot);
    }
    let mut simulator = base::<G>(&mut random);
    let before = simulator.snapshot();
    match simulator.restore(&snapshot) {
        Ok(()) => use_loaded::<G>(simulator, random).map(|()| Fate::Used),
        Err(_) if simulator.snapshot() == before => Ok(Fate::Refused),
        Err(_) => Err("what was refused changed something".into()),
    }
}

/// Alters the JSON of a simulator.
///
/// # Errors
/// What goes wrong with what was loaded.
pub fn altered_json<G: Game>(seed: u64) -> Result<Fate, String> {
    let mut random = Random::new(seed.wrapping_mul(7919));
    let mut tree = serde_json::to_value(base::<G>(&mut random)).map_err(|error| error.to_string())?;
    for _ in 0..1 + random.below(3) {
        trees::alter(&mut tree, &mut random);
    }
    match serde_json::from_str(&tree.to_string()) {
        Ok(simulator) => use_loaded::<G>(simulator, random).map(|()| Fate::Used),
        Err(_) => Ok(Fate::Refused),
    }
}

/// A scene in the middle of its run.
fn base<G: Game>(random: &mut Random) -> G::Simulator {
    let mut simulator = G::scene(random.below(G::SCENES));
    for _ in 0..20 + random.below(40) {
        simulator.update(0.01);
    }
    simulator
}

fn use_loaded<G: Game>(mut simulator: G::Simulator, random: Random) -> Result<(), String> {
    simulator.limit_iterations(MOST_ITERATIONS);
    simulator.check_numbers().map_err(|what| format!("once loaded {what}"))?;
    save_and_load(&simulator).map_err(|what| format!("once loaded {what}"))?;
    let mut game = G::of(simulator, random);
    let mut updates = 0;
    for _ in 0..CALLS {
        let call = draw::<G>(game.random());
        if (call.make)(&mut game) == Outcome::Updated {
            updates += 1;
            if updates % EVERY == 0 {
                let numbers = game.simulator().check_numbers();
                numbers.map_err(|what| format!("after {updates} updates {what}"))?;
            }
        }
        if updates == UPDATES {
            break;
        }
    }
    save_and_load(game.simulator()).map_err(|what| format!("after {updates} updates {what}"))
}

fn save_and_load(simulator: &impl Engine) -> Result<(), String> {
    restored(simulator)?;
    through_json(simulator)?;
    Ok(())
}
