//! The update with the precise set: its stages, and the callbacks between them.

use super::PhysicsSimulator;
use super::callbacks::Handler;
use crate::contacts::contact::Contact;
use crate::geom::GeomId;
use crate::geom::filter::{Filter, is_valid_pair};
use crate::geom::sensor_pairs::may_keep_touching;
use crate::objects::Objects;
use crate::precise::candidate_pairs::has_plain_filters;
use crate::precise::contact_events::TouchChange;
use crate::precise::separated_bodies::separate_joined_bodies;
use crate::precise::skip_step::StepSettings;
use crate::precise::{Precise, StepContext};
use crate::report::{Event, Stopwatch};
use crate::springs::StepLengths;
use farseer_precise::surface::SurfaceOverride;

impl PhysicsSimulator {
    /// The state of the precise set, while it is chosen.
    fn precise_engine(&mut self) -> &mut Precise {
        self.pipeline.precise.as_mut().expect("the precise set is chosen")
    }

    /// Runs an update. Returns false if it was skipped because all bodies sleep and nothing acts on them.
    pub(super) fn step_precise(
        &mut self,
        dt: f32,
        dt_real: f32,
        handler: &mut Handler<'_>,
        stopwatch: &mut Stopwatch<'_>,
    ) -> bool {
        let substeps =
            u32::try_from(self.settings.iterations).unwrap_or(0).min(self.limits().iterations).max(1);
        let gravity = self.settings.gravity;
        let may_sleep = self.settings.is_sleep_enabled;
        let choice = self.settings.island_choice;
        self.precise_engine().solver.set_solver_choice(choice);
        if self.try_skip_step(dt, substeps, handler) {
            return false;
        }
        self.precise_engine().is_stepping = true;
        let steps = StepLengths { before: self.precise_engine().solver.dt, now: dt };
        let step = self.precise_engine().begin_step(dt, substeps, gravity, may_sleep);
        if let Some(precise) = &mut self.pipeline.precise {
            precise.begin_kinematic(&self.objects);
        }
        self.report.counters.aabbs_renewed = self.precise_engine().refitted_count();
        let found = self.precise_engine().solver.find_pairs();
        self.add_precise_pairs(found, handler);
        stopwatch.lap(|times| &mut times.broad_phase_collision_time);
        let friction = self.settings.friction_type;
        let max_contacts = self.max_manifold_contacts();
        self.report.counters.pairs_tested = self.precise_engine().find_contacts(friction, max_contacts);
        let stats = self.precise_engine().narrow_phase_stats();
        (self.report.counters.manifolds_made, self.report.counters.manifolds_kept) =
            (stats.computed, stats.recycled);
        if self.precise_engine().has_depth() {
            self.report.counters.pairs_touching = self.precise_engine().touching_count();
            #[cfg(feature = "space")]
            self.ask_about_depth_contacts(handler);
        } else {
            if handler.wants(|handler| handler.filters_pairs()) {
                self.filter_precise_pairs(handler);
            }
            self.report_contact_events(handler);
            self.report_hits();
        }
        stopwatch.lap(|times| &mut times.narrow_phase_collision_time);
        self.update_controllers(dt, dt_real, handler);
        self.update_springs(Some(steps), handler);
        self.import_edits();
        self.wake_disturbed();
        self.break_precise_joints(handler);
        self.load_bodies_and_joints(&step);
        stopwatch.lap(|times| &mut times.apply_forces_time);
        self.precise_engine().solver.solve(&step);
        if self.precise_engine().solver.find_fast_bodies() {
            let found = self.precise_engine().solver.find_pairs_of_fast_bodies();
            self.add_precise_pairs(found, handler);
            if self.precise_engine().solver.clamp_to_toi(&step) {
                let found = self.precise_engine().solver.find_pairs_of_fast_bodies();
                self.add_precise_pairs(found, handler);
                self.precise_engine().solver.clamp_carried_motion();
            }
        }
        self.report.counters.passes = substeps;
        stopwatch.lap(|times| &mut times.apply_impulses_time);
        self.store_bodies(handler);
        self.report_sensor_passthroughs(handler);
        self.update_sleep(&step);
        self.precise_engine().is_stepping = false;
        stopwatch.lap(|times| &mut times.update_positions_time);
        true
    }

