//! Records of fixed size as 32-bit words, of which those that are not 0 are saved.
//!
//! In binary formats a snapshot has a record as bytes. They begin with a mask of a bit for each word: the first word has the lowest
//! bit of the first byte. The words whose bit is set follow, least byte first. In text formats a record has its fields by name.

use serde::Serializer;
use serde::de::{Deserializer, Error, Visitor};

/// Greatest number of words of a record.
const MAX_WORDS: usize = 64;
/// Greatest length of a record, bytes.
const MAX_LENGTH: usize = MAX_WORDS / 8 + 4 * MAX_WORDS;

/// A record. Writing and reading visit the same fields in the same order.
pub trait Record: Sized {
    /// Number of words, at most 64.
    const WORDS: usize;

    /// Visits all fields: each is written to the words or overwritten from them.
    fn visit(&mut self, words: &mut impl Words);
}

/// Words of a record that are written or read.
pub trait Words {
    /// Writes or reads one word.
    fn word(&mut self, word: &mut u32);

    /// Writes or reads a number of 32 bits.
    #[inline(always)]
    fn float(&mut self, number: &mut f32) {
        let mut word = number.to_bits();
        self.word(&mut word);
        *number = f32::from_bits(word);
    }

    /// Writes or reads numbers of 32 bits.
    #[inline(always)]
    fn floats(&mut self, numbers: &mut [f32]) {
        numbers.iter_mut().for_each(|number| self.float(number));
    }

    /// Writes or reads 64 bits, the lower half first.
    #[inline(always)]
    fn long(&mut self, long: &mut u64) {
        let (mut low, mut high) = (*long as u32, (*long >> 32) as u32);
        self.word(&mut low);
        self.word(&mut high);
        *long = u64::from(high) << 32 | u64::from(low);
    }

    /// Writes or reads flags, as bits of one word.
    #[inline(always)]
    fn flags<const N: usize>(&mut self, flags: [&mut bool; N]) {
        let mut word = (0..).zip(&flags).fold(0, |word, (at, flag)| word | u32::from(**flag) << at);
        self.word(&mut word);
        (0..).zip(flags).for_each(|(at, flag)| *flag = word >> at & 1 == 1);
    }

    /// Writes or reads numbers that may be absent, as a word that tells so and the numbers.
    #[inline(always)]
    fn maybe<const N: usize>(&mut self, numbers: &mut Option<[f32; N]>) {
        let mut is_some = numbers.is_some();
        self.flags([&mut is_some]);
        let mut present = numbers.unwrap_or([0.0; N]);
        self.floats(&mut present);
        *numbers = is_some.then_some(present);
    }
}

/// Words that are written.
struct Writing {
    words: [u32; MAX_WORDS],
    count: usize,
}

impl Words for Writing {
    #[inline(always)]
    fn word(&mut self, word: &mut u32) {
        self.words[self.count] = *word;
        self.count += 1;
    }
}

/// Words that are read.
struct Reading {
    words: [u32; MAX_WORDS],
    count: usize,
}

impl Words for Reading {
    #[inline(always)]
    fn word(&mut self, word: &mut u32) {
        *word = self.words[self.count];
        self.count += 1;
    }
}

/// Serialises a record: `serialize_fields` is that of its fields by name.
///
/// # Errors
/// An error of the serializer.
#[inline]
pub fn serialize<R: Record + Clone, S: Serializer>(
    record: &R,
    serializer: S,
    serialize_fields: impl FnOnce(&R, S) -> Result<S::Ok, S::Error>,
) -> Result<S::Ok, S::Error> {
    if serializer.is_human_readable() {
        return serialize_fields(record, serializer);
    }
    let mut writing = Writing { words: [0; MAX_WORDS], count: 0 };
    record.clone().visit(&mut writing);
    debug_assert_eq!(writing.count, R::WORDS, "number of words");
    let mut bytes = [0; MAX_LENGTH];
    let mut length = R::WORDS.div_ceil(8);
    for (group, words) in writing.words[..R::WORDS].chunks(8).enumerate() {
        let mut mask = 0;
        for (bit, &word) in words.iter().enumerate() {
            bytes[length..length + 4].copy_from_slice(&word.to_le_bytes());
            let is_set = word != 0;
            mask |= u8::from(is_set) << bit;
            length += 4 * usize::from(is_set);
        }
        bytes[group] = mask;
    }
    serializer.serialize_bytes(&bytes[..length])
}

