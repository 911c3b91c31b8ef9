//! Solver selection: the facts about the islands that it depends on, and the islands that the direct solver gets.
//!
//! [`SolverSelection`] reads contacts, joints and bodies, and finds the islands and the facts about each ([`IslandCensus`]). From
//! these facts the direct solver takes islands and lists their members. Then contact constraints move between both solvers.

use super::constraint::Jacobian;
use super::island_io::DirectIsland;
use super::island_members::{add_joint_edges, list_contact_edges, list_jointed_bodies};
use super::lateral_friction::{blocks_planar_solution, is_planar};
use super::mass_ratio::exceeds_mass_ratio;
use super::{DirectSolver, IslandHistory, IslandStats};
use crate::math::plane::Vector;
use crate::methods::SolverChoice;
use crate::precise::bodies::BodySet;
use crate::precise::broad_phase::pairs::Pairs;
use crate::precise::broad_phase::proxies::{BodyType, Proxies};
use crate::precise::constraint_graph::{ColorUsage, ConstraintGraph, ContactConstraint, ContactPoint};
use crate::precise::island::sleep::SleepState;
use crate::precise::island::union_find::UnionFind;
use crate::precise::joints::JointSystem;
use crate::precise::joints::springs::SpringRows;
use crate::precise::narrow_phase::constraint_lifetime::move_to_direct_solver;
use crate::precise::parameters::direct::{
    ACCEPTED_JOINT_ERROR, BUSY_ISLAND_PAUSE, CALM_ISLAND_MAX_SPEED, FACTOR_PRODUCTS_PER_BODY,
    FRICTION_CHECK_MAX_DOUBLINGS, JOINTED_FACTOR_PRODUCTS_PER_BODY, RESELECTION_PERIOD, SLIP_SPEED,
    STICKING_FRICTION_FRACTION,
};
use crate::precise::scaled_parameters::{LoadAdaptation, Parameters};
use crate::storage::order::{packed_key, sort_by_number_in};
use crate::storage::reusing_clone::reusing_clone;

/// The parts of the engine that solver selection reads.
pub(in crate::precise) struct SolverSelection<'a> {
    pub(in crate::precise) bodies: &'a BodySet,
    pub(in crate::precise) proxies: &'a Proxies,
    pub(in crate::precise) pairs: &'a Pairs,
    pub(in crate::precise) constraints: &'a ConstraintGraph,
    pub(in crate::precise) color_usage: &'a ColorUsage,
    pub(in crate::precise) joints: &'a JointSystem,
    pub(in crate::precise) springs: &'a SpringRows,
    pub(in crate::precise) sleep: &'a SleepState,
    pub(in crate::precise) parameters: &'a Parameters,
    /// Island history of each body, by body index.
    pub(in crate::precise) history: &'a [IslandHistory],
    /// Velocity change by gravity in the step, for a body of gravity scale 1, in length units/s.
    pub(in crate::precise) gravity_delta: Vector,
    /// Length of the step, in seconds.
    pub(in crate::precise) dt: f32,
    /// Whether any contact may have restitution.
    pub(in crate::precise) has_restitution: bool,
    /// Whether at most [`IMMEDIATE_RESELECTION_BODIES`](crate::precise::parameters::direct::IMMEDIATE_RESELECTION_BODIES) bodies
    /// are awake.
    pub(in crate::precise) has_few_awake_bodies: bool,
    /// Whether the simulator has a depth axis (2.5D).
    pub(in crate::precise) has_depth: bool,
}

/// The islands of awake bodies, with the facts about each.
#[derive(Debug, Default)]
pub(in crate::precise) struct IslandCensus {
    /// Union-find of body indices: one set per island.
    pub(super) union_find: UnionFind,
    /// Facts about each island, by the body index that is its union-find root.
    pub(super) stats: Vec<IslandStats>,
}

reusing_clone! { IslandCensus { union_find, stats } }

impl IslandCensus {
    /// Returns the facts about the island of the body with index `body`.
    #[inline(always)]
    pub(in crate::precise) fn stats_of(&mut self, body: u32) -> &mut IslandStats {
        &mut self.stats[self.union_find.find(body) as usize]
    }
}

