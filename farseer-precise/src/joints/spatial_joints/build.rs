//! Builds the groups of joints in three axes, and the sparsity pattern of their rows.

use super::super::super::bodies::BodySet;
use super::super::indices::JointIndex;
use super::super::joint_constraint::{JointConstraint, JointList};
use super::super::locked_dofs::LockedDofs;
use super::constraint_row::SpatialJointRow;
use super::group_solver::{OffDiagonal, SpatialJointGroup};
use super::joint_state::{JointState, NodeIndex};
use super::row_kind::RowKind;
use super::sparse_ldlt::SparseLdlt;
use crate::index::{BodyIndex, DenseIndex, IndexedVec, index_type};
use crate::island::union_find::UnionFind;
use crate::minimum_degree::RowIndex;
use crate::parameters::spatial_joints::GROUP_MAX_FACTOR_PRODUCTS;
use crate::sparse_ordering::EntryIndex;
use crate::storage::order::{packed_key, sort_by_number};

/// Returns the groups of joints in three axes, and the indices of the joints outside of these groups. A group is a connected
/// component of the joint graph that contains a distance joint.
///
/// The groups are in the order of their first joints. Static and kinematic bodies do not connect joints.
pub(in super::super) fn spatial_groups(
    joints: &JointList,
    bodies: &BodySet,
) -> (Vec<SpatialJointGroup>, Vec<JointIndex>) {
    let mut unions = UnionFind::new(bodies.states.len());
    for [a, b] in joints.iter().map(|joint| joint.anchors.map(|end| end.body)) {
        if a != BodyIndex::PLACEHOLDER && b != BodyIndex::PLACEHOLDER {
            unions.unite(a, b);
        }
    }
    let mut root_of = |joint: &JointConstraint| unions.find(joint.anchors[0].body.max(joint.anchors[1].body));
    let roots: Vec<BodyIndex> = joints.iter().map(&mut root_of).collect();
    let mut groups: Vec<Vec<JointIndex>> = Vec::new();
    let distances = joints.iter().zip(&roots).filter(|(joint, _)| joint.locked == LockedDofs::Distance);
    let mut has_distance: Vec<BodyIndex> = distances.map(|(_, &root)| root).collect();
    has_distance.sort_unstable();
    has_distance.dedup();
    let (mut group_of, mut others) = (vec![None; has_distance.len()], Vec::new());
    for (at, root) in joints.indices().zip(&roots) {
        match has_distance.binary_search(root) {
            Ok(of) => {
                let group = *group_of[of].get_or_insert_with(|| {
                    groups.push(Vec::new());
                    groups.len() - 1
                });
                groups[group].push(at);
            }
            Err(_) => others.push(at),
        }
    }
    (groups.iter().map(|members| SpatialJointGroup::new(members, joints, bodies)).collect(), others)
}

impl SpatialJointGroup {
    /// Returns the group of the joints with the indices `members` into `joints`.
    fn new(members: &[JointIndex], joints: &JointList, bodies: &BodySet) -> Self {
        let mut body_indices: Vec<BodyIndex> = members
            .iter()
            .flat_map(|&at| joints[at].anchors.map(|end| end.body))
            .filter(|&body| body != BodyIndex::PLACEHOLDER)
            .collect();
        body_indices.sort_unstable();
        body_indices.dedup();
        let closing = find_loop_closures(members, joints, &body_indices);
        let mut group =
            SpatialJointGroup { has_loops: closing.contains(&true), ..SpatialJointGroup::default() };
        let mut ground_sides = 0;
        for (&at, closes_loop) in members.iter().zip(closing) {
            let joint = &joints[at];
            let nodes = joint.anchors.map(|end| {
                body_indices.binary_search(&end.body).unwrap_or_else(|_| {
                    ground_sides += 1;
                    body_indices.len() + ground_sides - 1
                })
            });
            let nodes = nodes.map(NodeIndex::new);
            let of_joint = (group.joints.push(JointState::new(at, joint.locked, nodes)), nodes);
            let kinds = row_kinds(joint).into_iter();
            group.rows.extend(kinds.map(|kind| SpatialJointRow::new(of_joint, kind, closes_loop)));
        }
        let inverses = body_indices.iter().map(|&body| {
            let [mass, inertia] = bodies.inverse_mass_inertia[body].map(f64::from);
            [mass, mass, inertia, mass]
        });
        group.inverse_masses = inverses.chain(std::iter::repeat_n([0.0; 4], ground_sides)).collect();
        group.velocities = IndexedVec::of_copies([0.0; 4], group.inverse_masses.len());
        group.velocity_errors = vec![0.0; group.rows.len()];
        group.bodies = body_indices.into_iter().collect();
        group.find_off_diagonals();
        group
    }

