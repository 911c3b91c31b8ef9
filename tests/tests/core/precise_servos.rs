//! The precise set: servos of hinges and prismatic joints.

use conformance::fixtures::plane::{
    SOLVERS, add_box, add_ghost, add_post, precise, run, simulator, state, v, with_solver,
};
use farseer_core::{
    BodyId, Error, Event, JointFactory, JointId, JointLimits, JointServo, Methods, PhysicsSimulator,
    PoseServo, SolverChoice,
};

const GRAVITY: f32 = 320.0;
const RATES: [f32; 3] = [30.0, 60.0, 240.0];

/// A box on a hinge of the world at its centre, and its moment of inertia.
fn hinge(choice: SolverChoice) -> (PhysicsSimulator, BodyId, JointId, f32) {
    let mut simulator = with_solver(choice, 0.0);
    let body = add_ghost(&mut simulator, (20.0, 10.0), v(0.0, 0.0));
    let joint = JointFactory::create_fixed_revolute_joint_in(&mut simulator, body, v(0.0, 0.0)).unwrap();
    let inertia = simulator[body].moment_of_inertia();
    (simulator, body, joint, inertia)
}

/// A box that slides down a post, and its mass.
fn lift(choice: SolverChoice, gravity: f32) -> (PhysicsSimulator, BodyId, JointId, f32) {
    let mut simulator = with_solver(choice, gravity);
    let post = add_post(&mut simulator, v(0.0, 0.0));
    let body = add_ghost(&mut simulator, (16.0, 8.0), v(0.0, 0.0));
    let joint = JointFactory::create_prismatic_joint_in(&mut simulator, post, body, v(0.0, 0.0), v(0.0, 1.0))
        .unwrap();
    let mass = simulator[body].mass();
    (simulator, body, joint, mass)
}

/// Position of a damped oscillator of angular frequency `w` that starts at rest at 1.
fn oscillator(w: f64, damping_ratio: f64, t: f64) -> f64 {
    let (decay, damped) = (damping_ratio * w, w * (1.0 - damping_ratio * damping_ratio).sqrt());
    (-decay * t).exp() * ((damped * t).cos() + decay / damped * (damped * t).sin())
}

#[test]
fn a_servo_swings_with_its_frequency_and_damping_at_every_rate_with_either_solver() {
    for choice in SOLVERS {
        for rate in RATES {
            for damping_ratio in [0.15, 0.5, 0.9] {
                for is_lift in [false, true] {
                    let (mut simulator, _, joint, inertia) =
                        if is_lift { lift(choice, 0.0) } else { hinge(choice) };
                    let servo = JointServo::of_frequency(1.0, 1.0, damping_ratio, inertia);
                    simulator.set_joint_servo(joint, Some(servo)).unwrap();
                    let w = std::f64::consts::TAU;
                    let mut worst: f64 = 0.0;
                    for step in 1..=(2.0 * rate) as u32 {
                        simulator.update(1.0 / rate);
                        let t = f64::from(step) / f64::from(rate);
                        let exact = 1.0 - oscillator(w, damping_ratio.into(), t);
                        worst = worst.max((f64::from(simulator.joint_travel(joint).unwrap()) - exact).abs());
                    }
                    // First order in the phase: half an angular step.
                    let step_angle = w / f64::from(rate);
                    let what = format!("{choice:?} {rate} {damping_ratio} {is_lift}: {worst}, {step_angle}");
                    assert!(worst < 0.8 * step_angle, "{what}");
                }
            }
        }
    }
}

#[test]
fn a_load_displaces_a_servo_by_the_load_divided_by_the_stiffness() {
    for choice in SOLVERS {
        for rate in RATES {
            let (mut simulator, _, joint, mass) = lift(choice, GRAVITY);
            // A body that creeps to its target would fall asleep some hundredths before it.
            simulator.set_sleep_enabled(false);
            let stiffness = mass * GRAVITY / 5.0;
            let servo =
                JointServo { target: -3.0, stiffness, damping: 20.0 * mass, greatest_effort: f32::MAX };
            simulator.set_joint_servo(joint, Some(servo)).unwrap();
            (0..(4.0 * rate) as u32).for_each(|_| simulator.update(1.0 / rate));
            let travel = simulator.joint_travel(joint).unwrap();
            assert!((travel - 2.0).abs() < 1e-3, "{choice:?} {rate}: {travel}");
            let force = simulator[joint].force();
            assert!(
                (force.y / (mass * GRAVITY) + 1.0).abs() < 1e-3 && force.x.abs() < 1e-3 * mass,
                "{force:?}"
            );
        }
    }
}

