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

/// Rule for combining a coefficient of two geoms, such as friction or restitution.
///
/// Each geom may name a rule. Of two geoms the rule that comes later in this list acts. That order is the one of the enums
/// `CoefficientCombineRule` of rapier and `CoefficientCombine` of avian.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize, Deserialize)]
pub enum CombinationRule {
    /// The mean of both coefficients.
    Mean,
    /// The geometric mean of both coefficients: the root of their product; 0 if that is negative.
    GeometricMean,
    /// The smaller coefficient.
    Minimum,
    /// The product of both coefficients.
    Product,
    /// The larger coefficient.
    Maximum,
}

impl CombinationRule {
    /// Returns the combined coefficient of `a` and `b`, dimensionless.
    pub fn combine(self, a: f32, b: f32) -> f32 {
        match self {
            CombinationRule::Mean => (a + b) * 0.5,
            CombinationRule::GeometricMean => (a * b).max(0.0).sqrt(),
            CombinationRule::Minimum => crate::math::scalar::min(a, b),
            CombinationRule::Product => a * b,
            CombinationRule::Maximum => -crate::math::scalar::min(-a, -b),
        }
    }
}

/// Surface of a geom, beside its friction and restitution coefficients. The default has no effect. With the faithful set and in
/// engines with depth only the default is possible.
#[derive(Debug, Clone, Copy, PartialEq, Default, Serialize, Deserialize)]
pub struct SurfaceOptions {
    /// Rule for the friction coefficients of a pair. `None`: that of the other geom, else that of the simulator. Default `None`.
    pub friction_rule: Option<CombinationRule>,
    /// Rule for the restitution coefficients of a pair. `None`: that of the other geom, else the mean. Default `None`.
    pub restitution_rule: Option<CombinationRule>,
    /// Speed at which the surface moves along the outline, clockwise on a screen with y down, length units/s. So what lies on the
    /// upper side of a conveyor belt is carried to +x. Default 0.
    pub speed: f32,
    /// Coefficient of rolling resistance, dimensionless, >= 0. The torque against rolling is at most coefficient * radius *
    /// normal force. Of two geoms the larger coefficient acts, with the larger radius. Default 0.
    pub rolling_resistance: f32,
}

impl SurfaceOptions {
    /// Returns whether all numbers are finite, and the coefficient of rolling resistance is not negative.
    pub fn is_valid(&self) -> bool {
        let numbers = [self.speed, self.rolling_resistance];
        numbers.iter().all(|number| number.is_finite()) && self.rolling_resistance >= 0.0
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
