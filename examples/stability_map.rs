//! Where methods fail: runs families of scenes that get harder and harder, until methods fail.
//!
//! `cargo run --release --features peers --example stability_map` writes to `target/stability_map` a table of all runs, a
//! map of every family, an overview and a report with the first failures, for the 2D engine (folder `2d`) and for the
//! 2.5D engine (folder `2.5d`). Without the feature there are no other engines in them. Nothing is timed.

use clap::Parser;
use conformance::measure::depth::{depth_families, depth_methods, depth_peer_versions, depth_sheet};
use conformance::measure::method::{Effort, methods, peer_versions};
use conformance::measure::origin::origin;
use conformance::measure::plot::first_failures::FirstFailures;
use conformance::measure::plot::heat::HeatMap;
use conformance::measure::plot::save;
use conformance::measure::stability::families;
use conformance::measure::stability::map::{Map, Sheet};
use conformance::measure::stability::sheet::sheet;
use conformance::measure::stability::table::{csv, file_name, report};
use examples::Result;
use std::fs;
use std::io::{IsTerminal, stderr};
use std::path::{Path, PathBuf};
use std::sync::atomic::{AtomicUsize, Ordering};
use std::time::Instant;

/// Runs families of scenes that get harder and harder, and maps which methods fail where.
#[derive(Debug, Parser)]
struct Arguments {
    /// Few values and settings: minutes.
    #[arg(long)]
    quick: bool,
    /// Only families with this in their names.
    #[arg(long, value_name = "NAME")]
    scene: Option<String>,
    /// Only methods with this in their names.
    #[arg(long, value_name = "NAME")]
    method: Option<String>,
    /// Where to write.
    #[arg(long, value_name = "DIR", default_value = "target/stability_map")]
    out: PathBuf,
}

impl Arguments {
    fn effort(&self) -> Effort {
        if self.quick { Effort::Quick } else { Effort::Full }
    }
}

fn is_in(part: Option<&str>, name: &str) -> bool {
    part.is_none_or(|part| name.to_lowercase().contains(&part.to_lowercase()))
}

fn main() -> Result<()> {
    let arguments = Arguments::parse();
    let groups = [
        ("2d", "Where methods fail, 2D", flat(&arguments), peer_versions()),
        ("2.5d", "Where methods fail, 2.5D", deep(&arguments), depth_peer_versions()),
    ];
    let progress = Progress::of(groups.iter().flat_map(|(_, _, sheets, _)| sheets));
    for (folder, title, sheets, peers) in groups.into_iter().filter(|group| !group.2.is_empty()) {
        let maps: Vec<Map> = sheets.iter().map(|sheet| progress.fill(sheet)).collect();
        let folder = arguments.out.join(folder);
        write(title, peers, &maps, &folder)?;
        eprintln!("\n{}", folder.join("report.md").display());
    }
    eprintln!("{} s", progress.start.elapsed().as_secs());
    Ok(())
}

fn flat(arguments: &Arguments) -> Vec<Sheet> {
    let methods: Vec<_> =
        methods().into_iter().filter(|method| is_in(arguments.method.as_deref(), method.name)).collect();
    families()
        .into_iter()
        .filter(|family| is_in(arguments.scene.as_deref(), family.name))
        .map(|family| sheet(family, &methods, arguments.effort()))
        .filter(|sheet| sheet.run_count() > 0)
        .collect()
}

fn deep(arguments: &Arguments) -> Vec<Sheet> {
    let methods: Vec<_> = depth_methods()
        .into_iter()
        .filter(|method| is_in(arguments.method.as_deref(), method.name))
        .collect();
    depth_families()
        .into_iter()
        .filter(|family| is_in(arguments.scene.as_deref(), family.name))
        .map(|family| depth_sheet(family, &methods, arguments.effort()))
        .filter(|sheet| sheet.run_count() > 0)
        .collect()
}

/// Writes what came of the families of an engine.
fn write(title: &str, peers: Vec<(&'static str, String)>, maps: &[Map], folder: &Path) -> Result<()> {
    fs::create_dir_all(folder)?;
    fs::write(folder.join("runs.csv"), csv(maps))?;
    fs::write(folder.join("report.md"), report(title, &origin(peers), maps))?;
    save(&FirstFailures::new(maps), folder, "overview")?;
    for map in maps {
        save(&HeatMap(map), folder, &file_name(&map.heading.name))?;
    }
    Ok(())
}

/// How far the sweep is, told on the standard error stream after every family, or on a terminal after every run.
struct Progress {
    start: Instant,
    runs: usize,
    done: AtomicUsize,
    is_terminal: bool,
}

impl Progress {
    fn of<'a>(sheets: impl Iterator<Item = &'a Sheet>) -> Self {
        let runs = sheets.map(Sheet::run_count).sum();
        Progress {
            start: Instant::now(),
            runs,
            done: AtomicUsize::new(0),
            is_terminal: stderr().is_terminal(),
        }
    }

    fn fill(&self, sheet: &Sheet) -> Map {
        let name = &sheet.heading.name;
        let map = sheet.fill(&|| {
            self.done.fetch_add(1, Ordering::Relaxed);
            if self.is_terminal {
                eprint!("\r{:<100.100}", self.line(name));
            }
        });
        if !self.is_terminal {
            eprintln!("{}", self.line(name));
        }
        map
    }

    /// The time left is judged by the number of runs, and so a guess.
    fn line(&self, name: &str) -> String {
        let done = self.done.load(Ordering::Relaxed);
        let elapsed = self.start.elapsed().as_secs_f64();
        let left = elapsed * (self.runs - done) as f64 / done.max(1) as f64;
        format!("{done} of {} runs, about {left:.0} s left: {name}", self.runs)
    }
}
