//! Selection of the polygons that pivot over static faces in a step, and storage of their velocities and contact impulses after
//! the step.
//!
//! The contact constraints of such a body stay in the iterative solver, so that a body which it meets in the next step has a
//! warm start. After the substeps the pose and velocity from `PivotingPolygon` replace the pose and velocity of the body.

use crate::constraint_graph::ContactConstraint;
use crate::contact_solver::pivoting::{PivotState, PivotingPolygon};
use crate::contact_solver::rolling::{FaceExtent, RollingContact, RollingSolver, StaticPlane, incident_edge};
use crate::index::{BodyIndex, PairIndex};
use crate::math::plane::{
    Vector, cross, difference, dot, rotate, rotate_inverse, rotation, scaled, sum, translation,
};
use crate::math::scalar;
use crate::narrow_phase::combined_surface::rolling_arm_of;
use crate::parameters::contacts::{PIVOT_MAX_PENETRATION, PIVOT_PLANE_TOLERANCE};
use crate::scaled_parameters::StepContext;

impl RollingSolver<'_> {
    /// Finds the polygons that pivot in closed form in this step, and sets `pivot` of one contact of each. The contacts of such
    /// a polygon that come later in `rolling` are removed from it.
    pub(crate) fn find_pivoting_bodies(&mut self, rolling: &mut Vec<RollingContact>, step: &StepContext) {
        rolling.retain_mut(|roll| {
            let polygon = roll.proxies[1];
            if self.proxy_flags[polygon] {
                return false;
            }
            roll.pivot = self.pivot_through_step(roll, step);
            self.proxy_flags[polygon] = roll.pivot.is_some();
            true
        });
        rolling.iter().for_each(|roll| self.proxy_flags[roll.proxies[1]] = false);
    }

    /// Returns the state after the step of the polygon of a rolling contact. `None` if the polygon touches anything but static
    /// faces of one plane, or slides on that plane or leaves it.
    fn pivot_through_step(&self, roll: &mut RollingContact, step: &StepContext) -> Option<PivotState> {
        let [at_a, at_b] = roll.proxies;
        let pair = self.pairs.pairs_of(at_b).find(|&at| self.pairs.proxies_of(at) == roll.proxies)?;
        roll.pair = pair;
        let b = self.proxies.body_of(at_b);
        let outline = self.proxies.shape_of(at_b);
        let ([x, y, spin, z], force_delta) = (self.bodies.states[b].velocity, self.bodies.force_delta[b]);
        let is_in_plane = [z, force_delta[3]] == [0.0; 2] && outline.shape.radius == 0.0;
        let is_jointed = self.joints.has_joint(b) || self.joints.has_iterative_joint(b);
        if !(is_in_plane && outline.vertices.len() > 2) || is_jointed {
            return None;
        }
        let pose_a = self.bodies.poses[self.proxies.body_of(at_a)];
        let contact_plane = StaticPlane::of(self.pairs.manifold(pair));
        let offset = contact_plane.offset
            + dot(difference(translation(pose_a), translation(self.bodies.poses[b])), contact_plane.normal);
        let plane = StaticPlane { normal: contact_plane.normal, offset };
        let (constraint, friction) = self.coplanar_contact(b, roll, &plane)?;
        let can_turn = constraint.inverse_masses[1] > 0.0 && constraint.inverse_inertias[1] > 0.0;
        if !can_turn {
            return None;
        }
        let [ax, ay, turning, _] = force_delta.map(|push| push / step.h);
        let pivoting = PivotingPolygon {
            outline,
            rotation: rotation(self.bodies.poses[b]),
            normal: plane.normal,
            gyration_squared: constraint.inverse_masses[1] / constraint.inverse_inertias[1],
            acceleration: [ax, ay],
            angular_acceleration: turning,
            friction,
            restitution_threshold: if constraint.restitution > 0.0 {
                self.parameters.restitution_threshold
            } else {
                f32::MAX
            },
        };
        let ends = incident_edge(outline, rotate_inverse(pivoting.rotation, plane.normal));
        let lowest =
            ends.map(|end| dot(rotate(pivoting.rotation, outline.vertices[end as usize]), plane.normal));
        let depth = scalar::min(lowest[0], lowest[1]) - plane.offset;
        let is_on_plane = depth.abs() <= PIVOT_MAX_PENETRATION * self.parameters.speculative_distance;
        if !is_on_plane {
            return None;
        }
        let after = pivoting.advance(ends, [x, y, spin], step.dt)?;
        let points = ends_before_and_after(&pivoting, ends, &after);
        self.are_supported(roll, &plane, &points).then_some(after)
    }

    /// Returns the constraint of the rolling contact of body `b`, and the least friction coefficient (dimensionless) of all its
    /// contacts. `None` if the closed form does not apply.
    ///
    /// It applies if all contacts of `b` are contacts of the rolling polygon with static shapes that do not reach above `plane`.
    /// A polygon that pivots on the plane then meets no other face of these shapes. The offset of the plane is measured from the
    /// origin of `b`.
    fn coplanar_contact(
        &self,
        b: BodyIndex,
        roll: &RollingContact,
        plane: &StaticPlane,
    ) -> Option<(ContactConstraint, f32)> {
        let (mut rolling, mut friction) = (None, f32::MAX);
        for pair in self.pairs.pairs_of_body(self.proxies, b) {
            let state = self.pairs.state(pair);
            let Some(handle) = state.constraint else { continue };
            let constraint = self.constraints.get(state.kind, handle);
            let [_, other] = self.pairs.proxies_of(pair);
            let is_still =
                [constraint.tangent_speed, constraint.depth.across_speed, constraint.depth.normal_z]
                    == [0.0; 3];
            let resists_rolling = self.proxies.resist_rolling && {
                let [a, b] = self.pairs.proxies_of(pair).map(|proxy| self.proxies.proxy(proxy));
                rolling_arm_of(a, b) > 0.0
            };
            let is_static =
                state.kind.is_static && other == roll.proxies[1] && self.constraints.parked(handle).is_none();
            if !(is_static
                && is_still
                && !resists_rolling
                && self.height_above_plane(pair, plane)
                    <= PIVOT_PLANE_TOLERANCE * self.parameters.length_unit)
            {
                return None;
            }
            friction = scalar::min(friction, constraint.friction);
            if pair == roll.pair {
                rolling = Some(constraint);
            }
        }
        Some((rolling?, friction))
    }

    /// Returns the height of the highest point of shape A of a pair above `plane`, length units; negative below it. `f32::MAX`
    /// for a ground of `twohalf` that is not parallel to the plane. The offset of the plane is measured from the origin of body
    /// B.
    fn height_above_plane(&self, pair: PairIndex, plane: &StaticPlane) -> f32 {
        let [at_a, at_b] = self.pairs.proxies_of(pair);
        let [a, b] = [at_a, at_b].map(|proxy| self.bodies.poses[self.proxies.body_of(proxy)]);
        let above = dot(difference(translation(a), translation(b)), plane.normal) - plane.offset;
        if self.pairs.state(pair).is_on_ground {
            let contact_plane = StaticPlane::of(self.pairs.manifold(pair));
            let is_level = cross(contact_plane.normal, plane.normal).abs() <= PIVOT_PLANE_TOLERANCE;
            return if is_level { above + contact_plane.offset } else { f32::MAX };
        }
        let (outline, direction) = (self.proxies.shape_of(at_a), rotate_inverse(rotation(a), plane.normal));
        above + outline.shape.radius + outline.max_projection(direction)
    }

    /// Returns whether static faces in `plane`, that of the contact `roll`, are under all `points`. These are relative to the origin
    /// of body B, in world axes, length units.
    fn are_supported(&self, roll: &RollingContact, plane: &StaticPlane, points: &[Vector; 4]) -> bool {
        let mut is_supported = [false; 4];
        let at_b = roll.proxies[1];
        for pair in self.pairs.pairs_of(at_b).filter(|&pair| self.has_level_face(pair, roll, plane)) {
            if self.pairs.state(pair).is_on_ground {
                return true;
            }
            let [at_a, _] = self.pairs.proxies_of(pair);
            let (face, b) = (self.proxies.shape_of(at_a), self.proxies.body_of(at_b));
            let pose_a = self.bodies.poses[self.proxies.body_of(at_a)];
            let apart = difference(translation(self.bodies.poses[b]), translation(pose_a));
            let q = rotation(pose_a);
            let direction = rotate_inverse(q, plane.normal);
            let top = FaceExtent::of(face, direction);
            if top.is_normal_to(direction, PIVOT_PLANE_TOLERANCE) {
                for (is_supported, &point) in is_supported.iter_mut().zip(points) {
                    *is_supported |= top.contains(rotate_inverse(q, sum(apart, point)));
                }
            }
        }
        is_supported == [true; 4]
    }

    /// Returns whether the pair is of the polygon of `roll` and of a static shape whose highest points lie in `plane`, that of the
    /// contact `roll`.
    fn has_level_face(&self, pair: PairIndex, roll: &RollingContact, plane: &StaticPlane) -> bool {
        let (state, [_, other]) = (self.pairs.state(pair), self.pairs.proxies_of(pair));
        let is_met = state.constraint.is_some() || self.is_planar;
        let is_static_contact = state.kind.is_static && state.has_response();
        let is_level = || {
            let height = || self.height_above_plane(pair, plane).abs();
            pair == roll.pair || height() <= PIVOT_PLANE_TOLERANCE * self.parameters.length_unit
        };
        other == roll.proxies[1] && is_met && is_static_contact && is_level()
    }

    /// Returns the number of contact constraints of the polygons in `rolling` that pivot in closed form.
    pub(crate) fn count_pivot_constraints(&self, rolling: &[RollingContact]) -> usize {
        let polygons = rolling.iter().filter(|roll| roll.pivot.is_some()).map(|roll| roll.proxies[1]);
        let pairs = polygons.flat_map(|polygon| self.pairs.pairs_of(polygon));
        pairs.filter(|&pair| self.pairs.state(pair).constraint.is_some()).count()
    }

    /// Overwrites the velocity of a pivoting body, and the impulses of its contact constraints, after the last substep. The
    /// constraint of the rolling contact `roll` gets the impulse of the face's reaction in one substep; all other constraints
    /// of the polygon get impulse 0. Separations follow the closed form, unless substeps of contacts have advanced them.
    pub(crate) fn store_pivot(
        &mut self,
        roll: &RollingContact,
        after: &PivotState,
        step: &StepContext,
        has_contact_substeps: bool,
    ) {
        let at_b = roll.proxies[1];
        let b = self.proxies.body_of(at_b);
        let [x, y] = after.velocity();
        self.bodies.states[b].velocity = [x, y, after.angular_velocity, 0.0];
        let impulse = scaled(after.reaction, step.h / self.bodies.inverse_mass_inertia[b][0]);
        for pair in self.pairs.pairs_of(at_b) {
            let state = *self.pairs.state(pair);
            let Some(handle) = state.constraint else { continue };
            let mut constraint = self.constraints.get(state.kind, handle);
            let is_pivot_contact = pair == roll.pair;
            let reaction_impulse = if is_pivot_contact { impulse } else { [0.0; 2] };
            let [normal_impulse, tangent_impulse] =
                [dot(reaction_impulse, constraint.normal), -cross(constraint.normal, reaction_impulse)];
            let moved = dot(after.delta_position, constraint.normal);
            for (at, point) in constraint.points.iter_mut().enumerate() {
                if !has_contact_substeps {
                    point.separation += moved + after.delta_rotation * point.normal_arm_b;
                }
                point.normal_impulse = if at == 0 { normal_impulse } else { 0.0 };
                point.rest_impulse = point.normal_impulse;
                constraint.depth.totals[at] = point.normal_impulse * step.substeps as f32;
            }
            (constraint.tangent_impulse, constraint.depth.across_impulse) = (tangent_impulse, 0.0);
            (constraint.depth.totals[2], constraint.depth.totals[3]) =
                (tangent_impulse * step.substeps as f32, 0.0);
            self.constraints.set(state.kind, handle, &constraint);
        }
        self.pairs.recheck_constrained(at_b);
    }
}

/// Returns both ends of the edge that faces the plane, before and after the step. `ends`: vertices of that edge before the step.
/// The points are relative to the origin of the body before the step, in world axes, length units.
fn ends_before_and_after(pivoting: &PivotingPolygon<'_>, ends: [u32; 2], after: &PivotState) -> [Vector; 4] {
    let [first, second] = ends.map(|end| rotate(pivoting.rotation, pivoting.outline.vertices[end as usize]));
    let [third, fourth] = pivoting.facing_edge(after).map(|end| sum(after.delta_position, end));
    [first, second, third, fourth]
}
