//! Scenes of the 2.5D engine as plain data. Tests, benchmarks and examples build the same scenes.
//!
//! Lengths are px, times s, angles rad. Positions and velocities are of the world: X to the right, Y up, Z into the picture,
//! the ground at Y = 0. Rotation is about the depth axis, clockwise on the screen. Bodies have no drag.
//!
//! A scene also has the data from which the module `peers` builds it in another engine.

mod build;
mod crowds;
mod falls;
mod fields;
mod hits;
mod platforms;
mod ropes;
mod slopes;

pub use build::{build, build_with};
pub use crowds::{pile, traffic};
pub use falls::{ball_rolling, bounce, box_sliding, drop_onto_ground, throw_in_x_and_z, throw_onto_platform};
pub use fields::{deep_field, flying, standing, street};
pub use hits::{
    ball_against_box_edge, ball_against_box_front, balls_meeting_obliquely, box_pushed_into_box_along_z,
    row_of_three_hits,
};
pub use platforms::{
    against_every_side, against_sheared_side, ball_off_far_edge, box_off_near_edge, box_on_sliding_box,
    box_tipping_over_edge, shear_of_side, tilted_drop,
};
pub use ropes::{LINKS, ropes};
pub use slopes::{SLOPE_ROTATION, SLOPE_SINE_AND_COSINE, ball_rolling_down_slope, box_sliding_down_slope};

use farseer_core::math::Vector2;

/// Default length of a simulation step of the scenes in s.
pub const DT: f32 = 0.01;
/// Acceleration of gravity in the scenes in px/s², downwards.
pub const GRAVITY: f32 = 100.0;

/// Angle of the projected Z axis on the screen in degrees; 90 is straight up.
pub const SCREEN_ANGLE: i32 = 60;

/// A scene of the 2.5D engine: bodies, platforms, ropes, gravity and steps.
#[derive(Debug, Clone, PartialEq)]
pub struct DepthScene {
    /// Name of the scene, for reports.
    pub name: String,
    /// Acceleration of gravity in px/s², downwards.
    pub gravity: f32,
    /// Length of a simulation step in s.
    pub dt: f32,
    /// Number of steps of a run: by then the motion that the scene is about has happened.
    pub steps: usize,
    /// Friction and restitution of the plane Y = 0, for every object.
    pub ground: Surface,
    /// Bodies: movable ones, and static ones that are not platforms.
    pub objects: Vec<DepthObject>,
    /// Platforms: static boxes on which objects land.
    pub platforms: Vec<DepthPlatform>,
    /// Ropes. Each is a chain of indices into `objects`: the centres of two neighbours keep at most their initial
    /// distance. The objects of a rope do not collide with each other.
    pub ropes: Vec<Vec<usize>>,
}

/// Friction and restitution of a surface. Two surfaces in contact combine by the mean of their coefficients.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Surface {
    /// Friction coefficient, dimensionless, >= 0.
    pub friction: f32,
    /// Coefficient of restitution, dimensionless, 0 to 1.
    pub restitution: f32,
}

/// The shape of an object in three axes.
#[derive(Debug, Clone, PartialEq)]
pub enum DepthShape {
    /// A ball. About all three axes it has the moment of inertia of the 2D engine's disc, m r² / 2.
    Ball {
        /// Radius of the ball in px.
        radius: f32,
    },
    /// A box whose edges are parallel to the axes at rotation 0.
    Box {
        /// Extent along X, Y and Z in px, at rotation 0.
        size: [f32; 3],
    },
    /// A polygon in X and Y, extruded along Z.
    Polygon {
        /// Corners of the polygon relative to its centroid, px, in the axes of the 2D engine: x right, y down.
        outline: Vec<Vector2>,
        /// Extent of the prism along Z in px.
        depth: f32,
    },
}

/// An object of a scene: a body with one shape, movable or static.
#[derive(Debug, Clone, PartialEq)]
pub struct DepthObject {
    /// Shape of the object.
    pub shape: DepthShape,
    /// Mass of the object in kg.
    pub mass: f32,
    /// Friction and restitution of the object.
    pub surface: Surface,
    /// X and Z of the object's origin and Y of the object's lowest point, px.
    pub position: [f32; 3],
    /// Velocity along X, Y (up) and Z, px/s.
    pub velocity: [f32; 3],
    /// Rotation about the Z axis in radians, clockwise on the screen.
    pub rotation: f32,
    /// Whether the object is static: it never moves.
    pub is_static: bool,
}

