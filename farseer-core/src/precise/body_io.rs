//! Adapter: the bodies of the game before and after a step: velocities and forces in, poses, velocities and events out.

use farseer_precise::Solver;
use wide::f32x4;

use super::Precise;
use super::body_import::{pose_of, read_body};
use super::ids::IdTable;
use crate::body::{Body, BodyId};
use crate::math::Vector2;
use crate::objects::Objects;
use crate::report::{Event, Report};
use farseer_precise::bodies::BodySet;
use farseer_precise::depth::body_state::BodyDrag;
use farseer_precise::depth::feature_gate::FeatureGate;
use farseer_precise::depth::state::DepthState;
use farseer_precise::index::{BodyIndex, DenseIndex};
use farseer_precise::integration::{BodyForces, integrate_kinematic, integrate_poses};
use farseer_precise::island::sleep::SleepState;
use farseer_precise::non_finite::{are_motions_finite, restore_non_finite};
use farseer_precise::scaled_parameters::StepContext;

impl Precise {
    /// Sets the velocities of kinematic bodies for the step, and enlarges the fat AABBs of their fast proxies to the swept
    /// AABBs.
    ///
    /// The broad phase then pairs these proxies with the geoms along their paths.
    pub(crate) fn begin_kinematic(&mut self, objects: &Objects) {
        for at in 0..self.solver.bodies.kinematic.len() {
            let number = self.solver.bodies.kinematic[at];
            let Some((id, entry)) =
                self.ids.bodies[number].and_then(|id| Some((id, objects.bodies.get(id)?)))
            else {
                continue;
            };
            let (velocity, spin) = entry.body.kinematic_velocity(self.solver.dt);
            let along_depth = self
                .solver
                .depth
                .as_ref()
                .map_or(0.0, |space| space.kinematic_velocity(id.slot(), self.solver.dt));
            let velocity = [velocity.x, velocity.y, spin, along_depth];
            if velocity.iter().all(|velocity| velocity.is_finite()) {
                self.solver.bodies.states[number].velocity = velocity;
                let displacement = velocity.map(|velocity| velocity * self.solver.dt);
                self.solver.fat_aabbs().enlarge_kinematic_to_sweep(number, displacement);
            }
        }
    }

    /// Fourth stage of a step: copies velocities and forces of the awake [`Body`](crate::Body) objects to `bodies`, for the
    /// solvers.
    ///
    /// A body whose velocity would not be finite after the step is disabled, with an event. In this step such a body has
    /// velocity 0 and no forces.
    pub(crate) fn read_bodies(
        &mut self,
        objects: &mut Objects,
        gravity: Vector2,
        step: &StepContext,
        report: &mut Report,
    ) {
        let Precise { solver: Solver { bodies, sleep, depth, .. }, ids, edits, .. } = self;
        let names = (&*ids, &*sleep);
        edits.needs_rebuild |= match depth {
            None => read_runs(bodies, names, objects, (gravity, step), report, |_, _, _, _| {}),
            Some(space) => {
                let begin_depth = |number: BodyIndex, id: BodyId, body: &Body, read: &mut BodyForces| {
                    begin_depth_velocity(space, (number, id), body, read, step);
                };
                read_runs(bodies, names, objects, (gravity, step), report, begin_depth)
            }
        };
        if let Some(space) = &mut self.solver.depth {
            space.clear_fixed_rotation_velocities(&mut self.solver.bodies, &self.solver.sleep);
            space.begin_world_box_velocities(&mut self.solver.bodies);
        }
    }

