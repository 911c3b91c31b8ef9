//! Broad phase: AABBs, the hash grid, lists that keep room, and the range of coordinates.

/// Largest margin of an AABB. Unit: length units. Box2D 3 (E. Catto, `B2_MAX_AABB_MARGIN`, 0.05 m).
pub(in crate::precise) const AABB_MARGIN: f32 = 0.05;

/// Largest margin of an AABB as a fraction of the size of its proxy. Unit: dimensionless. An eighth of the extent in Box2D 3.
pub(in crate::precise) const AABB_MARGIN_PER_SIZE: f32 = 0.25;

/// Steps by whose motion an AABB reaches ahead. Unit: dimensionless, steps. Half of them take as long within 5 % (arena, spinner of
/// 1,520 bodies).
pub(in crate::precise) const AABB_STEPS_AHEAD: f32 = 4.0;

/// Most that an AABB reaches ahead beyond the next step, as a multiple of the size of its proxy. Unit: dimensionless. A pair
/// should not exist for long before the shapes touch.
pub(in crate::precise) const AABB_REACH_PER_SIZE: f32 = 1.0;

/// The steps of a proxy without pairs. Unit: dimensionless, steps. A longer reach saves searches of the broad phase.
pub(in crate::precise) const UNPAIRED_AABB_STEPS_AHEAD: f32 = 32.0;

/// The reach of a proxy without pairs, as a multiple of its size. Unit: dimensionless.
pub(in crate::precise) const UNPAIRED_AABB_REACH_PER_SIZE: f32 = 2.0;

/// Levels of the hash grid: cell sizes from 2^-32 to 2^31. Unit: dimensionless, a count. Boxes of the last level may be of any size: it
/// is searched from end to end.
pub(in crate::precise) const GRID_LEVELS: i32 = 64;

/// Binary exponent of the smallest cell. Unit: dimensionless.
pub(in crate::precise) const GRID_LOWEST_LEVEL: i32 = -32;

/// Cell index beyond which there is one last cell. Unit: dimensionless. Less than 2^31, so that it is an `i32`.
pub(in crate::precise) const GRID_FARTHEST_CELL: f32 = 1e9;

/// Greatest coordinate at which anything collides. Unit: that of coordinates. Its square is less than the largest `f32`, 3.4e38.
pub(in crate::precise) const COLLISION_RANGE: f32 = 1e18;

/// Greatest coordinate of AABBs that queries look at. Unit: that of coordinates. A tenth of [`COLLISION_RANGE`].
pub(in crate::precise) const QUERY_RANGE: f32 = 1e17;

/// Difference by rounding between AABBs and geoms, as a fraction of the largest coordinate. Unit: dimensionless. 64 roundings of `f32`.
pub(in crate::precise) const QUERY_ROUNDING: f32 = 64.0 * f32::EPSILON;

/// Part of the speculative distance that a convex piece may fall short of its outline by. Unit: dimensionless, at most 1.
pub(in crate::precise) const PIECE_SHORTFALL: f32 = 0.25;

/// Empty list positions that are kept before half of all may be empty. Unit: dimensionless, a count.
pub(in crate::precise) const KEPT_EMPTY_POSITIONS: usize = 64;

/// Bodies for each of which the list of movable bodies has room for one more. Unit: dimensionless.
pub(in crate::precise) const BODIES_PER_SPARE_ROOM: usize = 8;

/// Least room for more movable bodies. Unit: dimensionless, a count.
pub(in crate::precise) const LEAST_SPARE_ROOM: usize = 8;

/// Relative motion after which a separated pair is tested again in any case, so that sums of motion do not wrap. Unit: length units. Sums
/// wrap at 64 length units (2^32 parts of 2^-26).
pub(in crate::precise) const SEPARATED_PAIR_SLACK: f32 = 8.0;

/// Factor by which a coordinate of a body must stay below the largest `f32`. Unit: dimensionless.
pub(in crate::precise) const COORDINATE_HEADROOM: f32 = 1e8;
