//! The precise set: bridges of planks between two fixed points, a twentieth longer than their distance.

use conformance::fixtures::plane::{precise, v};
use farseer_core::{BodyFactory, BodyId, JointFactory, JointId, PhysicsSimulator, SolverChoice};

/// Length of a plank in px.
const PLANK: f32 = 32.0;
const GRAVITY: f32 = 320.0;
/// Half of the angle in rad of an arc whose chord is a twentieth shorter: sin(a) / a = 0.95.
const HALF_ANGLE: f32 = 0.5509;

fn add_post(simulator: &mut PhysicsSimulator, [x, y]: [f32; 2]) -> BodyId {
    let post = BodyFactory::create_body_in(simulator, 1.0, 1.0).unwrap();
    simulator[post].set_position(v(x, y));
    simulator[post].set_is_static(true);
    post
}

/// Planks that hang on an arc of a circle, which is not where they come to rest.
fn add_bridge(simulator: &mut PhysicsSimulator, planks: usize) -> Vec<JointId> {
    let radius = PLANK / 2.0 / (HALF_ANGLE / planks as f32).sin();
    let at = |joint: usize| {
        let angle = HALF_ANGLE * (2.0 * joint as f32 / planks as f32 - 1.0);
        [radius * angle.sin(), radius * (angle.cos() - HALF_ANGLE.cos())]
    };
    let mut joints = Vec::new();
    let mut last = add_post(simulator, at(0));
    for plank in 0..planks {
        let ([left, top], [right, bottom]) = (at(plank), at(plank + 1));
        let body = BodyFactory::create_rectangle_body_in(simulator, PLANK, PLANK / 4.0, 1.0).unwrap();
        simulator[body].set_position(v(0.5 * (left + right), 0.5 * (top + bottom)));
        simulator[body].set_rotation((bottom - top).atan2(right - left));
        joints.push(JointFactory::create_revolute_joint_in(simulator, last, body, v(left, top)).unwrap());
        last = body;
    }
    let end = add_post(simulator, at(planks));
    let [x, y] = at(planks);
    joints.push(JointFactory::create_revolute_joint_in(simulator, last, end, v(x, y)).unwrap());
    joints
}

/// The widest gap of a joint at any time, in px.
fn widest_gap(simulator: &mut PhysicsSimulator, joints: &[JointId], rate: f32, updates: usize) -> f32 {
    (0..updates).fold(0.0, |widest, _| {
        simulator.update(1.0 / rate);
        joints.iter().map(|&joint| simulator[joint].joint_error()).fold(widest, f32::max)
    })
}

/// The precise solution leaves position errors of 1e-5 units of length and less; the tolerance is a hundredth of a px.
#[test]
fn bridges_of_any_length_have_no_gaps_from_the_first_update_on() {
    for (planks, rate) in [(20, 60.0), (63, 60.0), (80, 60.0), (79, 30.0), (160, 120.0)] {
        let mut simulator = precise(GRAVITY);
        let joints = add_bridge(&mut simulator, planks);
        let widest = widest_gap(&mut simulator, &joints, rate, 200);
        assert!(widest < 0.01, "{planks} planks at {rate} Hz gape by {widest} px");
    }
}

/// Soft joints stretch the bridge by some px in a second, spread over its length. Corrections that take all of that in one step
/// turn planks by a radian, and open gaps of 30 px.
#[test]
fn a_bridge_that_was_soft_is_closed_without_larger_gaps() {
    for planks in [40, 80] {
        let mut simulator = precise(GRAVITY);
        let joints = add_bridge(&mut simulator, planks);
        simulator.set_solver_choice(SolverChoice::Iterative);
        let soft = widest_gap(&mut simulator, &joints, 60.0, 60);
        simulator.set_solver_choice(SolverChoice::Auto);
        let widest = widest_gap(&mut simulator, &joints, 60.0, 300);
        assert!(widest < 0.1 * PLANK, "{planks} planks: {soft} px become {widest} px");
    }
}
