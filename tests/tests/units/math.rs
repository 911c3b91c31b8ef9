//! Behaviour chapter 01 against the record: scalar and vector helpers, interpolators, unit conversion; and
//! the boxes of chapter 05, which are recorded with them.

use conformance::units::{Case, assert_words, check};
use farseer_core::math::{
    BilinearInterpolator, CircularInterpolator, ConvertUnits, Vector2, calculator, math_helper, scalar,
    vector2,
};
use farseer_core::shape::Aabb;

/// Numbers at the nodes of both interpolators in the record. Like all constants in this file they are not in the record but
/// follow from its results, here from those at corners and on axes.
const VALUES: [f32; 4] = [1.0, -2.0, 3.5, 7.0];

fn scalars(case: &Case) -> [f32; 5] {
    ["a", "b", "c", "d", "t"].map(|key| case.input.f32(key))
}

fn vectors(case: &Case) -> [Vector2; 4] {
    ["a", "b", "c", "d"].map(|key| case.input.vector(key))
}

#[test]
fn math_helper_has_the_recorded_bits() {
    check("math", "MathHelper", |case| {
        let [a, b, c, d, t] = scalars(case);
        case.expect("barycentric", &math_helper::barycentric(a, b, c, t, d));
        case.expect("catmull_rom", &math_helper::catmull_rom(a, b, c, d, t));
        case.expect("clamp", &math_helper::clamp(a, b, c));
        case.expect("distance", &math_helper::distance(a, b));
        case.expect("hermite", &math_helper::hermite(a, b, c, d, t));
        case.expect("lerp", &math_helper::lerp(a, b, t));
        case.expect("max", &math_helper::max(a, b));
        case.expect("min", &math_helper::min(a, b));
        case.expect("smooth_step", &math_helper::smooth_step(a, b, t));
        case.expect("to_degrees", &math_helper::to_degrees(a));
        case.expect("to_radians", &math_helper::to_radians(a));
    });
}

#[test]
fn max_and_min_have_the_recorded_corner_cases() {
    check("math", "MathHelperMinMax", |case| {
        let (a, b) = (case.input.f32("a"), case.input.f32("b"));
        case.expect("max", &scalar::max(a, b));
        case.expect("min", &scalar::min(a, b));
    });
}

#[test]
fn calculator_has_the_recorded_bits() {
    check("math", "Calculator", |case| {
        let [a, b, _, _] = vectors(case);
        let (x, y) = (case.input.f32("x"), case.input.f32("y"));
        case.expect("sin_x", &calculator::sin(x));
        case.expect("cos_x", &calculator::cos(x));
        case.expect("acos_y", &calculator::acos(y));
        case.expect("atan2_y_x", &calculator::atan2(y, x));
        case.expect("cross_ab", &calculator::cross(a, b));
        case.expect("cross_a_x", &calculator::cross_vector_scalar(a, x));
        case.expect("cross_x_a", &calculator::cross_scalar_vector(x, a));
        case.expect("degrees_to_radians_x", &calculator::degrees_to_radians(x));
        case.expect("clamp_x", &calculator::clamp(x, -2.0, 2.0));
        case.expect_bool("between_non_inclusive", calculator::is_between_non_inclusive(x, -5.0, 5.0));
        case.expect("vector_to_radians", &calculator::vector_to_radians(a));
        case.expect("radians_to_vector", &calculator::radians_to_vector(x));
        case.expect("rotate_vector_a_x", &calculator::rotate_vector(a, x));
        calculator_distances(case);
        calculator_curves(case);
        calculator_interpolation(case);
    });
}

