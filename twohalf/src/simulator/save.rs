//! Saving and loading the whole simulator.
//!
//! A loaded simulator continues with the same bits, events and callbacks; a save that contradicts itself is refused. Pending
//! reports of refused arguments, movements and disposals are saved. Events and counters of the last update are not saved,
//! because the next update overwrites them without reading them.

use std::borrow::Cow;

use farseer_core::depth::{DepthAxis, DepthAxisMut};
use farseer_core::{Limits, SavedSimulator};
use serde::ser::SerializeStruct as _;
use serde::{Deserialize, Deserializer, Serialize, Serializer, de::Error as _};

use super::TwoHalfPhysicsSimulator;
use crate::Result;
use crate::depth::{ContactList, CrushMonitor, DepthProfile, DepthScheme, TimeScale, World};
use crate::error::damaged;
use crate::stages::list_loaded;
use crate::views::list_contacts;

impl<'de> Deserialize<'de> for TwoHalfPhysicsSimulator {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        let saved = SavedTwoHalfSimulator::deserialize(deserializer)?;
        saved.load(Limits::default()).map_err(D::Error::custom)
    }
}

/// A [`TwoHalfPhysicsSimulator`] that was read from a save and can be loaded with other [`Limits`] than the default ones.
#[derive(Debug, Clone, Deserialize)]
pub struct SavedTwoHalfSimulator {
    core: SavedSimulator,
    world: World,
    touches: ContactList,
}

impl Serialize for TwoHalfPhysicsSimulator {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        let TwoHalfPhysicsSimulator { core, world, .. } = self;
        let touches = match world.scheme {
            DepthScheme::Precise => list_contacts(core, world),
            DepthScheme::Faithful | DepthScheme::Thesis => Cow::Borrowed(&world.touches),
        };
        let mut saved = serializer.serialize_struct("SavedTwoHalfSimulator", 3)?;
        saved.serialize_field("core", core)?;
        saved.serialize_field("world", world)?;
        saved.serialize_field("touches", &*touches)?;
        saved.end()
    }
}

impl SavedTwoHalfSimulator {
    /// Loads the simulator with limits that it keeps.
    ///
    /// # Errors
    /// A save that contradicts itself; [`farseer_core::Error::LimitExceeded`] for more than the limits allow.
    pub fn load(self, limits: Limits) -> Result<TwoHalfPhysicsSimulator> {
        let core = self.core.load(limits)?;
        let world = World { touches: self.touches, ..self.world };
        let mut simulator = TwoHalfPhysicsSimulator::of(core, world);
        simulator.check()?;
        list_loaded(&mut DepthAxisMut::of(&mut simulator.core), &simulator.world);
        Ok(simulator)
    }
}

impl TwoHalfPhysicsSimulator {
    /// Returns an error for a state that no sequence of calls can make, and recomputes the fields that are not saved.
    fn check(&mut self) -> Result<()> {
        let TwoHalfPhysicsSimulator { core, world, .. } = self;
        world.has_rejected = world.depths.bodies.iter_mut().any(|(_, state)| !state.rejected.is_empty());
        if !world.depths.bodies.is_valid(|_, state| state.is_valid()) {
            return Err(damaged("the motion of a body along Z is not finite"));
        }
        if !world.depths.profiles.is_valid(|_, profile| profile.check().is_ok()) {
            return Err(damaged("a depth profile is out of range"));
        }
        if !world.touches.is_valid() {
            return Err(damaged("the contacts are not in order or not finite"));
        }
        if !world.platforms.restore(&world.projection) {
            return Err(damaged("a platform is out of range"));
        }
        if world.scheme != DepthScheme::Precise && world.platforms.are_precise() {
            return Err(damaged(
                "a platform moves, is a belt, one-way, turned or a slope along Z, where none can be",
            ));
        }
        if world.scheme != DepthScheme::Precise && world.depths.have_uprights(core) {
            return Err(damaged("a geom is upright, where none can be"));
        }
        if !world.fields.is_valid() {
            return Err(damaged("a field is out of range"));
        }
        if !world.paces.iter().all(TimeScale::is_valid) {
            return Err(damaged("the time of a body is out of range"));
        }
        if !world.crush_watches.iter().all(CrushMonitor::is_valid) {
            return Err(damaged("a tolerance of crushing is out of range"));
        }
        if !world.footings.is_valid() {
            return Err(damaged("what holds a figure is not finite"));
        }
        let (near, far) = world.layer_range;
        if !((far - near).is_finite() && near < far) {
            return Err(damaged("the layer depth range is out of range"));
        }
        let bodies_have_depth = core.bodies().all(|body| world.depths.bodies.get(body).is_some());
        let geoms_have_depth = core.geoms().all(|geom| world.depths.profiles.get(geom).is_some());
        if !bodies_have_depth || !geoms_have_depth {
            return Err(damaged("an object has no depth"));
        }
        let has_its_box = |geom| match (world.depths.profiles.get(geom), world.scheme) {
            // A ball whose AABB would not be finite keeps that of its outline.
            (Some(DepthProfile::Round { radius }), DepthScheme::Faithful | DepthScheme::Precise) => core
                .geom(geom)
                .and_then(|geom| geom.box_radius())
                .is_none_or(|box_radius| box_radius == *radius),
            _ => true,
        };
        let is_precise = matches!(core.methods(), farseer_core::Methods::Precise { .. });
        if is_precise != (world.scheme == DepthScheme::Precise)
            || is_precise != DepthAxis::of(core).is_enabled()
        {
            return Err(damaged("the methods of the plane are not those of the scheme"));
        }
        if !core.geoms().all(has_its_box) {
            return Err(damaged("the box of a ball is not that of a ball"));
        }
        Ok(())
    }
}
