//! Objects of one kind, the list of those that take part, and what waits to enter or leave it (behaviour chapter 04,
//! section 2).

use serde::{Deserialize, Serialize};

use crate::arena::{Arena, Id};
use crate::{Error, Result};

/// An object and where it stands.
#[derive(Debug, Clone, Serialize, Deserialize)]
pub(crate) struct Entry<T> {
    pub(crate) value: T,
    pub(crate) is_listed: bool,
    is_queued: bool,
    pub(crate) is_disposed: bool,
}

/// Objects of one kind that enter and leave their list with updates.
#[derive(Debug, Clone, Serialize, Deserialize)]
pub(crate) struct Collection<T, I> {
    entries: Arena<Entry<T>>,
    list: Vec<I>,
    added: Vec<I>,
    removed: Vec<I>,
    /// Their ids go stale with the next update.
    disposed: Vec<I>,
}

impl<T, I> Default for Collection<T, I> {
    fn default() -> Self {
        Collection {
            entries: Arena::default(),
            list: Vec::new(),
            added: Vec::new(),
            removed: Vec::new(),
            disposed: Vec::new(),
        }
    }
}

impl<T, I: Id + Ord> Collection<T, I> {
    pub(crate) fn create(&mut self, value: T) -> I {
        self.entries.insert(Entry { value, is_listed: false, is_queued: false, is_disposed: false })
    }

    /// Takes back what was made last, before it was added: nobody may know its id.
    pub(crate) fn discard(&mut self, id: I) {
        self.entries.take_back(id);
    }

    #[inline]
    pub(crate) fn get(&self, id: I) -> Option<&T> {
        self.entries.get(id).map(|entry| &entry.value)
    }

    #[inline]
    pub(crate) fn get_mut(&mut self, id: I) -> Option<&mut T> {
        self.entries.get_mut(id).map(|entry| &mut entry.value)
    }

    /// As [`get`](Self::get), but an error for a stale id, which names the argument.
    pub(crate) fn find(&self, argument: &'static str, id: I) -> Result<&T> {
        self.get(id).ok_or(Error::StaleId { argument })
    }

    /// As [`get_mut`](Self::get_mut), but an error for a stale id, which names the argument.
    pub(crate) fn find_mut(&mut self, argument: &'static str, id: I) -> Result<&mut T> {
        self.get_mut(id).ok_or(Error::StaleId { argument })
    }

    pub(crate) fn iter(&self) -> impl Iterator<Item = (I, &T)> {
        self.entries.iter().map(|(id, entry)| (id, &entry.value))
    }

    /// Those that take part, in the order in which they were added.
    pub(crate) fn list(&self) -> &[I] {
        &self.list
    }

    pub(crate) fn is_listed(&self, id: I) -> bool {
        self.entries.get(id).is_some_and(|entry| entry.is_listed)
    }

    /// Those that take part or will from the next update on.
    pub(crate) fn listed_or_queued(&self) -> impl Iterator<Item = &T> {
        let entries = self.entries.iter::<I>().map(|(_, entry)| entry);
        entries.filter(|entry| entry.is_listed || entry.is_queued).map(|entry| &entry.value)
    }

    /// True for a stale id, too.
    pub(crate) fn is_disposed(&self, id: I) -> bool {
        self.entries.get(id).is_none_or(|entry| entry.is_disposed)
    }

    /// The object at a position of the list, unless it was disposed.
    #[inline]
    pub(crate) fn at(&self, position: usize) -> Option<(I, &T)> {
        let id = *self.list.get(position)?;
        let entry = self.entries.get(id).filter(|entry| !entry.is_disposed)?;
        Some((id, &entry.value))
    }

    /// As [`at`](Self::at), to change.
    #[inline]
    pub(crate) fn at_mut(&mut self, position: usize) -> Option<(I, &mut T)> {
        let id = *self.list.get(position)?;
        let entry = self.entries.get_mut(id).filter(|entry| !entry.is_disposed)?;
        Some((id, &mut entry.value))
    }
}

/// Entering and leaving.
impl<T, I: Id + Ord> Collection<T, I> {
    pub(crate) fn add(&mut self, argument: &'static str, id: I) -> Result<()> {
        let entry = self.entries.get_mut(id).ok_or(Error::StaleId { argument })?;
        if !std::mem::replace(&mut entry.is_queued, true) {
            self.added.push(id);
        }
        Ok(())
    }

