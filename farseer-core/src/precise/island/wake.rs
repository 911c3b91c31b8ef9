//! Waking of [sleeping](crate::precise::island::sleep) islands: by touch, moving supports, forces, edited joints and requests
//! of the game.

use crate::body::BodyId;
use crate::controllers::ControllerKind;
use crate::objects::Objects;
use crate::precise::Precise;
use crate::precise::island::sleep::SleepingJoint;
use crate::precise::parameters::sleep::{REMEASURED_FORCE_MAX_CHANGE, TIME_TO_SLEEP};
use crate::storage::order::sort_by_number;

impl Precise {
    /// Requests that the sleeping bodies of a pair wake.
    pub(in crate::precise) fn wake_pair_bodies(&mut self, pair: usize) {
        for (body, body_type) in self.bodies_of_pair(pair) {
            if body_type.takes_impulses() {
                self.sleep.request_wake(body);
            }
        }
    }

    /// Notes for both bodies of a pair that their support may have been removed: sleeping bodies are asked to wake, and rest
    /// times reset to 0.
    pub(in crate::precise) fn pair_support_removed(&mut self, pair: usize) {
        self.bodies_of_pair(pair).into_iter().for_each(|(body, _)| self.sleep.support_removed(body));
    }

    /// Requests that the bodies of a new pair wake if none of them may move. Such a pair arises when a geom is placed beside a
    /// sleeping body.
    pub(in crate::precise) fn wake_for_new_pair(&mut self, pair: usize) {
        if !self.may_move(pair) {
            self.wake_pair_bodies(pair);
        }
    }

    /// Wakes sleeping islands that an awake body touches, that a kinematic body will move in this step, or whose forces have
    /// changed.
    pub(crate) fn wake_disturbed(&mut self, objects: &mut Objects) {
        if self.sleep.count == 0 {
            self.sleep.touched_pairs.clear();
            return;
        }
        let mut touched = std::mem::take(&mut self.sleep.touched_pairs);
        // A pair that a handler has rejected has lost its constraint.
        touched.retain(|&pair| self.pairs.all[pair as usize].constraint.is_some());
        touched.drain(..).for_each(|pair| self.wake_pair_bodies(pair as usize));
        self.sleep.touched_pairs = touched;
        self.wake_for_moving_kinematic(objects);
        self.check_forces(objects);
        self.wake_up();
        debug_assert!(self.sleep_flags_match_rows(), "rows and joints of what sleeps are put aside");
    }

    /// Returns whether exactly the contact constraints of sleeping bodies are parked. For debug assertions.
    fn sleep_flags_match_rows(&self) -> bool {
        (0..self.pairs.len()).all(|pair| {
            let state = &self.pairs.all[pair];
            state.constraint.is_none_or(|constraint| {
                let is_asleep = self.constraints.sleeping_constraint(constraint).is_some();
                self.bodies_of_pair(pair).iter().all(|&(body, body_type)| {
                    !body_type.takes_impulses() || self.sleep.is_asleep(body) == is_asleep
                })
            })
        })
    }

    /// Requests that bodies wake which touch a kinematic body that will move in this step, or which joints or springs connect
    /// to it.
    fn wake_for_moving_kinematic(&mut self, objects: &Objects) {
        for at in 0..self.bodies.kinematic.len() {
            let body = self.bodies.kinematic[at] as usize;
            let id = self.bodies.ids[body];
            if !self.will_move_in_step(body, id, objects) {
                continue;
            }
            let mut pairs = std::mem::take(&mut self.pair_scratch);
            let with_rows = |pair: &usize| self.pairs.all[*pair].constraint.is_some();
            let of_body = self.pairs.pairs_of_body(&self.proxies, body).filter(with_rows);
            pairs.extend(of_body.map(|pair| pair as u32));
            pairs.drain(..).for_each(|pair| self.wake_pair_bodies(pair as usize));
            self.pair_scratch = pairs;
            let joints = std::mem::take(&mut self.sleep.joints);
            let of_body = joints.iter().filter(|joint| joint.bodies().any(|body| Some(body) == id));
            of_body.for_each(|joint| self.wake_joint_bodies(joint));
            self.sleep.joints = joints;
        }
        self.wake_springs_of_moving_kinematic(objects);
    }

    /// Returns whether a kinematic body, or a moving box of `twohalf`, will move in this step. `id` is `None` for a box.
    pub(in crate::precise) fn will_move_in_step(
        &self,
        body_index: usize,
        id: Option<BodyId>,
        objects: &Objects,
    ) -> bool {
        let body = id.and_then(|id| objects.bodies.get(id));
        body.is_some_and(|entry| entry.body.will_move())
            || self.depth.as_ref().is_some_and(|space| match id {
                Some(id) => space.is_kinematic_moving(id),
                None => space.is_world_box_moving(body_index),
            })
    }

