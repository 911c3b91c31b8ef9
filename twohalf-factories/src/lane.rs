//! Walls around a level.

use twohalf::farseer_core::Error;
use twohalf::{Platform, PlatformId, Result, TwoHalfPhysicsSimulator, Vector3};

/// Thickness of the walls, px.
const WALL_THICKNESS: f32 = 40.0;

/// Adds four upright walls from the ground up around a lane, which the least and greatest `x` and `z` bound,
/// px. Returns them: left, right, front, back. They stand outside of the lane, have no friction, and are not
/// meant to be drawn.
///
/// ```
/// # use twohalf::{TwoHalfPhysicsSimulator, Vector2, Vector3};
/// # use twohalf_factories::{Ball, spawn, spawn_lane};
/// # let mut simulator = TwoHalfPhysicsSimulator::with_gravity(480, Vector2::new(0.0, 900.0))?;
/// let walls = spawn_lane(&mut simulator, [0.0, 800.0], [10.0, 150.0], 1000.0)?;
/// let ball = spawn(&mut simulator, Ball::new(10.0).at([100.0, 0.0, 80.0]))?;
/// simulator.body_mut(ball.body).unwrap().set_velocity3d(Vector3::new(0.0, 0.0, 300.0));
/// (0..60).for_each(|_| simulator.update(1.0 / 60.0));
/// assert!((simulator.body(ball.body).unwrap().position3d().z - 140.0).abs() < 0.1);
/// # Ok::<(), twohalf::Error>(())
/// ```
///
/// # Errors
/// Bounds that are not finite, or of which the first is not less than the second; a height that is not finite
/// and greater than 0. A failed call adds nothing.
pub fn spawn_lane(
    simulator: &mut TwoHalfPhysicsSimulator,
    x: [f32; 2],
    z: [f32; 2],
    height: f32,
) -> Result<[PlatformId; 4]> {
    for (argument, [low, high]) in [("x", x), ("z", z)] {
        if !((high - low).is_finite() && low < high) {
            Err(Error::invalid(argument, [low, high], "finite, the first less than the second"))?;
        }
    }
    let middle = |[low, high]: [f32; 2]| low + 0.5 * (high - low);
    // The walls in front and at the back close the corners.
    let (wide, deep) = (x[1] - x[0] + 2.0 * WALL_THICKNESS, z[1] - z[0]);
    let outside = [
        x[0] - 0.5 * WALL_THICKNESS,
        x[1] + 0.5 * WALL_THICKNESS,
        z[0] - 0.5 * WALL_THICKNESS,
        z[1] + 0.5 * WALL_THICKNESS,
    ];
    let walls = [
        [WALL_THICKNESS, deep, outside[0], middle(z)],
        [WALL_THICKNESS, deep, outside[1], middle(z)],
        [wide, WALL_THICKNESS, middle(x), outside[2]],
        [wide, WALL_THICKNESS, middle(x), outside[3]],
    ];
    let mut made = Vec::with_capacity(walls.len());
    for [width, depth, x, z] in walls {
        match Platform::new(simulator, width, height, depth, Vector3::new(x, 0.0, z), None) {
            Ok(wall) => made.push(wall),
            Err(error) => {
                made.into_iter().try_for_each(|wall| simulator.remove_platform(wall))?;
                return Err(error);
            }
        }
    }
    Ok([made[0], made[1], made[2], made[3]])
}
