//! Scenes in the 2.5D engine.

use std::collections::HashMap;
use twohalf::{BodyId, Methods, Partner, TwoHalfPhysicsSimulator};

use super::{Engine, Met, State, ordered, wrapped};
use crate::depth_scenes::{DepthScene, build};

/// A scene in the 2.5D engine.
#[derive(Debug)]
pub struct TwoHalf {
    simulator: TwoHalfPhysicsSimulator,
    bodies: Vec<BodyId>,
    objects: HashMap<BodyId, usize>,
    dt: f32,
}

impl TwoHalf {
    /// Builds a scene.
    pub fn new(scene: &DepthScene) -> Self {
        let (simulator, bodies) = build(scene);
        let objects = bodies.iter().copied().zip(0..).collect();
        TwoHalf { simulator, bodies, objects, dt: scene.dt }
    }

    /// Builds a scene for other methods, and a number of iterations per step.
    ///
    /// # Panics
    /// A scene with values that the engine refuses.
    pub fn with_methods(scene: &DepthScene, methods: Methods, iterations: i32) -> Self {
        let mut engine = Self::new(scene);
        engine.simulator.set_iterations(iterations);
        // Nothing of a scene takes part before its first step.
        engine.simulator.set_methods(methods).unwrap_or_else(|error| panic!("{}: {error}", scene.name));
        engine
    }

    /// Moves everything by a time in s.
    pub fn step_by(&mut self, dt: f32) {
        self.simulator.update(dt);
    }

    /// How many objects the scene has.
    pub fn object_count(&self) -> usize {
        self.bodies.len()
    }

    /// Height of the surface, of the ground or of a platform, that is straight below the middle of an object; where
    /// its shadow is drawn. `None` below the ground.
    pub fn height_beneath(&self, object: usize) -> Option<f64> {
        self.simulator.surface_beneath_body(self.bodies[object]).map(|surface| f64::from(surface.height))
    }

    /// The simulator.
    pub fn simulator(&self) -> &TwoHalfPhysicsSimulator {
        &self.simulator
    }

    fn met(&self, partner: Partner) -> Option<Met> {
        match partner {
            Partner::Ground => Some(Met::Ground),
            Partner::Geom(geom) => {
                let body = self.simulator.geom(geom)?.body();
                self.objects.get(&body).copied().map(Met::Object)
            }
            Partner::Platform(id) => {
                self.simulator.platforms().position(|known| known == id).map(Met::Platform)
            }
        }
    }
}

impl Engine for TwoHalf {
    fn step(&mut self) {
        self.simulator.update(self.dt);
    }

    fn state(&self, object: usize) -> State {
        let Some(body) = self.simulator.body(self.bodies[object]) else { return State::default() };
        let (position, velocity) = (body.position3d(), body.linear_velocity());
        State {
            position: [position.x, position.y, position.z].map(f64::from),
            velocity: [velocity.x, -velocity.y, body.linear_velocity_z()].map(f64::from),
            rotation: wrapped(f64::from(body.rotation())),
        }
    }

    fn touching(&self, pairs: &mut Vec<(Met, Met)>) {
        for contact in self.simulator.contacts().filter(|contact| contact.normal_impulse > 0.0) {
            if let (Some(a), Some(b)) = (self.met(Partner::Geom(contact.this)), self.met(contact.partner)) {
                pairs.push(ordered(a, b));
            }
        }
    }
}
