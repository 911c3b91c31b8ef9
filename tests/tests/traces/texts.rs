//! The recorded traces as texts, without running anything.

use conformance::golden;
use conformance::scene::Scene;
use conformance::trace::hash::{Fnv, step_line};
use conformance::trace::{Line, StepLine, Trace};
use flate2::read::GzDecoder;
use serde::Deserialize;
use std::fs::{self, File};
use std::io::Read;
use std::path::PathBuf;

/// The files of the golden folder with an ending.
fn files(ending: &str) -> Vec<PathBuf> {
    let files = fs::read_dir(golden::folder()).expect("the golden folder is there");
    let mut files: Vec<PathBuf> = files.map(|file| file.expect("it can be listed").path()).collect();
    files.retain(|path| path.to_string_lossy().ends_with(ending));
    files.sort();
    assert!(files.len() > 180, "{} files", files.len());
    files
}

fn text(path: &PathBuf) -> String {
    let mut text = String::new();
    let file = File::open(path).expect("the file is there");
    GzDecoder::new(file).read_to_string(&mut text).expect("the file is compressed text");
    text
}

fn traces() -> impl Iterator<Item = (PathBuf, Trace)> {
    files(".trace.gz").into_iter().map(|path| {
        let trace = Trace::from_file(&path).unwrap_or_else(|error| panic!("{}: {error}", path.display()));
        (path, trace)
    })
}

#[test]
fn every_trace_is_written_as_it_was_read() {
    for (path, trace) in traces() {
        assert!(trace.to_string() == text(&path), "{} is written differently", path.display());
    }
}

#[test]
fn the_hash_of_every_full_state_is_that_of_its_words() {
    for (path, trace) in traces() {
        let mut lines = trace.lines.iter().peekable();
        while let Some(line) = lines.next() {
            let Line::Step(expected) = *line else { continue };
            let mut states = Vec::new();
            while let Some(Line::Body(body)) = lines.peek() {
                states.push(body.state);
                lines.next();
            }
            let StepLine { step, arbiters, contacts, .. } = expected;
            if !states.is_empty() {
                let actual = step_line(step, states, arbiters, contacts);
                assert_eq!(actual, expected, "{}", path.display());
            }
        }
    }
}

#[test]
fn the_last_hash_is_that_of_the_hashes_of_the_steps() {
    for (path, trace) in traces() {
        let steps: Vec<&StepLine> =
            trace.lines.iter().filter_map(step).filter(|line| line.step > 0).collect();
        let (last, expected) = trace.end().expect("a trace that can be read has an end");
        if steps.len() == last as usize {
            let mut hash = Fnv::EMPTY;
            steps.iter().for_each(|line| hash.bytes(&line.hash.to_le_bytes()));
            assert_eq!(hash.finish(), expected, "{}", path.display());
        }
    }
}

fn step(line: &Line) -> Option<&StepLine> {
    match line {
        Line::Step(line) => Some(line),
        _ => None,
    }
}

/// An entry of the index, with the fields of a trace among others.
#[derive(Deserialize)]
struct Listed {
    scene: String,
    cumulative_hash: String,
}

#[test]
fn the_index_lists_every_trace_with_its_last_hash() {
    let mut index = csv::Reader::from_path(golden::folder().join("INDEX.csv")).expect("the index is there");
    let mut listed: Vec<(String, String)> = index
        .deserialize()
        .map(|row: csv::Result<Listed>| row.expect("it names scenes and hashes"))
        .map(|Listed { scene, cumulative_hash }| (scene, cumulative_hash))
        .collect();
    listed.sort();
    let actual: Vec<(String, String)> = traces()
        .map(|(_, trace)| {
            let (_, hash) = trace.end().expect("a trace that can be read has an end");
            (trace.header.scene.clone(), format!("{hash:016x}"))
        })
        .collect();
    assert_eq!(listed, actual);
}

#[test]
fn every_scene_can_be_read() {
    for path in files(".json.gz") {
        let scene = Scene::from_file(&path).unwrap_or_else(|error| panic!("{error}"));
        assert_eq!(
            path.file_name().and_then(|name| name.to_str()),
            Some(format!("{}.json.gz", scene.name).as_str())
        );
    }
}

/// The text of a short trace with one field replaced.
fn short_trace(from: &str, to: &str) -> String {
    let text = "farseer-trace 1\nscene short\nsteps 1\ndt 3c23d70a\nfull_every 1\nbodies 0\ngeoms 0\njoints 0\n\
                springs 0\ncontrollers 0\ns 0 a8c7f832281a39c5 0 0\ns 1 a8c7f832281a39c5 0 0\n\
                end 1 03514115fbb716fd\n";
    assert!(text.contains(from));
    text.replace(from, to)
}

fn error(text: &str) -> String {
    text.parse::<Trace>().expect_err("the trace is broken").to_string()
}

#[test]
fn a_trace_that_ends_early_is_refused() {
    assert_eq!(error(&short_trace("end 1 03514115fbb716fd\n", "")), "ends without an `end` line");
}

#[test]
fn a_line_of_an_unknown_kind_is_refused_with_its_number() {
    assert_eq!(error(&short_trace("s 1 ", "t 1 ")), "line 12: \"t\" is no kind of line");
}

#[test]
fn a_broken_word_is_refused_with_its_line() {
    assert_eq!(
        error(&short_trace("3c23d70a", "3c23d7")),
        "line 4: \"3c23d7\" is not a number of 8 hex digits"
    );
}

#[test]
fn a_missing_field_is_refused_with_its_line() {
    assert_eq!(
        error(&short_trace("s 0 a8c7f832281a39c5 0 0", "s 0 a8c7f832281a39c5 0")),
        "line 11: has too few fields"
    );
}

#[test]
fn a_line_after_the_end_is_refused() {
    assert_eq!(
        error(&short_trace("fd\n", "fd\ns 2 a8c7f832281a39c5 0 0\n")),
        "line 14: comes after the `end` line"
    );
}

#[test]
fn a_header_without_a_line_is_refused() {
    assert_eq!(error(&short_trace("springs 0\n", "")), "line 9: \"controllers 0\" where `springs` should be");
}
