//! Scenes in the 2.5D engine.

use std::collections::HashMap;
use twohalf::{BodyId, ContactTarget, DepthScheme, TwoHalfPhysicsSimulator};

use super::wrapped;
use crate::scenes::depth::{DepthScene, build_with};
use crate::world::{BodyState, Met, World};

/// A scene in the 2.5D engine.
#[derive(Debug)]
pub struct TwoHalf {
    simulator: TwoHalfPhysicsSimulator,
    bodies: Vec<BodyId>,
    objects: HashMap<BodyId, usize>,
}

impl TwoHalf {
    /// Builds a scene with the scheme that a new simulator has.
    pub fn new(scene: &DepthScene) -> Self {
        Self::of(scene, DepthScheme::default())
    }

    fn of(scene: &DepthScene, scheme: DepthScheme) -> Self {
        let (simulator, bodies) = build_with(scene, scheme);
        let objects = bodies.iter().copied().zip(0..).collect();
        TwoHalf { simulator, bodies, objects }
    }

    /// Builds a scene with a scheme, and a number of iterations per step. Nothing sleeps.
    ///
    /// # Panics
    /// A scene with values that the engine refuses.
    pub fn with_scheme(scene: &DepthScene, scheme: DepthScheme, iterations: i32) -> Self {
        let mut engine = Self::of(scene, scheme);
        engine.simulator.set_iterations(iterations);
        engine.simulator.set_sleep_enabled(false);
        engine
    }

    /// What has come to rest may sleep.
    pub fn with_sleep(mut self) -> Self {
        self.simulator.set_sleep_enabled(true);
        self
    }

    /// The simulator.
    pub fn simulator(&self) -> &TwoHalfPhysicsSimulator {
        &self.simulator
    }

    fn met(&self, partner: ContactTarget) -> Option<Met> {
        match partner {
            ContactTarget::Ground => Some(Met::Ground),
            ContactTarget::Geom(geom) => {
                let body = self.simulator.geom(geom)?.body();
                self.objects.get(&body).copied().map(Met::Object)
            }
            ContactTarget::Platform(id) => {
                self.simulator.platforms().position(|known| known == id).map(Met::Platform)
            }
        }
    }
}

impl World for TwoHalf {
    fn step(&mut self, dt: f32) {
        self.simulator.update(dt);
    }

    fn body(&self, index: usize) -> BodyState {
        let Some(body) = self.simulator.body(self.bodies[index]) else { return BodyState::default() };
        let (position, velocity) = (body.position3d(), body.linear_velocity());
        BodyState {
            position: [position.x, position.y, position.z].map(f64::from),
            angle: wrapped(f64::from(body.rotation())),
            velocity: [velocity.x, -velocity.y, body.linear_velocity_z()].map(f64::from),
            angular_velocity: f64::from(body.angular_velocity()),
        }
    }

    fn body_count(&self) -> usize {
        self.bodies.len()
    }

    /// Where its shadow is drawn. `None` below the ground.
    fn height_beneath(&self, index: usize) -> Option<f64> {
        self.simulator.surface_beneath_body(self.bodies[index]).map(|surface| f64::from(surface.height))
    }

    fn touching(&self, pairs: &mut Vec<(Met, Met)>) {
        for contact in self.simulator.contacts().filter(|contact| contact.normal_impulse > 0.0) {
            if let (Some(a), Some(b)) =
                (self.met(ContactTarget::Geom(contact.this)), self.met(contact.partner))
            {
                pairs.push(Met::pair(a, b));
            }
        }
    }
}
