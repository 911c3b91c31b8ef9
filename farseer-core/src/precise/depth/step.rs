//! Stages of a step in three axes: velocities and positions along z, and the contact solver's calls for constraints in three
//! axes.
//!
//! `ConstraintGraph3` holds constraints with two points (prisms) and with one point (spheres). It has one list of each for
//! dynamic bodies A and one for static bodies A. Each solver stage runs over these four lists.

use super::friction_3d::BallSpin;
use super::interface::{DepthBodyState, DepthTarget};
use super::{DepthState, accumulate_warm_start_3d, apply_spin_warm_start, relax_3d};
use crate::body::Body;
use crate::math::decay;
use crate::math::plane::{Vector, length};
use crate::precise::body_import::BodyForces;
use crate::precise::constraint_graph::ConstraintGraph3;
use crate::precise::contact_solver::iterative_solver::IterativeSolver;
use crate::precise::contact_solver::soft_step::{
    ContactSubstep, apply_restitution, solve_with_bias, solve_with_joint_softness,
};
use crate::precise::integration::resolve_bounce;
use crate::precise::parameters::depth::RESTITUTION_GRAVITY_STEPS;
use crate::precise::scaled_parameters::{Parameters, StepContext};

impl DepthState {
    /// Start of a step: stores the velocity of a body along z and its change per substep by forces and drag in component 3 of
    /// the vectors of `read`. A sphere also gets its angular velocity about x and y, after drag, in `ball_spins`. See
    /// [`read_body`](crate::precise::body_import::read_body) for x and y.
    pub(in crate::precise) fn begin_velocity(
        &mut self,
        body_index: usize,
        body: &Body,
        read: &mut BodyForces,
        step: &StepContext,
        id: crate::body::BodyId,
    ) {
        if body.is_kinematic() {
            self.begin_kinematic(id, step.dt);
            read.velocity[3] = self.body(id).velocity;
            return;
        }
        let state = self.body(id);
        if state.target.is_some() {
            self.body_mut(id).target = None;
        }
        read.velocity[3] = state.velocity;
        let (drag, rotational_drag) = body.drag_rates();
        let ((slowed, grown), (turning_slowed, _)) =
            (decay::decay_and_integral(drag, step.dt), decay::decay_and_integral(rotational_drag, step.dt));
        let acceleration = state.acceleration - quadratic_drag(body, read.velocity);
        let gained = state.velocity * slowed + acceleration * grown;
        read.force_delta[3] = gained * (step.h / step.dt);
        read.force_position_delta[3] = acceleration * (0.5 * step.dt * step.dt);
        let BallSpin { velocity, .. } = &mut self.ball_spins[body_index];
        *velocity = [0.0; 4];
        if self.is_ball[body_index] {
            let [x, y] = state.angular_velocity;
            *velocity = [x + x * turning_slowed, y + y * turning_slowed, 0.0, 0.0];
        }
    }

    /// End of a step: stores z, velocity along z (`velocity`, length units/s), angular velocity about x and y, and displacement
    /// of a body in its depth state, and sets its acceleration to 0. The displacement argument has components x, y (length
    /// units), rotation (radians) and z.
    pub(in crate::precise) fn store_position(
        &mut self,
        body_index: usize,
        id: crate::body::BodyId,
        [x_displacement, y_displacement, _, z_displacement]: [f32; 4],
        velocity: f32,
    ) {
        self.z_positions[body_index] += z_displacement;
        if let Some(target) = self.body_mut(id).target.as_mut().filter(|target| !target.is_reached) {
            target.is_reached = true;
            self.z_positions[body_index] = target.z;
        }
        let ([x, y, ..], z) = (self.ball_spins[body_index].velocity, self.z_positions[body_index]);
        let state = self.body_mut(id);
        (state.z, state.velocity, state.acceleration, state.angular_velocity) = (z, velocity, 0.0, [x, y]);
        state.displacement = [x_displacement, y_displacement, z_displacement];
    }

