//! What was edited takes effect, and what waits enters or leaves.

use super::PhysicsSimulator;
use super::tell::{Handler, tell_added, tell_removed};
use crate::geom::filter::is_valid_pair;
use crate::methods::Methods;
use crate::object_id::ObjectId;
use crate::precise::Precise;
use crate::report::Event;

/// How often callbacks are told of what callbacks did.
const MAX_ROUNDS: usize = 16;

impl PhysicsSimulator {
    /// Lets everything that waits enter or leave now, without a step.
    #[doc(alias = "ProcessAddedAndRemoved")]
    pub fn process_added_and_removed(&mut self) {
        self.process_all_queues(&mut Handler::none());
    }

    /// Empties the simulator: all objects are gone, their ids are stale, and the broad phase is the selective
    /// sweep again, whatever it was. Settings and [limits](crate::Objects::limits) stay.
    #[doc(alias = "Clear")]
    pub fn clear(&mut self) {
        self.objects.clear();
        self.objects.methods = self.objects.methods.with_broad(Default::default());
        self.contacts = Default::default();
        self.pipeline = Default::default();
        if let Methods::Precise { length_unit } = self.objects.methods {
            self.pipeline.precise = Some(Box::new(Precise::new(length_unit)));
        }
        self.report.clear();
    }

    pub(super) fn process_all_queues(&mut self, handler: &mut Handler<'_>) {
        // Ids go stale below.
        self.pipeline.bodies.close();
        self.settle_edits(handler);
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
        let entered = objects.process_added(|object| tell_added(report, handler, object));
        entered.into_iter().for_each(|geom| pipeline.broad_phase.add(geom, &objects.geoms));
    }

    fn process_removed(&mut self, handler: &mut Handler<'_>) {
        let PhysicsSimulator { objects, contacts, pipeline, report, .. } = self;
        let left = objects.process_removed(|object| tell_removed(report, handler, object));
        if !left.is_empty() {
            contacts.remove_arbiters_of(&left);
            pipeline.broad_phase.retain(|geom| objects.geoms[geom].in_simulation, &objects.geoms);
        }
    }

    fn process_disposed(&mut self, handler: &mut Handler<'_>) {
        let PhysicsSimulator { objects, pipeline, report, .. } = self;
        let left = objects.process_disposed(|object| tell_removed(report, handler, object));
        if !left.is_empty() {
            pipeline.broad_phase.retain(|geom| !objects.geoms.is_disposed(geom), &objects.geoms);
        }
    }

    /// Lets geoms follow bodies that were edited, and delivers what has happened meanwhile.
    ///
    /// Callbacks may edit again, which is delivered in turn. One that answers every edit with another is not called
    /// any more after some rounds; the original overflows its stack.
    #[inline]
    pub(super) fn settle_edits(&mut self, handler: &mut Handler<'_>) {
        if self.objects.has_edits() {
            self.settle_all_edits(handler);
        }
    }

    fn settle_all_edits(&mut self, handler: &mut Handler<'_>) {
        let mut notices = std::mem::take(&mut self.report.delivered);
        for round in 0.. {
            self.settle_touched();
            if self.objects.pending.is_empty() {
                break;
            }
            // The buffers change places, so that neither is allocated anew.
            std::mem::swap(&mut notices, &mut self.objects.pending);
            for notice in notices.drain(..) {
                if round < MAX_ROUNDS {
                    self.deliver(notice, handler);
                } else {
                    self.deliver(notice, &mut Handler::none());
                }
            }
        }
        self.report.delivered = notices;
    }

    /// Bodies and geoms in the order in which they were edited.
    fn settle_touched(&mut self) {
        let PhysicsSimulator { objects, pipeline, report, .. } = self;
        let mut bodies = std::mem::take(&mut objects.touched_bodies);
        for body in bodies.drain(..) {
            let Some(entry) = objects.bodies.get_mut(body) else { continue };
            entry.is_touched = false;
            tell_rejected(&mut report.events, body.into(), entry.body.rejected.take());
            pipeline.joints.take_velocity_up(body, &objects.bodies, &mut pipeline.bodies);
            objects.settle_body(body);
            if let Some(precise) = &mut pipeline.precise {
                precise.note_body(body);
            }
        }
        objects.touched_bodies = bodies;
        let mut geoms = std::mem::take(&mut objects.touched_geoms);
        for geom in geoms.drain(..) {
            let Some(entry) = objects.geoms.get_mut(geom) else { continue };
            entry.is_touched = false;
            tell_rejected(&mut report.events, geom.into(), entry.geom.rejected.take());
            if let Some(precise) = &mut pipeline.precise {
                precise.note_geom(geom);
            }
        }
        objects.touched_geoms = geoms;
    }
}

fn tell_rejected(events: &mut Vec<Event>, object: ObjectId, rejected: impl Iterator<Item = &'static str>) {
    events.extend(rejected.map(|argument| Event::RejectedInput { object: Some(object), argument }));
}
