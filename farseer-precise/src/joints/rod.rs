//! Distance joints of a free articulation across their axes.
//!
//! A distance joint under tension T acts as a stiffness T / L against motion across its axis, with the length L: its force
//! turns with the rod. This is geometric stiffness (M. Tournier and others, "Stable constrained dynamics", 2015). An explicit
//! substep cannot integrate that stiffness beyond a limit, so that a chain of rods with a heavy end would be torn apart. The
//! excess is integrated implicitly, as that of [bodies](super::articulation_step) is.

use crate::parameters::direct::STABLE_STIFFNESS;
use crate::parameters::joints::STIFFNESS_JUMP_RATIO;

/// State of a distance joint across its axis.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct RodState {
    /// Geometric stiffness T / L against motion across the axis times the square of the substep. Unit: mass units.
    stiffness: f64,
    /// Largest `stiffness` that is stable in a substep. Unit: mass units, >= 0; 0 for other joints.
    stable_stiffness: f64,
    /// Excess of `stiffness` over the stable one, integrated implicitly. Unit: mass units, >= 0.
    pub(super) added_stiffness: f64,
    /// Amount of `added_stiffness` that [carries momentum](super::substep_plan::momentum_carrying_stiffness). Unit: mass units, >= 0.
    momentum_stiffness: f64,
    /// Velocity of the body's anchor relative to the parent's across the axis, before joint impulses. Unit: length units/s.
    initial_velocity: f64,
    /// Predicted change of that velocity by joints in this substep. Unit: length units/s.
    predicted_change: f64,
}

impl RodState {
    /// Returns the state at the start of a step. `mass` is the effective mass of both bodies across the axis, mass units.
    pub(super) fn of_mass(mass: f64) -> Self {
        RodState { stable_stiffness: STABLE_STIFFNESS * mass, ..RodState::default() }
    }

    /// Converts the stiffness of an undivided step to one of `substeps` substeps.
    #[inline(always)]
    pub(super) fn begin_substeps(&mut self, substeps: f64) {
        self.stiffness *= 1.0 / (substeps * substeps);
        (self.added_stiffness, self.predicted_change) = (self.excess_stiffness(), 0.0);
    }

    /// Starts a substep: no change by joints is predicted.
    #[inline(always)]
    pub(super) fn begin_substep(&mut self) {
        self.predicted_change = 0.0;
    }

    /// Starts a solve with this velocity across the axis before joint impulses, in length units/s. `with_momentum(added, stable)`
    /// returns the amount of the added stiffness that carries momentum, all in mass units.
    #[inline(always)]
    pub(super) fn begin_solve(&mut self, velocity: f64, with_momentum: impl Fn(f64, f64) -> f64) {
        self.initial_velocity = velocity;
        self.momentum_stiffness = with_momentum(self.added_stiffness, self.stable_stiffness);
    }

    /// Sets the geometric stiffness, in mass units. A rod of no length has none.
    #[inline(always)]
    pub(super) fn set_stiffness(&mut self, stiffness: f64) {
        self.stiffness = if stiffness.is_finite() { stiffness } else { 0.0 };
    }

    /// Returns the predicted velocity across the axis, in length units/s.
    #[inline(always)]
    pub(super) fn predicted_velocity(&self) -> f64 {
        self.initial_velocity + self.predicted_change
    }

    /// Predicts the solved `velocity` across the axis for a repeated solve. Returns its difference from the last prediction. Both
    /// are in length units/s.
    #[inline(always)]
    pub(super) fn predict(&mut self, velocity: f64) -> f64 {
        let difference = velocity - self.predicted_velocity();
        self.predicted_change = velocity - self.initial_velocity;
        difference
    }

    /// Returns the momentum across the axis that the added stiffness carries, in mass units * length units/s.
    #[inline(always)]
    pub(super) fn momentum(&self) -> f64 {
        self.momentum_stiffness * self.initial_velocity
    }

    /// Returns the excess of the stiffness over the stable one. Unit: mass units, >= 0.
    #[inline(always)]
    fn excess_stiffness(&self) -> f64 {
        let excess = self.stiffness - self.stable_stiffness;
        if excess > 0.0 { excess } else { 0.0 }
    }

    /// Raises the added stiffness to the present excess, after a [jump](Self::stiffness_jumped).
    #[inline(always)]
    pub(super) fn raise_added_stiffness(&mut self) {
        self.added_stiffness = self.added_stiffness.max(self.excess_stiffness());
    }

    /// Returns whether the stiffness exceeds `ratio` times the stable one.
    #[inline(always)]
    pub(super) fn is_stiffer(&self, ratio: f64) -> bool {
        self.stiffness > ratio * self.stable_stiffness
    }

    /// Returns whether the stiffness exceeds the added one by more than [`STIFFNESS_JUMP_RATIO`] times the stable one.
    #[inline(always)]
    pub(super) fn stiffness_jumped(&self) -> bool {
        self.stiffness > self.added_stiffness + STIFFNESS_JUMP_RATIO * self.stable_stiffness
    }
}