impl SolverSelection<'_> {
    /// Returns whether a contact of the direct solver bounces, or excludes a solution in the plane. The direct solver cannot
    /// keep such a contact.
    pub(in crate::precise) fn has_rejected_contact(&self) -> bool {
        let is_rejected = |contact: &ContactConstraint| {
            let velocities = [contact.a, contact.b].map(|body| self.bodies.states[body as usize].velocity);
            self.bounces(contact, velocities) || self.blocks_planar_solution(contact, velocities)
        };
        self.constraints.direct_constraints().iter().any(|row| is_rejected(&row.constraint))
    }

    /// Returns whether changes in islands of the iterative solver make solver selection due at once, without a wait for the
    /// [period](RESELECTION_PERIOD). `choice` is the user's choice of solvers.
    pub(in crate::precise) fn is_quick(&self, choice: SolverChoice) -> bool {
        let moves = |body: usize| self.exceeds_calm_speed(self.bodies.states[body].velocity);
        let is_calm = || !self.sleep.awake_bodies(self.bodies.last_movable).any(moves);
        choice == SolverChoice::Direct
            || (self.has_few_awake_bodies
                && (!self.joints.is_empty()
                    || !self.springs.is_empty()
                    || is_calm()
                    || self.has_unsolved_load()))
    }

    /// Returns whether a body that was due for a friction check in this update, in an island built in place, needs another
    /// solver: it is calm and friction [slips](IslandStats::slips) in the iterative solver, or its [cold
    /// start](IslandStats::is_cold_start) in the direct solver is over.
    pub(in crate::precise) fn has_slipping_contact(&self) -> bool {
        (0..self.pairs.awake_count).any(|pair| self.is_slipping(pair))
    }

    /// Returns whether the contact with index `pair` slips in the iterative solver, or had a cold start in the direct solver. The
    /// result is false unless its body B was due for a friction check in this update and belongs to an island built in place.
    fn is_slipping(&self, pair: usize) -> bool {
        let state = self.pairs.all[pair];
        let body = self.pairs.bodies_of(self.proxies, pair)[1].0;
        let IslandHistory { friction_checks, friction_check_in, formed_by_motion, .. } = self.history[body];
        let was_checked = friction_checks > 1
            && friction_check_in == 1 << (friction_checks - 1).min(FRICTION_CHECK_MAX_DOUBLINGS);
        let velocity = |body: u32| self.bodies.states[body as usize].velocity;
        let is_calm = || !self.exceeds_calm_speed(velocity(body as u32));
        let handle = state.constraint.filter(|_| was_checked && !formed_by_motion);
        let limit = SLIP_SPEED * self.parameters.length_unit;
        handle.is_some_and(|home| {
            home.is_in_direct_solver()
                || (is_calm() && slips(&self.constraints.get(state.kind, home), &velocity, limit))
        })
    }

    /// Returns whether the linear velocity `x`, `y` (length units/s) of a body is faster than [`CALM_ISLAND_MAX_SPEED`].
    fn exceeds_calm_speed(&self, [x, y, ..]: [f32; 4]) -> bool {
        let calm = CALM_ISLAND_MAX_SPEED * self.parameters.length_unit;
        x * x + y * y > calm * calm
    }

    /// Computes the islands of awake bodies and the facts about each, into `census`. `velocity` returns the velocity of a body: x
    /// and y (length units/s), angular (radians/s), depth axis (length units/s).
    pub(in crate::precise) fn count_islands(
        &self,
        census: &mut IslandCensus,
        velocity: &dyn Fn(u32) -> [f32; 4],
    ) {
        self.unite_bodies(&mut census.union_find);
        census.stats.clear();
        census.stats.resize(self.bodies.states.len(), IslandStats::default());
        for body in
            self.sleep.awake_bodies(self.bodies.last_movable).filter(|&body| !self.bodies.is_kinematic(body))
        {
            let (stats, history) = (census.stats_of(body as u32), self.history[body]);
            stats.bodies += 1;
            stats.direct_bodies += u32::from(history.is_direct && history.friction_checks == 0);
            stats.has_unsupported_joint |= self.has_depth && self.joints.has_joint(body);
            stats.was_paused |= history.back_off > 0;
            stats.pause = stats.pause.max(history.pause);
            stats.moves |= self.exceeds_calm_speed(velocity(body as u32));
            stats.formed_by_motion |= history.formed_by_motion;
        }
        self.count_joints(census);
        self.count_contacts(census, velocity);
    }

    /// Adds the contacts to the facts about their islands. `velocity` returns the velocity of a body, as in
    /// [`count_islands`](Self::count_islands).
    fn count_contacts(&self, census: &mut IslandCensus, velocity: &dyn Fn(u32) -> [f32; 4]) {
        let heavy_ratio = self.heavy_mass_ratio();
        for pair in 0..self.pairs.awake_count {
            let state = self.pairs.all[pair];
            let Some(handle) = state.constraint else { continue };
            let [(one, mobility), (body, _)] = self.pairs.bodies_of(self.proxies, pair);
            let stats = census.stats_of(body as u32);
            stats.contacts += 1;
            stats.has_unsupported_joint |= mobility == BodyType::Hinged;
            stats.has_depth = self.has_depth;
            if !(stats.has_depth || stats.slips && stats.has_load) {
                let contact = self.constraints.get(state.kind, handle);
                stats.slips |= slips(&contact, velocity, SLIP_SPEED * self.parameters.length_unit);
                stats.has_load |= contact.points.iter().any(|point| point.normal_impulse > 0.0);
            }
            let inverse_masses = [one, body].map(|body| self.bodies.inverse_mass_inertia[body][0]);
            if self.has_restitution || stats.has_depth || exceeds_mass_ratio(inverse_masses, heavy_ratio) {
                let contact = self.constraints.get(state.kind, handle);
                let velocities = [contact.a, contact.b].map(velocity);
                stats.bounces |= self.bounces(&contact, velocities);
                stats.has_nonplanar_contact |= self.blocks_planar_solution(&contact, velocities);
                let [is_heavy_on_light, may_jam] = self.classify_load(&contact);
                stats.has_heavy_on_light |= is_heavy_on_light;
                stats.may_jam |= may_jam;
            }
        }
    }

    /// Adds the joints and springs in 2D to the facts about their islands.
    fn count_joints(&self, census: &mut IslandCensus) {
        let max_error = ACCEPTED_JOINT_ERROR as f32 * self.parameters.length_unit;
        let all = self.joints.candidates().chain(self.springs.candidates());
        for joint in all.filter(|_| !self.has_depth) {
            let Some(body) = joint.first_dynamic_body() else { continue };
            let stats = census.stats_of(body);
            stats.joints += 1;
            stats.has_unsupported_joint |= joint.is_free_articulation || !joint.has_rows;
            stats.has_joint_gap |= joint.error > max_error;
        }
    }

    /// Unites in `union_find` the dynamic bodies that contacts connect, and in 2D also those that joints and springs connect.
    fn unite_bodies(&self, union_find: &mut UnionFind) {
        union_find.reset(self.bodies.states.len());
        for pair in (0..self.pairs.awake_count).filter(|&pair| self.pairs.all[pair].constraint.is_some()) {
            if let [(a, BodyType::Dynamic), (b, BodyType::Dynamic)] = self.pairs.bodies_of(self.proxies, pair)
            {
                union_find.unite(a as u32, b as u32);
            }
        }
        if !self.has_depth {
            let of_joints = self.joints.candidates().chain(self.springs.candidates());
            for [a, b] in of_joints.map(|joint| joint.bodies).filter(|[a, b]| *a != 0 && *b != 0) {
                union_find.unite(a, b);
            }
        }
    }

    /// Returns whether restitution applies at a contact. `velocities` are those of its bodies A and B.
    fn bounces(&self, contact: &ContactConstraint, velocities: [[f32; 4]; 2]) -> bool {
        bounces(contact, velocities, self.parameters.restitution_threshold)
    }

    /// Returns whether a contact [excludes a solution in the plane](blocks_planar_solution). `velocities` are those of its
    /// bodies A and B.
    fn blocks_planar_solution(&self, contact: &ContactConstraint, velocities: [[f32; 4]; 2]) -> bool {
        blocks_planar_solution(contact, velocities, self.dt, self.parameters.separation_refresh_distance)
    }
}

