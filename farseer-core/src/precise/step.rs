//! The step of the precise engine after the broad phase: narrow phase, solvers, write to the bodies, refit of AABBs.
//!
//! Islands in the direct solver and free articulations have solvers of their own. All other constraints are solved by the
//! [iterative solver](super::contact_solver::iterative_solver) in substeps. If it has no constraint at all, all bodies move in
//! free flight without substeps ([`integrate_free_flight`]).

use crate::precise::parameters::broad_phase::COORDINATE_HEADROOM;
use wide::f32x4;

use super::Precise;
use super::bodies::BodySet;
use super::body_import::{BodyForces, pose_of, read_body};
use super::broad_phase::fat_aabbs::FatAabbs;
use super::depth::{FeatureGate, brace_at_stops, finish_hinges, list_hinged_boxes};
use super::direct_solver::island_solver::IslandSolver;
use super::integration::{integrate_free_flight, integrate_poses};
use super::joint_import::{JointImport, export_joints};
use super::narrow_phase::NarrowPhaseStats;
use super::scaled_parameters::LoadAdaptation;
pub(crate) use super::scaled_parameters::StepContext;
use super::spring_import::{SpringChoice, import_springs};
use crate::math::Vector2;
use crate::objects::Objects;
use crate::precise::contact_solver::iterative_solver::IterativeSolver;
use crate::precise::contact_solver::soft_step::{update_circle_contact, update_circle_contacts};
use crate::report::{Event, Report};
use crate::springs::{SpringForce, SpringId};

/// Returns the lanes of `numbers`, with 0 in place of each lane that is not finite.
fn zero_unless_finite(numbers: f32x4) -> f32x4 {
    numbers & (numbers * f32x4::ZERO).simd_eq(f32x4::ZERO)
}

impl Precise {
    /// Third stage of a step, the narrow phase: updates manifolds and contact constraints of the pairs that have moved beyond
    /// their tolerance. `max_contacts`: most contact points per pair, 0..=2. Returns the number of updated pairs.
    pub(crate) fn find_contacts(&mut self, friction: crate::FrictionType, max_contacts: u32) -> usize {
        self.narrow_phase_stats = NarrowPhaseStats::default();
        self.rolling_contacts.clear();
        self.release_one_way();
        let has_friction_changed = std::mem::replace(&mut self.friction, friction) != friction;
        let has_limit_changed = std::mem::replace(&mut self.max_contacts, max_contacts) != max_contacts;
        if has_friction_changed || has_limit_changed {
            self.wake_all();
            (0..self.pairs.len()).for_each(|pair| self.pairs.invalidate(pair));
        }
        if std::mem::take(&mut self.has_handler_changes) {
            self.clear_handler_overrides();
        }
        let mut separated = std::mem::take(&mut self.pair_scratch);
        let speculative_distance = self.parameters.speculative_distance;
        update_circle_contacts(
            &mut self.constraints.one_point,
            &self.bodies.poses,
            &self.bodies.circles,
            speculative_distance,
            |pair| separated.push(pair),
        );
        self.constraints.update_direct_constraints(|lane| {
            let is_separated =
                update_circle_contact(lane, &self.bodies.poses, &self.bodies.circles, speculative_distance);
            separated.extend((is_separated == Some(true)).then_some(lane.pair));
            is_separated.is_some()
        });
        separated.sort_unstable();
        let separated_circles = separated.len();
        for pair in separated.drain(..) {
            self.narrow_phase().update_contact(pair as usize);
        }
        self.pair_scratch = separated;
        let updated =
            separated_circles + self.update_static_sensor_pairs() + self.narrow_phase().update_contacts();
        self.find_contacts_ahead_of_kinematic();
        self.store_penetration();
        updated
    }

