//! Narrow phase in three axes: the penetration that a body had in its last static contacts.
//!
//! A body that rests on a face penetrates the face by some depth under its load. When it slides on, it penetrates the next
//! flush face by that depth, too. The collision routines use the previous penetration as a tolerance, so that the rim of the
//! next face is no obstacle.

use super::{NarrowPhase, ProxyPair};
use crate::broad_phase::pairs::Pair;
use crate::broad_phase::proxies::BodyType;
use crate::index::{BodyIndex, PairIndex};

impl NarrowPhase<'_> {
    /// Returns the largest penetration of B in its present contacts and in the last static contact that ended, in length
    /// units, at least 0. The result is `f32::MAX` if A is dynamic, since bodies on top of A may press A deeper. It is 0 for spheres and for
    /// the ground, which has no edges.
    pub(super) fn previous_penetration(&self, pair: PairIndex, two: ProxyPair<'_>) -> f32 {
        let state = self.pairs.state(pair);
        if !state.kind.has_two_points || state.is_on_ground {
            return 0.0;
        }
        if two.a.body_type == BodyType::Dynamic { f32::MAX } else { self.body_penetration(two.b.body) }
    }

    /// Returns the largest penetration of a body in its present contacts and in the last static contact that ended, in length
    /// units, >= 0.
    fn body_penetration(&self, body: BodyIndex) -> f32 {
        let stored = self.depth.map_or(0.0, |space| space.residual_penetration(body));
        let depths = self.pairs.pairs_of_body(self.proxies, body).map(|pair| self.pair_penetration(pair));
        depths.fold(stored, |deepest, depth| if depth > deepest { depth } else { deepest })
    }

    /// Returns the present penetration of a pair in length units, >= 0; 0 if it has no contact constraint.
    fn pair_penetration(&self, pair: PairIndex) -> f32 {
        let cached = self.pairs.manifold(pair);
        if !self.pairs.has_constraint(pair) {
            return 0.0;
        }
        let separations = self.current_separations(cached, self.proxy_pair(pair));
        let points = &separations[..cached.point_count()];
        points
            .iter()
            .fold(0.0, |deepest, separation| if -separation > deepest { -separation } else { deepest })
    }

    /// Appends the dynamic body and penetration of a pair whose contact with a static or kinematic body ends to
    /// `ended_static_contacts`.
    pub(crate) fn record_separation(&mut self, pair: PairIndex) {
        if self.depth.is_none() {
            return;
        }
        let Pair { kind, constraint: handle, .. } = *self.pairs.state(pair);
        let two = self.proxy_pair(pair);
        if handle.is_none() || !kind.has_two_points || two.a.body_type.takes_impulses() {
            return;
        }
        self.ended_static_contacts.push((two.b.body, self.pair_penetration(pair).min(f32::MAX)));
    }
}
