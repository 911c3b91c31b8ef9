//! Checks of behaviour chapter 11 on springs, section 10. Numbers are those of the original.

use crate::joint_bench::add_body;
use conformance::fixtures::plane::{self, v};
use conformance::units::{assert_bits, assert_words, floats};
use farseer_core::{
    AngleSpring, Body, BodyId, Context, Error, EventHandler, FixedAngleSpring, FixedLinearSpring,
    LinearSpring, PhysicsSimulator, Result, SpringFactory, SpringId, SpringType,
};

/// Forces and positions in callbacks: the forces last until the bodies are integrated.
#[derive(Debug, Default)]
struct Log {
    bodies: Vec<BodyId>,
    /// Force x, y and torque of each body when the spring had acted.
    loads: Vec<[f32; 3]>,
    updated: usize,
    broke: usize,
}

impl EventHandler for Log {
    fn on_spring_broke(&mut self, _: &mut Context<'_>, _: SpringId) {
        self.broke += 1;
    }

    fn handles_spring_updates(&self) -> bool {
        true
    }

    fn on_spring_updated(&mut self, context: &mut Context<'_>, _: SpringId) {
        self.updated += 1;
        let load = |&body| {
            let body = context.body(body).unwrap();
            [body.force().x, body.force().y, body.torque()]
        };
        self.loads = self.bodies.iter().map(load).collect();
    }
}

/// A spring and its bodies, updated in no time.
struct Bench {
    simulator: PhysicsSimulator,
    spring: SpringId,
    log: Log,
}

impl Bench {
    fn new(make: impl FnOnce(&mut PhysicsSimulator) -> (Vec<BodyId>, SpringId)) -> Self {
        let mut simulator = plane::simulator(0.0);
        let (bodies, spring) = make(&mut simulator);
        assert!(simulator.process_queues(1.0 / 60.0, None));
        Bench { simulator, spring, log: Log { bodies, ..Log::default() } }
    }

    fn of_a(make: impl FnOnce(&mut PhysicsSimulator, BodyId) -> Result<SpringId>) -> Self {
        Bench::new(|simulator| {
            let a = add_body(simulator, (2.0, 3.0), v(0.0, 0.0), 0.3);
            (vec![a], make(simulator, a).unwrap())
        })
    }

    fn of_a_and_b(make: impl FnOnce(&mut PhysicsSimulator, BodyId, BodyId) -> Result<SpringId>) -> Self {
        Bench::new(|simulator| {
            let a = add_body(simulator, (2.0, 3.0), v(0.0, 0.0), 0.3);
            let b = add_body(simulator, (5.0, 7.0), v(1.0, 2.0), 1.1);
            (vec![a, b], make(simulator, a, b).unwrap())
        })
    }

    fn body(&mut self, body: usize) -> &mut Body {
        &mut self.simulator[self.log.bodies[body]]
    }

    fn spring<S: SpringType>(&mut self) -> &mut S {
        self.simulator.spring_as_mut(self.spring).unwrap()
    }

    /// One update of the spring. Returns whether it acted.
    fn update(&mut self) -> bool {
        let before = self.log.updated;
        for &body in &self.log.bodies {
            self.simulator[body].clear_force();
            self.simulator[body].clear_torque();
        }
        self.simulator.apply_forces(0.0, 0.0, Some(&mut self.log));
        self.log.updated != before
    }

    #[track_caller]
    fn expect_load(&self, body: usize, expected: &str) {
        assert_bits(&self.log.loads[body], &floats(expected), || format!("load of body {body}"));
    }

    #[track_caller]
    fn expect_error(&self, expected: &str) {
        assert_words(&self.simulator[self.spring].spring_error(), expected);
    }
}

/// Check 1.
#[test]
fn an_angle_spring_turns_both_bodies() {
    let mut bench = Bench::of_a_and_b(|s, a, b| SpringFactory::create_angle_spring_in(s, a, b, 20.0, 3.0));
    assert_words(&bench.spring::<AngleSpring>().target_angle(), "3f4ccccd");
    bench.body(0).set_angular_velocity(0.5);
    bench.body(1).set_angular_velocity(-0.25);
    bench.body(1).set_rotation(1.6);
    assert!(bench.update());
    bench.expect_load(0, "00000000 00000000 41080000");
    bench.expect_load(1, "00000000 00000000 c1140000");
    bench.expect_error("3f000000");
    assert_eq!(bench.log.updated, 1);
    bench.spring::<AngleSpring>().set_torque_multiplier(-0.5).unwrap();
    bench.spring::<AngleSpring>().set_max_torque(5.0).unwrap();
    bench.update();
    bench.expect_load(0, "00000000 00000000 40880000");
    bench.expect_load(1, "00000000 00000000 c0940000");
}

