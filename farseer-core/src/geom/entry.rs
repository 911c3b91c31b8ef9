//! A geom as the simulator stores it: its outline and its transform (behaviour chapter 05, section 3).

mod save;

pub(crate) use save::GeomMotion;

use std::sync::Arc;

use wide::f32x4;

use crate::body::BodyId;
use crate::geom::distance_grid::DistanceGrid;
use crate::geom::outline::Outline;
use crate::geom::{Geom, GeomId};
use crate::math::{Matrix, Vector2, scalar};
use crate::shape::{Aabb, Vertices};
use crate::storage::bits::Floats;
use crate::storage::collection::Collection;
use farseer_precise::pieces::Piece;
use farseer_precise::reusing_clone;

/// The elements of a 4x4 matrix that matter in the plane.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct PlaneMatrix {
    pub(crate) m11: f32,
    pub(crate) m12: f32,
    pub(crate) m21: f32,
    pub(crate) m22: f32,
    pub(crate) m41: f32,
    pub(crate) m42: f32,
}

impl PlaneMatrix {
    pub(crate) const IDENTITY: Self =
        PlaneMatrix { m11: 1.0, m12: 0.0, m21: 0.0, m22: 1.0, m41: 0.0, m42: 0.0 };

    #[inline(always)]
    pub(crate) fn apply(&self, p: Vector2) -> Vector2 {
        Vector2::new(p.x * self.m11 + p.y * self.m21 + self.m41, p.x * self.m12 + p.y * self.m22 + self.m42)
    }

    /// [`apply`](Self::apply) for every point, two at a time.
    fn apply_to_all(&self, points: &[Vector2], results: &mut [Vector2]) {
        let row1 = f32x4::new([self.m11, self.m12, self.m11, self.m12]);
        let row2 = f32x4::new([self.m21, self.m22, self.m21, self.m22]);
        let row4 = f32x4::new([self.m41, self.m42, self.m41, self.m42]);
        let (pairs, rest) = points.as_chunks::<2>();
        let (result_pairs, result_rest) = results.as_chunks_mut::<2>();
        for ([a, b], result) in pairs.iter().zip(result_pairs) {
            let x = f32x4::new([a.x, a.x, b.x, b.x]);
            let y = f32x4::new([a.y, a.y, b.y, b.y]);
            let [ax, ay, bx, by] = (x * row1 + y * row2 + row4).to_array();
            *result = [Vector2::new(ax, ay), Vector2::new(bx, by)];
        }
        for (&point, result) in rest.iter().zip(result_rest) {
            *result = self.apply(point);
        }
    }

    fn floats(&self) -> [f32; 6] {
        [self.m11, self.m12, self.m21, self.m22, self.m41, self.m42]
    }

    fn is_finite(&self) -> bool {
        self.floats().iter().all(|number| number.is_finite())
    }

    #[inline(always)]
    pub(crate) fn apply_normal(&self, n: Vector2) -> Vector2 {
        Vector2::new(n.x * self.m11 + n.y * self.m21, n.x * self.m12 + n.y * self.m22)
    }

    /// Inverse of a rotation with translation. Equal to the general 4x4 inverse in all bits but the sign of
    /// exact zeros, which no comparison of the engine can tell apart (behaviour chapter 05, section 3.7).
    #[inline]
    fn inverse(&self) -> Self {
        let k = 1.0 / (self.m11 * self.m22 + self.m12 * -self.m21);
        PlaneMatrix {
            m11: self.m22 * k,
            m12: -self.m12 * k,
            m21: -self.m21 * k,
            m22: self.m11 * k,
            m41: -(self.m21 * -self.m42 - self.m22 * -self.m41) * k,
            m42: (self.m11 * -self.m42 - self.m12 * -self.m41) * k,
        }
    }

    fn from_matrix(matrix: &Matrix) -> Self {
        PlaneMatrix {
            m11: matrix.m11,
            m12: matrix.m12,
            m21: matrix.m21,
            m22: matrix.m22,
            m41: matrix.m41,
            m42: matrix.m42,
        }
    }

