//! Measurements that are compared when a parameter changes: errors, verdicts and counts, but no times.

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

/// Name of the method that is measured, as in [`Method::name`].
const METHOD: &str = "Precise";
/// Number of random joint scenes for each of twelve variants.
const RANDOM: u32 = 25;
/// Values of joint scenes below these count as equal: gap in px, speed in px/s, energy gained as a fraction of the greatest
/// kinetic energy. Gap and speed are a tenth of a visible gap, and of the speed of a scene that does not come to rest.
const JOINT_FLOORS: [f64; 3] = [0.32, 1.6, ENERGY];
/// Number of Newton steps in a run below which two numbers count as equal.
const NEWTON_FLOOR: f64 = 100.0;

/// Kinds of rows, which are columns of the table of the program `sensitivity`.
pub const SETS: [&str; 5] = ["chart", "map", "joints", "random", "newton"];

/// One measured value or verdict, identified by kind and name.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Row {
    /// Kind of the row: one of [`SETS`].
    pub set: String,
    /// Name of the row within its kind: scene and setting, family and setting, or scene and quantity.
    pub name: String,
    /// Measured error or count; `None` if the row has a verdict alone, or if the run failed.
    pub value: Option<f64>,
    /// Values below this one count as equal. Unit: that of the row's value, such as px, px/s or dimensionless.
    pub floor: f64,
    /// Verdict in a few words, such as how the run ended or the first size at which a family fails; empty if the row has a
    /// value alone.
    pub verdict: String,
}

impl Row {
    fn new(set: &str, name: String, value: Option<f64>, floor: f64, verdict: impl Into<String>) -> Self {
        Row { set: set.to_owned(), name, value, floor, verdict: verdict.into() }
    }
}

/// Measures all rows with the engine with which this program is compiled: the quick charts and maps of the 2D and 2.5D
/// engine, joint scenes that are not large, and random joint scenes.
///
/// # Errors
///
/// The engine refuses a scene.
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

/// Returns the rows as a table with one line each.
pub fn rows_csv(rows: &[Row]) -> String {
    table(rows)
}

/// Reads the rows from a table that [`rows_csv`] has written.
///
/// # Errors
///
/// A line does not hold a row; the text names the first such line.
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

/// Returns a row for every setting of a family; its verdict is the first value of the parameter at which the family fails.
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

/// Returns a row with the number of Newton steps of the direct solver in a run of a joint scene.
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
