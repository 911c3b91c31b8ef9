//! Adapter: hits, by geoms.

use crate::geom::GeomId;
use crate::math::Vector2;
use crate::report::Hit;
use crate::storage::order::{packed_key, sort_by_number};
use farseer_precise::Solver;
use farseer_precise::narrow_phase::hits::PieceHit;

/// Appends the hits of this step that are faster than `min_speed` (length units/s), in the order of creation numbers: of each pair
/// of geoms the fastest one. `pieces` is a workspace.
pub(super) fn list_hits(
    solver: &mut Solver,
    pieces: &mut Vec<PieceHit>,
    min_speed: f32,
    hits: &mut Vec<Hit>,
) {
    pieces.clear();
    solver.narrow_phase().list_hits(min_speed, pieces);
    pieces.iter_mut().filter(|hit| hit.numbers[0] > hit.numbers[1]).for_each(PieceHit::flip);
    sort_by_number(pieces, |hit| packed_key([hit.numbers[0], hit.numbers[1], !hit.speed.to_bits(), 0]));
    for of_geoms in pieces.chunk_by(|one, other| one.numbers == other.numbers) {
        let PieceHit { owners, point: [x, y], normal: [nx, ny], speed, .. } = of_geoms[0];
        let [geom1, geom2] = owners.map(GeomId::from_bits);
        hits.push(Hit { geom1, geom2, point: Vector2::new(x, y), normal: Vector2::new(nx, ny), speed });
    }
}
