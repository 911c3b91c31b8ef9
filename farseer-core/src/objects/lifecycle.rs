//! Lifecycle of objects: creation, entry into the simulation, removal, disposal (behaviour chapter 04, section 2).
//!
//! Additions are processed before removals; geoms before bodies, controllers, joints and springs. So an object that is
//! removed and added again between two updates ends up removed, as in the original.

use super::Objects;
use crate::Result;
use crate::body::BodyId;
use crate::body::missing_body::check_bodies;
use crate::geom::GeomId;
use crate::object_id::ObjectId;
use crate::report::PendingEvent;
use crate::storage::arena::Id as _;
use crate::storage::collection::LifecycleState;
use crate::storage::order::sort_by_number;

/// Requests of the game; the next update carries them out.
impl Objects {
    /// Makes an object take part from the next update on. Adding a body does not add its geoms.
    ///
    /// # Errors
    /// A stale id. [`Error::MissingBody`](crate::Error::MissingBody) for a joint or spring without one of its bodies.
    /// [`Error::NotSupported`](crate::Error::NotSupported) under the faithful methods: a body with locked axes, a chain, a one-way
    /// geom. Of joints: a prismatic, wheel, angle spring, motor, gear or pulley joint; bodies that do not collide; a motor, servo or
    /// limits of a revolute joint.
    #[doc(alias = "Add")]
    pub fn add(&mut self, object: impl Into<ObjectId>) -> Result<()> {
        match object.into() {
            ObjectId::Body(body) => {
                self.methods.check_body(&self.bodies.find("body", body)?.body)?;
                self.bodies.add("body", body)?;
            }
            ObjectId::Geom(geom) => {
                self.methods.check_geom(self.geoms.find("geom", geom)?)?;
                self.geoms.add("geom", geom)?;
            }
            ObjectId::Controller(controller) => self.controllers.add("controller", controller)?,
            ObjectId::Joint(joint) => {
                let added_joint = self.joints.find("joint", joint)?;
                check_bodies("joint", added_joint.body1(), added_joint.body2())?;
                self.methods.check_joint(added_joint)?;
                self.joints.add("joint", joint)?;
            }
            ObjectId::Spring(spring) => {
                let pulled = self.springs.find("spring", spring)?;
                check_bodies("spring", pulled.body1(), pulled.body2())?;
                self.springs.add("spring", spring)?;
            }
        }
        Ok(())
    }

    /// Removes an object from the simulation with the next update; it stays alive and may be added again. Removing a
    /// body does not remove its geoms: they still collide, and the body is no longer moved.
    ///
    /// # Errors
    /// A stale id.
    #[doc(alias = "Remove")]
    pub fn remove(&mut self, object: impl Into<ObjectId>) -> Result<()> {
        match object.into() {
            ObjectId::Body(body) => self.bodies.remove("body", body)?,
            ObjectId::Geom(geom) => self.geoms.remove("geom", geom)?,
            ObjectId::Controller(controller) => self.controllers.remove("controller", controller)?,
            ObjectId::Joint(joint) => self.joints.remove("joint", joint)?,
            ObjectId::Spring(spring) => self.springs.remove("spring", spring)?,
        }
        Ok(())
    }

    /// Disposes an object: with the next update it leaves the simulation and its id goes stale. The geoms of a body are
    /// disposed with it.
    ///
    /// # Errors
    /// A stale id.
    #[doc(alias = "Dispose")]
    pub fn dispose(&mut self, object: impl Into<ObjectId>) -> Result<()> {
        match object.into() {
            ObjectId::Body(body) => {
                self.bodies.dispose("body", body)?;
                self.pending.push(PendingEvent::BodyDisposed { body });
                self.dispose_geoms_of(body);
            }
            ObjectId::Geom(geom) => {
                let body = self.geoms.find("geom", geom)?.body;
                self.bodies[body].detach(geom);
                self.dispose_geom(geom);
            }
            ObjectId::Controller(controller) => self.controllers.dispose("controller", controller)?,
            ObjectId::Joint(joint) => {
                self.joints.dispose("joint", joint)?;
                self.has_edited_joints = true;
            }
            ObjectId::Spring(spring) => self.springs.dispose("spring", spring)?,
        }
        Ok(())
    }

    /// Whether an object is in its list now; false for a stale id. Objects enter and leave their lists with updates.
    pub fn is_listed(&self, object: impl Into<ObjectId>) -> bool {
        self.lifecycle_state(object.into()).is_some_and(|life| life.is_listed)
    }

    /// Whether an object was disposed, and will be or has been removed: true for every stale id.
    #[doc(alias = "IsDisposed")]
    pub fn is_disposed(&self, object: impl Into<ObjectId>) -> bool {
        self.lifecycle_state(object.into()).is_none_or(|life| life.is_disposed)
    }

    fn lifecycle_state(&self, object: ObjectId) -> Option<LifecycleState> {
        match object {
            ObjectId::Body(body) => self.bodies.lifecycle_state(body),
            ObjectId::Geom(geom) => self.geoms.lifecycle_state(geom),
            ObjectId::Controller(controller) => self.controllers.lifecycle_state(controller),
            ObjectId::Joint(joint) => self.joints.lifecycle_state(joint),
            ObjectId::Spring(spring) => self.springs.lifecycle_state(spring),
        }
    }

    fn dispose_geoms_of(&mut self, body: BodyId) {
        for geom in std::mem::take(&mut self.bodies[body].geoms) {
            self.dispose_geom(geom);
        }
    }

    fn dispose_geom(&mut self, geom: GeomId) {
        if self.geoms.is_disposed(geom) {
            return;
        }
        if self.methods.narrow().uses_grids() {
            self.geoms[geom].grid = None;
        }
        let Ok(()) = self.geoms.dispose("geom", geom) else { unreachable!("it is there") };
    }
}

