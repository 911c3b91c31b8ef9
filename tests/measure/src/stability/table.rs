//! Writes and reads the runs of stability maps as comma-separated values.

use super::map::{Cell, Heading, Map, Sheet, Verdict};
use super::reasons;
use crate::csv::{rows, table};
use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;

/// A line of the table: one run with the names and values that identify it.
#[derive(Debug, Serialize, Deserialize)]
struct Row {
    family: String,
    parameter: String,
    unit: String,
    value: String,
    method: String,
    dt: String,
    passes: u32,
    outcome: String,
    quantity: String,
    quantity_unit: String,
    measured: String,
    note: String,
}

/// Returns the runs of all maps as comma-separated values, one line per run.
pub fn csv(maps: &[Map]) -> String {
    csv_of_runs(maps.iter().flat_map(|map| {
        let cells = map.rows.iter().flatten().cloned().enumerate();
        cells.map(|(run, cell)| (&map.heading, run, cell))
    }))
}

/// Returns some runs as comma-separated values, one line per run. Each run has the heading of its map, the number of the run in
/// that map, and its outcome.
pub fn csv_of_runs<'a>(runs: impl IntoIterator<Item = (&'a Heading, usize, Cell)>) -> String {
    table(runs.into_iter().map(|(heading, run, cell)| row(heading, run, &cell)))
}

/// Reads tables of runs and returns the maps of the sheets that have runs in them, each map once.
///
/// # Errors
///
/// A table has a fault, or a run belongs to no sheet, occurs twice or is missing.
pub fn maps<'a>(sheets: impl IntoIterator<Item = &'a Sheet>, tables: &[String]) -> Result<Vec<Map>, String> {
    let mut cells = BTreeMap::new();
    for text in tables {
        for row in rows::<Row>(text)? {
            let name = row.name();
            if cells.insert(name.clone(), cell(row)?).is_some() {
                return Err(format!("{name} is there twice"));
            }
        }
    }
    let mut take = |heading: &Heading, index| {
        let name = row(heading, index, &Cell::absent("")).name();
        cells.remove(&name).ok_or_else(|| format!("{name} is missing"))
    };
    let map = |sheet: &Sheet| {
        let made = (0..sheet.run_count()).map(|index| take(&sheet.heading, index));
        Ok(Map::of(sheet.heading.clone(), made.collect::<Result<_, String>>()?))
    };
    let maps = sheets.into_iter().map(map).collect::<Result<_, String>>()?;
    match cells.keys().next() {
        Some(name) => Err(format!("{name} is of no map")),
        None => Ok(maps),
    }
}

impl Row {
    /// Returns a name that no other run of the table has.
    fn name(&self) -> String {
        let Row { family, value, method, dt, passes, .. } = self;
        format!("{family} with {value}, {method}, {dt} s x {passes}")
    }
}

fn row(heading: &Heading, index: usize, cell: &Cell) -> Row {
    let (value, column) = heading.of_run(index);
    let note = if let Verdict::Absent(reason) = &cell.verdict { reason } else { "" };
    Row {
        family: heading.name.clone(),
        parameter: heading.parameter.clone(),
        unit: heading.unit.clone(),
        value: number(value),
        method: column.method.clone(),
        dt: column.dt.clone(),
        passes: column.passes,
        outcome: cell.verdict.word().to_owned(),
        quantity: heading.quantity.clone(),
        quantity_unit: heading.quantity_unit.clone(),
        measured: if cell.measured.is_nan() { String::new() } else { format!("{:.4}", cell.measured) },
        note: note.to_owned(),
    }
}

fn cell(row: Row) -> Result<Cell, String> {
    let verdict = match &*row.outcome {
        "holds" => Verdict::Holds,
        "absent" => return Ok(Cell::absent(row.note)),
        word => {
            let known = reasons::LETTERS.iter().find(|(known, _)| *known == word);
            Verdict::Failed(known.ok_or_else(|| format!("{}: {word:?} is no outcome", row.name()))?.0)
        }
    };
    let measured = match &*row.measured {
        "" => f64::NAN,
        text => text.parse().map_err(|_| format!("{}: {text:?} is no number", row.name()))?,
    };
    Ok(Cell { verdict, measured })
}

