//! Parameters of the joints in the plane: free articulations, and the soft rows of the iterative solver.
//!
//! A free articulation divides its step into substeps of its own; in the direct solver they are called intervals. Effects of half
//! or twice a value are those of the sensitivity report, docs/measured/sensitivity/report.md: "no measured row changes" means
//! that none of the report's measurements does. The final speed of the scene "chain 5" is chaotic: it changes with most values.

/// Greatest speed at which position errors of articulations are corrected. Unit: length units/s, and radians/s for angles.
///
/// Other joints leave a fraction of the correction speed in the velocity of their bodies, and light bodies between heavy ones
/// move at a multiple of it. The value is that of contacts,
/// [`PENETRATION_RECOVERY_MAX_SPEED`](super::contacts::PENETRATION_RECOVERY_MAX_SPEED). No measured row changes from half to
/// twice the value.
pub(crate) const JOINT_CORRECTION_SPEED: f64 = 3.0;

/// Largest number of dynamic bodies of a free articulation that gets an energy balance (scaling of velocities against energy
/// errors). Unit: number of bodies.
///
/// Such articulations divide their step into at least [`MIN_ARTICULATION_SUBSTEPS`] substeps of their own. Half of the force
/// impulse acts at each end of the step. The reason of the limit is time: with an energy balance chains of 20 take 1.7 times as
/// long, more than in Box2D. Chains of 12 and fewer gained up to 50 % energy without it. With half the value the Newton steps of
/// 20 ragdolls change, with twice the final speed of a ball of 100 mass units on a chain of 20; no verdict changes.
pub(crate) const MAX_BALANCED_ARTICULATION_BODIES: u32 = 12;

/// Greatest mass ratio of two bodies of a free articulation above [`MAX_BALANCED_ARTICULATION_BODIES`] bodies that gets no energy
/// balance. Unit: dimensionless.
///
/// Measured on 600 random trees of 2 to 26 hinges with masses 1 to 1 up to 1 to 1,000, 8 s each. Without this limit 16 trees gape
/// by 0.02 to 0.8 m and gain up to 80 % of energy, all of them large and with ratios of 19 and more.
pub(crate) const MAX_UNBALANCED_MASS_RATIO: f64 = 10.0;

/// Number of bodies of a free articulation above which its geometric stiffness adds no substeps to its step. Unit: number of
/// bodies.
///
/// It bounds the cost of large articulations, whose excess stiffness is integrated implicitly. They also have at most as many
/// substeps of their own as the solver has. No measured row depends on it from half to twice the value.
pub(crate) const LARGE_ARTICULATION_BODIES: u32 = 50;

/// Fewest substeps into which a free articulation with an energy balance divides its step. Unit: number of substeps.
///
/// Measured: with 1, pendulums of one to three links deviate three times as far from the motion at fine steps as with 2. Of the
/// measured rows only that of chain 5 changes with half or twice the value.
pub(crate) const MIN_ARTICULATION_SUBSTEPS: u32 = 2;

/// Fewest intervals into which the direct solver divides the step of a free articulation of up to
/// [`MAX_BALANCED_ARTICULATION_BODIES`] bodies. Unit: number of substeps.
///
/// The direct solver does not correct energy errors by scaling velocities, so that it needs more intervals. Measured: a double
/// pendulum with limits keeps its energy within 1 % at 60 steps/s.
pub(crate) const MIN_DIRECT_SUBSTEPS: u32 = 3;

/// Number of substeps of the solver below which the limits of the substeps of free articulations do not fall. Unit: number of
/// substeps.
///
/// Fast motion and stiffness need substeps whatever the solver has. Measured on 672 revolute chains of 3 to 40 bodies at 30 and 60
/// Hz. With 1 substep of the solver 12 gained 1 to 130 % of energy, and 9 gaped by 2 to 76 cm; none does with this limit.
pub(crate) const LEAST_DIVISION: u32 = 4;

