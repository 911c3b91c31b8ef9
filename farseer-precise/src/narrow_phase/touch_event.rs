//! Narrow phase: the event of two geoms that begin or cease to touch.

use crate::broad_phase::proxies::Proxy;
use crate::storage::order::packed_key;

/// Events that the game wants of a geom, as bits of [`Proxy::events`].
#[derive(Debug, Clone, Copy)]
pub struct WantedEvent;

impl WantedEvent {
    /// Bit of begin and end of touches.
    pub const TOUCH: u8 = 1;
    /// Bit of begin and end of overlaps with a sensor.
    pub const SENSOR: u8 = 1 << 1;
    /// Bit of [hits](super::hits): contact points that close at speed, also where the geoms touch already.
    pub const HIT: u8 = 1 << 2;
}

/// Kind of the typed event with which the game learns that two geoms touch.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum TouchKind {
    /// The game does not want to know.
    #[default]
    Unreported,
    /// A touch of two geoms with collision response.
    Touch,
    /// An overlap with a sensor.
    Sensor {
        /// Whether the sensor is the geom with the smaller creation number.
        is_first: bool,
    },
}

impl TouchKind {
    /// Returns the kind for a pair. For each side: creation number, and whether it has collision response; `events`: the
    /// [wanted events](Proxy::events) of both together.
    pub fn of([(number, responds), (other_number, other_responds)]: [(u32, bool); 2], events: u8) -> Self {
        match responds && other_responds {
            true if events & WantedEvent::TOUCH != 0 => TouchKind::Touch,
            false if events & WantedEvent::SENSOR != 0 => {
                let is_first = number < other_number;
                TouchKind::Sensor { is_first: if is_first { !responds } else { !other_responds } }
            }
            _ => TouchKind::Unreported,
        }
    }

    /// Returns the kind for a pair of proxies.
    pub fn of_proxies(sides: [&Proxy; 2]) -> Self {
        let [a, b] = sides;
        TouchKind::of(sides.map(|side| (side.creation_number, side.responds)), a.events | b.events)
    }

    /// Returns the number of the kind in a snapshot.
    pub fn code(self) -> u8 {
        match self {
            TouchKind::Unreported => 0,
            TouchKind::Touch => 1,
            TouchKind::Sensor { is_first: true } => 2,
            TouchKind::Sensor { is_first: false } => 3,
        }
    }

    /// Returns the kind with a number; unreported for an unknown number.
    pub fn of_code(code: u8) -> Self {
        match code {
            1 => TouchKind::Touch,
            2 | 3 => TouchKind::Sensor { is_first: code == 2 },
            _ => TouchKind::Unreported,
        }
    }
}

/// Event: two geoms begin or cease to touch with one pair of their convex pieces. The geom with the smaller creation number is
/// first.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct TouchEvent {
    /// Creation numbers of the two geoms, the smaller one first.
    pub numbers: (u32, u32),
    /// Whether the touch begins; false if it ends.
    pub begins: bool,
    /// Kind of the typed event.
    pub kind: TouchKind,
    /// Numbers of the two geoms: see [`Proxy::owner`](crate::broad_phase::proxies::Proxy::owner).
    pub owners: [u64; 2],
}

impl TouchEvent {
    /// Returns the event of a pair of pieces, given creation number and
    /// [owner](crate::broad_phase::proxies::Proxy::owner) of both pieces.
    pub fn new(sides: [(u32, u64); 2], begins: bool, kind: TouchKind) -> Self {
        let key = |(number, owner): (u32, u64)| (number, owner.rotate_left(32));
        let [a, b] = sides;
        let (first, second) = if key(a) < key(b) { (a, b) } else { (b, a) };
        TouchEvent { numbers: (first.0, second.0), begins, kind, owners: [first.1, second.1] }
    }

    /// Returns a key that sorts events by the creation numbers of their geoms. The owners decide only in altered snapshots,
    /// where two geoms may have one creation number.
    pub fn sort_key(&self) -> u128 {
        let [first, second] = self.owners.map(|owner| owner as u32);
        packed_key([self.numbers.0, self.numbers.1, u32::from(self.begins) << 31 | first, second])
    }
}
