//! State of all bodies in arrays, as the solvers read and write it, and the velocity changes by forces, gravity and drag.
//!
//! | indices | bodies |
//! |---|---|
//! | 0 | placeholder: stands for every static body in a constraint |
//! | 1, 2, ... | moving boxes of `twohalf`: kinematic or on a hinge |
//! | then, up to `last_movable` | dynamic and kinematic bodies, in the order of the simulator's list |
//! | up to `states.len()`, a multiple of 4 | spare capacity for new bodies |
//! | from `first_static()` on | static bodies and static boxes, with poses but without states |
//!
//! Bodies of the second and third row are called movable. A removed body leaves an empty entry until the next rebuild. Between
//! updates and in callbacks the [`Body`] objects hold the valid state: a step copies it to these arrays before the
//! solver and back after it.
//!
//! An array `[f32; 4]` has the components x, y (length units), rotation about Z (radians) and z (length units), or their rates
//! per second.

use crate::precise::parameters::broad_phase::{BODIES_PER_SPARE_POSITION, MIN_SPARE_POSITIONS};
use wide::f32x4;

use super::shape::Shape;
use crate::body::{Body, BodyId};
use crate::math::lanes::sin_cos;
use crate::math::math_helper::TWO_PI;
use crate::math::plane::Pose;
use crate::math::{Vector2, decay, scalar};
use crate::storage::reusing_clone::reusing_clone;

/// Velocity of a movable body, and its displacement in the last substep. All solver stages read and write it (Box2D 3:
/// `b2BodyState`).
#[derive(Debug, Clone, Copy, Default)]
#[repr(C, align(32))]
pub(super) struct MotionState {
    /// Velocity of the body: x, y (length units/s), angular velocity (radians/s), z (length units/s). World frame.
    pub(super) velocity: [f32; 4],
    /// Displacement of the body in the last substep: x, y (length units), rotation (radians), z (length units).
    pub(super) displacement: [f32; 4],
}

/// Returns the number of spare entries for a list of `count` bodies or proxies.
pub(super) fn spare_capacity(count: usize) -> usize {
    count / BODIES_PER_SPARE_POSITION + MIN_SPARE_POSITIONS
}

/// All bodies by index. Arrays of movable bodies have a length that is a multiple of 4, for SIMD.
#[derive(Debug, Default)]
pub(super) struct BodySet {
    /// Greatest index of a movable body; entries below it may be empty.
    pub(super) last_movable: usize,
    /// Number of dynamic and kinematic bodies, without boxes and empty entries.
    pub(super) movable_count: usize,
    /// Id of each body; `None` for the placeholder, boxes of `twohalf` and empty entries.
    pub(super) ids: Vec<Option<BodyId>>,
    /// Indices of the kinematic bodies and moving boxes, ascending.
    pub(super) kinematic: Vec<u32>,
    /// Velocity, and displacement in the last substep, of each movable body.
    pub(super) states: Vec<MotionState>,
    /// Warm start of each movable body: velocity change per substep by the accumulated impulses of all its contacts and joints.
    /// X, y (length units/s), angular velocity (radians/s), z (length units/s).
    pub(super) warm_start: Vec<[f32; 4]>,
    /// Velocity of each movable body after forces and warm start of the current substep: x, y (length units/s), angular
    /// velocity (radians/s), z (length units/s).
    pub(super) warm_started_velocity: Vec<[f32; 4]>,
    /// Velocity of each movable body at the beginning of the step: x, y (length units/s), angular velocity (radians/s), z
    /// (length units/s).
    pub(super) initial_velocity: Vec<[f32; 4]>,
    /// Velocity change of each movable body per substep by forces, gravity and drag: x, y (length units/s), angular velocity
    /// (radians/s), z (length units/s).
    pub(super) force_delta: Vec<[f32; 4]>,
    /// Correction of the displacement of each movable body in the step for applied forces, see [`read_body`]: x, y (length
    /// units), rotation (radians), z (length units).
    pub(super) force_position_delta: Vec<[f32; 4]>,
    /// Displacement of each movable body in the step: x, y (length units), rotation (radians), z (length units).
    pub(super) delta_pose: Vec<[f32; 4]>,
    /// Reciprocals of mass (1/mass units) and moment of inertia (1/(mass units * length units^2)) of each body, static ones
    /// included; 0 for infinite values.
    pub(super) inverse_mass_inertia: Vec<[f32; 2]>,
    /// Factor of gravity for each body that has an entry in `inverse_mass_inertia`, dimensionless.
    pub(super) gravity_scales: Vec<f32>,
    /// `[0, 0, radius, 1]` for each movable body that is one circle about its origin, radius in length units; else all 0.
    pub(super) circles: Vec<[f32; 4]>,
    /// Greatest distance of the surface of each movable body from its origin, length units, >= 0 (Box2D 3: `maxExtent`).
    /// Infinite for kinematic bodies, which never sleep.
    pub(super) max_extents: Vec<f32>,
    /// Least distance of the surface of each movable body from the middle of a convex piece, length units, >= 0 (Box2D 3:
    /// `minExtent`). A body that moves farther in a step gets continuous collision. Infinite for bodies without shapes.
    pub(super) min_extents: Vec<f32>,
    /// Whether continuous collision of each movable body also counts against dynamic bodies.
    pub(super) are_bullets: Vec<bool>,
    /// Poses of all bodies in the world frame, static ones included: x, y in length units, cosine and sine of the rotation.
    pub(super) poses: Vec<Pose>,
    /// Rotations of all bodies in the world frame, radians.
    pub(super) rotations: Vec<f32>,
}

