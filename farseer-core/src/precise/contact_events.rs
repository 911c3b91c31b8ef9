//! Adapter: contact events and contacts as the API shows them, and changes that handlers make to contacts.
//!
//! The module translates between geoms and pairs: touch events and [arbiters](ArbiterRef) out, changes by handlers in. Handlers
//! may disable a contact, remove points or override surface properties for one step.

use super::Precise;
use super::contact_points::contacts_of;
use crate::contacts::arbiter::{ArbiterRef, ContactSource};
use crate::contacts::contact::Contact;
use crate::geom::GeomId;
use crate::precise::ids::geom_of;
use crate::storage::order::{packed_key, sort_by_number, sort_numbered};
use farseer_precise::broad_phase::pairs::Pairs;
use farseer_precise::broad_phase::proxies::{BodyType, Proxies};
use farseer_precise::index::{DenseIndex, PairIndex, ProxyIndex};
use farseer_precise::narrow_phase::{NarrowPhaseStats, TouchEvent, TouchKind};
use farseer_precise::surface::SurfaceOverride;

/// Two geoms that begin or cease to touch.
#[derive(Debug, Clone, Copy)]
pub(crate) struct TouchChange {
    /// The geoms, the one with the smaller creation number first.
    pub(crate) geoms: (GeomId, GeomId),
    /// Whether the touch begins; false if it ends.
    pub(crate) begins: bool,
    /// Number of contact points between the two geoms.
    pub(crate) contacts: u32,
    /// Kind of the typed event.
    pub(crate) kind: TouchKind,
}

impl Precise {
    /// Returns the number of pairs, touching or not.
    pub(crate) fn pair_count(&self) -> usize {
        self.solver.pairs.count()
    }

    /// Returns the numbers of computed and of recycled manifolds in this step.
    pub(crate) fn narrow_phase_stats(&self) -> NarrowPhaseStats {
        self.solver.narrow_phase_stats
    }

    /// Returns the number of contact constraints in each graph colour.
    pub(crate) fn constraints_per_color(&self) -> Vec<usize> {
        self.solver.constraints.constraints_per_color()
    }

    /// Returns the number of contact points in both solvers.
    pub(crate) fn contacts_solved(&self) -> usize {
        self.solver.constraints.point_count()
    }

