//! Minimum-degree ordering and symbolic factorisation of a sparse symmetric matrix, once per graph.
//!
//! Each step eliminates the row with the fewest remaining neighbours; of equal rows that with the smallest index. Ropes and
//! trees get no fill-in, and their factorisation is linear in their size. The direct solver of islands and the joint solver in
//! three axes use the result.
//!
//! Minimum-degree ordering: W. Tinney and J. Walker, "Direct solutions of sparse network equations by optimally ordered
//! triangular factorization" (1967). Symbolic before numeric factorisation: T. Davis, "Direct Methods for Sparse Linear
//! Systems" (2006).

use std::cmp::Reverse;
use std::collections::BinaryHeap;
use std::ops::Range;

use crate::storage::reusing_clone::reusing_clone;

/// Symbolic factorisation: the order of elimination and the positions of all nonzero entries of the factor. The factor is
/// stored by columns; its rows and columns are numbered by their position in the order of elimination.
#[derive(Debug, Default)]
pub(super) struct SymbolicFactor {
    /// Position of each row of the matrix in the order of elimination, by row index.
    pub(super) positions: Vec<u32>,
    /// Index of the row of the matrix at each position in the order of elimination: the inverse of `positions`.
    pub(super) order: Vec<u32>,
    /// Index into `rows` of the first entry of each column, by position; the last element is the length of `rows`.
    column_starts: Vec<u32>,
    /// Row of each entry of the factor below the diagonal, as a position in the order of elimination. Entries are sorted by
    /// column, then by row.
    pub(super) rows: Vec<u32>,
    /// For each product of two entries of a column, in the order of the elimination: index into `rows` of the entry from which
    /// the product is subtracted.
    pub(super) product_targets: Vec<u32>,
}

reusing_clone! { SymbolicFactor { positions, order, column_starts, rows, product_targets } }

impl SymbolicFactor {
    /// Orders and analyses a symmetric matrix of `count` rows. Returns whether the total cost of its columns is at most
    /// `max_cost`; if not, the analysis is not usable.
    ///
    /// `edges` are the off-diagonal entries of the matrix as pairs of row indices: each pair once, smaller index first, in
    /// ascending order. `cost` returns the cost of a column from its number of entries below the diagonal.
    pub(super) fn analyse(
        &mut self,
        count: usize,
        edges: &[[u32; 2]],
        cost: fn(usize) -> usize,
        max_cost: usize,
    ) -> bool {
        self.order.clear();
        self.positions.clear();
        self.positions.resize(count, u32::MAX);
        let Some(columns) = self.minimum_degree_columns(edges, cost, max_cost) else {
            self.positions.clear();
            return false;
        };
        self.store_structure(&columns);
        true
    }

    /// Minimum-degree elimination. Returns, for each row in the order of elimination, the indices of the remaining rows that
    /// are connected to it: the entries of its column. `None` if the total cost exceeds `max_cost`.
    fn minimum_degree_columns(
        &mut self,
        edges: &[[u32; 2]],
        cost: fn(usize) -> usize,
        max_cost: usize,
    ) -> Option<Vec<Vec<u32>>> {
        let mut partners = vec![Vec::new(); self.positions.len()];
        for &[a, b] in edges {
            partners[a as usize].push(b);
            partners[b as usize].push(a);
        }
        let mut heap: BinaryHeap<_> =
            partners.iter().enumerate().map(|(row, of)| Reverse((of.len(), row))).collect();
        let (mut columns, mut costs, mut merged) = (Vec::with_capacity(partners.len()), 0, Vec::new());
        while let Some(Reverse((degree, row))) = heap.pop() {
            if self.positions[row] != u32::MAX || degree != partners[row].len() {
                continue;
            }
            costs += cost(degree);
            if costs > max_cost {
                return None;
            }
            self.positions[row] = self.order.len() as u32;
            self.order.push(row as u32);
            let column = std::mem::take(&mut partners[row]);
            if self.order.len() + degree == partners.len() {
                // All remaining rows are connected to each other, and follow in ascending order.
                for &last in &column {
                    self.positions[last as usize] = self.order.len() as u32;
                    self.order.push(last);
                }
                costs += (0..degree).map(cost).sum::<usize>();
                columns.extend((0..=degree).map(|after| column[after..].to_vec()));
                break;
            }
            for &partner in &column {
                let of_partner = &mut partners[partner as usize];
                merge_sorted(of_partner, &column, [row as u32, partner], &mut merged);
                std::mem::swap(of_partner, &mut merged);
                heap.push(Reverse((of_partner.len(), partner as usize)));
            }
            columns.push(column);
        }
        (costs <= max_cost).then_some(columns)
    }

