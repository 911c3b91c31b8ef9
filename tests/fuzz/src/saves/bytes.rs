//! Alters the bytes of snapshots.

use crate::random::Random;

/// Length of the header of a snapshot in bytes: magic, version, checksum and length (module `snapshot` of the 2D engine).
const HEADER: usize = 24;

/// Alters some bytes after the header. Some alterations copy bytes from another snapshot.
pub(super) fn alter(bytes: &mut Vec<u8>, other: &[u8], random: &mut Random) {
    for _ in 0..1 + random.below(4) {
        if bytes.len() > HEADER {
            let at = HEADER + random.below(bytes.len() - HEADER);
            random.pick(ALTERATIONS)(bytes, at, other, random);
        }
    }
    if random.chance(5) {
        bytes.truncate(random.below(bytes.len()).max(HEADER));
    }
}

/// A function that alters the bytes of a snapshot from a position on. Arguments: bytes, position, another snapshot, random
/// numbers.
type Alteration = fn(&mut Vec<u8>, usize, &[u8], &mut Random);

const ALTERATIONS: &[Alteration] = &[
    |bytes, at, _, random| bytes[at] ^= 1 << random.below(8),
    |bytes, at, _, random| bytes[at] ^= 1 << random.below(8),
    |bytes, at, _, random| bytes[at] = random.pick(&[0, 1, 2, 0x7f, 0x80, 0xfe, 0xff]),
    |bytes, at, _, random| {
        let end = (at + 1 + random.below(16)).min(bytes.len());
        bytes.drain(at..end);
    },
    |bytes, at, _, random| {
        let inserted: Vec<u8> = (0..1 + random.below(16)).map(|_| random.bits() as u8).collect();
        bytes.splice(at..at, inserted);
    },
    |bytes, at, _, random| {
        let from = HEADER + random.below(bytes.len() - HEADER);
        let piece = piece(bytes, from, random.below(200)).to_vec();
        overwrite(bytes, at, &piece);
    },
    |bytes, at, other, random| {
        let from = HEADER + random.below(other.len() - HEADER);
        overwrite(bytes, at, piece(other, from, random.below(300)));
    },
    |bytes, at, _, random| overwrite(bytes, at, &random.wild_number().to_le_bytes()),
    // Writes the greatest number of 32 bits in the format of snapshots.
    |bytes, at, _, _| overwrite(bytes, at, &[0xff, 0xff, 0xff, 0xff, 0x0f]),
];

fn piece(bytes: &[u8], from: usize, length: usize) -> &[u8] {
    &bytes[from..(from + length).min(bytes.len())]
}

fn overwrite(bytes: &mut [u8], at: usize, piece: &[u8]) {
    let length = piece.len().min(bytes.len() - at);
    bytes[at..at + length].copy_from_slice(&piece[..length]);
}

/// Corrects the length and the checksum in the header, so that they match the altered bytes.
pub(super) fn mend(bytes: &mut [u8]) {
    let length = (bytes.len() - HEADER) as u64;
    bytes[16..HEADER].copy_from_slice(&length.to_le_bytes());
    let mut hasher = crc32fast::Hasher::new();
    hasher.update(&bytes[..12]);
    hasher.update(&bytes[16..]);
    bytes[12..16].copy_from_slice(&hasher.finalize().to_le_bytes());
}
