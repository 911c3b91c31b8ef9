//! The precise set: wheel joints, springs between two angles, and motor joints.

use conformance::fixtures::plane::{
    SOLVERS, add_box, add_circle, add_floor, add_ghost, add_post, precise, run, simulator, state, v,
    with_solver,
};
use farseer_core::{
    AngleSpringJoint, BodyId, Error, Event, JointFactory, JointLimits, JointMotor, JointServo, Methods,
    MotorJoint, PhysicsSimulator, PoseServo, SolverChoice, TypedJointId, WheelJoint,
};

const GRAVITY: f32 = 320.0;
const RATES: [f32; 3] = [30.0, 60.0, 240.0];

/// A car; half of its chassis' weight sinks the suspension of a wheel by two length units.
struct Car {
    simulator: PhysicsSimulator,
    chassis: BodyId,
    wheels: [BodyId; 2],
    axles: [TypedJointId<WheelJoint>; 2],
}

/// A car of two wheels on a long floor; `ratio` is the mass of its chassis divided by that of a wheel.
fn car(choice: SolverChoice, ratio: f32) -> Car {
    let mut simulator = with_solver(choice, GRAVITY);
    add_floor(&mut simulator, (20000.0, 20.0), v(0.0, 42.0));
    let (chassis, _) = add_box(&mut simulator, (80.0, 16.0), v(0.0, 0.0));
    simulator[chassis].set_mass(ratio).unwrap();
    simulator[chassis].set_moment_of_inertia(ratio * 500.0).unwrap();
    let wheels = [-30.0, 30.0].map(|x| {
        let (wheel, geom) = add_circle(&mut simulator, 12.0, 24, v(x, 20.0));
        simulator[wheel].set_mass(1.0).unwrap();
        simulator[wheel].set_moment_of_inertia(72.0).unwrap();
        simulator[geom].set_friction_coefficient(1.0);
        wheel
    });
    let stiffness = 0.5 * ratio * GRAVITY / 2.0;
    let damping = 2.0 * 0.6 * (0.5 * ratio * stiffness).sqrt();
    let axles = [0, 1].map(|at| {
        let anchor = simulator[wheels[at]].position();
        let axle = JointFactory::create_wheel_joint_in(
            &mut simulator,
            chassis,
            wheels[at],
            anchor,
            v(0.0, 1.0),
            stiffness,
            damping,
        );
        let axle = axle.unwrap();
        simulator.set_joint_bodies_collide(axle, false).unwrap();
        axle
    });
    for body in [chassis, wheels[0], wheels[1]] {
        simulator[body].set_linear_drag_coefficient(0.0);
        simulator[body].set_rotational_drag_coefficient(0.0);
    }
    Car { simulator, chassis, wheels, axles }
}

#[test]
fn a_car_sinks_on_its_suspension_by_its_weight_divided_by_the_stiffness() {
    for choice in SOLVERS {
        for rate in RATES {
            for ratio in [1.0, 4.0, 20.0] {
                let Car { mut simulator, chassis, axles, .. } = car(choice, ratio);
                simulator.set_sleep_enabled(false);
                (0..(5.0 * rate) as u32).for_each(|_| simulator.update(1.0 / rate));
                for axle in axles {
                    let travel = simulator.joint_travel(axle).unwrap();
                    assert!((travel + 2.0).abs() < 0.02, "{choice:?} {rate} {ratio}: {travel}");
                    let force = simulator[axle.id()].force().y;
                    let load = 0.5 * ratio * GRAVITY;
                    assert!(
                        (force / load - 1.0).abs() < 0.01,
                        "{choice:?} {rate} {ratio}: {force} of {load}"
                    );
                }
                let level = simulator[chassis].total_rotation();
                assert!(level.abs() < 1e-3, "{level}");
            }
        }
    }
}

