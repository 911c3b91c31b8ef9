//! The simulator: owns everything.

use farseer_core::math::scalar::nearest_finite;
use farseer_core::{Body, BodyId, Geom, GeomId, GeomPlacement, Limits, ObjectId, PhysicsSimulator, Vertices};

use crate::body::TwoHalfBody;
use crate::depth::{DepthProfile, Depths};
use crate::error::{invalid, only_precise, stale};
use crate::events::Event;
use crate::geom::TwoHalfGeom;
use crate::platform::PlatformMut;
use crate::world::World;
use crate::{DepthScheme, Error, Platform, PlatformId, Projection, Result, StepCounters, Vector2};

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
#[derive(Debug, Clone)]
pub struct TwoHalfPhysicsSimulator {
    pub(crate) core: PhysicsSimulator,
    pub(crate) world: World,
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
        Self::empty(height, angle, PhysicsSimulator::default())
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
        Self::empty(height, angle, PhysicsSimulator::new(gravity)?)
    }

    fn empty(height: i32, angle: i32, core: PhysicsSimulator) -> Result<Self> {
        let mut simulator = Self::from_core(height, angle, core)?;
        simulator.set_depth_scheme(DepthScheme::default())?;
        Ok(simulator)
    }

    /// Takes over a 2D simulator, with its settings and all of its objects; those that wait to be added enter now.
    /// Its plane becomes that of X and Y: every body is at Z = 0, with its height so that y = 0 is the ground, and
    /// no body has an object geom yet. Every geom is a prism as deep as the shorter side of its outline's box.
    ///
    /// This is also how a simulator gets another broad phase or other solver settings. One of the
    /// [precise set](farseer_core::Methods::Precise) becomes one of [`DepthScheme::Precise`], any other one of
    /// [`DepthScheme::Faithful`].
    ///
    /// # Errors
    /// A height that is not greater than 0; an angle that is not between 0 and 180.
    pub fn from_core(height: i32, angle: i32, core: PhysicsSimulator) -> Result<Self> {
        let mut world = World::new(Projection::new(height, angle)?);
        let is_precise = matches!(core.methods(), farseer_core::Methods::Precise { .. });
        world.scheme = if is_precise { DepthScheme::Precise } else { DepthScheme::Faithful };
        let mut simulator = TwoHalfPhysicsSimulator { core, world };
        simulator.core.process_added_and_removed();
        if is_precise {
            simulator.core.enter_space(LENGTH_UNIT)?;
        }
        let TwoHalfPhysicsSimulator { core, world } = &mut simulator;
        for body in core.bodies() {
            adopt_body(core, &mut world.depths, body);
        }
        Ok(simulator)
    }
}

/// Size of what a player looks at, in px: see [`farseer_core::Methods::Precise`].
const LENGTH_UNIT: f32 = 32.0;