#[test]
fn a_servo_exerts_at_most_its_greatest_effort() {
    for choice in SOLVERS {
        for rate in RATES {
            let (mut simulator, body, joint, inertia) = hinge(choice);
            let greatest_effort = 7.0 * inertia;
            let servo = JointServo { greatest_effort, ..JointServo::of_frequency(100.0, 5.0, 1.0, inertia) };
            simulator.set_joint_servo(joint, Some(servo)).unwrap();
            (0..rate as u32).for_each(|_| simulator.update(1.0 / rate));
            let speed = simulator[body].angular_velocity();
            assert!((speed - 7.0).abs() < 1e-3, "{choice:?} {rate}: {speed}");
            let torque = simulator[joint].torque();
            assert!((torque / greatest_effort - 1.0).abs() < 1e-4, "{choice:?} {rate}: {torque}");
        }
    }
}

#[test]
fn a_servo_between_two_bodies_keeps_momentum_and_turns_with_the_first_one() {
    for choice in SOLVERS {
        let mut simulator = with_solver(choice, 0.0);
        let a = add_ghost(&mut simulator, (40.0, 20.0), v(0.0, 0.0));
        let b = add_ghost(&mut simulator, (10.0, 10.0), v(20.0, 0.0));
        simulator[a].set_angular_velocity(2.0);
        simulator[b].set_angular_velocity(2.0);
        simulator[b].set_linear_velocity(v(0.0, 40.0));
        let joint =
            JointFactory::create_prismatic_joint_in(&mut simulator, a, b, v(20.0, 0.0), v(1.0, 0.0)).unwrap();
        let [m, n] = [a, b].map(|body| simulator[body].mass());
        let servo = JointServo::of_frequency(15.0, 2.0, 1.0, m * n / (m + n));
        simulator.set_joint_servo(joint, Some(servo)).unwrap();
        let momenta = |simulator: &PhysicsSimulator| {
            [a, b].iter().fold([0.0_f32; 3], |sum, &body| {
                let body = &simulator[body];
                let (at, velocity) = (body.position(), body.linear_velocity());
                let spin = body.moment_of_inertia() * body.angular_velocity()
                    + body.mass() * (at.x * velocity.y - at.y * velocity.x);
                [sum[0] + body.mass() * velocity.x, sum[1] + body.mass() * velocity.y, sum[2] + spin]
            })
        };
        let before = momenta(&simulator);
        run(&mut simulator, 240);
        let after = momenta(&simulator);
        let size = [before[1], before[1], before[2]];
        for axis in 0..3 {
            assert!((after[axis] - before[axis]).abs() < 0.02 * size[axis].abs(), "{before:?} {after:?}");
        }
        // Centrifugal force displaces the servo outwards.
        let travel = simulator.joint_travel(joint).unwrap();
        assert!((14.9..18.0).contains(&travel), "{choice:?}: {travel}");
    }
}

#[test]
fn a_row_of_servos_carries_a_mass_much_larger_than_its_links_without_shaking() {
    let cases = [(SolverChoice::Auto, 200.0, 50.0, 12.0), (SolverChoice::Direct, 200.0, 50.0, 12.0)];
    for (choice, mass, strength, most) in cases {
        for rate in RATES {
            let mut simulator = with_solver(choice, GRAVITY);
            let mut holder = add_post(&mut simulator, v(0.0, 0.0));
            let mut joints = Vec::new();
            let mut load = holder;
            for link in 0..5 {
                load = add_ghost(&mut simulator, (20.0, 4.0), v(10.0 + 20.0 * link as f32, 0.0));
                simulator[load].set_mass(if link == 4 { mass } else { 1.0 }).unwrap();
                let at = v(20.0 * link as f32, 0.0);
                let joint = JointFactory::create_revolute_joint_in(&mut simulator, holder, load, at).unwrap();
                joints.push(joint);
                holder = load;
            }
            let torque = mass * GRAVITY * 100.0;
            for &joint in &joints {
                let servo = JointServo {
                    target: 0.0,
                    stiffness: strength * torque,
                    damping: 0.1 * strength * torque,
                    greatest_effort: f32::MAX,
                };
                simulator.set_joint_servo(joint, Some(servo)).unwrap();
            }
            (0..(3.0 * rate) as u32).for_each(|_| simulator.update(1.0 / rate));
            let speed = simulator[load].linear_velocity().norm();
            let droop = simulator[load].position().y;
            assert!(speed < 2.0 && (0.0..most).contains(&droop), "{choice:?} {rate}: {speed}, {droop}");
        }
    }
}

