//! Sparse symmetric matrix of scalars, and its factorisation L D L^T.
//!
//! `SparseLdlt::plan` chooses a minimum-degree ordering and allocates the fill-in. Later factorisations of the same pattern
//! reuse both.

use crate::index::{DenseIndex, IndexedVec};
use crate::minimum_degree::RowIndex;
use crate::reusing_clone;
use crate::sparse_ordering::{EntryIndex, PlaceIndex, SymbolicFactor};

/// A sparse symmetric matrix of scalars. [`factorise`](Self::factorise) replaces it by its factors L D L^T. Rows and columns
/// are in the order of elimination.
#[derive(Debug, Default)]
pub(super) struct SparseLdlt {
    /// Order of elimination, and positions of the elements below the diagonal.
    symbolic: SymbolicFactor,
    /// For each product of two elements of a column, in the order of the elimination: index into `lower` of the element from
    /// which the product is subtracted.
    product_targets: Vec<EntryIndex>,
    /// Column of each element of `lower`, in the order of elimination.
    columns: Vec<PlaceIndex>,
    /// Diagonal of the matrix; after the factorisation, diagonal of D^-1.
    diagonal: IndexedVec<PlaceIndex, f64>,
    /// Elements below the diagonal column by column: of the matrix; after the factorisation, of L.
    lower: IndexedVec<EntryIndex, f64>,
    /// Workspace of the factorisation: the column that is being eliminated.
    column: Vec<f64>,
    /// Workspace of the triangular solves: the vector in the order of elimination.
    solution: IndexedVec<PlaceIndex, f64>,
}

reusing_clone! { SparseLdlt { symbolic, product_targets, columns, diagonal, lower, column, solution } }

impl SparseLdlt {
    /// Returns a matrix of `count` rows whose off-diagonal elements at `edges` may be nonzero. Returns `None` if its
    /// factorisation needs more than `max_products` products.
    ///
    /// Each edge is a pair of row indices and occurs once, with the smaller index first; edges are sorted.
    pub(super) fn plan(count: usize, edges: &[[RowIndex; 2]], max_products: usize) -> Option<Self> {
        let mut elimination = SymbolicFactor::default();
        // The products that update the diagonal count too.
        let products = |degree: usize| degree * (degree + 1) / 2;
        elimination.analyse(count, edges, products, max_products).then(|| SparseLdlt {
            diagonal: IndexedVec::of_copies(0.0, count),
            solution: IndexedVec::of_copies(0.0, count),
            lower: IndexedVec::of_copies(0.0, elimination.rows.len()),
            column: vec![0.0; elimination.max_column_length()],
            product_targets: product_targets(&elimination),
            columns: columns_of_elements(&elimination),
            symbolic: elimination,
        })
    }

    /// Returns the number of products that one factorisation computes below the diagonal.
    pub(super) fn product_count(&self) -> usize {
        self.product_targets.len()
    }

    /// Returns the index of the off-diagonal element of the rows `a` and `b`, for [`add_lower`](Self::add_lower).
    pub(super) fn entry_index(&self, a: RowIndex, b: RowIndex) -> EntryIndex {
        self.symbolic.matrix_entries[self.symbolic.matrix_entry_of(a, b).0]
    }

    /// Sets the diagonal to `diagonal`, which has a number for each row, and all other elements to 0.
    pub(super) fn reset(&mut self, diagonal: impl Iterator<Item = f64>) {
        for (&place, value) in self.symbolic.positions.iter().zip(diagonal) {
            self.diagonal[place] = value;
        }
        self.lower.fill(0.0);
    }

    /// Adds `value` to the off-diagonal element with the index `entry`.
    pub(super) fn add_lower(&mut self, entry: EntryIndex, value: f64) {
        self.lower[entry] += value;
    }

    /// Replaces the matrix by its factors L D L^T. The diagonal then holds D^-1.
    ///
    /// Not inlined, as the solution: both loops need all registers.
    #[inline(never)]
    pub(super) fn factorise(&mut self) {
        let SparseLdlt { symbolic, diagonal, lower, column: kept, product_targets, .. } = self;
        let mut targets = product_targets.iter();
        for place in diagonal.indices() {
            let range = symbolic.column(place);
            let inverse = 1.0 / diagonal[place];
            diagonal[place] = inverse;
            // A tree has one element in nearly all columns.
            if range.len() == 1 {
                let only = EntryIndex::new(range.start);
                let below = &mut lower[only];
                let element = std::mem::replace(below, *below * inverse);
                diagonal[symbolic.rows[only]] -= *below * element;
                continue;
            }
            let rows = symbolic.rows.slice(range.clone());
            for (kept, below) in kept.iter_mut().zip(lower.slice_mut(range.clone())) {
                *kept = *below;
                *below *= inverse;
            }
            for (at, &row) in rows.iter().enumerate() {
                let factor = lower.slice(range.clone())[at];
                diagonal[row] -= factor * kept[at];
                for (above, &target) in kept[..at].iter().zip(targets.by_ref()) {
                    lower[target] -= factor * above;
                }
            }
        }
    }

