//! When two touch, which games are told of.

use serde::{Deserialize, Serialize};

use super::{Touch, Two};
use crate::geom::GeomId;
use crate::math::plane::{Vector, difference, dot, sum};
use crate::precise::pairs::BY_ROW;
use crate::precise::proxies::{Mobility, Proxy};
use crate::storage::order::joined;

/// Two geoms begin or cease to touch with one of their pieces, that with the smaller creation number first.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
pub(in crate::precise) struct Change {
    pub(in crate::precise) numbers: (u32, u32),
    pub(in crate::precise) begins: bool,
    pub(in crate::precise) geoms: (GeomId, GeomId),
}

impl Change {
    /// A pair of pieces that begins or ceases to touch, by creation numbers and names of their geoms.
    pub(in crate::precise) fn new(sides: [(u32, GeomId); 2], begins: bool) -> Self {
        let [a, b] = sides;
        let (first, second) = if a < b { (a, b) } else { (b, a) };
        Change { numbers: (first.0, second.0), begins, geoms: (first.1, second.1) }
    }

    /// The order in which changes are told. Slots matter in altered saves alone, where two geoms may have one creation number.
    pub(in crate::precise) fn order(&self) -> u128 {
        let [first, second] = [self.geoms.0, self.geoms.1].map(|geom| geom.slot() as u32);
        joined([self.numbers.0, self.numbers.1, u32::from(self.begins) << 31 | first, second])
    }
}

impl Touch<'_> {
    /// The two touch once their outlines do or push each other, or will in this step: contacts that only reach ahead are not
    /// told. Until then the pair is looked at in every step. They cease to when nothing is near any more; where nothing
    /// pushes, when the outlines part.
    pub(super) fn note_touch(&mut self, pair: usize, two: Two<'_>) {
        let state = self.pairs.all[pair];
        let stays = (state.is_told && state.responds) || self.touches_now(pair, two);
        if stays != state.is_told {
            self.tell(pair, stays);
        }
        self.pairs.watched[pair].tolerance = if !(stays && state.responds) {
            0
        } else if state.home.is_some() && self.are_circles(two) {
            BY_ROW
        } else {
            (self.tuning.checked * self.tuning.motion_scale()) as u32
        };
    }

    fn touches_now(&self, pair: usize, two: Two<'_>) -> bool {
        let state = self.pairs.all[pair];
        let frozen = &self.pairs.frozen[pair];
        let count = frozen.count as usize;
        let along_depth = self.approach_along_depth(two, frozen.space.normal_z);
        let turning =
            if self.turns_upright(two.a) { self.bodies.hot[two.a.body as usize].velocity[2] } else { 0.0 };
        match state.home {
            Some(home) => self.rows.lane(state.kind, home).points[..count].iter().zip(&frozen.anchors).any(
                |(point, anchors)| {
                    let in_plane = self.approach(two, frozen.normal, anchors);
                    let gap = point.separation + self.dt * (in_plane + along_depth - turning * point.arm_a);
                    point.separation <= 0.0 || point.impulse > 0.0 || gap <= 0.0
                },
            ),
            None => frozen.separations[..count].iter().any(|&separation| separation <= 0.0),
        }
    }

    /// Velocity along the normal with which the two will come together in this step, if nothing but gravity changes it.
    #[inline(always)]
    pub(in crate::precise) fn approach(
        &self,
        two: Two<'_>,
        normal: Vector,
        &[ax, ay, bx, by]: &[f32; 4],
    ) -> f32 {
        let velocity = |proxy: &Proxy, arm: Vector| {
            let Some(hot) = self.bodies.hot.get(proxy.body as usize) else { return [0.0; 2] };
            let [x, y, spin, _] = hot.velocity;
            let spin = if self.turns_upright(proxy) { 0.0 } else { spin };
            let part = self.bodies.gravity_parts[proxy.body as usize];
            sum(self.fall.map(|fall| fall * part), [x - spin * arm[1], y + spin * arm[0]])
        };
        dot(difference(velocity(two.b, [bx, by]), velocity(two.a, [ax, ay])), normal)
    }

    /// Whether what something turns about is upright.
    pub(super) fn turns_upright(&self, proxy: &Proxy) -> bool {
        matches!(proxy.mobility, Mobility::Kinematic | Mobility::Hinged)
            && self.space.is_some_and(|space| space.turns(proxy))
    }

    fn approach_along_depth(&self, two: Two<'_>, normal_z: f32) -> f32 {
        if normal_z == 0.0 {
            return 0.0;
        }
        let velocity =
            |proxy: &Proxy| self.bodies.hot.get(proxy.body as usize).map_or(0.0, |hot| hot.velocity[3]);
        normal_z * (velocity(two.b) - velocity(two.a))
    }

    pub(in crate::precise) fn tell(&mut self, pair: usize, begins: bool) {
        self.pairs.set_told(pair, begins);
        let sides = self.pairs.watched[pair].proxies.map(|proxy| {
            let proxy = &self.proxies.all[proxy as usize];
            (proxy.number, proxy.geom)
        });
        self.changes.push(Change::new(sides, begins));
    }
}
