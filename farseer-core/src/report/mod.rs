//! What a simulator tells of its last update, and what it still has to tell.

use crate::storage::reusing_clone::reusing_clone;

mod event;
mod step_times;

pub use event::Event;
pub(crate) use event::Notice;
pub use step_times::StepTimes;
pub(crate) use step_times::{Clock, Stopwatch};

/// What a step did: how much work there was.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct StepCounters {
    /// Pairs whose shapes were tested against each other.
    pub pairs_tested: usize,
    /// Pairs that touch.
    pub pairs_touching: usize,
    /// Contacts the solver worked on in every iteration.
    pub contacts_solved: usize,
    /// Passes that the solver made.
    pub passes: u32,
    /// Bodies that changed their pose.
    pub bodies_moved: usize,
    /// Bodies that sleep; 0 with the faithful set.
    pub bodies_asleep: usize,
    /// Pairs of convex pieces whose contacts were found anew, because the two had moved against each other; 0 with the
    /// faithful set, which finds all anew.
    pub manifolds_made: usize,
    /// Pairs of convex pieces that had moved so little against each other that only distances were renewed; 0 with the
    /// faithful set.
    pub manifolds_kept: usize,
    /// Fat AABBs that the broad phase computed anew, because shapes had left theirs or were new; 0 with the faithful set.
    pub aabbs_renewed: usize,
}

/// What is told of the last update. Nothing of it is saved: the next update overwrites it and reads none of it.
#[derive(Debug, Default)]
pub(crate) struct Report {
    pub(crate) events: Vec<Event>,
    pub(crate) counters: StepCounters,
    pub(crate) step_times: StepTimes,
    /// Empty: the other buffer of what is still to be told.
    pub(crate) delivered: Vec<Notice>,
}

reusing_clone! { Report { events, counters, step_times, delivered } }

impl Report {
    /// An update begins.
    pub(crate) fn clear(&mut self) {
        self.events.clear();
        self.counters = StepCounters::default();
    }

    pub(crate) fn push(&mut self, event: Event) {
        self.events.push(event);
    }
}
