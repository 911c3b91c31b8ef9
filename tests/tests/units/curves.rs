//! Curves (behaviour chapter 14, section 4) against the record.

use conformance::units::{assert_words, check, floats};
use farseer_core::{Curve, CurveContinuity, CurveKey, CurveLoopType, CurveTangent};
use serde_json::Value;

fn text(value: &Value) -> &str {
    value.as_str().unwrap_or_else(|| panic!("{value} is no text"))
}

fn float(value: &Value) -> f32 {
    floats(text(value))[0]
}

fn key(record: &Value) -> CurveKey {
    let [position, value, tangent_in, tangent_out] =
        ["position", "value", "tangent_in", "tangent_out"].map(|name| float(&record[name]));
    let continuity = match text(&record["continuity"]) {
        "Smooth" => CurveContinuity::Smooth,
        "Step" => CurveContinuity::Step,
        other => panic!("unknown continuity {other}"),
    };
    CurveKey::with_continuity(position, value, tangent_in, tangent_out, continuity).unwrap()
}

fn loop_type(name: &str) -> CurveLoopType {
    match name {
        "Constant" => CurveLoopType::Constant,
        "Cycle" => CurveLoopType::Cycle,
        "CycleOffset" => CurveLoopType::CycleOffset,
        "Oscillate" => CurveLoopType::Oscillate,
        "Linear" => CurveLoopType::Linear,
        other => panic!("unknown loop type {other}"),
    }
}

fn tangent(name: &Value) -> CurveTangent {
    match text(name) {
        "Flat" => CurveTangent::Flat,
        "Linear" => CurveTangent::Linear,
        "Smooth" => CurveTangent::Smooth,
        other => panic!("unknown tangent {other}"),
    }
}

#[test]
fn curves_run_as_recorded() {
    check("curve", "Curve", |case| {
        let mut curve = Curve::new();
        for record in case.input.value("keys_in_insertion_order").as_array().unwrap() {
            curve.keys_mut().add(key(record));
        }
        curve.set_pre_loop(loop_type(case.input.text("pre_loop")));
        curve.set_post_loop(loop_type(case.input.text("post_loop")));
        if let Some(tangents) = case.input.value("compute_tangents").as_array() {
            curve.compute_tangents_in_out(tangent(&tangents[0]), tangent(&tangents[1]));
        }

        case.expect_bool("is_constant", curve.is_constant());
        let sorted = case.output.value("sorted_keys").as_array().unwrap();
        assert_eq!(sorted.len(), curve.keys().len());
        for (key, record) in curve.keys().iter().zip(sorted) {
            assert_words(&key.position(), text(&record["position"]));
            assert_words(&key.value(), text(&record["value"]));
            assert_words(&key.tangent_in(), text(&record["tangent_in"]));
            assert_words(&key.tangent_out(), text(&record["tangent_out"]));
        }
        for evaluation in case.output.value("evaluate").as_array().unwrap() {
            let value = curve.evaluate(float(&evaluation[0])).unwrap();
            assert_words(&value, text(&evaluation[1]["value"]));
        }
    });
}
