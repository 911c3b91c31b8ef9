//! Where two balls touch.

use super::Space;
use super::solid::Solid;
use crate::math::plane::{Pose, Vector, difference, place, rotation, scaled, sum, turn};
use crate::precise::bodies::Bodies;
use crate::precise::manifold::Manifold;
use crate::precise::outline::Shape;
use crate::precise::proxies::{Mobility, Proxy};

/// What of a ball says where it touches another one.
pub(in crate::precise) struct Ball {
    /// Its middle, and how far that is from its body's origin.
    centre: Vector,
    arm: Vector,
    z: f32,
    radius: f32,
    /// Way of the coming step, if nothing changes its velocity.
    ahead: [f32; 3],
}

impl Ball {
    #[inline(always)]
    fn new(shape: Shape, pose: Pose, z: f32, ahead: [f32; 3]) -> Self {
        let centre = sum(place(pose), turn(rotation(pose), shape.centre));
        Ball { centre, arm: difference(centre, place(pose)), z, radius: shape.radius, ahead }
    }

    pub(super) fn of(solid: Solid<'_>) -> Self {
        Ball::new(solid.outline.shape, solid.pose, solid.z, solid.ahead)
    }
}

impl Space {
    /// Two proxies as balls of bodies that can be pushed, if they are such: most that touch in a heap of balls are, and little has
    /// to be known of them.
    pub(in crate::precise) fn balls(
        &self,
        proxies: [u32; 2],
        two: [&Proxy; 2],
        (bodies, dt): (&Bodies, f32),
    ) -> Option<[Ball; 2]> {
        let is_ball = |at: usize| self.is_round(proxies[at]) && two[at].mobility == Mobility::Dynamic;
        let ball = |proxy: &Proxy| {
            let body = proxy.body as usize;
            let [x, y, _, z] = bodies.hot[body].velocity;
            Ball::new(proxy.shape, bodies.poses[body], self.places[body], [x * dt, y * dt, z * dt])
        };
        (is_ball(0) && is_ball(1)).then(|| two.map(ball))
    }
}

/// The contact of A and B. `is_new`: they did not touch before.
pub(in crate::precise) fn touch(a: Ball, b: Ball, is_new: bool, reach: f32) -> Manifold {
    let [dx, dy] = difference(b.centre, a.centre);
    let dz = b.z - a.z;
    let squared = dx * dx + dy * dy + dz * dz;
    let distance = squared.sqrt();
    // Centres in one place are pushed apart along y.
    let is_far = squared > f32::MIN_POSITIVE;
    let mut normal = if is_far { [dx, dy, dz].map(|way| way / distance) } else { [0.0, 1.0, 0.0] };
    let mut separation = distance - a.radius - b.radius;
    if separation > reach {
        return Manifold::apart(separation);
    }
    if is_new && separation > 0.0 {
        let Some(meeting) = meet(&a, &b, [dx, dy, dz]) else { return Manifold::apart(0.0) };
        (separation, normal) = meeting;
    }
    let [nx, ny, nz] = normal;
    let point = sum(a.arm, scaled([nx, ny], a.radius + 0.5 * separation));
    let mut found = Manifold::of_point([nx, ny], point, separation, 0, f32::MAX);
    found.normal_z = nz;
    found
}

/// Where two balls that do not touch yet will do so in this step, as they move: their distance along the normal that they will
/// have there, and that normal. `None` for those that pass each other.
fn meet(a: &Ball, b: &Ball, apart: [f32; 3]) -> Option<(f32, [f32; 3])> {
    let (way, radii): ([f32; 3], f32) =
        (std::array::from_fn(|axis| b.ahead[axis] - a.ahead[axis]), a.radius + b.radius);
    let product = |a: [f32; 3], b: [f32; 3]| a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
    // |apart + t way| = radii, the earlier time.
    let (closing, squared) = (-product(apart, way), product(way, way));
    let under_root = closing * closing - squared * (product(apart, apart) - radii * radii);
    if !(closing > 0.0 && under_root > 0.0) {
        return None;
    }
    let part = (product(apart, apart) - radii * radii) / (closing + under_root.sqrt());
    let normal: [f32; 3] = std::array::from_fn(|axis| (apart[axis] + part * way[axis]) / radii);
    (part <= 1.0).then_some((-part * product(way, normal), normal))
}
