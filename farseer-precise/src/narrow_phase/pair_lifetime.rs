//! Narrow phase: adds pairs that the broad phase has found, and removes pairs whose fat AABBs have separated.

use super::NarrowPhase;
use super::one_way::PairMotion;
use crate::broad_phase::pair_finder::{fat_aabbs_overlap, is_pair_reported};
use crate::broad_phase::pairs::{OneWayState, Pairs};
use crate::broad_phase::proxies::Proxies;
use crate::constraint_graph::ConstraintKind;
use crate::index::{PairIndex, ProxyIndex};

impl NarrowPhase<'_> {
    /// Removes the pairs of these proxies whose fat AABBs do not overlap any more. `refitted` holds indices of proxies with a
    /// new fat AABB.
    pub(crate) fn remove_separated_pairs(&mut self, refitted: &[ProxyIndex]) {
        let mut separated = std::mem::take(self.dirty_pairs);
        let NarrowPhase { proxies, pairs, depth, .. } = self;
        for &proxy in refitted {
            let is_separated = |&(_, partner): &(PairIndex, ProxyIndex)| {
                !fat_aabbs_overlap(proxies, *depth, [proxy, partner])
            };
            separated.extend(pairs.pairs_and_partners(proxy).filter(is_separated).map(|(pair, _)| pair));
        }
        // Removal from the last pair on keeps the indices of the others valid.
        separated.sort_unstable();
        separated.dedup();
        for pair in separated.drain(..).rev() {
            self.record_separation(pair);
            self.remove_pair(pair);
        }
        *self.dirty_pairs = separated;
    }

    /// Removes pairs with their contact constraints. Touching ones get an event, and bodies that they support may wake.
    pub fn remove_pairs(&mut self, mut pairs: Vec<PairIndex>) {
        // Descending order keeps the remaining indices valid.
        pairs.sort_unstable();
        pairs.dedup();
        for pair in pairs.into_iter().rev() {
            if self.pairs.has_constraint(pair) {
                self.sleep.support_of_pair_removed(self.pairs.bodies_of(self.proxies, pair));
            }
            self.end_touch_event(pair);
            self.delete_pair(pair);
        }
    }

    /// Adds a pair of the proxies A and B without contacts to the awake pairs, and returns its index.
    pub fn add_pair(&mut self, proxies: [ProxyIndex; 2]) -> PairIndex {
        let all = self.proxies;
        let [a, b] = proxies.map(|proxy| all.proxy(proxy));
        let (responds, is_reported) = (a.responds && b.responds, is_pair_reported(all, proxies));
        let is_static_sensor = !(a.body_type.takes_impulses() || b.body_type.takes_impulses());
        let pair = self.pairs.push(proxies, self.constraint_kind(proxies), responds, is_reported);
        self.pairs.set_static_sensor(pair, is_static_sensor);
        self.pairs.state_mut(pair).is_on_ground =
            self.depth.as_ref().is_some_and(|space| space.ground_proxy == proxies[0]);
        self.pairs.state_mut(pair).one_way_state = initial_one_way_state(all, self.pairs, pair);
        if self.pairs.state(pair).one_way_state != OneWayState::Closed {
            let motion = PairMotion {
                bodies: self.bodies,
                proxies: all,
                pairs: self.pairs,
                speculative_distance: self.parameters.speculative_distance,
                is_after_step: false,
            };
            let state = motion.state_of_group(pair);
            self.pairs.state_mut(pair).one_way_state = state;
        }
        self.wake_pair(pair)
    }

    /// Returns the kind of the contact constraint of a pair [A, B]: whether it has two points, whether A is static, and whether
    /// there is a depth axis.
    fn constraint_kind(&self, proxies: [ProxyIndex; 2]) -> ConstraintKind {
        let [a, b] = proxies.map(|proxy| self.proxies.proxy(proxy).shape);
        let is_fixed = proxies[0] >= self.proxies.first_fixed;
        match &self.depth {
            None => ConstraintKind {
                has_two_points: a.vertex_count > 0 && b.vertex_count > 0,
                is_static: is_fixed,
                is_3d: false,
            },
            Some(space) => {
                let has_two_points = !proxies.iter().any(|&proxy| space.is_sphere(proxy));
                ConstraintKind { has_two_points, is_static: is_fixed, is_3d: true }
            }
        }
    }
}

/// Returns the one-way state of a new pair: `Apart` if the pair has collision response and a one-way geom, else `Closed`.
pub fn initial_one_way_state(proxies: &Proxies, pairs: &Pairs, pair: PairIndex) -> OneWayState {
    let is_one_way = |proxy: ProxyIndex| proxies.proxy(proxy).one_way.is_some();
    if pairs.state(pair).responds && pairs.proxies_of(pair).into_iter().any(is_one_way) {
        OneWayState::Apart
    } else {
        OneWayState::Closed
    }
}
