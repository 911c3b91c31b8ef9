//! How much memory the program has held at most.

use std::fs;

/// What the program had held at most at some moment.
pub(super) struct Memory {
    peak: u64,
}

impl Memory {
    /// That of this moment.
    pub(super) fn now() -> Self {
        // Writing 5 lets the kernel forget the peak so far; where it does not, later peaks that are lower go unseen.
        let _ = fs::write("/proc/self/clear_refs", "5");
        Memory { peak: peak_in_megabytes() }
    }

    /// By how much the peak has risen since; 0 where the system does not tell.
    pub(super) fn growth_in_megabytes(&self) -> u64 {
        peak_in_megabytes().saturating_sub(self.peak)
    }
}

/// The resident memory of the process at its peak, as Linux tells it; 0 elsewhere.
fn peak_in_megabytes() -> u64 {
    let status = fs::read_to_string("/proc/self/status").unwrap_or_default();
    let kilobytes = status.lines().find_map(|line| line.strip_prefix("VmHWM:")?.split_whitespace().next());
    kilobytes.and_then(|number| number.parse::<u64>().ok()).unwrap_or(0) / 1024
}

/// Whether this system tells.
pub fn is_known() -> bool {
    peak_in_megabytes() > 0
}

#[cfg(all(test, target_os = "linux"))]
mod tests {
    use super::Memory;

    #[test]
    fn memory_that_was_taken_and_given_back_is_seen() {
        let memory = Memory::now();
        drop(std::hint::black_box(vec![1u8; 64 << 20]));
        assert!(memory.growth_in_megabytes() >= 32);
    }
}
