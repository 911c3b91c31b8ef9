//! Bodies that the game moves and no contact moves.

use approx::assert_abs_diff_eq;
use conformance::fixtures::plane::{add_box, add_circle, add_floor, simulator, v};
use farseer_core::{Body, BodyId, Error, Event, GeomId, Methods, PhysicsSimulator};

const DT: f32 = 1.0 / 60.0;
const GRAVITY: f32 = 320.0;

fn with(methods: Methods) -> PhysicsSimulator {
    let mut simulator = simulator(GRAVITY);
    simulator.set_methods(methods).unwrap();
    simulator.set_iterations(4);
    simulator
}

fn precise() -> PhysicsSimulator {
    with(Methods::PRECISE)
}

/// An empty simulator with each set.
fn both() -> [PhysicsSimulator; 2] {
    [with(Methods::default()), precise()]
}

fn add_kinematic(simulator: &mut PhysicsSimulator, size: (f32, f32), x: f32, y: f32) -> (BodyId, GeomId) {
    let (body, geom) = add_box(simulator, size, v(x, y));
    simulator[body].set_is_kinematic(true);
    set_surface(simulator, geom, 0.5, 0.0);
    (body, geom)
}

/// A crate of 32 px that no drag slows.
fn add_crate(simulator: &mut PhysicsSimulator, x: f32, y: f32) -> BodyId {
    let (body, geom) = add_box(simulator, (32.0, 32.0), v(x, y));
    simulator[body].set_linear_drag_coefficient(0.0);
    simulator[body].set_rotational_drag_coefficient(0.0);
    set_surface(simulator, geom, 0.5, 0.0);
    body
}

fn set_surface(simulator: &mut PhysicsSimulator, geom: GeomId, friction: f32, restitution: f32) {
    simulator[geom].set_friction_coefficient(friction);
    simulator[geom].set_restitution_coefficient(restitution);
}

fn run(simulator: &mut PhysicsSimulator, steps: usize) {
    (0..steps).for_each(|_| simulator.update(DT));
}

#[test]
fn forces_and_contacts_do_not_change_the_velocity_of_a_kinematic_body() {
    for mut simulator in both() {
        let (body, _) = add_kinematic(&mut simulator, (100.0, 10.0), 0.0, 0.0);
        add_crate(&mut simulator, 0.0, -50.0);
        simulator[body].set_linear_drag_coefficient(5.0);
        simulator[body].set_linear_velocity(v(30.0, -12.0));
        simulator[body].set_angular_velocity(0.25);
        for _ in 0..60 {
            simulator[body].apply_force(v(1e6, 1e6));
            simulator[body].apply_torque(1e6);
            simulator[body].apply_impulse(v(1e6, 1e6));
            simulator.update(DT);
            assert_eq!(simulator[body].linear_velocity(), v(30.0, -12.0));
            assert_eq!(simulator[body].angular_velocity(), 0.25);
        }
        // 60 roundings of numbers below 32.
        assert_abs_diff_eq!(simulator[body].position(), v(30.0, -12.0), epsilon = 1e-4);
        assert_abs_diff_eq!(simulator[body].rotation(), 0.25, epsilon = 1e-5);
    }
}

#[test]
fn a_kinematic_body_is_at_its_target_after_the_next_update_to_the_last_bit_and_stays() {
    for mut simulator in both() {
        let (body, _) = add_kinematic(&mut simulator, (10.0, 10.0), 0.3, 0.7);
        for (x, y, rotation) in [(10.1, -3.3, 0.1), (1234.567, 9.9, 3.0), (0.1, 0.1, 6.25), (-7.7, 1e5, 0.05)]
        {
            simulator[body].move_to(v(x, y), rotation).unwrap();
            simulator.update(DT);
            assert_eq!((simulator[body].position(), simulator[body].rotation()), (v(x, y), rotation));
            assert!(simulator[body].linear_velocity() != v(0.0, 0.0));
        }
        run(&mut simulator, 2);
        assert_eq!((simulator[body].position(), simulator[body].rotation()), (v(-7.7, 1e5), 0.05));
        assert_eq!(
            (simulator[body].linear_velocity(), simulator[body].angular_velocity()),
            (v(0.0, 0.0), 0.0)
        );
    }
}

