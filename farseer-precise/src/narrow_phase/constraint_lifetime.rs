//! Narrow phase: adds and removes contact constraints, and moves them when bodies sleep or change the solver.
//!
//! Each constraint is in one place. It is in a colour of the constraint graph, which the iterative solver reads, or parked, for
//! a sleeping body or the direct solver. The pair stores the place as a handle.

use super::NarrowPhase;
use crate::broad_phase::pairs::{Pairs, UPDATED_BY_SOLVER};
use crate::constraint_graph::saved_constraint::SavedConstraint;
use crate::constraint_graph::{
    Color, ConstraintGraph, ConstraintHandle, ContactConstraint, ParkedConstraint,
};
use crate::direct_solver::load::{is_heavy_on_light, is_support_normal};
use crate::index::{BodyIndex, PairIndex};
use crate::math::plane::Vector;

impl NarrowPhase<'_> {
    /// Adds the contact constraint of a pair to the constraint graph, in a colour without another constraint of its bodies
    /// (static ones do not count) or, if all colours have one, in the overflow colour.
    pub(super) fn add_constraint(&mut self, pair: PairIndex, constraint: &ContactConstraint) {
        let kind = self.pairs.state(pair).kind;
        let free = self.palette.free_colors(kind, [constraint.a, constraint.b]);
        let color = self.constraints.choose_color(kind, free);
        self.palette.set_color(kind, [constraint.a, constraint.b], color, true);
        self.direct.note_constraint_change([constraint.a, constraint.b], self.depth.is_some());
        self.direct.watch_friction(constraint.b, self.depth.is_some());
        self.pairs.state_mut(pair).constraint = Some(self.constraints.add(kind, color, constraint));
        if [constraint.a, constraint.b].into_iter().any(|body| self.sleep.is_asleep(body)) {
            self.sleep.record_touch(pair);
        }
    }

    /// Removes the contact constraint of a pair from the constraint graph or the parked ones, if the pair has one.
    pub(crate) fn remove_constraint(&mut self, pair: PairIndex) {
        let kind = self.pairs.state(pair).kind;
        let Some(handle) = self.pairs.state_mut(pair).constraint.take() else { return };
        self.pairs.state_mut(pair).rolling_impulse = 0.0;
        let [a, b] = self.constraints.bodies_of(kind, handle);
        let color = self.constraints.color_of(handle);
        self.palette.set_color(kind, [a, b], color, false);
        self.direct.note_constraint_change([a, b], self.depth.is_some());
        self.constraints.remove(kind, handle);
        update_moved_handles(self.pairs, self.constraints);
    }

    /// Returns whether a heavy body of the pair would rest on a light one with the contact normal `normal` (unit, from A to B).
    /// Always false in 2D.
    #[inline(always)]
    pub(super) fn is_heavy_on_light(&self, pair: PairIndex, normal: Vector) -> bool {
        self.depth.is_some()
            && is_support_normal(normal, self.gravity_delta)
            && self.test_heavy_on_light(pair, normal)
    }

    /// Returns whether the upper body of a pair is much heavier than the lower one, as seen along gravity. This is the second
    /// half of [`is_heavy_on_light`](Self::is_heavy_on_light), for normals within 60 degrees of gravity.
    #[inline(never)]
    fn test_heavy_on_light(&self, pair: PairIndex, normal: Vector) -> bool {
        let inverse_masses = self.pairs.proxies_of(pair).map(|proxy| {
            let body = self.proxies.proxy(proxy).body;
            self.bodies.inverse_mass_inertia[body][0]
        });
        is_heavy_on_light(inverse_masses, normal, self.gravity_delta)
    }

    /// Removes a pair with its contact constraint, and emits an end-touch event if the pair touched. Sleeping bodies of a pair
    /// with a constraint are asked to wake.
    pub(crate) fn remove_pair(&mut self, pair: PairIndex) {
        if !self.pairs.is_awake(pair) && self.pairs.has_constraint(pair) {
            let bodies = self.pairs.proxies_of(pair).map(|proxy| self.proxies.body_of(proxy));
            bodies.into_iter().for_each(|body| self.sleep.request_wake(body));
        }
        self.end_touch_event(pair);
        self.delete_pair(pair);
    }

    /// Emits an end-touch event if the pair touches. It is called before the pair is removed.
    pub fn end_touch_event(&mut self, pair: PairIndex) {
        if self.pairs.is_touching(pair) {
            self.emit_touch_event(pair, false);
        }
    }

    /// Removes a pair from the list of pairs, with its contact constraint and without an event.
    pub fn delete_pair(&mut self, pair: PairIndex) {
        self.remove_constraint(pair);
        self.pairs.set_touching(pair, false);
        let moved = self.pairs.remove(pair);
        moved.into_iter().flatten().for_each(|pair| self.store_pair_index(pair));
    }

    /// Exchanges the list positions of two pairs, and corrects the pair indices that their contact constraints store.
    fn swap_pairs(&mut self, one: PairIndex, other: PairIndex) {
        if one == other {
            return;
        }
        self.pairs.swap(one, other);
        [one, other].into_iter().for_each(|pair| self.store_pair_index(pair));
    }

    /// Stores the index of a pair that has moved in its contact constraint.
    fn store_pair_index(&mut self, pair: PairIndex) {
        if let Some((kind, handle)) = self.pairs.constraint(pair) {
            self.constraints.set_pair(kind, handle, pair);
        }
    }

    /// Moves a pair to the end of the awake pairs, which come first in the list, and returns its new index.
    pub(crate) fn wake_pair(&mut self, pair: PairIndex) -> PairIndex {
        let new_index = self.pairs.extend_awake();
        self.swap_pairs(pair, new_index);
        new_index
    }

    /// Moves a pair from the awake pairs to the start of the sleeping ones, and returns its new index.
    pub fn sleep_pair(&mut self, pair: PairIndex) -> PairIndex {
        let new_index = self.pairs.shorten_awake();
        self.swap_pairs(pair, new_index);
        new_index
    }

    /// Computes and caches the manifold of two circles, and copies its normal, arms and separations into their contact
    /// constraint. While both were awake, the solver computed these in every substep, and the cache was out of date.
    fn cache_circle_manifold(&mut self, pair: PairIndex, handle: ConstraintHandle) {
        let two = self.proxy_pair(pair);
        let manifold = self.collide(pair, two, f32::MAX);
        self.cache_manifold(pair, two, &manifold);
        let kind = self.pairs.state(pair).kind;
        let now = self.build_constraint(pair, two);
        let mut constraint = self.constraints.get(kind, handle);
        (constraint.normal, constraint.tangent_arms, constraint.tangent_mass) =
            (now.normal, now.tangent_arms, now.tangent_mass);
        for (point, now) in constraint.points.iter_mut().zip(&now.points) {
            (point.normal_arm_a, point.normal_arm_b, point.separation) =
                (now.normal_arm_a, now.normal_arm_b, now.separation);
        }
        self.constraints.set(kind, handle, &constraint);
    }

    /// Parks the contact constraint of a pair that falls asleep, or returns it to the constraint graph. `h` is the length of
    /// the present substeps in seconds. A parked constraint stores it, and on the return its impulses are scaled to it.
    pub(crate) fn set_constraint_asleep(&mut self, pair: PairIndex, falls_asleep: bool, h: f32) {
        let kind = self.pairs.state(pair).kind;
        let Some(handle) = self.pairs.state(pair).constraint else { return };
        if falls_asleep
            && self.pairs.trigger(pair).motion_tolerance == UPDATED_BY_SOLVER
            && self.constraints.sleeping_constraint(handle).is_none()
        {
            self.cache_circle_manifold(pair, handle);
        }
        let moved = if falls_asleep {
            self.constraints.park(kind, handle, false, h)
        } else {
            if let Some(sleeping) = self.constraints.sleeping_constraint(handle) {
                self.pairs.state_mut(pair).scale_rolling_impulse(h / sleeping.h);
            }
            self.constraints.unpark(kind, handle, h)
        };
        // A body that wakes may join an island of the direct solver.
        self.direct.timer.is_due |= moved != handle
            && (self.depth.is_none()
                || handle.is_in_direct_solver()
                || self.is_heavy_on_light(pair, self.pairs.manifold(pair).normal));
        set_handle(self.pairs, self.constraints, pair, moved);
    }

    /// Restores the contact constraint of a pair from a snapshot: in its graph colour, or parked.
    pub fn restore_constraint(&mut self, pair: PairIndex, saved: &SavedConstraint) {
        let mut constraint = self.build_constraint(pair, self.proxy_pair(pair));
        saved.apply_to(&mut constraint);
        let (color, parked) = (saved.color(), saved.parked());
        let kind = self.pairs.state(pair).kind;
        let color = self.palette.reserve_color(kind, [constraint.a, constraint.b], Color(color));
        self.palette.set_color(kind, [constraint.a, constraint.b], color, true);
        // A damaged snapshot may declare a constraint of awake bodies asleep.
        let is_still = |&body: &BodyIndex| {
            body == BodyIndex::PLACEHOLDER || self.sleep.is_asleep(body) || self.bodies.is_kinematic(body)
        };
        let is_valid = |&(_, exact): &(f32, Option<[f64; 3]>)| {
            exact.is_some() || [constraint.a, constraint.b].iter().all(is_still)
        };
        let handle: ConstraintHandle = match parked.filter(is_valid) {
            Some((h, exact)) => {
                let parked_constraint =
                    ParkedConstraint { constraint, color, h, exact_impulses: exact.unwrap_or_default() };
                self.constraints.push_parked(parked_constraint, exact.is_some())
            }
            None => {
                self.sleep.request_wake(constraint.a);
                self.sleep.request_wake(constraint.b);
                self.constraints.add(kind, color, &constraint)
            }
        };
        self.pairs.state_mut(pair).constraint = Some(handle);
    }
}

