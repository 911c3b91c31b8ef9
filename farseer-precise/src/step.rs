//! The step of the precise engine: its stages, in their order, as the adapter calls them. The adapter reads the bodies of the game before
//! the solver, and writes them after it.
//!
//! Islands in the direct solver and free articulations have solvers of their own. All other constraints are solved by the
//! [iterative solver](super::contact_solver::iterative_solver) in substeps. If it has no constraint at all, all bodies move in
//! free flight without substeps (`integrate_free_flight`).

use super::Solver;
use super::broad_phase::fat_aabbs::FatAabbs;
use super::broad_phase::pair_finder::PairFinder;
use super::contact_solver::iterative_solver::IterativeSolver;
use super::contact_solver::rolling_resistance::scale_rolling_impulses;
use super::continuous_collision::{end_paths, find_impacts, list_fast_bodies, toi_of_carried};
use super::depth::feature_gate::FeatureGate;
use super::depth::hinged_box::{brace_at_stops, finish_hinges, list_hinged_boxes};
use super::depth::step::restitution_threshold_3d;
use super::direct_solver::island_solver::IslandSolver;
use super::integration::integrate_free_flight;
use super::narrow_phase::NarrowPhaseStats;
use super::scaled_parameters::LoadAdaptation;
use super::scaled_parameters::StepContext;
use crate::index::ProxyIndex;
use crate::math::plane::Vector;
use crate::surface::FrictionType;

impl Solver {
    /// Begins a step: stores its length `dt` (seconds, > 0) and `gravity` (x, y in length units/s^2). Returns the parameters of
    /// the step for the solvers.
    pub fn begin_step(&mut self, dt: f32, substeps: u32, gravity: Vector) -> StepContext {
        self.depth.iter_mut().for_each(|space| space.newly_asleep.clear());
        (self.dt, self.gravity_delta) = (dt, gravity.map(|part| part * dt));
        if let Some(space) = &mut self.depth {
            space.begin_world_boxes(&mut self.bodies, dt);
            let Solver { bodies, proxies, grid, depth, parameters, .. } = self;
            let depth = depth.as_mut().map(FeatureGate::by_mut);
            FatAabbs { bodies, proxies, grid, depth, parameters, dt }.pair_sweeping_boxes(&mut self.pairs);
        }
        let kept = self.step_context.filter(|last| last.dt == dt && last.substeps == substeps);
        *self.step_context.insert(kept.unwrap_or_else(|| StepContext::new(dt, substeps, &self.parameters)))
    }

    /// Second stage of a step, the broad phase: removes pairs whose fat AABBs do not overlap any more, and returns the number of
    /// new candidate pairs. The adapter knows the geoms of each candidate; candidates are sorted by creation numbers.
    pub fn find_pairs(&mut self) -> usize {
        let refitted = self.proxies.take_refitted();
        if !refitted.is_empty() {
            self.narrow_phase().remove_separated_pairs(&refitted);
        }
        self.store_ended_contacts();
        let found = self.find_new_pairs(&refitted);
        self.searched_static_proxies.clear();
        if self.depth.is_none() {
            let proxies = &self.proxies;
            let is_static_sensor = |&&proxy: &&ProxyIndex| !proxies.proxy(proxy).body_type.takes_impulses();
            self.searched_static_proxies.extend(refitted.iter().filter(is_static_sensor));
        }
        self.proxies.return_refitted(refitted);
        found
    }

    /// Finds the new pairs of these proxies, and stores them in `new_pairs`. Returns their number.
    fn find_new_pairs(&mut self, refitted: &[ProxyIndex]) -> usize {
        let Solver { proxies, pairs, grid, depth, proxy_flags, new_pairs, .. } = self;
        let depth = depth.as_ref().map(FeatureGate::by_ref);
        PairFinder { proxies, pairs, grid, depth }.find(refitted, proxy_flags, new_pairs)
    }

    /// Begins the third stage of a step, the narrow phase. `max_contacts`: most contact points per pair, 0..=2. Returns whether
    /// `friction` or `max_contacts` differ from those of the last step; then all bodies have to wake, and all pairs change.
    pub fn begin_contacts(&mut self, friction: FrictionType, max_contacts: u32) -> bool {
        self.narrow_phase_stats = NarrowPhaseStats::default();
        self.rolling_contacts.clear();
        if self.proxies.one_way_count > 0 {
            self.narrow_phase().release_one_way();
        }
        let has_friction_changed = std::mem::replace(&mut self.friction, friction) != friction;
        let has_limit_changed = std::mem::replace(&mut self.max_contacts, max_contacts) != max_contacts;
        has_friction_changed || has_limit_changed
    }

