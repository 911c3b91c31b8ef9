//! Equal distance grids are made and kept once.

use std::collections::BTreeMap;
use std::sync::{Arc, Weak};

use super::distance_grid::DistanceGrid;
use crate::Result;
use crate::shape::Vertices;

/// The grids of a simulator by outline and cell size, so that equal ones are built and kept once.
#[derive(Debug, Clone, Default)]
pub(crate) struct GridCache {
    grids: BTreeMap<Box<[u32]>, Weak<DistanceGrid>>,
    inserts_until_cleanup: usize,
}

impl GridCache {
    /// The grid over an outline; built only if there is none yet.
    pub(crate) fn get(&mut self, outline: &Vertices, cell_size: f32) -> Result<Arc<DistanceGrid>> {
        let bits = outline.iter().flat_map(|v| [v.x.to_bits(), v.y.to_bits()]);
        let key: Box<[u32]> = std::iter::once(cell_size.to_bits()).chain(bits).collect();
        if let Some(grid) = self.grids.get(&key).and_then(Weak::upgrade) {
            return Ok(grid);
        }
        let grid = Arc::new(DistanceGrid::new(outline.clone(), cell_size)?);
        self.forget_unused();
        self.grids.insert(key, Arc::downgrade(&grid));
        Ok(grid)
    }

    /// Drops entries whose grid is gone, once for every doubling.
    fn forget_unused(&mut self) {
        if self.inserts_until_cleanup == 0 {
            self.grids.retain(|_, grid| grid.strong_count() > 0);
            self.inserts_until_cleanup = self.grids.len().max(64);
        }
        self.inserts_until_cleanup -= 1;
    }

    /// Takes a grid that was loaded; answers the one to use.
    pub(crate) fn adopt(&mut self, grid: &Arc<DistanceGrid>) -> Result<Arc<DistanceGrid>> {
        self.get(grid.outline(), grid.cell_size())
    }
}
