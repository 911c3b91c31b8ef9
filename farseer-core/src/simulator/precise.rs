//! The update with the precise set: its stages, and what is told between them.

use super::PhysicsSimulator;
use super::tell::Handler;
use crate::contacts::contact::Contact;
use crate::geom::GeomId;
use crate::geom::filter::{Filter, is_valid_pair, may_go_on_touching};
use crate::geom::surface::SetSurface;
use crate::objects::Objects;
use crate::precise::dormant::Terms;
use crate::precise::{Precise, Step};
use crate::report::{Event, Stopwatch};
use crate::springs::Steps;

impl PhysicsSimulator {
    /// The state of the precise set, while it is chosen.
    fn precise(&mut self) -> &mut Precise {
        self.pipeline.precise.as_mut().expect("the precise set is chosen")
    }

    /// Answers whether anything may have happened: not where all sleeps and nothing acts.
    pub(super) fn run_precise(
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
        self.precise().set_island_choice(choice);
        if self.pass_dormant(dt, substeps, handler) {
            return false;
        }
        let steps = Steps { before: self.precise().last_step(), now: dt };
        let step = self.precise().begin(dt, substeps, gravity, may_sleep);
        if let Some(precise) = &mut self.pipeline.precise {
            precise.begin_kinematic(&self.objects);
        }
        self.report.counters.aabbs_renewed = self.precise().escaped_count();
        let found = self.precise().find_pairs();
        self.accept_precise_pairs(found, handler);
        stopwatch.lap(|times| &mut times.broad_phase_collision_time);
        let friction = self.settings.friction_type;
        let most = self.most_precise_contacts();
        self.report.counters.pairs_tested = self.precise().find_contacts(friction, most);
        let looks = self.precise().looks();
        (self.report.counters.manifolds_made, self.report.counters.manifolds_kept) = (looks.made, looks.kept);
        if self.precise().is_in_space() {
            self.report.counters.pairs_touching = self.precise().touching_count();
            self.ask_about_space(handler);
        } else {
            if handler.wants(|handler| handler.filters_pairs()) {
                self.filter_precise_pairs(handler);
            }
            self.tell_precise(handler);
        }
        stopwatch.lap(|times| &mut times.narrow_phase_collision_time);
        self.update_controllers(dt, dt_real, handler);
        self.update_springs(Some(steps), handler);
        self.sync_precise();
        self.wake_disturbed();
        self.break_precise_joints(handler);
        self.read_precise(&step);
        stopwatch.lap(|times| &mut times.apply_forces_time);
        self.precise().solve(&step);
        if self.precise().find_fast() {
            let found = self.precise().find_pairs_of_fast();
            self.accept_precise_pairs(found, handler);
            if self.precise().stop_fast(&step) {
                let found = self.precise().find_pairs_of_fast();
                self.accept_precise_pairs(found, handler);
                self.precise().stop_carried();
            }
        }
        self.report.counters.passes = substeps;
        stopwatch.lap(|times| &mut times.apply_impulses_time);
        self.write_precise(handler);
        self.tell_flown(handler);
        self.let_sleep(&step);
        stopwatch.lap(|times| &mut times.update_positions_time);
        true
    }

    /// Passes an update in which nothing can happen, if it is one.
    fn pass_dormant(&mut self, dt: f32, substeps: u32, handler: &mut Handler<'_>) -> bool {
        let Objects { springs, controllers, .. } = &self.objects;
        if handler.get().is_some() || !springs.list().is_empty() || !controllers.list().is_empty() {
            return false;
        }
        let terms = Terms {
            dt,
            substeps,
            gravity: self.settings.gravity,
            may_sleep: self.settings.is_sleep_enabled,
            friction: self.settings.friction_type,
            most_contacts: self.most_precise_contacts(),
        };
        let precise = self.precise();
        if !precise.pass_dormant(&terms) {
            return false;
        }
        let (touching, asleep) = (precise.touching_count(), precise.asleep_count());
        let counters = &mut self.report.counters;
        (counters.pairs_touching, counters.bodies_asleep, counters.passes) = (touching, asleep, substeps);
        true
    }

