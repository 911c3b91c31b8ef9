//! All platforms of a simulator, with a broad phase along X.

use farseer_core::depth::WorldBoxMotion;
use farseer_precise::storage::order::{sort_numbered, total_order_key};
use serde::{Deserialize, Serialize};

use super::platform::Platform;
use super::platform_id::PlatformId;
use crate::error::{invalid, stale};
use crate::{Projection, Result, Vector3};

/// All platforms of a simulator, with sorted left bounds for queries and flags of changes for the core.
#[derive(Debug, Clone, Default, Serialize, Deserialize)]
pub(crate) struct Platforms {
    /// Platforms sorted by id, which is the order of creation.
    list: Vec<(PlatformId, Platform)>,
    next: PlatformId,
    /// Whether `by_left` fits the present platforms.
    #[serde(skip)]
    is_sorted: bool,
    /// Whether the precise set has the present state of all platforms.
    #[serde(skip)]
    is_sent: bool,
    /// Whether the precise set has the present motions of all platforms.
    #[serde(skip)]
    is_motion_sent: bool,
    /// Broad phase: left bounds as sortable numbers with indices into `list`, sorted. Each entry also has the greatest right
    /// bound up to it, px.
    #[serde(skip)]
    by_left: Vec<(u128, u32)>,
    #[serde(skip)]
    max_right: Vec<f32>,
}

impl Platforms {
    pub(crate) fn insert(&mut self, platform: Platform) -> Result<PlatformId> {
        let id = self.next;
        self.next = id.next().ok_or(invalid("platform", id.number(), "one of fewer than 2^31 - 16"))?;
        self.list.push((id, platform));
        (self.is_sorted, self.is_sent) = (false, false);
        Ok(id)
    }

    pub(crate) fn remove(&mut self, id: PlatformId) -> Result<()> {
        let index = self.index_of(id).ok_or(stale("platform"))?;
        self.list.remove(index);
        (self.is_sorted, self.is_sent) = (false, false);
        Ok(())
    }

    pub(crate) fn clear(&mut self) {
        self.list.clear();
        (self.is_sorted, self.is_sent) = (false, false);
    }

    pub(crate) fn index_of(&self, id: PlatformId) -> Option<usize> {
        self.list.binary_search_by_key(&id, |(id, _)| *id).ok()
    }

    pub(crate) fn get(&self, id: PlatformId) -> Option<&Platform> {
        self.index_of(id).map(|index| &self.list[index].1)
    }

    /// The platform at an [index](Self::index_of).
    pub(crate) fn at(&self, index: usize) -> &Platform {
        &self.list[index].1
    }

    /// Replaces the platform at an index.
    pub(crate) fn replace(&mut self, index: usize, platform: Platform) {
        self.list[index].1 = platform;
        (self.is_sorted, self.is_sent) = (false, false);
    }

    /// Returns a platform for changes that keep its box.
    pub(crate) fn edit(&mut self, index: usize) -> &mut Platform {
        self.is_sent = false;
        &mut self.list[index].1
    }

    /// Replaces a platform by one with or without a hinge.
    pub(crate) fn swing(&mut self, index: usize, platform: Platform) {
        self.replace(index, platform);
        self.is_motion_sent = false;
    }

    /// Replaces a platform by one that turns. `stood_still` tells whether the platform was static before.
    pub(crate) fn turn(&mut self, index: usize, platform: Platform, stood_still: bool) {
        self.list[index].1 = platform;
        self.is_sent &= !stood_still;
        self.is_motion_sent = false;
    }

    /// Sets velocity and target of a platform.
    pub(crate) fn set_motion(&mut self, index: usize, velocity: Vector3, target: Option<Vector3>) {
        let stood_still = self.list[index].1.set_motion(velocity, target);
        self.is_sent &= !stood_still;
        self.is_motion_sent = false;
    }

    pub(crate) fn iter(&self) -> impl DoubleEndedIterator<Item = (PlatformId, &Platform)> {
        self.list.iter().map(|(id, platform)| (*id, platform))
    }

    /// Marks all platforms as unknown to the precise set.
    pub(crate) fn mark_all_unsent(&mut self) {
        self.is_sent = false;
    }

