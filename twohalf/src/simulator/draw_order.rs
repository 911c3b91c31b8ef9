//! Draw order: a topological sort of the items by which covers which.

use std::cmp::Ordering;

use super::draw_items::{DrawItem, Drawable, ViewSides};
use super::incremental_sort::IncrementalSort;
use crate::{TwoHalfPhysicsSimulator, Vector3};

/// Sort key of an item from back to front, with the index of the item in the list.
#[derive(Debug, Clone, Copy)]
struct ByDepth {
    /// Z by which items without another criterion are ordered, px: see `DrawItem::middle`.
    middle: f32,
    /// Least Y of the item in the world, px.
    height: f32,
    drawable: Drawable,
    /// Index of the item in the list of this frame.
    listed: u32,
}

impl ByDepth {
    fn new(item: &DrawItem, listed: u32) -> Self {
        ByDepth { middle: item.middle, height: item.low.y, drawable: item.drawable, listed }
    }

    fn compare(&self, other: &Self) -> Ordering {
        let height = self.height.total_cmp(&other.height);
        other.middle.total_cmp(&self.middle).then(height).then(self.drawable.cmp(&other.drawable))
    }
}

/// Bounds of an item on the screen, px.
#[derive(Debug, Clone, Copy)]
struct ScreenBounds {
    /// Least x, px.
    left: f32,
    /// Greatest x, px.
    right: f32,
    /// Least y, px.
    low: f32,
    /// Greatest y, px.
    high: f32,
    /// Index among the sorted items, and index in the list.
    item: u32,
    listed: u32,
}

impl ScreenBounds {
    fn new(item: &DrawItem, rank: u32, listed: u32) -> Self {
        ScreenBounds {
            left: item.screen_low.x,
            right: item.screen_high.x,
            low: item.screen_low.y,
            high: item.screen_high.y,
            item: rank,
            listed,
        }
    }

    fn compare(&self, other: &Self) -> Ordering {
        self.left.total_cmp(&other.left).then(self.item.cmp(&other.item))
    }
}

/// Lists of numbers, stored in one array.
#[derive(Debug, Clone, Default)]
struct DrawLists {
    /// Start of each list, and the end of the last one.
    begins: Vec<u32>,
    entries: Vec<u32>,
}

