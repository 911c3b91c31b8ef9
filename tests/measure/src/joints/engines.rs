//! The engines that play joint scenes.

use super::assembly::Assembly;
use super::build::build_ours;
#[cfg(feature = "peers")]
use crate::engines::peers_2d::{assemble_box2d, assemble_rapier};
use crate::method::{Built, Family, Setting};

/// The recommendation of the authors of all three engines: updates of 1/60 s with 4 substeps.
pub const SETTING: Setting = Setting::fixed(1.0 / 60.0, 4);

/// An engine.
#[derive(Debug, Clone, Copy)]
pub struct Engine {
    /// Its name in tables.
    pub name: &'static str,
    /// Its project.
    pub family: Family,
    /// Builds a scene that is awake throughout.
    pub build: fn(&Assembly, Setting) -> Built,
}

/// The engine of this workspace with the precise set.
pub const OURS: Engine = Engine { name: "Precise", family: Family::Ours, build: build_ours };

/// All engines, ours first. Without the feature `peers` there are no others.
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
