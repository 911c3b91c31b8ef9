//! The simulator: owns everything.

use farseer_core::{
    Body, BodyId, Event, Geom, GeomId, GeomPlacement, GeomRef, ObjectId, PhysicsSimulator, Vertices,
};
use serde::{Deserialize, Serialize};

use crate::body::TwoHalfBody;
use crate::depth::{DepthBody, DepthProfile, Depths};
use crate::error::stale;
use crate::ground_contacts::GroundRow;
use crate::pairs::PassingPairs;
use crate::{Projection, Result, StepCounters, Vector2};

/// The Z axis of a screen whose angle is not given: straight up.
const DEFAULT_ANGLE: i32 = 90;

/// Owns bodies and geoms and moves them in steps, in three dimensions.
///
/// Objects are named by the ids of the 2D engine and live as they do there: *created*, *added* (takes part from
/// the next update), *removed* and *disposed* (its id goes stale with the next update).
///
/// ```
/// use twohalf::{TwoHalfPhysicsSimulator, Vector2, Vector3, farseer_core};
/// use farseer_core::{BodyFactory, GeomPlacement, Vertices};
///
/// let mut simulator = TwoHalfPhysicsSimulator::with_gravity(480, Vector2::new(0.0, 100.0))?;
/// let body = simulator.create_body(BodyFactory::create_rectangle_body(20.0, 20.0, 1.0)?);
/// let geom = simulator.create_geom(body, Vertices::create_rectangle(20.0, 20.0)?, GeomPlacement::default())?;
/// simulator.add(body)?;
/// simulator.add(geom)?;
///
/// let mut crate_box = simulator.body_mut(body).unwrap();
/// crate_box.ground_mut().set_object_geom(geom, None)?;
/// crate_box.set_position3d(Vector3::new(100.0, 50.0, 30.0));
/// for _ in 0..200 {
///     simulator.update(0.01);
/// }
/// let position = simulator.body(body).unwrap().position3d();
/// assert!(position.y.abs() < 0.1 && position.z == 30.0);
/// # Ok::<(), twohalf::Error>(())
/// ```
#[derive(Debug, Clone, Serialize, Deserialize)]
#[serde(remote = "Self")]
pub struct TwoHalfPhysicsSimulator {
    pub(crate) core: PhysicsSimulator,
    pub(crate) projection: Projection,
    pub(crate) depths: Depths,
    pub(crate) passing: PassingPairs,
    #[serde(skip)]
    pub(crate) rows: Vec<GroundRow>,
    /// By body slot: whether the current update moves the body.
    #[serde(skip)]
    pub(crate) is_moving: Vec<bool>,
    #[serde(skip)]
    pub(crate) events: Vec<Event>,
    /// What is to be told in the next update.
    #[serde(skip)]
    pub(crate) pending_events: Vec<Event>,
    #[serde(skip)]
    pub(crate) counters: StepCounters,
}

/// Making one.
impl TwoHalfPhysicsSimulator {
    /// An empty simulator without gravity, for a screen of `height` px whose Z axis points straight up.
    ///
    /// # Errors
    /// A height that is not greater than 0.
    #[doc(alias = "TwoHalfPhysicsSimulator(int)")]
    pub fn new(height: i32) -> Result<Self> {
        Self::with_angle(height, DEFAULT_ANGLE)
    }

    /// An empty simulator without gravity. `angle` is the direction of the Z axis on the screen, degrees
    /// counterclockwise from the x axis.
    ///
    /// # Errors
    /// A height that is not greater than 0; an angle that is not between 0 and 180.
    #[doc(alias = "TwoHalfPhysicsSimulator(int, int)")]
    pub fn with_angle(height: i32, angle: i32) -> Result<Self> {
        Self::from_core(height, angle, PhysicsSimulator::default())
    }

    /// An empty simulator with gravity: acceleration in px/s² in screen orientation, so (0, 100) pulls down.
    ///
    /// # Errors
    /// A height that is not greater than 0; gravity that is not finite.
    #[doc(alias = "TwoHalfPhysicsSimulator(int, Vector2)")]
    pub fn with_gravity(height: i32, gravity: Vector2) -> Result<Self> {
        Self::with_angle_and_gravity(height, DEFAULT_ANGLE, gravity)
    }

    /// An empty simulator with a Z axis at an angle and gravity.
    ///
    /// # Errors
    /// As [`with_angle`](Self::with_angle) and [`with_gravity`](Self::with_gravity).
    #[doc(alias = "TwoHalfPhysicsSimulator(int, int, Vector2)")]
    pub fn with_angle_and_gravity(height: i32, angle: i32, gravity: Vector2) -> Result<Self> {
        Self::from_core(height, angle, PhysicsSimulator::new(gravity)?)
    }

