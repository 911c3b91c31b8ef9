//! Where something upright touches an outline that is drawn out along the depth axis, and may be turned in the plane.
//!
//! From above such a prism is a rectangle, as wide as what of its outline is at the heights of the upright thing; and the
//! highest place of it that the footprint covers is the highest one of its outline over a part of the x axis.

use super::foot::{Foot, Polygon};
use super::solid::{Before, Limits, Solid};
use super::upright::{Axis, BESIDE, Meeting, OVER, Standing, Upright, Ways, ahead, chosen, farther, within};
use crate::math::plane::{Vector, difference, dot, length, place, rotation, scaled, sum, turn};
use crate::precise::manifold::Manifold;
use crate::precise::parameters::depth::{
    FLAT_PRISM_INSET, FLAT_PRISM_RATIO, LEANING_CORNER_DISTANCE, SLOPE_NORMAL_UP, TERNARY_SEARCH_STEPS,
    VERTICAL_NORMAL_COSINE,
};

/// A prism where it is, with its outline in the frame of the world.
#[derive(Clone, Copy)]
pub(super) struct Extruded<'s, 'a> {
    solid: &'s Solid<'a>,
    near: f32,
    far: f32,
}

/// A place of an outline, and the direction out of it there.
#[derive(Debug, Clone, Copy)]
struct Spot {
    at: Vector,
    out: Vector,
    /// The edge that it is on; of an outline that is round, none.
    edge: Option<usize>,
}

impl<'s, 'a> Extruded<'s, 'a> {
    pub(super) fn new(solid: &'s Solid<'a>, half: f32) -> Self {
        Extruded { solid, near: solid.z - half, far: solid.z + half }
    }

    fn radius(&self) -> f32 {
        self.solid.outline.shape.radius
    }

    fn to_world(self, point: Vector) -> Vector {
        sum(place(self.solid.pose), turn(rotation(self.solid.pose), point))
    }

