//! Heaps that sleep, and a box that lands on one of them.

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

/// Boxes of a heap.
pub const HEAP: usize = 20;
/// Boxes of a row of one, as they begin to fall, and from one to the next.
const ROW: usize = 5;
const PITCH: f32 = 1.35 * METRE;
/// Heaps beside each other, and from one to the next along x and y.
const ABREAST: usize = 25;
const APART: [f32; 2] = [22.0 * METRE, 14.0 * METRE];
const SHELF: [f32; 2] = [20.0 * METRE, METRE];
/// How far above its shelf the box begins to fall that lands on a heap: they are four boxes high at most.
const ABOVE: f32 = 8.0 * METRE;

/// What came of heaps with a method.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct HeapsFigures {
    /// Its name.
    pub method: &'static str,
    /// Boxes, and how many of them slept when the steps were timed.
    pub boxes: usize,
    /// See [`boxes`](Self::boxes).
    pub asleep: usize,
    /// Seconds after which all slept; nothing if they never did.
    pub asleep_after_s: Option<f64>,
    /// CPU time of a step in µs, asleep.
    pub us_asleep: f64,
    /// The same with sleep switched off: where all is awake, and at rest.
    pub us_awake: f64,
    /// How many that had slept woke in the heap that the box was dropped on.
    pub woken: usize,
    /// How many in all others.
    pub woken_elsewhere: usize,
    /// Seconds from when it was dropped until all slept again; nothing if they never did.
    pub asleep_again_after_s: Option<f64>,
}

/// So many heaps on shelves of their own, their boxes about to fall into them, and a box on another shelf: the last body.
pub fn heaps(count: usize) -> Scene {
    let mut stage = Stage::new().named(format!("{count}_heaps"));
    for heap in 0..count {
        let [x, y] = shelf(heap);
        stage.wall([x, y + SHELF[1] / 2.0], SHELF);
        for at in 0..HEAP {
            let (row, column, index) = (at / ROW, at % ROW, heap * HEAP + at);
            // Each row is half a box beside that below, as bricks are.
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

/// The middle of the top of a shelf.
fn shelf(heap: usize) -> [f32; 2] {
    let from_middle = (heap % ABREAST) as f32 - (ABREAST / 2) as f32;
    [from_middle * APART[0], (heap / ABREAST) as f32 * APART[1]]
}

/// The bodies of a heap: after each shelf those that lie on it.
fn bodies(heap: usize) -> std::ops::Range<usize> {
    let first = heap * (HEAP + 1) + 1;
    first..first + HEAP
}

/// Turns in which steps are timed, and how many steps a turn has.
struct Turns {
    turns: usize,
    steps: u32,
}

const ASLEEP: Turns = Turns { turns: 41, steps: 60 };
const AWAKE: Turns = Turns { turns: 11, steps: 6 };
/// Steps between that all are woken and that they are timed.
const WAKING: usize = 12;

/// Runs heaps with some methods, which take turns where steps are timed.
///
/// # Errors
///
/// When an engine cannot build them.
pub fn run_heaps(methods: &[Method], count: usize) -> Result<Vec<HeapsFigures>, String> {
    let scene = heaps(count);
    let mut sleepers =
        methods.iter().map(|method| Sleeper::new(method, &scene)).collect::<Result<Vec<_>, _>>()?;
    let mut figures: Vec<HeapsFigures> = sleepers.iter_mut().map(settled).collect();
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

/// Lets all fall asleep. What is not known yet is not a number, and none.
fn settled(sleeper: &mut Sleeper) -> HeapsFigures {
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

/// Drops the last body on a heap.
fn land(sleeper: &mut Sleeper, heap: usize, figures: &mut HeapsFigures) {
    let Some((&dropped, others)) = sleeper.movable.split_last() else { return };
    let mut sleeping: Vec<usize> =
        others.iter().copied().filter(|&index| sleeper.world.is_asleep(index)).collect();
    let [x, y] = shelf(heap);
    // In motion first, which wakes it: Box2D does not wake what is put elsewhere.
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

/// CPU time of a step of each in µs: the median of the turns they take.
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

/// As a table, a line for each method.
pub fn heaps_csv(figures: &[HeapsFigures]) -> String {
    table(figures)
}
