//! Differences between two measurements of the same rows.

use super::rows::{Row, SETS};
use crate::csv::{rows, table};
use serde::{Deserialize, Serialize};

/// Ratio of two values of a row above which the row counts as changed, dimensionless.
pub const FACTOR: f64 = 1.2;

/// Effect of one changed parameter on all rows: one line of the table.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize)]
pub struct Figures {
    /// Name of the parameter.
    pub parameter: String,
    /// Name of the file that defines the parameter, without `.rs`.
    pub module: String,
    /// Unit of the parameter.
    pub unit: String,
    /// Original value of the parameter, as the source text has it.
    pub value: String,
    /// Factor by which the parameter was multiplied, dimensionless.
    pub factor: f64,
    /// Number of rows that differ in any digit. If it is 0, no scene of this measurement depends on the parameter.
    pub touched: usize,
    /// Number of rows of the quick chart that changed.
    pub chart: usize,
    /// Number of pairs of family and setting in the quick stability map whose first failure changed.
    pub map: usize,
    /// Number of errors of joint scenes that changed.
    pub joints: usize,
    /// Number of counts of random joint scenes that changed.
    pub random: usize,
    /// Number of joint scenes whose count of Newton steps changed.
    pub newton: usize,
    /// Number of results (rows of the table) whose verdict changed from success to failure or back. Chaotic rows, which also change
    /// with tiny changes of any parameter, are not counted.
    pub flips: usize,
    /// Name of the row that changed most; a row whose verdict changed ranks before all others.
    pub worst_row: String,
    /// Value and verdict of that row before the change; a missing one is omitted.
    pub before: String,
    /// Value and verdict of that row after the change; a missing one is omitted.
    pub after: String,
}

impl Figures {
    /// Returns the number of rows that changed, of all kinds.
    pub fn rows(&self) -> usize {
        self.chart + self.map + self.joints + self.random + self.newton
    }

    /// Counts the rows of `after` that changed. `before` holds measurements in which a parameter differs by a
    /// ten-thousandth at most. A row changed if it differs from all of these. The value in `before[0]` is written to the
    /// report.
    ///
    /// # Errors
    ///
    /// A measurement in `before` does not have the rows of `after`.
    pub fn count(&mut self, before: &[Vec<Row>], after: &[Row]) -> Result<(), String> {
        let mut worst = (false, 0.0);
        self.touched = 0;
        for (index, row) in after.iter().enumerate() {
            let is_same = |one: &&Row| one.set == row.set && one.name == row.name;
            let ones: Vec<&Row> = before.iter().filter_map(|rows| rows.get(index).filter(is_same)).collect();
            if ones.is_empty() || ones.len() < before.len() {
                return Err(format!("{} is not in all measurements", row.name));
            }
            self.touched += usize::from(ones[0] != row);
            if !ones.iter().all(|one| is_changed(one, row)) {
                continue;
            }
            let counts =
                [&mut self.chart, &mut self.map, &mut self.joints, &mut self.random, &mut self.newton];
            if let Some((_, count)) = SETS.iter().zip(counts).find(|(set, _)| row.set == **set) {
                *count += 1;
            }
            // The verdict of a chaotic row changes by chance.
            let flips = ones[0].verdict != row.verdict && ones.iter().all(|one| !is_changed(ones[0], one));
            self.flips += usize::from(flips);
            let size = (flips, ones.iter().map(|one| ratio(one, row)).fold(f64::INFINITY, f64::min));
            if size > worst || self.worst_row.is_empty() {
                (worst, self.worst_row) = (size, format!("{}: {}", row.set, row.name));
                [self.before, self.after] = [ones[0], row].map(change_text);
            }
        }
        Ok(())
    }
}

/// Returns the names of chaotic rows: rows that differ between `measurements`, although a parameter differs by a
/// ten-thousandth at most in these.
pub fn chaotic(measurements: &[Vec<Row>]) -> Vec<String> {
    let Some((first, others)) = measurements.split_first() else { return Vec::new() };
    let differs = |index: usize, one: &Row| others.iter().any(|rows| is_changed(one, &rows[index]));
    let rows = first.iter().enumerate().filter(|&(index, row)| differs(index, row));
    rows.map(|(_, row)| format!("{}: {}", row.set, row.name)).collect()
}

