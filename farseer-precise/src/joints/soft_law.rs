//! Softness of the joint rows of the iterative solver, and the effective mass of a block of rows.
//!
//! A joint row with relative velocity u, position error C and accumulated impulse l changes its impulse by
//!
//! ```text
//! dl = -mass_scale K^-1 (u + bias_rate C + compliance l) - impulse_scale l,   K = J M^-1 J^T of its block
//! ```
//!
//! This is a soft constraint (E. Catto, "Soft Constraints", GDC 2011; "Solver2D", 2024; `b2MakeSoft` of Box2D 3). Its
//! coefficients are `RowSoftness`. `BlockEffectiveMass` holds the factors of K for up to three rows of four joints, in SIMD
//! lanes.

use crate::parameters::joints::{
    BLOCK_PIVOT_FLOOR, JOINT_DAMPING_RATIO, JOINT_FREQUENCY, JOINT_FREQUENCY_PER_RATE,
};
use wide::{f32x4, f64x4};

use super::block_pair::{JointLanes, RowLanes, set_lane_rounded, to_f32};
use super::joint_constraint::JointConstraint;
use crate::math::lanes::select;

/// Coefficients of a soft joint row. A solve changes the accumulated impulse l by dl = -`mass_scale` K^-1 (u + `bias_rate` C +
/// `compliance` l) - `impulse_scale` l.
///
/// Here u is the relative velocity of the row, C its position error and K its inverse effective mass.
#[derive(Debug, Clone, Copy)]
pub(super) struct RowSoftness {
    /// Correction velocity per position error, 1/s, >= 0.
    pub(super) bias_rate: f64,
    /// Fraction of a rigid row's impulse that each solve applies, dimensionless, 0..=1.
    pub(super) mass_scale: f64,
    /// Fraction of the accumulated impulse that each solve removes, dimensionless, 0..=1.
    pub(super) impulse_scale: f64,
    /// Velocity per accumulated impulse of a substep, >= 0: 1/(mass units) in linear rows, 1/(mass units * length units^2) in
    /// the angular row.
    pub(super) compliance: f64,
}

impl RowSoftness {
    /// Softness of a rigid row without position correction, for the relaxation after bodies have moved.
    pub(super) const RIGID: RowSoftness =
        RowSoftness { bias_rate: 0.0, mass_scale: 1.0, impulse_scale: 0.0, compliance: 0.0 };

    /// Returns the softness of a rigid joint in substeps of `h` seconds: a damped spring, integrated implicitly.
    ///
    /// Its frequency is the smaller of [`JOINT_FREQUENCY`] and [`JOINT_FREQUENCY_PER_RATE`] / h; its damping ratio is
    /// [`JOINT_DAMPING_RATIO`].
    pub(super) fn soft(h: f64) -> Self {
        let omega = std::f64::consts::TAU * min(JOINT_FREQUENCY, JOINT_FREQUENCY_PER_RATE / h);
        let damping_factor = 2.0 * JOINT_DAMPING_RATIO + h * omega;
        let stiffness = h * omega * damping_factor;
        let impulse_scale = 1.0 / (1.0 + stiffness);
        RowSoftness {
            bias_rate: omega / damping_factor,
            mass_scale: stiffness * impulse_scale,
            impulse_scale,
            compliance: 0.0,
        }
    }

    /// Returns the softness of a joint whose user gave it a compliance (`softness`); `None` for other joints. It holds for the
    /// solve with bias and for the relaxation.
    ///
    /// A user gives `softness` for an update of `dt` seconds. The impulse of a substep of `h` seconds is h / dt of that of an
    /// update, so the compliance is `softness` dt / h.
    pub(super) fn of_compliant_joint(joint: &JointConstraint, [dt, h]: [f64; 2]) -> Option<Self> {
        (joint.softness > 0.0).then(|| RowSoftness {
            bias_rate: joint.bias_factor / dt,
            compliance: joint.softness * dt / h,
            ..RowSoftness::RIGID
        })
    }
}

/// Softness of four joints, one in each SIMD lane, with the units of [`RowSoftness`].
#[derive(Debug, Clone, Copy)]
pub(super) struct RowSoftnessLanes {
    pub(super) bias_rate: JointLanes,
    pub(super) mass_scale: JointLanes,
    pub(super) impulse_scale: JointLanes,
    pub(super) compliance: JointLanes,
}

