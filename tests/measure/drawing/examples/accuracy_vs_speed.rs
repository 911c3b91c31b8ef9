//! Compares speed and accuracy: runs scenes with methods in many settings, and reports the time and error of each run.
//!
//! `cargo run --release --features peers --example accuracy_vs_speed` writes to `target/accuracy_vs_speed`: a table of all
//! figures, a chart of every scene, an overview and a report. The folder `2d` is for the 2D engine, `2.5d` for the 2.5D engine.
//! Without the feature no other engines take part. Times hold for the machine that measured them; only ratios of one run may be
//! quoted.

use clap::error::ErrorKind;
use clap::{CommandFactory, Parser};
use drawing::measuring::{Engine, Measuring, Origin, Result, merged_origin, tables};
use drawing::plane_chart::{PlaneChart, plane_table};
use drawing::plot::lines::Chart;
use drawing::plot::overview::Overview;
use drawing::plot::save;
use drawing::progress::Progress;
use drawing::report::{Report, picture};
use measure::charts::{ChartScene, chart_scenes};
use measure::csv::{csv, points};
use measure::depth::{
    PLANE_SCENE, PLANES, depth_chart_scenes, depth_methods, depth_peer_versions, plane_methods,
};
use measure::method::{Method, Setting, methods, peer_versions};
use measure::origin::origin;
use measure::sweep::{Subject, Sweep, Trial};
use measure::trials::trials;
use std::fs;
use std::path::{Path, PathBuf};
use std::slice;

