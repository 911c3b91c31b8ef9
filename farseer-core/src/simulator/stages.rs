//! The update and its stages (behaviour chapter 04, section 3).

use super::queues::{Followed, Handler};
use super::step_times::{Clock, Stopwatch};
use super::{PhysicsSimulator, StepCounters};
use crate::broad_phase::{BroadPhase, PairSink};
use crate::contact::Contact;
use crate::events::{Context, Event, EventHandler};
use crate::geom::GeomId;
use crate::narrow_phase;
use crate::pair_filter::Scene;
use crate::solver::PreStepSettings;

impl PhysicsSimulator {
    /// Moves everything by `dt` seconds. Games call this with a fixed step.
    ///
    /// A negative step runs backwards; 0 only lets things enter and leave. A step that is not finite, or so small
    /// that its reciprocal is not, changes nothing and is reported as [`Event::RejectedInput`].
    #[doc(alias = "Update")]
    pub fn update(&mut self, dt: f32) {
        self.update_with_real_time(dt, 0.0, None);
    }

    /// [`update`](Self::update) with callbacks.
    pub fn update_with(&mut self, dt: f32, handler: &mut dyn EventHandler) {
        self.update_with_real_time(dt, 0.0, Some(handler));
    }

    /// [`update`](Self::update) that tells controllers how much time has really passed, in seconds; nothing else
    /// reads it. A time that is not finite is refused as `dt` is.
    #[doc(alias = "Update(float, float)")]
    pub fn update_with_real_time(&mut self, dt: f32, dt_real: f32, handler: Option<&mut dyn EventHandler>) {
        let mut handler = handler;
        self.run(dt, dt_real, &mut handler, None);
    }

    /// [`update_with_real_time`](Self::update_with_real_time) that measures its [stages](Self::step_times). `now` is the
    /// caller's clock, in milliseconds since any moment: the engine has none, so that nothing depends on one.
    ///
    /// ```
    /// # use farseer_core::PhysicsSimulator;
    /// # let mut simulator = PhysicsSimulator::default();
    /// let start = std::time::Instant::now();
    /// simulator.update_timed(0.01, 0.0, None, &mut || start.elapsed().as_secs_f64() * 1000.0);
    /// assert!(simulator.step_times().update_time >= 0.0);
    /// ```
    #[doc(alias = "EnableDiagnostics")]
    pub fn update_timed(
        &mut self,
        dt: f32,
        dt_real: f32,
        handler: Option<&mut dyn EventHandler>,
        now: &mut dyn FnMut() -> f64,
    ) {
        let mut handler = handler;
        self.run(dt, dt_real, &mut handler, Some(now));
    }

    fn run(&mut self, dt: f32, dt_real: f32, handler: Handler, clock: Option<Clock<'_>>) {
        let mut stopwatch = Stopwatch::start(clock);
        let goes_on = self.process_queues(dt, reborrow(handler));
        stopwatch.lap(|times| &mut times.clean_up_time);
        if goes_on {
            self.find_pairs(reborrow(handler));
            stopwatch.lap(|times| &mut times.broad_phase_collision_time);
            self.collide_pairs(reborrow(handler));
            stopwatch.lap(|times| &mut times.narrow_phase_collision_time);
            self.apply_forces(dt, dt_real, reborrow(handler));
            stopwatch.lap(|times| &mut times.apply_forces_time);
            self.pre_step(1.0 / dt);
            let passes = if self.has_something_to_solve() { self.passes() } else { 0 };
            for _ in 0..passes {
                self.solve_iteration(reborrow(handler));
            }
            stopwatch.lap(|times| &mut times.apply_impulses_time);
            self.integrate(dt, reborrow(handler));
            stopwatch.lap(|times| &mut times.update_positions_time);
        }
        self.step_times = stopwatch.times().unwrap_or(self.step_times);
    }

