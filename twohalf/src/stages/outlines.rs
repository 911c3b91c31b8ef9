//! Outlines in convex pieces, as the narrow phase takes them.

use farseer_core::{GeomId, PhysicsSimulator};

use crate::Vector2;
use crate::depth::IdTable;
use crate::shapes::ConvexPieces;

/// The convex pieces of the outlines that were asked for, and room to lay two of them out in the world.
#[derive(Debug, Clone, Default)]
pub(super) struct Outlines {
    pieces: IdTable<GeomId, ConvexPieces>,
    laid_out: [Vec<Vector2>; 2],
    /// Of one contact.
    pub(super) points: Vec<Vector2>,
}

/// Pieces and where their corners are in the world.
pub(super) type LaidOut<'a> = (&'a ConvexPieces, &'a [Vector2]);

impl Outlines {
    /// It has become another one.
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

    /// Puts the pieces of a geom into the world; and hands out room for the points of a contact.
    pub(super) fn lay_out(
        &mut self,
        core: &PhysicsSimulator,
        geom: GeomId,
    ) -> Option<(LaidOut<'_>, &mut Vec<Vector2>)> {
        self.find(core, geom)?;
        let Outlines { pieces, laid_out: [corners, _], points } = self;
        let pieces = pieces.get(geom)?;
        pieces.lay_out(&core.geom(geom)?.matrix(), corners);
        Some(((pieces, corners), points))
    }

    /// Puts the pieces of both geoms into the world.
    pub(super) fn lay_out_both(
        &mut self,
        core: &PhysicsSimulator,
        geoms: [GeomId; 2],
    ) -> Option<[LaidOut<'_>; 2]> {
        geoms.into_iter().try_for_each(|geom| self.find(core, geom))?;
        let Outlines { pieces, laid_out, .. } = self;
        for (geom, corners) in geoms.into_iter().zip(laid_out.iter_mut()) {
            pieces.get(geom)?.lay_out(&core.geom(geom)?.matrix(), corners);
        }
        let [a, b] = geoms;
        Some([(pieces.get(a)?, &laid_out[0]), (pieces.get(b)?, &laid_out[1])])
    }
}
