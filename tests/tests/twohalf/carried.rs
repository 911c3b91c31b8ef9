//! Kinematic platforms carry the bodies on them, and belts do so without moving.
//!
//! Friction 0.5 under gravity 100 px/s² gives 50 px/s². A body that starts from rest on a platform with velocity v slides until
//! it has that velocity, after v / (mu g), and lags v² / (2 mu g) behind by then. A step counts as a whole, which is up to v dt
//! of that distance.

use conformance::fixtures::depth::{
    GRAVITY, assert_near, assert_near3, place, platform, set_platform_surface, set_surface, simulator, solid,
    throw, velocity, with_scheme,
};
use twohalf::{BodyId, DepthScheme, PlatformId, TwoHalfPhysicsSimulator, Vector3};

const RATES: [f32; 4] = [30.0, 60.0, 120.0, 240.0];
const FRICTION: f32 = 0.5;
/// 50 px/s along the floor.
const ALONG: [f32; 3] = [30.0, 0.0, 40.0];
/// Duration in s for which a carried body slides at this speed, and the distance that it lags behind.
const SLIDE: f32 = 50.0 / (FRICTION * GRAVITY);
const LAG: f32 = 50.0 * 50.0 / (2.0 * FRICTION * GRAVITY);
/// Rounding in px of coordinates up to 1000.
const ROUNDING: f32 = 2e-3;

fn precise(test: impl FnOnce()) {
    with_scheme(DepthScheme::Precise, test);
}

/// A floor whose top is at 20 px, and a box at rest on it.
fn loaded_floor() -> (TwoHalfPhysicsSimulator, BodyId, BodyId) {
    let mut simulator = simulator();
    let floor = solid(&mut simulator, [400.0, 20.0, 400.0], [0.0, 0.0, 0.0]);
    let load = solid(&mut simulator, [20.0, 20.0, 20.0], [-50.0, 20.0, -50.0]);
    [floor, load].iter().for_each(|&body| set_surface(&mut simulator, body, FRICTION, 0.0));
    (simulator, floor, load)
}

fn kinematic_floor() -> (TwoHalfPhysicsSimulator, BodyId, BodyId) {
    let (mut simulator, floor, load) = loaded_floor();
    simulator.body_mut(floor).unwrap().set_is_kinematic(true);
    (simulator, floor, load)
}

fn run_for(simulator: &mut TwoHalfPhysicsSimulator, seconds: f32, rate: f32) {
    (0..(seconds * rate).round() as usize).for_each(|_| simulator.update(1.0 / rate));
}

fn apart(simulator: &TwoHalfPhysicsSimulator, floor: BodyId, load: BodyId) -> Vector3 {
    place(simulator, load) - place(simulator, floor)
}

#[test]
fn a_body_on_a_kinematic_body_is_carried_in_all_axes_and_lags_by_its_friction() {
    precise(|| {
        for rate in RATES {
            let (mut simulator, floor, load) = kinematic_floor();
            run_for(&mut simulator, 0.2, rate);
            let before = apart(&simulator, floor, load);
            simulator.body_mut(floor).unwrap().set_velocity3d(ALONG.into());
            run_for(&mut simulator, SLIDE + 0.5, rate);
            assert_near3(velocity(&simulator, load), ALONG, 0.05);
            let way = Vector3::from(ALONG) * -(LAG / 50.0);
            let lag = apart(&simulator, floor, load) - before;
            assert!((lag - way).norm() <= 50.0 / rate, "{rate} Hz: {lag:?}");
        }
    });
}

#[test]
fn a_carried_body_does_not_drift() {
    precise(|| {
        for rate in RATES {
            let (mut simulator, floor, load) = kinematic_floor();
            simulator.body_mut(floor).unwrap().set_velocity3d(ALONG.into());
            throw(&mut simulator, load, ALONG);
            run_for(&mut simulator, 0.2, rate);
            let before = apart(&simulator, floor, load);
            run_for(&mut simulator, 5.0, rate);
            assert_near3(apart(&simulator, floor, load), before.into(), 0.02);
        }
    });
}

#[test]
fn a_kinematic_body_moves_in_three_axes_by_its_velocity_times_the_time() {
    precise(|| {
        let (mut simulator, floor, _) = kinematic_floor();
        simulator.body_mut(floor).unwrap().set_velocity3d(Vector3::new(10.0, 20.0, -30.0));
        run_for(&mut simulator, 2.0, 60.0);
        assert_near3(place(&simulator, floor), [20.0, 40.0, -60.0], ROUNDING);
    });
}

