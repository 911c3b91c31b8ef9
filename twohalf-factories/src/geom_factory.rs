//! Geoms of simple shapes.

use twohalf::farseer_core::{Error, GeomPlacement, Vertices};
use twohalf::{BodyId, DepthProfile, GeomId, Result, TwoHalfPhysicsSimulator, Vector2};

/// Creates geoms of simple shapes, attaches them to a body and adds them to the simulator.
///
/// Every method refuses a stale body.
#[derive(Debug, Clone, Copy)]
pub struct TwoHalfGeomFactory;

impl TwoHalfGeomFactory {
    /// A ball: its depth profile is [`DepthProfile::Round`]. Its outline is a regular polygon, which the
    /// [scheme of the thesis](twohalf::DepthScheme::Thesis) uses for collisions.
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
        check_edges(number_of_edges)?;
        let outline = Vertices::create_circle(radius, number_of_edges)?;
        let geom = simulator.create_geom(body, outline, GeomPlacement::default())?;
        if let Err(error) = simulator.set_depth_profile(geom, DepthProfile::Round { radius }) {
            simulator.dispose(geom)?;
            return Err(error);
        }
        simulator.add(geom)?;
        Ok(geom)
    }

    /// An ellipse as deep as its shorter axis.
    ///
    /// # Errors
    /// A radius that is not finite and greater than 0; fewer than 3 edges.
    #[doc(alias = "CreateEllipseGeom")]
    pub fn create_ellipse_geom(
        simulator: &mut TwoHalfPhysicsSimulator,
        body: BodyId,
        x_radius: f32,
        y_radius: f32,
        number_of_edges: i32,
    ) -> Result<GeomId> {
        check_positive("x_radius", x_radius)?;
        check_positive("y_radius", y_radius)?;
        check_edges(number_of_edges)?;
        add(simulator, body, Vertices::create_ellipse(x_radius, y_radius, number_of_edges)?)
    }

    /// A polygon, moved so that its centroid is at the body's origin, as deep as the shorter side of its
    /// AABB. `collision_grid_size` is the edge of a cell of its distance grid in px; 0 is the core's default.
    ///
    /// # Errors
    /// An outline without area; a cell size that is not finite or too small for the outline.
    #[doc(alias = "CreatePolygonGeom")]
    pub fn create_polygon_geom(
        simulator: &mut TwoHalfPhysicsSimulator,
        body: BodyId,
        vertices: impl Into<Vertices>,
        collision_grid_size: f32,
    ) -> Result<GeomId> {
        let mut vertices: Vertices = vertices.into();
        let centroid = centroid_of(&vertices)?;
        vertices.translate(-centroid);
        let placement = GeomPlacement::with_grid_size(collision_grid_size);
        let geom = simulator.create_geom(body, vertices, placement)?;
        simulator.add(geom)?;
        Ok(geom)
    }

    /// Copies a geom to a body without adding it. See [`TwoHalfPhysicsSimulator::clone_geom`].
    ///
    /// # Errors
    /// A stale id; a geom whose AABB would not be finite at the body.
    #[doc(alias = "CreateGeom(Body, TwoHalfGeom)")]
    pub fn create_geom(
        simulator: &mut TwoHalfPhysicsSimulator,
        body: BodyId,
        geometry: GeomId,
    ) -> Result<GeomId> {
        simulator.clone_geom(body, geometry)
    }

    /// Copies a geom to a body and adds it.
    ///
    /// # Errors
    /// The errors of [`create_geom`](Self::create_geom).
    #[doc(alias = "CreateGeom(PhysicsSimulator, Body, TwoHalfGeom)")]
    pub fn create_geom_in(
        simulator: &mut TwoHalfPhysicsSimulator,
        body: BodyId,
        geometry: GeomId,
    ) -> Result<GeomId> {
        let geom = simulator.clone_geom(body, geometry)?;
        simulator.add(geom)?;
        Ok(geom)
    }

    /// A box as deep as its shorter side; [`TwoHalfPhysicsSimulator::set_depth_profile`] sets another depth.
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

fn check_edges(number_of_edges: i32) -> Result<()> {
    if number_of_edges < 3 {
        return Err(Error::invalid("number_of_edges", number_of_edges, "3 or more").into());
    }
    Ok(())
}

fn centroid_of(vertices: &Vertices) -> Result<Vector2> {
    let centroid = vertices.get_centroid();
    if centroid.x.is_finite() && centroid.y.is_finite() {
        Ok(centroid)
    } else {
        Err(Error::invalid("vertices", vertices, "a finite outline with an area").into())
    }
}

fn add(simulator: &mut TwoHalfPhysicsSimulator, body: BodyId, vertices: Vertices) -> Result<GeomId> {
    let geom = simulator.create_geom(body, vertices, GeomPlacement::default())?;
    simulator.add(geom)?;
    Ok(geom)
}