/// Check 2.
#[test]
fn only_the_setter_limits_the_angle_of_an_angle_spring() {
    let mut bench = Bench::of_a_and_b(|s, a, b| SpringFactory::create_angle_spring_in(s, a, b, 20.0, 3.0));
    let spring = bench.spring::<AngleSpring>();
    for (angle, reads) in [(7.0, 5.5), (-7.0, -5.5), (5.500_000_5, 5.5)] {
        spring.set_target_angle(angle).unwrap();
        assert_eq!(spring.target_angle(), reads);
    }
    let refused = spring.set_target_angle(f32::NAN);
    assert!(matches!(refused, Err(Error::InvalidArgument { argument: "target_angle", .. })), "{refused:?}");
    assert_eq!(spring.target_angle(), 5.5);

    let mut turned = Bench::new(|simulator| {
        let a = add_body(simulator, (2.0, 3.0), v(0.0, 0.0), 0.0);
        let b = add_body(simulator, (2.0, 3.0), v(0.0, 0.0), 20.0);
        (vec![a, b], SpringFactory::create_angle_spring_in(simulator, a, b, 1.0, 0.0).unwrap())
    });
    assert_words(&turned.body(1).total_rotation(), "41a00000");
    assert_eq!(turned.spring::<AngleSpring>().target_angle(), 20.0);
}

/// Check 3.
#[test]
fn a_fixed_angle_spring_turns_its_body() {
    let mut bench = Bench::of_a(|s, a| SpringFactory::create_fixed_angle_spring_in(s, a, 20.0, 3.0));
    assert_words(&bench.spring::<FixedAngleSpring>().target_angle(), "3e99999a");
    bench.spring::<FixedAngleSpring>().set_target_angle(-9.0).unwrap();
    assert_eq!(bench.spring::<FixedAngleSpring>().target_angle(), -9.0);
    bench.body(0).set_angular_velocity(0.5);
    assert!(bench.update());
    bench.expect_load(0, "00000000 00000000 c33b8000");
    bench.expect_error("c114cccd");
    bench.spring::<FixedAngleSpring>().set_max_torque(50.0).unwrap();
    for (multiplier, torque) in [(0.1, "c1960000"), (10.0, "c2480000")] {
        bench.spring::<FixedAngleSpring>().set_torque_multiplier(multiplier).unwrap();
        bench.update();
        bench.expect_load(0, &format!("00000000 00000000 {torque}"));
    }
}

/// Check 4.
#[test]
fn a_fixed_linear_spring_pulls_at_a_point() {
    let mut bench = Bench::new(|simulator| {
        let body = add_body(simulator, (2.0, 3.0), v(1.0, 2.0), 0.7);
        let (here, there) = (v(0.5, -0.25), v(4.0, 1.0));
        let spring = SpringFactory::create_fixed_linear_spring_in(simulator, body, here, there, 12.0, 0.8);
        (vec![body], spring.unwrap())
    });
    assert_words(&bench.spring::<FixedLinearSpring>().rest_length(), "402d13df");
    bench.body(0).set_position(v(0.5, 2.5));
    bench.body(0).set_linear_velocity(v(-1.0, 2.0));
    bench.body(0).set_angular_velocity(0.9);
    assert!(bench.update());
    bench.expect_load(0, "4109733c c097a473 c06ccbb6");
    bench.expect_error("3f2c13ec");
    let attached = bench.body(0).get_world_position(v(0.5, -0.25));
    bench.spring::<FixedLinearSpring>().set_world_attach_point(attached).unwrap();
    assert!(!bench.update());
    bench.expect_error("3f2c13ec");
}

/// Check 5.
fn linear_bench() -> Bench {
    let mut bench = Bench::of_a_and_b(|s, a, b| {
        SpringFactory::create_linear_spring_in(s, a, v(0.2, 0.1), b, v(-0.3, 0.4), 12.0, 0.8)
    });
    assert_words(&bench.spring::<LinearSpring>().rest_length(), "3fe58506");
    bench.body(1).set_position(v(1.5, 2.75));
    bench.body(0).set_linear_velocity(v(1.0, -2.0));
    bench.body(1).set_linear_velocity(v(-0.5, 0.25));
    bench.body(0).set_angular_velocity(0.6);
    bench.body(1).set_angular_velocity(-1.7);
    bench
}

