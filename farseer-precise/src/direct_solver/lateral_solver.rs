//! Solution of the friction along the depth axis: see [`lateral_friction`](super::lateral_friction).

use super::contact::FRICTION;
use super::island_newton::IslandSystem;
use super::lateral_friction::apply_lateral_impulse;
use crate::parameters::direct::{LATERAL_FRICTION_CONVERGED, LATERAL_FRICTION_SWEEPS};

impl IslandSystem {
    /// Warm start along the depth axis, before the plane is solved: applies the impulses of the last step to the depth
    /// velocities. A contact that slips faster than `min_slip_speed` (length units/s) along the depth axis then gets a smaller
    /// friction coefficient in the plane, by the direction of its slip.
    pub(super) fn apply_lateral_friction(&mut self, min_slip_speed: f64) {
        let IslandSystem { contacts, lateral_frictions, members, .. } = self;
        for (contact, friction) in contacts.iter().zip(lateral_frictions.iter()) {
            apply_lateral_impulse(contact.bodies, members, friction.impulse);
        }
        for (contact, friction) in contacts.iter_mut().zip(lateral_frictions) {
            let (along, slip) =
                (contact.velocity_error[FRICTION], friction.slip_velocity(contact.bodies, members));
            if slip.abs() > min_slip_speed {
                contact.friction *= along.abs() / (along * along + slip * slip).sqrt();
            }
        }
    }

    /// Gauss-Seidel solve of the friction along the depth axis, after that of the plane. Each row stays within the part of its
    /// friction cone that the friction in the plane leaves. `unit` is the length unit.
    pub(super) fn solve_lateral_friction(&mut self, unit: f64) {
        let IslandSystem { contacts, lateral_frictions, members, .. } = self;
        for _ in 0..LATERAL_FRICTION_SWEEPS {
            let mut has_converged = true;
            for (contact, friction) in contacts.iter_mut().zip(lateral_frictions.iter_mut()) {
                let [one, two, along] = contact.impulses;
                let cone_limit = friction.friction * (one + two);
                contact.friction_limit = (cone_limit * cone_limit - along * along).max(0.0).sqrt();
                let wanted = friction.impulse
                    - friction.effective_mass * friction.slip_velocity(contact.bodies, members);
                let impulse = contact.clamp_friction(wanted);
                let change = impulse - friction.impulse;
                friction.impulse = impulse;
                has_converged &= change.abs() <= LATERAL_FRICTION_CONVERGED * unit * friction.effective_mass;
                apply_lateral_impulse(contact.bodies, members, change);
            }
            if has_converged {
                break;
            }
        }
    }
}
