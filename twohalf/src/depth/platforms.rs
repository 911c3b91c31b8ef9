//! All platforms of a simulator, and which of them are near.

use farseer_core::FixtureMotion;
use farseer_core::order::{ordered, sort_numbered};
use serde::{Deserialize, Serialize};

use super::platform::Platform;
use super::platform_id::PlatformId;
use crate::error::{invalid, stale};
use crate::{Projection, Result, Vector3};

/// All platforms of a simulator.
#[derive(Debug, Clone, Default, Serialize, Deserialize)]
pub(crate) struct Platforms {
    /// By id, in the order in which they were made.
    list: Vec<(PlatformId, Platform)>,
    next: PlatformId,
    /// Derived: for the search by X.
    #[serde(skip)]
    is_sorted: bool,
    /// The precise set knows them as they are.
    #[serde(skip)]
    is_told: bool,
    /// And how those move that do.
    #[serde(skip)]
    is_motion_told: bool,
    /// The left bound, as a number of its order, with the index into the list, in order; and the greatest right one up to each.
    #[serde(skip)]
    by_left: Vec<(u128, u32)>,
    #[serde(skip)]
    reaches: Vec<f32>,
}

impl Platforms {
    pub(crate) fn insert(&mut self, platform: Platform) -> Result<PlatformId> {
        let id = self.next;
        self.next = id.next().ok_or(invalid("platform", id.number(), "one of fewer than 2^31 - 16"))?;
        self.list.push((id, platform));
        (self.is_sorted, self.is_told) = (false, false);
        Ok(id)
    }

    pub(crate) fn remove(&mut self, id: PlatformId) -> Result<()> {
        let index = self.index_of(id).ok_or(stale("platform"))?;
        self.list.remove(index);
        (self.is_sorted, self.is_told) = (false, false);
        Ok(())
    }

    pub(crate) fn clear(&mut self) {
        self.list.clear();
        (self.is_sorted, self.is_told) = (false, false);
    }

    pub(crate) fn index_of(&self, id: PlatformId) -> Option<usize> {
        self.list.binary_search_by_key(&id, |(id, _)| *id).ok()
    }

    pub(crate) fn get(&self, id: PlatformId) -> Option<&Platform> {
        self.index_of(id).map(|index| &self.list[index].1)
    }

    /// By its [place](Self::index_of).
    pub(crate) fn at(&self, index: usize) -> &Platform {
        &self.list[index].1
    }

    /// Becomes another one.
    pub(crate) fn replace(&mut self, index: usize, platform: Platform) {
        self.list[index].1 = platform;
        (self.is_sorted, self.is_told) = (false, false);
    }

    /// To change what does not move its box.
    pub(crate) fn edit(&mut self, index: usize) -> &mut Platform {
        self.is_told = false;
        &mut self.list[index].1
    }

    /// Lets one swing, or no more.
    pub(crate) fn swing(&mut self, index: usize, platform: Platform) {
        self.replace(index, platform);
        self.is_motion_told = false;
    }

    /// Lets one turn, as another one of which is told whether it stood still so far.
    pub(crate) fn turn(&mut self, index: usize, platform: Platform, stood_still: bool) {
        self.list[index].1 = platform;
        self.is_told &= !stood_still;
        self.is_motion_told = false;
    }

    /// Lets one move.
    pub(crate) fn set_motion(&mut self, index: usize, velocity: Vector3, target: Option<Vector3>) {
        let stood_still = self.list[index].1.set_motion(velocity, target);
        self.is_told &= !stood_still;
        self.is_motion_told = false;
    }

    pub(crate) fn iter(&self) -> impl DoubleEndedIterator<Item = (PlatformId, &Platform)> {
        self.list.iter().map(|(id, platform)| (*id, platform))
    }

    /// The precise set does not know them any more.
    pub(crate) fn tell_again(&mut self) {
        self.is_told = false;
    }

