//! Outlines against the record: measures and tools of behaviour chapter 05, section 1, and hull and
//! decomposition of chapter 15.

use conformance::units::{Words, assert_bits, assert_words, cases, check};
use farseer_core::math::Vector2;
use farseer_core::shape::Vertices;

fn changed(outline: &Vertices, change: impl FnOnce(&mut Vertices)) -> Vertices {
    let mut copy = outline.clone();
    change(&mut copy);
    copy
}

fn each(outline: &Vertices, of: impl Fn(usize) -> Vector2) -> Vec<Vector2> {
    (0..outline.len()).map(of).collect()
}

#[test]
fn polygon_properties_have_the_recorded_bits() {
    check("polygon_properties", "polygon", |case| {
        let p = &case.input.vertices("vertices");
        case.expect("area", &p.get_area());
        case.expect("centroid", &p.get_centroid());
        case.expect("centroid_with_area_2_5", &p.get_centroid_with_area(2.5));
        case.expect("moment_of_inertia", &p.get_moment_of_inertia().unwrap());
        case.expect("shortest_edge", &p.get_shortest_edge());
        case.expect_bool("is_convex", p.is_convex());
        case.expect("counter_clockwise", &changed(p, |p| p.force_counter_clockwise_order()));
        case.expect("edges", &each(p, |i| p.get_edge(i)));
        case.expect("edge_midpoints", &each(p, |i| p.get_edge_mid_point(i)));
        case.expect("edge_normals", &each(p, |i| p.get_edge_normal(i)));
        case.expect("vertex_normals", &each(p, |i| p.get_vertex_normal(i)));
        case.expect("project_06_08", &p.project_to_axis(Vector2::new(0.6, 0.8)).unwrap());
        case.expect("project_m15_025", &p.project_to_axis(Vector2::new(-1.5, 0.25)).unwrap());
        case.expect("translated_37_m13", &changed(p, |p| p.translate(Vector2::new(3.7, -1.3))));
        case.expect("scaled_11_m07", &changed(p, |p| p.scale(Vector2::new(1.1, -0.7))));
        case.expect("rotated_1234", &changed(p, |p| p.rotate(1.234)));
    });
}

#[test]
fn static_tools_have_the_recorded_bits() {
    check("polygon_properties", "static_tools", |case| {
        let [a, b, c] = ["a", "b", "c"].map(|key| case.input.vector(key));
        case.expect("find_midpoint", &Vertices::find_midpoint(a, b));
        case.expect("find_edge_normal", &Vertices::find_edge_normal(a, b));
        case.expect("find_vertex_normal", &Vertices::find_vertex_normal(a, b, c));
        case.expect("find_normal_angle", &Vertices::find_normal_angle(a));
    });
}

#[test]
fn a_normal_along_an_axis_or_with_a_nan_has_angle_zero() {
    for (x, y) in [(1.0, 0.0), (-1.0, -0.0), (0.0, 1.0), (1.0, f32::NAN), (-1.0, f32::NAN), (f32::NAN, 1.0)] {
        assert_eq!(Vertices::find_normal_angle(Vector2::new(x, y)), 0.0, "{x} {y}");
    }
}

#[test]
fn edges_are_divided_as_recorded() {
    check("subdivide_simplify", "SubDivideEdges", |case| {
        let mut outline = case.input.vertices("vertices");
        outline.sub_divide_edges(case.input.f32("max_edge_length")).unwrap();
        case.expect("vertices", &outline);
    });
}

#[test]
fn outlines_are_simplified_as_recorded() {
    check("subdivide_simplify", "Simplify", |case| {
        case.expect("vertices", &case.input.vertices("vertices").simplify());
    });
    check("subdivide_simplify", "SimplifyBias", |case| {
        let outline = case.input.vertices("vertices");
        case.expect("vertices", &outline.simplify_with_bias(case.input.integer("bias")));
    });
}

#[test]
fn outlines_are_rounded_as_recorded() {
    check("subdivide_simplify", "Round", |case| {
        case.expect("vertices", &case.input.vertices("vertices").round());
    });
}

