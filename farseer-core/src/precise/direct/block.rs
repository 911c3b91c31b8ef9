//! Blocks of three rows and columns. Of each column the first two rows are in lanes, and of the last row the first two columns:
//! then products of blocks need no lane of what is in another one.

use wide::f64x2;

/// Velocity, or impulse, of a body: x, y and turning.
pub(in crate::precise) type Triple = [f64; 3];

/// By columns the rows x and y, and the last row: its columns x and y, and its last one.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct Block {
    upper: [f64x2; 3],
    last: f64x2,
    corner: f64,
}

/// Each lane, in both.
#[inline(always)]
fn spread(lanes: f64x2) -> [f64x2; 2] {
    lanes.to_array().map(f64x2::splat)
}

impl Block {
    pub(super) fn of_rows([[xx, xy, xz], [yx, yy, yz], [zx, zy, zz]]: [Triple; 3]) -> Self {
        let upper = [[xx, yx], [xy, yy], [xz, yz]].map(f64x2::new);
        Block { upper, last: f64x2::new([zx, zy]), corner: zz }
    }

    pub(super) fn of_diagonal([x, y, z]: Triple) -> Self {
        Block::of_rows([[x, 0.0, 0.0], [0.0, y, 0.0], [0.0, 0.0, z]])
    }

    #[inline(always)]
    fn rows(&self) -> [Triple; 3] {
        let [[xx, yx], [xy, yy], [xz, yz]] = self.upper.map(f64x2::to_array);
        let [zx, zy] = self.last.to_array();
        [[xx, xy, xz], [yx, yy, yz], [zx, zy, self.corner]]
    }

    /// This block and another one turned.
    #[inline(always)]
    pub(super) fn product(&self, other: &Block) -> Block {
        let [[xx, yx], [xy, yy], [xz, yz]] = other.upper.map(spread);
        let ([zx, zy], zz) = (spread(other.last), f64x2::splat(other.corner));
        let ([x, y, z], [u, v]) = (self.upper, spread(self.last));
        let [first, second] = (self.last * other.last).to_array();
        let last = u * other.upper[0] + v * other.upper[1] + f64x2::splat(self.corner) * other.upper[2];
        Block {
            upper: [x * xx + y * xy + z * xz, x * yx + y * yy + z * yz, x * zx + y * zy + z * zz],
            last,
            corner: first + second + self.corner * other.corner,
        }
    }

    #[inline(always)]
    pub(super) fn add(&mut self, other: &Block) {
        self.upper.iter_mut().zip(other.upper).for_each(|(sum, part)| *sum += part);
        self.last += other.last;
        self.corner += other.corner;
    }

    #[inline(always)]
    pub(super) fn take(&mut self, other: &Block) {
        self.upper.iter_mut().zip(other.upper).for_each(|(rest, part)| *rest -= part);
        self.last -= other.last;
        self.corner -= other.corner;
    }

    #[inline(always)]
    pub(super) fn turned(&self) -> Block {
        let [[xx, xy, xz], [yx, yy, yz], [zx, zy, zz]] = self.rows();
        Block::of_rows([[xx, yx, zx], [xy, yy, zy], [xz, yz, zz]])
    }

    /// This block times a vector.
    #[inline(always)]
    pub(super) fn times(&self, [x, y, z]: Triple) -> Triple {
        let [first, second, third] = self.upper;
        let upper = first * f64x2::splat(x) + second * f64x2::splat(y) + third * f64x2::splat(z);
        let ([last_x, last_y], [x_sum, y_sum]) = (self.last.to_array(), upper.to_array());
        [x_sum, y_sum, last_x * x + last_y * y + self.corner * z]
    }

    /// This block turned, times a vector.
    #[inline(always)]
    pub(super) fn turned_times(&self, [x, y, z]: Triple) -> Triple {
        let upper = f64x2::new([x, y]);
        let [first, second, third] = self.upper.map(|column| column * upper);
        let [[ax, ay], [bx, by], [cx, cy]] = [first, second, third].map(f64x2::to_array);
        let sums = f64x2::new([ax, bx]) + f64x2::new([ay, by]) + self.last * f64x2::splat(z);
        let [x, y] = sums.to_array();
        [x, y, cx + cy + self.corner * z]
    }

    /// Of a symmetric block, by its factors L D L^T: cofactors lose the square of what this loses.
    #[inline(always)]
    pub(super) fn inverse(&self) -> Block {
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
        Block::of_rows([[d, e, c], [e, f, b], [c, b, third]])
    }
}
