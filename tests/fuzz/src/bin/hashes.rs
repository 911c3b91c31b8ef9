//! Plays varied scenes and prints hashes of them, to be compared between platforms and builds.
//!
//! A line per scene: its name, then hashes of motion, events and snapshots over all of its updates; the last line is of
//! all scenes.

use fuzz::churn::{Churn, DepthChurn};
use fuzz::game::{Game, Outcome, play};
use fuzz::recording::Moment;
use fuzz::{Depth, Engine, Plane, Tied, Upright, scenes};

/// Updates of a scene that is no game.
const UPDATES: usize = 150;
/// Seeds of random games, from 0.
const PLANE_GAMES: u64 = 60;
const DEPTH_GAMES: u64 = 60;
/// Of games with joints, ropes and fields, and of games with what stands upright and platforms that turn.
const TIED_GAMES: u64 = 15;
const UPRIGHT_GAMES: u64 = 15;
/// Seeds of scenes in which things of all kinds come and go, with depth.
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
    println!("{}", line("all", Moment::all(&all)));
}

fn say(all: &mut Vec<Moment>, name: &str, scene: Moment) {
    println!("{}", line(name, scene));
    all.push(scene);
}

fn line(name: &str, Moment { motion, events, snapshot }: Moment) -> String {
    let [motion, events, snapshot] = [motion, events, snapshot].map(|hash| hash.value());
    format!("{name:15} {motion:016x} {events:016x} {snapshot:016x}")
}

fn stepped<E: Engine>(mut simulator: E, step: impl Fn(&mut E)) -> Moment {
    let mut moment = || {
        step(&mut simulator);
        Moment::of(&simulator)
    };
    Moment::all(&(0..UPDATES).map(|_| moment()).collect::<Vec<_>>())
}

fn churned(mut churn: impl Churn) -> Moment {
    let mut moment = |update| {
        churn.go_on(update).expect("it takes what comes");
        Moment::of(churn.simulator())
    };
    Moment::all(&(0..UPDATES).map(&mut moment).collect::<Vec<_>>())
}

fn played<G: Game>(seed: u64) -> Moment {
    let mut moments = Vec::new();
    let played = play::<G>(
        seed,
        |_| (),
        |game, outcome| {
            if outcome == Outcome::Updated {
                moments.push(Moment::of(game.simulator()));
            }
            Ok(())
        },
    );
    played.expect("nothing was checked");
    Moment::all(&moments)
}
