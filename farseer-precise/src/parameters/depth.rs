//! Parameters of the precise set in three axes: prisms, spheres, vertical shapes and world boxes.
//!
//! "Length units" here are multiples of the length unit of the simulator (`Methods::Precise`), unless the comment says
//! otherwise.

/// Largest displacement of a world box in one step for which the box is swept, in length units, > 0. A longer displacement is a
/// teleport and gets no swept pairs. Value chosen; its sensitivity is not measured. Unit: length units.
pub(crate) const WORLD_BOX_MAX_SWEEP: f32 = 4.0;

/// Capacity of the footprint polygon of a vertical shape, number of vertices. The outline from above of a box cut at two
/// heights has fewer. Unit: dimensionless, a count.
pub(crate) const FOOTPRINT_CORNERS: usize = 16;

/// Largest slope, rise by run, of a polygon edge that counts as perpendicular to a direction. Dimensionless, >= 0. Such an edge
/// touches along its whole length; a steeper edge touches with a vertex. Value chosen; its sensitivity is not measured. Unit:
/// dimensionless.
pub(crate) const LEVEL_EDGE_MAX_SLOPE: f32 = 1e-3;

/// Capacity of the polygon that becomes a contact patch, number of vertices. Further vertices of the clipped polygon are
/// dropped. Value chosen; its sensitivity is not measured. Unit: dimensionless, a count.
pub(crate) const CONTACT_PATCH_CORNERS: usize = 64;

/// Least cosine between two normals that count as equal in the test for predicted misses. Dimensionless, 0..=1. A face with the
/// contact normal itself cannot prove a miss. Value chosen; its sensitivity is not measured. Unit: dimensionless, a cosine.
pub(crate) const PREDICTED_MISS_COSINE: f32 = 0.9999;

/// Least cosine between a contact normal and the normal of the face that it belongs to. Dimensionless, 0..=1. It is below 1
/// because contact recycling keeps the normal while a box rotates a little. Value chosen; its sensitivity is not measured.
/// Unit: dimensionless, a cosine.
pub(crate) const PRISM_FACE_MIN_COSINE: f32 = 0.999_9;

/// Largest overlap at which two faces count as flush if neither body is static, as a fraction of the speculative distance.
/// Dimensionless, 0..=1. Deeper faces are walls. Value chosen; its sensitivity is not measured. Unit: dimensionless.
pub(crate) const MOVING_FLUSH_OVERLAP: f32 = 0.05;

/// Largest overlap at which a face of a static body without load counts as flush, as a fraction of the speculative distance.
/// Dimensionless, 0..=1. It exceeds the gap that characters keep above their floor, and the rounding error of positions some
/// 100,000 px away. Unit: dimensionless.
pub(crate) const RESTING_FLUSH_OVERLAP: f32 = 0.016;

/// Largest overlap at which two faces under load count as flush, as a fraction of the speculative distance. Dimensionless,
/// 0..=1. A loaded body penetrates its floor and meets the next flush face at the same depth. Value chosen; its sensitivity is
/// not measured. Unit: dimensionless.
pub(crate) const LOADED_FLUSH_OVERLAP: f32 = 0.25;

/// Age of an overlap, in steps, beyond which the last-entered axis of two prisms is unknown. The displacements of the last step
/// give the age of an overlap along each axis; the order of older overlaps is unknown. Value chosen; its sensitivity is not
/// measured. Unit: dimensionless, steps.
pub(crate) const PRISM_ENTRY_MAX_AGE: f32 = 1.5;

/// Largest overlap of a sphere with a rim that counts as grazing and makes no contact, as a fraction of the contact margin.
/// Dimensionless, 0..=1. Without it spheres that roll over a seam between two floors are stopped. Value chosen; its sensitivity
/// is not measured. Unit: dimensionless.
pub(crate) const GRAZED_RIM_OVERLAP: f32 = 0.02;

/// Number of iterations of the secant method for the time of impact of a sphere at a rim. Each iteration leaves less than a
/// tenth of the error. Unit: dimensionless, a count.
pub(crate) const RIM_SECANT_STEPS: usize = 3;

/// Largest difference between the distances of the two ends of a capsule's side from the other shape, as a fraction of the
/// contact margin. Dimensionless, 0..=1. Up to this difference the side lies flat and has two contact points. Value chosen; its
/// sensitivity is not measured. Unit: dimensionless.
pub(crate) const FLAT_SIDE_MAX_LEAN: f32 = 0.05;

