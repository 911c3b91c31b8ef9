//! Adapter: reads [`Body`] objects into the numbers that [`BodySet`] holds, and computes the velocity
//! changes by forces, gravity and drag.

use wide::f32x4;

use crate::body::Body;
use farseer_precise::bodies::{BodySet, ListedBody, sin_cos_of_rotation};
use farseer_precise::index::BodyIndex;
use farseer_precise::integration::BodyForces;
use farseer_precise::math::decay;
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

/// Returns the velocity of a body, and its changes in steps of `dt` and substeps of `h` seconds by forces, gravity and drag.
/// The velocity after the step is the exact solution of `v' = a - r v` for drag rate r (1/s) and acceleration a: `v E + a (1 -
/// E) / r` with `E = exp(-r dt)`. Quadratic drag has the rate of the beginning of the step throughout.
///
/// `force_position_delta` corrects the displacement for forces that a game or a spring has applied, since they may depend on
/// the position. Free flight moves bodies by the mean of the velocities before and after the step. Under a spring force this
/// displacement would be too short, and the amplitude would grow. With the correction, applied forces move the body by the
/// velocity after the step. That is the symplectic Euler method, as in the faithful set, which keeps the amplitude.
#[inline(always)]
pub(super) fn read_body(body: &mut Body, gravity: f32x4, dt: f32, h: f32) -> BodyForces {
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
    let scale = body.effective_gravity_scale();
    let acceleration = gravity * f32x4::new([scale, scale, 0.0, 0.0]) + applied;
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