    /// Skips an update in which no state can change; returns whether it did.
    fn try_skip_step(&mut self, dt: f32, substeps: u32, handler: &mut Handler<'_>) -> bool {
        let Objects { springs, controllers, .. } = &self.objects;
        if handler.get().is_some() || !springs.list().is_empty() || !controllers.list().is_empty() {
            return false;
        }
        let settings = StepSettings {
            dt,
            substeps,
            gravity: self.settings.gravity,
            may_sleep: self.settings.is_sleep_enabled,
            friction: self.settings.friction_type,
            max_contacts: self.max_manifold_contacts(),
        };
        let precise = self.precise_engine();
        if !precise.try_skip_step(&settings) {
            return false;
        }
        let (touching, asleep) = (precise.touching_count(), precise.solver.asleep_count());
        let counters = &mut self.report.counters;
        (counters.pairs_touching, counters.bodies_asleep, counters.passes) = (touching, asleep, substeps);
        true
    }

    /// Maximum number of contacts of two convex pieces; a negative number of contacts to detect is no limit.
    fn max_manifold_contacts(&self) -> u32 {
        let to_detect = u32::try_from(self.settings.max_contacts_to_detect).unwrap_or(2);
        let to_resolve = u32::try_from(self.settings.max_contacts_to_resolve).unwrap_or(2);
        to_detect.min(to_resolve).min(2)
    }

    /// Imports edited objects into the precise set, if it is chosen.
    pub(super) fn import_edits(&mut self) {
        let PhysicsSimulator { objects, pipeline, .. } = self;
        if let Some(precise) = &mut pipeline.precise {
            if std::mem::take(&mut objects.has_new_members) {
                precise.edits.mark_membership_changed(&mut objects.new_members);
            }
            if std::mem::take(&mut objects.has_new_structure) {
                precise.edits.mark_stale();
            }
            if std::mem::take(&mut objects.has_edited_joints) {
                precise.invalidate_joints();
            }
            if std::mem::take(&mut objects.has_edited_drives) {
                precise.wake_for_edited_drives(objects);
            }
            precise.import_edits(objects);
            separate_joined_bodies(precise, objects);
        }
        objects.new_members.clear();
    }

    fn wake_disturbed(&mut self) {
        let PhysicsSimulator { objects, pipeline, .. } = self;
        if let Some(precise) = &mut pipeline.precise {
            precise.wake_disturbed(objects);
        }
    }

    fn update_sleep(&mut self, step: &StepContext) {
        let PhysicsSimulator { objects, pipeline, report, .. } = self;
        if let Some(precise) = &mut pipeline.precise {
            precise.fall_asleep(objects, step);
            precise.report_sleep_events(objects, &mut report.events);
            report.counters.bodies_asleep = precise.solver.asleep_count();
        }
    }

    fn load_bodies_and_joints(&mut self, step: &StepContext) {
        let PhysicsSimulator { objects, pipeline, report, settings, game_settings, .. } = self;
        if let Some(precise) = &mut pipeline.precise {
            precise.read_bodies(objects, settings.gravity, step, report);
            precise.stop_requested(objects);
            if let Some(largest) = game_settings.largest_speed() {
                precise.limit_speeds(largest, step);
            }
            precise.import_joints(objects, step);
            report.counters.contacts_solved = precise.contacts_solved();
        }
    }

    /// Breaks joints whose error is beyond their breakpoint, before they act.
    fn break_precise_joints(&mut self, handler: &mut Handler<'_>) {
        if !self.precise_engine().may_break_joints() {
            return;
        }
        let mut has_told = false;
        for position in 0..self.joint_list().len() {
            let PhysicsSimulator { objects, pipeline, .. } = self;
            let (Some(precise), Some((joint, kept_joint))) =
                (&pipeline.precise, objects.joints.at_mut(position))
            else {
                continue;
            };
            if kept_joint.breakpoint() == f32::MAX || !kept_joint.enabled() {
                continue;
            }
            let Some(error) = precise.joint_import(&objects.bodies).joint_error(kept_joint) else { continue };
            kept_joint.set_error(error);
            if kept_joint.breaks() {
                objects.has_edited_joints = true;
                self.report.push(Event::JointBroke { joint });
                self.call_handler(handler, |handler, context| handler.on_joint_broke(context, joint));
                has_told = true;
            }
        }
        if has_told {
            self.import_edits();
        }
    }

