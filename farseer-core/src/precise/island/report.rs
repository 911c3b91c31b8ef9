//! Report of islands: solver, reason and cost of each island in the last update, and the residual of its constraints.
//!
//! The report is computed on request, from the state that the update has left. The step itself stores nothing for it.

use crate::body::BodyId;
use crate::joints::Joint;
use crate::joints::constraint_spec::ConstraintSpecKind;
use crate::math::plane::{Vector, difference, dot};
use crate::methods::SolverChoice;
use crate::objects::Objects;
use crate::precise::Precise;
use crate::precise::direct_solver::island_stats::IslandCensus;
use crate::precise::island::union_find::UnionFind;
use crate::precise::narrow_phase::manifold::{Manifold, collide};
use crate::storage::order::{packed_key, sort_by_number};

/// Set of dynamic bodies that contacts, joints or springs connect: see
/// [`PhysicsSimulator::islands`](crate::PhysicsSimulator::islands).
#[derive(Debug, Clone, PartialEq, Eq)]
#[non_exhaustive]
pub struct Island {
    /// The bodies of the island, in the order of the simulator's list.
    pub bodies: Vec<BodyId>,
    /// Whether the island sleeps.
    pub is_asleep: bool,
    /// Whether the direct solver solved the island in the last update; false if it was the iterative one: see
    /// [`Methods::Precise`](crate::Methods::Precise).
    pub is_solved_whole: bool,
    /// The solver of the island in the last update.
    pub method: IslandSolver,
    /// The reason why the island had its solver in the last update.
    pub why: SolverReason,
    /// The cost of solving the island in the last update.
    pub cost: IslandCost,
}

/// Solver of an island in the last update.
///
/// A spring whose ends have neither contacts nor joints connects bodies without being solved with them. So bodies of one island
/// may have different solvers. The report then names the solver that comes last in this list.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
#[non_exhaustive]
pub enum IslandSolver {
    /// No solver: the island sleeps.
    Asleep,
    /// Ballistic motion in closed form: no body has contacts or joints.
    Ballistic,
    /// Articulated-body algorithm for joints without contacts, with as many substeps as the motion needs.
    Articulated,
    /// Direct solver: all contacts and joints at once, as rigid constraints.
    Direct,
    /// Iterative solver: contacts and joints as soft constraints, in substeps.
    Iterative,
}

/// Reason for the [solver](IslandSolver) of an island in the last update.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
#[non_exhaustive]
pub enum SolverReason {
    /// Asleep: the island has been at rest for long enough.
    AtRest,
    /// Ballistic or articulated: the island has no contacts.
    NothingTouches,
    /// Direct: the direct solver takes the island, because its solution is worth the cost.
    Pays,
    /// Direct or iterative: the game has [chosen](crate::PhysicsSimulator::set_solver_choice) this solver for all islands.
    Chosen,
    /// Iterative: the island is a single dynamic body, on static or kinematic bodies.
    OneBody,
    /// Iterative: a joint of the island is soft, or is a revolute joint with a largest impulse, or a world with a depth axis
    /// has joints in the island.
    Joints,
    /// Iterative: two bodies approached so fast that restitution applied.
    Bounces,
    /// Iterative: a body moved faster than 0.25 length units/s at this solver selection or an earlier one.
    ///
    /// With joints: the direct solver gave the island up lately, and one of its joints has a position error.
    Moves,
    /// Iterative: the island has contact cycles and fewer than 40 bodies, which the iterative solver holds at rest.
    ///
    /// The direct solver takes such an island if its bodies were calm (at most 0.25 length units/s) when it formed, and a
    /// contact slips although its friction is within the friction limit.
    TooSmall,
    /// Iterative: the island has more than 400 bodies and more contacts than joints. With a depth axis: the island has contact
    /// cycles and more than 24 bodies.
    TooLarge,
    /// Iterative: the direct solver gave up the island lately, and pauses.
    ///
    /// It gives up if restitution applied, the solutions took too many Newton steps or matrix products, a solution with joints
    /// was rejected, or the island spent its budget.
    Rests {
        /// Number of updates after which the direct solver may take the island again.
        updates: u8,
    },
    /// Iterative, with a depth axis: no body lies on another one of less than two thirds of its mass, or a body rolls, or a
    /// contact acts along the depth axis.
    HasDepth,
    /// Iterative: the direct solver may take the island, but was not selected yet, or could not solve the island this time.
    ///
    /// Large scenes select solvers only in every 16th update.
    NotAskedYet,
}

