//! Symbolic factorisation of a sparse symmetric matrix, once per graph: the order of elimination and the positions of all
//! nonzero entries of its factor L.
//!
//! The order is one of [approximate minimum degree](super::minimum_degree). Ropes and trees get no fill-in, and their
//! factorisation is linear in their size. The rows of L are paths of the elimination tree, so that their search is linear in
//! the number of entries. The direct solver of islands and the joint solver in three axes use the result.
//!
//! J. Liu, "The role of elimination trees in sparse factorization" (1990). Symbolic before numeric factorisation: T. Davis,
//! "Direct Methods for Sparse Linear Systems" (2006).

use std::ops::Range;

use super::minimum_degree::order_by_minimum_degree;
use crate::reusing_clone;

/// Index instead of a column where there is none.
const NONE: u32 = u32::MAX;

/// Entry of the factor below the diagonal, in the list of its row.
#[derive(Debug, Clone, Copy, Default)]
pub(crate) struct RowEntry {
    /// Column of the entry, as a position in the order of elimination.
    pub(crate) column: u32,
    /// Index of the entry into [`SymbolicFactor::rows`].
    pub(crate) index: u32,
}

/// Symbolic factorisation: the order of elimination and the positions of all nonzero entries of the factor. The factor is
/// stored by columns; its rows and columns are numbered by their position in the order of elimination.
#[derive(Debug, Default)]
pub(crate) struct SymbolicFactor {
    /// Position of each row of the matrix in the order of elimination, by row index.
    pub(crate) positions: Vec<u32>,
    /// Index of the row of the matrix at each position in the order of elimination: the inverse of `positions`.
    pub(crate) order: Vec<u32>,
    /// Index into `rows` of the first entry of each column, by position; the last element is the length of `rows`.
    column_starts: Vec<u32>,
    /// Row of each entry of the factor below the diagonal, as a position in the order of elimination. Entries are sorted by
    /// column, then by row.
    pub(crate) rows: Vec<u32>,
    /// Index into `row_entries` of the first entry of each row, by position; the last element is the length of `row_entries`.
    row_starts: Vec<u32>,
    /// Entries of the factor below the diagonal, sorted by row, then by column.
    row_entries: Vec<RowEntry>,
    /// Index into `matrix_entries` of the first entry of each column, by position; the last element is the length of
    /// `matrix_entries`.
    matrix_starts: Vec<u32>,
    /// Entries of the matrix below the diagonal, as indices into `rows` in ascending order. All other entries of the factor are
    /// fill-in.
    pub(crate) matrix_entries: Vec<u32>,
    /// Number of products of two different entries of a column below the diagonal, over all columns.
    pub(crate) product_count: usize,
}

reusing_clone! {
    SymbolicFactor { positions, order, column_starts, rows, row_starts, row_entries, matrix_starts, matrix_entries, product_count }
}

/// The matrix above the diagonal in the order of elimination: for each row of the factor the columns of its matrix entries.
struct MatrixRows {
    /// Index into `columns` of the first entry of each row; the last element is the length of `columns`.
    starts: Vec<u32>,
    /// Column of each entry below the diagonal, sorted by row.
    columns: Vec<u32>,
}

impl MatrixRows {
    /// Returns the rows of the matrix with the off-diagonal entries `edges`. `positions` are those of the rows in the order of
    /// elimination.
    fn new(edges: &[[u32; 2]], positions: &[u32]) -> Self {
        let place = |&[a, b]: &[u32; 2]| {
            let (a, b) = (positions[a as usize], positions[b as usize]);
            (a.max(b) as usize, a.min(b))
        };
        let mut starts = vec![0; positions.len() + 1];
        edges.iter().for_each(|edge| starts[place(edge).0] += 1);
        let mut columns = vec![0; edges.len()];
        // The entry of a row is the end of its list, and moves down to the start.
        add_up(&mut starts);
        for (row, column) in edges.iter().map(place) {
            starts[row] -= 1;
            columns[starts[row] as usize] = column;
        }
        MatrixRows { starts, columns }
    }

    /// Returns the columns of the matrix entries in a row, below the diagonal.
    fn columns_of(&self, row: usize) -> &[u32] {
        &self.columns[self.starts[row] as usize..self.starts[row + 1] as usize]
    }

