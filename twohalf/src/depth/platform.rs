//! Platforms: boxes with depth and infinite mass that objects stand on, bump into and pass under (thesis
//! 3.6).

mod swing;
mod turned;

use farseer_core::depth::{WorldBox, WorldBoxMotion};
use farseer_core::math::scalar;
use farseer_core::{
    ArgumentNames, CollisionCategory, CollisionFilter, RejectedArguments, SurfaceCoefficients,
};
use serde::{Deserialize, Serialize};

use super::platform_id::PlatformId;
#[cfg(doc)]
use crate::PlatformMut;
use crate::error::invalid;
use crate::projection::to_world;
use crate::shapes::SlantedBox;
use crate::{Projection, Result, TextureId, Vector3};
pub use swing::Swing;

/// A box of infinite mass: width along X, height, and depth along Z, in px.
///
/// `rotation` tilts it about its centre in the plane of X and Y: a slope. `angle_in_z_axis` shears it, so
/// that its edges in depth run at that angle on the screen; at the simulator's own angle it is a plain box.
/// Objects land on it where their footprints overlap. They walk off every edge, bump into its sides, front
/// and underside, and pass under it.
///
/// With [`DepthScheme::Precise`](crate::DepthScheme::Precise) it may [move](PlatformMut::set_velocity) or
/// [turn](PlatformMut::set_angular_velocity) about an upright axis and carries objects by friction. It may
/// also [swing](PlatformMut::set_swing) about a hinge, pushed by contacts. Its surface may be a
/// [belt](PlatformMut::set_surface_speed) or [rise along Z](PlatformMut::set_pitch).
///
/// Collision filter and coefficients are set as those of a geom, in the [mutable view](PlatformMut). Friction
/// and restitution are 0 by default.
#[derive(Debug, Clone, Serialize, Deserialize)]
pub struct Platform {
    /// Width along X, px.
    width: f32,
    /// Height, px.
    height: f32,
    /// Depth along Z, px.
    depth: f32,
    position3d: Vector3,
    /// Tilt, radians, clockwise on the screen.
    rotation: f32,
    /// Direction of its edges in depth on the screen, degrees.
    angle_in_z_axis: i32,
    shadow_image: Option<TextureId>,
    filter: CollisionFilter,
    surface: SurfaceCoefficients,
    /// Arguments that setters have refused since the last report.
    rejected: RejectedArguments<PlatformArguments>,
    /// Speed of the surface along the level edges and along Z, px/s.
    surface_speed: [f32; 2],
    motion: Option<PlatformMotion>,
    is_one_way: bool,
    /// Slope of the top along Z, radians; positive rises towards the back.
    pitch: f32,
    /// Angle about the upright axis, radians; `None` if it was never turned.
    yaw: Option<f32>,
    /// Box in the frame of the narrow phase (px, y down), computed from the other fields.
    #[serde(skip)]
    shape: SlantedBox,
}

/// Names of the arguments that setters of platforms may refuse.
#[derive(Debug)]
struct PlatformArguments;

impl ArgumentNames for PlatformArguments {
    const NAMES: &'static [&'static str] = &["friction_coefficient", "restitution_coefficient"];
}

/// Motion of a kinematic or hinged platform.
#[derive(Debug, Clone, Copy, PartialEq, Default, Serialize, Deserialize)]
struct PlatformMotion {
    /// Centre of the box in the frame of the narrow phase (px, y down). The position of the platform is derived from it.
    centre: Vector3,
    /// Target of the platform's position in the world, px; `None` if it follows its velocity.
    target: Option<Vector3>,
    /// The motion in the form that the core takes.
    #[serde(rename = "told")]
    core_motion: WorldBoxMotion,
}

impl PlatformMotion {
    /// Returns whether all numbers are finite: false only for a damaged save.
    fn is_finite(&self) -> bool {
        let WorldBoxMotion { velocity, target, displacement: way, yaw_rate: turning, yaw_target, .. } =
            self.core_motion;
        let is_driven = target.is_some() || yaw_target.is_some() || velocity != [0.0; 3];
        if self.core_motion.hinge().is_some_and(|swing| is_driven || !swing::is_valid(swing)) {
            return false;
        }
        let turns = [turning, yaw_target.map_or(0.0, |(target, _)| target)];
        let towards = target.map_or([0.0; 3], |(target, _)| target);
        let position = self.target.unwrap_or_default();
        let numbers = self.centre.iter().chain(position.iter()).copied();
        numbers.chain(velocity).chain(towards).chain(way).chain(turns).all(|number| number.is_finite())
    }
}

