//! The precise set: the accuracy of joints, and the loads that break them.

use approx::assert_abs_diff_eq;
use conformance::fixtures::plane::{Random, add_box, add_floor, not_finite, precise, run, simulator, v};
use farseer_core::math::Vector2;
use farseer_core::{
    BodyFactory, BodyId, Event, JointFactory, JointId, Methods, PhysicsSimulator, Result, RevoluteJoint,
};

pub(crate) const DT: f32 = 1.0 / 60.0;
pub(crate) const GRAVITY: f32 = 320.0;

/// A box without drag and without collisions.
pub(crate) fn ghost(simulator: &mut PhysicsSimulator, size: (f32, f32), position: Vector2) -> BodyId {
    let (body, geom) = add_box(simulator, size, position);
    simulator[geom].set_collision_enabled(false);
    simulator[body].set_linear_drag_coefficient(0.0);
    simulator[body].set_rotational_drag_coefficient(0.0);
    body
}

pub(crate) fn joined(simulator: &mut PhysicsSimulator, joint: Result<JointId>) -> JointId {
    let joint = joint.unwrap();
    simulator.add(joint).unwrap();
    joint
}

/// Links of 16 px that hang from the origin, at first level.
pub(crate) fn chain(simulator: &mut PhysicsSimulator, count: usize) -> (Vec<BodyId>, Vec<JointId>) {
    let (mut bodies, mut joints) = (Vec::new(), Vec::new());
    for at in 0..count {
        let left = 16.0 * at as f32;
        let body = ghost(simulator, (16.0, 4.0), v(left + 8.0, 0.0));
        let joint = match bodies.last() {
            None => JointFactory::create_fixed_revolute_joint(simulator, body, v(0.0, 0.0)),
            Some(&last) => JointFactory::create_revolute_joint(simulator, last, body, v(left, 0.0)),
        };
        joints.push(joined(simulator, joint));
        bodies.push(body);
    }
    (bodies, joints)
}