#[test]
fn a_kinematic_body_turns_the_shorter_way_to_its_target_and_counts_its_turns() {
    for mut simulator in both() {
        let (body, _) = add_kinematic(&mut simulator, (10.0, 10.0), 0.0, 0.0);
        simulator.update(DT);
        for (rotation, turned) in [(6.2, -0.083_185_3), (0.1, 0.1), (6.2, -0.083_185_3), (3.2, -3.083_185_3)]
        {
            simulator[body].move_to(v(0.0, 0.0), rotation).unwrap();
            simulator.update(DT);
            assert_eq!(simulator[body].rotation(), rotation);
            assert_abs_diff_eq!(simulator[body].total_rotation(), turned, epsilon = 1e-6);
        }
    }
}

#[test]
fn a_velocity_that_is_set_counts_more_than_a_target() {
    for mut simulator in both() {
        let (body, _) = add_kinematic(&mut simulator, (10.0, 10.0), 0.0, 0.0);
        simulator.update(DT);
        simulator[body].move_to(v(100.0, 0.0), 0.0).unwrap();
        simulator[body].set_linear_velocity(v(0.0, 60.0));
        simulator.update(DT);
        assert_abs_diff_eq!(simulator[body].position(), v(0.0, 1.0), epsilon = 1e-6);
    }
}

#[test]
fn only_kinematic_bodies_have_targets_and_only_finite_ones() {
    let mut body = Body::new();
    let expected = Error::WrongKind { argument: "body", expected: "kinematic body" };
    assert_eq!(body.move_to(v(0.0, 0.0), 0.0), Err(expected));
    body.set_is_kinematic(true);
    assert!(body.move_to(v(f32::NAN, 0.0), 0.0).unwrap_err().to_string().starts_with("position is"));
    assert!(body.move_to(v(0.0, 0.0), f32::INFINITY).unwrap_err().to_string().starts_with("rotation is"));
}

#[test]
fn an_overflowing_target_disables_the_body_at_its_old_pose() {
    for mut simulator in both() {
        let (body, _) = add_kinematic(&mut simulator, (10.0, 10.0), 3.0, 4.0);
        simulator.update(DT);
        simulator[body].move_to(v(f32::MAX, 0.0), 0.0).unwrap();
        simulator.update(DT);
        assert!(simulator.events().contains(&Event::NotFinite { body, disabled: true }));
        assert_eq!((simulator[body].position(), simulator[body].enabled()), (v(3.0, 4.0), false));
    }
}

#[test]
fn a_body_is_one_of_static_and_kinematic_and_dynamic() {
    let mut body = Body::new();
    body.set_is_kinematic(true);
    assert_eq!((body.is_kinematic(), body.is_static(), body.inverse_mass()), (true, false, 0.0));
    body.set_is_static(false);
    body.set_mass(2.0).unwrap();
    assert_eq!((body.is_kinematic(), body.inverse_mass()), (true, 0.0));
    body.set_is_static(true);
    assert_eq!((body.is_kinematic(), body.is_static()), (false, true));
    body.set_is_kinematic(true);
    assert_eq!((body.is_kinematic(), body.is_static()), (true, false));
    body.set_is_kinematic(false);
    assert_eq!((body.is_kinematic(), body.is_static(), body.inverse_mass()), (false, false, 0.5));
}

#[test]
fn a_body_that_claims_to_be_static_and_kinematic_is_not_loaded() {
    let mut body = Body::new();
    body.set_is_kinematic(true);
    let saved = serde_json::to_string(&body).unwrap();
    assert!(serde_json::from_str::<Body>(&saved).unwrap().is_kinematic());
    let altered = saved.replace("\"is_static\":false", "\"is_static\":true");
    assert!(altered != saved && serde_json::from_str::<Body>(&altered).is_err());
}

