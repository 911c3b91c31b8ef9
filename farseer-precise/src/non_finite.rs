//! Bodies whose pose or velocity is not finite after the solver. They get back the pose and velocity that they had before the
//! step.

use crate::index::{BodyIndex, DenseIndex};
use wide::f32x4;

use super::bodies::BodySet;
use super::depth::feature_gate::FeatureGate;
use super::depth::state::DepthState;
use super::island::sleep::SleepState;
use super::parameters::broad_phase::COORDINATE_HEADROOM;

/// Returns whether the new poses and velocities of all awake bodies are finite.
#[inline]
pub fn are_motions_finite(
    bodies: &BodySet,
    sleep: &SleepState,
    depth: Option<FeatureGate<&DepthState>>,
) -> bool {
    let BodySet { poses, delta_pose, states, .. } = bodies;
    let mut sum = f32x4::ZERO;
    for run in &sleep.awake_body_runs {
        let of_run =
            poses.slice(run.clone()).iter().zip(delta_pose.slice(run.clone())).zip(states.slice(run.clone()));
        for ((pose, delta_pose_of_body), state) in of_run {
            // The headroom leaves room for the corners of shapes around the body.
            let place =
                (f32x4::new(*pose) + f32x4::new(*delta_pose_of_body)) * f32x4::splat(COORDINATE_HEADROOM);
            sum += (place + f32x4::new(state.velocity)) * f32x4::ZERO;
        }
    }
    sum.to_array() == [0.0; 4] && depth.is_none_or(|space| are_z_motions_finite(bodies, sleep, &space))
}

/// Returns whether the new z positions of all awake bodies, and their angular velocities about x and y, are finite.
fn are_z_motions_finite(bodies: &BodySet, sleep: &SleepState, space: &DepthState) -> bool {
    // The sum of zeros; a number that is not finite gives NaN.
    let mut sum = f32x4::ZERO;
    for body in sleep.awake_body_runs.iter().cloned().flatten().map(BodyIndex::new) {
        let place = (space.z_positions[body] + bodies.delta_pose[body][3]) * COORDINATE_HEADROOM;
        sum += (space.spin_velocity(body) + f32x4::splat(place)) * f32x4::ZERO;
    }
    sum.to_array() == [0.0; 4]
}

/// Returns whether the new pose and velocity of a body are finite.
fn is_motion_finite(bodies: &BodySet, depth: Option<&FeatureGate<&mut DepthState>>, body: BodyIndex) -> bool {
    let (pose, path) = (bodies.poses[body], bodies.delta_pose[body]);
    let velocity = bodies.states[body].velocity;
    let z = depth.map_or(0.0, |space| space.z_positions[body]);
    let from = [pose[0], pose[1], 0.0, z];
    depth.is_none_or(|space| space.is_spin_finite(body))
        && (0..4).all(|i| velocity[i].is_finite() && ((path[i] + from[i]) * COORDINATE_HEADROOM).is_finite())
}

/// Gives each awake body whose new pose or velocity is not finite the pose and velocity that it had before the step. Returns
/// the indices of these bodies, each with whether it was the fastest of them before the step, or as fast.
#[cold]
pub fn restore_non_finite(
    bodies: &mut BodySet,
    sleep: &SleepState,
    mut depth: Option<FeatureGate<&mut DepthState>>,
) -> Vec<(BodyIndex, bool)> {
    let is_finite = |body: &BodyIndex| is_motion_finite(bodies, depth.as_ref(), *body);
    let non_finite: Vec<BodyIndex> =
        sleep.awake_bodies(bodies.last_movable).filter(|body| !is_finite(body)).collect();
    let speed = |body: BodyIndex| {
        let [x, y, spin, z] = bodies.initial_velocity[body].map(f64::from);
        x * x + y * y + spin * spin + z * z
    };
    let fastest = non_finite.iter().map(|&body| speed(body)).fold(0.0, f64::max);
    let restored = non_finite.iter().map(|&body| (body, speed(body) >= fastest)).collect();
    for body in non_finite {
        (bodies.states[body].velocity, bodies.delta_pose[body]) = (bodies.initial_velocity[body], [0.0; 4]);
        if let Some(space) = &mut depth {
            space.reset_non_finite_spin(body);
        }
    }
    restored
}
