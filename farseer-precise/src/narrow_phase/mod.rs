//! Narrow phase: computes the contacts of pairs and hands them to the solver as contact constraints.
//!
//! A pair is updated only after its bodies have moved far enough to change something ([`RecheckTrigger`]). The update of a
//! pair:
//!
//! 1. contact recycling keeps the manifold while the relative pose has changed little ([`contact_recycling`]);
//! 2. else the manifold is computed ([`manifold`]), or in three axes by [`depth`](super::depth);
//! 3. filters remove ghost collisions ([`ghost_filter`], [`flush_geoms`], [`rim_ghost_filter`]) and contacts with one-way
//!    geoms ([`one_way`]);
//! 4. the manifold becomes a contact constraint ([`build_constraint`]), which is added, changed or removed
//!    ([`constraint_lifetime`]);
//! 5. begin and end of touch are listed for the adapter ([`touch_state`]).

pub mod box_prefilter;
pub mod build_constraint;
pub mod capsule;
pub mod circle_contacts;
pub mod combined_surface;
pub mod constraint_lifetime;
pub mod contact_reader;
pub mod contact_recycling;
pub mod flush_geoms;
pub mod ghost_filter;
pub mod handler_changes;
pub mod hits;
pub mod kinematic_sweep;
pub mod manifold;
pub mod one_way;
pub mod pair_lifetime;
pub mod residual_penetration;
pub mod rim_ghost_filter;
pub mod rolling_contacts;
mod rounded_polygon;
pub mod shape_dispatch;
pub mod shape_pair;
pub mod stage;
pub mod static_sensor_pairs;
pub mod touch_event;
pub mod touch_state;

use super::constraint_graph::ContactConstraint;
use super::depth::posed_solid::{ContactMargins, PreviousAxis};
use super::depth::sphere_sphere::collide_spheres;
use crate::broad_phase::pairs::{CachedManifold, CachedManifoldZ, RecheckTrigger, UPDATED_BY_SOLVER};
use crate::broad_phase::proxies::{BodyType, Proxy};
use crate::contact_solver::rolling::RollingContact;
use crate::index::{PairIndex, ProxyIndex};
use crate::math::plane::length;
use crate::math::scalar::nearest_finite;
use crate::narrow_phase::flush_geoms::FlushFilter;
use crate::narrow_phase::manifold::Manifold;
use crate::narrow_phase::shape_dispatch::collide;
use crate::parameters::broad_phase::SEPARATED_PAIR_MAX_SLACK;
use build_constraint::transfer_friction_impulse;
use kinematic_sweep::ApproachDistances;
pub(crate) use stage::ProxyPair;
pub use stage::{NarrowPhase, NarrowPhaseStats};
pub use touch_event::{TouchEvent, TouchKind, WantedEvent};

