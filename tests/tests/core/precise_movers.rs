//! Kinematic bodies that move, under the precise set: no body passes through them, and bodies that fall on them or fly after
//! them collide in their frame.

use approx::assert_abs_diff_eq;
use farseer_core::math::Vector2;
use farseer_core::{
    BodyFactory, BodyId, GeomFactory, GeomId, GeomPlacement, Methods, PhysicsSimulator, Vertices,
};

/// Steps per second that games take.
const RATES: [f32; 3] = [30.0, 60.0, 120.0];

fn v(x: f32, y: f32) -> Vector2 {
    Vector2::new(x, y)
}

fn simulator(gravity: Vector2) -> PhysicsSimulator {
    let mut simulator = PhysicsSimulator::new(gravity).unwrap();
    simulator.set_methods(Methods::PRECISE).unwrap();
    simulator.set_iterations(4);
    simulator
}

fn put(simulator: &mut PhysicsSimulator, body: BodyId, at: Vector2) {
    simulator[body].set_position(at);
    simulator[body].set_linear_drag_coefficient(0.0);
    simulator[body].set_rotational_drag_coefficient(0.0);
}

fn add_box(simulator: &mut PhysicsSimulator, at: Vector2, size: (f32, f32)) -> (BodyId, GeomId) {
    let body = BodyFactory::create_rectangle_body_in(simulator, size.0, size.1, 1.0).unwrap();
    put(simulator, body, at);
    let placement = GeomPlacement::default();
    (body, GeomFactory::create_rectangle_geom_in(simulator, body, size.0, size.1, placement).unwrap())
}

/// A kinematic box with this velocity.
fn add_plate(
    simulator: &mut PhysicsSimulator,
    at: Vector2,
    size: (f32, f32),
    velocity: Vector2,
) -> (BodyId, GeomId) {
    let (plate, geom) = add_box(simulator, at, size);
    simulator[plate].set_is_kinematic(true);
    simulator[plate].set_linear_velocity(velocity);
    (plate, geom)
}

#[derive(Debug, Clone, Copy, PartialEq)]
enum Form {
    Disc,
    Box,
    Polygon,
    Capsule,
}

const FORMS: [Form; 4] = [Form::Disc, Form::Box, Form::Polygon, Form::Capsule];

/// A dynamic body whose outline extends by `radius` from its origin along x.
fn add(simulator: &mut PhysicsSimulator, form: Form, at: Vector2, radius: f32) -> (BodyId, GeomId) {
    let placement = GeomPlacement::default();
    match form {
        Form::Disc => {
            let body = BodyFactory::create_circle_body_in(simulator, radius, 1.0).unwrap();
            put(simulator, body, at);
            (body, GeomFactory::create_circle_geom_in(simulator, body, radius, 16, placement).unwrap())
        }
        Form::Box => add_box(simulator, at, (2.0 * radius, 2.0 * radius)),
        Form::Polygon => {
            let mut vertices = Vertices::create_circle(radius, 6).unwrap();
            let body = BodyFactory::create_polygon_body_in(simulator, &vertices, 1.0).unwrap();
            put(simulator, body, at);
            (body, GeomFactory::create_polygon_geom_in(simulator, body, &mut vertices, placement).unwrap())
        }
        Form::Capsule => {
            let body = BodyFactory::create_capsule_body_in(simulator, 3.0 * radius, radius, 1.0).unwrap();
            put(simulator, body, at);
            let geom =
                GeomFactory::create_capsule_geom_in(simulator, body, 3.0 * radius, radius, 8, placement);
            (body, geom.unwrap())
        }
    }
}

