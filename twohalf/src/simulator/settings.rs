//! Settings of a simulator.

use farseer_core::depth::{DepthAxis, DepthAxisMut};
use farseer_core::{BodyId, GeomId, Limits, PhysicsSimulator};

use super::{LENGTH_UNIT, TwoHalfPhysicsSimulator};
use crate::depth::{DepthScheme, TimeScale, World};
use crate::error::{invalid, only_precise};
use crate::{Projection, Result, Vector2};

/// Settings.
impl TwoHalfPhysicsSimulator {
    /// Height of the screen in px: y on the screen of the ground at Z = 0.
    #[doc(alias = "Height")]
    pub fn height(&self) -> i32 {
        self.world.projection.height()
    }

    /// Sets the height of the screen, px. It does not affect the world.
    ///
    /// # Errors
    /// A height that is not greater than 0.
    pub fn set_height(&mut self, height: i32) -> Result<()> {
        self.world.projection.set_height(height)
    }

    /// Direction of the Z axis on the screen, degrees counterclockwise from the x axis. Default 90.
    #[doc(alias = "Angle")]
    pub fn angle(&self) -> i32 {
        self.world.projection.angle()
    }

    /// The projection from the world to the screen.
    pub fn projection(&self) -> &Projection {
        &self.world.projection
    }

    /// Gravity, px/s², in screen orientation, of every body that does not ignore it. Default none.
    #[doc(alias = "Gravity")]
    pub fn gravity(&self) -> Vector2 {
        self.core.gravity()
    }

    /// Sets the gravity, px/s².
    ///
    /// # Errors
    /// A gravity that is not finite.
    pub fn set_gravity(&mut self, gravity: Vector2) -> Result<()> {
        Ok(self.core.set_gravity(gravity)?)
    }

    /// Number of solver iterations per update. Default 5.
    #[doc(alias = "Iterations")]
    pub fn iterations(&self) -> i32 {
        self.core.iterations()
    }

    /// Sets the number of solver iterations; with 0 or less only the warm start acts.
    pub fn set_iterations(&mut self, iterations: i32) {
        self.core.set_iterations(iterations);
    }

    /// Limits of the cost of this simulator.
    pub fn limits(&self) -> Limits {
        self.core.limits()
    }

    /// Sets the limits of the cost: [`PhysicsSimulator::set_limits`].
    pub fn set_limits(&mut self, limits: Limits) {
        self.core.set_limits(limits);
    }

    /// Returns whether updates move bodies; objects enter and leave either way. Default true.
    #[doc(alias = "Enabled")]
    pub fn enabled(&self) -> bool {
        self.core.enabled()
    }

    /// Sets whether updates move bodies.
    pub fn set_enabled(&mut self, enabled: bool) {
        self.core.set_enabled(enabled);
    }

    /// Greatest number of contacts that the narrow phase finds per pair in X and Y. Default 10.
    #[doc(alias = "MaxContactsToDetect")]
    pub fn max_contacts_to_detect(&self) -> i32 {
        self.core.max_contacts_to_detect()
    }

    /// Sets the greatest number of contacts found per pair; see
    /// [`PhysicsSimulator::set_max_contacts_to_detect`].
    pub fn set_max_contacts_to_detect(&mut self, max_contacts_to_detect: i32) {
        self.core.set_max_contacts_to_detect(max_contacts_to_detect);
    }

    /// Greatest number of contacts that are solved per pair in X and Y. Default 4.
    #[doc(alias = "MaxContactsToResolve")]
    pub fn max_contacts_to_resolve(&self) -> i32 {
        self.core.max_contacts_to_resolve()
    }

    /// Sets the greatest number of contacts solved per pair.
    ///
    /// # Errors
    /// Negative numbers.
    pub fn set_max_contacts_to_resolve(&mut self, max_contacts_to_resolve: i32) -> Result<()> {
        Ok(self.core.set_max_contacts_to_resolve(max_contacts_to_resolve)?)
    }

    /// Combination of the friction coefficients of two surfaces: mean or minimum. Default mean.
    pub fn friction_type(&self) -> farseer_core::FrictionType {
        self.core.friction_type()
    }

    /// Sets the combination of friction coefficients. With the minimum, a geom without friction slides along
    /// all others.
    pub fn set_friction_type(&mut self, friction_type: farseer_core::FrictionType) {
        self.core.set_friction_type(friction_type);
    }

    /// Returns whether bodies at rest sleep. Default true; only with [`DepthScheme::Precise`]. A sleeping body costs nothing
    /// and does not move. It wakes by itself as soon as anything could move it.
    pub fn is_sleep_enabled(&self) -> bool {
        self.core.is_sleep_enabled()
    }

    /// Sets whether bodies at rest sleep. If not, all are awake from the next update on.
    pub fn set_sleep_enabled(&mut self, value: bool) {
        self.core.set_sleep_enabled(value);
    }

    /// Returns whether a body was asleep at the end of the last update; false for a stale id.
    pub fn is_asleep(&self, body: BodyId) -> bool {
        self.core.is_asleep(body)
    }

