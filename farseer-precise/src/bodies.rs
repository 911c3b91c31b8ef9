//! State of all bodies in arrays, as the solvers read and write it.
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
//! updates and in callbacks the objects of the game hold the valid state: a step copies it to these arrays before the solver
//! and back after it.
//!
//! An array `[f32; 4]` has the components x, y (length units), rotation about Z (radians) and z (length units), or their rates
//! per second.

use crate::index::{BodyIndex, DenseIndex, IndexRange, IndexedVec};
use crate::parameters::broad_phase::{BODIES_PER_SPARE_POSITION, MIN_SPARE_POSITIONS};
use wide::f32x4;

use super::shape::Shape;
use crate::math::lanes::sin_cos;
use crate::math::plane::Pose;
use crate::math::plane::TWO_PI;
use crate::math::scalar;
use crate::reusing_clone;

/// Velocity of a movable body, and its displacement in the last substep. All solver stages read and write it (Box2D 3:
/// `b2BodyState`).
#[derive(Debug, Clone, Copy, Default)]
#[repr(C, align(32))]
pub struct MotionState {
    /// Velocity of the body: x, y (length units/s), angular velocity (radians/s), z (length units/s). World frame.
    pub velocity: [f32; 4],
    /// Displacement of the body in the last substep: x, y (length units), rotation (radians), z (length units).
    pub(crate) displacement: [f32; 4],
}

/// Properties with which a body is listed.
#[derive(Debug, Clone, Copy)]
pub struct ListedBody {
    /// Pose in the world frame: x, y in length units, cosine and sine of the rotation.
    pub pose: Pose,
    /// Rotation in the world frame, radians.
    pub rotation: f32,
    /// Velocity: x, y (length units/s), angular velocity (radians/s), 0 for z.
    pub velocity: [f32; 4],
    /// Reciprocals of mass (1/mass units) and moment of inertia (1/(mass units * length units^2)); 0 for infinite values.
    pub inverse_mass_inertia: [f32; 2],
    /// Factor of gravity, dimensionless.
    pub gravity_scale: f32,
    /// Whether the body is kinematic; else it is dynamic or static.
    pub is_kinematic: bool,
    /// Whether continuous collision of the body also counts against dynamic bodies.
    pub is_bullet: bool,
}

/// Returns the number of spare entries for lists of `count` bodies or proxies, static ones included.
pub fn spare_capacity(count: usize) -> usize {
    count / BODIES_PER_SPARE_POSITION + MIN_SPARE_POSITIONS
}

