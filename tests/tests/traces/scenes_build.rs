//! Building and driving of scenes: errors that name the file, the position and the reason.

use crate::scenes::small_scene;
use conformance::run::{Run, record};
use conformance::scene::Scene;
use conformance::scenes::{circles_in_a_pit, pyramid};
use farseer_core::math::Vector2;

const BODY: &str = r#"{"shape": {"type": "rectangle", "width": 2, "height": 2, "mass": 1}}"#;

fn scene(keys: &str) -> Scene {
    Scene::from_json("small.json", &small_scene(keys)).unwrap_or_else(|error| panic!("{error}"))
}

fn error(keys: &str) -> String {
    Run::build(&scene(keys)).expect_err("the scene cannot be built").to_string()
}

fn script_error(op: &str) -> String {
    let scene = scene(&format!(r#", "bodies": [{BODY}], "script": [{{"step": 1, {op}}}]"#));
    let mut run = Run::build(&scene).unwrap_or_else(|error| panic!("{error}"));
    run.step().expect_err("the operation cannot be applied").to_string()
}

#[test]
fn a_refusal_of_the_engine_is_reported_with_its_position() {
    let message = error(r#", "bodies": [{"shape": {"type": "circle", "radius": -3, "mass": 1}}]"#);
    assert!(message.starts_with("small.json: bodies[0].shape: radius is -3.0, but must be "), "{message}");
}

#[test]
fn a_refusal_of_the_engine_differs_from_a_broken_scene() {
    let scene = scene(r#", "bodies": [{"shape": {"type": "circle", "radius": -3, "mass": 1}}]"#);
    assert!(Run::build(&scene).expect_err("the scene cannot be built").is_refusal());
}

#[test]
fn a_body_that_does_not_exist_is_reported_with_its_place() {
    let keys = format!(
        r#", "bodies": [{BODY}], "geoms": [{{"body": 1, "shape": {{"type": "rectangle", "width": 2, "height": 2}}}}]"#
    );
    assert_eq!(error(&keys), "small.json: geoms[0].body: there is no body 1, only 1 of them");
}

#[test]
fn a_geom_that_does_not_exist_is_reported_with_its_place() {
    let keys = format!(
        r#", "bodies": [{BODY}], "geoms": [{{"body": 0, "shape": {{"type": "rectangle", "width": 2, "height": 2}},
           "ignore": [0, 7]}}]"#
    );
    assert_eq!(error(&keys), "small.json: geoms[0].ignore[1]: there is no geom 7, only 1 of them");
}

#[test]
fn a_body_copied_from_a_later_one_is_reported() {
    let keys = format!(r#", "bodies": [{{"shape": {{"type": "clone", "of": 1}}}}, {BODY}]"#);
    assert_eq!(error(&keys), "small.json: bodies[0].shape.of: there is no body 1, only 0 of them");
}

#[test]
fn an_infinite_number_is_refused_with_its_place() {
    let keys =
        r#", "bodies": [{"shape": {"type": "circle", "radius": 1, "mass": 1}, "position": [0, -1e39]}]"#;
    assert_eq!(error(keys), "small.json: bodies[0].position[1]: -inf is not finite");
}

#[test]
fn an_infinite_number_in_an_outline_is_refused_with_its_place() {
    let keys = r#", "bodies": [{"shape": {"type": "polygon", "mass": 1, "outline":
                    {"type": "points", "points": [[0, 0], [0, 1e39], [1, 1]]}}}]"#;
    assert_eq!(error(keys), "small.json: bodies[0].shape.outline.points[1][1]: inf is not finite");
}

