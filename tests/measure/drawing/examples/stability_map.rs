//! Finds the limits of methods: runs families of scenes of increasing difficulty until methods fail.
//!
//! `cargo run --release --features peers --example stability_map` writes to `target/stability_map`: a table of all runs, a map
//! of every family, an overview, and a report with the first failures. The folder `2d` is for the 2D engine, `2.5d` for the
//! 2.5D engine. Without the feature no other engines take part. The program measures no time.

use clap::error::ErrorKind;
use clap::{CommandFactory, Parser};
use drawing::maps::{file_name, report};
use drawing::measuring::{Engine, Measuring, Origin, Result, merged_origin, tables};
use drawing::plot::first_failures::FirstFailures;
use drawing::plot::heat::HeatMap;
use drawing::plot::save;
use drawing::progress::Progress;
use measure::depth::{depth_families, depth_methods, depth_peer_versions};
use measure::method::{Method, methods, peer_versions};
use measure::origin::origin;
use measure::stability::map::{Map, Sheet};
use measure::stability::sheet::sheet;
use measure::stability::table::{csv, csv_of_runs, maps};
use measure::stability::{StabilityFamily, families};
use std::fs;
use std::path::Path;

const FOLDER: &str = "target/stability_map";
/// Name of the file with the table of runs in an output folder.
const RUNS: &str = "runs";

/// Families of an engine, as maps whose runs are still to be made.
struct Group {
    folder: &'static str,
    title: String,
    sheets: Vec<Sheet>,
    /// Names and versions of the peers.
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
    // The program makes the output folders before the first run, so that it does not lose results it cannot write.
    let folders = groups.iter().map(|group| arguments.folder(FOLDER, group.folder));
    let folders = folders.collect::<Result<Vec<_>>>()?;
    let (tables, all) = if arguments.merge().is_empty() {
        (run(&arguments, &groups), None)
    } else {
        tables(arguments.merge(), RUNS).map(|(tables, origin)| (tables, Some(origin)))?
    };
    let origin = |group: &Group| merged_origin(origin(group.peers.iter().cloned()), all.as_ref());
    if arguments.is_part() {
        let mut parts = groups.iter().zip(&folders).zip(&tables);
        return parts.try_for_each(|((group, folder), table)| {
            arguments.write_table(folder, RUNS, table, &origin(group))
        });
    }
    let maps = maps(groups.iter().flat_map(|group| &group.sheets), &tables)?;
    let mut rest = &maps[..];
    for (group, folder) in groups.iter().zip(&folders) {
        let (own, others) = rest.split_at(group.sheets.len());
        rest = others;
        arguments.write_table(folder, RUNS, &csv(own), &origin(group))?;
        draw(&group.title, &origin(group), own, folder)?;
        eprintln!("{}", folder.join("report.md").display());
    }
    Ok(())
}

/// Makes the runs of all groups, or those of a shard. Returns a table for each group.
fn run(arguments: &Measuring, groups: &[Group]) -> Vec<String> {
    let costs = groups.iter().flat_map(|group| &group.sheets).flat_map(Sheet::costs);
    let picks = arguments.shard().picks(&costs.collect::<Vec<_>>());
    let progress = Progress::of(picks.iter().filter(|pick| **pick).count() as f64);
    let mut picks = picks.into_iter();
    let mut table = |group: &Group| {
        csv_of_runs(group.sheets.iter().flat_map(|sheet| {
            let runs: Vec<usize> = (0..sheet.run_count()).filter(|_| picks.next() == Some(true)).collect();
            progress.tell(progress.done(), sheet.heading.name.clone());
            let cells = sheet.make(&runs, &|| progress.advance(1.0));
            runs.into_iter().zip(cells).map(|(run, cell)| (&sheet.heading, run, cell))
        }))
    };
    let tables = groups.iter().map(&mut table).collect();
    eprintln!("{} s", progress.end().as_secs());
    tables
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

/// Draws the maps of an engine's families and writes their report.
fn draw(title: &str, origin: &Origin, maps: &[Map], folder: &Path) -> Result<()> {
    fs::write(folder.join("report.md"), report(title, origin, maps))?;
    save(&FirstFailures::new(maps), folder, "overview")?;
    for map in maps {
        save(&HeatMap(map), folder, &file_name(&map.heading.name))?;
    }
    Ok(())
}
