//! Approximate minimum degree ordering: the order of elimination of a sparse symmetric matrix that gives little fill-in.
//!
//! Each step eliminates a row with the fewest remaining neighbours. The graph of the remaining rows is a quotient graph: an
//! eliminated row becomes an element, the list of its remaining neighbours, and stands for all edges between these. So the
//! graph never grows. Rows with equal neighbours form one supervariable and are eliminated together; an element inside of
//! another one is absorbed. The degree of a row is an upper bound, the sum over its elements and neighbours. Rows with very many
//! neighbours, such as a plate with a hundred welded parts, are last. Trees of rows get no fill-in. Time and memory are nearly
//! linear in the number of edges.
//!
//! W. Tinney and J. Walker, "Direct solutions of sparse network equations by optimally ordered triangular factorization" (1967),
//! for minimum degree. P. Amestoy, T. Davis and I. Duff, "An approximate minimum degree ordering algorithm" (1996). C. Ashcraft,
//! "Compressed graphs and the minimum degree algorithm" (1995), for hashes of supervariables.

use crate::index::{DenseIndex, IndexedVec, index_type};
use std::mem::replace;
use std::ops::Range;

index_type! {
    /// Index of a row of the matrix, and of the node that it is at first in the quotient graph.
    pub(crate) struct RowIndex;
}

index_type! {
    /// Index into the neighbours of all nodes.
    struct ListIndex;
}
index_type! {
    /// Bound of the number of neighbouring rows, as an index.
    struct DegreeIndex;
}
index_type! {
    /// Hash of the list of neighbours of a supervariable, below the number of rows.
    struct HashIndex;
}

impl ListIndex {
    /// Returns the index `count` entries later.
    #[inline(always)]
    fn after(self, count: u32) -> Self {
        ListIndex(self.0 + count)
    }
}

/// Index instead of a node where there is none.
const NONE: RowIndex = RowIndex(u32::MAX);

/// Least number of neighbours above which a row may count as dense, a count. Dense rows are last in the order of elimination.
///
/// Otherwise each elimination beside a dense row reads all of its neighbours, and the time for a star is quadratic. P. Amestoy,
/// T. Davis and I. Duff, "Algorithm 837: AMD, an approximate minimum degree ordering algorithm" (2004).
const DENSE_ROW_MIN_DEGREE: u32 = 16;
/// Multiple of the square root of the number of rows above which a number of neighbours makes a row dense, dimensionless. Source
/// as for [`DENSE_ROW_MIN_DEGREE`].
const DENSE_ROW_SQRT_FACTOR: u32 = 10;

/// A node of the quotient graph: a supervariable of remaining rows, an element, or a node that is merged or absorbed.
#[derive(Debug, Clone, Copy)]
struct Node {
    /// Index into `lists` of the first neighbour of the node: for a supervariable its elements, then its neighbours that no
    /// element connects; for an element its supervariables.
    start: ListIndex,
    /// Number of neighbours in the list.
    length: u32,
    /// Number of elements among the neighbours of a supervariable.
    elements: u32,
    /// Number of rows of a supervariable; 0 for elements and for merged nodes.
    weight: u32,
    /// Supervariable: upper bound of its number of neighbouring rows. Element: number of its rows; 0 if it is absorbed.
    degree: u32,
    /// Next node in the list of equal degree or of equal hash; [`NONE`] at the end.
    next: RowIndex,
    /// Previous node in the list of equal degree, [`NONE`] at the head.
    previous: RowIndex,
    /// Hash of a supervariable of the pivot's element.
    hash: HashIndex,
    /// Number of the last pivot whose element contains the supervariable or shares rows with the element.
    pivot: u32,
    /// Number of rows of an element outside of the present pivot's element.
    outside: u32,
    /// Number of the last comparison of lists that found the node.
    comparison: u32,
    /// Index of the next row of the supervariable; [`NONE`] at the end. These rows follow each other in the order.
    next_row: RowIndex,
    /// Index of the last row of the supervariable.
    last_row: RowIndex,
    /// Element: index of its parent in the assembly tree, the element that has absorbed it; [`NONE`] for a root.
    parent: RowIndex,
    /// Element: index of the first of its children in the assembly tree, the elements that it has absorbed.
    child: RowIndex,
    /// Element: index of the next child of its parent, or of the next root.
    sibling: RowIndex,
}

