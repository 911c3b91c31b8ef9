//! What an engine with depth tells of its bodies, geoms and fixtures.

use serde::{Deserialize, Serialize};

use crate::body::BodyId;
use crate::geom::GeomId;
use crate::geom::filter::CollisionFilter;
use crate::geom::surface::SurfaceCoefficients;
use crate::math::Vector2;
use crate::shape::{Footprint, SlantedBox};
use crate::storage::arena::Id;

/// How a body moves along the depth axis, and a ball about the axes of the plane.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct SpaceBody {
    /// Where it is, in units of length.
    pub z: f32,
    /// Velocity along the axis: of what stands still that of its surface, a belt.
    pub velocity: f32,
    /// What forces add to it in a second.
    pub acceleration: f32,
    /// Way of the last step along x, y and z.
    pub motion: [f32; 3],
    /// About x and y, in rad/s: nothing to what is no ball, all of whose geoms are round about its origin.
    pub angular_velocity: [f32; 2],
    /// How deep it was in what it parted from last, if that gives way nowhere.
    pub sunk: f32,
    /// Where a kinematic body is brought: it is there after the next step, to the last bit, and stands still in the one after.
    pub target: Option<SpaceTarget>,
}

/// Where a kinematic body is brought along the depth axis.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct SpaceTarget {
    /// The place.
    pub z: f32,
    /// Whether the last step has brought it there.
    pub is_reached: bool,
}

/// How a geom reaches along the depth axis.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct SpaceProfile {
    /// How far to both sides.
    pub half_depth: f32,
    /// Whether it is a ball, and not its outline, extruded.
    pub is_round: bool,
    /// Friction and restitution of the ground that it rests on; without, it falls for ever.
    pub ground: Option<[f32; 2]>,
    /// What it is instead of its outline, if it stands upright whatever happens: then nothing turns its body.
    pub upright: Option<SpaceUpright>,
}

/// What stands upright, about the origin of its geom.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum SpaceUpright {
    /// A disc, drawn out along y.
    Cylinder {
        /// Of the disc.
        radius: f32,
        /// How far up and down.
        half_height: f32,
    },
    /// All that is as near to an upright segment.
    Capsule {
        /// Of its ends, and all around.
        radius: f32,
        /// How far up and down, with its ends: no less than the radius.
        half_height: f32,
    },
    /// A polygon in the plane of x and z, drawn out along y.
    Prism {
        /// The polygon.
        footprint: Footprint,
        /// How far up and down.
        half_height: f32,
    },
}

impl SpaceUpright {
    /// The box about it in the plane: its middle as seen from the origin of its geom, and half of its sides.
    pub(in crate::precise) fn front(&self) -> ([f32; 2], [f32; 2]) {
        match *self {
            SpaceUpright::Cylinder { radius, half_height }
            | SpaceUpright::Capsule { radius, half_height } => ([0.0; 2], [radius, half_height]),
            SpaceUpright::Prism { footprint, half_height } => {
                let (low, high) = footprint.bounds();
                ([0.5 * (low.x + high.x), 0.0], [0.5 * (high.x - low.x), half_height])
            }
        }
    }
}

/// Something that nothing pushes and that is no geom: a box with depth, which may be tilted in the plane.
#[derive(Debug, Clone)]
pub struct Fixture {
    /// Its name, which no other one has had: less than 2^31, and greater than those of the fixtures before it.
    pub id: u32,
    /// Where it is, with y down.
    pub shape: SlantedBox,
    /// Its tilt in the plane, in rad.
    pub rotation: f32,
    /// The angle by which it is turned about the upright axis through its middle, from x to z, if it is or is going to be: then it is
    /// level.
    pub yaw: Option<f32>,
    /// Whom it may meet.
    pub filter: CollisionFilter,
    /// How it rubs and bounces.
    pub surface: SurfaceCoefficients,
    /// Speed of its surface along x, y and z, beside that of its own motion: a belt.
    pub surface_velocity: [f32; 3],
    /// How it moves, if it does not stand still.
    pub motion: Option<FixtureMotion>,
    /// Whether only what is above its top lands on it, and everything else passes through it.
    pub is_one_way: bool,
}