/// Least cosine between the normals of the two contact points of a capsule's side. Dimensionless, 0..=1. Two points with a
/// smaller cosine lie on different faces; then the side has one contact point. Value chosen; its sensitivity is not measured.
/// Unit: dimensionless, a cosine.
pub(crate) const FLAT_SIDE_MIN_COSINE: f32 = 0.999;

/// Restitution threshold in three axes, in number of steps: approaches slower than the velocity change by gravity in so many
/// steps have no restitution. A resting body approaches at most that fast. Value chosen; its sensitivity is not measured. Unit:
/// dimensionless, steps.
pub(crate) const RESTITUTION_GRAVITY_STEPS: f32 = 4.0;

/// Angle between yaw and stop, in radians, below which a hinged box counts as resting at the stop. Value chosen; its
/// sensitivity is not measured. Unit: radians.
pub(crate) const HINGE_STOP_MAX_ANGLE: f32 = 1e-4;

/// Largest distance, in length units, between the outermost point of a hinged box and the place of this point at the rest
/// angle, at which the box may fall asleep. Without this limit a box that a weak spring moves slowly falls asleep before it
/// arrives. Value chosen; its sensitivity is not measured. Unit: length units.
pub(crate) const HINGE_REST_MAX_DISTANCE: f32 = 1e-3;

/// Least cosine at which the normals of a vertical shape's contacts along both axes count as equal. Dimensionless, 0..=1. Value
/// chosen; its sensitivity is not measured. Unit: dimensionless, a cosine.
pub(crate) const VERTICAL_NORMAL_COSINE: f32 = 0.9999;

/// Least vertical component of the unit normal of a slope. Dimensionless, 0..=1. It is the sine of the angle whose cosine is
/// [`VERTICAL_NORMAL_COSINE`]: faces at 89.2 degrees from level or more have the normal of a wall. Unit: dimensionless.
pub(crate) const SLOPE_MIN_NORMAL_UP: f32 = 0.01414;

/// Age of an overlap, in steps, beyond which the last-entered axis of a vertical shape is unknown. Value chosen; its
/// sensitivity is not measured. Unit: dimensionless, steps.
pub(crate) const VERTICAL_ENTRY_MAX_AGE: f32 = 1.5;

/// Largest overlap with the curved side of a vertical shape that counts as grazing and makes no contact, as a fraction of the
/// speculative distance. Dimensionless, 0..=1. Value chosen; its sensitivity is not measured. Unit: dimensionless.
pub(crate) const GRAZED_CURVE_OVERLAP: f32 = 0.02;

/// Number of iterations of the secant method for the time of impact at a curved side. Each iteration leaves less than a tenth
/// of the error. Unit: dimensionless, a count.
pub(crate) const CURVE_SECANT_STEPS: usize = 4;

/// Least advantage in distance, as a fraction of the speculative distance, by which a vertex replaces an end of a slanted side
/// as contact point. The vertex must be nearer to the other shape by this advantage. Dimensionless, 0..=1. Value chosen; its
/// sensitivity is not measured. Unit: dimensionless.
pub(crate) const NEARER_CORNER_MIN_ADVANTAGE: f32 = 0.1;

/// Least length of the interval in which a capsule's axis is equally near to a prism, as a multiple of the tolerance of the
/// distance. Dimensionless, > 0. A longer interval gives two contact points, a shorter interval one. Value chosen; its
/// sensitivity is not measured. Unit: dimensionless.
pub(crate) const FLAT_INTERVAL_MIN_RATIO: f32 = 10.0;

/// Fraction that is cut off at either end of the interval in which a capsule's axis is equally near to a prism, 0..=0.5. It
/// keeps contact points away from the vertices of the prism's side. Value chosen; its sensitivity is not measured. Unit:
/// dimensionless, at most 1.
pub(crate) const FLAT_INTERVAL_INSET: f32 = 0.05;

/// Number of iterations of the ternary search for the nearest point on a capsule's axis. Each iteration keeps two thirds of the
/// interval; 20 iterations keep a three thousandth. Unit: dimensionless, a count.
pub(crate) const TERNARY_SEARCH_STEPS: usize = 20;

/// Least cosine, seen from above, between the uphill direction of a face and the outward normal of an edge that counts as a
/// ridge. Dimensionless, 0..=1. Value chosen; its sensitivity is not measured. Unit: dimensionless, at most 1.
pub(crate) const RIDGE_MIN_UPHILL_COSINE: f32 = 0.7;

/// Largest difference between the highest points of two top faces at which the highest point counts as a ridge of both, in the
/// user's unit (not multiplied by the length unit). Value chosen; its sensitivity is not measured. Unit: the length unit of coordinates.
pub(crate) const RIDGE_MAX_HEIGHT_DIFFERENCE: f32 = 1e-3;
