//! What something upright covers of the floor: a disc, or a convex polygon, in the plane of x and z.
//!
//! Polygons are wound as the outlines of the precise set, with x and z in place of x and y: an edge from p to q looks out
//! along (q.z - p.z, p.x - q.x).

use crate::math::plane::{Vector, cross, difference, dot, length, scaled, sum};
use crate::precise::parameters::depth::{FOOTPRINT_CORNERS, LEVEL_EDGE_SLOPE};

/// Corners of a convex polygon.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub(super) struct Polygon {
    points: [Vector; FOOTPRINT_CORNERS],
    count: usize,
}

impl Polygon {
    /// Of these corners, the first of them that there is room for.
    pub(super) fn new(corners: impl IntoIterator<Item = Vector>) -> Self {
        let mut polygon = Polygon::default();
        corners.into_iter().for_each(|corner| polygon.push(corner));
        polygon
    }

    pub(super) fn rectangle([left, near]: Vector, [right, far]: Vector) -> Self {
        Polygon::new([[left, near], [right, near], [right, far], [left, far]])
    }

    pub(super) fn push(&mut self, corner: Vector) {
        if self.count < FOOTPRINT_CORNERS {
            self.points[self.count] = corner;
            self.count += 1;
        }
    }

    pub(super) fn points(&self) -> &[Vector] {
        &self.points[..self.count]
    }

    /// Each edge, as its ends.
    pub(super) fn edges(&self) -> impl Iterator<Item = [Vector; 2]> + '_ {
        let points = self.points();
        (0..points.len()).map(|at| [points[at], points[(at + 1) % points.len()]])
    }

    /// The greatest coordinate in a direction.
    pub(super) fn reach(&self, direction: Vector) -> f32 {
        let along = self.points().iter().map(|&point| dot(point, direction));
        along.fold(f32::MIN, |most, one| if one > most { one } else { most })
    }

    /// From where to where what of it is farthest in a direction reaches aside: a corner, or an edge that lies across.
    fn front(&self, direction: Vector, aside: Vector) -> [f32; 2] {
        let places = self.points().iter().map(|&point| [dot(point, direction), dot(point, aside)]);
        let farther = |one: Vector, other: Vector| if other[0] > one[0] { other } else { one };
        let [most, there] = places.clone().reduce(farther).unwrap_or_default();
        let is_level = |&[out, at]: &Vector| most - out <= LEVEL_EDGE_SLOPE * (at - there).abs();
        places.filter(is_level).fold([there; 2], |[low, high], [_, at]| [low.min(at), high.max(at)])
    }

    /// The edge from which a point is farthest out: how far, the edge's ends, and its direction out.
    fn outermost(&self, point: Vector) -> (f32, [Vector; 2], Vector) {
        let mut best = (f32::MIN, [[0.0; 2]; 2], [1.0, 0.0]);
        for [start, end] in self.edges() {
            let Some(out) = outward(start, end) else { continue };
            let apart = dot(out, difference(point, start));
            if apart > best.0 {
                best = (apart, [start, end], out);
            }
        }
        best
    }
}

/// The direction out of an edge; none for one without length.
fn outward(start: Vector, end: Vector) -> Option<Vector> {
    let edge = difference(end, start);
    let length = length(edge);
    (length > 0.0 && length.is_finite()).then(|| [edge[1] / length, -edge[0] / length])
}

/// A disc of a radius, or a polygon if that has corners; about a place.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub(super) struct Foot {
    pub(super) radius: f32,
    pub(super) polygon: Polygon,
}

/// How far two are apart on the floor.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Gap {
    /// Negative for an overlap.
    pub(super) apart: f32,
    /// From the first to the second.
    pub(super) normal: Vector,
    /// Whether the normal is that of no edge.
    pub(super) is_curved: bool,
}

impl Gap {
    fn flipped(self) -> Self {
        Gap { normal: scaled(self.normal, -1.0), ..self }
    }
}

