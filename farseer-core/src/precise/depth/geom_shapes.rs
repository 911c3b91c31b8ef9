//! Adapter: depth shapes of geoms, which the engine above sets, and the depth data of their proxies.

use super::interface::{self, DepthInterval, DepthShape};
use super::state::{DepthExtent, DepthState, entry, entry_mut};
use super::vertical_shapes::VerticalSolid;
use super::world_box_shape::{vertical_of, yaw_extent};
use crate::geom::GeomId;
use crate::precise::broad_phase::proxies::Proxies;
use crate::precise::ids::geom_of;

impl DepthState {
    pub(in crate::precise) fn shape(&self, id: GeomId) -> DepthShape {
        entry(&self.shapes, id.slot())
    }

    pub(in crate::precise) fn shape_mut(&mut self, id: GeomId) -> &mut DepthShape {
        entry_mut(&mut self.shapes, id.slot())
    }

    /// Rebuilds the depth data by proxy index: extents, vertical shapes and intervals along z. Intervals are empty until the
    /// broad phase sets them.
    pub(in crate::precise) fn rebuild_proxies(&mut self, proxies: &Proxies) {
        self.extents.clear();
        self.vertical_solids.clear();
        self.intervals.clear();
        self.intervals.resize(proxies.all.len(), DepthInterval::default());
        for proxy in &proxies.all {
            let extent = self.extent_of(geom_of(proxy));
            self.extents.push(extent);
        }
    }

    /// Adds the depth data of a new proxy at this proxy index: the extent of its geom and an empty interval along z.
    pub(in crate::precise) fn add_proxy(&mut self, proxy_index: usize, geom: GeomId) {
        let extent = self.extent_of(geom);
        *entry_mut(&mut self.extents, proxy_index) = extent;
        *entry_mut(&mut self.intervals, proxy_index) = DepthInterval::default();
    }

    /// Returns the depth extent of a geom, a world box or the ground. A vertical shape is appended to `vertical_solids`.
    pub(super) fn extent_of(&mut self, geom: GeomId) -> DepthExtent {
        match interface::contact_target_of(geom) {
            interface::DepthContactTarget::Ground => DepthExtent::default(),
            interface::DepthContactTarget::WorldBox(id) => {
                let Some((_, world_box)) = self.world_box_by_id(id) else { return DepthExtent::default() };
                let half_depth =
                    if world_box.yaw.is_some() { yaw_extent(world_box) } else { world_box.shape.half[2] };
                let vertical = world_box.yaw.map(|_| vertical_of(world_box));
                let vertical = vertical.map_or(0, |vertical| self.add_vertical(vertical));
                DepthExtent { half_depth, vertical, ..DepthExtent::default() }
            }
            interface::DepthContactTarget::Geom(geom) => {
                let DepthShape { half_depth, is_sphere, ground_surface, vertical } = self.shape(geom);
                let vertical = vertical.map_or(0, |vertical| self.add_vertical(VerticalSolid::new(vertical)));
                DepthExtent { half_depth, is_sphere, ground_surface, vertical }
            }
        }
    }
}
