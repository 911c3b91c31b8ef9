//! The checksum of snapshots: CRC-32 as in Ethernet and zip.

/// Of these parts, one after the other.
#[cfg(not(target_family = "wasm"))]
pub(super) fn crc32(parts: [&[u8]; 2]) -> u32 {
    let mut hasher = crc32fast::Hasher::new();
    parts.iter().for_each(|part| hasher.update(part));
    hasher.finalize()
}

/// Where no processor has an instruction for it `crc32fast` keeps tables of sixteen kilobytes, which nothing compresses.
#[cfg(target_family = "wasm")]
pub(super) use in_one_kilobyte as crc32;

#[cfg(any(test, target_family = "wasm"))]
pub(super) fn in_one_kilobyte(parts: [&[u8]; 2]) -> u32 {
    static TABLE: crc::Crc<u32, crc::Table<1>> = crc::Crc::<u32, crc::Table<1>>::new(&crc::CRC_32_ISO_HDLC);
    let mut digest = TABLE.digest();
    parts.iter().for_each(|part| digest.update(part));
    digest.finalize()
}

#[cfg(test)]
mod tests {
    use super::{crc32, in_one_kilobyte};

    #[test]
    fn a_small_table_comes_to_what_instructions_come_to() {
        let bytes: Vec<u8> = (0..1000_u32).map(|at| ((at * at * 31) >> 3) as u8).collect();
        for (start, end) in [(0, 0), (0, 1), (3, 10), (0, 8), (0, 16), (5, 22), (0, 1000)] {
            let parts = [&bytes[..start], &bytes[start..end]];
            assert_eq!(in_one_kilobyte(parts), crc32(parts), "{start}..{end}");
        }
    }

    #[test]
    fn the_checksum_of_nine_digits_is_that_of_all_who_compute_it() {
        assert_eq!([crc32, in_one_kilobyte].map(|of| of([b"1234", b"56789"])), [0xcbf4_3926; 2]);
    }
}
