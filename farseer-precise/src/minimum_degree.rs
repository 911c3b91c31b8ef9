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

/// Index instead of a node where there is none.
const NONE: u32 = u32::MAX;

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
    start: u32,
    /// Number of neighbours in the list.
    length: u32,
    /// Number of elements among the neighbours of a supervariable.
    elements: u32,
    /// Number of rows of a supervariable; 0 for elements and for merged nodes.
    weight: u32,
    /// Supervariable: upper bound of its number of neighbouring rows. Element: number of its rows; 0 if it is absorbed.
    degree: u32,
    /// Next node in the list of equal degree or of equal hash; [`NONE`] at the end.
    next: u32,
    /// Previous node in the list of equal degree, [`NONE`] at the head. For a supervariable of the pivot's element: its hash.
    previous: u32,
    /// Number of the last pivot whose element contains the supervariable or shares rows with the element.
    pivot: u32,
    /// Number of rows of an element outside of the present pivot's element.
    outside: u32,
    /// Number of the last comparison of lists that found the node.
    comparison: u32,
    /// Index of the next row of the supervariable; [`NONE`] at the end. These rows follow each other in the order.
    next_row: u32,
    /// Index of the last row of the supervariable.
    last_row: u32,
    /// Element: index of its parent in the assembly tree, the element that has absorbed it; [`NONE`] for a root.
    parent: u32,
    /// Element: index of the first of its children in the assembly tree, the elements that it has absorbed.
    child: u32,
    /// Element: index of the next child of its parent, or of the next root.
    sibling: u32,
}

/// The quotient graph of an ordering.
struct QuotientGraph {
    nodes: Vec<Node>,
    /// Neighbours of all nodes. The list of each new element is appended.
    lists: Vec<u32>,
    /// First supervariable of each degree; [`NONE`] if there is none.
    of_degree: Vec<u32>,
    /// First supervariable of each hash among those of the pivot's element; [`NONE`] outside of their comparison.
    of_hash: Vec<u32>,
    /// Number of pivots so far.
    pivots: u32,
    /// Number of comparisons of lists so far.
    comparisons: u32,
    /// Number of rows that are not eliminated.
    remaining: u32,
    /// Indices of the dense rows, which are no nodes of the graph and last in the order of elimination.
    dense_rows: Vec<u32>,
    /// Index of the first root of the assembly tree: the element of the last pivot of a component.
    root: u32,
}

