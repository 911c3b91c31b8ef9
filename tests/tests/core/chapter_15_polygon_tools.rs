//! The checks of behaviour chapter 15, section 15.9.

use conformance::fixtures::plane::v;
use conformance::units::assert_words;
use farseer_core::math::vector2;
use farseer_core::shape::{PolyUnionError, PolygonCreationAssistance, Vertices, WindingOrder};
use farseer_core::{Body, Error, GeomFactory, PhysicsSimulator};

fn outline(points: &[(f32, f32)]) -> Vertices {
    points.iter().map(|&(x, y)| v(x, y)).collect()
}

/// Check 1.
#[test]
fn rounding_goes_to_even_and_keeps_the_sign_of_zero() {
    let rounded = outline(&[(0.5, 1.5), (-0.5, 2.5), (-0.3, 3.49)]).round();
    assert_words(&rounded, "00000000 40000000 80000000 40000000 80000000 40400000");
}

/// Check 1.
#[test]
fn simplifying_takes_vertices_off_straight_sides() {
    let simple = Vertices::create_rectangle(100.0, 50.0).unwrap().simplify();
    assert_eq!(simple, outline(&[(-50.0, -25.0), (-50.0, 25.0), (50.0, 25.0), (50.0, -25.0)]));
}

/// Check 1.
#[test]
fn simplifying_takes_close_vertices_off() {
    let points = [(0.0, 0.0), (1.0, 0.0), (2.0, 1.0), (10.0, 0.0), (10.0, 10.0), (0.0, 10.0)];
    let simple = outline(&points).simplify_with_bias(2);
    assert_eq!(simple, outline(&[(0.0, 0.0), (10.0, 0.0), (10.0, 10.0), (0.0, 10.0)]));
}

#[test]
fn non_finite_vertices_have_no_hull_and_no_pieces() {
    for bad in [f32::NAN, f32::INFINITY, f32::NEG_INFINITY] {
        for corner in [(bad, 1.0), (1.0, bad)] {
            let damaged = outline(&[(0.0, 0.0), corner, (5.0, 5.0), (0.0, 5.0)]);
            let named = |error: Error| matches!(error, Error::InvalidArgument { argument: "self", .. });
            assert!(named(damaged.get_convex_hull().unwrap_err()), "{damaged}");
            assert!(named(damaged.decompose(10).unwrap_err()), "{damaged}");
            let mut simulator = PhysicsSimulator::default();
            let body = simulator.create_body(Body::new());
            assert!(GeomFactory::create_sat_polygon_geom(&mut simulator, body, &damaged, 10).is_err());
        }
    }
}

/// Check 2.
#[test]
fn long_edges_are_divided_into_equal_parts() {
    let mut rectangle = outline(&[(0.0, 0.0), (10.0, 0.0), (10.0, 3.0), (0.0, 3.0)]);
    rectangle.sub_divide_edges(4.0).unwrap();
    let x = |bits| f32::from_bits(bits);
    let divided = [
        (0.0, 0.0),
        (x(0x4055_5556), 0.0),
        (x(0x40D5_5556), 0.0),
        (10.0, 0.0),
        (10.0, 3.0),
        (x(0x40D5_5555), 3.0),
        (x(0x4055_5554), 3.0),
        (0.0, 3.0),
    ];
    assert_eq!(rectangle, outline(&divided));
}

/// Check 3.
#[test]
fn in_engine_winding_a_corner_without_a_turn_is_not_convex() {
    let mut with_flat_corner = outline(&[(0.0, 0.0), (0.0, 2.0), (0.0, 4.0), (4.0, 4.0), (4.0, 0.0)]);
    assert!(!with_flat_corner.is_convex());
    with_flat_corner.reverse();
    assert!(with_flat_corner.is_convex());
    assert!(Vertices::new().is_convex());
}

/// Check 4.
#[test]
fn the_hull_of_a_dented_square_has_no_dent() {
    let dented = outline(&[(0.0, 0.0), (4.0, 0.0), (4.0, 4.0), (2.0, 1.0), (0.0, 4.0)]);
    let hull = outline(&[(0.0, 4.0), (0.0, 0.0), (4.0, 0.0), (4.0, 4.0)]);
    assert_eq!(dented.get_convex_hull().unwrap(), hull);
}

/// Check 4.
#[test]
fn the_hull_of_a_line_is_its_first_and_last_vertex() {
    let line = outline(&[(0.0, 0.0), (1.0, 0.0), (2.0, 0.0), (3.0, 0.0)]);
    assert_eq!(line.get_convex_hull().unwrap(), outline(&[(0.0, 0.0), (3.0, 0.0)]));
}

