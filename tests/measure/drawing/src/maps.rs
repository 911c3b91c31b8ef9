//! Writes stability maps as text: the report, and the table of first failures.

use measure::stability::map::{Column, Map, Verdict};
use measure::stability::table::number;
use std::fmt::Write;

/// Returns the columns of all maps, each a method and a setting, that the table of first failures shows.
pub fn table_columns(maps: &[Map]) -> Vec<&Column> {
    let mut columns: Vec<&Column> = Vec::new();
    for column in maps.iter().flat_map(|map| &map.heading.columns) {
        if column.is_in_table && !columns.contains(&column) {
            columns.push(column);
        }
    }
    columns
}

/// Returns the table of first failures in Markdown. It names the first value that fails, and why, for every family and the most
/// informative methods and settings.
pub fn first_failures(maps: &[Map]) -> String {
    let columns = table_columns(maps);
    let mut text = String::from("| family | parameter |");
    for column in &columns {
        write!(text, " {}, {} s x {} |", column.method, column.dt, column.passes).expect("a text takes all");
    }
    text.push_str("\n|---|---|");
    text.push_str(&"---|".repeat(columns.len()));
    text.push('\n');
    for map in maps {
        let heading = &map.heading;
        let unit = if heading.unit.is_empty() { String::new() } else { format!(", {}", heading.unit) };
        write!(text, "| {} | {}{unit} |", heading.title(), heading.parameter).expect("a text takes all");
        for column in &columns {
            write!(text, " {} |", first_failure(map, column)).expect("a text takes all");
        }
        text.push('\n');
    }
    text
}

/// Returns the first failure of a method and setting, as text for readers.
fn first_failure(map: &Map, column: &Column) -> String {
    let Some(index) = map.place(column) else { return String::new() };
    match map.first_failure(index) {
        Some((value, reason)) => format!("{} {reason}", number(value)),
        None if map.is_absent(index) => "–".to_owned(),
        None => map.runs_to(index).map_or("holds".to_owned(), |last| format!("holds to {}", number(last))),
    }
}

/// Returns the name of a family as the stem of file names: lower-case letters and digits, with underscores for all other
/// letters.
pub fn file_name(family: &str) -> String {
    let words = family.split(|letter: char| !letter.is_ascii_alphanumeric()).filter(|word| !word.is_empty());
    words.map(str::to_lowercase).collect::<Vec<_>>().join("_")
}

/// Returns the report in Markdown: the origin of the figures, the first failures, and every map.
pub fn report(title: &str, origin: &[(&str, String)], maps: &[Map]) -> String {
    let mut text = format!("# {title}\n\n");
    for (name, value) in origin {
        writeln!(text, "- {name}: {value}").expect("a text takes all");
    }
    text.push_str("\n![overview](overview.png)\n\n## First failures\n\n");
    text.push_str(
        "The first value of each family's parameter, from easy to hard, with which a method fails, and how. \
         `holds`: no failure at any value. `holds to 100`: no runs with harder values. `–`: the engine lacks a feature \
         of the scene.\n\n",
    );
    text.push_str(&first_failures(maps));
    text.push_str("\n## Maps\n");
    for map in maps {
        let heading = &map.heading;
        let (name, file) = (heading.title(), file_name(&heading.name));
        write!(text, "\n### {name}\n\n{}\n\n![{name}]({file}.png)\n", heading.about)
            .expect("a text takes all");
        for (column, reason) in absences(map) {
            write!(text, "\nNot run with {column}: {reason}.\n").expect("a text takes all");
        }
    }
    text
}

/// Returns each method that has no runs in a map, with the reason.
fn absences(map: &Map) -> Vec<(&str, &str)> {
    let mut absences: Vec<(&str, &str)> = Vec::new();
    for (index, column) in map.heading.columns.iter().enumerate() {
        let reason = map.rows.iter().find_map(|row| match &row[index].verdict {
            Verdict::Absent(reason) => Some(reason.as_str()),
            _ => None,
        });
        if let Some(reason) = reason
            && !absences.iter().any(|(method, _)| *method == column.method)
        {
            absences.push((&column.method, reason));
        }
    }
    absences
}

#[cfg(test)]
mod tests {
    use super::*;
    use measure::stability::map::{Cell, Heading};

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
    fn the_table_names_the_first_failure_and_absent_features() {
        let table = first_failures(&[map()]);
        assert_eq!(table.lines().last(), Some("| Stiff Spring | k | 1e7 blew up | – |"));
    }

    #[test]
    fn the_table_says_how_far_a_method_was_run() {
        let mut map = map();
        map.rows[1][0] = Cell::absent("no more than 1");
        assert!(first_failures(&[map]).ends_with("| holds to 1 | – |\n"));
    }

    #[test]
    fn the_report_names_the_features_that_an_engine_lacks() {
        assert!(
            report("Title", &[("Date", "today".into())], &[map()])
                .contains("\nNot run with two: no springs, none.\n")
        );
    }

    #[test]
    fn names_of_files_are_plain() {
        assert_eq!(file_name("Bullet Circle, wall of 4 px"), "bullet_circle_wall_of_4_px");
    }
}
