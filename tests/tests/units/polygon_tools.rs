//! The polygon tools of behaviour chapter 15 against the record.

use std::cmp::Ordering;

use conformance::units::{Case, Fields, Words, assert_bits, cases, check};
use farseer_core::math::Vector2;
use farseer_core::shape::{
    CrossingEdgeInfo, EdgeAlignment, PolyUnionError, PolygonCreationAssistance, Vertices, WindingOrder,
};
use farseer_core::{Body, Error, GeomFactory, PhysicsSimulator};

#[test]
fn winding_orders_are_as_recorded() {
    check("hull_decompose", "DetermineWindingOrder", |case| {
        let outline = case.input.vertices("vertices");
        let order = outline.determine_winding_order().unwrap();
        assert_eq!(format!("{order:?}"), case.output.text("winding"));
        case.expect("reversed", &outline.reverse_winding_order());
        case.expect("ensured_clockwise", &outline.ensure_winding_order(WindingOrder::Clockwise).unwrap());
    });
}

fn winding_order(name: &str) -> WindingOrder {
    let orders = [WindingOrder::Clockwise, WindingOrder::CounterClockwise];
    orders.into_iter().find(|order| format!("{order:?}") == name).unwrap()
}

#[test]
fn triangles_are_as_recorded() {
    check("hull_decompose", "Triangulate", |case| {
        let order = winding_order(case.input.text("winding"));
        let (vertices, indices) = case.input.vertices("vertices").triangulate(order).unwrap();
        case.expect("vertices", &vertices);
        let recorded = case.output.value("indices").as_array().unwrap();
        let recorded: Vec<u16> = recorded.iter().map(|i| i.as_u64().unwrap().try_into().unwrap()).collect();
        assert_eq!(indices, recorded, "{:?}", case.input);
    });
}

#[test]
fn holes_are_cut_as_recorded() {
    check("hull_decompose", "CutHoleInShape", |case| {
        let shape = case.input.vertices("shape");
        case.expect("vertices", &shape.cut_hole_in_shape(&case.input.vertices("hole")).unwrap());
    });
}

/// The record has the world vertices of the pieces for a body at (2, 3), which are NaN without an area.
#[test]
fn pieces_are_placed_on_a_body_as_recorded() {
    let mut simulator = PhysicsSimulator::new(Vector2::new(0.0, 0.0)).unwrap();
    for case in cases("hull_decompose", "DecomposeGeom") {
        let body = simulator.create_body(Body::new());
        simulator[body].set_position(Vector2::new(2.0, 3.0));
        let outline = case.input.vertices("vertices");
        let max_polys = case.input.integer("max_polys");
        let geoms = GeomFactory::create_sat_polygon_geom(&mut simulator, body, &outline, max_polys);
        let recorded = case.output.vertex_lists("world");
        if recorded.iter().any(|piece| piece.words().iter().any(|x| x.is_nan())) {
            assert!(geoms.is_err(), "{case:?}");
            continue;
        }
        let geoms = geoms.unwrap();
        assert_eq!(geoms.len(), recorded.len(), "{case:?}");
        for (geom, recorded) in geoms.into_iter().zip(&recorded) {
            let world = simulator.geom(geom).unwrap().world_vertices().to_vec();
            assert_bits(&world.words(), &recorded.words(), || format!("{case:?}"));
        }
    }
}

/// The original returns an outline, or null, and an error.
fn expect_boolean(case: &Case, result: Result<Vertices, PolyUnionError>) {
    let polygon2 = case.input.vertices("polygon2");
    let (outline, error) = match result {
        Ok(outline) => (outline, "None"),
        Err(PolyUnionError::NoIntersections) => (Vertices::new(), "NoIntersections"),
        Err(PolyUnionError::Poly1InsidePoly2 { outline }) => (outline, "Poly1InsidePoly2"),
        Err(PolyUnionError::InfiniteLoop { outline }) => (outline, "InfiniteLoop"),
        Err(error) => panic!("{error}"),
    };
    assert_eq!(error, case.output.text("error"), "{case:?}");
    if case.output.value("vertices").is_null() {
        assert!(outline.is_empty(), "{outline} with {polygon2}");
    } else {
        case.expect("vertices", &outline);
    }
}

fn polygons(input: &Fields) -> [Vertices; 2] {
    ["polygon1", "polygon2"].map(|key| input.vertices(key))
}