/// Appends the order of elimination of a matrix with `count` rows to `order`, as row indices. Returns whether the total cost
/// of the columns of the factor without its dense rows is at most `max_cost`; if not, `order` stays as it is.
///
/// The order is a postorder of the assembly tree, in which pivots precede the pivots that absorb their elements. So columns with
/// equal rows follow each other. `edges` are the off-diagonal entries of the matrix as pairs of row indices, each pair once.
/// `cost` returns the cost of a column from its number of entries below the diagonal.
pub(crate) fn order_by_minimum_degree(
    count: usize,
    edges: &[[u32; 2]],
    (cost, max_cost): (fn(usize) -> usize, usize),
    order: &mut Vec<u32>,
) -> bool {
    let mut graph = QuotientGraph::new(count, edges);
    let (mut costs, mut degree) = (0, 0);
    while graph.remaining > 0 {
        while graph.of_degree[degree] == NONE {
            degree += 1;
        }
        let (pivot, before) = (graph.of_degree[degree], graph.remaining);
        let size = graph.eliminate(pivot) as usize;
        let rows = (before - graph.remaining) as usize;
        costs += (0..rows).map(|after| cost(size + after)).sum::<usize>();
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
    fn new(count: usize, edges: &[[u32; 2]]) -> Self {
        let node = Node {
            start: 0,
            length: 0,
            elements: 0,
            weight: 1,
            degree: 0,
            next: NONE,
            previous: NONE,
            pivot: 0,
            outside: 0,
            comparison: 0,
            next_row: NONE,
            last_row: 0,
            parent: NONE,
            child: NONE,
            sibling: NONE,
        };
        let mut nodes = vec![node; count];
        for &row in edges.iter().flatten() {
            nodes[row as usize].degree += 1;
        }
        let mut start = 0;
        for (row, node) in nodes.iter_mut().enumerate() {
            (node.start, node.last_row) = (start, row as u32);
            start += node.degree;
        }
        // Elements need about as much memory as the matrix.
        let mut lists = Vec::with_capacity(4 * edges.len());
        lists.resize(2 * edges.len(), 0);
        for &[a, b] in edges {
            for [row, neighbour] in [[a, b], [b, a]] {
                let node = &mut nodes[row as usize];
                lists[(node.start + node.length) as usize] = neighbour;
                node.length += 1;
            }
        }
        let (of_degree, of_hash) = (vec![NONE; count], vec![NONE; count]);
        let mut graph = QuotientGraph {
            nodes,
            lists,
            of_degree,
            of_hash,
            pivots: 0,
            comparisons: 0,
            remaining: count as u32,
            dense_rows: Vec::new(),
            root: NONE,
        };
        let max_degree = DENSE_ROW_MIN_DEGREE.max(DENSE_ROW_SQRT_FACTOR * (count as u32).isqrt());
        for row in (0..count as u32).rev() {
            let node = &mut graph.nodes[row as usize];
            if node.degree > max_degree {
                node.weight = 0;
                graph.dense_rows.push(row);
            } else {
                graph.insert_by_degree(row);
            }
        }
        graph.remaining -= graph.dense_rows.len() as u32;
        graph
    }

    /// Returns the range in `lists` of the neighbours of a node.
    fn list_of(&self, node: u32) -> std::ops::Range<usize> {
        let Node { start, length, .. } = self.nodes[node as usize];
        start as usize..(start + length) as usize
    }

    /// Inserts a supervariable at the head of the list of its degree.
    fn insert_by_degree(&mut self, row: u32) {
        let degree = self.nodes[row as usize].degree as usize;
        let next = std::mem::replace(&mut self.of_degree[degree], row);
        (self.nodes[row as usize].next, self.nodes[row as usize].previous) = (next, NONE);
        if next != NONE {
            self.nodes[next as usize].previous = row;
        }
    }

    /// Removes a supervariable from the list of its degree.
    fn remove_by_degree(&mut self, row: u32) {
        let Node { next, previous, degree, .. } = self.nodes[row as usize];
        match previous {
            NONE => self.of_degree[degree as usize] = next,
            _ => self.nodes[previous as usize].next = next,
        }
        if next != NONE {
            self.nodes[next as usize].previous = previous;
        }
    }

    /// Eliminates the supervariable `pivot`, and with it all that only its element connects to other rows. Returns the number
    /// of rows of the element.
    ///
    /// Degrees of the element's supervariables are bounds without the rows of the element, until
    /// [`finish_pivot`](Self::finish_pivot).
    fn eliminate(&mut self, pivot: u32) -> u32 {
        self.remove_by_degree(pivot);
        self.pivots += 1;
        self.make_element(pivot);
        for at in self.list_of(pivot) {
            self.count_outside(self.lists[at]);
        }
        for at in self.list_of(pivot) {
            self.update_neighbours(pivot, self.lists[at]);
        }
        self.nodes[pivot as usize].degree
    }

    /// Makes `pivot` an element: lists its neighbours, and absorbs the elements among these.
    fn make_element(&mut self, pivot: u32) {
        let Node { start, length, elements, weight, .. } = self.nodes[pivot as usize];
        self.remaining -= weight;
        (self.nodes[pivot as usize].weight, self.nodes[pivot as usize].pivot) = (0, self.pivots);
        let first = self.lists.len();
        for at in start..start + elements {
            let element = self.lists[at as usize];
            if self.nodes[element as usize].degree > 0 {
                self.add_to_element(self.list_of(element));
                self.absorb(element, pivot);
            }
        }
        self.add_to_element((start + elements) as usize..(start + length) as usize);
        let rows = self.lists[first..].iter().map(|&row| self.nodes[row as usize].weight).sum();
        let node = &mut self.nodes[pivot as usize];
        (node.start, node.length, node.degree) = (first as u32, (self.lists.len() - first) as u32, rows);
    }

    /// Marks `element` as absorbed by the element of `pivot`, and makes it a child of that in the assembly tree.
    fn absorb(&mut self, element: u32, pivot: u32) {
        let sibling = std::mem::replace(&mut self.nodes[pivot as usize].child, element);
        let node = &mut self.nodes[element as usize];
        (node.degree, node.parent, node.sibling) = (0, pivot, sibling);
    }

    /// Appends the remaining supervariables in a range of `lists` to the element of the pivot, each of them once, and removes
    /// them from the lists of their degrees.
    fn add_to_element(&mut self, range: std::ops::Range<usize>) {
        for at in range {
            let row = self.lists[at];
            let node = &mut self.nodes[row as usize];
            if node.weight > 0 && node.pivot != self.pivots {
                node.pivot = self.pivots;
                self.lists.push(row);
                self.remove_by_degree(row);
            }
        }
    }

    /// Subtracts the rows of the supervariable `row`, which is in the element of the pivot, from the rows outside of that
    /// element in each element that contains `row`.
    fn count_outside(&mut self, row: u32) {
        let Node { start, elements, weight, .. } = self.nodes[row as usize];
        for &element in &self.lists[start as usize..(start + elements) as usize] {
            let element = &mut self.nodes[element as usize];
            if element.degree > 0 {
                if element.pivot != self.pivots {
                    (element.pivot, element.outside) = (self.pivots, element.degree);
                }
                element.outside -= weight;
            }
        }
    }

    /// Removes from the list of `row`, a supervariable in the element of `pivot`, all neighbours inside of that element, and
    /// adds the element. Bounds the degree of `row` outside of the element. Without further neighbours `row` is eliminated with
    /// the pivot.
    fn update_neighbours(&mut self, pivot: u32, row: u32) {
        let Node { start, length, elements, weight, degree, .. } = self.nodes[row as usize];
        let (mut end, mut bound, mut hash) = (start as usize, 0, 0_u32);
        for at in start..start + elements {
            let element = self.lists[at as usize];
            let Node { degree, outside, .. } = self.nodes[element as usize];
            // An element inside of that of the pivot is absorbed.
            if degree > 0 && outside == 0 {
                self.absorb(element, pivot);
            } else if degree > 0 {
                bound += outside;
                hash = hash.wrapping_add(element);
                self.lists[end] = element;
                end += 1;
            }
        }
        let kept_elements = end;
        for at in start + elements..start + length {
            let neighbour = self.lists[at as usize];
            let Node { weight, pivot, .. } = self.nodes[neighbour as usize];
            if weight > 0 && pivot != self.pivots {
                bound += weight;
                hash = hash.wrapping_add(neighbour);
                self.lists[end] = neighbour;
                end += 1;
            }
        }
        if end == start as usize {
            return self.eliminate_with(pivot, row, weight);
        }
        // At least one entry was removed: the pivot, or an element that it has absorbed.
        self.lists[end] = self.lists[kept_elements];
        self.lists[kept_elements] = pivot;
        let buckets = self.of_hash.len() as u32;
        let node = &mut self.nodes[row as usize];
        node.elements = kept_elements as u32 - start + 1;
        node.length = end as u32 - start + 1;
        node.degree = degree.min(bound);
        node.previous = hash % buckets;
        node.next = std::mem::replace(&mut self.of_hash[node.previous as usize], row);
    }

    /// Eliminates the supervariable `row` together with `pivot`.
    fn eliminate_with(&mut self, pivot: u32, row: u32, weight: u32) {
        self.merge_rows(pivot, row);
        self.nodes[pivot as usize].degree -= weight;
        self.remaining -= weight;
    }

    /// Appends the rows of the supervariable `merged` to those of `to`.
    fn merge_rows(&mut self, to: u32, merged: u32) {
        self.nodes[merged as usize].weight = 0;
        let last_merged = self.nodes[merged as usize].last_row;
        let last = std::mem::replace(&mut self.nodes[to as usize].last_row, last_merged);
        self.nodes[last as usize].next_row = merged;
    }

    /// Merges equal supervariables of the pivot's element, sets the degrees of all, and inserts them in the lists by degree.
    /// Returns the smallest degree among them.
    fn finish_pivot(&mut self, pivot: u32) -> usize {
        for at in self.list_of(pivot) {
            let Node { weight, previous: hash, .. } = self.nodes[self.lists[at] as usize];
            if weight > 0 {
                let first = std::mem::replace(&mut self.of_hash[hash as usize], NONE);
                self.merge_equal(first);
            }
        }
        let size = self.nodes[pivot as usize].degree;
        let (mut end, mut min) = (self.nodes[pivot as usize].start, usize::MAX);
        for at in self.list_of(pivot) {
            let row = self.lists[at];
            let node = &mut self.nodes[row as usize];
            if node.weight > 0 {
                node.degree = (node.degree + size - node.weight).min(self.remaining - node.weight);
                min = min.min(node.degree as usize);
                self.lists[end as usize] = row;
                end += 1;
                self.insert_by_degree(row);
            }
        }
        let root = self.root;
        let node = &mut self.nodes[pivot as usize];
        node.length = end - node.start;
        if size == 0 {
            (node.sibling, self.root) = (root, pivot);
        }
        min
    }

    /// Merges equal supervariables in a list of equal hash that begins with `first`.
    fn merge_equal(&mut self, first: u32) {
        let mut one = first;
        while one != NONE && self.nodes[one as usize].next != NONE {
            self.comparisons += 1;
            for at in self.list_of(one) {
                self.nodes[self.lists[at] as usize].comparison = self.comparisons;
            }
            let (mut before, mut other) = (one, self.nodes[one as usize].next);
            while other != NONE {
                let next = self.nodes[other as usize].next;
                if self.is_equal(one, other) {
                    self.nodes[one as usize].weight += self.nodes[other as usize].weight;
                    self.merge_rows(one, other);
                    self.nodes[before as usize].next = next;
                } else {
                    before = other;
                }
                other = next;
            }
            one = self.nodes[one as usize].next;
        }
    }

    /// Returns whether the supervariables `one` and `other` have equal neighbours. The neighbours of `one` are marked with the
    /// number of the comparison.
    fn is_equal(&self, one: u32, other: u32) -> bool {
        let [a, b] = [one, other].map(|row| &self.nodes[row as usize]);
        (a.length, a.elements) == (b.length, b.elements)
            && self.lists[self.list_of(other)]
                .iter()
                .all(|&neighbour| self.nodes[neighbour as usize].comparison == self.comparisons)
    }

    /// Appends the rows of all pivots to `order`, in a postorder of the assembly tree, and then the dense rows.
    fn append_postorder(&self, order: &mut Vec<u32>) {
        order.reserve(self.nodes.len());
        let mut pivot = self.root;
        while pivot != NONE {
            // Down to the first leaf, then up until a sibling follows.
            while self.nodes[pivot as usize].child != NONE {
                pivot = self.nodes[pivot as usize].child;
            }
            loop {
                let mut row = pivot;
                while row != NONE {
                    order.push(row);
                    row = self.nodes[row as usize].next_row;
                }
                let Node { sibling, parent, .. } = self.nodes[pivot as usize];
                pivot = if sibling != NONE { sibling } else { parent };
                if sibling != NONE || parent == NONE {
                    break;
                }
            }
        }
        order.extend(self.dense_rows.iter().rev());
    }
}
