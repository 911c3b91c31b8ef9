//! Surface coefficients of two geoms, and how they combine.

use serde::{Deserialize, Serialize};

/// Rule for combining the friction coefficients of two geoms.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Default, Serialize, Deserialize)]
pub enum FrictionType {
    /// The mean of both.
    #[default]
    Average,
    /// The smaller one.
    Minimum,
}

/// Combines the friction coefficients of two geoms.
#[inline]
pub fn mix_friction(rule: FrictionType, a: f32, b: f32) -> f32 {
    match rule {
        FrictionType::Average => (a + b) / 2.0,
        FrictionType::Minimum => crate::math::scalar::min(a, b),
    }
}

/// Surface coefficients of an object that is no geom of the core.
#[derive(Debug, Clone, Copy, PartialEq, Default, Serialize, Deserialize)]
pub struct SurfaceCoefficients {
    /// Friction coefficient, dimensionless, finite; combined with that of the other object. Default 0.
    pub friction: f32,
    /// Restitution coefficient, dimensionless, finite, usually 0 to 1; the mean of both acts. Default 0.
    pub restitution: f32,
}

/// Surface coefficients that a handler has set for two touching geoms, for one update.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct SurfaceOverride {
    /// Friction coefficient, dimensionless; `None` for that of the geoms.
    pub friction: Option<f32>,
    /// Restitution coefficient, dimensionless; `None` for that of the geoms.
    pub restitution: Option<f32>,
    /// Speed of the surface along the contact's tangent, length units/s; `None` for that of the geoms.
    pub tangent_speed: Option<f32>,
}

/// Combines the restitution coefficients of two geoms: their mean.
#[inline]
pub fn mix_restitution(a: f32, b: f32) -> f32 {
    (a + b) * 0.5
}
