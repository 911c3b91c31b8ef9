//! Bodies with the mass properties of simple shapes.

use twohalf::farseer_core::{Body, BodyFactory, Vertices};
use twohalf::{BodyId, Result, TwoHalfPhysicsSimulator};

/// Creates bodies with the moments of inertia of solid shapes, by the core's [`BodyFactory`], and adds them
/// to the simulator.
#[derive(Debug, Clone, Copy)]
pub struct TwoHalfBodyFactory;

impl TwoHalfBodyFactory {
    /// A body of a mass and a moment of inertia (mass · px²).
    ///
    /// # Errors
    /// A mass or moment of inertia that is not finite, or 0.
    #[doc(alias = "CreateBody(TwoHalfPhysicsSimulator, float, float)")]
    pub fn create_body(
        simulator: &mut TwoHalfPhysicsSimulator,
        mass: f32,
        moment_of_inertia: f32,
    ) -> Result<BodyId> {
        add(simulator, BodyFactory::create_body(mass, moment_of_inertia)?)
    }

    /// A copy of a body, without geoms and at rest; see [`TwoHalfPhysicsSimulator::clone_body`].
    ///
    /// # Errors
    /// A stale body.
    #[doc(alias = "CreateBody(TwoHalfPhysicsSimulator, TwoHalfBody)")]
    pub fn clone_body(simulator: &mut TwoHalfPhysicsSimulator, body: BodyId) -> Result<BodyId> {
        let copy = simulator.clone_body(body)?;
        simulator.add(copy)?;
        Ok(copy)
    }

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

    /// A solid ellipse.
    ///
    /// # Errors
    /// A radius or mass that is not finite and greater than 0, or so small that the moment of inertia vanishes.
    #[doc(alias = "CreateEllipseBody")]
    pub fn create_ellipse_body(
        simulator: &mut TwoHalfPhysicsSimulator,
        x_radius: f32,
        y_radius: f32,
        mass: f32,
    ) -> Result<BodyId> {
        add(simulator, BodyFactory::create_ellipse_body(x_radius, y_radius, mass)?)
    }

    /// A solid polygon about its centroid, which becomes the body's origin.
    ///
    /// # Errors
    /// An outline without area; a mass that is not finite and greater than 0.
    #[doc(alias = "CreatePolygonBody")]
    pub fn create_polygon_body(
        simulator: &mut TwoHalfPhysicsSimulator,
        vertices: impl Into<Vertices>,
        mass: f32,
    ) -> Result<BodyId> {
        add(simulator, BodyFactory::create_polygon_body(&vertices.into(), mass)?)
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
