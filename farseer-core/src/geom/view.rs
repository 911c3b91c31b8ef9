//! A geom as users see it (behaviour chapter 05, section 3).

use crate::body::BodyId;
use crate::body::entry::BodyEntry;
use crate::geom::Geom;
use crate::geom::distance_grid::DistanceGrid;
use crate::geom::entry::{GeomEntry, GeomPose};
use crate::geom::outline::Outline;
use crate::math::vector2::{transform, transform_normal};
use crate::math::{Matrix, Vector2};
use crate::shape::Feature;
use crate::shape::distance::{nearest_distance, nearest_feature};
use crate::shape::{Aabb, Vertices};
use crate::storage::collection::Life;

/// A geom as it lies in the world: shape, place and settings.
#[derive(Debug, Clone, Copy)]
#[doc(alias = "Geom")]
pub struct GeomRef<'a> {
    pub(crate) entry: &'a GeomEntry,
    pub(crate) life: Life,
    /// What it is attached to; nothing while the body is a disposed one that is gone.
    pub(crate) body: Option<&'a BodyEntry>,
}

impl std::ops::Deref for GeomRef<'_> {
    type Target = Geom;
    fn deref(&self) -> &Geom {
        &self.entry.geom
    }
}

impl<'a> GeomRef<'a> {
    /// Where it will lie if the body was moved and the geom has not followed yet.
    #[inline]
    pub(crate) fn pending(&self) -> Option<GeomPose> {
        let (position, rotation) = self.body?.pending_pose()?;
        self.pose_at(position, rotation)
    }

    /// Nothing where the geom would not be finite: that is not going to be followed, the body will be put back.
    #[cold]
    fn pose_at(&self, position: Vector2, rotation: f32) -> Option<GeomPose> {
        let GeomEntry { offset, rotation_offset, .. } = *self.entry;
        let is_finite = self.entry.would_be_finite_at(position, rotation);
        is_finite.then(|| GeomPose::of_body(position, rotation, offset, rotation_offset))
    }

    #[cold]
    fn vertices_at(&self, pose: &GeomPose) -> Vertices {
        self.entry.local_vertices.iter().map(|&vertex| pose.matrix.apply(vertex)).collect()
    }

    #[cold]
    fn box_at(&self, pose: &GeomPose) -> Aabb {
        match self.entry.box_radius {
            Some(_) => self.entry.box_around(&[], pose.position),
            None => {
                let vertices = self.entry.local_vertices.iter();
                Aabb::from_points(vertices.map(|&vertex| pose.matrix.apply(vertex)))
            }
        }
    }

    /// Creation number, counted from 0 per simulator and never reused. Of two geoms that touch, the one with
    /// the smaller number is A.
    #[doc(alias = "Id")]
    pub fn id(&self) -> u32 {
        self.entry.number
    }

    /// Index in the geom list at the start of the last update.
    #[doc(alias = "CollisionId")]
    pub fn collision_id(&self) -> i32 {
        self.entry.collision_id
    }

    /// The body it is attached to.
    #[doc(alias = "Body")]
    #[inline]
    pub fn body(&self) -> BodyId {
        self.entry.body
    }

    /// Position on the body, in the body's coordinates and the user's length unit.
    #[doc(alias = "Offset")]
    pub fn offset(&self) -> Vector2 {
        self.entry.offset
    }

    /// Rotation against the body in radians.
    #[doc(alias = "RotationOffset")]
    pub fn rotation_offset(&self) -> f32 {
        self.entry.rotation_offset
    }

    /// Whether it is in the [geom list](crate::PhysicsSimulator::geom_list) now. Objects enter and leave their lists
    /// with updates.
    pub fn is_listed(&self) -> bool {
        self.life.is_listed
    }

    /// False after removal from the simulation, until it is added again.
    #[doc(alias = "InSimulation")]
    pub fn in_simulation(&self) -> bool {
        self.entry.in_simulation
    }

    /// Whether the geom was last made a sensor.
    #[doc(alias = "IsSensor")]
    pub fn is_sensor(&self) -> bool {
        self.entry.is_sensor
    }

    /// The direction out of the side that holds, in the frame of the body and of length 1, if the geom is
    /// [open from all others](crate::Objects::set_one_way).
    pub fn one_way(&self) -> Option<Vector2> {
        self.entry.one_way
    }

    /// Whether it was disposed and goes at the next update.
    #[doc(alias = "IsDisposed")]
    pub fn is_disposed(&self) -> bool {
        self.life.is_disposed
    }

