//! Measures the greatest amount of memory that the program has held.

use std::fs;

/// Peak memory of the program at some moment.
pub(super) struct PeakMemory {
    peak: u64,
}

impl PeakMemory {
    /// Returns the peak memory of the program at this moment.
    pub(super) fn now() -> Self {
        // Writing 5 resets the peak that the kernel stores. Where that is not possible, later peaks are measured only if they
        // are higher.
        let _ = fs::write("/proc/self/clear_refs", "5");
        PeakMemory { peak: peak_in_megabytes() }
    }

    /// Returns the growth of the peak memory since `self`, in megabytes; 0 where the system does not report it.
    pub(super) fn growth_in_megabytes(&self) -> u64 {
        peak_in_megabytes().saturating_sub(self.peak)
    }
}

/// Returns the peak resident memory of the process in megabytes, as Linux reports it; 0 on other systems.
fn peak_in_megabytes() -> u64 {
    let status = fs::read_to_string("/proc/self/status").unwrap_or_default();
    let kilobytes = status.lines().find_map(|line| line.strip_prefix("VmHWM:")?.split_whitespace().next());
    kilobytes.and_then(|number| number.parse::<u64>().ok()).unwrap_or(0) / 1024
}

/// Returns whether this system reports the peak memory.
pub fn is_known() -> bool {
    peak_in_megabytes() > 0
}

#[cfg(all(test, target_os = "linux"))]
mod tests {
    use super::PeakMemory;

    #[test]
    fn allocated_and_freed_memory_shows_in_the_peak() {
        let memory = PeakMemory::now();
        drop(std::hint::black_box(vec![1u8; 64 << 20]));
        assert!(memory.growth_in_megabytes() >= 32);
    }
}
