//! 2D engines of other projects (peers): `rapier2d`, and Box2D 3 through the crate `boxdd`.
//!
//! A scene means the same in them as in the engine of this workspace:
//!
//! - 32 px are one metre, which is the scale both engines are tuned for. Lengths are scaled on the way in and out (by a power
//!   of two, so exactly). y points down as in the scene. Masses and moments of inertia are those of the scene's bodies, not of
//!   the geoms on them.
//! - Friction and restitution of a pair are the mean of both geoms', or the lesser friction where the scene says so.
//! - A linear drag c (a force of -c v, behaviour chapter 02) is the damping c / m, which is the same in the limit of short
//!   steps. Rotational drag is quadratic; it is applied as a torque before each step. The default of 0.001, which has next to
//!   no effect, is omitted.
//! - Springs have the scene's stiffness and damping, converted to the units of the engine.
//!
//! Differences:
//!
//! - Circles are true circles and not polygons; outlines that are not convex are cut into convex pieces.
//! - Joints and contacts are as hard as the engine makes them, so that bias factors and allowed errors have no effect.
//! - Angles between two bodies are known up to full turns.
//! - Sleep is disabled until it is enabled by the caller.
//! - Continuous collision is as it is by default: of fast bodies against static ones, in both.
//! - Both limit speeds to 12,800 px/s, so scenes with a faster start are refused. Box2D applies no restitution to impacts
//!   slower than 32 px/s.
//!
//! A feature that an engine lacks is an error that names it.

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

/// Returns the method `rapier2d`, with its default of 4 solver iterations recommended. Each iteration is a substep.
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

/// Returns the method Box2D 3, with the 4 substeps that the manual of Box2D recommends.
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

/// Returns names and versions of the peers and of the crates that bind them.
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

/// Returns the version of a package that this program was built with.
fn locked_version(package: &str) -> String {
    let lock = include_str!("../../../../../Cargo.lock");
    let name = format!("name = \"{package}\"");
    let version = lock.lines().skip_while(|line| *line != name).nth(1);
    version.map_or("unknown".to_owned(), |line| {
        line.trim_start_matches("version = ").trim_matches('"').to_owned()
    })
}

/// The setting that the authors of Box2D and rapier recommend: 1/60 s with 4 substeps.
const RECOMMENDED: Setting = Setting::fixed(1.0 / 60.0, 4);

/// Returns the columns of a stability map: the recommended setting, which the table of first failures shows, and the other step
/// lengths of our methods.
fn on_map(effort: Effort) -> Vec<Mapped> {
    let others = if effort == Effort::Full { &STEPS[1..] } else { &STEPS[2..] };
    let others = others.iter().map(|&dt| Setting::fixed(dt, RECOMMENDED.passes));
    mapped([RECOMMENDED].into_iter().chain(others), &[RECOMMENDED])
}

/// Returns the settings of a chart's line: steps that games take, each with the recommended 4 substeps. The usual step and some
/// longer and shorter steps have fewer and more substeps, too.
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
    fn the_version_of_every_peer_is_found() {
        for (name, version) in peer_versions() {
            assert!(version.starts_with(|digit: char| digit.is_ascii_digit()), "{name} {version}");
        }
    }
}
