//! The precise set: gears and pulleys.

use conformance::fixtures::plane::{
    SOLVERS, add_box, add_ghost, add_post, precise, run, simulator, v, with_solver,
};
use farseer_core::{
    BodyId, Error, GearJoint, JointFactory, JointId, JointMotor, PhysicsSimulator, PulleyJoint, SolverChoice,
    TypedJointId,
};

const GRAVITY: f32 = 320.0;
const RATES: [f32; 3] = [30.0, 60.0, 240.0];

/// Two wheels on axles at the world with a gear of this ratio between them.
fn wheels(
    choice: SolverChoice,
    ratio: f32,
) -> (PhysicsSimulator, [BodyId; 2], [JointId; 2], TypedJointId<GearJoint>) {
    let mut simulator = with_solver(choice, 0.0);
    let bodies = [0.0, 100.0].map(|x| add_ghost(&mut simulator, (20.0, 20.0), v(x, 0.0)));
    let axles = bodies.map(|body| {
        let at = simulator[body].position();
        JointFactory::create_fixed_revolute_joint_in(&mut simulator, body, at).unwrap()
    });
    let gear = JointFactory::create_gear_joint_in(&mut simulator, bodies[0], bodies[1], ratio).unwrap();
    (simulator, bodies, axles, gear)
}

#[test]
fn a_gear_keeps_its_ratio_for_a_minute_under_a_load_at_every_rate_with_either_solver() {
    for choice in SOLVERS {
        for rate in RATES {
            for ratio in [-0.5, 3.0] {
                let (mut simulator, [a, b], axles, _) = wheels(choice, ratio);
                let inertia = simulator[b].moment_of_inertia();
                let motor = JointMotor { speed: 9.0, greatest_effort: 1e3 * inertia };
                simulator.set_joint_motor(axles[0], Some(motor)).unwrap();
                for _ in 0..(60.0 * rate) as u32 {
                    simulator[b].apply_torque(-20.0 * inertia * ratio.signum());
                    simulator.update(1.0 / rate);
                }
                let [turned, driven] = [a, b].map(|body| simulator[body].total_rotation());
                assert!((turned - 540.0).abs() < 1.0, "{choice:?} {rate}: {turned}");
                // f32 rounds 1,620 rad to 1.2e-4. A soft row of the angular frequency w yields to a load T by K T / w^2, with
                // K = (1 + r^2) / inertia; its frequency is 60 Hz, or a quarter of the substep rate.
                let substeps = simulator.iterations() as f32;
                let w = std::f32::consts::TAU * (0.25 * rate * substeps).min(60.0);
                let yields = if choice == SolverChoice::Iterative {
                    20.0 * (1.0 + ratio * ratio) / (w * w)
                } else {
                    0.0
                };
                let error = (driven - ratio * turned).abs();
                assert!(error < 1.1 * yields + 1e-3, "{choice:?} {rate} {ratio}: {error}");
            }
        }
    }
}

#[test]
fn a_gear_passes_on_the_torque_by_its_ratio_and_its_closed_form_acceleration() {
    for choice in SOLVERS {
        for rate in RATES {
            let ratio = -2.0;
            let (mut simulator, [a, b], _, gear) = wheels(choice, ratio);
            let [i, j] = [a, b].map(|body| simulator[body].moment_of_inertia());
            let torque = 5.0 * i;
            for _ in 0..rate as u32 {
                simulator[a].apply_torque(torque);
                simulator.update(1.0 / rate);
            }
            // T = (I + r^2 J) w'; the second wheel gets the torque J r w'.
            let acceleration = torque / (i + ratio * ratio * j);
            let speeds = [a, b].map(|body| simulator[body].angular_velocity());
            assert!((speeds[0] / acceleration - 1.0).abs() < 0.01, "{choice:?} {rate}: {speeds:?}");
            assert!((speeds[1] / (ratio * acceleration) - 1.0).abs() < 0.01, "{choice:?} {rate}: {speeds:?}");
            let passed = simulator[gear.id()].torque();
            assert!((passed / (j * ratio * acceleration) - 1.0).abs() < 0.02, "{choice:?} {rate}: {passed}");
        }
    }
}