impl DepthObject {
    /// Returns an object of mass 1 kg at rest, without friction and restitution. `position` is X and Z of the origin
    /// and Y of the lowest point, px.
    pub fn new(shape: DepthShape, position: [f32; 3]) -> Self {
        DepthObject {
            shape,
            mass: 1.0,
            surface: Surface::default(),
            position,
            velocity: [0.0; 3],
            rotation: 0.0,
            is_static: false,
        }
    }

    /// Returns a ball of radius `radius` px, mass 1 kg, at rest, without friction and restitution. `position` is X and
    /// Z of the centre and Y of the lowest point, px.
    pub fn ball(radius: f32, position: [f32; 3]) -> Self {
        Self::new(DepthShape::Ball { radius }, position)
    }

    /// Returns a box of `size` px along X, Y and Z, mass 1 kg, at rest, without friction and restitution. `position` is
    /// X and Z of the centre and Y of the underside, px.
    pub fn new_box(size: [f32; 3], position: [f32; 3]) -> Self {
        Self::new(DepthShape::Box { size }, position)
    }

    /// Returns the object with a velocity along X, Y (up) and Z in px/s.
    pub fn with_velocity(mut self, velocity: [f32; 3]) -> Self {
        self.velocity = velocity;
        self
    }

    /// Returns the object with this friction and restitution.
    pub fn with_surface(mut self, surface: Surface) -> Self {
        self.surface = surface;
        self
    }

    /// Returns the object with a mass in kg.
    pub fn with_mass(mut self, mass: f32) -> Self {
        self.mass = mass;
        self
    }

    /// Returns the object with a rotation about the Z axis in radians. The lowest point keeps its height.
    pub fn with_rotation(mut self, rotation: f32) -> Self {
        self.rotation = rotation;
        self
    }

    /// Returns the object as a static one.
    pub fn fixed(mut self) -> Self {
        self.is_static = true;
        self
    }
}

/// A platform: a static box.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct DepthPlatform {
    /// Extent along X, Y and Z in px, at rotation 0.
    pub size: [f32; 3],
    /// X and Z of the platform's centre, and Y of the underside at rotation 0, px.
    pub position: [f32; 3],
    /// Rotation about the Z axis through the centre in radians, clockwise on the screen.
    pub rotation: f32,
    /// Direction on the screen, in degrees, of the platform's edges along Z.
    pub angle_in_z_axis: i32,
    /// Friction and restitution of the platform.
    pub surface: Surface,
}

impl DepthPlatform {
    /// Returns a level platform without shear. `size` is the extent along X, Y and Z in px; `position` is X and Z of
    /// the centre and Y of the underside, px.
    pub fn new(size: [f32; 3], position: [f32; 3], surface: Surface) -> Self {
        DepthPlatform { size, position, rotation: 0.0, angle_in_z_axis: SCREEN_ANGLE, surface }
    }
}

impl DepthScene {
    /// Returns a scene without objects, with gravity [`GRAVITY`] and steps of [`DT`]. `steps` is the number of steps,
    /// `ground` the surface of the plane Y = 0.
    pub fn empty(name: impl Into<String>, steps: usize, ground: Surface) -> Self {
        DepthScene {
            name: name.into(),
            gravity: GRAVITY,
            dt: DT,
            steps,
            ground,
            objects: Vec::new(),
            platforms: Vec::new(),
            ropes: Vec::new(),
        }
    }

    /// Returns the scene without gravity.
    pub fn weightless(mut self) -> Self {
        self.gravity = 0.0;
        self
    }

    /// Returns the scene with one more object, at the end of `objects`.
    pub fn with(mut self, object: DepthObject) -> Self {
        self.objects.push(object);
        self
    }

    /// Returns the scene with one more platform, at the end of `platforms`.
    pub fn with_platform(mut self, platform: DepthPlatform) -> Self {
        self.platforms.push(platform);
        self
    }
}
