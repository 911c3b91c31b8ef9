//! A sparse symmetric matrix of 3x3 blocks, one row of blocks per body, and its factors L D L^T.
//!
//! In the [order of elimination](crate::precise::elimination) the work is that of articulated bodies on trees (D. Baraff,
//! "Linear-time dynamics using Lagrange multipliers", 1996, for that order).

use super::block::{Block, Triple};
use crate::precise::elimination::Elimination;
use crate::storage::reusing_clone::reusing_clone;

/// Where the block of two bodies is, and whether it is kept the other way round.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(in crate::precise) struct Entry {
    at: u32,
    is_turned: bool,
}

/// The matrix and its factors.
#[derive(Debug, Default)]
pub(super) struct Factor {
    /// The graph that was planned for.
    edges: Vec<[u32; 2]>,
    elimination: Elimination,
    /// The matrix: it is kept, since from one step of Newton's method to the next little of it changes.
    on_diagonal: Vec<Block>,
    off_diagonal: Vec<Block>,
    /// By place, whether its column of the matrix has changed since there were factors.
    has_changed: Vec<bool>,
    /// What of it is left to eliminate, before and after it is divided: the factors.
    diagonal: Vec<Block>,
    inverse: Vec<Block>,
    left: Vec<Block>,
    below: Vec<Block>,
    solution: Vec<Triple>,
}

