//! Settings of a simulator.

use farseer_core::{BodyId, GeomId, Limits, PhysicsSimulator};

use super::{LENGTH_UNIT, TwoHalfPhysicsSimulator};
use crate::depth::DepthScheme;
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
    /// [distance grid](farseer_core::PhysicsSimulator::create_distance_grid), and a [`Platform`](crate::Platform) that moves, is a belt, one-way, turned or a slope
    /// along Z; and an upright geom.
    pub fn set_depth_scheme(&mut self, scheme: DepthScheme) -> Result<()> {
        if !self.core.geom_list().is_empty() {
            return Err(farseer_core::Error::GeomListNotEmpty.into());
        }
        if scheme != DepthScheme::Precise && self.world.platforms.are_precise() {
            return Err(only_precise("platforms that move, are belts, one-way, turned or slopes along Z"));
        }
        if scheme != DepthScheme::Precise && self.world.depths.have_uprights(&self.core) {
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
        if scheme != DepthScheme::Precise {
            self.world.paces.clear();
            self.world.crush_watches.clear();
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
