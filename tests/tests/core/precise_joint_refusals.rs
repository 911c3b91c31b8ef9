//! The precise set: edits that would leave a joint without sense are refused, and the force of a joint that broke.

use conformance::fixtures::plane::{add_box, precise, run, simulator, v};
use farseer_core::{
    AngleLimitJoint, BodyId, Event, FixedAngleLimitJoint, JointFactory, PhysicsSimulator, Result,
    SliderJoint, SolverChoice,
};

fn two_bodies(simulator: &mut PhysicsSimulator) -> [BodyId; 2] {
    [0.0, 50.0].map(|x| add_box(simulator, (10.0, 10.0), v(x, 0.0)).0)
}

fn assert_message(refused: Result<()>, message: &str) {
    assert_eq!(refused.unwrap_err().to_string(), message);
}

#[test]
fn setters_refuse_reversed_ranges_and_keep_the_old_range() {
    let mut simulator = precise(0.0);
    let [a, b] = two_bodies(&mut simulator);
    let zero = v(0.0, 0.0);
    let rope = JointFactory::create_slider_joint_in(&mut simulator, a, zero, b, zero, 10.0, 60.0).unwrap();
    let rope: &mut SliderJoint = simulator.joint_as_mut(rope).unwrap();
    assert_message(rope.set_min(61.0), "min is 61.0, but must be at most max");
    assert_message(rope.set_max(9.0), "max is 9.0, but must be at least min");
    assert_message(rope.set_range(5.0, 4.0), "min is 5.0, but must be at most max");
    assert!(rope.set_range(f32::NAN, 4.0).is_err() && rope.set_range(1.0, f32::INFINITY).is_err());
    assert_eq!((rope.min(), rope.max()), (10.0, 60.0));
    rope.set_range(70.0, 80.0).unwrap();
    rope.set_min(80.0).unwrap();
    assert_eq!((rope.min(), rope.max()), (80.0, 80.0));
    let limit = JointFactory::create_angle_limit_joint_in(&mut simulator, a, b, -0.5, 0.5).unwrap();
    let limit: &mut AngleLimitJoint = simulator.joint_as_mut(limit).unwrap();
    assert_message(limit.set_lower_limit(0.6), "lower_limit is 0.6, but must be at most upper_limit");
    assert_message(limit.set_upper_limit(-0.6), "upper_limit is -0.6, but must be at least lower_limit");
    limit.set_limits(1.0, 2.0).unwrap();
    assert_eq!((limit.lower_limit(), limit.upper_limit()), (1.0, 2.0));
    let limit = JointFactory::create_fixed_angle_limit_joint_in(&mut simulator, a, -0.5, 0.5).unwrap();
    let limit = simulator.typed_joint::<FixedAngleLimitJoint>(limit).unwrap();
    assert_message(
        simulator[limit].set_lower_limit(0.6),
        "lower_limit is 0.6, but must be at most upper_limit",
    );
    assert_eq!(simulator[limit].lower_limit(), -0.5);
}

#[test]
fn the_faithful_set_takes_reversed_ranges_as_the_original_does() {
    let mut simulator = simulator(0.0);
    let [a, b] = two_bodies(&mut simulator);
    let zero = v(0.0, 0.0);
    let rope = JointFactory::create_slider_joint_in(&mut simulator, a, zero, b, zero, 10.0, 60.0).unwrap();
    simulator.joint_as_mut::<SliderJoint>(rope).unwrap().set_min(61.0).unwrap();
    let joint = JointFactory::create_revolute_joint_in(&mut simulator, a, b, zero).unwrap();
    simulator.set_joint_body2(joint, a).unwrap();
}

#[test]
fn a_body_cannot_be_joined_with_itself_by_an_edit() {
    let mut simulator = precise(0.0);
    let [a, b] = two_bodies(&mut simulator);
    let joint = JointFactory::create_revolute_joint_in(&mut simulator, a, b, v(0.0, 0.0)).unwrap();
    for (refused, message) in [
        (simulator.set_joint_body1(joint, b), "another body than body2"),
        (simulator.set_joint_body2(joint, a), "another body than body1"),
    ] {
        let error = refused.unwrap_err().to_string();
        assert!(error.contains(message) && error.contains("body"), "{error}");
    }
    assert_eq!((simulator[joint].body1(), simulator[joint].body2()), (a, Some(b)));
}

#[test]
fn the_force_of_a_broken_joint_stays_the_force_that_broke_it_until_it_is_enabled_again() {
    for choice in [SolverChoice::Auto, SolverChoice::Iterative, SolverChoice::Direct] {
        for is_alone in [true, false] {
            let mut simulator = precise(300.0);
            simulator.set_solver_choice(choice);
            let (post, _) = add_box(&mut simulator, (10.0, 10.0), v(0.0, 0.0));
            simulator[post].set_is_static(true);
            let (load, _) = add_box(&mut simulator, (10.0, 10.0), v(0.0, 40.0));
            if !is_alone {
                // A ledge beside the load: its contact moves the joint to the island of contacts.
                let (ledge, _) = add_box(&mut simulator, (10.0, 100.0), v(10.0, 40.0));
                simulator[ledge].set_is_static(true);
            }
            let joint =
                JointFactory::create_revolute_joint_in(&mut simulator, post, load, v(0.0, 0.0)).unwrap();
            run(&mut simulator, 60);
            let weight = simulator[load].mass() * 300.0;
            simulator[joint].set_greatest_force(0.9 * weight).unwrap();
            let mut broke = false;
            for _ in 0..5 {
                simulator.update(1.0 / 60.0);
                broke |= simulator.events().contains(&Event::JointBroke { joint });
            }
            assert!(broke, "{choice:?} {is_alone}");
            for _ in 0..10 {
                let force = simulator[joint].force();
                assert!(
                    (force.norm() / weight - 1.0).abs() < 0.02,
                    "{choice:?} {is_alone}: {force} {weight}"
                );
                simulator.update(1.0 / 60.0);
            }
        }
    }
}