impl Node {
    /// A supervariable of one row, without neighbours.
    const OF_ROW: Node = Node {
        start: ListIndex(0),
        length: 0,
        elements: 0,
        weight: 1,
        degree: 0,
        next: NONE,
        previous: NONE,
        hash: HashIndex(0),
        pivot: 0,
        outside: 0,
        comparison: 0,
        next_row: NONE,
        last_row: NONE,
        parent: NONE,
        child: NONE,
        sibling: NONE,
    };

    /// Returns the range in `lists` of all neighbours.
    #[inline(always)]
    fn list(&self) -> Range<usize> {
        self.start.position()..self.start.after(self.length).position()
    }

    /// Returns the range in `lists` of the elements among the neighbours of a supervariable.
    #[inline(always)]
    fn element_list(&self) -> Range<usize> {
        self.start.position()..self.start.after(self.elements).position()
    }

    /// Returns the range in `lists` of the neighbours of a supervariable that no element connects.
    #[inline(always)]
    fn supervariable_list(&self) -> Range<usize> {
        self.element_list().end..self.list().end
    }
}

/// Returns a supervariable for each of `count` rows of a matrix with these `edges`. Its list has its place but no neighbours yet.
fn nodes_of_rows(count: usize, edges: &[[RowIndex; 2]]) -> IndexedVec<RowIndex, Node> {
    let mut nodes = IndexedVec::of_copies(Node::OF_ROW, count);
    for &row in edges.iter().flatten() {
        nodes[row].degree += 1;
    }
    let mut start = ListIndex(0);
    for row in nodes.indices() {
        let node = &mut nodes[row];
        (node.start, node.last_row) = (start, row);
        start = start.after(node.degree);
    }
    nodes
}

/// Returns the lists of neighbours of all `nodes`, with space for the elements, and sets the lengths of the lists.
fn list_neighbours(edges: &[[RowIndex; 2]], nodes: &mut IndexedVec<RowIndex, Node>) -> Vec<RowIndex> {
    // Elements need about as much memory as the matrix.
    let mut lists = Vec::with_capacity(4 * edges.len());
    lists.resize(2 * edges.len(), NONE);
    for &[a, b] in edges {
        for [row, neighbour] in [[a, b], [b, a]] {
            let node = &mut nodes[row];
            lists[node.list().end] = neighbour;
            node.length += 1;
        }
    }
    lists
}

/// The quotient graph of an ordering.
struct QuotientGraph {
    nodes: IndexedVec<RowIndex, Node>,
    /// Neighbours of all nodes. The list of each new element is appended.
    lists: Vec<RowIndex>,
    /// First supervariable of each degree; [`NONE`] if there is none.
    of_degree: IndexedVec<DegreeIndex, RowIndex>,
    /// First supervariable of each hash among those of the pivot's element; [`NONE`] outside of their comparison.
    of_hash: IndexedVec<HashIndex, RowIndex>,
    /// Number of pivots so far.
    pivots: u32,
    /// Number of comparisons of lists so far.
    comparisons: u32,
    /// Number of rows that are not eliminated.
    remaining: u32,
    /// Indices of the dense rows, which are no nodes of the graph and last in the order of elimination.
    dense_rows: Vec<RowIndex>,
    /// Index of the first root of the assembly tree: the element of the last pivot of a component.
    root: RowIndex,
}

/// The neighbours of a supervariable that it keeps while a pivot is eliminated.
struct KeptNeighbours {
    /// Index into `lists` behind the last kept neighbour.
    end: usize,
    /// Number of rows of the kept neighbours, outside of the element of the pivot.
    rows: u32,
    /// Sum of the indices of the kept neighbours, modulo 2^32.
    hash: u32,
}

impl KeptNeighbours {
    /// Keeps a neighbour with `rows` rows outside of the element of the pivot.
    #[inline(always)]
    fn push(&mut self, neighbour: RowIndex, rows: u32, lists: &mut [RowIndex]) {
        self.rows += rows;
        self.hash = self.hash.wrapping_add(neighbour.0);
        lists[self.end] = neighbour;
        self.end += 1;
    }
}

