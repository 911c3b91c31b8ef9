//! Content of snapshots: a binary format of `serde` in which zeros take one bit.
//!
//! Most numbers of a resting world are 0: velocities, forces, impulses, second contact points, everything of the depth axis in
//! 2D. A value is a row of items, each a number or a flag. A mask of one byte precedes each eight items: bit `n` is set if item
//! `n` is not 0. The bytes of the items that are not 0 follow the mask.
//!
//! | item | bytes if not 0 |
//! |---|---|
//! | `bool`; whether an `Option` is `Some` | 0 |
//! | `f32`, `f64` | 4 or 8: the bits, least byte first. -0.0 is not 0 |
//! | `u8`, `i8` | 1 |
//! | other integers; length of a sequence; index of an enum's variant | 1 to 10, seven bits a byte, least first; signed ones in zigzag |
//!
//! Strings and bytes follow the item of their length as they are. Structs, tuples and enum contents have no bytes of their own.
//! The format does not describe itself. Source of masks before groups of values: D. Lemire, N. Kurz and C. Rupp, "Stream VByte",
//! 2018; of integers in zigzag: Protocol Buffers.

mod reader;
mod writer;

use std::fmt::Display;

use serde::Serialize;
use serde::de::DeserializeOwned;

/// Number of items that share a mask.
const GROUP: u8 = 8;

/// Value that cannot be written or read.
#[derive(Debug)]
pub(super) struct PackedError;

impl Display for PackedError {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str("the value and its packed form contradict each other")
    }
}

impl std::error::Error for PackedError {}

impl serde::ser::Error for PackedError {
    fn custom<T: Display>(_: T) -> Self {
        PackedError
    }
}

impl serde::de::Error for PackedError {
    fn custom<T: Display>(_: T) -> Self {
        PackedError
    }
}

/// Appends the packed form of a value to `bytes`.
///
/// # Errors
/// A value whose type needs to describe itself: a sequence of unknown length, an error of its own.
pub(super) fn write<T: Serialize + ?Sized>(value: &T, bytes: Vec<u8>) -> Result<Vec<u8>, PackedError> {
    let mut writer = writer::Writer::new(bytes);
    value.serialize(&mut writer)?;
    Ok(writer.finish())
}

/// Reads a value and returns the bytes behind it.
///
/// # Errors
/// Bytes that end too early or that no value has.
pub(super) fn read<T: DeserializeOwned>(bytes: &[u8]) -> Result<(T, &[u8]), PackedError> {
    let mut reader = reader::Reader::new(bytes);
    let value = T::deserialize(&mut reader)?;
    Ok((value, reader.rest()))
}

#[cfg(test)]
mod tests {
    use serde::{Deserialize, Serialize};

    #[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
    enum Kind {
        Unit,
        One(i32),
        Two(u8, f64),
        Named { name: String, is_set: bool },
    }

    #[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
    struct Everything {
        flags: [bool; 3],
        floats: Vec<f32>,
        wide: (f64, u64, i64),
        small: (u8, i8, u16, i16, char),
        maybe: [Option<u32>; 3],
        kinds: Vec<Kind>,
        nested: Vec<Vec<(u32, Option<Box<f32>>)>>,
        nothing: (),
    }

    fn everything() -> Everything {
        Everything {
            flags: [true, false, true],
            floats: vec![0.0, -0.0, 1.5, f32::MIN_POSITIVE, -3.25],
            wide: (-0.0, u64::MAX, i64::MIN),
            small: (255, -128, 300, -300, 'ß'),
            maybe: [None, Some(0), Some(u32::MAX)],
            kinds: vec![
                Kind::Unit,
                Kind::One(-1),
                Kind::Two(0, 2.5),
                Kind::Named { name: "a name of more than a few letters".repeat(20), is_set: true },
            ],
            nested: (0..40)
                .map(|at| vec![(at, (at % 3 == 0).then(|| Box::new(at as f32))); at as usize])
                .collect(),
            nothing: (),
        }
    }

    #[test]
    fn every_kind_of_value_comes_back_bit_for_bit() {
        let value = everything();
        let bytes = super::write(&value, Vec::new()).unwrap();
        let (back, rest) = super::read::<Everything>(&bytes).unwrap();
        assert_eq!(back, value);
        assert!(back.floats[1].is_sign_negative() && back.wide.0.is_sign_negative());
        assert!(rest.is_empty());
        // Written behind other bytes it has the same ones.
        let behind = super::write(&value, vec![7, 7]).unwrap();
        assert_eq!((&behind[..2], &behind[2..]), (&[7, 7][..], &bytes[..]));
    }

    #[test]
    fn bytes_cut_anywhere_are_refused() {
        let bytes = super::write(&everything(), Vec::new()).unwrap();
        for end in 0..bytes.len() {
            assert!(super::read::<Everything>(&bytes[..end]).is_err(), "cut to {end} bytes");
        }
    }

    #[test]
    fn a_length_beyond_the_bytes_reserves_no_memory() {
        let bytes = super::write(&u64::MAX, Vec::new()).unwrap();
        assert!(super::read::<Vec<u64>>(&bytes).is_err());
        assert!(super::read::<String>(&bytes).is_err());
    }

    #[test]
    fn eight_zeros_take_a_byte() {
        let zeros = ([0.0_f32; 4], [false; 2], 0_u64, None::<u32>);
        assert_eq!(super::write(&zeros, Vec::new()).unwrap(), [0]);
        assert_eq!(super::write(&[0.0_f32, 1.0], Vec::new()).unwrap(), [0b10, 0, 0, 128, 63]);
    }
}
