//! Checks of behaviour chapter 10 on joints, section 17. Numbers are those of the original.

use crate::joint_bench::{self, Bench, add_body};
use conformance::fixtures::plane::{self, v};
use conformance::units::{assert_words, floats};
use farseer_core::{
    AngleJoint, AngleLimitJoint, BodyId, Context, Error, EventHandler, FixedAngleJoint, FixedAngleLimitJoint,
    FixedRevoluteJoint, JointFactory, JointId, JointType, PhysicsSimulator, PinJoint, RevoluteJoint,
    SliderJoint, WeldJoint,
};

/// A joint of a kind to edit.
fn joint<J: JointType>(bench: &mut Bench) -> &mut J {
    bench.simulator.joint_as_mut(bench.joint).unwrap()
}

fn two_bodies(
    make: impl FnOnce(&mut PhysicsSimulator, BodyId, BodyId) -> farseer_core::Result<JointId>,
) -> Bench {
    Bench::new(|simulator| {
        let a = add_body(simulator, (2.0, 3.0), v(0.0, 0.0), 0.3);
        let b = add_body(simulator, (5.0, 7.0), v(1.0, 2.0), 1.1);
        (vec![a, b], make(simulator, a, b).unwrap())
    })
}

fn body_a(make: impl FnOnce(&mut PhysicsSimulator, BodyId) -> farseer_core::Result<JointId>) -> Bench {
    Bench::new(|simulator| {
        let a = add_body(simulator, (2.0, 3.0), v(0.0, 0.0), 0.3);
        (vec![a], make(simulator, a).unwrap())
    })
}

/// A and B with the velocities that checks 8 to 12 start with.
fn set_velocities(bench: &mut Bench) {
    bench.set_velocity(0, [1.0, -2.0, 0.6]);
    bench.set_velocity(1, [-0.5, 0.25, -1.7]);
}

/// Check 1.
#[test]
fn an_angle_joint_turns_both_bodies() {
    let mut bench = two_bodies(|simulator, a, b| JointFactory::create_angle_joint_in(simulator, a, b));
    joint::<AngleJoint>(&mut bench).set_target_angle(0.4).unwrap();
    bench.set_velocity(0, [0.0, 0.0, 0.5]);
    bench.set_velocity(1, [0.0, 0.0, -0.25]);
    bench.pre_step();
    bench.expect_error("3ecccccd");
    for _ in 0..2 {
        bench.update();
        bench.expect_spins("405570a4 bfbb851f");
        assert_eq!(bench.log.updated, 1);
    }
    bench.end_step();
    bench.set_velocity(0, [0.0, 0.0, 0.5]);
    bench.set_velocity(1, [0.0, 0.0, -0.25]);
    joint::<AngleJoint>(&mut bench).set_max_impulse(0.1).unwrap();
    bench.common().set_softness(0.25).unwrap();
    bench.pre_step();
    bench.update();
    bench.expect_spins("3f088889 be875075");
    assert_eq!(bench.log.updated, 2);
}

/// Check 2.
#[test]
fn a_breaking_joint_acts_once_more_and_breaks_once() {
    let mut bench = two_bodies(|simulator, a, b| JointFactory::create_angle_joint_in(simulator, a, b));
    bench.common().set_breakpoint(0.5).unwrap();
    bench.pre_step();
    bench.update();
    bench.expect_error("3f4ccccd");
    assert!(!bench.common().enabled());
    bench.expect_spins("40d70a3e c03851ec");
    bench.update();
    assert_eq!(bench.log.broke, 1);
}

/// Check 2.
#[test]
fn a_joint_breaks_beyond_its_breakpoint_but_not_at_it() {
    let mut bench = two_bodies(|simulator, a, b| JointFactory::create_angle_joint_in(simulator, a, b));
    bench.pre_step();
    for (breakpoint, broke) in [(0x3f4c_cccc, 1), (0x3f4c_cccd, 1), (0x3f4c_cccc, 2)] {
        bench.common().set_breakpoint(f32::from_bits(breakpoint)).unwrap();
        bench.common().set_enabled(true);
        bench.update();
        assert_eq!(bench.log.broke, broke);
    }
}

