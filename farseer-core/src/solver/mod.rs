//! Sequential impulses, the original's solver (behaviour chapter 03, section 6).
//!
//! What the inner loops touch is gathered into tight arrays: the velocities of the bodies that touch something,
//! and a row per contact. Every operation is rounded as in the original. Groups of contacts that share a movable
//! body are solved in its order; groups that do not are solved four at a time.

mod kernel;
mod lanes;
mod schedule;

use wide::f32x4;

use crate::arbiter::ArbiterList;
use crate::arena::{Arena, Id};
use crate::body::BodyId;
use crate::contact::Contact;
use crate::events::Event;
use crate::geom::GeomEntry;
use crate::simulator::BodyEntry;
use kernel::{ContactRow, PairConstants, SolverBody};
use lanes::LANES;
use schedule::Schedule;

/// Settings of the pre-step.
#[derive(Debug, Clone, Copy)]
pub(crate) struct PreStepSettings {
    pub(crate) inverse_dt: f32,
    pub(crate) bias_factor: f32,
    pub(crate) allowed_penetration: f32,
}

/// Contacts of a body with something immovable that has no geom, in the solver of the current update; see
/// [`PhysicsSimulator::add_surface_contacts`](crate::PhysicsSimulator::add_surface_contacts).
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct SurfaceContacts {
    surface: u32,
}

/// Contacts with a surface that wait for the pre-step.
#[derive(Debug, Clone, Copy)]
struct Surface {
    body: BodyId,
    first_contact: u32,
    contact_count: u32,
    friction: f32,
    restitution: f32,
}

/// The contacts of one entry of the arbiter list, or of a surface.
#[derive(Debug, Clone, Copy)]
struct Group {
    body_a: u32,
    body_b: u32,
    first_contact: u32,
    contact_count: u32,
    friction: f32,
    restitution: f32,
    /// Not to be solved side by side with others: it shares its rows with another group, or A and B are one body.
    is_alone: bool,
    /// It made a velocity infinite or NaN, and is out of this update.
    is_dropped: bool,
}

/// Where a row is: alone, or in a lane of rows of four.
#[derive(Debug, Clone, Copy, Default)]
struct RowPlace {
    row: u32,
    /// [`LANES`] for a row that is alone.
    lane: u8,
}

/// Groups that are solved together.
#[derive(Debug, Clone, Copy)]
enum Batch {
    One { group: u32, first_row: u32 },
    Four(WideBatch),
}

#[derive(Debug, Clone, Copy)]
struct WideBatch {
    groups: [u32; LANES],
    body_a: [u32; LANES],
    body_b: [u32; LANES],
    pair: PairConstants<f32x4>,
    first_row: u32,
    row_count: u32,
}

/// Fewer groups than this are solved faster one after the other.
const MIN_LANES_USED: u8 = 3;

/// Place of the immovable body that surfaces belong to, and that unused lanes work on.
const SURFACE: u32 = 0;

/// The velocities of a body with its inverse mass, and the bias velocities with its inverse inertia.
type BodyState = [f32x4; 2];

/// The arrays of the solver, reused from update to update.
#[derive(Debug, Clone, Default)]
pub(crate) struct ContactSolver {
    /// The immovable body of the surfaces, then the bodies that touch something.
    states: Vec<BodyState>,
    positions: Vec<[f32; 2]>,
    /// Whether the groups of a body must keep their order.
    is_ordered: Vec<bool>,
    /// Ids of the bodies behind the first.
    ids: Vec<BodyId>,
    /// By slot of the body: stamp of the update in which it was gathered, and where to.
    places: Vec<(u32, u32)>,
    groups: Vec<Group>,
    contacts: Vec<Contact>,
    /// Where each contact's row is.
    row_places: Vec<RowPlace>,
    schedule: Schedule,
    batches: Vec<Batch>,
    rows: Vec<ContactRow<f32>>,
    wide_rows: Vec<ContactRow<f32x4>>,
    /// Handle and first contact of every arbiter that was gathered, once each.
    arbiters: Vec<(u32, u32)>,
    /// By handle of the arbiter: stamp of the update, and the group that was made from it first.
    arbiter_groups: Vec<(u32, u32)>,
    surfaces: Vec<Surface>,
    surface_contacts: Vec<Contact>,
    /// The groups of the surfaces begin here.
    first_surface_group: usize,
    stamp: u32,
    failed: Vec<u32>,
}