impl DrawLists {
    /// Builds `count` lists from pairs of a list and an entry; entries keep their order.
    fn fill(&mut self, count: usize, pairs: impl Iterator<Item = [u32; 2]> + Clone) {
        let DrawLists { begins, entries } = self;
        begins.clear();
        begins.resize(count + 2, 0);
        pairs.clone().for_each(|[list, _]| begins[list as usize + 2] += 1);
        for list in 2..begins.len() {
            begins[list] += begins[list - 1];
        }
        entries.clear();
        entries.resize(begins[count + 1] as usize, 0);
        // One index ahead: at the end every list begins where the one before it ends.
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

/// Horizontal strips of the screen: items without a common strip do not cover each other.
#[derive(Debug, Clone, Copy)]
struct ScreenStrips {
    /// Least y, px.
    first: f32,
    /// Number of strips per px of screen height, 1/px.
    per_length: f32,
    count: usize,
}

/// `ITEMS_PER_STRIP`: number of items per strip. `MAX_STRIPS`: greatest number of strips, so that an item as
/// high as the screen is in few.
const ITEMS_PER_STRIP: usize = 16;
const MAX_STRIPS: usize = 256;

impl ScreenStrips {
    fn over(appearances: &[ScreenBounds]) -> Self {
        let low = appearances.iter().map(|appearance| appearance.low).fold(f32::INFINITY, f32::min);
        let high = appearances.iter().map(|appearance| appearance.high).fold(f32::NEG_INFINITY, f32::max);
        let count = (appearances.len() / ITEMS_PER_STRIP).clamp(1, MAX_STRIPS);
        ScreenStrips { first: low, per_length: count as f32 / (high - low), count }
    }

    /// Returns the index of the strip at a screen height `y`, px. The conversion saturates, and NaN is in the first strip.
    fn at(&self, y: f32) -> u32 {
        (((y - self.first) * self.per_length) as u32).min(self.count as u32 - 1)
    }

    fn of(&self, appearance: &ScreenBounds) -> std::ops::RangeInclusive<u32> {
        self.at(appearance.low)..=self.at(appearance.high)
    }
}

/// Draw order that is updated in every frame. It reuses its buffers, so it allocates nothing once they fit
/// the scene, and re-sorts only items that have moved since the last frame.
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
    /// Items of the present frame, in the order in which the simulator lists bodies and platforms.
    listed: Vec<DrawItem>,
    /// Items of the last frame, in the same order.
    before: Vec<DrawItem>,
    /// Index in the present list, by index in the list of the last frame.
    now_at: Vec<u32>,
    at_slot: Vec<u32>,
    /// By index in the list: whether it was in the last frame, whether it has moved since, and its index
    /// among the sorted items.
    is_known: Vec<bool>,
    has_moved: Vec<bool>,
    ranks: Vec<u32>,
    by_depth: IncrementalSort<ByDepth>,
    /// Items of this frame, sorted from back to front.
    items: Vec<DrawItem>,
    sides: Vec<ViewSides>,
    appearances: IncrementalSort<ScreenBounds>,
    /// Pairs of items that overlap on the screen: the covering item, then the covered one.
    covers: Vec<[u32; 2]>,
    strips: DrawLists,
    /// By item: the items that it covers on the screen.
    covered: DrawLists,
    is_visited: Vec<bool>,
    path: Vec<[u32; 2]>,
    order: Vec<Drawable>,
}

/// Index of an item that is gone.
const NO_INDEX: u32 = u32::MAX;

impl DrawOrder {
    /// The enabled bodies of the simulation and the platforms, in the order of
    /// [`TwoHalfPhysicsSimulator::draw_order`].
    pub fn sort(&mut self, simulator: &TwoHalfPhysicsSimulator) -> &[Drawable] {
        std::mem::swap(&mut self.listed, &mut self.before);
        self.listed.clear();
        self.sides.clear();
        simulator.list_items(&mut self.listed, &mut self.sides);
        self.match_previous();
        self.sort_by_depth();
        self.sort_by_appearance();
        self.find_covers(simulator.projection().to_viewer());
        self.sort_depth_first();
        &self.order
    }

    /// Matches the items of the last frame with the present ones, and marks those that have moved.
    fn match_previous(&mut self) {
        let DrawOrder { listed, before, now_at, at_slot, is_known, has_moved, .. } = self;
        // The present list is the last one of the next frame, so its capacity is reserved now.
        before.reserve(listed.len().saturating_sub(before.len()));
        now_at.clear();
        now_at.reserve(listed.len());
        let is_alike = listed.len() == before.len()
            && listed.iter().zip(before.iter()).all(|(now, before)| now.drawable == before.drawable);
        if is_alike {
            now_at.extend(0..listed.len() as u32);
        } else {
            let platforms = listed.partition_point(|item| matches!(item.drawable, Drawable::Body(_)));
            at_slot.clear();
            for (place, item) in (0..).zip(listed.iter()) {
                if let Drawable::Body(id) = item.drawable {
                    at_slot.resize(at_slot.len().max(id.slot() + 1), NO_INDEX);
                    at_slot[id.slot()] = place;
                }
            }
            now_at.extend(before.iter().map(|item| {
                let place = match item.drawable {
                    Drawable::Body(id) => at_slot.get(id.slot()).copied(),
                    Drawable::Platform(_) => listed[platforms..]
                        .binary_search_by_key(&item.drawable, |item| item.drawable)
                        .ok()
                        .map(|at| (platforms + at) as u32),
                };
                let found = place
                    .filter(|&place| place != NO_INDEX && listed[place as usize].drawable == item.drawable);
                found.unwrap_or(NO_INDEX)
            }));
        }
        for marks in [&mut *is_known, &mut *has_moved] {
            marks.clear();
            marks.resize(listed.len(), false);
        }
        for (before, &place) in before.iter().zip(now_at.iter()).filter(|(_, place)| **place != NO_INDEX) {
            is_known[place as usize] = true;
            has_moved[place as usize] = !before.has_same_position(&listed[place as usize]);
        }
    }

