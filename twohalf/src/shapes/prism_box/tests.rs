//! Closed forms, landings followed over steps, and comparisons with samples of space.

use super::*;
use crate::shapes::Face;
use crate::shapes::samples::{Random, points as outline, rectangle};
use crate::shapes::slanted_box::shape as random_box;

const SLOP: f32 = 0.05;
/// From (0, 0, 0) to (100, 40, 60).
const LEVEL_BOX: SlantedBox = SlantedBox {
    centre: Vector3::new(50.0, 20.0, 30.0),
    half: [50.0, 20.0, 30.0],
    cos: 1.0,
    sin: 0.0,
    shear: 0.0,
    climb: 0.0,
    turn: [1.0, 0.0],
};

/// A prism of one piece between two depths.
fn touch(
    shape: &SlantedBox,
    piece: &[Vector2],
    depths: [f32; 2],
    motion: Vector3,
    kept: Option<PersistedAxis>,
) -> Option<BoxManifold> {
    touch_pieces(shape, &[piece], depths, motion, kept)
}

fn touch_pieces(
    shape: &SlantedBox,
    pieces: &[&[Vector2]],
    [near, far]: [f32; 2],
    motion: Vector3,
    kept: Option<PersistedAxis>,
) -> Option<BoxManifold> {
    let (z, half) = ((near + far) * 0.5, (far - near) * 0.5);
    prism_box(shape, pieces.iter().copied(), z, half, motion, SLOP, kept, &mut Vec::new())
}

/// A square of side 20 whose top left corner is at a point.
fn square(x: f32, y: f32) -> Vec<Vector2> {
    rectangle((x + 10.0, y + 10.0), 20.0, 20.0, 0.0)
}

fn moved(piece: &[Vector2], by: Vector3) -> Vec<Vector2> {
    piece.iter().map(|vertex| vertex + by.xy()).collect()
}

const UP: Vector3 = Vector3::new(0.0, -1.0, 0.0);
const AT_REST: Vector3 = Vector3::new(0.0, 0.0, 0.0);

#[test]
fn a_box_on_the_top_touches_with_both_ends_of_its_underside() {
    let manifold = touch(&LEVEL_BOX, &square(30.0, -19.0), [10.0, 20.0], AT_REST, None).unwrap();
    assert_eq!((manifold.normal, manifold.count, manifold.is_depth), (UP, 2, false));
    let mut places = manifold.points.map(|point| (point.position.x, point.position.y, point.separation));
    places.sort_by(|a, b| a.0.total_cmp(&b.0));
    assert_eq!(places, [(30.0, 1.0, -1.0), (50.0, 1.0, -1.0)]);
    // In the middle of the depths that both have.
    assert!(manifold.points.iter().all(|point| point.position.z == 15.0));
}

#[test]
fn an_overhanging_box_touches_at_the_edge_of_the_top() {
    let manifold = touch(&LEVEL_BOX, &square(-5.0, -19.0), [10.0, 20.0], AT_REST, None).unwrap();
    assert_eq!(manifold.normal, UP);
    let mut places = manifold.points.map(|point| point.position.x);
    places.sort_by(f32::total_cmp);
    assert_eq!((manifold.count, places), (2, [0.0, 15.0]));
}

#[test]
fn boxes_that_only_touch_do_not_overlap() {
    assert!(touch(&LEVEL_BOX, &square(30.0, -20.0), [10.0, 20.0], AT_REST, None).is_none());
    assert!(touch(&LEVEL_BOX, &square(100.0, 10.0), [10.0, 20.0], AT_REST, None).is_none());
    assert!(touch(&LEVEL_BOX, &square(30.0, 10.0), [-10.0, 0.0], AT_REST, None).is_none());
    assert!(touch(&LEVEL_BOX, &square(30.0, 10.0), [60.0, 70.0], AT_REST, None).is_none());
}

#[test]
fn sheets_overlap_at_the_same_depth_only() {
    let sheet = SlantedBox { half: [50.0, 20.0, 0.0], ..LEVEL_BOX };
    assert!(touch(&sheet, &square(30.0, -19.0), [30.0, 30.0], AT_REST, None).is_some());
    assert!(touch(&sheet, &square(30.0, -19.0), [30.1, 30.1], AT_REST, None).is_none());
}

