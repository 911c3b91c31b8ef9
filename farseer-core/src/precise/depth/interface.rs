//! Types at the interface to an engine with depth (`twohalf`): bodies, shapes and world boxes that it passes in, and contacts
//! that it reads.
//!
//! Coordinates are x right, y down, z into the picture. Lengths are in length units, times in seconds, angles in radians.

use serde::{Deserialize, Serialize};

pub use super::contact_point::DepthContactPoint;
use crate::body::BodyId;
use crate::geom::GeomId;
use crate::geom::filter::CollisionFilter;
use crate::precise::ids::owner_of;
use crate::shape::{Footprint, SlantedBox};
use crate::storage::arena::Id;
use crate::surface::SurfaceCoefficients;

/// State of a body along the depth axis: input of an update and output after the update.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct DepthBodyState {
    /// World position along z in length units.
    pub z: f32,
    /// Velocity along z in length units/s; for a static body the surface velocity of a conveyor belt along z.
    pub velocity: f32,
    /// Acceleration by forces along z in the coming step, length units/s^2. Each step resets it to 0.
    pub acceleration: f32,
    /// Displacement in the last step along x, y and z, length units. From it the narrow phase computes along which axis two
    /// shapes began to overlap last (last-entered axis).
    pub displacement: [f32; 3],
    /// Angular velocity about x and y in rad/s. It applies only to bodies all of whose geoms are spheres about the origin of
    /// the body.
    pub angular_velocity: [f32; 2],
    /// Penetration in length units when the body's last contact with a static body ended; 0 after other contacts, >= 0. The
    /// next flush face is tested with this tolerance.
    pub residual_penetration: f32,
    /// Target position of a kinematic body along z; `None` if the body follows its velocity. The next step reaches the target
    /// bit for bit, and the body rests in the step after that.
    pub target: Option<DepthTarget>,
}

/// Target position of a kinematic body along z.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct DepthTarget {
    /// World position of the target along z in length units.
    pub z: f32,
    /// Whether the last step has reached the target.
    pub is_reached: bool,
}

/// Shape of a geom in three axes: prism along z, sphere or vertical shape.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct DepthShape {
    /// Half of the extent along z in length units, >= 0.
    pub half_depth: f32,
    /// Whether the shape is a sphere; otherwise the outline is extruded along z to a prism.
    pub is_sphere: bool,
    /// Friction and restitution coefficients of the ground under this geom, dimensionless. `None`: the ground does not support
    /// it.
    pub ground_surface: Option<[f32; 2]>,
    /// Vertical shape that replaces the outline; `None` for a sphere or a prism along z. The body of a vertical shape never
    /// rotates.
    pub vertical: Option<VerticalShape>,
}

/// Shape extruded along y, centred at the origin of its geom. It never rotates.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum VerticalShape {
    /// The shape is a cylinder: a disc in x and z, extruded along y.
    Cylinder {
        /// Radius of the disc in length units, >= 0.
        radius: f32,
        /// Half of the height in length units, >= 0.
        half_height: f32,
    },
    /// The shape is a capsule: all points within `radius` of a segment along y.
    Capsule {
        /// Radius in length units, >= 0.
        radius: f32,
        /// Half of the height including the round ends, in length units, >= `radius`.
        half_height: f32,
    },
    /// The shape is a prism: a polygon in x and z, extruded along y.
    Prism {
        /// Vertices of the polygon in x and z, relative to the origin of the geom, in length units.
        footprint: Footprint,
        /// Half of the height in length units, >= 0.
        half_height: f32,
    },
}

impl VerticalShape {
    /// Returns the bounding rectangle in the plane of x and y: centre relative to the origin of the geom, and half extents.
    /// Length units.
    pub(in crate::precise) fn front_box(&self) -> ([f32; 2], [f32; 2]) {
        match *self {
            VerticalShape::Cylinder { radius, half_height }
            | VerticalShape::Capsule { radius, half_height } => ([0.0; 2], [radius, half_height]),
            VerticalShape::Prism { footprint, half_height } => {
                let (low, high) = footprint.bounds();
                ([0.5 * (low.x + high.x), 0.0], [0.5 * (high.x - low.x), half_height])
            }
        }
    }
}