    /// Calls `visit` with row and column of each entry of the factor below the diagonal, sorted by row. The columns of a row
    /// are in no order.
    ///
    /// The columns of row i are those on the paths in the elimination tree from the matrix entries of row i to i. The parent of a
    /// column is the first row of the factor below its diagonal, so the tree grows with the rows.
    fn for_each_entry(&self, mut visit: impl FnMut(u32, u32)) {
        let count = self.starts.len() - 1;
        // For each column its parent, and the last row with an entry in the column.
        let mut tree = vec![[NONE; 2]; count];
        for row in 0..count as u32 {
            tree[row as usize][1] = row;
            for &column in self.columns_of(row as usize) {
                let mut column = column;
                while let [parent, last_row] = &mut tree[column as usize]
                    && *last_row != row
                {
                    *last_row = row;
                    visit(row, column);
                    if *parent == NONE {
                        *parent = row;
                    }
                    column = *parent;
                }
            }
        }
    }
}

impl SymbolicFactor {
    /// Orders and analyses a symmetric matrix of `count` rows. Returns whether the total cost of its columns is at most
    /// `max_cost`; if not, the analysis is not usable.
    ///
    /// `edges` are the off-diagonal entries of the matrix as pairs of row indices: each pair once, smaller index first, in
    /// ascending order. `cost` returns the cost of a column from its number of entries below the diagonal.
    pub(crate) fn analyse(
        &mut self,
        count: usize,
        edges: &[[u32; 2]],
        cost: fn(usize) -> usize,
        max_cost: usize,
    ) -> bool {
        self.order.clear();
        self.positions.clear();
        if !order_by_minimum_degree(count, edges, (cost, max_cost), &mut self.order) {
            return false;
        }
        self.positions.resize(count, 0);
        for (place, &row) in self.order.iter().enumerate() {
            self.positions[row as usize] = place as u32;
        }
        let matrix = MatrixRows::new(edges, &self.positions);
        self.store_structure(&matrix);
        self.store_matrix_entries(&matrix);
        let costs = (0..count).map(|place| cost(self.column(place).len())).sum::<usize>();
        if costs > max_cost {
            self.positions.clear();
        }
        costs <= max_cost
    }

    /// Stores the entries of all columns in `column_starts` and `rows`, and those of all rows in `row_starts` and
    /// `row_entries`.
    fn store_structure(&mut self, matrix: &MatrixRows) {
        let count = self.order.len();
        let SymbolicFactor { column_starts, rows, row_starts, row_entries, .. } = self;
        for starts in [&mut *column_starts, &mut *row_starts] {
            starts.clear();
            starts.resize(count + 1, 0);
        }
        matrix.for_each_entry(|row, column| {
            column_starts[column as usize + 1] += 1;
            row_starts[row as usize + 1] += 1;
        });
        self.product_count = column_starts
            .iter()
            .map(|&length| length as usize * (length as usize).saturating_sub(1) / 2)
            .sum();
        add_up(column_starts);
        add_up(row_starts);
        let entries = column_starts[count] as usize;
        rows.clear();
        rows.resize(entries, 0);
        // The rows of a column come in ascending order.
        let mut ends = column_starts.clone();
        matrix.for_each_entry(|row, column| {
            rows[ends[column as usize] as usize] = row;
            ends[column as usize] += 1;
        });
        row_entries.clear();
        row_entries.resize(entries, RowEntry::default());
        ends.copy_from_slice(row_starts);
        for column in 0..count {
            for index in column_starts[column]..column_starts[column + 1] {
                let end = &mut ends[rows[index as usize] as usize];
                row_entries[*end as usize] = RowEntry { column: column as u32, index };
                *end += 1;
            }
        }
    }

    /// Stores the positions of the entries of the matrix in `matrix_starts` and `matrix_entries`.
    fn store_matrix_entries(&mut self, matrix: &MatrixRows) {
        let count = self.order.len();
        let SymbolicFactor { matrix_starts: starts, matrix_entries, .. } = self;
        starts.clear();
        starts.resize(count + 1, 0);
        matrix.columns.iter().for_each(|&column| starts[column as usize + 1] += 1);
        add_up(starts);
        matrix_entries.clear();
        matrix_entries.resize(matrix.columns.len(), 0);
        let mut ends = self.matrix_starts.clone();
        for row in 0..count {
            for &column in matrix.columns_of(row) {
                let end = &mut ends[column as usize];
                self.matrix_entries[*end as usize] = row as u32;
                *end += 1;
            }
        }
        // The rows of a column are in ascending order here and in `rows`.
        for column in 0..count {
            let mut entry = self.column_starts[column];
            for at in self.matrix_column(column) {
                while self.rows[entry as usize] != self.matrix_entries[at] {
                    entry += 1;
                }
                self.matrix_entries[at] = entry;
            }
        }
    }

