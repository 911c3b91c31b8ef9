//! Incremental sort: a list that is re-sorted in every frame at the cost of the entries that moved.

use std::cmp::Ordering;

/// Greatest number of shifts of an insertion sort per entry; a general sort is faster beyond it.
const MAX_SHIFTS_PER_ENTRY: usize = 8;

/// A sorted list of entries, no two of which are equal.
#[derive(Debug, Clone)]
pub(super) struct IncrementalSort<E> {
    sorted: Vec<E>,
    /// Buffers.
    kept: Vec<E>,
    moved: Vec<E>,
}

impl<E> Default for IncrementalSort<E> {
    fn default() -> Self {
        IncrementalSort { sorted: Vec::new(), kept: Vec::new(), moved: Vec::new() }
    }
}

impl<E: Copy> IncrementalSort<E> {
    pub(super) fn as_slice(&self) -> &[E] {
        &self.sorted
    }

    /// Re-sorts the list with fresh entries. `now` returns the present state of an entry and whether it
    /// moved, or `None` if it is gone. Entries that have not moved are in order among themselves.
    pub(super) fn sort(
        &mut self,
        mut now: impl FnMut(&E) -> Option<(E, bool)>,
        fresh: impl Iterator<Item = E>,
        compare: impl Fn(&E, &E) -> Ordering,
    ) {
        self.kept.clear();
        self.moved.clear();
        for (entry, has_moved) in self.sorted.iter().filter_map(&mut now) {
            if has_moved { self.moved.push(entry) } else { self.kept.push(entry) }
        }
        self.moved.extend(fresh);
        // Reserves capacity for any split into kept and moved entries in the next frame.
        let count = self.kept.len() + self.moved.len();
        self.kept.reserve(count - self.kept.len());
        self.moved.reserve(count - self.moved.len());
        sort(&mut self.moved, &compare);
        self.merge(compare);
    }

    /// Merges the sorted moved entries into the sorted entries that have not moved.
    fn merge(&mut self, compare: impl Fn(&E, &E) -> Ordering) {
        self.sorted.clear();
        let mut rest = &self.kept[..];
        for entry in &self.moved {
            let before = rest.iter().take_while(|kept| compare(kept, entry).is_lt()).count();
            self.sorted.extend_from_slice(&rest[..before]);
            self.sorted.push(*entry);
            rest = &rest[before..];
        }
        self.sorted.extend_from_slice(rest);
    }
}

/// Insertion sort as long as it is cheap: entries move only a few places per frame.
fn sort<E: Copy>(entries: &mut [E], compare: impl Fn(&E, &E) -> Ordering) {
    let mut shifts = MAX_SHIFTS_PER_ENTRY * entries.len();
    for end in 1..entries.len() {
        let entry = entries[end];
        let mut place = end;
        while place > 0 && compare(&entry, &entries[place - 1]).is_lt() {
            entries[place] = entries[place - 1];
            place -= 1;
        }
        entries[place] = entry;
        let Some(left) = shifts.checked_sub(end - place) else {
            entries.sort_unstable_by(compare);
            return;
        };
        shifts = left;
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Numbers with names: the order is that of the numbers, then of the names.
    type Entry = (i32, usize);

    fn update_list(list: &mut IncrementalSort<Entry>, numbers: &[Option<i32>]) {
        let mut is_known = vec![false; numbers.len()];
        for &(_, name) in list.as_slice() {
            is_known[name] = numbers[name].is_some();
        }
        let now = |&(before, name): &Entry| numbers[name].map(|number| ((number, name), number != before));
        let fresh = (0..numbers.len()).filter(|&name| !is_known[name]);
        let fresh = fresh.filter_map(|name| Some((numbers[name]?, name)));
        list.sort(now, fresh, |a, b| a.cmp(b));
    }

    #[test]
    fn moved_added_and_removed_items_are_ordered_as_by_a_full_sort() {
        let mut list = IncrementalSort::default();
        let mut state = 1_u64;
        let mut random = |below: u64| {
            state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1);
            (state >> 33) % below
        };
        let mut numbers = vec![None; 60];
        for round in 0..300 {
            // From none to all of them move, a little or anywhere.
            for number in &mut numbers {
                if random(300) < round {
                    let anywhere = random(40) as i32;
                    *number = match (random(5), *number) {
                        (0, _) => None,
                        (1..=3, Some(number)) => Some(number + anywhere % 3 - 1),
                        _ => Some(anywhere),
                    };
                }
            }
            update_list(&mut list, &numbers);
            let mut expected: Vec<Entry> =
                numbers.iter().copied().zip(0..).filter_map(|(n, name)| Some((n?, name))).collect();
            expected.sort_unstable();
            assert_eq!(list.as_slice(), expected, "round {round}");
        }
    }
}
