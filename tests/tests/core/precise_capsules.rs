//! The precise set: capsules, against closed forms.

use std::f32::consts::{FRAC_PI_2, PI};

use approx::assert_abs_diff_eq;
use conformance::fixtures::plane::{add_box, add_circle, add_floor, precise, run, simulator, v};
use farseer_core::math::Vector2;
use farseer_core::shape::Vertices;
use farseer_core::{BodyFactory, BodyId, GeomFactory, GeomId, GeomPlacement, Outline, PhysicsSimulator};

const DT: f32 = 1.0 / 60.0;
const GRAVITY: f32 = 320.0;
/// Height of all capsules here in px.
const HEIGHT: f32 = 60.0;
const RADIUS: f32 = 12.0;

fn add_capsule(simulator: &mut PhysicsSimulator, position: Vector2, rotation: f32) -> (BodyId, GeomId) {
    let body = BodyFactory::create_capsule_body_in(simulator, HEIGHT, RADIUS, 1.0).unwrap();
    simulator[body].set_position(position);
    simulator[body].set_rotation(rotation);
    simulator[body].set_linear_drag_coefficient(0.0);
    simulator[body].set_rotational_drag_coefficient(0.0);
    let placement = GeomPlacement::default();
    let geom = GeomFactory::create_capsule_geom_in(simulator, body, HEIGHT, RADIUS, 6, placement).unwrap();
    (body, geom)
}

fn rub(simulator: &mut PhysicsSimulator, geoms: &[GeomId], friction: f32) {
    geoms.iter().for_each(|&geom| {
        simulator[geom].set_friction_coefficient(friction);
        simulator[geom].set_restitution_coefficient(0.0);
    });
}

/// All contacts: position, normal, separation.
fn contacts(simulator: &PhysicsSimulator) -> Vec<(Vector2, Vector2, f32)> {
    let of = |contact: farseer_core::Contact| (contact.position, contact.normal, contact.separation);
    simulator.arbiters().flat_map(|arbiter| arbiter.contacts().map(of).collect::<Vec<_>>()).collect()
}

/// Contacts of two bodies that are fixed in the air.
fn touches(simulator: &mut PhysicsSimulator) -> Vec<(Vector2, Vector2, f32)> {
    simulator.update(1e-6);
    contacts(simulator)
}

#[test]
fn the_moment_of_inertia_of_a_capsule_is_that_of_its_area() {
    let body = BodyFactory::create_capsule_body(HEIGHT, RADIUS, 2.0).unwrap();
    // The second moment of thin slices across it, over their area.
    let (height, radius) = (f64::from(HEIGHT), f64::from(RADIUS));
    let slices = 400_000;
    let thickness = height / f64::from(slices);
    let (mut area, mut moment) = (0.0, 0.0);
    for slice in 0..slices {
        let y = (f64::from(slice) + 0.5) * thickness - 0.5 * height;
        let beyond = (y.abs() - (0.5 * height - radius)).max(0.0);
        let half = (radius * radius - beyond * beyond).sqrt();
        area += 2.0 * half * thickness;
        moment += (2.0 * half * y * y + 2.0 / 3.0 * half * half * half) * thickness;
    }
    let expected = 2.0 * moment / area;
    // Slices at the tips are rounded by less than a millionth.
    assert_abs_diff_eq!(f64::from(body.moment_of_inertia()), expected, epsilon = 1e-6 * expected);
}

