//! Sorting by numbers. Every kind of list that is sorted has a sort of its own compiled for it, of five kilobytes and more;
//! all those share one that are sorted by numbers alone, and not so often that another list would matter. Public for engines
//! built on this one.

/// Puts a list in the order of numbers that its items have; what has the same number keeps its order.
pub fn sort_by_number<T>(list: &mut [T], number: impl Fn(&T) -> u128) {
    sort_within(&mut Vec::new(), list, number);
}

/// As [`sort_by_number`], for what may not allocate: within room that is kept. It is empty before and after.
pub fn sort_within<T>(places: &mut Vec<(u128, u32)>, list: &mut [T], number: impl Fn(&T) -> u128) {
    if list.len() < 2 {
        return;
    }
    places.extend(list.iter().map(number).zip(0..));
    sort_numbered(places);
    for first in 0..list.len() {
        // Around a ring of places of which each takes what is at the next one.
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

/// Puts places in the order of numbers, and those of the same number in their own, where they are.
#[inline(never)]
pub fn sort_numbered(places: &mut [(u128, u32)]) {
    places.sort_unstable();
}

/// Numbers in a row as one, which has the order of the row.
pub fn joined<const N: usize>(numbers: [u32; N]) -> u128 {
    const { assert!(N <= 4) };
    numbers.into_iter().fold(0, |joined, number| joined << 32 | u128::from(number))
}

/// A number that has the order of [`f32::total_cmp`].
pub fn ordered(value: f32) -> u32 {
    let bits = value.to_bits();
    if bits >> 31 == 0 { bits | 1 << 31 } else { !bits }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn equal_numbers_keep_their_order_and_others_get_theirs() {
        let mut list: Vec<(u32, u32)> = (0..100).map(|at| (at * 37 % 10, at)).collect();
        let mut expected = list.clone();
        expected.sort_by_key(|&(number, _)| number);
        sort_by_number(&mut list, |&(number, _)| number.into());
        assert_eq!(list, expected);
    }

    #[test]
    fn numbers_of_floats_have_the_total_order() {
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
            assert_eq!(ordered(*a).cmp(&ordered(*b)), a.total_cmp(b), "{a} {b}");
        }
    }

    #[test]
    fn joined_numbers_have_the_order_of_the_rows() {
        assert!(joined([1, u32::MAX]) < joined([2, 0]));
        assert!(joined([0, 0, 1, 0]) > joined([0, 0, 0, u32::MAX]));
    }
}
