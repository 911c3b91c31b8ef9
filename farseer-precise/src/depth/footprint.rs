//! Footprint geometry: discs and convex polygons in the plane of x and z, for vertical shapes.
//!
//! Reads positions in length units; gives signed distances, support points and contact points. Polygons are tested with
//! separating axes, one per edge (S. Gottschalk, M. Lin and D. Manocha, "OBBTree", 1996). A disc also has the axes of the
//! polygon's vertices.
//!
//! Winding is that of outlines, with z in place of y: the edge from p to q has the outward normal (q.z - p.z, p.x - q.x).

use crate::math::plane::{Vector, cross, difference, dot, length, scaled, sum};
use crate::parameters::depth::{FOOTPRINT_CORNERS, LEVEL_EDGE_MAX_SLOPE};

/// Convex polygon of at most `FOOTPRINT_CORNERS` vertices, stored inline.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub(super) struct FootprintPolygon {
    points: [Vector; FOOTPRINT_CORNERS],
    count: usize,
}

impl FootprintPolygon {
    /// Returns a polygon with these vertices: x and z in length units, relative to the position of the footprint. Vertices
    /// beyond the capacity are dropped.
    pub(super) fn new(corners: impl IntoIterator<Item = Vector>) -> Self {
        let mut polygon = FootprintPolygon::default();
        corners.into_iter().for_each(|corner| polygon.push(corner));
        polygon
    }

    /// Returns an axis-parallel rectangle from its corner of least x and z and its corner of greatest x and z, in length units.
    pub(super) fn rectangle([left, near]: Vector, [right, far]: Vector) -> Self {
        FootprintPolygon::new([[left, near], [right, near], [right, far], [left, far]])
    }

    /// Appends a vertex, if there is room.
    pub(super) fn push(&mut self, corner: Vector) {
        if self.count < FOOTPRINT_CORNERS {
            self.points[self.count] = corner;
            self.count += 1;
        }
    }

    pub(super) fn points(&self) -> &[Vector] {
        &self.points[..self.count]
    }

    /// Iterates over the edges of the polygon. Each is a pair of end points: x and z in length units.
    pub(super) fn edges(&self) -> impl Iterator<Item = [Vector; 2]> + '_ {
        let points = self.points();
        (0..points.len()).map(|at| [points[at], points[(at + 1) % points.len()]])
    }

    /// Returns the support function of the polygon: the greatest coordinate of its vertices along the unit vector `direction`,
    /// in length units.
    pub(super) fn support(&self, direction: Vector) -> f32 {
        let along = self.points().iter().map(|&point| dot(point, direction));
        along.fold(f32::MIN, |most, one| if one > most { one } else { most })
    }

    /// Returns the interval that the feature farthest along `direction` covers along `aside`, in length units. The feature is a
    /// vertex, or an edge perpendicular to `direction`. Both arguments are unit vectors in x and z.
    fn support_interval(&self, direction: Vector, aside: Vector) -> [f32; 2] {
        let places = self.points().iter().map(|&point| [dot(point, direction), dot(point, aside)]);
        let farther = |one: Vector, other: Vector| if other[0] > one[0] { other } else { one };
        let [most, there] = places.clone().reduce(farther).unwrap_or_default();
        let is_level = |&[out, at]: &Vector| most - out <= LEVEL_EDGE_MAX_SLOPE * (at - there).abs();
        places.filter(is_level).fold([there; 2], |[low, high], [_, at]| [low.min(at), high.max(at)])
    }

    /// Returns the edge of the polygon with the greatest signed distance to a point: distance (length units, negative inside),
    /// end points (x and z) and outward unit normal of that edge.
    fn max_separation_edge(&self, point: Vector) -> (f32, [Vector; 2], Vector) {
        let mut best = (f32::MIN, [[0.0; 2]; 2], [1.0, 0.0]);
        for [start, end] in self.edges() {
            let Some(out) = outward_normal(start, end) else { continue };
            let apart = dot(out, difference(point, start));
            if apart > best.0 {
                best = (apart, [start, end], out);
            }
        }
        best
    }
}

/// Returns the outward unit normal, in x and z, of the edge from `start` to `end`; `None` for an edge without length.
fn outward_normal(start: Vector, end: Vector) -> Option<Vector> {
    let edge = difference(end, start);
    let length = length(edge);
    (length > 0.0 && length.is_finite()).then(|| [edge[1] / length, -edge[0] / length])
}

/// Footprint of a vertical shape in x and z, relative to the shape's position: a polygon if `polygon` has vertices, else a disc
/// about the position.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub(super) struct FootprintShape {
    /// Radius of the disc in length units, >= 0; 0 for a polygon.
    pub(super) radius: f32,
    pub(super) polygon: FootprintPolygon,
}