/// Construction and changes of platforms.
impl Platform {
    /// Returns a platform of a width, height and depth, px.
    pub(crate) fn checked(
        [width, height, depth]: [f32; 3],
        position3d: Vector3,
        rotation: f32,
        angle_in_z_axis: i32,
        shadow_image: Option<TextureId>,
        projection: &Projection,
    ) -> Result<Self> {
        for (argument, value) in [("width", width), ("height", height), ("depth", depth)] {
            if !(value.is_finite() && value > 0.0) {
                return Err(invalid(argument, value, "finite and greater than 0"));
            }
        }
        if !(1..180).contains(&angle_in_z_axis) {
            return Err(invalid(
                "angle_in_z_axis",
                angle_in_z_axis,
                "greater than 0 and less than 180 degrees",
            ));
        }
        let platform = Platform {
            width,
            height,
            depth,
            position3d,
            rotation,
            angle_in_z_axis,
            shadow_image,
            filter: CollisionFilter::default(),
            surface: SurfaceCoefficients::default(),
            rejected: RejectedArguments::default(),
            surface_speed: [0.0; 2],
            motion: None,
            is_one_way: false,
            pitch: 0.0,
            yaw: None,
            shape: SlantedBox::default(),
        };
        platform.shaped(projection)
    }

    /// Returns the platform with its box computed from its other properties.
    pub(super) fn shaped(mut self, projection: &Projection) -> Result<Self> {
        let Platform { width, height, depth, position3d, rotation, angle_in_z_axis, motion, .. } = self;
        if !rotation.is_finite() {
            return Err(invalid("rotation", rotation, "finite"));
        }
        let (sin, cos) = scalar::sin_cos_of_any(rotation);
        let half = [width * 0.5, height * 0.5, depth * 0.5];
        let (turn_sin, turn_cos) = self.yaw.map_or((0.0, 1.0), scalar::sin_cos_of_any);
        self.shape = SlantedBox {
            centre: motion.map_or(self.middle(position3d), |motion| motion.centre),
            half,
            cos,
            sin,
            shear: projection.shear_of(angle_in_z_axis),
            climb: self.climb(),
            turn: [turn_cos, turn_sin],
        };
        self.check_turn()?;
        self.check_hinge()?;
        let (mut low, mut high) = self.shape.bounds();
        if self.yaw.is_some() {
            // The box may turn about the upright axis later, through any angle: its corners stay within this reach of its
            // centre.
            let reach = half[0] + half[2];
            let reach = Vector3::new(reach, 0.0, reach);
            (low, high) = (low.inf(&(self.shape.centre - reach)), high.sup(&(self.shape.centre + reach)));
        }
        // Differences within the box must be finite as well.
        if !(high - low).iter().chain(low.iter()).chain(high.iter()).all(|number| number.is_finite()) {
            return Err(invalid("position3d", position3d, "finite and near enough for finite corners"));
        }
        Ok(self)
    }

    /// Returns the centre of the box for a position of the platform, in the frame of the narrow phase (px, y down).
    fn middle(&self, position3d: Vector3) -> Vector3 {
        Vector3::new(position3d.x, -(position3d.y + self.height * 0.5), position3d.z)
    }

    /// Returns the platform at another position in the world, px.
    pub(crate) fn at(&self, position3d: Vector3, projection: &Projection) -> Result<Self> {
        let mut platform = Platform { position3d, ..self.clone() };
        let centre = platform.middle(position3d);
        platform.motion = platform.motion.map(|motion| PlatformMotion { centre, ..motion });
        platform.move_hinge(centre);
        platform.shaped(projection)
    }

    /// Returns the platform at another tilt, radians.
    pub(crate) fn tilted(&self, rotation: f32, projection: &Projection) -> Result<Self> {
        Platform { rotation, ..self.clone() }.shaped(projection)
    }