#[test]
fn a_gear_on_moving_bodies_keeps_linear_momentum_and_another_ratio_counts_from_now_on() {
    for choice in SOLVERS {
        let mut simulator = with_solver(choice, 0.0);
        let [a, b] = [0.0, 100.0].map(|x| add_ghost(&mut simulator, (20.0, 10.0), v(x, 0.0)));
        let gear = JointFactory::create_gear_joint_in(&mut simulator, a, b, 2.0).unwrap();
        simulator[a].set_angular_velocity(3.0);
        simulator[a].set_linear_velocity(v(10.0, 0.0));
        run(&mut simulator, 60);
        assert_eq!(simulator[b].linear_velocity(), v(0.0, 0.0));
        let error = simulator[b].total_rotation() - 2.0 * simulator[a].total_rotation();
        assert!(error.abs() < 1e-3, "{choice:?}: {error}");
        simulator.set_gear_ratio(gear, -1.0).unwrap();
        let sum = simulator[b].total_rotation() + simulator[a].total_rotation();
        run(&mut simulator, 60);
        let drift = simulator[b].total_rotation() + simulator[a].total_rotation() - sum;
        assert!(drift.abs() < 1e-3, "{choice:?}: {drift}");
    }
}

/// Two weights of mass 1 and `mass` on a rope over two pulleys.
fn weights(
    choice: SolverChoice,
    mass: f32,
    ratio: f32,
) -> (PhysicsSimulator, [BodyId; 2], TypedJointId<PulleyJoint>) {
    let mut simulator = with_solver(choice, GRAVITY);
    let bodies = [(-50.0, 1.0), (50.0, mass)].map(|(x, mass)| {
        let body = add_ghost(&mut simulator, (10.0, 10.0), v(x, 0.0));
        simulator[body].set_mass(mass).unwrap();
        body
    });
    let pulleys = [v(-50.0, -200.0), v(50.0, -200.0)];
    let ends = bodies.map(|body| (body, v(0.0, 0.0)));
    let rope = JointFactory::create_pulley_joint_in(&mut simulator, ends, pulleys, ratio).unwrap();
    (simulator, bodies, rope)
}

#[test]
fn the_machine_of_atwood_has_its_acceleration_and_tension() {
    for choice in SOLVERS {
        for rate in RATES {
            for (mass, ratio) in [(2.0, 1.0), (0.25, 1.0), (3.0, 2.0)] {
                let (mut simulator, [a, b], rope) = weights(choice, mass, ratio);
                (0..(0.4 * rate) as u32).for_each(|_| simulator.update(1.0 / rate));
                // Tension T on the first weight, r T on the second; r times the first way up is the second way down.
                // a = g - T, b = g - r T / m, a + r b = 0.
                let tension = GRAVITY * (1.0 + ratio) / (1.0 + ratio * ratio / mass);
                let exact = [GRAVITY - tension, GRAVITY - ratio * tension / mass].map(|a| 0.4 * a);
                for (body, exact) in [(a, exact[0]), (b, exact[1])] {
                    let speed = simulator[body].linear_velocity().y;
                    assert!(
                        (speed - exact).abs() < 0.01 * exact.abs() + 0.2,
                        "{choice:?} {rate}: {speed} {exact}"
                    );
                }
                let force = simulator[rope.id()].force().y;
                assert!(
                    (force / (-ratio * tension) - 1.0).abs() < 0.02,
                    "{choice:?} {rate}: {force} {tension}"
                );
                let error = simulator[rope.id()].joint_error();
                assert!(error < 0.5, "{choice:?} {rate}: {error}");
            }
        }
    }
}

