//! Narrow phase: pairs of a sensor with a static or kinematic body, in 2D. No impulse can move either side.
//!
//! Such a pair is stored among the pairs of sleeping bodies, so that a static level costs nothing per step. The narrow phase
//! updates it in the step in which it is found, when one of its fat AABBs changes, and after a kinematic side has moved.

use super::NarrowPhase;
use crate::index::{PairIndex, ProxyIndex};

impl NarrowPhase<'_> {
    /// Updates the contacts of sensor pairs without a body that impulses can move, as far as they may have changed. Returns the
    /// number of updated pairs. They are the pairs of `searched` proxies, which have a new fat AABB, and the pairs of kinematic
    /// bodies that have moved.
    #[inline]
    pub(crate) fn update_static_sensor_pairs(&mut self, searched: &[ProxyIndex]) -> usize {
        if self.pairs.static_sensor_count == 0 { 0 } else { self.update_moved_sensor_pairs(searched) }
    }

    /// Updates the contacts of sensor pairs: see [`update_static_sensor_pairs`](Self::update_static_sensor_pairs).
    fn update_moved_sensor_pairs(&mut self, searched: &[ProxyIndex]) -> usize {
        let mut dirty = std::mem::take(self.dirty_pairs);
        let is_static_sensor = |pair: &PairIndex| self.pairs.state(*pair).is_static_sensor;
        for &proxy in searched {
            dirty.extend(self.pairs.pairs_of(proxy).filter(is_static_sensor));
        }
        for &number in &self.bodies.kinematic {
            let body_pairs = self.pairs.pairs_of_body(self.proxies, number);
            dirty.extend(body_pairs.filter(is_static_sensor).filter(|&pair| self.pair_has_moved(pair)));
        }
        dirty.sort_unstable();
        dirty.dedup();
        let count = dirty.len();
        dirty.drain(..).for_each(|pair| self.update_contact(pair));
        *self.dirty_pairs = dirty;
        count
    }

    /// Returns whether a proxy of a pair has moved since the last update of the pair.
    fn pair_has_moved(&self, pair: PairIndex) -> bool {
        let trigger = self.pairs.trigger(pair);
        self.total_travel(trigger) != trigger.motion_at_check
    }
}
