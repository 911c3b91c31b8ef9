//! Runs the arena: scenes of Box2D's benchmark, large worlds, queries and changes at several sizes, or random scenes.
//!
//! `cargo run --release --features peers --example arena` prints tables and writes them, charts and a report to `target/arena`.
//! Without the feature our engine plays alone. `--quick` plays sizes 1/16 and 1/4. `--random 1 --count 200` plays 200 random
//! scenes instead and tells in which of them our engine does worse than the peers. Times hold for the machine that measured
//! them; only ratios of one run may be quoted.

use clap::{Parser, ValueEnum};
use drawing::arena::{self, Tables};
use drawing::measuring::Result;
use measure::arena::changes::change_figures;
use measure::arena::memory::{MemoryFigures, memory_figures};
use measure::arena::queries::query_figures;
use measure::arena::random::flags::{Flagged, flags, summary};
use measure::arena::random::{play, random_scene};
use measure::arena::run::{Effort, RunFigures, arena_csv, run};
use measure::arena::{EngineEntry, SceneEntry, engines, scenes, worlds};
use measure::method::peer_versions;
use measure::origin::{origin, origin_csv};
use measure::shard::Shard;
use std::path::PathBuf;
use std::process::Command;
use std::{env, fs};

/// Most steps of a run that measures memory; peaks come early.
const MEMORY_STEPS: usize = 350;

/// A part of the arena.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
enum Part {
    /// The ten scenes of Box2D's benchmark.
    Scenes,
    /// The falling pile and the sleeping stacks.
    Worlds,
    /// Rays and boxes in large worlds.
    Queries,
    /// A body that comes and goes among static tiles.
    Changes,
    /// Peak memory, each run in a process of its own.
    Memory,
}

/// Plays scenes of the arena.
#[derive(Debug, Parser)]
struct Arguments {
    /// Sizes 1/16 and 1/4 alone.
    #[arg(long, conflicts_with = "sizes")]
    quick: bool,
    /// Sizes in ascending order, as shares of the release benchmark's number of bodies, or of 100,000 in large worlds.
    #[arg(long, value_name = "SHARE", num_args = 1.., default_values_t = [0.0625, 0.25, 1.0])]
    sizes: Vec<f32>,
    /// Only these parts.
    #[arg(long, value_name = "PART", num_args = 1..)]
    parts: Vec<Part>,
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
    /// Random scenes of these seeds instead.
    #[arg(long, value_name = "SEED", num_args = 1..)]
    random: Vec<u64>,
    /// Number of seeds from each given one on.
    #[arg(long, default_value_t = 1)]
    count: u64,
    /// Only one of several shards of the seeds, such as 3/16.
    #[arg(long, value_name = "PART")]
    shard: Option<Shard>,
    /// Where to write.
    #[arg(long, value_name = "DIR", default_value = "target/arena")]
    out: PathBuf,
    /// Only prints the memory of one scene in one engine.
    #[arg(long, hide = true)]
    memory_alone: bool,
}

fn main() -> Result<()> {
    let arguments = Arguments::parse();
    if arguments.memory_alone {
        return memory_alone(&arguments);
    }
    // The program makes the output folder before the first run, so that it does not measure results it cannot write.
    let out = &arguments.out;
    fs::create_dir_all(out).map_err(|error| format!("cannot write to {}: {error}", out.display()))?;
    if !arguments.random.is_empty() {
        return random_scenes(&arguments);
    }
    let mut tables = Tables { origin: origin(peer_versions()), ..Tables::default() };
    tables.runs = runs(&arguments)?;
    let (bodies, queries) = if arguments.quick { (5_000, 2_000) } else { (20_000, 10_000) };
    if arguments.plays(Part::Queries) {
        tables.queries = query_figures(bodies, queries, &arguments.engines())?;
    }
    if arguments.plays(Part::Changes) {
        tables.changes = change_figures(20_000, &arguments.engines())?;
    }
    if arguments.plays(Part::Memory) {
        tables.memory = memory(&arguments)?;
    }
    print!("{}", arena::write(&tables, out)?);
    Ok(())
}

impl Arguments {
    fn plays(&self, part: Part) -> bool {
        self.parts.is_empty() || self.parts.contains(&part)
    }

