//! The original's sample scenes (behaviour chapter 16), one function for each: tests and examples build the same.
//!
//! One unit is one px of a screen of 1024 by 768, y down; s, rad. A scene is stepped as it was recorded: with the input
//! of the table in part E of the chapter, and no other.

mod advanced;
mod agent;
mod blasts;
mod blocks;
mod border;
mod circles;
mod drive;
mod link_factory;
mod linked;
mod outlines;
mod pair;
mod ragdoll;
mod scene;
mod simple;
mod spider;
mod splats;
mod springs;
mod springs_scene;
mod table;
mod water;

pub use agent::Agent;
pub use blasts::{Grenade, HairDryer};
pub use blocks::{Pyramid, ball, crate_box, pyramid, rectangle_platform};
pub use border::border;
pub use circles::{Circles, circles};
pub use drive::{AngularDrive, Drive};
pub use outlines::{map_outline, splat_outline};
pub use ragdoll::ragdoll;
pub use scene::{Actor, CopyActor, Figure, Look, SampleScene};
pub use spider::Spider;
pub use springs::{Lever, Rope, Side};
pub use table::{Table, table};
pub use water::wave_of;

use farseer_core::Result;
use farseer_core::math::Vector2;

/// Width and height of the screen in px.
pub const SCREEN: [f32; 2] = [1024.0, 768.0];
/// Middle of the screen.
pub const CENTRE: Vector2 = Vector2::new(512.0, 384.0);

/// Red, green, blue, alpha.
pub type Rgba = [u8; 4];
/// Behind everything: steel blue.
pub const BACKGROUND: Rgba = [70, 130, 180, 255];
const WHITE: Rgba = [255, 255, 255, 255];
const BLACK: Rgba = [0, 0, 0, 255];
const GOLD: Rgba = [255, 215, 0, 255];

/// Length of a step in s: ten times 0.001, one bit more than 0.01.
pub const DT: f32 = 10.0 * 0.001;

/// A sample scene.
#[derive(Debug, Clone, Copy)]
pub struct Sample {
    /// Name, as in the chapter.
    pub name: &'static str,
    /// Builds it as it is before its first step.
    pub build: fn() -> Result<SampleScene>,
}

/// All samples that can be reproduced, in the order of the chapter.
pub const SAMPLES: &[Sample] = &[
    Sample { name: "Simple 1", build: simple::a_single_body },
    Sample { name: "Simple 2", build: pair::two_bodies_with_geom },
    Sample { name: "Simple 3", build: simple::multiple_geometries_and_static_bodies },
    Sample { name: "Simple 4", build: simple::stacked_objects },
    Sample { name: "Simple 5", build: circles::collision_categories },
    Sample { name: "Simple 6", build: springs_scene::linear_and_angular_springs },
    Sample { name: "Simple 7", build: spider::dynamic_angle_joints },
    Sample { name: "Simple 8", build: circles::broad_phase_collision_stress_test },
    Sample { name: "Simple 9", build: ragdoll::ragdoll_scene },
    Sample { name: "Simple 10", build: linked::weld_joint_and_gears },
    Sample { name: "Advanced 2", build: advanced::inactivity_controller },
    Sample { name: "Advanced 3", build: advanced::map_vertices_from_textures },
    Sample { name: "Advanced 4", build: link_factory::chains_factory },
    Sample { name: "Advanced 5", build: link_factory::path_factory },
    Sample { name: "Advanced 6", build: blasts::wind_and_explosions },
    Sample { name: "Advanced 8", build: pair::line_intersections },
    Sample { name: "Advanced 9", build: splats::auto_divide_geometry_with_sat },
    Sample { name: "Water", build: water::water },
];

/// The sample of this name.
pub fn sample(name: &str) -> Option<&'static Sample> {
    SAMPLES.iter().find(|sample| sample.name == name)
}
