//! Newton solver of the direct solver: finds the velocities of one island by an augmented Lagrangian method with semismooth
//! Newton steps.
//!
//! Without friction the velocities v after a step minimise 1/2 (v - v0)^T M (v - v0) under the contact and joint constraints.
//! Coulomb friction is no minimisation, since its limits depend on the normal impulses. For frozen friction limits it is one, and
//! the limits follow from its normal impulses: a fixed point (P. Panagiotopoulos, 1975). With impulses l on rows with Jacobian J
//! the solution obeys M (v - v0) = J^T l. The impulse of a contact point is > 0 or the point separates; friction sticks, or slips
//! at its limit.
//!
//! 1. **Augmented Lagrangian** (outer rounds): each row is a stiff spring, l = l0 - k J v, projected onto its bounds. The
//!    impulses of one round become the multipliers l0 of the next, so that the limit is that of rigid rows.
//! 2. **Semismooth Newton** (inner steps): each round minimises a function with a piecewise linear gradient. While the active
//!    set stays the same, one step with H = M + J^T k J over its rows is exact. A line search covers changes of the set.
//! 3. **Friction limits** move towards Coulomb's law after each Newton step and each round. In between they are frozen.
//!
//! H has a block per body and a block per pair of touching bodies. On a column, an arch or a small pile its
//! [factorisation](super::block_ldlt) costs little more than one Gauss-Seidel sweep.
//!
//! Sources: J. C. Simo and T. A. Laursen, "An augmented Lagrangian treatment of contact problems involving friction" (1992),
//! for springs with multipliers. P. Alart and A. Curnier, "A mixed formulation for frictional contact problems prone to Newton
//! like solution methods" (1991), for Newton's method on them. M. Hintermüller, K. Ito and K. Kunisch, "The primal-dual active
//! set strategy as a semismooth Newton method" (2002), for the equivalence of its steps to changes of an active set. P. D.
//! Panagiotopoulos, "A nonlinear programming approach to the unilateral contact-, and friction-boundary value problem in the
//! theory of elasticity" (1975), for the fixed point with frozen friction. K. Erleben, "Rigid body contact problems using
//! proximal operators" (2017), for the proximal view.

mod gauss_seidel;
mod newton_step;
mod position_correction;

use super::block_ldlt::{BlockLdlt, FactorBlocks};
use super::constraint::{BodyIndices, Constraint, FIXED, Jacobian};
use super::constraint_list::{add_constraint_impulses, add_impulse_changes, add_velocity_changes};
use super::contact::ContactRows;
use super::island_body::{MemberVectors, Members, add, max_or_nan};
use super::joint::JointRows;
use super::lateral_friction::LateralFriction;
use super::mat3::Vec3;
use crate::parameters::direct::{
    ACYCLIC_COMPLIANCE, COMPLIANCE_FACTOR, CYCLIC_STEP_TOLERANCE, FIRST_COMPLIANCE,
    FRESH_SOLUTION_NEWTON_STEPS, FRICTION_LIMIT_CONVERGED, FRICTION_LIMIT_RELAXATION, FRICTION_LIMIT_ROUNDS,
    FRICTION_RESIDUAL_WEIGHT, FULL_NEWTON_STEPS, JOINT_ROW_COMPLIANCE, LEAST_COMPLIANCE,
    NEWTON_STEP_TOLERANCE, RESTING_COMPLIANCE, ROUND_NEWTON_STEPS, ROUND_PROGRESS, SOLUTION_NEWTON_STEPS,
    SOLUTION_ROUNDS, STIFF_ROUND_RESIDUAL, STIFF_ROUND_STEPS,
};
use crate::reusing_clone;
pub(super) use position_correction::Correction;

/// Cost and quality of the solution of an island in one update.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct SolveStats {
    /// Number of Newton steps of the solution.
    pub(super) newton_steps: usize,
    /// Velocity residual of the solution: the greatest velocity by which a row violates its law, length units/s.
    pub(super) residual: f64,
    /// Whether the residual is acceptable. If not, the velocities come from Gauss-Seidel sweeps.
    pub(super) is_solved: bool,
}

