//! Sequential impulses, the original's solver (behaviour chapter 03, section 6).
//!
//! What the inner loops touch is gathered into tight arrays: the velocities of the bodies that touch something,
//! and one row per contact. Every operation is rounded as in the original, in its order.

mod contact_row;

use crate::arbiter::ArbiterList;
use crate::arena::{Arena, Id};
use crate::body::BodyId;
use crate::contact::Contact;
use crate::events::Event;
use crate::geom::GeomEntry;
use crate::simulator::BodyEntry;
use contact_row::{ContactRow, PairConstants};

/// What the solver reads and changes of a body.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub(crate) struct SolverBody {
    /// Linear and angular velocity.
    velocity: [f32; 3],
    /// Linear and angular velocity that only pushes overlapping bodies apart.
    bias: [f32; 3],
    position: [f32; 2],
    inverse_mass: f32,
    inverse_inertia: f32,
}

impl SolverBody {
    #[inline(always)]
    fn is_finite(&self) -> bool {
        let [x, y, w] = self.velocity;
        let [bias_x, bias_y, bias_w] = self.bias;
        // Any infinity or NaN makes a product, and with it the sum, NaN.
        x * 0.0 + y * 0.0 + w * 0.0 + bias_x * 0.0 + bias_y * 0.0 + bias_w * 0.0 == 0.0
    }
}

/// One entry of the arbiter list with contacts and response.
#[derive(Debug, Clone, Copy)]
struct Group {
    body_a: u32,
    body_b: u32,
    first_row: u32,
    row_count: u32,
    friction: f32,
    restitution: f32,
}

/// Settings of the pre-step.
#[derive(Debug, Clone, Copy)]
pub(crate) struct PreStepSettings {
    pub(crate) inverse_dt: f32,
    pub(crate) bias_factor: f32,
    pub(crate) allowed_penetration: f32,
}

/// Where an arbiter's rows lie; the list may hold an arbiter twice, which then shares them.
#[derive(Debug, Clone, Copy, Default)]
struct RowRange {
    stamp: u32,
    first_row: u32,
}

/// Contacts of a body with something immovable that has no geom, in the solver of the current update; see
/// [`PhysicsSimulator::add_surface_contacts`](crate::PhysicsSimulator::add_surface_contacts).
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct SurfaceContacts {
    first_row: u32,
    row_count: u32,
}

/// Place of the immovable body that surfaces belong to.
const SURFACE: u32 = 0;

/// The arrays of the solver, reused from update to update.
#[derive(Debug, Clone, Default)]
pub(crate) struct ContactSolver {
    /// The immovable body that surfaces belong to, then those that touch something.
    bodies: Vec<SolverBody>,
    /// Ids of the bodies behind the first.
    ids: Vec<BodyId>,
    /// By index of the body: stamp of the update in which it was gathered, and where to.
    places: Vec<(u32, u32)>,
    groups: Vec<Group>,
    rows: Vec<ContactRow>,
    row_ranges: Vec<RowRange>,
    /// Arbiters in the order of their rows.
    arbiters: Vec<u32>,
    stamp: u32,
    failed: Vec<u32>,
}

