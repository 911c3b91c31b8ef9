//! Preparation of an update: gathers arbiters and bodies, schedules them and builds the rows in solving order.

use wide::f32x4;

use super::kernel::{ContactRow, PairConstants};
use super::lanes::LANES;
use super::row_lanes::pack_rows;
use super::{
    Batch, ContactGroup, ContactSolver, MIN_GROUPS_FOR_SIMD, NO_BODY, PreStepSettings, RowIndex, SimdBatch,
    SolverBodies,
};
use crate::body::entry::Bodies;
use crate::contacts::arbiter::ArbiterList;
use crate::geom::entry::Geoms;
use farseer_precise::surface::mix_restitution;

impl ContactSolver {
    /// Number of contacts that the solver works on in every iteration.
    pub(crate) fn row_count(&self) -> usize {
        self.groups.iter().map(|group| group.contact_count as usize).sum()
    }

    /// Gathers bodies and contacts, computes effective masses and biases and applies the warm start, contact by
    /// contact: later contacts see the velocities that earlier ones changed.
    pub(crate) fn pre_step(
        &mut self,
        list: &ArbiterList,
        geoms: &Geoms,
        bodies: &Bodies,
        solved: &mut SolverBodies,
        settings: PreStepSettings,
    ) {
        solved.begin(bodies.slot_count());
        self.begin(list.arbiters.len());
        for &handle in list.list.iter().filter(|&&handle| !list.is_left_to_engine(handle)) {
            self.gather_arbiter(handle, list, geoms, bodies, solved);
        }
        self.schedule.build(&self.groups, &solved.is_ordered);
        self.make_rows(&solved.positions);
        self.for_each_batch(
            solved,
            |row, pair, bodies| row.pre_step::<1>(pair, settings, bodies),
            |row, pair, bodies| row.pre_step::<1>(pair, settings, bodies),
            |row, pair, bodies| row.pre_step::<0>(pair, settings, bodies),
        );
    }

    fn begin(&mut self, arbiter_count: usize) {
        self.stamp = self.stamp.wrapping_add(1);
        if self.stamp == 0 {
            self.arbiter_groups.fill((0, 0));
            self.stamp = 1;
        }
        self.arbiter_groups.resize(arbiter_count, (0, 0));
        self.groups.clear();
        self.contacts.clear();
        self.arbiters.clear();
    }

    fn gather_arbiter(
        &mut self,
        handle: u32,
        list: &ArbiterList,
        geoms: &Geoms,
        bodies: &Bodies,
        solved: &mut SolverBodies,
    ) {
        let arbiter = &list.arbiters[handle as usize];
        let Some((a, b)) = arbiter.geoms else { return };
        let (a, b) = (&geoms[a], &geoms[b]);
        if !a.geom.collision_response_enabled || !b.geom.collision_response_enabled {
            return;
        }
        let body_a = solved.gather(a.body, bodies);
        let body_b = solved.gather(b.body, bodies);
        let (stamp, first_group) = self.arbiter_groups[handle as usize];
        let is_repeated = stamp == self.stamp;
        let first_contact = if is_repeated {
            self.groups[first_group as usize].is_unbatched = true;
            self.groups[first_group as usize].first_contact
        } else {
            self.arbiter_groups[handle as usize] = (self.stamp, self.groups.len() as u32);
            self.arbiters.push((handle, self.contacts.len() as u32));
            self.contacts.extend_from_slice(&arbiter.contacts);
            (self.contacts.len() - arbiter.contacts.len()) as u32
        };
        let set = list.surface(handle);
        self.groups.push(ContactGroup {
            body_a,
            body_b,
            first_contact,
            contact_count: arbiter.contacts.len() as u32,
            friction: set.friction.unwrap_or(arbiter.friction),
            restitution: set.restitution.unwrap_or_else(|| {
                mix_restitution(a.geom.restitution_coefficient, b.geom.restitution_coefficient)
            }),
            tangent_speed: set.tangent_speed.unwrap_or(0.0),
            is_unbatched: is_repeated || body_a == body_b,
            is_dropped: false,
        });
    }