    /// Sixth stage of a step: writes the new poses and velocities to the [`Body`](crate::Body) objects and adds an event for
    /// each moved body.
    ///
    /// A body whose new pose or velocity is not finite keeps the pose and velocity that it had before the step. The fastest of
    /// such bodies is disabled, and impulses that are not finite are cleared.
    pub(crate) fn write_bodies(&mut self, objects: &mut Objects, report: &mut Report) {
        integrate_kinematic(&mut self.solver.bodies, self.solver.dt);
        self.axis_locks.hold(&self.ids, &mut self.solver);
        let depth = self.solver.depth.as_ref().map(FeatureGate::by_ref);
        if !are_motions_finite(&self.solver.bodies, &self.solver.sleep, depth) {
            self.restore_non_finite_bodies(objects, report);
        }
        self.write_moved_bodies(objects, report);
        integrate_poses(&mut self.solver.bodies, &self.solver.sleep.awake_body_runs);
        for at in 0..self.solver.bodies.kinematic.len() {
            let number = self.solver.bodies.kinematic[at];
            // A kinematic body that reaches its target has the pose of the target, bit for bit.
            if let Some(entry) = self.ids.bodies[number].and_then(|id| objects.bodies.get(id)) {
                self.solver.bodies.set_pose(number, pose_of(&entry.body));
            }
        }
        if let Some(space) = &mut self.solver.depth {
            space.reset_fixed_rotation_poses(&mut self.solver.bodies, &self.solver.sleep);
            space.store_world_boxes(&mut self.solver.bodies, &mut self.solver.proxies);
        }
    }

    /// Writes the new poses and velocities of awake bodies to their objects, and adds an event for each moved body.
    fn write_moved_bodies(&mut self, objects: &mut Objects, report: &mut Report) {
        let Precise { solver: Solver { bodies, sleep, depth, .. }, ids, .. } = self;
        let names = (&*ids, &*sleep);
        match depth {
            None => write_runs(bodies, names, objects, report, |_, _, _, _| {}),
            Some(space) => {
                let store_depth = |number: BodyIndex, id: BodyId, path: [f32; 4], speed: f32| {
                    space.store_position(number, id.slot(), path, speed);
                };
                write_runs(bodies, names, objects, report, store_depth);
            }
        }
    }

    /// Gives each awake body whose new pose or velocity is not finite the pose and velocity that it had before the step. The
    /// fastest of these bodies is disabled.
    #[cold]
    fn restore_non_finite_bodies(&mut self, objects: &mut Objects, report: &mut Report) {
        let depth = self.solver.depth.as_mut().map(FeatureGate::by_mut);
        for (number, disabled) in restore_non_finite(&mut self.solver.bodies, &self.solver.sleep, depth) {
            let Some(body) = self.ids.bodies[number] else { continue };
            if let Some(space) = &mut self.solver.depth {
                space.body_mut(body.slot()).target = None;
            }
            if let Some(entry) = objects.bodies.get_mut(body).filter(|_| disabled) {
                entry.body.set_enabled(false);
                entry.body.clear_target();
                self.edits.needs_rebuild = true;
            }
            report.push(Event::NotFinite { body, disabled });
        }
        self.solver.constraints.reset_non_finite(self.solver.depth.is_some());
    }
}

/// Adds velocity and forces of a body along z to `read`. `body`: index and id of the body.
fn begin_depth_velocity(
    space: &mut DepthState,
    (body_index, id): (BodyIndex, BodyId),
    body: &Body,
    read: &mut BodyForces,
    step: &StepContext,
) {
    if body.is_kinematic() {
        read.velocity[3] = space.begin_kinematic(id.slot(), step.dt);
        return;
    }
    let drag = BodyDrag {
        rates: body.drag_rates(),
        quadratic: body
            .is_quadratic_drag_enabled()
            .then(|| [body.quadratic_drag_coefficient(), body.inverse_mass()]),
    };
    space.begin_velocity((body_index, id.slot()), &drag, read, step);
}