    /// Stores the forces of joints, and reports those that broke.
    fn store_joint_forces(&mut self, handler: &mut Handler<'_>) {
        let PhysicsSimulator { objects, pipeline, report, .. } = self;
        let Some(precise) = &mut pipeline.precise else { return };
        let broken = report.events.len();
        precise.export_joints(objects, report);
        if handler.get().is_none() {
            return;
        }
        for at in broken..self.report.events.len() {
            if let Event::JointBroke { joint } = self.report.events[at] {
                self.call_handler(handler, |handler, context| handler.on_joint_broke(context, joint));
            }
        }
        let mut at = 0;
        while handler.wants(|handler| handler.handles_joint_updates())
            && let Some(joint) = self.precise_engine().joint_at(at)
        {
            self.call_handler(handler, |handler, context| handler.on_joint_updated(context, joint));
            at += 1;
        }
    }

    /// Adds new pairs that filters and the handler accept.
    fn add_precise_pairs(&mut self, found: usize, handler: &mut Handler<'_>) {
        let asks_about_new = handler.wants(|handler| handler.handles_broad_phase());
        let is_in_space = self.precise_engine().has_depth();
        // The geoms and bodies of a pair are read only where their proxies do not tell enough: they are large.
        let has_edits = has_unimported_edits(&self.objects) || !self.precise_engine().edits.is_empty();
        let trusts_proxies = handler.get().is_none() && !is_in_space && !has_edits;
        for at in 0..found {
            let PhysicsSimulator { objects, pipeline, .. } = &mut *self;
            let is_plain = |precise: &Precise| has_plain_filters(precise, at, &objects.separated_bodies);
            if trusts_proxies && pipeline.precise.as_deref().is_some_and(is_plain) {
                debug_assert!(self.may_be_new_pair(at), "the proxies show what geoms and bodies allow");
                self.precise_engine().add_candidate_pair(at);
                continue;
            }
            let (a, b) = self.precise_engine().candidate_geoms(at);
            let Objects { geoms, bodies, separated_bodies, .. } = &self.objects;
            let filter = Filter { geoms, bodies, separated_bodies };
            let may_collide = match (self.objects.geoms.get(a), self.objects.geoms.get(b)) {
                (Some(a), Some(b)) if is_in_space => filter.may_collide(a, b),
                (Some(a), Some(b)) => filter.may_touch(a, b),
                _ => {
                    let precise =
                        self.pipeline.precise.as_mut().filter(|precise| {
                            precise.may_meet_world_geom((a, b), &self.objects) == Some(true)
                        });
                    precise.into_iter().for_each(|precise| precise.add_candidate_pair(at));
                    false
                }
            };
            if may_collide && (!asks_about_new || self.approves_pair(handler, a, b)) {
                self.precise_engine().add_candidate_pair(at);
            }
        }
    }

    /// Whether the filters of geoms and bodies accept a candidate pair in 2D, an index into the new pairs. For debug assertions.
    fn may_be_new_pair(&mut self, at: usize) -> bool {
        let (a, b) = self.precise_engine().candidate_geoms(at);
        let Objects { geoms, bodies, separated_bodies, .. } = &self.objects;
        let filter = Filter { geoms, bodies, separated_bodies };
        geoms.get(a).zip(geoms.get(b)).is_some_and(|(a, b)| filter.may_touch(a, b))
    }

    /// Whether two touching geoms may still touch: callbacks dispose and edit.
    fn may_touch(&self, a: GeomId, b: GeomId) -> bool {
        let Objects { geoms, bodies, .. } = &self.objects;
        let is_in_space = self.pipeline.precise.as_ref().is_some_and(|precise| precise.has_depth());
        let may_stay = if is_in_space { is_valid_pair } else { may_keep_touching };
        geoms.get(a).is_some() && geoms.get(b).is_some() && may_stay((a, b), geoms, bodies)
    }

    /// Asks the handler about every pair; refused pairs exert no impulse in this update.
    fn filter_precise_pairs(&mut self, handler: &mut Handler<'_>) {
        for pair in 0..self.precise_engine().pair_count() {
            let (a, b) = self.precise_engine().geoms_of(pair);
            if !self.accepts_pair(handler, a, b) {
                self.precise_engine().disable_contact(pair);
            }
        }
    }

