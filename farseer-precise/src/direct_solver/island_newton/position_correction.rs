//! Position correction of an island: displacements that close joints and resolve penetration, from the matrix of the Newton step.

use super::super::constraint_list::add_constraint_impulses;
use super::super::island_body::{MemberVectors, max_or_nan};
use super::super::joint::JointRows;
use super::super::mat3::Vec3;
use super::IslandSystem;
use crate::parameters::direct::{
    FIRST_COMPLIANCE, HELD_POINT_SOLUTIONS, HELD_SEPARATION_FRACTION, JOINT_ROW_COMPLIANCE,
    PRESSING_JOINT_COMPLIANCE,
};

/// Result of a position correction.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(in super::super) enum Correction {
    /// No error is to be corrected.
    None,
    /// All errors are corrected as demanded.
    Free,
    /// A static or kinematic body stands in the way: joints keep errors.
    Blocked,
}

impl IslandSystem {
    /// Position correction of penetration in an island without joints. Returns whether a contact point is deep enough for a
    /// correction. [`corrections`](Self::corrections) then returns the displacement of each member.
    ///
    /// Advances the separations by `dt` seconds of the velocities first. If the deepest point exceeds `uncorrected`, each point
    /// that has an impulse or is very deep, compared with `slop`, moves out by `resolved_fraction` of its penetration, or of
    /// `max_correction` if that is less. Lengths in length units.
    pub(in super::super) fn resolve_penetration(
        &mut self,
        dt: f64,
        [uncorrected, slop, max_correction]: [f64; 3],
        resolved_fraction: f64,
    ) -> bool {
        self.advance_separations(dt, slop) > uncorrected
            && self.correct_positions([slop, max_correction, 0.0], resolved_fraction, [false, true])
                != Correction::None
    }

    /// Position correction of all constraints in one linear solve. [`corrections`](Self::corrections) then returns the
    /// displacement of each member of the island.
    ///
    /// `limits` are the penetration that remains, the greatest correction and the least correction, in length units. Joint
    /// errors are corrected completely up to the greatest correction, penetration by `resolved_fraction` (0..=1).
    /// `are_jacobians_new` tells that the factors of the matrix are out of date, `closes_joints` that a joint has an error to
    /// correct. In islands with joints, held points are [left out](Self::leave_out_held_points), and joints do not
    /// [press](Self::correct_beside_pressed_points) bodies into static or kinematic ones.
    pub(in super::super) fn correct_positions(
        &mut self,
        [slop, max_correction, min_correction]: [f64; 3],
        resolved_fraction: f64,
        [are_jacobians_new, closes_joints]: [bool; 2],
    ) -> Correction {
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
            if !closes_joints && self.greatest_correction() <= slop && !self.has_pressed_point(slop) {
                return Correction::None;
            }
            self.solve_corrections(max_correction);
        }
        if self.contacts.iter().any(|contact| contact.active_rows != 0) {
            self.limit_corrections(max_correction);
        }
        let is_blocked = may_be_held && self.correct_beside_pressed_points([slop, max_correction]);
        self.correct_separations();
        if is_blocked { Correction::Blocked } else { Correction::Free }
    }

    /// Returns whether a contact point is pressed too deep into a static or kinematic body before any correction, by more than
    /// `slop` length units.
    fn has_pressed_point(&self, slop: f64) -> bool {
        self.contacts.iter().any(|contact| (0..2).any(|row| contact.is_pressed(row, 0.0, slop)))
    }

    /// Solves the position correction again if it presses a contact point too deep into a static or kinematic body: such points
    /// hold, and joints yield. `limits` are the penetration slop and the greatest correction, in length units. Returns whether
    /// there is such a point.
    ///
    /// Joint rows are otherwise a thousand times as stiff as contact rows. Where both contradict each other, they would pull the
    /// body through the wall. Here pressed points have the compliance of joints, and joints yield
    /// ([`PRESSING_JOINT_COMPLIANCE`]).
    fn correct_beside_pressed_points(&mut self, [slop, max_correction]: [f64; 2]) -> bool {
        if !self.hold_pressed_points(slop) {
            return false;
        }
        self.is_factored = false;
        self.joints.iter_mut().for_each(|joint| joint.set_round_stiffness([PRESSING_JOINT_COMPLIANCE; 3]));
        for _ in 0..HELD_POINT_SOLUTIONS {
            self.factorise();
            self.solve_corrections(max_correction);
            if !self.hold_pressed_points(slop) {
                break;
            }
        }
        self.limit_corrections(max_correction);
        // The next correction sets the stiffness of all rows again.
        (self.compliance, self.is_factored) = (0.0, false);
        true
    }

    /// Adds the contact points that the displacements in `direction` press too deep to the active set. Returns whether there are
    /// any. `slop` in length units.
    fn hold_pressed_points(&mut self, slop: f64) -> bool {
        let mut is_any_pressed = false;
        for contact in &mut self.contacts {
            let changes = contact.relative_velocities_in(&self.direction);
            if contact.hold_pressed_points(changes, slop) {
                contact.stiffness = contact.effective_masses.map(|mass| mass / JOINT_ROW_COMPLIANCE);
                is_any_pressed = true;
            }
        }
        is_any_pressed
    }

    /// Changes the separations of all contacts by the position corrections.
    fn correct_separations(&mut self) {
        for contact in &mut self.contacts {
            let changes = contact.relative_velocities_in(&self.direction);
            for (row, change) in changes.into_iter().enumerate().take(2) {
                if contact.has_row(row) {
                    contact.separations[row] += change;
                }
            }
        }
    }

    /// Advances the separations of all contacts by `dt` seconds of the velocities. Returns the penetration of the deepest
    /// contact point that needs correction, in length units; 0 if none does. `slop` is the penetration that remains
    /// uncorrected, length units.
    pub(in super::super) fn advance_separations(&mut self, dt: f64, slop: f64) -> f64 {
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
    pub(in super::super) fn greatest_correction(&self) -> f64 {
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
    pub(in super::super) fn corrections(&self) -> &MemberVectors {
        &self.direction
    }
}
