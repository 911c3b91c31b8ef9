//! Joints in the plane: articulated trees, and the soft rows of the iterative solver.

/// Greatest speed at which position errors of articulations are corrected. Unit: length units/s, and radians/s. That of contacts
/// ([`PENETRATION_RECOVERY_SPEED`](super::contacts::PENETRATION_RECOVERY_SPEED)): bodies of other joints keep a part of it, and light
/// ones between heavy ones a multiple.
/// No measured row changes from half to twice of it.
pub(in crate::precise) const JOINT_CORRECTION_SPEED: f64 = 3.0;

/// Most bodies of an articulation whose energy is balanced, in at least two parts and with half kicks at both ends. Unit: dimensionless, a
/// count. A balanced chain of 20 takes 1.7 times as long, more than Box2D's; chains of 12 and fewer won up to 50 % of their energy without.
pub(in crate::precise) const BALANCED_ARTICULATION_BODIES: u32 = 12;

/// Bodies beyond which an articulation is large, and may be stiffer than a part bears. Unit: dimensionless, a count.
/// No measured row depends on it from half to twice.
pub(in crate::precise) const LARGE_ARTICULATION_BODIES: u32 = 50;

/// Least parts of a step of a balanced articulation. Unit: dimensionless, a count. Pendulums of one to three links are three times as
/// far from where fine steps take them with 1 as with 2.
pub(in crate::precise) const LEAST_ARTICULATION_PARTS: u32 = 2;

/// The same, up to [`BALANCED_ARTICULATION_BODIES`], where the direct solver solves the parts, which projects no energy. Unit: dimensionless,
/// a count. A double pendulum with limits keeps its energy within 1 % at 60 steps/s.
pub(in crate::precise) const LEAST_DIRECT_PARTS: u32 = 3;

/// Most parts that a substep of an articulation is divided into. Unit: dimensionless, a count.
pub(in crate::precise) const ARTICULATION_SUBSTEP_PARTS: u32 = 2;

/// The same of a step that is repeated. Unit: dimensionless, a count. Chains of 12 at 30 steps/s need it where they whip.
pub(in crate::precise) const REPEATED_SUBSTEP_PARTS: u32 = 4;

/// Error of the energy after a step, as a fraction of the kinetic energy and of the work of forces, beyond which the step is repeated in more
/// parts. Unit: dimensionless. Energies and times of chains are the same from 0.005 to 0.02.
pub(in crate::precise) const ENERGY_ERROR_OF_A_STEP: f64 = 0.01;

/// Energy that joints may take from velocities which do not obey them when a step begins, as a fraction of the same, up to which losses of the
/// step are errors. Unit: dimensionless. A step leaves 1e-9, by rounding; a push leaves more.
pub(in crate::precise) const ENERGY_ERROR_LEFT: f64 = 1e-4;

/// Greatest error of a rounded position as a fraction of its coordinates: that of both bodies of a joint. Unit: dimensionless. Four units in the
/// last place of an `f32`.
pub(in crate::precise) const POSITION_ROUNDING: f64 = 2.5e-7;

/// Greatest error of a rounded rotation of up to a hundred turns. Unit: radians.
pub(in crate::precise) const ARM_ROUNDING: f64 = 3e-5;

/// Greatest error of a joint that an ordinary step leaves, as a fraction of its arms or in radians. Unit: dimensionless. Where the joint with
/// what is fixed has a greater one, that may have been moved, and does work.
pub(in crate::precise) const GAP_OF_A_STEP: f64 = 0.002;

/// The same of a step in which a chain whips. Unit: dimensionless. Between bodies that swing a greater one comes of an edit.
pub(in crate::precise) const GAP_OF_A_WHIP: f64 = 0.1;

/// Greatest factor by which velocities are scaled to return energy that a step lost. Unit: dimensionless. Greater losses stay: they are those
/// of a step that is too coarse for the motion. Gains are taken back entirely.
pub(in crate::precise) const VELOCITY_SCALE: f64 = 1.1;

/// Greatest deviation of a body's rotation from the predicted one in a part of a step. Unit: radians. Half of it in balanced articulations. The
/// position error that stays, as a fraction of an arm, is this times the angle of rotation. Balanced chains go the same way with 0.0015;
/// longer ones take 18 % more time with half of it.
pub(in crate::precise) const PREDICTED_ROTATION_ERROR: f64 = 0.01;

