//! Scenes in engines: those of this workspace, and behind the feature `peers` those of others.

pub mod depth;
#[cfg(feature = "peers")]
pub mod peers_2d;
pub mod plane;
#[cfg(feature = "peers")]
pub mod rapier3d;

/// An angle between -pi and pi.
fn wrapped(angle: f64) -> f64 {
    angle - std::f64::consts::TAU * (angle / std::f64::consts::TAU).round()
}
