//! Parameters of contact constraints: detection distances, soft constraints, load adaptation, restitution, and polygons that
//! roll.
//!
//! The constants are read by [`Parameters`](crate::scaled_parameters::Parameters) and `StepContext`, which convert
//! them to the user's units and to the step, and by `contact_solver/` and `integration.rs`.

/// Speculative distance: shapes with a separation below this distance get contact points before they touch. Unit: length units.
/// Fast shapes would otherwise penetrate before they have a contact. Box2D 3 (E. Catto, `B2_SPECULATIVE_DISTANCE`, four linear
/// slops of 0.005 m).
pub(crate) const SPECULATIVE_DISTANCE: f32 = 0.02;

/// Greatest relative motion of a pair with which the narrow phase recycles its manifold. Unit: length units. Manifolds that are
/// computed anew in every step make tall stacks jitter. Box2D 3 (`B2_CONTACT_RECYCLE_DISTANCE`, ten linear slops of 0.005 m).
pub(crate) const RECYCLING_DISTANCE: f32 = 0.05;

/// Motion of the two bodies of a pair after which the narrow phase updates its separations. Unit: length units. Pairs that move
/// less cost nothing. Value chosen; its sensitivity is not measured.
pub(crate) const SEPARATION_REFRESH_DISTANCE: f32 = 0.003;

/// Relative speed of two bodies at a contact from which on load adaptation does not raise the rest impulse of the contact.
/// Unit: length units/s. Load adaptation of a contact in motion would add energy. Value chosen; its sensitivity is not
/// measured.
pub(crate) const LOAD_ADAPTATION_MAX_SPEED: f32 = 0.05;

/// Greatest bias velocity with which a soft contact resolves penetration. Unit: length units/s. Bodies that overlap deeply
/// would otherwise be thrown apart. Box2D 3 (`contactSpeed`, 3 m/s).
pub(crate) const PENETRATION_RECOVERY_MAX_SPEED: f32 = 3.0;

/// Restitution threshold: impacts at a lower approach speed are inelastic. Unit: length units/s. Without a threshold, bodies at
/// rest would bounce under their weight. Box2D 3 (`restitutionThreshold`, 1 m/s).
pub(crate) const RESTITUTION_THRESHOLD: f32 = 1.0;

/// Frequency of the soft contact constraint. Unit: Hz. At a higher one boxes that stand face to face do not come to rest. At a
/// lower one piles of thousands of bodies oscillate for seconds. Box2D 3 has 30 Hz instead. Value chosen; its sensitivity is
/// not measured.
pub(crate) const CONTACT_FREQUENCY: f32 = 45.0;

/// Damping ratio of the soft contact constraint: overdamped, so that penetration is resolved without a rebound. Unit:
/// dimensionless. Box2D 3 (`contactDampingRatio`).
pub(crate) const CONTACT_DAMPING_RATIO: f32 = 10.0;

/// Least period of the soft contact constraint, counted in substeps. Unit: dimensionless, substeps. It limits the frequency to
/// 1 / (5 h) for substeps of h seconds. Box2D 3 has 8 substeps instead. Value chosen; its sensitivity is not measured.
pub(crate) const SUBSTEPS_PER_CONTACT_PERIOD: f32 = 5.0;

/// Penetration above which a contact with a static or kinematic body prevails over joints with large position errors, as a
/// fraction of the least distance from the middle of the body to its surface. Unit: dimensionless, below 1. It is at most the
/// speculative distance, [`SPECULATIVE_DISTANCE`].
///
/// Derived: a body whose middle has passed a face is pushed out at the far side. Half of the distance leaves as much again for
/// the motion of one step, above which continuous collision stops the body.
pub(crate) const HELD_DEPTH_PER_EXTENT: f32 = 0.5;

/// Gauss-Seidel sweeps over the two points of a contact that prevails over joints. Unit: dimensionless, a count. Each sweep
/// leaves k12^2 / (k11 k22) of the error, a quarter for a long beam: eight leave 1.5e-5.
pub(crate) const HELD_CONTACT_SWEEPS: usize = 8;

/// Frequency of the contacts of bodies that have joints in the iterative solver. Unit: Hz. Stiffer contacts prevail over
/// joints, which then have gaps: in piles of ragdolls the gaps are 3.1 px with [`CONTACT_FREQUENCY`], 1.3 px with this
/// frequency. Box2D 3 has 30 Hz for all contacts.
pub(crate) const JOINTED_CONTACT_FREQUENCY: f32 = 30.0;

/// Upper limit of [`JOINTED_CONTACT_FREQUENCY`] as a fraction of the substep rate 1 / h. Unit: dimensionless. An eighth is
/// Box2D 3's limit for all contacts.
pub(crate) const JOINTED_CONTACT_FREQUENCY_PER_RATE: f32 = 0.125;

/// Load adaptation: fraction of the difference between normal impulse and rest impulse by which the rest impulse rises in 1/60
/// s. Unit: dimensionless, at most 1. A rising rest impulse lifts a pile and lags behind the load, which keeps the pile in
/// motion: so the fraction is small. Value chosen; its sensitivity is not measured.
pub(crate) const LOAD_RISE_PER_STEP: f32 = 0.02;

