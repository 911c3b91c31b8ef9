//! The law of joint rows in the iterative solver, and the effective mass of a block of rows.
//!
//! A row with relative velocity u, position error C and accumulated impulse l changes its impulse by
//! dl = -mass K^-1 (u + bias C + compliance l) - leak l, with K = J M^-1 J^T of the block (E. Catto, "Soft Constraints", GDC 2011;
//! "Solver2D", 2024).

use super::super::direct::block::Triple;
use super::super::direct::constraint::Set;
use super::hold::Hold;

/// Frequency of joint rows in Hz, and the largest part of the substep rate that it may be. 90 Hz and 120 Hz at 240 substeps/s gain
/// energy in cantilevers and nets. Both are twice those of contacts beside joints, as in Box2D 3.
const FREQUENCY: f64 = 60.0;
const MOST_OF_RATE: f64 = 0.25;
/// Damping ratio of joint rows (dimensionless). Bridges rest later with 2, chains that spin stretch more with 10.
const DAMPING: f64 = 5.0;

/// An error of an angle in radians counts as this at most: it is closed with 32 radians/s at 240 substeps/s then. Speeds of bodies have
/// a bound, spins have none.
pub(super) const GREATEST_ANGLE: f64 = 1.0;

/// A pivot below this part of its diagonal is rounding: the row depends on those before it and gets no impulse.
const LEAST_PIVOT: f64 = 1e-12;

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
        let omega = std::f64::consts::TAU * least(FREQUENCY, MOST_OF_RATE / h);
        let damping = 2.0 * DAMPING + h * omega;
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

    /// The impulse after this one at a missing velocity f = K^-1 (u + bias C + compliance l), given as an impulse.
    #[inline(always)]
    pub(super) fn next(&self, impulse: f64, missing: f64) -> f64 {
        impulse - self.mass * missing - self.leak * impulse
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

/// The inverse of the block of a symmetric matrix that these rows make, 0 elsewhere. Rows that depend on others have zeros, too.
pub(super) fn inverse_of(matrix: &[Triple; 3], rows: Set) -> [Triple; 3] {
    match rows {
        0b101 => inverse_of_two::<0, 2>(matrix),
        0b011 => inverse_of_two::<0, 1>(matrix),
        _ => None,
    }
    .unwrap_or_else(|| swept(matrix, rows))
}

/// The inverse of the block of two rows, unless one depends on the other.
#[inline(always)]
fn inverse_of_two<const I: usize, const J: usize>(matrix: &[Triple; 3]) -> Option<[Triple; 3]> {
    let (one, other, both) = (matrix[I][I], matrix[J][J], matrix[I][J]);
    let determinant = one * other - both * both;
    (determinant > LEAST_PIVOT * one * other).then(|| {
        let (factor, mut inverse) = (1.0 / determinant, [[0.0; 3]; 3]);
        (inverse[I][I], inverse[J][J]) = (other * factor, one * factor);
        (inverse[I][J], inverse[J][I]) = (-both * factor, -both * factor);
        inverse
    })
}

/// The inverse of the block of these rows by the sweep operator (J. Goodnight, "A Tutorial on the SWEEP Operator", 1979).
fn swept(matrix: &[Triple; 3], rows: Set) -> [Triple; 3] {
    let (mut swept, mut set) = (*matrix, 0);
    for pivot in (0..3).filter(|pivot| rows >> pivot & 1 == 1) {
        let own = swept[pivot][pivot];
        if own <= LEAST_PIVOT * matrix[pivot][pivot] {
            continue;
        }
        set |= 1 << pivot;
        let inverse = 1.0 / own;
        let of_pivot = swept[pivot].map(|number| number * inverse);
        for (_, row) in swept.iter_mut().enumerate().filter(|(at, _)| *at != pivot) {
            let factor = row[pivot];
            (0..3).for_each(|i| row[i] -= factor * of_pivot[i]);
            row[pivot] = -factor * inverse;
        }
        swept[pivot] = of_pivot;
        swept[pivot][pivot] = inverse;
    }
    let is_in = |at: usize| set >> at & 1 == 1;
    std::array::from_fn(|i| std::array::from_fn(|j| if is_in(i) && is_in(j) { swept[i][j] } else { 0.0 }))
}

#[inline(always)]
pub(super) fn times(matrix: &[Triple; 3], [x, y, z]: Triple) -> Triple {
    matrix.map(|[a, b, c]| a * x + b * y + c * z)
}

#[cfg(test)]
mod tests {
    use super::{Law, inverse_of};

    /// K of two bodies of masses 1 and 3 and inertias 4 and 5, with arms of rows as a joint has them.
    const MATRIX: [[f64; 3]; 3] = {
        let (a, b) = ([2.0, 1.0, -3.0], [-1.0, 1.0, 4.0]);
        let mut matrix = [[0.0; 3]; 3];
        let mut at = 0;
        while at < 9 {
            let (i, j) = (at / 3, at % 3);
            let linear = if i == j && i != 1 { 4.0 / 3.0 } else { 0.0 };
            matrix[i][j] = linear + a[i] * a[j] / 4.0 + b[i] * b[j] / 5.0;
            at += 1;
        }
        matrix
    };

    #[test]
    fn the_inverse_of_a_block_times_the_block_is_one() {
        for rows in [0b001, 0b010, 0b011, 0b101, 0b111] {
            let inverse = inverse_of(&MATRIX, rows);
            for (i, j) in (0..9).map(|at| (at / 3, at % 3)) {
                let is_in = |row: usize| rows >> row & 1 == 1;
                let product: f64 = (0..3).filter(|&k| is_in(k)).map(|k| inverse[i][k] * MATRIX[k][j]).sum();
                let expected = if i == j { 1.0 } else { 0.0 };
                assert!(!(is_in(i) && is_in(j)) || (product - expected).abs() < 1e-12, "{rows:b} {i} {j}");
            }
        }
    }

    #[test]
    fn a_row_that_depends_on_another_gets_no_impulse() {
        // Two bodies that only turn: both rows of a point are one.
        let arms = [2.0, 0.0, 3.0];
        let matrix = arms.map(|a| arms.map(|b| a * b));
        let inverse = inverse_of(&matrix, 0b101);
        assert_eq!(inverse, [[0.25, 0.0, 0.0], [0.0; 3], [0.0; 3]]);
    }

    #[test]
    fn a_soft_row_at_rest_under_a_load_yields_by_its_stiffness() {
        // The impulse l = mass / leak * bias C / K does not change where the velocity is zero.
        let law = Law::soft(1.0 / 240.0);
        let (impulse, inverse_mass) = (2.0, 0.5);
        let error = -law.leak * impulse * inverse_mass / (law.mass * law.bias);
        let missing = law.bias * error / inverse_mass;
        assert!((law.next(impulse, missing) - impulse).abs() < 1e-12);
    }
}
