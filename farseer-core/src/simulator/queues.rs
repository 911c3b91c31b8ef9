//! How things enter and leave the simulation (behaviour chapter 04, section 2).
//!
//! Additions are processed before removals; geoms before bodies, controllers, joints and springs. So an object that is
//! removed and added again between two updates ends up removed, as in the original.

use serde::{Deserialize, Serialize};

use super::PhysicsSimulator;
use crate::arena::Arena;
use crate::body::{BodyId, Pose};
use crate::body_entry::BodyEntry;
use crate::events::{Context, Event, EventHandler, Notice};
use crate::geom::GeomId;
use crate::geom_entry::GeomEntry;
use crate::methods::NarrowPhaseCollider;
use crate::object_id::ObjectId;
use crate::pair_filter::is_valid_pair;
use crate::{Error, Result};

/// What waits for the next update.
#[derive(Debug, Clone, Default, Serialize, Deserialize)]
pub(super) struct Queues {
    pub(super) added_geoms: Vec<GeomId>,
    pub(super) added_bodies: Vec<BodyId>,
    pub(super) removed_geoms: Vec<GeomId>,
    pub(super) removed_bodies: Vec<BodyId>,
    /// Their ids go stale with the next update.
    pub(super) disposed_geoms: Vec<GeomId>,
    pub(super) disposed_bodies: Vec<BodyId>,
}

/// How often callbacks are told of what callbacks did.
const MAX_ROUNDS: usize = 16;

/// The handler of an update, if there is one.
pub(super) type Handler<'a, 'h> = &'a mut Option<&'h mut dyn EventHandler>;

/// What became of moving the geoms of a body.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Followed {
    Yes,
    /// A box would not have been finite.
    PutBack {
        disabled: bool,
    },
}

/// Moves the geoms of a body to a pose, and answers whether their boxes are finite there.
fn move_geoms(entry: &BodyEntry, geoms: &mut Arena<GeomEntry>, pose: Pose, all: bool) -> bool {
    let mut are_finite = true;
    for &geom in &entry.geoms {
        let geom = &mut geoms[geom];
        if all || geom.refresh_is_due {
            geom.follow(pose.position, pose.rotation);
            are_finite &= geom.place_is_finite();
        }
    }
    are_finite
}

fn tell_rejected(events: &mut Vec<Event>, object: ObjectId, rejected: impl Iterator<Item = &'static str>) {
    events.extend(rejected.map(|argument| Event::RejectedInput { object: Some(object), argument }));
}

impl PhysicsSimulator {
    /// Lets an object take part from the next update on. Adding a body does not add its geoms.
    ///
    /// # Errors
    /// A stale id; [`Error::MissingBody`] for a joint or spring without one of its bodies.
    #[doc(alias = "Add")]
    pub fn add(&mut self, object: impl Into<ObjectId>) -> Result<()> {
        match object.into() {
            ObjectId::Body(body) => {
                let entry = self.bodies.get_mut(body).ok_or(Error::StaleId { argument: "body" })?;
                if !std::mem::replace(&mut entry.is_queued, true) {
                    self.queues.added_bodies.push(body);
                }
            }
            ObjectId::Geom(geom) => {
                let entry = self.geoms.get_mut(geom).ok_or(Error::StaleId { argument: "geom" })?;
                if !std::mem::replace(&mut entry.is_queued, true) {
                    self.queues.added_geoms.push(geom);
                }
            }
            ObjectId::Controller(controller) => self.controllers.add("controller", controller)?,
            ObjectId::Joint(joint) => {
                self.check_joint_bodies(joint)?;
                self.joints.add("joint", joint)?;
            }
            ObjectId::Spring(spring) => {
                self.check_spring_bodies(spring)?;
                self.springs.add("spring", spring)?;
            }
        }
        Ok(())
    }

