//! Separating axis test of two convex outlines, with the time since entry.
//!
//! Frame: the plane's. Separating axis theorem (Gottschalk, Lin and Manocha, *OBBTree*, 1996; Ericson,
//! *Real-Time Collision Detection*, 5.5.8 for moving shapes). Two convex outlines overlap if their
//! projections on the normals of all edges do. The overlap began when the last of these axes was entered.
//! Either winding is allowed.

use farseer_core::math::{Vector2, vector2};

use super::edges;

/// Overlap of two outlines.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct SatOverlap {
    /// Time since the outlines began to overlap, steps, at the motion of the last step; infinite if they do not approach.
    pub(crate) time: f32,
    /// Least penetration over all edge normals, px.
    pub(crate) penetration: f32,
    /// Unit normal of the least penetration, from the first to the second outline.
    pub(crate) normal: Vector2,
}

/// Projection of points on an axis, `(least, greatest)`, px.
fn project(points: &[Vector2], axis: Vector2) -> (f32, f32) {
    points.iter().fold((f32::INFINITY, f32::NEG_INFINITY), |(least, greatest), point| {
        let along = vector2::dot(*point, axis);
        (least.min(along), greatest.max(along))
    })
}

/// Overlap of two convex outlines with a relative motion; `None` if they do not overlap, or only touch.
pub(crate) fn entry(a: &[Vector2], b: &[Vector2], motion_of_b: Vector2) -> Option<SatOverlap> {
    let mut found: Option<SatOverlap> = None;
    for (start, end) in edges(a).chain(edges(b)) {
        let edge = end - start;
        let length = vector2::length(edge);
        if length <= 0.0 {
            continue;
        }
        let axis = Vector2::new(-edge.y / length, edge.x / length);
        let (min_a, max_a) = project(a, axis);
        let (min_b, max_b) = project(b, axis);
        for (penetration, normal) in [(max_a - min_b, axis), (max_b - min_a, -axis)] {
            if !(penetration > 0.0 && penetration.is_finite()) {
                return None;
            }
            let closing = -vector2::dot(motion_of_b, normal);
            let time = if closing > 0.0 { penetration / closing } else { f32::INFINITY };
            found = Some(match found {
                None => SatOverlap { time, penetration, normal },
                Some(found) if penetration < found.penetration => {
                    SatOverlap { time: found.time.min(time), penetration, normal }
                }
                Some(found) => SatOverlap { time: found.time.min(time), ..found },
            });
        }
    }
    found
}

/// Overlap of two outlines of convex pieces: time since the first pair of pieces overlaps, and penetration of
/// the deepest pair. `b` returns the pieces of the second outline anew for each piece of the first.
pub(crate) fn entry_of_pieces<'a, I, J>(a: I, b: impl Fn() -> J, motion_of_b: Vector2) -> Option<SatOverlap>
where
    I: Iterator<Item = &'a [Vector2]>,
    J: Iterator<Item = &'a [Vector2]>,
{
    let mut found: Option<SatOverlap> = None;
    for piece_a in a {
        for piece_b in b() {
            let Some(pair) = entry(piece_a, piece_b, motion_of_b) else { continue };
            let deepest = found.filter(|found| found.penetration >= pair.penetration).unwrap_or(pair);
            let time = found.map_or(pair.time, |found| found.time.max(pair.time));
            found = Some(SatOverlap { time, ..deepest });
        }
    }
    found
}

#[cfg(test)]
mod tests {
    use super::super::samples::{Random, points, rectangle};
    use super::*;

    fn moved(outline: &[Vector2], by: Vector2) -> Vec<Vector2> {
        outline.iter().map(|vertex| vertex + by).collect()
    }

    #[test]
    fn a_box_on_the_edge_of_another_has_entered_from_above() {
        // 2 wide and 15 deep in the corner, falling at 16 per step of 1.
        let floor = rectangle((0.0, 0.0), 100.0, 40.0, 0.0);
        let falling = rectangle((58.0, -15.0), 20.0, 20.0, 0.0);
        let found = entry(&floor, &falling, Vector2::new(1.0, 16.0)).expect("an overlap");
        assert_eq!(found, SatOverlap { time: 15.0 / 16.0, penetration: 2.0, normal: Vector2::new(1.0, 0.0) });
    }

    #[test]
    fn the_normal_points_from_the_first_to_the_second() {
        let (a, b) = (rectangle((0.0, 0.0), 10.0, 10.0, 0.0), rectangle((0.0, -9.0), 4.0, 10.0, 0.0));
        let normal = |a: &[Vector2], b: &[Vector2]| entry(a, b, Vector2::zeros()).map(|entry| entry.normal);
        assert_eq!(normal(&a, &b), Some(Vector2::new(0.0, -1.0)));
        assert_eq!(normal(&b, &a), Some(Vector2::new(0.0, 1.0)));
    }