/// Most substeps of a free articulation per substep of the solver. Unit: dimensionless, ratio of two numbers of substeps.
///
/// It bounds the cost of fast and stiff articulations. Measured: with 1 the energy error of a chain of 20 is 1.6e-2 instead of
/// 1.8e-3; no measured row changes with 4.
pub(crate) const ARTICULATION_SUBSTEP_RATIO: u32 = 2;

/// Most substeps of a free articulation per substep of the solver, when its step is repeated for an energy error. Unit: ratio
/// of two numbers of substeps.
///
/// Measured: chains of 12 at 30 steps/s need this many when they whip. No measured row changes with twice the value, and chain 5
/// alone with half.
pub(crate) const MAX_REPEATED_SUBSTEP_RATIO: u32 = 4;

/// As [`MAX_REPEATED_SUBSTEP_RATIO`], for a step that has failed: its energy error exceeds [`FAILED_STEP_ENERGY_ERROR`]. Unit:
/// ratio of two numbers of substeps.
///
/// Measured with 10 to 1,000 times a link's mass at the end of chains of 2 to 10, 120 s each: gaps of 5 m without such
/// repetitions. From 16 to 128 they are at most 0.2 m, and at most 0.006 m in 11 of 14 chains; see also
/// [`FAILED_STEP_JOINT_ERROR`].
pub(crate) const MAX_FAILED_SUBSTEP_RATIO: u32 = 64;

/// Energy error above which the step of a free articulation has failed: its positions are as wrong as its energy. Unit: fraction
/// of the kinetic energy plus the work of forces, dimensionless.
///
/// Measured on the chains of [`MAX_FAILED_SUBSTEP_RATIO`]: 0.02 to 0.1 differ little, with 0.2 two chains open by 1.9 and 2.6 m.
pub(crate) const FAILED_STEP_ENERGY_ERROR: f64 = 0.05;

/// Growth of a joint error above which the step of a free articulation has failed, too. Unit: fraction of the joint's arms plus the
/// radius of gyration, dimensionless; for angles radians.
///
/// A step may open a joint and keep its energy: a chain that snaps taut while its light links turn by a radian. Measured on the
/// chains of [`MAX_FAILED_SUBSTEP_RATIO`] with 30 to 1,000 times the mass, also without drag. Without this limit 28 of 128 gaped by
/// 0.02 to 9.6 m; with it the widest gap is 0.003 m. They take 8 % less time.
pub(crate) const FAILED_STEP_JOINT_ERROR: f64 = 0.005;

/// Energy error above which the step of a free articulation is repeated with more substeps. Unit: fraction of the kinetic
/// energy plus the work of forces, dimensionless.
///
/// Measured: energies and times of chains are the same from 0.005 to 0.02. No measured row changes with half the value, and the
/// final speed of chain 5 alone with twice.
pub(crate) const MAX_STEP_ENERGY_ERROR: f64 = 0.01;

/// Energy that joints of a free articulation may remove at the start of a step, because velocities violate the joints. Unit:
/// fraction of the kinetic energy plus the work of forces, dimensionless.
///
/// Above this limit the energy balance does not replace lost energy. A step leaves 1e-9 by rounding; an impulse from outside
/// leaves more. No measured row depends on it from half to twice the value.
pub(crate) const MAX_INELASTIC_LOSS: f64 = 1e-4;

/// Bound on the rounding error of the positions of both bodies of a joint. Unit: fraction of the coordinates, dimensionless.
///
/// Derived: four roundings of an `f32`, each of at most half a unit in the last place, 2^-24 = 6.0e-8. No measured row changes
/// from half to twice the value.
pub(crate) const MAX_POSITION_ROUNDING: f64 = 2.5e-7;

