//! The hash function FNV-1a (64 bits), which gives the same value on every platform.

/// A hash to which bytes can be appended.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Hash(u64);

impl Default for Hash {
    fn default() -> Self {
        Hash(0xcbf2_9ce4_8422_2325)
    }
}

impl Hash {
    /// Returns the hash of some bytes.
    pub fn of(bytes: &[u8]) -> Self {
        Hash::default().with(bytes)
    }

    /// Returns the hash of the bytes so far and these bytes.
    pub fn with(self, bytes: &[u8]) -> Self {
        Hash(bytes.iter().fold(self.0, |hash, &byte| (hash ^ u64::from(byte)).wrapping_mul(0x100_0000_01b3)))
    }

    /// Returns the hash as a number.
    pub fn value(self) -> u64 {
        self.0
    }
}

#[cfg(test)]
mod tests {
    use super::Hash;

    #[test]
    fn the_hash_is_fnv_1a() {
        assert_eq!(Hash::of(b"foobar").value(), 0x8594_4171_f739_67e8);
    }
}
