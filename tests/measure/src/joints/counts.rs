//! Counts, among random joint scenes in an engine, those that blow up, have wide joint gaps, gain energy or do not come to
//! rest.

use super::engines::{Engine, SETTING};
use super::gauge::{Gauge, worst};
use super::random::{Crowd, UPDATES, Variant, scene, variants};
use crate::csv::table;
use crate::stopwatch::Stopwatch;
use serde::Serialize;
use std::time::Duration;

/// Least speed in px/s of a point that counts as wild: no fall or swing in these scenes reaches it.
const WILD_SPEED: f64 = 3000.0;
/// Least joint gap at the end of a run that a player sees, in px: a tenth of a metre.
const GAPING: f64 = 3.2;
/// Least speed of a point, in px/s, for which a scene counts as not at rest at the end: half a metre per second.
const RESTLESS: f64 = 16.0;
/// Greatest gap in px that enters the mean over scenes; wider gaps are clamped to it.
const GREATEST_GAP: f64 = 100.0;
/// Number of updates at the end of a run (1 s) whose speeds and gaps count.
const END_UPDATES: u32 = 60;

/// Failures of the random scenes of one variant in an engine: one line of the table.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Counts {
    /// Name of the variant.
    pub variant: String,
    /// Name of the engine.
    pub engine: &'static str,
    /// Number of scenes that were run.
    pub scenes: u32,
    /// Number of scenes in which a point of a body is faster than 3,000 px/s after any update.
    pub wild: u32,
    /// Number of scenes that gain more energy than [the variant permits](Variant::energy_bound).
    pub gaining: u32,
    /// Number of scenes with a joint gap of 3.2 px or more in the last second.
    pub gaping: u32,
    /// Number of scenes with gravity in which a point of a body is faster than 16 px/s in the last second.
    pub restless: u32,
    /// Mean over the scenes of the widest joint gap in the last second, in px; each gap is clamped to 100 px.
    pub mean_gap_px: f64,
    /// Mean CPU time of an update in µs.
    pub us_per_update: f64,
}

/// Errors of one random scene in an engine.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Outcome {
    /// Greatest speed of a point of a body after any update, in px/s.
    pub speed: f64,
    /// Greatest speed of a point of a body in the last second, in px/s.
    pub speed_at_end: f64,
    /// Greatest increase of the total energy since the start, divided by the mass of all bodies, in px²/s².
    pub gain: f64,
    /// Widest joint gap in the last second, in px.
    pub gap: f64,
    /// CPU time of all updates together.
    pub time: Duration,
}

impl Outcome {
    /// Returns whether a point was faster than any fall or swing of the scene.
    pub fn is_wild(&self) -> bool {
        self.speed >= WILD_SPEED
    }

    /// Returns whether the scene gained more energy than the variant permits.
    pub fn is_gaining(&self, variant: Variant) -> bool {
        self.gain >= variant.energy_bound()
    }
}

/// Runs the random scene of a seed in an engine.
///
/// # Errors
///
/// The engine refuses the scene.
pub fn outcome(seed: u64, variant: Variant, engine: &Engine) -> Result<Outcome, String> {
    let assembly = scene(seed, variant);
    let mut world = (engine.build)(&assembly, SETTING)?;
    let gauge = Gauge::new(&assembly);
    let (mass, start) = (gauge.mass(), gauge.energy(&*world).total);
    let mut outcome = Outcome { speed: 0.0, speed_at_end: 0.0, gain: 0.0, gap: 0.0, time: Duration::ZERO };
    for update in 0..UPDATES {
        let stopwatch = Stopwatch::start();
        world.step(SETTING.dt.mean());
        outcome.time += stopwatch.elapsed();
        let speed = gauge.speed(&*world);
        outcome.speed = worst(outcome.speed, speed);
        outcome.gain = worst(outcome.gain, (gauge.energy(&*world).total - start) / mass);
        if update + END_UPDATES >= UPDATES {
            outcome.speed_at_end = worst(outcome.speed_at_end, speed);
            outcome.gap = worst(outcome.gap, gauge.gap(&*world));
        }
    }
    Ok(outcome)
}

/// Runs the random scenes of the seeds 0 to `scenes - 1` in an engine, and counts the failures.
fn count(scenes: u32, variant: Variant, engine: &Engine) -> Result<Counts, String> {
    let outcomes = (0..scenes).map(|seed| outcome(u64::from(seed), variant, engine));
    let outcomes = outcomes.collect::<Result<Vec<_>, _>>()?;
    let number = |holds: &dyn Fn(&Outcome) -> bool| outcomes.iter().filter(|one| holds(one)).count() as u32;
    let rests = variant.crowd != Crowd::Weightless;
    let time: Duration = outcomes.iter().map(|one| one.time).sum();
    let gaps: f64 = outcomes.iter().map(|one| one.gap.min(GREATEST_GAP)).sum();
    Ok(Counts {
        variant: variant.name(),
        engine: engine.name,
        scenes,
        wild: number(&Outcome::is_wild),
        gaining: number(&|one| one.is_gaining(variant)),
        gaping: number(&|one| one.gap >= GAPING),
        restless: number(&|one| rests && one.speed_at_end >= RESTLESS),
        mean_gap_px: gaps / f64::from(scenes),
        us_per_update: time.as_secs_f64() * 1e6 / f64::from(scenes * UPDATES),
    })
}

/// Returns the sums of the counts of an engine, and the means of gap and time. Variants must have equal numbers of scenes.
/// `None` if `counts` is empty.
fn total(counts: &[Counts]) -> Option<Counts> {
    let sum = |of: fn(&Counts) -> u32| counts.iter().map(of).sum();
    let mean = |of: fn(&Counts) -> f64| counts.iter().map(of).sum::<f64>() / counts.len() as f64;
    Some(Counts {
        variant: "all".to_owned(),
        engine: counts.first()?.engine,
        scenes: sum(|count| count.scenes),
        wild: sum(|count| count.wild),
        gaining: sum(|count| count.gaining),
        gaping: sum(|count| count.gaping),
        restless: sum(|count| count.restless),
        mean_gap_px: mean(|count| count.mean_gap_px),
        us_per_update: mean(|count| count.us_per_update),
    })
}

/// Runs `scenes` random scenes of every variant in each engine. Returns the counts of the variants, and after them the sum
/// for each engine.
///
/// # Errors
///
/// An engine refuses a scene.
pub fn counts(scenes: u32, engines: &[Engine]) -> Result<Vec<Counts>, String> {
    let mut all = Vec::new();
    for engine in engines {
        let counts = variants().map(|variant| count(scenes, variant, engine));
        let counts = counts.collect::<Result<Vec<_>, _>>()?;
        let total = total(&counts);
        all.extend(counts.into_iter().chain(total));
    }
    Ok(all)
}

/// Returns the counts as a table with one line for every variant and engine.
pub fn counts_csv(counts: &[Counts]) -> String {
    table(counts)
}
