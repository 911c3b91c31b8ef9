//! Serialisation of derived numbers: as bit patterns in text formats, as numbers in binary ones.
//!
//! They may be infinite, which JSON cannot write, and must be restored to the bit in every text format. All NaN are
//! saved as the same one: sign and payload of a computed NaN differ between processors, and between builds for the same
//! processor, and no arithmetic reads them.

use serde::{Deserialize, Deserializer, Serializer, de::Error as _};

use crate::math::Vector2;
use crate::shape::{Aabb, Vertices};

/// A value that consists of numbers.
pub(crate) trait Floats: Sized {
    fn to_floats(&self) -> Vec<f32>;
    /// `None` if the count is wrong.
    fn from_floats(floats: &[f32]) -> Option<Self>;
}

/// For `#[serde(with = "crate::storage::bits")]`.
pub(crate) fn serialize<T: Floats, S: Serializer>(value: &T, serializer: S) -> Result<S::Ok, S::Error> {
    let numbers = value.to_floats().into_iter().map(saved);
    if serializer.is_human_readable() {
        serializer.collect_seq(numbers.map(f32::to_bits))
    } else {
        serializer.collect_seq(numbers)
    }
}

/// Returns a number as it is saved: all NaN as the same one.
fn saved(number: f32) -> f32 {
    if number.is_nan() { f32::NAN } else { number }
}

/// For `#[serde(with = "crate::storage::bits")]`.
pub(crate) fn deserialize<'de, T: Floats, D: Deserializer<'de>>(deserializer: D) -> Result<T, D::Error> {
    let floats: Vec<f32> = if deserializer.is_human_readable() {
        Vec::<u32>::deserialize(deserializer)?.into_iter().map(f32::from_bits).collect()
    } else {
        Vec::deserialize(deserializer)?
    };
    T::from_floats(&floats).ok_or_else(|| D::Error::custom("a wrong number of bit patterns"))
}

impl Floats for f32 {
    fn to_floats(&self) -> Vec<f32> {
        vec![*self]
    }
    fn from_floats(floats: &[f32]) -> Option<Self> {
        <[f32; 1]>::try_from(floats).ok().map(|[value]| value)
    }
}

impl Floats for Vector2 {
    fn to_floats(&self) -> Vec<f32> {
        vec![self.x, self.y]
    }
    fn from_floats(floats: &[f32]) -> Option<Self> {
        <[f32; 2]>::try_from(floats).ok().map(|[x, y]| Vector2::new(x, y))
    }
}

impl Floats for Aabb {
    fn to_floats(&self) -> Vec<f32> {
        vec![self.min.x, self.min.y, self.max.x, self.max.y]
    }
    fn from_floats(floats: &[f32]) -> Option<Self> {
        let [min_x, min_y, max_x, max_y] = <[f32; 4]>::try_from(floats).ok()?;
        Some(Aabb { min: Vector2::new(min_x, min_y), max: Vector2::new(max_x, max_y) })
    }
}

impl Floats for Vertices {
    fn to_floats(&self) -> Vec<f32> {
        self.iter().flat_map(|v| [v.x, v.y]).collect()
    }
    fn from_floats(floats: &[f32]) -> Option<Self> {
        let (pairs, rest) = floats.as_chunks::<2>();
        rest.is_empty().then(|| pairs.iter().map(|&[x, y]| Vector2::new(x, y)).collect())
    }
}

#[cfg(test)]
mod tests {
    use super::saved;

    #[test]
    fn every_nan_is_saved_as_the_same_bits() {
        let nans = [0xffc0_0000, 0x7fc0_0001, 0x7f80_0001, 0xffff_ffff].map(f32::from_bits);
        assert!(nans.iter().all(|&nan| saved(nan).to_bits() == 0x7fc0_0000));
    }

    #[test]
    fn numbers_are_saved_bit_for_bit() {
        let numbers = [0.0, -0.0, 1.0, -1e-45, f32::INFINITY, f32::NEG_INFINITY];
        assert!(numbers.iter().all(|&number| saved(number).to_bits() == number.to_bits()));
    }
}
