//! A stability map: the outcomes of a family with every method and setting. It does not depend on engines.

use super::reasons::LETTERS;
use std::sync::Mutex;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::thread;

/// Outcome of a run: success, failure, or no run.
#[derive(Debug, Clone, PartialEq)]
pub enum Verdict {
    /// The run met the family's condition of success.
    Holds,
    /// The run failed; the reason is a word of [`super::reasons`].
    Failed(&'static str),
    /// There was no run: the engine lacks a feature of the scene, which the text names.
    Absent(String),
}

impl Verdict {
    /// Returns the outcome in a word.
    pub fn word(&self) -> &str {
        match self {
            Verdict::Holds => "holds",
            Verdict::Failed(reason) => reason,
            Verdict::Absent(_) => "absent",
        }
    }
}

/// Outcome of one run with the value that its judge measured.
#[derive(Debug, Clone, PartialEq)]
pub struct Cell {
    /// Success, failure or absence of the run.
    pub verdict: Verdict,
    /// Measured value in the unit `quantity_unit` of the map's heading, or a number without unit; NaN if no value was measured.
    pub measured: f64,
}

impl Cell {
    /// Returns the cell of a run that was not made, for a reason.
    pub fn absent(reason: impl Into<String>) -> Self {
        Cell { verdict: Verdict::Absent(reason.into()), measured: f64::NAN }
    }

    /// Returns the cell of a run that failed and has no measured value.
    pub fn failed(reason: &'static str) -> Self {
        Cell { verdict: Verdict::Failed(reason), measured: f64::NAN }
    }
}

/// A column of a stability map: a method with a setting.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Column {
    /// Name of the method.
    pub method: String,
    /// Length of the step in s as text: `1/60`.
    pub dt: String,
    /// Number of iterations (our faithful solver) or substeps (all others) per step.
    pub passes: u32,
    /// Whether the table of first failures shows this column.
    pub is_in_table: bool,
}

/// Texts, values and columns of a stability map.
#[derive(Debug, Clone, PartialEq)]
pub struct Heading {
    /// Name of the family.
    pub name: String,
    /// Description of the scene and of its condition of success.
    pub about: String,
    /// Name of the family's parameter.
    pub parameter: String,
    /// Unit of the parameter; empty for a count.
    pub unit: String,
    /// Name of the measured quantity.
    pub quantity: String,
    /// Unit of the measured quantity; empty for a number.
    pub quantity_unit: String,
    /// Values of the parameter in its unit, from easy to hard: one row of the map each.
    pub values: Vec<f64>,
    /// Methods with settings: one column of the map each.
    pub columns: Vec<Column>,
}

/// A stability map whose runs are still to be made.
pub struct Sheet {
    /// Names, units, values and columns of the map.
    pub heading: Heading,
    /// Makes one run: for a value of the parameter and the index of a column.
    pub run: Box<dyn Fn(f64, usize) -> Cell + Sync>,
}

impl std::fmt::Debug for Sheet {
    fn fmt(&self, formatter: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        formatter.debug_struct("Sheet").field("heading", &self.heading).finish_non_exhaustive()
    }
}

/// Outcomes of all runs of a family.
#[derive(Debug, Clone, PartialEq)]
pub struct Map {
    /// Names, units, values and columns of the map.
    pub heading: Heading,
    /// Outcomes of the runs: one row per value of the parameter, one cell per column.
    pub rows: Vec<Vec<Cell>>,
}

impl Sheet {
    /// Returns the number of runs: values times columns.
    pub fn run_count(&self) -> usize {
        self.heading.values.len() * self.heading.columns.len()
    }

    /// Makes all runs, in parallel, and returns the map: see [`make`](Self::make).
    ///
    /// # Panics
    ///
    /// A run panics.
    pub fn fill(&self, done: &(dyn Fn() + Sync)) -> Map {
        let all: Vec<usize> = (0..self.run_count()).collect();
        Map::of(self.heading.clone(), self.make(&all, done))
    }

    /// Makes the runs with these numbers, in parallel on all processors: no time is measured, and runs are independent. `done`
    /// is called after each run, from the thread that made it.
    ///
    /// # Panics
    ///
    /// A run panics.
    pub fn make(&self, runs: &[usize], done: &(dyn Fn() + Sync)) -> Vec<Cell> {
        let width = self.heading.columns.len();
        let cells: Vec<Mutex<Option<Cell>>> = runs.iter().map(|_| Mutex::new(None)).collect();
        let next = AtomicUsize::new(0);
        let work = || {
            // The hardest runs take longest and start first, so that no processor waits for one of them at the end.
            while let Some(place) = runs.len().checked_sub(1 + next.fetch_add(1, Ordering::Relaxed)) {
                let cell = (self.run)(self.heading.values[runs[place] / width], runs[place] % width);
                *cells[place].lock().expect("no other thread has this cell") = Some(cell);
                done();
            }
        };
        thread::scope(|scope| {
            for _ in 0..thread::available_parallelism().map_or(1, usize::from) {
                scope.spawn(work);
            }
        });
        let cell =
            |cell: Mutex<Option<Cell>>| cell.into_inner().expect("the threads have ended").expect("made");
        cells.into_iter().map(cell).collect()
    }