    pub(crate) fn to_matrix(self) -> Matrix {
        #[rustfmt::skip]
        let matrix = Matrix::new(
            self.m11, self.m12, 0.0, 0.0,
            self.m21, self.m22, 0.0, 0.0,
            0.0,      0.0,      1.0, 0.0,
            self.m41, self.m42, 0.0, 1.0,
        );
        matrix
    }
}

/// A geom's transform, computed from its body's pose.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct GeomPose {
    pub(crate) matrix: PlaneMatrix,
    pub(crate) inverse: PlaneMatrix,
    pub(crate) position: Vector2,
    pub(crate) rotation: f32,
}

impl GeomPose {
    const IDENTITY: Self = GeomPose {
        matrix: PlaneMatrix::IDENTITY,
        inverse: PlaneMatrix::IDENTITY,
        position: Vector2::new(0.0, 0.0),
        rotation: 0.0,
    };

    /// The transform of a geom on a body (behaviour chapter 05, section 3.6).
    #[inline]
    pub(crate) fn of_body(position: Vector2, rotation: f32, offset: Vector2, rotation_offset: f32) -> Self {
        let angle = rotation + rotation_offset;
        let (s, c) = scalar::sin_cos(angle);
        let mut matrix = PlaneMatrix { m11: c, m12: s, m21: -s, m22: c, m41: 0.0, m42: 0.0 };
        let offset = matrix.apply(offset);
        matrix.m41 = position.x + offset.x;
        matrix.m42 = position.y + offset.y;
        GeomPose {
            matrix,
            inverse: matrix.inverse(),
            position: Vector2::new(matrix.m41, matrix.m42),
            rotation: angle,
        }
    }
}

impl GeomPose {
    fn is_finite(&self) -> bool {
        self.matrix.is_finite()
            && self.inverse.is_finite()
            && is_finite(&self.position)
            && self.rotation.is_finite()
    }
}

impl Floats for GeomPose {
    fn to_floats(&self) -> Vec<f32> {
        let GeomPose { matrix, inverse, position, rotation } = self;
        [&matrix.floats()[..], &inverse.floats(), &[position.x, position.y, *rotation]].concat()
    }

    fn from_floats(floats: &[f32]) -> Option<Self> {
        let matrix = |from: usize| {
            let [m11, m12, m21, m22, m41, m42] = <[f32; 6]>::try_from(floats.get(from..from + 6)?).ok()?;
            Some(PlaneMatrix { m11, m12, m21, m22, m41, m42 })
        };
        let (matrix, inverse) = (matrix(0)?, matrix(6)?);
        let [x, y, rotation] = <[f32; 3]>::try_from(floats.get(12..)?).ok()?;
        Some(GeomPose { matrix, inverse, position: Vector2::new(x, y), rotation })
    }
}

fn is_finite(v: &Vector2) -> bool {
    v.x.is_finite() && v.y.is_finite()
}

/// The sum of all points in four partial sums: four points at a time and without a branch for each.
#[inline(always)]
fn sum_of(points: &[Vector2]) -> f32x4 {
    let pair = |a: &Vector2, b: &Vector2| f32x4::new([a.x, a.y, b.x, b.y]);
    let (fours, rest) = points.as_chunks::<4>();
    let rest = rest.iter().fold(f32x4::ZERO, |sum, point| sum + pair(point, point));
    fours.iter().fold(rest, |sum, [a, b, c, d]| sum + pair(a, b) + pair(c, d))
}

/// Tolerance of the squared length of a unit vector, dimensionless: each coordinate is rounded once.
const UNIT_LENGTH_TOLERANCE: f32 = 4.0 * f32::EPSILON;

/// The outline of a geom in the world at some pose of its body.
#[derive(Debug, Clone, Copy)]
pub(crate) struct WorldOutline<'a> {
    pub(crate) vertices: &'a [Vector2],
    pub(crate) aabb: Aabb,
    pub(crate) matrix: PlaneMatrix,
}