/// Most repetitions of a part of a step because stiffness has jumped. Unit: dimensionless, a count.
/// No measured row depends on it from half to twice.
pub(in crate::precise) const STIFFNESS_JUMP_RETRIES: usize = 3;

/// Greatest rotation of a body in a part of a step. Unit: radians.
pub(in crate::precise) const ROTATION_PER_PART: f64 = 0.15;

/// Multiple of [`STABLE_STIFFNESS`](super::direct::STABLE_STIFFNESS) up to which geometric stiffness is integrated implicitly instead of dividing the
/// substep. Unit: dimensionless. Fewer parts cost less. A swinging chain of 20 loses less than 1 % of its energy in ten seconds.
pub(in crate::precise) const IMPLICIT_STIFFNESS_RATIO: f64 = 5.0;

/// Part of a small geometric stiffness that conserves momentum. Unit: dimensionless, at most 1.
pub(in crate::precise) const MOMENTUM_SHARE_OF_STIFFNESS: f64 = 0.9;

/// Multiple of the stable stiffness at which half of that part conserves momentum. Unit: dimensionless.
pub(in crate::precise) const MOMENTUM_SHARE_HALVED_AT: f64 = 8.0;

/// Greatest speed of bodies with joints in the iterative solver. Unit: length units/s. That of all bodies in Box2D 3
/// (E. Catto, `maximumLinearSpeed`, 400 m/s).
/// No measured row depends on it from half to twice.
pub(in crate::precise) const JOINTED_BODY_SPEED: f32 = 400.0;

/// Greatest rotation of such a body in a substep. Unit: radians. As in Box2D 3 (`B2_MAX_ROTATION`): 188 radians/s at
/// 240 substeps/s.
pub(in crate::precise) const JOINTED_BODY_ROTATION: f32 = std::f32::consts::FRAC_PI_4;

/// Speed up to which the first pass of a soft row may reduce an impulse that another solver has found exactly. Unit: length
/// units/s.
pub(in crate::precise) const HANDED_OVER_IMPULSE_LOSS: f32 = 0.25;

/// The same as a multiple of the speed at which the row corrects its error. Unit: dimensionless. Rows of the iterative solver at
/// rest lose as much as they correct.
pub(in crate::precise) const HANDED_OVER_LOSS_PER_CORRECTION: f32 = 4.0;

/// Arm that turns angular velocity into a velocity where velocity errors of the iterative solver are compared. Unit: length units. An
/// arm inside of a body.
/// No measured row changes from half to twice of it.
pub(in crate::precise) const SOFT_ROW_ARM: f32 = 0.3;

/// Frequency of soft joint rows. Unit: Hz. 90 and 120 Hz at 240 substeps/s gain energy in cantilevers and nets. Twice that of contacts
/// beside joints, as in Box2D 3.
pub(in crate::precise) const JOINT_FREQUENCY: f64 = 60.0;

/// Greatest frequency of soft joint rows as a fraction of the substep rate. Unit: dimensionless. Twice that of contacts beside
/// joints, as in Box2D 3.
pub(in crate::precise) const JOINT_FREQUENCY_PER_RATE: f64 = 0.25;

/// Damping ratio of soft joint rows. Unit: dimensionless. Bridges come to rest later with 2, chains that spin stretch more with 10.
pub(in crate::precise) const JOINT_DAMPING_RATIO: f64 = 5.0;

/// Greatest angle error that a soft row corrects in proportion. Unit: radians. 32 radians/s at 240 substeps/s: speeds of bodies have a bound,
/// angular velocities have none.
pub(in crate::precise) const SOFT_ROW_ANGLE_ERROR: f64 = 1.0;

/// Least pivot of a block as a fraction of its diagonal element; a smaller one is rounding, and its row, which depends on the rows before it,
/// gets no impulse. Unit: dimensionless. The pivot of the angle of a weld whose anchor is 10,000 times as far as its bodies reach
/// is 1e-8.
/// No measured row depends on it from half to twice.
pub(in crate::precise) const BLOCK_PIVOT_FLOOR: f64 = 1e-12;