/// Lifts go as far as the body above them falls in the meantime, and then as long again.
fn assert_lands(form: Form, direction: Vector2, speed: f32, rate: f32, is_bullet: bool) {
    const GRAVITY: f32 = 900.0;
    let mut simulator = simulator(direction * GRAVITY);
    let size = if direction.x == 0.0 { (4000.0, 20.0) } else { (20.0, 4000.0) };
    let (lift, _) = add_plate(&mut simulator, direction * 126.0, size, direction * speed);
    let (body, _) = add(&mut simulator, form, Vector2::zeros(), 16.0);
    simulator[body].set_is_bullet(is_bullet);
    // It has caught up when its fall is the distance of the lift and 100 px: after less than 2 speed / g and half a second.
    let steps = ((4.0 * speed / GRAVITY + 2.0) * rate) as usize;
    (0..steps).for_each(|_| simulator.update(1.0 / rate));
    let case = (form, direction, speed, rate, is_bullet);
    let along = simulator[body].linear_velocity().dot(&direction);
    assert!((along - speed).abs() < 1.0, "velocity {along}: {case:?}");
    let gap = (simulator[lift].position() - simulator[body].position()).dot(&direction) - 26.0;
    // A polygon or capsule may have come to lie on another side.
    let reach = if matches!(form, Form::Disc | Form::Box) { 0.1 } else { 33.0 };
    assert!(gap.abs() < reach, "gap {gap}: {case:?}");
}

#[test]
fn a_body_that_falls_on_a_receding_lift_lands_and_has_its_velocity() {
    for direction in [v(0.0, 1.0), v(0.0, -1.0), v(1.0, 0.0), v(-1.0, 0.0)] {
        for rate in RATES {
            for form in FORMS {
                assert_lands(form, direction, 600.0, rate, false);
            }
        }
    }
    for speed in [50.0, 200.0, 1500.0, 3000.0] {
        for rate in RATES {
            for is_bullet in [false, true] {
                assert_lands(Form::Box, v(0.0, 1.0), speed, rate, is_bullet);
            }
        }
    }
}

#[test]
fn a_body_behind_a_faster_mover_keeps_its_motion() {
    for rate in RATES {
        for (speed, of_mover) in [(600.0, 700.0), (3000.0, 3010.0), (5000.0, 9000.0)] {
            for form in FORMS {
                for spin in [0.0, 20.0] {
                    let mut simulator = simulator(Vector2::zeros());
                    add_plate(&mut simulator, v(66.0, 0.0), (10.0, 400.0), v(of_mover, 0.0));
                    let (body, _) = add(&mut simulator, form, Vector2::zeros(), 16.0);
                    simulator[body].set_linear_velocity(v(speed, 0.0));
                    simulator[body].set_angular_velocity(spin);
                    (0..20).for_each(|_| simulator.update(1.0 / rate));
                    // Sums of 20 displacements of up to 167 px, each rounded.
                    assert_abs_diff_eq!(simulator[body].position().x, 20.0 * speed / rate, epsilon = 0.01);
                    assert_eq!(simulator[body].linear_velocity(), v(speed, 0.0));
                }
            }
        }
    }
}

#[test]
fn a_bullet_hits_a_receding_target() {
    for (speed, of_target) in [(6000.0, 1200.0), (3000.0, 600.0), (20_000.0, 10_000.0)] {
        for rate in RATES {
            for is_target_marked in [false, true] {
                let mut simulator = simulator(Vector2::zeros());
                let (target, _) = add_box(&mut simulator, v(100.0, 0.0), (40.0, 40.0));
                simulator[target].set_linear_velocity(v(of_target, 0.0));
                let (bullet, _) = add(&mut simulator, Form::Disc, v(-137.0, 0.0), 2.0);
                simulator[bullet].set_linear_velocity(v(speed, 0.0));
                simulator[if is_target_marked { target } else { bullet }].set_is_bullet(true);
                let steps = 10 + (400.0 / (speed - of_target) * rate) as usize;
                (0..steps).for_each(|_| simulator.update(1.0 / rate));
                let [one, other] = [bullet, target].map(|body| simulator[body].linear_velocity().x);
                let case = (speed, of_target, rate, is_target_marked);
                assert!(simulator[bullet].position().x < simulator[target].position().x, "{case:?}");
                // Without restitution they go on together; a step after a hit up to 1.42 % of the speed remains.
                assert!((one - other).abs() < 0.0142 * (speed - of_target), "{one}, {other}: {case:?}");
                assert_abs_diff_eq!(one + other, speed + of_target, epsilon = 0.1);
            }
        }
    }
}

