//! Plays a game several times with simulators that are saved and loaded in between, and compares these twins.

use serde_json::{Value, json};

use crate::engine::Engine;
use crate::game::{Game, Outcome, play};
use crate::random::Random;
use crate::recording::StateHashes;

/// Probability, in percent, that a twin is replaced by its copy after an update.
const CHECK_PERCENT: u64 = 20;

/// A function that returns a copy of the given simulator, which must continue like it. The second argument is an older copy
/// that the function may overwrite.
type Copy<E> = fn(&E, E) -> Result<E, String>;

/// Returns all functions that copy a simulator, with their names.
fn twins<E: Engine>() -> [(&'static str, Copy<E>); 5] {
    [
        ("restored", |simulator, _| restored(simulator)),
        ("gone back without geoms", |simulator, _| same_bytes(simulator, simulator.restored_moving()?)),
        ("cloned", |simulator, _| Ok(simulator.clone())),
        ("cloned over an older one", |simulator, mut older| {
            older.clone_from(simulator);
            Ok(older)
        }),
        ("through JSON", |simulator, _| through_json(simulator)),
    ]
}

/// Returns a simulator that was restored from the snapshot of the given one.
pub(crate) fn restored<E: Engine>(simulator: &E) -> Result<E, String> {
    let mut copy = E::empty();
    copy.restore(&simulator.snapshot())
        .map_err(|refusal| format!("its own snapshot is refused: {refusal}"))?;
    same_bytes(simulator, copy)
}

/// Returns a simulator that was loaded from the JSON of the given one.
pub(crate) fn through_json<E: Engine>(simulator: &E) -> Result<E, String> {
    let refused = |refusal: serde_json::Error| format!("its own JSON is refused: {refusal}");
    let text = serde_json::to_string(simulator).map_err(refused)?;
    same_bytes(simulator, serde_json::from_str(&text).map_err(refused)?)
}

fn same_bytes<E: Engine>(simulator: &E, copy: E) -> Result<E, String> {
    if copy.snapshot() == simulator.snapshot() {
        return Ok(copy);
    }
    let [before, after] = [simulator, &copy].map(|it| serde_json::to_value(it).unwrap_or_default());
    Err(format!("the copy is saved otherwise{}", place_of_difference(&before, &after)))
}

/// Returns the first position at which two states differ, as the end of a sentence.
fn place_of_difference(one: &Value, other: &Value) -> String {
    first_difference(one, other).map_or_else(String::new, |place| format!(", at {place}"))
}

/// Plays the game of a seed and its twins. Checks that they have equal snapshots and events after each update.
///
/// # Errors
/// Names the first difference and its place in the state.
pub fn twins_stay_equal<G: Game>(seed: u64) -> Result<(), String> {
    let plain = seen::<G, _>(seed, None, |_, simulator| StateHashes::of(simulator))?;
    twins().into_iter().try_for_each(|(name, copy)| {
        let twin = seen::<G, _>(seed, Some(copy), |_, simulator| StateHashes::of(simulator))
            .map_err(|what| format!("{name}: {what}"))?;
        let Err((update, what)) = equal(&plain, &twin) else { return Ok(()) };
        let state = |copy| seen::<G, _>(seed, copy, |number, simulator| state_at(update, number, simulator));
        let place = place_of_difference(&state(None)?[update], &state(Some(copy))?[update]);
        Err(format!("{name}: {what}{place}"))
    })
}

/// Returns the state and the events of a simulator after update `update`, null after every other one.
fn state_at(update: usize, number: usize, simulator: &impl Engine) -> Value {
    if number != update {
        return Value::Null;
    }
    let state = serde_json::to_value(simulator).unwrap_or_default();
    json!({ "state": state, "events": simulator.events().split("}, ").collect::<Vec<_>>() })
}

/// Returns the path to the first number or text at which two states differ, with both values. `None` if the states are equal.
fn first_difference(one: &Value, other: &Value) -> Option<String> {
    match (one, other) {
        (Value::Object(one), Value::Object(other)) if one.len() == other.len() => {
            one.iter().find_map(|(name, value)| {
                Some(format!(".{name}{}", first_difference(value, other.get(name).unwrap_or(&Value::Null))?))
            })
        }
        (Value::Array(one), Value::Array(other)) if one.len() == other.len() => {
            let mut items = one.iter().zip(other).enumerate();
            items.find_map(|(at, (one, other))| Some(format!("[{at}]{}", first_difference(one, other)?)))
        }
        // Values are compared as text, so that 0 and -0 differ.
        _ => {
            let [one, other] = [one, other].map(Value::to_string);
            (one != other).then(|| format!(": {one} and {other}"))
        }
    }
}

/// Plays the game of a seed and returns the results of `see` after each update.
fn seen<G: Game, T>(
    seed: u64,
    copy: Option<Copy<G::Simulator>>,
    see: impl Fn(usize, &G::Simulator) -> T,
) -> Result<Vec<T>, String> {
    let mut random = Random::new(seed ^ 0x0f0f);
    let (mut all, mut older) = (Vec::new(), G::Simulator::empty());
    let after = |game: &mut G, outcome| {
        if outcome != Outcome::Updated {
            return Ok(());
        }
        all.push(see(all.len(), game.simulator()));
        match copy {
            Some(copy) if random.chance(CHECK_PERCENT) => exchange(game, copy, &mut older),
            _ => Ok(()),
        }
    };
    play(seed, |_| (), after)?;
    Ok(all)
}

fn exchange<G: Game>(game: &mut G, copy: Copy<G::Simulator>, older: &mut G::Simulator) -> Result<(), String> {
    let limits = game.simulator().limits();
    let mut copy = copy(game.simulator(), std::mem::replace(older, G::Simulator::empty()))?;
    copy.set_limits(limits);
    *older = std::mem::replace(game.simulator_mut(), copy);
    Ok(())
}

fn equal(plain: &[StateHashes], twin: &[StateHashes]) -> Result<(), (usize, String)> {
    let Some(update) = (0..plain.len().max(twin.len())).find(|&update| plain.get(update) != twin.get(update))
    else {
        return Ok(());
    };
    let differs = |part: fn(&StateHashes) -> crate::hash::Hash| {
        plain.get(update).map(part) != twin.get(update).map(part)
    };
    let parts = [
        ("motion", differs(|moment| moment.motion)),
        ("events", differs(|moment| moment.events)),
        ("snapshot", differs(|moment| moment.snapshot)),
    ];
    let names: Vec<&str> = parts.iter().filter(|part| part.1).map(|part| part.0).collect();
    Err((update, format!("update {update} of {} differs in {}", plain.len(), names.join(", "))))
}