#[test]
fn the_motor_of_a_wheel_drives_the_car_and_its_torque_is_bounded() {
    for choice in SOLVERS {
        for rate in RATES {
            let Car { mut simulator, chassis, wheels, axles } = car(choice, 4.0);
            (0..rate as u32).for_each(|_| simulator.update(1.0 / rate));
            for axle in axles {
                let motor = JointMotor { speed: 10.0, greatest_effort: 600.0 };
                simulator.set_joint_motor(axle, Some(motor)).unwrap();
            }
            (0..(0.5 * rate) as u32).for_each(|_| simulator.update(1.0 / rate));
            // Traction of both wheels moves the car and spins the wheels: 1200 / 12 = (6 + 2 72 / 144) a.
            let speed = simulator[chassis].linear_velocity().x;
            let exact = 1200.0 / 12.0 / 7.0 * 0.5;
            assert!((speed / exact - 1.0).abs() < 0.06, "{choice:?} {rate}: {speed}, {exact}");
            (0..(20.0 * rate) as u32).for_each(|_| simulator.update(1.0 / rate));
            let speed = simulator[chassis].linear_velocity().x;
            assert!((speed - 120.0).abs() < 2.5, "{choice:?} {rate}: {speed}");
            let turned = simulator[wheels[0]].angular_velocity() - simulator[chassis].angular_velocity();
            assert!((turned - 10.0).abs() < 0.1, "{choice:?} {rate}: {turned}");
        }
    }
}

#[test]
fn a_wheel_stays_on_its_axis_when_the_car_jumps_and_turns() {
    for choice in SOLVERS {
        let Car { mut simulator, chassis, axles, .. } = car(choice, 4.0);
        run(&mut simulator, 60);
        simulator[chassis].set_linear_velocity(v(100.0, -300.0));
        simulator[chassis].set_angular_velocity(3.0);
        for _ in 0..180 {
            simulator.update(1.0 / 60.0);
            for axle in axles {
                let error = simulator[axle.id()].joint_error();
                assert!(error < 1.5, "{choice:?}: {error}");
            }
        }
    }
}

/// Two free boxes with a spring between their angles, and the moments of both.
fn twins(choice: SolverChoice) -> (PhysicsSimulator, [BodyId; 2], TypedJointId<AngleSpringJoint>, [f32; 2]) {
    let mut simulator = with_solver(choice, 0.0);
    let a = add_ghost(&mut simulator, (40.0, 10.0), v(0.0, 0.0));
    let b = add_ghost(&mut simulator, (20.0, 10.0), v(100.0, 0.0));
    simulator[b].set_rotation(0.5);
    let moments = [a, b].map(|body| simulator[body].moment_of_inertia());
    let spring = JointFactory::create_angle_spring_joint_in(&mut simulator, a, b, 0.0, 0.0).unwrap();
    (simulator, [a, b], spring, moments)
}

#[test]
fn an_angle_spring_swings_as_its_closed_form_and_keeps_angular_momentum() {
    for choice in SOLVERS {
        for rate in RATES {
            let (mut simulator, [a, b], spring, [i, j]) = twins(choice);
            let servo = JointServo::of_frequency(0.0, 1.0, 0.3, i * j / (i + j));
            simulator.set_joint_servo(spring, Some(servo)).unwrap();
            simulator[b].set_angular_velocity(4.0);
            let (w, damping_ratio) = (std::f64::consts::TAU, 0.3_f64);
            let damped = w * (1.0 - damping_ratio * damping_ratio).sqrt();
            let mut worst: f64 = 0.0;
            for step in 1..=(2.0 * rate) as u32 {
                simulator.update(1.0 / rate);
                let t = f64::from(step) / f64::from(rate);
                let exact = 4.0 / damped * (-damping_ratio * w * t).exp() * (damped * t).sin();
                worst = worst.max((f64::from(simulator.joint_travel(spring).unwrap()) - exact).abs());
            }
            assert!(worst < 0.6 * w / f64::from(rate), "{choice:?} {rate}: {worst}");
            let spin = i * simulator[a].angular_velocity() + j * simulator[b].angular_velocity();
            assert!((spin / (4.0 * j) - 1.0).abs() < 1e-4, "{choice:?} {rate}");
        }
    }
}

#[test]
fn an_angle_spring_has_motor_and_limits_of_the_relative_angle() {
    for choice in SOLVERS {
        let (mut simulator, [a, b], spring, _) = twins(choice);
        simulator.set_joint_servo(spring, None).unwrap();
        simulator.set_joint_motor(spring, Some(JointMotor { speed: 2.0, greatest_effort: 1e8 })).unwrap();
        simulator.set_joint_limits(spring, Some(JointLimits { lower: -1.0, upper: 1.0 })).unwrap();
        run(&mut simulator, 20);
        let relative = simulator[b].angular_velocity() - simulator[a].angular_velocity();
        assert!((relative - 2.0).abs() < 1e-3, "{choice:?}: {relative}");
        run(&mut simulator, 60);
        let travel = simulator.joint_travel(spring).unwrap();
        assert!((travel - 1.0).abs() < 0.05, "{choice:?}: {travel}");
    }
}

