//! Speed against accuracy: runs scenes with methods in many settings, and tells what they take and how wrong they are.
//!
//! `cargo run --release --features peers --example accuracy_vs_speed` writes to `target/accuracy_vs_speed` a table of
//! all figures, a chart of every scene, an overview and a report, for the 2D engine (folder `2d`) and for the 2.5D
//! engine (folder `2.5d`). Without the feature there are no other engines in them. The figures are for the machine they
//! were made on; what may be quoted are ratios of one run.

use clap::Parser;
use conformance::measure::charts::chart_scenes;
use conformance::measure::csv::csv;
use conformance::measure::depth::{
    PLANES, PlaneChart, depth_chart_scenes, depth_methods, depth_peer_versions, plane_table, plane_trials,
};
use conformance::measure::method::{Effort, Setting, methods, peer_versions};
use conformance::measure::origin::origin;
use conformance::measure::plot::lines::Chart;
use conformance::measure::plot::overview::Overview;
use conformance::measure::plot::save;
use conformance::measure::progress::Progress;
use conformance::measure::report::{Report, picture};
use conformance::measure::sweep::{Subject, Sweep, Trial};
use conformance::measure::trials::trials;
use examples::Result;
use std::fs;
use std::path::{Path, PathBuf};

/// Runs scenes with methods in many settings, and charts error over time.
#[derive(Debug, Parser)]
struct Arguments {
    /// Few settings, and no large scenes: minutes.
    #[arg(long)]
    quick: bool,
    /// Only scenes with this in their names.
    #[arg(long, value_name = "NAME")]
    scene: Option<String>,
    /// Only methods with this in their names.
    #[arg(long, value_name = "NAME")]
    method: Option<String>,
    /// Where to write.
    #[arg(long, value_name = "DIR", default_value = "target/accuracy_vs_speed")]
    out: PathBuf,
}

impl Arguments {
    fn effort(&self) -> Effort {
        if self.quick { Effort::Quick } else { Effort::Full }
    }

    fn wants_scene(&self, name: &str) -> bool {
        is_in(self.scene.as_deref(), name)
    }

    fn wants_method(&self, name: &str) -> bool {
        is_in(self.method.as_deref(), name)
    }
}

fn is_in(part: Option<&str>, name: &str) -> bool {
    part.is_none_or(|part| name.to_lowercase().contains(&part.to_lowercase()))
}

/// Scenes and methods that are charted together.
struct Group {
    folder: &'static str,
    title: &'static str,
    subjects: Vec<Subject>,
    methods: Vec<(&'static str, Setting)>,
    trials: Vec<Trial<'static>>,
    /// Versions of the peers.
    peers: Vec<(&'static str, String)>,
}

fn main() -> Result<()> {
    let arguments = Arguments::parse();
    let groups = [flat(&arguments), deep(&arguments)];
    let mut progress = Progress::of(groups.iter().flat_map(|group| &group.trials));
    for group in groups.iter().filter(|group| !group.trials.is_empty()) {
        let mut sweep = Sweep::default();
        sweep.run(&group.trials, &mut progress);
        let folder = arguments.out.join(group.folder);
        write(group, &sweep, &folder)?;
        eprintln!("\n{}", folder.join("report.md").display());
    }
    eprintln!("{} s", progress.end().as_secs());
    Ok(())
}

fn flat(arguments: &Arguments) -> Group {
    let mut scenes = chart_scenes();
    scenes.retain(|scene| arguments.wants_scene(scene.name));
    let all = methods();
    let wanted: Vec<_> = all.iter().filter(|method| arguments.wants_method(method.name)).copied().collect();
    let subjects = scenes.iter().map(|scene| scene.subject());
    Group {
        folder: "2d",
        title: "Speed against accuracy, 2D",
        subjects: subjects.collect(),
        methods: all.iter().map(|method| (method.name, method.recommended)).collect(),
        trials: trials(&scenes, &wanted, arguments.effort()),
        peers: peer_versions(),
    }
}

fn deep(arguments: &Arguments) -> Group {
    let mut scenes = depth_chart_scenes();
    scenes.retain(|scene| arguments.wants_scene(scene.name));
    let all = depth_methods();
    let wanted: Vec<_> = all.iter().filter(|method| arguments.wants_method(method.name)).copied().collect();
    let mut trials = trials(&scenes, &wanted, arguments.effort());
    let mut planes = plane_trials(arguments.effort());
    planes.retain(|trial| arguments.wants_scene(trial.scene) && arguments.wants_method(trial.method));
    let mut methods: Vec<_> = all.iter().map(|method| (method.name, method.recommended)).collect();
    methods.extend(planes.first().map(|trial| ("2D", trial.setting)));
    let mut sizes: Vec<usize> = planes.iter().map(|trial| trial.size).collect();
    sizes.dedup();
    trials.extend(planes);
    let subjects = scenes.iter().map(|scene| scene.subject());
    let planes = Subject {
        name: PLANES,
        about: "Circles that fall into a pit, all at one depth, with and without the third axis.",
        sizes,
        error: "largest distance from the 2D engine's circles",
        unit: "px",
        // Less than a pixel cannot be seen.
        tolerance: 1.0,
    };
    Group {
        folder: "2.5d",
        title: "Speed against accuracy, 2.5D",
        subjects: subjects.chain([planes]).collect(),
        methods,
        trials,
        peers: depth_peer_versions(),
    }
}

/// Writes what came of a group.
fn write(group: &Group, sweep: &Sweep, folder: &Path) -> Result<()> {
    fs::create_dir_all(folder)?;
    let subjects = group.subjects.iter().cloned();
    let subjects: Vec<Subject> = subjects.filter_map(|subject| subject.with_points(&sweep.points)).collect();
    let (methods, points) = (&group.methods[..], &sweep.points[..]);
    fs::write(folder.join("figures.csv"), csv(points, &subjects))?;
    save(&Overview { title: group.title, subjects: &subjects, methods, points }, folder, "overview")?;
    // What is compared there is time over the number of objects: it has a chart and a table of its own.
    let (planes, charted): (Vec<_>, Vec<_>) =
        subjects.into_iter().partition(|subject| subject.name == PLANES);
    let origin = origin(group.peers.iter().cloned());
    let report = Report { title: group.title, origin: &origin, subjects: &charted, methods, sweep };
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