impl Foot {
    pub(super) fn disc(radius: f32) -> Self {
        Foot { radius, polygon: Polygon::default() }
    }

    pub(super) fn of(polygon: Polygon) -> Self {
        Foot { radius: 0.0, polygon }
    }

    pub(super) fn is_disc(&self) -> bool {
        self.polygon.count == 0
    }

    /// How far it reaches in a direction from its place.
    pub(super) fn reach(&self, direction: Vector) -> f32 {
        if self.is_disc() { self.radius } else { self.polygon.reach(direction) }
    }

    /// The point of it that is farthest in a direction, from its place.
    pub(super) fn farthest(&self, direction: Vector) -> Vector {
        if self.is_disc() {
            return scaled(direction, self.radius);
        }
        let points = self.polygon.points().iter().copied();
        let farther = |a: Vector, b: Vector| if dot(b, direction) > dot(a, direction) { b } else { a };
        points.reduce(farther).unwrap_or_default()
    }

    /// Least and greatest x of what is of it between two z, from its place; none if nothing is.
    pub(super) fn span(&self, near: f32, far: f32) -> Option<[f32; 2]> {
        if self.is_disc() {
            let off = if near > 0.0 {
                near
            } else if far < 0.0 {
                -far
            } else {
                0.0
            };
            let squared = self.radius * self.radius - off * off;
            return (near <= far && squared >= 0.0).then(|| [-squared.sqrt(), squared.sqrt()]);
        }
        let mut span: Option<[f32; 2]> = None;
        let mut add = |x: f32| {
            let [low, high] = span.unwrap_or([x, x]);
            span = Some([if x < low { x } else { low }, if x > high { x } else { high }]);
        };
        for [start, end] in self.polygon.edges() {
            let (low, high) = if start[1] <= end[1] { (start, end) } else { (end, start) };
            let (from, to) = (low[1].max(near), high[1].min(far));
            if from > to {
                continue;
            }
            if low[1] == high[1] {
                add(low[0]);
                add(high[0]);
                continue;
            }
            let rate = (high[0] - low[0]) / (high[1] - low[1]);
            add(low[0] + rate * (from - low[1]));
            add(low[0] + rate * (to - low[1]));
        }
        span
    }

    /// The place of it that is nearest to another one along the normal of the gap between both: in the middle of what of both is
    /// there.
    pub(super) fn facing(&self, other: &Foot, at: Vector, normal: Vector) -> Vector {
        if self.is_disc() {
            return self.farthest(normal);
        }
        let aside = [-normal[1], normal[0]];
        let [low, high] = self.polygon.front(normal, aside);
        let [from, to] =
            if other.is_disc() { [0.0; 2] } else { other.polygon.front(scaled(normal, -1.0), aside) };
        let middle = 0.5 * (low.max(from + dot(at, aside)) + high.min(to + dot(at, aside)));
        sum(scaled(normal, self.reach(normal)), scaled(aside, middle))
    }

    /// How far another one, at a place as seen from this one's, is apart.
    pub(super) fn gap(&self, other: &Foot, at: Vector) -> Gap {
        match (self.is_disc(), other.is_disc()) {
            (true, true) => discs(self.radius + other.radius, at),
            (false, true) => disc_beside(&self.polygon, at, other.radius),
            (true, false) => disc_beside(&other.polygon, scaled(at, -1.0), self.radius).flipped(),
            (false, false) => polygons(&self.polygon, &other.polygon, at),
        }
    }
}

fn discs(radii: f32, at: Vector) -> Gap {
    let distance = length(at);
    // One in the middle of the other leaves along x.
    let normal = if distance > 0.0 { scaled(at, 1.0 / distance) } else { [1.0, 0.0] };
    Gap { apart: distance - radii, normal, is_curved: true }
}

