//! Load adaptation: rest impulses follow the load of contacts, so that soft constraints sag less.
//!
//! The method is our addition to the [soft constraints](super::soft_step). A soft constraint that carries a load sags: its
//! penetration is proportional to the load, and no number of iterations removes it. Here each contact point has a rest impulse
//! l0, which it carries without penetration: the spring releases `impulse_scale * (l - l0)` of the accumulated impulse l, in
//! place of `impulse_scale * l`. Once per step l0 follows the load slowly, and only while the contact hardly moves
//! (`adapt_load`). It acts like the integral term of a controller.
//!
//! l0 rises to 40 % of the load, and falls only when it exceeds the load. That removes 40 % of the sag and adds no stiffness.
//! The other 60 % of the load stay on the spring, so that contacts deep in a pile stay closed. A contact that comes from the
//! direct solver may begin with its whole load as l0, and hardly sags then.

use super::pair_velocities::{PairVelocities, magnitude, normal_velocities};
use crate::constraint_graph::{ContactConstraintSimd, ContactPointSimd, SimdContacts};
use crate::index::{BodyIndex, DenseIndex};
use crate::math::lanes::{greater, positive, select, smaller};
use crate::scaled_parameters::LoadAdaptation;
use wide::f32x4;

const ZERO: f32x4 = f32x4::ZERO;

/// Load adaptation: moves the rest impulses of the points towards their normal impulses. `speed`: tangential speed, length
/// units/s.
///
/// Rest impulses rise while the points penetrate and the sum of the rest impulses is below the adapted fraction of the load,
/// the sum of the normal impulses. The rate of rise decreases with the speed at the contact and is 0 from
/// `load_adaptation_speed` on. The sum of both points decides, since rocking only shifts load between the points. If a point
/// penetrates deeply, rest impulses do not rise, since they would press the bodies apart ever harder.
#[inline(always)]
pub(crate) fn adapt_load<const FIXED: bool, const P: usize, R: SimdContacts<P>>(
    contacts: &mut R,
    pair_velocities: &PairVelocities,
    mut speed: f32x4,
    adaptation: &LoadAdaptation,
) {
    for velocity in normal_velocities::<FIXED, P, R>(contacts, pair_velocities) {
        speed = greater(speed, magnitude(velocity));
    }
    let constraint = contacts.constraint_mut();
    let stillness = positive(f32x4::splat(1.0) - speed * f32x4::splat(adaptation.inverse_speed_limit));
    let up = f32x4::splat(adaptation.rise_rate) * stillness;
    let (adapted, down) = (f32x4::splat(adaptation.adapted_fraction), f32x4::splat(adaptation.fall_rate));
    let sum = |of: fn(&ContactPointSimd) -> f32x4| {
        constraint.points[1..].iter().fold(of(&constraint.points[0]), |sum, point| sum + of(point))
    };
    let (load, rest_impulse) = (sum(|point| point.normal_impulse), sum(|point| point.rest_impulse));
    let deepest = constraint.points[1..]
        .iter()
        .fold(constraint.points[0].separation, |least, p| smaller(least, p.separation));
    let is_sag = deepest.simd_lt(ZERO) & deepest.simd_gt(f32x4::splat(adaptation.min_separation));
    let rises = (adapted * load).simd_gt(rest_impulse) & is_sag & up;
    for point in &mut constraint.points {
        let missing = point.normal_impulse - point.rest_impulse;
        let excess = missing & missing.simd_lt(ZERO);
        point.rest_impulse = point.rest_impulse + rises * positive(missing) + down * excess;
    }
}

/// Returns a bit mask per lane: the union of the masks of both bodies. `masks`: mask of each body, by body index.
#[inline(always)]
pub(super) fn body_mask<const FIXED: bool, const P: usize>(
    constraint: &ContactConstraintSimd<P>,
    masks: &[u32],
) -> f32x4 {
    let of = |body: BodyIndex| masks[body.position()];
    f32x4::new(std::array::from_fn(|lane| {
        f32::from_bits(of(constraint.b[lane]) | if FIXED { 0 } else { of(constraint.a[lane]) })
    }))
}

/// Runs [`adapt_load`] in a step in which some bodies have joints in the iterative solver (all bits of their `masks` are set).
/// Rest impulses at these bodies decay to 0: joints have no load adaptation, and a contact without sag would prevail over
/// joints.
///
/// Points of these bodies that separate after an impact lose their accumulated impulses. The impact acted on the whole
/// articulation, but a row knows only one body of it and would reduce its impulse by too little.
#[inline(never)]
pub(crate) fn adapt_load_with_joints<const FIXED: bool, const P: usize, R: SimdContacts<P>>(
    contacts: &mut R,
    pair_velocities: &PairVelocities,
    speed: f32x4,
    adaptation: &LoadAdaptation,
    masks: &[u32],
) {
    let mask = body_mask::<FIXED, P>(contacts.constraint(), masks);
    let kept = f32x4::splat(1.0 - adaptation.fall_rate);
    let decayed = contacts.constraint().points.map(|point| kept * point.rest_impulse);
    adapt_load::<FIXED, P, R>(contacts, pair_velocities, speed, adaptation);
    for (point, forgotten) in contacts.constraint_mut().points.iter_mut().zip(decayed) {
        point.rest_impulse = select(mask, forgotten, point.rest_impulse);
    }
    let constraint = contacts.constraint();
    if constraint.restitution.simd_gt(ZERO).to_bitmask() == 0 {
        return;
    }
    let may_leave = mask & constraint.restitution.simd_gt(ZERO);
    let velocities = normal_velocities::<FIXED, P, R>(contacts, pair_velocities);
    let constraint = contacts.constraint_mut();
    let mut leaves = may_leave;
    for (point, velocity) in constraint.points.iter_mut().zip(velocities) {
        let point_leaves = may_leave & velocity.simd_gt(f32x4::splat(adaptation.separation_speed));
        point.normal_impulse = select(point_leaves, ZERO, point.normal_impulse);
        leaves &= point_leaves;
    }
    constraint.tangent_impulse = select(leaves, ZERO, constraint.tangent_impulse);
}
