//! Narrow phase: changes that collision handlers made to the contacts of one step, and their end.

use super::NarrowPhase;
use crate::index::PairIndex;
use crate::surface::SurfaceOverride;

impl NarrowPhase<'_> {
    /// Ends the vetoes and surface settings that collision handlers made for one step, and invalidates the vetoed awake pairs.
    /// Returns whether a pair was vetoed. A sleeping pair keeps its contact constraint as the handlers left it until it wakes.
    pub(crate) fn clear_handler_overrides(&mut self) -> bool {
        let mut has_vetoes = false;
        for pair in self.pairs.indices() {
            let is_awake = self.pairs.is_awake(pair);
            let was_vetoed = std::mem::take(&mut self.pairs.state_mut(pair).is_vetoed);
            self.pairs.state_mut(pair).was_vetoed = was_vetoed;
            has_vetoes |= was_vetoed;
            if was_vetoed && is_awake {
                self.pairs.invalidate(pair);
            }
            if is_awake && std::mem::take(&mut self.pairs.state_mut(pair).has_surface_override) {
                self.reset_surface_parameters(pair);
            }
        }
        has_vetoes
    }

    /// Disables all contacts of a pair for this step: removes its contact constraint.
    pub fn veto(&mut self, pair: PairIndex) {
        if self.pairs.has_constraint(pair) {
            self.sleep.request_wake_of_pair(self.pairs.bodies_of(self.proxies, pair));
        }
        self.pairs.state_mut(pair).is_vetoed = true;
        self.remove_constraint(pair);
        self.revoke_landing(pair);
        // In three axes a disabled pair does not count as touching.
        if self.depth.is_some() && self.pairs.is_touching(pair) {
            self.emit_touch_event(pair, false);
        }
        // Without a constraint the solver does not update the pair, so the narrow phase must.
        self.pairs.recheck(pair);
    }

    /// Retains only some contact points of a pair. The other points exert no impulses in this step. Returns whether the pair has
    /// a contact constraint.
    pub fn retain_points(&mut self, pair: PairIndex, is_kept: [bool; 2]) -> bool {
        let state = *self.pairs.state(pair);
        let Some(handle) = state.constraint else { return false };
        self.sleep.request_wake_of_pair(self.pairs.bodies_of(self.proxies, pair));
        let mut constraint = self.constraints.get(state.kind, handle);
        for (point, _) in constraint.points.iter_mut().zip(is_kept).filter(|(_, is_kept)| !is_kept) {
            (point.normal_mass, point.normal_impulse, point.rest_impulse) = (0.0, 0.0, 0.0);
        }
        self.constraints.set(state.kind, handle, &constraint);
        let state = self.pairs.state_mut(pair);
        state.is_vetoed = true;
        state.are_points_removed = [0, 1].map(|at| state.are_points_removed[at] || !is_kept[at]);
        true
    }

    /// Overrides friction, restitution and tangent speed of a pair for this step. A sleeping pair wakes if these values differ
    /// from those with which it fell asleep. Returns the restitution coefficient if the contact constraint has changed.
    pub fn override_surface(&mut self, pair: PairIndex, surface: SurfaceOverride) -> Option<f32> {
        let state = *self.pairs.state(pair);
        let is_asleep = !self.pairs.is_awake(pair);
        let Some(handle) = state.constraint.filter(|_| is_asleep || surface != SurfaceOverride::default())
        else {
            if is_asleep && state.responds {
                self.sleep.request_wake_of_pair(self.pairs.bodies_of(self.proxies, pair));
            }
            return None;
        };
        let mut constraint = self.constraints.get(state.kind, handle);
        let before = [constraint.friction, constraint.restitution, constraint.tangent_speed];
        let [friction, restitution, speed] = if is_asleep { self.surface_parameters(pair) } else { before };
        constraint.friction = surface.friction.unwrap_or(friction);
        constraint.restitution = surface.restitution.unwrap_or(restitution);
        // The sum of two finite speeds may overflow.
        constraint.tangent_speed =
            surface.tangent_speed.map_or(speed, |set| (speed + set).clamp(f32::MIN, f32::MAX));
        if is_asleep && before == [constraint.friction, constraint.restitution, constraint.tangent_speed] {
            return None;
        }
        self.sleep.request_wake_of_pair(self.pairs.bodies_of(self.proxies, pair));
        self.constraints.set(state.kind, handle, &constraint);
        self.pairs.state_mut(pair).has_surface_override = true;
        Some(constraint.restitution)
    }
}
