//! What moves by the game alone carries what stands on it, and belts do without moving.
//!
//! Friction 0.5 under gravity 100 px/s² gives 50 px/s². What starts from rest on something that moves with velocity v slides
//! until it has that velocity, after v / (mu g), and lags v² / (2 mu g) behind by then; a step counts as a whole, which is up to
//! v dt of that way.

use conformance::fixtures::depth::{
    GRAVITY, assert_near, assert_near3, place, set_surface, simulator, solid, throw, velocity, with_scheme,
};
use twohalf::{BodyId, DepthScheme, TwoHalfPhysicsSimulator, Vector3};

const RATES: [f32; 4] = [30.0, 60.0, 120.0, 240.0];
const FRICTION: f32 = 0.5;
/// 50 px/s along the floor.
const ALONG: [f32; 3] = [30.0, 0.0, 40.0];
/// How long what is carried slides at this speed, s, and the way that it lags behind.
const SLIDE: f32 = 50.0 / (FRICTION * GRAVITY);
const LAG: f32 = 50.0 * 50.0 / (2.0 * FRICTION * GRAVITY);
/// Of coordinates up to 1000.
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
fn what_stands_on_a_kinematic_body_is_carried_in_all_axes_and_lags_by_its_friction() {
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
fn what_is_carried_along_does_not_drift() {
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
fn a_lift_that_goes_down_keeps_what_came_with_it_grounded_in_all_steps() {
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
fn a_kinematic_body_that_is_told_a_place_is_there_to_the_last_bit_after_a_step_and_stays() {
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
fn a_place_is_refused_for_what_is_not_kinematic_and_where_nothing_kinematic_moves_along_z() {
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
fn what_sleeps_on_a_kinematic_body_wakes_when_that_begins_to_move_along_z() {
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
fn what_was_saved_or_cloned_on_its_way_goes_on_with_the_same_bits() {
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