/// Signed distance of two footprints, with the unit vector along which it is measured.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct FootprintDistance {
    /// Separation in length units, negative for penetration.
    pub(super) separation: f32,
    /// Unit vector in x and z from the first to the second footprint, dimensionless.
    pub(super) normal: Vector,
    /// Whether the normal is that of a disc or of a vertex. Such a normal rotates as the footprints slide past each other.
    pub(super) is_curved: bool,
}

impl FootprintDistance {
    fn flipped(self) -> Self {
        FootprintDistance { normal: scaled(self.normal, -1.0), ..self }
    }
}

impl FootprintShape {
    pub(super) fn disc(radius: f32) -> Self {
        FootprintShape { radius, polygon: FootprintPolygon::default() }
    }

    pub(super) fn from_polygon(polygon: FootprintPolygon) -> Self {
        FootprintShape { radius: 0.0, polygon }
    }

    pub(super) fn is_disc(&self) -> bool {
        self.polygon.count == 0
    }

    /// Returns the support function of the footprint: the greatest coordinate of its points along the unit vector `direction`,
    /// relative to the footprint's position, in length units.
    pub(super) fn support(&self, direction: Vector) -> f32 {
        if self.is_disc() { self.radius } else { self.polygon.support(direction) }
    }

    /// Returns the support point of the footprint: its farthest point along the unit vector `direction`, as x and z relative to
    /// the footprint's position, in length units.
    pub(super) fn support_point(&self, direction: Vector) -> Vector {
        if self.is_disc() {
            return scaled(direction, self.radius);
        }
        let points = self.polygon.points().iter().copied();
        let farther = |a: Vector, b: Vector| if dot(b, direction) > dot(a, direction) { b } else { a };
        points.reduce(farther).unwrap_or_default()
    }