    /// Reports contacts that began or ended. The handler is asked about all touching pairs with callbacks on a side, in
    /// the order of creation numbers, and may refuse each.
    fn report_contact_events(&mut self, handler: &mut Handler<'_>) {
        let changes = self.precise_engine().drain_touch_events();
        self.report.counters.pairs_touching = self.precise_engine().touching_count();
        self.report_typed_touches(&changes);
        if handler.get().is_none() {
            for &TouchChange { geoms: (a, b), contacts, .. } in changes.iter().filter(|change| change.begins)
            {
                for (this, other) in [(a, b), (b, a)] {
                    self.report.push(Event::Collision { this, other, contacts, vetoed: false });
                }
            }
            for &TouchChange { geoms: (a, b), .. } in changes.iter().filter(|change| !change.begins) {
                for (this, other) in [(a, b), (b, a)] {
                    self.report.push(Event::Separation { this, other });
                }
            }
            return;
        }
        self.call_collision_handlers(handler, &changes);
        for TouchChange { geoms: (a, b), .. } in changes.into_iter().filter(|change| !change.begins) {
            for (this, other) in [(a, b), (b, a)] {
                self.report.push(Event::Separation { this, other });
                // A geom that does not exist any more has no callback.
                if self.objects.geoms.get(this).is_some() {
                    self.call_handler_of_side(handler, this, |handler, context| {
                        handler.on_separation(context, this, other)
                    });
                }
            }
        }
    }

    fn call_collision_handlers(&mut self, handler: &mut Handler<'_>, changes: &[TouchChange]) {
        let mut contacts = std::mem::take(&mut self.pipeline.new_contacts);
        let touching = self.precise_engine().touching_pairs(changes);
        for group in touching.chunk_by(|a, b| a.0 == b.0) {
            contacts.clear();
            for &(_, pair) in group {
                contacts.extend(
                    self.precise_engine()
                        .arbiter_of_pair(pair as usize)
                        .into_iter()
                        .flat_map(|touching| touching.contacts()),
                );
            }
            let Some(first) = self.precise_engine().arbiter_of_pair(group[0].1 as usize) else { continue };
            let (a, b) = first.geoms;
            if !self.may_touch(a, b) {
                group.iter().for_each(|&(_, pair)| self.precise_engine().disable_contact(pair as usize));
                continue;
            }
            let begins = changes.iter().any(|change| change.begins && change.geoms == (a, b));
            let mut surface = SurfaceOverride::default();
            let is_accepted = self.call_on_collision((a, b), begins, &mut contacts, &mut surface, handler)
                && self.call_on_collision((b, a), begins, &mut contacts, &mut surface, handler);
            for &(_, pair) in group {
                if is_accepted {
                    self.precise_engine().retain_contacts(pair as usize, &contacts);
                    self.precise_engine().override_surface(pair as usize, surface);
                } else {
                    self.precise_engine().disable_contact(pair as usize);
                }
            }
        }
        self.precise_engine().return_touching_buffer(touching);
        self.pipeline.new_contacts = contacts;
    }

    /// Calls the handler for one side. Contacts that it removes from the list exert no impulse in this update.
    fn call_on_collision(
        &mut self,
        (this, other): (GeomId, GeomId),
        begins: bool,
        contacts: &mut Vec<Contact>,
        surface: &mut SurfaceOverride,
        handler: &mut Handler<'_>,
    ) -> bool {
        let count = contacts.len() as u32;
        let is_accepted = self
            .call_handler_of_side(handler, this, |handler, context| {
                handler.on_collision(&mut context.with_surface(surface), this, other, contacts)
            })
            .unwrap_or(true);
        if begins {
            self.report.push(Event::Collision { this, other, contacts: count, vetoed: !is_accepted });
        }
        is_accepted && !contacts.is_empty()
    }

