//! Narrow phase: contacts of fast kinematic bodies with bodies that they will hit within the step.
//!
//! A kinematic body that moves by more than the speculative distance could penetrate or pass another body before the narrow
//! phase finds a contact. So the time of impact (TOI) of the pair is computed from the velocities at the beginning of the step.
//! The contact has the normal and the lever arms of that time. Its separation is the distance by which the bodies approach each
//! other until the time of impact, so the solver stops them there.
//!
//! Speculative contacts of the initial poses (E. Catto, "Continuous Collision", GDC 2013) would have the normal of a moment
//! without touch, and would stop bodies that only pass by.

use super::stage::{NarrowPhase, ProxyPair};
use crate::broad_phase::fat_aabbs::is_fast_kinematic;
use crate::broad_phase::hash_grid::{PackedAabb, overlap};
use crate::broad_phase::proxies::{BodyType, Proxy};
use crate::continuous_collision::time_of_impact::{
    SweptPair as Flyers, SweptShape, conservative_advancement,
};
use crate::depth::posed_solid::{ContactMargins, PreviousAxis};
use crate::index::{PairIndex, ProxyIndex};
use crate::math::plane::{Pose, dot, scaled};
use crate::narrow_phase::manifold::Manifold;
use crate::narrow_phase::shape_dispatch::collide;
use crate::parameters::narrow_phase::TOI_TOLERANCE_RATIO;

/// Distances by which the bodies A and B of a pair approach each other between the start of the step and their time of impact.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct ApproachDistances {
    /// Distance by which A and B approach along the contact normal until the time of impact, at each contact point. Unit:
    /// length units; positive if the bodies come closer.
    pub(super) points: [f32; 2],
    /// Change of (z of B minus z of A) until the time of impact, in length units.
    pub(super) z: f32,
}

/// Contact of a pair at its time of impact: poses and manifold at that time, and the distances by which A and B approach until
/// then.
struct SweptContact<'a> {
    poses: ProxyPair<'a>,
    manifold: Manifold,
    approach: ApproachDistances,
}

impl<'a> NarrowPhase<'a> {
    /// Adds contacts of fast kinematic bodies with the dynamic bodies that they will hit in this step.
    #[inline]
    pub(crate) fn find_contacts_ahead_of_kinematic(&mut self) {
        if !self.bodies.kinematic.is_empty() {
            self.find_contacts_ahead_of_any();
        }
    }

    /// Adds contacts of fast kinematic bodies: see
    /// [`find_contacts_ahead_of_kinematic`](Self::find_contacts_ahead_of_kinematic).
    fn find_contacts_ahead_of_any(&mut self) {
        let mut ahead = std::mem::take(self.dirty_pairs);
        let NarrowPhase { bodies, proxies, parameters, dt, .. } = *self;
        for proxy in bodies.kinematic.iter().flat_map(|&number| proxies.proxies_of(number)) {
            if is_fast_kinematic(proxies.proxy(proxy), bodies, parameters, dt) {
                self.list_pairs_ahead_of(proxy, &mut ahead);
            }
        }
        // In the order of pair indices, which snapshots preserve: the order of contact constraints depends on it.
        ahead.sort_unstable();
        ahead.drain(..).for_each(|pair| self.add_swept_contact(pair));
        *self.dirty_pairs = ahead;
    }

    /// Appends to `ahead` the pairs of a kinematic proxy A with dynamic proxies that A may hit within the step. Pairs that have a
    /// contact already are left out, and in the plane those whose swept AABBs do not overlap. The swept AABBs exceed the shapes by
    /// the speculative distance, so that rounding excludes no impact.
    fn list_pairs_ahead_of(&self, proxy: ProxyIndex, ahead: &mut Vec<PairIndex>) {
        let is_candidate = |pair: PairIndex, partner: ProxyIndex| {
            self.proxies.body_type_of(partner) == BodyType::Dynamic
                && self.pairs.state(pair).has_response()
                && self.pairs.manifold(pair).count == 0
        };
        let pairs = self.pairs.pairs_and_partners(proxy);
        if self.depth.is_some() {
            return ahead
                .extend(pairs.filter(|&(pair, partner)| is_candidate(pair, partner)).map(|(pair, _)| pair));
        }
        let swept = self.predicted_sweep(proxy);
        let may_meet = |partner: ProxyIndex| overlap(&swept, &self.predicted_sweep(partner));
        ahead.extend(
            pairs
                .filter(|&(pair, partner)| is_candidate(pair, partner) && may_meet(partner))
                .map(|(pair, _)| pair),
        );
    }

