//! Options of the command line.

use std::path::PathBuf;
use std::process::ExitCode;

use clap::Parser;
use examples::Result;
use farseer_core::Recording;
use gallery::film::Film;
use gallery::scenes::{GalleryScene, is_recording, scenes};
use gallery::{Layers, bench, film, hashes, window};
use indicatif::{ProgressBar, ProgressStyle};

/// All that the engines can do: in a window, or, with options, as films and tables.
#[derive(Debug, Parser)]
#[command(name = "gallery")]
struct Arguments {
    /// The scene to begin with, by its name, or a file: a recording, or JSON in the format of the tests
    scene: Option<String>,
    /// Shows another recording beside that of `scene` or `--headless`, and says where the two runs part
    #[arg(long, value_name = "FILE")]
    compare: Option<PathBuf>,
    /// The step of a recording to begin with
    #[arg(long, default_value_t = 0)]
    step: usize,
    /// Lists the scenes
    #[arg(long)]
    list: bool,
    /// Films a scene (a name or a file) without a window
    #[arg(long, value_name = "SCENE")]
    headless: Option<String>,
    /// Simulated seconds of a film, or of each scene with --bench
    #[arg(long, default_value_t = 8.0)]
    seconds: f32,
    /// Where the film goes: an animated PNG, and a page of stills beside it
    #[arg(long, value_name = "FILE")]
    out: Option<PathBuf>,
    /// Largest side of a film in px
    #[arg(long, default_value_t = 960, value_name = "PX")]
    size: u32,
    /// Shows outlines, boxes, contacts, islands, sleep and joints in a film
    #[arg(long)]
    debug: bool,
    /// Steps all scenes and prints what that takes
    #[arg(long)]
    bench: bool,
    /// Opens the window for so many seconds and prints how long its last frames took
    #[arg(long, value_name = "SECONDS")]
    times: Option<f64>,
    /// How many samples of each px the window's edges are smoothed with: 1 is fastest without a graphics card
    #[arg(long, default_value_t = 4, value_parser = clap::value_parser!(i32).range(1..=16))]
    samples: i32,
    /// Prints hashes of all scenes after 600 steps
    #[arg(long)]
    hashes: bool,
    /// Writes a picture of each scene and a list of them, for a page
    #[arg(long, value_name = "FOLDER")]
    pictures: Option<PathBuf>,
}

/// Runs the program with the options of the command line.
pub(crate) fn run() -> ExitCode {
    match obey(&Arguments::parse()) {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) => {
            eprintln!("gallery: {error}");
            ExitCode::FAILURE
        }
    }
}

fn obey(arguments: &Arguments) -> Result<()> {
    let all = scenes();
    if arguments.list {
        return list(&all);
    }
    if let Some(name) = &arguments.headless {
        return film_scene(arguments, &chosen(all, name, arguments)?);
    }
    if arguments.bench {
        return bench_all(&all, arguments.seconds);
    }
    if arguments.hashes {
        return print_hashes(&all);
    }
    if let Some(folder) = &arguments.pictures {
        return write_pictures(&all, folder);
    }
    open_window(all, arguments)
}

fn open_window(mut all: Vec<GalleryScene>, arguments: &Arguments) -> Result<()> {
    let first = match arguments.scene.as_deref() {
        None => 0,
        Some(name) => match all.iter().position(|scene| scene.name == name) {
            Some(at) => at,
            None => {
                all.push(chosen(Vec::new(), name, arguments)?);
                all.len() - 1
            }
        },
    };
    window::open(all, first, arguments.times, arguments.samples);
    Ok(())
}

/// A scene by its name, from a file, or from one or two recordings.
fn chosen(all: Vec<GalleryScene>, name: &str, arguments: &Arguments) -> Result<GalleryScene> {
    let is_run = std::fs::read(name).is_ok_and(|bytes| is_recording(&bytes));
    if !is_run {
        return match arguments.compare {
            Some(_) => Err(format!("{name} is no recording, which can be compared with another").into()),
            None => find(all, name),
        };
    }
    let files = [PathBuf::from(name)].into_iter().chain(arguments.compare.clone());
    let runs = files.map(|file| Ok(Recording::from_bytes(&std::fs::read(file)?)?)).collect::<Result<_>>()?;
    let stem = PathBuf::from(name).file_stem().map_or_else(String::new, |stem| stem.to_string_lossy().into());
    let scene = GalleryScene::from_recordings(&stem, runs, arguments.step)?;
    println!("{}", scene.about);
    Ok(scene)
}