/// Scenes and methods of one engine, which are charted together.
struct Group {
    folder: &'static str,
    title: String,
    subjects: Vec<Subject>,
    methods: Vec<(&'static str, Setting)>,
    trials: Vec<Trial<'static>>,
    /// Names and versions of the peers.
    peers: Vec<(&'static str, String)>,
}

const FOLDER: &str = "target/accuracy_vs_speed";
/// Name of the file with the table of figures in an output folder.
const FIGURES: &str = "figures";

/// Runs scenes with methods in many settings, and charts error over time.
#[derive(Debug, Parser)]
struct Arguments {
    #[command(flatten)]
    measuring: Measuring,
    /// Measure nothing: draw and report earlier measurements again, from the tables in the folders.
    #[arg(long, conflicts_with_all = ["shard", "merge"])]
    redraw: bool,
}

fn main() -> Result<()> {
    let Arguments { measuring, redraw } = Arguments::parse();
    let mut groups = vec![flat(&measuring), deep(&measuring)];
    groups.retain(|group| !group.trials.is_empty());
    if groups.is_empty() {
        Arguments::command().error(ErrorKind::InvalidValue, nothing_to_run(&measuring)).exit();
    }
    // The program makes the output folders before the first run, so that it does not measure results it cannot write.
    let folders = groups.iter().map(|group| measuring.folder(FOLDER, group.folder));
    let folders = folders.collect::<Result<Vec<_>>>()?;
    if redraw || !measuring.merge().is_empty() {
        return draw_again(&measuring, redraw, &groups, &folders);
    }
    for group in &mut groups {
        group.trials = Trial::of_shard(std::mem::take(&mut group.trials), measuring.shard());
    }
    let progress = Progress::of(groups.iter().flat_map(|group| &group.trials).map(Trial::cost).sum());
    for (group, folder) in groups.iter().zip(&folders) {
        let (mut sweep, before) = (Sweep::default(), progress.done());
        sweep.run(&group.trials, &mut |trial, done| progress.tell(before + done, next(trial)));
        progress.advance(before + group.trials.iter().map(Trial::cost).sum::<f64>() - progress.done());
        let origin = origin(group.peers.iter().cloned());
        measuring.write_table(folder, FIGURES, &csv(&sweep.points, &group.subjects), &origin)?;
        if !measuring.is_part() {
            draw(group, &sweep, &origin, folder)?;
        }
        eprintln!("\n{}", folder.display());
    }
    eprintln!("{} s", progress.end().as_secs());
    Ok(())
}

/// Returns the progress message for the trial that begins next.
fn next(trial: &Trial<'_>) -> String {
    let size = if trial.size == 0 { String::new() } else { format!(" {}", trial.size) };
    format!("{}{size}, {}", trial.scene, trial.method)
}

/// Draws charts of earlier measurements: in the folders that hold them, or merged from shards into `folders`.
fn draw_again(measuring: &Measuring, redraw: bool, groups: &[Group], folders: &[PathBuf]) -> Result<()> {
    for (group, folder) in groups.iter().zip(folders) {
        let from = if redraw { slice::from_ref(folder) } else { measuring.merge() };
        let (tables, all) = tables(from, FIGURES)?;
        let read = tables.iter().map(|table| points(table).map_err(|wrong| format!("{FIGURES}: {wrong}")));
        let mut points = read.collect::<std::result::Result<Vec<_>, _>>()?.concat();
        points.retain(|point| group.subjects.iter().any(|subject| subject.name == point.scene));
        let sweep = if redraw {
            Sweep::of_points(points, &group.trials)
        } else {
            Sweep::merged(points, &group.trials)?
        };
        let origin = merged_origin(origin(group.peers.iter().cloned()), Some(&all));
        measuring.write_table(folder, FIGURES, &csv(&sweep.points, &group.subjects), &origin)?;
        draw(group, &sweep, &origin, folder)?;
        eprintln!("{}", folder.join("report.md").display());
    }
    Ok(())
}

fn nothing_to_run(arguments: &Measuring) -> String {
    let (scenes, depth_scenes) = (chart_scenes(), depth_chart_scenes());
    let scenes = scenes.iter().map(|scene| scene.name).chain(depth_scenes.iter().map(|scene| scene.name));
    let (methods, depth_methods) = (methods(), depth_methods());
    let methods =
        methods.iter().map(|method| method.name).chain(depth_methods.iter().map(|method| method.name));
    arguments.nothing_to_run(scenes.chain([PLANES]), methods)
}

fn flat(arguments: &Measuring) -> Group {
    let mut group = group(arguments, Engine::Plane, chart_scenes(), &methods());
    group.peers = peer_versions();
    group
}

fn deep(arguments: &Measuring) -> Group {
    let mut deep = group(arguments, Engine::Depth, depth_chart_scenes(), &depth_methods());
    let planes = group(arguments, Engine::Depth, vec![PLANE_SCENE], &plane_methods());
    deep.peers = depth_peer_versions();
    deep.subjects.extend(planes.subjects);
    // The other two methods of `plane_methods` are in the list of the 2.5D engine already.
    deep.methods.extend(planes.methods.first().filter(|_| !planes.trials.is_empty()));
    deep.trials.extend(planes.trials);
    deep
}

fn group<S: PartialEq + 'static>(
    arguments: &Measuring,
    engine: Engine,
    mut scenes: Vec<ChartScene<S>>,
    methods: &[Method<S>],
) -> Group {
    scenes.retain(|scene| arguments.wants_scene(engine, scene.name));
    let wanted: Vec<_> =
        methods.iter().filter(|method| arguments.wants_method(method.name)).copied().collect();
    Group {
        folder: engine.folder(),
        title: format!("Speed against accuracy, {}", engine.name()),
        subjects: scenes.iter().map(|scene| scene.subject()).collect(),
        methods: methods.iter().map(|method| (method.name, method.recommended)).collect(),
        trials: trials(&scenes, &wanted, arguments.effort()),
        peers: Vec::new(),
    }
}

/// Draws the charts of a group and writes its report.
fn draw(group: &Group, sweep: &Sweep, origin: &Origin, folder: &Path) -> Result<()> {
    let subjects = group.subjects.iter().cloned();
    let subjects: Vec<Subject> = subjects.filter_map(|subject| subject.with_points(&sweep.points)).collect();
    let (methods, points) = (&group.methods[..], &sweep.points[..]);
    save(&Overview { title: &group.title, subjects: &subjects, methods, points }, folder, "overview")?;
    // Scenes that compare time over the number of objects have a chart and a table of another kind.
    let (planes, charted): (Vec<_>, Vec<_>) =
        subjects.into_iter().partition(|subject| subject.name == PLANES);
    let report = Report { title: &group.title, origin, subjects: &charted, methods, sweep };
    let mut text = report.markdown();
    if let ([subject], Some(table)) = (&planes[..], plane_table(points)) {
        let title = subject.name.replace('_', " ");
        text +=
            &format!("\n## {title}\n\n{}\n\n![{title}]({}.png)\n\n{table}", subject.about, picture(subject));
        save(&PlaneChart { points }, folder, &picture(subject))?;
    }
    fs::write(folder.join("report.md"), text)?;
    for subject in &charted {
        save(&Chart { subject, methods, points }, folder, &picture(subject))?;
    }
    Ok(())
}
