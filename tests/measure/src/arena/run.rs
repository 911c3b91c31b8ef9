//! Runs scenes of the arena in all engines by turns: time per step, counters, and the state at the end.

use super::engine::{BOX2D, Counters, EngineEntry, OURS, RAPIER, Result};
use super::judge::{Verdict, judge};
use super::play::Play;
use super::scene::Scene;
use super::scenes::SceneEntry;
use crate::csv::table;
use serde::Serialize;

/// Extent of a measurement: number of runs, and limit of CPU time.
#[derive(Debug, Clone, Copy)]
pub struct Effort {
    /// Number of complete runs of each engine; the time of a step is its minimum over these runs.
    pub turns: usize,
    /// CPU time in s after which a run is ended.
    pub budget: f64,
}

/// Figures of a scene at one size in an engine: one line of a table.
///
/// Times are CPU times in µs. `build_us` is for adding all bodies and joints, `clear_us` for removing them one after the other
/// at the end. `mean_us` and `longest_us` are of the steps after the first that all engines made. Counts are means per step of
/// the [`Counters`]. All other figures are the [`Verdict`] on the state at the end: lengths in m, speed in m/s, energy in J.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[expect(missing_docs, reason = "see above")]
pub struct RunFigures {
    pub scene: &'static str,
    pub size: f32,
    pub engine: &'static str,
    pub bodies: usize,
    pub steps: usize,
    pub build_us: f64,
    pub first_us: f64,
    pub mean_us: f64,
    pub longest_us: f64,
    pub clear_us: f64,
    pub pairs: f64,
    pub manifolds: f64,
    pub aabbs: Option<f64>,
    pub awake: f64,
    pub contacts: usize,
    pub not_finite: usize,
    pub escaped: usize,
    pub deepest: f64,
    pub mean_overlap: f64,
    pub gap: f64,
    pub speed: f64,
    pub energy: f64,
    pub height: f64,
    pub highest: f64,
    pub state_ok: bool,
}

/// Runs a scene at one size in some engines by turns, and returns the figures in the order of `engines`.
///
/// # Errors
/// An engine refuses a body, a joint or a step.
pub fn run(
    entry: &SceneEntry,
    size: f32,
    engines: &[EngineEntry],
    effort: Effort,
) -> Result<Vec<RunFigures>> {
    let scene = (entry.build)(size);
    let mut runs: Vec<Timed> = engines.iter().map(|_| Timed::new()).collect();
    for _ in 0..effort.turns {
        for (run, &engine) in runs.iter_mut().zip(engines) {
            run.turn(&scene, engine, effort.budget)?;
        }
    }
    let common = runs.iter().map(|run| run.least.len()).min().unwrap_or(0);
    let figures =
        |(run, engine): (&Timed, &EngineEntry)| run.figures(entry, size, engine.name, (&scene, common));
    Ok(runs.iter().zip(engines).map(figures).collect())
}

/// Measurements of one engine over all turns.
struct Timed {
    /// Least CPU times in s, over all turns, of adding all bodies and joints, and of removing them.
    build: f64,
    clear: f64,
    /// Least CPU time in s of each step over all turns, for the steps that every turn made.
    least: Vec<f64>,
    counters: Vec<Counters>,
    verdict: Verdict,
}

impl Timed {
    fn new() -> Self {
        let (least, counters, verdict) = (Vec::new(), Vec::new(), Verdict::default());
        Timed { build: f64::INFINITY, clear: f64::INFINITY, least, counters, verdict }
    }

    /// Runs the scene until its last step or until the CPU time exceeds `budget` s. The first turn also reads counters and
    /// judges the final state, which is the same in all turns.
    fn turn(&mut self, scene: &Scene, engine: EngineEntry, budget: f64) -> Result<()> {
        let mut play = Play::new(scene, engine)?;
        let is_first = self.least.is_empty();
        let (mut times, mut total) = (Vec::with_capacity(scene.steps), 0.0);
        while times.len() < scene.steps && total <= budget {
            let time = play.step()?.as_secs_f64();
            total += time;
            times.push(time);
            if is_first {
                self.counters.push(play.engine().counters()?);
            }
        }
        if is_first {
            (self.least, self.verdict) = (times, judge(&mut play));
        } else {
            self.least.truncate(times.len());
            self.least.iter_mut().zip(times).for_each(|(least, time)| *least = least.min(time));
        }
        self.build = self.build.min(play.build_time().as_secs_f64());
        self.clear = self.clear.min(play.clear()?.as_secs_f64());
        Ok(())
    }

