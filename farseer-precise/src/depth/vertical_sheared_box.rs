//! Narrow phase of a vertical shape without rounding against a sheared or tilted box: a slope in any direction.
//!
//! | axis | contact |
//! |---|---|
//! | vertical | highest point of each top face within the footprint, or lowest point of each bottom face |
//! | lateral | footprint against the silhouette from above, of the part of the box at the heights of the vertical shape |

use super::footprint::{FootprintPolygon, FootprintShape, highest_point};
use super::posed_solid::{ContactMargins, PosedSolid, PreviousAxis};
use super::sheared_box::convex_hull;
use super::vertical_shapes::{
    AxisCandidates, AxisContact, LATERAL_AXIS_FEATURE, PosedVertical, SeparatingAxis, VERTICAL_AXIS_FEATURE,
    collide_along_chosen_axis, larger_separation,
};
use super::vertical_solid::VerticalSolid;
use crate::math::Vector3;
use crate::math::plane::{Vector, cross, difference, dot, length, scaled, sum};
use crate::narrow_phase::manifold::Manifold;
use crate::parameters::depth::{RIDGE_MAX_HEIGHT_DIFFERENCE, RIDGE_MIN_UPHILL_COSINE, SLOPE_MIN_NORMAL_UP};
use crate::slanted_box::{Face, SlantedBox};

/// Top or bottom face of a sheared box, projected along y.
struct TopFace {
    /// Outline of the face in x and z, relative to `origin`, in length units.
    polygon: FootprintPolygon,
    /// Outward unit normal of the face: x, y (down), z. Dimensionless.
    normal: Vector3,
    /// One vertex of the face in world coordinates x, y (down), z, length units.
    point: Vector3,
    /// World position in x and z, in length units, to which `polygon` is relative.
    origin: Vector,
}

impl TopFace {
    /// Returns a face of the box, with its outline relative to the world position `from` in x and z. `None` for the front and
    /// the back face, and for a face whose outline seen from above has no area.
    fn new(shape: &SlantedBox, face: Face, from: Vector) -> Option<Self> {
        let corners = shape.corners();
        // Vertices of the front face, from the left end of the top.
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
        let polygon = if area > 0.0 {
            FootprintPolygon::new(seen)
        } else {
            FootprintPolygon::new([seen[1], seen[0], seen[3], seen[2]])
        };
        (area != 0.0).then(|| TopFace {
            polygon,
            normal: shape.face_normal(face),
            point: corners[one],
            origin: from,
        })
    }

    /// Returns the slope of the face: dy/dx and dy/dz, dimensionless.
    fn slope(&self) -> Vector {
        [-self.normal.x / self.normal.y, -self.normal.z / self.normal.y]
    }

    /// Returns the world y (down) of the face at a position in x and z relative to `origin`. Length units.
    fn y_at(&self, at: Vector) -> f32 {
        let offset = [at[0] + self.origin[0] - self.point.x, at[1] + self.origin[1] - self.point.z];
        self.point.y + dot(offset, self.slope())
    }
}

/// Returns the contacts of a vertical shape (A) and a sheared or tilted box along the vertical and the lateral axis.
/// `contact_margin` is in length units.
pub(super) fn axis_candidates(
    u: PosedVertical<'_>,
    shape: &SlantedBox,
    contact_margin: f32,
) -> AxisCandidates {
    let (down, up) = (vertical_axis_contact(u, shape, 1.0), vertical_axis_contact(u, shape, -1.0));
    AxisCandidates {
        vertical: if up.separation > down.separation { up } else { down },
        lateral: lateral_axis_contact(u, shape, contact_margin),
    }
}

