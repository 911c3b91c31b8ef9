//! Regions that hold a fluid (behaviour chapter 12, section 4).

use serde::{Deserialize, Serialize};

use super::ControllerId;
use crate::error::Result;
use crate::math::Vector2;
use crate::math::finite::finite_vector;
use crate::shape::Aabb;

/// A region that holds a fluid.
#[doc(alias = "IFluidContainer")]
pub trait FluidContainer {
    /// Whether a box may reach into the fluid. Geoms whose boxes do not are skipped.
    #[doc(alias = "Intersect")]
    fn intersect(&self, aabb: &Aabb) -> bool;

    /// Whether a point of the world is in the fluid.
    #[doc(alias = "Contains")]
    fn contains(&mut self, point: Vector2) -> bool;
}

/// A box full of fluid.
#[doc(alias = "AABBFluidContainer")]
#[derive(Debug, Clone, Copy, PartialEq, Default, Serialize, Deserialize)]
pub struct AabbFluidContainer {
    aabb: Aabb,
}

impl AabbFluidContainer {
    /// A box filled with fluid. The default is the zero box.
    ///
    /// # Errors
    /// A value that is not finite.
    pub fn new(aabb: Aabb) -> Result<Self> {
        let mut container = AabbFluidContainer::default();
        container.set_aabb(aabb)?;
        Ok(container)
    }

    /// The box.
    #[doc(alias = "AABB")]
    pub fn aabb(&self) -> Aabb {
        self.aabb
    }

    /// Sets the box.
    ///
    /// # Errors
    /// A value that is not finite.
    pub fn set_aabb(&mut self, aabb: Aabb) -> Result<()> {
        finite_vector("aabb", aabb.min)?;
        finite_vector("aabb", aabb.max)?;
        self.aabb = aabb;
        Ok(())
    }

    pub(super) fn is_valid(&self) -> bool {
        AabbFluidContainer::new(self.aabb).is_ok()
    }
}

impl FluidContainer for AabbFluidContainer {
    /// Boxes that only touch intersect.
    fn intersect(&self, aabb: &Aabb) -> bool {
        Aabb::intersect(aabb, &self.aabb)
    }

    /// A point is inside if it is more than 0.00001 length units from every side.
    fn contains(&mut self, point: Vector2) -> bool {
        self.aabb.contains(point)
    }
}

/// The region of the fluid of a [`FluidDragController`](super::FluidDragController).
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[non_exhaustive]
pub enum FluidContainerRef {
    /// In a box.
    Aabb(AabbFluidContainer),
    /// Below the surface of a [`WaveController`](super::WaveController) of the same simulator, which need not be
    /// added.
    Wave(ControllerId),
    /// In a [`FluidContainer`] of the game, which
    /// [`EventHandler::fluid_container`](crate::EventHandler::fluid_container) returns.
    UserDefined,
}
