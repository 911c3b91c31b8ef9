//! Saved form of typed events that the next update reports: edits and rebuilds have found them since the last report.

use serde::{Deserialize, Serialize};

use crate::body::BodyId;
use crate::geom::GeomId;
use crate::precise::changed_kinds::{ChangedKind, ChangedKinds};
use crate::precise::sleep_events::SleepEvents;
use farseer_precise::narrow_phase::TouchKind;

/// Typed events that the next update reports.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize)]
pub(super) struct SavedPendingEvents {
    /// Touching pairs whose typed event has another kind, in the order of creation numbers.
    changed_kinds: Vec<SavedChangedKind>,
    /// Bodies that have woken since the last report, in the order of their slots.
    woken: Vec<BodyId>,
    /// Bodies that have fallen asleep since the last report, in the order in which they are reported.
    fallen_asleep: Vec<BodyId>,
}

/// Saved form of a [`ChangedKind`].
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
struct SavedChangedKind {
    /// Creation numbers of both geoms, the smaller one first.
    numbers: [u32; 2],
    /// The geoms, in the same order.
    geoms: (GeomId, GeomId),
    /// [Numbers](TouchKind::code) of the kind with which the touch began, and of that with which it lasts.
    kinds: [u8; 2],
}

impl SavedPendingEvents {
    /// Returns the saved form of the events that the next update reports. `is_asleep` returns whether a body sleeps now.
    pub(super) fn of(
        changed_kinds: &ChangedKinds,
        sleep_events: &SleepEvents,
        is_asleep: impl Fn(BodyId) -> bool,
    ) -> Self {
        let changed_kinds = changed_kinds.ordered().into_iter().map(|change| {
            let ChangedKind { numbers, geoms, before, after } = change;
            SavedChangedKind { numbers, geoms, kinds: [before.code(), after.code()] }
        });
        SavedPendingEvents {
            changed_kinds: changed_kinds.collect(),
            woken: sleep_events.woken_since_report(is_asleep),
            fallen_asleep: sleep_events.fallen_asleep_since_report().to_vec(),
        }
    }

    /// Returns the touching pairs whose typed event has another kind.
    pub(super) fn changed_kinds(&self) -> ChangedKinds {
        let changes = self.changed_kinds.iter().map(|change| {
            let [before, after] = change.kinds.map(TouchKind::of_code);
            ChangedKind { numbers: change.numbers, geoms: change.geoms, before, after }
        });
        ChangedKinds::of(changes.collect())
    }

    /// Returns the bodies that slept at the last report, given those that sleep now.
    pub(super) fn asleep_at_report<'a>(
        &'a self,
        sleeping: impl Iterator<Item = BodyId> + 'a,
    ) -> impl Iterator<Item = BodyId> + 'a {
        sleeping.filter(|body| !self.fallen_asleep.contains(body)).chain(self.woken.iter().copied())
    }

    /// Returns the bodies that have woken, and those that have fallen asleep, since the last report.
    pub(super) fn sleep_changes(&self) -> [&[BodyId]; 2] {
        [&self.woken, &self.fallen_asleep]
    }
}
