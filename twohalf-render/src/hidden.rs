//! Hidden surface removal: faces of solids without the parts inside of other solids.

use twohalf::Vector3;

use crate::surface::{Face, above_ground};

/// Depth below a surface, px, up to which a face counts as flush and is drawn.
const FLUSH_DEPTH: f32 = 0.02;
/// Least Y of the unit normal of a level side, dimensionless.
const MIN_LEVEL_NORMAL_Y: f32 = 0.9999;
/// Twice the area, px², up to which a polygon is a line that rounding has widened.
const MIN_DOUBLED_AREA: f32 = 1e-3;

/// A convex solid that hides its interior: outward unit normals and plane distances from the origin, px.
#[derive(Debug, Clone)]
pub(crate) struct Solid {
    low: Vector3,
    high: Vector3,
    sides: [(Vector3, f32); 6],
}

/// Clipping of a face: solids that hide parts of it, and a range of heights, px.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Within<'a> {
    pub(crate) solids: &'a [Solid],
    pub(crate) heights: [f32; 2],
}

/// The visible parts of a face: convex pieces, and the lines around them.
#[derive(Debug, Clone, Default, PartialEq)]
pub(crate) struct Seen {
    pub(crate) pieces: Vec<Vec<Vector3>>,
    pub(crate) lines: Vec<[Vector3; 2]>,
}

impl Solid {
    /// A platform with these corners.
    pub(crate) fn new(corners: &[Vector3; 8]) -> Self {
        let first = corners[0];
        let bounds = |(low, high): (Vector3, Vector3), corner: &Vector3| (low.inf(corner), high.sup(corner));
        let (low, high) = corners.iter().fold((first, first), bounds);
        let sides = Face::ALL.map(|face| {
            let normal = face.normal(corners).normalize();
            // A solid on the ground also hides the ground below it.
            let is_on_ground = normal.y < -MIN_LEVEL_NORMAL_Y && low.y <= FLUSH_DEPTH;
            (normal, if is_on_ground { f32::MAX } else { normal.dot(&face.corners(corners)[0]) })
        });
        Solid { low, high, sides }
    }

    /// The solid moved by some px.
    pub(crate) fn moved(&self, way: Vector3) -> Self {
        let sides = self.sides.map(|(normal, reach)| (normal, reach + normal.dot(&way)));
        Solid { low: self.low + way, high: self.high + way, sides }
    }

    /// Least and greatest X, px.
    pub(crate) fn width(&self) -> [f32; 2] {
        [self.low.x, self.high.x]
    }

    /// Whether the AABBs of two solids overlap by more than flush ones do.
    pub(crate) fn overlaps(&self, other: &Solid) -> bool {
        (0..3).all(|axis| {
            self.low[axis] + FLUSH_DEPTH < other.high[axis] && other.low[axis] + FLUSH_DEPTH < self.high[axis]
        })
    }

    /// Cuts a convex polygon into pieces outside and the part inside; `None` if that part is no deeper than
    /// flush.
    fn cut(&self, face: &[Vector3]) -> Option<(Vec<Vec<Vector3>>, Vec<Vector3>)> {
        let (mut outside, mut inside) = (Vec::new(), face.to_vec());
        for &(normal, reach) in &self.sides {
            let depth = |point: &Vector3| reach - normal.dot(point);
            if inside.iter().all(|point| depth(point) <= FLUSH_DEPTH) {
                return None;
            }
            let out = part_of(&inside, |point| -depth(point));
            inside = part_of(&inside, depth);
            if has_area(&out) {
                outside.push(out);
            }
        }
        has_area(&inside).then_some((outside, inside))
    }

    /// Whether a point is inside, deeper than flush.
    fn holds(&self, point: Vector3) -> bool {
        self.sides.iter().all(|(normal, reach)| normal.dot(&point) < reach - FLUSH_DEPTH)
    }

