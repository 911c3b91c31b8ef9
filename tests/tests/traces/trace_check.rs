//! The program `trace_check`: its report and its status.

use crate::scenes::{golden_scene, golden_trace};
use conformance::golden;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Command, Output};

/// An empty folder for the files of a test.
fn folder(test: &str) -> PathBuf {
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join(test);
    let _ = fs::remove_dir_all(&folder);
    fs::create_dir_all(&folder).unwrap_or_else(|error| panic!("{}: {error}", folder.display()));
    folder
}

/// Puts a scene of the repository into a folder, compressed as it is.
fn copy(name: &str, folder: &Path) {
    for ending in ["json.gz", "trace.gz"] {
        let file = format!("{name}.{ending}");
        fs::copy(golden::folder().join(&file), folder.join(&file))
            .unwrap_or_else(|error| panic!("{file}: {error}"));
    }
}

fn write(folder: &Path, file: &str, text: &str) {
    fs::write(folder.join(file), text).unwrap_or_else(|error| panic!("{file}: {error}"));
}

fn trace_check(arguments: &[&Path]) -> Output {
    let program = env!("CARGO_BIN_EXE_trace_check");
    Command::new(program).args(arguments).output().unwrap_or_else(|error| panic!("{program}: {error}"))
}

fn report(output: &Output) -> String {
    String::from_utf8_lossy(&output.stdout).into_owned()
}

/// The line of the report that starts with a name.
fn line(output: &Output, name: &str) -> String {
    let report = report(output);
    let line = report.lines().find(|line| line.split_whitespace().next() == Some(name));
    line.unwrap_or_else(|| panic!("no line for {name} in\n{report}"))
        .split_whitespace()
        .collect::<Vec<_>>()
        .join(" ")
}

#[test]
fn exact_scenes_end_with_status_0_and_are_counted_by_tag() {
    let folder = folder("exact");
    copy("box_drop_flat", &folder);
    copy("free_fall_pixels", &folder);
    let output = trace_check(&[&folder]);
    assert!(output.status.success(), "{}", report(&output));
    assert_eq!(line(&output, "box_drop_flat"), "box_drop_flat exact");
    assert_eq!(line(&output, "box_drop"), "box_drop 1 scenes: 1 exact, 0 skipped, 0 failed");
    assert_eq!(line(&output, "all"), "all 2 scenes: 2 exact, 0 skipped, 0 failed");
}

#[test]
fn plain_files_are_read_as_well() {
    let folder = folder("plain");
    let name = "gap_same_name";
    let scene = fs::File::open(golden::folder().join("edge_no_boxes.json.gz")).expect("it is there");
    let mut text = String::new();
    std::io::Read::read_to_string(&mut flate2::read::GzDecoder::new(scene), &mut text).expect("it is text");
    write(&folder, &format!("{name}.json"), &text);
    write(&folder, &format!("{name}.trace"), &golden_trace("edge_no_boxes"));
    let output = trace_check(&[&folder]);
    assert!(output.status.success(), "{}", report(&output));
    assert_eq!(line(&output, name), format!("{name} exact"));
}

#[test]
fn skipped_scenes_end_with_status_0() {
    let folder = folder("skipped");
    copy("enable_disable", &folder);
    let output = trace_check(&[Path::new("--skip"), Path::new("joints,springs"), &folder]);
    assert!(output.status.success(), "{}", report(&output));
    assert_eq!(line(&output, "enable_disable"), "enable_disable skipped (joints, springs)");
}

#[test]
fn a_difference_ends_with_status_1() {
    let folder = folder("different");
    copy("box_drop_flat", &folder);
    let trace = golden_trace("box_drop_flat");
    let step = trace.lines().find(|line| line.starts_with("s 90 ")).expect("the trace has a step 90");
    let changed =
        trace.replace(step, &format!("s 90 0123456789abcdef{}", &step["s 90 0123456789abcdef".len()..]));
    write(&folder, "box_drop_flat.trace", &changed);
    let output = trace_check(&[&folder]);
    assert_eq!(output.status.code(), Some(1));
    assert_eq!(line(&output, "box_drop_flat"), "box_drop_flat differs at step 90");
    assert!(report(&output).contains("step 90: hash 0123456789abcdef expected, "), "{}", report(&output));
}

#[test]
fn broken_files_are_reported_and_do_not_stop_the_others() {
    let folder = folder("broken");
    copy("free_fall_pixels", &folder);
    write(&folder, "a.json", "{");
    write(&folder, "a.trace", "");
    write(&folder, "b.json.gz", "this is not compressed");
    write(&folder, "b.trace", "");
    let output = trace_check(&[&folder]);
    assert_eq!(output.status.code(), Some(1));
    assert!(line(&output, "a").contains("a.json: is not JSON: "), "{}", report(&output));
    assert!(line(&output, "b").contains("b.json.gz: cannot be read: "), "{}", report(&output));
    assert_eq!(line(&output, "free_fall_pixels"), "free_fall_pixels exact");
    assert_eq!(line(&output, "all"), "all 3 scenes: 1 exact, 0 skipped, 2 failed");
}

#[test]
fn a_scene_without_a_trace_and_a_trace_without_a_scene_fail() {
    let folder = folder("halves");
    copy("free_fall_pixels", &folder);
    copy("projectile", &folder);
    fs::remove_file(folder.join("free_fall_pixels.trace.gz")).expect("it is there");
    fs::remove_file(folder.join("projectile.json.gz")).expect("it is there");
    let output = trace_check(&[&folder]);
    assert_eq!(output.status.code(), Some(1));
    assert_eq!(line(&output, "free_fall_pixels"), "free_fall_pixels failed: has a scene, but no trace");
    assert_eq!(line(&output, "projectile"), "projectile failed: has a trace, but no scene");
}

#[test]
fn a_folder_without_scenes_fails() {
    let output = trace_check(&[&folder("empty")]);
    assert_eq!(output.status.code(), Some(1));
    assert!(report(&output).contains("empty: has no scenes"), "{}", report(&output));
}

#[test]
fn a_missing_folder_is_reported_and_does_not_stop_the_others() {
    let folder = folder("there");
    copy("free_fall_pixels", &folder);
    let output = trace_check(&[Path::new("no/such/folder"), &folder]);
    assert_eq!(output.status.code(), Some(1));
    assert!(report(&output).contains("no/such/folder: "), "{}", report(&output));
    assert_eq!(line(&output, "free_fall_pixels"), "free_fall_pixels exact");
}

#[test]
fn an_unknown_feature_is_refused() {
    let output = trace_check(&[Path::new("--skip"), Path::new("ropes")]);
    assert_eq!(output.status.code(), Some(2));
    let message = String::from_utf8_lossy(&output.stderr).into_owned();
    assert!(message.contains("`ropes` is none of joints, springs, controllers, paths"), "{message}");
}

#[test]
fn a_scene_that_throws_is_exact_until_then() {
    let folder = folder("throws");
    copy("edge_grid_overflow", &folder);
    let output = trace_check(&[&folder]);
    assert!(output.status.success(), "{}", report(&output));
    assert_eq!(golden_scene("edge_grid_overflow").outcome.throw_step, Some(38));
    assert_eq!(
        line(&output, "edge_grid_overflow"),
        "edge_grid_overflow exact until step 37, as documented after it (System.IndexOutOfRangeException at step 38)"
    );
}
