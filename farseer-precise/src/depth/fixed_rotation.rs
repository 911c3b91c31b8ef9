//! Bodies with a vertical shape have a fixed rotation: neither contacts nor torques rotate them.
//!
//! Their inverse moment of inertia is 0 and the narrow phase uses the angle 0, even if the game has rotated such a body by
//! hand.

use super::state::DepthState;
use crate::bodies::BodySet;
use crate::broad_phase::proxies::{Proxies, Proxy};
use crate::index::{BodyIndex, DenseIndex, ProxyIndex};
use crate::island::sleep::SleepState;

impl DepthState {
    /// Returns whether a body has a vertical shape and so a fixed rotation.
    pub(crate) fn is_rotation_fixed(&self, body_index: BodyIndex) -> bool {
        self.any_fixed_rotation && self.has_fixed_rotation.at(body_index).copied().unwrap_or_default()
    }

    /// Start of a step: sets the angular velocity of awake bodies with a fixed rotation to 0, and also the changes of angular
    /// velocity and angle by torques.
    pub fn clear_fixed_rotation_velocities(&self, bodies: &mut BodySet, sleep: &SleepState) {
        if !self.any_fixed_rotation {
            return;
        }
        for number in
            sleep.awake_bodies(bodies.last_movable).filter(|&number| self.has_fixed_rotation[number])
        {
            for turning in [
                &mut bodies.states[number].velocity[2],
                &mut bodies.initial_velocity[number][2],
                &mut bodies.force_delta[number][2],
                &mut bodies.force_position_delta[number][2],
            ] {
                *turning = 0.0;
            }
        }
    }

    /// End of a step: sets angle and angular velocity of bodies with a fixed rotation to 0. The narrow phase then reads angular
    /// velocity 0, as for a body that a snapshot has restored.
    pub fn reset_fixed_rotation_poses(&self, bodies: &mut BodySet, sleep: &SleepState) {
        if self.any_fixed_rotation {
            // The runs of awake bodies may contain sleeping ones, whose poses were computed as well.
            let renewed = sleep.awake_body_runs.iter().cloned().flatten().map(BodyIndex::new);
            for number in renewed.filter(|&number| self.is_rotation_fixed(number)) {
                let [x, y, ..] = bodies.poses[number];
                bodies.poses[number] = [x, y, 1.0, 0.0];
                bodies.states[number].velocity[2] = 0.0;
            }
        }
    }

    /// Returns the inverse mass (1/mass units) and the inverse moment of inertia about z (1/(mass units * length units^2)) of a
    /// body, of which both are given. The inverse moment of inertia is 0 if the rotation of the body is fixed.
    pub fn without_fixed_inertia(&self, body_index: BodyIndex, [mass, inertia]: [f32; 2]) -> [f32; 2] {
        [mass, if self.is_rotation_fixed(body_index) { 0.0 } else { inertia }]
    }

    /// Fixes the rotation of a proxy's body if the shape of the proxy is vertical. Called when the proxy is added to `Proxies`.
    pub fn fix_rotation_of_proxy(&mut self, proxy: ProxyIndex, proxies: &Proxies, bodies: &mut BodySet) {
        let Proxy { is_world, body, .. } = *proxies.proxy(proxy);
        if self.is_vertical(proxy) && !is_world {
            (*self.has_fixed_rotation.at_or_grow(body), self.any_fixed_rotation) = (true, true);
            fix_rotation(bodies, body);
        }
    }

    /// Fixes the rotation of the bodies of all vertical proxies.
    pub fn fix_rotation_of_all(&mut self, proxies: &Proxies, bodies: &mut BodySet) {
        proxies.indices().for_each(|proxy| self.fix_rotation_of_proxy(proxy, proxies, bodies));
    }

    /// Fixes the rotation of an imported body if it has a vertical shape.
    pub(crate) fn fix_rotation_if_vertical(&self, bodies: &mut BodySet, body_index: BodyIndex) {
        if self.is_rotation_fixed(body_index) {
            fix_rotation(bodies, body_index);
        }
    }
}

/// Sets the inverse moment of inertia, the angle and the angular velocity about z of a body to 0.
fn fix_rotation(bodies: &mut BodySet, body_index: BodyIndex) {
    bodies.inverse_mass_inertia[body_index][1] = 0.0;
    let [x, y, ..] = bodies.poses[body_index];
    bodies.poses[body_index] = [x, y, 1.0, 0.0];
    if let Some(state) = bodies.states.at_mut(body_index) {
        state.velocity[2] = 0.0;
    }
}
