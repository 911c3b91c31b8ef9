//! Measurements that are compared: errors, verdicts and counts, and no times.

use crate::charts::chart_scenes;
use crate::csv::table;
use crate::depth::{depth_chart_scenes, depth_families, depth_methods};
use crate::engines::plane::FarseerWorld;
use crate::joints::build::simulator;
use crate::joints::counts::counts;
use crate::joints::engines::OURS;
use crate::joints::family::{JointScene, family};
use crate::joints::judge::ENERGY;
use crate::joints::run::run;
use crate::method::{Effort, Method, methods};
use crate::stability::map::Sheet;
use crate::stability::{families, sheet::sheet};
use crate::sweep::{Outcome, Trial};
use crate::trials::trials;
use crate::world::World;
use serde::{Deserialize, Serialize};

/// Name of the method that is measured.
const METHOD: &str = "Precise";
/// Random joint scenes of each of twelve variants.
const RANDOM: u32 = 25;
/// Errors of joint scenes below these are equal: gap in px, speed in px/s, energy gained as a part of the greatest kinetic energy. A
/// tenth of a gap that is seen, and of the speed of a scene that does not rest.
const JOINT_FLOORS: [f64; 3] = [0.32, 1.6, ENERGY];
/// Newton steps of a scene's run below which numbers of them are equal.
const NEWTON_FLOOR: f64 = 100.0;

/// Kinds of rows: columns of the table of the program `sensitivity`.
pub const SETS: [&str; 5] = ["chart", "map", "joints", "random", "newton"];

/// A measurement.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Row {
    /// One of [`SETS`].
    pub set: String,
    /// Scene and setting, family and setting, or scene and quantity.
    pub name: String,
    /// An error or a count; nothing where there is a verdict alone, or where a run failed.
    pub value: Option<f64>,
    /// Values below it are equal.
    pub floor: f64,
    /// A word, if there is more to compare than a value: how a run ended, or the first size at which a family fails.
    pub verdict: String,
}

impl Row {
    fn new(set: &str, name: String, value: Option<f64>, floor: f64, verdict: impl Into<String>) -> Self {
        Row { set: set.to_owned(), name, value, floor, verdict: verdict.into() }
    }
}

/// Measures all rows with the engine that this is compiled with: the quick chart and the quick map of both engines, joint scenes that are
/// not large, and random ones.
///
/// # Errors
///
/// When the engine refuses a scene.
pub fn measured() -> Result<Vec<Row>, String> {
    let mut rows = Vec::new();
    let (plane, depth) = (precise(methods()), precise(depth_methods()));
    let (scenes, depth_scenes) = (chart_scenes(), depth_chart_scenes());
    let floors = scenes.iter().map(|scene| (scene.name, scene.tolerance));
    let floors: Vec<_> =
        floors.chain(depth_scenes.iter().map(|scene| (scene.name, scene.tolerance))).collect();
    for trial in
        trials(&scenes, &plane, Effort::Quick).iter().chain(&trials(&depth_scenes, &depth, Effort::Quick))
    {
        rows.extend(chart_rows(trial, &floors)?);
    }
    for family in families() {
        rows.extend(map_rows(&sheet(family, &plane, Effort::Quick)));
    }
    for family in depth_families() {
        rows.extend(map_rows(&sheet(family, &depth, Effort::Quick)));
    }
    for scene in family().iter().filter(|scene| !scene.is_large) {
        rows.extend(joint_rows(scene)?);
        rows.push(newton_row(scene)?);
    }
    rows.extend(random_rows()?);
    Ok(rows)
}

/// A line for every row.
pub fn rows_csv(rows: &[Row]) -> String {
    table(rows)
}

/// The rows of a table that [`rows_csv`] has written.
///
/// # Errors
///
/// The first line that is none.
pub fn read_rows(text: &str) -> Result<Vec<Row>, String> {
    crate::csv::rows(text)
}