    /// Sets a velocity (px/s), or a target position (px), of the platform. Returns whether the platform was static before; the
    /// core then receives it as a moving box.
    pub(crate) fn set_motion(&mut self, velocity: Vector3, target: Option<Vector3>) -> bool {
        let towards = target.map(|target| (self.middle(target).into(), false));
        let core_motion = self.motion.map(|motion| motion.core_motion).unwrap_or_default();
        let stood_still = self.motion.is_none();
        self.motion = Some(PlatformMotion {
            centre: self.shape.centre,
            target,
            core_motion: WorldBoxMotion { velocity: velocity.into(), target: towards, ..core_motion },
        });
        stood_still
    }

    /// Returns the platform with a belt of this speed as its surface, px/s.
    pub(crate) fn with_surface_speed(&self, surface_speed: [f32; 2]) -> Result<Self> {
        let platform = Platform { surface_speed, ..self.clone() };
        platform.check_turn()?;
        Ok(platform)
    }

    pub(crate) fn set_one_way(&mut self, value: bool) {
        self.is_one_way = value;
    }

    pub(crate) fn filter_mut(&mut self) -> &mut CollisionFilter {
        &mut self.filter
    }

    /// Sets a coefficient of the surface. A value that is not finite is refused, and the name of the argument is added to
    /// `rejected`.
    pub(crate) fn set_coefficient(
        &mut self,
        argument: &'static str,
        value: f32,
        field: impl Fn(&mut SurfaceCoefficients) -> &mut f32,
    ) {
        if value.is_finite() {
            *field(&mut self.surface) = value;
        } else {
            self.rejected.note(argument);
        }
    }

    /// Drains the arguments that setters have refused.
    pub(super) fn take_rejected(&mut self) -> impl Iterator<Item = &'static str> + '_ {
        self.rejected.take()
    }

    /// Returns whether all values are in range: false only for a damaged save. Recomputes the shape.
    pub(super) fn restore(&mut self, projection: &Projection) -> bool {
        let sizes = [self.width, self.height, self.depth];
        let is_valid = sizes.iter().all(|size| size.is_finite() && *size > 0.0)
            && (1..180).contains(&self.angle_in_z_axis)
            && self.surface.friction.is_finite()
            && self.surface.restitution.is_finite()
            && self.surface_speed.iter().all(|speed| speed.is_finite())
            && self.motion.is_none_or(|motion| motion.is_finite());
        match self.clone().shaped(projection) {
            Ok(shaped) if is_valid => {
                *self = shaped;
                true
            }
            _ => false,
        }
    }

    /// Returns the platform as a world box of the core.
    pub(crate) fn fixture(&self, id: PlatformId) -> WorldBox {
        WorldBox {
            id: id.number(),
            shape: self.shape,
            rotation: self.rotation,
            filter: self.filter.into(),
            surface: self.surface,
            yaw: self.yaw,
            surface_velocity: self.surface_velocity(),
            motion: self.core_motion(),
            is_one_way: self.is_one_way,
        }
    }

    pub(crate) fn core_motion(&self) -> Option<WorldBoxMotion> {
        self.motion.map(|motion| motion.core_motion)
    }

    /// Returns whether the platform has a feature that only the precise set supports.
    pub(super) fn is_precise(&self) -> bool {
        self.motion.is_some()
            || self.surface_speed != [0.0; 2]
            || self.is_one_way
            || self.is_sloped_or_turned()
    }

    /// Stores centre, yaw and motion of the platform after an update of the core.
    pub(super) fn has_moved(&mut self, centre: Vector3, yaw: Option<f32>, core_motion: WorldBoxMotion) {
        let Some(motion) = &mut self.motion else { return };
        let has_landed = core_motion.target.is_some_and(|(_, is_reached)| is_reached);
        if let Some(target) = motion.target.filter(|_| has_landed) {
            self.position3d = target;
        } else if centre != motion.centre {
            self.position3d = Vector3::new(centre.x, -centre.y - self.height * 0.5, centre.z);
        }
        (motion.centre, motion.core_motion, self.shape.centre) = (centre, core_motion, centre);
        if let Some(yaw) = yaw.filter(|_| yaw != self.yaw) {
            let (sin, cos) = scalar::sin_cos_of_any(yaw);
            (self.yaw, self.shape.turn) = (Some(yaw), [cos, sin]);
        }
        motion.target = motion.target.filter(|_| core_motion.target.is_some());
    }
}

