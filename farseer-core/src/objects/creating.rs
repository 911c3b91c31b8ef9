//! Creation of bodies and geoms (behaviour chapter 05, section 3).

use std::sync::Arc;

use serde::{Deserialize, Serialize};

use super::Objects;
use crate::body::entry::BodyEntry;
use crate::body::{Body, BodyId, Pose};
use crate::geom::GeomId;
use crate::geom::distance_grid::DistanceGrid;
use crate::geom::entry::GeomEntry;
use crate::geom::outline::Outline;
use crate::math::finite::{finite, finite_vector};
use crate::math::{Vector2, scalar};
use crate::object_id::ObjectId;
use crate::shape::Vertices;
use crate::storage::rejected_arguments::RejectedArguments;
use crate::{Error, Result};

/// Edge of an automatic grid cell, as a fraction of the shorter side of the geom's box. Farseer's value.
const AUTOMATIC_CELL_FRACTION: f32 = 0.1;

/// Maximum number of geoms that a simulator can create: the original counts them in signed 32 bits.
pub(super) const MAX_GEOM_NUMBERS: u32 = i32::MAX as u32;

/// Position of a geom on its body, and the cell size of its distance grid.
///
/// ```
/// use farseer_core::{GeomPlacement, math::Vector2};
/// let head = GeomPlacement::at(Vector2::new(0.0, -40.0)).turned(0.5);
/// assert_eq!(head, GeomPlacement { offset: Vector2::new(0.0, -40.0), rotation_offset: 0.5, ..Default::default() });
/// assert_eq!(head.collision_grid_size, 0.0);
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Default, Serialize, Deserialize)]
pub struct GeomPlacement {
    /// Position on the body in length units, y down, **before** the geom is turned: as in the original,
    /// `rotation_offset` turns the offset along with the outline, about the body's origin. A geom at (0, 15) that is
    /// turned by a quarter turn lies at (-15, 0) in the body's coordinates. To put it at a point `p` there, turn `p`
    /// back by `rotation_offset`. Default none.
    pub offset: Vector2,
    /// Rotation relative to the body in radians, clockwise on a screen with y down. It turns the offset too. Default 0.
    pub rotation_offset: f32,
    /// Edge of a distance grid cell in length units. At 0 or less it is a tenth of the shorter side of the geom's box
    /// **as it lies in the world when it is made**. For a long thin geom on a rotated body the cells are then thicker
    /// than the geom, and contacts are missed.
    #[doc(alias = "CalculateGridCellSizeFromAABB")]
    pub collision_grid_size: f32,
}

impl GeomPlacement {
    /// At the body's origin, with this cell size.
    pub fn with_grid_size(collision_grid_size: f32) -> Self {
        GeomPlacement { collision_grid_size, ..Default::default() }
    }

    /// At this position on the body: `GeomPlacement::at(head).turned(0.5).with_cells(2.0)`.
    pub fn at(offset: Vector2) -> Self {
        GeomPlacement { offset, ..Default::default() }
    }

    /// The same, turned relative to the body by this number of radians.
    #[must_use]
    pub fn turned(self, rotation_offset: f32) -> Self {
        GeomPlacement { rotation_offset, ..self }
    }

    /// The same with this cell size of the distance grid, in length units.
    #[must_use]
    pub fn with_cells(self, collision_grid_size: f32) -> Self {
        GeomPlacement { collision_grid_size, ..self }
    }

    fn check(self) -> Result<Self> {
        finite_vector("offset", self.offset)?;
        finite("rotation_offset", self.rotation_offset)?;
        finite("collision_grid_size", self.collision_grid_size)?;
        Ok(self)
    }
}

/// Creation.
impl Objects {
    /// Stores a body and returns its id. It takes part once it is [added](Self::add).
    pub fn create_body(&mut self, body: Body) -> BodyId {
        self.bodies.create(BodyEntry::new(body))
    }

