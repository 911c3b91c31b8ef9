//! The recorded runs of the original, reproduced.

use crate::scenes::{self, golden_scene, golden_trace};
use conformance::check::{Reproduction, check, check_folders};
use conformance::compare::{Finding, Place, compare};
use conformance::golden;
use conformance::run::record;
use conformance::scene::{Feature, Features};
use conformance::trace::{Line, Trace};

#[test]
fn every_recorded_run_is_reproduced_exactly() {
    let mut report = Vec::new();
    let summary = check_folders(&[golden::folder()], Features::default(), 2, &mut report)
        .expect("a list takes any report");
    let report = String::from_utf8_lossy(&report);
    let wrong: Vec<&str> = report.lines().filter(|line| !line.contains(" exact")).collect();
    assert!(summary.is_success(), "{}\n{summary}", wrong.join("\n"));
    assert_eq!((summary.exact(), summary.skipped()), (185, 0));
}

/// The short scene most tests change: two bodies, contacts and events.
const SCENE: &str = "box_drop_tilted";

/// Its trace with one line changed.
fn with_changed_line(change: impl Fn(&mut Line) -> bool) -> (Trace, Trace) {
    let trace: Trace = golden_trace(SCENE).parse().expect("the trace is whole");
    let mut changed = trace.clone();
    let count = changed.lines.iter_mut().filter_map(|line| change(line).then_some(())).count();
    assert_eq!(count, 1);
    (trace, changed)
}

#[test]
fn equal_traces_do_not_differ() {
    let trace: Trace = golden_trace(SCENE).parse().expect("the trace is whole");
    assert_eq!(compare(&trace, &trace, None), None);
}

#[test]
fn a_changed_word_is_found_with_its_body_field_and_distance() {
    let mut step = 0;
    let trace: Trace = golden_trace(SCENE).parse().expect("the trace is whole");
    let mut changed = trace.clone();
    let mut original = 0;
    for line in &mut changed.lines {
        match line {
            Line::Step(line) => step = line.step,
            Line::Body(line) if step == 100 && line.body == 1 => {
                original = line.state[5];
                line.state[5] += 3;
            }
            _ => {}
        }
    }
    let difference = compare(&trace, &changed, None).expect("a word differs");
    let word = Finding::Word {
        step: 100,
        place: Place::Body(1),
        field: "velocity y",
        expected: original,
        actual: original + 3,
    };
    assert_eq!((difference.step, difference.findings.as_slice()), (100, [word].as_slice()));
    let text = difference.to_string();
    let expected = format!("body 1, velocity y: expected {:?} ({original:08x})", f32::from_bits(original));
    assert!(text.contains(&expected) && text.ends_with("3 ulps apart"), "{text}");
}

#[test]
fn a_changed_hash_is_found_with_the_state_that_follows() {
    // The state of body 1 at step 100 belongs to a difference that shows in the hash of step 97 first.
    let trace: Trace = golden_trace(SCENE).parse().expect("the trace is whole");
    let mut changed = trace.clone();
    let mut step = 0;
    for line in &mut changed.lines {
        match line {
            Line::Step(line) => {
                step = line.step;
                line.hash ^= u64::from(step >= 97);
            }
            Line::Body(line) if step >= 97 && line.body == 1 => line.state[0] ^= 1,
            _ => {}
        }
    }
    let difference = compare(&trace, &changed, None).expect("hashes differ");
    assert_eq!(difference.step, 97);
    assert!(matches!(difference.findings[0], Finding::Step { step: 97, .. }));
    let last = difference.findings.last();
    assert!(
        matches!(last, Some(Finding::Word { step: 100, place: Place::Body(1), field: "position x", .. })),
        "{last:?}"
    );
}

#[test]
fn a_changed_number_of_contacts_is_found() {
    let (trace, changed) = with_changed_line(|line| match line {
        Line::Step(line) if line.step == 200 => {
            line.contacts += 1;
            true
        }
        _ => false,
    });
    let difference = compare(&trace, &changed, None).expect("a count differs");
    assert_eq!(difference.step, 200);
    assert!(difference.to_string().contains("contacts expected"), "{difference}");
}

#[test]
fn a_missing_event_is_found() {
    let scene = "filter_groups";
    let trace: Trace = golden_trace(scene).parse().expect("the trace is whole");
    let mut changed = trace.clone();
    let position = changed.lines.iter().position(|line| matches!(line, Line::Event { .. }));
    let removed = changed.lines.remove(position.expect("the scene has events"));
    let Line::Event { step, event } = removed else { panic!("{removed:?} is no event") };
    let difference = compare(&trace, &changed, None).expect("an event is missing");
    assert_eq!(difference.step, step);
    assert!(
        matches!(&difference.findings[0], Finding::Event { index: 0, expected, .. } if *expected == Some(event))
    );
}

#[test]
fn a_changed_contact_is_found_with_its_pair() {
    let scene = "gap_pool_order";
    let trace: Trace = golden_trace(scene).parse().expect("the trace is whole");
    let mut changed = trace.clone();
    let contact = changed.lines.iter_mut().find_map(|line| match line {
        Line::Contact(contact) => Some(contact),
        _ => None,
    });
    contact.expect("the trace has contacts").values[4] += 1;
    let difference = compare(&trace, &changed, None).expect("a contact differs");
    assert!(matches!(
        difference.findings[0],
        Finding::Word { place: Place::Contact { .. }, field: "separation", .. }
    ));
}