reusing_clone! {
    BodySet {
        last_movable, movable_count, ids, kinematic, states, warm_start, warm_started_velocity, initial_velocity, force_delta, force_position_delta, delta_pose, inverse_mass_inertia,
        gravity_scales, circles, max_extents, min_extents, are_bullets, poses, rotations
    }
}

/// Rotations above this limit, in radians, count as negative: 2 pi is subtracted. The limit is far from multiples of a right
/// angle (4.71 and 6.28), at which boxes rest.
const ROTATION_WRAP_MIN: f32 = 5.0;

/// Returns sine and cosine of `rotations`, radians. Rotations within -0.5..7 take a fast path. Other rotations occur only after
/// an angular velocity too large for the wrap to one turn.
///
/// A body keeps its rotation between 0 and the `f32` nearest to 2 pi, which exceeds 2 pi by 1.7e-7. A body that trembles about
/// 0 by less than that alternates between both ends. Subtraction of this `f32` from rotations above [`ROTATION_WRAP_MIN`] gives
/// both ends equal poses.
#[inline(always)]
pub(super) fn sin_cos_of_rotation(rotations: f32x4) -> (f32x4, f32x4) {
    let is_small = rotations.simd_gt(f32x4::splat(-0.5)) & rotations.simd_lt(f32x4::splat(7.0));
    let turn = f32x4::splat(TWO_PI) & rotations.simd_gt(f32x4::splat(ROTATION_WRAP_MIN));
    let (sine, cosine) = sin_cos((rotations - turn) & is_small);
    if is_small.all() { (sine, cosine) } else { sin_cos_of_any_rotation(rotations, sine, cosine) }
}

/// Returns the angle in radians for which [`sin_cos_of_rotation`] computes sine and cosine: rotations above
/// [`ROTATION_WRAP_MIN`] are negative.
pub(super) fn signed_angle(rotation: f32) -> f64 {
    f64::from(rotation) - if rotation > ROTATION_WRAP_MIN { f64::from(TWO_PI) } else { 0.0 }
}

/// Returns `sine` and `cosine`, with the lanes whose rotation is outside of -0.5..7 rad replaced by the general sine and
/// cosine.
#[cold]
fn sin_cos_of_any_rotation(rotations: f32x4, mut sine: f32x4, mut cosine: f32x4) -> (f32x4, f32x4) {
    for (lane, rotation) in rotations.to_array().into_iter().enumerate() {
        if !(rotation > -0.5 && rotation < 7.0) {
            // From 2^63 on `scalar::sin_cos` returns the angle itself, as the original does.
            let (s, c) = if rotation.abs() < 1e18 { scalar::sin_cos(rotation) } else { (0.0, 1.0) };
            (sine.as_mut_array()[lane], cosine.as_mut_array()[lane]) = (s, c);
        }
    }
    (sine, cosine)
}

/// Returns the pose of a body (x, y in length units, cosine and sine of the rotation) and its rotation (radians), world frame.
pub(super) fn pose_of(body: &Body) -> (Pose, f32) {
    let (position, rotation) = (body.position(), body.rotation());
    let (sine, cosine) = sin_cos_of_rotation(f32x4::splat(rotation));
    ([position.x, position.y, cosine.to_array()[0], sine.to_array()[0]], rotation)
}

/// Returns the radius of gyration sqrt(I / m) of a body, length units: the extent of a body without geoms. 0 if it is not
/// finite.
pub(super) fn gyration_radius(body: &Body) -> f32 {
    let radius = (body.moment_of_inertia() / body.mass()).abs().sqrt();
    if radius.is_finite() { radius } else { 0.0 }
}

