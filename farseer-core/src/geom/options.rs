//! Options of a geom that are on or off, in one byte.

use serde::{Deserialize, Serialize};

/// Options of a geom that are on or off, as bit flags.
///
/// A snapshot has them at the place of the former flag for callbacks: without other options its bytes are the same.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(transparent)]
pub(crate) struct GeomOptions(u8);

impl Default for GeomOptions {
    fn default() -> Self {
        GeomOptions(Self::CALLBACKS)
    }
}

/// Position of the bits of [`WantedEvents`] among the options, bits.
const EVENTS_SHIFT: u32 = 2;

impl GeomOptions {
    /// Bit: handlers are called for contacts.
    pub(super) const CALLBACKS: u8 = 1;
    /// Bit: the categories of both geoms must agree to a collision.
    pub(super) const BOTH_AGREE: u8 = 1 << 1;

    /// Whether an option is on.
    #[inline]
    pub(super) fn has(self, option: u8) -> bool {
        self.0 & option != 0
    }

    /// Switches an option on or off.
    #[inline]
    pub(super) fn set(&mut self, option: u8, value: bool) {
        self.0 = if value { self.0 | option } else { self.0 & !option };
    }

    /// The events that the geom wants.
    #[inline]
    pub(super) fn events(self) -> WantedEvents {
        WantedEvents(self.0 >> EVENTS_SHIFT)
    }

    pub(super) fn set_events(&mut self, events: WantedEvents) {
        let others = self.0 & ((1 << EVENTS_SHIFT) - 1);
        self.0 = others | events.0 << EVENTS_SHIFT;
    }

    /// Whether all bits are known. False only after loading corrupt data.
    pub(super) fn is_valid(self) -> bool {
        self.events().0 & !WantedEvents::ALL.0 == 0
    }
}

/// The typed [events](crate::Event) that a geom wants: touches, sensors, hits. Events of a pair are listed if at least one
/// of both geoms wants them. Only with the [precise set](crate::Methods::Precise), and not in an engine with depth.
///
/// ```
/// use farseer_core::WantedEvents;
/// let wanted = WantedEvents::TOUCH | WantedEvents::HIT;
/// assert!(wanted.contains(WantedEvents::HIT) && !wanted.contains(WantedEvents::SENSOR));
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Default)]
pub struct WantedEvents(pub(crate) u8);

impl WantedEvents {
    /// No events: the value of geoms that Farseer's factories make.
    pub const NONE: Self = WantedEvents(0);
    /// [`Event::TouchBegin`](crate::Event::TouchBegin) and [`Event::TouchEnd`](crate::Event::TouchEnd).
    pub const TOUCH: Self = WantedEvents(1);
    /// [`Event::SensorBegin`](crate::Event::SensorBegin) and [`Event::SensorEnd`](crate::Event::SensorEnd).
    pub const SENSOR: Self = WantedEvents(1 << 1);
    /// [`PhysicsSimulator::hits`](crate::PhysicsSimulator::hits): a list of its own, beside the events.
    pub const HIT: Self = WantedEvents(1 << 2);
    /// All of them.
    pub const ALL: Self = WantedEvents(0b111);

    /// Whether all events of `other` are wanted.
    #[inline]
    pub const fn contains(self, other: Self) -> bool {
        self.0 & other.0 == other.0
    }
}

impl std::ops::BitOr for WantedEvents {
    type Output = Self;
    fn bitor(self, other: Self) -> Self {
        WantedEvents(self.0 | other.0)
    }
}

impl std::ops::Not for WantedEvents {
    type Output = Self;
    /// All events that are not in the set.
    fn not(self) -> Self {
        WantedEvents(!self.0 & Self::ALL.0)
    }
}

impl std::ops::BitAnd for WantedEvents {
    type Output = Self;
    fn bitand(self, other: Self) -> Self {
        WantedEvents(self.0 & other.0)
    }
}
