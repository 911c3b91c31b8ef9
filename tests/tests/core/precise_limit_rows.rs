//! The precise set: motors and limits of travel in islands with contacts. One row is a motor and both of its limits.

use conformance::fixtures::plane::{add_level_floor, add_part, energy, precise, run, v};
use farseer_core::{BodyId, IslandSolver, JointFactory, JointId, JointLimits, JointMotor, PhysicsSimulator};

const DT: f32 = 1.0 / 60.0;
/// Length units per second squared; 32 length units are a metre.
const GRAVITY: f32 = 900.0;

fn motor(speed: f32, greatest_effort: f32) -> Option<JointMotor> {
    Some(JointMotor { speed, greatest_effort })
}

fn limits(lower: f32, upper: f32) -> Option<JointLimits> {
    Some(JointLimits { lower, upper })
}

/// A level flipper of mass 2 that turns about its left end at the origin, and a load on it 50 length units from there. Positive
/// angles lower the load; the lower limit is the level, and the load's torque about the hinge is the last result.
fn add_flipper(simulator: &mut PhysicsSimulator, load: f32) -> (BodyId, BodyId, JointId, f32) {
    let flipper = add_part(simulator, v(35.0, 0.0), [70.0, 10.0], 2.0);
    let joint = JointFactory::create_fixed_revolute_joint_in(simulator, flipper, v(0.0, 0.0)).unwrap();
    simulator.set_joint_limits(joint, limits(0.0, 0.5)).unwrap();
    let box_on_it = add_part(simulator, v(50.0, -15.0), [20.0, 20.0], load);
    (flipper, box_on_it, joint, GRAVITY * (35.0 * 2.0 + 50.0 * load))
}

#[test]
fn a_flipper_that_presses_against_its_limit_holds_a_load_up_to_its_greatest_effort() {
    for dt in [1.0 / 30.0, DT, 1.0 / 120.0] {
        for load in [0.1, 1.0, 20.0, 150.0] {
            let mut simulator = precise(GRAVITY);
            let (flipper, _, joint, torque) = add_flipper(&mut simulator, load);
            simulator.set_joint_motor(joint, motor(-20.0, 1.01 * torque)).unwrap();
            for step in 0..120 {
                simulator.update(dt);
                let turned = simulator[flipper].total_rotation();
                assert!(turned.abs() < 1e-4, "load {load}, dt {dt}, step {step}: {turned}");
            }
            assert!(simulator.islands()[0].method != IslandSolver::Iterative, "load {load}, dt {dt}");
        }
    }
}

#[test]
fn a_flipper_yields_to_a_load_beyond_its_greatest_effort_and_stops_at_the_other_limit() {
    for load in [1.0, 20.0, 150.0] {
        let mut simulator = precise(GRAVITY);
        let (flipper, _, joint, torque) = add_flipper(&mut simulator, load);
        simulator.set_joint_motor(joint, motor(-20.0, 0.9 * torque)).unwrap();
        simulator.update(DT);
        let inertia = simulator[flipper].moment_of_inertia() + 2.0 * 35.0 * 35.0;
        let speed = simulator[flipper].angular_velocity();
        // The load takes part with at least its mass at its arm, and less where it lags behind.
        let fastest = DT * 0.1 * torque / inertia;
        assert!(speed > 0.0 && speed < fastest, "load {load}: {speed} of {fastest}");
        let mut greatest = 0.0_f32;
        for _ in 0..120 {
            simulator.update(DT);
            greatest = greatest.max(simulator[flipper].total_rotation());
        }
        // The load lands on the flipper in the same step in which that reaches its limit.
        assert!((0.499..0.51).contains(&greatest), "load {load}: {greatest}");
    }
}

#[test]
fn a_reversed_motor_leaves_its_limit_in_the_same_step() {
    for load in [0.1, 1.0] {
        let mut simulator = precise(GRAVITY);
        let (flipper, _, joint, torque) = add_flipper(&mut simulator, load);
        simulator.set_joint_motor(joint, motor(-20.0, 2.0 * torque)).unwrap();
        run(&mut simulator, 20);
        simulator.set_joint_motor(joint, motor(1.0, 2.0 * torque)).unwrap();
        for step in 1..=24 {
            simulator.update(DT);
            let turned = simulator[flipper].total_rotation();
            assert!((turned - DT * step as f32).abs() < 1e-3, "load {load}, step {step}: {turned}");
        }
        run(&mut simulator, 30);
        assert!((simulator[flipper].total_rotation() - 0.5).abs() < 1e-4);
    }
}

/// A base on the floor with an arm of mass 1 on a hinge above it.
fn add_arm(simulator: &mut PhysicsSimulator) -> (BodyId, BodyId, JointId) {
    add_level_floor(simulator);
    let base = add_part(simulator, v(0.0, -20.0), [200.0, 40.0], 20.0);
    let arm = add_part(simulator, v(0.0, -140.0), [8.0, 80.0], 1.0);
    let joint = JointFactory::create_revolute_joint_in(simulator, base, arm, v(0.0, -100.0)).unwrap();
    (base, arm, joint)
}

