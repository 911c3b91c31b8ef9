//! Narrow phase: contacts of two circles. The solver computes them in every substep while they touch.

use super::{NarrowPhase, ProxyPair};
use crate::broad_phase::proxies::Proxy;
use crate::contact_solver::soft_step::{update_circle_contact, update_circle_contacts};
use crate::index::PairIndex;
use crate::math::plane::{difference, scaled, sum};
use crate::narrow_phase::manifold::{Manifold, circles_at_toi};

impl NarrowPhase<'_> {
    /// Computes normals and separations of all touching circles for the present poses. Pairs that are separated by more than
    /// the speculative distance get a full update. Returns their number.
    #[inline]
    pub(crate) fn update_circles(&mut self) -> usize {
        let mut separated = std::mem::take(self.dirty_pairs);
        let speculative_distance = self.parameters.speculative_distance;
        let (poses, circles) = (&self.bodies.poses, &self.bodies.circles);
        let one_point = &mut self.constraints.one_point;
        update_circle_contacts(one_point, poses, circles, speculative_distance, |pair| separated.push(pair));
        self.constraints.update_direct_constraints(|lane| {
            let is_separated = update_circle_contact(lane, poses, circles, speculative_distance);
            separated.extend((is_separated == Some(true)).then_some(lane.pair));
            is_separated.is_some()
        });
        separated.sort_unstable();
        let count = separated.len();
        separated.drain(..).for_each(|pair| self.update_contact(pair));
        *self.dirty_pairs = separated;
        count
    }

    /// Returns the contact of two circles at their time of impact if they approach each other, else `manifold`. The impulse
    /// then acts along the line of centres at that time, which differs from the lines at either end of the step.
    pub(super) fn circle_contact_at_toi(&self, two: ProxyPair<'_>, manifold: Manifold) -> Manifold {
        let displacement = |proxy: &Proxy| {
            let (body, gravity_scale) = (proxy.body, self.bodies.gravity_scales[proxy.body]);
            let gravity_displacement = scaled(self.gravity_delta, 0.5 * gravity_scale * self.dt);
            self.bodies.states.at(body).map_or([0.0; 2], |state| {
                sum(gravity_displacement, scaled([state.velocity[0], state.velocity[1]], self.dt))
            })
        };
        let displacement = difference(displacement(two.b), displacement(two.a));
        let radii = [two.a.shape.radius, two.b.shape.radius];
        circles_at_toi(two.offset(), displacement, radii).unwrap_or(manifold)
    }

    /// Returns whether both bodies of two proxies are single circles about their origins, in 2D.
    #[inline(always)]
    pub(super) fn are_both_circles(&self, two: ProxyPair<'_>) -> bool {
        if self.depth.is_some() {
            return false;
        }
        let is_circle = |proxy: &Proxy| self.bodies.circles.at(proxy.body).is_some_and(|row| row[3] > 0.0);
        is_circle(two.a) && is_circle(two.b)
    }

    /// Returns whether both bodies of a pair are single circles about their origins, in 2D.
    pub fn is_circle_pair(&self, pair: PairIndex) -> bool {
        self.are_both_circles(self.proxy_pair(pair))
    }
}