    /// Requests that the sleeping bodies of a joint wake.
    fn wake_joint_bodies(&mut self, joint: &SleepingJoint) {
        for body in joint.bodies() {
            if let Some(number) = self.body_index(body) {
                self.sleep.request_wake(number);
            }
        }
    }

    /// Appends a sleeping body to which a force was applied to `forced_bodies`, for [`check_forces`](Self::check_forces).
    pub(in crate::precise) fn record_forced_body(&mut self, body: usize) {
        if self.sleep.is_asleep(body) {
            self.sleep.forced_bodies.push(body as u32);
        }
    }

    /// Requests that sleeping bodies wake whose forces differ from those that they fell asleep under. Clears the forces of all
    /// others.
    ///
    /// The tolerance is an acceleration that would not exceed the sleep speed within [`TIME_TO_SLEEP`].
    fn check_forces(&mut self, objects: &mut Objects) {
        let mut forced_bodies = std::mem::take(&mut self.sleep.forced_bodies);
        self.collect_forced_bodies(objects, &mut forced_bodies);
        forced_bodies.sort_unstable();
        forced_bodies.dedup();
        forced_bodies.retain(|&body| self.sleep.is_asleep(body as usize));
        self.remeasure_forces(objects);
        let tolerance = if forced_bodies.is_empty() { 0.0 } else { self.sleep_speed() / TIME_TO_SLEEP };
        for body in forced_bodies.drain(..).map(|body| body as usize) {
            let ([x, y, turning, z], reach) =
                (self.sleep.supported_acceleration[body], self.bodies.max_extents[body]);
            let Some(id) = self.bodies.ids[body] else { continue };
            let Some(entry) = objects.bodies.get_mut(id) else { continue };
            let in_depth = self.depth.as_ref().map_or(0.0, |space| (space.acceleration(id) - z).abs());
            if in_depth > tolerance
                || !entry.body.take_unchanged_forces([x, y, turning], reach, tolerance - in_depth)
            {
                self.sleep.request_wake(body);
            } else if let Some(space) = self.depth.as_deref_mut() {
                space.clear_acceleration(id);
            }
        }
        self.sleep.forced_bodies = forced_bodies;
    }

    /// Measures the forces on bodies that fell asleep in the last step again, and stores them as supported accelerations.
    ///
    /// A damped spring exerts another force on a body at velocity 0. If a component has changed by more than
    /// [`REMEASURED_FORCE_MAX_CHANGE`], the stored accelerations stay.
    fn remeasure_forces(&mut self, objects: &Objects) {
        let mut newly_asleep = std::mem::take(&mut self.sleep.newly_asleep);
        newly_asleep.retain(|&body| self.sleep.is_asleep(body as usize));
        for body in newly_asleep.drain(..).map(|body| body as usize) {
            let Some(id) = self.bodies.ids[body] else { continue };
            let Some(entry) = objects.bodies.get(id) else { continue };
            let ([x, y, turning], before) =
                (entry.body.pending_accelerations(), self.sleep.supported_acceleration[body]);
            let now = [x, y, turning, self.depth.as_ref().map_or(0.0, |space| space.acceleration(id))];
            let is_near =
                |at: usize| (now[at] - before[at]).abs() <= REMEASURED_FORCE_MAX_CHANGE * before[at].abs();
            if (0..4).all(is_near) {
                self.sleep.supported_acceleration[body] = now;
            }
        }
        self.sleep.newly_asleep = newly_asleep;
    }

    /// Appends to `forced_bodies` the indices of sleeping bodies that springs or controllers may act on, and of bodies that
    /// fell asleep under forces.
    fn collect_forced_bodies(&self, objects: &Objects, forced_bodies: &mut Vec<u32>) {
        forced_bodies.extend_from_slice(&self.sleep.loaded_bodies);
        let mut record = |body: Option<BodyId>| {
            let number = body.and_then(|body| self.body_index(body));
            forced_bodies
                .extend(number.filter(|&number| self.sleep.is_asleep(number)).map(|number| number as u32));
        };
        for (_, spring) in (0..objects.springs.list().len()).filter_map(|at| objects.springs.at(at)) {
            spring.ends().into_iter().for_each(&mut record);
        }
        let controllers = &objects.controllers;
        for (_, controller) in (0..controllers.list().len()).filter_map(|at| controllers.at(at)) {
            match controller.kind() {
                ControllerKind::FluidDrag(drag) => {
                    drag.geoms().for_each(|geom| record(objects.geoms.get(geom).map(|geom| geom.body)));
                }
                // A gravity controller acts on all bodies.
                ControllerKind::Gravity(_) => {
                    objects.bodies.list().iter().for_each(|&body| record(Some(body)))
                }
                _ => {}
            }
        }
    }

