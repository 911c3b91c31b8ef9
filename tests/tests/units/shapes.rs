//! Shape creators of behaviour chapter 05, section 1.7, against the record.

use conformance::units::{Case, assert_words, cases, check};
use farseer_core::math::Vector2;
use farseer_core::shape::vertices::MAX_VERTICES;
use farseer_core::shape::{Aabb, Vertices};
use farseer_core::{Error, Result};

/// Outlines of the original are reproduced to the bit; its exceptions are errors here.
fn expect_outline(case: &Case, outline: Result<Vertices>) {
    match case.throws() {
        Some(exception) => {
            assert_eq!(exception, "System.ArgumentException");
            assert!(outline.is_err(), "not refused: {:?}", case.input);
        }
        None => case.expect("vertices", &outline.unwrap()),
    }
}

#[test]
fn rectangles_have_the_recorded_bits() {
    check("shapes", "CreateRectangle", |case| {
        let (width, height) = (case.input.f32("width"), case.input.f32("height"));
        expect_outline(case, Vertices::create_rectangle(width, height));
    });
}

#[test]
fn simple_rectangles_have_the_recorded_bits() {
    check("shapes", "CreateSimpleRectangle", |case| {
        let (width, height) = (case.input.f32("width"), case.input.f32("height"));
        expect_outline(case, Vertices::create_simple_rectangle(width, height));
    });
}

#[test]
fn circles_have_the_recorded_bits() {
    check("shapes", "CreateCircle", |case| {
        let edges = case.input.integer("edges");
        expect_outline(case, Vertices::create_circle(case.input.f32("radius"), edges));
    });
}

#[test]
fn ellipses_have_the_recorded_bits() {
    check("shapes", "CreateEllipse", |case| {
        let (x_radius, y_radius) = (case.input.f32("x_radius"), case.input.f32("y_radius"));
        expect_outline(case, Vertices::create_ellipse(x_radius, y_radius, case.input.integer("edges")));
    });
}

#[test]
fn gears_have_the_recorded_bits() {
    check("shapes", "CreateGear", |case| {
        let gear = Vertices::create_gear(
            case.input.f32("radius"),
            case.input.integer("teeth"),
            case.input.f32("tip_percentage"),
            case.input.f32("tooth_height"),
        );
        expect_outline(case, gear);
    });
}

#[test]
fn capsules_with_equal_ends_have_the_recorded_bits() {
    check("shapes", "CreateCapsule3", |case| {
        let (height, radius) = (case.input.f32("height"), case.input.f32("end_radius"));
        expect_outline(case, Vertices::create_capsule(height, radius, case.input.integer("edges")));
    });
}

#[test]
fn capsules_with_different_ends_have_the_recorded_bits() {
    check("shapes", "CreateCapsule5", |case| {
        let capsule = Vertices::create_capsule_ends(
            case.input.f32("height"),
            case.input.f32("top_radius"),
            case.input.integer("top_edges"),
            case.input.f32("bottom_radius"),
            case.input.integer("bottom_edges"),
        );
        expect_outline(case, capsule);
    });
}

/// The argument that was refused.
fn refused(outline: Result<Vertices>) -> &'static str {
    match outline.unwrap_err() {
        Error::InvalidArgument { argument, .. } => argument,
        error => panic!("{error:?}"),
    }
}

#[test]
fn a_circle_has_its_known_measures() {
    let circle = Vertices::create_circle(10.0, 8).unwrap();
    assert_words(&circle.get_area(), "438d6bde");
    assert_words(&circle.get_moment_of_inertia().unwrap(), "42347949");
    assert_words(&circle.get_centroid(), "3467b46a b367b46a");
}

#[test]
fn circles_of_one_edge_or_fewer_are_one_vertex() {
    for edges in [1, 0, -3, i32::MIN] {
        assert_words(&Vertices::create_circle(1.0, edges).unwrap(), "3f800000 00000000");
    }
}

