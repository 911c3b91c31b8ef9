//! Measures the cost of event handlers: none, a handler with a `match`, and a `Dispatch` with a function per geom.
//!
//! `cargo bench -p measure --bench handlers` prints the time per step of a heap whose boxes all have a handler, and the part of
//! it that each kind of handler takes.

use std::time::Instant;

use conformance::fixtures::plane::{add_box, add_floor, simulator_with, v};
use farseer_core::{Contact, Context, Dispatch, EventHandler, GeomId, Methods, PhysicsSimulator};

const DT: f32 = 1.0 / 60.0;
const BOXES: usize = 400;
const UPDATES: usize = 200;
const ROUNDS: usize = 15;

/// State of both handlers: the number of hits of each of four kinds of geoms.
#[derive(Default)]
struct Game {
    hits: [u64; 4],
}

/// Event handler that finds the receiver of an event without a `Dispatch`.
struct Bare {
    game: Game,
    /// Kind of each geom, 0..=3, with its id; index: slot of the geom.
    kinds: Vec<Option<(GeomId, u8)>>,
}

impl EventHandler for Bare {
    fn on_collision(&mut self, _: &mut Context<'_>, this: GeomId, _: GeomId, _: &mut Vec<Contact>) -> bool {
        match self.kinds.get(this.slot()).copied().flatten() {
            Some((geom, kind)) if geom == this => self.game.hits[usize::from(kind)] += 1,
            _ => {}
        }
        true
    }
}

/// Returns a simulator with a heap of boxes at rest, which do not sleep, and the ids of their geoms.
fn heap() -> (PhysicsSimulator, Vec<GeomId>) {
    let mut simulator = simulator_with(320.0, Methods::PRECISE);
    simulator.set_sleep_enabled(false);
    add_floor(&mut simulator, (2000.0, 40.0), v(0.0, 20.0));
    let place = |at: usize| v((at % 40) as f32 * 34.0 - 680.0, -20.0 - (at / 40) as f32 * 34.0);
    let geoms = (0..BOXES).map(|at| add_box(&mut simulator, (30.0, 30.0), place(at)).1).collect();
    (0..300).for_each(|_| simulator.update(DT));
    (simulator, geoms)
}

fn time(mut update: impl FnMut()) -> f64 {
    let start = Instant::now();
    (0..UPDATES).for_each(|_| update());
    start.elapsed().as_secs_f64() * 1e6 / UPDATES as f64
}

fn main() {
    let (start, geoms) = heap();
    let mut dispatch = Dispatch::new();
    let mut bare = Bare { game: Game::default(), kinds: vec![None; 2 * BOXES] };
    for (at, &geom) in geoms.iter().enumerate() {
        bare.kinds[geom.slot()] = Some((geom, (at % 4) as u8));
        match at % 4 {
            0 => dispatch.on_collision(geom, count::<0>),
            1 => dispatch.on_collision(geom, count::<1>),
            2 => dispatch.on_collision(geom, count::<2>),
            _ => dispatch.on_collision(geom, count::<3>),
        };
    }
    let mut game = Game::default();
    let mut times = [const { Vec::new() }; 3];
    for _ in 0..ROUNDS {
        let mut simulators = [start.clone(), start.clone(), start.clone()];
        let [silent, told, dispatched] = &mut simulators;
        times[0].push(time(|| silent.update(DT)));
        times[1].push(time(|| told.update_with(DT, &mut bare)));
        times[2].push(time(|| dispatched.update_with(DT, &mut dispatch.with(&mut game))));
    }
    assert_eq!(bare.game.hits, game.hits, "both were told the same");
    let calls = game.hits.iter().sum::<u64>() as f64 / (ROUNDS * UPDATES) as f64;
    // The minimum over the rounds counts, because other load on the machine only adds time.
    let [silent, told, dispatched] = times.map(|times| times.into_iter().fold(f64::MAX, f64::min));
    println!("{BOXES} boxes, {calls:.0} calls per update");
    println!("nobody listens     {silent:8.2} us per update");
    for (name, time) in [("a bare handler", told), ("a dispatch", dispatched)] {
        println!("{name:<18} {time:8.2} us per update, {:.1} ns per call", (time - silent) * 1e3 / calls);
    }
}

fn count<const KIND: usize>(
    game: &mut Game,
    _: &mut Context<'_>,
    _: GeomId,
    _: GeomId,
    _: &mut Vec<Contact>,
) -> bool {
    game.hits[KIND] += 1;
    true
}
