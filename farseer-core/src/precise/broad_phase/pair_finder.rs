//! Broad phase: adds pairs of proxies whose fat AABBs begin to overlap, and removes pairs whose fat AABBs separate.
//!
//! Only proxies with a new fat AABB (`Proxies::refitted`) are searched. The hash grid yields the candidates; collision
//! filters and body types decide which of them become pairs. New pairs are sorted by creation numbers, so their order does
//! not depend on the grid.

use crate::precise::broad_phase::hash_grid::{HashGrid, overlap};
use crate::precise::broad_phase::pairs::Pairs;
use crate::precise::broad_phase::proxies::{BodyType, Proxies, Proxy};
use crate::precise::constraint_graph::ConstraintKind;
use crate::precise::depth::{DepthState, FeatureGate};
use crate::precise::narrow_phase::NarrowPhase;
use crate::precise::narrow_phase::one_way::{OneWayState, PairMotion};
use crate::storage::order::sort_by_number;

/// Returns two proxies in the order A, B of a pair; `None` if they cannot be a pair. A has the lesser body type, then the
/// smaller creation number. A pair needs two different bodies and a dynamic one among them; in 2D a sensor replaces the dynamic
/// body.
pub(in crate::precise) fn order_pair(
    proxies: &Proxies,
    depth: Option<FeatureGate<&DepthState>>,
    [one, other]: [u32; 2],
) -> Option<[u32; 2]> {
    let [proxy, partner] = [one, other].map(|proxy| &proxies.all[proxy as usize]);
    let key = |proxy: &Proxy| (proxy.body_type, proxy.creation_number, proxy.piece);
    let may_be_pushed = [proxy, partner].iter().any(|proxy| proxy.body_type == BodyType::Dynamic);
    let is_sensor_pair = depth.is_none() && !(proxy.responds && partner.responds);
    let may_meet = (may_be_pushed || is_sensor_pair)
        && depth.as_ref().is_none_or(|space| space.supports_on_ground([one, other]));
    if proxy.body == partner.body || !may_meet {
        return None;
    }
    Some(if key(proxy) < key(partner) { [one, other] } else { [other, one] })
}

/// Returns whether the fat AABBs of two proxies overlap. With a depth axis their fat intervals along z must overlap, too.
fn fat_aabbs_overlap(proxies: &Proxies, depth: Option<FeatureGate<&DepthState>>, [a, b]: [u32; 2]) -> bool {
    let bounds = &proxies.fat_aabbs;
    overlap(&bounds[a as usize], &bounds[b as usize])
        && depth.as_ref().is_none_or(|space| space.intervals_overlap(a, b))
}

/// The parts of the engine that the search of new pairs reads.
#[derive(Clone, Copy)]
pub(in crate::precise) struct PairFinder<'a> {
    pub(in crate::precise) proxies: &'a Proxies,
    pub(in crate::precise) pairs: &'a Pairs,
    pub(in crate::precise) grid: &'a HashGrid,
    pub(in crate::precise) depth: Option<FeatureGate<&'a DepthState>>,
}

impl PairFinder<'_> {
    /// Finds the new pairs of these proxies with the hash grid and stores them in `found`, sorted by creation numbers. Returns
    /// their number. `refitted` holds indices of proxies with a new fat AABB; `known` is a workspace with an entry for each
    /// proxy, all false.
    pub(in crate::precise) fn find(
        &self,
        refitted: &[u32],
        known: &mut [bool],
        found: &mut Vec<[u32; 2]>,
    ) -> usize {
        let PairFinder { proxies, pairs, grid, depth } = *self;
        found.clear();
        for &proxy in refitted {
            pairs.partners(proxy).for_each(|partner| known[partner as usize] = true);
            let bounds = proxies.fat_aabbs[proxy as usize];
            let mut find = |other: u32| {
                let [one, partner] = [proxy, other].map(|proxy| &proxies.all[proxy as usize]);
                if !known[other as usize] && one.may_meet(partner) {
                    found.extend(order_pair(proxies, depth, [proxy, other]));
                }
            };
            match &depth {
                None => grid.for_each_overlap(&bounds, find),
                Some(space) => {
                    grid.for_each_overlap(&space.grid_bounds(proxy, &bounds), |other| {
                        if fat_aabbs_overlap(proxies, depth, [proxy, other]) {
                            find(other);
                        }
                    });
                    space.ground_beneath(proxy, &bounds).into_iter().for_each(find);
                }
            }
            pairs.partners(proxy).for_each(|partner| known[partner as usize] = false);
        }
        sort_by_number(found, |&pair| proxies.creation_numbers(pair));
        found.dedup();
        found.len()
    }
}

