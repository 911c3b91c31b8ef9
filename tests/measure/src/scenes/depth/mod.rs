//! Scenes of the 2.5D engine as plain data, one place for each: tests, benchmarks and examples build the same.
//!
//! Lengths are px, times s, angles rad. Positions and velocities are of the world: X to the right, Y up, Z into
//! the picture, the ground at Y = 0. Rotation is about the depth axis, clockwise on the screen. Nothing has drag.
//!
//! A scene also says what another engine needs to build it, see `peers`.

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

/// Length of a step of the scenes in s.
pub const DT: f32 = 0.01;
/// Gravity of the scenes in px/s², downwards.
pub const GRAVITY: f32 = 100.0;

/// Direction of the Z axis on the screen in degrees.
pub const SCREEN_ANGLE: i32 = 60;

/// A scene of the 2.5D engine.
#[derive(Debug, Clone, PartialEq)]
pub struct DepthScene {
    /// Its name, for reports.
    pub name: String,
    /// Acceleration in px/s², downwards.
    pub gravity: f32,
    /// Length of a step in s.
    pub dt: f32,
    /// Number of steps after which the scene has shown what it is for.
    pub steps: usize,
    /// Coefficients of the plane Y = 0, the same for every object.
    pub ground: Surface,
    /// What moves, and what is fixed and no platform.
    pub objects: Vec<DepthObject>,
    /// What things land on.
    pub platforms: Vec<DepthPlatform>,
    /// Chains of objects, as indices into `objects`: the centres of each two that follow each other keep at most the distance
    /// that they have at first. The objects of a rope do not collide with each other.
    pub ropes: Vec<Vec<usize>>,
}

/// How something rubs and bounces. Two surfaces that meet act with the mean of their coefficients.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Surface {
    /// Friction, 0 or more.
    pub friction: f32,
    /// Restitution, 0 to 1.
    pub restitution: f32,
}

/// The shape of an object.
#[derive(Debug, Clone, PartialEq)]
pub enum DepthShape {
    /// A ball with the moment of inertia of the 2D engine's disc, m r² / 2, about all three axes.
    Ball {
        /// Radius in px.
        radius: f32,
    },
    /// A box.
    Box {
        /// Extent along X, Y and Z in px, at rotation 0.
        size: [f32; 3],
    },
    /// An extruded polygon.
    Polygon {
        /// Outline about its centroid, px, in the axes of the 2D engine: x right, y down.
        outline: Vec<Vector2>,
        /// Extent along Z in px.
        depth: f32,
    },
}

/// An object.
#[derive(Debug, Clone, PartialEq)]
pub struct DepthObject {
    /// Its shape.
    pub shape: DepthShape,
    /// Mass.
    pub mass: f32,
    /// Its coefficients.
    pub surface: Surface,
    /// X and Z of the origin and Y of the lowest point, px.
    pub position: [f32; 3],
    /// Velocity along X, up and along Z, px/s.
    pub velocity: [f32; 3],
    /// Rotation in rad.
    pub rotation: f32,
    /// Whether nothing moves it.
    pub is_static: bool,
}

impl DepthObject {
    /// An object of mass 1 at rest that neither rubs nor bounces.
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

    /// A ball, see [`new`](Self::new).
    pub fn ball(radius: f32, position: [f32; 3]) -> Self {
        Self::new(DepthShape::Ball { radius }, position)
    }

    /// A box, see [`new`](Self::new).
    pub fn new_box(size: [f32; 3], position: [f32; 3]) -> Self {
        Self::new(DepthShape::Box { size }, position)
    }

    /// Sets the velocity along X, up and along Z in px/s.
    pub fn with_velocity(mut self, velocity: [f32; 3]) -> Self {
        self.velocity = velocity;
        self
    }

    /// Sets the coefficients.
    pub fn with_surface(mut self, surface: Surface) -> Self {
        self.surface = surface;
        self
    }

    /// Sets the mass.
    pub fn with_mass(mut self, mass: f32) -> Self {
        self.mass = mass;
        self
    }

    /// Sets the rotation in rad; the lowest point stays at its height.
    pub fn with_rotation(mut self, rotation: f32) -> Self {
        self.rotation = rotation;
        self
    }

    /// Makes it immovable.
    pub fn fixed(mut self) -> Self {
        self.is_static = true;
        self
    }
}

/// A platform: a box that stays where it is.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct DepthPlatform {
    /// Extent along X, Y and Z in px, at rotation 0.
    pub size: [f32; 3],
    /// X and Z of the box's centre and Y of its underside when level, px.
    pub position: [f32; 3],
    /// Rotation about the centre in rad.
    pub rotation: f32,
    /// Direction of its edges in depth on the screen in degrees.
    pub angle_in_z_axis: i32,
    /// Its coefficients.
    pub surface: Surface,
}

impl DepthPlatform {
    /// A level, straight platform with the coefficients of a surface.
    pub fn new(size: [f32; 3], position: [f32; 3], surface: Surface) -> Self {
        DepthPlatform { size, position, rotation: 0.0, angle_in_z_axis: SCREEN_ANGLE, surface }
    }
}

impl DepthScene {
    /// A scene without objects, with the gravity and the step of all scenes.
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

    /// Without gravity.
    pub fn weightless(mut self) -> Self {
        self.gravity = 0.0;
        self
    }

    /// With one more object.
    pub fn with(mut self, object: DepthObject) -> Self {
        self.objects.push(object);
        self
    }

    /// With one more platform.
    pub fn with_platform(mut self, platform: DepthPlatform) -> Self {
        self.platforms.push(platform);
        self
    }
}