/// Appends the order of elimination of a matrix with `count` rows to `order`, as row indices. Returns whether the total cost
/// of the columns of the factor without its dense rows is at most `max_cost`; if not, `order` stays as it is.
///
/// The order is a postorder of the assembly tree, in which pivots precede the pivots that absorb their elements. So columns with
/// equal rows follow each other. `edges` are the off-diagonal entries of the matrix as pairs of row indices, each pair once.
/// `cost` returns the cost of a column from its number of entries below the diagonal.
pub(crate) fn order_by_minimum_degree(
    count: usize,
    edges: &[[RowIndex; 2]],
    (cost, max_cost): (fn(usize) -> usize, usize),
    order: &mut Vec<RowIndex>,
) -> bool {
    let mut graph = QuotientGraph::new(count, edges);
    let (mut costs, mut degree) = (0, 0);
    while graph.remaining > 0 {
        while graph.of_degree[DegreeIndex(degree)] == NONE {
            degree += 1;
        }
        let (pivot, before) = (graph.of_degree[DegreeIndex(degree)], graph.remaining);
        let size = graph.eliminate(pivot);
        let rows = before - graph.remaining;
        costs += (size..size + rows).map(|degree| cost(DegreeIndex(degree).position())).sum::<usize>();
        if costs > max_cost {
            return false;
        }
        degree = graph.finish_pivot(pivot).min(degree);
    }
    graph.append_postorder(order);
    true
}

impl QuotientGraph {
    /// Returns the graph of the matrix: each row is a supervariable.
    fn new(count: usize, edges: &[[RowIndex; 2]]) -> Self {
        let mut nodes = nodes_of_rows(count, edges);
        let mut graph = QuotientGraph {
            lists: list_neighbours(edges, &mut nodes),
            nodes,
            of_degree: IndexedVec::of_copies(NONE, count),
            of_hash: IndexedVec::of_copies(NONE, count),
            pivots: 0,
            comparisons: 0,
            remaining: count as u32,
            dense_rows: Vec::new(),
            root: NONE,
        };
        graph.sort_by_degree();
        graph
    }

    /// Sorts all supervariables by degree, and puts the dense rows aside.
    fn sort_by_degree(&mut self) {
        let max_degree = DENSE_ROW_MIN_DEGREE.max(DENSE_ROW_SQRT_FACTOR * (self.nodes.len() as u32).isqrt());
        for row in self.nodes.indices().rev() {
            let node = &mut self.nodes[row];
            if node.degree > max_degree {
                node.weight = 0;
                self.dense_rows.push(row);
            } else {
                self.insert_by_degree(row);
            }
        }
        self.remaining -= self.dense_rows.len() as u32;
    }

    /// Returns the range in `lists` of the neighbours of a node.
    fn list_of(&self, node: RowIndex) -> Range<usize> {
        self.nodes[node].list()
    }

    /// Inserts a supervariable at the head of the list of its degree.
    fn insert_by_degree(&mut self, row: RowIndex) {
        let degree = DegreeIndex(self.nodes[row].degree);
        let next = replace(&mut self.of_degree[degree], row);
        (self.nodes[row].next, self.nodes[row].previous) = (next, NONE);
        if next != NONE {
            self.nodes[next].previous = row;
        }
    }

    /// Removes a supervariable from the list of its degree.
    fn remove_by_degree(&mut self, row: RowIndex) {
        let Node { next, previous, degree, .. } = self.nodes[row];
        match previous {
            NONE => self.of_degree[DegreeIndex(degree)] = next,
            _ => self.nodes[previous].next = next,
        }
        if next != NONE {
            self.nodes[next].previous = previous;
        }
    }

    /// Eliminates the supervariable `pivot`, and with it all that only its element connects to other rows. Returns the number
    /// of rows of the element.
    ///
    /// Degrees of the element's supervariables are bounds without the rows of the element, until
    /// [`finish_pivot`](Self::finish_pivot).
    fn eliminate(&mut self, pivot: RowIndex) -> u32 {
        self.remove_by_degree(pivot);
        self.pivots += 1;
        self.make_element(pivot);
        for at in self.list_of(pivot) {
            self.count_outside(self.lists[at]);
        }
        for at in self.list_of(pivot) {
            self.update_neighbours(pivot, self.lists[at]);
        }
        self.nodes[pivot].degree
    }