    /// Takes an object out of the simulation with the next update; it stays alive and may be added again.
    /// Removing a body does not remove its geoms: they go on colliding, and the body is no longer moved.
    ///
    /// # Errors
    /// A stale id.
    #[doc(alias = "Remove")]
    pub fn remove(&mut self, object: impl Into<ObjectId>) -> Result<()> {
        match object.into() {
            ObjectId::Body(body) => {
                self.bodies.get(body).ok_or(Error::StaleId { argument: "body" })?;
                self.queues.removed_bodies.push(body);
            }
            ObjectId::Geom(geom) => {
                self.geoms.get(geom).ok_or(Error::StaleId { argument: "geom" })?;
                self.queues.removed_geoms.push(geom);
            }
            ObjectId::Controller(controller) => self.controllers.remove("controller", controller)?,
            ObjectId::Joint(joint) => self.joints.remove("joint", joint)?,
            ObjectId::Spring(spring) => self.springs.remove("spring", spring)?,
        }
        Ok(())
    }

    /// Ends the life of an object: it leaves the simulation and its id goes stale with the next update. The
    /// geoms of a body are disposed with it.
    ///
    /// # Errors
    /// A stale id.
    #[doc(alias = "Dispose")]
    pub fn dispose(&mut self, object: impl Into<ObjectId>) -> Result<()> {
        match object.into() {
            ObjectId::Body(body) => {
                let entry = self.bodies.get_mut(body).ok_or(Error::StaleId { argument: "body" })?;
                if !std::mem::replace(&mut entry.is_disposed, true) {
                    self.queues.disposed_bodies.push(body);
                }
                self.pending.push(Notice::BodyDisposed { body });
                for geom in std::mem::take(&mut self.bodies[body].geoms) {
                    self.dispose_geom(geom);
                }
            }
            ObjectId::Geom(geom) => {
                let entry = self.geoms.get(geom).ok_or(Error::StaleId { argument: "geom" })?;
                let body = entry.body;
                self.bodies[body].detach(geom);
                self.dispose_geom(geom);
            }
            ObjectId::Controller(controller) => self.controllers.dispose("controller", controller)?,
            ObjectId::Joint(joint) => self.joints.dispose("joint", joint)?,
            ObjectId::Spring(spring) => self.springs.dispose("spring", spring)?,
        }
        Ok(())
    }

    fn dispose_geom(&mut self, geom: GeomId) {
        let entry = &mut self.geoms[geom];
        if std::mem::replace(&mut entry.is_disposed, true) {
            return;
        }
        if self.settings.narrow_phase == NarrowPhaseCollider::DistanceGrid {
            entry.grid = None;
        }
        self.queues.disposed_geoms.push(geom);
    }

    /// Lets everything that waits enter or leave now, without a step.
    #[doc(alias = "ProcessAddedAndRemoved")]
    pub fn process_added_and_removed(&mut self) {
        self.process_all_queues(&mut None);
    }

    pub(super) fn process_all_queues(&mut self, handler: Handler) {
        // Ids go stale below.
        self.solver.close();
        self.settle_edits(handler);
        let has_new_links = self.joints.has_added() || self.springs.has_added();
        self.process_added(handler);
        self.process_removed(handler);
        self.validate(has_new_links, handler);
        self.process_disposed(handler);
        let (geoms, bodies) = (&self.geoms, &self.bodies);
        self.arbiters.remove_where(
            |arbiter| !arbiter.geoms.is_some_and(|(a, b)| is_valid_pair(&geoms[a], &geoms[b], bodies)),
            |_, _| {},
        );
        self.free_disposed();
    }

    /// Notes an event and tells the handler.
    fn tell_added(&mut self, object: ObjectId, handler: Handler) {
        self.events.push(Event::Added { object });
        if let Some(handler) = handler {
            handler.on_added(object);
        }
    }

    fn tell_removed(&mut self, object: ObjectId, handler: Handler) {
        self.events.push(Event::Removed { object });
        if let Some(handler) = handler {
            handler.on_removed(object);
        }
    }

    fn process_added(&mut self, handler: Handler) {
        for geom in std::mem::take(&mut self.queues.added_geoms) {
            let Some(entry) = self.geoms.get_mut(geom) else { continue };
            entry.is_queued = false;
            if !std::mem::replace(&mut entry.is_listed, true) {
                entry.in_simulation = true;
                self.geom_list.push(geom);
                self.tell_added(geom.into(), handler);
                self.broad_phase.add(geom, &self.geoms);
            }
        }
        for body in std::mem::take(&mut self.queues.added_bodies) {
            let Some(entry) = self.bodies.get_mut(body) else { continue };
            entry.is_queued = false;
            if !std::mem::replace(&mut entry.is_listed, true) {
                self.body_list.push(body);
                self.tell_added(body.into(), handler);
            }
        }
        for controller in self.controllers.process_added() {
            self.tell_added(controller.into(), handler);
        }
        for joint in self.joints.process_added() {
            self.tell_added(joint.into(), handler);
        }
        for spring in self.springs.process_added() {
            self.tell_added(spring.into(), handler);
        }
    }