impl DirectSolver {
    /// Counts one update of the friction checks of all awake bodies, up to the index `last_movable`. Returns whether one of them
    /// is due.
    pub(in crate::precise) fn count_friction_checks(
        &mut self,
        sleep: &SleepState,
        last_movable: usize,
    ) -> bool {
        let mut is_due = false;
        for body in sleep.awake_bodies(last_movable) {
            is_due |= self.history[body].is_friction_check_due();
        }
        is_due
    }

    /// In 2.5D: lists the islands anew in this update, unless they list all planar contacts of the direct solver and no other
    /// contacts. The normal of a contact may turn towards the depth axis or back while the contact persists.
    pub(in crate::precise) fn check_listed_contacts(&mut self, constraints: &ConstraintGraph) {
        if !self.is_listed || self.timer.is_due {
            return;
        }
        let in_plane =
            constraints.direct_constraints().iter().filter(|row| is_planar(&row.constraint)).count();
        let islands = &self.islands[..self.count];
        let listed: usize = islands.iter().map(|island| island.contact_handles.len()).sum();
        let mut handles = islands.iter().flat_map(|island| &island.contact_handles);
        self.is_listed = listed == in_plane
            && handles.all(|&handle| is_planar(&constraints.direct_constraint(handle).constraint));
    }

