//! Runs scenes and compares every bit with the recordings of the original engine.

use clap::Parser;
use conformance::check::check_folders;
use conformance::golden;
use conformance::scene::{Feature, Features};
use std::io::Write;
use std::path::PathBuf;
use std::process::ExitCode;
use std::thread::available_parallelism;

/// Runs every scene (NAME.json with NAME.trace, plain or .gz) of folders and compares the runs with the traces.
///
/// Ends with status 0 only if every scene is reproduced exactly, apart from those that need a feature which --skip names.
#[derive(Debug, Parser)]
struct Arguments {
    /// Leave out scenes that need any of these: joints, springs, controllers, paths.
    #[arg(long, value_delimiter = ',', value_name = "FEATURES")]
    skip: Vec<Feature>,
    /// Folders with scenes and traces; without any, the repository's own.
    #[arg(value_name = "DIR")]
    folders: Vec<PathBuf>,
}

fn main() -> ExitCode {
    let mut arguments = Arguments::parse();
    if arguments.folders.is_empty() {
        arguments.folders.push(golden::folder());
    }
    let threads = available_parallelism().map_or(1, usize::from);
    let skip = Features::of(&arguments.skip);
    let mut output = std::io::stdout().lock();
    let checked = check_folders(&arguments.folders, skip, threads, &mut output)
        .and_then(|summary| writeln!(output, "\n{summary}").map(|()| summary));
    match checked {
        Ok(summary) if summary.is_success() => ExitCode::SUCCESS,
        Ok(_) => ExitCode::FAILURE,
        Err(error) => {
            eprintln!("the report cannot be written: {error}");
            ExitCode::FAILURE
        }
    }
}
