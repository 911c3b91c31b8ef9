//! The convex pieces of a geom, with which the precise set collides.
//!
//! A circle of the circle factory with eight corners or more is a true circle; with fewer corners it is the polygon. A
//! capsule of the capsule factory is a true capsule. A concave outline is cut into convex pieces once; the geom and its
//! clones share them.

use std::sync::Arc;

use super::outline::{Outline, capsule_half_axis};
use super::rounded::core_of;
use crate::geom::entry::GeomEntry;
use crate::shape::Vertices;
use farseer_precise::pieces::{
    Piece, edges_of_chain, edges_of_two_sided_chain, pieces_of_outline, rounded_piece,
};

/// Number of outlines that [`RecentOutlines`] remembers, a count. Value chosen: worlds of many geoms repeat few outlines.
const RECENT_OUTLINES: usize = 4;
/// Minimum number of corners with which a circle of the circle factory is a true circle.
const MIN_CIRCLE_CORNERS: usize = 8;

impl GeomEntry {
    /// The convex parts of the outline.
    pub(crate) fn pieces(&self) -> &Arc<[Piece]> {
        self.pieces.get_or_init(|| pieces_of(&self.local_vertices, self.outline))
    }
}

/// The convex pieces of an outline, given with the corners of its polygon.
pub(crate) fn pieces_of(corners: &Vertices, outline: Outline) -> Arc<[Piece]> {
    match outline {
        Outline::Circle { radius } if corners.len() >= MIN_CIRCLE_CORNERS => {
            Arc::new([Piece::Circle { centre: [0.0, 0.0], radius }])
        }
        Outline::Capsule { height, end_radius } => {
            let half = capsule_half_axis(height, end_radius);
            Arc::new([Piece::Capsule { ends: [[0.0, -half], [0.0, half]], radius: end_radius }])
        }
        Outline::RoundedPolygon { radius } => Arc::new([rounded_piece(core_of(corners, radius), radius)]),
        Outline::Chain { is_closed } => edges_of_chain(corners, is_closed).collect(),
        Outline::TwoSidedChain { is_closed } => edges_of_two_sided_chain(corners, is_closed).collect(),
        _ => pieces_of_outline(corners.iter().map(|v| [v.x, v.y]).collect()),
    }
}

/// The geoms with the last few different outlines. A geom with the outline of one of them shares its convex pieces, so that a world of
/// many equal crates has one list of pieces, cut once.
#[derive(Default)]
pub(crate) struct RecentOutlines<'a> {
    geoms: [Option<&'a GeomEntry>; RECENT_OUTLINES],
    /// Index into `geoms` of the oldest outline.
    oldest: usize,
}

impl<'a> RecentOutlines<'a> {
    /// Gives `geom` the convex pieces of a recent geom with the same outline, if it has none yet; else remembers it.
    pub(crate) fn share_pieces(&mut self, geom: &'a GeomEntry) {
        if geom.pieces.get().is_some() {
            return;
        }
        match self.geoms.iter().flatten().find(|recent| has_outline_of(recent, geom)) {
            Some(recent) => {
                geom.pieces.get_or_init(|| Arc::clone(recent.pieces()));
            }
            None => {
                self.geoms[self.oldest] = Some(geom);
                self.oldest = (self.oldest + 1) % RECENT_OUTLINES;
            }
        }
    }
}

/// Returns whether two geoms have the same outline, bit by bit, so that their convex pieces are equal.
fn has_outline_of(one: &GeomEntry, other: &GeomEntry) -> bool {
    let corners = |geom: &'_ GeomEntry| geom.local_vertices.len();
    let mut both = one.local_vertices.iter().zip(other.local_vertices.iter());
    one.outline == other.outline
        && corners(one) == corners(other)
        && both.all(|(a, b)| [a.x.to_bits(), a.y.to_bits()] == [b.x.to_bits(), b.y.to_bits()])
}
