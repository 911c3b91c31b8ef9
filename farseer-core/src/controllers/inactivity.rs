//! Disabling of slow bodies, and enabling by distance (behaviour chapter 12, section 8).

use serde::{Deserialize, Serialize};

use crate::body::entry::Bodies;
use crate::body::{Body, BodyId};
use crate::checked_properties::checked_properties;
use crate::math::vector2;

/// Disables bodies that have been slow for long, and enables them again when a body comes near that moves.
///
/// Only bodies with [`is_auto_idle`](Body::is_auto_idle) are disabled or enabled. They are enabled by every enabled
/// body that is not static and [moves](Body::moves) **or is not auto-idle**: a resting crate with the default settings
/// keeps all auto-idle bodies around it awake, as in the original. A disabled body keeps its velocity and continues
/// with it when it is enabled.
#[derive(Debug, Clone, Serialize, Deserialize)]
pub struct InactivityController {
    activation_distance: f32,
    max_idle_time: f32,
    bodies_enabled: u32,
}

impl Default for InactivityController {
    fn default() -> Self {
        InactivityController::new()
    }
}

impl InactivityController {
    /// Activation distance 100 length units, maximum idle time 1000 ms. A simulator has no inactivity controller until
    /// one is [made](crate::PhysicsSimulator::create_controller) and [added](crate::PhysicsSimulator::add), as in the
    /// original.
    #[doc(alias("InactivityController(PhysicsSimulator)", "PhysicsSimulator.InactivityController"))]
    pub fn new() -> Self {
        InactivityController { activation_distance: 100.0, max_idle_time: 1000.0, bodies_enabled: 0 }
    }

    checked_properties! {
        /// Maximum distance of the origins of two bodies at which one enables the other, in length units. Default 100;
        /// with a negative one no body is enabled.
        #[doc(alias = "ActivationDistance")]
        activation_distance, set_activation_distance;
        /// Time that a body may be slow before it is disabled, in milliseconds. Default 1000.
        #[doc(alias = "MaxIdleTime")]
        max_idle_time, set_max_idle_time;
    }

    /// Number of bodies, without static ones, that were enabled in the last update. Bodies that an earlier one in the
    /// list enabled count, and so do bodies that were disabled in that update.
    #[doc(alias = "BodiesEnabled")]
    pub fn bodies_enabled(&self) -> u32 {
        self.bodies_enabled
    }

    /// Whether two bodies are near enough for one to enable the other.
    #[doc(alias = "IsInActivationDistance")]
    pub fn is_in_activation_distance(&self, body1: &Body, body2: &Body) -> bool {
        vector2::length(body1.position() - body2.position()) <= self.activation_distance
    }

    /// One run over the listed bodies. Sets `has_switched` if some were disabled or enabled. Returns false if an idle
    /// time would not have been finite; that body keeps its old one.
    pub(crate) fn update(&mut self, dt: f32, bodies: &mut Bodies, has_switched: &mut bool) -> bool {
        let milliseconds = dt * 1000.0;
        let mut all_finite = true;
        self.bodies_enabled = 0;
        for position in 0..bodies.list().len() {
            let id = bodies.list()[position];
            let body = &mut bodies[id].body;
            if !body.is_integrated() {
                continue;
            }
            self.bodies_enabled += 1;
            if body.moves() || !body.is_auto_idle() {
                body.set_idle_time(0.0);
                *has_switched |= self.wake_around(id, bodies);
                continue;
            }
            let idle_time = body.idle_time() + milliseconds;
            if !idle_time.is_finite() {
                all_finite = false;
                continue;
            }
            body.set_idle_time(idle_time);
            if idle_time >= self.max_idle_time {
                body.set_enabled(false);
                *has_switched = true;
            }
        }
        all_finite
    }

    /// Enables the disabled bodies around one; returns whether there were any.
    fn wake_around(&self, waking: BodyId, bodies: &mut Bodies) -> bool {
        let mut has_woken = false;
        for position in 0..bodies.list().len() {
            let id = bodies.list()[position];
            let body = &bodies[id].body;
            let wakes = !body.enabled()
                && body.is_auto_idle()
                && self.is_in_activation_distance(&bodies[waking].body, body);
            if wakes {
                let body = &mut bodies[id].body;
                body.set_enabled(true);
                body.set_idle_time(0.0);
                has_woken = true;
            }
        }
        has_woken
    }

    pub(super) fn is_valid(&self) -> bool {
        self.activation_distance.is_finite() && self.max_idle_time.is_finite()
    }
}