#[test]
fn a_lift_that_goes_down_keeps_its_passengers_grounded_in_all_steps() {
    precise(|| {
        for (speed, rate) in [60.0, 300.0].into_iter().flat_map(|speed| RATES.map(|rate| (speed, rate))) {
            let (mut simulator, lift, load) = kinematic_floor();
            let velocity = [0.0, -speed, 0.0];
            for (body, y) in [(lift, 1000.0), (load, 1020.0)] {
                simulator.body_mut(body).unwrap().set_position3d(Vector3::new(0.0, y, 0.0));
                throw(&mut simulator, body, velocity);
            }
            for step in 0..(2.0 * rate) as usize {
                simulator.update(1.0 / rate);
                assert!(simulator.body(load).unwrap().is_grounded(), "{speed} px/s, {rate} Hz, step {step}");
                assert_near(apart(&simulator, lift, load).y, 20.0, 0.05);
            }
        }
    });
}

#[test]
fn a_kinematic_body_with_a_target_is_there_to_the_last_bit_after_a_step_and_stays() {
    precise(|| {
        let (mut simulator, floor, _) = kinematic_floor();
        let target = Vector3::new(3.3, 7.7, -11.1);
        let mut put = simulator.clone();
        put.body_mut(floor).unwrap().set_position3d(target);
        simulator.body_mut(floor).unwrap().move_to3d(target).unwrap();
        simulator.update(1.0 / 60.0);
        assert_eq!(place(&simulator, floor), place(&put, floor));
        assert_near3(velocity(&simulator, floor), (target * 60.0).into(), 0.01);
        (0..3).for_each(|_| simulator.update(1.0 / 60.0));
        assert_eq!(place(&simulator, floor), place(&put, floor));
        assert_eq!(velocity(&simulator, floor), Vector3::zeros());
    });
}

#[test]
fn a_target_is_refused_for_bodies_that_are_not_kinematic_and_schemes_without_kinematic_motion_along_z() {
    precise(|| {
        let (mut simulator, floor, load) = kinematic_floor();
        let mut refuses = |body: BodyId, at: f32| {
            let refused = simulator.body_mut(body).unwrap().move_to3d(Vector3::new(0.0, 0.0, at));
            refused.unwrap_err().to_string()
        };
        assert!(refuses(load, 1.0).contains("kinematic body"));
        assert!(refuses(floor, f32::NAN).contains("position3d"));
        simulator.update(0.01);
        assert_eq!(velocity(&simulator, floor), Vector3::zeros());
    });
    let (mut simulator, floor, _) = kinematic_floor();
    let refused = simulator.body_mut(floor).unwrap().move_to3d(Vector3::zeros()).unwrap_err();
    assert!(refused.to_string().contains("motion along Z"), "{refused}");
}

#[test]
fn a_body_asleep_on_a_kinematic_body_wakes_when_that_begins_to_move_along_z() {
    precise(|| {
        let (mut simulator, floor, load) = kinematic_floor();
        run_for(&mut simulator, 3.0, 60.0);
        assert!(simulator.is_asleep(load));
        simulator.body_mut(floor).unwrap().set_linear_velocity_z(20.0);
        run_for(&mut simulator, 1.0, 60.0);
        assert!(!simulator.is_asleep(load));
        assert_near(velocity(&simulator, load).z, 20.0, 0.05);
    });
}

#[test]
fn the_surface_of_a_static_body_carries_along_x_and_z_up_to_its_speed_by_mu_g_t() {
    precise(|| {
        for rate in RATES {
            let (mut simulator, belt, load) = loaded_floor();
            simulator.body_mut(belt).unwrap().set_is_static(true);
            run_for(&mut simulator, 0.5, rate);
            simulator.body_mut(belt).unwrap().set_velocity3d(ALONG.into());
            run_for(&mut simulator, 0.5 * SLIDE, rate);
            let half = Vector3::from(ALONG) * 0.5;
            assert_near3(velocity(&simulator, load), half.into(), FRICTION * GRAVITY / rate + 0.1);
            run_for(&mut simulator, 0.5 * SLIDE + 0.5, rate);
            assert_near3(velocity(&simulator, load), ALONG, 0.05);
            assert_eq!(place(&simulator, belt), Vector3::zeros());
        }
    });
}

#[test]
fn a_simulator_saved_or_cloned_in_motion_goes_on_with_the_same_bits() {
    precise(|| {
        let (mut simulator, floor, _) = kinematic_floor();
        for step in 0..60 {
            let at = Vector3::new(0.3, 0.2, 0.7) * step as f32;
            simulator.body_mut(floor).unwrap().move_to3d(at).unwrap();
            simulator.update(1.0 / 60.0);
        }
        let mut restored = simulator.clone();
        restored.restore(&simulator.snapshot()).unwrap();
        let mut cloned = simulator.clone();
        for simulator in [&mut simulator, &mut restored, &mut cloned] {
            run_for(simulator, 0.5, 60.0);
        }
        assert_eq!(simulator.snapshot(), restored.snapshot());
        assert_eq!(simulator.snapshot(), cloned.snapshot());
    });
}

