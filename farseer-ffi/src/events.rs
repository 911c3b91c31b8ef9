//! Events, hits and contacts of the last update, as lists.

use std::mem::MaybeUninit;

use farseer_core::{BodyContact, BodyId, Event, Hit, ObjectId};

use crate::arguments::FarseerVector2;
use crate::arrays::{self, write_list};
use crate::failure::{Failure, FarseerStatus, Outcome};
use crate::guard::FarseerSimulator;
use crate::ids::{FarseerBody, FarseerGeom, FarseerId, Id, number_of};

/// The kinds of events.
#[repr(C)]
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum FarseerEventKind {
    /// Geom `first` touches geom `second`: one event for each side. In each update of a touch under the faithful methods, at its begin
    /// under the precise ones.
    Collision = 0,
    /// Geom `first` does not touch geom `second` any more, or only their boxes overlap: one event for each side.
    Separation = 1,
    /// Geoms `first` and `second` begin to touch: one event for the pair, if one of them wants it. This and the next three are events of
    /// the precise methods.
    TouchBegin = 2,
    /// Geoms `first` and `second` cease to touch.
    TouchEnd = 3,
    /// Geom `second` begins to overlap the sensor `first`.
    SensorBegin = 4,
    /// Geom `second` ceases to overlap the sensor `first`.
    SensorEnd = 5,
    /// Body `first` fell asleep.
    BodySlept = 6,
    /// Body `first` is awake again.
    BodyWoke = 7,
    /// Body `first` was disposed.
    BodyDisposed = 8,
    /// Object `first` entered the simulation.
    Added = 9,
    /// Object `first` left the simulation.
    Removed = 10,
    /// Joint `first` broke: it is disabled.
    JointBroke = 11,
    /// Spring `first` broke: it is disabled.
    SpringBroke = 12,
    /// The state of the body, joint or spring `first` would not have been finite: a body was put back and disabled, a joint or
    /// spring skipped.
    NotFinite = 13,
    /// The engine ignored a value for the object `first`, 0 for the simulator.
    RejectedInput = 14,
}

/// An event of the last update.
#[repr(C)]
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct FarseerEvent {
    /// Kind code: a FarseerEventKind.
    pub kind: i32,
    /// Number of contacts of a collision; else 0.
    pub contacts: u32,
    /// The object of the event. Ids of disposed objects are stale.
    pub first: FarseerId,
    /// Id of the other geom; else 0.
    pub second: FarseerId,
}

impl FarseerEvent {
    fn new(kind: FarseerEventKind, first: impl Into<ObjectId>) -> Outcome<Self> {
        Ok(FarseerEvent { kind: kind as i32, contacts: 0, first: number_of(first.into())?, second: 0 })
    }

    fn and(self, second: impl Into<ObjectId>) -> Outcome<Self> {
        Ok(FarseerEvent { second: number_of(second.into())?, ..self })
    }
}

/// The event for the caller; `None` for the kinds that this interface does not have.
fn converted(event: &Event) -> Outcome<Option<FarseerEvent>> {
    if let Some(pair) = converted_pair(event)? {
        return Ok(Some(pair));
    }
    Ok(Some(match *event {
        Event::BodySlept { body } => FarseerEvent::new(FarseerEventKind::BodySlept, body)?,
        Event::BodyWoke { body } => FarseerEvent::new(FarseerEventKind::BodyWoke, body)?,
        Event::BodyDisposed { body } => FarseerEvent::new(FarseerEventKind::BodyDisposed, body)?,
        Event::Added { object } => FarseerEvent::new(FarseerEventKind::Added, object)?,
        Event::Removed { object } => FarseerEvent::new(FarseerEventKind::Removed, object)?,
        Event::JointBroke { joint } => FarseerEvent::new(FarseerEventKind::JointBroke, joint)?,
        Event::SpringBroke { spring } => FarseerEvent::new(FarseerEventKind::SpringBroke, spring)?,
        Event::NotFinite { body, .. } => FarseerEvent::new(FarseerEventKind::NotFinite, body)?,
        Event::JointNotFinite { joint } => FarseerEvent::new(FarseerEventKind::NotFinite, joint)?,
        Event::SpringNotFinite { spring } => FarseerEvent::new(FarseerEventKind::NotFinite, spring)?,
        Event::RejectedInput { object, .. } => rejected(object)?,
        _ => return Ok(None),
    }))
}

