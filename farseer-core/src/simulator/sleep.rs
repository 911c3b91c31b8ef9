//! What hangs together and sleeps, and why something does not.

use super::PhysicsSimulator;
use crate::body::BodyId;
use crate::precise::{Island, IslandResidual, WhyAwake};

/// Sleep. Only with the [precise set](crate::Methods::Precise), which says when things fall asleep and wake.
impl PhysicsSimulator {
    /// Whether a body sleeps: it is at rest, with everything that it hangs together with, and costs nothing until something
    /// wakes it. False for stale ids.
    ///
    /// ```
    /// use farseer_core::{BodyFactory, GeomFactory, GeomPlacement, Methods, PhysicsSimulator, math::Vector2};
    ///
    /// let mut simulator = PhysicsSimulator::new(Vector2::new(0.0, 300.0))?;
    /// simulator.set_methods(Methods::PRECISE)?;
    /// let floor = BodyFactory::create_rectangle_body_in(&mut simulator, 400.0, 20.0, 1.0)?;
    /// simulator[floor].set_is_static(true);
    /// simulator[floor].set_position(Vector2::new(0.0, 30.0));
    /// GeomFactory::create_rectangle_geom_in(&mut simulator, floor, 400.0, 20.0, GeomPlacement::default())?;
    /// let crate_ = BodyFactory::create_rectangle_body_in(&mut simulator, 32.0, 32.0, 1.0)?;
    /// GeomFactory::create_rectangle_geom_in(&mut simulator, crate_, 32.0, 32.0, GeomPlacement::default())?;
    /// (0..240).for_each(|_| simulator.update(1.0 / 60.0));
    /// assert!(simulator.is_asleep(crate_));
    /// simulator[crate_].apply_impulse(Vector2::new(50.0, 0.0));
    /// simulator.update(1.0 / 60.0);
    /// assert!(!simulator.is_asleep(crate_));
    /// # Ok::<(), farseer_core::Error>(())
    /// ```
    pub fn is_asleep(&self, body: BodyId) -> bool {
        self.pipeline.precise.as_ref().is_some_and(|precise| precise.is_asleep(body))
    }

    /// Why a body is awake, as it was at the end of the last update; `None` for one that sleeps, and for stale ids.
    pub fn why_awake(&self, body: BodyId) -> Option<WhyAwake> {
        self.objects.body(body)?;
        let Some(precise) = self.pipeline.precise.as_ref().filter(|_| self.settings.is_sleep_enabled) else {
            return Some(WhyAwake::NothingSleeps);
        };
        if precise.is_asleep(body) {
            return None;
        }
        Some(precise.why_awake(body, &self.objects).unwrap_or(WhyAwake::NeverSleeps))
    }

    /// The islands of bodies that can be pushed and hang together by contacts, joints or springs, as they were at the end of
    /// the last update: first those that are awake, then those that sleep, each in the order of their first bodies. Found anew
    /// with each call. None with the faithful set. What was loaded knows no joints, nor what its last update took, until the
    /// next one.
    pub fn islands(&self) -> Vec<Island> {
        self.pipeline.precise.as_ref().map_or_else(Vec::new, |precise| precise.islands(&self.objects))
    }

    /// What is left of an island's error after the last update: found anew from outlines, velocities and anchors with each
    /// call, whatever the solver believes. Nothing of bodies that are not there any more; nothing with the faithful set.
    pub fn island_residual(&self, island: &Island) -> IslandResidual {
        let precise = self.pipeline.precise.as_ref();
        precise.map_or_else(Default::default, |precise| precise.residual(&island.bodies, &self.objects))
    }

    /// How many pairs of convex pieces that touch are solved in each colour: no two of a colour push the same body, so that
    /// they can be solved side by side, but for those of the 32nd, which found no other. Those of islands that are
    /// [solved as a whole](Island::is_solved_whole) have none. None with the faithful set.
    pub fn rows_per_colour(&self) -> Vec<usize> {
        self.pipeline.precise.as_ref().map_or_else(Vec::new, |precise| precise.rows_per_colour())
    }

    /// Wakes a body in the next update, with all that fell asleep together with it. Nothing happens to one that is awake, or to
    /// stale ids.
    pub fn wake(&mut self, body: BodyId) {
        if let Some(precise) = &mut self.pipeline.precise {
            precise.wake(body);
        }
    }
}
