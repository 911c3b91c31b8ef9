//! Adapter: contact queries and begin and end events in three axes, for the engine above (`twohalf`).
//! Only with the feature `space`.
//!
//! Translates pairs to geoms, world boxes and the ground. The numbers come from the
//! [contact reader](farseer_precise::narrow_phase::contact_reader).

use super::Precise;
use super::contact_events::TouchChange;
use super::depth_contact::{DepthContact, DepthContactEvent, DepthContactTarget, contact_target_of};
use super::world_boxes::is_geom;
use crate::geom::GeomId;
use crate::precise::ids::geom_of;
use farseer_precise::broad_phase::hash_grid::overlap;
use farseer_precise::depth::interface::DepthInterval;
use farseer_precise::index::{BodyIndex, DenseIndex, PairIndex, ProxyIndex};

impl Precise {
    /// Returns whether the cached contacts are valid. Between loading a snapshot and the next update they are not.
    pub(crate) fn depth_contacts_are_valid(&self) -> bool {
        self.loaded.is_none()
    }

    /// Returns and clears the begin and end events since the last call, ordered by creation numbers. Two geoms have one event,
    /// whatever the number of their convex pieces. A contact that a callback has vetoed does not begin.
    pub(crate) fn drain_depth_contact_events(&mut self) -> Vec<DepthContactEvent> {
        let changes = self.drain_touch_events();
        let event = |change: TouchChange| self.depth_contact_event(change.geoms, change.begins);
        changes.into_iter().filter_map(event).collect()
    }

    /// Returns the contact event of two geoms, with the manifold of deepest penetration if the contact begins. `None` if the
    /// contact begins without a manifold.
    fn depth_contact_event(
        &self,
        (older, younger): (GeomId, GeomId),
        begins: bool,
    ) -> Option<DepthContactEvent> {
        let touch = begins.then(|| self.deepest_contact_between((older, younger))).flatten();
        if begins && touch.is_none() {
            return None;
        }
        let (this, partner) = if is_geom(younger) { (younger, older) } else { (older, younger) };
        Some(DepthContactEvent { this, target: contact_target_of(partner), contact: touch })
    }

    /// Returns the manifold of deepest penetration among the touching convex pieces of two geoms; `None` if no pieces touch.
    fn deepest_contact_between(&self, geoms: (GeomId, GeomId)) -> Option<DepthContact> {
        let touching = self.pairs_between(geoms).filter(|&pair| self.solver.pairs.is_touching(pair));
        let touches =
            touching.filter_map(|pair| Some((self.solver.pairs.proxies_of(pair), self.depth_contact(pair)?)));
        // Ties: by pieces. Loading a snapshot reorders pairs, but not pieces.
        let order = |(pieces, touch): &([ProxyIndex; 2], DepthContact),
                     (others, other): &([ProxyIndex; 2], DepthContact)| {
            touch.penetration().total_cmp(&other.penetration()).then_with(|| others.cmp(pieces))
        };
        touches.max_by(order).map(|(_, touch)| touch)
    }