#[test]
fn a_box_that_lands_deep_near_the_edge_is_pushed_up_in_every_step() {
    // 15 px deep, 2 px from the left edge, at 16 px per step.
    let mut kept = None;
    let mut depth = 15.0;
    let mut motion = Vector3::new(0.0, 16.0, 0.0);
    while depth > 0.0 {
        let manifold = touch(&LEVEL_BOX, &square(-18.0, -20.0 + depth), [10.0, 20.0], motion, kept).unwrap();
        assert_eq!(manifold.normal, UP, "{depth}");
        assert!((manifold.points[0].separation + depth).abs() < 1e-4);
        (kept, motion) = (Some(manifold.kept), AT_REST);
        depth -= 0.7;
    }
}

#[test]
fn a_box_placed_deep_near_the_edge_leaves_by_the_shortest_way() {
    let manifold = touch(&LEVEL_BOX, &square(-18.0, -5.0), [10.0, 20.0], AT_REST, None).unwrap();
    assert_eq!(manifold.normal, Vector3::new(-1.0, 0.0, 0.0));
}

#[test]
fn a_box_that_lands_deep_near_the_front_is_pushed_up() {
    // 2 px behind the front and moving backwards, but it has fallen in faster.
    let motion = Vector3::new(0.0, 16.0, 0.5);
    let manifold = touch(&LEVEL_BOX, &square(30.0, -8.0), [-8.0, 2.0], motion, None).unwrap();
    assert_eq!((manifold.normal, manifold.is_depth), (UP, false));
    let next = touch(&LEVEL_BOX, &square(30.0, -8.0), [-8.0, 2.0], AT_REST, Some(manifold.kept)).unwrap();
    assert_eq!(next.normal, UP);
}

#[test]
fn a_box_that_walks_into_the_front_meets_it_and_stays() {
    let motion = Vector3::new(0.0, 0.1, 2.5);
    let manifold = touch(&LEVEL_BOX, &square(30.0, 10.0), [-8.0, 2.0], motion, None).unwrap();
    assert_eq!((manifold.normal, manifold.is_depth), (Vector3::new(0.0, 0.0, -1.0), true));
    assert_eq!(manifold.count, 2);
    assert!(manifold.points.iter().all(|point| point.position.z == 0.0 && point.separation == -2.0));
    let spread = (manifold.points[0].position - manifold.points[1].position).norm();
    assert!((spread - 800.0f32.sqrt()).abs() < 1e-3);
    let next = touch(&LEVEL_BOX, &square(30.0, 10.0), [-8.0, 2.0], AT_REST, Some(manifold.kept)).unwrap();
    assert!(next.is_depth);
    assert_eq!(next.points.map(|point| point.feature), manifold.points.map(|point| point.feature));
}

#[test]
fn a_box_put_deep_into_another_does_not_leave_where_it_moves_from() {
    // 1 px deep in the top, walking backwards in the middle of the depth.
    let motion = Vector3::new(0.0, 0.0, 0.5);
    let manifold = touch(&LEVEL_BOX, &square(30.0, -19.0), [20.0, 40.0], motion, None).unwrap();
    assert_eq!(manifold.normal, UP);
}

#[test]
fn a_box_that_comes_from_behind_meets_the_back() {
    let motion = Vector3::new(0.0, 0.0, -4.0);
    let manifold = touch(&LEVEL_BOX, &square(30.0, 10.0), [57.0, 67.0], motion, None).unwrap();
    assert_eq!((manifold.normal, manifold.points[0].separation), (Vector3::new(0.0, 0.0, 1.0), -3.0));
}

#[test]
fn without_motion_in_depth_a_box_meets_in_the_plane() {
    // Half a px of depth, 10 px of height.
    let motion = Vector3::new(0.0, 16.0, 0.0);
    let manifold = touch(&LEVEL_BOX, &square(30.0, -10.0), [-9.5, 0.5], motion, None).unwrap();
    assert!(!manifold.is_depth);
}

#[test]
fn a_box_that_slides_over_a_seam_stays_on_top() {
    // It rests 0.06 deep on what is left of this box and has come 1.5 px over it at 2.5 px per step.
    let motion = Vector3::new(2.5, 0.01, 0.0);
    let manifold = touch(&LEVEL_BOX, &square(-18.5, -19.94), [10.0, 20.0], motion, None).unwrap();
    assert_eq!(manifold.normal, UP);
}

