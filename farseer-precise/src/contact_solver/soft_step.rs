//! Iterative contact solver: soft contact constraints in substeps, four constraints per SIMD block.
//!
//! | function | once per | method |
//! |---|---|---|
//! | [`accumulate_warm_start`](super::warm_start) | step | warm start: accumulated impulses act again in each substep; [load adaptation](super::load_adaptation) |
//! | `solve_with_bias` | substep | normal rows as soft constraints with a bias velocity |
//! | `relax` | substep, after positions | relaxation: rigid normal rows without bias, then friction |
//! | [`apply_restitution`](super::restitution) | step | restitution |
//!
//! The scheme is that of E. Catto, "Solver2D" (2024; the solver `Soft Step` of Box2D 3) and "Soft Constraints" (GDC 2011), on
//! the substeps of M. Macklin et al., "Small Steps in Physics Simulation" (2019).
//!
//! Let n be the normal from A to B, t = (n.y, -n.x) the tangent and r the arm of a point, the vector from the centre of mass to
//! it. The Jacobian of a normal row gives the relative velocity `(vB - vA) . n + wB (rB x n) - wA (rA x n)`. The friction row
//! has t in place of n, and the mean arm of the points.
//!
//! `FIXED` means that A is static: its velocity is neither read nor written. `P` is the number of points per constraint.

use super::load_adaptation::body_mask;
use super::pair_velocities::{
    PairVelocities, angular_coupling, angular_impulses, load_displacements, load_velocities,
    normal_velocities, off_diagonal,
};
use crate::bodies::MotionState;
use crate::constraint_graph::{ColorSet, ContactConstraintSimd, SimdContacts};
use crate::math::lanes::{greater, positive, select, smaller};
use crate::parameters::contacts::BLOCK_MIN_RELATIVE_DETERMINANT;
use crate::scaled_parameters::Softness;
use wide::f32x4;

const ZERO: f32x4 = f32x4::ZERO;

/// Parameters of the contact constraints that all substeps of a step share.
#[derive(Debug, Clone, Copy)]
pub(crate) struct ContactSubstep {
    /// Reciprocal of the substep length, 1/s, > 0.
    pub(crate) inverse_h: f32,
    /// Greatest bias velocity that resolves penetration, length units/s, > 0.
    pub(crate) max_bias_speed: f32,
    /// Whether each solve sets [`was_active`](ContactConstraintSimd::was_active) of the points that have a normal impulse then:
    /// after the step the impulse of a point that has separated the bodies may be 0 again. [`apply_restitution`] reads it.
    pub(crate) records_active_points: bool,
    /// Whether the iterative solver has contact constraints in this step.
    pub(crate) has_contacts: bool,
}

/// Solves all normal rows as soft constraints. Points with positive separation s are rigid rows u >= -s / h instead: they may
/// close the gap in this substep, and no more (speculative contacts).
#[inline(always)]
pub(crate) fn solve_with_bias<const FIXED: bool, const P: usize, R: SimdContacts<P>>(
    constraints: &mut ColorSet<R>,
    states: &mut [MotionState],
    substep: ContactSubstep,
    softness: Softness,
) {
    let softness = softness.splat();
    solve_soft_constraints::<FIXED, P, R>(constraints, states, substep, |_| softness);
}

/// Runs [`solve_with_bias`] with the second entry of `softness` for contacts of bodies with joints in the iterative solver,
/// whose entries of `masks` are set. All other contacts get the first entry.
#[inline(never)]
pub(crate) fn solve_with_joint_softness<const FIXED: bool, const P: usize, R: SimdContacts<P>>(
    constraints: &mut ColorSet<R>,
    states: &mut [MotionState],
    substep: ContactSubstep,
    softness: [Softness; 2],
    masks: &[u32],
) {
    let [other, jointed] = softness.map(|softness| softness.splat());
    solve_soft_constraints::<FIXED, P, R>(constraints, states, substep, |constraint| {
        let mask = body_mask::<FIXED, P>(constraint, masks);
        std::array::from_fn(|at| select(mask, jointed[at], other[at]))
    });
}

