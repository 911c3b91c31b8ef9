//! The first programs of the README are compiled and run.

mod programs;

use std::path::{Path, PathBuf};

use programs::{root, run_c, run_csharp};

/// Writes the first block of code in a language to a file.
fn extracted(language: &str, file: &str) -> PathBuf {
    let readme = std::fs::read_to_string(root().join("README.md")).unwrap();
    let (_, rest) = readme.split_once(&format!("```{language}\n")).unwrap();
    let (code, _) = rest.split_once("```").unwrap();
    let path = Path::new(env!("CARGO_TARGET_TMPDIR")).join(file);
    std::fs::write(&path, code).unwrap();
    path
}

#[test]
fn the_first_program_in_c_runs() {
    if let Some(output) = run_c(&extracted("c", "first.c"), "first") {
        assert_eq!(output, "the ball lies at 180\n");
    }
}

#[test]
fn the_first_program_in_csharp_runs() {
    if let Some(output) = run_csharp(&extracted("csharp", "First.cs"), "First.exe") {
        assert_eq!(output.trim_end(), "the ball lies at 180");
    }
}
