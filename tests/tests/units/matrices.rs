//! Matrices of behaviour chapter 01 against the record.

use conformance::units::{assert_words, check};
use farseer_core::math::{Matrix, Vector2, Vector3, math_helper, matrix, scalar, vector2};

#[test]
fn matrix_functions_have_the_recorded_bits() {
    check("matrix", "matrix", |case| {
        let m = case.input.matrix("matrix");
        let point = case.input.vector("point");
        case.expect("inverse", &matrix::invert(&m));
        case.expect("inverse_by_value", &matrix::invert(&m));
        case.expect("transpose", &matrix::transpose(&m));
        case.expect("transform", &vector2::transform(point, &m));
        case.expect("transform_normal", &vector2::transform_normal(point, &m));
        case.expect("right", &matrix::right(&m));
        case.expect("up", &matrix::up(&m));
    });
}

#[test]
fn products_and_sums_have_the_recorded_bits() {
    check("matrix", "multiply_add", |case| {
        let (a, b) = (case.input.matrix("a"), case.input.matrix("b"));
        case.expect("product", &matrix::multiply(&a, &b));
        case.expect("sum", &matrix::add(&a, &b));
    });
}

#[test]
fn rotations_have_the_recorded_bits() {
    check("matrix", "rotation_z", |case| {
        let angle = case.input.f32("angle");
        case.expect("cos", &scalar::cos(angle));
        case.expect("sin", &scalar::sin(angle));
        let m = matrix::create_rotation_z(angle);
        case.expect("cos", &m.m11);
        case.expect("sin", &m.m12);
    });
}

#[test]
fn a_quarter_turn_has_the_rounding_error_of_pi() {
    let m = matrix::create_rotation_z(math_helper::PI_OVER_2);
    assert_words(&m.m11, "b33bbd2e");
    assert_words(&m.m12, "3f800000");
}

#[test]
fn a_rotation_by_zero_keeps_its_sign() {
    assert_words(&matrix::create_rotation_z(0.0).m21, "80000000");
    assert_words(&matrix::create_rotation_z(-0.0).m12, "80000000");
    assert_words(&matrix::create_rotation_z(-0.0).m21, "00000000");
}

#[test]
fn angles_of_two_to_the_63_and_more_give_themselves() {
    let m = matrix::create_rotation_z(-1e19);
    assert_eq!([m.m11, m.m12, m.m21, m.m22], [-1e19, -1e19, 1e19, -1e19]);
}

#[test]
fn angles_that_are_not_finite_give_nan() {
    for angle in [f32::NAN, f32::INFINITY, f32::NEG_INFINITY] {
        assert!(scalar::sin(angle).is_nan() && scalar::cos(angle).is_nan());
    }
}

/// Behaviour chapter 01, check 8.
fn rotated_and_moved() -> Matrix {
    let mut m = matrix::create_rotation_z(0.5);
    (m.m41, m.m42) = (3.0, -4.0);
    m
}

#[test]
fn the_inverse_of_a_rigid_motion_is_almost_one() {
    let inverse = matrix::invert(&rotated_and_moved());
    assert_words(&inverse.m11, "3f60a940");
    assert_words(&inverse.m12, "bef57744");
    assert_words(&inverse.m21, "3ef57744");
    assert_words(&inverse.m41, "bf370d38");
    assert_words(&inverse.m42, "409e5afd");
    assert_words(&inverse.m43, "80000000");
    assert_eq!([inverse.m22, inverse.m33, inverse.m44], [inverse.m11, 1.0, 1.0]);
}

#[test]
fn a_point_there_and_back_has_moved_a_little() {
    let m = rotated_and_moved();
    let there = vector2::transform(Vector2::new(1.5, -2.5), &m);
    assert_words(&there, "40b07a5e c0af31b6");
    assert_words(&vector2::transform(there, &matrix::invert(&m)), "3fbffffc c0200000");
}

#[test]
fn a_normal_is_not_moved() {
    let normal = vector2::transform_normal(Vector2::new(1.5, -2.5), &rotated_and_moved());
    assert_words(&normal, "4020f4bd bfbcc6d6");
}

#[test]
fn the_inverse_of_the_identity_has_negative_zeros() {
    let inverse = matrix::invert(&Matrix::identity());
    for zero in [inverse.m12, inverse.m21, inverse.m41, inverse.m43] {
        assert_words(&zero, "80000000");
    }
    assert_words(&inverse.m42, "00000000");
}

#[test]
fn the_inverse_of_zero_is_nan() {
    assert!(matrix::invert(&Matrix::zeros()).iter().all(|element| element.is_nan()));
}

#[test]
fn a_product_turns_negative_zeros_positive() {
    let product = matrix::multiply(&matrix::create_rotation_z(0.0), &Matrix::identity());
    assert_words(&product.m21, "00000000");
}

#[test]
fn a_product_applies_its_first_factor_first() {
    let quarter_turn = matrix::create_rotation_z(math_helper::PI_OVER_2);
    let shift = matrix::create_translation(10.0, 0.0, 0.0);
    let point = vector2::transform(Vector2::new(1.0, 0.0), &matrix::multiply(&quarter_turn, &shift));
    assert_eq!(point, Vector2::new(10.0, 1.0));
}

#[test]
fn rows_can_be_set() {
    let mut m = Matrix::zeros();
    matrix::set_right(&mut m, Vector3::new(1.0, 2.0, 3.0));
    matrix::set_up(&mut m, Vector3::new(4.0, 5.0, 6.0));
    assert_eq!([m.m11, m.m12, m.m13, m.m14, m.m21, m.m22, m.m23], [1.0, 2.0, 3.0, 0.0, 4.0, 5.0, 6.0]);
}
