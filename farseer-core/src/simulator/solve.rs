//! Solver iterations of the faithful set: joints, contacts and the constraints of engines on top change velocities.

use super::callbacks::Handler;
use super::{EventHandler, PhysicsSimulator};
use crate::body::BodyId;
use crate::body::entry::Bodies;
use crate::contact_solver::{PreStepSettings, SolverBodies, SolverBody, SolverBodyIndex};
use crate::report::Event;

/// Constraints of an engine on top. They are solved after joints and contacts, in every iteration, on the same
/// velocities. [`PhysicsSimulator::solve_with`] takes them.
pub trait ExternalConstraints {
    /// Whether there is nothing to solve.
    fn is_empty(&self) -> bool;

    /// Called after the pre-step: looks up the bodies, and applies the warm start.
    fn warm_start(&mut self, bodies: &mut SolverBodiesView<'_>);

    /// One solver iteration.
    fn solve(&mut self, bodies: &mut SolverBodiesView<'_>);
}

/// The velocities of an update while it solves. From the pre-step to the end of the iterations they replace those of
/// the bodies: a velocity that is set on a body itself meanwhile is lost.
#[derive(Debug)]
pub struct SolverBodiesView<'a> {
    solved: &'a mut SolverBodies,
    bodies: &'a Bodies,
}

impl SolverBodiesView<'_> {
    /// The index of a body in this update. A body without contacts and joints is added to the solver. `None` for a
    /// stale id.
    pub fn place(&mut self, body: BodyId) -> Option<SolverBodyIndex> {
        self.solved.index_of(body, self.bodies)
    }

    /// The present velocities and inverse masses of a body. An index of another update is invalid: the result is
    /// unspecified.
    #[inline]
    pub fn get(&self, place: SolverBodyIndex) -> SolverBody {
        self.solved.body(place)
    }

    /// Sets the velocities of a body, and returns whether they are finite; if not, the body keeps its velocities and
    /// [fails](Self::fail). The inverses of mass and inertia do not change.
    #[inline]
    pub fn set(&mut self, place: SolverBodyIndex, body: SolverBody) -> bool {
        self.solved.set_body(place, &body)
    }

    /// Marks a body as failed, because its velocities would not have been finite. At the end it gets back the
    /// velocities with which the update began to solve; a dynamic one is disabled, and it is reported as
    /// [`Event::NotFinite`].
    pub fn fail(&mut self, place: SolverBodyIndex) {
        self.solved.mark_failed(place);
    }
}

impl PhysicsSimulator {
    /// Fifth stage: joints and contacts are prepared, and the warm start is applied. `inverse_dt` is 1 / dt, in 1/s.
    ///
    /// With a number that is not finite the call has no effect and is reported.
    #[doc(alias("Joint.PreStep"))]
    pub fn pre_step(&mut self, inverse_dt: f32) {
        if !self.accepts_step("inverse_dt", inverse_dt) || !self.has_stages() {
            return;
        }
        let settings = PreStepSettings {
            inverse_dt,
            bias_factor: self.settings.bias_factor,
            allowed_penetration: self.settings.allowed_penetration,
        };
        let PhysicsSimulator { objects, contacts, pipeline, report, .. } = self;
        pipeline.joints.pre_step(inverse_dt, &mut objects.joints, &mut objects.bodies, report);
        pipeline.contacts.pre_step(contacts, &objects.geoms, &objects.bodies, &mut pipeline.bodies, settings);
        report.counters.contacts_solved = pipeline.contacts.row_count();
    }

    /// Sixth stage, repeated: one iteration over all joints, then one over all contacts.
    #[doc(alias("Joint.Update"))]
    pub fn solve_iteration(&mut self, handler: Option<&mut dyn EventHandler>) {
        if self.has_stages() {
            self.solve_once(&mut Handler::new(handler));
        }
    }

    /// Fifth and sixth stage with constraints of another engine: the [pre-step](Self::pre_step), and all
    /// [iterations](Self::solve_iteration), each followed by one over the constraints. If there is nothing to solve,
    /// there are no iterations.
    pub fn solve_with(
        &mut self,
        inverse_dt: f32,
        constraints: &mut dyn ExternalConstraints,
        handler: Option<&mut dyn EventHandler>,
    ) {
        if self.has_stages() {
            self.solve(inverse_dt, Some(constraints), &mut Handler::new(handler));
        }
    }

