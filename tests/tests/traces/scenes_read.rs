//! Reading of scenes: values, and errors that name the file, the position and the reason.

use conformance::scene::{BodyShape, Feature, Features, Op, OutlineForm, Scene};
use farseer_core::math::Vector2;

/// A scene with some keys beside the ones that must be there.
fn scene(keys: &str) -> String {
    format!(
        r#"{{"format": 1, "name": "small", "about": "Small.", "tags": [], "simulator": {{}}, "dt": 0.01,
           "steps": 1, "trace": {{"full_every": 1, "events": false, "contacts": false}}{keys}}}"#
    )
}

fn read(keys: &str) -> Scene {
    Scene::from_json("small.json", &scene(keys)).unwrap_or_else(|error| panic!("{error}"))
}

fn error(keys: &str) -> String {
    error_of(&scene(keys))
}

fn error_of(text: &str) -> String {
    Scene::from_json("small.json", text).expect_err("the scene is broken").to_string()
}

/// A body with a radius as written.
fn circle(radius: &str) -> String {
    format!(r#", "bodies": [{{"shape": {{"type": "circle", "radius": {radius}, "mass": 1}}}}]"#)
}

/// The radius that is read where `radius` is written.
fn radius(radius: &str) -> f32 {
    match read(&circle(radius)).bodies[0].shape {
        BodyShape::Circle { radius, .. } => radius,
        ref other => panic!("{other:?} is not a circle"),
    }
}

#[test]
fn a_number_is_rounded_by_way_of_the_nearest_double() {
    // Just above half way between 1 and the next float, but half way as a double, which rounds to even.
    assert_eq!(radius("1.0000000596046447753906250000001").to_bits(), 1.0_f32.to_bits());
    assert_eq!(
        "1.0000000596046447753906250000001".parse::<f32>().map(f32::to_bits),
        Ok(1.0_f32.next_up().to_bits())
    );
}

#[test]
fn the_double_is_the_nearest_one() {
    // A decimal whose shortcut conversion is off by one double, which decides about the float.
    assert_eq!(radius("8388609.499999999068677425384521").to_bits(), 8_388_609.0_f32.to_bits());
    assert_eq!(radius("8388609.50000000186264514923096").to_bits(), 8_388_610.0_f32.to_bits());
}

#[test]
fn a_negative_zero_is_kept() {
    assert_eq!(radius("-0.0").to_bits(), (-0.0_f32).to_bits());
}

#[test]
fn an_integer_is_a_number() {
    assert_eq!(radius("16777217"), 16_777_216.0);
}

#[test]
fn a_number_beyond_the_range_becomes_infinite() {
    assert_eq!(radius("3.5e38"), f32::INFINITY);
    assert_eq!(radius("-1e39"), f32::NEG_INFINITY);
}

#[test]
fn a_tiny_number_becomes_denormal_or_zero() {
    assert_eq!(radius("1e-45").to_bits(), 1);
    assert_eq!(radius("1e-46").to_bits(), 0);
}

#[test]
fn a_value_of_the_wrong_kind_is_refused_with_its_place() {
    assert_eq!(error(&circle("\"wide\"")), "small.json: bodies[0].shape.radius: \"wide\" is not a number");
}

#[test]
fn a_missing_key_is_refused_with_its_place() {
    let keys = r#", "bodies": [{"shape": {"type": "circle", "radius": 1}}]"#;
    assert_eq!(error(keys), "small.json: bodies[0].shape.mass: is missing");
}

#[test]
fn an_unknown_key_of_a_tagged_object_is_refused_with_its_place() {
    let keys = r#", "bodies": [{"shape": {"type": "circle", "radius": 1, "mass": 1, "height": 2}}]"#;
    assert_eq!(error(keys), "small.json: bodies[0].shape.height: is not a key known here");
}

#[test]
fn an_unknown_key_of_a_script_entry_is_refused_with_its_place() {
    let keys = r#", "script": [{"step": 1, "op": "reset_dynamics", "body": 0, "force": [1, 2]}]"#;
    assert_eq!(error(keys), "small.json: script[0].force: is not a key known here");
}

#[test]
fn an_unknown_key_of_the_scene_is_refused() {
    assert_eq!(error(r#", "ropes": []"#), "small.json: ropes: is not a key known here");
}

#[test]
fn an_unknown_type_is_refused_with_the_known_ones() {
    let keys = r#", "bodies": [{"shape": {"type": "blob"}}]"#;
    assert_eq!(
        error(keys),
        "small.json: bodies[0].shape.type: \"blob\" is none of rectangle, circle, ellipse, polygon, explicit, clone"
    );
}

#[test]
fn an_unknown_operation_is_refused() {
    let message = error(r#", "script": [{"step": 1, "op": "jump"}]"#);
    assert!(message.starts_with("small.json: script[0].op: \"jump\" is none of apply_force, "), "{message}");
}

#[test]
fn an_unknown_word_is_refused_with_the_known_ones() {
    let text = scene("").replace(r#""simulator": {}"#, r#""simulator": {"friction_type": "maximum"}"#);
    assert_eq!(
        error_of(&text),
        "small.json: simulator.friction_type: \"maximum\" is none of average, minimum"
    );
}

#[test]
fn a_broken_number_in_an_outline_is_refused_with_its_complete_position() {
    let keys = r#", "geoms": [{"body": 0, "shape": {"type": "raw", "outline":
                    {"type": "points", "points": [[0, 0], [1, true]]}}}]"#;
    assert_eq!(error(keys), "small.json: geoms[0].shape.outline.points[1][1]: a truth value is not a number");
}

#[test]
fn a_vector_of_three_numbers_is_refused() {
    let keys =
        r#", "bodies": [{"shape": {"type": "circle", "radius": 1, "mass": 1}, "position": [1, 2, 3]}]"#;
    assert_eq!(error(keys), "small.json: bodies[0].position: a list is not a vector of two numbers");
}

#[test]
fn a_decimal_is_not_an_integer() {
    let text = scene("").replace(r#""steps": 1"#, r#""steps": 1.5"#);
    assert_eq!(error_of(&text), "small.json: steps: 1.5 is not a 32-bit integer of at least 0");
}

#[test]
fn a_negative_index_is_refused() {
    let keys = r#", "script": [{"step": 1, "op": "reset_dynamics", "body": -1}]"#;
    assert_eq!(error(keys), "small.json: script[0].body: -1 is not an integer of at least 0");
}

#[test]
fn step_zero_is_refused_in_a_script() {
    let keys = r#", "script": [{"step": 0, "op": "reset_dynamics", "body": 0}]"#;
    assert_eq!(error(keys), "small.json: script[0].step: 0 is not an integer of at least 1");
}

#[test]
fn another_format_is_refused() {
    let text = scene("").replace(r#""format": 1"#, r#""format": 2"#);
    assert_eq!(error_of(&text), "small.json: format: 2 is not 1, the only format known");
}

#[test]
fn a_fluid_without_a_container_is_refused() {
    let keys = r#", "controllers": [{"type": "fluid_drag", "density": 1, "linear_drag": 1, "rotational_drag": 1,
                    "gravity": [0, 1], "geoms": []}]"#;
    assert_eq!(error(keys), "small.json: controllers[0]: needs either `container` or `wave`");
}

#[test]
fn a_text_that_is_not_json_is_refused_with_line_and_column() {
    let message = error_of("{\n  \"format\": 1,\n  oops\n}");
    assert_eq!(message, "small.json: is not JSON: key must be a string at line 3 column 3");
}

#[test]
fn a_missing_file_is_named() {
    let message = Scene::from_file("no/such/scene.json").expect_err("it is not there").to_string();
    assert!(message.starts_with("no/such/scene.json: cannot be read: "), "{message}");
}

#[test]
fn an_operation_with_until_is_due_every_so_many_steps() {
    let keys = r#", "script": [{"step": 3, "until": 8, "every": 2, "op": "clear_force", "body": 0}]"#;
    let scene = read(keys);
    let due: Vec<u32> = (0..20).filter(|&step| scene.script[0].is_due(step)).collect();
    assert_eq!(due, [3, 5, 7]);
}

#[test]
fn an_operation_without_until_is_due_once() {
    let scene = read(r#", "script": [{"step": 3, "op": "clear_force", "body": 0}]"#);
    let due: Vec<u32> = (0..20).filter(|&step| scene.script[0].is_due(step)).collect();
    assert_eq!(due, [3]);
}

#[test]
fn keys_of_an_object_and_of_its_kind_may_come_in_any_order() {
    let keys = r#", "script": [{"body": 2, "force": [1, -2.5], "op": "apply_force", "step": 4}]"#;
    assert_eq!(read(keys).script[0].op, Op::ApplyForce { body: 2, force: Vector2::new(1.0, -2.5) });
}

#[test]
fn an_outline_may_be_subdivided() {
    let keys = r#", "script": [{"step": 1, "op": "set_vertices", "geom": 0,
                    "outline": {"type": "circle", "radius": 5, "edges": 8, "subdivide": 2.5}}]"#;
    match read(keys).script.remove(0).op {
        Op::SetVertices { outline, .. } => {
            assert_eq!(outline.form, OutlineForm::Circle { radius: 5.0, edges: 8 });
            assert_eq!(outline.subdivide, Some(2.5));
        }
        other => panic!("{other:?} does not set vertices"),
    }
}

#[test]
fn a_scene_needs_the_features_of_its_script() {
    let scene = read(
        r#", "script": [{"step": 1, "op": "remove", "target": "spring", "index": 0},
             {"step": 1, "op": "disturb_wave", "controller": 0, "x": 1, "offset": 2}]"#,
    );
    assert_eq!(scene.features(), Features::of(&[Feature::Springs, Feature::Controllers]));
}

#[test]
fn a_scene_of_bodies_and_geoms_needs_no_feature() {
    let scene = read(r#", "script": [{"step": 1, "op": "remove", "target": "body", "index": 0}]"#);
    assert!(scene.features().is_empty());
}
