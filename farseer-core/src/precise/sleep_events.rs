//! Adapter: events of bodies that fall asleep and wake.

use super::ids::IdTable;
use crate::body::BodyId;
use crate::objects::Objects;
use crate::report::Event;
use crate::storage::order::sort_by_number;
use farseer_precise::island::sleep::SleepState;
use farseer_precise::reusing_clone;

/// Sleeping bodies with [events](crate::Body::has_sleep_events), and the events of this step.
#[derive(Debug, Default)]
pub(crate) struct SleepEvents {
    /// Bodies with events that sleep, in the order in which they fell asleep.
    sleeping: Vec<BodyId>,
    /// Bodies with events that fell asleep in this step, in the order of the simulator's list.
    fallen_asleep: Vec<BodyId>,
    /// Number of all bodies that fell asleep in this step.
    fallen_count: usize,
    /// Number of all sleeping bodies after the last step.
    asleep_count: usize,
}

reusing_clone! { SleepEvents { sleeping, fallen_asleep, fallen_count, asleep_count } }

impl SleepEvents {
    /// Notes the bodies that fall asleep in this step: those in `falling_asleep`.
    pub(super) fn note_falling_asleep(&mut self, sleep: &SleepState, ids: &IdTable, objects: &Objects) {
        self.fallen_count = sleep.falling_asleep.len();
        let fallen = sleep.falling_asleep.iter().filter_map(|&body| ids.bodies[body]);
        self.fallen_asleep.extend(fallen.filter(|&id| has_events(id, objects)));
    }

    /// Adds the events of bodies that have woken or fallen asleep since the last step.
    pub(super) fn report(
        &mut self,
        sleep: &SleepState,
        ids: &IdTable,
        objects: &Objects,
        events: &mut Vec<Event>,
    ) {
        let fallen_count = std::mem::take(&mut self.fallen_count);
        // Each body that wakes or goes lowers the number of those that sleep.
        let has_woken = self.asleep_count + fallen_count != sleep.count;
        self.asleep_count = sleep.count;
        if has_woken {
            let is_asleep = |body| ids.body_index(body).is_some_and(|index| sleep.is_asleep(index));
            self.report_woken(is_asleep, objects, events);
        }
        events.extend(self.fallen_asleep.iter().map(|&body| Event::BodySlept { body }));
        self.sleeping.append(&mut self.fallen_asleep);
    }

    fn report_woken(
        &mut self,
        is_asleep: impl Fn(BodyId) -> bool,
        objects: &Objects,
        events: &mut Vec<Event>,
    ) {
        let SleepEvents { sleeping, fallen_asleep, .. } = self;
        let mut woken = Vec::new();
        sleeping.retain(|&body| {
            // A body may wake and fall asleep again within a step.
            let sleeps = is_asleep(body) && !fallen_asleep.contains(&body);
            woken.extend((!sleeps).then_some(body));
            sleeps
        });
        let is_listed =
            |&body: &BodyId| objects.bodies.lifecycle_state(body).is_some_and(|life| life.is_listed);
        woken.retain(is_listed);
        sort_by_number(&mut woken, |&body| objects.bodies.list_key(body).into());
        events.extend(woken.into_iter().map(|body| Event::BodyWoke { body }));
    }

    /// Lists the sleeping bodies with events, after a snapshot was loaded. `asleep`: all bodies that slept after the last update.
    pub(super) fn list_sleeping(&mut self, asleep: &[BodyId], objects: &Objects) {
        self.sleeping = asleep.iter().copied().filter(|&id| has_events(id, objects)).collect();
        self.asleep_count = asleep.len();
    }
}

fn has_events(id: BodyId, objects: &Objects) -> bool {
    objects.bodies.get(id).is_some_and(|entry| entry.body.has_sleep_events())
}
