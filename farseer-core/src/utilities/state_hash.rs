//! Hash of the motion of all bodies, by which two runs are compared.

use crate::simulator::PhysicsSimulator;

/// Offset basis of FNV-1a for 64 bits.
const FNV_OFFSET_BASIS: u64 = 0xcbf2_9ce4_8422_2325;
/// Prime of FNV-1a for 64 bits.
const FNV_PRIME: u64 = 0x0000_0100_0000_01b3;

impl PhysicsSimulator {
    /// Hash of position, rotation and velocities of all bodies in [`body_list`](Self::body_list), by their bits and in that
    /// order. Two runs with equal calls have equal hashes after each update, on every platform; runs that part have different
    /// ones, but for a chance of 2^-64. For lock-step games, and for [`Recording`](crate::Recording).
    ///
    /// Impulses of contacts and joints, sleep and the game's settings are not included: a difference in them shows as soon as it
    /// moves a body. The depth axis of an engine above this one is not included either.
    ///
    /// Source: FNV-1a by G. Fowler, L. C. Noll and K.-P. Vo.
    ///
    /// ```
    /// use farseer_core::{BodyBuilder, GeomBuilder, PhysicsSimulator};
    /// let mut simulator = PhysicsSimulator::precise([0.0, 300.0])?;
    /// simulator.add_body(BodyBuilder::dynamic(), [GeomBuilder::circle(10.0)])?;
    /// let mut other = simulator.clone();
    /// simulator.update(1.0 / 60.0);
    /// assert_ne!(simulator.state_hash(), other.state_hash());
    /// other.update(1.0 / 60.0);
    /// assert_eq!(simulator.state_hash(), other.state_hash());
    /// # Ok::<(), farseer_core::Error>(())
    /// ```
    #[doc(alias("checksum", "desync"))]
    pub fn state_hash(&self) -> u64 {
        let mut hash = FNV_OFFSET_BASIS;
        for &id in self.body_list() {
            let body = &self[id];
            let (position, velocity) = (body.position(), body.linear_velocity());
            let numbers =
                [position.x, position.y, body.rotation(), velocity.x, velocity.y, body.angular_velocity()];
            for byte in numbers.into_iter().flat_map(f32::to_le_bytes) {
                hash = (hash ^ u64::from(byte)).wrapping_mul(FNV_PRIME);
            }
        }
        hash
    }
}
