//! Body velocities of the faithful solver. From the pre-step to the end of the iterations, joints, contacts and
//! constraints of engines on top work on this one copy.

use wide::f32x4;

use super::body_lanes::{PackedBody, pack_one, unpack_one};
use super::kernel::BodyLanes;
use crate::body::BodyId;
use crate::body::entry::{Bodies, BodyEntry};
use crate::report::{Event, Report};
use crate::storage::arena::Id;
use farseer_precise::reusing_clone;

/// State of a body in the solver (behaviour chapter 03, section 6).
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct SolverBody {
    /// Linear velocity x and y in the user's length unit per second, y down, and angular velocity in rad/s.
    pub velocity: [f32; 3],
    /// Bias velocity: it moves the body in this update only, to resolve penetration. Units as
    /// [`velocity`](Self::velocity).
    #[doc(alias("LinearVelocityBias", "AngularVelocityBias"))]
    pub bias: [f32; 3],
    /// 1 / mass, in 1/mass units; 0 for a static or kinematic body.
    pub inverse_mass: f32,
    /// 1 / moment of inertia, in 1/(mass units · length units²); 0 for a static or kinematic body.
    pub inverse_inertia: f32,
}

/// Index of a body in the solver, valid from [`pre_step`](crate::PhysicsSimulator::pre_step) to
/// [`integrate`](crate::PhysicsSimulator::integrate) of one update.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Default)]
pub struct SolverBodyIndex(u32);

/// The bodies with constraints in this update; the arrays are reused from update to update.
#[derive(Debug, Default)]
pub(crate) struct SolverBodies {
    /// At index 0 an immovable placeholder, then the bodies with constraints.
    pub(super) states: Vec<PackedBody>,
    pub(super) positions: Vec<[f32; 2]>,
    /// Whether the contact groups of a body must be solved in list order: true for bodies that impulses can move.
    pub(super) is_ordered: Vec<bool>,
    /// Ids of the bodies in `states`, without the placeholder.
    ids: Vec<BodyId>,
    /// By slot of the body: stamp of the update in which it was gathered, and its index in `states`.
    indices: Vec<(u32, u32)>,
    stamp: u32,
    pub(super) failed: Vec<u32>,
    /// Whether bodies may be gathered: between the pre-step and the end of the iterations.
    is_open: bool,
}

reusing_clone! { SolverBodies { states, positions, is_ordered, ids, indices, stamp, failed, is_open } }

impl SolverBodies {
    /// Starts an update without any body.
    pub(super) fn begin(&mut self, slots: usize) {
        self.stamp = self.stamp.wrapping_add(1);
        if self.stamp == 0 {
            self.indices.fill((0, 0));
            self.stamp = 1;
        }
        self.indices.resize(slots, (0, 0));
        self.states.clear();
        self.states.push(PackedBody::default());
        self.positions.clear();
        self.positions.push([0.0; 2]);
        self.is_ordered.clear();
        self.is_ordered.push(false);
        self.ids.clear();
        self.failed.clear();
        self.is_open = true;
    }

    /// Ends the gathering of bodies until the next pre-step.
    pub(crate) fn close(&mut self) {
        self.is_open = false;
    }

    /// Index of a body, which is gathered if it was not.
    pub(crate) fn index_of(&mut self, id: BodyId, bodies: &Bodies) -> Option<SolverBodyIndex> {
        if !self.is_open || !bodies.contains(id) {
            return None;
        }
        if id.index() >= self.indices.len() {
            self.indices.resize(bodies.slot_count(), (0, 0));
        }
        Some(SolverBodyIndex(self.gather(id, bodies)))
    }