/// A scene by its name, or from a file.
fn find(all: Vec<GalleryScene>, name: &str) -> Result<GalleryScene> {
    if let Some(scene) = all.into_iter().find(|scene| scene.name == name) {
        return Ok(scene);
    }
    let path = PathBuf::from(name);
    if !path.exists() {
        return Err(format!("{name} is neither a scene (--list lists them) nor a file").into());
    }
    GalleryScene::from_file(&path)
}

fn list(all: &[GalleryScene]) -> Result<()> {
    let widest = all.iter().map(|scene| scene.name.len()).max().unwrap_or(0);
    print(
        &all.iter()
            .map(|scene| format!("{:widest$}  {}: {}", scene.name, scene.title, scene.about))
            .collect::<Vec<_>>(),
    );
    Ok(())
}

fn film_scene(arguments: &Arguments, scene: &GalleryScene) -> Result<()> {
    let out = arguments.out.clone().unwrap_or_else(|| format!("target/gallery/{}.png", scene.name).into());
    let all = arguments.debug;
    let layers = Layers { outlines: all, boxes: all, contacts: all, islands: all, sleep: all, joints: all };
    let bar = bar(0, &scene.title);
    let film = Film { seconds: arguments.seconds, out, largest: arguments.size, layers };
    let filmed = film.film(scene, |done, frames| {
        bar.set_length(u64::from(frames));
        bar.set_position(u64::from(done));
    })?;
    bar.finish_and_clear();
    println!("animation: {}\nstills:    {}", filmed.animation.display(), filmed.stills.display());
    Ok(())
}

fn bench_all(all: &[GalleryScene], seconds: f32) -> Result<()> {
    let figures = with_progress(all, |scene| bench::bench(scene, seconds))?;
    println!(
        "{:22} {:>7} {:>10} {:>17} {:>12}",
        "scene", "bodies", "ms/step", "steps, ms/frame", "ms/picture"
    );
    for bench::Figures { name, bodies, step, frame, picture } in figures {
        println!("{name:22} {bodies:7} {step:10.3} {frame:17.3} {picture:12.2}");
    }
    Ok(())
}

fn print_hashes(all: &[GalleryScene]) -> Result<()> {
    let lines = with_progress(all, |scene| {
        let hashed = hashes::of(scene)?;
        Ok(hashed.iter().enumerate().map(|(half, hashed)| hashed.line(&scene.name, half)).collect::<Vec<_>>())
    })?;
    print(&lines.concat());
    Ok(())
}

fn write_pictures(all: &[GalleryScene], folder: &std::path::Path) -> Result<()> {
    with_progress(all, |scene| {
        let picture = film::picture(scene, 2.5, 320)?;
        Ok(picture.save_png(folder.join(format!("{}.png", scene.name)))?)
    })?;
    let text = |text: &str| format!("{text:?}");
    let entry = |scene: &GalleryScene| {
        let [name, title, about] = [&scene.name, &scene.title, &scene.about].map(|of| text(of));
        format!("  {{\"name\": {name}, \"title\": {title}, \"about\": {about}}}")
    };
    let entries: Vec<String> = all.iter().map(entry).collect();
    std::fs::write(folder.join("scenes.json"), format!("[\n{}\n]\n", entries.join(",\n")))?;
    Ok(())
}

/// Calls a function with each scene, and prints the progress.
fn with_progress<T>(
    all: &[GalleryScene],
    mut work: impl FnMut(&GalleryScene) -> Result<T>,
) -> Result<Vec<T>> {
    let bar = bar(all.len(), "");
    let done = all
        .iter()
        .map(|scene| {
            bar.set_message(scene.name.clone());
            let done = work(scene);
            bar.inc(1);
            done
        })
        .collect();
    bar.finish_and_clear();
    done
}

fn bar(length: usize, message: &str) -> ProgressBar {
    let style = ProgressStyle::with_template("{wide_bar} {pos}/{len}, {eta} left: {msg}");
    // Without it a bar of the usual style does as well.
    let style = style.unwrap_or_else(|_| ProgressStyle::default_bar());
    ProgressBar::new(length as u64).with_style(style).with_message(message.to_owned())
}

fn print(lines: &[String]) {
    lines.iter().for_each(|line| println!("{line}"));
}