/// A body that a motor joint holds at a post.
fn held(
    choice: SolverChoice,
    gravity: f32,
    servo: PoseServo,
) -> (PhysicsSimulator, BodyId, TypedJointId<MotorJoint>) {
    let mut simulator = with_solver(choice, gravity);
    let post = add_post(&mut simulator, v(0.0, 0.0));
    let body = add_ghost(&mut simulator, (20.0, 10.0), v(50.0, 0.0));
    let joint = JointFactory::create_motor_joint_in(&mut simulator, post, body, servo).unwrap();
    (simulator, body, joint)
}

#[test]
fn a_motor_joint_moves_its_body_to_a_pose_and_sags_by_its_weight() {
    for choice in SOLVERS {
        for rate in RATES {
            let servo = PoseServo { frequency: 2.0, ..PoseServo::default() };
            let (mut simulator, body, joint) = held(choice, GRAVITY, servo);
            simulator.set_sleep_enabled(false);
            simulator.set_motor_joint_target(joint, v(-20.0, 30.0), 1.5).unwrap();
            (0..(4.0 * rate) as u32).for_each(|_| simulator.update(1.0 / rate));
            let w = std::f32::consts::TAU * 2.0;
            let (at, angle) = (simulator[body].position(), simulator[body].rotation());
            assert!((at - v(-20.0, 30.0 + GRAVITY / (w * w))).norm() < 0.01, "{choice:?} {rate}: {at}");
            assert!((angle - 1.5).abs() < 1e-3, "{choice:?} {rate}: {angle}");
            let force = simulator[joint.id()].force();
            assert!((force.y / (simulator[body].mass() * GRAVITY) + 1.0).abs() < 1e-3, "{force}");
        }
    }
}

#[test]
fn the_force_of_a_motor_joint_is_bounded_in_any_direction_and_its_torque_too() {
    for choice in SOLVERS {
        for rate in RATES {
            for target in [v(3e4, 0.0), v(3e4, 3e4), v(-1e4, 3e4)] {
                let mut servo = PoseServo { frequency: 2.0, ..PoseServo::default() };
                let (mut simulator, body, joint) = held(choice, 0.0, servo);
                let (mass, moment) = (simulator[body].mass(), simulator[body].moment_of_inertia());
                (servo.greatest_force, servo.greatest_torque) = (50.0 * mass, 3.0 * moment);
                simulator.set_motor_joint_servo(joint, servo).unwrap();
                simulator.set_motor_joint_target(joint, target, 500.0).unwrap();
                for _ in 0..rate as u32 {
                    simulator.update(1.0 / rate);
                    let force = simulator[joint.id()].force().norm();
                    assert!(force <= 50.0 * mass * 1.0001, "{choice:?} {rate}: {force}");
                }
                let velocity = simulator[body].linear_velocity();
                assert!((velocity.norm() - 50.0).abs() < 0.1, "{choice:?} {rate}: {velocity}");
                assert!((velocity.normalize() - (target - v(50.0, 0.0)).normalize()).norm() < 1e-2);
                assert!((simulator[body].angular_velocity() - 3.0).abs() < 1e-3);
            }
        }
    }
}

#[test]
fn a_motor_joint_between_two_bodies_keeps_momentum() {
    for choice in SOLVERS {
        let mut simulator = with_solver(choice, 0.0);
        let a = add_ghost(&mut simulator, (30.0, 30.0), v(0.0, 0.0));
        let b = add_ghost(&mut simulator, (20.0, 10.0), v(50.0, 0.0));
        let joint = JointFactory::create_motor_joint_in(&mut simulator, a, b, PoseServo::default()).unwrap();
        simulator.set_motor_joint_target(joint, v(20.0, 60.0), 0.7).unwrap();
        run(&mut simulator, 240);
        let bodies = [a, b].map(|body| &simulator[body]);
        let momentum =
            bodies[0].linear_velocity() * bodies[0].mass() + bodies[1].linear_velocity() * bodies[1].mass();
        assert!(momentum.norm() < 0.05 * bodies[0].mass(), "{momentum}");
        let relative = bodies[0].get_local_position(bodies[1].position());
        assert!((relative - v(20.0, 60.0)).norm() < 0.1, "{choice:?}: {relative}");
    }
}

