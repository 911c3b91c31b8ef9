//! Where something upright touches a box that is tilted in the plane, and sheared along x or y with depth: a slope in any
//! direction.
//!
//! Above its top or below its underside counts the place where the footprint reaches farthest up a face, of what of it is over
//! that face; beside it, what of the box is at the heights of the upright thing, as seen from above.

use super::foot::{Foot, Polygon, summit};
use super::slant::hull;
use super::solid::{Before, Limits, Solid};
use super::upright::{Axis, BESIDE, Meeting, OVER, Standing, Upright, Ways, chosen, farther};
use crate::math::Vector3;
use crate::math::plane::{Vector, cross, difference, dot, length, scaled, sum};
use crate::precise::manifold::Manifold;
use crate::precise::parameters::depth::{RIDGE_ACROSS_SLOPE, RIDGE_HEIGHT_DIFFERENCE, SLOPE_NORMAL_UP};
use crate::shape::{Face, SlantedBox};

/// A face of a box as seen from above, from a place of the floor.
struct Roof {
    part: Polygon,
    normal: Vector3,
    /// A place of it: x, y, z.
    on: Vector3,
    from: Vector,
}

impl Roof {
    fn of(shape: &SlantedBox, face: Face, from: Vector) -> Option<Self> {
        let corners = shape.corners();
        // Of the front face, which begins with the left end of the top.
        let [one, other] = match face {
            Face::Top => [0, 1],
            Face::Right => [1, 2],
            Face::Bottom => [2, 3],
            Face::Left => [3, 0],
            Face::Front | Face::Back => return None,
        };
        let seen =
            [one, other, other + 4, one + 4].map(|at| [corners[at].x - from[0], corners[at].z - from[1]]);
        let area = cross(difference(seen[1], seen[0]), difference(seen[2], seen[0]));
        let part =
            if area > 0.0 { Polygon::new(seen) } else { Polygon::new([seen[1], seen[0], seen[3], seen[2]]) };
        (area != 0.0).then(|| Roof { part, normal: shape.face_normal(face), on: corners[one], from })
    }

    /// How fast y grows along x and z.
    fn slope(&self) -> Vector {
        [-self.normal.x / self.normal.y, -self.normal.z / self.normal.y]
    }

    /// Its y at a place as seen from where it is looked at.
    fn y_at(&self, at: Vector) -> f32 {
        let way = [at[0] + self.from[0] - self.on.x, at[1] + self.from[1] - self.on.z];
        self.on.y + dot(way, self.slope())
    }
}

/// Both ways in which something upright meets a box.
pub(super) fn ways(u: Standing<'_>, shape: &SlantedBox, reach: f32) -> Ways {
    let (down, up) = (over(u, shape, 1.0), over(u, shape, -1.0));
    Ways { over: if up.apart > down.apart { up } else { down }, beside: beside(u, shape, reach) }
}

/// The box below something upright, with `down` 1, or above it.
fn over(u: Standing<'_>, shape: &SlantedBox, down: f32) -> Meeting {
    let foot: &Foot = &u.shape.foot;
    let sole = u.at[1] + down * u.shape.half;
    let looks_up = |face: &Face| down * shape.face_normal(*face).y < -SLOPE_NORMAL_UP;
    let roofs = Face::SIDES.into_iter().filter(looks_up);
    let roofs: [Option<Roof>; 4] = {
        let mut all = roofs.map(|face| Roof::of(shape, face, u.floor()));
        std::array::from_fn(|_| all.next().flatten())
    };
    let roofs = || roofs.iter().flatten();
    let tops = roofs().filter_map(|roof| {
        let found = summit(foot, &roof.part, scaled(roof.slope(), -down))?;
        let is_ridge = found.edge.is_some_and(|edge| ends_climb(roof, edge, down));
        Some((roof, found.at, is_ridge))
    });
    // Who is beside it altogether is measured against its nearest place.
    let beside = roofs().map(|roof| {
        let gap = Foot::disc(0.0).gap(&Foot::of(roof.part), [0.0; 2]);
        (roof, scaled(gap.normal, gap.apart), true)
    });
    let higher = |roof: &Roof, at: Vector| -down * roof.y_at(at);
    let best = tops.reduce(|a, b| if higher(b.0, b.1) > higher(a.0, a.1) { b } else { a });
    let nearest = || beside.reduce(|a, b| if length(b.1) < length(a.1) { b } else { a });
    let Some((roof, at, is_ridge)) = best.or_else(nearest) else {
        return Meeting::of_point(f32::MIN, [0.0, down, 0.0], u.at, OVER);
    };
    let y = roof.y_at(at);
    let out = if is_ridge { Vector3::new(0.0, -down, 0.0) } else { roof.normal };
    let apart = down * (y - sole) * -down * out.y;
    let point = [u.at[0] + at[0], 0.5 * (y + sole), u.at[2] + at[1]];
    Meeting::of_point(apart, [-out.x, -out.y, -out.z], point, OVER)
}

/// The highest place of a box, y down, over a footprint that is somewhere, and the direction out of it there; where it is a ridge
/// that of the flatter side.
pub(super) fn roof_over(shape: &SlantedBox, foot: &Foot, from: Vector) -> Option<(f32, Vector3)> {
    let roofs = Face::SIDES.into_iter().filter(|&face| shape.face_normal(face).y < -1e-6);
    let tops = roofs.filter_map(|face| {
        let roof = Roof::of(shape, face, from)?;
        let found = summit(foot, &roof.part, scaled(roof.slope(), -1.0))?;
        Some((roof.y_at(found.at), roof.normal))
    });
    tops.reduce(|best, next| {
        let is_same = (next.0 - best.0).abs() < RIDGE_HEIGHT_DIFFERENCE;
        let is_better = if is_same { next.1.y < best.1.y } else { next.0 < best.0 };
        if is_better { next } else { best }
    })
}

