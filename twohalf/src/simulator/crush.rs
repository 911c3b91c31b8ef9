//! Queries and events of crushed bodies.

use farseer_core::BodyId;

use super::TwoHalfPhysicsSimulator;
use crate::Result;
use crate::depth::{CrushMonitor, DepthScheme};
use crate::error::{invalid, only_precise, stale};
use crate::views::{CrushInfo, crush_info};

/// Crushing.
impl TwoHalfPhysicsSimulator {
    /// The crush of a body at the end of the last update: on the axis with the greatest lack of room between
    /// two sides that both push the body. `None` without two such sides, and for stale ids.
    ///
    /// A side is any contact that acts along an axis more than across it: ground, platforms, bodies, at rest
    /// or moving. Resting contacts lack some hundredths of a px. Sides that go on closing, such as a lift
    /// below a ceiling, leave less room in every update, at any length of step.
    pub fn crush_info(&self, body: BodyId) -> Option<CrushInfo> {
        crush_info(&self.core, &self.world, body)
    }

    /// The former name of [`crush_info`](Self::crush_info).
    #[deprecated(since = "0.2.0", note = "renamed to crush_info")]
    pub fn squeeze(&self, body: BodyId) -> Option<CrushInfo> {
        self.crush_info(body)
    }

    /// Makes [`Event::Crushed`](crate::Event::Crushed) report a body that lacks more than `tolerance` px of
    /// room, in the first update in which it does. It reports again after the body had room. `None`, the
    /// default, ends it.
    ///
    /// The event is all: the game decides the effect of a crush.
    ///
    /// ```
    /// # use twohalf::{Event, Platform, TwoHalfPhysicsSimulator, Vector2, Vector3};
    /// # use twohalf::farseer_core::{BodyFactory, GeomPlacement, Vertices};
    /// # let mut simulator = TwoHalfPhysicsSimulator::with_gravity(480, Vector2::new(0.0, 900.0))?;
    /// # let body = simulator.create_body(BodyFactory::create_rectangle_body(20.0, 50.0, 1.0)?);
    /// # let geom = simulator.create_geom(body, Vertices::create_rectangle(20.0, 50.0)?, GeomPlacement::default())?;
    /// # simulator.add(body)?;
    /// # simulator.add(geom)?;
    /// # simulator.body_mut(body).unwrap().ground_mut().set_object_geom(geom, None)?;
    /// // A press comes down on a body.
    /// let press = Platform::new(&mut simulator, 80.0, 20.0, 100.0, Vector3::new(0.0, 60.0, 0.0), None)?;
    /// simulator.platform_mut(press).unwrap().set_velocity(Vector3::new(0.0, -30.0, 0.0))?;
    /// simulator.set_crush_tolerance(body, Some(5.0))?;
    /// let mut told = Vec::new();
    /// for update in 0..120_i32 {
    ///     simulator.update(1.0 / 60.0);
    ///     if simulator.events().iter().any(|event| matches!(event, Event::Crushed { .. })) {
    ///         told.push(update);
    ///     }
    /// }
    /// // Once: 15 px of way, at 30 px/s.
    /// assert!(told.len() == 1 && told[0].abs_diff(30) <= 1, "{told:?}");
    /// # Ok::<(), twohalf::Error>(())
    /// ```
    ///
    /// # Errors
    /// A stale body; a tolerance that is not finite and 0 or more; another scheme than [`DepthScheme::Precise`].
    pub fn set_crush_tolerance(&mut self, body: BodyId, tolerance: Option<f32>) -> Result<()> {
        if self.world.scheme != DepthScheme::Precise {
            return Err(only_precise("crushing that is told"));
        }
        self.core.body(body).ok_or(stale("body"))?;
        if let Some(tolerance) = tolerance.filter(|it| !(it.is_finite() && *it >= 0.0)) {
            return Err(invalid("tolerance", tolerance, "finite and 0 or more"));
        }
        let watches = &mut self.world.crush_watches;
        let known = watches.iter_mut().find(|watch| watch.body == body);
        match (known, tolerance) {
            (Some(watch), Some(tolerance)) => watch.tolerance = tolerance,
            (None, Some(tolerance)) => watches.push(CrushMonitor { body, tolerance, is_crushed: false }),
            (_, None) => watches.retain(|watch| watch.body != body),
        }
        Ok(())
    }

    /// Tolerance of the crush event for a body, px; `None` if it is off.
    pub fn crush_tolerance(&self, body: BodyId) -> Option<f32> {
        let watch = self.world.crush_watches.iter().find(|watch| watch.body == body);
        watch.map(|watch| watch.tolerance)
    }
}
