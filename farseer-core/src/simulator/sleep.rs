//! Islands, sleep, and reasons why bodies are awake.

use super::PhysicsSimulator;
use crate::body::{Body, BodyId};
use crate::report::{AwakeReason, Island};
use farseer_precise::island_report::IslandResidual;

/// Sleeping and islands. Only with the [precise set](crate::Methods::Precise), where the conditions of sleep are
/// documented.
impl PhysicsSimulator {
    /// Whether a body sleeps: it has come to rest together with its island, and costs no time until it is woken. False
    /// for stale ids.
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

    /// The reason why a body was awake at the end of the last update; `None` for a sleeping body, and for stale ids.
    pub fn why_awake(&self, body: BodyId) -> Option<AwakeReason> {
        self.objects.body(body)?;
        let Some(precise) = self.pipeline.precise.as_ref().filter(|_| self.settings.is_sleep_enabled) else {
            return Some(AwakeReason::SleepDisabled);
        };
        if precise.is_asleep(body) {
            return None;
        }
        Some(precise.why_awake(body, &self.objects).unwrap_or(AwakeReason::NeverSleeps))
    }

    /// The islands at the end of the last update: dynamic bodies connected by contacts, joints or springs. First those
    /// that are awake, then sleeping ones, each in the order of their first bodies. Computed in each call. None with
    /// the faithful set. In a loaded simulator joints, and the costs of the last update, are missing until the next
    /// one.
    pub fn islands(&self) -> Vec<Island> {
        self.pipeline.precise.as_ref().map_or_else(Vec::new, |precise| precise.islands(&self.objects))
    }

    /// The residual error of an island after the last update. Each call computes it from outlines, velocities and
    /// anchors, independent of the solver. Bodies that do not exist any more do not count; zero with the faithful set.
    pub fn island_residual(&self, island: &Island) -> IslandResidual {
        let precise = self.pipeline.precise.as_ref();
        precise.map_or_else(Default::default, |precise| precise.residual(&island.bodies, &self.objects))
    }

    /// Number of touching pairs of convex pieces in each graph colour. No two pairs of a colour share a dynamic body,
    /// so that they can be solved in parallel; the 32nd is the overflow colour. Pairs of islands with the [direct
    /// solver](Island::is_solved_whole) have no colour. None with the faithful set.
    pub fn rows_per_colour(&self) -> Vec<usize> {
        self.pipeline.precise.as_ref().map_or_else(Vec::new, |precise| precise.constraints_per_color())
    }

    /// Puts a body to sleep at the end of the next update, with all bodies that contacts, joints or springs connect with it
    /// now. They stop where they are, and no force acts on them in that update. Bodies that do not allow it, or that touch a
    /// moving one then, stay awake. No effect on bodies that sleep, on static and kinematic ones, and on stale ids.
    ///
    /// ```
    /// use farseer_core::{BodyBuilder, GeomBuilder, PhysicsSimulator};
    /// let mut simulator = PhysicsSimulator::precise([0.0, 300.0])?;
    /// let (ball, _) = simulator.add_body(BodyBuilder::dynamic(), [GeomBuilder::circle(10.0)])?;
    /// (0..30).for_each(|_| simulator.update(1.0 / 60.0));
    /// simulator.sleep(ball);
    /// simulator.update(1.0 / 60.0);
    /// assert!(simulator.is_asleep(ball), "in mid-air");
    /// # Ok::<(), farseer_core::Error>(())
    /// ```
    pub fn sleep(&mut self, body: BodyId) {
        let can_sleep = |body: &&Body| body.is_integrated() && !body.is_kinematic();
        if self.pipeline.precise.is_none()
            || self.is_asleep(body)
            || self.objects.body(body).filter(can_sleep).is_none()
        {
            return;
        }
        let island = self.islands().into_iter().find(|island| island.bodies.contains(&body));
        let members = island.map_or_else(|| vec![body], |island| island.bodies);
        for member in members {
            if let Some(member) = self.objects.body_mut(member) {
                member.set_sleep_requested(true);
            }
        }
    }

    /// Wakes a body in the next update, with all bodies that fell asleep together with it. No effect on bodies that are
    /// awake, and on stale ids.
    pub fn wake(&mut self, body: BodyId) {
        if let Some(precise) = &mut self.pipeline.precise {
            precise.wake(body);
        }
    }
}