/// All bodies by index. Arrays of movable bodies have a length that is a multiple of 4, for SIMD.
#[derive(Debug, Default)]
pub struct BodySet {
    /// Greatest index of a movable body; entries below it may be empty.
    pub last_movable: BodyIndex,
    /// Number of dynamic and kinematic bodies, without boxes and empty entries.
    pub movable_count: usize,
    /// Whether each movable index has a dynamic or kinematic body. False for the placeholder, boxes of `twohalf` and empty
    /// entries.
    pub has_body: IndexedVec<BodyIndex, bool>,
    /// Indices of the kinematic bodies and moving boxes, ascending.
    pub kinematic: Vec<BodyIndex>,
    /// Velocity, and displacement in the last substep, of each movable body.
    pub states: IndexedVec<BodyIndex, MotionState>,
    /// Warm start of each movable body: velocity change per substep by the accumulated impulses of all its contacts and joints.
    /// X, y (length units/s), angular velocity (radians/s), z (length units/s).
    pub(crate) warm_start: IndexedVec<BodyIndex, [f32; 4]>,
    /// Velocity of each movable body after forces and warm start of the current substep: x, y (length units/s), angular
    /// velocity (radians/s), z (length units/s).
    pub(crate) warm_started_velocity: IndexedVec<BodyIndex, [f32; 4]>,
    /// Velocity of each movable body at the beginning of the step: x, y (length units/s), angular velocity (radians/s), z
    /// (length units/s).
    pub initial_velocity: IndexedVec<BodyIndex, [f32; 4]>,
    /// Velocity change of each movable body per substep by forces, gravity and drag: x, y (length units/s), angular velocity
    /// (radians/s), z (length units/s).
    pub force_delta: IndexedVec<BodyIndex, [f32; 4]>,
    /// Correction of the displacement of each movable body in the step for applied forces, which move it by the symplectic Euler
    /// method: x, y (length units), rotation (radians), z (length units).
    pub force_position_delta: IndexedVec<BodyIndex, [f32; 4]>,
    /// Displacement of each movable body in the step: x, y (length units), rotation (radians), z (length units).
    pub delta_pose: IndexedVec<BodyIndex, [f32; 4]>,
    /// Reciprocals of mass (1/mass units) and moment of inertia (1/(mass units * length units^2)) of each body, static ones
    /// included; 0 for infinite values.
    pub inverse_mass_inertia: IndexedVec<BodyIndex, [f32; 2]>,
    /// Factor of gravity for each body that has an entry in `inverse_mass_inertia`, dimensionless.
    pub gravity_scales: IndexedVec<BodyIndex, f32>,
    /// `[0, 0, radius, 1]` for each movable body that is one circle about its origin, radius in length units; else all 0.
    pub(crate) circles: IndexedVec<BodyIndex, [f32; 4]>,
    /// Greatest distance of the surface of each movable body from its origin, length units, >= 0 (Box2D 3: `maxExtent`).
    /// Infinite for kinematic bodies, which never sleep.
    pub max_extents: IndexedVec<BodyIndex, f32>,
    /// Least distance of the surface of each movable body from the middle of a convex piece, length units, >= 0 (Box2D 3:
    /// `minExtent`). A body that moves farther in a step gets continuous collision. Infinite for bodies without shapes.
    pub(crate) min_extents: IndexedVec<BodyIndex, f32>,
    /// Whether continuous collision of each movable body also counts against dynamic bodies.
    pub are_bullets: IndexedVec<BodyIndex, bool>,
    /// Poses of all bodies in the world frame, static ones included: x, y in length units, cosine and sine of the rotation.
    pub poses: IndexedVec<BodyIndex, Pose>,
    /// Rotations of all bodies in the world frame, radians.
    pub rotations: IndexedVec<BodyIndex, f32>,
}