#[test]
fn kinematic_bodies_pass_through_static_and_kinematic_ones() {
    for mut simulator in both() {
        add_floor(&mut simulator, (20.0, 20.0), v(50.0, 0.0));
        add_kinematic(&mut simulator, (20.0, 20.0), 100.0, 0.0);
        let (body, _) = add_kinematic(&mut simulator, (20.0, 20.0), 0.0, 0.0);
        simulator[body].set_linear_velocity(v(150.0, 0.0));
        for _ in 0..60 {
            simulator.update(DT);
            assert_eq!(simulator.arbiter_count(), 0);
        }
        assert_abs_diff_eq!(simulator[body].position().x, 150.0, epsilon = 1e-3);
    }
}

/// How far the crate on a lift is above it, at most and at least, while the lift moves.
fn ride(simulator: &mut PhysicsSimulator, speed: f32) -> (f32, f32) {
    let (lift, _) = add_kinematic(simulator, (100.0, 10.0), 0.0, 5.0);
    let rider = add_crate(simulator, 0.0, -16.0);
    run(simulator, 60);
    let gap = |simulator: &PhysicsSimulator| {
        simulator[lift].position().y - 5.0 - (simulator[rider].position().y + 16.0)
    };
    let (mut least, mut most) = (f32::MAX, f32::MIN);
    // No faster down than gravity lets the crate follow: 160 px/s² is half of it.
    let mut now = 0.0_f32;
    for _ in 0..240 {
        now = if speed > 0.0 { (now + 160.0 * DT).min(speed) } else { speed };
        simulator[lift].set_linear_velocity(v(0.0, now));
        simulator.update(DT);
        (least, most) = (least.min(gap(simulator)), most.max(gap(simulator)));
    }
    assert_abs_diff_eq!(simulator[rider].linear_velocity().y, speed, epsilon = 0.05);
    (least, most)
}

#[test]
fn a_crate_stands_on_a_lift_without_gap_or_overlap() {
    for speed in [60.0, 300.0, -60.0, -300.0] {
        let (least, most) = ride(&mut precise(), speed);
        // Measured: overlaps of 0.071 px in the step in which it starts upward at 300 px/s, and 0.018 px at 60; gaps of
        // 0.011 px.
        assert!(least > -0.1 && most < 0.02, "{speed}: {least} to {most}");
    }
}

#[test]
fn a_lift_of_the_faithful_set_carries_a_crate() {
    for speed in [60.0, -60.0] {
        let (least, most) = ride(&mut with(Methods::default()), speed);
        // The overlap of 0.05 px that it leaves alone.
        assert!(least > -0.06 && most < 0.0, "{speed}: {least} to {most}");
    }
}

#[test]
fn a_platform_carries_a_crate_by_friction() {
    let mut simulator = precise();
    let (platform, _) = add_kinematic(&mut simulator, (400.0, 10.0), 0.0, 5.0);
    let rider = add_crate(&mut simulator, 0.0, -16.0);
    run(&mut simulator, 30);
    simulator[platform].set_linear_velocity(v(60.0, 0.0));
    run(&mut simulator, 120);
    assert_abs_diff_eq!(simulator[rider].linear_velocity().x, 60.0, epsilon = 0.01);
    // It slips until friction has made it as fast: v^2 / (2 mu g), give or take half a step of 1 px.
    let slip = simulator[platform].position().x - simulator[rider].position().x;
    assert_abs_diff_eq!(slip, 60.0 * 60.0 / (2.0 * 0.5 * GRAVITY), epsilon = 0.5);
}

#[test]
fn a_turning_platform_carries_its_load() {
    let mut simulator = precise();
    let (platform, _) = add_kinematic(&mut simulator, (400.0, 10.0), 0.0, 0.0);
    let rider = add_crate(&mut simulator, 100.0, -21.0);
    run(&mut simulator, 60);
    let seen =
        |simulator: &PhysicsSimulator| simulator[platform].get_local_position(simulator[rider].position());
    let before = seen(&simulator);
    // Slowly enough for gravity to keep the crate on it.
    for step in 0..60 {
        simulator[platform].set_angular_velocity(0.2 * (step as f32 / 30.0).min(1.0));
        simulator.update(DT);
    }
    // Measured: 0.03 px along it. The slope stays below the friction of 0.5.
    assert_abs_diff_eq!(seen(&simulator), before, epsilon = 0.1);
    let turned = simulator[platform].rotation();
    assert_abs_diff_eq!(turned, 0.149, epsilon = 0.005);
    assert_abs_diff_eq!(simulator[rider].rotation(), turned, epsilon = 0.001);
}

