//! Parameters of the broad phase: fat AABBs, the hash grid, AABB queries, spare positions in lists, and limits of coordinates.
//!
//! Lengths are multiples of the length unit of `Methods::Precise` or of the extent of a proxy: the largest distance of its
//! surface from the origin of its body. Box2D 3 (E. Catto) is the source of the margin; the other values are made for this
//! engine.

/// Largest margin of a fat AABB on all sides, in length units. The margin keeps a slow proxy from a new AABB in every step.
/// Source: Box2D 3 (E. Catto, `B2_MAX_AABB_MARGIN`, 0.05 m). Unit: length units.
pub(crate) const AABB_MAX_MARGIN: f32 = 0.05;

/// Largest margin of a fat AABB, dimensionless: a fraction of the extent of its proxy, the largest distance of the surface from
/// the origin of the body. It keeps small proxies from many pairs that never touch. Source: Box2D 3 limits the margin in the
/// same way, to an eighth of the extent. Value 0.25 chosen; its sensitivity is not measured. Unit: dimensionless.
pub(crate) const AABB_MAX_MARGIN_PER_SIZE: f32 = 0.25;

/// Number of steps of its body's motion by which a fat AABB reaches ahead of its proxy. This prediction keeps a fast proxy from
/// a new AABB in every step. Measured: half of the value takes as long within 5 % (arena, spinner of 1,520 bodies). Unit:
/// dimensionless, steps.
pub(crate) const AABB_PREDICTED_STEPS: f32 = 4.0;

/// Largest distance by which [`AABB_PREDICTED_STEPS`] may extend a fat AABB, dimensionless: a multiple of the extent of its
/// proxy, the largest distance of the surface from the origin of the body. Without a limit, pairs would exist long before their
/// shapes touch. The motion of one step is always covered. Value chosen; its sensitivity is not measured. Unit: dimensionless.
pub(crate) const AABB_MAX_PREDICTION_PER_SIZE: f32 = 1.0;

/// Number of steps of its body's motion by which a fat AABB reaches ahead of a proxy without pairs. A long prediction saves
/// searches of the broad phase. Value chosen; its sensitivity is not measured. Unit: dimensionless, steps.
pub(crate) const UNPAIRED_AABB_PREDICTED_STEPS: f32 = 32.0;

/// Largest distance by which [`UNPAIRED_AABB_PREDICTED_STEPS`] may extend the fat AABB of a proxy without pairs, dimensionless:
/// a multiple of the extent of the proxy. The extent is the largest distance of the surface from the origin of the body.
/// Without a limit, fast proxies would get pairs far ahead. Value chosen; its sensitivity is not measured. Unit: dimensionless.
pub(crate) const UNPAIRED_AABB_MAX_PREDICTION_PER_SIZE: f32 = 2.0;

/// Number of levels of the hash grid. Level i has cells of the size 2^(i - 32), in the unit of the coordinates, so the sizes
/// run from 2^-32 to 2^31. The last level takes AABBs of any size, because a query tests all of its entries. Unit:
/// dimensionless, a count.
pub(crate) const GRID_LEVELS: i32 = 64;

/// Binary exponent of the cell size of level 0 of the hash grid, dimensionless: these cells have the size 2^-32 in the unit of
/// the coordinates. Unit: dimensionless.
pub(crate) const GRID_MIN_CELL_EXPONENT: i32 = -32;

/// Largest cell index of the hash grid along x and y, dimensionless. Larger coordinates are clamped to the outermost cell. The
/// value is below 2^31, so that an index fits into an `i32`. Unit: dimensionless.
pub(crate) const GRID_MAX_CELL_INDEX: f32 = 1e9;

/// Number of entries of a level of the hash grid up to which a query tests all of them. For so few, the indices of the cells cost more
/// than the tests. Value chosen; it has no effect on the result. Unit: dimensionless, a count.
pub(crate) const GRID_FEW_ENTRIES: u32 = 12;

/// Number of entries of a level, for each cell of a query, up to which the query tests all entries instead of the cells. A cell costs
/// about as much as so many tests. Value chosen; it has no effect on the result. Unit: dimensionless, a count.
pub(crate) const GRID_ENTRIES_PER_CELL: i64 = 3;

/// Number of entries that may stop fast bodies up to which continuous collision tests all of them instead of the levels that they are
/// in. Value chosen; it has no effect on the result. Unit: dimensionless, a count.
pub(crate) const GRID_FEW_STOPPERS: usize = 32;

/// Largest absolute coordinate at which shapes collide, in the unit of the coordinates. The square of the value, 1e36, stays
/// below the largest `f32`, 3.4e38, so that squared distances are finite. Unit: the length unit of coordinates.
pub(crate) const COLLISION_MAX_COORDINATE: f32 = 1e18;

/// Largest sum of the absolute coordinates of an AABB query that the hash grid answers, in the unit of the coordinates. Larger
/// queries test all geoms. The value is a tenth of `COLLISION_MAX_COORDINATE`, so that the query stays within the range of
/// the grid. Unit: the length unit of coordinates.
pub const QUERY_MAX_COORDINATE: f32 = 1e17;

/// Bound on the rounding error by which a geom may reach beyond its AABB in the grid, as a fraction of the absolute
/// coordinates, dimensionless. AABB queries are enlarged by it. The value is 64 roundings of an `f32`. Unit: dimensionless.
pub const QUERY_ROUNDING_RATIO: f32 = 64.0 * f32::EPSILON;

/// Distance by which a geom may reach beyond the AABB of its convex piece and still count as covered, as a fraction of the
/// speculative distance, dimensionless, 0..=1. Tight AABBs include the speculative distance, so values up to 1 are safe. Value
/// chosen; its sensitivity is not measured. Unit: dimensionless, at most 1.
pub const PIECE_MAX_SHORTFALL_RATIO: f32 = 0.25;

/// Number by which the empty positions of a list may exceed the used ones before the list is rebuilt. The allowance keeps short
/// lists from frequent rebuilds. Value chosen; its sensitivity is not measured. Unit: dimensionless, a count.
pub const MIN_EMPTY_POSITIONS_TO_COMPACT: usize = 64;

/// Number of bodies, or of their proxies, for each spare position after the non-static ones in the list. Spare positions take new
/// objects without a rebuild of the list. Value chosen; its sensitivity is not measured. Unit: dimensionless.
pub(crate) const BODIES_PER_SPARE_POSITION: usize = 8;

/// Smallest number of spare positions after the non-static bodies, or after their proxies, in the list. Spare positions take
/// new objects without a rebuild. Value chosen; its sensitivity is not measured. Unit: dimensionless, a count.
pub(crate) const MIN_SPARE_POSITIONS: usize = 8;

/// Largest summed path length of both bodies, in length units, before a pair without contacts is tested again, even if its
/// shapes are farther apart. The limit keeps the wrapping travel counters unambiguous: they wrap at 64 length units (2^32
/// multiples of 2^-26). Unit: length units.
pub(crate) const SEPARATED_PAIR_MAX_SLACK: f32 = 8.0;

/// Factor between the largest `f32` and the largest allowed coordinate of a body, dimensionless. The headroom keeps the
/// vertices around the body finite. Value chosen; its sensitivity is not measured. Unit: dimensionless.
pub(crate) const COORDINATE_HEADROOM: f32 = 1e8;