#[test]
fn edits_wake_and_loads_break() {
    let (mut simulator, body, joint) = held(SolverChoice::Auto, 0.0, PoseServo::default());
    run(&mut simulator, 120);
    assert!(simulator.is_asleep(body));
    simulator.set_motor_joint_target(joint, v(0.0, 10.0), 0.0).unwrap();
    run(&mut simulator, 2);
    assert!(!simulator.is_asleep(body));
    simulator[joint.id()].set_greatest_force(1e-3).unwrap();
    simulator.set_motor_joint_target(joint, v(0.0, 100.0), 0.0).unwrap();
    simulator.update(1.0 / 60.0);
    assert!(simulator.events().contains(&Event::JointBroke { joint: joint.id() }));
    let Car { mut simulator, chassis, axles, .. } = car(SolverChoice::Auto, 4.0);
    run(&mut simulator, 400);
    assert!(simulator.is_asleep(chassis));
    let servo = simulator[axles[0].id()].servo().unwrap();
    simulator.set_joint_servo(axles[0], Some(JointServo { target: 4.0, ..servo })).unwrap();
    run(&mut simulator, 2);
    assert!(!simulator.is_asleep(chassis));
}

#[test]
fn restored_wheels_springs_and_motor_joints_go_on_with_the_same_bits() {
    for choice in SOLVERS {
        let Car { mut simulator, chassis, axles, .. } = car(choice, 4.0);
        let motor = JointMotor { speed: 10.0, greatest_effort: 600.0 };
        simulator.set_joint_motor(axles[1], Some(motor)).unwrap();
        let flag = add_ghost(&mut simulator, (4.0, 30.0), v(0.0, -30.0));
        let servo = PoseServo { greatest_force: 3000.0, ..PoseServo::default() };
        let grip = JointFactory::create_motor_joint_in(&mut simulator, chassis, flag, servo).unwrap();
        let spinner = add_ghost(&mut simulator, (10.0, 10.0), v(0.0, -90.0));
        simulator[spinner].set_ignore_gravity(true);
        let spring =
            JointFactory::create_angle_spring_joint_in(&mut simulator, flag, spinner, 900.0, 3.0).unwrap();
        run(&mut simulator, 25);
        let mut twin = precise(0.0);
        twin.restore(&simulator.snapshot()).unwrap();
        for step in 0..150 {
            if step == 40 {
                for simulator in [&mut simulator, &mut twin] {
                    simulator.set_motor_joint_target(grip, v(10.0, -60.0), 0.4).unwrap();
                    simulator.set_joint_motor(axles[1], None).unwrap();
                    simulator[spring.id()].set_enabled(false);
                }
            }
            simulator.update(1.0 / 60.0);
            twin.update(1.0 / 60.0);
            assert_eq!(state(&twin), state(&simulator), "{choice:?}, step {step}");
        }
        assert!(twin.snapshot() == simulator.snapshot(), "{choice:?}");
    }
}

#[test]
fn a_target_far_away_of_a_motor_joint_without_force_moves_no_body_before_or_after_a_restore() {
    for choice in SOLVERS {
        let (mut simulator, body, joint) =
            held(choice, 0.0, PoseServo { frequency: 0.0, ..PoseServo::default() });
        let at = simulator[body].position();
        for target in [0.0, 1e30, f32::MAX] {
            simulator.set_motor_joint_target(joint, v(target, 0.0), 0.0).unwrap();
            let mut copy = precise(0.0);
            copy.restore(&simulator.snapshot()).unwrap();
            for _ in 0..3 {
                simulator.update(1.0 / 60.0);
                copy.update(1.0 / 60.0);
                assert!(copy.snapshot() == simulator.snapshot(), "{choice:?}, {target}");
                assert!(
                    simulator[body].enabled() && simulator[body].position() == at,
                    "{choice:?}, {target}"
                );
            }
        }
    }
}

