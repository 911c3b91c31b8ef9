//! What is drawn over what.

use std::cmp::Ordering;

use super::drawn::{Drawable, Item, Sides};
use super::sorted_again::SortedAgain;
use crate::{TwoHalfPhysicsSimulator, Vector3};

/// What orders items from the back to the front, and where one is listed.
#[derive(Debug, Clone, Copy)]
struct ByDepth {
    middle: f32,
    height: f32,
    drawable: Drawable,
    listed: u32,
}

impl ByDepth {
    fn new(item: &Item, listed: u32) -> Self {
        ByDepth { middle: item.middle, height: item.low.y, drawable: item.drawable, listed }
    }

    fn compare(&self, other: &Self) -> Ordering {
        let height = self.height.total_cmp(&other.height);
        other.middle.total_cmp(&self.middle).then(height).then(self.drawable.cmp(&other.drawable))
    }
}

/// Where an item appears on the screen.
#[derive(Debug, Clone, Copy)]
struct Appearance {
    left: f32,
    right: f32,
    low: f32,
    high: f32,
    /// Its place among the items, and where it is listed.
    item: u32,
    listed: u32,
}

impl Appearance {
    fn new(item: &Item, rank: u32, listed: u32) -> Self {
        Appearance {
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

/// What is drawn over what, found again in every frame, in room that is kept: it allocates nothing once it has grown to the scene, and only what
/// has moved since the frame before is sorted again.
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
    /// As they are listed, and as they were in the frame before.
    listed: Vec<Item>,
    before: Vec<Item>,
    /// By place in the list of the frame before, the one now.
    now_at: Vec<u32>,
    at_slot: Vec<u32>,
    /// By place in the list: whether it was in the one before, whether it has moved since, and its place among the items.
    is_known: Vec<bool>,
    has_moved: Vec<bool>,
    ranks: Vec<u32>,
    by_depth: SortedAgain<ByDepth>,
    /// From the back to the front.
    items: Vec<Item>,
    sides: Vec<Sides>,
    appearances: SortedAgain<Appearance>,
    /// Pairs of items, the one that is covered last.
    covers: Vec<[u32; 2]>,
    strips: Lists,
    /// What each item covers.
    covered: Lists,
    is_visited: Vec<bool>,
    path: Vec<[u32; 2]>,
    order: Vec<Drawable>,
}

/// No place.
const GONE: u32 = u32::MAX;

impl DrawOrder {
    /// The bodies that take part and are enabled, and the platforms, as [`TwoHalfPhysicsSimulator::draw_order`] orders them.
    pub fn sort(&mut self, simulator: &TwoHalfPhysicsSimulator) -> &[Drawable] {
        std::mem::swap(&mut self.listed, &mut self.before);
        self.listed.clear();
        self.sides.clear();
        simulator.list_items(&mut self.listed, &mut self.sides);
        self.find_again();
        self.sort_by_depth();
        self.sort_by_appearance();
        self.find_covers(simulator.projection().to_viewer());
        self.walk();
        &self.order
    }

    /// Where those of the frame before are listed now, and which of them have moved.
    fn find_again(&mut self) {
        let DrawOrder { listed, before, now_at, at_slot, is_known, has_moved, .. } = self;
        // What is listed now is what was before in the next frame: there is room for it.
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
                    at_slot.resize(at_slot.len().max(id.slot() + 1), GONE);
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
                let found =
                    place.filter(|&place| place != GONE && listed[place as usize].drawable == item.drawable);
                found.unwrap_or(GONE)
            }));
        }
        for marks in [&mut *is_known, &mut *has_moved] {
            marks.clear();
            marks.resize(listed.len(), false);
        }
        for (before, &place) in before.iter().zip(now_at.iter()).filter(|(_, place)| **place != GONE) {
            is_known[place as usize] = true;
            has_moved[place as usize] = !before.is_where(&listed[place as usize]);
        }
    }

    fn sort_by_depth(&mut self) {
        let DrawOrder { listed, now_at, is_known, has_moved, ranks, by_depth, items, .. } = self;
        let entry = |place: u32| ByDepth::new(&listed[place as usize], place);
        let fresh =
            (0..).zip(is_known.iter()).filter(|(_, is_known)| !**is_known).map(|(place, _)| entry(place));
        let now = |before: &ByDepth| {
            let place = now_at[before.listed as usize];
            (place != GONE).then(|| (entry(place), has_moved[place as usize]))
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

    /// By their left sides.
    fn sort_by_appearance(&mut self) {
        let DrawOrder { listed, now_at, is_known, has_moved, ranks, appearances, .. } = self;
        let entry = |place: u32| Appearance::new(&listed[place as usize], ranks[place as usize], place);
        let fresh =
            (0..).zip(is_known.iter()).filter(|(_, is_known)| !**is_known).map(|(place, _)| entry(place));
        let now = |before: &Appearance| {
            let place = now_at[before.listed as usize];
            (place != GONE).then(|| (entry(place), has_moved[place as usize]))
        };
        appearances.sort(now, fresh, Appearance::compare);
    }

    /// Who covers whom, of those that appear at one place of the screen.
    fn find_covers(&mut self, to_viewer: Vector3) {
        let DrawOrder { items, sides, appearances, strips, covers, covered, .. } = self;
        let appearances = appearances.as_slice();
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
    /// the direction in which their boxes, or the sides of a platform, are farthest apart or overlap least. Of two solids
    /// that are sunk in each other by more than half of the smaller one's least side, as a lift in a street, the one whose
    /// top sticks out comes later; if that is true of both or neither, the one with the smaller footprint. What has
    /// a [top](crate::VirtualGeom::has_top) has a box as deep as itself, so that what stands on it comes later wherever
    /// its middle is; balls and capsules are flat, at their middle. Where that goes round in a circle, one of the
    /// pairs is in the wrong order. What covers nothing is ordered by Z, then by height, then as it was added.
    ///
    /// [`DrawOrder`] does the same without allocating in every frame.
    pub fn draw_order(&self) -> Vec<Drawable> {
        let mut order = DrawOrder::default();
        order.sort(self);
        order.order
    }
}
