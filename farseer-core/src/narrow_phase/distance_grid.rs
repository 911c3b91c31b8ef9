//! Signed distances sampled on a grid (behaviour chapter 06).
//!
//! Each geom carries a grid of distances to its outline in its own coordinates. Two geoms touch where a
//! vertex of one lies in a cell of the other's grid whose interpolated distance is negative.

use std::collections::BTreeMap;
use std::sync::{Arc, Weak};

use wide::f32x4;

use crate::contact::{Contact, ContactId, Feature};
use crate::geom_entry::GeomEntry;
use crate::math::vector2::{length_squared, normalize};
use crate::math::{Vector2, scalar};
use crate::shape::distance::nearest_distance;
use crate::shape::{Aabb, Vertices};
use crate::{Error, Result};

/// More nodes than this are refused; the original runs out of memory at about that size.
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
    /// Node (x, y) at index `x * y_count + y`.
    nodes: Vec<f32>,
    /// Slack by which the world box of the outline must be widened so that no point that can hit lies outside
    /// it, as a fraction of the size of the numbers involved; infinite if no such slack is known.
    box_slack: f32,
    /// Square of the distance from the origin beyond which no point can hit, widened likewise.
    reach_squared: f32,
}

impl DistanceGrid {
    /// Samples the distances to an outline given in its own coordinates and the engine's winding.
    ///
    /// # Errors
    /// `collision_grid_size` if it is not positive and finite, or so small that the grid would have more
    /// than 2^26 nodes; an outline that is empty.
    #[doc(alias = "CreateDistanceGrid")]
    pub fn new(outline: Vertices, collision_grid_size: f32) -> Result<Self> {
        if outline.is_empty() {
            return Err(Error::invalid("vertices", 0, "a list of at least one vertex"));
        }
        let (x_count, y_count, aabb) = node_counts(&outline, collision_grid_size)?;
        let mut nodes = Vec::with_capacity(x_count * y_count);
        let mut x = aabb.min.x;
        for _ in 0..x_count {
            let mut y = aabb.min.y;
            for _ in 0..y_count {
                nodes.push(nearest_distance(&outline, Vector2::new(x, y)));
                y += collision_grid_size;
            }
            x += collision_grid_size;
        }
        let box_slack = box_slack(&outline, x_count.max(y_count));
        let reach_squared =
            outline.iter().map(|&v| length_squared(v)).fold(0.0, f32::max) * (1.0 + 4.0 * box_slack);
        Ok(DistanceGrid {
            outline,
            aabb,
            cell_size: collision_grid_size,
            inverse_cell_size: 1.0 / collision_grid_size,
            x_count,
            y_count,
            nodes,
            box_slack,
            reach_squared,
        })
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

    /// Edge of a cell.
    #[doc(alias = "GridCellSize")]
    pub fn cell_size(&self) -> f32 {
        self.cell_size
    }

    /// Reciprocal of the edge of a cell.
    #[doc(alias = "GridCellSizeInv")]
    pub fn inverse_cell_size(&self) -> f32 {
        self.inverse_cell_size
    }

    /// Number of nodes along x and y.
    pub fn size(&self) -> (usize, usize) {
        (self.x_count, self.y_count)
    }

    /// The distances; node (x, y) stands at index `x * size().1 + y`.
    #[doc(alias = "Nodes")]
    pub fn nodes(&self) -> &[f32] {
        &self.nodes
    }

    /// The interpolated distance and its gradient at a point of the outline's own coordinates, if the point is
    /// inside. A point whose cell would reach past the last node is outside; the original fails there.
    #[doc(alias = "Intersect")]
    #[inline]
    pub fn intersect(&self, point: Vector2) -> Option<Feature> {
        if length_squared(point) > self.reach_squared || !self.aabb.contains(point) {
            return None;
        }
        let min = self.aabb.min;
        let inverse = self.inverse_cell_size;
        // Truncation is the floor here: what is inside the box is not below its minimum.
        let ix = ((point.x - min.x) * inverse) as usize;
        let iy = ((point.y - min.y) * inverse) as usize;
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
        // NaN is no hit either.
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

/// Number of nodes along both axes, and the local box (negative zeros of the outline become positive).
fn node_counts(outline: &Vertices, cell_size: f32) -> Result<(usize, usize, Aabb)> {
    crate::error::positive("collision_grid_size", cell_size)?;
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

/// For a convex outline the distance is a convex function, so between nodes the interpolated distance is never
/// below the true one: what hits is inside the outline, up to rounding. Rounding grows with the number of
/// nodes, because sample positions are accumulated. Of concave outlines nothing is promised.
fn box_slack(outline: &Vertices, nodes_per_axis: usize) -> f32 {
    if !is_strictly_usable_convex(outline) {
        return f32::INFINITY;
    }
    // Eight roundings of half an ulp per node and sixty-four for both transforms, doubled for safety.
    let ulps = (nodes_per_axis * 8 + 64) as f32;
    ulps * 2.0 * f32::EPSILON
}

/// Beyond 170 degrees the rounding of a vertex normal could decide which side of the outline a node is on.
const SHARPEST_TURN: f64 = 170.0 / 180.0 * std::f64::consts::PI;

/// Convex without zero edges or reversals, in the engine's winding (or with a vanishing turn at some vertices).
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
        if angle < -SHARPEST_TURN {
            return false;
        }
        turn += angle;
    }
    // Once around, not several times as a pentagram.
    (turn + std::f64::consts::TAU).abs() < 1e-6
}

impl DistanceGrid {
    /// The world box outside of which no point can hit, given the geom's own world box; `None` if unknown.
    #[inline]
    fn hit_box(&self, geom: &GeomEntry) -> Option<Aabb> {
        let world = geom.aabb;
        if self.box_slack == f32::INFINITY || geom.refresh_is_due {
            return None;
        }
        let size = |v: Vector2| v.x.abs().max(v.y.abs());
        let largest = size(world.min).max(size(world.max)).max(size(self.aabb.min)).max(size(self.aabb.max));
        let slack = largest * self.box_slack;
        let slack = Vector2::new(slack, slack);
        Some(Aabb { min: world.min - slack, max: world.max + slack })
    }
}

/// Appends the contacts of two geoms (behaviour chapter 06, section 4).
pub(crate) fn collide(a: &GeomEntry, b: &GeomEntry, max_contacts: i32, contacts: &mut Vec<Contact>) {
    let (Some(grid_a), Some(grid_b)) = (&a.grid, &b.grid) else { return };
    collide_vertices(b, 0, a, grid_a, 1.0, max_contacts, contacts);
    collide_vertices(a, b.world_vertices.len() as i32, b, grid_b, -1.0, max_contacts, contacts);
}

/// Contacts of the vertices of one geom in the grid of another. Vertex numbers go on from `first_number`;
/// normals are multiplied by `direction` so that they point from A to B.
#[inline]
fn collide_vertices(
    owner: &GeomEntry,
    first_number: i32,
    other: &GeomEntry,
    grid: &DistanceGrid,
    direction: f32,
    max_contacts: i32,
    contacts: &mut Vec<Contact>,
) {
    let hit_box = grid.hit_box(other);
    for (chunk_index, chunk) in owner.world_vertices.chunks(VERTICES_AT_ONCE).enumerate() {
        let mut candidates = match &hit_box {
            Some(hit_box) => inside_box(chunk, hit_box),
            None => u32::MAX >> (VERTICES_AT_ONCE - chunk.len()),
        };
        while candidates != 0 {
            if contacts.len() as i64 == i64::from(max_contacts) {
                return;
            }
            let i = candidates.trailing_zeros() as usize;
            candidates &= candidates - 1;
            let vertex = chunk[i];
            let Some(feature) = grid.intersect(other.pose.inverse.apply(vertex)) else { continue };
            if feature.distance < 0.0 {
                let normal = other.pose.matrix.apply_normal(feature.normal) * direction;
                let number = first_number + (chunk_index * VERTICES_AT_ONCE + i) as i32;
                let id = ContactId { geom1: owner.number, vertex: number, geom2: other.number };
                contacts.push(Contact::new(vertex, normal, feature.distance, id));
            }
        }
    }
}

/// Bits in a set of vertices.
const VERTICES_AT_ONCE: usize = 32;

/// The set of vertices, of at most [`VERTICES_AT_ONCE`], that a box does not exclude.
#[inline]
fn inside_box(vertices: &[Vector2], aabb: &Aabb) -> u32 {
    let low = f32x4::new([aabb.min.x, aabb.min.y, aabb.min.x, aabb.min.y]);
    let high = f32x4::new([aabb.max.x, aabb.max.y, aabb.max.x, aabb.max.y]);
    let mut inside = 0;
    let (pairs, rest) = vertices.as_chunks::<2>();
    for (i, [first, second]) in pairs.iter().enumerate() {
        let corners = f32x4::new([first.x, first.y, second.x, second.y]);
        let excluded = (corners.simd_lt(low) | corners.simd_gt(high)).to_bitmask();
        let included = u32::from(excluded & 0b0011 == 0) | (u32::from(excluded & 0b1100 == 0) << 1);
        inside |= included << (2 * i);
    }
    if let [last] = rest {
        let is_excluded =
            last.x < aabb.min.x || last.x > aabb.max.x || last.y < aabb.min.y || last.y > aabb.max.y;
        inside |= u32::from(!is_excluded) << (vertices.len() - 1);
    }
    inside
}

/// The grids of a simulator by outline and cell size, so that equal ones are built and kept once.
#[derive(Debug, Clone, Default)]
pub(crate) struct GridCache {
    grids: BTreeMap<Box<[u32]>, Weak<DistanceGrid>>,
    inserts_until_cleanup: usize,
}

impl GridCache {
    /// The grid over an outline; built only if there is none yet.
    pub(crate) fn get(&mut self, outline: &Vertices, cell_size: f32) -> Result<Arc<DistanceGrid>> {
        let bits = outline.iter().flat_map(|v| [v.x.to_bits(), v.y.to_bits()]);
        let key: Box<[u32]> = std::iter::once(cell_size.to_bits()).chain(bits).collect();
        if let Some(grid) = self.grids.get(&key).and_then(Weak::upgrade) {
            return Ok(grid);
        }
        let grid = Arc::new(DistanceGrid::new(outline.clone(), cell_size)?);
        self.forget_unused();
        self.grids.insert(key, Arc::downgrade(&grid));
        Ok(grid)
    }

    /// Drops entries whose grid is gone, once for every doubling.
    fn forget_unused(&mut self) {
        if self.inserts_until_cleanup == 0 {
            self.grids.retain(|_, grid| grid.strong_count() > 0);
            self.inserts_until_cleanup = self.grids.len().max(64);
        }
        self.inserts_until_cleanup -= 1;
    }

    /// Takes a grid that was loaded; answers the one to use.
    pub(crate) fn adopt(&mut self, grid: &Arc<DistanceGrid>) -> Result<Arc<DistanceGrid>> {
        self.get(&grid.outline, grid.cell_size)
    }
}

/// Saves a grid as the outline and cell size it is made from; loading samples it again, to the same bits.
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
        DistanceGrid::new(source.outline, source.cell_size)
            .map(|grid| Some(Arc::new(grid)))
            .map_err(D::Error::custom)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::arena::{Arena, Id};
    use crate::body::BodyId;

    /// A sequence without a pattern that matters here.
    struct Sequence(u64);

    impl Sequence {
        /// From -1 to 1.
        fn next(&mut self) -> f32 {
            self.0 = self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
            (self.0 >> 40) as f32 / (1 << 23) as f32 - 1.0
        }
    }

    fn outline(sequence: &mut Sequence) -> Vertices {
        let size = 10.0f32.powf(sequence.next() * 3.0);
        let edges = 3 + ((sequence.next() + 1.0) * 12.0) as i32;
        let made = match (sequence.next() * 1.5) as i32 {
            -1 => Vertices::create_rectangle(size, size * (1.1 + sequence.next())),
            0 => Vertices::create_circle(size, edges),
            _ => Vertices::create_ellipse(size, size * (1.1 + sequence.next()), edges),
        };
        let mut outline = made.expect("sizes are positive");
        // Away from its own origin, too.
        outline.translate(Vector2::new(sequence.next(), sequence.next()) * size);
        outline
    }

    fn geom(number: u32, vertices: Vertices, centre: Vector2, rotation: f32, cells: f32) -> GeomEntry {
        let body: BodyId = Arena::<()>::default().insert(());
        assert_eq!(body.index(), 0);
        let mut geom = GeomEntry::new(number, body, Vector2::zeros(), 0.0);
        geom.set_vertices(vertices);
        geom.follow(centre, rotation);
        let cell = geom.aabb.get_shortest_side().max(1e-3) / cells;
        geom.grid =
            Some(Arc::new(DistanceGrid::new(geom.local_vertices.clone(), cell).expect("a small grid")));
        geom
    }

    /// The same geom with a grid that looks at every vertex.
    fn without_shortcuts(geom: &GeomEntry) -> GeomEntry {
        let grid = geom.grid.as_deref().expect("made above");
        let grid = DistanceGrid { box_slack: f32::INFINITY, reach_squared: f32::INFINITY, ..grid.clone() };
        let mut geom = geom.clone();
        geom.grid = Some(Arc::new(grid));
        geom
    }

    #[test]
    fn vertices_outside_of_box_and_reach_never_touch() {
        let mut sequence = Sequence(1);
        let mut touching = 0;
        let mut with_shortcuts = 0;
        for round in 0..6000 {
            let far = 10.0f32.powi(round % 7) * sequence.next();
            let a = geom(
                0,
                outline(&mut sequence),
                Vector2::new(far, -far),
                sequence.next() * 4.0,
                3.0 + 9.0 * sequence.next().abs(),
            );
            let b_outline = outline(&mut sequence);
            let reach = (a.aabb.width() + a.aabb.height()) * 0.4;
            let centre = a.aabb.get_center() + Vector2::new(sequence.next(), sequence.next()) * reach;
            let b = geom(1, b_outline, centre, sequence.next() * 4.0, 10.0);
            let (mut quick, mut thorough) = (Vec::new(), Vec::new());
            collide(&a, &b, -1, &mut quick);
            collide(&without_shortcuts(&a), &without_shortcuts(&b), -1, &mut thorough);
            let bits = |contacts: &[Contact]| -> Vec<_> {
                contacts
                    .iter()
                    .map(|c| (c.id, c.separation.to_bits(), c.normal.x.to_bits(), c.normal.y.to_bits()))
                    .collect()
            };
            assert_eq!(bits(&quick), bits(&thorough), "round {round}");
            touching += usize::from(!thorough.is_empty());
            with_shortcuts += usize::from(a.grid.as_ref().is_some_and(|grid| grid.box_slack.is_finite()));
        }
        assert!(
            touching > 1000 && with_shortcuts > 3000,
            "the pairs prove something: {touching}, {with_shortcuts}"
        );
    }

    #[test]
    fn concave_outlines_have_no_shortcuts() {
        let arrow = [[0.0, 0.0], [4.0, 4.0], [0.0, 1.0], [-4.0, 4.0]];
        let mut outline: Vertices = arrow.iter().map(|&[x, y]| Vector2::new(x, y)).collect();
        outline.force_counter_clockwise_order();
        let grid = DistanceGrid::new(outline, 0.25).expect("a small grid");
        assert_eq!((grid.box_slack, grid.reach_squared), (f32::INFINITY, f32::INFINITY));
    }
}
