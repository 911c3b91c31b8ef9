//! Adapter: touching pairs whose typed event has another kind since an edit, for example because a geom was made a sensor.

use crate::geom::GeomId;
use crate::storage::order::{packed_key, sort_by_number};
use farseer_precise::narrow_phase::TouchKind;
use farseer_precise::reusing_clone;

/// Touching pairs whose typed event has another kind since an edit. The next update reports the end of the former kind, and the
/// begin of the new one.
#[derive(Debug, Default)]
pub(crate) struct ChangedKinds {
    changes: Vec<ChangedKind>,
}

reusing_clone! { ChangedKinds { changes } }

/// A touching pair of geoms with another kind of typed event.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) struct ChangedKind {
    /// Creation numbers of both geoms, the smaller one first.
    pub(super) numbers: [u32; 2],
    /// The geoms, in the same order.
    pub(crate) geoms: (GeomId, GeomId),
    /// The kind with which the touch began.
    pub(crate) before: TouchKind,
    /// The kind with which it lasts.
    pub(crate) after: TouchKind,
}

impl ChangedKinds {
    /// Returns the list of these pairs.
    pub(super) fn of(changes: Vec<ChangedKind>) -> Self {
        ChangedKinds { changes }
    }

    /// Adds a pair of geoms, each given by creation number and id. A pair counts once, whatever the number of its convex pieces.
    pub(super) fn note(&mut self, sides: [(u32, GeomId); 2], before: TouchKind, after: TouchKind) {
        let [(number, geom), (other_number, other)] = sides;
        let (numbers, geoms) = match number < other_number {
            true => ([number, other_number], (geom, other)),
            false => ([other_number, number], (other, geom)),
        };
        self.changes.push(ChangedKind { numbers, geoms, before, after });
    }

    /// Returns whether there is no such pair.
    pub(super) fn is_empty(&self) -> bool {
        self.changes.is_empty()
    }

    /// Removes and returns all pairs, in the order of creation numbers.
    pub(crate) fn drain(&mut self) -> Vec<ChangedKind> {
        let changes = self.ordered();
        self.changes.clear();
        changes
    }

    /// Returns all pairs, in the order of creation numbers.
    pub(super) fn ordered(&self) -> Vec<ChangedKind> {
        let mut changes = self.changes.clone();
        sort_by_number(&mut changes, |change| packed_key([change.numbers[0], change.numbers[1], 0, 0]));
        changes.dedup();
        changes
    }
}