    /// Requests that bodies wake whose joints have been added, removed or edited since the bodies fell asleep.
    #[inline]
    pub(in crate::precise) fn wake_for_changed_joints(&mut self, objects: &Objects) {
        if self.sleep.count > 0 && !self.joint_table.are_imported() {
            self.wake_unless_joints_are_known(objects);
        }
    }

    /// Requests that bodies wake whose joints are in one list only: in that of sleeping joints or in that of `objects`.
    fn wake_unless_joints_are_known(&mut self, objects: &Objects) {
        let mut is_listed = vec![false; objects.joints.slot_count()];
        objects.joints.list().iter().for_each(|joint| is_listed[joint.slot()] = true);
        self.wake_unless_unchanged(objects, |joint| is_listed.get(joint.joint.slot()) == Some(&true));
        let mut is_known = vec![false; objects.joints.slot_count()];
        for joint in &self.sleep.joints {
            // A damaged snapshot may contain any slot.
            is_known.get_mut(joint.joint.slot()).into_iter().for_each(|is_known| *is_known = true);
        }
        let all = (0..objects.joints.list().len()).filter_map(|at| objects.joints.at(at));
        for joint in all.filter(|(id, _)| !is_known[id.slot()]) {
            if let Some(joint) = self.sleeping_joint(joint, &objects.bodies) {
                self.wake_joint_bodies(&joint);
            }
        }
    }

    /// Requests that bodies wake whose joints have an edited motor or limit.
    pub(crate) fn wake_for_edited_drives(&mut self, objects: &Objects) {
        self.wake_unless_unchanged(objects, |_| true);
    }

    /// Requests that the bodies of a stored joint wake if the joint has changed since they fell asleep, connects an awake
    /// dynamic body, or `may_stay` is false for it.
    fn wake_unless_unchanged(&mut self, objects: &Objects, may_stay: impl Fn(&SleepingJoint) -> bool) {
        let known = std::mem::take(&mut self.sleep.joints);
        for joint in &known {
            if !(may_stay(joint) && self.is_joint_unchanged(joint, objects)) || self.has_awake_body(joint) {
                self.wake_joint_bodies(joint);
            }
        }
        self.sleep.joints = known;
    }

    /// Returns whether a dynamic body of a joint of sleeping bodies is awake. Such a body was static, kinematic or disabled
    /// when the other one fell asleep.
    fn has_awake_body(&self, joint: &SleepingJoint) -> bool {
        joint.bodies().filter_map(|body| self.body_index(body)).any(|number| {
            number < self.bodies.first_static()
                && self.bodies.inverse_mass_inertia[number] != [0.0; 2]
                && !self.sleep.is_asleep(number)
        })
    }

    /// Returns whether a joint has not changed since its bodies fell asleep, and does not exceed its load limits.
    fn is_joint_unchanged(&self, joint: &SleepingJoint, objects: &Objects) -> bool {
        let now = objects.joints.get(joint.joint).filter(|now| now.is_within_load_limits());
        let now = now.map(|now| (joint.joint, now));
        now.and_then(|now| self.sleeping_joint(now, &objects.bodies)) == Some(*joint)
    }

    /// Requests a new import of all joints if one of the `edited` bodies has a joint. The `edited` bodies are not in the engine's list
    /// of bodies.
    pub(in crate::precise) fn reread_joints_of_unlisted(&mut self, edited: &[BodyId]) {
        let is_of = |(first, second): (Option<BodyId>, BodyId)| {
            edited.contains(&second) || first.is_some_and(|first| edited.contains(&first))
        };
        let sleeping = self.sleep.joints.iter().map(|joint| joint.held.bodies);
        if self.joint_table.bodies_of_unlisted(&self.joints).chain(sleeping).any(is_of) {
            self.invalidate_joints();
        }
    }

    /// Wakes all sleeping bodies.
    #[inline]
    pub(in crate::precise) fn wake_all(&mut self) {
        if self.sleep.count > 0 {
            (1..=self.bodies.last_movable).for_each(|body| self.sleep.request_wake(body));
            self.wake_up();
        }
    }

