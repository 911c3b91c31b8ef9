//! What both simulators can do, as far as these programs ask for it.

use farseer_core::{BodyId, Limits, PhysicsSimulator};
use serde::Serialize;
use serde::de::DeserializeOwned;
use twohalf::TwoHalfPhysicsSimulator;

use crate::{depth, plane};

/// A simulator that can be saved in every way and looked at from all sides.
pub trait Engine: Clone + Serialize + DeserializeOwned {
    /// One without anything in it.
    fn empty() -> Self;
    /// The whole of it as bytes.
    fn snapshot(&self) -> Vec<u8>;
    /// Becomes that of a snapshot.
    ///
    /// # Errors
    /// The text of the refusal.
    fn restore(&mut self, snapshot: &[u8]) -> Result<(), String>;
    /// Lets so many seconds pass.
    fn update(&mut self, dt: f32);
    /// What it may cost, which no save says.
    fn limits(&self) -> Limits;
    /// Sets what it may cost.
    fn set_limits(&mut self, limits: Limits);
    /// Has no more passes per update than this.
    fn limit_iterations(&mut self, most: i32);
    /// Number of geoms that live.
    fn geoms(&self) -> usize;
    /// Pairs that the last update tested, and contacts that it found.
    fn work(&self) -> usize;
    /// What happened in the last update, as text.
    fn events(&self) -> String;
    /// Position and velocity of every body.
    fn motion(&self) -> Vec<f32>;
    /// Whether every number that can be looked at is finite.
    ///
    /// # Errors
    /// The first that is not, by name.
    fn check_numbers(&self) -> Result<(), String>;
}

impl Engine for PhysicsSimulator {
    fn empty() -> Self {
        PhysicsSimulator::default()
    }
    fn snapshot(&self) -> Vec<u8> {
        self.snapshot()
    }
    fn restore(&mut self, snapshot: &[u8]) -> Result<(), String> {
        self.restore(snapshot).map_err(|error| error.to_string())
    }
    fn update(&mut self, dt: f32) {
        self.update(dt);
    }
    fn limits(&self) -> Limits {
        self.limits()
    }
    fn set_limits(&mut self, limits: Limits) {
        self.set_limits(limits);
    }
    fn limit_iterations(&mut self, most: i32) {
        self.set_iterations(self.iterations().min(most));
    }
    fn geoms(&self) -> usize {
        self.geoms().count()
    }
    fn work(&self) -> usize {
        self.counters().pairs_tested + self.contact_count()
    }
    fn events(&self) -> String {
        format!("{:?}", self.events())
    }
    fn motion(&self) -> Vec<f32> {
        let of = |body: BodyId| {
            let body = &self[body];
            let (position, velocity) = (body.position(), body.linear_velocity());
            [position.x, position.y, body.total_rotation(), velocity.x, velocity.y, body.angular_velocity()]
        };
        self.bodies().flat_map(of).collect()
    }
    fn check_numbers(&self) -> Result<(), String> {
        plane::check_numbers(self)
    }
}

impl Engine for TwoHalfPhysicsSimulator {
    fn empty() -> Self {
        TwoHalfPhysicsSimulator::new(1).expect("a height of 1 is possible")
    }
    fn snapshot(&self) -> Vec<u8> {
        self.snapshot()
    }
    fn restore(&mut self, snapshot: &[u8]) -> Result<(), String> {
        self.restore(snapshot).map_err(|error| error.to_string())
    }
    fn update(&mut self, dt: f32) {
        self.update(dt);
    }
    fn limits(&self) -> Limits {
        self.limits()
    }
    fn set_limits(&mut self, limits: Limits) {
        self.set_limits(limits);
    }
    fn limit_iterations(&mut self, most: i32) {
        self.set_iterations(self.iterations().min(most));
    }
    fn geoms(&self) -> usize {
        self.core().geoms().count()
    }
    fn work(&self) -> usize {
        self.core().counters().pairs_tested + self.contacts().count()
    }
    fn events(&self) -> String {
        format!("{:?}", self.events())
    }
    fn motion(&self) -> Vec<f32> {
        let of = |body| {
            let body = self.body(body).expect("it was listed");
            let vectors = [body.position3d(), body.velocity3d(), body.angular_velocity3d()];
            vectors.iter().flat_map(|v| [v.x, v.y, v.z]).collect::<Vec<f32>>()
        };
        self.core().bodies().flat_map(of).collect()
    }
    fn check_numbers(&self) -> Result<(), String> {
        depth::check_numbers(self)
    }
}
