//! Kinematic bodies that move, with the precise scheme: no body passes through them along any axis, and bodies that fall on
//! them or fly after them collide in their frame.

use conformance::fixtures::depth::{ball, place, solid, throw, velocity, weightless, with_scheme};
use twohalf::{BodyId, DepthProfile, DepthScheme, TwoHalfPhysicsSimulator, Vector3};

use crate::movers::Form::{Ball, Box, Cylinder};

const RATES: [f32; 3] = [30.0, 60.0, 120.0];
/// Height of the scene in px, far above the ground.
const HEIGHT: f32 = 50_000.0;

fn precise(test: impl FnOnce()) {
    with_scheme(DepthScheme::Precise, test);
}

#[derive(Debug, Clone, Copy, PartialEq)]
enum Form {
    Ball,
    Box,
    Cylinder,
}

/// A body that reaches by 8 px from its middle along all axes.
fn add(simulator: &mut TwoHalfPhysicsSimulator, form: Form, middle: Vector3) -> BodyId {
    let lowest = [middle.x, middle.y - 8.0, middle.z];
    match form {
        Ball => ball(simulator, 8.0, lowest),
        Box => solid(simulator, [16.0; 3], lowest),
        Cylinder => {
            let body = solid(simulator, [16.0; 3], lowest);
            let geom = simulator.body(body).unwrap().ground().object_geom().unwrap();
            let profile = DepthProfile::Cylinder { radius: 8.0, height: 16.0 };
            simulator.set_depth_profile(geom, profile).unwrap();
            body
        }
    }
}

/// A kinematic plate across an axis, with a thickness, and its middle at a position.
fn add_plate(
    simulator: &mut TwoHalfPhysicsSimulator,
    axis: usize,
    thickness: f32,
    middle: Vector3,
    velocity: Vector3,
) -> BodyId {
    let mut size = [300.0; 3];
    size[axis] = thickness;
    let plate = solid(simulator, size, [middle.x, middle.y - 0.5 * size[1], middle.z]);
    simulator.body_mut(plate).unwrap().set_is_kinematic(true);
    throw(simulator, plate, velocity.into());
    plate
}

/// How far the middle of a body is from that of another one along an axis.
fn ahead(simulator: &TwoHalfPhysicsSimulator, [body, other]: [BodyId; 2], axis: usize) -> f32 {
    let origin = |body: BodyId| simulator.body(body).unwrap().origin3d()[axis];
    origin(body) - origin(other)
}

fn assert_strikes(form: Form, axis: usize, side: f32, [speed, thickness]: [f32; 2], [rate, phase]: [f32; 2]) {
    let mut simulator = weightless();
    let (direction, middle) = (Vector3::ith(axis, side), Vector3::new(0.0, HEIGHT, 0.0));
    let plate = add_plate(&mut simulator, axis, thickness, middle, direction * speed);
    let distance = 0.5 * thickness + 9.0 + (1.0 + phase) * speed / rate;
    let body = add(&mut simulator, form, middle + direction * distance);
    let case = (form, axis, side, speed, thickness, (rate, phase));
    for _ in 0..8 {
        simulator.update(1.0 / rate);
        let ahead = side * ahead(&simulator, [body, plate], axis);
        // The reach of contacts, and the speed that a soft contact leaves.
        let least = 0.5 * thickness + 8.0 - 0.64 - 0.0142 * speed / rate;
        assert!(ahead > least, "{ahead} of {least}: {case:?}");
    }
    let along = velocity(&simulator, body)[axis] * side;
    assert!((along - speed).abs() < 0.01 * speed, "{along}: {case:?}");
}

#[test]
fn a_kinematic_plate_pushes_the_bodies_that_it_hits_along_any_axis() {
    precise(|| {
        for form in [Ball, Box, Cylinder] {
            for axis in 0..3 {
                for side in [-1.0, 1.0] {
                    for speed in [200.0, 2000.0, 6000.0] {
                        for rate in RATES {
                            for (thickness, phase) in [(4.0, 0.0), (10.0, 0.4), (4.0, 0.8)] {
                                assert_strikes(form, axis, side, [speed, thickness], [rate, phase]);
                            }
                        }
                    }
                }
            }
        }
    });
}

#[test]
fn a_kinematic_plate_passes_bodies_beside_its_path() {
    precise(|| {
        for form in [Ball, Box, Cylinder] {
            for axis in 0..3 {
                for speed in [600.0, 6000.0] {
                    let mut simulator = weightless();
                    let (direction, middle) = (Vector3::ith(axis, 1.0), Vector3::new(0.0, HEIGHT, 0.0));
                    add_plate(&mut simulator, axis, 10.0, middle, direction * speed);
                    let beside = Vector3::ith((axis + 1) % 3, 160.0);
                    let body = add(&mut simulator, form, middle + direction * 130.0 + beside);
                    let before = place(&simulator, body);
                    (0..20).for_each(|_| simulator.update(1.0 / 60.0));
                    assert_eq!(place(&simulator, body), before, "{form:?} along {axis} at {speed} px/s");
                }
            }
        }
    });
}

/// A lift, and a body that is thrown after it with a force that accelerates it.
fn assert_lands(form: Form, axis: usize, side: f32, speed: f32, rate: f32) {
    const ACCELERATION: f32 = 900.0;
    let mut simulator = weightless();
    let (direction, middle) = (Vector3::ith(axis, side), Vector3::new(0.0, HEIGHT, 0.0));
    let lift = add_plate(&mut simulator, axis, 20.0, middle + direction * 118.0, direction * speed);
    let body = add(&mut simulator, form, middle);
    for _ in 0..((4.0 * speed / ACCELERATION + 2.0) * rate) as usize {
        let force = direction * (ACCELERATION * simulator.body(body).unwrap().mass());
        simulator.body_mut(body).unwrap().apply_force3d(force);
        simulator.update(1.0 / rate);
    }
    let case = (form, axis, side, speed, rate);
    let along = velocity(&simulator, body)[axis] * side;
    assert!((along - speed).abs() < 1.0, "velocity {along}: {case:?}");
    let gap = side * ahead(&simulator, [lift, body], axis) - 18.0;
    assert!(gap.abs() < 0.2, "gap {gap}: {case:?}");
}