/// Velocity residuals at which a solution ends or counts as accepted, in length units/s, and the limit of Newton steps.
#[derive(Debug, Clone, Copy)]
pub(super) struct Tolerances {
    /// Velocity residual before the solution, length units/s.
    pub(super) initial_residual: f64,
    /// Greatest velocity residual of an accepted solution, length units/s.
    pub(super) acceptable: f64,
    /// Velocity residual at which the solution ends if a further round improves it little, length units/s.
    pub(super) sufficient: f64,
    /// Velocity residual at which the solution always ends, length units/s.
    pub(super) exact: f64,
    /// Initial velocity residual below which an island counts as at rest, length units/s.
    pub(super) resting: f64,
    /// Velocity residual at which the solution of an island with contact cycles that is not at rest ends, length units/s.
    pub(super) moving_cycles: f64,
    /// Maximum number of Newton steps for an island with joints or contact cycles. For other islands the limit is a constant.
    pub(super) max_newton_steps: usize,
}

/// Properties of an island on which the rounds of its solution depend.
struct RoundPlan {
    /// Maximum number of Newton steps of the solution.
    max_newton_steps: usize,
    /// Whether the island has contact cycles.
    has_cycles: bool,
    /// Whether the island counts as at rest.
    is_resting: bool,
    /// Changes of velocity errors that end a round.
    step_tolerances: StepTolerances,
}

/// Changes of velocity errors in a Newton step below which the step is the last one of its round, in length units/s.
#[derive(Debug, Clone, Copy)]
pub(super) struct StepTolerances {
    /// For the change by the step with its fraction of the line search.
    taken: f64,
    /// For the change by the full step; 0 except in moving islands with contact cycles and no joints.
    full: f64,
}

/// A round of the augmented Lagrangian method.
struct Round {
    /// Index of the round, from 0.
    index: usize,
    /// Number of Newton steps of the round.
    steps: usize,
    /// Whether the round has converged.
    is_found: bool,
    /// Whether the next round must begin anew, with softer contacts.
    has_failed: bool,
}

/// System of equations of one island: its bodies, its constraint rows and the factors of its matrix.
#[derive(Debug, Default)]
pub(super) struct IslandSystem {
    /// Members: the dynamic bodies of the island, by ascending body index.
    pub(super) members: Members,
    /// Rows of the contacts of the island.
    pub(super) contacts: Vec<ContactRows>,
    /// Rows of the joints of the island, then of its springs.
    pub(super) joints: Vec<JointRows>,
    /// Friction rows of the contacts along the depth axis, one per contact in 2.5D; empty in 2D.
    pub(super) lateral_frictions: Vec<LateralFriction>,
    /// The sparse matrix of the Newton step and its factors L D L^T.
    pub(super) factor: BlockLdlt,
    /// Whether `factor` has been computed in this solution, so that it may be updated incrementally.
    is_factored: bool,
    /// Number of Newton steps that this solution may still take without a line search.
    full_steps_left: usize,
    /// Compliance of contact rows in the present round, as a fraction of their inverse effective mass, dimensionless.
    compliance: f64,
    /// Velocity residual at the beginning of the last solution, with the initial impulses, length units/s.
    pub(super) initial_residual: f64,
    /// Negative gradient of the augmented Lagrangian, one vector per member of the island: mass units * length units/s for x
    /// and y, mass units * length units^2/s for the angle. Before and after a solution it is scratch space.
    pub(super) negative_gradient: MemberVectors,
    /// Newton direction, one vector per member: length units/s, length units/s, radians/s. Outside of Newton steps it holds
    /// sums of impulses or position corrections of the island's members.
    pub(super) direction: MemberVectors,
}

/// Rows and blocks of an island during its solution. They are valid within one update, so that all islands use the same memory by
/// turns: see [`IslandSystem::swap_scratch`].
#[derive(Debug, Default)]
pub(super) struct SolutionScratch {
    contacts: Vec<ContactRows>,
    joints: Vec<JointRows>,
    lateral_frictions: Vec<LateralFriction>,
    blocks: FactorBlocks,
    negative_gradient: MemberVectors,
}

reusing_clone! { SolutionScratch { contacts, joints, lateral_frictions, blocks, negative_gradient } }

reusing_clone! { IslandSystem { members, contacts, joints, lateral_frictions, factor, is_factored, full_steps_left, compliance, initial_residual, negative_gradient, direction } }

