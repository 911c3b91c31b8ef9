//! Runs of a random scene in one engine: times, and errors that need no reference.

use super::RandomScene;
use crate::arena::engine::{EngineEntry, Result, State};
use crate::arena::judge::{gap, judge};
use crate::arena::play::Play;
use crate::arena::run::rounded;
use crate::arena::scene::{Body, Kind};
use serde::Serialize;
use std::panic::{AssertUnwindSafe, catch_unwind};

/// Number of steps at the end in which joint gaps and overlaps are measured.
const LAST: usize = 60;
/// Interval in steps between two measurements of overlaps.
const INTERVAL: usize = 15;
/// Number of steps at the end in which the fastest body tells whether the scene rests.
const REST: usize = 30;

/// Extent of a measurement of random scenes.
#[derive(Debug, Clone, Copy)]
pub struct Effort {
    /// Number of runs of each engine; the time of a step is its minimum over these runs.
    pub turns: usize,
    /// CPU time in s after which a run is ended; it then counts as failed.
    pub budget: f64,
}

/// Figures of a random scene in an engine: one line of the table.
///
/// Times are CPU times of steps in µs. `top_speed` is the greatest speed of a centre of mass at any step, `end_speed` that in
/// the last half second, both in m/s. `energy_gain` is the greatest rise of the total energy above that at the start, as a
/// fraction of the greatest kinetic energy; `None` if the scene is driven. `gap` and `deepest` are means over the last second,
/// in m: of the widest joint gap, and of the deepest overlap. `escaped` bodies are outside of the room at the end.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[expect(missing_docs, reason = "see above")]
pub struct RandomFigures {
    pub seed: u64,
    pub engine: &'static str,
    pub bodies: usize,
    pub joints: usize,
    pub first_us: f64,
    pub mean_us: f64,
    pub longest_us: f64,
    pub top_speed: f64,
    pub end_speed: f64,
    pub energy_gain: Option<f64>,
    pub escaped: usize,
    pub gap: f64,
    pub deepest: f64,
    /// Reason why the run has failed; empty if it has not. All figures but the times before it are then worthless.
    pub failure: String,
}

/// Plays a random scene in some engines by turns, and returns the figures in the order of `engines`.
pub fn play(random: &RandomScene, engines: &[EngineEntry], effort: Effort) -> Vec<RandomFigures> {
    let mut figures: Vec<RandomFigures> =
        engines.iter().map(|engine| RandomFigures::new(random, engine.name)).collect();
    let mut least: Vec<Vec<f64>> = engines.iter().map(|_| Vec::new()).collect();
    for turn in 0..effort.turns {
        for ((&engine, figures), least) in engines.iter().zip(&mut figures).zip(&mut least) {
            if !figures.failure.is_empty() {
                continue;
            }
            let mut watch = (turn == 0).then(|| RunWatch::new(random));
            let run = || run(random, engine, effort.budget, (&mut watch, figures));
            match catch_unwind(AssertUnwindSafe(run)).unwrap_or_else(|_| Err("panicked".into())) {
                Ok(times) if turn == 0 => *least = times,
                Ok(times) => least.iter_mut().zip(times).for_each(|(least, time)| *least = least.min(time)),
                Err(reason) => figures.failure = reason.to_string().replace([',', '\n'], " "),
            }
        }
    }
    for (figures, least) in figures.iter_mut().zip(least) {
        figures.set_times(&least);
    }
    figures
}

/// Makes all steps and returns their CPU times in s. With a watch it also measures errors.
fn run(
    random: &RandomScene,
    engine: EngineEntry,
    budget: f64,
    (watch, figures): (&mut Option<RunWatch>, &mut RandomFigures),
) -> Result<Vec<f64>> {
    let scene = &random.scene;
    let mut play = Play::new(scene, engine)?;
    let (mut times, mut total) = (Vec::with_capacity(scene.steps), 0.0);
    for step in 0..scene.steps {
        let time = play.step()?.as_secs_f64();
        total += time;
        times.push(time);
        if total > budget {
            return Err("too slow".into());
        }
        if let Some(watch) = watch {
            watch.observe(&mut play, scene.steps - step)?;
        }
    }
    if let Some(watch) = watch {
        figures.top_speed = rounded(watch.top_speed);
        figures.end_speed = rounded(watch.end_speed);
        let gain = (watch.highest - watch.first) / watch.kinetic;
        figures.energy_gain = (!random.is_driven).then(|| rounded(gain.max(0.0)));
        figures.gap = rounded(watch.gaps / LAST as f64);
        figures.deepest = rounded(watch.depths / (LAST / INTERVAL) as f64);
        figures.escaped = watch.escaped;
    }
    Ok(times)
}