    /// Builds the rows in the order in which they are solved.
    fn make_rows(&mut self, positions: &[[f32; 2]]) {
        self.batches.clear();
        self.rows.clear();
        self.simd_rows.clear();
        self.row_indices.clear();
        self.row_indices.resize(self.contacts.len(), RowIndex::default());
        for index in 0..self.schedule.batches.len() {
            let batch = self.schedule.batches[index];
            if batch.length >= MIN_GROUPS_FOR_SIMD {
                self.make_simd_batch(batch.groups(), batch.row_count, positions);
            } else {
                for &group in batch.groups() {
                    self.make_single_batch(group, positions);
                }
            }
        }
    }

    fn make_single_batch(&mut self, index: u32, positions: &[[f32; 2]]) {
        let group = self.groups[index as usize];
        // A group that shares its contacts with an earlier one uses the same rows.
        let shared =
            self.row_indices.get(group.first_contact as usize).filter(|place| place.lane as usize == LANES);
        let first_row = match shared {
            Some(place) if group.is_unbatched => place.row,
            _ => self.rows.len() as u32,
        };
        if first_row as usize == self.rows.len() {
            for contact in group.first_contact..group.first_contact + group.contact_count {
                self.row_indices[contact as usize] =
                    RowIndex { row: self.rows.len() as u32, lane: LANES as u8 };
                self.rows.push(self.single_row(&group, contact, positions));
            }
        }
        self.batches.push(Batch::One { group: index, first_row });
    }

    fn single_row(&self, group: &ContactGroup, contact: u32, positions: &[[f32; 2]]) -> ContactRow<f32> {
        let contact = &self.contacts[contact as usize];
        let offset = |body: u32| {
            let position = positions[body as usize];
            [contact.position.x - position[0], contact.position.y - position[1]]
        };
        ContactRow {
            normal: [contact.normal.x, contact.normal.y],
            r1: offset(group.body_a),
            r2: offset(group.body_b),
            separation: contact.separation,
            normal_impulse: contact.normal_impulse,
            tangent_impulse: contact.tangent_impulse,
            ..ContactRow::default()
        }
    }

    fn make_simd_batch(&mut self, group_indices: &[u32], row_count: u32, positions: &[[f32; 2]]) {
        let mut batch = SimdBatch {
            groups: [u32::MAX; LANES],
            body_a: [NO_BODY; LANES],
            body_b: [NO_BODY; LANES],
            pair: PairConstants::default(),
            first_row: self.simd_rows.len() as u32,
            row_count,
        };
        let [mut friction, mut restitution, mut tangent_speed] = [[0.0; LANES]; 3];
        let mut rows = [ContactRow::<f32>::default(); LANES];
        for (lane, &index) in group_indices.iter().enumerate() {
            let group = &self.groups[index as usize];
            (batch.groups[lane], batch.body_a[lane], batch.body_b[lane]) =
                (index, group.body_a, group.body_b);
            (friction[lane], restitution[lane]) = (group.friction, group.restitution);
            tangent_speed[lane] = group.tangent_speed;
        }
        for row in 0..row_count {
            for (lane, &index) in group_indices.iter().enumerate() {
                let group = self.groups[index as usize];
                let contact = group.first_contact + row;
                rows[lane] = self.single_row(&group, contact, positions);
                self.row_indices[contact as usize] =
                    RowIndex { row: self.simd_rows.len() as u32, lane: lane as u8 };
            }
            self.simd_rows.push(pack_rows(&rows));
        }
        batch.pair = PairConstants {
            friction: f32x4::new(friction),
            restitution: f32x4::new(restitution),
            tangent_speed: f32x4::new(tangent_speed),
        };
        self.batches.push(Batch::Four(batch));
    }
}
