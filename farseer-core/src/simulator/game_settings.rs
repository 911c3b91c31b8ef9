//! Settings of games that are no part of saves: the speed of hits, and the largest speed.

use super::PhysicsSimulator;
use crate::Result;
use crate::math::finite::{positive, zero_or_more};
use farseer_precise::reusing_clone;

/// Settings that are not saved.
#[derive(Debug, Default)]
pub(super) struct GameSettings {
    /// Least speed of a hit, in length units/s; `None`: one length unit of the methods per second.
    hit_speed: Option<f32>,
    /// Largest speed of a body, in length units/s; `None`: none.
    largest_speed: Option<f32>,
}

reusing_clone! { GameSettings { hit_speed, largest_speed } }

impl GameSettings {
    /// Largest speed of a body, in length units/s; `None`: none.
    #[cfg(feature = "precise")]
    pub(super) fn largest_speed(&self) -> Option<f32> {
        self.largest_speed
    }
}

impl PhysicsSimulator {
    /// Becomes a loaded simulator, with the present settings that saves do not have.
    pub(crate) fn replace_by(&mut self, loaded: PhysicsSimulator) {
        let game_settings = std::mem::take(&mut self.game_settings);
        *self = PhysicsSimulator { game_settings, ..loaded };
    }

    /// Largest speed of dynamic bodies, in length units/s; `None`, the default, if there is none.
    pub fn largest_speed(&self) -> Option<f32> {
        self.game_settings.largest_speed
    }

    /// Sets the largest speed of dynamic bodies. Each update scales the velocities, after forces and impulses of the game, that
    /// would be greater; contacts and joints may exceed it until the next update. Only with the [precise
    /// set](crate::Methods::Precise). As [limits](crate::Objects::set_limits), it is not saved: [`restore`](Self::restore) keeps
    /// it, and the replay of a [`Recording`](crate::Recording) begins without it.
    ///
    /// ```
    /// use farseer_core::{BodyBuilder, GeomBuilder, PhysicsSimulator};
    /// let mut simulator = PhysicsSimulator::precise([0.0, 300.0])?;
    /// simulator.set_largest_speed(Some(100.0))?;
    /// let (ball, _) = simulator.add_body(BodyBuilder::dynamic(), [GeomBuilder::circle(10.0)])?;
    /// (0..120).for_each(|_| simulator.update(1.0 / 60.0));
    /// assert!((simulator[ball].linear_velocity().y - 100.0).abs() < 0.01);
    /// # Ok::<(), farseer_core::Error>(())
    /// ```
    ///
    /// # Errors
    /// A speed that is not finite and greater than 0; [`Error::NotSupported`](crate::Error::NotSupported) under the faithful
    /// methods.
    pub fn set_largest_speed(&mut self, speed: Option<f32>) -> Result<()> {
        if let Some(speed) = speed {
            self.objects.methods.only_precise("largest speed")?;
            positive("speed", speed)?;
        }
        self.game_settings.largest_speed = speed;
        Ok(())
    }

    /// Speed in length units/s above which a touch is a [hit](Self::hits). Default: one length unit of the
    /// [methods](Self::methods) per second, 32 px/s for games in px.
    pub fn hit_speed(&self) -> f32 {
        let default = || self.objects.methods.length_unit().unwrap_or(0.0);
        self.game_settings.hit_speed.unwrap_or_else(default)
    }

    /// Sets [`hit_speed`](Self::hit_speed). As [limits](crate::Objects::set_limits), it is not saved:
    /// [`restore`](Self::restore) keeps it.
    ///
    /// # Errors
    /// A speed that is not finite, or less than 0.
    pub fn set_hit_speed(&mut self, speed: f32) -> Result<()> {
        self.game_settings.hit_speed = Some(zero_or_more("speed", speed)?);
        Ok(())
    }
}
