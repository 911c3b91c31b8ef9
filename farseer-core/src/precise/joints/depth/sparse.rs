//! A sparse symmetric matrix and its factors L D L^T.
//!
//! The order of elimination is that of least degree, ties by number: along a rope nothing fills in, and the work goes with its
//! length. What fills in, and which product goes where, is planned once per graph.

use std::collections::BTreeSet;

use crate::storage::reusing_clone::reusing_clone;

/// The matrix, and then its factors. Rows and columns go by their place in the order of elimination.
#[derive(Debug, Default)]
pub(super) struct Sparse {
    /// By row its place in the order.
    places: Vec<u32>,
    /// By place: where its column begins, and of each number below the diagonal the place of its row.
    starts: Vec<u32>,
    rows: Vec<u32>,
    /// Where each product of two numbers of one column goes: on the diagonal, or below it.
    targets: Vec<u32>,
    diagonal: Vec<f64>,
    below: Vec<f64>,
    column: Vec<f64>,
    solution: Vec<f64>,
}

reusing_clone! { Sparse { places, starts, rows, targets, diagonal, below, column, solution } }

impl Sparse {
    /// Plans for rows of which each is tied to those of greater numbers that are listed with it. `None` if that takes more than
    /// `most` products.
    pub(super) fn plan(ties: &[BTreeSet<u32>], most: usize) -> Option<Self> {
        let mut partners = vec![BTreeSet::new(); ties.len()];
        for (row, of_row) in ties.iter().enumerate() {
            for &other in of_row {
                partners[row].insert(other);
                partners[other as usize].insert(row as u32);
            }
        }
        let mut sparse = Sparse { places: vec![u32::MAX; ties.len()], ..Sparse::default() };
        let columns = sparse.eliminate(partners, most)?;
        sparse.lay_out(&columns);
        Some(sparse)
    }

    /// Of how many products its factors are made.
    pub(super) fn products(&self) -> usize {
        self.targets.len()
    }

    /// The rows that each one is tied to when it is eliminated, in the order of elimination.
    fn eliminate(&mut self, mut partners: Vec<BTreeSet<u32>>, most: usize) -> Option<Vec<BTreeSet<u32>>> {
        let mut waiting = BTreeSet::new();
        partners.iter().zip(0_u32..).for_each(|(of_row, row)| {
            waiting.insert((of_row.len(), row));
        });
        let (mut columns, mut products) = (Vec::with_capacity(partners.len()), 0);
        while let Some((degree, row)) = waiting.pop_first() {
            products += degree * (degree + 1) / 2;
            if products > most {
                return None;
            }
            self.places[row as usize] = columns.len() as u32;
            let column = std::mem::take(&mut partners[row as usize]);
            for &partner in &column {
                let of_partner = &mut partners[partner as usize];
                waiting.remove(&(of_partner.len(), partner));
                of_partner.remove(&row);
                of_partner.extend(column.iter().filter(|&&other| other != partner));
                waiting.insert((of_partner.len(), partner));
            }
            columns.push(column);
        }
        Some(columns)
    }

    fn lay_out(&mut self, columns: &[BTreeSet<u32>]) {
        self.starts.push(0);
        for column in columns {
            let start = self.rows.len();
            self.rows.extend(column.iter().map(|&row| self.places[row as usize]));
            self.rows[start..].sort_unstable();
            self.starts.push(self.rows.len() as u32);
        }
        for place in 0..columns.len() {
            let column = self.column(place);
            for (at, &row) in self.rows[column.clone()].iter().enumerate() {
                for &above in &self.rows[column.start..column.start + at] {
                    self.targets.push(self.find(above, row));
                }
            }
        }
        let longest = columns.iter().map(BTreeSet::len).max().unwrap_or(0);
        self.diagonal.resize(columns.len(), 0.0);
        self.solution.resize(columns.len(), 0.0);
        self.below.resize(self.rows.len(), 0.0);
        self.column.resize(longest, 0.0);
    }

    fn column(&self, place: usize) -> std::ops::Range<usize> {
        self.starts[place] as usize..self.starts[place + 1] as usize
    }

    /// The number of a column at this row, which the plan has.
    fn find(&self, column: u32, row: u32) -> u32 {
        let range = self.column(column as usize);
        (range.start + self.rows[range].partition_point(|&other| other < row)) as u32
    }

    /// Where the number of two tied rows is kept.
    pub(super) fn entry(&self, a: u32, b: u32) -> u32 {
        let (a, b) = (self.places[a as usize], self.places[b as usize]);
        self.find(a.min(b), a.max(b))
    }

    /// All numbers are 0.
    pub(super) fn clear(&mut self) {
        self.diagonal.fill(0.0);
        self.below.fill(0.0);
    }

    pub(super) fn set_diagonal(&mut self, row: usize, value: f64) {
        self.diagonal[self.places[row] as usize] = value;
    }

    pub(super) fn add_below(&mut self, entry: u32, value: f64) {
        self.below[entry as usize] += value;
    }

    /// Finds the factors, in place: the diagonal keeps its reciprocal.
    pub(super) fn factor(&mut self) {
        let mut target = 0;
        for place in 0..self.diagonal.len() {
            let column = self.column(place);
            let inverse = 1.0 / self.diagonal[place];
            self.diagonal[place] = inverse;
            for (kept, below) in self.column.iter_mut().zip(&mut self.below[column.clone()]) {
                *kept = *below;
                *below *= inverse;
            }
            for at in 0..column.len() {
                let factor = self.below[column.start + at];
                self.diagonal[self.rows[column.start + at] as usize] -= factor * self.column[at];
                for above in 0..at {
                    self.below[self.targets[target] as usize] -= factor * self.column[above];
                    target += 1;
                }
            }
        }
    }

    /// Solves for a right side, in place.
    pub(super) fn solve(&mut self, values: &mut [f64]) {
        let Sparse { places, starts, rows, diagonal, below, solution, .. } = self;
        values.iter().zip(places.iter()).for_each(|(&value, &place)| solution[place as usize] = value);
        let columns = || starts.windows(2).map(|ends| ends[0] as usize..ends[1] as usize).enumerate();
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
        let mut above = vec![BTreeSet::new(); count as usize];
        ties.iter().for_each(|&[a, b]| _ = above[a as usize].insert(b));
        let mut sparse = Sparse::plan(&above, usize::MAX).unwrap();
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
        check(4, &[[0, 1], [1, 2], [2, 3], [0, 3], [1, 3]]);
        let net: Vec<[u32; 2]> =
            (0..25).flat_map(|at| [[at, at + 1], [at, at + 5]]).filter(|ties| ties[1] < 25).collect();
        check(25, &net);
    }

    #[test]
    fn along_a_rope_nothing_fills_in() {
        let ties: Vec<BTreeSet<u32>> =
            (0..50).map(|at| BTreeSet::from_iter((at < 49).then_some(at + 1))).collect();
        assert_eq!(Sparse::plan(&ties, usize::MAX).unwrap().below.len(), 49);
    }

    #[test]
    fn what_takes_too_much_is_not_planned() {
        let all: Vec<BTreeSet<u32>> = (0..30).map(|at| (at + 1..30).collect()).collect();
        assert!(Sparse::plan(&all, 1000).is_none());
    }
}