    /// Lists the awake bodies of the islands that the direct solver gets, up to the body index `last_movable`. With `selects`
    /// solvers are selected anew, otherwise each island keeps its solver. Starts the pauses of islands that the direct solver
    /// gives up, and starts or ends the friction checks of the others.
    pub(in crate::precise) fn choose_members(
        &mut self,
        selects: bool,
        sleep: &SleepState,
        last_movable: usize,
    ) {
        let DirectSolver { census, keyed_items, history, timer, .. } = self;
        keyed_items.clear();
        for body in sleep.awake_bodies(last_movable) {
            let root = census.union_find.find(body as u32);
            let (stats, history) = (&census.stats[root as usize], &mut history[body]);
            let is_wanted =
                if selects { stats.rejection_reason(timer.choice).is_none() } else { history.is_direct };
            keyed_items.extend(is_wanted.then_some((root, body as u32)));
            if !selects {
                continue;
            }
            history.formed_by_motion |= stats.moves;
            let is_given_up = stats.joints > 0 && stats.was_paused && !is_wanted;
            if (stats.must_back_off() || is_given_up) && history.pause == 0 {
                history.pause = RESELECTION_PERIOD;
                timer.has_paused = true;
            }
            let is_watched = (!is_wanted || stats.is_cold_start())
                && stats.is_small_cycle()
                && !(stats.moves || stats.formed_by_motion);
            if !is_watched {
                history.friction_checks = 0;
            } else if history.friction_checks == 0 || is_wanted {
                history.begin_friction_checks();
            }
        }
    }

    /// Lists the members of each island of the direct solver, in ascending order, and analyses its matrix.
    /// [`choose_members`](Self::choose_members) has listed the bodies; `selects` is as there. An island whose factorisation has
    /// too much fill-in goes to the iterative solver for a pause of [`BUSY_ISLAND_PAUSE`] updates.
    pub(in crate::precise) fn plan_islands(
        &mut self,
        selects: bool,
        pairs: &Pairs,
        proxies: &Proxies,
        (joints, springs): (&JointSystem, &SpringRows),
    ) {
        let DirectSolver {
            islands,
            count,
            census,
            keyed_items,
            edges,
            jointed_bodies,
            sort_keys,
            history,
            timer,
            ..
        } = self;
        sort_by_number_in(sort_keys, keyed_items, |&(root, body)| packed_key([root, body]));
        if selects {
            history.iter_mut().for_each(|entry| entry.is_direct = false);
        }
        jointed_bodies.clear();
        if census.stats.iter().any(|of| of.joints > 0) {
            list_jointed_bodies((joints, springs), &mut census.union_find, jointed_bodies, sort_keys);
        }
        *count = 0;
        for members in keyed_items.chunk_by(|one, other| one.0 == other.0) {
            if islands.len() == *count {
                islands.push(DirectIsland::default());
            }
            let (island, stats) = (&mut islands[*count], &mut census.stats[members[0].0 as usize]);
            island.begin(members);
            list_contact_edges(members, pairs, proxies, edges, sort_keys);
            let mut max_products = FACTOR_PRODUCTS_PER_BODY;
            if stats.joints > 0 {
                add_joint_edges(members, jointed_bodies, edges, sort_keys);
                max_products = JOINTED_FACTOR_PRODUCTS_PER_BODY;
            }
            let mut merged = merged_history(members, history);
            if island.system.factor.analyse(members.len(), edges, max_products * members.len()) {
                stats.island_index = Some(*count as u32);
                *count += 1;
            } else {
                (merged.is_direct, merged.pause) = (false, BUSY_ISLAND_PAUSE);
                timer.has_paused = true;
            }
            if selects {
                members.iter().for_each(|&(_, body)| history[body as usize] = merged);
            }
        }
    }
    /// Moves contact constraints between the graph colours and the direct solver, as selected. A constraint keeps its impulses
    /// when it moves.
    ///
    /// The rest impulse of a constraint that returns to the iterative solver is its whole last load. After an impact such rest
    /// impulses would press against each other for a second in contact cycles. Islands with joints are softer in the iterative
    /// solver. In both cases the rest impulse is multiplied by the `adapted_fraction` of `learning`. `h` is the length of the
    /// substeps in which the impulses last acted, in seconds.
    pub(in crate::precise) fn move_constraints(
        &mut self,
        pairs: &mut Pairs,
        proxies: &Proxies,
        constraints: &mut ConstraintGraph,
        learning: &LoadAdaptation,
        h: f32,
    ) {
        for pair in 0..pairs.awake_count {
            let Some(handle) = pairs.all[pair].constraint else { continue };
            let body = pairs.bodies_of(proxies, pair)[1].0;
            let (is_direct, was_direct) = (self.is_direct(body), handle.is_in_direct_solver());
            if is_direct != was_direct {
                let IslandHistory { formed_by_motion, has_accepted_solution, .. } = self.history[body];
                let may_rock = has_accepted_solution
                    || (formed_by_motion && self.census.stats_of(body as u32).has_contact_cycles());
                if was_direct && may_rock {
                    let points = &mut constraints.direct_constraint_mut(handle).constraint.points;
                    points.iter_mut().for_each(|point| point.rest_impulse *= learning.adapted_fraction);
                }
                move_to_direct_solver(pairs, constraints, pair, is_direct, h);
            }
        }
        self.history.iter_mut().for_each(|entry| entry.has_accepted_solution &= entry.is_direct);
    }
}

