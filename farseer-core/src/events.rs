//! What happens during an update, and who is told (behaviour chapters 03, 04 and 08).

use serde::{Deserialize, Serialize};

use crate::body::{Body, BodyId};
use crate::contact::Contact;
use crate::controllers::{Controller, ControllerId, FluidContainer, UserController};
use crate::geom::{Geom, GeomId};
use crate::geom_ref::GeomRef;
use crate::joints::{Joint, JointId};
use crate::shape::Vertices;
use crate::simulator::PhysicsSimulator;
use crate::springs::{Spring, SpringId};
use crate::{ObjectId, Result};

/// Something that happened during the last update, or was asked for since the one before.
/// [`PhysicsSimulator::events`] lists them in the order in which they happened.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[non_exhaustive]
pub enum Event {
    /// Geom `this` touches `other`, told once to each side in every update in which there are contacts.
    Collision {
        /// The geom that is told.
        this: GeomId,
        /// Its partner.
        other: GeomId,
        /// Number of contacts.
        contacts: u32,
        /// Whether the handler refused the collision.
        vetoed: bool,
    },
    /// The boxes of two geoms overlap but the geoms do not touch (any more), told once to each side. Like the
    /// original's, it recurs in every update for boxes that overlap without contact, and does not come when a
    /// contact ends by disabling, removing or disposing.
    Separation {
        /// The geom that is told.
        this: GeomId,
        /// Its partner.
        other: GeomId,
    },
    /// The handler refused a pair whose boxes overlap.
    BroadPhaseVeto {
        /// First geom, as the handler was told.
        geom1: GeomId,
        /// Second geom.
        geom2: GeomId,
    },
    /// A body was moved by a setter, or has moved at least once and was integrated.
    BodyUpdated {
        /// The body.
        body: BodyId,
    },
    /// A body was disposed.
    BodyDisposed {
        /// The body; its id is stale after the update that reports this.
        body: BodyId,
    },
    /// An object entered its list.
    Added {
        /// The object.
        object: ObjectId,
    },
    /// An object left its list, or was to be removed without being in it.
    Removed {
        /// The object.
        object: ObjectId,
    },
    /// A setter or [`PhysicsSimulator::update`] was given a value that is not finite, and changed nothing. After
    /// sixteen refusals of an object since the last update that told, each further argument is told once.
    RejectedInput {
        /// The object whose setter it was; `None` for the simulator itself.
        object: Option<ObjectId>,
        /// Name of the argument.
        argument: &'static str,
    },
    /// The state of a body stopped being finite. It was put back to its last finite state.
    NotFinite {
        /// The body.
        body: BodyId,
        /// Whether it was disabled: every dynamic body is, no static one.
        disabled: bool,
    },
    /// The error of a joint was beyond its breakpoint: it is disabled now.
    JointBroke {
        /// The joint.
        joint: JointId,
    },
    /// The error of a spring was beyond its breakpoint: it is disabled now.
    SpringBroke {
        /// The spring.
        spring: SpringId,
    },
    /// A geom dipped into the fluid of a fluid drag controller.
    FluidEntry {
        /// The controller.
        controller: ControllerId,
        /// The geom.
        geom: GeomId,
        /// Number of its vertices in the fluid.
        vertices: u32,
    },
    /// A joint would have made a velocity infinite or NaN. It did nothing more in this update, and has forgotten its
    /// impulses.
    JointNotFinite {
        /// The joint.
        joint: JointId,
    },
    /// A spring would have made a force or torque infinite or NaN. It did nothing in this update.
    SpringNotFinite {
        /// The spring.
        spring: SpringId,
    },
    /// A controller would have made a force or torque infinite or NaN, which it did not apply.
    ControllerNotFinite {
        /// The controller.
        controller: ControllerId,
    },
    /// A controller that is the game's own, or has a fluid container that is, was due, but nobody answered for it.
    MissingController {
        /// The controller.
        controller: ControllerId,
    },
}

/// What happened between updates, or while no callback could be told: it is told as soon as one can be. State, and saved
/// as such.
#[derive(Debug, Clone, Copy, Serialize, Deserialize)]
pub(crate) enum Notice {
    BodyUpdated { body: BodyId },
    BodyDisposed { body: BodyId },
    NotFinite { body: BodyId, disabled: bool },
}

impl From<Notice> for Event {
    fn from(notice: Notice) -> Self {
        match notice {
            Notice::BodyUpdated { body } => Event::BodyUpdated { body },
            Notice::BodyDisposed { body } => Event::BodyDisposed { body },
            Notice::NotFinite { body, disabled } => Event::NotFinite { body, disabled },
        }
    }
}