/// Returns whether two measurements of a row differ in the verdict, or in the value by more than the factor [`FACTOR`].
/// Counts of random scenes change by chance as soon as any bit changes. They differ if the difference is at least two
/// standard deviations of the difference of two Poisson variables.
pub fn is_changed(one: &Row, other: &Row) -> bool {
    if one.verdict != other.verdict || one.value.is_some() != other.value.is_some() {
        return true;
    }
    let [a, b] = [one, other].map(|row| row.value.unwrap_or(0.0));
    if one.set == "random" {
        return (a - b) * (a - b) >= 4.0 * (a + b) && a != b;
    }
    ratio(one, other) > FACTOR
}

/// Returns the greater value divided by the lesser one, dimensionless; values below the floor of the row are replaced by the
/// floor.
fn ratio(one: &Row, other: &Row) -> f64 {
    let [a, b] = [one, other].map(|row| row.value.map_or(f64::INFINITY, |value| value.max(row.floor)));
    if a == b { 1.0 } else { a.max(b) / a.min(b) }
}

fn change_text(row: &Row) -> String {
    match row.value {
        Some(value) if row.verdict.is_empty() => format!("{value:.3e}"),
        Some(value) => format!("{value:.3e}, {}", row.verdict),
        None => row.verdict.clone(),
    }
}

/// Returns the figures as a table with one line for each parameter and factor.
pub fn figures_csv(figures: &[Figures]) -> String {
    table(figures)
}

/// Reads the figures from a table that [`figures_csv`] has written.
///
/// # Errors
///
/// A line does not hold figures; the text names the first such line.
pub fn read_figures(text: &str) -> Result<Vec<Figures>, String> {
    rows(text)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn row(set: &str, value: f64, verdict: &str) -> Row {
        let [set, name, verdict] = [set, "scene", verdict].map(str::to_owned);
        Row { set, name, value: Some(value), floor: 0.1, verdict }
    }

    #[test]
    fn a_row_changes_by_its_verdict_or_by_a_fifth_of_its_value_above_the_floor() {
        let changes = |a: f64, b: f64| is_changed(&row("chart", a, ""), &row("chart", b, ""));
        assert_eq!([changes(1.0, 1.19), changes(1.0, 1.21), changes(1.21, 1.0)], [false, true, true]);
        assert_eq!([changes(1e-9, 0.099), changes(0.0, 0.0), changes(0.0, 0.2)], [false, false, true]);
        assert!(is_changed(&row("chart", 1.0, "within"), &row("chart", 1.0, "beyond")));
    }

    #[test]
    fn counts_change_by_more_than_chance() {
        let changes = |a: f64, b: f64| is_changed(&row("random", a, ""), &row("random", b, ""));
        assert_eq!([changes(0.0, 3.0), changes(0.0, 4.0)], [false, true]);
        assert_eq!([changes(100.0, 120.0), changes(100.0, 140.0)], [false, true]);
    }

    #[test]
    fn rows_that_change_by_chance_have_not_changed() {
        let measured = |value: f64, verdict: &str| vec![row("joints", value, verdict), row("chart", 1.0, "")];
        let before = [measured(1.0, "awake"), measured(5.0, "asleep")];
        assert_eq!(chaotic(&before), ["joints: scene"]);
        let changed = |value, verdict| {
            let mut figures = Figures::default();
            figures.count(&before, &measured(value, verdict)).unwrap();
            [figures.touched, figures.joints, figures.flips]
        };
        assert_eq!([changed(5.1, "asleep"), changed(1.0, "awake")], [[1, 0, 0], [0, 0, 0]]);
        assert_eq!([changed(9.0, "asleep"), changed(9.0, "falls")], [[1, 1, 0], [1, 1, 0]]);
    }

    #[test]
    fn the_worst_row_is_one_whose_verdict_changes() {
        let before = [row("chart", 1.0, "within"), row("joints", 1.0, "")];
        let after = [row("chart", 1.0, "beyond"), row("joints", 50.0, "")];
        let mut figures = Figures::default();
        figures.count(std::slice::from_ref(&before.to_vec()), &after).unwrap();
        assert_eq!((figures.chart, figures.joints, figures.flips), (1, 1, 1));
        assert_eq!((figures.worst_row.as_str(), figures.after.as_str()), ("chart: scene", "1.000e0, beyond"));
        assert_eq!(read_figures(&figures_csv(std::slice::from_ref(&figures))), Ok(vec![figures]));
    }
}