    /// Edge of a distance grid cell in the user's length unit; what was asked for under SAT.
    #[doc(alias("GridCellSize", "CollisionGridCellSize", "CalculateGridCellSizeFromAABB"))]
    pub fn grid_cell_size(&self) -> f32 {
        self.entry.grid_cell_size
    }

    /// The distance grid, if there is one.
    #[doc(alias = "DistanceGridData")]
    pub fn distance_grid(&self) -> Option<&'a DistanceGrid> {
        self.entry.grid.as_deref()
    }

    /// What the polygon of the geom stands for. A copy has that of its original; other
    /// [vertices](crate::PhysicsSimulator::set_vertices) stand for themselves.
    pub fn outline(&self) -> Outline {
        self.entry.outline
    }

    /// The outline in the geom's own coordinates, in the engine's winding.
    #[doc(alias = "LocalVertices")]
    pub fn local_vertices(&self) -> &'a Vertices {
        &self.entry.local_vertices
    }

    /// The outline in the world.
    #[doc(alias = "WorldVertices")]
    #[inline]
    pub fn world_vertices(&self) -> std::borrow::Cow<'a, Vertices> {
        match self.pending() {
            None => std::borrow::Cow::Borrowed(&self.entry.world_vertices),
            Some(pose) => std::borrow::Cow::Owned(self.vertices_at(&pose)),
        }
    }

    /// The box around the outline in the world.
    #[doc(alias = "AABB")]
    #[inline]
    pub fn aabb(&self) -> Aabb {
        match self.pending() {
            None => self.entry.aabb,
            Some(pose) => self.box_at(&pose),
        }
    }

    /// Radius of the disc whose box [`aabb`](Self::aabb) is, if that was
    /// [set](crate::PhysicsSimulator::set_box_radius).
    pub fn box_radius(&self) -> Option<f32> {
        self.entry.box_radius
    }

    /// World position of the geom's origin.
    #[doc(alias = "Position")]
    #[inline]
    pub fn position(&self) -> Vector2 {
        self.pending().map_or(self.entry.pose.position, |pose| pose.position)
    }

    /// The body's rotation plus the rotation offset, in radians.
    #[doc(alias = "Rotation")]
    #[inline]
    pub fn rotation(&self) -> f32 {
        self.pending().map_or(self.entry.pose.rotation, |pose| pose.rotation)
    }

    /// From the geom's own coordinates to the world.
    #[doc(alias = "Matrix")]
    #[inline]
    pub fn matrix(&self) -> Matrix {
        match (&self.entry.user_matrix, self.pending()) {
            (Some(matrix), None) => **matrix,
            (_, pending) => pending.map_or(self.entry.pose.matrix, |pose| pose.matrix).to_matrix(),
        }
    }

    /// From the world to the geom's own coordinates.
    #[doc(alias = "MatrixInverse")]
    pub fn matrix_inverse(&self) -> Matrix {
        crate::math::matrix::invert(&self.matrix())
    }

    /// World position of a point in the geom's coordinates.
    #[doc(alias = "GetWorldPosition")]
    pub fn get_world_position(&self, local: Vector2) -> Vector2 {
        transform(local, &self.matrix())
    }

    /// Position in the geom's coordinates of a point of the world.
    #[doc(alias = "TransformToLocalCoordinates")]
    pub fn transform_to_local_coordinates(&self, world: Vector2) -> Vector2 {
        transform(world, &self.matrix_inverse())
    }

    /// A direction in the geom's coordinates, turned into the world.
    #[doc(alias = "TransformNormalToWorld")]
    pub fn transform_normal_to_world(&self, normal: Vector2) -> Vector2 {
        transform_normal(normal, &self.matrix())
    }

    /// Whether collision with the geom of this creation number is ignored from this side.
    #[doc(alias = "IsGeometryIgnored")]
    pub fn is_geometry_ignored(&self, other: GeomRef<'_>) -> bool {
        self.entry.ignores(other.id())
    }

    /// Signed distance to the outline of a point in the geom's coordinates, negative inside. A chain counts as if it were
    /// closed here.
    #[doc(alias = "GetNearestDistance")]
    pub fn get_nearest_distance(&self, point: Vector2) -> f32 {
        nearest_distance(&self.entry.local_vertices, point)
    }

    /// The nearest point of edge `index` to a point in the geom's coordinates.
    ///
    /// # Panics
    /// If there is no edge `index`, as slices do.
    #[doc(alias = "GetNearestFeature")]
    pub fn get_nearest_feature(&self, point: Vector2, index: usize) -> Feature {
        nearest_feature(&self.entry.local_vertices, point, index)
    }
}
