//! What a callback sees of the simulator that calls it.

use std::ops::{Deref, DerefMut};

use super::PhysicsSimulator;
use crate::geom::surface::SetSurface;
use crate::math::finite::{finite, zero_or_more};
use crate::objects::Objects;
use crate::{Error, Result};

/// What a callback may do to the simulator that calls it: everything that [`Objects`] offers, at once. What it adds,
/// removes or disposes enters or leaves with the next update.
#[derive(Debug)]
pub struct Context<'a> {
    pub(super) simulator: &'a mut PhysicsSimulator,
    /// What is set about the two geoms of a collision, while a handler is asked about it.
    pub(super) surface: Option<&'a mut SetSurface>,
}

impl Context<'_> {
    /// The same for a shorter time: for engines that hand it on inside a context of their own.
    pub fn reborrow(&mut self) -> Context<'_> {
        Context { simulator: self.simulator, surface: self.surface.as_deref_mut() }
    }

    /// The same while a handler is asked about a collision.
    pub(super) fn with_surface<'s>(&'s mut self, surface: &'s mut SetSurface) -> Context<'s> {
        Context { simulator: self.simulator, surface: Some(surface) }
    }

    /// The simulator, to look at everything and to ask its queries. In the middle of an update it shows what the
    /// stages have done so far.
    pub fn simulator(&self) -> &PhysicsSimulator {
        self.simulator
    }

    /// For engines with depth, which tell of edits at once.
    #[doc(hidden)]
    pub fn simulator_mut(&mut self) -> &mut PhysicsSimulator {
        self.simulator
    }
}

/// How a collision goes: what a handler may set in [`on_collision`](crate::EventHandler::on_collision), for all contacts of
/// the two geoms and this update alone. What is not set is what the geoms' coefficients come to. The side that is asked
/// later may set it again, and the last value counts. Not in the original.
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
    /// Sets the friction between the two geoms, 0 or more: this is not mixed with anything.
    ///
    /// # Errors
    /// A number that is not finite or less than 0; [`Error::NoCollision`] in any other callback.
    pub fn set_contact_friction(&mut self, friction: f32) -> Result<()> {
        let friction = zero_or_more("friction", friction)?;
        self.surface()?.friction = Some(friction);
        Ok(())
    }

    /// Sets the restitution between the two geoms, 0 or more: the part of the speed of approach with which they part. This
    /// is not mixed with anything.
    ///
    /// # Errors
    /// As [`set_contact_friction`](Self::set_contact_friction).
    pub fn set_contact_restitution(&mut self, restitution: f32) -> Result<()> {
        let restitution = zero_or_more("restitution", restitution)?;
        self.surface()?.restitution = Some(restitution);
        Ok(())
    }

    /// Sets the speed, in length units per second, at which friction lets the two slide along each other: that of geom B
    /// against geom A along `(normal.y, -normal.x)` of their contacts, which is the same whoever is A. So with y down, as on
    /// a screen, what lies on a floor is carried to the left by a positive speed; with y up to the right. It comes
    /// to what bodies do themselves, static ones with a velocity included. Usually 0, and without friction nothing.
    ///
    /// # Errors
    /// A number that is not finite; [`Error::NoCollision`] in any other callback.
    pub fn set_contact_tangent_speed(&mut self, tangent_speed: f32) -> Result<()> {
        let tangent_speed = finite("tangent_speed", tangent_speed)?;
        self.surface()?.tangent_speed = Some(tangent_speed);
        Ok(())
    }

    fn surface(&mut self) -> Result<&mut SetSurface> {
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
