//! What happens during an update, and who is told.

use farseer_core::{Body, BodyId, Event as CoreEvent, Geom, GeomId, JointId, ObjectId, SpringId};

use crate::body::TwoHalfBody;
use crate::crush::Squeeze;
use crate::geom::TwoHalfGeom;
use crate::world::World;
use crate::{Axis, Partner, Platform, PlatformId, Result, Vector3};

/// A geom touches something: what a game is told of it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Collision {
    /// The geom that is told.
    pub this: GeomId,
    /// What it touches.
    pub partner: Partner,
    /// Along which axes it is pushed.
    pub axis: Axis,
    /// Unit vector in the world, Y up, that points from the partner to `this`: the direction in which it is pushed.
    pub normal: Vector3,
    /// The deepest point of the contact in the world, px, Y up.
    pub position: Vector3,
    /// Number of contact points.
    pub contacts: u32,
    /// Impulse along the normal, mass times velocity, 0 or more: in a callback that of the last update (0 at first
    /// touch), in the list of events that of the update that reports it.
    pub normal_impulse: f32,
    /// Whether a handler refused the contact. In a callback always false.
    pub vetoed: bool,
}

/// Something that happened during the last update, or was asked for since the one before.
/// [`TwoHalfPhysicsSimulator::events`](crate::TwoHalfPhysicsSimulator::events) lists them, those of pairs that the 2D
/// engine handles before the others.
#[derive(Debug, Clone, Copy, PartialEq)]
#[non_exhaustive]
pub enum Event {
    /// A geom touches something. Told in every update in which it does, for two geoms once to each.
    Collision(Collision),
    /// A geom touched something in the last update and does not any more, or a handler has refused it now. For two
    /// geoms told to each. Does not come when a contact ends by disabling, removing or disposing.
    Separation {
        /// The geom that is told.
        this: GeomId,
        /// What it touched.
        partner: Partner,
    },
    /// The handler refused a pair whose boxes overlap.
    BroadPhaseVeto {
        /// First geom, as the handler was told.
        geom1: GeomId,
        /// Second geom.
        geom2: GeomId,
    },
    /// A body was moved by a setter, or has moved at least once and was integrated, along Z or in X and Y.
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
    /// A joint was too far from what it keeps, or had to hold with too much, and broke: it is disabled.
    JointBroke {
        /// The joint.
        joint: JointId,
    },
    /// A spring was too far from its length, and broke: it is disabled.
    SpringBroke {
        /// The spring.
        spring: SpringId,
    },
    /// A body that is [watched](crate::TwoHalfPhysicsSimulator::set_crush_tolerance) has less room between two sides than is
    /// tolerated, from this update on.
    Crushed {
        /// The body.
        body: BodyId,
        /// By what, and how much.
        squeeze: Squeeze,
    },
    /// A setter or an update was given a value that is not finite, and changed nothing. Told once per object and
    /// argument, however often it was refused since the last update that told.
    RejectedInput {
        /// The object whose setter it was; `None` for the simulator itself and for platforms.
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
}

impl Event {
    /// An event of the 2D engine that means the same here. Collisions and separations are told apart elsewhere.
    pub(crate) fn from_core(event: CoreEvent) -> Option<Self> {
        Some(match event {
            CoreEvent::BodyUpdated { body } => Event::BodyUpdated { body },
            CoreEvent::BodyDisposed { body } => Event::BodyDisposed { body },
            CoreEvent::Added { object } => Event::Added { object },
            CoreEvent::Removed { object } => Event::Removed { object },
            CoreEvent::JointBroke { joint } => Event::JointBroke { joint },
            CoreEvent::SpringBroke { spring } => Event::SpringBroke { spring },
            CoreEvent::RejectedInput { object, argument } => Event::RejectedInput { object, argument },
            CoreEvent::NotFinite { body, disabled } => Event::NotFinite { body, disabled },
            _ => return None,
        })
    }
}

/// Callbacks of a game. Handlers belong to the game, never to the simulator, so that saving the simulator keeps
/// everything.
///
/// Through the [`Context`] they edit bodies and geoms at once; what they add, remove or dispose enters or leaves with
/// the next update.
pub trait EventHandler {
    /// A geom touches another geom, its ground or a platform; called in every update in which it does, for two geoms
    /// for both sides, unless its [callbacks](farseer_core::Geom::set_collision_callbacks_enabled) are switched off. `false` drops the contact in this update, and the second side is not asked: that is how
    /// platforms become one-way.
    #[doc(alias("OnCollision", "CollisionEventHandler"))]
    fn on_collision(&mut self, context: &mut Context<'_>, collision: &Collision) -> bool {
        let _ = (context, collision);
        true
    }