/// Box without a geom: static, kinematic, or free to rotate about a vertical hinge. Contacts never displace it; they can only
/// rotate a hinged box. It may be tilted in the plane, sheared, or rotated about y.
#[derive(Debug, Clone)]
pub struct WorldBox {
    /// Id, below 2^31, never reused. It is greater than the ids of the boxes before it in the list.
    pub id: u32,
    /// Box geometry in world coordinates (y down), length units: centre, half extents, tilt and shear.
    pub shape: SlantedBox,
    /// Tilt in the plane of x and y, in radians.
    pub rotation: f32,
    /// Rotation about the vertical axis through the centre, from x to z, in radians. `None` if the box never has a yaw. A box
    /// with a yaw is not tilted.
    pub yaw: Option<f32>,
    /// Collision filter: decides which geoms collide with the box.
    pub filter: CollisionFilter,
    /// Friction and restitution coefficients of the box, dimensionless.
    pub surface: SurfaceCoefficients,
    /// Surface velocity of a conveyor belt along x, y and z, in length units/s, relative to the box. It adds to the velocity of
    /// the box.
    pub surface_velocity: [f32; 3],
    /// Motion of a kinematic or hinged box; `None` for a static box.
    pub motion: Option<WorldBoxMotion>,
    /// Whether the box is one-way: it stops objects that come from above its top and lets all other objects pass.
    pub is_one_way: bool,
}

impl WorldBox {
    /// Returns the hinge of the box; `None` if the box is not hinged.
    pub(super) fn hinge(&self) -> Option<&WorldBoxHinge> {
        self.motion.as_ref()?.hinge()
    }
}

/// Motion of a kinematic box, which follows velocities or targets, or of a hinged one.
#[derive(Debug, Clone, Copy, PartialEq, Default, Serialize, Deserialize)]
pub struct WorldBoxMotion {
    /// Velocity of the box along x, y (down) and z, in length units/s.
    pub velocity: [f32; 3],
    /// Target of the box's centre in world coordinates x, y and z, length units, and whether the last step has reached it. The
    /// box rests in the step after that. `None`: the box follows `velocity`.
    pub target: Option<([f32; 3], bool)>,
    /// Displacement of the box in the last step along x, y and z, in length units.
    #[serde(rename = "way")]
    pub displacement: [f32; 3],
    /// Angular velocity about the vertical axis, from x to z, in rad/s.
    #[serde(rename = "turning")]
    pub yaw_rate: f32,
    /// Target yaw in radians, and whether the last step has reached it. The box rests in the step after that. `None`: the box
    /// follows `yaw_rate`.
    pub yaw_target: Option<(f32, bool)>,
    /// Hinge of a box that can rotate about it alone; then velocities and targets do not apply. `None` for other boxes. Read it
    /// by the method [`hinge`](Self::hinge).
    #[serde(rename = "swing")]
    pub hinge: Option<WorldBoxHinge>,
}

impl WorldBoxMotion {
    /// Returns the hinge; `None` for a box without one. Without the feature `swing` it always returns `None`, so that the
    /// compiler removes all code for hinges.
    pub fn hinge(&self) -> Option<&WorldBoxHinge> {
        if HingeFeature::ENABLED { self.hinge.as_ref() } else { None }
    }

    /// Returns a mutable reference to the hinge; `None` for a box without one or without the feature `swing`.
    pub fn hinge_mut(&mut self) -> Option<&mut WorldBoxHinge> {
        if HingeFeature::ENABLED { self.hinge.as_mut() } else { None }
    }
}

/// Vertical hinge with a spring, a damper and angular stops. The yaw phi obeys I phi" + c phi' + k (phi - phi0) = contact
/// torques.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct WorldBoxHinge {
    /// Proof of the feature `swing`. It is the first field, so that a decoder without the feature reads no further.
    pub proof: HingeFeature,
    /// World position of the hinge along x and z, in length units.
    #[serde(rename = "hinge")]
    pub pivot: [f32; 2],
    /// Centre of the box relative to the hinge along x and z, at yaw 0, in length units.
    #[serde(rename = "out")]
    pub box_offset: [f32; 2],
    /// Moment of inertia I of the box about the hinge, mass units * length units^2, > 0.
    pub inertia: f32,
    /// Spring stiffness k: torque per radian, mass units * length units^2/s^2, >= 0.
    pub stiffness: f32,
    /// Damping coefficient c: torque per rad/s, mass units * length units^2/s, >= 0.
    pub damping: f32,
    /// Rest angle phi0 of the spring, in radians.
    pub rest_angle: f32,
    /// Least and greatest yaw of the box, in radians.
    pub stops: [f32; 2],
    /// Torque of damper and stops about the hinge at the end of the last step, mass units * length units^2/s^2. It is the warm
    /// start of the next step.
    #[serde(rename = "held")]
    pub constraint_torque: f32,
    /// Whether the game has changed the hinge since the last step. Then the box wakes.
    pub is_edited: bool,
}

/// Proof that the feature `swing` is on. Without it the type has no value, so that the compiler removes all code for hinges.
#[cfg(feature = "swing")]
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct HingeFeature;
/// Proof that the feature `swing` is on: it is off, and there is no value.
#[cfg(not(feature = "swing"))]
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub enum HingeFeature {}

