//! What it costs to go back: saving, restoring and cloning 1,000 bodies in a pile, with both sets.
//!
//! `cargo bench -p measure --bench rollback` prints a table: the median of many calls in ms, and the bytes of a snapshot.

use std::hint::black_box;
use std::time::Instant;

use conformance::fixtures::plane::{add_box, add_circle, add_floor, simulator_with, v};
use farseer_core::{Methods, PhysicsSimulator};

const BODIES: usize = 1000;
/// Updates until the pile lies.
const UPDATES: usize = 900;
const CALLS: usize = 101;

/// Boxes and circles of about 16 px that have fallen into a pit.
fn pile(methods: Methods) -> PhysicsSimulator {
    let mut simulator = simulator_with(320.0, methods);
    add_floor(&mut simulator, (700.0, 100.0), v(0.0, 50.0));
    for x in [-350.0, 350.0] {
        add_floor(&mut simulator, (100.0, 2000.0), v(x, -900.0));
    }
    for number in 0..BODIES {
        let place = v((number % 25) as f32 * 22.0 - 264.0, -20.0 - (number / 25) as f32 * 22.0);
        let geom = if number % 2 == 0 {
            add_box(&mut simulator, (16.0, 14.0), place).1
        } else {
            add_circle(&mut simulator, 8.0, 16, place).1
        };
        simulator[geom].set_friction_coefficient(0.4);
    }
    (0..UPDATES).for_each(|_| simulator.update(1.0 / 60.0));
    simulator
}

/// Median time of a call in ms.
fn median(mut call: impl FnMut()) -> f64 {
    let mut times: Vec<f64> = (0..CALLS)
        .map(|_| {
            let start = Instant::now();
            call();
            start.elapsed().as_secs_f64() * 1000.0
        })
        .collect();
    times.sort_unstable_by(f64::total_cmp);
    times[CALLS / 2]
}

fn row(name: &str, cells: [String; 2]) {
    println!("| {name} | {} | {} |", cells[0], cells[1]);
}

fn main() {
    let piles = [Methods::default(), Methods::PRECISE].map(pile);
    let snapshots = piles.each_ref().map(PhysicsSimulator::snapshot);
    let times = |call: fn(&PhysicsSimulator, &mut PhysicsSimulator, &[u8])| {
        let time = |set: usize| {
            let mut copy = piles[set].clone();
            format!("{:.3} ms", median(|| call(&piles[set], &mut copy, &snapshots[set])))
        };
        [time(0), time(1)]
    };
    row("1,000 bodies in a pile", ["faithful".into(), "precise".into()]);
    row("---", ["---".into(), "---".into()]);
    row("contacts", piles.each_ref().map(|pile| pile.contact_count().to_string()));
    row("bytes of a snapshot", snapshots.each_ref().map(|snapshot| snapshot.len().to_string()));
    row("`snapshot`", times(|pile, _, _| drop(black_box(pile.snapshot()))));
    row("`restore`", times(|_, copy, snapshot| copy.restore(snapshot).expect("it was just saved")));
    row("`clone`", times(|pile, _, _| drop(black_box(pile.clone()))));
    row("`clone_from`", times(|pile, copy, _| copy.clone_from(pile)));
    row("`update`", times(|_, copy, _| copy.update(1.0 / 60.0)));
}
