//! Distance grids: signed distances to an outline, sampled on a grid (behaviour chapter 06).
//!
//! Each geom has a grid of the distances to its outline in its own coordinates. Two geoms touch where a vertex of one
//! lies in a cell of the other's grid whose interpolated distance is negative.

use std::sync::Arc;

use crate::limits::Limits;
use crate::math::vector2::{length_squared, normalize};
use crate::math::{Vector2, scalar};
use crate::shape::Feature;
use crate::shape::distance::{nearest_distance, nearest_distances};
use crate::shape::{Aabb, Vertices};
use crate::{Error, Result};

/// Maximum number of nodes of a grid; the original runs out of memory at about that size.
const MAX_NODES: u64 = 1 << 26;

/// Signed distances to an outline at the nodes of a square grid over its box.
#[derive(Debug, Clone, PartialEq)]
#[doc(alias = "DistanceGridData")]
pub struct DistanceGrid {
    outline: Vertices,
    aabb: Aabb,
    cell_size: f32,
    inverse_cell_size: f32,
    x_count: usize,
    y_count: usize,
    /// Distances in length units, negative inside; node (x, y) at index `x * y_count + y`.
    nodes: Vec<f32>,
    /// Margin of the outline's world box, as a fraction of the greatest coordinate involved: no point outside of the
    /// widened box can touch the geom. Infinite if no such margin is known.
    pub(crate) box_slack: f32,
    /// Square of the distance from the origin beyond which no point can touch the geom, in length units², with the same
    /// margin.
    pub(crate) hit_radius_squared: f32,
}

impl DistanceGrid {
    /// Samples the distances to an outline given in its own coordinates and in the engine's winding. The cell size is
    /// in length units.
    ///
    /// # Errors
    /// `collision_grid_size` if it is not positive and finite, or so small that the grid would have more than 2^26
    /// nodes; an empty outline; [`Error::LimitExceeded`] if the work exceeds the default
    /// [`grid_work`](Limits::grid_work).
    #[doc(alias = "CreateDistanceGrid")]
    pub fn new(outline: Vertices, collision_grid_size: f32) -> Result<Self> {
        let plan = GridPlan::new(&outline, collision_grid_size)?;
        plan.check(&Limits::default())?;
        Ok(plan.sample(outline))
    }

    /// A grid with outline and cell size whose nodes have not been sampled yet. No point is inside of it.
    fn unsampled(outline: Vertices, cell_size: f32) -> Self {
        DistanceGrid {
            outline,
            aabb: Aabb::default(),
            cell_size,
            inverse_cell_size: 1.0 / cell_size,
            x_count: 0,
            y_count: 0,
            nodes: Vec::new(),
            box_slack: f32::INFINITY,
            hit_radius_squared: 0.0,
        }
    }

    /// The outline that was sampled.
    pub fn outline(&self) -> &Vertices {
        &self.outline
    }

    /// The outline's box in its own coordinates.
    #[doc(alias = "AABB")]
    pub fn aabb(&self) -> Aabb {
        self.aabb
    }

    /// Edge of a cell, in length units.
    #[doc(alias = "GridCellSize")]
    pub fn cell_size(&self) -> f32 {
        self.cell_size
    }

    /// Reciprocal of the edge of a cell, in 1/length units.
    #[doc(alias = "GridCellSizeInv")]
    pub fn inverse_cell_size(&self) -> f32 {
        self.inverse_cell_size
    }

    /// Number of nodes along x and y.
    pub fn size(&self) -> (usize, usize) {
        (self.x_count, self.y_count)
    }

    /// The distances in length units; node (x, y) is at index `x * size().1 + y`.
    #[doc(alias = "Nodes")]
    pub fn nodes(&self) -> &[f32] {
        &self.nodes
    }

