//! Checks of behaviour chapter 05 on geoms. The checks on outlines and boxes are with the shapes.

use conformance::fixtures::plane::{add_box, both_sets, pairs, simulator, simulator_with, v};
use conformance::units::{Words, assert_bits, floats};
use farseer_core::math::Matrix;
use farseer_core::{
    Body, BodyId, Error, GeomId, GeomPlacement, GeomRef, NarrowPhaseCollider, PhysicsSimulator, Vertices,
};

fn expect_words<T: Words + ?Sized>(actual: &T, words: &str) {
    assert_bits(&actual.words(), &floats(words), || words.to_owned());
}

fn with_body() -> (PhysicsSimulator, BodyId) {
    let mut simulator = simulator(0.0);
    let body = simulator.create_body(Body::new());
    (simulator, body)
}

/// The geom of checks 12 and 13.
fn offset_geom() -> (PhysicsSimulator, GeomId) {
    let (mut simulator, body) = with_body();
    simulator[body].set_position(v(10.0, 20.0));
    simulator[body].set_rotation(0.5);
    let placement = GeomPlacement { offset: v(1.0, 2.0), rotation_offset: 0.25, collision_grid_size: 0.0 };
    let outline = Vertices::create_simple_rectangle(4.0, 2.0).unwrap();
    let geom = simulator.create_geom(body, outline, placement).unwrap();
    (simulator, geom)
}

/// Check 5.
#[test]
fn a_geom_keeps_its_outline_in_the_engine_winding() {
    let (mut simulator, body) = with_body();
    let capsule = Vertices::create_capsule(10.0, 2.0, 3).unwrap();
    let geom = simulator.create_geom(body, capsule, GeomPlacement::default()).unwrap();
    let local = simulator.geom(geom).unwrap().local_vertices().clone();
    expect_words(&local[..2], "40000000 c0400000 3f800001 c0976cf6");
    assert_eq!(local[local.len() - 1], v(2.0, 3.0));
}

/// Check 12.
#[test]
fn a_geom_with_offsets_lies_where_its_body_puts_it() {
    let (simulator, id) = offset_geom();
    let geom = simulator.geom(id).unwrap();
    expect_words(&geom.position(), "4115e503 41b128fe");
    assert_eq!(geom.rotation(), 0.75);
    expect_words(&(geom.matrix().m11, geom.matrix().m12), "3f3b4ff6 3f2e7fe1");
    let world = "41096302 41a06680 40e7260c 41ac1b80 41226704 41c1eb7c 41383700 41b6367c";
    expect_words(&*geom.world_vertices(), world);
    let inverse = geom.matrix_inverse();
    expect_words(&(inverse.m41, inverse.m42), "c1af98e9 c11d1406");
    expect_words(&geom.grid_cell_size(), "3ed6864d");
    let local = geom.transform_to_local_coordinates(v(10.0, 22.0));
    expect_words(&local, "3eb9ffc0 bf096000");
    expect_words(&geom.get_world_position(local), "41200000 41b00001");
    expect_words(&geom.transform_normal_to_world(v(0.0, 1.0)), "bf2e7fe1 3f3b4ff6");
    assert!(simulator.geom_collides_with_point(id, v(10.0, 22.0)));
    assert!(!simulator.geom_collides_with_point(id, v(100.0, 100.0)));
}

/// Check 13.
#[test]
fn the_distance_to_an_outline_is_negative_inside() {
    let (simulator, id) = offset_geom();
    let geom: GeomRef<'_> = simulator.geom(id).unwrap();
    for (point, distance) in [
        (v(0.0, 0.0), "bf800000"),
        (v(3.0, 2.0), "3fb504f3"),
        (v(2.0, 0.5), "00000000"),
        (v(1.5, 0.25), "bf000000"),
        (v(2.0, 1.0), "00000000"),
    ] {
        expect_words(&geom.get_nearest_distance(point), distance);
    }
    let feature = geom.get_nearest_feature(v(1.5, 0.25), 2);
    assert_eq!((feature.position, feature.normal, feature.distance), (v(2.0, 0.25), v(1.0, 0.0), 0.5));
}