    /// The parts of a segment outside of the solid; flush parts are outside, unless the solid hides these as well.
    fn line_outside(
        &self,
        [from, to]: [Vector3; 2],
        hides_flush: bool,
    ) -> impl Iterator<Item = [Vector3; 2]> + use<> {
        let (margin, flush) = if hides_flush { (FLUSH_DEPTH, 0.0) } else { (0.0, FLUSH_DEPTH) };
        // The part of the line inside (M. Cyrus and J. Beck, Generalized two- and three-dimensional clipping,
        // 1978).
        let (mut enters, mut leaves) = (0.0f32, 1.0f32);
        for &(normal, reach) in &self.sides {
            let [start, end] = [from, to].map(|point| reach + margin - normal.dot(&point));
            match (start > 0.0, end > 0.0) {
                _ if start <= flush && end <= flush => leaves = -1.0,
                (false, true) => enters = enters.max(start / (start - end)),
                (true, false) => leaves = leaves.min(start / (start - end)),
                _ => {}
            }
        }
        let at = move |part: f32| from + (to - from) * part;
        let kept = if enters >= leaves {
            [Some([from, to]), None]
        } else {
            [(enters > 0.0).then(|| [from, at(enters)]), (leaves < 1.0).then(|| [at(leaves), to])]
        };
        kept.into_iter().flatten().filter(|[from, to]| (to - from).norm() > FLUSH_DEPTH)
    }
}

impl Within<'_> {
    /// No clipping, for a solid that stands alone.
    pub(crate) const ALL: Within<'static> = Within { solids: &[], heights: [0.0, f32::INFINITY] };

    /// The visible parts of a face.
    pub(crate) fn seen(&self, face: [Vector3; 4]) -> Seen {
        let [low, high] = self.heights;
        let mut face = above_ground(face);
        if low > 0.0 {
            face = part_of(&face, |point| point.y - low);
        }
        if high.is_finite() {
            face = part_of(&face, |point| high - point.y);
        }
        if face.len() < 3 { Seen::default() } else { Seen::of(face, self.solids) }
    }
}

impl Seen {
    /// The parts of a convex face outside of some solids.
    fn of(face: Vec<Vector3>, solids: &[Solid]) -> Self {
        let mut seen = Seen { lines: edges(&face).collect(), pieces: vec![face] };
        for at in 0..solids.len() {
            seen.lose(solids, at);
        }
        seen
    }

    /// Removes the parts inside of one of the solids.
    fn lose(&mut self, solids: &[Solid], at: usize) {
        let solid = &solids[at];
        let mut pieces = Vec::with_capacity(self.pieces.len());
        let mut meeting: Vec<[Vector3; 2]> = Vec::new();
        for piece in std::mem::take(&mut self.pieces) {
            let Some((outside, inside)) = solid.cut(&piece) else {
                pieces.push(piece);
                continue;
            };
            pieces.extend(outside);
            // Lines where the face enters the solid, unless another solid touches it there.
            meeting.extend(edges(&inside).filter(|[from, to]| !solid.holds(0.5 * (from + to))));
            for other in solids.iter().enumerate().filter(|(other, _)| *other != at).map(|(_, other)| other) {
                meeting = meeting.iter().flat_map(|&line| other.line_outside(line, true)).collect();
            }
        }
        self.pieces = pieces;
        self.lines =
            self.lines.iter().flat_map(|&line| solid.line_outside(line, false)).chain(meeting).collect();
    }
}

/// From every corner to the next one.
fn edges(corners: &[Vector3]) -> impl Iterator<Item = [Vector3; 2]> {
    corners.iter().zip(corners.iter().cycle().skip(1)).map(|(&from, &to)| [from, to])
}

