//! Secondary maps: data beside the objects of the core, by id (the term of the crate slotmap).

use farseer_core::{BodyId, GeomId};
use serde::{Deserialize, Serialize};

/// An id of the core with its slot.
pub(crate) trait Slot: Copy + PartialEq {
    fn slot(self) -> usize;
}

impl Slot for BodyId {
    fn slot(self) -> usize {
        BodyId::slot(self)
    }
}

impl Slot for GeomId {
    fn slot(self) -> usize {
        GeomId::slot(self)
    }
}

/// Values by id. The entry of a disposed object stays until its slot is used again. A lookup compares ids, so
/// it does not find a stale entry.
#[derive(Debug, Clone, Serialize, Deserialize)]
pub(crate) struct SecondaryMap<I, T> {
    entries: Vec<Option<(I, T)>>,
}

impl<I, T> Default for SecondaryMap<I, T> {
    fn default() -> Self {
        SecondaryMap { entries: Vec::new() }
    }
}

impl<I: Slot, T> SecondaryMap<I, T> {
    pub(crate) fn insert(&mut self, id: I, value: T) {
        if id.slot() >= self.entries.len() {
            self.entries.resize_with(id.slot() + 1, || None);
        }
        self.entries[id.slot()] = Some((id, value));
    }

    pub(crate) fn remove(&mut self, id: I) {
        if self.get(id).is_some() {
            self.entries[id.slot()] = None;
        }
    }

    #[inline]
    pub(crate) fn get(&self, id: I) -> Option<&T> {
        match self.entries.get(id.slot()) {
            Some(Some((owner, value))) if *owner == id => Some(value),
            _ => None,
        }
    }

    #[inline]
    pub(crate) fn get_mut(&mut self, id: I) -> Option<&mut T> {
        match self.entries.get_mut(id.slot()) {
            Some(Some((owner, value))) if *owner == id => Some(value),
            _ => None,
        }
    }

    /// Iterates over all entries in the order of their slots, including entries of disposed objects.
    pub(crate) fn iter(&self) -> impl Iterator<Item = (I, &T)> {
        self.entries.iter().flatten().map(|(id, value)| (*id, value))
    }

    pub(crate) fn iter_mut(&mut self) -> impl Iterator<Item = (I, &mut T)> {
        self.entries.iter_mut().flatten().map(|(id, value)| (*id, value))
    }

    /// Returns whether every entry lies in its id's slot and passes a test: false only for a damaged save.
    pub(crate) fn is_valid(&self, mut test: impl FnMut(I, &T) -> bool) -> bool {
        self.entries.iter().enumerate().all(|(slot, entry)| {
            entry.as_ref().is_none_or(|(id, value)| id.slot() == slot && test(*id, value))
        })
    }
}

impl<I: Slot, T> std::ops::Index<I> for SecondaryMap<I, T> {
    type Output = T;
    fn index(&self, id: I) -> &T {
        self.get(id).expect("the id is stale: what it named was disposed")
    }
}

impl<I: Slot, T> std::ops::IndexMut<I> for SecondaryMap<I, T> {
    fn index_mut(&mut self, id: I) -> &mut T {
        self.get_mut(id).expect("the id is stale: what it named was disposed")
    }
}
