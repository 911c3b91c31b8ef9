//! Narrow phase: builds the contact constraint of a pair from its cached manifold, in the plane and in three axes.
//!
//! A constraint has one normal row for each contact point, with the effective mass and the lever arms, and friction rows at the
//! mean of the points. It also stores the combined friction and restitution coefficients, and the surface velocity of conveyor
//! belts.

use super::stage::{NarrowPhase, ProxyPair};
use crate::broad_phase::pairs::{CachedManifold, CachedManifoldZ};
use crate::broad_phase::proxies::{BodyType, Proxy};
use crate::constraint_graph::{ContactConstraint, ContactConstraintZ, ContactPoint, tangents};
use crate::depth::interface::HingeFeature;
use crate::depth::state::DepthState;
use crate::index::{BodyIndex, PairIndex};
use crate::math::plane::{Vector, cross, difference, dot, rotate, scaled, sum};
use crate::narrow_phase::combined_surface::{friction_of, restitution_of};

impl NarrowPhase<'_> {
    /// Returns the contact constraint of a pair, built from its cached manifold. All impulses of the constraint are 0.
    pub(super) fn build_constraint(&self, pair: PairIndex, two: ProxyPair<'_>) -> ContactConstraint {
        let cached = self.pairs.manifold(pair);
        let is_fixed = self.is_fixed(two.a);
        let [[mass_a, inertia_a], [mass_b, inertia_b]] =
            [two.a, two.b].map(|proxy| self.bodies.inverse_mass_inertia[proxy.body]);
        let normal = cached.normal;
        let effective_mass = |arm_a: f32, arm_b: f32| {
            let inverse = mass_a + mass_b + inertia_a * arm_a * arm_a + inertia_b * arm_b * arm_b;
            if inverse > 0.0 { 1.0 / inverse } else { 0.0 }
        };
        let (points, tangent_arms) =
            planar_points(cached, two.b.shape.radius, self.parameters.length_unit, effective_mass);
        let constraint = ContactConstraint {
            a: if is_fixed { BodyIndex::PLACEHOLDER } else { two.a.body },
            b: two.b.body,
            pair,
            normal,
            inverse_masses: [mass_a, mass_b],
            inverse_inertias: [inertia_a, inertia_b],
            friction: friction_of(self.friction, two.a, two.b),
            tangent_arms,
            tangent_mass: effective_mass(tangent_arms[0], tangent_arms[1]),
            tangent_impulse: 0.0,
            tangent_speed: tangent_surface_speed(two, normal, cached.anchors[0]).clamp(f32::MIN, f32::MAX),
            restitution: restitution_of(two.a, two.b),
            points,
            depth: ContactConstraintZ::default(),
        };
        match &self.depth {
            None => constraint,
            Some(space) => self.build_constraint_3d(space, pair, two, constraint),
        }
    }

    /// Returns a contact constraint with the data of the depth axis added: lever arms of both friction directions, rolling
    /// radii, patch radius for friction about the normal, and surface velocity along z.
    fn build_constraint_3d(
        &self,
        space: &DepthState,
        pair: PairIndex,
        two: ProxyPair<'_>,
        constraint: ContactConstraint,
    ) -> ContactConstraint {
        let CachedManifold {
            normal: [x, y],
            anchors,
            depth: CachedManifoldZ { normal_z, patch_radius, points_z, .. },
            ..
        } = *self.pairs.manifold(pair);
        let (tangent, [ux, uy, uz]) = tangents([x, y, normal_z]);
        let points = self.pairs.manifold(pair).point_anchors();
        let (mut points_3d, mut tangent_arms, mut across_arms) =
            (constraint.points, mean_arms(points, tangent), mean_arms(points, [ux, uy]));
        if self.rotates_about_y(two.a) {
            let count = points.len();
            let arm = |at: usize, axis: [f32; 3]| arm_about_y(anchors[at][0], points_z[at], axis);
            let mean = |axis| (0..count).map(|at| arm(at, axis)).sum::<f32>() / count as f32;
            for (at, point) in points_3d.iter_mut().enumerate().take(count) {
                point.normal_arm_a = arm(at, [x, y, normal_z]);
                if HingeFeature::ENABLED && two.a.body_type == BodyType::Hinged {
                    point.normal_mass = constraint.effective_mass(point);
                }
            }
            tangent_arms[0] = mean([tangent[0], tangent[1], 0.0]);
            across_arms[0] = mean([ux, uy, uz]);
        }
        let proxies = self.pairs.proxies_of(pair);
        let [friction, restitution] = space.combined_surface(proxies, [two.a, two.b], self.friction);
        let belt_speed = |axis: Vector| belt_speed(two.a, axis, anchors[0]);
        let across_speed = belt_speed([-uy, ux]) + uz * two.a.surface_velocity[3];
        ContactConstraint {
            friction,
            restitution,
            tangent_arms,
            points: points_3d,
            tangent_speed: belt_speed([-tangent[1], tangent[0]]).clamp(f32::MIN, f32::MAX),
            depth: ContactConstraintZ {
                normal_z,
                across_arms,
                radii: [space.rolling_radius(proxies[0], two.a), space.rolling_radius(proxies[1], two.b)],
                across_speed: across_speed.clamp(f32::MIN, f32::MAX),
                spread: patch_radius,
                ..ContactConstraintZ::default()
            },
            ..constraint
        }
    }

    /// Returns the surface parameters of a pair before handlers of the game change them: friction coefficient and restitution
    /// coefficient (dimensionless), and tangent speed of the belt (length units/s).
    pub(crate) fn surface_parameters(&self, pair: PairIndex) -> [f32; 3] {
        let ContactConstraint { friction, restitution, tangent_speed, .. } =
            self.build_constraint(pair, self.proxy_pair(pair));
        [friction, restitution, tangent_speed]
    }

    /// Restores friction, restitution and tangent speed of a pair's contact constraint after a handler of the game has changed
    /// them.
    pub(crate) fn reset_surface_parameters(&mut self, pair: PairIndex) {
        let state = *self.pairs.state(pair);
        let Some(handle) = state.constraint else { return };
        let [friction, restitution, tangent_speed] = self.surface_parameters(pair);
        let constraint = ContactConstraint {
            friction,
            restitution,
            tangent_speed,
            ..self.constraints.get(state.kind, handle)
        };
        self.constraints.set(state.kind, handle, &constraint);
    }
}