    /// Finds the pairs of rows that share a body, chooses the elimination order of the sparse factorisation, and stores the
    /// index of each matrix element.
    ///
    /// The group gets no factorisation if one would need more than [`GROUP_MAX_FACTOR_PRODUCTS`] products.
    fn find_off_diagonals(&mut self) {
        let mut holders = IndexedVec::<NodeIndex, _>::of_copies(Vec::new(), self.bodies.len());
        for (at, row) in self.rows.enumerated() {
            for (is_second, node) in [false, true].into_iter().zip(row.nodes) {
                if let Some(rows) = holders.at_mut(node) {
                    rows.push((at, is_second));
                }
            }
        }
        let of_two = |of: &Vec<(RowIndex, bool)>| of.len() * of.len().saturating_sub(1) / 2;
        // Each pair of rows at a body costs one product or more.
        if holders.iter().map(of_two).sum::<usize>() > GROUP_MAX_FACTOR_PRODUCTS {
            return;
        }
        let mut ties = Vec::new();
        for (body, holders) in holders.enumerated() {
            for (at, &(row, is_second)) in holders.iter().enumerate() {
                for &(other, is_others_second) in &holders[at + 1..] {
                    ties.push([row, other]);
                    let (rows, is_second) = ([row, other], [is_second, is_others_second]);
                    let entry = EntryIndex::default();
                    self.off_diagonals.push(OffDiagonal { body, rows, is_second, entry, term: 0.0 });
                }
            }
        }
        sort_by_number(&mut ties, |tie| packed_key(tie.map(|row| row.0)));
        ties.dedup();
        self.ldlt = SparseLdlt::plan(self.rows.len(), &ties, GROUP_MAX_FACTOR_PRODUCTS);
        match &self.ldlt {
            Some(sparse) => {
                self.off_diagonals
                    .iter_mut()
                    .for_each(|of| of.entry = sparse.entry_index(of.rows[0], of.rows[1]));
            }
            None => self.off_diagonals.clear(),
        }
    }
}

index_type! {
    /// Index of a node of the joint graph: 0 for all static and kinematic bodies, then the other bodies.
    struct GraphNode;
}

/// Returns for each joint of `members` whether it closes a loop of the joint graph, in which all static and kinematic bodies
/// are one node.
fn find_loop_closures(members: &[JointIndex], joints: &JointList, bodies: &[BodyIndex]) -> Vec<bool> {
    let mut unions = UnionFind::new(bodies.len() + 1);
    // Node 0 is the world.
    let node_of =
        |body: BodyIndex| bodies.binary_search(&body).map_or(GraphNode(0), |place| GraphNode::new(place + 1));
    let ends = members.iter().map(|&at| joints[at].anchors.map(|end| node_of(end.body)));
    let closes_loop = ends.map(|[a, b]| {
        let is_joined = unions.find(a) == unions.find(b);
        unions.unite(a, b);
        is_joined
    });
    closes_loop.collect()
}

/// Returns the kinds of the rows of a joint: one entry for each row.
fn row_kinds(joint: &JointConstraint) -> Vec<RowKind> {
    let mut kinds = match joint.locked {
        // Gears and pulleys do not act in a group with depth.
        LockedDofs::Free
        | LockedDofs::Fixed
        | LockedDofs::Unlocked
        | LockedDofs::Gear
        | LockedDofs::Pulley => vec![],
        LockedDofs::Point => vec![RowKind::AnchorAxis(0), RowKind::AnchorAxis(1), RowKind::DepthVelocity],
        LockedDofs::Weld => {
            vec![RowKind::AnchorAxis(0), RowKind::AnchorAxis(1), RowKind::Angle, RowKind::DepthVelocity]
        }
        LockedDofs::Angle => vec![RowKind::Angle],
        LockedDofs::Distance => vec![RowKind::Distance],
        LockedDofs::Line => vec![RowKind::LineOffset, RowKind::Angle, RowKind::DepthVelocity],
        LockedDofs::PointOnLine => vec![RowKind::LineOffset, RowKind::DepthVelocity],
    };
    if joint.is_axis_lock {
        kinds.retain(|kind| !matches!(kind, RowKind::DepthVelocity));
    }
    if let Some(drive) = joint.drive {
        kinds.extend(drive.motor.map(RowKind::Motor));
        kinds.extend(drive.limits.map(RowKind::Limits));
    }
    kinds
}
