//! Parameters in the user's units ([`Parameters`]), and parameters of one step ([`StepContext`]). The dimensionless values are
//! in [`parameters`](super::parameters).
//!
//! Six of the values are Box2D 3.2's (E. Catto; `constants.h` and `b2DefaultWorldDef` in `types.c`), with the length unit in
//! place of Box2D's metre. The doubled frequency of contacts with static bodies is Box2D's too (`staticSoftness` in
//! `physics_world.c`). Two values differ: Box2D's contact frequency is 30 Hz and at most an eighth of the substep rate, and its
//! AABB margin is at most an eighth of the extent.

use crate::parameters::broad_phase::{
    AABB_MAX_MARGIN, AABB_MAX_MARGIN_PER_SIZE, AABB_MAX_PREDICTION_PER_SIZE, AABB_PREDICTED_STEPS,
    COLLISION_MAX_COORDINATE, UNPAIRED_AABB_MAX_PREDICTION_PER_SIZE, UNPAIRED_AABB_PREDICTED_STEPS,
};
use crate::parameters::contacts::{
    CONTACT_DAMPING_RATIO, CONTACT_FREQUENCY, GREATEST_SAG, JOINTED_CONTACT_FREQUENCY,
    JOINTED_CONTACT_FREQUENCY_PER_RATE, LOAD_ADAPTATION_MAX_SPEED, LOAD_FALL_PER_STEP,
    LOAD_ON_SPRING_FRACTION, LOAD_RISE_PER_STEP, PENETRATION_RECOVERY_MAX_SPEED, RECYCLING_DISTANCE,
    RESTITUTION_THRESHOLD, SEPARATION_REFRESH_DISTANCE, SPECULATIVE_DISTANCE, SUBSTEPS_PER_CONTACT_PERIOD,
};
use serde::{Deserialize, Serialize};
use wide::f32x4;

/// Parameters of contacts, in the user's units: each is a constant of [`parameters`](super::parameters) times the length unit.
/// The length unit is the `length_unit` of `Methods::Precise`, the size of things that a player looks at: 1
/// in a game in metres, 32 in one in px.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(rename = "Tuning")]
pub struct Parameters {
    /// Length unit, in the user's unit of length, > 0.
    #[serde(rename = "unit")]
    pub length_unit: f32,
    /// Speculative distance, user's length units, > 0: shapes with a separation below it get contact points.
    #[serde(rename = "speculative")]
    pub speculative_distance: f32,
    /// Greatest margin of a fat AABB, user's length units, > 0.
    #[serde(rename = "margin")]
    pub(crate) aabb_margin: f32,
    /// Greatest relative motion of the two bodies of a pair with which its manifold is recycled, user's length units, > 0.
    #[serde(rename = "frozen")]
    pub(crate) recycling_distance: f32,
    /// Motion of the two bodies of a pair after which the separations of its contact points are computed again, user's length
    /// units, > 0.
    #[serde(rename = "checked")]
    pub(crate) separation_refresh_distance: f32,
    /// Relative speed of two bodies at a contact from which on load adaptation does not raise the rest impulse of the contact,
    /// user's length units/s, > 0.
    #[serde(rename = "gate")]
    pub(crate) load_adaptation_speed: f32,
    /// Greatest bias velocity that resolves penetration, user's length units/s, > 0.
    #[serde(rename = "push")]
    pub(crate) recovery_speed: f32,
    /// Restitution threshold, user's length units/s, > 0: slower approaches do not bounce.
    #[serde(rename = "bounce")]
    pub(crate) restitution_threshold: f32,
}

impl Parameters {
    /// Returns the parameters for a length unit of `unit`, in the user's unit of length, > 0.
    pub fn new(unit: f32) -> Self {
        Parameters {
            length_unit: unit,
            speculative_distance: SPECULATIVE_DISTANCE * unit,
            aabb_margin: AABB_MAX_MARGIN * unit,
            recycling_distance: RECYCLING_DISTANCE * unit,
            separation_refresh_distance: SEPARATION_REFRESH_DISTANCE * unit,
            load_adaptation_speed: LOAD_ADAPTATION_MAX_SPEED * unit,
            recovery_speed: PENETRATION_RECOVERY_MAX_SPEED * unit,
            restitution_threshold: RESTITUTION_THRESHOLD * unit,
        }
    }

    /// Returns the margins of the fat AABB of a proxy that is in pairs. `reach`: greatest distance of the proxy's surface from
    /// the body's origin, length units, >= 0.
    pub(crate) fn margin_for_extent(&self, reach: f32) -> AabbMargin {
        let by_size = AABB_MAX_MARGIN_PER_SIZE * reach;
        let margin = if by_size < self.aabb_margin { by_size } else { self.aabb_margin };
        AabbMargin {
            margin,
            prediction_limit: AABB_MAX_PREDICTION_PER_SIZE * reach,
            unpaired_prediction_limit: 0.0,
        }
    }

