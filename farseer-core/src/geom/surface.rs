//! How the surfaces of two geoms combine.

use serde::{Deserialize, Serialize};

/// How the friction coefficients of two geoms combine.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Default, Serialize, Deserialize)]
pub enum FrictionType {
    /// The mean of both.
    #[default]
    Average,
    /// The smaller one.
    Minimum,
}

impl FrictionType {
    pub(crate) fn mix(self, a: f32, b: f32) -> f32 {
        match self {
            FrictionType::Average => (a + b) / 2.0,
            FrictionType::Minimum => crate::math::scalar::min(a, b),
        }
    }
}

/// How something rubs and bounces that is no geom of the core.
#[derive(Debug, Clone, Copy, PartialEq, Default, Serialize, Deserialize)]
pub struct SurfaceCoefficients {
    /// Friction, finite; combined with the partner's. Default 0.
    pub friction: f32,
    /// Bounciness, finite, usually 0 to 1; the mean of both partners acts. Default 0.
    pub restitution: f32,
}

/// What a handler has set about the surfaces of two geoms that touch, for one update.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub(crate) struct SetSurface {
    pub(crate) friction: Option<f32>,
    pub(crate) restitution: Option<f32>,
    pub(crate) tangent_speed: Option<f32>,
}

/// How the restitution coefficients of two geoms combine: their mean.
#[inline]
pub(crate) fn mix_restitution(a: f32, b: f32) -> f32 {
    (a + b) * 0.5
}