    /// First stage: things enter and leave, edited bodies take their geoms along, and pairs that have an arbiter
    /// are noted. Answers whether the update goes on: not if the simulator is disabled, or `dt` is 0 or refused.
    #[doc(alias(
        "IBroadPhaseCollider.ProcessRemovedGeoms",
        "IBroadPhaseCollider.ProcessDisposedGeoms",
        "ArbiterList.CleanArbiterList",
        "Joint.Validate",
        "Spring.Validate"
    ))]
    pub fn process_queues(&mut self, dt: f32, handler: Option<&mut dyn EventHandler>) -> bool {
        let mut handler = handler;
        self.events.clear();
        self.counters = StepCounters::default();
        self.arbiters.take_back_from_engine();
        if !self.accepts_step("dt", dt) || (dt != 0.0 && !self.accepts_step("dt", 1.0 / dt)) {
            return false;
        }
        self.process_all_queues(&mut handler);
        self.arbiters.prepare_for_broad_phase_collision(&self.geom_list, &mut self.geoms);
        dt != 0.0 && self.settings.enabled
    }

    /// Whether a step, or its reciprocal, is finite; if not, the refusal is reported.
    fn accepts_step(&mut self, argument: &'static str, step: f32) -> bool {
        if !step.is_finite() {
            self.events.push(Event::RejectedInput { object: None, argument });
        }
        step.is_finite()
    }

    /// Second stage: the broad phase appends arbiters for new pairs whose boxes overlap.
    ///
    /// A handler that [filters pairs](EventHandler::filters_pairs) is asked first about those that have one.
    #[doc(alias(
        "IBroadPhaseCollider.Update",
        "ArbiterList.PrepareForBroadphaseCollision",
        "ArbiterList.AddArbiterForGeomPair"
    ))]
    pub fn find_pairs(&mut self, handler: Option<&mut dyn EventHandler>) {
        let mut handler = handler;
        let is_filtered = handler.as_ref().is_some_and(|handler| handler.filters_pairs());
        if is_filtered {
            self.filter_listed_pairs(&mut handler);
        }
        let at_work = BroadPhase::AtWork(self.broad_phase.method());
        let mut broad_phase = std::mem::replace(&mut self.broad_phase, at_work);
        broad_phase.restore(&self.geom_list, &self.geoms);
        broad_phase.update(&mut PairFinder { simulator: self, handler, is_filtered });
        self.broad_phase = broad_phase;
    }

    /// Asks the handler about every pair that has an arbiter. Those that it refuses lose their contacts, and leave.
    fn filter_listed_pairs(&mut self, handler: Handler) {
        for position in 0..self.arbiters.len() {
            if let Some((a, b)) = self.arbiters.at(position).geoms
                && !self.accepts_pair(handler, a, b)
                && let Some(arbiter) = self.arbiters.get_mut(position)
            {
                arbiter.contacts.clear();
            }
        }
        self.remove_separated(handler);
    }

    fn accepts_pair(&mut self, handler: Handler, geom1: GeomId, geom2: GeomId) -> bool {
        let Some(asked) = handler else { return true };
        let accepted = asked.accepts_pair(&mut Context { simulator: self }, geom1, geom2);
        self.settle_edits(handler);
        accepted
    }

    /// Third stage: the narrow phase finds the contacts of every pair, deepest first, and takes over the impulses
    /// of those that were there before. Pairs without contacts leave.
    #[doc(alias("INarrowPhaseCollider.Collide", "ArbiterList.RemoveContactCountEqualsZero"))]
    pub fn collide_pairs(&mut self, handler: Option<&mut dyn EventHandler>) {
        let mut handler = handler;
        self.arbiters.take_back_from_engine();
        let mut contacts = std::mem::take(&mut self.new_contacts);
        for position in 0..self.arbiters.len() {
            contacts.clear();
            self.collide_pair(position, &mut contacts, &mut handler);
        }
        self.new_contacts = contacts;
        self.counters.pairs_tested = self.arbiters.len();
        self.remove_separated(&mut handler);
        self.counters.pairs_touching = self.arbiters.len();
    }

    /// Behaviour chapter 03, section 5.
    fn collide_pair(&mut self, position: usize, contacts: &mut Vec<Contact>, handler: Handler) {
        let handle = self.arbiters.list[position] as usize;
        let Some((a, b)) = self.arbiters.arbiters[handle].geoms else { return };
        let settings = &self.settings;
        let (geom_a, geom_b) = (&self.geoms[a], &self.geoms[b]);
        narrow_phase::collide(
            settings.narrow_phase,
            settings.max_contacts_to_detect,
            geom_a,
            geom_b,
            contacts,
        );
        contacts.retain(Contact::is_finite);
        if !contacts.is_empty() {
            sort_by_separation(contacts);
            contacts.truncate(settings.max_contacts_to_resolve.max(0) as usize);
            self.tell_collision(a, b, contacts, handler);
            self.tell_collision(b, a, contacts, handler);
        }
        let known = &mut self.arbiters.arbiters[handle].contacts;
        for contact in contacts.iter_mut() {
            if let Some(old) = known.iter().find(|old| old.id == contact.id) {
                contact.normal_impulse = old.normal_impulse;
                contact.tangent_impulse = old.tangent_impulse;
            }
        }
        known.clear();
        known.extend_from_slice(contacts);
    }

    fn tell_collision(&mut self, this: GeomId, other: GeomId, contacts: &mut Vec<Contact>, handler: Handler) {
        if contacts.is_empty() {
            return;
        }
        let count = contacts.len() as u32;
        let mut accepted = true;
        if let Some(handler) = handler {
            accepted = handler.on_collision(&mut Context { simulator: self }, this, other, contacts);
            contacts.retain(Contact::is_finite);
        }
        self.events.push(Event::Collision { this, other, contacts: count, vetoed: !accepted });
        if !accepted {
            contacts.clear();
        }
        if handler.is_some() {
            self.settle_edits(handler);
        }
    }

    /// Takes arbiters without contacts out of the list, and tells both sides.
    fn remove_separated(&mut self, handler: Handler) {
        let mut separated = std::mem::take(&mut self.separated);
        self.arbiters.remove_where(|arbiter| arbiter.contacts.is_empty(), |a, b| separated.push((a, b)));
        for (a, b) in separated.drain(..) {
            for (this, other) in [(a, b), (b, a)] {
                self.events.push(Event::Separation { this, other });
                if let Some(handler) = handler {
                    handler.on_separation(&mut Context { simulator: self }, this, other);
                    self.settle_edits(&mut Some(&mut **handler));
                }
            }
        }
        self.separated = separated;
    }

    /// Fourth stage: controllers and springs act; impulses, gravity and drag become velocity. A body whose velocity
    /// would not be finite keeps what it had, and is disabled and reported.
    ///
    /// `dt_real` is what controllers are told about the time that has really passed. A step or time that is not
    /// finite changes nothing and is reported.
    #[doc(alias("Spring.Update", "Controller.Update"))]
    pub fn apply_forces(&mut self, dt: f32, dt_real: f32, handler: Option<&mut dyn EventHandler>) {
        let mut handler = handler;
        if !self.accepts_step("dt", dt) || !self.accepts_step("dt_real", dt_real) {
            return;
        }
        self.update_controllers(dt, dt_real, &mut handler);
        self.update_springs(&mut handler);
        for &id in &self.body_list {
            let entry = &mut self.bodies[id];
            let body = &mut entry.body;
            if !body.is_integrated() || entry.is_disposed {
                continue;
            }
            let before = (body.linear_velocity, body.angular_velocity);
            body.apply_accumulated_impulse();
            body.accumulate_gravity(self.settings.gravity);
            body.integrate_velocity(dt);
            if !body.is_finite() {
                (body.linear_velocity, body.angular_velocity) = before;
                body.set_enabled(false);
                self.events.push(Event::NotFinite { body: id, disabled: true });
            }
        }
    }

    /// Fifth stage: joints and contacts are prepared, and the impulses of the last update act again. `inverse_dt` is 1 / dt.
    ///
    /// A number that is not finite changes nothing and is reported.
    #[doc(alias("Joint.PreStep"))]
    pub fn pre_step(&mut self, inverse_dt: f32) {
        if !self.accepts_step("inverse_dt", inverse_dt) {
            return;
        }
        let settings = PreStepSettings {
            inverse_dt,
            bias_factor: self.settings.bias_factor,
            allowed_penetration: self.settings.allowed_penetration,
        };
        self.pre_step_joints(inverse_dt);
        self.solver.pre_step(&self.arbiters, &self.geoms, &self.bodies, settings);
        self.counters.contacts_solved = self.solver.row_count();
    }

    /// Sixth stage, repeated: one pass over all joints, then one over all contacts.
    #[doc(alias("Joint.Update"))]
    pub fn solve_iteration(&mut self, handler: Option<&mut dyn EventHandler>) {
        let mut handler = handler;
        self.solve_joints(&mut handler);
        self.solver.solve_iteration();
        self.counters.passes += 1;
    }

    /// Last stage: velocities become positions, and geoms follow. A body whose state would not be finite is put
    /// back to its last finite one and reported; a dynamic one is disabled. With a step that is not finite nothing
    /// moves, which is reported.
    pub fn integrate(&mut self, dt: f32, handler: Option<&mut dyn EventHandler>) {
        let mut handler = handler;
        self.solver.finish(&mut self.arbiters, &mut self.bodies, &mut self.events);
        if !self.accepts_step("dt", dt) {
            return;
        }
        for index in 0..self.body_list.len() {
            let id = self.body_list[index];
            let entry = &mut self.bodies[id];
            if !entry.body.is_integrated() || entry.is_disposed {
                continue;
            }
            let before = entry.body.pose();
            let moved = entry.body.integrate_position(dt);
            if moved && !entry.body.is_finite() {
                entry.body.restore_pose(before);
                entry.body.set_enabled(false);
                self.events.push(Event::NotFinite { body: id, disabled: true });
                continue;
            }
            if !entry.body.has_moved() {
                continue;
            }
            if let Followed::PutBack { disabled } = self.let_geoms_follow(id, moved) {
                self.events.push(Event::NotFinite { body: id, disabled });
                continue;
            }
            self.counters.bodies_moved += usize::from(moved);
            self.events.push(Event::BodyUpdated { body: id });
            if let Some(handler) = &mut handler {
                handler.on_body_updated(&mut Context { simulator: self }, id);
                self.settle_edits(&mut Some(&mut **handler));
            }
        }
    }
}