#[test]
fn hulls_have_the_recorded_bits() {
    check("hull_decompose", "GetConvexHull", |case| {
        case.expect("vertices", &case.input.vertices("vertices").get_convex_hull().unwrap());
    });
}

/// The record has the pieces as geometries store them, in engine winding.
#[test]
fn decomposition_has_the_recorded_pieces() {
    for case in cases("hull_decompose", "DecomposeGeom") {
        let outline = case.input.vertices("vertices");
        let mut pieces = outline.decompose(case.input.integer("max_polys")).unwrap();
        pieces.iter_mut().for_each(|piece| piece.force_counter_clockwise_order());
        let recorded = case.output.vertex_lists("pieces");
        assert_eq!(pieces.len(), recorded.len(), "{case:?}");
        for (piece, recorded) in pieces.iter().zip(&recorded) {
            assert_bits(&piece.words(), &recorded.words(), || format!("{case:?}"));
        }
    }
}

/// The exception recorded for a call, which takes no arguments in the record.
fn recorded_exception(call: &str) -> Option<String> {
    let cases = cases("exceptions", call);
    assert_eq!(cases.len(), 1);
    cases[0].output.value("throws").as_str().map(str::to_owned)
}

fn outline(points: &[(f32, f32)]) -> Vertices {
    points.iter().map(|&(x, y)| Vector2::new(x, y)).collect()
}

fn l_shape() -> Vertices {
    outline(&[(0.0, 0.0), (4.0, 0.0), (4.0, 1.0), (1.0, 1.0), (1.0, 3.0), (0.0, 3.0)])
}

#[test]
fn an_empty_list_has_no_moment_of_inertia() {
    assert_eq!(recorded_exception("Vertices.GetMomentOfInertia empty").unwrap(), "System.ArgumentException");
    assert!(Vertices::new().get_moment_of_inertia().is_err());
}

#[test]
fn one_vertex_has_moment_of_inertia_zero() {
    assert_eq!(recorded_exception("Vertices.GetMomentOfInertia one vertex"), None);
    assert_eq!(outline(&[(1.0, 2.0)]).get_moment_of_inertia(), Ok(0.0));
}

#[test]
fn an_empty_list_has_no_projection() {
    let exception = recorded_exception("Vertices.ProjectToAxis empty").unwrap();
    assert_eq!(exception, "System.ArgumentOutOfRangeException");
    assert!(Vertices::new().project_to_axis(Vector2::new(1.0, 0.0)).is_err());
}

#[test]
fn an_empty_list_has_no_centroid() {
    assert_words(&Vertices::new().get_centroid(), "7fc00000 7fc00000");
}

#[test]
fn an_edge_of_length_zero_has_no_normal() {
    assert_words(&outline(&[(1.0, 1.0), (1.0, 1.0)]).get_edge_normal(0), "7fc00000 7fc00000");
}

#[test]
fn an_empty_list_has_the_greatest_shortest_edge() {
    assert_eq!(Vertices::new().get_shortest_edge(), f32::MAX);
}

#[test]
fn the_l_shape_has_its_known_measures() {
    let l_shape = l_shape();
    assert_eq!(l_shape.get_area(), 6.0);
    assert_eq!(l_shape.get_centroid(), Vector2::new(1.5, 1.0));
    assert_words(&l_shape.get_moment_of_inertia().unwrap(), "3ff30c31");
    assert_eq!(l_shape.get_shortest_edge(), 1.0);
}

#[test]
fn engine_winding_turns_edge_normals_outward() {
    let mut l_shape = l_shape();
    l_shape.force_counter_clockwise_order();
    assert_eq!(l_shape, outline(&[(0.0, 3.0), (1.0, 3.0), (1.0, 1.0), (4.0, 1.0), (4.0, 0.0), (0.0, 0.0)]));
    assert_words(&l_shape.get_edge_normal(0), "80000000 3f800000");
    assert_words(&l_shape.get_vertex_normal(0), "bf3504f3 3f3504f3");
    assert_words(&l_shape.get_vertex_normal(2), "3f3504f3 3f3504f3");
}

