//! Graph colouring of the joints in the iterative solver: the order in which one solve goes through them.
//!
//! No two joints of a colour share a dynamic body, so that four are solved side by side in SIMD lanes. The colouring is greedy,
//! as that of contacts in [`constraint_graph`](super::super::constraint_graph). Joints to static or kinematic bodies have the
//! last colours, since they carry the load of all others.
//!
//! In the order of creation, velocity errors would travel along a chain as a wave. In that order, a bridge of 100 planks whose
//! rows have a damping ratio of 10 moves at 2,000 px/s; in the order of colours at 560 px/s.

use super::indices::JointIndex;
use super::joint_constraint::JointList;
use crate::index::{BodyIndex, IndexedVec, ListRanges, index_type};

/// Number of colours in each of two classes: joints between two dynamic bodies, and joints to a static or kinematic body.
///
/// The last colour of a class is its overflow colour. Each body has a 64-bit mask with one bit for each of the 2 * 32 colours.
const COLORS_PER_CLASS: u32 = 32;
/// Number of all colours.
const COLOR_COUNT: usize = 64;

index_type! {
    /// A colour, below [`COLOR_COUNT`].
    pub(super) struct JointColor;
}

impl JointColor {
    /// Returns whether this is an overflow colour. Its joints may share bodies and are solved one after the other.
    pub(super) fn is_overflow(self) -> bool {
        self.0 % COLORS_PER_CLASS == COLORS_PER_CLASS - 1
    }
}

/// Assigns colours to `joints` of the list `all`, in the order of creation. Writes joint and colour to `colored`, sorted by
/// colour. `body_count` is the number of bodies.
pub(super) fn assign_colors(
    all: &JointList,
    joints: &[JointIndex],
    body_count: usize,
    colored: &mut Vec<(JointIndex, JointColor)>,
) {
    colored.clear();
    if joints.is_empty() {
        return;
    }
    let mut used = IndexedVec::<BodyIndex, _>::of_copies(0_u64, body_count);
    colored.reserve(joints.len());
    for &index in joints {
        let ends = all[index].anchors.map(|end| end.body);
        let dynamic = || ends.into_iter().filter(|&body| body != BodyIndex::PLACEHOLDER);
        let first_color = if ends.contains(&BodyIndex::PLACEHOLDER) { COLORS_PER_CLASS } else { 0 };
        let used_colors = dynamic().fold(0, |taken, body| taken | used[body]) >> first_color;
        let color = first_color + used_colors.trailing_ones().min(COLORS_PER_CLASS - 1);
        dynamic().for_each(|body| used[body] |= 1 << color);
        colored.push((index, JointColor(color)));
    }
    sort_by_color(colored);
}

/// Sorts pairs of joint and colour by colour; the sort is stable.
fn sort_by_color(colored: &mut Vec<(JointIndex, JointColor)>) {
    let mut ends = ListRanges::default();
    ends.reset(COLOR_COUNT);
    colored.iter().for_each(|&(_, color)| ends.count(color));
    ends.begin_lists();
    let mut sorted = vec![(JointIndex(0), JointColor(0)); colored.len()];
    for &pair in colored.iter() {
        sorted[ends.next_position(pair.1)] = pair;
    }
    *colored = sorted;
}
