//! Number of substeps of a free articulation's step, and the limits of what a substep integrates.

use super::super::scaled_parameters::StepContext;
use super::articulated_body::Links;
use super::energy_balance::{BalancedLink, EnergyBalance, InitialEnergy};
use crate::parameters::direct::STABLE_STIFFNESS;
use crate::parameters::joints::{
    ARTICULATION_SUBSTEP_RATIO, BALANCED_PREDICTION_SHARE, LARGE_ARTICULATION_BODIES, LEAST_DIVISION,
    MAX_BALANCED_ARTICULATION_BODIES, MAX_FAILED_SUBSTEP_RATIO, MAX_REPEATED_SUBSTEP_RATIO,
    MAX_UNBALANCED_MASS_RATIO, MIN_ARTICULATION_SUBSTEPS, MOMENTUM_SHARE_HALVED_AT,
    MOMENTUM_SHARE_OF_STIFFNESS, PREDICTED_ROTATION_ERROR, REPEATED_SUBSTEP_FACTOR, ROTATION_PER_SUBSTEP,
    SUBSTEP_GROWTH_DIVISOR,
};

/// Size of an articulation, and whether it gets an [energy balance](super::energy_balance).
#[derive(Debug, Clone, Copy, Default)]
pub(crate) struct ArticulationSize {
    /// Number of dynamic bodies.
    pub(crate) bodies: u32,
    /// Whether the articulation gets an energy balance.
    pub(crate) is_balanced: bool,
}

impl ArticulationSize {
    /// Returns the size of an articulation with these masses of its dynamic bodies, in mass units. It gets an energy balance if it
    /// is small, if it has a rod (`has_rod`), or if the masses differ by more than [`MAX_UNBALANCED_MASS_RATIO`].
    pub(super) fn of(masses: impl Iterator<Item = f64>, has_rod: bool) -> Self {
        let (mut bodies, mut least, mut greatest) = (0, f64::INFINITY, 0.0);
        for mass in masses {
            bodies += 1;
            least = if mass < least { mass } else { least };
            greatest = if mass > greatest { mass } else { greatest };
        }
        let is_mixed = greatest > MAX_UNBALANCED_MASS_RATIO * least;
        ArticulationSize {
            bodies,
            is_balanced: has_rod || is_mixed || SubstepPlan::is_energy_balanced(bodies),
        }
    }
}

/// Number of substeps of a free articulation's step, with the choices of the method that depend on it.
pub(crate) struct SubstepPlan {
    /// Number of substeps that the articulation divides the step into, >= 1.
    pub(crate) substeps: u32,
    /// Largest number of substeps for a repetition of the step.
    pub(super) max_substeps: u32,
    /// As `max_substeps`, for the repetition of a step that has failed.
    pub(super) max_failed_substeps: u32,
    /// Whether forces act in full at the start of each substep (kick-drift) instead of by halves at both ends of the step.
    ///
    /// Both methods move bodies to the same positions (Leimkuhler and Skeel 1994, see
    /// [`articulation_step`](super::articulation_step)). The velocities after kick-drift belong to a time half a substep earlier,
    /// and are not projected on the joints.
    pub(super) is_kick_drift: bool,
    /// Whether the [changes of the angular velocities by joints are predicted](predict_spin_change). False where large joint
    /// errors are being closed.
    pub(super) predicts_spin: bool,
    /// Largest deviation of a body's rotation from its prediction in a substep. A greater one repeats the solve. Unit: radians.
    pub(super) max_prediction_error: f64,
}

impl SubstepPlan {
    /// Returns the plan for the step of an articulation of this size.
    ///
    /// `start_spin` and `end_spin` are the greatest absolute angular velocities at the start and at the predicted end of the
    /// step, in radians/s. `is_stiffer(f)` returns whether a geometric stiffness exceeds f times the limit of an undivided
    /// step.
    ///
    /// The number of substeps grows until no body turns by more than [`ROTATION_PER_SUBSTEP`] in one. Up to
    /// [`LARGE_ARTICULATION_BODIES`] bodies it also grows until every stiffness is within the limit.
    pub(crate) fn of(
        ArticulationSize { bodies, is_balanced }: ArticulationSize,
        step: &StepContext,
        [start_spin, end_spin]: [f64; 2],
        is_stiffer: impl Fn(f64) -> bool,
    ) -> Self {
        let is_large = bodies > LARGE_ARTICULATION_BODIES;
        let spin = if is_balanced { start_spin.max(end_spin) } else { start_spin };
        let rotation = spin * f64::from(step.dt);
        let is_stiff = |substeps: u32| is_stiffer(f64::from(substeps * substeps));
        let solver_substeps = step.substeps.max(LEAST_DIVISION);
        let max_substeps =
            if is_large { solver_substeps } else { ARTICULATION_SUBSTEP_RATIO * solver_substeps };
        let mut substeps = if is_balanced { MIN_ARTICULATION_SUBSTEPS } else { 1 };
        while substeps < max_substeps
            && (f64::from(substeps) * ROTATION_PER_SUBSTEP < rotation || (!is_large && is_stiff(substeps)))
        {
            substeps += (substeps / SUBSTEP_GROWTH_DIVISOR).max(1);
        }
        SubstepPlan {
            substeps: substeps.min(max_substeps),
            max_substeps: MAX_REPEATED_SUBSTEP_RATIO * solver_substeps,
            max_failed_substeps: MAX_FAILED_SUBSTEP_RATIO * solver_substeps,
            is_kick_drift: !is_balanced,
            predicts_spin: is_balanced,
            max_prediction_error: if is_balanced { BALANCED_PREDICTION_SHARE } else { 1.0 }
                * PREDICTED_ROTATION_ERROR,
        }
    }