    /// Returns the swept AABB of a proxy for the predicted displacement of its body in this step: length units, world axes.
    fn predicted_sweep(&self, proxy: ProxyIndex) -> PackedAabb {
        let displacement = self.predicted_displacement(self.proxies.proxy(proxy));
        self.proxies.swept_aabb(proxy, displacement, self.bodies, self.parameters)
    }

    /// Adds the contact of a kinematic body A with a dynamic body B that A will hit within the step.
    fn add_swept_contact(&mut self, pair: PairIndex) {
        let two = self.proxy_pair(pair);
        // Most pairs end here, so the search among the pairs of B follows.
        let Some(SweptContact { poses: then, mut manifold, approach }) = self.find_swept_contact(pair, two)
        else {
            return;
        };
        if self.is_carried_equally(pair, two) {
            return;
        }
        manifold.keep_deepest(self.max_contacts);
        if manifold.count == 0 || (self.proxies.one_way_count > 0 && self.is_passable(pair, two, &manifold)) {
            return;
        }
        self.stats.computed += 1;
        self.pairs.set_motion_at_check(pair, self.total_travel(self.pairs.trigger(pair)));
        self.store_manifold(pair, then, &manifold, approach);
        self.update_touch_state(pair, then);
    }

    /// Returns whether B already touches another kinematic body that moves like A. B then slides or rolls on both as on static
    /// bodies, and the narrow phase itself distinguishes a seam from a wall.
    fn is_carried_equally(&self, pair: PairIndex, two: ProxyPair<'_>) -> bool {
        let [_, at_b] = self.pairs.proxies_of(pair);
        self.pairs.pairs_of(at_b).any(|other| {
            let carrier = self.pairs.proxies_of(other)[0];
            other != pair
                && self.proxies.body_type_of(carrier) == BodyType::Kinematic
                && self.pairs.manifold(other).count > 0
                && self.move_together(two.a, self.proxies.proxy(carrier))
        })
    }

    /// Returns whether two kinematic bodies move relative to each other in this step by at most `separation_refresh_distance`,
    /// the distance after which contacts are updated.
    fn move_together(&self, one: &Proxy, other: &Proxy) -> bool {
        let [a, b] = [one, other].map(|proxy| self.bodies.states[proxy.body].velocity);
        let [x, y, spin, z] = std::array::from_fn(|axis| (b[axis] - a[axis]).abs() * self.dt);
        let rotation = spin * (one.shape.max_extent + other.shape.max_extent);
        one.body == other.body || x + y + z + rotation <= self.parameters.separation_refresh_distance
    }

    /// Returns the predicted displacement of a proxy's body in this step: x and y in length units, angle in radians, z in
    /// length units. Gravity accelerates a falling body during the step, so half of its velocity change counts.
    fn predicted_displacement(&self, proxy: &Proxy) -> [f32; 4] {
        let body = proxy.body;
        let [x, y, spin, z] = self.bodies.states[body].velocity.map(|velocity| velocity * self.dt);
        let [fall_x, fall_y] = scaled(self.gravity_delta, 0.5 * self.bodies.gravity_scales[body] * self.dt);
        let falls = proxy.body_type == BodyType::Dynamic && !self.sleep.is_asleep(body);
        if falls { [x + fall_x, y + fall_y, spin, z] } else { [x, y, spin, z] }
    }

