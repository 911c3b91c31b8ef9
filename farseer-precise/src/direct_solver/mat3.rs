//! 3x3 matrices in SIMD lanes: the blocks of the [block LDL^T factorisation](super::block_ldlt).
//!
//! Rows and columns are x, y and the angle of a body. The first two rows of each column share one `f64x2`, and so do the first
//! two columns of the last row. With this layout a product of two matrices moves no value from one lane to another.

use wide::f64x2;

/// Vector with one component per degree of freedom of a body: x, y, angle. For velocities: length units/s, length units/s,
/// radians/s. For impulses: mass units * length units/s for x and y, mass units * length units^2/s for the angle.
pub(crate) type Vec3 = [f64; 3];

/// A 3x3 matrix. The unit of each entry is that of its use, such as mass units for the linear entries of a mass matrix.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct Mat3 {
    /// Rows x and y of each column: lane 0 is row x, lane 1 is row y.
    upper_columns: [f64x2; 3],
    /// Columns x and y of the last row, the row of the angle.
    last_row: f64x2,
    /// Entry of the last row and last column, in the unit of the matrix: for a mass matrix the moment of inertia.
    corner: f64,
}

/// Returns both lanes of `lanes`, each copied to both lanes of a vector.
#[inline(always)]
fn splat_lanes(lanes: f64x2) -> [f64x2; 2] {
    lanes.to_array().map(f64x2::splat)
}

impl Mat3 {
    /// Returns the matrix with these three rows.
    pub(super) fn from_rows([[xx, xy, xz], [yx, yy, yz], [zx, zy, zz]]: [Vec3; 3]) -> Self {
        let upper = [[xx, yx], [xy, yy], [xz, yz]].map(f64x2::new);
        Mat3 { upper_columns: upper, last_row: f64x2::new([zx, zy]), corner: zz }
    }

    /// Returns the diagonal matrix with these three entries.
    pub(super) fn from_diagonal([x, y, z]: Vec3) -> Self {
        Mat3::from_rows([[x, 0.0, 0.0], [0.0, y, 0.0], [0.0, 0.0, z]])
    }

    /// Returns the three rows of the matrix.
    #[inline(always)]
    fn rows(&self) -> [Vec3; 3] {
        let [[xx, yx], [xy, yy], [xz, yz]] = self.upper_columns.map(f64x2::to_array);
        let [zx, zy] = self.last_row.to_array();
        [[xx, xy, xz], [yx, yy, yz], [zx, zy, self.corner]]
    }

    /// Returns the product A B^T of this matrix A and `other`, B.
    #[inline(always)]
    pub(super) fn mul_transposed(&self, other: &Mat3) -> Mat3 {
        let [[xx, yx], [xy, yy], [xz, yz]] = other.upper_columns.map(splat_lanes);
        let ([zx, zy], zz) = (splat_lanes(other.last_row), f64x2::splat(other.corner));
        let ([x, y, z], [u, v]) = (self.upper_columns, splat_lanes(self.last_row));
        let [first, second] = (self.last_row * other.last_row).to_array();
        let last = u * other.upper_columns[0]
            + v * other.upper_columns[1]
            + f64x2::splat(self.corner) * other.upper_columns[2];
        Mat3 {
            upper_columns: [x * xx + y * xy + z * xz, x * yx + y * yy + z * yz, x * zx + y * zy + z * zz],
            last_row: last,
            corner: first + second + self.corner * other.corner,
        }
    }

    /// Adds `other` to this matrix.
    #[inline(always)]
    pub(super) fn add(&mut self, other: &Mat3) {
        self.upper_columns.iter_mut().zip(other.upper_columns).for_each(|(sum, added)| *sum += added);
        self.last_row += other.last_row;
        self.corner += other.corner;
    }

    /// Subtracts `other` from this matrix.
    #[inline(always)]
    pub(super) fn subtract(&mut self, other: &Mat3) {
        self.upper_columns
            .iter_mut()
            .zip(other.upper_columns)
            .for_each(|(rest, subtracted)| *rest -= subtracted);
        self.last_row -= other.last_row;
        self.corner -= other.corner;
    }

    /// Returns the transpose of this matrix.
    #[inline(always)]
    pub(super) fn transposed(&self) -> Mat3 {
        let [[xx, xy, xz], [yx, yy, yz], [zx, zy, zz]] = self.rows();
        Mat3::from_rows([[xx, yx, zx], [xy, yy, zy], [xz, yz, zz]])
    }

    /// Returns the product of this matrix and a vector.
    #[inline(always)]
    pub(super) fn mul_vec(&self, [x, y, z]: Vec3) -> Vec3 {
        let [first, second, third] = self.upper_columns;
        let upper = first * f64x2::splat(x) + second * f64x2::splat(y) + third * f64x2::splat(z);
        let ([last_x, last_y], [x_sum, y_sum]) = (self.last_row.to_array(), upper.to_array());
        [x_sum, y_sum, last_x * x + last_y * y + self.corner * z]
    }

    /// Returns the product of the transpose of this matrix and a vector.
    #[inline(always)]
    pub(super) fn transposed_mul_vec(&self, [x, y, z]: Vec3) -> Vec3 {
        let upper = f64x2::new([x, y]);
        let [first, second, third] = self.upper_columns.map(|column| column * upper);
        let [[ax, ay], [bx, by], [cx, cy]] = [first, second, third].map(f64x2::to_array);
        let sums = f64x2::new([ax + ay, bx + by]) + self.last_row * f64x2::splat(z);
        let [x, y] = sums.to_array();
        [x, y, cx + cy + self.corner * z]
    }

    /// Returns the inverse of this symmetric matrix, from its scalar factors L D L^T.
    ///
    /// The factors are used because the formula with cofactors loses twice as many digits on an ill-conditioned matrix.
    #[inline(always)]
    pub(super) fn inverse_symmetric(&self) -> Mat3 {
        let [[xx, xy, xz], [_, yy, yz], [_, _, zz]] = self.rows();
        let first = 1.0 / xx;
        let (l10, l20) = (xy * first, xz * first);
        let second = 1.0 / (yy - l10 * xy);
        let rest = yz - l20 * xy;
        let l21 = rest * second;
        let third = 1.0 / (zz - l20 * xz - l21 * rest);
        let corner = l10 * l21 - l20;
        let (b, c) = (-l21 * third, corner * third);
        let (d, e, f) = (first + l10 * l10 * second + corner * c, -l10 * second - l21 * c, second - l21 * b);
        Mat3::from_rows([[d, e, c], [e, f, b], [c, b, third]])
    }
}
