//! What stands in the way of a figure: the sides of platforms, found before they are touched.
//!
//! Boxes whose edges lean in depth are left to the engine, which tells of them as soon as they are near.

use super::feet::{Feet, SKIN};
use super::floor::holds;
use super::stride::Stride;
use crate::shapes::SlantedBox;
use crate::{TwoHalfPhysicsSimulator, Vector3};

/// What is kept between a figure and a wall, px, so that rounding does not make it lean on it.
pub(super) const KEPT_OFF: f32 = 0.1;

impl TwoHalfPhysicsSimulator {
    /// A velocity that ends at the platforms that it would run into.
    pub(super) fn held_off_platforms(&self, stride: &Stride<'_>, mut velocity: Vector3) -> Vector3 {
        let way = velocity * stride.dt;
        let swept = stride.feet.swept(way).widened(SKIN + KEPT_OFF);
        let low = Vector3::new(swept.left, -stride.head, swept.front);
        let high = Vector3::new(swept.right, -stride.soles, swept.back);
        for (_, platform) in self.world.platforms.overlapping(low, high) {
            if platform.is_one_way() || !holds(platform, self.core.geom(stride.geom).as_deref()) {
                continue;
            }
            let Some(wall) = wall_of(platform.shape(), stride) else { continue };
            let moving = platform.velocity() / stride.pace;
            let (along_x, along_z) = stride.feet.ways_to(&wall);
            let x = Approach { way: (velocity.x - moving.x) * stride.dt, ends: along_x };
            let z = Approach { way: (velocity.z - moving.z) * stride.dt, ends: along_z };
            // It is run into along the axis along which it is reached last.
            if x.is_last(&z) {
                velocity.x = moving.x + x.allowed() / stride.dt;
            } else if z.is_last(&x) {
                velocity.z = moving.z + z.allowed() / stride.dt;
            }
        }
        velocity
    }
}

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
    if shape.shear != 0.0 {
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
    (left < right).then_some(Feet {
        left,
        right,
        front: shape.centre.z - depth,
        back: shape.centre.z + depth,
    })
}
