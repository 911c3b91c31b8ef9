//! Narrow phase of a vertical shape without rounding against a prism along z, which may be rotated in the plane.
//!
//! | axis | contact |
//! |---|---|
//! | vertical | highest point of the prism's outline over the range of x that the footprint covers |
//! | lateral | footprint against the prism seen from above: a rectangle, as wide as the outline at the shape's heights |

use super::footprint::{FootprintPolygon, FootprintShape};
use super::posed_solid::{ContactMargins, PosedSolid, PreviousAxis};
use super::vertical_shapes::{
    AxisCandidates, AxisContact, LATERAL_AXIS_FEATURE, PosedVertical, SeparatingAxis, VERTICAL_AXIS_FEATURE,
    clamp_any, collide_along_chosen_axis, larger_separation, relative_displacement,
};
use super::vertical_solid::VerticalSolid;
use crate::math::plane::{Vector, difference, dot, length, rotate, rotation, scaled, sum, translation};
use crate::narrow_phase::manifold::Manifold;
use crate::parameters::depth::{
    FLAT_INTERVAL_INSET, FLAT_INTERVAL_MIN_RATIO, NEARER_CORNER_MIN_ADVANTAGE, SLOPE_MIN_NORMAL_UP,
    TERNARY_SEARCH_STEPS, VERTICAL_NORMAL_COSINE,
};

/// Prism along z with its world pose.
#[derive(Clone, Copy)]
pub(super) struct PosedPrism<'s, 'a> {
    solid: &'s PosedSolid<'a>,
    /// Least z of the prism in world coordinates, length units.
    near_z: f32,
    /// Greatest z of the prism in world coordinates, length units.
    far_z: f32,
}

/// Point on the outline of a prism, with the outward normal there.
#[derive(Debug, Clone, Copy)]
struct SurfacePoint {
    /// Position in world coordinates x and y, length units.
    position: Vector,
    /// Outward unit normal of the outline at the point, in world axes x and y. Dimensionless.
    normal: Vector,
    /// Index of the outline's edge that the point lies on; `None` on a rounded part of the outline.
    edge: Option<usize>,
}

impl<'s, 'a> PosedPrism<'s, 'a> {
    pub(super) fn new(solid: &'s PosedSolid<'a>, half: f32) -> Self {
        PosedPrism { solid, near_z: solid.z - half, far_z: solid.z + half }
    }

    /// Returns the rounding radius of the outline, in length units.
    fn radius(&self) -> f32 {
        self.solid.outline.shape.radius
    }

    /// Returns a point of the body's frame in world coordinates x and y, length units.
    fn to_world(self, point: Vector) -> Vector {
        sum(translation(self.solid.pose), rotate(rotation(self.solid.pose), point))
    }