#[test]
fn unions_are_as_recorded() {
    check("polygon_boolean", "Union", |case| {
        let [polygon1, polygon2] = polygons(&case.input);
        expect_boolean(case, polygon1.union(&polygon2));
    });
}

#[test]
fn differences_are_as_recorded() {
    check("polygon_boolean", "Subtract", |case| {
        let [polygon1, polygon2] = polygons(&case.input);
        expect_boolean(case, polygon1.subtract(&polygon2));
    });
}

#[test]
fn intersections_are_as_recorded() {
    check("polygon_boolean", "Intersect", |case| {
        let [polygon1, polygon2] = polygons(&case.input);
        expect_boolean(case, polygon1.intersect(&polygon2));
    });
}

/// The alpha of a recorded texture: `#` is 255, `+` is 64, `.` is 0.
fn alpha(input: &Fields) -> Vec<u8> {
    let rows = input.value("rows").as_array().unwrap();
    let alpha = |c| match c {
        '#' => 255,
        '+' => 64,
        '.' => 0,
        _ => panic!("pixel {c:?}"),
    };
    rows.iter().flat_map(|row| row.as_str().unwrap().chars().map(alpha)).collect()
}

/// The same, with colours that must not matter.
fn pixels(input: &Fields) -> Vec<u32> {
    alpha(input).into_iter().map(|alpha| u32::from_be_bytes([alpha, 255, 0, 255])).collect()
}

fn size(input: &Fields) -> (u32, u32) {
    let side = |key| u32::try_from(input.integer(key)).unwrap();
    (side("width"), side("height"))
}

/// Whether the call failed as recorded.
fn failed_as_recorded<T: std::fmt::Debug>(case: &Case, result: &Result<T, Error>, exception: &str) -> bool {
    let Some(thrown) = case.throws() else {
        return false;
    };
    assert_eq!(thrown, exception);
    let named = matches!(result, Err(Error::InvalidArgument { argument: "data", .. }));
    assert!(named, "{case:?}: {result:?}");
    true
}

#[test]
fn the_first_outline_of_a_texture_is_as_recorded() {
    check("image_polygon", "CreatePolygon", |case| {
        let (width, height) = size(&case.input);
        let polygon = Vertices::create_polygon(&pixels(&case.input), width, height);
        if !failed_as_recorded(case, &polygon, "System.ArgumentOutOfRangeException") {
            case.expect("polygon", &polygon.unwrap());
        }
    });
}

#[test]
fn all_outlines_of_a_texture_are_as_recorded() {
    check("image_polygon", "CreatePolygonOptions", |case| {
        let (width, height) = size(&case.input);
        let polygons = Vertices::create_polygon_with(
            &pixels(&case.input),
            width,
            height,
            case.input.f32("hull_tolerance"),
            u8::try_from(case.input.integer("alpha_tolerance")).unwrap(),
            case.input.boolean("multi_part"),
            case.input.boolean("holes"),
        );
        if failed_as_recorded(case, &polygons, "System.Exception") {
            return;
        }
        let (polygons, recorded) = (polygons.unwrap(), case.output.vertex_lists("polygons"));
        assert_eq!(polygons.len(), recorded.len(), "{case:?}");
        for (polygon, recorded) in polygons.iter().zip(&recorded) {
            assert_bits(&polygon.words(), &recorded.words(), || format!("{case:?}"));
        }
    });
}

#[test]
fn rgba_and_alpha_bytes_give_the_outlines_of_the_recorded_pixels() {
    for case in cases("image_polygon", "CreatePolygonOptions") {
        let (width, height) = size(&case.input);
        let alpha = alpha(&case.input);
        let rgba: Vec<u8> = alpha.iter().flat_map(|&alpha| [255, 0, 255, alpha]).collect();
        let textures = [
            PolygonCreationAssistance::from_rgba(&rgba, width, height),
            PolygonCreationAssistance::from_alpha(&alpha, width, height),
        ];
        for texture in textures {
            let polygons = texture.and_then(|mut texture| {
                texture.set_hull_tolerance(case.input.f32("hull_tolerance"))?;
                texture.set_alpha_tolerance(u8::try_from(case.input.integer("alpha_tolerance")).unwrap());
                texture.set_multipart_detection(case.input.boolean("multi_part"));
                texture.set_hole_detection(case.input.boolean("holes"));
                Vertices::create_polygons(&texture)
            });
            if !failed_as_recorded(&case, &polygons, "System.Exception") {
                assert_eq!(polygons.unwrap(), case.output.vertex_lists("polygons"), "{case:?}");
            }
        }
    }
}