/// Check 15 and section 3.12.
#[test]
fn a_geom_that_is_no_sensor_makes_its_body_dynamic() {
    for methods in both_sets() {
        let mut simulator = simulator_with(0.0, methods);
        let (body, geom) = add_box(&mut simulator, (10.0, 10.0), v(0.0, 0.0));
        simulator[body].set_is_static(true);
        simulator.set_is_sensor(geom, false).unwrap();
        assert!(!simulator[body].is_static());
        simulator.set_is_sensor(geom, true).unwrap();
        assert!(simulator[body].is_static() && simulator.geom(geom).unwrap().is_sensor());
        assert!(!simulator[geom].collision_response_enabled());
        simulator.set_is_sensor(geom, false).unwrap();
        assert!(simulator[geom].collision_response_enabled() && !simulator[body].is_static());
    }
}

/// Check 15 and section 3.4.
#[test]
fn a_clone_shares_the_grid_and_copies_the_settings() {
    let mut simulator = simulator(0.0);
    let (body, source) = add_box(&mut simulator, (10.0, 10.0), v(0.0, 0.0));
    let (_, other) = add_box(&mut simulator, (10.0, 10.0), v(50.0, 0.0));
    simulator[source].set_friction_coefficient(0.3);
    simulator[source].set_restitution_coefficient(0.4);
    simulator[source].set_collision_group(5);
    simulator[source].set_collision_enabled(false);
    simulator[source].set_tag(9);
    simulator.set_is_sensor(source, true).unwrap();
    simulator.ignore_collision_with(source, other).unwrap();
    let clone = simulator.clone_geom(body, source).unwrap();
    let [source, clone, other] = [source, clone, other].map(|geom| simulator.geom(geom).unwrap());
    assert_eq!(clone.id(), other.id() + 1);
    assert_eq!(clone.grid_cell_size(), source.grid_cell_size());
    assert!(std::ptr::eq(clone.distance_grid().unwrap(), source.distance_grid().unwrap()));
    assert_eq!((clone.friction_coefficient(), clone.restitution_coefficient()), (0.3, 0.4));
    assert_eq!((clone.collision_group(), clone.collision_enabled()), (5, false));
    assert!(!clone.collision_response_enabled());
    assert_eq!((clone.tag(), clone.is_sensor(), clone.is_geometry_ignored(other)), (0, false, false));
}

/// Check 15: the original throws on the automatic cell size as well.
#[test]
fn flat_outlines_need_a_cell_size() {
    for points in [vec![v(1.0, 1.0)], vec![v(0.0, 0.0), v(5.0, 0.0)]] {
        let (mut simulator, body) = with_body();
        let outline: Vertices = points.into_iter().collect();
        let automatic = simulator.create_geom(body, outline.clone(), GeomPlacement::default());
        assert!(matches!(automatic, Err(Error::InvalidArgument { argument: "collision_grid_size", .. })));
        assert!(simulator.create_geom(body, outline, GeomPlacement::with_grid_size(1.0)).is_ok());
    }
}

/// Section 3.5.
#[test]
fn a_new_outline_lies_at_the_origin_until_the_body_moves() {
    let mut simulator = simulator(0.0);
    let (body, geom) = add_box(&mut simulator, (10.0, 10.0), v(100.0, 0.0));
    simulator.process_added_and_removed();
    let outline = Vertices::create_simple_rectangle(2.0, 4.0).unwrap();
    simulator.set_vertices(geom, outline.clone()).unwrap();
    assert_eq!(*simulator.geom(geom).unwrap().world_vertices(), outline);
    assert_eq!(simulator.geom(geom).unwrap().aabb().min, v(-1.0, -2.0));
    assert_eq!(simulator.geom(geom).unwrap().distance_grid().unwrap().outline().len(), 16);
    simulator[body].set_position(v(100.0, 0.0));
    assert_eq!(simulator.geom(geom).unwrap().aabb().min, v(99.0, -2.0));
}

