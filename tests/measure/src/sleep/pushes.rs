//! A sleeping pyramid of boxes that is pushed at its foot.

use super::{Sleeper, rounded};
use crate::csv::table;
use crate::method::Method;
use crate::scenes::stage::METRE;
use crate::stability::stacks::pyramid;
use crate::world::{BodyState, distance};
use serde::Serialize;

/// Number of boxes in the lowest row of the pyramid.
const BASE: usize = 15;
/// Index of the body that is pushed: the outermost box of the lowest row, which follows the floor. The push is directed
/// inwards.
const FOOT: usize = 1;
/// Velocities in m/s that a push gives to the box.
const PUSHES: [f64; 8] = [0.5, 1.0, 2.0, 3.0, 5.0, 10.0, 20.0, 40.0];
/// Greatest speed in px/s of any point of a body at rest, by the motion from one step to the next. It is 0.05 m/s, as in
/// Box2D's rule of sleeping. rapier2d uses twice this speed, the precise set 0.045 m/s.
pub const REST: f64 = 0.05 * METRE as f64;

/// Results of one push with one method: one line of a table.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct PushFigures {
    /// Name of the method.
    pub method: &'static str,
    /// Velocity in m/s that the push gives to the box.
    pub push: f64,
    /// Number of boxes in the pyramid.
    pub boxes: usize,
    /// Simulated time in s until the pyramid slept before the push; `None` if it never did: then there is no push, and other
    /// figures are 0 or `None`.
    pub asleep_after_s: Option<f64>,
    /// Number of boxes that are awake after the first step after the push.
    pub woken_at_once: usize,
    /// Greatest number of boxes that were awake at once after the push.
    pub woken: usize,
    /// Number of boxes that ended more than half a box lower than before the push.
    pub fallen: usize,
    /// Simulated time in s from the push to the last step in which a point of a box was faster than [`REST`]; `None` if this
    /// is the last step of the run.
    pub at_rest_again_after_s: Option<f64>,
    /// Simulated time in s from the push until all boxes slept again; `None` if they never did.
    pub asleep_again_after_s: Option<f64>,
}

/// Runs pushes of increasing strength on a pyramid, each with every method of `methods`.
///
/// # Errors
///
/// An engine cannot build the pyramid.
pub fn run_pushes(methods: &[Method]) -> Result<Vec<PushFigures>, String> {
    let pushes = PUSHES.iter().flat_map(|&push| methods.iter().map(move |method| (method, push)));
    pushes.map(|(method, push)| run_push(method, push)).collect()
}

/// Runs one push on a pyramid with a method; `push` is the velocity in m/s that the box gets.
///
/// # Errors
///
/// The engine cannot build the pyramid.
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
        observe_push(&mut sleeper, &mut figures);
    }
    Ok(figures)
}

/// Pushes the sleeping pyramid, observes it until it sleeps again, and writes the results to `figures`.
fn observe_push(sleeper: &mut Sleeper, figures: &mut PushFigures) {
    let before = states(sleeper);
    let (mut last, mut restless, mut end) = (before.clone(), 0.0, 0.0);
    // A box has 1 kg, so the impulse equals the velocity.
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

/// Returns an upper bound in px of the distance that a corner of a box moved from state `last` to state `now`.
fn way(last: &BodyState, now: &BodyState) -> f64 {
    let reach = f64::from(METRE) * std::f64::consts::FRAC_1_SQRT_2;
    distance(last.position_in_plane(), now.position_in_plane()) + reach * (now.angle - last.angle).abs()
}

/// Returns the figures as a table with one line for each push and method.
pub fn pushes_csv(figures: &[PushFigures]) -> String {
    table(figures)
}