/// Estimate of the greatest rounding error of a rotation of up to a hundred turns. Unit: radians.
///
/// Derived: half a unit in the last place of an `f32` from 512 to 1,024 radians is 2^-15 = 3.05e-5, of which this is 98 %. It is
/// a strict bound up to 512 radians (81 turns). Of the measured rows only that of chain 5 changes with half or twice the value.
pub(crate) const MAX_ROTATION_ROUNDING: f64 = 3e-5;

/// Largest joint error at the start of a step that counts as left by an ordinary step. Unit: fraction of the joint's arms
/// (vectors from the centres of mass to the anchors), dimensionless; for angles radians.
///
/// A larger error at a joint with the world or a static or kinematic body shows that the anchor was moved, which does work.
/// Then only a failed step is repeated: see [`FAILED_STEP_ENERGY_ERROR`]. Value chosen; no measured row depends on it from half
/// to twice the value.
pub(crate) const MAX_STEP_JOINT_ERROR: f64 = 0.002;

/// Largest joint error at the start of a step that counts as left by a step in which a chain whips. Unit: fraction of the
/// joint's arms (vectors from the centres of mass to the anchors), dimensionless; for angles radians.
///
/// A larger error between the bodies of an articulation comes from an edit; closing it may cost energy. Value chosen; no measured
/// row depends on it from half to twice the value.
pub(crate) const MAX_WHIP_JOINT_ERROR: f64 = 0.1;

/// Largest factor by which the energy balance scales velocities up. Unit: dimensionless, > 1. Larger energy losses stay, because
/// the step is too coarse for the motion. Energy gains are removed entirely. Value chosen: no measured row changes with twice the
/// value. Half of it is below 1 and damps every motion; even so no measured row changes but that of chain 5.
pub(crate) const MAX_ENERGY_VELOCITY_SCALE: f64 = 1.1;

/// Largest deviation of a body's rotation from its prediction in a substep of a free articulation; a larger one repeats the
/// solve. Unit: radians; [`BALANCED_PREDICTION_SHARE`] of it applies to articulations with an energy balance.
///
/// The position error that stays, as a fraction of the arm from the centre of mass to the anchor, is this value times the angle
/// of rotation. Measured: chains with an energy balance move the same with 0.0015; longer ones take 18 % more time with half
/// the value. No measured row changes with half; from 5/6 to 6/5 of the value only chain 5 does. With twice the value a ball of
/// 10 mass units on a chain of 20 gains 11 % of its energy.
pub(crate) const PREDICTED_ROTATION_ERROR: f64 = 0.01;

/// Fraction of [`PREDICTED_ROTATION_ERROR`] that applies to articulations with an energy balance. Unit: dimensionless, at most
/// 1. Value chosen; its sensitivity is not measured.
pub(crate) const BALANCED_PREDICTION_SHARE: f64 = 0.5;

/// Most repetitions of the solve of a substep of a free articulation after a jump of its geometric stiffness. Unit: number of
/// repetitions.
///
/// It bounds the cost where a chain snaps taut. No measured row depends on it from half to twice the value.
pub(crate) const STIFFNESS_JUMP_RETRIES: usize = 3;

/// Excess of the geometric stiffness over the added stiffness above which the stiffness counts as jumped and the solve of a
/// substep is repeated, as a multiple of the stable stiffness. Unit: dimensionless.
///
/// One multiple is the stable stiffness itself, which an explicit substep integrates; the rest is the tolerance of the added
/// stiffness. Value chosen; its sensitivity is not measured.
pub(crate) const STIFFNESS_JUMP_RATIO: f64 = 2.0;

/// Divisor of the growth of a free articulation's substeps while their number is sought: n grows by n divided by it, at least
/// by 1. Unit: dimensionless, a count.
///
/// Growth by a half needs few trials, and exceeds the necessary number by less than a half. Value chosen; its sensitivity is
/// not measured.
pub(crate) const SUBSTEP_GROWTH_DIVISOR: u32 = 2;

