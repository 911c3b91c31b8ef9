//! Surfaces of the world as they appear on the screen.

use twohalf::{Partner, PlatformId, Surface, TwoHalfPhysicsSimulator, Vector3};

use crate::Point;

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
    /// Those that can be seen: that what is the back can only of what is turned.
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

    /// Outward, not of length 1.
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

/// What of a convex face lies above the ground or on it: clockwise as the face, empty if nothing does.
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

/// The edge of a surface on the screen; `None` on the ground, which has none.
pub(crate) fn edge(simulator: &TwoHalfPhysicsSimulator, surface: &Surface) -> Option<Vec<Point>> {
    let Partner::Platform(platform) = surface.partner else { return None };
    let corners = simulator.platform(platform)?.corners();
    let towards = |face: &Face| face.normal(&corners).normalize().dot(&surface.normal);
    let face = Face::ALL.into_iter().max_by(|a, b| towards(a).total_cmp(&towards(b)))?;
    Some(face.corners(&corners).map(|corner| to_screen(simulator, corner)).to_vec())
}
