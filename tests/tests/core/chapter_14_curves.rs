//! Checks of behaviour chapter 14 on curves; those on paths are in `chapter_14_paths`.

use conformance::units::assert_words;
use farseer_core::{
    Curve, CurveContinuity, CurveKey, CurveKeyCollection, CurveLoopType, CurveTangent, Error,
};
use proptest::prelude::*;

fn key(position: f32, value: f32) -> CurveKey {
    CurveKey::new(position, value).unwrap()
}

fn curve(keys: &[(f32, f32)]) -> Curve {
    let mut curve = Curve::new();
    for &(position, value) in keys {
        curve.keys_mut().add(key(position, value));
    }
    curve
}

/// The curve of checks 1 to 4.
fn bent(tangent: CurveTangent) -> Curve {
    let mut curve = curve(&[(0.0, 0.0), (1.0, 10.0), (3.0, 4.0)]);
    curve.compute_tangents(tangent);
    curve
}

fn looped(mut curve: Curve, loop_type: CurveLoopType) -> Curve {
    curve.set_pre_loop(loop_type);
    curve.set_post_loop(loop_type);
    curve
}

fn expect_tangents(curve: &Curve, expected: [(&str, &str); 3]) {
    for (key, (tangent_in, tangent_out)) in curve.keys().iter().zip(expected) {
        assert_words(&key.tangent_in(), tangent_in);
        assert_words(&key.tangent_out(), tangent_out);
    }
}

fn expect_values(curve: &Curve, expected: &[(f32, &str)]) {
    for &(x, words) in expected {
        assert_words(&curve.evaluate(x).unwrap(), words);
    }
}

/// Check 1.
#[test]
fn tangents_are_smooth_or_linear() {
    let smooth = [("00000000", "41200000"), ("3faaaaab", "402aaaab"), ("c0c00000", "80000000")];
    expect_tangents(&bent(CurveTangent::Smooth), smooth);
    let linear = [("00000000", "41200000"), ("41200000", "c0c00000"), ("c0c00000", "00000000")];
    expect_tangents(&bent(CurveTangent::Linear), linear);
}

/// Check 2.
#[test]
fn a_curve_runs_through_its_keys() {
    let inside = [(0.3, "4062f1aa"), (1.0, "41200000"), (2.2, "40e76c8b"), (3.0, "40800000")];
    expect_values(&bent(CurveTangent::Smooth), &inside);
}

/// Check 3.
#[test]
fn curves_repeat_themselves_outside_of_their_keys() {
    let bent = bent(CurveTangent::Smooth);
    let cycle = [
        (-4.0, "41015556"),
        (-3.0, "40800000"),
        (-1.5, "411b8000"),
        (3.5, "40c2aaab"),
        (6.0, "00000000"),
        (7.25, "41214555"),
    ];
    expect_values(&looped(bent.clone(), CurveLoopType::Cycle), &cycle);
    let offset =
        [(-4.0, "3daaab00"), (-3.0, "c0800000"), (3.5, "41215556"), (6.0, "41000000"), (7.25, "4190a2aa")];
    expect_values(&looped(bent.clone(), CurveLoopType::CycleOffset), &offset);
    let oscillating = [(-4.0, "41015556"), (3.5, "40bd0000"), (6.0, "00000000"), (7.25, "41214555")];
    expect_values(&looped(bent.clone(), CurveLoopType::Oscillate), &oscillating);
    expect_values(&bent, &[(-4.0, "00000000"), (7.25, "40800000")]);
}

/// Check 4.
#[test]
fn a_linear_end_takes_the_tangents_of_the_first_key() {
    let mut linear = looped(bent(CurveTangent::Smooth), CurveLoopType::Linear);
    assert_eq!(linear.evaluate(3.5), Ok(9.0));
    assert_eq!(linear.evaluate(6.0), Ok(34.0));
    linear.keys_mut().get_mut(0).unwrap().set_tangent_in(2.0).unwrap();
    linear.keys_mut().get_mut(0).unwrap().set_tangent_out(3.0).unwrap();
    linear.keys_mut().get_mut(2).unwrap().set_tangent_out(100.0).unwrap();
    assert_eq!(linear.evaluate(-2.0), Ok(-4.0));
    assert_eq!(linear.evaluate(5.0), Ok(10.0));
}

/// Check 5.
#[test]
fn a_step_lasts_to_position_one() {
    let step = CurveKey::with_continuity(0.0, 1.0, 0.0, 0.0, CurveContinuity::Step).unwrap();
    let mut curve = curve(&[(2.0, 5.0)]);
    curve.keys_mut().add(step);
    assert_eq!([0.5, 1.0, 1.5].map(|x| curve.evaluate(x).unwrap()), [1.0, 5.0, 5.0]);
}

/// Check 5.
#[test]
fn a_single_key_has_no_value_of_its_own() {
    let single = curve(&[(1.0, 7.0)]);
    assert_eq!([0.0, 1.0, 2.0].map(|x| single.evaluate(x).unwrap()), [7.0, 0.0, 7.0]);
    let cycling = looped(single, CurveLoopType::Cycle);
    assert_eq!([0.0, 1.0, 2.0].map(|x| cycling.evaluate(x).unwrap()), [0.0, 0.0, 0.0]);
}