    /// Returns whether an articulation of `bodies` dynamic bodies gets an [energy balance](super::energy_balance) whatever they are.
    #[inline(always)]
    pub(crate) fn is_energy_balanced(bodies: u32) -> bool {
        bodies <= MAX_BALANCED_ARTICULATION_BODIES
    }

    /// Returns the energy balance of the step of `dt` seconds that followed this plan. Returns `None` if `start`, the energy at
    /// the start, is `None`, or if a moving root did work.
    pub(super) fn energy_balance<N: BalancedLink>(
        &self,
        links: &Links<N>,
        start: Option<InitialEnergy>,
        dt: f64,
    ) -> Option<EnergyBalance> {
        EnergyBalance::of(links, start?, [dt, dt / f64::from(self.substeps)])
    }

    /// Returns the plan for the repetition of a step with this energy balance: [`REPEATED_SUBSTEP_FACTOR`] times the substeps,
    /// within `max_substeps`. Returns `None` if the energy error is small or the number of substeps cannot grow. It grows further
    /// after a step that [has failed](EnergyBalance::has_failed).
    pub(super) fn refined(&self, balance: &EnergyBalance) -> Option<Self> {
        let has_failed = balance.has_failed();
        let most = if has_failed { self.max_failed_substeps } else { self.max_substeps };
        let substeps = (REPEATED_SUBSTEP_FACTOR * self.substeps).min(most);
        ((has_failed || balance.exceeds_tolerance()) && substeps > self.substeps)
            .then_some(SubstepPlan { substeps, ..*self })
    }
}

/// Returns the predicted change of a body's angular velocity by joints in a substep, in radians/s. `change` is that in the
/// previous substep.
///
/// The prediction falls linearly to 0 as the geometric stiffness approaches the stable stiffness, both in mass units * length
/// units^2. A motion that oscillates within a substep cannot be predicted.
#[inline(always)]
pub(super) fn predict_spin_change(change: f64, geometric_stiffness: f64, stable_stiffness: f64) -> f64 {
    let remainder = 1.0 - geometric_stiffness.abs() / stable_stiffness;
    if remainder > 0.0 { remainder * change } else { 0.0 }
}

/// Returns the larger absolute values of the given angular velocities and those of one more body, at the start and at the
/// predicted end of a step. Unit: radians/s.
///
/// `start_spin` is the body's angular velocity and `change` the predicted change of it.
#[inline(always)]
pub(super) fn max_spins([max_start, max_end]: [f64; 2], start_spin: f64, change: f64) -> [f64; 2] {
    [max_start.max(start_spin.abs()), max_end.max((start_spin + change).abs())]
}

/// Returns the largest geometric stiffness of a body that is stable in a substep: [`STABLE_STIFFNESS`] times the moment of
/// inertia about the farthest joint. Unit: mass units * length units^2.
///
/// `inertia` is the moment of inertia about the centre of mass. `max_arm_squared` is the square of the largest distance from
/// the centre of mass to a joint, in length units^2.
#[inline(always)]
pub(super) fn stable_stiffness(inertia: f64, mass: f64, max_arm_squared: f64) -> f64 {
    STABLE_STIFFNESS * (inertia + mass * max_arm_squared)
}

/// Returns the fraction of a position error that is left for later substeps, 0..=1. At most `max_correction` of the error
/// `size` is corrected now, both in length units or both in radians.
#[inline(always)]
pub(super) fn clamped_remainder(size: f64, max_correction: f64) -> f64 {
    if size > max_correction { 1.0 - max_correction / size } else { 0.0 }
}

/// Returns the amount of the added stiffness `stiffness` that carries momentum, too; the solve of a substep applies it to the
/// old angular velocity. Both arguments and the result are in mass units * length units^2.
///
/// With moment of inertia I, added stiffness S and angular velocities w before and w' after, a substep solves (I + S) w' = (I +
/// m) w + impulses. The result is m, at most 0.9 S. So the body feels the angular impulse m w - S w' in addition: while w' is
/// near w, that is the drag -(S - m) w. No m conserves angular momentum exactly, since the added stiffness is no inertia of the
/// body.
///
/// The value m = 0 is an implicit step, which loses energy of rotation. The value m = S conserves energy like a leapfrog with
/// larger inertias while S is constant. A stiffness that is many times the limit and changes from step to step makes such a
/// leapfrog gain energy.
///
/// Measured with balls of 1 to 100,000 mass units on a chain and chains of 9 to 50 links. With m = S a third of them gains
/// energy. With m = 0 they lose 19, 7.8 and 2.8 % of their greatest kinetic energy in ten seconds at 30, 60 and 120 Hz. With
/// this formula they lose 6.2, 2.3 and 1.1 %. It does not exclude gains: in the joint scenes a chain of 20 gains 0.18 % in ten
/// seconds (docs/measured/joints/figures.csv).
#[inline(always)]
pub(crate) fn momentum_carrying_stiffness(stiffness: f64, stable_stiffness: f64) -> f64 {
    if stiffness == 0.0 {
        return 0.0;
    }
    let ratio = stiffness / (MOMENTUM_SHARE_HALVED_AT * stable_stiffness);
    MOMENTUM_SHARE_OF_STIFFNESS * stiffness / (1.0 + ratio * ratio)
}
