//! Solver selection: finds the islands and the facts about each ([`IslandCensus`]), from contacts, joints and bodies.
//!
//! From these facts the direct solver [takes islands](super::island_members) and lists their members.

use super::constraint::Jacobian;
use super::island_history::{Histories, IslandHistory};
use super::island_stats::IslandCensus;
use super::lateral_friction::blocks_planar_solution;
use super::load::exceeds_mass_ratio;
use crate::bodies::BodySet;
use crate::broad_phase::pairs::Pairs;
use crate::broad_phase::proxies::{BodyType, Proxies};
use crate::constraint_graph::{ColorUsage, ConstraintGraph, ContactConstraint, ContactPoint};
use crate::index::{BodyIndex, DenseIndex, PairIndex};
use crate::island::sleep::SleepState;
use crate::island::union_find::UnionFind;
use crate::joints::JointSystem;
use crate::joints::springs::SpringRows;
use crate::math::plane::Vector;
use crate::narrow_phase::combined_surface::rolling_arm_of;
use crate::parameters::direct::{
    ACCEPTED_JOINT_ERROR, CALM_ISLAND_MAX_SPEED, FRICTION_CHECK_MAX_DOUBLINGS, SLIP_SPEED,
    STICKING_FRICTION_FRACTION,
};
use crate::scaled_parameters::Parameters;
use crate::solver_choice::SolverChoice;

/// The parts of the engine that solver selection reads.
pub struct SolverSelection<'a> {
    pub(crate) bodies: &'a BodySet,
    pub(crate) proxies: &'a Proxies,
    pub(crate) pairs: &'a Pairs,
    pub(crate) constraints: &'a ConstraintGraph,
    pub(crate) color_usage: &'a ColorUsage,
    pub(crate) joints: &'a JointSystem,
    pub(crate) springs: &'a SpringRows,
    pub(crate) sleep: &'a SleepState,
    pub(crate) parameters: &'a Parameters,
    /// Island history of each body, by body index.
    pub(crate) history: &'a Histories,
    /// Velocity change by gravity in the step, for a body of gravity scale 1, in length units/s.
    pub(crate) gravity_delta: Vector,
    /// Length of the step, in seconds.
    pub(crate) dt: f32,
    /// Whether any contact may have restitution.
    pub(crate) has_restitution: bool,
    /// Whether at most [`IMMEDIATE_RESELECTION_BODIES`](crate::parameters::direct::IMMEDIATE_RESELECTION_BODIES) bodies
    /// are awake.
    pub(crate) has_few_awake_bodies: bool,
    /// Whether the simulator has a depth axis (2.5D).
    pub(crate) has_depth: bool,
}

