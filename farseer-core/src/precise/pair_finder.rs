//! Broad phase: pairs of proxies whose AABBs overlap come, and pairs whose AABBs have parted go.

use super::Precise;
use super::grid::overlap;
use super::one_way::Passage;
use super::proxies::{Mobility, Proxy};
use super::rows::Kind;
use super::space::parts::is_geom;
use crate::geom::GeomId;
use crate::storage::order::sort_by_number;

impl Precise {
    /// Number of fat AABBs that have been computed anew since the last [`find_pairs`](Self::find_pairs).
    pub(crate) fn escaped_count(&self) -> usize {
        self.proxies.escaped.len()
    }

    /// Second stage: pairs whose bounds do not overlap any more go. Answers how many new ones there may be: those that
    /// [`candidate`](Self::candidate) names, in the order of creation numbers.
    pub(crate) fn find_pairs(&mut self) -> usize {
        let mut escaped = std::mem::take(&mut self.proxies.escaped);
        self.drop_parted(&escaped);
        let found = self.search(&escaped);
        self.unpushed.clear();
        if self.space.is_none() {
            let Precise { unpushed, proxies, .. } = self;
            let is_unpushed = |&&proxy: &&u32| !proxies.all[proxy as usize].mobility.gives_way();
            unpushed.extend(escaped.iter().filter(is_unpushed));
        }
        escaped.clear();
        self.proxies.escaped = escaped;
        found
    }

    /// The new pairs there may be of these proxies.
    pub(super) fn search(&mut self, escaped: &[u32]) -> usize {
        let mut found = std::mem::take(&mut self.found);
        found.clear();
        let mut known = std::mem::take(&mut self.known);
        for &proxy in escaped {
            self.pairs.partners(proxy).for_each(|partner| known[partner as usize] = true);
            let bounds = self.proxies.bounds[proxy as usize];
            let mut find = |other: u32| {
                let [one, partner] = [proxy, other].map(|proxy| &self.proxies.all[proxy as usize]);
                if !known[other as usize] && one.may_meet(partner) {
                    found.extend(self.ordered([proxy, other]));
                }
            };
            match &self.space {
                None => self.grid.for_each_overlap(&bounds, find),
                Some(space) => {
                    self.grid.for_each_overlap(&space.cells(proxy, &bounds), |other| {
                        if self.overlap([proxy, other]) {
                            find(other);
                        }
                    });
                    space.ground_beneath(proxy, &bounds).into_iter().for_each(find);
                }
            }
            self.pairs.partners(proxy).for_each(|partner| known[partner as usize] = false);
        }
        self.known = known;
        sort_by_number(&mut found, |&pair| self.proxies.creation_numbers(pair));
        found.dedup();
        self.found = found;
        self.found.len()
    }

    fn drop_parted(&mut self, escaped: &[u32]) {
        let mut lost = std::mem::take(&mut self.lost);
        for &proxy in escaped {
            let has_parted = |&pair: &usize| !self.overlap(self.pairs.watched[pair].proxies);
            lost.extend(self.pairs.of(proxy).filter(has_parted).map(|pair| pair as u32));
        }
        // From the last one on, so that numbers stay what they are.
        lost.sort_unstable();
        lost.dedup();
        for pair in lost.drain(..).rev() {
            self.touch().note_parting(pair as usize);
            self.touch().remove_pair(pair as usize);
        }
        self.remember_sunk();
        self.lost = lost;
    }

    /// Whether the bounds of two proxies overlap, in all axes that there are.
    fn overlap(&self, [a, b]: [u32; 2]) -> bool {
        let bounds = &self.proxies.bounds;
        overlap(&bounds[a as usize], &bounds[b as usize])
            && self.space.as_ref().is_none_or(|space| space.overlap(a, b))
    }

