//! Objects of one kind, the list of those that take part, and the queues of those that will enter or leave it
//! (behaviour chapter 04, section 2).

use serde::{Deserialize, Serialize};

use crate::storage::arena::{Arena, Id};
use crate::storage::order::sort_numbered;
use crate::{Error, Result};
use farseer_precise::fingerprint::Fingerprint;
use farseer_precise::reusing_clone;

/// Number of list entries for each leaving object from which on the object is found by its key, instead of by a walk over the
/// list. Value chosen; a search costs about as much as a walk over this many entries.
const LIST_LENGTH_PER_SEARCH: usize = 16;

/// Position of an object in its lifecycle.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Serialize, Deserialize)]
pub(crate) struct LifecycleState {
    /// Whether it takes part.
    pub(crate) is_listed: bool,
    /// Whether it waits to enter the list.
    is_queued: bool,
    /// Whether its id goes stale with the next update.
    pub(crate) is_disposed: bool,
}

/// An object with its lifecycle state.
#[derive(Debug, Serialize, Deserialize)]
struct CollectionEntry<T> {
    value: T,
    life: LifecycleState,
}

reusing_clone! { [T: Clone] CollectionEntry<T> { value, life } }

/// Objects of one kind that enter and leave their list with updates.
#[derive(Debug, Serialize, Deserialize)]
#[serde(from = "SavedCollection<T, I>", bound(deserialize = "T: Deserialize<'de>, I: Id + Deserialize<'de>"))]
pub(crate) struct Collection<T, I> {
    entries: Arena<CollectionEntry<T>, I>,
    list: Vec<I>,
    added: Vec<I>,
    removed: Vec<I>,
    /// Disposed objects: their ids go stale with the next update.
    disposed: Vec<I>,
    /// For each listed object, by its slot, a number that increases along the list. It stays while the object is listed.
    #[serde(skip)]
    list_keys: Vec<u32>,
    /// Smallest number that exceeds the `list_keys` of all listed objects.
    #[serde(skip)]
    next_list_key: u32,
}

reusing_clone! {
    [T: Clone, I: Clone] Collection<T, I> { entries, list, added, removed, disposed, list_keys, next_list_key }
}

/// Saved form of a [`Collection`].
#[derive(Deserialize)]
#[serde(bound(deserialize = "T: Deserialize<'de>, I: Deserialize<'de>"))]
struct SavedCollection<T, I> {
    entries: Arena<CollectionEntry<T>, I>,
    list: Vec<I>,
    added: Vec<I>,
    removed: Vec<I>,
    disposed: Vec<I>,
}

impl<T, I: Id> From<SavedCollection<T, I>> for Collection<T, I> {
    fn from(saved: SavedCollection<T, I>) -> Self {
        let SavedCollection { entries, list, added, removed, disposed } = saved;
        let mut loaded =
            Collection { entries, list, added, removed, disposed, list_keys: Vec::new(), next_list_key: 0 };
        loaded.renumber_list();
        loaded
    }
}

impl<T, I> Default for Collection<T, I> {
    fn default() -> Self {
        Collection {
            entries: Arena::default(),
            list: Vec::new(),
            added: Vec::new(),
            removed: Vec::new(),
            disposed: Vec::new(),
            list_keys: Vec::new(),
            next_list_key: 0,
        }
    }
}

/// Positions in the list.
impl<T, I: Id> Collection<T, I> {
    /// Gives the listed objects the keys 0, 1, ... along the list.
    fn renumber_list(&mut self) {
        // A slot beyond the end is damaged data, which `is_consistent` refuses.
        self.list_keys.resize(self.entries.slot_count(), 0);
        self.next_list_key = 0;
        for id in &self.list {
            if let Some(key) = self.list_keys.get_mut(id.index()) {
                *key = self.next_list_key;
            }
            self.next_list_key += 1;
        }
    }

    /// Returns a number of a listed object by which objects are sorted as in the list.
    #[inline]
    pub(crate) fn list_key(&self, id: I) -> u32 {
        self.list_keys.get(id.index()).copied().unwrap_or(u32::MAX)
    }

    /// Returns the position of an object in the list; `None` if it is not listed.
    fn position(&self, id: I) -> Option<usize> {
        let at = self.list.binary_search_by_key(&self.list_key(id), |&other| self.list_key(other)).ok()?;
        (self.list[at].rank() == id.rank()).then_some(at)
    }

    /// Renumbers the list if there are no numbers left for objects that wait to enter. Returns whether it did.
    pub(crate) fn renumber_if_exhausted(&mut self) -> bool {
        let left = usize::try_from(u32::MAX - self.next_list_key).unwrap_or(usize::MAX);
        let is_exhausted = left <= self.added.len();
        if is_exhausted {
            self.renumber_list();
        }
        is_exhausted
    }
}

impl<T, I: Id + Ord> Collection<T, I> {
    pub(crate) fn create(&mut self, value: T) -> I {
        self.entries.insert(CollectionEntry { value, life: LifecycleState::default() })
    }

