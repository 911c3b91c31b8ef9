//! Fluids: buoyancy and drag of water, mud and air.

use farseer_core::Error;
use serde::{Deserialize, Serialize};

use super::Region;
use crate::{Result, Vector3};

/// Drag rate of still water on a body of the density of water, 1/s.
const WATER_DRAG_RATE: f32 = 4.0;

/// A fluid in a box of the world. It acts on the part of a geom that is inside of the box.
///
/// Buoyancy acts at the centroid of the immersed part against the
/// [gravity](crate::TwoHalfPhysicsSimulator::gravity) of the simulator, so bodies right themselves.
///
/// Drag accelerates an immersed body towards the velocity of the flow and slows its rotation, at the rate
/// `drag` times volume by mass. A sinking body ends at the speed `(its density - density) * gravity / drag`.
/// Drag is integrated in closed form over the step, so every rate is stable.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct Fluid {
    /// Box of the fluid; its greatest Y is the surface.
    pub region: Region,
    /// Density, mass per px³, finite and 0 or more. A body of the same density floats anywhere, one of half
    /// of it floats half immersed. The volume of a prism is outline area times depth, that of a ball 4/3 pi
    /// r³.
    pub density: f32,
    /// Drag coefficient: force per px³ of volume and px/s of relative velocity, mass per px³ and s, finite
    /// and 0 or more.
    pub drag: f32,
    /// Velocity of the flow, px/s, finite: a current or a wind.
    pub flow: Vector3,
}

impl Fluid {
    /// Still water of a density in mass per px³. It slows a body of the same density at a rate of 4 per s.
    pub fn water(region: Region, density: f32) -> Self {
        Fluid { region, density, drag: WATER_DRAG_RATE * density, flow: Vector3::zeros() }
    }

    /// Moving air without buoyancy. It accelerates bodies of lower density more.
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
