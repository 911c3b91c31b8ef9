//! Peak memory of a scene in an engine, by the counters of Linux. It can be measured only in a process of its own.

use super::engine::{EngineEntry, Result};
use super::play::Play;
use super::scenes::SceneEntry;
use crate::csv::rows;
use serde::{Deserialize, Serialize};
use std::fs;

/// Figures of the memory of a scene: one line of the table. `bytes_per_body` is the peak of the resident memory that the engine
/// adds during the run, divided by the number of bodies at the end.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[expect(missing_docs, reason = "see above")]
pub struct MemoryFigures {
    pub scene: String,
    pub size: f32,
    pub engine: String,
    pub bodies: usize,
    pub bytes_per_body: f64,
}

/// Plays at most `steps` steps of a scene and returns its figures. This process must not have played anything before.
///
/// # Errors
/// The engine refuses a body, a joint or a step, or the system has no `/proc/self/status`.
pub fn memory_figures(
    entry: &SceneEntry,
    size: f32,
    engine: EngineEntry,
    steps: usize,
) -> Result<MemoryFigures> {
    let scene = (entry.build)(size);
    // The scene is copied while it is built; these copies are not the engine's.
    let alone = kilobytes("VmRSS:")?;
    let copies = std::hint::black_box((scene.bodies.clone(), scene.joints.clone()));
    let copied = kilobytes("VmRSS:")? - alone;
    let before = kilobytes("VmRSS:")?;
    let mut play = Play::new(&scene, engine)?;
    for _ in 0..steps.min(scene.steps) {
        play.step()?;
    }
    let bodies = play.bodies.iter().flatten().count();
    let peak = kilobytes("VmHWM:")?.max(kilobytes("VmRSS:")?) - before;
    drop(copies);
    let bytes_per_body = (1024.0 * (peak - copied) / bodies as f64).round();
    Ok(MemoryFigures {
        scene: entry.name.to_owned(),
        size,
        engine: engine.name.to_owned(),
        bodies,
        bytes_per_body,
    })
}

/// Returns a counter of the memory of this process in kB.
fn kilobytes(name: &str) -> Result<f64> {
    let status = fs::read_to_string("/proc/self/status")?;
    let line = status.lines().find_map(|line| line.strip_prefix(name)).ok_or("no counter of memory")?;
    Ok(line.trim().trim_end_matches(" kB").parse()?)
}

/// Reads the rows of a table of memory.
///
/// # Errors
/// The first fault of the table.
pub fn read_memory(text: &str) -> std::result::Result<Vec<MemoryFigures>, String> {
    rows(text)
}
