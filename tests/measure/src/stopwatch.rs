//! CPU time.

use std::time::Duration;
#[cfg(not(unix))]
use std::time::Instant;

#[cfg(unix)]
use rustix::time::{ClockId, Timespec, clock_gettime};

/// Measures the CPU time of this thread, which does not run while others have the processor; where it is not to
/// be had, time as it passes.
#[derive(Debug, Clone, Copy)]
pub struct Stopwatch {
    #[cfg(unix)]
    start: Timespec,
    #[cfg(not(unix))]
    start: Instant,
}

impl Stopwatch {
    /// Begins to measure.
    pub fn start() -> Self {
        #[cfg(unix)]
        let start = clock_gettime(ClockId::ThreadCPUTime);
        #[cfg(not(unix))]
        let start = Instant::now();
        Stopwatch { start }
    }

    /// The time since the start.
    pub fn elapsed(self) -> Duration {
        #[cfg(unix)]
        let elapsed =
            Duration::try_from(clock_gettime(ClockId::ThreadCPUTime) - self.start).unwrap_or_default();
        #[cfg(not(unix))]
        let elapsed = self.start.elapsed();
        elapsed
    }
}
