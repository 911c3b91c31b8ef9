//! Whether two outlines overlap, and what of them does.
//!
//! Frame: the plane's. Outlines that do not cross themselves, convex or not. Overlaps thinner than the rounding of
//! the coordinates are none, so that outlines that only touch do not overlap after a rotation either.

use farseer_core::math::{Vector2, vector2};

use super::{contains, cross64, doubled_area, edges, nearest};

/// The box of some points.
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

    /// Whether the boxes meet or are not farther apart than `slack`; false for NaN.
    fn meets(&self, other: &Bounds, slack: f32) -> bool {
        self.min.x - other.max.x <= slack
            && other.min.x - self.max.x <= slack
            && self.min.y - other.max.y <= slack
            && other.min.y - self.max.y <= slack
    }
}

/// A pair of outlines, seen from the first.
#[derive(Clone, Copy)]
struct Pair<'a> {
    this: &'a [Vector2],
    other: &'a [Vector2],
    other_bounds: Bounds,
    /// Distances up to this are rounding.
    rounding: f32,
}

/// How a part of an outline lies to the other outline.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Place {
    Inside,
    On,
    Outside,
}

impl<'a> Pair<'a> {
    /// The pair seen from both sides; `None` if the boxes do not meet.
    fn both(a: &'a [Vector2], b: &'a [Vector2]) -> Option<[Pair<'a>; 2]> {
        let (bounds_a, bounds_b) = (Bounds::of(a.iter().copied())?, Bounds::of(b.iter().copied())?);
        let corners = [bounds_a.min, bounds_a.max, bounds_b.min, bounds_b.max];
        let greatest = corners.iter().fold(0.0_f32, |greatest, corner| greatest.max(corner.amax()));
        let rounding = 4.0 * f32::EPSILON * greatest;
        let is_finite = corners.iter().all(|corner| corner.x.is_finite() && corner.y.is_finite());
        (is_finite && bounds_a.meets(&bounds_b, rounding)).then_some([
            Pair { this: a, other: b, other_bounds: bounds_b, rounding },
            Pair { this: b, other: a, other_bounds: bounds_a, rounding },
        ])
    }

    fn place(&self, point: Vector2) -> Place {
        let at_point = Bounds { min: point, max: point };
        if !at_point.meets(&self.other_bounds, self.rounding) {
            return Place::Outside;
        }
        match nearest(self.other, point) {
            Some(nearest) if nearest.distance < -self.rounding => Place::Inside,
            Some(nearest) if nearest.distance <= self.rounding => Place::On,
            _ => Place::Outside,
        }
    }

    /// The pairs of edges whose boxes meet.
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

    /// Whether a part of an edge of this outline lies inside the other. Without it, whether all of this outline
    /// lies on the other is the second answer.
    fn has_edge_inside(&self) -> (bool, bool) {
        let mut all_on = true;
        for edge in edges(self.this) {
            let mut start = 0.0;
            while start < 1.0 {
                let end = self.next_touch(edge, start);
                let middle = edge.0 + (edge.1 - edge.0) * ((start + end) * 0.5);
                match self.place(middle) {
                    Place::Inside => return (true, false),
                    Place::On => {}
                    Place::Outside => all_on = false,
                }
                start = end;
            }
        }
        (false, all_on)
    }

    /// Where along an edge, 0 to 1, the next vertex of the other outline lies on it; 1 if none does.
    fn next_touch(&self, (a, b): (Vector2, Vector2), start: f32) -> f32 {
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

/// Where two edges cross, if the ends of each lie on both sides of the other, farther from it than `rounding`.
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

/// Whether the insides of two outlines overlap. Outlines that only touch do not, nor do those without an inside.
pub(crate) fn outlines_overlap(a: &[Vector2], b: &[Vector2]) -> bool {
    let Some([from_a, from_b]) = Pair::both(a, b) else { return false };
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
    // No edge of one lies inside the other: they are apart, or they are the same.
    is_all_on && inner_point(a).is_some_and(|point| from_a.place(point) == Place::Inside)
}

/// A point inside an outline: half way through it on a level between two vertices, where these are farthest apart.
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

/// Adds the vertices of what two outlines have in common: those of one that lie inside or on the other, and the
/// crossings of their edges. Points may occur twice. Outlines that do not overlap give the points where they touch.
pub(crate) fn overlap_points(a: &[Vector2], b: &[Vector2], points: &mut Vec<Vector2>) {
    let Some(pairs) = Pair::both(a, b) else { return };
    for pair in &pairs {
        let inside = pair.this.iter().filter(|vertex| pair.place(**vertex) != Place::Outside);
        points.extend(inside);
    }
    let [from_a, _] = pairs;
    points.extend(from_a.meeting_edges().filter_map(|(edge, other)| crossing(edge, other, from_a.rounding)));
}

/// Two of the points that are far apart: the farthest from the middle of all, and the farthest from that. Both are
/// the same if all points are. `None` without points.
pub(crate) fn span_of(points: &[Vector2]) -> Option<[Vector2; 2]> {
    let first = *points.first()?;
    let sum = points.iter().fold(Vector2::new(0.0, 0.0), |sum, point| sum + (point - first));
    let middle = first + sum * (1.0 / points.len() as f32);
    let start = farthest(points, middle)?;
    Some([start, farthest(points, start)?])
}

/// The farthest of the points; of those that are about as far the first, so that rounding does not make the choice
/// jump from step to step.
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
