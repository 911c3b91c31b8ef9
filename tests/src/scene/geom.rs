//! Geoms.

use super::Outline;
use super::reader::{keys, tagged};
use farseer_core::math::Vector2;

/// A geom (or the geoms of a decomposition) to create. Settings that are absent keep the engine's default.
#[derive(Debug, Clone, PartialEq)]
pub struct GeomSpec {
    /// Index of the body that carries it.
    pub body: usize,
    /// Which factory makes it.
    pub shape: GeomShape,
    /// Position on the body, in length units.
    pub offset: Option<Vector2>,
    /// Angle on the body, in radians.
    pub rotation_offset: Option<f32>,
    /// Cell size of the distance grid in length units, 0 for automatic.
    pub collision_grid_size: Option<f32>,
    /// The settings a script may set as well.
    pub settings: GeomSettings,
    /// Ids of geoms it does not collide with.
    pub ignore: Vec<usize>,
    /// Ids of geoms for which its collision callback returns false.
    pub veto: Vec<usize>,
    /// Whether it is added to the simulation at once.
    pub in_simulation: bool,
}

keys!(GeomSpec {
    body,
    shape,
    offset,
    rotation_offset,
    collision_grid_size,
    settings [flat],
    ignore [or Vec::new()],
    veto [or Vec::new()],
    in_simulation [or true],
});

impl GeomSpec {
    /// A geom with every setting at the engine's default, added at once.
    pub fn new(body: usize, shape: GeomShape) -> Self {
        GeomSpec {
            body,
            shape,
            offset: None,
            rotation_offset: None,
            collision_grid_size: None,
            settings: GeomSettings::default(),
            ignore: Vec::new(),
            veto: Vec::new(),
            in_simulation: true,
        }
    }
}

/// Settings of a geom.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct GeomSettings {
    /// Friction coefficient.
    pub friction: Option<f32>,
    /// Coefficient of restitution.
    pub restitution: Option<f32>,
    /// Number of the collision group: geoms of one group other than 0 do not collide.
    pub collision_group: Option<i32>,
    /// Categories it belongs to, one per bit.
    pub collision_categories: Option<i32>,
    /// Categories it collides with, one per bit.
    pub collides_with: Option<i32>,
    /// Whether it collides at all.
    pub collision_enabled: Option<bool>,
    /// Whether collisions have an effect.
    pub collision_response_enabled: Option<bool>,
    /// Whether it is a sensor.
    pub sensor: Option<bool>,
}

keys!(GeomSettings {
    friction,
    restitution,
    collision_group,
    collision_categories,
    collides_with,
    collision_enabled,
    collision_response_enabled,
    sensor,
});

/// The geom factory's methods and the constructor. Lengths in length units.
#[derive(Debug, Clone, PartialEq)]
pub enum GeomShape {
    /// A rectangle.
    Rectangle {
        /// Extent along x in length units.
        width: f32,
        /// Extent along y in length units.
        height: f32,
    },
    /// A regular polygon.
    Circle {
        /// Radius in length units.
        radius: f32,
        /// Number of edges.
        edges: i32,
    },
    /// An ellipse.
    Ellipse {
        /// Half extent along x in length units.
        x_radius: f32,
        /// Half extent along y in length units.
        y_radius: f32,
        /// Number of edges.
        edges: i32,
    },
    /// A polygon, moved so that its centroid is the origin.
    Polygon {
        /// The polygon.
        outline: Outline,
    },
    /// A polygon as it is.
    Raw {
        /// The polygon.
        outline: Outline,
    },
    /// A polygon cut into convex geoms; offset, rotation offset and grid size are not used.
    Decomposed {
        /// The polygon.
        outline: Outline,
        /// Largest number of geoms.
        pieces: i32,
    },
    /// A copy of another geom.
    Clone {
        /// Id of the geom that is copied.
        of: usize,
    },
}

tagged!(GeomShape, "type" {
    "rectangle" => Rectangle { width, height },
    "circle" => Circle { radius, edges },
    "ellipse" => Ellipse { x_radius, y_radius, edges },
    "polygon" => Polygon { outline },
    "raw" => Raw { outline },
    "decomposed" => Decomposed { outline, pieces },
    "clone" => Clone { of },
});
