//! Newton solver of the direct solver: finds the velocities of one island by an augmented Lagrangian method with semismooth
//! Newton steps.
//!
//! The velocities v after a step minimise 1/2 (v - v0)^T M (v - v0) under the contact and joint constraints. With impulses l on
//! rows with Jacobian J the solution obeys M (v - v0) = J^T l. The impulse of a contact point is > 0 or the point separates;
//! friction sticks, or slips at its limit.
//!
//! 1. **Augmented Lagrangian** (outer rounds): each row is a stiff spring, l = l0 - k J v, projected onto its bounds. The
//!    impulses of one round become the multipliers l0 of the next, so that the limit is that of rigid rows.
//! 2. **Semismooth Newton** (inner steps): each round minimises a function with a piecewise linear gradient. While the active
//!    set stays the same, one step with H = M + J^T k J over its rows is exact. A line search covers changes of the set.
//! 3. **Friction limits** move towards Coulomb's law after each Newton step and each round.
//!
//! H has a block per body and a block per pair of touching bodies. On a column, an arch or a small pile its
//! [factorisation](super::block_ldlt) costs little more than one Gauss-Seidel sweep.
//!
//! Sources: J. C. Simo and T. A. Laursen, "An augmented Lagrangian treatment of contact problems involving friction" (1992),
//! for springs with multipliers. P. Alart and A. Curnier, "A mixed formulation for frictional contact problems prone to Newton
//! like solution methods" (1991), for Newton's method on them. K. Erleben, "Rigid body contact problems using proximal
//! operators" (2017), for the proximal view.

use super::block_ldlt::{BlockLdlt, FactorBlocks};
use super::constraint::{BodyIndices, Constraint, FIXED, Jacobian};
use super::constraint_list::{
    add_constraint_impulses, add_derivatives, add_impulse_changes, add_velocity_changes,
    evaluate_all_full_step, step_all_along,
};
use super::contact::{ContactRows, FRICTION};
use super::island_body::{Members, add, dot, max_or_nan};
use super::joint::JointRows;
use super::lateral_friction::LateralFriction;
use super::mat3::Vec3;
use crate::parameters::direct::{
    ACYCLIC_COMPLIANCE, COMPLIANCE_FACTOR, FIRST_COMPLIANCE, FRESH_SOLUTION_NEWTON_STEPS,
    FRICTION_LIMIT_CONVERGED, FRICTION_LIMIT_RELAXATION, FRICTION_LIMIT_ROUNDS, FRICTION_RESIDUAL_WEIGHT,
    HELD_POINT_SOLUTIONS, HELD_SEPARATION_FRACTION, ISLAND_SWEEPS, JOINT_ROW_COMPLIANCE, LEAST_COMPLIANCE,
    LINE_SEARCH_SLOPE, LINE_SEARCH_STEPS, RESTING_COMPLIANCE, ROUND_NEWTON_STEPS, SOLUTION_NEWTON_STEPS,
    SOLUTION_ROUNDS, STIFF_ROUND_RESIDUAL, STIFF_ROUND_STEPS,
};
use crate::reusing_clone;

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
    /// Maximum number of Newton steps for an island with joints. For other islands the limit is a constant.
    pub(super) max_newton_steps: usize,
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
    /// Compliance of contact rows in the present round, as a fraction of their inverse effective mass, dimensionless.
    compliance: f64,
    /// Negative gradient of the augmented Lagrangian, one vector per member of the island: mass units * length units/s for x
    /// and y, mass units * length units^2/s for the angle. Before and after a solution it is scratch space.
    pub(super) negative_gradient: Vec<Vec3>,
    /// Newton direction, one vector per member: length units/s, length units/s, radians/s. Outside of Newton steps it holds
    /// sums of impulses or position corrections of the island's members.
    pub(super) direction: Vec<Vec3>,
}

