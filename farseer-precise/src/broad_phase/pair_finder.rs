//! Broad phase: adds pairs of proxies whose fat AABBs begin to overlap, and removes pairs whose fat AABBs separate.
//!
//! Only proxies with a new fat AABB (`Proxies::refitted`) are searched. The hash grid yields the candidates; collision
//! filters and body types decide which of them become pairs. New pairs are sorted by creation numbers, so their order does
//! not depend on the grid.

use crate::broad_phase::hash_grid::{HashGrid, overlap};
use crate::broad_phase::pairs::Pairs;
use crate::broad_phase::proxies::{BodyType, Proxies, Proxy};
use crate::depth::feature_gate::FeatureGate;
use crate::depth::state::DepthState;
use crate::index::{IndexedVec, ProxyIndex};
use crate::storage::order::sort_by_number;

/// Returns two proxies in the order A, B of a pair; `None` if they cannot be a pair. A has the lesser body type, then the
/// smaller creation number. A pair needs two different bodies and a dynamic one among them; in 2D a sensor replaces the dynamic
/// body.
pub fn order_pair(
    proxies: &Proxies,
    depth: Option<FeatureGate<&DepthState>>,
    [one, other]: [ProxyIndex; 2],
) -> Option<[ProxyIndex; 2]> {
    let [proxy, partner] = [one, other].map(|proxy| proxies.proxy(proxy));
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
pub(crate) fn fat_aabbs_overlap(
    proxies: &Proxies,
    depth: Option<FeatureGate<&DepthState>>,
    [a, b]: [ProxyIndex; 2],
) -> bool {
    overlap(proxies.fat_aabb_of(a), proxies.fat_aabb_of(b))
        && depth.as_ref().is_none_or(|space| space.intervals_overlap(a, b))
}

/// The parts of the engine that the search of new pairs reads.
#[derive(Clone, Copy)]
pub(crate) struct PairFinder<'a> {
    pub(crate) proxies: &'a Proxies,
    pub(crate) pairs: &'a Pairs,
    pub(crate) grid: &'a HashGrid,
    pub(crate) depth: Option<FeatureGate<&'a DepthState>>,
}

impl PairFinder<'_> {
    /// Finds the new pairs of these proxies with the hash grid and stores them in `found`, sorted by creation numbers. Returns
    /// their number. `refitted` holds indices of proxies with a new fat AABB; `seen` is a workspace with an entry for each
    /// proxy, all false.
    pub(crate) fn find(
        &self,
        refitted: &[ProxyIndex],
        seen: &mut IndexedVec<ProxyIndex, bool>,
        found: &mut Vec<[ProxyIndex; 2]>,
    ) -> usize {
        let PairFinder { proxies, pairs, grid, depth } = *self;
        found.clear();
        if refitted.is_empty() {
            return 0;
        }
        for &proxy in refitted {
            let (first, bounds) = (found.len(), *proxies.fat_aabb_of(proxy));
            let mut find = |other: ProxyIndex| {
                if !std::mem::replace(&mut seen[other], true) {
                    found.push([proxy, other]);
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
            pairs.partners(proxy).for_each(|partner| seen[partner] = false);
            self.retain_new(first, seen, found);
            // In the plane, overlaps are found from both sides: the pairs with this proxy are complete.
            seen[proxy] = depth.is_none();
        }
        refitted.iter().for_each(|&proxy| seen[proxy] = false);
        sort_by_number(found, |&pair| proxies.creation_numbers(pair));
        found.dedup();
        found.len()
    }

    /// Keeps those among the entries of `found` from `first` on that may become pairs, in the order A, B. Their second proxy is
    /// still `seen`; that of a pair that exists is not. Clears `seen`.
    fn retain_new(
        &self,
        first: usize,
        seen: &mut IndexedVec<ProxyIndex, bool>,
        found: &mut Vec<[ProxyIndex; 2]>,
    ) {
        let PairFinder { proxies, depth, .. } = *self;
        let mut end = first;
        for at in first..found.len() {
            let [proxy, other] = found[at];
            let is_new = std::mem::take(&mut seen[other]);
            if is_new
                && proxies.proxy(proxy).may_meet(proxies.proxy(other))
                && let Some(pair) = order_pair(proxies, depth, [proxy, other])
            {
                found[end] = pair;
                end += 1;
            }
        }
        found.truncate(end);
    }
}

/// Returns whether the game's handlers are called for a pair in every update in which it touches. Pairs of two static bodies are
/// reported only when they begin to touch.
pub fn is_pair_reported(proxies: &Proxies, pair: [ProxyIndex; 2]) -> bool {
    let both = pair.map(|proxy| proxies.proxy(proxy));
    !both.iter().all(|proxy| proxy.body_type == BodyType::Fixed)
        && both.iter().any(|proxy| proxy.is_reported && !proxy.is_world)
}
