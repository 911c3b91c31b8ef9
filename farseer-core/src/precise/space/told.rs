//! What touches in three axes, as the engine above is told.

use super::parts::{self, SpaceChange, SpacePartner, SpacePoint, SpaceTouch};
use crate::geom::GeomId;
use crate::math::Vector2;
use crate::math::plane::{place, sum};
use crate::math::scalar::nearest_finite;
use crate::precise::Precise;
use crate::precise::grid::overlap;
use crate::precise::pairs::Frozen;

impl Precise {
    /// Whether what touches is known, with all that is told of it: not between loading and the next update.
    pub(crate) fn knows_touches(&self) -> bool {
        self.loaded.is_none()
    }

    /// What began and ceased to touch since this was asked last: two things once each, in the order of creation numbers. What
    /// was refused has not begun.
    pub(crate) fn take_space_changes(&mut self) -> Vec<SpaceChange> {
        let changes = self.take_changes();
        changes.into_iter().filter_map(|(geoms, begins)| self.space_change(geoms, begins)).collect()
    }

    fn space_change(&self, (older, younger): (GeomId, GeomId), begins: bool) -> Option<SpaceChange> {
        let touch = begins.then(|| self.deepest_between((older, younger))).flatten();
        if begins && touch.is_none() {
            return None;
        }
        let (this, partner) = if parts::is_geom(younger) { (younger, older) } else { (older, younger) };
        Some(SpaceChange { this, partner: parts::partner_of(partner), touch })
    }

    /// Of the pieces of two things that touch, those that are deepest in each other.
    fn deepest_between(&self, geoms: (GeomId, GeomId)) -> Option<SpaceTouch> {
        let told = self.pairs_between(geoms).filter(|&pair| self.pairs.all[pair].is_told);
        let touches =
            told.filter_map(|pair| Some((self.pairs.watched[pair].proxies, self.space_touch(pair)?)));
        // The order of pairs is another one after loading, that of pieces is not.
        let order = |(pieces, touch): &([u32; 2], SpaceTouch), (others, other): &([u32; 2], SpaceTouch)| {
            touch.depth().total_cmp(&other.depth()).then_with(|| others.cmp(pieces))
        };
        touches.max_by(order).map(|(_, touch)| touch)
    }

    /// The pairs of a body that are near enough to touch.
    pub(crate) fn space_touches_of(&self, number: usize) -> impl Iterator<Item = SpaceTouch> + '_ {
        self.pairs.of_body(&self.proxies, number).filter_map(|pair| self.space_touch(pair))
    }

    /// The geoms near a body that push it when they touch it, once for each pair of pieces.
    pub(crate) fn space_neighbours_of(&self, number: usize) -> impl Iterator<Item = GeomId> + '_ {
        let others = self.proxies.of(number).flat_map(move |proxy| {
            self.pairs.of(proxy).filter(|&pair| self.pushes(pair)).map(move |pair| {
                let [a, b] = self.pairs.watched[pair].proxies;
                if a == proxy { b } else { a }
            })
        });
        others.map(|other| self.proxies.all[other as usize].geom).filter(|&geom| parts::is_geom(geom))
    }

    /// The geoms of a body, and what a handler has refused to let them touch in the last step.
    pub(crate) fn space_refused_of(
        &self,
        number: usize,
    ) -> impl Iterator<Item = (GeomId, SpacePartner)> + '_ {
        let refused =
            self.pairs.of_body(&self.proxies, number).filter(|&pair| self.pairs.all[pair].is_vetoed);
        refused.map(move |pair| {
            let [a, b] = self.pairs.watched[pair].proxies.map(|proxy| &self.proxies.all[proxy as usize]);
            let (this, other) = if a.body as usize == number { (a, b) } else { (b, a) };
            (this.geom, parts::partner_of(other.geom))
        })
    }

    /// Calls for the geoms whose bounds overlap a box, from the least to the greatest x, y (down) and z in length units: in no order,
    /// and for some of them twice.
    pub(crate) fn for_each_geom_in(&self, low: [f32; 3], high: [f32; 3], mut find: impl FnMut(GeomId)) {
        let Some(space) = &self.space else { return };
        let (bounds, depths) = ([low[0], low[1], high[0], high[1]], parts::Depths::new(low[2], high[2]));
        self.grid.for_each_overlap(&[low[0], low[2], high[0], high[2]], |at| {
            let (at, geom) = (at as usize, self.proxies.all[at as usize].geom);
            let is_near = overlap(&bounds, &self.proxies.bounds[at]) && space.depths(at).overlap(depths);
            if is_near && parts::is_geom(geom) {
                find(geom);
            }
        });
    }

    fn pushes(&self, pair: usize) -> bool {
        let state = &self.pairs.all[pair];
        state.responds && !state.is_vetoed
    }

    /// Number of pairs with the ground that touch.
    pub(crate) fn on_ground_count(&self) -> usize {
        self.pairs.on_ground
    }

    /// What touches and has a side that listens, with the number of each pair.
    pub(crate) fn space_touches_heard(&self) -> impl Iterator<Item = (usize, SpaceTouch)> + '_ {
        let count = if self.pairs.heard > 0 { self.pairs.len() } else { 0 };
        let is_heard = |pair: &usize| self.pairs.all[*pair].is_told && self.pairs.all[*pair].is_heard;
        (0..count).filter(is_heard).filter_map(|pair| Some((pair, self.space_touch(pair)?)))
    }

    /// A pair by its number, if it is near enough to touch. The younger geom is told, and the one that has a partner which is no geom.
    pub(crate) fn space_touch(&self, pair: usize) -> Option<SpaceTouch> {
        let state = self.pairs.all.get(pair).filter(|state| !state.is_vetoed)?;
        let space = self.space.as_ref()?;
        let proxies = self.pairs.watched[pair].proxies;
        let [a, b] = proxies.map(|proxy| &self.proxies.all[proxy as usize]);
        // Normals point from A to B.
        let is_b = !parts::is_geom(a.geom) || a.number < b.number;
        let (this, partner, sign) = if is_b { (b, a, 1.0) } else { (a, b, -1.0) };
        let (z, partner_body) = if parts::is_geom(partner.geom) {
            (space.middle(proxies, [a.body, b.body]), self.bodies.ids[partner.body as usize])
        } else {
            (space.places[this.body as usize], None)
        };
        let Frozen { normal: [x, y], count, anchors, separations, features, space: frozen, .. } =
            &self.pairs.frozen[pair];
        if *count == 0 {
            return None;
        }
        let lane = state.home.map(|home| self.rows.lane(state.kind, home));
        // As they are now: a row may know only after the next step that they were edited.
        let surface = lane.map(|_| space.surface(proxies, [a, b], self.friction));
        let [friction, restitution] = surface.unwrap_or_default();
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
                position: Vector2::new(nearest_finite(px), nearest_finite(py)),
                separation: nearest_finite(separation),
                feature: features[at],
                impulse,
                friction_impulse,
            };
        }
        Some(SpaceTouch {
            this: this.geom,
            body: self.bodies.ids[this.body as usize]?,
            partner: parts::partner_of(partner.geom),
            pieces: [this.piece, partner.piece],
            partner_body,
            normal: [sign * x, sign * y, sign * frozen.normal_z],
            z,
            count: *count as usize,
            points,
            friction,
            restitution,
            responds: state.responds,
            is_told: state.is_told,
        })
    }
}

impl SpaceTouch {
    /// How deep the two are in each other.
    fn depth(&self) -> f32 {
        self.points[..self.count]
            .iter()
            .fold(f32::NEG_INFINITY, |deepest, point| deepest.max(-point.separation))
    }
}
