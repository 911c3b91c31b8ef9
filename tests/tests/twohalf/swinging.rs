//! Platforms that swing about an upright hinge, and doors that bodies push.

use std::f32::consts::{FRAC_PI_2, PI};

use conformance::fixtures::depth::{
    DT, assert_near, assert_near3, ball, place, run, set_surface, simulator, solid, throw, velocity,
    weightless, with_scheme,
};
use twohalf::{
    BodyId, DepthScheme, MoveInput, Platform, PlatformId, Swing, TwoHalfPhysicsSimulator, Vector2, Vector3,
};
use twohalf_factories::{Actor, Capsule, Cylinder, Figure, Prism, SwingDoor, Thing, spawn_swing_door};

fn precise(test: impl FnOnce()) {
    with_scheme(DepthScheme::Precise, test);
}

const HINGE: [f32; 2] = [100.0, 100.0];
const WIDTH: f32 = 60.0;
const DEPTH: f32 = 6.0;

/// Moment of inertia of a slab of mass 3 about the end of its width, in mass units * px².
const INERTIA: f32 = 3.0 * (WIDTH * WIDTH / 3.0 + DEPTH * DEPTH / 12.0);

/// On a hinge without spring and damper, with stops at half a turn.
const LOOSE: Swing = Swing {
    hinge: HINGE,
    moment_of_inertia: INERTIA,
    stiffness: 0.0,
    damping: 0.0,
    rest_angle: 0.0,
    least_angle: -PI,
    greatest_angle: PI,
};

/// A hinge with a spring: there and back in a number of seconds.
fn sprung(period: f32, damping: f32) -> Swing {
    let frequency = 2.0 * PI / period;
    let stiffness = INERTIA * frequency * frequency;
    Swing { stiffness, damping: 2.0 * damping * INERTIA * frequency, ..LOOSE }
}

/// A door that points along X from its hinge, 80 px high.
fn hang(simulator: &mut TwoHalfPhysicsSimulator, swing: Swing) -> PlatformId {
    let middle = Vector3::new(HINGE[0] + 0.5 * WIDTH, 0.0, HINGE[1]);
    let door = Platform::new(simulator, WIDTH, 80.0, DEPTH, middle, None).unwrap();
    simulator.platform_mut(door).unwrap().set_swing(swing).unwrap();
    door
}

fn yaw(simulator: &TwoHalfPhysicsSimulator, door: PlatformId) -> f32 {
    simulator.platform(door).unwrap().yaw()
}

fn turning(simulator: &TwoHalfPhysicsSimulator, door: PlatformId) -> f32 {
    simulator.platform(door).unwrap().angular_velocity()
}

fn kick(simulator: &mut TwoHalfPhysicsSimulator, door: PlatformId, turning: f32) {
    simulator.platform_mut(door).unwrap().set_angular_velocity(turning).unwrap();
}

fn bouncy(simulator: &mut TwoHalfPhysicsSimulator, door: PlatformId, restitution: f32) {
    simulator.platform_mut(door).unwrap().set_restitution_coefficient(restitution);
}

#[test]
fn a_ball_leaves_a_door_as_a_body_of_its_inertia_by_the_square_of_the_distance() {
    precise(|| {
        for at in [15.0, 35.0, 55.0] {
            for restitution in [0.0, 0.5, 1.0] {
                for mass in [0.1, 1.0, 20.0] {
                    let mut simulator = weightless();
                    let door = hang(&mut simulator, LOOSE);
                    bouncy(&mut simulator, door, restitution);
                    let body = ball(&mut simulator, 8.0, [HINGE[0] + at, 30.0, 60.0]);
                    set_surface(&mut simulator, body, 0.0, restitution);
                    simulator.body_mut(body).unwrap().set_mass(mass).unwrap();
                    throw(&mut simulator, body, [0.0, 0.0, 200.0]);
                    let door_mass = INERTIA / (at * at);
                    let after = 200.0 * (mass - restitution * door_mass) / (mass + door_mass);
                    let turned = (1.0 + restitution) * mass * 200.0 * at / (INERTIA + mass * at * at);
                    while turning(&simulator, door) == 0.0 {
                        run(&mut simulator, 1);
                    }
                    let found = velocity(&simulator, body).z;
                    assert_near(found, after, 1e-6 * 200.0);
                    assert_near(turning(&simulator, door), turned, 1e-6 * turned);
                }
            }
        }
    });
}

