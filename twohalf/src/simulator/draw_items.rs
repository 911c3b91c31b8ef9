//! Items to draw, and the test for which of two is drawn first.

use farseer_core::BodyId;

use super::TwoHalfPhysicsSimulator;
use crate::projection::to_world;
use crate::shapes::Face;
use crate::{PlatformId, Vector2, Vector3};

/// An item to draw.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Drawable {
    /// The item is a body.
    Body(BodyId),
    /// The item is a platform.
    Platform(PlatformId),
}

/// Bounds of an item in the world and on the screen.
#[derive(Debug, Clone, Copy)]
pub(super) struct DrawItem {
    pub(super) drawable: Drawable,
    pub(super) low: Vector3,
    pub(super) high: Vector3,
    /// Depth that orders items without another criterion, px: Z of a body, centre of a platform.
    pub(super) middle: f32,
    /// Index of the platform's sides in the list of sides; `None` for a body.
    pub(super) sides: Option<u32>,
    pub(super) screen_low: Vector2,
    pub(super) screen_high: Vector2,
}

/// Greatest penetration of resting contacts, px. Two items that overlap by less side by side only touch.
const RESTING_PENETRATION: f32 = 2.0;

/// Least difference in height of two tops from which one sticks out, px; more than the rounding of
/// coordinates up to 2^16 px.
const MIN_RISE: f32 = 0.01;

/// Least Y of the unit normal of a top, dimensionless. Below it the height of its plane is useless.
const MIN_TOP_NORMAL_Y: f32 = 1e-3;

/// Sides of a platform: outward normals and their plane distances from the origin, px.
pub(super) type ViewSides = [(Vector3, f32); 6];

impl DrawItem {
    fn of_points(drawable: Drawable, points: impl Iterator<Item = (Vector3, Vector2)>) -> Option<Self> {
        let mut item: Option<DrawItem> = None;
        for (p, s) in points {
            let fresh = DrawItem {
                drawable,
                low: p,
                high: p,
                middle: p.z,
                sides: None,
                screen_low: s,
                screen_high: s,
            };
            let item = item.get_or_insert(fresh);
            (item.low, item.high) = (item.low.inf(&p), item.high.sup(&p));
            (item.screen_low, item.screen_high) = (item.screen_low.inf(&s), item.screen_high.sup(&s));
        }
        item
    }

    /// Returns whether depth, height and left end are those of another item, to the last bit.
    pub(super) fn has_same_position(&self, other: &DrawItem) -> bool {
        let place = |item: &DrawItem| [item.middle, item.low.y, item.screen_low.x].map(f32::to_bits);
        place(self) == place(other)
    }

    /// Returns the least coordinate of the item's box along a unit direction, px.
    fn least_along(&self, n: Vector3) -> f32 {
        (0..3).map(|axis| n[axis] * if n[axis] > 0.0 { self.low[axis] } else { self.high[axis] }).sum()
    }