    /// Returns the contact of a pair at its time of impact; `None` if the shapes do not collide within the step.
    fn find_swept_contact(&self, pair: PairIndex, two: ProxyPair<'a>) -> Option<SweptContact<'a>> {
        let displacements = [two.a, two.b].map(|proxy| self.predicted_displacement(proxy));
        let [a, b] = [(two.a, two.pose_a, displacements[0]), (two.b, two.pose_b, displacements[1])].map(
            |(proxy, pose, displacement)| SweptShape {
                shape: self.proxies.vertices.shape_ref(proxy.shape),
                pose,
                displacement,
            },
        );
        let swept_pair = Flyers { a, b };
        let tolerance = TOI_TOLERANCE_RATIO * self.parameters.speculative_distance;
        let time = match self.depth {
            None if swept_pair.is_behind_edge() => None,
            None => conservative_advancement(0.0, tolerance, |fraction| {
                swept_pair.separation_and_closing_speed(fraction)
            }),
            Some(space) => conservative_advancement(0.0, tolerance, |fraction| {
                space.distance_and_closing_speed(
                    self.pairs.proxies_of(pair),
                    self.proxies,
                    self.bodies,
                    displacements,
                    fraction,
                )
            }),
        }?;
        let two = ProxyPair { pose_a: swept_pair.a.pose_at(time), pose_b: swept_pair.b.pose_at(time), ..two };
        let manifold = self.manifold_at_toi(pair, two, displacements, time);
        let approach = approach_distances(two, &manifold, displacements, time);
        manifold.has_finite_contact().then_some(SweptContact { poses: two, manifold, approach })
    }

    /// Returns the manifold of a pair at its time of impact, `time`, a fraction of the step. `two` has the poses at that time.
    /// `displacements` are those of A and B in the step: x, y (length units), angle (radians), z (length units).
    fn manifold_at_toi(
        &self,
        pair: PairIndex,
        two: ProxyPair<'a>,
        displacements: [[f32; 4]; 2],
        time: f32,
    ) -> Manifold {
        let margin = self.parameters.speculative_distance;
        let [a, b] = [two.a, two.b].map(|proxy| self.proxies.vertices.shape_ref(proxy.shape));
        let Some(space) = self.depth else { return collide(a, b, two.pose_a, two.pose_b, margin) };
        let [at_a, at_b] = self.pairs.proxies_of(pair);
        let solid = |at: ProxyIndex, proxy: &'a Proxy, pose: Pose, displacement: [f32; 4]| {
            let shape = self.proxies.vertices.shape_ref(proxy.shape);
            let mut solid = space.posed_solid(at, proxy, shape, (self.bodies, self.dt));
            solid.advance(pose, displacement, time);
            solid
        };
        let previous_penetration = self.previous_penetration(pair, two);
        let limits = ContactMargins::new([margin, margin], self.is_fixed(two.a), previous_penetration);
        let a = solid(at_a, two.a, two.pose_a, displacements[0]);
        let b = solid(at_b, two.b, two.pose_b, displacements[1]);
        space.collide(a, b, PreviousAxis::NoContact, limits)
    }
}

/// Returns the distances by which the bodies approach each other until the time of impact, `time`, a fraction of the step. The
/// arrays are the displacements of A and B in the step: x, y (length units), angle (radians), z (length units). The velocity of
/// each contact point is taken in the poses of the impact.
fn approach_distances(
    two: ProxyPair<'_>,
    manifold: &Manifold,
    [a, b]: [[f32; 4]; 2],
    time: f32,
) -> ApproachDistances {
    let velocity = |[x, y, angle, _]: [f32; 4], [rx, ry]: [f32; 2]| [x - angle * ry, y + angle * rx];
    let offset = two.offset();
    let displacement_z = b[3] - a[3];
    let points = manifold.points.map(|point @ [x, y]| {
        let (of_a, of_b) = (velocity(a, point), velocity(b, [x - offset[0], y - offset[1]]));
        let along = dot([of_b[0] - of_a[0], of_b[1] - of_a[1]], manifold.normal);
        -time * (along + displacement_z * manifold.normal_z)
    });
    ApproachDistances { points, z: time * displacement_z }
}