/// Angular momentum about the hinge of bodies of mass 1 that do not turn about an upright axis, and of the door.
fn angular_momentum(simulator: &TwoHalfPhysicsSimulator, door: PlatformId, bodies: &[BodyId]) -> f32 {
    let of_bodies = bodies.iter().map(|&body| {
        let (at, velocity) = (place(simulator, body), velocity(simulator, body));
        (at.x - HINGE[0]) * velocity.z - (at.z - HINGE[1]) * velocity.x
    });
    INERTIA * turning(simulator, door) + of_bodies.sum::<f32>()
}

/// How much of the angular momentum about the hinge is lost while balls fly about it, and how fast the door was.
fn lost_in_flight(rate: f32) -> (f32, f32) {
    let mut simulator = weightless();
    let door = hang(&mut simulator, LOOSE);
    bouncy(&mut simulator, door, 0.6);
    let bodies: Vec<BodyId> = [[130.0, 40.0], [150.0, 160.0], [115.0, -20.0], [145.0, 10.0], [155.0, -60.0]]
        .map(|[x, z]| {
            let body = ball(&mut simulator, 8.0, [x, 30.0, z]);
            set_surface(&mut simulator, body, 0.0, 0.6);
            throw(&mut simulator, body, [0.0, 0.0, if z < 100.0 { 150.0 } else { -60.0 }]);
            body
        })
        .into();
    let before = angular_momentum(&simulator, door, &bodies);
    let mut fastest = 0.0f32;
    for _ in 0..rate as usize {
        simulator.update(1.0 / rate);
        fastest = fastest.max(turning(&simulator, door).abs());
    }
    assert!(yaw(&simulator, door).abs() < PI);
    ((angular_momentum(&simulator, door, &bodies) / before - 1.0).abs(), fastest)
}

#[test]
fn angular_momentum_about_the_hinge_is_kept_while_balls_fly_about_it() {
    precise(|| {
        for rate in [60.0, 100.0, 240.0, 960.0] {
            let (lost, fastest) = lost_in_flight(rate);
            assert!(fastest > 1.0);
            // The impulse of a contact is along the normal at the beginning of the step, and the door turns in it: the error is
            // proportional to the length of the step. Measured, 0.37 to 0.72 of it.
            assert!(lost < 0.8 / rate, "{lost} at {rate}");
        }
    });
}

#[test]
fn a_free_door_swings_by_its_law_at_every_length_of_step() {
    precise(|| {
        for rate in [30.0, 60.0, 240.0] {
            for damping in [0.0, 0.2] {
                let mut simulator = weightless();
                let door = hang(&mut simulator, sprung(1.5, damping));
                kick(&mut simulator, door, 4.0);
                let (b, p) = (damping * 2.0 * PI / 1.5, (2.0 * PI / 1.5) * (1.0 - damping * damping).sqrt());
                for step in 1..=(6.0 * rate) as usize {
                    simulator.update(1.0 / rate);
                    let t = step as f32 / rate;
                    let law = 4.0 * (-b * t).exp() * (p * t).sin() / p;
                    assert_near(yaw(&simulator, door), law, 2e-4);
                }
            }
        }
    });
}

#[test]
fn its_middle_goes_round_the_hinge() {
    precise(|| {
        let mut simulator = weightless();
        let door = hang(&mut simulator, LOOSE);
        kick(&mut simulator, door, 2.0);
        for _ in 0..100 {
            run(&mut simulator, 1);
            let platform = simulator.platform(door).unwrap();
            let (sine, cosine) = platform.yaw().sin_cos();
            let wanted = [HINGE[0] + 30.0 * cosine, 0.0, HINGE[1] + 30.0 * sine];
            assert_near3(platform.position3d(), wanted, 1e-3);
            assert_near3(platform.velocity(), [-60.0 * sine, 0.0, 60.0 * cosine], 1e-2);
        }
        assert_near(yaw(&simulator, door), 2.0, 1e-4);
    });
}

