//! Writes the figures of the arena: tables, and a report with charts.

use crate::measuring::{Origin, Result};
use measure::arena::changes::ChangeFigures;
use measure::arena::memory::{MemoryFigures, read_memory};
use measure::arena::queries::QueryFigures;
use measure::arena::run::{RunFigures, arena_csv, comparisons, growth};
use measure::origin::origin_csv;
use std::fs;
use std::path::Path;

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
    Ok(text)
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
