//! A sparse symmetric matrix of 3x3 blocks, one row of blocks per body, and its factors L D L^T.
//!
//! In the [order of elimination](crate::precise::elimination) the work is that of articulated bodies on trees.

use crate::precise::elimination::Elimination;
use crate::storage::reusing_clone::reusing_clone;

/// Velocity, or impulse, of a body: x, y and turning.
pub(super) type Triple = [f64; 3];
/// A symmetric block: xx, xy, yy, xz, yz, zz.
pub(super) type Symmetric = [f64; 6];
/// Any block, by rows.
pub(super) type Block = [f64; 9];

/// Where the block of two bodies is, and whether it is kept the other way round.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct Entry {
    at: u32,
    is_turned: bool,
}

/// The matrix, and then its factors.
#[derive(Debug, Default)]
pub(super) struct Factor {
    /// The graph that was planned for.
    edges: Vec<[u32; 2]>,
    elimination: Elimination,
    diagonal: Vec<Symmetric>,
    inverse: Vec<Symmetric>,
    below: Vec<Block>,
    /// The blocks of a column before they are divided.
    column: Vec<Block>,
    solution: Vec<Triple>,
}

reusing_clone! { Factor { edges, elimination, diagonal, inverse, below, column, solution } }

impl Factor {
    /// Plans for so many bodies, of which these are tied to each other, each pair once and the lesser number first. Answers
    /// whether no more than `most` products of blocks are to be made.
    pub(super) fn plan(&mut self, count: usize, edges: &[[u32; 2]], most: usize) -> bool {
        if self.edges == edges && self.elimination.places.len() == count {
            return self.elimination.targets.len() <= most;
        }
        self.edges.clear();
        self.edges.extend_from_slice(edges);
        let products = |degree: usize| degree * degree.saturating_sub(1) / 2;
        if !self.elimination.plan(count, edges, products, most) {
            return false;
        }
        self.diagonal.resize(count, [0.0; 6]);
        self.inverse.resize(count, [0.0; 6]);
        self.solution.resize(count, [0.0; 3]);
        self.below.resize(self.elimination.rows.len(), [0.0; 9]);
        self.column.resize(self.elimination.longest(), [0.0; 9]);
        true
    }

    /// Where the block of two bodies is that are tied.
    pub(super) fn entry(&self, a: u32, b: u32) -> Entry {
        let (at, is_turned) = self.elimination.entry(a, b);
        Entry { at, is_turned }
    }

    /// A matrix of diagonal blocks alone.
    pub(super) fn begin(&mut self, masses: impl Iterator<Item = [f64; 2]>) {
        self.below.fill([0.0; 9]);
        for (&place, [mass, inertia]) in self.elimination.places.iter().zip(masses) {
            self.diagonal[place as usize] = [mass, 0.0, mass, 0.0, 0.0, inertia];
        }
    }

    #[inline(always)]
    pub(super) fn add(&mut self, body: u32, block: Symmetric) {
        let diagonal = &mut self.diagonal[self.elimination.places[body as usize] as usize];
        diagonal.iter_mut().zip(block).for_each(|(sum, part)| *sum += part);
    }

    /// Adds a block whose columns are A's and rows B's.
    #[inline(always)]
    pub(super) fn add_between(&mut self, entry: Entry, [xx, xy, xz, yx, yy, yz, zx, zy, zz]: Block) {
        let block = if entry.is_turned {
            [xx, yx, zx, xy, yy, zy, xz, yz, zz]
        } else {
            [xx, xy, xz, yx, yy, yz, zx, zy, zz]
        };
        self.below[entry.at as usize].iter_mut().zip(block).for_each(|(sum, part)| *sum += part);
    }

    /// Makes the factors.
    pub(super) fn factorise(&mut self) {
        let mut product = 0;
        for place in 0..self.elimination.order.len() {
            let inverse = inverted(&self.diagonal[place]);
            self.inverse[place] = inverse;
            let column = self.elimination.column(place);
            for at in column.clone() {
                let block = self.below[at];
                let divided = divided(&block, &inverse);
                let diagonal = &mut self.diagonal[self.elimination.rows[at] as usize];
                take_own(diagonal, &divided, &block);
                for above in &self.column[..at - column.start] {
                    take(&mut self.below[self.elimination.targets[product] as usize], &divided, above);
                    product += 1;
                }
                self.column[at - column.start] = block;
                self.below[at] = divided;
            }
        }
    }

    /// Solves for a right-hand side by body, in place.
    pub(super) fn solve(&mut self, x: &mut [Triple]) {
        for (value, &body) in self.solution.iter_mut().zip(&self.elimination.order) {
            *value = x[body as usize];
        }
        for place in 0..self.elimination.order.len() {
            let value = self.solution[place];
            for at in self.elimination.column(place) {
                let (block, below) =
                    (&self.below[at], &mut self.solution[self.elimination.rows[at] as usize]);
                for (i, below) in below.iter_mut().enumerate() {
                    let [p, q, r] = [block[3 * i], block[3 * i + 1], block[3 * i + 2]];
                    *below -= p * value[0] + q * value[1] + r * value[2];
                }
            }
        }
        for place in (0..self.elimination.order.len()).rev() {
            let mut value = by(&self.inverse[place], self.solution[place]);
            for at in self.elimination.column(place) {
                let (block, below) = (&self.below[at], self.solution[self.elimination.rows[at] as usize]);
                for (i, value) in value.iter_mut().enumerate() {
                    *value -= block[i] * below[0] + block[3 + i] * below[1] + block[6 + i] * below[2];
                }
            }
            self.solution[place] = value;
            x[self.elimination.order[place] as usize] = value;
        }
    }
}

