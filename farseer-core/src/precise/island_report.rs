//! Adapter: report of islands, and of why a body is awake. Solver, reason and cost of each island in the last update, and the residual of its constraints.
//!
//! The report is computed on request, from the state that the update has left. The step itself stores nothing for it.

use super::Precise;
use super::ids::IdTable;
use super::wake_import::spring_body_pairs;
use crate::body::BodyId;
use crate::joints::Joint;
use crate::joints::constraint_spec::ConstraintSpecKind;
use crate::methods::SolverChoice;
use crate::objects::Objects;
use crate::report::{AwakeReason, Island};
use crate::storage::order::{packed_key, sort_by_number};
use farseer_precise::Solver;
use farseer_precise::bodies::BodySet;
use farseer_precise::broad_phase::pairs::Pairs;
use farseer_precise::broad_phase::proxies::Proxies;
use farseer_precise::direct_solver::island_stats::{IslandCensus, IslandStats};
use farseer_precise::index::{BodyIndex, IndexedVec, PairIndex};
use farseer_precise::island::falling_asleep::unite_islands;
use farseer_precise::island::sleep::SleepState;
use farseer_precise::island::union_find::UnionFind;
use farseer_precise::island_report::{IslandCost, IslandResidual, IslandSolver, SolverReason};
use farseer_precise::math::plane::{Vector, difference, dot};
use farseer_precise::narrow_phase::manifold::Manifold;
use farseer_precise::narrow_phase::shape_dispatch::collide;
use farseer_precise::parameters::sleep::TIME_TO_SLEEP;

/// Solver, reason and cost of one body in the last update. The report of an island merges those of its bodies.
#[derive(Debug, Clone, Copy)]
struct BodyReport {
    /// Solver of the body in the last update.
    method: IslandSolver,
    /// Reason why the body had its solver.
    why: SolverReason,
    /// The body's share of the cost of its island. Costs of an island are sums over its bodies, except `parts`, which is the
    /// largest.
    cost: IslandCost,
}

impl BodyReport {
    /// Returns the report of a body without contact rows, joints and Newton steps. `parts` is the number of parts of its step.
    fn new(method: IslandSolver, why: SolverReason, parts: u32) -> Self {
        let mut cost = IslandCost::default();
        cost.parts = parts;
        BodyReport { method, why, cost }
    }

    /// Returns the merged report of two bodies. Its solver and reason are those of the body whose solver comes later in
    /// [`IslandSolver`].
    fn merge(self, other: Self) -> Self {
        let last = if other.method > self.method { other } else { self };
        let mut cost = self.cost;
        cost.rows += other.cost.rows;
        cost.joints += other.cost.joints;
        cost.parts = cost.parts.max(other.cost.parts);
        cost.newton_steps += other.cost.newton_steps;
        BodyReport { cost, ..last }
    }
}

impl Precise {
    /// Returns the islands: the awake ones first, then the sleeping ones. Both are sorted by the smallest body index of each
    /// island.
    pub(crate) fn islands(&self, objects: &Objects) -> Vec<Island> {
        let solver = &self.solver;
        let (mut awake, first_of_rings) = (self.awake_islands(objects), solver.sleep.first_of_rings());
        let mut all: Vec<(bool, BodyIndex, BodyIndex)> = solver
            .bodies
            .movable()
            .filter(|&number| solver.bodies.is_dynamic(number))
            .map(|number| match solver.sleep.is_asleep(number) {
                true => (true, first_of_rings[number], number),
                false => (false, awake.find(number), number),
            })
            .collect();
        sort_by_number(&mut all, |&(sleeps, first, number)| packed_key([sleeps.into(), first.0, number.0]));
        let reports = self.body_reports();
        let island = |bodies: &[(bool, BodyIndex, BodyIndex)]| {
            let of_bodies = bodies.iter().map(|&(.., number)| reports[number]);
            let BodyReport { method, why, cost } = of_bodies.reduce(BodyReport::merge)?;
            Some(Island {
                bodies: bodies.iter().filter_map(|&(.., number)| self.ids.bodies[number]).collect(),
                is_asleep: method == IslandSolver::Asleep,
                is_solved_whole: method == IslandSolver::Direct,
                method,
                why,
                cost,
            })
        };
        all.chunk_by(|a, b| (a.0, a.1) == (b.0, b.1)).filter_map(island).collect()
    }

    /// Returns the islands of the awake bodies.
    fn awake_islands(&self, objects: &Objects) -> UnionFind<BodyIndex> {
        let solver = &self.solver;
        let mut islands = UnionFind::default();
        // Before the first update no body has an index.
        let springs =
            spring_body_pairs(&self.ids, objects).filter(|ends| !ends.contains(&BodyIndex::PLACEHOLDER));
        let links = solver.joints.body_pairs().chain(springs);
        unite_islands(&mut islands, &solver.bodies, &solver.proxies, &solver.pairs, links);
        islands
    }