/// Check 3: where the original breaks on NaN, it does not get in.
#[test]
fn nan_is_refused() {
    let mut bench = two_bodies(|simulator, a, b| JointFactory::create_angle_joint_in(simulator, a, b));
    let refused = joint::<AngleJoint>(&mut bench).set_target_angle(f32::NAN);
    assert!(matches!(refused, Err(Error::InvalidArgument { argument: "target_angle", .. })), "{refused:?}");
    assert_eq!(joint::<AngleJoint>(&mut bench).target_angle(), 0.0);
    let [a, b] = [bench.bodies[0], bench.bodies[1]];
    let refused = JointFactory::create_revolute_joint_in(&mut bench.simulator, a, b, v(f32::NAN, 0.0));
    assert!(
        matches!(refused, Err(Error::InvalidArgument { argument: "initial_anchor_position", .. })),
        "{refused:?}"
    );
}

/// Check 4.
#[test]
fn an_angle_limit_joint_holds_at_its_limits() {
    let mut bench = two_bodies(|s, a, b| JointFactory::create_angle_limit_joint_in(s, a, b, -0.5, 0.6));
    bench.set_velocity(1, [0.0, 0.0, 1.5]);
    bench.pre_step();
    bench.update();
    bench.expect_error("3e4ccccc");
    bench.expect_spins("402eb852 3ea8f5c4");
    bench.pre_step();
    bench.expect_spins("40aeb852 bf570a3c");
    bench.update();
    bench.expect_spins("402eb852 3ea8f5c4");
    // In range, then inside the slop with a velocity away from the limit.
    for rotation in [0.5, 0.905] {
        bench.end_step();
        bench.body(1).set_rotation(rotation);
        bench.pre_step();
        bench.update();
        bench.expect_error("00000000");
        bench.expect_spins("402eb852 3ea8f5c4");
    }
    bench.end_step();
    bench.body(0).set_rotation(2.0);
    bench.pre_step();
    bench.update();
    bench.expect_error("bf1851ec");
    bench.expect_spins("c07cac0a 404c49bc");
    assert_words(&joint::<AngleLimitJoint>(&mut bench).slop(), "3c23d70a");
}

/// Check 5.
#[test]
fn a_fixed_angle_joint_turns_its_body() {
    let mut bench = body_a(|simulator, body| JointFactory::create_fixed_angle_joint_in(simulator, body));
    joint::<FixedAngleJoint>(&mut bench).set_target_angle(-0.2).unwrap();
    bench.common().set_softness(0.1).unwrap();
    bench.set_velocity(0, [0.0, 0.0, 0.5]);
    bench.pre_step();
    bench.expect_error("3f000000");
    bench.update();
    bench.expect_spins("c0ab3333");
    bench.update();
    bench.expect_spins("c0bdeb85");
    joint::<FixedAngleJoint>(&mut bench).set_max_impulse(0.5).unwrap();
    bench.set_velocity(0, [0.0, 0.0, 0.5]);
    bench.update();
    bench.expect_spins("3eaaaaaa");
}

/// Check 6.
#[test]
fn a_fixed_angle_limit_joint_clears_its_impulse_between_limits() {
    let mut bench = body_a(|s, a| JointFactory::create_fixed_angle_limit_joint_in(s, a, 0.8, 1.2));
    bench.common().set_softness(0.1).unwrap();
    bench.set_velocity(0, [0.0, 0.0, 0.5]);
    bench.pre_step();
    bench.expect_error("bf000000");
    for spin in ["40ae6666", "409378d5"] {
        bench.update();
        bench.expect_spins(spin);
    }
    bench.pre_step();
    bench.expect_spins("410b78d5");
    bench.update();
    bench.expect_spins("40a5326c");
    bench.end_step();
    bench.body(0).set_rotation(1.3);
    bench.pre_step();
    bench.expect_error("3dccccc0");
    bench.expect_spins("40a5326c");
    bench.update();
    bench.expect_spins("bf105278");
    assert_words(&joint::<FixedAngleLimitJoint>(&mut bench).slop(), "3c23d70a");
}

/// Check 7.
#[test]
fn a_fixed_revolute_joint_clamps_its_impulse() {
    let mut bench = Bench::new(|simulator| {
        let body = add_body(simulator, (2.0, 3.0), v(1.0, 2.0), 0.7);
        let joint = JointFactory::create_fixed_revolute_joint_in(simulator, body, v(2.5, 1.25)).unwrap();
        (vec![body], joint)
    });
    assert_words(&bench.common().bias_factor(), "3f4ccccd");
    bench.body(0).set_position(v(1.1, 1.9));
    bench.body(0).set_rotation(0.8);
    bench.set_velocity(0, [3.0, -4.0, 0.75]);
    bench.pre_step();
    bench.expect_error("3e33f0a0");
    bench.expect_velocity(0, "40400000 c0800000 3f400000");
    for _ in 0..2 {
        bench.update();
        bench.expect_velocity(0, "c0f2e11e bfb33ec4 bf3eb046");
    }
    bench.pre_step();
    bench.expect_velocity(0, "c191708f 3f998278 c00f5823");
    joint::<FixedRevoluteJoint>(&mut bench).set_max_impulse(2.0).unwrap();
    bench.common().set_softness(0.05).unwrap();
    bench.pre_step();
    bench.expect_velocity(0, "c1993582 3fb8067a c0181e36");
    bench.update();
    bench.expect_velocity(0, "c1918766 3f943112 c0126812");
}