fn outline(points: &[(f32, f32)]) -> Vertices {
    points.iter().map(|&(x, y)| Vector2::new(x, y)).collect()
}

fn square() -> Vertices {
    outline(&[(0.0, 0.0), (0.0, 10.0), (10.0, 10.0), (10.0, 0.0)])
}

/// A square whose upper edge ends on an edge of [`square`], from the inside.
fn inner_polygon() -> Vertices {
    outline(&[(3.0, 3.0), (3.0, 6.0), (10.0, 5.0)])
}

#[test]
fn an_empty_list_has_no_winding_order() {
    let empty = Vertices::new();
    let order = WindingOrder::Clockwise;
    assert!(empty.determine_winding_order().is_err());
    assert!(empty.ensure_winding_order(order).is_err());
    assert!(empty.triangulate(order).is_err());
    assert!(square().cut_hole_in_shape(&empty).is_err());
    assert!(empty.cut_hole_in_shape(&square()).is_err());
    assert_eq!(empty.reverse_winding_order(), empty);
}

#[test]
fn fewer_than_three_vertices_have_no_triangles() {
    for points in [&[(1.0, 2.0)][..], &[(1.0, 2.0), (3.0, 4.0)]] {
        let (vertices, indices) = outline(points).triangulate(WindingOrder::Clockwise).unwrap();
        assert_eq!((vertices, indices), (outline(points), vec![]));
    }
}

#[test]
fn more_vertices_than_indices_are_refused() {
    let many: Vertices = vec![Vector2::new(1.0, 1.0); (1 << 16) + 1].into();
    let error = many.triangulate(WindingOrder::Clockwise).unwrap_err();
    assert!(error.to_string().contains("65537 vertices"), "{error}");
    assert!(square().cut_hole_in_shape(&many).is_err());
}

#[test]
fn vertices_that_are_not_finite_are_refused() {
    let bad = outline(&[(0.0, 0.0), (f32::NAN, 1.0), (5.0, f32::INFINITY)]);
    assert!(bad.triangulate(WindingOrder::Clockwise).is_err());
    assert!(bad.cut_hole_in_shape(&square()).is_err());
    assert!(square().cut_hole_in_shape(&bad).is_err());
    for (a, b, name) in [(&bad, &square(), "self"), (&square(), &bad, "polygon2")] {
        for result in [a.union(b), a.subtract(b), a.intersect(b)] {
            let error = result.unwrap_err();
            let PolyUnionError::InvalidArgument(Error::InvalidArgument { argument, .. }) = error else {
                panic!("{error}");
            };
            assert_eq!(argument, name);
        }
    }
}

/// Behaviour chapter 15, section 15.5: the second polygon comes back unrounded, from the intersection as well.
#[test]
fn a_polygon_inside_of_another_that_touches_it_is_reported() {
    let mut around = square();
    around[0] = Vector2::new(0.25, 0.25);
    let inner = inner_polygon();
    assert_eq!(inner.union(&around), Err(PolyUnionError::Poly1InsidePoly2 { outline: around.clone() }));
    let nothing = Vertices::new();
    assert_eq!(inner.subtract(&around), Err(PolyUnionError::Poly1InsidePoly2 { outline: nothing }));
    assert_eq!(inner.intersect(&around), Ok(around));
}

#[test]
fn data_of_another_length_than_the_texture_are_refused() {
    for length in [0, 11, 13, 48] {
        assert!(PolygonCreationAssistance::new(&vec![0; length], 4, 3).is_err(), "{length}");
        assert!(PolygonCreationAssistance::from_alpha(&vec![0; length], 4, 3).is_err(), "{length}");
        assert!(!PolygonCreationAssistance::is_valid(length, 4, 3), "{length}");
    }
    for length in [0, 12, 47, 49, 50, 51, 52] {
        assert!(PolygonCreationAssistance::from_rgba(&vec![0; length], 4, 3).is_err(), "{length}");
    }
    assert!(PolygonCreationAssistance::is_valid(12, 4, 3));
    assert!(PolygonCreationAssistance::from_rgba(&[0; 48], 4, 3).is_ok());
}

#[test]
fn textures_without_pixels_or_with_too_many_are_refused() {
    for (width, height) in [(0, 0), (0, 3), (4, 0), ((1 << 24) + 1, 1), (u32::MAX, u32::MAX)] {
        assert!(PolygonCreationAssistance::new(&[], width, height).is_err(), "{width} by {height}");
    }
    assert!(!PolygonCreationAssistance::is_valid(1 << 31, 1 << 16, 1 << 15));
}

