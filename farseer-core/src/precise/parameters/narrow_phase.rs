//! Narrow phase: manifolds, contact recycling, ghost collisions, continuous collision and one-way surfaces.

/// Least advantage of another reference edge, as a fraction of the speculative distance. Unit: dimensionless. Prevents alternating
/// edges.
pub(in crate::precise) const REFERENCE_EDGE_HYSTERESIS: f32 = 0.025;

/// Least cosine between the line that joins two corners and an edge's normal with which the corners lie on that edge. Unit:
/// dimensionless, a cosine.
pub(in crate::precise) const CAPSULE_EDGE_COSINE: f32 = 0.9999;

/// Sine of the angle below which an outline is straight at a corner. Unit: dimensionless.
pub(in crate::precise) const STRAIGHT_CORNER_SINE: f32 = 1e-3;

/// Sine of the angle by which a normal may leave a neighbour's Voronoi cone, for rounding. Unit: dimensionless. `sinTol` of Box2D's
/// `b2ClassifyNormal`.
pub(in crate::precise) const EDGE_NORMAL_SLACK: f32 = 0.01;

/// Greatest penetration behind an edge that a normal is snapped to, as a multiple of that along the normal. Unit: dimensionless. That
/// of an edge at an angle of 60 degrees: 1 / cos 60 degrees.
pub(in crate::precise) const SNAPPED_PENETRATION_RATIO: f32 = 2.0;

/// Largest gap, offset or step between flush faces. Unit: length units. Half a px where the length unit is 32 px.
pub(in crate::precise) const FLUSH_FACE_STEP: f32 = 1.0 / 64.0;

/// Deepest penetration that may be a ghost collision. Unit: length units. The sag of a contact under its load is less. A body that is
/// deeper in a tile was put there, and is pushed out by every tile.
pub(in crate::precise) const GHOST_PENETRATION: f32 = 0.1;

/// Sine of the angle by which a normal may leave a normal cone, for rounding. Unit: dimensionless.
pub(in crate::precise) const NORMAL_CONE_SLACK: f32 = 1e-3;

/// Sine of the angle up to which a contact normal is that of a face. Unit: dimensionless.
pub(in crate::precise) const FACE_NORMAL_SINE: f32 = 0.01;

/// Least cosine between two normals that count as equal at the rims of faces. Unit: dimensionless, a cosine.
pub(in crate::precise) const RIM_NORMAL_COSINE: f32 = 0.999_99;

/// Cosine of the greatest relative rotation of a recycled manifold. Unit: dimensionless, a cosine. 11.5 degrees, Box2D 3
/// (`B2_CONTACT_RECYCLE_COS_ANGLE`).
pub(in crate::precise) const RECYCLING_COSINE: f32 = 0.98;

/// The same for a kinematic body A. Unit: dimensionless, a cosine. 0.36 degrees: the normal of a contact with a turntable follows it.
pub(in crate::precise) const KINEMATIC_RECYCLING_COSINE: f32 = 0.99998;

/// Largest error of a recycled separation: relative translation times the sine of the relative rotation since. Unit: length units.
pub(in crate::precise) const RECYCLED_SEPARATION_ERROR: f32 = 3e-4;

/// Rotation in a step from which on a polygon on a static body has its manifold computed in every step. Unit: radians. It rolls or topples:
/// corners land one after the other.
pub(in crate::precise) const ROLLING_ROTATION: f32 = 0.01;

/// Largest angle by which contact arms are rotated ahead of the pose. Unit: radians.
pub(in crate::precise) const ARM_LEAD_ANGLE: f32 = 0.2;

/// Largest distance between a new point and an old anchor whose impulses it inherits, as a fraction of the smaller body's reach. Unit:
/// dimensionless.
pub(in crate::precise) const WARM_START_DISTANCE: f32 = 0.4;

/// Penetration at the time of impact, as a fraction of the speculative distance: enough that the next step finds the contact. Unit:
/// dimensionless.
pub(in crate::precise) const IMPACT_PENETRATION: f32 = 0.5;

/// Motions and coordinates beyond this length have squares that are not finite. Unit: that of coordinates.
pub(in crate::precise) const CONTINUOUS_COLLISION_RANGE: f32 = 1e18;

/// Tolerance of the time of impact, as a fraction of the speculative distance. Unit: dimensionless.
pub(in crate::precise) const IMPACT_TOLERANCE: f32 = 0.1;

/// Most advances of conservative advancement; a body stops short after them. Unit: dimensionless, a count.
pub(in crate::precise) const IMPACT_ADVANCES: usize = 32;

/// Least cosine between the open direction and the normal of a side that stops. Unit: dimensionless, a cosine. 60 degrees.
pub(in crate::precise) const ONE_WAY_COSINE: f32 = 0.5;
