//! The simulator as a callback sees it.

use std::ops::{Deref, DerefMut};

use super::PhysicsSimulator;
use crate::math::finite::{finite, zero_or_more};
use crate::objects::Objects;
use crate::{Error, Result};
use farseer_precise::surface::SurfaceOverride;

/// Access of a callback to the simulator that calls it: all that [`Objects`] offers, at once. Objects that a callback
/// adds, removes or disposes enter or leave with the next update.
#[derive(Debug)]
pub struct Context<'a> {
    pub(super) simulator: &'a mut PhysicsSimulator,
    /// Surface coefficients of the two geoms of a collision, while a handler is asked about it.
    pub(super) surface: Option<&'a mut SurfaceOverride>,
}

impl Context<'_> {
    /// The same with a shorter lifetime: for engines that pass it on inside a context of their own.
    pub fn reborrow(&mut self) -> Context<'_> {
        Context { simulator: self.simulator, surface: self.surface.as_deref_mut() }
    }

    /// The same while a handler is asked about a collision.
    pub(super) fn with_surface<'s>(&'s mut self, surface: &'s mut SurfaceOverride) -> Context<'s> {
        Context { simulator: self.simulator, surface: Some(surface) }
    }

    /// The simulator, for reading and queries. In the middle of an update it shows the state that the stages have
    /// reached.
    pub fn simulator(&self) -> &PhysicsSimulator {
        self.simulator
    }
}

/// Surface coefficients that a handler may set in [`on_collision`](crate::EventHandler::on_collision), for all contacts
/// of the two geoms and this update alone. Coefficients that are not set follow from those of the geoms. The side that
/// is asked later may set them again, and the last value counts. Not in the original.
///
/// ```
/// use farseer_core::{Contact, Context, EventHandler, GeomId};
///
/// /// Nothing that touches it stays where it is: it is carried along at 50 units per second.
/// struct Escalator(GeomId);
///
/// impl EventHandler for Escalator {
///     fn on_collision(
///         &mut self,
///         context: &mut Context<'_>,
///         this: GeomId,
///         _: GeomId,
///         _: &mut Vec<Contact>,
///     ) -> bool {
///         if this == self.0 {
///             context.set_contact_tangent_speed(50.0).expect("a finite speed, in a collision");
///         }
///         true
///     }
/// }
/// ```
impl Context<'_> {
    /// Sets the friction coefficient between the two geoms, dimensionless, 0 or more; it replaces the combined one.
    ///
    /// # Errors
    /// A number that is not finite or less than 0; [`Error::NoCollision`] in any other callback.
    pub fn set_contact_friction(&mut self, friction: f32) -> Result<()> {
        let friction = zero_or_more("friction", friction)?;
        self.surface()?.friction = Some(friction);
        Ok(())
    }

    /// Sets the restitution coefficient between the two geoms, dimensionless, 0 or more: ratio of the speeds after and
    /// before the impact. It replaces the combined one.
    ///
    /// # Errors
    /// As [`set_contact_friction`](Self::set_contact_friction).
    pub fn set_contact_restitution(&mut self, restitution: f32) -> Result<()> {
        let restitution = zero_or_more("restitution", restitution)?;
        self.surface()?.restitution = Some(restitution);
        Ok(())
    }

    /// Sets the target of friction, in length units/s: the speed of geom B relative to geom A along `(normal.y,
    /// -normal.x)` of their contacts. The direction is the same whichever geom is A.
    ///
    /// With y down, as on a screen, a positive speed carries a body on a floor to the left; with y up to the right. The
    /// speed adds to the velocities of the bodies, also to the surface velocity of static ones. Usually 0; without
    /// friction it has no effect.
    ///
    /// # Errors
    /// A number that is not finite; [`Error::NoCollision`] in any other callback.
    pub fn set_contact_tangent_speed(&mut self, tangent_speed: f32) -> Result<()> {
        let tangent_speed = finite("tangent_speed", tangent_speed)?;
        self.surface()?.tangent_speed = Some(tangent_speed);
        Ok(())
    }

    fn surface(&mut self) -> Result<&mut SurfaceOverride> {
        self.surface.as_deref_mut().ok_or(Error::NoCollision)
    }
}

impl Deref for Context<'_> {
    type Target = Objects;
    #[inline]
    fn deref(&self) -> &Objects {
        self.simulator
    }
}

impl DerefMut for Context<'_> {
    #[inline]
    fn deref_mut(&mut self) -> &mut Objects {
        self.simulator
    }
}
