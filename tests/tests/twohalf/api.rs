//! Positions in the world and on the screen, rejected input, stale ids, drawing order.

use conformance::fixtures::depth::{ball, crate_box, place, run, simulator, throw, weightless};
use twohalf::farseer_core::{Body, GeomPlacement, Vertices};
use twohalf::{DepthProfile, Drawable, Error, Event, TextureId, TwoHalfPhysicsSimulator, Vector2, Vector3};
use twohalf_factories::{TwoHalfBodyFactory, TwoHalfGeomFactory};

/// Distance of a float to the next one.
fn ulp(value: f32) -> f32 {
    value.abs().next_up() - value.abs()
}

/// Numbers from -2000 to 2000 with all bits in use: multiples of an irrational number.
fn numbers(seed: usize) -> impl Iterator<Item = f32> {
    (1..200).map(move |i| ((((i * (seed + 1)) as f64 * 0.618_033_988_749_895).fract() - 0.5) * 4000.0) as f32)
}

#[test]
fn a_position_in_the_world_is_read_as_it_was_set_within_one_ulp_of_its_terms() {
    for angle in [90, 45, 60, 135, 17] {
        let mut simulator = TwoHalfPhysicsSimulator::with_angle(600, angle).unwrap();
        let body = crate_box(&mut simulator, [31.7, 22.3], [0.0, 0.0, 0.0]);
        simulator.body_mut(body).unwrap().set_rotation(0.7);
        for ((x, y), z) in numbers(0).zip(numbers(1)).zip(numbers(2)) {
            let value = Vector3::new(x, y, z);
            simulator.body_mut(body).unwrap().set_position3d(value);
            let read = place(&simulator, body);
            assert_eq!((read.x, read.z), (x, z));
            assert!((read.y - y).abs() <= ulp(y.abs() + 40.0), "{} is not {y}", read.y);
        }
    }
}

#[test]
fn a_position_on_the_screen_is_read_as_it_was_set_within_one_ulp_of_its_terms() {
    for angle in [90, 45, 60, 135, 17] {
        let mut simulator = TwoHalfPhysicsSimulator::with_angle(600, angle).unwrap();
        let body = ball(&mut simulator, 12.5, [0.0, 0.0, 0.0]);
        for ((x, y), z) in numbers(0).zip(numbers(1)).zip(numbers(2)) {
            simulator.body_mut(body).unwrap().set_position3d(Vector3::new(1.0, 2.0, z));
            simulator.body_mut(body).unwrap().set_position(Vector2::new(x, y));
            let read = simulator.body(body).unwrap().position();
            let shift = z.abs() * 4.0;
            assert!((read.x - x).abs() <= ulp(x.abs() + shift), "{} is not {x}", read.x);
            assert!((read.y - y).abs() <= ulp(y.abs() + z.abs() + 600.0), "{} is not {y}", read.y);
            assert_eq!(place(&simulator, body).z, z);
        }
    }
}

#[test]
fn a_ball_on_the_ground_appears_a_radius_above_the_point_where_it_touches() {
    let mut simulator = TwoHalfPhysicsSimulator::with_angle(600, 45).unwrap();
    let body = ball(&mut simulator, 20.0, [100.0, 0.0, 50.0]);
    assert_eq!(simulator.body(body).unwrap().position(), Vector2::new(150.0, 600.0 - 50.0 - 20.0));
}

#[test]
fn setting_the_object_geom_keeps_the_position_and_moves_the_origin() {
    let mut simulator = weightless();
    let body = TwoHalfBodyFactory::create_circle_body(&mut simulator, 20.0, 1.0).unwrap();
    let geom = TwoHalfGeomFactory::create_circle_geom(&mut simulator, body, 20.0, 16).unwrap();
    let mut view = simulator.body_mut(body).unwrap();
    view.set_position3d(Vector3::new(10.0, 30.0, 50.0));
    let shadow = TextureId { id: 4, width: 44, height: 18 };
    view.ground_mut().set_object_geom(geom, Some(shadow)).unwrap();
    assert_eq!(view.position3d(), Vector3::new(10.0, 30.0, 50.0));
    assert_eq!(view.core().position(), Vector2::new(10.0, -50.0));
    assert_eq!(view.ground().object_geom(), Some(geom));
    assert_eq!(view.ground().shadow_image(), Some(shadow));
}