#[test]
fn an_invalid_capsule_is_refused_and_no_geom_is_made() {
    let mut simulator = precise(GRAVITY);
    let body = simulator.create_body(farseer_core::Body::new());
    let placement = GeomPlacement::default();
    for (height, radius, edges) in [
        (60.0, 30.0, 6),
        (60.0, 0.0, 6),
        (f32::NAN, 12.0, 6),
        (60.0, f32::INFINITY, 6),
        (-60.0, 12.0, 6),
        (60.0, 12.0, 0),
    ] {
        let refused =
            GeomFactory::create_capsule_geom(&mut simulator, body, height, radius, edges, placement);
        assert!(refused.is_err(), "{height} {radius} {edges}");
        if edges > 0 {
            assert!(BodyFactory::create_capsule_body(height, radius, 1.0).is_err(), "{height} {radius}");
        }
    }
    assert!(BodyFactory::create_capsule_body(60.0, 12.0, -1.0).is_err());
    assert!(simulator.geoms_of(body).is_empty());
}

#[test]
fn a_capsule_lies_on_a_floor_at_the_height_of_its_radius_on_two_points() {
    let mut simulator = precise(GRAVITY);
    let (_, floor) = add_floor(&mut simulator, (400.0, 20.0), v(0.0, 10.0));
    let (body, geom) = add_capsule(&mut simulator, v(0.0, -20.0), FRAC_PI_2);
    rub(&mut simulator, &[floor, geom], 0.5);
    run(&mut simulator, 600);
    // Measured: 0.0005 px, 5e-5 rad.
    assert_abs_diff_eq!(simulator[body].position().y, -RADIUS, epsilon = 0.001);
    assert_abs_diff_eq!(simulator[body].rotation(), FRAC_PI_2, epsilon = 1e-4);
    let mut places: Vec<f32> = contacts(&simulator).iter().map(|(position, ..)| position.x).collect();
    places.sort_by(f32::total_cmp);
    assert_eq!(places.len(), 2);
    let half = 0.5 * HEIGHT - RADIUS;
    let middle = simulator[body].position().x;
    // Measured: 0.0043 px.
    assert_abs_diff_eq!(places[0], middle - half, epsilon = 0.005);
    assert_abs_diff_eq!(places[1], middle + half, epsilon = 0.005);
}

#[test]
fn a_capsule_that_lies_slides_as_far_as_friction_says() {
    let mut simulator = precise(GRAVITY);
    let (_, floor) = add_floor(&mut simulator, (2000.0, 20.0), v(0.0, 10.0));
    let (body, geom) = add_capsule(&mut simulator, v(0.0, -RADIUS), FRAC_PI_2);
    rub(&mut simulator, &[floor, geom], 0.5);
    run(&mut simulator, 60);
    let start = simulator[body].position().x;
    simulator[body].set_linear_velocity(v(200.0, 0.0));
    run(&mut simulator, 180);
    let distance = 200.0 * 200.0 / (2.0 * 0.5 * GRAVITY);
    // Measured: 0.0016 px.
    assert_abs_diff_eq!(simulator[body].position().x - start, distance, epsilon = 0.002);
}

/// Balanced, without friction: its middle is straight above its contact point, at the height of its radius.
#[test]
fn a_capsule_stands_on_its_round_end_on_one_point() {
    let mut simulator = precise(GRAVITY);
    let (_, floor) = add_floor(&mut simulator, (400.0, 20.0), v(0.0, 10.0));
    let (body, geom) = add_capsule(&mut simulator, v(0.0, -0.5 * HEIGHT), 0.0);
    rub(&mut simulator, &[floor, geom], 0.0);
    run(&mut simulator, 60);
    // Measured: 0.0007 px.
    assert_abs_diff_eq!(simulator[body].position().y, -0.5 * HEIGHT, epsilon = 0.001);
    assert_eq!(contacts(&simulator).len(), 1);
}

