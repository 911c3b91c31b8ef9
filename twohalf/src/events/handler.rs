//! Event handlers: callbacks during an update.

use farseer_core::{BodyId, GeomId, JointId, ObjectId, SpringId};

use super::collision::Collision;
use super::context::Context;
use crate::depth::ContactTarget;

/// Callbacks of a game. Handlers belong to the game and not to the simulator, so that a save of the simulator
/// is complete.
///
/// The [`Context`] edits bodies and geoms at once. Objects that it adds, removes or disposes enter or leave
/// with the next update.
pub trait EventHandler {
    /// Contact filter: called for each touch of a geom with another geom, its ground or a platform, in every
    /// update of the touch. For two geoms both sides are asked. A geom is left out while its
    /// [callbacks](farseer_core::Geom::set_collision_callbacks_enabled) are disabled.
    ///
    /// `false` drops the contact in this update, and the second side is not asked. One-way platforms work
    /// like that.
    ///
    /// It is also called, with [`contacts`](Collision::contacts) 0, for supports, ledges and walls of a
    /// [character](crate::TwoHalfPhysicsSimulator::walk), and for curbs that it reaches within three updates.
    #[doc(alias("OnCollision", "CollisionEventHandler"))]
    fn on_collision(&mut self, context: &mut Context<'_>, collision: &Collision) -> bool {
        let _ = (context, collision);
        true
    }

    /// Called at the end of a contact: see [`Event::Separation`](crate::Event::Separation).
    #[doc(alias("OnSeparation", "SeparationEventHandler"))]
    fn on_separation(&mut self, context: &mut Context<'_>, this: GeomId, partner: ContactTarget) {
        let _ = (context, this, partner);
    }

    /// Returns whether [`on_broad_phase_collision`](Self::on_broad_phase_collision) is called.
    fn handles_broad_phase(&self) -> bool {
        false
    }

    /// Broad-phase filter: the AABBs of two geoms overlap in all three axes and they did not touch in the
    /// last update. `false` refuses the pair in this update.
    #[doc(alias("OnBroadPhaseCollision", "BroadPhaseCollisionHandler"))]
    fn on_broad_phase_collision(&mut self, context: &mut Context<'_>, geom1: GeomId, geom2: GeomId) -> bool {
        let _ = (context, geom1, geom2);
        true
    }

    /// Called for a body that was moved: see [`Event::BodyUpdated`](crate::Event::BodyUpdated).
    #[doc(alias("Updated", "UpdatedEventHandler"))]
    fn on_body_updated(&mut self, context: &mut Context<'_>, body: BodyId) {
        let _ = (context, body);
    }

    /// Called for a body that was disposed: see [`Event::BodyDisposed`](crate::Event::BodyDisposed).
    #[doc(alias = "Disposed")]
    fn on_body_disposed(&mut self, context: &mut Context<'_>, body: BodyId) {
        let _ = (context, body);
    }

    /// Called for a joint that broke: see [`Event::JointBroke`](crate::Event::JointBroke).
    #[doc(alias = "Broke")]
    fn on_joint_broke(&mut self, context: &mut Context<'_>, joint: JointId) {
        let _ = (context, joint);
    }

    /// Called for a spring that broke: see [`Event::SpringBroke`](crate::Event::SpringBroke).
    fn on_spring_broke(&mut self, context: &mut Context<'_>, spring: SpringId) {
        let _ = (context, spring);
    }

    /// Called for an object that entered its list.
    fn on_added(&mut self, object: ObjectId) {
        let _ = object;
    }

    /// Called for an object that left its list, or was to be removed without being in its list.
    fn on_removed(&mut self, object: ObjectId) {
        let _ = object;
    }
}
