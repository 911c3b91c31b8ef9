//! Time scales of single bodies.

use farseer_core::BodyId;

use super::TwoHalfPhysicsSimulator;
use crate::Result;
use crate::depth::{DepthScheme, TimeScale};
use crate::error::{invalid, only_precise, stale};

/// Time scales.
impl TwoHalfPhysicsSimulator {
    /// Time scale of a body, dimensionless: 1 by default; 0 while it is [stopped](Self::stop_time). 1 for a
    /// stale id.
    pub fn time_scale(&self, body: BodyId) -> f32 {
        let pace = self.world.paces.iter().find(|pace| pace.body == body);
        pace.map_or(1.0, TimeScale::scale_now)
    }

    /// Sets the time scale of a body: 1 is normal time, 0 is a stop, else 0.01..=1.
    ///
    /// A free body moves in t seconds along the path of `scale` · t seconds. Its velocities, forces, mass and
    /// gravity are those of its own time: games read and set them between updates, and a change of the scale
    /// keeps them. Other bodies see it `scale` times as fast and 1 / `scale` times as heavy, so its momentum
    /// is unchanged. An impulse changes its own velocity by the same amount at any scale.
    ///
    /// With a scale of 0 the body stops and acts as a [kinematic](crate::TwoHalfBody::set_is_kinematic) one:
    /// others rest on it and bounce off it, and none moves it. Its velocity is kept. Applied impulses and
    /// setters change that velocity; forces have no effect, since no time passes, and contacts give it no
    /// impulse. When its time goes on, its contacts begin anew.
    ///
    /// Characters [walk](Self::walk) in their own time, with inputs in their own time. At a scale of 0 `walk`
    /// does nothing. Callbacks see the body as others do. Static and kinematic bodies have no time scale.
    ///
    /// ```
    /// # use twohalf::{TwoHalfPhysicsSimulator, Vector2, Vector3, farseer_core::BodyFactory};
    /// let mut simulator = TwoHalfPhysicsSimulator::with_gravity(480, Vector2::new(0.0, 900.0))?;
    /// let stone = simulator.create_body(BodyFactory::create_circle_body(10.0, 1.0)?);
    /// simulator.add(stone)?;
    /// simulator.body_mut(stone).unwrap().set_position3d(Vector3::new(0.0, 500.0, 0.0));
    /// simulator.set_time_scale(stone, 0.5)?;
    /// (0..120).for_each(|_| simulator.update(1.0 / 120.0));
    /// // In half a second of its own: 900 / 2 · 0.5².
    /// let stone = simulator.body(stone).unwrap();
    /// assert!((stone.position3d().y - (500.0 - 112.5)).abs() < 0.5);
    /// assert!((stone.velocity3d().y + 450.0).abs() < 0.5);
    /// # Ok::<(), twohalf::Error>(())
    /// ```
    ///
    /// # Errors
    /// A stale body; a scale out of range; another scheme than [`DepthScheme::Precise`].
    pub fn set_time_scale(&mut self, body: BodyId, scale: f32) -> Result<()> {
        if !TimeScale::is_scale(scale) {
            return Err(invalid("scale", scale, "0, or 0.01 to 1"));
        }
        self.time_scale_of(body)?.scale = scale;
        Ok(())
    }

    /// Stops a body for a number of updates, as a [scale](Self::set_time_scale) of 0 does: the hit-stop of
    /// attacker and victim. It replaces the rest of an earlier stop; 0 ends it.
    ///
    /// # Errors
    /// A stale body; another scheme than [`DepthScheme::Precise`].
    pub fn stop_time(&mut self, body: BodyId, updates: u32) -> Result<()> {
        self.time_scale_of(body)?.stops = updates;
        Ok(())
    }

    fn time_scale_of(&mut self, body: BodyId) -> Result<&mut TimeScale> {
        if self.world.scheme != DepthScheme::Precise {
            return Err(only_precise("bodies with a time of their own"));
        }
        self.core.body(body).ok_or(stale("body"))?;
        let paces = &mut self.world.paces;
        let at = paces.iter().position(|pace| pace.body == body).unwrap_or_else(|| {
            paces.push(TimeScale::new(body));
            paces.len() - 1
        });
        Ok(&mut paces[at])
    }
}
