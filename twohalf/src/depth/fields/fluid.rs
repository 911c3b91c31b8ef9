//! Water, mud and air.

use farseer_core::Error;
use serde::{Deserialize, Serialize};

use super::Region;
use crate::{Result, Vector3};

/// How fast still water of this engine slows what is as heavy as it, in 1/s.
const SLOWING: f32 = 4.0;

/// Something that fills a box of the world, and acts on the part of a geom that is in it.
///
/// It pushes up what is lighter than it, with the [gravity](crate::TwoHalfPhysicsSimulator::gravity) of the simulator, where the
/// middle of that part is: things turn as ships do. And it takes along: what is wholly in it comes to the velocity of the
/// flow, and turns ever more slowly, with a rate of `drag` times volume by mass; the fall of what sinks ends at
/// `(density of the thing - density) * gravity / drag`. That is solved in closed form over a step, and is right for any rate.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct Fluid {
    /// Where it is; its greatest Y is its surface.
    pub region: Region,
    /// Mass per px³, finite and 0 or more. What has as much floats wherever it is, and what has half of it half below the
    /// surface. Mass of a thing by its volume: a prism's is that of its outline by its depth, a ball's 4/3 pi r³.
    pub density: f32,
    /// Force per px³ and px/s with which it acts on what does not flow as it does: mass per px³ and s, finite and 0 or more.
    pub drag: f32,
    /// Its velocity in px/s, finite: a current, or a wind.
    pub flow: Vector3,
}

impl Fluid {
    /// Still water of a density, which takes 4 times as much velocity per s from what is as heavy as it.
    pub fn water(region: Region, density: f32) -> Self {
        Fluid { region, density, drag: SLOWING * density, flow: Vector3::zeros() }
    }

    /// Air that moves and carries nothing. What has less mass in its volume is blown away faster.
    pub fn wind(region: Region, flow: Vector3, drag: f32) -> Self {
        Fluid { region, density: 0.0, drag, flow }
    }

    pub(super) fn check(&self) -> Result<()> {
        self.region.check()?;
        for (argument, value) in [("density", self.density), ("drag", self.drag)] {
            if !(value.is_finite() && value >= 0.0) {
                Err(Error::invalid(argument, value, "finite and 0 or more"))?;
            }
        }
        if !self.flow.iter().all(|speed| speed.is_finite()) {
            Err(Error::invalid("flow", self.flow, "finite"))?;
        }
        Ok(())
    }
}
