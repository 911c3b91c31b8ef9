//! The order of joints in a pass, by graph colours.
//!
//! Rows in the order of a chain carry waves along it: solved so, a bridge of 100 planks of which the rows have a damping ratio of 10
//! moves at 2,000 px/s, and by colours at 560. No two joints of a colour share a dynamic body (greedy colouring, as of contacts in
//! [`rows`](super::super::rows)). Joints to something fixed come last: what they hold carries all else.

use super::hold::Hold;
use crate::storage::order::sort_by_number;

/// Colours of joints between two dynamic bodies, and as many after them of joints to something fixed. The last one of each takes what
/// finds no other.
const COLOURS: u32 = 32;

/// Whether joints of a colour may share bodies: they are solved one after the other.
pub(super) fn is_last(colour: u32) -> bool {
    colour % COLOURS == COLOURS - 1
}

/// Joints, given by their places in the list in the order of creation, with their colours, in the order of these.
pub(super) fn colour(holds: &[Hold], joints: &[u32], bodies: usize, order: &mut Vec<(u32, u32)>) {
    let mut used = vec![0_u64; bodies];
    order.clear();
    for &at in joints {
        let ends = holds[at as usize].ends.map(|end| end.body as usize);
        let dynamic = || ends.into_iter().filter(|&body| body != 0);
        let first = if ends.contains(&0) { COLOURS } else { 0 };
        let taken = dynamic().fold(0, |taken, body| taken | used[body]) >> first;
        let colour = first + taken.trailing_ones().min(COLOURS - 1);
        dynamic().for_each(|body| used[body] |= 1 << colour);
        order.push((at, colour));
    }
    sort_by_number(order, |&(_, colour)| colour.into());
}
