//! Sorting by numbers. Every kind of list that is sorted has a sort of its own compiled for it, of five kilobytes and more;
//! all those share one that are sorted by numbers alone, and not so often that two lists more would matter.

/// Puts a list in the order of numbers that its items have; what has the same number keeps its order.
pub(crate) fn sort_by_number<T: Clone>(list: &mut [T], number: impl Fn(&T) -> u128) {
    if list.len() < 2 {
        return;
    }
    let numbers = list.iter().map(number).zip(0_u32..).collect();
    let old = list.to_vec();
    for (item, (_, place)) in list.iter_mut().zip(in_order(numbers)) {
        *item = old[place as usize].clone();
    }
}

/// Numbers with the places that they had.
#[inline(never)]
fn in_order(mut numbers: Vec<(u128, u32)>) -> Vec<(u128, u32)> {
    numbers.sort_unstable();
    numbers
}

/// Numbers in a row as one, which has the order of the row.
pub(crate) fn joined<const N: usize>(numbers: [u32; N]) -> u128 {
    const { assert!(N <= 4) };
    numbers.into_iter().fold(0, |joined, number| joined << 32 | u128::from(number))
}

/// A number that has the order of [`f32::total_cmp`].
pub(crate) fn ordered(value: f32) -> u32 {
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
