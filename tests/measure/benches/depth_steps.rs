//! Measures the time per step of the 2.5D engine, as a mean over the first steps of a scene.
//!
//! `cargo bench -p measure --bench depth_steps`. Only the updates are measured, not the building of a scene.

use conformance::run::Run;
use conformance::scenes::circles_in_a_pit;
use divan::Bencher;
use divan::counter::ItemsCount;
use farseer_core::PhysicsSimulator;
use measure::scenes::depth::{DepthScene, build, pile, traffic};
use std::sync::Mutex;
use std::time::{Duration, Instant};
use twohalf::{DrawOrder, TwoHalfPhysicsSimulator};

/// Numbers of objects of the scenes `traffic`.
const TRAFFIC: [usize; 5] = [20, 40, 200, 1000, 10_000];
const PILES: [usize; 3] = [40, 200, 1000];
const FLAT: [usize; 5] = [20, 40, 200, 1000, 10_000];
/// Length of a step of the pit, s.
const PIT_DT: f32 = 0.01;
/// Number of steps that are measured: the first ones of every scene, in which all objects move.
const STEPS: usize = 300;

/// Mean times per step of every sample, by scene. Their medians are printed at the end, in ms.
static MEANS: Mutex<Vec<(String, Vec<Duration>)>> = Mutex::new(Vec::new());

/// Measures steps of objects that move around on a field with platforms.
#[divan::bench(args = TRAFFIC, sample_count = 5, sample_size = 1)]
fn moving(bencher: Bencher<'_, '_>, count: usize) {
    measure(bencher, &traffic(count));
}

/// Measures the sorting of these objects: `DrawOrder` finds the order in which the objects of `moving` are drawn.
#[divan::bench(args = TRAFFIC, sample_count = 5, sample_size = 1)]
fn drawing_order(bencher: Bencher<'_, '_>, count: usize) {
    let make = || {
        let (mut simulator, _) = build(&traffic(count));
        (0..60).for_each(|_| simulator.update(PIT_DT));
        (simulator, DrawOrder::default())
    };
    time(bencher, &format!("drawing_order_{count}"), make, |(simulator, order)| {
        divan::black_box(order.sort(simulator));
    });
}

/// Measures steps of objects that fall into a heap.
#[divan::bench(args = PILES, sample_count = 5, sample_size = 1)]
fn piling(bencher: Bencher<'_, '_>, count: usize) {
    measure(bencher, &pile(count));
}

/// Measures steps of circles that fall into a pit, in 2D. `pit_2_5d` has the same scene in 2.5D, with all circles at one depth.
#[divan::bench(args = FLAT, sample_count = 5, sample_size = 1)]
fn pit_2d(bencher: Bencher<'_, '_>, count: usize) {
    let core = pit(count);
    time(bencher, &format!("pit_2d_{count}"), || core.clone(), |core| core.update(PIT_DT));
}

#[divan::bench(args = FLAT, sample_count = 5, sample_size = 1)]
fn pit_2_5d(bencher: Bencher<'_, '_>, count: usize) {
    let simulator =
        TwoHalfPhysicsSimulator::from_core(600, 90, pit(count)).expect("a height and an angle in range");
    let step = |simulator: &mut TwoHalfPhysicsSimulator| simulator.update(PIT_DT);
    time(bencher, &format!("pit_2_5d_{count}"), || simulator.clone(), step);
}

fn pit(count: usize) -> PhysicsSimulator {
    let scene = circles_in_a_pit(count);
    let run = Run::build(&scene).expect("a scene that needs nothing special");
    run.simulator().clone()
}

/// Measures the first steps of a scene. `divan` prints steps per second.
fn measure(bencher: Bencher<'_, '_>, scene: &DepthScene) {
    time(bencher, &scene.name, || build(scene).0, |simulator| simulator.update(scene.dt));
}

fn time<S>(bencher: Bencher<'_, '_>, name: &str, make: impl Fn() -> S, step: impl Fn(&mut S)) {
    bencher.counter(ItemsCount::new(STEPS)).with_inputs(make).bench_local_values(|mut simulator| {
        let start = Instant::now();
        for _ in 0..STEPS {
            step(&mut simulator);
        }
        note(name, start.elapsed() / STEPS as u32);
        simulator
    });
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
