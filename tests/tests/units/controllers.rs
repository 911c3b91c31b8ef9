//! Scaling and wave controllers of behaviour chapter 12, sections 6 and 9, against the record.

use conformance::units::{assert_bits, check, floats};
use farseer_core::{Aabb, FluidContainer, ScalingController, WaveController};
use serde_json::Value;

fn vector(value: &Value) -> farseer_core::math::Vector2 {
    let words = floats(value.as_str().unwrap());
    farseer_core::math::Vector2::new(words[0], words[1])
}

#[test]
fn scaling_has_the_recorded_intervals() {
    check("controllers_joints", "ScalingController", |case| {
        let mut scaling =
            ScalingController::new(case.input.f32("preferred"), case.input.f32("maximum")).unwrap();
        let dt = case.input.f32("dt");
        for pair in case.output.value("dt_real_and_interval").as_array().unwrap() {
            let word = |i: usize| floats(pair[i].as_str().unwrap())[0];
            scaling.update(dt, word(0));
            assert_bits(&[scaling.update_interval()], &[word(1)], || format!("{:?}", case.input));
        }
        case.expect("get_0004", &scaling.get_update_interval(0.004));
        case.expect("get_003", &scaling.get_update_interval(0.03));
        case.expect("maximum", &scaling.maximum_update_interval());
    });
}

#[test]
fn waves_have_the_recorded_shapes() {
    check("controllers_joints", "WaveController", |case| {
        let input = &case.input;
        let nodes = usize::try_from(input.integer("node_count")).unwrap();
        let mut wave =
            WaveController::new(input.vector("position"), input.f32("width"), input.f32("height"), nodes)
                .unwrap();
        wave.set_damping_coefficient(input.f32("damping_coefficient")).unwrap();
        wave.set_frequency(input.f32("frequency")).unwrap();
        wave.set_wave_generator_max(input.f32("generator_max")).unwrap();
        wave.set_wave_generator_min(input.f32("generator_min")).unwrap();
        wave.set_wave_generator_step(input.f32("generator_step")).unwrap();
        assert_bits(wave.x_position(), &case.output.floats("x_position"), || format!("{input:?}"));

        let shapes = case.output.value("current_wave_every_10").as_array().unwrap();
        let queries = case.output.value("queries").as_array().unwrap();
        let (mut shapes_seen, mut queries_seen) = (0, 0);
        for update in 1..=60 {
            if update == 20 {
                let x = input.f32("disturb_before_update_20_at");
                wave.disturb(x, input.f32("disturb_offset")).unwrap();
            }
            wave.update(input.f32("dt")).unwrap();
            if update % 10 == 0 {
                let expected = floats(shapes[shapes_seen].as_str().unwrap());
                assert_bits(wave.current_wave(), &expected, || format!("{input:?} update {update}"));
                shapes_seen += 1;
            }
            for query in queries.iter().filter(|query| query["update"] == update) {
                let point = vector(&query["point"]);
                assert_eq!(wave.contains(point), query["contains"].as_bool().unwrap(), "{input:?} {query}");
                let aabb = Aabb::new(vector(&query["box_min"]), vector(&query["box_max"]));
                assert_eq!(
                    wave.intersect(&aabb),
                    query["intersects"].as_bool().unwrap(),
                    "{input:?} {query}"
                );
                queries_seen += 1;
            }
        }
        assert_eq!((shapes_seen, queries_seen), (shapes.len(), queries.len()));
    });
}
