//! Runs the ten scenes of Box2D's benchmark at several sizes: time per step, growth with the size, counters, final states.
//!
//! `cargo run --release --features peers --example arena` prints tables and writes them to `target/arena`. Without the feature
//! Box2D does not take part. `--quick` plays sizes 1/16 and 1/4. Times hold for the machine that measured them; only ratios of
//! one run may be quoted.

use clap::Parser;
use drawing::measuring::Result;
use measure::arena::run::{Effort, RunFigures, arena_csv, comparisons, growth, run};
use measure::arena::{engines, scenes};
use measure::method::peer_versions;
use measure::origin::{origin, origin_csv};
use std::fs;
use std::path::PathBuf;

/// Plays the scenes of Box2D's benchmark.
#[derive(Debug, Parser)]
struct Arguments {
    /// Sizes 1/16 and 1/4 alone.
    #[arg(long, conflicts_with = "sizes")]
    quick: bool,
    /// Sizes, as shares of the release benchmark's number of bodies, in ascending order.
    #[arg(long, value_name = "SHARE", num_args = 1.., default_values_t = [0.0625, 0.25, 1.0])]
    sizes: Vec<f32>,
    /// Only scenes with this in their names.
    #[arg(long, value_name = "NAME", default_value = "")]
    scene: String,
    /// Only engines with this in their names.
    #[arg(long, value_name = "NAME", default_value = "")]
    engine: String,
    /// Runs of each engine; a step counts with the least of its times.
    #[arg(long, default_value_t = 3, value_parser = clap::value_parser!(u32).range(1..))]
    turns: u32,
    /// CPU time in s after which a run is ended: engines are compared over the steps that all have made.
    #[arg(long, value_name = "SECONDS", default_value_t = 20.0)]
    budget: f64,
    /// Where to write.
    #[arg(long, value_name = "DIR", default_value = "target/arena")]
    out: PathBuf,
}

fn main() -> Result<()> {
    let arguments = Arguments::parse();
    let out = &arguments.out;
    // The program makes the output folder before the first run, so that it does not measure results it cannot write.
    fs::create_dir_all(out).map_err(|error| format!("cannot write to {}: {error}", out.display()))?;
    let runs = runs(&arguments)?;
    let tables = [
        ("figures", arena_csv(&comparisons(&runs))),
        ("growth", arena_csv(&growth(&runs))),
        ("runs", arena_csv(&runs)),
    ];
    for (name, table) in &tables {
        fs::write(out.join(format!("{name}.csv")), table)?;
        println!("{}", aligned(table));
    }
    fs::write(out.join("origin.csv"), origin_csv(&origin(peer_versions())))?;
    Ok(())
}

fn runs(arguments: &Arguments) -> Result<Vec<RunFigures>> {
    let sizes = if arguments.quick { &[0.0625, 0.25][..] } else { &arguments.sizes };
    let effort = Effort { turns: arguments.turns as usize, budget: arguments.budget };
    let mut engines = engines();
    engines.retain(|engine| engine.name.to_lowercase().contains(&arguments.engine.to_lowercase()));
    let mut runs = Vec::new();
    for scene in scenes().iter().filter(|scene| scene.name.contains(&arguments.scene)) {
        eprintln!("{}: {}", scene.name, scene.about);
        for &size in sizes {
            runs.extend(run(scene, size, &engines, effort)?);
        }
    }
    Ok(runs)
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
