//! Settings of a simulator.

use farseer_core::{BodyId, GeomId, Limits, PhysicsSimulator};

use super::{LENGTH_UNIT, TwoHalfPhysicsSimulator};
use crate::depth::{DepthScheme, Pace, World};
use crate::error::{invalid, only_precise};
use crate::{Projection, Result, Vector2};

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

    /// Wakes a body in the next update, with all that fell asleep together with it. Nothing happens to one that is awake, or to
    /// stale ids.
    pub fn wake(&mut self, body: BodyId) {
        self.core.wake(body);
    }

    /// How objects meet each other. Default [`DepthScheme::Precise`].
    pub fn depth_scheme(&self) -> DepthScheme {
        self.world.scheme
    }

    /// Chooses how objects meet each other, between any two updates. Everything stays where it is and goes on as it moves; what
    /// is known of contacts is forgotten: until the next update nothing touches, what sleeps wakes, and what rests begins to
    /// rest anew. The scheme that it has already changes nothing.
    ///
    /// # Errors
    /// Another scheme than the precise one, with what only that has ([`farseer_core::Error::NotSupported`]): a
    /// [`Platform`](crate::Platform) that moves, is a belt, one-way, turned or a slope along Z, an upright geom, a body that is
    /// [to be moved](crate::TwoHalfBody::move_to3d), has a [time of its own](Self::set_time_scale) or a
    /// [crush tolerance](Self::set_crush_tolerance), chains, prismatic joints, joints with a motor or limits; or with a geom that gets no
    /// [distance grid](farseer_core::PhysicsSimulator::create_distance_grid). A refused call has changed nothing.
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
        if scheme == self.world.scheme && is_precise == self.core.is_in_space() {
            return Ok(());
        }
        if is_precise {
            self.core.enter_space(LENGTH_UNIT)?;
        } else if let Some(what) = self.what_only_the_precise_set_has() {
            return Err(only_precise(what));
        } else {
            self.core.leave_space()?;
        }
        self.world.paces.retain(|pace| !pace.is_over());
        self.world.scheme = scheme;
        self.world.touches.clear();
        self.world.platforms.tell_again();
        self.world.depths.is_told = false;
        for (_, state) in self.world.depths.bodies.iter_mut() {
            (state.support, state.is_support_kept) = (None, false);
        }
        let geoms: Vec<GeomId> = self.core.geoms().collect();
        geoms.into_iter().for_each(|geom| self.fit_box(geom));
        Ok(())
    }

    fn what_only_the_precise_set_has(&self) -> Option<&'static str> {
        let World { platforms, depths, paces, crush_watches, .. } = &self.world;
        let has_target = || depths.bodies.iter().any(|(_, state)| state.target.is_some());
        if platforms.are_precise() {
            Some("platforms that move, are belts, one-way, turned or slopes along Z")
        } else if depths.have_uprights(&self.core) {
            Some("upright footprints")
        } else if has_target() {
            Some("motion along Z of a kinematic body")
        } else if !paces.iter().all(Pace::is_over) {
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

    /// Sets the Z that layer depth 0 and layer depth 1 stand for; see [`TwoHalfBody::layer_depth`](crate::TwoHalfBody::layer_depth). By default 0
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
}