impl Fixture {
    /// What it swings about.
    pub(super) fn swing(&self) -> Option<&FixtureSwing> {
        self.motion.as_ref()?.swing()
    }
}

/// How a fixture moves that does not stand still: as a kinematic body does, but for what it turns about.
#[derive(Debug, Clone, Copy, PartialEq, Default, Serialize, Deserialize)]
pub struct FixtureMotion {
    /// Velocity along x, y (down) and z.
    pub velocity: [f32; 3],
    /// Where its middle is brought, and whether the last step has brought it there; it stands still in the one after.
    pub target: Option<([f32; 3], bool)>,
    /// Way of the last step along x, y and z.
    pub way: [f32; 3],
    /// How fast it turns about the upright axis, from x to z, in rad/s.
    pub turning: f32,
    /// The angle to which it is turned, and whether the last step has done so; it stands still in the one after.
    pub yaw_target: Option<(f32, bool)>,
    /// About what it swings, if it does: then nothing else moves it. To be [asked for](Self::swing).
    pub swing: Option<FixtureSwing>,
}

impl FixtureMotion {
    /// About what it swings. Nothing, where nothing can: the compiler does not see by itself that there is none.
    pub fn swing(&self) -> Option<&FixtureSwing> {
        if Swings::ARE_THERE { self.swing.as_ref() } else { None }
    }

    /// The same, to change it.
    pub fn swing_mut(&mut self) -> Option<&mut FixtureSwing> {
        if Swings::ARE_THERE { self.swing.as_mut() } else { None }
    }
}

/// What a fixture swings about: an upright hinge, about which it turns as what presses on it, a spring and a damper tell it to.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct FixtureSwing {
    /// That fixtures can swing; first, so that no more of one is read where they cannot.
    pub proof: Swings,
    /// The hinge, along x and z.
    pub hinge: [f32; 2],
    /// Where the middle of the box is as seen from there, while it is not turned.
    pub out: [f32; 2],
    /// Moment of inertia about the hinge.
    pub inertia: f32,
    /// Torque of the spring per rad.
    pub stiffness: f32,
    /// Torque of the damper per rad/s.
    pub damping: f32,
    /// The angle towards which the spring turns it.
    pub rest_angle: f32,
    /// The least and the greatest angle to which it turns.
    pub stops: [f32; 2],
    /// The torque by which damper and stops have held it at the end of the last step.
    pub held: f32,
    /// It has become otherwise since that step.
    pub is_edited: bool,
}

/// That fixtures can swing. Without the feature there is no such value, so that the compiler leaves out all that swinging needs.
#[cfg(feature = "swing")]
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct Swings;
/// That fixtures can swing: they cannot.
#[cfg(not(feature = "swing"))]
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub enum Swings {}

impl Swings {
    /// Whether they can, where the compiler does not see by itself that nothing is there.
    pub const ARE_THERE: bool = cfg!(feature = "swing");

    /// It, if they can.
    pub fn new() -> Option<Self> {
        #[cfg(feature = "swing")]
        return Some(Swings);
        #[cfg(not(feature = "swing"))]
        None
    }
}

/// What a geom touches that is no geom.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum SpacePartner {
    /// Another geom.
    Geom(GeomId),
    /// A fixture, by its name.
    Fixture(u32),
    /// The plane y = 0, below everything.
    Ground,
}

/// Two that touch in three axes.
#[derive(Debug, Clone, Copy)]
pub struct SpaceTouch {
    /// The geom that is told; of two the younger one.
    pub this: GeomId,
    /// Its body.
    pub body: BodyId,
    /// What it touches.
    pub partner: SpacePartner,
    /// Which of its convex pieces touches which one of the partner's.
    pub pieces: [u32; 2],
    /// The partner's body, if that is a geom: as `body` that of the last step.
    pub partner_body: Option<BodyId>,
    /// From the partner to this: x, y (down) and z.
    pub normal: [f32; 3],
    /// Where along the depth axis, as the two were in the last step: in the middle of what both geoms cover, and in that of the
    /// body where the partner is no geom.
    pub z: f32,
    /// How many points.
    pub count: usize,
    /// The points, the first `count` of them.
    pub points: [SpacePoint; 2],
    /// Friction of both.
    pub friction: f32,
    /// Restitution of both.
    pub restitution: f32,
    /// Whether they push each other.
    pub responds: bool,
    /// Whether they touched, or were to touch, when the step began.
    pub is_told: bool,
}

