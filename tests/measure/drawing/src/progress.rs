//! Displays the progress of a sweep on the standard error stream.

use indicatif::{ProgressBar, ProgressStyle};
use std::sync::Mutex;
use std::time::{Duration, Instant};

/// Time between two progress lines where there is no terminal.
const PAUSE: Duration = Duration::from_secs(10);
/// Number of steps of the progress bar per unit of work.
const PARTS: f64 = 1000.0;

/// Display of the progress of a sweep: a bar on a terminal, else a line at most every ten seconds.
#[derive(Debug)]
pub struct Progress {
    bar: ProgressBar,
    told: Mutex<Option<Instant>>,
}

impl Progress {
    /// Returns a display for the total work `work`, in a unit that the caller chooses.
    pub fn of(work: f64) -> Self {
        let style = ProgressStyle::with_template("{wide_bar} {percent:>3} %, {eta} left: {msg}");
        let bar = ProgressBar::new((PARTS * work) as u64);
        Progress { bar: bar.with_style(style.expect("a template that is known")), told: Mutex::default() }
    }

    /// Displays the work done so far, in the caller's unit, and the name of the next item.
    pub fn tell(&self, done: f64, next: String) {
        self.bar.set_position((PARTS * done) as u64);
        if self.bar.is_hidden() {
            self.tell_in_a_line(&next);
        }
        self.bar.set_message(next);
    }

    /// Adds work that is done, in the caller's unit.
    pub fn advance(&self, by: f64) {
        self.bar.inc((PARTS * by) as u64);
    }

    /// Returns the work done so far, in the caller's unit.
    pub fn done(&self) -> f64 {
        self.bar.position() as f64 / PARTS
    }

    /// Ends the display. Returns the time since the start.
    pub fn end(self) -> Duration {
        self.bar.finish_and_clear();
        self.bar.elapsed()
    }

    fn tell_in_a_line(&self, next: &str) {
        let mut told = self.told.lock().expect("nobody panics with it");
        if told.is_none_or(|told| told.elapsed() > PAUSE) {
            *told = Some(Instant::now());
            let percent = 100 * self.bar.position() / self.bar.length().unwrap_or(0).max(1);
            eprintln!("{percent:3} %, {} s left: {next}", self.bar.eta().as_secs());
        }
    }
}
