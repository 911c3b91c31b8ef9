//! A set of integers that is cleared in constant time, with a count for each integer.

use farseer_precise::reusing_clone;

/// Hash set with open addressing; an entry is valid only if its stamp is the current one. It is never enumerated, so
/// the internal order cannot be observed.
#[derive(Debug)]
pub(crate) struct StampedSet {
    /// Key, stamp, and count of the key.
    entries: Vec<(i64, u32, u32)>,
    stamp: u32,
    used: usize,
}

reusing_clone! { StampedSet { entries, stamp, used } }

impl Default for StampedSet {
    fn default() -> Self {
        // Free entries have the stamp 0.
        StampedSet { entries: Vec::new(), stamp: 1, used: 0 }
    }
}

impl StampedSet {
    pub(crate) fn clear(&mut self) {
        self.used = 0;
        self.stamp = self.stamp.wrapping_add(1);
        if self.stamp == 0 {
            self.entries.fill((0, 0, 0));
            self.stamp = 1;
        }
    }

    /// Adds a key and returns whether it is new.
    #[inline]
    pub(crate) fn insert(&mut self, key: i64) -> bool {
        if (self.used + 1) * 2 > self.entries.len() {
            self.grow();
        }
        let place = self.find(key);
        if self.entries[place].1 == self.stamp {
            return false;
        }
        self.entries[place] = (key, self.stamp, 0);
        self.used += 1;
        true
    }

    /// The count of a key, which is added with the count 0 if it is new.
    pub(crate) fn count_mut(&mut self, key: i64) -> &mut u32 {
        self.insert(key);
        let place = self.find(key);
        &mut self.entries[place].2
    }

    /// The count of a key; 0 if it is not in the set.
    pub(crate) fn count(&self, key: i64) -> u32 {
        if self.used == 0 {
            return 0;
        }
        let (_, stamp, count) = self.entries[self.find(key)];
        if stamp == self.stamp { count } else { 0 }
    }

    /// Index of a key's entry, or of the free entry for it.
    #[inline]
    fn find(&self, key: i64) -> usize {
        let mask = self.entries.len() - 1;
        // Fibonacci hashing spreads neighbouring keys over the table.
        let mut place = ((key as u64).wrapping_mul(0x9E37_79B9_7F4A_7C15) >> 32) as usize & mask;
        while self.entries[place].1 == self.stamp && self.entries[place].0 != key {
            place = (place + 1) & mask;
        }
        place
    }

    fn grow(&mut self) {
        let capacity = (self.entries.len() * 2).max(256);
        let old = std::mem::replace(&mut self.entries, vec![(0, 0, 0); capacity]);
        for (key, stamp, count) in old {
            if stamp == self.stamp {
                let place = self.find(key);
                self.entries[place] = (key, stamp, count);
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_key_is_new_once_until_the_set_is_cleared() {
        let mut set = StampedSet::default();
        assert!((0..1000).all(|key| set.insert(key * 7)));
        assert!((0..1000).all(|key| !set.insert(key * 7)));
        set.clear();
        assert!((0..1000).all(|key| set.insert(key * 7)));
    }

    #[test]
    fn keys_are_counted_until_the_set_is_cleared() {
        let mut set = StampedSet::default();
        assert_eq!(set.count(3), 0);
        for key in (0..1000).chain(500..1000) {
            *set.count_mut(key) += 1;
        }
        assert!((0..1500).all(|key| set.count(key) == [1, 2, 0][key as usize / 500]));
        set.clear();
        assert_eq!(set.count(3), 0);
    }
}
