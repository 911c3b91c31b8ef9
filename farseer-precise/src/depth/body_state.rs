//! Depth states of bodies, which the engine above sets, and their way into the arrays of the solver and back. A body has its state at
//! a slot: a number by which the engine above knows the body.

use super::friction_3d::BallSpin;
use super::interface::{DepthBodyState, DepthTarget};
use super::state::DepthState;
use super::state::{NO_STATE, entry, entry_mut};
use super::world_box_shape::origin_of;
use crate::bodies::BodySet;
use crate::index::BodyIndex;
use crate::integration::BodyForces;
use crate::math::decay;
use crate::scaled_parameters::StepContext;

/// Depth states of bodies, which the engine above sets and reads.
impl DepthState {
    /// Returns the depth state of the body at a slot; the default state if the slot has none.
    pub fn body(&self, slot: usize) -> DepthBodyState {
        entry(&self.bodies, slot)
    }

    /// Returns z of the first body relative to the second one (length units), and the velocity of the first along z relative to
    /// the second (length units/s).
    pub fn relative_z_and_velocity(&self, first: usize, second: usize) -> [f32; 2] {
        let (first, second) = (self.body(first), self.body(second));
        [first.z - second.z, first.velocity - second.velocity]
    }

    /// Returns world position (length units) and velocity (length units/s) of a body along z.
    pub fn z_and_velocity(&self, slot: usize) -> [f32; 2] {
        let body = self.body(slot);
        [body.z, body.velocity]
    }

    /// Returns the acceleration of a body by forces along z in the coming step, in length units/s^2.
    pub fn acceleration(&self, slot: usize) -> f32 {
        self.body(slot).acceleration
    }

    /// Sets the acceleration of a body by forces along z to 0, as after a step.
    pub fn clear_acceleration(&mut self, slot: usize) {
        self.body_mut(slot).acceleration = 0.0;
    }

    /// Sets the acceleration of a body by forces along z, in length units/s^2. The caller restores the former value of a body
    /// outside of the simulation, so that no forces accumulate on the body.
    pub fn set_acceleration(&mut self, slot: usize, acceleration: f32) {
        self.body_mut(slot).acceleration = acceleration;
    }

    /// Adds to the acceleration of a body by forces along z in the coming step, in length units/s^2.
    pub fn add_acceleration(&mut self, slot: usize, acceleration: f32) {
        self.body_mut(slot).acceleration += acceleration;
    }

    /// Returns the depth state of the body at a slot, which it makes if the slot has none.
    pub fn body_mut(&mut self, slot: usize) -> &mut DepthBodyState {
        entry_mut(&mut self.bodies, slot)
    }
}

/// Depth data by body index.
impl DepthState {
    /// Rebuilds the depth data by body index after `bodies` was rebuilt: z positions, ball spins, and the flags of spheres and
    /// fixed rotations. World boxes must have their body indices in `box_bodies`. `slots`: slot of each body, by body index; `None` for
    /// bodies without a depth state.
    pub fn rebuild_bodies(
        &mut self,
        bodies: &BodySet,
        slots: impl ExactSizeIterator<Item = Option<usize>> + Clone,
    ) {
        let DepthState {
            z_positions,
            ball_spins: spins,
            state_slots,
            is_ball,
            has_balls,
            bodies: states,
            world_boxes,
            box_bodies,
            ..
        } = self;
        self.any_fixed_rotation = false;
        self.has_fixed_rotation.clear();
        self.has_fixed_rotation.resize(bodies.poses.len(), false);
        z_positions.clear();
        z_positions.extend(slots.clone().map(|slot| slot.map_or(0.0, |slot| entry(states, slot).z)));
        z_positions.resize(bodies.poses.len(), 0.0);
        state_slots.clear();
        let movable = slots.take(bodies.states.len());
        state_slots.extend(movable.map(|slot| slot.map_or(NO_STATE, |slot| slot as u32)));
        for (&number, world_box) in box_bodies.iter().zip(world_boxes) {
            z_positions[number] = origin_of(world_box).z;
        }
        spins.clear();
        spins.resize(bodies.states.len(), BallSpin::default());
        is_ball.clear();
        is_ball.resize(bodies.poses.len(), false);
        *has_balls = false;
    }

    /// Adds the depth data of a new body at this body index, with its z position as the engine above has set it.
    pub fn add_body(&mut self, body_index: BodyIndex, slot: usize) {
        let state = self.body(slot);
        *self.z_positions.at_or_grow(body_index) = state.z;
        *self.ball_spins.at_or_grow(body_index) = BallSpin::default();
        *self.state_slots.at_or_grow(body_index) = slot as u32;
        *self.is_ball.at_or_grow(body_index) = false;
        *self.has_fixed_rotation.at_or_grow(body_index) = false;
    }
}

/// Import of edits at the start of a step.
impl DepthState {
    /// Returns whether the game has moved a body along z since the last step.
    pub fn was_moved_along_z(&self, body_index: BodyIndex, slot: usize) -> bool {
        self.z_positions[body_index] != self.body(slot).z
    }

