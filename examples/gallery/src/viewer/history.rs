//! The way back in time: a ring of copies of what is on the screen.

use std::collections::VecDeque;

use crate::show::Show;
use crate::state;

/// Simulated seconds from one copy to the next, of a small scene.
const INTERVAL: f64 = 0.05;
/// Bodies from which on copies are made less often.
const SMALL: usize = 200;
/// Most copies, and most bodies in all of them together: so memory is bounded.
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
    /// Nothing yet, for a scene of this size.
    pub(super) fn of(show: &Show) -> Self {
        let bodies: usize = show.halves().iter().map(|half| state::counts(half.play().world()).bodies).sum();
        let interval = INTERVAL * (bodies as f64 / SMALL as f64).max(1.0);
        let capacity = (MOST[1] / bodies.max(1)).clamp(2, MOST[0]);
        History { interval, capacity, since: f64::MAX, ..History::default() }
    }

    /// Before a step of so many seconds.
    pub(super) fn note(&mut self, show: &Show, step: f64) {
        if self.since >= self.interval {
            self.since = 0.0;
            if self.copies.len() >= self.capacity {
                self.copies.pop_front();
            }
            let mut copy = show.clone();
            // Nobody holds anything when time has gone back.
            copy.release();
            self.copies.push_back(copy);
        }
        self.since += step;
    }

    /// So many seconds back, if it was noted; answers what was there.
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
