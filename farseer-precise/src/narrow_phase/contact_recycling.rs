//! Narrow phase: contact recycling (E. Catto, "Contact recycling", 2026; Box2D 3.2, `physics_world.c`).
//!
//! A pair keeps its manifold while its relative pose has hardly changed since the manifold was computed. The measure of the
//! change is the relative translation plus r times the sine of the relative rotation, as in conservative advancement. Here r is
//! the largest distance of a surface from the origin of its body. The measure must stay below the recycling distance, less the
//! motion between two updates of a pair. Also, neither body may have rotated further than `RECYCLE_MAX_ANGLE_COS`. The normal
//! and the anchors then stay, and the separations follow exactly from the poses. Manifolds that follow every small motion make
//! tall stacks jitter.
//!
//! The distance (0.05 m) and the cosine (0.98) are Box2D's `B2_CONTACT_RECYCLE_DISTANCE` and `B2_CONTACT_RECYCLE_COS_ANGLE`.
//! Not in Box2D are tighter limits for contacts on a kinematic body, for rolling polygons, and for the error of the separation
//! that sliding adds after a rotation.
//!
//! A point of a new manifold inherits the impulse of the old point with the same feature id (warm start), else that of the
//! nearest old point. Inheritance by distance is not in Box2D.

use super::{NarrowPhase, ProxyPair};
use crate::broad_phase::pairs::{CachedManifold, CachedManifoldZ};
use crate::broad_phase::proxies::BodyType;
use crate::constraint_graph::ConstraintKind;
use crate::index::PairIndex;
use crate::math::plane::{
    Vector, cross, difference, dot, length, rotate, rotate_inverse, rotation, scaled, sum,
};
use crate::narrow_phase::manifold::Manifold;
use crate::parameters::narrow_phase::{
    ARM_LEAD_MAX_ANGLE, RECYCLE_KINEMATIC_MAX_ANGLE_COS, RECYCLE_MAX_ANGLE_COS, RECYCLE_MAX_SEPARATION_ERROR,
    ROLLING_MIN_ANGLE_PER_STEP, WARM_START_MAX_DISTANCE_RATIO,
};