    /// Ends the vetoes and surface settings that collision handlers made for one step, and invalidates the vetoed awake pairs.
    /// A sleeping pair keeps its contact constraint as the handlers left it until it wakes.
    fn clear_handler_overrides(&mut self) {
        for pair in 0..self.pairs.len() {
            let is_awake = pair < self.pairs.awake_count;
            let was_vetoed = std::mem::take(&mut self.pairs.all[pair].is_vetoed);
            self.pairs.all[pair].was_vetoed = was_vetoed;
            self.has_handler_changes |= was_vetoed;
            if was_vetoed && is_awake {
                self.pairs.invalidate(pair);
            }
            if is_awake && std::mem::take(&mut self.pairs.all[pair].has_surface_override) {
                self.narrow_phase().reset_surface_parameters(pair);
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
        let Precise { bodies, ids, sleep, edits, depth, .. } = self;
        let substeps = f32x4::splat(step.substeps as f32);
        for run in &sleep.awake_body_runs {
            let (states, initial_velocities) =
                (&mut bodies.states[run.clone()], &mut bodies.initial_velocity[run.clone()]);
            let (force_deltas, force_position_deltas) =
                (&mut bodies.force_delta[run.clone()], &mut bodies.force_position_delta[run.clone()]);
            let ids = run.clone().zip(&ids.bodies[run.clone()]);
            for ((((state, initial_velocity), force_delta), force_position_delta), (number, id)) in states
                .iter_mut()
                .zip(initial_velocities)
                .zip(force_deltas)
                .zip(force_position_deltas)
                .zip(ids)
            {
                let entry = id.filter(|_| !sleep.is_asleep(number)).and_then(|id| objects.bodies.get_mut(id));
                let (Some(id), Some(entry)) = (*id, entry) else { continue };
                let mut read = read_body(&mut entry.body, gravity, step.dt, step.h);
                if let Some(space) = depth {
                    space.begin_velocity(number, &entry.body, &mut read, step, id);
                }
                let then = f32x4::new(read.velocity) + f32x4::new(read.force_delta) * substeps;
                if !(then * f32x4::ZERO).simd_eq(f32x4::ZERO).all() {
                    read = BodyForces::default();
                    entry.body.set_enabled(false);
                    report.push(Event::NotFinite { body: id, disabled: true });
                    edits.needs_rebuild = true;
                }
                (state.velocity, *initial_velocity) = (read.velocity, read.velocity);
                (*force_delta, *force_position_delta) = (read.force_delta, read.force_position_delta);
            }
        }
        if let Some(space) = &self.depth {
            space.clear_fixed_rotation_velocities(&mut self.bodies, &self.sleep);
        }
        self.begin_world_box_velocities();
    }

    /// Returns the length of the last step, seconds, >= 0; 0 before the first step.
    pub(crate) fn last_dt(&self) -> f32 {
        self.dt
    }

    /// Begins a step: stores its length `dt` (seconds, > 0), `gravity` (length units/s^2) and whether bodies `may_sleep`.
    /// Returns the parameters of the step for the solvers.
    pub(crate) fn begin_step(
        &mut self,
        dt: f32,
        substeps: u32,
        gravity: Vector2,
        may_sleep: bool,
    ) -> StepContext {
        self.set_sleep(may_sleep, gravity);
        self.depth.iter_mut().for_each(|space| space.newly_asleep.clear());
        (self.dt, self.gravity_delta) = (dt, [gravity.x * dt, gravity.y * dt]);
        self.begin_world_boxes(dt);
        let kept = self.step_context.filter(|last| last.dt == dt && last.substeps == substeps);
        *self.step_context.insert(kept.unwrap_or_else(|| StepContext::new(dt, substeps, &self.parameters)))
    }

    /// Sixth stage of a step: writes the new poses and velocities to the [`Body`](crate::Body) objects and adds an event for
    /// each moved body.
    ///
    /// A body whose new pose or velocity is not finite keeps the pose and velocity that it had before the step. The fastest of
    /// such bodies is disabled, and impulses that are not finite are cleared.
    pub(crate) fn write_bodies(&mut self, objects: &mut Objects, report: &mut Report) {
        self.finish_kinematic();
        if !self.is_finite() {
            self.restore_non_finite_bodies(objects, report);
        }
        let Precise { bodies, ids, sleep, depth, .. } = self;
        for run in &sleep.awake_body_runs {
            let (states, rotations) = (&bodies.states[run.clone()], &mut bodies.rotations[run.clone()]);
            let (poses, delta_poses) = (&bodies.poses[run.clone()], &bodies.delta_pose[run.clone()]);
            let ids = run.clone().zip(&ids.bodies[run.clone()]);
            for ((((state, rotation), pose), delta_pose), (number, id)) in
                states.iter().zip(rotations).zip(poses).zip(delta_poses).zip(ids)
            {
                let id = id.filter(|_| !sleep.is_asleep(number));
                let Some(entry) = id.and_then(|id| objects.bodies.get_mut(id)) else { continue };
                let ([x, y, ..], [dx, dy, turned, _]) = (*pose, *delta_pose);
                let [vx, vy, spin, vz] = state.velocity;
                entry.body.end_step(Vector2::new(x + dx, y + dy), turned, Vector2::new(vx, vy), spin);
                *rotation = entry.body.rotation();
                if let (Some(space), Some(id)) = (&mut *depth, id) {
                    space.store_position(number, id, *delta_pose, vz);
                }
                if let Some(body) = id.filter(|_| *delta_pose != [0.0; 4]) {
                    report.counters.bodies_moved += 1;
                    report.push(Event::BodyUpdated { body });
                }
            }
        }
        integrate_poses(bodies, &sleep.awake_body_runs);
        for at in 0..self.bodies.kinematic.len() {
            let number = self.bodies.kinematic[at] as usize;
            // A kinematic body that reaches its target has the pose of the target, bit for bit.
            if let Some(entry) = self.ids.bodies[number].and_then(|id| objects.bodies.get(id)) {
                self.bodies.set_pose(number, pose_of(&entry.body));
            }
        }
        if let Some(space) = &self.depth {
            space.reset_fixed_rotation_poses(&mut self.bodies, &self.sleep);
        }
        self.store_world_boxes();
    }

    /// Gives each kinematic body the velocity that the game prescribes, and the displacement velocity * dt. Impulses of the
    /// solver do not change the motion of a kinematic body.
    fn finish_kinematic(&mut self) {
        let BodySet { kinematic, states, initial_velocity, delta_pose, .. } = &mut self.bodies;
        for &number in kinematic.iter() {
            let number = number as usize;
            states[number].velocity = initial_velocity[number];
            delta_pose[number] = initial_velocity[number].map(|velocity| velocity * self.dt);
        }
    }

    /// Returns whether the new poses and velocities of all awake bodies are finite.
    fn is_finite(&self) -> bool {
        let BodySet { poses, delta_pose, states, .. } = &self.bodies;
        let mut sum = f32x4::ZERO;
        for run in &self.sleep.awake_body_runs {
            let of_run = poses[run.clone()].iter().zip(&delta_pose[run.clone()]).zip(&states[run.clone()]);
            for ((pose, delta_pose_of_body), state) in of_run {
                // The headroom leaves room for the corners of shapes around the body.
                let place =
                    (f32x4::new(*pose) + f32x4::new(*delta_pose_of_body)) * f32x4::splat(COORDINATE_HEADROOM);
                sum += (place + f32x4::new(state.velocity)) * f32x4::ZERO;
            }
        }
        sum.to_array() == [0.0; 4] && self.is_depth_finite()
    }

    /// Returns whether the new z positions and the angular velocities about X and Y of all awake bodies are finite. True in
    /// plain 2D.
    fn is_depth_finite(&self) -> bool {
        self.depth.as_ref().is_none_or(|space| {
            self.sleep.awake_bodies(self.bodies.last_movable).all(|number| {
                let place =
                    (space.z_positions[number] + self.bodies.delta_pose[number][3]) * COORDINATE_HEADROOM;
                place.is_finite() && space.is_spin_finite(number)
            })
        })
    }

    /// Gives each awake body whose new pose or velocity is not finite the pose and velocity that it had before the step. The
    /// fastest of these bodies is disabled, and impulses that are not finite are cleared.
    #[cold]
    fn restore_non_finite_bodies(&mut self, objects: &mut Objects, report: &mut Report) {
        let is_finite = |number: usize| {
            let (pose, path) = (self.bodies.poses[number], self.bodies.delta_pose[number]);
            let velocity = self.bodies.states[number].velocity;
            let z = self.depth.as_ref().map_or(0.0, |space| space.z_positions[number]);
            let from = [pose[0], pose[1], 0.0, z];
            let spins = self.depth.as_ref().is_none_or(|space| space.is_spin_finite(number));
            spins
                && (0..4).all(|i| {
                    velocity[i].is_finite() && ((path[i] + from[i]) * COORDINATE_HEADROOM).is_finite()
                })
        };
        let non_finite: Vec<usize> =
            self.sleep.awake_bodies(self.bodies.last_movable).filter(|&number| !is_finite(number)).collect();
        let speed = |number: usize| {
            let [x, y, spin, z] = self.bodies.initial_velocity[number].map(f64::from);
            x * x + y * y + spin * spin + z * z
        };
        let fastest = non_finite.iter().map(|&number| speed(number)).fold(0.0, f64::max);
        for &number in &non_finite {
            let disabled = speed(number) >= fastest;
            (self.bodies.states[number].velocity, self.bodies.delta_pose[number]) =
                (self.bodies.initial_velocity[number], [0.0; 4]);
            let Some(body) = self.ids.bodies[number] else { continue };
            if let Some(space) = self.depth.as_deref_mut() {
                space.reset_non_finite_spin(number);
                space.body_mut(body).target = None;
            }
            if let Some(entry) = objects.bodies.get_mut(body).filter(|_| disabled) {
                entry.body.set_enabled(false);
                entry.body.clear_target();
                self.edits.needs_rebuild = true;
            }
            report.push(Event::NotFinite { body, disabled });
        }
        self.reset_non_finite_impulses();
    }

    /// Sets the accumulated impulses, rest impulses and separations in the constraints of the iterative solver to 0 where they
    /// are not finite.
    fn reset_non_finite_impulses(&mut self) {
        self.for_each_impulse(|impulse| *impulse = zero_unless_finite(*impulse));
        let mut forget = |points: &mut [super::constraint_graph::ContactPointSimd]| {
            points.iter_mut().for_each(|point| point.separation = zero_unless_finite(point.separation));
        };
        self.constraints.two_points.for_each(|row| forget(&mut row.points));
        self.constraints.one_point.for_each(|row| forget(&mut row.points));
        self.constraints.two_points_static.for_each(|row| forget(&mut row.points));
        self.constraints.one_point_static.for_each(|row| forget(&mut row.points));
        self.constraints.depth.for_each_point(&mut forget);
    }

    /// Calls `change` with each accumulated impulse and rest impulse of the contact constraints in the iterative solver, four
    /// lanes at a time.
    fn for_each_impulse(&mut self, change: impl Fn(&mut f32x4)) {
        if self.depth.is_some() {
            return self.for_each_impulse_3d(&change);
        }
        let change = |tangent: &mut f32x4, points: &mut [super::constraint_graph::ContactPointSimd]| {
            change(tangent);
            for point in points {
                change(&mut point.normal_impulse);
                change(&mut point.rest_impulse);
            }
        };
        self.constraints.two_points.for_each(|row| change(&mut row.tangent_impulse, &mut row.points));
        self.constraints.one_point.for_each(|row| change(&mut row.tangent_impulse, &mut row.points));
        self.constraints.two_points_static.for_each(|row| change(&mut row.tangent_impulse, &mut row.points));
        self.constraints.one_point_static.for_each(|row| change(&mut row.tangent_impulse, &mut row.points));
    }

    /// Fifth stage of a step, the solver: computes new velocities and displacements of all awake bodies in `bodies`.
    pub(crate) fn solve(&mut self, step: &StepContext) {
        if self.impulse_substep != step.h {
            self.scale_impulses(step.h);
        }
        self.select_solvers(&step.load_adaptation);
        if let Some(space) = &mut self.depth {
            list_hinged_boxes(space, &self.bodies, &self.sleep, step);
            brace_at_stops(space, &self.proxies, &self.pairs, &mut self.constraints);
        }
        self.solve_direct(step);
        self.joints.step_free_articulations(&self.bodies, step);
        if self.constraints.is_empty() && self.joints.are_all_contact_free() && self.springs.are_all_solved()
        {
            integrate_free_flight(&mut self.bodies, &self.sleep.awake_body_runs, step);
            self.joints.equalize_z_displacement(&mut self.bodies, step.dt);
        } else {
            let mut solver = self.iterative_solver();
            solver.solve(step);
            solver.store_pivots(step);
            self.store_rolling_contacts();
        }
        self.joints.store(&mut self.bodies, step);
        self.direct_solver.store(&mut self.bodies, step.dt);
        if let Some(space) = &mut self.depth {
            let constraints = (&self.color_usage, self.constraints.has_overflow());
            let unit = self.parameters.length_unit;
            finish_hinges(space, &mut self.bodies, &mut self.sleep, constraints, unit, step);
        }
    }

    /// Fourth stage of a step: moves the joint constraints to the poses of this step, prepares their solvers, and builds the
    /// springs that are rows. Imports the joints first if one was edited.
    pub(crate) fn import_joints(&mut self, objects: &Objects, step: &StepContext) {
        let Precise { joint_table, joints, springs, bodies, ids, sleep, depth, .. } = self;
        let import = JointImport::new(&objects.bodies, (bodies, ids), sleep, depth.as_ref());
        let springs_signature = import_springs(joint_table, springs, import, objects);
        joints.begin_update(self.parameters.length_unit);
        import.reimport_joints(joint_table, joints, objects);
        let (joints_signature, are_indices_new) = joint_table.take_signature();
        self.direct_solver.note_joints(joints_signature ^ springs_signature, are_indices_new);
        springs.begin_step(bodies, step.dt);
        if joints.is_empty() {
            return;
        }
        let all_touched = self.constraints.has_overflow();
        let is_touched = |body: usize| {
            all_touched || !self.color_usage.has_no_constraint(body) || springs.is_attached_to(body)
        };
        let import = JointImport::new(&objects.bodies, (bodies, ids), sleep, depth.as_ref());
        import.prepare_joints(joint_table, joints, objects, step, is_touched);
    }

    /// Starts the springs of an update: clears the list of springs that are rows, and imports edited joints, by which
    /// [`constrain_spring`](Self::constrain_spring) decides.
    pub(crate) fn begin_springs(&mut self, objects: &Objects) {
        let Precise { joint_table, joints, bodies, ids, sleep, depth, .. } = self;
        joint_table.row_springs.clear();
        if depth.is_none() && !objects.springs.list().is_empty() {
            JointImport::new(&objects.bodies, (bodies, ids), sleep, None).reimport_joints(
                joint_table,
                joints,
                objects,
            );
        }
    }

    /// Decides whether a spring is a row in this update, and adds it to the list of rows if so. Returns whether it is a row;
    /// the caller must not apply the explicit forces `pushes` then.
    pub(crate) fn constrain_spring(
        &mut self,
        id: SpringId,
        pushes: [Option<SpringForce>; 2],
        objects: &Objects,
    ) -> bool {
        if self.depth.is_some() {
            return false;
        }
        let choice = SpringChoice {
            import: self.joint_import(&objects.bodies),
            joints: &self.joints,
            pairs: &self.pairs,
            proxies: &self.proxies,
        };
        let accelerations = choice.row_accelerations(&objects.springs[id], pushes);
        self.joint_table.row_springs.extend(accelerations.map(|accelerations| (id, accelerations)));
        accelerations.is_some()
    }

    /// Writes error, anchors and force to the joints in `objects`. Joints whose load exceeds their greatest force or torque
    /// break, and `report` gets an event for each.
    pub(crate) fn export_joints(&mut self, objects: &mut Objects, report: &mut Report) {
        export_joints(&mut self.joint_table, &mut self.joints, objects, report);
    }

    /// Solver selection: computes islands and selects a solver for each island, if the selection is due. Otherwise it lists the
    /// contacts and joints of the islands where these have changed. `learning` scales the rest impulses of constraints that
    /// return to the iterative solver.
    fn select_solvers(&mut self, learning: &LoadAdaptation) {
        let has_depth = self.depth.is_some();
        if (self.has_restitution || has_depth) && self.solver_selection().has_rejected_contact() {
            self.direct_solver.timer.is_due = true;
        }
        if has_depth {
            self.direct_solver.check_listed_contacts(&self.constraints);
        } else if self.direct_solver.count_friction_checks(self.sleep.awake_bodies(self.bodies.last_movable))
            && self.solver_selection().has_slipping_contact()
        {
            self.direct_solver.timer.is_due = true;
        }
        let is_quick = self.direct_solver.timer.may_be_due
            && self.solver_selection().is_quick(self.direct_solver.choice());
        let selects = self.direct_solver.begin_selection(is_quick);
        if selects || !self.direct_solver.is_listed() {
            self.list_direct_islands(selects, learning);
        }
    }

    /// Computes the islands, and lists those of the direct solver with their contacts and joints. With `selects` solvers are
    /// selected anew, and contact constraints move between the solvers; `learning` is as in
    /// [`select_solvers`](Self::select_solvers).
    fn list_direct_islands(&mut self, selects: bool, learning: &LoadAdaptation) {
        let mut census = std::mem::take(&mut self.direct_solver.census);
        self.solver_selection()
            .count_islands(&mut census, &|body| self.bodies.states[body as usize].velocity);
        self.direct_solver.census = census;
        self.direct_solver.choose_members(selects, &self.sleep, self.bodies.last_movable);
        let Precise { direct_solver, pairs, proxies, joints, springs, .. } = self;
        direct_solver.plan_islands(selects, pairs, proxies, (joints, springs));
        if selects {
            self.move_constraints(learning);
        }
        self.direct_solver.list_contacts(&self.pairs, &self.proxies, &mut self.constraints);
        if self.depth.is_none() {
            self.direct_solver.list_joints(&self.joints, &self.springs);
        }
        self.direct_solver.mark_listed();
    }

    /// Moves contact constraints between the graph colours and the direct solver, as selected; `learning` is as in
    /// [`select_solvers`](Self::select_solvers).
    fn move_constraints(&mut self, learning: &LoadAdaptation) {
        let Precise { direct_solver, pairs, proxies, constraints, impulse_substep, .. } = self;
        direct_solver.move_constraints(pairs, proxies, constraints, learning, *impulse_substep);
    }

    /// Solves all islands of the direct solver. The contact constraints of islands without an acceptable solution move to the
    /// iterative solver.
    fn solve_direct(&mut self, step: &StepContext) {
        let solver = IslandSolver {
            bodies: &self.bodies,
            constraints: &mut self.constraints,
            joints: &mut self.joints,
            springs: &mut self.springs,
            parameters: &self.parameters,
            step,
            choice: self.direct_solver.choice(),
            has_depth: self.depth.is_some(),
        };
        if self.direct_solver.solve(solver) {
            self.move_constraints(&step.load_adaptation);
        }
    }

    /// Returns the iterative solver, which borrows the parts that it reads and writes.
    fn iterative_solver(&mut self) -> IterativeSolver<'_> {
        let restitution_threshold = match &self.depth {
            Some(_) => self.restitution_threshold_3d(),
            None => self.parameters.restitution_threshold,
        };
        IterativeSolver {
            bodies: &mut self.bodies,
            constraints: &mut self.constraints,
            color_usage: &self.color_usage,
            joints: &mut self.joints,
            springs: &self.springs,
            proxies: &self.proxies,
            pairs: &mut self.pairs,
            depth: self.depth.as_mut().map(FeatureGate::by_mut),
            parameters: &self.parameters,
            awake_body_runs: &self.sleep.awake_body_runs,
            rolling_contacts: &mut self.rolling_contacts,
            proxy_flags: &mut self.proxy_flags,
            has_restitution: self.has_restitution,
            restitution_threshold,
        }
    }

    /// Stores the rolling contacts that the iterative solver has moved, after the last substep, and clears their list.
    fn store_rolling_contacts(&mut self) {
        let mut rolling = std::mem::take(&mut self.rolling_contacts);
        for roll in rolling.drain(..).filter(|roll| roll.pivot.is_none()) {
            if let Some(handle) = self.pairs.all[roll.pair as usize].constraint {
                self.narrow_phase().store_rolling_contact(roll, handle);
            }
        }
        self.rolling_contacts = rolling;
    }

    /// Scales the accumulated contact impulses from the substep length of the last step to `h` seconds, since an impulse is
    /// force times time.
    fn scale_impulses(&mut self, h: f32) {
        let factor = f32x4::splat(h / self.impulse_substep);
        self.impulse_substep = h;
        self.for_each_impulse(|impulse| *impulse = zero_unless_finite(*impulse * factor));
    }

    /// End of the sixth stage of a step: computes a new fat AABB for each proxy whose tight AABB has left its fat AABB. The
    /// broad phase of the next step searches the pairs of these proxies.
    pub(crate) fn refit_aabbs(&mut self) {
        let Precise { bodies, proxies, grid, depth, parameters, sleep, pairs, .. } = self;
        let depth = depth.as_mut().map(FeatureGate::by_mut);
        FatAabbs { bodies, proxies, grid, depth, parameters, dt: self.dt }.refit(sleep, pairs);
    }
}
