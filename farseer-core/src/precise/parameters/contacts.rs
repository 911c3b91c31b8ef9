//! Contact constraints: softness, load adaptation, restitution, rolling, and the integration of positions.

/// Speculative distance: nearer shapes have contact points. Unit: length units. Box2D 3 (E. Catto, `B2_SPECULATIVE_DISTANCE`, four
/// linear slops of 0.005 m).
pub(in crate::precise) const SPECULATIVE_DISTANCE: f32 = 0.02;

/// Relative motion of a pair below which its manifold is recycled. Unit: length units. Box2D 3 (`B2_CONTACT_RECYCLE_DISTANCE`, ten
/// linear slops).
pub(in crate::precise) const RECYCLING_DISTANCE: f32 = 0.05;

/// Motion of a body after which the separations of its contacts are computed again. Unit: length units.
pub(in crate::precise) const SEPARATION_REFRESH_DISTANCE: f32 = 0.003;

/// Relative speed at a contact from which on its spring does not adapt to its load. Unit: length units/s.
pub(in crate::precise) const LOAD_ADAPTATION_SPEED: f32 = 0.05;

/// Greatest speed at which penetration is resolved. Unit: length units/s. Box2D 3 (`contactSpeed`, 3 m/s).
pub(in crate::precise) const PENETRATION_RECOVERY_SPEED: f32 = 3.0;

/// Restitution threshold: slower approaches do not bounce. Unit: length units/s. Box2D 3 (`restitutionThreshold`, 1 m/s).
pub(in crate::precise) const RESTITUTION_THRESHOLD: f32 = 1.0;

/// Frequency of the soft contact constraint. Unit: Hz. With a stiffer one boxes that stand face to face do not come to rest, with a
/// softer one piles of thousands oscillate for seconds. 30 Hz in Box2D 3.
pub(in crate::precise) const CONTACT_FREQUENCY: f32 = 45.0;

/// Damping ratio of the soft contact constraint. Unit: dimensionless. Box2D 3 (`contactDampingRatio`).
pub(in crate::precise) const CONTACT_DAMPING_RATIO: f32 = 10.0;

/// Fewest substeps in a period of the soft contact constraint: limits its frequency. Unit: dimensionless, substeps. 8 in Box2D 3.
pub(in crate::precise) const SUBSTEPS_PER_CONTACT_PERIOD: f32 = 5.0;

/// Frequency of contacts of bodies with joints in the iterative solver. Unit: Hz. That of all contacts in Box2D 3. Stiffer contacts win
/// against joints, which then gape: in piles of ragdolls by 3.1 px instead of 1.3 with the frequency of other contacts.
pub(in crate::precise) const JOINTED_CONTACT_FREQUENCY: f32 = 30.0;

/// Greatest frequency of such contacts as a fraction of the substep rate. Unit: dimensionless. That of all contacts in Box2D 3.
pub(in crate::precise) const JOINTED_CONTACT_FREQUENCY_PER_RATE: f32 = 0.125;

/// Part of the difference by which a contact spring's rest impulse rises towards its load in 1/60 s. Unit: dimensionless, at most 1.
/// Adaptation lifts a pile, and lags behind its load, which keeps it in motion: so it is slow.
pub(in crate::precise) const LOAD_RISE_PER_STEP: f32 = 0.02;

/// Part of the difference by which it falls in 1/60 s. Unit: dimensionless, at most 1.
pub(in crate::precise) const LOAD_FALL_PER_STEP: f32 = 0.05;

/// Part of the load that is left on the spring. Unit: dimensionless, at most 1.
pub(in crate::precise) const LOAD_LEFT_ON_SPRING: f32 = 0.6;

/// Greatest penetration that counts as sag under load. Unit: length units.
pub(in crate::precise) const GREATEST_SAG: f32 = 0.1;

/// Least value of 1 - (coupling times effective mass)^2 with which the two points of a manifold are solved as a block. Unit:
/// dimensionless. Below it the block is ill-conditioned, and the points are solved one after the other.
pub(in crate::precise) const BLOCK_CONDITION: f32 = 0.02;

/// Greatest change of velocity of a body without contact impulses, as a multiple of that by its forces, with which it moves in a
/// closed-form arc. Unit: dimensionless.
pub(in crate::precise) const BALLISTIC_VELOCITY_CHANGE: f32 = 2.0;

/// Greatest relative difference between the points of a central bounce. Unit: dimensionless.
pub(in crate::precise) const CENTRAL_BOUNCE_DIFFERENCE: f32 = 1e-3;

/// Most passes over contacts and joints for the velocities after an impact. Unit: dimensionless, a count. With a body that is welded on one
/// of a quarter of its mass each pass leaves 4 / 5 of the error: a thousandth after all.
pub(in crate::precise) const JOINTED_RESTITUTION_PASSES: usize = 32;

/// Velocity error of joints at which these passes end, as a fraction of the restitution threshold. Unit: dimensionless.
pub(in crate::precise) const JOINTED_RESTITUTION_ERROR: f32 = 1e-3;

/// Most corner impacts of a pivoting polygon in a step. Unit: dimensionless, a count. A polygon with more of them turns by several
/// corners in every substep.
pub(in crate::precise) const PIVOT_IMPACTS_PER_STEP: usize = 64;

/// Greatest speed of the pivot over the face as a fraction of the speed of the centre of mass. Unit: dimensionless. A larger one is
/// slip or a hop; a smaller one is the velocity error of the iterative solver, and its square is lost as energy.
pub(in crate::precise) const PIVOT_SLIP: f32 = 0.05;

/// Least fraction of a substep that is integrated; less is rounding. Unit: dimensionless.
pub(in crate::precise) const PIVOT_LEAST_SUBSTEP: f32 = 1e-4;

/// Penetration from which on a polygon is lifted before it pivots, as a fraction of the speculative distance. Unit: dimensionless.
/// 0.005 length units, the slop of Box2D, of which the speculative distance is four.
pub(in crate::precise) const PIVOT_PENETRATION: f32 = 0.25;

/// Greatest difference between the planes of two static faces that a polygon rolls over as one. Unit: length units in height, and
/// dimensionless as the sine of the angle.
pub(in crate::precise) const PIVOT_PLANE_DIFFERENCE: f32 = 1e-3;

/// Greatest distance between a manifold point and a corner of the rolling polygon, as a fraction of the polygon's reach. Unit:
/// dimensionless. Clipping at the end of the face moves points farther.
pub(in crate::precise) const ROLLING_POINT_DISTANCE: f32 = 1e-3;
