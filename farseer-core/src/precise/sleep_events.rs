//! Adapter: events of bodies that fall asleep and wake.

use crate::body::BodyId;
use crate::objects::Objects;
use crate::report::Event;
use crate::storage::order::sort_by_number;
use farseer_precise::reusing_clone;

/// Sleeping bodies as the last report left them, and the bodies that have woken or fallen asleep since. The cost of a report is
/// linear in the latter; after a rebuild of the lists, in all sleeping bodies.
#[derive(Debug, Default)]
pub(crate) struct SleepEvents {
    /// Ids of all bodies that slept at the last report, by their slots.
    asleep: Vec<Option<BodyId>>,
    /// Bodies that have woken or left the lists since the last report; those that were awake then may be among them.
    woken: Vec<BodyId>,
    /// Bodies that fell asleep in this step, in the order of the simulator's list.
    fallen_asleep: Vec<BodyId>,
    /// Whether the lists were rebuilt since the last report: any body may have woken.
    has_rebuild: bool,
}

reusing_clone! { SleepEvents { asleep, woken, fallen_asleep, has_rebuild } }

impl SleepEvents {
    /// Notes bodies that fall asleep in this step.
    pub(super) fn note_fallen_asleep(&mut self, bodies: impl Iterator<Item = BodyId>) {
        self.fallen_asleep.extend(bodies);
    }

    /// Notes bodies that wake, or sleep and leave the lists.
    pub(super) fn note_woken(&mut self, bodies: impl Iterator<Item = BodyId>) {
        self.woken.extend(bodies);
    }

    /// Notes that the lists are rebuilt, after which other bodies may sleep than before.
    pub(super) fn note_rebuild(&mut self) {
        self.has_rebuild = true;
    }

    /// Adds the events of bodies that have woken or fallen asleep since the last report. `is_asleep` returns whether a body sleeps
    /// now.
    pub(super) fn report(
        &mut self,
        is_asleep: impl Fn(BodyId) -> bool,
        objects: &Objects,
        events: &mut Vec<Event>,
    ) {
        let SleepEvents { asleep, woken, fallen_asleep, has_rebuild } = self;
        if std::mem::take(has_rebuild) {
            woken.extend(asleep.iter().flatten().filter(|&&body| !is_asleep(body)));
        }
        woken.retain(|&body| asleep.get_mut(body.slot()).is_some_and(|place| place.take() == Some(body)));
        let has_event = |&body: &BodyId| {
            let is_listed = objects.bodies.lifecycle_state(body).is_some_and(|life| life.is_listed);
            is_listed && objects.bodies.get(body).is_some_and(|entry| entry.body.has_sleep_events())
        };
        woken.retain(has_event);
        sort_by_number(woken, |&body| objects.bodies.list_key(body).into());
        events.extend(woken.drain(..).map(|body| Event::BodyWoke { body }));
        events.extend(fallen_asleep.iter().copied().filter(has_event).map(|body| Event::BodySlept { body }));
        for body in fallen_asleep.drain(..) {
            list(asleep, body);
        }
    }

    /// Returns the bodies that have woken since the last report, in the order of their slots. `is_asleep` returns whether a body
    /// sleeps now.
    pub(super) fn woken_since_report(&self, is_asleep: impl Fn(BodyId) -> bool) -> Vec<BodyId> {
        self.asleep.iter().flatten().copied().filter(|&body| !is_asleep(body)).collect()
    }

    /// Returns the bodies that have fallen asleep since the last report, in the order in which they are reported.
    pub(super) fn fallen_asleep_since_report(&self) -> &[BodyId] {
        &self.fallen_asleep
    }

    /// Restores the state after a snapshot was loaded: bodies that slept at the last report, and those that have woken or fallen
    /// asleep since.
    pub(super) fn restore(
        &mut self,
        asleep: impl Iterator<Item = BodyId>,
        woken: impl Iterator<Item = BodyId>,
        fallen_asleep: impl Iterator<Item = BodyId>,
    ) {
        *self = SleepEvents::default();
        asleep.for_each(|body| list(&mut self.asleep, body));
        self.woken.extend(woken);
        self.fallen_asleep.extend(fallen_asleep);
    }
}

/// Adds a body to those that sleep.
fn list(asleep: &mut Vec<Option<BodyId>>, body: BodyId) {
    if body.slot() >= asleep.len() {
        asleep.resize(body.slot() + 1, None);
    }
    asleep[body.slot()] = Some(body);
}
