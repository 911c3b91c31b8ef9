//! Applying edits and queues: geoms of edited bodies are updated, objects enter and leave.

use super::PhysicsSimulator;
use super::callbacks::{Handler, report_added, report_removed};
use crate::geom::filter::is_valid_pair;
use crate::object_id::ObjectId;
use crate::precise::Precise;
use crate::report::Event;

/// Maximum number of rounds in which callbacks are called for edits by callbacks.
const MAX_CALLBACK_ROUNDS: usize = 16;

impl PhysicsSimulator {
    /// Lets all queued objects enter or leave now, without a step.
    #[doc(alias = "ProcessAddedAndRemoved")]
    pub fn process_added_and_removed(&mut self) {
        self.process_all_queues(&mut Handler::none());
    }

    /// Empties the simulator: all objects are removed, their ids are stale, and the broad phase becomes the selective
    /// sweep, whatever it was. Settings and [limits](crate::Objects::limits) stay.
    #[doc(alias = "Clear")]
    pub fn clear(&mut self) {
        self.objects.clear();
        self.objects.methods = self.objects.methods.with_broad(Default::default());
        self.contacts = Default::default();
        self.pipeline = Default::default();
        self.pipeline.precise = Precise::of_methods(self.objects.methods);
        self.report.clear();
    }

    pub(super) fn process_all_queues(&mut self, handler: &mut Handler<'_>) {
        // Ids become stale below.
        self.pipeline.bodies.close();
        self.apply_edits(handler);
        let has_new_links = self.objects.has_new_links();
        if self.objects.has_queued() {
            self.process_added(handler);
            self.process_removed(handler);
        }
        self.validate_controllers(handler);
        if has_new_links || !self.objects.bodies.disposed().is_empty() {
            self.objects.dispose_links_without_body();
        }
        let has_queued = self.objects.has_queued();
        if has_queued {
            self.process_disposed(handler);
        }
        let (geoms, bodies) = (&self.objects.geoms, &self.objects.bodies);
        let is_leaving = |pair: Option<_>| !pair.is_some_and(|pair| is_valid_pair(pair, geoms, bodies));
        self.contacts.remove_where(|arbiter| is_leaving(arbiter.geoms), |_, _| {});
        if has_queued {
            self.objects.free_disposed();
        }
    }

    fn process_added(&mut self, handler: &mut Handler<'_>) {
        let PhysicsSimulator { objects, pipeline, report, .. } = self;
        let entered = objects.process_added(|object| report_added(report, handler, object));
        if pipeline.precise.is_none() {
            entered.into_iter().for_each(|geom| pipeline.broad_phase.add(geom, &objects.geoms));
        }
    }

    fn process_removed(&mut self, handler: &mut Handler<'_>) {
        let PhysicsSimulator { objects, contacts, pipeline, report, .. } = self;
        let left = objects.process_removed(|object| report_removed(report, handler, object));
        if !left.is_empty() && pipeline.precise.is_none() {
            contacts.remove_arbiters_of(&left);
            pipeline.broad_phase.retain(|geom| objects.geoms[geom].in_simulation, &objects.geoms);
        }
    }

    fn process_disposed(&mut self, handler: &mut Handler<'_>) {
        let PhysicsSimulator { objects, pipeline, report, .. } = self;
        let left = objects.process_disposed(|object| report_removed(report, handler, object));
        if !left.is_empty() && pipeline.precise.is_none() {
            pipeline.broad_phase.retain(|geom| !objects.geoms.is_disposed(geom), &objects.geoms);
        }
    }

    /// Updates the geoms of edited bodies, and reports pending events.
    ///
    /// Callbacks may edit again, which is reported in turn. A callback that answers every edit with another is not
    /// called any more after some rounds; the original overflows its stack.
    #[inline]
    pub(super) fn apply_edits(&mut self, handler: &mut Handler<'_>) {
        if self.objects.has_edits() {
            self.apply_all_edits(handler);
        }
    }

    fn apply_all_edits(&mut self, handler: &mut Handler<'_>) {
        let mut notices = std::mem::take(&mut self.report.pending_buffer);
        for round in 0.. {
            self.apply_edited_objects();
            if self.objects.pending.is_empty() {
                break;
            }
            // The buffers are swapped, so that neither is allocated anew.
            std::mem::swap(&mut notices, &mut self.objects.pending);
            for notice in notices.drain(..) {
                if round < MAX_CALLBACK_ROUNDS {
                    self.report_pending(notice, handler);
                } else {
                    self.report_pending(notice, &mut Handler::none());
                }
            }
        }
        self.report.pending_buffer = notices;
    }

    /// Applies the edits of bodies and geoms in the order in which they were made.
    fn apply_edited_objects(&mut self) {
        let PhysicsSimulator { objects, pipeline, report, .. } = self;
        let mut bodies = std::mem::take(&mut objects.touched_bodies);
        for body in bodies.drain(..) {
            let Some(entry) = objects.bodies.get_mut(body) else { continue };
            entry.is_touched = false;
            report_rejected(&mut report.events, body.into(), entry.body.rejected.take());
            pipeline.joints.load_velocity(body, &objects.bodies, &mut pipeline.bodies);
            objects.update_edited_geom_transforms(body);
            if let Some(precise) = &mut pipeline.precise {
                precise.mark_body_edited(body);
            }
        }
        objects.touched_bodies = bodies;
        let mut geoms = std::mem::take(&mut objects.touched_geoms);
        for geom in geoms.drain(..) {
            let Some(entry) = objects.geoms.get_mut(geom) else { continue };
            entry.is_touched = false;
            report_rejected(&mut report.events, geom.into(), entry.geom.rejected.take());
            if let Some(precise) = &mut pipeline.precise {
                precise.mark_geom_edited(geom);
            }
        }
        objects.touched_geoms = geoms;
    }
}

fn report_rejected(events: &mut Vec<Event>, object: ObjectId, rejected: impl Iterator<Item = &'static str>) {
    events.extend(rejected.map(|argument| Event::RejectedInput { object: Some(object), argument }));
}
