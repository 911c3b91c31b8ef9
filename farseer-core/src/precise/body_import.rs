//! Adapter: reads [`Body`] objects into the numbers that [`BodySet`] holds, and the forces on them.

use wide::f32x4;

use crate::body::Body;
use farseer_precise::bodies::{BodySet, ListedBody, sin_cos_of_rotation};
use farseer_precise::index::BodyIndex;
use farseer_precise::integration::BodyForces;
use farseer_precise::math::plane::Pose;

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

/// Returns whether the pose of `body` differs from the pose stored at `index`, since it was edited.
#[inline(always)]
pub(super) fn was_moved(bodies: &BodySet, index: BodyIndex, body: &Body) -> bool {
    let (pose, position) = (&bodies.poses[index], body.position());
    position.x != pose[0] || position.y != pose[1] || body.rotation() != bodies.rotations[index]
}

/// Returns whether the bits of a body's pose differ from those in `bodies`: it was moved, or the sign of a zero has changed.
pub(super) fn has_other_pose_bits(bodies: &BodySet, index: BodyIndex, body: &Body) -> bool {
    let ([x, y, ..], position) = (bodies.poses[index], body.position());
    [x, y, bodies.rotations[index]].map(f32::to_bits)
        != [position.x, position.y, body.rotation()].map(f32::to_bits)
}

/// Returns the properties with which a body is listed. `is_movable`: whether the body is dynamic or kinematic; the mass of a
/// static body is infinite.
pub(super) fn listed_body(body: &Body, is_movable: bool) -> ListedBody {
    let (pose, rotation) = pose_of(body);
    ListedBody {
        pose,
        rotation,
        velocity: velocity_of(body),
        inverse_mass_inertia: if is_movable { inverse_mass_inertia_of(body) } else { [0.0; 2] },
        gravity_scale: body.effective_gravity_scale(),
        is_kinematic: body.is_kinematic(),
        is_bullet: body.is_bullet(),
    }
}

/// Returns the velocity of a body: x, y (length units/s), angular velocity (radians/s), and 0 for z.
pub(super) fn velocity_of(body: &Body) -> [f32; 4] {
    let velocity = body.linear_velocity();
    [velocity.x, velocity.y, body.angular_velocity(), 0.0]
}

/// Begins a step of a body: returns its velocity, and its changes by forces, gravity and drag. `gravity`: acceleration of a body of
/// gravity scale 1, length units/s^2. Step and substeps take `dt` and `h` seconds.
#[inline(always)]
pub(super) fn read_body(body: &mut Body, gravity: f32x4, dt: f32, h: f32) -> BodyForces {
    if body.is_kinematic() {
        body.begin_kinematic_step(dt);
        return BodyForces { velocity: velocity_of(body), ..BodyForces::default() };
    }
    body.begin_dynamic_step();
    let velocity = f32x4::new(velocity_of(body));
    let (force, turning) = body.take_accelerations();
    let applied = f32x4::new([force.x, force.y, turning, 0.0]);
    let scale = body.effective_gravity_scale();
    BodyForces::of_step(
        velocity,
        [applied, gravity * f32x4::new([scale, scale, 0.0, 0.0])],
        body.drag_rates(),
        [dt, h],
    )
}