/// Reads a record: `deserialize_fields` is that of its fields by name.
///
/// # Errors
/// An error of the deserializer; bytes of another length than their masks tell.
pub fn deserialize<'de, R: Record + Default, D: Deserializer<'de>>(
    deserializer: D,
    deserialize_fields: impl FnOnce(D) -> Result<R, D::Error>,
) -> Result<R, D::Error> {
    if deserializer.is_human_readable() {
        return deserialize_fields(deserializer);
    }
    let words = deserializer.deserialize_bytes(WordsVisitor { count: R::WORDS })?;
    let mut record = R::default();
    record.visit(&mut Reading { words, count: 0 });
    Ok(record)
}

/// Reads the words of a record from its bytes.
struct WordsVisitor {
    count: usize,
}

impl Visitor<'_> for WordsVisitor {
    type Value = [u32; MAX_WORDS];

    fn expecting(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str("a record of words")
    }

    fn visit_bytes<E: Error>(self, bytes: &[u8]) -> Result<Self::Value, E> {
        let wrong = || E::custom("a record of another length");
        let (masks, mut rest) = bytes.split_at_checked(self.count.div_ceil(8)).ok_or_else(wrong)?;
        let mut words = [0; MAX_WORDS];
        for (at, word) in words[..self.count].iter_mut().enumerate() {
            if masks[at / 8] >> (at % 8) & 1 == 1 {
                let (bytes, others) = rest.split_first_chunk().ok_or_else(wrong)?;
                (*word, rest) = (u32::from_le_bytes(*bytes), others);
            }
        }
        if rest.is_empty() { Ok(words) } else { Err(wrong()) }
    }
}

/// Implements `Serialize` and `Deserialize` for a [`Record`] that derives them with `#[serde(remote = "Self")]`.
#[macro_export]
macro_rules! saved_record {
    ($type:ty) => {
        impl serde::Serialize for $type {
            #[inline]
            fn serialize<S: serde::Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
                $crate::storage::words::serialize(self, serializer, |record, serializer| {
                    <$type>::serialize(record, serializer)
                })
            }
        }

        impl<'de> serde::Deserialize<'de> for $type {
            fn deserialize<D: serde::Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
                $crate::storage::words::deserialize(deserializer, |deserializer| {
                    <$type>::deserialize(deserializer)
                })
            }
        }
    };
}

#[cfg(test)]
mod tests {
    use super::*;
    use serde::{Deserialize, Serialize};

    #[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize)]
    #[serde(remote = "Self")]
    struct Sample {
        numbers: [f32; 9],
        flags: [bool; 3],
        long: u64,
        maybe: [Option<[f32; 2]>; 2],
    }

    impl Record for Sample {
        const WORDS: usize = 18;

        fn visit(&mut self, words: &mut impl Words) {
            words.floats(&mut self.numbers);
            let [a, b, c] = &mut self.flags;
            words.flags([a, b, c]);
            words.long(&mut self.long);
            self.maybe.iter_mut().for_each(|maybe| words.maybe(maybe));
        }
    }

    saved_record!(Sample);

    #[test]
    fn a_record_comes_back_bit_for_bit() {
        let mut sample = Sample { long: u64::MAX - 5, maybe: [None, Some([0.0, 2.0])], ..Sample::default() };
        (sample.numbers[1], sample.numbers[8], sample.flags[2]) = (-0.0, 1.5, true);
        let mut writing = Writing { words: [0; MAX_WORDS], count: 0 };
        sample.clone().visit(&mut writing);
        assert_eq!(writing.count, Sample::WORDS);
        let mut back = Sample::default();
        back.visit(&mut Reading { words: writing.words, count: 0 });
        assert_eq!(back, sample);
        assert!(back.numbers[1].is_sign_negative());
    }

    #[test]
    fn bytes_of_another_length_are_refused() {
        let read =
            |bytes: &[u8]| WordsVisitor { count: 9 }.visit_bytes::<serde::de::value::Error>(bytes).ok();
        assert_eq!(
            read(&[2, 1, 7, 0, 0, 0, 9, 0, 0, 0]).map(|words| [words[1], words[8], words[0]]),
            Some([7, 9, 0])
        );
        assert_eq!(read(&[2, 1, 7, 0, 0, 0, 9, 0, 0]), None);
        assert_eq!(read(&[2, 0, 7, 0, 0, 0, 9, 0, 0, 0]), None);
        assert_eq!(read(&[2]), None);
    }
}
