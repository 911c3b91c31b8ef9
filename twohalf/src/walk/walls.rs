//! What stands in the way of a figure: what it touches, and the sides of platforms, found before they are touched.
//!
//! Boxes whose edges lean or climb in depth, and those that are turned, are left to the engine, which tells of them as soon as they are near.

use farseer_core::{SpaceFoot, SpaceTouch};

use super::feet::{Feet, Round, SKIN};
use super::floor::{holds, partner_of, top_of_box};
use super::stride::Stride;
use crate::shapes::SlantedBox;
use crate::{GeomId, Partner, TwoHalfPhysicsSimulator, Vector2, Vector3};

/// What is kept between a figure and a wall, px, so that rounding does not make it lean on it.
pub(super) const KEPT_OFF: f32 = 0.1;

/// How far around the feet something is to be as low as a curb to be none, px: farther than contacts reach.
const NEAR: f32 = 1.0;
/// What pushes down by more than this part of its normal does not stand in the way.
const CEILING: f32 = 0.5;

impl TwoHalfPhysicsSimulator {
    /// A velocity with which the figure comes to the surface of what it would run into, and no farther, so that it
    /// does not lean on it.
    pub(super) fn held_off(
        &self,
        stride: &Stride<'_>,
        mut velocity: Vector3,
        is_wall: impl Fn(&SpaceTouch) -> bool,
    ) -> Vector3 {
        for touch in stride.near.touches.iter().filter(|touch| touch.responds && is_wall(touch)) {
            let Some(partner) = partner_of(touch, stride.geom).filter(|&it| self.is_in_the_way(stride, it))
            else {
                continue;
            };
            let [x, up, z] = pushes(touch, stride.geom);
            if (-CEILING..stride.least_up).contains(&up) {
                let points = &touch.points[..touch.count];
                let gap = points.iter().fold(f32::INFINITY, |least, point| least.min(point.separation));
                let fastest = (gap - KEPT_OFF).max(0.0) / stride.dt;
                let wall = self.velocity_of(partner, stride.place) / stride.pace;
                let held = velocity + pushed_off(velocity - wall, Vector2::new(x, z), fastest);
                velocity = stride.held_back(partner, velocity, held);
            }
        }
        self.held_off_platforms(stride, velocity)
    }

    /// Whether what a figure touches is too high to be stepped on. Level edges of platforms are [found](Self::held_off_platforms)
    /// before they are touched.
    fn is_in_the_way(&self, stride: &Stride<'_>, partner: Partner) -> bool {
        match partner {
            Partner::Geom(geom) => self.geom(geom).is_some_and(|geom| geom.virtual_geom().top > stride.knees),
            Partner::Platform(id) => self.platform(id).is_some_and(|platform| {
                // What swings is pushed open.
                if platform.swing().is_some() {
                    return false;
                }
                let shape = platform.shape();
                // What turns or climbs is as high as it is here.
                let is_low =
                    || top_of_box(shape, &stride.feet.widened(NEAR)).is_some_and(|top| top.0 <= stride.knees);
                shape.shear != 0.0 || ((shape.climb != 0.0 || shape.is_turned()) && !is_low())
            }),
            Partner::Ground => false,
        }
    }

    /// A velocity that ends at the platforms that it would run into.
    fn held_off_platforms(&self, stride: &Stride<'_>, mut velocity: Vector3) -> Vector3 {
        let way = velocity * stride.dt;
        let swept = stride.feet.swept(way).widened(SKIN + KEPT_OFF);
        let low = Vector3::new(swept.left, -stride.head, swept.front);
        let high = Vector3::new(swept.right, -stride.soles, swept.back);
        for (id, platform) in self.world.platforms.overlapping(low, high) {
            if platform.is_one_way()
                || platform.swing().is_some()
                || !holds(platform, self.core.geom(stride.geom).as_deref())
            {
                continue;
            }
            let Some(wall) = wall_of(platform.shape(), stride) else { continue };
            if stride.is_slope(platform.shape(), way) {
                continue;
            }
            let stride = &stride.on(stride.feet_against(platform.shape()));
            let held = held_off_platform(stride, velocity, &wall, platform.velocity() / stride.pace);
            velocity = stride.held_back(Partner::Platform(id), velocity, held);
        }
        velocity
    }
}

/// A velocity that ends at a wall that moves.
fn held_off_platform(stride: &Stride<'_>, mut velocity: Vector3, wall: &Feet, moving: Vector3) -> Vector3 {
    if let Some(round) = stride.feet.round {
        let way = [velocity.x - moving.x, velocity.z - moving.z].map(|part| part * stride.dt);
        let [x, z] = held_off_wall(&round, wall, way).map(|part| part / stride.dt);
        (velocity.x, velocity.z) = (moving.x + x, moving.z + z);
        return velocity;
    }
    let (along_x, along_z) = stride.feet.ways_to(wall);
    let x = Approach { way: (velocity.x - moving.x) * stride.dt, ends: along_x };
    let z = Approach { way: (velocity.z - moving.z) * stride.dt, ends: along_z };
    // It is run into along the axis along which it is reached last.
    if x.is_last(&z) {
        velocity.x = moving.x + x.allowed() / stride.dt;
    } else if z.is_last(&x) {
        velocity.z = moving.z + z.allowed() / stride.dt;
    }
    velocity
}

