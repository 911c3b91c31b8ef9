//! Block LDL^T: direct solution of the sparse symmetric system of an island, with one 3x3 block per body.
//!
//! The matrix has a diagonal block for each body and a block for each two bodies that a constraint connects. Its order and its
//! fill-in come from the [symbolic factorisation](crate::sparse_ordering), once per graph. The numeric factors are
//! updated incrementally: from one Newton step to the next only few rows enter or leave the active set. On trees of bodies the
//! number of operations is linear, as with articulated bodies (D. Baraff, "Linear-time dynamics using Lagrange multipliers",
//! 1996, for that order). Sparse factorisation: T. Davis, "Direct Methods for Sparse Linear Systems" (2006).

use std::sync::Arc;

use super::mat3::{Mat3, Vec3};
use crate::index::{DenseIndex, IndexedVec, index_type};
use crate::minimum_degree::RowIndex;
use crate::reusing_clone;
use crate::sparse_ordering::{EntryIndex, MatrixEntryIndex, PlaceIndex, RowEntry, SymbolicFactor};

/// Position of the off-diagonal block of two bodies A and B in a [`BlockLdlt`].
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) struct BlockIndex {
    /// Index into the list of blocks of the matrix below the diagonal.
    index: MatrixEntryIndex,
    /// Whether the stored block is the transpose of the block with rows of B and columns of A.
    is_transposed: bool,
}

index_type! {
    /// Index of an entry of the factor within its column, below the diagonal.
    struct ColumnEntry;
}

/// The sparse matrix of an island and its factors L D L^T, with one 3x3 block (x, y, angle) per body.
#[derive(Debug, Default)]
pub(super) struct BlockLdlt {
    /// Graph and symbolic factorisation; islands of equal graphs share it.
    graph: Arc<EliminationGraph>,
    /// Blocks of the matrix and of its factors.
    pub(super) blocks: FactorBlocks,
}

/// The graph of an island, and its symbolic factorisation.
#[derive(Debug, Default)]
struct EliminationGraph {
    /// Graph of the last symbolic factorisation: pairs of indices of bodies that constraints connect.
    edges: Vec<[RowIndex; 2]>,
    /// Order in which the bodies are eliminated, and positions of all nonzero blocks of L.
    symbolic: SymbolicFactor,
}

/// The numeric part of a [`BlockLdlt`]. It is valid within one solution, so that all islands may use the same memory by turns:
/// [`BlockLdlt::set_block_diagonal`] sets its size and its content.
#[derive(Debug, Default)]
pub(super) struct FactorBlocks {
    /// Blocks of the matrix on the diagonal, in the order of elimination. The matrix is kept beside its factors, because few of
    /// its blocks change between two Newton steps.
    matrix_diagonal: IndexedVec<PlaceIndex, Mat3>,
    /// Blocks of the matrix below the diagonal, without fill-in, sorted by column and row in the order of elimination.
    matrix_lower: IndexedVec<MatrixEntryIndex, Mat3>,
    /// For each column in the order of elimination: whether the matrix changed there since the last factorisation.
    has_changed: IndexedVec<PlaceIndex, bool>,
    /// Inverses of the blocks of the block diagonal matrix D, in the order of elimination.
    inverse_diagonal: IndexedVec<PlaceIndex, Mat3>,
    /// Blocks of the product L D below the diagonal, fill-in included.
    lower_times_diagonal: IndexedVec<EntryIndex, Mat3>,
    /// Blocks of the unit lower triangular matrix L below the diagonal, at the positions of those of L D.
    lower: IndexedVec<EntryIndex, Mat3>,
    /// Scratch of [`factorise`](BlockLdlt::factorise): for each row below the diagonal of the present column the index
    /// of its entry in the column.
    entries_of_rows: IndexedVec<PlaceIndex, ColumnEntry>,
    /// Scratch of [`solve`](BlockLdlt::solve): one vector per body, in the order of elimination.
    solution: IndexedVec<PlaceIndex, Vec3>,
}

reusing_clone! { BlockLdlt { graph, blocks } }