fn precise<S>(methods: Vec<Method<S>>) -> Vec<Method<S>> {
    methods.into_iter().filter(|method| method.name == METHOD).collect()
}

fn chart_rows(trial: &Trial<'_>, tolerances: &[(&str, f64)]) -> Result<Vec<Row>, String> {
    let row = |(scene, error, outcome): (&str, f64, Outcome)| {
        let tolerance =
            tolerances.iter().find(|(name, _)| *name == scene).map_or(0.0, |(_, tolerance)| *tolerance);
        let verdict = match outcome {
            Outcome::Failed(reason) => reason,
            Outcome::Fine if error <= tolerance => "within tolerance",
            Outcome::Fine => "beyond tolerance",
        };
        let name = format!("{scene} {}, {}", trial.size, trial.setting.label());
        Row::new("chart", name, Some(error).filter(|error| error.is_finite()), 0.1 * tolerance, verdict)
    };
    Ok(trial.measured()?.into_iter().map(row).collect())
}

/// A row for every setting of a family: the first value at which it fails.
fn map_rows(sheet: &Sheet) -> Vec<Row> {
    let map = sheet.fill(&|| {});
    let row = |(column, heading): (usize, &crate::stability::map::Column)| {
        let verdict = match map.first_failure(column) {
            Some((value, reason)) => format!("{reason} at {value}"),
            None => "holds".to_owned(),
        };
        let name = format!("{}, {} s x {}", map.heading.name, heading.dt, heading.passes);
        Row::new("map", name, None, 0.0, verdict)
    };
    map.heading.columns.iter().enumerate().map(row).collect()
}

fn joint_rows(scene: &JointScene) -> Result<Vec<Row>, String> {
    let figures = run(scene, &[OURS], 0)?.remove(0);
    let sleep = if figures.is_asleep { "asleep" } else { "awake" };
    let row = |(quantity, value, verdict): (&str, Option<f64>, &str), floor: f64| {
        Row::new("joints", format!("{}, {quantity}", scene.name), value, floor, verdict)
    };
    let energy = match figures.energy_gained {
        Some(gained) if gained > ENERGY => "gains",
        Some(_) => "keeps",
        None => "",
    };
    let values = [
        ("gap", Some(figures.gap_px), ""),
        ("speed", Some(figures.speed_px_per_s), sleep),
        ("energy", figures.energy_gained, energy),
    ];
    Ok(values.into_iter().zip(JOINT_FLOORS).map(|(value, floor)| row(value, floor)).collect())
}

/// Newton steps of a run.
fn newton_row(scene: &JointScene) -> Result<Row, String> {
    let passes = i32::try_from(crate::joints::engines::SETTING.passes).map_err(|error| error.to_string())?;
    let (simulator, bodies) = simulator(&scene.assembly, passes).map_err(|error| error.to_string())?;
    let mut world = FarseerWorld::with_bodies(simulator, bodies);
    let mut sum = 0;
    for step in 0..scene.steps() {
        if let Some(pull) = scene.pull {
            pull.act(step, &scene.assembly, &mut world);
        }
        world.step(crate::joints::engines::SETTING.dt.mean());
        sum += world.simulator().islands().iter().map(|island| island.cost.newton_steps).sum::<usize>();
    }
    Ok(Row::new("newton", scene.name.clone(), Some(sum as f64), NEWTON_FLOOR, ""))
}

fn random_rows() -> Result<Vec<Row>, String> {
    let all = counts(RANDOM, &[OURS])?.pop().ok_or("there are no variants of random scenes")?;
    let counts =
        [("wild", all.wild), ("gaining", all.gaining), ("gaping", all.gaping), ("restless", all.restless)];
    let row = |(name, count): (&str, u32)| Row::new("random", name.to_owned(), Some(count.into()), 0.0, "");
    Ok(counts.into_iter().map(row).collect())
}
