//! Projected Gauss-Seidel over the rows of an island: the fallback without an acceptable solution.

use super::super::constraint::{Constraint, FIXED};
use super::super::contact::FRICTION;
use super::super::island_body::{Members, add};
use super::IslandSystem;
use crate::parameters::direct::ISLAND_SWEEPS;

impl IslandSystem {
    /// Makes [`ISLAND_SWEEPS`] sweeps of projected Gauss-Seidel over all rows, from the initial impulses: the fallback without
    /// an acceptable solution. The sweeps add no more energy than the initial impulses do. In islands with joints, as many sweeps
    /// over the contacts with fixed bodies follow.
    pub(super) fn gauss_seidel_sweeps(&mut self) {
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
        if joints.is_empty() {
            return;
        }
        // Where joints contradict contacts with bodies that no impulse moves, contacts prevail.
        for _ in 0..ISLAND_SWEEPS {
            for contact in contacts.iter_mut().filter(|contact| contact.bodies.contains(&FIXED)) {
                solve_row_alone(contact, 0, members);
                solve_row_alone(contact, 1, members);
            }
        }
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
