//! Saving and loading the whole simulator.
//!
//! What was loaded continues with the same bits; what contradicts itself is refused.

use serde::{Deserialize, Deserializer, Serialize, Serializer, de::Error as _};

use crate::error::damaged;
use crate::{Result, TwoHalfPhysicsSimulator};

impl Serialize for TwoHalfPhysicsSimulator {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        TwoHalfPhysicsSimulator::serialize(self, serializer)
    }
}

impl<'de> Deserialize<'de> for TwoHalfPhysicsSimulator {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        let simulator = TwoHalfPhysicsSimulator::deserialize(deserializer)?;
        simulator.check().map_err(D::Error::custom)?;
        Ok(simulator)
    }
}

impl TwoHalfPhysicsSimulator {
    /// Refuses what no sequence of calls could have made.
    fn check(&self) -> Result<()> {
        if !self.depths.bodies.is_valid(|_, state| state.is_valid()) {
            return Err(damaged("the motion of a body along Z is not finite"));
        }
        if !self.depths.profiles.is_valid(|_, profile| profile.check().is_ok()) {
            return Err(damaged("a depth profile is out of range"));
        }
        if !self.passing.is_valid() {
            return Err(damaged("the passing pairs are not in order"));
        }
        let bodies_have_depth = self.body_list().iter().all(|&body| self.depths.bodies.get(body).is_some());
        let geoms_have_depth = self.geom_list().iter().all(|&geom| self.depths.profiles.get(geom).is_some());
        if !bodies_have_depth || !geoms_have_depth {
            return Err(damaged("an object has no depth"));
        }
        Ok(())
    }
}
