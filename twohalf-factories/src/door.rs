//! Doors: what turns about an upright hinge.

use serde::{Deserialize, Serialize};
use twohalf::farseer_core::Error;
use twohalf::farseer_core::math::scalar;
use twohalf::{DepthScheme, Platform, PlatformId, Result, TwoHalfPhysicsSimulator, Vector3};

/// So many posts a door may have.
const MOST: f32 = 200.0;

/// A door that turns about an upright hinge: plain data that names its parts, kept and saved where the game keeps its things.
///
/// A [platform turns](twohalf::PlatformMut::turn_to) about its own middle. A door is a row of upright posts instead, moving
/// [platforms](twohalf::Platform) as thick as the door, which go round the hinge together: where it is open or closed along X or Z
/// it is a smooth wall, in between its sides have steps of its thickness. It pushes what it meets, and is pushed by nothing.
///
/// Angles are in radians: at 0 it points along X from its hinge, at a quarter of a turn to the back, along Z.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Door {
    hinge: Vector3,
    width: f32,
    angle: f32,
    posts: Vec<PlatformId>,
}

/// Makes a door and adds it to the simulator: at `hinge` X, Y and Z of the lower end of its hinge, as wide, high and thick as
/// `size` says, px, at an angle; the thickness becomes the nearest whole part of the width. Its posts have no friction until [`posts`](Door::posts) are given some.
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
/// Another scheme than [`DepthScheme::Precise`]; a size that is not finite and greater than 0, thicker than wide, or so wide for
/// its thickness that it would have more than 200 posts; a hinge or angle that is not finite. Then nothing was added.
pub fn spawn_door(
    simulator: &mut TwoHalfPhysicsSimulator,
    hinge: [f32; 3],
    size: [f32; 3],
    angle: f32,
) -> Result<Door> {
    let [width, height, thickness] = size;
    if simulator.depth_scheme() != DepthScheme::Precise {
        Err(Error::NotSupported { what: "doors", methods: "faithful and thesis" })?;
    }
    for (argument, value) in [("width", width), ("height", height), ("thickness", thickness)] {
        if !(value.is_finite() && value > 0.0) {
            Err(Error::invalid(argument, value, "finite and greater than 0"))?;
        }
    }
    if thickness > width {
        Err(Error::invalid("thickness", thickness, "at most the width"))?;
    }
    let count = (width / thickness).round();
    if count > MOST {
        Err(Error::invalid("thickness", thickness, "at least a 200th of the width"))?;
    }
    let mut door = Door { hinge: hinge.into(), width, angle: finite_angle(angle)?, posts: Vec::new() };
    let side = width / count;
    for at in 0..count as usize {
        let place = door.place(at, count, angle);
        match Platform::new(simulator, side, height, side, place, None) {
            Ok(post) => door.posts.push(post),
            Err(error) => {
                door.remove(simulator)?;
                return Err(error);
            }
        }
    }
    Ok(door)
}

fn finite_angle(angle: f32) -> Result<f32> {
    if angle.is_finite() { Ok(angle) } else { Err(Error::invalid("angle", angle, "finite"))? }
}

impl Door {
    /// Where a post of so many is at an angle.
    fn place(&self, at: usize, count: f32, angle: f32) -> Vector3 {
        let (sine, cosine) = (scalar::sin(angle), scalar::cos(angle));
        let out = (at as f32 + 0.5) * (self.width / count);
        self.hinge + Vector3::new(cosine * out, 0.0, sine * out)
    }

    /// The angle that it was brought to last.
    pub fn angle(&self) -> f32 {
        self.angle
    }

    /// The platforms that it consists of, from the hinge out: their friction, what they meet, and how they are drawn.
    pub fn posts(&self) -> &[PlatformId] {
        &self.posts
    }

    /// Lets the next update bring the door to an angle. Its posts go there straight: a door that is to push what is in its way
    /// turns by little in a step, as [`turn_towards`](Self::turn_towards) lets it.
    ///
    /// # Errors
    /// An angle that is not finite; a post that was removed.
    pub fn turn_to(&mut self, simulator: &mut TwoHalfPhysicsSimulator, angle: f32) -> Result<()> {
        finite_angle(angle)?;
        if self.posts.iter().any(|&post| simulator.platform(post).is_none()) {
            Err(Error::StaleId { argument: "door" })?;
        }
        let count = self.posts.len() as f32;
        for (at, &post) in self.posts.iter().enumerate() {
            if let Some(mut post) = simulator.platform_mut(post) {
                post.move_to(self.place(at, count, angle))?;
            }
        }
        self.angle = angle;
        Ok(())
    }

    /// Lets the next update turn the door towards an angle, by no more than `most` radians, and answers whether that brings it
    /// there. Called before every update it turns evenly.
    ///
    /// # Errors
    /// As [`turn_to`](Self::turn_to); a greatest turn that is not finite and 0 or more.
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

    /// Takes the door away.
    ///
    /// # Errors
    /// A post that was removed already.
    pub fn remove(self, simulator: &mut TwoHalfPhysicsSimulator) -> Result<()> {
        self.posts.into_iter().try_for_each(|post| simulator.remove_platform(post))
    }
}
