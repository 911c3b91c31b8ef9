//! Callbacks of a game (behaviour chapters 03, 04 and 08).

use super::Context;
use crate::body::BodyId;
use crate::contacts::contact::Contact;
use crate::controllers::{ControllerId, FluidContainer};
use crate::geom::GeomId;
use crate::joints::JointId;
use crate::object_id::ObjectId;
use crate::shape::Vertices;
use crate::simulator::UserController;
use crate::springs::SpringId;

/// Callbacks of a game. Handlers belong to the game, never to the simulator, so that saving the simulator saves all its
/// state.
///
/// Callbacks are called in the original's order. Through the [`Context`] they edit bodies, geoms, joints, springs and
/// controllers at once; objects that they add, remove or dispose enter or leave with the next update.
pub trait EventHandler {
    /// Geom `this` touches `other`; called in every update in which there are contacts, for both sides unless their
    /// [callbacks](crate::Geom::set_collision_callbacks_enabled) are switched off. `false` drops the contacts of this
    /// update, and the second side is not asked. Contacts may also be removed from the list: they exert no impulse. The
    /// [`Context`] can set friction, restitution and the speed of a conveyor for this update, see
    /// [`set_contact_friction`](Context::set_contact_friction).
    ///
    /// For a sensor and a static body it is called once, when they begin to touch: there is no impulse to refuse.
    #[doc(alias("OnCollision", "CollisionEventHandler"))]
    fn on_collision(
        &mut self,
        context: &mut Context<'_>,
        this: GeomId,
        other: GeomId,
        contacts: &mut Vec<Contact>,
    ) -> bool {
        let _ = (context, this, other, contacts);
        true
    }

    /// See [`Event::Separation`](crate::Event::Separation); not for geoms whose
    /// [callbacks](crate::Geom::set_collision_callbacks_enabled) are switched off, and not for a side that was disposed.
    #[doc(alias("OnSeparation", "SeparationEventHandler"))]
    fn on_separation(&mut self, context: &mut Context<'_>, this: GeomId, other: GeomId) {
        let _ = (context, this, other);
    }

    /// Whether [`on_broad_phase_collision`](Self::on_broad_phase_collision) is to be called. With brute force and
    /// spatial hash its results then **replace** the test of the boxes, as in the original.
    fn handles_broad_phase(&self) -> bool {
        false
    }

    /// A new pair was found; `false` refuses it.
    #[doc(alias("OnBroadPhaseCollision", "BroadPhaseCollisionHandler"))]
    fn on_broad_phase_collision(&mut self, context: &mut Context<'_>, geom1: GeomId, geom2: GeomId) -> bool {
        let _ = (context, geom1, geom2);
        true
    }

    /// Whether [`accepts_pair`](Self::accepts_pair) is to be called; queried once per update.
    fn filters_pairs(&self) -> bool {
        false
    }

    /// Whether two geoms whose boxes overlap and that may collide may have contacts. Not in the original: for engines
    /// that know more about them, such as their depth in the picture.
    ///
    /// Called in every update, first for every pair that has an arbiter. A refused pair loses it, with
    /// [`on_separation`](Self::on_separation) for both sides. It is then called for every pair whose boxes overlap,
    /// after [`on_broad_phase_collision`](Self::on_broad_phase_collision); a refused pair gets no arbiter, without an
    /// event.
    ///
    /// Unlike that callback it never replaces the test of the boxes, and a pair refused in one update is asked about
    /// again in the next. It may be called more than once per update for a pair. Sweep and prune widens boxes by 0.01
    /// length units.
    fn accepts_pair(&mut self, context: &mut Context<'_>, geom1: GeomId, geom2: GeomId) -> bool {
        let _ = (context, geom1, geom2);
        true
    }

    /// See [`Event::BodyUpdated`](crate::Event::BodyUpdated).
    #[doc(alias("Updated", "UpdatedEventHandler"))]
    fn on_body_updated(&mut self, context: &mut Context<'_>, body: BodyId) {
        let _ = (context, body);
    }

    /// See [`Event::BodyDisposed`](crate::Event::BodyDisposed).
    #[doc(alias = "Disposed")]
    fn on_body_disposed(&mut self, context: &mut Context<'_>, body: BodyId) {
        let _ = (context, body);
    }

    /// A joint broke: the error found by the last pre-step is beyond its breakpoint. It is disabled already, but acts
    /// in this solver iteration. Velocities set here act at once, other changes of bodies from the next update on.
    #[doc(alias = "Joint.Broke")]
    fn on_joint_broke(&mut self, context: &mut Context<'_>, joint: JointId) {
        let _ = (context, joint);
    }

    /// Whether [`on_joint_updated`](Self::on_joint_updated) is to be called; queried in every iteration.
    fn handles_joint_updates(&self) -> bool {
        false
    }

    /// A joint has applied an impulse; called in every solver iteration in which it did. Velocities set here act at
    /// once, other changes of bodies from the next update on.
    #[doc(alias("JointUpdated", "JointDelegate", "FixedJointDelegate"))]
    fn on_joint_updated(&mut self, context: &mut Context<'_>, joint: JointId) {
        let _ = (context, joint);
    }

    /// A spring broke: the error of its last update is beyond its breakpoint. It is disabled already, but acts once
    /// more.
    #[doc(alias = "Spring.Broke")]
    fn on_spring_broke(&mut self, context: &mut Context<'_>, spring: SpringId) {
        let _ = (context, spring);
    }

    /// Whether [`on_spring_updated`](Self::on_spring_updated) is to be called; queried for every spring.
    fn handles_spring_updates(&self) -> bool {
        false
    }

    /// A spring has applied a force or torque.
    #[doc(alias("SpringUpdated", "SpringDelegate", "FixedSpringDelegate"))]
    fn on_spring_updated(&mut self, context: &mut Context<'_>, spring: SpringId) {
        let _ = (context, spring);
    }

    /// A geom entered the fluid of a fluid drag controller with these vertices of its outline, in the world.
    #[doc(alias("Entry", "EntryEventHandler"))]
    fn on_fluid_entry(
        &mut self,
        context: &mut Context<'_>,
        controller: ControllerId,
        geom: GeomId,
        vertices: &Vertices,
    ) {
        let _ = (context, controller, geom, vertices);
    }

    /// Returns the game's own controller behind an id that was made with
    /// [`Controller::user_defined`](crate::Controller::user_defined), when it is to be updated.
    fn user_controller(&mut self, controller: ControllerId) -> Option<&mut dyn UserController> {
        let _ = controller;
        None
    }

    /// Returns the game's own fluid container of a fluid drag controller that was made with
    /// [`FluidContainerRef::UserDefined`](crate::FluidContainerRef::UserDefined).
    fn fluid_container(&mut self, controller: ControllerId) -> Option<&mut dyn FluidContainer> {
        let _ = controller;
        None
    }

    /// An object entered its list. It has no context: the original would lose objects that are queued here.
    #[doc(alias = "ContentsChangedEventHandler")]
    fn on_added(&mut self, object: ObjectId) {
        let _ = object;
    }

    /// An object left its list, or was to be removed without being in it.
    fn on_removed(&mut self, object: ObjectId) {
        let _ = object;
    }
}