    /// Whether one has come, gone or been edited since this was asked last.
    pub(crate) fn take_changed(&mut self) -> bool {
        !std::mem::replace(&mut self.is_told, true)
    }

    /// The motions of those that move, if one was edited since this was asked last.
    pub(crate) fn edited_motions(&mut self) -> impl Iterator<Item = (PlatformId, FixtureMotion)> + '_ {
        let is_told = std::mem::replace(&mut self.is_motion_told, true);
        let edited = if is_told { &[][..] } else { &self.list };
        edited.iter().filter_map(|(id, platform)| Some((*id, platform.told_motion()?)))
    }

    /// An update has brought a platform somewhere.
    pub(crate) fn has_moved(
        &mut self,
        id: PlatformId,
        centre: Vector3,
        yaw: Option<f32>,
        told: FixtureMotion,
    ) {
        if let Some(index) = self.index_of(id) {
            self.list[index].1.has_moved(centre, yaw, told);
            self.is_sorted = false;
        }
    }

    /// One that swings may have fallen asleep, unless it was edited since.
    pub(crate) fn has_rested(&mut self, id: PlatformId, told: FixtureMotion) {
        if let Some(index) = self.index_of(id).filter(|_| self.is_told && self.is_motion_told) {
            self.list[index].1.has_rested(told);
        }
    }

    /// Whether one has what only the precise set can do.
    pub(crate) fn are_precise(&self) -> bool {
        self.list.iter().any(|(_, platform)| platform.is_precise())
    }

    pub(crate) fn is_empty(&self) -> bool {
        self.list.is_empty()
    }

    /// Makes ready for [`overlapping`](Self::overlapping).
    pub(crate) fn sort(&mut self) {
        if self.is_sorted {
            return;
        }
        self.by_left.clear();
        for ((_, platform), index) in self.list.iter().zip(0..) {
            self.by_left.push((ordered(platform.shape().bounds().0.x).into(), index));
        }
        // Where lifts move, in every update: in place.
        sort_numbered(&mut self.by_left);
        let mut reach = f32::NEG_INFINITY;
        self.reaches.clear();
        for &(_, index) in &self.by_left {
            reach = reach.max(self.list[index as usize].1.shape().bounds().1.x);
            self.reaches.push(reach);
        }
        self.is_sorted = true;
    }

    /// The platforms whose box overlaps a box of the plane frame, in no particular order: those that begin before
    /// its right end, back to where none reaches it any more.
    pub(crate) fn overlapping(
        &self,
        low: Vector3,
        high: Vector3,
    ) -> impl Iterator<Item = (PlatformId, &Platform)> {
        let end = self.by_left.partition_point(|entry| entry.0 < ordered(high.x).into());
        let candidates = self.by_left[..end].iter().zip(&self.reaches[..end]).rev();
        candidates.take_while(move |&(_, &reach)| reach > low.x).filter_map(move |(&(_, index), _)| {
            let (id, platform) = &self.list[index as usize];
            let (box_low, box_high) = platform.shape().bounds();
            let overlap = (0..3).all(|axis| box_low[axis] < high[axis] && low[axis] < box_high[axis]);
            overlap.then_some((*id, platform))
        })
    }

    /// Arguments that setters have refused since the last update.
    pub(crate) fn take_rejected(&mut self) -> impl Iterator<Item = &'static str> + '_ {
        self.list.iter_mut().flat_map(|(_, platform)| platform.take_rejected())
    }

    /// Whether everything is what the constructors could have made: false only after loading garbage. Computes the
    /// shapes anew.
    pub(crate) fn restore(&mut self, projection: &Projection) -> bool {
        (self.is_sorted, self.is_told) = (false, false);
        let in_order = self.list.windows(2).all(|pair| pair[0].0 < pair[1].0)
            && self.list.last().is_none_or(|(id, _)| *id < self.next);
        let are_valid = self.list.iter_mut().all(|(_, platform)| platform.restore(projection));
        in_order && are_valid
    }
}