/// Check 8.
#[test]
fn a_revolute_joint_holds_two_bodies_at_a_point() {
    let mut bench = two_bodies(|s, a, b| JointFactory::create_revolute_joint_in(s, a, b, v(0.4, 0.9)));
    bench.expect_current_anchor("00000000 00000000");
    set_velocities(&mut bench);
    bench.body(1).set_position(v(1.05, 2.1));
    bench.pre_step();
    bench.expect_error("3de4f925");
    bench.expect_current_anchor("3ecccccd 3f666667");
    bench.update();
    bench.expect_velocity(0, "3efbc95e 3efc4d80 3fc8eb3a");
    bench.expect_velocity(1, "be97ea26 bf3f42b3 bf8e74bb");
    bench.update();
    bench.expect_velocity(0, "3efbc95c 3efc4d84 3fc8eb3b");
    bench.expect_velocity(1, "be97ea25 bf3f42b4 bf8e74bb");
    bench.pre_step();
    bench.expect_velocity(0, "bc86d480 403f1362 402284d5");
    bench.expect_velocity(1, "bdbf5126 bfdf42b4 bf069fb7");
    bench.common().set_softness(0.05).unwrap();
    bench.pre_step();
    bench.update();
    bench.expect_velocity(0, "3edba5b0 3e861c40 3fc5dc3a");
    bench.expect_velocity(1, "be8b0f13 bf279f3c bf90ff04");
    assert_eq!(joint::<RevoluteJoint>(&mut bench).anchor(), v(0.4, 0.9));
}

/// Check 9.
#[test]
fn a_pin_joint_keeps_a_distance() {
    let mut bench =
        two_bodies(|s, a, b| JointFactory::create_pin_joint_in(s, a, v(0.2, 0.1), b, v(-0.3, 0.4)));
    let pin = joint::<PinJoint>(&mut bench);
    assert_words(&pin.target_distance(), "3fe58506");
    assert_words(&pin.world_anchor1(), "3e256443 3e1e5958");
    assert_words(&pin.world_anchor2(), "3f01e778 3ff50073");
    pin.set_target_distance(2.0).unwrap();
    set_velocities(&mut bench);
    bench.pre_step();
    bench.expect_error("be53d7d0");
    bench.update();
    bench.expect_velocity(0, "3f828c8b bff30906 3f1bddd0");
    bench.expect_velocity(1, "bf020a09 3e568345 bfd7d689");
    bench.pre_step();
    bench.expect_velocity(0, "3f851916 bfe6120c 3f1e2206");
    bench.expect_velocity(1, "bf041412 3e2d068a bfd61378");
    bench.common().set_softness(0.1).unwrap();
    bench.pre_step();
    bench.update();
    bench.expect_velocity(0, "3f82da8a bff17c52 3f1c232a");
    bench.expect_velocity(1, "bf02486f 3e518dd0 bfd7a09f");
}

/// Check 10.
#[test]
fn a_pin_joint_with_coincident_anchors_saves_its_impulse_up() {
    let mut bench = Bench::new(|simulator| {
        let a = add_body(simulator, (2.0, 3.0), v(0.0, 0.0), 0.0);
        let b = add_body(simulator, (5.0, 7.0), v(0.0, 0.0), 0.0);
        let joint = JointFactory::create_pin_joint_in(simulator, a, v(0.0, 0.0), b, v(0.0, 0.0)).unwrap();
        (vec![a, b], joint)
    });
    joint::<PinJoint>(&mut bench).set_target_distance(1.0).unwrap();
    bench.pre_step();
    bench.expect_error("bf800000");
    bench.update();
    bench.update();
    assert_eq!(bench.velocity(0), [0.0; 3]);
    assert_eq!(bench.velocity(1), [0.0; 3]);
    assert_eq!(bench.log.updated, 0);
    bench.end_step();
    bench.body(1).set_position(v(1.0, 0.0));
    bench.pre_step();
    bench.expect_error("00000000");
    assert_words(&bench.velocity(0)[0], "c1892492");
    assert_words(&bench.velocity(1)[0], "40db6db7");
}

