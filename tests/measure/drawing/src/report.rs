//! Writes the report of a sweep as Markdown: for each scene and method the cheapest setting that meets the tolerance.

use crate::plot::axis::short_time;
use measure::method::Setting;
use measure::sweep::{Absent, Outcome, Point, Subject, Sweep};
use std::fmt::Write;

/// Greatest ratio of two times that count as equal, dimensionless: another run may order them the other way round.
const ALIKE: f64 = 1.15;

/// Outcome of a method for a scene of one size.
#[derive(Debug, Clone, Copy)]
pub enum Best<'a> {
    /// Some setting meets the tolerance. Holds the point of the cheapest one.
    Meets(&'a Point),
    /// No setting meets the tolerance. Holds the point with the least error.
    Misses(&'a Point),
    /// All runs failed. Holds the point of one of them.
    Failed(&'a Point),
    /// The method has no run.
    Absent,
}

impl<'a> Best<'a> {
    /// Returns the outcome of a method for a scene of a size.
    pub fn of(points: &'a [Point], subject: &Subject, size: usize, method: &str) -> Self {
        let points: Vec<&Point> = points_of(points, subject, size, method).collect();
        let good = points.iter().copied().filter(|point| point.meets(subject.tolerance));
        if let Some(cheapest) = cheapest(good) {
            return Best::Meets(cheapest);
        }
        let ended = points.iter().copied().filter(|point| point.outcome == Outcome::Fine);
        match ended.min_by(|a, b| a.error.total_cmp(&b.error)) {
            Some(least) => Best::Misses(least),
            None => points.first().map_or(Best::Absent, |first| Best::Failed(first)),
        }
    }

    /// Returns the CPU time in µs per simulated second, if the tolerance is met; `None` otherwise.
    pub fn time(self) -> Option<f64> {
        if let Best::Meets(point) = self { Some(point.microseconds_per_simulated_second) } else { None }
    }
}

/// Returns the points of a method for a scene of a size.
fn points_of<'a>(
    points: &'a [Point],
    subject: &Subject,
    size: usize,
    method: &str,
) -> impl Iterator<Item = &'a Point> {
    points
        .iter()
        .filter(move |point| point.scene == subject.name && point.size == size && point.method == method)
}

/// Returns the point with the least time. Of points with about the same time, returns the first one.
fn cheapest<'a>(points: impl Iterator<Item = &'a Point> + Clone) -> Option<&'a Point> {
    let time = |point: &Point| point.microseconds_per_simulated_second;
    let least = points.clone().map(time).min_by(f64::total_cmp)?;
    points.into_iter().find(|point| time(point) <= ALIKE * least)
}

/// Content of a report.
#[derive(Debug, Clone, Copy)]
pub struct Report<'a> {
    /// Heading of the report.
    pub title: &'a str,
    /// Lines below the heading, as names and values, such as the origin of the figures.
    pub origin: &'a [(&'static str, String)],
    /// Scenes, one section each.
    pub subjects: &'a [Subject],
    /// Methods in order, each with its recommended setting.
    pub methods: &'a [(&'static str, Setting)],
    /// Measured points of all runs, and the methods that could not be run.
    pub sweep: &'a Sweep,
}

impl Report<'_> {
    /// Returns the report as Markdown. [`picture`] gives the names of the linked charts.
    pub fn markdown(&self) -> String {
        let mut text = format!("# {}\n\n", self.title);
        for (name, value) in self.origin {
            add(&mut text, format_args!("- {name}: {value}\n"));
        }
        text += "\n![overview](overview.png)\n";
        text += HOW_TO_READ;
        for subject in self.subjects {
            self.describe(&mut text, subject);
        }
        text
    }

    fn describe(&self, text: &mut String, subject: &Subject) {
        let Subject { name, about, error, unit, tolerance, .. } = subject;
        let title = subject.title();
        add(
            text,
            format_args!(
                "\n## {title}\n\n{about} Error: {error}; tolerance {} {unit}.\n\n",
                short_error(*tolerance)
            ),
        );
        add(text, format_args!("![{title}]({}.png)\n\n", picture(subject)));
        *text += "| bodies | method | cheapest setting | error | CPU per simulated s | times the cheapest | failed runs |\n";
        *text += "|---:|---|---|---:|---:|---:|---:|\n";
        for &size in &subject.sizes {
            let bests =
                self.methods.iter().map(|(name, _)| Best::of(&self.sweep.points, subject, size, name));
            let bests: Vec<Best<'_>> = bests.collect();
            let least = bests.iter().filter_map(|best| best.time()).min_by(f64::total_cmp);
            for ((method, _), best) in self.methods.iter().zip(bests) {
                let cells = self.cells(best, least);
                let failed = self.failed_runs(subject, size, method);
                let Some([setting, error, time, ratio]) = cells else { continue };
                let size = if size == 0 { "-".to_owned() } else { size.to_string() };
                *text +=
                    &format!("| {size} | {method} | {setting} | {error} | {time} | {ratio} | {failed} |\n");
            }
        }
        for Absent { method, reason, .. } in self.sweep.absent.iter().filter(|absent| absent.scene == *name) {
            add(text, format_args!("\n{method} cannot run it: {reason}.\n"));
        }
    }

    /// Returns the cells of a row: setting, error, time, and ratio to the `least` time. `None` if the method was not run.
    fn cells(&self, best: Best<'_>, least: Option<f64>) -> Option<[String; 4]> {
        let none = || "-".to_owned();
        match best {
            Best::Meets(point) => {
                let time = point.microseconds_per_simulated_second;
                let ratio = least.map_or_else(none, |least| format!("{:.1}", time / least));
                let setting = point.setting.label();
                let setting = if self.is_least_tried(point) { format!("<= {setting}") } else { setting };
                Some([setting, short_error(point.error), short_time(time), ratio])
            }
            Best::Misses(point) => {
                let time = short_time(point.microseconds_per_simulated_second);
                let [setting, error] = [point.setting.label(), short_error(point.error)];
                Some([format!("*{setting}*"), format!("*{error}*"), format!("*{time}*"), none()])
            }
            Best::Failed(_) => Some(["*none*".to_owned(), none(), none(), none()]),
            Best::Absent => None,
        }
    }

    /// Returns whether no setting was run that is cheaper than this one.
    fn is_least_tried(&self, best: &Point) -> bool {
        let is_rival =
            |point: &&Point| (point.scene, point.size, point.method) == (best.scene, best.size, best.method);
        let time = |point: &Point| point.microseconds_per_simulated_second;
        // A run without a measured time does not count as cheaper.
        !self.sweep.points.iter().filter(is_rival).any(|point| ALIKE * time(point) < time(best))
    }

    /// Returns as text how many runs failed, of how many, and why.
    fn failed_runs(&self, subject: &Subject, size: usize, method: &str) -> String {
        let points = points_of(&self.sweep.points, subject, size, method);
        let mut reasons: Vec<&str> = Vec::new();
        let (mut failed, mut all) = (0, 0);
        for point in points {
            all += 1;
            if let Outcome::Failed(reason) = point.outcome {
                failed += 1;
                if !reasons.contains(&reason) {
                    reasons.push(reason);
                }
            }
        }
        if failed == 0 { "-".to_owned() } else { format!("{failed} of {all}: {}", reasons.join(", ")) }
    }
}

