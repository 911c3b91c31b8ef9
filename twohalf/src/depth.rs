//! What a body and a geom have beyond those of the 2D engine.

use farseer_core::math::scalar::nearest_finite;
use farseer_core::shape::Aabb;
use farseer_core::{ArgumentNames, Body, BodyId, Footprint, GeomId, GeomRef, PhysicsSimulator, Refusals, SpaceTarget};
use serde::{Deserialize, Serialize};

use crate::error::invalid;
use crate::ground::Ground;
use crate::id_table::IdTable;
use crate::support::Support;
use crate::upright::half_height;
use crate::{Result, Vector3};

/// How the outline of a geom becomes a body of three dimensions.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub enum DepthProfile {
    /// The outline, extruded to this depth: half of it before and half of it behind the body's Z.
    Prism {
        /// Extent along Z in px, 0 or more.
        depth: f32,
    },
    /// A ball about the geom's origin. On the ground it touches in one point and rolls in every direction.
    Round {
        /// Radius in px, greater than 0.
        radius: f32,
    },
    /// An upright cylinder about the geom's origin. It never turns, nor does its body: see [`Upright`](Self::Upright).
    Cylinder {
        /// Radius in px, greater than 0.
        radius: f32,
        /// Height in px, greater than 0.
        height: f32,
    },
    /// An upright capsule about the geom's origin: a cylinder whose ends are halves of balls, so that it slides over edges. It
    /// never turns, nor does its body: see [`Upright`](Self::Upright).
    Capsule {
        /// Radius in px, greater than 0.
        radius: f32,
        /// Height in px with both ends, at least twice the radius.
        height: f32,
    },
    /// An upright prism: a footprint, drawn out along Y, half of its height above and half below the geom's origin. Only with
    /// [`DepthScheme::Precise`](crate::DepthScheme::Precise), as cylinders and capsules.
    ///
    /// It stays upright: contacts and torques do not turn its body, and what a game turns by hand is its picture. Against others
    /// that are upright, and platforms, its sides count wherever they look; against extruded outlines and balls as well.
    Upright {
        /// What it covers of X and Z, about the geom's origin.
        footprint: Footprint,
        /// Height in px, greater than 0.
        height: f32,
    },
}

impl DepthProfile {
    /// Half of the extent along Z in px.
    pub fn half_depth(&self) -> f32 {
        match *self {
            DepthProfile::Prism { depth } => depth * 0.5,
            DepthProfile::Round { radius }
            | DepthProfile::Cylinder { radius, .. }
            | DepthProfile::Capsule { radius, .. } => radius,
            DepthProfile::Upright { footprint, .. } => {
                let (low, high) = footprint.bounds();
                if -low.y > high.y { -low.y } else { high.y }
            }
        }
    }

    /// Whether it stands upright whatever happens, and its body does not turn.
    pub fn is_upright(&self) -> bool {
        self.upright().is_some()
    }

    pub(crate) fn is_round(&self) -> bool {
        matches!(self, DepthProfile::Round { .. })
    }

    /// What a geom has unless it is told otherwise: a prism as deep as the shorter side of its outline's box, which may
    /// be beyond finite numbers.
    pub(crate) fn default_of(geom: GeomRef<'_>) -> Self {
        let side = Aabb::from_vertices(geom.local_vertices()).get_shortest_side();
        DepthProfile::Prism { depth: nearest_finite(side) }
    }

    /// Refuses what no shape can have.
    pub(crate) fn check(self) -> Result<Self> {
        match self {
            DepthProfile::Prism { depth } if !(depth.is_finite() && depth >= 0.0) => {
                Err(invalid("depth", depth, "finite and 0 or more"))
            }
            DepthProfile::Round { radius } if !(radius.is_finite() && radius > 0.0) => {
                Err(invalid("radius", radius, "finite and greater than 0"))
            }
            DepthProfile::Cylinder { radius, height } | DepthProfile::Capsule { radius, height } => {
                let is_size = |size: f32| size.is_finite() && size > 0.0;
                let is_capsule = matches!(self, DepthProfile::Capsule { .. });
                if !is_size(radius) {
                    return Err(invalid("radius", radius, "finite and greater than 0"));
                }
                if !is_size(height) || (is_capsule && height < 2.0 * radius) {
                    let wanted = "finite and greater than 0, and no less than twice the radius of a capsule";
                    return Err(invalid("height", height, wanted));
                }
                Ok(self)
            }
            DepthProfile::Upright { height, .. } if !(height.is_finite() && height > 0.0) => {
                Err(invalid("height", height, "finite and greater than 0"))
            }
            _ => Ok(self),
        }
    }
}

/// The motion of a body along Z, and its ground.
#[derive(Debug, Clone, Default, Serialize, Deserialize)]
pub(crate) struct DepthBody {
    pub(crate) z: f32,
    pub(crate) velocity_z: f32,
    /// Rolling: rotation about the x axis and, with y down, the y axis, which is not drawn.
    pub(crate) angular_velocity_x: f32,
    pub(crate) angular_velocity_y: f32,
    /// How the body moved in the last update, y down; `None` before its first.
    pub(crate) motion: Option<Vector3>,
    /// Velocity along Z that only undid overlap in the last update.
    #[serde(skip)]
    pub(crate) bias_z: f32,
    pub(crate) force_z: f32,
    pub(crate) impulse_z: f32,
    /// Where a kinematic body is brought.
    pub(crate) target: Option<SpaceTarget>,
    pub(crate) ground: Ground,
    /// What held the body up best in the last update.
    pub(crate) support: Option<Support>,
    /// Whether that was in the update before the last, and the body has hardly moved since.
    pub(crate) is_support_kept: bool,
    /// Arguments that setters of this engine have refused and nobody was told of yet.
    pub(crate) rejected: Refusals<DepthArguments>,
    /// It is among the [news](Depths::news).
    #[serde(skip)]
    pub(crate) is_news: bool,
}

