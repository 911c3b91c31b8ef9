//! Parameters of joints in three axes: groups of bodies that distance joints connect.
//!
//! A group without contacts divides the substeps of the solver further, into *parts*.

/// Compliance of rows that close a loop, and of motors, as a fraction of their inverse effective mass. Unit: dimensionless.
///
/// It keeps impulses finite where rows contradict each other, as those of a taut rope between two posts. Such a regularisation
/// is the constraint force mixing of ODE (R. Smith); C. Lacoursière, "Ghosts and Machines" (2007), derives it. Value chosen; its
/// sensitivity is not measured.
pub(crate) const LOOP_COMPLIANCE: f64 = 1e-1;

/// Smallest number of velocity iterations per solve of a group of joints in three axes without loops. Unit: dimensionless, a
/// count. Value chosen; its sensitivity is not measured.
pub(crate) const TREE_MIN_VELOCITY_ITERATIONS: usize = 2;

/// Smallest number of velocity iterations per solve of a group of joints in three axes with loops. Unit: dimensionless, a
/// count. Value chosen; its sensitivity is not measured.
pub(crate) const LOOP_MIN_VELOCITY_ITERATIONS: usize = 3;

/// Largest number of velocity iterations per solve of a group of joints in three axes, while its active set changes. Unit:
/// dimensionless, a count.
///
/// No row joins the active set in the second half of the iterations, so that the set cannot cycle. Value chosen; its
/// sensitivity is not measured.
pub(crate) const ACTIVE_SET_MAX_ITERATIONS: usize = 16;

/// Gauss-Seidel sweeps over a group of joints in three axes that is too large for a factorisation. Unit: dimensionless, a
/// count. Value chosen; its sensitivity is not measured.
pub(crate) const GROUP_GAUSS_SEIDEL_SWEEPS: usize = 20;

/// Largest lateral stiffness that the tension of a loop of distance joints may give a joint in a substep, as a fraction of the
/// inertia of its bodies. Unit: dimensionless.
///
/// An explicit stiffness is unstable from 4 on. A loop that cannot close has no other bound on its tension. Value chosen; its
/// sensitivity is not measured.
pub(crate) const LOOP_MAX_LATERAL_STIFFNESS: f64 = 0.5;

/// Position error that the velocity errors of a group in three axes cause in a substep, below which they count as zero. Unit:
/// length units. Value chosen; its sensitivity is not measured.
pub(crate) const GROUP_ERROR_FLOOR: f64 = 1e-9;

/// Position error that the velocity errors of a group in three axes cause in a substep, below which its solve counts as
/// converged. Unit: length units. Value chosen; its sensitivity is not measured.
pub(crate) const GROUP_ERROR_CONVERGED: f64 = 1e-3;

/// Largest position error that the first solve of a substep corrects together with the motion. Unit: length units, in angular
/// rows radians.
///
/// Larger errors get a second solve, whose correction speed the relaxation removes. The value is ten times the spacing of `f32`
/// positions ten length units from the origin of the world.
pub(crate) const MERGED_CORRECTION_MAX_ERROR: f64 = 1e-5;

/// Lateral stiffness of a rope of distance joints in a part of a substep, as a fraction of the stable limit. Unit:
/// dimensionless, at most 1.
///
/// It determines the number of parts. With tension T, joint length l, body mass m and part h (seconds), the stiffness is 4 T
/// h^2 / (l m); an explicit step overshoots from 4 on. Value chosen; its sensitivity is not measured.
pub(crate) const ROPE_STABLE_LIMIT_FRACTION: f64 = 0.1;

/// Largest tension of a rope for which the parts of a substep are short enough, as a multiple of the tension in the last step.
/// Unit: dimensionless, >= 1.
///
/// A pendulum that is released from the level has three times its weight as tension at its lowest point: m g + m v^2 / l with
/// v^2 = 2 g l.
pub(crate) const ROPE_TENSION_MARGIN: f64 = 3.0;

/// Largest number of parts into which a group of joints without contacts divides a substep. Unit: dimensionless, a count. It
/// bounds the cost. Value chosen; its sensitivity is not measured.
pub(crate) const ROPE_MAX_SUBSTEP_PARTS: f64 = 24.0;

/// Largest number of parts of all substeps of a step together. Unit: dimensionless, a count. It is [`ROPE_MAX_SUBSTEP_PARTS`]
/// times 4 substeps: with more substeps each is shorter, and needs fewer parts.
pub(crate) const ROPE_MAX_STEP_PARTS: f64 = 96.0;

/// Largest number of products in the factorisations for all parts of a substep. Unit: dimensionless, a count.
///
/// It bounds the cost of large nets, which get fewer parts per substep. Value chosen; its sensitivity is not measured.
pub(crate) const ROPE_MAX_SUBSTEP_PRODUCTS: f64 = 1e6;

/// Factor by which the number of parts per substep grows when the step of a group without contacts is repeated. Unit:
/// dimensionless, > 1. Value chosen; its sensitivity is not measured.
pub(crate) const ROPE_RETRY_FACTOR: u32 = 3;

/// Largest energy that joints in three axes may add in a part of a substep, as a fraction of the kinetic energy. Unit:
/// dimensionless, >= 0.
///
/// Joints do no work, so that a gain is an error of the integration. A greater gain repeats the step with more parts. Value
/// chosen; its sensitivity is not measured.
pub(crate) const ROPE_MAX_ENERGY_GAIN: f64 = 0.01;

/// Fraction of a position error that a substep corrects at limits and in loops of joints in three axes (J. Baumgarte,
/// "Stabilization of constraints and integrals of motion in dynamical systems", 1972). Unit: dimensionless, at most 1. Value
/// chosen; its sensitivity is not measured.
pub(crate) const LOOP_BAUMGARTE_FACTOR: f64 = 0.2;

/// Largest position error of a joint in three axes that a substep corrects at once. Unit: length units, in angular rows
/// radians. Value chosen; its sensitivity is not measured.
pub(crate) const MAX_POSITION_CORRECTION: f64 = 0.5;

/// Largest number of products in the factorisation of a group of joints in three axes. Unit: dimensionless, a count.
///
/// Larger groups use Gauss-Seidel sweeps, whose cost is linear. Value chosen; its sensitivity is not measured.
pub(crate) const GROUP_MAX_FACTOR_PRODUCTS: usize = 2_000_000;
