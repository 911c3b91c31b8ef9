//! What stands between the 2D engine and the game's handler: sorts out what is apart in depth, and tells the rest with its depth.

use farseer_core::{
    BodyId, Contact, EventHandler as CoreHandler, GeomId, JointId, ObjectId, PhysicsSimulator, SpringId,
};

use super::ask::ask_about_touches;
use super::exchange::{read_depths, tell_depths};
use super::outlines::Outlines;
use super::pairs::{Chooser, KnownPairs, SpacePair, Way, extents_overlap, key_of};
use super::reach::Reaches;
use super::report::Report;
use crate::Vector3;
use crate::depth::{Axis, DepthScheme, Depths, Partner, World};
use crate::events::{Collision, Context, Event, EventHandler};

/// What is worked with while things meet.
#[derive(Debug, Clone, Default)]
pub(super) struct Meeting {
    pub(super) reaches: Reaches,
    /// Pairs that the 2D engine solved in the last update.
    pub(super) known: KnownPairs,
    pub(super) outlines: Outlines,
    /// Pairs whose contacts this engine looks for.
    pub(super) pairs: Vec<SpacePair>,
    /// By body slot: whether the body moved along Z and nobody was told yet.
    pub(super) moved: Vec<bool>,
}

/// Stands between the 2D engine and the game's handler.
pub(super) struct PlaneHandler<'w, 'h> {
    pub(super) world: &'w mut World,
    pub(super) report: &'w mut Report,
    pub(super) meeting: &'w mut Meeting,
    pub(super) handler: Option<&'h mut dyn EventHandler>,
}

impl Meeting {
    /// An update begins to look for pairs.
    pub(super) fn prepare(&mut self, core: &PhysicsSimulator, depths: &Depths, dt: f32) {
        self.pairs.clear();
        self.known.prepare(core);
        self.reaches.prepare(core, depths, dt);
    }
}

impl PlaneHandler<'_, '_> {
    /// Takes over what the 2D engine has reported since the last time.
    pub(super) fn take_events(&mut self, core: &PhysicsSimulator) {
        self.report.take_events(core, &self.meeting.known);
    }

    /// Lets geoms follow bodies that a callback has edited.
    pub(super) fn settle(&mut self, core: &mut PhysicsSimulator) {
        core.settle(Some(self));
    }

    /// Tells the game's handler, if there is one, and settles what it has edited.
    pub(super) fn tell<T>(
        &mut self,
        core: &mut PhysicsSimulator,
        tell: impl FnOnce(&mut dyn EventHandler, &mut Context<'_>) -> T,
    ) -> Option<T> {
        let handler = self.handler.as_deref_mut()?;
        let answer = tell(handler, &mut Context { core: core.context(), world: self.world });
        self.settle(core);
        Some(answer)
    }

    /// As [`tell`](Self::tell), but for what the 2D engine settles.
    fn tell_within<T>(
        &mut self,
        context: &mut farseer_core::Context<'_>,
        tell: impl FnOnce(&mut dyn EventHandler, &mut Context<'_>) -> T,
    ) -> Option<T> {
        let handler = self.handler.as_deref_mut()?;
        Some(tell(handler, &mut Context::within(context, self.world)))
    }

    /// Asks the game's handler about two geoms whose boxes overlap; a refusal is an event.
    fn is_approved(&mut self, context: &mut farseer_core::Context<'_>, geom1: GeomId, geom2: GeomId) -> bool {
        let ask = |handler: &mut dyn EventHandler, context: &mut Context<'_>| {
            handler.on_broad_phase_collision(context, geom1, geom2)
        };
        self.tell_within(context, ask).unwrap_or(true)
    }

    /// Whether the game's handler is to be asked about a pair: not if it touched in the last update.
    fn is_asked_about(&self, pair: &SpacePair) -> bool {
        self.handler.as_deref().is_some_and(|handler| handler.handles_broad_phase())
            && self.meeting.known.impulse(pair.key).is_none()
            && self.world.touches.find(pair.key).is_none()
    }

    fn way_of(&mut self, core: &PhysicsSimulator, pair: SpacePair) -> Way {
        let Meeting { reaches, known, outlines, .. } = &mut *self.meeting;
        Chooser { core, world: self.world, reaches, known, outlines }.way_of(pair)
    }

    /// What a game is told of contacts that the 2D engine has found, seen by one of the two. The impulse is that of the last
    /// update. None if no contact has finite numbers.
    fn collision(
        &self,
        core: &PhysicsSimulator,
        pair: &SpacePair,
        this: GeomId,
        contacts: &[Contact],
    ) -> Option<Collision> {
        let mut finite = contacts.iter().filter(|contact| is_finite(contact));
        let deepest = finite.next()?;
        // The 2D engine's normals point to the younger geom.
        let (sign, other) = if pair.geom_b == this { (1.0, pair.geom_a) } else { (-1.0, pair.geom_b) };
        let z = self.world.depths.middle(core, this, other);
        Some(Collision {
            this,
            partner: Partner::Geom(other),
            axis: Axis::Plane,
            normal: Vector3::new(sign * deepest.normal.x, -sign * deepest.normal.y, 0.0),
            position: Vector3::new(deepest.position.x, -deepest.position.y, z),
            contacts: 1 + finite.count() as u32,
            normal_impulse: self.meeting.known.impulse(pair.key).unwrap_or(0.0),
            vetoed: false,
        })
    }
}

fn is_finite(contact: &Contact) -> bool {
    let Contact { position, normal, separation, .. } = contact;
    [position.x, position.y, normal.x, normal.y, *separation].iter().all(|number| number.is_finite())
}

impl CoreHandler for PlaneHandler<'_, '_> {
    fn filters_pairs(&self) -> bool {
        true
    }

