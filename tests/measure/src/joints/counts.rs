//! Random joint scenes in an engine: how many of them blow up, gape or do not rest.

use super::engines::{Engine, SETTING};
use super::gauge::{Gauge, worst};
use super::random::{Crowd, UPDATES, Variant, scene, variants};
use crate::csv::table;
use crate::stopwatch::Stopwatch;
use serde::Serialize;
use std::time::Duration;

/// Speed in px/s that falls and swings of these scenes do not reach.
const WILD: f64 = 3000.0;
/// A gap at the end that a player sees, in px: a tenth of a metre.
const GAPING: f64 = 3.2;
/// Speed at the end in px/s of a scene that does not rest: half a metre per second.
const RESTLESS: f64 = 16.0;
/// Most that the gap of a scene counts in the mean, in px.
const GREATEST_GAP: f64 = 100.0;
/// Updates at the end whose speeds and gaps count.
const END: u32 = 60;

/// Scenes of a variant in an engine.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Counts {
    /// Name of the variant.
    pub variant: String,
    /// Name of the engine.
    pub engine: &'static str,
    /// Number of scenes.
    pub scenes: u32,
    /// Scenes in which a point of a body is faster than 3,000 px/s after any update.
    pub wild: u32,
    /// Scenes that win more energy than the variant [may](Variant::energy_bound).
    pub gaining: u32,
    /// Scenes with a gap of 3.2 px or more in the last second.
    pub gaping: u32,
    /// Scenes with gravity in which a point of a body is faster than 16 px/s in the last second.
    pub restless: u32,
    /// Mean of the widest gaps in the last second in px, each at most 100.
    pub mean_gap_px: f64,
    /// Mean CPU time of an update in µs.
    pub us_per_update: f64,
}

/// One random scene in an engine.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Outcome {
    /// The greatest speed of a point after any update, and in the last second, in px/s.
    pub speed: f64,
    /// See [`speed`](Self::speed).
    pub speed_at_end: f64,
    /// Most energy above that at the start, by the mass of all bodies, in px²/s².
    pub gain: f64,
    /// The widest gap in the last second in px.
    pub gap: f64,
    /// CPU time of all updates.
    pub time: Duration,
}

impl Outcome {
    /// Whether a point is faster than anything that falls and swings.
    pub fn is_wild(&self) -> bool {
        self.speed >= WILD
    }

    /// Whether the scene wins energy.
    pub fn is_gaining(&self, variant: Variant) -> bool {
        self.gain >= variant.energy_bound()
    }
}

/// Plays the scene of a seed.
///
/// # Errors
///
/// When the engine refuses it.
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
        if update + END >= UPDATES {
            outcome.speed_at_end = worst(outcome.speed_at_end, speed);
            outcome.gap = worst(outcome.gap, gauge.gap(&*world));
        }
    }
    Ok(outcome)
}

/// Plays the scenes of the seeds from 0 on.
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

/// The sum of the counts of an engine, whose variants have equal numbers of scenes.
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

/// Plays so many scenes of every variant in some engines, and appends their sum for each engine.
///
/// # Errors
///
/// When an engine refuses a scene.
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

/// A line for every variant and engine.
pub fn counts_csv(counts: &[Counts]) -> String {
    table(counts)
}