/// Gathering.
impl ContactSolver {
    /// Number of contacts the solver works on in every iteration.
    pub(crate) fn row_count(&self) -> usize {
        self.groups.iter().map(|group| group.contact_count as usize).sum()
    }

    /// Notes contacts of a body with something immovable for the next pre-step.
    pub(crate) fn add_surface(
        &mut self,
        body: BodyId,
        contacts: &[Contact],
        friction: f32,
        restitution: f32,
    ) -> SurfaceContacts {
        let surface = SurfaceContacts { surface: self.surfaces.len() as u32 };
        let first_contact = self.surface_contacts.len() as u32;
        self.surface_contacts.extend_from_slice(contacts);
        let contact_count = contacts.len() as u32;
        self.surfaces.push(Surface { body, first_contact, contact_count, friction, restitution });
        surface
    }

    /// Forgets surfaces that were noted for an update that did not come about.
    pub(crate) fn forget_surfaces(&mut self) {
        self.surfaces.clear();
        self.surface_contacts.clear();
    }

    /// Gathers bodies and contacts, computes masses and biases and applies the impulses of the last update,
    /// contact by contact: later contacts see what earlier ones did.
    pub(crate) fn pre_step(
        &mut self,
        list: &ArbiterList,
        geoms: &Arena<GeomEntry>,
        bodies: &Arena<BodyEntry>,
        settings: PreStepSettings,
    ) {
        self.begin(bodies.slot_count(), list.arbiters.len());
        for &handle in &list.list {
            self.gather_arbiter(handle, list, geoms, bodies);
        }
        self.first_surface_group = self.groups.len();
        self.gather_surfaces(bodies);
        self.schedule.build(&self.groups, &self.is_ordered);
        self.make_rows();
        self.for_each_batch(
            |row, pair, bodies| row.pre_step::<1>(pair, settings, bodies),
            |row, pair, bodies| row.pre_step::<1>(pair, settings, bodies),
            |row, pair, bodies| row.pre_step::<0>(pair, settings, bodies),
        );
    }

    fn begin(&mut self, body_slots: usize, arbiter_count: usize) {
        self.stamp = self.stamp.wrapping_add(1);
        if self.stamp == 0 {
            self.places.fill((0, 0));
            self.arbiter_groups.fill((0, 0));
            self.stamp = 1;
        }
        self.places.resize(body_slots, (0, 0));
        self.arbiter_groups.resize(arbiter_count, (0, 0));
        self.states.clear();
        self.states.push(BodyState::default());
        self.positions.clear();
        self.positions.push([0.0; 2]);
        self.is_ordered.clear();
        self.is_ordered.push(false);
        self.ids.clear();
        self.groups.clear();
        self.contacts.clear();
        self.arbiters.clear();
        self.failed.clear();
    }

    fn gather_arbiter(
        &mut self,
        handle: u32,
        list: &ArbiterList,
        geoms: &Arena<GeomEntry>,
        bodies: &Arena<BodyEntry>,
    ) {
        let arbiter = &list.arbiters[handle as usize];
        let Some((a, b)) = arbiter.geoms else { return };
        let (a, b) = (&geoms[a], &geoms[b]);
        if !a.geom.collision_response_enabled || !b.geom.collision_response_enabled {
            return;
        }
        let body_a = self.gather_body(a.body, bodies);
        let body_b = self.gather_body(b.body, bodies);
        let (stamp, first_group) = self.arbiter_groups[handle as usize];
        let is_repeated = stamp == self.stamp;
        let first_contact = if is_repeated {
            self.groups[first_group as usize].is_alone = true;
            self.groups[first_group as usize].first_contact
        } else {
            self.arbiter_groups[handle as usize] = (self.stamp, self.groups.len() as u32);
            self.arbiters.push((handle, self.contacts.len() as u32));
            self.contacts.extend_from_slice(&arbiter.contacts);
            (self.contacts.len() - arbiter.contacts.len()) as u32
        };
        self.groups.push(Group {
            body_a,
            body_b,
            first_contact,
            contact_count: arbiter.contacts.len() as u32,
            friction: arbiter.friction,
            restitution: (a.geom.restitution_coefficient + b.geom.restitution_coefficient) * 0.5,
            is_alone: is_repeated || body_a == body_b,
            is_dropped: false,
        });
    }