    fn handles_broad_phase(&self) -> bool {
        // Otherwise it is asked where depths overlap: see `accepts_pair`.
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
            tell_depths(context.simulator_mut(), self.world, self.report);
        }
        if !accepted {
            self.report.events.push(Event::BroadPhaseVeto { geom1, geom2 });
        }
        accepted
    }

    fn on_space_moved(&mut self, context: &mut farseer_core::Context<'_>) {
        read_depths(context.simulator(), self.world);
    }

    fn on_space_touches(&mut self, context: &mut farseer_core::Context<'_>) -> Vec<usize> {
        match &mut self.handler {
            Some(handler) => ask_about_touches(&mut **handler, context, self.world, self.report),
            None => Vec::new(),
        }
    }

    fn accepts_pair(
        &mut self,
        context: &mut farseer_core::Context<'_>,
        geom1: GeomId,
        geom2: GeomId,
    ) -> bool {
        if !extents_overlap(self.meeting.reaches.of(geom1), self.meeting.reaches.of(geom2)) {
            // They pass each other at different depths.
            return false;
        }
        let Some(pair) = key_of(context.simulator(), geom1, geom2) else { return false };
        let way = self.way_of(context.simulator(), pair);
        if self.is_asked_about(&pair) && !self.is_approved(context, geom1, geom2) {
            self.report.events.push(Event::BroadPhaseVeto { geom1, geom2 });
            return false;
        }
        if way == Way::Space {
            self.meeting.pairs.push(pair);
        }
        way == Way::Plane
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
            self.tell_within(context, |handler, context| handler.on_collision(context, &collision))
        });
        let accepted = told.unwrap_or(true);
        let is_younger = pair.is_some_and(|pair| pair.geom_b == this);
        let decided = collision.map(|collision| Collision { vetoed: !accepted, ..collision });
        self.report.decide(decided, is_younger);
        accepted
    }

    fn on_untold_collision(
        &mut self,
        simulator: &PhysicsSimulator,
        this: GeomId,
        other: GeomId,
        contacts: &[Contact],
    ) {
        let pair = key_of(simulator, this, other);
        let collision = pair.and_then(|pair| self.collision(simulator, &pair, this, contacts));
        self.report.decide(collision, pair.is_some_and(|pair| pair.geom_b == this));
    }

    fn on_separation(&mut self, context: &mut farseer_core::Context<'_>, this: GeomId, other: GeomId) {
        if self.meeting.known.have_touched(context.simulator(), this, other) {
            let partner = Partner::Geom(other);
            self.tell_within(context, |handler, context| handler.on_separation(context, this, partner));
        }
    }

    fn on_body_updated(&mut self, context: &mut farseer_core::Context<'_>, body: BodyId) {
        if let Some(moved) = self.meeting.moved.get_mut(body.slot()) {
            // Along Z as well: it is told once.
            *moved = false;
        }
        self.tell_within(context, |handler, context| handler.on_body_updated(context, body));
    }

    fn on_body_disposed(&mut self, context: &mut farseer_core::Context<'_>, body: BodyId) {
        self.tell_within(context, |handler, context| handler.on_body_disposed(context, body));
    }

    fn on_joint_broke(&mut self, context: &mut farseer_core::Context<'_>, joint: JointId) {
        if self.tell_within(context, |handler, context| handler.on_joint_broke(context, joint)).is_some() {
            tell_depths(context.simulator_mut(), self.world, self.report);
        }
    }

    fn on_spring_broke(&mut self, context: &mut farseer_core::Context<'_>, spring: SpringId) {
        if self.tell_within(context, |handler, context| handler.on_spring_broke(context, spring)).is_some() {
            tell_depths(context.simulator_mut(), self.world, self.report);
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
