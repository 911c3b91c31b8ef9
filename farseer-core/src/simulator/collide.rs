//! Broad and narrow phase of the faithful set.

use super::callbacks::Handler;
use super::{Context, EventHandler, PhysicsSimulator};
use crate::Objects;
use crate::broad_phase::{BroadPhase, PairCallback};
use crate::contacts::contact::Contact;
use crate::geom::GeomId;
use crate::geom::filter::Filter;
use crate::narrow_phase::update_arbiter::{ContactLimits, find_contacts, replace_contacts};
use crate::report::Event;
use farseer_precise::surface::SurfaceOverride;

impl PhysicsSimulator {
    pub(super) fn run_broad_phase(&mut self, handler: &mut Handler<'_>) {
        let is_filtered = handler.wants(|handler| handler.filters_pairs());
        if is_filtered {
            self.filter_listed_pairs(handler);
        }
        let mut method = self.objects.methods.broad();
        let mut broad_phase = std::mem::replace(&mut self.pipeline.broad_phase, BroadPhase::AtWork);
        broad_phase.restore(method, &self.objects.geoms);
        let mut finder = PairFinder { simulator: self, handler: handler.reborrow(), is_filtered };
        broad_phase.update(&mut method, &mut finder);
        self.pipeline.broad_phase = broad_phase;
        self.objects.methods = self.objects.methods.with_broad(method);
    }

    /// Asks the handler about every pair that has an arbiter. Pairs that it refuses lose their contacts, and are
    /// removed.
    fn filter_listed_pairs(&mut self, handler: &mut Handler<'_>) {
        for position in 0..self.contacts.len() {
            if let Some((a, b)) = self.contacts.at(position).geoms
                && !self.accepts_pair(handler, a, b)
                && let Some(arbiter) = self.contacts.get_mut(position)
            {
                arbiter.contacts.clear();
            }
        }
        self.remove_separated(handler);
    }

    /// Asks the handler about a pair whose boxes have begun to overlap; a refusal is an event.
    pub(super) fn approves_pair(&mut self, handler: &mut Handler<'_>, geom1: GeomId, geom2: GeomId) -> bool {
        let ask = |handler: &mut dyn EventHandler, context: &mut Context<'_>| {
            let is_accepted = handler.on_broad_phase_collision(context, geom1, geom2);
            if !is_accepted {
                context.simulator.report.push(Event::BroadPhaseVeto { geom1, geom2 });
            }
            is_accepted
        };
        self.call_handler(handler, ask).unwrap_or(true)
    }

    pub(super) fn accepts_pair(&mut self, handler: &mut Handler<'_>, geom1: GeomId, geom2: GeomId) -> bool {
        self.call_handler(handler, |handler, context| handler.accepts_pair(context, geom1, geom2))
            .unwrap_or(true)
    }

    pub(super) fn run_narrow_phase(&mut self, handler: &mut Handler<'_>) {
        self.contacts.clear_overrides();
        let mut contacts = std::mem::take(&mut self.pipeline.new_contacts);
        for position in 0..self.contacts.len() {
            self.collide_pair(position, &mut contacts, handler);
        }
        self.pipeline.new_contacts = contacts;
        self.report.counters.pairs_tested = self.contacts.len();
        self.remove_separated(handler);
        self.report.counters.pairs_touching = self.contacts.len();
    }

    fn collide_pair(&mut self, position: usize, contacts: &mut Vec<Contact>, handler: &mut Handler<'_>) {
        let handle = self.contacts.list[position] as usize;
        let Some((a, b)) = self.contacts.arbiters[handle].geoms else { return };
        let settings = &self.settings;
        let limits = ContactLimits {
            detect: settings.max_contacts_to_detect,
            resolve: settings.max_contacts_to_resolve,
        };
        find_contacts(self.objects.methods.narrow(), &self.objects.geoms, (a, b), limits, contacts);
        let mut surface = SurfaceOverride::default();
        self.report_collision((a, b), contacts, &mut surface, handler);
        self.report_collision((b, a), contacts, &mut surface, handler);
        self.contacts.set_surface(handle, surface);
        replace_contacts(&mut self.contacts.arbiters[handle].contacts, contacts);
    }

    fn report_collision(
        &mut self,
        (this, other): (GeomId, GeomId),
        contacts: &mut Vec<Contact>,
        surface: &mut SurfaceOverride,
        handler: &mut Handler<'_>,
    ) {
        if contacts.is_empty() {
            return;
        }
        let count = contacts.len() as u32;
        let event =
            |is_accepted: bool| Event::Collision { this, other, contacts: count, vetoed: !is_accepted };
        let is_accepted = self.call_handler_of_side(handler, this, |handler, context| {
            let is_accepted = handler.on_collision(&mut context.with_surface(surface), this, other, contacts);
            context.simulator.report.push(event(is_accepted));
            contacts.retain(|contact| is_accepted && contact.is_finite());
            is_accepted
        });
        if is_accepted.is_none() {
            self.report.push(event(true));
            #[cfg(feature = "space")]
            if let Handler::Depth(handler) = handler {
                handler.on_silent_collision(self, this, other, contacts);
            }
        }
    }

    /// Removes arbiters without contacts from the list, and calls the handler for both sides.
    fn remove_separated(&mut self, handler: &mut Handler<'_>) {
        let mut separated = std::mem::take(&mut self.pipeline.separated);
        self.contacts.remove_where(|arbiter| arbiter.contacts.is_empty(), |a, b| separated.push((a, b)));
        for (a, b) in separated.drain(..) {
            for (this, other) in [(a, b), (b, a)] {
                self.report.push(Event::Separation { this, other });
                self.call_handler_of_side(handler, this, |handler, context| {
                    handler.on_separation(context, this, other)
                });
            }
        }
        self.pipeline.separated = separated;
    }
}

