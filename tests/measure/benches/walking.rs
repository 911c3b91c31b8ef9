//! Measures the cost of walking characters: a crowd of them and crates in a street, with and without `walk`.
//!
//! `cargo bench -p measure --bench walking` prints the time per step of 200 figures that mill about among 200 crates. It
//! measures the calls of [`walk`](twohalf::TwoHalfPhysicsSimulator::walk) and the update separately.

use std::time::{Duration, Instant};

use twohalf::{BodyId, CharacterController, CharacterSettings, MoveInput, TwoHalfPhysicsSimulator, Vector2};
use twohalf_factories::{Figure, Prism, spawn};

const DT: f32 = 1.0 / 60.0;
const FIGURES: usize = 200;
const CRATES: usize = 200;
const UPDATES: usize = 300;
const ROUNDS: usize = 9;
/// Space of each object in the street, px along X and along Z.
const ROOM: [f32; 2] = [70.0, 50.0];
/// Number of objects side by side, across the street.
const LANES: usize = 10;

fn street() -> (TwoHalfPhysicsSimulator, Vec<(BodyId, CharacterController)>) {
    let mut simulator =
        TwoHalfPhysicsSimulator::with_gravity(600, Vector2::new(0.0, 900.0)).expect("a height");
    let mut figures = Vec::new();
    for at in 0..FIGURES + CRATES {
        let place = [(at / LANES) as f32 * ROOM[0], 0.0, (at % LANES) as f32 * ROOM[1]];
        let is_figure = at % 2 == 0;
        let thing =
            if is_figure { Figure::new([30.0, 60.0, 20.0]) } else { Prism::new([40.0; 3]).mass(20.0) };
        let made = spawn(&mut simulator, thing.at(place)).expect("sizes and masses above 0");
        if is_figure {
            figures.push((made.body, CharacterController::new(CharacterSettings::default())));
        }
    }
    (simulator, figures)
}

/// Returns the total times of all calls of `walk` and of all updates.
fn run() -> [Duration; 2] {
    let (mut simulator, mut figures) = street();
    let mut times = [Duration::ZERO; 2];
    for step in 0..UPDATES {
        let start = Instant::now();
        for (at, (body, walker)) in figures.iter_mut().enumerate() {
            let (z, x) = (2.4 * at as f32 + step as f32 * DT).sin_cos();
            let wish = MoveInput { x: 120.0 * x, z: 60.0 * z, jump: (step + 7 * at) % 240 == 0 };
            simulator.walk(*body, walker, wish, DT).expect("a figure");
        }
        let walked = Instant::now();
        simulator.update(DT);
        times[0] += walked - start;
        times[1] += walked.elapsed();
    }
    times
}

fn main() {
    let mut rounds: Vec<[f64; 2]> =
        (0..ROUNDS).map(|_| run().map(|time| time.as_secs_f64() * 1e6 / UPDATES as f64)).collect();
    rounds.sort_by(|a, b| (a[0] + a[1]).total_cmp(&(b[0] + b[1])));
    let [walks, update] = rounds[ROUNDS / 2];
    println!("{FIGURES} figures, {CRATES} crates, per step: walk {walks:.1} us, update {update:.1} us");
}
