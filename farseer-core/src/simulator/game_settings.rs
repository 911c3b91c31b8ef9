//! Settings of games that are no part of saves: the speed of hits, and the largest speed.

use super::PhysicsSimulator;
use crate::Result;
use crate::math::finite::zero_or_more;
use farseer_precise::reusing_clone;

/// Settings that are not saved.
#[derive(Debug, Default)]
pub(super) struct GameSettings {
    /// Least speed of a hit, in length units/s; `None`: one length unit of the methods per second.
    hit_speed: Option<f32>,
}

reusing_clone! { GameSettings { hit_speed } }

impl PhysicsSimulator {
    /// Becomes a loaded simulator, with the present settings that saves do not have.
    pub(crate) fn replace_by(&mut self, loaded: PhysicsSimulator) {
        let game_settings = std::mem::take(&mut self.game_settings);
        *self = PhysicsSimulator { game_settings, ..loaded };
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