    #[test]
    fn outlines_that_touch_do_not_overlap() {
        let (a, b) = (rectangle((0.0, 0.0), 10.0, 10.0, 0.0), rectangle((10.0, 0.0), 10.0, 10.0, 0.0));
        assert_eq!(entry(&a, &b, Vector2::new(-1.0, 0.0)), None);
    }

    #[test]
    fn shapes_that_do_not_approach_have_an_infinite_time_of_entry() {
        let (a, b) = (rectangle((0.0, 0.0), 10.0, 10.0, 0.0), rectangle((9.0, 0.0), 10.0, 10.0, 0.0));
        assert_eq!(entry(&a, &b, Vector2::zeros()).map(|entry| entry.time), Some(f32::INFINITY));
    }

    #[test]
    fn degenerate_outlines_are_no_danger() {
        let square = rectangle((0.0, 0.0), 2.0, 2.0, 0.0);
        let velocity = Vector2::new(1.0, 0.0);
        let single = points(&[(0.5, 0.0)]);
        assert_eq!(entry(&square, &single, velocity).map(|entry| entry.penetration), Some(0.5));
        assert_eq!(entry(&single, &single, velocity), None);
        assert_eq!(entry(&[], &square, velocity), None);
        assert_eq!(entry(&points(&[(f32::NAN, 0.0), (1.0, 0.0)]), &square, velocity), None);
        let segment = points(&[(-5.0, 0.0), (5.0, 0.0), (5.0, 0.0)]);
        assert_eq!(entry(&segment, &moved(&segment, velocity), velocity), None);
    }

    #[test]
    fn the_penetration_is_the_least_over_all_directions() {
        let mut random = Random(6);
        let mut overlapping = 0;
        for _ in 0..300 {
            let a = random.star(Vector2::zeros(), 7, 20.0, 0.0);
            let away = random.point(30.0);
            let b = random.star(away, 3, 15.0, 0.0);
            let least = (0..4000)
                .map(|i| {
                    let angle = f64::from(i) * std::f64::consts::TAU / 4000.0;
                    let direction = Vector2::new(libm::cos(angle) as f32, libm::sin(angle) as f32);
                    project(&a, direction).1 - project(&b, direction).0
                })
                .fold(f32::INFINITY, f32::min);
            match entry(&a, &b, Vector2::zeros()) {
                Some(found) => {
                    overlapping += 1;
                    // Directions are 1.6e-3 apart; extents of 70 make that 70 * 0.8e-3.
                    assert!(found.penetration <= least + 1e-4 && found.penetration >= least - 0.056);
                    let apart = moved(&b, found.normal * (found.penetration + 1e-4));
                    assert_eq!(entry(&a, &apart, Vector2::zeros()), None);
                }
                None => assert!(least < 1e-4),
            }
        }
        assert!(overlapping > 100);
    }

    #[test]
    fn before_the_time_of_entry_outlines_were_apart_and_after_it_not() {
        let mut random = Random(7);
        let mut approaching = 0;
        for _ in 0..300 {
            let a = random.star(Vector2::zeros(), 6, 20.0, 0.0);
            let away = random.point(25.0);
            let b = random.star(away, 5, 15.0, 0.0);
            let velocity = random.point(10.0);
            let Some(found) = entry(&a, &b, velocity) else { continue };
            assert!(found.time.is_finite());
            approaching += 1;
            assert_eq!(entry(&a, &moved(&b, velocity * (-found.time * 1.001 - 1e-4)), velocity), None);
            assert!(entry(&a, &moved(&b, velocity * (-found.time * 0.999 + 1e-4)), velocity).is_some());
        }
        assert!(approaching > 100);
    }

    #[test]
    fn the_first_piece_to_meet_gives_the_time_of_entry_and_the_deepest_the_penetration() {
        let a = [rectangle((0.0, 0.0), 10.0, 100.0, 0.0), rectangle((10.0, 0.0), 10.0, 10.0, 0.0)];
        let b = [rectangle((17.0, 0.0), 10.0, 6.0, 0.0)];
        fn slices(list: &[Vec<Vector2>]) -> impl Iterator<Item = &[Vector2]> {
            list.iter().map(Vec::as_slice)
        }
        let found = entry_of_pieces(slices(&a), || slices(&b), Vector2::new(-2.0, 0.0));
        let expected = SatOverlap { time: 1.5, penetration: 3.0, normal: Vector2::new(1.0, 0.0) };
        assert_eq!(found, Some(expected));
        assert_eq!(entry_of_pieces(slices(&a[..1]), || slices(&b), Vector2::zeros()), None);
    }
}
