//! Doors of the factories.

use std::f32::consts::FRAC_PI_2;

use conformance::fixtures::depth::{
    DT, assert_near3, ball, place, run, simulator, solid, throw, velocity, weightless, with_scheme,
};
use twohalf::{DepthScheme, Footprint, MoveInput, TwoHalfPhysicsSimulator, Vector3};
use twohalf_factories::{Actor, Ball, Capsule, Cylinder, Door, Figure, Prism, Thing, spawn, spawn_door};

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
fn it_turns_evenly_and_stops_at_its_target() {
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
fn it_pushes_bodies_out_of_its_path() {
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
fn a_body_asleep_against_it_wakes_when_it_rotates() {
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

/// Position along a door, from its hinge, and in front of its middle plane, at Z of a closed door.
fn beside(door: &Door, at: Vector3) -> [f32; 2] {
    let ((sine, cosine), out) = (door.angle().sin_cos(), at - Vector3::from(HINGE));
    [cosine * out.x + sine * out.z, cosine * out.z - sine * out.x]
}

#[test]
fn a_frictionless_body_slides_out_along_it_as_a_bead_on_a_rotating_rod() {
    precise(|| {
        let mut simulator = weightless();
        let mut door = spawn_door(&mut simulator, HINGE, [150.0, 40.0, 10.0], 0.0).unwrap();
        let (turning, start, off) = (1.0, 60.0, 5.0 + 8.0);
        let body = ball(&mut simulator, 8.0, [HINGE[0] + start, 12.0, HINGE[2] + off]);
        for step in 1..=120 {
            door.turn_towards(&mut simulator, 3.0, turning * DT).unwrap();
            run(&mut simulator, 1);
            // No force acts along the door: r" = w^2 r, from rest beside it.
            let turned = turning * step as f32 * DT;
            let along = start * turned.cosh() + off * turned.sinh();
            let [found, apart] = beside(&door, place(&simulator, body));
            // A step takes it as far as 1.2 px, and turns the door meanwhile by a hundredth.
            assert!((found - along).abs() < 0.01 * along, "{found}, not {along}, after {step}");
            assert!((apart - off).abs() < 0.1, "{apart} after {step}");
        }
    });
}

/// The pushed bodies.
fn loads(size: f32) -> [Thing; 5] {
    let wedge = [[-0.5, -0.3], [0.5, -0.3], [0.0, 0.6]].map(|[x, z]| [x * size, z * size].into());
    [
        Ball::new(0.5 * size),
        Prism::new([size; 3]),
        Cylinder::new(0.5 * size, size),
        Capsule::new(0.5 * size, size),
        Prism::footprint(Footprint::new(&wedge).unwrap(), size),
    ]
}

#[test]
fn no_body_tunnels_through_it_wherever_it_is_hit() {
    precise(|| {
        for (width, thickness, size) in [(60.0, 6.0, 8.0), (150.0, 6.0, 8.0), (150.0, 10.0, 20.0)] {
            for (thing, part, gap) in loads(size).into_iter().flat_map(|thing| {
                [0.15, 0.5, 0.85]
                    .into_iter()
                    .flat_map(move |part| [0.3, 2.0, 5.0].map(|gap| (thing, part, gap)))
            }) {
                let mut simulator = simulator();
                let mut door = spawn_door(&mut simulator, HINGE, [width, 60.0, thickness], 0.0).unwrap();
                let at = [HINGE[0] + part * width, 0.0, HINGE[2] + 0.5 * (thickness + size) + gap];
                let body = spawn(&mut simulator, thing.at(at)).unwrap().body;
                let mut before = beside(&door, place(&simulator, body));
                while !door.turn_towards(&mut simulator, 2.8, 3.0 / 60.0).unwrap() {
                    simulator.update(1.0 / 60.0);
                    let now = beside(&door, place(&simulator, body));
                    let is_past = now[1] < 0.0 && now[0] < width && before[1] > 0.0 && before[0] < width;
                    assert!(!is_past, "{thing:?} of {size} at {part} of {width}, {gap} before it");
                    before = now;
                }
            }
        }
    });
}

#[test]
fn no_thrown_body_tunnels_through_it_at_any_speed() {
    precise(|| {
        for (thing, speed) in
            loads(8.0).into_iter().flat_map(|thing| [300.0, 3000.0, 30_000.0].map(|speed| (thing, speed)))
        {
            for away in [10.0, 30.0, 70.0, 110.0] {
                let mut simulator = weightless();
                let mut door = spawn_door(&mut simulator, HINGE, [150.0, 60.0, 6.0], 0.0).unwrap();
                let at = [HINGE[0] + 110.0, 15.0, HINGE[2] + away];
                let body = spawn(&mut simulator, thing.at(at)).unwrap().body;
                throw(&mut simulator, body, [0.0, 0.0, -speed]);
                for _ in 0..30 {
                    door.turn_towards(&mut simulator, 3.0, 3.0 / 60.0).unwrap();
                    simulator.update(1.0 / 60.0);
                    let [along, apart] = beside(&door, place(&simulator, body));
                    assert!(apart > 0.0 || along > 150.0, "{thing:?} at {speed} from {away}");
                }
            }
        }
    });
}

#[test]
fn a_body_thrown_at_it_as_it_rotates_bounces_with_the_velocity_of_the_contact_point() {
    precise(|| {
        for part in [0.2, 0.5, 0.9] {
            let mut simulator = weightless();
            let mut door = spawn_door(&mut simulator, HINGE, [100.0, 40.0, 8.0], -0.5).unwrap();
            let out = 100.0 * part;
            let thing = Ball::new(6.0).friction(0.0).restitution(1.0);
            let body =
                spawn(&mut simulator, thing.at([HINGE[0] + out, 14.0, HINGE[2] + 100.0])).unwrap().body;
            simulator.platform_mut(door.platform()).unwrap().set_restitution_coefficient(1.0);
            throw(&mut simulator, body, [0.0, 0.0, -200.0]);
            // It comes by 0.45 s, in which the door turns level.
            for _ in 0..80 {
                door.turn_towards(&mut simulator, 2.0, 1.0 * DT).unwrap();
                run(&mut simulator, 1);
                if velocity(&simulator, body).z > 0.0 {
                    break;
                }
            }
            let normal = [-door.angle().sin(), 0.0, door.angle().cos()];
            let away = velocity(&simulator, body).dot(&Vector3::from(normal));
            let along = beside(&door, place(&simulator, body))[0];
            // v' = v + 2 (w r + v . n).
            let wanted = 200.0 * normal[2] + 2.0 * along;
            assert!((away - wanted).abs() < 0.01 * wanted, "{away}, not {wanted}, at {part}");
        }
    });
}

/// A figure that walks by a door, or stands before it.
fn figure(simulator: &mut TwoHalfPhysicsSimulator, at: [f32; 3]) -> Actor {
    Actor::spawn(simulator, Figure::new([24.0, 50.0, 24.0]).at(at)).unwrap()
}

#[test]
fn a_figure_that_walks_is_stopped_by_it_at_every_angle() {
    precise(|| {
        for angle in [-1.2, -0.6, -0.2, 0.0, 0.2, 0.6, 1.2] {
            let mut simulator = simulator();
            let door = spawn_door(&mut simulator, HINGE, [100.0, 80.0, 8.0], angle).unwrap();
            // Straight at its middle.
            let normal = Vector3::new(-angle.sin(), 0.0, angle.cos());
            let middle = simulator.platform(door.platform()).unwrap().position3d();
            let mut actor = figure(&mut simulator, (middle + normal * 60.0).into());
            let wish = MoveInput { x: -200.0 * normal.x, z: -200.0 * normal.z, ..MoveInput::default() };
            for _ in 0..150 {
                actor.act(&mut simulator, wish, DT).unwrap();
                run(&mut simulator, 1);
            }
            let [along, apart] = beside(&door, actor.place(&simulator));
            assert!(
                (apart - 4.0 - 12.0).abs() < 0.5 && (along - 50.0).abs() < 1.0,
                "{angle}: {along} {apart}"
            );
        }
    });
}

#[test]
fn a_figure_that_stands_or_walks_in_its_path_is_pushed_by_it() {
    precise(|| {
        for (speed, dt) in [(1.0, 1.0 / 60.0), (3.0, 1.0 / 60.0), (3.0, 1.0 / 120.0)] {
            for walks in [0.0, -150.0] {
                let mut simulator = simulator();
                let mut door = spawn_door(&mut simulator, HINGE, [100.0, 80.0, 8.0], 0.0).unwrap();
                let mut actor = figure(&mut simulator, [HINGE[0] + 60.0, 0.0, HINGE[2] + 30.0]);
                let mut farthest = 0.0f32;
                while !door.turn_towards(&mut simulator, FRAC_PI_2, speed * dt).unwrap() {
                    let wish = MoveInput { z: walks, ..MoveInput::default() };
                    actor.act(&mut simulator, wish, dt).unwrap();
                    simulator.update(dt);
                    let [along, apart] = beside(&door, actor.place(&simulator));
                    if (0.0..100.0).contains(&along) {
                        assert!(apart > 4.0 + 12.0 - 1.0, "{speed} {walks}: {apart} at {along}");
                    }
                    farthest = farthest.max(actor.place(&simulator).z);
                }
                assert!(farthest > HINGE[2] + 40.0, "{speed} {walks}: {farthest}");
            }
        }
    });
}

#[test]
fn bodies_around_a_door_go_on_with_the_same_bits_after_loading() {
    precise(|| {
        let (mut simulator, mut door) = door();
        let bodies: Vec<_> = loads(12.0)
            .into_iter()
            .zip(1..)
            .map(|(thing, at)| {
                let at = [HINGE[0] + 11.0 * at as f32, 0.0, HINGE[2] + 12.0 + 6.0 * at as f32];
                spawn(&mut simulator, thing.at(at)).unwrap().body
            })
            .collect();
        let places =
            |of: &TwoHalfPhysicsSimulator| bodies.iter().map(|&body| place(of, body)).collect::<Vec<_>>();
        for _ in 0..40 {
            door.turn_towards(&mut simulator, 2.0, 3.0 * DT).unwrap();
            run(&mut simulator, 1);
            let mut loaded = self::simulator();
            loaded.restore(&simulator.snapshot()).unwrap();
            let mut kept = simulator.clone();
            for of in [&mut loaded, &mut kept] {
                let mut door = door.clone();
                for _ in 0..20 {
                    door.turn_towards(of, 2.0, 3.0 * DT).unwrap();
                    run(of, 1);
                }
            }
            assert_eq!(places(&loaded), places(&kept));
        }
    });
}

#[test]
fn invalid_doors_are_refused_and_add_nothing() {
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
fn bodies_pass_a_removed_door() {
    precise(|| {
        let (mut simulator, door) = door();
        let body = ball(&mut simulator, 8.0, [130.0, 0.0, 20.0]);
        door.remove(&mut simulator).unwrap();
        simulator.body_mut(body).unwrap().set_velocity3d(Vector3::new(0.0, 0.0, 100.0));
        run(&mut simulator, 60);
        assert!(place(&simulator, body).z > 60.0);
    });
}
