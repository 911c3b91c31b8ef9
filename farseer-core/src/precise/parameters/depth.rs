//! The depth axis: prisms, spheres, vertical shapes and world boxes.

/// Greatest motion in a step of a world box that sweeps; a longer one is a teleport. Unit: length units.
pub(in crate::precise) const WORLD_BOX_SWEEP: f32 = 4.0;

/// Most corners of a footprint: those of a box cut by two planes, seen from above, and some more. Unit: dimensionless, a count.
pub(in crate::precise) const FOOTPRINT_CORNERS: usize = 16;

/// Greatest slope, rise by run, of an edge that counts as level. Unit: dimensionless.
pub(in crate::precise) const LEVEL_EDGE_SLOPE: f32 = 1e-3;

/// Most corners of a contact patch; more are left out. Unit: dimensionless, a count.
pub(in crate::precise) const CONTACT_PATCH_CORNERS: usize = 64;

/// Least cosine between two normals that count as equal for predicted misses. Unit: dimensionless, a cosine.
pub(in crate::precise) const PREDICTED_MISS_COSINE: f32 = 0.9999;

/// Least cosine between a contact normal and that of its face. Unit: dimensionless, a cosine. A contact recycles its normal while a box turns
/// a little.
pub(in crate::precise) const PRISM_FACE_COSINE: f32 = 0.999_9;

/// Greatest overlap of flush faces where something moves, as a fraction of the speculative distance. Unit: dimensionless.
pub(in crate::precise) const MOVING_FLUSH_OVERLAP: f32 = 0.05;

/// The same at rest without load. Unit: dimensionless. More than figures keep above their floor, and than rounding leaves of
/// positions some 100,000 px away.
pub(in crate::precise) const RESTING_FLUSH_OVERLAP: f32 = 0.016;

/// The same under the greatest load. Unit: dimensionless.
pub(in crate::precise) const LOADED_FLUSH_OVERLAP: f32 = 0.25;

/// Steps after which the axis of last entry of two prisms is forgotten. Unit: dimensionless, steps.
pub(in crate::precise) const PRISM_ENTRY_MEMORY: f32 = 1.5;

/// Overlap of a rim that is ignored, as a fraction of the speculative distance. Unit: dimensionless.
pub(in crate::precise) const GRAZED_RIM_OVERLAP: f32 = 0.02;

/// Secant steps towards the time of impact at a rim. Unit: dimensionless, a count. Each leaves less than a tenth of the error.
pub(in crate::precise) const RIM_SECANT_STEPS: usize = 3;

/// Greatest lean of a flat side, as a fraction of the speculative distance. Unit: dimensionless.
pub(in crate::precise) const FLAT_SIDE_LEAN: f32 = 0.05;

/// Least cosine between the normals of one side. Unit: dimensionless, a cosine.
pub(in crate::precise) const FLAT_SIDE_COSINE: f32 = 0.999;

/// Steps of gravity whose velocity does not bounce. Unit: dimensionless, steps.
pub(in crate::precise) const RESTITUTION_GRAVITY_STEPS: f32 = 4.0;

/// Distance from its stop at which a hinged box is at the stop. Unit: radians.
pub(in crate::precise) const HINGE_STOP_ANGLE: f32 = 1e-4;

/// Greatest distance of its rim from the angle of rest with which a hinged box sleeps. Unit: length units.
pub(in crate::precise) const HINGE_REST_DISTANCE: f32 = 1e-3;

/// Least cosine between two normals of vertical shapes that count as equal. Unit: dimensionless, a cosine.
pub(in crate::precise) const VERTICAL_NORMAL_COSINE: f32 = 0.9999;

/// Least upward component of the normal of a slope. Unit: dimensionless. The sine of the angle whose cosine is
/// [`VERTICAL_NORMAL_COSINE`]: steeper faces, 89.2 degrees from level or more, have the normal of a wall.
pub(in crate::precise) const SLOPE_NORMAL_UP: f32 = 0.01414;

/// Steps after which the axis of last entry of a vertical shape is forgotten. Unit: dimensionless, steps.
pub(in crate::precise) const VERTICAL_ENTRY_MEMORY: f32 = 1.5;

/// Overlap of a curved side that is ignored, as a fraction of the speculative distance. Unit: dimensionless.
pub(in crate::precise) const GRAZED_CURVE_OVERLAP: f32 = 0.02;

/// Secant steps towards the time of impact at a curved side. Unit: dimensionless, a count. Each leaves less than a tenth of the error.
pub(in crate::precise) const CURVE_SECANT_STEPS: usize = 4;

/// Least advantage in distance of a corner over the ends of a side, as a fraction of the speculative distance. Unit: dimensionless.
pub(in crate::precise) const LEANING_CORNER_DISTANCE: f32 = 0.1;

/// Least ratio of length to depth of a flat prism. Unit: dimensionless.
pub(in crate::precise) const FLAT_PRISM_RATIO: f32 = 10.0;

/// Part of its length that is left out at either end of it. Unit: dimensionless, at most 1.
pub(in crate::precise) const FLAT_PRISM_INSET: f32 = 0.05;

/// Steps of ternary search. Unit: dimensionless, a count. Each leaves two thirds of the interval, all of them a three thousandth.
pub(in crate::precise) const TERNARY_SEARCH_STEPS: usize = 20;

/// Greatest component of a ridge across the slope that leads up to it. Unit: dimensionless, at most 1.
pub(in crate::precise) const RIDGE_ACROSS_SLOPE: f32 = 0.7;

/// Greatest difference in height between the tops of two sides that form a ridge. Unit: that of coordinates.
pub(in crate::precise) const RIDGE_HEIGHT_DIFFERENCE: f32 = 1e-3;