    pub(crate) fn remove(&mut self, argument: &'static str, id: I) -> Result<()> {
        self.entries.get(id).ok_or(Error::StaleId { argument })?;
        self.removed.push(id);
        Ok(())
    }

    pub(crate) fn dispose(&mut self, argument: &'static str, id: I) -> Result<()> {
        let entry = self.entries.get_mut(id).ok_or(Error::StaleId { argument })?;
        if !std::mem::replace(&mut entry.is_disposed, true) {
            self.disposed.push(id);
        }
        Ok(())
    }

    /// Whether [`process_added`](Self::process_added) has something to do.
    pub(crate) fn has_added(&self) -> bool {
        !self.added.is_empty()
    }

    /// What was added enters the list; answers which.
    pub(crate) fn process_added(&mut self) -> Vec<I> {
        let mut entered = std::mem::take(&mut self.added);
        entered.retain(|&id| {
            let Some(entry) = self.entries.get_mut(id) else { return false };
            entry.is_queued = false;
            !std::mem::replace(&mut entry.is_listed, true)
        });
        self.list.extend_from_slice(&entered);
        entered
    }

    /// What was removed leaves the list. Answers what was to be removed, also what was not in the list.
    pub(crate) fn process_removed(&mut self) -> Vec<I> {
        let mut left = std::mem::take(&mut self.removed);
        left.retain(|&id| {
            let Some(entry) = self.entries.get_mut(id) else { return false };
            entry.is_listed = false;
            true
        });
        if !left.is_empty() {
            self.list.retain(|&id| self.entries[id].is_listed);
        }
        left
    }

    /// What was disposed leaves the list, in list order; answers which.
    pub(crate) fn process_disposed(&mut self) -> Vec<I> {
        let mut left = Vec::new();
        if !self.disposed.is_empty() {
            let entries = &self.entries;
            self.list.retain(|&id| {
                let stays = !entries[id].is_disposed;
                left.extend((!stays).then_some(id));
                stays
            });
        }
        left
    }

    /// The ids of what was disposed go stale. No list names them any more.
    pub(crate) fn free_disposed(&mut self) {
        for id in std::mem::take(&mut self.disposed) {
            self.entries.remove(id);
        }
    }

    /// Everything is gone, and all ids are stale.
    pub(crate) fn clear(&mut self) {
        self.entries.clear::<I>();
        for list in [&mut self.list, &mut self.added, &mut self.removed, &mut self.disposed] {
            list.clear();
        }
    }

    /// Whether lists and flags agree: false only after loading garbage.
    pub(crate) fn is_consistent(&self) -> bool {
        let count =
            |flag: fn(&Entry<T>) -> bool| self.entries.iter::<I>().filter(|(_, entry)| flag(entry)).count();
        let all = |list: &[I], flag: fn(&Entry<T>) -> bool| {
            list.iter().all(|&id| self.entries.get(id).is_some_and(flag))
        };
        self.entries.is_consistent()
            && has_no_duplicates(&self.list)
            && has_no_duplicates(&self.disposed)
            && self.queue_is_consistent()
            && self.list.len() == count(|entry| entry.is_listed)
            && self.disposed.len() == count(|entry| entry.is_disposed)
            && all(&self.list, |entry| entry.is_listed)
            && all(&self.disposed, |entry| entry.is_disposed)
    }

    /// Whether those that wait to enter are those that are marked so. The queue may also name what is gone.
    fn queue_is_consistent(&self) -> bool {
        let waiting: Vec<I> =
            self.added.iter().copied().filter(|&id| self.entries.get(id).is_some()).collect();
        let marked = self.entries.iter::<I>().filter(|(_, entry)| entry.is_queued).count();
        has_no_duplicates(&waiting)
            && waiting.iter().all(|&id| self.entries.get(id).is_some_and(|entry| entry.is_queued))
            && waiting.len() == marked
    }
}

pub(crate) fn has_no_duplicates<T: Ord + Copy>(list: &[T]) -> bool {
    let mut sorted = list.to_vec();
    sorted.sort_unstable();
    sorted.windows(2).all(|pair| pair[0] != pair[1])
}

impl<T, I: Id> std::ops::Index<I> for Collection<T, I> {
    type Output = T;
    #[inline]
    fn index(&self, id: I) -> &T {
        &self.entries[id].value
    }
}

impl<T, I: Id> std::ops::IndexMut<I> for Collection<T, I> {
    #[inline]
    fn index_mut(&mut self, id: I) -> &mut T {
        &mut self.entries[id].value
    }
}