    /// Returns the reason why a dynamic body is awake; `None` if it sleeps, or is not dynamic.
    pub(crate) fn why_awake(&self, body: BodyId, objects: &Objects) -> Option<AwakeReason> {
        let solver = &self.solver;
        let number = self.ids.body_index(body).filter(|&number| solver.bodies.is_dynamic(number))?;
        if solver.sleep.is_asleep(number) {
            return None;
        }
        let mut islands = self.awake_islands(objects);
        let island = islands.find(number);
        let mut members = solver
            .sleep
            .awake_bodies(solver.bodies.last_movable)
            .filter(|&other| islands.find(other) == island);
        let restless = members.find(|&other| solver.sleep.rest_time[other] == 0.0);
        let limit = solver.sleep.sleep_speed(solver.parameters.length_unit);
        Some(match restless {
            _ if solver.sleep.rest_time[number] == 0.0 => AwakeReason::Moves { limit },
            Some(other) => match self.ids.bodies[other] {
                Some(with) => AwakeReason::HangsTogether { with },
                // A hinged platform has no body id. It moves the bodies that it leans on.
                None => AwakeReason::Moves { limit },
            },
            None => {
                AwakeReason::RestsSince { seconds: solver.sleep.rest_time[number], needed: TIME_TO_SLEEP }
            }
        })
    }

    /// Returns the report of each body, in the order of body indices.
    fn body_reports(&self) -> IndexedVec<BodyIndex, BodyReport> {
        let solver = &self.solver;
        let mut census = IslandCensus::default();
        solver.solver_selection().count_islands(&mut census, &|body| solver.bodies.initial_velocity[body]);
        let substeps = solver.substep_count();
        let rows = rows_by_body(&solver.bodies, &solver.proxies, &solver.pairs, &solver.sleep);
        let mut reports: IndexedVec<BodyIndex, BodyReport> = solver
            .bodies
            .states
            .indices()
            .map(|body| solver_report(solver, body, census.stats_of(body), substeps))
            .collect();
        for (body, parts) in
            solver.joints.free_articulations(substeps).filter(|&(body, _)| !solver.sleep.is_asleep(body))
        {
            reports[body] = BodyReport::new(IslandSolver::Articulated, SolverReason::NothingTouches, parts);
        }
        reports.iter_mut().zip(&rows).for_each(|(told, rows)| told.cost.rows = *rows);
        for ties in solver.joints.body_pairs() {
            let holder = ties
                .into_iter()
                .find(|&body| body > BodyIndex::PLACEHOLDER && is_awake(&solver.bodies, &solver.sleep, body));
            holder.into_iter().for_each(|body| reports[body].cost.joints += 1);
        }
        solver
            .direct_solver
            .newton_steps_of_islands()
            .for_each(|(body, steps)| reports[body].cost.newton_steps = steps);
        reports
    }

    /// Returns the largest errors of the contacts and joints of these bodies. Stale ids and bodies that are not dynamic
    /// contribute nothing.
    pub(crate) fn residual(&self, bodies: &[BodyId], objects: &Objects) -> IslandResidual {
        let solver = &self.solver;
        let mut residual = IslandResidual::default();
        let contacts = ContactErrors {
            bodies: &solver.bodies,
            ids: &self.ids,
            proxies: &solver.proxies,
            pairs: &solver.pairs,
            speculative_distance: solver.parameters.speculative_distance,
            dt: solver.dt,
            objects,
        };
        let numbers = bodies.iter().filter_map(|&body| self.ids.body_index(body));
        for body in numbers.filter(|&body| solver.bodies.is_dynamic(body)) {
            let pairs = solver.pairs.pairs_of_body(&solver.proxies, body);
            for pair in pairs.filter(|&pair| solver.pairs.has_constraint(pair)) {
                let [overlap, approach] = contacts.of_pair(pair);
                (residual.overlap, residual.approach) =
                    (residual.overlap.max(overlap), residual.approach.max(approach));
            }
        }
        let all = (0..objects.joints.list().len()).filter_map(|at| objects.joints.at(at));
        for (_, joint) in all.filter(|(_, joint)| joint.enabled() && is_joint_of_any(joint, bodies)) {
            let gap = self.joint_import(&objects.bodies).joint_error_even_asleep(joint).unwrap_or(0.0).abs();
            let component = if joint.constraint_spec().keeps == ConstraintSpecKind::Angle {
                &mut residual.angle
            } else {
                &mut residual.gap
            };
            *component = component.max(gap);
        }
        residual
    }
}