/// Adds pairs of the broad phase to the arbiter list.
struct PairFinder<'s, 'h> {
    simulator: &'s mut PhysicsSimulator,
    handler: Handler<'h>,
    /// Whether the handler filters pairs.
    is_filtered: bool,
}

impl PairCallback for PairFinder<'_, '_> {
    fn has_approval(&self) -> bool {
        self.handler.wants(|handler| handler.handles_broad_phase())
    }

    fn approve(&mut self, geom1: GeomId, geom2: GeomId) -> bool {
        self.simulator.approves_pair(&mut self.handler, geom1, geom2)
    }

    fn filter(&self) -> Filter<'_> {
        let Objects { geoms, bodies, separated_bodies, .. } = &self.simulator.objects;
        Filter { geoms, bodies, separated_bodies }
    }

    fn geom_list(&self) -> &[GeomId] {
        self.simulator.geom_list()
    }

    fn register(&mut self, geom1: GeomId, geom2: GeomId) {
        let geoms = &self.simulator.objects.geoms;
        if !geoms.contains(geom1) || !geoms.contains(geom2) {
            return;
        }
        // The handler is asked before the table is searched: most pairs are refused, and asking is the cheaper of the
        // two.
        if self.is_filtered && !self.simulator.accepts_pair(&mut self.handler, geom1, geom2) {
            return;
        }
        let PhysicsSimulator { contacts, objects, settings, .. } = &mut *self.simulator;
        contacts.add_arbiter_for_geom_pair(&objects.geoms, settings.friction_type, geom1, geom2);
    }

    fn index_listed(&mut self) {
        self.simulator.contacts.index_listed();
    }

    fn register_unless_listed(&mut self, geom1: GeomId, geom2: GeomId) {
        if self.is_filtered
            && !self.simulator.contacts.is_listed(geom1, geom2)
            && !self.simulator.accepts_pair(&mut self.handler, geom1, geom2)
        {
            return;
        }
        let PhysicsSimulator { contacts, objects, settings, .. } = &mut *self.simulator;
        contacts.add_arbiter_unless_listed(&objects.geoms, settings.friction_type, geom1, geom2);
    }
}
