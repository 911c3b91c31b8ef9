//! Projection from the world to the screen and back (thesis 3.1).
//!
//! Three frames of reference, all in px:
//! - the **world**: X right, Y up, Z into the picture, Y = 0 on the ground;
//! - the **plane** of the 2D engine: x = X, y = -Y, so y points down and the ground is y = 0;
//! - the **screen**: x right, y down, the ground rising with Z.

use farseer_core::math::{Vector2, Vector3};
use serde::{Deserialize, Serialize};

use crate::Result;
use crate::error::invalid;

/// Projection of the world to the screen.
///
/// ```text
/// screen.x = X - Z / tan(180° - angle)
/// screen.y = height - (Y + Z) - lowest
/// ```
///
/// `lowest` is the distance from a body's origin down to the lowest point of its object geom, px. The formula
/// is evaluated in double precision and rounded once.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(try_from = "ProjectionArguments", into = "ProjectionArguments")]
pub struct Projection {
    /// Height of the screen, px.
    height: i32,
    /// Direction of the Z axis on the screen, degrees.
    angle: i32,
    /// Cotangent of the angle: px to the right per px of depth; dimensionless.
    slope: f64,
}

/// Arguments of a projection, in the form in which it is saved.
#[derive(Clone, Copy, Serialize, Deserialize)]
struct ProjectionArguments {
    height: i32,
    angle: i32,
}

impl TryFrom<ProjectionArguments> for Projection {
    type Error = crate::Error;
    fn try_from(ProjectionArguments { height, angle }: ProjectionArguments) -> Result<Self> {
        Projection::new(height, angle)
    }
}

impl From<Projection> for ProjectionArguments {
    fn from(Projection { height, angle, .. }: Projection) -> Self {
        ProjectionArguments { height, angle }
    }
}

impl Projection {
    /// A projection on a screen of `height` px whose Z axis points `angle` degrees counterclockwise from the
    /// x axis: 90 straight up, 45 up and to the right.
    ///
    /// # Errors
    /// A height that is not greater than 0; an angle that is not between 0 and 180.
    pub fn new(height: i32, angle: i32) -> Result<Self> {
        let height = check_height(height)?;
        if !(1..180).contains(&angle) {
            return Err(invalid("angle", angle, "greater than 0 and less than 180 degrees"));
        }
        Ok(Projection { height, angle, slope: cotangent(angle) })
    }

    /// Height of the screen in px.
    pub fn height(&self) -> i32 {
        self.height
    }

    /// Sets the height of the screen, px.
    ///
    /// # Errors
    /// A height that is not greater than 0.
    pub fn set_height(&mut self, height: i32) -> Result<()> {
        self.height = check_height(height)?;
        Ok(())
    }

    /// Direction of the Z axis on the screen, degrees counterclockwise from the x axis.
    pub fn angle(&self) -> i32 {
        self.angle
    }

    /// Shear of edges at another angle relative to the Z axis: px to the right per px of depth.
    pub(crate) fn shear_of(&self, angle: i32) -> f32 {
        (cotangent(angle) - self.slope) as f32
    }

    /// Direction towards the viewer in the world. All points along it have one point of the screen.
    pub fn to_viewer(&self) -> Vector3 {
        Vector3::new(self.slope as f32, 1.0, -1.0)
    }

    /// Inverse projection of a point of the screen to the ground, px; limited to finite numbers.
    pub fn screen_to_ground(&self, point: Vector2) -> Vector3 {
        let z = f64::from(self.height) - f64::from(point.y);
        Vector3::new(finite_f32(f64::from(point.x) - z * self.slope), 0.0, finite_f32(z))
    }

    /// Projection of a point of the world to the screen, px; limited to finite numbers.
    pub fn to_screen(&self, point: Vector3) -> Vector2 {
        let [x, y, z] = [point.x, point.y, point.z].map(f64::from);
        Vector2::new(finite_f32(x + z * self.slope), finite_f32(f64::from(self.height) - (y + z)))
    }

    /// Projection of a point of the plane at depth `z`, px.
    pub(crate) fn plane_to_screen(&self, plane: Vector2, z: f32) -> Vector2 {
        let [x, y] = self.on_screen(plane, z);
        Vector2::new(finite_f32(x), finite_f32(y))
    }

    fn on_screen(&self, plane: Vector2, z: f32) -> [f64; 2] {
        let [x, y, z] = [plane.x, plane.y, z].map(f64::from);
        [x + z * self.slope, f64::from(self.height) + y - z]
    }

