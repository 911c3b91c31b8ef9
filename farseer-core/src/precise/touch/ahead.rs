//! Contacts of fast kinematic bodies with what they will meet within the step.
//!
//! A kinematic body that moves by more than the reach of contacts could penetrate or pass another body before the narrow phase
//! finds a contact. The time of impact of the two, as they move when the step begins, tells whether they meet. The contact is
//! that of the time of impact: its normal, its arms, and as separation the distance that the two approach each other by until
//! then, so that the solver stops them at that time. Speculative contacts of the poses at the beginning of the step (E. Catto,
//! "Continuous Collision", GDC 2013) would have the normal of a moment at which nothing touches, and stop what passes by.

use super::{Touch, Two};
use crate::math::plane::{Pose, dot, scaled};
use crate::precise::flight::{Flyer, Two as Flyers, meet};
use crate::precise::manifold::{Manifold, collide};
use crate::precise::parameters::narrow_phase::IMPACT_TOLERANCE;
use crate::precise::proxies::{Mobility, Proxy};
use crate::precise::space::{Before, Limits};

/// The distances by which two approach each other until their time of impact, in length units.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct Approach {
    /// Along the normal, at each point.
    pub(super) points: [f32; 2],
    /// Change of the distance along the depth axis.
    pub(super) depth: f32,
}

/// A contact at a time of impact.
struct Impact<'a> {
    two: Two<'a>,
    found: Manifold,
    approach: Approach,
}

impl<'a> Touch<'a> {
    /// Makes the contact of a kinematic body and what it will meet within the step, if the pair has none.
    pub(in crate::precise) fn look_ahead(&mut self, pair: usize) {
        let state = &self.pairs.all[pair];
        let is_new = self.pairs.frozen[pair].count == 0 && state.responds && !state.is_vetoed;
        let two = self.two(pair);
        if !is_new || two.b.mobility != Mobility::Dynamic || self.rides_alike(pair, two) {
            return;
        }
        let Some(Impact { two: then, mut found, approach }) = self.impact(pair, two) else { return };
        found.keep_deepest(self.most_contacts);
        if found.count == 0 || (self.proxies.one_way > 0 && self.is_open(pair, two, &found)) {
            return;
        }
        self.looks.made += 1;
        self.pairs.watched[pair].since = self.motion(&self.pairs.watched[pair]);
        self.meet(pair, then, &found, approach);
        self.note_touch(pair, then);
    }

    /// Whether B is in contact with another kinematic body that moves as A does. Against both it slides or rolls as on static
    /// bodies, and the narrow phase tells a seam from a wall.
    fn rides_alike(&self, pair: usize, two: Two<'_>) -> bool {
        let [_, at_b] = self.pairs.watched[pair].proxies;
        self.pairs.of(at_b).any(|other| {
            let carrier = &self.proxies.all[self.pairs.watched[other].proxies[0] as usize];
            other != pair
                && self.pairs.frozen[other].count > 0
                && carrier.mobility == Mobility::Kinematic
                && self.moves_alike(two.a, carrier)
        })
    }

    /// Whether two kinematic bodies move against each other by less than the motion after which contacts are looked at again.
    fn moves_alike(&self, one: &Proxy, other: &Proxy) -> bool {
        let [a, b] = [one, other].map(|proxy| self.bodies.hot[proxy.body as usize].velocity);
        let [x, y, spin, z] = std::array::from_fn(|axis| (b[axis] - a[axis]).abs() * self.dt);
        let turning = spin * (one.shape.reach + other.shape.reach);
        one.body == other.body || x + y + z + turning <= self.tuning.checked
    }

    /// The way of a body within the step: x and y in length units, angle in rad, z in length units. Gravity acts for half of it.
    fn way_ahead(&self, proxy: &Proxy) -> [f32; 4] {
        let body = proxy.body as usize;
        let [x, y, spin, z] = self.bodies.hot[body].velocity.map(|velocity| velocity * self.dt);
        let [fall_x, fall_y] = scaled(self.fall, 0.5 * self.bodies.gravity_parts[body] * self.dt);
        let falls = proxy.mobility == Mobility::Dynamic && !self.sleep.is_asleep(body);
        if falls { [x + fall_x, y + fall_y, spin, z] } else { [x, y, spin, z] }
    }

    fn impact(&self, pair: usize, two: Two<'a>) -> Option<Impact<'a>> {
        let paths = [two.a, two.b].map(|proxy| self.way_ahead(proxy));
        let [a, b] =
            [(two.a, two.pose_a, paths[0]), (two.b, two.pose_b, paths[1])].map(|(proxy, pose, path)| Flyer {
                outline: self.proxies.corners.outline(proxy.shape),
                pose,
                path,
            });
        let flyers = Flyers { a, b };
        let exact = IMPACT_TOLERANCE * self.tuning.speculative;
        let time = match self.space {
            None if flyers.is_free() => None,
            None => meet(0.0, exact, |part| flyers.coming(part)),
            Some(space) => meet(0.0, exact, |part| {
                space.coming(self.pairs.watched[pair].proxies, self.proxies, self.bodies, paths, part)
            }),
        }?;
        let two = Two { pose_a: flyers.a.at(time), pose_b: flyers.b.at(time), ..two };
        let found = self.collide_at(pair, two, paths, time);
        let approach = approach(two, &found, paths, time);
        found.is_within_reach().then_some(Impact { two, found, approach })
    }

    /// The manifold at poses of this time.
    fn collide_at(&self, pair: usize, two: Two<'a>, paths: [[f32; 4]; 2], time: f32) -> Manifold {
        let reach = self.tuning.speculative;
        let [a, b] = [two.a, two.b].map(|proxy| self.proxies.corners.outline(proxy.shape));
        let Some(space) = self.space else { return collide(a, b, two.pose_a, two.pose_b, reach) };
        let [at_a, at_b] = self.pairs.watched[pair].proxies;
        let solid = |at: u32, proxy: &'a Proxy, pose: Pose, path: [f32; 4]| {
            let outline = self.proxies.corners.outline(proxy.shape);
            let mut solid = space.solid(at, proxy, outline, (self.bodies, self.dt));
            solid.move_along(pose, path, time);
            solid
        };
        let sunk = self.sunk_before(pair, two);
        let limits = Limits::new([reach, reach], self.is_fixed(two.a), sunk);
        let a = solid(at_a, two.a, two.pose_a, paths[0]);
        let b = solid(at_b, two.b, two.pose_b, paths[1]);
        space.touch(a, b, Before::Nothing, limits)
    }
}

/// How far the two come together until a time of impact, with their velocities at that time.
fn approach(two: Two<'_>, found: &Manifold, [a, b]: [[f32; 4]; 2], time: f32) -> Approach {
    let velocity = |[x, y, turned, _]: [f32; 4], [rx, ry]: [f32; 2]| [x - turned * ry, y + turned * rx];
    let apart = two.apart();
    let depth = b[3] - a[3];
    let points = found.points.map(|point @ [x, y]| {
        let (of_a, of_b) = (velocity(a, point), velocity(b, [x - apart[0], y - apart[1]]));
        let along = dot([of_b[0] - of_a[0], of_b[1] - of_a[1]], found.normal);
        -time * (along + depth * found.normal_z)
    });
    Approach { points, depth: time * depth }
}