    fn figures(
        &self,
        entry: &SceneEntry,
        size: f32,
        engine: &'static str,
        (scene, common): (&Scene, usize),
    ) -> RunFigures {
        let after_first = self.least.get(1..common).unwrap_or(&[]);
        let mean = |of: &dyn Fn(&Counters) -> usize| {
            self.counters.iter().map(|counters| of(counters) as f64).sum::<f64>() / self.counters.len() as f64
        };
        let knows_aabbs = self.counters.iter().all(|counters| counters.aabbs.is_some());
        let verdict = &self.verdict;
        RunFigures {
            scene: entry.name,
            size,
            engine,
            bodies: verdict.bodies,
            steps: self.counters.len(),
            build_us: rounded(1e6 * self.build),
            clear_us: rounded(1e6 * self.clear),
            first_us: rounded(1e6 * self.least.first().copied().unwrap_or(f64::NAN)),
            mean_us: rounded(1e6 * after_first.iter().sum::<f64>() / after_first.len() as f64),
            longest_us: rounded(1e6 * after_first.iter().copied().fold(f64::NAN, f64::max)),
            pairs: rounded(mean(&|counters| counters.pairs)),
            manifolds: rounded(mean(&|counters| counters.manifolds)),
            aabbs: knows_aabbs.then(|| rounded(mean(&|counters| counters.aabbs.unwrap_or(0)))),
            awake: rounded(mean(&|counters| counters.awake)),
            contacts: verdict.contacts,
            not_finite: verdict.not_finite,
            escaped: verdict.escaped,
            deepest: rounded(verdict.deepest),
            mean_overlap: rounded(verdict.mean_overlap),
            gap: rounded(verdict.gap),
            speed: rounded(verdict.speed),
            energy: rounded(verdict.energy),
            height: rounded(verdict.height),
            highest: rounded(verdict.highest),
            state_ok: verdict.is_sound(&scene.limits),
        }
    }
}

/// Rounds a value to four significant digits.
pub(super) fn rounded(value: f64) -> f64 {
    if value == 0.0 || !value.is_finite() {
        return value;
    }
    let scale = 10_f64.powi(3 - value.abs().log10().floor() as i32);
    (value * scale).round() / scale
}

/// Comparison of our engine with the peers at one size: ratios of the times of [`RunFigures`], dimensionless; `None` if the
/// peer was not run.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[expect(missing_docs, reason = "see above and at `RunFigures`")]
pub struct Comparison {
    pub scene: &'static str,
    pub size: f32,
    pub bodies: usize,
    pub ratio_box2d: Option<f64>,
    pub ratio_rapier: Option<f64>,
    pub longest_ratio_box2d: Option<f64>,
    pub first_ratio_box2d: Option<f64>,
    pub build_ratio_box2d: Option<f64>,
    pub clear_ratio_box2d: Option<f64>,
    pub state_ok: bool,
}

/// Returns one comparison for each scene and size.
pub fn comparisons(runs: &[RunFigures]) -> Vec<Comparison> {
    let beside = |ours: &RunFigures| {
        let ratio = |peer: &str, time: fn(&RunFigures) -> f64| {
            let is_same =
                |run: &&RunFigures| (run.scene, run.size, run.engine) == (ours.scene, ours.size, peer);
            runs.iter().find(is_same).map(|peer| rounded(time(ours) / time(peer)))
        };
        Comparison {
            scene: ours.scene,
            size: ours.size,
            bodies: ours.bodies,
            ratio_box2d: ratio(BOX2D, |run| run.mean_us),
            ratio_rapier: ratio(RAPIER, |run| run.mean_us),
            longest_ratio_box2d: ratio(BOX2D, |run| run.longest_us),
            first_ratio_box2d: ratio(BOX2D, |run| run.first_us),
            build_ratio_box2d: ratio(BOX2D, |run| run.build_us),
            clear_ratio_box2d: ratio(BOX2D, |run| run.clear_us),
            state_ok: ours.state_ok,
        }
    };
    runs.iter().filter(|run| run.engine == OURS).map(beside).collect()
}

/// Exponent of the time per step as a power of the number of bodies, between two sizes: 1 if time is proportional to the
/// number of bodies.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[expect(missing_docs, reason = "see above")]
pub struct Growth {
    pub scene: &'static str,
    pub engine: &'static str,
    pub to_size: f32,
    pub from_bodies: usize,
    pub to_bodies: usize,
    pub exponent: f64,
}

/// Returns the growth of each scene and engine between neighbouring sizes.
pub fn growth(runs: &[RunFigures]) -> Vec<Growth> {
    let next = |index: usize, run: &RunFigures| {
        runs[index + 1..].iter().find(|next| (next.scene, next.engine) == (run.scene, run.engine))
    };
    let between = |(index, from): (usize, &RunFigures)| {
        let to = next(index, from)?;
        let exponent = (to.mean_us / from.mean_us).ln() / (to.bodies as f64 / from.bodies as f64).ln();
        Some(Growth {
            scene: from.scene,
            engine: from.engine,
            to_size: to.size,
            from_bodies: from.bodies,
            to_bodies: to.bodies,
            exponent: rounded(exponent),
        })
    };
    runs.iter().enumerate().filter_map(between).collect()
}

/// Returns rows as a table of comma-separated values, one line each.
pub fn arena_csv(rows: &[impl Serialize]) -> String {
    table(rows)
}