/// Rows and blocks of an island during its solution. They are valid within one update, so that all islands use the same memory by
/// turns: see [`IslandSystem::swap_scratch`].
#[derive(Debug, Default)]
pub(super) struct SolutionScratch {
    contacts: Vec<ContactRows>,
    joints: Vec<JointRows>,
    lateral_frictions: Vec<LateralFriction>,
    blocks: FactorBlocks,
    negative_gradient: Vec<Vec3>,
}

reusing_clone! { SolutionScratch { contacts, joints, lateral_frictions, blocks, negative_gradient } }

reusing_clone! { IslandSystem { members, contacts, joints, lateral_frictions, factor, is_factored, compliance, negative_gradient, direction } }

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
        let IslandSystem { members, contacts, joints, .. } = self;
        contacts.iter_mut().for_each(|contact| contact.add_relative_velocity(members, dt.recip(), slop));
        joints.iter_mut().for_each(|joint| joint.add_relative_velocity(members));
        self.apply_lateral_friction(min_slip_speed);
        self.residual()
    }

    /// Finds impulses and velocities of the island whose residual is within the `tolerances`. The result is that of the round
    /// with the smallest residual.
    ///
    /// Near the end friction limits may oscillate, for long in contact cycles. In these the first round that does not reduce
    /// the residual to a quarter is the last. In a wedge normal impulses and friction raise each other, and perhaps no round is
    /// acceptable: the result then comes from Gauss-Seidel sweeps.
    pub(super) fn solve(&mut self, tolerances: &Tolerances) -> SolveStats {
        let mut stats = SolveStats { newton_steps: 0, residual: f64::INFINITY, is_solved: false };
        let has_cycles = self.has_contact_cycles();
        let (is_resting, is_cold_start) =
            (tolerances.initial_residual < tolerances.resting, self.is_cold_start());
        let limit = match self.has_joints() {
            true => tolerances.max_newton_steps,
            false if has_cycles && is_cold_start => FRESH_SOLUTION_NEWTON_STEPS,
            false => SOLUTION_NEWTON_STEPS,
        };
        self.set_compliance(match has_cycles {
            false if is_resting || is_cold_start => ACYCLIC_COMPLIANCE,
            true if is_resting => RESTING_COMPLIANCE,
            _ => FIRST_COMPLIANCE,
        });
        let mut is_first = true;
        for round in 0..SOLUTION_ROUNDS {
            let is_stiff = self.compliance < LEAST_COMPLIANCE;
            let steps_left = limit - stats.newton_steps;
            let max_steps = if is_stiff { STIFF_ROUND_STEPS.min(steps_left) } else { steps_left };
            let (steps, is_found) = self.augmented_lagrangian_round(is_first, tolerances.exact, max_steps);
            stats.newton_steps += steps;
            let is_over = stats.newton_steps >= limit;
            if is_stiff
                && !(is_found || is_over)
                && self.residual() >= STIFF_ROUND_RESIDUAL * tolerances.initial_residual
            {
                self.restore_initial_impulses();
                self.set_compliance(FIRST_COMPLIANCE);
                is_first = true;
                continue;
            }
            is_first = false;
            if !has_cycles {
                self.recompute_velocity_changes();
            }
            let improves = self.keep_best(&mut stats);
            let is_near = has_cycles && !is_resting && stats.residual <= tolerances.moving_cycles;
            let is_stuck = !improves
                && self.has_converged(is_found, round)
                && (stats.residual <= tolerances.sufficient || (has_cycles && round > 0));
            if stats.residual <= tolerances.exact || is_near || is_stuck || is_over {
                break;
            }
            // In contact cycles the friction limits of the first round come from the first guess: a round of one Newton step
            // there does not yet confirm the set.
            if self.compliance > LEAST_COMPLIANCE && steps == 1 && !(has_cycles && round == 0) {
                self.set_compliance(COMPLIANCE_FACTOR * self.compliance);
            }
        }
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
    /// residual in `stats`. Returns whether the residual is less than a quarter of the smallest one before.
    fn keep_best(&mut self, stats: &mut SolveStats) -> bool {
        let residual = self.weighted_residual();
        let improves = residual < 0.25 * stats.residual;
        if residual < stats.residual || stats.residual == f64::INFINITY {
            stats.residual = residual;
            self.members.iter_mut().for_each(|member| member.best_velocity_change = member.velocity_change);
            self.contacts.iter_mut().for_each(|contact| contact.best_impulses = contact.impulses);
            self.joints.iter_mut().for_each(|joint| joint.best_impulses = joint.impulses);
        }
        improves
    }

    /// Makes [`ISLAND_SWEEPS`] sweeps of projected Gauss-Seidel over all rows, from the initial impulses: the fallback without
    /// an acceptable solution. The sweeps add no more energy than the initial impulses do.
    fn gauss_seidel_sweeps(&mut self) {
        self.restore_initial_impulses();
        let IslandSystem { members, contacts, joints, .. } = self;
        members.iter_mut().for_each(|member| member.best_velocity_change = [0.0; 3]);
        for _ in 0..ISLAND_SWEEPS {
            for joint in joints.iter_mut() {
                (0..3).for_each(|row| solve_row_alone(joint, row, members));
            }
            for contact in contacts.iter_mut() {
                solve_row_alone(contact, FRICTION, members);
                solve_row_alone(contact, 0, members);
                solve_row_alone(contact, 1, members);
            }
        }
    }

    /// Restores the impulses, velocity changes and velocity errors from the beginning of the solution. The stored result of the
    /// best round stays.
    fn restore_initial_impulses(&mut self) {
        self.contacts.iter_mut().for_each(|contact| contact.impulses = contact.initial_impulses);
        self.joints.iter_mut().for_each(|joint| joint.impulses = joint.initial_impulses);
        self.recompute_velocity_changes();
    }

    /// Sets the compliance of contact rows for the next round, as a fraction of the inverse effective mass of each row,
    /// dimensionless. The compliance of joint rows is at most [`JOINT_ROW_COMPLIANCE`].
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
        self.joints.iter_mut().for_each(|joint| joint.set_round_stiffness(joint_compliance));
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
    /// Returns the number of Newton steps, at most `max_steps`, and whether it converged to `tolerance` (length units/s).
    fn augmented_lagrangian_round(
        &mut self,
        is_first: bool,
        tolerance: f64,
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
            if self.newton_step(&mut is_guess, step < ROUND_NEWTON_STEPS, 0.1 * tolerance) {
                return (step, true);
            }
        }
        (ROUND_NEWTON_STEPS.min(max_steps), false)
    }

    /// Makes one semismooth Newton step with line search. Returns whether it is the last step of the round.
    ///
    /// The step is the last one if the active set stays unchanged, or if each velocity error changes by less than `min_change`
    /// (length units/s). `is_guess` tells that impulses and active set are the first guess. With `relaxes_friction` the
    /// friction limits move towards Coulomb's law after the step.
    fn newton_step(&mut self, is_guess: &mut bool, relaxes_friction: bool, min_change: f64) -> bool {
        if !self.has_current_factors() {
            self.factorise();
        }
        let slope = self.find_direction();
        let [product_with_change, product_with_direction] = self.mass_products();
        let (is_same, greatest, end_slope) =
            self.evaluate_full_step(product_with_change + product_with_direction);
        let mut fraction = 1.0;
        if !is_same {
            let mut slope = slope;
            if std::mem::take(is_guess) {
                // The derivative at the guess is not that of the augmented Lagrangian.
                slope = self.derivatives(0.0, product_with_change, product_with_direction).0;
                let descends = slope < 0.0;
                if !descends {
                    self.step_along(-1.0);
                    return false;
                }
            }
            if end_slope > 0.25 * -slope {
                fraction = self.line_search([slope, end_slope], product_with_change, product_with_direction);
            }
            self.step_along(fraction - 1.0);
        }
        *is_guess = false;
        for (member, direction) in self.members.iter_mut().zip(&self.direction) {
            add(&mut member.velocity_change, direction.map(|velocity| fraction * velocity));
        }
        let is_exact = is_same;
        if relaxes_friction && !is_exact {
            for contact in &mut self.contacts {
                contact.friction_limit = contact.relax_friction_limit(FRICTION_LIMIT_RELAXATION);
                contact.apply_projection();
            }
        }
        is_exact || fraction * greatest < min_change
    }

    /// Moves the velocity errors of all rows by `fraction` of the last Newton direction (dimensionless), and projects the
    /// impulses onto their bounds again.
    #[inline(never)]
    fn step_along(&mut self, fraction: f64) {
        step_all_along(&mut self.contacts, fraction);
        step_all_along(&mut self.joints, fraction);
    }

    /// Returns whether the factors of the matrix are those of the present active set.
    fn has_current_factors(&self) -> bool {
        self.is_factored
            && self.contacts.iter().all(|contact| contact.active_rows == contact.factored_rows)
            && self.joints.iter().all(|joint| joint.active_rows == joint.factored_rows)
    }

    /// Changes the matrix to that of the present active set, and factorises it.
    pub(super) fn factorise(&mut self) {
        let IslandSystem { members, contacts, joints, factor, .. } = self;
        if !self.is_factored {
            factor.set_block_diagonal(members.iter().map(|member| [member.mass, member.inertia]));
            contacts.iter_mut().for_each(|contact| contact.factored_rows = 0);
            joints.iter_mut().for_each(|joint| joint.factored_rows = 0);
        }
        let contacts = contacts.iter_mut().filter(|contact| contact.active_rows != contact.factored_rows);
        contacts.for_each(|contact| contact.assemble(factor));
        let joints = joints.iter_mut().filter(|joint| joint.active_rows != joint.factored_rows);
        joints.for_each(|joint| joint.assemble(factor));
        factor.factorise();
        self.is_factored = true;
    }

    /// Computes the Newton direction, H^-1 times the negative gradient of the augmented Lagrangian. Returns the derivative of
    /// the augmented Lagrangian along that direction, mass units * length units^2/s^2.
    fn find_direction(&mut self) -> f64 {
        let IslandSystem { members, contacts, joints, factor, negative_gradient, direction, .. } = self;
        negative_gradient.clear();
        negative_gradient.extend(
            members.iter().map(|member| member.momentum(member.velocity_change).map(|momentum| -momentum)),
        );
        add_impulse_changes(contacts, negative_gradient);
        add_impulse_changes(joints, negative_gradient);
        direction.clone_from(negative_gradient);
        factor.solve(direction);
        -negative_gradient.iter().zip(direction.iter()).map(|(&g, &d)| dot(g, d)).sum::<f64>()
    }

    /// Returns two products d^T M x and d^T M d of the Newton direction d, the velocity change x and the mass matrix M, both in
    /// mass units * length units^2/s^2.
    fn mass_products(&self) -> [f64; 2] {
        let mut sums = [0.0; 2];
        for (member, &velocity) in self.members.iter().zip(&self.direction) {
            let momentum = member.momentum(velocity);
            sums[0] += dot(momentum, member.velocity_change);
            sums[1] += dot(momentum, velocity);
        }
        sums
    }

    /// Takes the full Newton step on all rows. Returns three results: whether the active set stays unchanged, the greatest
    /// change of a velocity error (length units/s), and the derivative of the augmented Lagrangian along the direction at the
    /// end (mass units * length units^2/s^2). `weight` is the term of the masses in that derivative.
    fn evaluate_full_step(&mut self, weight: f64) -> (bool, f64, f64) {
        let IslandSystem { contacts, joints, direction, .. } = self;
        let of_contacts = evaluate_all_full_step(contacts, direction, (true, 0.0, weight));
        evaluate_all_full_step(joints, direction, of_contacts)
    }

    /// Returns the first and second derivative of the augmented Lagrangian along the Newton direction at `fraction` of the step
    /// (0..=1), both in mass units * length units^2/s^2. The full step must have been evaluated. The products are those of
    /// [`mass_products`](Self::mass_products).
    fn derivatives(
        &self,
        fraction: f64,
        product_with_change: f64,
        product_with_direction: f64,
    ) -> (f64, f64) {
        let of_masses = (product_with_change + fraction * product_with_direction, product_with_direction);
        add_derivatives(&self.joints, fraction, add_derivatives(&self.contacts, fraction, of_masses))
    }

    /// Line search: returns the fraction of the Newton step, 0..=1, at which the derivative of the augmented Lagrangian along
    /// the direction is nearly 0.
    ///
    /// It is Newton's method in one dimension, safeguarded by bisection. `start_slope` < 0 and `end_slope` > 0 are the
    /// derivatives at fractions 0 and 1. The products are those of [`mass_products`](Self::mass_products).
    fn line_search(
        &self,
        [start_slope, end_slope]: [f64; 2],
        product_with_change: f64,
        product_with_direction: f64,
    ) -> f64 {
        let (mut low, mut high, mut fraction) = (0.0, 1.0, start_slope / (start_slope - end_slope));
        for _ in 0..LINE_SEARCH_STEPS {
            let (slope, curvature) = self.derivatives(fraction, product_with_change, product_with_direction);
            if slope.abs() < LINE_SEARCH_SLOPE * -start_slope {
                break;
            }
            if slope < 0.0 {
                low = fraction
            } else {
                high = fraction
            }
            fraction -= slope / curvature;
            if !(fraction > low && fraction < high) {
                fraction = 0.5 * (low + high);
            }
        }
        fraction
    }

    /// Position correction of penetration in an island without joints. Returns whether a contact point is deep enough for a
    /// correction. [`corrections`](Self::corrections) then returns the displacement of each member.
    ///
    /// Advances the separations by `dt` seconds of the velocities first. If the deepest point exceeds `slop`, each point that
    /// has an impulse or is very deep moves out by `resolved_fraction` of its penetration, or of `max_correction` if that is
    /// less. Lengths in length units.
    pub(super) fn resolve_penetration(
        &mut self,
        dt: f64,
        [slop, max_correction]: [f64; 2],
        resolved_fraction: f64,
    ) -> bool {
        self.advance_separations(dt, slop) > slop
            && self.correct_positions([slop, max_correction, 0.0], resolved_fraction, [false, true])
    }

    /// Position correction of all constraints in one linear solve. [`corrections`](Self::corrections) then returns the
    /// displacement of each member of the island. Returns whether there is anything to correct.
    ///
    /// `limits` are the penetration that remains, the greatest correction and the least correction, in length units. Joint
    /// errors are corrected completely up to the greatest correction, penetration by `resolved_fraction` (0..=1).
    /// `are_jacobians_new` tells that the factors of the matrix are out of date, `closes_joints` that a joint has an error to
    /// correct. In islands with joints, held points are [left out](Self::leave_out_held_points).
    pub(super) fn correct_positions(
        &mut self,
        [slop, max_correction, min_correction]: [f64; 3],
        resolved_fraction: f64,
        [are_jacobians_new, closes_joints]: [bool; 2],
    ) -> bool {
        self.is_factored &= !are_jacobians_new;
        self.set_compliance(FIRST_COMPLIANCE);
        self.joints.iter_mut().for_each(JointRows::select_corrected_rows);
        for contact in &mut self.contacts {
            contact.select_corrected_rows(slop, [max_correction, min_correction], resolved_fraction);
        }
        if !self.has_current_factors() {
            self.factorise();
        }
        self.solve_corrections(max_correction);
        let may_be_held = self.has_joints();
        for _ in 0..HELD_POINT_SOLUTIONS {
            if !(may_be_held && self.leave_out_held_points()) {
                break;
            }
            if !closes_joints && self.greatest_correction() <= slop {
                return false;
            }
            self.solve_corrections(max_correction);
        }
        if self.contacts.iter().any(|contact| contact.active_rows != 0) {
            self.limit_corrections(max_correction);
        }
        for contact in &mut self.contacts {
            let changes = contact.relative_velocities_in(&self.direction);
            for (row, change) in changes.into_iter().enumerate().take(2) {
                if contact.has_row(row) {
                    contact.separations[row] += change;
                }
            }
        }
        true
    }

    /// Advances the separations of all contacts by `dt` seconds of the velocities. Returns the penetration of the deepest
    /// contact point that needs correction, in length units; 0 if none does. `slop` is the penetration that remains
    /// uncorrected, length units.
    pub(super) fn advance_separations(&mut self, dt: f64, slop: f64) -> f64 {
        let IslandSystem { members, contacts, .. } = self;
        contacts
            .iter_mut()
            .fold(0.0, |deepest, contact| max_or_nan(contact.advance_separations(members, dt, slop), deepest))
    }

    /// Solves the present matrix for the displacements that correct joint errors, each by at most `max_correction` length
    /// units, and separate contact points by their corrections. The result is in `direction`.
    fn solve_corrections(&mut self, max_correction: f64) {
        self.direction.fill([0.0; 3]);
        for contact in &self.contacts {
            let impulses = contact.correction_impulses();
            add_constraint_impulses(&contact.jacobian, contact.bodies, impulses, &mut self.direction);
        }
        for joint in &self.joints {
            add_constraint_impulses(
                &joint.jacobian,
                joint.bodies,
                joint.correction_impulses(max_correction),
                &mut self.direction,
            );
        }
        self.factor.solve(&mut self.direction);
    }

    /// Leaves the penetration of all held points as it is: sets their corrections to 0. A point is held if the displacements
    /// in `direction` separate it by less than [`HELD_SEPARATION_FRACTION`] of its correction. Returns whether there are new
    /// ones.
    ///
    /// Joints may keep bodies overlapping for good. A correction then moves nothing but the errors of joints and other
    /// contacts, in every step, and the island never comes to rest.
    fn leave_out_held_points(&mut self) -> bool {
        let mut is_any_held = false;
        for contact in &mut self.contacts {
            let changes = contact.relative_velocities_in(&self.direction);
            for (correction, change) in contact.corrections.iter_mut().zip(changes) {
                if *correction > 0.0 && change < HELD_SEPARATION_FRACTION * *correction {
                    (*correction, is_any_held) = (0.0, true);
                }
            }
        }
        is_any_held
    }

    /// Returns the greatest separation that the last position correction has demanded of a contact point, in length units.
    pub(super) fn greatest_correction(&self) -> f64 {
        self.contacts
            .iter()
            .flat_map(|contact| contact.corrections)
            .fold(0.0, |most, next| max_or_nan(next, most))
    }

    /// Scales the position corrections so that no member of the island moves by more than twice `max_correction`, in length
    /// units. In a column the corrections of all contacts add up.
    fn limit_corrections(&mut self, max_correction: f64) {
        let square = |&[x, y, _]: &Vec3| x * x + y * y;
        let (longest, limit) =
            (self.direction.iter().map(square).fold(0.0, max_or_nan).sqrt(), 2.0 * max_correction);
        if longest > limit {
            let factor = limit / longest;
            self.direction.iter_mut().flatten().for_each(|component| *component *= factor);
        }
    }

    /// Returns the position correction of each member of the island, after [`resolve_penetration`](Self::resolve_penetration)
    /// or [`correct_positions`](Self::correct_positions): length units, length units, radians.
    pub(super) fn corrections(&self) -> &[Vec3] {
        &self.direction
    }
}

/// Gauss-Seidel step for one row of a constraint: changes the impulse of the row, within its bounds, so that its velocity error
/// becomes 0. Adds the effect to `best_velocity_change` of the two bodies.
#[inline(never)]
fn solve_row_alone<C: Constraint>(rows: &mut C, row: usize, members: &mut Members) {
    if rows.effective_masses[row] <= 0.0 {
        return;
    }
    let change = rows.relative_velocities_of(|member| members[member].best_velocity_change);
    let error = rows.velocity_error[row] + change[row];
    let impulse = rows.solve_row(row, error);
    for (&member, impulse) in rows.bodies.iter().zip(rows.jacobian.body_impulses(impulse)) {
        if member != FIXED {
            let member = &mut members[member];
            let change = member.velocity_from_impulse(impulse);
            add(&mut member.best_velocity_change, change);
        }
    }
}