/// Without friction its middle falls straight down, and energy gives the spin. The middle is h = s cos(a) + r above the floor,
/// with s half of the core: m g s (cos a0 - cos a) = (I + m s^2 sin^2 a) w^2 / 2.
#[test]
fn a_capsule_that_stands_askew_falls_as_its_energy_says() {
    let mut simulator = precise(GRAVITY);
    let (_, floor) = add_floor(&mut simulator, (400.0, 20.0), v(0.0, 10.0));
    let (half, start) = (0.5 * HEIGHT - RADIUS, 0.3_f32);
    let (body, geom) = add_capsule(&mut simulator, v(0.0, -half * start.cos() - RADIUS), start);
    rub(&mut simulator, &[floor, geom], 0.0);
    while simulator[body].rotation() < 1.2 {
        simulator.update(DT);
        assert!(simulator[body].rotation() > 0.29);
    }
    let (angle, spin) = (simulator[body].rotation(), simulator[body].angular_velocity());
    let inertia = simulator[body].moment_of_inertia();
    let expected = (2.0 * GRAVITY * half * (start.cos() - angle.cos())
        / (inertia + (half * angle.sin()).powi(2)))
    .sqrt();
    // First order in the substep: its half at the greatest acceleration of the spin, about 40 / s^2, is 0.08 / s.
    assert_abs_diff_eq!(spin, expected, epsilon = 0.03 * expected);
    assert_abs_diff_eq!(simulator[body].position().x, 0.0, epsilon = 0.01);
    // Measured: 0.014 px.
    assert_abs_diff_eq!(simulator[body].position().y, -half * angle.cos() - RADIUS, epsilon = 0.02);
}

#[test]
fn a_ball_rolls_over_a_capsule_as_over_a_floor() {
    let mut simulator = precise(GRAVITY);
    simulator.set_gravity(v(0.3 * GRAVITY, GRAVITY)).unwrap();
    let long = BodyFactory::create_capsule_body_in(&mut simulator, 4000.0, 20.0, 1.0).unwrap();
    simulator[long].set_position(v(0.0, 20.0));
    simulator[long].set_rotation(FRAC_PI_2);
    simulator[long].set_is_static(true);
    let placement = GeomPlacement { collision_grid_size: 5.0, ..GeomPlacement::default() };
    let geom = GeomFactory::create_capsule_geom_in(&mut simulator, long, 4000.0, 20.0, 6, placement).unwrap();
    let (ball, round) = add_circle(&mut simulator, 16.0, 12, v(0.0, -16.0));
    simulator[ball].set_linear_drag_coefficient(0.0);
    simulator[ball].set_rotational_drag_coefficient(0.0);
    rub(&mut simulator, &[geom, round], 0.9);
    let ratio = simulator[ball].moment_of_inertia() / (simulator[ball].mass() * 16.0 * 16.0);
    run(&mut simulator, 120);
    let distance = 0.5 * (0.3 * GRAVITY / (1.0 + ratio)) * 4.0;
    assert_abs_diff_eq!(simulator[ball].position().x, distance, epsilon = 0.001 * distance);
}

#[test]
fn parallel_capsules_touch_along_their_common_length() {
    let mut simulator = precise(0.0);
    add_capsule(&mut simulator, v(0.0, 0.0), 0.0);
    add_capsule(&mut simulator, v(2.0 * RADIUS - 0.25, 10.0), 0.0);
    let mut found = touches(&mut simulator);
    found.sort_by(|a, b| a.0.y.total_cmp(&b.0.y));
    let half = 0.5 * HEIGHT - RADIUS;
    assert_eq!(found.len(), 2);
    for ((position, normal, separation), y) in found.into_iter().zip([10.0 - half, half]) {
        assert_abs_diff_eq!(position, v(RADIUS - 0.125, y), epsilon = 1e-4);
        assert_abs_diff_eq!(normal, v(1.0, 0.0), epsilon = 1e-6);
        assert_abs_diff_eq!(separation, -0.25, epsilon = 1e-4);
    }
}