    /// Contacts of two convex pieces, at most: a negative number to look for is no limit.
    fn most_precise_contacts(&self) -> u32 {
        let to_detect = u32::try_from(self.settings.max_contacts_to_detect).unwrap_or(2);
        let to_resolve = u32::try_from(self.settings.max_contacts_to_resolve).unwrap_or(2);
        to_detect.min(to_resolve).min(2)
    }

    /// Takes over what was edited, where the precise set is chosen.
    pub(super) fn sync_precise(&mut self) {
        let PhysicsSimulator { objects, pipeline, .. } = self;
        if let Some(precise) = &mut pipeline.precise {
            if std::mem::take(&mut objects.has_new_members) {
                precise.note_members();
            }
            if std::mem::take(&mut objects.has_new_structure) {
                precise.note_change();
            }
            if std::mem::take(&mut objects.has_edited_joints) {
                precise.note_joints();
            }
            if std::mem::take(&mut objects.has_edited_drives) {
                precise.note_edited_drives(objects);
            }
            precise.sync(objects);
        }
    }

    fn wake_disturbed(&mut self) {
        let PhysicsSimulator { objects, pipeline, .. } = self;
        if let Some(precise) = &mut pipeline.precise {
            precise.wake_disturbed(objects);
        }
    }

    fn let_sleep(&mut self, step: &Step) {
        let PhysicsSimulator { objects, pipeline, report, .. } = self;
        if let Some(precise) = &mut pipeline.precise {
            precise.fall_asleep(objects, step);
            report.counters.bodies_asleep = precise.asleep_count();
        }
    }

    fn read_precise(&mut self, step: &Step) {
        let PhysicsSimulator { objects, pipeline, report, settings, .. } = self;
        if let Some(precise) = &mut pipeline.precise {
            precise.read_bodies(objects, settings.gravity, step, report);
            precise.read_joints(objects, step);
            report.counters.contacts_solved = precise.contacts_solved();
        }
    }

    /// Joints that are too far from what they keep break before they act.
    fn break_precise_joints(&mut self, handler: &mut Handler<'_>) {
        if !self.precise().may_break_joints() {
            return;
        }
        let mut has_told = false;
        for position in 0..self.joint_list().len() {
            let PhysicsSimulator { objects, pipeline, .. } = self;
            let (Some(precise), Some((joint, held))) = (&pipeline.precise, objects.joints.at_mut(position))
            else {
                continue;
            };
            if held.breakpoint() == f32::MAX || !held.enabled() {
                continue;
            }
            let Some(error) = precise.joint_error((joint, &*held), &objects.bodies) else { continue };
            held.note(error);
            if held.breaks() {
                objects.has_edited_joints = true;
                self.report.push(Event::JointBroke { joint });
                self.tell(handler, |handler, context| handler.on_joint_broke(context, joint));
                has_told = true;
            }
        }
        if has_told {
            self.sync_precise();
        }
    }

    /// What has held the joints is told.
    fn write_precise_joints(&mut self, handler: &mut Handler<'_>) {
        let PhysicsSimulator { objects, pipeline, report, .. } = self;
        let Some(precise) = &mut pipeline.precise else { return };
        let broken = report.events.len();
        precise.write_joints(objects, report);
        if handler.get().is_none() {
            return;
        }
        for at in broken..self.report.events.len() {
            if let Event::JointBroke { joint } = self.report.events[at] {
                self.tell(handler, |handler, context| handler.on_joint_broke(context, joint));
            }
        }
        let mut at = 0;
        while handler.wants(|handler| handler.handles_joint_updates())
            && let Some(joint) = self.precise().acting_joint(at)
        {
            self.tell(handler, |handler, context| handler.on_joint_updated(context, joint));
            at += 1;
        }
    }

