//! What games are told of touches.

use super::Precise;
use super::proxies::Mobility;
use super::touch::{Change, Looks};
use crate::contacts::arbiter::{ArbiterRef, Found};
use crate::contacts::contact::{Contact, ContactId};
use crate::geom::GeomId;
use crate::geom::surface::SetSurface;
use crate::math::Vector2;
use crate::math::plane::{difference, dot, place, rotation, sum, turn, turn_back};
use crate::math::scalar::nearest_finite;
use crate::storage::order::{joined, sort_by_number, sort_numbered};

impl Precise {
    /// Number of pairs, touching or not.
    pub(crate) fn pair_count(&self) -> usize {
        self.pairs.len()
    }

    /// What became of the pairs that were looked at in this step.
    pub(crate) fn looks(&self) -> Looks {
        self.looks
    }

    /// Number of rows of contacts of each colour.
    pub(crate) fn rows_per_colour(&self) -> Vec<usize> {
        self.rows.per_colour()
    }

    /// Number of contacts that are solved.
    pub(crate) fn contacts_solved(&self) -> usize {
        self.rows.point_count()
    }

    /// Creation numbers of the geoms of a pair that touches and was not refused, the smaller one first, as one.
    fn touching_numbers(&self, pair: usize) -> Option<u128> {
        self.pairs.all.get(pair).filter(|state| state.is_told && !state.is_vetoed)?;
        let [a, b] = self.pairs.watched[pair].proxies.map(|proxy| self.proxies.all[proxy as usize].number);
        Some(joined(if a < b { [a, b] } else { [b, a] }))
    }