    /// Returns whether a platform was added, removed or edited since the last call.
    pub(crate) fn take_changed(&mut self) -> bool {
        !std::mem::replace(&mut self.is_sent, true)
    }

    /// Iterates over the motions of all moving platforms if any motion was edited since the last call; else over none.
    pub(crate) fn edited_motions(&mut self) -> impl Iterator<Item = (PlatformId, WorldBoxMotion)> + '_ {
        let is_sent = std::mem::replace(&mut self.is_motion_sent, true);
        let edited = if is_sent { &[][..] } else { &self.list };
        edited.iter().filter_map(|(id, platform)| Some((*id, platform.core_motion()?)))
    }

    /// Stores centre, yaw and motion of a platform after an update of the core.
    pub(crate) fn has_moved(
        &mut self,
        id: PlatformId,
        centre: Vector3,
        yaw: Option<f32>,
        motion: WorldBoxMotion,
    ) {
        if let Some(index) = self.index_of(id) {
            self.list[index].1.has_moved(centre, yaw, motion);
            self.is_sorted = false;
        }
    }

    /// Stores the motion of a hinged platform that may have fallen asleep in the core, unless the game edited the platform
    /// since.
    pub(crate) fn has_rested(&mut self, id: PlatformId, motion: WorldBoxMotion) {
        if let Some(index) = self.index_of(id).filter(|_| self.is_sent && self.is_motion_sent) {
            self.list[index].1.has_rested(motion);
        }
    }

    /// Returns whether a platform has a feature that only the precise set supports.
    pub(crate) fn are_precise(&self) -> bool {
        self.list.iter().any(|(_, platform)| platform.is_precise())
    }

    pub(crate) fn is_empty(&self) -> bool {
        self.list.is_empty()
    }

    /// Sorts the left bounds of all platforms for [`overlapping`](Self::overlapping).
    pub(crate) fn sort(&mut self) {
        if self.is_sorted {
            return;
        }
        self.by_left.clear();
        for ((_, platform), index) in self.list.iter().zip(0..) {
            self.by_left.push((total_order_key(platform.shape().bounds().0.x).into(), index));
        }
        // Moving platforms need this in every update, so it sorts in place.
        sort_numbered(&mut self.by_left);
        let mut reach = f32::NEG_INFINITY;
        self.max_right.clear();
        for &(_, index) in &self.by_left {
            reach = reach.max(self.list[index as usize].1.shape().bounds().1.x);
            self.max_right.push(reach);
        }
        self.is_sorted = true;
    }

    /// Broad phase: the platforms whose AABB overlaps a box of the plane frame, in no particular order. It
    /// scans the sorted left bounds backwards until no platform further left reaches the box.
    pub(crate) fn overlapping(
        &self,
        low: Vector3,
        high: Vector3,
    ) -> impl Iterator<Item = (PlatformId, &Platform)> {
        let end = self.by_left.partition_point(|entry| entry.0 < total_order_key(high.x).into());
        let candidates = self.by_left[..end].iter().zip(&self.max_right[..end]).rev();
        candidates.take_while(move |&(_, &reach)| reach > low.x).filter_map(move |(&(_, index), _)| {
            let (id, platform) = &self.list[index as usize];
            let (box_low, box_high) = platform.shape().bounds();
            let overlap = (0..3).all(|axis| box_low[axis] < high[axis] && low[axis] < box_high[axis]);
            overlap.then_some((*id, platform))
        })
    }

    /// Drains the arguments that setters have refused.
    pub(crate) fn take_rejected(&mut self) -> impl Iterator<Item = &'static str> + '_ {
        self.list.iter_mut().flat_map(|(_, platform)| platform.take_rejected())
    }

    /// Returns whether all platforms are in range: false only for a damaged save. Recomputes the shapes.
    pub(crate) fn restore(&mut self, projection: &Projection) -> bool {
        (self.is_sorted, self.is_sent) = (false, false);
        let in_order = self.list.windows(2).all(|pair| pair[0].0 < pair[1].0)
            && self.list.last().is_none_or(|(id, _)| *id < self.next);
        let are_valid = self.list.iter_mut().all(|(_, platform)| platform.restore(projection));
        in_order && are_valid
    }
}
