//! An articulation of the joints in the plane: its bodies, its joints and, if it is a tree, its links.

use super::articulated_body::{ArticulatedLink, Links};
use super::forest::{ArticulationPlan, TreeEntry};
use super::indices::JointIndex;
use super::joint_constraint::JointList;
use super::locked_dofs::LockedDofs;
use super::revolute_tree::{RevoluteLink, revolute_links};
use super::substep_plan::ArticulationSize;
use crate::bodies::BodySet;
use crate::index::BodyIndex;
use crate::mass::mass_of_inverse;
use crate::reusing_clone;

/// An articulation: dynamic bodies that joints connect, and these joints.
#[derive(Debug, Default)]
pub(super) struct Articulation {
    /// The links of the articulation's trees. Empty if a joint is no edge of a tree: it closes a loop, or has a motor, limits
    /// or a greatest impulse.
    pub(super) links: Links<ArticulatedLink>,
    /// Indices of the dynamic bodies into the arrays of `BodySet`.
    pub(super) bodies: Vec<BodyIndex>,
    /// Indices of the joints into `JointSystem::constraints`.
    pub(super) joints: Vec<JointIndex>,
    /// Whether joints without a range and without a greatest impulse close a loop.
    pub(super) has_loop: bool,
    /// Whether some joint is compliant. It yields in every substep, so that it needs the solver's substeps.
    pub(super) is_soft: bool,
    /// The bodies and joints of `links` as revolute links, if all joints are rigid revolute joints; else empty.
    pub(super) revolute_links: Links<RevoluteLink>,
    /// Whether no contact, spring or compliant joint acts on a body of the articulation in this step.
    pub(super) is_contact_free: bool,
    /// Whether the direct solver has solved the articulation in this step.
    pub(super) is_solved: bool,
    /// Size of the tree; 0 without links.
    pub(super) size: ArticulationSize,
    /// Number of substeps into which the articulation divided its last step without contacts.
    pub(super) substeps: u32,
}

reusing_clone! { Articulation { links, bodies, joints, has_loop, is_soft, revolute_links, is_contact_free, is_solved, size, substeps } }

impl Articulation {
    /// Returns the articulation of a plan, whose trees have the masses of `bodies` and the degrees of freedom of `constraints`.
    pub(super) fn new(plan: ArticulationPlan, constraints: &JointList, bodies: &BodySet) -> Self {
        let dynamic_bodies = plan
            .entries
            .iter()
            .map(|entry| entry.body)
            .filter(|&body| body != BodyIndex::PLACEHOLDER)
            .collect();
        let has_drive = |&at: &JointIndex| constraints[at].drive.is_some();
        let is_tree = plan.non_tree_joints.is_empty() && !plan.joints.iter().any(has_drive);
        let entries = if is_tree { plan.entries.slice(..) } else { &[] };
        let links: Links<ArticulatedLink> =
            entries.iter().map(|seat| link_of(seat, constraints, bodies)).collect();
        let revolute_links = revolute_links(&links, constraints);
        let has_rod = links.iter().any(|link| link.locked == LockedDofs::Distance);
        let dynamic_links = links.iter().filter(|link| link.body != BodyIndex::PLACEHOLDER);
        let size = ArticulationSize::of(dynamic_links.map(|link| link.mass), has_rod);
        let has_loop = plan.non_tree_joints.iter().any(|&at| !constraints[at].edge().is_bounded);
        let is_soft = plan.joints.iter().any(|&at| constraints[at].is_compliant());
        Articulation {
            links,
            bodies: dynamic_bodies,
            joints: plan.joints,
            has_loop,
            is_soft,
            revolute_links,
            size,
            ..Articulation::default()
        }
    }

    /// Returns whether the articulation moves as a free tree of revolute joints in this step.
    pub(super) fn is_free_revolute_tree(&self) -> bool {
        self.is_free() && !self.revolute_links.is_empty()
    }

    /// Returns whether all joints of the articulation are edges of trees: none closes a loop or has a motor, limits or a
    /// greatest impulse.
    pub(super) fn is_tree(&self) -> bool {
        !self.links.is_empty()
    }

    /// Returns whether the direct and the iterative solver leave the articulation to the articulated-body algorithm: it is a
    /// tree, it has no contacts, and the direct solver has not solved it.
    pub(super) fn is_free(&self) -> bool {
        self.is_contact_free && self.is_tree() && !self.is_solved
    }

    /// Returns whether the iterative solver solves the joints of the articulation in this step.
    pub(super) fn is_iterative(&self) -> bool {
        !(self.is_solved || self.is_free())
    }
}

/// Returns the link of a tree entry: masses and indices of its body, and the degrees of freedom that its joint locks.
fn link_of(entry: &TreeEntry, constraints: &JointList, bodies: &BodySet) -> ArticulatedLink {
    let [mass, inertia] = bodies.inverse_mass_inertia[entry.body].map(mass_of_inverse);
    let mut link = ArticulatedLink {
        body: entry.body,
        parent: entry.parent,
        locked: if entry.body == BodyIndex::PLACEHOLDER { LockedDofs::Fixed } else { LockedDofs::Free },
        mass,
        inertia,
        ..ArticulatedLink::default()
    };
    if let Some(joint) = entry.joint {
        (link.joint, link.locked) = (joint, constraints[joint].locked);
        // The joint's force acts on its second body. In a tree it acts on the child.
        link.is_first = constraints[joint].anchors[0].body == entry.body;
    }
    link
}