    /// A pair by its number, if it touches.
    pub(crate) fn touching(&self, pair: usize) -> Option<ArbiterRef<'static>> {
        let state = self.pairs.all.get(pair).filter(|state| state.is_told)?;
        let [a, b] = self.pairs.watched[pair].proxies.map(|proxy| &self.proxies.all[proxy as usize]);
        if self.space.is_some() {
            return None;
        }
        let is_flipped = a.number > b.number;
        let frozen = &self.pairs.frozen[pair];
        let lane = state.home.map(|home| self.rows.lane(state.kind, home));
        let [pose_a, pose_b] = [a, b].map(|proxy| self.bodies.poses[proxy.body as usize]);
        let [ca, sa, cb, sb] = frozen.turns;
        let (turned_a, turned_b) =
            (turn_back([ca, sa], rotation(pose_a)), turn_back([cb, sb], rotation(pose_b)));
        let normal = lane.map_or(frozen.normal, |lane| lane.normal);
        let sign = if is_flipped { -1.0 } else { 1.0 };
        let (first, second) = if is_flipped { (b, a) } else { (a, b) };
        let mut contacts = [Contact::default(); 2];
        for (at, contact) in contacts.iter_mut().enumerate().take(frozen.count as usize) {
            let [ax, ay, bx, by] = frozen.anchors[at];
            let on_a = sum(place(pose_a), turn(turned_a, [ax, ay]));
            let on_b = sum(place(pose_b), turn(turned_b, [bx, by]));
            let apart = frozen.separations[at] + dot(difference(on_b, on_a), normal);
            let point = lane.map(|lane| lane.points[at]);
            let vertex = frozen.features[at] as i32;
            let id = ContactId { geom1: first.number, vertex, geom2: second.number };
            // Bodies may have been put at the end of all numbers since.
            let position = [0, 1].map(|axis| nearest_finite(0.5 * (on_a[axis] + on_b[axis])));
            let position = Vector2::new(position[0], position[1]);
            let normal = Vector2::new(sign * normal[0], sign * normal[1]);
            let separation = nearest_finite(point.map_or(apart, |point| point.separation));
            let impulses = point.map_or((0.0, 0.0), |point| {
                (point.impulse, lane.map_or(0.0, |lane| lane.tangent_impulse) / frozen.count as f32)
            });
            *contact = Contact::new(position, normal, separation, id).with_impulses(impulses.0, impulses.1);
        }
        let geoms = (first.geom, second.geom);
        let friction = self.friction.mix(a.friction, b.friction);
        let contacts = Found::Read(contacts, frozen.count as usize);
        Some(ArbiterRef { handle: pair as u32, geoms, friction, contacts })
    }

    /// What began or ceased to touch in this step, by geoms: each two geoms once, in the order of creation numbers.
    pub(crate) fn take_changes(&mut self) -> Vec<((GeomId, GeomId), bool)> {
        let mut changes = std::mem::take(&mut self.changes);
        sort_by_number(&mut changes, Change::order);
        let of_two_geoms = changes.chunk_by(|one, other| one.numbers == other.numbers);
        of_two_geoms.filter_map(|changes| self.change_of_geoms(changes)).collect()
    }

    /// What changes of their pieces are for two geoms: they touch as long as some pieces do.
    fn change_of_geoms(&self, changes: &[Change]) -> Option<((GeomId, GeomId), bool)> {
        let geoms = changes.first()?.geoms;
        let now = self.pairs_between(geoms).filter(|&pair| self.pairs.all[pair].is_told).count();
        let begun = changes.iter().filter(|change| change.begins).count();
        let before = (now + changes.len() - begun).saturating_sub(begun);
        ((before > 0) != (now > 0)).then_some((geoms, now > 0))
    }

    /// The pairs of the pieces of two geoms.
    pub(super) fn pairs_between(&self, (one, other): (GeomId, GeomId)) -> impl Iterator<Item = usize> + '_ {
        // A chain may have thousands of pieces, and a floor thousands of pairs: the other one is walked along.
        let is_movable = |at: u32| self.proxies.all[at as usize].mobility == Mobility::Dynamic;
        let is_small = self.proxy_of(other, 1).is_none() && self.proxy_of(other, 0).is_some_and(is_movable);
        let (one, other) = if is_small { (one, other) } else { (other, one) };
        let proxies = [self.only_proxy(one), self.only_proxy(other)];
        let (pair, first) = match proxies {
            [Some(one), Some(other)] => (self.pair_of([one, other]), u32::MAX),
            _ => (None, self.proxy_of(other, 0).unwrap_or(u32::MAX)),
        };
        let is_piece =
            move |at: &u32| self.proxies.all.get(*at as usize).is_some_and(|proxy| proxy.geom == other);
        let is_with_one = move |pair: &usize| {
            let proxies = self.pairs.watched[*pair].proxies;
            proxies.iter().any(|&proxy| self.proxies.all[proxy as usize].geom == one)
        };
        let of_pieces = (first..u32::MAX).take_while(is_piece).flat_map(|piece| self.pairs.of(piece));
        pair.into_iter().chain(of_pieces.filter(is_with_one))
    }

    /// The proxy of a geom that has one only.
    fn only_proxy(&self, geom: GeomId) -> Option<u32> {
        self.proxy_of(geom, 0).filter(|_| self.proxy_of(geom, 1).is_none())
    }

    /// The pair of two proxies. The pairs of both are walked by turns: the cost is that of the one with fewer.
    fn pair_of(&self, [one, other]: [u32; 2]) -> Option<usize> {
        let is_between = |pair: &usize| {
            let proxies = self.pairs.watched[*pair].proxies;
            proxies == [one, other] || proxies == [other, one]
        };
        let both = self.pairs.of(one).zip(self.pairs.of(other));
        both.flat_map(|(a, b)| [a, b]).find(is_between)
    }

    /// The geoms of a pair, that with the smaller creation number first.
    pub(crate) fn geoms_of(&self, pair: usize) -> (GeomId, GeomId) {
        let [a, b] = self.pairs.watched[pair].proxies.map(|proxy| &self.proxies.all[proxy as usize]);
        if a.number < b.number { (a.geom, b.geom) } else { (b.geom, a.geom) }
    }

    /// Number of pairs that touch.
    pub(crate) fn touching_count(&self) -> usize {
        self.pairs.touching
    }

    /// Number of contacts of two geoms.
    pub(crate) fn contacts_between(&self, geoms: (GeomId, GeomId)) -> u32 {
        let pairs = self.pairs_between(geoms);
        pairs.filter(|&pair| self.pairs.all[pair].is_told).map(|pair| self.pairs.frozen[pair].count).sum()
    }

    /// The pairs that touch and of which somebody is told, or that only begin to touch, with the creation numbers of their
    /// geoms, in the order of these. To be [handed back](Self::keep_touching).
    pub(crate) fn take_touching(&mut self, changes: &[((GeomId, GeomId), bool)]) -> Vec<(u128, u32)> {
        let mut touching = std::mem::take(&mut self.touching);
        touching.clear();
        let with_numbers = |pair: usize| Some((self.touching_numbers(pair)?, pair as u32));
        let is_heard = |pair: &usize| self.pairs.all[*pair].is_heard;
        let count = if self.pairs.heard > 0 { self.pairs.len() } else { 0 };
        touching.extend((0..count).filter(is_heard).filter_map(with_numbers));
        for &(geoms, _) in changes.iter().filter(|(_, begins)| *begins) {
            let unheard = self.pairs_between(geoms).filter(|pair| !is_heard(pair));
            touching.extend(unheard.filter_map(with_numbers));
        }
        sort_numbered(&mut touching);
        touching
    }

    /// Takes the list back, so that the next one need not be allocated.
    pub(crate) fn keep_touching(&mut self, touching: Vec<(u128, u32)>) {
        self.touching = touching;
    }

    /// A handler has refused what touches here: it pushes nothing in this step.
    pub(crate) fn refuse(&mut self, pair: usize) {
        self.has_handled = true;
        if self.pairs.all[pair].home.is_some() {
            self.note_waking(pair);
        }
        self.pairs.all[pair].is_vetoed = true;
        self.touch().remove_row(pair);
        self.touch().forget_landing(pair);
        // In three axes who is refused has not begun to touch.
        if self.space.is_some() && self.pairs.all[pair].is_told {
            self.touch().tell(pair, false);
        }
        // No row follows it any more.
        self.pairs.watched[pair].tolerance = 0;
    }

    /// A handler may have taken contacts off the list: those push nothing in this step.
    pub(crate) fn keep_contacts(&mut self, pair: usize, contacts: &[Contact]) {
        let Some(touching) = self.touching(pair) else { return };
        let is_kept = |contact: &Contact| contacts.iter().any(|kept| kept == contact);
        if touching.contacts().all(|contact| is_kept(&contact)) {
            return;
        }
        let state = self.pairs.all[pair];
        let Some(home) = state.home else { return };
        self.note_waking(pair);
        let mut lane = self.rows.lane(state.kind, home);
        for (point, contact) in lane.points.iter_mut().zip(touching.contacts()) {
            if !is_kept(&contact) {
                (point.mass, point.impulse, point.held) = (0.0, 0.0, 0.0);
            }
        }
        self.rows.set_lane(state.kind, home, &lane);
        self.has_handled = true;
        self.pairs.all[pair].is_vetoed = true;
    }

    /// A handler lets a pair touch, and may have set something about its surfaces for this step. What sleeps wakes if that is
    /// not what it fell asleep with.
    pub(crate) fn set_surface(&mut self, pair: usize, set: SetSurface) {
        let state = self.pairs.all[pair];
        let is_asleep = pair >= self.pairs.awake;
        let Some(home) = state.home.filter(|_| is_asleep || set != SetSurface::default()) else {
            if is_asleep && state.responds {
                self.note_waking(pair);
            }
            return;
        };
        let mut lane = self.rows.lane(state.kind, home);
        let before = [lane.friction, lane.restitution, lane.tangent_speed];
        let [friction, restitution, speed] = if is_asleep { self.touch().surface(pair) } else { before };
        lane.friction = set.friction.unwrap_or(friction);
        lane.restitution = set.restitution.unwrap_or(restitution);
        // Two that are finite may be more than there are numbers together.
        lane.tangent_speed = set.tangent_speed.map_or(speed, |set| (speed + set).clamp(f32::MIN, f32::MAX));
        if is_asleep && before == [lane.friction, lane.restitution, lane.tangent_speed] {
            return;
        }
        self.note_waking(pair);
        self.bounces |= lane.restitution > 0.0;
        self.rows.set_lane(state.kind, home, &lane);
        self.has_handled = true;
        self.pairs.all[pair].is_set = true;
    }
}
