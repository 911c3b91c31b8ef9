//! Checks of behaviour chapter 13 on bodies and geoms; refusals of the factories are checked with the exceptions.

use conformance::fixtures::plane::{simulator, v};
use conformance::units::{assert_words, floats};
use farseer_core::{
    Body, BodyFactory, GeomFactory, GeomId, GeomPlacement, NarrowPhaseCollider, Outline, PhysicsSimulator,
    Result, Vertices,
};

fn expect_moment(body: Result<Body>, moment: &str, inverse: &str) {
    let body = body.unwrap();
    assert_words(&body.moment_of_inertia(), moment);
    assert_words(&body.inverse_moment_of_inertia(), inverse);
}

/// Checks 1 to 3.
#[test]
fn rectangles_have_their_moments() {
    expect_moment(BodyFactory::create_rectangle_body(128.0, 128.0, 1.0), "452aaaab", "39c00000");
    expect_moment(BodyFactory::create_rectangle_body(0.1, 0.7, 0.3), "3c4ccccc", "42a00001");
    expect_moment(BodyFactory::create_rectangle_body(80.0, 80.0, 5.0), "45a6aaab", "39449ba5");
    let inverse_mass = |mass| BodyFactory::create_rectangle_body(1.0, 1.0, mass).unwrap().inverse_mass();
    assert_words(&inverse_mass(0.3), "40555555");
    assert_words(&inverse_mass(5.0), "3e4ccccd");
}

/// Checks 4 and 5.
#[test]
fn circles_and_ellipses_have_their_moments() {
    expect_moment(BodyFactory::create_circle_body(0.37, 0.9), "3d7c5587", "4181dc0e");
    expect_moment(BodyFactory::create_ellipse_body(0.37, 0.37, 0.9), "3d7c5587", "4181dc0e");
    assert_eq!(BodyFactory::create_circle_body(64.0, 1.0).unwrap().moment_of_inertia(), 2048.0);
    expect_moment(BodyFactory::create_ellipse_body(0.3, 0.7, 0.9), "3e05a1ca", "40f535f4");
    assert_eq!(BodyFactory::create_ellipse_body(18.0, 34.0, 6.0).unwrap().moment_of_inertia(), 2220.0);
}

/// Check 6.
#[test]
fn a_polygon_ends_up_where_its_outline_was() {
    let mut simulator = simulator(0.0);
    let mut triangle: Vertices = [v(0.0, 0.0), v(3.0, 0.0), v(0.0, 4.0)].into_iter().collect();
    let before = triangle.clone();
    let body = BodyFactory::create_polygon_body(&triangle, 2.0).unwrap();
    assert_eq!(triangle, before);
    assert_words(&body.moment_of_inertia(), "4031c71c");
    assert_words(&body.position(), "3f800000 3faaaaab");
    let body = simulator.create_body(body);
    let placement = GeomPlacement::default();
    let geom = GeomFactory::create_polygon_geom(&mut simulator, body, &mut triangle, placement).unwrap();
    assert_words(&triangle, "bf800000 402aaaaa 40000000 bfaaaaab bf800000 bfaaaaab");
    let geom = simulator.geom(geom).unwrap();
    assert_eq!(geom.world_vertices().to_vec(), [v(0.0, 4.0), v(3.0, 0.0), v(0.0, 0.0)]);
    assert_words(&geom.grid_cell_size(), "3e99999a");
}

/// Check 7.
#[test]
fn a_gear_has_its_moment_and_place() {
    let gear = Vertices::create_gear(50.0, 20, 0.5, 10.0).unwrap();
    let body = BodyFactory::create_polygon_body(&gear, 10.0).unwrap();
    assert_words(&body.moment_of_inertia(), "46714b91");
    assert_words(&body.position(), "34ca7e89 358048e4");
}

/// A geom made by a factory on a body at the origin: its first vertices and its cell size.
fn made(
    make: impl Fn(&mut PhysicsSimulator, farseer_core::BodyId) -> Result<farseer_core::GeomId>,
) -> (Vertices, f32) {
    let mut simulator = simulator(0.0);
    let body = simulator.create_body(Body::new());
    let geom = make(&mut simulator, body).unwrap();
    let geom = simulator.geom(geom).unwrap();
    (geom.local_vertices().clone(), geom.grid_cell_size())
}

