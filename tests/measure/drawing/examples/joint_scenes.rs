//! Plays joint scenes in our engine and others: how exactly joints hold, whether scenes rest and sleep, and the time of an
//! update.
//!
//! `cargo run --release --features peers --example joint_scenes` prints a line for every scene and engine and writes the table
//! `figures.csv` to `target/joints`. Without the feature, or with `--ours`, our engine plays alone, and is judged by the peers
//! of an older table. With `--random 100` it plays as many random scenes of each of twelve variants instead, and writes
//! `random.csv`: how many blow up, win energy, gape, or do not rest. Times are for the machine they were made on; only ratios
//! of one run may be quoted.

use clap::Parser;
use drawing::joints::{line, summary};
use drawing::measuring::Result;
use measure::joints::counts::{counts, counts_csv};
use measure::joints::engines::{OURS, engines};
use measure::joints::family::family;
use measure::joints::run::run;
use measure::joints::table::{figures_csv, judge, read_figures};
use measure::method::peer_versions;
use measure::origin::{origin, origin_csv};
use std::fs;
use std::path::PathBuf;

/// Number of turns in which each engine is timed.
const TURNS: usize = 3;

/// Plays joint scenes.
#[derive(Debug, Parser)]
struct Arguments {
    /// Only scenes with one of these in their names.
    #[arg(long, value_name = "NAME")]
    scene: Vec<String>,
    /// Without the largest scenes, and timed once.
    #[arg(long)]
    quick: bool,
    /// Only our engine.
    #[arg(long)]
    ours: bool,
    /// A table whose peers judge our engine when it plays alone.
    #[arg(long, value_name = "FILE", default_value = "docs/measured/joints/figures.csv")]
    beside: PathBuf,
    /// Number of random scenes of each variant that replace these scenes.
    #[arg(long, value_name = "COUNT", value_parser = clap::value_parser!(u32).range(1..=100_000))]
    random: Option<u32>,
    /// Where to write.
    #[arg(long, value_name = "DIR", default_value = "target/joints")]
    out: PathBuf,
}

fn main() -> Result<()> {
    let Arguments { scene, quick, ours, beside, random, out } = Arguments::parse();
    fs::create_dir_all(&out).map_err(|error| format!("cannot write to {}: {error}", out.display()))?;
    let engines = if ours { vec![OURS] } else { engines() };
    if let Some(count) = random {
        let table = counts_csv(&counts(count, &engines)?);
        print!("{table}");
        return Ok(fs::write(out.join("random.csv"), table)?);
    }
    let older = match fs::read_to_string(&beside) {
        Ok(text) if engines.len() == 1 => read_figures(&text)?,
        _ => Vec::new(),
    };
    let is_chosen = |name: &str| scene.is_empty() || scene.iter().any(|part| name.contains(part.as_str()));
    let scenes = family().into_iter().filter(|scene| is_chosen(&scene.name) && !(quick && scene.is_large));
    let mut all = Vec::new();
    for scene in scenes {
        let mut figures = run(&scene, &engines, if quick { 1 } else { TURNS })?;
        judge(&mut figures, &older);
        figures.iter().for_each(|figures| println!("{}", line(figures)));
        all.extend(figures);
    }
    print!("{}", summary(&all));
    fs::write(out.join("figures.csv"), figures_csv(&all))?;
    fs::write(out.join("origin.csv"), origin_csv(&origin(peer_versions())))?;
    Ok(())
}