/// Check 4.
#[test]
fn the_hull_may_start_in_the_middle() {
    let square = outline(&[(0.0, 0.0), (0.0, 4.0), (4.0, 4.0), (4.0, 0.0)]);
    let hull = outline(&[(4.0, 4.0), (0.0, 4.0), (0.0, 0.0), (4.0, 0.0)]);
    assert_eq!(square.get_convex_hull().unwrap(), hull);
}

/// Check 5.
#[test]
fn winding_orders_are_those_seen_with_y_up() {
    let square = outline(&[(0.0, 0.0), (4.0, 0.0), (4.0, 4.0), (0.0, 4.0)]);
    let line = outline(&[(0.0, 0.0), (1.0, 0.0), (2.0, 0.0)]);
    let orders =
        [&square, &square.reverse_winding_order(), &line].map(|o| o.determine_winding_order().unwrap());
    assert_eq!(orders, [WindingOrder::CounterClockwise, WindingOrder::Clockwise, WindingOrder::Clockwise]);
}

fn wide_l_shape() -> Vertices {
    outline(&[(0.0, 0.0), (0.0, 6.0), (2.0, 6.0), (2.0, 2.0), (6.0, 2.0), (6.0, 0.0)])
}

/// Check 6.
#[test]
fn an_l_shape_has_four_triangles() {
    let (vertices, indices) = wide_l_shape().triangulate(WindingOrder::Clockwise).unwrap();
    let turned = [(0.0, 0.0), (6.0, 0.0), (6.0, 2.0), (2.0, 2.0), (2.0, 6.0), (0.0, 6.0)];
    assert_eq!(vertices, outline(&turned));
    assert_eq!(indices, [0, 2, 1, 0, 3, 2, 0, 4, 3, 5, 4, 0]);
}

/// Check 6.
#[test]
fn a_square_has_two_triangles() {
    let square = outline(&[(0.0, 0.0), (4.0, 0.0), (4.0, 4.0), (0.0, 4.0)]);
    let (_, indices) = square.triangulate(WindingOrder::CounterClockwise).unwrap();
    assert_eq!(indices, [0, 1, 3, 1, 2, 3]);
}

fn square_of_ten() -> Vertices {
    outline(&[(0.0, 0.0), (0.0, 10.0), (10.0, 10.0), (10.0, 0.0)])
}

fn hole() -> Vertices {
    outline(&[(3.0, 3.0), (5.0, 3.0), (5.0, 5.0), (3.0, 5.0)])
}

/// Check 7.
#[test]
fn a_hole_is_joined_to_its_shape_and_can_be_triangulated() {
    let with_hole = square_of_ten().cut_hole_in_shape(&hole()).unwrap();
    #[rustfmt::skip]
    let expected = [
        (0.0, 0.0), (10.0, 0.0), (10.0, 10.0), (5.0, 5.0), (5.0, 3.0),
        (3.0, 3.0), (3.0, 5.0), (5.0, 5.0), (10.0, 10.0), (0.0, 10.0),
    ];
    assert_eq!(with_hole, outline(&expected));
    let (_, indices) = with_hole.triangulate(WindingOrder::Clockwise).unwrap();
    assert_eq!(indices, [1, 3, 2, 1, 4, 3, 1, 5, 4, 0, 5, 1, 0, 6, 5, 9, 6, 0, 9, 7, 6, 9, 8, 7]);
}

/// Check 7.
#[test]
fn a_hole_outside_of_its_shape_is_left_out() {
    let mut outside = hole();
    outside.translate(v(10.0, 0.0));
    let turned = outline(&[(0.0, 0.0), (10.0, 0.0), (10.0, 10.0), (0.0, 10.0)]);
    assert_eq!(square_of_ten().cut_hole_in_shape(&outside).unwrap(), turned);
}

/// Check 8.
#[test]
fn an_l_shape_has_two_convex_pieces() {
    let pieces = wide_l_shape().decompose(10).unwrap();
    let first = outline(&[(2.0, 6.0), (0.0, 6.0), (0.0, 0.0), (2.0, 2.0)]);
    let second = outline(&[(0.0, 0.0), (6.0, 0.0), (6.0, 2.0), (2.0, 2.0)]);
    assert_eq!(pieces, [first, second]);
}

/// Check 8.
#[test]
fn a_decomposition_stops_at_the_requested_number_of_pieces() {
    let l_shape = wide_l_shape();
    assert_eq!(l_shape.decompose(1).unwrap(), l_shape.decompose(10).unwrap()[..1]);
    assert_eq!(l_shape.decompose(0).unwrap(), []);
}

