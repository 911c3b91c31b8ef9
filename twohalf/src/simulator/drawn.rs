//! What is there to be drawn, and which of two is drawn before the other.

use farseer_core::BodyId;

use super::TwoHalfPhysicsSimulator;
use crate::projection::to_world;
use crate::shapes::Face;
use crate::{PlatformId, Vector2, Vector3};

/// Something to draw.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Drawable {
    /// A body.
    Body(BodyId),
    /// A platform.
    Platform(PlatformId),
}

/// The room that something takes up in the world, and where it appears on the screen.
#[derive(Debug, Clone, Copy)]
pub(super) struct Item {
    pub(super) drawable: Drawable,
    pub(super) low: Vector3,
    pub(super) high: Vector3,
    /// How far back it is where no direction tells: the Z of a body, the middle of a platform.
    pub(super) middle: f32,
    /// The place of its sides, if it is a platform.
    pub(super) sides: Option<u32>,
    pub(super) screen_low: Vector2,
    pub(super) screen_high: Vector2,
}

/// Sides of a platform: outward normals and how far they reach along them.
pub(super) type Sides = [(Vector3, f32); 6];

impl Item {
    fn of_points(drawable: Drawable, points: impl Iterator<Item = (Vector3, Vector2)>) -> Option<Self> {
        let mut item: Option<Item> = None;
        for (p, s) in points {
            let fresh =
                Item { drawable, low: p, high: p, middle: p.z, sides: None, screen_low: s, screen_high: s };
            let item = item.get_or_insert(fresh);
            (item.low, item.high) = (item.low.inf(&p), item.high.sup(&p));
            (item.screen_low, item.screen_high) = (item.screen_low.inf(&s), item.screen_high.sup(&s));
        }
        item
    }

    /// Whether it is as far back, as high and as far to the left as another one, to the last bit.
    pub(super) fn is_where(&self, other: &Item) -> bool {
        let place = |item: &Item| [item.middle, item.low.y, item.screen_low.x].map(f32::to_bits);
        place(self) == place(other)
    }

    /// Least of the box along a direction.
    fn least_along(&self, n: Vector3) -> f32 {
        (0..3).map(|axis| n[axis] * if n[axis] > 0.0 { self.low[axis] } else { self.high[axis] }).sum()
    }

    /// The direction from this to the other along which they are farthest apart, or overlap least.
    fn direction_to(&self, other: &Item, all_sides: &[Sides]) -> Vector3 {
        let sides_of = |item: &Item| item.sides.map(|at| &all_sides[at as usize]).into_iter().flatten();
        let mut best = (f32::NEG_INFINITY, Vector3::zeros());
        let mut consider = |gap: f32, n: Vector3| {
            if gap > best.0 {
                best = (gap, n);
            }
        };
        for axis in 0..3 {
            let n = Vector3::ith(axis, 1.0);
            consider(other.low[axis] - self.high[axis], n);
            consider(self.low[axis] - other.high[axis], -n);
        }
        for &(n, reach) in sides_of(self) {
            consider(other.least_along(n) - reach, n);
        }
        for &(n, reach) in sides_of(other) {
            consider(self.least_along(n) - reach, -n);
        }
        best.1
    }

    /// Whether this is drawn before the other. `to_viewer` is the direction of the line on which all points appear
    /// at one point of the screen.
    pub(super) fn is_below(&self, other: &Item, sides: &[Sides], to_viewer: Vector3) -> bool {
        let nearer = self.direction_to(other, sides).dot(&to_viewer);
        if nearer == 0.0 { self.middle > other.middle } else { nearer > 0.0 }
    }
}

impl TwoHalfPhysicsSimulator {
    /// The bodies that take part and are enabled, then the platforms.
    pub(super) fn list_items(&self, items: &mut Vec<Item>, sides: &mut Vec<Sides>) {
        items.extend(self.body_list().iter().filter_map(|&id| self.item_of_body(id)));
        for id in self.platforms() {
            let Some(platform) = self.platform(id) else { continue };
            let corners = platform.corners();
            let points = corners.into_iter().map(|corner| (corner, self.projection().to_screen(corner)));
            let Some(item) = Item::of_points(Drawable::Platform(id), points) else { continue };
            let middle = (item.low.z + item.high.z) * 0.5;
            items.push(Item { middle, sides: Some(sides.len() as u32), ..item });
            let shape = platform.shape();
            let [top, left, bottom, right] = Face::SIDES;
            sides.push([top, left, bottom, right, Face::Front, Face::Back].map(|face| {
                let normal = shape.face_normal(face);
                // The origin's distance from a side is the negative of how far the side reaches.
                (to_world(normal), -shape.distance_to_face(face, Vector3::zeros()))
            }));
        }
    }

    /// What has a top is a box from its front to its back, whether it is drawn as one or as a flat picture in it. A ball or a
    /// capsule is flat: its picture appears at the middle of the body.
    fn item_of_body(&self, id: BodyId) -> Option<Item> {
        let body = self.body(id).filter(|body| body.enabled())?;
        let drawable = Drawable::Body(id);
        let z = self.world.depths.z_of(id);
        let shown = |p: Vector3| (p, self.projection().to_screen(p));
        let geoms = self.core.geoms_of(id).iter().filter_map(|&geom| self.geom(geom));
        // Of all corners the two that appear farthest down and up, left and right, to whichever side the Z axis leans.
        let corners = geoms.flat_map(|geom| {
            let v = geom.virtual_geom();
            let [front, back] = if v.has_top { [v.front, v.back] } else { [z; 2] };
            let [near, far] = if self.angle() <= 90 { [v.left, v.right] } else { [v.right, v.left] };
            [Vector3::new(near, v.bottom, front), Vector3::new(far, v.top, back)]
        });
        let of_geoms = Item::of_points(drawable, corners.map(shown));
        let origin = || {
            let p = body.origin3d();
            Item::of_points(drawable, [shown(Vector3::new(p.x, p.y, z))].into_iter())
        };
        Some(Item { middle: z, ..of_geoms.or_else(origin)? })
    }
}