impl IslandSystem {
    /// Exchanges the memory of the rows and blocks with `scratch`: before a solution, and again after it.
    pub(super) fn swap_scratch(&mut self, scratch: &mut SolutionScratch) {
        std::mem::swap(&mut self.contacts, &mut scratch.contacts);
        std::mem::swap(&mut self.joints, &mut scratch.joints);
        std::mem::swap(&mut self.lateral_frictions, &mut scratch.lateral_frictions);
        std::mem::swap(&mut self.factor.blocks, &mut scratch.blocks);
        std::mem::swap(&mut self.negative_gradient, &mut scratch.negative_gradient);
        self.is_factored = false;
    }

    /// Starts a sum of impulses for each member of the island: sets all sums to 0.
    pub(super) fn begin_impulse_sum(&mut self) {
        self.direction.clear();
        self.direction.resize(self.members.len(), [0.0; 3]);
    }

    /// Adds the row impulses of one contact (mass units * length units/s) to the sums of impulses of its two bodies.
    #[inline(always)]
    pub(super) fn add_to_impulse_sum(&mut self, jacobian: &Jacobian, bodies: BodyIndices, impulses: Vec3) {
        add_constraint_impulses(jacobian, bodies.bodies, impulses, &mut self.direction);
    }

    /// Applies the sums of impulses of the island's members to their velocities.
    pub(super) fn apply_impulse_sum(&mut self) {
        let IslandSystem { members, direction, .. } = self;
        for (member, &impulse) in members.iter_mut().zip(direction.iter()) {
            let change = member.velocity_from_impulse(impulse);
            add(&mut member.velocity, change);
        }
    }

    /// Starts a solution from the present velocities, which contain the initial impulses. Returns the velocity residual, length
    /// units/s.
    ///
    /// `dt` in seconds; `slop` is the penetration that remains, length units. Contacts that slip faster than `min_slip_speed`
    /// (length units/s) along the depth axis divide their friction between that axis and the plane.
    pub(super) fn begin_solve(&mut self, dt: f64, [slop, min_slip_speed]: [f64; 2]) -> f64 {
        (self.is_factored, self.compliance) = (false, 0.0);
        self.full_steps_left = if self.contacts.is_empty() { FULL_NEWTON_STEPS } else { 0 };
        let IslandSystem { members, contacts, joints, .. } = self;
        contacts.iter_mut().for_each(|contact| contact.add_relative_velocity(members, dt.recip(), slop));
        joints.iter_mut().for_each(|joint| joint.add_relative_velocity(members));
        self.apply_lateral_friction(min_slip_speed);
        self.initial_residual = self.residual();
        self.initial_residual
    }

    /// Finds impulses and velocities of the island whose residual is within the `tolerances`. The result is that of the round
    /// with the smallest residual.
    ///
    /// Near the end friction limits may oscillate, for long in contact cycles. In these the first round that does not reduce
    /// the residual to a quarter is the last. In a wedge normal impulses and friction raise each other, and perhaps no round is
    /// acceptable: the result then comes from Gauss-Seidel sweeps.
    pub(super) fn solve(&mut self, tolerances: &Tolerances) -> SolveStats {
        let mut stats = SolveStats { newton_steps: 0, residual: f64::INFINITY, is_solved: false };
        let plan = self.begin_rounds(tolerances);
        let mut is_first = true;
        for index in 0..SOLUTION_ROUNDS {
            let round = self.run_round((index, is_first), stats.newton_steps, &plan, tolerances);
            stats.newton_steps += round.steps;
            let is_over = stats.newton_steps >= plan.max_newton_steps;
            is_first = round.has_failed && !is_over;
            if is_first {
                self.restore_initial_impulses();
                self.set_compliance(FIRST_COMPLIANCE);
                continue;
            }
            if !plan.has_cycles {
                self.recompute_velocity_changes();
            }
            let before =
                if stats.residual.is_finite() { stats.residual } else { tolerances.initial_residual };
            let improves = self.keep_best(&mut stats);
            if is_over || self.is_finished(&plan, &round, (stats.residual, improves), tolerances) {
                break;
            }
            // In contact cycles the friction limits of the first round come from the first guess: a round of one Newton step
            // there does not yet confirm the set. Where one more round with the same reduction should reach the goal, rows stay
            // as stiff as they are: their factors, half of the cost of a round, remain valid.
            let is_confirmed = round.steps == 1 && !(plan.has_cycles && index == 0);
            let is_last = stats.residual * stats.residual <= tolerances.exact * before;
            if self.compliance > LEAST_COMPLIANCE && is_confirmed && !is_last {
                self.set_compliance(COMPLIANCE_FACTOR * self.compliance);
            }
        }
        self.finish_rounds(stats, tolerances)
    }