/// The geoms of a simulator.
pub(crate) type Geoms = Collection<GeomEntry, GeomId>;

/// A geom in the simulator.
#[derive(Debug)]
pub(crate) struct GeomEntry {
    pub(crate) geom: Geom,
    /// Creation number, never reused: decides which geom of a pair is A, and enters contact ids.
    pub(crate) number: u32,
    /// Index in the geom list at the start of the current update; stale in between, as in the original.
    pub(crate) collision_id: i32,
    pub(crate) body: BodyId,
    pub(crate) offset: Vector2,
    pub(crate) rotation_offset: f32,
    pub(crate) grid_cell_size: f32,
    /// The shape for which the polygon stands.
    pub(crate) outline: Outline,
    pub(crate) local_vertices: Vertices,
    pub(crate) world_vertices: Vertices,
    pub(crate) aabb: Aabb,
    /// Radius in length units of a disc about the geom's origin whose box is the geom's box, for engines that collide
    /// true circles.
    pub(crate) box_radius: Option<f32>,
    pub(crate) pose: GeomPose,
    /// A matrix set by the user, until the body moves next.
    pub(crate) user_matrix: Option<Box<Matrix>>,
    /// Whether vertices or matrix were set since the body last moved. The transform is then updated even if the body's
    /// pose is unchanged.
    pub(crate) refresh_is_due: bool,
    pub(crate) grid: Option<Arc<DistanceGrid>>,
    /// Whether the grid was made from the present outline; the grid stays when the outline is replaced.
    pub(crate) grid_fits_outline: bool,
    /// The convex parts of the outline, computed at the first request.
    pub(crate) pieces: std::sync::OnceLock<Arc<[Piece]>>,
    pub(crate) in_simulation: bool,
    pub(crate) is_sensor: bool,
    /// For a one-way geom: outward direction of its solid side, a unit vector in the body's coordinates. From all other
    /// sides shapes pass through.
    pub(crate) one_way: Option<Vector2>,
    /// Whether the game has borrowed the geom mutably since edits were last applied.
    pub(crate) is_touched: bool,
    /// Creation numbers of other geoms and whether collision with them is ignored.
    ignored: Vec<(u32, bool)>,
    /// Number of changes of the ignored geoms, wrapping, to detect edits.
    pub(crate) ignore_changes: i32,
}

reusing_clone! {
    GeomEntry {
        geom, number, collision_id, body, offset, rotation_offset, grid_cell_size, outline,
        local_vertices, world_vertices, aabb, box_radius, pose, user_matrix, refresh_is_due, grid,
        grid_fits_outline, pieces, in_simulation, is_sensor, one_way, is_touched, ignored, ignore_changes
    }
}

impl GeomEntry {
    pub(crate) fn new(number: u32, body: BodyId, offset: Vector2, rotation_offset: f32) -> Self {
        GeomEntry {
            geom: Geom::default(),
            number,
            collision_id: 0,
            body,
            offset,
            rotation_offset,
            grid_cell_size: 0.0,
            outline: Outline::Polygon,
            local_vertices: Vertices::default(),
            world_vertices: Vertices::default(),
            aabb: Aabb::default(),
            box_radius: None,
            pose: GeomPose::IDENTITY,
            user_matrix: None,
            refresh_is_due: false,
            grid: None,
            grid_fits_outline: false,
            pieces: std::sync::OnceLock::new(),
            in_simulation: true,
            is_sensor: false,
            one_way: None,
            is_touched: false,
            ignored: Vec::new(),
            ignore_changes: 0,
        }
    }

    /// Sets a polygon as the outline.
    pub(crate) fn set_vertices(&mut self, vertices: Vertices) {
        self.set_outline(vertices, Outline::Polygon);
    }

    /// Sets the outline. Until the body moves next, world vertices and box are the local ones.
    pub(crate) fn set_outline(&mut self, mut vertices: Vertices, outline: Outline) {
        if !outline.is_chain() {
            vertices.force_counter_clockwise_order();
        }
        self.outline = outline;
        self.world_vertices.clone_from(&vertices);
        self.local_vertices = vertices;
        self.pieces = std::sync::OnceLock::new();
        self.aabb = self.box_around(&self.local_vertices, Vector2::zeros());
        self.refresh_is_due = true;
        self.update_grid_fits_outline();
    }

