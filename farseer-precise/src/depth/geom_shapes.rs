//! Depth shapes of geoms, which the engine above sets, and the depth data of their proxies.

use super::interface::{DepthInterval, DepthShape};
use super::owner::{ShapeOwner, owner_of};
use super::state::{DepthExtent, DepthState, entry, entry_mut};
use super::vertical_solid::VerticalSolid;
use super::world_box_shape::{vertical_of, yaw_extent};
use crate::broad_phase::proxies::Proxies;
use crate::index::ProxyIndex;

impl DepthState {
    /// Returns the depth shape of the geom at a slot; the default shape if the slot has none.
    pub fn shape(&self, slot: usize) -> DepthShape {
        entry(&self.shapes, slot)
    }

    /// Returns the depth shape of the geom at a slot, which it makes if the slot has none.
    pub fn shape_mut(&mut self, slot: usize) -> &mut DepthShape {
        entry_mut(&mut self.shapes, slot)
    }

    /// Rebuilds the depth data by proxy index: extents, vertical shapes and intervals along z. Intervals are empty until the
    /// broad phase sets them.
    pub(crate) fn rebuild_proxies(&mut self, proxies: &Proxies) {
        self.extents.clear();
        self.vertical_solids.clear();
        self.intervals.clear();
        self.intervals.resize(proxies.position_count(), DepthInterval::default());
        for proxy in proxies.positions_from(ProxyIndex(0)) {
            let extent = self.extent_of(proxy.owner);
            self.extents.push(extent);
        }
    }

    /// Adds the depth data of a new proxy at this proxy index: the extent of its geom and an empty interval along z.
    pub fn add_proxy(&mut self, proxy_index: ProxyIndex, owner: u64) {
        let extent = self.extent_of(owner);
        *self.extents.at_or_grow(proxy_index) = extent;
        *self.intervals.at_or_grow(proxy_index) = DepthInterval::default();
    }

    /// Returns the depth extent of a geom, a world box or the ground. A vertical shape is appended to `vertical_solids`.
    pub(super) fn extent_of(&mut self, owner: u64) -> DepthExtent {
        match owner_of(owner) {
            ShapeOwner::Ground => DepthExtent::default(),
            ShapeOwner::WorldBox(id) => {
                let Some((_, world_box)) = self.world_box_by_id(id) else { return DepthExtent::default() };
                let half_depth =
                    if world_box.yaw.is_some() { yaw_extent(world_box) } else { world_box.shape.half[2] };
                let vertical = world_box.yaw.map(|_| vertical_of(world_box));
                let vertical = vertical.map_or(0, |vertical| self.add_vertical(vertical));
                DepthExtent { half_depth, vertical, ..DepthExtent::default() }
            }
            ShapeOwner::Geom(slot) => {
                let DepthShape { half_depth, is_sphere, ground_surface, vertical } = self.shape(slot);
                let vertical = vertical.map_or(0, |vertical| self.add_vertical(VerticalSolid::new(vertical)));
                DepthExtent { half_depth, is_sphere, ground_surface, vertical }
            }
        }
    }
}
