//! Broad phase: adds pairs of proxies whose fat AABBs begin to overlap, and removes pairs whose fat AABBs separate.
//!
//! Only proxies with a new fat AABB (`Proxies::refitted`) are searched. The hash grid yields the candidates; collision
//! filters and body types decide which of them become pairs. New pairs are sorted by creation numbers, so their order does
//! not depend on the grid.

use crate::geom::GeomId;
use crate::precise::Precise;
use crate::precise::broad_phase::hash_grid::overlap;
use crate::precise::broad_phase::proxies::{BodyType, Proxy};
use crate::precise::constraint_graph::ConstraintKind;
use crate::precise::depth::interface::is_geom;
use crate::precise::narrow_phase::one_way::OneWayState;
use crate::storage::order::sort_by_number;

impl Precise {
    /// Returns the number of proxies whose fat AABB has changed since the last [`find_pairs`](Self::find_pairs).
    pub(crate) fn refitted_count(&self) -> usize {
        self.proxies.refitted.len()
    }

    /// Removes pairs whose fat AABBs do not overlap any more, and returns the number of new candidate pairs.
    /// [`candidate_geoms`](Self::candidate_geoms) returns the geoms of each candidate; candidates are sorted by creation
    /// numbers.
    pub(crate) fn find_pairs(&mut self) -> usize {
        if self.proxies.refitted.is_empty() {
            self.new_pairs.clear();
            self.searched_static_proxies.clear();
            self.store_penetration();
            return 0;
        }
        let mut refitted = std::mem::take(&mut self.proxies.refitted);
        self.remove_separated_pairs(&refitted);
        let found = self.find_new_pairs(&refitted);
        self.searched_static_proxies.clear();
        if self.depth.is_none() {
            let Precise { searched_static_proxies: static_proxies, proxies, .. } = self;
            let is_static_sensor = |&&proxy: &&u32| !proxies.all[proxy as usize].body_type.takes_impulses();
            static_proxies.extend(refitted.iter().filter(is_static_sensor));
        }
        refitted.clear();
        self.proxies.refitted = refitted;
        found
    }

    /// Finds the new pairs of these proxies with the hash grid and stores them in `new_pairs`, sorted by creation numbers.
    /// Returns their number. `refitted` holds indices of proxies with a new fat AABB.
    pub(in crate::precise) fn find_new_pairs(&mut self, refitted: &[u32]) -> usize {
        let mut found = std::mem::take(&mut self.new_pairs);
        found.clear();
        let mut known = std::mem::take(&mut self.proxy_flags);
        for &proxy in refitted {
            self.pairs.partners(proxy).for_each(|partner| known[partner as usize] = true);
            let bounds = self.proxies.fat_aabbs[proxy as usize];
            let mut find = |other: u32| {
                let [one, partner] = [proxy, other].map(|proxy| &self.proxies.all[proxy as usize]);
                if !known[other as usize] && one.may_meet(partner) {
                    found.extend(self.order_pair([proxy, other]));
                }
            };
            match &self.depth {
                None => self.grid.for_each_overlap(&bounds, find),
                Some(space) => {
                    self.grid.for_each_overlap(&space.grid_bounds(proxy, &bounds), |other| {
                        if self.overlap([proxy, other]) {
                            find(other);
                        }
                    });
                    space.ground_beneath(proxy, &bounds).into_iter().for_each(find);
                }
            }
            self.pairs.partners(proxy).for_each(|partner| known[partner as usize] = false);
        }
        self.proxy_flags = known;
        sort_by_number(&mut found, |&pair| self.proxies.creation_numbers(pair));
        found.dedup();
        self.new_pairs = found;
        self.new_pairs.len()
    }

    /// Removes the pairs of these proxies whose fat AABBs do not overlap any more. `refitted` holds indices of proxies with a
    /// new fat AABB.
    fn remove_separated_pairs(&mut self, refitted: &[u32]) {
        let mut separated = std::mem::take(&mut self.pair_scratch);
        for &proxy in refitted {
            let is_separated = |&pair: &usize| !self.overlap(self.pairs.triggers[pair].proxies);
            separated.extend(self.pairs.pairs_of(proxy).filter(is_separated).map(|pair| pair as u32));
        }
        // Removal from the last pair on keeps the indices of the others valid.
        separated.sort_unstable();
        separated.dedup();
        for pair in separated.drain(..).rev() {
            self.narrow_phase().record_separation(pair as usize);
            self.narrow_phase().remove_pair(pair as usize);
        }
        self.store_penetration();
        self.pair_scratch = separated;
    }

    /// Returns whether the fat AABBs of two proxies overlap. With a depth axis their fat intervals along z must overlap, too.
    fn overlap(&self, [a, b]: [u32; 2]) -> bool {
        let bounds = &self.proxies.fat_aabbs;
        overlap(&bounds[a as usize], &bounds[b as usize])
            && self.depth.as_ref().is_none_or(|space| space.intervals_overlap(a, b))
    }