/// Check 8.
#[test]
fn a_rectangle_geom_has_sixteen_vertices() {
    let (vertices, cell) =
        made(|s, body| GeomFactory::create_rectangle_geom(s, body, 128.0, 32.0, GeomPlacement::default()));
    assert_eq!(vertices.len(), 16);
    let first =
        [v(-64.0, -16.0), v(-64.0, -8.0), v(-64.0, 0.0), v(-64.0, 8.0), v(-64.0, 16.0), v(-32.0, 16.0)];
    assert_eq!(vertices[..6], first);
    assert_words(&cell, "404ccccd");
}

/// Check 9.
#[test]
fn round_geoms_have_their_vertices_and_cell_sizes() {
    let (circle, cell) =
        made(|s, body| GeomFactory::create_circle_geom(s, body, 16.0, 10, GeomPlacement::default()));
    assert_words(&circle[1..2], "414f1bbd c1167918");
    assert_words(&circle[5..6], "c1800000 35bbbd2e");
    assert_words(&cell, "4042c6c0");
    let (ellipse, cell) =
        made(|s, body| GeomFactory::create_ellipse_geom(s, body, 18.0, 34.0, 14, GeomPlacement::default()));
    assert_words(&ellipse[1..2], "4181bd51 c16c0863");
    assert_words(&cell, "40666667");
}

/// Check 10.
#[test]
fn a_copied_body_keeps_properties_and_flags() {
    let mut body = BodyFactory::create_rectangle_body(10.0, 20.0, 4.0).unwrap();
    body.set_is_static(true);
    body.set_enabled(false);
    body.set_linear_drag_coefficient(0.5);
    body.set_rotational_drag_coefficient(0.6);
    body.set_quadratic_drag_coefficient(0.7);
    body.set_tag(5);
    body.set_position(v(5.0, 6.0));
    body.set_is_auto_idle(true);
    body.set_minimum_velocity(3.0);
    let mut copy = BodyFactory::create_body_from(&body);
    assert!(copy.is_static() && !copy.enabled());
    let drags = [
        copy.linear_drag_coefficient(),
        copy.rotational_drag_coefficient(),
        copy.quadratic_drag_coefficient(),
    ];
    assert_eq!((drags, copy.tag()), ([0.5, 0.6, 0.7], 5));
    assert_eq!((copy.position(), copy.is_auto_idle(), copy.minimum_velocity()), (v(0.0, 0.0), false, 55.0));
    assert_eq!(copy.inverse_mass(), 0.0);
    copy.set_is_static(false);
    assert_words(&copy.inverse_mass(), "3e800000");
    assert_words(&copy.inverse_moment_of_inertia(), "3bc49ba5");
}

/// Check 11: values that become NaN in the original, or make its setter throw, are refused here.
#[test]
fn bodies_that_could_not_move_are_refused() {
    assert!(BodyFactory::create_rectangle_body(f32::NAN, 1.0, 1.0).is_err());
    assert!(BodyFactory::create_rectangle_body(1e-30, 1e-30, 1.0).is_err());
    let two: Vertices = [v(1.0, 1.0), v(2.0, 1.0)].into_iter().collect();
    assert!(BodyFactory::create_polygon_body(&two, 1.0).is_err());
}

/// Section 13.1: only the simulator forms add, and only the objects that they return.
#[test]
fn only_the_forms_with_a_simulator_add() {
    let mut simulator = simulator(0.0);
    let plain = simulator.create_body(BodyFactory::create_circle_body(5.0, 1.0).unwrap());
    let placement = GeomPlacement::default();
    let added_geom = GeomFactory::create_circle_geom_in(&mut simulator, plain, 5.0, 8, placement).unwrap();
    let added_body = BodyFactory::create_circle_body_in(&mut simulator, 5.0, 1.0).unwrap();
    GeomFactory::create_circle_geom(&mut simulator, added_body, 5.0, 8, placement).unwrap();
    simulator.process_added_and_removed();
    assert_eq!(simulator.body_list(), [added_body]);
    assert_eq!(simulator.geom_list(), [added_geom]);
}

