//! Adapter: places in a dense list that bodies or geoms have left, and to which they may return.
//!
//! A body that is disabled or made static leaves the movable bodies, but keeps its place in the order of the simulator. Its index
//! stays empty until the next rebuild. If it becomes movable again before, it returns to that index: all bodies then have the order
//! that a rebuild gives them.

use farseer_precise::index::{DenseIndex, IndexRange, IndexedVec};
use farseer_precise::reusing_clone;

/// Empty places by the objects that have left them. `I`: id of a body or geom; `P`: index of a place.
#[derive(Debug)]
pub(super) struct Vacancies<I, P> {
    /// For each place the object that has left it, with its key in the order of the simulator's list; `None` if no object has, or if
    /// it has returned.
    left: IndexedVec<P, Option<(I, u32)>>,
    /// For each slot of an id the place that the object has left; the first one for a geom of several convex pieces. Valid if `left`
    /// agrees.
    places: Vec<Option<P>>,
}

reusing_clone! { [I: Clone, P: Clone] Vacancies<I, P> { left, places } }

impl<I, P> Default for Vacancies<I, P> {
    fn default() -> Self {
        Vacancies { left: IndexedVec::default(), places: Vec::new() }
    }
}

impl<I: Copy + PartialEq, P: DenseIndex> Vacancies<I, P> {
    /// Forgets all places, because the list is rebuilt.
    pub(super) fn clear(&mut self) {
        self.left.clear();
        self.places.clear();
    }

    /// Notes that the object `id` with this slot and key has left `place`.
    pub(super) fn leave(&mut self, place: P, (id, slot): (I, usize), key: u32) {
        if self.places.len() <= slot {
            self.places.resize(slot + 1, None);
        }
        *self.left.at_or_grow(place) = Some((id, key));
        self.places[slot] = Some(place);
    }

    /// Notes that an object has returned to `place`.
    pub(super) fn fill(&mut self, place: P) {
        if let Some(entry) = self.left.at_mut(place) {
            *entry = None;
        }
    }

    /// Returns the place that the object `id` with this slot and key has left, the first of `count` places; `None` if it has left
    /// none, or not as many.
    pub(super) fn place_of(&self, (id, slot): (I, usize), key: u32, count: usize) -> Option<P> {
        let place = self.places.get(slot).copied().flatten()?;
        let of_object =
            self.left.get(place.position()..)?.iter().take_while(|entry| **entry == Some((id, key))).count();
        (of_object == count).then_some(place)
    }

    /// Returns the key of the object that has left `place`; `None` if none has.
    pub(super) fn key_at(&self, place: P) -> Option<u32> {
        self.left.at(place).copied().flatten().map(|(_, key)| key)
    }
}

/// Returns whether an object with this `key` may stand at `places`: the nearest key before them is less, and the nearest one after
/// them is greater. `key_at` returns the key at a place, and places end before `end`.
pub(super) fn fits_between<P: DenseIndex>(
    places: IndexRange<P>,
    key: u32,
    end: P,
    key_at: impl Fn(P) -> Option<u32>,
) -> bool {
    let before = IndexRange { start: P::new(0), end: places.start }.rev().find_map(&key_at);
    let after = IndexRange { start: places.end, end }.find_map(&key_at);
    before.is_none_or(|before| before < key) && after.is_none_or(|after| key < after)
}