#[test]
fn an_operation_on_a_body_that_does_not_exist_is_reported_with_its_place() {
    let message = script_error(r#""op": "apply_torque", "body": 4, "torque": 1"#);
    assert_eq!(message, "small.json: script[0].body: there is no body 4, only 1 of them");
}

#[test]
fn an_operation_the_engine_refuses_is_reported_with_its_place() {
    let message = script_error(r#""op": "set_mass", "body": 0, "mass": 0"#);
    assert!(message.starts_with("small.json: script[0].mass: "), "{message}");
}

#[test]
fn an_infinite_force_is_refused_with_its_place() {
    let message = script_error(r#""op": "apply_force", "body": 0, "force": [1e39, 0]"#);
    assert_eq!(message, "small.json: script[0].force[0]: inf is not finite");
}

#[test]
fn objects_created_by_a_script_are_reported_with_their_position() {
    let message = script_error(
        r#""op": "create", "target": "geom", "spec": {"body": 3, "shape": {"type": "rectangle", "width": 1, "height": 1}}"#,
    );
    assert_eq!(message, "small.json: script[0].spec.body: there is no body 3, only 1 of them");
}

#[test]
fn an_object_created_by_a_script_can_be_used_by_it() {
    let scene = scene(&format!(
        r#", "script": [{{"step": 1, "op": "create", "target": "body", "spec": {BODY}}},
           {{"step": 1, "op": "set_position", "body": 0, "position": [3, 4]}}]"#
    ));
    let mut run = Run::build(&scene).unwrap_or_else(|error| panic!("{error}"));
    run.step().unwrap_or_else(|error| panic!("{error}"));
    assert_eq!(run.simulator()[run.bodies()[0]].position(), Vector2::new(3.0, 4.0));
}

#[test]
fn a_body_that_is_not_in_the_simulation_is_not_in_the_list() {
    let scene = scene(
        r#", "bodies": [{"shape": {"type": "circle", "radius": 1, "mass": 1}, "in_simulation": false},
           {"shape": {"type": "circle", "radius": 1, "mass": 1}}]"#,
    );
    let run = Run::build(&scene).unwrap_or_else(|error| panic!("{error}"));
    assert_eq!(run.simulator().body_list(), &run.bodies()[1..]);
}

#[test]
fn a_joint_of_a_missing_body_is_refused() {
    let scene = scene(r#", "joints": [{"type": "fixed_angle", "body": 0}]"#);
    let error = Run::build(&scene).expect_err("there is no body to join");
    assert_eq!(error.to_string(), "small.json: joints[0].body: there is no body 0, only 0 of them");
}

/// A scene of two boxes with a script.
fn two_boxes(script: &str) -> Scene {
    let geom =
        |body| format!(r#"{{"body": {body}, "shape": {{"type": "rectangle", "width": 2, "height": 2}}}}"#);
    scene(&format!(
        r#", "bodies": [{BODY}, {BODY}], "geoms": [{}, {}], "script": [{script}]"#,
        geom(0),
        geom(1)
    ))
}

#[test]
fn operations_on_disposed_objects_have_no_effect() {
    let scene = two_boxes(
        r#"{"step": 1, "op": "dispose", "target": "body", "index": 1},
           {"step": 3, "op": "apply_torque", "body": 1, "torque": 1},
           {"step": 3, "op": "set_geom", "geom": 1, "friction": 1},
           {"step": 3, "op": "ignore_collision", "geom": 0, "other": 1},
           {"step": 3, "op": "restore_collision", "geom": 0, "other": 1},
           {"step": 3, "op": "add", "target": "body", "index": 1},
           {"step": 3, "op": "remove", "target": "geom", "index": 1},
           {"step": 3, "op": "disable", "target": "body", "index": 1},
           {"step": 3, "op": "dispose", "target": "body", "index": 1}"#,
    );
    let mut run = Run::build(&scene).unwrap_or_else(|error| panic!("{error}"));
    for _ in 0..4 {
        run.step().unwrap_or_else(|error| panic!("{error}"));
    }
    assert_eq!(run.simulator().body_list(), &run.bodies()[..1]);
    assert_eq!(run.simulator().geom_list(), &run.geoms()[..1]);
}

#[test]
fn a_copy_of_a_disposed_body_is_refused() {
    let scene = two_boxes(
        r#"{"step": 1, "op": "dispose", "target": "body", "index": 1},
           {"step": 3, "op": "create", "target": "body", "spec": {"shape": {"type": "clone", "of": 1}}}"#,
    );
    let mut run = Run::build(&scene).unwrap_or_else(|error| panic!("{error}"));
    run.step().unwrap_or_else(|error| panic!("{error}"));
    run.step().unwrap_or_else(|error| panic!("{error}"));
    let message = run.step().expect_err("the body is gone").to_string();
    assert_eq!(message, "small.json: script[1].spec.shape.of: body 1 is disposed");
}

#[test]
fn a_pyramid_and_a_pit_of_circles_run_to_their_end() {
    for scene in [pyramid(4), circles_in_a_pit(30)] {
        let recording = record(&scene);
        assert!(recording.error.is_none() && recording.not_finite.is_none(), "{recording:?}");
        assert_eq!(recording.trace.end().map(|(steps, _)| steps), Some(scene.steps));
    }
}
