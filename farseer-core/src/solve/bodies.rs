//! The velocities of an update: the one place on which joints, contacts and other constraints work, from the pre-step
//! to the end of the passes.

use wide::f32x4;

use super::kernel::BodyLanes;
use super::states::{BodyState, pack_one, unpack_one};
use crate::body::BodyId;
use crate::body::entry::{Bodies, BodyEntry};
use crate::report::{Event, Report};
use crate::storage::arena::Id;
use crate::storage::reusing_clone::reusing_clone;

/// What the solver reads and changes of a body (behaviour chapter 03, section 6).
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct SolverBody {
    /// Linear velocity x and y in the user's length unit per second, y down, and angular velocity in rad/s.
    pub velocity: [f32; 3],
    /// Velocity that moves the body in this update only, to undo overlap; as [`velocity`](Self::velocity).
    #[doc(alias("LinearVelocityBias", "AngularVelocityBias"))]
    pub bias: [f32; 3],
    /// 1 / mass, 0 for a body that is static.
    pub inverse_mass: f32,
    /// 1 / moment of inertia, 0 for a body that is static.
    pub inverse_inertia: f32,
}

/// Names a body in the solver, from [`pre_step`](crate::PhysicsSimulator::pre_step) to
/// [`integrate`](crate::PhysicsSimulator::integrate) of one update.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Default)]
pub struct SolverPlace(u32);

/// The bodies that something is solved for, reused from update to update.
#[derive(Debug, Default)]
pub(crate) struct SolverBodies {
    /// The immovable body that is none, then the bodies that something acts on.
    pub(super) states: Vec<BodyState>,
    pub(super) positions: Vec<[f32; 2]>,
    /// Whether the groups of a body must keep their order.
    pub(super) is_ordered: Vec<bool>,
    /// Ids of the bodies behind the first.
    ids: Vec<BodyId>,
    /// By slot of the body: stamp of the update in which it was gathered, and where to.
    places: Vec<(u32, u32)>,
    stamp: u32,
    pub(super) failed: Vec<u32>,
    /// Between pre-step and end: bodies may be gathered.
    is_open: bool,
}

reusing_clone! { SolverBodies { states, positions, is_ordered, ids, places, stamp, failed, is_open } }

impl SolverBodies {
    /// An update begins: nothing is gathered yet.
    pub(super) fn begin(&mut self, slots: usize) {
        self.stamp = self.stamp.wrapping_add(1);
        if self.stamp == 0 {
            self.places.fill((0, 0));
            self.stamp = 1;
        }
        self.places.resize(slots, (0, 0));
        self.states.clear();
        self.states.push(BodyState::default());
        self.positions.clear();
        self.positions.push([0.0; 2]);
        self.is_ordered.clear();
        self.is_ordered.push(false);
        self.ids.clear();
        self.failed.clear();
        self.is_open = true;
    }

    /// No body can be gathered any more until the next pre-step.
    pub(crate) fn close(&mut self) {
        self.is_open = false;
    }

    /// The place of a body, which is gathered if it was not.
    pub(crate) fn place(&mut self, id: BodyId, bodies: &Bodies) -> Option<SolverPlace> {
        if !self.is_open || !bodies.contains(id) {
            return None;
        }
        if id.index() >= self.places.len() {
            self.places.resize(bodies.slot_count(), (0, 0));
        }
        Some(SolverPlace(self.gather(id, bodies)))
    }

    pub(super) fn gather(&mut self, id: BodyId, bodies: &Bodies) -> u32 {
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

    #[inline]
    pub(crate) fn body(&self, place: SolverPlace) -> SolverBody {
        let Some(state) = self.states.get(place.0 as usize) else { return SolverBody::default() };
        let BodyLanes { velocity, bias, inverse_mass, inverse_inertia } = unpack_one(state);
        SolverBody { velocity, bias, inverse_mass, inverse_inertia }
    }

    /// Takes velocities over and answers whether they are finite. Otherwise the body has failed.
    #[inline]
    pub(crate) fn set_body(&mut self, place: SolverPlace, body: &SolverBody) -> bool {
        let SolverBody { velocity: [x, y, w], bias: [bias_x, bias_y, bias_w], .. } = *body;
        // Any infinity or NaN makes a product, and with it the sum, NaN.
        let zero = x * 0.0 + y * 0.0 + w * 0.0 + (bias_x * 0.0 + bias_y * 0.0 + bias_w * 0.0);
        if zero != 0.0 {
            self.body_failed(place);
            return false;
        }
        if let Some(state) = self.states.get_mut(place.0 as usize) {
            let [inverse_mass, inverse_inertia] = [state[0].as_array()[3], state[1].as_array()[3]];
            *state =
                [f32x4::new([x, y, w, inverse_mass]), f32x4::new([bias_x, bias_y, bias_w, inverse_inertia])];
        }
        true
    }

    /// Gives the bodies the velocities they have in the solver, for callbacks in the middle of it.
    pub(crate) fn put_velocities_down(&self, bodies: &mut Bodies) {
        for place in 1..self.states.len() {
            self.put_velocity_down(SolverPlace(place as u32), bodies);
        }
    }

    /// Gives one body the velocity it has in the solver.
    pub(crate) fn put_velocity_down(&self, place: SolverPlace, bodies: &mut Bodies) {
        let place = place.0 as usize;
        let (Some(&id), Some(state)) = (self.ids.get(place.wrapping_sub(1)), self.states.get(place)) else {
            return;
        };
        let Some(BodyEntry { body, .. }) = bodies.get_mut(id) else { return };
        [body.linear_velocity.x, body.linear_velocity.y, body.angular_velocity] = unpack_one(state).velocity;
    }

    /// Goes on with the velocity that a callback has given a body, if the body is in the solver. Masses stay what
    /// they were.
    pub(crate) fn take_velocity_up(&mut self, id: BodyId, bodies: &Bodies) {
        let place = self.places.get(id.index()).filter(|place| place.0 == self.stamp);
        let Some(state) = place.and_then(|place| self.states.get_mut(place.1 as usize)) else { return };
        let Some(BodyEntry { body, .. }) = bodies.get(id) else { return };
        let velocity = [body.linear_velocity.x, body.linear_velocity.y, body.angular_velocity];
        *state = pack_one(&BodyLanes { velocity, ..unpack_one(state) });
    }

    /// Notes that a body is to keep the velocities with which the solver began.
    #[cold]
    pub(crate) fn body_failed(&mut self, place: SolverPlace) {
        self.failed.push(place.0);
    }

    /// Writes the velocities back. Bodies that failed keep those with which the update began to solve; the dynamic ones
    /// are disabled.
    pub(crate) fn finish(&mut self, bodies: &mut Bodies, report: &mut Report) {
        self.failed.sort_unstable();
        self.failed.dedup();
        for (place, (&id, state)) in (1u32..).zip(self.ids.iter().zip(self.states.iter().skip(1))) {
            // Stages called out of order may have let a body go.
            let Some(BodyEntry { body, .. }) = bodies.get_mut(id) else { continue };
            if self.failed.binary_search(&place).is_ok() {
                let disabled = !body.is_static();
                body.set_enabled(body.enabled() && !disabled);
                report.push(Event::NotFinite { body: id, disabled });
                continue;
            }
            let BodyLanes { velocity, bias, .. } = unpack_one(state);
            [body.linear_velocity.x, body.linear_velocity.y, body.angular_velocity] = velocity;
            [body.linear_velocity_bias.x, body.linear_velocity_bias.y, body.angular_velocity_bias] = bias;
        }
        self.ids.clear();
        self.close();
    }
}
