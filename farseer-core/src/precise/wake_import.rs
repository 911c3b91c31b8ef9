//! Adapter: waking by the objects of the game. It finds the sleeping bodies that forces, springs, controllers or moving kinematic
//! bodies concern, and requests that they wake.

use super::ids::IdTable;
use crate::body::BodyId;
use crate::controllers::ControllerKind;
use crate::objects::Objects;
use farseer_precise::bodies::BodySet;
use farseer_precise::depth::feature_gate::FeatureGate;
use farseer_precise::depth::state::DepthState;
use farseer_precise::index::BodyIndex;
use farseer_precise::island::sleep::SleepState;
use farseer_precise::parameters::sleep::{REMEASURED_FORCE_MAX_CHANGE, TIME_TO_SLEEP};

/// Returns the indices of the bodies at both ends of each enabled spring. Index 0 stands for the world.
pub(super) fn spring_body_pairs<'a>(
    ids: &'a IdTable,
    objects: &'a Objects,
) -> impl Iterator<Item = [BodyIndex; 2]> + Clone + 'a {
    let springs = (0..objects.springs.list().len()).filter_map(|at| objects.springs.at(at));
    let number =
        |body: Option<BodyId>| body.and_then(|id| ids.body_index(id)).unwrap_or(BodyIndex::PLACEHOLDER);
    springs.filter(|(_, spring)| spring.enabled()).map(move |(_, spring)| spring.ends().map(number))
}

/// Parts that tell which kinematic bodies will move in this step.
pub(super) struct KinematicMotion<'a> {
    pub(super) bodies: &'a BodySet,
    pub(super) ids: &'a IdTable,
    pub(super) depth: Option<FeatureGate<&'a DepthState>>,
    pub(super) objects: &'a Objects,
}

impl KinematicMotion<'_> {
    /// Returns the indices of the kinematic bodies, and moving boxes of `twohalf`, that will move in this step.
    pub(super) fn moving_bodies(&self) -> impl Iterator<Item = BodyIndex> + '_ {
        let kinematic = self.bodies.kinematic.iter().copied();
        kinematic.filter(|&body| self.will_move(body, self.ids.bodies[body]))
    }

    /// Returns whether a kinematic body, or a moving box of `twohalf`, will move in this step. `id` is `None` for a box.
    fn will_move(&self, body_index: BodyIndex, id: Option<BodyId>) -> bool {
        let body = id.and_then(|id| self.objects.bodies.get(id));
        body.is_some_and(|entry| entry.body.will_move())
            || self.depth.is_some_and(|space| match id {
                Some(id) => space.is_kinematic_moving(id.slot()),
                None => space.is_world_box_moving(body_index),
            })
    }

    /// Requests that sleeping bodies wake which a spring connects to a kinematic body that will move in this step.
    pub(super) fn wake_at_springs(&self, sleep: &mut SleepState) {
        let springs = &self.objects.springs;
        for at in 0..springs.list().len() {
            let Some((_, spring)) = springs.at(at).filter(|(_, spring)| spring.enabled()) else { continue };
            let ends = spring.ends().map(|end| end.and_then(|id| Some((self.ids.body_index(id)?, id))));
            let moves = |&(body, id): &(BodyIndex, BodyId)| {
                self.bodies.is_kinematic(body) && self.will_move(body, Some(id))
            };
            if ends.iter().flatten().any(moves) {
                ends.into_iter().flatten().for_each(|(number, _)| sleep.request_wake(number));
            }
        }
    }
}

/// Parts of the comparison of the forces on sleeping bodies with those that the bodies fell asleep under.
pub(super) struct ForceComparison<'a> {
    pub(super) bodies: &'a BodySet,
    pub(super) ids: &'a IdTable,
    pub(super) sleep: &'a mut SleepState,
    pub(super) depth: Option<&'a mut DepthState>,
    /// In the user's unit of length, > 0.
    pub(super) length_unit: f32,
}

