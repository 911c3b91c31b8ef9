//! Operations of both simulators that the tests and programs of this crate use.

use farseer_core::{BodyId, Limits, PhysicsSimulator};
use serde::Serialize;
use serde::de::DeserializeOwned;
use twohalf::TwoHalfPhysicsSimulator;

use crate::{depth, plane};

/// A simulator that can be saved, loaded and queried in all ways.
pub trait Engine: Clone + Serialize + DeserializeOwned {
    /// Returns a simulator without objects.
    fn empty() -> Self;
    /// Returns the snapshot of the complete simulator, as bytes.
    fn snapshot(&self) -> Vec<u8>;
    /// Restores the simulator from a snapshot.
    ///
    /// # Errors
    /// The text of the error, if the snapshot is refused.
    fn restore(&mut self, snapshot: &[u8]) -> Result<(), String>;
    /// Returns a copy that was in another state and went back by a snapshot without geoms; a clone if the engine has none.
    ///
    /// # Errors
    /// The text of the error, if the snapshot is refused.
    fn restored_moving(&self) -> Result<Self, String> {
        Ok(self.clone())
    }
    /// Makes an update of `dt` seconds.
    fn update(&mut self, dt: f32);
    /// Returns the limits of the cost of the simulator. No save includes them.
    fn limits(&self) -> Limits;
    /// Sets the limits of the cost of the simulator.
    fn set_limits(&mut self, limits: Limits);
    /// Reduces the number of iterations per update to at most `most`.
    fn limit_iterations(&mut self, most: i32);
    /// Returns the number of geoms in the simulator.
    fn geoms(&self) -> usize;
    /// Returns the number of pairs that the last update tested, plus the number of contacts that it found.
    fn work(&self) -> usize;
    /// Returns the events of the last update, as text.
    fn events(&self) -> String;
    /// Returns position and velocity of every body, one number after the other: length units, length units/s, radians,
    /// radians/s.
    fn motion(&self) -> Vec<f32>;
    /// Checks that every readable number is finite.
    ///
    /// # Errors
    /// Names the first number that is not finite.
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
    fn restored_moving(&self) -> Result<Self, String> {
        let moving = self.snapshot_moving();
        let mut copy = self.clone();
        (0..3).for_each(|_| copy.update(0.01));
        if let Err(error) = copy.restore_moving(&moving) {
            // Geoms entered or left with these updates.
            if !error.to_string().contains("with other geoms") {
                return Err(error.to_string());
            }
            copy = self.clone();
            copy.restore_moving(&moving).map_err(|error| error.to_string())?;
        }
        Ok(copy)
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