/// Check 8.
#[test]
fn the_pieces_of_a_body_are_in_engine_winding() {
    let mut simulator = PhysicsSimulator::new(v(0.0, 0.0)).unwrap();
    let body = simulator.create_body(Body::new());
    let geoms = GeomFactory::create_sat_polygon_geom(&mut simulator, body, &wide_l_shape(), 10).unwrap();
    let local = geoms.into_iter().map(|geom| simulator.geom(geom).unwrap().local_vertices().clone());
    let first = outline(&[(2.0, 2.0), (0.0, 0.0), (0.0, 6.0), (2.0, 6.0)]);
    let second = outline(&[(2.0, 2.0), (6.0, 2.0), (6.0, 0.0), (0.0, 0.0)]);
    assert_eq!(local.collect::<Vec<_>>(), [first, second]);
}

/// Check 9.
#[test]
fn a_rectangle_of_sixteen_vertices_has_four_pieces() {
    let mut pieces = Vertices::create_rectangle(8.0, 8.0).unwrap().decompose(5).unwrap();
    assert_eq!(pieces.len(), 4);
    pieces[0].force_counter_clockwise_order();
    let first = [(-4.0, 2.0), (-2.0, 4.0), (0.0, 4.0), (4.0, 0.0), (2.0, -4.0), (-4.0, -4.0)];
    assert_eq!(pieces[0], outline(&first));
}

/// Check 9.
#[test]
fn a_pinched_outline_falls_into_its_parts() {
    let pinched = [(0.0, 0.0), (4.0, 4.0), (8.0, 0.0), (8.0, 8.0), (4.0, 4.0), (0.0, 8.0)];
    let pieces = outline(&pinched).decompose(10).unwrap();
    assert_eq!(pieces.iter().map(|piece| piece.len()).collect::<Vec<_>>(), [3, 3]);
}

/// Check 9.
#[test]
fn a_circle_of_177_edges_has_forty_pieces() {
    let pieces = Vertices::create_circle(100.0, 177).unwrap().decompose(60).unwrap();
    assert_eq!(pieces.len(), 40);
    let sizes: Vec<usize> = pieces.iter().take(10).map(|piece| piece.len()).collect();
    assert_eq!(sizes, [32, 15, 6, 15, 8, 5, 15, 9, 9, 3]);
}

/// Check 9.
#[test]
fn a_circle_of_178_edges_has_too_many_triangles() {
    let error = Vertices::create_circle(100.0, 178).unwrap().decompose(60).unwrap_err();
    assert!(error.to_string().contains("175 triangles"), "{error}");
}

/// Check 10.
#[test]
fn two_squares_that_overlap_at_a_corner_are_combined() {
    let a = square_of_ten();
    let mut b = a.clone();
    b.translate(v(5.0, 5.0));
    #[rustfmt::skip]
    let union = [
        (0.0, 0.0), (0.0, 10.0), (5.0, 10.0), (5.0, 15.0), (15.0, 15.0), (15.0, 5.0), (10.0, 5.0), (10.0, 0.0),
    ];
    let difference = [(0.0, 0.0), (0.0, 10.0), (5.0, 10.0), (5.0, 5.0), (10.0, 5.0), (10.0, 0.0)];
    assert_eq!(a.union(&b).unwrap(), outline(&union));
    assert_eq!(a.subtract(&b).unwrap(), outline(&difference));
    assert_eq!(a.intersect(&b).unwrap(), outline(&[(5.0, 10.0), (10.0, 10.0), (10.0, 5.0), (5.0, 5.0)]));
}

/// Check 10.
#[test]
fn separate_squares_do_not_cross_and_have_no_intersection() {
    let a = square_of_ten();
    let mut b = a.clone();
    b.translate(v(50.0, 0.0));
    assert_eq!(a.union(&b), Err(PolyUnionError::NoIntersections));
    assert_eq!(a.subtract(&b), Err(PolyUnionError::NoIntersections));
    assert_eq!(a.intersect(&b), Ok(Vertices::new()));
}

/// Check 11: the crossings on one edge are in the wrong order, and no error is reported.
#[test]
fn a_strip_across_a_square_is_combined_wrongly_as_in_the_original() {
    let a = outline(&[(0.0, 0.0), (0.0, 20.0), (20.0, 20.0), (20.0, 0.0)]);
    let b = outline(&[(5.0, -5.0), (5.0, 25.0), (8.0, 25.0), (8.0, -5.0)]);
    let union = [(0.0, 0.0), (0.0, 20.0), (8.0, 20.0), (8.0, -5.0), (5.0, -5.0), (5.0, 0.0)];
    #[rustfmt::skip]
    let difference = [
        (0.0, 0.0), (0.0, 20.0), (8.0, 20.0), (5.0, 20.0), (20.0, 20.0), (20.0, 0.0), (8.0, 0.0), (5.0, 0.0),
    ];
    assert_eq!(a.union(&b).unwrap(), outline(&union));
    assert_eq!(a.subtract(&b).unwrap(), outline(&difference));
}

