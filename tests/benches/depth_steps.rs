//! Time per step of the 2.5D engine, averaged over the length of the scene.
//!
//! `cargo bench -p conformance --bench depth_steps`. Only the updates are measured, not the building of a scene.

use conformance::depth_scenes::{DepthScene, build, pile, traffic};
use divan::Bencher;
use divan::counter::ItemsCount;
use std::sync::Mutex;
use std::time::{Duration, Instant};

/// Objects of the scenes that are measured.
const TRAFFIC: [usize; 5] = [20, 40, 200, 1000, 10_000];
const PILES: [usize; 3] = [40, 200, 1000];
/// Steps that are measured: the first ones of every scene, in which everything moves.
const STEPS: usize = 300;

/// The median over the samples is what is printed at the end: ms per step.
static MEANS: Mutex<Vec<(String, Vec<Duration>)>> = Mutex::new(Vec::new());

/// Objects moving around on a field with platforms.
#[divan::bench(args = TRAFFIC, sample_count = 5, sample_size = 1)]
fn moving(bencher: Bencher<'_, '_>, count: usize) {
    measure(bencher, &traffic(count));
}

/// Objects falling into a heap.
#[divan::bench(args = PILES, sample_count = 5, sample_size = 1)]
fn piling(bencher: Bencher<'_, '_>, count: usize) {
    measure(bencher, &pile(count));
}

/// The first steps of a scene; divan counts steps per second.
fn measure(bencher: Bencher<'_, '_>, scene: &DepthScene) {
    bencher.counter(ItemsCount::new(STEPS)).with_inputs(|| build(scene).0).bench_local_values(
        |mut simulator| {
            let start = Instant::now();
            for _ in 0..STEPS {
                simulator.update(scene.dt);
            }
            note(&scene.name, start.elapsed() / STEPS as u32);
            simulator
        },
    );
}

fn note(name: &str, mean: Duration) {
    let mut means = MEANS.lock().unwrap_or_else(|error| error.into_inner());
    match means.iter_mut().find(|(known, _)| known == name) {
        Some((_, list)) => list.push(mean),
        None => means.push((name.to_owned(), vec![mean])),
    }
}

fn main() {
    divan::main();
    for (name, means) in MEANS.lock().unwrap_or_else(|error| error.into_inner()).iter_mut() {
        means.sort_unstable();
        println!("{name:<24} {:8.3} ms per step", means[means.len() / 2].as_secs_f64() * 1000.0);
    }
}