    /// A pair as it is kept: what gives way less first, else what was created first. None of what gives way nowhere, unless one
    /// of the two is a sensor in 2D, or is one body.
    pub(super) fn ordered(&self, [one, other]: [u32; 2]) -> Option<[u32; 2]> {
        let [proxy, partner] = [one, other].map(|proxy| &self.proxies.all[proxy as usize]);
        let key = |proxy: &Proxy| (proxy.mobility, proxy.number, proxy.piece);
        let may_be_pushed = [proxy, partner].iter().any(|proxy| proxy.mobility == Mobility::Dynamic);
        let senses = self.space.is_none() && !(proxy.responds && partner.responds);
        let may_meet = (may_be_pushed || senses) && self.may_meet_ground([one, other]);
        if proxy.body == partner.body || !may_meet {
            return None;
        }
        Some(if key(proxy) < key(partner) { [one, other] } else { [other, one] })
    }

    /// The geoms of a pair that was found.
    pub(crate) fn candidate(&self, at: usize) -> (GeomId, GeomId) {
        let [a, b] = self.found[at].map(|proxy| &self.proxies.all[proxy as usize]);
        if a.number < b.number { (a.geom, b.geom) } else { (b.geom, a.geom) }
    }

    /// Takes a pair that was found.
    pub(crate) fn accept(&mut self, at: usize) {
        let pair = self.add_pair(self.found[at]);
        if self.pairs.all[pair].is_unpushed {
            self.touch().lay_down(pair);
        } else {
            self.note_new(pair);
        }
    }

    /// A pair of which nothing is known yet.
    pub(super) fn add_pair(&mut self, proxies: [u32; 2]) -> usize {
        let [a, b] = proxies.map(|proxy| &self.proxies.all[proxy as usize]);
        let (responds, is_heard) = (a.responds && b.responds, self.is_heard(proxies));
        let is_unpushed = proxies.iter().all(|&proxy| !self.gives_way(proxy));
        let pair = self.pairs.push(proxies, self.kind(proxies), responds, is_heard);
        self.pairs.set_unpushed(pair, is_unpushed);
        self.pairs.all[pair].is_on_ground =
            self.space.as_ref().is_some_and(|space| space.ground == proxies[0]);
        self.pairs.all[pair].passage = self.first_passage(pair);
        if self.pairs.all[pair].passage != Passage::Closed {
            self.pairs.all[pair].passage = self.ways_ahead().joined(pair);
        }
        self.touch().take_up(pair)
    }

    /// How a pair stands of which nothing else is known.
    pub(super) fn first_passage(&self, pair: usize) -> Passage {
        let is_one_way = |proxy: u32| self.proxies.all[proxy as usize].one_way.is_some();
        if self.pairs.all[pair].responds && self.pairs.watched[pair].proxies.into_iter().any(is_one_way) {
            Passage::Apart
        } else {
            Passage::Closed
        }
    }

    /// Whether something can push a proxy.
    fn gives_way(&self, proxy: u32) -> bool {
        self.proxies.all[proxy as usize].mobility.gives_way()
    }

    /// Whether a handler is asked about a pair in every update in which it touches: of two static bodies it is told when they
    /// begin to touch, and no more.
    pub(super) fn is_heard(&self, proxies: [u32; 2]) -> bool {
        let both = proxies.map(|proxy| &self.proxies.all[proxy as usize]);
        !both.iter().all(|proxy| proxy.mobility == Mobility::Fixed)
            && both.iter().any(|proxy| proxy.is_heard && is_geom(proxy.geom))
    }

    pub(super) fn kind(&self, proxies: [u32; 2]) -> Kind {
        let [a, b] = proxies.map(|proxy| self.proxies.all[proxy as usize].shape);
        let is_fixed = proxies[0] as usize >= self.proxies.first_fixed;
        match &self.space {
            None => Kind { has_two_points: a.count > 0 && b.count > 0, is_fixed, is_in_space: false },
            Some(space) => {
                let has_two_points = !proxies.iter().any(|&proxy| space.is_round(proxy));
                Kind { has_two_points, is_fixed, is_in_space: true }
            }
        }
    }
}