    /// Removes the object that was created last, before it was added; its id must be unknown to others.
    pub(crate) fn discard(&mut self, id: I) -> Option<T> {
        self.entries.undo_insert(id).map(|entry| entry.value)
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

    #[inline]
    pub(crate) fn contains(&self, id: I) -> bool {
        self.entries.contains(id)
    }

    /// All existing objects, in the list or not, in the order of their slots.
    pub(crate) fn iter(&self) -> impl Iterator<Item = (I, &T)> {
        self.entries.iter().map(|(id, entry)| (id, &entry.value))
    }

    /// Number of slots, used or not: greater than every index.
    pub(crate) fn slot_count(&self) -> usize {
        self.entries.slot_count()
    }

    /// Lifecycle state of an object, unless the id is stale.
    #[inline]
    pub(crate) fn lifecycle_state(&self, id: I) -> Option<LifecycleState> {
        self.entries.get(id).map(|entry| entry.life)
    }

    /// The objects that take part, in the order in which they were added.
    pub(crate) fn list(&self) -> &[I] {
        &self.list
    }

    /// The objects that take part, or will from the next update on.
    pub(crate) fn listed_or_queued(&self) -> impl Iterator<Item = &T> {
        let entries = self.entries.iter().map(|(_, entry)| entry);
        entries.filter(|entry| entry.life.is_listed || entry.life.is_queued).map(|entry| &entry.value)
    }

    /// Whether an object is disposed; true also for a stale id.
    pub(crate) fn is_disposed(&self, id: I) -> bool {
        self.entries.get(id).is_none_or(|entry| entry.life.is_disposed)
    }

    /// The object at a position of the list, unless it was disposed.
    #[inline]
    pub(crate) fn at(&self, position: usize) -> Option<(I, &T)> {
        let id = *self.list.get(position)?;
        let entry = self.entries.get(id).filter(|entry| !entry.life.is_disposed)?;
        Some((id, &entry.value))
    }

    /// Disposed objects that still exist, in the order in which they were disposed.
    pub(crate) fn disposed(&self) -> &[I] {
        &self.disposed
    }

    /// As [`at`](Self::at), to change.
    #[inline]
    pub(crate) fn at_mut(&mut self, position: usize) -> Option<(I, &mut T)> {
        let id = *self.list.get(position)?;
        let entry = self.entries.get_mut(id).filter(|entry| !entry.life.is_disposed)?;
        Some((id, &mut entry.value))
    }
}

/// Entering and leaving the list.
impl<T, I: Id + Ord> Collection<T, I> {
    pub(crate) fn add(&mut self, argument: &'static str, id: I) -> Result<()> {
        let entry = self.entries.get_mut(id).ok_or(Error::StaleId { argument })?;
        if !std::mem::replace(&mut entry.life.is_queued, true) {
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
        if !std::mem::replace(&mut entry.life.is_disposed, true) {
            self.disposed.push(id);
        }
        Ok(())
    }

    /// Lets disposed objects that still exist be found in the list again, or hides them.
    #[cfg(feature = "precise")]
    pub(crate) fn set_disposed_visible(&mut self, are_shown: bool) {
        for &id in &self.disposed {
            if let Some(entry) = self.entries.get_mut(id) {
                entry.life.is_disposed = !are_shown;
            }
        }
    }

    /// Disposes the listed objects for which the predicate is true.
    pub(crate) fn dispose_listed_where(&mut self, is_leaving: impl Fn(&T) -> bool) {
        for &id in &self.list {
            let Some(entry) = self.entries.get_mut(id) else { continue };
            if !entry.life.is_disposed && is_leaving(&entry.value) {
                entry.life.is_disposed = true;
                self.disposed.push(id);
            }
        }
    }

    /// Whether [`process_added`](Self::process_added) has objects to add.
    pub(crate) fn has_added(&self) -> bool {
        !self.added.is_empty()
    }

    /// Whether objects are waiting to enter or leave.
    #[inline]
    pub(crate) fn has_queued(&self) -> bool {
        !(self.added.is_empty() && self.removed.is_empty() && self.disposed.is_empty())
    }

    /// Moves added objects into the list; returns them.
    pub(crate) fn process_added(&mut self) -> Vec<I> {
        let mut entered = std::mem::take(&mut self.added);
        entered.retain(|&id| {
            let Some(entry) = self.entries.get_mut(id) else { return false };
            entry.life.is_queued = false;
            !std::mem::replace(&mut entry.life.is_listed, true)
        });
        for &id in &entered {
            if self.list_keys.len() <= id.index() {
                self.list_keys.resize(self.entries.slot_count(), 0);
            }
            self.list_keys[id.index()] = self.next_list_key;
            self.next_list_key += 1;
        }
        self.list.extend_from_slice(&entered);
        entered
    }

    /// Moves removed objects out of the list. Returns all that were to be removed, also those that were not in the
    /// list.
    pub(crate) fn process_removed(&mut self) -> Vec<I> {
        let mut left = std::mem::take(&mut self.removed);
        left.retain(|&id| {
            let Some(entry) = self.entries.get_mut(id) else { return false };
            entry.life.is_listed = false;
            true
        });
        self.drop_from_list(&left, |life| !life.is_listed);
        left
    }

    /// Moves disposed objects out of the list, in list order; returns them.
    pub(crate) fn process_disposed(&mut self) -> Vec<I> {
        let disposed = std::mem::take(&mut self.disposed);
        let left = self.drop_from_list(&disposed, |life| life.is_disposed);
        self.disposed = disposed;
        left
    }

    /// Drops the `leaving` objects from the list, for which `is_leaving` is true and for no other object of the list. Returns
    /// those that were listed, in list order.
    ///
    /// A few objects are found by their keys, so that the cost does not grow with the other objects, but for moving the end of
    /// the list.
    fn drop_from_list(&mut self, leaving: &[I], is_leaving: impl Fn(&LifecycleState) -> bool) -> Vec<I> {
        let mut left = Vec::new();
        if leaving.len() > self.list.len() / LIST_LENGTH_PER_SEARCH {
            let entries = &self.entries;
            self.list.retain(|&id| {
                let stays = !is_leaving(&entries[id].life);
                left.extend((!stays).then_some(id));
                stays
            });
            return left;
        }
        let mut positions: Vec<usize> = leaving.iter().filter_map(|&id| self.position(id)).collect();
        positions.sort_unstable();
        positions.dedup();
        left.extend(positions.iter().map(|&at| self.list[at]));
        let mut end = positions.first().copied().unwrap_or(self.list.len());
        let nexts = positions.iter().copied().skip(1).chain([self.list.len()]);
        for (&at, next) in positions.iter().zip(nexts) {
            self.list.copy_within(at + 1..next, end);
            end += next - at - 1;
        }
        self.list.truncate(end);
        left
    }

    /// Frees disposed objects and makes their ids stale. No list contains them any more. Returns the objects.
    pub(crate) fn free_disposed(&mut self) -> Vec<T> {
        let disposed = std::mem::take(&mut self.disposed);
        disposed.into_iter().filter_map(|id| self.entries.remove(id)).map(|entry| entry.value).collect()
    }

    /// Removes all objects; all ids go stale.
    pub(crate) fn clear(&mut self) {
        self.entries.clear();
        for list in [&mut self.list, &mut self.added, &mut self.removed, &mut self.disposed] {
            list.clear();
        }
        self.list_keys.clear();
        self.next_list_key = 0;
    }

    /// Whether lists and flags agree. False only after loading corrupt data.
    pub(crate) fn is_consistent(&self) -> bool {
        // The queue may contain stale ids.
        let is_there = |id: &I| self.entries.get(*id).is_some();
        let waiting: Vec<I> = self.added.iter().copied().filter(is_there).collect();
        self.entries.is_consistent()
            && self.is_exactly_marked(&self.list, |life| life.is_listed)
            && self.is_exactly_marked(&self.disposed, |life| life.is_disposed)
            && self.is_exactly_marked(&waiting, |life| life.is_queued)
    }

    /// Whether the list contains exactly the objects with a flag, each once.
    #[inline(never)]
    fn is_exactly_marked(&self, list: &[I], mark: fn(&LifecycleState) -> bool) -> bool {
        let is_marked = |&id: &I| self.entries.get(id).is_some_and(|entry| mark(&entry.life));
        let marked = self.entries.iter().filter(|(_, entry)| mark(&entry.life)).count();
        list.len() == marked && list.iter().all(is_marked) && has_no_duplicates(list)
    }
}

impl<T, I: Id + Ord> Collection<T, I> {
    /// Returns a hash of the ids and lifecycles of all objects and of the lists that name them: SplitMix64 of each number.
    pub(crate) fn membership_hash(&self) -> u64 {
        let lives = self.entries.iter().map(|(id, CollectionEntry { life, .. })| {
            let LifecycleState { is_listed, is_queued, is_disposed } = *life;
            (id, 1 + u32::from(is_listed) + 2 * u32::from(is_queued) + 4 * u32::from(is_disposed))
        });
        let mut hash = Fingerprint::default();
        let lists = [&self.list, &self.added, &self.removed, &self.disposed];
        let listed = (8..).zip(lists).flat_map(|(kind, list)| list.iter().map(move |&id| (id, kind)));
        for (id, kind) in lives.chain(listed) {
            [kind, id.index() as u32, id.generation()].iter().for_each(|&word| hash.add_word(word));
        }
        hash.bits()
    }

    /// Calls a function with each existing object, in the order of the slots, and its value. Returns whether there was one value
    /// for each object.
    pub(crate) fn give_each<V>(&mut self, values: Vec<V>, mut give: impl FnMut(&mut T, V)) -> bool {
        let mut values = values.into_iter();
        let all = self.entries.values_mut().all(|entry| match values.next() {
            Some(value) => {
                give(&mut entry.value, value);
                true
            }
            None => false,
        });
        all && values.next().is_none()
    }
}

pub(crate) fn has_no_duplicates<I: Id>(list: &[I]) -> bool {
    let mut ranks: Vec<(u128, u32)> = list.iter().map(|id| (id.rank(), 0)).collect();
    sort_numbered(&mut ranks);
    ranks.windows(2).all(|pair| pair[0] != pair[1])
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
