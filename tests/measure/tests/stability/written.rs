//! Compares the outcomes of a stability map with a golden file.
//!
//! A line of the golden file is `family; value; letters`, with one letter for each of our methods and settings, in the order of
//! the full map's columns. A dot means success; any other letter is the reason of the failure (`measure::stability::reasons`).

use measure::stability::map::{Cell, Sheet, Verdict};
use measure::stability::reasons;
use std::fs;
use std::path::Path;

/// Makes a test for each group of families, and the list `TESTED` of all families in these tests.
macro_rules! outcomes_equal_golden {
    ($written:expr, $values:expr; $($test:ident: $($family:literal),+;)+) => {
        $(
            #[test]
            fn $test() {
                crate::written::assert_equal_golden(&$written, &[$($family),+], $values);
            }
        )+

        const TESTED: &[&str] = &[$($($family),+),+];
    };
}

/// Golden file with the outcomes of an engine's families.
pub(crate) struct GoldenFamilies {
    /// Name of the file in the folder `golden/stability`.
    pub(crate) file: &'static str,
    /// Text of the file.
    pub(crate) text: &'static str,
    /// Function that returns the maps of all families with our methods. Their runs are still to be made.
    pub(crate) sheets: fn() -> Vec<Sheet>,
}

/// Runs the families `names`, each with the values that `values` returns for it, at the settings of the table of first
/// failures. Asserts that the outcomes equal those of the golden file.
#[track_caller]
pub(crate) fn assert_equal_golden(
    written: &GoldenFamilies,
    names: &[&str],
    values: impl Fn(&str) -> Vec<f64>,
) {
    for sheet in (written.sheets)().iter().filter(|sheet| names.contains(&&*sheet.heading.name)) {
        for value in values(&sheet.heading.name) {
            let known = written.letters(sheet, value);
            let columns = sheet.heading.columns.iter().enumerate();
            for (index, column) in columns.filter(|(_, column)| column.is_in_table) {
                let found = letter(&(sheet.run)(value, index));
                let known = known.chars().nth(index).expect("a letter for every column");
                assert_eq!(found, known, "{} with {value}, {column:?}", sheet.heading.name);
            }
        }
    }
}

/// Runs all families and asserts that the outcomes equal those of the golden file. If they differ, writes them to a file that
/// can replace the golden file.
pub(crate) fn assert_all_equal_golden(written: &GoldenFamilies) {
    let found: Vec<String> = (written.sheets)().iter().flat_map(lines).collect();
    let known: Vec<&str> = written.lines().collect();
    if found != known {
        let place = Path::new(env!("CARGO_TARGET_TMPDIR")).join(written.file);
        let header: Vec<&str> = written.text.lines().take_while(|line| line.starts_with('#')).collect();
        let text = format!("{}\n{}\n", header.join("\n"), found.join("\n"));
        fs::write(&place, text).expect("the folder for temporary files can be written to");
        let changed: Vec<&String> = found.iter().filter(|line| !known.contains(&line.as_str())).collect();
        panic!("changed, all of it is in {}:\n{changed:#?}", place.display());
    }
}

/// Asserts that the golden file has a line for every value of every family, in order, with a letter for every column.
pub(crate) fn assert_golden_is_complete(written: &GoldenFamilies) {
    let sheets = (written.sheets)();
    let expected = sheets.iter().flat_map(|sheet| {
        let heading = &sheet.heading;
        heading.values.iter().map(|&value| (head(sheet, value), heading.columns.len()))
    });
    let found = written.lines().filter_map(|line| line.rsplit_once("; "));
    let found: Vec<(String, usize)> =
        found.map(|(head, letters)| (head.to_owned(), letters.chars().count())).collect();
    assert_eq!(found, expected.collect::<Vec<_>>());
}

impl GoldenFamilies {
    fn lines(&self) -> impl Iterator<Item = &'static str> {
        self.text.lines().filter(|line| !line.starts_with('#'))
    }

    fn letters(&self, sheet: &Sheet, value: f64) -> &'static str {
        let head = head(sheet, value);
        let line = self.lines().filter_map(|line| line.rsplit_once("; ")).find(|(known, _)| *known == head);
        line.unwrap_or_else(|| panic!("{head} is not written down")).1
    }
}

/// Returns the beginning of the line of a value: family and value.
fn head(sheet: &Sheet, value: f64) -> String {
    format!("{}; {value:e}", sheet.heading.name)
}

fn lines(sheet: &Sheet) -> Vec<String> {
    let map = sheet.fill(&|| {});
    let line = |(&value, row): (&f64, &Vec<Cell>)| {
        let letters: String = row.iter().map(letter).collect();
        format!("{}; {letters}", head(sheet, value))
    };
    map.heading.values.iter().zip(&map.rows).map(line).collect()
}

fn letter(cell: &Cell) -> char {
    match &cell.verdict {
        Verdict::Holds => '.',
        Verdict::Failed(reason) => reasons::letter(reason),
        Verdict::Absent(_) => '-',
    }
}
