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

/// Overlap that resting contacts leave, px, at most: two that overlap by less side by side only touch.
const SAG: f32 = 2.0;

/// Difference in height of two tops from which on one of them sticks out, px: more than rounding of coordinates up to 2^16 px.
const LEAST_RISE: f32 = 0.01;

/// Y of the unit normal from which on a side looks up: below it, the height of its plane is no finite number of use.
const LEAST_UP: f32 = 1e-3;

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

    /// Separation in px, negative where the two overlap, and the direction from this to the other along which it is greatest.
    fn separation_to(&self, other: &Item, all_sides: &[Sides]) -> (f32, Vector3) {
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
        for &(n, reach) in self.sides_among(all_sides) {
            consider(other.least_along(n) - reach, n);
        }
        for &(n, reach) in other.sides_among(all_sides) {
            consider(self.least_along(n) - reach, -n);
        }
        best
    }

    fn sides_among<'a>(&self, all_sides: &'a [Sides]) -> impl Iterator<Item = &'a (Vector3, f32)> {
        self.sides.map(|at| &all_sides[at as usize]).into_iter().flatten()
    }

    /// Whether this is drawn before the other wherever both appear; `None` if the two share no point of the screen. `to_viewer` is
    /// the direction of the line on which all points appear at one point of the screen.
    ///
    /// A plane between two convex shapes decides: the one on the viewer's side of it is in front of the other everywhere. Two solids
    /// that interpenetrate have no such plane; of these [the tops](Self::is_topped_by) decide.
    pub(super) fn is_below(&self, other: &Item, sides: &[Sides], to_viewer: Vector3) -> Option<bool> {
        let (separation, direction) = self.separation_to(other, sides);
        let nearer = direction.dot(&to_viewer);
        if separation >= 0.0 {
            return (nearer != 0.0).then_some(nearer > 0.0);
        }
        let slop = if nearer == 0.0 { SAG } else { 0.5 * self.least_size().min(other.least_size()) };
        let topped = if self.is_solid() && other.is_solid() && -separation > slop {
            self.is_topped_by(other, sides)
        } else {
            None
        };
        topped.or(Some(if nearer == 0.0 { self.middle > other.middle } else { nearer > 0.0 }))
    }

    /// Whether it has a depth: flat pictures have none.
    fn is_solid(&self) -> bool {
        self.high.z > self.low.z
    }

    /// The least of its width, height and depth, px.
    fn least_size(&self) -> f32 {
        (self.high - self.low).min()
    }

    fn footprint_area(&self) -> f32 {
        (self.high.x - self.low.x) * (self.high.z - self.low.z)
    }

    /// Of two solids that interpenetrate, whether the other one's top sticks out of this one's and not the other way round. If both
    /// do, or neither, the one with the smaller footprint is on top: it is seen nowhere else. `None` for equal footprints.
    fn is_topped_by(&self, other: &Item, sides: &[Sides]) -> Option<bool> {
        let sticks_out = [self.greatest_rise_to(other, sides), other.greatest_rise_to(self, sides)]
            .map(|rise| rise > LEAST_RISE);
        match sticks_out {
            [true, false] => Some(true),
            [false, true] => Some(false),
            _ => {
                let [own, others] = [self, other].map(Item::footprint_area);
                (own != others).then_some(own > others)
            }
        }
    }

    /// How far the top of another one rises over the top of this one at most, px, at the corners and the middle of the footprint that
    /// both have in common: tops are planes or ridges.
    fn greatest_rise_to(&self, other: &Item, sides: &[Sides]) -> f32 {
        let (low, high) = (self.low.sup(&other.low), self.high.inf(&other.high));
        let middle = [0.5 * (low.x + high.x), 0.5 * (low.z + high.z)];
        let places = [[low.x, low.z], [high.x, low.z], [low.x, high.z], [high.x, high.z], middle];
        let rises = places.map(|place| other.top_at(place, sides) - self.top_at(place, sides));
        rises.into_iter().fold(f32::NEG_INFINITY, f32::max)
    }

    /// Height of its upper surface at a place of X and Z, px.
    fn top_at(&self, [x, z]: [f32; 2], sides: &[Sides]) -> f32 {
        let faces_up = self.sides_among(sides).filter(|(n, _)| n.y > LEAST_UP);
        let heights = faces_up.map(|(n, reach)| (reach - n.x * x - n.z * z) / n.y);
        heights.fold(self.high.y, f32::min).max(self.low.y)
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
