//! Events of an update.

use farseer_core::{BodyId, Event as CoreEvent, GeomId, JointId, ObjectId, SpringId};

use super::collision::Collision;
use crate::depth::ContactTarget;
use crate::views::CrushInfo;

/// An event of the last update, or a request made since the update before.
/// [`TwoHalfPhysicsSimulator::events`](crate::TwoHalfPhysicsSimulator::events) lists them, those of pairs
/// that the core handles first.
#[derive(Debug, Clone, Copy, PartialEq)]
#[non_exhaustive]
pub enum Event {
    /// A contact of a geom; two events for two geoms. With [`Precise`](crate::DepthScheme::Precise), the
    /// default [scheme](crate::DepthScheme), it comes once when the touch begins, and in every update in
    /// which a handler refuses it. With the other schemes it comes in every update of the touch.
    /// [`contacts`](crate::TwoHalfPhysicsSimulator::contacts) lists all touches with any scheme.
    Collision(Collision),
    /// The end of a contact, or a touch that a handler refuses from now on; two events for two geoms. A
    /// contact that ends by disabling, removing or disposing has no event.
    Separation {
        /// The geom that had the contact.
        this: GeomId,
        /// The contact target.
        partner: ContactTarget,
    },
    /// The handler refused a pair in the broad phase.
    BroadPhaseVeto {
        /// First geom, as in the callback.
        geom1: GeomId,
        /// Second geom.
        geom2: GeomId,
    },
    /// A setter moved a body, or an update integrated a body that has moved at least once, in any axis.
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
    /// An object left its list, or was to be removed without being in its list.
    Removed {
        /// The object.
        object: ObjectId,
    },
    /// A joint exceeded its breakpoint or its greatest force, and broke: it is disabled.
    JointBroke {
        /// The joint.
        joint: JointId,
    },
    /// A spring exceeded its breakpoint, and broke: it is disabled.
    SpringBroke {
        /// The spring.
        spring: SpringId,
    },
    /// A grip broke since the last update: the load got out of reach, or load or holder was disabled or
    /// disposed. Reported [by the holder's code](crate::TwoHalfPhysicsSimulator::report_grip_broken), such as
    /// `Hands` of `twohalf-factories`.
    GripBroke {
        /// The body that held the load; its id may be stale.
        holder: BodyId,
        /// The body that was held; its id may be stale.
        load: BodyId,
    },
    /// A [monitored](crate::TwoHalfPhysicsSimulator::set_crush_tolerance) body lacks more room between two
    /// sides than its tolerance, from this update on.
    Crushed {
        /// The body.
        body: BodyId,
        /// Axis, depth and sides of the crush.
        squeeze: CrushInfo,
    },
    /// A setter or an update got a value that is not finite, and changed nothing. There is one event per
    /// object and argument for all refusals since the last report.
    RejectedInput {
        /// The object whose setter it was; `None` for the simulator itself and for platforms.
        object: Option<ObjectId>,
        /// Name of the argument.
        argument: &'static str,
    },
    /// The state of a body was not finite any more. It was restored to its last finite state.
    NotFinite {
        /// The body.
        body: BodyId,
        /// Whether it was disabled: true for dynamic bodies, false for static ones.
        disabled: bool,
    },
}

impl Event {
    /// Returns the event for an event of the core with the same meaning; `None` for collisions and separations, which `stages`
    /// convert.
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