/// Two that begin or cease to touch.
#[derive(Debug, Clone, Copy)]
pub struct SpaceChange {
    /// The geom that is told; of two the younger one.
    pub this: GeomId,
    /// What it touches.
    pub partner: SpacePartner,
    /// How they touch, if they begin to.
    pub touch: Option<SpaceTouch>,
}

/// A point at which two touch.
#[derive(Debug, Clone, Copy, Default)]
pub struct SpacePoint {
    /// In the plane, y down.
    pub position: Vector2,
    /// Negative where they overlap.
    pub separation: f32,
    /// Which corner or edge it is, as long as it is the same.
    pub feature: u32,
    /// Of the last update.
    pub impulse: f32,
    /// Along both tangents.
    pub friction_impulse: [f32; 2],
}

/// In place of geoms: the ground, and fixtures, from the last slot on.
const GROUND: u32 = u32::MAX - 1;
const FIRST_FIXTURE: u32 = u32::MAX - 2;
/// Creation numbers of what is no geom, later than all others.
const LAST_NUMBER: u32 = u32::MAX;

/// The name of the ground, and of fixtures, among geoms.
pub(in crate::precise) fn ground_id() -> GeomId {
    GeomId::new(GROUND, 0)
}

pub(in crate::precise) fn fixture_id(fixture: &Fixture) -> GeomId {
    GeomId::new(FIRST_FIXTURE - fixture.id, 0)
}

/// The name among bodies of the fixture with this id among geoms, for one that falls asleep with them; and the fixture of such
/// a name.
pub(super) fn fixture_body(fixture: GeomId) -> BodyId {
    BodyId::new(fixture.slot() as u32, 0)
}

pub(super) fn fixture_of_body(body: BodyId) -> Option<u32> {
    let slot = body.slot() as u32;
    (slot > u32::MAX / 2 && slot <= FIRST_FIXTURE).then(|| FIRST_FIXTURE - slot)
}

/// Whether it is the name of a geom.
pub(in crate::precise) fn is_geom(id: GeomId) -> bool {
    (id.slot() as u32) <= u32::MAX / 2
}

/// The creation number that it is given.
pub(in crate::precise) fn number_of(id: GeomId) -> u32 {
    LAST_NUMBER - (GROUND - id.slot() as u32)
}

/// What a name stands for.
pub(in crate::precise) fn partner_of(id: GeomId) -> SpacePartner {
    match id.slot() as u32 {
        GROUND => SpacePartner::Ground,
        slot if is_geom(id) || slot > FIRST_FIXTURE => SpacePartner::Geom(id),
        slot => SpacePartner::Fixture(FIRST_FIXTURE - slot),
    }
}

/// Bounds along the depth axis, as they are saved.
#[derive(Debug, Clone, Copy, PartialEq, Default, Serialize, Deserialize)]
pub(in crate::precise) struct Depths {
    pub(in crate::precise) low: f32,
    pub(in crate::precise) high: f32,
}

impl Depths {
    /// What is beyond all numbers ends at the last one: bounds are saved, and have to be finite for that.
    pub(super) fn new(low: f32, high: f32) -> Self {
        Depths { low: low.max(f32::MIN), high: high.min(f32::MAX) }
    }

    pub(super) fn overlap(self, other: Depths) -> bool {
        self.low <= other.high && other.low <= self.high
    }

    pub(in crate::precise) fn contains(self, other: Depths) -> bool {
        self.low <= other.low && self.high >= other.high
    }

    pub(in crate::precise) fn with(self, other: Depths) -> Depths {
        let low = if other.low < self.low { other.low } else { self.low };
        Depths { low, high: if other.high > self.high { other.high } else { self.high } }
    }
}