impl SolverSelection<'_> {
    /// Returns whether a contact of the direct solver bounces, or excludes a solution in the plane. The direct solver cannot
    /// keep such a contact.
    pub(crate) fn has_rejected_contact(&self) -> bool {
        let is_rejected = |contact: &ContactConstraint| {
            let velocity = |body: BodyIndex| self.bodies.states[body].velocity;
            let velocities = [contact.a, contact.b].map(velocity);
            self.bounces(contact, velocities)
                || self.blocks_planar_solution(contact, velocities)
                || self.resists_rolling(contact.pair)
        };
        self.constraints.direct_constraints().iter().any(|row| is_rejected(&row.constraint))
    }

    /// Returns whether changes in islands of the iterative solver make solver selection due at once, without a wait for the
    /// [period](crate::parameters::direct::RESELECTION_PERIOD). `choice` is the user's choice of solvers.
    pub(crate) fn is_quick(&self, choice: SolverChoice) -> bool {
        let moves = |body: BodyIndex| self.exceeds_calm_speed(self.bodies.states[body].velocity);
        let is_calm = || !self.sleep.awake_bodies(self.bodies.last_movable).any(moves);
        choice == SolverChoice::Direct
            || (self.has_few_awake_bodies
                && (!self.joints.is_empty()
                    || !self.springs.is_empty()
                    || is_calm()
                    || self.has_unsolved_load()))
    }

    /// Returns whether friction [slips](super::island_stats::IslandStats::slips) in the iterative solver at a calm body that was
    /// due for a friction check in this update, in an island built in place.
    pub(crate) fn has_slipping_contact(&self) -> bool {
        self.pairs.awake().any(|pair| self.is_slipping(pair))
    }

    /// Returns whether the contact with index `pair` slips in the iterative solver. The result is false unless its body B is
    /// calm, was due for a friction check in this update, and belongs to an island built in place.
    fn is_slipping(&self, pair: PairIndex) -> bool {
        let body = self.pairs.bodies_of(self.proxies, pair)[1].0;
        let IslandHistory { friction_checks, friction_check_in, formed_by_motion, .. } =
            self.history[BodyIndex::new(body.position())];
        let was_checked = friction_checks > 1
            && friction_check_in == 1 << (friction_checks - 1).min(FRICTION_CHECK_MAX_DOUBLINGS);
        let velocity = |body: BodyIndex| self.bodies.states[body].velocity;
        let is_calm = || !self.exceeds_calm_speed(velocity(BodyIndex::new(body.position())));
        let constraint = self.pairs.constraint(pair).filter(|(_, handle)| {
            was_checked && !formed_by_motion && !handle.is_in_direct_solver() && is_calm()
        });
        let limit = SLIP_SPEED * self.parameters.length_unit;
        constraint.is_some_and(|(kind, handle)| slips(&self.constraints.get(kind, handle), &velocity, limit))
    }

    /// Returns whether the linear velocity `x`, `y` (length units/s) of a body is faster than [`CALM_ISLAND_MAX_SPEED`].
    fn exceeds_calm_speed(&self, [x, y, ..]: [f32; 4]) -> bool {
        let calm = CALM_ISLAND_MAX_SPEED * self.parameters.length_unit;
        x * x + y * y > calm * calm
    }

    /// Computes the islands of awake bodies and the facts about each, into `census`. `velocity` returns the velocity of a body: x
    /// and y (length units/s), angular (radians/s), depth axis (length units/s).
    pub fn count_islands(&self, census: &mut IslandCensus, velocity: &dyn Fn(BodyIndex) -> [f32; 4]) {
        census.reset(self.bodies.states.len(), &self.sleep.awake_body_runs);
        self.unite_bodies(&mut census.union_find);
        for body in
            self.sleep.awake_bodies(self.bodies.last_movable).filter(|&body| !self.bodies.is_kinematic(body))
        {
            let index = BodyIndex::new(body.position());
            let (stats, history) = (census.stats_of(index), self.history[index]);
            stats.bodies += 1;
            stats.has_few_awake_bodies = self.has_few_awake_bodies;
            stats.direct_bodies += u32::from(history.is_direct);
            stats.has_unsupported_joint |= self.has_depth && self.joints.has_joint(body);
            stats.was_paused |= history.was_paused();
            stats.pause = stats.pause.max(history.pause);
            stats.moves |= self.exceeds_calm_speed(velocity(index));
            stats.formed_by_motion |= history.formed_by_motion;
        }
        self.count_joints(census);
        self.count_contacts(census, velocity);
    }

    /// Adds the contacts to the facts about their islands. `velocity` returns the velocity of a body, as in
    /// [`count_islands`](Self::count_islands).
    fn count_contacts(&self, census: &mut IslandCensus, velocity: &dyn Fn(BodyIndex) -> [f32; 4]) {
        let heavy_ratio = self.heavy_mass_ratio();
        for pair in self.pairs.awake() {
            let Some((kind, handle)) = self.pairs.constraint(pair) else { continue };
            let [(one, mobility), (body, _)] = self.pairs.bodies_of(self.proxies, pair);
            let stats = census.stats_of(BodyIndex::new(body.position()));
            stats.contacts += 1;
            stats.has_unsupported_joint |= mobility == BodyType::Hinged;
            stats.has_depth = self.has_depth;
            stats.resists_rolling |= self.resists_rolling(pair);
            if !(stats.has_depth || stats.slips && stats.has_load) {
                let contact = self.constraints.get(kind, handle);
                stats.slips |= slips(&contact, velocity, SLIP_SPEED * self.parameters.length_unit);
                stats.has_load |= contact.points.iter().any(|point| point.normal_impulse > 0.0);
            }
            let inverse_masses = [one, body].map(|body| self.bodies.inverse_mass_inertia[body][0]);
            if self.has_restitution || stats.has_depth || exceeds_mass_ratio(inverse_masses, heavy_ratio) {
                let contact = self.constraints.get(kind, handle);
                let velocities = [contact.a, contact.b].map(|body| velocity(BodyIndex(body.0)));
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
    fn unite_bodies(&self, union_find: &mut UnionFind<BodyIndex>) {
        for pair in self.pairs.awake().filter(|&pair| self.pairs.has_constraint(pair)) {
            if let [(a, BodyType::Dynamic), (b, BodyType::Dynamic)] = self.pairs.bodies_of(self.proxies, pair)
            {
                union_find.unite(a, b);
            }
        }
        if !self.has_depth {
            let of_joints = self.joints.candidates().chain(self.springs.candidates());
            for [a, b] in of_joints.filter_map(|joint| joint.dynamic_pair()) {
                union_find.unite(a, b);
            }
        }
    }

    /// Returns whether a contact has rolling resistance, for which the direct solver has no row. Always false with a depth axis.
    #[inline(always)]
    fn resists_rolling(&self, pair: PairIndex) -> bool {
        self.proxies.resist_rolling && !self.has_depth && self.rolling_arm(pair) > 0.0
    }

    /// Returns the [lever arm of rolling resistance](rolling_arm_of) of a pair, length units, >= 0.
    #[inline(never)]
    fn rolling_arm(&self, pair: PairIndex) -> f32 {
        let [a, b] = self.pairs.proxies_of(pair).map(|proxy| self.proxies.proxy(proxy));
        rolling_arm_of(a, b)
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
fn slips(contact: &ContactConstraint, velocity: &dyn Fn(BodyIndex) -> [f32; 4], limit: f32) -> bool {
    let [a, b] = [contact.a, contact.b].map(|body| velocity(BodyIndex(body.0)).map(f64::from));
    let [.., along] =
        Jacobian::of_contact(contact).relative_velocities([a[0], a[1], a[2]], [b[0], b[1], b[2]]);
    let friction_limit =
        contact.friction * (contact.points[0].normal_impulse + contact.points[1].normal_impulse);
    contact.tangent_impulse.abs() < STICKING_FRICTION_FRACTION * friction_limit
        && (along - f64::from(contact.tangent_speed)).abs() > f64::from(limit)
}
