//! Doors on a hinge with a spring and a damper.

use std::f32::consts::PI;

use serde::{Deserialize, Serialize};
use twohalf::farseer_core::Error;
use twohalf::{Platform, PlatformId, Result, Swing, TwoHalfPhysicsSimulator, Vector3};

/// A door that characters push open and that its spring closes, added by [`spawn_swing_door`]. A door that
/// the game turns is a [`Door`](crate::Door).
///
/// Angles are in radians, as those of a [`Door`](crate::Door): at 0 it points along X from its hinge, at a
/// quarter turn along Z, to the back.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct SwingDoor {
    hinge: Vector3,
    size: [f32; 3],
    /// Angle of the closed door, radians.
    angle: f32,
    /// Greatest opening to both sides, radians.
    opens: [f32; 2],
    /// Mass, in mass units.
    mass: f32,
    /// Period without damping, s.
    period: f32,
    /// Damping ratio, dimensionless.
    damping: f32,
}

impl SwingDoor {
    /// A door with the lower end of its hinge at `hinge` X, Y and Z, and of the width, height and thickness
    /// `size`, px. It has a mass of 3, is closed at an angle of 0 and opens by 1.7 radians (97 degrees) to
    /// both sides.
    pub fn new(hinge: [f32; 3], size: [f32; 3]) -> Self {
        SwingDoor {
            hinge: hinge.into(),
            size,
            angle: 0.0,
            opens: [1.7, 1.7],
            mass: 3.0,
            period: 1.2,
            damping: 0.25,
        }
    }

    /// Sets the angle of the closed door, radians, at which it starts.
    #[must_use]
    pub fn angle(self, angle: f32) -> Self {
        SwingDoor { angle, ..self }
    }

    /// Sets the greatest opening towards lesser and towards greater angles, radians, 0 or more, where its
    /// stops are. A door that opens to one side only is a wall from the other.
    #[must_use]
    pub fn opens(self, back: f32, on: f32) -> Self {
        SwingDoor { opens: [back, on], ..self }
    }

    /// Sets the mass of the door, a uniform slab. Much heavier characters hardly feel it.
    #[must_use]
    pub fn mass(self, mass: f32) -> Self {
        SwingDoor { mass, ..self }
    }

    /// Sets the period of its free motion without damping, s. Default 1.2.
    #[must_use]
    pub fn period(self, period: f32) -> Self {
        SwingDoor { period, ..self }
    }

    /// Sets the damping ratio, dimensionless, 0 or more; 1 is critical damping. Default 0.25.
    #[must_use]
    pub fn damping(self, damping: f32) -> Self {
        SwingDoor { damping, ..self }
    }

    fn check(&self) -> Result<()> {
        let [width, height, thickness] = self.size;
        let positive = [
            ("width", width),
            ("height", height),
            ("thickness", thickness),
            ("mass", self.mass),
            ("period", self.period),
        ];
        for (argument, value) in positive {
            if !(value.is_finite() && value > 0.0) {
                Err(Error::invalid(argument, value, "finite and greater than 0"))?;
            }
        }
        let [back, on] = self.opens;
        for (argument, value) in [("back", back), ("on", on), ("damping", self.damping)] {
            if !(value.is_finite() && value >= 0.0) {
                Err(Error::invalid(argument, value, "finite and 0 or more"))?;
            }
        }
        Ok(())
    }

    fn swing(&self) -> Swing {
        let ([width, _, thickness], [back, on]) = (self.size, self.opens);
        let moment_of_inertia = self.mass * (width * width / 3.0 + thickness * thickness / 12.0);
        let frequency = 2.0 * PI / self.period;
        Swing {
            hinge: [self.hinge.x, self.hinge.z],
            moment_of_inertia,
            stiffness: moment_of_inertia * frequency * frequency,
            damping: 2.0 * self.damping * moment_of_inertia * frequency,
            rest_angle: self.angle,
            least_angle: self.angle - back,
            greatest_angle: self.angle + on,
        }
    }
}

/// Adds a hinged door to the simulator. It is a [platform with a hinge](twohalf::PlatformMut::set_swing): its
/// [`yaw`](Platform::yaw) is its angle, [`set_angular_velocity`](twohalf::PlatformMut::set_angular_velocity)
/// kicks it, and it has no friction until it is set.
///
/// ```
/// use std::f32::consts::FRAC_PI_2;
/// use twohalf::{TwoHalfPhysicsSimulator, Vector2, MoveInput};
/// use twohalf_factories::{Actor, Figure, SwingDoor, spawn_swing_door};
///
/// const STEP: f32 = 1.0 / 60.0;
/// let mut simulator = TwoHalfPhysicsSimulator::with_gravity(480, Vector2::new(0.0, 900.0))?;
/// // Across the lane.
/// let saloon = SwingDoor::new([200.0, 0.0, 20.0], [60.0, 80.0, 6.0]).angle(FRAC_PI_2).mass(2.0);
/// let saloon = spawn_swing_door(&mut simulator, saloon)?;
/// let mut guest = Actor::spawn(&mut simulator, Figure::new([20.0, 60.0, 16.0]).mass(70.0).at([120.0, 0.0, 50.0]))?;
/// let mut widest = 0.0f32;
/// for _ in 0..240 {
///     guest.act(&mut simulator, MoveInput { x: 80.0, ..MoveInput::default() }, STEP)?;
///     simulator.update(STEP);
///     widest = widest.max(FRAC_PI_2 - simulator.platform(saloon).unwrap().yaw());
/// }
/// // He is through, and it has closed behind him.
/// assert!(guest.place(&simulator).x > 300.0 && widest > 0.8);
/// assert!((simulator.platform(saloon).unwrap().yaw() - FRAC_PI_2).abs() < 0.1);
/// # Ok::<(), twohalf::Error>(())
/// ```
///
/// # Errors
/// Another scheme than [`DepthScheme::Precise`](twohalf::DepthScheme::Precise). A size, mass or period that
/// is not finite and greater than 0. An opening or damping that is not finite and 0 or more. An angle that is
/// not finite. A hinge that is not finite, or so far away that corners are not finite at every angle. A
/// moment of inertia or spring that is not finite. A failed call adds nothing.
pub fn spawn_swing_door(simulator: &mut TwoHalfPhysicsSimulator, door: SwingDoor) -> Result<PlatformId> {
    door.check()?;
    let SwingDoor { hinge, size: [width, height, thickness], angle, .. } = door;
    let swing = door.swing();
    let unturned = hinge + Vector3::new(0.5 * width, 0.0, 0.0);
    let platform = Platform::new(simulator, width, height, thickness, unturned, None)?;
    let hung = simulator.platform_mut(platform).map_or(Ok(()), |mut view| {
        // It is hung while it points along X, then turned about its hinge.
        view.set_swing(Swing { least_angle: 0.0f32.min(angle), greatest_angle: 0.0f32.max(angle), ..swing })?;
        view.set_yaw(angle)?;
        view.set_swing(swing)
    });
    if let Err(error) = hung {
        simulator.remove_platform(platform)?;
        return Err(error);
    }
    Ok(platform)
}