    /// New pairs, as far as filters and the handler let them.
    fn accept_precise_pairs(&mut self, found: usize, handler: &mut Handler<'_>) {
        let asks_about_new = handler.wants(|handler| handler.handles_broad_phase());
        let is_in_space = self.precise().is_in_space();
        for at in 0..found {
            let (a, b) = self.precise().candidate(at);
            let filter = Filter { geoms: &self.objects.geoms, bodies: &self.objects.bodies };
            let may_collide = match (self.objects.geoms.get(a), self.objects.geoms.get(b)) {
                (Some(a), Some(b)) if is_in_space => filter.may_collide(a, b),
                (Some(a), Some(b)) => filter.may_touch(a, b),
                _ => {
                    let precise = self
                        .pipeline
                        .precise
                        .as_mut()
                        .filter(|precise| precise.meets_fixture((a, b), &self.objects) == Some(true));
                    precise.into_iter().for_each(|precise| precise.accept(at));
                    false
                }
            };
            if may_collide && (!asks_about_new || self.approves_pair(handler, a, b)) {
                self.precise().accept(at);
            }
        }
    }

    /// Whether nothing has parted two that touch: callbacks dispose and edit.
    fn may_touch(&self, a: GeomId, b: GeomId) -> bool {
        let Objects { geoms, bodies, .. } = &self.objects;
        let is_in_space = self.pipeline.precise.as_ref().is_some_and(|precise| precise.is_in_space());
        let may_stay = if is_in_space { is_valid_pair } else { may_go_on_touching };
        geoms.get(a).is_some() && geoms.get(b).is_some() && may_stay((a, b), geoms, bodies)
    }

    /// Asks the handler about every pair; those that it refuses push nothing in this update.
    fn filter_precise_pairs(&mut self, handler: &mut Handler<'_>) {
        for pair in 0..self.precise().pair_count() {
            let (a, b) = self.precise().geoms_of(pair);
            if !self.accepts_pair(handler, a, b) {
                self.precise().refuse(pair);
            }
        }
    }

    /// What began and ceased to touch is told; a handler is asked about everything that touches and has a side that is told,
    /// in the order of creation numbers, and may refuse it.
    fn tell_precise(&mut self, handler: &mut Handler<'_>) {
        let changes = self.precise().take_changes();
        self.report.counters.pairs_touching = self.precise().touching_count();
        if handler.get().is_none() {
            for &((a, b), _) in changes.iter().filter(|(_, begins)| *begins) {
                let contacts = self.precise().contacts_between((a, b));
                for (this, other) in [(a, b), (b, a)] {
                    self.report.push(Event::Collision { this, other, contacts, vetoed: false });
                }
            }
            for &((a, b), _) in changes.iter().filter(|(_, begins)| !begins) {
                for (this, other) in [(a, b), (b, a)] {
                    self.report.push(Event::Separation { this, other });
                }
            }
            return;
        }
        self.ask_about_touches(handler, &changes);
        for ((a, b), _) in changes.into_iter().filter(|(_, begins)| !begins) {
            for (this, other) in [(a, b), (b, a)] {
                self.report.push(Event::Separation { this, other });
                // A geom that is gone has no side that is told.
                if self.objects.geoms.get(this).is_some() {
                    self.tell_side(handler, this, |handler, context| {
                        handler.on_separation(context, this, other)
                    });
                }
            }
        }
    }

    fn ask_about_touches(&mut self, handler: &mut Handler<'_>, changes: &[((GeomId, GeomId), bool)]) {
        let mut contacts = std::mem::take(&mut self.pipeline.new_contacts);
        let touching = self.precise().take_touching(changes);
        for group in touching.chunk_by(|a, b| a.0 == b.0) {
            contacts.clear();
            for &(_, pair) in group {
                contacts.extend(
                    self.precise()
                        .touching(pair as usize)
                        .into_iter()
                        .flat_map(|touching| touching.contacts()),
                );
            }
            let Some(first) = self.precise().touching(group[0].1 as usize) else { continue };
            let (a, b) = first.geoms;
            if !self.may_touch(a, b) {
                group.iter().for_each(|&(_, pair)| self.precise().refuse(pair as usize));
                continue;
            }
            let begins = changes.iter().any(|&(geoms, begins)| begins && geoms == (a, b));
            let mut surface = SetSurface::default();
            let is_accepted = self.ask_about_touch((a, b), begins, &mut contacts, &mut surface, handler)
                && self.ask_about_touch((b, a), begins, &mut contacts, &mut surface, handler);
            for &(_, pair) in group {
                if is_accepted {
                    self.precise().keep_contacts(pair as usize, &contacts);
                    self.precise().set_surface(pair as usize, surface);
                } else {
                    self.precise().refuse(pair as usize);
                }
            }
        }
        self.precise().keep_touching(touching);
        self.pipeline.new_contacts = contacts;
    }