/// A plate aslant hits a body in this phase of a step.
struct Strike {
    form: Form,
    radius: f32,
    thickness: f32,
    speed: f32,
    rate: f32,
    phase: f32,
    /// Velocity of the struck body along the plate's direction, as a fraction of the plate's speed.
    before: f32,
    restitution: f32,
}

impl Strike {
    const DIRECTION: [f32; 2] = [0.6, 0.8];

    fn assert_strikes(&self) {
        let &Strike { form, radius, thickness, speed, rate, phase, before, restitution } = self;
        let direction = Vector2::from(Self::DIRECTION);
        let mut simulator = simulator(Vector2::zeros());
        let (plate, geom) =
            add_plate(&mut simulator, Vector2::zeros(), (thickness, 300.0), direction * speed);
        simulator[plate].set_rotation(direction.y.atan2(direction.x));
        simulator.geom_mut(geom).unwrap().set_restitution_coefficient(restitution);
        let distance = 0.5 * thickness + 1.5 * radius + (1.0 + phase) * (1.0 - before) * speed / rate;
        let (body, geom) = add(&mut simulator, form, direction * distance, radius);
        simulator.geom_mut(geom).unwrap().set_restitution_coefficient(restitution);
        // A face lies flat against the plate: it gets no torque.
        simulator[body].set_rotation(direction.y.atan2(direction.x));
        simulator[body].set_linear_velocity(direction * (before * speed));
        let case = (form, radius, thickness, speed, (rate, phase, before, restitution));
        for _ in 0..6 + (radius / (1.0 - before) / speed * rate) as usize {
            simulator.update(1.0 / rate);
            let ahead = (simulator[body].position() - simulator[plate].position()).dot(&direction);
            let least = 0.5 * thickness + radius * if form == Form::Polygon { 0.866 } else { 1.0 };
            // The reach of contacts, and the relative speed that soft contacts leave: measured, 2.1 % of its motion in a step.
            let deepest = 0.64 + 0.04 * (1.0 - before) * speed / rate;
            assert!(ahead > 0.5 * thickness, "{ahead}: {case:?}");
            assert!(ahead > least - deepest, "{ahead} of {least}: {case:?}");
        }
        let along = simulator[body].linear_velocity().dot(&direction);
        let expected = speed + restitution * (1.0 - before) * speed;
        // A step after a hit up to 1.42 % of the relative speed remains.
        assert!(
            (along - expected).abs() < 0.0142 * (1.0 - before) * speed,
            "{along} of {expected}: {case:?}"
        );
    }
}

#[test]
fn a_moving_plate_pushes_bodies_of_any_size() {
    for radius in [3.0, 16.0, 60.0] {
        for thickness in [2.0, 10.0] {
            for speed in [200.0, 2000.0, 6000.0] {
                for rate in RATES {
                    for form in [Form::Disc, Form::Box] {
                        for phase in [0.0, 0.3, 0.7] {
                            for before in [0.0, -0.5, 0.5] {
                                let restitution = 0.0;
                                Strike { form, radius, thickness, speed, rate, phase, before, restitution }
                                    .assert_strikes();
                            }
                        }
                    }
                }
            }
        }
    }
}

#[test]
fn a_body_struck_with_restitution_leaves_faster_than_the_plate() {
    for restitution in [0.5, 1.0] {
        for speed in [200.0, 2000.0] {
            for rate in RATES {
                for phase in [0.1, 0.6] {
                    for form in [Form::Disc, Form::Box] {
                        let (radius, thickness, before) = (8.0, 10.0, 0.0);
                        Strike { form, radius, thickness, speed, rate, phase, before, restitution }
                            .assert_strikes();
                    }
                }
            }
        }
    }
}