    /// Makes `pivot` an element: lists its neighbours, and absorbs the elements among these.
    fn make_element(&mut self, pivot: RowIndex) {
        let node = self.nodes[pivot];
        self.remaining -= node.weight;
        (self.nodes[pivot].weight, self.nodes[pivot].pivot) = (0, self.pivots);
        let first = self.lists.len();
        for at in node.element_list() {
            let element = self.lists[at];
            if self.nodes[element].degree > 0 {
                self.add_to_element(self.list_of(element));
                self.absorb(element, pivot);
            }
        }
        self.add_to_element(node.supervariable_list());
        let rows = self.lists[first..].iter().map(|&row| self.nodes[row].weight).sum();
        let node = &mut self.nodes[pivot];
        (node.start, node.length, node.degree) =
            (ListIndex::new(first), (self.lists.len() - first) as u32, rows);
    }

    /// Marks `element` as absorbed by the element of `pivot`, and makes it a child of that in the assembly tree.
    fn absorb(&mut self, element: RowIndex, pivot: RowIndex) {
        let sibling = replace(&mut self.nodes[pivot].child, element);
        let node = &mut self.nodes[element];
        (node.degree, node.parent, node.sibling) = (0, pivot, sibling);
    }

    /// Appends the remaining supervariables in a range of `lists` to the element of the pivot, each of them once, and removes
    /// them from the lists of their degrees.
    fn add_to_element(&mut self, range: Range<usize>) {
        for at in range {
            let row = self.lists[at];
            let node = &mut self.nodes[row];
            if node.weight > 0 && node.pivot != self.pivots {
                node.pivot = self.pivots;
                self.lists.push(row);
                self.remove_by_degree(row);
            }
        }
    }

    /// Subtracts the rows of the supervariable `row`, which is in the element of the pivot, from the rows outside of that
    /// element in each element that contains `row`.
    fn count_outside(&mut self, row: RowIndex) {
        let node = self.nodes[row];
        for &element in &self.lists[node.element_list()] {
            let element = &mut self.nodes[element];
            if element.degree > 0 {
                if element.pivot != self.pivots {
                    (element.pivot, element.outside) = (self.pivots, element.degree);
                }
                element.outside -= node.weight;
            }
        }
    }

    /// Removes from the list of `row`, a supervariable in the element of `pivot`, all neighbours inside of that element, and
    /// adds the element. Bounds the degree of `row` outside of the element. Without further neighbours `row` is eliminated with
    /// the pivot.
    fn update_neighbours(&mut self, pivot: RowIndex, row: RowIndex) {
        let node = self.nodes[row];
        let start = node.list().start;
        let mut kept = KeptNeighbours { end: start, rows: 0, hash: 0 };
        self.keep_elements(pivot, node.element_list(), &mut kept);
        let kept_elements = kept.end;
        self.keep_supervariables(node.supervariable_list(), &mut kept);
        let KeptNeighbours { end, rows, hash } = kept;
        if end == start {
            return self.eliminate_with(pivot, row, node.weight);
        }
        // At least one entry was removed: the pivot, or an element that it has absorbed.
        self.lists[end] = self.lists[kept_elements];
        self.lists[kept_elements] = pivot;
        let buckets = self.of_hash.len() as u32;
        let node = &mut self.nodes[row];
        node.elements = (kept_elements - start) as u32 + 1;
        node.length = (end - start) as u32 + 1;
        node.degree = node.degree.min(rows);
        node.hash = HashIndex(hash % buckets);
        node.next = replace(&mut self.of_hash[node.hash], row);
    }

    /// Keeps the elements of a supervariable, in the range `elements` of `lists`, that have rows outside of the element of
    /// `pivot`. The pivot absorbs the others.
    #[inline(always)]
    fn keep_elements(&mut self, pivot: RowIndex, elements: Range<usize>, kept: &mut KeptNeighbours) {
        for at in elements {
            let element = self.lists[at];
            let Node { degree, outside, .. } = self.nodes[element];
            if degree > 0 && outside == 0 {
                self.absorb(element, pivot);
            } else if degree > 0 {
                kept.push(element, outside, &mut self.lists);
            }
        }
    }