/// Check 11.
#[test]
fn a_slider_joint_keeps_a_distance_in_range() {
    let mut bench = two_bodies(|s, a, b| {
        JointFactory::create_slider_joint_in(s, a, v(0.2, 0.1), b, v(-0.3, 0.4), 0.5, 1.5)
    });
    bench.expect_current_anchor("3e256443 3e1e5958");
    set_velocities(&mut bench);
    bench.pre_step();
    bench.expect_error("3e961418");
    bench.update();
    bench.expect_velocity(0, "3fe71d34 40063af2 3f7548ba");
    bench.expect_velocity(1, "bf527dc4 bfb1c8c2 bf9252b5");
    bench.pre_step();
    bench.expect_velocity(0, "40271d34 40c63af2 3fa87bed");
    bench.expect_velocity(1, "bf927dc4 c041c8c2 bf1617a0");
    for max in [None, Some(10.0)] {
        if let Some(max) = max {
            joint::<SliderJoint>(&mut bench).set_max(max).unwrap();
            bench.pre_step();
        }
        bench.update();
        bench.expect_velocity(0, "3fe71d36 40063af8 3f7548bc");
        bench.expect_velocity(1, "bf527dc6 bfb1c8c7 bf9252b3");
    }
    joint::<SliderJoint>(&mut bench).set_min(4.0).unwrap();
    bench.pre_step();
    bench.expect_error("c00d3d7d");
    bench.update();
    bench.expect_velocity(0, "c007db0e c18f104b bf49cdda");
    bench.expect_velocity(1, "3f3fc4e2 40d34d45 c076f2ec");
    joint::<SliderJoint>(&mut bench).set_min(0.1).unwrap();
    joint::<SliderJoint>(&mut bench).set_max(0.2).unwrap();
    bench.pre_step();
    bench.expect_error("3fcbeb6c");
    bench.expect_velocity(0, "c007db0e c18f104b bf49cdda");
    bench.expect_velocity(1, "3f3fc4e2 40d34d45 c076f2ec");
    bench.update();
    bench.expect_velocity(0, "40764aa8 4147cb2c 3feee28d");
    bench.expect_velocity(1, "bfd1d555 c0b16f57 3e89a9c0");
}

/// Check 12.
#[test]
fn a_weld_joint_holds_a_point_and_an_angle() {
    let mut bench = two_bodies(|s, a, b| JointFactory::create_weld_joint_in(s, a, b, v(0.4, 0.9)));
    set_velocities(&mut bench);
    bench.body(1).set_position(v(1.05, 2.1));
    bench.body(1).set_rotation(1.2);
    bench.pre_step();
    bench.expect_error("3e2d22d0");
    bench.update();
    bench.expect_velocity(0, "3f53f412 3e4ca9b0 be2e1470");
    bench.expect_velocity(1, "bedcc342 bf21442b bf80e6a0");
    bench.update();
    bench.expect_velocity(0, "3f1edf93 3e95404b 3dac2ec4");
    bench.expect_velocity(1, "beb24c76 bf2aa675 bf8473c1");
    bench.pre_step();
    bench.expect_velocity(0, "3e76fc9c 40255012 3f6c3b78");
    bench.expect_velocity(1, "be4931d9 bfcaa675 bf173692");
    joint::<WeldJoint>(&mut bench).set_max_impulse(0.2).unwrap();
    bench.common().set_softness(0.1).unwrap();
    bench.pre_step();
    bench.update();
    bench.expect_velocity(0, "3ef04536 bd8e0280 3fd8f003");
    bench.expect_velocity(1, "be934ee3 bf05b312 bf80d5f4");
}

/// Check 13.
fn joint_to_a_disabled_body(is_other_enabled: bool) -> Bench {
    let mut bench = Bench::new(|simulator| {
        let a = add_body(simulator, (2.0, 3.0), v(0.0, 0.0), 0.0);
        let b = add_body(simulator, (5.0, 7.0), v(1.0, 0.0), 0.0);
        (vec![a, b], JointFactory::create_revolute_joint_in(simulator, a, b, v(1.0, 0.0)).unwrap())
    });
    bench.body(0).set_enabled(false);
    bench.body(1).set_is_static(true);
    bench.body(1).set_enabled(is_other_enabled);
    bench.set_velocity(0, [0.0, 1.0, 0.0]);
    bench.pre_step();
    bench.update();
    bench
}