#[test]
fn a_plate_strikes_a_bullet_in_every_phase_of_the_step() {
    for phase in 0..20 {
        let mut simulator = simulator(Vector2::zeros());
        let (plate, _) =
            add_plate(&mut simulator, v(-300.0 - phase as f32, 0.0), (10.0, 100.0), v(2000.0, 0.0));
        let (ball, _) = add(&mut simulator, Form::Disc, Vector2::zeros(), 5.0);
        simulator[ball].set_is_bullet(true);
        (0..20).for_each(|_| simulator.update(1.0 / 60.0));
        assert!(simulator[ball].position().x > simulator[plate].position().x + 9.0, "phase {phase}");
        assert_abs_diff_eq!(simulator[ball].linear_velocity().x, 2000.0, epsilon = 1.0);
    }
}

#[test]
fn a_plate_does_not_touch_bodies_beside_its_path() {
    for speed in [600.0, 3000.0, 10_000.0] {
        for form in FORMS {
            let mut simulator = simulator(Vector2::zeros());
            add_plate(&mut simulator, v(-300.0, 0.0), (10.0, 100.0), v(speed, 0.0));
            let (body, _) = add(&mut simulator, form, v(0.0, 75.0), 16.0);
            (0..40).for_each(|_| simulator.update(1.0 / 60.0));
            assert_eq!(simulator[body].position(), v(0.0, 75.0), "{form:?} at {speed} px/s");
        }
    }
}

#[test]
fn a_flipper_strikes_every_ball_before_it() {
    for rate in RATES {
        for spin in [3.0, 10.0, 30.0_f32] {
            for at in [20.0, 40.0, 60.0, 75.0] {
                let mut simulator = simulator(Vector2::zeros());
                let flipper = BodyFactory::create_rectangle_body_in(&mut simulator, 80.0, 10.0, 1.0).unwrap();
                put(&mut simulator, flipper, Vector2::zeros());
                let placement = GeomPlacement::at(v(40.0, 0.0));
                GeomFactory::create_rectangle_geom_in(&mut simulator, flipper, 80.0, 10.0, placement)
                    .unwrap();
                simulator[flipper].set_is_kinematic(true);
                simulator[flipper].set_angular_velocity(spin);
                // It lies 0.7 rad before the face of the flipper.
                let (s, c) = 0.7_f32.sin_cos();
                let start = v(at * c - 10.0 * s, at * s + 10.0 * c);
                let (ball, _) = add(&mut simulator, Form::Disc, start, 5.0);
                for _ in 0..(1.2 / spin * rate).ceil() as usize {
                    simulator.update(1.0 / rate);
                    let (s, c) = simulator[flipper].rotation().sin_cos();
                    let place = simulator[ball].position();
                    let (along, above) = (c * place.x + s * place.y, c * place.y - s * place.x);
                    assert!(!(0.0..80.0).contains(&along) || above > 0.0, "{above} at {along}");
                }
                let (speed, of_flipper) = (simulator[ball].linear_velocity().norm(), spin * at);
                // The point that hits moves so fast; the flipper drives the ball outward for the rest of its stroke.
                assert!(speed > 0.9 * of_flipper, "{speed} of {of_flipper} at {rate} Hz");
                assert!(speed < 2.5 * of_flipper.max(30.0 * spin), "{speed} of {of_flipper} at {rate} Hz");
            }
        }
    }
}

