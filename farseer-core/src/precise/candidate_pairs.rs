//! Adapter: new pairs of the broad phase, which the simulator filters one by one, and sensors that a fast body crossed, by their geoms.

use super::Precise;
use super::ids::geom_of;
use crate::geom::GeomId;
use crate::geom::filter::{BodyPair, are_separated};
use farseer_precise::index::{DenseIndex, PairIndex, ProxyIndex};

impl Precise {
    /// Returns the number of proxies whose fat AABB has changed since the last [`find_pairs`](farseer_precise::Solver::find_pairs).
    pub(crate) fn refitted_count(&self) -> usize {
        self.solver.proxies.refitted().len()
    }

    /// Returns the geoms of the candidate pair `at`, an index into `new_pairs`. The geom with the smaller creation number is
    /// first.
    pub(crate) fn candidate_geoms(&self, at: usize) -> (GeomId, GeomId) {
        self.geoms_of_proxies(self.solver.new_pairs[at])
    }

    /// Adds the candidate pair `at`, an index into `new_pairs`, to the pairs. Sensor pairs without a body that can move go to
    /// the sleeping pairs.
    pub(crate) fn add_candidate_pair(&mut self, at: usize) {
        let proxies = self.solver.new_pairs[at];
        let pair = self.solver.narrow_phase().add_pair(proxies);
        if self.solver.pairs.state(pair).is_static_sensor {
            self.solver.narrow_phase().sleep_pair(pair);
        } else {
            self.solver.sleep.wake_for_new_pair(&self.solver.pairs, &self.solver.proxies, pair);
        }
    }

    /// Returns the two geoms of a passage through a sensor, the one with the smaller creation number first. `at` is an index
    /// into the passages of the step, which are sorted by creation numbers; `None` beyond the last one.
    pub(crate) fn sensor_passthrough(&self, at: usize) -> Option<(GeomId, GeomId)> {
        self.solver.sensor_passthroughs.get(at).map(|&proxies| self.geoms_of_proxies(proxies))
    }

    /// Returns the geoms of a pair, the one with the smaller creation number first.
    pub(crate) fn geoms_of(&self, pair: usize) -> (GeomId, GeomId) {
        self.geoms_of_proxies(self.solver.pairs.proxies_of(PairIndex::new(pair)))
    }

    /// Returns the geoms of two proxies, the one with the smaller creation number first.
    fn geoms_of_proxies(&self, proxies: [ProxyIndex; 2]) -> (GeomId, GeomId) {
        let [a, b] = proxies.map(|proxy| self.solver.proxies.proxy(proxy));
        if a.creation_number < b.creation_number {
            (geom_of(a), geom_of(b))
        } else {
            (geom_of(b), geom_of(a))
        }
    }
}

/// Returns whether the search of pairs has tested all filters of the candidate pair `at`, an index into `new_pairs`, and no joint
/// keeps its bodies from colliding. `separated` are the pairs of bodies that joints keep from it, sorted.
pub(crate) fn has_plain_filters(precise: &Precise, at: usize, separated: &[BodyPair]) -> bool {
    let (pair, proxies) = (precise.solver.new_pairs[at], &precise.solver.proxies);
    let are_apart = || {
        let [one, other] = pair.map(|proxy| precise.ids.bodies[proxies.body_of(proxy)]);
        one.zip(other).is_some_and(|(one, other)| are_separated(separated, one, other))
    };
    proxies.have_plain_filters(pair) && (separated.is_empty() || !are_apart())
}
