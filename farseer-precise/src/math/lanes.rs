//! SIMD helpers: four numbers in lanes. Results that are saved use these and `+ - * / sqrt` alone, so that they have
//! the same bits on every platform: the minimum and maximum of processors differ in signed zeros and NaN.

use crate::index::DenseIndex;
use wide::f32x4;

/// Selects bitwise, for each lane, one of two numbers; the mask is the result of a comparison. It replaces the function
/// of `wide`, which is a call where the compiler does not optimise across crates.
#[inline(always)]
pub fn select(mask: f32x4, if_true: f32x4, if_false: f32x4) -> f32x4 {
    if_false ^ ((if_true ^ if_false) & mask)
}

/// The number where it is above zero, else +0, also for NaN.
#[inline(always)]
pub fn positive(number: f32x4) -> f32x4 {
    greater(number, f32x4::ZERO)
}

/// The greater number; the second one if none is.
#[inline(always)]
pub fn greater(a: f32x4, b: f32x4) -> f32x4 {
    select_each(a, b, a.simd_gt(b), |a, b| if a > b { a } else { b })
}

/// The smaller number; the second one if none is.
#[inline(always)]
pub fn smaller(a: f32x4, b: f32x4) -> f32x4 {
    select_each(a, b, a.simd_lt(b), |a, b| if a < b { a } else { b })
}

/// Selects lanes by `choose`, written so that the compiler makes one instruction of it where the processor has one. For
/// WebAssembly it does not; there the mask selects.
#[inline(always)]
fn select_each(a: f32x4, b: f32x4, is_first: f32x4, choose: impl Fn(f32, f32) -> f32) -> f32x4 {
    if cfg!(target_family = "wasm") {
        return select(is_first, a, b);
    }
    let (a, b) = (a.to_array(), b.to_array());
    f32x4::new(std::array::from_fn(|lane| choose(a[lane], b[lane])))
}

/// Gathers four rows of a table as columns.
#[inline(always)]
pub fn gather<I: DenseIndex>(rows: &[[f32; 4]], places: &[I; 4]) -> [f32x4; 4] {
    f32x4::transpose(places.map(|place| f32x4::new(rows[place.position()])))
}

/// Four consecutive rows as columns.
#[inline(always)]
pub fn columns(rows: &[[f32; 4]; 4]) -> [f32x4; 4] {
    f32x4::transpose(rows.map(f32x4::new))
}

/// Sine and cosine of angles in radians from -pi/4 to slightly more than a full turn, with errors up to 1e-7. The angle
/// is reduced to a quarter turn; the first omitted terms of the Taylor series are below half of the last digit.
#[inline(always)]
pub fn sin_cos(angle: f32x4) -> (f32x4, f32x4) {
    let one = f32x4::splat(1.0);
    // The nearest whole number of quarter turns, in the last binary digits of the sum; halves are rounded up.
    let shift = f32x4::splat(12_582_912.0);
    let shifted = angle * f32x4::splat(std::f32::consts::FRAC_2_PI) + shift;
    let turned = shifted - shift;
    // Pi / 2 in two summands, the first with few enough digits that its products with small whole numbers are exact.
    let x = (angle - turned * f32x4::splat(HALF_PI_HIGH)) - turned * f32x4::splat(HALF_PI_LOW);
    let x2 = x * x;
    let c = |number: f32| f32x4::splat(number);
    let sine = x + x
        * x2
        * (c(-1.0 / 6.0) + x2 * (c(1.0 / 120.0) + x2 * (c(-1.0 / 5040.0) + x2 * c(1.0 / 362_880.0))));
    let cosine = one
        + x2 * (c(-0.5)
            + x2 * (c(1.0 / 24.0)
                + x2 * (c(-1.0 / 720.0) + x2 * (c(1.0 / 40320.0) + x2 * c(-1.0 / 3_628_800.0)))));
    let quarter = shifted.to_array().map(f32::to_bits);
    let of_bits = |bits: [u32; 4]| f32x4::new(bits.map(f32::from_bits));
    let is_odd = of_bits(quarter.map(|quarter| (quarter & 1).wrapping_neg()));
    let sine_sign = of_bits(quarter.map(|quarter| (quarter & 2) << 30));
    let cosine_sign = of_bits(quarter.map(|quarter| (quarter.wrapping_add(1) & 2) << 30));
    (select(is_odd, cosine, sine) ^ sine_sign, select(is_odd, sine, cosine) ^ cosine_sign)
}

/// Pi / 2 rounded to eleven binary digits, in radians, and the remainder.
const HALF_PI_HIGH: f32 = 1.570_312_5;
const HALF_PI_LOW: f32 = (std::f64::consts::FRAC_PI_2 - 1.570_312_5) as f32;

#[cfg(test)]
mod tests {
    use super::{f32x4, sin_cos};

    #[test]
    fn sines_and_cosines_are_within_1e_7_of_the_true_ones() {
        for step in -100..1000 {
            let angle = step as f32 * 0.0071;
            let (sine, cosine) = sin_cos(f32x4::splat(angle));
            let (true_sine, true_cosine) = f64::from(angle).sin_cos();
            // One ulp of a number near 1, and the rounding of pi / 2.
            assert!((f64::from(sine.to_array()[0]) - true_sine).abs() < 1.3e-7, "sine of {angle}");
            assert!((f64::from(cosine.to_array()[0]) - true_cosine).abs() < 1.3e-7, "cosine of {angle}");
        }
    }
}