#[test]
fn an_arm_that_swings_against_its_limit_stops_there_and_gains_no_energy() {
    for speed in [1.0, 5.0, 20.0] {
        let mut simulator = precise(GRAVITY);
        let (base, arm, joint) = add_arm(&mut simulator);
        simulator.set_joint_limits(joint, limits(-0.3, 0.4)).unwrap();
        run(&mut simulator, 10);
        // The arm turns about the hinge, 40 length units below its middle.
        simulator[arm].set_angular_velocity(speed);
        simulator[arm].set_linear_velocity(v(40.0 * speed, 0.0));
        let begun = energy(&simulator, &[base, arm], GRAVITY);
        for step in 0..180 {
            simulator.update(DT);
            let (now, travel) =
                (energy(&simulator, &[base, arm], GRAVITY), simulator.joint_travel(joint).unwrap());
            // A body that stands is lifted by 1e-3 length units at most.
            assert!(now < begun + 20.0, "speed {speed}, step {step}: {now} of {begun}");
            assert!((-0.301..0.401).contains(&travel), "speed {speed}, step {step}: {travel}");
        }
        let spin = simulator[arm].angular_velocity();
        assert!(spin.abs() < 0.01 && (simulator.joint_travel(joint).unwrap() - 0.4).abs() < 1e-3, "{spin}");
    }
}

#[test]
fn a_load_of_any_mass_on_a_slider_rests_at_the_limit_of_its_travel() {
    for mass in [0.5, 10.0, 150.0] {
        for greatest_effort in [0.0, 300.0] {
            let mut simulator = precise(GRAVITY);
            add_level_floor(&mut simulator);
            let plate = add_part(&mut simulator, v(0.0, -5.0), [60.0, 10.0], 1.0);
            let load = add_part(&mut simulator, v(0.0, -105.0), [40.0, 40.0], mass);
            let joint = JointFactory::create_prismatic_joint_in(
                &mut simulator,
                plate,
                load,
                v(0.0, -5.0),
                v(0.0, 1.0),
            )
            .unwrap();
            simulator.set_joint_limits(joint, limits(-10.0, 20.0)).unwrap();
            simulator.set_joint_motor(joint, motor(50.0, greatest_effort)).unwrap();
            run(&mut simulator, 120);
            let apart = simulator[plate].position().y - simulator[load].position().y;
            assert!((apart - 80.0).abs() < 0.01, "mass {mass}, effort {greatest_effort}: {apart}");
            assert!(simulator[load].linear_velocity().norm() < 0.1, "mass {mass}");
        }
    }
}

#[test]
fn a_joint_whose_limits_are_equal_is_rigid() {
    let mut simulator = precise(GRAVITY);
    let (_, arm, joint) = add_arm(&mut simulator);
    simulator.set_joint_limits(joint, limits(0.0, 0.0)).unwrap();
    for motor in [None, motor(5.0, 1e6), motor(-5.0, 10.0)] {
        simulator.set_joint_motor(joint, motor).unwrap();
        simulator[arm].apply_impulse(v(200.0, 0.0));
        for step in 0..60 {
            simulator.update(DT);
            let travel = simulator.joint_travel(joint).unwrap();
            assert!(travel.abs() < 1e-4, "step {step}: {travel}");
        }
    }
}

#[test]
fn limits_of_any_finite_range_keep_all_numbers_finite() {
    let ranges =
        [(f32::MIN, f32::MAX), (f32::MIN, 0.0), (0.0, f32::MAX), (0.0, 1e-30), (-3e30, -2e30), (50.0, 60.0)];
    for (lower, upper) in ranges {
        for greatest_effort in [0.0, 1e3, f32::MAX] {
            let mut simulator = precise(GRAVITY);
            let (base, arm, joint) = add_arm(&mut simulator);
            simulator.set_joint_limits(joint, limits(lower, upper)).unwrap();
            simulator.set_joint_motor(joint, motor(3.0, greatest_effort)).unwrap();
            run(&mut simulator, 60);
            for body in [base, arm] {
                let (place, velocity) = (simulator[body].position(), simulator[body].linear_velocity());
                let sum = place.norm() + velocity.norm();
                assert!(sum.is_finite(), "{lower}..{upper}, {greatest_effort}: {sum}");
            }
        }
    }
}

#[test]
fn an_island_with_limits_that_is_saved_in_any_step_goes_on_with_the_same_bits() {
    let mut simulator = precise(GRAVITY);
    let (_, arm, joint) = add_arm(&mut simulator);
    simulator.set_joint_limits(joint, limits(-0.3, 0.4)).unwrap();
    simulator.set_joint_motor(joint, motor(-8.0, 1e5)).unwrap();
    let (_, _, other, torque) = add_flipper(&mut simulator, 20.0);
    simulator.set_joint_motor(other, motor(-20.0, 1.1 * torque)).unwrap();
    for step in 0..120 {
        if step == 60 {
            simulator.set_joint_motor(joint, motor(8.0, 1e5)).unwrap();
            simulator.set_joint_motor(other, motor(-20.0, 0.5 * torque)).unwrap();
        }
        let mut restored = precise(0.0);
        restored.restore(&simulator.snapshot()).unwrap();
        simulator.update(DT);
        restored.update(DT);
        assert!(simulator.snapshot() == restored.snapshot(), "step {step}");
    }
    assert!(simulator[arm].position().norm().is_finite());
}