/// Returns the contact of a vertical shape (A) and a box along the vertical axis, with the box below the shape (`down` 1) or
/// above the shape (`down` -1).
fn vertical_axis_contact(u: PosedVertical<'_>, shape: &SlantedBox, down: f32) -> AxisContact {
    let footprint: &FootprintShape = &u.shape.footprint;
    let sole = u.position[1] + down * u.shape.half_height;
    let looks_up = |face: &Face| down * shape.face_normal(*face).y < -SLOPE_MIN_NORMAL_UP;
    let roofs = Face::SIDES.into_iter().filter(looks_up);
    let roofs: [Option<TopFace>; 4] = {
        let mut all = roofs.map(|face| TopFace::new(shape, face, u.xz()));
        std::array::from_fn(|_| all.next().flatten())
    };
    let roofs = || roofs.iter().flatten();
    let tops = roofs().filter_map(|roof| {
        let found = highest_point(footprint, &roof.polygon, scaled(roof.slope(), -down))?;
        let is_ridge = found.edge.is_some_and(|edge| is_uphill_end(roof, edge, down));
        Some((roof, found.position, is_ridge))
    });
    // A footprint beside the box is measured against the nearest point of the box.
    let beside = roofs().map(|roof| {
        let gap =
            FootprintShape::disc(0.0).distance_to(&FootprintShape::from_polygon(roof.polygon), [0.0; 2]);
        (roof, scaled(gap.normal, gap.separation), true)
    });
    let higher = |roof: &TopFace, at: Vector| -down * roof.y_at(at);
    let best = tops.reduce(|a, b| if higher(b.0, b.1) > higher(a.0, a.1) { b } else { a });
    let nearest = || beside.reduce(|a, b| if length(b.1) < length(a.1) { b } else { a });
    let Some((roof, at, is_ridge)) = best.or_else(nearest) else {
        return AxisContact::single_point(f32::MIN, [0.0, down, 0.0], u.position, VERTICAL_AXIS_FEATURE);
    };
    let y = roof.y_at(at);
    let out = if is_ridge { Vector3::new(0.0, -down, 0.0) } else { roof.normal };
    let apart = down * (y - sole) * -down * out.y;
    let point = [u.position[0] + at[0], 0.5 * (y + sole), u.position[2] + at[1]];
    AxisContact::single_point(apart, [-out.x, -out.y, -out.z], point, VERTICAL_AXIS_FEATURE)
}

/// Returns the world y (down, length units) of the highest point of a box within a footprint, and the outward unit normal
/// there; on a ridge the normal of the flatter face. `from` is the world position of the footprint in x and z. `None` if no top
/// face overlaps the footprint.
pub(super) fn highest_top(
    shape: &SlantedBox,
    footprint: &FootprintShape,
    from: Vector,
) -> Option<(f32, Vector3)> {
    let roofs = Face::SIDES.into_iter().filter(|&face| shape.face_normal(face).y < -1e-6);
    let tops = roofs.filter_map(|face| {
        let roof = TopFace::new(shape, face, from)?;
        let found = highest_point(footprint, &roof.polygon, scaled(roof.slope(), -1.0))?;
        Some((roof.y_at(found.position), roof.normal))
    });
    tops.reduce(|best, next| {
        let is_same = (next.0 - best.0).abs() < RIDGE_MAX_HEIGHT_DIFFERENCE;
        let is_better = if is_same { next.1.y < best.1.y } else { next.0 < best.0 };
        if is_better { next } else { best }
    })
}

/// Returns whether the edge of a face with this index is its uphill end, so that the edge is a ridge. `down` is 1 for a face on
/// top of the box, -1 for a face below the box.
fn is_uphill_end(roof: &TopFace, edge: usize, down: f32) -> bool {
    let uphill = scaled(roof.slope(), -down);
    let points = roof.polygon.points();
    let (start, end) = (points[edge], points[(edge + 1) % points.len()]);
    let out = [end[1] - start[1], start[0] - end[0]];
    dot(uphill, out) > RIDGE_MIN_UPHILL_COSINE * length(uphill) * length(out)
}