    /// The interpolated distance and its gradient at a point in the outline's own coordinates, if the point is inside.
    /// A point whose cell would reach beyond the last node is outside; the original fails there.
    #[doc(alias = "Intersect")]
    #[inline]
    pub fn intersect(&self, point: Vector2) -> Option<Feature> {
        if length_squared(point) > self.hit_radius_squared || !self.aabb.contains(point) {
            return None;
        }
        let min = self.aabb.min;
        let inverse = self.inverse_cell_size;
        // Truncation is the floor here: a point inside the box is not below its minimum.
        let ix = ((point.x - min.x) * inverse) as i32 as usize;
        let iy = ((point.y - min.y) * inverse) as i32 as usize;
        if ix + 1 >= self.x_count || iy + 1 >= self.y_count {
            return None;
        }
        let corner = ix * self.y_count + iy;
        let bottom_left = self.nodes[corner];
        let top_left = self.nodes[corner + 1];
        let bottom_right = self.nodes[corner + self.y_count];
        let top_right = self.nodes[corner + self.y_count + 1];
        if !(bottom_left <= 0.0 || bottom_right <= 0.0 || top_left <= 0.0 || top_right <= 0.0) {
            return None;
        }
        let x_part = (point.x - (self.cell_size * ix as f32 + min.x)) * inverse;
        let y_part = (point.y - (self.cell_size * iy as f32 + min.y)) * inverse;
        let top = lerp(top_left, top_right, x_part);
        let bottom = lerp(bottom_left, bottom_right, x_part);
        let distance = lerp(bottom, top, y_part);
        // NaN is no contact either.
        if distance.is_nan() || distance > 0.0 {
            return None;
        }
        let right = lerp(bottom_right, top_right, y_part);
        let left = lerp(bottom_left, top_left, y_part);
        let gradient = Vector2::new(right - left, top - bottom);
        if gradient.x == 0.0 && gradient.y == 0.0 {
            return None;
        }
        Some(Feature { position: point, normal: normalize(gradient), distance })
    }
}

#[inline(always)]
fn lerp(a: f32, b: f32, t: f32) -> f32 {
    a + (b - a) * t
}

/// The size of a grid, known before its nodes are sampled.
pub(crate) struct GridPlan {
    cell_size: f32,
    x_count: usize,
    y_count: usize,
    aabb: Aabb,
    /// Number of nodes times number of vertices.
    pub(crate) work: u64,
}

impl GridPlan {
    pub(crate) fn new(outline: &Vertices, cell_size: f32) -> Result<Self> {
        if outline.is_empty() {
            return Err(Error::invalid("vertices", 0, "a list of at least one vertex"));
        }
        let (x_count, y_count, aabb) = node_counts(outline, cell_size)?;
        let work = (x_count * y_count) as u64 * outline.len() as u64;
        Ok(GridPlan { cell_size, x_count, y_count, aabb, work })
    }

    pub(crate) fn check(&self, limits: &Limits) -> Result<()> {
        Error::check_limit("grid_work", self.work, limits.grid_work)
    }

    /// Makes the grid of the outline for which it was planned.
    pub(crate) fn sample(&self, outline: Vertices) -> DistanceGrid {
        let GridPlan { cell_size, x_count, y_count, aabb, .. } = *self;
        let mut nodes = Vec::with_capacity(x_count * y_count);
        // Coordinates are summed up step by step, as in the original.
        let steps = |min| std::iter::successors(Some(min), |at| Some(at + cell_size));
        let column: Vec<f32> = steps(aabb.min.y).take(y_count).collect();
        for x in steps(aabb.min.x).take(x_count) {
            let (fours, rest) = column.as_chunks::<4>();
            nodes.extend(
                fours.iter().flat_map(|y| nearest_distances(&outline, y.map(|y| Vector2::new(x, y)))),
            );
            nodes.extend(rest.iter().map(|&y| nearest_distance(&outline, Vector2::new(x, y))));
        }
        let box_slack = box_slack(&outline, x_count.max(y_count));
        let reach_squared =
            outline.iter().map(|&v| length_squared(v)).fold(0.0, f32::max) * (1.0 + 4.0 * box_slack);
        DistanceGrid {
            outline,
            aabb,
            cell_size,
            inverse_cell_size: 1.0 / cell_size,
            x_count,
            y_count,
            nodes,
            box_slack,
            hit_radius_squared: reach_squared,
        }
    }
}

