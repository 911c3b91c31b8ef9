//! Adapter: the edits of the game that the next import applies.

use crate::body::BodyId;
use crate::geom::GeomId;
use crate::objects::NewMembers;
use crate::storage::arena::Id as _;
use crate::storage::order::sort_by_number;
use farseer_precise::reusing_clone;

/// Edits of the game since the last import, and what that import has to know of earlier ones.
#[derive(Debug, Default)]
pub(crate) struct PendingEdits {
    /// Whether the next import must list all bodies and proxies anew, for example because a geom changed its filter.
    pub(super) needs_rebuild: bool,
    /// Whether bodies or geoms were added or removed since the last import.
    pub(super) has_membership_changes: bool,
    /// Ids of the bodies and geoms that were added or removed since the last import, in the order of their slots.
    pub(super) new_members: NewMembers,
    /// Ids of bodies that the game borrowed for editing since the last import; the next import copies their properties.
    pub(super) bodies: Vec<BodyId>,
    /// Ids of geoms that the game borrowed for editing since the last import; the next import copies their properties.
    pub(super) geoms: Vec<GeomId>,
    /// Ids of bodies that the game asked to wake since the last update.
    pub(super) wake_requests: Vec<BodyId>,
    /// Ids of the bodies that were disabled at the last rebuild; with debug assertions, which read them, at the last import.
    /// They have no body index.
    pub(super) disabled_bodies: Vec<BodyId>,
}

reusing_clone! { PendingEdits { needs_rebuild, has_membership_changes, new_members, bodies, geoms, wake_requests, disabled_bodies } }

impl PendingEdits {
    /// Returns the edits of an empty engine, whose first import lists everything.
    pub(super) fn new() -> Self {
        PendingEdits { needs_rebuild: true, ..PendingEdits::default() }
    }

    /// Returns whether no edit waits for the next import, apart from requests to wake.
    pub(crate) fn is_empty(&self) -> bool {
        self.bodies.is_empty() && self.geoms.is_empty() && !self.needs_rebuild && !self.has_membership_changes
    }

    /// Requests a rebuild of all lists by the next import, because a change is none that the lists can follow one by one.
    pub(crate) fn mark_stale(&mut self) {
        self.needs_rebuild = true;
    }

    /// Requests that the next import adds the `new_members` to the engine's lists of bodies and geoms, or removes them. It lists
    /// everything anew if `new_members` is empty, as after loading.
    pub(crate) fn mark_membership_changed(&mut self, new_members: &mut NewMembers) {
        self.has_membership_changes = true;
        self.needs_rebuild |= new_members.is_empty();
        self.new_members.bodies.append(&mut new_members.bodies);
        self.new_members.geoms.append(&mut new_members.geoms);
        self.new_members.sort();
    }

    /// Adds a body whose properties the next import copies, as they are then.
    pub(super) fn mark_body_edited(&mut self, body: BodyId) {
        self.bodies.push(body);
    }

    /// Adds a geom whose properties the next import copies, as they are then.
    pub(super) fn mark_geom_edited(&mut self, geom: GeomId) {
        self.geoms.push(geom);
    }
}

impl NewMembers {
    /// Sorts the bodies and geoms by their slots, and drops repetitions.
    pub(crate) fn sort(&mut self) {
        sort_by_number(&mut self.bodies, |body| body.rank());
        sort_by_number(&mut self.geoms, |geom| geom.rank());
        self.bodies.dedup();
        self.geoms.dedup();
    }

    /// Returns whether the list of entered and left bodies has this body. The list is sorted.
    pub(crate) fn has_body(&self, body: BodyId) -> bool {
        self.bodies.binary_search_by_key(&body.rank(), |other| other.rank()).is_ok()
    }

    /// Returns whether the list of entered and left geoms has this geom. The list is sorted.
    pub(crate) fn has_geom(&self, geom: GeomId) -> bool {
        self.geoms.binary_search_by_key(&geom.rank(), |other| other.rank()).is_ok()
    }

    /// Returns whether nothing has entered or left.
    pub(crate) fn is_empty(&self) -> bool {
        self.bodies.is_empty() && self.geoms.is_empty()
    }
}
