//! Contacts that joints press into static or kinematic bodies: they hold where soft constraints would give way.
//!
//! A joint with a large position error pulls like a spring of the stiffness of a contact. Where a wall stands in its way, error
//! and penetration grow alike, and the joint at last pulls the body through the wall. So deep points are solved once more, as
//! rigid rows, after all soft constraints and before bodies move: the last solve prevails. The joint keeps its error then.

use super::load_adaptation::body_mask;
use super::pair_velocities::{
    angular_coupling, angular_impulses, inverse_mass_sum, load_velocities, normal_velocities, off_diagonal,
};
use crate::bodies::MotionState;
use crate::constraint_graph::{ColorSet, ContactConstraintSimd, SimdContacts};
use crate::index::DenseIndex;
use crate::math::lanes::{positive, smaller};
use crate::parameters::contacts::{HELD_CONTACT_SWEEPS, HELD_DEPTH_PER_EXTENT};
use wide::f32x4;

/// Facts by which contact points hold.
#[derive(Clone, Copy)]
pub(crate) struct HeldContacts<'a> {
    /// For each body index all bits set if the body has joints in the iterative solver, else 0.
    pub(crate) masks: &'a [u32],
    /// Least distance from the middle of each body to its surface, length units, >= 0, by body index.
    pub(crate) min_extents: &'a [f32],
    /// Penetration above which the points of large bodies hold, length units, >= 0.
    pub(crate) max_depth: f32,
    /// Speed at which deeper penetration is resolved, per length unit of it, 1/s.
    pub(crate) bias_rate: f32,
    /// Greatest speed at which penetration is resolved, length units/s, > 0.
    pub(crate) max_bias_speed: f32,
}

impl HeldContacts<'_> {
    /// Returns the separations below which the points of a block hold, length units, <= 0, one lane per constraint.
    fn least_separations<const P: usize>(&self, constraint: &ContactConstraintSimd<P>) -> f32x4 {
        let extents = f32x4::new(constraint.b.map(|body| self.min_extents[body.position()]));
        f32x4::ZERO - smaller(f32x4::splat(HELD_DEPTH_PER_EXTENT) * extents, f32x4::splat(self.max_depth))
    }

    /// Returns the least normal velocities of the points of a block, length units/s: those that resolve what is too deep.
    fn bias<const P: usize>(&self, constraint: &ContactConstraintSimd<P>) -> [f32x4; P] {
        let limit = self.least_separations(constraint);
        std::array::from_fn(|at| {
            let excess = limit - constraint.points[at].separation;
            smaller(excess * f32x4::splat(self.bias_rate), f32x4::splat(self.max_bias_speed))
        })
    }
}

/// Makes the deep contact points of jointed bodies with static and kinematic bodies separate, as rigid rows, at the speed that
/// resolves what is too deep. Sets all bits of the entries of `held_bodies` for their bodies.
#[inline(never)]
pub(crate) fn hold_deep_contacts<const FIXED: bool, const P: usize, R: SimdContacts<P>>(
    constraints: &mut ColorSet<R>,
    states: &mut [MotionState],
    held: HeldContacts<'_>,
    held_bodies: &mut [u32],
) {
    if constraints.used_colors == 0 {
        return;
    }
    constraints.for_each(|contacts| {
        let constraint = contacts.constraint();
        let mut is_held = body_mask::<FIXED, P>(constraint, held.masks);
        if !FIXED {
            is_held &= (constraint.inverse_mass_a + constraint.inverse_inertia_a).simd_eq(f32x4::ZERO);
        }
        let limit = held.least_separations(constraint);
        let is_deep: [f32x4; P] =
            std::array::from_fn(|at| constraint.points[at].separation.simd_lt(limit) & is_held);
        if is_deep.iter().all(|lanes| lanes.none()) {
            return;
        }
        mark_bodies(constraint, &is_deep, held_bodies);
        let mut pair_velocities = load_velocities::<FIXED, P>(constraint, states);
        let velocity = normal_velocities::<FIXED, P, R>(contacts, &pair_velocities);
        let constraint = contacts.constraint_mut();
        let coupling = off_diagonal::<FIXED, P>(constraint);
        let changes =
            solve_held_points::<FIXED, P>(constraint, (velocity, coupling), held.bias(constraint), is_deep);
        let mut sum = f32x4::ZERO;
        for (point, change) in constraint.points.iter_mut().zip(changes) {
            point.normal_impulse += change;
            sum += change;
        }
        pair_velocities
            .apply_angular_impulses::<FIXED, P>(constraint, angular_impulses(constraint, &changes));
        pair_velocities.store_with_normal_impulse::<FIXED, P, R>(contacts, states, sum);
    });
}

/// Solves the points of a block for which `is_deep` has all bits set as rigid rows, by Gauss-Seidel sweeps. Returns the changes of
/// their normal impulses, mass units * length units/s, >= 0. `velocity` and `bias` are the present and the least normal velocities,
/// length units/s; `coupling` is the entry k12 of J M^-1 J^T, 1/mass units.
#[inline(always)]
fn solve_held_points<const FIXED: bool, const P: usize>(
    constraint: &ContactConstraintSimd<P>,
    (mut velocity, coupling): ([f32x4; P], f32x4),
    bias: [f32x4; P],
    is_deep: [f32x4; P],
) -> [f32x4; P] {
    let own: [f32x4; P] = std::array::from_fn(|at| {
        let arms = constraint.points[at].normal_arms();
        inverse_mass_sum::<FIXED, P>(constraint) + angular_coupling::<FIXED, P>(constraint, arms, arms)
    });
    let mut changes = [f32x4::ZERO; P];
    for at in (0..P).cycle().take(HELD_CONTACT_SWEEPS * P) {
        let approach = constraint.points[at].normal_mass * (velocity[at] - bias[at]);
        let wanted = positive(changes[at] - approach) & is_deep[at];
        let change = wanted - changes[at];
        changes[at] = wanted;
        for (other, velocity) in velocity.iter_mut().enumerate() {
            *velocity += change * if other == at { own[at] } else { coupling };
        }
    }
    changes
}

/// Sets all bits of the entries of `held_bodies` for bodies B of the lanes in which a point `is_deep`.
fn mark_bodies<const P: usize>(
    constraint: &ContactConstraintSimd<P>,
    is_deep: &[f32x4; P],
    held_bodies: &mut [u32],
) {
    for (lane, body) in constraint.b.iter().enumerate() {
        if is_deep.iter().any(|lanes| lanes.to_array()[lane].to_bits() != 0) {
            held_bodies[body.position()] = !0;
        }
    }
}