reusing_clone! {
    BodySet {
        last_movable, movable_count, has_body, kinematic, states, warm_start, warm_started_velocity, initial_velocity, force_delta, force_position_delta, delta_pose, inverse_mass_inertia,
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
/// 0 by less than that alternates between both ends. Subtraction of this `f32` from rotations above `ROTATION_WRAP_MIN` gives
/// both ends equal poses.
#[inline(always)]
pub fn sin_cos_of_rotation(rotations: f32x4) -> (f32x4, f32x4) {
    let is_small = rotations.simd_gt(f32x4::splat(-0.5)) & rotations.simd_lt(f32x4::splat(7.0));
    let turn = f32x4::splat(TWO_PI) & rotations.simd_gt(f32x4::splat(ROTATION_WRAP_MIN));
    let (sine, cosine) = sin_cos((rotations - turn) & is_small);
    if is_small.all() { (sine, cosine) } else { sin_cos_of_any_rotation(rotations, sine, cosine) }
}

/// Returns the angle in radians for which [`sin_cos_of_rotation`] computes sine and cosine: rotations above
/// [`ROTATION_WRAP_MIN`] are negative.
pub(crate) fn signed_angle(rotation: f32) -> f64 {
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

impl BodySet {
    /// Returns the index of the first static body.
    pub fn first_static(&self) -> BodyIndex {
        self.states.next_index()
    }

    /// Iterates over the indices of the movable bodies, ascending. Moving boxes and empty entries are among them.
    #[inline]
    pub fn movable(&self) -> IndexRange<BodyIndex> {
        IndexRange { start: BodyIndex(1), end: self.last_movable.next() }
    }

    /// Lists all bodies anew: moving boxes of `twohalf`, then dynamic and kinematic bodies, spare capacity and static bodies.
    /// `moving`: pose and rotation (radians) of each moving box. Memory is reserved for `count` bodies of all types, and the spare
    /// capacity is in proportion to them: the cost of a rebuild grows with all, so that it has to come the more seldom.
    pub fn rebuild(
        &mut self,
        count: usize,
        moving: impl Iterator<Item = (Pose, f32)>,
        movable: impl Iterator<Item = ListedBody>,
        statics: impl Iterator<Item = ListedBody>,
    ) {
        self.clear_pushed();
        self.reserve(count);
        self.push_placeholder();
        self.push_movable(MotionState::default(), f32::INFINITY, [false; 2]);
        moving.for_each(|(pose, rotation)| {
            self.kinematic.push(self.poses.next_index());
            self.push_movable(MotionState::default(), f32::INFINITY, [false; 2]);
            self.add_world_box(pose, rotation);
        });
        let first = self.poses.len();
        movable.for_each(|body| {
            if body.is_kinematic {
                self.kinematic.push(self.poses.next_index());
            }
            let state = MotionState { velocity: body.velocity, ..MotionState::default() };
            let max_extent = if body.is_kinematic { f32::INFINITY } else { 0.0 };
            self.push_movable(state, max_extent, [true, body.is_bullet]);
            self.push_body(&body);
        });
        self.last_movable = BodyIndex::new(self.poses.len() - 1);
        self.movable_count = self.poses.len() - first;
        let padded = (self.poses.len() + spare_capacity(count)).next_multiple_of(4);
        (self.poses.len()..padded).for_each(|_| self.push_placeholder());
        statics.for_each(|body| self.push_body(&body));
        self.pad_movable(padded);
    }

    /// Clears the lists that [`rebuild`](Self::rebuild) extends body by body.
    fn clear_pushed(&mut self) {
        self.has_body.clear();
        self.kinematic.clear();
        self.poses.clear();
        self.rotations.clear();
        self.inverse_mass_inertia.clear();
        self.gravity_scales.clear();
        self.max_extents.clear();
        self.states.clear();
        self.are_bullets.clear();
    }

    /// Lengthens the lists of movable bodies to `padded` entries, and clears those that [`rebuild`](Self::rebuild) does not extend.
    fn pad_movable(&mut self, padded: usize) {
        self.has_body.resize(padded, false);
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
        self.has_body.reserve(capacity);
        self.poses.reserve(capacity);
        self.rotations.reserve(capacity);
        self.inverse_mass_inertia.reserve(capacity);
        self.gravity_scales.reserve(capacity);
        self.states.reserve(capacity);
        self.max_extents.reserve(capacity);
        self.are_bullets.reserve(capacity);
    }

    /// Appends an entry to those arrays of movable bodies that [`rebuild`](Self::rebuild) extends body by body. `max_extent`:
    /// greatest extent, length units. Flags: whether the entry has a body, and whether that is a bullet.
    fn push_movable(&mut self, state: MotionState, max_extent: f32, [has_body, is_bullet]: [bool; 2]) {
        self.has_body.push(has_body);
        self.states.push(state);
        self.max_extents.push(max_extent);
        self.are_bullets.push(is_bullet);
    }

    /// Appends an entry without a body: infinite mass, pose at the origin of the world.
    fn push_placeholder(&mut self) {
        self.add_world_box([0.0, 0.0, 1.0, 0.0], 0.0);
    }

    /// Appends a body to the arrays of all bodies.
    fn push_body(&mut self, body: &ListedBody) {
        self.poses.push(body.pose);
        self.rotations.push(body.rotation);
        self.inverse_mass_inertia.push(body.inverse_mass_inertia);
        self.gravity_scales.push(body.gravity_scale);
    }

    /// Appends a static body, whose mass is infinite, to the arrays of all bodies. Returns its index.
    pub fn add_static(&mut self, body: &ListedBody) -> BodyIndex {
        self.push_body(body);
        BodyIndex::new(self.poses.len() - 1)
    }

    /// Appends a box of `twohalf`, which has a pose and infinite mass but no body. Returns its
    /// index.
    pub(crate) fn add_world_box(&mut self, pose: Pose, rotation: f32) -> BodyIndex {
        let index = self.poses.push(pose);
        self.rotations.push(rotation);
        self.inverse_mass_inertia.push([0.0; 2]);
        self.gravity_scales.push(0.0);
        index
    }

    /// Adds a dynamic or kinematic body at the empty index `place`, or in the spare capacity if that is `None`. Returns its index;
    /// `None` if there is no capacity left.
    pub fn add_movable(&mut self, body: &ListedBody, place: Option<BodyIndex>) -> Option<BodyIndex> {
        let index = place.unwrap_or(self.last_movable.next());
        if index >= self.first_static() {
            return None;
        }
        if body.is_kinematic {
            let before = self.kinematic.partition_point(|&other| other < index);
            self.kinematic.insert(before, index);
        }
        self.has_body[index] = true;
        self.set_pose(index, (body.pose, body.rotation));
        self.inverse_mass_inertia[index] = body.inverse_mass_inertia;
        self.gravity_scales[index] = body.gravity_scale;
        self.are_bullets[index] = body.is_bullet;
        self.set_velocity(index, body.velocity);
        (self.last_movable, self.movable_count) = (self.last_movable.max(index), self.movable_count + 1);
        Some(index)
    }

    /// Removes the body at `index`; the entry stays empty until the next rebuild.
    pub fn remove(&mut self, index: BodyIndex) {
        if index >= self.first_static() {
            return;
        }
        self.has_body[index] = false;
        self.movable_count -= 1;
        self.kinematic.retain(|&kinematic| kinematic != index);
        self.put_to_rest(index, 1.0);
        self.inverse_mass_inertia[index] = [0.0; 2];
        self.are_bullets[index] = false;
        (self.max_extents[index], self.min_extents[index]) = (f32::INFINITY, f32::INFINITY);
        self.circles[index] = [0.0; 4];
    }

    /// Computes `max_extents`, `min_extents` and `circles` of a body. `shapes`: each convex piece of the body with its least
    /// extent in length units.
    pub fn compute_extents(&mut self, index: BodyIndex, shapes: impl Iterator<Item = (Shape, f32)>) {
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
    pub fn is_kinematic(&self, index: BodyIndex) -> bool {
        self.kinematic.binary_search(&index).is_ok()
    }

    /// Returns whether the body at this index is dynamic.
    pub fn is_dynamic(&self, index: BodyIndex) -> bool {
        index <= self.last_movable && self.has_body[index] && !self.is_kinematic(index)
    }

    /// Returns the distance that a body moved in the last step, length units. It is the displacement of the origin along all
    /// axes, plus the displacement of the farthest point by rotation.
    pub(crate) fn distance_moved(&self, index: BodyIndex) -> f32 {
        let [x, y, rotation, z] = self.delta_pose[index];
        x.abs() + y.abs() + z.abs() + self.max_extents[index] * rotation.abs()
    }

    /// Returns whether any component of a body's velocity is not 0.
    pub(crate) fn has_velocity(&self, index: BodyIndex) -> bool {
        self.states[index].velocity != [0.0; 4]
    }

    /// Clears the velocity, the velocity changes and the displacements of a body.
    ///
    /// Returns the acceleration by applied forces that the body had in a step of `dt` seconds: x, y (length units/s^2), angular
    /// (radians/s^2), z (length units/s^2).
    pub fn put_to_rest(&mut self, index: BodyIndex, dt: f32) -> [f32; 4] {
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

    /// Sets the velocity of a movable body: x, y (length units/s), angular velocity (radians/s), z (length units/s). Static
    /// bodies have none.
    pub fn set_velocity(&mut self, index: BodyIndex, velocity: [f32; 4]) {
        if let Some(state) = self.states.at_mut(index) {
            state.velocity = velocity;
        }
    }

    /// Sets the displacement in the last step (`delta_pose`) of a teleported body to 0.
    pub fn clear_delta_pose(&mut self, index: BodyIndex) {
        if let Some(delta_pose) = self.delta_pose.at_mut(index) {
            *delta_pose = [0.0; 4];
        }
    }

    /// Sets the displacements in the last step (`delta_pose`) of all bodies to 0. Snapshots contain them only while there are
    /// one-way geoms, which read them.
    pub fn clear_delta_poses(&mut self) {
        self.delta_pose.fill([0.0; 4]);
    }

    /// Sets the pose (x, y in length units, cosine and sine of the rotation) and the rotation (radians) of a body, world frame.
    pub fn set_pose(&mut self, index: BodyIndex, pose_and_rotation: (Pose, f32)) {
        (self.poses[index], self.rotations[index]) = pose_and_rotation;
    }
}