    fn gather_surfaces(&mut self, bodies: &Arena<BodyEntry>) {
        for index in 0..self.surfaces.len() {
            let Surface { body, first_contact, contact_count, friction, restitution } = self.surfaces[index];
            let body_b = self.gather_body(body, bodies);
            let gathered = self.contacts.len() as u32;
            let contacts = first_contact as usize..(first_contact + contact_count) as usize;
            self.contacts.extend_from_slice(&self.surface_contacts[contacts]);
            self.groups.push(Group {
                body_a: SURFACE,
                body_b,
                first_contact: gathered,
                contact_count,
                friction,
                restitution,
                is_alone: false,
                is_dropped: false,
            });
        }
        self.forget_surfaces();
    }

    fn gather_body(&mut self, id: BodyId, bodies: &Arena<BodyEntry>) -> u32 {
        let place = &mut self.places[id.index()];
        if place.0 != self.stamp {
            *place = (self.stamp, self.states.len() as u32);
            let body = &bodies[id].body;
            let (v, bias) = (body.linear_velocity, body.linear_velocity_bias);
            let (w, bias_w) = (body.angular_velocity, body.angular_velocity_bias);
            self.ids.push(id);
            self.states.push([
                f32x4::new([v.x, v.y, w, body.inverse_mass]),
                f32x4::new([bias.x, bias.y, bias_w, body.inverse_moment_of_inertia]),
            ]);
            self.positions.push([body.position.x, body.position.y]);
            // Impulses add zero to an immovable body, which changes nothing but a negative zero.
            let is_immovable = body.inverse_mass == 0.0 && body.inverse_moment_of_inertia == 0.0;
            let zeros = [v.x, v.y, w, bias.x, bias.y, bias_w];
            let has_negative_zero = zeros.iter().any(|value| value.to_bits() == (-0.0f32).to_bits());
            self.is_ordered.push(!is_immovable || has_negative_zero);
        }
        place.1
    }

    /// Lays the rows out in the order in which they are solved.
    fn make_rows(&mut self) {
        self.batches.clear();
        self.rows.clear();
        self.wide_rows.clear();
        self.row_places.clear();
        self.row_places.resize(self.contacts.len(), RowPlace::default());
        for index in 0..self.schedule.batches.len() {
            let batch = self.schedule.batches[index];
            if batch.length >= MIN_LANES_USED {
                self.make_wide_batch(batch.groups(), batch.row_count);
            } else {
                for &group in batch.groups() {
                    self.make_single_batch(group);
                }
            }
        }
    }

    fn make_single_batch(&mut self, index: u32) {
        let group = self.groups[index as usize];
        // A group that shares its contacts with an earlier one finds their rows there.
        let shared =
            self.row_places.get(group.first_contact as usize).filter(|place| place.lane as usize == LANES);
        let first_row = match shared {
            Some(place) if group.is_alone => place.row,
            _ => self.rows.len() as u32,
        };
        if first_row as usize == self.rows.len() {
            for contact in group.first_contact..group.first_contact + group.contact_count {
                self.row_places[contact as usize] =
                    RowPlace { row: self.rows.len() as u32, lane: LANES as u8 };
                self.rows.push(self.single_row(&group, contact));
            }
        }
        self.batches.push(Batch::One { group: index, first_row });
    }