    /// Plans the rounds of a solution, and sets the compliance of the first one.
    fn begin_rounds(&mut self, tolerances: &Tolerances) -> RoundPlan {
        let has_cycles = self.has_contact_cycles();
        let (is_resting, is_cold_start) =
            (tolerances.initial_residual < tolerances.resting, self.is_cold_start());
        let max_newton_steps = match self.has_joints() {
            true => tolerances.max_newton_steps,
            false if has_cycles && is_cold_start => FRESH_SOLUTION_NEWTON_STEPS,
            false if has_cycles => tolerances.max_newton_steps,
            false => SOLUTION_NEWTON_STEPS,
        };
        self.set_compliance(match has_cycles {
            false if is_resting || is_cold_start => ACYCLIC_COMPLIANCE,
            true if is_resting => RESTING_COMPLIANCE,
            _ => FIRST_COMPLIANCE,
        });
        let is_rough = has_cycles && !is_resting && !self.has_joints();
        let step_tolerances = StepTolerances {
            taken: NEWTON_STEP_TOLERANCE * tolerances.exact,
            full: if is_rough { CYCLIC_STEP_TOLERANCE * tolerances.moving_cycles } else { 0.0 },
        };
        RoundPlan { max_newton_steps, has_cycles, is_resting, step_tolerances }
    }

    /// Runs the round with this index after `steps_before` Newton steps of the solution. `is_first` tells that friction limits and active set
    /// are still to be guessed. The round has failed if its contacts are stiff and it has neither converged nor reduced the
    /// residual enough: the next round begins anew with softer contacts.
    fn run_round(
        &mut self,
        (index, is_first): (usize, bool),
        steps_before: usize,
        plan: &RoundPlan,
        tolerances: &Tolerances,
    ) -> Round {
        let is_stiff = self.compliance < LEAST_COMPLIANCE;
        let steps_left = plan.max_newton_steps - steps_before;
        let max_steps = if is_stiff { STIFF_ROUND_STEPS.min(steps_left) } else { steps_left };
        let (steps, is_found) = self.augmented_lagrangian_round(is_first, plan.step_tolerances, max_steps);
        let has_failed =
            is_stiff && !is_found && self.residual() >= STIFF_ROUND_RESIDUAL * tolerances.initial_residual;
        Round { index, steps, is_found, has_failed }
    }

    /// Returns whether the solution ends after a round: its smallest residual so far is small enough, or a further round would
    /// hardly reduce it. `improves` tells that the round has reduced it to [`ROUND_PROGRESS`] of it.
    fn is_finished(
        &self,
        plan: &RoundPlan,
        round: &Round,
        (residual, improves): (f64, bool),
        tolerances: &Tolerances,
    ) -> bool {
        let is_near = plan.has_cycles && !plan.is_resting && residual <= tolerances.moving_cycles;
        let is_stuck = !improves
            && self.has_converged(round.is_found, round.index)
            && (residual <= tolerances.sufficient || (plan.has_cycles && round.index > 0));
        residual <= tolerances.exact || is_near || is_stuck
    }

    /// Ends a solution: sets impulses and velocities to those of the best round if it is acceptable, otherwise to those of
    /// Gauss-Seidel sweeps.
    fn finish_rounds(&mut self, stats: SolveStats, tolerances: &Tolerances) -> SolveStats {
        let is_solved = stats.residual <= tolerances.acceptable;
        if is_solved {
            self.contacts.iter_mut().for_each(|contact| contact.impulses = contact.best_impulses);
            self.joints.iter_mut().for_each(|joint| joint.impulses = joint.best_impulses);
        } else {
            self.gauss_seidel_sweeps();
        }
        for member in self.members.iter_mut() {
            add(&mut member.velocity, member.best_velocity_change);
        }
        SolveStats { is_solved, ..stats }
    }

