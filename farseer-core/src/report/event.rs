//! Events of an update (behaviour chapters 03, 04 and 08).

use serde::{Deserialize, Serialize};

use crate::body::BodyId;
use crate::controllers::ControllerId;
use crate::geom::GeomId;
use crate::joints::JointId;
use crate::object_id::ObjectId;
use crate::springs::SpringId;

/// An event of the last update, or a request made since the update before.
/// [`PhysicsSimulator::events`](crate::PhysicsSimulator::events) lists them in the order in which they happened.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[non_exhaustive]
pub enum Event {
    /// Geom `this` touches `other`: one event for each side. The update that lists it depends on the
    /// [methods](crate::Methods):
    ///
    /// - the faithful set lists it in every update in which the pair has contacts, as the original calls its handlers;
    /// - the [precise](crate::Methods::Precise) set lists it once, in the update in which the touch begins, and
    ///   [`Separation`](Self::Separation) once, when it ends. A pair that rests or sleeps has no events. A sensor that a body
    ///   crosses within one update has both, the collision with 0 contacts.
    ///
    /// [`overlaps`](crate::PhysicsSimulator::overlaps) lists the geoms that a geom touches now, and
    /// [`arbiters`](crate::PhysicsSimulator::arbiters) all touching pairs with their contacts, with either set.
    ///
    /// ```
    /// use farseer_core::{BodyFactory, Event, GeomFactory, GeomPlacement, Methods, PhysicsSimulator, math::Vector2};
    ///
    /// /// A ball falls on a floor and lies there. Updates of 300 in which the floor has a collision event.
    /// fn updates_with_an_event(methods: Methods) -> farseer_core::Result<usize> {
    ///     let mut simulator = PhysicsSimulator::new(Vector2::new(0.0, 100.0))?;
    ///     simulator.set_methods(methods)?;
    ///     let floor = BodyFactory::create_rectangle_body_in(&mut simulator, 100.0, 10.0, 1.0)?;
    ///     simulator[floor].set_is_static(true);
    ///     let floor =
    ///         GeomFactory::create_rectangle_geom_in(&mut simulator, floor, 100.0, 10.0, GeomPlacement::default())?;
    ///     let ball = BodyFactory::create_circle_body_in(&mut simulator, 5.0, 1.0)?;
    ///     simulator[ball].set_position(Vector2::new(0.0, -20.0));
    ///     let ball = GeomFactory::create_circle_geom_in(&mut simulator, ball, 5.0, 16, GeomPlacement::default())?;
    ///     let mut updates = 0;
    ///     for _ in 0..300 {
    ///         simulator.update(0.01);
    ///         let tells = |event: &Event| matches!(*event, Event::Collision { this, .. } if this == floor);
    ///         updates += usize::from(simulator.events().iter().any(tells));
    ///     }
    ///     assert_eq!(simulator.overlaps(floor), [ball], "the touch lasts, with both sets");
    ///     Ok(updates)
    /// }
    /// assert!(updates_with_an_event(Methods::default())? > 200);
    /// assert_eq!(updates_with_an_event(Methods::PRECISE)?, 1);
    /// # Ok::<(), farseer_core::Error>(())
    /// ```
    Collision {
        /// The geom to which the event belongs.
        this: GeomId,
        /// The geom that it touches.
        other: GeomId,
        /// Number of contacts.
        contacts: u32,
        /// Whether the handler refused the collision.
        vetoed: bool,
    },
    /// The boxes of two geoms overlap but the geoms do not touch (any more): one event for each side. Like the
    /// original's, it recurs in every update for boxes that overlap without contact, and is not listed when a contact
    /// ends by disabling, removing or disposing.
    ///
    /// With the [precise set](crate::Methods::Precise) it is listed once for every touch that began, however the touch
    /// ends: also by categories or a group, and when a side is disabled, removed or disposed. The id of a disposed geom
    /// is stale then.
    Separation {
        /// The geom to which the event belongs.
        this: GeomId,
        /// The geom that it touched, or whose box overlaps.
        other: GeomId,
    },
    /// Two geoms with collision response begin to touch: once for the pair, if one of both
    /// [wants](crate::Geom::set_wanted_events) it. Only with the [precise set](crate::Methods::Precise), as the ends of
    /// touches and the events of sensors and of sleep.
    ///
    /// A touch that begins has exactly one end, as the same kind of event, however it ends: also by filters, and when a side
    /// is disabled, removed or disposed. If one side is made a [sensor](crate::Objects::set_sensor) while the two touch, the
    /// touch ends and an overlap with a sensor begins. The geom with the smaller [creation number](crate::GeomRef::id) is first.
    /// A collision handler that refuses the contact does not change the events. Touches go on while bodies sleep, and in a
    /// restored simulator.
    TouchBegin {
        /// One geom.
        geom1: GeomId,
        /// The other geom.
        geom2: GeomId,
    },
    /// Two geoms with collision response cease to touch. Ids of geoms that were disposed are stale.
    TouchEnd {
        /// One geom.
        geom1: GeomId,
        /// The other geom.
        geom2: GeomId,
    },
    /// A geom begins to overlap a sensor: once for the pair, as [`TouchBegin`](Self::TouchBegin). If both are sensors, one of
    /// the two is the visitor. A geom that crosses the sensor within one update has both events.
    SensorBegin {
        /// The sensor.
        sensor: GeomId,
        /// The geom that overlaps it.
        visitor: GeomId,
    },
    /// A geom ceases to overlap a sensor. Ids of geoms that were disposed are stale.
    SensorEnd {
        /// The sensor.
        sensor: GeomId,
        /// The geom that overlapped it.
        visitor: GeomId,
    },
    /// A body fell asleep, and [has such events](crate::Body::set_sleep_events).
    BodySlept {
        /// The body.
        body: BodyId,
    },
    /// A body whose sleep was reported is awake again, or was disabled or made static. Not listed for a body that was removed or
    /// disposed.
    BodyWoke {
        /// The body.
        body: BodyId,
    },
    /// The handler refused a pair whose boxes overlap.
    BroadPhaseVeto {
        /// First geom, in the order of the handler's arguments.
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
    /// A setter or [`PhysicsSimulator::update`](crate::PhysicsSimulator::update) was given a value that is not finite,
    /// and changed no state. After sixteen rejections of an object since the last report, each further argument is
    /// reported once.
    RejectedInput {
        /// The object whose setter it was; `None` for the simulator itself.
        object: Option<ObjectId>,
        /// Name of the argument.
        argument: &'static str,
    },
    /// The state of a body was no longer finite. It was put back to its last finite state.
    NotFinite {
        /// The body.
        body: BodyId,
        /// Whether it was disabled: every dynamic body is, no static one.
        disabled: bool,
    },
    /// A joint broke: its error was beyond its breakpoint, or its force or torque beyond the maximum. It is disabled
    /// now.
    JointBroke {
        /// The joint.
        joint: JointId,
    },
    /// A spring broke: its error was beyond its breakpoint. It is disabled now.
    SpringBroke {
        /// The spring.
        spring: SpringId,
    },
    /// A geom entered the fluid of a fluid drag controller.
    FluidEntry {
        /// The controller.
        controller: ControllerId,
        /// The geom.
        geom: GeomId,
        /// Number of its vertices in the fluid.
        vertices: u32,
    },
    /// A joint would have made a velocity infinite or NaN. It was skipped for the rest of this update, and its impulses
    /// were reset.
    JointNotFinite {
        /// The joint.
        joint: JointId,
    },
    /// A spring would have made a force or torque infinite or NaN. It was skipped in this update.
    SpringNotFinite {
        /// The spring.
        spring: SpringId,
    },
    /// A controller would have made a force or torque infinite or NaN, which it did not apply.
    ControllerNotFinite {
        /// The controller.
        controller: ControllerId,
    },
    /// A controller of the game's own, or one with a fluid container of the game's own, was due, but no handler
    /// returned it.
    MissingController {
        /// The controller.
        controller: ControllerId,
    },
}

/// An event between updates, or while no callback could be called: it is reported at the next opportunity. It is part
/// of the state, and saved.
#[derive(Debug, Clone, Copy, Serialize, Deserialize)]
pub(crate) enum PendingEvent {
    BodyUpdated { body: BodyId },
    BodyDisposed { body: BodyId },
    NotFinite { body: BodyId, disabled: bool },
}

impl From<PendingEvent> for Event {
    fn from(notice: PendingEvent) -> Self {
        match notice {
            PendingEvent::BodyUpdated { body } => Event::BodyUpdated { body },
            PendingEvent::BodyDisposed { body } => Event::BodyDisposed { body },
            PendingEvent::NotFinite { body, disabled } => Event::NotFinite { body, disabled },
        }
    }
}