/// The event of two geoms for the caller; `None` for any other.
fn converted_pair(event: &Event) -> Outcome<Option<FarseerEvent>> {
    Ok(Some(match *event {
        Event::Collision { this, other, contacts, .. } => {
            FarseerEvent { contacts, ..FarseerEvent::new(FarseerEventKind::Collision, this)?.and(other)? }
        }
        Event::Separation { this, other } => {
            FarseerEvent::new(FarseerEventKind::Separation, this)?.and(other)?
        }
        Event::TouchBegin { geom1, geom2 } => {
            FarseerEvent::new(FarseerEventKind::TouchBegin, geom1)?.and(geom2)?
        }
        Event::TouchEnd { geom1, geom2 } => {
            FarseerEvent::new(FarseerEventKind::TouchEnd, geom1)?.and(geom2)?
        }
        Event::SensorBegin { sensor, visitor } => {
            FarseerEvent::new(FarseerEventKind::SensorBegin, sensor)?.and(visitor)?
        }
        Event::SensorEnd { sensor, visitor } => {
            FarseerEvent::new(FarseerEventKind::SensorEnd, sensor)?.and(visitor)?
        }
        _ => return Ok(None),
    }))
}

/// The event of a value that the engine ignored.
fn rejected(object: Option<ObjectId>) -> Outcome<FarseerEvent> {
    let first = object.map_or(Ok(0), number_of)?;
    Ok(FarseerEvent { kind: FarseerEventKind::RejectedInput as i32, contacts: 0, first, second: 0 })
}

/// Two geoms that hit each other, for example for a sound.
#[repr(C)]
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct FarseerHit {
    /// Id of one geom.
    pub geom1: FarseerGeom,
    /// Id of the other geom.
    pub geom2: FarseerGeom,
    /// The contact point that closes fastest, in the world, in length units.
    pub point: FarseerVector2,
    /// Unit normal from the first geom to the second.
    pub normal: FarseerVector2,
    /// Speed along the normal before the impact, in length units/s.
    pub speed: f32,
}

impl FarseerHit {
    fn of(hit: &Hit) -> Outcome<Self> {
        Ok(FarseerHit {
            geom1: hit.geom1.to_number()?,
            geom2: hit.geom2.to_number()?,
            point: hit.point.into(),
            normal: hit.normal.into(),
            speed: hit.speed,
        })
    }
}

/// A contact of a body.
#[repr(C)]
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct FarseerBodyContact {
    /// Id of the geom of the body.
    pub geom: FarseerGeom,
    /// Id of the other geom.
    pub other: FarseerGeom,
    /// The point in the world, in length units.
    pub point: FarseerVector2,
    /// Unit normal from the other geom to the body: up for a body that stands.
    pub normal: FarseerVector2,
    /// Separation in length units, negative for penetration.
    pub separation: f32,
    /// Normal impulse of the last update, under the precise methods of its last substep, in mass units · length units/s.
    pub normal_impulse: f32,
}

impl FarseerBodyContact {
    fn of(contact: &BodyContact) -> Outcome<Self> {
        Ok(FarseerBodyContact {
            geom: contact.geom.to_number()?,
            other: contact.other.to_number()?,
            point: contact.point.into(),
            normal: contact.normal.into(),
            separation: contact.separation,
            normal_impulse: contact.normal_impulse,
        })
    }
}

/// Writes the events of the last update, in their order, and their number. The next update replaces them.
///
/// # Safety
/// An array that is not null has the items that its number says.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn farseer_simulator_events(
    simulator: Option<&FarseerSimulator>,
    events: *mut FarseerEvent,
    capacity: usize,
    count: Option<&mut MaybeUninit<usize>>,
) -> FarseerStatus {
    // SAFETY: the caller answers for the array.
    let room = unsafe { arrays::room("events", events, capacity) };
    write_list(simulator, room, count, |world| {
        world.simulator.events().iter().filter_map(|event| converted(event).transpose()).collect()
    })
}

/// Writes the hits of the last update under the precise methods, and their number. Geoms have to want them.
///
/// # Safety
/// An array that is not null has the items that its number says.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn farseer_simulator_hits(
    simulator: Option<&FarseerSimulator>,
    hits: *mut FarseerHit,
    capacity: usize,
    count: Option<&mut MaybeUninit<usize>>,
) -> FarseerStatus {
    // SAFETY: the caller answers for the array.
    let room = unsafe { arrays::room("hits", hits, capacity) };
    write_list(simulator, room, count, |world| world.simulator.hits().iter().map(FarseerHit::of).collect())
}

/// Writes the contacts of a body after the last update, and their number.
///
/// # Safety
/// An array that is not null has the items that its number says.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn farseer_body_contacts(
    simulator: Option<&FarseerSimulator>,
    body: FarseerBody,
    contacts: *mut FarseerBodyContact,
    capacity: usize,
    count: Option<&mut MaybeUninit<usize>>,
) -> FarseerStatus {
    // SAFETY: the caller answers for the array.
    let room = unsafe { arrays::room("contacts", contacts, capacity) };
    write_list(simulator, room, count, |world| {
        let id = BodyId::from_number("body", body)?;
        world.simulator.body(id).ok_or_else(|| Failure::stale("body"))?;
        world.simulator.contacts_of(id).iter().map(FarseerBodyContact::of).collect()
    })
}