impl NarrowPhase<'_> {
    /// Removes the pairs of these proxies whose fat AABBs do not overlap any more. `refitted` holds indices of proxies with a
    /// new fat AABB.
    pub(in crate::precise) fn remove_separated_pairs(&mut self, refitted: &[u32]) {
        let mut separated = std::mem::take(self.dirty_pairs);
        let NarrowPhase { proxies, pairs, depth, .. } = self;
        for &proxy in refitted {
            let is_separated =
                |&pair: &usize| !fat_aabbs_overlap(proxies, *depth, pairs.triggers[pair].proxies);
            separated.extend(pairs.pairs_of(proxy).filter(is_separated).map(|pair| pair as u32));
        }
        // Removal from the last pair on keeps the indices of the others valid.
        separated.sort_unstable();
        separated.dedup();
        for pair in separated.drain(..).rev() {
            self.record_separation(pair as usize);
            self.remove_pair(pair as usize);
        }
        *self.dirty_pairs = separated;
    }

    /// Adds a pair of the proxies A and B without contacts to the awake pairs, and returns its index.
    pub(in crate::precise) fn add_pair(&mut self, proxies: [u32; 2]) -> usize {
        let all = self.proxies;
        let [a, b] = proxies.map(|proxy| &all.all[proxy as usize]);
        let (responds, is_reported) = (a.responds && b.responds, is_pair_reported(all, proxies));
        let is_static_sensor = !(a.body_type.takes_impulses() || b.body_type.takes_impulses());
        let pair = self.pairs.push(proxies, self.constraint_kind(proxies), responds, is_reported);
        self.pairs.set_static_sensor(pair, is_static_sensor);
        self.pairs.all[pair].is_on_ground =
            self.depth.as_ref().is_some_and(|space| space.ground_proxy == proxies[0]);
        self.pairs.all[pair].one_way_state = initial_one_way_state(all, self.pairs, pair);
        if self.pairs.all[pair].one_way_state != OneWayState::Closed {
            let motion = PairMotion {
                bodies: self.bodies,
                proxies: all,
                pairs: self.pairs,
                speculative_distance: self.parameters.speculative_distance,
                is_after_step: false,
            };
            let state = motion.state_of_group(pair);
            self.pairs.all[pair].one_way_state = state;
        }
        self.wake_pair(pair)
    }

    /// Returns the kind of the contact constraint of a pair [A, B]: whether it has two points, whether A is static, and whether
    /// there is a depth axis.
    fn constraint_kind(&self, proxies: [u32; 2]) -> ConstraintKind {
        let [a, b] = proxies.map(|proxy| self.proxies.all[proxy as usize].shape);
        let is_fixed = proxies[0] as usize >= self.proxies.first_fixed;
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
pub(in crate::precise) fn initial_one_way_state(
    proxies: &Proxies,
    pairs: &Pairs,
    pair: usize,
) -> OneWayState {
    let is_one_way = |proxy: u32| proxies.all[proxy as usize].one_way.is_some();
    if pairs.all[pair].responds && pairs.triggers[pair].proxies.into_iter().any(is_one_way) {
        OneWayState::Apart
    } else {
        OneWayState::Closed
    }
}

/// Returns whether the game's handlers are called for a pair in every update in which it touches. Pairs of two static bodies are
/// reported only when they begin to touch.
pub(in crate::precise) fn is_pair_reported(proxies: &Proxies, pair: [u32; 2]) -> bool {
    let both = pair.map(|proxy| &proxies.all[proxy as usize]);
    !both.iter().all(|proxy| proxy.body_type == BodyType::Fixed)
        && both.iter().any(|proxy| proxy.is_reported && !proxy.is_world)
}
