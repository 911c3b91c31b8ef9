//! Events of an update.

use farseer_core::{BodyId, Event as CoreEvent, GeomId, JointId, ObjectId, SpringId};

use super::collision::Collision;
use crate::depth::Partner;
use crate::views::Squeeze;

/// An event of the last update, or a request made since the update before.
/// [`TwoHalfPhysicsSimulator::events`](crate::TwoHalfPhysicsSimulator::events) lists them, those of pairs that the 2D
/// engine handles before the others.
#[derive(Debug, Clone, Copy, PartialEq)]
#[non_exhaustive]
pub enum Event {
    /// A geom touches something; for two geoms one event for each. When it comes depends on the
    /// [scheme](crate::DepthScheme): with [`Precise`](crate::DepthScheme::Precise), the default, once, in the update in
    /// which the touch begins, and in every update in which a handler refuses it; with the other schemes in every update
    /// in which the touch lasts. [`contacts`](crate::TwoHalfPhysicsSimulator::contacts) lists all touches that there are,
    /// with any scheme.
    Collision(Collision),
    /// A geom touched something in the last update and no longer does, or a handler has refused it now. For two
    /// geoms one event for each. Does not come when a contact ends by disabling, removing or disposing.
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
    /// A grip broke since the last update: the load got out of reach, or the load or its holder was disabled or disposed. Reported
    /// [by what holds](crate::TwoHalfPhysicsSimulator::report_grip_broken), such as `Hands` of `twohalf-factories`.
    GripBroke {
        /// The body of whoever held it; its id may be stale.
        holder: BodyId,
        /// The body that was held; its id may be stale.
        load: BodyId,
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