    /// Iterates over the vertices of the outline in world coordinates x and y, length units. For a rounded outline these are
    /// the centres of its circles.
    fn vertices(&self) -> impl Iterator<Item = Vector> + '_ {
        let outline = &self.solid.outline;
        let centre = std::slice::from_ref(&outline.shape.centre);
        let points = if outline.vertices.is_empty() { centre } else { outline.vertices };
        points.iter().map(|&point| self.to_world(point))
    }

    /// Iterates over the edges of the outline: index, end points in world coordinates x and y (length units), outward unit
    /// normal in world axes.
    fn edges(&self) -> impl Iterator<Item = (usize, [Vector; 2], Vector)> + '_ {
        let outline = &self.solid.outline;
        let count = outline.vertices.len();
        outline.normals.iter().enumerate().map(move |(at, &normal)| {
            let out = rotate(rotation(self.solid.pose), normal);
            let ends = [outline.vertices[at], outline.vertices[(at + 1) % count]];
            (at, ends.map(|end| sum(self.to_world(end), scaled(out, self.radius()))), out)
        })
    }

    /// Returns the least and the greatest world coordinate of the prism along x (`axis` 0) or y (`axis` 1), in length units.
    fn extent(&self, axis: usize) -> [f32; 2] {
        let around = self.radius();
        let bounds = self.vertices().fold([f32::MAX, f32::MIN], |[low, high], corner| {
            let at = corner[axis];
            [if at < low { at } else { low }, if at > high { at } else { high }]
        });
        [bounds[0] - around, bounds[1] + around]
    }

    /// Returns the least and the greatest world x of the faces that look up (`up` -1) or down (`up` 1), in length units. Faces
    /// with the normal of a wall do not count.
    fn facing_x_range(&self, up: f32) -> [f32; 2] {
        let faces = self.edges().filter(|(.., out)| up * out[1] > SLOPE_MIN_NORMAL_UP);
        let ends = faces.flat_map(|(_, ends, _)| ends.map(|[x, _]| x));
        // For zeros of different sign, `min` and `max` differ between processors.
        let [least, most] = ends.fold([f32::MAX, f32::MIN], |[least, most], x| {
            [if x < least { x } else { least }, if x > most { x } else { most }]
        });
        if self.radius() > 0.0 || least > most { self.extent(0) } else { [least, most] }
    }

    /// Returns whether the vertical shape `u` stays in front of a face of the prism and so misses the prism, when it moves by
    /// `displacement` relative to the prism (x, y, z in length units). Faces with the contact normal do not count.
    fn will_be_missed(&self, u: PosedVertical<'_>, displacement: [f32; 3], normal: [f32; 3]) -> bool {
        self.edges().any(|(_, [start, _], out)| {
            let [x, y, _] = u.support_point([-out[0], -out[1], 0.0]);
            let apart = dot(out, difference([x, y], start));
            let is_other = (out[0] * normal[0] + out[1] * normal[1]).abs() < VERTICAL_NORMAL_COSINE;
            is_other && apart > 0.0 && apart + dot(out, [displacement[0], displacement[1]]) > 0.0
        })
    }

    /// Returns the highest (`up` -1) or lowest (`up` 1) point of the outline with `left <= x <= right`, and the other end of
    /// the same edge within this range of x. `None` if no face looks up or down there. World coordinates, length units.
    fn highest_point(&self, left: f32, right: f32, up: f32) -> Option<[SurfacePoint; 2]> {
        let mut best: Option<[SurfacePoint; 2]> = None;
        let mut consider = |spot: SurfacePoint, other: SurfacePoint| {
            let is_higher = best.is_none_or(|[best, _]| {
                let (height, most) = (up * spot.position[1], up * best.position[1]);
                height > most || (height == most && up * spot.normal[1] > up * best.normal[1])
            });
            if is_higher {
                best = Some([spot, other]);
            }
        };
        for (edge, [start, end], out) in self.edges().filter(|(.., out)| up * out[1] > SLOPE_MIN_NORMAL_UP) {
            let (low, high) = if start[0] <= end[0] { (start, end) } else { (end, start) };
            let (from, to) = (low[0].max(left), high[0].min(right));
            if from > to {
                continue;
            }
            let width = high[0] - low[0];
            let spot = |x: f32| {
                let y =
                    if width > 0.0 { low[1] + (high[1] - low[1]) * ((x - low[0]) / width) } else { low[1] };
                // A vertex inside of the range belongs to no single face: a flat footprint lies level on it.
                let is_corner = (x == low[0] && x > left) || (x == high[0] && x < right);
                let out = if is_corner && !is_level(out) { [0.0, up] } else { out };
                SurfacePoint { position: [x, y], normal: out, edge: Some(edge) }
            };
            consider(spot(from), spot(to));
            consider(spot(to), spot(from));
        }
        let radius = self.radius();
        for centre in self.vertices().filter(|_| radius > 0.0) {
            let x = clamp_any(centre[0], left, right);
            let aside = x - centre[0];
            let squared = radius * radius - aside * aside;
            if squared > 0.0 {
                let out = [aside / radius, up * squared.sqrt() / radius];
                let spot =
                    SurfacePoint { position: sum(centre, scaled(out, radius)), normal: out, edge: None };
                consider(spot, spot);
            }
        }
        best
    }

    /// Returns the signed distance of a point (world coordinates x and y) from the outline in length units, negative inside.
    fn signed_distance(&self, point: Vector) -> f32 {
        let (mut out_of_face, mut away) = (f32::MIN, f32::MAX);
        for (_, [start, end], out) in self.edges() {
            let (edge, from) = (difference(end, start), difference(point, start));
            let fraction = (dot(from, edge) / dot(edge, edge)).clamp(0.0, 1.0);
            let apart = length(difference(from, scaled(edge, fraction)));
            out_of_face = out_of_face.max(dot(out, from));
            away = away.min(apart);
        }
        if out_of_face > 0.0 { away } else { out_of_face }
    }

    /// Returns the leftmost (`side` -1) or rightmost (`side` 1) point of the outline with `top <= y <= bottom` (world
    /// coordinates, y down, length units); `None` if the outline has no point there.
    fn side_point(&self, top: f32, bottom: f32, side: f32) -> Option<SurfacePoint> {
        let mut best: Option<SurfacePoint> = None;
        let mut consider = |spot: SurfacePoint| {
            if best.is_none_or(|best| side * spot.position[0] > side * best.position[0]) {
                best = Some(spot);
            }
        };
        for (edge, [start, end], out) in self.edges() {
            let (high, low) = if start[1] <= end[1] { (start, end) } else { (end, start) };
            let (from, to) = (high[1].max(top), low[1].min(bottom));
            if from > to {
                continue;
            }
            let height = low[1] - high[1];
            for y in [from, to] {
                let fraction = if height > 0.0 { (y - high[1]) / height } else { 0.0 };
                let is_corner = (y == high[1] && y > top) || (y == low[1] && y < bottom) || height == 0.0;
                let out = if is_corner || side * out[0] <= 0.0 { [side, 0.0] } else { out };
                consider(SurfacePoint {
                    position: [high[0] + (low[0] - high[0]) * fraction, y],
                    normal: out,
                    edge: Some(edge),
                });
            }
            if height == 0.0 {
                consider(SurfacePoint { position: low, normal: [side, 0.0], edge: Some(edge) });
            }
        }
        let radius = self.radius();
        for centre in self.vertices().filter(|_| radius > 0.0) {
            let off = clamp_any(centre[1], top, bottom) - centre[1];
            let squared = radius * radius - off * off;
            if squared > 0.0 {
                let out = [side * squared.sqrt() / radius, off / radius];
                consider(SurfacePoint {
                    position: sum(centre, scaled(out, radius)),
                    normal: out,
                    edge: None,
                });
            }
        }
        best
    }
}