const HOW_TO_READ: &str = "
`1/60 s x 5` are steps of 1/60 s with 5 iterations of the solver each; those of rapier and Box2D are substeps. CPU
times are of the steps alone, medians of runs that took turns in one process (how many is in `figures.csv`). Of settings that take about as long
(within 15 %) the first that is tried is named. `<=`: no setting that was tried is cheaper; an untried one may suffice.
*Italics*: no setting meets the tolerance; the one with the least error is given. In the charts a line joins the
settings that no cheaper setting of the method equals; crosses above are failed runs.
";

/// Returns an error as text, with two significant digits.
fn short_error(error: f64) -> String {
    if error != 0.0 && !(1e-3..1e5).contains(&error) {
        return format!("{error:.1e}");
    }
    let digits = (1.0 - error.max(1e-9).log10().floor()).clamp(0.0, 4.0) as usize;
    if error == 0.0 { "0".to_owned() } else { format!("{error:.digits$}") }
}

/// Returns the file name of a scene's chart, without the extension.
pub fn picture(subject: &Subject) -> String {
    subject.name.replace('.', "_")
}

fn add(text: &mut String, what: std::fmt::Arguments<'_>) {
    text.write_fmt(what).expect("a string takes everything");
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Returns points of one method with these times (µs) and errors. A point has failed if its error is not finite.
    fn points(values: &[(f64, f64)]) -> Vec<Point> {
        let point = |&(microseconds_per_simulated_second, error): &(f64, f64)| Point {
            scene: "drop",
            size: 5,
            method: "ours",
            setting: Setting::fixed(0.01, 5),
            error,
            outcome: if error.is_finite() { Outcome::Fine } else { Outcome::Failed("flew off") },
            microseconds_per_simulated_second,
            steps: 1,
            turns: 1,
        };
        values.iter().map(point).collect()
    }

    fn subject() -> Subject {
        Subject { name: "drop", about: "", sizes: vec![5], error: "height", unit: "px", tolerance: 1.0 }
    }

    #[test]
    fn the_cheapest_is_among_those_that_meet_the_tolerance() {
        let points = points(&[(10.0, 2.0), (40.0, 0.1), (20.0, 0.5), (5.0, f64::INFINITY)]);
        assert_eq!(Best::of(&points, &subject(), 5, "ours").time(), Some(20.0));
    }

    #[test]
    fn among_settings_of_about_equal_time_the_first_is_the_cheapest() {
        let points = points(&[(22.0, 0.5), (20.0, 0.5), (10.0, 2.0)]);
        assert_eq!(Best::of(&points, &subject(), 5, "ours").time(), Some(22.0));
    }

    #[test]
    fn without_a_setting_within_the_tolerance_the_least_error_is_reported() {
        let points = points(&[(22.0, 5.0), (20.0, 3.0), (10.0, f64::INFINITY)]);
        assert!(
            matches!(Best::of(&points, &subject(), 5, "ours"), Best::Misses(point) if point.error == 3.0)
        );
    }

    /// Returns the report of one method's points as Markdown.
    fn report(points: Vec<Point>) -> String {
        let sweep = Sweep { points, absent: Vec::new() };
        let methods = [("ours", Setting::fixed(0.01, 5))];
        let report =
            Report { title: "", origin: &[], subjects: &[subject()], methods: &methods, sweep: &sweep };
        report.markdown()
    }

    #[test]
    fn a_setting_is_marked_if_none_that_was_tried_is_cheaper() {
        let least = report(points(&[(10.0, 0.1), (20.0, 0.5)]));
        let above = report(points(&[(10.0, f64::INFINITY), (20.0, 0.5)]));
        assert!(least.contains("| <= 0.01 s x 5 |") && above.contains("| 0.01 s x 5 |"));
    }

    #[test]
    fn a_report_counts_the_failed_runs_and_gives_the_reasons() {
        assert!(report(points(&[(10.0, f64::INFINITY), (20.0, 0.5)])).contains("| 1 of 2: flew off |"));
    }
}