impl ForceComparison<'_> {
    /// Requests that sleeping bodies wake whose forces differ from those that they fell asleep under. Clears the forces of all
    /// others.
    ///
    /// The tolerance is an acceleration that would not exceed the sleep speed within [`TIME_TO_SLEEP`].
    pub(super) fn wake_unless_unchanged(&mut self, objects: &mut Objects) {
        let mut forced_bodies = std::mem::take(&mut self.sleep.forced_bodies);
        self.collect_forced_bodies(objects, &mut forced_bodies);
        forced_bodies.sort_unstable();
        forced_bodies.dedup();
        forced_bodies.retain(|&body| self.sleep.is_asleep(body));
        self.remeasure_forces(objects);
        let tolerance = match forced_bodies.is_empty() {
            true => 0.0,
            false => self.sleep.sleep_speed(self.length_unit) / TIME_TO_SLEEP,
        };
        for body in forced_bodies.drain(..) {
            let ([x, y, turning, z], reach) =
                (self.sleep.supported_acceleration[body], self.bodies.max_extents[body]);
            let Some(id) = self.ids.bodies[body] else { continue };
            let Some(entry) = objects.bodies.get_mut(id) else { continue };
            let in_depth = self.depth.as_ref().map_or(0.0, |space| (space.acceleration(id.slot()) - z).abs());
            if in_depth > tolerance
                || !entry.body.take_unchanged_forces([x, y, turning], reach, tolerance - in_depth)
            {
                self.sleep.request_wake(body);
            } else if let Some(space) = &mut self.depth {
                space.clear_acceleration(id.slot());
            }
        }
        self.sleep.forced_bodies = forced_bodies;
    }

    /// Measures the forces on bodies that fell asleep in the last step again, and stores them as supported accelerations.
    ///
    /// A damped spring exerts another force on a body at velocity 0. If a component has changed by more than
    /// [`REMEASURED_FORCE_MAX_CHANGE`], the stored accelerations stay.
    fn remeasure_forces(&mut self, objects: &Objects) {
        let mut newly_asleep = std::mem::take(&mut self.sleep.newly_asleep);
        for body in newly_asleep.drain(..) {
            let Some(id) = self.ids.bodies[body] else { continue };
            let Some(entry) = objects.bodies.get(id) else { continue };
            let ([x, y, turning], before) =
                (entry.body.pending_accelerations(), self.sleep.supported_acceleration[body]);
            let now = [x, y, turning, self.depth.as_ref().map_or(0.0, |space| space.acceleration(id.slot()))];
            let is_near =
                |at: usize| (now[at] - before[at]).abs() <= REMEASURED_FORCE_MAX_CHANGE * before[at].abs();
            if (0..4).all(is_near) {
                self.sleep.supported_acceleration[body] = now;
            }
        }
        self.sleep.newly_asleep = newly_asleep;
    }

    /// Appends to `forced_bodies` the indices of sleeping bodies that springs or controllers may act on, and of bodies that
    /// fell asleep under forces.
    fn collect_forced_bodies(&self, objects: &Objects, forced_bodies: &mut Vec<BodyIndex>) {
        forced_bodies.extend_from_slice(&self.sleep.loaded_bodies);
        let mut record = |body: Option<BodyId>| {
            let number = body.and_then(|body| self.ids.body_index(body));
            forced_bodies.extend(number.filter(|&number| self.sleep.is_asleep(number)));
        };
        for (_, spring) in (0..objects.springs.list().len()).filter_map(|at| objects.springs.at(at)) {
            spring.ends().into_iter().for_each(&mut record);
        }
        let controllers = &objects.controllers;
        for (_, controller) in (0..controllers.list().len()).filter_map(|at| controllers.at(at)) {
            match controller.kind() {
                ControllerKind::FluidDrag(drag) => {
                    drag.geoms().for_each(|geom| record(objects.geoms.get(geom).map(|geom| geom.body)));
                }
                // A gravity controller acts on all bodies.
                ControllerKind::Gravity(_) => {
                    objects.bodies.list().iter().for_each(|&body| record(Some(body)))
                }
                _ => {}
            }
        }
    }
}