/// A platform whose top is at 20 px, and a box at rest on it.
fn loaded_platform() -> (TwoHalfPhysicsSimulator, PlatformId, BodyId) {
    let mut simulator = simulator();
    let lift = platform(&mut simulator, [400.0, 20.0, 400.0], [0.0, 0.0, 0.0]);
    set_platform_surface(&mut simulator, lift, FRICTION, 0.0);
    let load = solid(&mut simulator, [20.0, 20.0, 20.0], [-50.0, 20.0, -50.0]);
    set_surface(&mut simulator, load, FRICTION, 0.0);
    (simulator, lift, load)
}

fn set_velocity(simulator: &mut TwoHalfPhysicsSimulator, lift: PlatformId, velocity: [f32; 3]) {
    simulator.platform_mut(lift).unwrap().set_velocity(velocity.into()).unwrap();
}

fn above(simulator: &TwoHalfPhysicsSimulator, lift: PlatformId, load: BodyId) -> Vector3 {
    place(simulator, load) - simulator.platform(lift).unwrap().position3d()
}

#[test]
fn a_body_on_a_moving_platform_is_carried_in_all_axes_and_lags_by_its_friction() {
    precise(|| {
        for rate in RATES {
            let (mut simulator, lift, load) = loaded_platform();
            run_for(&mut simulator, 0.2, rate);
            let before = above(&simulator, lift, load);
            set_velocity(&mut simulator, lift, ALONG);
            run_for(&mut simulator, SLIDE + 0.5, rate);
            assert_near3(velocity(&simulator, load), ALONG, 0.05);
            let way = Vector3::from(ALONG) * -(LAG / 50.0);
            let lag = above(&simulator, lift, load) - before;
            assert!((lag - way).norm() <= 50.0 / rate, "{rate} Hz: {lag:?}");
            let before = above(&simulator, lift, load);
            run_for(&mut simulator, 3.0, rate);
            assert_near3(above(&simulator, lift, load), before.into(), 0.02);
        }
    });
}

#[test]
fn a_platform_that_goes_down_keeps_its_passengers_grounded_in_all_steps_and_beside_it() {
    precise(|| {
        for (speed, rate) in [60.0, 300.0].into_iter().flat_map(|speed| RATES.map(|rate| (speed, rate))) {
            let (mut simulator, lift, load) = loaded_platform();
            simulator.platform_mut(lift).unwrap().set_position3d(Vector3::new(0.0, 1000.0, 0.0)).unwrap();
            simulator.body_mut(load).unwrap().set_position3d(Vector3::new(0.0, 1020.0, 0.0));
            throw(&mut simulator, load, [0.0, -speed, 0.0]);
            set_velocity(&mut simulator, lift, [0.0, -speed, 0.0]);
            for step in 0..(2.0 * rate) as usize {
                simulator.update(1.0 / rate);
                assert!(simulator.body(load).unwrap().is_grounded(), "{speed} px/s, {rate} Hz, step {step}");
                assert_near(above(&simulator, lift, load).y, 20.0, 0.05);
            }
        }
    });
}

#[test]
fn a_lift_that_accelerates_at_less_than_half_of_gravity_never_loses_its_passengers() {
    precise(|| {
        for rate in RATES {
            let (mut simulator, lift, load) = loaded_platform();
            simulator.platform_mut(lift).unwrap().set_position3d(Vector3::new(0.0, 1000.0, 0.0)).unwrap();
            simulator.body_mut(load).unwrap().set_position3d(Vector3::new(0.0, 1020.0, 0.0));
            run_for(&mut simulator, 0.2, rate);
            for step in 1..=(3.0 * rate) as usize {
                let time = step as f32 / rate;
                let height = 1000.0 - 0.5 * 0.4 * GRAVITY * time * time;
                simulator.platform_mut(lift).unwrap().move_to(Vector3::new(0.0, height, 0.0)).unwrap();
                simulator.update(1.0 / rate);
                assert!(simulator.body(load).unwrap().is_grounded(), "{rate} Hz, step {step}");
            }
            assert_near(above(&simulator, lift, load).y, 20.0, 0.05);
        }
    });
}