/// On one line, end to end: their cores are parallel and overlap nowhere.
#[test]
fn capsules_end_to_end_touch_in_one_point() {
    let mut simulator = precise(0.0);
    for (rotation, along) in [(0.0, v(0.0, 1.0)), (0.7_f32, v(-0.7_f32.sin(), 0.7_f32.cos()))] {
        let mut simulator = simulator.clone();
        add_capsule(&mut simulator, v(0.0, 0.0), rotation);
        add_capsule(&mut simulator, along * (HEIGHT - 0.25), rotation);
        let found = touches(&mut simulator);
        assert_eq!(found.len(), 1, "{rotation}");
        assert_abs_diff_eq!(found[0].0, along * (0.5 * HEIGHT - 0.125), epsilon = 1e-3);
        assert_abs_diff_eq!(found[0].1, along, epsilon = 1e-3);
        assert_abs_diff_eq!(found[0].2, -0.25, epsilon = 1e-3);
    }
    simulator.update(DT);
}

#[test]
fn the_end_of_a_capsule_touches_the_side_of_another() {
    let mut simulator = precise(0.0);
    add_capsule(&mut simulator, v(0.0, 0.0), 0.0);
    add_capsule(&mut simulator, v(RADIUS + 0.5 * HEIGHT - 0.25, 5.0), FRAC_PI_2);
    let found = touches(&mut simulator);
    assert_eq!(found.len(), 1);
    assert_abs_diff_eq!(found[0].0, v(RADIUS - 0.125, 5.0), epsilon = 1e-3);
    assert_abs_diff_eq!(found[0].1, v(1.0, 0.0), epsilon = 1e-5);
}

#[test]
fn crossing_capsules_separate() {
    let mut simulator = precise(0.0);
    let (one, _) = add_capsule(&mut simulator, v(0.0, 0.0), 0.0);
    let (other, _) = add_capsule(&mut simulator, v(8.0, 0.0), FRAC_PI_2);
    run(&mut simulator, 240);
    let apart = simulator[other].position() - simulator[one].position();
    // Both have turned on their way out; the test is that they do not overlap any more.
    assert!(contacts(&simulator).iter().all(|&(.., separation)| separation > -0.1));
    assert!(apart.x > 2.0 * RADIUS && apart.norm() < 300.0, "{apart}");
}

/// The normal is along the shortest segment from the corner to the core, at every angle.
#[test]
fn a_capsule_touches_the_corner_of_a_box_along_the_shortest_segment() {
    for angle in [0.3_f32, FRAC_PI_2 / 2.0, 1.2] {
        let mut simulator = precise(0.0);
        add_floor(&mut simulator, (100.0, 100.0), v(0.0, 0.0));
        let outward = v(angle.cos(), -angle.sin());
        let corner = v(50.0, -50.0);
        // It lies across the path, or points along it.
        for along in [0.0, FRAC_PI_2] {
            let mut simulator = simulator.clone();
            let reach = if along == 0.0 { RADIUS } else { 0.5 * HEIGHT };
            let rotation = -angle + along;
            add_capsule(&mut simulator, corner + outward * (reach - 0.25), rotation + PI * 2.0);
            let found = touches(&mut simulator);
            assert_eq!(found.len(), 1, "{angle} {along}");
            assert_abs_diff_eq!(found[0].1, outward, epsilon = 1e-3);
            assert_abs_diff_eq!(found[0].2, -0.25, epsilon = 1e-2);
            assert_abs_diff_eq!(found[0].0, corner, epsilon = 0.2);
        }
    }
}

/// Across the edge of a table: the corner carries it, two points of which one is the corner.
#[test]
fn a_capsule_that_hangs_over_a_table_touches_its_edge() {
    let mut simulator = precise(0.0);
    add_floor(&mut simulator, (100.0, 20.0), v(0.0, 10.0));
    add_capsule(&mut simulator, v(45.0, -RADIUS + 0.25), FRAC_PI_2);
    let mut places: Vec<f32> = touches(&mut simulator).iter().map(|(position, ..)| position.x).collect();
    places.sort_by(f32::total_cmp);
    assert_eq!(places.len(), 2);
    assert_abs_diff_eq!(places[0], 45.0 - (0.5 * HEIGHT - RADIUS), epsilon = 1e-3);
    assert_abs_diff_eq!(places[1], 50.0, epsilon = 1e-3);
}

