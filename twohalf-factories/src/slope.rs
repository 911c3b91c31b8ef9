//! Slopes by the ends of their upper edge.

use twohalf::farseer_core::Error;
use twohalf::farseer_core::math::scalar;
use twohalf::{Platform, PlatformId, Result, TwoHalfPhysicsSimulator, Vector3};

/// Adds a slope whose upper edge runs between two points, X and Y up in px, the first to the left of the
/// second, from the first to the second Z, px. `thickness` is its extent below that edge, at right angles to
/// it, px. It has no friction until it is set. Its ends are square: below the higher point it overlaps the
/// platform there, the less the thinner it is. The `Scene` of `twohalf-render` draws the part above the lower
/// platform, a wedge.
///
/// If the higher point is at the edge and the height of a platform, there is neither gap nor step:
///
/// ```
/// # use twohalf::{Platform, TwoHalfPhysicsSimulator, Vector2, Vector3, CharacterSettings, CharacterController, MoveInput};
/// # use twohalf_factories::{Figure, spawn, spawn_slope};
/// # const STEP: f32 = 1.0 / 120.0;
/// # let mut simulator = TwoHalfPhysicsSimulator::with_gravity(480, Vector2::new(0.0, 900.0))?;
/// // A ledge that is 120 px high and ends at X = 400, and a way down from there.
/// Platform::new(&mut simulator, 400.0, 120.0, 100.0, Vector3::new(200.0, 0.0, 50.0), None)?;
/// spawn_slope(&mut simulator, [400.0, 120.0], [730.0, 0.0], [0.0, 100.0], 20.0)?;
/// let player = spawn(&mut simulator, Figure::new([30.0, 60.0, 20.0]).at([300.0, 120.0, 50.0]))?;
/// let mut walker = CharacterController::new(CharacterSettings::default());
/// for step in 0..240 {
///     let wish = MoveInput { x: 260.0, ..MoveInput::default() };
///     simulator.walk(player.body, &mut walker, wish, STEP)?;
///     simulator.update(STEP);
///     // It stands all the way.
///     assert!(walker.is_grounded() || step == 0);
/// }
/// let feet = simulator.body(player.body).unwrap().position3d();
/// assert!(feet.x > 745.0 && feet.y < 0.1);
/// # Ok::<(), twohalf::Error>(())
/// ```
///
/// # Errors
/// Numbers that are not finite, a first point or Z that is not less than the second, a thickness that is not
/// greater than 0. A failed call adds nothing.
pub fn spawn_slope(
    simulator: &mut TwoHalfPhysicsSimulator,
    from: [f32; 2],
    to: [f32; 2],
    z: [f32; 2],
    thickness: f32,
) -> Result<PlatformId> {
    for (argument, [low, high]) in [("from and to", [from[0], to[0]]), ("z", z)] {
        if !((high - low).is_finite() && low < high) {
            Err(Error::invalid(argument, [low, high], "finite, the first less than the second"))?;
        }
    }
    let [run, rise] = [to[0] - from[0], to[1] - from[1]];
    let length = (run * run + rise * rise).sqrt();
    // From the middle of the edge half of the thickness down, at right angles to it; the position of a
    // platform is straight below its centre.
    let half = 0.5 * thickness;
    let x = from[0] + 0.5 * run + half * (rise / length);
    let y = from[1] + 0.5 * rise - half * (run / length) - half;
    let middle = Vector3::new(x, y, z[0] + 0.5 * (z[1] - z[0]));
    let rotation = -scalar::atan2(rise, run);
    Platform::with_rotation(simulator, length, thickness, z[1] - z[0], middle, rotation, None)
}