    /// Returns whether the island has contacts and none of them has a warm-start impulse.
    fn is_cold_start(&self) -> bool {
        !self.contacts.is_empty() && self.contacts.iter().all(|contact| contact.impulses == [0.0; 3])
    }

    /// Returns whether the island has joints.
    pub(super) fn has_joints(&self) -> bool {
        !self.joints.is_empty()
    }

    /// Returns whether the solution of the island may end after a round that has not reduced the residual to a quarter. Without
    /// joints it may. With joints one of two conditions must hold: the round has converged (`is_found`) and the friction limits
    /// of all contacts have, or `round`, an index from 0, is greater than [`FRICTION_LIMIT_ROUNDS`].
    ///
    /// Reason: friction limits still change when the residual is already small. Contacts that lose their impulses meanwhile can
    /// make an island collapse.
    fn has_converged(&self, is_found: bool, round: usize) -> bool {
        let is_bounded = |contact: &ContactRows| {
            (contact.friction_limit - contact.coulomb_limit()).abs()
                <= FRICTION_LIMIT_CONVERGED * contact.friction_limit
        };
        !self.has_joints()
            || round > FRICTION_LIMIT_ROUNDS
            || (is_found && self.contacts.iter().all(is_bounded))
    }

    /// Returns whether the contact graph has cycles, in which rows can press each other. It has if there are more contacts than
    /// members. Without a contact with a fixed body, as many contacts as members are enough.
    ///
    /// All fixed bodies count as one node. Two convex pieces of a body that touch the same body make a cycle as well. Joints do
    /// not count: their bilateral rows are active from the first step on.
    pub(super) fn has_contact_cycles(&self) -> bool {
        let is_fixed = |contact: &ContactRows| contact.bodies.contains(&FIXED);
        self.contacts.len() + usize::from(!self.contacts.iter().any(is_fixed)) > self.members.len()
    }

    /// Computes the velocity changes of the island's members again from the impulses of all rows, and changes the velocity
    /// errors of the rows to match.
    ///
    /// Rounding errors of stiff rows, and rows that no round has solved, would otherwise violate the conservation of momentum.
    fn recompute_velocity_changes(&mut self) {
        let IslandSystem { members, contacts, joints, direction, .. } = self;
        direction.fill([0.0; 3]);
        add_impulse_changes(contacts, direction);
        add_impulse_changes(joints, direction);
        for (member, velocity) in members.iter_mut().zip(direction.iter_mut()) {
            let change = member.velocity_from_impulse(*velocity);
            *velocity = std::array::from_fn(|axis| change[axis] - member.velocity_change[axis]);
            member.velocity_change = change;
        }
        add_velocity_changes(contacts, direction);
        add_velocity_changes(joints, direction);
    }

    /// Stores velocity changes and impulses of a round as the best ones if its residual is the smallest so far, and that
    /// residual in `stats`. Returns whether the residual is less than [`ROUND_PROGRESS`] times the smallest one before.
    fn keep_best(&mut self, stats: &mut SolveStats) -> bool {
        let residual = self.weighted_residual();
        let improves = residual < ROUND_PROGRESS * stats.residual;
        if residual < stats.residual || stats.residual == f64::INFINITY {
            stats.residual = residual;
            self.members.iter_mut().for_each(|member| member.best_velocity_change = member.velocity_change);
            self.contacts.iter_mut().for_each(|contact| contact.best_impulses = contact.impulses);
            self.joints.iter_mut().for_each(|joint| joint.best_impulses = joint.impulses);
        }
        improves
    }

    /// Restores the impulses, velocity changes and velocity errors from the beginning of the solution. The stored result of the
    /// best round stays.
    fn restore_initial_impulses(&mut self) {
        self.contacts.iter_mut().for_each(|contact| contact.impulses = contact.initial_impulses);
        self.joints.iter_mut().for_each(|joint| joint.impulses = joint.initial_impulses);
        self.recompute_velocity_changes();
    }