    /// Returns the greatest number of entries that a column has below the diagonal.
    pub(crate) fn max_column_length(&self) -> usize {
        (0..self.order.len()).map(|place| self.column(place).len()).max().unwrap_or(0)
    }

    /// Returns the range in `rows` of the entries of the column at position `place` of the order of elimination.
    #[inline(always)]
    pub(crate) fn column(&self, place: usize) -> Range<usize> {
        self.column_starts[place] as usize..self.column_starts[place + 1] as usize
    }

    /// Returns the entries below the diagonal in the row at position `place` of the order of elimination, by ascending column.
    #[inline(always)]
    pub(crate) fn row(&self, place: usize) -> &[RowEntry] {
        &self.row_entries[self.row_starts[place] as usize..self.row_starts[place + 1] as usize]
    }

    /// Returns the range in `matrix_entries` of the entries of the column at position `place` of the order of elimination.
    #[inline(always)]
    pub(crate) fn matrix_column(&self, place: usize) -> Range<usize> {
        self.matrix_starts[place] as usize..self.matrix_starts[place + 1] as usize
    }

    /// Returns the index into `matrix_entries` of the entry that connects rows `a` and `b` of the matrix and must exist; and
    /// whether `a` is eliminated after `b`.
    pub(crate) fn matrix_entry_of(&self, a: u32, b: u32) -> (u32, bool) {
        let (a, b) = (self.positions[a as usize], self.positions[b as usize]);
        let range = self.matrix_column(a.min(b) as usize);
        let is_before = |&entry: &u32| self.rows[entry as usize] < a.max(b);
        ((range.start + self.matrix_entries[range].partition_point(is_before)) as u32, b < a)
    }
}

