//! Checksum of snapshots: CRC-32 as in Ethernet and zip.

/// The checksum of two byte slices, one after the other.
#[cfg(not(target_family = "wasm"))]
pub(super) fn crc32(parts: [&[u8]; 2]) -> u32 {
    let mut hasher = crc32fast::Hasher::new();
    parts.iter().for_each(|part| hasher.update(part));
    hasher.finalize()
}

/// Without a processor instruction for it `crc32fast` has tables of sixteen kilobytes, which do not compress.
#[cfg(target_family = "wasm")]
pub(super) use crc32_small_table as crc32;

#[cfg(any(test, target_family = "wasm"))]
pub(super) fn crc32_small_table(parts: [&[u8]; 2]) -> u32 {
    static TABLE: crc::Crc<u32, crc::Table<1>> = crc::Crc::<u32, crc::Table<1>>::new(&crc::CRC_32_ISO_HDLC);
    let mut digest = TABLE.digest();
    parts.iter().for_each(|part| digest.update(part));
    digest.finalize()
}

#[cfg(test)]
mod tests {
    use super::{crc32, crc32_small_table};

    #[test]
    fn small_table_crc_equals_hardware_crc() {
        let bytes: Vec<u8> = (0..1000_u32).map(|at| ((at * at * 31) >> 3) as u8).collect();
        for (start, end) in [(0, 0), (0, 1), (3, 10), (0, 8), (0, 16), (5, 22), (0, 1000)] {
            let parts = [&bytes[..start], &bytes[start..end]];
            assert_eq!(crc32_small_table(parts), crc32(parts), "{start}..{end}");
        }
    }

    #[test]
    fn crc_of_nine_digits_is_the_standard_check_value() {
        assert_eq!([crc32, crc32_small_table].map(|of| of([b"1234", b"56789"])), [0xcbf4_3926; 2]);
    }
}
