//! How the runs of a stability map came out, a letter each, beside what is written down of them.
//!
//! A line of what is written down is `family; value; letters`, a letter for each of our methods and settings in the order
//! of the full map's columns: a dot for what holds, else the letter of the reason (`measure::stability::reasons`).

use measure::stability::map::{Cell, Sheet, Verdict};
use measure::stability::reasons;
use std::fs;
use std::path::Path;

/// Makes a test of each of some groups of families, and a list of all families that are in a test.
macro_rules! come_out_as_written {
    ($written:expr, $values:expr; $($test:ident: $($family:literal),+;)+) => {
        $(
            #[test]
            fn $test() {
                crate::written::assert_come_out(&$written, &[$($family),+], $values);
            }
        )+

        const TESTED: &[&str] = &[$($($family),+),+];
    };
}

/// What is written down of an engine's families.
pub(crate) struct Written {
    /// File below `golden/stability`.
    pub(crate) file: &'static str,
    /// What is in it.
    pub(crate) text: &'static str,
    /// All maps with our methods, still to be made.
    pub(crate) sheets: fn() -> Vec<Sheet>,
}

/// Runs some families with some of their values, at the settings that the table of first failures shows, and asserts
/// that they come out as is written down.
#[track_caller]
pub(crate) fn assert_come_out(written: &Written, names: &[&str], values: impl Fn(&str) -> Vec<f64>) {
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

/// Runs everything, and asserts that it comes out as is written down. If not, all of it is written to a file that can
/// take its place.
pub(crate) fn assert_all_come_out(written: &Written) {
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

/// Asserts that there is a line for every value of every family, in order, with a letter for every column.
pub(crate) fn assert_all_is_written_down(written: &Written) {
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

impl Written {
    fn lines(&self) -> impl Iterator<Item = &'static str> {
        self.text.lines().filter(|line| !line.starts_with('#'))
    }

    fn letters(&self, sheet: &Sheet, value: f64) -> &'static str {
        let head = head(sheet, value);
        let line = self.lines().filter_map(|line| line.rsplit_once("; ")).find(|(known, _)| *known == head);
        line.unwrap_or_else(|| panic!("{head} is not written down")).1
    }
}

/// What a line begins with.
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