    /// Keeps the neighbours of a supervariable, in the range `neighbours` of `lists`, that are outside of the element of the
    /// pivot.
    #[inline(always)]
    fn keep_supervariables(&mut self, neighbours: Range<usize>, kept: &mut KeptNeighbours) {
        for at in neighbours {
            let neighbour = self.lists[at];
            let Node { weight, pivot, .. } = self.nodes[neighbour];
            if weight > 0 && pivot != self.pivots {
                kept.push(neighbour, weight, &mut self.lists);
            }
        }
    }

    /// Eliminates the supervariable `row` together with `pivot`.
    fn eliminate_with(&mut self, pivot: RowIndex, row: RowIndex, weight: u32) {
        self.merge_rows(pivot, row);
        self.nodes[pivot].degree -= weight;
        self.remaining -= weight;
    }

    /// Appends the rows of the supervariable `merged` to those of `to`.
    fn merge_rows(&mut self, to: RowIndex, merged: RowIndex) {
        self.nodes[merged].weight = 0;
        let last_merged = self.nodes[merged].last_row;
        let last = replace(&mut self.nodes[to].last_row, last_merged);
        self.nodes[last].next_row = merged;
    }

    /// Merges equal supervariables of the pivot's element, sets the degrees of all, and inserts them in the lists by degree.
    /// Returns the smallest degree among them.
    fn finish_pivot(&mut self, pivot: RowIndex) -> u32 {
        for at in self.list_of(pivot) {
            let Node { weight, hash, .. } = self.nodes[self.lists[at]];
            if weight > 0 {
                let first = replace(&mut self.of_hash[hash], NONE);
                self.merge_equal(first);
            }
        }
        let size = self.nodes[pivot].degree;
        let (mut end, mut min) = (self.list_of(pivot).start, u32::MAX);
        for at in self.list_of(pivot) {
            let row = self.lists[at];
            let node = &mut self.nodes[row];
            if node.weight > 0 {
                node.degree = (node.degree + size - node.weight).min(self.remaining - node.weight);
                min = min.min(node.degree);
                self.lists[end] = row;
                end += 1;
                self.insert_by_degree(row);
            }
        }
        let root = self.root;
        let node = &mut self.nodes[pivot];
        node.length = (end - node.list().start) as u32;
        if size == 0 {
            (node.sibling, self.root) = (root, pivot);
        }
        min
    }

    /// Merges equal supervariables in a list of equal hash that begins with `first`.
    fn merge_equal(&mut self, first: RowIndex) {
        let mut one = first;
        while one != NONE && self.nodes[one].next != NONE {
            self.comparisons += 1;
            for at in self.list_of(one) {
                self.nodes[self.lists[at]].comparison = self.comparisons;
            }
            let (mut before, mut other) = (one, self.nodes[one].next);
            while other != NONE {
                let next = self.nodes[other].next;
                if self.is_equal(one, other) {
                    self.nodes[one].weight += self.nodes[other].weight;
                    self.merge_rows(one, other);
                    self.nodes[before].next = next;
                } else {
                    before = other;
                }
                other = next;
            }
            one = self.nodes[one].next;
        }
    }

    /// Returns whether the supervariables `one` and `other` have equal neighbours. The neighbours of `one` are marked with the
    /// number of the comparison.
    fn is_equal(&self, one: RowIndex, other: RowIndex) -> bool {
        let [a, b] = [one, other].map(|row| &self.nodes[row]);
        (a.length, a.elements) == (b.length, b.elements)
            && self.lists[self.list_of(other)]
                .iter()
                .all(|&neighbour| self.nodes[neighbour].comparison == self.comparisons)
    }

    /// Appends the rows of all pivots to `order`, in a postorder of the assembly tree, and then the dense rows.
    fn append_postorder(&self, order: &mut Vec<RowIndex>) {
        order.reserve(self.nodes.len());
        let mut pivot = self.root;
        while pivot != NONE {
            // Down to the first leaf, then up until a sibling follows.
            while self.nodes[pivot].child != NONE {
                pivot = self.nodes[pivot].child;
            }
            loop {
                let mut row = pivot;
                while row != NONE {
                    order.push(row);
                    row = self.nodes[row].next_row;
                }
                let Node { sibling, parent, .. } = self.nodes[pivot];
                pivot = if sibling != NONE { sibling } else { parent };
                if sibling != NONE || parent == NONE {
                    break;
                }
            }
        }
        order.extend(self.dense_rows.iter().rev());
    }
}