#[test]
fn a_body_that_falls_on_a_receding_kinematic_body_lands_and_takes_its_velocity() {
    precise(|| {
        for form in [Ball, Box, Cylinder] {
            for axis in 0..3 {
                for side in [-1.0, 1.0] {
                    for speed in [200.0, 1000.0] {
                        assert_lands(form, axis, side, speed, 60.0);
                    }
                }
            }
        }
        for rate in RATES {
            for speed in [50.0, 500.0, 3000.0] {
                assert_lands(Box, 1, -1.0, speed, rate);
            }
        }
    });
}

#[test]
fn a_body_behind_a_faster_kinematic_body_keeps_its_velocity() {
    precise(|| {
        for form in [Ball, Box, Cylinder] {
            for axis in 0..3 {
                for (speed, of_mover) in [(600.0, 700.0), (3000.0, 3010.0), (5000.0, 9000.0)] {
                    let mut simulator = weightless();
                    let (direction, middle) = (Vector3::ith(axis, 1.0), Vector3::new(0.0, HEIGHT, 0.0));
                    add_plate(&mut simulator, axis, 10.0, middle + direction * 58.0, direction * of_mover);
                    let body = add(&mut simulator, form, middle);
                    throw(&mut simulator, body, (direction * speed).into());
                    let before = place(&simulator, body)[axis];
                    (0..20).for_each(|_| simulator.update(1.0 / 60.0));
                    let way = place(&simulator, body)[axis] - before;
                    // Numbers of 50,000 are 0.004 apart, and each step rounds.
                    assert!((way - speed / 3.0).abs() < 0.1, "{way} px: {:?}", (form, axis, speed));
                }
            }
        }
    });
}

#[test]
fn a_kinematic_paddle_strikes_every_ball_before_it() {
    precise(|| {
        for rate in RATES {
            for spin in [3.0, 10.0, 30.0_f32] {
                let mut simulator = weightless();
                let paddle = solid(&mut simulator, [160.0, 10.0, 40.0], [0.0, HEIGHT - 5.0, 0.0]);
                simulator.body_mut(paddle).unwrap().set_is_kinematic(true);
                simulator.body_mut(paddle).unwrap().core_mut().set_angular_velocity(spin);
                // Down on the screen is where the paddle turns to from +X.
                let (s, c) = 0.7_f32.sin_cos();
                let (x, y) = (60.0 * c - 13.0 * s, 60.0 * s + 13.0 * c);
                let body = add(&mut simulator, Ball, Vector3::new(x, HEIGHT - y, 0.0));
                for _ in 0..(1.2 / spin * rate).ceil() as usize {
                    simulator.update(1.0 / rate);
                    let turned = simulator.body(paddle).unwrap().core().rotation();
                    let (s, c) = turned.sin_cos();
                    let (x, y) =
                        (ahead(&simulator, [body, paddle], 0), -ahead(&simulator, [body, paddle], 1));
                    let (along, above) = (c * x + s * y, c * y - s * x);
                    assert!(!(0.0..80.0).contains(&along) || above > 0.0, "{above} at {spin}, {rate} Hz");
                }
                let speed = velocity(&simulator, body).norm();
                assert!(
                    speed > 0.9 * 60.0 * spin && speed < 2.5 * 60.0 * spin,
                    "{speed} at {spin}, {rate} Hz"
                );
            }
        }
    });
}

#[test]
fn a_kinematic_plate_wakes_and_pushes_sleeping_bodies() {
    precise(|| {
        for speed in [300.0, 3000.0] {
            let mut simulator = weightless();
            let middle = Vector3::new(0.0, HEIGHT, 0.0);
            let body = add(&mut simulator, Box, middle);
            (0..60).for_each(|_| simulator.update(1.0 / 60.0));
            assert!(simulator.is_asleep(body));
            let axis = 2;
            let away = Vector3::new(0.0, 0.0, -150.0);
            let plate = add_plate(&mut simulator, axis, 10.0, middle + away, Vector3::new(0.0, 0.0, speed));
            (0..(200.0 / speed * 60.0) as usize).for_each(|_| simulator.update(1.0 / 60.0));
            assert!(ahead(&simulator, [body, plate], axis) > 12.0);
            assert!((velocity(&simulator, body).z - speed).abs() < 0.01 * speed);
        }
    });
}

#[test]
fn kinematic_bodies_go_on_with_the_same_bits_after_loading_in_every_step() {
    precise(|| {
        let mut simulator = weightless();
        let middle = Vector3::new(0.0, HEIGHT, 0.0);
        let mut bodies = Vec::new();
        for (axis, form) in [(0, Ball), (1, Box), (2, Cylinder)] {
            let direction = Vector3::ith(axis, 1.0);
            let at = middle + Vector3::new(2000.0 * axis as f32, 0.0, 0.0);
            bodies.push(add_plate(&mut simulator, axis, 10.0, at - direction * 200.0, direction * 2500.0));
            bodies.push(add(&mut simulator, form, at));
        }
        conformance::fixtures::depth::assert_goes_on_after_loading(&mut simulator, &bodies);
    });
}