/// Returns the contact of a vertical shape (A) and a box along the lateral axis. `contact_margin` is in length units.
fn lateral_axis_contact(u: PosedVertical<'_>, shape: &SlantedBox, contact_margin: f32) -> AxisContact {
    let [x, y, z] = u.position;
    let (from, to) = (y - u.shape.half_height, y + u.shape.half_height);
    let whole = || silhouette(shape, f32::MIN, f32::MAX);
    let seen =
        Some(silhouette(shape, from - contact_margin, to + contact_margin)).filter(|seen| seen.len() > 2);
    let seen = seen.unwrap_or_else(whole);
    let outline =
        FootprintShape::from_polygon(FootprintPolygon::new(seen.iter().map(|&[px, pz]| [px - x, pz - z])));
    let gap = u.shape.footprint.distance_to(&outline, [0.0; 2]);
    let [nx, nz] = gap.normal;
    let (low, high) = shape.bounds();
    let facing = u.shape.footprint.contact_point(&outline, [0.0; 2], gap.normal);
    let near = sum([x, z], sum(facing, scaled(gap.normal, 0.5 * gap.separation)));
    let point = [near[0], 0.5 * (from.max(low.y) + to.min(high.y)), near[1]];
    let face = Face::SIDES.into_iter().map(|face| shape.face_normal(face)).find(|normal| {
        let level = length([normal.x, normal.z]);
        level > 0.05 && -(normal.x * nx + normal.z * nz) > 0.9999 * level
    });
    match face.filter(|_| !gap.is_curved) {
        Some(out) => {
            let apart = gap.separation * length([out.x, out.z]);
            AxisContact::single_point(apart, [-out.x, -out.y, -out.z], point, LATERAL_AXIS_FEATURE)
        }
        None => {
            let found = AxisContact::single_point(gap.separation, [nx, 0.0, nz], point, LATERAL_AXIS_FEATURE);
            AxisContact { is_curved: gap.is_curved, ..found }
        }
    }
}

/// Returns the silhouette from above of the part of a box with `top <= y <= bottom`: vertices of a convex polygon in world
/// coordinates x and z, length units.
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
    convex_hull(seen)
}

/// Returns the axis of largest separation among the normals of the box's faces, the lateral axis and the vertical axis, with
/// the separation along it.
pub(super) fn best_separating_axis(u: PosedVertical<'_>, shape: &SlantedBox) -> SeparatingAxis {
    let (low, high) = shape.bounds();
    let [top, bottom] = [-1.0, 1.0].map(|side| u.position[1] + side * u.shape.half_height);
    let over = larger_separation((low.y - bottom, [0.0, 1.0, 0.0]), (top - high.y, [0.0, -1.0, 0.0]));
    let seen = silhouette(shape, f32::MIN, f32::MAX);
    let outline = FootprintPolygon::new(seen.iter().map(|&[x, z]| [x - u.position[0], z - u.position[2]]));
    let gap = u.shape.footprint.distance_to(&FootprintShape::from_polygon(outline), [0.0; 2]);
    let beside = (gap.separation, [gap.normal[0], 0.0, gap.normal[1]]);
    let faces = Face::SIDES.into_iter().chain([Face::Front, Face::Back]).map(|face| {
        let into = -shape.face_normal(face);
        let nearest = Vector3::from(u.support_point(into.into()));
        (shape.distance_to_face(face, nearest), into.into())
    });
    faces.fold(larger_separation(over, beside), larger_separation)
}

/// Returns the contact manifold of a sheared or tilted box (A) and a vertical shape without rounding (B).
pub(super) fn collide_vertical_sheared_box(
    a: PosedSolid<'_>,
    b: PosedSolid<'_>,
    (vertical, shape): (&VerticalSolid, &SlantedBox),
    previous: PreviousAxis,
    margins: ContactMargins,
) -> Manifold {
    let standing = PosedVertical::new(&b, vertical);
    let at = |offset: [f32; 3]| {
        let u = PosedVertical {
            position: std::array::from_fn(|axis| standing.position[axis] + offset[axis]),
            ..standing
        };
        axis_candidates(u, shape, margins.speculative_distance).flipped()
    };
    let now = at([0.0; 3]);
    if now.max_separation().separation > margins.contact_margin {
        // A bound of the distance: on a slope contact positions move faster than the shapes.
        let (low, high) = shape.bounds();
        return Manifold::separated(standing.distance_to_aabb(low.into(), high.into()));
    }
    collide_along_chosen_axis([&a, &b], &now, previous, margins, at)
}
