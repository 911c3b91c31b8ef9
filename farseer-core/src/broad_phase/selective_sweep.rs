//! Selective sweep, the default broad phase: sorted interval ends, swept along the axis with fewer overlaps (behaviour
//! chapter 08, section 2).

use serde::{Deserialize, Serialize};
use wide::f32x4;

use super::PairCallback;
use super::dotnet_introsort::introspective_sort;
use super::endpoint::Endpoint;
use crate::geom::GeomId;
use crate::geom::entry::Geoms;
use crate::shape::Aabb;
use crate::storage::order::{packed_key, sort_by_number, total_order_key};
use farseer_precise::reusing_clone;

/// The ends of all intervals on one axis. Their order persists from one update to the next: the next sort starts from
/// it, and with equal values the result depends on it.
#[derive(Debug, Default, Serialize, Deserialize)]
struct SortedEnds {
    endpoints: Vec<Endpoint>,
    #[serde(skip)]
    unsorted: Vec<Endpoint>,
}

reusing_clone! { SortedEnds { endpoints, unsorted } }

/// Whether a sort met endpoints that its comparison cannot order.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum EqualEndpoints {
    Absent,
    Present,
}

impl SortedEnds {
    fn add(&mut self, entry: usize) {
        self.endpoints.push(Endpoint::begin(entry));
        self.endpoints.push(Endpoint::end(entry));
    }

    /// Sorts the ends into the order of the original's sort.
    ///
    /// Without ties there is only one order, whatever the method. With ties the original's own sort runs on the
    /// previous order; where it fails, the order is (value, begin first, order of creation).
    fn sort(&mut self, numbers: &[u32]) {
        self.unsorted.clone_from(&self.endpoints);
        if sort_without_ties(&mut self.endpoints) == EqualEndpoints::Absent {
            return;
        }
        std::mem::swap(&mut self.endpoints, &mut self.unsorted);
        if introspective_sort(&mut self.endpoints).is_err() {
            sort_by_number(&mut self.endpoints, |end| {
                // Adding zero makes -0 and +0 equal.
                packed_key([
                    total_order_key(end.value + 0.0),
                    u32::from(!end.is_begin()),
                    numbers[end.entry()],
                ])
            });
        }
    }

    /// Number of overlaps on the axis: the sum over all begins of the intervals open there, with 32-bit wrap-around.
    fn overlap_count(&self) -> i32 {
        let (mut count, mut depth) = (0i32, 0i32);
        for endpoint in &self.endpoints {
            if endpoint.is_begin() {
                count = count.wrapping_add(depth);
                depth += 1;
            } else {
                depth -= 1;
            }
        }
        count
    }
}

/// Sorts by (value, begin first), quickly if the list is nearly sorted, and returns whether that order is unique.
fn sort_without_ties(endpoints: &mut [Endpoint]) -> EqualEndpoints {
    #[inline(always)]
    fn is_before(a: Endpoint, b: Endpoint) -> bool {
        a.value < b.value || (a.value == b.value && a.is_begin() && !b.is_begin())
    }
    // A list that is far from sorted, as after additions, is cheaper to sort from scratch.
    let mut budget = endpoints.len() * 16;
    for i in 1..endpoints.len() {
        let inserted = endpoints[i];
        let mut j = i;
        while j > 0 && is_before(inserted, endpoints[j - 1]) {
            endpoints[j] = endpoints[j - 1];
            j -= 1;
        }
        endpoints[j] = inserted;
        budget = budget.saturating_sub(i - j);
        if budget == 0 {
            sort_by_number(endpoints, |end| {
                packed_key([total_order_key(end.value), u32::from(!end.is_begin())])
            });
            break;
        }
    }
    // Begin and end of one value are ordered; anything else that is not strictly ascending is a tie or NaN.
    let is_unique = endpoints.windows(2).all(|pair| is_before(pair[0], pair[1]));
    if is_unique { EqualEndpoints::Absent } else { EqualEndpoints::Present }
}

/// The geoms that are open at the current position of the sweep, oldest first, with their intervals on the other axis.
/// A closed geom leaves a gap that overlaps no interval. Gaps are removed when they are more than half of the entries.
#[derive(Debug, Default)]
struct OpenIntervals {
    /// Entry numbers of the geoms; [`GAP`] where a geom was closed.
    entries: Vec<u32>,
    low: Vec<f32>,
    high: Vec<f32>,
    /// Position of each entry in `entries`, by entry number.
    positions: Vec<u32>,
    gaps: usize,
}

