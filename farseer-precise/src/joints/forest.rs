//! Spanning forest of the joint graph: which joints form trees, and in which order the bodies of a tree are listed.
//!
//! Joints are taken in the order of the list. A joint becomes an edge of a tree if its bodies are not connected yet
//! (union-find, as in Kruskal's algorithm), else it closes a loop. Bounded joints never become edges. The module reads
//! `JointEdge`s and writes `ArticulationPlan`s.

use super::articulated_body::LinkIndex;
use super::indices::JointIndex;
use super::joint_constraint::JointEdge;
use crate::index::{BodyIndex, DenseIndex, IndexedVec, ListRanges};
use crate::island::union_find::UnionFind;

/// Index instead of that of an entry for a body that is in no tree.
pub(super) const NO_TREE_INDEX: LinkIndex = LinkIndex(u32::MAX);

/// Edges of the joint graph, in the order of the list of joints.
pub(super) type EdgeList = IndexedVec<JointIndex, JointEdge>;

/// Entry of a body in the list of an articulation's tree entries.
#[derive(Debug, Clone, Copy)]
pub(super) struct TreeEntry {
    /// Index of the body into the arrays of `BodySet`; 0 for the world.
    pub(super) body: BodyIndex,
    /// Index of the parent's entry, which comes earlier in the list; for a root, the index of the root's own entry.
    pub(super) parent: LinkIndex,
    /// Index of the joint between the body and its parent; `None` for a root. A root with body index 0 is the world.
    pub(super) joint: Option<JointIndex>,
}

/// An articulation: dynamic bodies that joints connect. Joints with the world do not connect bodies with each other.
#[derive(Debug, Clone, Default)]
pub(super) struct ArticulationPlan {
    /// Entries of the articulation's trees, one tree after the other, parents before children.
    pub(super) entries: IndexedVec<LinkIndex, TreeEntry>,
    /// Indices of all joints of the articulation.
    pub(super) joints: Vec<JointIndex>,
    /// Indices of the joints that are in no tree, because they close a loop or are bounded.
    pub(super) non_tree_joints: Vec<JointIndex>,
}

impl ArticulationPlan {
    /// Replaces each joint index i in the plan by `names[i]`, an index into the list of all joints.
    pub(super) fn map_joint_indices(&mut self, names: &[JointIndex]) {
        let of_entries = self.entries.iter_mut().filter_map(|entry| entry.joint.as_mut());
        for at in of_entries.chain(&mut self.joints).chain(&mut self.non_tree_joints) {
            *at = names[at.position()];
        }
    }
}

/// Trees and articulations of a list of joints.
#[derive(Debug, Clone, Default)]
pub(super) struct SpanningForest {
    /// Articulations in the order of their first joints.
    pub(super) articulations: Vec<ArticulationPlan>,
    /// For each body index: index of the body's entry in its articulation, or [`NO_TREE_INDEX`].
    pub(super) tree_index_of: IndexedVec<BodyIndex, LinkIndex>,
}

/// Edges of the trees by body.
struct TreeNeighbours {
    /// Ranges of the bodies in `edges`.
    of_bodies: ListRanges<BodyIndex>,
    /// Edges of the trees from each of their two bodies, as (joint index, index of the body on the other side). They are sorted
    /// by body, then by joint.
    edges: Vec<(JointIndex, BodyIndex)>,
}

impl TreeNeighbours {
    /// Returns the neighbours of `bodies` bodies in the trees. A joint of `edges` is an edge of a tree unless `is_non_tree`.
    fn new(edges: &EdgeList, is_non_tree: &IndexedVec<JointIndex, bool>, bodies: usize) -> Self {
        let of_trees = || edges.enumerated().filter(|&(at, _)| !is_non_tree[at]);
        let mut of_bodies = ListRanges::default();
        of_bodies.reset(bodies);
        of_trees().flat_map(|(_, edge)| edge.bodies).for_each(|body| of_bodies.count(body));
        of_bodies.begin_lists();
        let mut neighbours = vec![(JointIndex(0), BodyIndex::PLACEHOLDER); of_bodies.total()];
        let mut ends = of_bodies.clone();
        for (at, &JointEdge { bodies: [a, b], .. }) in of_trees() {
            for [body, other] in [[a, b], [b, a]] {
                neighbours[ends.next_position(body)] = (at, other);
            }
        }
        TreeNeighbours { of_bodies, edges: neighbours }
    }