    fn engines(&self) -> Vec<EngineEntry> {
        let is_chosen =
            |engine: &EngineEntry| engine.name.to_lowercase().contains(&self.engine.to_lowercase());
        engines().into_iter().filter(is_chosen).collect()
    }

    fn sizes(&self) -> &[f32] {
        if self.quick { &[0.0625, 0.25] } else { &self.sizes }
    }

    fn scenes(&self) -> Vec<SceneEntry> {
        let of = |part, entries: Vec<SceneEntry>| if self.plays(part) { entries } else { Vec::new() };
        let mut chosen = of(Part::Scenes, scenes().to_vec());
        chosen.extend(of(Part::Worlds, worlds().to_vec()));
        chosen.retain(|scene| scene.name.contains(&self.scene));
        chosen
    }
}

fn runs(arguments: &Arguments) -> Result<Vec<RunFigures>> {
    let effort = Effort { turns: arguments.turns as usize, budget: arguments.budget };
    let mut runs = Vec::new();
    for scene in arguments.scenes() {
        eprintln!("{}: {}", scene.name, scene.about);
        for &size in arguments.sizes() {
            runs.extend(run(&scene, size, &arguments.engines(), effort)?);
        }
    }
    Ok(runs)
}

/// Measures the memory of each scene at the first size in each engine, in processes of their own.
fn memory(arguments: &Arguments) -> Result<Vec<MemoryFigures>> {
    let mut figures = Vec::new();
    let size = arguments.sizes().first().copied().unwrap_or(1.0);
    for scene in scenes().into_iter().chain(worlds()).filter(|scene| scene.name.contains(&arguments.scene)) {
        for engine in arguments.engines() {
            let mut command = Command::new(env::current_exe()?);
            command.args(["--memory-alone", "--scene", scene.name, "--engine", engine.name]);
            let output = command.args(["--sizes", &size.to_string()]).output()?;
            figures.extend(arena::memory_rows(&String::from_utf8(output.stdout)?)?);
        }
    }
    Ok(figures)
}

fn memory_alone(arguments: &Arguments) -> Result<()> {
    let scene = scenes().into_iter().chain(worlds()).find(|scene| scene.name == arguments.scene);
    let (Some(scene), Some(&engine)) = (scene, arguments.engines().first()) else {
        return Err("no such scene or engine".into());
    };
    let figures = memory_figures(&scene, arguments.sizes()[0], engine, MEMORY_STEPS)?;
    print!("{}", arena_csv(&[figures]));
    Ok(())
}

fn random_scenes(arguments: &Arguments) -> Result<()> {
    let seeds = arguments.random.iter().flat_map(|&seed| seed..seed.saturating_add(arguments.count));
    let seeds: Vec<u64> = seeds.collect();
    // The number of bodies is known only when a scene is built, so that seeds count alike.
    let picks = arguments.shard.unwrap_or(Shard::WHOLE).picks(&vec![1.0; seeds.len()]);
    let seeds = seeds.into_iter().zip(picks).filter(|(_, is_picked)| *is_picked).map(|(seed, _)| seed);
    let effort = play::Effort { turns: arguments.turns as usize, budget: arguments.budget };
    let (mut figures, mut flagged) = (Vec::new(), Vec::<Flagged>::new());
    for seed in seeds {
        let scene = random_scene(seed);
        let played = play::play(&scene, &arguments.engines(), effort);
        let result = flags(&scene, &played);
        if !result.flags.is_empty() || arguments.random.len() as u64 * arguments.count < 20 {
            eprintln!("{}", arena_csv(&[&result]).lines().last().unwrap_or_default());
        }
        flagged.push(result);
        figures.extend(played);
    }
    let name = |name: &str| match arguments.shard {
        Some(shard) => arguments.out.join(format!("{name}.{shard}.csv")),
        None => arguments.out.join(format!("{name}.csv")),
    };
    fs::write(name("random"), arena_csv(&figures))?;
    fs::write(name("flags"), arena_csv(&flagged))?;
    fs::write(name("random_origin"), origin_csv(&origin(peer_versions())))?;
    print!("{}", summary(&flagged));
    Ok(())
}
