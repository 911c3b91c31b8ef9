//! Serialises the precise set as [`Saved`], and lists everything anew from a loaded state.

use serde::{Serialize, Serializer};

use super::save::{PairStream, saved_with};
use super::{EditPolicy, Saved};
use crate::body::{Body, BodyId};
use crate::math::Vector2;
use crate::objects::Objects;
use crate::precise::Precise;
use farseer_precise::broad_phase::proxies::BodyType;
use farseer_precise::depth::state::DepthState;

impl Serialize for Precise {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        match &self.loaded {
            Some(loaded) => loaded.serialize(serializer),
            None => saved_with(self, |saved_indices| PairStream { precise: self, saved_indices })
                .serialize(serializer),
        }
    }
}

impl Saved {
    /// Returns copies of the bodies that were moved or disabled or have changed their type since the last import, with the pose
    /// and the type of that import, and enabled.
    fn bodies_before_edits(&self, objects: &Objects) -> Vec<(BodyId, Body)> {
        let mut bodies: Vec<(BodyId, Body)> = Vec::new();
        for proxy in &self.proxies {
            let Some(id) = objects.geoms.get(proxy.geom).map(|geom| geom.body) else { continue };
            let Some(body) = objects.bodies.get(id).map(|entry| &entry.body) else { continue };
            let is_known = || bodies.iter().any(|&(other, _)| other == id);
            let has_moved = !is_at(body, proxy.imported.pose);
            if (has_moved || body_type_of(body) != Some(proxy.body_type)) && !is_known() {
                let before = with_body_type(body.clone(), proxy.body_type);
                bodies.push((id, if has_moved { with_pose(before, proxy.imported.pose) } else { before }));
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

/// Returns whether a body is at a pose in the world frame, bit for bit: x, y (length units), rotation (radians), z (not compared).
fn is_at(body: &Body, [x, y, rotation, _]: [f32; 4]) -> bool {
    let position = body.position();
    [position.x, position.y, body.rotation()].map(f32::to_bits) == [x, y, rotation].map(f32::to_bits)
}

/// Returns the body at a pose in the world frame: x, y (length units), rotation (radians), z (not used).
fn with_pose(mut body: Body, [x, y, rotation, _]: [f32; 4]) -> Body {
    body.set_position(Vector2::new(x, y));
    body.set_rotation(rotation);
    body
}

/// Sets the depth of each body with a proxy to that of the last import.
fn set_depths_before_edits(depth: Option<&mut DepthState>, saved: &Saved, objects: &Objects) {
    let Some(space) = depth else { return };
    for proxy in &saved.proxies {
        if let Some(geom) = objects.geoms.get(proxy.geom) {
            let [.., z] = proxy.imported.pose;
            space.body_mut(geom.body.slot()).z = z;
        }
    }
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
    /// Edits made before the save take effect in the next update, which rebuilds everything once more. Bodies that were moved,
    /// disabled, disposed or changed in type since the last update are therefore listed as they were.
    pub(crate) fn rebuild_from_loaded(&mut self, objects: &mut Objects) {
        let Some(saved) = self.loaded.take() else { return };
        let mut others = saved.bodies_before_edits(objects);
        let has_moved = others.iter().any(|(id, before)| {
            objects.bodies.get(*id).is_some_and(|entry| {
                entry.body.position() != before.position() || entry.body.rotation() != before.rotation()
            })
        });
        set_depths_before_edits(self.solver.depth.as_deref_mut(), &saved, objects);
        swap_states(&mut others, objects, true);
        self.rebuild(objects, &saved, EditPolicy::Defer);
        swap_states(&mut others, objects, false);
        // A damaged snapshot may name a body that does not exist, of any slot.
        let exists = |body: &BodyId| objects.bodies.get(*body).is_some();
        let sleeping = saved.sleeping_bodies.iter().map(|sleeping| sleeping.body);
        let asleep = saved.pending_events.asleep_at_report(sleeping).filter(exists);
        let [woken, fallen_asleep] =
            saved.pending_events.sleep_changes().map(|bodies| bodies.iter().copied().filter(exists));
        self.sleep_events.restore(asleep, woken, fallen_asleep);
        self.edits.bodies.extend(others.into_iter().map(|(id, _)| id));
        // The engine above sends all data of the depth axis again.
        if self.has_depth() || has_moved || self.save() != saved {
            self.edits.needs_rebuild = true;
            self.loaded = Some(saved);
        }
    }
}
