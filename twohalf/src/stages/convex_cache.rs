//! Cache of the convex pieces of outlines, for the narrow phase.

use farseer_core::{GeomId, PhysicsSimulator};

use crate::Vector2;
use crate::depth::SecondaryMap;
use crate::shapes::ConvexPieces;

/// Convex pieces of the outlines in use, and buffers for two of them in the world.
#[derive(Debug, Clone, Default)]
pub(super) struct ConvexCache {
    pieces: SecondaryMap<GeomId, ConvexPieces>,
    transformed: [Vec<Vector2>; 2],
    /// Buffer for the points of one contact.
    pub(super) points: Vec<Vector2>,
}

/// Pieces with their vertices in the world.
pub(super) type CachedPieces<'a> = (&'a ConvexPieces, &'a [Vector2]);

impl ConvexCache {
    /// Drops the cached pieces of a geom whose outline has changed.
    pub(super) fn forget(&mut self, geom: GeomId) {
        self.pieces.remove(geom);
    }

    fn find(&mut self, core: &PhysicsSimulator, geom: GeomId) -> Option<()> {
        let view = core.geom(geom)?;
        if self.pieces.get(geom).is_none() {
            self.pieces.insert(geom, ConvexPieces::new(view.local_vertices()));
        }
        Some(())
    }

    /// Returns the pieces of a geom with vertices transformed into the frame of the plane, and the buffer for contact points;
    /// `None` for a stale id.
    pub(super) fn transform(
        &mut self,
        core: &PhysicsSimulator,
        geom: GeomId,
    ) -> Option<(CachedPieces<'_>, &mut Vec<Vector2>)> {
        self.find(core, geom)?;
        let ConvexCache { pieces, transformed: [corners, _], points } = self;
        let pieces = pieces.get(geom)?;
        pieces.transform_into(&core.geom(geom)?.matrix(), corners);
        Some(((pieces, corners), points))
    }

    /// Returns the pieces of both geoms with vertices transformed into the frame of the plane; `None` for a stale id.
    pub(super) fn transform_both(
        &mut self,
        core: &PhysicsSimulator,
        geoms: [GeomId; 2],
    ) -> Option<[CachedPieces<'_>; 2]> {
        geoms.into_iter().try_for_each(|geom| self.find(core, geom))?;
        let ConvexCache { pieces, transformed, .. } = self;
        for (geom, corners) in geoms.into_iter().zip(transformed.iter_mut()) {
            pieces.get(geom)?.transform_into(&core.geom(geom)?.matrix(), corners);
        }
        let [a, b] = geoms;
        Some([(pieces.get(a)?, &transformed[0]), (pieces.get(b)?, &transformed[1])])
    }
}