#[test]
fn it_passes_no_stop_under_any_load() {
    precise(|| {
        let mut simulator = weightless();
        let door = hang(&mut simulator, Swing { least_angle: -0.3, greatest_angle: 0.5, ..sprung(1.0, 0.1) });
        let body = solid(&mut simulator, [16.0; 3], [140.0, 10.0, 70.0]);
        kick(&mut simulator, door, 60.0);
        run(&mut simulator, 1);
        assert!((0.499..=0.5).contains(&yaw(&simulator, door)));
        for _ in 0..200 {
            let aside = 20.0 * (140.0 - place(&simulator, body).x);
            simulator.body_mut(body).unwrap().set_velocity3d(Vector3::new(aside, 0.0, 200.0));
            run(&mut simulator, 1);
            assert!((-0.3..=0.5).contains(&yaw(&simulator, door)));
        }
        assert_near(yaw(&simulator, door), 0.5, 1e-3);
        // Its front face is at 0.5 rad: a body that presses against it goes no farther, but slides along it.
        let at = place(&simulator, body);
        let (sine, cosine) = 0.5f32.sin_cos();
        let corner = Vector2::new(at.x - HINGE[0] - 8.0, at.z - HINGE[1] + 8.0);
        let deep = 3.0 + cosine * corner.y - sine * corner.x;
        assert!(deep < 0.5, "{deep}");
    });
}

#[test]
fn pressed_against_a_stop_it_acts_as_a_static_wall() {
    precise(|| {
        for mass in [0.2, 1.0, 50.0] {
            let mut simulator = weightless();
            let door = hang(&mut simulator, Swing { least_angle: 0.0, ..sprung(1.0, 0.3) });
            bouncy(&mut simulator, door, 0.8);
            let body = ball(&mut simulator, 8.0, [140.0, 30.0, 150.0]);
            set_surface(&mut simulator, body, 0.0, 0.8);
            simulator.body_mut(body).unwrap().set_mass(mass).unwrap();
            throw(&mut simulator, body, [0.0, 0.0, -200.0]);
            run(&mut simulator, 30);
            assert_near(velocity(&simulator, body).z, 160.0, 0.1);
            assert_eq!(yaw(&simulator, door), 0.0);
        }
    });
}

/// Bodies that walk through.
fn guests() -> [Thing; 4] {
    [
        Figure::new([20.0, 60.0, 16.0]).mass(70.0),
        Cylinder::new(10.0, 60.0).mass(70.0),
        Capsule::new(10.0, 60.0).mass(70.0),
        Prism::new([20.0, 60.0, 14.0]).mass(70.0),
    ]
}

#[test]
fn figures_walk_through_it_at_every_length_of_step_and_it_closes_behind_them() {
    precise(|| {
        for (guest, rate) in guests().into_iter().flat_map(|it| [30.0, 60.0, 240.0].map(|rate| (it, rate))) {
            let mut simulator = simulator();
            let door = SwingDoor::new([200.0, 0.0, 20.0], [60.0, 80.0, 6.0]).angle(FRAC_PI_2).mass(2.0);
            let door = spawn_swing_door(&mut simulator, door).unwrap();
            let mut actor = Actor::spawn(&mut simulator, guest.at([120.0, 0.0, 55.0])).unwrap();
            let mut widest = 0.0f32;
            for _ in 0..(5.0 * rate) as usize {
                actor.act(&mut simulator, MoveInput { x: 90.0, ..MoveInput::default() }, 1.0 / rate).unwrap();
                simulator.update(1.0 / rate);
                let open = FRAC_PI_2 - yaw(&simulator, door);
                widest = widest.max(open);
                let at = actor.place(&simulator);
                // No body is thrown up, or far aside.
                assert!(at.y < 0.1 && (at.z - 55.0).abs() < 0.5, "{at:?}");
            }
            let at = actor.place(&simulator);
            assert!(at.x > 450.0 && widest > 0.7, "{at:?}, {widest} at {rate}");
            assert_near(yaw(&simulator, door), FRAC_PI_2, 0.02);
        }
    });
}

