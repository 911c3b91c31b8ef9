//! The order of joints in a pass, by graph colours.
//!
//! Rows in the order of a chain carry waves along it: solved so, a bridge of 100 planks of which the rows have a damping ratio of 10
//! moves at 2,000 px/s, and by colours at 560. No two joints of a colour share a dynamic body (greedy colouring, as of contacts in
//! [`rows`](super::super::rows)). Joints to something fixed come last: what they hold carries all else.

use super::hold::Hold;
use crate::storage::order::sort_by_number;

/// Colours of joints between two dynamic bodies, and as many after them of joints to something fixed. The last one of each takes what
/// finds no other, and is solved in order.
const COLOURS: u32 = 32;

/// Puts joints, given by their places in the list in the order of creation, in the order of their colours.
pub(super) fn sort_by_colour(holds: &[Hold], order: &mut [u32], bodies: usize) {
    let mut used = vec![0_u64; bodies];
    let mut colours = vec![0; holds.len()];
    for &at in order.iter() {
        let ends = holds[at as usize].ends.map(|end| end.body as usize);
        let dynamic = || ends.into_iter().filter(|&body| body != 0);
        let first = if ends.contains(&0) { COLOURS } else { 0 };
        let taken = dynamic().fold(0, |taken, body| taken | used[body]) >> first;
        let colour = first + taken.trailing_ones().min(COLOURS - 1);
        dynamic().for_each(|body| used[body] |= 1 << colour);
        colours[at as usize] = colour;
    }
    sort_by_number(order, |&at| colours[at as usize].into());
}