/// Whether the way up a roof ends at one of its edges.
fn ends_climb(roof: &Roof, edge: usize, down: f32) -> bool {
    let uphill = scaled(roof.slope(), -down);
    let points = roof.part.points();
    let (start, end) = (points[edge], points[(edge + 1) % points.len()]);
    let out = [end[1] - start[1], start[0] - end[0]];
    dot(uphill, out) > RIDGE_ACROSS_SLOPE * length(uphill) * length(out)
}

/// The box beside something upright.
fn beside(u: Standing<'_>, shape: &SlantedBox, reach: f32) -> Meeting {
    let [x, y, z] = u.at;
    let (from, to) = (y - u.shape.half, y + u.shape.half);
    let whole = || silhouette(shape, f32::MIN, f32::MAX);
    let seen = Some(silhouette(shape, from - reach, to + reach)).filter(|seen| seen.len() > 2);
    let seen = seen.unwrap_or_else(whole);
    let outline = Foot::of(Polygon::new(seen.iter().map(|&[px, pz]| [px - x, pz - z])));
    let gap = u.shape.foot.gap(&outline, [0.0; 2]);
    let [nx, nz] = gap.normal;
    let (low, high) = shape.bounds();
    let facing = u.shape.foot.facing(&outline, [0.0; 2], gap.normal);
    let near = sum([x, z], sum(facing, scaled(gap.normal, 0.5 * gap.apart)));
    let point = [near[0], 0.5 * (from.max(low.y) + to.min(high.y)), near[1]];
    let face = Face::SIDES.into_iter().map(|face| shape.face_normal(face)).find(|normal| {
        let level = length([normal.x, normal.z]);
        level > 0.05 && -(normal.x * nx + normal.z * nz) > 0.9999 * level
    });
    match face.filter(|_| !gap.is_curved) {
        Some(out) => {
            let apart = gap.apart * length([out.x, out.z]);
            Meeting::of_point(apart, [-out.x, -out.y, -out.z], point, BESIDE)
        }
        None => {
            let found = Meeting::of_point(gap.apart, [nx, 0.0, nz], point, BESIDE);
            Meeting { is_curved: gap.is_curved, ..found }
        }
    }
}

/// What of a box is between two heights, as seen from above.
fn silhouette(shape: &SlantedBox, top: f32, bottom: f32) -> Vec<Vector> {
    let corners = shape.rectangle();
    let corner = |at: usize| {
        let deep = if at < 4 { -shape.half[2] } else { shape.half[2] };
        shape.centre + shape.shift(deep) + Vector3::new(corners[at % 4].x, corners[at % 4].y, deep)
    };
    let sides = (0..4).flat_map(|at| [[at, (at + 1) % 4], [at + 4, (at + 1) % 4 + 4], [at, at + 4]]);
    let mut seen = Vec::with_capacity(24);
    for [one, other] in sides {
        let (a, b) = (corner(one), corner(other));
        let (high, low) = if a.y <= b.y { (a, b) } else { (b, a) };
        let (from, to) = (high.y.max(top), low.y.min(bottom));
        if from > to {
            continue;
        }
        let height = low.y - high.y;
        let at = |y: f32| if height > 0.0 { high + (low - high) * ((y - high.y) / height) } else { low };
        seen.extend(
            [high, at(from), at(to)]
                .map(|point| [point.x, point.z])
                .into_iter()
                .skip(usize::from(height > 0.0)),
        );
    }
    hull(seen)
}

/// The axis along which something upright is farthest from a box: of its faces, of what is seen of it from above, and upright.
pub(super) fn parted(u: Standing<'_>, shape: &SlantedBox) -> Axis {
    let (low, high) = shape.bounds();
    let [top, bottom] = [-1.0, 1.0].map(|side| u.at[1] + side * u.shape.half);
    let over = farther((low.y - bottom, [0.0, 1.0, 0.0]), (top - high.y, [0.0, -1.0, 0.0]));
    let seen = silhouette(shape, f32::MIN, f32::MAX);
    let outline = Polygon::new(seen.iter().map(|&[x, z]| [x - u.at[0], z - u.at[2]]));
    let gap = u.shape.foot.gap(&Foot::of(outline), [0.0; 2]);
    let beside = (gap.apart, [gap.normal[0], 0.0, gap.normal[1]]);
    let faces = Face::SIDES.into_iter().chain([Face::Front, Face::Back]).map(|face| {
        let into = -shape.face_normal(face);
        let nearest = Vector3::from(u.farthest(into.into()));
        (shape.distance_to_face(face, nearest), into.into())
    });
    faces.fold(farther(over, beside), farther)
}

/// Something upright and not round above and below, and a box, which is A.
pub(super) fn touch(
    a: Solid<'_>,
    b: Solid<'_>,
    (upright, shape): (&Upright, &SlantedBox),
    before: Before,
    limits: Limits,
) -> Manifold {
    let standing = Standing::new(&b, upright);
    let at = |way: [f32; 3]| {
        let u = Standing { at: std::array::from_fn(|axis| standing.at[axis] + way[axis]), ..standing };
        ways(u, shape, limits.usual).flipped()
    };
    let now = at([0.0; 3]);
    if now.best().apart > limits.reach {
        // How far it is off is not known from places of it alone: on a slope they change faster than it moves.
        let (low, high) = shape.bounds();
        return Manifold::apart(standing.clear_of(low.into(), high.into()));
    }
    chosen([&a, &b], &now, before, limits, at)
}
