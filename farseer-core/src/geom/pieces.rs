//! The convex pieces of a geom, with which the precise set collides.
//!
//! A circle of the circle factory with eight corners or more is a true circle; with fewer corners it is the polygon. A
//! capsule of the capsule factory is a true capsule. A concave outline is cut into convex pieces once; the geom and its
//! clones share them.

use std::sync::Arc;

use super::outline::{Outline, capsule_half_axis};
use crate::geom::entry::GeomEntry;
use farseer_precise::edge_adjacency::edges_of_chain;
use farseer_precise::pieces::{Piece, pieces_of_outline};

/// Minimum number of corners with which a circle of the circle factory is a true circle.
const MIN_CIRCLE_CORNERS: usize = 8;

impl GeomEntry {
    /// The convex parts of the outline.
    pub(crate) fn pieces(&self) -> &Arc<[Piece]> {
        self.pieces.get_or_init(|| pieces(self))
    }
}

/// The convex pieces of a geom.
fn pieces(geom: &GeomEntry) -> Arc<[Piece]> {
    match geom.outline {
        Outline::Circle { radius } if geom.local_vertices.len() >= MIN_CIRCLE_CORNERS => {
            Arc::new([Piece::Circle { centre: [0.0, 0.0], radius }])
        }
        Outline::Capsule { height, end_radius } => {
            let half = capsule_half_axis(height, end_radius);
            Arc::new([Piece::Capsule { ends: [[0.0, -half], [0.0, half]], radius: end_radius }])
        }
        Outline::Chain { is_closed } => edges_of_chain(&geom.local_vertices, is_closed).collect(),
        _ => pieces_of_outline(geom.local_vertices.iter().map(|v| [v.x, v.y]).collect()),
    }
}
