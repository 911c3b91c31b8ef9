//! Plays varied scenes and prints hashes of their states, which can be compared between platforms and builds.
//!
//! Each scene has a line: its name, and hashes of motion, events and snapshots over all of its updates. The last line has the
//! hashes of all scenes.

use fuzz::churn::{Churn, DepthChurn};
use fuzz::game::{Game, Outcome, play};
use fuzz::recording::StateHashes;
use fuzz::{Depth, Engine, Plane, Tied, Upright, scenes};

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

fn main() {
    let mut all = Vec::new();
    for kind in 0..scenes::KINDS {
        let scene = scenes::plane(kind).expect("its arguments are accepted");
        say(&mut all, &format!("plane-{kind}"), stepped(scene, |simulator| simulator.update(0.01)));
        let scene = scenes::depth(kind).expect("its arguments are accepted");
        say(&mut all, &format!("depth-{kind}"), stepped(scene, |simulator| simulator.update(1.0 / 60.0)));
    }
    for kind in 0..scenes::PRECISE_KINDS {
        let scene = scenes::precise(kind).expect("its arguments are accepted");
        say(&mut all, &format!("precise-{kind}"), stepped(scene, |simulator| simulator.update(1.0 / 60.0)));
    }
    for seed in 0..CHURNS {
        let churn = DepthChurn::new(seed).expect("its arguments are accepted");
        say(&mut all, &format!("churn-{seed}"), churned(churn));
    }
    (0..PLANE_GAMES).for_each(|seed| say(&mut all, &format!("plane-game-{seed}"), played::<Plane>(seed)));
    (0..DEPTH_GAMES).for_each(|seed| say(&mut all, &format!("depth-game-{seed}"), played::<Depth>(seed)));
    (0..TIED_GAMES).for_each(|seed| say(&mut all, &format!("tied-game-{seed}"), played::<Tied>(seed)));
    (0..UPRIGHT_GAMES)
        .for_each(|seed| say(&mut all, &format!("upright-game-{seed}"), played::<Upright>(seed)));
    println!("{}", line("all", StateHashes::all(&all)));
}

fn say(all: &mut Vec<StateHashes>, name: &str, scene: StateHashes) {
    println!("{}", line(name, scene));
    all.push(scene);
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