const LOAD_OF_A: &str = "40780014 4137ec7f 3fa0f3a0";
const LOAD_OF_B: &str = "c0780014 c137ec7f 40aa887b";
const NO_LOAD: &str = "00000000 00000000 00000000";

#[test]
fn a_linear_spring_pulls_at_both_bodies() {
    let mut bench = linear_bench();
    assert!(bench.update());
    bench.expect_load(0, LOAD_OF_A);
    bench.expect_load(1, LOAD_OF_B);
    bench.expect_error("3f5ae534");
    assert_eq!(bench.log.updated, 1);
}

#[test]
fn a_linear_spring_does_not_pull_at_a_static_body() {
    let mut bench = linear_bench();
    bench.body(0).set_is_static(true);
    for is_b_enabled in [true, false] {
        bench.body(1).set_enabled(is_b_enabled);
        assert!(bench.update());
        bench.expect_load(0, NO_LOAD);
        bench.expect_load(1, LOAD_OF_B);
    }
}

#[test]
fn a_spring_between_disabled_bodies_rests() {
    let mut bench = linear_bench();
    bench.body(0).set_is_static(true);
    bench.body(0).set_enabled(false);
    bench.body(1).set_enabled(false);
    assert!(!bench.update());
    assert_eq!(bench.body(1).force(), v(0.0, 0.0));
}

/// Check 6.
#[test]
fn a_spring_breaks_one_update_late_and_acts_once_more() {
    let mut bench = Bench::new(|simulator| {
        let body = add_body(simulator, (2.0, 1.0), v(0.0, 0.0), 0.0);
        let (here, there) = (v(0.0, 0.0), v(1.0, 0.0));
        let spring = SpringFactory::create_fixed_linear_spring_in(simulator, body, here, there, 10.0, 0.0);
        (vec![body], spring.unwrap())
    });
    let spring = bench.spring;
    bench.simulator[spring].set_breakpoint(0.5).unwrap();
    bench.body(0).set_position(v(-1.0, 0.0));
    for (is_enabled, broke) in [(true, 0), (false, 1)] {
        assert!(bench.update());
        assert_eq!(bench.log.loads[0], [10.0, 0.0, 0.0]);
        assert_eq!(bench.simulator[spring].spring_error(), 1.0);
        assert_eq!((bench.simulator[spring].enabled(), bench.log.broke), (is_enabled, broke));
    }
    assert!(!bench.update());
    assert_eq!(bench.log.broke, 1);
    // The error is still that of the last update.
    bench.simulator[spring].set_enabled(true);
    assert!(bench.update());
    assert_eq!(bench.log.broke, 2);
}

/// Check 7.
#[test]
fn a_linear_spring_without_length_has_no_force() {
    let mut bench = Bench::new(|simulator| {
        let body = add_body(simulator, (2.0, 1.0), v(0.0, 0.0), 0.0);
        let origin = v(0.0, 0.0);
        let spring = SpringFactory::create_fixed_linear_spring_in(simulator, body, origin, origin, 10.0, 0.0);
        (vec![body], spring.unwrap())
    });
    assert_eq!(bench.spring::<FixedLinearSpring>().rest_length(), 0.0);
    bench.spring::<FixedLinearSpring>().set_rest_length(1.0).unwrap();
    assert!(!bench.update());
    bench.expect_error("00000000");
    bench.body(0).set_position(v(f32::from_bits(0x3727_c5ac), 0.0));
    assert!(bench.update());
    assert_words(&bench.log.loads[0][0], "411fff97");
    bench.expect_error("bf7fff58");
    bench.body(0).set_position(v(9.9999e-6, 0.0));
    assert!(!bench.update());
}

/// Check 8.
#[test]
fn forces_accumulate_in_a_disabled_body_until_it_is_enabled() {
    let mut simulator = plane::simulator(0.0);
    let p = add_body(&mut simulator, (1.0, 1.0), v(0.0, 0.0), 0.0);
    let q = add_body(&mut simulator, (1.0, 1.0), v(2.0, 0.0), 0.0);
    simulator[p].set_linear_drag_coefficient(0.0);
    simulator[q].set_linear_drag_coefficient(0.0);
    simulator[q].set_enabled(false);
    let centre = v(0.0, 0.0);
    let spring =
        SpringFactory::create_linear_spring_in(&mut simulator, p, centre, q, centre, 1.0, 0.0).unwrap();
    simulator.spring_as_mut::<LinearSpring>(spring).unwrap().set_rest_length(1.0).unwrap();
    for (force, x, velocity) in [(-1.0, 0.25, 0.5), (-1.75, 0.6875, 0.875)] {
        simulator.update(0.5);
        assert_eq!(simulator[q].force().x, force);
        assert_eq!((simulator[p].position().x, simulator[p].linear_velocity().x), (x, velocity));
    }
    simulator[q].set_enabled(true);
    simulator.update(0.5);
    assert_eq!(simulator[q].force().x, 0.0);
    assert_eq!((simulator[q].position().x, simulator[q].linear_velocity().x), (1.484_375, -1.031_25));
    assert_eq!((simulator[p].position().x, simulator[p].linear_velocity().x), (1.203_125, 1.031_25));
}

