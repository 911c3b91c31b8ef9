//! Tables of comma-separated values, and points of a sweep as such a table.

use super::method::{Dt, Setting};
use super::sweep::{Outcome, Point, Subject};
use csv::{Reader, Writer};
use serde::de::DeserializeOwned;
use serde::{Deserialize, Serialize, Serializer};
use std::fmt::Display;

/// Word for the outcome of a successful run in the table.
const FINE: &str = "fine";

/// One line of the table of points.
#[derive(Debug, Serialize, Deserialize)]
struct Row {
    scene: String,
    bodies: Option<usize>,
    method: String,
    #[serde(serialize_with = "plain")]
    dt_s: f32,
    jitter: bool,
    passes: u32,
    #[serde(serialize_with = "six_digits")]
    error: Option<f64>,
    error_is: String,
    unit: String,
    #[serde(serialize_with = "plain")]
    tolerance: f64,
    meets_tolerance: bool,
    outcome: String,
    #[serde(serialize_with = "three_places")]
    us_per_simulated_s: Option<f64>,
    steps: u32,
    turns: usize,
}

/// Returns a table with one line for each point. Points of a scene that is not in `subjects` are omitted.
pub fn csv(points: &[Point], subjects: &[Subject]) -> String {
    let known = |point: &Point| subjects.iter().find(|subject| subject.name == point.scene);
    table(points.iter().filter_map(|point| Some(row(point, known(point)?))))
}

/// Reads the points from a table that [`csv()`] has written.
///
/// # Errors
///
/// The first fault of the table, with its line number.
pub fn points(text: &str) -> Result<Vec<Point>, String> {
    Ok(rows::<Row>(text)?.into_iter().map(point).collect())
}

fn row(point: &Point, subject: &Subject) -> Row {
    let (outcome, error) = match point.outcome {
        Outcome::Fine => (FINE, Some(point.error)),
        Outcome::Failed(reason) => (reason, None),
    };
    let time = point.microseconds_per_simulated_second;
    Row {
        scene: point.scene.to_owned(),
        bodies: (point.size != 0).then_some(point.size),
        method: point.method.to_owned(),
        dt_s: point.setting.dt.mean(),
        jitter: matches!(point.setting.dt, Dt::Jitter { .. }),
        passes: point.setting.passes,
        error,
        error_is: subject.error.to_owned(),
        unit: subject.unit.to_owned(),
        tolerance: subject.tolerance,
        meets_tolerance: point.meets(subject.tolerance),
        outcome: outcome.to_owned(),
        us_per_simulated_s: (!time.is_nan()).then_some(time),
        steps: point.steps,
        turns: point.turns,
    }
}

fn point(row: Row) -> Point {
    let setting = if row.jitter { Setting::jitter } else { Setting::fixed };
    Point {
        scene: kept(row.scene),
        size: row.bodies.unwrap_or(0),
        method: kept(row.method),
        setting: setting(row.dt_s, row.passes),
        error: row.error.unwrap_or(f64::INFINITY),
        outcome: if row.outcome == FINE { Outcome::Fine } else { Outcome::Failed(kept(row.outcome)) },
        microseconds_per_simulated_second: row.us_per_simulated_s.unwrap_or(f64::NAN),
        steps: row.steps,
        turns: row.turns,
    }
}

/// Returns a table: a line with the names of the fields, then one line for each row. Texts with commas are quoted.
pub(super) fn table(rows: impl IntoIterator<Item = impl Serialize>) -> String {
    let mut writer = Writer::from_writer(Vec::new());
    for row in rows {
        writer.serialize(row).expect("rows of one kind can be written to memory");
    }
    let bytes = writer.into_inner().expect("memory can be written to");
    String::from_utf8(bytes).expect("rows are text")
}

/// Reads the rows of a table. An empty text has no rows; a table with a header alone is an error, since it must have been
/// cut off.
pub(super) fn rows<R: DeserializeOwned>(text: &str) -> Result<Vec<R>, String> {
    let rows: csv::Result<Vec<R>> = Reader::from_reader(text.as_bytes()).deserialize().collect();
    match rows {
        Ok(rows) if rows.is_empty() && !text.is_empty() => Err("there is nothing below line 1".to_owned()),
        Ok(rows) => Ok(rows),
        Err(error) => Err(error.to_string()),
    }
}

/// Writes a number without a trailing `.0`: 8 and not 8.0.
fn plain<S: Serializer>(value: &impl Display, serializer: S) -> Result<S::Ok, S::Error> {
    serializer.collect_str(value)
}

fn six_digits<S: Serializer>(value: &Option<f64>, serializer: S) -> Result<S::Ok, S::Error> {
    match value {
        Some(value) => serializer.collect_str(&format_args!("{value:.5e}")),
        None => serializer.serialize_none(),
    }
}

fn three_places<S: Serializer>(value: &Option<f64>, serializer: S) -> Result<S::Ok, S::Error> {
    match value {
        Some(value) => serializer.collect_str(&format_args!("{value:.3}")),
        None => serializer.serialize_none(),
    }
}

/// Returns a `'static` copy of a text, which is never freed: names in points are `'static`.
pub(super) fn kept(text: String) -> &'static str {
    Box::leak(text.into_boxed_str())
}

#[cfg(test)]
mod tests {
    use super::*;

    fn subject() -> Subject {
        Subject {
            name: "drop",
            about: "",
            sizes: vec![5],
            error: "height, largest",
            unit: "px",
            tolerance: 0.5,
        }
    }

    fn failed() -> Point {
        Point {
            scene: "drop",
            size: 5,
            method: "Farseer, SAT",
            setting: Setting::jitter(0.016, 5),
            error: f64::INFINITY,
            outcome: Outcome::Failed("flew off"),
            microseconds_per_simulated_second: 12.0,
            steps: 7,
            turns: 3,
        }
    }

    #[test]
    fn a_failed_point_says_why_and_has_no_error() {
        let text = csv(&[failed()], &[subject()]);
        let line =
            "drop,5,\"Farseer, SAT\",0.016,true,5,,\"height, largest\",px,0.5,false,flew off,12.000,7,3";
        assert_eq!(text.lines().nth(1), Some(line));
    }

    #[test]
    fn points_that_are_written_are_read() {
        let fine = Point {
            size: 0,
            setting: Setting::fixed(1.0 / 60.0, 5),
            error: 0.25,
            outcome: Outcome::Fine,
            ..failed()
        };
        let both = [failed(), fine];
        assert_eq!(points(&csv(&both, &[subject()])), Ok(both.to_vec()));
    }

    #[test]
    fn a_text_that_is_no_table_of_points_is_refused() {
        assert!(points("scene,bodies\n").is_err_and(|error| error.contains("line 1")));
        assert!(
            points("scene,bodies\ndrop,5\n").is_err_and(|error| error.contains("missing field `method`"))
        );
        let text = csv(&[failed()], &[subject()]).replace("12.000", "twelve");
        assert!(
            points(&text).is_err_and(|error| error.contains("line: 2") && error.contains("invalid float"))
        );
    }
}