reusing_clone! {
    FactorBlocks { matrix_diagonal, matrix_lower, has_changed, inverse_diagonal, lower_times_diagonal, lower, entries_of_rows, solution }
}

impl FactorBlocks {
    /// Sets the size: numbers of bodies, of blocks of the matrix below the diagonal, and of blocks of L below the diagonal.
    fn resize(&mut self, bodies: usize, matrix_blocks: usize, factor_blocks: usize) {
        self.matrix_diagonal.resize(bodies, Mat3::default());
        self.inverse_diagonal.resize(bodies, Mat3::default());
        self.matrix_lower.resize(matrix_blocks, Mat3::default());
        for of_entries in [&mut self.lower_times_diagonal, &mut self.lower] {
            of_entries.resize(factor_blocks, Mat3::default());
        }
        self.has_changed.resize(bodies, true);
        self.entries_of_rows.resize(bodies, ColumnEntry(0));
        self.solution.resize(bodies, [0.0; 3]);
    }
}

impl EliminationGraph {
    /// Returns whether the symbolic factorisation is that of the graph with `count` bodies and these `edges`.
    fn is_of(&self, count: usize, edges: &[[RowIndex; 2]]) -> bool {
        self.symbolic.positions.len() == count && self.edges == edges
    }

    /// Makes the symbolic factorisation: see [`BlockLdlt::analyse`].
    fn analyse(&mut self, count: usize, edges: &[[RowIndex; 2]], max_products: usize) -> bool {
        self.edges.clear();
        self.edges.extend_from_slice(edges);
        let products = |degree: usize| degree * degree.saturating_sub(1) / 2;
        self.symbolic.analyse(count, edges, products, max_products)
    }
}

impl BlockLdlt {
    /// Makes the symbolic factorisation for `count` bodies. Returns whether the numeric factorisation needs at most
    /// `max_products` products of blocks.
    ///
    /// `edges` are the pairs of bodies that constraints connect, as indices 0..`count`. Each pair occurs once, smaller index
    /// first, in ascending order. A graph equal to that of the last call, or to that of `similar`, is not analysed again.
    pub(super) fn analyse(
        &mut self,
        count: usize,
        edges: &[[RowIndex; 2]],
        max_products: usize,
        similar: Option<&Self>,
    ) -> bool {
        if !self.graph.is_of(count, edges)
            && let Some(similar) = similar.filter(|similar| similar.graph.is_of(count, edges))
        {
            self.graph = Arc::clone(&similar.graph);
        }
        if self.graph.is_of(count, edges) {
            return self.graph.symbolic.product_count <= max_products;
        }
        if Arc::get_mut(&mut self.graph).is_none() {
            self.graph = Arc::default();
        }
        Arc::get_mut(&mut self.graph).is_some_and(|graph| graph.analyse(count, edges, max_products))
    }

    /// Returns the numbers of bodies, of blocks below the diagonal, and of products of two blocks in one factorisation.
    pub(super) fn sizes(&self) -> [usize; 3] {
        let SymbolicFactor { order, rows, product_count, .. } = &self.graph.symbolic;
        [order.len(), rows.len(), *product_count]
    }

    /// Returns the position of the off-diagonal block of bodies `a` and `b`, which an edge of the graph must connect. Bodies
    /// are indices into the members of the island.
    pub(super) fn block_index(&self, a: RowIndex, b: RowIndex) -> BlockIndex {
        let (at, is_turned) = self.graph.symbolic.matrix_entry_of(a, b);
        BlockIndex { index: at, is_transposed: is_turned }
    }

    /// Sets the matrix to the block diagonal mass matrix. `masses` yields, for each body of the island, its mass (mass units)
    /// and its moment of inertia (mass units * length units^2).
    pub(super) fn set_block_diagonal(&mut self, masses: impl Iterator<Item = [f64; 2]>) {
        let EliminationGraph { edges, symbolic } = &*self.graph;
        self.blocks.resize(symbolic.order.len(), edges.len(), symbolic.rows.len());
        self.blocks.matrix_lower.fill(Mat3::default());
        self.blocks.has_changed.fill(true);
        for (&place, [mass, inertia]) in symbolic.positions.iter().zip(masses) {
            self.blocks.matrix_diagonal[place] = Mat3::from_diagonal([mass, mass, inertia]);
        }
    }

