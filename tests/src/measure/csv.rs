//! Points as a table of comma-separated values.

use super::method::Dt;
use super::sweep::{Outcome, Point, Subject};
use std::fmt::Write;

/// The names of the columns.
const HEAD: &str = "scene,bodies,method,dt_s,jitter,passes,error,error_is,unit,tolerance,meets_tolerance,outcome,\
us_per_simulated_s,steps,turns";

/// A table of points, a line each. Points of a scene that is not among the subjects are left out.
pub fn csv(points: &[Point], subjects: &[Subject]) -> String {
    let mut text = format!("{HEAD}\n");
    for point in points {
        let Some(subject) = subjects.iter().find(|subject| subject.name == point.scene) else { continue };
        let size = if point.size == 0 { String::new() } else { point.size.to_string() };
        let (outcome, error) = match point.outcome {
            Outcome::Fine => ("fine", format!("{:e}", rounded(point.error))),
            Outcome::Failed(reason) => (reason, String::new()),
        };
        let time = point.microseconds_per_simulated_second;
        let time = if time.is_nan() { String::new() } else { format!("{time:.3}") };
        let jitters = matches!(point.setting.dt, Dt::Jitter { .. });
        let line = writeln!(
            text,
            "{},{size},{},{},{jitters},{},{error},{},{},{},{},{},{time},{},{}",
            point.scene,
            quoted(point.method),
            point.setting.dt.mean(),
            point.setting.passes,
            quoted(subject.error),
            quoted(subject.unit),
            subject.tolerance,
            point.meets(subject.tolerance),
            quoted(outcome),
            point.steps,
            point.turns,
        );
        line.expect("a string takes everything");
    }
    text
}

/// Six digits that count.
fn rounded(value: f64) -> f64 {
    format!("{value:.5e}").parse().unwrap_or(value)
}

/// A text as a cell.
pub(super) fn quoted(text: &str) -> String {
    if text.contains([',', '"', '\n']) {
        format!("\"{}\"", text.replace('"', "\"\""))
    } else {
        text.to_owned()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::measure::method::Setting;

    #[test]
    fn a_failed_point_says_why_and_has_no_error() {
        let subject = Subject {
            name: "drop",
            about: "",
            sizes: vec![5],
            error: "height, largest",
            unit: "px",
            tolerance: 0.5,
        };
        let point = Point {
            scene: "drop",
            size: 5,
            method: "Farseer, SAT",
            setting: Setting::jitter(0.016, 5),
            error: f64::INFINITY,
            outcome: Outcome::Failed("flew off"),
            microseconds_per_simulated_second: 12.0,
            steps: 7,
            turns: 3,
        };
        let text = csv(&[point], &[subject]);
        let line =
            "drop,5,\"Farseer, SAT\",0.016,true,5,,\"height, largest\",px,0.5,false,flew off,12.000,7,3";
        assert_eq!(text.lines().nth(1), Some(line));
    }
}
