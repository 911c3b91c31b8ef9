//! Engines in which joint scenes are run.

use super::assembly::Assembly;
use super::build::build_ours;
#[cfg(feature = "peers")]
use crate::engines::peers_2d::{assemble_box2d, assemble_rapier};
use crate::method::{Built, Family, Setting};

/// Setting of all runs, recommended by the authors of all three engines: time step 1/60 s with 4 substeps.
pub const SETTING: Setting = Setting::fixed(1.0 / 60.0, 4);

/// An engine in which joint scenes are run.
#[derive(Debug, Clone, Copy)]
pub struct Engine {
    /// Name of the engine in tables.
    pub name: &'static str,
    /// Origin of the engine: this workspace or another project.
    pub family: Family,
    /// Builds the world of a scene, with sleep disabled.
    pub build: fn(&Assembly, Setting) -> Built,
}

/// Our engine: the 2D engine of this workspace with the precise set.
pub const OURS: Engine = Engine { name: "Precise", family: Family::Ours, build: build_ours };

/// Returns all engines, ours first. Without the feature `peers` it is the only one.
pub fn engines() -> Vec<Engine> {
    #[allow(unused_mut)]
    let mut engines = vec![OURS];
    #[cfg(feature = "peers")]
    engines.extend([
        Engine { name: "Box2D 3", family: Family::Peer, build: assemble_box2d },
        Engine { name: "rapier2d", family: Family::Peer, build: assemble_rapier },
    ]);
    engines
}
