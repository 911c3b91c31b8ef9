//! Narrow phase: the event of two geoms that begin or cease to touch.

use crate::storage::order::packed_key;

/// Event: two geoms begin or cease to touch with one pair of their convex pieces. The geom with the smaller creation number is
/// first.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct TouchEvent {
    /// Creation numbers of the two geoms, the smaller one first.
    pub numbers: (u32, u32),
    /// Whether the touch begins; false if it ends.
    pub begins: bool,
    /// Numbers of the two geoms: see [`Proxy::owner`](crate::broad_phase::proxies::Proxy::owner).
    pub owners: [u64; 2],
}

impl TouchEvent {
    /// Returns the event of a pair of pieces, given creation number and
    /// [owner](crate::broad_phase::proxies::Proxy::owner) of both pieces.
    pub fn new(sides: [(u32, u64); 2], begins: bool) -> Self {
        let key = |(number, owner): (u32, u64)| (number, owner.rotate_left(32));
        let [a, b] = sides;
        let (first, second) = if key(a) < key(b) { (a, b) } else { (b, a) };
        TouchEvent { numbers: (first.0, second.0), begins, owners: [first.1, second.1] }
    }

    /// Returns a key that sorts events by the creation numbers of their geoms. The owners decide only in altered snapshots,
    /// where two geoms may have one creation number.
    pub fn sort_key(&self) -> u128 {
        let [first, second] = self.owners.map(|owner| owner as u32);
        packed_key([self.numbers.0, self.numbers.1, u32::from(self.begins) << 31 | first, second])
    }
}
