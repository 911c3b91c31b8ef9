//! Parameters of the narrow phase: manifolds, contact recycling, ghost filters, continuous collision and one-way geoms.
//!
//! Limits of angles are given as cosines or sines where the code compares scalar or cross products of unit vectors.

/// Advantage in separation that an edge of B needs over one of A to become the reference edge, as a fraction of the speculative
/// distance, dimensionless. Without it the reference edge alternates between A and B from step to step. Value chosen; its
/// sensitivity is not measured. Unit: dimensionless.
pub(crate) const REFERENCE_EDGE_HYSTERESIS: f32 = 0.025;

/// Smallest cosine of the angle between an edge normal and the line through the closest vertices of two cores for an edge
/// contact, dimensionless. Above it a capsule gets the two contact points of the edge, below it one point between the vertices.
/// Value chosen; its sensitivity is not measured. Unit:  dimensionless, a cosine.
pub(crate) const CAPSULE_EDGE_MIN_COS: f32 = 0.9999;

/// Largest sine of the angle between two edge normals at a vertex that counts as straight, dimensionless. A straight vertex
/// admits no contact normals but those of its two edges. Value chosen; its sensitivity is not measured. Unit: dimensionless.
pub(crate) const STRAIGHT_VERTEX_MAX_SIN: f32 = 1e-3;

/// Sine of the angle by which a contact normal may leave the Voronoi region of a vertex without being skipped, dimensionless.
/// It absorbs rounding. Source: `sinTol` of `b2ClassifyNormal` in Box2D's `manifold.c` (E. Catto). Unit: dimensionless.
pub(crate) const VORONOI_TOLERANCE_SIN: f32 = 0.01;

/// Largest penetration behind an edge to which the ghost filter moves ("snaps") a contact, as a multiple of the penetration
/// along the old normal, dimensionless. The value, 1 / cos 60 degrees, allows angles of up to 60 degrees between both normals.
/// Unit: dimensionless.
pub(crate) const SNAP_MAX_PENETRATION_RATIO: f32 = 2.0;

/// Largest gap, offset or step between two faces that count as flush, in length units. It is half a px for a length unit of 32
/// px. Value chosen; its sensitivity is not measured. Unit: length units.
pub(crate) const FLUSH_FACE_MAX_STEP: f32 = 1.0 / 64.0;

/// Largest penetration of a contact that the ghost filter between geoms may remove, in length units. Contacts under load
/// penetrate less. A body that is deeper in a tile was placed there by the game, and every tile resolves its penetration. Unit:
/// length units.
pub(crate) const GHOST_MAX_PENETRATION: f32 = 0.1;

/// Sine of the angle by which a contact normal may lie outside of a normal cone and still count as inside, dimensionless. It
/// absorbs rounding. Value chosen; its sensitivity is not measured. Unit: dimensionless.
pub(crate) const NORMAL_CONE_TOLERANCE_SIN: f32 = 1e-3;

/// Largest sine of the angle between a contact normal and a face normal for which the contact belongs to that face,
/// dimensionless. Value chosen; its sensitivity is not measured. Unit: dimensionless.
pub(crate) const FACE_NORMAL_MAX_SIN: f32 = 0.01;

/// Upper bound of the cosine between the contact normal of a round shape at a rim and the normal of the face that supports the
/// shape, dimensionless. At larger cosines the contact is one with the face itself, and the rim filter keeps it. Value chosen;
/// its sensitivity is not measured. Unit: dimensionless, a cosine.
pub(crate) const RIM_NORMAL_MAX_COS: f32 = 0.999_99;

/// Cosine of the largest rotation of a body since its manifold was computed, up to which contact recycling keeps the manifold,
/// dimensionless. Beyond 11.5 degrees the manifold is computed again. Source: Box2D 3.2 (E. Catto,
/// `B2_CONTACT_RECYCLE_COS_ANGLE`). Unit: dimensionless, a cosine.
pub(crate) const RECYCLE_MAX_ANGLE_COS: f32 = 0.98;

/// Cosine of the largest rotation of a kinematic body A for contact recycling, dimensionless, a cosine: 0.36 degrees. It
/// replaces [`RECYCLE_MAX_ANGLE_COS`], because the normal of a contact with a turntable would lag behind. Value chosen; its
/// sensitivity is not measured. Unit: dimensionless, a cosine.
pub(crate) const RECYCLE_KINEMATIC_MAX_ANGLE_COS: f32 = 0.99998;

/// Largest estimated error of a recycled separation, in length units. The estimate is the relative motion of the pair times the
/// sine of the rotation since the manifold was computed. Value chosen; its sensitivity is not measured. Unit: length units.
pub(crate) const RECYCLE_MAX_SEPARATION_ERROR: f32 = 3e-4;

/// Rotation per step, in radians, above which a polygon on a static body counts as rolling fast. The manifold of the polygon is
/// then computed in every step and updated in every substep, because the vertices land one after the other. Value chosen; its
/// sensitivity is not measured. Unit: radians.
pub(crate) const ROLLING_MIN_ANGLE_PER_STEP: f32 = 0.01;

/// Largest angle, in radians, by which the vectors from a rolling body B to its contact points are rotated ahead of the pose of
/// B: see `CachedManifold::arm_lead_angle`. Value chosen; its sensitivity is not measured. Unit: radians.
pub(crate) const ARM_LEAD_MAX_ANGLE: f32 = 0.2;

/// Largest distance between a new contact point and the old point whose impulses it inherits, dimensionless: a fraction of the
/// smaller extent of both shapes. The extent is the largest distance of a surface from the origin of its body. Larger distances
/// would warm start unrelated points. Value chosen; its sensitivity is not measured. Unit:  dimensionless.
pub(crate) const WARM_START_MAX_DISTANCE_RATIO: f32 = 0.4;

/// Penetration of a body at its time of impact, as a fraction of the speculative distance, dimensionless. The body stops a
/// little behind the surface, so that the next narrow phase finds the contact. Value chosen; its sensitivity is not measured.
/// Unit:  dimensionless.
pub(crate) const TOI_PENETRATION_RATIO: f32 = 0.5;

/// Largest displacement per step for which continuous collision examines a body, in the unit of coordinates. Squares of much
/// larger numbers overflow an `f32`. Unit: the length unit of coordinates.
pub(crate) const CCD_MAX_COORDINATE: f32 = 1e18;

/// Tolerance of the separation at the time of impact, as a fraction of the speculative distance, dimensionless. The iteration
/// for the time of impact ends within it. Value chosen; its sensitivity is not measured. Unit: dimensionless.
pub(crate) const TOI_TOLERANCE_RATIO: f32 = 0.1;

/// Largest number of iterations of conservative advancement for a time of impact. After them the result is a time before the
/// impact, so a body stops short of the other one. Value chosen; its sensitivity is not measured. Unit: dimensionless, a count.
pub(crate) const TOI_MAX_ITERATIONS: usize = 32;

/// Smallest cosine of the angle between a face normal and the direction of free passage for which a one-way geom stops bodies
/// with that face, dimensionless: 60 degrees. Value chosen; its sensitivity is not measured. Unit: dimensionless, a cosine.
pub(crate) const ONE_WAY_MIN_COS: f32 = 0.5;