reusing_clone! { OpenIntervals { entries, low, high, positions, gaps } }

/// Entry number that marks a closed geom.
const GAP: u32 = u32::MAX;

impl OpenIntervals {
    fn begin(&mut self, entry_count: usize) {
        self.entries.clear();
        self.low.clear();
        self.high.clear();
        self.positions.resize(entry_count, 0);
        self.gaps = 0;
    }

    #[inline]
    fn push(&mut self, entry: usize, (low, high): (f32, f32)) {
        self.positions[entry] = self.entries.len() as u32;
        self.entries.push(entry as u32);
        self.low.push(low);
        self.high.push(high);
    }

    #[inline]
    fn remove(&mut self, entry: usize) {
        let position = self.positions[entry] as usize;
        // With NaN among the ends, an interval may be closed that was never opened.
        if self.entries.get(position) != Some(&(entry as u32)) {
            return;
        }
        self.entries[position] = GAP;
        (self.low[position], self.high[position]) = (f32::NAN, f32::NAN);
        self.gaps += 1;
        if self.gaps > 16 && self.gaps * 2 > self.entries.len() {
            self.close_gaps();
        }
    }

    fn close_gaps(&mut self) {
        let mut kept = 0;
        for position in 0..self.entries.len() {
            let entry = self.entries[position];
            if entry != GAP {
                self.entries[kept] = entry;
                (self.low[kept], self.high[kept]) = (self.low[position], self.high[position]);
                self.positions[entry as usize] = kept as u32;
                kept += 1;
            }
        }
        self.entries.truncate(kept);
        self.low.truncate(kept);
        self.high.truncate(kept);
        self.gaps = 0;
    }

    /// Calls `meet` with every open entry whose interval overlaps or touches the given one, oldest first.
    #[inline]
    fn for_each_overlap(&self, (low, high): (f32, f32), mut meet: impl FnMut(usize)) {
        let (lows, highs) = (self.low.as_chunks::<4>(), self.high.as_chunks::<4>());
        let (low4, high4) = (f32x4::splat(low), f32x4::splat(high));
        for (chunk, (&active_low, &active_high)) in lows.0.iter().zip(highs.0).enumerate() {
            let overlaps = low4.simd_le(f32x4::new(active_high)) & f32x4::new(active_low).simd_le(high4);
            let mut overlaps = overlaps.to_bitmask();
            while overlaps != 0 {
                meet(self.entries[chunk * 4 + overlaps.trailing_zeros() as usize] as usize);
                overlaps &= overlaps - 1;
            }
        }
        let done = lows.0.len() * 4;
        for (position, (&active_low, &active_high)) in (done..).zip(lows.1.iter().zip(highs.1)) {
            if low <= active_high && active_low <= high {
                meet(self.entries[position] as usize);
            }
        }
    }
}

#[derive(Debug, Default, Serialize, Deserialize)]
pub(crate) struct SelectiveSweep {
    /// In order of addition.
    entries: Vec<GeomId>,
    x: SortedEnds,
    y: SortedEnds,
    /// Creation number and box of every entry, read again in each update.
    #[serde(skip)]
    numbers: Vec<u32>,
    #[serde(skip)]
    boxes: Vec<Aabb>,
    #[serde(skip)]
    active: OpenIntervals,
}

reusing_clone! { SelectiveSweep { entries, x, y, numbers, boxes, active } }

impl SelectiveSweep {
    pub(super) fn add(&mut self, id: GeomId) {
        let entry = self.entries.len();
        self.entries.push(id);
        self.x.add(entry);
        self.y.add(entry);
    }

    pub(super) fn retain(&mut self, alive: impl Fn(GeomId) -> bool) {
        let mut next = 0;
        let renumbered: Vec<Option<u32>> = self
            .entries
            .iter()
            .map(|&id| {
                alive(id).then(|| {
                    next += 1;
                    next - 1
                })
            })
            .collect();
        if next as usize == self.entries.len() {
            return;
        }
        for axis in [&mut self.x, &mut self.y] {
            axis.endpoints.retain_mut(|endpoint| match renumbered[endpoint.entry()] {
                Some(entry) => {
                    endpoint.key = entry * 2 + (endpoint.key & 1);
                    true
                }
                None => false,
            });
        }
        self.entries.retain(|&id| alive(id));
    }

