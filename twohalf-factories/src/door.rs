//! Doors that the game turns about an upright hinge.

use serde::{Deserialize, Serialize};
use twohalf::farseer_core::Error;
use twohalf::farseer_core::math::scalar;
use twohalf::{Platform, PlatformId, Result, TwoHalfPhysicsSimulator, Vector3};

/// A door that the game turns about an upright hinge. It is plain data with the id of its platform: the game
/// keeps and saves it.
///
/// The door is a [platform](twohalf::Platform) that moves round the hinge and
/// [turns](twohalf::PlatformMut::turn_to) in the same update. It has infinite mass, and pushes bodies with
/// the velocity of the point that touches them.
///
/// Angles are in radians: at 0 it points along X from its hinge, at a quarter turn along Z, to the back.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Door {
    hinge: Vector3,
    /// Width, px.
    width: f32,
    /// Angle after the next update, radians.
    angle: f32,
    platform: PlatformId,
}

/// Adds a door to the simulator. `hinge` is X, Y and Z of the lower end of its hinge, `size` its width,
/// height and thickness, px; the angle is in radians. It has no friction until its
/// [`platform`](Door::platform) gets some.
///
/// ```
/// use std::f32::consts::FRAC_PI_2;
/// use twohalf::{TwoHalfPhysicsSimulator, Vector2};
/// use twohalf_factories::{Prism, spawn, spawn_door};
///
/// const STEP: f32 = 1.0 / 120.0;
/// let mut simulator = TwoHalfPhysicsSimulator::with_gravity(480, Vector2::new(0.0, 900.0))?;
/// let load = spawn(&mut simulator, Prism::new([20.0, 20.0, 20.0]).at([130.0, 0.0, 80.0]))?;
/// let mut door = spawn_door(&mut simulator, [100.0, 0.0, 50.0], [60.0, 80.0, 6.0], 0.0)?;
/// // It opens to the back, half a turn in a second, and pushes the crate aside.
/// while !door.turn_towards(&mut simulator, FRAC_PI_2, 3.0 * STEP)? {
///     simulator.update(STEP);
/// }
/// simulator.update(STEP);
/// let crate_box = simulator.body(load.body).unwrap().position3d();
/// assert!(crate_box.x <= 100.0 - 3.0 - 10.0 + 0.5 || crate_box.z >= 110.0 + 10.0 - 0.5);
/// # Ok::<(), twohalf::Error>(())
/// ```
///
/// # Errors
/// Another scheme than [`DepthScheme::Precise`](twohalf::DepthScheme::Precise). A size that is not finite and
/// greater than 0. A hinge or angle that is not finite, or a hinge so far away that corners are not finite at
/// every angle. A failed call adds nothing.
pub fn spawn_door(
    simulator: &mut TwoHalfPhysicsSimulator,
    hinge: [f32; 3],
    size: [f32; 3],
    angle: f32,
) -> Result<Door> {
    finite_angle(angle)?;
    let [width, height, thickness] = size;
    for (argument, value) in [("width", width), ("height", height), ("thickness", thickness)] {
        if !(value.is_finite() && value > 0.0) {
            Err(Error::invalid(argument, value, "finite and greater than 0"))?;
        }
    }
    check_hinge(hinge, width + thickness)?;
    let place = place(hinge.into(), width, angle);
    let platform = Platform::new(simulator, width, height, thickness, place, None)?;
    let turned = simulator.platform_mut(platform).map_or(Ok(()), |mut view| view.set_yaw(angle));
    if let Err(error) = turned {
        simulator.remove_platform(platform)?;
        return Err(error);
    }
    Ok(Door { hinge: hinge.into(), width, angle, platform })
}

fn finite_angle(angle: f32) -> Result<f32> {
    if angle.is_finite() { Ok(angle) } else { Err(Error::invalid("angle", angle, "finite"))? }
}

/// Refuses a hinge if points within `reach` of it, px, are not finite.
fn check_hinge(hinge: [f32; 3], reach: f32) -> Result<()> {
    let span = |at: f32| (at + reach) - (at - reach);
    if hinge[1].is_finite() && span(hinge[0]).is_finite() && span(hinge[2]).is_finite() {
        return Ok(());
    }
    Err(Error::invalid("hinge", hinge, "near enough for finite corners"))?
}

/// Position of the platform of a door at an angle, px.
fn place(hinge: Vector3, width: f32, angle: f32) -> Vector3 {
    let (sine, cosine) = scalar::sin_cos_of_any(angle);
    hinge + Vector3::new(cosine, 0.0, sine) * (0.5 * width)
}

impl Door {
    /// Angle after the next update, radians.
    pub fn angle(&self) -> f32 {
        self.angle
    }

    /// Platform of the door: its friction, collision filter, and drawing.
    pub fn platform(&self) -> PlatformId {
        self.platform
    }

    /// Sets a target angle, radians: the next update turns the door to it. Its middle moves straight: a door
    /// that is to push objects must turn by little per step, as [`turn_towards`](Self::turn_towards) does.
    ///
    /// # Errors
    /// An angle that is not finite; a platform that was removed, or that cannot turn: a belt, or one that is
    /// tilted.
    pub fn turn_to(&mut self, simulator: &mut TwoHalfPhysicsSimulator, angle: f32) -> Result<()> {
        finite_angle(angle)?;
        let Some(mut platform) = simulator.platform_mut(self.platform) else {
            return Err(Error::StaleId { argument: "door" })?;
        };
        platform.turn_to(angle)?;
        platform.move_to(place(self.hinge, self.width, angle))?;
        self.angle = angle;
        Ok(())
    }

    /// Makes the next update turn the door towards an angle by at most `most` radians. Returns whether the
    /// door arrives. One call before every update turns it evenly.
    ///
    /// # Errors
    /// The errors of [`turn_to`](Self::turn_to); a greatest turn that is not finite and 0 or more.
    pub fn turn_towards(
        &mut self,
        simulator: &mut TwoHalfPhysicsSimulator,
        angle: f32,
        most: f32,
    ) -> Result<bool> {
        if !(most.is_finite() && most >= 0.0) {
            Err(Error::invalid("most", most, "finite and 0 or more"))?;
        }
        let missing = finite_angle(angle)? - self.angle;
        let arrives = missing.abs() <= most;
        let next = if arrives { angle } else { self.angle + most.copysign(missing) };
        self.turn_to(simulator, next)?;
        Ok(arrives)
    }

    /// Removes the door.
    ///
    /// # Errors
    /// A platform that was removed already.
    pub fn remove(self, simulator: &mut TwoHalfPhysicsSimulator) -> Result<()> {
        simulator.remove_platform(self.platform)
    }
}