#[test]
fn limits_stop_a_servo() {
    for choice in SOLVERS {
        let (mut simulator, _, joint, inertia) = hinge(choice);
        simulator.set_joint_limits(joint, Some(JointLimits { lower: -0.5, upper: 0.5 })).unwrap();
        let servo = JointServo::of_frequency(2.0, 3.0, 1.0, inertia);
        simulator.set_joint_servo(joint, Some(servo)).unwrap();
        run(&mut simulator, 120);
        let travel = simulator.joint_travel(joint).unwrap();
        assert!((travel - 0.5).abs() < 5e-3, "{choice:?}: {travel}");
    }
}

#[test]
fn an_edited_servo_wakes_its_body_and_a_servo_at_its_target_sleeps() {
    for choice in SOLVERS {
        let (mut simulator, body, joint, inertia) = hinge(choice);
        let servo = JointServo::of_frequency(0.5, 3.0, 1.0, inertia);
        simulator.set_joint_servo(joint, Some(servo)).unwrap();
        run(&mut simulator, 300);
        assert!(simulator.is_asleep(body), "{choice:?}");
        simulator.set_joint_servo(joint, Some(servo)).unwrap();
        simulator.update(1.0 / 60.0);
        assert!(simulator.is_asleep(body), "an equal servo wakes no body");
        simulator.set_joint_servo(joint, Some(JointServo { target: 1.0, ..servo })).unwrap();
        run(&mut simulator, 2);
        assert!(!simulator.is_asleep(body));
        run(&mut simulator, 120);
        assert!((simulator.joint_travel(joint).unwrap() - 1.0).abs() < 1e-2);
        simulator.set_joint_servo(joint, None).unwrap();
        simulator.update(1.0 / 60.0);
        assert_eq!(simulator[joint].torque(), 0.0);
    }
}

#[test]
fn a_servo_with_too_great_a_torque_breaks_its_joint_and_its_force_stays_that_which_broke_it() {
    for choice in SOLVERS {
        let (mut simulator, _, joint, inertia) = hinge(choice);
        let servo =
            JointServo { greatest_effort: 9.0 * inertia, ..JointServo::of_frequency(3.0, 5.0, 1.0, inertia) };
        simulator.set_joint_servo(joint, Some(servo)).unwrap();
        simulator[joint].set_greatest_torque(8.0 * inertia).unwrap();
        simulator.update(1.0 / 60.0);
        assert!(simulator.events().contains(&Event::JointBroke { joint }), "{choice:?}");
        run(&mut simulator, 5);
        assert!(!simulator[joint].enabled());
        assert!((simulator[joint].torque() / (9.0 * inertia) - 1.0).abs() < 1e-4);
    }
}

#[test]
fn a_restored_servo_goes_on_with_the_same_bits() {
    for choice in SOLVERS {
        let (mut simulator, _, joint, mass) = lift(choice, GRAVITY);
        let servo = JointServo::of_frequency(-6.0, 3.0, 0.3, mass);
        simulator.set_joint_servo(joint, Some(servo)).unwrap();
        run(&mut simulator, 17);
        let mut twin = precise(0.0);
        twin.restore(&simulator.snapshot()).unwrap();
        assert_eq!(twin[joint].servo(), Some(servo));
        for step in 0..200 {
            if step == 30 {
                for simulator in [&mut simulator, &mut twin] {
                    simulator.set_joint_servo(joint, Some(JointServo { target: 4.0, ..servo })).unwrap();
                }
            }
            simulator.update(1.0 / 60.0);
            twin.update(1.0 / 60.0);
            assert_eq!(state(&twin), state(&simulator), "{choice:?}, step {step}");
        }
        assert!(twin.snapshot() == simulator.snapshot());
    }
}

