//! Drives: bodies that a drive moves do not sleep, however slowly they move. So a motor of 0.05 rad/s turns its body by 1 rad
//! in 20 s.
//!
//! | drive | bodies that stay awake |
//! |---|---|
//! | motor of a joint | both bodies, while the joint moves |
//! | belt: surface velocity of a static body, or a speed that a handler has set | the bodies on it, while they move |
//! | kinematic body that moves | the bodies on it, and those at the other end of a joint or spring |
//!
//! A motor or belt is effective while its body moves with at least `STALLED_DRIVE_SPEED_FRACTION` of the drive's speed.
//! Islands sleep at a motor of speed 0, at a motor that has reached a limit or is too weak for its load, and on a belt where a
//! wall blocks them. They wake when the drive, the wall or the load is edited, and when an awake body touches them.

use crate::bodies::BodySet;
use crate::constraint_graph::ContactConstraint;
use crate::index::BodyIndex;
use crate::joints::JointSystem;
use crate::parameters::sleep::STALLED_DRIVE_SPEED_FRACTION;

/// Returns whether a drive of this `speed` moved its body by `distance` in a step of `dt` seconds, up to the fraction at which
/// it counts as stalled. Linear drives: length units/s and length units; rotary motors: radians/s and radians.
fn is_drive_effective(speed: f32, distance: f32, dt: f32) -> bool {
    speed != 0.0 && distance >= STALLED_DRIVE_SPEED_FRACTION * speed.abs() * dt
}

/// Returns whether a body moves on a running belt. `contact` is the contact constraint of the body with the belt, `dt` the step
/// in seconds.
pub(super) fn is_on_running_belt(
    bodies: &BodySet,
    body: BodyIndex,
    contact: &ContactConstraint,
    dt: f32,
) -> bool {
    let speed = contact.tangent_speed.abs() + contact.depth.across_speed.abs();
    contact.friction > 0.0 && is_drive_effective(speed, bodies.distance_moved(body), dt)
}

/// Calls `visit` with the index of each dynamic body that a motor moves, and of each dynamic body that a joint or spring
/// connects to a moving kinematic body. `springs`: body indices at both ends of each enabled spring, 0 for the world. `dt`: step
/// in seconds.
pub(super) fn for_each_driven(
    bodies: &BodySet,
    joints: &JointSystem,
    springs: impl Iterator<Item = [BodyIndex; 2]>,
    dt: f32,
    mut visit: impl FnMut(BodyIndex),
) {
    for (ends, speed, is_along_line) in joints.motors() {
        let [a, b] = ends.map(|body| bodies.delta_pose.at(body).copied().unwrap_or_default());
        let [x, y, rotation] = [0, 1, 2].map(|axis: usize| (b[axis] - a[axis]).abs());
        if is_drive_effective(speed, if is_along_line { x + y } else { rotation }, dt) {
            ends.into_iter().filter(|&body| bodies.is_dynamic(body)).for_each(&mut visit);
        }
    }
    for [a, b] in joints.body_pairs().chain(springs) {
        for (one, other) in [(a, b), (b, a)] {
            if bodies.is_kinematic(one) && bodies.has_velocity(one) && bodies.is_dynamic(other) {
                visit(other);
            }
        }
    }
}