/// Check 12.
#[test]
fn a_circle_and_a_rectangle_are_combined() {
    let mut circle = Vertices::create_circle(50.0, 8).unwrap();
    circle.translate(v(512.0, 384.0));
    let mut rectangle = Vertices::create_rectangle(100.0, 50.0).unwrap();
    rectangle.translate(v(550.0, 390.0));
    let union = circle.union(&rectangle).unwrap();
    assert_eq!(union.len(), 17);
    let first = [(554.0, 365.0), (547.0, 349.0), (512.0, 334.0), (477.0, 349.0), (462.0, 384.0)];
    assert_eq!(union[..5], outline(&first)[..]);
    #[rustfmt::skip]
    let intersection = [
        (554.0, 365.0), (550.0, 365.0), (525.0, 365.0), (500.0, 365.0), (500.0, 378.0), (500.0, 390.0),
        (500.0, 402.0), (500.0, 415.0), (525.0, 415.0), (549.0, 415.0), (562.0, 384.0),
    ];
    assert_eq!(circle.intersect(&rectangle).unwrap(), outline(&intersection));
}

/// A solid rectangle: width, height, left, top.
type Solid = [u32; 4];

fn covers([width, height, left, top]: &Solid, x: u32, y: u32) -> bool {
    (*left..left + width).contains(&x) && (*top..top + height).contains(&y)
}

/// The alpha of a texture of solid rectangles.
fn texture(solids: &[Solid], width: u32, height: u32, alpha: u8) -> Vec<u8> {
    let pixel = |i: u32| if solids.iter().any(|s| covers(s, i % width, i / width)) { alpha } else { 0 };
    (0..width * height).map(pixel).collect()
}

fn first_outline(alpha: &[u8], width: u32, height: u32) -> Result<Vertices, Error> {
    let data: Vec<u32> = alpha.iter().map(|&alpha| u32::from(alpha) << 24).collect();
    Vertices::create_polygon(&data, width, height)
}

/// Check 13.
#[test]
fn rectangles_are_traced() {
    let trace =
        |solid: Solid, width, height| first_outline(&texture(&[solid], width, height, 255), width, height);
    let wide = [(3.0, 2.0), (10.0, 2.0), (12.0, 2.0), (12.0, 7.0), (5.0, 7.0), (3.0, 7.0)];
    assert_eq!(trace([10, 6, 3, 2], 16, 12), Ok(outline(&wide)));
    let full = [(0.0, 0.0), (6.0, 0.0), (7.0, 4.0), (7.0, 7.0), (1.0, 7.0)];
    assert_eq!(trace([8, 8, 0, 0], 8, 8), Ok(outline(&full)));
    let left = [(0.0, 3.0), (5.0, 3.0), (5.0, 8.0), (0.0, 8.0)];
    assert_eq!(trace([6, 6, 0, 3], 12, 12), Ok(outline(&left)));
    let small = [(3.0, 3.0), (5.0, 3.0), (5.0, 5.0)];
    assert_eq!(trace([3, 3, 3, 3], 8, 8), Ok(outline(&small)));
}

/// Check 13.
#[test]
fn a_texture_without_corners_has_no_outline() {
    for solids in [&[[1, 1, 3, 3]][..], &[[2, 1, 3, 3]], &[[3, 1, 3, 3]], &[[2, 2, 3, 3]], &[]] {
        let alpha = texture(solids, 8, 8, 255);
        let assistance = PolygonCreationAssistance::from_alpha(&alpha, 8, 8).unwrap();
        assert_eq!(Vertices::create_polygons(&assistance).unwrap(), [], "{solids:?}");
        assert!(first_outline(&alpha, 8, 8).is_err(), "{solids:?}");
    }
}

/// Check 13.
#[test]
fn a_pixel_of_the_alpha_tolerance_is_solid() {
    let trace = |alpha| first_outline(&texture(&[[4, 3, 2, 1]], 8, 5, alpha), 8, 5);
    assert_eq!(trace(0x14), Ok(outline(&[(2.0, 1.0), (5.0, 1.0), (5.0, 3.0)])));
    assert!(trace(0x13).is_err());
}