#[test]
fn the_height_of_a_rotated_box_is_that_of_its_lowest_corner() {
    let mut simulator = weightless();
    let body = crate_box(&mut simulator, [40.0, 40.0], [0.0, 100.0, 0.0]);
    simulator.body_mut(body).unwrap().set_rotation(std::f32::consts::FRAC_PI_4);
    let expected = 120.0 - 20.0 * 2.0_f32.sqrt();
    assert!((place(&simulator, body).y - expected).abs() < 1e-4);
}

#[test]
fn the_height_of_an_object_geom_off_the_origin_counts_its_offset() {
    let mut simulator = weightless();
    let body = simulator.create_body(Body::new());
    let placement = GeomPlacement { offset: Vector2::new(0.0, 15.0), ..GeomPlacement::default() };
    let outline = Vertices::create_rectangle(10.0, 10.0).unwrap();
    let geom = simulator.create_geom(body, outline, placement).unwrap();
    let mut view = simulator.body_mut(body).unwrap();
    view.ground_mut().set_object_geom(geom, None).unwrap();
    view.set_position3d(Vector3::zeros());
    assert_eq!(view.core().position().y, -20.0);
}

#[test]
fn geoms_have_the_depth_of_their_shorter_side_and_circles_are_round() {
    let mut simulator = weightless();
    let a = crate_box(&mut simulator, [40.0, 30.0], [0.0, 0.0, 100.0]);
    let b = ball(&mut simulator, 12.0, [200.0, 0.0, -50.0]);
    let [a, b] = [a, b].map(|body| simulator.body(body).unwrap().ground().object_geom().unwrap());
    assert_eq!(simulator.depth_profile(a), Some(DepthProfile::Prism { depth: 30.0 }));
    assert_eq!(simulator.depth_profile(b), Some(DepthProfile::Round { radius: 12.0 }));
    assert_eq!(simulator.depth_interval(a), Some((85.0, 115.0)));
    assert_eq!(simulator.depth_interval(b), Some((-62.0, -38.0)));
}

/// Names of the arguments whose values the last update reports as rejected.
fn rejected(simulator: &TwoHalfPhysicsSimulator) -> Vec<&'static str> {
    let argument = |event: &Event| match *event {
        Event::RejectedInput { argument, .. } => Some(argument),
        _ => None,
    };
    simulator.events().iter().filter_map(argument).collect()
}

#[test]
fn non_finite_values_have_no_effect_and_are_reported_in_the_next_update() {
    let mut simulator = simulator();
    let body = ball(&mut simulator, 10.0, [1.0, 200.0, 3.0]);
    throw(&mut simulator, body, [0.0, 0.0, 5.0]);
    let mut view = simulator.body_mut(body).unwrap();
    view.set_linear_velocity_z(f32::NAN);
    view.apply_force_z(f32::INFINITY);
    view.apply_impulse_z(f32::NEG_INFINITY);
    view.set_position3d(Vector3::new(0.0, f32::NAN, 0.0));
    view.set_position3d(Vector3::new(0.0, 0.0, f32::INFINITY));
    view.ground_mut().set_friction_coefficient(f32::NAN);
    view.ground_mut().set_restitution_coefficient(f32::NAN);
    assert_eq!(view.position3d(), Vector3::new(1.0, 200.0, 3.0));
    assert_eq!((view.linear_velocity_z(), view.force_z()), (5.0, 0.0));
    assert_eq!(view.ground().friction_coefficient(), 0.0);
    run(&mut simulator, 1);
    let expected = [
        "linear_velocity_z",
        "amount",
        "amount",
        "position3d",
        "position3d",
        "friction_coefficient",
        "restitution_coefficient",
    ];
    assert_eq!(rejected(&simulator), expected);
    run(&mut simulator, 1);
    assert_eq!(rejected(&simulator), [""; 0]);
}

