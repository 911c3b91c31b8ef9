//! Ends the program when a seed does not end.

use std::process;
use std::sync::{Arc, Mutex};
use std::thread;
use std::time::{Duration, Instant};

/// What is watched, and since when.
type Watched = Arc<Mutex<Option<(String, Instant)>>>;

/// Watches until it is dropped.
pub(super) struct Watchdog {
    watched: Watched,
}

impl Watchdog {
    /// Whatever takes longer than `patience` is reported, and ends the program with exit code 1: a thread cannot be
    /// ended from outside.
    pub(super) fn start(patience: Duration) -> Self {
        let watched: Watched = Arc::default();
        let seen = Arc::downgrade(&watched);
        thread::spawn(move || {
            while let Some(watched) = seen.upgrade() {
                if let Some((case, since)) = &*watched.lock().expect("nobody panics while it is held")
                    && since.elapsed() > patience
                {
                    println!("ENDLESS {case}: more than {} s", patience.as_secs());
                    process::exit(1);
                }
                drop(watched);
                thread::sleep(Duration::from_millis(100));
            }
        });
        Watchdog { watched }
    }

    /// A seed begins.
    pub(super) fn watch(&self, subject: &str, seed: u64) {
        let case = format!("{subject} --from {seed} --count 1");
        *self.watched.lock().expect("nobody panics while it is held") = Some((case, Instant::now()));
    }
}
