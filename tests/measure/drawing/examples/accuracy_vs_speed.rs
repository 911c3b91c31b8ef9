//! Speed against accuracy: runs scenes with methods in many settings, and tells what they take and how wrong they are.
//!
//! `cargo run --release --features peers --example accuracy_vs_speed` writes to `target/accuracy_vs_speed` a table of
//! all figures, a chart of every scene, an overview and a report, for the 2D engine (folder `2d`) and for the 2.5D
//! engine (folder `2.5d`). Without the feature there are no other engines in them. The figures are for the machine they
//! were made on; what may be quoted are ratios of one run.

use clap::error::ErrorKind;
use clap::{CommandFactory, Parser};
use drawing::measuring::{Engine, Measuring, Result};
use drawing::plane_chart::{PlaneChart, plane_table};
use drawing::plot::lines::Chart;
use drawing::plot::overview::Overview;
use drawing::plot::save;
use drawing::report::{Report, picture};
use measure::charts::{ChartScene, chart_scenes};
use measure::csv::{csv, points};
use measure::depth::{
    PLANE_SCENE, PLANES, depth_chart_scenes, depth_methods, depth_peer_versions, plane_methods,
};
use measure::method::{Method, Setting, methods, peer_versions};
use measure::origin::{origin, origin_csv, read_origin};
use measure::progress::Progress;
use measure::sweep::{Subject, Sweep, Trial};
use measure::trials::trials;
use std::fs;
use std::path::Path;

/// Scenes and methods that are charted together.
struct Group {
    folder: &'static str,
    title: String,
    subjects: Vec<Subject>,
    methods: Vec<(&'static str, Setting)>,
    trials: Vec<Trial<'static>>,
    /// Versions of the peers.
    peers: Vec<(&'static str, String)>,
}

const FOLDER: &str = "target/accuracy_vs_speed";
/// The tables of a folder: what was measured, and where it comes from.
const FIGURES: &str = "figures.csv";
const ORIGIN: &str = "origin.csv";

/// Runs scenes with methods in many settings, and charts error over time.
#[derive(Debug, Parser)]
struct Arguments {
    #[command(flatten)]
    measuring: Measuring,
    /// Measure nothing: draw and report again what was measured before, from the tables in the folders.
    #[arg(long)]
    redraw: bool,
}

fn main() -> Result<()> {
    let Arguments { measuring, redraw } = Arguments::parse();
    let mut groups = vec![flat(&measuring), deep(&measuring)];
    groups.retain(|group| !group.trials.is_empty());
    if groups.is_empty() {
        Arguments::command().error(ErrorKind::InvalidValue, nothing_to_run(&measuring)).exit();
    }
    // Before anything is run: what cannot be written would be lost.
    let folders = groups.iter().map(|group| measuring.folder(FOLDER, group.folder));
    let folders = folders.collect::<Result<Vec<_>>>()?;
    let mut progress = Progress::of(groups.iter().flat_map(|group| &group.trials));
    for (group, folder) in groups.iter().zip(&folders) {
        let (sweep, origin) = if redraw { read(group, folder)? } else { run(group, &mut progress) };
        write(group, &sweep, &origin, folder)?;
        eprintln!("\n{}", folder.join("report.md").display());
    }
    eprintln!("{} s", progress.end().as_secs());
    Ok(())
}

/// Where figures come from, as names and values.
type Origin = Vec<(&'static str, String)>;

fn run(group: &Group, progress: &mut Progress) -> (Sweep, Origin) {
    let mut sweep = Sweep::default();
    sweep.run(&group.trials, progress);
    (sweep, origin(group.peers.iter().cloned()))
}

/// What was written before.
fn read(group: &Group, folder: &Path) -> Result<(Sweep, Origin)> {
    let text = |name: &str| {
        let path = folder.join(name);
        fs::read_to_string(&path).map_err(|error| format!("cannot read {}: {error}", path.display()))
    };
    let points = points(&text(FIGURES)?).map_err(|wrong| format!("{FIGURES}: {wrong}"))?;
    let origin = read_origin(&text(ORIGIN)?).map_err(|wrong| format!("{ORIGIN}: {wrong}"))?;
    Ok((Sweep::of_points(points, &group.trials), origin))
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
    // The others are methods of the 2.5D engine as well.
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

/// Writes what came of a group.
fn write(group: &Group, sweep: &Sweep, origin: &Origin, folder: &Path) -> Result<()> {
    let subjects = group.subjects.iter().cloned();
    let subjects: Vec<Subject> = subjects.filter_map(|subject| subject.with_points(&sweep.points)).collect();
    let (methods, points) = (&group.methods[..], &sweep.points[..]);
    fs::write(folder.join(FIGURES), csv(points, &subjects))?;
    fs::write(folder.join(ORIGIN), origin_csv(origin))?;
    save(&Overview { title: &group.title, subjects: &subjects, methods, points }, folder, "overview")?;
    // What is compared there is time over the number of objects: it has a chart and a table of its own.
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