    /// Returns the range in `edges` of the edges of a body.
    fn edges_of(&self, body: BodyIndex) -> std::ops::Range<usize> {
        self.of_bodies.range(body)
    }
}

/// Builder of the tree entries of all articulations.
struct ForestBuilder<'a> {
    /// Joints in the order of the list of joints.
    edges: &'a EdgeList,
    /// Edges of the trees by body.
    neighbours: TreeNeighbours,
    /// For each body index: index of the body's entry in its articulation, or [`NO_TREE_INDEX`].
    tree_index_of: IndexedVec<BodyIndex, LinkIndex>,
}

impl SpanningForest {
    /// Returns the forest of the joints `edges`, for body indices below `bodies`.
    ///
    /// Index 0 is the world. A second joint with the world closes a loop if a tree connects its body with the first one's.
    /// Without joints no body has an entry, and the list of entries by body is empty.
    pub(super) fn new(edges: &EdgeList, bodies: usize) -> Self {
        if edges.is_empty() {
            return SpanningForest::default();
        }
        let (mut in_trees, mut in_articulations) = (UnionFind::new(bodies), UnionFind::new(bodies));
        let mut is_non_tree = IndexedVec::of_copies(false, edges.len());
        for (at, edge) in edges.enumerated() {
            let [a, b] = edge.bodies;
            if a != BodyIndex::PLACEHOLDER && b != BodyIndex::PLACEHOLDER {
                in_articulations.unite(a, b);
            }
            is_non_tree[at] = edge.is_bounded || !in_trees.unite(a, b);
        }
        let neighbours = TreeNeighbours::new(edges, &is_non_tree, bodies);
        let mut members_of: Vec<Vec<JointIndex>> = Vec::new();
        let mut articulation_of = IndexedVec::of_copies(None, bodies);
        for (at, key) in edges.enumerated() {
            let root = in_articulations.find(key.bodies[0].max(key.bodies[1]));
            let articulation = *articulation_of[root].get_or_insert_with(|| {
                members_of.push(Vec::new());
                members_of.len() - 1
            });
            members_of[articulation].push(at);
        }
        let mut builder =
            ForestBuilder { edges, neighbours, tree_index_of: IndexedVec::of_copies(NO_TREE_INDEX, bodies) };
        let groups =
            members_of.iter().map(|members| builder.build_articulation(members, &is_non_tree)).collect();
        SpanningForest { articulations: groups, tree_index_of: builder.tree_index_of }
    }
}