    /// Stores the entries of all columns in `column_starts` and `rows`, as sorted positions, and the targets of all products.
    /// `columns` is the result of the elimination.
    fn store_structure(&mut self, columns: &[Vec<u32>]) {
        self.column_starts.clear();
        self.rows.clear();
        self.column_starts.push(0);
        for column in columns {
            let start = self.rows.len();
            self.rows.extend(column.iter().map(|&row| self.positions[row as usize]));
            self.rows[start..].sort_unstable();
            self.column_starts.push(self.rows.len() as u32);
        }
        self.product_targets.clear();
        for place in 0..columns.len() {
            self.find_product_targets(self.column(place));
        }
    }

    /// Finds the target of each product of two entries of a column, and appends its index to `product_targets`. The target is
    /// the entry in the column of the first entry, at the row of the second.
    ///
    /// By the fill-in rule the target's column contains the rows of all later entries of this column, so one pass down the
    /// target's column finds them in order.
    fn find_product_targets(&mut self, column: Range<usize>) {
        let first = self.product_targets.len();
        let SymbolicFactor { column_starts: starts, rows, product_targets: targets, .. } = self;
        let of_column = &rows[column];
        targets.resize(first + of_column.len() * of_column.len().saturating_sub(1) / 2, 0);
        for (above, &place) in of_column.iter().enumerate() {
            let mut entry = starts[place as usize];
            for (at, &row) in of_column.iter().enumerate().skip(above + 1) {
                while rows[entry as usize] != row {
                    entry += 1;
                }
                targets[first + at * (at - 1) / 2 + above] = entry;
            }
        }
    }

    /// Returns the greatest number of entries that a column has below the diagonal.
    pub(super) fn max_column_length(&self) -> usize {
        (0..self.order.len()).map(|place| self.column(place).len()).max().unwrap_or(0)
    }

    /// Returns the range in `rows` of the entries of the column at position `place` of the order of elimination.
    #[inline(always)]
    pub(super) fn column(&self, place: usize) -> Range<usize> {
        self.column_starts[place] as usize..self.column_starts[place + 1] as usize
    }

    /// Returns the index into `rows` of the entry of `column` at `row`, which must exist. Both are positions in the order of
    /// elimination.
    fn find_entry(&self, column: u32, row: u32) -> u32 {
        let range = self.column(column as usize);
        (range.start + self.rows[range].partition_point(|&other| other < row)) as u32
    }

    /// Returns the index into `rows` of the entry that connects rows `a` and `b` of the matrix and must exist; and whether `a`
    /// is eliminated after `b`.
    pub(super) fn entry_of(&self, a: u32, b: u32) -> (u32, bool) {
        let (a, b) = (self.positions[a as usize], self.positions[b as usize]);
        (self.find_entry(a.min(b), a.max(b)), b < a)
    }
}

/// Merges two sorted lists of rows into `merged`, each row once, and leaves out the two rows in `without`.
fn merge_sorted(one: &[u32], other: &[u32], without: [u32; 2], merged: &mut Vec<u32>) {
    merged.clear();
    merged.reserve(one.len() + other.len());
    let (mut at_one, mut at_other) = (0, 0);
    while let (Some(&a), Some(&b)) = (one.get(at_one), other.get(at_other)) {
        let least = a.min(b);
        at_one += usize::from(a == least);
        at_other += usize::from(b == least);
        if !without.contains(&least) {
            merged.push(least);
        }
    }
    let rest = one[at_one..].iter().chain(&other[at_other..]);
    merged.extend(rest.copied().filter(|last| !without.contains(last)));
}
