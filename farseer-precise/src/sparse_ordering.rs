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

use super::minimum_degree::{RowIndex, order_by_minimum_degree};
use crate::index::{DenseIndex, IndexedVec, ListRanges, index_type};
use crate::reusing_clone;

index_type! {
    /// Position of a row and column of the factor: in the order of elimination.
    pub(crate) struct PlaceIndex;
}
index_type! {
    /// Index of an entry of the factor below the diagonal. Entries are sorted by column, then by row.
    pub(crate) struct EntryIndex;
}
index_type! {
    /// Index of an entry of the matrix below the diagonal, in the order of the entries of the factor.
    pub(crate) struct MatrixEntryIndex;
}

/// Index instead of a column where there is none.
const NONE: PlaceIndex = PlaceIndex(u32::MAX);

/// Entry of the factor below the diagonal, in the list of its row.
#[derive(Debug, Clone, Copy, Default)]
pub(crate) struct RowEntry {
    /// Column of the entry.
    pub(crate) column: PlaceIndex,
    /// Index of the entry into [`SymbolicFactor::rows`].
    pub(crate) index: EntryIndex,
}

/// Symbolic factorisation: the order of elimination and the positions of all nonzero entries of the factor. The factor is
/// stored by columns; its rows and columns are numbered by their position in the order of elimination.
#[derive(Debug, Default)]
pub(crate) struct SymbolicFactor {
    /// Position of each row of the matrix in the order of elimination.
    pub(crate) positions: IndexedVec<RowIndex, PlaceIndex>,
    /// Row of the matrix at each position in the order of elimination: the inverse of `positions`.
    pub(crate) order: IndexedVec<PlaceIndex, RowIndex>,
    /// Ranges of the columns in `rows`.
    columns: ListRanges<PlaceIndex>,
    /// Row of each entry of the factor below the diagonal.
    pub(crate) rows: IndexedVec<EntryIndex, PlaceIndex>,
    /// Ranges of the rows in `row_entries`.
    row_ranges: ListRanges<PlaceIndex>,
    /// Entries of the factor below the diagonal, sorted by row, then by column.
    row_entries: Vec<RowEntry>,
    /// Ranges of the columns in `matrix_entries`.
    matrix_columns: ListRanges<PlaceIndex>,
    /// Entries of the matrix below the diagonal, as indices into `rows` in ascending order. All other entries of the factor are
    /// fill-in.
    pub(crate) matrix_entries: IndexedVec<MatrixEntryIndex, EntryIndex>,
    /// Number of products of two different entries of a column below the diagonal, over all columns.
    pub(crate) product_count: usize,
}

reusing_clone! {
    SymbolicFactor { positions, order, columns, rows, row_ranges, row_entries, matrix_columns, matrix_entries, product_count }
}

/// The matrix above the diagonal in the order of elimination: for each row of the factor the columns of its matrix entries.
struct MatrixRows {
    /// Ranges of the rows in `columns`.
    rows: ListRanges<PlaceIndex>,
    /// Column of each entry below the diagonal, sorted by row.
    columns: Vec<PlaceIndex>,
}

impl MatrixRows {
    /// Returns the rows of the matrix with the off-diagonal entries `edges`. `positions` are those of the rows in the order of
    /// elimination.
    fn new(edges: &[[RowIndex; 2]], positions: &IndexedVec<RowIndex, PlaceIndex>) -> Self {
        let place = |edge: &[RowIndex; 2]| {
            let [a, b] = edge.map(|row| positions[row]);
            (a.max(b), a.min(b))
        };
        let mut rows = ListRanges::default();
        rows.reset(positions.len());
        edges.iter().for_each(|edge| rows.count(place(edge).0));
        rows.begin_lists();
        let mut columns = vec![NONE; edges.len()];
        let mut ends = rows.clone();
        for (row, column) in edges.iter().map(place) {
            columns[ends.next_position(row)] = column;
        }
        MatrixRows { rows, columns }
    }

    /// Returns the columns of the matrix entries in a row, below the diagonal.
    fn columns_of(&self, row: PlaceIndex) -> &[PlaceIndex] {
        &self.columns[self.rows.range(row)]
    }