#[test]
fn a_piston_pushes_a_crate_as_fast_as_it_moves() {
    for speed in [60.0, 300.0] {
        let mut simulator = precise();
        let (_, floor) = add_floor(&mut simulator, (4000.0, 20.0), v(0.0, 10.0));
        set_surface(&mut simulator, floor, 0.5, 0.0);
        let (piston, _) = add_kinematic(&mut simulator, (10.0, 40.0), 0.0, -21.0);
        let pushed = add_crate(&mut simulator, 40.0, -16.0);
        simulator[piston].set_linear_velocity(v(speed, 0.0));
        run(&mut simulator, 180);
        assert_abs_diff_eq!(simulator[pushed].linear_velocity(), v(speed, 0.0), epsilon = 0.001);
        let gap = simulator[pushed].position().x - simulator[piston].position().x - 21.0;
        assert_abs_diff_eq!(gap, 0.0, epsilon = 0.1);
    }
}

#[test]
fn a_ball_leaves_a_moving_wall_with_twice_its_speed_more() {
    for (wall_speed, ball_speed) in [(60.0, -100.0), (200.0, 0.0), (-50.0, -150.0)] {
        let mut simulator = precise();
        simulator.set_gravity(v(0.0, 0.0)).unwrap();
        let (wall, geom) = add_kinematic(&mut simulator, (20.0, 400.0), 0.0, 0.0);
        set_surface(&mut simulator, geom, 0.0, 1.0);
        let (ball, round) = add_circle(&mut simulator, 10.0, 16, v(60.0, 0.0));
        set_surface(&mut simulator, round, 0.0, 1.0);
        simulator[ball].set_linear_drag_coefficient(0.0);
        simulator[wall].set_linear_velocity(v(wall_speed, 0.0));
        simulator[ball].set_linear_velocity(v(ball_speed, 0.0));
        run(&mut simulator, 60);
        let expected = 2.0 * wall_speed - ball_speed;
        assert_abs_diff_eq!(simulator[ball].linear_velocity().x, expected, epsilon = 1e-3);
        // They are 40 px apart until they meet, and the ball leaves from where they do.
        let met = 40.0 / (wall_speed - ball_speed);
        let expected = 60.0 + ball_speed * met + expected * (1.0 - met);
        assert_abs_diff_eq!(simulator[ball].position().x, expected, epsilon = 0.01);
        assert_eq!(simulator[wall].linear_velocity(), v(wall_speed, 0.0));
    }
}

#[test]
fn a_ball_leaves_a_bat_that_turns_with_twice_the_speed_of_where_it_was_hit_more() {
    for out in [-60.0, -30.0, 0.0, 30.0, 60.0] {
        let mut simulator = with(Methods::PRECISE);
        simulator.set_gravity(v(0.0, 0.0)).unwrap();
        let (bat, of_bat) = add_kinematic(&mut simulator, (200.0, 10.0), 0.0, 0.0);
        let (ball, of_ball) = add_circle(&mut simulator, 6.0, 16, v(out, -100.0));
        set_surface(&mut simulator, of_bat, 0.0, 1.0);
        set_surface(&mut simulator, of_ball, 0.0, 1.0);
        simulator[ball].set_linear_drag_coefficient(0.0);
        simulator[ball].set_linear_velocity(v(0.0, 200.0));
        // It arrives after 0.45 s: then the bat is level.
        simulator[bat].set_rotation(0.45);
        simulator[bat].set_angular_velocity(-1.0);
        while simulator[ball].linear_velocity().y > 0.0 {
            simulator.update(DT);
        }
        // In the step of the bounce the bat has turned by a sixtieth.
        assert_abs_diff_eq!(-simulator[ball].linear_velocity().y, 200.0 + 2.0 * out, epsilon = 2.0);
    }
}