    /// Third stage of a step, the narrow phase: updates manifolds and contact constraints of the pairs that have moved beyond
    /// their tolerance. Returns the number of updated pairs.
    pub fn find_contacts(&mut self) -> usize {
        if std::mem::take(&mut self.has_handler_changes) {
            self.has_handler_changes |= self.narrow_phase().clear_handler_overrides();
        }
        let searched = std::mem::take(&mut self.searched_static_proxies);
        let mut narrow_phase = self.narrow_phase();
        let updated = narrow_phase.update_circles()
            + narrow_phase.update_static_sensor_pairs(&searched)
            + narrow_phase.update_contacts();
        narrow_phase.find_contacts_ahead_of_kinematic();
        self.searched_static_proxies = searched;
        self.store_ended_contacts();
        updated
    }

    /// Stores the penetrations of ended contacts with static bodies.
    fn store_ended_contacts(&mut self) {
        let Solver { depth, ended_static_contacts: ended, sleep, .. } = self;
        if let Some(space) = depth.as_mut().filter(|_| !ended.is_empty()) {
            space.store_residual_penetrations(ended, sleep);
        }
    }

    /// Fifth stage of a step, the solver: computes new velocities and displacements of all awake bodies in `bodies`.
    pub fn solve(&mut self, step: &StepContext) {
        if self.impulse_substep != step.h {
            let factor = step.h / self.impulse_substep;
            self.constraints.scale_impulses(factor, self.depth.is_some());
            if self.proxies.resist_rolling {
                scale_rolling_impulses(&mut self.pairs, factor);
            }
            self.impulse_substep = step.h;
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
            // Free articulations move their bodies through the whole step in the plane.
            let awake = self.bodies.movable_count.saturating_sub(self.sleep.count);
            if self.depth.is_some() || self.joints.free_body_count() != awake {
                integrate_free_flight(&mut self.bodies, &self.sleep.awake_body_runs, step);
            }
            self.joints.equalize_z_displacement(&mut self.bodies, step.dt);
        } else {
            let mut solver = self.iterative_solver();
            let has_contact_substeps = solver.solve(step);
            solver.store_pivots(step, has_contact_substeps);
            self.narrow_phase().store_rolling_contacts();
        }
        self.joints.store(&mut self.bodies, step);
        self.direct_solver.store(&mut self.bodies, step.dt);
        if let Some(space) = &mut self.depth {
            let constraints = (&self.color_usage, self.constraints.has_overflow());
            let unit = self.parameters.length_unit;
            finish_hinges(space, &mut self.bodies, &mut self.sleep, constraints, unit, step);
        }
    }

    /// Solver selection: computes islands and selects a solver for each island, if the selection is due. Otherwise it lists the
    /// contacts and joints of the islands where these have changed. `adaptation` scales the rest impulses of constraints that
    /// return to the iterative solver.
    fn select_solvers(&mut self, adaptation: &LoadAdaptation) {
        let has_depth = self.depth.is_some();
        let may_be_rejected = self.has_restitution || has_depth || self.proxies.resist_rolling;
        if may_be_rejected && self.solver_selection().has_rejected_contact() {
            self.direct_solver.timer.is_due = true;
        }
        if has_depth {
            self.direct_solver.check_listed_contacts(&self.constraints);
        } else if self.direct_solver.count_friction_checks(&self.sleep)
            && self.solver_selection().has_slipping_contact()
        {
            self.direct_solver.timer.is_due = true;
        }
        let is_quick = self.direct_solver.timer.may_be_due
            && self.solver_selection().is_quick(self.direct_solver.choice());
        let selects = self.direct_solver.begin_selection(is_quick);
        if selects || !self.direct_solver.is_listed() {
            self.list_direct_islands(selects, adaptation);
        }
    }

    /// Computes the islands, and lists those of the direct solver with their contacts and joints. With `selects` solvers are
    /// selected anew, and contact constraints move between the solvers; `adaptation` is as in
    /// [`select_solvers`](Self::select_solvers).
    fn list_direct_islands(&mut self, selects: bool, adaptation: &LoadAdaptation) {
        let mut census = std::mem::take(&mut self.direct_solver.census);
        self.solver_selection().count_islands(&mut census, &|body| self.bodies.states[body].velocity);
        self.direct_solver.census = census;
        self.direct_solver.choose_members(selects, &self.sleep, self.bodies.last_movable);
        let Solver { direct_solver, pairs, proxies, joints, springs, .. } = self;
        direct_solver.plan_islands(selects, pairs, proxies, (joints, springs));
        if selects {
            self.move_constraints(adaptation);
        }
        self.direct_solver.list_contacts(&self.pairs, &self.proxies, &mut self.constraints);
        if self.depth.is_none() {
            self.direct_solver.list_joints(&self.joints, &self.springs);
        }
        self.direct_solver.mark_listed();
    }