#[test]
fn a_position_on_the_screen_that_is_not_finite_is_rejected() {
    let mut simulator = weightless();
    let body = ball(&mut simulator, 10.0, [1.0, 2.0, 3.0]);
    simulator.body_mut(body).unwrap().set_position(Vector2::new(f32::NAN, 0.0));
    assert_eq!(place(&simulator, body), Vector3::new(1.0, 2.0, 3.0));
    run(&mut simulator, 1);
    assert_eq!(rejected(&simulator), ["position"]);
}

#[test]
fn a_non_finite_step_moves_no_body_and_is_reported() {
    let mut simulator = simulator();
    let body = ball(&mut simulator, 10.0, [0.0, 100.0, 0.0]);
    throw(&mut simulator, body, [0.0, 0.0, 5.0]);
    simulator.update(f32::NAN);
    assert_eq!(place(&simulator, body), Vector3::new(0.0, 100.0, 0.0));
    assert_eq!(rejected(&simulator), ["dt"]);
}

#[test]
fn a_body_whose_z_would_become_infinite_stays_and_is_disabled_and_reported() {
    let mut simulator = weightless();
    let body = ball(&mut simulator, 10.0, [0.0, 0.0, 3.0e38]);
    throw(&mut simulator, body, [0.0, 0.0, 3.0e38]);
    simulator.update(1.0);
    assert_eq!(place(&simulator, body).z, 3.0e38);
    assert!(!simulator.body(body).unwrap().enabled());
    assert!(simulator.events().contains(&Event::NotFinite { body, disabled: true }));
}

#[test]
fn a_body_whose_velocity_along_z_would_become_infinite_keeps_it_and_is_disabled_and_reported() {
    let mut simulator = weightless();
    let body = ball(&mut simulator, 10.0, [0.0, 0.0, 3.0]);
    throw(&mut simulator, body, [0.0, 0.0, 3.0e38]);
    simulator.body_mut(body).unwrap().apply_impulse_z(3.0e38);
    simulator.update(0.01);
    assert_eq!(simulator.body(body).unwrap().linear_velocity_z(), 3.0e38);
    assert!(!simulator.body(body).unwrap().enabled());
    assert!(simulator.events().contains(&Event::NotFinite { body, disabled: true }));
}

#[test]
fn a_disposed_body_is_gone_after_the_next_update_and_its_slot_starts_anew() {
    let mut simulator = simulator();
    let body = ball(&mut simulator, 10.0, [0.0, 50.0, 80.0]);
    run(&mut simulator, 1);
    simulator.dispose(body).unwrap();
    run(&mut simulator, 1);
    assert!(simulator.body(body).is_none());
    let next = simulator.create_body(Body::new());
    assert_eq!((next.slot(), next == body), (body.slot(), false));
    assert!(simulator.body(body).is_none());
    assert_eq!(place(&simulator, next), Vector3::zeros());
    assert_eq!(simulator.body(next).unwrap().ground().object_geom(), None);
}

#[test]
fn a_body_whose_object_geom_was_disposed_is_one_without() {
    let mut simulator = weightless();
    let body = ball(&mut simulator, 10.0, [0.0, 50.0, 0.0]);
    let geom = simulator.body(body).unwrap().ground().object_geom().unwrap();
    simulator.dispose(geom).unwrap();
    run(&mut simulator, 2);
    assert_eq!(place(&simulator, body).y, 60.0);
}

