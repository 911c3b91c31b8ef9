//! A dictionary that enumerates in the order of .NET's `Dictionary`, as the original's do (behaviour chapter 08,
//! section 1.6).

use std::collections::BTreeMap;

use serde::{Deserialize, Serialize};

/// A key of the dictionary.
pub(super) trait DictionaryKey: Copy {
    /// The key as a unique number, by which all dictionaries are indexed.
    fn to_u64(self) -> u64;
}

impl DictionaryKey for (u32, u32) {
    fn to_u64(self) -> u64 {
        (u64::from(self.0) << 32) | u64::from(self.1)
    }
}

impl DictionaryKey for (i32, i32) {
    fn to_u64(self) -> u64 {
        (self.0 as u32, self.1 as u32).to_u64()
    }
}

/// Keys with values in slots. A new key takes the slot freed last; enumeration goes by ascending slot.
#[derive(Debug, Clone, Serialize, Deserialize)]
#[serde(bound(deserialize = "K: Deserialize<'de>, V: Deserialize<'de>"))]
#[serde(from = "SavedDictionary<K, V>")]
pub(super) struct DotnetDictionary<K: DictionaryKey, V> {
    slots: Vec<Option<(K, V)>>,
    free: Vec<u32>,
    #[serde(skip_serializing)]
    index: BTreeMap<u64, u32>,
}

/// The saved form: the index is derived from the slots.
#[derive(Deserialize)]
struct SavedDictionary<K, V> {
    slots: Vec<Option<(K, V)>>,
    free: Vec<u32>,
}

impl<K: DictionaryKey, V> From<SavedDictionary<K, V>> for DotnetDictionary<K, V> {
    fn from(saved: SavedDictionary<K, V>) -> Self {
        let mut index = BTreeMap::new();
        for (slot, (key, _)) in
            saved.slots.iter().enumerate().filter_map(|(slot, entry)| Some((slot, entry.as_ref()?)))
        {
            index.insert(key.to_u64(), slot as u32);
        }
        DotnetDictionary { slots: saved.slots, free: saved.free, index }
    }
}

impl<K: DictionaryKey, V> Default for DotnetDictionary<K, V> {
    fn default() -> Self {
        DotnetDictionary { slots: Vec::new(), free: Vec::new(), index: BTreeMap::new() }
    }
}

impl<K: DictionaryKey, V> DotnetDictionary<K, V> {
    /// The value of a key. `value` makes it if the key is new.
    pub(super) fn get_or_insert_with(&mut self, key: K, value: impl FnOnce() -> V) -> &mut V {
        let slot = match self.index.get(&key.to_u64()) {
            Some(&slot) => slot as usize,
            None => self.insert_new(key, value()),
        };
        &mut self.slots[slot].as_mut().expect("the index names occupied slots").1
    }

    fn insert_new(&mut self, key: K, value: V) -> usize {
        let slot = match self.free.pop() {
            Some(slot) => slot as usize,
            None => {
                self.slots.push(None);
                self.slots.len() - 1
            }
        };
        self.slots[slot] = Some((key, value));
        self.index.insert(key.to_u64(), slot as u32);
        slot
    }

    pub(super) fn remove(&mut self, key: K) {
        if let Some(slot) = self.index.remove(&key.to_u64()) {
            self.slots[slot as usize] = None;
            self.free.push(slot);
        }
    }

    pub(super) fn clear(&mut self) {
        self.slots.clear();
        self.free.clear();
        self.index.clear();
    }

    pub(super) fn slot_count(&self) -> usize {
        self.slots.len()
    }

    /// The entry of a slot, for enumeration by ascending slot.
    pub(super) fn slot(&self, slot: usize) -> Option<&(K, V)> {
        self.slots[slot].as_ref()
    }

    pub(super) fn slot_mut(&mut self, slot: usize) -> Option<&mut (K, V)> {
        self.slots[slot].as_mut()
    }

    /// Whether keys are unique and the free list names empty slots, once each.
    pub(super) fn is_consistent(&self) -> bool {
        let occupied = self.slots.iter().flatten().count();
        let mut seen = vec![false; self.slots.len()];
        let free_is_empty = self.free.iter().all(|&slot| {
            let slot = slot as usize;
            slot < seen.len() && self.slots[slot].is_none() && !std::mem::replace(&mut seen[slot], true)
        });
        occupied == self.index.len() && free_is_empty
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn freed_slots_are_reused_last_freed_first() {
        let mut table = DotnetDictionary::default();
        let [a, b, c, d, e] = [(-1, 0), (0, -1), (-1, -1), (0, 0), (1, 0)];
        for key in [a, b, c] {
            table.get_or_insert_with(key, || ());
        }
        table.remove(a);
        table.remove(c);
        table.get_or_insert_with(d, || ());
        table.get_or_insert_with(e, || ());
        let order: Vec<(i32, i32)> =
            (0..table.slot_count()).filter_map(|slot| table.slot(slot)).map(|entry| entry.0).collect();
        assert_eq!(order, [e, b, d]);
    }
}
