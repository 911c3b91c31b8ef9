//! Life cycle of bodies and geoms.

use farseer_core::depth::DepthAxisMut;
use farseer_core::{Body, BodyId, GeomId, GeomPlacement, ObjectId, PhysicsSimulator, Vertices};

use super::{LENGTH_UNIT, TwoHalfPhysicsSimulator};
use crate::Result;
use crate::depth::{DepthProfile, DepthScheme, DepthState};
use crate::error::stale;
use crate::views::TwoHalfBody;

/// Creates the depth state of a body of the core and of its geoms, unless they have one.
pub(super) fn adopt_body(core: &PhysicsSimulator, depths: &mut DepthState, body: BodyId) {
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

/// Life cycle of objects.
impl TwoHalfPhysicsSimulator {
    /// Creates a body and returns its id. It takes part once it is [added](Self::add).
    ///
    /// The body is at Z = 0, without an object geom: its position in the plane of the 2D engine, by default
    /// (0, 0), is that of its origin. A [kinematic](TwoHalfBody::set_is_kinematic) body moves in three axes
    /// with [`DepthScheme::Precise`]; with the others it moves in that plane and keeps its Z.
    #[doc(alias = "TwoHalfBody(TwoHalfPhysicsSimulator)")]
    pub fn create_body(&mut self, body: Body) -> BodyId {
        let body = self.core.create_body(body);
        self.world.depths.insert_body(body);
        body
    }

    /// Copies a body with [`Body::copy_of`], at the same Z, with the coefficients and shadow image of its
    /// ground; without geoms, and at rest. The copy takes part once it is [added](Self::add).
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

    /// Attaches an outline to a body. The geom takes part once it is [added](Self::add). It is a prism as
    /// deep as the shorter side of the outline's AABB; see [`set_depth_profile`](Self::set_depth_profile).
    ///
    /// # Errors
    /// The errors of [`PhysicsSimulator::create_geom`].
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

    /// Attaches a copy of a geom to a body, with the same offsets and depth profile. It takes part once it is
    /// [added](Self::add). If the original is the object geom of its body and the other body has none, the
    /// copy becomes its object geom; the other body's origin stays.
    ///
    /// # Errors
    /// The errors of [`PhysicsSimulator::clone_geom`].
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

    /// Gives access to the objects of the core, to create joints and springs between bodies, to edit and to
    /// dispose of them. Functions that take [`Objects`](farseer_core::Objects) work here, such as those of
    /// [`JointFactory`](farseer_core::JointFactory) and [`SpringFactory`](farseer_core::SpringFactory). In
    /// the core y is down, and positions are those of the outlines, not of the grounds. New bodies and geoms
    /// get a depth as in [`from_core`](Self::from_core).
    ///
    /// With [`DepthScheme::Precise`], revolute, weld and prismatic joints also constrain Z: their bodies keep
    /// their difference in Z and move along Z as one. A body joined to the world or to a static body keeps
    /// its Z.
    ///
    /// Pins, sliders and linear springs act along all three axes, between points at the Z of their bodies.
    /// Their original length is that of X and Y, until they [take](Self::take_length) another. A spring to a
    /// point of the world does so if that point [has a
    /// depth](farseer_core::FixedLinearSpring::set_world_attach_depth). Joints and springs of angles do not
    /// act along Z. With the other schemes all of them act in X and Y alone.
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
    /// // They share the momentum.
    /// assert!((simulator.body(other).unwrap().velocity3d().z - 30.0).abs() < 0.1);
    /// assert!(simulator.core().joint(joint).is_some());
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn edit_objects<R>(&mut self, edit: impl FnOnce(&mut farseer_core::Objects) -> R) -> R {
        let answer = edit(&mut self.core);
        self.adopt_new();
        answer
    }

    /// Creates the depth state of new bodies and geoms.
    fn adopt_new(&mut self) {
        let TwoHalfPhysicsSimulator { core, world, .. } = self;
        for body in core.bodies() {
            let knows = |&geom: &GeomId| world.depths.profiles.get(geom).is_some();
            if world.depths.bodies.get(body).is_none() || !core.geoms_of(body).iter().all(knows) {
                adopt_body(core, &mut world.depths, body);
            }
        }
    }

    /// Adds an object with the next update. Adding a body does not add its geoms.
    ///
    /// # Errors
    /// A stale id.
    #[doc(alias = "Add")]
    pub fn add(&mut self, object: impl Into<ObjectId>) -> Result<()> {
        Ok(self.core.add(object)?)
    }

    /// Removes an object with the next update; see [`PhysicsSimulator::remove`].
    ///
    /// # Errors
    /// A stale id.
    #[doc(alias = "Remove")]
    pub fn remove(&mut self, object: impl Into<ObjectId>) -> Result<()> {
        Ok(self.core.remove(object)?)
    }

    /// Disposes an object; see [`PhysicsSimulator::dispose`].
    ///
    /// # Errors
    /// A stale id.
    #[doc(alias = "Dispose")]
    pub fn dispose(&mut self, object: impl Into<ObjectId>) -> Result<()> {
        Ok(self.core.dispose(object)?)
    }

    /// Returns whether an object was disposed; true for a stale id.
    #[doc(alias = "IsDisposed")]
    pub fn is_disposed(&self, object: impl Into<ObjectId>) -> bool {
        self.core.is_disposed(object)
    }

    /// Empties the simulator: ids of bodies, geoms, platforms and fields are stale afterwards. Settings of
    /// the 2D engine stay, except the broad phase, which is Farseer's default again. Screen and scheme stay.
    #[doc(alias = "Clear")]
    pub fn clear(&mut self) {
        self.core.clear();
        if self.world.scheme == DepthScheme::Precise {
            // This cannot fail, since the methods stay the same.
            let _ = DepthAxisMut::of(&mut self.core).enable(LENGTH_UNIT);
        }
        let world = &mut self.world;
        world.depths = DepthState::default();
        world.platforms.clear();
        world.fields.clear();
        world.paces.clear();
        world.crush_watches.clear();
        world.touches.clear();
        world.has_rejected = false;
        self.report.clear();
    }

    /// A body for reading; `None` for a stale id.
    pub fn body(&self, body: BodyId) -> Option<TwoHalfBody<&Self>> {
        TwoHalfBody::new(self, body)
    }

    /// A body for editing; `None` for a stale id.
    pub fn body_mut(&mut self, body: BodyId) -> Option<TwoHalfBody<&mut Self>> {
        TwoHalfBody::new(self, body)
    }

    /// Bodies of the simulation, in the order in which they were added.
    #[doc(alias = "BodyList")]
    pub fn body_list(&self) -> &[BodyId] {
        self.core.body_list()
    }

    /// Geoms of the simulation, in the order in which they were added.
    #[doc(alias = "GeomList")]
    pub fn geom_list(&self) -> &[GeomId] {
        self.core.geom_list()
    }
}
