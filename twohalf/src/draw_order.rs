//! What is drawn over what.

use farseer_core::BodyId;

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

/// The room that something takes up, and where it appears.
#[derive(Debug, Clone, Copy)]
struct Item {
    drawable: Drawable,
    front: f32,
    back: f32,
    bottom: f32,
    top: f32,
    /// On the screen.
    low: Vector2,
    high: Vector2,
}

/// Heights that differ by less than this part of the smaller object are the same: what rests on one floor does not
/// change places with every jolt.
const SAME_HEIGHT: f32 = 1.0 / 16.0;

impl Item {
    fn of_points(drawable: Drawable, points: impl Iterator<Item = (Vector3, Vector2)>) -> Option<Self> {
        let mut item: Option<Item> = None;
        for (p, s) in points {
            let item = item.get_or_insert(Item {
                drawable,
                front: p.z,
                back: p.z,
                bottom: p.y,
                top: p.y,
                low: s,
                high: s,
            });
            (item.front, item.back) = (item.front.min(p.z), item.back.max(p.z));
            (item.bottom, item.top) = (item.bottom.min(p.y), item.top.max(p.y));
            (item.low, item.high) = (item.low.inf(&s), item.high.sup(&s));
        }
        item
    }

    fn middle(&self) -> f32 {
        (self.front + self.back) * 0.5
    }

    /// Whether this is drawn before the other: separated in Z, the farther one; otherwise the lower one; at the same
    /// height the one whose middle is farther.
    fn is_below(&self, other: &Item) -> bool {
        if self.front >= other.back || other.front >= self.back {
            return self.middle() > other.middle();
        }
        let size = (self.top - self.bottom).min(other.top - other.bottom);
        if (self.bottom - other.bottom).abs() > size * SAME_HEIGHT {
            return self.bottom < other.bottom;
        }
        self.middle() > other.middle()
    }

    fn may_cover(&self, other: &Item) -> bool {
        self.low.y <= other.high.y && other.low.y <= self.high.y
    }
}

impl TwoHalfPhysicsSimulator {
    /// The bodies that take part and are enabled, and the platforms, back to front: draw them in this order.
    ///
    /// Of two that cover each other on the screen, separated in Z, the nearer one comes later; otherwise the higher
    /// one; at the same height the one whose middle is nearer. Where that goes round in a circle, one of the pairs is in the
    /// wrong order. What covers nothing is ordered by Z, then by height, then as it was added.
    pub fn draw_order(&self) -> Vec<Drawable> {
        let mut items: Vec<Item> = self.items().collect();
        items.sort_by(|a, b| {
            let height = a.bottom.total_cmp(&b.bottom);
            b.middle().total_cmp(&a.middle()).then(height).then(a.drawable.cmp(&b.drawable))
        });
        let below = covered(&items);
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
            let corners = self.platform(id)?.corners();
            let points = corners.into_iter().map(|corner| (corner, self.projection().to_screen(corner)));
            Item::of_points(Drawable::Platform(id), points)
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
fn covered(items: &[Item]) -> Vec<Vec<usize>> {
    let mut below = vec![Vec::new(); items.len()];
    let mut by_left: Vec<usize> = (0..items.len()).collect();
    by_left.sort_by(|&a, &b| items[a].low.x.total_cmp(&items[b].low.x));
    for (position, &a) in by_left.iter().enumerate() {
        for &b in by_left[position + 1..].iter().take_while(|&&b| items[b].low.x <= items[a].high.x) {
            if items[a].may_cover(&items[b]) {
                let (lower, upper) = if items[a].is_below(&items[b]) { (a, b) } else { (b, a) };
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