    fn process_removed(&mut self, handler: Handler) {
        let removed = std::mem::take(&mut self.queues.removed_geoms);
        for &geom in &removed {
            let Some(entry) = self.geoms.get_mut(geom) else { continue };
            entry.in_simulation = false;
            entry.is_listed = false;
            self.tell_removed(geom.into(), handler);
        }
        if !removed.is_empty() {
            self.geom_list.retain(|&geom| self.geoms[geom].is_listed);
            self.arbiters.remove_arbiters_of(&removed);
            self.broad_phase.retain(|geom| geom.in_simulation, &self.geoms);
        }
        let removed = std::mem::take(&mut self.queues.removed_bodies);
        for &body in &removed {
            let Some(entry) = self.bodies.get_mut(body) else { continue };
            entry.is_listed = false;
            self.tell_removed(body.into(), handler);
        }
        if !removed.is_empty() {
            self.body_list.retain(|&body| self.bodies[body].is_listed);
        }
        for controller in self.controllers.process_removed() {
            self.tell_removed(controller.into(), handler);
        }
        for joint in self.joints.process_removed() {
            self.tell_removed(joint.into(), handler);
        }
        for spring in self.springs.process_removed() {
            self.tell_removed(spring.into(), handler);
        }
    }

    /// Joints and springs whose body is gone are disposed, and the game's own controllers may look after theirs.
    fn validate(&mut self, has_new_links: bool, handler: Handler) {
        self.validate_controllers(handler);
        if has_new_links || !self.queues.disposed_bodies.is_empty() {
            self.dispose_joints_without_body();
            self.dispose_springs_without_body();
        }
    }

    /// Takes what was disposed out of the lists, in list order.
    fn process_disposed(&mut self, handler: Handler) {
        // Geoms that were attached to a body after it was disposed go with it.
        for index in 0..self.queues.disposed_bodies.len() {
            let body = self.queues.disposed_bodies[index];
            for geom in std::mem::take(&mut self.bodies[body].geoms) {
                self.dispose_geom(geom);
            }
        }
        if !self.queues.disposed_geoms.is_empty() {
            let leaving: Vec<GeomId> =
                self.geom_list.iter().copied().filter(|&geom| self.geoms[geom].is_disposed).collect();
            self.geom_list.retain(|&geom| !self.geoms[geom].is_disposed);
            for &geom in &leaving {
                self.tell_removed(geom.into(), handler);
            }
            if !leaving.is_empty() {
                self.broad_phase.retain(|geom| !geom.is_disposed, &self.geoms);
            }
        }
        if !self.queues.disposed_bodies.is_empty() {
            let leaving: Vec<BodyId> =
                self.body_list.iter().copied().filter(|&body| self.bodies[body].is_disposed).collect();
            self.body_list.retain(|&body| !self.bodies[body].is_disposed);
            for &body in &leaving {
                self.tell_removed(body.into(), handler);
            }
        }
        for controller in self.controllers.process_disposed() {
            self.tell_removed(controller.into(), handler);
        }
        for spring in self.springs.process_disposed() {
            self.tell_removed(spring.into(), handler);
        }
        for joint in self.joints.process_disposed() {
            self.tell_removed(joint.into(), handler);
        }
    }

    /// The ids of what was disposed go stale. No list names them any more.
    fn free_disposed(&mut self) {
        let mut bodies = Vec::new();
        for geom in std::mem::take(&mut self.queues.disposed_geoms) {
            let body = self.geoms.remove(geom).map(|entry| entry.body);
            let has_geoms = |&body: &BodyId| self.bodies.get(body).is_some_and(|body| !body.geoms.is_empty());
            bodies.extend(body.filter(has_geoms));
        }
        // They may have been attached to other bodies after they were disposed.
        bodies.sort_unstable();
        bodies.dedup();
        for body in bodies {
            self.bodies[body].geoms.retain(|&geom| self.geoms.contains(geom));
        }
        for body in std::mem::take(&mut self.queues.disposed_bodies) {
            self.bodies.remove(body);
        }
        self.controllers.free_disposed();
        self.joints.free_disposed();
        self.springs.free_disposed();
    }

