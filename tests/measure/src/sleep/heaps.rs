//! Heaps of sleeping boxes, and a box that lands on one of them.

use super::{Sleeper, rounded};
use crate::csv::table;
use crate::method::Method;
use crate::scenes::stage::{METRE, Stage};
use crate::stopwatch::Stopwatch;
use crate::sweep::median;
use conformance::scene::Scene;
use conformance::scenes::vary;
use serde::Serialize;
use std::time::Duration;

/// Number of boxes in a heap.
pub const HEAP: usize = 20;
/// Number of boxes in a row of a heap.
const ROW: usize = 5;
/// Distance in px between neighbouring boxes of a heap at the start, before they fall.
const PITCH: f32 = 1.35 * METRE;
/// Number of shelves with heaps in a row along x.
const ABREAST: usize = 25;
/// Distance in px between neighbouring shelves, along x and along y.
const APART: [f32; 2] = [22.0 * METRE, 14.0 * METRE];
/// Width and height of a shelf in px.
const SHELF: [f32; 2] = [20.0 * METRE, METRE];
/// Height in px above a shelf from which the box falls on a heap. Heaps are at most four boxes high.
const ABOVE: f32 = 8.0 * METRE;

/// Results of the scene of heaps with one method: one line of a table.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct HeapsFigures {
    /// Name of the method.
    pub method: &'static str,
    /// Number of dynamic boxes, including the box that is dropped.
    pub boxes: usize,
    /// Number of boxes that sleep when the steps of `us_asleep` are timed.
    pub asleep: usize,
    /// Simulated time in s until all boxes slept; `None` if some never did.
    pub asleep_after_s: Option<f64>,
    /// CPU time of a step in µs while all boxes sleep.
    pub us_asleep: f64,
    /// CPU time of a step in µs with sleep disabled: all boxes are awake and at rest.
    pub us_awake: f64,
    /// Number of sleeping boxes that woke in the heap on which the box was dropped.
    pub woken: usize,
    /// Number of sleeping boxes that woke in all other heaps.
    pub woken_elsewhere: usize,
    /// Simulated time in s from the drop of the box until all boxes slept again; `None` if some never did.
    pub asleep_again_after_s: Option<f64>,
}

/// Returns a scene of `count` heaps, each on a shelf of its own, whose boxes are about to fall into place. The last body is
/// a box on another shelf.
pub fn heaps(count: usize) -> Scene {
    let mut stage = Stage::new().named(format!("{count}_heaps"));
    for heap in 0..count {
        let [x, y] = shelf(heap);
        stage.wall([x, y + SHELF[1] / 2.0], SHELF);
        for at in 0..HEAP {
            let (row, column, index) = (at / ROW, at % ROW, heap * HEAP + at);
            // Each row is shifted by half a box against the row below, like bricks.
            let along = column as f32 - (ROW - 1) as f32 / 2.0 + 0.5 * (row % 2) as f32;
            let place = [x + PITCH * along + 0.05 * METRE * vary(index, 1), y - PITCH * (row as f32 + 0.5)];
            stage.solid(place, [METRE, METRE]);
            stage.last().rotation = Some(0.3 * vary(index, 2));
        }
    }
    let [x, y] = shelf(count);
    stage.wall([x, y + SHELF[1] / 2.0], SHELF);
    stage.solid([x, y - METRE / 2.0], [METRE, METRE]);
    stage.done()
}

/// Returns the middle of the upper side of the shelf of a heap, in px.
fn shelf(heap: usize) -> [f32; 2] {
    let from_middle = (heap % ABREAST) as f32 - (ABREAST / 2) as f32;
    [from_middle * APART[0], (heap / ABREAST) as f32 * APART[1]]
}

/// Returns the indices of the bodies of a heap. Each shelf is followed by its boxes in the order of creation.
fn bodies(heap: usize) -> std::ops::Range<usize> {
    let first = heap * (HEAP + 1) + 1;
    first..first + HEAP
}

/// Number of turns in which steps are timed, and number of steps per turn.
struct Turns {
    turns: usize,
    steps: u32,
}

