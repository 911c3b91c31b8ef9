//! Schedule of contact groups for solving in parallel, without changing a bit.
//!
//! Two groups that share a movable body must be solved in list order; others may be solved in any order, or in
//! parallel. Each group goes into the first batch after all earlier groups that share a body with it. The batch must
//! hold groups with the same number of contacts and have a free lane.

use super::ContactGroup;
use super::lanes::LANES;
use farseer_precise::reusing_clone;

/// Groups that share no movable body and have equal numbers of contacts.
#[derive(Debug, Clone, Copy)]
pub(super) struct ScheduledBatch {
    pub(super) groups: [u32; LANES],
    pub(super) length: u8,
    /// Number of contacts of each group.
    pub(super) row_count: u32,
}

impl ScheduledBatch {
    pub(super) fn groups(&self) -> &[u32] {
        &self.groups[..self.length as usize]
    }
}

/// Maximum number of contacts of a group in a batch; groups with more are solved one by one.
const MAX_ROWS: usize = 8;

/// Maximum number of open batches that are searched for a free lane. Chosen; no range measured.
const MAX_SEARCHED_BATCHES: usize = 32;

/// Scratch space of [`Schedule::build`], and its result.
#[derive(Debug, Default)]
pub(super) struct Schedule {
    pub(super) batches: Vec<ScheduledBatch>,
    /// By body: one more than the index of the last batch with it; 0 if there is none.
    last_batch: Vec<u32>,
    /// By number of contacts: indices of batches with a free lane, ascending.
    open: [Vec<u32>; MAX_ROWS + 1],
}

reusing_clone! { Schedule { batches, last_batch, open } }

impl Schedule {
    /// Assigns the groups to batches. `is_ordered` holds for each body whether its groups must keep their order.
    pub(super) fn build(&mut self, groups: &[ContactGroup], is_ordered: &[bool]) {
        self.batches.clear();
        self.last_batch.clear();
        self.last_batch.resize(is_ordered.len(), 0);
        self.open.iter_mut().for_each(Vec::clear);
        for (index, group) in groups.iter().enumerate() {
            let (a, b) = (group.body_a as usize, group.body_b as usize);
            let earliest = self.last_batch[a].max(self.last_batch[b]);
            let batch = self.assign(index as u32, group, earliest);
            for body in [a, b] {
                if is_ordered[body] {
                    self.last_batch[body] = batch + 1;
                }
            }
        }
    }

    /// Finds or makes a batch with at least the index `earliest`, adds the group and returns the batch's index.
    fn assign(&mut self, index: u32, group: &ContactGroup, earliest: u32) -> u32 {
        let row_count = group.contact_count as usize;
        let can_share = row_count <= MAX_ROWS && !group.is_unbatched;
        if can_share {
            let open = &mut self.open[row_count];
            if let Some(position) = open.iter().position(|&batch| batch >= earliest) {
                let batch = open[position];
                let place = &mut self.batches[batch as usize];
                place.groups[place.length as usize] = index;
                place.length += 1;
                if place.length as usize == LANES {
                    open.remove(position);
                }
                return batch;
            }
        }
        let batch = self.batches.len() as u32;
        self.batches.push(ScheduledBatch {
            groups: [index; LANES],
            length: 1,
            row_count: group.contact_count,
        });
        if can_share {
            let open = &mut self.open[row_count];
            if open.len() == MAX_SEARCHED_BATCHES {
                open.remove(0);
            }
            open.push(batch);
        }
        batch
    }
}
