//! Other projects' 2D engines: `rapier2d`, and Box2D 3 through the crate `boxdd`.
//!
//! A scene means the same in them as in the engine of this workspace:
//!
//! - 32 px are one metre, which is what both engines are tuned for; lengths are scaled on the way in and out (by a
//!   power of two, so exactly). y points down as in the scene. Masses and moments of inertia are those of the scene's
//!   bodies, whatever the geoms on them.
//! - Friction and restitution of a pair are the mean of both geoms', or the lesser friction where the scene says so.
//! - A linear drag c (a force of -c v, behaviour chapter 02) is the damping c / m, which is the same in the limit of
//!   short steps. Rotational drag is quadratic; it is applied as a torque before each step, unless it has the default
//!   0.001, which next to nothing feels: then there is none.
//! - Springs have the scene's stiffness and damping, whatever the engine wants them expressed in.
//!
//! What differs: circles are true circles and not polygons; outlines that are not convex are cut into pieces that are;
//! joints and contacts are as hard as the engine makes them, so that bias factors and allowed errors count for
//! nothing; angles between two bodies are told apart up to whole turns. Nothing sleeps unless it
//! is asked for. Continuous collision is as it
//! is by default: of fast bodies against static ones, in both. Both hold speeds down to 12,800 px/s, so scenes that
//! begin with more are refused, and Box2D bounces nothing that meets slower than 32 px/s.
//!
//! What an engine does not have is an error that says so.

mod assembly;
mod box2d;
mod links;
mod parts;
mod rapier;
mod state;

use super::plane::STEPS;
use crate::method::{Effort, Family, Mapped, Method, Setting, mapped};

pub use assembly::{assemble_box2d, assemble_rapier};
pub use box2d::build_box2d;
pub use rapier::build_rapier;

/// `rapier2d`, with its default of 4 solver iterations recommended. Each of them is a short step of its own.
pub fn rapier_methods() -> Vec<Method> {
    vec![Method {
        name: "rapier2d",
        family: Family::Peer,
        is_broad_phase_variant: false,
        sleeps: true,
        recommended: RECOMMENDED,
        settings,
        mapped: on_map,
        build: build_rapier,
    }]
}

/// Box2D 3, with the 4 substeps its manual recommends.
pub fn box2d_methods() -> Vec<Method> {
    vec![Method {
        name: "Box2D 3",
        family: Family::Peer,
        is_broad_phase_variant: false,
        sleeps: true,
        recommended: RECOMMENDED,
        settings,
        mapped: on_map,
        build: build_box2d,
    }]
}

/// Names and versions of the peers and of what they are reached through.
pub fn peer_versions() -> Vec<(&'static str, String)> {
    vec![
        ("rapier2d", rapier2d::VERSION.to_owned()),
        (
            "Box2D",
            format!(
                "{}, built from C with {}",
                box2d::version(),
                option_env!("CFLAGS").unwrap_or("no flags")
            ),
        ),
        ("boxdd", locked_version("boxdd")),
    ]
}

/// The version of a package that this was built with.
fn locked_version(package: &str) -> String {
    let lock = include_str!("../../../../../Cargo.lock");
    let name = format!("name = \"{package}\"");
    let version = lock.lines().skip_while(|line| *line != name).nth(1);
    version.map_or("unknown".to_owned(), |line| {
        line.trim_start_matches("version = ").trim_matches('"').to_owned()
    })
}

/// What both engines' authors recommend.
const RECOMMENDED: Setting = Setting::fixed(1.0 / 60.0, 4);

/// On a map as recommended, which is in the table of first failures, and with the other steps of ours.
fn on_map(effort: Effort) -> Vec<Mapped> {
    let others = if effort == Effort::Full { &STEPS[1..] } else { &STEPS[2..] };
    let others = others.iter().map(|&dt| Setting::fixed(dt, RECOMMENDED.passes));
    mapped([RECOMMENDED].into_iter().chain(others), &[RECOMMENDED])
}

/// Steps that games take, each with the recommended substeps; fewer and more substeps at the usual step and at longer
/// and shorter ones.
fn settings(effort: Effort) -> Vec<Setting> {
    let quick = vec![
        Setting::fixed(1.0 / 30.0, 1),
        Setting::fixed(1.0 / 30.0, 4),
        Setting::fixed(1.0 / 60.0, 1),
        RECOMMENDED,
        Setting::fixed(1.0 / 60.0, 16),
        Setting::fixed(1.0 / 240.0, 4),
        Setting::jitter(1.0 / 60.0, 4),
    ];
    if effort == Effort::Quick {
        return quick;
    }
    let full = [
        Setting::fixed(1.0 / 30.0, 2),
        Setting::fixed(1.0 / 60.0, 2),
        Setting::fixed(1.0 / 60.0, 8),
        Setting::fixed(0.016, 4),
        Setting::fixed(0.01, 4),
        Setting::fixed(1.0 / 120.0, 4),
        Setting::fixed(1.0 / 120.0, 16),
        Setting::fixed(1.0 / 240.0, 1),
        Setting::fixed(1.0 / 240.0, 16),
    ];
    quick.into_iter().chain(full).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_version_is_known() {
        for (name, version) in peer_versions() {
            assert!(version.starts_with(|digit: char| digit.is_ascii_digit()), "{name} {version}");
        }
    }
}
