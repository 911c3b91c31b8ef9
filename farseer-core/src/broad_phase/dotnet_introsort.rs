//! Introspective sort of the original's runtime library, .NET, comparison for comparison (behaviour chapter 08, section
//! 2.3).
//!
//! The original sorts interval ends with a comparison that contradicts itself for two begins, or two ends, of equal
//! value. The resulting order then depends on the exact sequence of comparisons of this sort.

use super::endpoint::Endpoint;

/// The error of a sort that ran off the low end of the list: the original throws here.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct InconsistentComparison;

/// Ranges of at most this number of elements are sorted by insertion, as in .NET.
const INSERTION_LIMIT: isize = 16;

/// The original's comparison: `a` is less than (-1), identical to (0) or greater than (1) `b`.
#[inline(always)]
fn compare(a: Endpoint, b: Endpoint) -> i32 {
    if a.value < b.value {
        -1
    } else if a.value > b.value {
        1
    } else if a.key == b.key {
        0
    } else if a.is_begin() {
        -1
    } else {
        1
    }
}

/// Sorts as the original does, ties included. On failure the list is left half sorted.
pub(super) fn introspective_sort(list: &mut [Endpoint]) -> Result<(), InconsistentComparison> {
    let n = list.len();
    if n < 2 {
        return Ok(());
    }
    let depth = 2 * (n.ilog2() + 1);
    sort_range(list, 0, n as isize - 1, depth)
}

fn sort_range(
    list: &mut [Endpoint],
    lo: isize,
    mut hi: isize,
    mut depth: u32,
) -> Result<(), InconsistentComparison> {
    while hi > lo {
        let length = hi - lo + 1;
        if length <= INSERTION_LIMIT {
            match length {
                2 => order(list, lo, hi),
                3 => {
                    order(list, lo, hi - 1);
                    order(list, lo, hi);
                    order(list, hi - 1, hi);
                }
                _ => insertion_sort(list, lo, hi),
            }
            return Ok(());
        }
        if depth == 0 {
            heap_sort(&mut list[lo as usize..=hi as usize]);
            return Ok(());
        }
        depth -= 1;
        let pivot = partition(list, lo, hi)?;
        sort_range(list, pivot + 1, hi, depth)?;
        hi = pivot - 1;
    }
    Ok(())
}

#[inline]
fn order(list: &mut [Endpoint], a: isize, b: isize) {
    let (a, b) = (a as usize, b as usize);
    if a != b && compare(list[a], list[b]) > 0 {
        list.swap(a, b);
    }
}

fn insertion_sort(list: &mut [Endpoint], lo: isize, hi: isize) {
    for i in lo..hi {
        let inserted = list[(i + 1) as usize];
        let mut j = i;
        while j >= lo && compare(inserted, list[j as usize]) < 0 {
            list[(j + 1) as usize] = list[j as usize];
            j -= 1;
        }
        list[(j + 1) as usize] = inserted;
    }
}

fn partition(list: &mut [Endpoint], lo: isize, hi: isize) -> Result<isize, InconsistentComparison> {
    let middle = lo + (hi - lo) / 2;
    order(list, lo, middle);
    order(list, lo, hi);
    order(list, middle, hi);
    let pivot = list[middle as usize];
    list.swap(middle as usize, (hi - 1) as usize);
    let (mut left, mut right) = (lo, hi - 1);
    while left < right {
        loop {
            left += 1;
            // With NaN the scan may run off the high end as well.
            let element = *list.get(left as usize).ok_or(InconsistentComparison)?;
            if compare(element, pivot) >= 0 {
                break;
            }
        }
        loop {
            right -= 1;
            if right < 0 {
                return Err(InconsistentComparison);
            }
            if compare(pivot, list[right as usize]) >= 0 {
                break;
            }
        }
        if left >= right {
            break;
        }
        list.swap(left as usize, right as usize);
    }
    list.swap(left as usize, (hi - 1) as usize);
    Ok(left)
}

fn heap_sort(range: &mut [Endpoint]) {
    let n = range.len();
    for i in (1..=n / 2).rev() {
        sift_down(range, i, n);
    }
    for i in (2..=n).rev() {
        range.swap(0, i - 1);
        sift_down(range, 1, i - 1);
    }
}