#[test]
fn a_figure_in_it_is_pushed_and_not_crushed_when_it_swings_back() {
    precise(|| {
        // Between it and a wall, and free.
        for has_wall in [false, true] {
            let mut simulator = simulator();
            let door = hang(&mut simulator, sprung(0.8, 0.1));
            simulator.platform_mut(door).unwrap().set_yaw(1.2).unwrap();
            let body = solid(&mut simulator, [16.0; 3], [140.0, 0.0, 112.0]);
            if has_wall {
                Platform::new(&mut simulator, 200.0, 80.0, 10.0, Vector3::new(140.0, 0.0, 95.0), None)
                    .unwrap();
            }
            for _ in 0..300 {
                run(&mut simulator, 1);
                let squeeze = simulator.crush_info(body);
                assert!(squeeze.is_none_or(|it| it.depth < 0.5), "{squeeze:?}");
                if has_wall {
                    assert_near(place(&simulator, body).z, 108.0, 4.5);
                }
            }
            if has_wall {
                // Without friction it slides out, as from between the blades of scissors.
                assert!(place(&simulator, body).x > HINGE[0] + WIDTH);
            } else {
                assert!(place(&simulator, body).z < 100.0);
            }
        }
    });
}

#[test]
fn at_rest_it_sleeps_and_a_touch_a_kick_and_an_edit_wake_it() {
    precise(|| {
        let mut simulator = simulator();
        let door = hang(&mut simulator, sprung(1.0, 0.5));
        kick(&mut simulator, door, 3.0);
        let body = solid(&mut simulator, [16.0; 3], [140.0, 0.0, 300.0]);
        run(&mut simulator, 600);
        assert_eq!(turning(&simulator, door), 0.0);
        assert_near(yaw(&simulator, door), 0.0, 2e-3);
        let still = yaw(&simulator, door);
        assert!(simulator.is_asleep(body));
        // It is no body, and all bodies sleep.
        let asleep = |simulator: &TwoHalfPhysicsSimulator| simulator.core().counters().bodies_asleep;
        assert_eq!(asleep(&simulator), 1);
        run(&mut simulator, 10);
        assert_eq!(yaw(&simulator, door), still);
        kick(&mut simulator, door, 1.0);
        run(&mut simulator, 1);
        assert_near(yaw(&simulator, door), DT, 1e-3);
        run(&mut simulator, 600);
        assert_eq!(turning(&simulator, door), 0.0);
        let other = Swing { rest_angle: 0.4, ..sprung(1.0, 0.5) };
        simulator.platform_mut(door).unwrap().set_swing(other).unwrap();
        run(&mut simulator, 600);
        assert_near(yaw(&simulator, door), 0.4, 2e-3);
        let thrown = ball(&mut simulator, 8.0, [140.0, 30.0, 60.0]);
        throw(&mut simulator, thrown, [0.0, 0.0, 200.0]);
        run(&mut simulator, 60);
        assert!(yaw(&simulator, door) > 0.42);
    });
}

/// A door that a crate which rubs keeps open.
fn jammed() -> (TwoHalfPhysicsSimulator, PlatformId, BodyId) {
    let mut simulator = simulator();
    let door = hang(&mut simulator, sprung(4.0, 0.5));
    simulator.platform_mut(door).unwrap().set_yaw(0.8).unwrap();
    let body = solid(&mut simulator, [16.0; 3], [140.0, 0.0, 125.0]);
    set_surface(&mut simulator, body, 0.8, 0.0);
    simulator.body_mut(body).unwrap().set_mass(300.0).unwrap();
    run(&mut simulator, 600);
    (simulator, door, body)
}

#[test]
fn a_body_that_blocks_it_sleeps_with_it_and_it_closes_without_that_body() {
    precise(|| {
        let (mut simulator, door, body) = jammed();
        assert!(simulator.is_asleep(body), "{:?}", simulator.why_awake(body));
        let open = yaw(&simulator, door);
        assert!(open > 0.3, "{open}");
        run(&mut simulator, 200);
        assert_eq!(yaw(&simulator, door), open);
        let mut loaded = self::simulator();
        loaded.restore(&simulator.snapshot()).unwrap();
        for simulator in [&mut simulator, &mut loaded] {
            assert!(simulator.is_asleep(body));
            simulator.dispose(body).unwrap();
            run(simulator, 600);
            assert_near(yaw(simulator, door), 0.0, 2e-3);
        }
        assert_eq!(simulator.snapshot(), loaded.snapshot());
    });
}

