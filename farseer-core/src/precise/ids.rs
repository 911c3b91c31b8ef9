//! Adapter: the ids of the game behind the dense indices of the solver.
//!
//! The solver knows bodies and proxies by their indices. This table translates an index to an id and back.

use super::vacancies::Vacancies;
use crate::body::BodyId;
use crate::geom::GeomId;
use farseer_precise::broad_phase::proxies::{Proxies, Proxy};
use farseer_precise::index::{BodyIndex, IndexRange, IndexedVec, ProxyIndex};
use farseer_precise::reusing_clone;

/// Ids of the bodies by body index, and the indices of bodies and geoms by the slots of their ids.
#[derive(Debug, Default)]
pub(super) struct IdTable {
    /// Id of each body, by body index; `None` for the placeholder, boxes of `twohalf` and empty entries.
    pub(super) bodies: IndexedVec<BodyIndex, Option<BodyId>>,
    /// Index into `bodies` of each body, by the slot of its id; `None` if the body is not listed.
    body_indices: Vec<Option<BodyIndex>>,
    /// Index of the first proxy of each geom, by the slot of its id; `None` if the geom has no proxy.
    first_proxies: Vec<Option<ProxyIndex>>,
    /// Indices that movable bodies have left.
    pub(super) vacant_bodies: Vacancies<BodyId, BodyIndex>,
    /// Proxy indices that geoms of movable bodies have left.
    pub(super) vacant_proxies: Vacancies<GeomId, ProxyIndex>,
}

reusing_clone! { IdTable { bodies, body_indices, first_proxies, vacant_bodies, vacant_proxies } }

/// A geom that every AABB query of the game tests, because no fat AABB of the grid is known to cover it.
#[derive(Debug, Clone, Copy)]
pub(super) struct AlwaysTested {
    /// Number by which geoms are sorted as in the simulator's list.
    pub(super) list_key: u32,
    pub(super) geom: GeomId,
}

/// Returns the number by which a proxy knows the geom that it belongs to: see [`Proxy::owner`].
pub(super) fn owner_of(geom: GeomId) -> u64 {
    geom.to_bits()
}

/// Returns the geom that a proxy belongs to, or the id that stands for a world box or the ground.
pub(super) fn geom_of(proxy: &Proxy) -> GeomId {
    GeomId::from_bits(proxy.owner)
}

/// Returns `at` if the proxy with this index is the given convex piece of a geom; else `None`.
pub(super) fn piece_at(
    proxies: &Proxies,
    at: ProxyIndex,
    (geom, piece): (GeomId, u32),
) -> Option<ProxyIndex> {
    let proxy = proxies.get(at)?;
    (proxy.owner == owner_of(geom) && proxy.piece == piece).then_some(at)
}

/// Sets the entry `slot` of a table to `index`. Lengthens the table as needed.
fn set_entry<I: Copy>(table: &mut Vec<Option<I>>, slot: usize, index: I) {
    if table.len() <= slot {
        table.resize(slot + 1, None);
    }
    table[slot] = Some(index);
}

/// Returns the entry `slot` of a table; `None` if it has no index or is beyond the end of the table.
fn entry_of<I: Copy>(table: &[Option<I>], slot: usize) -> Option<I> {
    table.get(slot).copied().flatten()
}

impl IdTable {
    /// Removes all bodies and makes room for `count` body indices, none of which has a body.
    pub(super) fn clear_bodies(&mut self, count: usize) {
        self.body_indices.clear();
        self.vacant_bodies.clear();
        self.bodies.clear();
        self.bodies.resize(count, None);
    }

    /// Lists a body at the index `index`.
    pub(super) fn add_body(&mut self, index: BodyIndex, id: BodyId) {
        self.vacant_bodies.fill(index);
        *self.bodies.at_or_grow(index) = Some(id);
        set_entry(&mut self.body_indices, id.slot(), index);
    }

    /// Removes the body at `index`. The index stays without a body until the next rebuild.
    pub(super) fn remove_body(&mut self, index: BodyIndex) {
        if let Some(id) = self.bodies[index].take() {
            self.body_indices[id.slot()] = None;
        }
    }

    /// Returns the body index of a body; `None` if the body is not listed.
    pub(super) fn body_index(&self, body: BodyId) -> Option<BodyIndex> {
        entry_of(&self.body_indices, body.slot()).filter(|&index| self.bodies[index] == Some(body))
    }

    /// Removes all geoms.
    pub(super) fn clear_geoms(&mut self) {
        self.first_proxies.clear();
        self.vacant_proxies.clear();
    }

    /// Lists a geom, whose first proxy has the index `first`.
    pub(super) fn add_geom(&mut self, geom: GeomId, first: ProxyIndex) {
        set_entry(&mut self.first_proxies, geom.slot(), first);
    }

    /// Removes a geom.
    pub(super) fn remove_geom(&mut self, geom: GeomId) {
        self.first_proxies[geom.slot()] = None;
    }

    /// Returns the index of the first proxy of the geom with this slot; `None` if the slot has no listed geom. The proxy may
    /// belong to a former geom of the slot.
    pub(super) fn first_proxy(&self, geom: GeomId) -> Option<ProxyIndex> {
        entry_of(&self.first_proxies, geom.slot())
    }

    /// Returns the range of the proxy indices of a geom; empty if the geom has no proxy.
    pub(super) fn proxies_of_geom(&self, proxies: &Proxies, geom: GeomId) -> IndexRange<ProxyIndex> {
        let first = self.first_proxy(geom).and_then(|first| piece_at(proxies, first, (geom, 0)));
        let Some(first) = first else { return IndexRange::default() };
        let owner = owner_of(geom);
        let count = proxies.positions_from(first).take_while(|proxy| proxy.owner == owner).count();
        IndexRange::new(first, count)
    }
}

#[cfg(test)]
mod tests {
    use super::IdTable;
    use crate::body::BodyId;
    use crate::storage::arena::Id;
    use farseer_precise::index::BodyIndex;

    #[test]
    fn a_body_is_found_only_while_it_is_listed() {
        let mut ids = IdTable::default();
        ids.clear_bodies(4);
        let (first, reused) = (BodyId::new(7, 0), BodyId::new(7, 1));
        ids.add_body(BodyIndex(2), first);
        assert_eq!((ids.body_index(first), ids.body_index(reused)), (Some(BodyIndex(2)), None));
        ids.remove_body(BodyIndex(2));
        assert_eq!(ids.body_index(first), None);
        ids.add_body(BodyIndex(5), reused);
        assert_eq!((ids.body_index(first), ids.body_index(reused)), (None, Some(BodyIndex(5))));
        assert_eq!(*ids.bodies, [None, None, None, None, None, Some(reused)]);
    }
}