/// Clips a convex polygon by a half-space, where a linear function is not negative (I. Sutherland and G. Hodgman, "Reentrant polygon
/// clipping", 1974).
fn part_of(polygon: &[Vector3], depth: impl Fn(&Vector3) -> f32) -> Vec<Vector3> {
    let mut kept = Vec::with_capacity(polygon.len() + 1);
    for [from, to] in edges(polygon) {
        let (start, end) = (depth(&from), depth(&to));
        if start >= 0.0 {
            kept.push(from);
        }
        if (start > 0.0 && end < 0.0) || (start < 0.0 && end > 0.0) {
            kept.push(from + (to - from) * (start / (start - end)));
        }
    }
    kept
}

fn has_area(polygon: &[Vector3]) -> bool {
    let Some(&first) = polygon.first() else { return false };
    let triangles = polygon.windows(2).map(|edge| (edge[0] - first).cross(&(edge[1] - first)));
    triangles.sum::<Vector3>().norm() > MIN_DOUBLED_AREA
}

#[cfg(test)]
mod tests {
    use super::*;

    /// From the origin to (100, 60, 40), corners as platforms have them.
    fn block() -> Solid {
        block_over(0.0)
    }

    /// The same from another height on.
    fn block_over(height: f32) -> Solid {
        let front = [[0.0, 60.0], [100.0, 60.0], [100.0, 0.0], [0.0, 0.0]];
        let corner = |at: usize| {
            let [x, y] = front[at % 4];
            Vector3::new(x, y + height, if at < 4 { 0.0 } else { 40.0 })
        };
        Solid::new(&std::array::from_fn(corner))
    }

    fn face([left, right]: [f32; 2], [low, high]: [f32; 2], z: f32) -> Vec<Vector3> {
        [[left, high], [right, high], [right, low], [left, low]].map(|[x, y]| Vector3::new(x, y, z)).to_vec()
    }

    fn area(seen: &Seen) -> f32 {
        let twice = |piece: &Vec<Vector3>| {
            piece.windows(2).map(|edge| (edge[0] - piece[0]).cross(&(edge[1] - piece[0]))).sum::<Vector3>()
        };
        seen.pieces.iter().map(|piece| 0.5 * twice(piece).norm()).sum()
    }

    #[test]
    fn the_part_of_a_face_above_the_top_of_a_block_is_visible_and_outlined() {
        let seen = Seen::of(face([20.0, 70.0], [-80.0, 70.0], 20.0), &[block()]);
        // Below the block there is the ground.
        assert!((area(&seen) - 50.0 * 10.0).abs() < 0.01, "{}", area(&seen));
        assert_eq!(seen.lines.len(), 4, "{:?}", seen.lines);
    }

    /// Where one block ends the other begins: no line tells.
    #[test]
    fn a_face_that_stands_in_two_blocks_on_each_other_is_seen_above_the_upper_one() {
        let upper = block_over(60.0);
        for solids in [[block(), upper.clone()], [upper, block()]] {
            let seen = Seen::of(face([20.0, 70.0], [10.0, 130.0], 20.0), &solids);
            assert!((area(&seen) - 50.0 * 10.0).abs() < 0.01, "{}", area(&seen));
            assert!(seen.lines.iter().flatten().all(|point| point.y > 119.9), "{:?}", seen.lines);
        }
    }

    #[test]
    fn a_face_flush_with_a_side_and_one_beside_are_seen_as_they_are() {
        for z in [0.0, 40.0, 41.0, -0.01] {
            let whole = face([20.0, 70.0], [10.0, 70.0], z);
            let seen = Seen::of(whole.clone(), &[block()]);
            assert_eq!((seen.pieces, seen.lines.len()), (vec![whole], 4), "{z}");
        }
    }

    #[test]
    fn a_face_inside_a_solid_is_hidden_and_one_around_it_is_seen_except_inside() {
        assert_eq!(Seen::of(face([20.0, 70.0], [5.0, 50.0], 20.0), &[block()]), Seen::default());
        let around = Seen::of(face([-100.0, 200.0], [-100.0, 160.0], 20.0), &[block()]);
        assert!((area(&around) - (300.0 * 260.0 - 100.0 * 160.0)).abs() < 0.1, "{}", area(&around));
    }
}