    pub(super) fn solve(
        &mut self,
        inverse_dt: f32,
        mut constraints: Option<&mut dyn ExternalConstraints>,
        handler: &mut Handler<'_>,
    ) {
        self.pre_step(inverse_dt);
        if let Some(constraints) = &mut constraints {
            constraints.warm_start(&mut self.solved_bodies());
        }
        let has_work = self.report.counters.contacts_solved > 0
            || !self.joint_list().is_empty()
            || constraints.as_ref().is_some_and(|constraints| !constraints.is_empty());
        for _ in 0..if has_work { self.iteration_limit() } else { 0 } {
            self.solve_once(handler);
            if let Some(constraints) = &mut constraints {
                constraints.solve(&mut self.solved_bodies());
            }
        }
    }

    /// Number of iterations of an update with something to solve: [iterations](Self::iterations), as far as the
    /// [limits](crate::Objects::limits) allow.
    fn iteration_limit(&self) -> u32 {
        u32::try_from(self.settings.iterations).unwrap_or(0).min(self.limits().iterations)
    }

    fn solved_bodies(&mut self) -> SolverBodiesView<'_> {
        SolverBodiesView { solved: &mut self.pipeline.bodies, bodies: &self.objects.bodies }
    }

    fn solve_once(&mut self, handler: &mut Handler<'_>) {
        self.solve_joints(handler);
        self.pipeline.contacts.solve_iteration(&mut self.pipeline.bodies);
        self.report.counters.passes += 1;
    }

    /// One iteration over the joints in list order. Joints whose error is beyond their breakpoint break, and act once
    /// more.
    fn solve_joints(&mut self, handler: &mut Handler<'_>) {
        let PhysicsSimulator { objects, pipeline, .. } = self;
        pipeline.joints.begin_iteration(&objects.joints, &objects.bodies, &mut pipeline.bodies);
        for position in 0..self.pipeline.joints.count() {
            self.solve_joint(position, handler);
        }
        self.pipeline.joints.end_iteration();
    }

    fn solve_joint(&mut self, position: usize, handler: &mut Handler<'_>) {
        let Some((joint, solved_joint)) = self.objects.joints.at_mut(position) else { return };
        if !solved_joint.enabled() {
            return;
        }
        if solved_joint.breaks() {
            self.report.push(Event::JointBroke { joint });
            self.store_velocities_for_callback(handler);
            self.call_handler(handler, |handler, context| handler.on_joint_broke(context, joint));
        }
        let PhysicsSimulator { objects, pipeline, report, .. } = self;
        let has_acted = pipeline.joints.solve(
            (position, joint),
            &mut objects.joints,
            &mut objects.bodies,
            &mut pipeline.bodies,
            report,
        );
        if has_acted && handler.wants(|handler| handler.handles_joint_updates()) {
            self.store_velocities_for_callback(handler);
            self.call_handler(handler, |handler, context| handler.on_joint_updated(context, joint));
        }
    }

    /// Copies the solver's velocities to the bodies for a callback in the middle of an iteration, if there is a
    /// handler.
    fn store_velocities_for_callback(&mut self, handler: &mut Handler<'_>) {
        let PhysicsSimulator { objects, pipeline, .. } = self;
        if handler.get().is_some() {
            pipeline.joints.store_velocities(&mut objects.bodies, &pipeline.bodies);
        }
    }

    /// Copies the solver's velocities to the bodies and its impulses to the contacts.
    pub(super) fn finish_solving(&mut self) {
        self.pipeline.bodies.finish(&mut self.objects.bodies, &mut self.report);
        self.pipeline.contacts.finish(&mut self.contacts);
    }
}

/// The methods of [`SolverBodiesView`] stage by stage, from the [pre-step](PhysicsSimulator::pre_step) to
/// [`integrate`](PhysicsSimulator::integrate).
impl PhysicsSimulator {
    /// [`SolverBodiesView::place`]; `None` outside of these stages, too.
    pub fn solver_place(&mut self, body: BodyId) -> Option<SolverBodyIndex> {
        self.solved_bodies().place(body)
    }

    /// [`SolverBodiesView::get`]
    pub fn solver_body(&self, place: SolverBodyIndex) -> SolverBody {
        self.pipeline.bodies.body(place)
    }

    /// [`SolverBodiesView::set`]
    pub fn set_solver_body(&mut self, place: SolverBodyIndex, body: SolverBody) -> bool {
        self.solved_bodies().set(place, body)
    }

    /// [`SolverBodiesView::fail`]
    pub fn solver_body_failed(&mut self, place: SolverBodyIndex) {
        self.solved_bodies().fail(place);
    }
}
