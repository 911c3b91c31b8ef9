//! The contact solver's calls for constraints in three axes.
//!
//! `ConstraintGraph3` holds constraints with two points (prisms) and with one point (spheres). It has one list of each for
//! dynamic bodies A and one for static bodies A. Each solver stage runs over these four lists.

use super::friction_3d::{accumulate_warm_start_3d, apply_spin_warm_start, relax_3d};
use crate::constraint_graph::{ConstraintGraph3, ContactConstraint3Simd};
use crate::contact_solver::iterative_solver::IterativeSolver;
use crate::contact_solver::restitution::apply_restitution;
use crate::contact_solver::soft_step::{ContactSubstep, solve_with_bias, solve_with_joint_softness};
use crate::integration::resolve_bounce;
use crate::math::plane::{Vector, length};
use crate::parameters::depth::RESTITUTION_GRAVITY_STEPS;
use crate::scaled_parameters::{Parameters, StepContext};

/// Stages of the contact solver for constraints in three axes.
impl IterativeSolver<'_> {
    /// Adds the velocity changes by the accumulated impulses of all constraints to `BodySet::warm_start` and to the ball spins.
    /// Also performs load adaptation, and stores the approach velocities of constraints with restitution. Returns whether an
    /// approach speed exceeds the restitution threshold.
    pub(crate) fn accumulate_warm_start_3d(&mut self, step: &StepContext) -> bool {
        let threshold = self.has_restitution.then_some(self.restitution_threshold);
        let IterativeSolver { bodies, constraints: rows, joints, depth: Some(space), .. } = self else {
            return false;
        };
        let adaptation = (&step.load_adaptation, joints.iterative_body_masks());
        let (warm, states) = (&mut bodies.warm_start, &bodies.states);
        let spins = &mut space.ball_spins;
        spins.iter_mut().for_each(|spin| spin.warm_start = [0.0; 4]);
        let ConstraintGraph3 { prisms, balls, prisms_static: prisms_fixed, balls_static: balls_fixed } =
            &mut rows.depth;
        accumulate_warm_start_3d::<false, 2>(prisms, warm, states, spins, adaptation, threshold)
            | accumulate_warm_start_3d::<false, 1>(balls, warm, states, spins, adaptation, threshold)
            | accumulate_warm_start_3d::<true, 2>(prisms_fixed, warm, states, spins, adaptation, threshold)
            | accumulate_warm_start_3d::<true, 1>(balls_fixed, warm, states, spins, adaptation, threshold)
    }

    /// Start of a substep: adds the warm start of each sphere to its angular velocity about x and y. `is_first` is true in the
    /// first substep of a step.
    pub(crate) fn apply_spin_warm_start(&mut self, is_first: bool) {
        if let Some(space) = self.depth.as_mut().filter(|space| space.has_balls) {
            apply_spin_warm_start(&mut space.ball_spins, is_first);
        }
    }

    /// Solves the normal rows of all constraints as soft constraints with bias velocity, once per substep.
    pub(crate) fn solve_with_bias_3d(&mut self, step: &StepContext, substep: ContactSubstep) {
        let states = &mut self.bodies.states;
        let ConstraintGraph3 { prisms, balls, prisms_static: prisms_fixed, balls_static: balls_fixed } =
            &mut self.constraints.depth;
        if let Some(masks) = self.joints.iterative_body_masks() {
            let (soft, fixed) = (step.softness_with_joints(false), step.softness_with_joints(true));
            solve_with_joint_softness::<false, 2, _>(prisms, states, substep, soft, masks);
            solve_with_joint_softness::<false, 1, _>(balls, states, substep, soft, masks);
            solve_with_joint_softness::<true, 2, _>(prisms_fixed, states, substep, fixed, masks);
            solve_with_joint_softness::<true, 1, _>(balls_fixed, states, substep, fixed, masks);
            return;
        }
        solve_with_bias::<false, 2, _>(prisms, states, substep, step.contact_softness);
        solve_with_bias::<false, 1, _>(balls, states, substep, step.contact_softness);
        solve_with_bias::<true, 2, _>(prisms_fixed, states, substep, step.static_softness);
        solve_with_bias::<true, 1, _>(balls_fixed, states, substep, step.static_softness);
    }

    /// Relaxation: solves the normal rows of all constraints without bias, and friction along both tangents.
    pub(crate) fn relax_3d(&mut self, substep: ContactSubstep) {
        let IterativeSolver { bodies, constraints: rows, depth: Some(space), .. } = self else { return };
        let (states, spins) = (&mut bodies.states, &mut space.ball_spins);
        let ConstraintGraph3 { prisms, balls, prisms_static: prisms_fixed, balls_static: balls_fixed } =
            &mut rows.depth;
        relax_3d::<false, 2>(prisms, states, spins, substep);
        relax_3d::<false, 1>(balls, states, spins, substep);
        relax_3d::<true, 2>(prisms_fixed, states, spins, substep);
        relax_3d::<true, 1>(balls_fixed, states, spins, substep);
    }

    /// Applies restitution to all constraints after the substeps. `is_last`: bodies that bounce get the position of a bounce at
    /// the time of impact. The impulses of restitution are added to `step_impulses`.
    pub(crate) fn apply_restitution_3d(&mut self, step: &StepContext, is_last: bool) {
        let threshold = self.restitution_threshold;
        let IterativeSolver { constraints: rows, bodies, color_usage, joints, .. } = self;
        let mut states = std::mem::take(&mut bodies.states);
        macro_rules! bounce_all {
            ($fixed:literal, $points:literal, $rows:expr) => {
                apply_restitution::<$fixed, $points, _>(
                    $rows,
                    &mut states,
                    threshold,
                    |row, lanes, states| {
                        if is_last {
                            resolve_bounce(bodies, states, (color_usage, joints), step, row, lanes)
                        } else {
                            joints.record_restitution(&row.planar, lanes)
                        }
                    },
                )
            };
        }
        let ConstraintGraph3 { prisms, balls, prisms_static: prisms_fixed, balls_static: balls_fixed } =
            &mut rows.depth;
        macro_rules! count_all {
            ($add:expr) => {
                prisms.for_each(|row| row.accumulate_step_impulses($add));
                balls.for_each(|row| row.accumulate_step_impulses($add));
                prisms_fixed.for_each(|row| row.accumulate_step_impulses($add));
                balls_fixed.for_each(|row| row.accumulate_step_impulses($add));
            };
        }
        count_all!(|total, impulse| total - impulse);
        bounce_all!(false, 2, prisms);
        bounce_all!(false, 1, balls);
        bounce_all!(true, 2, prisms_fixed);
        bounce_all!(true, 1, balls_fixed);
        count_all!(|total, impulse| total + impulse);
        bodies.states = states;
    }
}