/// A block times the inverse of a symmetric one.
#[inline(always)]
fn divided(block: &Block, inverse: &Symmetric) -> Block {
    let row = |i: usize| by(inverse, [block[3 * i], block[3 * i + 1], block[3 * i + 2]]);
    let ([a, b, c], [d, e, f], [g, h, i]) = (row(0), row(1), row(2));
    [a, b, c, d, e, f, g, h, i]
}

#[inline(always)]
fn by([xx, xy, yy, xz, yz, zz]: &Symmetric, [x, y, z]: Triple) -> Triple {
    [x * xx + y * xy + z * xz, x * xy + y * yy + z * yz, x * xz + y * yz + z * zz]
}

/// Element of the product of one block and another one turned.
#[inline(always)]
fn element(one: &Block, i: usize, other: &Block, j: usize) -> f64 {
    one[3 * i] * other[3 * j] + one[3 * i + 1] * other[3 * j + 1] + one[3 * i + 2] * other[3 * j + 2]
}

#[inline(always)]
fn take_own(from: &mut Symmetric, divided: &Block, block: &Block) {
    for (entry, [i, j]) in from.iter_mut().zip([[0, 0], [0, 1], [1, 1], [0, 2], [1, 2], [2, 2]]) {
        *entry -= element(divided, i, block, j);
    }
}

#[inline(always)]
fn take(from: &mut Block, divided: &Block, above: &Block) {
    for (at, entry) in from.iter_mut().enumerate() {
        *entry -= element(divided, at / 3, above, at % 3);
    }
}

/// By the factors L D L^T of the block itself: cofactors lose the square of what this loses.
#[inline(always)]
fn inverted(&[xx, xy, yy, xz, yz, zz]: &Symmetric) -> Symmetric {
    let first = 1.0 / xx;
    let (l10, l20) = (xy * first, xz * first);
    let second = 1.0 / (yy - l10 * xy);
    let rest = yz - l20 * xy;
    let l21 = rest * second;
    let third = 1.0 / (zz - l20 * xz - l21 * rest);
    let corner = l10 * l21 - l20;
    let (b, c) = (-l21 * third, corner * third);
    [first + l10 * l10 * second + corner * c, -l10 * second - l21 * c, second - l21 * b, c, b, third]
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Ties of a spring with stiffness k between all of two bodies.
    fn tie(factor: &mut Factor, [a, b]: [u32; 2], k: f64) {
        // u = x_b + 0.5 z_b - x_a - 0.2 z_a + 0.3 (y_b - y_a)
        let (ja, jb) = ([-1.0, -0.3, -0.2], [1.0, 0.3, 0.5]);
        let symmetric = |j: Triple| {
            [j[0] * j[0], j[0] * j[1], j[1] * j[1], j[0] * j[2], j[1] * j[2], j[2] * j[2]].map(|x| k * x)
        };
        factor.add(a, symmetric(ja));
        factor.add(b, symmetric(jb));
        let block = std::array::from_fn(|at| k * jb[at / 3] * ja[at % 3]);
        factor.add_between(factor.entry(a, b), block);
    }

    /// What the matrix of [`tie`] and unit masses does to a vector.
    fn product(edges: &[[u32; 2]], k: f64, x: &[Triple]) -> Vec<Triple> {
        let mut sums = x.to_vec();
        for &[a, b] in edges {
            let (ja, jb) = ([-1.0, -0.3, -0.2], [1.0, 0.3, 0.5]);
            let dot = |j: Triple, x: Triple| j[0] * x[0] + j[1] * x[1] + j[2] * x[2];
            let u = dot(ja, x[a as usize]) + dot(jb, x[b as usize]);
            for (body, j) in [(a, ja), (b, jb)] {
                (0..3).for_each(|i| sums[body as usize][i] += k * u * j[i]);
            }
        }
        sums
    }

    #[test]
    fn what_is_solved_gives_the_right_hand_side_back_on_a_graph_with_loops() {
        let edges = [[0, 1], [0, 4], [1, 2], [1, 3], [2, 3], [3, 4], [4, 5]];
        let mut factor = Factor::default();
        assert!(factor.plan(6, &edges, 100));
        factor.begin((0..6).map(|_| [1.0, 1.0]));
        edges.iter().for_each(|&edge| tie(&mut factor, edge, 1e3));
        factor.factorise();
        let wanted: Vec<Triple> = (0..6).map(|i| [f64::from(i), 1.0 - f64::from(i), 0.5]).collect();
        let mut x = wanted.clone();
        factor.solve(&mut x);
        for (found, wanted) in
            product(&edges, 1e3, &x).into_iter().flatten().zip(wanted.into_iter().flatten())
        {
            // The backward error of an elimination of 18 rows: 18 times the rounding of f64, the greatest sum of a row
            // (up to four ties of 1e3 with 4 each) and numbers up to 5.
            assert!((found - wanted).abs() < 18.0 * 1.1e-16 * 1.6e4 * 5.0, "{found} is not {wanted}");
        }
    }

    #[test]
    fn nothing_fills_in_on_a_path_and_a_mesh_is_refused_beyond_the_most() {
        let path: Vec<[u32; 2]> = (0..99).map(|i| [i, i + 1]).collect();
        assert!(Factor::default().plan(100, &path, 0));
        let all: Vec<[u32; 2]> = (0..10).flat_map(|a| (a + 1..10).map(move |b| [a, b])).collect();
        assert!(!Factor::default().plan(10, &all, 100));
        assert!(Factor::default().plan(10, &all, 120));
    }
}