/// Callbacks of a game. Handlers belong to the game, never to the simulator, so that saving the simulator keeps
/// everything.
///
/// Callbacks come in the original's order. Through the [`Context`] they edit bodies, geoms, joints, springs and
/// controllers at once; what they add, remove or dispose enters or leaves with the next update.
pub trait EventHandler {
    /// Geom `this` touches `other`; called for both sides in every update in which there are contacts. `false`
    /// drops the contacts of this update, and the second side is not asked. The list may be changed, too.
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

    /// See [`Event::Separation`].
    #[doc(alias("OnSeparation", "SeparationEventHandler"))]
    fn on_separation(&mut self, context: &mut Context<'_>, this: GeomId, other: GeomId) {
        let _ = (context, this, other);
    }

    /// Whether [`on_broad_phase_collision`](Self::on_broad_phase_collision) is to be asked. With brute force
    /// and spatial hash the answers then **replace** the test of the boxes, as in the original.
    fn handles_broad_phase(&self) -> bool {
        false
    }

    /// A new pair was found; `false` refuses it.
    #[doc(alias("OnBroadPhaseCollision", "BroadPhaseCollisionHandler"))]
    fn on_broad_phase_collision(&mut self, context: &mut Context<'_>, geom1: GeomId, geom2: GeomId) -> bool {
        let _ = (context, geom1, geom2);
        true
    }

    /// Whether [`accepts_pair`](Self::accepts_pair) is to be asked; looked at once per update.
    fn filters_pairs(&self) -> bool {
        false
    }

    /// Whether two geoms whose boxes overlap and that may collide may have contacts; not in the original, for engines
    /// that know more about them, such as how deep in the picture they are.
    ///
    /// Asked in every update: first about every pair that has an arbiter. If refused it loses it, with
    /// [`on_separation`](Self::on_separation) for both sides. Then about every pair whose boxes overlap, after
    /// [`on_broad_phase_collision`](Self::on_broad_phase_collision). If refused it gets none, without an event. Unlike
    /// that callback it never replaces the test of the boxes, and a pair refused in one update is asked about in the
    /// next. A pair may be asked about more than once per update. Boxes are widened by 0.01 with sweep and prune.
    fn accepts_pair(&mut self, context: &mut Context<'_>, geom1: GeomId, geom2: GeomId) -> bool {
        let _ = (context, geom1, geom2);
        true
    }

    /// See [`Event::BodyUpdated`].
    #[doc(alias("Updated", "UpdatedEventHandler"))]
    fn on_body_updated(&mut self, context: &mut Context<'_>, body: BodyId) {
        let _ = (context, body);
    }

    /// See [`Event::BodyDisposed`].
    #[doc(alias = "Disposed")]
    fn on_body_disposed(&mut self, context: &mut Context<'_>, body: BodyId) {
        let _ = (context, body);
    }

    /// A joint broke: the error found by the last pre-step is beyond its breakpoint. It is disabled already, but acts
    /// in this pass of the solver. Velocities set here act at once, other changes of bodies from the next update on.
    #[doc(alias = "Joint.Broke")]
    fn on_joint_broke(&mut self, context: &mut Context<'_>, joint: JointId) {
        let _ = (context, joint);
    }

    /// Whether [`on_joint_updated`](Self::on_joint_updated) is to be told; looked at in every pass.
    fn handles_joint_updates(&self) -> bool {
        false
    }

    /// A joint has applied an impulse, told in every pass of the solver in which it did. Velocities set here act at
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

    /// Whether [`on_spring_updated`](Self::on_spring_updated) is to be told; looked at for every spring.
    fn handles_spring_updates(&self) -> bool {
        false
    }

    /// A spring has applied a force or torque.
    #[doc(alias("SpringUpdated", "SpringDelegate", "FixedSpringDelegate"))]
    fn on_spring_updated(&mut self, context: &mut Context<'_>, spring: SpringId) {
        let _ = (context, spring);
    }

    /// A geom dipped into the fluid of a fluid drag controller with these vertices of its outline, in the world.
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

    /// The game's own controller behind an id that was made with
    /// [`Controller::user_defined`](crate::Controller::user_defined); its turn has come.
    fn user_controller(&mut self, controller: ControllerId) -> Option<&mut dyn UserController> {
        let _ = controller;
        None
    }

