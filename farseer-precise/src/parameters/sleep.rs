//! Parameters of sleeping and waking: rest time, sleep speed, supported forces and stalled drives.

/// Time for which all bodies of an island must be at rest before the island sleeps. Unit: s. Source: Box2D 3 (E. Catto,
/// `B2_TIME_TO_SLEEP`).
pub const TIME_TO_SLEEP: f32 = 0.5;

/// Rest time to which an island is set back that is at rest but not ready to sleep, as a fraction of [`TIME_TO_SLEEP`]. Unit:
/// dimensionless, at most 1.
///
/// The island is then tested again after a fifth of the time to sleep, not in every step. Value chosen; its sensitivity is not
/// measured.
pub(crate) const SLEEP_RETEST_FRACTION: f32 = 0.8;

/// Speed below which a body is at rest, as a fraction of the speed after a fall over one length unit. Unit: dimensionless, > 0.
///
/// A limit that follows gravity and the size of bodies suits all units. Value chosen; its sensitivity is not measured.
pub(crate) const SLEEP_SPEED_PER_FALL: f32 = 0.01;

/// Smallest value of the speed below which a body is at rest; it applies without gravity. Unit: length units/s. Value chosen;
/// its sensitivity is not measured.
pub(crate) const SLEEP_SPEED_WEIGHTLESS: f32 = 1e-3;

/// Largest relative change of the force on a body in the step after it fell asleep for which the body sleeps on: the new force
/// replaces the supported one. Unit: dimensionless, >= 0.
///
/// A damped spring exerts another force once the velocity of the body is set to 0; that must not wake the body. Value chosen;
/// its sensitivity is not measured.
pub const REMEASURED_FORCE_MAX_CHANGE: f32 = 0.25;

/// Fraction of a drive's speed below which the driven body counts as stalled and may sleep. Unit: dimensionless, at most 1.
///
/// With a constant force, a drive that reaches this fraction only after [`TIME_TO_SLEEP`] would need 50 s to reach its full
/// speed. So a slower one counts as stalled.
pub(crate) const STALLED_DRIVE_SPEED_FRACTION: f32 = 0.01;