/// Returns a value of a parameter as text, with powers of ten for very large and very small values.
pub fn number(value: f64) -> String {
    let magnitude = value.abs();
    if magnitude != 0.0 && !(1e-3..1e5).contains(&magnitude) {
        format!("{value:e}")
    } else {
        format!("{value}")
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::shard::Shard;
    use crate::stability::map::Column;

    fn map() -> Map {
        let column =
            |method: &str| Column { method: method.into(), dt: "1/60".into(), passes: 5, is_in_table: true };
        let cell = |verdict| Cell { verdict, measured: 1.25 };
        let absent = || Cell::absent("no springs, none");
        Map {
            heading: Heading {
                name: "Stiff Spring".into(),
                about: "It swings.".into(),
                parameter: "k".into(),
                unit: String::new(),
                quantity: "swing".into(),
                quantity_unit: "px".into(),
                values: vec![1.0, 1e7],
                columns: vec![column("one"), column("two")],
            },
            rows: vec![
                vec![cell(Verdict::Holds), absent()],
                vec![cell(Verdict::Failed("blew up")), absent()],
            ],
        }
    }

    #[test]
    fn every_run_is_a_line_of_csv() {
        let text = csv(&[map()]);
        let lines: Vec<&str> = text.lines().skip(1).collect();
        assert_eq!(lines.len(), 4);
        assert_eq!(lines[0], "Stiff Spring,k,,1,one,1/60,5,holds,swing,px,1.2500,");
        assert_eq!(lines[3], "Stiff Spring,k,,1e7,two,1/60,5,absent,swing,px,,\"no springs, none\"");
    }

    fn sheet() -> Sheet {
        Sheet {
            heading: map().heading,
            run: Box::new(|value, column| match (value > 5.0, column) {
                (true, 0) => Cell { verdict: Verdict::Failed(reasons::SANK), measured: 1.25 },
                (_, 0) => Cell::failed(reasons::PANICKED),
                _ => Cell::absent("no springs, none"),
            }),
        }
    }

    /// Returns the tables of all `of` shards.
    fn parts(of: usize) -> Vec<String> {
        let (sheet, costs) = (sheet(), sheet().costs().collect::<Vec<_>>());
        let part = |number| {
            let picks = format!("{number}/{of}").parse::<Shard>().unwrap().picks(&costs);
            let runs: Vec<usize> = (0..costs.len()).filter(|&run| picks[run]).collect();
            let cells = sheet.make(&runs, &|| {});
            csv_of_runs(runs.into_iter().zip(cells).map(|(run, cell)| (&sheet.heading, run, cell)))
        };
        (1..=of).map(part).collect()
    }

    #[test]
    fn merged_shards_equal_the_complete_sweep() {
        let whole = csv(&[sheet().fill(&|| {})]);
        // With more shards than runs, some shards are empty.
        for of in [1, 3, 7] {
            assert_eq!(maps(&[sheet()], &parts(of)).map(|maps| csv(&maps)), Ok(whole.clone()), "{of} parts");
        }
    }

    #[test]
    fn a_missing_duplicate_or_foreign_shard_is_detected() {
        let parts = parts(2);
        let wrong = |sheets: &[Sheet], parts: &[String]| maps(sheets, parts).unwrap_err();
        assert!(wrong(&[sheet()], &parts[..1]).ends_with("is missing"));
        assert!(wrong(&[sheet()], &[&parts[..], &parts].concat()).ends_with("is there twice"));
        assert!(wrong(&[], &parts).ends_with("is of no map"));
        assert!(
            wrong(
                &[sheet()],
                &[parts[0].replace(reasons::SANK, "swam"), parts[1].replace(reasons::SANK, "swam")]
            )
            .ends_with("\"swam\" is no outcome")
        );
    }
}