fn calculator_distances(case: &Case) {
    let [a, b, c, d] = vectors(case);
    case.expect("distance_points", &calculator::distance_between_point_and_point(a, b));
    case.expect("distance_point_segment", &calculator::distance_between_point_and_line_segment(a, b, c));
    case.expect("project_a_onto_b", &calculator::project(a, b));
    let mut argument = a;
    case.expect("truncate_a_3", &calculator::truncate(&mut argument, 3.0));
    case.expect("truncate_a_3_first_argument_after", &argument);
    let mut axis = Vector2::new(0.6, -0.8);
    case.expect("project_axis", &calculator::project_to_axis(&[a, b, c, d], &mut axis).unwrap());
}

fn calculator_curves(case: &Case) {
    let [a, b, c, d] = vectors(case);
    let (x, y, t) = (case.input.f32("x"), case.input.f32("y"), case.input.f32("t"));
    case.expect("linear_bezier", &calculator::linear_bezier_curve(a, b, t));
    case.expect("quadratic_bezier", &calculator::quadratic_bezier_curve(a, b, c, t));
    let (point, angle) = calculator::quadratic_bezier_curve_with_radians(a, b, c, t);
    case.expect("quadratic_bezier_with_angle", &point);
    case.expect("quadratic_angle", &angle);
    case.expect("cubic_bezier", &calculator::cubic_bezier_curve(a, b, c, d, t));
    let (point, angle) = calculator::cubic_bezier_curve_with_radians(a, b, c, d, t);
    case.expect("cubic_bezier_with_angle", &point);
    case.expect("cubic_angle", &angle);
    case.expect("cubic_bezier2", &calculator::cubic_bezier_curve2(a, b, c, d, t));
    let (point, angle) = calculator::cubic_bezier_curve2_with_radians(a, b, c, d, t);
    case.expect("cubic_bezier2_with_angle", &point);
    case.expect("cubic2_angle", &angle);
    let (point, angle) = calculator::cubic_bezier_curve2_with_directions(a, (x, 3.0), c, (y, 2.0), t);
    case.expect("cubic_bezier2_directions", &point);
    case.expect("cubic2_directions_angle", &angle);
}

fn calculator_interpolation(case: &Case) {
    let [a, b, _, _] = vectors(case);
    let (x, y, t) = (case.input.f32("x"), case.input.f32("y"), case.input.f32("t"));
    case.expect("interpolate_normal", &calculator::interpolate_normal(a, b, t));
    case.expect("interpolate_normal_in_place", &calculator::interpolate_normal(a, b, t));
    case.expect("interpolate_rotation", &calculator::interpolate_rotation(x, y, t));
    let (min, max) = (Vector2::new(-4.0, -5.0), Vector2::new(5.0, 4.0));
    case.expect("bilerp", &calculator::bi_lerp(a, min, max, 1.5, 2.5, -3.5, 4.5, -3.0, 4.0));
}

#[test]
fn vector_operations_have_the_recorded_bits() {
    check("math", "Vector2", |case| {
        let [a, b, c, d] = vectors(case);
        let t = case.input.f32("t");
        case.expect("barycentric", &vector2::barycentric(a, b, c, t, 0.3));
        case.expect("catmull_rom", &vector2::catmull_rom(a, b, c, d, t));
        case.expect("clamp", &vector2::clamp(a, b, c));
        case.expect("distance", &vector2::distance(a, b));
        case.expect("distance_squared", &vector2::distance_squared(a, b));
        case.expect("divide", &vector2::divide(a, b));
        case.expect("divide_scalar", &vector2::divide_by(a, t));
        case.expect("operator_div", &vector2::divide(a, b));
        case.expect("operator_div_scalar", &vector2::divide_by(a, t));
        case.expect("dot", &vector2::dot(a, b));
        case.expect("hermite", &vector2::hermite(a, b, c, d, t));
        case.expect("length", &vector2::length(a));
        case.expect("length_squared", &vector2::length_squared(a));
        case.expect("lerp", &vector2::lerp(a, b, t));
        case.expect("max", &vector2::max(a, b));
        case.expect("min", &vector2::min(a, b));
        case.expect("normalize", &vector2::normalize(a));
        case.expect("smooth_step", &vector2::smooth_step(a, b, t));
        case.expect("negate", &vector2::negate(a));
        case.expect_bool("equals", a == b);
    });
}