    pub(super) fn update(&mut self, sink: &mut impl PairCallback) {
        self.gather(sink.filter().geoms);
        self.x.sort(&self.numbers);
        self.y.sort(&self.numbers);
        if self.x.overlap_count() < self.y.overlap_count() {
            self.sweep(true, sink);
        } else {
            self.sweep(false, sink);
        }
    }

    /// Copies the boxes of the geoms into the interval ends.
    fn gather(&mut self, geoms: &Geoms) {
        self.numbers.clear();
        self.boxes.clear();
        for &id in &self.entries {
            let geom = &geoms[id];
            self.numbers.push(geom.number);
            self.boxes.push(geom.aabb);
        }
        for endpoint in &mut self.x.endpoints {
            let aabb = &self.boxes[endpoint.entry()];
            endpoint.value = if endpoint.is_begin() { aabb.min.x } else { aabb.max.x };
        }
        for endpoint in &mut self.y.endpoints {
            let aabb = &self.boxes[endpoint.entry()];
            endpoint.value = if endpoint.is_begin() { aabb.min.y } else { aabb.max.y };
        }
    }

    fn sweep(&mut self, along_x: bool, sink: &mut impl PairCallback) {
        let SelectiveSweep { entries, x, y, boxes, active, .. } = self;
        let endpoints = if along_x { &x.endpoints } else { &y.endpoints };
        active.begin(entries.len());
        for &endpoint in endpoints {
            let entry = endpoint.entry();
            let aabb = &boxes[entry];
            // A box that is a single point is paired with open geoms but is never opened itself.
            let is_point = !(aabb.min.x != aabb.max.x || aabb.min.y != aabb.max.y);
            if endpoint.is_begin() {
                let other = if along_x { (aabb.min.y, aabb.max.y) } else { (aabb.min.x, aabb.max.x) };
                active.for_each_overlap(other, |open| offer_pair(entries[entry], entries[open], sink));
                if !is_point {
                    active.push(entry, other);
                }
            } else if !is_point {
                active.remove(entry);
            }
        }
    }

    pub(super) fn is_valid(&self, geoms: &Geoms) -> bool {
        let count = self.entries.len();
        let ends_complete = |axis: &SortedEnds| {
            let mut missing = vec![true; count * 2];
            axis.endpoints.len() == count * 2
                && axis.endpoints.iter().all(|endpoint| {
                    missing.get_mut(endpoint.key as usize).is_some_and(|m| std::mem::replace(m, false))
                })
        };
        self.entries.iter().all(|&id| geoms.contains(id)) && ends_complete(&self.x) && ends_complete(&self.y)
    }
}

/// Offers a pair whose boxes overlap on both axes: `opened` begins while `open` is open.
fn offer_pair(opened: GeomId, open: GeomId, sink: &mut impl PairCallback) {
    let filter = sink.filter();
    if !filter.may_collide(&filter.geoms[opened], &filter.geoms[open]) {
        return;
    }
    if sink.has_approval() && !sink.approve(opened, open) {
        return;
    }
    sink.register(opened, open);
}

/// One end of an interval. Intervals are numbered in the order in which they were added.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct SweepEnd {
    /// Index of the interval, from 0.
    pub interval: usize,
    /// Whether it is the lower end.
    pub is_begin: bool,
}

/// The order of interval ends on one axis over successive updates, as the selective sweep keeps it.
///
/// For tests and for tools that show what ties do; the simulator keeps its own.
#[derive(Debug, Clone, Default)]
pub struct SelectiveSweepOrder {
    axis: SortedEnds,
    numbers: Vec<u32>,
}

impl SelectiveSweepOrder {
    /// `count` intervals, begin and end of each in turn.
    pub fn new(count: usize) -> Self {
        let mut order = SelectiveSweepOrder::default();
        for interval in 0..count {
            order.axis.add(interval);
            order.numbers.push(interval as u32);
        }
        order
    }

    /// Moves the intervals and sorts their ends, starting from the previous order. Intervals beyond the end of the list
    /// keep their values.
    pub fn update(&mut self, intervals: &[(f32, f32)]) {
        for endpoint in &mut self.axis.endpoints {
            if let Some(&(begin, end)) = intervals.get(endpoint.entry()) {
                endpoint.value = if endpoint.is_begin() { begin } else { end };
            }
        }
        self.axis.sort(&self.numbers);
    }

    /// The ends in their present order.
    pub fn ends(&self) -> impl Iterator<Item = SweepEnd> + '_ {
        self.axis.endpoints.iter().map(|e| SweepEnd { interval: e.entry(), is_begin: e.is_begin() })
    }
}
