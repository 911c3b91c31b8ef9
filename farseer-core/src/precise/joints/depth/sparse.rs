//! A sparse symmetric matrix of numbers and its factors L D L^T.

use crate::precise::elimination::Elimination;
use crate::storage::reusing_clone::reusing_clone;

/// The matrix, and then its factors. Rows and columns go by their place in the order of elimination.
#[derive(Debug, Default)]
pub(super) struct Sparse {
    elimination: Elimination,
    diagonal: Vec<f64>,
    below: Vec<f64>,
    column: Vec<f64>,
    solution: Vec<f64>,
}

reusing_clone! { Sparse { elimination, diagonal, below, column, solution } }

impl Sparse {
    /// Plans for so many rows, of which these are tied to each other: each pair once and the lesser number first, in order.
    /// `None` if that takes more than `most` products.
    pub(super) fn plan(count: usize, edges: &[[u32; 2]], most: usize) -> Option<Self> {
        let mut elimination = Elimination::default();
        // Those that go to the diagonal are counted too.
        let products = |degree: usize| degree * (degree + 1) / 2;
        elimination.plan(count, edges, products, most).then(|| Sparse {
            diagonal: vec![0.0; count],
            solution: vec![0.0; count],
            below: vec![0.0; elimination.rows.len()],
            column: vec![0.0; elimination.longest()],
            elimination,
        })
    }

    /// Of how many products its factors are made.
    pub(super) fn products(&self) -> usize {
        self.elimination.targets.len()
    }

    /// Where the number of two tied rows is kept.
    pub(super) fn entry(&self, a: u32, b: u32) -> u32 {
        self.elimination.entry(a, b).0
    }

    /// All numbers are 0.
    pub(super) fn clear(&mut self) {
        self.diagonal.fill(0.0);
        self.below.fill(0.0);
    }

    pub(super) fn set_diagonal(&mut self, row: usize, value: f64) {
        self.diagonal[self.elimination.places[row] as usize] = value;
    }

    pub(super) fn add_below(&mut self, entry: u32, value: f64) {
        self.below[entry as usize] += value;
    }

    /// Finds the factors, in place: the diagonal keeps its reciprocal.
    pub(super) fn factor(&mut self) {
        let mut target = 0;
        for place in 0..self.diagonal.len() {
            let column = self.elimination.column(place);
            let inverse = 1.0 / self.diagonal[place];
            self.diagonal[place] = inverse;
            for (kept, below) in self.column.iter_mut().zip(&mut self.below[column.clone()]) {
                *kept = *below;
                *below *= inverse;
            }
            for at in 0..column.len() {
                let factor = self.below[column.start + at];
                self.diagonal[self.elimination.rows[column.start + at] as usize] -= factor * self.column[at];
                for above in 0..at {
                    self.below[self.elimination.targets[target] as usize] -= factor * self.column[above];
                    target += 1;
                }
            }
        }
    }

    /// Solves for a right side, in place.
    pub(super) fn solve(&mut self, values: &mut [f64]) {
        let Sparse { elimination, diagonal, below, solution, .. } = self;
        let Elimination { places, rows, .. } = &*elimination;
        values.iter().zip(places.iter()).for_each(|(&value, &place)| solution[place as usize] = value);
        let columns = || (0..places.len()).map(|place| (place, elimination.column(place)));
        for (place, column) in columns() {
            let value = solution[place];
            column.for_each(|at| solution[rows[at] as usize] -= below[at] * value);
        }
        for (place, column) in columns().rev() {
            let rest: f64 = column.map(|at| below[at] * solution[rows[at] as usize]).sum();
            solution[place] = solution[place] * diagonal[place] - rest;
        }
        values.iter_mut().zip(places.iter()).for_each(|(value, &place)| *value = solution[place as usize]);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A matrix of this graph, each row heavier than what ties it, and a right side.
    fn check(count: u32, ties: &[[u32; 2]]) {
        let mut sparse = Sparse::plan(count as usize, ties, usize::MAX).unwrap();
        let value = |at: usize| 1.0 + 0.3 * at as f64;
        let mut dense = vec![vec![0.0; count as usize]; count as usize];
        sparse.clear();
        for (at, row) in dense.iter_mut().enumerate() {
            row[at] = 40.0 + at as f64;
            sparse.set_diagonal(at, row[at]);
        }
        for (at, &[a, b]) in ties.iter().enumerate() {
            sparse.add_below(sparse.entry(a, b), value(at));
            (dense[a as usize][b as usize], dense[b as usize][a as usize]) = (value(at), value(at));
        }
        sparse.factor();
        let right: Vec<f64> = (0..count).map(|at| f64::from(at % 5) - 2.0).collect();
        let mut solution = right.clone();
        sparse.solve(&mut solution);
        for (row, right) in dense.iter().zip(right) {
            let left: f64 = row.iter().zip(&solution).map(|(a, b)| a * b).sum();
            assert!((left - right).abs() < 1e-12, "{left} is not {right}");
        }
    }

    #[test]
    fn what_it_solves_it_has_solved() {
        check(4, &[[0, 1], [1, 2], [2, 3]]);
        check(4, &[[0, 1], [0, 3], [1, 2], [1, 3], [2, 3]]);
        let net: Vec<[u32; 2]> =
            (0..25).flat_map(|at| [[at, at + 1], [at, at + 5]]).filter(|ties| ties[1] < 25).collect();
        check(25, &net);
    }

    #[test]
    fn along_a_rope_nothing_fills_in() {
        let ties: Vec<[u32; 2]> = (0..49).map(|at| [at, at + 1]).collect();
        assert_eq!(Sparse::plan(50, &ties, usize::MAX).unwrap().below.len(), 49);
    }

    #[test]
    fn what_takes_too_much_is_not_planned() {
        let all: Vec<[u32; 2]> = (0..30).flat_map(|a| (a + 1..30).map(move |b| [a, b])).collect();
        assert!(Sparse::plan(30, &all, 1000).is_none());
    }
}