#[test]
fn the_object_geom_must_be_one_of_the_body() {
    let mut simulator = weightless();
    let a = ball(&mut simulator, 10.0, [0.0, 50.0, 0.0]);
    let b = ball(&mut simulator, 10.0, [50.0, 50.0, 0.0]);
    let geom = simulator.body(a).unwrap().ground().object_geom().unwrap();
    let refused = simulator.body_mut(b).unwrap().ground_mut().set_object_geom(geom, None);
    assert_eq!(refused, Err(Error::GeomOfAnotherBody { argument: "object_geom" }));
}

#[test]
fn depth_profiles_out_of_range_are_refused() {
    let mut simulator = weightless();
    let body = ball(&mut simulator, 10.0, [0.0, 50.0, 0.0]);
    let geom = simulator.body(body).unwrap().ground().object_geom().unwrap();
    for profile in [
        DepthProfile::Prism { depth: -1.0 },
        DepthProfile::Prism { depth: f32::NAN },
        DepthProfile::Round { radius: 0.0 },
        DepthProfile::Round { radius: f32::INFINITY },
    ] {
        assert!(simulator.set_depth_profile(geom, profile).is_err(), "{profile:?}");
    }
    assert_eq!(simulator.depth_profile(geom), Some(DepthProfile::Round { radius: 10.0 }));
}

#[test]
fn factories_refuse_sizes_and_masses_that_are_not_greater_than_zero() {
    let mut simulator = weightless();
    assert!(TwoHalfBodyFactory::create_circle_body(&mut simulator, 0.0, 1.0).is_err());
    assert!(TwoHalfBodyFactory::create_rectangle_body(&mut simulator, 1.0, f32::NAN, 1.0).is_err());
    let body = TwoHalfBodyFactory::create_circle_body(&mut simulator, 1.0, 1.0).unwrap();
    assert!(TwoHalfGeomFactory::create_circle_geom(&mut simulator, body, -1.0, 16).is_err());
    assert!(TwoHalfGeomFactory::create_circle_geom(&mut simulator, body, 1.0, 2).is_err());
    assert!(TwoHalfGeomFactory::create_rectangle_geom(&mut simulator, body, 1.0, f32::INFINITY).is_err());
    run(&mut simulator, 1);
    assert_eq!((simulator.body_list().len(), simulator.geom_list().len()), (1, 0));
}

#[test]
fn the_drawing_order_is_from_far_to_near_and_at_one_depth_from_low_to_high() {
    let mut simulator = weightless();
    let near = ball(&mut simulator, 10.0, [0.0, 0.0, 10.0]);
    let high = ball(&mut simulator, 10.0, [50.0, 90.0, 50.0]);
    let far = ball(&mut simulator, 10.0, [100.0, 0.0, 90.0]);
    let low = ball(&mut simulator, 10.0, [150.0, 0.0, 50.0]);
    run(&mut simulator, 1);
    assert_eq!(simulator.draw_order(), [far, low, high, near].map(Drawable::Body));
}

#[test]
fn a_taken_over_2d_simulator_has_its_bodies_at_depth_0_with_the_plane_as_the_world() {
    use twohalf::farseer_core::{BodyFactory, GeomFactory, PhysicsSimulator};
    let mut core = PhysicsSimulator::default();
    let body = BodyFactory::create_rectangle_body_in(&mut core, 30.0, 20.0, 1.0).unwrap();
    let geom =
        GeomFactory::create_rectangle_geom_in(&mut core, body, 30.0, 20.0, GeomPlacement::default()).unwrap();
    core[body].set_position(Vector2::new(7.0, -40.0));
    let simulator = TwoHalfPhysicsSimulator::from_core(600, 90, core).unwrap();
    assert_eq!(place(&simulator, body), Vector3::new(7.0, 40.0, 0.0));
    assert_eq!(simulator.depth_profile(geom), Some(DepthProfile::Prism { depth: 20.0 }));
}
