//! Union-find: determines the islands of bodies that contacts, joints and springs connect.
//!
//! Disjoint sets with path halving (R. Tarjan and J. van Leeuwen, "Worst-case analysis of set union algorithms", 1984).

use std::ops::Range;

use crate::reusing_clone;

/// Disjoint sets of body indices, each an island. The representative of a set is its smallest index, so that the result does
/// not depend on the order of unions.
#[derive(Debug, Default)]
pub struct UnionFind {
    /// For each index, a smaller index of its set, or the index itself if it is the smallest of the set.
    parent: Vec<u32>,
}

reusing_clone! { UnionFind { parent } }

impl UnionFind {
    /// Returns `count` sets of one index each.
    pub(crate) fn new(count: usize) -> Self {
        let mut sets = UnionFind::default();
        sets.reset(count);
        sets
    }

    /// Makes each index below `count` a set of its own.
    pub(crate) fn reset(&mut self, count: usize) {
        self.parent.clear();
        self.parent.extend(0..count as u32);
    }

    /// Makes each of these `indices` a set of its own. No index outside of them may be in a set with one of them.
    pub(crate) fn separate(&mut self, indices: Range<usize>) {
        for (parent, index) in self.parent[indices.clone()].iter_mut().zip(indices) {
            *parent = index as u32;
        }
    }

    /// Returns the representative of the set that contains `index`: the smallest index of the set.
    pub fn find(&mut self, index: u32) -> u32 {
        let mut node = index;
        while self.parent[node as usize] != node {
            // Path halving.
            let next = self.parent[self.parent[node as usize] as usize];
            self.parent[node as usize] = next;
            node = next;
        }
        node
    }

    /// Unites the sets that contain the indices `a` and `b`. Returns whether the sets were different.
    pub(crate) fn unite(&mut self, a: u32, b: u32) -> bool {
        let (one, other) = (self.find(a), self.find(b));
        let (less, more) = if one < other { (one, other) } else { (other, one) };
        self.parent[more as usize] = less;
        less != more
    }
}

#[cfg(test)]
mod tests {
    use super::UnionFind;

    #[test]
    fn the_representative_is_the_smallest_index_in_any_order_of_unions() {
        let links = [[1, 2], [2, 7], [5, 6], [7, 5], [3, 4]];
        for first in 0..links.len() {
            let mut islands = UnionFind::new(8);
            for &[a, b] in links.iter().cycle().skip(first).take(links.len()) {
                assert!(islands.unite(a, b) && !islands.unite(b, a));
            }
            assert_eq!([0, 1, 2, 3, 4, 5, 6, 7].map(|at| islands.find(at)), [0, 1, 1, 3, 3, 1, 1, 1]);
        }
    }
}
