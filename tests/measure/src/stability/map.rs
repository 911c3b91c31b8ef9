//! A map: what came of a family with every method and setting. Knows nothing of engines.

use super::reasons::LETTERS;
use std::sync::Mutex;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::thread;

/// How a run ended.
#[derive(Debug, Clone, PartialEq)]
pub enum Verdict {
    /// As it should.
    Holds,
    /// Not as it should: why, in a word of [`super::reasons`].
    Failed(&'static str),
    /// There was no run: the engine does not have what the scene needs, namely this.
    Absent(String),
}

impl Verdict {
    /// The outcome in a word.
    pub fn word(&self) -> &str {
        match self {
            Verdict::Holds => "holds",
            Verdict::Failed(reason) => reason,
            Verdict::Absent(_) => "absent",
        }
    }
}

/// What came of one run.
#[derive(Debug, Clone, PartialEq)]
pub struct Cell {
    /// How it ended.
    pub verdict: Verdict,
    /// What was measured, in the map's unit; not a number where nothing was.
    pub measured: f64,
}

impl Cell {
    /// No run, for a reason.
    pub fn absent(reason: impl Into<String>) -> Self {
        Cell { verdict: Verdict::Absent(reason.into()), measured: f64::NAN }
    }

    /// A run that failed without anything to measure.
    pub fn failed(reason: &'static str) -> Self {
        Cell { verdict: Verdict::Failed(reason), measured: f64::NAN }
    }
}

/// A method with a setting.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Column {
    /// Name of the method.
    pub method: String,
    /// The step, as a reader calls it: `1/60`.
    pub dt: String,
    /// Iterations or substeps per step.
    pub passes: u32,
    /// Whether it is among the few that the table of first failures shows.
    pub is_in_table: bool,
}

/// What a map is of.
#[derive(Debug, Clone, PartialEq)]
pub struct Heading {
    /// Name of the family.
    pub name: String,
    /// What there is, and what must happen.
    pub about: String,
    /// What is varied.
    pub parameter: String,
    /// Its unit; empty for a number of things.
    pub unit: String,
    /// What is measured.
    pub quantity: String,
    /// Its unit.
    pub quantity_unit: String,
    /// The values of the parameter, from easy to hard.
    pub values: Vec<f64>,
    /// The methods and settings.
    pub columns: Vec<Column>,
}

/// A map still to be made.
pub struct Sheet {
    /// What it is of.
    pub heading: Heading,
    /// Makes the run of a value of the parameter and a column, by its index.
    pub run: Box<dyn Fn(f64, usize) -> Cell + Sync>,
}

impl std::fmt::Debug for Sheet {
    fn fmt(&self, formatter: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        formatter.debug_struct("Sheet").field("heading", &self.heading).finish_non_exhaustive()
    }
}

/// What came of a family.
#[derive(Debug, Clone, PartialEq)]
pub struct Map {
    /// What it is of.
    pub heading: Heading,
    /// The runs: one row per value, one cell per column.
    pub rows: Vec<Vec<Cell>>,
}

impl Sheet {
    /// How many runs it is.
    pub fn run_count(&self) -> usize {
        self.heading.values.len() * self.heading.columns.len()
    }

    /// Makes all runs: see [`make`](Self::make).
    ///
    /// # Panics
    ///
    /// When a run does.
    pub fn fill(&self, done: &(dyn Fn() + Sync)) -> Map {
        let all: Vec<usize> = (0..self.run_count()).collect();
        Map::of(self.heading.clone(), self.make(&all, done))
    }

    /// Makes some runs by their numbers, as many side by side as the machine has processors: nothing is timed, and no
    /// run knows of another. `done` is called after each, from whatever thread made it.
    ///
    /// # Panics
    ///
    /// When a run does.
    pub fn make(&self, runs: &[usize], done: &(dyn Fn() + Sync)) -> Vec<Cell> {
        let width = self.heading.columns.len();
        let cells: Vec<Mutex<Option<Cell>>> = runs.iter().map(|_| Mutex::new(None)).collect();
        let next = AtomicUsize::new(0);
        let work = || {
            // The hardest first, which take longest, so that no processor waits for one at the end.
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

    /// About how long each run takes, in no unit: longer with harder values and more passes.
    pub fn costs(&self) -> impl Iterator<Item = f64> {
        let width = self.heading.columns.len();
        (0..self.run_count())
            .map(move |run| (1 + run / width) as f64 * f64::from(self.heading.columns[run % width].passes))
    }
}

impl Heading {
    /// The value and the column of a run by its number.
    pub fn of_run(&self, run: usize) -> (f64, &Column) {
        let width = self.columns.len();
        (self.values[run / width], &self.columns[run % width])
    }
}

impl Map {
    /// A map of all its runs in order.
    pub fn of(heading: Heading, cells: Vec<Cell>) -> Self {
        let rows = cells.chunks(heading.columns.len().max(1)).map(<[Cell]>::to_vec).collect();
        Map { heading, rows }
    }

    /// Where a column is.
    pub fn place(&self, column: &Column) -> Option<usize> {
        self.heading.columns.iter().position(|other| other == column)
    }

    /// The first value with which a column fails, and why.
    pub fn first_failure(&self, column: usize) -> Option<(f64, &'static str)> {
        self.heading.values.iter().zip(&self.rows).find_map(|(&value, row)| match row[column].verdict {
            Verdict::Failed(reason) => Some((value, reason)),
            _ => None,
        })
    }

    /// The last value that a column was run with, if it was not run with some.
    pub fn runs_to(&self, column: usize) -> Option<f64> {
        let is_absent = |row: &&Vec<Cell>| matches!(row[column].verdict, Verdict::Absent(_));
        let values = self.heading.values.iter().zip(&self.rows);
        let last = values.filter(|(_, row)| !is_absent(row)).map(|(&value, _)| value).next_back();
        last.filter(|_| self.rows.iter().any(|row| is_absent(&row)))
    }

    /// Why runs failed, in the order of [`LETTERS`].
    pub fn reasons(&self) -> Vec<&'static str> {
        let has = |word: &str| {
            self.rows
                .iter()
                .flatten()
                .any(|cell| matches!(cell.verdict, Verdict::Failed(reason) if reason == word))
        };
        LETTERS.iter().map(|&(word, _)| word).filter(|word| has(word)).collect()
    }

    /// Whether a column has no run at all.
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
    fn every_run_is_in_its_place() {
        let map = sheet().fill(&|| {});
        let measured: Vec<f64> = map.rows.iter().flatten().map(|cell| cell.measured).collect();
        assert_eq!(measured, [10.0, 11.0, 20.0, 21.0, 30.0, 31.0]);
    }

    #[test]
    fn every_run_is_told_once() {
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
