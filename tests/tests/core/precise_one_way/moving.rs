//! One-way geoms on kinematic bodies.

use super::*;

/// A stage whose platform has this velocity from the start.
fn lift(velocity: Vector2, spin: f32) -> (PhysicsSimulator, BodyId) {
    let (mut simulator, platform, _) = stage();
    simulator[platform].set_is_static(false);
    simulator[platform].set_is_kinematic(true);
    simulator[platform].set_linear_velocity(velocity);
    simulator[platform].set_angular_velocity(spin);
    (simulator, platform)
}

#[test]
fn a_one_way_lift_carries_its_load_up_and_down() {
    for (name, add, height) in THINGS {
        for rate in RATES {
            let (mut simulator, platform) = lift(v(0.0, 0.0), 0.0);
            let (rider, _) = add(&mut simulator, v(0.0, -HALF - height));
            run_for(&mut simulator, 0.2, rate);
            for (speed, top) in [(-60.0, 70.0), (60.0, 10.0), (-120.0, 130.0), (120.0, 10.0)] {
                simulator[platform].set_linear_velocity(v(0.0, speed));
                run_for(&mut simulator, 1.0, rate);
                let y = simulator[rider].position().y;
                assert_near(y, -top - height, 1.0, &format!("{name} at {speed} px/s, {rate} Hz"));
            }
        }
    }
}

#[test]
fn one_with_targets_carries_its_load() {
    for rate in RATES {
        let (mut simulator, platform) = lift(v(0.0, 0.0), 0.0);
        let (rider, _) = add_box(&mut simulator, (20.0, 20.0), v(0.0, -20.0));
        simulator[rider].set_angular_velocity(0.0);
        run_for(&mut simulator, 0.2, rate);
        for step in 0..(2.0 * rate) as usize {
            let time = step as f32 / rate;
            simulator[platform].move_to(v(0.0, -40.0 * (3.0 * time).sin()), 0.0).unwrap();
            simulator.update(1.0 / rate);
            let apart = simulator[platform].position().y - simulator[rider].position().y;
            assert_near(apart, 20.0, 0.5, "the rider above the middle");
        }
    }
}

#[test]
fn a_rising_one_lifts_bodies_above_it_and_passes_bodies_in_it() {
    for rate in RATES {
        for speed in [30.0, 120.0, 300.0] {
            let (mut simulator, _) = lift(v(0.0, -speed), 0.0);
            simulator.set_gravity(v(0.0, 0.0)).unwrap();
            let (above, _) = add_box(&mut simulator, (20.0, 20.0), v(-50.0, -25.0));
            let (inside, _) = add_box(&mut simulator, (20.0, 20.0), v(50.0, -18.0));
            run_for(&mut simulator, 1.0, rate);
            let lifted = simulator[above].position().y;
            assert!(lifted <= -speed - 20.0 + 0.5, "{rate} Hz, {speed} px/s: {lifted}");
            assert_near(simulator[inside].position().y, -18.0, 0.0, "what was in it");
        }
    }
}

#[test]
fn a_sinking_one_passes_over_bodies_below_and_does_not_wake_them() {
    for rate in RATES {
        let (mut simulator, platform) = lift(v(0.0, 0.0), 0.0);
        add_floor(&mut simulator, (400.0, 20.0), v(0.0, 110.0));
        let (below, _) = add_box(&mut simulator, (20.0, 20.0), v(0.0, 90.0));
        run_for(&mut simulator, 2.0, rate);
        assert!(simulator.is_asleep(below));
        let before = body_bits(&simulator[below]);
        simulator[platform].set_linear_velocity(v(0.0, 100.0));
        run_for(&mut simulator, 2.0, rate);
        assert!(simulator.is_asleep(below), "{rate} Hz");
        assert_eq!(body_bits(&simulator[below]), before);
    }
}

#[test]
fn a_rising_one_wakes_and_lifts_bodies_asleep_on_another_support() {
    for rate in RATES {
        let (mut simulator, platform) = lift(v(0.0, 0.0), 0.0);
        // A plank on two posts, one on each side of the lift.
        for x in [-150.0, 150.0] {
            add_floor(&mut simulator, (20.0, 20.0), v(x, -50.0));
        }
        let (plank, _) = add_box(&mut simulator, (320.0, 10.0), v(0.0, -65.0));
        run_for(&mut simulator, 2.0, rate);
        assert!(simulator.is_asleep(plank), "{rate} Hz");
        simulator[platform].set_linear_velocity(v(0.0, -100.0));
        run_for(&mut simulator, 1.0, rate);
        assert_near(simulator[plank].position().y, -115.0, 0.5, &format!("the plank at {rate} Hz"));
    }
}

/// A bar of 200 x 20 px about its middle that turns in a world without gravity, and a ball at rest in its path.
fn turning(spin: f32, at: Vector2) -> (PhysicsSimulator, BodyId) {
    let (mut simulator, _) = lift(v(0.0, 0.0), spin);
    simulator.set_gravity(v(0.0, 0.0)).unwrap();
    let (ball, _) = add_circle(&mut simulator, 10.0, 12, at);
    (simulator, ball)
}

#[test]
fn a_turning_one_strikes_with_its_closed_side_and_passes_with_the_others() {
    for rate in RATES {
        for spin in [1.0, -1.0, 6.0, -6.0f32] {
            // It turns clockwise on the screen: its right half comes down with its back, and its left half up with its face.
            let (mut simulator, struck) = turning(spin, v(-70.0 * spin.signum(), -40.0));
            run_for(&mut simulator, 1.5 / spin.abs(), rate);
            let speed = simulator[struck].linear_velocity().norm();
            assert!(speed > 20.0 * spin.abs(), "{rate} Hz, {spin} rad/s: {speed}");
            let (mut simulator, passed) = turning(spin, v(70.0 * spin.signum(), 40.0));
            for _ in 0..(1.5 / spin.abs() * rate) as usize {
                simulator.update(1.0 / rate);
                assert_eq!(simulator.arbiter_count(), 0);
            }
            assert_eq!(
                simulator[passed].position(),
                v(70.0 * spin.signum(), 40.0),
                "{rate} Hz, {spin} rad/s"
            );
        }
    }
}

#[test]
fn a_body_that_jumps_through_a_moving_one_lands_on_it() {
    for rate in RATES {
        for velocity in [v(0.0, -40.0), v(0.0, 40.0), v(60.0, 0.0), v(-60.0, -30.0)] {
            let (mut simulator, platform) = lift(velocity, 0.0);
            let (ball, geom) = add_circle(&mut simulator, 10.0, 12, v(0.0, 60.0));
            simulator[geom].set_friction_coefficient(1.0);
            simulator[ball].set_linear_velocity(v(velocity.x, velocity.y - 500.0));
            run_for(&mut simulator, 2.0, rate);
            let apart = simulator[platform].position().y - simulator[ball].position().y;
            assert_near(apart, 20.0, 0.5, &format!("{velocity} at {rate} Hz"));
        }
    }
}
