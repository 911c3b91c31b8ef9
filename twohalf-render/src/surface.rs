//! Surfaces of the world as they appear on the screen.

use twohalf::{ContactTarget, GeomId, PlatformId, Surface, TwoHalfPhysicsSimulator, Vector3, VirtualGeom};

use crate::Point;
use crate::footprint::footprint_of;

/// The faces of a platform by its corners (front face first, clockwise from the top left, then the back face), each
/// clockwise as seen from outside.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Face {
    Top,
    Front,
    Left,
    Right,
    Underside,
    Back,
}

impl Face {
    /// All faces. The back can be seen only if the platform is rotated.
    pub(crate) const ALL: [Face; 6] =
        [Face::Top, Face::Front, Face::Left, Face::Right, Face::Underside, Face::Back];

    pub(crate) fn corners<T: Copy>(self, corners: &[T; 8]) -> [T; 4] {
        match self {
            Face::Top => [4, 5, 1, 0],
            Face::Front => [0, 1, 2, 3],
            Face::Left => [4, 0, 3, 7],
            Face::Right => [1, 5, 6, 2],
            Face::Underside => [3, 2, 6, 7],
            Face::Back => [5, 4, 7, 6],
        }
        .map(|index: usize| corners[index])
    }

    /// Outward normal, not normalized.
    pub(crate) fn normal(self, corners: &[Vector3; 8]) -> Vector3 {
        let [a, b, c, _] = self.corners(corners);
        (b - a).cross(&(c - a))
    }
}

/// A point of the world on the screen.
pub(crate) fn to_screen(simulator: &TwoHalfPhysicsSimulator, point: Vector3) -> Point {
    simulator.projection().to_screen(point).into()
}

/// A platform's corners on the screen, in their order.
pub(crate) fn corners_on_screen(
    simulator: &TwoHalfPhysicsSimulator,
    platform: PlatformId,
) -> Option<[Point; 8]> {
    let corners = simulator.platform(platform)?.corners();
    Some(corners.map(|corner| to_screen(simulator, corner)))
}

/// The corners of a platform that is additionally tilted, and rotated about the upright axis, by these angles
/// (radians) about its middle.
pub(crate) fn turned(corners: &[Vector3; 8], tilt: f32, yaw: f32) -> [Vector3; 8] {
    if tilt == 0.0 && yaw == 0.0 {
        return *corners;
    }
    let middle = |corners: &[Vector3]| corners.iter().sum::<Vector3>() / corners.len() as f32;
    let ends = [middle(&corners[..4]), middle(&corners[4..])];
    let (whole, [tilt, yaw]) = (middle(&ends), [tilt, yaw].map(|angle| libm::sincos(f64::from(angle))));
    let about = |[x, y]: Point, (sine, cosine): (f64, f64)| {
        let (x, y) = (f64::from(x), f64::from(y));
        [(x * cosine - y * sine) as f32, (x * sine + y * cosine) as f32]
    };
    std::array::from_fn(|at| {
        // Clockwise on the screen, with Y up. Each end rotates about its own middle, so that a leaning
        // platform keeps its lean.
        let end = ends[at / 4];
        let out = corners[at] - end;
        let [x, down] = about([out.x, -out.y], tilt);
        let out = end + Vector3::new(x, -down, out.z) - whole;
        let [x, z] = about([out.x, out.z], yaw);
        whole + Vector3::new(x, out.y, z)
    })
}

/// The part of a convex face above or on the ground, clockwise as the face; empty if there is none.
pub(crate) fn above_ground(face: [Vector3; 4]) -> Vec<Vector3> {
    let mut kept = Vec::with_capacity(5);
    for (index, &from) in face.iter().enumerate() {
        let to = face[(index + 1) % face.len()];
        if from.y >= 0.0 {
            kept.push(from);
        }
        if from.y.min(to.y) < 0.0 && from.y.max(to.y) > 0.0 {
            kept.push(from + (to - from) * (from.y / (from.y - to.y)));
        }
    }
    kept
}

/// The slopes of [`Transform::slant`](crate::Transform::slant) that lift what lies on level ground straight up onto
/// a surface.
pub(crate) fn slopes(simulator: &TwoHalfPhysicsSimulator, surface: &Surface) -> Point {
    // A px to the right is one of X. A px down is one towards the viewer, and to the side along the Z axis.
    let rise = |x: f32, z: f32| -(surface.normal.x * x + surface.normal.z * z) / surface.normal.y;
    let [side, _] = to_screen(simulator, Vector3::new(0.0, 0.0, 1.0));
    [-rise(1.0, 0.0), -rise(side, -1.0)]
}

/// The edge of a surface that was found at X on the screen (`x`, px); `None` on the ground, which has no
/// edge.
pub(crate) fn edge(simulator: &TwoHalfPhysicsSimulator, surface: &Surface, x: f32) -> Option<Vec<Point>> {
    match surface.partner {
        ContactTarget::Ground => None,
        ContactTarget::Platform(id) => {
            Some(edge_of_platform(simulator, &simulator.platform(id)?.corners(), surface))
        }
        ContactTarget::Geom(id) => {
            let corners = corners_of_top(simulator, id, surface, x).unwrap_or_default();
            Some(corners.into_iter().map(|corner| to_screen(simulator, corner)).collect())
        }
    }
}

/// The outline of that face of a platform whose normal is closest to the surface's normal.
pub(crate) fn edge_of_platform(
    simulator: &TwoHalfPhysicsSimulator,
    corners: &[Vector3; 8],
    surface: &Surface,
) -> Vec<Point> {
    let towards = |face: &Face| face.normal(corners).normalize().dot(&surface.normal);
    let face = Face::ALL.into_iter().max_by(|a, b| towards(a).total_cmp(&towards(b)));
    face.unwrap_or(Face::Top).corners(corners).map(|corner| to_screen(simulator, corner)).to_vec()
}

/// The whole top of a geom that stands upright. Of another prism it is the side of its outline that forms the
/// surface at `x`, as deep as the prism is.
fn corners_of_top(
    simulator: &TwoHalfPhysicsSimulator,
    id: GeomId,
    surface: &Surface,
    x: f32,
) -> Option<Vec<Vector3>> {
    let (geom, outline) = simulator.geom(id).zip(simulator.core().geom(id))?;
    let VirtualGeom { top, front, back, .. } = geom.virtual_geom();
    if let Some(footprint) = footprint_of(&geom) {
        return Some(footprint.into_iter().map(|[x, z]| Vector3::new(x, top, z)).collect());
    }
    let points = outline.world_vertices();
    let (count, point) = (points.len(), |at: usize| points[at % points.len()]);
    // The outline is wound counterclockwise with y down: an upward side runs to the left. A side may have
    // corners between its ends.
    let is_of_side = |at: &usize| {
        let way = point(at + 1) - point(*at);
        -way.y * surface.normal.x - way.x * surface.normal.y > SAME * way.norm()
    };
    let is_there = |&at: &usize| (point(at + 1).x..=point(at).x).contains(&x) && is_of_side(&at);
    let found = (count..2 * count).find(is_there)?;
    let before = (1..count).take_while(|step| is_of_side(&(found - step))).count();
    let after = (1..count).take_while(|step| is_of_side(&(found + step))).count();
    let ends = [point(found - before), point(found + 1 + after)];
    let [near, far] = [front, back].map(|z| ends.map(|end| Vector3::new(end.x, -end.y, z)));
    Some(vec![near[0], near[1], far[1], far[0]])
}

/// Least scalar product of two unit normals that count as equal, dimensionless.
const SAME: f32 = 0.9999;