reusing_clone! {
    Factor { edges, elimination, on_diagonal, off_diagonal, has_changed, diagonal, inverse, left, below, solution }
}

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
        let entries = self.elimination.rows.len();
        for of_bodies in [&mut self.on_diagonal, &mut self.diagonal, &mut self.inverse] {
            of_bodies.resize(count, Block::default());
        }
        for of_entries in [&mut self.off_diagonal, &mut self.left, &mut self.below] {
            of_entries.resize(entries, Block::default());
        }
        self.has_changed.resize(count, true);
        self.solution.resize(count, [0.0; 3]);
        true
    }

    /// How many bodies, blocks below the diagonal and products of blocks there are.
    pub(super) fn sizes(&self) -> [usize; 3] {
        let Elimination { order, rows, targets, .. } = &self.elimination;
        [order.len(), rows.len(), targets.len()]
    }

    /// Where the block of two bodies is that are tied.
    pub(super) fn entry(&self, a: u32, b: u32) -> Entry {
        let (at, is_turned) = self.elimination.entry(a, b);
        Entry { at, is_turned }
    }

    /// A matrix of diagonal blocks alone.
    pub(super) fn begin(&mut self, masses: impl Iterator<Item = [f64; 2]>) {
        self.off_diagonal.fill(Block::default());
        self.has_changed.fill(true);
        for (&place, [mass, inertia]) in self.elimination.places.iter().zip(masses) {
            self.on_diagonal[place as usize] = Block::of_diagonal([mass, mass, inertia]);
        }
    }

    #[inline(always)]
    pub(super) fn add(&mut self, body: u32, block: &Block) {
        let place = self.elimination.places[body as usize] as usize;
        self.on_diagonal[place].add(block);
        self.has_changed[place] = true;
    }

    /// Adds a block whose columns are A's and rows B's, after something was [added](Self::add) to both.
    #[inline(always)]
    pub(super) fn add_between(&mut self, entry: Entry, block: &Block) {
        let sum = &mut self.off_diagonal[entry.at as usize];
        sum.add(&if entry.is_turned { block.turned() } else { *block });
    }

    /// Makes the factors anew of columns that have changed and of their ancestors in the tree of elimination, from which something of
    /// them is taken: a column's first row is its parent, and its other rows are all ancestors. Columns that are as they were are only
    /// taken from ancestors again.
    pub(super) fn factorise(&mut self) {
        self.spread_changes();
        let mut product = 0;
        for place in 0..self.elimination.order.len() {
            let column = self.elimination.column(place);
            let count = column.len();
            let has_changed = self.has_changed[place];
            if has_changed {
                self.inverse[place] = self.diagonal[place].inverse();
                for at in column.clone() {
                    self.left[at] = self.below[at];
                    self.below[at] = self.left[at].product(&self.inverse[place]);
                }
            }
            let is_same =
                |at: &usize| !(has_changed || self.has_changed[self.elimination.rows[*at] as usize]);
            let first = column.clone().take_while(is_same).count();
            for at in first..count {
                let divided = self.below[column.start + at];
                let row = self.elimination.rows[column.start + at];
                self.diagonal[row as usize].take(&divided.product(&self.left[column.start + at]));
                for above in first..at {
                    let target = self.elimination.targets[product + at * (at - 1) / 2 + above];
                    self.below[target as usize].take(&divided.product(&self.left[column.start + above]));
                }
            }
            product += count * count.saturating_sub(1) / 2;
        }
        self.has_changed.fill(false);
    }

    /// Columns that have changed, and their ancestors, begin as those of the matrix.
    fn spread_changes(&mut self) {
        for place in 0..self.elimination.order.len() {
            if self.has_changed[place] {
                let column = self.elimination.column(place);
                if let Some(&next) = self.elimination.rows[column.clone()].first() {
                    self.has_changed[next as usize] = true;
                }
                self.diagonal[place] = self.on_diagonal[place];
                self.below[column.clone()].copy_from_slice(&self.off_diagonal[column]);
            }
        }
    }

    /// Solves for a right-hand side by body, in place.
    pub(super) fn solve(&mut self, x: &mut [Triple]) {
        let Factor { elimination, inverse, below, solution, .. } = self;
        for (value, &body) in solution.iter_mut().zip(&elimination.order) {
            *value = x[body as usize];
        }
        for place in 0..elimination.order.len() {
            let value = solution[place];
            for at in elimination.column(place) {
                let part = below[at].times(value);
                let under = &mut solution[elimination.rows[at] as usize];
                *under = std::array::from_fn(|axis| under[axis] - part[axis]);
            }
        }
        for place in (0..elimination.order.len()).rev() {
            let mut value = inverse[place].times(solution[place]);
            for at in elimination.column(place) {
                let part = below[at].turned_times(solution[elimination.rows[at] as usize]);
                value = std::array::from_fn(|axis| value[axis] - part[axis]);
            }
            solution[place] = value;
            x[elimination.order[place] as usize] = value;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Ties of a spring with stiffness k between all of two bodies.
    fn tie(factor: &mut Factor, [a, b]: [u32; 2], k: f64) {
        // u = x_b + 0.5 z_b - x_a - 0.2 z_a + 0.3 (y_b - y_a)
        let (ja, jb) = ([-1.0, -0.3, -0.2], [1.0, 0.3, 0.5]);
        let block = |rows: Triple, columns: Triple| {
            Block::of_rows(rows.map(|row| columns.map(|column| k * row * column)))
        };
        factor.add(a, &block(ja, ja));
        factor.add(b, &block(jb, jb));
        factor.add_between(factor.entry(a, b), &block(jb, ja));
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
    fn factors_of_what_has_changed_are_those_that_are_made_at_once_bit_by_bit() {
        // A ladder, in which much fills in; each tie in turn is put in once more after there are factors.
        let mut edges: Vec<[u32; 2]> =
            (0..8).map(|i| [i, i + 8]).chain((0..7).flat_map(|i| [[i, i + 1], [i + 8, i + 9]])).collect();
        edges.sort_unstable();
        let made = || {
            let mut factor = Factor::default();
            assert!(factor.plan(16, &edges, 1000));
            factor.begin((0..16).map(|_| [1.0, 1.0]));
            edges.iter().for_each(|&edge| tie(&mut factor, edge, 1e3));
            factor
        };
        for (at, &edge) in edges.iter().enumerate() {
            let (mut at_once, mut in_parts) = (made(), made());
            in_parts.factorise();
            for factor in [&mut at_once, &mut in_parts] {
                tie(factor, edge, 77.0);
                factor.factorise();
            }
            assert!(in_parts.has_changed.iter().all(|changed| !changed));
            let bits = |mut factor: Factor| {
                let mut x: Vec<Triple> = (0..16).map(|i| [f64::from(i), 1.0, 0.5]).collect();
                factor.solve(&mut x);
                x.into_iter().flatten().map(f64::to_bits).collect::<Vec<_>>()
            };
            assert_eq!(bits(in_parts), bits(at_once), "tie {at}");
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