    /// Returns the velocity of a kinematic body along z in the coming step, in length units/s: its own velocity, or the
    /// velocity that reaches its target in `dt` seconds.
    pub(in crate::precise) fn kinematic_velocity(&self, id: crate::body::BodyId, dt: f32) -> f32 {
        let state = self.body(id);
        match state.target {
            None => state.velocity,
            Some(DepthTarget { is_reached: true, .. }) => 0.0,
            Some(DepthTarget { z, .. }) => (z - state.z) / dt,
        }
    }

    /// Start of a step: sets the velocity along z of a kinematic body with a target to the velocity that reaches the target in
    /// `dt` seconds. A target that needs an infinite velocity is dropped.
    fn begin_kinematic(&mut self, id: crate::body::BodyId, dt: f32) {
        let velocity = self.kinematic_velocity(id, dt);
        let state = self.body_mut(id);
        let Some(DepthTarget { is_reached, .. }) = state.target else { return };
        state.velocity = velocity;
        state.target = state.target.filter(|_| !is_reached && state.velocity.is_finite());
    }

    /// Returns whether the next step moves a kinematic body along z.
    pub(in crate::precise) fn is_kinematic_moving(&self, id: crate::body::BodyId) -> bool {
        let DepthBodyState { velocity, target, .. } = self.body(id);
        target.map_or(velocity != 0.0, |target| !target.is_reached)
    }

    /// Sets velocity, acceleration, displacement and ball spin of a body that falls asleep to 0, and appends the body to
    /// `newly_asleep`.
    pub(in crate::precise) fn put_to_rest(&mut self, body_index: usize, id: crate::body::BodyId) {
        self.ball_spins[body_index] = BallSpin::default();
        let state = self.body_mut(id);
        (state.velocity, state.acceleration, state.angular_velocity) = (0.0, 0.0, [0.0; 2]);
        state.displacement = [0.0; 3];
        self.newly_asleep.push(id);
    }
}

/// Returns the deceleration of a body along z by quadratic drag, in length units/s^2. Components 0, 1 and 3 of the array are
/// its velocity along x, y and z in length units/s.
fn quadratic_drag(body: &Body, [x, y, _, z]: [f32; 4]) -> f32 {
    if !body.is_quadratic_drag_enabled() {
        return 0.0;
    }
    let speed = (x * x + y * y + z * z).sqrt();
    z * speed * body.quadratic_drag_coefficient() * body.inverse_mass()
}