/// Returns whether a face with this outward unit normal (x, y) deviates from level by less than 0.001 radians.
fn is_level(out: Vector) -> bool {
    out[0].abs() < 1e-3
}

/// Returns the contacts of a vertical shape (A) and a prism along the vertical and the lateral axis. `contact_margin` is in
/// length units.
pub(super) fn axis_candidates(
    u: PosedVertical<'_>,
    prism: &PosedPrism<'_, '_>,
    contact_margin: f32,
) -> AxisCandidates {
    let [top, bottom] = prism.extent(1);
    let down = vertical_axis_contact(u, prism, 1.0);
    let up = vertical_axis_contact(u, prism, -1.0);
    AxisCandidates {
        vertical: if up.separation > down.separation { up } else { down },
        lateral: lateral_axis_contact(u, prism, [top, bottom], contact_margin),
    }
}

/// Returns the contact of a vertical shape (A) and a prism along the vertical axis, with the prism below the shape (`down` 1)
/// or above the shape (`down` -1).
fn vertical_axis_contact(u: PosedVertical<'_>, prism: &PosedPrism<'_, '_>, down: f32) -> AxisContact {
    let [x, y, z] = u.position;
    let footprint: &FootprintShape = &u.shape.footprint;
    let whole = || [-footprint.support([-1.0, 0.0]), footprint.support([1.0, 0.0])];
    let [from, to] = footprint.x_range(prism.near_z - z, prism.far_z - z).unwrap_or_else(whole);
    // If the footprint is beside the prism, the nearer end of the top counts.
    let [least, most] = prism.facing_x_range(-down);
    let (left, right) = (clamp_any(x + from, least, most), clamp_any(x + to, least, most));
    let sole = y + down * u.shape.half_height;
    let depth = common_z(u, prism);
    let Some([spot, other]) = prism.highest_point(left, right, -down) else {
        return AxisContact::single_point(
            f32::MIN,
            [0.0, down, 0.0],
            [x, sole, depth],
            VERTICAL_AXIS_FEATURE,
        );
    };
    let out = spot.normal;
    let apart = |spot: &SurfacePoint| down * (spot.position[1] - sole) * -down * out[1];
    let point =
        |spot: &SurfacePoint| ([spot.position[0], 0.5 * (spot.position[1] + sole), depth], apart(spot));
    let mut found = AxisContact::single_point(apart(&spot), [-out[0], -out[1], 0.0], point(&spot).0, 0);
    // The left point comes first, so that feature ids are constant.
    found.count = if spot.edge.is_some() && spot.position != other.position { 2 } else { 1 };
    let (first, second) = if spot.position[0] <= other.position[0] { (spot, other) } else { (other, spot) };
    found.points = if found.count == 2 { [point(&first), point(&second)] } else { [point(&spot); 2] };
    found.feature = VERTICAL_AXIS_FEATURE + if down < 0.0 { 1 << 6 } else { 0 };
    found
}

