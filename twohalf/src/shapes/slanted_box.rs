//! The shape of platforms, which is the core's: closed forms, and comparisons with searches and marches.

use farseer_core::math::{Vector3, scalar};

use super::{Face, SlantedBox};
use crate::shapes::samples::Random;

fn vector(numbers: &mut Random, scale: f32) -> Vector3 {
    let mut number = || numbers.number(-scale, scale);
    Vector3::new(number(), number(), number())
}

/// Level, tilted and sheared boxes at some distance from the origin.
pub(in crate::shapes) fn shape(numbers: &mut Random, round: usize) -> SlantedBox {
    let angle = [0.0, numbers.number(-4.0, 4.0), numbers.number(-0.1, 0.1)][round % 3];
    let (sin, cos) = scalar::sin_cos(angle);
    let shear = [0.0, numbers.number(-2.0, 2.0)][round % 2];
    let half = [0; 3].map(|_| numbers.number(10.0, 50.0));
    SlantedBox { centre: vector(numbers, 200.0), half, cos, sin, shear, ..SlantedBox::default() }
}

/// Level, tilted and sheared boxes, of which some climb along z and some are turned about an upright axis.
fn turned(numbers: &mut Random, round: usize) -> SlantedBox {
    let shape = shape(numbers, round);
    let (sin, cos) = scalar::sin_cos(numbers.number(-4.0, 4.0));
    let climb = numbers.number(-1.5, 1.5);
    match round / 6 % 4 {
        1 => SlantedBox { climb, ..shape },
        2 => SlantedBox { turn: [cos, sin], ..shape },
        3 => SlantedBox { climb, turn: [cos, sin], ..shape },
        _ => shape,
    }
}

/// Squared distance to the rectangle at a depth from the centre, in f64.
fn squared_distance_at(shape: &SlantedBox, point: Vector3, deep: f64) -> f64 {
    let offset = (point - shape.centre).map(f64::from);
    let [width, height, _] = shape.half.map(f64::from);
    let (cos, sin, turn) = (f64::from(shape.cos), f64::from(shape.sin), shape.turn.map(f64::from));
    let x = turn[0] * offset.x + turn[1] * offset.z - f64::from(shape.shear) * deep;
    let y = offset.y + f64::from(shape.climb) * deep;
    let z = turn[0] * offset.z - turn[1] * offset.x;
    let across = x * cos + y * sin;
    let down = y * cos - x * sin;
    let (across, down) = (across.abs() - width, down.abs() - height);
    across.max(0.0).powi(2) + down.max(0.0).powi(2) + (z - deep).powi(2)
}

/// Distance of a point from a box by ternary search over the depth, where the distance is convex.
fn distance_by_search(shape: &SlantedBox, point: Vector3) -> f64 {
    let (mut low, mut high) = (-f64::from(shape.half[2]), f64::from(shape.half[2]));
    for _ in 0..100 {
        let (a, b) = (low + (high - low) / 3.0, high - (high - low) / 3.0);
        if squared_distance_at(shape, point, a) < squared_distance_at(shape, point, b) {
            high = b;
        } else {
            low = a;
        }
    }
    squared_distance_at(shape, point, low).sqrt()
}

const DISPLACED_LEVEL_BOX: SlantedBox = SlantedBox {
    centre: Vector3::new(10.0, -20.0, 30.0),
    half: [50.0, 20.0, 15.0],
    cos: 1.0,
    sin: 0.0,
    shear: 0.0,
    climb: 0.0,
    turn: [1.0, 0.0],
};

#[test]
fn distances_outside_are_those_of_a_search_over_the_depth() {
    let mut numbers = Random(1);
    let mut outside = 0;
    for round in 0..3000 {
        let shape = turned(&mut numbers, round);
        let point = shape.centre + vector(&mut numbers, 150.0);
        let (distance, normal) = shape.nearest(point).unwrap();
        let expected = distance_by_search(&shape, point);
        if expected < 1e-3 {
            continue;
        }
        outside += 1;
        // Coordinates up to 350 have an error of 2e-5; a shear of 2 and a few operations make it ten times that.
        assert!((f64::from(distance) - expected).abs() < 5e-4, "{distance} {expected}");
        assert!((normal.norm() - 1.0).abs() < 1e-5);
        // The point on the surface is one: the way back ends there.
        assert!(distance_by_search(&shape, point - normal * distance) < 2e-3);
    }
    assert!(outside > 2000);
}