#[test]
fn a_rope_only_pulls_holds_equal_weights_asleep_and_a_winch_wakes_them() {
    for choice in SOLVERS {
        let (mut simulator, [a, b], rope) = weights(choice, 1.0, 1.0);
        // Lifted faster than gravity pulls the other one down, the second weight slackens the rope, which does not push.
        let mut lifted = simulator.clone();
        lifted[b].set_linear_velocity(v(0.0, -300.0));
        lifted.update(1.0 / 60.0);
        let speed = lifted[a].linear_velocity().y;
        assert!((speed - GRAVITY / 60.0).abs() < 0.1, "{choice:?}: it falls freely, {speed}");
        run(&mut simulator, 180);
        assert!(simulator.is_asleep(a) && simulator.is_asleep(b), "{choice:?}");
        let length = simulator[rope].length();
        simulator[rope].set_length(length - 40.0).unwrap();
        run(&mut simulator, 240);
        let heights: f32 = [a, b].iter().map(|&body| simulator[body].position().y).sum();
        assert!((heights + 40.0).abs() < 1.0, "{choice:?}: {heights}");
    }
}

#[test]
fn restored_gears_and_pulleys_go_on_with_the_same_bits() {
    for choice in SOLVERS {
        let (mut simulator, [a, b], _) = weights(choice, 2.0, 1.5);
        let gear = JointFactory::create_gear_joint_in(&mut simulator, a, b, -2.0).unwrap();
        let (block, _) = add_box(&mut simulator, (30.0, 10.0), v(50.0, 60.0));
        let post = add_post(&mut simulator, v(50.0, 70.0));
        JointFactory::create_revolute_joint_in(&mut simulator, post, block, v(60.0, 60.0)).unwrap();
        simulator[a].set_angular_velocity(2.0);
        let mut copy: Option<PhysicsSimulator> = None;
        for step in 0..120 {
            if step % 10 == 3 {
                let mut restored = precise(0.0);
                restored.restore(&simulator.snapshot()).unwrap();
                copy = Some(restored);
            }
            for simulator in std::iter::once(&mut simulator).chain(&mut copy) {
                if step == 50 {
                    simulator.set_gear_ratio(gear, 1.0).unwrap();
                }
                simulator.update(1.0 / 60.0);
            }
            let is_same = copy.as_ref().is_none_or(|copy| copy.snapshot() == simulator.snapshot());
            assert!(is_same, "{choice:?}, step {step}");
        }
    }
}

#[test]
fn bad_arguments_and_the_faithful_methods_are_refused() {
    let (mut simulator, [a, b], _, gear) = wheels(SolverChoice::Auto, 2.0);
    for ratio in [0.0, f32::NAN, f32::INFINITY] {
        assert!(JointFactory::create_gear_joint(&mut simulator, a, b, ratio).is_err());
        assert!(simulator.set_gear_ratio(gear, ratio).is_err());
    }
    assert_eq!(simulator[gear].ratio(), 2.0);
    assert!(JointFactory::create_gear_joint(&mut simulator, a, a, 1.0).is_err());
    let (none, up) = (v(0.0, 0.0), v(0.0, -100.0));
    for (pulley, ratio) in [(v(f32::NAN, 0.0), 1.0), (up, 0.0), (up, -1.0), (up, f32::NAN)] {
        let ends = [(a, none), (b, none)];
        assert!(JointFactory::create_pulley_joint(&mut simulator, ends, [pulley, up], ratio).is_err());
    }
    let rope =
        JointFactory::create_pulley_joint_in(&mut simulator, [(a, none), (b, none)], [up, up], 1.0).unwrap();
    assert!(simulator[rope].set_length(-1.0).is_err());
    assert!(matches!(simulator.set_gear_ratio(rope, 1.0), Err(Error::WrongKind { .. })));
    let methods = farseer_core::Methods::default();
    assert!(matches!(simulator.set_methods(methods), Err(Error::NotSupported { .. })));
    let mut faithful = self::simulator(0.0);
    let [a, b] = [0.0, 50.0].map(|x| add_ghost(&mut faithful, (10.0, 10.0), v(x, 0.0)));
    let refused = JointFactory::create_gear_joint_in(&mut faithful, a, b, 1.0);
    assert!(matches!(refused, Err(Error::NotSupported { .. })));
    let refused = JointFactory::create_pulley_joint_in(&mut faithful, [(a, none), (b, none)], [up, up], 1.0);
    assert!(matches!(refused, Err(Error::NotSupported { .. })));
}