/// The integer conversion of a zero span is that of the original's processor: -2147483648.
#[test]
fn keys_at_one_position_shift_by_the_smallest_integer() {
    let narrow = looped(curve(&[(1.0, 0.0), (1.0, 1.0)]), CurveLoopType::CycleOffset);
    assert_eq!(narrow.evaluate(2.0), Ok(-2_147_483_648.0));
    assert!(narrow.evaluate(1.0).unwrap().is_nan());
}

fn keys_of(collection: &CurveKeyCollection) -> Vec<(f32, f32)> {
    collection.iter().map(|key| (key.position(), key.value())).collect()
}

/// Check 6.
#[test]
fn keys_are_sorted_when_added_and_appended_when_replaced() {
    let mut curve = curve(&[(0.0, 1.0), (1.0, 2.0), (1.0, 3.0), (0.5, 4.0)]);
    let keys = curve.keys_mut();
    assert_eq!(keys_of(keys), [(0.0, 1.0), (0.5, 4.0), (1.0, 2.0), (1.0, 3.0)]);
    keys.set(0, key(0.7, 5.0)).unwrap();
    assert_eq!(keys_of(keys), [(0.5, 4.0), (1.0, 2.0), (1.0, 3.0), (0.7, 5.0)]);
    keys.set(1, key(1.0, 6.0)).unwrap();
    assert_eq!(keys_of(keys), [(0.5, 4.0), (1.0, 6.0), (1.0, 3.0), (0.7, 5.0)]);
    assert_eq!(keys_of(&keys.clone()), [(0.5, 4.0), (0.7, 5.0), (1.0, 6.0), (1.0, 3.0)]);
}

#[test]
fn keys_are_found_and_removed_by_equality() {
    let mut curve = curve(&[(0.0, 1.0), (1.0, 2.0), (1.0, 2.0)]);
    let keys = curve.keys_mut();
    assert_eq!(keys.index_of(&key(1.0, 2.0)), Some(1));
    assert!(keys.contains(&key(0.0, 1.0)) && !keys.contains(&key(0.0, 2.0)));
    assert!(keys.remove(&key(1.0, 2.0)) && !keys.remove(&key(1.0, 3.0)));
    assert_eq!(keys_of(keys), [(0.0, 1.0), (1.0, 2.0)]);
    keys.remove_at(0).unwrap();
    assert_eq!(keys_of(keys), [(1.0, 2.0)]);
    keys.clear();
    assert!(keys.is_empty());
}

#[test]
fn keys_are_ordered_by_position_alone() {
    assert_eq!(key(1.0, 9.0).compare_to(&key(2.0, 0.0)), std::cmp::Ordering::Less);
    assert_eq!(key(1.0, 9.0).compare_to(&key(1.0, 0.0)), std::cmp::Ordering::Equal);
}

#[test]
fn exceptions_of_the_original_are_errors() {
    let is_invalid = |error: Error, name: &str| matches!(error, Error::InvalidArgument { argument, .. } if argument == name);
    let mut curve = curve(&[(0.0, 1.0)]);
    assert!(is_invalid(curve.compute_tangent(1, CurveTangent::Flat).unwrap_err(), "index"));
    assert!(is_invalid(curve.keys_mut().set(1, key(0.0, 0.0)).unwrap_err(), "index"));
    assert!(is_invalid(curve.keys_mut().remove_at(1).unwrap_err(), "index"));
    assert!(is_invalid(Curve::new().evaluate(0.0).unwrap_err(), "keys"));
    assert_eq!(keys_of(curve.keys()), [(0.0, 1.0)]);
}

#[test]
fn non_finite_curve_values_are_refused() {
    for x in [f32::NAN, f32::INFINITY] {
        assert!(CurveKey::new(x, 0.0).is_err() && CurveKey::new(0.0, x).is_err());
        assert!(curve(&[(0.0, 1.0)]).evaluate(x).is_err());
        let mut key = key(1.0, 2.0);
        assert!(
            key.set_value(x).is_err() && key.set_tangent_in(x).is_err() && key.set_tangent_out(x).is_err()
        );
        assert_eq!(key, CurveKey::new(1.0, 2.0).unwrap());
    }
}

proptest! {
    /// The blending functions are exactly 0 and 1 at both ends.
    #[test]
    fn a_curve_has_the_values_of_its_keys(values in prop::collection::vec(-100.0_f32..100.0, 2..9)) {
        let keys: Vec<(f32, f32)> = values.iter().enumerate().map(|(i, &value)| (i as f32, value)).collect();
        let mut curve = curve(&keys);
        curve.compute_tangents(CurveTangent::Smooth);
        for &(position, value) in &keys {
            prop_assert_eq!(curve.evaluate(position).unwrap(), value);
        }
    }

    /// Three roundings of the position, each at most half an ulp of 128, on a curve that is at most this steep.
    #[test]
    fn a_cycle_comes_back_after_its_span(x in 0.0_f32..4.0, turns in 1..20_i32) {
        let cycling = looped(curve(&[(0.0, 0.0), (1.0, 3.0), (4.0, 0.0)]), CurveLoopType::Cycle);
        let later = cycling.evaluate(x + turns as f32 * 4.0).unwrap();
        let steepest = 4.5;
        approx::assert_abs_diff_eq!(later, cycling.evaluate(x).unwrap(), epsilon = steepest * 3.0 * 64.0 * f32::EPSILON);
    }
}