#[test]
fn inside_no_exit_is_shorter_than_the_distance() {
    let mut numbers = Random(2);
    for round in 0..300 {
        let shape = turned(&mut numbers, round);
        let point = shape.centre + vector(&mut numbers, 15.0);
        if !shape.contains(point) {
            continue;
        }
        let (distance, normal) = shape.nearest(point).unwrap();
        assert!(distance <= 0.0);
        assert!(!shape.contains(point + normal * (1e-3 - distance)));
        for _ in 0..50 {
            let direction = vector(&mut numbers, 1.0);
            assert!(shape.contains(point + direction.normalize() * (-distance - 1e-3).max(0.0)));
        }
    }
}

#[test]
fn a_point_above_a_level_box_has_its_height_as_distance() {
    let (distance, normal) = DISPLACED_LEVEL_BOX.nearest(Vector3::new(0.0, -45.0, 35.0)).unwrap();
    assert_eq!((distance, normal), (5.0, Vector3::new(0.0, -1.0, 0.0)));
}

#[test]
fn a_sheared_sides_normal_leans_towards_its_depth() {
    // At depth dz the right side is at x = 60 + dz; its normal (1, 0, -1) / sqrt(2).
    let shape = SlantedBox { shear: 1.0, ..DISPLACED_LEVEL_BOX };
    let (distance, normal) = shape.nearest(Vector3::new(62.0, -20.0, 30.0)).unwrap();
    let half_root = 0.5f32.sqrt();
    assert!((distance - 2.0 * half_root).abs() < 1e-6);
    assert!((normal - Vector3::new(half_root, 0.0, -half_root)).norm() < 1e-6);
}

#[test]
fn the_bounds_are_those_of_the_corners() {
    let mut numbers = Random(3);
    for round in 0..100 {
        let shape = turned(&mut numbers, round);
        let (low, high) = shape.bounds();
        let corners = shape.corners();
        let least = |axis: usize| corners.iter().fold(f32::INFINITY, |least, c| least.min(c[axis]));
        let greatest = |axis: usize| corners.iter().fold(-f32::INFINITY, |most, c| most.max(c[axis]));
        for axis in 0..3 {
            let ends = [least(axis) - low[axis], high[axis] - greatest(axis)];
            // For a box that is tilted or leaning and also rotated, they are not the least ones.
            let is_exact = !shape.is_turned() || (shape.sin == 0.0 && shape.shear == 0.0);
            assert!(ends.iter().all(|end| *end > -1e-3 && (*end < 1e-3 || !is_exact)));
        }
        assert!(corners.iter().all(|&corner| shape.nearest(corner).unwrap().0.abs() < 1e-3));
    }
}

#[test]
fn the_rectangle_is_wound_as_the_engine_winds_outlines() {
    let corners = SlantedBox { cos: 0.6, sin: 0.8, ..DISPLACED_LEVEL_BOX }.rectangle();
    let products = (0..4).map(|i| (corners[i], corners[(i + 1) % 4])).map(|(a, b)| a.x * b.y - a.y * b.x);
    assert!(products.sum::<f32>() < 0.0);
}

#[test]
fn the_entry_face_is_where_a_march_along_the_path_first_gets_inside() {
    let mut numbers = Random(4);
    let mut entered = 0;
    for round in 0..2000 {
        let shape = turned(&mut numbers, round);
        let (before, now) =
            (shape.centre + vector(&mut numbers, 120.0), shape.centre + vector(&mut numbers, 60.0));
        const STEPS: i32 = 2000;
        let at = |step: i32| before + (now - before) * (step as f32 / STEPS as f32);
        let first = (0..=STEPS).find(|&step| shape.contains(at(step)));
        match (first, shape.entry_face(before, now)) {
            (Some(0), face) => assert_eq!(face, None),
            (Some(step), Some(face)) => {
                entered += 1;
                // The way crosses the face's plane during this step.
                assert!(shape.distance_to_face(face, at(step)) <= 1e-3);
                assert!(shape.distance_to_face(face, at(step - 1)) >= -1e-3);
            }
            (None, None) => {}
            // A way through a corner may be shorter than a step of the march.
            (None, Some(_)) => assert!(distance_to_path(&shape, before, now) < 0.1),
            (Some(_), None) => panic!("{shape:?} {before:?} {now:?}"),
        }
    }
    assert!(entered > 300);
}

fn distance_to_path(shape: &SlantedBox, before: Vector3, now: Vector3) -> f32 {
    let distance = |step: i32| shape.nearest(before + (now - before) * (step as f32 / 2000.0)).unwrap().0;
    (0..=2000).map(distance).fold(f32::INFINITY, f32::min)
}

