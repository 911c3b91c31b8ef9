//! A list that is sorted again from frame to frame, with the work that what has moved makes.

use std::cmp::Ordering;

/// Entries that are moved in an insertion sort, per entry: beyond that another way to sort is quicker.
const SHIFTS: usize = 8;

/// Things in an order in which no two are equal.
#[derive(Debug, Clone)]
pub(super) struct SortedAgain<E> {
    sorted: Vec<E>,
    /// Room.
    kept: Vec<E>,
    moved: Vec<E>,
}

impl<E> Default for SortedAgain<E> {
    fn default() -> Self {
        SortedAgain { sorted: Vec::new(), kept: Vec::new(), moved: Vec::new() }
    }
}

impl<E: Copy> SortedAgain<E> {
    pub(super) fn as_slice(&self) -> &[E] {
        &self.sorted
    }

    /// Sorts the things that were sorted the last time, and fresh ones. `now` answers what one has become and whether it has
    /// moved, or `None` if it is gone: those that have not moved are in order among themselves.
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
        // Whichever of them move the next time, there is room for them.
        let count = self.kept.len() + self.moved.len();
        self.kept.reserve(count - self.kept.len());
        self.moved.reserve(count - self.moved.len());
        sort(&mut self.moved, &compare);
        self.merge(compare);
    }

    /// Those that have moved come between the others.
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

/// By insertion as long as that is cheap: what moves in a frame does not pass many.
fn sort<E: Copy>(entries: &mut [E], compare: impl Fn(&E, &E) -> Ordering) {
    let mut shifts = SHIFTS * entries.len();
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

    fn sort_again(list: &mut SortedAgain<Entry>, numbers: &[Option<i32>]) {
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
    fn what_moves_comes_and_goes_is_where_sorting_everything_puts_it() {
        let mut list = SortedAgain::default();
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
            sort_again(&mut list, &numbers);
            let mut expected: Vec<Entry> =
                numbers.iter().copied().zip(0..).filter_map(|(n, name)| Some((n?, name))).collect();
            expected.sort_unstable();
            assert_eq!(list.as_slice(), expected, "round {round}");
        }
    }
}
