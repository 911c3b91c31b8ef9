//! Ray casts, boxes and overlaps.

use conformance::fixtures::plane::{
    Random, add_box, add_circle, add_floor, both_sets, lively_scene, simulator, simulator_with, v,
};
use farseer_core::math::{Matrix, Vector2};
use farseer_core::{
    Aabb, BodyFactory, GeomFactory, GeomId, GeomPlacement, Methods, PhysicsSimulator, Vertices,
};
use proptest::prelude::*;

/// Boxes of 10 units at these positions.
fn boxes(places: &[Vector2]) -> (PhysicsSimulator, Vec<GeomId>) {
    let mut simulator = simulator(0.0);
    let geoms = places.iter().map(|&place| add_box(&mut simulator, (10.0, 10.0), place).1).collect();
    simulator.process_added_and_removed();
    (simulator, geoms)
}

#[test]
fn a_ray_hits_the_nearest_geom() {
    let (simulator, geoms) = boxes(&[v(100.0, 0.0), v(50.0, 0.0), v(20.0, 30.0)]);
    let hit = simulator.ray_cast(v(0.0, 2.0), v(90.0, 2.0)).unwrap();
    assert_eq!((hit.geom, hit.point, hit.normal), (geoms[1], v(45.0, 2.0), v(-1.0, 0.0)));
    assert_eq!(hit.fraction, 0.5);
}

#[test]
fn normals_look_outward_on_every_side() {
    let (simulator, _) = boxes(&[v(0.0, 0.0)]);
    for normal in [v(1.0, 0.0), v(0.0, 1.0), v(-1.0, 0.0), v(0.0, -1.0)] {
        let hit = simulator.ray_cast(normal * 20.0, v(0.0, 0.0)).unwrap();
        assert_eq!((hit.normal, hit.point), (normal, normal * 5.0));
    }
}

#[test]
fn all_hits_come_sorted_by_fraction_and_then_in_list_order() {
    let (simulator, geoms) = boxes(&[v(60.0, 0.0), v(30.0, 0.0), v(30.0, 3.0), v(90.0, 0.0)]);
    let hits = simulator.ray_cast_all(v(0.0, 1.0), v(70.0, 1.0));
    let found: Vec<GeomId> = hits.iter().map(|hit| hit.geom).collect();
    assert_eq!(found, [geoms[1], geoms[2], geoms[0]]);
    assert_eq!(hits[0].fraction, hits[1].fraction);
}

#[test]
fn a_ray_ends_at_its_end() {
    let (simulator, _) = boxes(&[v(50.0, 0.0)]);
    assert!(simulator.ray_cast(v(0.0, 0.0), v(45.0, 0.0)).is_some_and(|hit| hit.fraction == 1.0));
    assert_eq!(simulator.ray_cast(v(0.0, 0.0), v(44.99, 0.0)), None);
    assert_eq!(simulator.ray_cast(v(60.0, 0.0), v(90.0, 0.0)), None);
}

#[test]
fn a_geom_around_the_start_is_not_hit() {
    let (simulator, geoms) = boxes(&[v(0.0, 0.0), v(30.0, 0.0)]);
    assert_eq!(simulator.ray_cast(v(0.0, 0.0), v(50.0, 0.0)).unwrap().geom, geoms[1]);
}

/// A U, from whose left arm the ray starts.
#[test]
fn a_hollow_outline_is_hit_where_the_ray_enters_it_again() {
    let mut simulator = simulator(0.0);
    let body = BodyFactory::create_rectangle_body_in(&mut simulator, 40.0, 40.0, 1.0).unwrap();
    let corners = [(-20, -20), (-10, -20), (-10, 10), (10, 10), (10, -20), (20, -20), (20, 20), (-20, 20)];
    let outline: Vertices = corners.iter().map(|&(x, y)| v(x as f32, y as f32)).collect();
    let geom = simulator.create_geom(body, outline, GeomPlacement::default()).unwrap();
    simulator.add(geom).unwrap();
    simulator.process_added_and_removed();
    let hit = simulator.ray_cast(v(-15.0, 0.0), v(35.0, 0.0)).unwrap();
    assert_eq!((hit.point, hit.normal), (v(10.0, 0.0), v(-1.0, 0.0)));
    assert_eq!(simulator.ray_cast_all(v(-30.0, 0.0), v(35.0, 0.0)).len(), 1);
}