/// Returns the middle of the overlap of a vertical shape and a prism along z, or of the gap between them, in world coordinates,
/// length units.
fn common_z(u: PosedVertical<'_>, prism: &PosedPrism<'_, '_>) -> f32 {
    let foot = &u.shape.footprint;
    let near = (u.position[2] - foot.support([0.0, -1.0])).max(prism.near_z);
    let far = (u.position[2] + foot.support([0.0, 1.0])).min(prism.far_z);
    0.5 * near + 0.5 * far
}

/// Returns the outermost point of a prism on a side, -1 (left) or 1 (right), at heights within `reach`; without such a point
/// within `extent`, else its origin. Both are ranges of world y, length units.
fn outermost_point(prism: &PosedPrism<'_, '_>, reach: [f32; 2], extent: [f32; 2], side: f32) -> SurfacePoint {
    let within = prism.side_point(reach[0], reach[1], side);
    within.or_else(|| prism.side_point(extent[0], extent[1], side)).unwrap_or(SurfacePoint {
        position: translation(prism.solid.pose),
        normal: [side, 0.0],
        edge: None,
    })
}

/// Returns the contact of a vertical shape (A) and a prism along the lateral axis. A flat side of the prism gives two contact
/// points. `top` and `bottom` are the least and the greatest world y of the prism, in length units.
fn lateral_axis_contact(
    u: PosedVertical<'_>,
    prism: &PosedPrism<'_, '_>,
    [top, bottom]: [f32; 2],
    contact_margin: f32,
) -> AxisContact {
    let [x, y, z] = u.position;
    let (from, to) = (y - u.shape.half_height, y + u.shape.half_height);
    let reach = [from - contact_margin, to + contact_margin];
    let [left, right] = [-1.0, 1.0].map(|side| outermost_point(prism, reach, [top, bottom], side));
    let rectangle = FootprintPolygon::rectangle(
        [left.position[0] - x, prism.near_z - z],
        [right.position[0] - x, prism.far_z - z],
    );
    let seen = FootprintShape::from_polygon(rectangle);
    let gap = u.shape.footprint.distance_to(&seen, [0.0; 2]);
    let [nx, nz] = gap.normal;
    let face = if nx > 0.0 { left } else { right };
    let (high, low) = (from.max(top), to.min(bottom));
    let near = sum([x, z], u.shape.footprint.contact_point(&seen, [0.0; 2], gap.normal));
    let place = |y: f32, apart: f32| {
        let [px, pz] = sum(near, scaled(gap.normal, 0.5 * apart));
        [px, y, clamp_any(pz, prism.near_z, prism.far_z)]
    };
    let (normal, apart) = if nz.abs() < 1e-6 {
        ([-face.normal[0], -face.normal[1], 0.0], gap.separation * face.normal[0].abs())
    } else {
        ([nx, 0.0, nz], gap.separation)
    };
    let mut found = AxisContact::single_point(
        apart,
        normal,
        place(0.5 * (high + low), gap.separation),
        LATERAL_AXIS_FEATURE,
    );
    found.is_curved = gap.is_curved;
    if nx.abs() > 1e-6 && normal[1] == 0.0 && high < low {
        // An upper and a lower point, so that a loaded box does not rotate.
        let at = |y: f32| {
            let here = prism
                .side_point(y, y, -nx.signum())
                .map_or(0.0, |spot| (spot.position[0] - face.position[0]) * nx);
            (place(y, gap.separation), gap.separation + here)
        };
        let nearest = (place(face.position[1].clamp(high, low), gap.separation), gap.separation);
        (found.points, found.count) = (with_nearest([at(high), at(low)], nearest, contact_margin), 2);
    } else if normal[1] != 0.0 {
        found.points = [(place(face.position[1], gap.separation), apart); 2];
    }
    found
}

