//! Narrow phase: contacts of two circles. The solver computes them in every substep while they touch.

use super::{NarrowPhase, ProxyPair};
use crate::broad_phase::proxies::Proxy;
use crate::constraint_graph::{ColorSet, ContactConstraint, ContactConstraintSimd, SimdSlot};
use crate::index::{BodyIndex, DenseIndex, PairIndex};
use crate::math::lanes::{gather, select};
use crate::math::plane::{difference, scaled, sum};
use crate::narrow_phase::manifold::{Manifold, circles_at_toi};
use wide::f32x4;

const ZERO: f32x4 = f32x4::ZERO;

impl NarrowPhase<'_> {
    /// Computes normals and separations of all touching circles for the present poses. Pairs that are separated by more than
    /// the speculative distance get a full update. Returns their number.
    #[inline]
    pub(crate) fn update_circles(&mut self) -> usize {
        let mut separated = std::mem::take(self.dirty_pairs);
        let speculative_distance = self.parameters.speculative_distance;
        let (poses, circles) = (&self.bodies.poses, &self.bodies.circles);
        let one_point = &mut self.constraints.one_point;
        update_circle_contacts(one_point, poses, circles, speculative_distance, |pair| separated.push(pair));
        self.constraints.update_direct_constraints(|lane| {
            let is_separated = update_circle_contact(lane, poses, circles, speculative_distance);
            separated.extend((is_separated == Some(true)).then_some(lane.pair));
            is_separated.is_some()
        });
        separated.sort_unstable();
        let count = separated.len();
        separated.drain(..).for_each(|pair| self.update_contact(pair));
        *self.dirty_pairs = separated;
        count
    }

    /// Returns the contact of two circles at their time of impact if they approach each other, else `manifold`. The impulse
    /// then acts along the line of centres at that time, which differs from the lines at either end of the step.
    pub(super) fn circle_contact_at_toi(&self, two: ProxyPair<'_>, manifold: Manifold) -> Manifold {
        let displacement = |proxy: &Proxy| {
            let (body, gravity_scale) = (proxy.body, self.bodies.gravity_scales[proxy.body]);
            let gravity_displacement = scaled(self.gravity_delta, 0.5 * gravity_scale * self.dt);
            self.bodies.states.at(body).map_or([0.0; 2], |state| {
                sum(gravity_displacement, scaled([state.velocity[0], state.velocity[1]], self.dt))
            })
        };
        let displacement = difference(displacement(two.b), displacement(two.a));
        let radii = [two.a.shape.radius, two.b.shape.radius];
        circles_at_toi(two.offset(), displacement, radii).unwrap_or(manifold)
    }

    /// Returns whether both bodies of two proxies are single circles about their origins, in 2D.
    #[inline(always)]
    pub(super) fn are_both_circles(&self, two: ProxyPair<'_>) -> bool {
        if self.depth.is_some() {
            return false;
        }
        let is_circle = |proxy: &Proxy| self.bodies.circles.at(proxy.body).is_some_and(|row| row[3] > 0.0);
        is_circle(two.a) && is_circle(two.b)
    }

    /// Returns whether both bodies of a pair are single circles about their origins, in 2D.
    pub fn is_circle_pair(&self, pair: PairIndex) -> bool {
        self.are_both_circles(self.proxy_pair(pair))
    }
}

/// Updates normals, separations and friction arms of all contacts between two circles. Calls `on_separation` with the index of
/// each pair whose separation exceeds `reach`, the speculative distance in length units.
#[inline(always)]
fn update_circle_contacts(
    constraints: &mut ColorSet<ContactConstraintSimd<1>>,
    poses: &[[f32; 4]],
    circles: &[[f32; 4]],
    reach: f32,
    mut on_separation: impl FnMut(PairIndex),
) {
    constraints.for_each(|constraint| {
        let separated = update_circle_lanes(constraint, poses, circles, reach);
        for lane in
            (0..4).filter(|lane| separated >> lane & 1 == 1 && constraint.b[*lane] != BodyIndex::PLACEHOLDER)
        {
            on_separation(constraint.pair[lane]);
        }
    });
}

/// Runs [`update_circle_contacts`] for one constraint in the direct solver. Returns whether the separation exceeds `reach`
/// (length units); `None` if one of the bodies is no circle.
fn update_circle_contact(
    lane: &mut ContactConstraint,
    poses: &[[f32; 4]],
    circles: &[[f32; 4]],
    reach: f32,
) -> Option<bool> {
    let is_round = |body: BodyIndex| circles.get(body.position()).is_some_and(|circle| circle[3] > 0.0);
    if !(is_round(lane.a) && is_round(lane.b)) {
        return None;
    }
    let mut constraint = ContactConstraintSimd::<1>::default();
    constraint.insert(0, lane);
    let separated = update_circle_lanes(&mut constraint, poses, circles, reach);
    *lane = constraint.extract(0);
    Some(separated & 1 == 1)
}

/// Updates normals, separations and friction arms of the contacts between two circles in a block. Returns the mask of the lanes
/// whose separation exceeds `reach`, in length units.
#[inline(always)]
fn update_circle_lanes(
    constraint: &mut ContactConstraintSimd<1>,
    poses: &[[f32; 4]],
    circles: &[[f32; 4]],
    reach: f32,
) -> u32 {
    let [_, _, radius_a, is_round_a] = gather(circles, &constraint.a);
    let [_, _, radius_b, is_round_b] = gather(circles, &constraint.b);
    let are_round = (is_round_a * is_round_b).simd_gt(ZERO);
    if are_round.to_bitmask() == 0 {
        return 0;
    }
    let [ax, ay, _, _] = gather(poses, &constraint.a);
    let [bx, by, _, _] = gather(poses, &constraint.b);
    let (dx, dy) = (bx - ax, by - ay);
    let squared = dx * dx + dy * dy;
    let is_far = squared.simd_gt(f32x4::splat(f32::MIN_POSITIVE));
    let distance = squared.sqrt();
    let inverse = f32x4::splat(1.0) / select(is_far, distance, f32x4::splat(1.0));
    let separation = distance - radius_a - radius_b;
    let half = f32x4::splat(0.5) * separation;
    constraint.normal_x = select(are_round, dx * inverse, constraint.normal_x);
    constraint.normal_y =
        select(are_round, select(is_far, dy * inverse, f32x4::splat(1.0)), constraint.normal_y);
    constraint.points[0].separation = select(are_round, separation, constraint.points[0].separation);
    constraint.tangent_arm_a = select(are_round, ZERO - (radius_a + half), constraint.tangent_arm_a);
    constraint.tangent_arm_b = select(are_round, radius_b + half, constraint.tangent_arm_b);
    (separation.simd_gt(f32x4::splat(reach)) & are_round).to_bitmask()
}