    /// The game's own fluid container of a fluid drag controller that was made with
    /// [`FluidContainerRef::UserDefined`](crate::FluidContainerRef::UserDefined).
    fn fluid_container(&mut self, controller: ControllerId) -> Option<&mut dyn FluidContainer> {
        let _ = controller;
        None
    }

    /// An object entered its list. Without a context: the original would lose what is queued here.
    #[doc(alias = "ContentsChangedEventHandler")]
    fn on_added(&mut self, object: ObjectId) {
        let _ = object;
    }

    /// An object left its list, or was to be removed without being in it.
    fn on_removed(&mut self, object: ObjectId) {
        let _ = object;
    }
}

/// What a callback may do to the simulator that calls it.
#[derive(Debug)]
pub struct Context<'a> {
    pub(crate) simulator: &'a mut PhysicsSimulator,
}

impl Context<'_> {
    /// The same for a shorter time: for engines that hand it on inside a context of their own.
    pub fn reborrow(&mut self) -> Context<'_> {
        Context { simulator: self.simulator }
    }

    /// The simulator, to look at everything and to ask its queries. In the middle of an update it shows what the
    /// stages have done so far.
    pub fn simulator(&self) -> &PhysicsSimulator {
        self.simulator
    }

    /// A body, unless the id is stale.
    pub fn body(&self, body: BodyId) -> Option<&Body> {
        self.simulator.body(body)
    }

    /// A body to edit at once, unless the id is stale.
    pub fn body_mut(&mut self, body: BodyId) -> Option<&mut Body> {
        self.simulator.body_mut(body)
    }

    /// A geom, unless the id is stale.
    pub fn geom(&self, geom: GeomId) -> Option<GeomRef<'_>> {
        self.simulator.geom(geom)
    }

    /// The settings of a geom to edit at once, unless the id is stale.
    pub fn geom_mut(&mut self, geom: GeomId) -> Option<&mut Geom> {
        self.simulator.geom_mut(geom)
    }

    /// A joint, unless the id is stale.
    pub fn joint(&self, joint: JointId) -> Option<&Joint> {
        self.simulator.joint(joint)
    }

    /// A joint to edit at once, unless the id is stale.
    pub fn joint_mut(&mut self, joint: JointId) -> Option<&mut Joint> {
        self.simulator.joint_mut(joint)
    }

    /// A spring, unless the id is stale.
    pub fn spring(&self, spring: SpringId) -> Option<&Spring> {
        self.simulator.spring(spring)
    }

    /// A spring to edit at once, unless the id is stale.
    pub fn spring_mut(&mut self, spring: SpringId) -> Option<&mut Spring> {
        self.simulator.spring_mut(spring)
    }

    /// A controller, unless the id is stale.
    pub fn controller(&self, controller: ControllerId) -> Option<&Controller> {
        self.simulator.controller(controller)
    }

    /// A controller to edit at once, unless the id is stale.
    pub fn controller_mut(&mut self, controller: ControllerId) -> Option<&mut Controller> {
        self.simulator.controller_mut(controller)
    }

    /// See [`PhysicsSimulator::add`].
    ///
    /// # Errors
    /// A stale id.
    pub fn add(&mut self, object: impl Into<ObjectId>) -> Result<()> {
        self.simulator.add(object)
    }

    /// See [`PhysicsSimulator::remove`].
    ///
    /// # Errors
    /// A stale id.
    pub fn remove(&mut self, object: impl Into<ObjectId>) -> Result<()> {
        self.simulator.remove(object)
    }

    /// See [`PhysicsSimulator::dispose`].
    ///
    /// # Errors
    /// A stale id.
    pub fn dispose(&mut self, object: impl Into<ObjectId>) -> Result<()> {
        self.simulator.dispose(object)
    }

    /// See [`PhysicsSimulator::set_is_sensor`].
    ///
    /// # Errors
    /// A stale id.
    pub fn set_is_sensor(&mut self, geom: GeomId, is_sensor: bool) -> Result<()> {
        self.simulator.set_is_sensor(geom, is_sensor)
    }

    /// See [`PhysicsSimulator::ignore_collision_with`].
    ///
    /// # Errors
    /// A stale id.
    pub fn ignore_collision_with(&mut self, geom: GeomId, other: GeomId) -> Result<()> {
        self.simulator.ignore_collision_with(geom, other)
    }

    /// See [`PhysicsSimulator::restore_collision_with`].
    ///
    /// # Errors
    /// A stale id.
    pub fn restore_collision_with(&mut self, geom: GeomId, other: GeomId) -> Result<()> {
        self.simulator.restore_collision_with(geom, other)
    }
}
