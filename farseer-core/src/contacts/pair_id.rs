//! Two numbers packed into one (behaviour chapter 08, section 4).

/// Packs pairs of 32-bit numbers into 64 bits: the first into the low word, the second into the high one.
#[derive(Debug, Clone, Copy)]
#[doc(alias = "PairID")]
pub struct PairId;

impl PairId {
    /// The same number for both orders of a pair: the smaller one goes into the low word.
    ///
    /// ```
    /// assert_eq!(farseer_core::PairId::get_id(7, 3), 30_064_771_075);
    /// ```
    pub fn get_id(id1: i32, id2: i32) -> i64 {
        Self::get_hash(id1.min(id2), id1.max(id2))
    }

    /// The first value in the low word, the second in the high one.
    pub fn get_hash(value1: i32, value2: i32) -> i64 {
        (i64::from(value2) << 32) | i64::from(value1 as u32)
    }

    /// Both values of a packed pair: low word, high word.
    pub fn get_ids(id: i64) -> (i32, i32) {
        (id as i32, (id >> 32) as i32)
    }
}