#[test]
fn a_changed_end_is_found() {
    let (trace, changed) = with_changed_line(|line| match line {
        Line::End { hash, .. } => {
            *hash ^= 1;
            true
        }
        _ => false,
    });
    let difference = compare(&trace, &changed, None).expect("the end differs");
    assert!(matches!(difference.findings[0], Finding::End { .. }));
}

#[test]
fn lines_after_the_compared_steps_are_ignored() {
    let (trace, changed) = with_changed_line(|line| match line {
        Line::Step(line) if line.step == 200 => {
            line.hash ^= 1;
            true
        }
        _ => false,
    });
    assert_eq!(compare(&trace, &changed, Some(200)), None);
    assert!(compare(&trace, &changed, Some(201)).is_some());
}

#[test]
fn a_scene_that_runs_differently_is_reported_as_different() {
    let mut scene = golden_scene(SCENE);
    scene.geoms[1].settings.friction = Some(0.25);
    let verdict = check(&scene, &golden_trace(SCENE), Features::default());
    assert!(matches!(verdict, Reproduction::Differs(_)), "{verdict}");
}

#[test]
fn the_text_of_a_run_is_that_of_its_trace() {
    let recording = record(&golden_scene(SCENE));
    assert!(recording.trace.to_string() == golden_trace(SCENE));
}

#[test]
fn a_scene_that_needs_a_skipped_feature_is_skipped() {
    let joints = Features::of(&[Feature::Joints]);
    let verdict = check(&golden_scene("joint_pin"), &golden_trace("joint_pin"), joints);
    assert!(matches!(verdict, Reproduction::Skipped(features) if features == joints), "{verdict}");
}

#[test]
fn a_broken_trace_fails() {
    let verdict = check(&golden_scene(SCENE), "farseer-trace 2\n", Features::default());
    assert!(verdict.to_string().starts_with("failed: the trace line 1: "), "{verdict}");
}

#[test]
fn a_refusal_of_the_original_must_be_one_here() {
    let mut scene = golden_scene("edge_zero_mass");
    let trace = golden_trace("edge_zero_mass");
    assert!(check(&scene, &trace, Features::default()).is_exact());
    scene.bodies.clear();
    let verdict = check(&scene, &trace, Features::default());
    assert!(verdict.to_string().ends_with("nothing was refused"), "{verdict}");
}

#[test]
fn a_refusal_in_the_script_must_come_at_the_same_step() {
    let mut scene = golden_scene("edge_grid_overflow");
    let trace = golden_trace("edge_grid_overflow").replace("IndexOutOfRange", "ArgumentOutOfRange");
    scene.outcome.throws = Some("System.ArgumentOutOfRangeException".to_owned());
    scene.script = scenes::script(r#"[{"step": 38, "op": "set_mass", "body": 1, "mass": 0}]"#);
    assert!(check(&scene, &trace, Features::default()).is_exact());
    scene.script = scenes::script(r#"[{"step": 38, "op": "set_mass", "body": 1, "mass": 2}]"#);
    let verdict = check(&scene, &trace, Features::default());
    assert!(verdict.to_string().ends_with("nothing was refused"), "{verdict}");
}

#[test]
fn a_refusal_where_the_original_went_on_fails() {
    let mut scene = golden_scene(SCENE);
    scene.script = scenes::script(r#"[{"step": 7, "op": "set_mass", "body": 1, "mass": 0}]"#);
    let verdict = check(&scene, &golden_trace(SCENE), Features::default());
    assert!(verdict.to_string().starts_with("failed: step 7: "), "{verdict}");
    assert!(verdict.to_string().contains("script[0].mass: mass is 0"), "{verdict}");
}

#[test]
fn a_body_that_stops_being_finite_must_be_reported_in_time() {
    let mut scene = golden_scene("edge_huge_rotation_inf");
    let trace = golden_trace("edge_huge_rotation_inf");
    assert!(check(&scene, &trace, Features::default()).is_exact());
    scene.bodies[1].settings.angular_velocity = Some(1e3);
    scene.outcome.first_nan_step = Some(0);
    let verdict = check(&scene, &trace, Features::default());
    assert!(verdict.is_failure(), "{verdict}");
}

#[test]
fn a_refused_infinity_counts_as_stopped_in_time() {
    let mut scene = golden_scene("edge_huge_rotation_inf");
    let trace = golden_trace("edge_huge_rotation_inf");
    scene.script = scenes::script(r#"[{"step": 1, "op": "apply_torque", "body": 1, "torque": 1e39}]"#);
    assert!(check(&scene, &trace, Features::default()).is_exact());
    scene.script = scenes::script(r#"[{"step": 1, "op": "set_mass", "body": 1, "mass": 0}]"#);
    let verdict = check(&scene, &trace, Features::default());
    assert!(verdict.to_string().contains("refused at step 1: "), "{verdict}");
}

#[test]
fn the_run_after_an_exception_of_an_update_is_checked_to_the_end() {
    let recording = record(&golden_scene("edge_grid_overflow"));
    assert_eq!(recording.trace.end().map(|(steps, _)| steps), Some(300));
    assert_eq!(recording.not_finite, None);
}
