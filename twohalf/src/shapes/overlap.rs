//! Overlap of two outlines: test and common points.
//!
//! Frame: the plane's. Outlines that do not cross themselves, convex or not. Overlaps thinner than the
//! rounding of the coordinates are ignored, so that touching outlines do not overlap after a rotation either.

use farseer_core::math::{Vector2, vector2};

use super::{contains, cross64, doubled_area, edges, nearest};

/// AABB of points.
#[derive(Debug, Clone, Copy)]
struct Bounds {
    min: Vector2,
    max: Vector2,
}

impl Bounds {
    fn of(points: impl IntoIterator<Item = Vector2>) -> Option<Bounds> {
        let mut points = points.into_iter();
        let first = points.next()?;
        Some(points.fold(Bounds { min: first, max: first }, |bounds, point| Bounds {
            min: vector2::min(bounds.min, point),
            max: vector2::max(bounds.max, point),
        }))
    }

    fn of_edge((a, b): (Vector2, Vector2)) -> Bounds {
        Bounds { min: vector2::min(a, b), max: vector2::max(a, b) }
    }

    /// Returns whether the boxes overlap or are no more than `slack` apart, px; false for NaN.
    fn meets(&self, other: &Bounds, slack: f32) -> bool {
        self.min.x - other.max.x <= slack
            && other.min.x - self.max.x <= slack
            && self.min.y - other.max.y <= slack
            && other.min.y - self.max.y <= slack
    }
}

/// A pair of outlines, ordered: tests ask for parts of the first outline inside of the second one.
#[derive(Clone, Copy)]
struct OutlinePair<'a> {
    this: &'a [Vector2],
    other: &'a [Vector2],
    other_bounds: Bounds,
    /// Greatest distance that counts as rounding, px.
    rounding: f32,
}

/// Location of a part of an outline relative to the other outline.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum PointLocation {
    Inside,
    On,
    Outside,
}

impl<'a> OutlinePair<'a> {
    /// Returns the pair of outlines in both orders; `None` if the AABBs do not overlap.
    fn both(a: &'a [Vector2], b: &'a [Vector2]) -> Option<[OutlinePair<'a>; 2]> {
        let (bounds_a, bounds_b) = (Bounds::of(a.iter().copied())?, Bounds::of(b.iter().copied())?);
        let corners = [bounds_a.min, bounds_a.max, bounds_b.min, bounds_b.max];
        let greatest = corners.iter().fold(0.0_f32, |greatest, corner| greatest.max(corner.amax()));
        let rounding = 4.0 * f32::EPSILON * greatest;
        let is_finite = corners.iter().all(|corner| corner.x.is_finite() && corner.y.is_finite());
        (is_finite && bounds_a.meets(&bounds_b, rounding)).then_some([
            OutlinePair { this: a, other: b, other_bounds: bounds_b, rounding },
            OutlinePair { this: b, other: a, other_bounds: bounds_a, rounding },
        ])
    }

    fn place(&self, point: Vector2) -> PointLocation {
        let at_point = Bounds { min: point, max: point };
        if !at_point.meets(&self.other_bounds, self.rounding) {
            return PointLocation::Outside;
        }
        match nearest(self.other, point) {
            Some(nearest) if nearest.distance < -self.rounding => PointLocation::Inside,
            Some(nearest) if nearest.distance <= self.rounding => PointLocation::On,
            _ => PointLocation::Outside,
        }
    }

    /// Iterates over the pairs of edges, one of each outline, whose AABBs overlap.
    fn meeting_edges(&self) -> impl Iterator<Item = ((Vector2, Vector2), (Vector2, Vector2))> {
        edges(self.this).flat_map(move |edge| {
            let bounds = Bounds::of_edge(edge);
            let near = bounds.meets(&self.other_bounds, self.rounding);
            let others = near.then(|| edges(self.other)).into_iter().flatten();
            others
                .filter(move |other| bounds.meets(&Bounds::of_edge(*other), self.rounding))
                .map(move |other| (edge, other))
        })
    }

    /// Returns two values: whether any part of an edge of the first outline lies inside of the second outline, and, if none
    /// does, whether all of the first outline lies on the second outline.
    fn has_edge_inside(&self) -> (bool, bool) {
        let mut all_on = true;
        for edge in edges(self.this) {
            let mut start = 0.0;
            while start < 1.0 {
                let end = self.next_vertex_on_edge(edge, start);
                let middle = edge.0 + (edge.1 - edge.0) * ((start + end) * 0.5);
                match self.place(middle) {
                    PointLocation::Inside => return (true, false),
                    PointLocation::On => {}
                    PointLocation::Outside => all_on = false,
                }
                start = end;
            }
        }
        (false, all_on)
    }

