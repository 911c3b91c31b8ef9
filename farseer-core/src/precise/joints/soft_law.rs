//! The law of joint rows in the iterative solver, and the effective mass of a block of rows.
//!
//! A row with relative velocity u, position error C and accumulated impulse l changes its impulse by
//! dl = -mass K^-1 (u + bias C + compliance l) - leak l, with K = J M^-1 J^T of the block (E. Catto, "Soft Constraints", GDC 2011;
//! "Solver2D", 2024).

use crate::precise::parameters::joints::{
    BLOCK_PIVOT_FLOOR, JOINT_DAMPING_RATIO, JOINT_FREQUENCY, JOINT_FREQUENCY_PER_RATE,
};
use wide::{f32x4, f64x4};

use super::block_pair::{Lanes, Rows, narrow, put};
use super::hold::Hold;
use crate::math::lanes::select;

/// Coefficients of the law of a row: see the [module](self).
#[derive(Debug, Clone, Copy)]
pub(super) struct Law {
    /// Per second.
    pub(super) bias: f64,
    /// Fractions, 0..=1.
    pub(super) mass: f64,
    pub(super) leak: f64,
    /// Velocity per impulse of a substep, >= 0.
    pub(super) compliance: f64,
}

impl Law {
    /// A rigid row without position error.
    pub(super) const HARD: Law = Law { bias: 0.0, mass: 1.0, leak: 0.0, compliance: 0.0 };

    /// Soft constraint of a substep of `h` seconds: a spring with a damper, integrated implicitly.
    pub(super) fn soft(h: f64) -> Self {
        let omega = std::f64::consts::TAU * least(JOINT_FREQUENCY, JOINT_FREQUENCY_PER_RATE / h);
        let damping = 2.0 * JOINT_DAMPING_RATIO + h * omega;
        let stiffness = h * omega * damping;
        let leak = 1.0 / (1.0 + stiffness);
        Law { bias: omega / damping, mass: stiffness * leak, leak, compliance: 0.0 }
    }

    /// The law of a joint that its user made soft, in both passes; `None` for one that is not. An impulse of a substep is h / dt of
    /// that of an update, for which softness is given.
    pub(super) fn of_softness(hold: &Hold, [dt, h]: [f64; 2]) -> Option<Self> {
        (hold.softness > 0.0).then(|| Law {
            bias: hold.bias_factor / dt,
            compliance: hold.softness * dt / h,
            ..Law::HARD
        })
    }
}

/// The laws of four joints.
#[derive(Debug, Clone, Copy)]
pub(super) struct BlockLaw {
    pub(super) bias: Lanes,
    pub(super) mass: Lanes,
    pub(super) leak: Lanes,
    pub(super) compliance: Lanes,
}

impl BlockLaw {
    /// The same law of all.
    pub(super) fn of(law: &Law) -> Self {
        let all = |number: f64| f32x4::splat(number as f32);
        let Law { bias, mass, leak, compliance } = *law;
        BlockLaw { bias: all(bias), mass: all(mass), leak: all(leak), compliance: all(compliance) }
    }

    /// Gives one of them another law.
    pub(super) fn set(&mut self, lane: usize, law: &Law) {
        let BlockLaw { bias, mass, leak, compliance } = self;
        for (lanes, number) in
            [(bias, law.bias), (mass, law.mass), (leak, law.leak), (compliance, law.compliance)]
        {
            put(lanes, lane, number);
        }
    }

    /// These laws, and where the mask is those others.
    pub(super) fn or(&self, mask: Lanes, other: &Self) -> Self {
        BlockLaw {
            bias: select(mask, other.bias, self.bias),
            mass: select(mask, other.mass, self.mass),
            leak: select(mask, other.leak, self.leak),
            compliance: select(mask, other.compliance, self.compliance),
        }
    }

    /// The impulses after these at missing velocities f = K^-1 (u + bias C + compliance l), given as impulses.
    #[inline(always)]
    pub(super) fn next(&self, impulse: Lanes, missing: Lanes) -> Lanes {
        impulse - self.mass * missing - self.leak * impulse
    }
}

/// The effective mass of blocks of up to three rows: factors L D^-1 L^T of K. Rows that are not kept, or depend on those before them,
/// get no impulse.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct BlockMass {
    /// Of rows 0 and 1, 0 and 2, 1 and 2.
    below: Rows,
    inverse: Rows,
}