const ASLEEP: Turns = Turns { turns: 41, steps: 60 };
const AWAKE: Turns = Turns { turns: 11, steps: 6 };
/// Number of steps between waking all boxes and timing steps.
const WAKING: usize = 12;

/// Runs a scene of `count` heaps with each of `methods`; the methods take turns where steps are timed.
///
/// # Errors
///
/// An engine cannot build the scene.
pub fn run_heaps(methods: &[Method], count: usize) -> Result<Vec<HeapsFigures>, String> {
    let scene = heaps(count);
    let mut sleepers =
        methods.iter().map(|method| Sleeper::new(method, &scene)).collect::<Result<Vec<_>, _>>()?;
    let mut figures: Vec<HeapsFigures> = sleepers.iter_mut().map(fallen_asleep).collect();
    for (figures, time) in figures.iter_mut().zip(step_times(&mut sleepers, &ASLEEP)) {
        figures.us_asleep = time;
    }
    for (figures, sleeper) in figures.iter_mut().zip(&mut sleepers) {
        land(sleeper, count / 2, figures);
        sleeper.world.set_sleep_enabled(false);
        (0..WAKING).for_each(|_| sleeper.world.step(sleeper.dt));
    }
    for (figures, time) in figures.iter_mut().zip(step_times(&mut sleepers, &AWAKE)) {
        figures.us_awake = time;
    }
    Ok(figures)
}

/// Steps until all boxes sleep, and returns figures with the time it took. Figures that are not known yet are NaN, 0 or
/// `None`.
fn fallen_asleep(sleeper: &mut Sleeper) -> HeapsFigures {
    let asleep_after_s = sleeper.fall_asleep(|_, _| {}).map(rounded);
    HeapsFigures {
        method: sleeper.method,
        boxes: sleeper.movable.len(),
        asleep: sleeper.asleep().count(),
        asleep_after_s,
        us_asleep: f64::NAN,
        us_awake: f64::NAN,
        woken: 0,
        woken_elsewhere: 0,
        asleep_again_after_s: None,
    }
}

/// Drops the last body on a heap, given by number, steps until all boxes sleep again, and writes the counts to `figures`.
fn land(sleeper: &mut Sleeper, heap: usize, figures: &mut HeapsFigures) {
    let Some((&dropped, others)) = sleeper.movable.split_last() else { return };
    let mut sleeping: Vec<usize> =
        others.iter().copied().filter(|&index| sleeper.world.is_asleep(index)).collect();
    let [x, y] = shelf(heap);
    // Setting the velocity wakes the box. Setting the position does not in Box2D.
    sleeper.world.set_velocity(dropped, [0.0, f64::from(METRE)], 0.0);
    sleeper.world.teleport(dropped, [x, y - ABOVE].map(f64::from), 0.0);
    let heap = bodies(heap);
    let again = sleeper.fall_asleep(|_, sleeper| {
        sleeping.retain(|&index| {
            let sleeps = sleeper.world.is_asleep(index);
            let woken = if heap.contains(&index) { &mut figures.woken } else { &mut figures.woken_elsewhere };
            *woken += usize::from(!sleeps);
            sleeps
        });
    });
    figures.asleep_again_after_s = again.map(rounded);
}

/// Returns the CPU time of a step in µs for each of `sleepers`: the median over turns.
fn step_times(sleepers: &mut [Sleeper], turns: &Turns) -> Vec<f64> {
    let mut times = vec![Vec::new(); sleepers.len()];
    for _ in 0..turns.turns {
        for (sleeper, times) in sleepers.iter_mut().zip(&mut times) {
            let stopwatch = Stopwatch::start();
            (0..turns.steps).for_each(|_| sleeper.world.step(sleeper.dt));
            times.push(stopwatch.elapsed());
        }
    }
    let step = |time: Duration| rounded(time.as_secs_f64() * 1e6 / f64::from(turns.steps));
    times.into_iter().map(|times| median(times).map_or(f64::NAN, step)).collect()
}

/// Returns the figures as a table with one line for each method.
pub fn heaps_csv(figures: &[HeapsFigures]) -> String {
    table(figures)
}