    /// Sets the compliance of contact rows for the next round, as a fraction of the inverse effective mass of each row,
    /// dimensionless. The compliance of bilateral joint rows is at most [`JOINT_ROW_COMPLIANCE`]. Motors and limits beside contacts
    /// are as soft as these; without contacts motors have [`FIRST_COMPLIANCE`].
    ///
    /// Reason: a row with two bounds is active within a band of velocities that is as wide as its compliance. Newton steps jump from
    /// bound to bound over a narrow band, up to the limit of steps. Measured on 65 falls of a figure of ten bodies with limits and
    /// brakes of 0 to 300 N m, with twice the present budget of jointed islands. Its joints gape by 1 cm in 60 instead of 457 cases;
    /// the iterative solver gets 212 instead of 2,863 updates.
    fn set_compliance(&mut self, compliance: f64) {
        if self.compliance == compliance {
            return;
        }
        let [before, joint_compliance] =
            [self.compliance, compliance].map(|softness| softness.min(JOINT_ROW_COMPLIANCE));
        self.compliance = compliance;
        // Joint rows cannot exceed their greatest compliance: without contacts the factors stay valid.
        self.is_factored &= self.contacts.is_empty() && before == joint_compliance;
        for contact in &mut self.contacts {
            contact.stiffness = contact.effective_masses.map(|mass| mass / compliance);
        }
        let softer = compliance.max(joint_compliance);
        let of_rows = match self.contacts.is_empty() {
            true => [joint_compliance, joint_compliance, FIRST_COMPLIANCE],
            false => [joint_compliance, softer, softer],
        };
        self.joints.iter_mut().for_each(|joint| joint.set_round_stiffness(of_rows));
    }

    /// Returns the velocity residual of the island: the greatest velocity by which a row of a contact or joint violates its
    /// law, length units/s.
    fn residual(&self) -> f64 {
        let worst = self.contacts.iter().fold(0.0, |worst, contact| max_or_nan(contact.residual(), worst));
        self.joints.iter().fold(worst, |worst, joint| max_or_nan(joint.residual(), worst))
    }

    /// Returns the velocity residual by which rounds are compared, length units/s. In islands with joints friction is
    /// multiplied by [`FRICTION_RESIDUAL_WEIGHT`]. Friction limits follow the normal impulses there, and contacts can hold
    /// before the limits agree with these.
    fn weighted_residual(&self) -> f64 {
        if !self.has_joints() {
            return self.residual();
        }
        let graded = |contact: &ContactRows| {
            max_or_nan(contact.normal_residual(), FRICTION_RESIDUAL_WEIGHT * contact.residual())
        };
        let worst = self.contacts.iter().fold(0.0, |worst, contact| max_or_nan(graded(contact), worst));
        self.joints.iter().fold(worst, |worst, joint| max_or_nan(joint.residual(), worst))
    }

    /// One round of the augmented Lagrangian method: takes the present impulses as multipliers and minimises the augmented
    /// Lagrangian over the velocities. `is_first` tells that the friction limits and the active set are still to be guessed.
    /// Returns the number of Newton steps, at most `max_steps`, and whether it converged to `tolerances`.
    fn augmented_lagrangian_round(
        &mut self,
        is_first: bool,
        tolerances: StepTolerances,
        max_steps: usize,
    ) -> (usize, bool) {
        let is_cold_start = is_first && self.is_cold_start();
        let relaxation = if self.has_joints() { 1.0 } else { FRICTION_LIMIT_RELAXATION };
        for joint in &mut self.joints {
            joint.begin_round();
            joint.apply_projection();
        }
        for contact in &mut self.contacts {
            contact.multipliers = contact.impulses;
            contact.friction_limit = match is_first {
                true if is_cold_start => contact.unbounded_if_near(),
                true => contact.initial_friction_limit(),
                false => contact.relax_friction_limit(relaxation),
            };
            match is_first {
                true => (contact.impulses, contact.active_rows) = contact.initial_active_set(is_cold_start),
                false => contact.apply_projection(),
            }
        }
        let mut is_guess = is_first;
        for step in 1..=ROUND_NEWTON_STEPS.min(max_steps) {
            if self.newton_step(&mut is_guess, step < ROUND_NEWTON_STEPS, tolerances) {
                return (step, true);
            }
        }
        (ROUND_NEWTON_STEPS.min(max_steps), false)
    }
}