/// Section 3.7.
#[test]
fn a_matrix_lasts_until_the_body_moves() {
    for methods in both_sets() {
        let mut simulator = simulator_with(0.0, methods);
        let (body, geom) = add_box(&mut simulator, (10.0, 10.0), v(100.0, 0.0));
        simulator.process_added_and_removed();
        let mut moved = Matrix::identity();
        moved.m41 = 7.0;
        simulator.set_matrix(geom, &moved).unwrap();
        let placed = simulator.geom(geom).unwrap();
        assert_eq!((placed.aabb().min, placed.position()), (v(2.0, -5.0), v(100.0, 0.0)));
        simulator[body].set_position(v(50.0, 0.0));
        assert_eq!(simulator.geom(geom).unwrap().aabb().min, v(45.0, -5.0));
    }
}

#[test]
fn a_geom_moved_to_another_body_lies_there_at_once() {
    for methods in both_sets() {
        let mut simulator = simulator_with(0.0, methods);
        let (body, geom) = add_box(&mut simulator, (10.0, 10.0), v(100.0, 0.0));
        let (other, _) = add_box(&mut simulator, (10.0, 10.0), v(0.0, 50.0));
        simulator.set_body(geom, other).unwrap();
        assert_eq!(simulator.geom(geom).unwrap().position(), v(0.0, 50.0));
        assert_eq!((simulator.geoms_of(body).len(), simulator.geoms_of(other).len()), (0, 2));
        simulator[other].set_position(v(0.0, 70.0));
        assert_eq!(simulator.geom(geom).unwrap().position(), v(0.0, 70.0));
        simulator.update(0.01);
        assert_eq!(pairs(&simulator), [], "geoms of one body do not collide");
    }
}

/// Section 3.11.
#[test]
fn ignoring_is_one_sided_and_taken_back_on_its_own_side() {
    for methods in both_sets() {
        let mut simulator = simulator_with(0.0, methods);
        let (_, a) = add_box(&mut simulator, (10.0, 10.0), v(0.0, 0.0));
        let (_, b) = add_box(&mut simulator, (10.0, 10.0), v(9.0, 1.0));
        simulator.ignore_collision_with(a, b).unwrap();
        let ignored = |simulator: &PhysicsSimulator| {
            let (a, b) = (simulator.geom(a).unwrap(), simulator.geom(b).unwrap());
            (a.is_geometry_ignored(b), b.is_geometry_ignored(a))
        };
        assert_eq!(ignored(&simulator), (true, false));
        simulator.update(0.01);
        assert_eq!(pairs(&simulator), []);
        simulator.restore_collision_with(b, a).unwrap();
        assert_eq!(ignored(&simulator), (true, false));
        simulator.restore_collision_with(a, b).unwrap();
        assert_eq!(ignored(&simulator), (false, false));
        simulator.update(0.01);
        assert_eq!(pairs(&simulator), [(0, 1)]);
    }
}

/// Section 3.3: a geom made under SAT has no grid, keeps the cell size it was given, and cannot be cloned under
/// the distance grid.
#[test]
fn geoms_made_under_sat_have_no_grid() {
    let (mut simulator, body) = with_body();
    simulator.set_narrow_phase_collider(NarrowPhaseCollider::Sat);
    let outline = Vertices::create_rectangle(10.0, 10.0).unwrap();
    let geom = simulator.create_geom(body, outline, GeomPlacement::with_grid_size(-3.0)).unwrap();
    assert!(simulator.geom(geom).unwrap().distance_grid().is_none());
    assert_eq!(simulator.geom(geom).unwrap().grid_cell_size(), -3.0);
    assert!(simulator.clone_geom(body, geom).is_ok());
    simulator.set_narrow_phase_collider(NarrowPhaseCollider::DistanceGrid);
    let refused = simulator.clone_geom(body, geom);
    assert_eq!(refused, Err(Error::MissingDistanceGrid { argument: "geom" }));
}

#[test]
fn empty_outlines_and_stale_bodies_are_refused() {
    let (mut simulator, body) = with_body();
    let outline = Vertices::create_rectangle(10.0, 10.0).unwrap();
    let empty = simulator.create_geom(body, Vertices::default(), GeomPlacement::default());
    assert!(matches!(empty, Err(Error::InvalidArgument { argument: "vertices", .. })));
    simulator.dispose(body).unwrap();
    simulator.process_added_and_removed();
    let stale = simulator.create_geom(body, outline, GeomPlacement::default());
    assert_eq!(stale, Err(Error::StaleId { argument: "body" }));
}