/// Solves the normal rows of all blocks as soft constraints. `softness` returns the coefficients for a block, in the form of
/// [`Softness::splat`].
#[inline(always)]
fn solve_soft_constraints<const FIXED: bool, const P: usize, R: SimdContacts<P>>(
    constraints: &mut ColorSet<R>,
    states: &mut [MotionState],
    substep: ContactSubstep,
    softness: impl Fn(&ContactConstraintSimd<P>) -> [f32x4; 3],
) {
    if constraints.used_colors == 0 {
        return;
    }
    constraints.for_each(|contacts| {
        let softness = softness(contacts.constraint());
        let mut pair_velocities = load_velocities::<FIXED, P>(contacts.constraint(), states);
        let mut velocity = normal_velocities::<FIXED, P, R>(contacts, &pair_velocities);
        let constraint = contacts.constraint_mut();
        let coupling = off_diagonal::<FIXED, P>(constraint);
        let (mut sum, mut changes) = (ZERO, [ZERO; P]);
        let (bias_losses, weights) = bias_and_weights(constraint, substep, softness);
        let losses = std::array::from_fn(|at| bias_losses[at] + weights[at] * velocity[at]);
        // In the plane only the relaxation uses the block solver.
        let (is_block, both) = if R::IS_3D {
            solve_two_point_block::<P, R>(constraint, coupling, &weights, &losses)
        } else {
            (ZERO, [ZERO; P])
        };
        for at in 0..P {
            let point = constraint.points[at];
            let alone = positive(point.normal_impulse - bias_losses[at] - weights[at] * velocity[at]);
            let impulse = select(is_block, both[at], alone);
            changes[at] = impulse - point.normal_impulse;
            constraint.points[at].normal_impulse = impulse;
            sum += changes[at];
            velocity[P - 1] += coupling * changes[at];
        }
        if substep.records_active_points {
            constraint.record_active_points();
        }
        pair_velocities
            .apply_angular_impulses::<FIXED, P>(constraint, angular_impulses(constraint, &changes));
        pair_velocities.store_with_normal_impulse::<FIXED, P, R>(contacts, states, sum);
    });
}

/// Returns for each normal row of a block of soft constraints the impulse that it loses, and its softened effective mass (mass
/// units). The loss (mass units * length units/s) is by the bias and by the leak towards the rest impulse.
#[inline(always)]
fn bias_and_weights<const P: usize>(
    constraint: &ContactConstraintSimd<P>,
    substep: ContactSubstep,
    [rate, mass, leak_fraction]: [f32x4; 3],
) -> ([f32x4; P], [f32x4; P]) {
    let one = f32x4::splat(1.0);
    let (inverse_h, fastest) = (f32x4::splat(substep.inverse_h), f32x4::splat(-substep.max_bias_speed));
    let (mut bias_losses, mut weights) = ([ZERO; P], [ZERO; P]);
    for at in 0..P {
        let point = constraint.points[at];
        let is_apart = point.separation.simd_gt(ZERO);
        let bias = select(is_apart, point.separation * inverse_h, greater(point.separation * rate, fastest));
        let leak = (leak_fraction * (point.normal_impulse - point.rest_impulse)) & !is_apart;
        bias_losses[at] = point.normal_mass * bias + leak;
        weights[at] = point.normal_mass * select(is_apart, one, mass);
    }
    (bias_losses, weights)
}

