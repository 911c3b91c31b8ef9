//! Graph colouring of the joints in the iterative solver: the order in which one solve goes through them.
//!
//! No two joints of a colour share a dynamic body, so that four are solved side by side in SIMD lanes. The colouring is greedy,
//! as that of contacts in [`constraint_graph`](super::super::constraint_graph). Joints to static or kinematic bodies have the
//! last colours, since they carry the load of all others.
//!
//! In the order of creation, velocity errors would travel along a chain as a wave. In that order, a bridge of 100 planks whose
//! rows have a damping ratio of 10 moves at 2,000 px/s; in the order of colours at 560 px/s.

use super::joint_constraint::JointConstraint;

/// Number of colours in each of two classes: joints between two dynamic bodies, and joints to a static or kinematic body.
///
/// The last colour of a class is its overflow colour. Each body has a 64-bit mask with one bit for each of the 2 * 32 colours.
const COLORS_PER_CLASS: u32 = 32;

/// Returns whether `color` is an overflow colour. Its joints may share bodies and are solved one after the other.
pub(super) fn is_overflow(color: u32) -> bool {
    color % COLORS_PER_CLASS == COLORS_PER_CLASS - 1
}

/// Assigns colours to the joints with the indices `joints` into `all`, which are in the order of creation. Writes (index,
/// colour) to `colored`, sorted by colour. `body_count` is the number of bodies.
pub(super) fn assign_colors(
    all: &[JointConstraint],
    joints: &[u32],
    body_count: usize,
    colored: &mut Vec<(u32, u32)>,
) {
    colored.clear();
    if joints.is_empty() {
        return;
    }
    let mut used = vec![0_u64; body_count];
    let mut counts = [0_usize; 2 * COLORS_PER_CLASS as usize];
    colored.reserve(joints.len());
    for &index in joints {
        let ends = all[index as usize].anchors.map(|end| end.body as usize);
        let dynamic = || ends.into_iter().filter(|&body| body != 0);
        let first_color = if ends.contains(&0) { COLORS_PER_CLASS } else { 0 };
        let used_colors = dynamic().fold(0, |taken, body| taken | used[body]) >> first_color;
        let color = first_color + used_colors.trailing_ones().min(COLORS_PER_CLASS - 1);
        dynamic().for_each(|body| used[body] |= 1 << color);
        counts[color as usize] += 1;
        colored.push((index, color));
    }
    sort_by_color(colored, &counts);
}

/// Sorts pairs of index and colour by colour; the sort is stable. `counts` holds the number of pairs of each colour.
fn sort_by_color(colored: &mut Vec<(u32, u32)>, counts: &[usize]) {
    let mut ends = [0; 2 * COLORS_PER_CLASS as usize];
    let mut sum = 0;
    for (end, count) in ends.iter_mut().zip(counts) {
        *end = sum;
        sum += count;
    }
    let mut sorted = vec![(0, 0); colored.len()];
    for &pair in colored.iter() {
        let end = &mut ends[pair.1 as usize];
        sorted[*end] = pair;
        *end += 1;
    }
    *colored = sorted;
}