#[test]
fn a_plate_with_targets_strikes_like_one_with_a_velocity() {
    let mut simulator = simulator(Vector2::zeros());
    let (plate, _) = add_plate(&mut simulator, v(-300.0, 0.0), (10.0, 100.0), Vector2::zeros());
    let (ball, _) = add(&mut simulator, Form::Disc, Vector2::zeros(), 5.0);
    for step in 1..=20 {
        simulator[plate].move_to(v(-300.0 + 33.0 * step as f32, 0.0), 0.0).unwrap();
        simulator.update(1.0 / 60.0);
    }
    assert_abs_diff_eq!(simulator[ball].linear_velocity().x, 33.0 * 60.0, epsilon = 1.0);
    assert_abs_diff_eq!(simulator[ball].position().x - simulator[plate].position().x, 10.0, epsilon = 0.64);
}

/// A floor, and a box that has fallen asleep on it.
fn sleeper() -> (PhysicsSimulator, BodyId) {
    let mut simulator = simulator(v(0.0, 900.0));
    let (floor, _) = add_box(&mut simulator, v(0.0, 10.0), (4000.0, 20.0));
    simulator[floor].set_is_static(true);
    let (body, _) = add_box(&mut simulator, v(0.0, -8.0), (16.0, 16.0));
    (0..90).for_each(|_| simulator.update(1.0 / 60.0));
    assert!(simulator.is_asleep(body));
    (simulator, body)
}

#[test]
fn a_plate_wakes_and_pushes_sleeping_bodies() {
    for speed in [300.0, 2000.0, 6000.0] {
        let (mut simulator, body) = sleeper();
        let (plate, _) = add_plate(&mut simulator, v(-200.0, -20.0), (10.0, 30.0), v(speed, 0.0));
        (0..(260.0 / speed * 60.0) as usize + 2).for_each(|_| simulator.update(1.0 / 60.0));
        assert!(!simulator.is_asleep(body));
        let ahead = simulator[body].position().x - simulator[plate].position().x;
        assert!(ahead > 12.0, "{ahead} px ahead of a plate at {speed} px/s");
        assert!(simulator[body].linear_velocity().x > 0.95 * speed);
    }
}

#[test]
fn a_plate_that_passes_above_sleeping_bodies_wakes_none() {
    let (mut simulator, body) = sleeper();
    let before = simulator[body].position();
    add_plate(&mut simulator, v(-200.0, -40.0), (10.0, 30.0), v(3000.0, 0.0));
    (0..20).for_each(|_| simulator.update(1.0 / 60.0));
    assert!(simulator.is_asleep(body));
    assert_eq!(simulator[body].position(), before);
}

#[test]
fn a_plate_drives_a_body_against_a_wall_without_an_explosion() {
    for speed in [300.0, 2000.0, 6000.0] {
        for form in [Form::Disc, Form::Box] {
            let mut simulator = simulator(Vector2::zeros());
            let (wall, _) = add_box(&mut simulator, v(110.0, 0.0), (20.0, 400.0));
            simulator[wall].set_is_static(true);
            add_plate(&mut simulator, v(-200.0, 0.0), (10.0, 100.0), v(speed, 0.0));
            let (body, _) = add(&mut simulator, form, v(40.0, 0.0), 16.0);
            for _ in 0..120 {
                simulator.update(1.0 / 60.0);
                let (place, velocity) = (simulator[body].position(), simulator[body].linear_velocity());
                assert!(place.x < 100.0, "{place} at {speed} px/s");
                assert!(velocity.norm() < 1.1 * speed, "{velocity} at {speed} px/s");
            }
        }
    }
}

#[test]
fn two_plates_press_a_body_and_hold_it_between_them() {
    for speed in [100.0, 1000.0] {
        for form in [Form::Disc, Form::Box] {
            let mut simulator = simulator(Vector2::zeros());
            let plates = [-1.0, 1.0].map(|side| {
                let velocity = v(-side * speed, 0.0);
                add_plate(&mut simulator, v((21.0 + 0.2 * speed) * side, 0.0), (10.0, 100.0), velocity).0
            });
            let (body, _) = add(&mut simulator, form, Vector2::zeros(), 16.0);
            (0..12).for_each(|_| simulator.update(1.0 / 60.0));
            plates.iter().for_each(|&plate| simulator[plate].set_linear_velocity(Vector2::zeros()));
            (0..60).for_each(|_| simulator.update(1.0 / 60.0));
            assert_abs_diff_eq!(simulator[body].position().x, 0.0, epsilon = 0.5);
            assert!(simulator[body].linear_velocity().norm() < 1.0);
        }
    }
}

