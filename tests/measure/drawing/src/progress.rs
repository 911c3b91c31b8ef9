//! Says how far a sweep is, on the standard error stream.

use indicatif::{ProgressBar, ProgressStyle};
use std::sync::Mutex;
use std::time::{Duration, Instant};

/// How often it is told where there is no terminal.
const PAUSE: Duration = Duration::from_secs(10);
/// Parts of a unit of work that the bar counts.
const PARTS: f64 = 1000.0;

/// How far a sweep is: a bar on a terminal, else a line now and then.
#[derive(Debug)]
pub struct Progress {
    bar: ProgressBar,
    told: Mutex<Option<Instant>>,
}

impl Progress {
    /// For so much work, in a unit of the caller's.
    pub fn of(work: f64) -> Self {
        let style = ProgressStyle::with_template("{wide_bar} {percent:>3} %, {eta} left: {msg}");
        let bar = ProgressBar::new((PARTS * work) as u64);
        Progress { bar: bar.with_style(style.expect("a template that is known")), told: Mutex::default() }
    }

    /// So much is done, and this is next.
    pub fn tell(&self, done: f64, next: String) {
        self.bar.set_position((PARTS * done) as u64);
        if self.bar.is_hidden() {
            self.tell_in_a_line(&next);
        }
        self.bar.set_message(next);
    }

    /// So much more is done.
    pub fn advance(&self, by: f64) {
        self.bar.inc((PARTS * by) as u64);
    }

    /// Where it is, in the unit of the work.
    pub fn done(&self) -> f64 {
        self.bar.position() as f64 / PARTS
    }

    /// All is done; gives the time since the start.
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
