//! What is drawn over what.

use farseer_core::BodyId;

use crate::projection::to_world;
use crate::shapes::Face;
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
    /// The place of its sides, if it is a platform.
    sides: Option<u32>,
    screen_low: Vector2,
    screen_high: Vector2,
}

/// Sides of a platform: outward normals and how far they reach along them.
type Sides = [(Vector3, f32); 6];

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
    fn is_below(&self, other: &Item, sides: &[Sides], to_viewer: Vector3) -> bool {
        let nearer = self.direction_to(other, sides).dot(&to_viewer);
        if nearer == 0.0 { self.middle() > other.middle() } else { nearer > 0.0 }
    }
}

/// Where an item appears on the screen.
#[derive(Debug, Clone, Copy)]
struct Appearance {
    left: f32,
    right: f32,
    low: f32,
    high: f32,
    /// Its place among the items.
    item: u32,
}

/// Lists of numbers, one behind the other.
#[derive(Debug, Clone, Default)]
struct Lists {
    /// Where each begins; behind the last one, where it ends.
    begins: Vec<u32>,
    entries: Vec<u32>,
}

impl Lists {
    /// Makes so many lists of pairs of a list and an entry, each in the order in which its entries come.
    fn fill(&mut self, count: usize, pairs: impl Iterator<Item = [u32; 2]> + Clone) {
        let Lists { begins, entries } = self;
        begins.clear();
        begins.resize(count + 2, 0);
        pairs.clone().for_each(|[list, _]| begins[list as usize + 2] += 1);
        for list in 2..begins.len() {
            begins[list] += begins[list - 1];
        }
        entries.clear();
        entries.resize(begins[count + 1] as usize, 0);
        // One place ahead: by the end every list begins where the one before it ends.
        for [list, entry] in pairs {
            let next = &mut begins[list as usize + 1];
            entries[*next as usize] = entry;
            *next += 1;
        }
    }

    fn range(&self, list: usize) -> std::ops::Range<usize> {
        self.begins[list] as usize..self.begins[list + 1] as usize
    }

    fn of(&self, list: usize) -> &[u32] {
        &self.entries[self.range(list)]
    }
}

/// Strips of the screen, one below the other: who is in none together does not cover each other.
#[derive(Debug, Clone, Copy)]
struct Strips {
    first: f32,
    per_length: f32,
    count: usize,
}

/// Items per strip, and the most strips, so that what is as high as the screen is not in too many.
const ITEMS_PER_STRIP: usize = 16;
const MOST_STRIPS: usize = 256;

impl Strips {
    fn over(appearances: &[Appearance]) -> Self {
        let low = appearances.iter().map(|appearance| appearance.low).fold(f32::INFINITY, f32::min);
        let high = appearances.iter().map(|appearance| appearance.high).fold(f32::NEG_INFINITY, f32::max);
        let count = (appearances.len() / ITEMS_PER_STRIP).clamp(1, MOST_STRIPS);
        Strips { first: low, per_length: count as f32 / (high - low), count }
    }

    /// The strip at a height. Conversion saturates, and what is no number is in the first one.
    fn at(&self, y: f32) -> u32 {
        (((y - self.first) * self.per_length) as u32).min(self.count as u32 - 1)
    }

    fn of(&self, appearance: &Appearance) -> std::ops::RangeInclusive<u32> {
        self.at(appearance.low)..=self.at(appearance.high)
    }
}

/// What is drawn over what, found again in every frame, in room that is kept: it allocates nothing once it has grown to the scene.
///
/// ```
/// # use twohalf::{DrawOrder, TwoHalfPhysicsSimulator, Vector2};
/// let mut simulator = TwoHalfPhysicsSimulator::with_gravity(600, Vector2::new(0.0, 100.0))?;
/// let mut order = DrawOrder::default();
/// for _ in 0..60 {
///     simulator.update(1.0 / 60.0);
///     for drawable in order.sort(&simulator) {
///         // draw it
///     }
/// }
/// # Ok::<(), twohalf::Error>(())
/// ```
#[derive(Debug, Clone, Default)]
pub struct DrawOrder {
    items: Vec<Item>,
    sides: Vec<Sides>,
    appearances: Vec<Appearance>,
    /// Pairs of items, the one that is covered last.
    covers: Vec<[u32; 2]>,
    strips: Lists,
    /// What each item covers.
    covered: Lists,
    is_visited: Vec<bool>,
    path: Vec<[u32; 2]>,
    order: Vec<Drawable>,
}

impl DrawOrder {
    /// The bodies that take part and are enabled, and the platforms, as [`TwoHalfPhysicsSimulator::draw_order`] orders them.
    pub fn sort(&mut self, simulator: &TwoHalfPhysicsSimulator) -> &[Drawable] {
        self.items.clear();
        self.sides.clear();
        simulator.list_items(&mut self.items, &mut self.sides);
        self.items.sort_unstable_by(|a, b| {
            let height = a.low.y.total_cmp(&b.low.y);
            b.middle().total_cmp(&a.middle()).then(height).then(a.drawable.cmp(&b.drawable))
        });
        self.find_covers(simulator.projection().to_viewer());
        self.walk();
        &self.order
    }