#[test]
fn a_body_carried_by_a_mover_is_stopped_by_a_wall() {
    for rate in RATES {
        let mut simulator = simulator(Vector2::zeros());
        let (wall, _) = add_box(&mut simulator, v(2.0, 0.0), (4.0, 400.0));
        simulator[wall].set_is_static(true);
        // The ball comes down on the plate, which takes it along to the wall.
        add_plate(&mut simulator, v(-160.0, 55.0), (300.0, 10.0), v(3000.0, 0.0));
        let (ball, _) = add(&mut simulator, Form::Disc, v(-20.0, -150.0), 4.0);
        simulator[ball].set_linear_velocity(v(0.0, 4000.0));
        for _ in 0..60 {
            simulator.update(1.0 / rate);
            let x = simulator[ball].position().x;
            assert!(x < 0.0, "{x} at {rate} Hz");
        }
    }
}

#[test]
fn a_scene_of_movers_goes_on_with_the_same_bits_after_a_restore_in_every_step() {
    let mut simulator = simulator(v(0.0, 900.0));
    let (floor, _) = add_box(&mut simulator, v(0.0, 200.0), (4000.0, 20.0));
    simulator[floor].set_is_static(true);
    add_plate(&mut simulator, v(-400.0, 150.0), (10.0, 90.0), v(1500.0, 0.0));
    let (lift, _) = add_plate(&mut simulator, v(300.0, 0.0), (200.0, 10.0), v(0.0, 200.0));
    simulator[lift].set_angular_velocity(4.0);
    for i in 0..24 {
        let at = v(45.0 * (i % 12) as f32 - 150.0, 170.0 - 60.0 * (i / 12) as f32);
        let (body, _) = add(&mut simulator, FORMS[i % 4], at, 9.0);
        simulator[body].set_is_bullet(i % 5 == 0);
        simulator[body].set_linear_velocity(v(0.0, if i < 12 { 0.0 } else { 2000.0 }));
    }
    let mut restored = simulator.clone();
    for _ in 0..60 {
        simulator.update(1.0 / 60.0);
        let mut next = PhysicsSimulator::default();
        next.restore(&restored.snapshot()).unwrap();
        next.update(1.0 / 60.0);
        restored = next;
        assert!(restored.snapshot() == simulator.snapshot());
    }
}

/// Four fast balls fly over a row of sleeping boxes: the greatest number of pairs that an update tests.
fn most_pairs_beside(sleepers: usize) -> usize {
    let mut simulator = simulator(Vector2::zeros());
    let boxes: Vec<BodyId> =
        (0..sleepers).map(|i| add_box(&mut simulator, v(40.0 * i as f32, 0.0), (32.0, 32.0)).0).collect();
    (0..60).for_each(|_| simulator.update(1.0 / 60.0));
    assert!(boxes.iter().all(|&body| simulator.is_asleep(body)));
    for i in 0..4 {
        let (ball, _) = add(&mut simulator, Form::Disc, v(-60.0, -40.0 - 30.0 * i as f32), 8.0);
        simulator[ball].set_linear_velocity(v(6000.0, 0.0));
    }
    let updates = (0..60).map(|_| {
        simulator.update(1.0 / 60.0);
        simulator.counters().pairs_tested
    });
    updates.max().unwrap_or(0)
}

#[test]
fn fast_bodies_cost_the_same_beside_many_sleepers_as_beside_few() {
    let (few, many) = (most_pairs_beside(60), most_pairs_beside(2000));
    assert!(many <= few + 2, "{few} and {many} pairs");
}