#[test]
fn a_corner_is_no_gap() {
    let mut simulator = simulator(0.0);
    let (body, _) = add_box(&mut simulator, (10.0, 10.0), v(0.0, 0.0));
    simulator[body].set_rotation(std::f32::consts::FRAC_PI_4);
    simulator.process_added_and_removed();
    let geom = simulator.geom(simulator.geom_list()[0]).unwrap();
    for &vertex in geom.world_vertices().iter() {
        let hit = simulator.ray_cast(vertex * 3.0, vertex * -3.0).unwrap();
        // The vertex, and the roundings of the direction.
        approx::assert_abs_diff_eq!(hit.point.x, vertex.x, epsilon = 1e-5);
        approx::assert_abs_diff_eq!(hit.point.y, vertex.y, epsilon = 1e-5);
    }
}

#[test]
fn an_edited_body_is_hit_where_it_will_be() {
    let (mut simulator, geoms) = boxes(&[v(50.0, 0.0)]);
    let body = simulator.geom(geoms[0]).unwrap().body();
    simulator[body].set_position(v(0.0, 50.0));
    assert_eq!(simulator.ray_cast(v(0.0, 0.0), v(90.0, 0.0)), None);
    assert_eq!(simulator.ray_cast(v(0.0, 0.0), v(0.0, 90.0)).unwrap().point, v(0.0, 45.0));
    assert_eq!(simulator.query_aabb(&Aabb::new(v(-1.0, 40.0), v(1.0, 60.0))), geoms);
}

/// A matrix of the user may turn the winding round.
#[test]
fn a_mirrored_geom_has_outward_normals() {
    let (mut simulator, geoms) = boxes(&[v(0.0, 0.0)]);
    let mut mirror = Matrix::identity();
    mirror.m11 = -1.0;
    simulator.set_matrix(geoms[0], &mirror).unwrap();
    let hit = simulator.ray_cast(v(20.0, 1.0), v(-20.0, 1.0)).unwrap();
    assert_eq!((hit.point, hit.normal), (v(5.0, 1.0), v(1.0, 0.0)));
}

#[test]
fn rays_without_a_direction_or_end_have_no_hit() {
    let (simulator, _) = boxes(&[v(0.0, 0.0)]);
    for end in [v(-20.0, 0.0), v(f32::NAN, 0.0), v(f32::INFINITY, 0.0)] {
        assert_eq!(simulator.ray_cast(v(-20.0, 0.0), end), None);
        assert!(simulator.ray_cast_all(end, v(-20.0, 0.0)).is_empty());
    }
}

#[test]
fn boxes_that_touch_the_queried_box_are_found_in_list_order() {
    let (simulator, geoms) = boxes(&[v(100.0, 0.0), v(0.0, 0.0), v(30.0, 0.0)]);
    assert_eq!(simulator.query_aabb(&Aabb::new(v(5.0, -1.0), v(25.0, 1.0))), [geoms[1], geoms[2]]);
    assert_eq!(simulator.query_aabb(&Aabb::new(v(-200.0, -200.0), v(200.0, 200.0))), geoms);
    assert!(simulator.query_aabb(&Aabb::new(v(40.0, -1.0), v(50.0, 1.0))).is_empty());
    assert!(simulator.query_aabb(&Aabb::new(v(f32::NAN, -1.0), v(50.0, 1.0))).is_empty());
}

#[test]
fn an_inverted_box_contains_no_geom() {
    let (simulator, geoms) = boxes(&[v(0.0, 0.0)]);
    let (low, high) = (-1.0, 1.0);
    assert_eq!(simulator.query_aabb(&Aabb::new(v(low, low), v(high, high))), geoms);
    assert_eq!(simulator.query_aabb(&Aabb::new(v(low, low), v(low, low))), geoms);
    for (min, max) in [(v(high, low), v(low, high)), (v(low, high), v(high, low))] {
        assert!(simulator.query_aabb(&Aabb::new(min, max)).is_empty());
    }
}

#[test]
fn disposed_geoms_are_not_found_any_more() {
    let (mut simulator, geoms) = boxes(&[v(0.0, 0.0), v(30.0, 0.0)]);
    simulator.dispose(geoms[0]).unwrap();
    assert_eq!(simulator.geom_list(), geoms);
    assert_eq!(simulator.ray_cast(v(-20.0, 0.0), v(60.0, 0.0)).unwrap().geom, geoms[1]);
    assert_eq!(simulator.ray_cast_all(v(-20.0, 0.0), v(60.0, 0.0)).len(), 1);
    assert_eq!(simulator.query_aabb(&Aabb::new(v(-50.0, -50.0), v(50.0, 50.0))), geoms[1..]);
}