/// Cost of solving an island in the last update.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
#[non_exhaustive]
pub struct IslandCost {
    /// Number of pairs of convex pieces with contact constraints in the island, speculative contacts included.
    pub rows: usize,
    /// Number of enabled joints in the island.
    pub joints: usize,
    /// Number of parts into which the solver divided the step: with the iterative solver, the number of substeps.
    pub parts: u32,
    /// Number of Newton steps of the direct solver for the island: 0 while its previous solution still holds.
    pub newton_steps: usize,
}

/// Constraint errors of an island: see [`PhysicsSimulator::island_residual`](crate::PhysicsSimulator::island_residual).
///
/// Lengths are in the user's unit.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
#[non_exhaustive]
pub struct IslandResidual {
    /// Largest penetration of two outlines, length units, >= 0.
    pub overlap: f32,
    /// Largest excess of the approach speed of two bodies over the speed that closes their gap in the next update, length
    /// units/s, >= 0.
    pub approach: f32,
    /// Largest position error of a joint that keeps a point, a distance or a line, length units, >= 0.
    pub gap: f32,
    /// Largest angle error of a joint that keeps only an angle, radians, >= 0.
    pub angle: f32,
}

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
        BodyReport { method, why, cost: IslandCost { parts, ..IslandCost::default() } }
    }

    /// Returns the merged report of two bodies. Its solver and reason are those of the body whose solver comes later in
    /// [`IslandSolver`].
    fn merge(self, other: Self) -> Self {
        let last = if other.method > self.method { other } else { self };
        let cost = IslandCost {
            rows: self.cost.rows + other.cost.rows,
            joints: self.cost.joints + other.cost.joints,
            parts: self.cost.parts.max(other.cost.parts),
            newton_steps: self.cost.newton_steps + other.cost.newton_steps,
        };
        BodyReport { cost, ..last }
    }
}

impl Precise {
    /// Returns the islands: the awake ones first, then the sleeping ones. Both are sorted by the smallest body index of each
    /// island.
    pub(crate) fn islands(&self, objects: &Objects) -> Vec<Island> {
        let mut awake = UnionFind::default();
        self.unite_islands(objects, &mut awake);
        let mut all: Vec<(bool, usize, usize)> = (1..=self.bodies.last_movable)
            .filter(|&number| self.is_dynamic(number))
            .map(|number| match self.sleep.is_asleep(number) {
                true => (true, self.sleep.first_of_ring(number), number),
                false => (false, awake.find(number as u32) as usize, number),
            })
            .collect();
        sort_by_number(&mut all, |&(sleeps, first, number)| {
            packed_key([sleeps.into(), first as u32, number as u32])
        });
        let reports = self.body_reports();
        let island = |bodies: &[(bool, usize, usize)]| {
            let of_bodies = bodies.iter().map(|&(.., number)| reports[number]);
            let BodyReport { method, why, cost } = of_bodies.reduce(BodyReport::merge)?;
            Some(Island {
                bodies: bodies.iter().filter_map(|&(.., number)| self.bodies.ids[number]).collect(),
                is_asleep: method == IslandSolver::Asleep,
                is_solved_whole: method == IslandSolver::Direct,
                method,
                why,
                cost,
            })
        };
        all.chunk_by(|a, b| (a.0, a.1) == (b.0, b.1)).filter_map(island).collect()
    }

    /// Returns the report of each body, in the order of body indices.
    fn body_reports(&self) -> Vec<BodyReport> {
        let mut census = IslandCensus::default();
        self.solver_selection()
            .count_islands(&mut census, &|body| self.bodies.initial_velocity[body as usize]);
        let substeps =
            if self.impulse_substep > 0.0 { (self.dt / self.impulse_substep).round() as u32 } else { 0 };
        let rows = self.rows_by_body();
        let mut reports: Vec<BodyReport> = (0..self.bodies.states.len())
            .map(|body| {
                let stats = census.stats_of(body as u32);
                if self.sleep.is_asleep(body) {
                    BodyReport::new(IslandSolver::Asleep, SolverReason::AtRest, 0)
                } else if self.direct_solver.is_direct(body) {
                    let is_chosen = self.direct_solver.choice() == SolverChoice::Direct;
                    let why = if is_chosen { SolverReason::Chosen } else { SolverReason::Pays };
                    BodyReport::new(IslandSolver::Direct, why, 1)
                } else if stats.has_contacts() || self.joints.has_joint(body) {
                    let why = stats.iterative_reason(self.direct_solver.choice());
                    BodyReport::new(IslandSolver::Iterative, why, substeps)
                } else {
                    BodyReport::new(IslandSolver::Ballistic, SolverReason::NothingTouches, 1)
                }
            })
            .collect();
        for (body, parts) in
            self.joints.free_articulations(substeps).filter(|&(body, _)| !self.sleep.is_asleep(body))
        {
            reports[body] = BodyReport::new(IslandSolver::Articulated, SolverReason::NothingTouches, parts);
        }
        reports.iter_mut().zip(rows).for_each(|(told, rows)| told.cost.rows = rows);
        for ties in self.joints.body_pairs() {
            let holder = ties.into_iter().find(|&body| body > 0 && self.is_awake(body));
            holder.into_iter().for_each(|body| reports[body].cost.joints += 1);
        }
        self.direct_solver
            .newton_steps_of_islands()
            .for_each(|(body, steps)| reports[body].cost.newton_steps = steps);
        reports
    }