    /// Adds `block` to the diagonal block of `body`, an index into the members of the island.
    #[inline(always)]
    pub(super) fn add_diagonal_block(&mut self, body: RowIndex, block: &Mat3) {
        let place = self.graph.symbolic.positions[body];
        self.blocks.matrix_diagonal[place].add(block);
        self.blocks.has_changed[place] = true;
    }

    /// Adds `block`, a matrix with rows of B and columns of A, to the off-diagonal block of these bodies at `index`. Call
    /// [`add_diagonal_block`](Self::add_diagonal_block) for both bodies first: it marks their columns as changed.
    #[inline(always)]
    pub(super) fn add_off_diagonal_block(&mut self, index: BlockIndex, block: &Mat3) {
        let sum = &mut self.blocks.matrix_lower[index.index];
        sum.add(&if index.is_transposed { block.transposed() } else { *block });
    }

    /// Computes the factors of all columns that changed, and of their ancestors in the elimination tree.
    ///
    /// The factorisation is left-looking: each column subtracts the products with the columns of its row entries, in the order
    /// of elimination. An unchanged column keeps its factors. The parent of a column is its first row below the diagonal; all
    /// other rows below the diagonal are ancestors as well. The result is bit for bit that of a full factorisation.
    pub(super) fn factorise(&mut self) {
        self.mark_ancestors();
        for place in self.graph.symbolic.order.indices() {
            if std::mem::take(&mut self.blocks.has_changed[place]) {
                let mut diagonal = self.load_column(place);
                self.subtract_products(place, &mut diagonal);
                self.blocks.inverse_diagonal[place] = diagonal.inverse_symmetric();
            }
        }
    }

    /// Marks the ancestors of changed columns in `has_changed`.
    fn mark_ancestors(&mut self) {
        for place in self.graph.symbolic.order.indices() {
            if self.blocks.has_changed[place]
                && let Some(&parent) =
                    self.graph.symbolic.rows.slice(self.graph.symbolic.column(place)).first()
            {
                self.blocks.has_changed[parent] = true;
            }
        }
    }

    /// Copies the blocks of a column from the matrix to the factors, and lists its entries by row in `entries_of_rows`. Returns
    /// the block on the diagonal.
    fn load_column(&mut self, place: PlaceIndex) -> Mat3 {
        let FactorBlocks { lower_times_diagonal, entries_of_rows, matrix_lower, .. } = &mut self.blocks;
        let symbolic = &self.graph.symbolic;
        let (column, matrix_column) = (symbolic.column(place), symbolic.matrix_column(place));
        if matrix_column.len() < column.len() {
            lower_times_diagonal.slice_mut(column.clone()).fill(Mat3::default());
        }
        let entries = symbolic.matrix_entries.slice(matrix_column.clone());
        for (&entry, block) in entries.iter().zip(matrix_lower.slice(matrix_column)) {
            lower_times_diagonal[entry] = *block;
        }
        for (entry, &row) in symbolic.rows.slice(column).iter().enumerate() {
            entries_of_rows[row] = ColumnEntry::new(entry);
        }
        self.blocks.matrix_diagonal[place]
    }

    /// Subtracts from the column at `place` the products of all earlier columns with an entry in its row, and computes these
    /// entries of L. `diagonal` is the block of the column on the diagonal.
    fn subtract_products(&mut self, place: PlaceIndex, diagonal: &mut Mat3) {
        let FactorBlocks { inverse_diagonal, lower_times_diagonal, lower, entries_of_rows, .. } =
            &mut self.blocks;
        let symbolic = &self.graph.symbolic;
        let column = symbolic.column(place);
        // The blocks of earlier columns come before those of the column.
        let (earlier, of_column) = lower_times_diagonal.split_at_mut(column.start);
        let of_column = &mut of_column[..column.len()];
        for &RowEntry { column, index } in symbolic.row(place) {
            let (at, end) = (index.position(), symbolic.column(column).end);
            let block = earlier[at];
            let factor = block.mul_transposed(&inverse_diagonal[column]);
            diagonal.subtract(&block.mul_transposed(&factor));
            lower[index] = factor;
            if at + 1 < end {
                let below = at + 1..end;
                subtract_column(
                    of_column,
                    &earlier[below.clone()],
                    &factor,
                    symbolic.rows.slice(below),
                    entries_of_rows,
                );
            }
        }
    }