    /// Lets geoms follow bodies that were edited, and delivers what has happened meanwhile.
    ///
    /// Callbacks may edit again, which is delivered in turn. One that answers every edit with another is not called
    /// any more after some rounds; the original overflows its stack.
    #[inline]
    pub(super) fn settle_edits(&mut self, handler: Handler) {
        let is_settled = self.touched_bodies.is_empty() && self.touched_geoms.is_empty();
        if !(is_settled && self.pending.is_empty()) {
            self.settle_all_edits(handler);
        }
    }

    fn settle_all_edits(&mut self, handler: Handler) {
        for round in 0.. {
            self.settle_touched();
            if self.pending.is_empty() {
                return;
            }
            // The buffers change places, so that neither is allocated anew.
            let mut notices = std::mem::take(&mut self.delivered);
            std::mem::swap(&mut notices, &mut self.pending);
            for notice in notices.drain(..) {
                if round < MAX_ROUNDS {
                    self.deliver(notice, handler);
                } else {
                    self.deliver(notice, &mut None);
                }
            }
            self.delivered = notices;
        }
    }

    /// Bodies and geoms in the order in which they were edited.
    fn settle_touched(&mut self) {
        let mut bodies = std::mem::take(&mut self.touched_bodies);
        for body in bodies.drain(..) {
            if let Some(entry) = self.bodies.get_mut(body) {
                entry.is_touched = false;
                tell_rejected(&mut self.events, body.into(), entry.body.rejected.take());
            }
            self.settle_body(body);
        }
        self.touched_bodies = bodies;
        let mut geoms = std::mem::take(&mut self.touched_geoms);
        for geom in geoms.drain(..) {
            let Some(entry) = self.geoms.get_mut(geom) else { continue };
            entry.is_touched = false;
            tell_rejected(&mut self.events, geom.into(), entry.geom.rejected.take());
        }
        self.touched_geoms = geoms;
    }

    /// Lets geoms follow a body that was edited; what it has refused is told when all edits settle.
    pub(super) fn settle_body(&mut self, body: BodyId) {
        self.take_edited_velocity_up(body);
        let Some(entry) = self.bodies.get(body) else { return };
        if entry.pending_pose().is_some() {
            match self.let_geoms_follow(body, true) {
                Followed::Yes => self.pending.push(Notice::BodyUpdated { body }),
                Followed::PutBack { disabled } => {
                    self.pending.push(Notice::NotFinite { body, disabled });
                }
            }
        }
    }

    /// Moves the geoms of a body to its pose. Those that are there already stay, unless `all` are to be refreshed.
    ///
    /// Should the box of a geom not be finite there, the body is put back to the pose that was followed before; a
    /// dynamic one is disabled.
    pub(super) fn let_geoms_follow(&mut self, body: BodyId, all: bool) -> Followed {
        let entry = &mut self.bodies[body];
        entry.body.pose_is_dirty = false;
        let pose = entry.body.pose();
        if move_geoms(entry, &mut self.geoms, pose, all) {
            entry.followed = pose;
            return Followed::Yes;
        }
        let before = entry.followed;
        entry.body.restore_pose(before);
        move_geoms(entry, &mut self.geoms, before, true);
        let disabled = !entry.body.is_static();
        entry.body.set_enabled(entry.body.enabled() && !disabled);
        Followed::PutBack { disabled }
    }

    fn deliver(&mut self, notice: Notice, handler: Handler) {
        self.events.push(notice.into());
        let Some(handler) = handler else { return };
        let mut context = Context { simulator: self };
        match notice {
            Notice::BodyUpdated { body } => handler.on_body_updated(&mut context, body),
            Notice::BodyDisposed { body } => handler.on_body_disposed(&mut context, body),
            Notice::NotFinite { .. } => {}
        }
    }
}