#[test]
fn a_hit_wakes_bodies_asleep_on_its_other_side() {
    precise(|| {
        let (mut simulator, door, body) = jammed();
        assert!(simulator.is_asleep(body));
        let thrown = ball(&mut simulator, 8.0, [130.0, 30.0, 60.0]);
        throw(&mut simulator, thrown, [0.0, 0.0, 300.0]);
        let mut has_woken = false;
        for _ in 0..60 {
            run(&mut simulator, 1);
            has_woken |= !simulator.is_asleep(body);
        }
        assert!(has_woken);
        // All of it comes to rest again.
        throw(&mut simulator, thrown, [0.0; 3]);
        run(&mut simulator, 1500);
        assert!(simulator.is_asleep(body), "{:?}", simulator.why_awake(body));
        assert_eq!(turning(&simulator, door), 0.0);
    });
}

#[test]
fn saved_in_its_swing_it_goes_on_with_the_same_bits() {
    precise(|| {
        let mut simulator = simulator();
        let door = hang(&mut simulator, Swing { least_angle: -0.2, ..sprung(0.9, 0.1) });
        bouncy(&mut simulator, door, 0.3);
        let bodies = [[130.0, 40.0], [150.0, 160.0], [115.0, 20.0]].map(|[x, z]| {
            let body = solid(&mut simulator, [14.0; 3], [x, 0.0, z]);
            throw(&mut simulator, body, [0.0, 0.0, 2.0 * (100.0 - z)]);
            body
        });
        kick(&mut simulator, door, 2.0);
        for step in 0..200 {
            let mut loaded = self::simulator();
            loaded.restore(&simulator.snapshot()).unwrap();
            run(&mut simulator, 5);
            run(&mut loaded, 5);
            let of = |it: &TwoHalfPhysicsSimulator| {
                (yaw(it, door), turning(it, door), bodies.map(|body| place(it, body)))
            };
            assert_eq!(of(&simulator), of(&loaded), "after {step}");
            assert!(simulator.snapshot() == loaded.snapshot(), "after {step}");
        }
    });
}

#[test]
fn a_clone_and_a_rebuilt_simulator_go_on_with_the_same_bits() {
    precise(|| {
        let mut simulator = simulator();
        let door = hang(&mut simulator, sprung(0.9, 0.1));
        let body = solid(&mut simulator, [14.0; 3], [140.0, 0.0, 60.0]);
        throw(&mut simulator, body, [0.0, 0.0, 150.0]);
        let far =
            Platform::new(&mut simulator, 10.0, 10.0, 10.0, Vector3::new(900.0, 0.0, 900.0), None).unwrap();
        let mut other = simulator.clone();
        for _ in 0..150 {
            run(&mut simulator, 1);
            // Another platform is edited: that lists everything anew.
            other.platform_mut(far).unwrap().set_collision_enabled(true);
            run(&mut other, 1);
            assert_eq!(
                (yaw(&simulator, door), place(&simulator, body)),
                (yaw(&other, door), place(&other, body))
            );
        }
        assert!(yaw(&simulator, door) != 0.0);
    });
}