/// Gives a body of the 2D engine and its geoms their depth, unless they have it.
fn adopt_body(core: &PhysicsSimulator, depths: &mut Depths, body: BodyId) {
    if depths.bodies.get(body).is_none() {
        depths.insert_body(body);
    }
    depths.edit(body);
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
        self.world.projection.height()
    }

    /// Sets the height of the screen. Nothing moves in the world.
    ///
    /// # Errors
    /// What is not greater than 0.
    pub fn set_height(&mut self, height: i32) -> Result<()> {
        self.world.projection.set_height(height)
    }

    /// Direction of the Z axis on the screen, degrees counterclockwise from the x axis. Default 90.
    #[doc(alias = "Angle")]
    pub fn angle(&self) -> i32 {
        self.world.projection.angle()
    }

    /// From the world to the screen.
    pub fn projection(&self) -> &Projection {
        &self.world.projection
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

    /// What this simulator may cost.
    pub fn limits(&self) -> Limits {
        self.core.limits()
    }

    /// Sets what this simulator may cost: [`PhysicsSimulator::set_limits`].
    pub fn set_limits(&mut self, limits: Limits) {
        self.core.set_limits(limits);
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

    /// Most contacts that the narrow phase looks for per pair in X and Y. Default 10.
    #[doc(alias = "MaxContactsToDetect")]
    pub fn max_contacts_to_detect(&self) -> i32 {
        self.core.max_contacts_to_detect()
    }

    /// Sets the number of contacts to look for; see [`PhysicsSimulator::set_max_contacts_to_detect`].
    pub fn set_max_contacts_to_detect(&mut self, max_contacts_to_detect: i32) {
        self.core.set_max_contacts_to_detect(max_contacts_to_detect);
    }

    /// Most contacts that are solved per pair in X and Y. Default 4.
    #[doc(alias = "MaxContactsToResolve")]
    pub fn max_contacts_to_resolve(&self) -> i32 {
        self.core.max_contacts_to_resolve()
    }

    /// Sets the number of contacts solved per pair.
    ///
    /// # Errors
    /// Negative numbers.
    pub fn set_max_contacts_to_resolve(&mut self, max_contacts_to_resolve: i32) -> Result<()> {
        Ok(self.core.set_max_contacts_to_resolve(max_contacts_to_resolve)?)
    }

    /// How the friction of two surfaces is combined: their mean, or the smaller. The default is the mean.
    pub fn friction_type(&self) -> farseer_core::FrictionType {
        self.core.friction_type()
    }

    /// Chooses how the friction of two surfaces is combined. With the smaller, what has none slides along everything.
    pub fn set_friction_type(&mut self, friction_type: farseer_core::FrictionType) {
        self.core.set_friction_type(friction_type);
    }

    /// Whether bodies that have come to rest sleep. Default true; only with [`DepthScheme::Precise`]. What sleeps costs nothing and
    /// does not move; it wakes by itself as soon as something could move it.
    pub fn is_sleep_enabled(&self) -> bool {
        self.core.is_sleep_enabled()
    }

    /// Sets whether bodies that have come to rest sleep. If not, all are awake from the next update on.
    pub fn set_sleep_enabled(&mut self, value: bool) {
        self.core.set_sleep_enabled(value);
    }

    /// Whether a body slept at the end of the last update. False for stale ids.
    pub fn is_asleep(&self, body: BodyId) -> bool {
        self.core.is_asleep(body)
    }

    /// Why a body is awake, as it was at the end of the last update; `None` for one that sleeps, and for stale ids.
    pub fn why_awake(&self, body: BodyId) -> Option<farseer_core::WhyAwake> {
        self.core.why_awake(body)
    }

    /// Wakes a body, with all that fell asleep together with it. Nothing happens to one that is awake, or to stale ids.
    pub fn wake(&mut self, body: BodyId) {
        self.core.wake(body);
    }

    /// How objects meet each other. Default [`DepthScheme::Precise`].
    pub fn depth_scheme(&self) -> DepthScheme {
        self.world.scheme
    }

    /// Chooses how objects meet each other.
    ///
    /// # Errors
    /// If a geom takes part already ([`farseer_core::Error::GeomListNotEmpty`]; geoms that wait to be added do not
    /// count). From the precise set to another scheme, one of these that gets no
    /// [distance grid](farseer_core::PhysicsSimulator::create_distance_grid), and a [`Platform`] that moves, is a belt or one-way; and an upright
    /// geom.
    pub fn set_depth_scheme(&mut self, scheme: DepthScheme) -> Result<()> {
        if !self.core.geom_list().is_empty() {
            return Err(farseer_core::Error::GeomListNotEmpty.into());
        }
        if scheme != DepthScheme::Precise && self.world.platforms.are_precise() {
            return Err(only_precise("platforms that move, are belts or one-way"));
        }
        if scheme != DepthScheme::Precise && self.world.has_uprights(&self.core) {
            return Err(only_precise("upright footprints"));
        }
        if scheme == DepthScheme::Precise {
            self.core.enter_space(LENGTH_UNIT)?;
        } else if self.world.scheme == DepthScheme::Precise {
            // The precise set does without.
            let geoms: Vec<GeomId> = self.core.geoms().collect();
            geoms.into_iter().try_for_each(|geom| self.core.create_distance_grid(geom))?;
            self.core.set_methods(farseer_core::Methods::default())?;
        }
        self.world.platforms.tell_again();
        self.world.depths.is_told = false;
        self.world.scheme = scheme;
        let geoms: Vec<GeomId> = self.core.geoms().collect();
        for geom in geoms {
            self.fit_box(geom);
        }
        Ok(())
    }

    /// The former name of [`set_depth_scheme`](Self::set_depth_scheme).
    #[deprecated(note = "use set_depth_scheme")]
    #[allow(clippy::missing_errors_doc, reason = "it is where the link leads")]
    pub fn set_methods(&mut self, scheme: DepthScheme) -> Result<()> {
        self.set_depth_scheme(scheme)
    }

    /// Sets the Z that layer depth 0 and layer depth 1 stand for; see [`TwoHalfBody::layer_depth`]. By default 0
    /// and the height of the screen.
    ///
    /// # Errors
    /// What is not finite; a far Z that is not greater than the near one.
    pub fn set_layer_depth_range(&mut self, near: f32, far: f32) -> Result<()> {
        if !near.is_finite() {
            return Err(invalid("near", near, "finite"));
        }
        if !(far - near).is_finite() || far <= near {
            return Err(invalid("far", far, "finite and greater than near"));
        }
        self.world.layer_range = (near, far);
        Ok(())
    }

    /// The 2D engine below, which moves everything in X and Y: its plane is that of the world, with y = -Y, so
    /// it is **not** in screen coordinates.
    pub fn core(&self) -> &PhysicsSimulator {
        &self.core
    }

    /// How long the last update took in seconds: 0 unless a time function was handed in with
    /// [`update_timed`](Self::update_timed).
    #[doc(alias = "UpdateTime")]
    pub fn update_time(&self) -> f32 {
        self.world.update_time
    }
}

/// What lives in the simulator.
impl TwoHalfPhysicsSimulator {
    /// Gives a body its life and id. It takes part once it is [added](Self::add).
    ///
    /// It is at Z = 0, and without an object geom: its position in the plane of the 2D engine, (0, 0) if it is a
    /// new one, is that of its origin. A [kinematic](TwoHalfBody::set_is_kinematic)
    /// one moves in three axes with [`DepthScheme::Precise`]; with the others in that plane, and keeps its Z.
    #[doc(alias = "TwoHalfBody(TwoHalfPhysicsSimulator)")]
    pub fn create_body(&mut self, body: Body) -> BodyId {
        let body = self.core.create_body(body);
        self.world.depths.insert_body(body);
        body
    }

    /// A copy of a body as [`Body::copy_of`] makes it, at the same Z, with the same coefficients and shadow image of
    /// its ground; without geoms, and at rest. It takes part once it is [added](Self::add).
    ///
    /// # Errors
    /// A stale id.
    #[doc(alias = "TwoHalfBody(TwoHalfPhysicsSimulator, TwoHalfBody)")]
    pub fn clone_body(&mut self, body: BodyId) -> Result<BodyId> {
        let copy = Body::copy_of(self.core.body(body).ok_or(stale("body"))?);
        let state = self.world.depths.bodies.get(body).ok_or(stale("body"))?;
        let (z, ground) = (state.z, state.ground.without_object());
        let id = self.create_body(copy);
        let state = &mut self.world.depths.bodies[id];
        (state.z, state.ground) = (z, ground);
        Ok(id)
    }

    /// Attaches an outline to a body. The geom takes part once it is [added](Self::add). It is a prism as deep as
    /// the shorter side of the outline's box; see [`set_depth_profile`](Self::set_depth_profile).
    ///
    /// # Errors
    /// As [`PhysicsSimulator::create_geom`].
    #[doc(alias = "TwoHalfGeom(TwoHalfBody, Vertices, float)")]
    pub fn create_geom(
        &mut self,
        body: BodyId,
        vertices: impl Into<Vertices>,
        placement: GeomPlacement,
    ) -> Result<GeomId> {
        let geom = self.core.create_geom(body, vertices, placement)?;
        adopt_body(&self.core, &mut self.world.depths, body);
        Ok(geom)
    }

    /// Attaches a copy of a geom to a body, at the same offsets, with the same depth profile. It takes part once it
    /// is [added](Self::add). If the original is the object geom of its body and the other body has none, the copy
    /// becomes that; the other body's origin stays.
    ///
    /// # Errors
    /// As [`PhysicsSimulator::clone_geom`].
    #[doc(alias = "TwoHalfGeom(TwoHalfBody, TwoHalfGeom)")]
    pub fn clone_geom(&mut self, body: BodyId, geom: GeomId) -> Result<GeomId> {
        let copy = self.core.clone_geom(body, geom)?;
        let profile = *self.world.depths.profiles.get(geom).ok_or(stale("geom"))?;
        self.world.depths.profiles.insert(copy, profile);
        adopt_body(&self.core, &mut self.world.depths, body);
        self.fit_box(copy);
        let owner = self.core.geom(geom).map(|geom| geom.body());
        let ground_of = |body: Option<BodyId>| self.world.depths.bodies.get(body?).map(|state| state.ground);
        if ground_of(owner).is_some_and(|ground| ground.object_geom() == Some(geom))
            && let Some(state) = self.world.depths.edit(body)
        {
            state.ground.adopt_object(copy);
        }
        Ok(copy)
    }

    /// Lends out what lives in the 2D engine below, to make joints and springs between bodies, to edit and to dispose of them:
    /// all that takes [`Objects`](farseer_core::Objects), as [`JointFactory`](farseer_core::JointFactory) and
    /// [`SpringFactory`](farseer_core::SpringFactory) do. There y is down, and positions are those of the outlines, not of the grounds.
    /// Bodies and geoms that are made there get a depth as those of [`from_core`](Self::from_core) do.
    ///
    /// With [`DepthScheme::Precise`] joints that keep a point, which are revolute ones and welds, keep it in depth: the
    /// bodies that they tie together stay as far behind each other as they are, and move along Z as one; what is tied to
    /// the world, or to what stands still, stays at its Z. So do prismatic joints. Pins, sliders and linear springs act along all
    /// three axes, between points at the Z of their bodies; the length that they are made with is that of X and Y, until they
    /// [take](Self::take_length) another. A spring to a point of the world does so if that point
    /// [has a depth](farseer_core::FixedLinearSpring::set_world_attach_depth). Joints and springs that keep angles have nothing
    /// to do along Z. With the other schemes all of them act in X and Y alone.
    ///
    /// ```
    /// # use twohalf::{TwoHalfPhysicsSimulator, Vector2, farseer_core::{BodyFactory, JointFactory}};
    /// let mut simulator = TwoHalfPhysicsSimulator::with_gravity(600, Vector2::new(0.0, 0.0))?;
    /// let [one, other] = [0.0, 40.0].map(|x| {
    ///     let body = simulator.create_body(BodyFactory::create_rectangle_body(20.0, 20.0, 1.0).unwrap());
    ///     simulator.add(body).unwrap();
    ///     simulator.body_mut(body).unwrap().core_mut().set_position(Vector2::new(x, -100.0));
    ///     body
    /// });
    /// let joint = simulator.edit_objects(|objects| {
    ///     let joint = JointFactory::create_revolute_joint(objects, one, other, Vector2::new(20.0, -100.0))?;
    ///     objects.add(joint)?;
    ///     Ok::<_, farseer_core::Error>(joint)
    /// })?;
    /// simulator.body_mut(one).unwrap().set_linear_velocity_z(60.0);
    /// (0..60).for_each(|_| simulator.update(1.0 / 60.0));
    /// // They share what one of them had.
    /// assert!((simulator.body(other).unwrap().velocity3d().z - 30.0).abs() < 0.1);
    /// assert!(simulator.core().joint(joint).is_some());
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn edit_objects<R>(&mut self, edit: impl FnOnce(&mut farseer_core::Objects) -> R) -> R {
        let answer = edit(&mut self.core);
        let TwoHalfPhysicsSimulator { core, world } = self;
        for body in core.bodies() {
            let knows = |&geom: &GeomId| world.depths.profiles.get(geom).is_some();
            if world.depths.bodies.get(body).is_none() || !core.geoms_of(body).iter().all(knows) {
                adopt_body(core, &mut world.depths, body);
            }
        }
        answer
    }

    /// Lets an object take part from the next update on. Adding a body does not add its geoms.
    ///
    /// # Errors
    /// A stale id.
    #[doc(alias = "Add")]
    pub fn add(&mut self, object: impl Into<ObjectId>) -> Result<()> {
        Ok(self.core.add(object)?)
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

    /// Whether an object was disposed; a stale id names one that was.
    #[doc(alias = "IsDisposed")]
    pub fn is_disposed(&self, object: impl Into<ObjectId>) -> bool {
        self.core.is_disposed(object)
    }

    /// Empties the simulator: bodies, geoms, platforms and fields are gone and their ids are stale. Settings of the 2D engine
    /// stay, but for the broad phase, which is Farseer's default again; so do screen and scheme.
    #[doc(alias = "Clear")]
    pub fn clear(&mut self) {
        self.core.clear();
        if self.world.scheme == DepthScheme::Precise {
            // The methods stay the same: nothing can be refused.
            let _ = self.core.enter_space(LENGTH_UNIT);
        }
        let world = &mut self.world;
        world.depths = Depths::default();
        world.platforms.clear();
        world.fields.clear();
        world.touches.clear();
        world.last.clear();
        world.events.clear();
        world.has_rejected = false;
        world.counters = StepCounters::default();
    }

    /// A body to look at, unless the id is stale.
    pub fn body(&self, body: BodyId) -> Option<TwoHalfBody<&Self>> {
        TwoHalfBody::new(self, body)
    }

    /// A body to change, unless the id is stale.
    pub fn body_mut(&mut self, body: BodyId) -> Option<TwoHalfBody<&mut Self>> {
        TwoHalfBody::new(self, body)
    }

    /// A geom to look at, unless the id is stale.
    pub fn geom(&self, geom: GeomId) -> Option<TwoHalfGeom<'_>> {
        TwoHalfGeom::new(&self.core, &self.world, geom)
    }

    /// The settings of a geom to change, unless the id is stale.
    pub fn geom_mut(&mut self, geom: GeomId) -> Option<&mut Geom> {
        self.core.geom_mut(geom)
    }

    /// Moves a geom to another body; its offsets stay. If it was the object geom of its old body, that body has
    /// none.
    ///
    /// # Errors
    /// As [`PhysicsSimulator::set_body`].
    #[doc(alias = "SetBody")]
    pub fn set_body(&mut self, geom: GeomId, body: BodyId) -> Result<()> {
        let old = self.core.geom(geom).map(|geom| geom.body()).filter(|old| *old != body);
        self.core.set_body(geom, body)?;
        if let Some(state) = old.and_then(|old| self.world.depths.edit(old)) {
            state.ground.let_go_of(geom);
        }
        self.world.depths.edit(body);
        Ok(())
    }

    /// Replaces the outline of a geom; see [`PhysicsSimulator::set_vertices`]. Its depth profile stays.
    ///
    /// # Errors
    /// As there.
    #[doc(alias = "SetVertices")]
    pub fn set_vertices(&mut self, geom: GeomId, vertices: impl Into<Vertices>) -> Result<()> {
        self.core.set_vertices(geom, vertices)?;
        self.world.update.pieces.remove(geom);
        Ok(())
    }

    /// Makes a geom a sensor (its body static, its contacts without response) or an ordinary geom. Sensors have
    /// depth as everything else.
    ///
    /// # Errors
    /// A stale id.
    #[doc(alias = "IsSensor")]
    pub fn set_is_sensor(&mut self, geom: GeomId, is_sensor: bool) -> Result<()> {
        Ok(self.core.set_is_sensor(geom, is_sensor)?)
    }

    /// Lets no new pair of the two geoms be found; see [`PhysicsSimulator::ignore_collision_with`].
    ///
    /// # Errors
    /// A stale id.
    #[doc(alias = "IgnoreCollisionWith")]
    pub fn ignore_collision_with(&mut self, geom: GeomId, other: GeomId) -> Result<()> {
        Ok(self.core.ignore_collision_with(geom, other)?)
    }

    /// Undoes [`ignore_collision_with`](Self::ignore_collision_with) of the same geom.
    ///
    /// # Errors
    /// A stale id.
    #[doc(alias = "RestoreCollisionWith")]
    pub fn restore_collision_with(&mut self, geom: GeomId, other: GeomId) -> Result<()> {
        Ok(self.core.restore_collision_with(geom, other)?)
    }

    /// How a geom's outline extends in depth, unless the id is stale.
    pub fn depth_profile(&self, geom: GeomId) -> Option<DepthProfile> {
        self.core.geom(geom)?;
        self.world.depths.profiles.get(geom).copied()
    }

    /// Sets how a geom's outline extends in depth. If it is its body's object geom, the body's origin stays, so
    /// its height may change. What is upright gives the geom the outline that it has from the front, a rectangle.
    ///
    /// # Errors
    /// A stale id; a depth that is not finite and 0 or more; a radius that is not finite and greater than 0, or so
    /// great that the ball does not end at finite X and Y where it is; a height that is not finite and greater than 0, or less than
    /// twice the radius of a capsule; something upright with another scheme than [`DepthScheme::Precise`].
    pub fn set_depth_profile(&mut self, geom: GeomId, profile: DepthProfile) -> Result<()> {
        let body = self.core.geom(geom).ok_or(stale("geom"))?.body();
        let profile = profile.check()?;
        if let Some(front) = profile.front() {
            if self.world.scheme != DepthScheme::Precise {
                return Err(only_precise("upright footprints"));
            }
            self.set_vertices(geom, front)?;
        }
        match self.box_radius_of(profile) {
            Some(radius) => self.core.set_box_radius(geom, Some(radius)).map_err(Error::from)?,
            // A geom that cannot have the box of its outline keeps the one that it has.
            None => _ = self.core.set_box_radius(geom, None),
        }
        self.world.depths.profiles.insert(geom, profile);
        self.world.depths.edit(body);
        Ok(())
    }

    /// A ball has the box of a ball while balls are balls; others have that of their outline.
    fn box_radius_of(&self, profile: DepthProfile) -> Option<f32> {
        match (profile, self.world.scheme) {
            (DepthProfile::Round { radius }, DepthScheme::Faithful | DepthScheme::Precise) => Some(radius),
            _ => None,
        }
    }

    /// Gives a geom the box of its depth profile.
    fn fit_box(&mut self, geom: GeomId) {
        let profile = self.world.depths.profiles.get(geom);
        let radius = profile.and_then(|profile| self.box_radius_of(*profile));
        // The radius was accepted when the profile was set; where the geom cannot have it, it keeps its outline's.
        let _ = self.core.set_box_radius(geom, radius);
    }

    /// The least and greatest Z of a geom, beyond finite numbers the nearest ones; unless the id is stale.
    pub fn depth_interval(&self, geom: GeomId) -> Option<(f32, f32)> {
        let z = self.world.z_of(self.core.geom(geom)?.body());
        let half = self.world.depths.profiles.get(geom)?.half_depth();
        Some((nearest_finite(z - half), nearest_finite(z + half)))
    }

    /// A platform to look at, unless the id is stale. [`Platform::new`] makes one.
    pub fn platform(&self, platform: PlatformId) -> Option<&Platform> {
        self.world.platforms.get(platform)
    }

    /// A platform to change, unless the id is stale.
    pub fn platform_mut(&mut self, platform: PlatformId) -> Option<PlatformMut<'_>> {
        let World { platforms, projection, scheme, .. } = &mut self.world;
        let index = platforms.index_of(platform)?;
        Some(PlatformMut { platforms, projection, scheme: *scheme, index })
    }

    /// The platforms, in the order in which they were made.
    pub fn platforms(&self) -> impl DoubleEndedIterator<Item = PlatformId> + '_ {
        self.world.platforms.iter().map(|(id, _)| id)
    }

    /// Takes a platform away, at once; its id is stale.
    ///
    /// # Errors
    /// A stale id.
    pub fn remove_platform(&mut self, platform: PlatformId) -> Result<()> {
        self.world.platforms.remove(platform)
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

    /// What happened in the last update, in order; cleared by the next. Pairs that are at different depths do not
    /// appear.
    pub fn events(&self) -> &[Event] {
        &self.world.events
    }

    /// How much work the last update was.
    pub fn counters(&self) -> StepCounters {
        self.world.counters
    }
}