    /// Returns the fraction of the edge after `start`, 0..=1, at which a vertex of the second outline lies on the edge; 1
    /// without such a vertex.
    fn next_vertex_on_edge(&self, (a, b): (Vector2, Vector2), start: f32) -> f32 {
        let direction = b - a;
        let squared_length = vector2::length_squared(direction);
        let bounds = Bounds::of_edge((a, b));
        let mut next = 1.0_f32;
        for &vertex in self.other {
            if !(bounds.meets(&Bounds { min: vertex, max: vertex }, self.rounding)) {
                continue;
            }
            let side = cross64(a, b, vertex).abs() as f32;
            let along = vector2::dot(vertex - a, direction) / squared_length;
            let length = squared_length.sqrt();
            let is_on = side <= 2.0 * self.rounding * length;
            if is_on && (along - start) * length > self.rounding && along < next {
                next = along;
            }
        }
        next
    }
}

/// Intersection of two edges, if the ends of each lie on both sides of the other, farther from it than
/// `rounding`, px.
fn crossing((a1, a2): (Vector2, Vector2), (b1, b2): (Vector2, Vector2), rounding: f32) -> Option<Vector2> {
    let split = |from: Vector2, to: Vector2, first: Vector2, second: Vector2| {
        let least = f64::from(rounding * vector2::length(to - from));
        let (side1, side2) = (cross64(from, to, first), cross64(from, to, second));
        let is_split = (side1 > least && side2 < -least) || (side1 < -least && side2 > least);
        is_split.then(|| (side1 / (side1 - side2)) as f32)
    };
    split(a1, a2, b1, b2)?;
    let along = split(b1, b2, a1, a2)?;
    Some(a1 + (a2 - a1) * along)
}

/// Returns whether the interiors of two outlines overlap. Outlines that only touch, or that have no interior, do not.
pub(crate) fn outlines_overlap(a: &[Vector2], b: &[Vector2]) -> bool {
    let Some([from_a, from_b]) = OutlinePair::both(a, b) else { return false };
    if doubled_area(a) == 0.0 || doubled_area(b) == 0.0 {
        return false;
    }
    if from_a.meeting_edges().any(|(edge, other)| crossing(edge, other, from_a.rounding).is_some()) {
        return true;
    }
    let (is_inside, is_all_on) = from_a.has_edge_inside();
    if is_inside || from_b.has_edge_inside().0 {
        return true;
    }
    // No edge of one lies inside the other: the outlines are apart or equal.
    is_all_on && inner_point(a).is_some_and(|point| from_a.place(point) == PointLocation::Inside)
}

/// A point inside an outline: the middle of a horizontal chord between the two neighbouring vertex heights
/// that are farthest apart.
fn inner_point(outline: &[Vector2]) -> Option<Vector2> {
    let mut level = None;
    let mut widest = 0.0;
    for vertex in outline {
        let above = outline.iter().map(|other| other.y).filter(|y| *y > vertex.y);
        let next = above.fold(f32::INFINITY, f32::min);
        if next.is_finite() && next - vertex.y > widest {
            widest = next - vertex.y;
            level = Some(vertex.y + 0.5 * widest);
        }
    }
    let level = level?;
    let (mut first, mut second) = (f32::INFINITY, f32::INFINITY);
    for (a, b) in edges(outline).filter(|(a, b)| (a.y > level) != (b.y > level)) {
        let x = a.x + (b.x - a.x) * ((level - a.y) / (b.y - a.y));
        (first, second) = if x < first { (x, first) } else { (first, second.min(x)) };
    }
    let point = Vector2::new(first + (second - first) * 0.5, level);
    (point.x.is_finite() && contains(outline, point)).then_some(point)
}

/// Adds the vertices of the common area of two outlines: vertices of one inside or on the other, and
/// intersections of edges. Points may occur twice. Outlines that only touch add none.
pub(crate) fn overlap_points(a: &[Vector2], b: &[Vector2], points: &mut Vec<Vector2>) {
    let Some(pairs) = OutlinePair::both(a, b) else { return };
    let start = points.len();
    let mut overlaps = false;
    for pair in &pairs {
        for &vertex in pair.this {
            let place = pair.place(vertex);
            overlaps |= place == PointLocation::Inside;
            if place != PointLocation::Outside {
                points.push(vertex);
            }
        }
    }
    let [from_a, _] = pairs;
    for (edge, other) in from_a.meeting_edges() {
        if let Some(point) = crossing(edge, other, from_a.rounding) {
            overlaps = true;
            points.push(point);
        }
    }
    if !(overlaps || outlines_overlap(a, b)) {
        points.truncate(start);
    }
}