    fn sort_by_depth(&mut self) {
        let DrawOrder { listed, now_at, is_known, has_moved, ranks, by_depth, items, .. } = self;
        let entry = |place: u32| ByDepth::new(&listed[place as usize], place);
        let fresh =
            (0..).zip(is_known.iter()).filter(|(_, is_known)| !**is_known).map(|(place, _)| entry(place));
        let now = |before: &ByDepth| {
            let place = now_at[before.listed as usize];
            (place != NO_INDEX).then(|| (entry(place), has_moved[place as usize]))
        };
        by_depth.sort(now, fresh, ByDepth::compare);
        items.clear();
        ranks.clear();
        ranks.resize(listed.len(), 0);
        for (rank, sorted) in (0..).zip(by_depth.as_slice()) {
            ranks[sorted.listed as usize] = rank;
            items.push(listed[sorted.listed as usize]);
        }
    }

    /// Sorts the screen bounds by their left ends.
    fn sort_by_appearance(&mut self) {
        let DrawOrder { listed, now_at, is_known, has_moved, ranks, appearances, .. } = self;
        let entry = |place: u32| ScreenBounds::new(&listed[place as usize], ranks[place as usize], place);
        let fresh =
            (0..).zip(is_known.iter()).filter(|(_, is_known)| !**is_known).map(|(place, _)| entry(place));
        let now = |before: &ScreenBounds| {
            let place = now_at[before.listed as usize];
            (place != NO_INDEX).then(|| (entry(place), has_moved[place as usize]))
        };
        appearances.sort(now, fresh, ScreenBounds::compare);
    }

    /// Finds the pairs that overlap on the screen, by strips and by sweep and prune along x.
    fn find_covers(&mut self, to_viewer: Vector3) {
        let DrawOrder { items, sides, appearances, strips, covers, covered, .. } = self;
        let appearances = appearances.as_slice();
        let parts = ScreenStrips::over(appearances);
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
                    // A pair with several common strips is tested in the first one.
                    if a.low <= b.high && b.low <= a.high && parts.at(higher) as usize == strip {
                        let [one, other] = [a, b].map(|appearance| &items[appearance.item as usize]);
                        match one.is_below(other, sides, to_viewer) {
                            Some(true) => covers.push([b.item, a.item]),
                            Some(false) => covers.push([a.item, b.item]),
                            None => {}
                        }
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

    /// Sorts the items topologically by depth-first search: covered items are drawn first.
    fn sort_depth_first(&mut self) {
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
    /// The enabled bodies of the simulation and the platforms from back to front: draw them in this order.
    ///
    /// If two items cover each other on the screen, the front one comes later. It is the nearer one in Z, the
    /// higher one of a stack, or the one on the side that the Z axis leans away from. The direction of
    /// greatest separation of their boxes, or of the sides of a platform, decides.
    ///
    /// Two solids may be sunk in each other by more than half of the smaller one's least side, such as a lift
    /// in a street. Then the one whose top sticks out comes later; if both or neither do, the one with the
    /// smaller footprint.
    ///
    /// A body with a [top](crate::VirtualGeom::has_top) has a box of its own depth, so that items on it come
    /// later wherever their centre is. Balls and capsules are flat, at their centre. In a cycle, one of the
    /// pairs is in the wrong order. Items without overlap are ordered by Z, then by height, then as they were
    /// added.
    ///
    /// [`DrawOrder`] does the same without allocating in every frame.
    pub fn draw_order(&self) -> Vec<Drawable> {
        let mut order = DrawOrder::default();
        order.sort(self);
        order.order
    }
}