impl NarrowPhase<'_> {
    /// Returns whether the manifold of a pair may be recycled. The contact point of circles and spheres moves over their
    /// surface, so their manifolds are always computed. In three axes the shapes must still overlap along z if the normal has a
    /// component in the plane.
    pub(super) fn may_recycle(&self, pair: PairIndex, two: ProxyPair<'_>) -> bool {
        let Some(space) = self.depth else { return !self.are_both_circles(two) };
        let (kind, proxies) = (self.pairs.state(pair).kind, self.pairs.proxies_of(pair));
        // The contact axis of an upright shape may change between vertical and lateral.
        if proxies.iter().any(|&proxy| space.is_vertical(proxy)) {
            return false;
        }
        let is_in_plane = self.pairs.manifold(pair).depth.normal_z.abs() < 1.0;
        kind.has_two_points
            && (!is_in_plane || space.overlap_along_z(proxies, space.relative_z(two.a, two.b)))
    }

    /// Recycles the manifold of a pair: computes the separations in the present poses and stores them in the contact
    /// constraint. Returns false, without a change, if the bodies have moved too far or the pair has no constraint.
    pub(super) fn recycle_contact(&mut self, pair: PairIndex, two: ProxyPair<'_>) -> bool {
        let cached = self.pairs.manifold(pair);
        let (qa, qb) = (rotation(two.pose_a), rotation(two.pose_b));
        let [ca, sa, cb, sb] = cached.rotations;
        let [rotation_a, rotation_b] = [rotate_inverse([ca, sa], qa), rotate_inverse([cb, sb], qb)];
        let [x, y, c, s] = two.relative_pose();
        let [x0, y0, c0, s0] = cached.relative_pose;
        let sine = cross([c0, s0], [c, s]).abs();
        let max_extent = if self.is_fixed(two.a) {
            two.b.shape.max_extent
        } else {
            two.a.shape.max_extent.max(two.b.shape.max_extent)
        };
        let moved = length([x - x0, y - y0]) + max_extent * sine;
        let is_kinematic = two.a.body_type == BodyType::Kinematic;
        let is_same = rotation_a[0]
            > if is_kinematic { RECYCLE_KINEMATIC_MAX_ANGLE_COS } else { RECYCLE_MAX_ANGLE_COS }
            && rotation_b[0] > RECYCLE_MAX_ANGLE_COS
            && !self.is_rolling_over(pair, two)
            && moved < self.parameters.recycling_distance - self.parameters.separation_refresh_distance
            && moved * rotation_a[1].abs().max(rotation_b[1].abs())
                < RECYCLE_MAX_SEPARATION_ERROR * self.parameters.length_unit;
        if !is_same {
            return false;
        }
        let separations = self.current_separations(cached, two);
        match self.pairs.state(pair).constraint {
            Some(handle) => {
                self.constraints.set_separations(self.pairs.state(pair).kind, handle, separations)
            }
            None => return false,
        }
        true
    }

    /// Returns the separations of the points of `cached` in the present poses, in length units, negative for penetration.
    /// Entries from `cached.count` on have no meaning.
    pub(super) fn current_separations(&self, cached: &CachedManifold, two: ProxyPair<'_>) -> [f32; 2] {
        let [ca, sa, cb, sb] = cached.rotations;
        let (rotation_a, rotation_b) =
            (rotate_inverse([ca, sa], rotation(two.pose_a)), rotate_inverse([cb, sb], rotation(two.pose_b)));
        let CachedManifoldZ { normal_z, z_offset: cached_z_offset, .. } = cached.depth;
        let separation_z =
            self.depth.map_or(0.0, |space| normal_z * (space.relative_z(two.a, two.b) - cached_z_offset));
        let mut separations = cached.separations;
        for (separation, &[ax, ay, bx, by]) in separations.iter_mut().zip(&cached.anchors) {
            let offset =
                sum(two.offset(), difference(rotate(rotation_b, [bx, by]), rotate(rotation_a, [ax, ay])));
            *separation += dot(offset, cached.normal) + separation_z;
        }
        separations
    }

    /// Returns the rotation of B in this step at its present angular velocity, in radians, signed. It is 0 unless A is static
    /// and both shapes are polygons or capsules.
    fn rotation_on_static(&self, pair: PairIndex, two: ProxyPair<'_>) -> f32 {
        let ConstraintKind { has_two_points, is_static, .. } = self.pairs.state(pair).kind;
        if has_two_points && is_static {
            // In a pair with a sensor both bodies may be static.
            self.bodies.states.at(two.b.body).map_or(0.0, |state| state.velocity[2] * self.dt)
        } else {
            0.0
        }
    }

    /// Returns `Some(true)` if B rolls fast over a static face, so that its contacts are updated in every substep;
    /// `Some(false)` if B rolls slowly. Returns `None` if B does not roll.
    pub(super) fn rolling_speed_class(&self, pair: PairIndex, two: ProxyPair<'_>) -> Option<bool> {
        let is_rolling = self.pairs.manifold(pair).arm_lead_angle != 0.0 && self.is_rolling_over(pair, two);
        is_rolling.then(|| self.rotation_on_static(pair, two).abs() > ROLLING_MIN_ANGLE_PER_STEP)
    }

    /// Returns whether B, on a static face, rotates by more than [`ROLLING_MIN_ANGLE_PER_STEP`] in this step, or has the energy
    /// to topple over the vertex on which it stands.
    fn is_rolling_over(&self, pair: PairIndex, two: ProxyPair<'_>) -> bool {
        let rotation = self.rotation_on_static(pair, two).abs();
        rotation > ROLLING_MIN_ANGLE_PER_STEP || (rotation > 0.0 && self.has_energy_to_topple(pair, two))
    }

    /// Returns whether the rotation of B about a contact point carries its centre of mass over that point, against gravity
    /// along the normal. The condition is w^2 (k^2 + r^2) > 2 g (r - y).
    ///
    /// The angular velocity of B is w, its radius of gyration k, the acceleration of gravity g. The distance of the point from
    /// the centre of mass of B is r, and the height of that centre above the point y. Capsules, and bodies with contacts on
    /// other bodies than static ones, count as unable to topple.
    fn has_energy_to_topple(&self, pair: PairIndex, two: ProxyPair<'_>) -> bool {
        let (body, cached) = (two.b.body, self.pairs.manifold(pair));
        let [mass, inertia] = self.bodies.inverse_mass_inertia[body];
        if !(self.palette.touches_only_static(body)
            && mass > 0.0
            && inertia > 0.0
            && two.b.shape.radius == 0.0)
        {
            return false;
        }
        let spin = self.bodies.states[body].velocity[2];
        let gravity = length(self.gravity_delta) / self.dt * self.bodies.gravity_scales[body].abs();
        let q = rotate_inverse([cached.rotations[2], cached.rotations[3]], rotation(two.pose_b));
        cached.anchors[..cached.point_count()].iter().any(|&[_, _, x, y]| {
            let (arm, height) = (length([x, y]), -dot(rotate(q, [x, y]), cached.normal));
            spin * spin * (mass / inertia + arm * arm) > 2.0 * gravity * (arm - height)
        })
    }

    /// Caches a manifold of a pair, with the poses `two` for which it was computed.
    pub(super) fn cache_manifold(&mut self, pair: PairIndex, two: ProxyPair<'_>, manifold: &Manifold) {
        let count =
            if self.pairs.state(pair).kind.has_two_points { manifold.count } else { manifold.count.min(1) };
        let offset = if self.are_both_circles(two) {
            // The offset of circles is along the normal, as at their time of impact, so that normal impulses exert no torque.
            let [ra, rb] = [two.a, two.b].map(|proxy| proxy.shape.radius);
            scaled(manifold.normal, ra + rb + manifold.separations[0])
        } else {
            two.offset()
        };
        let anchors = manifold.points.map(|point| {
            let [bx, by] = difference(point, offset);
            [point[0], point[1], bx, by]
        });
        let [qa, qb] = [rotation(two.pose_a), rotation(two.pose_b)];
        let arm_lead_angle =
            if manifold.is_reference_on_b { 0.0 } else { 0.5 * self.rotation_on_static(pair, two) };
        *self.pairs.manifold_mut(pair) = CachedManifold {
            rotations: [qa[0], qa[1], qb[0], qb[1]],
            relative_pose: two.relative_pose(),
            normal: manifold.normal,
            count: count as u32,
            anchors,
            separations: manifold.separations,
            features: manifold.features,
            arm_lead_angle: arm_lead_angle.clamp(-ARM_LEAD_MAX_ANGLE, ARM_LEAD_MAX_ANGLE),
            depth: CachedManifoldZ {
                normal_z: manifold.normal_z,
                z_offset: self.depth.map_or(0.0, |space| space.relative_z(two.a, two.b)),
                patch_radius: manifold.patch_radius,
                points_z: manifold.points_z,
            },
        };
    }

    /// Returns, for each new point of a manifold, the index of the old point of the pair whose impulses it inherits (warm
    /// start). This is the old point with the same feature id, else the nearest old point that no other new point inherits
    /// from. `None`: no old point is near enough.
    pub(super) fn match_points(
        &self,
        pair: PairIndex,
        two: ProxyPair<'_>,
        manifold: &Manifold,
    ) -> [Option<usize>; 2] {
        if !self.pairs.state(pair).kind.has_two_points {
            return [Some(0), None];
        }
        let old = self.pairs.manifold(pair);
        let old_count = old.point_count();
        let mut matched = [None; 2];
        let mut is_taken = [false; 2];
        for (matched, feature) in matched.iter_mut().zip(manifold.features).take(manifold.count) {
            *matched = (0..old_count).find(|&o| !is_taken[o] && old.features[o] == feature);
            matched.iter().for_each(|&o| is_taken[o] = true);
        }
        let size = if self.is_fixed(two.a) {
            two.b.shape.max_extent
        } else {
            two.a.shape.max_extent.min(two.b.shape.max_extent)
        };
        let unmatched = matched
            .iter_mut()
            .zip(manifold.points)
            .take(manifold.count)
            .filter(|(matched, _)| matched.is_none());
        for (matched, point) in unmatched {
            let mut nearest = (WARM_START_MAX_DISTANCE_RATIO * size) * (WARM_START_MAX_DISTANCE_RATIO * size);
            for o in (0..old_count).filter(|&o| !is_taken[o]) {
                let distance = self.squared_anchor_distance(old, o, two, point);
                if distance < nearest {
                    (nearest, *matched) = (distance, Some(o));
                }
            }
            matched.iter().for_each(|&o| is_taken[o] = true);
        }
        matched
    }

    /// Returns the squared distance of an old anchor from the new contact point `new`, in length units^2. `new` is relative to
    /// the origin of A's body, in world axes. The result is the smaller of the distances in the frames of both bodies.
    fn squared_anchor_distance(
        &self,
        old: &CachedManifold,
        point: usize,
        two: ProxyPair<'_>,
        new: Vector,
    ) -> f32 {
        let [ax, ay, bx, by] = old.anchors[point];
        let [ca, sa, cb, sb] = old.rotations;
        let new_b = difference(new, two.offset());
        let on_a = difference(rotate_inverse([ca, sa], [ax, ay]), rotate_inverse(rotation(two.pose_a), new));
        let on_b =
            difference(rotate_inverse([cb, sb], [bx, by]), rotate_inverse(rotation(two.pose_b), new_b));
        let (a, b) = (dot(on_a, on_a), dot(on_b, on_b));
        if a < b { a } else { b }
    }
}