    fn single_row(&self, group: &Group, contact: u32) -> ContactRow<f32> {
        let contact = &self.contacts[contact as usize];
        let offset = |body: u32| {
            let position = self.positions[body as usize];
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

    fn make_wide_batch(&mut self, group_indices: &[u32], row_count: u32) {
        let mut batch = WideBatch {
            groups: [u32::MAX; LANES],
            body_a: [SURFACE; LANES],
            body_b: [SURFACE; LANES],
            pair: PairConstants::default(),
            first_row: self.wide_rows.len() as u32,
            row_count,
        };
        let (mut friction, mut restitution) = ([0.0; LANES], [0.0; LANES]);
        let mut rows = [ContactRow::<f32>::default(); LANES];
        for (lane, &index) in group_indices.iter().enumerate() {
            let group = &self.groups[index as usize];
            (batch.groups[lane], batch.body_a[lane], batch.body_b[lane]) =
                (index, group.body_a, group.body_b);
            (friction[lane], restitution[lane]) = (group.friction, group.restitution);
        }
        for row in 0..row_count {
            for (lane, &index) in group_indices.iter().enumerate() {
                let group = self.groups[index as usize];
                let contact = group.first_contact + row;
                rows[lane] = self.single_row(&group, contact);
                self.row_places[contact as usize] =
                    RowPlace { row: self.wide_rows.len() as u32, lane: lane as u8 };
            }
            self.wide_rows.push(side_by_side(&rows));
        }
        batch.pair = PairConstants { friction: f32x4::new(friction), restitution: f32x4::new(restitution) };
        self.batches.push(Batch::Four(batch));
    }
}

/// Four rows as one of four lanes, before the pre-step.
fn side_by_side(rows: &[ContactRow<f32>; LANES]) -> ContactRow<f32x4> {
    let lanes = |field: fn(&ContactRow<f32>) -> f32| f32x4::new([0, 1, 2, 3].map(|lane| field(&rows[lane])));
    ContactRow {
        normal: [lanes(|row| row.normal[0]), lanes(|row| row.normal[1])],
        r1: [lanes(|row| row.r1[0]), lanes(|row| row.r1[1])],
        r2: [lanes(|row| row.r2[0]), lanes(|row| row.r2[1])],
        separation: lanes(|row| row.separation),
        normal_impulse: lanes(|row| row.normal_impulse),
        tangent_impulse: lanes(|row| row.tangent_impulse),
        ..ContactRow::default()
    }
}

/// Solving.
impl ContactSolver {
    /// One pass over all contacts, in an order that gives the bits of list order.
    pub(crate) fn solve_iteration(&mut self) {
        self.for_each_batch(
            |row, pair, bodies| row.solve::<1>(pair, bodies),
            |row, pair, bodies| row.solve::<1>(pair, bodies),
            |row, pair, bodies| row.solve::<0>(pair, bodies),
        );
    }

    /// Runs one operation, given for four lanes, for one, and for one whose bodies A and B are the same.
    #[inline(always)]
    fn for_each_batch(
        &mut self,
        four: impl Fn(&mut ContactRow<f32x4>, &PairConstants<f32x4>, &mut [SolverBody<f32x4>; 2]),
        one: impl Fn(&mut ContactRow<f32>, &PairConstants<f32>, &mut [SolverBody<f32>; 2]),
        one_body: impl Fn(&mut ContactRow<f32>, &PairConstants<f32>, &mut [SolverBody<f32>; 2]),
    ) {
        for index in 0..self.batches.len() {
            match self.batches[index] {
                Batch::Four(_) => self.apply_to_four(index, &four),
                Batch::One { group, first_row } => {
                    let Group { body_a, body_b, is_dropped, .. } = self.groups[group as usize];
                    if is_dropped {
                        continue;
                    }
                    if body_a == body_b {
                        self.apply_to_one(group, first_row, &one_body);
                    } else {
                        self.apply_to_one(group, first_row, &one);
                    }
                }
            }
        }
    }

    /// Should the operation make a body infinite or NaN, both bodies keep what they had before, the group is out
    /// of this update, and the body is noted as failed: nothing spreads.
    #[inline(always)]
    fn apply_to_one(
        &mut self,
        group_index: u32,
        first_row: u32,
        operation: impl Fn(&mut ContactRow<f32>, &PairConstants<f32>, &mut [SolverBody<f32>; 2]),
    ) {
        let group = self.groups[group_index as usize];
        let pair = PairConstants { friction: group.friction, restitution: group.restitution };
        let mut bodies = [group.body_a, group.body_b].map(|body| unpack_one(&self.states[body as usize]));
        for row in &mut self.rows[first_row as usize..(first_row + group.contact_count) as usize] {
            operation(row, &pair, &mut bodies);
        }
        let is_finite = [bodies[0].zero_if_finite() == 0.0, bodies[1].zero_if_finite() == 0.0];
        if is_finite == [true; 2] {
            // A last: where both are one body, its copy is the one that was worked on.
            self.states[group.body_b as usize] = pack_one(&bodies[1]);
            self.states[group.body_a as usize] = pack_one(&bodies[0]);
        } else {
            self.drop_group(group_index, is_finite);
        }
    }

    #[inline(always)]
    fn apply_to_four(
        &mut self,
        index: usize,
        operation: impl Fn(&mut ContactRow<f32x4>, &PairConstants<f32x4>, &mut [SolverBody<f32x4>; 2]),
    ) {
        let Batch::Four(batch) = &self.batches[index] else { return };
        let mut bodies = [unpack_four(&self.states, &batch.body_a), unpack_four(&self.states, &batch.body_b)];
        let rows = batch.first_row as usize..(batch.first_row + batch.row_count) as usize;
        for row in &mut self.wide_rows[rows] {
            operation(row, &batch.pair, &mut bodies);
        }
        let zero = f32x4::splat(0.0);
        let is_finite = bodies.map(|body| body.zero_if_finite().simd_eq(zero).to_bitmask());
        if is_finite == [0b1111; 2] {
            pack_four(&mut self.states, &batch.body_b, &bodies[1]);
            pack_four(&mut self.states, &batch.body_a, &bodies[0]);
        } else {
            self.drop_lanes(index, bodies, is_finite);
        }
    }

    /// Takes the lanes with a body that is not finite out of a batch, and lets the others go on.
    #[cold]
    fn drop_lanes(&mut self, index: usize, bodies: [SolverBody<f32x4>; 2], is_finite: [u32; 2]) {
        let Batch::Four(mut batch) = self.batches[index] else { return };
        for lane in 0..LANES {
            let lane_is_finite = is_finite.map(|mask| mask & (1 << lane) != 0);
            if lane_is_finite != [true; 2] && batch.groups[lane] != u32::MAX {
                self.drop_group(batch.groups[lane], lane_is_finite);
                (batch.body_a[lane], batch.body_b[lane]) = (SURFACE, SURFACE);
                let rows = batch.first_row as usize..(batch.first_row + batch.row_count) as usize;
                self.wide_rows[rows].iter_mut().for_each(|row| empty_lane(row, lane));
            }
        }
        pack_four(&mut self.states, &batch.body_b, &bodies[1]);
        pack_four(&mut self.states, &batch.body_a, &bodies[0]);
        // Dropped lanes have written what is not finite there.
        self.states[SURFACE as usize] = BodyState::default();
        self.batches[index] = Batch::Four(batch);
    }

    #[cold]
    fn drop_group(&mut self, group_index: u32, is_finite: [bool; 2]) {
        let group = &mut self.groups[group_index as usize];
        group.is_dropped = true;
        self.failed.extend((!is_finite[0]).then_some(group.body_a));
        self.failed.extend((!is_finite[1]).then_some(group.body_b));
    }
}

#[inline(always)]
fn unpack_one(state: &BodyState) -> SolverBody<f32> {
    let [x, y, w, inverse_mass] = state[0].to_array();
    let [bias_x, bias_y, bias_w, inverse_inertia] = state[1].to_array();
    SolverBody { velocity: [x, y, w], bias: [bias_x, bias_y, bias_w], inverse_mass, inverse_inertia }
}

#[inline(always)]
fn pack_one(body: &SolverBody<f32>) -> BodyState {
    let ([x, y, w], [bias_x, bias_y, bias_w]) = (body.velocity, body.bias);
    [f32x4::new([x, y, w, body.inverse_mass]), f32x4::new([bias_x, bias_y, bias_w, body.inverse_inertia])]
}

#[inline(always)]
fn unpack_four(states: &[BodyState], bodies: &[u32; LANES]) -> SolverBody<f32x4> {
    let lanes = bodies.map(|body| states[body as usize]);
    let [x, y, w, inverse_mass] = f32x4::transpose(lanes.map(|state| state[0]));
    let [bias_x, bias_y, bias_w, inverse_inertia] = f32x4::transpose(lanes.map(|state| state[1]));
    SolverBody { velocity: [x, y, w], bias: [bias_x, bias_y, bias_w], inverse_mass, inverse_inertia }
}

/// Immovable bodies may be in several lanes: all write what was there before.
#[inline(always)]
fn pack_four(states: &mut [BodyState], bodies: &[u32; LANES], body: &SolverBody<f32x4>) {
    let ([x, y, w], [bias_x, bias_y, bias_w]) = (body.velocity, body.bias);
    let velocities = f32x4::transpose([x, y, w, body.inverse_mass]);
    let biases = f32x4::transpose([bias_x, bias_y, bias_w, body.inverse_inertia]);
    for lane in 0..LANES {
        states[bodies[lane] as usize] = [velocities[lane], biases[lane]];
    }
}

/// Lets a lane do nothing.
fn empty_lane(row: &mut ContactRow<f32x4>, lane: usize) {
    let ContactRow {
        normal: [normal_x, normal_y],
        r1: [r1_x, r1_y],
        r2: [r2_x, r2_y],
        normal_mass,
        tangent_mass,
        separation,
        target_bias,
        bounce_velocity,
        normal_impulse,
        tangent_impulse,
        bias_impulse,
    } = row;
    let offsets = [normal_x, normal_y, r1_x, r1_y, r2_x, r2_y];
    let numbers = [normal_mass, tangent_mass, separation, target_bias, bounce_velocity];
    let impulses = [normal_impulse, tangent_impulse, bias_impulse];
    for field in offsets.into_iter().chain(numbers).chain(impulses) {
        let mut lanes = field.to_array();
        lanes[lane] = 0.0;
        *field = f32x4::new(lanes);
    }
}

/// Results.
impl ContactSolver {
    /// Normal and tangent impulse of a contact as the solver has them now.
    #[inline]
    fn impulses(&self, contact: u32) -> (f32, f32) {
        let RowPlace { row, lane } = self.row_places[contact as usize];
        if lane as usize == LANES {
            let row = &self.rows[row as usize];
            return (row.normal_impulse, row.tangent_impulse);
        }
        let row = &self.wide_rows[row as usize];
        (row.normal_impulse.as_array()[lane as usize], row.tangent_impulse.as_array()[lane as usize])
    }

    /// Normal and tangent impulse of every contact of a surface; none once the next update has begun.
    pub(crate) fn surface_impulses(&self, surface: SurfaceContacts) -> impl Iterator<Item = (f32, f32)> + '_ {
        let group = self.groups.get(self.first_surface_group + surface.surface as usize);
        let contacts =
            group.map_or(0..0, |group| group.first_contact..group.first_contact + group.contact_count);
        let is_dropped = group.is_some_and(|group| group.is_dropped);
        contacts.map(move |contact| if is_dropped { (0.0, 0.0) } else { self.impulses(contact) })
    }

    /// Writes velocities and impulses back. Bodies that failed keep the velocities with which the solver began;
    /// the dynamic ones are disabled.
    pub(crate) fn finish(
        &mut self,
        list: &mut ArbiterList,
        bodies: &mut Arena<BodyEntry>,
        events: &mut Vec<Event>,
    ) {
        self.failed.sort_unstable();
        self.failed.dedup();
        for (place, (&id, state)) in (1u32..).zip(self.ids.iter().zip(self.states.iter().skip(1))) {
            // Stages called out of order may have let a body go.
            let Some(BodyEntry { body, .. }) = bodies.get_mut(id) else { continue };
            if self.failed.binary_search(&place).is_ok() {
                let disabled = !body.is_static();
                body.set_enabled(body.enabled() && !disabled);
                events.push(Event::NotFinite { body: id, disabled });
                continue;
            }
            let SolverBody { velocity, bias, .. } = unpack_one(state);
            [body.linear_velocity.x, body.linear_velocity.y, body.angular_velocity] = velocity;
            [body.linear_velocity_bias.x, body.linear_velocity_bias.y, body.angular_velocity_bias] = bias;
        }
        for index in 0..self.arbiters.len() {
            let (handle, first_contact) = self.arbiters[index];
            let is_dropped = self.groups[self.arbiter_groups[handle as usize].1 as usize].is_dropped;
            let contacts = &mut list.arbiters[handle as usize].contacts;
            for (contact, place) in contacts.iter_mut().zip(first_contact..) {
                (contact.normal_impulse, contact.tangent_impulse) =
                    if is_dropped { (0.0, 0.0) } else { self.impulses(place) };
            }
        }
        // Rows and groups stay readable until the next update begins.
        self.ids.clear();
        self.arbiters.clear();
    }
}