#[test]
fn gears_without_teeth_are_empty() {
    for teeth in [0, -1, i32::MIN] {
        assert_eq!(Vertices::create_gear(1.0, teeth, 1.0, 1.0).unwrap(), Vertices::new());
    }
}

#[test]
fn capsules_have_positive_area() {
    let mut capsule = Vertices::create_capsule(10.0, 2.0, 3).unwrap();
    assert_words(&capsule[..2], "40000000 40400000 3f7fffff 40976cf6");
    capsule.force_counter_clockwise_order();
    assert_words(&capsule[..2], "40000000 c0400000 3f800001 c0976cf6");
}

#[test]
fn capsules_name_the_argument_that_is_wrong() {
    assert_eq!(refused(Vertices::create_capsule(0.0, 2.0, 3)), "end_radius");
    assert_eq!(refused(Vertices::create_capsule(-1.0, -2.0, 1)), "height");
    assert_eq!(refused(Vertices::create_capsule(10.0, 2.0, 0)), "edges");
    assert_eq!(refused(Vertices::create_capsule_ends(10.0, 5.0, 1, 2.0, 1)), "top_radius");
    assert_eq!(refused(Vertices::create_capsule_ends(10.0, 2.0, 1, 5.0, 1)), "bottom_radius");
    assert_eq!(refused(Vertices::create_capsule_ends(10.0, 2.0, 1, 2.0, 0)), "bottom_edges");
}

#[test]
fn a_capsule_with_ends_too_large_is_refused_as_recorded() {
    let recorded = &cases("exceptions", "Vertices.CreateCapsule endRadius too large")[0];
    assert_eq!(recorded.throws(), Some("System.ArgumentException"));
    assert_eq!(recorded.output.text("parameter"), "endRadius");
    assert_eq!(refused(Vertices::create_capsule(10.0, 5.0, 4)), "end_radius");
}

/// The original makes outlines of NaN vertices from these.
#[test]
fn sizes_that_are_not_finite_are_refused() {
    for bad in [f32::NAN, f32::INFINITY, f32::NEG_INFINITY] {
        assert_eq!(refused(Vertices::create_rectangle(bad, 1.0)), "width");
        assert_eq!(refused(Vertices::create_rectangle(1.0, bad)), "height");
        assert_eq!(refused(Vertices::create_simple_rectangle(bad, 1.0)), "width");
        assert_eq!(refused(Vertices::create_simple_rectangle(1.0, bad)), "height");
        assert_eq!(refused(Vertices::create_circle(bad, 8)), "radius");
        assert_eq!(refused(Vertices::create_ellipse(bad, 1.0, 8)), "x_radius");
        assert_eq!(refused(Vertices::create_ellipse(1.0, bad, 8)), "y_radius");
        assert_eq!(refused(Vertices::create_gear(bad, 8, 0.5, 1.0)), "radius");
        assert_eq!(refused(Vertices::create_gear(1.0, 8, bad, 1.0)), "tip_percentage");
        assert_eq!(refused(Vertices::create_gear(1.0, 8, 0.5, bad)), "tooth_height");
        assert_eq!(refused(Vertices::create_capsule(bad, 1.0, 8)), "height");
        assert_eq!(refused(Vertices::create_capsule(10.0, bad, 8)), "end_radius");
        assert_eq!(refused(Vertices::create_capsule_ends(10.0, bad, 8, 1.0, 8)), "top_radius");
        assert_eq!(refused(Vertices::create_capsule_ends(10.0, 1.0, 8, bad, 8)), "bottom_radius");
    }
}

#[test]
fn negative_sizes_are_accepted() {
    let mirrored = Vertices::create_simple_rectangle(-2.0, 4.0).unwrap();
    assert_eq!(mirrored[0], Vector2::new(1.0, -2.0));
}

