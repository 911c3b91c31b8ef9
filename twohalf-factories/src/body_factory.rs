//! Bodies with the mass properties of simple shapes.

use twohalf::farseer_core::{Body, BodyFactory};
use twohalf::{BodyId, Result, TwoHalfPhysicsSimulator};

/// Makes bodies with the moments of inertia of solid shapes, those of the 2D engine's
/// [`BodyFactory`], and adds them to the simulator.
#[derive(Debug, Clone, Copy)]
pub struct TwoHalfBodyFactory;

impl TwoHalfBodyFactory {
    /// A solid disc.
    ///
    /// # Errors
    /// A radius or mass that is not finite and greater than 0, or so small that the moment of inertia vanishes.
    #[doc(alias = "CreateCircleBody")]
    pub fn create_circle_body(
        simulator: &mut TwoHalfPhysicsSimulator,
        radius: f32,
        mass: f32,
    ) -> Result<BodyId> {
        add(simulator, BodyFactory::create_circle_body(radius, mass)?)
    }

    /// A solid rectangle.
    ///
    /// # Errors
    /// A width, height or mass that is not finite and greater than 0, or so small that the moment of inertia
    /// vanishes.
    #[doc(alias = "CreateRectangleBody")]
    pub fn create_rectangle_body(
        simulator: &mut TwoHalfPhysicsSimulator,
        width: f32,
        height: f32,
        mass: f32,
    ) -> Result<BodyId> {
        add(simulator, BodyFactory::create_rectangle_body(width, height, mass)?)
    }
}

fn add(simulator: &mut TwoHalfPhysicsSimulator, body: Body) -> Result<BodyId> {
    let body = simulator.create_body(body);
    simulator.add(body)?;
    Ok(body)
}
