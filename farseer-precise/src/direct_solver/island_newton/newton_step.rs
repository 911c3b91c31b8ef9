//! The semismooth Newton step of an island: direction, full step over the active set, and line search.

use super::super::constraint::Constraint;
use super::super::constraint_list::{
    add_derivatives, add_impulse_changes, evaluate_all_full_step, step_all_along,
};
use super::super::island_body::{add, dot};
use super::{IslandSystem, StepTolerances};
use crate::parameters::direct::{
    FRICTION_LIMIT_RELAXATION, FULL_STEP_SLOPE, LINE_SEARCH_SLOPE, LINE_SEARCH_STEPS,
};

impl IslandSystem {
    /// Makes one semismooth Newton step with line search. Returns whether it is the last step of the round.
    ///
    /// The step is the last one if the active set stays unchanged, or if each velocity error changes by less than the
    /// `tolerances`. `is_guess` tells that impulses and active set are the first guess. With `relaxes_friction` the
    /// friction limits move towards Coulomb's law after the step.
    pub(super) fn newton_step(
        &mut self,
        is_guess: &mut bool,
        relaxes_friction: bool,
        tolerances: StepTolerances,
    ) -> bool {
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
            fraction = self.step_fraction([slope, end_slope], [product_with_change, product_with_direction]);
            self.step_along(fraction - 1.0);
        }
        *is_guess = false;
        for (member, direction) in self.members.iter_mut().zip(&self.direction) {
            add(&mut member.velocity_change, direction.map(|velocity| fraction * velocity));
        }
        if relaxes_friction && !is_same {
            self.relax_friction_limits();
        }
        is_same || fraction * greatest < tolerances.taken || greatest < tolerances.full
    }

    /// Returns the fraction of a Newton step that changes the active set: all of it while there are
    /// [full steps](crate::parameters::direct::FULL_NEWTON_STEPS) left or it overshoots little, else that of a line search. The
    /// slopes and products are those of [`line_search`](Self::line_search).
    fn step_fraction(
        &mut self,
        [slope, end_slope]: [f64; 2],
        [with_change, with_direction]: [f64; 2],
    ) -> f64 {
        if self.full_steps_left > 0 {
            self.full_steps_left -= 1;
            1.0
        } else if end_slope > FULL_STEP_SLOPE * -slope {
            self.line_search([slope, end_slope], with_change, with_direction)
        } else {
            1.0
        }
    }

    /// Moves the friction limits towards Coulomb's law, and projects the impulses onto them.
    fn relax_friction_limits(&mut self) {
        for contact in &mut self.contacts {
            contact.friction_limit = contact.relax_friction_limit(FRICTION_LIMIT_RELAXATION);
            contact.apply_projection();
        }
    }

    /// Moves the velocity errors of all rows by `fraction` of the last Newton direction (dimensionless), and projects the
    /// impulses onto their bounds again.
    #[inline(never)]
    fn step_along(&mut self, fraction: f64) {
        step_all_along(&mut self.contacts, fraction);
        step_all_along(&mut self.joints, fraction);
    }

    /// Returns whether the factors of the matrix are those of the present active set.
    pub(super) fn has_current_factors(&self) -> bool {
        self.is_factored
            && self.contacts.iter().all(|contact| contact.active_rows == contact.factored_rows)
            && self.joints.iter().all(|joint| joint.active_rows == joint.factored_rows)
    }

    /// Changes the matrix to that of the present active set, and factorises it.
    pub(in super::super) fn factorise(&mut self) {
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
        // Without descent, which rounding may cause, both slopes may be the same.
        if !fraction.is_finite() {
            fraction = 0.5;
        }
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
}