/// Returns two distant points of a set: the point farthest from the centroid, and the point farthest from the first one. They
/// are equal if all points of the set are. `None` without points.
pub(crate) fn span_of(points: &[Vector2]) -> Option<[Vector2; 2]> {
    let first = *points.first()?;
    let sum = points.iter().fold(Vector2::new(0.0, 0.0), |sum, point| sum + (point - first));
    let middle = first + sum * (1.0 / points.len() as f32);
    let start = farthest(points, middle)?;
    Some([start, farthest(points, start)?])
}

/// Returns the point that is farthest from `from`. Among points at nearly the same distance the first one counts, so that
/// rounding does not change the choice between steps.
fn farthest(points: &[Vector2], from: Vector2) -> Option<Vector2> {
    let mut best = (*points.first()?, 0.0);
    for &point in points {
        let squared = vector2::distance_squared(point, from);
        if squared > best.1 * 1.001 {
            best = (point, squared);
        }
    }
    Some(best.0)
}

#[cfg(test)]
mod tests {
    use super::super::samples::{Random, points, rectangle, winds_around};
    use super::*;

    fn overlap(a: &[Vector2], b: &[Vector2]) -> bool {
        let both = [outlines_overlap(a, b), outlines_overlap(b, a)];
        assert_eq!(both[0], both[1]);
        both[0]
    }

    fn common(a: &[Vector2], b: &[Vector2]) -> Vec<Vector2> {
        let mut found = Vec::new();
        overlap_points(a, b, &mut found);
        found
    }

    #[test]
    fn crossed_bars_overlap() {
        for angle in [0.0, 0.7] {
            let a = rectangle((50.0, 20.0), 100.0, 4.0, angle);
            let b = rectangle((50.0, 20.0), 4.0, 100.0, angle);
            assert!(overlap(&a, &b));
        }
    }

    #[test]
    fn the_intersection_of_crossed_bars_has_the_four_crossings() {
        let found = common(&rectangle((0.0, 0.0), 100.0, 4.0, 0.0), &rectangle((0.0, 0.0), 6.0, 100.0, 0.0));
        assert_eq!(found.len(), 4);
        for corner in points(&[(-3.0, -2.0), (-3.0, 2.0), (3.0, 2.0), (3.0, -2.0)]) {
            assert!(found.iter().any(|point| vector2::distance(*point, corner) < 1e-5));
        }
    }

    #[test]
    fn an_outline_within_another_overlaps_it_and_is_their_intersection() {
        let (outer, inner) = (rectangle((0.0, 0.0), 10.0, 10.0, 0.0), rectangle((1.0, 1.0), 2.0, 2.0, 0.4));
        assert!(overlap(&outer, &inner));
        assert_eq!(common(&outer, &inner), inner);
    }

    #[test]
    fn an_outline_overlaps_itself() {
        for angle in [0.0, 0.4] {
            let outline = rectangle((300.0, -200.0), 10.0, 20.0, angle);
            assert!(overlap(&outline, &outline));
            assert!(outline.iter().all(|corner| common(&outline, &outline).contains(corner)));
        }
    }

    #[test]
    fn rectangles_shifted_along_a_common_edge_overlap() {
        for angle in [0.0, 0.4] {
            let along = Vector2::new(libm::cos(angle) as f32, libm::sin(angle) as f32) * 10.0;
            let a = rectangle((300.0, 200.0), 20.0, 5.0, angle);
            let b: Vec<_> = a.iter().map(|corner| corner + along).collect();
            assert!(overlap(&a, &b));
            let [start, end] = span_of(&common(&a, &b)).expect("two points");
            // Half of the rectangle: 10 by 5. Rounding of coordinates up to 512: 3e-5 each.
            assert!((vector2::distance(start, end) - 125.0_f32.sqrt()).abs() < 2e-4);
        }
    }

    #[test]
    fn neighbours_that_share_an_edge_do_not_overlap() {
        for angle in [0.0, 0.4, 1.1] {
            let along = Vector2::new(libm::cos(angle) as f32, libm::sin(angle) as f32) * 20.0;
            let a = rectangle((300.0, 200.0), 20.0, 5.0, angle);
            let b: Vec<_> = a.iter().map(|corner| corner + along).collect();
            assert!(!overlap(&a, &b));
            assert!(common(&a, &b).is_empty());
        }
    }