    /// Moves contact constraints between the graph colours and the direct solver, as selected; `adaptation` is as in
    /// [`select_solvers`](Self::select_solvers).
    fn move_constraints(&mut self, adaptation: &LoadAdaptation) {
        let Solver { direct_solver, pairs, proxies, constraints, impulse_substep, .. } = self;
        direct_solver.move_constraints(pairs, proxies, constraints, adaptation, *impulse_substep);
        constraints.release_memory();
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
            Some(_) => restitution_threshold_3d(self.gravity_delta, &self.parameters),
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
            rolling_rows: &mut self.rolling_rows,
            proxy_flags: &mut self.proxy_flags,
            has_restitution: self.has_restitution,
            restitution_threshold,
        }
    }

    /// Lists the fast bodies of the step in `fast_bodies`. Returns whether there are any.
    pub fn find_fast_bodies(&mut self) -> bool {
        self.sensor_passthroughs.clear();
        // With a depth axis, the contact normal follows from the last displacement, so that no body may penetrate another
        // deeply.
        let max_threshold =
            if self.depth.is_some() { self.parameters.speculative_distance } else { f32::MAX };
        list_fast_bodies(&self.bodies, &self.sleep, max_threshold, &mut self.fast_bodies);
        !self.fast_bodies.is_empty()
    }

    /// Finds the new pairs that fast bodies have along their paths, and stores them in `new_pairs`. Returns the number of these
    /// pairs. No pair is removed here.
    ///
    /// With a depth axis many bodies are a little fast. There the fat AABBs are enlarged to the swept AABBs, since larger ones
    /// last for several steps.
    pub fn find_pairs_of_fast_bodies(&mut self) -> usize {
        if self.depth.is_some() {
            let mut enlarged = std::mem::take(&mut self.enlarged_proxies);
            for at in 0..self.fast_bodies.len() {
                let body = self.fast_bodies[at].body;
                self.fat_aabbs().enlarge_body_to_sweep(body, &mut enlarged);
            }
            let found = self.find_new_pairs(&enlarged);
            enlarged.clear();
            self.enlarged_proxies = enlarged;
            return found;
        }
        let mut found = std::mem::take(&mut self.new_pairs);
        let mut is_known = std::mem::take(&mut self.proxy_flags);
        found.clear();
        self.swept_motion().query_sweeps(&self.fast_bodies, (&mut is_known, &mut found));
        (self.proxy_flags, self.new_pairs) = (is_known, found);
        self.new_pairs.len()
    }

    /// Ends the paths of fast bodies at their times of impact. Returns whether a body then moves on with the body that it hit.
    ///
    /// If so, the caller finds the new pairs on that path and calls [`clamp_carried_motion`](Self::clamp_carried_motion).
    pub fn clamp_to_toi(&mut self, step: &StepContext) -> bool {
        let mut fast = std::mem::take(&mut self.fast_bodies);
        let mut passthroughs = std::mem::take(&mut self.sensor_passthroughs);
        find_impacts(self.swept_motion(), &self.joints, &mut fast, &mut passthroughs);
        end_paths(&mut self.bodies, &mut fast, step.substeps as f32);
        (self.fast_bodies, self.sensor_passthroughs) = (fast, passthroughs);
        !self.fast_bodies.is_empty()
    }

    /// Ends the path of each carried body, one that moves on with the body that it hit, at the first static body on the path.
    pub fn clamp_carried_motion(&mut self) {
        let mut fast = std::mem::take(&mut self.fast_bodies);
        for flight in fast.drain(..) {
            if let Some(time) = toi_of_carried(self.swept_motion(), &flight) {
                let path = &mut self.bodies.delta_pose[flight.body];
                *path = path.map(|way| way * time);
            }
        }
        self.fast_bodies = fast;
    }

    /// End of the sixth stage of a step: computes a new fat AABB for each proxy whose tight AABB has left its fat AABB. The
    /// broad phase of the next step searches the pairs of these proxies.
    pub fn refit_aabbs(&mut self) {
        let Solver { bodies, proxies, grid, depth, parameters, dt, .. } = self;
        let depth = depth.as_mut().map(FeatureGate::by_mut);
        FatAabbs { bodies, proxies, grid, depth, parameters, dt: *dt }.refit(&self.sleep, &self.pairs);
    }
}
