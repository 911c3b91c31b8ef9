//! Chains and tracks.

use super::reader::{keys, tagged, words};
use farseer_core::math::Vector2;

/// A chain or track to create, added to the simulation by its factory.
#[derive(Debug, Clone, PartialEq)]
pub struct PathSpec {
    /// Its kind, with the values of the kind.
    pub kind: PathKind,
    /// The kind of joint or spring between its elements.
    pub link: Link,
    /// Smallest distance of slider links, in length units.
    pub min: f32,
    /// Largest distance of slider links, in length units.
    pub max: f32,
    /// Spring constant of spring links, force per length.
    pub spring_constant: f32,
    /// Damping constant of spring links, in kg/s.
    pub damping_constant: f32,
    /// Fraction of the distance that is a spring link's rest length.
    pub rest_length_factor: f32,
    /// Friction coefficient of its geoms.
    pub friction: Option<f32>,
    /// Coefficient of restitution of its geoms.
    pub restitution: Option<f32>,
}

keys!(PathSpec {
    kind [flat],
    link,
    min [or 0.0],
    max [or 0.0],
    spring_constant [or 0.0],
    damping_constant [or 0.0],
    rest_length_factor [or 1.0],
    friction,
    restitution,
});

/// The joints or springs between the elements of a path.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Link {
    /// Revolute joints.
    Revolute,
    /// Pin joints.
    Pin,
    /// Slider joints.
    Slider,
    /// Linear springs.
    LinearSpring,
}

words!(Link {
    "revolute" => Revolute,
    "pin" => Pin,
    "slider" => Slider,
    "linear_spring" => LinearSpring,
});

/// The two kinds of path. Lengths in length units, masses in kg.
#[derive(Debug, Clone, PartialEq)]
pub enum PathKind {
    /// A chain between two points.
    Chain {
        /// First point.
        start: Vector2,
        /// Last point.
        end: Vector2,
        /// Width of an element in length units.
        width: f32,
        /// Height of an element in length units.
        height: f32,
        /// Distance of the links in length units; default the width.
        link_width: Option<f32>,
        /// Mass of an element in kg.
        mass: f32,
        /// Whether the first element is pinned to the world.
        pin_start: bool,
        /// Whether the last element is pinned to the world.
        pin_end: bool,
        /// Geoms made for its elements.
        geoms: Option<PathGeoms>,
    },
    /// A track along points.
    Track {
        /// The points.
        points: Vec<Vector2>,
        /// Width of an element in length units.
        width: f32,
        /// Height of an element in length units.
        height: f32,
        /// Mass of an element in kg.
        mass: f32,
        /// Whether the last element is linked to the first.
        endless: bool,
        /// Number of the collision group of its geoms.
        collision_group: i32,
    },
}

tagged!(PathKind, "type" {
    "chain" => Chain { start, end, width, height, link_width, mass, pin_start, pin_end, geoms },
    "track" => Track { points, width, height, mass, endless, collision_group },
});

/// Geoms of a chain's elements: one group, or masks.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct PathGeoms {
    /// Number of the collision group.
    pub collision_group: Option<i32>,
    /// Categories they belong to, one per bit.
    pub collision_categories: Option<i32>,
    /// Categories they collide with, one per bit.
    pub collides_with: Option<i32>,
}

keys!(PathGeoms { collision_group, collision_categories, collides_with });