impl RowSoftnessLanes {
    /// Returns `softness` in all four lanes.
    pub(super) fn splat(softness: &RowSoftness) -> Self {
        let all = |number: f64| f32x4::splat(number as f32);
        let RowSoftness { bias_rate: bias, mass_scale: mass, impulse_scale: leak, compliance } = *softness;
        RowSoftnessLanes {
            bias_rate: all(bias),
            mass_scale: all(mass),
            impulse_scale: all(leak),
            compliance: all(compliance),
        }
    }

    /// Stores `softness`, the softness of a joint, in one lane.
    pub(super) fn set_lane(&mut self, lane: usize, softness: &RowSoftness) {
        let RowSoftnessLanes { bias_rate: bias, mass_scale: mass, impulse_scale: leak, compliance } = self;
        for (lanes, number) in [
            (bias, softness.bias_rate),
            (mass, softness.mass_scale),
            (leak, softness.impulse_scale),
            (compliance, softness.compliance),
        ] {
            set_lane_rounded(lanes, lane, number);
        }
    }

    /// Returns `other` in the lanes where `mask` has all bits set, `self` in the other lanes.
    pub(super) fn select(&self, mask: JointLanes, other: &Self) -> Self {
        RowSoftnessLanes {
            bias_rate: select(mask, other.bias_rate, self.bias_rate),
            mass_scale: select(mask, other.mass_scale, self.mass_scale),
            impulse_scale: select(mask, other.impulse_scale, self.impulse_scale),
            compliance: select(mask, other.compliance, self.compliance),
        }
    }

    /// Returns the accumulated impulses of a row after a solve: mass units * length units/s, in the angular row mass units *
    /// length units^2/s. `impulse` holds those before it.
    ///
    /// `impulse_error` is K^-1 (u + bias_rate C + compliance l) in the unit of impulses, with velocity u, position error C and
    /// impulse l.
    #[inline(always)]
    pub(super) fn next_impulse(&self, impulse: JointLanes, impulse_error: JointLanes) -> JointLanes {
        impulse - self.mass_scale * impulse_error - self.impulse_scale * impulse
    }
}

/// Effective masses of four joints with up to three rows each: the factors L D L^T of K, the inverse effective mass, one joint
/// in each lane.
///
/// Inactive rows get no impulse. A row that depends linearly on the rows before it gets none either.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct BlockEffectiveMass {
    /// Elements 10, 20 and 21 (row and column number) of the unit lower triangular matrix L.
    lower: RowLanes,
    /// Diagonal elements of D^-1 in the order of rows, 0 for rows that get no impulse: mass units, in the angular row mass
    /// units * length units^2.
    inverse_pivots: RowLanes,
}

impl BlockEffectiveMass {
    /// Factorises K, given by its `diagonal` and its elements 10, 20 and 21 (row and column number). `active` masks the rows
    /// that belong to the block: see [`wide_masks`].
    ///
    /// A pivot below [`BLOCK_PIVOT_FLOOR`] times its diagonal element is rounding; its row gets no impulse.
    #[inline(always)]
    pub(super) fn factorise(
        diagonal: [f64x4; 3],
        [one_zero, two_zero, two_one]: [f64x4; 3],
        active: [f64x4; 3],
    ) -> Self {
        let invert = |row: usize, pivot: f64x4| {
            let is_own = pivot.simd_gt(f64x4::splat(BLOCK_PIVOT_FLOOR) * diagonal[row]);
            (f64x4::splat(1.0) / pivot) & is_own & active[row]
        };
        let first = invert(0, diagonal[0]);
        let (l10, l20) = (one_zero * first, two_zero * first);
        let second = invert(1, diagonal[1] - l10 * one_zero);
        let rest = two_one - l20 * one_zero;
        let l21 = rest * second;
        let third = invert(2, diagonal[2] - l20 * two_zero - l21 * rest);
        BlockEffectiveMass {
            lower: [l10, l20, l21].map(to_f32),
            inverse_pivots: [first, second, third].map(to_f32),
        }
    }

    /// Returns the impulses K^-1 u for the velocities u of the rows (length units/s, in the angular row radians/s): mass
    /// units * length units/s, in the angular row mass units * length units^2/s.
    #[inline(always)]
    pub(super) fn solve(&self, [x, y, z]: RowLanes) -> RowLanes {
        let ([l10, l20, l21], [first, second, third]) = (self.lower, self.inverse_pivots);
        let y = y - l10 * x;
        let z = third * (z - l20 * x - l21 * y);
        let y = second * y - l21 * z;
        [first * x - l10 * y - l20 * z, y, z]
    }
}

