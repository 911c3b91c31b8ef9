//! Joints.

use super::reader::{keys, tagged};
use farseer_core::math::Vector2;

/// A joint to create. Settings that are absent keep the engine's default.
#[derive(Debug, Clone, PartialEq)]
pub struct JointSpec {
    /// Its kind, with the bodies and values of the kind.
    pub kind: JointKind,
    /// The settings a script may set as well.
    pub settings: JointSettings,
    /// Whether it is added to the simulation at once.
    pub in_simulation: bool,
}

keys!(JointSpec { kind [flat], settings [flat], in_simulation [or true] });

/// Settings of a joint; not every joint has each.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct JointSettings {
    /// Softness coefficient, added to the inverse effective mass; a fraction of the impulse for angle joints.
    pub softness: Option<f32>,
    /// Share of the error that is removed in a step.
    pub bias_factor: Option<f32>,
    /// Error at which it breaks, in length units or radians.
    pub breakpoint: Option<f32>,
    /// Whether it acts.
    pub enabled: Option<bool>,
    /// Largest impulse, in kg * length units/s, or angular impulse, in kg * length units²/s.
    pub max_impulse: Option<f32>,
    /// Angle it holds, in radians.
    pub target_angle: Option<f32>,
    /// Distance it holds, in length units.
    pub target_distance: Option<f32>,
    /// Error that is not corrected, in length units or radians.
    pub slop: Option<f32>,
}

keys!(JointSettings {
    softness,
    bias_factor,
    breakpoint,
    enabled,
    max_impulse,
    target_angle,
    target_distance,
    slop,
});

/// Parts of a joint's geometry that a script may change.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct JointGeometry {
    /// Anchor in world coordinates.
    pub anchor: Option<Vector2>,
    /// Anchor on the first body.
    pub anchor1: Option<Vector2>,
    /// Anchor on the second body.
    pub anchor2: Option<Vector2>,
    /// Smallest distance, in length units.
    pub min: Option<f32>,
    /// Largest distance, in length units.
    pub max: Option<f32>,
    /// Smallest angle, in radians.
    pub lower_limit: Option<f32>,
    /// Largest angle, in radians.
    pub upper_limit: Option<f32>,
}

keys!(JointGeometry { anchor, anchor1, anchor2, min, max, lower_limit, upper_limit });

/// The joints. Bodies are given by index, angles in radians.
#[derive(Debug, Clone, PartialEq)]
pub enum JointKind {
    /// Two bodies share a point.
    Revolute {
        /// Index of the first body.
        body1: usize,
        /// Second body.
        body2: usize,
        /// The point in world coordinates.
        anchor: Vector2,
    },
    /// A body turns about a point of the world.
    FixedRevolute {
        /// Index of the body.
        body: usize,
        /// The point in world coordinates.
        anchor: Vector2,
    },
    /// Two points keep their distance.
    Pin {
        /// Index of the first body.
        body1: usize,
        /// Second body.
        body2: usize,
        /// Point on the first body.
        anchor1: Vector2,
        /// Point on the second body.
        anchor2: Vector2,
    },
    /// Two points keep their distance within limits.
    Slider {
        /// Index of the first body.
        body1: usize,
        /// Second body.
        body2: usize,
        /// Point on the first body.
        anchor1: Vector2,
        /// Point on the second body.
        anchor2: Vector2,
        /// Smallest distance, in length units.
        min: f32,
        /// Largest distance, in length units.
        max: f32,
    },
    /// Two bodies keep their angle.
    Angle {
        /// Index of the first body.
        body1: usize,
        /// Second body.
        body2: usize,
    },
    /// A body keeps its angle.
    FixedAngle {
        /// Index of the body.
        body: usize,
    },
    /// Two bodies keep their angle within limits.
    AngleLimit {
        /// Index of the first body.
        body1: usize,
        /// Second body.
        body2: usize,
        /// Smallest angle in radians.
        lower_limit: f32,
        /// Largest angle in radians.
        upper_limit: f32,
    },
    /// A body keeps its angle within limits.
    FixedAngleLimit {
        /// Index of the body.
        body: usize,
        /// Smallest angle in radians.
        lower_limit: f32,
        /// Largest angle in radians.
        upper_limit: f32,
    },
    /// Two bodies become one.
    Weld {
        /// Index of the first body.
        body1: usize,
        /// Second body.
        body2: usize,
        /// Where, in world coordinates.
        anchor: Vector2,
    },
}

tagged!(JointKind, "type" {
    "revolute" => Revolute { body1, body2, anchor },
    "fixed_revolute" => FixedRevolute { body, anchor },
    "pin" => Pin { body1, body2, anchor1, anchor2 },
    "slider" => Slider { body1, body2, anchor1, anchor2, min, max },
    "angle" => Angle { body1, body2 },
    "fixed_angle" => FixedAngle { body },
    "angle_limit" => AngleLimit { body1, body2, lower_limit, upper_limit },
    "fixed_angle_limit" => FixedAngleLimit { body, lower_limit, upper_limit },
    "weld" => Weld { body1, body2, anchor },
});
