//! What is drawn over what.

use farseer_core::BodyId;

use crate::shapes::Face;
use crate::tell::to_world;
use crate::world::World;
use crate::{PlatformId, TwoHalfPhysicsSimulator, Vector2, Vector3};

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
struct Item {
    drawable: Drawable,
    low: Vector3,
    high: Vector3,
    /// Sides of a platform: outward normals and how far they reach along them.
    sides: Option<[(Vector3, f32); 4]>,
    screen_low: Vector2,
    screen_high: Vector2,
}

impl Item {
    fn of_points(drawable: Drawable, points: impl Iterator<Item = (Vector3, Vector2)>) -> Option<Self> {
        let mut item: Option<Item> = None;
        for (p, s) in points {
            let fresh = Item { drawable, low: p, high: p, sides: None, screen_low: s, screen_high: s };
            let item = item.get_or_insert(fresh);
            (item.low, item.high) = (item.low.inf(&p), item.high.sup(&p));
            (item.screen_low, item.screen_high) = (item.screen_low.inf(&s), item.screen_high.sup(&s));
        }
        item
    }

    fn middle(&self) -> f32 {
        (self.low.z + self.high.z) * 0.5
    }

    /// Least of the box along a direction.
    fn least_along(&self, n: Vector3) -> f32 {
        (0..3).map(|axis| n[axis] * if n[axis] > 0.0 { self.low[axis] } else { self.high[axis] }).sum()
    }

    /// The direction from this to the other along which they are farthest apart, or overlap least.
    fn direction_to(&self, other: &Item) -> Vector3 {
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
        for &(n, reach) in self.sides.iter().flatten() {
            consider(other.least_along(n) - reach, n);
        }
        for &(n, reach) in other.sides.iter().flatten() {
            consider(self.least_along(n) - reach, -n);
        }
        best.1
    }

    /// Whether this is drawn before the other. `to_viewer` is the direction of the line on which all points appear
    /// at one point of the screen.
    fn is_below(&self, other: &Item, to_viewer: Vector3) -> bool {
        let nearer = self.direction_to(other).dot(&to_viewer);
        if nearer == 0.0 { self.middle() > other.middle() } else { nearer > 0.0 }
    }

    fn may_cover(&self, other: &Item) -> bool {
        self.screen_low.y <= other.screen_high.y && other.screen_low.y <= self.screen_high.y
    }
}

impl TwoHalfPhysicsSimulator {
    /// The bodies that take part and are enabled, and the platforms, back to front: draw them in this order.
    ///
    /// Of two that cover each other on the screen the one before the other comes later: separated in Z, the nearer
    /// one; on top of each other, the higher one; side by side, what the Z axis leans away from. What decides is
    /// the direction in which their boxes, or the sides of a platform, are farthest apart or overlap least. Where
    /// that goes round in a circle, one of the pairs is in the wrong order. What covers nothing is ordered by Z,
    /// then by height, then as it was added.
    pub fn draw_order(&self) -> Vec<Drawable> {
        let mut items: Vec<Item> = self.items().collect();
        items.sort_by(|a, b| {
            let height = a.low.y.total_cmp(&b.low.y);
            b.middle().total_cmp(&a.middle()).then(height).then(a.drawable.cmp(&b.drawable))
        });
        let below = covered(&items, self.projection().to_viewer());
        let mut order = Vec::with_capacity(items.len());
        let mut is_visited = vec![false; items.len()];
        let mut path: Vec<(usize, usize)> = Vec::new();
        for index in 0..items.len() {
            // Depth first: everything below goes first.
            if !std::mem::replace(&mut is_visited[index], true) {
                path.push((index, 0));
            }
            while let Some((item, next)) = path.pop() {
                match below[item].get(next) {
                    Some(&lower) => {
                        path.push((item, next + 1));
                        if !std::mem::replace(&mut is_visited[lower], true) {
                            path.push((lower, 0));
                        }
                    }
                    None => order.push(items[item].drawable),
                }
            }
        }
        order
    }

    fn items(&self) -> impl Iterator<Item = Item> + '_ {
        let bodies = self.body_list().iter().filter_map(|&id| self.item_of_body(id));
        let platforms = self.platforms().filter_map(|id| {
            let platform = self.platform(id)?;
            let corners = platform.corners();
            let points = corners.into_iter().map(|corner| (corner, self.projection().to_screen(corner)));
            let item = Item::of_points(Drawable::Platform(id), points)?;
            let shape = platform.shape();
            let sides = Face::SIDES.map(|face| {
                let normal = shape.face_normal(face);
                (to_world(normal), shape.distance_to_face(face, Vector3::zeros()))
            });
            // The origin's distance from a side is the negative of how far the side reaches.
            Some(Item { sides: Some(sides.map(|(normal, distance)| (normal, -distance))), ..item })
        });
        bodies.chain(platforms)
    }

    fn item_of_body(&self, id: BodyId) -> Option<Item> {
        let body = self.body(id).filter(|body| body.enabled())?;
        let geoms = self.core.geoms_of(id).iter().filter_map(|&geom| self.geom(geom));
        let corners = geoms.flat_map(|geom| {
            let v = geom.virtual_geom();
            let near = (Vector3::new(v.left, v.bottom, v.front), Vector3::new(v.right, v.top, v.back));
            [near.0, near.1]
        });
        // The picture is flat: it appears at the middle of the body.
        let (origin, z) = (body.origin3d(), self.world.z_of(id));
        let on_screen = |p: Vector3| self.projection().to_screen(Vector3::new(p.x, p.y, z));
        let corners = corners.map(|corner| (corner, on_screen(corner)));
        let points: Vec<_> = corners.collect();
        let origin = points.is_empty().then(|| (origin, on_screen(origin)));
        Item::of_points(Drawable::Body(id), points.into_iter().chain(origin))
    }
}

/// For every item the indices of those that it covers.
fn covered(items: &[Item], to_viewer: Vector3) -> Vec<Vec<usize>> {
    let mut below = vec![Vec::new(); items.len()];
    let mut by_left: Vec<usize> = (0..items.len()).collect();
    by_left.sort_by(|&a, &b| items[a].screen_low.x.total_cmp(&items[b].screen_low.x));
    for (position, &a) in by_left.iter().enumerate() {
        for &b in
            by_left[position + 1..].iter().take_while(|&&b| items[b].screen_low.x <= items[a].screen_high.x)
        {
            if items[a].may_cover(&items[b]) {
                let (lower, upper) = if items[a].is_below(&items[b], to_viewer) { (a, b) } else { (b, a) };
                below[upper].push(lower);
            }
        }
    }
    below.iter_mut().for_each(|list| list.sort_unstable());
    below
}

impl World {
    /// 0 at the near end of the range, 1 at the far one.
    pub(crate) fn layer_depth(&self, z: f32) -> f32 {
        let (near, far) = self.layer_range;
        ((z - near) / (far - near)).clamp(0.0, 1.0)
    }
}
