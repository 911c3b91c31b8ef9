//! Subjects of the program `fuzz`: properties that it tests.

use crate::checks::{failed_calls_change_nothing, numbers_are_finite};
use crate::churn::{DepthChurn, PlaneChurn};
use crate::figures::figures_hold;
use crate::game::Game;
use crate::saves::{SaveOutcome, altered_json, altered_snapshot};
use crate::scene_texts::altered_scene;
use crate::scenes::methods;
use crate::small::small_scene_holds;
use crate::soak::does_not_grow;
use crate::textures::outlines_of_a_picture;
use crate::twins::twins_stay_equal;
use crate::{CalmDepth, CalmPlane, Depth, OneWayPlane, Plane, StagedPlane, SurfacePlane, Tied, Upright};

/// A property that `fuzz` tests for one seed after the other.
#[derive(Debug, Clone, Copy)]
pub struct Subject {
    /// Name of the property on the command line.
    pub name: &'static str,
    /// Description of the property in the help text.
    pub about: &'static str,
    /// Function that checks the property for a seed. The error says how it is violated.
    pub check: fn(u64) -> Result<(), String>,
}

/// All properties that `fuzz` can test.
pub const SUBJECTS: &[Subject] = &[
    Subject { name: "plane", about: "random calls of the 2D engine, and its twins", check: game::<Plane> },
    Subject { name: "depth", about: "random calls of the 2.5D engine, and its twins", check: game::<Depth> },
    Subject {
        name: "tied",
        about: "random calls of the 2.5D engine with joints, springs, ropes and fields, and its twins",
        check: game::<Tied>,
    },
    Subject {
        name: "upright",
        about: "random calls of the 2.5D engine with what stands upright and platforms that turn, and its twins",
        check: game::<Upright>,
    },
    Subject {
        name: "stages",
        about: "stages of the 2D engine in any order",
        check: numbers_are_finite::<StagedPlane>,
    },
    Subject {
        name: "one-way",
        about: "random calls of the 2D engine with one-way geoms, and its twins",
        check: game::<OneWayPlane>,
    },
    Subject {
        name: "surfaces",
        about: "random calls of the 2D engine with round and thin shapes and surfaces of all kinds, and its twins",
        check: game::<SurfacePlane>,
    },
    Subject {
        name: "calm",
        about: "the 2D engine with what rests, sleeps, is shot and tied, of any mass, and its twins",
        check: game::<CalmPlane>,
    },
    Subject {
        name: "calm-upright",
        about: "the 2.5D engine with what rests, rides and is slow, amid what stands upright, and its twins",
        check: game::<CalmDepth<Upright>>,
    },
    Subject {
        name: "calm-tied",
        about: "the 2.5D engine with what rests, rides and is slow, amid joints, ropes and fields, and its twins",
        check: game::<CalmDepth<Tied>>,
    },
    Subject {
        name: "saves",
        about: "altered snapshots of the 2D engine, used",
        check: |seed| altered_snapshot::<Plane>(seed).map(ignore),
    },
    Subject {
        name: "json",
        about: "altered JSON of the 2D engine, used",
        check: |seed| altered_json::<Plane>(seed).map(ignore),
    },
    Subject {
        name: "depth-saves",
        about: "altered snapshots of the 2.5D engine, used",
        check: |seed| altered_snapshot::<Depth>(seed).map(ignore),
    },
    Subject {
        name: "depth-json",
        about: "altered JSON of the 2.5D engine, used",
        check: |seed| altered_json::<Depth>(seed).map(ignore),
    },
    Subject { name: "textures", about: "outlines of random pictures", check: outlines_of_a_picture },
    Subject { name: "scenes", about: "altered scenes of the recorded runs", check: altered_scene },
    Subject { name: "small", about: "small scenes of the precise set", check: small_scene_holds },
    Subject { name: "figures", about: "random joint scenes of the precise set", check: figures_hold },
    Subject { name: "soak", about: "a million updates of one set of methods, seeds 0 to 4", check: soak },
    Subject {
        name: "depth-soak",
        about: "a million updates of the 2.5D engine, in which all that it has comes and goes",
        check: soak_in_depth,
    },
];

fn ignore(_: SaveOutcome) {}

fn game<G: Game>(seed: u64) -> Result<(), String> {
    failed_calls_change_nothing::<G>(seed)?;
    numbers_are_finite::<G>(seed)?;
    twins_stay_equal::<G>(seed)
}

/// Number of updates of a long run.
const SOAK: usize = 1_000_000;

fn soak(seed: u64) -> Result<(), String> {
    let methods = methods().nth(seed as usize % methods().count()).ok_or("there are none")?;
    let mut churn = PlaneChurn::new(methods).map_err(|error| error.to_string())?;
    does_not_grow(&mut churn, SOAK)
}

fn soak_in_depth(seed: u64) -> Result<(), String> {
    let mut churn = DepthChurn::new(seed).map_err(|error| error.to_string())?;
    does_not_grow(&mut churn, SOAK)
}
