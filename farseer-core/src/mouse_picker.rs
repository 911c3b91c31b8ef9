//! Taking hold of bodies with the mouse, as the original's samples do (behaviour chapter 16, section B.1).

use crate::error::finite;
use crate::factories::SpringFactory;
use crate::geom::GeomId;
use crate::math::Vector2;
use crate::simulator::PhysicsSimulator;
use crate::springs::{FixedLinearSpring, SpringId};
use crate::{Error, Result};

/// Takes hold of what is under the mouse and draws it along with a spring.
///
/// ```
/// use farseer_core::{BodyFactory, GeomFactory, GeomPlacement, MousePicker, PhysicsSimulator, math::Vector2};
///
/// let mut simulator = PhysicsSimulator::default();
/// let body = BodyFactory::create_circle_body_in(&mut simulator, 10.0, 1.0)?;
/// GeomFactory::create_circle_geom_in(&mut simulator, body, 10.0, 16, GeomPlacement::default())?;
/// simulator.update(0.01);
///
/// let mut mouse = MousePicker::default();
/// // The button goes down, the mouse moves, the button goes up.
/// mouse.pick(&mut simulator, Vector2::new(3.0, 0.0))?;
/// mouse.drag(&mut simulator, Vector2::new(50.0, 0.0))?;
/// for _ in 0..10 {
///     simulator.update(0.01);
/// }
/// mouse.release(&mut simulator);
/// assert!(simulator[body].linear_velocity().x > 0.0);
/// # Ok::<(), farseer_core::Error>(())
/// ```
#[derive(Debug, Clone, PartialEq)]
pub struct MousePicker {
    spring_constant: f32,
    damping_constant: f32,
    spring: Option<SpringId>,
}

impl Default for MousePicker {
    /// With the samples' spring constant of 100 and damping constant of 50.
    fn default() -> Self {
        MousePicker { spring_constant: 100.0, damping_constant: 50.0, spring: None }
    }
}

impl MousePicker {
    /// A picker whose spring has these constants: force per length, and force per velocity.
    ///
    /// # Errors
    /// What is not finite.
    pub fn new(spring_constant: f32, damping_constant: f32) -> Result<Self> {
        Ok(MousePicker {
            spring_constant: finite("spring_constant", spring_constant)?,
            damping_constant: finite("damping_constant", damping_constant)?,
            spring: None,
        })
    }

    /// The button went down at a point of the world: takes hold there of the body of the first geom in list order that
    /// [holds the point](PhysicsSimulator::collide), and answers which geom it is. What was held before is released.
    /// The spring acts from the next update on; a static body is held but does not move.
    ///
    /// # Errors
    /// A point that is not finite.
    pub fn pick(&mut self, simulator: &mut PhysicsSimulator, point: Vector2) -> Result<Option<GeomId>> {
        crate::error::finite_vector("point", point)?;
        self.release(simulator);
        let Some(geom) = simulator.collide(point) else { return Ok(None) };
        let Some(id) = simulator.geom(geom).map(|geom| geom.body()) else { return Ok(None) };
        let body = simulator.body(id).ok_or(Error::StaleId { argument: "geom" })?;
        let spring = SpringFactory::create_fixed_linear_spring_in(
            simulator,
            id,
            body.get_local_position(point),
            point,
            self.spring_constant,
            self.damping_constant,
        )?;
        self.spring = Some(spring);
        Ok(Some(geom))
    }

    /// The mouse moved to a point of the world; without anything in hold nothing happens. A body that was disposed is
    /// no longer held.
    ///
    /// # Errors
    /// A point that is not finite.
    pub fn drag(&mut self, simulator: &mut PhysicsSimulator, point: Vector2) -> Result<()> {
        crate::error::finite_vector("point", point)?;
        let Some(spring) = self.spring else { return Ok(()) };
        match simulator.spring_as_mut::<FixedLinearSpring>(spring) {
            Ok(spring) => spring.set_world_attach_point(point),
            Err(_) => {
                self.spring = None;
                Ok(())
            }
        }
    }

    /// The button went up: lets go.
    pub fn release(&mut self, simulator: &mut PhysicsSimulator) {
        if let Some(spring) = self.spring.take() {
            // It has gone already if its body was disposed.
            simulator.dispose(spring).ok();
        }
    }

    /// The spring, while something is held.
    pub fn spring(&self) -> Option<SpringId> {
        self.spring
    }

    /// The points of the world where the spring is fixed to the body and to the mouse, while something is held: the
    /// line that the samples draw.
    pub fn line(&self, simulator: &PhysicsSimulator) -> Option<(Vector2, Vector2)> {
        let spring: &FixedLinearSpring = simulator.spring_as(self.spring?).ok()?;
        let body = simulator.body(spring.body())?;
        Some((body.get_world_position(spring.body_attach_point()), spring.world_attach_point()))
    }
}