/// Stages of the contact solver for constraints in three axes.
impl IterativeSolver<'_> {
    /// Adds the velocity changes by the accumulated impulses of all constraints to `BodySet::warm_start` and to the ball spins.
    /// Also performs load adaptation, and stores the approach velocities of constraints with restitution. Returns whether an
    /// approach speed exceeds the restitution threshold.
    pub(in crate::precise) fn accumulate_warm_start_3d(&mut self, step: &StepContext) -> bool {
        let threshold = self.has_restitution.then_some(self.restitution_threshold);
        let IterativeSolver { bodies, constraints: rows, joints, depth: Some(space), .. } = self else {
            return false;
        };
        let learning = (&step.load_adaptation, joints.iterative_body_masks());
        let (warm, hot) = (&mut bodies.warm_start, &bodies.states);
        let spins = &mut space.ball_spins[..];
        spins.iter_mut().for_each(|spin| spin.warm_start = [0.0; 4]);
        let ConstraintGraph3 { prisms, balls, prisms_static: prisms_fixed, balls_static: balls_fixed } =
            &mut rows.depth;
        accumulate_warm_start_3d::<false, 2>(prisms, warm, hot, spins, learning, threshold)
            | accumulate_warm_start_3d::<false, 1>(balls, warm, hot, spins, learning, threshold)
            | accumulate_warm_start_3d::<true, 2>(prisms_fixed, warm, hot, spins, learning, threshold)
            | accumulate_warm_start_3d::<true, 1>(balls_fixed, warm, hot, spins, learning, threshold)
    }

    /// Start of a substep: adds the warm start of each sphere to its angular velocity about x and y. `is_first` is true in the
    /// first substep of a step.
    pub(in crate::precise) fn apply_spin_warm_start(&mut self, is_first: bool) {
        if let Some(space) = self.depth.as_mut().filter(|space| space.has_balls) {
            apply_spin_warm_start(&mut space.ball_spins, is_first);
        }
    }

    /// Solves the normal rows of all constraints as soft constraints with bias velocity, once per substep.
    pub(in crate::precise) fn solve_with_bias_3d(&mut self, step: &StepContext, substep: ContactSubstep) {
        let hot = &mut self.bodies.states;
        let ConstraintGraph3 { prisms, balls, prisms_static: prisms_fixed, balls_static: balls_fixed } =
            &mut self.constraints.depth;
        if let Some(masks) = self.joints.iterative_body_masks() {
            let (soft, fixed) = (step.softness_with_joints(false), step.softness_with_joints(true));
            solve_with_joint_softness::<false, 2, _>(prisms, hot, substep, soft, masks);
            solve_with_joint_softness::<false, 1, _>(balls, hot, substep, soft, masks);
            solve_with_joint_softness::<true, 2, _>(prisms_fixed, hot, substep, fixed, masks);
            solve_with_joint_softness::<true, 1, _>(balls_fixed, hot, substep, fixed, masks);
            return;
        }
        solve_with_bias::<false, 2, _>(prisms, hot, substep, step.contact_softness);
        solve_with_bias::<false, 1, _>(balls, hot, substep, step.contact_softness);
        solve_with_bias::<true, 2, _>(prisms_fixed, hot, substep, step.static_softness);
        solve_with_bias::<true, 1, _>(balls_fixed, hot, substep, step.static_softness);
    }

    /// Relaxation: solves the normal rows of all constraints without bias, and friction along both tangents.
    pub(in crate::precise) fn relax_3d(&mut self, substep: ContactSubstep) {
        let IterativeSolver { bodies, constraints: rows, depth: Some(space), .. } = self else { return };
        let (hot, spins) = (&mut bodies.states, &mut space.ball_spins);
        let ConstraintGraph3 { prisms, balls, prisms_static: prisms_fixed, balls_static: balls_fixed } =
            &mut rows.depth;
        relax_3d::<false, 2>(prisms, hot, spins, substep);
        relax_3d::<false, 1>(balls, hot, spins, substep);
        relax_3d::<true, 2>(prisms_fixed, hot, spins, substep);
        relax_3d::<true, 1>(balls_fixed, hot, spins, substep);
    }

    /// Applies restitution to all constraints after the substeps. `is_last`: bodies that bounce get the position of a bounce at
    /// the time of impact. The impulses of restitution are added to `step_impulses`.
    pub(in crate::precise) fn apply_restitution_3d(&mut self, step: &StepContext, is_last: bool) {
        let threshold = self.restitution_threshold;
        let IterativeSolver { constraints: rows, bodies, color_usage, joints, .. } = self;
        let mut hot = std::mem::take(&mut bodies.states);
        macro_rules! bounce_all {
            ($fixed:literal, $points:literal, $rows:expr) => {
                apply_restitution::<$fixed, $points, _>($rows, &mut hot, threshold, |row, lanes, hot| {
                    if is_last {
                        resolve_bounce(bodies, hot, (color_usage, joints), step, row, lanes)
                    } else {
                        joints.record_restitution(&row.planar, lanes)
                    }
                })
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
        bodies.states = hot;
    }
}

/// Returns the approach speed in length units/s below which there is no restitution. A resting body approaches no faster than
/// gravity accelerates it in a few steps. Without gravity the threshold is 0. `gravity_delta`: velocity change by gravity in
/// the step, length units/s.
pub(in crate::precise) fn restitution_threshold_3d(gravity_delta: Vector, parameters: &Parameters) -> f32 {
    let resting = RESTITUTION_GRAVITY_STEPS * length(gravity_delta);
    if resting < parameters.restitution_threshold { resting } else { parameters.restitution_threshold }
}

impl ConstraintGraph3 {
    /// Calls `change` for each accumulated, summed and rest impulse of the constraints in three axes, in mass units * length
    /// units/s (twist: times length units).
    pub(in crate::precise) fn for_each_impulse(&mut self, change: &impl Fn(&mut wide::f32x4)) {
        fn change_all<const P: usize>(
            row: &mut super::ContactConstraint3Simd<P>,
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
