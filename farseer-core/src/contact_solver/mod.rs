//! Contact solver of the faithful set: sequential impulses with warm start, the original's method (behaviour chapter
//! 03, section 6).
//!
//! The inner loops work on dense arrays: the velocities of the bodies in contact, and a row per contact. Every
//! operation is rounded as in the original. Groups of contacts that share a movable body are solved in list order;
//! groups that share none are solved four at a time.

mod bodies;
mod body_lanes;
mod kernel;
mod lanes;
mod prepare;
mod row_lanes;
mod schedule;

use wide::f32x4;

use crate::contacts::arbiter::ArbiterList;
use crate::contacts::contact::Contact;
use body_lanes::{PackedBody, pack_four, pack_one, unpack_four, unpack_one};
use farseer_precise::reusing_clone;
use kernel::{BodyLanes, ContactRow, PairConstants};
use lanes::LANES;
use row_lanes::clear_lane;
use schedule::Schedule;

pub(crate) use bodies::SolverBodies;
pub use bodies::{SolverBody, SolverBodyIndex};

/// Settings of the pre-step.
#[derive(Debug, Clone, Copy)]
pub(crate) struct PreStepSettings {
    pub(crate) inverse_dt: f32,
    pub(crate) bias_factor: f32,
    pub(crate) allowed_penetration: f32,
}

/// The contacts of one entry of the arbiter list.
#[derive(Debug, Clone, Copy)]
struct ContactGroup {
    body_a: u32,
    body_b: u32,
    first_contact: u32,
    contact_count: u32,
    friction: f32,
    restitution: f32,
    tangent_speed: f32,
    /// Whether the group must not be solved in parallel with others: it shares its rows with another group, or A and B
    /// are one body.
    is_unbatched: bool,
    /// Whether the group is skipped for the rest of this update, because it made a velocity infinite or NaN.
    is_dropped: bool,
}

/// Position of a contact's row: in `rows`, or in a lane of `simd_rows`.
#[derive(Debug, Clone, Copy, Default)]
struct RowIndex {
    row: u32,
    /// Index of the lane in the SIMD row, or [`LANES`] for a row in `rows`.
    lane: u8,
}

/// Groups that are solved in parallel.
#[derive(Debug, Clone, Copy)]
enum Batch {
    One { group: u32, first_row: u32 },
    Four(SimdBatch),
}

#[derive(Debug, Clone, Copy)]
struct SimdBatch {
    groups: [u32; LANES],
    body_a: [u32; LANES],
    body_b: [u32; LANES],
    pair: PairConstants<f32x4>,
    first_row: u32,
    row_count: u32,
}

/// Minimum number of groups of a SIMD batch: fewer are solved faster one after the other. Chosen; no range measured.
const MIN_GROUPS_FOR_SIMD: u8 = 3;

/// Index of the immovable placeholder body, on which unused lanes work.
const NO_BODY: u32 = 0;

/// The contact solver's arrays, reused from update to update.
#[derive(Debug, Default)]
pub(crate) struct ContactSolver {
    groups: Vec<ContactGroup>,
    contacts: Vec<Contact>,
    /// Position of each contact's row.
    row_indices: Vec<RowIndex>,
    schedule: Schedule,
    batches: Vec<Batch>,
    rows: Vec<ContactRow<f32>>,
    simd_rows: Vec<ContactRow<f32x4>>,
    /// Handle and first contact of every arbiter that was gathered, once each.
    arbiters: Vec<(u32, u32)>,
    /// By handle of the arbiter: stamp of the update, and index of the first group that was made from it.
    arbiter_groups: Vec<(u32, u32)>,
    stamp: u32,
}

reusing_clone! {
    ContactSolver {
        groups, contacts, row_indices, schedule, batches, rows, simd_rows, arbiters, arbiter_groups,
        stamp
    }
}

/// The iterations.
impl ContactSolver {
    /// One iteration over all contacts. The result has the bits of solving them in list order.
    pub(crate) fn solve_iteration(&mut self, bodies: &mut SolverBodies) {
        self.for_each_batch(
            bodies,
            |row, pair, bodies| row.solve::<1>(pair, bodies),
            |row, pair, bodies| row.solve::<1>(pair, bodies),
            |row, pair, bodies| row.solve::<0>(pair, bodies),
        );
    }

    /// Runs one operation on all batches. It is given for four lanes, for one, and for one whose bodies A and B are the
    /// same.
    #[inline(always)]
    fn for_each_batch(
        &mut self,
        all: &mut SolverBodies,
        four: impl Fn(&mut ContactRow<f32x4>, &PairConstants<f32x4>, &mut [BodyLanes<f32x4>; 2]),
        one: impl Fn(&mut ContactRow<f32>, &PairConstants<f32>, &mut [BodyLanes<f32>; 2]),
        one_body: impl Fn(&mut ContactRow<f32>, &PairConstants<f32>, &mut [BodyLanes<f32>; 2]),
    ) {
        for index in 0..self.batches.len() {
            match self.batches[index] {
                Batch::Four(_) => self.apply_to_four(all, index, &four),
                Batch::One { group, first_row } => {
                    let ContactGroup { body_a, body_b, is_dropped, .. } = self.groups[group as usize];
                    if is_dropped {
                        continue;
                    }
                    if body_a == body_b {
                        self.apply_to_one(all, group, first_row, &one_body);
                    } else {
                        self.apply_to_one(all, group, first_row, &one);
                    }
                }
            }
        }
    }

