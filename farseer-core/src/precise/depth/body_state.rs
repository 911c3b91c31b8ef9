//! Adapter: depth states of bodies, which the engine above sets, and their way into the arrays of the solver and back.

use super::friction_3d::BallSpin;
use super::interface::{DepthBodyState, DepthTarget};
use super::state::DepthState;
use crate::body::{Body, BodyId};
use crate::math::decay;
use crate::precise::bodies::BodySet;
use crate::precise::body_import::BodyForces;
use crate::precise::scaled_parameters::StepContext;

/// Import of edits at the start of a step.
impl DepthState {
    /// Returns whether the game has moved a body along z since the last step.
    pub(in crate::precise) fn was_moved_along_z(&self, body_index: usize, id: BodyId) -> bool {
        self.z_positions[body_index] != self.body(id).z
    }

    /// Copies z, velocity along z and ball spin of an edited body to the solver.
    pub(in crate::precise) fn import_body(&mut self, bodies: &mut BodySet, body_index: usize, id: BodyId) {
        let state = self.body(id);
        self.z_positions[body_index] = state.z;
        if let Some(hot) = bodies.states.get_mut(body_index) {
            hot.velocity[3] = state.velocity;
            let [x, y] = state.angular_velocity;
            self.ball_spins[body_index] = BallSpin { velocity: [x, y, 0.0, 0.0], ..BallSpin::default() };
        }
        self.fix_rotation_if_vertical(bodies, body_index);
    }

    /// Returns whether a body has no velocity and no acceleration along z and, if it is a sphere, no angular velocity about x
    /// and y.
    pub(in crate::precise) fn is_at_rest(&self, number: Option<usize>, id: BodyId) -> bool {
        let DepthBodyState { velocity, acceleration, angular_velocity, .. } = self.body(id);
        let is_ball = number.is_some_and(|number| self.is_ball[number]);
        velocity == 0.0 && acceleration == 0.0 && (angular_velocity == [0.0; 2] || !is_ball)
    }
}

/// Velocities before the solver, positions and velocities after it.
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
        id: BodyId,
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
        id: BodyId,
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
    pub(in crate::precise) fn kinematic_velocity(&self, id: BodyId, dt: f32) -> f32 {
        let state = self.body(id);
        match state.target {
            None => state.velocity,
            Some(DepthTarget { is_reached: true, .. }) => 0.0,
            Some(DepthTarget { z, .. }) => (z - state.z) / dt,
        }
    }

    /// Start of a step: sets the velocity along z of a kinematic body with a target to the velocity that reaches the target in
    /// `dt` seconds. A target that needs an infinite velocity is dropped.
    fn begin_kinematic(&mut self, id: BodyId, dt: f32) {
        let velocity = self.kinematic_velocity(id, dt);
        let state = self.body_mut(id);
        let Some(DepthTarget { is_reached, .. }) = state.target else { return };
        state.velocity = velocity;
        state.target = state.target.filter(|_| !is_reached && state.velocity.is_finite());
    }

    /// Returns whether the next step moves a kinematic body along z.
    pub(in crate::precise) fn is_kinematic_moving(&self, id: BodyId) -> bool {
        let DepthBodyState { velocity, target, .. } = self.body(id);
        target.map_or(velocity != 0.0, |target| !target.is_reached)
    }

    /// Sets velocity, acceleration, displacement and ball spin of a body that falls asleep to 0, and appends the body to
    /// `newly_asleep`.
    pub(in crate::precise) fn put_to_rest(&mut self, body_index: usize, id: BodyId) {
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
