//! Locked rotation and axes, permission to sleep, events of sleep, linear rotational drag. Ours: the original has none of them.

use super::Body;
use super::options::BodyOptions;

impl Body {
    /// Whether the body keeps its rotation, whatever acts on it. Default false. Ours.
    #[inline]
    pub fn is_rotation_locked(&self) -> bool {
        self.options.has(BodyOptions::ROTATION_LOCKED)
    }

    /// Locks the rotation, or unlocks it: for figures that stay upright. A locked body has an infinite moment of
    /// inertia: its [reciprocal](Self::inverse_moment_of_inertia) is 0, and torques and contacts do not turn it. The
    /// angular velocity becomes 0, and setting it has no effect. [`set_rotation`](Self::set_rotation) still turns it.
    /// Kinematic bodies turn as before.
    ///
    /// ```
    /// use farseer_core::{BodyBuilder, GeomBuilder, PhysicsSimulator};
    /// let mut simulator = PhysicsSimulator::precise([0.0, 300.0])?;
    /// simulator.add_body(BodyBuilder::fixed(), [GeomBuilder::rectangle(20.0, 20.0)])?;
    /// // A tall box that stands with one side on the edge of a post topples, unless its rotation is locked.
    /// let tall = [GeomBuilder::rectangle(20.0, 60.0)];
    /// let (figure, _) = simulator.add_body(BodyBuilder::dynamic().position([15.0, -40.0]).lock_rotation(true), tall)?;
    /// (0..120).for_each(|_| simulator.update(1.0 / 60.0));
    /// assert_eq!(simulator[figure].rotation(), 0.0);
    /// assert!((simulator[figure].position().y + 40.0).abs() < 0.1);
    /// # Ok::<(), farseer_core::Error>(())
    /// ```
    pub fn set_rotation_locked(&mut self, value: bool) {
        self.options.set(BodyOptions::ROTATION_LOCKED, value);
        self.update_inverse_mass();
    }

    /// Whether the body is dynamic and its rotation locked.
    #[inline]
    pub(super) fn holds_rotation(&self) -> bool {
        self.is_rotation_locked() && !self.is_immovable()
    }

    /// Whether the body keeps its x coordinate, and whether it keeps its y coordinate, whatever acts on it. Default neither.
    /// Set by [`set_axes_locked`](crate::Objects::set_axes_locked). Ours, and only with the
    /// [precise set](crate::Methods::Precise).
    #[inline]
    pub fn locked_axes(&self) -> [bool; 2] {
        [BodyOptions::X_LOCKED, BodyOptions::Y_LOCKED].map(|axis| self.options.has(axis))
    }

    pub(crate) fn set_locked_axes(&mut self, [x, y]: [bool; 2]) {
        self.options.set(BodyOptions::X_LOCKED, x);
        self.options.set(BodyOptions::Y_LOCKED, y);
    }

    /// Whether the body may fall asleep. Default true. Ours, and only with the [precise set](crate::Methods::Precise),
    /// as sleep is.
    #[inline]
    pub fn is_sleep_allowed(&self) -> bool {
        !self.options.has(BodyOptions::SLEEPLESS)
    }

    /// Sets [`is_sleep_allowed`](Self::is_sleep_allowed). A body that may not sleep keeps all bodies awake that contacts,
    /// joints or springs connect with it, and wakes if it sleeps.
    pub fn set_sleep_allowed(&mut self, value: bool) {
        self.options.set(BodyOptions::SLEEPLESS, !value);
    }

    /// Whether [`Event::BodySlept`](crate::Event::BodySlept) and [`Event::BodyWoke`](crate::Event::BodyWoke) are listed
    /// for the body. Default false; true for bodies of a [`BodyBuilder`](crate::BodyBuilder). Ours.
    #[inline]
    pub fn has_sleep_events(&self) -> bool {
        self.options.has(BodyOptions::SLEEP_EVENTS)
    }

    /// Sets [`has_sleep_events`](Self::has_sleep_events).
    pub fn set_sleep_events(&mut self, value: bool) {
        self.options.set(BodyOptions::SLEEP_EVENTS, value);
    }

    /// Whether rotational drag is proportional to the angular velocity: torque = -c · angular velocity, with c the
    /// [coefficient](Self::rotational_drag_coefficient). Default false: proportional to its square, as in the original. Ours.
    #[inline]
    pub fn is_rotational_drag_linear(&self) -> bool {
        self.options.has(BodyOptions::LINEAR_ROTATIONAL_DRAG)
    }

    /// Sets [`is_rotational_drag_linear`](Self::is_rotational_drag_linear).
    pub fn set_rotational_drag_linear(&mut self, value: bool) {
        self.options.set(BodyOptions::LINEAR_ROTATIONAL_DRAG, value);
    }

    /// Whether the next update of the precise set puts the body to sleep, if its island allows it.
    #[cfg(feature = "precise")]
    #[inline]
    pub(crate) fn is_sleep_requested(&self) -> bool {
        self.options.has(BodyOptions::SLEEP_REQUESTED)
    }

    pub(crate) fn set_sleep_requested(&mut self, value: bool) {
        self.options.set(BodyOptions::SLEEP_REQUESTED, value);
    }
}
