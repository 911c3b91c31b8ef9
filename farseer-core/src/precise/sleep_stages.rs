//! Adapter: the stages that put bodies to sleep and wake them, and their order.
//!
//! The solver's part is in [`island`](farseer_precise::island). Bodies and joints of the game are read and written here,
//! in [`wake_import`](super::wake_import) and in [`sleeping_joints`](super::sleeping_joints).

use super::Precise;
use super::ids::IdTable;
use super::sleeping_joints::{JointComparison, drop_joints_of_awake};
use super::wake_import::{ForceComparison, KinematicMotion, spring_body_pairs};
use crate::body::BodyId;
use crate::math::Vector2;
use crate::objects::Objects;
use farseer_precise::Solver;
use farseer_precise::depth::feature_gate::FeatureGate;
use farseer_precise::depth::state::DepthState;
use farseer_precise::index::BodyIndex;
use farseer_precise::island::falling_asleep::RestDetector;
use farseer_precise::island::wake::{
    are_sleeping_pairs_parked, sleep_pairs, wake_partners, wake_requested, wake_touched,
};
use farseer_precise::scaled_parameters::StepContext;

impl Precise {
    /// Stores whether bodies may sleep, and gravity. All bodies wake if gravity has changed or sleeping is switched off.
    pub(super) fn set_sleep(&mut self, is_enabled: bool, gravity: Vector2) {
        let gravity = [gravity.x, gravity.y];
        if !self.solver.sleep.may_go_on(is_enabled, gravity) {
            self.wake_all();
        }
        self.solver.sleep.set_conditions(is_enabled, gravity);
    }

    /// Puts islands to sleep that have been at rest for long enough. It is the last stage of a step.
    pub(crate) fn fall_asleep(&mut self, objects: &mut Objects, step: &StepContext) {
        let Solver { bodies, sleep, parameters, dt, .. } = &mut self.solver;
        if !sleep.is_enabled() {
            return;
        }
        let is_due = sleep.accumulate_rest_time(bodies, *dt, parameters.length_unit);
        let forced = match self.sleep_options.is_empty() {
            true => Vec::new(),
            false => self.sleep_options.apply(&mut self.solver, &self.ids, objects),
        };
        if !is_due && forced.is_empty() {
            return;
        }
        let Solver { bodies, sleep, proxies, pairs, constraints, joints, dt, .. } = &mut self.solver;
        let detector = RestDetector {
            bodies,
            proxies,
            pairs,
            constraints,
            joints,
            load_adaptation: &step.load_adaptation,
            dt: *dt,
        };
        detector.list_falling_asleep(sleep, spring_body_pairs(&self.ids, objects), &forced);
        if !self.solver.sleep.falling_asleep.is_empty() {
            self.sleep_bodies(objects);
        }
    }

    /// Puts the bodies in `falling_asleep` to sleep, with their pairs and joints.
    fn sleep_bodies(&mut self, objects: &mut Objects) {
        self.solver.sleep.sleep_bodies(&mut self.solver.bodies, self.solver.dt);
        let falling_asleep = self.solver.sleep.falling_asleep.iter();
        self.sleep_events.note_fallen_asleep(falling_asleep.filter_map(|&body| self.ids.bodies[body]));
        stop_objects(&self.solver.sleep.falling_asleep, &self.ids, self.solver.depth.as_deref_mut(), objects);
        self.sleep_pairs();
        self.sleep_joints(objects);
        self.solver.sleep.update_runs(&self.solver.proxies);
    }

    /// Parks the contact constraints of pairs without an awake body: see [`sleep_pairs`].
    pub(super) fn sleep_pairs(&mut self) {
        sleep_pairs(&mut self.solver.narrow_phase());
    }

    /// Stores the joints of sleeping bodies in `sleeping_joints`, and makes the solvers import the other joints anew.
    fn sleep_joints(&mut self, objects: &Objects) {
        if self
            .solver
            .joints
            .body_pairs()
            .any(|ties| ties.iter().any(|&body| self.solver.sleep.is_asleep(body)))
        {
            self.invalidate_joints();
        }
        let Precise { solver: Solver { bodies, depth, sleep, .. }, ids, sleeping_joints, .. } = self;
        let depth = depth.as_ref().map(FeatureGate::by_ref);
        JointComparison { ids, bodies, depth, objects }.list_sleeping(sleep, sleeping_joints);
    }

    /// Wakes sleeping islands that an awake body touches, that a kinematic body will move in this step, or whose forces have
    /// changed.
    pub(crate) fn wake_disturbed(&mut self, objects: &mut Objects) {
        let Precise { solver: Solver { bodies, sleep, pairs, proxies, depth, parameters, .. }, ids, .. } =
            self;
        if sleep.count == 0 {
            sleep.touched_pairs.clear();
            return;
        }
        wake_touched(sleep, pairs, proxies);
        let motion = KinematicMotion { bodies, ids, depth: depth.as_ref().map(FeatureGate::by_ref), objects };
        for body in motion.moving_bodies() {
            wake_partners(sleep, pairs, proxies, body);
            let id = ids.bodies[body];
            let of_body =
                self.sleeping_joints.iter().filter(|joint| joint.bodies().any(|body| Some(body) == id));
            of_body.for_each(|joint| joint.request_wake(ids, sleep));
        }
        motion.wake_at_springs(sleep);
        let (depth, length_unit) = (depth.as_deref_mut(), parameters.length_unit);
        ForceComparison { bodies, ids, sleep, depth, length_unit }.wake_unless_unchanged(objects);
        self.wake_up();
        debug_assert!(
            are_sleeping_pairs_parked(
                &self.solver.sleep,
                &self.solver.pairs,
                &self.solver.proxies,
                &self.solver.constraints
            ),
            "rows and joints of what sleeps are put aside"
        );
    }