    /// Returns the margins of the fat AABB of a proxy that is in no pair: it reaches further ahead along the motion of the
    /// body. The broad phase then searches less often, and no pair results while no other proxy is near. `reach`: greatest
    /// distance of the proxy's surface from the body's origin, length units, >= 0.
    pub(crate) fn margin_without_pairs(&self, reach: f32) -> AabbMargin {
        AabbMargin {
            unpaired_prediction_limit: UNPAIRED_AABB_MAX_PREDICTION_PER_SIZE * reach,
            ..self.margin_for_extent(reach)
        }
    }

    /// Returns the number of counts of `Proxies::travel` per unit of length, 1/length units: one count is 2^-26 times
    /// `length_unit`. The counters wrap.
    pub(crate) fn travel_scale(&self) -> f32 {
        67_108_864.0 / self.length_unit
    }
}

/// Distances by which the fat AABB of a proxy exceeds its tight one, so that the proxy stays in the fat AABB for several steps.
/// Length units, >= 0.
#[derive(Debug, Clone, Copy)]
pub(crate) struct AabbMargin {
    /// Margin of the fat AABB on all sides, length units, >= 0.
    pub(crate) margin: f32,
    /// Greatest distance by which the fat AABB reaches ahead along the motion of [`AABB_PREDICTED_STEPS`] steps, length units,
    /// >= 0.
    prediction_limit: f32,
    /// Greatest distance by which the fat AABB reaches ahead along the motion of [`UNPAIRED_AABB_PREDICTED_STEPS`] steps,
    /// length units, >= 0. It is 0 for proxies that are in a pair.
    unpaired_prediction_limit: f32,
}

impl AabbMargin {
    /// Returns the signed distance by which the fat AABB reaches ahead along a coordinate axis, length units. `motion`: signed
    /// motion of the body along the axis per step, length units. The result has at least the magnitude of `motion`.
    pub(crate) fn prediction(&self, motion: f32) -> f32 {
        let within = |steps: f32, limit: f32| (motion * steps).clamp(-limit, limit);
        let (near, far) = (
            within(AABB_PREDICTED_STEPS, self.prediction_limit),
            within(UNPAIRED_AABB_PREDICTED_STEPS, self.unpaired_prediction_limit),
        );
        let longest = |one: f32, other: f32| if other.abs() > one.abs() { other } else { one };
        longest(longest(motion, near), far).clamp(-COLLISION_MAX_COORDINATE, COLLISION_MAX_COORDINATE)
    }
}

/// Parameters of one step (Box2D 3: `b2StepContext`).
#[derive(Debug, Clone, Copy)]
pub struct StepContext {
    /// Length of the step, seconds, > 0.
    pub dt: f32,
    /// Number of substeps, >= 1.
    pub substeps: u32,
    /// Length of a substep, seconds, > 0: `dt / substeps`.
    pub h: f32,
    /// Softness of contacts between two movable bodies: dynamic or kinematic.
    pub(crate) contact_softness: Softness,
    /// Softness of contacts between a static and a movable body: twice the frequency of `contact_softness`.
    pub(crate) static_softness: Softness,
    /// Softness of contacts between two movable bodies, one of which has joints in the iterative solver.
    pub(crate) jointed_softness: Softness,
    /// Softness of contacts between a static body and a body that has joints in the iterative solver.
    pub(crate) jointed_static_softness: Softness,
    /// Rates and limits of load adaptation in this step.
    pub load_adaptation: LoadAdaptation,
}

/// Coefficients of a soft constraint: a spring with a damper, integrated implicitly over a substep of h seconds (E. Catto,
/// "Soft Constraints", GDC 2011; `b2MakeSoft` in Box2D 3). With frequency f, damping ratio z and omega = 2 pi f, the
/// accumulated impulse l becomes `l' = l - m * mass_scale * (u + bias_rate * s) - impulse_scale * l`, for effective mass m,
/// relative velocity u and separation s.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Softness {
    /// Bias velocity per unit of separation, 1/s: omega / (2 z + h omega), for damping ratio z and omega = 2 pi * frequency.
    pub(crate) bias_rate: f32,
    /// Factor of the effective mass, dimensionless, 0..=1: a / (1 + a) with a = h omega (2 z + h omega).
    pub(crate) mass_scale: f32,
    /// Fraction of the accumulated impulse that the soft constraint releases in a substep, dimensionless, 0..=1: 1 -
    /// mass_scale.
    pub(crate) impulse_scale: f32,
}

impl Softness {
    /// Returns the coefficients for a `frequency` in Hz, a `damping` ratio (dimensionless) and a substep of `h` seconds.
    fn new(frequency: f32, damping: f32, h: f32) -> Self {
        let omega = 2.0 * std::f32::consts::PI * frequency;
        let a1 = 2.0 * damping + h * omega;
        let a2 = h * omega * a1;
        let a3 = 1.0 / (1.0 + a2);
        Softness { bias_rate: omega / a1, mass_scale: a2 * a3, impulse_scale: a3 }
    }