/// Sifts an element down the heap; `position` counts from 1.
fn sift_down(range: &mut [Endpoint], mut position: usize, n: usize) {
    let sifted = range[position - 1];
    while position <= n / 2 {
        let mut child = 2 * position;
        if child < n && compare(range[child - 1], range[child]) < 0 {
            child += 1;
        }
        if compare(sifted, range[child - 1]) >= 0 {
            break;
        }
        range[position - 1] = range[child - 1];
        position = child;
    }
    range[position - 1] = sifted;
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Element `index` of a list to sort.
    fn element(index: usize, is_begin: bool, value: f32) -> Endpoint {
        Endpoint { value, key: index as u32 * 2 + u32::from(!is_begin) }
    }

    /// A list from words such as `B1` and `E2.5`.
    fn list(words: &str) -> Vec<Endpoint> {
        let parse =
            |(index, word): (usize, &str)| element(index, word.starts_with('B'), word[1..].parse().unwrap());
        words.split_whitespace().enumerate().map(parse).collect()
    }

    fn indices(list: &[Endpoint]) -> Vec<u32> {
        list.iter().map(|endpoint| endpoint.key / 2).collect()
    }

    fn sorted(words: &str) -> Vec<u32> {
        let mut list = list(words);
        introspective_sort(&mut list).unwrap();
        indices(&list)
    }

    /// The list as the failing sort leaves it.
    fn failed(words: &str) -> Vec<u32> {
        let mut list = list(words);
        assert_eq!(introspective_sort(&mut list), Err(InconsistentComparison));
        indices(&list)
    }

    /// Check 1 of behaviour chapter 08.
    #[test]
    fn short_lists_of_ties_have_the_order_of_the_original() {
        assert_eq!(sorted("B1 B1"), [0, 1]);
        assert_eq!(sorted("E1 E1"), [1, 0]);
        assert_eq!(sorted("B1 B1 B1"), [0, 1, 2]);
        assert_eq!(sorted("E1 E1 E1"), [2, 1, 0]);
        assert_eq!(sorted("B1 E1 B1"), [0, 2, 1]);
        assert_eq!(sorted(&"B1 ".repeat(5)), [4, 3, 2, 1, 0]);
        assert_eq!(sorted(&"E1 ".repeat(5)), [0, 1, 2, 3, 4]);
        assert_eq!(sorted(&"B0 ".repeat(16)), (0..16).rev().collect::<Vec<u32>>());
    }

    /// Check 2 of behaviour chapter 08.
    #[test]
    fn mixed_ties_have_the_order_of_the_original() {
        assert_eq!(sorted("E2 B2 E2 B2 E1 B1"), [5, 4, 3, 1, 0, 2]);
        assert_eq!(sorted(&"B0 E5 ".repeat(4)), [6, 4, 2, 0, 1, 3, 5, 7]);
    }

    /// Check 3 of behaviour chapter 08.
    #[test]
    fn partitioned_lists_of_ties_have_the_order_of_the_original() {
        let expected = [19, 17, 16, 15, 14, 13, 12, 11, 10, 9, 8, 7, 6, 5, 4, 3, 2, 1, 18, 0];
        assert_eq!(sorted(&"E3 ".repeat(20)), expected);
        let words = "B3 B2 B1 ".repeat(5) + "B3 B2 B0";
        assert_eq!(sorted(&words), [17, 8, 14, 11, 5, 2, 1, 13, 10, 16, 7, 4, 0, 15, 12, 9, 6, 3]);
    }

    /// Checks 4 and 5 of behaviour chapter 08.
    #[test]
    fn a_begin_at_the_minimum_as_pivot_fails_as_in_the_original() {
        let one_minimum = "B0 E10 ".to_owned() + &"B1 E9 ".repeat(8);
        assert_eq!(sorted(&one_minimum), [0, 8, 14, 12, 10, 16, 6, 4, 2, 3, 5, 7, 9, 11, 13, 15, 17, 1]);
        failed("B0 E10 B1 E9 B1 E9 B1 E9 B0 E9 B1 E9 B1 E9 B1 E9 B1 E9");
        let left = [0, 1, 2, 3, 4, 5, 6, 7, 15, 9, 10, 11, 12, 13, 14, 8, 16];
        assert_eq!(failed(&"B0 ".repeat(17)), left);
        let left = [0, 1, 2, 3, 4, 5, 6, 7, 16, 9, 10, 11, 12, 13, 14, 15, 8, 17];
        assert_eq!(failed(&"B0 E10 ".repeat(9)), left);
    }

    /// Hash of the order of a generated list; `None` if the sort fails.
    fn generated(seed: u32, count: usize, values: u32) -> Option<u32> {
        let mut x = seed;
        let mut next = |index| {
            x = x.wrapping_mul(1_103_515_245).wrapping_add(12345) & 0x7FFF_FFFF;
            element(index, x >> 8 & 1 == 1, ((x >> 16) % values) as f32)
        };
        let mut list: Vec<Endpoint> = (0..count).map(&mut next).collect();
        introspective_sort(&mut list).ok()?;
        Some(indices(&list).iter().fold(0u32, |hash, &index| hash.wrapping_mul(31).wrapping_add(index)))
    }

    /// Check 6 of behaviour chapter 08.
    #[test]
    fn generated_lists_have_the_order_of_the_original() {
        for (seed, count, values, hash) in [
            (1, 10, 3, Some(0xae91_07f9)),
            (2, 16, 4, Some(0xf7c7_f7d2)),
            (3, 17, 5, Some(0x7949_f3c4)),
            (4, 40, 7, Some(0xcb90_c272)),
            (5, 100, 20, Some(0x6366_9b14)),
            (6, 200, 50, Some(0x0159_4ff4)),
            (7, 500, 100, Some(0xbe08_1ff8)),
            (8, 1000, 1000, Some(0xca2b_aee0)),
            (9, 33, 1000, Some(0xcea7_aa8a)),
            (10, 64, 6, None),
        ] {
            assert_eq!(generated(seed, count, values), hash, "seed {seed}");
        }
    }

    /// Check 7 of behaviour chapter 08.
    #[test]
    fn lists_that_reach_the_heap_sort_have_the_order_of_the_original() {
        let values = "0 16 2 12 3 12 4 20 5 19 6 19 7 18 8 18 9 17 10 17 1 1 2 3 4 5 6 7 8 9 10 11 16 15 15 14 14 13 13 11 0";
        let words: String = values.split(' ').map(|value| format!("E{value} ")).collect();
        let expected = [
            40, 0, 20, 21, 2, 22, 4, 23, 6, 24, 8, 25, 10, 26, 12, 27, 14, 28, 16, 29, 18, 30, 39, 31, 3, 5,
            38, 37, 35, 36, 33, 34, 32, 1, 19, 17, 15, 13, 11, 9, 7,
        ];
        assert_eq!(sorted(&words), expected);
    }
}