    /// Requests that a body wakes in the next update, with the bodies that fell asleep with it. This counts as an edit.
    pub(crate) fn wake(&mut self, body: BodyId) {
        if let Some(loaded) = &mut self.loaded {
            loaded.wake(body);
        } else if self.is_asleep(body) && !self.wake_requests.contains(&body) {
            self.wake_requests.push(body);
        }
    }

    /// Wakes the bodies whose waking the game has requested, one after the other and before the bodies that edits wake.
    ///
    /// The order of pairs depends on the order of waking.
    #[inline]
    pub(in crate::precise) fn wake_requested_by_game(&mut self) {
        if !self.wake_requests.is_empty() {
            self.process_wake_requests_of_game();
        }
    }

    fn process_wake_requests_of_game(&mut self) {
        let others = std::mem::take(&mut self.sleep.wake_requests);
        let mut has_woken = false;
        for body in std::mem::take(&mut self.wake_requests) {
            if let Some(number) = self.body_index(body) {
                self.sleep.request_wake(number);
                if self.has_wake_requests() {
                    self.process_wake_requests();
                    has_woken = true;
                }
            }
        }
        if has_woken {
            self.drop_woken_from_lists();
        }
        self.sleep.wake_requests.extend(others);
    }

    /// Returns the number of sleeping bodies, without hinged platforms.
    pub(crate) fn asleep_count(&self) -> usize {
        self.sleep.count - self.sleeping_hinged_boxes()
    }

    /// Returns whether the body sleeps.
    pub(crate) fn is_asleep(&self, body: BodyId) -> bool {
        self.body_index(body).is_some_and(|number| self.sleep.is_asleep(number))
    }

    /// Wakes the bodies in `wake_requests`, each with all bodies that fell asleep with it.
    #[inline]
    pub(in crate::precise) fn wake_up(&mut self) {
        if self.has_wake_requests() {
            self.process_wake_requests();
            self.drop_woken_from_lists();
        }
    }

    fn has_wake_requests(&self) -> bool {
        !self.sleep.wake_requests.is_empty()
    }

    /// Makes the bodies in `wake_requests` awake, with the bodies that fell asleep with them and all pairs.
    fn process_wake_requests(&mut self) {
        let mut requests = std::mem::take(&mut self.sleep.wake_requests);
        let mut woken = Vec::new();
        requests.drain(..).for_each(|body| self.sleep.wake_ring(body as usize, |body| woken.push(body)));
        self.sleep.wake_requests = requests;
        self.wake_pairs(&woken);
    }

    /// Removes woken bodies from the lists of sleeping joints and loaded bodies, and computes the index ranges of awake bodies
    /// anew.
    fn drop_woken_from_lists(&mut self) {
        let joints = self.sleep.joints.len();
        let mut known = std::mem::take(&mut self.sleep.joints);
        known.retain(|joint| self.holds_sleeping_body(joint));
        self.sleep.joints = known;
        if self.sleep.joints.len() < joints {
            self.invalidate_joints();
        }
        let mut loaded_bodies = std::mem::take(&mut self.sleep.loaded_bodies);
        loaded_bodies.retain(|&body| self.sleep.is_asleep(body as usize));
        self.sleep.loaded_bodies = loaded_bodies;
        self.sleep.update_runs(&self.proxies);
    }

    /// Moves the pairs of woken bodies back to the awake pairs, and returns their contact constraints to the colours of the
    /// constraint graph.
    ///
    /// The pairs are taken in the order of creation numbers, because the order of constraints in the overflow colour depends on
    /// it.
    fn wake_pairs(&mut self, woken_bodies: &[u32]) {
        let mut pairs = Vec::new();
        for &body in woken_bodies {
            pairs.extend(self.pairs.pairs_of_body(&self.proxies, body as usize));
        }
        sort_by_number(&mut pairs, |&pair| self.proxies.creation_numbers(self.pairs.triggers[pair].proxies));
        pairs.dedup();
        let h = self.impulse_substep;
        for &pair in &pairs {
            self.narrow_phase().set_constraint_asleep(pair, false, h);
            if self.pairs.all[pair].constraint.is_none() {
                self.pairs.invalidate(pair);
            }
        }
        pairs.retain(|&pair| pair >= self.pairs.awake_count);
        // In ascending order, so that the indices of the pairs that follow stay valid.
        pairs.sort_unstable();
        pairs.into_iter().for_each(|pair| {
            self.narrow_phase().wake_pair(pair);
        });
        // A handler's decision on a contact holds for one step.
        self.has_handler_changes = true;
    }
}
