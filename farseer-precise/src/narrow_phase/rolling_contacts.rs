//! Narrow phase: stores the contacts of polygons that have rolled over a static face, after the last substep.

use super::NarrowPhase;
use crate::broad_phase::pairs::CachedManifold;
use crate::constraint_graph::{ConstraintHandle, ContactConstraint};
use crate::contact_solver::rolling::{RollingContact, StaticPlane};
use crate::math::plane::{difference, dot, rotate, rotation, scaled, sum, translation};

impl NarrowPhase<'_> {
    /// Stores the rolling contacts that the iterative solver has moved, after the last substep, and clears their list.
    pub(crate) fn store_rolling_contacts(&mut self) {
        let mut rolling = std::mem::take(self.rolling_contacts);
        for roll in rolling.drain(..).filter(|roll| roll.pivot.is_none()) {
            if let Some(handle) = self.pairs.state(roll.pair).constraint {
                self.store_rolling_contact(roll, handle);
            }
        }
        *self.rolling_contacts = rolling;
    }

    /// Stores manifold, impulses and separations of a rolling contact in its pair and its constraint, after the last substep.
    /// The cached manifold gets the present vertices, with anchors and separations for the pose at the beginning of the step: a
    /// snapshot restores constraints from these manifolds, with equal arms.
    fn store_rolling_contact(&mut self, roll: RollingContact, handle: ConstraintHandle) {
        let pair = roll.pair;
        let kind = self.pairs.state(pair).kind;
        let old = self.constraints.get(kind, handle);
        let is_second = roll.end_separations[1] < roll.end_separations[0];
        let order = if is_second { [1, 0] } else { [0, 1] };
        let is_near = |at: usize| {
            roll.end_separations[at] < self.parameters.speculative_distance
                || old.points[at].normal_impulse > 0.0
        };
        let count = 1 + u32::from(is_near(order[1]));
        let order = if count == 2 { [0, 1] } else { order };
        *self.pairs.manifold_mut(pair) = self.rolled_manifold(&roll, order, count);
        self.pairs.recheck(pair);
        self.pairs.state_mut(pair).are_points_removed = [false; 2];
        let now = self.current_constraint(pair);
        let is_set = self.pairs.state(pair).has_surface_override;
        let mut constraint = ContactConstraint {
            points: now.points,
            tangent_arms: now.tangent_arms,
            tangent_mass: now.tangent_mass,
            tangent_speed: if is_set { old.tangent_speed } else { now.tangent_speed },
            ..old
        };
        for (slot, &at) in order.iter().enumerate().take(self.pairs.manifold(pair).point_count()) {
            constraint.points[slot].normal_impulse = old.points[at].normal_impulse;
            constraint.points[slot].separation = roll.end_separations[at];
            constraint.depth.totals[slot] = old.depth.totals[at];
        }
        (constraint.depth.across_arms, constraint.depth.across_speed) =
            (now.depth.across_arms, now.depth.across_speed);
        self.constraints.set(kind, handle, &constraint);
    }

    /// Returns the manifold of a rolling contact with the first `count` of its vertices in this `order`, 1..=2.
    fn rolled_manifold(&self, roll: &RollingContact, order: [usize; 2], count: u32) -> CachedManifold {
        let pair = roll.pair;
        let outline = self.proxies.shape_of(roll.proxies[1]);
        let [a, b] = roll.proxies.map(|proxy| self.bodies.poses[self.proxies.body_of(proxy)]);
        let apart = difference(translation(b), translation(a));
        let plane = StaticPlane::of(self.pairs.manifold(pair));
        let mut manifold = *self.pairs.manifold(pair);
        let names_face = !self.pairs.state(pair).is_on_ground;
        for (slot, &at) in order.iter().enumerate() {
            let corner = roll.vertices[at];
            let round = scaled(plane.normal, outline.shape.radius);
            let arm = difference(rotate(rotation(b), outline.vertices[corner as usize]), round);
            let separation = dot(sum(apart, arm), plane.normal) - plane.offset;
            let arm = difference(arm, scaled(plane.normal, 0.5 * separation));
            let on_a = sum(apart, arm);
            manifold.anchors[slot] = [on_a[0], on_a[1], arm[0], arm[1]];
            manifold.separations[slot] = separation;
            let face = if names_face { manifold.features[slot] & 0xffff_0000 } else { 0 };
            manifold.features[slot] = face | corner;
        }
        (manifold.count, manifold.arm_lead_angle) = (count, 0.0);
        manifold
    }
}
