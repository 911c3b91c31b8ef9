//! Says how far a sweep is.

use super::sweep::Trial;
use std::io::{IsTerminal, Write, stderr};
use std::time::{Duration, Instant};

/// How far a sweep is, told on the standard error stream.
#[derive(Debug)]
pub struct Progress {
    start: Instant,
    told: Option<Instant>,
    is_terminal: bool,
    trials: usize,
    watched: usize,
    /// In what [`expected`] gives.
    work: f64,
    done: f64,
}

impl Progress {
    /// For all of some trials.
    pub fn of<'a, 'b: 'a>(trials: impl IntoIterator<Item = &'a Trial<'b>>) -> Self {
        let (trials, work) =
            trials.into_iter().fold((0, 0.0), |(count, work), trial| (count + 1, work + expected(trial)));
        Progress {
            start: Instant::now(),
            told: None,
            is_terminal: stderr().is_terminal(),
            trials,
            watched: 0,
            work,
            done: 0.0,
        }
    }

    /// Tells which trial is next: on a terminal ten times a second, else every ten seconds.
    pub fn show(&mut self, trial: &Trial<'_>) {
        let pause = if self.is_terminal { Duration::from_millis(100) } else { Duration::from_secs(10) };
        if self.told.is_some_and(|told| told.elapsed() < pause) {
            return;
        }
        self.told = Some(Instant::now());
        let size = if trial.size == 0 { String::new() } else { format!(" {}", trial.size) };
        let text = format!(
            "{:4} of {}, {}: {}{size}, {}",
            self.watched + 1,
            self.trials,
            self.left(),
            trial.scene,
            trial.method
        );
        // There is nobody to tell if this fails.
        let _ = if self.is_terminal {
            write!(stderr(), "\r{text:<100.100}").and_then(|()| stderr().flush())
        } else {
            writeln!(stderr(), "{text}")
        };
    }

    /// The watched run of a trial has been made, which is taken for half of the trial.
    pub fn did_watch(&mut self, trial: &Trial<'_>) {
        self.watched += 1;
        self.done += expected(trial) / 2.0;
    }

    /// The other runs of a trial have been made.
    pub fn did_time(&mut self, trial: &Trial<'_>) {
        self.done += expected(trial) / 2.0;
    }

    /// Ends the line, and gives the time since the start.
    pub fn end(self) -> Duration {
        if self.is_terminal {
            let _ = writeln!(stderr(), "\r{:<100}", format!("{} runs", self.trials));
        }
        self.start.elapsed()
    }

    /// Time left, judged by what was done so far.
    fn left(&self) -> String {
        let elapsed = self.start.elapsed().as_secs_f64();
        if self.done <= 0.0 {
            return "just begun".to_owned();
        }
        let left = (elapsed * (self.work - self.done) / self.done).max(0.0).round() as u64;
        format!("{}:{:02} left", left / 60, left % 60)
    }
}

/// About how long a trial takes, in s on the machine this was written on: what all take, and what bodies and
/// passes add to each step.
pub fn expected(trial: &Trial<'_>) -> f64 {
    let steps = trial.seconds / f64::from(trial.setting.dt.mean());
    let bodies = trial.size.max(2) as f64;
    let step = 1e-6 * bodies * (3.0 + 0.4 * f64::from(trial.setting.passes));
    0.06 + 2.0 * steps * step
}
