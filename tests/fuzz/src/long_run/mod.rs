//! Tests many seeds one after the other, with limits of time and memory for each.

mod caught;
mod memory;
mod watchdog;

pub use caught::caught;
pub use memory::is_known as memory_is_known;

use std::time::{Duration, Instant};

use crate::subjects::Subject;
use memory::PeakMemory;
use watchdog::Watchdog;

/// Seeds to test, and limits of the cost of each.
#[derive(Debug, Clone, Copy)]
pub struct Limits {
    /// First seed.
    pub from: u64,
    /// Number of seeds.
    pub count: u64,
    /// Longest allowed time of a seed. A seed that takes ten times as long counts as endless: the program ends.
    pub time: Duration,
    /// Greatest allowed growth of the program's peak memory by one seed, in megabytes. Measured on Linux only.
    pub megabytes: u64,
}

/// Outcome of all tested seeds of a subject.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub struct Summary {
    /// Number of seeds that were tested.
    pub tried: u64,
    /// Number of seeds with a violated property or a panic.
    pub failed: u64,
    /// Number of seeds that took longer than allowed.
    pub slow: u64,
    /// Number of seeds that took more memory than allowed.
    pub large: u64,
    /// Longest time of a seed, and that seed.
    pub longest: (Duration, u64),
}

impl Summary {
    /// Returns whether no seed failed, took too long, or took too much memory.
    pub fn is_clean(&self) -> bool {
        (self.failed, self.slow, self.large) == (0, 0, 0)
    }
}

/// Tests a subject with all seeds. Calls `say` with a line of text for every failure.
pub fn run(subject: &Subject, limits: Limits, mut say: impl FnMut(&str)) -> Summary {
    let watchdog = Watchdog::start(limits.time * 10);
    let mut summary = Summary::default();
    for seed in limits.from..limits.from + limits.count {
        watchdog.watch(subject.name, seed);
        let memory = PeakMemory::now();
        let start = Instant::now();
        let result = caught(|| (subject.check)(seed));
        let (time, megabytes) = (start.elapsed(), memory.growth_in_megabytes());
        summary.tried += 1;
        summary.longest = summary.longest.max((time, seed));
        let case = format!("{} --from {seed} --count 1", subject.name);
        if let Err(what) = result {
            summary.failed += 1;
            say(&format!("FAILED {case}: {what}"));
        }
        if time > limits.time {
            summary.slow += 1;
            say(&format!("SLOW {case}: {:.1} s", time.as_secs_f64()));
        }
        if megabytes > limits.megabytes {
            summary.large += 1;
            say(&format!("LARGE {case}: {megabytes} MB"));
        }
    }
    summary
}

/// Returns the failures of these seeds, one line each. Tests call it; it has no limits of time and memory.
pub fn failures(
    seeds: impl IntoIterator<Item = u64>,
    check: impl Fn(u64) -> Result<(), String>,
) -> Vec<String> {
    let failure = |seed| caught(|| check(seed)).err().map(|what| format!("seed {seed}: {what}"));
    seeds.into_iter().filter_map(failure).collect()
}
