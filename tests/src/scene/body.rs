//! Bodies.

use super::Outline;
use super::reader::{keys, tagged};
use farseer_core::math::Vector2;

/// A body to create. Settings that are absent keep the engine's default.
#[derive(Debug, Clone, PartialEq)]
pub struct BodySpec {
    /// Which factory makes it.
    pub shape: BodyShape,
    /// Whether it never moves.
    pub is_static: Option<bool>,
    /// Position of its centre of mass, in length units.
    pub position: Option<Vector2>,
    /// Angle in radians.
    pub rotation: Option<f32>,
    /// The settings a script may set as well.
    pub settings: BodySettings,
    /// Whether it is added to the simulation at once.
    pub in_simulation: bool,
}

keys!(BodySpec {
    shape,
    is_static [= "static"],
    position,
    rotation,
    settings [flat],
    in_simulation [or true],
});

impl BodySpec {
    /// A body with every setting at the engine's default, added at once.
    pub fn new(shape: BodyShape) -> Self {
        BodySpec {
            shape,
            is_static: None,
            position: None,
            rotation: None,
            settings: BodySettings::default(),
            in_simulation: true,
        }
    }
}

/// Settings of a body.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct BodySettings {
    /// In length units per second.
    pub linear_velocity: Option<Vector2>,
    /// In radians per second.
    pub angular_velocity: Option<f32>,
    /// Drag force per speed, in kg/s.
    pub linear_drag: Option<f32>,
    /// Drag torque per squared angular speed, in kg * length units².
    pub rotational_drag: Option<f32>,
    /// Whether drag grows with the square of the speed.
    pub quadratic_drag_enabled: Option<bool>,
    /// Drag force per squared speed, in kg per length unit.
    pub quadratic_drag: Option<f32>,
    /// Whether gravity leaves the body alone.
    pub ignore_gravity: Option<bool>,
    /// Whether the body is enabled.
    pub enabled: Option<bool>,
    /// Whether an inactivity controller may put it to sleep.
    pub auto_idle: Option<bool>,
    /// Speed under which it may sleep, in length units per second.
    pub minimum_velocity: Option<f32>,
}

keys!(BodySettings {
    linear_velocity,
    angular_velocity,
    linear_drag,
    rotational_drag,
    quadratic_drag_enabled,
    quadratic_drag,
    ignore_gravity,
    enabled,
    auto_idle,
    minimum_velocity,
});

/// The body factory's methods. Lengths in length units, masses in kg.
#[derive(Debug, Clone, PartialEq)]
pub enum BodyShape {
    /// A body with a rectangle's moment of inertia.
    Rectangle {
        /// Extent along x in length units.
        width: f32,
        /// Extent along y in length units.
        height: f32,
        /// Mass in kg.
        mass: f32,
    },
    /// A body with a circle's moment of inertia.
    Circle {
        /// Radius in length units.
        radius: f32,
        /// Mass in kg.
        mass: f32,
    },
    /// A body with an ellipse's moment of inertia.
    Ellipse {
        /// Half extent along x in length units.
        x_radius: f32,
        /// Half extent along y in length units.
        y_radius: f32,
        /// Mass in kg.
        mass: f32,
    },
    /// A body with a polygon's moment of inertia, positioned at the polygon's centroid.
    Polygon {
        /// The polygon.
        outline: Outline,
        /// Mass in kg.
        mass: f32,
    },
    /// A body with a given moment of inertia.
    Explicit {
        /// Mass in kg.
        mass: f32,
        /// Moment of inertia in kg times squared length units.
        moment_of_inertia: f32,
    },
    /// A copy of another body.
    Clone {
        /// Index of the body that is copied.
        of: usize,
    },
}

tagged!(BodyShape, "type" {
    "rectangle" => Rectangle { width, height, mass },
    "circle" => Circle { radius, mass },
    "ellipse" => Ellipse { x_radius, y_radius, mass },
    "polygon" => Polygon { outline, mass },
    "explicit" => Explicit { mass, moment_of_inertia },
    "clone" => Clone { of },
});
