//! Adapter: what is listed, compared with the objects of the game. The comparison finds edits that need a rebuild of all lists.

use super::body_import::inverse_mass_inertia_of;
use super::geom_import::geom_filter;
use super::ids::IdTable;
use crate::body::BodyId;
use crate::geom::GeomId;
use crate::objects::Objects;
use farseer_precise::bodies::BodySet;
use farseer_precise::broad_phase::proxies::{Proxies, Proxy};
use farseer_precise::index::BodyIndex;

/// The listed bodies and proxies, and the objects of the game.
pub(super) struct Listed<'a> {
    pub(super) ids: &'a IdTable,
    pub(super) bodies: &'a BodySet,
    pub(super) proxies: &'a Proxies,
    pub(super) objects: &'a Objects,
}

impl Listed<'_> {
    /// Returns whether an edit has changed the type of a listed body. The type is static, kinematic, dynamic or not simulated,
    /// and whether mass and inertia are infinite. `None` if the body is not listed.
    pub(super) fn has_changed_type(&self, id: BodyId) -> Option<bool> {
        let (index, body) = (self.ids.body_index(id)?, &self.objects.bodies.get(id)?.body);
        let is_movable = index < self.bodies.first_static();
        let inverses = if is_movable { inverse_mass_inertia_of(body) } else { [0.0; 2] };
        // Bodies of infinite mass and inertia use no graph colours, so that this property is part of the type.
        let is_same_type = body.enabled()
            && is_movable == body.is_integrated()
            && self.bodies.is_kinematic(index) == (is_movable && body.is_kinematic())
            && (inverses == [0.0; 2]) == (self.bodies.inverse_mass_inertia[index] == [0.0; 2]);
        Some(!is_same_type)
    }

    /// Returns whether an edit has changed the collision filter of a geom, its collision response (whether its contacts exert
    /// impulses) or the events that it wants.
    pub(super) fn has_changed_filter(&self, id: GeomId) -> bool {
        let Some(entry) = self.objects.geoms.get(id) else { return false };
        let (filter, responds) = (geom_filter(entry), entry.geom.collision_response_enabled());
        let events = entry.geom.wanted_events().0;
        self.proxies_of(id)
            .any(|proxy| proxy.filter != filter || proxy.responds != responds || proxy.events != events)
    }

    /// Returns the proxies of a geom.
    fn proxies_of(&self, id: GeomId) -> impl Iterator<Item = &Proxy> {
        self.ids.proxies_of_geom(self.proxies, id).map(|at| self.proxies.proxy(at))
    }

    /// Returns whether a body has begun or ceased to be simulated without a call that marks it. For debug assertions.
    /// `disabled_bodies`: the disabled bodies at the last import.
    pub(super) fn has_unmarked_change(&self, disabled_bodies: &[BodyId]) -> bool {
        let bodies = &self.objects.bodies;
        let has_changed = |(at, id): (BodyIndex, &Option<BodyId>)| {
            let is_movable = at <= self.bodies.last_movable;
            id.is_some_and(|id| {
                bodies
                    .get(id)
                    .is_none_or(|entry| !entry.body.enabled() || (is_movable && !entry.body.is_integrated()))
            })
        };
        let has_returned = |&id: &BodyId| is_simulated(id, self.objects);
        self.ids.bodies.enumerated().skip(1).any(has_changed) || disabled_bodies.iter().any(has_returned)
    }
}

/// Returns whether a body is simulated. It is enabled, and it is dynamic or kinematic in the simulator's list of bodies or has
/// a geom in the simulator's list of geoms.
pub(super) fn is_simulated(id: BodyId, objects: &Objects) -> bool {
    let Some(entry) = objects.bodies.get(id).filter(|entry| entry.body.enabled()) else { return false };
    let has_geoms = || {
        entry.geoms.iter().any(|&geom| objects.geoms.lifecycle_state(geom).is_some_and(|life| life.is_listed))
    };
    (entry.body.is_integrated() && objects.bodies.lifecycle_state(id).is_some_and(|life| life.is_listed))
        || has_geoms()
}