/// Factor of the substeps of a free articulation when its step is repeated for an energy error. Unit: dimensionless, a count.
///
/// The energy error is of second order in the length of a substep: twice as many leave about a quarter of it. Value chosen; its
/// sensitivity is not measured.
pub(crate) const REPEATED_SUBSTEP_FACTOR: u32 = 2;

/// Largest rotation of a body in a substep of a free articulation; faster rotation adds substeps. Unit: radians.
///
/// Position errors of the linearised joints grow with it. No measured row changes with half the value. With twice, four rows of
/// joint scenes change and no verdict: the final speed of a ball of 10 mass units on a chain of 20 halves.
pub(crate) const ROTATION_PER_SUBSTEP: f64 = 0.15;

/// Greatest sine of the rotation of a distance joint in a substep of a free articulation at which its length is exact for the
/// predicted velocity across. Unit: dimensionless, below 1.
///
/// Near 1 the length hardly depends on the velocity along the axis. An undivided substep that turns a rod by 53 degrees is beyond
/// [`ROTATION_PER_SUBSTEP`]. Value chosen; its sensitivity is not measured.
pub(crate) const MAX_ROD_SLOPE: f64 = 0.8;

/// Multiple of the stable limit up to which a free articulation integrates geometric stiffness implicitly. Unit: dimensionless.
/// The stable limit is [`STABLE_STIFFNESS`](super::direct::STABLE_STIFFNESS) times the moment of inertia about the farthest
/// joint. A stiffness above the multiple adds substeps. Fewer substeps cost less. Measured: a swinging chain of 20 loses less
/// than 1 % of its energy in ten seconds. No measured row changes with twice the value, and with half the final speed of a chain
/// of 20 alone.
pub(crate) const IMPLICIT_STIFFNESS_RATIO: f64 = 5.0;

/// Fraction of a small added stiffness that carries momentum in a free articulation. Unit: dimensionless, at most 1. Added
/// stiffness is the excess of the geometric stiffness over the stable limit. A smaller fraction loses energy of rotation, a
/// larger one gains energy in whips: see
/// [`momentum_carrying_stiffness`](crate::joints::substep_plan::momentum_carrying_stiffness). No measured row
/// changes with half or 5/6 of the value. With 1.0 a chain of 20 gains 6.6 % of its energy instead of 0.18 %, and 1 % is
/// accepted: the value is close to its limit.
pub(crate) const MOMENTUM_SHARE_OF_STIFFNESS: f64 = 0.9;

/// Added stiffness at which the fraction [`MOMENTUM_SHARE_OF_STIFFNESS`] has halved, as a multiple of the stable stiffness. Unit:
/// dimensionless. Larger added stiffnesses must lose energy, since they would gain energy otherwise. No measured row changes
/// with twice the value, and with half the final speed of a chain of 20 alone.
pub(crate) const MOMENTUM_SHARE_HALVED_AT: f64 = 8.0;

/// Greatest speed of bodies whose joints the iterative solver solves. Unit: length units/s.
///
/// Joints that contradict each other would accelerate their bodies without bound. The value is that of all bodies in Box2D 3
/// (E. Catto, `maximumLinearSpeed`, 400 m/s). No measured row depends on it from half to twice the value.
pub(crate) const JOINTED_BODY_SPEED: f32 = 400.0;

/// Greatest rotation of bodies whose joints the iterative solver solves in a substep. Unit: radians.
///
/// The value is that of Box2D 3 (`B2_MAX_ROTATION`): 188 radians/s at 240 substeps/s. No measured row depends on twice the
/// value. With half, the final speed of a stretched chain that was let go changes.
pub(crate) const JOINTED_BODY_ROTATION: f32 = std::f32::consts::FRAC_PI_4;

/// Velocity jump that the first solve of a soft row may cause by removing impulse which the direct solver has found. Unit:
/// length units/s.
///
/// A soft row removes a fraction of an exact impulse at once. An impulse that would cause a larger jump is scaled down to this
/// limit before the solve. No measured row changes with twice the value, and two with half: the 20 ragdolls end at 50 instead of
/// 3.4 px/s. That scene is chaotic.
pub(crate) const HANDED_OVER_IMPULSE_LOSS: f32 = 0.25;

