//! Many seeds one after the other, with limits of time and memory for each.

mod caught;
mod memory;
mod watchdog;

pub use caught::caught;
pub use memory::is_known as memory_is_known;

use std::time::{Duration, Instant};

use crate::subjects::Subject;
use memory::Memory;
use watchdog::Watchdog;

/// Which seeds to try, and what one of them may take.
#[derive(Debug, Clone, Copy)]
pub struct Limits {
    /// First seed.
    pub from: u64,
    /// Number of seeds.
    pub count: u64,
    /// Longest time of a seed. One that takes ten times as long is taken for endless, and ends the program.
    pub time: Duration,
    /// Most memory in megabytes by which a seed may raise what the program holds; known on Linux only.
    pub megabytes: u64,
}

/// What became of the seeds of a subject.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub struct Summary {
    /// Seeds that were tried.
    pub tried: u64,
    /// Those for which something did not hold, or panicked.
    pub failed: u64,
    /// Those that took too long.
    pub slow: u64,
    /// Those that took too much memory.
    pub large: u64,
    /// The longest time, and its seed.
    pub longest: (Duration, u64),
}

impl Summary {
    /// Whether all was well.
    pub fn is_clean(&self) -> bool {
        (self.failed, self.slow, self.large) == (0, 0, 0)
    }
}

/// Tries a subject with all seeds; `say` is told a line for everything that is not well.
pub fn run(subject: &Subject, limits: Limits, mut say: impl FnMut(&str)) -> Summary {
    let watchdog = Watchdog::start(limits.time * 10);
    let mut summary = Summary::default();
    for seed in limits.from..limits.from + limits.count {
        watchdog.watch(subject.name, seed);
        let memory = Memory::now();
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

/// For tests: what was wrong with these seeds, one line each.
pub fn failures(
    seeds: impl IntoIterator<Item = u64>,
    check: impl Fn(u64) -> Result<(), String>,
) -> Vec<String> {
    let failure = |seed| caught(|| check(seed)).err().map(|what| format!("seed {seed}: {what}"));
    seeds.into_iter().filter_map(failure).collect()
}