    /// Runs the operation on one group. If it makes a body infinite or NaN, both bodies keep their old velocities, the
    /// group is skipped for the rest of this update, and the body is marked as failed: NaN does not spread.
    #[inline(always)]
    fn apply_to_one(
        &mut self,
        all: &mut SolverBodies,
        group_index: u32,
        first_row: u32,
        operation: impl Fn(&mut ContactRow<f32>, &PairConstants<f32>, &mut [BodyLanes<f32>; 2]),
    ) {
        let group = self.groups[group_index as usize];
        let ContactGroup { friction, restitution, tangent_speed, .. } = group;
        let pair = PairConstants { friction, restitution, tangent_speed };
        let mut bodies = [group.body_a, group.body_b].map(|body| unpack_one(&all.states[body as usize]));
        for row in &mut self.rows[first_row as usize..(first_row + group.contact_count) as usize] {
            operation(row, &pair, &mut bodies);
        }
        let is_finite = [bodies[0].zero_if_finite() == 0.0, bodies[1].zero_if_finite() == 0.0];
        if is_finite == [true; 2] {
            // A is stored last: if both are one body, the operation worked on A's copy.
            all.states[group.body_b as usize] = pack_one(&bodies[1]);
            all.states[group.body_a as usize] = pack_one(&bodies[0]);
        } else {
            self.drop_group(all, group_index, is_finite);
        }
    }

    #[inline(always)]
    fn apply_to_four(
        &mut self,
        all: &mut SolverBodies,
        index: usize,
        operation: impl Fn(&mut ContactRow<f32x4>, &PairConstants<f32x4>, &mut [BodyLanes<f32x4>; 2]),
    ) {
        let Batch::Four(batch) = &self.batches[index] else { return };
        let mut bodies = [unpack_four(&all.states, &batch.body_a), unpack_four(&all.states, &batch.body_b)];
        let rows = batch.first_row as usize..(batch.first_row + batch.row_count) as usize;
        for row in &mut self.simd_rows[rows] {
            operation(row, &batch.pair, &mut bodies);
        }
        let zero = f32x4::splat(0.0);
        let is_finite = bodies.map(|body| body.zero_if_finite().simd_eq(zero).to_bitmask());
        if is_finite == [0b1111; 2] {
            pack_four(&mut all.states, &batch.body_b, &bodies[1]);
            pack_four(&mut all.states, &batch.body_a, &bodies[0]);
        } else {
            self.drop_lanes(all, index, bodies, is_finite);
        }
    }

    /// Removes the lanes with a body that is not finite from a batch; the other lanes continue.
    #[cold]
    fn drop_lanes(
        &mut self,
        all: &mut SolverBodies,
        index: usize,
        bodies: [BodyLanes<f32x4>; 2],
        is_finite: [u32; 2],
    ) {
        let Batch::Four(mut batch) = self.batches[index] else { return };
        for lane in 0..LANES {
            let lane_is_finite = is_finite.map(|mask| mask & (1 << lane) != 0);
            if lane_is_finite != [true; 2] && batch.groups[lane] != u32::MAX {
                self.drop_group(all, batch.groups[lane], lane_is_finite);
                (batch.body_a[lane], batch.body_b[lane]) = (NO_BODY, NO_BODY);
                let rows = batch.first_row as usize..(batch.first_row + batch.row_count) as usize;
                self.simd_rows[rows].iter_mut().for_each(|row| clear_lane(row, lane));
            }
        }
        pack_four(&mut all.states, &batch.body_b, &bodies[1]);
        pack_four(&mut all.states, &batch.body_a, &bodies[0]);
        // Dropped lanes have written values there that are not finite.
        all.states[NO_BODY as usize] = PackedBody::default();
        self.batches[index] = Batch::Four(batch);
    }

    #[cold]
    fn drop_group(&mut self, all: &mut SolverBodies, group_index: u32, is_finite: [bool; 2]) {
        let group = &mut self.groups[group_index as usize];
        group.is_dropped = true;
        all.failed.extend((!is_finite[0]).then_some(group.body_a));
        all.failed.extend((!is_finite[1]).then_some(group.body_b));
    }
}

/// Reading of results.
impl ContactSolver {
    /// Normal and tangent impulse of a contact so far, in mass units · length units/s.
    #[inline]
    fn impulses(&self, contact: u32) -> (f32, f32) {
        let RowIndex { row, lane } = self.row_indices[contact as usize];
        if lane as usize == LANES {
            let row = &self.rows[row as usize];
            return (row.normal_impulse, row.tangent_impulse);
        }
        let row = &self.simd_rows[row as usize];
        (row.normal_impulse.as_array()[lane as usize], row.tangent_impulse.as_array()[lane as usize])
    }

    /// Writes the impulses back.
    pub(crate) fn finish(&mut self, list: &mut ArbiterList) {
        for index in 0..self.arbiters.len() {
            let (handle, first_contact) = self.arbiters[index];
            let group = &self.groups[self.arbiter_groups[handle as usize].1 as usize];
            let ContactGroup { contact_count, is_dropped, .. } = *group;
            let contacts = &mut list.arbiters[handle as usize].contacts;
            // Contacts that a stage called out of order has found since are not among these.
            for (contact, place) in contacts.iter_mut().zip(first_contact..first_contact + contact_count) {
                (contact.normal_impulse, contact.tangent_impulse) =
                    if is_dropped { (0.0, 0.0) } else { self.impulses(place) };
            }
        }
        // Rows and groups stay readable until the next update begins.
        self.arbiters.clear();
    }
}