/// Returns the points of a contact constraint in the plane, without impulses, and the lever arms of friction of A and B (length
/// units), the means over the points. `radius`: rounding of B, length units. `effective_mass` returns the effective mass (mass
/// units) for lever arms of A and B (length units). Points that the manifold does not have get the separation `far`.
fn planar_points(
    cached: &CachedManifold,
    radius: f32,
    far: f32,
    effective_mass: impl Fn(f32, f32) -> f32,
) -> ([ContactPoint; 2], [f32; 2]) {
    let normal = cached.normal;
    let mut points = [ContactPoint { separation: far, ..ContactPoint::default() }; 2];
    let (mut tangent_a, mut tangent_b) = (0.0, 0.0);
    let lead_rotation = [1.0 - 0.5 * cached.arm_lead_angle * cached.arm_lead_angle, cached.arm_lead_angle];
    for (at, (point, &[ax, ay, bx, by])) in points.iter_mut().zip(cached.point_anchors()).enumerate() {
        // The contact point of a rounded vertex keeps its direction from the vertex while the body rotates.
        let round_offset = scaled(normal, radius);
        let [bx, by] = difference(rotate(lead_rotation, sum([bx, by], round_offset)), round_offset);
        let (arm_a, arm_b) = (cross([ax, ay], normal), cross([bx, by], normal));
        tangent_a -= dot([ax, ay], normal);
        tangent_b -= dot([bx, by], normal);
        *point = ContactPoint {
            normal_arm_a: arm_a,
            normal_arm_b: arm_b,
            normal_mass: effective_mass(arm_a, arm_b),
            separation: cached.separations[at],
            ..ContactPoint::default()
        };
    }
    let inverse_count = 1.0 / cached.count as f32;
    (points, [tangent_a * inverse_count, tangent_b * inverse_count])
}

/// Returns the lever arms of A and B, means over the `anchors` of a manifold, for an impulse along an axis in the plane: length
/// units.
fn mean_arms(anchors: &[[f32; 4]], along: Vector) -> [f32; 2] {
    let sum = anchors.iter().fold([0.0; 2], |[of_a, of_b], &[ax, ay, bx, by]| {
        [of_a + cross([ax, ay], along), of_b + cross([bx, by], along)]
    });
    sum.map(|arm| arm / anchors.len() as f32)
}

/// Returns the lever arm about the upright axis for an impulse along `axis`, at a point with these components relative to the
/// body's origin: length units. A unit angular velocity gives a point at r the velocity (-r.z, 0, r.x).
fn arm_about_y(point_x: f32, point_z: f32, [x, _, z]: [f32; 3]) -> f32 {
    point_x * z - point_z * x
}

/// Warm start of friction: stores the accumulated friction impulses of the old contact constraint in the new one. The old
/// impulse, a vector, is projected onto the tangents of the new constraint.
pub(super) fn transfer_friction_impulse(constraint: &mut ContactConstraint, old: &ContactConstraint) {
    constraint.tangent_impulse = old.tangent_impulse;
    (constraint.depth.twist_impulse, constraint.depth.totals) = (old.depth.twist_impulse, old.depth.totals);
    let (along, across) = (old.tangent_impulse, old.depth.across_impulse);
    let is_same = constraint.depth.normal_z == old.depth.normal_z && constraint.normal == old.normal;
    if across == 0.0 && (is_same || constraint.depth.normal_z == 0.0) {
        return;
    }
    let of = |constraint: &ContactConstraint| {
        tangents([constraint.normal[0], constraint.normal[1], constraint.depth.normal_z])
    };
    let (([tx, ty], [ux, uy, uz]), (tangent, second)) = (of(old), of(constraint));
    let [x, y, z] = [along * tx + across * ux, along * ty + across * uy, across * uz];
    constraint.tangent_impulse = dot([x, y], tangent);
    constraint.depth.across_impulse = dot([x, y], [second[0], second[1]]) + z * second[2];
}

/// Returns the speed of the surface of A less that of B, along the tangent (normal y, -normal x), in length units/s. The speed is
/// that at the point [ax, ay, ..], relative to the origin of A's body. Friction drives the tangential velocity of B relative to A
/// to this speed.
///
/// Surfaces run clockwise on the screen: that of A, which has the outward normal n, along (-n.y, n.x), and that of B against it.
fn tangent_surface_speed(two: ProxyPair<'_>, normal: Vector, anchors: [f32; 4]) -> f32 {
    belt_speed(two.a, normal, anchors) - (two.a.surface.speed + two.b.surface.speed)
}

/// Returns the speed along the tangent (normal y, -normal x), in length units/s, of a static body A that is a conveyor belt. The
/// speed is that at the point [ax, ay, ..], given relative to the origin of A's body.
fn belt_speed(a: &Proxy, normal: Vector, [ax, ay, ..]: [f32; 4]) -> f32 {
    let [x, y, spin, _] = a.surface_velocity;
    let at = [x - spin * ay, y + spin * ax];
    dot(at, [normal[1], -normal[0]])
}
