//! Prediction of a scene by two careful runs of the precise set with different steps. The prediction is valid while both runs
//! agree.

use super::findings::{Energy, overlap_and_gap};
use super::{Asked, Choice, PRECISE};
use crate::world::{BodyState, distance};
use farseer_core::PhysicsSimulator;

/// Settings of the two careful runs: number of updates into which a step of the game is divided, and number of substeps per
/// update.
const CAREFUL_SETTINGS: [(u16, u32); 2] = [(4, 16), (5, 12)];
/// `SAMPLES`: least number of samples of a careful run. `LAST_SAMPLES`: least number of samples in the end of the run in which
/// bodies should be at rest. A run with fewer steps has one sample per step.
const SAMPLES: usize = 100;
const LAST_SAMPLES: usize = 10;
/// Greatest distance between a body's positions in the two careful runs with which they are on one path, as a multiple of the
/// tolerance (dimensionless).
const SAME_PATH_TOLERANCES: f64 = 1.0;
/// Distance from the start in length units beyond which a careful run has lost a body: no game is that large.
const MAX_DISTANCE: f64 = 1e6;

/// State of a careful run at one time: body states, energies, greatest overlap and greatest gap of a joint.
#[derive(Debug, Clone)]
pub(super) struct Sample {
    pub(super) time: f64,
    pub(super) bodies: Vec<BodyState>,
    pub(super) energy: Energy,
    pub(super) overlap: f64,
    pub(super) gap: f64,
}

/// The predicted course of a scene: samples of the first careful run, and how long and for which bodies they are valid.
#[derive(Debug)]
pub(super) struct Reference {
    samples: Vec<Sample>,
    /// Whether each body is movable, by index into the list of bodies.
    is_movable: Vec<bool>,
    /// Whether each body comes to rest at the same place in both careful runs, by index into the list of bodies.
    rests: Vec<bool>,
    predictable: f64,
    /// Greatest kinetic energy plus the energy that lifts every body by one length unit, in mass units * length units^2/s^2.
    /// Energy errors are fractions of it.
    pub(super) energy_scale: f64,
    /// Greatest sum of kinetic energy and potential energy of gravity at any sample, in mass units * length units^2/s^2.
    pub(super) most_energy: f64,
}

impl Reference {
    pub(super) fn of(
        asked: &Asked,
        build: &impl Fn(&Choice) -> Result<PhysicsSimulator, String>,
    ) -> Result<Self, String> {
        let (looks, is_movable, unit_energy) = careful_run(asked, CAREFUL_SETTINGS[0], build)?;
        let (other, ..) = careful_run(asked, CAREFUL_SETTINGS[1], build)?;
        let is_same = |body: usize, at: usize| {
            distance(looks[at].bodies[body].position, other[at].bodies[body].position)
                <= SAME_PATH_TOLERANCES * asked.tolerance
        };
        // Two chaotic paths may end in one position by chance: a body's final position is predicted only if its whole paths
        // agree.
        let is_told = |body: usize| (0..looks.len()).all(|at| is_same(body, at));
        let rests = (0..is_movable.len())
            .map(|body| {
                is_movable[body]
                    && is_told(body)
                    && [&looks, &other].iter().all(|looks| rests(asked, body, looks))
            })
            .collect();
        let are_same = |at: &usize| (0..is_movable.len()).all(|body| !is_movable[body] || is_same(body, *at));
        let predictable = (0..looks.len()).take_while(are_same).last().map_or(0.0, |at| looks[at].time);
        let greatest = |of: fn(&Sample) -> f64| looks.iter().map(of).fold(f64::NEG_INFINITY, f64::max);
        let energy_scale = greatest(|look| look.energy.motion) + unit_energy;
        let most_energy = greatest(|look| look.energy.total());
        Ok(Reference { samples: looks, is_movable, rests, predictable, energy_scale, most_energy })
    }

    pub(super) fn movable(&self) -> usize {
        self.is_movable.iter().filter(|&&is| is).count()
    }

    pub(super) fn resting(&self) -> usize {
        self.rests.iter().filter(|&&rests| rests).count()
    }

    pub(super) fn predictable(&self) -> f64 {
        self.predictable
    }