#[test]
fn a_sensor_lists_its_overlaps() {
    for methods in both_sets() {
        let mut simulator = simulator_with(0.0, methods);
        let (_, sensor) = add_floor(&mut simulator, (50.0, 50.0), v(0.0, 0.0));
        simulator.set_is_sensor(sensor, true).unwrap();
        let (inside, first) = add_circle(&mut simulator, 5.0, 16, v(-27.0, 0.0));
        let (_, second) = add_box(&mut simulator, (10.0, 10.0), v(25.0, 0.0));
        let (_, far) = add_box(&mut simulator, (10.0, 10.0), v(80.0, 0.0));
        simulator.update(0.01);
        let overlaps = |simulator: &PhysicsSimulator| simulator.overlaps(sensor);
        assert_eq!(overlaps(&simulator), [first, second]);
        assert_eq!((simulator.overlaps(second), simulator.overlaps(far)), (vec![sensor], vec![]));
        simulator[inside].set_position(v(-300.0, 0.0));
        simulator.update(0.01);
        assert_eq!(overlaps(&simulator), [second]);
        let gone = simulator.geom(far).unwrap().body();
        simulator.dispose(gone).unwrap();
        simulator.update(0.01);
        assert!(simulator.overlaps(far).is_empty());
    }
}

/// Boxes that overlap have an arbiter, whose list of contacts is empty as long as the outlines are apart.
#[test]
fn boxes_that_overlap_without_touching_are_no_overlap() {
    for methods in both_sets() {
        let mut simulator = simulator_with(0.0, methods);
        let (_, circle) = add_circle(&mut simulator, 10.0, 32, v(0.0, 0.0));
        let (_, other) = add_circle(&mut simulator, 10.0, 32, v(18.0, 18.0));
        simulator.update(0.01);
        let boxes = [circle, other].map(|geom| simulator.geom(geom).unwrap().aabb());
        assert!(Aabb::intersect(&boxes[0], &boxes[1]));
        assert!(simulator.overlaps(circle).is_empty());
    }
}

#[test]
fn hits_are_the_crossings_that_the_original_finds() {
    let mut simulator = lively_scene(Methods::default(), 7);
    for _ in 0..100 {
        simulator.update(0.01);
    }
    let mut random = Random::new(11);
    let mut hit_count = 0;
    for _ in 0..400 {
        let [start, end] = [(), ()].map(|()| v(random.between(-290.0, 290.0), random.between(-290.0, 290.0)));
        for hit in simulator.ray_cast_all(start, end) {
            let crossings = simulator.line_segment_geom_intersect(start, end, hit.geom, false);
            let nearest =
                crossings.iter().map(|&crossing| (crossing - hit.point).norm()).fold(f32::MAX, f32::min);
            // The original's crossing is rounded about ten times at coordinates below 512.
            assert!(nearest < 10.0 * 512.0 * f32::EPSILON, "{nearest} from {start:?} to {end:?}");
            assert!(hit.normal.dot(&(end - start)) < 0.0);
            hit_count += 1;
        }
    }
    assert!(hit_count > 200, "{hit_count}");
}

proptest! {
    #[test]
    fn a_hit_lies_on_the_ray_and_on_the_outline(
        start in (-50.0_f32..50.0, -50.0_f32..50.0),
        end in (-50.0_f32..50.0, -50.0_f32..50.0),
        angle in 0.0_f32..6.0,
    ) {
        let (start, end) = (v(start.0, start.1), v(end.0, end.1));
        let mut simulator = simulator(0.0);
        let body = BodyFactory::create_rectangle_body_in(&mut simulator, 30.0, 20.0, 1.0).unwrap();
        simulator[body].set_rotation(angle);
        GeomFactory::create_rectangle_geom_in(&mut simulator, body, 30.0, 20.0, GeomPlacement::default()).unwrap();
        simulator.process_added_and_removed();
        if let Some(hit) = simulator.ray_cast(start, end) {
            // Coordinates below 64 are rounded to 4e-6 at worst, a few times.
            let on_ray = start + (end - start) * hit.fraction;
            approx::assert_abs_diff_eq!(on_ray, hit.point, epsilon = 1e-4);
            let local = simulator[body].get_local_position(hit.point);
            let depth = (local.x.abs() - 15.0).max(local.y.abs() - 10.0);
            approx::assert_abs_diff_eq!(depth, 0.0, epsilon = 1e-4);
            approx::assert_abs_diff_eq!(hit.normal.norm(), 1.0, epsilon = 1e-6);
            prop_assert!(hit.normal.dot(&(end - start)) < 0.0);
        }
    }

    /// The ends of such a ray are farther out than the corners.
    #[test]
    fn a_ray_through_the_middle_always_hits(way in 0.0_f32..6.3, angle in 0.0_f32..6.0) {
        let mut simulator = simulator(0.0);
        let (body, _) = add_box(&mut simulator, (30.0, 20.0), v(0.0, 0.0));
        simulator[body].set_rotation(angle);
        simulator.process_added_and_removed();
        let start = v(30.0 * way.cos(), 30.0 * way.sin());
        prop_assert!(simulator.ray_cast(start, -start).is_some());
        prop_assert!(simulator.ray_cast(start, start * 2.0).is_none());
    }
}