impl<'a> NarrowPhase<'a> {
    /// Returns the proxies of a pair with the present poses of their bodies.
    #[inline(always)]
    fn proxy_pair(&self, pair: PairIndex) -> ProxyPair<'a> {
        let [a, b] = self.pairs.proxies_of(pair).map(|proxy| self.proxies.proxy(proxy));
        let pose = |proxy: &Proxy| self.bodies.poses[proxy.body];
        ProxyPair { a, b, pose_a: pose(a), pose_b: pose(b) }
    }

    /// Returns the sum of the [`travel`](Proxies::travel) counters of both proxies of a pair: the path lengths of A and B, in
    /// 2^-26 length units, wrapping. [`RecheckTrigger::motion_at_check`] stores such a sum.
    #[inline(always)]
    pub(crate) fn total_travel(&self, trigger: &RecheckTrigger) -> u32 {
        let [a, b] = trigger.proxies.map(|proxy| self.proxies.travel_of(proxy));
        a.wrapping_add(b)
    }

    /// Updates the contacts of all awake pairs whose bodies have moved by more than the pair's tolerance. Returns the number of
    /// these pairs.
    pub(crate) fn update_contacts(&mut self) -> usize {
        let mut dirty = std::mem::take(self.dirty_pairs);
        let dirty_count = self.collect_dirty_pairs(&mut dirty);
        if self.depth.is_none() && self.proxies.one_way_count == 0 {
            self.reject_separated_boxes(&mut dirty);
        }
        dirty.drain(..).for_each(|pair| self.update_contact(pair));
        *self.dirty_pairs = dirty;
        dirty_count
    }

    /// Writes the indices of the awake pairs that need an update to `dirty`, and returns their number. The loop has no branch
    /// on the motion, since the processor cannot predict which pairs have moved.
    fn collect_dirty_pairs(&self, dirty: &mut Vec<PairIndex>) -> usize {
        let (awake, mut count) = (self.pairs.awake_count(), 0);
        dirty.resize(awake, PairIndex::default());
        for (pair, trigger) in self.pairs.awake_triggers() {
            let moved = self.total_travel(trigger).wrapping_sub(trigger.motion_at_check);
            dirty[count] = pair;
            count += usize::from(
                (moved >= trigger.motion_tolerance) & (trigger.motion_tolerance != UPDATED_BY_SOLVER),
            );
        }
        dirty.truncate(count);
        count
    }

    /// Updates the manifold, the contact constraint and the touch state of a pair.
    pub(crate) fn update_contact(&mut self, pair: PairIndex) {
        let two = self.proxy_pair(pair);
        // Without a constraint no manifold is recycled.
        let is_known = self.pairs.has_constraint(pair)
            && self.pairs.manifold(pair).count > 0
            && self.pairs.trigger(pair).motion_tolerance != UPDATED_BY_SOLVER;
        self.pairs.set_motion_at_check(pair, self.total_travel(self.pairs.trigger(pair)));
        if is_known && self.may_recycle(pair, two) && self.recycle_contact(pair, two) {
            self.stats.recycled += 1;
            self.update_touch_state(pair, two);
            return;
        }
        let margin = self.contact_margin(two);
        let mut manifold = self.collide(pair, two, margin);
        manifold.keep_deepest(self.max_contacts);
        let is_open = self.proxies.one_way_count > 0 && self.is_passable(pair, two, &manifold);
        if !manifold.has_finite_contact() {
            self.end_contact(pair, manifold.gap - margin);
        } else if is_open || self.is_passable_3d(pair, two) {
            self.end_contact(pair, 0.0);
        } else {
            self.stats.computed += 1;
            self.store_manifold(pair, two, &manifold, ApproachDistances::default());
            self.update_touch_state(pair, two);
        }
    }

    /// Returns the ghost filter between flush geoms, for the present poses.
    fn flush_filter(&self) -> FlushFilter<'_> {
        let NarrowPhase { bodies, proxies, pairs, parameters, dt, .. } = self;
        FlushFilter { bodies, proxies, pairs, parameters, dt: *dt, time: 0.0 }
    }

    /// Returns the contact constraint that the cached manifold of a pair gives. All impulses of the constraint are 0.
    pub(crate) fn current_constraint(&self, pair: PairIndex) -> ContactConstraint {
        self.build_constraint(pair, self.proxy_pair(pair))
    }

    /// Returns the separation below which a pair has contact points, in length units. It is the speculative distance. For
    /// moving world boxes in three axes it also includes the distance by which the box and the other body can approach in the
    /// step.
    fn contact_margin(&self, two: ProxyPair<'_>) -> f32 {
        let (Some(space), BodyType::Kinematic | BodyType::Hinged) = (self.depth, two.a.body_type) else {
            return self.parameters.speculative_distance;
        };
        let sweep_of_a = space.sweep_distance(two.a, self.bodies, self.parameters, self.dt);
        let displacement_of_b = || {
            let [x, y, _, z] = self.bodies.states[two.b.body].velocity;
            length([length([x, y]), z]) * self.dt
        };
        self.parameters.speculative_distance
            + if sweep_of_a > 0.0 { nearest_finite(sweep_of_a + displacement_of_b()) } else { 0.0 }
    }

    /// Computes the manifold of a pair in the plane or in three axes, without ghost collisions. `margin`: contact margin in
    /// length units.
    fn collide(&self, pair: PairIndex, two: ProxyPair<'_>, margin: f32) -> Manifold {
        let Some(space) = self.depth else { return self.collide_in_plane(pair, two, margin) };
        let shape_of = |proxy: &Proxy| self.proxies.vertices.shape_ref(proxy.shape);
        let [at_a, at_b] = self.pairs.proxies_of(pair);
        if let Some([a, b]) = space.dynamic_spheres([at_a, at_b], [two.a, two.b], (self.bodies, self.dt)) {
            return collide_spheres(a, b, self.pairs.manifold(pair).count == 0, margin);
        }
        let solid = |at: ProxyIndex, proxy: &'a Proxy| {
            space.posed_solid(at, proxy, shape_of(proxy), (self.bodies, self.dt))
        };
        let CachedManifold { count, features, depth: CachedManifoldZ { normal_z, .. }, .. } =
            *self.pairs.manifold(pair);
        let previous_axis = match normal_z {
            _ if count == 0 => PreviousAxis::NoContact,
            _ if space.had_vertical_axis([at_a, at_b], features[0]) => PreviousAxis::Vertical,
            1.0 | -1.0 => PreviousAxis::Depth(normal_z),
            _ => PreviousAxis::Plane,
        };
        let (a, b) = (solid(at_a, self.proxies.proxy(at_a)), solid(at_b, self.proxies.proxy(at_b)));
        let a = space.with_yaw_displacement(a, two.a, &b, (self.bodies, self.dt));
        let previous_penetration = self.previous_penetration(pair, two);
        let limits = ContactMargins::new(
            [margin, self.parameters.speculative_distance],
            self.is_fixed(two.a),
            previous_penetration,
        );
        let manifold = space.collide(a, b, previous_axis, limits);
        if self.is_hidden_rim(pair, two, [a, b], &manifold) { Manifold::separated(0.0) } else { manifold }
    }

    /// Computes the manifold of a pair in the plane, without ghost collisions. `margin`: contact margin in length units.
    #[inline(always)]
    fn collide_in_plane(&self, pair: PairIndex, two: ProxyPair<'_>, margin: f32) -> Manifold {
        let [shape_a, shape_b] = [two.a, two.b].map(|proxy| self.proxies.vertices.shape_ref(proxy.shape));
        let manifold = collide(shape_a, shape_b, two.pose_a, two.pose_b, margin);
        if two.a.body_type != BodyType::Dynamic && manifold.count > 0 && two.a.shape.vertex_count > 0 {
            return self.flush_filter().filter_manifold(pair, manifold, margin);
        }
        let is_new = manifold.count > 0 && !self.pairs.is_touching(pair);
        if is_new && self.are_both_circles(two) {
            self.circle_contact_at_toi(two, manifold)
        } else {
            manifold
        }
    }

    /// Removes the contact of a pair, and emits an end-touch event if the pair touched. The separation exceeds the contact
    /// margin by `extra_distance`, in length units.
    fn end_contact(&mut self, pair: PairIndex, extra_distance: f32) {
        self.record_separation(pair);
        self.remove_constraint(pair);
        if self.pairs.is_touching(pair) {
            self.emit_touch_event(pair, false);
        }
        self.clear_manifold(pair, extra_distance);
    }

    /// Clears the cached manifold of a pair without a constraint. The separation exceeds the contact margin by `extra_distance`,
    /// in length units. The next update of the pair follows after its bodies have moved that far.
    #[inline(always)]
    fn clear_manifold(&mut self, pair: PairIndex, extra_distance: f32) {
        // Most of these pairs had no contacts, and their cached manifold is default already.
        if self.pairs.manifold(pair).count > 0 {
            *self.pairs.manifold_mut(pair) = CachedManifold::default();
        }
        let slack = extra_distance.clamp(0.0, SEPARATED_PAIR_MAX_SLACK * self.parameters.length_unit);
        self.pairs.set_motion_tolerance(pair, (slack * self.parameters.travel_scale()) as u32);
    }

    /// Caches a manifold and adds or updates the contact constraint, with a warm start from the old one. `approach` holds the
    /// distances by which the bodies approach each other until the time of the manifold; 0 for a manifold in the present poses.
    fn store_manifold(
        &mut self,
        pair: PairIndex,
        two: ProxyPair<'_>,
        manifold: &Manifold,
        approach: ApproachDistances,
    ) {
        let state = *self.pairs.state(pair);
        let old = state.constraint.map(|handle| self.constraints.get(state.kind, handle));
        let matched = self.match_points(pair, two, manifold);
        let previous_normal = self.pairs.manifold(pair).normal;
        self.cache_manifold(pair, two, manifold);
        self.pairs.manifold_mut(pair).depth.z_offset += approach.z;
        if !state.has_response() {
            return;
        }
        let old = old.unwrap_or_default();
        if let Some(is_fast) = self.rolling_speed_class(pair, two) {
            self.rolling_contacts.push(RollingContact::new(self.pairs.proxies_of(pair), is_fast));
        }
        let mut constraint = self.build_constraint(pair, two);
        transfer_friction_impulse(&mut constraint, &old);
        for (point, approach) in constraint.points.iter_mut().zip(approach.points) {
            point.separation += approach;
        }
        for (at, point) in constraint.points.iter_mut().enumerate().take(manifold.count) {
            if let Some(from) = matched[at] {
                (point.normal_impulse, point.rest_impulse) =
                    (old.points[from].normal_impulse, old.points[from].rest_impulse);
            }
        }
        self.direct.timer.is_due |=
            self.is_heavy_on_light(pair, manifold.normal) && !self.is_heavy_on_light(pair, previous_normal);
        self.pairs.state_mut(pair).are_points_removed = [false; 2];
        match state.constraint {
            Some(handle) => self.constraints.set(state.kind, handle, &constraint),
            None => self.add_constraint(pair, &constraint),
        }
    }

    /// Returns whether the body of a proxy is static.
    fn is_fixed(&self, proxy: &Proxy) -> bool {
        proxy.body >= self.bodies.first_static()
    }
}
