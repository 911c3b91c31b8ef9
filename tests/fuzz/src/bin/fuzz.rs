//! Tests properties with many seeds, for any duration. A report is reproduced with the arguments that it prints.

use std::process::ExitCode;
use std::time::Duration;

use clap::Parser;
use clap::builder::PossibleValue;
use fuzz::long_run::{Limits, Summary, memory_is_known, run};
use fuzz::subjects::{SUBJECTS, Subject};

#[derive(Parser)]
#[command(about = "Tries what must hold with many seeds; exit code 1 if something does not.")]
struct Arguments {
    /// Properties to test, one or more.
    #[arg(required = true, value_parser = subject_names())]
    subjects: Vec<String>,
    /// First seed.
    #[arg(long, default_value_t = 0)]
    from: u64,
    /// Number of seeds.
    #[arg(long, default_value_t = 1000)]
    count: u64,
    /// Longest time of a seed, for all that is tried with it; ten times as long ends the program.
    #[arg(long, default_value_t = 5.0)]
    seconds: f64,
    /// Most memory that a seed may take.
    #[arg(long, default_value_t = 500)]
    megabytes: u64,
}

fn subject_names() -> Vec<PossibleValue> {
    SUBJECTS.iter().map(|subject| PossibleValue::new(subject.name).help(subject.about)).collect()
}

fn main() -> ExitCode {
    let arguments = Arguments::parse();
    let Ok(time) = Duration::try_from_secs_f64(arguments.seconds) else {
        eprintln!("--seconds {} is no time", arguments.seconds);
        return ExitCode::from(2);
    };
    let limits =
        Limits { from: arguments.from, count: arguments.count, time, megabytes: arguments.megabytes };
    if !memory_is_known() {
        println!("This system does not tell how much memory is held: it is not limited.");
    }
    let chosen = SUBJECTS.iter().filter(|subject| arguments.subjects.iter().any(|name| name == subject.name));
    let summaries: Vec<Summary> = chosen.map(|subject| tried(subject, limits)).collect();
    if summaries.iter().all(Summary::is_clean) { ExitCode::SUCCESS } else { ExitCode::FAILURE }
}

fn tried(subject: &Subject, limits: Limits) -> Summary {
    let summary = run(subject, limits, |line| println!("{line}"));
    let Summary { tried, failed, slow, large, longest: (time, seed) } = summary;
    println!(
        "{}: {tried} seeds, {failed} failed, {slow} too slow, {large} too large; the longest took {:.2} s, seed {seed}",
        subject.name,
        time.as_secs_f64(),
    );
    summary
}
