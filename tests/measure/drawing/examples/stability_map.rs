//! Where methods fail: runs families of scenes that get harder and harder, until methods fail.
//!
//! `cargo run --release --features peers --example stability_map` writes to `target/stability_map` a table of all runs, a
//! map of every family, an overview and a report with the first failures, for the 2D engine (folder `2d`) and for the
//! 2.5D engine (folder `2.5d`). Without the feature there are no other engines in them. Nothing is timed.

use clap::error::ErrorKind;
use clap::{CommandFactory, Parser};
use drawing::maps::{file_name, report};
use drawing::measuring::{Engine, Measuring, Result};
use drawing::plot::first_failures::FirstFailures;
use drawing::plot::heat::HeatMap;
use drawing::plot::save;
use measure::depth::{depth_families, depth_methods, depth_peer_versions};
use measure::method::{Method, methods, peer_versions};
use measure::origin::origin;
use measure::stability::map::{Map, Sheet};
use measure::stability::sheet::sheet;
use measure::stability::table::csv;
use measure::stability::{StabilityFamily, families};
use std::fs;
use std::io::{IsTerminal, stderr};
use std::path::Path;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::time::Instant;

const FOLDER: &str = "target/stability_map";

/// Families of an engine, as maps still to be made.
struct Group {
    folder: &'static str,
    title: String,
    sheets: Vec<Sheet>,
    /// Versions of the peers.
    peers: Vec<(&'static str, String)>,
}

/// Runs families of scenes that get harder and harder, and maps which methods fail where.
#[derive(Debug, Parser)]
struct Arguments {
    #[command(flatten)]
    measuring: Measuring,
}

fn main() -> Result<()> {
    let arguments = Arguments::parse().measuring;
    let mut groups = vec![
        group(&arguments, Engine::Plane, families(), methods(), peer_versions()),
        group(&arguments, Engine::Depth, depth_families(), depth_methods(), depth_peer_versions()),
    ];
    groups.retain(|group| !group.sheets.is_empty());
    if groups.is_empty() {
        Arguments::command().error(ErrorKind::InvalidValue, nothing_to_run(&arguments)).exit();
    }
    // Before anything is run: what cannot be written would be lost.
    let folders = groups.iter().map(|group| arguments.folder(FOLDER, group.folder));
    let folders = folders.collect::<Result<Vec<_>>>()?;
    let progress = Progress::of(groups.iter().flat_map(|group| &group.sheets));
    for (group, folder) in groups.into_iter().zip(&folders) {
        let maps: Vec<Map> = group.sheets.iter().map(|sheet| progress.fill(sheet)).collect();
        write(&group.title, group.peers, &maps, folder)?;
        eprintln!("\n{}", folder.join("report.md").display());
    }
    eprintln!("{} s", progress.start.elapsed().as_secs());
    Ok(())
}

fn nothing_to_run(arguments: &Measuring) -> String {
    let (families, depth_families) = (families(), depth_families());
    let families = families.iter().map(|one| one.name).chain(depth_families.iter().map(|one| one.name));
    let (methods, depth_methods) = (methods(), depth_methods());
    let methods =
        methods.iter().map(|method| method.name).chain(depth_methods.iter().map(|method| method.name));
    arguments.nothing_to_run(families, methods)
}

fn group<S: 'static>(
    arguments: &Measuring,
    engine: Engine,
    families: Vec<StabilityFamily<S>>,
    mut methods: Vec<Method<S>>,
    peers: Vec<(&'static str, String)>,
) -> Group {
    methods.retain(|method| arguments.wants_method(method.name));
    let families = families.into_iter().filter(|family| arguments.wants_scene(engine, family.name));
    let sheets = families.map(|family| sheet(family, &methods, arguments.effort()));
    Group {
        folder: engine.folder(),
        title: format!("Where methods fail, {}", engine.name()),
        sheets: sheets.filter(|sheet| sheet.run_count() > 0).collect(),
        peers,
    }
}

/// Writes what came of the families of an engine.
fn write(title: &str, peers: Vec<(&'static str, String)>, maps: &[Map], folder: &Path) -> Result<()> {
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