impl RandomFigures {
    fn new(random: &RandomScene, engine: &'static str) -> Self {
        let is_dynamic = |body: &&Body| body.kind == Kind::Dynamic;
        RandomFigures {
            seed: random.seed,
            engine,
            bodies: random.scene.bodies.iter().filter(is_dynamic).count(),
            joints: random.scene.joints.len(),
            first_us: f64::NAN,
            mean_us: f64::NAN,
            longest_us: f64::NAN,
            top_speed: f64::NAN,
            end_speed: f64::NAN,
            energy_gain: None,
            escaped: 0,
            gap: f64::NAN,
            deepest: f64::NAN,
            failure: String::new(),
        }
    }

    fn set_times(&mut self, least: &[f64]) {
        let Some((first, later)) = least.split_first() else { return };
        self.first_us = rounded(1e6 * first);
        self.mean_us = rounded(1e6 * later.iter().sum::<f64>() / later.len() as f64);
        self.longest_us = rounded(1e6 * later.iter().copied().fold(0.0, f64::max));
    }
}

/// Greatest energies in J and speeds in m/s of a run so far, and sums over the last second of the widest joint gaps and the
/// deepest overlaps, in m.
struct RunWatch {
    gravity: f64,
    first: f64,
    highest: f64,
    kinetic: f64,
    top_speed: f64,
    end_speed: f64,
    gaps: f64,
    depths: f64,
    escaped: usize,
}

impl RunWatch {
    fn new(random: &RandomScene) -> Self {
        let gravity = -f64::from(random.scene.gravity[1]);
        let mut watch = RunWatch {
            gravity,
            first: 0.0,
            highest: f64::MIN,
            kinetic: 0.0,
            top_speed: 0.0,
            end_speed: 0.0,
            gaps: 0.0,
            depths: 0.0,
            escaped: 0,
        };
        for body in random.scene.bodies.iter().filter(|body| body.kind == Kind::Dynamic) {
            let start = State {
                position: body.position,
                angle: body.angle,
                velocity: body.velocity,
                spin: body.spin,
            };
            let (kinetic, potential) = watch.energies(body, &start);
            watch.first += kinetic + potential;
            watch.kinetic += kinetic + 0.5 * f64::from(body.mass);
        }
        watch
    }

    fn energies(&self, body: &Body, state: &State) -> (f64, f64) {
        let (mass, inertia) = (f64::from(body.mass), f64::from(body.inertia));
        let [vx, vy] = state.velocity.map(f64::from);
        let kinetic = 0.5 * (mass * (vx * vx + vy * vy) + inertia * f64::from(state.spin).powi(2));
        (kinetic, mass * self.gravity * f64::from(state.position[1]))
    }

    /// Observes the state after a step; `left` is the number of steps to the end, this one included.
    fn observe(&mut self, play: &mut Play<'_>, left: usize) -> Result<()> {
        let (mut kinetic, mut total, mut fastest) = (0.0, 0.0, 0.0_f64);
        for (index, body) in play.bodies.iter().enumerate() {
            let Some(body) = body.as_ref().filter(|body| body.kind == Kind::Dynamic) else { continue };
            let state = play.engine.state(index);
            let (moving, raised) = self.energies(body, &state);
            (kinetic, total) = (kinetic + moving, total + moving + raised);
            fastest = fastest.max(f64::from(state.velocity[0]).hypot(f64::from(state.velocity[1])));
        }
        if !total.is_finite() {
            return Err("not finite".into());
        }
        self.kinetic = self.kinetic.max(kinetic);
        self.highest = self.highest.max(total);
        self.top_speed = self.top_speed.max(fastest);
        if left <= REST {
            self.end_speed = self.end_speed.max(fastest);
        }
        if left <= LAST {
            self.gaps += widest_gap(play);
            if left % INTERVAL == 1 {
                let verdict = judge(play);
                (self.depths, self.escaped) = (self.depths + verdict.deepest, verdict.escaped);
            }
        }
        Ok(())
    }
}

/// Returns the widest gap of a joint in m.
fn widest_gap(play: &mut Play<'_>) -> f64 {
    let mut widest = 0.0_f64;
    for joint in play.joints.iter().flatten() {
        let states = joint.bodies.map(|index| play.engine.state(index));
        if let [Some(one), Some(two)] = joint.bodies.map(|index| play.bodies[index].as_ref()) {
            widest = widest.max(gap(joint, [one, two], states));
        }
    }
    widest
}