#[test]
fn a_platform_with_a_target_is_there_to_the_last_bit_after_a_step_and_stays() {
    precise(|| {
        let (mut simulator, lift, _) = loaded_platform();
        let target = Vector3::new(3.3, 7.7, -11.1);
        simulator.platform_mut(lift).unwrap().move_to(target).unwrap();
        simulator.update(1.0 / 60.0);
        let moved = simulator.platform(lift).unwrap();
        assert_eq!(moved.position3d(), target);
        assert_near3(moved.velocity(), (target * 60.0).into(), 0.01);
        (0..3).for_each(|_| simulator.update(1.0 / 60.0));
        let moved = simulator.platform(lift).unwrap();
        assert_eq!((moved.position3d(), moved.velocity()), (target, Vector3::zeros()));
    });
}

#[test]
fn a_platform_with_a_target_in_every_step_carries_without_lag() {
    precise(|| {
        for rate in RATES {
            let (mut simulator, lift, load) = loaded_platform();
            throw(&mut simulator, load, [0.0, 30.0, 0.0]);
            for step in 1..=(4.0 * rate) as usize {
                let height = 30.0 * step as f32 / rate;
                simulator.platform_mut(lift).unwrap().move_to(Vector3::new(0.0, height, 0.0)).unwrap();
                simulator.update(1.0 / rate);
                assert_near(above(&simulator, lift, load).y, 20.0, 0.05);
            }
        }
    });
}

#[test]
fn a_body_asleep_on_a_platform_wakes_when_that_begins_to_move_and_again_after_a_stop() {
    precise(|| {
        let (mut simulator, lift, load) = loaded_platform();
        for speed in [20.0, -20.0] {
            run_for(&mut simulator, 3.0, 60.0);
            assert!(simulator.is_asleep(load));
            set_velocity(&mut simulator, lift, [0.0, 0.0, speed]);
            run_for(&mut simulator, 1.0, 60.0);
            assert!(!simulator.is_asleep(load));
            assert_near(velocity(&simulator, load).z, speed, 0.05);
            set_velocity(&mut simulator, lift, [0.0; 3]);
        }
    });
}

#[test]
fn a_platform_pushes_bodies_in_its_path_along_each_axis() {
    precise(|| {
        for axis in [0, 2] {
            let mut simulator = simulator();
            let pusher = platform(&mut simulator, [20.0, 40.0, 20.0], [0.0, 0.0, 0.0]);
            let mut at = [0.0; 3];
            at[axis] = 40.0;
            let pushed = solid(&mut simulator, [20.0, 20.0, 20.0], at);
            set_surface(&mut simulator, pushed, 0.0, 0.0);
            let mut along = [0.0; 3];
            along[axis] = 30.0;
            set_velocity(&mut simulator, pusher, along);
            run_for(&mut simulator, 2.0, 60.0);
            // Its face is 10 px before its middle, and so is that of the pushed body.
            assert_near(place(&simulator, pushed)[axis], 2.0 * 30.0 + 20.0, 0.1);
            assert_near(velocity(&simulator, pushed)[axis], 30.0, 0.05);
        }
    });
}

#[test]
fn a_platform_faster_than_its_thickness_per_step_leaves_no_body_behind() {
    precise(|| {
        for (axis, gap) in [0, 2].into_iter().flat_map(|axis| [0.1, 3.0, 8.0, 14.0].map(|gap| (axis, gap))) {
            for size in [8.0, 20.0] {
                let mut simulator = simulator();
                let wall = platform(&mut simulator, [6.0, 40.0, 6.0], [0.0; 3]);
                let (mut at, mut along) = ([0.0; 3], [0.0; 3]);
                (at[axis], along[axis]) = (3.0 + gap + 0.5 * size, 900.0);
                let pushed = solid(&mut simulator, [size; 3], at);
                set_surface(&mut simulator, pushed, 0.0, 0.0);
                set_velocity(&mut simulator, wall, along);
                for _ in 0..30 {
                    run_for(&mut simulator, 1.0 / 60.0, 60.0);
                    assert!(above(&simulator, wall, pushed)[axis] > 3.0 + 0.5 * size - 0.2, "{size} {gap}");
                }
                assert_near(velocity(&simulator, pushed)[axis], 900.0, 0.5);
            }
        }
    });
}