impl HingeFeature {
    /// Whether the feature `swing` is on.
    pub const ENABLED: bool = cfg!(feature = "swing");

    /// Returns the proof that the feature `swing` is on; `None` without the feature.
    pub fn new() -> Option<Self> {
        #[cfg(feature = "swing")]
        return Some(HingeFeature);
        #[cfg(not(feature = "swing"))]
        None
    }
}

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

/// Slot index of the `GeomId` that stands for the ground. World boxes have the slots below it; geoms have the lower half of the
/// range of `u32`.
const GROUND_SLOT: u32 = u32::MAX - 1;
/// Slot index of the `GeomId` of the world box with id 0. The box with id n has the slot index n below.
const FIRST_WORLD_BOX_SLOT: u32 = u32::MAX - 2;
/// Creation number of the ground, the greatest one. World boxes have the numbers below it, so that geoms come before boxes and
/// ground wherever creation numbers order pairs.
const LAST_CREATION_NUMBER: u32 = u32::MAX;

/// Returns the numbers of the ground's proxy: its [owner](crate::precise::broad_phase::proxies::Proxy::owner) and its creation
/// number.
pub(in crate::precise) fn ground_numbers() -> (u64, u32) {
    numbers_of(GeomId::new(GROUND_SLOT, 0))
}

/// Returns the numbers of a world box's proxy: its [owner](crate::precise::broad_phase::proxies::Proxy::owner) and its creation
/// number.
pub(in crate::precise) fn world_box_numbers(world_box: &WorldBox) -> (u64, u32) {
    numbers_of(GeomId::new(FIRST_WORLD_BOX_SLOT - world_box.id, 0))
}

/// Returns owner and creation number of the proxy of a world box or the ground.
fn numbers_of(id: GeomId) -> (u64, u32) {
    (owner_of(id), LAST_CREATION_NUMBER - (GROUND_SLOT - id.slot() as u32))
}

/// Returns the `BodyId` that stands for a sleeping hinged box in a snapshot, from the `GeomId` of the box.
pub(in crate::precise) fn world_box_body_id(world_box: GeomId) -> BodyId {
    BodyId::new(world_box.slot() as u32, 0)
}

/// Returns the id of the hinged box that a `BodyId` of a snapshot stands for; `None` for a real body.
pub(in crate::precise) fn world_box_of_body_id(body: BodyId) -> Option<u32> {
    let slot = body.slot() as u32;
    (slot > u32::MAX / 2 && slot <= FIRST_WORLD_BOX_SLOT).then(|| FIRST_WORLD_BOX_SLOT - slot)
}

/// Returns whether a `GeomId` stands for a geom, and not for a world box or the ground.
pub(in crate::precise) fn is_geom(id: GeomId) -> bool {
    (id.slot() as u32) <= u32::MAX / 2
}

/// Returns the contact target that a `GeomId` stands for.
pub(in crate::precise) fn contact_target_of(id: GeomId) -> DepthContactTarget {
    match id.slot() as u32 {
        GROUND_SLOT => DepthContactTarget::Ground,
        slot if is_geom(id) || slot > FIRST_WORLD_BOX_SLOT => DepthContactTarget::Geom(id),
        slot => DepthContactTarget::WorldBox(FIRST_WORLD_BOX_SLOT - slot),
    }
}

/// Interval along z in world coordinates, length units. Snapshots store the fat intervals of proxies as such values.
#[derive(Debug, Clone, Copy, PartialEq, Default, Serialize, Deserialize)]
pub(in crate::precise) struct DepthInterval {
    /// Lower end in length units, finite.
    pub(in crate::precise) low: f32,
    /// Upper end in length units, finite, >= `low`.
    pub(in crate::precise) high: f32,
}

impl DepthInterval {
    /// Returns the interval from `low` to `high`, in length units, with infinite ends replaced by the greatest finite numbers.
    /// Loading a snapshot refuses infinite ends.
    pub(in crate::precise) fn new(low: f32, high: f32) -> Self {
        DepthInterval { low: low.max(f32::MIN), high: high.min(f32::MAX) }
    }

    /// Returns whether two intervals overlap or touch.
    pub(in crate::precise) fn overlaps(self, other: DepthInterval) -> bool {
        self.low <= other.high && other.low <= self.high
    }

    /// Returns whether this interval contains another one.
    pub(in crate::precise) fn contains(self, other: DepthInterval) -> bool {
        self.low <= other.low && self.high >= other.high
    }

    /// Returns the smallest interval that contains this interval and `other`.
    pub(in crate::precise) fn union(self, other: DepthInterval) -> DepthInterval {
        let low = if other.low < self.low { other.low } else { self.low };
        DepthInterval { low, high: if other.high > self.high { other.high } else { self.high } }
    }
}
