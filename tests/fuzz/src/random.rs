//! Source of random numbers, which are the same on every platform.

use farseer_core::math::Vector2;
use twohalf::Vector3;

/// Wild numbers: numbers at the limits of `f32` arithmetic, and other rare ones.
const WILD: [f32; 26] = [
    0.0,
    -0.0,
    f32::NAN,
    f32::INFINITY,
    f32::NEG_INFINITY,
    f32::MAX,
    f32::MIN,
    f32::MIN_POSITIVE,
    1e-45,
    -1e-45,
    1e-38,
    1e-30,
    1e-20,
    1e-10,
    1e10,
    -1e10,
    1e15,
    1e18,
    1e19,
    1e20,
    -1e30,
    1e38,
    3e38,
    -1.0,
    16_777_216.0,
    2_147_483_648.0,
];

/// Wild integers for counts.
const WILD_COUNTS: [i32; 12] = [0, 1, 2, -1, 5, 10, 100, 1000, -5, 31, i32::MAX, i32::MIN];

/// Pseudorandom generator splitmix64 (Steele, Lea and Flood, 2014), which draws values of several kinds.
#[derive(Debug, Clone)]
pub struct Random {
    state: u64,
    wild: u64,
}

impl Random {
    /// Returns a generator that never draws wild numbers. Equal seeds give equal numbers.
    pub fn new(seed: u64) -> Self {
        Random { state: seed, wild: 0 }
    }

    /// Returns this generator, with `percent` wild ones among its [numbers](Self::number) and [counts](Self::count).
    pub fn with_wildness(self, percent: u64) -> Self {
        Random { wild: percent, ..self }
    }

    /// Returns a new generator that is as wild as this one. Its seed is drawn from this one.
    pub fn split(&mut self) -> Self {
        Random::new(self.bits()).with_wildness(self.wild)
    }

    /// Draws 64 random bits.
    pub fn bits(&mut self) -> u64 {
        self.state = self.state.wrapping_add(0x9E37_79B9_7F4A_7C15);
        let mut z = self.state;
        z = (z ^ (z >> 30)).wrapping_mul(0xBF58_476D_1CE4_E5B9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94D0_49BB_1331_11EB);
        z ^ (z >> 31)
    }

    /// Draws an integer in `0..end`; returns 0 if `end` is 0.
    pub fn below(&mut self, end: usize) -> usize {
        if end == 0 { 0 } else { (self.bits() % end as u64) as usize }
    }

    /// Returns true with a probability of `percent`.
    pub fn chance(&mut self, percent: u64) -> bool {
        self.bits() % 100 < percent
    }

    /// Returns true with a probability of one half.
    pub fn toss(&mut self) -> bool {
        self.chance(50)
    }

    /// Draws an item of a list.
    ///
    /// # Panics
    /// If the list is empty.
    pub fn pick<T: Copy>(&mut self, list: &[T]) -> T {
        list[self.below(list.len())]
    }

    /// Draws an ordinary number in `low..high`.
    pub fn between(&mut self, low: f32, high: f32) -> f32 {
        let unit = (self.bits() >> 40) as f32 / (1u64 << 24) as f32;
        low + (high - low) * unit
    }

    /// Draws an ordinary number in `low..high`, or a wild number.
    pub fn number(&mut self, low: f32, high: f32) -> f32 {
        if self.chance(self.wild) { self.wild_number() } else { self.between(low, high) }
    }

    /// Draws a wild number. One in ten is a random pattern of 32 bits.
    pub fn wild_number(&mut self) -> f32 {
        if self.chance(10) { f32::from_bits(self.bits() as u32) } else { self.pick(&WILD) }
    }

    /// Draws an integer in `low..=high`, or a wild one.
    pub fn count(&mut self, low: i32, high: i32) -> i32 {
        if self.chance(self.wild) {
            self.pick(&WILD_COUNTS)
        } else {
            low + self.below((high - low + 1) as usize) as i32
        }
    }

    /// Draws a vector whose components are in `-reach..reach`, or wild.
    pub fn vector(&mut self, reach: f32) -> Vector2 {
        Vector2::new(self.number(-reach, reach), self.number(-reach, reach))
    }

    /// Draws a vector in three dimensions, whose components are in `-reach..reach`, or wild.
    pub fn vector3(&mut self, reach: f32) -> Vector3 {
        Vector3::new(self.number(-reach, reach), self.number(-reach, reach), self.number(-reach, reach))
    }
}

#[cfg(test)]
mod tests {
    use super::Random;

    #[test]
    fn the_generator_is_splitmix64() {
        // The expected values are the first ones of the reference implementation for the seed 1234567.
        let mut random = Random::new(1_234_567);
        assert_eq!(random.bits(), 6_457_827_717_110_365_317);
        assert_eq!(random.bits(), 3_203_168_211_198_807_973);
    }

    #[test]
    fn tame_numbers_stay_in_their_range() {
        let mut random = Random::new(1);
        assert!((0..1000).all(|_| (2.0..=3.0).contains(&random.number(2.0, 3.0))));
    }
}