    /// Attaches an outline to a body. The geom takes part once it is [added](Self::add).
    ///
    /// The outline is brought into the engine's winding (negative shoelace area) and not otherwise changed. With
    /// distance grids its grid is made now; geoms of equal outline and cell size share one.
    ///
    /// # Errors
    /// A stale body; an empty or non-finite outline; a placement that is not finite; a geom whose box in the world is
    /// not finite. A flat outline without a cell size, or a cell size that would need more than 2^26 nodes.
    /// [`Error::LimitExceeded`] for a grid whose work exceeds the [limits](Self::limits).
    #[doc(alias = "Geom(Body, Vertices, Vector2, float, float)")]
    #[doc(alias = "Geom()")]
    pub fn create_geom(
        &mut self,
        body: BodyId,
        vertices: impl Into<Vertices>,
        placement: GeomPlacement,
    ) -> Result<GeomId> {
        self.create_geom_of(body, (vertices.into(), Outline::Polygon), placement)
    }

    /// Like [`create_geom`](Self::create_geom), for a polygon that stands for another shape.
    pub(crate) fn create_geom_of(
        &mut self,
        body: BodyId,
        (vertices, outline): (Vertices, Outline),
        placement: GeomPlacement,
    ) -> Result<GeomId> {
        let vertices = check_outline(vertices)?;
        let placement = placement.check()?;
        let mut entry =
            self.new_entry(body, (vertices, outline), placement.offset, placement.rotation_offset)?;
        entry.grid_cell_size = placement.collision_grid_size;
        if self.methods.narrow().uses_grids() {
            if entry.grid_cell_size <= 0.0 {
                entry.grid_cell_size = automatic_cell_size(&entry);
            }
            entry.set_grid(self.distance_grid(&entry.local_vertices, entry.grid_cell_size)?);
        }
        Ok(self.insert_geom(entry))
    }

    /// The grid over an outline, shared with geoms of equal outline and cell size.
    pub(super) fn distance_grid(&mut self, outline: &Vertices, cell_size: f32) -> Result<Arc<DistanceGrid>> {
        let Objects { grids, geoms, limits, .. } = self;
        grids.get(outline, cell_size, limits, || {
            geoms.iter().filter_map(|(_, geom)| geom.grid.as_deref()).collect()
        })
    }

    /// Attaches a copy of a geom to a body, at the same offsets. Under the distance grid both share one grid.
    ///
    /// # Errors
    /// A stale id; a box that is not finite; a geom without a distance grid, if the distance grid is selected. A chain
    /// for a body that is not static. A chain or a one-way geom under the faithful methods.
    #[doc(alias = "Geom(Body, Geom)")]
    #[doc(alias("DistanceGrid.Copy"))]
    pub fn clone_geom(&mut self, body: BodyId, geom: GeomId) -> Result<GeomId> {
        let source = self.geoms.get(geom).ok_or(Error::StaleId { argument: "geom" })?;
        let (offset, rotation_offset) = (source.offset, source.rotation_offset);
        self.clone_geom_with_offset(body, geom, offset, rotation_offset)
    }

    /// Attaches a copy of a geom to a body, at other offsets.
    ///
    /// # Errors
    /// As [`clone_geom`](Self::clone_geom); offsets that are not finite.
    #[doc(alias = "Geom(Body, Geom, Vector2, float)")]
    pub fn clone_geom_with_offset(
        &mut self,
        body: BodyId,
        geom: GeomId,
        offset: Vector2,
        rotation_offset: f32,
    ) -> Result<GeomId> {
        finite_vector("offset", offset)?;
        finite("rotation_offset", rotation_offset)?;
        let source = self.geoms.get(geom).ok_or(Error::StaleId { argument: "geom" })?.clone();
        let uses_grids = self.methods.narrow().uses_grids();
        if uses_grids && source.grid.is_none() {
            return Err(Error::MissingDistanceGrid { argument: "geom" });
        }
        let outline = (source.local_vertices, source.outline);
        if source.one_way.is_some() {
            self.methods.check_one_way()?;
        }
        self.methods.check_surface(source.geom.surface())?;
        let mut entry = self.new_entry(body, outline, offset, rotation_offset)?;
        entry.one_way = source.one_way;
        entry.pieces = source.pieces;
        entry.geom = source.geom;
        entry.geom.rejected = RejectedArguments::default();
        entry.geom.set_tag(0);
        entry.grid_cell_size = source.grid_cell_size;
        if let Some(grid) = source.grid.filter(|_| uses_grids) {
            entry.set_grid(grid);
        }
        Ok(self.insert_geom(entry))
    }