    /// Copies z, velocity along z and ball spin of an edited body to the solver.
    pub fn import_body(&mut self, bodies: &mut BodySet, body_index: BodyIndex, slot: usize) {
        let state = self.body(slot);
        self.z_positions[body_index] = state.z;
        if let Some(motion) = bodies.states.at_mut(body_index) {
            motion.velocity[3] = state.velocity;
            let [x, y] = state.angular_velocity;
            self.ball_spins[body_index] = BallSpin { velocity: [x, y, 0.0, 0.0], ..BallSpin::default() };
        }
        self.fix_rotation_if_vertical(bodies, body_index);
    }

    /// Returns whether a body has no velocity along z and, if it is a sphere, no angular velocity about x and y.
    pub fn is_at_rest(&self, number: Option<BodyIndex>, slot: usize) -> bool {
        let DepthBodyState { velocity, angular_velocity, .. } = self.body(slot);
        let is_ball = number.is_some_and(|number| self.is_ball[number]);
        velocity == 0.0 && (angular_velocity == [0.0; 2] || !is_ball)
    }
}

/// Velocities before the solver, positions and velocities after it.
impl DepthState {
    /// Start of a step of a body that is not kinematic: stores its velocity along z and its change per substep by forces and
    /// drag in component 3 of the vectors of `read`. A sphere also gets its angular velocity about x and y, after drag, in
    /// `ball_spins`.
    pub fn begin_velocity(
        &mut self,
        (body_index, slot): (BodyIndex, usize),
        drag: &BodyDrag,
        read: &mut BodyForces,
        step: &StepContext,
    ) {
        let state = self.body(slot);
        if state.target.is_some() {
            self.body_mut(slot).target = None;
        }
        read.velocity[3] = state.velocity;
        let (along, rotational) = drag.rates;
        let ((slowed, grown), (turning_slowed, _)) =
            (decay::decay_and_integral(along, step.dt), decay::decay_and_integral(rotational, step.dt));
        let acceleration = state.acceleration - quadratic_drag(drag, read.velocity);
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
    pub fn store_position(
        &mut self,
        body_index: BodyIndex,
        slot: usize,
        [x_displacement, y_displacement, _, z_displacement]: [f32; 4],
        velocity: f32,
    ) {
        self.z_positions[body_index] += z_displacement;
        if let Some(target) = self.body_mut(slot).target.as_mut().filter(|target| !target.is_reached) {
            target.is_reached = true;
            self.z_positions[body_index] = target.z;
        }
        let ([x, y, ..], z) = (self.ball_spins[body_index].velocity, self.z_positions[body_index]);
        let state = self.body_mut(slot);
        (state.z, state.velocity, state.acceleration, state.angular_velocity) = (z, velocity, 0.0, [x, y]);
        state.displacement = [x_displacement, y_displacement, z_displacement];
    }

    /// Returns the velocity of a kinematic body along z in the coming step, in length units/s: its own velocity, or the
    /// velocity that reaches its target in `dt` seconds.
    pub fn kinematic_velocity(&self, slot: usize, dt: f32) -> f32 {
        let state = self.body(slot);
        match state.target {
            None => state.velocity,
            Some(DepthTarget { is_reached: true, .. }) => 0.0,
            Some(DepthTarget { z, .. }) => (z - state.z) / dt,
        }
    }

    /// Start of a step: sets the velocity along z of a kinematic body with a target to the velocity that reaches the target in
    /// `dt` seconds. A target that needs an infinite velocity is dropped. Returns the velocity along z, length units/s.
    pub fn begin_kinematic(&mut self, slot: usize, dt: f32) -> f32 {
        let velocity = self.kinematic_velocity(slot, dt);
        let state = self.body_mut(slot);
        if let Some(DepthTarget { is_reached, .. }) = state.target {
            state.velocity = velocity;
            state.target = state.target.filter(|_| !is_reached && state.velocity.is_finite());
        }
        state.velocity
    }

    /// Returns whether the next step moves a kinematic body along z.
    pub fn is_kinematic_moving(&self, slot: usize) -> bool {
        let DepthBodyState { velocity, target, .. } = self.body(slot);
        target.map_or(velocity != 0.0, |target| !target.is_reached)
    }

    /// Sets velocity, acceleration, displacement and ball spin of a body that falls asleep to 0.
    pub fn put_to_rest(&mut self, body_index: BodyIndex, slot: usize) {
        self.ball_spins[body_index] = BallSpin::default();
        let state = self.body_mut(slot);
        (state.velocity, state.acceleration, state.angular_velocity) = (0.0, 0.0, [0.0; 2]);
        state.displacement = [0.0; 3];
    }
}

/// Resistance of the medium to a body.
#[derive(Debug, Clone, Copy)]
pub struct BodyDrag {
    /// Rates of linear drag and of rotational drag, 1/s, >= 0.
    pub rates: (f32, f32),
    /// Coefficient of quadratic drag (mass units/length unit) and reciprocal of the mass (1/mass units); `None` without
    /// quadratic drag.
    pub quadratic: Option<[f32; 2]>,
}

/// Returns the deceleration of a body along z by quadratic drag, in length units/s^2. Components 0, 1 and 3 of the array are
/// its velocity along x, y and z in length units/s.
fn quadratic_drag(drag: &BodyDrag, [x, y, _, z]: [f32; 4]) -> f32 {
    let Some([coefficient, inverse_mass]) = drag.quadratic else { return 0.0 };
    let speed = (x * x + y * y + z * z).sqrt();
    z * speed * coefficient * inverse_mass
}