    /// Solves the system in place. `x` holds the right-hand side, one vector per body of the island, and then the solution. The
    /// steps are forward substitution with L, multiplication by the inverse of D, and back substitution.
    pub(super) fn solve(&mut self, x: &mut IndexedVec<RowIndex, Vec3>) {
        let FactorBlocks { inverse_diagonal, lower, solution, .. } = &mut self.blocks;
        let symbolic = &self.graph.symbolic;
        for (value, &body) in solution.iter_mut().zip(symbolic.order.iter()) {
            *value = x[body];
        }
        for place in symbolic.order.indices() {
            let (value, column) = (solution[place], symbolic.column(place));
            for (block, &row) in lower.slice(column.clone()).iter().zip(symbolic.rows.slice(column)) {
                let product = block.mul_vec(value);
                let under = &mut solution[row];
                *under = std::array::from_fn(|axis| under[axis] - product[axis]);
            }
        }
        for place in symbolic.order.indices().rev() {
            let (mut value, column) =
                (inverse_diagonal[place].mul_vec(solution[place]), symbolic.column(place));
            for (block, &row) in lower.slice(column.clone()).iter().zip(symbolic.rows.slice(column)) {
                let product = block.transposed_mul_vec(solution[row]);
                value = std::array::from_fn(|axis| value[axis] - product[axis]);
            }
            solution[place] = value;
            x[symbolic.order[place]] = value;
        }
    }
}

