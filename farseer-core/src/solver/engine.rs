//! Bodies in the solver, for engines that solve contacts of their own between its passes.

use wide::f32x4;

use super::{BodyLanes, ContactSolver, pack_one, unpack_one};
use crate::arena::{Arena, Id};
use crate::body::BodyId;
use crate::body_entry::BodyEntry;

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

impl ContactSolver {
    /// No body can be gathered any more until the next pre-step.
    pub(crate) fn close(&mut self) {
        self.is_open = false;
    }

    /// The place of a body, which is gathered if it was not.
    pub(crate) fn place(&mut self, id: BodyId, bodies: &Arena<BodyEntry>) -> Option<SolverPlace> {
        if !self.is_open || !bodies.contains(id) {
            return None;
        }
        if id.index() >= self.places.len() {
            self.places.resize(bodies.slot_count(), (0, 0));
        }
        Some(SolverPlace(self.gather_body(id, bodies)))
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
    pub(crate) fn put_velocities_down(&self, bodies: &mut Arena<BodyEntry>) {
        for place in 1..self.states.len() {
            self.put_velocity_down(SolverPlace(place as u32), bodies);
        }
    }

    /// Gives one body the velocity it has in the solver.
    pub(crate) fn put_velocity_down(&self, place: SolverPlace, bodies: &mut Arena<BodyEntry>) {
        let place = place.0 as usize;
        let (Some(&id), Some(state)) = (self.ids.get(place.wrapping_sub(1)), self.states.get(place)) else {
            return;
        };
        let Some(BodyEntry { body, .. }) = bodies.get_mut(id) else { return };
        [body.linear_velocity.x, body.linear_velocity.y, body.angular_velocity] = unpack_one(state).velocity;
    }

    /// Goes on with the velocity that a callback has given a body, if the body is in the solver. Masses stay what
    /// they were.
    pub(crate) fn take_velocity_up(&mut self, id: BodyId, bodies: &Arena<BodyEntry>) {
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
}