#[test]
fn interpolators_have_the_recorded_bits() {
    check("math", "interpolators", |case| {
        let bilinear = BilinearInterpolator {
            min: case.input.vector("min"),
            max: case.input.vector("max"),
            values: VALUES,
            min_value: -1.5,
            max_value: 6.0,
        };
        case.expect("bilinear", &bilinear.get_value(case.input.vector("point")));
        let circular = CircularInterpolator::new(VALUES, f32::MIN, f32::MAX);
        case.expect("circular", &circular.get_value(case.input.vector("circular_point")));
    });
}

#[test]
fn unit_conversion_has_the_recorded_bits() {
    check("math", "ConvertUnits", |case| {
        let units = ConvertUnits::new(case.input.f32("ratio")).unwrap();
        let value = case.input.f32("value");
        case.expect("to_display", &units.to_display_units(value));
        case.expect("to_sim", &units.to_sim_units(value));
        case.expect("to_sim_double", &units.to_sim_units(f64::from(value)));
        case.expect("to_sim_int_7", &units.to_sim_units(7));
        case.expect("to_display_int_7", &units.to_display_units(7));
    });
}

#[test]
fn boxes_have_the_recorded_bits() {
    check("math", "AABB", |case| {
        let mut aabb = Aabb::new(case.input.vector("min"), case.input.vector("max"));
        let other = Aabb::new(case.input.vector("min2"), case.input.vector("max2"));
        let point = case.input.vector("point");
        case.expect("width", &aabb.width());
        case.expect("height", &aabb.height());
        case.expect("position", &aabb.position());
        case.expect("center", &aabb.get_center());
        case.expect("shortest_side", &aabb.get_shortest_side());
        case.expect("distance", &aabb.get_distance(point));
        case.expect_bool("contains", aabb.contains(point));
        case.expect_bool("intersect", Aabb::intersect(&aabb, &other));
        case.expect("vertices", &aabb.get_vertices());
        aabb.set_position(point);
        case.expect("moved_min", &aabb.min);
        case.expect("moved_max", &aabb.max);
    });
}

#[test]
fn the_zero_vector_has_no_direction() {
    assert_words(&vector2::normalize(Vector2::new(0.0, 0.0)), "7fc00000 7fc00000");
}

#[test]
fn vectors_too_short_or_too_long_to_square_do_not_normalize() {
    assert_words(&vector2::normalize(Vector2::new(1e-30, 0.0)), "7f800000 7fc00000");
    assert_words(&vector2::normalize(Vector2::new(1e30, 0.0)), "00000000 00000000");
}

#[test]
fn a_vector_is_divided_by_multiplication_with_the_reciprocal() {
    assert_words(&vector2::divide_by(Vector2::new(5.0, 7.0), 3.0), "3fd55556 40155556");
    assert_words(&vector2::divide_by(Vector2::new(9.0, 10.0), 10.0), "3f666667 3f800000");
}

#[test]
fn a_vector_has_the_original_hash() {
    assert_eq!(vector2::hash_code(Vector2::new(1.75, -3.5)), -1);
}

#[test]
fn a_vector_is_written_as_the_original_writes_it() {
    assert_eq!(vector2::to_text(Vector2::new(1.5, -2.0)), "{X:1.5 Y:-2}");
}

#[test]
fn lerp_need_not_reach_its_end() {
    assert_eq!(math_helper::lerp(1e8, 1.0, 1.0), 0.0);
}

#[test]
fn the_two_conversions_of_degrees_differ() {
    assert_words(&math_helper::to_radians(27.0), "3ef1463a");
    assert_words(&calculator::degrees_to_radians(27.0), "3ef14639");
}