/// Properties of platforms.
impl Platform {
    /// Width along X in px, before the tilt.
    pub fn width(&self) -> f32 {
        self.width
    }

    /// Height in px, before the tilt.
    pub fn height(&self) -> f32 {
        self.height
    }

    /// Depth along Z in px.
    pub fn depth(&self) -> f32 {
        self.depth
    }

    /// X and Z of the centre of the box, and as Y the height of its underside when level; px.
    #[doc(alias = "Position3D")]
    pub fn position3d(&self) -> Vector3 {
        self.position3d
    }

    /// Tilt in radians, clockwise on the screen.
    #[doc(alias = "Rotation")]
    pub fn rotation(&self) -> f32 {
        self.rotation
    }

    /// Direction of its edges in depth on the screen, degrees counterclockwise from the x axis.
    pub fn angle_in_z_axis(&self) -> i32 {
        self.angle_in_z_axis
    }

    /// The picture of its shadow.
    pub fn shadow_image(&self) -> Option<TextureId> {
        self.shadow_image
    }

    /// Collision filter.
    pub(crate) fn filter(&self) -> &CollisionFilter {
        &self.filter
    }

    /// Friction coefficient, dimensionless; combined with a geom's by the simulator's friction type: mean or
    /// minimum. Default 0, as a geom's.
    #[doc(alias = "FrictionCoefficient")]
    pub fn friction_coefficient(&self) -> f32 {
        self.surface.friction
    }

    /// Restitution coefficient, dimensionless, usually 0 to 1; combined with a geom's by their mean. Default
    /// 0, as a geom's.
    #[doc(alias = "RestitutionCoefficient")]
    pub fn restitution_coefficient(&self) -> f32 {
        self.surface.restitution
    }

    /// Collision categories that it belongs to. Default all.
    #[doc(alias = "CollisionCategories")]
    pub fn collision_categories(&self) -> CollisionCategory {
        self.filter.categories
    }

    /// Collision categories that it collides with. A pair collides if **either** mask contains the other's
    /// categories. Default all.
    #[doc(alias = "CollidesWith")]
    pub fn collides_with(&self) -> CollisionCategory {
        self.filter.collides_with
    }

    /// Collision group: it does not collide with geoms of the same group; 0 is no group. Default 0.
    #[doc(alias = "CollisionGroup")]
    pub fn collision_group(&self) -> i32 {
        self.filter.group
    }

    /// Returns whether it collides at all. Default true.
    #[doc(alias = "CollisionEnabled")]
    pub fn collision_enabled(&self) -> bool {
        self.filter.is_enabled
    }

    /// Returns whether its contacts exert impulses; they are reported either way. Default true.
    #[doc(alias = "CollisionResponseEnabled")]
    pub fn collision_response_enabled(&self) -> bool {
        self.filter.responds
    }

    /// Velocity of its centre in the world, px/s, Y up. With a [target](PlatformMut::move_to) it has the
    /// velocity of that move for one update.
    pub fn velocity(&self) -> Vector3 {
        self.swinging_velocity().unwrap_or_else(|| to_world(self.prescribed_velocity()))
    }

    /// Speed of its surface along its level edges and along Z, px/s.
    pub fn surface_speed(&self) -> [f32; 2] {
        self.surface_speed
    }

    /// Returns whether it is one-way: objects above its top land on it, all others pass through.
    pub fn is_one_way(&self) -> bool {
        self.is_one_way
    }

    /// The eight corners in the world, px. The first four are those of the front face (smaller Z), clockwise
    /// on the screen from the top left one before the tilt. The corners of the back face follow in the same
    /// order.
    pub fn corners(&self) -> [Vector3; 8] {
        self.shape.corners().map(to_world)
    }

    /// Returns the velocity that the game has set, in the frame of the narrow phase (y down), px/s.
    pub(crate) fn prescribed_velocity(&self) -> Vector3 {
        self.motion.map_or(Vector3::zeros(), |motion| motion.core_motion.velocity.into())
    }

    /// Returns the box in the frame of the narrow phase (px, y down).
    pub(crate) fn shape(&self) -> &SlantedBox {
        &self.shape
    }
}