/// Load adaptation: fraction of the excess of the rest impulse over the normal impulse by which the rest impulse falls in 1/60
/// s. Unit: dimensionless, at most 1. Value chosen; its sensitivity is not measured.
pub(crate) const LOAD_FALL_PER_STEP: f32 = 0.05;

/// Load adaptation: fraction of the load of a contact, the sum of its normal impulses, that the soft constraint carries by
/// penetration. The rest impulses rise up to 1 minus this fraction of the load. Unit: dimensionless, at most 1. The penetration
/// keeps contacts deep in a pile closed. Value chosen; its sensitivity is not measured.
pub(crate) const LOAD_ON_SPRING_FRACTION: f32 = 0.6;

/// Greatest penetration that counts as sag of a soft contact under load. Unit: length units. Load adaptation excludes deeper
/// contacts: a body that is wedged in another one would be pressed ever harder. Value chosen; its sensitivity is not measured.
pub(crate) const GREATEST_SAG: f32 = 0.1;

/// Least relative determinant 1 - k12^2 / (k11 k22) with which the block solver takes the two points of a manifold. Unit:
/// dimensionless. Here k is the 2x2 matrix J M^-1 J^T of both normal rows. Below the limit the matrix is ill-conditioned, and
/// the points are solved one after the other. Value chosen; its sensitivity is not measured.
pub(crate) const BLOCK_MIN_RELATIVE_DETERMINANT: f32 = 0.02;

/// Greatest velocity change of a body in a step for the midpoint correction of its path, as a multiple of the change by forces
/// alone. Unit: dimensionless. A greater velocity change comes from an impact, for which the correction is wrong. Value chosen;
/// its sensitivity is not measured.
pub(crate) const MIDPOINT_MAX_VELOCITY_CHANGE: f32 = 2.0;

/// Greatest deviation with which an impact counts as central, that is, passes through both centres of mass. It limits the
/// relative difference of the points' approach velocities, and the arm of the impact relative to the radius of gyration. Unit:
/// dimensionless. Only central impacts have a closed form. Value chosen; its sensitivity is not measured.
pub(crate) const CENTRAL_IMPACT_TOLERANCE: f32 = 1e-3;

/// Most Gauss-Seidel sweeps over contacts and joints for the velocities after an impact. Unit: dimensionless, a count. Of two
/// welded bodies let one have a quarter of the other's mass. If the light one is hit, each sweep leaves 4 / 5 of the error, and
/// 32 sweeps a thousandth; if the heavy one is hit, each sweep leaves 1 / 5.
pub(crate) const JOINTED_RESTITUTION_MAX_SWEEPS: usize = 32;

/// Velocity error of joints at which the sweeps of [`JOINTED_RESTITUTION_MAX_SWEEPS`] end early, as a fraction of the
/// restitution threshold. Unit: dimensionless. Value chosen; its sensitivity is not measured.
pub(crate) const JOINTED_RESTITUTION_TOLERANCE: f32 = 1e-3;

/// Greatest number of vertex impacts of a pivoting polygon in a step; with more impacts the iterative solver takes the polygon.
/// Unit: dimensionless, a count. A polygon with more impacts rotates by several vertices in every substep. Value chosen; its
/// sensitivity is not measured.
pub(crate) const PIVOT_MAX_IMPACTS_PER_STEP: usize = 64;

/// Greatest speed of the pivot vertex over the face as a fraction of the speed of the centre of mass. Unit: dimensionless. A
/// larger fraction is sliding or a take-off. A smaller one is the velocity error of the iterative solver. The removal of this
/// error loses energy in proportion to the square of the error. The value is also the greatest angle, in radians, by which the
/// next vertex may already be below the face. Value chosen; its sensitivity is not measured.
pub(crate) const PIVOT_MAX_SLIP: f32 = 0.05;

/// Least time that a pivoting polygon integrates after an impact, as a fraction of the step. Unit: dimensionless. A shorter time
/// left over is a rounding error. Value chosen; its sensitivity is not measured.
pub(crate) const PIVOT_MIN_TIME: f32 = 1e-4;

/// Greatest distance of the lowest vertex from the plane with which a polygon pivots, as a fraction of the speculative
/// distance. Unit: dimensionless. The distance is 0.005 length units, Box2D's linear slop: the speculative distance is four
/// linear slops.
pub(crate) const PIVOT_MAX_PENETRATION: f32 = 0.25;

/// Greatest deviation between two static faces that a pivoting polygon treats as one plane: difference in height, and sine of
/// the angle. Unit: length units in height, and dimensionless as the sine of the angle. Value chosen; its sensitivity is not
/// measured.
pub(crate) const PIVOT_PLANE_TOLERANCE: f32 = 1e-3;

/// Greatest distance along the face between a manifold point and a vertex of the rolling polygon, as a fraction of the greatest
/// distance of the polygon's surface from its origin. Unit: dimensionless. Points that clipping moved to the end of a face lie
/// farther from the vertex. Value chosen; its sensitivity is not measured.
pub(crate) const ROLLING_VERTEX_TOLERANCE: f32 = 1e-3;