#[test]
fn invalid_hinges_are_refused_without_effect() {
    precise(|| {
        let mut simulator = simulator();
        let door = hang(&mut simulator, sprung(1.0, 0.2));
        let swing = sprung(1.0, 0.2);
        let bad = [
            ("moment_of_inertia", Swing { moment_of_inertia: 0.0, ..swing }),
            ("moment_of_inertia", Swing { moment_of_inertia: f32::NAN, ..swing }),
            ("moment_of_inertia", Swing { moment_of_inertia: 1e-40, ..swing }),
            ("stiffness", Swing { stiffness: -1.0, ..swing }),
            ("stiffness", Swing { stiffness: f32::INFINITY, ..swing }),
            ("damping", Swing { damping: f32::NAN, ..swing }),
            ("hinge", Swing { hinge: [f32::NAN, 0.0], ..swing }),
            ("hinge", Swing { hinge: [f32::MAX, 0.0], ..swing }),
            ("rest_angle", Swing { rest_angle: f32::INFINITY, ..swing }),
            ("least_angle", Swing { least_angle: f32::NAN, ..swing }),
            ("least_angle", Swing { least_angle: 0.1, ..swing }),
            ("least_angle", Swing { least_angle: 0.2, greatest_angle: 0.1, ..swing }),
            ("greatest_angle", Swing { greatest_angle: -0.1, ..swing }),
            ("greatest_angle", Swing { greatest_angle: f32::INFINITY, ..swing }),
        ];
        let before = simulator.snapshot();
        for (argument, swing) in bad {
            let error = simulator.platform_mut(door).unwrap().set_swing(swing).unwrap_err().to_string();
            assert!(error.contains(argument), "{error}");
        }
        let mut view = simulator.platform_mut(door).unwrap();
        let place = view.position3d();
        let errors = [
            view.set_velocity(Vector3::new(1.0, 0.0, 0.0)).unwrap_err(),
            view.move_to(place).unwrap_err(),
            view.turn_to(0.2).unwrap_err(),
            view.set_yaw(4.0).unwrap_err(),
            view.set_surface_speed(1.0, 0.0).unwrap_err(),
            view.set_pitch(0.2).unwrap_err(),
            view.set_rotation(0.2).unwrap_err(),
        ];
        let names = ["velocity", "position3d", "yaw", "yaw", "surface_speed", "yaw", "yaw"];
        for (error, name) in errors.iter().zip(names) {
            assert!(error.to_string().contains(name), "{error}");
        }
        assert!(simulator.snapshot() == before);
    });
    for scheme in [DepthScheme::Faithful, DepthScheme::Thesis] {
        with_scheme(scheme, || {
            let mut simulator = simulator();
            let door = Platform::new(&mut simulator, 60.0, 80.0, 6.0, Vector3::zeros(), None).unwrap();
            let error = simulator.platform_mut(door).unwrap().set_swing(LOOSE).unwrap_err().to_string();
            assert!(error.contains("swing"), "{error}");
            assert!(spawn_swing_door(&mut simulator, SwingDoor::new([0.0; 3], [60.0, 80.0, 6.0])).is_err());
            assert_eq!(simulator.platforms().count(), 1);
        });
    }
}

#[test]
fn without_a_hinge_it_is_static_and_a_teleport_moves_its_hinge() {
    precise(|| {
        let mut simulator = weightless();
        let door = hang(&mut simulator, LOOSE);
        kick(&mut simulator, door, 1.0);
        run(&mut simulator, 30);
        let way = Vector3::new(50.0, 10.0, -20.0);
        let at = simulator.platform(door).unwrap().position3d();
        let mut view = simulator.platform_mut(door).unwrap();
        view.set_position3d(at + way).unwrap();
        assert_near3(
            Vector3::new(view.swing().unwrap().hinge[0], 0.0, view.swing().unwrap().hinge[1]),
            [150.0, 0.0, 80.0],
            1e-4,
        );
        run(&mut simulator, 20);
        let platform = simulator.platform(door).unwrap();
        let (sine, cosine) = platform.yaw().sin_cos();
        assert_near(platform.yaw(), 0.5, 1e-5);
        assert_near3(platform.position3d(), [150.0 + 30.0 * cosine, 10.0, 80.0 + 30.0 * sine], 1e-3);
        simulator.platform_mut(door).unwrap().clear_swing().unwrap();
        let platform = simulator.platform(door).unwrap();
        assert_eq!((platform.swing(), platform.angular_velocity()), (None, 0.0));
        let body = ball(&mut simulator, 8.0, [165.0, 30.0, 40.0]);
        throw(&mut simulator, body, [0.0, 0.0, 200.0]);
        run(&mut simulator, 50);
        assert_eq!(yaw(&simulator, door), simulator.platform(door).unwrap().yaw());
        assert_near(yaw(&simulator, door), 0.5, 1e-5);
    });
}

#[test]
fn non_finite_values_do_not_reach_it() {
    precise(|| {
        let mut simulator = simulator();
        let door = hang(&mut simulator, sprung(1.0, 0.2));
        let body = ball(&mut simulator, 8.0, [140.0, 30.0, 86.0]);
        simulator.body_mut(body).unwrap().set_mass(1e30).unwrap();
        throw(&mut simulator, body, [0.0, 0.0, 1e30]);
        kick(&mut simulator, door, f32::MAX);
        for _ in 0..20 {
            run(&mut simulator, 1);
            let platform = simulator.platform(door).unwrap();
            assert!(platform.yaw().is_finite() && platform.angular_velocity().is_finite());
            assert!(platform.position3d().iter().all(|at| at.is_finite()));
        }
        let mut loaded = self::simulator();
        loaded.restore(&simulator.snapshot()).unwrap();
    });
}