/// A raft 200 crates long that carries them to the right.
fn raft(simulator: &mut PhysicsSimulator) -> (BodyId, Vec<BodyId>) {
    let (raft, _) = add_kinematic(simulator, (7000.0, 20.0), 0.0, 10.0);
    let crates = (0..200).map(|i| add_crate(simulator, (i as f32 - 99.5) * 34.0, -16.0)).collect();
    simulator[raft].set_linear_velocity(v(30.0, -20.0));
    (raft, crates)
}

#[test]
fn a_raft_carries_two_hundred_crates() {
    let mut simulator = precise();
    let (raft, crates) = raft(&mut simulator);
    run(&mut simulator, 300);
    let deck = simulator[raft].position().y - 10.0;
    let (mut least, mut most) = (f32::MAX, f32::MIN);
    for &body in &crates {
        let gap = deck - (simulator[body].position().y + 16.0);
        (least, most) = (least.min(gap), most.max(gap));
        assert_abs_diff_eq!(simulator[body].linear_velocity(), v(30.0, -20.0), epsilon = 0.02);
    }
    // Measured: 0.0022 px of overlap.
    assert!(least > -0.005 && most < 0.0, "{least} to {most}");
}

#[test]
fn a_raft_goes_on_with_the_same_bits_after_a_restore_in_every_step() {
    let (mut plain, mut restored) = (precise(), precise());
    let rafts = [&mut plain, &mut restored].map(raft);
    for step in 0..120 {
        for (simulator, (raft, crates)) in [&mut plain, &mut restored].into_iter().zip(&rafts) {
            match step {
                20 => simulator[*raft].move_to(v(77.7, 3.3), 0.01).unwrap(),
                40 => simulator[*raft].set_linear_velocity(v(-60.0, 20.0)),
                60 => simulator[crates[7]].set_is_kinematic(true),
                70 => simulator[crates[9]].set_is_static(true),
                80 => simulator[crates[7]].set_is_kinematic(false),
                90 => simulator[*raft].set_is_static(true),
                100 => simulator[*raft].set_is_kinematic(true),
                _ => {}
            }
            simulator.update(DT);
        }
        assert_eq!(plain.events(), restored.events(), "step {step}");
        assert!(plain.snapshot() == restored.snapshot(), "step {step}");
        let mut next = simulator(1.0);
        next.restore(&restored.snapshot()).unwrap();
        restored = next;
    }
}

#[test]
fn a_body_becomes_kinematic_and_static_and_dynamic_between_updates() {
    for mut simulator in both() {
        let body = add_crate(&mut simulator, 0.0, 0.0);
        run(&mut simulator, 30);
        let falling = simulator[body].linear_velocity();
        assert!(falling.y > 100.0);
        simulator[body].set_is_kinematic(true);
        run(&mut simulator, 30);
        assert_eq!(simulator[body].linear_velocity(), falling);
        let place = simulator[body].position();
        simulator[body].set_is_static(true);
        run(&mut simulator, 30);
        assert_eq!(simulator[body].position(), place);
        simulator[body].set_is_static(false);
        run(&mut simulator, 30);
        assert_abs_diff_eq!(simulator[body].linear_velocity().y, falling.y + 0.5 * GRAVITY, epsilon = 0.01);
    }
}

#[test]
fn a_crate_falls_once_its_shelf_is_dynamic() {
    let mut simulator = precise();
    let (shelf, _) = add_kinematic(&mut simulator, (100.0, 10.0), 0.0, 5.0);
    let body = add_crate(&mut simulator, 0.0, -16.0);
    run(&mut simulator, 60);
    assert_abs_diff_eq!(simulator[body].position().y, -16.0, epsilon = 0.05);
    simulator[shelf].set_is_kinematic(false);
    run(&mut simulator, 30);
    assert!(simulator[shelf].position().y > 20.0 && simulator[body].position().y > 0.0);
}
