//! Writes the figures of the arena: tables, and a report with charts.

use crate::measuring::{Origin, Result};
use crate::plot::save;
use crate::plot::times::{SceneTimes, TimesChart};
use measure::arena::changes::ChangeFigures;
use measure::arena::memory::{MemoryFigures, read_memory};
use measure::arena::queries::QueryFigures;
use measure::arena::run::{Growth, RunFigures, arena_csv, comparisons, growth};
use measure::arena::{BOX2D, OURS, RAPIER};
use measure::origin::origin_csv;
use std::fmt::Write;
use std::fs;
use std::path::Path;

/// Stem of the files of the chart.
const TIMES: &str = "times";

/// All figures of a run of the arena.
#[derive(Debug, Default)]
pub struct Tables {
    /// Versions and machine.
    pub origin: Origin,
    /// Figures of scenes and large worlds.
    pub runs: Vec<RunFigures>,
    /// Times of queries.
    pub queries: Vec<QueryFigures>,
    /// Times of changes.
    pub changes: Vec<ChangeFigures>,
    /// Peak memory.
    pub memory: Vec<MemoryFigures>,
}

/// Writes all tables that have rows into a folder, and returns them as text.
///
/// # Errors
/// A file cannot be written.
pub fn write(tables: &Tables, out: &Path) -> Result<String> {
    let mut text = String::new();
    for (name, table) in [
        ("figures", arena_csv(&comparisons(&tables.runs))),
        ("growth", arena_csv(&growth(&tables.runs))),
        ("runs", arena_csv(&tables.runs)),
        ("queries", arena_csv(&tables.queries)),
        ("changes", arena_csv(&tables.changes)),
        ("memory", arena_csv(&tables.memory)),
    ] {
        if !table.is_empty() {
            fs::write(out.join(format!("{name}.csv")), &table)?;
            text += &aligned(&table);
            text.push('\n');
        }
    }
    fs::write(out.join("origin.csv"), origin_csv(&tables.origin))?;
    if !tables.runs.is_empty() {
        save(&chart(&tables.runs), out, TIMES)?;
    }
    fs::write(out.join("report.md"), report(tables))?;
    Ok(text)
}

/// Returns the chart of times per step over the number of bodies.
fn chart(runs: &[RunFigures]) -> TimesChart {
    let mut engines: Vec<&'static str> = Vec::new();
    let mut names: Vec<&'static str> = Vec::new();
    for run in runs {
        if !engines.contains(&run.engine) {
            engines.push(run.engine);
        }
        if !names.contains(&run.scene) {
            names.push(run.scene);
        }
    }
    let points = |scene: &str, engine: &str| {
        let is_here = |run: &&RunFigures| (run.scene, run.engine) == (scene, engine);
        runs.iter().filter(is_here).map(|run| (run.bodies as f64, run.mean_us)).collect()
    };
    let times = |scene: &&str| SceneTimes {
        scene: (*scene).to_owned(),
        lines: engines.iter().map(|engine| points(scene, engine)).collect(),
    };
    let scenes = names.iter().map(times).collect();
    TimesChart { title: "Arena".to_owned(), engines, scenes }
}

/// Returns the report in Markdown.
fn report(tables: &Tables) -> String {
    let mut text = String::from("# Arena, beside the peers\n\n");
    for (name, value) in &tables.origin {
        add(&mut text, format_args!("- {name}: {value}\n"));
    }
    let sections: [fn(&mut String, &Tables); 4] =
        [times_section, queries_section, changes_section, memory_section];
    sections.iter().for_each(|section| section(&mut text, tables));
    text
}

/// Appends the table of ratios, the geometric mean, and the growth of times.
fn times_section(text: &mut String, tables: &Tables) {
    let comparisons = comparisons(&tables.runs);
    if comparisons.is_empty() {
        return;
    }
    text.push_str(
        "\n## Times\n\nTimes of our engine divided by those of a peer: mean and longest step after the first, first step, \
         adding all bodies and joints, removing them one after the other. Steps of 1/60 s with 4 substeps; CPU time of one \
         thread, the least of each step over all turns. `growth` is the exponent of the mean step over the number of bodies \
         since the next smaller size, ours minus Box2D's.\n\n\
         | scene | bodies | Box2D | rapier2d | longest | first | adding | removing | growth | sound |\n\
         |---|---:|---:|---:|---:|---:|---:|---:|---:|---|\n",
    );
    let growth = growth(&tables.runs);
    for row in &comparisons {
        let exponent = |engine: &str| {
            let is_here = |growth: &&Growth| {
                (growth.scene, growth.engine, growth.to_size) == (row.scene, engine, row.size)
            };
            growth.iter().find(is_here).map(|growth| growth.exponent)
        };
        let more = exponent(OURS).zip(exponent(BOX2D)).map(|(ours, peer)| ours - peer);
        let ratios = [
            row.ratio_box2d,
            row.ratio_rapier,
            row.longest_ratio_box2d,
            row.first_ratio_box2d,
            row.build_ratio_box2d,
            row.clear_ratio_box2d,
            more,
        ];
        let cells =
            ratios.map(|ratio| ratio.map_or("-".to_owned(), |ratio| format!("{ratio:.2}"))).join(" | ");
        let sound = if row.state_ok { "yes" } else { "no" };
        add(text, format_args!("| {} | {} | {cells} | {sound} |\n", row.scene, row.bodies));
    }
    let ratios: Vec<f64> = comparisons.iter().filter_map(|row| row.ratio_box2d).collect();
    if !ratios.is_empty() {
        let mean = (ratios.iter().map(|ratio| ratio.ln()).sum::<f64>() / ratios.len() as f64).exp();
        add(text, format_args!("\nGeometric mean beside Box2D: {mean:.2}.\n"));
    }
    add(text, format_args!("\n![Times]({TIMES}.png)\n"));
}