    /// Iterates over the contact manifolds of a body. Shapes that are only within the contact margin have one, too.
    pub(crate) fn depth_contacts_of(&self, body_index: BodyIndex) -> impl Iterator<Item = DepthContact> + '_ {
        self.solver
            .pairs
            .pairs_of_body(&self.solver.proxies, body_index)
            .filter_map(|pair| self.depth_contact(pair))
    }

    /// Iterates over the geoms that form a broad-phase pair with a body, touching or not. Pairs with a sensor or a vetoed
    /// contact are left out. A geom occurs once for each pair of convex pieces.
    pub(crate) fn depth_neighbours_of(&self, body_index: BodyIndex) -> impl Iterator<Item = GeomId> + '_ {
        let solver = &self.solver;
        let others = solver.proxies.proxies_of(body_index).flat_map(move |proxy| {
            solver.pairs.pairs_of(proxy).filter(|&pair| solver.pairs.state(pair).has_response()).map(
                move |pair| {
                    let [a, b] = solver.pairs.proxies_of(pair);
                    if a == proxy { b } else { a }
                },
            )
        });
        let others = others.map(|other| solver.proxies.proxy(other));
        others.filter(|proxy| !proxy.is_world).map(geom_of)
    }

    /// Iterates over the contacts of a body that a callback vetoed in the last step. Each item is the geom of the body and the
    /// contact target.
    pub(crate) fn vetoed_depth_contacts_of(
        &self,
        body_index: BodyIndex,
    ) -> impl Iterator<Item = (GeomId, DepthContactTarget)> + '_ {
        let solver = &self.solver;
        let refused = solver
            .pairs
            .pairs_of_body(&solver.proxies, body_index)
            .filter(|&pair| solver.pairs.state(pair).is_vetoed);
        refused.map(move |pair| {
            let [a, b] = solver.pairs.proxies_of(pair).map(|proxy| solver.proxies.proxy(proxy));
            let (this, other) = if a.body == body_index { (a, b) } else { (b, a) };
            (geom_of(this), contact_target_of(geom_of(other)))
        })
    }

    /// Calls `find` for the geoms whose fat AABB and z interval overlap a box. `low` and `high` are the least and the greatest
    /// corner of the box: x, y (down) and z in world coordinates, length units. The order is not defined; some geoms come
    /// twice.
    pub(crate) fn for_each_geom_in(&self, low: [f32; 3], high: [f32; 3], mut find: impl FnMut(GeomId)) {
        let Some(space) = &self.solver.depth else { return };
        let (bounds, depths) = ([low[0], low[1], high[0], high[1]], DepthInterval::new(low[2], high[2]));
        self.solver.grid.for_each_overlap(&[low[0], low[2], high[0], high[2]], |at| {
            let proxy = self.solver.proxies.proxy(at);
            let is_near =
                overlap(&bounds, self.solver.proxies.fat_aabb_of(at)) && space.interval(at).overlaps(depths);
            if is_near && !proxy.is_world {
                find(geom_of(proxy));
            }
        });
    }

    /// Returns the number of proxies that touch the ground.
    pub(crate) fn ground_contact_count(&self) -> usize {
        self.solver.pairs.touching_ground_count
    }

    /// Iterates over touching pairs with an event listener. Each item is the index of the pair and its contact manifold.
    pub(crate) fn depth_contacts_with_listener(&self) -> impl Iterator<Item = (usize, DepthContact)> + '_ {
        let solver = &self.solver;
        let is_heard =
            |pair: &PairIndex| solver.pairs.is_touching(*pair) && solver.pairs.state(*pair).is_reported;
        let pairs = solver.pairs.indices().filter(|_| solver.pairs.reported_count > 0).filter(is_heard);
        pairs.filter_map(|pair| Some((pair.position(), self.depth_contact(pair)?)))
    }

    /// Returns the contact manifold of the pair with this index. `None` if the shapes are beyond the contact margin or a
    /// callback vetoed the pair. The manifold is reported for the younger geom, or for the only geom if the target is a world
    /// box or the ground.
    pub(crate) fn depth_contact(&self, pair: PairIndex) -> Option<DepthContact> {
        let solver = &self.solver;
        let state = solver.pairs.get(pair).filter(|state| !state.is_vetoed)?;
        let space = solver.depth.as_ref()?;
        let contact = solver.contact_reader().spatial_contact(pair)?;
        let proxies = solver.pairs.proxies_of(pair);
        let [a, b] = proxies.map(|proxy| solver.proxies.proxy(proxy));
        // Normals point from A to B.
        let is_b = a.is_world || a.creation_number < b.creation_number;
        let (this, partner, sign) = if is_b { (b, a, 1.0) } else { (a, b, -1.0) };
        let (z, target_body) = if partner.is_world {
            (space.z_positions[this.body], None)
        } else {
            (space.overlap_middle_z(proxies, [a.body, b.body]), self.ids.bodies[partner.body])
        };
        let [friction, restitution] = contact.surface;
        Some(DepthContact {
            this: geom_of(this),
            body: self.ids.bodies[this.body]?,
            target: contact_target_of(geom_of(partner)),
            pieces: [this.piece, partner.piece],
            target_body,
            normal: contact.normal.map(|part| sign * part),
            z,
            count: contact.count,
            points: contact.points,
            friction,
            restitution,
            responds: state.responds,
            is_touching: state.is_touching,
        })
    }
}

impl DepthContact {
    /// Returns the greatest penetration among the contact points in length units, negative for separated shapes.
    fn penetration(&self) -> f32 {
        self.points[..self.count]
            .iter()
            .fold(f32::NEG_INFINITY, |deepest, point| deepest.max(-point.separation))
    }
}