    /// Returns the least and the greatest x of the footprint's points with `near <= z <= far`; `None` if there is no such
    /// point. All values are in length units, relative to the footprint's position.
    pub(super) fn x_range(&self, near: f32, far: f32) -> Option<[f32; 2]> {
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

    /// Returns the contact point on this footprint: x and z relative to its position, in length units. Along the normal it lies
    /// as far out as the support point. Across the normal it is the middle of the overlap of both touching features, so that a
    /// long side touches where the other footprint is. `at` is the position of the other footprint relative to this one.
    pub(super) fn contact_point(&self, other: &FootprintShape, at: Vector, normal: Vector) -> Vector {
        if self.is_disc() {
            return self.support_point(normal);
        }
        let aside = [-normal[1], normal[0]];
        let [low, high] = self.polygon.support_interval(normal, aside);
        let [from, to] = if other.is_disc() {
            [0.0; 2]
        } else {
            other.polygon.support_interval(scaled(normal, -1.0), aside)
        };
        let middle = 0.5 * (low.max(from + dot(at, aside)) + high.min(to + dot(at, aside)));
        sum(scaled(normal, self.support(normal)), scaled(aside, middle))
    }

    /// Returns the signed distance of this footprint from another one, which has the relative position `at` (x and z in length
    /// units), with the unit normal towards it.
    pub(super) fn distance_to(&self, other: &FootprintShape, at: Vector) -> FootprintDistance {
        match (self.is_disc(), other.is_disc()) {
            (true, true) => disc_disc(self.radius + other.radius, at),
            (false, true) => polygon_disc(&self.polygon, at, other.radius),
            (true, false) => polygon_disc(&other.polygon, scaled(at, -1.0), self.radius).flipped(),
            (false, false) => polygon_polygon(&self.polygon, &other.polygon, at),
        }
    }
}

/// Returns the signed distance (length units) and the normal of two discs. `radii` is the sum of their radii, `at` the position
/// of the second disc relative to the first.
fn disc_disc(radii: f32, at: Vector) -> FootprintDistance {
    let distance = length(at);
    // Concentric discs separate along x.
    let normal = if distance > 0.0 { scaled(at, 1.0 / distance) } else { [1.0, 0.0] };
    FootprintDistance { separation: distance - radii, normal, is_curved: true }
}

/// Returns the signed distance (length units) and the normal of a polygon and a disc, to an edge of the polygon, or to a vertex
/// if the disc lies beyond the end of the edge. `at` is the centre of the disc relative to the polygon's position.
fn polygon_disc(polygon: &FootprintPolygon, at: Vector, radius: f32) -> FootprintDistance {
    let (apart, [start, end], out) = polygon.max_separation_edge(at);
    let edge = difference(end, start);
    let [from_start, from_end] = [start, end].map(|corner| difference(at, corner));
    let corner = if dot(from_start, edge) < 0.0 {
        Some(from_start)
    } else if dot(from_end, edge) > 0.0 {
        Some(from_end)
    } else {
        None
    };
    match corner.map(|offset| (offset, length(offset))) {
        Some((offset, distance)) if apart > 0.0 && distance > 0.0 => FootprintDistance {
            separation: distance - radius,
            normal: scaled(offset, 1.0 / distance),
            is_curved: true,
        },
        _ => FootprintDistance { separation: apart - radius, normal: out, is_curved: false },
    }
}

/// Returns the signed distance (length units) of two polygons along the edge normal of largest separation, and this normal from
/// A to B. `at` is the position of B relative to A.
fn polygon_polygon(a: &FootprintPolygon, b: &FootprintPolygon, at: Vector) -> FootprintDistance {
    let mut best = FootprintDistance { separation: f32::MIN, normal: [1.0, 0.0], is_curved: false };
    let mut consider = |normal: Vector| {
        let apart = dot(at, normal) - a.support(normal) - b.support(scaled(normal, -1.0));
        if apart > best.separation {
            best = FootprintDistance { separation: apart, normal, is_curved: false };
        }
    };
    a.edges().filter_map(|[start, end]| outward_normal(start, end)).for_each(&mut consider);
    let of_b = b.edges().filter_map(|[start, end]| outward_normal(start, end));
    of_b.for_each(|normal| consider(scaled(normal, -1.0)));
    best
}

/// Point of greatest height on a sloped plane, among the points inside of both a footprint and a polygon.
#[derive(Debug, Clone, Copy)]
pub(super) struct HighestPoint {
    /// Position in x and z relative to the footprint's position, in length units.
    pub(super) position: Vector,
    /// Height above the footprint's position on the slope, in length units: scalar product of `position` and the slope vector
    /// (rise by run).
    pub(super) height: f32,
    /// Index of the polygon's edge that the point lies on; `None` for a point inside of the polygon.
    pub(super) edge: Option<usize>,
}

/// Returns the point inside of both a footprint and a polygon that is highest along `slope`; `None` if footprint and polygon do
/// not overlap. `slope` is the rise by run along x and z, dimensionless. The polygon is relative to the position of the
/// footprint. The maximum lies at the footprint's support point, at a vertex of the footprint or on an edge of the polygon.
pub(super) fn highest_point(
    footprint: &FootprintShape,
    polygon: &FootprintPolygon,
    slope: Vector,
) -> Option<HighestPoint> {
    let mut best: Option<HighestPoint> = None;
    let mut consider = |at: Vector, edge: Option<usize>| {
        let height = dot(at, slope);
        if best.is_none_or(|best| height > best.height) {
            best = Some(HighestPoint { position: at, height, edge });
        }
    };
    let steepness = length(slope);
    let own =
        footprint.support_point(if steepness > 0.0 { scaled(slope, 1.0 / steepness) } else { [0.0; 2] });
    if contains(polygon, own) {
        consider(own, None);
    }
    if !footprint.is_disc() {
        footprint
            .polygon
            .points()
            .iter()
            .filter(|&&corner| contains(polygon, corner))
            .for_each(|&at| consider(at, None));
    }
    for (edge, [start, end]) in polygon.edges().enumerate() {
        for at in clip_segment(footprint, start, end).into_iter().flatten() {
            consider(at, Some(edge));
        }
    }
    best
}

/// Returns whether a polygon contains a point (x and z in length units). Points on an edge count as inside.
fn contains(polygon: &FootprintPolygon, point: Vector) -> bool {
    polygon.edges().all(|[start, end]| cross(difference(end, start), difference(point, start)) >= 0.0)
}

/// Returns the end points of the part of a segment inside of a footprint, relative to the footprint's position; `None` if the
/// segment misses the footprint. Line against circle by the quadratic formula; line against polygon by M. Cyrus and J. Beck,
/// "Generalized two- and three-dimensional clipping" (1978).
fn clip_segment(footprint: &FootprintShape, start: Vector, end: Vector) -> Option<[Vector; 2]> {
    let direction = difference(end, start);
    let (mut from, mut to) = (0.0f32, 1.0f32);
    if footprint.is_disc() {
        let (a, b) = (dot(direction, direction), dot(start, direction));
        let root = b * b - a * (dot(start, start) - footprint.radius * footprint.radius);
        if !(root >= 0.0 && a > 0.0) {
            return None;
        }
        (from, to) = (from.max((-b - root.sqrt()) / a), to.min((-b + root.sqrt()) / a));
    } else {
        for [first, second] in footprint.polygon.edges() {
            let edge = difference(second, first);
            let (here, rate) = (cross(edge, difference(start, first)), cross(edge, direction));
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
    (from <= to).then(|| [from, to].map(|part| sum(start, scaled(direction, part))))
}

#[cfg(test)]
mod tests {
    use super::{FootprintPolygon, FootprintShape, highest_point};

    fn square(half: f32) -> FootprintShape {
        FootprintShape::from_polygon(FootprintPolygon::rectangle([-half; 2], [half; 2]))
    }

    #[test]
    fn disc_disc_separation_is_centre_distance_minus_radii() {
        let gap = FootprintShape::disc(10.0).distance_to(&FootprintShape::disc(5.0), [16.0, 12.0]);
        assert_eq!((gap.separation, gap.normal), (5.0, [0.8, 0.6]));
    }

    #[test]
    fn disc_square_normal_is_that_of_the_nearest_face_or_vertex() {
        let side = square(10.0).distance_to(&FootprintShape::disc(2.0), [15.0, 3.0]);
        assert_eq!((side.separation, side.normal, side.is_curved), (3.0, [1.0, 0.0], false));
        let corner = FootprintShape::disc(2.0).distance_to(&square(10.0), [-13.0, -14.0]);
        assert_eq!((corner.separation, corner.normal, corner.is_curved), (3.0, [-0.6, -0.8], true));
    }

    #[test]
    fn squares_collide_along_the_axis_of_least_penetration() {
        let gap = square(10.0).distance_to(&square(5.0), [2.0, 14.5]);
        assert_eq!((gap.separation, gap.normal), (-0.5, [0.0, 1.0]));
    }

    #[test]
    fn contact_point_is_the_middle_of_the_overlap_of_both_sides() {
        let wall = FootprintShape::from_polygon(FootprintPolygon::rectangle([-50.0, -3.0], [50.0, 3.0]));
        // A square's side against the wall: middle of the side. Beyond the wall's end: middle of the overlap.
        let near = |small: &FootprintShape, at: [f32; 2]| wall.contact_point(small, at, [0.0, 1.0]);
        assert_eq!(near(&square(4.0), [20.0, 7.0]), [20.0, 3.0]);
        assert_eq!(near(&square(4.0), [52.0, 7.0]), [49.0, 3.0]);
        assert_eq!(near(&FootprintShape::disc(4.0), [20.0, 7.0]), [20.0, 3.0]);
        // A vertex against the wall; then the wall's vertex against a square's side.
        let edgeways = FootprintShape::from_polygon(FootprintPolygon::new([
            [0.0, -5.0],
            [5.0, 0.0],
            [0.0, 5.0],
            [-5.0, 0.0],
        ]));
        assert_eq!(near(&edgeways, [20.0, 8.0]), [20.0, 3.0]);
        assert_eq!(square(4.0).contact_point(&edgeways, [9.0, 1.0], [1.0, 0.0]), [4.0, 1.0]);
        assert_eq!(edgeways.contact_point(&square(4.0), [-9.0, 1.0], [-1.0, 0.0]), [-5.0, 0.0]);
    }

    #[test]
    fn x_range_of_a_disc_between_two_depths_is_its_chord() {
        assert_eq!(FootprintShape::disc(5.0).x_range(3.0, 9.0), Some([-4.0, 4.0]));
        assert_eq!(FootprintShape::disc(5.0).x_range(-1.0, 9.0), Some([-5.0, 5.0]));
        assert_eq!(FootprintShape::disc(5.0).x_range(6.0, 9.0), None);
        let wedge =
            FootprintShape::from_polygon(FootprintPolygon::new([[-4.0, 0.0], [4.0, 0.0], [0.0, 8.0]]));
        assert_eq!(wedge.x_range(4.0, 9.0), Some([-2.0, 2.0]));
    }

    #[test]
    fn highest_point_of_a_disc_over_the_edge_of_a_slope_lies_on_the_edge() {
        let part = FootprintPolygon::rectangle([-100.0, 3.0], [100.0, 50.0]);
        let found = highest_point(&FootprintShape::disc(5.0), &part, [1.0, 0.0]).unwrap();
        assert_eq!(found.position, [4.0, 3.0]);
        assert!(found.edge.is_some());
        let whole = FootprintPolygon::rectangle([-100.0, -50.0], [100.0, 50.0]);
        assert_eq!(
            highest_point(&FootprintShape::disc(5.0), &whole, [1.0, 0.0]).unwrap().position,
            [5.0, 0.0]
        );
    }
}