#[test]
fn half_a_turn_is_180_degrees() {
    assert_eq!(math_helper::to_radians(180.0), math_helper::PI);
    assert_eq!(math_helper::to_degrees(math_helper::PI), 180.0);
    assert_eq!(math_helper::to_degrees(1.0), calculator::DEGREES_TO_RADIANS_RATIO);
}

#[test]
fn equal_values_give_the_second_as_maximum_and_minimum() {
    assert_words(&(scalar::max(0.0, -0.0), scalar::max(-0.0, 0.0)), "80000000 00000000");
    assert_words(&(scalar::min(0.0, -0.0), scalar::min(-0.0, 0.0)), "80000000 00000000");
}

#[test]
fn a_nan_is_maximum_and_minimum() {
    for (a, b) in [(f32::NAN, 1.0), (1.0, f32::NAN)] {
        assert!(scalar::max(a, b).is_nan() && scalar::min(a, b).is_nan());
    }
}

#[test]
fn zeros_and_nan_have_no_sign() {
    assert_eq!([2.5, -0.1, 0.0, -0.0, f32::NAN].map(scalar::sign), [1.0, -1.0, 0.0, 0.0, 0.0]);
}

#[test]
fn the_two_clamps_differ_in_the_sign_of_zero() {
    assert_words(&calculator::clamp(-0.0, -0.0, 0.0), "00000000");
    assert_words(&math_helper::clamp(-0.0, 0.0, 1.0), "80000000");
}

#[test]
fn both_clamps_give_the_lower_end_of_a_range_in_the_wrong_order() {
    assert_eq!(calculator::clamp(5.0, 1.0, -1.0), 1.0);
    assert_eq!(math_helper::clamp(0.0, 1.0, -1.0), 1.0);
}

#[test]
fn numbers_out_of_range_truncate_to_the_least_integer() {
    let out_of_range = [2_147_483_648.0, 1e20, -1e20, f32::NAN, f32::INFINITY, f32::NEG_INFINITY];
    assert_eq!(out_of_range.map(scalar::to_int), [i32::MIN; 6]);
    assert_eq!([2.9, -2.9, 2_147_483_520.0].map(scalar::to_int), [2, -2, 2_147_483_520]);
}

#[test]
fn the_least_integer_is_not_out_of_range() {
    assert_eq!(scalar::to_int_f64(-2_147_483_647.5), -2_147_483_647);
    assert_eq!(scalar::to_int_f64(-2_147_483_648.5), i32::MIN);
    assert_eq!(scalar::to_int_f64(2_147_483_647.5), i32::MAX);
}

#[test]
fn angles_of_vectors_are_measured_from_up() {
    assert_words(&calculator::vector_to_radians(Vector2::new(1.0, 0.0)), "3fc90fdb");
    assert_words(&calculator::vector_to_radians(Vector2::new(0.0, 0.0)), "40490fdb");
    assert_eq!(calculator::vector_to_radians(Vector2::new(0.0, -1.0)), 0.0);
}

#[test]
fn a_vector_turns_with_its_length() {
    let right = calculator::rotate_vector(Vector2::new(0.0, -2.0), math_helper::PI_OVER_2);
    assert_words(&right, "40000000 33bbbd2e");
}

#[test]
fn truncate_normalizes_its_argument() {
    let mut argument = Vector2::new(3.0, 4.0);
    assert_words(&calculator::truncate(&mut argument, 2.0), "3f99999a 3fcccccd");
    assert_words(&argument, "3f19999a 3f4ccccd");
}

#[test]
fn truncating_to_a_length_below_zero_leaves_the_argument() {
    let mut argument = Vector2::new(3.0, 4.0);
    assert_eq!(calculator::truncate(&mut argument, -2.0), Vector2::new(-6.0, -8.0));
    assert_eq!(argument, Vector2::new(3.0, 4.0));
}

#[test]
fn the_axis_of_a_projection_is_normalized() {
    let mut axis = Vector2::new(0.0, 2.0);
    let range = calculator::project_to_axis(&[Vector2::new(1.0, 3.0), Vector2::new(1.0, -1.0)], &mut axis);
    assert_eq!(range, Ok((-1.0, 3.0)));
    assert_eq!(axis, Vector2::new(0.0, 1.0));
}