fn disc_beside(polygon: &Polygon, at: Vector, radius: f32) -> Gap {
    let (apart, [start, end], out) = polygon.outermost(at);
    let edge = difference(end, start);
    let [from_start, from_end] = [start, end].map(|corner| difference(at, corner));
    let corner = if dot(from_start, edge) < 0.0 {
        Some(from_start)
    } else if dot(from_end, edge) > 0.0 {
        Some(from_end)
    } else {
        None
    };
    match corner.map(|way| (way, length(way))) {
        Some((way, distance)) if apart > 0.0 && distance > 0.0 => {
            Gap { apart: distance - radius, normal: scaled(way, 1.0 / distance), is_curved: true }
        }
        _ => Gap { apart: apart - radius, normal: out, is_curved: false },
    }
}

fn polygons(a: &Polygon, b: &Polygon, at: Vector) -> Gap {
    let mut best = Gap { apart: f32::MIN, normal: [1.0, 0.0], is_curved: false };
    let mut consider = |normal: Vector| {
        let apart = dot(at, normal) - a.reach(normal) - b.reach(scaled(normal, -1.0));
        if apart > best.apart {
            best = Gap { apart, normal, is_curved: false };
        }
    };
    a.edges().filter_map(|[start, end]| outward(start, end)).for_each(&mut consider);
    let of_b = b.edges().filter_map(|[start, end]| outward(start, end));
    of_b.for_each(|normal| consider(scaled(normal, -1.0)));
    best
}

/// The highest place of a sloping surface over what a foot covers of a convex part of the floor.
#[derive(Debug, Clone, Copy)]
pub(super) struct Summit {
    /// From the foot's place.
    pub(super) at: Vector,
    /// How far up the slope.
    pub(super) height: f32,
    /// The edge of the part on which it is, unless it is on the foot's own rim alone.
    pub(super) edge: Option<usize>,
}

/// Where a foot reaches farthest up a slope, within a convex part of the floor that is given as seen from its place.
pub(super) fn summit(foot: &Foot, part: &Polygon, slope: Vector) -> Option<Summit> {
    let mut best: Option<Summit> = None;
    let mut consider = |at: Vector, edge: Option<usize>| {
        let height = dot(at, slope);
        if best.is_none_or(|best| height > best.height) {
            best = Some(Summit { at, height, edge });
        }
    };
    let steepness = length(slope);
    let own = foot.farthest(if steepness > 0.0 { scaled(slope, 1.0 / steepness) } else { [0.0; 2] });
    if holds(part, own) {
        consider(own, None);
    }
    if !foot.is_disc() {
        foot.polygon
            .points()
            .iter()
            .filter(|&&corner| holds(part, corner))
            .for_each(|&at| consider(at, None));
    }
    for (edge, [start, end]) in part.edges().enumerate() {
        for at in inside(foot, start, end).into_iter().flatten() {
            consider(at, Some(edge));
        }
    }
    best
}

fn holds(part: &Polygon, point: Vector) -> bool {
    part.edges().all(|[start, end]| cross(difference(end, start), difference(point, start)) >= 0.0)
}

/// The ends of what of a segment is within a foot.
fn inside(foot: &Foot, start: Vector, end: Vector) -> Option<[Vector; 2]> {
    let way = difference(end, start);
    let (mut from, mut to) = (0.0f32, 1.0f32);
    if foot.is_disc() {
        let (a, b) = (dot(way, way), dot(start, way));
        let root = b * b - a * (dot(start, start) - foot.radius * foot.radius);
        if !(root >= 0.0 && a > 0.0) {
            return None;
        }
        (from, to) = (from.max((-b - root.sqrt()) / a), to.min((-b + root.sqrt()) / a));
    } else {
        for [first, second] in foot.polygon.edges() {
            let edge = difference(second, first);
            let (here, rate) = (cross(edge, difference(start, first)), cross(edge, way));
            if rate == 0.0 {
                if here < 0.0 {
                    return None;
                }
            } else if rate > 0.0 {
                from = from.max(-here / rate);
            } else {
                to = to.min(-here / rate);
            }
        }
    }
    (from <= to).then(|| [from, to].map(|part| sum(start, scaled(way, part))))
}