/// What setters of this engine refuse; what those of the 2D engine do is told by that.
#[derive(Debug)]
pub(crate) struct DepthArguments;

impl ArgumentNames for DepthArguments {
    const NAMES: &'static [&'static str] = &[
        "position3d",
        "velocity3d",
        "angular_velocity3d",
        "linear_velocity_z",
        "amount",
        "friction_coefficient",
        "restitution_coefficient",
    ];
}

impl DepthBody {
    /// Whether everything that enters arithmetic is finite: false only after loading garbage.
    pub(crate) fn is_valid(&self) -> bool {
        let numbers = [self.force_z, self.impulse_z];
        self.motion_is_finite()
            && self.motion.is_none_or(|motion| motion.iter().all(|number| number.is_finite()))
            && numbers.iter().all(|number| number.is_finite())
            && self.target.is_none_or(|target| target.z.is_finite())
            && self.ground.is_valid()
            && self.support.is_none_or(|support| support.normal.iter().all(|number| number.is_finite()))
    }

    pub(crate) fn motion_is_finite(&self) -> bool {
        let numbers = [self.z, self.velocity_z, self.angular_velocity_x, self.angular_velocity_y];
        numbers.iter().all(|number| number.is_finite())
    }

    /// Impulse, force and drag become velocity, as the 2D engine does it for X and Y (behaviour chapter 02,
    /// section 5); then force and impulse are forgotten.
    pub(crate) fn integrate_velocity(&mut self, body: &Body, dt: f32) {
        self.velocity_z += self.impulse_z * body.inverse_mass();
        let mut drag = -self.velocity_z * body.linear_drag_coefficient();
        if body.is_quadratic_drag_enabled() && self.velocity_z != 0.0 {
            let v = body.linear_velocity();
            let speed = (v.x * v.x + v.y * v.y + self.velocity_z * self.velocity_z).sqrt();
            drag -= speed * body.quadratic_drag_coefficient() * self.velocity_z.signum();
        }
        self.velocity_z += (self.force_z + drag) * body.inverse_mass() * dt;
        let (spin_x, spin_y) = (self.angular_velocity_x, self.angular_velocity_y);
        if spin_x != 0.0 || spin_y != 0.0 {
            let spin = (spin_x * spin_x + spin_y * spin_y).sqrt();
            let drag = spin * body.rotational_drag_coefficient() * body.inverse_moment_of_inertia() * dt;
            self.angular_velocity_x -= spin_x * drag;
            self.angular_velocity_y -= spin_y * drag;
        }
        self.force_z = 0.0;
        self.impulse_z = 0.0;
    }
}

/// Everything this engine keeps beside the objects of the 2D engine.
#[derive(Debug, Clone, Default, Serialize, Deserialize)]
pub(crate) struct Depths {
    pub(crate) bodies: IdTable<BodyId, DepthBody>,
    pub(crate) profiles: IdTable<GeomId, DepthProfile>,
    /// Bodies of which something has changed that the precise set is to be told of.
    #[serde(skip)]
    pub(crate) news: Vec<BodyId>,
    /// Bodies that a force waits for until they can be moved.
    #[serde(skip)]
    pub(crate) waiting: Vec<BodyId>,
    /// Whether it has been told of everything else.
    #[serde(skip)]
    pub(crate) is_told: bool,
}

impl Depths {
    /// A body, to change it, or its geoms.
    pub(crate) fn edit(&mut self, id: BodyId) -> Option<&mut DepthBody> {
        let state = self.bodies.get_mut(id)?;
        if !std::mem::replace(&mut state.is_news, true) {
            self.news.push(id);
        }
        Some(state)
    }

    pub(crate) fn insert_body(&mut self, id: BodyId) {
        self.bodies.insert(id, DepthBody::default());
        self.edit(id);
    }
}

/// Whether the solver can move a body.
pub(crate) fn is_movable(core: &PhysicsSimulator, body: BodyId) -> bool {
    core.body(body).is_some_and(|body| body.enabled() && !body.is_static() && !body.is_kinematic())
}

/// Distance from a body's origin down to the lowest point of its object geom at its present rotation; 0
/// without an object geom. Negative if all of the geom lies above the origin.
pub(crate) fn lowest(core: &PhysicsSimulator, depths: &Depths, body: BodyId) -> f64 {
    let object = depths.bodies.get(body).and_then(|state| state.ground.object_geom());
    let Some(id) = object else { return 0.0 };
    let (Some(geom), Some(origin)) = (core.geom(id).filter(|geom| geom.body() == body), core.body(body))
    else {
        return 0.0;
    };
    let matrix = geom.matrix();
    // The geom's origin as seen from the body's: exact where they coincide.
    let offset = f64::from(matrix.m42) - f64::from(origin.position().y);
    if let Some(upright) = depths.profiles.get(id).and_then(DepthProfile::upright) {
        return f64::from(geom.offset().y) + f64::from(half_height(&upright));
    }
    match depths.profiles.get(id) {
        Some(DepthProfile::Round { radius }) => offset + f64::from(*radius),
        _ => {
            let (across, down) = (f64::from(matrix.m12), f64::from(matrix.m22));
            let heights =
                geom.local_vertices().iter().map(|v| f64::from(v.x) * across + f64::from(v.y) * down);
            offset + heights.fold(f64::NEG_INFINITY, f64::max)
        }
    }
}
