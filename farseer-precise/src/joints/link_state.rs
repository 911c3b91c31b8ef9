//! State of the links of an articulation when a step begins.

use super::articulated_body::{ArticulatedLink, Links};
use super::joint_constraint::{JointAnchor, JointConstraint, JointList};
use super::locked_dofs::LockedDofs;
use super::vec2::dot;
use crate::bodies::BodySet;
use crate::index::{BodyIndex, DenseIndex};

/// Copies poses and velocities of bodies, and anchors and forces of joints, to the links at the start of a step. `h` is the
/// solver's substep in seconds.
///
/// A fixed root takes position and velocity from the anchor of its joint.
pub(super) fn begin_links(
    links: &mut Links<ArticulatedLink>,
    constraints: &JointList,
    bodies: &BodySet,
    h: f64,
) {
    for at in links.indices() {
        let link = &mut links[at];
        link.begin_step(bodies);
        if !link.locked.is_joint() {
            // Rotating a zero arm could flip the sign of a zero.
            link.arm = [0.0; 2];
        } else {
            let anchor = link.attach_to_joint(&constraints[link.joint], h);
            let (parent, max_arm_squared) = (link.parent, dot(anchor.arm, anchor.arm));
            links[parent].max_arm_squared = links[parent].max_arm_squared.max(max_arm_squared);
            if links[parent].locked == LockedDofs::Fixed {
                (links[parent].position, links[parent].velocity) = (anchor.position, anchor.velocity);
            }
        }
    }
}

impl ArticulatedLink {
    /// Returns the sign of the joint force on this body: 1 for the second body of the joint, -1 for the first. Dimensionless.
    #[inline(always)]
    pub(super) fn joint_sign(&self) -> f64 {
        if self.is_first { -1.0 } else { 1.0 }
    }

    /// Sets position and velocity of the link to those of its body at the start of a step, and its displacement to 0.
    #[inline(always)]
    fn begin_step(&mut self, bodies: &BodySet) {
        let body = self.body.position();
        let ([x, y, ..], [vx, vy, spin, _]) =
            (bodies.poses[BodyIndex::new(body)], bodies.states[BodyIndex::new(body)].velocity);
        self.position = [f64::from(x), f64::from(y)];
        self.velocity = [vx, vy, spin].map(f64::from);
        (self.delta_pose, self.max_arm_squared) = ([0.0; 3], 0.0);
    }

    /// Sets the arms, the target and the initial impulse of the link from its joint. `h` is the solver's substep in seconds, in
    /// which the last force gives that impulse.
    ///
    /// Arms are vectors from the centres of mass to the anchors. Returns the parent's anchor.
    #[inline(always)]
    fn attach_to_joint<'a>(&mut self, constraint: &'a JointConstraint, h: f64) -> &'a JointAnchor {
        let [first, second] = &constraint.anchors;
        let (parent, child) = if self.is_first { (second, first) } else { (first, second) };
        (self.arm, self.parent_arm) = (child.arm, parent.arm);
        self.max_arm_squared = dot(self.arm, self.arm);
        self.angle_error_or_length = match constraint.locked {
            LockedDofs::Distance => constraint.range[1],
            _ => self.joint_sign() * (constraint.angle - constraint.range[1]),
        };
        let impulse_of_force = self.joint_sign() * h;
        self.impulse = constraint.force.map(|force| force * impulse_of_force);
        self.total_impulse = [0.0; 3];
        // Values that a snapshot does not contain must not influence the step, so the axis starts from a constant.
        self.axis = if constraint.locked == LockedDofs::Line { constraint.axis } else { [1.0, 0.0] };
        parent
    }
}