/// Block solver: solves both normal rows of a manifold at once. Returns the mask of the lanes to which the solution applies,
/// and the new accumulated normal impulse of each row, mass units * length units/s. `losses`: impulse that each row would lose
/// if it were solved alone, mass units * length units/s. `weights`: effective mass of each row, mass units. `coupling`: entry
/// k12 of J M^-1 J^T, 1/mass units.
///
/// Gauss-Seidel, one row after the other, leaves a relative error of (k12 * effective mass)^2 per sweep. Faces that meet flat
/// would rotate, and boxes at rest would rock.
///
/// The four cases of the linear complementarity problem (both rows active, one of them, none) are enumerated: the block solver
/// of Box2D 2 (`b2ContactSolver.cpp`, E. Catto and D. Gregorius). In the plane only the first case is solved: the other cases
/// are not worth their time.
#[inline(always)]
pub(super) fn solve_two_point_block<const P: usize, R: SimdContacts<P>>(
    constraint: &ContactConstraintSimd<P>,
    coupling: f32x4,
    weights: &[f32x4; P],
    losses: &[f32x4; P],
) -> (f32x4, [f32x4; P]) {
    if P == 1 {
        return (ZERO, [ZERO; P]);
    }
    let (first, last) = (constraint.points[0].normal_impulse, constraint.points[P - 1].normal_impulse);
    let coupled_weights = [weights[0] * coupling, weights[P - 1] * coupling];
    let one = f32x4::splat(1.0);
    let determinant = one - coupled_weights[0] * coupled_weights[1];
    let is_well_conditioned = determinant.simd_gt(f32x4::splat(BLOCK_MIN_RELATIVE_DETERMINANT));
    let change =
        (coupled_weights[1] * losses[0] - losses[P - 1]) / select(is_well_conditioned, determinant, one);
    let both = [first - losses[0] - coupled_weights[0] * change, last + change];
    let both_active = both[0].simd_ge(ZERO) & both[1].simd_ge(ZERO);
    let mut solved = [both[1]; P];
    solved[0] = both[0];
    if !R::IS_3D {
        return (is_well_conditioned & both_active, solved);
    }
    let first_alone = positive(first - losses[0] + coupled_weights[0] * last);
    let last_alone = positive(last - losses[P - 1] + coupled_weights[1] * first);
    let is_enough = (losses[P - 1] + coupled_weights[1] * (first_alone - first) - last).simd_ge(ZERO);
    solved[P - 1] = select(both_active, both[1], select(is_enough, ZERO, last_alone));
    solved[0] = select(both_active, both[0], select(is_enough, first_alone, ZERO));
    (is_well_conditioned, solved)
}

/// Result of a relaxation of the normal rows of four constraints.
pub(crate) struct RelaxResult<const P: usize> {
    /// Velocities of both bodies before the relaxation: x, y (length units/s), angular velocity (radians/s), z (length
    /// units/s).
    pub(crate) velocities: PairVelocities,
    /// Sum of the changes of the normal impulses of all points, mass units * length units/s.
    pub(crate) impulse_change: f32x4,
    /// Change of the normal impulse of each point, mass units * length units/s.
    pub(crate) point_changes: [f32x4; P],
    /// Sum of the new normal impulses of all points, mass units * length units/s, >= 0.
    pub(crate) normal_impulse: f32x4,
}

/// Relaxation of the normal rows of four constraints: solves them as rigid rows, after updating the separations by the
/// displacements in the substep. The function does not write velocities to `states`; its callers do so after friction.
#[inline(always)]
pub(crate) fn relax_normals<const FIXED: bool, const P: usize, R: SimdContacts<P>>(
    contacts: &mut R,
    states: &[MotionState],
    substep: ContactSubstep,
) -> RelaxResult<P> {
    let inverse_h = f32x4::splat(substep.inverse_h);
    let moved = normal_velocities::<FIXED, P, R>(
        contacts,
        &load_displacements::<FIXED, P>(contacts.constraint(), states),
    );
    let pair_velocities = load_velocities::<FIXED, P>(contacts.constraint(), states);
    let mut velocity = normal_velocities::<FIXED, P, R>(contacts, &pair_velocities);
    let constraint = contacts.constraint_mut();
    let coupling = off_diagonal::<FIXED, P>(constraint);
    let mut separations = [ZERO; P];
    let mut due = velocity;
    for at in 0..P {
        separations[at] = constraint.points[at].separation + moved[at];
        due[at] = positive(separations[at]) * inverse_h + velocity[at];
    }
    let weights = std::array::from_fn(|at| constraint.points[at].normal_mass);
    let losses = std::array::from_fn(|at| weights[at] * due[at]);
    let (is_block, both) = solve_two_point_block::<P, R>(constraint, coupling, &weights, &losses);
    let mut impulses = both;
    if P == 1 || is_block.to_bitmask() != 0b1111 {
        for at in 0..P {
            let point = constraint.points[at];
            let kept = point.normal_impulse - point.normal_mass * (positive(separations[at]) * inverse_h);
            let alone = positive(kept - point.normal_mass * velocity[at]);
            impulses[at] = select(is_block, both[at], alone);
            velocity[P - 1] += coupling * (impulses[at] - point.normal_impulse);
        }
    }
    let result = store_relaxed(constraint, pair_velocities, separations, impulses);
    if substep.records_active_points {
        constraint.record_active_points();
    }
    result
}

