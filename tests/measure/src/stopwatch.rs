//! Stopwatch for CPU time.

use std::time::Duration;
#[cfg(not(unix))]
use std::time::Instant;

#[cfg(unix)]
use rustix::time::{ClockId, Timespec, clock_gettime};

/// Measures the CPU time of this thread, so other threads on the same processor do not count. On systems other than Unix it
/// measures wall time.
#[derive(Debug, Clone, Copy)]
pub struct Stopwatch {
    #[cfg(unix)]
    start: Timespec,
    #[cfg(not(unix))]
    start: Instant,
}

impl Stopwatch {
    /// Starts a measurement of CPU time, which [`Stopwatch::elapsed`] reads.
    pub fn start() -> Self {
        #[cfg(unix)]
        let start = clock_gettime(ClockId::ThreadCPUTime);
        #[cfg(not(unix))]
        let start = Instant::now();
        Stopwatch { start }
    }

    /// Returns the CPU time since [`Stopwatch::start`].
    pub fn elapsed(self) -> Duration {
        #[cfg(unix)]
        let elapsed =
            Duration::try_from(clock_gettime(ClockId::ThreadCPUTime) - self.start).unwrap_or_default();
        #[cfg(not(unix))]
        let elapsed = self.start.elapsed();
        elapsed
    }
}
