//! Which groups of contacts can be solved side by side without changing a bit.
//!
//! Two groups that share a body that can move must be solved in list order; others may be solved in any order, or
//! at once. Each group goes into the first batch behind all earlier groups that share a body with it and that has
//! room for a group with as many contacts.

use super::ContactGroup;
use super::lanes::LANES;
use crate::storage::reusing_clone::reusing_clone;

/// Groups that share no movable body and have equally many contacts.
#[derive(Debug, Clone, Copy)]
pub(super) struct Batch {
    pub(super) groups: [u32; LANES],
    pub(super) length: u8,
    /// Number of contacts of each group.
    pub(super) row_count: u32,
}

impl Batch {
    pub(super) fn groups(&self) -> &[u32] {
        &self.groups[..self.length as usize]
    }
}

/// Contact counts up to this get batches of their own; groups with more are solved one by one.
const MAX_ROWS: usize = 8;

/// Open batches that are looked through for room.
const SEARCHED: usize = 32;

/// Scratch space of [`Schedule::build`], and its result.
#[derive(Debug, Default)]
pub(super) struct Schedule {
    pub(super) batches: Vec<Batch>,
    /// By body: one more than the index of the last batch it is in.
    last_batch: Vec<u32>,
    /// By number of contacts: batches with room, in order.
    open: [Vec<u32>; MAX_ROWS + 1],
}

reusing_clone! { Schedule { batches, last_batch, open } }

impl Schedule {
    /// Puts the groups into batches. `is_ordered` tells by body whether its groups must keep their order.
    pub(super) fn build(&mut self, groups: &[ContactGroup], is_ordered: &[bool]) {
        self.batches.clear();
        self.last_batch.clear();
        self.last_batch.resize(is_ordered.len(), 0);
        self.open.iter_mut().for_each(Vec::clear);
        for (index, group) in groups.iter().enumerate() {
            let (a, b) = (group.body_a as usize, group.body_b as usize);
            let earliest = self.last_batch[a].max(self.last_batch[b]);
            let batch = self.place(index as u32, group, earliest);
            for body in [a, b] {
                if is_ordered[body] {
                    self.last_batch[body] = batch + 1;
                }
            }
        }
    }

    /// Finds or makes a batch from index `earliest` on.
    fn place(&mut self, index: u32, group: &ContactGroup, earliest: u32) -> u32 {
        let row_count = group.contact_count as usize;
        let can_share = row_count <= MAX_ROWS && !group.is_alone;
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
        self.batches.push(Batch { groups: [index; LANES], length: 1, row_count: group.contact_count });
        if can_share {
            let open = &mut self.open[row_count];
            if open.len() == SEARCHED {
                open.remove(0);
            }
            open.push(batch);
        }
        batch
    }
}