    /// Sets the distance grid.
    pub(crate) fn set_grid(&mut self, grid: Arc<DistanceGrid>) {
        self.grid = Some(grid);
        self.update_grid_fits_outline();
    }

    /// Computes whether the grid was made from the present outline. Grid and outline determine it, so it is not saved.
    fn update_grid_fits_outline(&mut self) {
        let same =
            |(a, b): (&Vector2, &Vector2)| a.x.to_bits() == b.x.to_bits() && a.y.to_bits() == b.y.to_bits();
        self.grid_fits_outline = self.grid.as_ref().is_some_and(|grid| {
            let outline = grid.outline();
            outline.len() == self.local_vertices.len()
                && outline.iter().zip(self.local_vertices.iter()).all(same)
        });
    }

    /// Updates matrix, world vertices and box for a pose of the body.
    pub(crate) fn update_transform(&mut self, position: Vector2, rotation: f32) {
        self.set_pose(GeomPose::of_body(position, rotation, self.offset, self.rotation_offset));
    }

    #[inline(always)]
    pub(crate) fn set_pose(&mut self, pose: GeomPose) {
        self.pose = pose;
        self.user_matrix = None;
        self.refresh_is_due = false;
        self.refresh();
    }

    /// Replaces the matrix until the body moves next. Position and rotation stay, as in the original.
    pub(crate) fn set_matrix(&mut self, matrix: &Matrix) {
        self.pose.matrix = PlaneMatrix::from_matrix(matrix);
        self.pose.inverse = PlaneMatrix::from_matrix(&crate::math::matrix::invert(matrix));
        self.user_matrix = Some(Box::new(*matrix));
        self.refresh_is_due = true;
        self.refresh();
    }

    /// Recomputes world vertices and box from the matrix.
    pub(crate) fn refresh(&mut self) {
        self.pose.matrix.apply_to_all(&self.local_vertices, &mut self.world_vertices);
        self.aabb = self.box_around(&self.world_vertices, self.pose.position);
    }

