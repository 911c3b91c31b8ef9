//! The keys of a curve (behaviour chapter 14, section 3).

use serde::{Deserialize, Serialize};

use super::CurveKey;
use crate::{Error, Result};

/// A list of [keys](CurveKey) that [`add`](Self::add) keeps in the order of their positions.
#[derive(Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct CurveKeyCollection {
    keys: Vec<CurveKey>,
}

impl CurveKeyCollection {
    /// An empty list.
    pub fn new() -> Self {
        Self::default()
    }

    /// Number of keys.
    #[doc(alias = "Count")]
    pub fn len(&self) -> usize {
        self.keys.len()
    }

    /// Whether there is no key.
    pub fn is_empty(&self) -> bool {
        self.keys.is_empty()
    }

    /// The key at an index of the list, from 0.
    #[doc(alias = "Item")]
    pub fn get(&self, index: usize) -> Option<&CurveKey> {
        self.keys.get(index)
    }

    /// The key at an index of the list, to edit its value and tangents.
    pub fn get_mut(&mut self, index: usize) -> Option<&mut CurveKey> {
        self.keys.get_mut(index)
    }

    /// All keys in the order of the list.
    #[doc(alias = "CopyTo")]
    pub fn as_slice(&self) -> &[CurveKey] {
        &self.keys
    }

    /// All keys, one after the other.
    #[doc(alias = "GetEnumerator")]
    pub fn iter(&self) -> std::slice::Iter<'_, CurveKey> {
        self.keys.iter()
    }

    /// Inserts a key before the first one with a greater position; keys at the same position keep the order in which
    /// they were added.
    #[doc(alias = "Add")]
    pub fn add(&mut self, key: CurveKey) {
        let greater = self.keys.iter().position(|other| other.position() > key.position());
        self.keys.insert(greater.unwrap_or(self.keys.len()), key);
    }

    /// Replaces a key. If the new key has another position than the old one, it is appended to the **end** of the list,
    /// whatever its position, as in the original.
    ///
    /// # Errors
    /// An index that is not less than [`len`](Self::len).
    #[doc(alias = "Item")]
    pub fn set(&mut self, index: usize, key: CurveKey) -> Result<()> {
        self.check(index)?;
        if self.keys[index].position() == key.position() {
            self.keys[index] = key;
        } else {
            self.keys.remove(index);
            self.keys.push(key);
        }
        Ok(())
    }

    /// Removes the first key that is equal to this one, and returns whether there was one.
    #[doc(alias = "Remove")]
    pub fn remove(&mut self, key: &CurveKey) -> bool {
        let found = self.index_of(key);
        if let Some(index) = found {
            self.keys.remove(index);
        }
        found.is_some()
    }

    /// Removes the key at an index of the list.
    ///
    /// # Errors
    /// An index that is not less than [`len`](Self::len).
    #[doc(alias = "RemoveAt")]
    pub fn remove_at(&mut self, index: usize) -> Result<()> {
        self.check(index)?;
        self.keys.remove(index);
        Ok(())
    }

    /// Removes all keys.
    #[doc(alias = "Clear")]
    pub fn clear(&mut self) {
        self.keys.clear();
    }

    /// Whether a key is equal to this one.
    #[doc(alias = "Contains")]
    pub fn contains(&self, key: &CurveKey) -> bool {
        self.keys.contains(key)
    }

    /// The index of the first key that is equal to this one.
    #[doc(alias = "IndexOf")]
    pub fn index_of(&self, key: &CurveKey) -> Option<usize> {
        self.keys.iter().position(|other| other == key)
    }

    pub(super) fn check(&self, index: usize) -> Result<()> {
        if index < self.keys.len() {
            Ok(())
        } else {
            Err(Error::invalid("index", index, "less than the number of keys"))
        }
    }
}

impl Clone for CurveKeyCollection {
    /// The same keys, [added](CurveKeyCollection::add) one after the other: a list that is out of order becomes sorted,
    /// as in the original.
    fn clone(&self) -> Self {
        let mut clone = CurveKeyCollection { keys: Vec::with_capacity(self.len()) };
        for &key in self {
            clone.add(key);
        }
        clone
    }
}

impl<'a> IntoIterator for &'a CurveKeyCollection {
    type Item = &'a CurveKey;
    type IntoIter = std::slice::Iter<'a, CurveKey>;
    fn into_iter(self) -> Self::IntoIter {
        self.iter()
    }
}

impl std::ops::Index<usize> for CurveKeyCollection {
    type Output = CurveKey;
    /// # Panics
    /// If there is no such key; see [`CurveKeyCollection::get`].
    fn index(&self, index: usize) -> &CurveKey {
        &self.keys[index]
    }
}
