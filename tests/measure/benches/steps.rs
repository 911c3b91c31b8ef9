//! Measures the time per step of complete simulations, as a mean over the recorded length of the scene.
//!
//! `cargo bench -p measure`. Only the updates are measured, not the building of a scene.

use conformance::golden;
use conformance::run::Run;
use conformance::scene::Scene;
use conformance::scenes::{circles_in_a_pit, pyramid};
use divan::Bencher;
use divan::counter::ItemsCount;
use std::sync::Mutex;
use std::time::{Duration, Instant};

/// Names of the scenes.
const SCENES: [&str; 4] = ["bench_circles_500", "bench_boxes_300", "pyramid_of_20", "1000_circles_in_a_pit"];

/// Mean times per step of every sample, by scene. Their medians are printed at the end, in ms.
static MEANS: Mutex<Vec<(&str, Vec<Duration>)>> = Mutex::new(Vec::new());

fn scene(name: &str) -> Scene {
    match name {
        "pyramid_of_20" => pyramid(20),
        "1000_circles_in_a_pit" => circles_in_a_pit(1000),
        _ => {
            let path = golden::folder().join(format!("{name}.json.gz"));
            Scene::from_file(path).unwrap_or_else(|error| panic!("{error}"))
        }
    }
}

/// Measures all steps of a scene. `divan` prints steps per second.
#[divan::bench(args = SCENES, sample_count = 5, sample_size = 1)]
fn steps(bencher: Bencher<'_, '_>, name: &'static str) {
    let scene = scene(name);
    bencher
        .counter(ItemsCount::new(scene.steps))
        .with_inputs(|| Run::build(&scene).unwrap_or_else(|error| panic!("{error}")))
        .bench_local_values(|mut run| {
            let simulator = run.simulator_mut();
            let start = Instant::now();
            for _ in 0..scene.steps {
                simulator.update(scene.dt);
            }
            note(name, start.elapsed() / scene.steps.max(1));
            run
        });
}

fn note(name: &'static str, mean: Duration) {
    let mut means = MEANS.lock().unwrap_or_else(|error| error.into_inner());
    match means.iter_mut().find(|(known, _)| *known == name) {
        Some((_, list)) => list.push(mean),
        None => means.push((name, vec![mean])),
    }
}

fn main() {
    divan::main();
    for (name, means) in MEANS.lock().unwrap_or_else(|error| error.into_inner()).iter_mut() {
        means.sort_unstable();
        println!("{name:<24} {:8.3} ms per step", means[means.len() / 2].as_secs_f64() * 1000.0);
    }
}
