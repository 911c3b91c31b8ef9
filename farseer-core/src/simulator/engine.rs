//! What engines that are built on the stages need besides them: callbacks of their own, and work of their own between
//! the passes of the solver.

use super::PhysicsSimulator;
use super::editing::check_place;
use crate::body::BodyId;
use crate::events::{Context, Event, EventHandler};
use crate::geom::GeomId;
use crate::solver::{SolverBody, SolverPlace};
use crate::{Error, Result};

/// For engines that are built on the stages: callbacks.
impl PhysicsSimulator {
    /// What callbacks may do to the simulator, to hand to callbacks of an engine. [`settle`](Self::settle) is due
    /// after each.
    pub fn context(&mut self) -> Context<'_> {
        Context { simulator: self }
    }

    /// Lets geoms follow bodies that were edited, and delivers what has happened meanwhile, as after every callback
    /// of the core.
    pub fn settle(&mut self, handler: Option<&mut dyn EventHandler>) {
        let mut handler = handler;
        self.settle_edits(&mut handler);
    }

    /// Puts an event on the list of this update.
    pub fn report(&mut self, event: Event) {
        self.events.push(event);
    }

    /// Lets the box of a geom be that of a disc about the geom's origin instead of that of its outline, or again that of
    /// the outline: for engines that collide true circles, which reach beyond a polygon of as many corners.
    ///
    /// # Errors
    /// A stale geom; a radius that is not finite and greater than 0, or with which the box would not be finite.
    pub fn set_box_radius(&mut self, geom: GeomId, radius: Option<f32>) -> Result<()> {
        let body = self.geoms.get(geom).ok_or(Error::StaleId { argument: "geom" })?.body;
        if let Some(radius) = radius.filter(|radius| !(radius.is_finite() && *radius > 0.0)) {
            return Err(Error::invalid("radius", radius, "finite and greater than 0"));
        }
        let mut resized = self.geoms[geom].clone();
        resized.set_box_radius(radius);
        check_place("radius", resized, &self.bodies[body])?;
        self.settle_body(body);
        self.geoms[geom].set_box_radius(radius);
        Ok(())
    }

    /// How two friction coefficients combine: [`friction_type`](Self::friction_type).
    pub fn mix_friction(&self, a: f32, b: f32) -> f32 {
        self.settings.friction_type.mix(a, b)
    }
}

/// For engines that are built on the stages: solving.
impl PhysicsSimulator {
    /// Between [`collide_pairs`](Self::collide_pairs) and [`pre_step`](Self::pre_step): the core does not solve the
    /// arbiter at this position of the list in this update. It stays in the list with its contacts and their impulses,
    /// and is not counted in [`contacts_solved`](crate::StepCounters::contacts_solved). Beyond the end of the list
    /// nothing happens.
    pub fn leave_to_engine(&mut self, position: usize) {
        self.arbiters.leave_to_engine(position);
    }

    /// Sets the accumulated impulses (mass times velocity) of a contact of the arbiter at a position of the list: what
    /// an engine found for an arbiter that was [left](Self::leave_to_engine) to it. The contact has them again in the
    /// next update, if it is still there. Those of other arbiters are overwritten by [`integrate`](Self::integrate).
    ///
    /// Nothing happens if there is no such contact or an impulse is not finite.
    pub fn set_arbiter_impulses(
        &mut self,
        position: usize,
        contact_index: usize,
        normal_impulse: f32,
        tangent_impulse: f32,
    ) {
        let arbiter = self.arbiters.get_mut(position);
        let Some(contact) = arbiter.and_then(|arbiter| arbiter.contacts.get_mut(contact_index)) else {
            return;
        };
        if normal_impulse.is_finite() && tangent_impulse.is_finite() {
            (contact.normal_impulse, contact.tangent_impulse) = (normal_impulse, tangent_impulse);
        }
    }

    /// Passes of an update that has something to solve: the [iterations](Self::iterations), as far as the
    /// [limits](Self::limits) allow.
    pub fn passes(&self) -> u32 {
        u32::try_from(self.settings.iterations).unwrap_or(0).min(self.limits.iterations)
    }

    /// After [`pre_step`](Self::pre_step): whether there is a contact to solve or a joint. If not, a
    /// [pass](Self::solve_iteration) changes nothing and calls nobody, and an update makes none.
    pub fn has_something_to_solve(&self) -> bool {
        self.counters.contacts_solved > 0 || !self.joints.list().is_empty()
    }

    /// The place of a body in the solver, from [`pre_step`](Self::pre_step) to [`integrate`](Self::integrate). A body
    /// that touches nothing the core solves is taken in. From then on its velocities are those in the solver, and
    /// what is set on the body itself is lost.
    ///
    /// `None` for a stale id, and outside of these stages.
    pub fn solver_place(&mut self, body: BodyId) -> Option<SolverPlace> {
        self.solver.place(body, &self.bodies)
    }

    /// The velocities of a body as the solver has them now, and what it weighs. What lies at a place of another
    /// update means nothing.
    #[inline]
    pub fn solver_body(&self, place: SolverPlace) -> SolverBody {
        self.solver.body(place)
    }

    /// Sets the velocities of a body in the solver, and answers whether they are finite; if not, the body keeps what
    /// it has there and has [failed](Self::solver_body_failed). The inverses of mass and inertia stay what they are.
    #[inline]
    pub fn set_solver_body(&mut self, place: SolverPlace, body: SolverBody) -> bool {
        self.solver.set_body(place, &body)
    }

    /// The velocities of a body would not have been finite. With [`integrate`](Self::integrate) it gets back those with
    /// which the solver began; a dynamic one is disabled, and it is reported as [`Event::NotFinite`].
    pub fn solver_body_failed(&mut self, place: SolverPlace) {
        self.solver.body_failed(place);
    }
}
