//! The same game, played with simulators that are saved and loaded in between.

use crate::engine::Engine;
use crate::game::{Game, Outcome, play};
use crate::random::Random;
use crate::recording::Moment;

/// How often in a hundred updates a twin is exchanged for its copy.
const OFTEN: u64 = 20;

/// Makes a simulator that must go on as the given one does; may use what was exchanged for a copy last, some updates ago.
type Copy<E> = fn(&E, E) -> Result<E, String>;

/// Every way there is to make one.
fn twins<E: Engine>() -> [(&'static str, Copy<E>); 4] {
    [
        ("restored", |simulator, _| restored(simulator)),
        ("cloned", |simulator, _| Ok(simulator.clone())),
        ("cloned over an older one", |simulator, mut older| {
            older.clone_from(simulator);
            Ok(older)
        }),
        ("through JSON", |simulator, _| through_json(simulator)),
    ]
}

/// From its own snapshot.
pub(crate) fn restored<E: Engine>(simulator: &E) -> Result<E, String> {
    let mut copy = E::empty();
    copy.restore(&simulator.snapshot())
        .map_err(|refusal| format!("its own snapshot is refused: {refusal}"))?;
    same_bytes(simulator, copy)
}

/// From its own JSON.
pub(crate) fn through_json<E: Engine>(simulator: &E) -> Result<E, String> {
    let refused = |refusal: serde_json::Error| format!("its own JSON is refused: {refusal}");
    let text = serde_json::to_string(simulator).map_err(refused)?;
    same_bytes(simulator, serde_json::from_str(&text).map_err(refused)?)
}

fn same_bytes<E: Engine>(simulator: &E, copy: E) -> Result<E, String> {
    if copy.snapshot() == simulator.snapshot() { Ok(copy) } else { Err("the copy is saved otherwise".into()) }
}

/// A game and its twins have equal snapshots and events after each update.
///
/// # Errors
/// The first difference.
pub fn twins_stay_equal<G: Game>(seed: u64) -> Result<(), String> {
    let plain = moments::<G>(seed, None)?;
    twins().into_iter().try_for_each(|(name, copy)| {
        let twin = moments::<G>(seed, Some(copy)).map_err(|what| format!("{name}: {what}"))?;
        equal(&plain, &twin).map_err(|what| format!("{name}: {what}"))
    })
}

fn moments<G: Game>(seed: u64, copy: Option<Copy<G::Simulator>>) -> Result<Vec<Moment>, String> {
    let mut random = Random::new(seed ^ 0x0f0f);
    let (mut moments, mut older) = (Vec::new(), G::Simulator::empty());
    let after = |game: &mut G, outcome| {
        if outcome != Outcome::Updated {
            return Ok(());
        }
        moments.push(Moment::of(game.simulator()));
        match copy {
            Some(copy) if random.chance(OFTEN) => exchange(game, copy, &mut older),
            _ => Ok(()),
        }
    };
    play(seed, |_| (), after)?;
    Ok(moments)
}

fn exchange<G: Game>(game: &mut G, copy: Copy<G::Simulator>, older: &mut G::Simulator) -> Result<(), String> {
    let limits = game.simulator().limits();
    let mut copy = copy(game.simulator(), std::mem::replace(older, G::Simulator::empty()))?;
    copy.set_limits(limits);
    *older = std::mem::replace(game.simulator_mut(), copy);
    Ok(())
}

fn equal(plain: &[Moment], twin: &[Moment]) -> Result<(), String> {
    let Some(update) = (0..plain.len().max(twin.len())).find(|&update| plain.get(update) != twin.get(update))
    else {
        return Ok(());
    };
    let differs =
        |part: fn(&Moment) -> crate::hash::Hash| plain.get(update).map(part) != twin.get(update).map(part);
    let parts = [
        ("motion", differs(|moment| moment.motion)),
        ("events", differs(|moment| moment.events)),
        ("snapshot", differs(|moment| moment.snapshot)),
    ];
    let names: Vec<&str> = parts.iter().filter(|part| part.1).map(|part| part.0).collect();
    Err(format!("update {update} of {} differs in {}", plain.len(), names.join(", ")))
}