#[test]
fn a_box_that_falls_along_a_wall_does_not_land_on_a_seam() {
    // Pressed 0.06 into the wall, 8 px below the top of its lower half.
    let motion = Vector3::new(0.0, 16.0, 0.0);
    let manifold = touch(&LEVEL_BOX, &square(-19.94, -12.0), [10.0, 20.0], motion, None).unwrap();
    assert_eq!(manifold.normal, Vector3::new(-1.0, 0.0, 0.0));
}

#[test]
fn a_box_that_tips_over_an_edge_turns_about_the_edge() {
    // Tilted counterclockwise by 0.5 rad, the corner at the origin 0.05 above the middle of its underside. It had
    // been on the top, below which its left half hangs now.
    let upwards = Vector2::new(-libm::sin(0.5) as f32, -libm::cos(0.5) as f32);
    let middle = upwards * 9.95;
    let piece = rectangle((middle.x, middle.y), 20.0, 20.0, -0.5);
    let kept =
        PersistedAxis::Plane { edge: Edge::Box(BoxEdge::Face(Face::Top)), normal: Vector2::new(0.0, -1.0) };
    let manifold = touch(&LEVEL_BOX, &piece, [10.0, 20.0], AT_REST, Some(kept)).unwrap();
    assert!((manifold.normal.xy() - upwards).norm() < 1e-6);
    assert_eq!((manifold.count, manifold.points[0].position), (1, Vector3::new(0.0, 0.0, 15.0)));
    assert!((manifold.points[0].separation + 0.05).abs() < 1e-5);
}

#[test]
fn the_names_of_the_points_outlast_a_change_of_the_reference() {
    let first = touch(&LEVEL_BOX, &square(30.0, -19.0), [10.0, 20.0], AT_REST, None).unwrap();
    // The edge of the prism as reference: its fourth lies on the top.
    let names = |manifold: &BoxManifold| {
        let mut names = manifold.points.map(|point| point.feature);
        names.sort_unstable();
        names
    };
    for edge in 0..4 {
        let kept =
            PersistedAxis::Plane { edge: Edge::Prism { piece: 0, edge }, normal: Vector2::new(0.0, -1.0) };
        let manifold = touch(&LEVEL_BOX, &square(30.0, -19.0), [10.0, 20.0], AT_REST, Some(kept)).unwrap();
        assert_eq!(names(&manifold), names(&first));
    }
}

#[test]
fn a_corner_of_the_box_under_a_tilted_prism_is_one_point() {
    // A square on its corner's way down would touch with its own corner; here the box's corner is under its side.
    let shape = SlantedBox { cos: 0.5f32.sqrt(), sin: 0.5f32.sqrt(), half: [20.0, 20.0, 30.0], ..LEVEL_BOX };
    let top = 20.0 - 800.0f32.sqrt();
    let manifold = touch(&shape, &square(40.0, top - 19.0), [10.0, 20.0], AT_REST, None).unwrap();
    assert!((manifold.normal - UP).norm() < 1e-6);
    assert_eq!(manifold.count, 1);
    assert!((manifold.points[0].position - Vector3::new(50.0, top, 15.0)).norm() < 1e-4);
    assert!((manifold.points[0].separation + 1.0).abs() < 1e-4);
}

#[test]
fn a_prism_in_front_of_a_slanted_side_leaves_along_its_normal() {
    // With shear 1 the right side is at x = 70 + z: between z = 10 and 20 it reaches to 90, at the far end.
    let shape = SlantedBox { shear: 1.0, ..LEVEL_BOX };
    let manifold = touch(&shape, &square(88.0, 10.0), [10.0, 20.0], AT_REST, None).unwrap();
    let half_root = 0.5f32.sqrt();
    assert!((manifold.normal - Vector3::new(half_root, 0.0, -half_root)).norm() < 1e-6);
    assert!((manifold.points[0].separation + 2.0 * half_root).abs() < 1e-5);
    assert!(manifold.points.iter().all(|point| point.position.z == 20.0));
}