/// Section 13.3: a polygon cut into pieces keeps the caller's list, and puts its centroid at the body.
#[test]
fn pieces_of_a_polygon_surround_its_centroid() {
    let mut simulator = simulator(0.0);
    let body = simulator.create_body(Body::new());
    let points = "00000000 00000000 40800000 00000000 40800000 3f800000 3f800000 3f800000 3f800000 40400000 00000000 40400000";
    let outline: Vertices = floats(points).chunks_exact(2).map(|xy| v(xy[0], xy[1])).collect();
    let before = outline.clone();
    let pieces = GeomFactory::create_sat_polygon_geom_in(&mut simulator, body, &outline, 10).unwrap();
    assert_eq!(outline, before);
    simulator.process_added_and_removed();
    assert_eq!(simulator.geom_list(), pieces);
    assert!(pieces.len() > 1);
    for &piece in &pieces {
        let piece = simulator.geom(piece).unwrap();
        // The centroid of the L is (1.5, 1).
        assert_eq!((piece.position(), piece.grid_cell_size()), (v(-1.5, -1.0), 1.0));
    }
}

/// A circle in a simulator; under SAT, as no grid is fine enough for the smallest.
fn circle_of(radius: f32, edges: i32) -> (PhysicsSimulator, GeomId) {
    let mut simulator = simulator(0.0);
    simulator.set_narrow_phase_collider(NarrowPhaseCollider::Sat);
    let body = simulator.create_body(Body::new());
    let placement = GeomPlacement { offset: v(3.0, 4.0), ..Default::default() };
    let geom = GeomFactory::create_circle_geom(&mut simulator, body, radius, edges, placement).unwrap();
    (simulator, geom)
}

fn circle(radius: f32) -> (PhysicsSimulator, GeomId) {
    circle_of(radius, 12)
}

#[test]
fn only_the_factory_of_circles_makes_circles() {
    let (mut simulator, geom) = circle(5.0);
    let body = simulator.body_of(geom).unwrap();
    let polygon = Vertices::create_circle(5.0, 12).unwrap();
    let same = simulator.create_geom(body, polygon, GeomPlacement::default()).unwrap();
    let [circle, same] = [geom, same].map(|geom| simulator.geom(geom).unwrap());
    assert_eq!((circle.outline(), same.outline()), (Outline::Circle { radius: 5.0 }, Outline::Polygon));
    assert_eq!(circle.local_vertices(), same.local_vertices());
}

#[test]
fn copies_of_circles_are_circles() {
    let (mut simulator, geom) = circle(5.0);
    let body = simulator.create_body(Body::new());
    let copies = [
        GeomFactory::create_geom_from(&mut simulator, body, geom).unwrap(),
        GeomFactory::create_geom_from_with_offset(&mut simulator, body, geom, v(1.0, 2.0), 0.3).unwrap(),
    ];
    for copy in copies {
        assert_eq!(simulator.geom(copy).unwrap().outline(), Outline::Circle { radius: 5.0 });
    }
}

#[test]
fn a_circle_that_is_given_other_vertices_is_a_polygon() {
    let (mut simulator, geom) = circle(5.0);
    assert!(simulator.set_vertices(geom, vec![v(f32::NAN, 0.0)]).is_err());
    assert_eq!(simulator.geom(geom).unwrap().outline(), Outline::Circle { radius: 5.0 });
    simulator.set_vertices(geom, Vertices::create_rectangle(2.0, 3.0).unwrap()).unwrap();
    assert_eq!(simulator.geom(geom).unwrap().outline(), Outline::Polygon);
}

/// Circles of any size: the smallest are rounded by more than a fraction of their radius.
#[test]
fn circles_are_saved() {
    for radius in [1e-44, 1e-38, 0.1, 5.0, 1e6, 1e18, 3e38] {
        for edges in 3..100 {
            let (simulator, geom) = circle_of(radius, edges);
            let mut loaded = PhysicsSimulator::default();
            loaded.restore(&simulator.snapshot()).unwrap();
            assert_eq!(loaded.geom(geom).unwrap().outline(), Outline::Circle { radius });
        }
    }
}

#[test]
fn a_circle_whose_corners_are_not_on_it_is_refused() {
    let (simulator, _) = circle(5.0);
    let saved = serde_json::to_string(&simulator).unwrap();
    let of_radius = |radius: &str| {
        saved.replace(r#"{"Circle":{"radius":5.0}}"#, &format!(r#"{{"Circle":{{"radius":{radius}}}}}"#))
    };
    assert!(serde_json::from_str::<PhysicsSimulator>(&of_radius("5.0")).is_ok());
    for radius in ["5.00001", "4.99999", "-5.0", "0.0", "1e30"] {
        let refused = serde_json::from_str::<PhysicsSimulator>(&of_radius(radius)).unwrap_err();
        assert!(refused.to_string().contains("geom"), "{radius}: {refused}");
    }
}
