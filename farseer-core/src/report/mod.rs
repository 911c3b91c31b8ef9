//! The report of the last update, and events that are still to be reported.

use farseer_precise::reusing_clone;

mod event;
mod hit;
mod islands;
mod step_times;

pub use event::Event;
pub(crate) use event::PendingEvent;
pub use hit::Hit;
pub use islands::{AwakeReason, Island};
pub use step_times::StepTimes;
pub(crate) use step_times::{Clock, Stopwatch};

/// Number of events for which the list keeps its memory in any case, a count: 256 KiB.
const MAX_SPARE_EVENTS: usize = 8192;

/// Counters of the work of a step.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct StepCounters {
    /// Number of pairs whose shapes were tested against each other.
    pub pairs_tested: usize,
    /// Number of pairs that touch.
    pub pairs_touching: usize,
    /// Number of contacts that the solver worked on in every iteration.
    pub contacts_solved: usize,
    /// Number of solver iterations.
    pub passes: u32,
    /// Number of bodies that changed their pose.
    pub bodies_moved: usize,
    /// Number of sleeping bodies; 0 with the faithful set.
    pub bodies_asleep: usize,
    /// Number of pairs of convex pieces whose manifolds were computed anew, because their relative pose had changed; 0
    /// with the faithful set, which computes all anew.
    pub manifolds_made: usize,
    /// Number of pairs of convex pieces whose manifolds were recycled: their relative pose had changed so little that
    /// only separations were computed; 0 with the faithful set.
    pub manifolds_kept: usize,
    /// Number of fat AABBs that the broad phase computed, because shapes had left theirs or were new; 0 with the
    /// faithful set.
    pub aabbs_renewed: usize,
}

/// The report of the last update. It is not saved: the next update overwrites it and does not depend on it.
#[derive(Debug, Default)]
pub(crate) struct Report {
    pub(crate) events: Vec<Event>,
    pub(crate) hits: Vec<Hit>,
    pub(crate) counters: StepCounters,
    pub(crate) step_times: StepTimes,
    /// Empty: the second buffer for pending events.
    pub(crate) pending_buffer: Vec<PendingEvent>,
}

reusing_clone! { Report { events, hits, counters, step_times, pending_buffer } }

impl Report {
    /// Clears the report at the beginning of an update.
    ///
    /// A list of very many events, such as those of the first update of a large world, gives its memory back after an update that
    /// needed little of it.
    pub(crate) fn clear(&mut self) {
        let needed = self.events.len();
        self.events.clear();
        if self.events.capacity() > MAX_SPARE_EVENTS.max(8 * needed) {
            self.events.shrink_to(2 * needed);
        }
        self.hits.clear();
        self.counters = StepCounters::default();
    }

    pub(crate) fn push(&mut self, event: Event) {
        self.events.push(event);
    }
}