    /// Returns the coefficients, each in four SIMD lanes: `bias_rate * mass_scale` (1/s), `mass_scale` and `impulse_scale`
    /// (dimensionless).
    pub(crate) fn splat(&self) -> [f32x4; 3] {
        [
            f32x4::splat(self.bias_rate * self.mass_scale),
            f32x4::splat(self.mass_scale),
            f32x4::splat(self.impulse_scale),
        ]
    }
}

/// Rates and limits of load adaptation in a step: the rest impulse of a contact point, which its soft constraint carries
/// without penetration, follows a fraction of the point's normal impulse. See
/// `adapt_load`.
#[derive(Debug, Clone, Copy)]
pub struct LoadAdaptation {
    /// Fraction of (normal impulse - rest impulse) by which the rest impulse of a contact point rises in this step,
    /// dimensionless, 0..=1.
    pub(crate) rise_rate: f32,
    /// Fraction of (rest impulse - normal impulse) by which the rest impulse of a contact point falls in this step,
    /// dimensionless, 0..=1.
    pub(crate) fall_rate: f32,
    /// Load adaptation raises the rest impulses of a contact up to this fraction of the contact's load, the sum of the normal
    /// impulses of its points. Dimensionless, 0..=1. The soft constraint carries 1 minus this fraction by penetration.
    pub(crate) adapted_fraction: f32,
    /// Reciprocal of the relative speed at a contact from which on its rest impulses do not rise, s / length units, > 0.
    pub(crate) inverse_speed_limit: f32,
    /// Least separation of a contact point with which its rest impulse rises, length units, < 0. Deeper penetration does not
    /// count as sag under load.
    pub(crate) min_separation: f32,
    /// Relative normal velocity above which contact points of jointed bodies lose their impulses after an impact, length
    /// units/s, > 0.
    pub(crate) separation_speed: f32,
}

impl StepContext {
    /// Returns the parameters of a step of `dt` seconds with this number of substeps.
    pub(crate) fn new(dt: f32, substeps: u32, parameters: &Parameters) -> Self {
        let h = dt / substeps as f32;
        let frequency = CONTACT_FREQUENCY.min(1.0 / (SUBSTEPS_PER_CONTACT_PERIOD * h));
        let beside_joints = JOINTED_CONTACT_FREQUENCY.min(JOINTED_CONTACT_FREQUENCY_PER_RATE / h);
        let steps = dt * 60.0;
        StepContext {
            dt,
            substeps,
            h,
            contact_softness: Softness::new(frequency, CONTACT_DAMPING_RATIO, h),
            static_softness: Softness::new(2.0 * frequency, CONTACT_DAMPING_RATIO, h),
            jointed_softness: Softness::new(beside_joints, CONTACT_DAMPING_RATIO, h),
            jointed_static_softness: Softness::new(2.0 * beside_joints, CONTACT_DAMPING_RATIO, h),
            load_adaptation: LoadAdaptation {
                rise_rate: (LOAD_RISE_PER_STEP * steps).min(1.0),
                fall_rate: (LOAD_FALL_PER_STEP * steps).min(1.0),
                adapted_fraction: 1.0 - LOAD_ON_SPRING_FRACTION,
                inverse_speed_limit: 1.0 / parameters.load_adaptation_speed,
                separation_speed: parameters.restitution_threshold,
                min_separation: -GREATEST_SAG * parameters.length_unit,
            },
        }
    }
}

impl StepContext {
    /// Returns two softnesses: for contacts of bodies without joints, then for contacts of a body with joints in the iterative
    /// solver. `is_fixed`: whether A is static.
    pub(crate) fn softness_with_joints(&self, is_fixed: bool) -> [Softness; 2] {
        if is_fixed {
            [self.static_softness, self.jointed_static_softness]
        } else {
            [self.contact_softness, self.jointed_softness]
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_aabb_of_an_unpaired_proxy_reaches_at_most_its_diameter_ahead() {
        let parameters = Parameters::new(32.0);
        let (lonely, other) = (parameters.margin_without_pairs(10.0), parameters.margin_for_extent(10.0));
        assert_eq!([0.5, 1.0, -1.0, 5.0].map(|way| other.prediction(way)), [2.0, 4.0, -4.0, 10.0]);
        assert_eq!([0.5, 1.0, -1.0, 5.0].map(|way| lonely.prediction(way)), [16.0, 20.0, -20.0, 20.0]);
        assert_eq!(lonely.margin, other.margin);
    }

    #[test]
    fn an_aabb_contains_the_motion_of_the_next_step_at_any_speed() {
        let parameters = Parameters::new(32.0);
        let both = [parameters.margin_without_pairs(10.0), parameters.margin_for_extent(10.0)];
        assert_eq!(both.map(|widening| widening.prediction(30.0)), [30.0; 2]);
        assert_eq!(both.map(|widening| widening.prediction(-30.0)), [-30.0; 2]);
    }
}