/// The handler again, for a shorter time.
fn reborrow<'a>(handler: &'a mut Option<&mut dyn EventHandler>) -> Option<&'a mut dyn EventHandler> {
    match handler {
        Some(handler) => Some(&mut **handler),
        None => None,
    }
}

/// Stable insertion sort, deepest first.
fn sort_by_separation(contacts: &mut [Contact]) {
    for i in 1..contacts.len() {
        let mut j = i;
        while j > 0 && contacts[j - 1].separation > contacts[j].separation {
            contacts.swap(j - 1, j);
            j -= 1;
        }
    }
}

/// Hands pairs from the broad phase to the arbiter list.
struct PairFinder<'s, 'h> {
    simulator: &'s mut PhysicsSimulator,
    handler: Option<&'h mut dyn EventHandler>,
    /// Whether the handler filters pairs.
    is_filtered: bool,
}

impl PairSink for PairFinder<'_, '_> {
    fn has_approval(&self) -> bool {
        self.handler.as_ref().is_some_and(|handler| handler.handles_broad_phase())
    }

    fn approve(&mut self, geom1: GeomId, geom2: GeomId) -> bool {
        let Some(handler) = &mut self.handler else { return true };
        let mut context = Context { simulator: self.simulator };
        let accepted = handler.on_broad_phase_collision(&mut context, geom1, geom2);
        if !accepted {
            self.simulator.events.push(Event::BroadPhaseVeto { geom1, geom2 });
        }
        self.simulator.settle_edits(&mut Some(&mut **handler));
        accepted
    }