#[test]
fn a_prism_beyond_the_end_of_a_slanted_side_leaves_in_the_plane() {
    // The box ends at z = 60 with its right side at 130, the prism only at 80.
    let shape = SlantedBox { shear: 1.0, ..LEVEL_BOX };
    let manifold = touch(&shape, &square(128.0, 10.0), [10.0, 80.0], AT_REST, None).unwrap();
    assert_eq!(manifold.normal, Vector3::new(1.0, 0.0, 0.0));
    assert_eq!(manifold.points[0].separation, -2.0);
    assert_eq!(manifold.points[0].position.z, 60.0);
}

#[test]
fn between_two_pieces_the_outermost_points_carry() {
    let legs = [rectangle((35.0, -9.0), 10.0, 20.0, 0.0), rectangle((65.0, -9.0), 10.0, 20.0, 0.0)];
    let pieces = [legs[0].as_slice(), legs[1].as_slice()];
    let manifold = touch_pieces(&LEVEL_BOX, &pieces, [10.0, 20.0], AT_REST, None).unwrap();
    assert_eq!((manifold.normal, manifold.count), (UP, 2));
    let mut places = manifold.points.map(|point| point.position.x);
    places.sort_by(f32::total_cmp);
    assert_eq!(places, [30.0, 70.0]);
}

#[test]
fn a_cut_between_pieces_is_no_exit_face() {
    // Two halves of a square of 20, cut upright in the middle, which is 1 px right of the box's left side.
    let left = outline(&[(-9.0, -10.0), (-9.0, 10.0), (1.0, 10.0), (1.0, -10.0)]);
    let right = outline(&[(1.0, -10.0), (1.0, 10.0), (11.0, 10.0), (11.0, -10.0)]);
    let manifold = touch_pieces(&LEVEL_BOX, &[&left, &right], [10.0, 20.0], AT_REST, None).unwrap();
    assert!(manifold.points[0].separation <= -10.0, "{manifold:?}");
}

#[test]
fn outlines_of_one_and_two_vertices_touch() {
    let dot = outline(&[(50.0, 1.0)]);
    let manifold = touch(&LEVEL_BOX, &dot, [10.0, 20.0], AT_REST, None).unwrap();
    assert_eq!((manifold.normal, manifold.count), (UP, 1));
    assert_eq!(
        (manifold.points[0].position, manifold.points[0].separation),
        (Vector3::new(50.0, 1.0, 15.0), -1.0)
    );
    let line = outline(&[(50.0, -9.0), (50.0, 1.0)]);
    let manifold = touch(&LEVEL_BOX, &line, [10.0, 20.0], Vector3::new(0.0, 2.0, 0.0), None).unwrap();
    assert_eq!((manifold.normal, manifold.count), (UP, 1));
    assert_eq!(manifold.points[0].position, Vector3::new(50.0, 1.0, 15.0));
}

#[test]
fn degenerate_and_infinite_input_gives_finite_points_or_none() {
    let numbers = [0.0, -0.0, 1.0, 50.0, f32::MIN_POSITIVE, 1e30, f32::INFINITY, f32::NAN];
    let outlines = [vec![], outline(&[(50.0, 1.0); 4]), outline(&[(50.0, 1.0), (50.0, 1.0), (40.0, 1.0)])];
    for piece in &outlines {
        for &number in &numbers {
            let piece = moved(piece, Vector3::new(number, 0.0, 0.0));
            for motion in [AT_REST, Vector3::new(number, number, number), Vector3::new(0.0, number, -number)]
            {
                for shape in [LEVEL_BOX, SlantedBox { shear: 0.5, ..LEVEL_BOX }, SlantedBox::default()] {
                    if let Some(manifold) = touch(&shape, &piece, [10.0, 10.0 + number], motion, None) {
                        assert!(manifold.is_finite() && manifold.count > 0, "{manifold:?}");
                    }
                }
            }
        }
    }
}

/// Returns a random prism near the box: the outline, px, and the interval along Z, px.
fn random_prism(numbers: &mut Random, shape: &SlantedBox) -> (Vec<Vector2>, [f32; 2]) {
    let middle = shape.centre.xy() + numbers.point(70.0);
    let count = 3 + (numbers.number(0.0, 5.0) as usize);
    let size = numbers.number(5.0, 30.0);
    let near = shape.centre.z + numbers.number(-70.0, 50.0);
    (numbers.star(middle, count, size, 0.0), [near, near + numbers.number(1.0, 40.0)])
}