    /// The outline in the world as it is stored.
    pub(crate) fn world_outline(&self) -> WorldOutline<'_> {
        WorldOutline { vertices: &self.world_vertices, aabb: self.aabb, matrix: self.pose.matrix }
    }

    /// The outline at a pose, as [`set_pose`](Self::set_pose) would store it. `vertices` is room for as many points as the
    /// outline has. `None` where the geom would not be finite.
    #[inline]
    pub(crate) fn outline_at<'a>(
        &self,
        pose: &GeomPose,
        vertices: &'a mut [Vector2],
    ) -> Option<WorldOutline<'a>> {
        pose.matrix.apply_to_all(&self.local_vertices, vertices);
        let aabb = self.box_around(vertices, pose.position);
        let back = pose.inverse;
        // Any infinity or NaN makes a product, and with it the sum, NaN. Sums of finite numbers need not be finite.
        let zero = f32x4::ZERO;
        let sum = sum_of(vertices) * zero
            + f32x4::new([pose.position.x, pose.position.y, back.m41, back.m42]) * zero
            + f32x4::new([aabb.min.x, aabb.min.y, aabb.max.x, aabb.max.y]) * zero;
        sum.simd_eq(zero).all().then_some(WorldOutline { vertices, aabb, matrix: pose.matrix })
    }

    /// The box of an outline in world coordinates with its origin at `origin`.
    #[inline]
    pub(crate) fn box_around(&self, outline: &[Vector2], origin: Vector2) -> Aabb {
        match self.box_radius {
            None => Aabb::from_vertices(outline),
            Some(radius) => {
                let reach = Vector2::new(radius, radius);
                Aabb::new(origin - reach, origin + reach)
            }
        }
    }

    pub(crate) fn set_box_radius(&mut self, radius: Option<f32>) {
        self.box_radius = radius;
        self.aabb = self.box_around(&self.world_vertices, self.pose.position);
    }

    /// Whether outline and box in the world, and the inverse transform, are finite.
    #[inline]
    pub(crate) fn pose_is_finite(&self) -> bool {
        let Aabb { min, max } = self.aabb;
        let (position, back) = (self.pose.position, self.pose.inverse);
        // Any infinity or NaN makes a product, and with it the sum, NaN.
        let zero = f32x4::ZERO;
        let mut sum = f32x4::new([min.x, min.y, max.x, max.y]) * zero
            + f32x4::new([position.x, position.y, back.m41, back.m42]) * zero;
        // The box around an outline is finite where the outline is; the box of a disc does not depend on the outline.
        if self.box_radius.is_some() {
            sum += sum_of(&self.world_vertices) * zero;
        }
        sum.simd_eq(zero).all() || self.large_pose_is_finite()
    }

    /// As [`pose_is_finite`](Self::pose_is_finite), number by number: sums of finite numbers need not be finite.
    #[cold]
    fn large_pose_is_finite(&self) -> bool {
        let (Aabb { min, max }, GeomPose { position, inverse, .. }) = (self.aabb, self.pose);
        let numbers = [min.x, min.y, max.x, max.y, position.x, position.y, inverse.m41, inverse.m42];
        numbers.iter().all(|number| number.is_finite()) && self.world_vertices.iter().all(is_finite)
    }

    /// Whether the geom would be finite with its body at this pose.
    pub(crate) fn would_be_finite_at(&self, position: Vector2, rotation: f32) -> bool {
        let pose = GeomPose::of_body(position, rotation, self.offset, self.rotation_offset);
        let is_finite_there = |vertex: &Vector2| is_finite(&pose.matrix.apply(*vertex));
        let disc = self.box_around(&[], pose.position);
        is_finite(&pose.position)
            && is_finite(&Vector2::new(pose.inverse.m41, pose.inverse.m42))
            && self.local_vertices.iter().all(is_finite_there)
            && (self.box_radius.is_none() || is_finite(&disc.min) && is_finite(&disc.max))
    }

    pub(crate) fn ignores(&self, number: u32) -> bool {
        self.ignored.iter().any(|&(other, ignored)| other == number && ignored)
    }

    /// Whether collisions with some other geom are ignored.
    #[cfg(feature = "precise")]
    pub(crate) fn ignores_some(&self) -> bool {
        self.ignored.iter().any(|&(_, ignored)| ignored)
    }

    pub(crate) fn set_ignored(&mut self, number: u32, ignored: bool) {
        self.ignore_changes = self.ignore_changes.wrapping_add(1);
        match self.ignored.iter_mut().find(|(other, _)| *other == number) {
            Some(entry) => entry.1 = ignored,
            None if ignored => self.ignored.push((number, true)),
            None => {}
        }
    }

    /// Whether all numbers used in arithmetic are finite. False only after loading corrupt data.
    pub(crate) fn is_valid(&self) -> bool {
        let matrix_is_finite = |matrix: &Matrix| matrix.iter().all(|element| element.is_finite());
        !self.local_vertices.is_empty()
            && self.local_vertices.len() == self.world_vertices.len()
            && self.local_vertices.iter().all(is_finite)
            && self.world_vertices.iter().all(is_finite)
            && self.pose.is_finite()
            && self.user_matrix.as_deref().is_none_or(matrix_is_finite)
            && self.outline.fits(&self.local_vertices)
            && self.pose_is_finite()
            && is_finite(&self.offset)
            && self.rotation_offset.is_finite()
            && self.geom.is_finite()
            && self.grid_cell_size.is_finite()
            && self.one_way.is_none_or(|direction| {
                (direction.x * direction.x + direction.y * direction.y - 1.0).abs() < UNIT_LENGTH_TOLERANCE
            })
            && self.box_radius.is_none_or(|radius| radius.is_finite() && radius > 0.0)
    }
}