#[test]
fn the_surface_of_a_platform_carries_along_x_and_z_up_to_its_speed_by_mu_g_t() {
    precise(|| {
        for rate in RATES {
            let (mut simulator, belt, load) = loaded_platform();
            run_for(&mut simulator, 3.0, rate);
            assert!(simulator.is_asleep(load));
            simulator.platform_mut(belt).unwrap().set_surface_speed(ALONG[0], ALONG[2]).unwrap();
            run_for(&mut simulator, 0.5 * SLIDE, rate);
            let half = Vector3::from(ALONG) * 0.5;
            assert_near3(velocity(&simulator, load), half.into(), FRICTION * GRAVITY / rate + 0.1);
            run_for(&mut simulator, 0.5 * SLIDE + 0.5, rate);
            assert_near3(velocity(&simulator, load), ALONG, 0.05);
            assert_eq!(simulator.platform(belt).unwrap().position3d(), Vector3::zeros());
        }
    });
}

#[test]
fn the_belt_of_a_platform_that_moves_adds_its_speed_to_the_platforms() {
    precise(|| {
        let (mut simulator, belt, load) = loaded_platform();
        simulator.platform_mut(belt).unwrap().set_surface_speed(20.0, 0.0).unwrap();
        set_velocity(&mut simulator, belt, [10.0, 0.0, -15.0]);
        run_for(&mut simulator, 2.0, 60.0);
        assert_near3(velocity(&simulator, load), [30.0, 0.0, -15.0], 0.05);
    });
}

#[test]
fn bodies_saved_or_cloned_on_a_moving_platform_go_on_with_the_same_bits() {
    precise(|| {
        let (mut simulator, lift, _) = loaded_platform();
        let belt = platform(&mut simulator, [50.0, 20.0, 50.0], [500.0, 0.0, 0.0]);
        set_velocity(&mut simulator, belt, [-3.1, 0.3, 0.7]);
        for step in 0..60 {
            let at = Vector3::new(0.3, 0.2, 0.7) * step as f32;
            simulator.platform_mut(lift).unwrap().move_to(at).unwrap();
            simulator.update(1.0 / 60.0);
        }
        let mut restored = simulator.clone();
        restored.restore(&simulator.snapshot()).unwrap();
        let mut cloned = simulator.clone();
        for simulator in [&mut simulator, &mut restored, &mut cloned] {
            run_for(simulator, 0.5, 60.0);
        }
        assert_eq!(simulator.snapshot(), restored.snapshot());
        assert_eq!(simulator.snapshot(), cloned.snapshot());
    });
}

#[test]
fn bodies_added_and_removed_beside_a_moving_platform_do_not_change_its_motion() {
    precise(|| {
        let (mut simulator, lift, load) = loaded_platform();
        set_velocity(&mut simulator, lift, [0.0, 10.0, 5.0]);
        throw(&mut simulator, load, [0.0, 10.0, 5.0]);
        for step in 0..240 {
            if step % 7 == 0 {
                let guest = solid(&mut simulator, [10.0, 10.0, 10.0], [60.0, 100.0, step as f32]);
                if step % 14 == 0 {
                    simulator.dispose(guest).unwrap();
                }
            }
            if step == 100 {
                platform(&mut simulator, [50.0, 20.0, 50.0], [500.0, 0.0, 0.0]);
            }
            simulator.update(1.0 / 60.0);
        }
        assert_near3(simulator.platform(lift).unwrap().position3d(), [0.0, 40.0, 20.0], ROUNDING);
        assert_near(above(&simulator, lift, load).y, 20.0, 0.05);
    });
}

#[test]
fn moving_platforms_and_belts_are_refused_where_there_are_none_and_by_value() {
    let (mut faithful, lift, _) = loaded_platform();
    let mut refused = faithful.platform_mut(lift).unwrap();
    assert!(refused.set_velocity(Vector3::zeros()).unwrap_err().to_string().contains("moving platforms"));
    assert!(refused.move_to(Vector3::zeros()).unwrap_err().to_string().contains("moving platforms"));
    assert!(refused.set_surface_speed(1.0, 0.0).unwrap_err().to_string().contains("belts"));
    precise(|| {
        let mut simulator = simulator();
        let lift = platform(&mut simulator, [50.0, 20.0, 50.0], [0.0, 0.0, 0.0]);
        let mut view = simulator.platform_mut(lift).unwrap();
        let nothing = f32::NAN;
        let errors = [
            view.set_velocity(Vector3::new(0.0, nothing, 0.0)).unwrap_err(),
            view.move_to(Vector3::new(0.0, nothing, 0.0)).unwrap_err(),
            view.set_surface_speed(0.0, nothing).unwrap_err(),
        ];
        let named = ["velocity", "position3d", "depth"];
        errors
            .iter()
            .zip(named)
            .for_each(|(error, name)| assert!(error.to_string().contains(name), "{error}"));
        view.set_surface_speed(1.0, 0.0).unwrap();
        assert!(simulator.set_depth_scheme(DepthScheme::Faithful).is_err());
    });
}