/// Updates up to a step and compares position, rotation, velocity and angular velocity of a body.
fn expect_motion(
    simulator: &mut PhysicsSimulator,
    step: &mut usize,
    at: usize,
    body: BodyId,
    expected: &str,
) {
    while *step < at {
        simulator.update(f32::from_bits(0x3c88_8889));
        *step += 1;
    }
    let body = &simulator[body];
    let (position, velocity) = (body.position(), body.linear_velocity());
    let actual = [position.x, position.y, body.rotation(), velocity.x, velocity.y, body.angular_velocity()];
    assert_bits(&actual, &floats(expected), || format!("step {at}"));
}

/// Check 9.
#[test]
fn a_body_on_two_springs_moves_as_recorded() {
    let mut simulator = plane::simulator(10.0);
    let body = add_body(&mut simulator, (2.0, 0.5), v(3.0, 0.0), 0.0);
    let (here, there) = (v(0.5, 0.1), v(1.0, -1.0));
    SpringFactory::create_fixed_linear_spring_in(&mut simulator, body, here, there, 30.0, 0.5).unwrap();
    SpringFactory::create_fixed_angle_spring_in(&mut simulator, body, 4.0, 0.3).unwrap();
    let mut step = 0;
    for (at, expected) in [
        (1, "40400000 3b360b62 00000000 00000000 3e2aaaab 00000000"),
        (60, "3fc1639d 405c6527 40852075 c0709437 40784c47 c085d980"),
        (600, "3ec170ee 403c1274 40aadaf7 c00a56a1 bfd5195d 4003c60f"),
    ] {
        expect_motion(&mut simulator, &mut step, at, body, expected);
    }
}

/// Check 10.
#[test]
fn two_bodies_between_two_springs_move_as_recorded() {
    let mut simulator = plane::simulator(10.0);
    let p = add_body(&mut simulator, (2.0, 0.5), v(0.0, 0.0), 0.0);
    let q = add_body(&mut simulator, (1.0, 0.25), v(2.0, 0.0), 0.5);
    simulator[p].set_ignore_gravity(true);
    simulator[q].set_ignore_gravity(true);
    simulator[p].set_linear_velocity(v(0.0, 1.0));
    simulator[q].set_angular_velocity(2.0);
    let (on_p, on_q) = (v(0.5, 0.1), v(-0.2, -0.3));
    let spring = SpringFactory::create_linear_spring_in(&mut simulator, p, on_p, q, on_q, 30.0, 0.5).unwrap();
    simulator.spring_as_mut::<LinearSpring>(spring).unwrap().set_rest_length(0.75).unwrap();
    SpringFactory::create_angle_spring_in(&mut simulator, p, q, 4.0, 0.3).unwrap();
    let mut step = 0;
    for (at, body, expected) in [
        (1, p, "3b51d677 3c805470 40c8f4f5 3e44b90f 3f709e51 be49b987"),
        (1, q, "3fff2e2a 3b033cea 3f05f0fe bec4b90f 3df61236 3fb23dd2"),
        (60, p, "3f31e85c 3f46e3d6 40b2e5dc bdafab44 bd603931 bf9625f4"),
        (60, q, "3f1c4d1c 3ee42605 3f3d57bc 3e3061e8 4006ee0b be7e1302"),
        (600, p, "3f2b8177 40d303fc 40a6737e bdca7a78 3efafa23 be847441"),
        (600, q, "3f2a2d7c 40d7d5a3 40b78539 3e4b295d 3f80ce25 be20c5e9"),
    ] {
        expect_motion(&mut simulator, &mut step, at, body, expected);
    }
}

#[test]
fn a_spring_is_removed_with_its_body() {
    let mut bench = linear_bench();
    let body = bench.log.bodies[1];
    bench.simulator.dispose(body).unwrap();
    bench.simulator.update(0.01);
    assert!(bench.simulator.spring_list().is_empty());
    assert!(bench.simulator.spring(bench.spring).is_none());
}