    /// Reason why a body was awake at the end of the last update; `None` for a sleeping one and for a stale
    /// id.
    pub fn why_awake(&self, body: BodyId) -> Option<farseer_core::AwakeReason> {
        self.core.why_awake(body)
    }

    /// Wakes a body in the next update, with all bodies that fell asleep together with it. No effect on an
    /// awake body or a stale id.
    pub fn wake(&mut self, body: BodyId) {
        self.core.wake(body);
    }

    /// Method for contacts between objects. Default [`DepthScheme::Precise`].
    pub fn depth_scheme(&self) -> DepthScheme {
        self.world.scheme
    }

    /// Sets the method for contacts between objects, between any two updates. Positions and velocities stay.
    /// Contacts are dropped: until the next update there are none, sleeping bodies wake, and rest times start
    /// anew. The present scheme changes nothing.
    ///
    /// # Errors
    /// Another scheme than the precise one while a feature of the precise scheme is in use
    /// ([`farseer_core::Error::NotSupported`]). Such features are:
    ///
    /// - a [`Platform`](crate::Platform) that moves, is a belt, one-way, turned or a slope along Z;
    /// - an upright geom, or one that gets no [distance
    ///   grid](farseer_core::PhysicsSimulator::create_distance_grid);
    /// - a body with a [target](crate::TwoHalfBody::move_to3d), a [time scale](Self::set_time_scale) or a
    ///   [crush tolerance](Self::set_crush_tolerance);
    /// - chains, prismatic joints, joints with a motor or limits.
    ///
    /// A failed call changes nothing.
    ///
    /// ```
    /// use twohalf::{DepthScheme, TwoHalfPhysicsSimulator, Vector2, Vector3};
    ///
    /// let mut simulator = TwoHalfPhysicsSimulator::with_angle_and_gravity(480, 60, Vector2::new(0.0, 500.0))?;
    /// let body = simulator.create_body(farseer_core::Body::new());
    /// simulator.add(body)?;
    /// simulator.body_mut(body).unwrap().set_position3d(Vector3::new(0.0, 100.0, 0.0));
    /// (0..10).for_each(|_| simulator.update(0.01));
    /// let before = simulator.body(body).unwrap().velocity3d();
    /// simulator.set_depth_scheme(DepthScheme::Faithful)?;
    /// assert_eq!(simulator.body(body).unwrap().velocity3d(), before);
    /// # Ok::<(), twohalf::Error>(())
    /// ```
    pub fn set_depth_scheme(&mut self, scheme: DepthScheme) -> Result<()> {
        let is_precise = scheme == DepthScheme::Precise;
        if scheme == self.world.scheme && is_precise == DepthAxis::of(&self.core).is_enabled() {
            return Ok(());
        }
        if is_precise {
            DepthAxisMut::of(&mut self.core).enable(LENGTH_UNIT)?;
        } else if let Some(what) = self.precise_only_feature() {
            return Err(only_precise(what));
        } else {
            DepthAxisMut::of(&mut self.core).disable()?;
        }
        self.world.paces.retain(|pace| !pace.is_over());
        self.world.scheme = scheme;
        self.world.touches.clear();
        self.world.platforms.mark_all_unsent();
        self.world.depths.is_sent = false;
        for (_, state) in self.world.depths.bodies.iter_mut() {
            (state.support, state.is_support_kept) = (None, false);
        }
        let geoms: Vec<GeomId> = self.core.geoms().collect();
        geoms.into_iter().for_each(|geom| self.fit_box(geom));
        Ok(())
    }

    fn precise_only_feature(&self) -> Option<&'static str> {
        let World { platforms, depths, paces, crush_watches, .. } = &self.world;
        let has_target = || depths.bodies.iter().any(|(_, state)| state.target.is_some());
        if platforms.are_precise() {
            Some("platforms that move, are belts, one-way, turned or slopes along Z")
        } else if depths.have_uprights(&self.core) {
            Some("upright footprints")
        } else if has_target() {
            Some("motion along Z of a kinematic body")
        } else if !paces.iter().all(TimeScale::is_over) {
            Some("bodies with a time of their own")
        } else {
            (!crush_watches.is_empty()).then_some("crushing that is told")
        }
    }

    /// The former name of [`set_depth_scheme`](Self::set_depth_scheme).
    #[deprecated(note = "use set_depth_scheme")]
    #[allow(clippy::missing_errors_doc, reason = "it is where the link leads")]
    pub fn set_methods(&mut self, scheme: DepthScheme) -> Result<()> {
        self.set_depth_scheme(scheme)
    }

    /// Sets the Z of layer depth 0 and of layer depth 1, px; see
    /// [`TwoHalfBody::layer_depth`](crate::TwoHalfBody::layer_depth). Default 0 and the height of the screen.
    ///
    /// # Errors
    /// A Z that is not finite; a far Z that is not greater than the near one.
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

    /// The core: the 2D engine that moves bodies in X and Y. Its plane is that of the world with y = -Y, so
    /// it is **not** in screen coordinates.
    pub fn core(&self) -> &PhysicsSimulator {
        &self.core
    }
}