#[test]
fn dry_friction_of_a_motor_joint_slides_by_its_closed_form_and_holds_lesser_loads() {
    for choice in SOLVERS {
        for rate in RATES {
            let (mut simulator, body, joint) = held(choice, 0.0, PoseServo::friction(0.0, 0.0));
            let [mass, inertia] = [simulator[body].mass(), simulator[body].moment_of_inertia()];
            simulator.set_motor_joint_servo(joint, PoseServo::friction(100.0 * mass, 4.0 * inertia)).unwrap();
            let start = simulator[body].position();
            simulator[body].set_linear_velocity(v(30.0, 40.0));
            simulator[body].set_angular_velocity(3.0);
            (0..rate as u32).for_each(|_| simulator.update(1.0 / rate));
            // It slides v^2 / (2 a) in its direction and turns by w^2 / (2 b); a step of the end counts wholly or not.
            let (way, turn) = (simulator[body].position() - start, simulator[body].rotation());
            let exact = v(0.6, 0.8) * (50.0 * 50.0 / 200.0);
            assert!((way - exact).norm() < 0.6 * 50.0 / rate, "{choice:?} {rate}: {way} {exact}");
            assert!((turn - 9.0 / 8.0).abs() < 0.6 * 3.0 / rate, "{choice:?} {rate}: {turn}");
            // Loads below the bound in any direction move it by less than rounding; greater ones accelerate it.
            let rest = simulator[body].position();
            for load in [v(90.0, 0.0), v(0.0, -90.0), v(-60.0, 60.0)] {
                for _ in 0..rate as u32 {
                    simulator[body].apply_force(load * mass);
                    simulator[body].apply_torque(3.5 * inertia);
                    simulator.update(1.0 / rate);
                }
            }
            let crept = (simulator[body].position() - rest).norm();
            assert!(crept < 1e-3, "{choice:?} {rate}: {crept}");
            let start = simulator[body].linear_velocity();
            for _ in 0..rate as u32 {
                simulator[body].apply_force(v(150.0, 0.0) * mass);
                simulator.update(1.0 / rate);
            }
            let gained = simulator[body].linear_velocity() - start;
            assert!((gained - v(50.0, 0.0)).norm() < 2.0, "{choice:?} {rate}: {gained}");
        }
    }
}

#[test]
fn bad_arguments_are_refused_by_name() {
    let Car { mut simulator, chassis, wheels: [wheel, _], axles } = car(SolverChoice::Auto, 4.0);
    let origin = v(0.0, 0.0);
    let refuse = |joint: farseer_core::Result<TypedJointId<WheelJoint>>, name: &str| {
        let error = joint.unwrap_err().to_string();
        assert!(error.contains(name), "{error}");
    };
    let down = v(0.0, 1.0);
    let wheel_joint = JointFactory::create_wheel_joint;
    refuse(wheel_joint(&mut simulator, chassis, wheel, origin, origin, 1.0, 1.0), "axis");
    refuse(wheel_joint(&mut simulator, chassis, wheel, origin, down, -1.0, 1.0), "stiffness");
    refuse(wheel_joint(&mut simulator, chassis, wheel, origin, down, 1.0, f32::NAN), "damping");
    refuse(wheel_joint(&mut simulator, chassis, chassis, origin, down, 1.0, 1.0), "body2");
    let limits = Some(JointLimits { lower: 0.0, upper: 1.0 });
    assert!(matches!(simulator.set_joint_limits(axles[0], limits), Err(Error::WrongKind { .. })));
    let error = simulator.set_joint_limits(axles[0], limits).unwrap_err().to_string();
    assert!(!error.contains("WheelJoint"), "{error}");
    let bad = PoseServo { frequency: -1.0, ..PoseServo::default() };
    let error = JointFactory::create_motor_joint(&mut simulator, chassis, wheel, bad).unwrap_err();
    assert!(error.to_string().contains("frequency"), "{error}");
    assert!(matches!(simulator.set_motor_joint_target(axles[0], origin, 0.0), Err(Error::WrongKind { .. })));
    assert!(matches!(simulator.set_methods(Methods::default()), Err(Error::NotSupported { .. })));
    let mut faithful = self::simulator(0.0);
    let [a, b] = [0.0, 10.0].map(|x| add_box(&mut faithful, (10.0, 10.0), v(x, 0.0)).0);
    for refused in [
        JointFactory::create_wheel_joint_in(&mut faithful, a, b, origin, down, 1.0, 1.0).err(),
        JointFactory::create_angle_spring_joint_in(&mut faithful, a, b, 1.0, 1.0).err(),
        JointFactory::create_motor_joint_in(&mut faithful, a, b, PoseServo::default()).err(),
    ] {
        assert!(matches!(refused, Some(Error::NotSupported { .. })), "{refused:?}");
    }
}