/// Returns which solver has solved a body and why, without its cost. `stats`: those of its island; `substeps`: number of
/// substeps of the step.
fn solver_report(solver: &Solver, body: BodyIndex, stats: &IslandStats, substeps: u32) -> BodyReport {
    if solver.sleep.is_asleep(body) {
        BodyReport::new(IslandSolver::Asleep, SolverReason::AtRest, 0)
    } else if solver.direct_solver.is_direct(body) {
        let is_chosen = solver.direct_solver.choice() == SolverChoice::Direct;
        let why = if is_chosen { SolverReason::Chosen } else { SolverReason::Pays };
        BodyReport::new(IslandSolver::Direct, why, 1)
    } else if stats.has_contacts() || solver.joints.has_joint(body) {
        let why = stats.iterative_reason(solver.direct_solver.choice());
        BodyReport::new(IslandSolver::Iterative, why, substeps)
    } else {
        BodyReport::new(IslandSolver::Ballistic, SolverReason::NothingTouches, 1)
    }
}

/// Returns whether the body is dynamic and awake.
fn is_awake(bodies: &BodySet, sleep: &SleepState, body: BodyIndex) -> bool {
    bodies.is_dynamic(body) && !sleep.is_asleep(body)
}

/// Returns the number of awake contact constraints for each body index. A constraint counts at one of its bodies only, an awake
/// dynamic one.
fn rows_by_body(
    bodies: &BodySet,
    proxies: &Proxies,
    pairs: &Pairs,
    sleep: &SleepState,
) -> IndexedVec<BodyIndex, usize> {
    let mut rows = IndexedVec::of_copies(0, bodies.states.len());
    for pair in pairs.awake().filter(|&pair| pairs.has_constraint(pair)) {
        let [(a, _), (b, _)] = pairs.bodies_of(proxies, pair);
        let body = [a, b].into_iter().rfind(|&body| is_awake(bodies, sleep, body));
        body.into_iter().for_each(|body| rows[body] += 1);
    }
    rows
}

/// Parts that the errors of contacts depend on.
struct ContactErrors<'a> {
    bodies: &'a BodySet,
    ids: &'a IdTable,
    proxies: &'a Proxies,
    pairs: &'a Pairs,
    /// Distance up to which shapes have contact points, length units, > 0.
    speculative_distance: f32,
    /// Length of the last step, seconds, >= 0.
    dt: f32,
    objects: &'a Objects,
}

impl ContactErrors<'_> {
    /// Returns the errors of a pair in its present pose: penetration (length units, >= 0), and excess of its approach speed
    /// (length units/s, >= 0).
    ///
    /// The excess is the approach speed minus the speed that closes the gap in one update.
    fn of_pair(&self, pair: PairIndex) -> [f32; 2] {
        let [a, b] = self.pairs.proxies_of(pair).map(|proxy| self.proxies.proxy(proxy));
        let [pose_a, pose_b] = [a, b].map(|proxy| self.bodies.poses[proxy.body]);
        let [outline_a, outline_b] = [a, b].map(|proxy| self.proxies.vertices.shape_ref(proxy.shape));
        let Manifold { normal, count, points, separations, .. } =
            collide(outline_a, outline_b, pose_a, pose_b, self.speculative_distance);
        let apart = [pose_b[0] - pose_a[0], pose_b[1] - pose_a[1]];
        let mut errors = [0.0_f32; 2];
        for (&point, &separation) in points.iter().zip(&separations).take(count) {
            let velocity_a = self.velocity_at(a.body, point);
            let velocity_b = self.velocity_at(b.body, difference(point, apart));
            let approach = -dot(difference(velocity_b, velocity_a), normal);
            let allowed = if self.dt > 0.0 { separation.max(0.0) / self.dt } else { 0.0 };
            errors = [errors[0].max(-separation), errors[1].max(approach - allowed)];
        }
        errors
    }

    /// Returns the velocity of a body at a point [x, y] relative to its origin, both in world axes: length units/s; 0 for
    /// static bodies and world boxes.
    fn velocity_at(&self, body: BodyIndex, [x, y]: Vector) -> Vector {
        let id = self.ids.bodies.at(body).copied().flatten().filter(|_| body <= self.bodies.last_movable);
        let Some(entry) = id.and_then(|id| self.objects.bodies.get(id)) else { return [0.0; 2] };
        let (velocity, angular_velocity) = (entry.body.linear_velocity(), entry.body.angular_velocity());
        [velocity.x - angular_velocity * y, velocity.y + angular_velocity * x]
    }
}

/// Returns whether the joint connects one of these bodies.
fn is_joint_of_any(joint: &Joint, bodies: &[BodyId]) -> bool {
    let (first, second) = joint.constraint_spec().bodies;
    first.into_iter().chain([second]).any(|body| bodies.contains(&body))
}
