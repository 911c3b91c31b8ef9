//! Pairs of a sensor and a static or kinematic body, in 2D: neither side can be pushed.
//!
//! Such a pair lies among those of sleeping bodies, so that a static level costs nothing per step. It is looked at in the step
//! in which it is found, whenever one of its proxies gets new bounds, and after a kinematic side has moved.

use super::Precise;

impl Precise {
    /// Looks at the unpushed pairs that may have changed: those of proxies that are new, edited or out of their old bounds, and
    /// those of kinematic bodies that have moved. Returns how many those are.
    pub(super) fn look_at_unpushed(&mut self) -> usize {
        if self.pairs.unpushed == 0 {
            return 0;
        }
        let mut due = std::mem::take(&mut self.lost);
        let unpushed = |pair: &usize| self.pairs.all[*pair].is_unpushed;
        for &proxy in &self.unpushed {
            due.extend(self.pairs.of(proxy).filter(unpushed).map(|pair| pair as u32));
        }
        for &number in &self.bodies.kinematic {
            let of_body = self.pairs.of_body(&self.proxies, number as usize);
            due.extend(of_body.filter(unpushed).filter(|&pair| self.has_moved(pair)).map(|pair| pair as u32));
        }
        due.sort_unstable();
        due.dedup();
        let count = due.len();
        due.drain(..).for_each(|pair| self.touch().look(pair as usize));
        self.lost = due;
        count
    }

    /// Whether a side of a pair has moved since the pair was looked at.
    fn has_moved(&self, pair: usize) -> bool {
        let watch = &self.pairs.watched[pair];
        let [a, b] = watch.proxies.map(|proxy| self.proxies.motion[proxy as usize]);
        a.wrapping_add(b) != watch.since
    }
}