/// Addition to the limit [`HANDED_OVER_IMPULSE_LOSS`] per unit of the speed at which a soft row corrects its position error.
/// Unit: dimensionless. It lets rows of the iterative solver at rest lose as much impulse as the correction gives them. Measured:
/// the scene of 20 ragdolls, which is chaotic and awake at its end, ends at 57 px/s with half and 52 with twice the value
/// instead of 3.4. No verdict changes.
pub(crate) const HANDED_OVER_LOSS_PER_CORRECTION: f32 = 4.0;

/// Position error of a joint in the iterative solver from which contacts with static and kinematic bodies hold against it, if a
/// kinematic body drives the joint. Unit: fraction of the largest error that is corrected in proportion.
///
/// Such an error shows a contradiction and no load. Value chosen: 0.02 length units in four substeps of a step of 1/60 s.
pub(crate) const DRIVEN_JOINT_ERROR: f32 = 0.2;

/// Length that converts angular velocities to speeds when velocity errors of joint rows are compared. Unit: length units.
///
/// It is the size of a distance inside of a body. No measured row changes from half to twice the value.
pub(crate) const SOFT_ROW_ARM: f32 = 0.3;

/// Frequency of soft joint rows. Unit: Hz.
///
/// It is twice the frequency of contacts beside joints, as in Box2D 3. At 240 substeps/s [`JOINT_FREQUENCY_PER_RATE`] limits the
/// frequency to 60 Hz as well, so that no measured row depends on twice the value. With half, the joints of 20 ragdolls gape 3.8
/// px instead of 1.3.
pub(crate) const JOINT_FREQUENCY: f64 = 60.0;

/// Greatest frequency of soft joint rows as a fraction of the substep rate. Unit: dimensionless. It keeps soft rows stable in
/// long substeps. The value is twice the fraction of contacts beside joints, as in Box2D 3. Measured: with half, the joints of
/// 20 ragdolls gape 4.7 px instead of 1.3; with twice, the final speed of a stretched chain that was let go changes.
pub(crate) const JOINT_FREQUENCY_PER_RATE: f64 = 0.25;

/// Damping ratio of soft joint rows. Unit: dimensionless. Measured: with 2, bridges come to rest later; with 10, spinning chains
/// stretch more, and a stretched chain that was let go gapes 0.64 px instead of 0.26.
pub(crate) const JOINT_DAMPING_RATIO: f64 = 5.0;

/// Largest angle error that a soft joint row corrects in proportion; larger errors are clamped to it. Unit: radians.
///
/// It bounds the angular velocity of a correction, which has no other bound: 32 radians/s at 240 substeps/s. No measured row
/// depends on twice the value. With half, the final speed of 20 ragdolls changes, which is chaotic.
pub(crate) const SOFT_ROW_ANGLE_ERROR: f64 = 1.0;

/// Smallest pivot in the factorisation of the 3x3 effective mass of a joint, as a fraction of the diagonal element.
/// Unit: dimensionless. A smaller pivot is rounding: the row depends linearly on the rows before it, and gets no impulse. The
/// angle of a weld whose anchor is 10,000 times as far away as its bodies reach has the pivot 1e-8. No measured row depends on
/// the value from half to twice.
pub(crate) const BLOCK_PIVOT_FLOOR: f64 = 1e-12;

/// Damping of a motor joint that is dry friction, as a multiple of the effective mass of its rows. Unit: 1/s.
///
/// A body that friction holds under a load of acceleration a creeps with the velocity a / rate: 1e-6 px/s under 1,000 px/s^2. That is
/// below the rounding of positions in f32. With 1e12, ten digits of a row at 240 Hz would be lost in the sum 1 + rate dt.
pub(crate) const DRY_FRICTION_RATE: f64 = 1e9;
