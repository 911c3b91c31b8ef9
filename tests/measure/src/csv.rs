//! Points as a table of comma-separated values, written and read.

use super::method::{Dt, Setting};
use super::sweep::{Outcome, Point, Subject};
use csv::{Reader, StringRecord, Writer};

/// The names of the columns.
const HEAD: [&str; 15] = [
    "scene",
    "bodies",
    "method",
    "dt_s",
    "jitter",
    "passes",
    "error",
    "error_is",
    "unit",
    "tolerance",
    "meets_tolerance",
    "outcome",
    "us_per_simulated_s",
    "steps",
    "turns",
];
/// What is written of a run that went well.
const FINE: &str = "fine";

/// A table of points, a line each. Points of a scene that is not among the subjects are left out.
pub fn csv(points: &[Point], subjects: &[Subject]) -> String {
    let known = |point: &Point| subjects.iter().find(|subject| subject.name == point.scene);
    let rows = points.iter().filter_map(|point| Some(row(point, known(point)?).to_vec()));
    table([HEAD.map(str::to_owned).to_vec()].into_iter().chain(rows))
}

/// Rows as lines, with quotes where they are needed.
pub(super) fn table(rows: impl IntoIterator<Item = Vec<String>>) -> String {
    let mut writer = Writer::from_writer(Vec::new());
    for row in rows {
        writer.write_record(row).expect("rows of one length can be written to memory");
    }
    let bytes = writer.into_inner().expect("memory can be written to");
    String::from_utf8(bytes).expect("rows are text")
}

fn row(point: &Point, subject: &Subject) -> [String; 15] {
    let (outcome, error) = match point.outcome {
        Outcome::Fine => (FINE, format!("{:.5e}", point.error)),
        Outcome::Failed(reason) => (reason, String::new()),
    };
    let time = point.microseconds_per_simulated_second;
    [
        point.scene.to_owned(),
        if point.size == 0 { String::new() } else { point.size.to_string() },
        point.method.to_owned(),
        point.setting.dt.mean().to_string(),
        matches!(point.setting.dt, Dt::Jitter { .. }).to_string(),
        point.setting.passes.to_string(),
        error,
        subject.error.to_owned(),
        subject.unit.to_owned(),
        subject.tolerance.to_string(),
        point.meets(subject.tolerance).to_string(),
        outcome.to_owned(),
        if time.is_nan() { String::new() } else { format!("{time:.3}") },
        point.steps.to_string(),
        point.turns.to_string(),
    ]
}

/// The points of a table that [`csv()`] has written.
///
/// # Errors
///
/// What is wrong with the table, and in which line.
pub fn points(text: &str) -> Result<Vec<Point>, String> {
    let mut reader = Reader::from_reader(text.as_bytes());
    let head = reader.headers().map_err(|error| error.to_string())?;
    if head != HEAD.as_slice() {
        return Err(format!("line 1: the columns are not {}", HEAD.join(",")));
    }
    let rows = reader.records().zip(2..);
    let point = |(row, line): (csv::Result<StringRecord>, u32)| {
        let row = row.map_err(|error| error.to_string())?;
        point(&row).map_err(|wrong| format!("line {line}: {wrong}"))
    };
    rows.map(point).collect()
}

fn point(row: &StringRecord) -> Result<Point, String> {
    let dt = number(row, 3)?;
    let passes = number(row, 5)?;
    let outcome = if &row[11] == FINE { Outcome::Fine } else { Outcome::Failed(kept(&row[11])) };
    Ok(Point {
        scene: kept(&row[0]),
        size: if row[1].is_empty() { 0 } else { number(row, 1)? },
        method: kept(&row[2]),
        setting: if &row[4] == "true" { Setting::jitter(dt, passes) } else { Setting::fixed(dt, passes) },
        error: if outcome == Outcome::Fine { number(row, 6)? } else { f64::INFINITY },
        outcome,
        microseconds_per_simulated_second: if row[12].is_empty() { f64::NAN } else { number(row, 12)? },
        steps: number(row, 13)?,
        turns: number(row, 14)?,
    })
}

fn number<T: std::str::FromStr>(row: &StringRecord, column: usize) -> Result<T, String> {
    row[column].parse().map_err(|_| format!("{} is {:?}, which is no number", HEAD[column], &row[column]))
}

/// Points have names that are known to the program. Those that are read stay for its time.
pub(super) fn kept(text: &str) -> &'static str {
    Box::leak(text.to_owned().into_boxed_str())
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
    fn what_is_no_table_of_points_is_refused() {
        assert!(points("scene,bodies\n").is_err_and(|error| error.starts_with("line 1: ")));
        let text = csv(&[failed()], &[subject()]).replace("12.000", "twelve");
        assert_eq!(
            points(&text),
            Err("line 2: us_per_simulated_s is \"twelve\", which is no number".to_owned())
        );
    }
}