/// Stores new separations (length units) and normal impulses (mass units * length units/s) in the points of a block. Returns the
/// result of the relaxation of its normal rows.
#[inline(always)]
fn store_relaxed<const P: usize>(
    constraint: &mut ContactConstraintSimd<P>,
    velocities: PairVelocities,
    separations: [f32x4; P],
    impulses: [f32x4; P],
) -> RelaxResult<P> {
    let (mut sum, mut load, mut changes) = (ZERO, ZERO, [ZERO; P]);
    for at in 0..P {
        let point = &mut constraint.points[at];
        changes[at] = impulses[at] - point.normal_impulse;
        point.separation = separations[at];
        point.normal_impulse = impulses[at];
        sum += changes[at];
        load += impulses[at];
    }
    RelaxResult { velocities, impulse_change: sum, point_changes: changes, normal_impulse: load }
}

/// Relaxation, after positions are integrated: solves normal rows and friction as rigid rows without bias, so that no velocity
/// that resolved penetration remains. The friction impulse is clamped to the friction limit, friction coefficient times normal
/// impulse.
#[inline(always)]
pub(crate) fn relax<const FIXED: bool, const P: usize>(
    constraints: &mut ColorSet<ContactConstraintSimd<P>>,
    states: &mut [MotionState],
    substep: ContactSubstep,
) {
    constraints.for_each(|constraint| {
        let RelaxResult {
            velocities: mut pair_velocities,
            impulse_change: sum,
            point_changes: changes,
            normal_impulse: load,
        } = relax_normals::<FIXED, P, _>(constraint, states, substep);
        let tangent_arms = [constraint.tangent_arm_a, constraint.tangent_arm_b];
        let mut slip = pair_velocities.relative_tangent_velocity::<FIXED, P>(constraint)
            + pair_velocities.relative_angular_velocity::<FIXED>(tangent_arms[0], tangent_arms[1]);
        for (point, change) in constraint.points.iter().zip(changes) {
            slip += angular_coupling::<FIXED, P>(constraint, point.normal_arms(), tangent_arms) * change;
        }
        let most = constraint.friction * load;
        let wanted = constraint.tangent_impulse - constraint.tangent_mass * (slip - constraint.tangent_speed);
        let friction = greater(smaller(wanted, most), ZERO - most);
        let change = friction - constraint.tangent_impulse;
        constraint.tangent_impulse = friction;
        let [of_a, of_b] = angular_impulses(constraint, &changes);
        pair_velocities.apply_angular_impulses::<FIXED, P>(
            constraint,
            [of_a + tangent_arms[0] * change, of_b + tangent_arms[1] * change],
        );
        let x = sum * constraint.normal_x + change * constraint.normal_y;
        let y = sum * constraint.normal_y - change * constraint.normal_x;
        pair_velocities.store_with_impulse::<FIXED, P>(constraint, states, false, [x, y, ZERO]);
    });
}