/// Parks the contact constraint of a pair for the direct solver if `is_direct`, else returns it to the constraint graph of the
/// iterative solver. `h` is the length of the present substeps in seconds. A parked constraint stores it, and on the return the
/// impulses of the constraint are scaled to it.
pub(crate) fn move_to_direct_solver(
    pairs: &mut Pairs,
    constraints: &mut ConstraintGraph,
    pair: PairIndex,
    is_direct: bool,
    h: f32,
) {
    let kind = pairs.state(pair).kind;
    let Some(handle) = pairs.state(pair).constraint else { return };
    let moved =
        if is_direct { constraints.park(kind, handle, true, h) } else { constraints.unpark(kind, handle, h) };
    set_handle(pairs, constraints, pair, moved);
}

/// Stores in a pair the new handle of its contact constraint, which was moved, and then the handles of constraints that filled
/// the gap.
fn set_handle(
    pairs: &mut Pairs,
    constraints: &mut ConstraintGraph,
    pair: PairIndex,
    handle: ConstraintHandle,
) {
    pairs.state_mut(pair).constraint = Some(handle);
    update_moved_handles(pairs, constraints);
}

/// Stores in the pairs the new handles of contact constraints that the constraint graph has moved to fill gaps in its lists.
fn update_moved_handles(pairs: &mut Pairs, constraints: &mut ConstraintGraph) {
    for (pair, handle) in constraints.drain_moved() {
        pairs.state_mut(pair).constraint = Some(handle);
    }
}