impl BlockMass {
    /// Factors of the rows with these masks, of a matrix with this diagonal and these products of rows 0 and 1, 0 and 2, 1 and 2.
    #[inline(always)]
    pub(super) fn of(diagonal: [f64x4; 3], [one_zero, two_zero, two_one]: [f64x4; 3], kept: Rows) -> Self {
        let kept = kept.map(|mask| {
            let is_in = mask.to_array().map(|lane| lane.to_bits() != 0);
            f64x4::new(is_in.map(|is_in| if is_in { 1.0 } else { 0.0 })).simd_gt(f64x4::ZERO)
        });
        let invert = |row: usize, pivot: f64x4| {
            let is_own = pivot.simd_gt(f64x4::splat(BLOCK_PIVOT_FLOOR) * diagonal[row]);
            (f64x4::splat(1.0) / pivot) & is_own & kept[row]
        };
        let first = invert(0, diagonal[0]);
        let (l10, l20) = (one_zero * first, two_zero * first);
        let second = invert(1, diagonal[1] - l10 * one_zero);
        let rest = two_one - l20 * one_zero;
        let l21 = rest * second;
        let third = invert(2, diagonal[2] - l20 * two_zero - l21 * rest);
        BlockMass { below: [l10, l20, l21].map(narrow), inverse: [first, second, third].map(narrow) }
    }

    /// The product of the inverse of K and this.
    #[inline(always)]
    pub(super) fn times(&self, [x, y, z]: Rows) -> Rows {
        let ([l10, l20, l21], [first, second, third]) = (self.below, self.inverse);
        let y = y - l10 * x;
        let z = third * (z - l20 * x - l21 * y);
        let y = second * y - l21 * z;
        [first * x - l10 * y - l20 * z, y, z]
    }
}

/// The smaller of two numbers, the same on every platform.
#[inline(always)]
pub(super) fn least(a: f64, b: f64) -> f64 {
    if a < b { a } else { b }
}

/// A number between -most and most.
#[inline(always)]
pub(super) fn within(number: f64, most: f64) -> f64 {
    if number > most {
        most
    } else if number < -most {
        -most
    } else {
        number
    }
}

#[cfg(test)]
mod tests {
    use wide::{f32x4, f64x4};

    use super::{BlockLaw, BlockMass, Law};
    use crate::precise::joints::block_pair::Rows;

    fn splat(numbers: [f32; 3]) -> Rows {
        numbers.map(f32x4::splat)
    }

    /// Masks of rows by bits.
    fn mask(rows: u32) -> Rows {
        std::array::from_fn(|row| f32x4::splat(f32::from_bits((rows >> row & 1).wrapping_neg())))
    }

    /// K of two bodies of masses 1 and 3 and inertias 4 and 5, with angular parts of rows as a joint has them.
    fn matrix() -> [[f32; 3]; 3] {
        let (a, b) = ([2.0, 1.0, -3.0], [-1.0, 1.0, 4.0]);
        std::array::from_fn(|i| {
            std::array::from_fn(|j| {
                let linear = if i == j && i != 1 { 4.0 / 3.0 } else { 0.0 };
                linear + a[i] * a[j] / 4.0 + b[i] * b[j] / 5.0
            })
        })
    }

    fn mass_of(k: [[f32; 3]; 3], rows: u32) -> BlockMass {
        let wide = |numbers: [f32; 3]| numbers.map(|number| f64x4::splat(number.into()));
        BlockMass::of(wide([k[0][0], k[1][1], k[2][2]]), wide([k[0][1], k[0][2], k[1][2]]), mask(rows))
    }

    #[test]
    fn kept_rows_of_the_product_are_those_that_were_multiplied() {
        let (k, wanted) = (matrix(), [1.0, -2.0, 0.5]);
        for rows in [0b001, 0b010, 0b011, 0b101, 0b111] {
            let found = mass_of(k, rows).times(splat(wanted)).map(|lanes| lanes.to_array()[0]);
            for row in 0..3 {
                let product: f32 = (0..3).map(|j| k[row][j] * found[j]).sum();
                match rows >> row & 1 {
                    // Ten roundings of numbers up to 10.
                    1 => assert!((product - wanted[row]).abs() < 1e-5, "{rows:b} {row}: {product}"),
                    _ => assert_eq!(found[row], 0.0),
                }
            }
        }
    }

    #[test]
    fn a_row_that_depends_on_another_gets_no_impulse() {
        // Two bodies that only turn: both rows of a point are one.
        let arms = [2.0, 0.0, 3.0];
        let found = mass_of(arms.map(|a| arms.map(|b| a * b)), 0b101).times(splat([1.0, 0.0, 1.5]));
        assert_eq!(found.map(|lanes| lanes.to_array()[0]), [0.25, 0.0, 0.0]);
    }

    #[test]
    fn a_soft_row_at_rest_under_a_load_yields_by_its_stiffness() {
        // The impulse l = mass / leak * bias C / K does not change where the velocity is zero.
        let law = Law::soft(1.0 / 240.0);
        let (impulse, inverse_mass) = (2.0, 0.5);
        let error = -law.leak * impulse * inverse_mass / (law.mass * law.bias);
        let missing = law.bias * error / inverse_mass;
        let next = BlockLaw::of(&law).next(f32x4::splat(impulse as f32), f32x4::splat(missing as f32));
        assert!((next.to_array()[0] - impulse as f32).abs() < 1e-6);
    }
}