/// Returns the two points of a contact with the side of a prism, each with its separation in length units. The nearest point of a
/// slanted side is a vertex, perhaps neither of the two. It then replaces the farther point.
fn with_nearest(
    mut points: [([f32; 3], f32); 2],
    nearest: ([f32; 3], f32),
    contact_margin: f32,
) -> [([f32; 3], f32); 2] {
    let farther = usize::from(points[0].1 <= points[1].1);
    let [far, near] = [points[farther].1, points[1 - farther].1];
    if far > nearest.1 + contact_margin || near > nearest.1 + NEARER_CORNER_MIN_ADVANTAGE * contact_margin {
        points[farther] = nearest;
    }
    points
}

/// Returns the axis of largest separation among the normals of the prism's edges, the lateral axis and the vertical axis, with
/// the separation along it.
pub(super) fn best_separating_axis(u: PosedVertical<'_>, prism: &PosedPrism<'_, '_>) -> SeparatingAxis {
    let ([left, right], [high, low]) = (prism.extent(0), prism.extent(1));
    let [x, y, z] = u.position;
    let over = larger_separation(
        (high - y - u.shape.half_height, [0.0, 1.0, 0.0]),
        (y - u.shape.half_height - low, [0.0, -1.0, 0.0]),
    );
    let rectangle = FootprintPolygon::rectangle([left - x, prism.near_z - z], [right - x, prism.far_z - z]);
    let gap = u.shape.footprint.distance_to(&FootprintShape::from_polygon(rectangle), [0.0; 2]);
    let beside = (gap.separation, [gap.normal[0], 0.0, gap.normal[1]]);
    let edges = prism.edges().map(|(_, [start, _], out)| {
        let [px, py, _] = u.support_point([-out[0], -out[1], 0.0]);
        (dot(out, difference([px, py], start)), [-out[0], -out[1], 0.0])
    });
    edges.fold(larger_separation(over, beside), larger_separation)
}

