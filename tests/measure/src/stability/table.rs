//! Maps as a table of comma-separated values.

use super::map::{Cell, Map, Verdict};
use crate::csv::table;

/// The names of the columns.
const HEAD: [&str; 12] = [
    "family",
    "parameter",
    "unit",
    "value",
    "method",
    "dt",
    "passes",
    "outcome",
    "quantity",
    "quantity_unit",
    "measured",
    "note",
];

/// All runs of all maps, one line each.
pub fn csv(maps: &[Map]) -> String {
    let rows = maps.iter().flat_map(rows_of);
    table([HEAD.map(str::to_owned).to_vec()].into_iter().chain(rows))
}

fn rows_of(map: &Map) -> impl Iterator<Item = Vec<String>> {
    let heading = &map.heading;
    let cells = heading.values.iter().zip(&map.rows).flat_map(|(&value, row)| {
        heading.columns.iter().zip(row).map(move |(column, cell)| (value, column, cell))
    });
    cells.map(|(value, column, cell)| {
        let note = if let Verdict::Absent(reason) = &cell.verdict { reason } else { "" };
        vec![
            heading.name.clone(),
            heading.parameter.clone(),
            heading.unit.clone(),
            number(value),
            column.method.clone(),
            column.dt.clone(),
            column.passes.to_string(),
            cell.verdict.word().to_owned(),
            heading.quantity.clone(),
            heading.quantity_unit.clone(),
            measured(cell),
            note.to_owned(),
        ]
    })
}

fn measured(cell: &Cell) -> String {
    if cell.measured.is_nan() { String::new() } else { format!("{:.4}", cell.measured) }
}

/// A value of a parameter for readers: powers of ten for the very large and very small.
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
    use crate::stability::map::{Column, Heading};

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
}
