//! Segments against segments, outlines and boxes (behaviour chapter 09) against the record.

use conformance::units::{assert_words, check};
use farseer_core::math::Vector2;
use farseer_core::ray_helper;
use farseer_core::shape::Aabb;

#[test]
fn lines_cross_as_recorded() {
    check("rays", "LineIntersect", |case| {
        let [p1, p2, p3, p4] = ["p1", "p2", "p3", "p4"].map(|key| case.input.vector(key));
        let first_is_segment = case.input.boolean("first_is_segment");
        let second_is_segment = case.input.boolean("second_is_segment");
        let crossing = ray_helper::line_intersect_with(p1, p2, p3, p4, first_is_segment, second_is_segment);
        case.expect_bool("hit", crossing.is_some());
        case.expect("point", &crossing.unwrap_or(Vector2::new(0.0, 0.0)));
        if first_is_segment && second_is_segment {
            assert_eq!(ray_helper::line_intersect(p1, p2, p3, p4), crossing);
        }
    });
}

#[test]
fn segments_cross_outlines_as_recorded() {
    check("rays", "LineSegmentVerticesIntersect", |case| {
        let (p1, p2) = (case.input.vector("p1"), case.input.vector("p2"));
        let mut points = Vec::new();
        ray_helper::line_segment_vertices_intersect(p1, p2, &case.input.vertices("vertices"), &mut points);
        case.expect("points", &points);
    });
}

#[test]
fn segments_cross_boxes_as_recorded() {
    check("rays", "LineSegmentAABBIntersect", |case| {
        let (p1, p2) = (case.input.vector("p1"), case.input.vector("p2"));
        let aabb = Aabb::new(case.input.vector("min"), case.input.vector("max"));
        let mut points = Vec::new();
        ray_helper::line_segment_aabb_intersect(p1, p2, &aabb, &mut points);
        case.expect("points", &points);
    });
}

fn p(x: f32, y: f32) -> Vector2 {
    Vector2::new(x, y)
}

/// Whether and where two segments cross, as coordinates.
fn crossing(first: [f32; 4], second: [f32; 4]) -> Option<(f32, f32)> {
    let [a, b, c, d] = first;
    let [e, f, g, h] = second;
    ray_helper::line_intersect(p(a, b), p(c, d), p(e, f), p(g, h)).map(|v| (v.x, v.y))
}

const LEVEL: [f32; 4] = [0.0, 0.0, 10.0, 0.0];

#[test]
fn segments_that_cross_meet_in_a_point() {
    assert_eq!(crossing([0.0, 0.0, 10.0, 10.0], [0.0, 10.0, 10.0, 0.0]), Some((5.0, 5.0)));
    assert_eq!(crossing([0.0, 0.0, 3.0, 7.0], [-1.0, 2.0, 4.0, 3.0]), Some((1.03125, 2.40625)));
}

#[test]
fn the_start_of_either_segment_is_not_part_of_it() {
    assert_eq!(crossing(LEVEL, [0.0, -5.0, 0.0, 5.0]), None);
    assert_eq!(crossing(LEVEL, [5.0, 0.0, 5.0, 5.0]), None);
}

#[test]
fn the_end_of_either_segment_is_part_of_it() {
    assert_eq!(crossing(LEVEL, [10.0, -5.0, 10.0, 5.0]), Some((10.0, 0.0)));
    assert_eq!(crossing(LEVEL, [5.0, -5.0, 5.0, 0.0]), Some((5.0, 0.0)));
}

#[test]
fn parallel_segments_do_not_cross() {
    assert_eq!(crossing(LEVEL, [0.0, 1.0, 10.0, 1.0]), None);
    assert_eq!(crossing(LEVEL, [2.0, 0.0, 8.0, 0.0]), None);
}

#[test]
fn short_segments_count_as_parallel() {
    assert_eq!(crossing([0.0, 0.0, 0.003, 0.0], [0.001, -0.001, 0.001, 0.002]), None);
}

#[test]
fn a_line_goes_on_beyond_its_points() {
    let level = (p(0.0, 0.0), p(10.0, 0.0));
    let line = |c, d, first, second| ray_helper::line_intersect_with(level.0, level.1, c, d, first, second);
    assert_eq!(line(p(20.0, -5.0), p(20.0, 5.0), false, true), Some(p(20.0, 0.0)));
    assert_eq!(line(p(20.0, -5.0), p(20.0, 5.0), true, true), None);
    assert_eq!(line(p(5.0, 3.0), p(5.0, 9.0), true, false), Some(p(5.0, 0.0)));
}

/// A square of ten units about the origin: behaviour chapter 09, checks 7 to 10.
fn square_crossings(from: Vector2, to: Vector2) -> Vec<Vector2> {
    let square = Aabb::new(p(-5.0, -5.0), p(5.0, 5.0));
    let mut points = Vec::new();
    ray_helper::line_segment_aabb_intersect(from, to, &square, &mut points);
    points
}

#[test]
fn crossings_with_a_box_come_in_the_order_of_its_sides() {
    let crossings = square_crossings(p(-10.0, 1.0), p(40.0, 2.0));
    assert_words(&crossings, "c0a00000 3f8cccd0 40a00000 3fa66666");
    assert_eq!(square_crossings(p(0.0, -20.0), p(-10.0, 30.0)), [p(-5.0, 5.0), p(-3.0, -5.0)]);
}

#[test]
fn a_corner_is_crossed_once() {
    assert_eq!(square_crossings(p(-10.0, -10.0), p(10.0, 10.0)), [p(5.0, 5.0), p(-5.0, -5.0)]);
    assert_eq!(square_crossings(p(-10.0, 5.0), p(40.0, 5.0)), [p(-5.0, 5.0)]);
}

#[test]
fn crossings_are_appended() {
    let mut points = vec![p(1.0, 2.0)];
    let square = Aabb::new(p(-5.0, -5.0), p(5.0, 5.0));
    ray_helper::line_segment_aabb_intersect(p(0.0, 0.0), p(40.0, 0.0), &square, &mut points);
    assert_eq!(points, [p(1.0, 2.0), p(5.0, 0.0)]);
}

#[test]
fn values_in_range_include_its_ends_but_not_nan() {
    assert!(ray_helper::float_in_range(1.0, 1.0, 1.0));
    assert!(!ray_helper::float_in_range(f32::NAN, 0.0, 1.0));
    assert!(ray_helper::float_equals(1.0, 1.5, 0.5));
    assert!(!ray_helper::float_equals(1.0, 1.6, 0.5));
}
