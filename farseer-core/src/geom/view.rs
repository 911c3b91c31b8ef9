//! Read access to a geom (behaviour chapter 05, section 3).

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
use crate::storage::collection::LifecycleState;

/// A geom in the world: shape, pose and settings.
#[derive(Debug, Clone, Copy)]
#[doc(alias = "Geom")]
pub struct GeomRef<'a> {
    pub(crate) entry: &'a GeomEntry,
    pub(crate) life: LifecycleState,
    /// The body of the geom; `None` if the body was disposed and has been removed.
    pub(crate) body: Option<&'a BodyEntry>,
}

impl std::ops::Deref for GeomRef<'_> {
    type Target = Geom;
    fn deref(&self) -> &Geom {
        &self.entry.geom
    }
}

impl<'a> GeomRef<'a> {
    /// The transform that follows from the body's pose, if the body was moved and the geom has not been updated yet.
    #[inline]
    pub(crate) fn pending(&self) -> Option<GeomPose> {
        let (position, rotation) = self.body?.pending_pose()?;
        self.pose_at(position, rotation)
    }

    /// `None` where the geom would not be finite: it will not be moved there, and the body will be put back.
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

    /// Creation number, counted from 0 per simulator and never reused. Of two geoms that touch, the one with the
    /// smaller number is A.
    #[doc(alias = "Id")]
    pub fn id(&self) -> u32 {
        self.entry.number
    }

    /// Index in the geom list at the start of the last update.
    #[doc(alias = "CollisionId")]
    pub fn collision_id(&self) -> i32 {
        self.entry.collision_id
    }

    /// The body of the geom.
    #[doc(alias = "Body")]
    #[inline]
    pub fn body(&self) -> BodyId {
        self.entry.body
    }

    /// Position on the body, in the body's coordinates, in length units.
    #[doc(alias = "Offset")]
    pub fn offset(&self) -> Vector2 {
        self.entry.offset
    }

    /// Rotation relative to the body, in radians.
    #[doc(alias = "RotationOffset")]
    pub fn rotation_offset(&self) -> f32 {
        self.entry.rotation_offset
    }

    /// Whether the geom is in the [geom list](crate::PhysicsSimulator::geom_list) now. Objects enter and leave their
    /// lists with updates.
    pub fn is_listed(&self) -> bool {
        self.life.is_listed
    }

    /// False after removal from the simulation, until it is added again.
    #[doc(alias = "InSimulation")]
    pub fn in_simulation(&self) -> bool {
        self.entry.in_simulation
    }

    /// Whether the last call of `set_is_sensor` made the geom a sensor.
    #[doc(alias = "IsSensor")]
    pub fn is_sensor(&self) -> bool {
        self.entry.is_sensor
    }

    /// Outward direction of the solid side, as a unit vector in the body's coordinates, if the geom is
    /// [one-way](crate::Objects::set_one_way).
    pub fn one_way(&self) -> Option<Vector2> {
        self.entry.one_way
    }

    /// Whether the geom was disposed and will be removed in the next update.
    #[doc(alias = "IsDisposed")]
    pub fn is_disposed(&self) -> bool {
        self.life.is_disposed
    }

    /// Edge of a distance grid cell, in length units; under SAT the value that was given.
    #[doc(alias("GridCellSize", "CollisionGridCellSize", "CalculateGridCellSizeFromAABB"))]
    pub fn grid_cell_size(&self) -> f32 {
        self.entry.grid_cell_size
    }

    /// The distance grid, if there is one.
    #[doc(alias = "DistanceGridData")]
    pub fn distance_grid(&self) -> Option<&'a DistanceGrid> {
        self.entry.grid.as_deref()
    }

    /// The shape for which the polygon of the geom stands. A copy has the outline of its original; a geom with other
    /// [vertices](crate::PhysicsSimulator::set_vertices) is a polygon.
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

    /// Radius in length units of the disc whose box is [`aabb`](Self::aabb), if it was
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

    /// Transform from the geom's own coordinates to the world.
    #[doc(alias = "Matrix")]
    #[inline]
    pub fn matrix(&self) -> Matrix {
        match (&self.entry.user_matrix, self.pending()) {
            (Some(matrix), None) => **matrix,
            (_, pending) => pending.map_or(self.entry.pose.matrix, |pose| pose.matrix).to_matrix(),
        }
    }

    /// Transform from the world to the geom's own coordinates.
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

    /// A direction in the geom's coordinates, rotated into the world.
    #[doc(alias = "TransformNormalToWorld")]
    pub fn transform_normal_to_world(&self, normal: Vector2) -> Vector2 {
        transform_normal(normal, &self.matrix())
    }

    /// Whether this geom ignores collisions with the `other` geom.
    #[doc(alias = "IsGeometryIgnored")]
    pub fn is_geometry_ignored(&self, other: GeomRef<'_>) -> bool {
        self.entry.ignores(other.id())
    }

    /// Signed distance of a point in the geom's coordinates from the outline, in length units, negative inside. A chain
    /// is treated as a closed polygon here.
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
