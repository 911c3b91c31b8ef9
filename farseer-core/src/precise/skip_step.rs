//! Adapter: early out for updates in which every body sleeps and no stage of the step has work.
//!
//! Without it each stage would find out by itself that it has no work, from memory that is no longer in the cache.

use crate::FrictionType;
use crate::math::Vector2;
use crate::precise::Precise;

/// Settings of an update that do not belong to an object of the simulator.
pub(crate) struct StepSettings {
    /// Length of the update (one step), seconds.
    pub(crate) dt: f32,
    /// Number of substeps of the update, >= 1.
    pub(crate) substeps: u32,
    /// Acceleration by gravity, length units/s^2.
    pub(crate) gravity: Vector2,
    /// Whether bodies may sleep.
    pub(crate) may_sleep: bool,
    /// Rule by which the friction coefficients of two geoms are combined.
    pub(crate) friction: FrictionType,
    /// Largest number of contact points of a pair that the solver receives.
    pub(crate) max_contacts: u32,
}

impl Precise {
    /// Skips the update if it cannot change anything. Returns whether the update is skipped.
    ///
    /// The caller makes sure that no event handler, spring or controller has to act in the update.
    pub(crate) fn try_skip_step(&mut self, settings: &StepSettings) -> bool {
        let &StepSettings { dt, substeps, gravity, may_sleep, friction, max_contacts: most_contacts } =
            settings;
        let is_as_before = self.solver.step_lengths()[0] == dt / substeps as f32
            && may_sleep
            && self.solver.sleep.is_undisturbed([gravity.x, gravity.y])
            && (self.solver.friction, self.solver.max_contacts) == (friction, most_contacts);
        let has_changed_kinds = !self.changed_kinds.is_empty();
        if !(is_as_before && self.solver.is_idle() && !self.may_break_joints()) || has_changed_kinds {
            return false;
        }
        self.solver.dt = dt;
        true
    }
}
