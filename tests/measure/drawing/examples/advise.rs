//! Recommends a method for a scene: the cheapest of those that are accurate enough.
//!
//! `cargo run --release --example advise -- SCENE.json` runs a scene, in the format of the conformance tests, with all choices
//! of methods. It prints the time and error of each choice, and which one to take. `--out` names the folder for a chart. A game
//! whose scene is in code calls [`measure::advise::advise`] with a function that builds the scene.

use clap::Parser;
use conformance::scene::Scene;
use drawing::measuring::Result;
use drawing::plot::lines::Chart;
use drawing::plot::save;
use measure::advise::{Asked, advise_on, asked_of};
use std::fs;
use std::path::PathBuf;

/// Runs a scene with all choices of methods, and recommends one.
#[derive(Debug, Parser)]
struct Arguments {
    /// A scene as JSON, plain or compressed by gzip.
    scene: PathBuf,
    /// Simulated time in s [default: that of the scene].
    #[arg(long)]
    seconds: Option<f64>,
    /// The game's time step in s [default: that of the scene].
    #[arg(long)]
    dt: Option<f32>,
    /// Size of objects in the scene's unit of length: 32 in px, 1 in metres.
    #[arg(long, default_value_t = 32.0)]
    length_unit: f32,
    /// Greatest error that no player sees, as a length [default: a 32nd of the length unit].
    #[arg(long)]
    tolerance: Option<f64>,
    /// A folder for a chart of error over time.
    #[arg(long, value_name = "DIR")]
    out: Option<PathBuf>,
}

fn main() -> Result<()> {
    let Arguments { scene, seconds, dt, length_unit, tolerance, out } = Arguments::parse();
    let scene = Scene::from_file(scene).map_err(|error| error.to_string())?;
    let by_itself = asked_of(&scene);
    let asked = Asked {
        seconds: seconds.unwrap_or(by_itself.seconds),
        dt: dt.unwrap_or(by_itself.dt),
        length_unit,
        tolerance: tolerance.unwrap_or(f64::from(length_unit) / 32.0),
        ..by_itself
    };
    // The program makes the output folder before the first run, so that it does not measure results it cannot write.
    out.as_ref().map(fs::create_dir_all).transpose()?;
    let advice = advise_on(&scene, &asked)?;
    println!(
        "{}: {}\n\n{}\n{}\n\n{}",
        scene.name,
        scene.about,
        advice.table(),
        advice.sentence(),
        advice.notes()
    );
    if let Some(folder) = out {
        let (subject, methods) = (advice.subject(), advice.methods());
        save(&Chart { subject: &subject, methods: &methods, points: &advice.points }, &folder, "advice")?;
        println!("\n{}", folder.join("advice.png").display());
    }
    Ok(())
}