    /// Takes over a 2D simulator, with its settings and with the objects that take part in it or wait to be
    /// added; they enter now. Its plane becomes that of X and Y: every body is at Z = 0, with its height so that
    /// y = 0 is the ground, and no body has an object geom yet. Every geom is a prism as deep as the shorter side
    /// of its outline's box.
    ///
    /// This is also how a simulator gets another broad phase or other solver settings.
    ///
    /// # Errors
    /// A height that is not greater than 0; an angle that is not between 0 and 180.
    pub fn from_core(height: i32, angle: i32, core: PhysicsSimulator) -> Result<Self> {
        let mut simulator = TwoHalfPhysicsSimulator {
            projection: Projection::new(height, angle)?,
            core,
            depths: Depths::default(),
            passing: PassingPairs::default(),
            rows: Vec::new(),
            is_moving: Vec::new(),
            events: Vec::new(),
            pending_events: Vec::new(),
            counters: StepCounters::default(),
        };
        simulator.core.process_added_and_removed();
        let TwoHalfPhysicsSimulator { core, depths, .. } = &mut simulator;
        for &body in core.body_list() {
            adopt_body(core, depths, body);
        }
        for geom in core.geom_list() {
            adopt_body(core, depths, core.geom(*geom).ok_or(stale("geom"))?.body());
        }
        Ok(simulator)
    }
}

/// Gives a body of the 2D engine and its geoms their depth, unless they have it.
fn adopt_body(core: &PhysicsSimulator, depths: &mut Depths, body: BodyId) {
    if depths.bodies.get(body).is_none() {
        depths.bodies.insert(body, DepthBody::default());
    }
    for &id in core.geoms_of(body) {
        if let (None, Some(geom)) = (depths.profiles.get(id), core.geom(id)) {
            depths.profiles.insert(id, DepthProfile::default_of(geom));
        }
    }
}

/// Settings.
impl TwoHalfPhysicsSimulator {
    /// Height of the screen in px: the screen's y of the ground at Z = 0.
    #[doc(alias = "Height")]
    pub fn height(&self) -> i32 {
        self.projection.height()
    }

    /// Sets the height of the screen. Nothing moves in the world.
    ///
    /// # Errors
    /// What is not greater than 0.
    pub fn set_height(&mut self, height: i32) -> Result<()> {
        self.projection.set_height(height)
    }

    /// Direction of the Z axis on the screen, degrees counterclockwise from the x axis. Default 90.
    #[doc(alias = "Angle")]
    pub fn angle(&self) -> i32 {
        self.projection.angle()
    }

    /// From the world to the screen.
    pub fn projection(&self) -> &Projection {
        &self.projection
    }

    /// Acceleration in px/s² of every body that does not ignore it, in screen orientation. Default none.
    #[doc(alias = "Gravity")]
    pub fn gravity(&self) -> Vector2 {
        self.core.gravity()
    }

    /// Sets the gravity.
    ///
    /// # Errors
    /// What is not finite.
    pub fn set_gravity(&mut self, gravity: Vector2) -> Result<()> {
        Ok(self.core.set_gravity(gravity)?)
    }

    /// Passes of the solver per update. Default 5.
    #[doc(alias = "Iterations")]
    pub fn iterations(&self) -> i32 {
        self.core.iterations()
    }

    /// Sets the passes of the solver; with 0 or less only the impulses of the last update act again.
    pub fn set_iterations(&mut self, iterations: i32) {
        self.core.set_iterations(iterations);
    }

    /// Whether updates move anything; objects enter and leave either way. Default true.
    #[doc(alias = "Enabled")]
    pub fn enabled(&self) -> bool {
        self.core.enabled()
    }

    /// Lets updates move things or not.
    pub fn set_enabled(&mut self, enabled: bool) {
        self.core.set_enabled(enabled);
    }

    /// The 2D engine below, which moves everything in X and Y: its plane is that of the world, with y = -Y, so
    /// it is **not** in screen coordinates.
    pub fn core(&self) -> &PhysicsSimulator {
        &self.core
    }
}

/// What lives in the simulator.
impl TwoHalfPhysicsSimulator {
    /// Gives a body its life and id. It takes part once it is [added](Self::add).
    ///
    /// It is at Z = 0, and without an object geom: its position in the plane of the 2D engine, (0, 0) if it is a
    /// new one, is that of its origin.
    pub fn create_body(&mut self, body: Body) -> BodyId {
        let body = self.core.create_body(body);
        self.depths.bodies.insert(body, DepthBody::default());
        body
    }