/// Check 14.
#[test]
fn a_disc_is_traced() {
    let solid = |i: u16| {
        let (x, y) = (f32::from(i % 26) - 12.5, f32::from(i / 26) - 12.5);
        x * x + y * y <= 100.0
    };
    let disc: Vec<u8> = (0..26 * 26).map(|i| if solid(i) { 255 } else { 0 }).collect();
    let trace = |hull_tolerance| {
        let mut assistance = PolygonCreationAssistance::from_alpha(&disc, 26, 26).unwrap();
        assistance.set_hull_tolerance(hull_tolerance).unwrap();
        Vertices::create_polygons(&assistance).unwrap()
    };
    #[rustfmt::skip]
    let fine = [
        (10.0, 3.0), (15.0, 3.0), (19.0, 5.0), (22.0, 10.0), (22.0, 15.0), (20.0, 19.0),
        (15.0, 22.0), (10.0, 22.0), (6.0, 20.0), (3.0, 15.0), (3.0, 10.0),
    ];
    let coarse = [(10.0, 3.0), (19.0, 5.0), (22.0, 14.0), (19.0, 20.0), (10.0, 22.0), (4.0, 17.0)];
    assert_eq!(trace(1.5), [outline(&fine)]);
    assert_eq!(trace(4.0), [outline(&coarse)]);
    assert_eq!(trace(99.0), [outline(&coarse)]);
}

/// A square ring of 20 by 20 pixels around a gap of 6 by 6.
fn ring(top: u32) -> Vec<u8> {
    let pixel = |i: u32| {
        let (x, y) = (i % 24, i / 24);
        if covers(&[20, 20, 2, top], x, y) && !covers(&[6, 6, 8, 8], x, y) { 255 } else { 0 }
    };
    (0..24 * 24).map(pixel).collect()
}

fn with_holes(alpha: &[u8]) -> Vec<Vertices> {
    let mut assistance = PolygonCreationAssistance::from_alpha(alpha, 24, 24).unwrap();
    assistance.set_hole_detection(true);
    Vertices::create_polygons(&assistance).unwrap()
}

/// Check 15.
#[test]
fn a_hole_of_a_texture_is_joined_to_its_outline() {
    #[rustfmt::skip]
    let expected = [
        (7.0, 8.0), (7.0, 13.0), (11.0, 14.0), (13.0, 14.0), (14.0, 10.0), (14.0, 8.0), (7.0, 8.0),
    ];
    #[rustfmt::skip]
    let around = [
        (2.0, 2.0), (17.0, 2.0), (20.0, 2.0), (21.0, 12.0), (21.0, 17.0), (21.0, 20.0), (11.0, 21.0),
        (6.0, 21.0), (3.0, 21.0),
    ];
    let [joined] = &with_holes(&ring(2))[..] else { panic!("one part") };
    assert_eq!(joined[1..8], outline(&expected)[..]);
    assert_eq!(joined[9..], outline(&around)[..]);
    // The bridge starts where the side from (3, 21) to (2, 2) crosses row 8, up to rounding.
    assert_eq!(joined[0], joined[8]);
    assert!(vector2::distance(joined[0], v(2.0 + 6.0 / 19.0, 8.0)) < 1e-5, "{}", joined[0]);
}

/// Check 15.
#[test]
fn a_part_that_reaches_the_first_row_keeps_its_holes() {
    assert_eq!(with_holes(&ring(0)).iter().map(|polygon| polygon.len()).collect::<Vec<_>>(), [9]);
}

fn parts(solids: &[Solid], width: u32, height: u32) -> Vec<Vertices> {
    let alpha = texture(solids, width, height, 255);
    let mut assistance = PolygonCreationAssistance::from_alpha(&alpha, width, height).unwrap();
    assistance.set_multipart_detection(true);
    Vertices::create_polygons(&assistance).unwrap()
}

/// Check 15.
#[test]
fn two_parts_have_two_outlines() {
    let first = [(2.0, 2.0), (8.0, 2.0), (9.0, 5.0), (9.0, 7.0), (3.0, 7.0)];
    let second = [(15.0, 8.0), (22.0, 8.0), (23.0, 12.0), (23.0, 14.0), (16.0, 14.0)];
    assert_eq!(parts(&[[8, 6, 2, 2], [9, 7, 15, 8]], 30, 20), [outline(&first), outline(&second)]);
}

/// Check 15.
#[test]
fn an_isolated_pixel_hides_the_parts_below_it() {
    assert_eq!(parts(&[[8, 6, 2, 2], [1, 1, 15, 4], [9, 7, 20, 8]], 40, 20).len(), 1);
    assert_eq!(parts(&[[8, 6, 2, 2], [9, 7, 20, 8]], 40, 20).len(), 2);
}
