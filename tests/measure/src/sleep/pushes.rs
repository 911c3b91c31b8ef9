//! A pyramid that sleeps, and is pushed at its foot.

use super::{Sleeper, rounded};
use crate::csv::table;
use crate::method::Method;
use crate::scenes::stage::METRE;
use crate::stability::stacks::pyramid;
use crate::world::{BodyState, distance};
use serde::Serialize;

/// Boxes in the lowest row.
const BASE: usize = 15;
/// The box that is pushed: the outermost of the lowest row, after the floor. It is pushed inwards.
const FOOT: usize = 1;
/// The velocities in m/s that a push gives it.
const PUSHES: [f64; 8] = [0.5, 1.0, 2.0, 3.0, 5.0, 10.0, 20.0, 40.0];
/// What is at rest moves no point faster, in px/s, from one step to the next: the 0.05 m/s below which Box2D lets things
/// sleep. rapier2d takes twice that, the precise set 0.045 m/s.
pub const REST: f64 = 0.05 * METRE as f64;

/// What came of a push with a method.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct PushFigures {
    /// Its name.
    pub method: &'static str,
    /// The velocity in m/s that the box got.
    pub push: f64,
    /// Boxes of the pyramid.
    pub boxes: usize,
    /// Seconds after which it slept as it was built; if it never did there is nothing else to tell.
    pub asleep_after_s: Option<f64>,
    /// How many were awake after the step that followed the push.
    pub woken_at_once: usize,
    /// The most that were awake at any time after it.
    pub woken: usize,
    /// How many ended lower by more than half a box.
    pub fallen: usize,
    /// Seconds from the push until none was faster than [`REST`] any more; nothing if one still was at the end.
    pub at_rest_again_after_s: Option<f64>,
    /// Seconds from the push until all slept again; nothing if they never did.
    pub asleep_again_after_s: Option<f64>,
}

/// Pushes a pyramid with some methods, more and more.
///
/// # Errors
///
/// When an engine cannot build it.
pub fn run_pushes(methods: &[Method]) -> Result<Vec<PushFigures>, String> {
    let pushes = PUSHES.iter().flat_map(|&push| methods.iter().map(move |method| (method, push)));
    pushes.map(|(method, push)| run_push(method, push)).collect()
}

/// Pushes a pyramid with a method; the push in m/s.
///
/// # Errors
///
/// When the engine cannot build it.
pub fn run_push(method: &Method, push: f64) -> Result<PushFigures, String> {
    let mut sleeper = Sleeper::new(method, &pyramid(BASE, 0.0))?;
    let asleep_after_s = sleeper.fall_asleep(|_, _| {}).map(rounded);
    let mut figures = PushFigures {
        method: method.name,
        push,
        boxes: sleeper.movable.len(),
        asleep_after_s,
        woken_at_once: 0,
        woken: 0,
        fallen: 0,
        at_rest_again_after_s: None,
        asleep_again_after_s: None,
    };
    if asleep_after_s.is_some() {
        see_push(&mut sleeper, &mut figures);
    }
    Ok(figures)
}

/// Pushes what sleeps, and looks at it until it sleeps again.
fn see_push(sleeper: &mut Sleeper, figures: &mut PushFigures) {
    let before = states(sleeper);
    let (mut last, mut restless, mut end) = (before.clone(), 0.0, 0.0);
    // Boxes are of 1 kg.
    sleeper.world.apply_impulse(FOOT, [figures.push * f64::from(METRE), 0.0]);
    let again = sleeper.fall_asleep(|time, sleeper| {
        let awake = sleeper.movable.len() - sleeper.asleep().count();
        if figures.woken == 0 {
            figures.woken_at_once = awake;
        }
        figures.woken = figures.woken.max(awake);
        let now = states(sleeper);
        if last.iter().zip(&now).any(|(last, now)| way(last, now) > REST * f64::from(sleeper.dt)) {
            restless = time;
        }
        (last, end) = (now, time);
    });
    let has_fallen = |(before, after): &(&BodyState, &BodyState)| {
        after.position[1] > before.position[1] + f64::from(METRE) / 2.0
    };
    figures.fallen = before.iter().zip(&last).filter(has_fallen).count();
    figures.at_rest_again_after_s = (restless < end).then(|| rounded(restless));
    figures.asleep_again_after_s = again.map(rounded);
}

fn states(sleeper: &Sleeper) -> Vec<BodyState> {
    sleeper.movable.iter().map(|&index| sleeper.world.body(index)).collect()
}

/// How far the fastest corner of a box has gone, at most, in px.
fn way(last: &BodyState, now: &BodyState) -> f64 {
    let reach = f64::from(METRE) * std::f64::consts::FRAC_1_SQRT_2;
    distance(last.place(), now.place()) + reach * (now.angle - last.angle).abs()
}

/// As a table, a line for each push and method.
pub fn pushes_csv(figures: &[PushFigures]) -> String {
    table(figures)
}