    /// Returns two proxies in the order A, B of a pair; `None` if they cannot be a pair. A has the lesser body type, then the
    /// smaller creation number. A pair needs two different bodies and a dynamic one among them; in 2D a sensor replaces the
    /// dynamic body.
    pub(in crate::precise) fn order_pair(&self, [one, other]: [u32; 2]) -> Option<[u32; 2]> {
        let [proxy, partner] = [one, other].map(|proxy| &self.proxies.all[proxy as usize]);
        let key = |proxy: &Proxy| (proxy.body_type, proxy.creation_number, proxy.piece);
        let may_be_pushed = [proxy, partner].iter().any(|proxy| proxy.body_type == BodyType::Dynamic);
        let is_sensor_pair = self.depth.is_none() && !(proxy.responds && partner.responds);
        let may_meet = (may_be_pushed || is_sensor_pair) && self.may_meet_ground([one, other]);
        if proxy.body == partner.body || !may_meet {
            return None;
        }
        Some(if key(proxy) < key(partner) { [one, other] } else { [other, one] })
    }

    /// Returns the geoms of the candidate pair `at`, an index into `new_pairs`. The geom with the smaller creation number is
    /// first.
    pub(crate) fn candidate_geoms(&self, at: usize) -> (GeomId, GeomId) {
        let [a, b] = self.new_pairs[at].map(|proxy| &self.proxies.all[proxy as usize]);
        if a.creation_number < b.creation_number { (a.geom, b.geom) } else { (b.geom, a.geom) }
    }

    /// Adds the candidate pair `at`, an index into `new_pairs`, to the pairs. Sensor pairs without a body that can move go to
    /// the sleeping pairs.
    pub(crate) fn add_candidate_pair(&mut self, at: usize) {
        let pair = self.add_pair(self.new_pairs[at]);
        if self.pairs.all[pair].is_static_sensor {
            self.narrow_phase().sleep_pair(pair);
        } else {
            self.wake_for_new_pair(pair);
        }
    }

    /// Adds a pair of the proxies A and B without contacts to the awake pairs, and returns its index.
    pub(in crate::precise) fn add_pair(&mut self, proxies: [u32; 2]) -> usize {
        let [a, b] = proxies.map(|proxy| &self.proxies.all[proxy as usize]);
        let (responds, is_reported) = (a.responds && b.responds, self.is_pair_reported(proxies));
        let is_static_sensor = proxies.iter().all(|&proxy| !self.takes_impulses(proxy));
        let pair = self.pairs.push(proxies, self.constraint_kind(proxies), responds, is_reported);
        self.pairs.set_static_sensor(pair, is_static_sensor);
        self.pairs.all[pair].is_on_ground =
            self.depth.as_ref().is_some_and(|space| space.ground_proxy == proxies[0]);
        self.pairs.all[pair].one_way_state = self.initial_one_way_state(pair);
        if self.pairs.all[pair].one_way_state != OneWayState::Closed {
            self.pairs.all[pair].one_way_state = self.pair_motion().state_of_group(pair);
        }
        self.narrow_phase().wake_pair(pair)
    }

    /// Returns the one-way state of a new pair: `Apart` if the pair has collision response and a one-way geom, else `Closed`.
    pub(in crate::precise) fn initial_one_way_state(&self, pair: usize) -> OneWayState {
        let is_one_way = |proxy: u32| self.proxies.all[proxy as usize].one_way.is_some();
        if self.pairs.all[pair].responds && self.pairs.triggers[pair].proxies.into_iter().any(is_one_way) {
            OneWayState::Apart
        } else {
            OneWayState::Closed
        }
    }

    /// Returns whether impulses can move the body of a proxy: it is dynamic or a hinged platform.
    fn takes_impulses(&self, proxy: u32) -> bool {
        self.proxies.all[proxy as usize].body_type.takes_impulses()
    }

    /// Returns whether the game's handlers are called for a pair in every update in which it touches. Pairs of two static
    /// bodies are reported only when they begin to touch.
    pub(in crate::precise) fn is_pair_reported(&self, proxies: [u32; 2]) -> bool {
        let both = proxies.map(|proxy| &self.proxies.all[proxy as usize]);
        !both.iter().all(|proxy| proxy.body_type == BodyType::Fixed)
            && both.iter().any(|proxy| proxy.is_reported && is_geom(proxy.geom))
    }

    /// Returns the kind of the contact constraint of a pair [A, B]: whether it has two points, whether A is static, and whether
    /// there is a depth axis.
    pub(in crate::precise) fn constraint_kind(&self, proxies: [u32; 2]) -> ConstraintKind {
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