    /// Returns the greatest separation from the item `other` over all tested axes, px, negative for an overlap, and the unit
    /// direction of that axis from this item to the other one.
    fn separation_to(&self, other: &DrawItem, all_sides: &[ViewSides]) -> (f32, Vector3) {
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

    fn sides_among<'a>(&self, all_sides: &'a [ViewSides]) -> impl Iterator<Item = &'a (Vector3, f32)> {
        self.sides.map(|at| &all_sides[at as usize]).into_iter().flatten()
    }

    /// Returns whether this item is drawn before the other wherever both are visible; `None` if they share no point of the
    /// screen. `to_viewer` is the direction of the line whose points have one point of the screen.
    ///
    /// A separating plane of two convex shapes decides: the one on the viewer's side is in front everywhere.
    /// Two solids that interpenetrate have no such plane; [the tops](Self::is_topped_by) decide.
    pub(super) fn is_below(&self, other: &DrawItem, sides: &[ViewSides], to_viewer: Vector3) -> Option<bool> {
        let (separation, direction) = self.separation_to(other, sides);
        let nearer = direction.dot(&to_viewer);
        if separation >= 0.0 {
            return (nearer != 0.0).then_some(nearer > 0.0);
        }
        let slop =
            if nearer == 0.0 { RESTING_PENETRATION } else { 0.5 * self.least_size().min(other.least_size()) };
        let topped = if self.is_solid() && other.is_solid() && -separation > slop {
            self.is_topped_by(other, sides)
        } else {
            None
        };
        topped.or(Some(if nearer == 0.0 { self.middle > other.middle } else { nearer > 0.0 }))
    }

    /// Returns whether the item has an extent in depth; flat pictures have none.
    fn is_solid(&self) -> bool {
        self.high.z > self.low.z
    }

    /// Returns the least of width, height and depth of the item's box, px.
    fn least_size(&self) -> f32 {
        (self.high - self.low).min()
    }

    fn footprint_area(&self) -> f32 {
        (self.high.x - self.low.x) * (self.high.z - self.low.z)
    }

    /// Returns whether the item `other` is on top of this item, for two solids that interpenetrate: its top sticks out of this
    /// one, and not the reverse. If both tops stick out or neither does, the item with the smaller footprint is on top, since
    /// it is visible nowhere else. `None` for equal footprints.
    fn is_topped_by(&self, other: &DrawItem, sides: &[ViewSides]) -> Option<bool> {
        let sticks_out = [self.greatest_rise_to(other, sides), other.greatest_rise_to(self, sides)]
            .map(|rise| rise > MIN_RISE);
        match sticks_out {
            [true, false] => Some(true),
            [false, true] => Some(false),
            _ => {
                let [own, others] = [self, other].map(DrawItem::footprint_area);
                (own != others).then_some(own > others)
            }
        }
    }

    /// Returns the greatest height of the top of the item `other` above the top of this item, px, at the corners and the centre
    /// of the common footprint. This suffices because tops are planes or ridges.
    fn greatest_rise_to(&self, other: &DrawItem, sides: &[ViewSides]) -> f32 {
        let (low, high) = (self.low.sup(&other.low), self.high.inf(&other.high));
        let middle = [0.5 * (low.x + high.x), 0.5 * (low.z + high.z)];
        let places = [[low.x, low.z], [high.x, low.z], [low.x, high.z], [high.x, high.z], middle];
        let rises = places.map(|place| other.top_at(place, sides) - self.top_at(place, sides));
        rises.into_iter().fold(f32::NEG_INFINITY, f32::max)
    }

    /// Returns the height of the item's upper surface at a place (X, Z), px.
    fn top_at(&self, [x, z]: [f32; 2], sides: &[ViewSides]) -> f32 {
        let faces_up = self.sides_among(sides).filter(|(n, _)| n.y > MIN_TOP_NORMAL_Y);
        let heights = faces_up.map(|(n, reach)| (reach - n.x * x - n.z * z) / n.y);
        heights.fold(self.high.y, f32::min).max(self.low.y)
    }
}

impl TwoHalfPhysicsSimulator {
    /// Lists the enabled bodies of the simulation, then the platforms.
    pub(super) fn list_items(&self, items: &mut Vec<DrawItem>, sides: &mut Vec<ViewSides>) {
        items.extend(self.body_list().iter().filter_map(|&id| self.item_of_body(id)));
        for id in self.platforms() {
            let Some(platform) = self.platform(id) else { continue };
            let corners = platform.corners();
            let points = corners.into_iter().map(|corner| (corner, self.projection().to_screen(corner)));
            let Some(item) = DrawItem::of_points(Drawable::Platform(id), points) else { continue };
            let middle = (item.low.z + item.high.z) * 0.5;
            items.push(DrawItem { middle, sides: Some(sides.len() as u32), ..item });
            let shape = platform.shape();
            let [top, left, bottom, right] = Face::SIDES;
            sides.push([top, left, bottom, right, Face::Front, Face::Back].map(|face| {
                let normal = shape.face_normal(face);
                // The distance of the origin from a side is the negative plane distance.
                (to_world(normal), -shape.distance_to_face(face, Vector3::zeros()))
            }));
        }
    }

    /// Returns the bounds of a body as an item; `None` for a body that is not drawn. A body with a top has a box from its front
    /// to its back, even if it is drawn as a flat picture. A ball or a capsule is flat: its picture appears at the centre of
    /// the body.
    fn item_of_body(&self, id: BodyId) -> Option<DrawItem> {
        let body = self.body(id).filter(|body| body.enabled())?;
        let drawable = Drawable::Body(id);
        let z = self.world.depths.z_of(id);
        let shown = |p: Vector3| (p, self.projection().to_screen(p));
        let geoms = self.core.geoms_of(id).iter().filter_map(|&geom| self.geom(geom));
        // The two corners that appear farthest down and up, left and right, for either direction of the Z
        // axis.
        let corners = geoms.flat_map(|geom| {
            let v = geom.virtual_geom();
            let [front, back] = if v.has_top { [v.front, v.back] } else { [z; 2] };
            let [near, far] = if self.angle() <= 90 { [v.left, v.right] } else { [v.right, v.left] };
            [Vector3::new(near, v.bottom, front), Vector3::new(far, v.top, back)]
        });
        let of_geoms = DrawItem::of_points(drawable, corners.map(shown));
        let origin = || {
            let p = body.origin3d();
            DrawItem::of_points(drawable, [shown(Vector3::new(p.x, p.y, z))].into_iter())
        };
        Some(DrawItem { middle: z, ..of_geoms.or_else(origin)? })
    }
}
