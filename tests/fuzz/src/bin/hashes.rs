//! Plays varied scenes and prints hashes of their states, which can be compared between platforms and builds.
//!
//! Each scene has a line: its name, and hashes of motion, events and snapshots over all of its updates. The last line has the
//! hashes of all scenes.

use fuzz::churn::{Churn, DepthChurn};
use fuzz::game::{Game, Outcome, play};
use fuzz::recording::StateHashes;
use fuzz::{Depth, Engine, Plane, Tied, Upright, scenes};
use std::sync::atomic::{AtomicUsize, Ordering};

/// Number of updates of a scene that is not a random game.
const UPDATES: usize = 150;
/// Number of random games of the 2D engine. Their seeds start at 0.
const PLANE_GAMES: u64 = 60;
const DEPTH_GAMES: u64 = 60;
/// Number of games with joints, ropes and fields, and number of games with vertical shapes and rotating platforms.
const TIED_GAMES: u64 = 15;
const UPRIGHT_GAMES: u64 = 15;
/// Number of 2.5D scenes in which objects of all kinds are added and removed, one for each seed.
const CHURNS: u64 = 6;

/// A scene by name, and the function that plays it.
type NamedScene = (String, Box<dyn Fn() -> StateHashes + Sync>);

fn main() {
    let scenes = named_scenes();
    let all = play_all(&scenes);
    for ((name, _), &hashes) in scenes.iter().zip(&all) {
        println!("{}", line(name, hashes));
    }
    println!("{}", line("all", StateHashes::all(&all)));
}

/// Returns all scenes, in the order of the output.
fn named_scenes() -> Vec<NamedScene> {
    let mut scenes: Vec<NamedScene> = Vec::new();
    let mut add = |name: String, play: Box<dyn Fn() -> StateHashes + Sync>| scenes.push((name, play));
    let accepted = "its arguments are accepted";
    for kind in 0..scenes::KINDS {
        let plane = move || stepped(scenes::plane(kind).expect(accepted), |it| it.update(0.01));
        add(format!("plane-{kind}"), Box::new(plane));
        let depth = move || stepped(scenes::depth(kind).expect(accepted), |it| it.update(1.0 / 60.0));
        add(format!("depth-{kind}"), Box::new(depth));
    }
    for kind in 0..scenes::PRECISE_KINDS {
        let precise = move || stepped(scenes::precise(kind).expect(accepted), |it| it.update(1.0 / 60.0));
        add(format!("precise-{kind}"), Box::new(precise));
    }
    for seed in 0..CHURNS {
        add(format!("churn-{seed}"), Box::new(move || churned(DepthChurn::new(seed).expect(accepted))));
    }
    (0..PLANE_GAMES)
        .for_each(|seed| add(format!("plane-game-{seed}"), Box::new(move || played::<Plane>(seed))));
    (0..DEPTH_GAMES)
        .for_each(|seed| add(format!("depth-game-{seed}"), Box::new(move || played::<Depth>(seed))));
    (0..TIED_GAMES).for_each(|seed| add(format!("tied-game-{seed}"), Box::new(move || played::<Tied>(seed))));
    (0..UPRIGHT_GAMES)
        .for_each(|seed| add(format!("upright-game-{seed}"), Box::new(move || played::<Upright>(seed))));
    scenes
}

/// Plays all scenes, on as many threads as the machine has processors, and returns their hashes in the order of the scenes.
/// WebAssembly has one thread.
fn play_all(scenes: &[NamedScene]) -> Vec<StateHashes> {
    let workers = std::thread::available_parallelism().map_or(1, usize::from);
    if workers == 1 || cfg!(target_family = "wasm") {
        return scenes.iter().map(|(_, play)| play()).collect();
    }
    let next = AtomicUsize::new(0);
    let work = || {
        let mut played = Vec::new();
        loop {
            let at = next.fetch_add(1, Ordering::Relaxed);
            let Some((_, play)) = scenes.get(at) else { return played };
            played.push((at, play()));
        }
    };
    let mut played: Vec<(usize, StateHashes)> = std::thread::scope(|scope| {
        let threads: Vec<_> = (0..workers).map(|_| scope.spawn(work)).collect();
        threads.into_iter().flat_map(|thread| thread.join().expect("scenes do not panic")).collect()
    });
    played.sort_unstable_by_key(|(at, _)| *at);
    played.into_iter().map(|(_, hashes)| hashes).collect()
}

fn line(name: &str, StateHashes { motion, events, snapshot }: StateHashes) -> String {
    let [motion, events, snapshot] = [motion, events, snapshot].map(|hash| hash.value());
    format!("{name:15} {motion:016x} {events:016x} {snapshot:016x}")
}

fn stepped<E: Engine>(mut simulator: E, step: impl Fn(&mut E)) -> StateHashes {
    let mut moment = || {
        step(&mut simulator);
        StateHashes::of(&simulator)
    };
    StateHashes::all(&(0..UPDATES).map(|_| moment()).collect::<Vec<_>>())
}

fn churned(mut churn: impl Churn) -> StateHashes {
    let mut moment = |update| {
        churn.go_on(update).expect("it takes what comes");
        StateHashes::of(churn.simulator())
    };
    StateHashes::all(&(0..UPDATES).map(&mut moment).collect::<Vec<_>>())
}

fn played<G: Game>(seed: u64) -> StateHashes {
    let mut moments = Vec::new();
    let played = play::<G>(
        seed,
        |_| (),
        |game, outcome| {
            if outcome == Outcome::Updated {
                moments.push(StateHashes::of(game.simulator()));
            }
            Ok(())
        },
    );
    played.expect("nothing was checked");
    StateHashes::all(&moments)
}
