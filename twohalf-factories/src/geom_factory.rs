//! Geoms of simple shapes.

use twohalf::farseer_core::{Error, GeomPlacement, Vertices};
use twohalf::{BodyId, DepthProfile, GeomId, Result, TwoHalfPhysicsSimulator};

/// Makes geoms of simple shapes, attaches them to a body and adds them to the simulator.
///
/// Every method refuses a stale body.
#[derive(Debug, Clone, Copy)]
pub struct TwoHalfGeomFactory;

impl TwoHalfGeomFactory {
    /// A ball. Against other geoms it is a regular polygon in X and Y, as in the 2D engine, over the ball's depth;
    /// its depth profile is [`DepthProfile::Round`].
    ///
    /// # Errors
    /// A radius that is not finite and greater than 0; fewer than 3 edges.
    #[doc(alias = "CreateCircleGeom")]
    pub fn create_circle_geom(
        simulator: &mut TwoHalfPhysicsSimulator,
        body: BodyId,
        radius: f32,
        number_of_edges: i32,
    ) -> Result<GeomId> {
        check_positive("radius", radius)?;
        if number_of_edges < 3 {
            return Err(Error::invalid("number_of_edges", number_of_edges, "3 or more").into());
        }
        let geom = add(simulator, body, Vertices::create_circle(radius, number_of_edges)?)?;
        simulator.set_depth_profile(geom, DepthProfile::Round { radius })?;
        Ok(geom)
    }

    /// A box as deep as its shorter side; [`TwoHalfPhysicsSimulator::set_depth_profile`] gives it another depth.
    ///
    /// # Errors
    /// A width or height that is not finite and greater than 0.
    #[doc(alias = "CreateRectangleGeom")]
    pub fn create_rectangle_geom(
        simulator: &mut TwoHalfPhysicsSimulator,
        body: BodyId,
        width: f32,
        height: f32,
    ) -> Result<GeomId> {
        check_positive("width", width)?;
        check_positive("height", height)?;
        add(simulator, body, Vertices::create_rectangle(width, height)?)
    }
}

fn check_positive(argument: &'static str, value: f32) -> Result<()> {
    if value.is_finite() && value > 0.0 {
        Ok(())
    } else {
        Err(Error::invalid(argument, value, "finite and greater than 0").into())
    }
}

fn add(simulator: &mut TwoHalfPhysicsSimulator, body: BodyId, vertices: Vertices) -> Result<GeomId> {
    let geom = simulator.create_geom(body, vertices, GeomPlacement::default())?;
    simulator.add(geom)?;
    Ok(geom)
}
