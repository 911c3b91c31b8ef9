//! Union-find: determines the islands of bodies that contacts, joints and springs connect.
//!
//! Disjoint sets with path halving (R. Tarjan and J. van Leeuwen, "Worst-case analysis of set union algorithms", 1984).

use std::ops::Range;

use crate::index::{DenseIndex, IndexedVec};
use crate::reusing_clone;

/// Disjoint sets of indices of type `I`: of bodies, each set is an island. The representative of a set is its smallest index,
/// so that the result does not depend on the order of unions.
#[derive(Debug)]
pub struct UnionFind<I> {
    /// For each index, a smaller index of its set, or the index itself if it is the smallest of the set.
    parent: IndexedVec<I, I>,
}

reusing_clone! { [I: Clone] UnionFind<I> { parent } }

impl<I> Default for UnionFind<I> {
    fn default() -> Self {
        UnionFind { parent: IndexedVec::default() }
    }
}

impl<I: DenseIndex> UnionFind<I> {
    /// Returns `count` sets of one index each.
    pub(crate) fn new(count: usize) -> Self {
        let mut sets = UnionFind::default();
        sets.reset(count);
        sets
    }

    /// Makes each index below `count` a set of its own.
    pub(crate) fn reset(&mut self, count: usize) {
        self.parent.clear();
        self.parent.extend((0..count).map(I::new));
    }

    /// Makes each of these `indices` a set of its own. No index outside of them may be in a set with one of them.
    pub(crate) fn separate(&mut self, indices: Range<usize>) {
        for (parent, index) in self.parent.slice_mut(indices.clone()).iter_mut().zip(indices) {
            *parent = I::new(index);
        }
    }

    /// Returns the representative of the set that contains `index`: the smallest index of the set.
    pub fn find(&mut self, index: I) -> I {
        let mut node = index;
        while self.parent[node] != node {
            // Path halving.
            let next = self.parent[self.parent[node]];
            self.parent[node] = next;
            node = next;
        }
        node
    }

    /// Unites the sets that contain the indices `a` and `b`. Returns whether the sets were different.
    pub(crate) fn unite(&mut self, a: I, b: I) -> bool {
        let (one, other) = (self.find(a), self.find(b));
        let (less, more) = if one < other { (one, other) } else { (other, one) };
        self.parent[more] = less;
        less != more
    }
}

#[cfg(test)]
mod tests {
    use super::UnionFind;
    use crate::index::BodyIndex;

    #[test]
    fn the_representative_is_the_smallest_index_in_any_order_of_unions() {
        let links = [[1, 2], [2, 7], [5, 6], [7, 5], [3, 4]];
        for first in 0..links.len() {
            let mut islands = UnionFind::new(8);
            for [a, b] in links.iter().cycle().skip(first).take(links.len()).map(|link| link.map(BodyIndex)) {
                assert!(islands.unite(a, b) && !islands.unite(b, a));
            }
            assert_eq!(
                [0, 1, 2, 3, 4, 5, 6, 7].map(|at| islands.find(BodyIndex(at)).0),
                [0, 1, 1, 3, 3, 1, 1, 1]
            );
        }
    }
}