/// Replaces each number by the sum of all numbers up to it.
fn add_up(numbers: &mut [u32]) {
    let mut sum = 0;
    for number in numbers {
        sum += *number;
        *number = sum;
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn products(entries: usize) -> usize {
        entries * entries.saturating_sub(1) / 2
    }

    fn analysed(count: usize, edges: &[[u32; 2]]) -> SymbolicFactor {
        let mut factor = SymbolicFactor::default();
        assert!(factor.analyse(count, edges, products, usize::MAX));
        factor
    }

    /// Returns `edges` without repetition, smaller index first, in ascending order.
    fn sorted(edges: impl Iterator<Item = [u32; 2]>) -> Vec<[u32; 2]> {
        let mut edges: Vec<_> = edges.map(|[a, b]| [a.min(b), a.max(b)]).filter(|[a, b]| a < b).collect();
        edges.sort_unstable();
        edges.dedup();
        edges
    }

    fn grid(side: u32) -> Vec<[u32; 2]> {
        let right = (0..side * side).filter(|at| at % side + 1 < side).map(|at| [at, at + 1]);
        let down = (0..side * (side - 1)).map(|at| [at, at + side]);
        sorted(right.chain(down))
    }

    /// Returns a graph of `count` rows with about `count` times `half_degree` pseudorandom edges.
    fn scattered(count: u32, half_degree: u32) -> Vec<[u32; 2]> {
        let mut state = 12345_u32;
        let mut next = || {
            state = state.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
            (state >> 8) % count
        };
        sorted((0..count * half_degree).map(|_| [next(), next()]))
    }

    /// Returns the rows of each column of the factor by elimination of one row after the other in a dense matrix.
    fn eliminated(factor: &SymbolicFactor, edges: &[[u32; 2]]) -> Vec<Vec<u32>> {
        let count = factor.order.len();
        let mut is_entry = vec![vec![false; count]; count];
        for edge in edges {
            let [a, b] = edge.map(|row| factor.positions[row as usize] as usize);
            (is_entry[a][b], is_entry[b][a]) = (true, true);
        }
        (0..count)
            .map(|column| {
                let below: Vec<usize> = (column + 1..count).filter(|&row| is_entry[row][column]).collect();
                for &a in &below {
                    below.iter().for_each(|&b| is_entry[a][b] = true);
                }
                below.into_iter().map(|row| row as u32).collect()
            })
            .collect()
    }

    #[test]
    fn the_structure_is_that_of_an_elimination_in_this_order() {
        let graphs = [
            (1, vec![]),
            (7, vec![]),
            (9, sorted([[0, 8], [8, 3], [3, 1], [5, 6]].into_iter())),
            (64, grid(8)),
            (60, scattered(60, 1)),
            (60, scattered(60, 2)),
            (60, scattered(60, 6)),
            (30, sorted((0..30).flat_map(|a| (0..30).map(move |b| [a, b])))),
            // A wheel with two hubs, which are dense rows.
            (150, sorted((2..150).flat_map(|at| [[0, at], [1, at], [at, at % 149 + 1]]))),
        ];
        for (count, edges) in graphs {
            let factor = analysed(count, &edges);
            let mut rows = factor.order.clone();
            rows.sort_unstable();
            assert!(rows.into_iter().eq(0..count as u32), "the order has each row once");
            let columns = eliminated(&factor, &edges);
            let found: Vec<Vec<u32>> =
                (0..count).map(|place| factor.rows[factor.column(place)].to_vec()).collect();
            assert_eq!(found, columns, "{edges:?}");
            assert_eq!(factor.product_count, columns.iter().map(|column| products(column.len())).sum());
            let of_rows =
                (0..count).flat_map(|place| factor.row(place).iter().map(move |entry| (place, entry)));
            let by_row: Vec<(u32, u32)> = of_rows
                .inspect(|(place, entry)| assert_eq!(factor.rows[entry.index as usize] as usize, *place))
                .map(|(place, entry)| (place as u32, entry.column))
                .collect();
            let mut expected: Vec<(u32, u32)> =
                (0..).zip(&columns).flat_map(|(at, rows)| rows.iter().map(move |&row| (row, at))).collect();
            expected.sort_unstable();
            assert_eq!(by_row, expected);
            for &[a, b] in &edges {
                let (entry, is_turned) = factor.matrix_entry_of(a, b);
                let [one, other] = [a, b].map(|row| factor.positions[row as usize]);
                let at = factor.matrix_entries[entry as usize] as usize;
                assert_eq!((factor.rows[at], is_turned), (one.max(other), other < one));
                assert!(factor.column(one.min(other) as usize).contains(&at));
            }
        }
    }

    #[test]
    fn trees_of_any_shape_have_no_fill_in() {
        let parents: [fn(u32) -> u32; 4] = [|at| at - 1, |_| 0, |at| at / 2, |at| at * 7919 % 1009 % at];
        for parent in parents {
            let edges = sorted((1..1000).map(|at| [parent(at), at]));
            assert_eq!(analysed(1000, &edges).rows.len(), edges.len());
        }
    }

    #[test]
    fn a_matrix_whose_dense_rows_cost_too_much_is_refused() {
        // Two hubs with 200 spokes each: a spoke's column has two entries and one product.
        let edges = sorted((2..202).flat_map(|at| [[0, at], [1, at]]));
        assert_eq!(analysed(202, &edges).product_count, 200);
        let mut factor = SymbolicFactor::default();
        assert!(factor.analyse(202, &edges, products, 200));
        assert!(!factor.analyse(202, &edges, products, 199));
    }

    #[test]
    fn the_fill_in_of_grids_is_within_that_of_nested_dissection() {
        // Nested dissection gives about 31/4 n^2 log2 n entries and 829/84 n^3 multiplications, for n x n rows of which each is
        // connected with its eight neighbours. A. George and J. Liu, "Computer Solution of Large Sparse Positive Definite
        // Systems" (1981), chapter 8.
        for side in [10_u32, 30, 100] {
            let factor = analysed((side * side) as usize, &grid(side));
            let n = f64::from(side);
            assert!(factor.rows.len() as f64 <= 7.75 * n * n * n.log2());
            assert!(factor.product_count as f64 <= 829.0 / 84.0 * n * n * n);
        }
    }
}