    /// Calls `visit` with row and column of each entry of the factor below the diagonal, sorted by row. The columns of a row
    /// are in no order.
    ///
    /// The columns of row i are those on the paths in the elimination tree from the matrix entries of row i to i. The parent of a
    /// column is the first row of the factor below its diagonal, so the tree grows with the rows.
    fn for_each_entry(&self, mut visit: impl FnMut(PlaceIndex, PlaceIndex)) {
        // For each column its parent, and the last row with an entry in the column.
        let mut tree = IndexedVec::of_copies([NONE; 2], self.rows.list_count());
        for row in tree.indices() {
            tree[row][1] = row;
            for &column in self.columns_of(row) {
                let mut column = column;
                while let [parent, last_row] = &mut tree[column]
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
        edges: &[[RowIndex; 2]],
        cost: fn(usize) -> usize,
        max_cost: usize,
    ) -> bool {
        self.order.clear();
        self.positions.clear();
        if !order_by_minimum_degree(count, edges, (cost, max_cost), self.order.as_vec_mut()) {
            return false;
        }
        self.positions.resize(count, NONE);
        for (place, &row) in self.order.enumerated() {
            self.positions[row] = place;
        }
        let matrix = MatrixRows::new(edges, &self.positions);
        self.store_structure(&matrix);
        self.store_matrix_entries(&matrix);
        let costs = self.order.indices().map(|place| cost(self.column(place).len())).sum::<usize>();
        if costs > max_cost {
            self.positions.clear();
        }
        costs <= max_cost
    }

    /// Stores the entries of all columns in `columns` and `rows`, and those of all rows in `row_ranges` and `row_entries`.
    fn store_structure(&mut self, matrix: &MatrixRows) {
        let SymbolicFactor { order, columns, rows, row_ranges, row_entries, .. } = self;
        columns.reset(order.len());
        row_ranges.reset(order.len());
        matrix.for_each_entry(|row, column| {
            columns.count(column);
            row_ranges.count(row);
        });
        columns.begin_lists();
        row_ranges.begin_lists();
        self.product_count = order
            .indices()
            .map(|place| columns.range(place).len())
            .map(|length| length * length.saturating_sub(1) / 2)
            .sum();
        rows.clear();
        rows.resize(columns.total(), NONE);
        // The rows of a column come in ascending order.
        let mut ends = columns.clone();
        matrix.for_each_entry(|row, column| rows.as_vec_mut()[ends.next_position(column)] = row);
        row_entries.clear();
        row_entries.resize(columns.total(), RowEntry::default());
        ends.clone_from(row_ranges);
        for column in order.indices() {
            for index in columns.range(column).map(EntryIndex::new) {
                row_entries[ends.next_position(rows[index])] = RowEntry { column, index };
            }
        }
    }

    /// Stores the positions of the entries of the matrix in `matrix_columns` and `matrix_entries`.
    fn store_matrix_entries(&mut self, matrix: &MatrixRows) {
        let SymbolicFactor { order, columns, rows, matrix_columns, matrix_entries, .. } = self;
        matrix_columns.reset(order.len());
        matrix.columns.iter().for_each(|&column| matrix_columns.count(column));
        matrix_columns.begin_lists();
        matrix_entries.clear();
        matrix_entries.resize(matrix.columns.len(), EntryIndex::default());
        // The rows of a column are in ascending order here and in `rows`: each search goes on behind the last found entry.
        let (mut ends, mut found) = (matrix_columns.clone(), columns.clone());
        for row in order.indices() {
            for &column in matrix.columns_of(row) {
                let entry = loop {
                    let entry = EntryIndex::new(found.next_position(column));
                    if rows[entry] == row {
                        break entry;
                    }
                };
                matrix_entries.as_vec_mut()[ends.next_position(column)] = entry;
            }
        }
    }

    /// Returns the greatest number of entries that a column has below the diagonal.
    pub(crate) fn max_column_length(&self) -> usize {
        self.order.indices().map(|place| self.column(place).len()).max().unwrap_or(0)
    }

    /// Returns the range in `rows` of the entries of a column.
    #[inline(always)]
    pub(crate) fn column(&self, place: PlaceIndex) -> Range<usize> {
        self.columns.range(place)
    }

    /// Returns the entries below the diagonal in a row, by ascending column.
    #[inline(always)]
    pub(crate) fn row(&self, place: PlaceIndex) -> &[RowEntry] {
        &self.row_entries[self.row_ranges.range(place)]
    }

    /// Returns the range in `matrix_entries` of the entries of a column.
    #[inline(always)]
    pub(crate) fn matrix_column(&self, place: PlaceIndex) -> Range<usize> {
        self.matrix_columns.range(place)
    }

    /// Returns the entry that connects rows `a` and `b` of the matrix and must exist, and whether `a` is eliminated after `b`.
    pub(crate) fn matrix_entry_of(&self, a: RowIndex, b: RowIndex) -> (MatrixEntryIndex, bool) {
        let (a, b) = (self.positions[a], self.positions[b]);
        let range = self.matrix_column(a.min(b));
        let is_before = |&entry: &EntryIndex| self.rows[entry] < a.max(b);
        let at = range.start + self.matrix_entries.slice(range).partition_point(is_before);
        (MatrixEntryIndex::new(at), b < a)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn products(entries: usize) -> usize {
        entries * entries.saturating_sub(1) / 2
    }

    fn analysed(count: usize, edges: &[[RowIndex; 2]]) -> SymbolicFactor {
        let mut factor = SymbolicFactor::default();
        assert!(factor.analyse(count, edges, products, usize::MAX));
        factor
    }

    /// Returns `edges` without repetition, smaller index first, in ascending order.
    fn sorted(edges: impl Iterator<Item = [u32; 2]>) -> Vec<[RowIndex; 2]> {
        let mut edges: Vec<_> =
            edges.map(|[a, b]| [a.min(b), a.max(b)].map(RowIndex)).filter(|[a, b]| a < b).collect();
        edges.sort_unstable();
        edges.dedup();
        edges
    }

    fn grid(side: u32) -> Vec<[RowIndex; 2]> {
        let right = (0..side * side).filter(|at| at % side + 1 < side).map(|at| [at, at + 1]);
        let down = (0..side * (side - 1)).map(|at| [at, at + side]);
        sorted(right.chain(down))
    }

    /// Returns a graph of `count` rows with about `count` times `half_degree` pseudorandom edges.
    fn scattered(count: u32, half_degree: u32) -> Vec<[RowIndex; 2]> {
        let mut state = 12345_u32;
        let mut next = || {
            state = state.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
            (state >> 8) % count
        };
        sorted((0..count * half_degree).map(|_| [next(), next()]))
    }

    /// Returns the rows of each column of the factor by elimination of one row after the other in a dense matrix.
    fn eliminated(factor: &SymbolicFactor, edges: &[[RowIndex; 2]]) -> Vec<Vec<PlaceIndex>> {
        let count = factor.order.len();
        let mut is_entry = vec![vec![false; count]; count];
        for edge in edges {
            let [a, b] = edge.map(|row| factor.positions[row].position());
            (is_entry[a][b], is_entry[b][a]) = (true, true);
        }
        (0..count)
            .map(|column| {
                let below: Vec<usize> = (column + 1..count).filter(|&row| is_entry[row][column]).collect();
                for &a in &below {
                    below.iter().for_each(|&b| is_entry[a][b] = true);
                }
                below.into_iter().map(PlaceIndex::new).collect()
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
            assert!(rows.iter().copied().eq(factor.positions.indices()), "the order has each row once");
            let columns = eliminated(&factor, &edges);
            let found: Vec<Vec<PlaceIndex>> = factor
                .order
                .indices()
                .map(|place| factor.rows.slice(factor.column(place)).to_vec())
                .collect();
            assert_eq!(found, columns, "{edges:?}");
            assert_eq!(factor.product_count, columns.iter().map(|column| products(column.len())).sum());
            let places = || factor.order.indices();
            let of_rows =
                places().flat_map(|place| factor.row(place).iter().map(move |entry| (place, entry)));
            let by_row: Vec<_> = of_rows
                .inspect(|(place, entry)| assert_eq!(factor.rows[entry.index], *place))
                .map(|(place, entry)| (place, entry.column))
                .collect();
            let mut expected: Vec<_> = places()
                .zip(&columns)
                .flat_map(|(at, rows)| rows.iter().map(move |&row| (row, at)))
                .collect();
            expected.sort_unstable();
            assert_eq!(by_row, expected);
            for &[a, b] in &edges {
                let (entry, is_turned) = factor.matrix_entry_of(a, b);
                let [one, other] = [a, b].map(|row| factor.positions[row]);
                let at = factor.matrix_entries[entry];
                assert_eq!((factor.rows[at], is_turned), (one.max(other), other < one));
                assert!(factor.column(one.min(other)).contains(&at.position()));
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