    /// Asks one side. Contacts that are taken off the list push nothing in this update.
    fn ask_about_touch(
        &mut self,
        (this, other): (GeomId, GeomId),
        begins: bool,
        contacts: &mut Vec<Contact>,
        surface: &mut SetSurface,
        handler: &mut Handler<'_>,
    ) -> bool {
        let count = contacts.len() as u32;
        let is_accepted = self
            .tell_side(handler, this, |handler, context| {
                handler.on_collision(&mut context.with_surface(surface), this, other, contacts)
            })
            .unwrap_or(true);
        if begins {
            self.report.push(Event::Collision { this, other, contacts: count, vetoed: !is_accepted });
        }
        is_accepted && !contacts.is_empty()
    }

    /// Bodies are where the step has brought them. Their geoms follow when somebody looks at them: nothing here does.
    fn write_precise(&mut self, handler: &mut Handler<'_>) {
        let PhysicsSimulator { objects, pipeline, report, .. } = self;
        let Some(precise) = &mut pipeline.precise else { return };
        precise.write_bodies(objects, report);
        let told = report.events.len();
        precise.follow();
        if precise.is_in_space() {
            self.tell(handler, |handler, context| handler.on_space_moved(context));
        }
        self.write_precise_joints(handler);
        if handler.get().is_some() {
            self.tell_bodies_moved(told - self.report.counters.bodies_moved..told, handler);
        }
    }

    /// Tells of sensors through which something has flown between two looks.
    fn tell_flown(&mut self, handler: &mut Handler<'_>) {
        let mut at = 0;
        while let Some((a, b)) = self.precise().flown(at) {
            at += 1;
            if !self.may_touch(a, b) {
                continue;
            }
            for (this, other) in [(a, b), (b, a)] {
                self.report.push(Event::Collision { this, other, contacts: 0, vetoed: false });
                self.tell_side(handler, this, |handler, context| {
                    handler.on_collision(context, this, other, &mut Vec::new())
                });
            }
            for (this, other) in [(a, b), (b, a)] {
                self.report.push(Event::Separation { this, other });
                self.tell_side(handler, this, |handler, context| handler.on_separation(context, this, other));
            }
        }
    }

    fn tell_bodies_moved(&mut self, events: std::ops::Range<usize>, handler: &mut Handler<'_>) {
        for at in events {
            if let Event::BodyUpdated { body } = self.report.events[at]
                && self.objects.bodies.get(body).is_some_and(|entry| entry.body.enabled())
            {
                self.tell(handler, |handler, context| handler.on_body_updated(context, body));
            }
        }
    }
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

    /// Four fast boxes fly along a row of sleeping ones: the most pairs, and the most bounds renewed in a step.
    fn most_beside(sleepers: usize) -> (usize, usize) {
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
            most = (most.0.max(precise.pair_count()), most.1.max(precise.bounds_renewed()));
        }
        most
    }

    #[test]
    fn fast_bodies_have_as_few_pairs_and_new_bounds_beside_many_sleepers_as_beside_few() {
        let (few, many) = (most_beside(60), most_beside(2000));
        assert!(many.0 <= few.0 + 2 && many.1 <= few.1, "{few:?} and {many:?}");
        assert!(many.1 <= 4, "{many:?}: no more than there are fast bodies");
    }
}
