//! Narrow phase: hits, which are contact points that close at speed in this step.
//!
//! The approach speed is taken before the solver (as in Box2D 3, `solver.c`, which takes it when constraints are prepared). It
//! counts if the point touches already or will close its gap in this step.

use super::stage::NarrowPhase;
use super::touch_event::WantedEvent;
use crate::broad_phase::proxies::Proxy;
use crate::index::PairIndex;
use crate::math::plane::{Vector, dot, sum, translation};

/// Contact point of two convex pieces that closes at speed.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PieceHit {
    /// Creation numbers of the geoms of A and B.
    pub numbers: [u32; 2],
    /// [Owners](Proxy::owner) of A and B, numbers of their geoms.
    pub owners: [u64; 2],
    /// Unit normal from A to B, dimensionless, world axes.
    pub normal: Vector,
    /// World position of the contact point, length units.
    pub point: Vector,
    /// Speed at which the point closes, length units/s, > 0.
    pub speed: f32,
}

impl PieceHit {
    /// Swaps A and B.
    pub fn flip(&mut self) {
        self.numbers.swap(0, 1);
        self.owners.swap(0, 1);
        self.normal = self.normal.map(|part| -part);
    }
}

impl NarrowPhase<'_> {
    /// Appends the fastest point of each awake pair that wants hits and closes faster than `min_speed` (length units/s, >= 0).
    pub fn list_hits(&self, min_speed: f32, hits: &mut Vec<PieceHit>) {
        for pair in self.pairs.awake() {
            let state = self.pairs.state(pair);
            if !(state.is_touching && state.responds) || state.is_vetoed {
                continue;
            }
            let [a, b] = self.pairs.proxies_of(pair).map(|proxy| self.proxies.proxy(proxy));
            if (a.events | b.events) & WantedEvent::HIT != 0 {
                hits.extend(self.fastest_point(pair, [a, b]).filter(|hit| hit.speed > min_speed));
            }
        }
    }

    /// Returns the point of a pair that closes fastest, among those that touch or will do so in this step.
    fn fastest_point(&self, pair: PairIndex, [a, b]: [&Proxy; 2]) -> Option<PieceHit> {
        let state = self.pairs.state(pair);
        let manifold = self.pairs.manifold(pair);
        let constraint = self.constraints.get(state.kind, state.constraint?);
        let mut fastest: Option<PieceHit> = None;
        for (point, anchors) in constraint.points.iter().zip(&manifold.anchors).take(manifold.point_count()) {
            let speed = self.closing_speed([a, b], manifold.normal, anchors);
            let closes = point.separation - self.dt * speed <= 0.0;
            if closes && fastest.is_none_or(|best| speed > best.speed) {
                let [ax, ay, ..] = *anchors;
                fastest = Some(PieceHit {
                    numbers: [a.creation_number, b.creation_number],
                    owners: [a.owner, b.owner],
                    normal: manifold.normal,
                    point: sum(translation(self.bodies.poses[a.body]), [ax, ay]),
                    speed,
                });
            }
        }
        fastest
    }

    /// Returns the speed at which a contact point closes, length units/s: minus the relative velocity of B along the normal.
    fn closing_speed(&self, [a, b]: [&Proxy; 2], normal: Vector, &[ax, ay, bx, by]: &[f32; 4]) -> f32 {
        let velocity = |proxy: &Proxy, [x, y]: Vector| {
            let Some(state) = self.bodies.states.at(proxy.body) else { return [0.0; 2] };
            let [vx, vy, spin, _] = state.velocity;
            [vx - spin * y, vy + spin * x]
        };
        let ([avx, avy], [bvx, bvy]) = (velocity(a, [ax, ay]), velocity(b, [bx, by]));
        dot([avx - bvx, avy - bvy], normal)
    }
}
