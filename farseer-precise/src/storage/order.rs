//! Sorting by integer keys.
//!
//! A generic sort is compiled for every type of list, with five kilobytes of code or more each. Lists with integer keys
//! that are sorted seldom share the one sort of this module. Public for engines on top of this one.

/// Sorts a list by a key of its items; the sort is stable.
pub fn sort_by_number<T: Copy>(list: &mut [T], number: impl Fn(&T) -> u128) {
    // Many lists are built in order, above all in the first step of a world.
    if list.is_sorted_by_key(&number) {
        return;
    }
    let mut places: Vec<(u128, u32)> = list.iter().map(number).zip(0..).collect();
    sort_numbered(&mut places);
    // The reads do not depend on each other, as those along the cycles of a permutation do: cache misses overlap.
    let unsorted = list.to_vec();
    for (item, (_, from)) in list.iter_mut().zip(places) {
        *item = unsorted[from as usize];
    }
}

/// As [`sort_by_number`], without allocation and without copies of items: `places` is scratch space, empty before and after.
pub fn sort_by_number_in<T>(places: &mut Vec<(u128, u32)>, list: &mut [T], number: impl Fn(&T) -> u128) {
    if list.is_sorted_by_key(&number) {
        return;
    }
    places.extend(list.iter().map(number).zip(0..));
    sort_numbered(places);
    for first in 0..list.len() {
        // Follows a cycle of the permutation: each item takes the place of the next one.
        let mut place = first;
        loop {
            let next = std::mem::replace(&mut places[place].1, place as u32) as usize;
            if next == first {
                break;
            }
            list.swap(place, next);
            place = next;
        }
    }
    places.clear();
}

/// Sorts pairs of key and original position in place: by key, and items of the same key by position.
#[inline(never)]
pub fn sort_numbered(places: &mut [(u128, u32)]) {
    places.sort_unstable();
}

/// Packs integers into one key that is ordered as the sequence of them is.
pub fn packed_key<const N: usize>(numbers: [u32; N]) -> u128 {
    const { assert!(N <= 4) };
    numbers.into_iter().fold(0, |joined, number| joined << 32 | u128::from(number))
}

/// An integer that is ordered as [`f32::total_cmp`] orders the value.
pub fn total_order_key(value: f32) -> u32 {
    let bits = value.to_bits();
    if bits >> 31 == 0 { bits | 1 << 31 } else { !bits }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn sorting_is_stable() {
        let mut list: Vec<(u32, u32)> = (0..100).map(|at| (at * 37 % 10, at)).collect();
        let mut expected = list.clone();
        expected.sort_by_key(|&(number, _)| number);
        sort_by_number(&mut list, |&(number, _)| number.into());
        assert_eq!(list, expected);
    }

    #[test]
    fn total_order_keys_have_the_order_of_total_cmp() {
        let floats = [
            -f32::NAN,
            f32::NEG_INFINITY,
            -1.5,
            -f32::MIN_POSITIVE,
            -0.0,
            0.0,
            1e-40,
            2.0,
            f32::INFINITY,
            f32::NAN,
        ];
        for (a, b) in floats.iter().flat_map(|a| floats.iter().map(move |b| (a, b))) {
            assert_eq!(total_order_key(*a).cmp(&total_order_key(*b)), a.total_cmp(b), "{a} {b}");
        }
    }

    #[test]
    fn packed_keys_have_the_order_of_their_sequences() {
        assert!(packed_key([1, u32::MAX]) < packed_key([2, 0]));
        assert!(packed_key([0, 0, 1, 0]) > packed_key([0, 0, 0, u32::MAX]));
    }
}
