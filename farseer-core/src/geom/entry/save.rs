//! Saving of a geom: its transform is computed anew when it is loaded.

use std::sync::Arc;

use serde::{Deserialize, Deserializer, Serialize, Serializer};

use super::{GeomEntry, GeomPose, PlaneMatrix};
use crate::body::BodyId;
use crate::geom::distance_grid::DistanceGrid;
use crate::geom::outline::Outline;
use crate::geom::{Geom, GeomArguments};
use crate::math::{Matrix, Vector2};
use crate::shape::{Aabb, Vertices};
use crate::storage::rejected_arguments::RejectedArguments;

/// The saved fields of a geom, as of [`GeomEntry`].
#[derive(Serialize, Deserialize)]
#[serde(remote = "GeomEntry")]
struct SavedGeom {
    geom: Geom,
    number: u32,
    collision_id: i32,
    body: BodyId,
    offset: Vector2,
    rotation_offset: f32,
    grid_cell_size: f32,
    outline: Outline,
    local_vertices: Vertices,
    #[serde(getter = "SavedTransform::of")]
    transform: SavedTransform,
    box_radius: Option<f32>,
    user_matrix: Option<Box<Matrix>>,
    refresh_is_due: bool,
    #[serde(with = "crate::geom::distance_grid::as_outline")]
    grid: Option<Arc<DistanceGrid>>,
    in_simulation: bool,
    is_sensor: bool,
    one_way: Option<Vector2>,
    is_touched: bool,
    ignored: Vec<(u32, bool)>,
    ignore_changes: i32,
}

/// Saved transform of a geom: matrix, outline and box in the world.
#[derive(Serialize, Deserialize)]
enum SavedTransform {
    /// That of a pose of its body. Matrix, outline and box follow from these numbers bit for bit.
    OfBody {
        /// Cosine and sine of the rotation.
        cos_sin: [f32; 2],
        /// Origin of the geom in the world, length units.
        position: Vector2,
        /// Rotation of the body plus that of the geom on it, radians.
        rotation: f32,
    },
    /// Any other: the game has set vertices or matrix since the body moved last.
    Own {
        #[serde(with = "crate::storage::bits")]
        world_vertices: Vertices,
        #[serde(with = "crate::storage::bits")]
        aabb: Aabb,
        #[serde(with = "crate::storage::bits")]
        pose: GeomPose,
    },
}

impl SavedTransform {
    fn of(entry: &GeomEntry) -> Self {
        let PlaneMatrix { m11, m12, m21, m22, m41, m42 } = entry.pose.matrix;
        let bits = |numbers: [f32; 4]| numbers.map(f32::to_bits);
        let position = entry.pose.position;
        let is_of_body = !entry.refresh_is_due
            && entry.user_matrix.is_none()
            && bits([m21, m22, m41, m42]) == bits([-m12, m11, position.x, position.y]);
        if is_of_body {
            SavedTransform::OfBody { cos_sin: [m11, m12], position, rotation: entry.pose.rotation }
        } else {
            let world_vertices = entry.world_vertices.clone();
            SavedTransform::Own { world_vertices, aabb: entry.aabb, pose: entry.pose }
        }
    }
}

impl From<SavedGeom> for GeomEntry {
    fn from(saved: SavedGeom) -> Self {
        let mut entry = GeomEntry {
            geom: saved.geom,
            collision_id: saved.collision_id,
            grid_cell_size: saved.grid_cell_size,
            outline: saved.outline,
            local_vertices: saved.local_vertices,
            box_radius: saved.box_radius,
            grid: saved.grid,
            in_simulation: saved.in_simulation,
            is_sensor: saved.is_sensor,
            one_way: saved.one_way,
            is_touched: saved.is_touched,
            ignored: saved.ignored,
            ignore_changes: saved.ignore_changes,
            ..GeomEntry::new(saved.number, saved.body, saved.offset, saved.rotation_offset)
        };
        entry.set_transform(saved.transform);
        entry.user_matrix = saved.user_matrix;
        entry.refresh_is_due = saved.refresh_is_due;
        entry
    }
}

/// The parts of a geom that an update or an edit of its body changes.
#[derive(Serialize, Deserialize)]
pub(crate) struct GeomMotion {
    transform: SavedTransform,
    user_matrix: Option<Box<Matrix>>,
    refresh_is_due: bool,
    collision_id: i32,
    is_touched: bool,
    rejected: RejectedArguments<GeomArguments>,
}

impl GeomEntry {
    /// Sets the transform to a saved one.
    fn set_transform(&mut self, transform: SavedTransform) {
        match transform {
            SavedTransform::OfBody { cos_sin: [c, s], position, rotation } => {
                let matrix =
                    PlaneMatrix { m11: c, m12: s, m21: -s, m22: c, m41: position.x, m42: position.y };
                self.world_vertices.clone_from(&self.local_vertices);
                self.set_pose(GeomPose { matrix, inverse: matrix.inverse(), position, rotation });
            }
            SavedTransform::Own { world_vertices, aabb, pose } => {
                (self.world_vertices, self.aabb, self.pose) = (world_vertices, aabb, pose);
            }
        }
    }

    /// Returns the motion of the geom.
    pub(crate) fn motion(&self) -> GeomMotion {
        GeomMotion {
            transform: SavedTransform::of(self),
            user_matrix: self.user_matrix.clone(),
            refresh_is_due: self.refresh_is_due,
            collision_id: self.collision_id,
            is_touched: self.is_touched,
            rejected: self.geom.rejected.clone(),
        }
    }

    /// Sets the motion of the geom to a saved one.
    pub(crate) fn set_motion(&mut self, motion: GeomMotion) {
        self.set_transform(motion.transform);
        self.user_matrix = motion.user_matrix;
        self.refresh_is_due = motion.refresh_is_due;
        self.collision_id = motion.collision_id;
        self.is_touched = motion.is_touched;
        self.geom.rejected = motion.rejected;
    }
}

impl Serialize for GeomEntry {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        SavedGeom::serialize(self, serializer)
    }
}

impl<'de> Deserialize<'de> for GeomEntry {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        SavedGeom::deserialize(deserializer)
    }
}
