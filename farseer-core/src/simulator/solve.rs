//! Joints, contacts and the constraints of other engines change velocities, pass by pass.

use super::tell::Handler;
use super::{EventHandler, PhysicsSimulator};
use crate::body::BodyId;
use crate::body::entry::Bodies;
use crate::report::Event;
use crate::solve::{PreStepSettings, SolverBodies, SolverBody, SolverPlace};

/// What an engine that is built on this one solves: after joints and contacts, in every pass, on the same velocities.
/// [`PhysicsSimulator::solve_with`] asks for it.
pub trait Constraints {
    /// Whether there is nothing to solve.
    fn is_empty(&self) -> bool;

    /// After the pre-step: finds its bodies, and lets the impulses of the last update act again.
    fn warm_start(&mut self, bodies: &mut SolvedBodies<'_>);

    /// One pass.
    fn solve(&mut self, bodies: &mut SolvedBodies<'_>);
}

/// The velocities of an update while it solves. From the pre-step to the end of the passes they are the truth: what is set
/// on a body itself meanwhile is lost.
#[derive(Debug)]
pub struct SolvedBodies<'a> {
    solved: &'a mut SolverBodies,
    bodies: &'a Bodies,
}

impl SolvedBodies<'_> {
    /// The place of a body in this update. One that touches nothing and that no joint holds is taken in. `None` for a
    /// stale id.
    pub fn place(&mut self, body: BodyId) -> Option<SolverPlace> {
        self.solved.place(body, self.bodies)
    }

    /// The velocities of a body as they are now, and what it weighs. What lies at a place of another update means
    /// nothing.
    #[inline]
    pub fn get(&self, place: SolverPlace) -> SolverBody {
        self.solved.body(place)
    }

    /// Sets the velocities of a body, and answers whether they are finite; if not, the body keeps what it has and has
    /// [failed](Self::fail). The inverses of mass and inertia stay what they are.
    #[inline]
    pub fn set(&mut self, place: SolverPlace, body: SolverBody) -> bool {
        self.solved.set_body(place, &body)
    }

    /// The velocities of a body would not have been finite. At the end it gets back those with which the update began to
    /// solve; a dynamic one is disabled, and it is reported as [`Event::NotFinite`].
    pub fn fail(&mut self, place: SolverPlace) {
        self.solved.body_failed(place);
    }
}

impl PhysicsSimulator {
    /// Fifth stage: joints and contacts are prepared, and the impulses of the last update act again. `inverse_dt` is 1 / dt.
    ///
    /// A number that is not finite changes nothing and is reported.
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

    /// Sixth stage, repeated: one pass over all joints, then one over all contacts.
    #[doc(alias("Joint.Update"))]
    pub fn solve_iteration(&mut self, handler: Option<&mut dyn EventHandler>) {
        if self.has_stages() {
            self.solve_once(&mut Handler::new(handler));
        }
    }

    /// Fifth and sixth stage with constraints of another engine: the [pre-step](Self::pre_step), and all
    /// [passes](Self::solve_iteration), each with one over the constraints behind it. If there is nothing to solve, no
    /// pass is made.
    pub fn solve_with(
        &mut self,
        inverse_dt: f32,
        constraints: &mut dyn Constraints,
        handler: Option<&mut dyn EventHandler>,
    ) {
        if self.has_stages() {
            self.solve(inverse_dt, Some(constraints), &mut Handler::new(handler));
        }
    }

    pub(super) fn solve(
        &mut self,
        inverse_dt: f32,
        mut constraints: Option<&mut dyn Constraints>,
        handler: &mut Handler<'_>,
    ) {
        self.pre_step(inverse_dt);
        if let Some(constraints) = &mut constraints {
            constraints.warm_start(&mut self.solved_bodies());
        }
        let has_work = self.report.counters.contacts_solved > 0
            || !self.joint_list().is_empty()
            || constraints.as_ref().is_some_and(|constraints| !constraints.is_empty());
        for _ in 0..if has_work { self.passes() } else { 0 } {
            self.solve_once(handler);
            if let Some(constraints) = &mut constraints {
                constraints.solve(&mut self.solved_bodies());
            }
        }
    }

    /// Passes of an update that has something to solve: the [iterations](Self::iterations), as far as the
    /// [limits](crate::Objects::limits) allow.
    fn passes(&self) -> u32 {
        u32::try_from(self.settings.iterations).unwrap_or(0).min(self.limits().iterations)
    }

    fn solved_bodies(&mut self) -> SolvedBodies<'_> {
        SolvedBodies { solved: &mut self.pipeline.bodies, bodies: &self.objects.bodies }
    }

    fn solve_once(&mut self, handler: &mut Handler<'_>) {
        self.solve_joints(handler);
        self.pipeline.contacts.solve_iteration(&mut self.pipeline.bodies);
        self.report.counters.passes += 1;
    }

    /// One pass over the joints in list order: those that are beyond their breakpoint break, and act once more.
    fn solve_joints(&mut self, handler: &mut Handler<'_>) {
        let PhysicsSimulator { objects, pipeline, .. } = self;
        pipeline.joints.begin_pass(&objects.joints, &objects.bodies, &mut pipeline.bodies);
        for position in 0..self.pipeline.joints.count() {
            self.solve_joint(position, handler);
        }
        self.pipeline.joints.end_pass();
    }

    fn solve_joint(&mut self, position: usize, handler: &mut Handler<'_>) {
        let Some((joint, held)) = self.objects.joints.at_mut(position) else { return };
        if !held.enabled() {
            return;
        }
        if held.breaks() {
            self.report.push(Event::JointBroke { joint });
            self.put_velocities_down(handler);
            self.tell(handler, |handler, context| handler.on_joint_broke(context, joint));
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
            self.put_velocities_down(handler);
            self.tell(handler, |handler, context| handler.on_joint_updated(context, joint));
        }
    }

    /// Somebody is going to look in the middle of a pass, if there is a handler.
    fn put_velocities_down(&mut self, handler: &mut Handler<'_>) {
        let PhysicsSimulator { objects, pipeline, .. } = self;
        if handler.get().is_some() {
            pipeline.joints.put_velocities_down(&mut objects.bodies, &pipeline.bodies);
        }
    }

    /// The velocities of the update become those of the bodies, and impulses are kept.
    pub(super) fn finish_solving(&mut self) {
        self.pipeline.bodies.finish(&mut self.objects.bodies, &mut self.report);
        self.pipeline.contacts.finish(&mut self.contacts);
    }
}

/// Stage by stage: what [`SolvedBodies`] does, from the [pre-step](PhysicsSimulator::pre_step) to
/// [`integrate`](PhysicsSimulator::integrate).
impl PhysicsSimulator {
    /// [`SolvedBodies::place`]; `None` outside of these stages, too.
    pub fn solver_place(&mut self, body: BodyId) -> Option<SolverPlace> {
        self.solved_bodies().place(body)
    }

    /// [`SolvedBodies::get`]
    pub fn solver_body(&self, place: SolverPlace) -> SolverBody {
        self.pipeline.bodies.body(place)
    }

    /// [`SolvedBodies::set`]
    pub fn set_solver_body(&mut self, place: SolverPlace, body: SolverBody) -> bool {
        self.solved_bodies().set(place, body)
    }

    /// [`SolvedBodies::fail`]
    pub fn solver_body_failed(&mut self, place: SolverPlace) {
        self.solved_bodies().fail(place);
    }
}
