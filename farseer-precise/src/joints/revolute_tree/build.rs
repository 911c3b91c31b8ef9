//! Revolute links of an articulation, from its links and joints.

use super::super::articulated_body::{ArticulatedLink, Links};
use super::super::joint_constraint::JointList;
use super::super::locked_dofs::LockedDofs;
use super::super::substep_plan::stable_stiffness;
use super::super::vec2::dot;
use super::RevoluteLink;
use crate::mass::radius_of_gyration;

/// Converts a tree of links to revolute links. Returns an empty list if some joint is not a rigid revolute joint without a
/// motor.
pub(in super::super) fn revolute_links(
    links: &Links<ArticulatedLink>,
    constraints: &JointList,
) -> Links<RevoluteLink> {
    let is_rigid_revolute = |link: &ArticulatedLink| {
        let constraint = &constraints[link.joint];
        link.locked == LockedDofs::Point && constraint.softness == 0.0 && constraint.drive.is_none()
    };
    let is_root = |node: &ArticulatedLink| !node.locked.is_joint();
    if !links.iter().all(|node| is_root(node) || is_rigid_revolute(node)) {
        return Links::default();
    }
    let mut revolute_links: Links<RevoluteLink> =
        links.iter().map(|node| revolute_link(node, constraints)).collect();
    // The farther a joint is from the body's origin, the larger the stable stiffness is.
    let mut max_arms_squared: Links<f64> =
        revolute_links.iter().map(|link| dot(link.anchor, link.anchor)).collect();
    for link in revolute_links.iter().filter(|hinge| hinge.locked.is_joint()) {
        let max_arm_squared = &mut max_arms_squared[link.parent];
        *max_arm_squared = max_arm_squared.max(dot(link.parent_anchor, link.parent_anchor));
    }
    for (link, max_arm_squared) in revolute_links.iter_mut().zip(max_arms_squared.iter()) {
        let is_fixed = link.locked == LockedDofs::Fixed;
        link.stable_stiffness = if is_fixed {
            f64::INFINITY
        } else {
            stable_stiffness(link.inertia, link.mass, *max_arm_squared)
        };
    }
    revolute_links
}

/// Returns the revolute link of a link in a tree that has only rigid revolute joints.
fn revolute_link(link: &ArticulatedLink, constraints: &JointList) -> RevoluteLink {
    let [anchor, parent_anchor] = if link.locked.is_joint() {
        let [first, second] = constraints[link.joint].anchors.map(|anchor| anchor.local_anchor);
        if link.is_first { [first, second] } else { [second, first] }
    } else {
        [[0.0; 2]; 2]
    };
    let [arm, parent_arm] = [anchor, parent_anchor].map(|anchor| dot(anchor, anchor).sqrt());
    RevoluteLink {
        body: link.body,
        parent: link.parent,
        joint: link.joint,
        locked: link.locked,
        is_first: link.is_first,
        sign: link.joint_sign(),
        mass: link.mass,
        inertia: link.inertia,
        reach: arm + parent_arm + radius_of_gyration(link.mass, link.inertia),
        anchor,
        parent_anchor,
        ..RevoluteLink::default()
    }
}