    /// Attaches an outline to a body. The geom takes part once it is [added](Self::add). It is a prism as deep as
    /// the shorter side of the outline's box; see [`set_depth_profile`](Self::set_depth_profile).
    ///
    /// # Errors
    /// As [`PhysicsSimulator::create_geom`].
    pub fn create_geom(
        &mut self,
        body: BodyId,
        vertices: impl Into<Vertices>,
        placement: GeomPlacement,
    ) -> Result<GeomId> {
        let geom = self.core.create_geom(body, vertices, placement)?;
        adopt_body(&self.core, &mut self.depths, body);
        Ok(geom)
    }

    /// Lets an object take part from the next update on. Adding a body does not add its geoms.
    ///
    /// # Errors
    /// A stale id.
    #[doc(alias = "Add")]
    pub fn add(&mut self, object: impl Into<ObjectId>) -> Result<()> {
        let object = object.into();
        self.core.add(object)?;
        let body = match object {
            ObjectId::Body(body) => Some(body),
            ObjectId::Geom(geom) => self.core.geom(geom).map(|geom| geom.body()),
            _ => None,
        };
        if let Some(body) = body {
            adopt_body(&self.core, &mut self.depths, body);
        }
        Ok(())
    }

    /// Takes an object out of the simulation with the next update; see [`PhysicsSimulator::remove`].
    ///
    /// # Errors
    /// A stale id.
    #[doc(alias = "Remove")]
    pub fn remove(&mut self, object: impl Into<ObjectId>) -> Result<()> {
        Ok(self.core.remove(object)?)
    }

    /// Ends the life of an object; see [`PhysicsSimulator::dispose`].
    ///
    /// # Errors
    /// A stale id.
    #[doc(alias = "Dispose")]
    pub fn dispose(&mut self, object: impl Into<ObjectId>) -> Result<()> {
        Ok(self.core.dispose(object)?)
    }

    /// A body to look at, unless the id is stale.
    pub fn body(&self, body: BodyId) -> Option<TwoHalfBody<&Self>> {
        TwoHalfBody::new(self, body)
    }

    /// A body to change, unless the id is stale.
    pub fn body_mut(&mut self, body: BodyId) -> Option<TwoHalfBody<&mut Self>> {
        TwoHalfBody::new(self, body)
    }

    /// A geom to look at, in the plane of the 2D engine, unless the id is stale.
    pub fn geom(&self, geom: GeomId) -> Option<GeomRef<'_>> {
        self.core.geom(geom)
    }

    /// The settings of a geom to change, unless the id is stale.
    pub fn geom_mut(&mut self, geom: GeomId) -> Option<&mut Geom> {
        self.core.geom_mut(geom)
    }

    /// How a geom's outline extends in depth, unless the id is stale.
    pub fn depth_profile(&self, geom: GeomId) -> Option<DepthProfile> {
        self.core.geom(geom)?;
        self.depths.profiles.get(geom).copied()
    }

    /// Sets how a geom's outline extends in depth. If it is its body's object geom, the body's origin stays, so
    /// its height may change.
    ///
    /// # Errors
    /// A stale id; a depth that is not finite and 0 or more; a radius that is not finite and greater than 0.
    pub fn set_depth_profile(&mut self, geom: GeomId, profile: DepthProfile) -> Result<()> {
        self.core.geom(geom).ok_or(stale("geom"))?;
        self.depths.profiles.insert(geom, profile.check()?);
        Ok(())
    }

    /// The least and greatest Z of a geom, unless the id is stale.
    pub fn depth_interval(&self, geom: GeomId) -> Option<(f32, f32)> {
        let (z, half) = self.depths.extent(geom, self.core.geom(geom)?.body())?;
        Some((z - half, z + half))
    }

    /// The bodies that take part, in the order in which they were added.
    #[doc(alias = "BodyList")]
    pub fn body_list(&self) -> &[BodyId] {
        self.core.body_list()
    }

    /// The geoms that take part, in the order in which they were added.
    #[doc(alias = "GeomList")]
    pub fn geom_list(&self) -> &[GeomId] {
        self.core.geom_list()
    }

    /// What happened in the last update, in order; cleared by the next. Pairs that were refused only because
    /// they are at different depths do not appear.
    pub fn events(&self) -> &[Event] {
        &self.events
    }

    /// How much work the last update was.
    pub fn counters(&self) -> StepCounters {
        self.counters
    }
}