    /// Stores the poses and velocities of the step in the bodies. Their geoms are updated when they are next read.
    fn store_bodies(&mut self, handler: &mut Handler<'_>) {
        let PhysicsSimulator { objects, pipeline, report, .. } = self;
        let Some(precise) = &mut pipeline.precise else { return };
        precise.write_bodies(objects, report);
        let event_count = report.events.len();
        precise.solver.refit_aabbs();
        #[cfg(feature = "space")]
        self.report_depth_moved(handler);
        self.store_joint_forces(handler);
        if handler.get().is_some() {
            self.report_moved_bodies(event_count - self.report.counters.bodies_moved..event_count, handler);
        }
    }

    /// Reports sensors that a fast body crossed within the step.
    fn report_sensor_passthroughs(&mut self, handler: &mut Handler<'_>) {
        let mut at = 0;
        while let Some((a, b)) = self.precise_engine().sensor_passthrough(at) {
            at += 1;
            // Another convex piece may overlap the sensor already.
            if !self.may_touch(a, b) || self.precise_engine().contacts_between((a, b)) > 0 {
                continue;
            }
            self.report_passage(a, b);
            for (this, other) in [(a, b), (b, a)] {
                self.report.push(Event::Collision { this, other, contacts: 0, vetoed: false });
                self.call_handler_of_side(handler, this, |handler, context| {
                    handler.on_collision(context, this, other, &mut Vec::new())
                });
            }
            for (this, other) in [(a, b), (b, a)] {
                self.report.push(Event::Separation { this, other });
                self.call_handler_of_side(handler, this, |handler, context| {
                    handler.on_separation(context, this, other)
                });
            }
        }
    }

    fn report_moved_bodies(&mut self, events: std::ops::Range<usize>, handler: &mut Handler<'_>) {
        for at in events {
            if let Event::BodyUpdated { body } = self.report.events[at]
                && self.objects.bodies.get(body).is_some_and(|entry| entry.body.enabled())
            {
                self.call_handler(handler, |handler, context| handler.on_body_updated(context, body));
            }
        }
    }
}

/// Returns whether bodies or geoms were edited, added or removed since the precise engine imported edits last.
fn has_unimported_edits(objects: &Objects) -> bool {
    objects.has_new_members
        || objects.has_new_structure
        || !(objects.touched_bodies.is_empty() && objects.touched_geoms.is_empty())
}

#[cfg(test)]
mod tests {
    use crate::math::Vector2;
    use crate::{BodyFactory, BodyId, GeomFactory, GeomPlacement, Methods, PhysicsSimulator};

    fn add_box(simulator: &mut PhysicsSimulator, x: f32, y: f32, size: f32) -> BodyId {
        let body = BodyFactory::create_rectangle_body_in(simulator, size, size, 1.0).unwrap();
        simulator[body].set_position(Vector2::new(x, y));
        simulator[body].set_linear_drag_coefficient(0.0);
        let placement = GeomPlacement::default();
        GeomFactory::create_rectangle_geom_in(simulator, body, size, size, placement).unwrap();
        body
    }

    /// Four fast boxes fly along a row of sleeping ones. Returns the maximum numbers of pairs and of new fat AABBs in a
    /// step.
    fn max_pairs_and_aabbs(sleepers: usize) -> (usize, usize) {
        let mut simulator = PhysicsSimulator::new(Vector2::zeros()).unwrap();
        simulator.set_methods(Methods::PRECISE).unwrap();
        for i in 0..sleepers {
            add_box(&mut simulator, 40.0 * i as f32, 0.0, 32.0);
        }
        (0..60).for_each(|_| simulator.update(1.0 / 60.0));
        for i in 0..4 {
            let body = add_box(&mut simulator, -60.0, -40.0 - 30.0 * i as f32, 16.0);
            simulator[body].set_linear_velocity(Vector2::new(6000.0, 0.0));
        }
        let mut most = (0, 0);
        for _ in 0..60 {
            simulator.update(1.0 / 60.0);
            let precise = simulator.pipeline.precise.as_ref().unwrap();
            most = (most.0.max(precise.pair_count()), most.1.max(precise.refitted_count()));
        }
        most
    }

    #[test]
    fn broad_phase_cost_of_fast_bodies_does_not_grow_with_sleeping_bodies() {
        let (few, many) = (max_pairs_and_aabbs(60), max_pairs_and_aabbs(2000));
        assert!(many.0 <= few.0 + 2 && many.1 <= few.1, "{few:?} and {many:?}");
        assert!(many.1 <= 4, "{many:?}: no more than there are fast bodies");
    }
}