    /// Returns whether the projection of a point of the plane at depth `z` is finite.
    pub(crate) fn appears(&self, plane: Vector2, z: f32) -> bool {
        self.on_screen(plane, z).iter().all(|&number| (number as f32).is_finite())
    }

    /// Inverse projection of a point of the screen to the plane at depth `z`, px.
    pub(crate) fn screen_to_plane(&self, screen: Vector2, z: f32) -> Vector2 {
        let [x, y, z] = [screen.x, screen.y, z].map(f64::from);
        Vector2::new((x - z * self.slope) as f32, (y - f64::from(self.height) + z) as f32)
    }
}

/// Returns the nearest finite f32 of a number: sums of far coordinates may exceed the range of f32.
fn finite_f32(number: f64) -> f32 {
    if number.is_nan() { f32::NAN } else { number.clamp(f64::from(f32::MIN), f64::from(f32::MAX)) as f32 }
}

fn check_height(height: i32) -> Result<i32> {
    if height > 0 { Ok(height) } else { Err(invalid("height", height, "greater than 0")) }
}

/// Returns the cotangent of whole degrees, dimensionless. Exact values at 45, 90 and 135 degrees keep these axes exact, unlike
/// a rounded quotient.
fn cotangent(degrees: i32) -> f64 {
    match degrees {
        45 => 1.0,
        90 => 0.0,
        135 => -1.0,
        _ => {
            let (sin, cos) = libm::sincos(f64::from(degrees).to_radians());
            cos / sin
        }
    }
}

/// Converts a vector between the frame of the plane with depth (y down) and the world (Y up), in both directions: y changes its
/// sign.
pub(crate) fn to_world(v: Vector3) -> Vector3 {
    Vector3::new(v.x, -v.y, v.z)
}

/// Position of a body in the world, px, from its origin in the plane.
pub(crate) fn plane_to_world(plane: Vector2, lowest: f64, z: f32) -> Vector3 {
    Vector3::new(plane.x, finite_f32(-f64::from(plane.y) - lowest), z)
}

/// Origin of a body in the plane, px, from its position in the world.
pub(crate) fn world_to_plane(world: Vector3, lowest: f64) -> Vector2 {
    Vector2::new(world.x, -(f64::from(world.y) + lowest) as f32)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn at_90_degrees_depth_goes_straight_up() {
        let screen = Projection::new(480, 90).unwrap().to_screen(Vector3::new(0.0, 10.0, 100.0));
        assert_eq!(screen, Vector2::new(0.0, 480.0 - 10.0 - 100.0));
    }

    #[test]
    fn at_45_degrees_depth_goes_up_and_to_the_right_by_the_same_amount() {
        let screen = Projection::new(480, 45).unwrap().to_screen(Vector3::new(7.0, 0.0, 100.0));
        assert_eq!(screen, Vector2::new(107.0, 380.0));
    }

    #[test]
    fn at_135_degrees_depth_goes_up_and_to_the_left() {
        let screen = Projection::new(480, 135).unwrap().to_screen(Vector3::new(7.0, 0.0, 100.0));
        assert_eq!(screen, Vector2::new(-93.0, 380.0));
    }

    #[test]
    fn at_60_degrees_depth_goes_to_the_right_by_one_over_the_square_root_of_three() {
        let screen = Projection::new(480, 60).unwrap().to_screen(Vector3::new(0.0, 0.0, 300.0));
        assert_eq!(screen.x, (300.0 / 3.0_f64.sqrt()) as f32);
    }

    #[test]
    fn the_formula_is_that_of_the_thesis_at_every_angle() {
        let point = Vector3::new(123.25, 45.5, 67.75);
        for angle in 1..180 {
            let screen = Projection::new(600, angle).unwrap().to_screen(point);
            let tangent = f64::from(180 - angle).to_radians().tan();
            let expected = f64::from(point.x) - f64::from(point.z) / tangent;
            assert!((f64::from(screen.x) - expected).abs() <= 1e-6 * expected.abs().max(100.0), "{angle}");
            assert_eq!(screen.y, 600.0 - (45.5 + 67.75));
        }
    }

    #[test]
    fn the_plane_appears_where_the_world_does() {
        let projection = Projection::new(600, 60).unwrap();
        let world = Vector3::new(12.5, 40.0, 75.0);
        let plane = world_to_plane(world, 0.0);
        assert_eq!(projection.plane_to_screen(plane, world.z), projection.to_screen(world));
    }

    #[test]
    fn heights_and_angles_out_of_range_are_refused() {
        for (height, angle) in [(0, 90), (-5, 90), (480, 0), (480, 180), (480, -45), (480, 270)] {
            assert!(Projection::new(height, angle).is_err(), "({height}, {angle})");
        }
    }
}
