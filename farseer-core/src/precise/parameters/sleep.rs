//! Sleep and waking.

/// Time for which all bodies of an island are at rest before it sleeps. Unit: s. Box2D 3 (E. Catto, `B2_TIME_TO_SLEEP`).
pub(in crate::precise) const TIME_TO_SLEEP: f32 = 0.5;

/// Part of that time after which an island that only waits for a slow drive is tested again. Unit: dimensionless, at most 1.
pub(in crate::precise) const SLEEP_RETEST_PART: f32 = 0.8;

/// Sleep threshold as a fraction of the speed of a fall over one length unit. Unit: dimensionless.
pub(in crate::precise) const SLEEP_SPEED_PER_FALL: f32 = 0.01;

/// Sleep threshold without gravity. Unit: length units/s.
pub(in crate::precise) const SLEEP_SPEED_WEIGHTLESS: f32 = 1e-3;

/// Relative change of the supported force that does not wake a body once it is at rest. Unit: dimensionless.
pub(in crate::precise) const WAKING_FORCE_CHANGE: f32 = 0.25;

/// Fraction of a drive's speed below which its body is stalled. Unit: dimensionless. A drive of constant effort that takes
/// longer than the 0.5 s after which bodies sleep to reach this fraction is stalled: it would take 50 s to reach its speed.
pub(in crate::precise) const STALLED_DRIVE_SPEED: f32 = 0.01;