#[cfg(test)]
mod tests {
    use super::{Foot, Polygon, summit};

    fn square(half: f32) -> Foot {
        Foot::of(Polygon::rectangle([-half; 2], [half; 2]))
    }

    #[test]
    fn discs_are_apart_by_the_distance_of_their_middles() {
        let gap = Foot::disc(10.0).gap(&Foot::disc(5.0), [16.0, 12.0]);
        assert_eq!((gap.apart, gap.normal), (5.0, [0.8, 0.6]));
    }

    #[test]
    fn a_disc_beside_a_square_is_nearest_to_its_side_or_to_its_corner() {
        let side = square(10.0).gap(&Foot::disc(2.0), [15.0, 3.0]);
        assert_eq!((side.apart, side.normal, side.is_curved), (3.0, [1.0, 0.0], false));
        let corner = Foot::disc(2.0).gap(&square(10.0), [-13.0, -14.0]);
        assert_eq!((corner.apart, corner.normal, corner.is_curved), (3.0, [-0.6, -0.8], true));
    }

    #[test]
    fn squares_meet_along_the_side_that_parts_them_most() {
        let gap = square(10.0).gap(&square(5.0), [2.0, 14.5]);
        assert_eq!((gap.apart, gap.normal), (-0.5, [0.0, 1.0]));
    }

    #[test]
    fn what_is_pushed_by_a_long_side_is_met_where_it_is_and_not_at_the_sides_end() {
        let wall = Foot::of(Polygon::rectangle([-50.0, -3.0], [50.0, 3.0]));
        // With a side of its own, in the middle of that; past the end of the wall in the middle of what is beside it.
        let near = |small: &Foot, at: [f32; 2]| wall.facing(small, at, [0.0, 1.0]);
        assert_eq!(near(&square(4.0), [20.0, 7.0]), [20.0, 3.0]);
        assert_eq!(near(&square(4.0), [52.0, 7.0]), [49.0, 3.0]);
        assert_eq!(near(&Foot::disc(4.0), [20.0, 7.0]), [20.0, 3.0]);
        // With a corner there; and the wall's corner on its side.
        let edgeways = Foot::of(Polygon::new([[0.0, -5.0], [5.0, 0.0], [0.0, 5.0], [-5.0, 0.0]]));
        assert_eq!(near(&edgeways, [20.0, 8.0]), [20.0, 3.0]);
        assert_eq!(square(4.0).facing(&edgeways, [9.0, 1.0], [1.0, 0.0]), [4.0, 1.0]);
        assert_eq!(edgeways.facing(&square(4.0), [-9.0, 1.0], [-1.0, 0.0]), [-5.0, 0.0]);
    }

    #[test]
    fn what_of_a_disc_is_between_two_depths_is_as_wide_as_its_chord() {
        assert_eq!(Foot::disc(5.0).span(3.0, 9.0), Some([-4.0, 4.0]));
        assert_eq!(Foot::disc(5.0).span(-1.0, 9.0), Some([-5.0, 5.0]));
        assert_eq!(Foot::disc(5.0).span(6.0, 9.0), None);
        let wedge = Foot::of(Polygon::new([[-4.0, 0.0], [4.0, 0.0], [0.0, 8.0]]));
        assert_eq!(wedge.span(4.0, 9.0), Some([-2.0, 2.0]));
    }

    #[test]
    fn a_disc_half_over_the_edge_of_a_slope_stands_where_its_rim_meets_the_edge() {
        let part = Polygon::rectangle([-100.0, 3.0], [100.0, 50.0]);
        let found = summit(&Foot::disc(5.0), &part, [1.0, 0.0]).unwrap();
        assert_eq!(found.at, [4.0, 3.0]);
        assert!(found.edge.is_some());
        let whole = Polygon::rectangle([-100.0, -50.0], [100.0, 50.0]);
        assert_eq!(summit(&Foot::disc(5.0), &whole, [1.0, 0.0]).unwrap().at, [5.0, 0.0]);
    }
}
