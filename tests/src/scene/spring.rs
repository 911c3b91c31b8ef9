//! Springs.

use super::reader::{keys, tagged};
use farseer_core::math::Vector2;

/// A spring to create. Settings that are absent keep the engine's default.
#[derive(Debug, Clone, PartialEq)]
pub struct SpringSpec {
    /// Its kind, with the bodies and values of the kind.
    pub kind: SpringKind,
    /// Force per length or torque per radian.
    pub spring_constant: f32,
    /// Force per speed in kg/s, or torque per angular speed in kg * length units²/s.
    pub damping_constant: f32,
    /// The settings a script may set as well.
    pub settings: SpringSettings,
    /// Whether it is added to the simulation at once.
    pub in_simulation: bool,
}

keys!(SpringSpec {
    kind [flat],
    spring_constant,
    damping_constant,
    settings [flat],
    in_simulation [or true],
});

/// Settings of a spring; not every spring has each.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct SpringSettings {
    /// Error at which it breaks, in length units or radians.
    pub breakpoint: Option<f32>,
    /// Whether it acts.
    pub enabled: Option<bool>,
    /// Length without force, in length units.
    pub rest_length: Option<f32>,
    /// Angle without torque, in radians.
    pub target_angle: Option<f32>,
    /// Largest torque, in kg * length units²/s².
    pub max_torque: Option<f32>,
    /// Factor of the torque.
    pub torque_multiplier: Option<f32>,
}

keys!(SpringSettings { breakpoint, enabled, rest_length, target_angle, max_torque, torque_multiplier });

/// Parts of a spring that a script may change before its settings.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct SpringGeometry {
    /// Force per length or torque per radian.
    pub spring_constant: Option<f32>,
    /// Force per speed in kg/s, or torque per angular speed in kg * length units²/s.
    pub damping_constant: Option<f32>,
    /// Point of the world.
    pub world_attach_point: Option<Vector2>,
    /// Point on the body.
    pub body_attach_point: Option<Vector2>,
    /// Point on the first body.
    pub attach_point1: Option<Vector2>,
    /// Point on the second body.
    pub attach_point2: Option<Vector2>,
}

keys!(SpringGeometry {
    spring_constant,
    damping_constant,
    world_attach_point,
    body_attach_point,
    attach_point1,
    attach_point2,
});

/// The springs. Bodies are given by index.
#[derive(Debug, Clone, PartialEq)]
pub enum SpringKind {
    /// Between points of two bodies.
    Linear {
        /// Index of the first body.
        body1: usize,
        /// Second body.
        body2: usize,
        /// Point on the first body.
        attach_point1: Vector2,
        /// Point on the second body.
        attach_point2: Vector2,
    },
    /// Between a point of a body and one of the world.
    FixedLinear {
        /// Index of the body.
        body: usize,
        /// Point on the body.
        body_attach_point: Vector2,
        /// Point of the world.
        world_attach_point: Vector2,
    },
    /// Between the angles of two bodies.
    Angle {
        /// Index of the first body.
        body1: usize,
        /// Second body.
        body2: usize,
    },
    /// Between a body's angle and the world.
    FixedAngle {
        /// Index of the body.
        body: usize,
    },
}

tagged!(SpringKind, "type" {
    "linear" => Linear { body1, body2, attach_point1, attach_point2 },
    "fixed_linear" => FixedLinear { body, body_attach_point, world_attach_point },
    "angle" => Angle { body1, body2 },
    "fixed_angle" => FixedAngle { body },
});