impl Stride<'_> {
    /// The feet that a box is in the way of: a round end that is on stairs is only as wide as it is at the height of the box.
    fn feet_against(&self, shape: &SlantedBox) -> Feet {
        if !self.is_on_stairs {
            return self.feet;
        }
        let top = shape.rectangle().iter().fold(f32::INFINITY, |top, corner| top.min(corner.y));
        self.feet.up_to(-(top + shape.centre.y) - self.soles)
    }

    /// Whether a box is a slope that a round end rolls up: of that no more is in the way than what it touches.
    fn is_slope(&self, shape: &SlantedBox, way: Vector3) -> bool {
        [self.feet, self.feet.moved(way)].into_iter().any(|feet| {
            let rest = feet.ball().and_then(|ball| ball.on_box(shape));
            rest.is_some_and(|rest| {
                rest.edge.is_none() && rest.normal.y >= self.least_up && rest.height <= self.knees
            })
        })
    }
}

/// The direction in which a touch pushes a geom, Y up.
pub(super) fn pushes(touch: &SpaceTouch, geom: GeomId) -> [f32; 3] {
    let sign = if touch.this == geom { 1.0 } else { -1.0 };
    let [x, y, z] = touch.normal;
    [sign * x, -sign * y, sign * z]
}

/// What makes a velocity come no faster against a normal, as seen from above.
fn pushed_off(velocity: Vector3, normal: Vector2, fastest: f32) -> Vector3 {
    let excess = -velocity.x * normal.x - velocity.z * normal.y - fastest;
    if excess <= 0.0 {
        return Vector3::zeros();
    }
    let push = normal * (excess / normal.norm_squared());
    Vector3::new(push.x, 0.0, push.y)
}

/// The way of a disc, without what leads closer to a wall from where it has come near to it.
fn held_off_wall(round: &Round, wall: &Feet, way: [f32; 2]) -> [f32; 2] {
    let corners =
        [[wall.left, wall.front], [wall.right, wall.front], [wall.right, wall.back], [wall.left, wall.back]];
    let disc = SpaceFoot::Disc(round.radius + SKIN + KEPT_OFF - ROUNDED);
    let gap = |part: f32| {
        let at = [0, 1].map(|axis| -round.from[axis] - part * way[axis]);
        disc.gap(SpaceFoot::Polygon(&corners), at)
    };
    let (now, _) = gap(0.0);
    // Who is in it is pushed out by the engine, and not held back.
    if now < -2.0 * (SKIN + KEPT_OFF) || gap(1.0).0 >= 0.0 {
        return way;
    }
    let (mut before, mut after) = (0.0, 1.0);
    for _ in 0..HALVINGS {
        let middle = 0.5 * (before + after);
        if gap(middle).0 > 0.0 { before = middle } else { after = middle }
    }
    let (_, normal) = gap(before);
    let closing = (way[0] * normal[0] + way[1] * normal[1]) * (1.0 - before);
    if closing <= 0.0 { way } else { [0, 1].map(|axis| way[axis] - closing * normal[axis]) }
}

/// What rounding takes of a distance at most, px.
const ROUNDED: f32 = 0.002;
/// Each halves the part of a step within which a wall is come near to.
const HALVINGS: usize = 12;

/// A way along an axis, and how far it is to touch a wall from below and from above, with signs.
struct Approach {
    way: f32,
    ends: [f32; 2],
}

impl Approach {
    /// How far it is to the near side; negative inside.
    fn gap(&self) -> f32 {
        let [low, high] = self.ends;
        if self.way > 0.0 { low } else { -high }
    }

    /// The part of the way, from 0 on, during which the two overlap along this axis.
    fn overlap(&self) -> (f32, f32) {
        let [low, high] = self.ends;
        if self.way == 0.0 {
            return if low < 0.0 && high > 0.0 { (0.0, f32::INFINITY) } else { (f32::INFINITY, 0.0) };
        }
        let (a, b) = (low / self.way, high / self.way);
        (a.min(b), a.max(b))
    }

    /// Whether the wall is come too near to along this axis, while the two overlap along another one.
    fn is_last(&self, other: &Self) -> bool {
        let (gap, way) = (self.gap(), self.way.abs());
        let (begins, ends) = other.overlap();
        let (near, near_at) = (gap - SKIN - KEPT_OFF, gap / way);
        way > 0.0 && gap >= 0.0 && near < way && begins < ends && begins <= near_at && ends > near_at.min(1.0)
    }

    fn allowed(&self) -> f32 {
        self.way.signum() * (self.gap() - SKIN - KEPT_OFF).max(0.0)
    }
}

impl Feet {
    /// How far these have to go along X and along Z to touch others, from either side.
    fn ways_to(&self, other: &Feet) -> ([f32; 2], [f32; 2]) {
        (
            [other.left - self.right, other.right - self.left],
            [other.front - self.back, other.back - self.front],
        )
    }
}

/// What of a box is between the height that can be stepped up and the head, as seen from above.
pub(super) fn wall_of(shape: &SlantedBox, stride: &Stride<'_>) -> Option<Feet> {
    if shape.is_sheared() || shape.is_turned() {
        return None;
    }
    let (top, bottom) = (-stride.head, -stride.knees);
    let corners = shape.rectangle();
    let (mut left, mut right) = (f32::INFINITY, f32::NEG_INFINITY);
    for at in 0..4 {
        let (a, b) = (corners[at], corners[(at + 1) % 4]);
        let (a, b) = (a + shape.centre.xy(), b + shape.centre.xy());
        let (high, low) = if a.y <= b.y { (a, b) } else { (b, a) };
        let (from, to) = (high.y.max(top), low.y.min(bottom));
        if from > to {
            continue;
        }
        let x_at = |y: f32| {
            if low.y > high.y { high.x + (low.x - high.x) * ((y - high.y) / (low.y - high.y)) } else { a.x }
        };
        for x in [x_at(from), x_at(to)].into_iter().chain((low.y == high.y).then_some(b.x)) {
            (left, right) = (left.min(x), right.max(x));
        }
    }
    let depth = shape.half[2];
    (left < right).then(|| Feet::rectangle(left, right, shape.centre.z - depth, shape.centre.z + depth))
}
