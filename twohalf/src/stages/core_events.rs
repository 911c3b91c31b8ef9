//! Adapter between the events of the core and the game's handler: it rejects pairs that are separated in depth and adds depth
//! to the events of all other pairs.

use farseer_core::depth::{DepthAxisMut, DepthHandler};
use farseer_core::{
    BodyId, Contact, EventHandler as CoreHandler, GeomId, JointId, ObjectId, PhysicsSimulator, SpringId,
};

use super::contact_filter::filter_contacts;
use super::convex_cache::ConvexCache;
use super::core_sync::{pull_depth_from_core, push_depth_to_core};
use super::depth_intervals::DepthIntervals;
use super::pairs::{ContactOwner, DepthPair, OwnerChoice, PairCache, extents_overlap, key_of};
use super::report::Report;
use crate::Vector3;
use crate::depth::{Axis, ContactTarget, DepthScheme, DepthState, World};
use crate::events::{Collision, Context, Event, EventHandler};

/// Data of the pair search of one update: depth intervals, pairs of the core and pairs of `twohalf`.
#[derive(Debug, Clone, Default)]
pub(super) struct PairContext {
    pub(super) intervals: DepthIntervals,
    /// Pairs that touched in the core in the last update, with their impulses.
    pub(super) pair_cache: PairCache,
    pub(super) convex_cache: ConvexCache,
    /// Pairs whose contacts `twohalf` finds, and not the core.
    pub(super) pairs: Vec<DepthPair>,
    /// By body slot: whether the body moved along Z and no event has reported it yet.
    pub(super) moved: Vec<bool>,
}

/// Adapter that receives the callbacks of the core and calls the event handler of the game.
pub(super) struct CoreEventAdapter<'w, 'h> {
    pub(super) world: &'w mut World,
    pub(super) report: &'w mut Report,
    pub(super) pair_context: &'w mut PairContext,
    pub(super) handler: Option<&'h mut dyn EventHandler>,
}

impl PairContext {
    /// Begins the pair search of an update: stores depth intervals and clears the pairs of `twohalf`.
    pub(super) fn prepare(&mut self, core: &PhysicsSimulator, depths: &DepthState, dt: f32) {
        self.pairs.clear();
        self.pair_cache.prepare(core);
        self.intervals.prepare(core, depths, dt);
    }
}

impl CoreEventAdapter<'_, '_> {
    /// Appends the events that the core has reported since the last call to the report of the update.
    pub(super) fn adopt_core_events(&mut self, core: &PhysicsSimulator) {
        self.report.adopt_core_events(core, &self.pair_context.pair_cache);
    }

    /// Updates the transforms of geoms whose bodies a callback has edited.
    pub(super) fn settle(&mut self, core: &mut PhysicsSimulator) {
        core.settle(Some(self));
    }

    /// Calls the game's handler, if there is one, and applies its edits.
    pub(super) fn call_handler<T>(
        &mut self,
        core: &mut PhysicsSimulator,
        call: impl FnOnce(&mut dyn EventHandler, &mut Context<'_>) -> T,
    ) -> Option<T> {
        let handler = self.handler.as_deref_mut()?;
        let answer = call(handler, &mut Context { core: core.context(), world: self.world });
        self.settle(core);
        Some(answer)
    }

    /// Calls the game's handler within a callback of the core, which applies the edits itself.
    fn call_handler_within<T>(
        &mut self,
        context: &mut farseer_core::Context<'_>,
        call: impl FnOnce(&mut dyn EventHandler, &mut Context<'_>) -> T,
    ) -> Option<T> {
        let handler = self.handler.as_deref_mut()?;
        Some(call(handler, &mut Context::within(context, self.world)))
    }

    /// Asks the game's handler about a pair with overlapping AABBs; a refusal is an event.
    fn is_approved(&mut self, context: &mut farseer_core::Context<'_>, geom1: GeomId, geom2: GeomId) -> bool {
        let ask = |handler: &mut dyn EventHandler, context: &mut Context<'_>| {
            handler.on_broad_phase_collision(context, geom1, geom2)
        };
        self.call_handler_within(context, ask).unwrap_or(true)
    }

    /// Returns whether the game's handler is asked about a pair: only if it did not touch in the last update.
    fn needs_filter(&self, pair: &DepthPair) -> bool {
        self.handler.as_deref().is_some_and(|handler| handler.handles_broad_phase())
            && self.pair_context.pair_cache.impulse(pair.key).is_none()
            && self.world.touches.find(pair.key).is_none()
    }

    fn owner_of(&mut self, core: &PhysicsSimulator, pair: DepthPair) -> ContactOwner {
        let PairContext { intervals, pair_cache, convex_cache, .. } = &mut *self.pair_context;
        OwnerChoice { core, world: self.world, intervals, pair_cache, convex_cache }.owner_of(pair)
    }

    /// The collision of contacts that the core has found, as one of the two geoms sees it. The impulse is
    /// that of the last update. `None` if no contact has finite numbers.
    fn collision(
        &self,
        core: &PhysicsSimulator,
        pair: &DepthPair,
        this: GeomId,
        contacts: &[Contact],
    ) -> Option<Collision> {
        let mut finite = contacts.iter().filter(|contact| is_finite(contact));
        let deepest = finite.next()?;
        // The core's normals point to the younger geom.
        let (sign, other) = if pair.geom_b == this { (1.0, pair.geom_a) } else { (-1.0, pair.geom_b) };
        let z = self.world.depths.middle(core, this, other);
        Some(Collision {
            this,
            partner: ContactTarget::Geom(other),
            axis: Axis::Plane,
            normal: Vector3::new(sign * deepest.normal.x, -sign * deepest.normal.y, 0.0),
            position: Vector3::new(deepest.position.x, -deepest.position.y, z),
            contacts: 1 + finite.count() as u32,
            normal_impulse: self.pair_context.pair_cache.impulse(pair.key).unwrap_or(0.0),
            vetoed: false,
        })
    }
}

fn is_finite(contact: &Contact) -> bool {
    let Contact { position, normal, separation, .. } = contact;
    [position.x, position.y, normal.x, normal.y, *separation].iter().all(|number| number.is_finite())
}

impl CoreHandler for CoreEventAdapter<'_, '_> {
    fn filters_pairs(&self) -> bool {
        true
    }

