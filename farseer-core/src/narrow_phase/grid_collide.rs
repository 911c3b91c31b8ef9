//! Narrow phase with distance grids: contacts of vertices with the sampled outline (behaviour chapter 06, section 4).

use wide::f32x4;

use crate::contacts::contact::{Contact, ContactId};
use crate::geom::distance_grid::DistanceGrid;
use crate::geom::entry::GeomEntry;
use crate::math::Vector2;
use crate::shape::Aabb;

impl DistanceGrid {
    /// The world box outside of which no point can touch the geom; `None` if unknown.
    #[inline]
    fn hit_box(&self, geom: &GeomEntry) -> Option<Aabb> {
        let world = geom.aabb;
        if self.box_slack == f32::INFINITY || geom.refresh_is_due || !geom.grid_fits_outline {
            return None;
        }
        let size = |v: Vector2| v.x.abs().max(v.y.abs());
        let largest =
            size(world.min).max(size(world.max)).max(size(self.aabb().min)).max(size(self.aabb().max));
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

/// Contacts of the vertices of `owner` in the grid of `other`. Vertex numbers start at `first_number`; normals are
/// multiplied by `direction` so that they point from A to B.
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
    for (chunk_index, chunk) in owner.world_vertices.chunks(VERTICES_PER_SET).enumerate() {
        let mut candidates = match &hit_box {
            Some(hit_box) => inside_box(chunk, hit_box),
            None => u32::MAX >> (VERTICES_PER_SET - chunk.len()),
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
                let number = first_number + (chunk_index * VERTICES_PER_SET + i) as i32;
                let id = ContactId { geom1: owner.number, vertex: number, geom2: other.number };
                contacts.push(Contact::new(vertex, normal, feature.distance, id));
            }
        }
    }
}

/// Number of vertices in a bit set of [`inside_box`].
const VERTICES_PER_SET: usize = 32;

/// For each bit mask of excluded coordinates among eight: bit mask of the vertices, of four, without an excluded one.
const NOT_EXCLUDED: [u8; 256] = {
    let mut table = [0; 256];
    let mut excluded = 0;
    while excluded < 256 {
        let mut vertex = 0;
        while vertex < 4 {
            if (excluded >> (2 * vertex)) & 0b11 == 0 {
                table[excluded] |= 1 << vertex;
            }
            vertex += 1;
        }
        excluded += 1;
    }
    table
};

/// The set of vertices, of at most [`VERTICES_PER_SET`], that a box does not exclude.
#[inline]
fn inside_box(vertices: &[Vector2], aabb: &Aabb) -> u32 {
    let low = f32x4::new([aabb.min.x, aabb.min.y, aabb.min.x, aabb.min.y]);
    let high = f32x4::new([aabb.max.x, aabb.max.y, aabb.max.x, aabb.max.y]);
    let excluded = |two: &[Vector2; 2]| {
        let coordinates = f32x4::new([two[0].x, two[0].y, two[1].x, two[1].y]);
        (coordinates.simd_lt(low) | coordinates.simd_gt(high)).to_bitmask()
    };
    let mut inside = 0;
    let (pairs, last) = vertices.as_chunks::<2>();
    let (fours, rest) = pairs.as_chunks::<2>();
    for (i, [first, second]) in fours.iter().enumerate() {
        let excluded = excluded(first) | excluded(second) << 4;
        inside |= u32::from(NOT_EXCLUDED[excluded as usize & 0xFF]) << (4 * i);
    }
    if let [pair] = rest {
        let outside_of_list = 0b1111 << 4;
        inside |=
            u32::from(NOT_EXCLUDED[(excluded(pair) | outside_of_list) as usize & 0xFF]) << (4 * fours.len());
    }
    if let [last] = last {
        inside |= u32::from(excluded(&[*last; 2]) == 0) << (vertices.len() - 1);
    }
    inside
}

#[cfg(test)]
mod tests {
    use std::sync::Arc;

    use super::*;
    use crate::body::BodyId;
    use crate::shape::Vertices;
    use crate::storage::arena::Id;

    /// A pseudo-random sequence.
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
        // The outline also lies off its own origin.
        outline.translate(Vector2::new(sequence.next(), sequence.next()) * size);
        outline
    }

    fn geom(number: u32, vertices: Vertices, centre: Vector2, rotation: f32, cells: f32) -> GeomEntry {
        let body = BodyId::new(0, 0);
        let mut geom = GeomEntry::new(number, body, Vector2::zeros(), 0.0);
        geom.set_vertices(vertices);
        geom.update_transform(centre, rotation);
        let cell = geom.aabb.get_shortest_side().max(1e-3) / cells;
        geom.grid =
            Some(Arc::new(DistanceGrid::new(geom.local_vertices.clone(), cell).expect("a small grid")));
        geom
    }

    /// The same geom with a grid that tests every vertex.
    fn without_shortcuts(geom: &GeomEntry) -> GeomEntry {
        let grid = geom.grid.as_deref().expect("made above");
        let mut grid = grid.clone();
        (grid.box_slack, grid.hit_radius_squared) = (f32::INFINITY, f32::INFINITY);
        let mut geom = geom.clone();
        geom.grid = Some(Arc::new(grid));
        geom
    }

    #[test]
    fn vertices_outside_of_box_and_hit_radius_never_touch() {
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
        assert_eq!((grid.box_slack, grid.hit_radius_squared), (f32::INFINITY, f32::INFINITY));
    }
}
