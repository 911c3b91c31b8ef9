//! Plays a joint scene: once to measure errors, by turns to measure time, and once with sleep.

use super::engines::{Engine, SETTING};
use super::family::JointScene;
use super::gauge::{Gauge, worst};
use super::table::{Figures, four_digits};
use crate::stopwatch::Stopwatch;
use crate::world::{World, distance};
use std::ops::Range;
use std::time::Duration;

/// Updates in a second: the first second, and the last one in which errors count.
const SECOND: u32 = 60;
/// Least kinetic energy that an energy gain is compared with: that of the whole scene at 1 m/s, in px/s.
const REFERENCE_SPEED: f64 = 32.0;

/// A scene in an engine.
struct Player<'a> {
    scene: &'a JointScene,
    world: Box<dyn World>,
}

/// CPU time of a run.
#[derive(Debug, Clone, Copy)]
struct Times {
    first_step: Duration,
    /// The first update included.
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

    /// All errors. Energy is looked at after every update, which counts the turns of all bodies as well.
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
        // A scene that blows up to infinity has won all that it has.
        let part = if gain.is_finite() && kinetic.is_finite() { gain / kinetic } else { f64::INFINITY };
        let place = |body: usize| self.world.body(body).place();
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

/// Plays a scene in some engines, timed so many times by turns, and returns their figures in that order.
///
/// # Errors
///
/// When an engine refuses the scene.
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
