//! Fixtures of several tests: scenes and traces of the repository.

use conformance::golden;
use conformance::scene::{Scene, ScriptEntry};
use flate2::read::GzDecoder;
use std::fs::File;
use std::io::Read;

/// A scene of the repository.
pub(crate) fn golden_scene(name: &str) -> Scene {
    let path = golden::folder().join(format!("{name}.json.gz"));
    Scene::from_file(path).unwrap_or_else(|error| panic!("{error}"))
}

/// The text of a trace of the repository.
pub(crate) fn golden_trace(name: &str) -> String {
    let path = golden::folder().join(format!("{name}.trace.gz"));
    let mut text = String::new();
    let file = File::open(&path).unwrap_or_else(|error| panic!("{}: {error}", path.display()));
    GzDecoder::new(file)
        .read_to_string(&mut text)
        .unwrap_or_else(|error| panic!("{}: {error}", path.display()));
    text
}

/// A scene with some keys beside the ones that must be there.
pub(crate) fn small_scene(keys: &str) -> String {
    format!(
        r#"{{"format": 1, "name": "small", "about": "Small.", "tags": [], "simulator": {{}}, "dt": 0.01,
           "steps": 1, "trace": {{"full_every": 1, "events": false, "contacts": false}}{keys}}}"#
    )
}

/// A script.
pub(crate) fn script(list: &str) -> Vec<ScriptEntry> {
    let text = small_scene(&format!(r#", "script": {list}"#));
    Scene::from_json("script", &text).unwrap_or_else(|error| panic!("{error}")).script
}