/// Appends a table of times in µs by engine, one line for each `(name, engine, µs)` of a new name.
fn beside(text: &mut String, head: &str, rows: &[(String, &str, f64)]) {
    if rows.is_empty() {
        return;
    }
    let engines = [OURS, BOX2D, RAPIER];
    add(text, format_args!("{head} | {} | ours / Box2D |\n|---|---:|---:|---:|---:|\n", engines.join(" | ")));
    let mut names: Vec<&String> = Vec::new();
    for (name, ..) in rows {
        if !names.contains(&name) {
            names.push(name);
        }
    }
    for name in names {
        let value = |engine| rows.iter().find(|row| row.0 == *name && row.1 == engine).map(|row| row.2);
        let cells = engines.map(|engine| value(engine).map_or("-".to_owned(), |value| value.to_string()));
        let ratio = value(OURS)
            .zip(value(BOX2D))
            .map_or("-".to_owned(), |(ours, peer)| format!("{:.2}", ours / peer));
        add(text, format_args!("| {name} | {} | {ratio} |\n", cells.join(" | ")));
    }
}

fn queries_section(text: &mut String, tables: &Tables) {
    let row = |row: &QueryFigures| {
        let QueryFigures { world, bodies, query, length, engine, us, .. } = row;
        (format!("{query} of {length} m in {world}, {bodies}"), *engine, *us)
    };
    let rows: Vec<_> = tables.queries.iter().map(row).collect();
    beside(text, "\n## Queries\n\nCPU time in µs of a query.\n\n| query", &rows);
}

fn changes_section(text: &mut String, tables: &Tables) {
    let row = |row: &ChangeFigures| (format!("{}, {} tiles", row.change, row.tiles), row.engine, row.us);
    let rows: Vec<_> = tables.changes.iter().map(row).collect();
    let head = "\n## Changes\n\nMedian CPU time in µs of a change and the step after it.\n\n| change";
    beside(text, head, &rows);
}

fn memory_section(text: &mut String, tables: &Tables) {
    let row = |row: &MemoryFigures| {
        (format!("{}, {} bodies", row.scene, row.bodies), known(&row.engine), row.bytes_per_body)
    };
    let rows: Vec<_> = tables.memory.iter().map(row).collect();
    beside(text, "\n## Memory\n\nPeak of resident memory in bytes per body.\n\n| scene", &rows);
}

/// Returns the constant name of an engine.
fn known(engine: &str) -> &'static str {
    [OURS, BOX2D, RAPIER].into_iter().find(|name| *name == engine).unwrap_or("")
}

fn add(text: &mut String, what: std::fmt::Arguments<'_>) {
    text.write_fmt(what).expect("a string takes everything");
}

/// Reads rows of the table of memory.
///
/// # Errors
/// The text is no such table.
pub fn memory_rows(text: &str) -> Result<Vec<MemoryFigures>> {
    Ok(read_memory(text)?)
}

/// Returns a table of comma-separated values, without quotes, as text with aligned columns.
fn aligned(table: &str) -> String {
    let rows: Vec<Vec<&str>> = table.lines().map(|line| line.split(',').collect()).collect();
    let columns = rows.first().map_or(0, Vec::len);
    let width = |column: usize| rows.iter().map(|row| row[column].len()).max().unwrap_or(0);
    let widths: Vec<usize> = (0..columns).map(width).collect();
    let line = |row: &Vec<&str>| {
        let cells = row.iter().zip(&widths).map(|(cell, width)| format!("{cell:>width$}"));
        cells.collect::<Vec<_>>().join("  ") + "\n"
    };
    rows.iter().map(line).collect()
}