    /// Returns the estimated duration of each run, dimensionless: it rises with harder values and more iterations.
    pub fn costs(&self) -> impl Iterator<Item = f64> {
        let width = self.heading.columns.len();
        (0..self.run_count())
            .map(move |run| (1 + run / width) as f64 * f64::from(self.heading.columns[run % width].passes))
    }
}

impl Heading {
    /// Returns the name of the family for readers. The field `name` is a key of tables, golden files and pictures.
    pub fn title(&self) -> &str {
        match &*self.name {
            "Shadow of somebody sunk in" => "Shadow of a sunken ball",
            name => name,
        }
    }

    /// Returns the value of the parameter and the column of the run with this number.
    pub fn of_run(&self, run: usize) -> (f64, &Column) {
        let width = self.columns.len();
        (self.values[run / width], &self.columns[run % width])
    }
}

impl Map {
    /// Makes a map from the outcomes of all runs, in order.
    pub fn of(heading: Heading, cells: Vec<Cell>) -> Self {
        let rows = cells.chunks(heading.columns.len().max(1)).map(<[Cell]>::to_vec).collect();
        Map { heading, rows }
    }

    /// Returns the index of a column; `None` if the map has no such column.
    pub fn place(&self, column: &Column) -> Option<usize> {
        self.heading.columns.iter().position(|other| other == column)
    }

    /// Returns the first value of the parameter with which a column fails, and the reason; `None` if no run of it fails.
    pub fn first_failure(&self, column: usize) -> Option<(f64, &'static str)> {
        self.heading.values.iter().zip(&self.rows).find_map(|(&value, row)| match row[column].verdict {
            Verdict::Failed(reason) => Some((value, reason)),
            _ => None,
        })
    }

    /// Returns the last value that a column was run with, if some values were not run; `None` if all were.
    pub fn runs_to(&self, column: usize) -> Option<f64> {
        let is_absent = |row: &&Vec<Cell>| matches!(row[column].verdict, Verdict::Absent(_));
        let values = self.heading.values.iter().zip(&self.rows);
        let last = values.filter(|(_, row)| !is_absent(row)).map(|(&value, _)| value).next_back();
        last.filter(|_| self.rows.iter().any(|row| is_absent(&row)))
    }

    /// Returns the reasons of the failures in this map, in the order of [`LETTERS`].
    pub fn reasons(&self) -> Vec<&'static str> {
        let has = |word: &str| {
            self.rows
                .iter()
                .flatten()
                .any(|cell| matches!(cell.verdict, Verdict::Failed(reason) if reason == word))
        };
        LETTERS.iter().map(|&(word, _)| word).filter(|word| has(word)).collect()
    }

    /// Returns whether no run of a column was made.
    pub fn is_absent(&self, column: usize) -> bool {
        self.rows.iter().all(|row| matches!(row[column].verdict, Verdict::Absent(_)))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn sheet() -> Sheet {
        let column = |passes| Column { method: "m".into(), dt: "1/60".into(), passes, is_in_table: true };
        let word = String::new;
        Sheet {
            heading: Heading {
                name: word(),
                about: word(),
                parameter: word(),
                unit: word(),
                quantity: word(),
                quantity_unit: word(),
                values: vec![1.0, 2.0, 3.0],
                columns: vec![column(5), column(20)],
            },
            run: Box::new(|value, column| {
                let verdict = match (value > 2.5, column) {
                    (true, 0) => Verdict::Failed(super::super::reasons::SANK),
                    (_, 0) => Verdict::Holds,
                    _ => Verdict::Absent("not there".to_owned()),
                };
                Cell { verdict, measured: 10.0 * value + column as f64 }
            }),
        }
    }

    #[test]
    fn every_run_is_in_its_cell_of_the_map() {
        let map = sheet().fill(&|| {});
        let measured: Vec<f64> = map.rows.iter().flatten().map(|cell| cell.measured).collect();
        assert_eq!(measured, [10.0, 11.0, 20.0, 21.0, 30.0, 31.0]);
    }

    #[test]
    fn every_run_is_reported_once() {
        let told = AtomicUsize::new(0);
        sheet().fill(&|| {
            told.fetch_add(1, Ordering::Relaxed);
        });
        assert_eq!(told.into_inner(), 6);
    }

    #[test]
    fn a_column_without_runs_to_the_end_says_how_far_it_ran() {
        let mut map = sheet().fill(&|| {});
        assert_eq!([map.runs_to(0), map.runs_to(1)], [None, None]);
        map.rows[2][0] = Cell::absent("not there");
        assert_eq!(map.runs_to(0), Some(2.0));
    }

    #[test]
    fn the_reasons_of_a_map_are_those_of_its_failures() {
        assert_eq!(sheet().fill(&|| {}).reasons(), [super::super::reasons::SANK]);
    }

    #[test]
    fn the_first_failure_is_that_of_the_easiest_value() {
        let map = sheet().fill(&|| {});
        assert_eq!(map.first_failure(0), Some((3.0, "sank")));
        assert_eq!(map.first_failure(1), None);
    }

    #[test]
    fn a_column_without_runs_is_absent() {
        let map = sheet().fill(&|| {});
        assert!(map.is_absent(1) && !map.is_absent(0));
    }
}
