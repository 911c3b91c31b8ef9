//! Runs a joint scene: once to measure errors, by turns to measure time, and once with sleep.

use super::engines::{Engine, SETTING};
use super::family::JointScene;
use super::gauge::{Gauge, worst};
use super::table::{Figures, four_digits};
use crate::stopwatch::Stopwatch;
use crate::world::{World, distance};
use std::ops::Range;
use std::time::Duration;

/// Number of updates in 1 s. Times of the first second are separate; errors count in the last second.
const SECOND: u32 = 60;
/// Reference speed in px/s (1 m/s): an energy gain is a fraction of at least the kinetic energy of all bodies at this speed.
const REFERENCE_SPEED: f64 = 32.0;

/// A joint scene in the world of an engine, which is stepped.
struct Player<'a> {
    scene: &'a JointScene,
    world: Box<dyn World>,
}

/// CPU times of one run.
#[derive(Debug, Clone, Copy)]
struct Times {
    first_step: Duration,
    /// CPU time of the first second, including the first update.
    first_second: Duration,
    whole: Duration,
}

impl<'a> Player<'a> {
    fn new(scene: &'a JointScene, engine: &Engine) -> Result<Self, String> {
        let built = (engine.build)(&scene.assembly, SETTING);
        let world = built.map_err(|reason| format!("{}, {}: {reason}", scene.name, engine.name))?;
        Ok(Player { scene, world })
    }

    fn step(&mut self, step: u32) {
        if let Some(pull) = self.scene.pull {
            pull.act(step, &self.scene.assembly, &mut *self.world);
        }
        self.world.step(SETTING.dt.mean());
    }

    fn timed(&mut self, steps: Range<u32>) -> Duration {
        let stopwatch = Stopwatch::start();
        steps.for_each(|step| self.step(step));
        stopwatch.elapsed()
    }

    fn times(mut self) -> Times {
        let steps = self.scene.steps();
        let first_step = self.timed(0..1);
        let first_second = first_step + self.timed(1..SECOND);
        let whole = first_second + self.timed(SECOND..steps);
        Times { first_step, first_second, whole }
    }

    /// Runs the scene and returns gap, displacement, speed and energy gain; other fields have default values. Energy is
    /// measured after every update.
    fn errors(mut self) -> Figures {
        let (scene, gauge) = (self.scene, Gauge::new(&self.scene.assembly));
        let start = gauge.energy(&*self.world);
        let least = 0.5 * gauge.mass() * REFERENCE_SPEED * REFERENCE_SPEED;
        let (mut gain, mut kinetic) = (0.0, worst(least, start.kinetic));
        let (mut gap, mut speed) = (0.0, 0.0);
        for step in 0..scene.steps() {
            self.step(step);
            let energy = gauge.energy(&*self.world);
            gain = worst(gain, energy.total - start.total);
            kinetic = worst(kinetic, energy.kinetic);
            if step + SECOND >= scene.steps() {
                gap = worst(gap, gauge.gap(&*self.world));
                speed = worst(speed, gauge.speed(&*self.world));
            }
        }
        // If an energy is infinite or NaN, the gain counts as infinite.
        let part = if gain.is_finite() && kinetic.is_finite() { gain / kinetic } else { f64::INFINITY };
        let place = |body: usize| self.world.body(body).position_in_plane();
        let off = scene.watched.map(|(body, at)| worst(0.0, distance(place(body), at.map(f64::from))));
        Figures {
            gap_px: four_digits(gap),
            displacement_px: off.map(four_digits),
            speed_px_per_s: four_digits(speed),
            energy_gained: (!scene.is_driven()).then_some(four_digits(part)),
            ..Figures::default()
        }
    }

    fn ends_asleep(mut self) -> bool {
        self.world.set_sleep_enabled(true);
        (0..self.scene.steps()).for_each(|step| self.step(step));
        Gauge::new(&self.scene.assembly).is_asleep(&*self.world)
    }
}

/// Runs a scene in each of `engines`, `turns` times by turns for the times, and returns the figures in the order of
/// `engines`.
///
/// # Errors
///
/// An engine refuses the scene.
pub fn run(scene: &JointScene, engines: &[Engine], turns: usize) -> Result<Vec<Figures>, String> {
    let mut times = vec![Vec::new(); engines.len()];
    for turn in 0..turns {
        for index in (0..engines.len()).map(|index| (index + turn) % engines.len()) {
            times[index].push(Player::new(scene, &engines[index])?.times());
        }
    }
    engines.iter().zip(times).map(|(engine, times)| figures(scene, engine, &times)).collect()
}

fn figures(scene: &JointScene, engine: &Engine, times: &[Times]) -> Result<Figures, String> {
    let median = |of: fn(&Times) -> Duration| crate::sweep::median(times.iter().map(of).collect());
    let us = |of, steps: u32| {
        let time = median(of).map_or(f64::NAN, |time| time.as_secs_f64());
        four_digits(time * 1e6 / f64::from(steps))
    };
    Ok(Figures {
        scene: scene.name.clone(),
        engine: engine.name.to_owned(),
        bodies: scene.assembly.bodies.len(),
        joints: scene.joints(),
        seconds: scene.seconds,
        is_asleep: Player::new(scene, engine)?.ends_asleep(),
        us_first_step: us(|times| times.first_step, 1),
        us_first_second: us(|times| times.first_second, SECOND),
        us_later: us(|times| times.whole - times.first_second, scene.steps() - SECOND),
        ms_whole: us(|times| times.whole, 1000),
        ..Player::new(scene, engine)?.errors()
    })
}