    /// The middles of what is round, or the corners.
    fn corners(&self) -> impl Iterator<Item = Vector> + '_ {
        let outline = &self.solid.outline;
        let centre = std::slice::from_ref(&outline.shape.centre);
        let points = if outline.points.is_empty() { centre } else { outline.points };
        points.iter().map(|&point| self.to_world(point))
    }

    /// Its edges: both ends, and the direction out.
    fn edges(&self) -> impl Iterator<Item = (usize, [Vector; 2], Vector)> + '_ {
        let outline = &self.solid.outline;
        let count = outline.points.len();
        outline.normals.iter().enumerate().map(move |(at, &normal)| {
            let out = turn(rotation(self.solid.pose), normal);
            let ends = [outline.points[at], outline.points[(at + 1) % count]];
            (at, ends.map(|end| sum(self.to_world(end), scaled(out, self.radius()))), out)
        })
    }

    /// How far it reaches along x and along y: the least and the greatest.
    fn extent(&self, axis: usize) -> [f32; 2] {
        let around = self.radius();
        let bounds = self.corners().fold([f32::MAX, f32::MIN], |[low, high], corner| {
            let at = corner[axis];
            [if at < low { at } else { low }, if at > high { at } else { high }]
        });
        [bounds[0] - around, bounds[1] + around]
    }

    /// Least and greatest x of the faces that look up, with `up` -1, or down, with 1; walls are none of them.
    fn roof(&self, up: f32) -> [f32; 2] {
        let faces = self.edges().filter(|(.., out)| up * out[1] > SLOPE_NORMAL_UP);
        let ends = faces.flat_map(|(_, ends, _)| ends.map(|[x, _]| x));
        // Of two zeros of different sign processors choose differently by `min` and `max`.
        let [least, most] = ends.fold([f32::MAX, f32::MIN], |[least, most], x| {
            [if x < least { x } else { least }, if x > most { x } else { most }]
        });
        if self.radius() > 0.0 || least > most { self.extent(0) } else { [least, most] }
    }

    /// Whether a face looks away from something upright that is apart from it now and after it has gone a way: it passes the prism.
    /// Faces with the normal along which the two come together do not count.
    fn is_passed(&self, u: Standing<'_>, way: [f32; 3], normal: [f32; 3]) -> bool {
        self.edges().any(|(_, [start, _], out)| {
            let [x, y, _] = u.farthest([-out[0], -out[1], 0.0]);
            let apart = dot(out, difference([x, y], start));
            let is_other = (out[0] * normal[0] + out[1] * normal[1]).abs() < VERTICAL_NORMAL_COSINE;
            is_other && apart > 0.0 && apart + dot(out, [way[0], way[1]]) > 0.0
        })
    }

    /// The place that is farthest up, with `up` -1, or down, with 1, between two x; and the other end of its edge there.
    fn summit(&self, left: f32, right: f32, up: f32) -> Option<[Spot; 2]> {
        let mut best: Option<[Spot; 2]> = None;
        let mut consider = |spot: Spot, other: Spot| {
            let is_higher = best.is_none_or(|[best, _]| {
                let (height, most) = (up * spot.at[1], up * best.at[1]);
                height > most || (height == most && up * spot.out[1] > up * best.out[1])
            });
            if is_higher {
                best = Some([spot, other]);
            }
        };
        for (edge, [start, end], out) in self.edges().filter(|(.., out)| up * out[1] > SLOPE_NORMAL_UP) {
            let (low, high) = if start[0] <= end[0] { (start, end) } else { (end, start) };
            let (from, to) = (low[0].max(left), high[0].min(right));
            if from > to {
                continue;
            }
            let width = high[0] - low[0];
            let spot = |x: f32| {
                let y =
                    if width > 0.0 { low[1] + (high[1] - low[1]) * ((x - low[0]) / width) } else { low[1] };
                // A corner between both ends is no place of one face alone: what is flat lies level on it.
                let is_corner = (x == low[0] && x > left) || (x == high[0] && x < right);
                let out = if is_corner && !is_level(out) { [0.0, up] } else { out };
                Spot { at: [x, y], out, edge: Some(edge) }
            };
            consider(spot(from), spot(to));
            consider(spot(to), spot(from));
        }
        let radius = self.radius();
        for centre in self.corners().filter(|_| radius > 0.0) {
            let x = within(centre[0], left, right);
            let aside = x - centre[0];
            let squared = radius * radius - aside * aside;
            if squared > 0.0 {
                let out = [aside / radius, up * squared.sqrt() / radius];
                let spot = Spot { at: sum(centre, scaled(out, radius)), out, edge: None };
                consider(spot, spot);
            }
        }
        best
    }

    /// How far a point is outside of the outline; negative inside.
    fn distance(&self, point: Vector) -> f32 {
        let (mut out_of_face, mut away) = (f32::MIN, f32::MAX);
        for (_, [start, end], out) in self.edges() {
            let (edge, from) = (difference(end, start), difference(point, start));
            let part = (dot(from, edge) / dot(edge, edge)).clamp(0.0, 1.0);
            let apart = length(difference(from, scaled(edge, part)));
            out_of_face = out_of_face.max(dot(out, from));
            away = away.min(apart);
        }
        if out_of_face > 0.0 { away } else { out_of_face }
    }

    /// The leftmost, with `side` -1, or rightmost place between two heights.
    fn side(&self, top: f32, bottom: f32, side: f32) -> Option<Spot> {
        let mut best: Option<Spot> = None;
        let mut consider = |spot: Spot| {
            if best.is_none_or(|best| side * spot.at[0] > side * best.at[0]) {
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
                let part = if height > 0.0 { (y - high[1]) / height } else { 0.0 };
                let is_corner = (y == high[1] && y > top) || (y == low[1] && y < bottom) || height == 0.0;
                let out = if is_corner || side * out[0] <= 0.0 { [side, 0.0] } else { out };
                consider(Spot { at: [high[0] + (low[0] - high[0]) * part, y], out, edge: Some(edge) });
            }
            if height == 0.0 {
                consider(Spot { at: low, out: [side, 0.0], edge: Some(edge) });
            }
        }
        let radius = self.radius();
        for centre in self.corners().filter(|_| radius > 0.0) {
            let off = within(centre[1], top, bottom) - centre[1];
            let squared = radius * radius - off * off;
            if squared > 0.0 {
                let out = [side * squared.sqrt() / radius, off / radius];
                consider(Spot { at: sum(centre, scaled(out, radius)), out, edge: None });
            }
        }
        best
    }
}

/// Whether a face is as good as level.
fn is_level(out: Vector) -> bool {
    out[0].abs() < 1e-3
}

/// Both ways in which something upright meets a prism.
pub(super) fn ways(u: Standing<'_>, prism: &Extruded<'_, '_>, reach: f32) -> Ways {
    let [top, bottom] = prism.extent(1);
    let down = over(u, prism, 1.0);
    let up = over(u, prism, -1.0);
    Ways {
        over: if up.apart > down.apart { up } else { down },
        beside: beside(u, prism, [top, bottom], reach),
    }
}

