//! Adapter: contacts in three axes as the engine above (`twohalf`) reads them. Only with the feature `space`.

use crate::body::BodyId;
use crate::geom::GeomId;
pub use farseer_precise::depth::contact_point::DepthContactPoint;
use farseer_precise::depth::owner::{self, ShapeOwner};

/// Other side of a geom's contact: a geom, a world box or the ground.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum DepthContactTarget {
    /// The target is another geom, with this id.
    Geom(GeomId),
    /// The target is the world box with this id.
    WorldBox(u32),
    /// The target is the ground, whose top is the plane y = 0.
    Ground,
}

/// Contact manifold of two shapes in three axes, as the engine above reads it.
#[derive(Debug, Clone, Copy)]
pub struct DepthContact {
    /// Geom that the contact is reported for; the younger one of two geoms.
    pub this: GeomId,
    /// Body that the geom `this` belongs to.
    pub body: BodyId,
    /// Other side of the contact: a geom, a world box or the ground.
    pub target: DepthContactTarget,
    /// Indices of the touching convex pieces: of `this` and of the target.
    pub pieces: [u32; 2],
    /// Body of the target; `None` if the target is not a geom.
    pub target_body: Option<BodyId>,
    /// Contact normal from the target to `this`: dimensionless unit vector in x, y (down) and z.
    pub normal: [f32; 3],
    /// World position of the contact along z in length units: the middle of the overlap of two geoms, or z of the body on a
    /// world box or the ground.
    pub z: f32,
    /// Number of contact points, 1..=2.
    pub count: usize,
    /// Contact points; the first `count` entries are valid.
    pub points: [DepthContactPoint; 2],
    /// Combined friction coefficient of both shapes, dimensionless, >= 0.
    pub friction: f32,
    /// Combined restitution coefficient of both shapes, dimensionless.
    pub restitution: f32,
    /// Whether the contact exerts impulses; false for sensors.
    pub responds: bool,
    /// Whether both shapes touched, or were predicted to touch, at the start of the last step. Otherwise their distance is
    /// within the contact margin.
    pub is_touching: bool,
}

/// Event: two shapes began to touch, or their touch ended.
#[derive(Debug, Clone, Copy)]
pub struct DepthContactEvent {
    /// Geom that the event is reported for; the younger one of two geoms.
    pub this: GeomId,
    /// Other side of the contact: a geom, a world box or the ground.
    pub target: DepthContactTarget,
    /// Manifold of a contact that begins; `None` for a contact that ends.
    pub contact: Option<DepthContact>,
}

/// Returns the contact target that a `GeomId` stands for.
pub(super) fn contact_target_of(id: GeomId) -> DepthContactTarget {
    match owner::owner_of(id.to_bits()) {
        ShapeOwner::Ground => DepthContactTarget::Ground,
        ShapeOwner::WorldBox(id) => DepthContactTarget::WorldBox(id),
        ShapeOwner::Geom(_) => DepthContactTarget::Geom(id),
    }
}