    /// Returns whether the body is dynamic and awake.
    fn is_awake(&self, body: usize) -> bool {
        self.is_dynamic(body) && !self.sleep.is_asleep(body)
    }

    /// Returns the number of awake contact constraints for each body index. A constraint counts at one of its bodies only, an
    /// awake dynamic one.
    fn rows_by_body(&self) -> Vec<usize> {
        let mut rows = vec![0; self.bodies.states.len()];
        for pair in (0..self.pairs.awake_count).filter(|&pair| self.pairs.all[pair].constraint.is_some()) {
            let body = self
                .bodies_of_pair(pair)
                .map(|(body, _)| body)
                .into_iter()
                .rfind(|&body| self.is_awake(body));
            body.into_iter().for_each(|body| rows[body] += 1);
        }
        rows
    }

    /// Returns the largest errors of the contacts and joints of these bodies. Stale ids and bodies that are not dynamic
    /// contribute nothing.
    pub(crate) fn residual(&self, bodies: &[BodyId], objects: &Objects) -> IslandResidual {
        let mut residual = IslandResidual::default();
        let numbers = bodies.iter().filter_map(|&body| self.body_index(body));
        for body in numbers.filter(|&body| self.is_dynamic(body)) {
            let pairs = self.pairs.pairs_of_body(&self.proxies, body);
            for pair in pairs.filter(|&pair| self.pairs.all[pair].constraint.is_some()) {
                let [overlap, approach] = self.residual_of_pair(pair, objects);
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

    /// Returns the errors of a pair in its present pose: penetration (length units, >= 0), and excess of its approach speed
    /// (length units/s, >= 0).
    ///
    /// The excess is the approach speed minus the speed that closes the gap in one update.
    fn residual_of_pair(&self, pair: usize, objects: &Objects) -> [f32; 2] {
        let [a, b] = self.pairs.triggers[pair].proxies.map(|proxy| &self.proxies.all[proxy as usize]);
        let [pose_a, pose_b] = [a, b].map(|proxy| self.bodies.poses[proxy.body as usize]);
        let [outline_a, outline_b] = [a, b].map(|proxy| self.proxies.vertices.shape_ref(proxy.shape));
        let Manifold { normal, count, points, separations, .. } =
            collide(outline_a, outline_b, pose_a, pose_b, self.parameters.speculative_distance);
        let apart = [pose_b[0] - pose_a[0], pose_b[1] - pose_a[1]];
        let mut errors = [0.0_f32; 2];
        for (&point, &separation) in points.iter().zip(&separations).take(count) {
            let velocity_a = self.velocity_at(a.body as usize, point, objects);
            let velocity_b = self.velocity_at(b.body as usize, difference(point, apart), objects);
            let approach = -dot(difference(velocity_b, velocity_a), normal);
            let allowed = if self.dt > 0.0 { separation.max(0.0) / self.dt } else { 0.0 };
            errors = [errors[0].max(-separation), errors[1].max(approach - allowed)];
        }
        errors
    }

    /// Returns the velocity of a body at a point [x, y] relative to its origin, both in world axes: length units/s; 0 for
    /// static bodies and world boxes.
    fn velocity_at(&self, body: usize, [x, y]: Vector, objects: &Objects) -> Vector {
        let id = self.bodies.ids.get(body).copied().flatten().filter(|_| body <= self.bodies.last_movable);
        let Some(entry) = id.and_then(|id| objects.bodies.get(id)) else { return [0.0; 2] };
        let (velocity, angular_velocity) = (entry.body.linear_velocity(), entry.body.angular_velocity());
        [velocity.x - angular_velocity * y, velocity.y + angular_velocity * x]
    }
}

/// Returns whether the joint connects one of these bodies.
fn is_joint_of_any(joint: &Joint, bodies: &[BodyId]) -> bool {
    let (first, second) = joint.constraint_spec().bodies;
    first.into_iter().chain([second]).any(|body| bodies.contains(&body))
}