/// The prism below something upright, with `down` 1, or above it.
fn over(u: Standing<'_>, prism: &Extruded<'_, '_>, down: f32) -> Meeting {
    let [x, y, z] = u.at;
    let foot: &Foot = &u.shape.foot;
    let whole = || [-foot.reach([-1.0, 0.0]), foot.reach([1.0, 0.0])];
    let [from, to] = foot.span(prism.near - z, prism.far - z).unwrap_or_else(whole);
    // If the upright is beside the prism, the nearer end of the roof counts.
    let [least, most] = prism.roof(-down);
    let (left, right) = (within(x + from, least, most), within(x + to, least, most));
    let sole = y + down * u.shape.half;
    let depth = common_depth(u, prism);
    let Some([spot, other]) = prism.summit(left, right, -down) else {
        return Meeting::of_point(f32::MIN, [0.0, down, 0.0], [x, sole, depth], OVER);
    };
    let out = spot.out;
    let apart = |spot: &Spot| down * (spot.at[1] - sole) * -down * out[1];
    let point = |spot: &Spot| ([spot.at[0], 0.5 * (spot.at[1] + sole), depth], apart(spot));
    let mut found = Meeting::of_point(apart(&spot), [-out[0], -out[1], 0.0], point(&spot).0, 0);
    // The left one first, so that they keep their names.
    found.count = if spot.edge.is_some() && spot.at != other.at { 2 } else { 1 };
    let (first, second) = if spot.at[0] <= other.at[0] { (spot, other) } else { (other, spot) };
    found.points = if found.count == 2 { [point(&first), point(&second)] } else { [point(&spot); 2] };
    found.feature = OVER + if down < 0.0 { 1 << 6 } else { 0 };
    found
}

/// The middle of what both cover along the depth axis, or between them.
fn common_depth(u: Standing<'_>, prism: &Extruded<'_, '_>) -> f32 {
    let foot = &u.shape.foot;
    let near = (u.at[2] - foot.reach([0.0, -1.0])).max(prism.near);
    let far = (u.at[2] + foot.reach([0.0, 1.0])).min(prism.far);
    0.5 * near + 0.5 * far
}

/// The prism beside something upright.
fn beside(u: Standing<'_>, prism: &Extruded<'_, '_>, [top, bottom]: [f32; 2], reach: f32) -> Meeting {
    let [x, y, z] = u.at;
    let (from, to) = (y - u.shape.half, y + u.shape.half);
    let side = |side: f32| {
        let within = prism.side(from - reach, to + reach, side);
        within.or_else(|| prism.side(top, bottom, side)).unwrap_or(Spot {
            at: place(prism.solid.pose),
            out: [side, 0.0],
            edge: None,
        })
    };
    let (left, right) = (side(-1.0), side(1.0));
    let rectangle = Polygon::rectangle([left.at[0] - x, prism.near - z], [right.at[0] - x, prism.far - z]);
    let seen = Foot::of(rectangle);
    let gap = u.shape.foot.gap(&seen, [0.0; 2]);
    let [nx, nz] = gap.normal;
    let face = if nx > 0.0 { left } else { right };
    let (high, low) = (from.max(top), to.min(bottom));
    let near = sum([x, z], u.shape.foot.facing(&seen, [0.0; 2], gap.normal));
    let place = |y: f32, apart: f32| {
        let [px, pz] = sum(near, scaled(gap.normal, 0.5 * apart));
        [px, y, within(pz, prism.near, prism.far)]
    };
    let (normal, apart) = if nz.abs() < 1e-6 {
        ([-face.out[0], -face.out[1], 0.0], gap.apart * face.out[0].abs())
    } else {
        ([nx, 0.0, nz], gap.apart)
    };
    let mut found = Meeting::of_point(apart, normal, place(0.5 * (high + low), gap.apart), BESIDE);
    found.is_curved = gap.is_curved;
    if nx.abs() > 1e-6 && normal[1] == 0.0 && high < low {
        // Above and below, so that what is pressed against it does not turn.
        let at = |y: f32| {
            let here = prism.side(y, y, -nx.signum()).map_or(0.0, |spot| (spot.at[0] - face.at[0]) * nx);
            (place(y, gap.apart), gap.apart + here)
        };
        (found.points, found.count) = ([at(high), at(low)], 2);
        // What leans is nearest at a corner, which may be neither: then the farther one of both gives way to it.
        let farther = usize::from(found.points[0].1 <= found.points[1].1);
        let [far, near] = [found.points[farther].1, found.points[1 - farther].1];
        if far > gap.apart + reach || near > gap.apart + LEANING_CORNER_DISTANCE * reach {
            found.points[farther] = (place(face.at[1].clamp(high, low), gap.apart), gap.apart);
        }
    } else if normal[1] != 0.0 {
        found.points = [(place(face.at[1], gap.apart), apart); 2];
    }
    found
}