/// Returns whether a contact with restitution approaches faster than `min_speed` (length units/s). `a` and `b` are the
/// velocities of its bodies. The direct solver does not apply restitution.
fn bounces(contact: &ContactConstraint, [a, b]: [[f32; 4]; 2], min_speed: f32) -> bool {
    let along = contact.normal[0] * (b[0] - a[0]) + contact.normal[1] * (b[1] - a[1]);
    let is_fast = |point: &ContactPoint| {
        point.normal_mass > 0.0 && along + b[2] * point.normal_arm_b - a[2] * point.normal_arm_a < -min_speed
    };
    contact.restitution > 0.0 && contact.points.iter().any(is_fast)
}

/// Returns whether a contact slides faster than `limit` (length units/s) although its friction is within the limit. `velocity`
/// returns the velocity of a body.
fn slips(contact: &ContactConstraint, velocity: &dyn Fn(u32) -> [f32; 4], limit: f32) -> bool {
    let [a, b] = [contact.a, contact.b].map(|body| velocity(body).map(f64::from));
    let [.., along] =
        Jacobian::of_contact(contact).relative_velocities([a[0], a[1], a[2]], [b[0], b[1], b[2]]);
    let friction_limit =
        contact.friction * (contact.points[0].normal_impulse + contact.points[1].normal_impulse);
    contact.tangent_impulse.abs() < STICKING_FRICTION_FRACTION * friction_limit
        && (along - f64::from(contact.tangent_speed)).abs() > f64::from(limit)
}

/// Returns the common island history of `members` (pairs of union-find root and body index) that come from several islands: the
/// worse value of each field. `histories` are indexed by body.
fn merged_history(members: &[(u32, u32)], histories: &[IslandHistory]) -> IslandHistory {
    let first = IslandHistory { is_direct: true, has_accepted_solution: true, ..IslandHistory::default() };
    members.iter().map(|&(_, body)| histories[body as usize]).fold(first, |merged, other| IslandHistory {
        average_newton_steps: if other.average_newton_steps > merged.average_newton_steps {
            other.average_newton_steps
        } else {
            merged.average_newton_steps
        },
        was_iterated: merged.was_iterated || other.was_iterated,
        formed_by_motion: merged.formed_by_motion || other.formed_by_motion,
        has_accepted_solution: merged.has_accepted_solution && other.has_accepted_solution,
        budget: if other.budget < merged.budget { other.budget } else { merged.budget },
        back_off: merged.back_off.max(other.back_off),
        friction_checks: merged.friction_checks.max(other.friction_checks),
        friction_check_in: merged.friction_check_in.max(other.friction_check_in),
        ..merged
    })
}