    /// Requests that bodies wake whose joints have been added, removed or edited since the bodies fell asleep.
    #[inline]
    pub(super) fn wake_for_changed_joints(&mut self, objects: &Objects) {
        if self.solver.sleep.count > 0 && !self.joint_table.are_imported() {
            let Precise { solver: Solver { bodies, depth, sleep, .. }, ids, sleeping_joints, .. } = self;
            let depth = depth.as_ref().map(FeatureGate::by_ref);
            JointComparison { ids, bodies, depth, objects }.wake_unless_known(sleeping_joints, sleep);
        }
    }

    /// Requests that bodies wake whose joints have an edited motor or limit.
    pub(crate) fn wake_for_edited_drives(&mut self, objects: &Objects) {
        let Precise { solver: Solver { bodies, depth, sleep, .. }, ids, sleeping_joints, .. } = self;
        let depth = depth.as_ref().map(FeatureGate::by_ref);
        JointComparison { ids, bodies, depth, objects }
            .wake_unless_unchanged(sleeping_joints, sleep, |_| true);
    }

    /// Requests a new import of all joints if one of the `edited` bodies has a joint. The `edited` bodies are not in the
    /// engine's list of bodies.
    pub(super) fn reread_joints_of_unlisted(&mut self, edited: &[BodyId]) {
        let is_of = |(first, second): (Option<BodyId>, BodyId)| {
            edited.contains(&second) || first.is_some_and(|first| edited.contains(&first))
        };
        let sleeping = self.sleeping_joints.iter().map(|joint| joint.held.bodies);
        if self.joint_table.bodies_of_unlisted(&self.solver.joints).chain(sleeping).any(is_of) {
            self.invalidate_joints();
        }
    }

    /// Wakes all sleeping bodies.
    #[inline]
    pub(super) fn wake_all(&mut self) {
        if self.solver.sleep.count > 0 {
            self.solver.bodies.movable().for_each(|body| self.solver.sleep.request_wake(body));
            self.wake_up();
        }
    }

    /// Requests that a body wakes in the next update, with the bodies that fell asleep with it. This counts as an edit.
    pub(crate) fn wake(&mut self, body: BodyId) {
        if let Some(loaded) = &mut self.loaded {
            loaded.wake(body);
        } else if self.is_asleep(body) && !self.edits.wake_requests.contains(&body) {
            self.edits.wake_requests.push(body);
        }
    }

    /// Wakes the bodies whose waking the game has requested, one after the other and before the bodies that edits wake.
    ///
    /// The order of pairs depends on the order of waking.
    #[inline]
    pub(super) fn wake_requested_by_game(&mut self) {
        if !self.edits.wake_requests.is_empty() {
            self.process_wake_requests_of_game();
        }
    }

    fn process_wake_requests_of_game(&mut self) {
        let others = std::mem::take(&mut self.solver.sleep.wake_requests);
        let mut has_woken = false;
        for body in std::mem::take(&mut self.edits.wake_requests) {
            if let Some(number) = self.ids.body_index(body) {
                self.solver.sleep.request_wake(number);
                if !self.solver.sleep.wake_requests.is_empty() {
                    self.process_wake_requests();
                    has_woken = true;
                }
            }
        }
        if has_woken {
            self.drop_woken_from_lists();
        }
        self.solver.sleep.wake_requests.extend(others);
    }

    /// Returns whether the body sleeps.
    pub(crate) fn is_asleep(&self, body: BodyId) -> bool {
        self.ids.body_index(body).is_some_and(|number| self.solver.sleep.is_asleep(number))
    }

    /// Wakes the bodies in `wake_requests`, each with all bodies that fell asleep with it.
    #[inline]
    pub(super) fn wake_up(&mut self) {
        if !self.solver.sleep.wake_requests.is_empty() {
            self.process_wake_requests();
            self.drop_woken_from_lists();
        }
    }

    /// Makes the bodies in `wake_requests` awake, with the bodies that fell asleep with them and all pairs.
    fn process_wake_requests(&mut self) {
        let woken = wake_requested(&mut self.solver.narrow_phase());
        self.sleep_events.note_woken(woken.into_iter().filter_map(|body| self.ids.bodies[body]));
        // A handler's decision on a contact holds for one step.
        self.solver.has_handler_changes = true;
    }

    /// Removes woken bodies from the lists of sleeping joints and loaded bodies, and computes the index ranges of awake bodies
    /// anew.
    fn drop_woken_from_lists(&mut self) {
        let before = self.sleeping_joints.len();
        drop_joints_of_awake(&mut self.sleeping_joints, &self.ids, &self.solver.sleep);
        // The locks of sleeping bodies are in no list, as they follow from the bodies.
        if self.sleeping_joints.len() < before || !self.axis_locks.is_empty() {
            self.invalidate_joints();
        }
        self.solver.sleep.drop_woken(&self.solver.proxies);
    }
}

/// Sets the velocities of the game's objects to 0 whose bodies fall asleep. `falling_asleep`: body indices.
fn stop_objects(
    falling_asleep: &[BodyIndex],
    ids: &IdTable,
    mut depth: Option<&mut DepthState>,
    objects: &mut Objects,
) {
    for body in falling_asleep.iter().copied() {
        let id = ids.bodies[body];
        if let Some(entry) = id.and_then(|id| objects.bodies.get_mut(id)) {
            entry.body.stop();
        }
        if let Some(space) = &mut depth {
            if let Some(id) = id {
                space.put_to_rest(body, id.slot());
                space.newly_asleep.push(id.to_bits());
            }
            space.put_hinge_to_rest(body);
        }
    }
}