impl ContactSolver {
    /// Number of contacts the solver works on in every iteration.
    pub(crate) fn row_count(&self) -> usize {
        self.groups.iter().map(|group| group.row_count as usize).sum()
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
            self.gather(handle, list, geoms, bodies);
        }
        for group in 0..self.groups.len() {
            self.pre_step_group(group, settings);
        }
    }

    fn pre_step_group(&mut self, group: usize, settings: PreStepSettings) {
        if self.groups[group].body_a == self.groups[group].body_b {
            self.apply(group, |row, pair, bodies| row.pre_step::<0>(pair, settings, bodies));
        } else {
            self.apply(group, |row, pair, bodies| row.pre_step::<1>(pair, settings, bodies));
        }
    }

    /// Appends contacts of a body with something immovable, and lets their impulses of the last update act.
    pub(crate) fn add_surface(
        &mut self,
        body: BodyId,
        bodies: &Arena<BodyEntry>,
        contacts: &[Contact],
        (friction, restitution): (f32, f32),
        settings: PreStepSettings,
    ) -> SurfaceContacts {
        self.places.resize(bodies.slot_count(), (0, 0));
        let body_b = self.gather_body(body, bodies);
        let surface = SurfaceContacts { first_row: self.rows.len() as u32, row_count: contacts.len() as u32 };
        self.rows.extend(contacts.iter().map(ContactRow::new));
        let SurfaceContacts { first_row, row_count } = surface;
        self.groups.push(Group { body_a: SURFACE, body_b, first_row, row_count, friction, restitution });
        self.pre_step_group(self.groups.len() - 1, settings);
        surface
    }

    /// Normal and tangent impulse of every contact of a surface; none once the next update has begun.
    pub(crate) fn surface_impulses(&self, surface: SurfaceContacts) -> impl Iterator<Item = (f32, f32)> + '_ {
        let rows = surface.first_row as usize..(surface.first_row + surface.row_count) as usize;
        self.rows.get(rows).unwrap_or_default().iter().map(ContactRow::impulses)
    }

    fn begin(&mut self, body_slots: usize, arbiter_count: usize) {
        self.stamp = self.stamp.wrapping_add(1);
        if self.stamp == 0 {
            self.places.fill((0, 0));
            self.row_ranges.fill(RowRange::default());
            self.stamp = 1;
        }
        self.places.resize(body_slots, (0, 0));
        self.row_ranges.resize(arbiter_count, RowRange::default());
        self.bodies.clear();
        self.bodies.push(SolverBody::default());
        self.ids.clear();
        self.groups.clear();
        self.rows.clear();
        self.arbiters.clear();
        self.failed.clear();
    }

    fn gather(
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
        let range = &mut self.row_ranges[handle as usize];
        if range.stamp != self.stamp {
            *range = RowRange { stamp: self.stamp, first_row: self.rows.len() as u32 };
            self.arbiters.push(handle);
            self.rows.extend(arbiter.contacts.iter().map(ContactRow::new));
        }
        self.groups.push(Group {
            body_a,
            body_b,
            first_row: range.first_row,
            row_count: arbiter.contacts.len() as u32,
            friction: arbiter.friction,
            restitution: (a.geom.restitution_coefficient + b.geom.restitution_coefficient) * 0.5,
        });
    }

    fn gather_body(&mut self, id: BodyId, bodies: &Arena<BodyEntry>) -> u32 {
        let place = &mut self.places[id.index()];
        if place.0 != self.stamp {
            *place = (self.stamp, self.bodies.len() as u32);
            let body = &bodies[id].body;
            self.ids.push(id);
            self.bodies.push(SolverBody {
                velocity: [body.linear_velocity.x, body.linear_velocity.y, body.angular_velocity],
                bias: [body.linear_velocity_bias.x, body.linear_velocity_bias.y, body.angular_velocity_bias],
                position: [body.position.x, body.position.y],
                inverse_mass: body.inverse_mass,
                inverse_inertia: body.inverse_moment_of_inertia,
            });
        }
        place.1
    }

    /// One pass over all contacts, in list order.
    pub(crate) fn solve_iteration(&mut self) {
        for group in 0..self.groups.len() {
            if self.groups[group].body_a == self.groups[group].body_b {
                self.apply(group, |row, pair, bodies| row.solve::<0>(pair, bodies));
            } else {
                self.apply(group, |row, pair, bodies| row.solve::<1>(pair, bodies));
            }
        }
    }

    /// Runs an operation on the contacts of a group. Should it make a body infinite or NaN, both bodies keep what
    /// they had before, the group is out of this update, and the body is noted as failed: nothing spreads.
    #[inline(always)]
    fn apply(
        &mut self,
        group: usize,
        mut operation: impl FnMut(&mut ContactRow, &PairConstants, &mut [SolverBody; 2]),
    ) {
        let Group { body_a, body_b, first_row, row_count, friction, restitution } = self.groups[group];
        let mut bodies = [self.bodies[body_a as usize], self.bodies[body_b as usize]];
        let pair = PairConstants { friction, restitution };
        for row in &mut self.rows[first_row as usize..(first_row + row_count) as usize] {
            operation(row, &pair, &mut bodies);
        }
        let [a, b] = bodies;
        if a.is_finite() && b.is_finite() {
            // A last: where both are one body, its copy is the one that was worked on.
            self.bodies[body_b as usize] = b;
            self.bodies[body_a as usize] = a;
        } else {
            self.drop_group(group, !a.is_finite(), !b.is_finite());
        }
    }

    #[cold]
    fn drop_group(&mut self, group: usize, a_failed: bool, b_failed: bool) {
        let Group { body_a, body_b, first_row, row_count, .. } = self.groups[group];
        self.groups[group].row_count = 0;
        for row in &mut self.rows[first_row as usize..(first_row + row_count) as usize] {
            row.forget_impulses();
        }
        self.failed.extend(a_failed.then_some(body_a));
        self.failed.extend(b_failed.then_some(body_b));
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
        for (place, (&id, solved)) in (1u32..).zip(self.ids.iter().zip(self.bodies.iter().skip(1))) {
            let body = &mut bodies[id].body;
            if self.failed.binary_search(&place).is_ok() {
                let disabled = !body.is_static();
                body.set_enabled(body.enabled() && !disabled);
                events.push(Event::NotFinite { body: id, disabled });
                continue;
            }
            [body.linear_velocity.x, body.linear_velocity.y, body.angular_velocity] = solved.velocity;
            [body.linear_velocity_bias.x, body.linear_velocity_bias.y, body.angular_velocity_bias] =
                solved.bias;
        }
        let mut rows = self.rows.iter();
        for &handle in &self.arbiters {
            let contacts = &mut list.arbiters[handle as usize].contacts;
            for (contact, row) in contacts.iter_mut().zip(&mut rows) {
                row.write_back(contact);
            }
        }
        // The rows stay readable until the next update begins.
        self.ids.clear();
        self.groups.clear();
        self.arbiters.clear();
    }
}
