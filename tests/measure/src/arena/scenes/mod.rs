//! The ten scenes of Box2D's benchmark (E. Catto, Box2D 3, `shared/benchmarks.c`), at any size.
//!
//! A size is a fraction of the number of bodies in the release benchmark, dimensionless, > 0: 1 for all of them. Counts
//! along a side, and lengths of containers, are proportional to the square root of the size.

mod drums;
mod heaps;
mod net;
mod pyramids;
pub(super) mod rain;
mod worlds;

use super::scene::{Body, Kind, Limits, Scene, Shape};

/// A scene of the arena, which can be built at any size.
#[derive(Debug, Clone, Copy)]
pub struct SceneEntry {
    /// Name of the scene in Box2D's benchmark.
    pub name: &'static str,
    /// Description of the scene in one sentence.
    pub about: &'static str,
    /// Builds the scene at a size.
    pub build: fn(f32) -> Scene,
}

/// Returns all scenes of the arena.
pub fn scenes() -> [SceneEntry; 10] {
    let entry = |name, about, build| SceneEntry { name, about, build };
    [
        entry("large_pyramid", "One pyramid of boxes of 1 m, base 100.", pyramids::large),
        entry("many_pyramids", "20 shelves with 20 pyramids of base 10 each.", pyramids::many),
        entry("junkyard", "Pentagons fall into a yard, and a kinematic wall stirs them.", heaps::junkyard),
        entry("tumbler", "Boxes in a square drum that a motor turns.", drums::tumbler),
        entry("rain", "Ragdolls fall on five floors, and the oldest go.", rain::rain),
        entry("washer", "Boxes in a kinematic round drum with ribs.", drums::washer),
        entry(
            "joint_grid",
            "A net of discs on hinges, held at the middle of its upper side.",
            net::joint_grid,
        ),
        entry("smash", "A heavy box flies into a wall of boxes without gravity.", heaps::smash),
        entry("compounds", "Bodies of two triangles each fall into a silo.", heaps::compounds),
        entry(
            "spinner",
            "A motor turns a blade among discs, capsules and boxes in a round room.",
            drums::spinner,
        ),
    ]
}

/// Returns the large worlds, which are none of Box2D's benchmark. They have 100,000 bodies at size 1.
pub fn worlds() -> [SceneEntry; 2] {
    let entry = |name, about, build| SceneEntry { name, about, build };
    [
        entry(
            "falling_pile",
            "Boxes, discs and capsules fall into a bin, 40 above each other.",
            worlds::pile,
        ),
        entry("sleeping_stacks", "Stacks of ten boxes apart from each other fall asleep.", worlds::stacks),
    ]
}

/// Returns a world of static tiles without dynamic bodies, 100,000 bodies at size 1.
pub fn tiles() -> SceneEntry {
    SceneEntry { name: "tiles", about: "Static tiles, each a body, in 50 rows.", build: worlds::tiles }
}

/// Returns the count `full` of the release benchmark multiplied by `scale`, rounded, and at least 1.
fn count(full: usize, scale: f32) -> usize {
    ((full as f32 * scale).round() as usize).max(1)
}

/// Returns the speed in m/s of a body that has fallen from `height` m.
fn fall_speed(height: f32) -> f32 {
    (20.0 * height).sqrt()
}

/// Returns a static yard of boxes 1 m apart. Its floor reaches from `-half` to `half` m along x, with its middle at y = 0.
/// At each end is a wall of `height` boxes.
fn yard(half: i32, height: usize) -> Vec<Shape> {
    let floor = (-half..=half).map(|x| Shape::rectangle([0.55, 0.5], [x as f32, 0.0]));
    let walls = [-half, half]
        .into_iter()
        .flat_map(|x| (1..=height).map(move |y| Shape::rectangle([0.5, 0.55], [x as f32, y as f32])));
    floor.chain(walls).collect()
}

/// Creates a static body at the origin.
fn ground(shapes: Vec<Shape>) -> Body {
    Body::immovable(Kind::Static, [0.0; 2], shapes)
}

/// Returns limits for scenes without joints: bounds in m, greatest speed in m/s, deepest overlap in m.
fn limits(bounds: [[f32; 2]; 2], speed: f32, overlap: f32) -> Limits {
    Limits { bounds: Some(bounds), speed, overlap, gap: 0.0 }
}
