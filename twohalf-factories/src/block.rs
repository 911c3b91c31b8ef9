//! Level platforms by their ends.

use twohalf::farseer_core::Error;
use twohalf::{Platform, PlatformId, Result, TwoHalfPhysicsSimulator, Vector3};

/// Adds a level platform from the least to the greatest X, Y (up) and Z, px.
///
/// ```
/// # use twohalf::{TwoHalfPhysicsSimulator, Vector2, Vector3};
/// # use twohalf_factories::spawn_block;
/// # let mut simulator = TwoHalfPhysicsSimulator::with_gravity(480, Vector2::new(0.0, 900.0))?;
/// // A street of 40 px above the ground, with a hole of 80 px.
/// spawn_block(&mut simulator, [0.0, 560.0], [0.0, 40.0], [10.0, 150.0])?;
/// let beyond = spawn_block(&mut simulator, [640.0, 900.0], [0.0, 40.0], [10.0, 150.0])?;
/// let beyond = simulator.platform(beyond).unwrap();
/// assert_eq!(beyond.position3d(), Vector3::new(770.0, 0.0, 80.0));
/// assert_eq!((beyond.width(), beyond.height(), beyond.depth()), (260.0, 40.0, 140.0));
/// # Ok::<(), twohalf::Error>(())
/// ```
///
/// # Errors
/// Ends that are not finite, or of which the first is not less than the second. A failed call adds nothing.
pub fn spawn_block(
    simulator: &mut TwoHalfPhysicsSimulator,
    x: [f32; 2],
    y: [f32; 2],
    z: [f32; 2],
) -> Result<PlatformId> {
    for (argument, [low, high]) in [("x", x), ("y", y), ("z", z)] {
        if !((high - low).is_finite() && low < high) {
            Err(Error::invalid(argument, [low, high], "finite, the first less than the second"))?;
        }
    }
    let middle = |[low, high]: [f32; 2]| low + 0.5 * (high - low);
    let place = Vector3::new(middle(x), y[0], middle(z));
    Platform::new(simulator, x[1] - x[0], y[1] - y[0], z[1] - z[0], place, None)
}
