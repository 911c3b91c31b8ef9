//! Runs 2.5D scenes in `twohalf`.

use std::collections::HashMap;
use twohalf::{BodyId, ContactTarget, DepthScheme, TwoHalfPhysicsSimulator};

use super::wrapped;
use crate::scenes::depth::{DepthScene, build_with};
use crate::world::{BodyState, ContactPartner, World};

/// A 2.5D scene in the simulator of `twohalf`, with its objects as bodies by index.
#[derive(Debug)]
pub struct TwoHalf {
    simulator: TwoHalfPhysicsSimulator,
    bodies: Vec<BodyId>,
    objects: HashMap<BodyId, usize>,
}

impl TwoHalf {
    /// Builds a scene with the default depth scheme of a new simulator. Sleep is disabled.
    pub fn new(scene: &DepthScene) -> Self {
        Self::of(scene, DepthScheme::default())
    }

    fn of(scene: &DepthScene, scheme: DepthScheme) -> Self {
        let (simulator, bodies) = build_with(scene, scheme);
        let objects = bodies.iter().copied().zip(0..).collect();
        TwoHalf { simulator, bodies, objects }
    }

    /// Builds a scene with a depth scheme and a number of iterations (in the precise scheme: substeps) per step. Sleep
    /// is disabled.
    ///
    /// # Panics
    /// The scene has values that the engine rejects.
    pub fn with_scheme(scene: &DepthScene, scheme: DepthScheme, iterations: i32) -> Self {
        let mut engine = Self::of(scene, scheme);
        engine.simulator.set_iterations(iterations);
        engine.simulator.set_sleep_enabled(false);
        engine
    }

    /// Enables sleep of bodies at rest.
    pub fn with_sleep(mut self) -> Self {
        self.simulator.set_sleep_enabled(true);
        self
    }

    /// Returns the simulator of `twohalf`.
    pub fn simulator(&self) -> &TwoHalfPhysicsSimulator {
        &self.simulator
    }

    fn met(&self, partner: ContactTarget) -> Option<ContactPartner> {
        match partner {
            ContactTarget::Ground => Some(ContactPartner::Ground),
            ContactTarget::Geom(geom) => {
                let body = self.simulator.geom(geom)?.body();
                self.objects.get(&body).copied().map(ContactPartner::Object)
            }
            ContactTarget::Platform(id) => {
                self.simulator.platforms().position(|known| known == id).map(ContactPartner::Platform)
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

    /// Returns the height in px of the surface on which the shadow of object `index` is drawn; `None` for an object
    /// below the ground.
    fn height_beneath(&self, index: usize) -> Option<f64> {
        self.simulator.surface_beneath_body(self.bodies[index]).map(|surface| f64::from(surface.height))
    }

    fn touching(&self, pairs: &mut Vec<(ContactPartner, ContactPartner)>) {
        for contact in self.simulator.contacts().filter(|contact| contact.normal_impulse > 0.0) {
            if let (Some(a), Some(b)) =
                (self.met(ContactTarget::Geom(contact.this)), self.met(contact.partner))
            {
                pairs.push(ContactPartner::pair(a, b));
            }
        }
    }
}