/// Returns the approach speed in length units/s below which there is no restitution. A resting body approaches no faster than
/// gravity accelerates it in a few steps. Without gravity the threshold is 0. `gravity_delta`: velocity change by gravity in
/// the step, length units/s.
pub(crate) fn restitution_threshold_3d(gravity_delta: Vector, parameters: &Parameters) -> f32 {
    let resting = RESTITUTION_GRAVITY_STEPS * length(gravity_delta);
    if resting < parameters.restitution_threshold { resting } else { parameters.restitution_threshold }
}

impl ConstraintGraph3 {
    /// Calls `change` for each accumulated, summed and rest impulse of the constraints in three axes, in mass units * length
    /// units/s (twist: times length units).
    pub(crate) fn for_each_impulse(&mut self, change: &impl Fn(&mut wide::f32x4)) {
        fn change_all<const P: usize>(
            row: &mut ContactConstraint3Simd<P>,
            change: &impl Fn(&mut wide::f32x4),
        ) {
            for impulse in
                [&mut row.planar.tangent_impulse, &mut row.second_tangent_impulse, &mut row.twist_impulse]
            {
                change(impulse);
            }
            row.step_impulses.iter_mut().for_each(change);
            for point in &mut row.planar.points {
                change(&mut point.normal_impulse);
                change(&mut point.rest_impulse);
            }
        }
        let ConstraintGraph3 { prisms, balls, prisms_static: prisms_fixed, balls_static: balls_fixed } = self;
        prisms.for_each(|row| change_all(row, change));
        balls.for_each(|row| change_all(row, change));
        prisms_fixed.for_each(|row| change_all(row, change));
        balls_fixed.for_each(|row| change_all(row, change));
    }
}