    /// Who covers whom, of those that appear at one place of the screen.
    fn find_covers(&mut self, to_viewer: Vector3) {
        let DrawOrder { items, sides, appearances, strips, covers, covered, .. } = self;
        appearances.clear();
        appearances.extend((0..).zip(items.iter()).map(|(item, of)| Appearance {
            left: of.screen_low.x,
            right: of.screen_high.x,
            low: of.screen_low.y,
            high: of.screen_high.y,
            item,
        }));
        appearances.sort_unstable_by(|a, b| a.left.total_cmp(&b.left).then(a.item.cmp(&b.item)));
        let parts = Strips::over(appearances);
        let in_strips = (0..).zip(appearances.iter());
        let in_strips = in_strips.flat_map(|(at, of)| parts.of(of).map(move |strip| [strip, at]));
        strips.fill(parts.count, in_strips);
        covers.clear();
        for strip in 0..parts.count {
            let present = strips.of(strip);
            for (position, &a) in present.iter().enumerate() {
                let a = &appearances[a as usize];
                let others = present[position + 1..].iter().map(|&b| &appearances[b as usize]);
                for b in others.take_while(|b| b.left <= a.right) {
                    let higher = if a.low > b.low { a.low } else { b.low };
                    // Two that are in several strips together are looked at in the first one.
                    if a.low <= b.high && b.low <= a.high && parts.at(higher) as usize == strip {
                        let [one, other] = [a, b].map(|appearance| &items[appearance.item as usize]);
                        let is_below = one.is_below(other, sides, to_viewer);
                        covers.push(if is_below { [b.item, a.item] } else { [a.item, b.item] });
                    }
                }
            }
        }
        covered.fill(items.len(), covers.iter().copied());
        for item in 0..items.len() {
            let range = covered.range(item);
            covered.entries[range].sort_unstable();
        }
    }

    /// Depth first: everything below goes first.
    fn walk(&mut self) {
        let DrawOrder { items, covered, is_visited, path, order, .. } = self;
        is_visited.clear();
        is_visited.resize(items.len(), false);
        order.clear();
        for first in 0..items.len() {
            if !std::mem::replace(&mut is_visited[first], true) {
                path.push([first as u32, 0]);
            }
            while let Some([item, next]) = path.pop() {
                let Some(&lower) = covered.of(item as usize).get(next as usize) else {
                    order.push(items[item as usize].drawable);
                    continue;
                };
                path.push([item, next + 1]);
                if !std::mem::replace(&mut is_visited[lower as usize], true) {
                    path.push([lower, 0]);
                }
            }
        }
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
    ///
    /// [`DrawOrder`] does the same without allocating in every frame.
    pub fn draw_order(&self) -> Vec<Drawable> {
        let mut order = DrawOrder::default();
        order.sort(self);
        order.order
    }

    fn list_items(&self, items: &mut Vec<Item>, sides: &mut Vec<Sides>) {
        items.extend(self.body_list().iter().filter_map(|&id| self.item_of_body(id)));
        for id in self.platforms() {
            let Some(platform) = self.platform(id) else { continue };
            let corners = platform.corners();
            let points = corners.into_iter().map(|corner| (corner, self.projection().to_screen(corner)));
            let Some(item) = Item::of_points(Drawable::Platform(id), points) else { continue };
            items.push(Item { sides: Some(sides.len() as u32), ..item });
            let shape = platform.shape();
            let [top, left, bottom, right] = Face::SIDES;
            sides.push([top, left, bottom, right, Face::Front, Face::Back].map(|face| {
                let normal = shape.face_normal(face);
                // The origin's distance from a side is the negative of how far the side reaches.
                (to_world(normal), -shape.distance_to_face(face, Vector3::zeros()))
            }));
        }
    }

    fn item_of_body(&self, id: BodyId) -> Option<Item> {
        let body = self.body(id).filter(|body| body.enabled())?;
        // The picture is flat: it appears at the middle of the body.
        let z = self.world.depths.z_of(id);
        let shown = |p: Vector3| (p, self.projection().to_screen(Vector3::new(p.x, p.y, z)));
        let geoms = self.core.geoms_of(id).iter().filter_map(|&geom| self.geom(geom));
        let corners = geoms.flat_map(|geom| {
            let v = geom.virtual_geom();
            [Vector3::new(v.left, v.bottom, v.front), Vector3::new(v.right, v.top, v.back)]
        });
        let of_geoms = Item::of_points(Drawable::Body(id), corners.map(shown));
        of_geoms.or_else(|| Item::of_points(Drawable::Body(id), [shown(body.origin3d())].into_iter()))
    }
}