/// The work of an update. Every object that enters or leaves a list is reported, in order.
impl Objects {
    /// Whether joints or springs are waiting to enter.
    pub(crate) fn has_new_links(&self) -> bool {
        self.joints.has_added() || self.springs.has_added()
    }

    /// Moves added objects into their lists. Returns the geoms among them.
    pub(crate) fn process_added(&mut self, mut report: impl FnMut(ObjectId)) -> Vec<GeomId> {
        let are_renumbered = [self.geoms.renumber_if_exhausted(), self.bodies.renumber_if_exhausted()];
        self.has_new_structure |= are_renumbered.contains(&true);
        self.controllers.renumber_if_exhausted();
        self.joints.renumber_if_exhausted();
        self.springs.renumber_if_exhausted();
        let entered = self.geoms.process_added();
        for &geom in &entered {
            self.geoms[geom].in_simulation = true;
            report(geom.into());
        }
        let bodies = self.bodies.process_added();
        self.note_new_members(&bodies, &entered);
        bodies.into_iter().for_each(|body| report(body.into()));
        self.controllers.process_added().into_iter().for_each(|controller| report(controller.into()));
        let joints = self.joints.process_added();
        self.has_edited_joints |= !joints.is_empty();
        joints.into_iter().for_each(|joint| report(joint.into()));
        self.springs.process_added().into_iter().for_each(|spring| report(spring.into()));
        entered
    }

    /// Moves removed objects out of their lists. Returns the geoms that were to be removed.
    pub(crate) fn process_removed(&mut self, mut report: impl FnMut(ObjectId)) -> Vec<GeomId> {
        let left = self.geoms.process_removed();
        for &geom in &left {
            self.geoms[geom].in_simulation = false;
            report(geom.into());
        }
        let bodies = self.bodies.process_removed();
        self.note_new_members(&bodies, &left);
        bodies.into_iter().for_each(|body| report(body.into()));
        self.controllers.process_removed().into_iter().for_each(|controller| report(controller.into()));
        let joints = self.joints.process_removed();
        self.has_edited_joints |= !joints.is_empty();
        joints.into_iter().for_each(|joint| report(joint.into()));
        self.springs.process_removed().into_iter().for_each(|spring| report(spring.into()));
        left
    }

    /// Notes bodies and geoms that have entered or left their lists.
    fn note_new_members(&mut self, bodies: &[BodyId], geoms: &[GeomId]) {
        self.has_new_members |= !(geoms.is_empty() && bodies.is_empty());
        self.new_members.bodies.extend_from_slice(bodies);
        self.new_members.geoms.extend_from_slice(geoms);
    }

    /// Whether an object was added, removed or disposed since the last update.
    pub(crate) fn has_queued(&self) -> bool {
        self.geoms.has_queued()
            || self.bodies.has_queued()
            || self.controllers.has_queued()
            || self.joints.has_queued()
            || self.springs.has_queued()
    }

    /// Moves disposed objects out of their lists, in list order. Returns the geoms among them.
    pub(crate) fn process_disposed(&mut self, mut report: impl FnMut(ObjectId)) -> Vec<GeomId> {
        // Geoms that were attached to a body after it was disposed are disposed with it.
        for index in 0..self.bodies.disposed().len() {
            self.dispose_geoms_of(self.bodies.disposed()[index]);
        }
        let left = self.geoms.process_disposed();
        left.iter().for_each(|&geom| report(geom.into()));
        let bodies = self.bodies.process_disposed();
        self.note_new_members(&bodies, &left);
        bodies.into_iter().for_each(|body| report(body.into()));
        self.controllers.process_disposed().into_iter().for_each(|controller| report(controller.into()));
        self.springs.process_disposed().into_iter().for_each(|spring| report(spring.into()));
        let joints = self.joints.process_disposed();
        self.has_edited_joints |= !joints.is_empty();
        joints.into_iter().for_each(|joint| report(joint.into()));
        left
    }

    /// Disposes joints and springs whose body is disposed or does not exist any more.
    pub(crate) fn dispose_links_without_body(&mut self) {
        let bodies = &self.bodies;
        let is_gone = |body1: BodyId, body2: Option<BodyId>| {
            std::iter::once(body1).chain(body2).any(|body| bodies.is_disposed(body))
        };
        self.joints.dispose_listed_where(|joint| is_gone(joint.body1(), joint.body2()));
        self.springs.dispose_listed_where(|spring| is_gone(spring.body1(), spring.body2()));
    }

    /// Makes the ids of disposed objects stale. No list contains them any more.
    pub(crate) fn free_disposed(&mut self) {
        let has_geoms = |body: &BodyId| self.bodies.get(*body).is_some_and(|body| !body.geoms.is_empty());
        let mut owners: Vec<BodyId> =
            self.geoms.free_disposed().into_iter().map(|geom| geom.body).filter(has_geoms).collect();
        // Geoms may have been attached to other bodies after they were disposed.
        sort_by_number(&mut owners, |owner| owner.rank());
        owners.dedup();
        for body in owners {
            self.bodies[body].geoms.retain(|&geom| self.geoms.contains(geom));
        }
        self.bodies.free_disposed();
        self.controllers.free_disposed();
        self.joints.free_disposed();
        self.springs.free_disposed();
    }

    /// Removes all objects, and all ids go stale; limits and creation numbers stay.
    pub(crate) fn clear(&mut self) {
        self.bodies.clear();
        self.geoms.clear();
        self.controllers.clear();
        self.joints.clear();
        self.springs.clear();
        self.touched_bodies.clear();
        self.touched_geoms.clear();
        self.pending.clear();
        self.new_members.clear();
        self.grids = Default::default();
    }
}
