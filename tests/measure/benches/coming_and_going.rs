//! Measures the cost of adding and removing bodies with the precise set: crates in heaps, and a small body beside them.
//!
//! `cargo bench -p measure --bench coming_and_going` prints how much longer an update takes in which a body is added, removed
//! or exchanged than an update without edits, in µs. It compares medians.

use std::collections::VecDeque;
use std::time::Instant;

use conformance::fixtures::plane::{add_box, add_floor, simulator_with, v};
use farseer_core::{BodyId, Methods, PhysicsSimulator};

const DT: f32 = 1.0 / 60.0;
const ROUNDS: usize = 41;
/// Number of crates of a heap. `ROW` is the number of heaps in a row.
const HEAP: usize = 20;
const ROW: usize = 32;
/// Number of small bodies that exist so that one can always be removed.
const SPARE: usize = 8;

struct World {
    simulator: PhysicsSimulator,
    spare: VecDeque<BodyId>,
    added: usize,
}

impl World {
    /// Builds a world of `crates` crates that have fallen into heaps.
    fn new(crates: usize, sleeps: bool) -> Self {
        let mut simulator = simulator_with(320.0, Methods::PRECISE);
        simulator.set_sleep_enabled(sleeps);
        for heap in 0..crates / HEAP {
            let place = v((heap % ROW) as f32 * 400.0, (heap / ROW) as f32 * 600.0);
            add_floor(&mut simulator, (380.0, 20.0), place + v(0.0, 100.0));
            for at in 0..HEAP {
                let (row, column) = ((at / 5) as f32, (at % 5) as f32);
                let shift = 3.0 * row + 0.3 * (at * heap % 7) as f32;
                let place = place + v((column - 2.0) * 33.0 + shift, 70.0 - row * 34.0);
                let (_, geom) = add_box(&mut simulator, (30.0, 30.0), place);
                // Friction stops the crate: a body that slides for ever does not fall asleep.
                simulator.geom_mut(geom).expect("it is there").set_friction_coefficient(0.5);
            }
        }
        (0..if sleeps { 480 } else { 40 }).for_each(|_| simulator.update(DT));
        let asleep = if sleeps { crates } else { 0 };
        assert_eq!(simulator.counters().bodies_asleep, asleep);
        let mut world = World { simulator, spare: VecDeque::new(), added: 0 };
        (0..SPARE).for_each(|_| world.come());
        world.simulator.update(DT);
        world
    }

    fn come(&mut self) {
        let place = v((self.added % 100) as f32 * 100.0, -400.0);
        self.spare.push_back(add_box(&mut self.simulator, (10.0, 10.0), place).0);
        self.added += 1;
    }

    fn go(&mut self) {
        if let Some(body) = self.spare.pop_front() {
            self.simulator.dispose(body).expect("it is there");
        }
    }

    /// Returns the time of an edit and the update after it, µs.
    fn time(&mut self, happens: impl FnOnce(&mut Self)) -> f64 {
        let start = Instant::now();
        happens(self);
        self.simulator.update(DT);
        start.elapsed().as_secs_f64() * 1e6
    }
}

fn median(mut times: Vec<f64>) -> f64 {
    times.sort_unstable_by(f64::total_cmp);
    times[times.len() / 2]
}

/// Returns the median time of an update without an edit, and the additional time of an update with one, µs. `undo` reverts the
/// edit after each round.
fn more(world: &mut World, happens: fn(&mut World), undo: fn(&mut World)) -> [f64; 2] {
    let (mut plain, mut with) = (Vec::new(), Vec::new());
    for _ in 0..ROUNDS {
        plain.push(world.time(|_| {}));
        with.push(world.time(happens));
        world.time(undo);
    }
    let plain = median(plain);
    [plain, median(with) - plain]
}

fn main() {
    println!("| crates | | nothing | a body comes | goes | one comes, one goes |");
    println!("|---|---|---|---|---|---|");
    for (crates, sleeps) in [(1000, false), (10_000, false), (1000, true), (10_000, true)] {
        let world = &mut World::new(crates, sleeps);
        let [nothing, comes] = more(world, World::come, World::go);
        let [_, goes] = more(world, World::go, World::come);
        let exchange = |world: &mut World| {
            world.come();
            world.go();
        };
        let [_, both] = more(world, exchange, |_| {});
        let state = if sleeps { "asleep" } else { "awake" };
        println!("| {crates} | {state} | {nothing:.0} us | {comes:+.0} us | {goes:+.0} us | {both:+.0} us |");
    }
}
