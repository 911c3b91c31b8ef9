//! Loads altered saves. They must be rejected, or the loaded simulator must be as usable as any other.

mod bytes;
pub(crate) mod trees;

use crate::engine::Engine;
use crate::game::{Game, Outcome, draw};
use crate::random::Random;
use crate::twins::{restored, through_json};

/// Number of updates in which a loaded simulator is used.
const UPDATES: usize = 100;
/// Greatest number of calls that are made with a loaded simulator.
const MAX_CALLS: usize = 1000;
/// Number of updates after which all numbers of the simulator are checked.
const CHECK_INTERVAL: usize = 10;
/// Greatest number of iterations per update of a loaded simulator. The number is part of a save, so an altered save may have a
/// large one.
const MOST_ITERATIONS: i32 = 50;

/// Outcome of loading an altered save.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum SaveOutcome {
    /// The simulator refused the save.
    Refused,
    /// The simulator loaded the save and was used.
    Used,
}

/// Alters the bytes of a snapshot, in most cases corrects its checksum, and restores a simulator from it.
///
/// # Errors
/// If the loaded simulator fails a check, or if a rejected save has changed the simulator.
pub fn altered_snapshot<G: Game>(seed: u64) -> Result<SaveOutcome, String> {
    let mut random = Random::new(seed.wrapping_mul(7919));
    let (mut snapshot, other) = (base::<G>(&mut random).snapshot(), base::<G>(&mut random).snapshot());
    bytes::alter(&mut snapshot, &other, &mut random);
    if random.chance(98) {
        bytes::mend(&mut snapshot);
    }
    let mut simulator = base::<G>(&mut random);
    let before = simulator.snapshot();
    match simulator.restore(&snapshot) {
        Ok(()) => use_loaded::<G>(simulator, random).map(|()| SaveOutcome::Used),
        Err(_) if simulator.snapshot() == before => Ok(SaveOutcome::Refused),
        Err(_) => Err("what was refused changed something".into()),
    }
}

/// Alters the JSON of a simulator and loads a simulator from it.
///
/// # Errors
/// If the loaded simulator fails a check.
pub fn altered_json<G: Game>(seed: u64) -> Result<SaveOutcome, String> {
    let mut random = Random::new(seed.wrapping_mul(7919));
    let mut tree = serde_json::to_value(base::<G>(&mut random)).map_err(|error| error.to_string())?;
    for _ in 0..1 + random.below(3) {
        trees::alter(&mut tree, &mut random);
    }
    match serde_json::from_str(&tree.to_string()) {
        Ok(simulator) => use_loaded::<G>(simulator, random).map(|()| SaveOutcome::Used),
        Err(_) => Ok(SaveOutcome::Refused),
    }
}

/// Returns a simulator in the middle of a scene.
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
    for _ in 0..MAX_CALLS {
        let call = draw::<G>(game.random());
        if (call.make)(&mut game) == Outcome::Updated {
            updates += 1;
            if updates % CHECK_INTERVAL == 0 {
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
