//! Narrow phase: decides when a pair begins and ceases to touch, and collects the touch events for the game.

use super::stage::{NarrowPhase, ProxyPair};
use super::touch_event::{TouchEvent, TouchKind};
use crate::broad_phase::pairs::UPDATED_BY_SOLVER;
use crate::broad_phase::proxies::{BodyType, Proxy};
use crate::index::PairIndex;
use crate::math::plane::{Vector, difference, dot, sum};

impl NarrowPhase<'_> {
    /// Determines whether a pair touches, emits an event on a change, and sets `motion_tolerance`: the motion of the bodies
    /// that triggers the next update of the pair.
    ///
    /// A pair begins to touch when its separation is negative, when it has an impulse, or when it will close its gap in this
    /// step. Merely speculative contacts do not touch, and are updated in every step. A pair with collision response touches
    /// until its contact ends; a sensor touches while the separation is negative.
    pub(super) fn update_touch_state(&mut self, pair: PairIndex, two: ProxyPair<'_>) {
        let state = *self.pairs.state(pair);
        let is_touching = (state.is_touching && state.responds) || self.touches_now(pair, two);
        if is_touching != state.is_touching {
            self.emit_touch_event(pair, is_touching);
        }
        self.pairs.set_motion_tolerance(
            pair,
            if !(is_touching && state.responds) {
                0
            } else if state.constraint.is_some() && self.are_both_circles(two) {
                UPDATED_BY_SOLVER
            } else {
                (self.parameters.separation_refresh_distance * self.parameters.travel_scale()) as u32
            },
        );
    }

    /// Returns whether a contact point of a pair penetrates, has a normal impulse, or will close its gap in this step.
    fn touches_now(&self, pair: PairIndex, two: ProxyPair<'_>) -> bool {
        let state = *self.pairs.state(pair);
        let cached = self.pairs.manifold(pair);
        let count = cached.point_count();
        let velocity_z = self.normal_velocity_z(two, cached.depth.normal_z);
        let angular_velocity_y =
            if self.rotates_about_y(two.a) { self.bodies.states[two.a.body].velocity[2] } else { 0.0 };
        match state.constraint {
            Some(handle) => self.constraints.points_of(state.kind, handle)[..count]
                .iter()
                .zip(&cached.anchors)
                .any(|(point, anchors)| {
                    let velocity_xy = self.predicted_normal_velocity(two, cached.normal, anchors);
                    let predicted_separation = point.separation
                        + self.dt * (velocity_xy + velocity_z - angular_velocity_y * point.normal_arm_a);
                    point.separation <= 0.0 || point.normal_impulse > 0.0 || predicted_separation <= 0.0
                }),
            None => cached.separations[..count].iter().any(|&separation| separation <= 0.0),
        }
    }

    /// Returns the velocity of B relative to A along the normal after a step of gravity alone, in length units/s. It is
    /// negative for approaching bodies. The array [ax, ay, bx, by] holds the contact point relative to the origins of A and B,
    /// in world axes and length units.
    #[inline(always)]
    pub(crate) fn predicted_normal_velocity(
        &self,
        two: ProxyPair<'_>,
        normal: Vector,
        &[ax, ay, bx, by]: &[f32; 4],
    ) -> f32 {
        let velocity = |proxy: &Proxy, arm: Vector| {
            let Some(state) = self.bodies.states.at(proxy.body) else { return [0.0; 2] };
            let [x, y, spin, _] = state.velocity;
            let spin = if self.rotates_about_y(proxy) { 0.0 } else { spin };
            let gravity_scale = self.bodies.gravity_scales[proxy.body];
            sum(self.gravity_delta.map(|fall| fall * gravity_scale), [x - spin * arm[1], y + spin * arm[0]])
        };
        dot(difference(velocity(two.b, [bx, by]), velocity(two.a, [ax, ay])), normal)
    }

    /// Returns whether the body of a proxy rotates about the vertical axis y. It can only do so in a world with a depth axis.
    pub(super) fn rotates_about_y(&self, proxy: &Proxy) -> bool {
        matches!(proxy.body_type, BodyType::Kinematic | BodyType::Hinged)
            && self.depth.is_some_and(|space| space.turns_about_y(proxy))
    }

    /// Returns the contribution of the z velocities of A and B to their relative normal velocity, in length units/s. `normal_z`
    /// is the z component of the unit normal.
    fn normal_velocity_z(&self, two: ProxyPair<'_>, normal_z: f32) -> f32 {
        if normal_z == 0.0 {
            return 0.0;
        }
        let velocity =
            |proxy: &Proxy| self.bodies.states.at(proxy.body).map_or(0.0, |state| state.velocity[3]);
        normal_z * (velocity(two.b) - velocity(two.a))
    }

    /// Emits an event that a pair begins or ceases to touch, and stores the new touch state in the pair.
    pub(crate) fn emit_touch_event(&mut self, pair: PairIndex, begins: bool) {
        self.pairs.set_touching(pair, begins);
        let proxies = self.pairs.proxies_of(pair).map(|proxy| self.proxies.proxy(proxy));
        let sides = proxies.map(|proxy| (proxy.creation_number, proxy.owner));
        self.touch_events.push(TouchEvent::new(sides, begins, TouchKind::of_proxies(proxies)));
    }
}