fn is_in_convex(piece: &[Vector2], point: Vector2) -> bool {
    (0..piece.len()).all(|edge| {
        let along = piece[axes::next(edge, piece)] - piece[edge];
        let to = point - piece[edge];
        along.x * to.y - along.y * to.x < 0.0
    })
}

#[test]
fn an_overlap_is_found_exactly_where_samples_are_inside_of_both() {
    let mut numbers = Random(7);
    let (mut overlapping, mut apart) = (0, 0);
    for round in 0..2000 {
        let shape = random_box(&mut numbers, round);
        let (piece, depths) = random_prism(&mut numbers, &shape);
        let manifold = touch(&shape, &piece, depths, AT_REST, None);
        let extent = |axis: usize| {
            let places = || piece.iter().map(|vertex| vertex[axis]);
            (places().fold(f32::INFINITY, f32::min), places().fold(-f32::INFINITY, f32::max))
        };
        let ((left, right), (upper, lower)) = (extent(0), extent(1));
        let shared = (0..4000).any(|_| {
            let (x, y) = (numbers.number(left, right), numbers.number(upper, lower));
            let z = numbers.number(depths[0], depths[1]);
            is_in_convex(&piece, Vector2::new(x, y)) && shape.contains(Vector3::new(x, y, z))
        });
        match manifold {
            Some(_) => overlapping += 1,
            None => apart += 1,
        }
        assert!(manifold.is_some() || !shared, "{shape:?} {piece:?} {depths:?}");
        // Samples miss thin overlaps only.
        let is_thin = manifold.is_none_or(|manifold| manifold.points[0].separation > -4.0);
        assert!(shared || is_thin, "{shape:?} {piece:?} {depths:?} {manifold:?}");
    }
    assert!(overlapping > 300 && apart > 300);
}

#[test]
fn at_rest_moves_by_the_separation_along_the_normal_part_them() {
    let mut numbers = Random(8);
    let mut parted = [0; 3];
    for round in 0..3000 {
        let shape = random_box(&mut numbers, round);
        let (mut piece, mut depths) = random_prism(&mut numbers, &shape);
        let mut moves = 0;
        while let Some(manifold) = touch(&shape, &piece, depths, AT_REST, None) {
            assert!((manifold.normal.norm() - 1.0).abs() < 1e-5);
            let points = &manifold.points[..manifold.count];
            assert!(points.iter().all(|point| point.separation >= manifold.points[0].separation));
            // More than rounding: coordinates up to 300 have an error of 2e-5.
            let by = manifold.normal * (5e-3 - manifold.points[0].separation);
            (piece, depths) = (moved(&piece, by), depths.map(|z| z + by.z));
            moves += 1;
            // One move, unless an edge of the prism's end meets an edge in depth of a sheared box: then the points
            // are those of the outlines, which need not be the deepest in space.
            let most = if shape.shear == 0.0 { 1 } else { 2 };
            assert!(moves <= most, "{manifold:?} {shape:?} {piece:?} {depths:?}");
        }
        parted[moves] += 1;
    }
    assert!(parted[1] > 300 && parted[2] * 20 < parted[1], "{parted:?}");
}

#[test]
fn at_rest_no_sampled_direction_separates_them_sooner() {
    let mut numbers = Random(9);
    for round in 0..1000 {
        let shape = random_box(&mut numbers, round);
        let (piece, depths) = random_prism(&mut numbers, &shape);
        let Some(manifold) = touch(&shape, &piece, depths, AT_REST, None) else { continue };
        let deepest = -manifold.points[0].separation;
        for _ in 0..30 {
            let direction =
                Vector3::new(numbers.number(-1.0, 1.0), numbers.number(-1.0, 1.0), numbers.number(-1.0, 1.0));
            // Along z alone it may leave sooner: without motion in depth that is not asked for.
            let reach = (depths[1] - depths[0]) * 0.5 + shape.half[2];
            let middle = (depths[0] + depths[1]) * 0.5;
            let by = direction.normalize() * (deepest - 5e-3);
            if deepest < 5e-3 || (middle + by.z - shape.centre.z).abs() > reach - 1e-3 {
                continue;
            }
            let after = touch(&shape, &moved(&piece, by), depths.map(|z| z + by.z), AT_REST, None);
            assert!(after.is_some(), "{manifold:?} {shape:?} {piece:?} {depths:?} {by:?}");
        }
    }
}
