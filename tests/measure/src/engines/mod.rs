//! Runs scenes in engines: those of this workspace and, behind the feature `peers`, those of other projects.

pub mod depth;
#[cfg(feature = "peers")]
pub mod peers_2d;
pub mod plane;
#[cfg(feature = "peers")]
pub mod rapier3d;

/// Returns the angle, in radians, reduced by full turns to -pi..=pi.
fn wrapped(angle: f64) -> f64 {
    angle - std::f64::consts::TAU * (angle / std::f64::consts::TAU).round()
}