/// Number of nodes along both axes, and the local box (negative zeros of the outline become positive).
fn node_counts(outline: &Vertices, cell_size: f32) -> Result<(usize, usize, Aabb)> {
    crate::math::finite::positive("collision_grid_size", cell_size)?;
    let inverse = 1.0 / cell_size;
    let positive_zero: Vec<Vector2> = outline.iter().map(|v| Vector2::new(v.x + 0.0, v.y + 0.0)).collect();
    let aabb = Aabb::from_vertices(&positive_zero);
    let count = |size: f32| {
        scalar::to_int_f64((f64::from(size) * f64::from(inverse)).ceil()).checked_add(1).filter(|&n| n > 0)
    };
    let counts = count(aabb.max.x - aabb.min.x).zip(count(aabb.max.y - aabb.min.y));
    match counts {
        Some((x, y)) if x as u64 * y as u64 <= MAX_NODES => Ok((x as usize, y as usize, aabb)),
        _ => Err(Error::invalid(
            "collision_grid_size",
            cell_size,
            "large enough for a grid of at most 2^26 nodes over the outline",
        )),
    }
}

/// Relative margin that covers rounding, for [`DistanceGrid::box_slack`].
///
/// For a convex outline the distance is a convex function, so between nodes the interpolated distance is never below
/// the true one. A point with a negative interpolated distance is therefore inside the outline, up to rounding.
/// Rounding grows with the number of nodes, because sample positions are accumulated. For concave outlines no margin is
/// known: infinity.
fn box_slack(outline: &Vertices, nodes_per_axis: usize) -> f32 {
    if !is_strictly_usable_convex(outline) {
        return f32::INFINITY;
    }
    // Eight roundings of half an ulp per node and sixty-four for both transforms, doubled for safety.
    let ulps = (nodes_per_axis * 8 + 64) as f32;
    ulps * 2.0 * f32::EPSILON
}

/// Maximum turn at a corner, in radians. Beyond 170 degrees the rounding of a vertex normal could decide on which side
/// of the outline a node is.
const MAX_TURN_ANGLE: f64 = 170.0 / 180.0 * std::f64::consts::PI;

/// Whether an outline is convex without zero edges or reversals, in the engine's winding. The turn may vanish at some
/// vertices.
fn is_strictly_usable_convex(outline: &Vertices) -> bool {
    let n = outline.len();
    if n < 3 {
        return false;
    }
    let mut turn = 0.0f64;
    for i in 0..n {
        let e1 = outline.get_edge(i);
        let e2 = outline.get_edge(outline.next_index(i));
        let (e1x, e1y) = (f64::from(e1.x), f64::from(e1.y));
        let (e2x, e2y) = (f64::from(e2.x), f64::from(e2.y));
        let cross = e1x * e2y - e1y * e2x;
        let dot = e1x * e2x + e1y * e2y;
        if cross.is_nan() || cross > 0.0 || (cross == 0.0 && dot <= 0.0) {
            return false;
        }
        let angle = libm::atan2(cross, dot);
        if angle < -MAX_TURN_ANGLE {
            return false;
        }
        turn += angle;
    }
    // The turns sum up to one full turn, not to several as in a pentagram.
    (turn + std::f64::consts::TAU).abs() < 1e-6
}

/// Saves a grid as outline and cell size. A loaded grid is [unsampled](DistanceGrid::unsampled) until the cost of all
/// grids together is known; then it is sampled again, with the same bits.
pub(crate) mod as_outline {
    use super::*;
    use serde::{Deserialize, Deserializer, Serialize, Serializer, de::Error as _};

    #[derive(Serialize, Deserialize)]
    struct Source {
        outline: Vertices,
        cell_size: f32,
    }

    pub(crate) fn serialize<S: Serializer>(
        grid: &Option<Arc<DistanceGrid>>,
        serializer: S,
    ) -> Result<S::Ok, S::Error> {
        let source =
            grid.as_ref().map(|grid| Source { outline: grid.outline.clone(), cell_size: grid.cell_size });
        source.serialize(serializer)
    }

    pub(crate) fn deserialize<'de, D: Deserializer<'de>>(
        deserializer: D,
    ) -> Result<Option<Arc<DistanceGrid>>, D::Error> {
        let Some(source) = Option::<Source>::deserialize(deserializer)? else { return Ok(None) };
        if !source.outline.iter().all(|v| v.x.is_finite() && v.y.is_finite()) {
            return Err(D::Error::custom("outline of a distance grid is not finite"));
        }
        Ok(Some(Arc::new(DistanceGrid::unsampled(source.outline, source.cell_size))))
    }
}
