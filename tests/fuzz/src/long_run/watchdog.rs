//! Ends the program if a seed takes too long.

use std::process;
use std::sync::{Arc, Mutex};
use std::thread;
use std::time::{Duration, Instant};

/// The seed that is tested now, with its subject as text, and its start.
type CurrentSeed = Arc<Mutex<Option<(String, Instant)>>>;

/// A thread that watches the tested seed until this value is dropped.
pub(super) struct Watchdog {
    watched: CurrentSeed,
}

impl Watchdog {
    /// Starts the watchdog. If a seed takes longer than `patience` it reports the seed and ends the program with exit code 1,
    /// because a thread cannot be ended from outside.
    pub(super) fn start(patience: Duration) -> Self {
        let watched: CurrentSeed = Arc::default();
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

    /// Tells the watchdog that the test of a seed begins.
    pub(super) fn watch(&self, subject: &str, seed: u64) {
        let case = format!("{subject} --from {seed} --count 1");
        *self.watched.lock().expect("nobody panics while it is held") = Some((case, Instant::now()));
    }
}
