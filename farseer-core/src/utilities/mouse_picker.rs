//! Picking bodies with the mouse, as in the original's samples (behaviour chapter 16, section B.1).

use serde::{Deserialize, Deserializer, Serialize, de::Error as _};

use crate::body::BodyId;
use crate::factories::SpringFactory;
use crate::geom::GeomId;
use crate::math::Vector2;
use crate::math::finite::finite;
use crate::objects::Objects;
use crate::springs::{FixedLinearSpring, SpringId};
use crate::{Error, Result};

/// Picks the body under the mouse and pulls it along with a spring.
///
/// The spring is in the simulator, and so in its saves. A game that may be saved while a body is held saves the picker
/// beside the simulator, or releases the body before. After [restoring](crate::PhysicsSimulator::restore) a save made
/// before the button went down, call [`forget`](Self::forget).
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
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct MousePicker {
    #[serde(deserialize_with = "finite_constant")]
    spring_constant: f32,
    #[serde(deserialize_with = "finite_constant")]
    damping_constant: f32,
    /// The spring and its body: after a restore the id may name another spring.
    held: Option<(SpringId, BodyId)>,
}

fn finite_constant<'de, D: Deserializer<'de>>(deserializer: D) -> std::result::Result<f32, D::Error> {
    finite("spring constant or damping constant", f32::deserialize(deserializer)?).map_err(D::Error::custom)
}

impl Default for MousePicker {
    /// With the samples' spring constant of 100 mass units/s² and damping constant of 50 mass units/s.
    fn default() -> Self {
        MousePicker { spring_constant: 100.0, damping_constant: 50.0, held: None }
    }
}

impl MousePicker {
    /// A picker whose spring has these constants: stiffness in mass units/s², damping in mass units/s.
    ///
    /// # Errors
    /// A value that is not finite.
    pub fn new(spring_constant: f32, damping_constant: f32) -> Result<Self> {
        Ok(MousePicker {
            spring_constant: finite("spring_constant", spring_constant)?,
            damping_constant: finite("damping_constant", damping_constant)?,
            held: None,
        })
    }

    /// The button went down at a point of the world: picks the body of the first geom in list order that [contains the
    /// point](crate::Objects::collide), and returns that geom. A body held before is released. The spring acts from the
    /// next update on; a static body is held but does not move.
    ///
    /// # Errors
    /// A point that is not finite.
    pub fn pick(&mut self, simulator: &mut Objects, point: Vector2) -> Result<Option<GeomId>> {
        crate::math::finite::finite_vector("point", point)?;
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
        self.held = Some((spring, id));
        Ok(Some(geom))
    }

    /// The mouse moved to a point of the world; no effect if no body is held. A body that was disposed is no longer
    /// held, nor is one whose spring was disposed or pulls another body now.
    ///
    /// # Errors
    /// A point that is not finite.
    pub fn drag(&mut self, simulator: &mut Objects, point: Vector2) -> Result<()> {
        crate::math::finite::finite_vector("point", point)?;
        let Some((id, _)) = self.own_spring(simulator) else {
            self.forget();
            return Ok(());
        };
        simulator.spring_as_mut::<FixedLinearSpring>(id)?.set_world_attach_point(point)
    }

    /// The button went up: releases the body.
    pub fn release(&mut self, simulator: &mut Objects) {
        // The spring was disposed already if its body was.
        if let Some((id, _)) = self.own_spring(simulator) {
            simulator.dispose(id).ok();
        }
        self.forget();
    }

    /// Forgets the held body, and leaves the simulator unchanged: for games that restore a save made before the button
    /// went down, or have cleared the simulator.
    pub fn forget(&mut self) {
        self.held = None;
    }

    /// The spring, while a body is held.
    pub fn spring(&self) -> Option<SpringId> {
        self.held.map(|(spring, _)| spring)
    }

    /// The attached points of the spring, on the body and at the mouse, in the world, while a body is held: the line
    /// that the samples draw.
    pub fn line(&self, simulator: &Objects) -> Option<(Vector2, Vector2)> {
        let (_, spring) = self.own_spring(simulator)?;
        let body = simulator.body(spring.body())?;
        Some((body.get_world_position(spring.body_attach_point()), spring.world_attach_point()))
    }

    /// The spring, if the id still names the one that was made.
    fn own_spring<'a>(&self, simulator: &'a Objects) -> Option<(SpringId, &'a FixedLinearSpring)> {
        let (id, body) = self.held?;
        let spring: &FixedLinearSpring = simulator.spring_as(id).ok()?;
        (spring.body() == body).then_some((id, spring))
    }
}
