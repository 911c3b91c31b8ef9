//! Doors of the factories.

use std::f32::consts::FRAC_PI_2;

use conformance::fixtures::depth::{DT, assert_near3, ball, place, run, simulator, solid, with_scheme};
use twohalf::{DepthScheme, TwoHalfPhysicsSimulator, Vector3};
use twohalf_factories::{Door, spawn_door};

fn precise(test: impl FnOnce()) {
    with_scheme(DepthScheme::Precise, test);
}

const HINGE: [f32; 3] = [100.0, 0.0, 40.0];

/// A door of 60 by 80 px, 6 px thick, which points along X.
fn door() -> (TwoHalfPhysicsSimulator, Door) {
    let mut simulator = simulator();
    let door = spawn_door(&mut simulator, HINGE, [60.0, 80.0, 6.0], 0.0).unwrap();
    (simulator, door)
}

/// The middle of the door's platform, and how it is turned.
fn middle(simulator: &TwoHalfPhysicsSimulator, door: &Door) -> (Vector3, f32) {
    let platform = simulator.platform(door.platform()).unwrap();
    (platform.position3d(), platform.yaw())
}

#[test]
fn it_points_from_its_hinge_at_every_angle() {
    precise(|| {
        let (mut simulator, mut door) = door();
        for angle in [0.0, 0.3, 1.0, FRAC_PI_2, -2.0] {
            door.turn_to(&mut simulator, angle).unwrap();
            run(&mut simulator, 1);
            let there = [HINGE[0] + 30.0 * angle.cos(), 0.0, HINGE[2] + 30.0 * angle.sin()];
            let (place, yaw) = middle(&simulator, &door);
            assert_near3(place, there, 1e-4);
            assert_eq!(yaw, angle);
        }
    });
}

#[test]
fn it_turns_evenly_and_stops_where_it_is_to() {
    precise(|| {
        let (mut simulator, mut door) = door();
        let mut steps = 0;
        while !door.turn_towards(&mut simulator, FRAC_PI_2, 1.0 * DT).unwrap() {
            run(&mut simulator, 1);
            steps += 1;
            assert!((door.angle() - steps as f32 * DT).abs() < 1e-4);
        }
        assert_eq!(steps, 157);
        run(&mut simulator, 50);
        assert_near3(middle(&simulator, &door).0, [100.0, 0.0, 40.0 + 30.0], 1e-4);
        let platform = simulator.platform(door.platform()).unwrap();
        assert_near3(platform.velocity(), [0.0; 3], 0.0);
        assert_eq!(platform.angular_velocity(), 0.0);
    });
}

#[test]
fn it_pushes_what_is_in_its_way_out_of_it() {
    precise(|| {
        let (mut simulator, mut door) = door();
        let body = solid(&mut simulator, [16.0; 3], [140.0, 0.0, 60.0]);
        while !door.turn_towards(&mut simulator, FRAC_PI_2, 2.0 * DT).unwrap() {
            run(&mut simulator, 1);
        }
        run(&mut simulator, 20);
        // Behind the door now, which takes from 97 to 103 px along X and from 40 to 100 px along Z.
        let now = place(&simulator, body);
        assert!(now.x <= 97.0 - 8.0 + 0.2 || now.z >= 100.0 + 8.0 - 0.2, "{now:?}");
    });
}

#[test]
fn what_sleeps_against_it_wakes_when_it_turns() {
    precise(|| {
        let (mut simulator, mut door) = door();
        let body = ball(&mut simulator, 8.0, [140.0, 0.0, 51.0]);
        run(&mut simulator, 300);
        assert!(simulator.is_asleep(body));
        for _ in 0..30 {
            door.turn_towards(&mut simulator, FRAC_PI_2, 1.0 * DT).unwrap();
            run(&mut simulator, 1);
        }
        assert!(place(&simulator, body).z > 55.0);
    });
}

#[test]
fn saved_in_its_turn_it_goes_on_with_the_same_bits() {
    precise(|| {
        let (mut simulator, mut door) = door();
        let body = solid(&mut simulator, [16.0; 3], [140.0, 0.0, 60.0]);
        let turn = |simulator: &mut TwoHalfPhysicsSimulator, door: &mut Door| {
            for _ in 0..60 {
                door.turn_towards(simulator, FRAC_PI_2, 1.0 * DT).unwrap();
                run(simulator, 1);
            }
        };
        turn(&mut simulator, &mut door);
        let mut loaded = self::simulator();
        loaded.restore(&simulator.snapshot()).unwrap();
        let mut door_of_loaded = door.clone();
        turn(&mut simulator, &mut door);
        turn(&mut loaded, &mut door_of_loaded);
        assert_eq!((place(&simulator, body), door), (place(&loaded, body), door_of_loaded));
    });
}

#[test]
fn what_cannot_be_a_door_is_refused_and_adds_nothing() {
    precise(|| {
        let mut simulator = simulator();
        let size = [60.0, 80.0, 6.0];
        for (hinge, size, angle) in [
            (HINGE, [0.0, 80.0, 6.0], 0.0),
            (HINGE, [60.0, f32::NAN, 6.0], 0.0),
            (HINGE, [60.0, 80.0, -1.0], 0.0),
            (HINGE, size, f32::INFINITY),
            ([f32::NAN, 0.0, 0.0], size, 0.0),
            ([0.0; 3], [2e38, 80.0, 6.0], 0.0),
        ] {
            assert!(spawn_door(&mut simulator, hinge, size, angle).is_err());
            assert_eq!(simulator.platforms().count(), 0);
        }
        let mut door = spawn_door(&mut simulator, HINGE, size, 0.0).unwrap();
        assert!(door.turn_to(&mut simulator, f32::NAN).is_err());
        assert!(door.turn_towards(&mut simulator, 1.0, -1.0).is_err());
        assert_eq!(door.angle(), 0.0);
        simulator.remove_platform(door.platform()).unwrap();
        assert!(door.turn_to(&mut simulator, 1.0).is_err());
        let mut faithful = TwoHalfPhysicsSimulator::new(100).unwrap();
        faithful.set_depth_scheme(DepthScheme::Faithful).unwrap();
        assert!(spawn_door(&mut faithful, HINGE, size, 0.0).is_err());
    });
}

#[test]
fn a_door_that_is_removed_lets_everything_through() {
    precise(|| {
        let (mut simulator, door) = door();
        let body = ball(&mut simulator, 8.0, [130.0, 0.0, 20.0]);
        door.remove(&mut simulator).unwrap();
        simulator.body_mut(body).unwrap().set_velocity3d(Vector3::new(0.0, 0.0, 100.0));
        run(&mut simulator, 60);
        assert!(place(&simulator, body).z > 60.0);
    });
}
