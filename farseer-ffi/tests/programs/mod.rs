//! Compiles and runs programs in C and C# against the library that Cargo has built for the tests.

use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};

/// Folder of the crate.
pub(crate) fn root() -> &'static Path {
    Path::new(env!("CARGO_MANIFEST_DIR"))
}

/// Folder of the test program, where Cargo also puts the libraries.
fn libraries() -> PathBuf {
    std::env::current_exe().unwrap().parent().unwrap().to_owned()
}

/// A file for a program of a test.
fn built(name: &str) -> PathBuf {
    Path::new(env!("CARGO_TARGET_TMPDIR")).join(name)
}

/// Whether a tool can be started; if not, the test says so and is skipped.
fn has(tool: &str) -> bool {
    let started = Command::new(tool).arg("--version").stdout(Stdio::null()).stderr(Stdio::null()).status();
    if started.is_err() {
        eprintln!("\n!!! SKIPPED: there is no {tool}, so that this program is not tested !!!\n");
    }
    started.is_ok()
}

/// Runs a command with the library in reach, and returns its output.
fn output(command: &mut Command) -> String {
    let output = command.env("LD_LIBRARY_PATH", libraries()).output().unwrap();
    let errors = String::from_utf8_lossy(&output.stderr);
    assert!(output.status.success(), "{command:?}: {}\n{errors}", output.status);
    String::from_utf8(output.stdout).unwrap()
}

/// Output of a program in C; `None` without gcc.
pub(crate) fn run_c(source: &Path, name: &str) -> Option<String> {
    if !has("gcc") {
        return None;
    }
    let program = built(name);
    let mut compiler = Command::new("gcc");
    compiler.args(["-std=c99", "-Wall", "-Wextra", "-Werror", "-o"]).arg(&program).arg(source);
    compiler.arg("-I").arg(root().join("include")).arg("-L").arg(libraries()).args(["-lfarseer_ffi", "-lm"]);
    output(&mut compiler);
    Some(output(&mut Command::new(program)))
}

/// Output of a program in C#; `None` without mono.
pub(crate) fn run_csharp(source: &Path, name: &str) -> Option<String> {
    if !has("mcs") || !has("mono") {
        return None;
    }
    let program = built(name);
    let mut compiler = Command::new("mcs");
    compiler.arg("-warnaserror").arg(format!("-out:{}", program.display())).arg(source);
    output(compiler.arg(root().join("csharp/Farseer.cs")));
    Some(output(Command::new("mono").arg(program)))
}