/// Returns masks of rows for f64: all bits of a lane are set where a bit of `masks` is set, else none.
pub(super) fn wide_masks(masks: RowLanes) -> [f64x4; 3] {
    masks.map(|mask| {
        let is_in = mask.to_array().map(|lane| lane.to_bits() != 0);
        f64x4::new(is_in.map(|is_in| if is_in { 1.0 } else { 0.0 })).simd_gt(f64x4::ZERO)
    })
}

/// Returns the smaller number. `f64::min` may differ between platforms in its treatment of zeros; this comparison does not.
#[inline(always)]
pub(super) fn min(a: f64, b: f64) -> f64 {
    if a < b { a } else { b }
}

/// Returns `value` clamped to -`limit`..=`limit`, in the unit of both.
#[inline(always)]
pub(super) fn clamp_symmetric(value: f64, limit: f64) -> f64 {
    if value > limit {
        limit
    } else if value < -limit {
        -limit
    } else {
        value
    }
}

#[cfg(test)]
mod tests {
    use wide::{f32x4, f64x4};

    use super::{BlockEffectiveMass, RowSoftness, RowSoftnessLanes, wide_masks};
    use crate::joints::block_pair::RowLanes;

    fn splat(numbers: [f32; 3]) -> RowLanes {
        numbers.map(f32x4::splat)
    }

    /// Returns a mask for each row: all bits set if its bit in `rows` is set, else 0.
    fn row_masks(rows: u32) -> RowLanes {
        std::array::from_fn(|row| f32x4::splat(f32::from_bits((rows >> row & 1).wrapping_neg())))
    }

    /// Returns K of a joint between bodies of masses 1 and 3 and moments of inertia 4 and 5.
    fn matrix() -> [[f32; 3]; 3] {
        let (a, b) = ([2.0, 1.0, -3.0], [-1.0, 1.0, 4.0]);
        std::array::from_fn(|i| {
            std::array::from_fn(|j| {
                let linear = if i == j && i != 1 { 4.0 / 3.0 } else { 0.0 };
                linear + a[i] * a[j] / 4.0 + b[i] * b[j] / 5.0
            })
        })
    }

    fn mass_of(k: [[f32; 3]; 3], rows: u32) -> BlockEffectiveMass {
        let wide = |numbers: [f32; 3]| numbers.map(|number| f64x4::splat(number.into()));
        BlockEffectiveMass::factorise(
            wide([k[0][0], k[1][1], k[2][2]]),
            wide([k[0][1], k[0][2], k[1][2]]),
            wide_masks(row_masks(rows)),
        )
    }

    #[test]
    fn solve_inverts_the_matrix_of_the_active_rows() {
        let (k, wanted) = (matrix(), [1.0, -2.0, 0.5]);
        for rows in [0b001, 0b010, 0b011, 0b101, 0b111] {
            let found = mass_of(k, rows).solve(splat(wanted)).map(|lanes| lanes.to_array()[0]);
            for row in 0..3 {
                let product: f32 = (0..3).map(|j| k[row][j] * found[j]).sum();
                match rows >> row & 1 {
                    // The tolerance covers ten roundings of numbers up to 10.
                    1 => assert!((product - wanted[row]).abs() < 1e-5, "{rows:b} {row}: {product}"),
                    _ => assert_eq!(found[row], 0.0),
                }
            }
        }
    }

    #[test]
    fn a_linearly_dependent_row_gets_no_impulse() {
        // Two bodies that only rotate: both linear rows of the joint are the same row.
        let arms = [2.0, 0.0, 3.0];
        let found = mass_of(arms.map(|a| arms.map(|b| a * b)), 0b101).solve(splat([1.0, 0.0, 1.5]));
        assert_eq!(found.map(|lanes| lanes.to_array()[0]), [0.25, 0.0, 0.0]);
    }

    #[test]
    fn a_loaded_soft_row_is_in_equilibrium_at_the_deflection_of_its_stiffness() {
        // In equilibrium (u = 0, dl = 0) the impulse is l = -mass_scale / impulse_scale * bias_rate * C / K.
        let law = RowSoftness::soft(1.0 / 240.0);
        let (impulse, inverse_mass) = (2.0, 0.5);
        let error = -law.impulse_scale * impulse * inverse_mass / (law.mass_scale * law.bias_rate);
        let missing = law.bias_rate * error / inverse_mass;
        let next = RowSoftnessLanes::splat(&law)
            .next_impulse(f32x4::splat(impulse as f32), f32x4::splat(missing as f32));
        assert!((next.to_array()[0] - impulse as f32).abs() < 1e-6);
    }
}