    fn new_entry(
        &mut self,
        body: BodyId,
        (vertices, outline): (Vertices, Outline),
        offset: Vector2,
        rotation_offset: f32,
    ) -> Result<GeomEntry> {
        let owner = self.bodies.get(body).ok_or(Error::StaleId { argument: "body" })?;
        self.methods.check_outline(outline)?;
        if outline.is_one_sided() {
            check_may_hold_chain(body, owner)?;
        }
        let (position, rotation) = (owner.body.position(), owner.body.rotation());
        if self.next_geom_number >= MAX_GEOM_NUMBERS {
            return Err(Error::invalid(
                "geom",
                self.next_geom_number,
                "one of the 2^31 - 1 that a simulator can make",
            ));
        }
        let mut entry = GeomEntry::new(self.next_geom_number, body, offset, rotation_offset);
        entry.set_outline(vertices, outline);
        entry.update_transform(position, rotation);
        check_pose_is_finite("geom", entry, owner)
    }

    /// Removes objects that were made just now and whose ids are unknown to the game, as if they had never been made.
    /// They must be the last ones of each kind, in the order in which they were made; geoms come after their bodies.
    pub(crate) fn discard(&mut self, objects: impl DoubleEndedIterator<Item = ObjectId>) {
        for object in objects.rev() {
            match object {
                ObjectId::Body(body) => self.discard_body(body),
                ObjectId::Geom(geom) => self.discard_geom(geom),
                ObjectId::Controller(controller) => drop(self.controllers.discard(controller)),
                ObjectId::Joint(joint) => drop(self.joints.discard(joint)),
                ObjectId::Spring(spring) => drop(self.springs.discard(spring)),
            }
        }
    }

    fn discard_body(&mut self, body: BodyId) {
        if self.bodies.discard(body).is_some_and(|entry| entry.is_touched) {
            self.touched_bodies.retain(|&other| other != body);
        }
    }

    fn discard_geom(&mut self, geom: GeomId) {
        if let Some(entry) = self.geoms.discard(geom) {
            if entry.is_touched {
                self.touched_geoms.retain(|&other| other != geom);
            }
            self.bodies[entry.body].detach(geom);
            self.next_geom_number -= 1;
        }
    }

    fn insert_geom(&mut self, entry: GeomEntry) -> GeomId {
        let body = entry.body;
        self.next_geom_number += 1;
        let geom = self.geoms.create(entry);
        self.bodies[body].geoms.push(geom);
        geom
    }
}

/// Automatic cell size of a geom's grid, in length units: it depends on the geom's present pose in the world.
pub(super) fn automatic_cell_size(entry: &GeomEntry) -> f32 {
    scalar::min(entry.aabb.width(), entry.aabb.height()) * AUTOMATIC_CELL_FRACTION
}

/// Refuses a geom whose world coordinates are not finite in its present pose, in that of its body, or in the one to
/// which the body may be put back.
pub(super) fn check_pose_is_finite(
    argument: &'static str,
    entry: GeomEntry,
    owner: &BodyEntry,
) -> Result<GeomEntry> {
    let is_finite_at = |pose: Pose| entry.would_be_finite_at(pose.position, pose.rotation);
    let pose = owner.body.pose();
    let is_finite = entry.is_valid()
        && is_finite_at(pose)
        && (owner.pending_pose().is_none() || is_finite_at(owner.followed));
    if is_finite {
        Ok(entry)
    } else {
        Err(Error::invalid(argument, entry.aabb, "small and near enough for a finite box in the world"))
    }
}

/// Refuses a chain on a body that is not static: a chain has no inside, and so no mass.
pub(super) fn check_may_hold_chain(body: BodyId, owner: &BodyEntry) -> Result<()> {
    if owner.body.is_static() { Ok(()) } else { Err(Error::invalid("body", body, "static, to have a chain")) }
}

/// Refuses outlines that no geom can have.
pub(super) fn check_outline(vertices: Vertices) -> Result<Vertices> {
    if vertices.is_empty() {
        return Err(Error::invalid("vertices", 0, "a list of at least one vertex"));
    }
    for &vertex in vertices.iter() {
        finite_vector("vertices", vertex)?;
    }
    Ok(vertices)
}
