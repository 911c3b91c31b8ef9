//! Rewinding: a ring buffer of copies of the screen's scenes.

use std::collections::VecDeque;

use crate::show::Show;
use crate::state;

/// Simulated seconds from one copy to the next, of a small scene.
const INTERVAL: f64 = 0.05;
/// Number of bodies from which on copies are made less often.
const SMALL: usize = 200;
/// Greatest number of copies, and of bodies in all of them together, so that memory is bounded.
const MOST: [usize; 2] = [400, 60_000];

/// Copies, the latest last.
#[derive(Debug, Default)]
pub(super) struct History {
    copies: VecDeque<Show>,
    interval: f64,
    capacity: usize,
    /// Simulated seconds since the last copy.
    since: f64,
    /// Seconds to go back that are not gone yet.
    owed: f64,
}

impl History {
    /// An empty history, for a scene of this size.
    pub(super) fn of(show: &Show) -> Self {
        let bodies: usize = show.halves().iter().map(|half| state::counts(half.play().world()).bodies).sum();
        let interval = INTERVAL * (bodies as f64 / SMALL as f64).max(1.0);
        let capacity = (MOST[1] / bodies.max(1)).clamp(2, MOST[0]);
        History { interval, capacity, since: f64::MAX, ..History::default() }
    }

    /// Records the state before a step of `step` seconds.
    pub(super) fn note(&mut self, show: &Show, step: f64) {
        if self.since >= self.interval {
            self.since = 0.0;
            if self.copies.len() >= self.capacity {
                self.copies.pop_front();
            }
            let mut copy = show.clone();
            // No body is grabbed after a rewind.
            copy.release();
            self.copies.push_back(copy);
        }
        self.since += step;
    }

    /// The copy from a number of seconds ago, if there is one.
    pub(super) fn back(&mut self, seconds: f64) -> Option<Show> {
        self.owed += seconds;
        let mut then = None;
        while self.owed >= self.interval {
            self.owed -= self.interval;
            // The first one stays.
            let last =
                if self.copies.len() > 1 { self.copies.pop_back() } else { self.copies.front().cloned() };
            then = last.or(then);
        }
        if then.is_some() {
            self.since = f64::MAX;
        }
        then
    }
}
