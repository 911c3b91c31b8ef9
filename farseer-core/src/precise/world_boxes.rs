//! Adapter: world boxes and the ground, which belong to no body of the game, and the ids that stand for them.

use super::Precise;
use super::ids::geom_of;
use crate::body::BodyId;
use crate::geom::GeomId;
use crate::geom::filter::CollisionFilter;
use crate::methods::CollisionCategory;
use crate::objects::Objects;
use crate::storage::arena::Id;
use farseer_precise::Solver;
use farseer_precise::broad_phase::proxies::BodyType;
use farseer_precise::depth::interface::{FilterNumbers, HingeFeature};
use farseer_precise::depth::owner::{self, ShapeOwner};
use farseer_precise::index::{BodyIndex, ProxyIndex};

impl Precise {
    /// Adds the ground and the static boxes to `BodySet` after all bodies, and sets the velocities and inverse inertias of
    /// moving boxes. Then rebuilds the depth data by body index.
    pub(super) fn rebuild_world_boxes(&mut self) {
        let Precise { solver: Solver { depth: Some(space), bodies, .. }, ids, .. } = self else { return };
        space.add_box_bodies(bodies);
        space.rebuild_bodies(bodies, ids.bodies.iter().map(|id| id.map(|id| id.slot())));
        for body_index in bodies.movable() {
            if let Some(id) = ids.bodies[body_index] {
                space.import_body(bodies, body_index, id.slot());
            }
        }
    }

    /// Returns the id of a body for a snapshot, or the id that stands for a sleeping hinged box; `None` for all other bodies
    /// without an id. A box is identified by its proxy, because the list of boxes may be newer than the list of bodies.
    pub(super) fn saved_body_id(&self, body_index: BodyIndex) -> Option<BodyId> {
        let of_world_box = || {
            let mut proxies =
                self.solver.proxies.proxies_of(body_index).map(|at| self.solver.proxies.proxy(at));
            proxies
                .find(|proxy| proxy.body_type == BodyType::Hinged)
                .map(|proxy| world_box_body_id(geom_of(proxy)))
        };
        self.ids.bodies[body_index].or_else(|| if HingeFeature::ENABLED { of_world_box() } else { None })
    }

    /// Returns the body index of the body or hinged box that an id in a snapshot stands for; `None` if it no longer exists.
    pub(super) fn body_of_saved_id(&self, name: BodyId) -> Option<BodyIndex> {
        self.body_index(name).or_else(|| {
            if !HingeFeature::ENABLED {
                return None;
            }
            self.solver.depth.as_ref()?.hinged_body(world_box_of_body_id(name)?)
        })
    }

    /// Returns the proxy index of the ground or of a world box; `None` for a geom or an unknown box.
    pub(super) fn world_proxy_of(&self, id: GeomId) -> Option<ProxyIndex> {
        let space = self.solver.depth.as_ref()?;
        match owner::owner_of(id.to_bits()) {
            ShapeOwner::Ground => Some(space.ground_proxy),
            ShapeOwner::WorldBox(id) => space.proxy_of_world_box(id),
            ShapeOwner::Geom(_) => None,
        }
    }

    /// Returns whether a geom may collide with a world box or with the ground, by the collision filters and by whether its body
    /// is enabled; `None` for two geoms.
    pub(crate) fn may_meet_world_geom(&self, (a, b): (GeomId, GeomId), objects: &Objects) -> Option<bool> {
        let (geom, other) = match (is_geom(a), is_geom(b)) {
            (true, true) => return None,
            (true, false) => (a, b),
            (false, _) => (b, a),
        };
        let (Some(space), Some(entry)) = (&self.solver.depth, objects.geoms.get(geom)) else {
            return Some(false);
        };
        let is_enabled = objects.bodies.get(entry.body).is_some_and(|body| body.body.enabled());
        let meets = match owner::owner_of(other.to_bits()) {
            ShapeOwner::Ground => entry.geom.collision_enabled(),
            ShapeOwner::WorldBox(id) => space
                .world_box_by_id(id)
                .is_some_and(|(_, world_box)| entry.geom.filter().may_meet(&world_box.filter.into())),
            ShapeOwner::Geom(_) => false,
        };
        Some(is_enabled && meets && !objects.geoms.is_disposed(geom))
    }
}

/// Returns the `BodyId` that stands for a sleeping hinged box in a snapshot, from the `GeomId` of the box.
pub(super) fn world_box_body_id(world_box: GeomId) -> BodyId {
    BodyId::new(world_box.slot() as u32, 0)
}

/// Returns the id of the hinged box that a `BodyId` of a snapshot stands for; `None` for a real body.
pub(super) fn world_box_of_body_id(body: BodyId) -> Option<u32> {
    owner::world_box_at(body.slot() as u32)
}

/// Returns whether a `GeomId` stands for a geom, and not for a world box or the ground.
pub(super) fn is_geom(id: GeomId) -> bool {
    owner::is_geom(id.slot() as u32)
}

impl From<CollisionFilter> for FilterNumbers {
    fn from(filter: CollisionFilter) -> Self {
        let CollisionFilter { categories, collides_with, group, is_enabled, responds, both_agree: _ } =
            filter;
        let (categories, collides_with) = (categories.bits(), collides_with.bits());
        FilterNumbers { categories, collides_with, group, is_enabled, responds }
    }
}

impl From<FilterNumbers> for CollisionFilter {
    fn from(numbers: FilterNumbers) -> Self {
        let FilterNumbers { categories, collides_with, group, is_enabled, responds } = numbers;
        let [categories, collides_with] = [categories, collides_with].map(CollisionCategory::from_bits);
        CollisionFilter { categories, collides_with, group, is_enabled, responds, both_agree: false }
    }
}