    #[test]
    fn corners_that_touch_do_not_overlap() {
        let a = rectangle((0.0, 0.0), 2.0, 2.0, 0.0);
        assert!(!overlap(&a, &rectangle((2.0, 2.0), 2.0, 2.0, 0.0)));
        assert!(!overlap(&a, &points(&[(1.0, 0.0), (3.0, 1.0), (3.0, -1.0)])));
    }

    #[test]
    fn a_peg_in_a_hole_of_its_width_does_not_overlap_until_it_is_too_deep() {
        let slot = points(&[
            (-6.0, 0.0),
            (-6.0, 9.0),
            (6.0, 9.0),
            (6.0, 0.0),
            (2.0, 0.0),
            (2.0, 5.0),
            (-2.0, 5.0),
            (-2.0, 0.0),
        ]);
        assert!(!overlap(&slot, &rectangle((0.0, 1.0), 4.0, 8.0, 0.0)));
        assert!(overlap(&slot, &rectangle((0.0, 1.5), 4.0, 8.0, 0.0)));
    }

    #[test]
    fn edges_that_cross_at_vertices_only_overlap() {
        let diamond = points(&[(-1.0, 0.0), (0.0, 1.0), (1.0, 0.0), (0.0, -1.0)]);
        let other = points(&[(-1.0, 0.0), (1.0, 0.0), (0.0, -5.0)]);
        assert!(overlap(&diamond, &other));
    }

    #[test]
    fn outlines_without_area_do_not_overlap() {
        let square = rectangle((0.0, 0.0), 2.0, 2.0, 0.0);
        let flat =
            [&[][..], &[(0.0, 0.0)], &[(-5.0, 0.0), (5.0, 0.0)], &[(-5.0, 0.0), (0.0, 0.0), (5.0, 0.0)]];
        for flat in flat {
            assert!(!overlap(&square, &points(flat)));
        }
        let broken = points(&[(f32::NAN, 0.0), (1.0, 0.0), (0.0, 1.0)]);
        assert!(!overlap(&square, &broken));
        assert!(common(&square, &broken).is_empty());
    }

    #[test]
    fn outlines_overlap_where_they_have_points_in_common_and_only_there() {
        let mut random = Random(2);
        let (mut overlapping, mut apart) = (0, 0);
        for _ in 0..1000 {
            let middle = random.point(100.0);
            let a = random.star(middle, 8, 20.0, 1.0);
            let away = middle + random.point(30.0);
            let b = random.star(away, 5, 20.0, 1.0);
            let in_both = |point: Vector2| winds_around(&a, point) && winds_around(&b, point);
            if overlap(&a, &b) {
                overlapping += 1;
                let found = common(&a, &b);
                let near = |point: &Vector2| {
                    (0..64).any(|i| {
                        let angle = f64::from(i) * std::f64::consts::TAU / 64.0;
                        in_both(point + Vector2::new(libm::cos(angle) as f32, libm::sin(angle) as f32) * 0.01)
                    })
                };
                // A sliver may be thinner than that, but then it is a triangle.
                let middle = found.iter().sum::<Vector2>() / found.len() as f32;
                assert!(found.len() >= 3 && (found.iter().any(near) || in_both(middle)));
            } else {
                apart += 1;
                assert!((0..300).all(|_| !in_both(middle + random.point(25.0))));
            }
        }
        assert!(overlapping > 200 && apart > 200);
    }

    #[test]
    fn no_point_in_common_is_beyond_the_vertices_of_the_overlap() {
        let mut random = Random(3);
        for _ in 0..300 {
            let a = random.star(Vector2::zeros(), 8, 20.0, 1.0);
            let away = random.point(10.0);
            let b = random.star(away, 7, 20.0, 1.0);
            let direction = vector2::normalize(random.point(1.0));
            let farthest = |points: &[Vector2]| {
                points.iter().map(|point| vector2::dot(*point, direction)).fold(f32::NEG_INFINITY, f32::max)
            };
            let limit = farthest(&common(&a, &b));
            for _ in 0..200 {
                let point = random.point(20.0);
                let is_common = winds_around(&a, point) && winds_around(&b, point);
                assert!(!is_common || vector2::dot(point, direction) <= limit + 1e-4);
            }
        }
    }

    #[test]
    fn the_span_of_a_rectangle_is_a_diagonal() {
        let [start, end] = span_of(&rectangle((7.0, 3.0), 8.0, 6.0, 0.0)).expect("two points");
        assert_eq!(start - end, Vector2::new(-8.0, -6.0));
    }

    #[test]
    fn the_span_of_coincident_points_is_that_point_twice() {
        let point = Vector2::new(3.0, 4.0);
        assert_eq!(span_of(&[point; 3]), Some([point, point]));
        assert_eq!(span_of(&[]), None);
    }
}