    /// Solves the linear system with the right-hand side `values`, and writes the solution to `values`. Needs the factors.
    #[inline(never)]
    pub(super) fn solve(&mut self, values: &mut [f64]) {
        let SparseLdlt { symbolic, columns, diagonal, lower, solution, .. } = self;
        let SymbolicFactor { positions: places, rows, .. } = &*symbolic;
        values.iter().zip(places.iter()).for_each(|(&value, &place)| solution[place] = value);
        for ((&row, &column), below) in rows.iter().zip(columns.iter()).zip(lower.iter()) {
            solution[row] -= below * solution[column];
        }
        for (place, inverse) in diagonal.enumerated().rev() {
            let column = symbolic.column(place);
            // The sum of one element, as nearly all columns of a tree have it, is the element.
            let rest = if column.len() == 1 {
                let only = EntryIndex::new(column.start);
                lower[only] * solution[rows[only]]
            } else {
                rows.slice(column.clone())
                    .iter()
                    .zip(lower.slice(column))
                    .map(|(&row, below)| below * solution[row])
                    .sum()
            };
            solution[place] = solution[place] * inverse - rest;
        }
        values.iter_mut().zip(places.iter()).for_each(|(value, &place)| *value = solution[place]);
    }
}

/// Returns the column of each element below the diagonal, in the order of the elements.
fn columns_of_elements(elimination: &SymbolicFactor) -> Vec<PlaceIndex> {
    let columns = elimination.order.indices();
    columns.flat_map(|place| elimination.column(place).map(move |_| place)).collect()
}

/// Returns the target of each product of two elements of a column, in the order of the elimination, as an index into the list of
/// entries. The target is the entry in the column of the first element, at the row of the second.
///
/// By the fill-in rule the target's column contains the rows of all later entries of the column, so one pass down the target's
/// column finds them in order.
fn product_targets(elimination: &SymbolicFactor) -> Vec<EntryIndex> {
    let mut targets = vec![EntryIndex(0); elimination.product_count];
    let mut first = 0;
    for place in elimination.order.indices() {
        let of_column = elimination.rows.slice(elimination.column(place));
        for (above, &place) in of_column.iter().enumerate() {
            let mut entry = elimination.column(place).start;
            for (at, &row) in of_column.iter().enumerate().skip(above + 1) {
                while elimination.rows[EntryIndex::new(entry)] != row {
                    entry += 1;
                }
                targets[first + at * (at - 1) / 2 + above] = EntryIndex::new(entry);
            }
        }
        first += of_column.len() * of_column.len().saturating_sub(1) / 2;
    }
    targets
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Solves a diagonally dominant matrix with these off-diagonal elements and checks the residual.
    fn check(count: usize, ties: &[[u32; 2]]) {
        let ties: Vec<_> = ties.iter().map(|ends| ends.map(RowIndex)).collect();
        let mut sparse = SparseLdlt::plan(count, &ties, usize::MAX).unwrap();
        let value = |at: usize| 1.0 + 0.3 * at as f64;
        let mut dense = vec![vec![0.0; count]; count];
        for (at, row) in dense.iter_mut().enumerate() {
            row[at] = 40.0 + at as f64;
        }
        sparse.reset(dense.iter().enumerate().map(|(at, row)| row[at]));
        for (at, &[a, b]) in ties.iter().enumerate() {
            sparse.add_lower(sparse.entry_index(a, b), value(at));
            let [a, b] = [a, b].map(RowIndex::position);
            (dense[a][b], dense[b][a]) = (value(at), value(at));
        }
        sparse.factorise();
        let right: Vec<f64> = (0..count).map(|at| (at % 5) as f64 - 2.0).collect();
        let mut solution = right.clone();
        sparse.solve(&mut solution);
        for (row, right) in dense.iter().zip(right) {
            let left: f64 = row.iter().zip(&solution).map(|(a, b)| a * b).sum();
            assert!((left - right).abs() < 1e-12, "{left} is not {right}");
        }
    }

    #[test]
    fn the_solution_satisfies_the_linear_system() {
        check(4, &[[0, 1], [1, 2], [2, 3]]);
        check(4, &[[0, 1], [0, 3], [1, 2], [1, 3], [2, 3]]);
        let net: Vec<[u32; 2]> =
            (0..25).flat_map(|at| [[at, at + 1], [at, at + 5]]).filter(|ties| ties[1] < 25).collect();
        check(25, &net);
    }

    #[test]
    fn a_chain_has_no_fill_in() {
        let ties: Vec<_> = (0..49).map(|at| [at, at + 1].map(RowIndex)).collect();
        assert_eq!(SparseLdlt::plan(50, &ties, usize::MAX).unwrap().lower.len(), 49);
    }

    #[test]
    fn plan_refuses_more_products_than_allowed() {
        let all: Vec<_> = (0..30).flat_map(|a| (a + 1..30).map(move |b| [a, b].map(RowIndex))).collect();
        assert!(SparseLdlt::plan(30, &all, 1000).is_none());
    }
}