/// Copies velocities and forces of the awake bodies to `bodies`: see [`read_bodies`](Precise::read_bodies). Returns whether a
/// body was disabled.
///
/// `begin_depth` adds velocity and forces along the depth axis. Its arguments are the index of a body, its id, the body and
/// what was read of it.
#[inline(always)]
fn read_runs(
    bodies: &mut BodySet,
    names: (&IdTable, &SleepState),
    objects: &mut Objects,
    (gravity, step): (Vector2, &StepContext),
    report: &mut Report,
    mut begin_depth: impl FnMut(BodyIndex, BodyId, &Body, &mut BodyForces),
) -> bool {
    let gravity = f32x4::new([gravity.x, gravity.y, 0.0, 0.0]);
    let (dt, h, substeps) = (step.dt, step.h, f32x4::splat(step.substeps as f32));
    let mut has_disabled = false;
    for run in names.1.awake_body_runs.iter().cloned() {
        let (states, initial_velocities) =
            (bodies.states.slice_mut(run.clone()), bodies.initial_velocity.slice_mut(run.clone()));
        let (force_deltas, force_position_deltas) =
            (bodies.force_delta.slice_mut(run.clone()), bodies.force_position_delta.slice_mut(run.clone()));
        let ids_and_sleep = names.0.bodies.slice(run.clone()).iter().zip(names.1.states(run.clone()));
        for (((((state, initial_velocity), force_delta), force_position_delta), (id, sleep)), number) in
            states
                .iter_mut()
                .zip(initial_velocities)
                .zip(force_deltas)
                .zip(force_position_deltas)
                .zip(ids_and_sleep)
                .zip(run.map(BodyIndex::new))
        {
            if let Some(id) = *id
                && !SleepState::is_asleep_state(*sleep)
                && let Some(entry) = objects.bodies.get_mut(id)
            {
                let mut read = read_body(&mut entry.body, gravity, dt, h);
                begin_depth(number, id, &entry.body, &mut read);
                let then = f32x4::new(read.velocity) + f32x4::new(read.force_delta) * substeps;
                if !(then * f32x4::ZERO).simd_eq(f32x4::ZERO).all() {
                    read = disable_non_finite(&mut entry.body, id, report);
                    has_disabled = true;
                }
                (state.velocity, *initial_velocity) = (read.velocity, read.velocity);
                (*force_delta, *force_position_delta) = (read.force_delta, read.force_position_delta);
            }
        }
    }
    has_disabled
}

/// Disables a body whose velocity would not be finite after the step, with an event. Returns what the step takes instead:
/// velocity 0 and no forces.
#[cold]
fn disable_non_finite(body: &mut Body, id: BodyId, report: &mut Report) -> BodyForces {
    body.set_enabled(false);
    report.push(Event::NotFinite { body: id, disabled: true });
    BodyForces::default()
}

/// Writes the new poses and velocities of awake bodies to their objects, and adds an event for each moved body.
///
/// `store_depth` stores position and velocity along the depth axis. Its arguments are the index of a body, its id, its
/// displacement in the step and its velocity along the depth axis, in length units/s.
#[inline(always)]
fn write_runs(
    bodies: &mut BodySet,
    names: (&IdTable, &SleepState),
    objects: &mut Objects,
    report: &mut Report,
    mut store_depth: impl FnMut(BodyIndex, BodyId, [f32; 4], f32),
) {
    let mut moved = 0;
    for run in names.1.awake_body_runs.iter().cloned() {
        let (states, rotations) = (bodies.states.slice(run.clone()), bodies.rotations.slice_mut(run.clone()));
        let (poses, delta_poses) = (bodies.poses.slice(run.clone()), bodies.delta_pose.slice(run.clone()));
        let ids_and_sleep = names.0.bodies.slice(run.clone()).iter().zip(names.1.states(run.clone()));
        for (((((state, rotation), pose), delta_pose), (id, sleep)), number) in states
            .iter()
            .zip(rotations)
            .zip(poses)
            .zip(delta_poses)
            .zip(ids_and_sleep)
            .zip(run.map(BodyIndex::new))
        {
            if let Some(id) = *id
                && !SleepState::is_asleep_state(*sleep)
                && let Some(entry) = objects.bodies.get_mut(id)
            {
                let ([x, y, ..], [dx, dy, turned, _]) = (*pose, *delta_pose);
                let [vx, vy, spin, speed_along_depth] = state.velocity;
                entry.body.end_step([x + dx, y + dy], turned, [vx, vy], spin);
                *rotation = entry.body.rotation();
                store_depth(number, id, *delta_pose, speed_along_depth);
                if *delta_pose != [0.0; 4] {
                    moved += 1;
                    report.push(Event::BodyUpdated { body: id });
                }
            }
        }
    }
    report.counters.bodies_moved += moved;
}
