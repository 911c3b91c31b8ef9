//! Bodies from pictures: the outline is that of the opaque part of a texture.

use twohalf::farseer_core::math::Vector2;
use twohalf::farseer_core::shape::{PolygonCreationAssistance, Vertices};
use twohalf::farseer_core::{BodyFactory, GeomFactory, GeomPlacement, Objects};
use twohalf::{BodyId, DepthProfile, GeomId, TwoHalfPhysicsSimulator};

use crate::{Point, RenderError, Result, Sprite, Texture2D};

/// Options of the tracing of a picture's outline.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Tracing {
    /// Least alpha of a pixel of the object, 0 to 255, dimensionless. Default 20.
    #[doc(alias = "AlphaTolerance")]
    pub alpha_tolerance: u8,
    /// Greatest distance of the outline from the edge of the picture, px: a greater one gives fewer corners.
    /// Default 1.5.
    #[doc(alias = "HullTolerance")]
    pub hull_tolerance: f32,
    /// Greatest length of an edge, px; longer ones are divided. The faithful set needs it, since its contacts
    /// are corners. `None` keeps the edges, which is enough for the precise set and faster. Default 10.
    #[doc(alias = "SubDivideEdges")]
    pub max_edge_length: Option<f32>,
    /// Edge of a cell of the distance grid, px; 0 is the engine's default. The faithful set needs it. Default
    /// 0.
    pub collision_grid_size: f32,
}

impl Default for Tracing {
    fn default() -> Self {
        Tracing {
            alpha_tolerance: 20,
            hull_tolerance: 1.5,
            max_edge_length: Some(10.0),
            collision_grid_size: 0.0,
        }
    }
}

/// A body made from a picture, with its picture.
///
/// ```
/// # use twohalf_render::{Color, PictureBody, SoftwareCanvas, SpriteBatch, Texture2D, Tracing};
/// # use twohalf::farseer_core::{PhysicsSimulator, math::Vector2};
/// let mut simulator = PhysicsSimulator::new(Vector2::new(0.0, 100.0))?;
/// let ball = Texture2D::ball(40, Color::rgb(200, 40, 40))?;
/// let thing = PictureBody::create_in(&mut simulator, &ball, 1.0, &Tracing::default())?;
/// simulator[thing.body].set_position(Vector2::new(100.0, 50.0));
/// simulator.update(0.01);
///
/// let mut batch = SpriteBatch::begin();
/// let body = &simulator[thing.body];
/// batch.draw(thing.sprite(body.position(), body.rotation()));
/// batch.end(&mut SoftwareCanvas::new(320, 200)?);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Debug, Clone)]
pub struct PictureBody {
    /// The body, its origin at the centroid of the outline; at (0, 0), or (0, 0, 0) of a world with depth.
    pub body: BodyId,
    /// Its geom.
    pub geom: GeomId,
    /// The picture.
    pub texture: Texture2D,
    /// The point of the picture that lies at the body's origin, px from its upper left corner.
    pub origin: Point,
}

impl PictureBody {
    /// Adds a body of this mass (kg), and a geom with the outline of the first object in the picture,
    /// searched row by row. The outline runs through the middles of the outermost px.
    ///
    /// # Errors
    /// A picture without an object of at least three corners; a mass, tolerance, edge length or cell size out
    /// of range. A failed call adds nothing.
    #[doc(alias = "CreatePolygon")]
    pub fn create_in(
        simulator: &mut Objects,
        texture: &Texture2D,
        mass: f32,
        tracing: &Tracing,
    ) -> Result<Self> {
        let Outline { mut vertices, origin } = Outline::of(texture, tracing)?;
        let body = BodyFactory::create_polygon_body_in(simulator, &vertices, mass)?;
        let placement = GeomPlacement::with_grid_size(tracing.collision_grid_size);
        match GeomFactory::create_polygon_geom_in(simulator, body, &mut vertices, placement) {
            Ok(geom) => Ok(PictureBody { body, geom, texture: texture.clone(), origin }),
            Err(error) => {
                simulator.dispose(body)?;
                Err(error.into())
            }
        }
    }

    /// The same in a world with depth: a prism that is `depth` px deep, with its lowest point on the ground.
    ///
    /// # Errors
    /// The errors of [`create_in`](Self::create_in), or a depth that is not finite and 0 or more. A failed call
    /// adds nothing.
    pub fn create_in_depth(
        simulator: &mut TwoHalfPhysicsSimulator,
        texture: &Texture2D,
        mass: f32,
        depth: f32,
        tracing: &Tracing,
    ) -> Result<Self> {
        let Outline { vertices, origin } = Outline::of(texture, tracing)?;
        let body = simulator.create_body(BodyFactory::create_polygon_body(&vertices, mass)?);
        let placement = GeomPlacement::with_grid_size(tracing.collision_grid_size);
        match add_prism(simulator, body, vertices, placement, depth) {
            Ok(geom) => Ok(PictureBody { body, geom, texture: texture.clone(), origin }),
            Err(error) => {
                simulator.dispose(body)?;
                Err(error.into())
            }
        }
    }

    /// The sprite of the body: at a position of its origin on the screen, px, rotated by `rotation` radians.
    pub fn sprite(&self, position: impl Into<Point>, rotation: f32) -> Sprite {
        Sprite { origin: self.origin, rotation, ..Sprite::new(&self.texture, position) }
    }
}

fn add_prism(
    simulator: &mut TwoHalfPhysicsSimulator,
    body: BodyId,
    vertices: Vertices,
    placement: GeomPlacement,
    depth: f32,
) -> twohalf::Result<GeomId> {
    simulator.add(body)?;
    let geom = simulator.create_geom(body, vertices, placement)?;
    simulator.set_depth_profile(geom, DepthProfile::Prism { depth })?;
    simulator.add(geom)?;
    if let Some(mut body) = simulator.body_mut(body) {
        body.ground_mut().set_object_geom(geom, None)?;
        body.set_position3d(twohalf::Vector3::zeros());
    }
    Ok(geom)
}

/// The outline of an object in a picture about its centroid, and the place of the centroid in the picture.
struct Outline {
    vertices: Vertices,
    origin: Point,
}

impl Outline {
    fn of(texture: &Texture2D, tracing: &Tracing) -> Result<Self> {
        let mut picture =
            PolygonCreationAssistance::from_rgba(texture.rgba8(), texture.width(), texture.height())?;
        picture.set_alpha_tolerance(tracing.alpha_tolerance);
        picture.set_hull_tolerance(tracing.hull_tolerance)?;
        let first = Vertices::create_polygons(&picture)?.into_iter().next();
        let mut vertices = first.ok_or_else(|| {
            let value = format!("{texture:?} without an outline");
            RenderError::invalid("texture", value, "a picture with something opaque of three corners or more")
        })?;
        vertices.force_counter_clockwise_order();
        let centroid = vertices.get_centroid();
        vertices.translate(-centroid);
        if let Some(length) = tracing.max_edge_length {
            vertices.sub_divide_edges(length)?;
        }
        // Corners are px; the middle of a px is half a px from its corner.
        let middle: Vector2 = centroid + Vector2::new(0.5, 0.5);
        Ok(Outline { vertices, origin: middle.into() })
    }
}