#[test]
fn a_ball_whose_centre_came_in_through_the_top_leaves_there() {
    // 2 from the left side, 18 below the top: by distance alone it would leave on the left.
    let (before, now) = (Vector3::new(-38.0, -60.0, 30.0), Vector3::new(-38.0, -22.0, 30.0));
    let touch = DISPLACED_LEVEL_BOX.ball_touch(now, before, 5.0, None).unwrap();
    assert_eq!(touch.normal, Vector3::new(0.0, -1.0, 0.0));
    assert_eq!(touch.separation, -23.0);
    assert_eq!(touch.face, Some(Face::Top));
    assert_eq!(touch.point, Vector3::new(-38.0, -17.0, 30.0));
    let next = DISPLACED_LEVEL_BOX.ball_touch(now, now, 5.0, touch.face).unwrap();
    assert_eq!(next, touch);
}

#[test]
fn a_ball_at_rest_inside_leaves_through_the_nearest_face() {
    let centre = Vector3::new(-38.0, -22.0, 30.0);
    assert_eq!(DISPLACED_LEVEL_BOX.ball_touch(centre, centre, 5.0, None).unwrap().face, Some(Face::Left));
}

#[test]
fn a_ball_outside_keeps_no_face() {
    let touch = DISPLACED_LEVEL_BOX
        .ball_touch(Vector3::new(0.0, -43.0, 30.0), Vector3::zeros(), 5.0, Some(Face::Left))
        .unwrap();
    assert_eq!((touch.separation, touch.face), (-2.0, None));
}

#[test]
fn a_ball_that_only_touches_does_not_overlap() {
    assert_eq!(
        DISPLACED_LEVEL_BOX.ball_touch(Vector3::new(0.0, -45.0, 30.0), Vector3::zeros(), 5.0, None),
        None
    );
}

#[test]
fn the_top_on_a_vertical_line_is_where_a_march_down_first_gets_inside() {
    let mut numbers = Random(5);
    let mut hits = 0;
    for round in 0..1000 {
        let shape = turned(&mut numbers, round);
        let over = shape.centre + vector(&mut numbers, 40.0);
        let (low, high) = shape.bounds();
        let at = |step: i32| Vector3::new(over.x, low.y + (high.y - low.y) * (step as f32 / 2000.0), over.z);
        let first = (0..=2000).find(|&step| shape.contains(at(step)));
        match (first, shape.height_at(over.x, over.z)) {
            (Some(step), Some((y, normal))) => {
                hits += 1;
                assert!((y - at(step).y).abs() <= (high.y - low.y) / 2000.0 + 1e-3);
                let (distance, nearest) = shape.nearest(Vector3::new(over.x, y - 1e-2, over.z)).unwrap();
                // Its normal, except within a hundredth of an edge.
                assert!(normal.dot(&nearest) > 0.99 || distance < 1e-2);
                assert!(normal.y < 0.0);
            }
            (None, None) => {}
            (None, Some((y, _))) => {
                // Only a corner that is thinner than a step.
                assert!(!shape.contains(Vector3::new(over.x, y + (high.y - low.y) / 1000.0, over.z)));
            }
            (Some(_), None) => panic!("{shape:?} {over:?}"),
        }
    }
    assert!(hits > 300);
}

#[test]
fn a_line_beside_the_box_has_no_top() {
    assert_eq!(DISPLACED_LEVEL_BOX.height_at(61.0, 30.0), None);
    assert_eq!(DISPLACED_LEVEL_BOX.height_at(0.0, 46.0), None);
}

#[test]
fn non_finite_shapes_touch_nothing() {
    for point in [Vector3::new(f32::NAN, 0.0, 0.0), Vector3::new(f32::INFINITY, 0.0, 0.0)] {
        for shape in
            [DISPLACED_LEVEL_BOX, SlantedBox { shear: 0.5, ..DISPLACED_LEVEL_BOX }, SlantedBox::default()]
        {
            assert_eq!(shape.nearest(point), None);
            assert_eq!(shape.ball_touch(point, point, 5.0, None), None);
            assert_eq!(shape.height_at(point.x, point.z), None);
        }
    }
}

#[test]
fn a_box_without_size_is_a_point() {
    let (distance, normal) = SlantedBox::default().nearest(Vector3::new(3.0, 0.0, 4.0)).unwrap();
    assert!((distance - 5.0).abs() < 1e-6);
    assert!((normal - Vector3::new(0.6, 0.0, 0.8)).norm() < 1e-6);
    assert!(SlantedBox::default().nearest(Vector3::zeros()).is_some());
}