/// Two boxes and a joint of each kind between them.
fn pairs() -> Vec<(&'static str, PhysicsSimulator, [BodyId; 2], JointId)> {
    type Make = fn(&mut PhysicsSimulator, BodyId, BodyId) -> Result<JointId>;
    let kinds: [(&'static str, Make); 6] = [
        ("revolute", |s, a, b| JointFactory::create_revolute_joint(s, a, b, v(20.0, 3.0))),
        ("weld", |s, a, b| JointFactory::create_weld_joint(s, a, b, v(20.0, 3.0))),
        ("pin", |s, a, b| JointFactory::create_pin_joint(s, a, v(5.0, 2.0), b, v(-5.0, 4.0))),
        ("slider", |s, a, b| {
            JointFactory::create_slider_joint(s, a, v(5.0, 2.0), b, v(-5.0, 4.0), 20.0, 35.0)
        }),
        ("angle", |s, a, b| JointFactory::create_angle_joint(s, a, b)),
        ("angle limit", |s, a, b| JointFactory::create_angle_limit_joint(s, a, b, -0.3, 0.3)),
    ];
    kinds
        .into_iter()
        .map(|(name, make)| {
            let mut simulator = precise(0.0);
            let a = ghost(&mut simulator, (24.0, 16.0), v(0.0, 0.0));
            let b = ghost(&mut simulator, (16.0, 20.0), v(40.0, 0.0));
            let joint = make(&mut simulator, a, b);
            let joint = joined(&mut simulator, joint);
            (name, simulator, [a, b], joint)
        })
        .collect()
}

/// Momentum, and angular momentum about the origin.
pub(crate) fn momentum(simulator: &PhysicsSimulator, bodies: [BodyId; 2]) -> [f64; 3] {
    let mut sum = [0.0; 3];
    for body in bodies.map(|body| &simulator[body]) {
        let [mass, inertia, spin] =
            [body.mass(), body.moment_of_inertia(), body.angular_velocity()].map(f64::from);
        let (place, velocity) = (body.position().map(f64::from), body.linear_velocity().map(f64::from));
        sum[0] += mass * velocity.x;
        sum[1] += mass * velocity.y;
        sum[2] += mass * (place.x * velocity.y - place.y * velocity.x) + inertia * spin;
    }
    sum
}

#[test]
fn joints_between_two_bodies_keep_momentum_and_angular_momentum() {
    for (name, mut simulator, bodies, _) in pairs() {
        simulator[bodies[0]].set_linear_velocity(v(30.0, -20.0));
        simulator[bodies[1]].set_linear_velocity(v(-10.0, 40.0));
        simulator[bodies[1]].set_angular_velocity(3.0);
        let before = momentum(&simulator, bodies);
        run(&mut simulator, 240);
        let after = momentum(&simulator, bodies);
        // 240 steps of roundings of numbers of this size; the last is about an origin that is up to 200 px away.
        for i in 0..2 {
            assert_abs_diff_eq!(after[i], before[i], epsilon = 1e-5 * 240.0);
        }
        let scale = before[2].abs().max(1000.0);
        assert!((after[2] - before[2]).abs() < 1e-4 * scale, "{name}: {before:?} {after:?}");
    }
}

#[test]
fn every_joint_between_two_bodies_keeps_its_constraint() {
    for (name, mut simulator, bodies, joint) in pairs() {
        simulator[bodies[0]].set_linear_velocity(v(30.0, -20.0));
        simulator[bodies[1]].set_linear_velocity(v(-10.0, 40.0));
        simulator[bodies[1]].set_angular_velocity(3.0);
        for _ in 0..240 {
            simulator.update(DT);
            let error = simulator[joint].joint_error();
            // In px and radians: roundings, and as much for the error of a predicted rotation. A limit has a slop of 0.01, and
            // as much for the error of a step.
            let has_limits = ["slider", "angle limit"].contains(&name);
            assert!(error.abs() < if has_limits { 0.03 } else { 4e-5 }, "{name}: {error}");
        }
    }
}

#[test]
fn a_body_on_a_fixed_angle_falls_without_turning() {
    let mut simulator = precise(GRAVITY);
    let body = ghost(&mut simulator, (20.0, 20.0), v(0.0, 0.0));
    let joint = JointFactory::create_fixed_angle_joint(&mut simulator, body);
    joined(&mut simulator, joint);
    simulator[body].apply_torque(1e6);
    simulator[body].set_angular_velocity(5.0);
    run(&mut simulator, 60);
    assert_abs_diff_eq!(simulator[body].rotation(), 0.0, epsilon = 1e-6);
    assert_abs_diff_eq!(simulator[body].position().y, 0.5 * GRAVITY, epsilon = 0.01);
}

#[test]
fn a_body_turns_as_far_as_its_limit_and_stays_there() {
    let mut simulator = precise(0.0);
    let body = ghost(&mut simulator, (20.0, 20.0), v(0.0, 0.0));
    let joint = JointFactory::create_fixed_angle_limit_joint(&mut simulator, body, -0.5, 1.0);
    let joint = joined(&mut simulator, joint);
    simulator[body].set_angular_velocity(2.0);
    run(&mut simulator, 29);
    assert_abs_diff_eq!(simulator[body].total_rotation(), 2.0 * 29.0 * DT, epsilon = 1e-4);
    run(&mut simulator, 60);
    assert_abs_diff_eq!(simulator[body].total_rotation(), 1.0, epsilon = 1e-3);
    assert_abs_diff_eq!(simulator[body].angular_velocity(), 0.0, epsilon = 1e-4);
    assert_eq!(simulator[joint].joint_error(), 0.0);
}

#[test]
fn a_bridge_of_20_between_two_shores_carries_a_heavy_load() {
    let mut simulator = precise(GRAVITY);
    let (bodies, mut joints) = chain(&mut simulator, 20);
    let shore = JointFactory::create_fixed_revolute_joint(&mut simulator, bodies[19], v(320.0, 0.0));
    joints.push(joined(&mut simulator, shore));
    let mass = simulator[bodies[10]].mass();
    simulator[bodies[10]].set_mass(20.0 * mass).unwrap();
    let mut worst: f32 = 0.0;
    for _ in 0..600 {
        simulator.update(DT);
        worst = joints.iter().map(|&joint| simulator[joint].joint_error()).fold(worst, f32::max);
    }
    // Measured: 0.0046 when the load has come up, and 0.0003 at rest.
    assert!(worst < 0.01, "{worst} px");
    // A taut bridge sags by the root of twice its half length, 160, and the yield of half of its 21 joints: 3.2e-4 each, a
    // millionth of the coordinates. Measured: 0.89.
    let sag = (2.0 * 160.0 * 10.5 * 3.2e-4_f32).sqrt();
    assert!(simulator[bodies[10]].position().y < sag);
    assert!(bodies.iter().all(|&body| simulator.is_asleep(body)));
}

#[test]
fn a_rope_limits_the_distance_of_a_ball_to_its_length() {
    let mut simulator = precise(GRAVITY);
    let (post, _) = add_floor(&mut simulator, (10.0, 10.0), v(0.0, 0.0));
    let ball = ghost(&mut simulator, (10.0, 10.0), v(30.0, 0.0));
    let rope =
        JointFactory::create_slider_joint(&mut simulator, post, v(0.0, 0.0), ball, v(0.0, 0.0), 0.0, 100.0);
    joined(&mut simulator, rope);
    let mut longest: f32 = 0.0;
    for _ in 0..600 {
        simulator.update(DT);
        longest = longest.max(simulator[ball].position().norm());
    }
    assert!(longest > 99.9 && longest < 100.1, "{longest} px");
}

#[test]
fn a_joint_breaks_when_its_load_exceeds_its_greatest_force() {
    let mut simulator = precise(GRAVITY);
    let (bodies, joints) = chain(&mut simulator, 3);
    (0..3).for_each(|at| simulator[bodies[at]].set_rotation(0.0));
    let weight = simulator[bodies[0]].mass() * GRAVITY;
    // At the lowest point of the swing the first one carries more than their weight.
    simulator[joints[0]].set_greatest_force(1.5 * 3.0 * weight).unwrap();
    let mut broken = Vec::new();
    for _ in 0..120 {
        simulator.update(DT);
        broken.extend(simulator.events().iter().filter_map(|event| match event {
            Event::JointBroke { joint } => Some(*joint),
            _ => None,
        }));
    }
    assert_eq!(broken, [joints[0]]);
    assert!(!simulator[joints[0]].enabled());
    assert!(simulator[bodies[0]].position().y > 200.0);
}

#[test]
fn the_force_of_a_joint_at_rest_is_the_hanging_weight() {
    let mut simulator = precise(GRAVITY);
    let body = ghost(&mut simulator, (16.0, 16.0), v(0.0, 8.0));
    let joint = JointFactory::create_fixed_revolute_joint(&mut simulator, body, v(0.0, 0.0));
    let joint = joined(&mut simulator, joint);
    run(&mut simulator, 10);
    let weight = simulator[body].mass() * GRAVITY;
    assert_abs_diff_eq!(simulator[joint].force().y, -weight, epsilon = 1e-3 * weight);
    assert_abs_diff_eq!(simulator[joint].force().x, 0.0, epsilon = 1e-3 * weight);
}

#[test]
fn a_joint_breaks_at_its_breakpoint_before_it_acts() {
    let mut simulator = precise(0.0);
    let (bodies, joints) = chain(&mut simulator, 1);
    simulator[joints[0]].set_breakpoint(5.0).unwrap();
    run(&mut simulator, 5);
    simulator[bodies[0]].set_position(v(28.0, 0.0));
    simulator.update(DT);
    assert!(simulator.events().contains(&Event::JointBroke { joint: joints[0] }));
    assert_abs_diff_eq!(simulator[joints[0]].joint_error(), 20.0, epsilon = 1e-4);
    assert_eq!(simulator[bodies[0]].position(), v(28.0, 0.0));
}

#[test]
fn an_edited_anchor_counts_from_the_next_update_on() {
    let mut simulator = precise(0.0);
    let (bodies, joints) = chain(&mut simulator, 1);
    run(&mut simulator, 5);
    simulator.joint_as_mut::<farseer_core::FixedRevoluteJoint>(joints[0]).unwrap();
    simulator.set_joint_anchor(joints[0], v(8.0, 0.0)).unwrap();
    simulator[bodies[0]].set_angular_velocity(4.0);
    run(&mut simulator, 60);
    assert_abs_diff_eq!(simulator[bodies[0]].position().x, 8.0, epsilon = 1e-3);
    assert_abs_diff_eq!(simulator[bodies[0]].position().y, 0.0, epsilon = 1e-3);
    assert_abs_diff_eq!(simulator[bodies[0]].angular_velocity(), 4.0, epsilon = 1e-3);
}

/// Hangs a body on a static one at the origin, and moves that.
fn assert_is_followed(mut simulator: PhysicsSimulator, post: BodyId) {
    let body = ghost(&mut simulator, (10.0, 10.0), v(0.0, 20.0));
    let joint = JointFactory::create_revolute_joint(&mut simulator, post, body, v(0.0, 0.0));
    joined(&mut simulator, joint);
    run(&mut simulator, 5);
    simulator[post].set_position(v(0.0, 6.0));
    run(&mut simulator, 10);
    assert_abs_diff_eq!(simulator[body].position().y, 26.0, epsilon = 1e-3);
}

#[test]
fn bodies_joined_to_a_static_body_follow_it() {
    let mut simulator = precise(GRAVITY);
    let (post, _) = add_floor(&mut simulator, (10.0, 10.0), v(0.0, 0.0));
    assert_is_followed(simulator, post);
}

#[test]
fn bodies_joined_to_a_static_body_without_geoms_follow_it() {
    let mut simulator = precise(GRAVITY);
    let post = BodyFactory::create_rectangle_body_in(&mut simulator, 10.0, 10.0, 1.0).unwrap();
    simulator[post].set_is_static(true);
    assert_is_followed(simulator, post);
}

#[test]
fn a_soft_joint_yields_to_a_load_as_far_as_with_the_faithful_set() {
    let sag = |methods: Methods| {
        let mut simulator = precise(GRAVITY);
        simulator.set_methods(methods).unwrap();
        let (post, _) = add_floor(&mut simulator, (10.0, 10.0), v(0.0, 0.0));
        let body = ghost(&mut simulator, (16.0, 16.0), v(0.0, 50.0));
        let joint = JointFactory::create_pin_joint(&mut simulator, post, v(0.0, 0.0), body, v(0.0, 0.0));
        let joint = joined(&mut simulator, joint);
        let softness = 2.0 / simulator[body].mass();
        simulator[joint].set_softness(softness).unwrap();
        run(&mut simulator, 1200);
        simulator[body].position().y - 50.0
    };
    let (precise, faithful) = (sag(Methods::PRECISE), sag(Methods::default()));
    // Softness times the impulse of an update, divided by the fraction of an error that an update corrects.
    let law = 2.0 * GRAVITY * DT * DT / 0.2;
    assert!((precise / law - 1.0).abs() < 0.01, "{precise} {law}");
    assert!((faithful / law - 1.0).abs() < 0.01, "{faithful} {law}");
}

/// A torso, a head, and two arms with limits, over a floor.
fn ragdoll(simulator: &mut PhysicsSimulator, at: Vector2, group: i32) -> Vec<JointId> {
    let mut part = |size, offset| {
        let (body, geom) = add_box(simulator, size, at + offset);
        simulator[geom].set_collision_group(group);
        simulator[geom].set_friction_coefficient(0.5);
        body
    };
    let torso = part((16.0, 30.0), v(0.0, 0.0));
    let limbs = [
        (part((12.0, 12.0), v(0.0, -22.0)), v(0.0, -15.0)),
        (part((24.0, 6.0), v(-20.0, -10.0)), v(-8.0, -10.0)),
        (part((24.0, 6.0), v(20.0, -10.0)), v(8.0, -10.0)),
        (part((6.0, 24.0), v(-5.0, 27.0)), v(-5.0, 15.0)),
        (part((6.0, 24.0), v(5.0, 27.0)), v(5.0, 15.0)),
    ];
    let mut joints = Vec::new();
    for (limb, anchor) in limbs {
        let joint = JointFactory::create_revolute_joint(simulator, torso, limb, at + anchor);
        joints.push(joined(simulator, joint));
        let limit = JointFactory::create_angle_limit_joint(simulator, torso, limb, -0.8, 0.8);
        joined(simulator, limit);
    }
    joints
}

fn ragdolls() -> (PhysicsSimulator, Vec<JointId>) {
    let mut simulator = precise(GRAVITY);
    add_floor(&mut simulator, (600.0, 20.0), v(0.0, 10.0));
    let mut joints = ragdoll(&mut simulator, v(0.0, -60.0), 1);
    joints.extend(ragdoll(&mut simulator, v(14.0, -150.0), 2));
    (simulator, joints)
}

#[test]
fn ragdolls_that_fall_on_each_other_come_to_rest_in_one_piece() {
    let (mut simulator, joints) = ragdolls();
    let mut worst: f32 = 0.0;
    for _ in 0..900 {
        simulator.update(DT);
        worst = joints.iter().map(|&joint| simulator[joint].joint_error()).fold(worst, f32::max);
    }
    // Measured: 0.53 to 0.9, where one falls on the other, as roundings have it.
    assert!(worst < 1.2, "{worst} px");
    let speed = |&body: &BodyId| simulator[body].linear_velocity().norm();
    let fastest = simulator.body_list().iter().map(speed).fold(0.0, f32::max);
    assert!(fastest < 1.0, "{fastest} px/s");
    let lowest = simulator.body_list().iter().map(|&body| simulator[body].position().y);
    assert!(lowest.skip(1).all(|y| y < 0.0));
}

#[test]
fn ragdolls_go_on_with_the_same_bits_after_a_restore_in_every_step() {
    let ((mut plain, _), (mut restored, _)) = (ragdolls(), ragdolls());
    for step in 0..300 {
        plain.update(DT);
        restored.update(DT);
        assert!(plain.snapshot() == restored.snapshot(), "step {step}");
        let mut next = simulator(1.0);
        next.restore(&restored.snapshot()).unwrap();
        restored = next;
    }
}

#[test]
fn overflowing_joint_forces_go_on_with_the_same_bits_after_a_restore() {
    let heavy = || {
        let mut simulator = precise(GRAVITY);
        let (bodies, joints) = chain(&mut simulator, 2);
        for &body in &bodies {
            simulator[body].set_mass(1e37).unwrap();
            simulator[body].set_moment_of_inertia(1e38).unwrap();
        }
        (simulator, joints)
    };
    let ((mut plain, joints), (mut restored, _)) = (heavy(), heavy());
    for step in 0..60 {
        plain.update(DT);
        restored.update(DT);
        assert!(plain.snapshot() == restored.snapshot(), "step {step}");
        let mut next = simulator(1.0);
        next.restore(&restored.snapshot()).unwrap();
        restored = next;
    }
    // It is not a number, so it is not reported.
    assert_eq!(plain[joints[0]].force().y, 0.0);
}

/// Joints at random between boxes at random: more than can be obeyed.
fn contradictions(seed: u64) -> PhysicsSimulator {
    let mut random = Random::new(seed);
    let mut simulator = precise(GRAVITY);
    let point = |random: &mut Random| v(random.between(-100.0, 100.0), random.between(-100.0, 100.0));
    let bodies: Vec<BodyId> = (0..7)
        .map(|_| {
            let at = point(&mut random);
            let body = ghost(&mut simulator, (20.0, 10.0), at);
            simulator[body].set_rotation(random.between(0.0, 6.0));
            body
        })
        .collect();
    for _ in 0..16 {
        let s = &mut simulator;
        let (a, b, p) = (random.pick(&bodies), random.pick(&bodies), point(&mut random));
        let (q, low) = (v(random.between(-30.0, 30.0), 5.0), random.between(-1.0, 0.5));
        let joint = match random.below(6) {
            _ if a == b => JointFactory::create_fixed_revolute_joint(s, a, p),
            0 => JointFactory::create_revolute_joint(s, a, b, p),
            1 => JointFactory::create_slider_joint(s, a, q, b, q, 10.0, 20.0),
            2 => JointFactory::create_angle_joint(s, a, b),
            3 => JointFactory::create_fixed_angle_limit_joint(s, a, low, low + 0.3),
            4 => JointFactory::create_pin_joint(s, a, q, b, q),
            _ => JointFactory::create_weld_joint(s, a, b, p),
        };
        joined(s, joint);
    }
    simulator
}

#[test]
fn contradictory_joints_keep_all_numbers_finite() {
    for seed in 0..100 {
        let mut simulator = contradictions(seed);
        for step in 0..60 {
            simulator.update(DT);
            assert!(not_finite(&simulator).is_empty(), "seed {seed} step {step}");
        }
    }
}

#[test]
fn joints_without_bodies_are_refused_and_removed_bodies_remove_their_joints() {
    let mut simulator = precise(GRAVITY);
    let empty = simulator.create_empty_joint::<RevoluteJoint>();
    assert!(simulator.add(empty).is_err());
    let (bodies, joints) = chain(&mut simulator, 5);
    run(&mut simulator, 5);
    simulator.dispose(bodies[2]).unwrap();
    run(&mut simulator, 5);
    assert_eq!(simulator.joint_list(), [joints[0], joints[1], joints[4]]);
    let before = simulator[bodies[4]].position().y;
    run(&mut simulator, 30);
    assert!(simulator[bodies[4]].position().y > before + 20.0);
}

#[test]
fn a_push_against_a_joint_loses_its_energy() {
    // A body with locked rotation that falls with a spin of 5: the joint removes the spin alone, for any other motion of the
    // body.
    for spin in [0.5, 5.0, 50.0] {
        let mut simulator = precise(GRAVITY);
        let body = ghost(&mut simulator, (20.0, 20.0), v(0.0, 0.0));
        let joint = JointFactory::create_fixed_angle_joint(&mut simulator, body);
        joined(&mut simulator, joint);
        simulator[body].set_linear_velocity(v(30.0, 0.0));
        simulator[body].set_angular_velocity(spin);
        run(&mut simulator, 60);
        assert_abs_diff_eq!(simulator[body].linear_velocity().x, 30.0, epsilon = 1e-3);
        assert_abs_diff_eq!(simulator[body].linear_velocity().y, GRAVITY, epsilon = 1e-2);
    }
}

#[test]
fn a_pendulum_on_an_oscillating_post_swings() {
    let mut simulator = precise(GRAVITY);
    let post = BodyFactory::create_body_in(&mut simulator, 1.0, 1.0).unwrap();
    simulator[post].set_is_static(true);
    let bob = ghost(&mut simulator, (4.0, 4.0), v(0.0, 32.0));
    simulator[bob].set_moment_of_inertia(1.0).unwrap();
    let joint = JointFactory::create_revolute_joint(&mut simulator, post, bob, v(0.0, 0.0));
    joined(&mut simulator, joint);
    // At its own frequency, sqrt(g / l) = 3.16 radians/s: forced by a motion of amplitude a its angle grows by a / (2 l) per
    // radian. Measured: 0.84 of that, as the greatest angle lags behind the growth by up to half a period.
    let mut swing = 0.0_f32;
    for step in 0..240 {
        let phase = (GRAVITY / 32.0).sqrt() * step as f32 * DT;
        simulator[post].set_position(v(2.0 * phase.sin(), 0.0));
        simulator.update(DT);
        let [x, y] = [simulator[bob].position().x - 2.0 * phase.sin(), simulator[bob].position().y];
        swing = swing.max(x.atan2(y).abs());
    }
    let expected = 2.0 / 64.0 * (GRAVITY / 32.0).sqrt() * 240.0 * DT;
    assert!(swing > 0.7 * expected, "{swing} of {expected}");
}