#[test]
fn options_start_as_in_the_original_and_are_limited() {
    let data = [0xFF00_0000_u32; 12];
    let mut texture = PolygonCreationAssistance::new(&data, 4, 3).unwrap();
    assert_eq!((texture.data(), texture.width(), texture.height()), (&data[..], 4, 3));
    assert_eq!((texture.alpha_tolerance(), texture.hull_tolerance()), (20, 1.5));
    assert_eq!(texture.hole_detection_line_step_size(), 1);
    assert_eq!((texture.hole_detection(), texture.multipart_detection()), (false, false));
    for (wanted, limited) in [(0.0, 0.9), (2.0, 2.0), (99.0, 4.0)] {
        texture.set_hull_tolerance(wanted).unwrap();
        assert_eq!(texture.hull_tolerance(), limited);
    }
    for bad in [f32::NAN, f32::INFINITY] {
        assert!(texture.set_hull_tolerance(bad).is_err());
        assert_eq!(texture.hull_tolerance(), 4.0);
    }
    for (wanted, limited) in [(i32::MIN, 1), (3, 3), (11, 10)] {
        texture.set_hole_detection_line_step_size(wanted);
        assert_eq!(texture.hole_detection_line_step_size(), limited);
    }
}

#[test]
fn pixels_outside_of_a_texture_are_not_solid() {
    let mut texture = PolygonCreationAssistance::from_alpha(&[255; 12], 4, 3).unwrap();
    texture.set_alpha_tolerance(0);
    let solid = [(0, 0), (3, 2), (4, 0), (0, 3), (-1, 0), (0, -1)].map(|(x, y)| texture.is_solid(x, y));
    assert_eq!(solid, [true, true, false, false, false, false]);
    assert_eq!([-1, 0, 11, 12].map(|i| texture.is_solid_index(i)), [false, true, true, false]);
    let points = [(-0.9, 2.9), (-1.0, 0.0), (4.0, 0.0), (f32::NAN, 0.0)];
    let points = points.map(|(x, y)| Vector2::new(x, y));
    assert_eq!(points.map(|p| texture.is_solid_pixel(p)), [true, false, false, false]);
    assert_eq!(points.map(|p| texture.in_bounds(p)), [false, false, false, false]);
    assert!(texture.in_bounds(Vector2::new(3.9, 2.9)));
}

#[test]
fn rows_between_the_steps_are_not_searched_for_holes() {
    // A gap of three rows, 5 to 7, in a block whose rows 2 to 13 are searched from the first on.
    let pixel = |x: u32, y: u32| {
        (2..14).contains(&x) && (2..14).contains(&y) && !((6..9).contains(&x) && (5..8).contains(&y))
    };
    let alpha: Vec<u8> = (0..256).map(|i| if pixel(i % 16, i / 16) { 255 } else { 0 }).collect();
    let vertices_with_step = |step| {
        let mut texture = PolygonCreationAssistance::from_alpha(&alpha, 16, 16).unwrap();
        texture.set_hole_detection(true);
        texture.set_hole_detection_line_step_size(step);
        Vertices::create_polygons(&texture).unwrap()[0].len()
    };
    let mut texture = PolygonCreationAssistance::from_alpha(&alpha, 16, 16).unwrap();
    texture.set_hole_detection(false);
    let without_hole = Vertices::create_polygons(&texture).unwrap()[0].len();
    assert!(vertices_with_step(1) > without_hole);
    assert_eq!(vertices_with_step(10), without_hole);
}

#[test]
fn crossings_are_sorted_along_their_own_alignment() {
    let at = |x: f32, y: f32, alignment| {
        let zero = Vector2::new(0.0, 0.0);
        CrossingEdgeInfo::new(zero, zero, Vector2::new(x, y), alignment)
    };
    let (left, right) = (at(1.0, 9.0, EdgeAlignment::Vertical), at(2.0, 3.0, EdgeAlignment::Horizontal));
    assert_eq!(left.compare_to(&right), Ordering::Less);
    assert_eq!(right.compare_to(&left), Ordering::Less);
    assert_eq!(left.compare_to(&left), Ordering::Equal);
    assert_eq!(left.compare_to(&at(f32::NAN, 0.0, EdgeAlignment::Vertical)), Ordering::Equal);
}
