//! Types at the interface to an engine with depth (`twohalf`): bodies, shapes and world boxes that it passes in, and contacts
//! that it reads.
//!
//! Coordinates are x right, y down, z into the picture. Lengths are in length units, times in seconds, angles in radians.

use serde::{Deserialize, Serialize};

use crate::footprint_corners::FootprintCorners;
use crate::slanted_box::SlantedBox;
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

impl DepthShape {
    /// Returns whether the ground under the geom has a restitution coefficient above 0.
    pub fn bounces_on_ground(&self) -> bool {
        self.ground_surface.is_some_and(|[_, restitution]| restitution > 0.0)
    }
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
        footprint: FootprintCorners,
        /// Half of the height in length units, >= 0.
        half_height: f32,
    },
}

impl VerticalShape {
    /// Returns the bounding rectangle in the plane of x and y: centre relative to the origin of the geom, and half extents.
    /// Length units.
    pub fn front_box(&self) -> ([f32; 2], [f32; 2]) {
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

/// Collision filter of a box, as numbers.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct FilterNumbers {
    /// Categories of the box, as bit flags.
    pub categories: i32,
    /// Categories that the box collides with, as bit flags.
    pub collides_with: i32,
    /// Group of the box, any number without a unit; 0 for none.
    pub group: i32,
    /// Whether the box collides at all.
    pub is_enabled: bool,
    /// Whether contacts of the box exert impulses.
    pub responds: bool,
}

impl FilterNumbers {
    /// Returns the filter in the form of [`Proxy::filter`](crate::broad_phase::proxies::Proxy::filter).
    pub(super) fn of_proxy(&self) -> [i32; 5] {
        [self.categories, self.collides_with, self.group, i32::from(self.is_enabled), 0]
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
    pub filter: FilterNumbers,
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

/// Interval along z in world coordinates, length units. Snapshots store the fat intervals of proxies as such values.
#[derive(Debug, Clone, Copy, PartialEq, Default, Serialize, Deserialize)]
pub struct DepthInterval {
    /// Lower end in length units, finite.
    pub low: f32,
    /// Upper end in length units, finite, >= `low`.
    pub high: f32,
}

impl DepthInterval {
    /// Returns the interval from `low` to `high`, in length units, with infinite ends replaced by the greatest finite numbers.
    /// Loading a snapshot refuses infinite ends.
    pub fn new(low: f32, high: f32) -> Self {
        DepthInterval { low: low.max(f32::MIN), high: high.min(f32::MAX) }
    }

    /// Returns whether two intervals overlap or touch.
    pub fn overlaps(self, other: DepthInterval) -> bool {
        self.low <= other.high && other.low <= self.high
    }

    /// Returns whether this interval contains another one.
    pub(crate) fn contains(self, other: DepthInterval) -> bool {
        self.low <= other.low && self.high >= other.high
    }

    /// Returns the smallest interval that contains this interval and `other`.
    pub(crate) fn union(self, other: DepthInterval) -> DepthInterval {
        let low = if other.low < self.low { other.low } else { self.low };
        DepthInterval { low, high: if other.high > self.high { other.high } else { self.high } }
    }
}
