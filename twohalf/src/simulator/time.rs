//! The time of single bodies.

use farseer_core::BodyId;

use super::TwoHalfPhysicsSimulator;
use crate::Result;
use crate::depth::{DepthScheme, Pace};
use crate::error::{invalid, only_precise, stale};

/// Time of single bodies.
impl TwoHalfPhysicsSimulator {
    /// How fast the time of a body passes: 1 as for all others, unless it was set; 0 while it
    /// [stands still](Self::stop_time), and for stale ids 1.
    pub fn time_scale(&self, body: BodyId) -> f32 {
        let pace = self.world.paces.iter().find(|pace| pace.body == body);
        pace.map_or(1.0, Pace::scale_now)
    }

    /// Lets the time of a body pass `scale` times as fast as that of the others: 1 as for them, 0 not at all, else 0.01 to 1.
    ///
    /// Left alone, the body goes in t seconds the way that it would have gone in `scale` · t, with the same places on it. Its
    /// velocities, forces, mass and gravity are those of its own time: they are what is read and set between updates, and stay
    /// what they are when the scale changes. To others it moves `scale` times as fast, and is 1 / `scale` times as heavy,
    /// so that its momentum is what it was: a blow gives it the same velocity of its own at any scale.
    ///
    /// With 0 it stands where it is, as solid as what is [kinematic](crate::TwoHalfBody::set_is_kinematic): others lie on it and bounce
    /// off it, and none moves it. Its velocity waits. Impulses that are applied to it change that, and a velocity may be set; forces do
    /// nothing, for there is no time in which they could, and what touches it gives it nothing. When its time goes on, it meets anew what it touched.
    ///
    /// Figures [walk](Self::walk) in their own time, with the wishes of their own time; called while it stands still, `walk`
    /// does nothing. Callbacks see the body as others do. Static and kinematic bodies have no time of their own.
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
    /// A stale body; a scale that is none of these; another scheme than [`DepthScheme::Precise`].
    pub fn set_time_scale(&mut self, body: BodyId, scale: f32) -> Result<()> {
        if !Pace::is_scale(scale) {
            return Err(invalid("scale", scale, "0, or 0.01 to 1"));
        }
        self.pace_of(body)?.scale = scale;
        Ok(())
    }

    /// Lets a body stand still for so many updates, as a [scale](Self::set_time_scale) of 0 does, and go on by itself: the
    /// hit-stop of whoever strikes and is struck. It replaces what is left of an earlier stop; 0 ends it.
    ///
    /// # Errors
    /// A stale body; another scheme than [`DepthScheme::Precise`].
    pub fn stop_time(&mut self, body: BodyId, updates: u32) -> Result<()> {
        self.pace_of(body)?.stops = updates;
        Ok(())
    }

    fn pace_of(&mut self, body: BodyId) -> Result<&mut Pace> {
        if self.world.scheme != DepthScheme::Precise {
            return Err(only_precise("bodies with a time of their own"));
        }
        self.core.body(body).ok_or(stale("body"))?;
        let paces = &mut self.world.paces;
        let at = paces.iter().position(|pace| pace.body == body).unwrap_or_else(|| {
            paces.push(Pace::new(body));
            paces.len() - 1
        });
        Ok(&mut paces[at])
    }
}