#[test]
fn a_joint_changes_the_velocity_of_a_disabled_body() {
    let mut bench = joint_to_a_disabled_body(true);
    bench.expect_velocity(0, "00000000 3eccccce becccccc");
}

#[test]
fn a_joint_between_disabled_bodies_rests() {
    let mut bench = joint_to_a_disabled_body(false);
    assert_eq!(bench.velocity(0), [0.0, 1.0, 0.0]);
    assert_eq!(bench.log.updated, 0);
}

/// Where a body is after a step: position, rotation, velocity, angular velocity.
type Row = (usize, usize, &'static str);

/// Check 14: a scene of the bodies G, P and Q without geoms.
fn check_scene(make: impl FnOnce(&mut PhysicsSimulator, [BodyId; 3]), rows: &[Row]) {
    let mut simulator = plane::simulator(10.0);
    let g = add_body(&mut simulator, (1.0, 1.0), v(0.0, 0.0), 0.0);
    simulator[g].set_is_static(true);
    let p = add_body(&mut simulator, (2.0, 0.5), v(3.0, 0.0), 0.0);
    let q = add_body(&mut simulator, (1.0, 0.25), v(5.0, 0.0), 0.2);
    make(&mut simulator, [g, p, q]);
    let mut step = 0;
    for &(at, body, expected) in rows {
        while step < at {
            simulator.update(f32::from_bits(0x3c88_8889));
            step += 1;
        }
        let body = &simulator[[g, p, q][body]];
        let (position, velocity) = (body.position(), body.linear_velocity());
        let [x, y, rotation] = [position.x, position.y, body.rotation()];
        let actual = [x, y, rotation, velocity.x, velocity.y, body.angular_velocity()];
        conformance::units::assert_bits(&actual, &floats(expected), || format!("step {at}"));
    }
}

const P: usize = 1;
const Q: usize = 2;

#[test]
fn a_pendulum_on_a_static_body_swings_as_recorded() {
    check_scene(
        |simulator, [g, p, _]| {
            JointFactory::create_revolute_joint_in(simulator, g, p, v(0.0, 0.0)).unwrap();
        },
        &[
            (1, P, "40400000 3b311fd5 3a6c2a71 00000000 3e260dd7 3d5d67c9"),
            (60, P, "3e37fb47 4040738f 3fc184c3 c0f2d39b 3f1f1046 4021d51f"),
            (600, P, "c03dfa6c 3ee76ccc 403f65f8 bed46ee6 c02bbec5 3f674c76"),
        ],
    );
}

#[test]
fn a_pendulum_on_the_world_swings_as_recorded() {
    check_scene(
        |simulator, [_, p, _]| {
            JointFactory::create_fixed_revolute_joint_in(simulator, p, v(0.0, 0.0)).unwrap();
        },
        &[
            (60, P, "3e2ab98f 403feb0a 3fc1f54d c0f355a1 3f15d87d 402288fb"),
            (600, P, "c03e371a 3ed2be3e 40404137 bed100a0 c033be7b 3f722205"),
        ],
    );
}

#[test]
fn a_pinned_and_sliding_chain_swings_as_recorded() {
    check_scene(
        |simulator, [g, p, q]| {
            let s = simulator;
            JointFactory::create_pin_joint_in(s, g, v(0.0, 0.0), p, v(-0.5, 0.0)).unwrap();
            JointFactory::create_slider_joint_in(s, p, v(0.5, 0.0), q, v(-0.25, 0.0), 0.5, 1.0).unwrap();
            JointFactory::create_angle_limit_joint_in(s, p, q, -0.3, 0.3).unwrap();
        },
        &[
            (1, P, "40400343 3ae9f739 40c8ff97 3c43c244 3ddb57c5 bdf3fb1f"),
            (1, Q, "409e6502 3b9c1575 3e4099d8 c040a6dc 3e92541d bf36fc57"),
            (60, P, "3f4f000a 4038b6ad 3fbc9cb3 c08e61f1 3fc09481 bdfbb17f"),
            (60, Q, "3fb343c8 4090cfa8 3fb22820 c1304be1 40b49275 402717aa"),
            (600, P, "3e792926 403e881e 3fde9f1f c073e5c3 bcfa10ad 408912bd"),
            (600, Q, "beb69f7c 40938a4c 3fc99c09 c12a32f7 c0033d42 40ccdd65"),
        ],
    );
}

#[test]
fn welded_bodies_on_a_hinge_swing_as_recorded() {
    check_scene(
        |simulator, [g, p, q]| {
            JointFactory::create_revolute_joint_in(simulator, g, p, v(1.0, 0.0)).unwrap();
            JointFactory::create_weld_joint_in(simulator, p, q, v(4.0, 0.0)).unwrap();
        },
        &[
            (1, P, "40400000 3b0bf995 3a681ee7 00000000 3e0339fb 3d599cf8"),
            (1, Q, "40a00000 3b6155d2 3e4d630e 00000000 3e534074 3d0cdcef"),
            (60, P, "3f91615e 4000393f 3fc08584 c0a01dee 3ee55f65 402046f3"),
            (60, Q, "3fa2a1ea 40803a6f 3fda2b8a c1203b9c 3f65294e 4020729e"),
            (600, P, "bf7585f1 3ecf4f84 403c0d57 be179bae bf3a998e 3ebe3040"),
            (600, Q, "c03acbc5 3f4ebc42 4048e857 be96f6d5 bfba9d1e 3ebe25e3"),
        ],
    );
}

/// A body that hangs on a joint too short for it, which breaks in the first pass.
fn stretched_pin_joint() -> (PhysicsSimulator, BodyId, JointId) {
    let mut simulator = plane::simulator(10.0);
    let g = add_body(&mut simulator, (1.0, 1.0), v(0.0, 0.0), 0.0);
    simulator[g].set_is_static(true);
    let p = add_body(&mut simulator, (2.0, 0.5), v(0.0, 1.0), 0.0);
    let joint = JointFactory::create_pin_joint_in(&mut simulator, g, v(0.0, 0.0), p, v(0.0, 0.0)).unwrap();
    simulator.joint_as_mut::<PinJoint>(joint).unwrap().set_target_distance(0.5).unwrap();
    simulator[joint].set_breakpoint(0.1).unwrap();
    (simulator, p, joint)
}

/// Check 15.
#[test]
fn a_joint_that_breaks_in_an_update_acts_in_one_iteration_only() {
    let (mut simulator, p, joint) = stretched_pin_joint();
    let mut log = joint_bench::Log::default();
    for (y, velocity) in [("3f666666", "c0bfffff"), ("3f4d82e6", "c0baaa41")] {
        simulator.update_with(1.0 / 60.0, &mut log);
        assert!(!simulator[joint].enabled());
        assert_eq!((log.broke, log.updated), (1, 1));
        assert_words(&simulator[joint].joint_error(), "3f000000");
        assert_words(&simulator[p].position().y, y);
        assert_words(&simulator[p].linear_velocity().y, velocity);
    }
}

/// Disposes joints as they break, and counts how often they act.
#[derive(Default)]
struct Cutter {
    broke: usize,
    updated: usize,
}

impl EventHandler for Cutter {
    fn on_joint_broke(&mut self, context: &mut Context<'_>, joint: JointId) {
        self.broke += 1;
        context.dispose(joint).unwrap();
    }

    fn handles_joint_updates(&self) -> bool {
        true
    }

    fn on_joint_updated(&mut self, _: &mut Context<'_>, _: JointId) {
        self.updated += 1;
    }
}

/// Disposal has no effect on the running iteration: the original's joint goes on to act.
#[test]
fn a_joint_that_is_disposed_when_it_breaks_acts_once_more() {
    let (mut simulator, _, joint) = stretched_pin_joint();
    let mut cutter = Cutter::default();
    simulator.update_with(1.0 / 60.0, &mut cutter);
    assert_eq!((cutter.broke, cutter.updated), (1, 1));
    simulator.update_with(1.0 / 60.0, &mut cutter);
    assert_eq!((cutter.broke, cutter.updated), (1, 1));
    assert!(simulator.joint(joint).is_none());
}

/// Check 16.
#[test]
fn a_joint_is_removed_with_its_body() {
    let mut bench = two_bodies(|s, a, b| JointFactory::create_revolute_joint_in(s, a, b, v(0.4, 0.9)));
    let body = bench.bodies[0];
    bench.simulator.dispose(body).unwrap();
    bench.simulator.update(0.01);
    assert!(bench.simulator.joint_list().is_empty());
    assert_eq!(bench.simulator.body_list().len(), 1);
    assert!(bench.simulator.joint(bench.joint).is_none());
}