impl ForestBuilder<'_> {
    /// Returns the articulation of the joints with the indices `members`: first the trees at the world, then the free trees.
    fn build_articulation(
        &mut self,
        members: &[JointIndex],
        is_non_tree: &IndexedVec<JointIndex, bool>,
    ) -> ArticulationPlan {
        let mut articulation = ArticulationPlan::default();
        // A tree has one body more than joints; each tree at the world has an entry of the world.
        articulation.entries.as_vec_mut().reserve(members.len() + 1);
        for &at in members.iter().filter(|&&at| !is_non_tree[at]) {
            let [a, b] = self.edges[at].bodies;
            if a == BodyIndex::PLACEHOLDER || b == BodyIndex::PLACEHOLDER {
                let root = articulation.entries.next_index();
                articulation.entries.push(TreeEntry {
                    body: BodyIndex::PLACEHOLDER,
                    parent: root,
                    joint: None,
                });
                self.add_entry(&mut articulation, a.max(b), root, Some(at));
                self.grow_tree(&mut articulation);
            }
        }
        for body in members.iter().flat_map(|&at| self.edges[at].bodies) {
            if body != BodyIndex::PLACEHOLDER && self.tree_index_of[body] == NO_TREE_INDEX {
                let root = articulation.entries.next_index();
                self.add_entry(&mut articulation, body, root, None);
                self.grow_tree(&mut articulation);
            }
        }
        articulation.joints = members.to_vec();
        articulation.non_tree_joints = members.iter().copied().filter(|&at| is_non_tree[at]).collect();
        articulation
    }

    /// Appends an entry for a body to the articulation.
    fn add_entry(
        &mut self,
        articulation: &mut ArticulationPlan,
        body: BodyIndex,
        parent: LinkIndex,
        joint: Option<JointIndex>,
    ) {
        self.tree_index_of[body] = articulation.entries.push(TreeEntry { body, parent, joint });
    }

    /// Appends the entries of all bodies below the last entry of the articulation, breadth first.
    fn grow_tree(&mut self, articulation: &mut ArticulationPlan) {
        let mut next = articulation.entries.len() - 1;
        while let Some(&entry) = articulation.entries.get(next) {
            let at = LinkIndex::new(next);
            for edge in self.neighbours.edges_of(entry.body) {
                let (joint, body) = self.neighbours.edges[edge];
                if body != BodyIndex::PLACEHOLDER && self.tree_index_of[body] == NO_TREE_INDEX {
                    self.add_entry(articulation, body, at, Some(joint));
                }
            }
            next += 1;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::{BodyIndex, EdgeList, JointEdge, JointIndex, SpanningForest};

    fn plan(pairs: &[[u32; 2]], bodies: usize) -> SpanningForest {
        let edge = |bodies: &[u32; 2]| JointEdge { bodies: bodies.map(BodyIndex), is_bounded: false };
        let edges: EdgeList = pairs.iter().map(edge).collect();
        SpanningForest::new(&edges, bodies)
    }

    fn entries(forest: &SpanningForest, articulation: usize) -> Vec<(u32, u32)> {
        forest.articulations[articulation]
            .entries
            .iter()
            .map(|entry| (entry.body.0, entry.parent.0))
            .collect()
    }

    #[test]
    fn a_hanging_chain_is_one_tree_in_joint_order() {
        let forest = plan(&[[1, 2], [0, 1], [2, 3]], 4);
        assert_eq!(entries(&forest, 0), [(0, 0), (1, 0), (2, 1), (3, 2)]);
        assert!(forest.articulations[0].non_tree_joints.is_empty());
    }

    #[test]
    fn a_loop_closure_is_in_no_tree() {
        assert_eq!(plan(&[[0, 1], [1, 2], [2, 0]], 3).articulations[0].non_tree_joints, [JointIndex(2)]);
        assert_eq!(plan(&[[1, 2], [2, 3], [3, 1]], 4).articulations[0].non_tree_joints, [JointIndex(2)]);
    }

    #[test]
    fn joints_with_the_world_connect_no_articulations() {
        let forest = plan(&[[0, 1], [0, 2]], 3);
        assert_eq!(forest.articulations.len(), 2);
        assert_eq!((entries(&forest, 0), entries(&forest, 1)), (vec![(0, 0), (1, 0)], vec![(0, 0), (2, 0)]));
    }

    #[test]
    fn a_loop_closure_connects_two_trees_to_one_articulation() {
        let forest = plan(&[[0, 1], [0, 2], [1, 2]], 3);
        assert_eq!(forest.articulations.len(), 1);
        assert_eq!(entries(&forest, 0), [(0, 0), (1, 0), (0, 2), (2, 2)]);
        assert_eq!(forest.articulations[0].non_tree_joints, [JointIndex(2)]);
    }
}