#[test]
fn indices_go_around() {
    let l_shape = l_shape();
    assert_eq!([l_shape.next_index(0), l_shape.next_index(5)], [1, 0]);
    assert_eq!([l_shape.previous_index(0), l_shape.previous_index(5)], [5, 4]);
}

#[test]
#[should_panic(expected = "index out of bounds")]
fn an_edge_out_of_range_panics() {
    l_shape().get_edge(6);
}

#[test]
fn vertices_are_written_as_the_original_writes_them() {
    assert_eq!(outline(&[(1.0, 2.5), (-3.0, 0.0)]).to_string(), "{X:1 Y:2.5} {X:-3 Y:0}");
}

#[test]
fn edges_are_not_divided_without_end() {
    for max_edge_length in [0.0, 1e-30, f32::NAN, f32::INFINITY, f32::NEG_INFINITY] {
        let mut divided = l_shape();
        assert!(divided.sub_divide_edges(max_edge_length).is_err(), "{max_edge_length}");
        assert_eq!(divided, l_shape());
    }
}

#[test]
fn a_negative_length_divides_no_edges() {
    let mut divided = l_shape();
    divided.sub_divide_edges(-1.0).unwrap();
    assert_eq!(divided, l_shape());
}

#[test]
fn two_vertices_are_not_simplified() {
    let line = outline(&[(0.4, 0.4), (0.6, 0.6)]);
    assert_eq!(line.simplify_with_bias(5), line);
}

#[test]
fn a_hull_that_cannot_be_found_is_an_error() {
    // The last vertex is on neither side: infinity minus infinity.
    let too_far = outline(&[(0.0, 0.0), (0.0, 0.0), (1e20, 1e20), (3e38, 2e38)]);
    let error = too_far.get_convex_hull().unwrap_err().to_string();
    assert!(error.contains("vertex 3 has no place") && error.contains("simple outline"), "{error}");
}

/// Behaviour chapter 15, check 8.
fn wide_l_shape() -> Vertices {
    outline(&[(0.0, 0.0), (0.0, 6.0), (2.0, 6.0), (2.0, 2.0), (6.0, 2.0), (6.0, 0.0)])
}

#[test]
fn decomposition_stops_at_the_requested_number() {
    let pieces = [-1, 0, 1, 2].map(|max| wide_l_shape().decompose(max).unwrap().len());
    assert_eq!(pieces, [0, 0, 1, 2]);
}

#[test]
fn a_chain_of_pinches_of_any_length_is_decomposed() {
    let points: Vec<(f32, f32)> = (0..20_000).map(|_| (1.0, 1.0)).collect();
    assert_eq!(outline(&points).decompose(1).unwrap(), []);
}

/// A comb has one piece per tooth.
fn comb(teeth: u16) -> Vertices {
    let right = f32::from(4 * teeth);
    let mut points = vec![(0.0, -1.0), (right, -1.0)];
    for tooth in (0..teeth).rev() {
        let x = f32::from(4 * tooth);
        points.extend([(x + 3.0, 0.0), (x + 2.0, 10.0), (x, 0.0)]);
    }
    outline(&points)
}

#[test]
fn more_than_fifty_pieces_are_an_error_only_on_request() {
    let comb = comb(55);
    assert_eq!(comb.decompose(50).unwrap().len(), 50);
    let error = comb.decompose(51).unwrap_err();
    assert!(error.to_string().contains("max_polys_to_find is 51"), "{error}");
}

#[test]
fn lists_without_ears_have_no_pieces() {
    assert_eq!(outline(&[(0.0, 0.0), (1.0, 1.0)]).decompose(5).unwrap(), []);
    // Edges of infinite length have no angles.
    let huge = outline(&[(-3e38, -3e38), (-3e38, 3e38), (3e38, 3e38), (3e38, -3e38)]);
    assert_eq!(huge.decompose(5).unwrap(), []);
}