/// The axis along which something upright is farthest from a prism: of its edges, of what is seen of it from above, and upright.
pub(super) fn parted(u: Standing<'_>, prism: &Extruded<'_, '_>) -> Axis {
    let ([left, right], [high, low]) = (prism.extent(0), prism.extent(1));
    let [x, y, z] = u.at;
    let over =
        farther((high - y - u.shape.half, [0.0, 1.0, 0.0]), (y - u.shape.half - low, [0.0, -1.0, 0.0]));
    let rectangle = Polygon::rectangle([left - x, prism.near - z], [right - x, prism.far - z]);
    let gap = u.shape.foot.gap(&Foot::of(rectangle), [0.0; 2]);
    let beside = (gap.apart, [gap.normal[0], 0.0, gap.normal[1]]);
    let edges = prism.edges().map(|(_, [start, _], out)| {
        let [px, py, _] = u.farthest([-out[0], -out[1], 0.0]);
        (dot(out, difference([px, py], start)), [-out[0], -out[1], 0.0])
    });
    edges.fold(farther(over, beside), farther)
}

/// Something upright and not round above and below, and a prism; which of them is A is told.
pub(super) fn touch(
    a: Solid<'_>,
    b: Solid<'_>,
    (upright, half, is_a): (&Upright, f32, bool),
    before: Before,
    limits: Limits,
) -> Manifold {
    let (of_upright, of_prism) = if is_a { (&a, &b) } else { (&b, &a) };
    let standing = Standing::new(of_upright, upright);
    let prism = Extruded::new(of_prism, half);
    let at = |way: [f32; 3]| {
        // B moves against A: the upright one the other way if it is A.
        let sign = if is_a { -1.0 } else { 1.0 };
        let u = Standing { at: std::array::from_fn(|axis| standing.at[axis] + sign * way[axis]), ..standing };
        let ways = ways(u, &prism, limits.usual);
        if is_a { ways } else { ways.flipped() }
    };
    let now = at([0.0; 3]);
    if now.best().apart > limits.reach {
        // How far it is off is not known from places of it alone: on a slope they change faster than it moves.
        let ([left, right], [top, bottom]) = (prism.extent(0), prism.extent(1));
        return Manifold::apart(standing.clear_of([left, top, prism.near], [right, bottom, prism.far]));
    }
    let found = chosen([&a, &b], &now, before, limits, at);
    let is_apart = || found.separations[..found.count].iter().all(|&separation| separation > 0.0);
    let way = ahead(of_prism, of_upright);
    let passes = found.count > 0 && is_apart() && {
        let [x, y] = found.normal;
        prism.is_passed(standing, way, [x, y, found.normal_z])
    };
    if passes { Manifold::apart(0.0) } else { found }
}

/// The heights of a capsule's axis that are nearest to an outline: see [`lowest_of`].
pub(super) fn nearest_heights(prism: &Solid<'_>, [x, y, _]: [f32; 3], half: f32, flush: f32) -> [f32; 2] {
    let extruded = Extruded::new(prism, 0.0);
    if extruded.solid.outline.points.is_empty() {
        let centre = extruded.to_world(extruded.solid.outline.shape.centre);
        return [within(centre[1], y - half, y + half); 2];
    }
    lowest_of(y - half, y + half, flush, |height| extruded.distance([x, height]))
}

/// Where a convex function of heights is least; both ends of where it hardly is more, by so much, if that is long: a side that leans
/// by rounding alone is held at both its ends.
pub(super) fn lowest_of(low: f32, high: f32, flush: f32, of: impl Fn(f32) -> f32) -> [f32; 2] {
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
    // At an end it is there to the last bit.
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
    // Within its ends, that the corners of a side are none of it.
    let inset = FLAT_PRISM_INSET * (to - from);
    if to - from > FLAT_PRISM_RATIO * flush { [from + inset, to - inset] } else { [lowest; 2] }
}