#[test]
fn bad_servos_are_refused_by_name_and_change_no_servo() {
    let (mut simulator, body, joint, inertia) = hinge(SolverChoice::Auto);
    let servo = JointServo::of_frequency(0.5, 3.0, 1.0, inertia);
    simulator.set_joint_servo(joint, Some(servo)).unwrap();
    for (bad, name) in [
        (JointServo { target: f32::NAN, ..servo }, "target"),
        (JointServo { stiffness: -1.0, ..servo }, "stiffness"),
        (JointServo { damping: f32::INFINITY, ..servo }, "damping"),
        (JointServo { greatest_effort: -2.0, ..servo }, "greatest_effort"),
    ] {
        let error = simulator.set_joint_servo(joint, Some(bad)).unwrap_err();
        assert!(error.to_string().contains(name), "{error}");
        assert_eq!(simulator[joint].servo(), Some(servo));
    }
    let angle = JointFactory::create_fixed_angle_joint_in(&mut simulator, body).unwrap();
    assert!(matches!(simulator.set_joint_servo(angle, Some(servo)), Err(Error::WrongKind { .. })));
    assert!(matches!(simulator.set_methods(Methods::default()), Err(Error::NotSupported { .. })));
    let mut faithful = self::simulator(0.0);
    let (body, _) = add_box(&mut faithful, (10.0, 10.0), v(0.0, 0.0));
    let joint = JointFactory::create_fixed_revolute_joint_in(&mut faithful, body, v(0.0, 0.0)).unwrap();
    assert!(matches!(faithful.set_joint_servo(joint, Some(servo)), Err(Error::NotSupported { .. })));
}

/// A servo without effort has no row, and a motor joint at its greatest force has one row less than below it. Both change while
/// the game plays, beside a second servo whose rows follow.
#[test]
fn rows_of_servos_that_come_and_go_leave_the_others_and_restored_games_as_they_are() {
    for choice in SOLVERS {
        let (mut simulator, body, limp, inertia) = hinge(choice);
        simulator.set_sleep_enabled(false);
        let carried = add_ghost(&mut simulator, (10.0, 10.0), v(60.0, 0.0));
        let arm = add_ghost(&mut simulator, (30.0, 4.0), v(60.0, 0.0));
        let strength = PoseServo { frequency: 3.0, greatest_force: 400.0, ..PoseServo::default() };
        let motor = JointFactory::create_motor_joint_in(&mut simulator, body, carried, strength).unwrap();
        simulator.set_motor_joint_target(motor, v(60.0, 0.0), 0.0).unwrap();
        let last =
            JointFactory::create_revolute_joint_in(&mut simulator, carried, arm, v(60.0, 0.0)).unwrap();
        let arm_inertia = simulator[arm].moment_of_inertia();
        let held = JointServo::of_frequency(0.4, 6.0, 1.0, arm_inertia);
        simulator.set_joint_servo(last, Some(held)).unwrap();
        let active = JointServo::of_frequency(0.3, 2.0, 1.0, inertia);
        for update in 0..240 {
            let greatest_effort = if update % 20 < 10 { active.greatest_effort } else { 0.0 };
            simulator.set_joint_servo(limp, Some(JointServo { greatest_effort, ..active })).unwrap();
            let target = if update / 15 % 2 == 0 { v(60.0, 0.0) } else { v(60.0, 400.0) };
            simulator.set_motor_joint_target(motor, target, 0.0).unwrap();
            let mut restored = precise(0.0);
            restored.restore(&simulator.snapshot()).unwrap();
            simulator.update(1.0 / 60.0);
            restored.update(1.0 / 60.0);
            assert!(simulator.snapshot() == restored.snapshot(), "{choice:?} {update}");
        }
        let travel = simulator.joint_travel(last).unwrap();
        assert!(travel.is_finite() && travel.abs() < 3.2, "{choice:?}: {travel}");
    }
}