/// Subtracts from the blocks `of_column` of a column the products of `blocks`, blocks of an earlier column, and the transpose of
/// `factor`. `rows` are the rows of `blocks`, and `entries_of_rows` holds the entry of the column at each row.
///
/// The rows of the earlier column are among those of the column. If they are as many, they are equal, as in a supernode.
#[inline(never)]
fn subtract_column(
    of_column: &mut [Mat3],
    blocks: &[Mat3],
    factor: &Mat3,
    rows: &[PlaceIndex],
    entries_of_rows: &IndexedVec<PlaceIndex, ColumnEntry>,
) {
    if blocks.len() == of_column.len() {
        for (rest, block) in of_column.iter_mut().zip(blocks) {
            rest.subtract(&block.mul_transposed(factor));
        }
    } else {
        for (block, &row) in blocks.iter().zip(rows) {
            of_column[entries_of_rows[row].position()].subtract(&block.mul_transposed(factor));
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Adds a spring of stiffness `k` (dimensionless here) that couples all coordinates of two bodies.
    fn add_spring(factor: &mut BlockLdlt, [a, b]: [RowIndex; 2], k: f64) {
        // Stretch of the spring: u = x_b + 0.5 z_b - x_a - 0.2 z_a + 0.3 (y_b - y_a).
        let (ja, jb) = ([-1.0, -0.3, -0.2], [1.0, 0.3, 0.5]);
        let block = |rows: Vec3, columns: Vec3| {
            Mat3::from_rows(rows.map(|row| columns.map(|column| k * row * column)))
        };
        factor.add_diagonal_block(a, &block(ja, ja));
        factor.add_diagonal_block(b, &block(jb, jb));
        factor.add_off_diagonal_block(factor.block_index(a, b), &block(jb, ja));
    }

    /// Returns the product of `x` and the matrix of unit masses with springs as of [`add_spring`] between the bodies of all
    /// `edges`.
    fn spring_matrix_product(
        edges: &[[RowIndex; 2]],
        k: f64,
        x: &IndexedVec<RowIndex, Vec3>,
    ) -> IndexedVec<RowIndex, Vec3> {
        let mut sums = x.clone();
        for &[a, b] in edges {
            let (ja, jb) = ([-1.0, -0.3, -0.2], [1.0, 0.3, 0.5]);
            let dot = |j: Vec3, x: Vec3| j[0] * x[0] + j[1] * x[1] + j[2] * x[2];
            let u = dot(ja, x[a]) + dot(jb, x[b]);
            for (body, j) in [(a, ja), (b, jb)] {
                (0..3).for_each(|i| sums[body][i] += k * u * j[i]);
            }
        }
        sums
    }

    #[test]
    fn solution_satisfies_the_system_on_a_graph_with_cycles() {
        let edges = [[0, 1], [0, 4], [1, 2], [1, 3], [2, 3], [3, 4], [4, 5]].map(|ends| ends.map(RowIndex));
        let mut factor = BlockLdlt::default();
        assert!(factor.analyse(6, &edges, 100, None));
        factor.set_block_diagonal((0..6).map(|_| [1.0, 1.0]));
        edges.iter().for_each(|&edge| add_spring(&mut factor, edge, 1e3));
        factor.factorise();
        let wanted: IndexedVec<RowIndex, Vec3> =
            (0..6).map(|i| [f64::from(i), 1.0 - f64::from(i), 0.5]).collect();
        let mut x = wanted.clone();
        factor.solve(&mut x);
        for (found, wanted) in
            spring_matrix_product(&edges, 1e3, &x).into_iter().flatten().zip(wanted.into_iter().flatten())
        {
            // The bound is the backward error of the factorisation and both triangular solves of 18 rows. It is 3 x 18 + 1 times
            // the rounding error of `f64`, times the greatest row sum, times the greatest value 5. A row has up to four springs
            // of 1e3, each with a factor of 4. N. Higham, "Accuracy and Stability of Numerical Algorithms" (2002), theorem 10.4.
            assert!((found - wanted).abs() < 55.0 * 1.1e-16 * 1.6e4 * 5.0, "{found} is not {wanted}");
        }
    }

    #[test]
    fn incremental_factorisation_equals_full_factorisation_bit_by_bit() {
        // The graph is a ladder, which has much fill-in. Each spring in turn is added once more after a factorisation.
        let rails = (0..7).flat_map(|i| [[i, i + 1], [i + 8, i + 9]]);
        let mut edges: Vec<_> =
            (0..8).map(|i| [i, i + 8]).chain(rails).map(|ends| ends.map(RowIndex)).collect();
        edges.sort_unstable();
        let made = || {
            let mut factor = BlockLdlt::default();
            assert!(factor.analyse(16, &edges, 1000, None));
            factor.set_block_diagonal((0..16).map(|_| [1.0, 1.0]));
            edges.iter().for_each(|&edge| add_spring(&mut factor, edge, 1e3));
            factor
        };
        for (at, &edge) in edges.iter().enumerate() {
            let (mut at_once, mut in_parts) = (made(), made());
            in_parts.factorise();
            for factor in [&mut at_once, &mut in_parts] {
                add_spring(factor, edge, 77.0);
                factor.factorise();
            }
            assert!(in_parts.blocks.has_changed.iter().all(|changed| !changed));
            let bits = |mut factor: BlockLdlt| {
                let mut x: IndexedVec<RowIndex, Vec3> = (0..16).map(|i| [f64::from(i), 1.0, 0.5]).collect();
                factor.solve(&mut x);
                x.iter().flatten().map(|number| number.to_bits()).collect::<Vec<_>>()
            };
            assert_eq!(bits(in_parts), bits(at_once), "tie {at}");
        }
    }

    #[test]
    fn path_has_no_fill_in_and_dense_graph_is_refused_above_the_product_limit() {
        let path: Vec<_> = (0..99).map(|i| [i, i + 1].map(RowIndex)).collect();
        assert!(BlockLdlt::default().analyse(100, &path, 0, None));
        let all: Vec<_> = (0..10).flat_map(|a| (a + 1..10).map(move |b| [a, b].map(RowIndex))).collect();
        assert!(!BlockLdlt::default().analyse(10, &all, 100, None));
        assert!(BlockLdlt::default().analyse(10, &all, 120, None));
    }
}