    fn handles_broad_phase(&self) -> bool {
        // The other schemes ask where depths overlap: see `accepts_pair`.
        self.world.scheme == DepthScheme::Precise
            && self.handler.as_ref().is_some_and(|handler| handler.handles_broad_phase())
    }

    fn on_broad_phase_collision(
        &mut self,
        context: &mut farseer_core::Context<'_>,
        geom1: GeomId,
        geom2: GeomId,
    ) -> bool {
        let accepted = self.is_approved(context, geom1, geom2);
        if self.handler.is_some() {
            push_depth_to_core(&mut DepthAxisMut::within(context), self.world, self.report);
        }
        if !accepted {
            self.report.events.push(Event::BroadPhaseVeto { geom1, geom2 });
        }
        accepted
    }

    fn accepts_pair(
        &mut self,
        context: &mut farseer_core::Context<'_>,
        geom1: GeomId,
        geom2: GeomId,
    ) -> bool {
        if !extents_overlap(self.pair_context.intervals.of(geom1), self.pair_context.intervals.of(geom2)) {
            // The two pass each other at different depths.
            return false;
        }
        let Some(pair) = key_of(context.simulator(), geom1, geom2) else { return false };
        let owner = self.owner_of(context.simulator(), pair);
        if self.needs_filter(&pair) && !self.is_approved(context, geom1, geom2) {
            self.report.events.push(Event::BroadPhaseVeto { geom1, geom2 });
            return false;
        }
        if owner == ContactOwner::Space {
            self.pair_context.pairs.push(pair);
        }
        owner == ContactOwner::Plane
    }

    fn on_collision(
        &mut self,
        context: &mut farseer_core::Context<'_>,
        this: GeomId,
        other: GeomId,
        contacts: &mut Vec<Contact>,
    ) -> bool {
        let pair = key_of(context.simulator(), this, other);
        let collision = pair.and_then(|pair| self.collision(context.simulator(), &pair, this, contacts));
        let told = collision.and_then(|collision| {
            self.call_handler_within(context, |handler, context| handler.on_collision(context, &collision))
        });
        let accepted = told.unwrap_or(true);
        let is_younger = pair.is_some_and(|pair| pair.geom_b == this);
        let decided = collision.map(|collision| Collision { vetoed: !accepted, ..collision });
        self.report.record_collision(decided, is_younger);
        accepted
    }

    fn on_separation(&mut self, context: &mut farseer_core::Context<'_>, this: GeomId, other: GeomId) {
        if self.pair_context.pair_cache.touched_in_core(context.simulator(), this, other) {
            let partner = ContactTarget::Geom(other);
            self.call_handler_within(context, |handler, context| {
                handler.on_separation(context, this, partner)
            });
        }
    }

    fn on_body_updated(&mut self, context: &mut farseer_core::Context<'_>, body: BodyId) {
        if let Some(moved) = self.pair_context.moved.get_mut(body.slot()) {
            // This event reports the motion along Z as well.
            *moved = false;
        }
        self.call_handler_within(context, |handler, context| handler.on_body_updated(context, body));
    }

    fn on_body_disposed(&mut self, context: &mut farseer_core::Context<'_>, body: BodyId) {
        self.call_handler_within(context, |handler, context| handler.on_body_disposed(context, body));
    }

    fn on_joint_broke(&mut self, context: &mut farseer_core::Context<'_>, joint: JointId) {
        if self
            .call_handler_within(context, |handler, context| handler.on_joint_broke(context, joint))
            .is_some()
        {
            push_depth_to_core(&mut DepthAxisMut::within(context), self.world, self.report);
        }
    }

    fn on_spring_broke(&mut self, context: &mut farseer_core::Context<'_>, spring: SpringId) {
        if self
            .call_handler_within(context, |handler, context| handler.on_spring_broke(context, spring))
            .is_some()
        {
            push_depth_to_core(&mut DepthAxisMut::within(context), self.world, self.report);
        }
    }

    fn on_added(&mut self, object: ObjectId) {
        if let Some(handler) = &mut self.handler {
            handler.on_added(object);
        }
    }

    fn on_removed(&mut self, object: ObjectId) {
        if let Some(handler) = &mut self.handler {
            handler.on_removed(object);
        }
    }
}

impl DepthHandler for CoreEventAdapter<'_, '_> {
    fn on_contacts(&mut self, context: &mut farseer_core::Context<'_>) -> Vec<usize> {
        match &mut self.handler {
            Some(handler) => filter_contacts(&mut **handler, context, self.world, self.report),
            None => Vec::new(),
        }
    }

    fn on_moved(&mut self, context: &mut farseer_core::Context<'_>) {
        pull_depth_from_core(context.simulator(), self.world);
    }

    fn on_silent_collision(
        &mut self,
        simulator: &PhysicsSimulator,
        this: GeomId,
        other: GeomId,
        contacts: &[Contact],
    ) {
        let pair = key_of(simulator, this, other);
        let collision = pair.and_then(|pair| self.collision(simulator, &pair, this, contacts));
        self.report.record_collision(collision, pair.is_some_and(|pair| pair.geom_b == this));
    }
}
