//! Narrow phase: friction, restitution and rolling resistance of a pair from the surfaces of both geoms.

use crate::broad_phase::proxies::Proxy;
use crate::surface::{CombinationRule, FrictionType, mix_friction, mix_restitution};

/// Returns the combined friction coefficient of two proxies, dimensionless, at most [`f32::MAX`]. `default`: rule of the simulator,
/// for geoms without a rule.
#[inline]
pub(crate) fn friction_of(default: FrictionType, a: &Proxy, b: &Proxy) -> f32 {
    let friction = match [a.surface.friction_rule, b.surface.friction_rule] {
        [None, None] => mix_friction(default, a.friction, b.friction),
        rules => combine(rules, a.friction, b.friction),
    };
    // The coefficient of very large ones may overflow.
    friction.min(f32::MAX)
}

/// Returns the combined restitution coefficient of two proxies, dimensionless and finite.
#[inline]
pub(crate) fn restitution_of(a: &Proxy, b: &Proxy) -> f32 {
    let restitution = match [a.surface.restitution_rule, b.surface.restitution_rule] {
        [None, None] => mix_restitution(a.restitution, b.restitution),
        rules => combine(rules, a.restitution, b.restitution),
    };
    restitution.clamp(f32::MIN, f32::MAX)
}

/// Returns the coefficient that the later of two rules makes of `a` and `b`, dimensionless; the mean without rules.
#[inline(never)]
fn combine([rule_a, rule_b]: [Option<CombinationRule>; 2], a: f32, b: f32) -> f32 {
    rule_a.max(rule_b).unwrap_or(CombinationRule::Mean).combine(a, b)
}

/// Returns the lever arm of rolling resistance between two proxies, length units, >= 0: its torque is at most this arm times the
/// normal force. The rule for two materials and radii is that of Box2D 3 (E. Catto, `b2UpdateContact`).
pub(crate) fn rolling_arm_of(a: &Proxy, b: &Proxy) -> f32 {
    let coefficient = a.surface.rolling_resistance.max(b.surface.rolling_resistance);
    (coefficient * a.shape.radius.max(b.shape.radius)).min(f32::MAX)
}