    /// Returns the arbiter of a pair: the touching geoms with their contacts. `None` if the pair does not touch, and in three
    /// axes.
    pub(crate) fn arbiter_of_pair(&self, pair: usize) -> Option<ArbiterRef<'static>> {
        let (solver, pair) = (&self.solver, PairIndex::new(pair));
        solver.pairs.get(pair).filter(|state| state.is_touching && solver.depth.is_none())?;
        let contact = solver.contact_reader().planar_contact(pair);
        let numbers = solver.pairs.proxies_of(pair).map(|proxy| solver.proxies.proxy(proxy).creation_number);
        let contacts = ContactSource::Copied(contacts_of(&contact, numbers), contact.count);
        let friction = contact.friction;
        Some(ArbiterRef { handle: pair.0, geoms: self.geoms_of(pair.position()), friction, contacts })
    }

    /// Removes and returns the touch events since the last call, in the order of creation numbers. Each pair of geoms occurs
    /// once.
    pub(crate) fn drain_touch_events(&mut self) -> Vec<TouchChange> {
        let mut events = std::mem::take(&mut self.solver.touch_events);
        sort_by_number(&mut events, TouchEvent::sort_key);
        let by_geoms = events.chunk_by(|one, other| one.numbers == other.numbers);
        by_geoms.filter_map(|changes| self.geom_touch_event(changes)).collect()
    }

    /// Returns the touch event of two geoms from `events` of their convex pieces. Two geoms touch while at least one pair of
    /// their pieces does. `None` if that has not changed.
    fn geom_touch_event(&self, events: &[TouchEvent]) -> Option<TouchChange> {
        let TouchEvent { owners, kind, .. } = *events.first()?;
        let [one, other] = owners.map(GeomId::from_bits);
        let geoms = (one, other);
        let are_single = || self.single_proxy(one).is_some() && self.single_proxy(other).is_some();
        if let [TouchEvent { begins: false, .. }] = events
            && are_single()
        {
            // The only pair of both has ceased to touch; it need not be found. Only a damaged snapshot may have two pairs of them.
            return Some(TouchChange { geoms, begins: false, contacts: 0, kind });
        }
        let pairs = &self.solver.pairs;
        let touching = self.pairs_between(geoms).filter(|&pair| pairs.is_touching(pair));
        let (touching_now, contacts) = touching
            .fold((0, 0), |(count, contacts), pair| (count + 1, contacts + pairs.manifold(pair).count));
        let begun = events.iter().filter(|change| change.begins).count();
        let touching_before = (touching_now + events.len() - begun).saturating_sub(begun);
        let begins = touching_now > 0;
        ((touching_before > 0) != begins).then_some(TouchChange { geoms, begins, contacts, kind })
    }

    /// Returns the indices of the pairs between the convex pieces of two geoms.
    pub(super) fn pairs_between(
        &self,
        (one, other): (GeomId, GeomId),
    ) -> impl Iterator<Item = PairIndex> + '_ {
        let solver = &self.solver;
        // A chain may have thousands of pieces, and a floor thousands of pairs, so the pieces of the smaller geom are searched.
        let is_movable = |at: ProxyIndex| solver.proxies.proxy(at).body_type == BodyType::Dynamic;
        let is_small = self.proxy_of(other, 1).is_none() && self.proxy_of(other, 0).is_some_and(is_movable);
        let (one, other) = if is_small { (one, other) } else { (other, one) };
        let proxies = [self.single_proxy(one), self.single_proxy(other)];
        let (pair, first) = match proxies {
            [Some(one), Some(other)] => (solver.pairs.find([one, other]), None),
            _ => (None, self.proxy_of(other, 0)),
        };
        let is_piece =
            move |at: &ProxyIndex| solver.proxies.get(*at).is_some_and(|proxy| geom_of(proxy) == other);
        let is_with_one = move |pair: &PairIndex| {
            let proxies = solver.pairs.proxies_of(*pair);
            proxies.iter().any(|&proxy| geom_of(solver.proxies.proxy(proxy)) == one)
        };
        let of_pieces = std::iter::successors(first, |piece| Some(piece.next()))
            .take_while(is_piece)
            .flat_map(|piece| solver.pairs.pairs_of(piece));
        pair.into_iter().chain(of_pieces.filter(is_with_one))
    }

    /// Returns the index of the proxy of a geom that has exactly one; else `None`.
    fn single_proxy(&self, geom: GeomId) -> Option<ProxyIndex> {
        self.proxy_of(geom, 0).filter(|_| self.proxy_of(geom, 1).is_none())
    }

    /// Returns the number of pairs that touch.
    pub(crate) fn touching_count(&self) -> usize {
        self.solver.pairs.touching_count
    }

    /// Returns the number of contact points between two geoms.
    pub(crate) fn contacts_between(&self, geoms: (GeomId, GeomId)) -> u32 {
        let pairs = self.pairs_between(geoms);
        pairs
            .filter(|&pair| self.solver.pairs.is_touching(pair))
            .map(|pair| self.solver.pairs.manifold(pair).count)
            .sum()
    }

    /// Returns the pairs that touch and have a handler, and the pairs of `events` that begin to touch: sort key and pair index,
    /// in the order of the keys.
    ///
    /// The caller must give the list back by [`return_touching_buffer`](Self::return_touching_buffer).
    pub(crate) fn touching_pairs(&mut self, events: &[TouchChange]) -> Vec<(u128, u32)> {
        let mut touching = std::mem::take(&mut self.solver.touching_scratch);
        touching.clear();
        let with_numbers = |pair: PairIndex| {
            Some((touching_pair_key(&self.solver.pairs, &self.solver.proxies, pair)?, pair.0))
        };
        let is_reported = |pair: &PairIndex| self.solver.pairs.state(*pair).is_reported;
        if self.solver.pairs.reported_count > 0 {
            touching.extend(self.solver.pairs.indices().filter(is_reported).filter_map(with_numbers));
        }
        for &TouchChange { geoms, .. } in events.iter().filter(|change| change.begins) {
            let unreported = self.pairs_between(geoms).filter(|pair| !is_reported(pair));
            touching.extend(unreported.filter_map(with_numbers));
        }
        sort_numbered(&mut touching);
        touching
    }

    /// Takes back the list that [`touching_pairs`](Self::touching_pairs) returned, so that its memory is reused.
    pub(crate) fn return_touching_buffer(&mut self, touching: Vec<(u128, u32)>) {
        self.solver.touching_scratch = touching;
    }

    /// Disables all contacts of a pair for this step, because a handler has rejected them: the contact constraint of the pair
    /// is removed.
    pub(crate) fn disable_contact(&mut self, pair: usize) {
        self.solver.has_handler_changes = true;
        self.solver.narrow_phase().veto(PairIndex::new(pair));
    }

    /// Retains only the contact points of a pair that a handler has left in `contacts`. All other points of the pair exert no
    /// impulses in this step.
    pub(crate) fn retain_contacts(&mut self, pair: usize, contacts: &[Contact]) {
        let Some(touching) = self.arbiter_of_pair(pair) else { return };
        let mut is_kept = [true; 2];
        for (is_kept, contact) in is_kept.iter_mut().zip(touching.contacts()) {
            *is_kept = contacts.contains(&contact);
        }
        if is_kept != [true; 2] {
            self.solver.has_handler_changes |=
                self.solver.narrow_phase().retain_points(PairIndex::new(pair), is_kept);
        }
    }

    /// Overrides friction, restitution and tangent speed of a pair for this step, as a handler has set them. A sleeping pair
    /// wakes if these values differ from those with which it fell asleep.
    pub(crate) fn override_surface(&mut self, pair: usize, surface: SurfaceOverride) {
        if let Some(restitution) = self.solver.narrow_phase().override_surface(PairIndex::new(pair), surface)
        {
            self.solver.has_restitution |= restitution > 0.0;
            self.solver.has_handler_changes = true;
        }
    }
}

/// Returns the sort key of a pair: the creation numbers of both geoms, the smaller one first, packed into one number.
/// `None` if the pair does not touch or a handler has disabled it.
fn touching_pair_key(pairs: &Pairs, proxies: &Proxies, pair: PairIndex) -> Option<u128> {
    pairs.get(pair).filter(|state| state.is_touching && !state.is_vetoed)?;
    let [a, b] = pairs.proxies_of(pair).map(|proxy| proxies.proxy(proxy).creation_number);
    Some(packed_key(if a < b { [a, b] } else { [b, a] }))
}
