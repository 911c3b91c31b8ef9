//! The hashes of a trace: FNV-1a with 64 bits.

use super::StepLine;

/// A hash in the making.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Fnv(u64);

impl Fnv {
    /// The hash of no bytes.
    pub const EMPTY: Fnv = Fnv(14_695_981_039_346_656_037);

    /// Takes in bytes.
    pub fn bytes(&mut self, bytes: &[u8]) {
        for &byte in bytes {
            self.0 = (self.0 ^ u64::from(byte)).wrapping_mul(1_099_511_628_211);
        }
    }

    /// Takes in a 32-bit word, little end first.
    pub fn word(&mut self, word: u32) {
        self.bytes(&word.to_le_bytes());
    }

    /// The hash so far.
    pub fn finish(self) -> u64 {
        self.0
    }
}

/// The line of a step from the states of the bodies, in the order of the body list.
pub fn step_line(
    step: u32,
    bodies: impl IntoIterator<Item = [u32; 7]>,
    arbiters: u32,
    contacts: u32,
) -> StepLine {
    let mut hash = Fnv::EMPTY;
    bodies.into_iter().flatten().for_each(|word| hash.word(word));
    hash.word(arbiters);
    hash.word(contacts);
    StepLine { step, hash: hash.finish(), arbiters, contacts }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_hash_is_fnv_1a() {
        // Published test vectors of FNV-1a with 64 bits.
        for (text, expected) in
            [("", 0xcbf2_9ce4_8422_2325), ("a", 0xaf63_dc4c_8601_ec8c), ("foobar", 0x8594_4171_f739_67e8)]
        {
            let mut hash = Fnv::EMPTY;
            hash.bytes(text.as_bytes());
            assert_eq!(hash.finish(), expected, "{text}");
        }
    }
}