#[test]
fn copies_of_capsules_are_capsules_and_other_vertices_make_them_polygons() {
    let mut simulator = precise(GRAVITY);
    let (body, geom) = add_capsule(&mut simulator, v(0.0, 0.0), 0.0);
    let copy = simulator.clone_geom(body, geom).unwrap();
    let capsule = Outline::Capsule { height: HEIGHT, end_radius: RADIUS };
    assert_eq!(simulator.geom(copy).unwrap().outline(), capsule);
    let mut loaded = PhysicsSimulator::default();
    loaded.restore(&simulator.snapshot()).unwrap();
    assert_eq!(loaded.geom(geom).unwrap().outline(), capsule);
    simulator.set_vertices(geom, Vertices::create_rectangle(2.0, 3.0).unwrap()).unwrap();
    assert_eq!(simulator.geom(geom).unwrap().outline(), Outline::Polygon);
}

#[test]
fn capsules_of_any_size_are_saved_and_damaged_ones_are_refused() {
    for (height, end_radius) in [(1e-38, 4e-39), (1.0, 0.1), (60.0, 29.9), (1e6, 1.0), (1e18, 1e10)] {
        let mut simulator = precise(GRAVITY);
        let body = simulator.create_body(farseer_core::Body::new());
        let placement = GeomPlacement::default();
        GeomFactory::create_capsule_geom(&mut simulator, body, height, end_radius, 7, placement).unwrap();
        let mut loaded = PhysicsSimulator::default();
        loaded.restore(&simulator.snapshot()).unwrap();
    }
    let mut simulator = precise(GRAVITY);
    add_capsule(&mut simulator, v(0.0, 0.0), 0.0);
    let saved = serde_json::to_string(&simulator).unwrap();
    for (was, is) in [("\"height\":60.0", "\"height\":61.0"), ("\"end_radius\":12.0", "\"end_radius\":-12.0")]
    {
        assert!(saved.contains(was));
        assert!(serde_json::from_str::<PhysicsSimulator>(&saved.replace(was, is)).is_err());
    }
}

#[test]
fn a_pile_with_capsules_goes_on_with_the_same_bits_after_a_restore_in_every_step() {
    let mut plain = precise(GRAVITY);
    add_floor(&mut plain, (200.0, 20.0), v(0.0, 10.0));
    add_floor(&mut plain, (20.0, 400.0), v(-90.0, -200.0));
    add_floor(&mut plain, (20.0, 400.0), v(90.0, -200.0));
    for number in 0..12_u16 {
        let place = v(f32::from(number * 37 % 100) - 50.0, -80.0 - 40.0 * f32::from(number));
        let geom = match number % 3 {
            0 => add_box(&mut plain, (20.0, 26.0), place).1,
            1 => add_circle(&mut plain, 10.0, 12, place).1,
            _ => add_capsule(&mut plain, place, f32::from(number)).1,
        };
        rub(&mut plain, &[geom], 0.4);
    }
    let mut restored = plain.clone();
    for step in 0..400 {
        plain.update(DT);
        restored.update(DT);
        assert!(plain.snapshot() == restored.snapshot(), "step {step}");
        let mut next = simulator(1.0);
        next.restore(&restored.snapshot()).unwrap();
        restored = next;
    }
    assert!(plain.arbiter_count() > 8);
}

/// Both of its ends are right above corners: two points, as anywhere else.
#[test]
fn a_capsule_lies_on_two_points_on_a_box_as_wide_as_its_core() {
    let mut simulator = precise(0.0);
    add_floor(&mut simulator, (HEIGHT - 2.0 * RADIUS, 20.0), v(0.0, 10.0));
    add_capsule(&mut simulator, v(0.0, -RADIUS + 0.25), FRAC_PI_2);
    assert_eq!(touches(&mut simulator).len(), 2);
}
