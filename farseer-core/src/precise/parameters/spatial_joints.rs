//! Joints in three axes: groups of bodies that distances tie.

/// Compliance of a joint that closes a loop, as a fraction of its inverse effective mass: constraints that contradict each other, as those
/// of a rope that is taut between two posts, get finite impulses. Unit: dimensionless.
pub(in crate::precise) const LOOP_COMPLIANCE: f64 = 1e-1;

/// Velocity iterations of a group without loops. Unit: dimensionless, a count.
pub(in crate::precise) const TREE_VELOCITY_ITERATIONS: usize = 2;

/// Velocity iterations of a group with loops. Unit: dimensionless, a count.
pub(in crate::precise) const LOOP_VELOCITY_ITERATIONS: usize = 3;

/// Most velocity iterations of a group while its active set changes. Unit: dimensionless, a count.
pub(in crate::precise) const ACTIVE_SET_ITERATIONS: usize = 16;

/// Gauss-Seidel sweeps over a group that is too large for a factorisation. Unit: dimensionless, a count.
pub(in crate::precise) const GROUP_SWEEPS: usize = 20;

/// Greatest lateral stiffness that the pull of a loop gives its links in a substep, as a fraction of their inertia. Unit: dimensionless.
pub(in crate::precise) const LOOP_STIFFNESS: f64 = 0.5;

/// Error that counts as zero. Unit: length units.
pub(in crate::precise) const GROUP_ERROR_FLOOR: f64 = 1e-9;

/// Error at which an iteration has converged, whatever it was before. Unit: length units.
pub(in crate::precise) const GROUP_ERROR_CONVERGED: f64 = 1e-3;

/// Greatest position error that is corrected by the motion of a substep instead of a separate correction. Unit: length units, and
/// radians. Ten times the rounding of positions a thousand length units away; none of its speed is left by the velocity pass.
pub(in crate::precise) const POSITION_ERROR_IN_MOTION: f64 = 1e-5;

/// Stiffness that a part of a substep integrates stably, where 4 is the limit at which 4 T h^2 / (l m) overshoots: pull T of the
/// links of a rope, their length l and mass m. Unit: dimensionless.
pub(in crate::precise) const ROPE_STABLE_STIFFNESS: f64 = 0.1;

/// Pull that is provided for, as a multiple of the present one. Unit: dimensionless. A pendulum released from the level pulls three times
/// its weight at its lowest point: m g + m v^2 / l with v^2 = 2 g l.
pub(in crate::precise) const ROPE_PULL_AHEAD: f64 = 3.0;

/// Most parts that a substep of a free group is divided into. Unit: dimensionless, a count.
pub(in crate::precise) const ROPE_SUBSTEP_PARTS: f64 = 24.0;

/// Most products of the factors that all parts of a substep take: a large net gets fewer parts. Unit: dimensionless, a count.
pub(in crate::precise) const ROPE_SUBSTEP_PRODUCTS: f64 = 1e6;

/// Multiple of parts with which a step that gained energy is repeated. Unit: dimensionless.
pub(in crate::precise) const ROPE_RETRY_PARTS: u32 = 3;

/// Greatest energy that joints may add to a group in a part of a substep, as a fraction of its kinetic energy. Unit: dimensionless.
/// Joints do no work but for the error of the method.
pub(in crate::precise) const ROPE_ENERGY_GAIN: f64 = 0.01;

/// Part of a position error that a substep corrects where a joint closes a loop or a limit is passed (Baumgarte). Unit: dimensionless,
/// at most 1.
pub(in crate::precise) const LOOP_BAUMGARTE_FACTOR: f64 = 0.2;

/// Greatest position error that is corrected at once. Unit: length units, and radians.
pub(in crate::precise) const POSITION_CORRECTION_LIMIT: f64 = 0.5;

/// Most products of a factorisation; a larger group is solved by Gauss-Seidel sweeps. Unit: dimensionless, a count.
pub(in crate::precise) const GROUP_FACTOR_PRODUCTS: usize = 2_000_000;