/// Returns the reciprocals of mass (1/mass units) and moment of inertia (1/(mass units * length units^2)) of a body, for
/// constraints. Subnormal reciprocals become 0, since they lose digits.
pub(super) fn inverse_mass_inertia_of(body: &Body) -> [f32; 2] {
    [body.inverse_mass(), body.inverse_moment_of_inertia()]
        .map(|inverse| if inverse >= f32::MIN_POSITIVE { inverse } else { 0.0 })
}

impl BodySet {
    /// Returns the index of the first static body.
    pub(super) fn first_static(&self) -> usize {
        self.states.len()
    }

    /// Lists all bodies anew: moving boxes of `twohalf`, then dynamic and kinematic bodies, spare capacity and static bodies.
    /// `moving`: pose and rotation (radians) of each moving box. Memory is reserved for `count` bodies.
    pub(super) fn rebuild<'a>(
        &mut self,
        count: usize,
        moving: impl Iterator<Item = (Pose, f32)>,
        movable: impl Iterator<Item = (BodyId, &'a Body)>,
        statics: impl Iterator<Item = (BodyId, &'a Body)>,
    ) {
        self.ids.clear();
        self.kinematic.clear();
        self.poses.clear();
        self.rotations.clear();
        self.inverse_mass_inertia.clear();
        self.gravity_scales.clear();
        self.max_extents.clear();
        self.states.clear();
        self.are_bullets.clear();
        self.reserve(count);
        self.push_placeholder();
        self.states.push(MotionState::default());
        self.max_extents.push(f32::INFINITY);
        self.are_bullets.push(false);
        moving.for_each(|(pose, rotation)| {
            self.kinematic.push(self.ids.len() as u32);
            self.max_extents.push(f32::INFINITY);
            self.are_bullets.push(false);
            self.add_world_box(pose, rotation);
            self.states.push(MotionState::default());
        });
        let first = self.ids.len();
        movable.for_each(|(id, body)| {
            if body.is_kinematic() {
                self.kinematic.push(self.ids.len() as u32);
            }
            self.max_extents.push(if body.is_kinematic() { f32::INFINITY } else { 0.0 });
            self.are_bullets.push(body.is_bullet());
            self.push_body(id, body, inverse_mass_inertia_of(body));
            self.states.push(MotionState { velocity: velocity_of(body), ..MotionState::default() });
        });
        self.last_movable = self.ids.len() - 1;
        self.movable_count = self.ids.len() - first;
        let padded = (self.ids.len() + spare_capacity(self.last_movable)).next_multiple_of(4);
        (self.ids.len()..padded).for_each(|_| self.push_placeholder());
        statics.for_each(|(id, body)| self.add_static(id, body));
        self.states.resize(padded, MotionState::default());
        self.max_extents.resize(padded, f32::INFINITY);
        self.are_bullets.resize(padded, false);
        self.min_extents.clear();
        self.min_extents.resize(padded, f32::INFINITY);
        for array in [
            &mut self.warm_start,
            &mut self.warm_started_velocity,
            &mut self.initial_velocity,
            &mut self.force_delta,
            &mut self.force_position_delta,
            &mut self.delta_pose,
            &mut self.circles,
        ] {
            array.clear();
            array.resize(padded, [0.0; 4]);
        }
    }

    /// Reserves memory for `count` bodies in the lists that [`rebuild`](Self::rebuild) extends body by body.
    fn reserve(&mut self, count: usize) {
        // Further entries are the placeholder and up to 3 that make the length a multiple of 4.
        let capacity = count + spare_capacity(count) + 4;
        self.ids.reserve(capacity);
        self.poses.reserve(capacity);
        self.rotations.reserve(capacity);
        self.inverse_mass_inertia.reserve(capacity);
        self.gravity_scales.reserve(capacity);
        self.states.reserve(capacity);
        self.max_extents.reserve(capacity);
        self.are_bullets.reserve(capacity);
    }

    /// Appends an entry without a body: infinite mass, pose at the origin of the world.
    fn push_placeholder(&mut self) {
        self.ids.push(None);
        self.poses.push([0.0, 0.0, 1.0, 0.0]);
        self.rotations.push(0.0);
        self.inverse_mass_inertia.push([0.0; 2]);
        self.gravity_scales.push(0.0);
    }

    /// Appends a body to the arrays of all bodies. `inverses`: reciprocals of its mass (1/mass units) and moment of inertia
    /// (1/(mass units * length units^2)).
    fn push_body(&mut self, id: BodyId, body: &Body, inverses: [f32; 2]) {
        let (pose, rotation) = pose_of(body);
        self.ids.push(Some(id));
        self.poses.push(pose);
        self.rotations.push(rotation);
        self.inverse_mass_inertia.push(inverses);
        self.gravity_scales.push(body.effective_gravity_scale());
    }

    /// Appends a static body, whose mass is infinite, to the arrays of all bodies.
    pub(super) fn add_static(&mut self, id: BodyId, body: &Body) {
        self.push_body(id, body, [0.0; 2]);
    }

    /// Appends a box of `twohalf`, which has a pose and infinite mass but no body.
    pub(super) fn add_world_box(&mut self, pose: Pose, rotation: f32) {
        self.push_placeholder();
        self.poses.pop();
        self.rotations.pop();
        self.poses.push(pose);
        self.rotations.push(rotation);
    }

    /// Adds a dynamic or kinematic body in the spare capacity. Returns its index; `None` if there is no capacity left.
    pub(super) fn add_movable(&mut self, id: BodyId, body: &Body) -> Option<usize> {
        let index = self.last_movable + 1;
        if index >= self.first_static() {
            return None;
        }
        if body.is_kinematic() {
            self.kinematic.push(index as u32);
        }
        self.ids[index] = Some(id);
        self.set_pose(index, body);
        self.inverse_mass_inertia[index] = inverse_mass_inertia_of(body);
        self.gravity_scales[index] = body.effective_gravity_scale();
        self.are_bullets[index] = body.is_bullet();
        self.set_velocity(index, body);
        (self.last_movable, self.movable_count) = (index, self.movable_count + 1);
        Some(index)
    }

    /// Removes the body at `index`; the entry stays empty until the next rebuild.
    pub(super) fn remove(&mut self, index: usize) {
        self.ids[index] = None;
        if index >= self.first_static() {
            return;
        }
        self.movable_count -= 1;
        self.kinematic.retain(|&kinematic| kinematic as usize != index);
        self.put_to_rest(index, 1.0);
        self.inverse_mass_inertia[index] = [0.0; 2];
        self.are_bullets[index] = false;
        (self.max_extents[index], self.min_extents[index]) = (f32::INFINITY, f32::INFINITY);
        self.circles[index] = [0.0; 4];
    }

    /// Computes `max_extents`, `min_extents` and `circles` of a body. `shapes`: each convex piece of the body with its least
    /// extent in length units.
    pub(super) fn compute_extents(&mut self, index: usize, shapes: impl Iterator<Item = (Shape, f32)>) {
        let mut max_extent = if self.is_kinematic(index) { f32::INFINITY } else { 0.0 };
        let (mut min_extent, mut circle, mut count) = (f32::INFINITY, [0.0; 4], 0);
        for (shape, of_shape) in shapes {
            min_extent = if of_shape < min_extent { of_shape } else { min_extent };
            max_extent = if shape.max_extent > max_extent { shape.max_extent } else { max_extent };
            count += 1;
            let is_round = count == 1 && shape.vertex_count == 0 && shape.centre == [0.0, 0.0];
            circle = if is_round { [0.0, 0.0, shape.radius.max(f32::MIN_POSITIVE), 1.0] } else { [0.0; 4] };
        }
        (self.max_extents[index], self.min_extents[index], self.circles[index]) =
            (max_extent, min_extent, circle);
    }

    /// Returns whether the body at this index is kinematic, or a moving box of `twohalf`.
    pub(super) fn is_kinematic(&self, index: usize) -> bool {
        self.kinematic.binary_search(&(index as u32)).is_ok()
    }

    /// Returns whether the pose of `body` differs from the pose stored at `index`, since it was edited.
    #[inline(always)]
    pub(super) fn was_moved(&self, index: usize, body: &Body) -> bool {
        let (pose, position) = (&self.poses[index], body.position());
        position.x != pose[0] || position.y != pose[1] || body.rotation() != self.rotations[index]
    }

    /// Returns whether any component of a body's velocity is not 0.
    pub(super) fn has_velocity(&self, index: usize) -> bool {
        self.states[index].velocity != [0.0; 4]
    }

    /// Clears the velocity, the velocity changes and the displacements of a body.
    ///
    /// Returns the acceleration by applied forces that the body had in a step of `dt` seconds: x, y (length units/s^2), angular
    /// (radians/s^2), z (length units/s^2).
    pub(super) fn put_to_rest(&mut self, index: usize, dt: f32) -> [f32; 4] {
        let accelerations = self.force_position_delta[index].map(|way| way / (0.5 * dt * dt));
        // dt^2 may underflow to 0.
        let borne =
            if accelerations.iter().all(|number| number.is_finite()) { accelerations } else { [0.0; 4] };
        self.states[index] = MotionState::default();
        for array in [
            &mut self.warm_start,
            &mut self.warm_started_velocity,
            &mut self.initial_velocity,
            &mut self.force_delta,
            &mut self.force_position_delta,
            &mut self.delta_pose,
        ] {
            array[index] = [0.0; 4];
        }
        borne
    }

    /// Copies the velocity of an edited [`Body`] to `states`.
    pub(super) fn set_velocity(&mut self, index: usize, body: &Body) {
        if let Some(state) = self.states.get_mut(index) {
            state.velocity = velocity_of(body);
        }
    }

    /// Sets the displacement in the last step (`delta_pose`) of a teleported body to 0.
    pub(super) fn clear_delta_pose(&mut self, index: usize) {
        if let Some(delta_pose) = self.delta_pose.get_mut(index) {
            *delta_pose = [0.0; 4];
        }
    }

    /// Sets the displacements in the last step (`delta_pose`) of all bodies to 0. Snapshots contain them only while there are
    /// one-way geoms, which read them.
    pub(super) fn clear_delta_poses(&mut self) {
        self.delta_pose.fill([0.0; 4]);
    }

    /// Copies the pose of a [`Body`] to `poses` and `rotations`.
    pub(super) fn set_pose(&mut self, index: usize, body: &Body) {
        (self.poses[index], self.rotations[index]) = pose_of(body);
    }
}

/// Returns the velocity of a body: x, y (length units/s), angular velocity (radians/s), and 0 for z.
fn velocity_of(body: &Body) -> [f32; 4] {
    let velocity = body.linear_velocity();
    [velocity.x, velocity.y, body.angular_velocity(), 0.0]
}

/// Returns the velocity of a body, and its changes in steps of `dt` and substeps of `h` seconds by forces, gravity and drag.
/// The velocity after the step is the exact solution of `v' = a - r v` for drag rate r (1/s) and acceleration a: `v E + a (1 -
/// E) / r` with `E = exp(-r dt)`. Quadratic drag has the rate of the beginning of the step throughout.
///
/// `force_position_delta` corrects the displacement for forces that a game or a spring has applied, since they may depend on
/// the position. Free flight moves bodies by the mean of the velocities before and after the step. Under a spring force this
/// displacement would be too short, and the amplitude would grow. With the correction, applied forces move the body by the
/// velocity after the step. That is the symplectic Euler method, as in the faithful set, which keeps the amplitude.
#[inline(always)]
pub(super) fn read_body(body: &mut Body, gravity: Vector2, dt: f32, h: f32) -> BodyForces {
    if body.is_kinematic() {
        body.begin_kinematic_step(dt);
        return BodyForces {
            velocity: velocity_of(body),
            force_delta: [0.0; 4],
            force_position_delta: [0.0; 4],
        };
    }
    body.apply_accumulated_impulse();
    let velocity = f32x4::new(velocity_of(body));
    let (force, turning) = body.take_accelerations();
    let applied = f32x4::new([force.x, force.y, turning, 0.0]);
    let gravity = gravity * body.effective_gravity_scale();
    let acceleration = f32x4::new([gravity.x, gravity.y, 0.0, 0.0]) + applied;
    let velocity_change = match body.drag_rates() {
        // Without drag E = 1.
        (0.0, 0.0) => acceleration * f32x4::splat(dt),
        (drag, rotational_drag) => {
            let (decay, grown) =
                decay::decay_and_integral_simd(f32x4::new([drag, drag, rotational_drag, 0.0]), dt);
            velocity * decay + acceleration * grown
        }
    };
    BodyForces {
        velocity: velocity.to_array(),
        force_delta: (velocity_change * f32x4::splat(h / dt)).to_array(),
        force_position_delta: (applied * f32x4::splat(0.5 * dt * dt)).to_array(),
    }
}

/// Velocity of a body before the step, and its changes by forces in the step.
#[derive(Default)]
pub(super) struct BodyForces {
    /// Velocity at the beginning of the step: x, y (length units/s), angular velocity (radians/s), z (length units/s).
    pub(super) velocity: [f32; 4],
    /// Velocity change per substep by forces, gravity and drag: x, y (length units/s), angular velocity (radians/s), z (length
    /// units/s).
    pub(super) force_delta: [f32; 4],
    /// Correction of the displacement in the step for applied forces: x, y (length units), rotation (radians), z (length
    /// units).
    pub(super) force_position_delta: [f32; 4],
}
