//! Narrow phase: friction, restitution and rolling resistance of a pair from the surfaces of both geoms.

use crate::broad_phase::proxies::Proxy;
use crate::surface::{FrictionType, mix_friction, mix_restitution};

/// Returns the combined friction coefficient of two proxies, dimensionless, at most [`f32::MAX`]. `default`: rule of the simulator,
/// for geoms without a rule.
pub(crate) fn friction_of(default: FrictionType, a: &Proxy, b: &Proxy) -> f32 {
    let friction = match a.surface.friction_rule.max(b.surface.friction_rule) {
        None => mix_friction(default, a.friction, b.friction),
        Some(rule) => rule.combine(a.friction, b.friction),
    };
    // The coefficient of very large ones may overflow.
    friction.min(f32::MAX)
}

/// Returns the combined restitution coefficient of two proxies, dimensionless and finite.
pub(crate) fn restitution_of(a: &Proxy, b: &Proxy) -> f32 {
    let restitution = match a.surface.restitution_rule.max(b.surface.restitution_rule) {
        None => mix_restitution(a.restitution, b.restitution),
        Some(rule) => rule.combine(a.restitution, b.restitution),
    };
    restitution.clamp(f32::MIN, f32::MAX)
}

/// Returns the lever arm of rolling resistance between two proxies, length units, >= 0: its torque is at most this arm times the
/// normal force. The rule for two materials and radii is that of Box2D 3 (E. Catto, `b2UpdateContact`).
pub(crate) fn rolling_arm_of(a: &Proxy, b: &Proxy) -> f32 {
    let coefficient = a.surface.rolling_resistance.max(b.surface.rolling_resistance);
    (coefficient * a.shape.radius.max(b.shape.radius)).min(f32::MAX)
}