#[test]
fn more_vertices_than_memory_holds_are_refused() {
    let too_many = i32::try_from(MAX_VERTICES).unwrap() + 1;
    assert_eq!(refused(Vertices::create_circle(1.0, too_many)), "number_of_edges");
    assert_eq!(refused(Vertices::create_gear(1.0, i32::MAX, 0.5, 1.0)), "number_of_teeth");
    assert_eq!(refused(Vertices::create_capsule_ends(10.0, 1.0, i32::MAX, 1.0, 1)), "top_edges");
}

fn box_of_chapter_05() -> Aabb {
    Aabb::new(Vector2::new(1.0, 2.0), Vector2::new(5.0, 10.0))
}

#[test]
fn the_distance_of_a_box_from_a_point_is_negative_inside() {
    let distances = [(8.0, 14.0), (8.0, 6.0), (2.0, 6.0)]
        .map(|(x, y)| box_of_chapter_05().get_distance(Vector2::new(x, y)));
    assert_eq!(distances, [5.0, 3.0, -1.0]);
}

#[test]
fn a_point_on_the_side_of_a_box_is_not_in_it() {
    let contained = [(1.0, 3.0), (1.00001, 3.0), (1.0001, 3.0), (5.0, 10.0)]
        .map(|(x, y)| box_of_chapter_05().contains(Vector2::new(x, y)));
    assert_eq!(contained, [false, false, true, false]);
}

#[test]
fn a_point_must_keep_a_margin_from_the_sides_of_its_box() {
    let unit = Aabb::new(Vector2::new(0.0, 0.0), Vector2::new(1.0, 1.0));
    let margin = f32::from_bits(0x3727_C5AC);
    assert!(!unit.contains(Vector2::new(margin, 0.5)));
    assert!(unit.contains(Vector2::new(margin.next_up(), 0.5)));
}

#[test]
fn a_box_moves_to_a_new_centre() {
    let mut moved = box_of_chapter_05();
    moved.set_position(Vector2::new(0.0, 0.0));
    assert_eq!(moved, Aabb::new(Vector2::new(-2.0, -4.0), Vector2::new(2.0, 4.0)));
}

#[test]
fn boxes_that_touch_intersect() {
    let beside = Aabb::new(Vector2::new(5.0, 2.0), Vector2::new(6.0, 3.0));
    let apart = Aabb::new(Vector2::new(5.1, 2.0), Vector2::new(6.0, 3.0));
    assert!(Aabb::intersect(&box_of_chapter_05(), &beside));
    assert!(!Aabb::intersect(&box_of_chapter_05(), &apart));
}

#[test]
fn a_nan_counts_as_overlap() {
    let nan = Aabb::new(Vector2::new(f32::NAN, f32::NAN), Vector2::new(f32::NAN, f32::NAN));
    assert!(Aabb::intersect(&box_of_chapter_05(), &nan));
}

#[test]
fn a_box_has_the_original_hash() {
    assert_eq!(box_of_chapter_05().hash_code(), 18);
}

#[test]
fn the_box_of_an_outline_encloses_it() {
    let gear = Vertices::create_gear(10.0, 3, 0.5, 2.0).unwrap();
    let aabb = Aabb::from_vertices(&gear);
    assert_words(&aabb.min, "c1400000 c12646e2");
    assert_words(&aabb.max, "412646e1 41400000");
}

#[test]
fn the_box_of_an_empty_outline_is_zero() {
    assert_eq!(Aabb::from_vertices(&[]), Aabb::default());
}

#[test]
fn a_nan_stays_in_a_box_only_from_the_first_vertex() {
    let (nan, one) = (Vector2::new(f32::NAN, 0.0), Vector2::new(1.0, 1.0));
    assert!(Aabb::from_vertices(&[nan, one]).min.x.is_nan());
    assert_eq!(Aabb::from_vertices(&[one, nan]).min, Vector2::new(1.0, 0.0));
}