    pub(super) fn gather(&mut self, id: BodyId, bodies: &Bodies) -> u32 {
        let place = &mut self.indices[id.index()];
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
            // Impulses add zero to an immovable body, which changes no number but a negative zero.
            let is_immovable = body.inverse_mass == 0.0 && body.inverse_moment_of_inertia == 0.0;
            let zeros = [v.x, v.y, w, bias.x, bias.y, bias_w];
            let has_negative_zero = zeros.iter().any(|value| value.to_bits() == (-0.0f32).to_bits());
            self.is_ordered.push(!is_immovable || has_negative_zero);
        }
        place.1
    }

    #[inline]
    pub(crate) fn body(&self, place: SolverBodyIndex) -> SolverBody {
        let Some(state) = self.states.get(place.0 as usize) else { return SolverBody::default() };
        let BodyLanes { velocity, bias, inverse_mass, inverse_inertia } = unpack_one(state);
        SolverBody { velocity, bias, inverse_mass, inverse_inertia }
    }

    /// Sets the velocities of a body and returns whether they are finite. If not, the body is marked as failed.
    #[inline]
    pub(crate) fn set_body(&mut self, place: SolverBodyIndex, body: &SolverBody) -> bool {
        let SolverBody { velocity: [x, y, w], bias: [bias_x, bias_y, bias_w], .. } = *body;
        // Any infinity or NaN makes a product, and with it the sum, NaN.
        let zero = x * 0.0 + y * 0.0 + w * 0.0 + (bias_x * 0.0 + bias_y * 0.0 + bias_w * 0.0);
        if zero != 0.0 {
            self.mark_failed(place);
            return false;
        }
        if let Some(state) = self.states.get_mut(place.0 as usize) {
            let [inverse_mass, inverse_inertia] = [state[0].as_array()[3], state[1].as_array()[3]];
            *state =
                [f32x4::new([x, y, w, inverse_mass]), f32x4::new([bias_x, bias_y, bias_w, inverse_inertia])];
        }
        true
    }

    /// Copies the solver's velocities to all bodies, for callbacks during the iterations.
    pub(crate) fn store_velocities(&self, bodies: &mut Bodies) {
        for place in 1..self.states.len() {
            self.store_velocity(SolverBodyIndex(place as u32), bodies);
        }
    }

    /// Copies the solver's velocity to one body.
    pub(crate) fn store_velocity(&self, place: SolverBodyIndex, bodies: &mut Bodies) {
        let place = place.0 as usize;
        let (Some(&id), Some(state)) = (self.ids.get(place.wrapping_sub(1)), self.states.get(place)) else {
            return;
        };
        let Some(BodyEntry { body, .. }) = bodies.get_mut(id) else { return };
        [body.linear_velocity.x, body.linear_velocity.y, body.angular_velocity] = unpack_one(state).velocity;
    }

    /// Copies the velocity that a callback has given a body to the solver, if the body is in it. Masses stay unchanged.
    pub(crate) fn load_velocity(&mut self, id: BodyId, bodies: &Bodies) {
        let place = self.indices.get(id.index()).filter(|place| place.0 == self.stamp);
        let Some(state) = place.and_then(|place| self.states.get_mut(place.1 as usize)) else { return };
        let Some(BodyEntry { body, .. }) = bodies.get(id) else { return };
        let velocity = [body.linear_velocity.x, body.linear_velocity.y, body.angular_velocity];
        *state = pack_one(&BodyLanes { velocity, ..unpack_one(state) });
    }

    /// Marks a body as failed: it will get back the velocities with which the solver began.
    #[cold]
    pub(crate) fn mark_failed(&mut self, place: SolverBodyIndex) {
        self.failed.push(place.0);
    }

    /// Writes the velocities back. Failed bodies keep the velocities from before the solver; the dynamic ones are
    /// disabled.
    pub(crate) fn finish(&mut self, bodies: &mut Bodies, report: &mut Report) {
        self.failed.sort_unstable();
        self.failed.dedup();
        for (place, (&id, state)) in (1u32..).zip(self.ids.iter().zip(self.states.iter().skip(1))) {
            // Stages called out of order may have removed a body.
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