    /// Returns the sample of the first careful run at `time` (s); `None` if no sample is within `near` s of it.
    pub(super) fn at(&self, time: f64, near: f64) -> Option<&Sample> {
        let after = self.samples.partition_point(|look| look.time < time - near);
        self.samples.get(after).filter(|look| (look.time - time).abs() <= near)
    }

    pub(super) fn moving_bodies(&self) -> impl Iterator<Item = usize> + '_ {
        (0..self.is_movable.len()).filter(|&body| self.is_movable[body])
    }

    pub(super) fn resting_bodies(&self) -> impl Iterator<Item = usize> + '_ {
        (0..self.rests.len()).filter(|&body| self.rests[body])
    }

    /// Returns whether `time` (s) is in the end of the run (at most 1 s) in which bodies should be at rest.
    pub(super) fn is_late(asked: &Asked, time: f64) -> bool {
        time > asked.seconds - window(asked)
    }
}

/// Returns the duration in s of the end of a run in which bodies should be at rest: 1 s, or a quarter of a run shorter than 4
/// s.
fn window(asked: &Asked) -> f64 {
    (asked.seconds / 4.0).min(1.0)
}

/// Returns whether a body keeps its position, within half the tolerance, in the end of the run (at most 1 s).
fn rests(asked: &Asked, body: usize, looks: &[Sample]) -> bool {
    let end = looks[looks.len() - 1].bodies[body].position;
    let late = looks.iter().filter(|look| Reference::is_late(asked, look.time));
    late.into_iter().all(|look| distance(look.bodies[body].position, end) < 0.5 * asked.tolerance)
}

/// Makes a careful run. Returns its samples at full steps of the game, whether each body is movable, and the energy that lifts
/// every body by one length unit.
fn careful_run(
    asked: &Asked,
    (parts, passes): (u16, u32),
    build: &impl Fn(&Choice) -> Result<PhysicsSimulator, String>,
) -> Result<(Vec<Sample>, Vec<bool>, f64), String> {
    let mut simulator = build(&Choice { parts, passes, ..PRECISE })?;
    simulator.set_sleep_enabled(false);
    let is_movable: Vec<bool> = simulator
        .bodies()
        .map(|body| {
            let body = &simulator[body];
            body.enabled() && !body.is_static() && !body.is_kinematic()
        })
        .collect();
    let unit_energy = Energy::of_a_unit(&simulator, asked.length_unit);
    let steps = (asked.seconds / f64::from(asked.dt)).round() as usize;
    let last_steps = (window(asked) / f64::from(asked.dt)) as usize;
    let stride = (steps / SAMPLES).min(last_steps / LAST_SAMPLES).max(1);
    let mut looks = vec![sample(&simulator, asked, 0.0)];
    let dt = asked.dt / f32::from(parts);
    for step in 1..=steps {
        (0..parts).for_each(|_| simulator.update(dt));
        if step % stride == 0 || step == steps {
            looks.push(sample(&simulator, asked, step as f64 * f64::from(asked.dt)));
            check(asked, &looks)?;
        }
    }
    Ok((looks, is_movable, unit_energy))
}

fn sample(simulator: &PhysicsSimulator, asked: &Asked, time: f64) -> Sample {
    let bodies = simulator.bodies().map(|body| BodyState::of(&simulator[body])).collect();
    let [overlap, gap] = overlap_and_gap(simulator, asked);
    Sample { time, bodies, energy: Energy::of(simulator), overlap, gap }
}

/// Rejects a careful run with a number that is not finite, or in which a body is lost: a game cannot intend it.
fn check(asked: &Asked, looks: &[Sample]) -> Result<(), String> {
    let (first, last) = (&looks[0], &looks[looks.len() - 1]);
    let reach = MAX_DISTANCE * f64::from(asked.length_unit);
    if first.bodies.len() != last.bodies.len() {
        return Err(format!("bodies come or go within {:.2} s: that cannot be compared", last.time));
    }
    let is_lost = |(start, now): (&BodyState, &BodyState)| {
        !now.is_finite() || distance(start.position, now.position) > reach
    };
    match first.bodies.iter().zip(&last.bodies).position(is_lost) {
        Some(body) => Err(format!("body {body} is lost after {:.2} s, whatever method is taken", last.time)),
        None => Ok(()),
    }
}