    fn scene(&self) -> Scene<'_> {
        Scene { geoms: &self.simulator.geoms, bodies: &self.simulator.bodies }
    }

    fn geom_list(&self) -> &[GeomId] {
        &self.simulator.geom_list
    }

    fn register(&mut self, geom1: GeomId, geom2: GeomId) {
        let geoms = &self.simulator.geoms;
        if !geoms.contains(geom1) || !geoms.contains(geom2) {
            return;
        }
        // Asked before the table is: most pairs are refused, and asking is the cheaper of the two.
        if self.is_filtered && !self.simulator.accepts_pair(&mut self.handler, geom1, geom2) {
            return;
        }
        let PhysicsSimulator { arbiters, geoms, settings, .. } = &mut *self.simulator;
        arbiters.add_arbiter_for_geom_pair(geoms, settings.friction_type, geom1, geom2);
    }

    fn index_listed(&mut self) {
        self.simulator.arbiters.index_listed();
    }

    fn register_unless_listed(&mut self, geom1: GeomId, geom2: GeomId) {
        if self.is_filtered
            && !self.simulator.arbiters.is_listed(geom1, geom2)
            && !self.simulator.accepts_pair(&mut self.handler, geom1, geom2)
        {
            return;
        }
        let PhysicsSimulator { arbiters, geoms, settings, .. } = &mut *self.simulator;
        arbiters.add_arbiter_unless_listed(geoms, settings.friction_type, geom1, geom2);
    }
}