    /// See [`Event::Separation`].
    #[doc(alias("OnSeparation", "SeparationEventHandler"))]
    fn on_separation(&mut self, context: &mut Context<'_>, this: GeomId, partner: Partner) {
        let _ = (context, this, partner);
    }

    /// Whether [`on_broad_phase_collision`](Self::on_broad_phase_collision) is to be asked.
    fn handles_broad_phase(&self) -> bool {
        false
    }

    /// The boxes of two geoms overlap in all three axes and they did not touch in the last update; `false` refuses
    /// the pair in this update.
    #[doc(alias("OnBroadPhaseCollision", "BroadPhaseCollisionHandler"))]
    fn on_broad_phase_collision(&mut self, context: &mut Context<'_>, geom1: GeomId, geom2: GeomId) -> bool {
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

    /// See [`Event::JointBroke`].
    #[doc(alias = "Broke")]
    fn on_joint_broke(&mut self, context: &mut Context<'_>, joint: JointId) {
        let _ = (context, joint);
    }

    /// See [`Event::SpringBroke`].
    fn on_spring_broke(&mut self, context: &mut Context<'_>, spring: SpringId) {
        let _ = (context, spring);
    }

    /// An object entered its list.
    fn on_added(&mut self, object: ObjectId) {
        let _ = object;
    }

    /// An object left its list, or was to be removed without being in it.
    fn on_removed(&mut self, object: ObjectId) {
        let _ = object;
    }
}

/// What a callback may do to the simulator that calls it. How a collision goes, which callbacks of the 2D engine may set for
/// an update, cannot be set here.
#[derive(Debug)]
pub struct Context<'a> {
    pub(crate) core: farseer_core::Context<'a>,
    pub(crate) world: &'a mut World,
}

impl<'a> Context<'a> {
    /// The context of a callback that the 2D engine calls.
    pub(crate) fn within(core: &'a mut farseer_core::Context<'_>, world: &'a mut World) -> Self {
        Context { core: core.reborrow(), world }
    }

    /// A body to look at, unless the id is stale.
    pub fn body(&self, body: BodyId) -> Option<TwoHalfBody<&Self>> {
        TwoHalfBody::new(self, body)
    }

    /// A body to edit at once, unless the id is stale.
    pub fn body_mut(&mut self, body: BodyId) -> Option<TwoHalfBody<&mut Self>> {
        TwoHalfBody::new(self, body)
    }

    /// A geom to look at, unless the id is stale.
    pub fn geom(&self, geom: GeomId) -> Option<TwoHalfGeom<'_>> {
        TwoHalfGeom::new(self.core.simulator(), self.world, geom)
    }

    /// The settings of a geom to edit at once, unless the id is stale.
    pub fn geom_mut(&mut self, geom: GeomId) -> Option<&mut Geom> {
        self.core.geom_mut(geom)
    }

    /// A platform to look at, unless the id is stale.
    pub fn platform(&self, platform: PlatformId) -> Option<&Platform> {
        self.world.platforms.get(platform)
    }

    /// Lets an object take part from the next update on.
    ///
    /// # Errors
    /// A stale id.
    pub fn add(&mut self, object: impl Into<ObjectId>) -> Result<()> {
        Ok(self.core.add(object)?)
    }

    /// Takes an object out with the next update.
    ///
    /// # Errors
    /// A stale id.
    pub fn remove(&mut self, object: impl Into<ObjectId>) -> Result<()> {
        Ok(self.core.remove(object)?)
    }

    /// Ends the life of an object; its id goes stale with the next update.
    ///
    /// # Errors
    /// A stale id.
    pub fn dispose(&mut self, object: impl Into<ObjectId>) -> Result<()> {
        Ok(self.core.dispose(object)?)
    }

    /// The body in the 2D engine, to be edited.
    pub(crate) fn core_body_mut(&mut self, body: BodyId) -> Option<&mut Body> {
        self.core.body_mut(body)
    }
}
