//! How a scene really goes: two careful runs of the precise set, with different steps. What both agree on can be told.

use super::findings::{Energy, apart};
use super::{Asked, Choice, PRECISE};
use crate::world::{BodyState, distance};
use farseer_core::PhysicsSimulator;

/// Parts of a step and substeps of these runs.
const CAREFUL: [(u16, u32); 2] = [(4, 16), (5, 12)];
/// A run is looked at so often, and so often in its last second.
const LOOKS: usize = 100;
const LAST_LOOKS: usize = 10;
/// The careful runs are on one path while no body of one is further from the other's than this part of the tolerance.
const SAME: f64 = 1.0;
/// A careful run that goes further than this many units from where it began has lost something: no game is so large.
const AWAY: f64 = 1e6;

/// The bodies at one moment.
#[derive(Debug, Clone)]
pub(super) struct Look {
    pub(super) time: f64,
    pub(super) bodies: Vec<BodyState>,
    pub(super) energy: Energy,
    pub(super) overlap: f64,
    pub(super) gap: f64,
}

/// What is known of how a scene goes.
#[derive(Debug)]
pub(super) struct Reference {
    looks: Vec<Look>,
    /// By place in the list of bodies.
    is_movable: Vec<bool>,
    /// Those that come to rest, in the same place in both runs.
    rests: Vec<bool>,
    predictable: f64,
    /// The greatest energy of motion, and what lifting everything by a length unit takes.
    pub(super) energy_scale: f64,
    /// The greatest energy of motion and height at any time.
    pub(super) most_energy: f64,
}

impl Reference {
    pub(super) fn of(
        asked: &Asked,
        build: &impl Fn(&Choice) -> Result<PhysicsSimulator, String>,
    ) -> Result<Self, String> {
        let (looks, is_movable, unit_energy) = careful(asked, CAREFUL[0], build)?;
        let (other, ..) = careful(asked, CAREFUL[1], build)?;
        let is_same = |body: usize, at: usize| {
            distance(looks[at].bodies[body].position, other[at].bodies[body].position)
                <= SAME * asked.tolerance
        };
        // In one place by chance, after ways that cannot be told, is not where it has to be.
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
        let greatest = |of: fn(&Look) -> f64| looks.iter().map(of).fold(f64::NEG_INFINITY, f64::max);
        let energy_scale = greatest(|look| look.energy.motion) + unit_energy;
        let most_energy = greatest(|look| look.energy.total());
        Ok(Reference { looks, is_movable, rests, predictable, energy_scale, most_energy })
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

    /// The look at a time, if there was one then.
    pub(super) fn at(&self, time: f64, near: f64) -> Option<&Look> {
        let after = self.looks.partition_point(|look| look.time < time - near);
        self.looks.get(after).filter(|look| (look.time - time).abs() <= near)
    }

    pub(super) fn moving_bodies(&self) -> impl Iterator<Item = usize> + '_ {
        (0..self.is_movable.len()).filter(|&body| self.is_movable[body])
    }

    pub(super) fn resting_bodies(&self) -> impl Iterator<Item = usize> + '_ {
        (0..self.rests.len()).filter(|&body| self.rests[body])
    }

    /// Whether a time is in the last second, in which things are to have come to rest.
    pub(super) fn is_late(asked: &Asked, time: f64) -> bool {
        time > asked.seconds - window(asked)
    }
}

/// What is looked at in the end, in s: a second, or a quarter of a short run.
fn window(asked: &Asked) -> f64 {
    (asked.seconds / 4.0).min(1.0)
}

/// Whether a body keeps its place in the last second.
fn rests(asked: &Asked, body: usize, looks: &[Look]) -> bool {
    let end = looks[looks.len() - 1].bodies[body].position;
    let late = looks.iter().filter(|look| Reference::is_late(asked, look.time));
    late.into_iter().all(|look| distance(look.bodies[body].position, end) < 0.5 * asked.tolerance)
}

/// A careful run: what is seen of it at whole steps of the game, who can move, and what lifting everything by a unit takes.
fn careful(
    asked: &Asked,
    (parts, passes): (u16, u32),
    build: &impl Fn(&Choice) -> Result<PhysicsSimulator, String>,
) -> Result<(Vec<Look>, Vec<bool>, f64), String> {
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
    let stride = (steps / LOOKS).min(last_steps / LAST_LOOKS).max(1);
    let mut looks = vec![look(&simulator, asked, 0.0)];
    let dt = asked.dt / f32::from(parts);
    for step in 1..=steps {
        (0..parts).for_each(|_| simulator.update(dt));
        if step % stride == 0 || step == steps {
            looks.push(look(&simulator, asked, step as f64 * f64::from(asked.dt)));
            check(asked, &looks)?;
        }
    }
    Ok((looks, is_movable, unit_energy))
}

fn look(simulator: &PhysicsSimulator, asked: &Asked, time: f64) -> Look {
    let bodies = simulator.bodies().map(|body| BodyState::of(&simulator[body])).collect();
    let [overlap, gap] = apart(simulator, asked);
    Look { time, bodies, energy: Energy::of(simulator), overlap, gap }
}

/// Refuses a run that cannot be what a game wants.
fn check(asked: &Asked, looks: &[Look]) -> Result<(), String> {
    let (first, last) = (&looks[0], &looks[looks.len() - 1]);
    let reach = AWAY * f64::from(asked.length_unit);
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
