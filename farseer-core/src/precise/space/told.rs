//! What touches in three axes, as the engine above is told.

use super::parts::{self, SpacePoint, SpaceTouch};
use crate::math::Vector2;
use crate::math::plane::{place, sum};
use crate::precise::Precise;
use crate::precise::pairs::Frozen;

impl Precise {
    /// A pair by its number, if it is near enough to touch. The younger geom is told, and the one that has a partner which is no geom.
    pub(crate) fn space_touch(&self, pair: usize) -> Option<SpaceTouch> {
        let state = self.pairs.all.get(pair).filter(|state| !state.is_vetoed)?;
        self.space.as_ref()?;
        let [a, b] = self.pairs.watched[pair].proxies.map(|proxy| &self.proxies.all[proxy as usize]);
        // Normals point from A to B.
        let is_b = !parts::is_geom(a.geom) || a.number < b.number;
        let (this, partner, sign) = if is_b { (b, a, 1.0) } else { (a, b, -1.0) };
        let Frozen { normal: [x, y], count, anchors, separations, features, space: frozen, .. } =
            &self.pairs.frozen[pair];
        if *count == 0 {
            return None;
        }
        let lane = state.home.map(|home| self.rows.lane(state.kind, home));
        let origin = place(self.bodies.poses[a.body as usize]);
        let mut points = [SpacePoint::default(); 2];
        for (at, point) in points.iter_mut().enumerate().take(*count as usize) {
            let [ax, ay, ..] = anchors[at];
            let [px, py] = sum(origin, [ax, ay]);
            let (impulse, friction_impulse, separation) =
                lane.map_or((0.0, [0.0; 2], separations[at]), |lane| {
                    let [.., along, across] = lane.space.totals;
                    let shared = [along, across].map(|total| total / *count as f32);
                    (lane.space.totals[at], shared, lane.points[at].separation)
                });
            *point = SpacePoint {
                position: Vector2::new(px, py),
                separation,
                feature: features[at],
                impulse,
                friction_impulse,
            };
        }
        Some(SpaceTouch {
            this: this.geom,
            body: self.bodies.ids[this.body as usize]?,
            partner: parts::partner_of(partner.geom),
            normal: [sign * x, sign * y, sign * frozen.normal_z],
            count: *count as usize,
            points,
            friction: lane.map_or(0.0, |lane| lane.friction),
            restitution: lane.map_or(0.0, |lane| lane.restitution),
            responds: state.responds,
            is_told: state.is_told,
        })
    }
}
