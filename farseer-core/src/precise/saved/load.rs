//! Serialises the precise set as [`Saved`], and lists everything anew from a loaded state.

use serde::{Serialize, Serializer};

use super::{EditPolicy, Saved};
use crate::body::{Body, BodyId};
use crate::objects::Objects;
use crate::precise::Precise;
use farseer_precise::broad_phase::proxies::BodyType;

impl Serialize for Precise {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        self.save().serialize(serializer)
    }
}

impl Saved {
    /// Returns copies of the bodies that were disabled or have changed their type since the save, enabled and with the saved
    /// type.
    fn bodies_of_other_type(&self, objects: &Objects) -> Vec<(BodyId, Body)> {
        let mut bodies: Vec<(BodyId, Body)> = Vec::new();
        for proxy in &self.proxies {
            let Some(id) = objects.geoms.get(proxy.geom).map(|geom| geom.body) else { continue };
            let Some(body) = objects.bodies.get(id).map(|entry| &entry.body) else { continue };
            let is_known = || bodies.iter().any(|&(other, _)| other == id);
            if body_type_of(body) != Some(proxy.body_type) && !is_known() {
                bodies.push((id, with_body_type(body.clone(), proxy.body_type)));
            }
        }
        bodies
    }
}

/// Returns the body type with which a body is listed; `None` if the body is disabled.
fn body_type_of(body: &Body) -> Option<BodyType> {
    let kind = match (body.is_integrated(), body.is_kinematic()) {
        (false, _) => BodyType::Fixed,
        (true, true) => BodyType::Kinematic,
        (true, false) => BodyType::Dynamic,
    };
    body.enabled().then_some(kind)
}

/// Returns the body with the body type `kind`, and enabled.
fn with_body_type(mut body: Body, kind: BodyType) -> Body {
    body.set_enabled(true);
    body.set_is_kinematic(kind == BodyType::Kinematic);
    body.set_is_static(kind == BodyType::Fixed);
    body
}

/// Swaps the states of `bodies` with those of the simulator's bodies, and makes disposed objects visible to look-ups or hides
/// them.
fn swap_states(bodies: &mut [(BodyId, Body)], objects: &mut Objects, shows_disposed: bool) {
    for (id, other) in bodies {
        if let Some(entry) = objects.bodies.get_mut(*id) {
            std::mem::swap(&mut entry.body, other);
        }
    }
    objects.bodies.set_disposed_visible(shows_disposed);
    objects.geoms.set_disposed_visible(shows_disposed);
}

impl Precise {
    /// Rebuilds the lists from the loaded state, for contact queries before the next update.
    ///
    /// Edits made before the save take effect in the next update, which rebuilds everything once more. Bodies that were
    /// disabled, disposed or changed in type since the last update are therefore listed as they were.
    pub(crate) fn rebuild_from_loaded(&mut self, objects: &mut Objects) {
        let Some(saved) = self.loaded.take() else { return };
        let mut others = saved.bodies_of_other_type(objects);
        swap_states(&mut others, objects, true);
        self.rebuild(objects, &saved, EditPolicy::Defer);
        swap_states(&mut others, objects, false);
        self.edits.bodies.extend(others.into_iter().map(|(id, _)| id));
        // The engine above sends all data of the depth axis again.
        if self.has_depth() || self.save() != saved {
            self.edits.needs_rebuild = true;
            self.loaded = Some(saved);
        }
    }
}