/// Returns the contact manifold of a vertical shape without rounding and a prism. `half` is half of the prism's extent along z,
/// in length units. `is_a`: the vertical shape is A.
pub(super) fn collide_vertical_prism(
    a: PosedSolid<'_>,
    b: PosedSolid<'_>,
    (vertical, half, is_a): (&VerticalSolid, f32, bool),
    previous: PreviousAxis,
    margins: ContactMargins,
) -> Manifold {
    let (of_upright, of_prism) = if is_a { (&a, &b) } else { (&b, &a) };
    let standing = PosedVertical::new(of_upright, vertical);
    let prism = PosedPrism::new(of_prism, half);
    let at = |displacement: [f32; 3]| {
        // B moves relative to A; the vertical shape moves the other way if it is A.
        let sign = if is_a { -1.0 } else { 1.0 };
        let u = PosedVertical {
            position: std::array::from_fn(|axis| standing.position[axis] + sign * displacement[axis]),
            ..standing
        };
        let ways = axis_candidates(u, &prism, margins.speculative_distance);
        if is_a { ways } else { ways.flipped() }
    };
    let now = at([0.0; 3]);
    if now.max_separation().separation > margins.contact_margin {
        // A bound of the distance: on a slope contact positions move faster than the shapes.
        let ([left, right], [top, bottom]) = (prism.extent(0), prism.extent(1));
        return Manifold::separated(
            standing.distance_to_aabb([left, top, prism.near_z], [right, bottom, prism.far_z]),
        );
    }
    let found = collide_along_chosen_axis([&a, &b], &now, previous, margins, at);
    let is_apart = || found.separations[..found.count].iter().all(|&separation| separation > 0.0);
    let displacement = relative_displacement(of_prism, of_upright);
    let passes = found.count > 0 && is_apart() && {
        let [x, y] = found.normal;
        prism.will_be_missed(standing, displacement, [x, y, found.normal_z])
    };
    if passes { Manifold::separated(0.0) } else { found }
}

/// Returns the heights (world y, length units) of the two points on a capsule's axis that are nearest to a prism's outline.
/// They are equal unless a side of the outline is parallel to the axis within the tolerance `flush`: see [`minimize_convex`].
/// `half` is half of the length of the axis.
pub(super) fn nearest_heights(
    prism: &PosedSolid<'_>,
    [x, y, _]: [f32; 3],
    half: f32,
    flush: f32,
) -> [f32; 2] {
    let extruded = PosedPrism::new(prism, 0.0);
    if extruded.solid.outline.vertices.is_empty() {
        let centre = extruded.to_world(extruded.solid.outline.shape.centre);
        return [clamp_any(centre[1], y - half, y + half); 2];
    }
    minimize_convex(y - half, y + half, flush, |height| extruded.signed_distance([x, height]))
}

/// Minimises a convex function of the height between `low` and `high` by ternary search. Returns the interval of heights in
/// which the function is at most `flush` above its minimum, slightly shortened. If the interval is short, both ends are the
/// height of the minimum. So a side that leans by rounding errors alone has two contact points. All values are in length units.
pub(super) fn minimize_convex(low: f32, high: f32, flush: f32, of: impl Fn(f32) -> f32) -> [f32; 2] {
    let (mut from, mut to) = (low, high);
    for _ in 0..TERNARY_SEARCH_STEPS {
        let third = (to - from) / 3.0;
        let (one, other) = (from + third, to - third);
        let (at_one, at_other) = (of(one), of(other));
        if at_one < at_other {
            to = other;
        } else if at_other < at_one {
            from = one;
        } else {
            (from, to) = (one, other);
        }
    }
    // At an end of the interval the result is exact.
    let middle = 0.5 * (from + to);
    let better = |one: f32, other: f32| if of(other) < of(one) { other } else { one };
    let lowest = better(better(middle, low), high);
    if flush == 0.0 {
        return [lowest; 2];
    }
    let most = of(lowest) + flush;
    let end = |mut outside: f32| {
        if of(outside) <= most {
            return outside;
        }
        let mut inside = lowest;
        for _ in 0..TERNARY_SEARCH_STEPS {
            let middle = 0.5 * (inside + outside);
            *(if of(middle) <= most { &mut inside } else { &mut outside }) = middle;
        }
        inside
    };
    let (from, to) = (end(low), end(high));
    // Shortened, so that vertices of the other shape stay outside.
    let inset = FLAT_INTERVAL_INSET * (to - from);
    if to - from > FLAT_INTERVAL_MIN_RATIO * flush { [from + inset, to - inset] } else { [lowest; 2] }
}