#[test]
fn no_points_have_no_projection() {
    assert!(calculator::project_to_axis(&[], &mut Vector2::new(0.0, 2.0)).is_err());
}

#[test]
fn a_random_number_lies_in_its_range() {
    assert_eq!([0.0, 0.25, 0.5].map(|u| calculator::random_number(-2.0, 6.0, u)), [-2.0, 0.0, 2.0]);
}

#[test]
fn control_points_given_by_direction_are_relative_to_the_origin() {
    let (start, end) = (Vector2::new(1.0, 2.0), Vector2::new(5.0, -1.0));
    let (point, radians) =
        calculator::cubic_bezier_curve2_with_directions(start, (0.5, 2.0), end, (1.5, 3.0), 0.3);
    assert_words(&point, "3fbbb414 be1edbf2");
    assert_words(&radians, "3f2d447f");
}

#[test]
fn an_empty_rectangle_interpolates_to_nan() {
    assert!(BilinearInterpolator::default().get_value(Vector2::new(1.0, 1.0)).is_nan());
}

#[test]
fn a_new_bilinear_interpolator_is_zero_everywhere() {
    let zero = BilinearInterpolator::new(Vector2::new(0.0, 0.0), Vector2::new(1.0, 1.0));
    assert_eq!(zero.get_value(Vector2::new(0.25, 0.75)), 0.0);
}

#[test]
fn circular_interpolation_takes_the_difference_for_the_distance() {
    let circular = CircularInterpolator::new([1.0, 2.0, 3.0, 4.0], -10.0, 10.0);
    let value = |x, y| circular.get_value(Vector2::new(x, y));
    assert_words(&value(0.5, 0.25), "4002e405");
    assert_words(&value(-0.5, -0.25), "4022e405");
    assert_eq!(value(0.0, 0.5), 2.5);
}

#[test]
fn circular_interpolation_is_zero_at_the_origin_and_for_nan() {
    let circular = CircularInterpolator::new([1.0, 2.0, 3.0, 4.0], -10.0, 10.0);
    assert_eq!(circular.get_value(Vector2::new(0.0, 0.0)), 0.0);
    assert_eq!(circular.get_value(Vector2::new(f32::NAN, 1.0)), 0.0);
}

#[test]
fn circular_interpolation_stays_in_its_limits() {
    let circular = CircularInterpolator::new([1.0, 2.0, 3.0, 4.0], 2.0, 2.25);
    assert_eq!(circular.get_value(Vector2::new(0.0, 0.5)), 2.25);
    assert_eq!(circular.get_value(Vector2::new(0.0, 0.0)), 2.0);
}

#[test]
fn simulation_units_are_converted_by_the_reciprocal() {
    let mut units = ConvertUnits::default();
    assert_words(&units.to_sim_units(7), "3e0f5c29");
    units.set_display_unit_to_sim_unit_ratio(30.0).unwrap();
    assert_words(&units.to_sim_units(7.0_f32), "3e6eeef0");
}

#[test]
fn vectors_and_pairs_convert_by_component() {
    let units = ConvertUnits::default();
    assert_eq!(units.to_display_units(Vector2::new(1.0, -2.0)), Vector2::new(50.0, -100.0));
    assert_eq!(units.to_display_units((1, -2)), Vector2::new(50.0, -100.0));
    assert_eq!(units.to_sim_units((100.0_f64, 50.0)), units.to_sim_units((100.0_f32, 50.0)));
}

/// The original accepts every ratio.
#[test]
fn a_ratio_that_is_not_finite_is_refused() {
    for ratio in [f32::NAN, f32::INFINITY, f32::NEG_INFINITY] {
        assert!(ConvertUnits::new(ratio).is_err());
    }
}
