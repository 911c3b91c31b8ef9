//! The sort of the original's runtime library, comparison for comparison (behaviour chapter 08, section 2.3).
//!
//! The original sorts interval ends with a comparison that contradicts itself for two begins, or two ends, of
//! equal value; what comes out then depends on the exact sequence of comparisons of this introspective sort.

use super::endpoint::Endpoint;

/// The sort ran off the low end of the list: the original throws here.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct InconsistentComparison;

/// Ranges up to this length are sorted by insertion.
const INSERTION_LIMIT: isize = 16;

/// The original's comparison: is `a` less (-1), the very same (0) or greater (1) than `b`?
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

/// Sorts as the original does, ties included; the list is left half sorted on failure.
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

/// Positions count from 1.
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
